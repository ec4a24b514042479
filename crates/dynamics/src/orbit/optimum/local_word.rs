//! Good devices for motions of any word, by local search in f64, and the proof of the one that is returned.

use crate::model::{Motion, MotionError};
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::optimum::design::{Choice, Devices};
use crate::orbit::optimum::incumbent::climb;
use crate::orbit::orbit::{Orbit, flight_jacobians};
use crate::orbit::solve::starts::solve_word;
use crate::orbit::solve::words::{WordOrbit, moves, search_word_from};
use crate::orbit::stability::{determinant, trace};
use crate::orbit::word::Word;
use numbers::{Analytic, Interval, Sequence};

/// A device of the choice with a motion of a word that is proved to be there, stable and admissible as asked.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedWordDevice {
    /// The parameters of the capsule, r_B, r_T: numbers of f64, or enclosures of an end of a range.
    pub parameters: [Interval; 4],
    /// The motion, every value enclosed.
    pub orbit: Orbit<f64>,
    /// Volts per forcing period, of all impacts.
    pub rate: Interval,
}

/// A device and a motion of it, in f64: likely, not proved.
#[derive(Clone, Debug)]
struct Candidate {
    parameters: [f64; 4],
    periods: u32,
    phases: Vec<f64>,
    rate: f64,
}

/// Random devices that motions are looked for at, and the starts at each, for each impact and forcing period.
const DRAWN: usize = 60;
const STARTS: usize = 64;

/// The devices that are improved.
const CLIMBED: usize = 6;

/// Slacks in f64 below this are left to the bounds: rounding could have made them.
const LEAST_SLACK: f64 = 1e-9;

/// Searches for the best device with stable and admissible motions of a word, by volts per forcing period, and proves
/// its motion; `None` where it finds none, which proves nothing. `base` gives the forcing and the number of walls;
/// its other parameters are those of the choice.
///
/// **It is not claimed to be the best of the choice**: the search is local, from random devices, the same each time.
///
/// # Errors
/// `NoTop` for a word with T of motions with one wall.
pub fn local_optimum(
    choice: &Choice,
    base: &Motion<Interval<f64>>,
    word: &Word,
) -> Result<Option<ProvedWordDevice>, MotionError> {
    let search = Search {
        choice,
        base,
        word: word.spelled(),
        devices: choice.devices.convert(Interval::midpoint),
    };
    let mut sequence = Sequence::new(49);
    let mut found = Vec::new();
    for _ in 0..DRAWN {
        let ranges = choice.ranges.each_ref().map(|range| range.hull());
        let parameters = ranges.map(|hull| sequence.between(hull.low(), hull.high()));
        for periods in 1..=choice.max_periods {
            found.extend(search.at(parameters, periods)?);
        }
        if !stop::goes_on() {
            break;
        }
    }
    found.sort_by(|one, other| other.rate.total_cmp(&one.rate));
    found.truncate(CLIMBED);
    let near = |parameters, best: &Candidate| search.near(parameters, best.periods, &best.phases);
    let rated = |candidate: &Candidate| (candidate.parameters, candidate.rate);
    let climbed = found
        .into_iter()
        .map(|start| climb(&choice.ranges, &mut sequence, start, rated, near));
    let mut climbed: Vec<Candidate> = climbed.collect();
    climbed.sort_by(|one, other| other.rate.total_cmp(&one.rate));
    Ok(climbed.iter().find_map(|candidate| search.prove(candidate)))
}

struct Search<'a> {
    choice: &'a Choice,
    base: &'a Motion<Interval<f64>>,
    word: Word,
    devices: Devices<f64>,
}

