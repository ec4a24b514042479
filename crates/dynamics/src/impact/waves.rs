//! The forcing in flight, by its phase x = pi t: the cosine of the paper, or several harmonics.

use super::swing::Swing;
use super::turns::{Harmonic, Turn, in_order, zeros};
use crate::model::{Motion, Side};
use numbers::Analytic;
use smallvec::SmallVec;
use std::fmt::Debug;
use std::sync::Arc;

/// Upper bounds of a forcing, its integrals and its second derivative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// The order of the highest harmonic.
    pub highest: f64,
    /// Of |f|, of its first and second integral, and of its second derivative, in units without pi.
    pub f: f64,
    pub f1: f64,
    pub f2: f64,
    pub bend: f64,
    /// Of the sum of the amplitudes that are rounded; 0 where they are exact.
    pub rounded: f64,
}

/// The forcing and its integrals at one phase, as seen from a wall.
///
/// A harmonic of order n is c = A cos(n x + .) here, with s = A sin(n x + .): f is the sum of the c.
pub(super) trait Waves<T: Analytic>: Clone + Debug + PartialEq {
    /// The forcing as a function of the phase.
    type Drive: Clone + Debug;
    /// The same in f64.
    type Narrow: Waves<f64, Narrow = Self::Narrow>;

    /// The forcing of a motion.
    fn drive(motion: &Motion<T>) -> Self::Drive;
    fn narrow(drive: &Self::Drive) -> <Self::Narrow as Waves<f64>>::Drive;
    /// Bounds, from the size that a coefficient has at most.
    fn bounds(drive: &Self::Drive, size: impl Fn(&T) -> f64) -> Bounds;
    /// The changes of sign of f + g, by the phase in [0, 2 pi).
    fn turns(drive: &Self::Drive, g: &T) -> Vec<Turn<T, Self>>;
    /// The forcing at a phase, as seen from the bottom.
    fn at(drive: &Self::Drive, phase: &T) -> Self;

    fn in_f64(&self) -> Self::Narrow;
    /// The same seen from a wall, of what is seen from the bottom, and back.
    fn seen(self, side: Side) -> Self;
    /// f.
    fn f(&self) -> T;
    /// F_1, the integral of f with zero mean.
    fn f1(&self) -> T;
    /// -F_2.
    fn minus_f2(&self) -> T;
    /// -f'.
    fn minus_slope(&self) -> T;
    /// -f''.
    fn minus_curvature(&self) -> T;
    /// The same a step on, and what the integrals from here to there add; each relative to its size.
    fn after(&self, step: &T, swing: impl Fn(&T) -> Swing<T>) -> (Self, Gains<T>);
}

/// What a step adds to f and its integrals: `f(0) - f`, `f(0) step - F_1`, `f(0) step²/2 + F_1(0) step - F_2`, all of
/// differences from the start of the step.
pub(super) struct Gains<T> {
    pub f: T,
    pub f1: T,
    pub f2: T,
}

/// Sine and cosine of the phase: the forcing of the paper.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cosine<T> {
    pub sin: T,
    pub cos: T,
}

impl<T: Analytic> Waves<T> for Cosine<T> {
    type Drive = ();
    type Narrow = Cosine<f64>;

    fn drive(_: &Motion<T>) {}

    fn narrow((): &()) {}

    fn bounds((): &(), _: impl Fn(&T) -> f64) -> Bounds {
        Bounds {
            highest: 1.0,
            f: 1.0,
            f1: 1.0,
            f2: 1.0,
            bend: 1.0,
            rounded: 0.0,
        }
    }

    fn turns((): &(), g: &T) -> Vec<Turn<T, Self>> {
        of_cosine(g)
    }

    #[inline(always)]
    fn at((): &(), phase: &T) -> Self {
        let (sin, cos) = phase.sincos();
        Self { sin, cos }
    }

    fn in_f64(&self) -> Cosine<f64> {
        Cosine {
            sin: self.sin.to_f64(),
            cos: self.cos.to_f64(),
        }
    }

    #[inline(always)]
    fn seen(self, side: Side) -> Self {
        Self {
            sin: side.signed(self.sin),
            cos: side.signed(self.cos),
        }
    }

    #[inline(always)]
    fn f(&self) -> T {
        self.cos.clone()
    }

    #[inline(always)]
    fn f1(&self) -> T {
        self.sin.clone()
    }

    #[inline(always)]
    fn minus_f2(&self) -> T {
        self.cos.clone()
    }

    #[inline(always)]
    fn minus_slope(&self) -> T {
        self.sin.clone()
    }

    #[inline(always)]
    fn minus_curvature(&self) -> T {
        self.cos.clone()
    }

