//! Bifurcations along a branch of motions of any word: a change of sign of a test function brackets one.

use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::bifurcation::words::{ConditionedWord, Listing};
use crate::orbit::continuation::branch::{Branch, BranchEnd, BranchPoint, TOGETHER, between, distance};
use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::continuation::extended_system::ExtendedSystem;
use crate::orbit::continuation::segment::CertifiedSegment;
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::family::Family;
use crate::orbit::interval_box::apart;

/// Maximum number of bisections of a piece of a branch; after it the interpolated guess is reported.
const MOST_HALVINGS: usize = 16;

/// A bifurcation may lie off the chord of its piece by this part of its length.
const BESIDE: f64 = 0.3;

/// Every bifurcation along a branch, and those at its ends.
pub(crate) fn detect<F: Family>(extended: &ExtendedSystem<F>, branch: &Branch) -> Vec<BifurcationPoint> {
    let mut found = Vec::new();
    for (pair, segment) in branch.nodes.windows(2).zip(&branch.segments) {
        let [one, other] = pair else { continue };
        for condition in conditions(one, other) {
            found.extend(on_piece(extended, condition, one, other, segment.as_ref()));
        }
    }
    let ends = [branch.nodes.first(), branch.nodes.last()];
    for (end, node) in branch.ends.iter().zip(ends) {
        if let (BranchEnd::Shorter, Some(node)) = (end, node) {
            found.extend(of_shorter(extended, node));
        }
    }
    found
}

/// The conditions met between two motions, whichever comes first.
fn conditions(one: &BranchPoint, other: &BranchPoint) -> Vec<BifurcationCondition> {
    let (from, to) = if one.functions.moves() {
        (one, other)
    } else {
        (other, one)
    };
    let mut conditions = from.functions.conditions_met(&to.functions);
    if !to.functions.moves() {
        // where a flight starts or ends beyond a wall, what it goes through says nothing
        conditions.retain(|condition| !matches!(condition, BifurcationCondition::Touch(..)));
    }
    conditions
}

fn on_piece<F: Family>(
    extended: &ExtendedSystem<F>,
    condition: BifurcationCondition,
    one: &BranchPoint,
    other: &BranchPoint,
    segment: Option<&CertifiedSegment>,
) -> Option<BifurcationPoint> {
    let system = ConditionedWord {
        extended,
        condition,
        listing: Listing::Plain,
    };
    let (mut low, mut high) = (one.clone(), other.clone());
    let mut guess = None;
    let mut located = None;
    for _ in 0..MOST_HALVINGS {
        guess = guessed(extended, condition, &low, &high).or(guess);
        let solved = guess.as_ref().and_then(|guess| system.solved(guess));
        if let Some(point) = solved.filter(|point| is_on_piece(extended, point, &low, &high)) {
            located = Some(point);
            break;
        }
        let (from, to) = halved(extended, condition, &low, &high)?;
        (low, high) = (from, to);
    }
    let point = located.or(guess)?;
    let (phases, rest) = point.split_at(extended.impacts());
    let functions = TestFunctions::new(&extended.at(&rest[0])?, phases);
    // at a velocity of 0 its sign is rounding; any other one must be right
    let mut speeds = functions.speeds.iter().enumerate();
    let moves = speeds.all(|(impact, speed)| *speed > 0.0 || condition == BifurcationCondition::ZeroVelocity(impact));
    if !moves || functions.times.iter().any(|time| *time <= 0.0) || !extended.range.contains(&rest[0]) {
        return None;
    }
    let mut found = system.located(&point)?;
    let last = one.tangent.len() - 1;
    let turns = one.tangent[last] * other.tangent[last] < 0.0;
    if condition == BifurcationCondition::MultiplierOne && found.error_bound.is_none() && !(turns && segment.is_some())
    {
        found.kind = BifurcationKind::SymmetryBreaking;
    }
    Some(found)
}

