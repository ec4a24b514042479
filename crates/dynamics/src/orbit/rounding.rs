//! An orbit as numbers of a table, with the bound of its errors.

use crate::orbit::bifurcation::point::not_below_zero;
use crate::orbit::interval_box::larger;
use crate::orbit::orbit::Orbit;
use crate::orbit::stability::{Multiplier, OrbitKind};
use crate::orbit::word::Word;
use numbers::{Doubles, Endpoint, Interval, Rung, Telling, Told};

/// An orbit as numbers: a row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundedOrbit<N = f64> {
    /// See [`Orbit::word`].
    pub word: Word,
    /// See [`Orbit::periods`].
    pub periods: u32,
    /// In [0, 2 pi).
    pub phases: Vec<N>,
    /// Just before each impact.
    pub velocities: Vec<N>,
    /// Of the flight after each impact.
    pub times: Vec<N>,
    /// See [`Orbit::trace`].
    pub trace: N,
    /// See [`Orbit::determinant`].
    pub determinant: N,
    /// See [`Orbit::multipliers`].
    pub multipliers: [Multiplier<N>; 2],
    /// See [`Orbit::kind`].
    pub kind: OrbitKind,
    /// See [`Orbit::stable`].
    pub stable: bool,
    /// See [`Orbit::clearance`]; infinite where nothing turns.
    pub clearance: N,
    /// See [`Orbit::admissible`].
    pub admissible: bool,
    /// No phase, velocity or time above is farther than this from the exact one (a phase: around the circle).
    /// `None` without a proof, and where an enclosure is too wide for the figures of a decimal.
    pub error_bound: Option<N>,
    /// The number type whose enclosures these are of.
    pub computed_in: Rung,
}

impl<N: Told> RoundedOrbit<N> {
    /// The same in f64.
    pub fn nearest(&self) -> RoundedOrbit {
        let list = |values: &[N]| values.iter().map(Told::to_f64).collect();
        RoundedOrbit {
            word: self.word.clone(),
            periods: self.periods,
            phases: list(&self.phases),
            velocities: list(&self.velocities),
            times: list(&self.times),
            trace: self.trace.to_f64(),
            determinant: self.determinant.to_f64(),
            multipliers: self.multipliers.each_ref().map(|multiplier| Multiplier {
                re: multiplier.re.to_f64(),
                im: multiplier.im.to_f64(),
            }),
            kind: self.kind,
            stable: self.stable,
            clearance: self.clearance.to_f64(),
            admissible: self.admissible,
            error_bound: self.error_bound.as_ref().map(Told::to_f64),
            computed_in: self.computed_in,
        }
    }
}

impl<E: Endpoint> Orbit<E> {
    /// The orbit in f64, with the bound of its errors.
    pub fn rounded(&self) -> RoundedOrbit {
        self.told(&Doubles)
    }

    /// Whether `narrow` says so of every enclosure: phases, velocities, times, trace, determinant and clearance.
    pub fn all_are(&self, narrow: impl Fn(&Interval<E>) -> bool) -> bool {
        let lists = [&self.phases, &self.velocities, &self.times].into_iter().flatten();
        let mut all = lists.chain([&self.trace, &self.determinant]).chain(&self.clearance);
        all.all(narrow)
    }

    /// The orbit as `telling` has it, with the bound of its errors; without one where an enclosure is too wide for it.
    pub fn told<T: Telling<E>>(&self, telling: &T) -> RoundedOrbit<T::Number> {
        let tell = |values: &[Interval<E>]| values.iter().map(|value| telling.tell(value)).collect::<Vec<_>>();
        let phases: Vec<T::Number> = self
            .phases
            .iter()
            .map(|value| telling.tell(&not_below_zero(value)))
            .collect();
        let (velocities, times) = (tell(&self.velocities), tell(&self.times));
        let columns = [
            (&self.phases, &phases),
            (&self.velocities, &velocities),
            (&self.times, &times),
        ];
        let pairs = columns.into_iter().flat_map(|(values, told)| values.iter().zip(told));
        let error = pairs
            .map(|(value, told)| telling.error(told, value))
            .fold(E::zero(), larger);
        let known = self.certified && self.all_are(|value| telling.holds(value));
        RoundedOrbit {
            word: self.word.clone(),
            periods: self.periods,
            trace: telling.tell(&self.trace),
            determinant: telling.tell(&self.determinant),
            multipliers: self.multipliers.each_ref().map(|multiplier| Multiplier {
                re: telling.tell(&multiplier.re),
                im: telling.tell(&multiplier.im),
            }),
            kind: self.kind,
            stable: self.stable,
            clearance: self
                .clearance
                .as_ref()
                .map_or_else(Told::infinite, |value| telling.tell(value)),
            admissible: self.admissible,
            phases,
            velocities,
            times,
            error_bound: known.then(|| telling.bound(error)),
            computed_in: E::rung(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::words::search_word;
    use numbers::Field;

    type Line = Interval<f64>;

    #[test]
    fn what_is_printed_is_within_its_bound_and_what_is_not_proved_has_none() {
        let [g, d, r] = [12_201, 26_000, 50_000].map(|n| Line::from_ratio(n, 100_000));
        let motion = Motion::new(g, d, r, r).expect("a motion");
        let cycles = search_word(&Word::pair(), 1, &motion, &OrbitOptions::DEFAULT).expect("a search");
        let orbit = cycles[0].orbit(&motion).expect("decided");
        let row = orbit.rounded();
        let bound = row.error_bound.expect("certified");
        assert!(bound > 0.0 && bound < 1e-12);
        let columns = [
            (&orbit.phases, &row.phases),
            (&orbit.velocities, &row.velocities),
            (&orbit.times, &row.times),
        ];
        for (value, printed) in columns
            .iter()
            .flat_map(|(values, printed)| values.iter().zip(printed.iter()))
        {
            assert!(value.high() - printed <= bound && printed - value.low() <= bound);
        }
        assert_eq!(orbit.uncertified().rounded().error_bound, None);
    }
}
