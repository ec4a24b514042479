//! The special points of a curve of bifurcations: where a second condition holds.

use crate::model::Side;
use crate::orbit::continuation::branch::{BranchPoint, Continued, between, distance};
use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::curves::coefficient::{kernels, odd_equation};
use crate::orbit::curves::curve_system::{CurveCondition, CurveFunctions, CurveSystem, PLACES, STILL};
use crate::orbit::equations::conditions::BifurcationCondition::{
    self, MultiplierMinusOne, MultiplierOne, Touch, ZeroVelocity,
};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::touch::time_from_impact;
use crate::orbit::family::ParameterPlane;
use std::fmt;

/// What a point of a curve is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SpecialPoint {
    /// Nothing special: a step.
    Step,
    /// A parameter is at the end of its range.
    Edge,
    /// The curve of folds has a cusp over the plane; where r_B = r_T and g = 0, a symmetry breaking.
    Cusp,
    /// The cubic coefficient of a period doubling is 0: it changes between soft and hard.
    DegenerateFlip,
    /// The cubic coefficient of a symmetry breaking is 0.
    DegeneratePitchfork,
    /// The motion grazes too; with velocity 0 at an impact the curve ends.
    Grazing,
    /// On a curve of grazings, a multiplier is 1.
    Fold,
    /// On a curve of grazings, a multiplier is -1.
    PeriodDoubling,
    /// A motion that grazes grazes a second time.
    DoubleGrazing,
    /// f + g is 0 where the motion grazes.
    DegenerateGrazing,
    /// The curve is back where it began.
    Closed,
    /// No step on could be made.
    Lost,
}

impl fmt::Display for SpecialPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Step => "step",
            Self::Edge => "edge",
            Self::Cusp => "cusp",
            Self::DegenerateFlip => "degenerate-flip",
            Self::DegeneratePitchfork => "degenerate-pitchfork",
            Self::Grazing => "grazing",
            Self::Fold => "fold",
            Self::PeriodDoubling => "period-doubling",
            Self::DoubleGrazing => "double-grazing",
            Self::DegenerateGrazing => "degenerate-grazing",
            Self::Closed => "closed",
            Self::Lost => "lost",
        })
    }
}

/// Maximum number of bisections of a piece; after it nothing is reported.
const MOST_HALVINGS: usize = 20;

/// A special point may lie off the chord of its piece by this part of its length.
const BESIDE: f64 = 0.3;

type Node = BranchPoint<CurveFunctions>;

/// A special point: what it is, what holds there, and where Newton's method finds it.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub point: SpecialPoint,
    pub condition: CurveCondition,
    pub at: Vec<f64>,
}

/// The special points on a piece of a curve between two nodes, in order.
pub(crate) fn on_piece<P: ParameterPlane>(curve: &CurveSystem<'_, P>, one: &Node, other: &Node) -> Vec<Found> {
    let mut changed: Vec<CurveCondition> = candidates(curve, one)
        .into_iter()
        .filter(|condition| changes(curve, condition, one, other))
        .collect();
    // where a flight starts or ends beyond a wall, what it goes through says nothing
    let pushed = changed
        .iter()
        .any(|condition| matches!(condition, CurveCondition::Push(_)));
    let moves = ![one, other].iter().any(|node| curve.is_beyond(node));
    changed.retain(|condition| match condition {
        CurveCondition::Bifurcation(Touch(..)) => moves && !pushed,
        CurveCondition::Bifurcation(MultiplierOne) => !pushed,
        _ => true,
    });
    let mut found: Vec<Found> = Vec::new();
    for condition in changed {
        let Some(at) = located(curve, &condition, one, other) else {
            continue;
        };
        // a motion that is its own mirror image touches in two flights at once
        let same = |known: &Found| distance(&known.at[..PLACES.end], &at[..PLACES.end]) < SAME;
        if !found.iter().any(same) {
            let point = name(curve.own(), &condition);
            found.push(Found { point, condition, at });
        }
    }
    found.sort_by(|a, b| part(&a.at, one, other).total_cmp(&part(&b.at, one, other)));
    found
}

