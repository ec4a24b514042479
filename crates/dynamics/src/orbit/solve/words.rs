//! The search for periodic motions of any word: from many starts, each proved by itself.

use crate::model::{Motion, MotionError, Side};
use crate::orbit::equations::words::WordEquations;
use crate::orbit::inconclusive::Inconclusive;
use crate::orbit::interval_box::apart;
use crate::orbit::options::OrbitOptions;
use crate::orbit::orbit::Orbit;
use crate::orbit::solve::certify::{Proof, approached, prove};
use crate::orbit::solve::starts::{brought_near, listed_from, solve_word, starts};
use crate::orbit::word::Word;
use numbers::{Analytic, Endpoint, Interval, Wide};
use stop;

/// Proposals without a proof that are no farther apart are told once: around a point where three motions meet, as at
/// a period doubling, rounding hides the residual within the cube root of 2^-52, times its condition.
const SCATTER: f64 = 1e-4;

/// A velocity of a proposal that points away from its wall by more than this is no rounding, and a flight that lasts
/// less is none: Newton's method went on to where two impacts are one.
const NOISE: f64 = 1e-9;

/// A periodic motion found, before its stability and clearance are asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct WordOrbit {
    word: Word,
    periods: u32,
    phases: Vec<f64>,
    proof: Option<Proof>,
}

/// All periodic motions of `word` over `periods` forcing periods that Newton's method leads to from some
/// [`word_starts`](OrbitOptions::word_starts) an impact and a period, over the whole of the phases and times that the word allows. Stable or not, admissible or
/// not. The proof is for every motion within the intervals of `motion`, rounded to f64.
///
/// **Completeness is not claimed**: a motion may attract none of the starts. What is found is certain: each is proved
/// to exist, alone in a box, or says that it is not ([`WordOrbit::is_certified`]), as next to a fold, where two motions
/// meet. Two motions are told apart by their boxes. Those of a shorter word (BT twice, for BTBT) are left out, and
/// those whose velocities point away from a wall by more than rounding. The answer is the same each time. A word of
/// twelve impacts takes some seconds; of the simulated cycles of 7 to 12 impacts of random devices every one was found.
///
/// # Errors
/// A parameter whose middle is out of its range; `NoTop` for a word with T of a motion with one wall.
pub fn search_word<E: Endpoint>(
    word: &Word,
    periods: u32,
    motion: &Motion<Interval<E>>,
    options: &OrbitOptions,
) -> Result<Vec<WordOrbit>, MotionError> {
    let count = options.word_starts as usize * word.impacts() * periods as usize;
    search_word_from(count, word, periods, motion)
}

/// As [`search_word`], from as many starts as asked for.
///
/// # Errors
/// As [`search_word`].
pub fn search_word_from<E: Endpoint>(
    count: usize,
    word: &Word,
    periods: u32,
    motion: &Motion<Interval<E>>,
) -> Result<Vec<WordOrbit>, MotionError> {
    if !motion.has_top() && word.sides().any(|side| side == Side::Top) {
        return Err(MotionError::NoTop);
    }
    let system = WordEquations {
        motion: motion.convert(around)?,
        word: word.spelled(),
        periods,
    };
    let middle = system.convert(Interval::midpoint)?;
    if lacks_gravity(&system) {
        return Ok(Vec::new());
    }
    let mut found: Vec<WordOrbit> = Vec::new();
    for start in starts(&middle, count) {
        if !stop::goes_on() {
            break;
        }
        let Some(phases) = solve_word(&middle, start).filter(|phases| moves(&middle, phases)) else {
            continue;
        };
        let phases = brought_near(&phases, std::f64::consts::PI);
        if found.iter().any(|cycle| cycle.covers(&phases)) {
            continue;
        }
        let cycle = WordOrbit::near(&system, phases);
        if !cycle.is_of_shorter_word() && !found.iter().any(|other| other.is_same(&cycle)) {
            found.push(cycle);
        }
    }
    Ok(found)
}

/// The narrowest interval of f64 around another one.
fn around<E: Endpoint>(interval: &Interval<E>) -> Interval<f64> {
    let (low, high) = (interval.low(), interval.high());
    let (below, above) = (low.to_f64(), high.to_f64());
    let below = if E::from_f64(below) <= low {
        below
    } else {
        below.next_down()
    };
    let above = if E::from_f64(above) >= high {
        above
    } else {
        above.next_up()
    };
    Interval::new(below, above)
}

