//! The bifurcations of 1-1 motions over a range of a parameter: all of them, each proved.
//!
//! Each is a solution of h_1 = h_2 = 0 and a condition in (T_1, psi, parameter), isolated in the cells of a [`Cover`]:
//! two between neighbouring values of a sweep are found like one.

use crate::model::{Motion, Side};
use crate::orbit::bifurcation::point::{EnclosedBifurcation, clearance_at};
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::one_one_bifurcations::{ConditionedOneOne, HalvedOneOne, SymmetricOneOne};
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::family::Family;
use crate::orbit::inconclusive::{Inconclusive, Property};
use crate::orbit::interval_box::{IntervalBox, holds, joined};
use crate::orbit::solve::cover::Cover;
use crate::orbit::solve::isolate::{Isolation, SearchLimits, isolate};
use crate::orbit::solve::krawczyk::{ProvedRoot, distinct_phases, is_shifted, prove_over};
use crate::orbit::word::Word;
use num_dual::DualNum;
use num_traits::One;
use numbers::{Endpoint, Field, Interval};

/// The conditions on a 1-1 motion of one equation each: on its multipliers, and an impact of velocity 0.
const CONDITIONS: [BifurcationCondition; 6] = [
    BifurcationCondition::MultiplierMinusOne,
    BifurcationCondition::MultiplierOne,
    BifurcationCondition::DoublePositive,
    BifurcationCondition::DoubleNegative,
    BifurcationCondition::ZeroVelocity(0),
    BifurcationCondition::ZeroVelocity(1),
];

/// The touches there may be: in either flight, at either wall.
const TOUCHES: [BifurcationCondition; 4] = [
    BifurcationCondition::Touch(0, Side::Bottom),
    BifurcationCondition::Touch(0, Side::Top),
    BifurcationCondition::Touch(1, Side::Bottom),
    BifurcationCondition::Touch(1, Side::Top),
];

/// The clearance of a motion with an impact of velocity 0 is that of the bifurcation within this: turning points follow the
/// velocity with slopes of some units.
const CLEARANCE_MARGIN: f64 = 1e-12;

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
    /// Of [`ConditionedOneOne`], in (T_1, psi, parameter).
    Condition(BifurcationCondition, ProvedRoot<f64, 3>),
    /// Of [`ConditionedOneOne`] at a touch, in (T_1, psi, parameter, time from the impact at the wall that is
    /// touched).
    Touch(BifurcationCondition, ProvedRoot<f64, 4>),
    /// Of [`SymmetricOneOne`]: where a branch of other motions crosses that of symmetric ones.
    Crossing(ProvedRoot<f64, 2>),
    /// Of [`SymmetricOneOne`]: where the branch of symmetric motions turns.
    Turn(ProvedRoot<f64, 2>),
}

impl LocatedBifurcation {
    /// What happens.
    pub fn kind(&self) -> BifurcationKind {
        match self {
            Self::Condition(condition, _) => condition.kind(),
            Self::Touch(..) => BifurcationKind::Grazing,
            Self::Crossing(_) => BifurcationKind::SymmetryBreaking,
            Self::Turn(_) => BifurcationKind::Fold,
        }
    }

