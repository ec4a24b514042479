//! The forcing: a finite sum of harmonics with zero mean, its integrals, and the view from one instant onwards.

use crate::number::Analytic;
use smallvec::SmallVec;

/// A term `cosine cos(order w t) + sine sin(order w t)`.
#[derive(Clone, Debug, PartialEq)]
struct Harmonic<T> {
    order: i64,
    cosine: T,
    sine: T,
}

/// f(t), a sum of harmonics of one period. The paper's cos(pi t + phi) is [`Forcing::harmonic`].
#[derive(Clone, Debug, PartialEq)]
pub struct Forcing<T> {
    period: T,
    harmonics: SmallVec<[Harmonic<T>; 1]>,
}

/// f, F_1 and F_2 at one time; the integrals are those with zero mean (F_2' = F_1, F_1' = f).
#[derive(Clone, Debug, PartialEq)]
pub struct Forced<T> {
    /// f(t).
    pub f: T,
    /// F_1(t); sin(pi t + phi)/pi for the paper's forcing.
    pub f1: T,
    /// F_2(t); -cos(pi t + phi)/pi² for the paper's forcing.
    pub f2: T,
}

/// A forcing that is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForcingError {
    /// The period is not positive.
    #[error("the forcing period is {found}, must be finite and above 0")]
    Period {
        /// What was given.
        found: f64,
    },
    /// A coefficient is NaN or infinite.
    #[error("the {name} amplitude of harmonic {order} is {found}, must be a finite number")]
    Amplitude {
        /// `cosine` or `sine`.
        name: &'static str,
        /// From 1.
        order: usize,
        /// What was given.
        found: f64,
    },
}

impl<T: Analytic> Forcing<T> {
    /// cos(pi t + phase), of period 2.
    pub fn harmonic(phase: &T) -> Self {
        let (sin, cos) = phase.sincos();
        let first = Harmonic {
            order: 1,
            cosine: cos,
            sine: -sin,
        };
        Self {
            period: T::from_integer(2),
            harmonics: SmallVec::from_iter([first]),
        }
    }

    /// The sum over n = 1, 2, ... of `cosines[n-1] cos(2 pi n t / period) + sines[n-1] sin(2 pi n t / period)`.
    /// The lists may differ in length; harmonics with both amplitudes 0 are dropped.
    ///
    /// # Errors
    /// A period that is not positive, an amplitude that is not finite.
    pub fn periodic(period: T, cosines: &[T], sines: &[T]) -> Result<Self, ForcingError> {
        let found = period.to_f64();
        if !(found > 0.0 && found.is_finite()) {
            return Err(ForcingError::Period { found });
        }
        let mut harmonics = SmallVec::new();
        for index in 0..cosines.len().max(sines.len()) {
            let amplitude = |list: &[T]| list.get(index).cloned().unwrap_or_else(T::zero);
            let (cosine, sine) = (amplitude(cosines), amplitude(sines));
            for (name, value) in [("cosine", &cosine), ("sine", &sine)] {
                let (order, found) = (index + 1, value.to_f64());
                if !found.is_finite() {
                    return Err(ForcingError::Amplitude { name, order, found });
                }
            }
            if !(cosine.is_zero() && sine.is_zero()) {
                harmonics.push(Harmonic {
                    order: index as i64 + 1,
                    cosine,
                    sine,
                });
            }
        }
        Ok(Self { period, harmonics })
    }

    /// The period.
    pub fn period(&self) -> &T {
        &self.period
    }

    /// `time` less whole periods, in [0, period] (the period itself only by rounding). What is not finite stays.
    ///
    /// With absolute time the rounding error of a phase grows with time; with this it does not.
    pub fn reduced(&self, time: &T) -> T {
        let periods = (time.to_f64() / self.period.to_f64()).floor();
        // beyond i64 a float has no phase left
        if periods == 0.0 || periods.is_nan() || periods.abs() > 9e18 {
            return time.clone();
        }
        time.clone() - T::from_integer(periods as i64) * self.period.clone()
    }