impl Search<'_> {
    /// Returns the motion of a device, over the number of its parameters, which the amplitudes of the forcing are
    /// converted to.
    fn motion<T: Analytic>(
        &self,
        devices: &Devices<T>,
        [first, second, r_b, r_t]: &[T; 4],
        convert: impl Fn(&Interval<f64>) -> T,
    ) -> Option<Motion<T>> {
        let [d, g] = devices.capsule([first, second]);
        let motion = match self.base.has_top() {
            true => Motion::new(g, d, r_b.clone(), r_t.clone()),
            false => Motion::one_wall(g, r_b.clone()),
        };
        match self.base.other_forcing() {
            None => motion.ok(),
            Some(forcing) => motion.ok()?.with_forcing(forcing.convert(convert)).ok(),
        }
    }

    /// Returns the values that are nearest to these in their ranges.
    fn nearest(&self, parameters: [f64; 4]) -> [Interval; 4] {
        std::array::from_fn(|i| self.choice.ranges[i].nearest(parameters[i]))
    }

    /// Searches for motions of a device that are as asked.
    ///
    /// # Errors
    /// Those of [`search_word_from`].
    fn at(&self, parameters: [f64; 4], periods: u32) -> Result<Vec<Candidate>, MotionError> {
        let parameters = self.nearest(parameters).map(|side| side.midpoint());
        let Some(motion) = self.motion(&self.devices, &parameters, Interval::midpoint) else {
            return Ok(Vec::new());
        };
        let count = STARTS * self.word.impacts() * periods as usize;
        let line = motion.convert(|value| Interval::point(*value))?;
        let found = search_word_from(count, &self.word, periods, &line)?;
        let near = |orbit: &WordOrbit| self.near(parameters, periods, orbit.phases());
        Ok(found.iter().filter_map(near).collect())
    }

    /// Returns the motion of a device near known phases, if it is as asked.
    fn near(&self, parameters: [f64; 4], periods: u32, phases: &[f64]) -> Option<Candidate> {
        let parameters = self.nearest(parameters).map(|side| side.midpoint());
        let system = WordEquations {
            motion: self.motion(&self.devices, &parameters, Interval::midpoint)?,
            word: self.word.clone(),
            periods,
        };
        let phases = solve_word(&system, phases.to_vec()).filter(|phases| moves(&system, phases))?;
        let impacts = system.orbit_impacts(&phases);
        let sides: Vec<_> = system.word.sides().collect();
        let jacobians = flight_jacobians(&sides, &system.motion, &impacts);
        let slack = 1.0 + determinant(&jacobians) - trace(&jacobians).abs() - self.choice.margin.high();
        let functions = TestFunctions::new(&system, &phases);
        let clear = functions.clearance() - self.choice.clearance.high();
        if !(functions.moves() && slack > LEAST_SLACK && clear > LEAST_SLACK) {
            return None;
        }
        let rate = rate(&self.devices, &parameters[0], &functions.speeds, periods);
        Some(Candidate {
            parameters,
            periods,
            phases,
            rate,
        })
    }

    /// Proves that there is this motion and that it is as asked; `None` where that cannot be decided, or is not so.
    fn prove(&self, candidate: &Candidate) -> Option<ProvedWordDevice> {
        let parameters = self.nearest(candidate.parameters);
        let motion = self.motion(&self.choice.devices, &parameters, Interval::clone)?;
        let system = WordEquations {
            motion: motion.clone(),
            word: self.word.clone(),
            periods: candidate.periods,
        };
        let found = WordOrbit::near(&system, candidate.phases.clone());
        let orbit = found.orbit::<f64>(&motion).ok()?;
        let slack = Interval::point(1.0) + orbit.determinant - self.choice.margin - orbit.trace.size();
        let is_clear = match &orbit.clearance {
            None => true,
            Some(clearance) => (*clearance - self.choice.clearance).low() >= 0.0,
        };
        let is_new = !found.is_of_shorter_word();
        if !(is_new && orbit.certified && orbit.stable && orbit.admissible && is_clear && slack.low() >= 0.0) {
            return None;
        }
        let speeds: Vec<_> = orbit
            .word
            .sides()
            .zip(&orbit.velocities)
            .map(|(side, v)| side.signed(*v))
            .collect();
        let rate = rate(&self.choice.devices, &parameters[0], &speeds, candidate.periods);
        rate.is_finite().then_some(ProvedWordDevice {
            parameters,
            orbit,
            rate,
        })
    }
}