    /// Where it happens.
    pub fn parameter(&self) -> Interval<f64> {
        let [_, _, parameter] = self.cell(0);
        parameter
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

    /// The bifurcation over `E`, proved again and located as well as `E` can.
    ///
    /// # Errors
    /// `Undecided` where `E` is too narrow.
    pub fn enclosed<E: Endpoint>(
        &self,
        family: &impl Family,
        periods: u32,
    ) -> Result<EnclosedBifurcation<E>, Inconclusive>
    where
        Interval<E>: DualNum,
    {
        let open = |what| Inconclusive::Undecided { what };
        let [t_1, middle, parameter] = self.refined::<E>(family, periods).ok_or(open(Property::Existence))?;
        let motion = family.motion_at(&parameter).map_err(|_| open(Property::Direction))?;
        let condition = match self {
            Self::Condition(condition, _) | Self::Touch(condition, _) => *condition,
            Self::Crossing(_) | Self::Turn(_) => BifurcationCondition::MultiplierOne,
        };
        let known = KnownMotion {
            kind: self.kind(),
            condition,
            motion: &motion,
            periods,
            place: [parameter, t_1, middle],
        };
        let clearance = known.clearance(false)?;
        Ok(known.with(clearance))
    }

    /// (T_1, psi, parameter) over `E`.
    fn refined<E: Endpoint>(&self, family: &impl Family, periods: u32) -> Option<IntervalBox<E, 3>>
    where
        Interval<E>: DualNum,
    {
        let conditioned = |condition: &BifurcationCondition| ConditionedOneOne {
            family,
            periods,
            condition: *condition,
            apart: Vec::new(),
        };
        match self {
            Self::Condition(condition, root) => prove_over(&conditioned(condition), root),
            Self::Touch(touch, root) => {
                prove_over(&conditioned(touch), root).map(|[t_1, middle, parameter, _]| [t_1, middle, parameter])
            }
            Self::Crossing(root) | Self::Turn(root) => {
                let line = Interval::from_integer(i64::from(periods));
                prove_over(&SymmetricOneOne { family, periods }, root)
                    .map(|[middle, parameter]| [line, middle, parameter])
            }
        }
    }
}

/// A bifurcation of a known motion: what happens, the condition that holds, the motion at (parameter, T_1, psi).
#[derive(Clone, Debug)]
pub(crate) struct KnownMotion<'a, E: Endpoint> {
    pub kind: BifurcationKind,
    pub condition: BifurcationCondition,
    pub motion: &'a Motion<Interval<E>>,
    pub periods: u32,
    pub place: [Interval<E>; 3],
}

