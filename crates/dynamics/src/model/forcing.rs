//! The forcing: a finite sum of harmonics with zero mean, its integrals, and the view from one instant onwards.

use super::ahead::{Ahead, Forced, Wave};
use numbers::Analytic;
use smallvec::SmallVec;

/// A term `cosine cos(rate t) + sine sin(rate t)`, rate = 2 pi order / period.
#[derive(Clone, Debug, PartialEq)]
struct Harmonic<T> {
    order: i64,
    rate: T,
    /// 1 / rate: kept, because divisions are dear.
    inverse: T,
    cosine: T,
    sine: T,
}

/// f(t), a sum of harmonics of one period. The paper's cos(pi t + phi) is [`Forcing::harmonic`].
///
/// Flights, the map from impact to impact and its Jacobian ([`Flight`](super::Flight), [`next_impact`](super::next_impact()),
/// [`Passage`](super::Passage)) take any such forcing. What simulates, and what looks for periodic motions, takes that of the
/// [`Motion`](super::Motion), of period 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Forcing<T> {
    period: T,
    harmonics: SmallVec<[Harmonic<T>; 1]>,
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

impl<T: Analytic> Harmonic<T> {
    fn new(period: &T, order: i64, cosine: T, sine: T) -> Self {
        let rate = T::from_integer(2 * order) * T::pi() / period.clone();
        let inverse = T::one() / rate.clone();
        Self {
            order,
            rate,
            inverse,
            cosine,
            sine,
        }
    }

    /// The term at `time`, and what it is a quarter of its own period later.
    #[inline]
    fn at(&self, time: &T) -> [T; 2] {
        let (sin, cos) = (self.rate.clone() * time.clone()).sincos();
        let (a, b) = (&self.cosine, &self.sine);
        [
            a.clone() * cos.clone() + b.clone() * sin.clone(),
            b.clone() * cos - a.clone() * sin,
        ]
    }
}

impl<T: Analytic> Forcing<T> {
    /// cos(pi t + phase), of period 2.
    pub fn harmonic(phase: &T) -> Self {
        let (sin, cos) = phase.sincos();
        let period = T::from_integer(2);
        let first = Harmonic::new(&period, 1, cos, -sin);
        Self {
            period,
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
                harmonics.push(Harmonic::new(&period, index as i64 + 1, cosine, sine));
            }
        }
        Ok(Self { period, harmonics })
    }

    /// The period.
    pub fn period(&self) -> &T {
        &self.period
    }

    /// The harmonics, in order: order, cosine amplitude, sine amplitude.
    pub fn harmonics(&self) -> impl ExactSizeIterator<Item = (i64, &T, &T)> {
        let harmonics = self.harmonics.iter();
        harmonics.map(|harmonic| (harmonic.order, &harmonic.cosine, &harmonic.sine))
    }

    /// -f(t - period / 2): odd harmonics stay, even ones change their sign.
    pub(super) fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        for harmonic in mirrored.harmonics.iter_mut().filter(|harmonic| harmonic.order % 2 == 0) {
            harmonic.cosine = -harmonic.cosine.clone();
            harmonic.sine = -harmonic.sine.clone();
        }
        mirrored
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
        let period = convert(&self.period);
        // rates anew: the pi in them has the digits of its number
        let harmonics = self.harmonics.iter().map(|harmonic| {
            let (cosine, sine) = (convert(&harmonic.cosine), convert(&harmonic.sine));
            Harmonic::new(&period, harmonic.order, cosine, sine)
        });
        Forcing {
            harmonics: harmonics.collect(),
            period,
        }
    }

    /// f and its integrals at `time`, to a few roundings of `T` after reducing `time` by whole periods.
    pub fn at(&self, time: &T) -> Forced<T> {
        let mut forced = Forced {
            f: T::zero(),
            f1: T::zero(),
            f2: T::zero(),
        };
        let time = self.centred(time);
        for harmonic in &self.harmonics {
            let [along, across] = harmonic.at(&time);
            let (first, inverse) = (across * harmonic.inverse.clone(), &harmonic.inverse);
            forced.f2 -= along.clone() * inverse.clone() * inverse.clone();
            forced.f += along;
            forced.f1 -= first;
        }
        forced
    }

    /// `time` less the nearest whole period, exactly: just before the end of one the sine is as small as just after.
    fn centred(&self, time: &T) -> T {
        let time = self.reduced(time);
        if time.to_f64() > 0.5 * self.period.to_f64() {
            return time - self.period.clone();
        }
        time
    }

    /// The forcing as it looks from `time` onwards.
    pub fn ahead(&self, time: &T) -> Ahead<T> {
        let time = self.centred(time);
        let waves = self.harmonics.iter().map(|harmonic| {
            let [along, across] = harmonic.at(&time);
            Wave {
                rate: harmonic.rate.clone(),
                inverse: harmonic.inverse.clone(),
                along,
                across,
            }
        });
        Ahead::new(waves.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::{Dual, seeded};
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
    fn a_bad_period_or_amplitude_is_named() {
        assert!(Forcing::periodic(0.0, &[1.0], &[]).is_err());
        assert!(Forcing::periodic(f64::NAN, &[1.0], &[]).is_err());
        let error = Forcing::periodic(2.0, &[1.0], &[0.0, f64::NAN]).map_err(|error| error.to_string());
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
        assert!(forcing.reduced(&f64::NAN).is_nan() && forcing.reduced(&f64::INFINITY).is_infinite());
    }
}
