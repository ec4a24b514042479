//! Every motion that is asked for, to the last digit of f64, with what could not be decided.

use crate::model::{Motion, MotionError, Parameters};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::inconclusive::Inconclusive;
use crate::orbit::interval_box::{IntervalBox, joined};
use crate::orbit::output::{Output, OutputPrecision};
use crate::orbit::proved_orbit::ProvedOrbit;
use crate::orbit::rounding::RoundedOrbit;
use crate::orbit::solve::krawczyk::ProvedRoot;
use crate::orbit::solve::one_one::{again, isolate_one_one};
use crate::orbit::solve::words;
use crate::orbit::solve::words::WordOrbit;
use crate::orbit::word::Word;
use numbers::{Analytic, DoubleDouble, Interval, Told};

/// Motions found, and the boxes in which more may be.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundOrbits<N = f64> {
    /// In order of periods, then of the first phase.
    pub orbits: Vec<RoundedOrbit<N>>,
    /// What could not be decided.
    pub open: Vec<OpenOrbit>,
    /// True if it is proved that nothing is missing but what `open` says.
    is_covered: bool,
}

/// Something that no number at hand could decide.
#[derive(Clone, Debug, PartialEq)]
pub enum OpenOrbit {
    /// 1-1 motions, none, one or several, in (T_1, psi).
    Box {
        /// The forcing periods they take.
        periods: u32,
        /// Where.
        cell: IntervalBox<f64, 2>,
    },
    /// A motion that is there, but of which something is open.
    Motion {
        /// Its word.
        word: Word,
        /// The forcing periods it takes.
        periods: u32,
        /// Where: of a 1-1 motion (T_1, psi), of any other its phases.
        place: Vec<Interval<f64>>,
        /// What.
        why: Inconclusive,
    },
}

impl OpenOrbit {
    /// The forcing periods of the motions.
    pub fn periods(&self) -> u32 {
        match self {
            Self::Box { periods, .. } | Self::Motion { periods, .. } => *periods,
        }
    }

    /// Where they may be: of 1-1 motions (T_1, psi), of others their phases.
    pub fn place(&self) -> Vec<Interval<f64>> {
        match self {
            Self::Box { cell, .. } => cell.to_vec(),
            Self::Motion { place, .. } => place.clone(),
        }
    }
}

impl std::fmt::Display for OpenOrbit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Box {
                periods,
                cell: [t_1, psi],
            } => write!(
                f,
                "BT over {periods} forcing periods: undecided whether there are motions with T_1 in {t_1} and phase \
                 {psi} halfway through the first flight; two motions meet there, or a velocity is 0"
            ),
            Self::Motion { word, periods, why, .. } => {
                write!(f, "{word} over {periods} forcing periods: a motion, but {why}")
            }
        }
    }
}

/// All motions of `word` over 1 to `max_periods` periods, in f64; see [`find_as`].
///
/// # Errors
/// A parameter out of its range.
pub fn find(parameters: &impl Parameters, word: &Word, max_periods: u32) -> Result<FoundOrbits, MotionError> {
    find_as(&OutputPrecision::DOUBLES, parameters, word, max_periods)
}

/// All motions of `word` over 1 to `max_periods` periods, told as they are wanted: [`Doubles`](numbers::Doubles)
/// or [`Decimals`](numbers::Decimals).
///
/// For BT between two walls under the forcing cos(pi t) every one is found, by proof, unless `open` has a box; for
/// other words and motions those that many starts lead to.
///
/// # Errors
/// A parameter out of its range.
pub fn find_as<W: Output>(
    wanted: &W,
    parameters: &impl Parameters,
    word: &Word,
    max_periods: u32,
) -> Result<FoundOrbits<W::Number>, MotionError> {
    let motion = parameters.motion::<Interval<f64>>()?;
    let mut found = FoundOrbits::new(is_covered(&motion, word));
    for periods in 1..=max_periods {
        let settled: Vec<Outcome<W::Number>> = if found.is_covered {
            let search = isolate_one_one(&motion, periods, wanted.options());
            let undecided = &search.isolation.undecided;
            pairs(wanted, parameters, periods, &search.motions, undecided, &mut found.open)?
        } else {
            let cycles = words::search_word(word, periods, &motion, wanted.options())?;
            cycles.iter().map(|cycle| settled(wanted, parameters, cycle)).collect()
        };
        found.take(word, periods, settled);
    }
    Ok(found)
}