impl<E: Endpoint> KnownMotion<'_, E> {
    fn balance(&self) -> OneOneEquations<Interval<E>> {
        OneOneEquations::new(self.motion, self.periods)
    }

    /// The clearance, `None` where no flight turns, and whether the motion keeps between the walls. A clearance that may
    /// be 0 is 0 where `grazes` says that it is somewhere.
    ///
    /// # Errors
    /// `Undecided` where `E` is too narrow to tell.
    pub fn clearance(&self, grazes: bool) -> Result<(Option<Interval<E>>, bool), Inconclusive> {
        let balance = self.balance();
        let [_, t_1, middle] = &self.place;
        let impacts = balance.impacts(t_1, middle);
        // without loss an impact of velocity 0 is a contact of its reflection in time too; without gravity a ball with two of
        // them stands still while the capsule moves, and touches whenever that turns
        let touches = |clearance: &Interval<E>| match self.condition {
            BifurcationCondition::Touch(..) => true,
            BifurcationCondition::ZeroVelocity(_) => {
                let has_loss = (Interval::one() - balance.loss_factor()).is_positive();
                let is_still = impacts.iter().all(|impact| impact.velocity.contains_zero());
                let stands = self.motion.g().contains_zero() && is_still;
                (grazes || stands || !has_loss) && clearance.magnitude().to_f64() <= 2.0 * CLEARANCE_MARGIN
            }
            _ => grazes,
        };
        let sides = [Side::Bottom, Side::Top];
        clearance_at(
            self.condition,
            (&sides, self.motion),
            &impacts,
            CLEARANCE_MARGIN,
            touches,
        )
    }

    /// The motion with what is known of its clearance.
    pub fn with(self, (clearance, admissible): (Option<Interval<E>>, bool)) -> EnclosedBifurcation<E> {
        let balance = self.balance();
        let [parameter, t_1, middle] = self.place;
        let trace = match self.condition {
            BifurcationCondition::ZeroVelocity(_) => None,
            BifurcationCondition::Touch(..) => {
                let [v, w] = balance.scaled_velocities(&t_1, &middle);
                Some(balance.trace_above(&Interval::from_integer(0), &t_1, &middle) / (v * w))
            }
            condition => condition.trace(&balance.loss_factor()),
        };
        EnclosedBifurcation {
            kind: self.kind,
            word: Word::pair(),
            periods: self.periods,
            d: self.motion.d().clone(),
            parameter,
            impacts: balance.impacts(&t_1, &middle).to_vec(),
            trace,
            clearance,
            admissible,
            certified: true,
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
    let plastic = middle
        .as_ref()
        .is_ok_and(|balance| balance.loss_factor().magnitude() == 0.0);
    let weightless = middle.is_ok_and(|balance| balance.g().contains_zero());
    let line = Line::new(family, cover);
    let mut crossings = Vec::new();
    let mut halves = Vec::new();
    if family.is_symmetric() {
        crossings = line.multipliers_of_one(&mut found);
        if weightless {
            halves = line.around(
                &line
                    .isolated(&HalvedOneOne {
                        family,
                        periods: cover.periods,
                    })
                    .roots,
            );
        }
    }
    for condition in CONDITIONS {
        // With r_B r_T = 1 multipliers meet at 1 and -1 alone, which are events of their own.
        // With r_B r_T = 0 one is 0 and the other the trace: nothing happens where they meet.
        if (elastic || plastic) && condition.kind() == BifurcationKind::NodeFocus {
            continue;
        }
        let apart = match condition {
            BifurcationCondition::MultiplierOne => &crossings,
            BifurcationCondition::DoubleNegative | BifurcationCondition::MultiplierMinusOne => &halves,
            _ => &Vec::new(),
        };
        conditioned(family, cover, condition, apart, &mut found);
    }
    for touch in TOUCHES {
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
    condition: BifurcationCondition,
    apart: &[IntervalBox<f64, 3>],
    found: &mut Bifurcations,
) {
    let system = ConditionedOneOne {
        family,
        periods: cover.periods,
        condition,
        apart: apart.to_vec(),
    };
    let isolation = isolated(&system, cover.cells.clone());
    for root in distinct_phases(isolation.roots, PHASE) {
        let is_turn = condition == BifurcationCondition::MultiplierOne && is_known_turn(&root, cover.periods, found);
        let new = !is_turn && !is_known_grazing(condition, &root, found);
        if new && system.is_wanted(&root.enclosure) {
            found.located.push(LocatedBifurcation::Condition(condition, root));
        }
    }
    let cells = isolation.undecided.into_iter();
    found.undecided.extend(cells.map(|cell| (condition.kind(), cell)));
}

fn touching(family: &impl Family, cover: &Cover, touch: BifurcationCondition, elastic: bool, found: &mut Bifurcations) {
    let periods = cover.periods;
    let system = ConditionedOneOne {
        family,
        periods,
        condition: touch,
        apart: Vec::new(),
    };
    let after = Interval::new(0.0, 2.0 * f64::from(periods));
    let with_time = |&[t_1, middle, parameter]: &IntervalBox<f64, 3>| [t_1, middle, parameter, after];
    let isolation = isolated(&system, cover.cells.iter().map(with_time).collect());
    for root in distinct_phases(isolation.roots, PHASE) {
        // A reversible motion touches a wall in both of its flights at once: one event. So does one without loss that
        // reaches a wall with velocity 0: it is alone with its reflection in time, and touches there at both phases; and
        // a ball that stands still without gravity while the capsule moves.
        let twin = |located: &LocatedBifurcation| match located {
            LocatedBifurcation::Touch(_, other) => meets(&other.enclosure, &root.enclosure),
            LocatedBifurcation::Condition(BifurcationCondition::ZeroVelocity(_), other) => {
                meets(&other.enclosure, &root.enclosure) && (elastic || stands(family, periods, &other.enclosure))
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
        let system = SymmetricOneOne {
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

/// Whether a multiplier of 1 is one found on the branch of symmetric motions, where T_1 is the number of periods.
fn is_known_turn(root: &ProvedRoot<f64, 3>, periods: u32, found: &Bifurcations) -> bool {
    let [t_1, middle, parameter] = root.enclosure;
    let line = Interval::from_integer(i64::from(periods));
    found.located.iter().any(|located| match located {
        LocatedBifurcation::Turn(turn) => {
            let is_near = middle.is_subset(&turn.unique[0]) && parameter.is_subset(&turn.unique[1]);
            t_1.intersection(&line).is_some() && is_near
        }
        _ => false,
    })
}

/// Whether the event is the velocity of 0 at the other wall: both at once are one event.
fn is_known_grazing(condition: BifurcationCondition, root: &ProvedRoot<f64, 3>, found: &Bifurcations) -> bool {
    matches!(condition, BifurcationCondition::ZeroVelocity(_))
        && found.located.iter().any(|located| match located {
            LocatedBifurcation::Condition(BifurcationCondition::ZeroVelocity(_), other) => {
                meets(&other.enclosure, &root.enclosure)
            }
            _ => false,
        })
}

/// Whether two boxes meet in (T_1, psi, parameter).
fn meets(one: &[Interval<f64>], other: &[Interval<f64>]) -> bool {
    (0..3).all(|i| one[i].intersection(&other[i]).is_some())
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
