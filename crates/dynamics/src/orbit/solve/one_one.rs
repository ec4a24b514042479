//! All 1-1 motions of a scene: none missed, none invented.

use crate::model::Motion;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::one_one_bifurcations::ConditionedOneOne;
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::family::Family;
use crate::orbit::interval_box::{IntervalBox, joined};
use crate::orbit::options::OrbitOptions;
use crate::orbit::solve::isolate::{Isolation, SearchLimits, isolate};
use crate::orbit::solve::krawczyk::{ProvedRoot, distinct_phases, is_shifted, prove};
use crate::orbit::solve::newton::{Ending, newton, newton_by_duals};
use crate::orbit::solve::proposals;
use numbers::{Analytic, DoubleDouble, Endpoint, Interval};

/// Cells examined again over the wider number are halved to this width, and so many of them are.
const FINEST_AGAIN: f64 = 1e-18;
const MOST_CELLS_AGAIN: usize = 5_000;

/// The boxes in which a likely motion is tried to be proved, in T_1 and in psi: half-widths.
const TRIED: [f64; 4] = [0.08, 0.02, 0.005, 0.000_3];

/// Where psi stands among the unknowns.
pub const PHASE: usize = 1;

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
/// elsewhere the list is complete, by proof. Costs some hundred evaluations of h_1, h_2. Under another forcing than
/// cos(pi t), and with one wall, nothing is found and all is left undecided.
pub fn isolate_one_one(motion: &Motion<Interval<f64>>, periods: u32, options: &OrbitOptions) -> OneOneSearch {
    let balance = OneOneEquations::new(motion, periods);
    let turn = 2.0 * std::f64::consts::PI;
    // Each psi in one turn, and the seam twice: pi is not a number of f64.
    let cells = vec![[
        Interval::new(0.0, 2.0 * f64::from(periods)),
        Interval::new(-0.5 * turn, (0.5 * turn).above()),
    ]];
    if !OneOneEquations::describes(motion) {
        let isolation = Isolation {
            roots: Vec::new(),
            undecided: cells,
            decided: Vec::new(),
        };
        return OneOneSearch::new(periods, 0, isolation, &balance);
    }
    let mut roots: Vec<ProvedRoot<f64, 2>> = Vec::new();
    if let Ok(middle) = motion.convert(|parameter| parameter.midpoint()) {
        for point in proposals::propose(&OneOneEquations::new(&middle, periods)) {
            let proved = TRIED.iter().find_map(|half| prove(&balance, &point, &[*half, *half]));
            let is_new = |root: &ProvedRoot<f64, 2>| !roots.iter().any(|known| is_shifted(root, known, PHASE));
            let new = proved.filter(is_new);
            roots.extend(new);
        }
    }
    let limits = SearchLimits {
        finest: options.finest_cell,
        most_cells: options.most_cells as usize * periods as usize,
    };
    let proposed = roots.len();
    OneOneSearch::new(periods, proposed, isolate(&balance, cells, roots, limits), &balance)
}

/// What a search left undecided, examined again over a wider number.
pub fn again(
    motion: &Motion<Interval<DoubleDouble>>,
    periods: u32,
    undecided: &[IntervalBox<f64, 2>],
    options: &OrbitOptions,
) -> OneOneSearch<DoubleDouble> {
    let balance = OneOneEquations::new(motion, periods);
    let limits = SearchLimits {
        finest: FINEST_AGAIN,
        most_cells: MOST_CELLS_AGAIN,
    };
    let isolation = isolate(&balance, clusters(undecided, options), Vec::new(), limits);
    OneOneSearch::new(periods, 0, isolation, &balance)
}