/// Whether a proposal looks like a motion at all.
pub(crate) fn moves(system: &WordEquations<f64>, phases: &[f64]) -> bool {
    let fixes = system.orbit_impacts(phases);
    let mut impacts = system.word.sides().zip(&fixes);
    impacts.all(|(side, fix)| side.signed(fix.velocity) > -NOISE && fix.time > NOISE)
}

/// Whether a word on one wall asks for gravity towards that wall, and there is none: over a motion the impulses of
/// its impacts, (1 + r) times each velocity, add up to 2 n g, since the forcing gives nothing. So without a search.
fn lacks_gravity(system: &WordEquations<Interval<f64>>) -> bool {
    let mut sides = system.word.sides();
    let Some(first) = sides.next() else { return true };
    sides.all(|side| side == first) && first.signed(*system.motion.g()).high() <= 0.0
}

impl WordOrbit {
    /// The motion at phases that Newton's method settled at, proved if it can be.
    pub(crate) fn near(system: &WordEquations<Interval<f64>>, phases: Vec<f64>) -> Self {
        let (proof, phases) = match prove(system, &phases) {
            Some(proof) => (Some(proof), phases),
            None => Self::in_more_digits(system, phases),
        };
        Self {
            word: system.word.clone(),
            periods: system.periods,
            proof,
            phases,
        }
    }

    /// The same in more digits, where rounding in f64 may be all that is in the way.
    fn in_more_digits(system: &WordEquations<Interval<f64>>, phases: Vec<f64>) -> (Option<Proof>, Vec<f64>) {
        type Digits = Wide<50>;
        let ends = |value: &Interval<f64>| {
            let [low, high] = [value.low(), value.high()].map(Digits::from_f64);
            Interval::new(low, high)
        };
        let Ok(system) = system.convert(ends) else {
            return (None, phases);
        };
        let near = approached(&system, &phases)
            .iter()
            .map(Analytic::to_f64)
            .collect::<Vec<_>>();
        match prove(&system, &near) {
            Some(proof) => (Some(proof), near),
            None => (None, phases),
        }
    }

    /// Of its impacts, in the order of its word.
    pub(crate) fn phases(&self) -> &[f64] {
        &self.phases
    }

    /// Its word, in the spelling that all its rotations share.
    pub fn word(&self) -> &Word {
        &self.word
    }

    /// The forcing periods it takes.
    pub fn periods(&self) -> u32 {
        self.periods
    }

    /// Whether it is proved that there is such a motion, and one only in the box around it.
    pub fn is_certified(&self) -> bool {
        self.proof.is_some()
    }

    /// The orbit over the number `E`, at the motion that was searched: the intervals of `motion` inside those.
    ///
    /// # Errors
    /// `Undecided` where `E` is too narrow to decide all there is to an orbit; `Backwards` where a velocity turns out
    /// to point away from its wall: no orbit.
    pub fn orbit<E: Endpoint>(&self, motion: &Motion<Interval<E>>) -> Result<Orbit<E>, Inconclusive> {
        let system = WordEquations {
            motion: motion.clone(),
            word: self.word.clone(),
            periods: self.periods,
        };
        let phases = match &self.proof {
            Some(proof) => proof.refined(&system),
            None => approached(&system, &self.phases),
        };
        let orbit = Orbit::from_impacts(&self.word, self.periods, motion, &system.orbit_impacts(&phases))?;
        Ok(if self.is_certified() {
            orbit
        } else {
            orbit.uncertified()
        })
    }

    /// Whether a proposal is this motion: well inside its box, or, without a proof, close by.
    fn covers(&self, phases: &[f64]) -> bool {
        let room = self.proof.as_ref().map_or(SCATTER, |proof| 0.5 * proof.radius);
        self.listings(phases).any(|listed| apart(&listed, &self.phases) < room)
    }