/// A guess at the unknowns where a condition is met between two motions: phases, parameter and the time of a touch.
fn guessed<F: Family>(
    extended: &ExtendedSystem<F>,
    condition: BifurcationCondition,
    low: &BranchPoint,
    high: &BranchPoint,
) -> Option<Vec<f64>> {
    let value = |functions: &TestFunctions| match condition {
        BifurcationCondition::ZeroVelocity(impact) => functions.speeds[impact],
        BifurcationCondition::Touch(..) => 0.0,
        _ => BifurcationCondition::MULTIPLIERS
            .iter()
            .position(|other| *other == condition)
            .map_or(0.0, |i| functions.multipliers[i]),
    };
    let (from, to) = (value(&low.functions), value(&high.functions));
    let part = if from * to < 0.0 { from / (from - to) } else { 0.5 };
    let mut point = between(low, high, part);
    let last = point.len() - 1;
    point[last] = extended.parameter(&point[last]);
    if let BifurcationCondition::Touch(flight, wall) = condition {
        let functions = TestFunctions::new(&extended.at(&point[last])?, &point[..last]);
        let turn = functions.nearest(flight, wall);
        let turn = turn
            .or_else(|| low.functions.nearest(flight, wall))
            .or_else(|| high.functions.nearest(flight, wall))?;
        point.push(turn.after);
    }
    Some(point)
}

fn is_on_piece<F: Family>(extended: &ExtendedSystem<F>, point: &[f64], low: &BranchPoint, high: &BranchPoint) -> bool {
    let beside = BESIDE * distance(&low.point, &high.point);
    let last = low.point.len() - 1;
    let coordinate = |i: usize| if i == last { extended.place(point[i]) } else { point[i] };
    (0..=last).all(|i| {
        let (from, to) = (low.point[i].min(high.point[i]), low.point[i].max(high.point[i]));
        (from - beside..=to + beside).contains(&coordinate(i))
    })
}

/// The half of a piece on which the condition is met.
fn halved<F: Family>(
    extended: &ExtendedSystem<F>,
    condition: BifurcationCondition,
    low: &BranchPoint,
    high: &BranchPoint,
) -> Option<(BranchPoint, BranchPoint)> {
    let guess = between(low, high, 0.5);
    let normal: Vec<f64> = low
        .tangent
        .iter()
        .zip(&high.tangent)
        .map(|(one, other)| one + other)
        .collect();
    let offset = dot(&guess, &normal);
    let (point, _) = extended.corrected(&guess, &normal, offset)?;
    let tangent = extended.tangent(&point, &normal)?;
    let last = point.len() - 1;
    let functions = TestFunctions::new(&extended.at_place(&point[last])?, &point[..last]);
    let middle = BranchPoint {
        point,
        tangent,
        functions,
    };
    if conditions(low, &middle).contains(&condition) {
        Some((low.clone(), middle))
    } else if conditions(&middle, high).contains(&condition) {
        Some((middle, high.clone()))
    } else {
        None
    }
}

/// Where a motion becomes one of a shorter word: one that goes through it twice, or with two impacts in one.
fn of_shorter<F: Family>(extended: &ExtendedSystem<F>, node: &BranchPoint) -> Option<BifurcationPoint> {
    let last = node.point.len() - 1;
    let (phases, place) = (&node.point[..last], node.point[last]);
    let times = node.functions.times.iter().enumerate();
    let (flight, shortest) = times.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let mut guess: Vec<f64>;
    let (word, periods, condition, listing);
    if std::f64::consts::PI * shortest < TOGETHER {
        // the impact that ends the flight is left out
        let gone = (flight + 1) % last;
        word = extended.word.without(gone)?;
        guess = phases.to_vec();
        guess.remove(gone);
        let kept = if gone == 0 { last - 2 } else { flight };
        (periods, condition, listing) = (
            extended.periods,
            BifurcationCondition::ZeroVelocity(kept),
            Listing::Doubled(kept),
        );
    } else {
        word = extended.word.half()?;
        if !extended.periods.is_multiple_of(2) {
            return None;
        }
        guess = phases[..last / 2].to_vec();
        (periods, condition, listing) = (
            extended.periods / 2,
            BifurcationCondition::MultiplierMinusOne,
            Listing::Twice,
        );
    }
    let shorter = ExtendedSystem {
        family: &extended.family,
        word,
        periods,
        range: extended.range,
        options: extended.options,
    };
    guess.push(extended.parameter(&place));
    let system = ConditionedWord {
        extended: &shorter,
        condition,
        listing,
    };
    let solved = system.solved(&guess);
    let near = solved.filter(|point| apart(point, &guess) < 100.0 * TOGETHER);
    system.located(&near.unwrap_or(guess))
}