/// Returns true if all motions of a word are found, by proof: 1-1 motions between two walls under the forcing cos(pi
/// t). They are followed by [`OneOneBranches`](crate::orbit::OneOneBranches), others by
/// [`WordBranches`](crate::orbit::WordBranches).
pub fn is_covered<T: Analytic>(motion: &Motion<T>, word: &Word) -> bool {
    *word == Word::pair() && OneOneEquations::describes(motion)
}

/// A motion as it is wanted, or why not, and where it is.
pub(crate) type Outcome<N> = Result<RoundedOrbit<N>, (Inconclusive, Vec<Interval<f64>>)>;

/// A motion of any word, and where it is if it cannot be told.
pub(crate) fn settled<W: Output>(wanted: &W, parameters: &impl Parameters, cycle: &WordOrbit) -> Outcome<W::Number> {
    let place = || cycle.phases().iter().map(|phase| Interval::point(*phase)).collect();
    let settled = wanted.orbit(parameters, &ProvedOrbit::Word(cycle));
    settled.map_err(|why| (why, place()))
}

/// The motions at proved roots, and those in boxes that f64 left undecided; what stays so is added to `open`.
pub(crate) fn pairs<W: Output>(
    wanted: &W,
    parameters: &impl Parameters,
    periods: u32,
    roots: &[ProvedRoot<f64, 2>],
    undecided: &[IntervalBox<f64, 2>],
    open: &mut Vec<OpenOrbit>,
) -> Result<Vec<Outcome<W::Number>>, MotionError> {
    let settle = |root: &ProvedRoot<f64, 2>| {
        let settled = wanted.orbit(parameters, &ProvedOrbit::Pair { root, periods });
        settled.map_err(|why| (why, root.enclosure.to_vec()))
    };
    let mut pairs: Vec<_> = roots.iter().map(settle).collect();
    if !undecided.is_empty() {
        let search = again(&parameters.motion()?, periods, undecided, wanted.options());
        let narrow = |side: &Interval<DoubleDouble>| Interval::new(side.low().to_f64(), side.high().to_f64());
        let settle = |root: &ProvedRoot<DoubleDouble, 2>| {
            let settled = wanted.orbit(parameters, &ProvedOrbit::Close { root, periods });
            settled.map_err(|why| (why, root.enclosure.iter().map(narrow).collect()))
        };
        // The boxes examined again reach a little into those of the roots proved before.
        let is_new = |root: &&ProvedRoot<DoubleDouble, 2>| {
            let point = root.enclosure.each_ref().map(|side| side.midpoint().to_f64());
            !roots
                .iter()
                .any(|known| (0..2).all(|i| known.unique[i].contains(&point[i])))
        };
        pairs.extend(search.motions.iter().filter(is_new).map(settle));
        let cells = search.isolation.undecided.iter();
        let cells: Vec<IntervalBox<f64, 2>> = cells.map(|cell| cell.each_ref().map(narrow)).collect();
        let told = joined(&cells, wanted.options().finest_cell).into_iter();
        open.extend(told.map(|cell| OpenOrbit::Box { periods, cell }));
    }
    Ok(pairs)
}

impl<N: Told> FoundOrbits<N> {
    pub(crate) fn new(is_covered: bool) -> Self {
        let (orbits, open) = (Vec::new(), Vec::new());
        Self {
            orbits,
            open,
            is_covered,
        }
    }