    /// Whether another motion found is this one.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let (Some(proof), Some(others)) = (&self.proof, &other.proof) else {
            // one of them in doubt: the proposal was not in the box, and so is told by itself
            return false;
        };
        let mut listings = self.listings(&other.phases);
        listings.any(|listed| proof.covers(&listed, others.error))
    }

    /// Whether it repeats itself before its word ends.
    pub(crate) fn is_of_shorter_word(&self) -> bool {
        let repeats = |listed: Vec<f64>| match &self.proof {
            Some(proof) => proof.covers(&listed, proof.error),
            None => apart(&listed, &self.phases) < SCATTER,
        };
        self.listings(&self.phases).skip(1).any(repeats)
    }

    /// The same motion listed in every way the word allows, impact 0 in the turn of this one's: as it is first.
    fn listings<'a>(&'a self, phases: &'a [f64]) -> impl Iterator<Item = Vec<f64>> + 'a {
        let firsts = std::iter::once(0).chain(self.word.symmetries());
        let near = self.phases.first().copied().unwrap_or(0.0);
        firsts.map(move |first| brought_near(&listed_from(phases, first, self.periods), near))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::rounding::RoundedOrbit;
    use numbers::Field;

    fn motion(g: i64, d: i64, r_b: i64, r_t: i64) -> Motion<Interval<f64>> {
        let [d, r_b, r_t] = [d, r_b, r_t].map(|hundredths| Interval::from_ratio(hundredths, 100));
        Motion::new(Interval::from_ratio(g, 100_000), d, r_b, r_t).expect("a motion")
    }

    fn found(word: &str, periods: u32, motion: &Motion<Interval<f64>>) -> Vec<RoundedOrbit> {
        let word = word.parse().expect("a word");
        let cycles = search_word(&word, periods, motion, &OrbitOptions::DEFAULT).expect("a search");
        let rows = cycles
            .iter()
            .map(|cycle| cycle.orbit(motion).expect("decided").rounded());
        rows.collect()
    }

    #[test]
    fn a_word_that_repeats_itself_gives_only_what_the_shorter_one_does_not() {
        // the 1-1 orbit doubles its period at d = .25906, and there is a BTBT below
        let (above, below) = (motion(12_201, 26, 60, 30), motion(12_201, 25, 60, 30));
        assert_eq!(found("BT", 1, &above).len(), 1);
        assert_eq!(found("BTBT", 2, &above).len(), 0);
        assert_eq!(found("BT", 1, &below).len(), 1);
        let doubled = found("BTBT", 2, &below);
        assert_eq!(doubled.len(), 1);
        assert!(doubled[0].stable && !doubled[0].admissible && doubled[0].velocities[0] > doubled[0].velocities[2]);
    }

    #[test]
    fn a_word_on_one_wall_needs_gravity_towards_it() {
        for (g, bottom, top) in [(12_201, 2, 0), (0, 0, 0), (-12_201, 0, 2)] {
            let motion = motion(g, 30, 50, 50);
            assert_eq!(
                (found("B", 1, &motion).len(), found("T", 1, &motion).len()),
                (bottom, top),
                "{g}"
            );
        }
    }

    #[test]
    fn sixteen_times_the_starts_find_nothing_more() {
        for (word, periods) in [("BT", 1), ("BTT", 1), ("BBT", 2), ("BTT", 2)] {
            let motion = motion(12_201, 20, 60, 30);
            let word: Word = word.parse().expect("a word");
            let some = search_word(&word, periods, &motion, &OrbitOptions::DEFAULT)
                .expect("a search")
                .len();
            let many = search_word_from(
                16 * OrbitOptions::DEFAULT.word_starts as usize * word.impacts(),
                &word,
                periods,
                &motion,
            )
            .expect("a search");
            assert_eq!(some, many.len(), "{word}");
        }
    }

    #[test]
    fn where_motions_meet_what_cannot_be_proved_says_so() {
        // the fold of B: the sine of its phase reaches 1 at g = (1 + r) / (pi n (1 - r))
        let mut fold = motion(12_201, 90, 50, 50);
        let g = 3.0 / std::f64::consts::PI;
        fold = Motion::new(
            Interval::point(g),
            *fold.d(),
            Interval::point(0.5),
            Interval::point(0.5),
        )
        .expect("a motion");
        let cycles = search_word(&"B".parse().expect("a word"), 1, &fold, &OrbitOptions::DEFAULT).expect("a search");
        assert!(
            !cycles.is_empty() && cycles.iter().all(|cycle| !cycle.is_certified()),
            "{cycles:?}"
        );
    }
}
