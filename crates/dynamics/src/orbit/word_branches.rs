//! The motions of any word followed over a sweep, and the bifurcations on the way.

use crate::model::Exact;
use crate::model::MotionError;
use crate::orbit::bifurcation::detect::detect;
use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::continuation::branch::{Branch, BranchEnd};
use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::continuation::extended_system::ExtendedSystem;
use crate::orbit::equations::conditions::BifurcationKind;
use crate::orbit::family::Family;
use crate::orbit::find::{FoundOrbits, settled};
use crate::orbit::options::OrbitOptions;
use crate::orbit::output::{Output, OutputPrecision};
use crate::orbit::parallel::each;
use crate::orbit::solve::starts::{brought_near, solve_word};
use crate::orbit::solve::words::{WordOrbit, moves, search_word_from};
use crate::orbit::word::Word;
use nalgebra::DMatrix;
use numbers::Interval;
use std::f64::consts::{PI, TAU};

/// A motion found there is known to this, in radians.
const ROOM: f64 = 1e-9;

/// Distances along the kernel of the equations, in radians, at which a branch that parts from another one is looked
/// for.
const PARTINGS: [f64; 4] = [0.03, 0.01, 0.003, 0.001];

/// Returns the direction that a matrix of rank one less than its size takes to 0: the right singular vector of the
/// least value.
fn kernel(rows: &[Vec<f64>]) -> Option<Vec<f64>> {
    let matrix = DMatrix::from_fn(rows.len(), rows.len(), |row, column| rows[row][column]);
    let svd = matrix.try_svd(false, true, f64::EPSILON, MOST_ITERATIONS)?;
    let (least, _) = svd.singular_values.argmin();
    Some(svd.v_t?.row(least).iter().copied().collect())
}

/// Iterations of the singular value decomposition.
const MOST_ITERATIONS: usize = 1000;

/// The branches of motions of a word that a search at some values of the parameter leads to.
///
/// Each is followed in both directions, through folds, to where it ends: where the parameter leaves its range, a
/// velocity or a time is 0, or the motion is one of a shorter word. From each step to the next it is proved that one
/// curve of motions leads there, and no other passes near it, but where two branches cross.
///
/// A motion that goes through a shorter word twice is where the period of the shorter motion doubles: the branch ends
/// there, in an event [`PeriodDoubling`](crate::orbit::BifurcationKind::PeriodDoubling), whose trace, that of the word followed, is
/// 1 + Det(DP). A multiplier of 1 is a fold where that is proved, and likely symmetry breaking where the branch goes on.
///
/// **Completeness is not claimed**: a branch between two of the values searched may attract no start, and an even
/// number of like events between two steps is not seen.
pub struct WordBranches<F> {
    extended: ExtendedSystem<F>,
    branches: Vec<Branch>,
}

