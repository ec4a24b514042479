//! The bifurcations of 1-1 motions over a range of a parameter: all of them, each proved.
//!
//! Each is a solution of h_1 = h_2 = 0 and a condition in (T_1, psi, parameter), isolated in the cells of a [`Cover`]:
//! two between neighbouring values of a sweep are found like one.

use crate::number::{Field, Interval};
use crate::orbit::equations::conditions::{BifurcationKind, Condition, Touch};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::one_one_bifurcations::{Conditioned, Halved, Symmetric, Touching};
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::family::Family;
use crate::orbit::interval_box::{IntervalBox, holds, joined};
use crate::orbit::solve::cover::Cover;
use crate::orbit::solve::isolate::{Isolation, SearchLimits, isolate};
use crate::orbit::solve::krawczyk::{ProvedRoot, distinct_phases, is_shifted};

/// Cells narrower than this are not halved again.
const FINEST: f64 = 1e-8;

/// A search for one event that needs more cells than this, or so many for each of the cover, is given up.
const MOST_CELLS: usize = 6_000;
const MOST_FOR_EACH: usize = 20;

/// Where psi stands among the unknowns.
const PHASE: usize = 1;

/// Where two branches cross, the equations of a fold hold doubly: this near, in T_1, psi and the parameter, they are
/// not asked.
pub const CROSSING: f64 = 1e-4;

/// A proved event: the equations that it solves, and their solution within rounding.
#[derive(Clone, Debug, PartialEq)]
pub enum LocatedBifurcation {
    /// Of [`Conditioned`].
    Condition(Condition, ProvedRoot<f64, 3>),
    /// Of [`Touching`].
    Touch(Touch, ProvedRoot<f64, 4>),
    /// Of [`Symmetric`]: where a branch of other motions crosses that of symmetric ones.
    Crossing(ProvedRoot<f64, 2>),
    /// Of [`Symmetric`]: where the branch of symmetric motions turns.
    Turn(ProvedRoot<f64, 2>),
}

impl LocatedBifurcation {
    /// What happens.
    pub fn event(&self) -> BifurcationKind {
        match self {
            Self::Condition(condition, _) => condition.event(),
            Self::Touch(..) => BifurcationKind::Grazing,
            Self::Crossing(_) => BifurcationKind::SymmetryBreaking,
            Self::Turn(_) => BifurcationKind::Fold,
        }
    }

    /// Where it happens.
    pub fn parameter(&self) -> Interval<f64> {
        match self {
            Self::Condition(_, root) => root.enclosure[2],
            Self::Touch(_, root) => root.enclosure[2],
            Self::Crossing(root) | Self::Turn(root) => root.enclosure[1],
        }
    }

    /// Where it happens to motions of so many periods, in (T_1, psi, parameter).
    pub fn cell(&self, periods: u32) -> IntervalBox<f64, 3> {
        match self {
            Self::Condition(_, root) => root.enclosure,
            Self::Touch(_, root) => [root.enclosure[0], root.enclosure[1], root.enclosure[2]],
            Self::Crossing(root) | Self::Turn(root) => [
                Interval::from_integer(i64::from(periods)),
                root.enclosure[0],
                root.enclosure[1],
            ],
        }
    }

    /// Whether it is proved to be the other one, found in another cover.
    fn is_same(&self, other: &Self) -> bool {
        fn meet<const D: usize>(one: &ProvedRoot<f64, D>, other: &ProvedRoot<f64, D>, phase: usize) -> bool {
            is_shifted(one, other, phase) || is_shifted(other, one, phase)
        }
        match (self, other) {
            (Self::Condition(a, one), Self::Condition(b, other)) => a == b && meet(one, other, PHASE),
            (Self::Touch(a, one), Self::Touch(b, other)) => a == b && meet(one, other, PHASE),
            (Self::Crossing(one), Self::Crossing(other)) | (Self::Turn(one), Self::Turn(other)) => meet(one, other, 0),
            _ => false,
        }
    }
}

/// All events, and the boxes in which one could not be told.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Bifurcations {
    /// In order of the parameter.
    pub located: Vec<LocatedBifurcation>,
    /// What may happen in (T_1, psi, parameter), none, once or several times.
    pub undecided: Vec<(BifurcationKind, IntervalBox<f64, 3>)>,
}

impl Bifurcations {
    /// Takes in what another cover has, each event once.
    pub(crate) fn add(&mut self, other: Self) {
        for located in other.located {
            if !self.located.iter().any(|known| known.is_same(&located)) {
                self.located.push(located);
            }
        }
        self.undecided.extend(other.undecided);
    }

    /// Tells boxes of one event that touch as one.
    pub(crate) fn join(&mut self) {
        let mut left = std::mem::take(&mut self.undecided);
        while let Some((event, _)) = left.first().copied() {
            let own = left.extract_if(.., |(other, _)| *other == event);
            let cells: Vec<IntervalBox<f64, 3>> = own.map(|(_, cell)| cell).collect();
            self.undecided
                .extend(joined(&cells, FINEST).into_iter().map(|cell| (event, cell)));
        }
    }
}