/// Special points nearer to each other are one.
pub(crate) const SAME: f64 = 1e-9;

fn name(own: &CurveCondition, condition: &CurveCondition) -> SpecialPoint {
    let grazes = matches!(own, CurveCondition::Bifurcation(Touch(..) | ZeroVelocity(_)));
    match condition {
        CurveCondition::Cusp(_) => SpecialPoint::Cusp,
        CurveCondition::DegenerateFlip(_) => SpecialPoint::DegenerateFlip,
        CurveCondition::DegeneratePitchfork(_) => SpecialPoint::DegeneratePitchfork,
        CurveCondition::Push(_) | CurveCondition::TouchPush => SpecialPoint::DegenerateGrazing,
        CurveCondition::Place(..) => SpecialPoint::Edge,
        CurveCondition::Bifurcation(Touch(..) | ZeroVelocity(_)) if grazes => SpecialPoint::DoubleGrazing,
        CurveCondition::Bifurcation(Touch(..) | ZeroVelocity(_)) => SpecialPoint::Grazing,
        CurveCondition::Bifurcation(MultiplierMinusOne) => SpecialPoint::PeriodDoubling,
        CurveCondition::Bifurcation(_) | CurveCondition::SymmetryBreaking | CurveCondition::SymmetricFold => {
            SpecialPoint::Fold
        }
        CurveCondition::Across(..) => SpecialPoint::Step,
    }
}

/// What may hold at a point of a curve besides its own condition.
fn candidates<P: ParameterPlane>(curve: &CurveSystem<'_, P>, node: &Node) -> Vec<CurveCondition> {
    let mut all: Vec<BifurcationCondition> = vec![ZeroVelocity(0), ZeroVelocity(1)];
    for flight in 0..2 {
        all.extend([Side::Bottom, Side::Top].map(|wall| Touch(flight, wall)));
    }
    let mut more = Vec::new();
    let (motion, at) = (curve.motion(&node.point[PLACES]), [&node.point[0], &node.point[1]]);
    match curve.own() {
        CurveCondition::Bifurcation(own @ Touch(..)) => {
            all.retain(|condition| condition != own);
            all.extend([MultiplierOne, MultiplierMinusOne]);
            more.push(CurveCondition::TouchPush);
        }
        CurveCondition::Bifurcation(own @ ZeroVelocity(impact)) => {
            all.retain(|condition| condition != own);
            // the trace has its pole there: where one level of it is met, all are
            all.push(MultiplierOne);
            more.push(CurveCondition::Push(*impact));
        }
        CurveCondition::Bifurcation(MultiplierOne) => more.extend(weights(curve, node).map(CurveCondition::Cusp)),
        CurveCondition::Bifurcation(MultiplierMinusOne) => {
            let found = motion.and_then(|motion| kernels(&motion, curve.periods, at));
            more.extend(found.map(CurveCondition::DegenerateFlip));
        }
        CurveCondition::SymmetryBreaking => {
            let found = motion.map(|motion| odd_equation(&motion, curve.periods, at));
            more.extend(found.map(CurveCondition::DegeneratePitchfork));
        }
        _ => {}
    }
    let all = all.into_iter().map(CurveCondition::Bifurcation);
    more.into_iter().chain(all).collect()
}

/// With which weights the two equations, whose derivatives by (T_1, psi) are parallel on a curve of folds, add up.
fn weights<P: ParameterPlane>(curve: &CurveSystem<'_, P>, node: &Node) -> Option<[f64; 2]> {
    let motion = curve.motion(&node.point[PLACES])?;
    let balance = OneOneEquations::new(&motion, curve.periods);
    let [first, second] = balance.linearised(&node.point[0], &node.point[1]).1;
    let (one, other, both) = (dot(&first, &first), dot(&second, &second), dot(&first, &second));
    Some(if one >= other {
        [1.0, both / one]
    } else {
        [both / other, 1.0]
    })
}