impl<E: Endpoint> OneOneSearch<E> {
    pub(crate) fn new(
        periods: u32,
        proposed: usize,
        isolation: Isolation<E, 2>,
        system: &OneOneEquations<Interval<E>>,
    ) -> Self {
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
fn clusters(undecided: &[IntervalBox<f64, 2>], options: &OrbitOptions) -> Vec<IntervalBox<DoubleDouble, 2>> {
    let wider = |side: Interval<f64>| {
        let [low, high] = [side.low(), side.high()].map(DoubleDouble::from_f64);
        Interval::new(low, high)
    };
    let joined = joined(undecided, options.finest_cell);
    joined.into_iter().map(|cell| cell.map(wider)).collect()
}

/// A guess that is no better than some percent takes fewer steps than this, or none leads anywhere; a last step of this size
/// in T_1 and psi squares to less than rounding.
const NEAR_GUESS: Ending = Ending {
    most_steps: 20,
    last_step: 1e-7,
    growth: f64::INFINITY,
    rounding: 0.0,
};

/// The 1-1 motion (T_1, psi) that Newton's method leads to, to about 1e-14 where the motion is not near a fold.
///
/// `None` where the steps do not settle. What is found may have velocities that point away from their walls, and is
/// not proved: [`prove`](crate::orbit::prove) does that, [`isolate_one_one`](crate::orbit::isolate_one_one()) needs no guess.
pub fn newton_one_one(balance: &OneOneEquations<f64>, guess: [f64; 2]) -> Option<[f64; 2]> {
    newton(guess, &NEAR_GUESS, |[t_1, middle]: &[f64; 2]| {
        let ([first, second], [[a, b], [c, d]]) = balance.linearised(t_1, middle);
        let determinant = a * d - b * c;
        Some([
            (d * first - b * second) / determinant,
            (a * second - c * first) / determinant,
        ])
    })
}

/// The bifurcation (T_1, psi, parameter) that Newton's method leads to: as [`newton_one_one`], with derivatives by dual
/// numbers.
pub fn newton_one_one_bifurcation(system: &ConditionedOneOne<impl Family>, guess: [f64; 3]) -> Option<[f64; 3]> {
    newton_by_duals(guess, &NEAR_GUESS, |at| system.equations(at).ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::equations::conditions::BifurcationCondition;

    /// r_B = r_T = 0.5, beta = pi/6, d = 0.4.
    fn motion() -> Motion<f64> {
        let Ok(motion) = Motion::new(0.122_01, 0.4, 0.5, 0.5) else {
            panic!("a motion")
        };
        motion
    }

    #[test]
    fn a_guess_five_percent_off_leads_to_the_motion_whichever_way_it_is_off() {
        let balance = OneOneEquations::new(&motion(), 1);
        let Some(exact) = newton_one_one(&balance, [1.1, 2.2]) else {
            panic!("a motion")
        };
        assert!(balance.residual(&exact[0], &exact[1]).iter().all(|h| h.abs() < 1e-14));
        for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let guess = [0, 1].map(|i| exact[i] * (1.0 + 0.05 * signs[i]));
            let found = newton_one_one(&balance, guess).map(|found| (found[0] - exact[0]).hypot(found[1] - exact[1]));
            assert!(found.is_some_and(|off| off < 1e-13), "{signs:?} {found:?}");
        }
    }

    #[test]
    fn a_guess_near_the_period_doubling_leads_to_it() {
        let motion = motion();
        let system = ConditionedOneOne {
            family: &motion,
            periods: 1,
            condition: BifurcationCondition::MultiplierMinusOne,
            apart: Vec::new(),
        };
        let found = newton_one_one_bifurcation(&system, [1.3, 2.2, 0.26]);
        // FACTS: d = .25107018538986923
        assert!(
            found.is_some_and(|[_, _, d]| (d - 0.251_070_185_389_869_23).abs() < 1e-13),
            "{found:?}"
        );
    }

    #[test]
    fn where_nothing_is_near_there_is_no_answer() {
        let balance = OneOneEquations::new(&motion(), 1);
        assert_eq!(newton_one_one(&balance, [f64::NAN, 1.0]), None);
    }
}
