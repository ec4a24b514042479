//! All 1-1 motions of a scene: none missed, none invented.

use crate::model::Motion;
use crate::number::{Analytic, DoubleDouble, Endpoint, Interval};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::square_system::{Decision, SquareSystem, not_excluded};
use crate::orbit::interval_box::{IntervalBox, joined};
use crate::orbit::solve::isolate::{Isolation, SearchLimits, isolate};
use crate::orbit::solve::krawczyk::{ProvedRoot, distinct_phases, is_shifted, prove};
use crate::orbit::solve::proposals;

/// Cells narrower than this in T_1 and psi are not halved again: two motions nearer to each other than some times
/// this are left to a wider number.
pub const FINEST: f64 = 2e-9;

/// A search that needs more cells than this for each period is at a motion that is no isolated one.
const MOST_CELLS: usize = 200_000;

/// As [`FINEST`] and [`MOST_CELLS`], over the wider number.
const FINEST_AGAIN: f64 = 1e-18;
const MOST_CELLS_AGAIN: usize = 5_000;

/// The boxes in which a likely motion is tried to be proved, in T_1 and in psi: half-widths.
const TRIED: [f64; 4] = [0.08, 0.02, 0.005, 0.000_3];

/// Where psi stands among the unknowns.
pub const PHASE: usize = 1;

/// The two equations of [`OneOneEquations`], for motions with v > 0 > w.
pub struct Equations<'a, E: Endpoint>(pub &'a OneOneEquations<Interval<E>>);

impl<E: Endpoint> SquareSystem<E, 2> for Equations<'_, E> {
    fn linearised(&self, [t_1, middle]: &IntervalBox<E, 2>) -> (IntervalBox<E, 2>, [IntervalBox<E, 2>; 2]) {
        self.0.linearised(t_1, middle)
    }

    fn values(&self, [t_1, middle]: &IntervalBox<E, 2>) -> IntervalBox<E, 2> {
        self.0.residual(t_1, middle)
    }

    fn is_wanted(&self, [t_1, middle]: &IntervalBox<E, 2>) -> bool {
        may_fly(self.0, t_1, &self.0.scaled_velocities(t_1, middle))
    }

    /// With the sines of the cell computed once.
    fn examined(&self, [t_1, middle]: &IntervalBox<E, 2>) -> Result<[IntervalBox<E, 2>; 2], Decision> {
        let at = self.0.parts(t_1, middle);
        if !may_fly(self.0, t_1, &self.0.scaled_velocities_at(&at)) {
            return Err(Decision::Unwanted);
        }
        not_excluded(&self.0.residual_at(&at))?;
        Ok(self.0.slopes_at(&at))
    }
}

/// Whether v >= 0 >= w somewhere, with T_1 and T_2 not negative: a proof may reach beyond the pieces examined.
pub(crate) fn may_fly<E: Endpoint>(
    balance: &OneOneEquations<Interval<E>>,
    t_1: &Interval<E>,
    [v, w]: &[Interval<E>; 2],
) -> bool {
    let t_2 = balance.total() - t_1.clone();
    !v.is_negative() && !w.is_positive() && !t_1.is_negative() && !t_2.is_negative()
}

/// A search for 1-1 motions and how it went.
#[derive(Clone, Debug, PartialEq)]
pub struct OneOneSearch<E: Endpoint = f64> {
    /// The forcing periods the motions take.
    pub periods: u32,
    /// Likely motions proved before the search.
    pub proposed: usize,
    /// The pieces examined, how each was decided, and what stayed undecided; its roots may be found twice, where
    /// psi is on the seam, or have velocities that point away from their walls.
    pub isolation: Isolation<E, 2>,
    /// The motions, each once, in (T_1, psi).
    pub motions: Vec<ProvedRoot<E, 2>>,
}

/// Every 1-1 motion with v > 0 > w that takes `periods` periods, as a proved (T_1, psi); psi is the phase of the
/// forcing halfway through the flight from bottom to top. Each is found once, whatever its phase.
///
/// Nothing stays undecided unless two motions are nearer than about 1e-8, or a velocity is 0 within rounding:
/// elsewhere the list is complete, by proof. Costs some hundred evaluations of h_1, h_2.
pub fn isolate_one_one(motion: &Motion<Interval<f64>>, periods: u32) -> OneOneSearch {
    let balance = OneOneEquations::new(motion, periods);
    let system = Equations(&balance);
    let mut roots: Vec<ProvedRoot<f64, 2>> = Vec::new();
    if let Ok(middle) = motion.convert(|parameter| parameter.midpoint()) {
        for point in proposals::propose(&OneOneEquations::new(&middle, periods)) {
            let proved = TRIED.iter().find_map(|half| prove(&system, &point, &[*half, *half]));
            let is_new = |root: &ProvedRoot<f64, 2>| !roots.iter().any(|known| is_shifted(root, known, PHASE));
            let new = proved.filter(is_new);
            roots.extend(new);
        }
    }
    let turn = 2.0 * std::f64::consts::PI;
    // Each psi in one turn, and the seam twice: pi is not a number of f64.
    let cells = vec![[
        Interval::new(0.0, 2.0 * f64::from(periods)),
        Interval::new(-0.5 * turn, (0.5 * turn).above()),
    ]];
    let limits = SearchLimits {
        finest: FINEST,
        most_cells: MOST_CELLS * periods as usize,
    };
    let proposed = roots.len();
    OneOneSearch::new(periods, proposed, isolate(&system, cells, roots, limits), &system)
}

/// What a search left undecided, examined again over a wider number.
pub fn again(
    motion: &Motion<Interval<DoubleDouble>>,
    periods: u32,
    undecided: &[IntervalBox<f64, 2>],
) -> OneOneSearch<DoubleDouble> {
    let balance = OneOneEquations::new(motion, periods);
    let system = Equations(&balance);
    let limits = SearchLimits {
        finest: FINEST_AGAIN,
        most_cells: MOST_CELLS_AGAIN,
    };
    let isolation = isolate(&system, clusters(undecided), Vec::new(), limits);
    OneOneSearch::new(periods, 0, isolation, &system)
}

impl<E: Endpoint> OneOneSearch<E> {
    pub(crate) fn new(periods: u32, proposed: usize, isolation: Isolation<E, 2>, system: &Equations<E>) -> Self {
        let motions = distinct_phases(isolation.roots.clone(), PHASE);
        let motions = motions.into_iter().filter(|root| system.is_wanted(&root.enclosure));
        Self {
            periods,
            proposed,
            motions: motions.collect(),
            isolation,
        }
    }
}

/// The undecided cells over the wider number, those that touch in one, a little larger: a root may lie on the seam of
/// two.
fn clusters(undecided: &[IntervalBox<f64, 2>]) -> Vec<IntervalBox<DoubleDouble, 2>> {
    let wider = |side: Interval<f64>| {
        let [low, high] = [side.low(), side.high()].map(DoubleDouble::from_f64);
        Interval::new(low, high)
    };
    let joined = joined(undecided, FINEST);
    joined.into_iter().map(|cell| cell.map(wider)).collect()
}
