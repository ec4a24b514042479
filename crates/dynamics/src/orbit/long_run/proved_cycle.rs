//! The proved periodic motion beside a simulated one.

use crate::impact::Event;
use crate::model::{MotionError, Parameters};
use crate::orbit::equations::words::WordEquations;
use crate::orbit::find::settled;
use crate::orbit::long_run::attractor::Attractor;
use crate::orbit::output::OutputPrecision;
use crate::orbit::rounding::RoundedOrbit;
use crate::orbit::solve::starts::{listed_from, solve_word};
use crate::orbit::solve::words::WordOrbit;
use crate::orbit::word::Word;
use numbers::Interval;
use std::f64::consts::TAU;

/// A simulated cycle is farther from the motion it comes to than its rounding, as long as it still settles; Newton's
/// method that ends farther away went to another one.
const NEAR: f64 = 1e-3;

impl Attractor {
    /// The orbit that the cycle has come to, proved to exist, to attract and to keep off the walls, by Krawczyk's test from
    /// the impacts of the cycle.
    ///
    /// `None` for a cycle through a rest, one of more than [`Word::LONGEST`] impacts, and where there is no proof: near a
    /// bifurcation, or where the cycle is only slow in going elsewhere. `parameters` are those of the motion.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn proved(&self, parameters: &impl Parameters) -> Result<Option<RoundedOrbit>, MotionError> {
        let (Ok(word), Some(periods)) = (self.word.parse::<Word>(), self.periods) else {
            return Ok(None);
        };
        let Ok(periods) = u32::try_from(periods) else {
            return Ok(None);
        };
        let spelled = word.spelled();
        // the word that was read may be spelled from another impact than the cycle is listed from
        let listed = |first: usize| {
            let mut sides = self.impacts.iter().cycle().skip(first).map(|impact| impact.side);
            spelled.sides().all(|side| sides.next() == Some(side))
        };
        let first = (0..word.impacts()).find(|first| listed(*first));
        let system = WordEquations {
            motion: parameters.motion::<Interval<f64>>()?,
            word: spelled,
            periods,
        };
        // counted from the first, however late that is
        let turns = self.impacts.first().map_or(0, |impact| impact.turns);
        let phase = |impact: &Event<f64>| (impact.turns - turns) as f64 * TAU + impact.phase;
        let phases: Vec<f64> = self.impacts.iter().map(phase).collect();
        let start = listed_from(&phases, first.unwrap_or(0), periods);
        let start: Vec<f64> = start
            .iter()
            .map(|phase| phase - TAU * (start[0] / TAU).floor())
            .collect();
        let middle = system.convert(Interval::midpoint)?;
        let Some(found) = solve_word(&middle, start.clone()) else {
            return Ok(None);
        };
        if start.iter().zip(&found).any(|(one, other)| (one - other).abs() > NEAR) {
            return Ok(None);
        }
        let proposed = WordOrbit::near(&system, found);
        if proposed.is_of_shorter_word() {
            return Ok(None);
        }
        let orbit = settled(&OutputPrecision::DOUBLES, parameters, &proposed);
        // beside a fold Newton's method may have gone to the motion that repels
        let attracts = |orbit: &RoundedOrbit| orbit.error_bound.is_some() && orbit.stable && orbit.admissible;
        Ok(orbit.ok().filter(attracts))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::{Start, Widening};
    use crate::model::{Motion, Side};
    use crate::orbit::find::find;
    use crate::orbit::long_run::steady_state::SteadyState;

    fn cycle(motion: Motion<f64>) -> (Motion<f64>, Attractor) {
        let (side, phase, velocity) = (Side::Bottom, 6.18, 0.5293);
        let events = Widening::new(&motion, &Start::impact(side, phase, velocity));
        let cycle = SteadyState::after(events, 500, 60).attractor.expect("a cycle");
        (motion, cycle)
    }

    #[test]
    fn a_cycle_has_the_orbit_that_the_search_finds() {
        let fig03 = |d| Motion::new(0.12201, d, 0.6, 0.3).expect("a motion");
        // the last one is listed from its faster bottom impact, and is spelled from the other
        let turned = Motion::new(-0.275_584_77, 0.326_348_14, 0.477_359_56, 0.313_569_5).expect("a motion");
        for (motion, word) in [
            (fig03(0.26), "BTT"),
            (fig03(0.45), "BT"),
            (fig03(0.22), "BTTT"),
            (turned, "BTTBT"),
        ] {
            let d = *motion.d();
            let (parameters, cycle) = cycle(motion);
            assert_eq!(cycle.word, word, "{d}");
            let orbit = cycle.proved(&parameters).expect("parameters").expect("a proof");
            let periods = u32::try_from(cycle.periods.unwrap()).unwrap();
            let all = find(&parameters, &word.parse().unwrap(), periods)
                .expect("a search")
                .orbits;
            let is_it = |other: &RoundedOrbit| {
                let mut pairs = orbit.phases.iter().zip(&other.phases);
                other.periods == periods && pairs.all(|(one, other)| (one - other).abs() < 1e-12)
            };
            assert!(
                orbit.stable && orbit.admissible && all.iter().any(is_it),
                "{orbit:?} {all:?}"
            );
        }
    }

    #[test]
    fn what_is_no_motion_is_not_proved() {
        let (parameters, mut cycle) = cycle(Motion::new(0.12201, 0.45, 0.6, 0.3).expect("a motion"));
        cycle.impacts[0].phase += 1.0;
        assert_eq!(cycle.proved(&parameters).expect("parameters"), None);
        cycle.word = "BT*".to_owned();
        assert_eq!(cycle.proved(&parameters).expect("parameters"), None);
    }
}
