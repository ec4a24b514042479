//! Which motions at neighbouring values of a parameter are one branch.

use super::step::Step;
use std::f64::consts::TAU;

/// Motions farther apart than this, in phase or velocity, are no neighbours on a branch.
const FARTHEST: f64 = 0.5;

/// The motions, in order of the parameter, in lines: each goes on to the motion at the next value that is nearest to
/// it, where it is the nearest to that one too. Two lines that end at a fold meet there.
pub(super) fn strands<'a>(steps: &[&'a Step], folds: &[&'a Step]) -> Vec<Vec<&'a Step>> {
    let columns: Vec<&[&Step]> = steps.chunk_by(|one, other| one.at == other.at).collect();
    let mut strands: Vec<Vec<&Step>> = Vec::new();
    // the strands that reach the last column, in its order
    let mut open: Vec<usize> = Vec::new();
    for (number, column) in columns.iter().enumerate() {
        let last: &[&Step] = number.checked_sub(1).map_or(&[], |before| columns[before]);
        let mut reached = Vec::new();
        for step in column.iter() {
            let before = nearest(step, last).filter(|&before| {
                nearest(last[before], column).is_some_and(|mutual| std::ptr::eq(column[mutual], *step))
            });
            match before.and_then(|before| open.get(before)) {
                Some(&strand) => {
                    strands[strand].push(step);
                    reached.push(strand);
                }
                None => {
                    strands.push(vec![step]);
                    reached.push(strands.len() - 1);
                }
            }
        }
        open = reached;
    }
    let widest = columns
        .windows(2)
        .map(|pair| (pair[1][0].at - pair[0][0].at).abs())
        .fold(0.0, f64::max);
    for fold in folds {
        close(&mut strands, fold, widest);
    }
    strands
}

/// Leads the two ends nearest to a fold, at most a value of the sweep away, into it.
fn close<'a>(strands: &mut [Vec<&'a Step>], fold: &'a Step, widest: f64) {
    let mut ends: Vec<(f64, usize, bool)> = Vec::new();
    for (number, strand) in strands.iter().enumerate() {
        for (end, is_first) in [(strand.first(), true), (strand.last(), false)] {
            let near = end.filter(|end| (end.at - fold.at).abs() <= widest * 1.001);
            if let Some(distance) = near.and_then(|end| distance(end, fold)) {
                ends.push((distance, number, is_first));
            }
        }
    }
    ends.sort_by(|one, other| one.0.total_cmp(&other.0));
    for (_, number, is_first) in ends.into_iter().take(2) {
        if is_first {
            strands[number].insert(0, fold);
        } else {
            strands[number].push(fold);
        }
    }
}

fn nearest(step: &Step, among: &[&Step]) -> Option<usize> {
    let distances = among.iter().map(|other| distance(step, other));
    let near = distances
        .enumerate()
        .filter_map(|(index, distance)| Some((index, distance?)));
    near.min_by(|one, other| one.1.total_cmp(&other.1))
        .map(|(index, _)| index)
}

/// The largest difference of a phase, around the circle, or a velocity.
fn distance(one: &Step, other: &Step) -> Option<f64> {
    if one.phases.len() != other.phases.len() {
        return None;
    }
    let phases = one.phases.iter().zip(&other.phases).map(|(one, other)| {
        let apart = (one - other).abs() % TAU;
        apart.min(TAU - apart)
    });
    let velocities = one.velocities.iter().zip(&other.velocities);
    let velocities = velocities.map(|(one, other)| (one - other).abs());
    let distance = phases.chain(velocities).fold(0.0, f64::max);
    (distance <= FARTHEST).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::super::step::Course;
    use super::*;

    fn step(at: f64, phase: f64) -> Step {
        Step {
            at,
            name: String::new(),
            phases: vec![phase],
            velocities: vec![1.0],
            course: Course::Stable,
        }
    }

    #[test]
    fn branches_keep_apart_and_go_on_around_the_circle() {
        let steps = [(0.0, 6.2), (0.0, 3.0), (1.0, 2.9), (1.0, 0.05), (2.0, 0.1)].map(|(at, phase)| step(at, phase));
        let steps: Vec<&Step> = steps.iter().collect();
        let found = strands(&steps, &[]);
        let lengths: Vec<usize> = found.iter().map(Vec::len).collect();
        assert_eq!(lengths, [3, 2]);
        assert_eq!(found[0][2].phases, [0.1]);
    }

    #[test]
    fn two_branches_meet_at_a_fold() {
        let steps = [(0.0, 1.0), (1.0, 1.1), (1.0, 1.5), (2.0, 1.0), (2.0, 1.6)].map(|(at, phase)| step(at, phase));
        let steps: Vec<&Step> = steps[1..].iter().collect();
        let fold = step(0.5, 1.3);
        let found = strands(&steps, &[&fold]);
        assert!(found.iter().all(|strand| strand[0].at == 0.5) && found.len() == 2);
    }
}
