//! As what motions and bifurcations are wanted, and over which numbers they are computed for it.

use super::bifurcation::Located;
use super::family::Family;
use super::find::Proved;
use super::instant::Instant;
use super::rounded::Rounded;
use super::unsettled::{Question, Unsettled};
use crate::model::{Exact, Parameters};
use crate::model::{Motion, MotionError, Side};
use crate::number::{AtPrecision, Decimal, Decimals, DoubleDouble, Doubles, Interval, Telling, Told, Wide};

/// What becomes of what was proved: rows of numbers, each computed over the narrowest number that will do.
pub trait Wanted: Sync {
    /// As what values are told.
    type Number: Told;

    /// Whether that is f64, of which some things are known that are not known to more digits.
    fn is_double(&self) -> bool {
        false
    }

    /// A motion.
    ///
    /// # Errors
    /// What no number at hand decides, and what else [`Orbit::settle`](super::Orbit::settle) says.
    fn orbit(&self, parameters: &impl Parameters, proved: &Proved) -> Result<Rounded<Self::Number>, Unsettled>;

    /// A bifurcation of motions over so many periods.
    ///
    /// # Errors
    /// What no number at hand decides.
    fn instant(
        &self,
        family: &impl Family,
        periods: u32,
        located: &Located,
    ) -> Result<Instant<Self::Number>, Unsettled>;

    /// g, d, r_B and r_T.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn parameters(&self, parameters: &impl Parameters) -> Result<[Self::Number; 4], MotionError>;

    /// A value known exactly.
    fn value(&self, exact: &impl Exact) -> Self::Number;
}

fn is_open<T>(settled: &Result<T, Unsettled>) -> bool {
    matches!(settled, Err(Unsettled::Undecided { .. }))
}

fn listed<T>(motion: Motion<T>) -> [T; 4]
where
    T: crate::number::Analytic,
{
    let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| motion.restitution(side).clone());
    [motion.g().clone(), motion.d().clone(), r_b, r_t]
}

/// f64, from double-double where that decides all there is to a motion, else from 50 or 200 digits.
impl Wanted for Doubles {
    type Number = f64;

    fn is_double(&self) -> bool {
        true
    }

    fn orbit(&self, parameters: &impl Parameters, proved: &Proved) -> Result<Rounded, Unsettled> {
        let narrow = proved.orbit::<DoubleDouble>(parameters);
        if !is_open(&narrow) {
            return narrow.map(|orbit| orbit.rounded());
        }
        let wide = proved.orbit::<Wide<50>>(parameters);
        if !is_open(&wide) {
            return wide.map(|orbit| orbit.rounded());
        }
        proved.orbit::<Wide<200>>(parameters).map(|orbit| orbit.rounded())
    }

    fn instant(&self, family: &impl Family, periods: u32, located: &Located) -> Result<Instant, Unsettled> {
        let narrow = located.settle::<DoubleDouble>(family, periods);
        if let Ok(enclosed) = narrow {
            return Ok(enclosed.told(self));
        }
        let wide = located.settle::<Wide<50>>(family, periods);
        if let Ok(enclosed) = wide {
            return Ok(enclosed.told(self));
        }
        Ok(located.settle::<Wide<200>>(family, periods)?.told(self))
    }

    fn parameters(&self, parameters: &impl Parameters) -> Result<[f64; 4], MotionError> {
        Ok(listed(parameters.motion()?))
    }

    fn value(&self, exact: &impl Exact) -> f64 {
        exact.value()
    }
}

/// The sizes of [`Wide`] that motions are computed in: each costs a copy of all that proves, to compile and to load.
const SIZES: [usize; 2] = [50, 200];

/// The computation in the least of [`SIZES`] that has at least `digits`.
fn at<C: AtPrecision>(digits: usize, computation: C) -> Option<C::Output> {
    match SIZES.into_iter().find(|size| *size >= digits)? {
        50 => Some(computation.run::<50>()),
        200 => Some(computation.run::<200>()),
        _ => None,
    }
}

/// Digits computed beyond those told: a motion may lose as many.
const BEYOND: usize = 5;

/// The figures of a motion without a proof.
const GUESSED: usize = 15;

/// The most figures that decimals may have: more than the largest [`Wide`] has are not computed.
pub fn most_figures() -> usize {
    SIZES.last().map_or(0, |largest| largest - BEYOND)
}

