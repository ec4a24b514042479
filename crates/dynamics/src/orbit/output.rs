//! As what motions and bifurcations are wanted, and over which numbers they are computed for it.

use crate::model::{Exact, Parameters};
use crate::model::{Motion, MotionError, Side};
use crate::orbit::bifurcation::one_one::LocatedBifurcation;
use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::family::Family;
use crate::orbit::inconclusive::{Inconclusive, Property};
use crate::orbit::options::OrbitOptions;
use crate::orbit::proved_orbit::ProvedOrbit;
use crate::orbit::rounding::RoundedOrbit;
use numbers::{
    Decimal, Decimals, Digits, DoubleDouble, Doubles, Endpoint, FIGURES_OF_F64, Interval, Rung, Supported, Telling,
    Told, at_digits,
};

/// What becomes of what was proved: rows of numbers, each computed over the narrowest number that will do.
pub trait Output: Sync {
    /// As what values are told.
    type Number: Told;

    /// Whether that is f64, of which some things are known that are not known to more digits.
    fn is_double(&self) -> bool {
        false
    }

    /// How far searches for what is told go.
    fn options(&self) -> &OrbitOptions;

    /// A motion.
    ///
    /// # Errors
    /// What no number at hand decides, and what else [`Orbit::from_impacts`](crate::orbit::Orbit::from_impacts) says.
    fn orbit(
        &self,
        parameters: &impl Parameters,
        proved: &ProvedOrbit,
    ) -> Result<RoundedOrbit<Self::Number>, Inconclusive>;

    /// A bifurcation of motions over so many periods.
    ///
    /// # Errors
    /// What no number at hand decides.
    fn bifurcation(
        &self,
        family: &impl Family,
        periods: u32,
        located: &LocatedBifurcation,
    ) -> Result<BifurcationPoint<Self::Number>, Inconclusive>;

    /// g, d, r_B and r_T.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn parameters(&self, parameters: &impl Parameters) -> Result<[Self::Number; 4], MotionError>;

    /// A value known exactly.
    fn value(&self, exact: &impl Exact) -> Self::Number;
}

fn listed<T>(motion: Motion<T>) -> [T; 4]
where
    T: numbers::Analytic,
{
    let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| motion.restitution(side).clone());
    [motion.g().clone(), motion.d().clone(), r_b, r_t]
}

/// How values are told, to how many digits they are to hold, and the number type to begin with: where its enclosures
/// decide too little or are too wide, the next wider one is taken.
///
/// `T` is [`Doubles`] or [`Decimals`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputPrecision<T> {
    telling: T,
    digits: u32,
    first: Rung,
    options: OrbitOptions,
}

impl OutputPrecision<Doubles> {
    /// As many digits as f64 shows.
    pub const DOUBLES: Self = Self {
        telling: Doubles,
        digits: FIGURES_OF_F64,
        first: Rung::DoubleDouble,
        options: OrbitOptions::DEFAULT,
    };

    /// f64 of which `digits` hold, at most [`FIGURES_OF_F64`]. `first` is the narrowest number that may do: a wrong
    /// choice costs time and no digit.
    pub fn doubles(digits: u32, first: Rung) -> Self {
        Self {
            telling: Doubles,
            digits: digits.min(FIGURES_OF_F64),
            first: first.max(Rung::Double),
            options: OrbitOptions::DEFAULT,
        }
    }
}

impl OutputPrecision<Decimals> {
    /// Decimals of so many figures, at most [`most_figures`].
    pub fn decimals(figures: Decimals, first: Rung) -> Self {
        Self {
            telling: figures,
            digits: u32::try_from(figures.0).unwrap_or(u32::MAX),
            first: first.max(Rung::DoubleDouble),
            options: OrbitOptions::DEFAULT,
        }
    }
}

/// Digits that a number has beyond the most figures told of it: a motion may lose as many.
const BEYOND: u32 = 5;

/// The most figures that decimals may have: more than the widest number has are not computed.
pub fn most_figures() -> usize {
    let widest = Rung::ALL.into_iter().map(Rung::digits).max();
    widest.map_or(0, |digits| (digits - BEYOND) as usize)
}

impl<T> OutputPrecision<T> {
    /// The same, searched for with other tolerances and limits.
    pub fn searched(self, options: &OrbitOptions) -> Self {
        Self {
            options: *options,
            ..self
        }
    }

    /// The first answer that holds over wider and wider numbers; else the last one, as it is.
    fn climb<R>(&self, attempt: impl Fn(Rung) -> Result<(R, bool), Inconclusive>) -> Result<R, Inconclusive> {
        let mut last = Err(Inconclusive::Undecided {
            what: Property::Existence,
        });
        for rung in self.first.and_wider() {
            match attempt(rung) {
                Ok((found, true)) => return Ok(found),
                Ok((found, false)) => last = Ok(found),
                Err(open @ Inconclusive::Undecided { .. }) => last = last.or(Err(open)),
                Err(why) => return Err(why),
            }
        }
        last
    }
}

