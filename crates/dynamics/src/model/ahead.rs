//! The forcing from one instant onwards: its integrals over a flight, and when f + g changes sign.

use numbers::Analytic;
use smallvec::SmallVec;

/// `along cos(rate s) + across sin(rate s)`, s the time since the instant.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wave<T> {
    pub rate: T,
    /// 1 / rate.
    pub inverse: T,
    pub along: T,
    pub across: T,
}

/// A forcing from one instant t onwards, as a function of the time s since then.
///
/// Integrals are taken from the instant, by formulas that keep their relative accuracy however short s is;
/// differences of F_1 and F_2 lose all digits there.
#[derive(Clone, Debug, PartialEq)]
pub struct Ahead<T> {
    waves: SmallVec<[Wave<T>; 1]>,
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
    pub(super) fn new(waves: SmallVec<[Wave<T>; 1]>) -> Self {
        Self { waves }
    }

    /// f(t), at the instant itself.
    pub fn now(&self) -> T {
        self.waves.iter().fold(T::zero(), |sum, wave| sum + wave.along.clone())
    }

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
            let inverse = wave.inverse.clone();
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
        let slopes = self.waves.iter().map(|wave| wave.amplitude() * wave.rate.clone());
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
            inverse: wave.inverse.constant(),
            along: wave.along.constant(),
            across: wave.across.constant(),
        });
        Self { waves: waves.collect() }
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
    use super::super::Forcing;
    use super::*;
    use numbers::Wide;

    fn several() -> Forcing<f64> {
        let forcing = Forcing::periodic(1.7, &[0.8, 0.0, -0.3], &[0.1, 0.0, 0.2, 0.05]);
        forcing.unwrap_or_else(|_| Forcing::harmonic(&0.0))
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
}