    /// The same forcing over another number.
    pub fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> Forcing<U> {
        let harmonics = self.harmonics.iter().map(|harmonic| Harmonic {
            order: harmonic.order,
            cosine: convert(&harmonic.cosine),
            sine: convert(&harmonic.sine),
        });
        Forcing {
            period: convert(&self.period),
            harmonics: harmonics.collect(),
        }
    }

    /// f and its integrals at `time`, to a few roundings of `T` after reducing `time` by whole periods.
    pub fn at(&self, time: &T) -> Forced<T> {
        let mut forced = Forced {
            f: T::zero(),
            f1: T::zero(),
            f2: T::zero(),
        };
        for wave in &self.ahead(time).waves {
            let inverse = T::one() / wave.rate.clone();
            forced.f += wave.along.clone();
            forced.f1 -= wave.across.clone() * inverse.clone();
            forced.f2 -= wave.along.clone() * inverse.clone() * inverse;
        }
        forced
    }

    /// The forcing as it looks from `time` onwards.
    pub fn ahead(&self, time: &T) -> Ahead<T> {
        let base = T::from_integer(2) * T::pi() / self.period.clone();
        let time = self.reduced(time);
        let waves = self.harmonics.iter().map(|harmonic| {
            let rate = base.clone() * T::from_integer(harmonic.order);
            let (sin, cos) = (rate.clone() * time.clone()).sincos();
            let (a, b) = (harmonic.cosine.clone(), harmonic.sine.clone());
            let along = a.clone() * cos.clone() + b.clone() * sin.clone();
            Wave {
                rate,
                along,
                across: b * cos - a * sin,
            }
        });
        Ahead {
            waves: waves.collect(),
        }
    }
}

/// `along cos(rate s) + across sin(rate s)`, s the time since the instant.
#[derive(Clone, Debug, PartialEq)]
struct Wave<T> {
    rate: T,
    along: T,
    across: T,
}

/// A forcing from one instant t onwards, as a function of the time s since then.
///
/// Integrals are taken from the instant, by formulas that keep their relative accuracy however short s is;
/// differences of F_1 and F_2 lose all digits there.
#[derive(Clone, Debug, PartialEq)]
pub struct Ahead<T> {
    waves: SmallVec<[Wave<T>; 1]>,
}

/// The times after an instant at which f + g changes sign.
#[derive(Clone, Debug, PartialEq)]
pub enum Turnings<T> {
    /// f + g never changes sign.
    Never,
    /// At the two times, in order, and at every whole `period` after each.
    Periodic {
        /// In (0, period].
        times: [T; 2],
        /// Of the only wave.
        period: T,
    },
    /// Several harmonics: no explicit form.
    Unknown,
}

impl<T: Analytic> Ahead<T> {
    /// f(t + s), F_1(t + s) - F_1(t) and F_2(t + s) - F_2(t) - F_1(t) s.
    pub fn growth(&self, s: &T) -> Forced<T> {
        let mut growth = Forced {
            f: T::zero(),
            f1: T::zero(),
            f2: T::zero(),
        };
        for wave in &self.waves {
            let angle = wave.rate.clone() * s.clone();
            let (half_sin, half_cos) = (angle.clone() * T::from_ratio(1, 2)).sincos();
            // 1 - cos = 2 sin²(angle / 2) does not cancel
            let twice = half_sin.clone() + half_sin.clone();
            let fall = twice.clone() * half_sin;
            let sin = twice * half_cos;
            let cos = T::one() - fall.clone();
            let lag = lag(&angle, &sin);
            let inverse = T::one() / wave.rate.clone();
            let (along, across) = (wave.along.clone(), wave.across.clone());
            growth.f += along.clone() * cos + across.clone() * sin.clone();
            growth.f1 += (along.clone() * sin + across.clone() * fall.clone()) * inverse.clone();
            growth.f2 += (along * fall + across * lag) * inverse.clone() * inverse;
        }
        growth
    }