/// Every event of the covered motions: complete, by proof, where `undecided` is empty.
///
/// One exception: of the motions that part from symmetric ones, a fold within [`CROSSING`] of the parting is not
/// looked for.
pub fn bifurcations(family: &impl Family, cover: &Cover) -> Bifurcations {
    let mut found = Bifurcations::default();
    let middle = family.motion_at(&Interval::point(cover.range.midpoint()));
    let middle = middle.map(|motion| OneOneEquations::new(&motion, cover.periods));
    let elastic = middle.as_ref().is_ok_and(|balance| balance.loss().contains_zero());
    let weightless = middle.is_ok_and(|balance| balance.g().contains_zero());
    let line = Line::new(family, cover);
    let mut crossings = Vec::new();
    let mut halves = Vec::new();
    if family.is_symmetric() {
        crossings = line.multipliers_of_one(&mut found);
        if weightless {
            halves = line.around(
                &line
                    .isolated(&Halved {
                        family,
                        periods: cover.periods,
                    })
                    .roots,
            );
        }
    }
    for condition in Condition::ALL {
        // With r_B r_T = 1 multipliers meet at 1 and -1 alone, which are events of their own.
        if elastic && condition.event() == BifurcationKind::NodeFocus {
            continue;
        }
        let apart = match condition {
            Condition::MultiplierOne => &crossings,
            Condition::DoubleNegative | Condition::MultiplierMinusOne => &halves,
            _ => &Vec::new(),
        };
        conditioned(family, cover, condition, apart, &mut found);
    }
    for touch in Touch::ALL {
        touching(family, cover, touch, elastic, &mut found);
    }
    // A proof reaches a little beyond the cells.
    found
        .located
        .retain(|located| located.parameter().intersection(&cover.range).is_some());
    let within = |(event, [t_1, middle, parameter]): (BifurcationKind, IntervalBox<f64, 3>)| {
        Some((event, [t_1, middle, parameter.intersection(&cover.range)?]))
    };
    found.undecided = found.undecided.into_iter().filter_map(within).collect();
    let place = |located: &LocatedBifurcation| located.parameter().midpoint();
    found.located.sort_by(|one, other| place(one).total_cmp(&place(other)));
    found
}

fn conditioned(
    family: &impl Family,
    cover: &Cover,
    condition: Condition,
    apart: &[IntervalBox<f64, 3>],
    found: &mut Bifurcations,
) {
    let system = Conditioned {
        family,
        periods: cover.periods,
        condition,
        apart: apart.to_vec(),
    };
    let isolation = isolated(&system, cover.cells.clone());
    for root in distinct_phases(isolation.roots, PHASE) {
        let new = !is_known_turn(&root, found) && !is_known_grazing(condition, &root, found);
        if new && system.is_wanted(&root.enclosure) {
            found.located.push(LocatedBifurcation::Condition(condition, root));
        }
    }
    let cells = isolation.undecided.into_iter();
    found.undecided.extend(cells.map(|cell| (condition.event(), cell)));
}

fn touching(family: &impl Family, cover: &Cover, touch: Touch, elastic: bool, found: &mut Bifurcations) {
    let periods = cover.periods;
    let system = Touching { family, periods, touch };
    let after = Interval::new(0.0, 2.0 * f64::from(periods));
    let with_time = |&[t_1, middle, parameter]: &IntervalBox<f64, 3>| [t_1, middle, parameter, after];
    let isolation = isolated(&system, cover.cells.iter().map(with_time).collect());
    for root in distinct_phases(isolation.roots, PHASE) {
        // A reversible motion touches a wall in both of its flights at once: one event. So does one without loss that
        // reaches a wall with velocity 0: it is alone with its reflection in time, and touches there at both phases; and
        // a ball that stands still without gravity while the capsule moves.
        let meets = |cell: &[Interval<f64>]| (0..3).all(|i| cell[i].intersection(&root.enclosure[i]).is_some());
        let twin = |located: &LocatedBifurcation| match located {
            LocatedBifurcation::Touch(_, other) => meets(&other.enclosure),
            LocatedBifurcation::Condition(Condition::SlowImpact(_), other) => {
                meets(&other.enclosure) && (elastic || stands(family, periods, &other.enclosure))
            }
            _ => false,
        };
        if system.is_wanted(&root.enclosure) && !found.located.iter().any(twin) {
            found.located.push(LocatedBifurcation::Touch(touch, root));
        }
    }
    let cells = isolation.undecided.into_iter();
    let without_time =
        |[t_1, middle, parameter, _]: IntervalBox<f64, 4>| (BifurcationKind::Grazing, [t_1, middle, parameter]);
    found.undecided.extend(cells.map(without_time));
}