    #[inline(always)]
    fn after(&self, step: &T, swing: impl Fn(&T) -> Swing<T>) -> (Self, Gains<T>) {
        let Swing { sin, fall, lag, rest } = swing(step);
        let (s, c) = (&self.sin, &self.cos);
        let turned = c.clone() * fall.clone() + s.clone() * sin.clone();
        let gains = Gains {
            f2: c.clone() * rest + s.clone() * lag.clone(),
            f1: c.clone() * lag + s.clone() * fall.clone(),
            f: turned.clone(),
        };
        let after = Self {
            sin: s.clone() + (c.clone() * sin - s.clone() * fall),
            cos: c.clone() - turned,
        };
        (after, gains)
    }
}

/// The waves of several harmonics, or of one other than the paper's.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Several<T>(SmallVec<[Wave<T>; 4]>);

#[derive(Clone, Debug, PartialEq)]
struct Wave<T> {
    order: i64,
    c: T,
    s: T,
}

impl<T: Analytic> Several<T> {
    fn sum(&self, term: impl Fn(&Wave<T>, T) -> T) -> T {
        let terms = self.0.iter().map(|wave| term(wave, T::from_integer(wave.order)));
        terms.fold(T::zero(), |sum, term| sum + term)
    }
}

/// A bound of the sum of amplitudes times a power of their orders.
fn bound<T>(harmonics: &[Harmonic<T>], size: impl Fn(&T) -> f64, power: i32) -> f64 {
    let of = |harmonic: &Harmonic<T>| {
        let amplitude = size(&harmonic.cosine).hypot(size(&harmonic.sine));
        amplitude * (harmonic.order as f64).powi(power)
    };
    // for the roundings of the bound itself
    harmonics.iter().map(of).sum::<f64>() * (1.0 + 1e-12)
}

impl<T: Analytic> Waves<T> for Several<T> {
    type Drive = Arc<[Harmonic<T>]>;
    type Narrow = Several<f64>;

    fn drive(motion: &Motion<T>) -> Self::Drive {
        let forcing = motion.forcing();
        let harmonics = forcing.harmonics().map(|(order, cosine, sine)| Harmonic {
            order,
            cosine: cosine.clone(),
            sine: sine.clone(),
        });
        harmonics.collect()
    }

    fn narrow(drive: &Self::Drive) -> Arc<[Harmonic<f64>]> {
        let narrow = drive.iter().map(|harmonic| Harmonic {
            order: harmonic.order,
            cosine: harmonic.cosine.to_f64(),
            sine: harmonic.sine.to_f64(),
        });
        narrow.collect()
    }

    fn bounds(drive: &Self::Drive, size: impl Fn(&T) -> f64) -> Bounds {
        let bound = |power| bound(drive, &size, power);
        Bounds {
            highest: drive.iter().map(|harmonic| harmonic.order).max().unwrap_or(1) as f64,
            f: bound(0),
            f1: bound(-1),
            f2: bound(-2),
            bend: bound(2),
            rounded: bound(0),
        }
    }

    fn turns(drive: &Self::Drive, g: &T) -> Vec<Turn<T, Self>> {
        in_order(zeros(drive, g), |phase| Self::at(drive, phase))
    }

    fn at(drive: &Self::Drive, phase: &T) -> Self {
        let waves = drive.iter().map(|harmonic| {
            let (sin, cos) = (T::from_integer(harmonic.order) * phase.clone()).sincos();
            let (a, b) = (&harmonic.cosine, &harmonic.sine);
            Wave {
                order: harmonic.order,
                c: a.clone() * cos.clone() + b.clone() * sin.clone(),
                s: a.clone() * sin - b.clone() * cos,
            }
        });
        Self(waves.collect())
    }

    fn in_f64(&self) -> Several<f64> {
        let waves = self.0.iter().map(|wave| Wave {
            order: wave.order,
            c: wave.c.to_f64(),
            s: wave.s.to_f64(),
        });
        Several(waves.collect())
    }

    fn seen(mut self, side: Side) -> Self {
        for wave in &mut self.0 {
            wave.c = side.signed(wave.c.clone());
            wave.s = side.signed(wave.s.clone());
        }
        self
    }

    fn f(&self) -> T {
        self.sum(|wave, _| wave.c.clone())
    }

    fn f1(&self) -> T {
        self.sum(|wave, order| wave.s.clone() / order)
    }

    fn minus_f2(&self) -> T {
        self.sum(|wave, order| wave.c.clone() / (order.clone() * order))
    }

    fn minus_slope(&self) -> T {
        self.sum(|wave, order| wave.s.clone() * order)
    }

    fn minus_curvature(&self) -> T {
        self.sum(|wave, order| wave.c.clone() * order.clone() * order)
    }