/// Returns the sum of the voltages of all impacts for each forcing period.
fn rate<T: Analytic>(devices: &Devices<T>, first: &T, speeds: &[T], periods: u32) -> T {
    let unit = devices.unit(first);
    let voltages = speeds
        .iter()
        .map(|speed| devices.membrane.voltage(&(speed.clone() * unit.clone())));
    voltages.fold(T::zero(), |sum, voltage| sum + voltage) / T::from_integer(i64::from(periods))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Forcing;
    use crate::orbit::find::find;
    use crate::orbit::optimum::paper_choice;
    use crate::orbit::optimum::search::{OptimumLimits, OptimumPart, optimum};
    use std::f64::consts::PI;

    fn enclosed(base: &Motion<f64>) -> Motion<Interval<f64>> {
        base.convert(|value| Interval::point(*value)).expect("a motion")
    }

    fn best(choice: &Choice, base: &Motion<f64>, word: &str) -> ProvedWordDevice {
        let found = local_optimum(choice, &enclosed(base), &word.parse().expect("a word")).expect("a search");
        found.expect("a device")
    }

    #[test]
    fn the_local_optimum_of_1_1_motions_is_the_proved_one() {
        let choice = paper_choice([[0.25, 0.5], [0.1, 0.15], [0.4, 0.7], [0.3, 0.5]]);
        let base = Motion::new(0.1, 0.3, 0.5, 0.5).expect("a motion");
        let limits = OptimumLimits {
            gap: 1e-3,
            most_boxes: 100_000,
            part: OptimumPart::WHOLE,
        };
        let proved = optimum(&choice, limits, |_| ());
        let found = best(&choice, &base, "BT");
        let least = proved.device.expect("a device").rate.low();
        assert!(
            found.rate.low() <= proved.most && found.rate.high() > 0.998 * least,
            "{} {least}",
            found.rate
        );
    }

    #[test]
    fn under_harmonics_no_sampled_device_is_better() {
        let ranges = [[0.15, 0.4], [0.1, 0.2], [0.4, 0.7], [0.3, 0.5]];
        let choice = paper_choice(ranges);
        let forcing = Forcing::periodic(2.0, &[1.0, 0.2], &[0.1, 0.0, 0.1]).expect("a forcing");
        let base = Motion::new(0.1, 0.3, 0.5, 0.5).expect("a motion");
        let base = base.with_forcing(forcing.clone()).expect("of period 2");
        let word = "BTT";
        let found = best(&choice, &base, word);
        assert!(found.orbit.certified && found.orbit.stable && found.orbit.admissible);
        let devices = choice.devices.convert(Interval::midpoint);
        let mut sequence = Sequence::new(1);
        let mut compared = 0;
        for _ in 0..60 {
            let [d, g, r_b, r_t] = ranges.map(|[low, high]| sequence.between(low, high));
            let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
            let motion = motion.with_forcing(forcing.clone()).expect("of period 2");
            let orbits = find(&motion, &word.parse().expect("a word"), 1)
                .expect("a search")
                .orbits;
            for orbit in orbits.iter().filter(|orbit| orbit.stable && orbit.admissible) {
                let unit = devices.unit(&d);
                let voltages = orbit
                    .velocities
                    .iter()
                    .map(|v| devices.membrane.voltage(&(v.abs() * unit)));
                assert!(voltages.sum::<f64>() < found.rate.high(), "{motion:?}");
                compared += 1;
            }
        }
        assert!(compared > 3, "{word} {compared}");
    }

    #[test]
    fn the_best_ball_on_a_table_is_where_the_fold_meets_the_end_of_the_range() {
        // v = 2 g / (1 + r), and g is at most that of the fold, (1 + r) / (pi (1 - r)), and 1.2
        let choice = paper_choice([[1.0, 1.0], [0.5, 1.2], [0.5, 0.7], [0.5, 0.5]]);
        let base = Motion::one_wall(1.0, 0.5).expect("a motion");
        let found = best(&choice, &base, "B");
        let velocity = 2.4 / (1.0 + (1.2 * PI - 1.0) / (1.2 * PI + 1.0));
        let off = found.orbit.velocities[0].midpoint() / velocity - 1.0;
        assert!(off < 1e-9 && off > -1e-3, "{off}");
        let top = local_optimum(&choice, &enclosed(&base), &Word::pair());
        assert_eq!(top.err(), Some(MotionError::NoTop));
    }
}