impl Decimals {
    /// The first answer that holds over wider and wider numbers; else the last one, as it is.
    fn first<C, T>(self, computation: C) -> Result<T, Unsettled>
    where
        C: Clone + AtPrecision<Output = Result<(T, bool), Unsettled>>,
    {
        let sizes = SIZES.into_iter().filter(|size| *size >= self.0 + BEYOND);
        let mut last = Err(Unsettled::Undecided {
            what: Question::Existence,
        });
        for size in sizes {
            match at(size, computation.clone()) {
                Some(Ok((found, true))) => return Ok(found),
                Some(Ok((found, false))) => last = Ok(found),
                Some(settled) if is_open(&settled) => last = last.or_else(|_| settled.map(|(found, _)| found)),
                Some(Err(why)) => return Err(why),
                None => {}
            }
        }
        last
    }
}

/// A motion over many digits.
struct Widened<'a, P> {
    parameters: &'a P,
    proved: &'a Proved<'a>,
    telling: Decimals,
}

/// A bifurcation over many digits.
struct Reached<'a, F> {
    family: &'a F,
    periods: u32,
    located: &'a Located,
    telling: Decimals,
}

/// Exact values over many digits.
struct Listed<'a, P> {
    parameters: &'a P,
    telling: Decimals,
}

/// One exact value over many digits.
struct Single<'a, X> {
    exact: &'a X,
    telling: Decimals,
}

impl<P> Clone for Widened<'_, P> {
    fn clone(&self) -> Self {
        Self { ..*self }
    }
}

impl<F> Clone for Reached<'_, F> {
    fn clone(&self) -> Self {
        Self { ..*self }
    }
}

impl<P: Parameters> AtPrecision for Widened<'_, P> {
    type Output = Result<(Rounded<Decimal>, bool), Unsettled>;

    fn run<const DIGITS: usize>(self) -> Self::Output {
        let orbit = self.proved.orbit::<Wide<DIGITS>>(self.parameters)?;
        if !orbit.certified {
            // the guess is one in f64, and no number of digits helps
            let figures = self.telling.0.min(GUESSED);
            return Ok((orbit.told(&Decimals(figures)), true));
        }
        Ok((orbit.told(&self.telling), orbit.holds(&self.telling)))
    }
}

impl<F: Family> AtPrecision for Reached<'_, F> {
    type Output = Result<(Instant<Decimal>, bool), Unsettled>;

    fn run<const DIGITS: usize>(self) -> Self::Output {
        let enclosed = self.located.settle::<Wide<DIGITS>>(self.family, self.periods)?;
        let told = enclosed.told(&self.telling);
        let holds = told.error_bound.is_some();
        Ok((told, holds))
    }
}

impl<P: Parameters> AtPrecision for Listed<'_, P> {
    type Output = Result<[Decimal; 4], MotionError>;

    fn run<const DIGITS: usize>(self) -> Self::Output {
        let motion = self.parameters.motion::<Interval<Wide<DIGITS>>>()?;
        Ok(listed(motion).map(|value| self.telling.tell(&value)))
    }
}

impl<X: Exact> AtPrecision for Single<'_, X> {
    type Output = Decimal;

    fn run<const DIGITS: usize>(self) -> Decimal {
        self.telling.tell(&self.exact.value::<Interval<Wide<DIGITS>>>())
    }
}

/// Decimals of at most [`most_figures`] figures, from the next size of [`Wide`] with five digits more, and wider ones
/// where these do not suffice.
impl Wanted for Decimals {
    type Number = Decimal;

    fn orbit(&self, parameters: &impl Parameters, proved: &Proved) -> Result<Rounded<Decimal>, Unsettled> {
        let telling = *self;
        self.first(Widened {
            parameters,
            proved,
            telling,
        })
    }

    fn instant(&self, family: &impl Family, periods: u32, located: &Located) -> Result<Instant<Decimal>, Unsettled> {
        let telling = *self;
        self.first(Reached {
            family,
            periods,
            located,
            telling,
        })
    }

    fn parameters(&self, parameters: &impl Parameters) -> Result<[Decimal; 4], MotionError> {
        let telling = *self;
        let told = at(self.0 + BEYOND, Listed { parameters, telling });
        told.unwrap_or_else(|| Ok(std::array::from_fn(|_| Decimal::unknown())))
    }

    fn value(&self, exact: &impl Exact) -> Decimal {
        let telling = *self;
        at(self.0 + BEYOND, Single { exact, telling }).unwrap_or_else(Decimal::unknown)
    }
}