    /// A bound of |f|: the sum of the amplitudes.
    pub fn bound(&self) -> T {
        let amplitudes = self.waves.iter().map(Wave::amplitude);
        amplitudes.fold(T::zero(), |sum, amplitude| sum + amplitude)
    }

    /// A bound of |f'|.
    pub fn bound_of_slope(&self) -> T {
        let slopes = self
            .waves
            .iter()
            .map(|wave| wave.amplitude() * wave.rate.clone());
        slopes.fold(T::zero(), |sum, slope| sum + slope)
    }

    /// When f + g changes sign: explicit for one harmonic, from amplitude cos(angle) = -g.
    pub fn turnings(&self, g: &T) -> Turnings<T> {
        let wave = match self.waves.as_slice() {
            [] => return Turnings::Never,
            [wave] => wave,
            _ => return Turnings::Unknown,
        };
        let ratio = -g.clone() / wave.amplitude();
        // NaN, from an amplitude of 0 without gravity, is answered as a constant too
        let room = (T::one() - ratio.clone() * ratio.clone()).to_f64();
        if room <= 0.0 || room.is_nan() {
            return Turnings::Never;
        }
        let crest = wave.across.atan2(&wave.along);
        let reach = ratio.acos();
        let circle = T::pi() + T::pi();
        let into_circle = |angle: T| {
            if angle.to_f64() > 0.0 {
                angle
            } else {
                angle + circle.clone()
            }
        };
        // crest in (-pi, pi], reach in [0, pi]: both angles lie in (-2 pi, 2 pi]
        let [first, second] = [crest.clone() - reach.clone(), crest + reach].map(into_circle);
        let times = if (second.clone() - first.clone()).to_f64() < 0.0 {
            [second, first]
        } else {
            [first, second]
        };
        let rate = wave.rate.clone();
        Turnings::Periodic {
            times: times.map(|angle| angle / rate.clone()),
            period: circle / rate.clone(),
        }
    }

    /// The same without derivative parts.
    pub(super) fn constant(&self) -> Self {
        let waves = self.waves.iter().map(|wave| Wave {
            rate: wave.rate.constant(),
            along: wave.along.constant(),
            across: wave.across.constant(),
        });
        Self {
            waves: waves.collect(),
        }
    }
}

impl<T: Analytic> Wave<T> {
    fn amplitude(&self) -> T {
        let (a, b) = (self.along.clone(), self.across.clone());
        (a.clone() * a + b.clone() * b).sqrt()
    }
}