impl<F: Family + Sync> WordBranches<F> {
    /// Follows the motions of `word` over `periods` forcing periods for parameters in `range`.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn new(
        family: F,
        word: &Word,
        periods: u32,
        range: Interval<f64>,
        options: &OrbitOptions,
    ) -> Result<Self, MotionError> {
        let extended = ExtendedSystem {
            family,
            word: word.spelled(),
            periods,
            range,
            options: *options,
        };
        let count = options.branch_starts as usize * word.impacts() * periods as usize;
        let places =
            (0..options.branch_values).map(|index| f64::from(index) / f64::from(options.branch_values.max(2) - 1));
        let places: Vec<f64> = places.collect();
        let found = each(&places, |place| {
            let motion = extended.family.motion_at(&Interval::point(extended.parameter(place)))?;
            search_word_from(count, word, periods, &motion)
        });
        let mut branches: Vec<Branch> = Vec::new();
        for (place, cycles) in places.iter().zip(found) {
            let cycles = cycles?;
            for cycle in cycles.iter().filter(|cycle| cycle.is_certified()) {
                let point = [cycle.phases(), &[*place]].concat();
                if !branches.iter().any(|branch| branch.holds(&extended, &point, ROOM)) {
                    branches.extend(Branch::through(&extended, point));
                }
            }
        }
        Ok(Self { extended, branches })
    }

    /// Follows the branch that starts at a bifurcation of the motions of `family`: at a period doubling that of the
    /// doubled word, over twice the periods, and where a symmetry breaks that of the motions without it. It is followed
    /// as any other, and ends in, or goes through, the bifurcation. `None` at any other bifurcation, where the doubled
    /// word would have more than [`Word::LONGEST`] impacts, and where Newton's method finds no such branch.
    pub fn switched(family: F, point: &BifurcationPoint, range: Interval<f64>, options: &OrbitOptions) -> Option<Self> {
        let (listed, mut phases) = point.listed()?;
        let repeats = listed.half().is_some() && point.trace > 0.0;
        let (word, periods) = match point.kind {
            // listed already as the doubled motion that ends there
            BifurcationKind::PeriodDoubling if repeats => (listed, point.periods),
            BifurcationKind::PeriodDoubling => {
                let turns = TAU * f64::from(point.periods);
                phases.extend(phases.clone().iter().map(|phase| phase + turns));
                (listed.twice()?, 2 * point.periods)
            }
            BifurcationKind::SymmetryBreaking => (listed, point.periods),
            _ => return None,
        };
        let extended = ExtendedSystem {
            family,
            word,
            periods,
            range,
            options: *options,
        };
        let (_, rows) = extended.at(&point.parameter)?.linearised(&phases);
        let kernel = kernel(&rows)?;
        phases.push(extended.place(point.parameter));
        let normal = [kernel, vec![0.0]].concat();
        let branches = PARTINGS.iter().find_map(|part| {
            let guess: Vec<f64> = phases
                .iter()
                .zip(&normal)
                .map(|(phase, part_of)| phase + part * part_of)
                .collect();
            let (found, moved) = extended.corrected(&guess, &normal, dot(&guess, &normal))?;
            (moved < 0.5 * part).then(|| Branch::through(&extended, found))?
        });
        Some(Self {
            branches: vec![branches?],
            extended,
        })
    }

    /// The motions at each of the values, in their order, on all cores: each proved by itself, as by
    /// [`find`](crate::orbit::find()).
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn points<V: Exact + Sync>(&self, values: &[V]) -> Result<Vec<FoundOrbits>, MotionError> {
        self.points_as(&OutputPrecision::DOUBLES, values)
    }

    /// The same, told as they are wanted.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn points_as<W: Output, V: Exact + Sync>(
        &self,
        wanted: &W,
        values: &[V],
    ) -> Result<Vec<FoundOrbits<W::Number>>, MotionError> {
        each(values, |value| self.orbits_as(wanted, value))
            .into_iter()
            .collect()
    }

    /// The motions at one value.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn orbits(&self, value: &impl Exact) -> Result<FoundOrbits, MotionError> {
        self.orbits_as(&OutputPrecision::DOUBLES, value)
    }

    /// The same, told as they are wanted.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn orbits_as<W: Output, V: Exact>(&self, wanted: &W, value: &V) -> Result<FoundOrbits<W::Number>, MotionError> {
        let ExtendedSystem {
            word, periods, family, ..
        } = &self.extended;
        let parameter: Interval<f64> = value.value();
        let system = crate::orbit::equations::words::WordEquations {
            motion: family.motion_at(&parameter)?,
            word: word.clone(),
            periods: *periods,
        };
        let middle = system.convert(Interval::midpoint)?;
        let place = self.extended.place(parameter.midpoint());
        let mut cycles: Vec<WordOrbit> = Vec::new();
        for guess in self.branches.iter().flat_map(|branch| branch.proposals(place)) {
            let phases = solve_word(&middle, guess).filter(|phases| moves(&middle, phases));
            let Some(phases) = phases else { continue };
            let cycle = WordOrbit::near(&system, brought_near(&phases, PI));
            if !cycle.is_of_shorter_word() && !cycles.iter().any(|other| other.is_same(&cycle)) {
                cycles.push(cycle);
            }
        }
        let fixed = family.fixed(value);
        let orbits = cycles.iter().map(|cycle| settled(wanted, &fixed, cycle));
        let mut found = FoundOrbits::new(false);
        found.take(word, *periods, orbits.collect());
        Ok(found)
    }

    /// Every bifurcation seen on the way, in order of the parameter; those without an error bound are not proved.
    pub fn bifurcations(&self) -> Vec<BifurcationPoint> {
        let all = each(&self.branches, |branch| detect(&self.extended, branch));
        let mut told: Vec<BifurcationPoint> = Vec::new();
        for point in all.into_iter().flatten() {
            // a motion that is its own mirror image touches in two flights at once, and two branches may end in one
            if !told.iter().any(|other| self.is_same(other, &point)) {
                told.push(point);
            }
        }
        told.sort_by(|one, other| one.parameter.total_cmp(&other.parameter));
        told
    }

    fn is_same(&self, one: &BifurcationPoint, other: &BifurcationPoint) -> bool {
        let near = |one: &[f64], other: &[f64]| one.iter().zip(other).all(|(one, other)| (one - other).abs() < 1e-7);
        one.kind == other.kind
            && (one.parameter - other.parameter).abs() < 1e-9 * self.extended.range.width()
            && near(&one.velocities, &other.velocities)
            && near(&one.times, &other.times)
    }

    /// Returns true if the branches of another search are among these.
    pub fn has(&self, other: &Self) -> bool {
        let held = |branch: &Branch| {
            let middle = &branch.nodes[branch.nodes.len() / 2].point;
            self.branches.iter().any(|own| own.holds(&self.extended, middle, ROOM))
        };
        self.word() == other.word() && other.branches.iter().all(held)
    }

    /// The word of the motions, and the forcing periods they take.
    pub fn word(&self) -> (Word, u32) {
        (self.extended.word.clone(), self.extended.periods)
    }

    /// The number of branches, and how many of their ends are no end: where no step on could be made.
    pub fn branches(&self) -> (usize, usize) {
        let ends = self.branches.iter().flat_map(|branch| branch.ends);
        (self.branches.len(), ends.filter(|end| *end == BranchEnd::Lost).count())
    }
}