/// A motion over `E` as `telling` has it, one without a proof as `guess` has it, and whether that will do.
fn orbit_over<E: Endpoint, T: Telling<E>>(
    (parameters, proved): (&impl Parameters, &ProvedOrbit),
    (telling, guess): (&T, &impl Telling<E, Number = T::Number>),
    holds: impl Fn(&Interval<E>) -> bool,
) -> Result<(RoundedOrbit<T::Number>, bool), Inconclusive> {
    let orbit = proved.orbit::<E>(parameters)?;
    let enough = orbit.all_are(holds);
    let told = if orbit.certified {
        orbit.told(telling)
    } else {
        orbit.told(guess)
    };
    Ok((told, enough))
}

/// A bifurcation over a number of `rung`, and whether its values hold the figures of the rounding.
fn bifurcation_over<N, R>(
    located: &LocatedBifurcation,
    family: &impl Family,
    periods: u32,
    rung: Rung,
    rounding: &R,
) -> Result<(BifurcationPoint<N>, bool), Inconclusive>
where
    R: Telling<DoubleDouble, Number = N> + Telling<Digits, Number = N>,
{
    let point = match rung {
        Rung::Wide(digits) => at_digits(digits, || {
            let enclosed = located.enclosed::<Digits>(family, periods)?;
            Ok(enclosed.rounded(rounding))
        }),
        _ => located
            .enclosed::<DoubleDouble>(family, periods)
            .map(|enclosed| enclosed.rounded(rounding)),
    }?;
    let holds = point.error_bound.is_some();
    Ok((point, holds))
}

/// Whether an enclosure has so many digits; what may be 0, that many behind the point.
fn has_digits<E: Endpoint>(value: &Interval<E>, digits: u32) -> bool {
    let part = 10_f64.powi(-i32::try_from(digits).unwrap_or(i32::MAX));
    if value.contains_zero() {
        value.magnitude().to_f64() <= part
    } else {
        value.radius().to_f64() <= part * value.mignitude().to_f64()
    }
}

impl Output for OutputPrecision<Doubles> {
    type Number = f64;

    fn is_double(&self) -> bool {
        true
    }

    fn options(&self) -> &OrbitOptions {
        &self.options
    }

    fn orbit(&self, parameters: &impl Parameters, proved: &ProvedOrbit) -> Result<RoundedOrbit, Inconclusive> {
        let (what, digits, telling) = ((parameters, proved), self.digits, (&Doubles, &Supported));
        self.climb(|rung| match rung {
            Rung::Single | Rung::Double => orbit_over::<f64, _>(what, telling, |value| has_digits(value, digits)),
            Rung::DoubleDouble => orbit_over::<DoubleDouble, _>(what, telling, |value| has_digits(value, digits)),
            Rung::Wide(set) => at_digits(set, || {
                orbit_over::<Digits, _>(what, telling, |value| has_digits(value, digits))
            }),
        })
    }

    fn bifurcation(
        &self,
        family: &impl Family,
        periods: u32,
        located: &LocatedBifurcation,
    ) -> Result<BifurcationPoint, Inconclusive> {
        let from_narrow = Self {
            first: self.first.max(Rung::DoubleDouble),
            ..*self
        };
        from_narrow.climb(|rung| bifurcation_over(located, family, periods, rung, &Doubles))
    }

    fn parameters(&self, parameters: &impl Parameters) -> Result<[f64; 4], MotionError> {
        Ok(listed(parameters.motion()?))
    }

    fn value(&self, exact: &impl Exact) -> f64 {
        exact.value()
    }
}

/// Decimals of at most [`most_figures`] figures; a motion without a proof has fewer.
impl Output for OutputPrecision<Decimals> {
    type Number = Decimal;

    fn options(&self) -> &OrbitOptions {
        &self.options
    }

    fn orbit(&self, parameters: &impl Parameters, proved: &ProvedOrbit) -> Result<RoundedOrbit<Decimal>, Inconclusive> {
        let (what, telling) = ((parameters, proved), (&self.telling, &self.telling));
        self.climb(|rung| match rung {
            Rung::Wide(digits) => at_digits(digits, || {
                orbit_over::<Digits, _>(what, telling, |value| self.telling.holds(value))
            }),
            _ => orbit_over::<DoubleDouble, _>(what, telling, |value| self.telling.holds(value)),
        })
    }

    fn bifurcation(
        &self,
        family: &impl Family,
        periods: u32,
        located: &LocatedBifurcation,
    ) -> Result<BifurcationPoint<Decimal>, Inconclusive> {
        self.climb(|rung| bifurcation_over(located, family, periods, rung, &self.telling))
    }

    fn parameters(&self, parameters: &impl Parameters) -> Result<[Decimal; 4], MotionError> {
        at_digits(self.digits + BEYOND, || {
            let motion = parameters.motion::<Interval<Digits>>()?;
            Ok(listed(motion).map(|value| self.telling.tell(&value)))
        })
    }

    fn value(&self, exact: &impl Exact) -> Decimal {
        at_digits(self.digits + BEYOND, || {
            self.telling.tell(&exact.value::<Interval<Digits>>())
        })
    }
}

impl<E: Endpoint, T: Telling<E>> Telling<E> for OutputPrecision<T> {
    type Number = T::Number;

    fn tell(&self, value: &Interval<E>) -> T::Number {
        self.telling.tell(value)
    }

    fn error(&self, told: &T::Number, value: &Interval<E>) -> E {
        self.telling.error(told, value)
    }

    fn bound(&self, error: E) -> T::Number {
        self.telling.bound(error)
    }

    fn holds(&self, value: &Interval<E>) -> bool {
        self.telling.holds(value)
    }
}