/// Whether the motion may be that of a ball without gravity that has velocity 0 at both walls.
fn stands(family: &impl Family, periods: u32, [t_1, middle, parameter]: &IntervalBox<f64, 3>) -> bool {
    let Ok(motion) = family.motion_at(parameter) else {
        return false;
    };
    let balance = OneOneEquations::new(&motion, periods);
    let velocities = balance.velocities(t_1, middle);
    balance.g().contains_zero() && velocities.iter().all(Interval::contains_zero)
}

/// The branch of symmetric motions, T_1 = T_2 = n.
struct Line<'a, F> {
    family: &'a F,
    periods: u32,
    t_1: Interval<f64>,
    /// (psi, parameter)
    cells: Vec<IntervalBox<f64, 2>>,
}

impl<'a, F: Family> Line<'a, F> {
    fn new(family: &'a F, cover: &Cover) -> Self {
        let t_1 = Interval::from_integer(i64::from(cover.periods));
        let on_line = cover.cells.iter().filter(|cell| cell[0].intersection(&t_1).is_some());
        Self {
            family,
            periods: cover.periods,
            t_1,
            cells: on_line.map(|&[_, middle, parameter]| [middle, parameter]).collect(),
        }
    }

    fn isolated(&self, system: &impl SquareSystem<f64, 2>) -> Isolation<f64, 2> {
        isolated(system, self.cells.clone())
    }

    fn around(&self, roots: &[ProvedRoot<f64, 2>]) -> Vec<IntervalBox<f64, 3>> {
        let near = |side: Interval<f64>| side + Interval::new(-CROSSING, CROSSING);
        let boxed = |root: &ProvedRoot<f64, 2>| [near(self.t_1), near(root.enclosure[0]), near(root.enclosure[1])];
        roots.iter().map(boxed).collect()
    }

    /// Adds the multipliers of 1 on the line to what is found; the boxes around them.
    fn multipliers_of_one(&self, found: &mut Bifurcations) -> Vec<IntervalBox<f64, 3>> {
        let system = Symmetric {
            family: self.family,
            periods: self.periods,
        };
        let isolation = self.isolated(&system);
        let roots = distinct_phases(isolation.roots, 0);
        let apart = self.around(&roots);
        found.located.extend(roots.into_iter().map(|root| {
            if system.may_turn(&root.enclosure) {
                LocatedBifurcation::Turn(root)
            } else {
                LocatedBifurcation::Crossing(root)
            }
        }));
        let cells = isolation.undecided.into_iter();
        let on_line = |[middle, parameter]: IntervalBox<f64, 2>| {
            (BifurcationKind::SymmetryBreaking, [self.t_1, middle, parameter])
        };
        found.undecided.extend(cells.map(on_line));
        apart
    }
}

/// Whether the event is one found on the branch of symmetric motions.
fn is_known_turn(root: &ProvedRoot<f64, 3>, found: &Bifurcations) -> bool {
    let [_, middle, parameter] = root.enclosure;
    found.located.iter().any(|located| match located {
        LocatedBifurcation::Turn(turn) => middle.is_subset(&turn.unique[0]) && parameter.is_subset(&turn.unique[1]),
        _ => false,
    })
}

/// Whether the event is the velocity of 0 at the other wall: both at once are one event.
fn is_known_grazing(condition: Condition, root: &ProvedRoot<f64, 3>, found: &Bifurcations) -> bool {
    let meets =
        |other: &ProvedRoot<f64, 3>| (0..3).all(|i| other.enclosure[i].intersection(&root.enclosure[i]).is_some());
    matches!(condition, Condition::SlowImpact(_))
        && found.located.iter().any(|located| match located {
            LocatedBifurcation::Condition(Condition::SlowImpact(_), other) => meets(other),
            _ => false,
        })
}

fn isolated<const D: usize>(system: &impl SquareSystem<f64, D>, cells: Vec<IntervalBox<f64, D>>) -> Isolation<f64, D> {
    let limits = SearchLimits {
        finest: FINEST,
        most_cells: MOST_CELLS.max(MOST_FOR_EACH * cells.len()),
    };
    let mut isolation = isolate(system, cells.clone(), Vec::new(), limits);
    // a proof reaches beyond the cells, to where a velocity points away from its wall
    isolation.roots.retain(|root| system.is_wanted(&root.enclosure));
    let mut left = std::mem::take(&mut isolation.undecided);
    for cell in cells {
        // of each cell one box: what is left of it
        let own = left.extract_if(.., |part| holds(&cell, &part.map(|side| side.midpoint())));
        isolation
            .undecided
            .extend(own.reduce(|one, other| std::array::from_fn(|i| one[i].hull(&other[i]))));
    }
    isolation.undecided.append(&mut left);
    isolation
}