/// Whether a condition is met between two nodes, an odd number of times.
fn changes<P: ParameterPlane>(
    curve: &CurveSystem<'_, P>,
    condition: &CurveCondition,
    one: &Node,
    other: &Node,
) -> bool {
    match condition {
        CurveCondition::Bifurcation(Touch(flight, wall)) => {
            let crossings = |node: &Node| node.functions.motion.crossings[*flight][usize::from(*wall == Side::Top)];
            crossings(one) != crossings(other)
        }
        condition => {
            let ends = values(curve, condition, one, other);
            ends.is_some_and(|[from, to]| from * to < 0.0 && from.abs().max(to.abs()) > STILL)
        }
    }
}

/// What is 0 where a condition holds, at two nodes.
fn values<P: ParameterPlane>(
    curve: &CurveSystem<'_, P>,
    condition: &CurveCondition,
    one: &Node,
    other: &Node,
) -> Option<[f64; 2]> {
    let both = curve.with(condition.clone());
    Some([both.excess(&one.point)?, both.excess(&other.point)?])
}

/// Where the condition is met on the piece.
fn located<P: ParameterPlane>(
    curve: &CurveSystem<'_, P>,
    condition: &CurveCondition,
    one: &Node,
    other: &Node,
) -> Option<Vec<f64>> {
    let system = curve.with(condition.clone());
    let (mut low, mut high) = (one.clone(), other.clone());
    for _ in 0..MOST_HALVINGS {
        let solved = guessed(curve, condition, &low, &high).and_then(|guess| system.solved(&guess));
        if let Some(at) = solved.filter(|at| is_on_piece(at, &low, &high)) {
            return Some(at);
        }
        let middle = halfway(curve, &low, &high)?;
        if changes(curve, condition, &low, &middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    None
}

/// A guess at where the condition is met, with the time of a second touch.
fn guessed<P: ParameterPlane>(
    curve: &CurveSystem<'_, P>,
    condition: &CurveCondition,
    low: &Node,
    high: &Node,
) -> Option<Vec<f64>> {
    if let CurveCondition::Bifurcation(Touch(flight, wall)) = condition {
        let mut guess = between(low, high, 0.5);
        let from_impact = |node: &CurveFunctions| {
            let turn = node.motion.nearest(*flight, *wall)?;
            Some(time_from_impact(
                (*flight, *wall),
                turn.after,
                node.motion.times[*flight],
            ))
        };
        let functions = curve.functions(&guess)?;
        let nodes = [&functions, &low.functions, &high.functions];
        guess.push(nodes.into_iter().find_map(from_impact)?);
        return Some(guess);
    }
    let [from, to] = values(curve, condition, low, high)?;
    let part = if from * to < 0.0 { from / (from - to) } else { 0.5 };
    Some(between(low, high, part))
}

/// The node in the middle of a piece.
fn halfway<P: ParameterPlane>(curve: &CurveSystem<'_, P>, low: &Node, high: &Node) -> Option<Node> {
    let guess = between(low, high, 0.5);
    let pairs = low.tangent.iter().zip(&high.tangent);
    let normal: Vec<f64> = pairs.map(|(one, other)| one + other).collect();
    let (point, _) = curve.corrected(&guess, &normal, dot(&guess, &normal))?;
    let tangent = curve.tangent(&point, &normal)?;
    let functions = curve.functions(&point)?;
    Some(BranchPoint {
        point,
        tangent,
        functions,
    })
}

/// How far along the chord a point lies, as a part of it.
fn part(at: &[f64], one: &Node, other: &Node) -> f64 {
    let chord: Vec<f64> = other.point.iter().zip(&one.point).map(|(to, from)| to - from).collect();
    let ahead: Vec<f64> = at.iter().zip(&one.point).map(|(at, from)| at - from).collect();
    dot(&ahead, &chord) / dot(&chord, &chord)
}

fn is_on_piece(at: &[f64], low: &Node, high: &Node) -> bool {
    let beside = BESIDE * distance(&low.point, &high.point);
    let mut sides = at.iter().zip(low.point.iter().zip(&high.point));
    sides.all(|(at, (low, high))| (low.min(*high) - beside..=low.max(*high) + beside).contains(at))
}