    /// Returns true if all that is not open was covered by proof.
    pub fn is_covered(&self) -> bool {
        self.is_covered
    }

    /// Makes a list of motions found elsewhere; nothing is known of others.
    pub fn from_orbits(orbits: Vec<RoundedOrbit<N>>) -> Self {
        Self {
            orbits,
            ..Self::new(false)
        }
    }

    /// Returns true if it is proved that there is no other motion of this word over so many periods: of a word that
    /// [`is_covered`], where no box is left open.
    pub fn is_complete(&self, word: &Word, periods: u32) -> bool {
        let is_box = |open: &OpenOrbit| matches!(open, OpenOrbit::Box { .. }) && open.periods() == periods;
        self.is_covered && *word == Word::pair() && !self.open.iter().any(is_box)
    }

    pub(crate) fn take(&mut self, word: &Word, periods: u32, settled: Vec<Outcome<N>>) {
        let mut orbits = Vec::new();
        for outcome in settled {
            match outcome {
                Ok(orbit) => orbits.push(orbit),
                // The equations hold, but nothing moves so.
                Err((Inconclusive::Backwards { .. } | Inconclusive::Timeless { .. }, _)) => {}
                Err((why, place)) => {
                    let word = word.clone();
                    self.open.push(OpenOrbit::Motion {
                        word,
                        periods,
                        place,
                        why,
                    });
                }
            }
        }
        orbits.sort_by(|one, other| one.phases[0].to_f64().total_cmp(&other.phases[0].to_f64()));
        self.orbits.append(&mut orbits);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::one_one::isolate_one_one;

    #[test]
    fn what_is_found_over_several_periods_is_in_order_and_each_of_its_own() {
        let motion = Motion::new(0.12201, 0.44, 0.6, 0.3).expect("a motion");
        let found = find(&motion, &Word::pair(), 3).expect("a search");
        let order: Vec<_> = found.orbits.iter().map(|row| (row.periods, row.phases[0])).collect();
        assert!(found.open.is_empty() && order.is_sorted() && order.iter().any(|(periods, _)| *periods == 2));
        let first = find(&motion, &Word::pair(), 1).expect("a search").orbits;
        assert_eq!(first, found.orbits[..first.len()]);
    }

    #[test]
    fn where_a_proof_reaches_beyond_the_flight_no_motion_is_listed() {
        // h_1 = h_2 = 0 at T_1 = -0.91, too
        let [g, d, r] = [
            -7.170_216_387_502_808e-6,
            0.133_508_269_733_515_76,
            0.740_243_651_468_045_8,
        ];
        let motion = Motion::new(g, d, r, 1.0).expect("a motion");
        let line = motion.convert(|&x| Interval::from_f64(x)).expect("a motion");
        let search = isolate_one_one(&line, 3, &OrbitOptions::DEFAULT);
        assert!(search.motions.len() == 5 && search.isolation.is_complete());
        assert!(search.motions.iter().all(|root| root.enclosure[0].is_positive()));
    }

    #[test]
    fn beside_a_symmetry_breaking_an_orbit_keeps_its_digits_and_is_listed_once() {
        // 4e-8 from where two others part from it: f64 knows T_1 to 1e-8 only
        let motion = Motion::new(0.0, 0.295_903_726_708_074_5, 1.0, 1.0).expect("a motion");
        let found = find(&motion, &Word::pair(), 1).expect("a search");
        assert!(found.open.is_empty() && found.orbits.len() == 4, "{found:?}");
        assert!(
            found
                .orbits
                .iter()
                .all(|row| row.error_bound.is_some_and(|bound| bound < 1e-15))
        );
    }

    #[test]
    fn what_is_open_says_where() {
        let cell = [Interval::new(0.5, 0.75), Interval::new(1.0, 1.5)];
        let open = OpenOrbit::Box { periods: 2, cell }.to_string();
        assert!(open.contains("2 forcing periods") && open.contains("0.5"), "{open}");
    }
}