    fn after(&self, step: &T, swing: impl Fn(&T) -> Swing<T>) -> (Self, Gains<T>) {
        let mut gains = Gains {
            f: T::zero(),
            f1: T::zero(),
            f2: T::zero(),
        };
        let waves = self.0.iter().map(|Wave { order, c, s }| {
            let rate = T::from_integer(*order);
            let Swing { sin, fall, lag, rest } = swing(&(rate.clone() * step.clone()));
            let turned = c.clone() * fall.clone() + s.clone() * sin.clone();
            let square = rate.clone() * rate.clone();
            gains.f2 += (c.clone() * rest + s.clone() * lag.clone()) / square;
            gains.f1 += (c.clone() * lag + s.clone() * fall.clone()) / rate;
            gains.f += turned.clone();
            Wave {
                order: *order,
                s: s.clone() + (c.clone() * sin - s.clone() * fall),
                c: c.clone() - turned,
            }
        });
        let after = Self(waves.collect());
        (after, gains)
    }
}

/// cos(phase) = -g; none where |g| is 1 or more.
fn of_cosine<T: Analytic>(g: &T) -> Vec<Turn<T, Cosine<T>>> {
    let room = (T::one() - g.clone()) * (T::one() + g.clone());
    if room.to_f64() <= 0.0 || room.to_f64().is_nan() {
        return Vec::new();
    }
    let circle = T::pi() + T::pi();
    let (angle, sin) = ((-g.clone()).acos(), room.sqrt());
    let twice = angle.clone() + angle.clone();
    let turn = |phase, falling, sin, to_next| Turn {
        phase,
        falling,
        waves: Cosine { sin, cos: -g.clone() },
        to_next,
    };
    vec![
        turn(angle.clone(), true, sin.clone(), circle.clone() - twice.clone()),
        turn(circle - angle, false, -sin, twice),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Forcing, Motion};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn turns(cosines: &[f64], sines: &[f64], g: f64) -> Vec<Turn<f64, Several<f64>>> {
        let forcing = Forcing::periodic(2.0, cosines, sines).expect("a forcing");
        let motion = Motion::new(g, 0.3, 0.5, 0.5).expect("a motion").with_forcing(forcing);
        Several::turns(&Several::drive(&motion.expect("of period 2")), &g)
    }

    #[test]
    fn those_of_a_cosine_are_explicit() {
        for g in [-0.9, -0.2, 0.0, 0.122, 0.999] {
            let (explicit, found) = (of_cosine(&g), turns(&[1.0], &[], g));
            assert_eq!(found.len(), 2);
            for (one, other) in explicit.iter().zip(&found) {
                assert!(
                    (one.phase - other.phase).abs() < 1e-13 && one.falling == other.falling,
                    "{g}"
                );
                assert!((one.to_next - other.to_next).abs() < 1e-13);
            }
        }
        assert!(turns(&[1.0], &[], 1.1).is_empty() && of_cosine(&-1.5).is_empty());
    }

    #[test]
    fn two_that_nearly_meet_are_two_or_none() {
        // cos x - cos(2x)/4 is 3/4 at x = 0, and hardly less near it
        for (apart, count) in [(1e-3, 0), (1e-12, 0), (-1e-12, 2), (-1e-3, 2)] {
            assert_eq!(turns(&[1.0, -0.25], &[], -0.75 - apart).len(), count, "{apart}");
        }
    }

    proptest! {
        #[test]
        fn between_them_f_plus_g_has_one_sign(
            cosines in prop::collection::vec(-1.0..1.0_f64, 1..6),
            sines in prop::collection::vec(-1.0..1.0_f64, 1..6),
            g in -1.0..1.0_f64,
        ) {
            let turns = turns(&cosines, &sines, g);
            let value = |x: f64| {
                let mut sum = g;
                for (n, a) in (1..).zip(&cosines) {
                    sum += a * (f64::from(n) * x).cos();
                }
                for (n, b) in (1..).zip(&sines) {
                    sum += b * (f64::from(n) * x).sin();
                }
                sum
            };
            prop_assert!(turns.len().is_multiple_of(2));
            for turn in &turns {
                prop_assert!(value(turn.phase).abs() < 1e-13);
                for part in 1..50 {
                    let inside = value(turn.phase + turn.to_next * f64::from(part) / 50.0);
                    prop_assert!((inside < 0.0) == turn.falling || inside.abs() < 1e-13);
                }
            }
            if turns.is_empty() {
                let positive = value(0.0) > 0.0;
                prop_assert!((0..1000).all(|part| (value(TAU * f64::from(part) / 1000.0) > 0.0) == positive));
            }
        }
    }
}
