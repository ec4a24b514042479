//! Where along a branch something happens.

use crate::orbit::bifurcation::moment::{Candidate, Listing, Moment};
use crate::orbit::continuation::branch::{Branch, BranchEnd, BranchPoint, TOGETHER, between, distance};
use crate::orbit::continuation::extended_system::{ExtendedSystem, apart};
use crate::orbit::continuation::segment::CertifiedSegment;
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::equations::conditions::BifurcationKind;
use crate::orbit::equations::word_conditions::{Mark, Marked};
use crate::orbit::family::Family;

/// Halvings of a piece of a branch before an event on it is told from where it is then known to be.
const MOST_HALVINGS: usize = 16;

/// An event may lie this part of a piece's length off its chord.
const BESIDE: f64 = 0.3;

/// Every change of sign along a branch, and what happens at its ends.
pub(crate) fn moments<F: Family>(along: &ExtendedSystem<F>, strand: &Branch) -> Vec<Moment> {
    let mut moments = Vec::new();
    for (pair, arc) in strand.nodes.windows(2).zip(&strand.arcs) {
        let [one, other] = pair else { continue };
        for mark in marks(one, other) {
            moments.extend(on_piece(along, mark, one, other, arc.as_ref()));
        }
    }
    let ends = [strand.nodes.first(), strand.nodes.last()];
    for (end, node) in strand.ends.iter().zip(ends) {
        if let (BranchEnd::Shorter, Some(node)) = (end, node) {
            moments.extend(of_shorter(along, node));
        }
    }
    moments
}

/// The marks between two motions, whichever comes first.
fn marks(one: &BranchPoint, other: &BranchPoint) -> Vec<Mark> {
    let (from, to) = if one.gauge.moves() { (one, other) } else { (other, one) };
    let mut marks = from.gauge.marks_to(&to.gauge);
    if !to.gauge.moves() {
        // where a flight starts or ends beyond a wall, what it goes through says nothing
        marks.retain(|mark| !matches!(mark, Mark::Touch(..)));
    }
    marks
}

fn on_piece<F: Family>(
    along: &ExtendedSystem<F>,
    mark: Mark,
    one: &BranchPoint,
    other: &BranchPoint,
    arc: Option<&CertifiedSegment>,
) -> Option<Moment> {
    let marked = Marked { along, mark };
    let listing = Listing::Plain;
    let candidate = Candidate {
        marked: &marked,
        listing,
    };
    let (mut low, mut high) = (one.clone(), other.clone());
    let mut guess = None;
    let mut located = None;
    for _ in 0..MOST_HALVINGS {
        guess = guessed(along, mark, &low, &high).or(guess);
        let settled = guess.as_ref().and_then(|guess| candidate.settled(guess));
        if let Some(point) = settled.filter(|point| is_on_piece(along, point, &low, &high)) {
            located = Some(point);
            break;
        }
        let (from, to) = halved(along, mark, &low, &high)?;
        (low, high) = (from, to);
    }
    let point = located.or(guess)?;
    let (phases, rest) = point.split_at(along.impacts());
    let gauge = TestFunctions::new(&along.at(&rest[0])?, phases);
    // at a velocity of 0 its sign is rounding; any other one must be right
    let mut speeds = gauge.speeds.iter().enumerate();
    let moves = speeds.all(|(impact, speed)| *speed > 0.0 || mark == Mark::Slow(impact));
    if !moves || gauge.times.iter().any(|time| *time <= 0.0) || !along.range.contains(&rest[0]) {
        return None;
    }
    let mut moment = candidate.moment(&point)?;
    let last = one.tangent.len() - 1;
    let turns = one.tangent[last] * other.tangent[last] < 0.0;
    if mark == Mark::MultiplierOne && moment.error_bound.is_none() && !(turns && arc.is_some()) {
        moment.event = BifurcationKind::SymmetryBreaking;
    }
    Some(moment)
}

