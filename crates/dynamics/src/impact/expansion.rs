//! A flight expanded about one of its angles.

use super::scaled::{Departure, Scaled};
use super::swing::Swing;
use super::waves::{Gains, Waves};
use numbers::Analytic;

/// The distance from the wall that was left, its rate and the pressure towards that wall, with the forcing; all as seen
/// from that wall, so that the top looks as the bottom does: Y'' = -(f + g).
#[derive(Clone, Debug)]
pub(super) struct Expansion<T, W> {
    /// Y, at least 0 in flight.
    pub y: T,
    /// Y'.
    pub w: T,
    /// f + g: positive where the ball is pressed towards the wall.
    pub push: T,
    pub waves: W,
}

impl<T: Analytic, W: Waves<T>> Expansion<T, W> {
    /// At the departure.
    pub fn start(scaled: &Scaled<T, W>, from: &Departure<T, W>) -> Self {
        let waves = from.waves.clone().seen(from.side);
        Self {
            y: from.height.clone().unwrap_or_else(T::zero),
            w: from.speed.clone(),
            // where the ball is being released f + g vanishes, not only to rounding
            push: if from.released {
                T::zero()
            } else {
                waves.f() + from.side.signed(scaled.g.clone())
            },
            waves,
        }
    }

    /// At an angle `x` after the departure, from the departure, by (3) and (4); `waves` are those there. Cancels where
    /// `x` is small.
    #[inline]
    pub fn far(&self, g: &T, x: &T, waves: W) -> Self {
        let drift = self.w.clone() + self.waves.f1();
        let bent = g.clone() * x.clone();
        let mean = drift.clone() - bent.clone() * T::from_ratio(1, 2);
        Self {
            y: self.y.clone() + (mean * x.clone() + (waves.minus_f2() - self.waves.minus_f2())),
            w: drift - bent - waves.f1(),
            push: waves.f() + g.clone(),
            waves,
        }
    }

    /// The same flight an angle `step` on, of at most the reach of the motion; relative accuracy is kept however short it
    /// is.
    #[inline]
    pub fn after(&self, step: &T, epsilon: f64) -> Self {
        self.swung(step, |angle| Swing::of(angle, epsilon))
    }

    /// The same with the swing of each angle.
    #[inline]
    pub fn swung(&self, step: &T, swing: impl Fn(&T) -> Swing<T>) -> Self {
        let (waves, Gains { f, f1, f2 }) = self.waves.after(step, swing);
        let pressed = self.push.clone() * step.clone();
        let mean = self.w.clone() - pressed.clone() * T::from_ratio(1, 2);
        Self {
            y: self.y.clone() + (mean * step.clone() + f2),
            w: self.w.clone() - pressed + f1,
            push: self.push.clone() - f,
            waves,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::waves::{Cosine, Several};
    use super::*;
    use crate::model::{Forcing, Motion, Side};

    fn one_flight<W: Waves<f64>>(motion: &Motion<f64>) {
        for (side, phase, speed) in [(Side::Bottom, 0.4, 0.9), (Side::Top, 3.0, 0.0), (Side::Top, 5.0, 2.0)] {
            let scaled = Scaled::<f64, W>::new(motion);
            let from = Departure {
                side,
                phase,
                waves: W::at(&scaled.drive, &phase),
                speed,
                height: None,
                released: false,
            };
            let start = Expansion::start(&scaled, &from);
            let g = side.signed(*motion.g());
            for x in [0.05, 0.3, 0.49, -0.2].map(|part| part * scaled.reach / 0.5) {
                let far = start.far(&g, &x, scaled.seen(side, &(phase + x)));
                let after = start.after(&x, f64::EPSILON);
                for (a, b) in [
                    (far.y, after.y),
                    (far.w, after.w),
                    (far.push, after.push),
                    (far.waves.f1(), after.waves.f1()),
                    (far.waves.minus_f2(), after.waves.minus_f2()),
                    (far.waves.minus_slope(), after.waves.minus_slope()),
                    (far.waves.minus_curvature(), after.waves.minus_curvature()),
                ] {
                    assert!((a - b).abs() < 2e-15 * scaled.bounds.bend, "{side} {x}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn a_short_step_and_the_closed_form_are_one_flight() {
        for g in [0.12, -0.7, 1.3] {
            let motion = Motion::new(g, 0.4, 0.6, 0.3).expect("a motion");
            one_flight::<Cosine<f64>>(&motion);
            let forcing = Forcing::periodic(2.0, &[0.9, -0.3, 0.2], &[0.1, 0.2, 0.0, 0.05]).expect("a forcing");
            one_flight::<Several<f64>>(&motion.with_forcing(forcing).expect("of period 2"));
        }
    }
}