/// angle - sin(angle), by its series below 1, where the difference would cancel.
fn lag<T: Analytic>(angle: &T, sin: &T) -> T {
    let size = angle.to_f64().abs();
    if size >= 1.0 || size.is_nan() {
        return angle.clone() - sin.clone();
    }
    let square = angle.clone() * angle.clone();
    let mut term = square.clone() * angle.clone() * T::from_ratio(1, 6);
    let mut sum = term.clone();
    // each term is below 1/20 of the one before, so 200 serve any precision of use
    for order in 2..200_i64 {
        term = -(term * square.clone() * T::from_ratio(1, 2 * order * (2 * order + 1)));
        let next = sum.clone() + term.clone();
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Dual, Wide, seeded};
    use std::f64::consts::PI;

    fn several() -> Forcing<f64> {
        let forcing = Forcing::periodic(1.7, &[0.8, 0.0, -0.3], &[0.1, 0.0, 0.2, 0.05]);
        forcing.unwrap_or_else(|_| Forcing::harmonic(&0.0))
    }

    #[test]
    fn the_harmonic_forcing_is_the_papers() {
        let forcing = Forcing::harmonic(&0.4);
        for t in [-3.3, 0.0, 0.1, 0.9, 1.999, 5.2] {
            let forced = forcing.at(&t);
            let (sin, cos) = (PI * t + 0.4).sin_cos();
            assert!((forced.f - cos).abs() < 1e-14);
            assert!((forced.f1 - sin / PI).abs() < 1e-14);
            assert!((forced.f2 + cos / (PI * PI)).abs() < 1e-14);
        }
    }

    #[test]
    fn each_integral_has_the_next_as_its_derivative() {
        let forcing = several().convert(|value| Dual::from_re(*value));
        for t in [0.0, 0.3, 1.1, 1.6] {
            let forced = forcing.at(&seeded(t));
            assert!((forced.f2.eps - forced.f1.re).abs() < 1e-14);
            assert!((forced.f1.eps - forced.f.re).abs() < 1e-14);
        }
    }

    #[test]
    fn growth_is_the_difference_of_the_integrals() {
        for forcing in [several(), Forcing::harmonic(&1.0)] {
            for (t, s) in [(0.2, 0.7), (1.3, 0.01), (0.0, 3.1), (0.6, -0.4)] {
                let (start, end) = (forcing.at(&t), forcing.at(&(t + s)));
                let growth = forcing.ahead(&t).growth(&s);
                assert!((growth.f - end.f).abs() < 1e-14);
                assert!((growth.f1 - (end.f1 - start.f1)).abs() < 1e-14);
                assert!((growth.f2 - (end.f2 - start.f2 - start.f1 * s)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn growth_keeps_its_digits_over_the_shortest_times() {
        let wide = several().convert(|value| Wide::<60>::from_f64(*value));
        for s in [1e-9, 1e-5, 1e-2, 0.2] {
            let growth = several().ahead(&0.8).growth(&s);
            let exact = wide.ahead(&Wide::from_f64(0.8)).growth(&Wide::from_f64(s));
            let apart = |a: f64, b: &Wide<60>| (a / b.to_f64() - 1.0).abs();
            assert!(
                apart(growth.f1, &exact.f1) < 1e-14 && apart(growth.f2, &exact.f2) < 1e-14,
                "{s}"
            );
        }
    }

    #[test]
    fn at_the_turnings_and_nowhere_between_f_plus_g_vanishes() {
        for g in [-0.7, 0.0, 0.122, 0.999] {
            for t in [0.0, 0.4, 1.2, 1.9] {
                let ahead: Ahead<f64> = Forcing::harmonic(&0.3).ahead(&t);
                let Turnings::Periodic {
                    times: [first, second],
                    period,
                } = ahead.turnings(&g)
                else {
                    panic!("one harmonic turns")
                };
                assert!(0.0 < first && first < second && second <= period + 1e-15);
                for time in [first, second, first + period] {
                    assert!((ahead.growth(&time).f + g).abs() < 1e-14);
                }
                let sign = |s: f64| (ahead.growth(&s).f + g).signum();
                assert_eq!(sign(0.5 * first), -sign(0.5 * (first + second)));
            }
        }
    }

    #[test]
    fn beyond_the_amplitude_and_without_a_forcing_nothing_turns() {
        let harmonic = Forcing::harmonic(&0.0);
        assert_eq!(harmonic.ahead(&0.0).turnings(&1.1), Turnings::Never);
        let none = Forcing::periodic(2.0, &[], &[0.0]).map(|none| none.ahead(&0.3).turnings(&0.0));
        assert_eq!(none, Ok(Turnings::Never));
        assert_eq!(several().ahead(&0.0).turnings(&0.0), Turnings::Unknown);
    }

    #[test]
    fn a_bad_period_or_amplitude_is_named() {
        assert!(Forcing::periodic(0.0, &[1.0], &[]).is_err());
        assert!(Forcing::periodic(f64::NAN, &[1.0], &[]).is_err());
        let error =
            Forcing::periodic(2.0, &[1.0], &[0.0, f64::NAN]).map_err(|error| error.to_string());
        assert_eq!(
            error,
            Err("the sine amplitude of harmonic 2 is NaN, must be a finite number".into())
        );
    }

    #[test]
    fn time_is_reduced_into_one_period() {
        let forcing = Forcing::<f64>::harmonic(&0.0);
        assert_eq!(forcing.reduced(&7.25), 1.25);
        assert_eq!(forcing.reduced(&-0.5), 1.5);
        assert!(
            forcing.reduced(&f64::NAN).is_nan() && forcing.reduced(&f64::INFINITY).is_infinite()
        );
    }
}