/// The unknowns about where a mark is, between two motions: phases, parameter and the time of a touch.
fn guessed<F: Family>(
    along: &ExtendedSystem<F>,
    mark: Mark,
    low: &BranchPoint,
    high: &BranchPoint,
) -> Option<Vec<f64>> {
    let value = |gauge: &TestFunctions| match mark {
        Mark::Slow(impact) => gauge.speeds[impact],
        Mark::Touch(..) => 0.0,
        _ => Mark::MULTIPLIERS
            .iter()
            .position(|other| *other == mark)
            .map_or(0.0, |i| gauge.multipliers[i]),
    };
    let (from, to) = (value(&low.gauge), value(&high.gauge));
    let part = if from * to < 0.0 { from / (from - to) } else { 0.5 };
    let mut point = between(low, high, part);
    let last = point.len() - 1;
    point[last] = along.parameter(&point[last]);
    if let Mark::Touch(flight, wall) = mark {
        let gauge = TestFunctions::new(&along.at(&point[last])?, &point[..last]);
        let turn = gauge.nearest(flight, wall);
        let turn = turn
            .or_else(|| low.gauge.nearest(flight, wall))
            .or_else(|| high.gauge.nearest(flight, wall))?;
        point.push(turn.after);
    }
    Some(point)
}

fn is_on_piece<F: Family>(along: &ExtendedSystem<F>, point: &[f64], low: &BranchPoint, high: &BranchPoint) -> bool {
    let beside = BESIDE * distance(&low.point, &high.point);
    let last = low.point.len() - 1;
    let coordinate = |i: usize| if i == last { along.place(point[i]) } else { point[i] };
    (0..=last).all(|i| {
        let (from, to) = (low.point[i].min(high.point[i]), low.point[i].max(high.point[i]));
        (from - beside..=to + beside).contains(&coordinate(i))
    })
}

/// The half of a piece on which the mark is.
fn halved<F: Family>(
    along: &ExtendedSystem<F>,
    mark: Mark,
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
    let offset = crate::orbit::continuation::extended_system::dot(&guess, &normal);
    let (point, _) = along.corrected(&guess, &normal, offset)?;
    let tangent = along.tangent(&point, &normal)?;
    let last = point.len() - 1;
    let gauge = TestFunctions::new(&along.at_place(&point[last])?, &point[..last]);
    let middle = BranchPoint { point, tangent, gauge };
    if marks(low, &middle).contains(&mark) {
        Some((low.clone(), middle))
    } else if marks(&middle, high).contains(&mark) {
        Some((middle, high.clone()))
    } else {
        None
    }
}

/// Where a motion becomes one of a shorter word: one that goes through it twice, or with two impacts in one.
fn of_shorter<F: Family>(along: &ExtendedSystem<F>, node: &BranchPoint) -> Option<Moment> {
    let last = node.point.len() - 1;
    let (phases, place) = (&node.point[..last], node.point[last]);
    let times = node.gauge.times.iter().enumerate();
    let (flight, shortest) = times.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let mut guess: Vec<f64>;
    let (word, periods, mark, listing);
    if std::f64::consts::PI * shortest < TOGETHER {
        // the impact that ends the flight is left out
        let gone = (flight + 1) % last;
        word = along.word.without(gone)?;
        guess = phases.to_vec();
        guess.remove(gone);
        let kept = if gone == 0 { last - 2 } else { flight };
        (periods, mark, listing) = (along.periods, Mark::Slow(kept), Listing::Doubled(kept));
    } else {
        word = along.word.half()?;
        if !along.periods.is_multiple_of(2) {
            return None;
        }
        guess = phases[..last / 2].to_vec();
        (periods, mark, listing) = (along.periods / 2, Mark::MultiplierMinusOne, Listing::Twice);
    }
    let shorter = ExtendedSystem {
        family: &along.family,
        word,
        periods,
        range: along.range,
    };
    guess.push(along.parameter(&place));
    let marked = Marked { along: &shorter, mark };
    let candidate = Candidate {
        marked: &marked,
        listing,
    };
    let settled = candidate.settled(&guess);
    let near = settled.filter(|point| apart(point, &guess) < 100.0 * TOGETHER);
    candidate.moment(&near.unwrap_or(guess))
}
