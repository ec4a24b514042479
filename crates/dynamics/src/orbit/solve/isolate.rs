//! All solutions of a small system of equations in a box, each proved to be there and to be the only one near.
//!
//! Branch and prune (Neumaier, *Interval Methods for Systems of Equations*, 1990, ch. 5): a cell is dropped where an
//! equation excludes 0, contracted by Krawczyk's operator K = m - Y F(m) + (I - Y J)(cell - m), and halved where
//! that does not help. K inside the cell proves one solution in it, an empty intersection none (Krawczyk, 1969).

use crate::orbit::equations::square_system::{Decision, SquareSystem};
use crate::orbit::interval_box::{IntervalBox, halves, holds, intersection, is_inside, is_subset, width};
use crate::orbit::solve::krawczyk::{ProvedRoot, image, narrow, prove};
use numbers::{Endpoint, Interval};
use stop;

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Isolation<E: Endpoint, const D: usize> {
    /// The proved solutions.
    pub roots: Vec<ProvedRoot<E, D>>,
    /// Boxes that may hold solutions, none, one or several: near double ones, or where cells ran out.
    pub undecided: Vec<IntervalBox<E, D>>,
    /// Every cell that was decided, in the order of the search.
    pub decided: Vec<(IntervalBox<E, D>, Decision)>,
}

impl<E: Endpoint, const D: usize> Isolation<E, D> {
    /// Whether every solution that is asked for is among the roots.
    pub fn is_complete(&self) -> bool {
        self.undecided.is_empty()
    }
}

/// How far a search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchLimits {
    /// Cells narrower than this in every direction are not halved again.
    pub finest: f64,
    /// After this many cells all that is left is undecided.
    pub most_cells: usize,
}

/// The first trial of a proof around a likely root takes a box this much wider than the cell it was found in.
const GENEROUS: f64 = 2.0;

/// No side of that box is below this part of the widest: in a thin one the root may lie on the seam of two cells,
/// neither of which the box covers.
const THINNEST: f64 = 1e-3;

/// A cell that shrinks to this part of its width is contracted again, else halved.
const WORTHWHILE: f64 = 0.6;

/// All solutions in `cells`. `roots` may hold solutions proved before: they are not looked for again, and stand
/// first in the answer.
pub fn isolate<E: Endpoint, const D: usize, S: SquareSystem<E, D>>(
    system: &S,
    cells: Vec<IntervalBox<E, D>>,
    roots: Vec<ProvedRoot<E, D>>,
    limits: SearchLimits,
) -> Isolation<E, D> {
    let mut search = Search {
        system,
        limits,
        found: Isolation {
            roots,
            undecided: Vec::new(),
            decided: Vec::new(),
        },
    };
    let mut left: Vec<IntervalBox<E, D>> = cells;
    left.reverse();
    while let Some(cell) = left.pop() {
        if search.found.decided.len() + left.len() > limits.most_cells || !stop::goes_on() {
            search.decide(cell, Decision::Undecided);
            continue;
        }
        match search.examine(&cell) {
            Step::Decided(decision) => search.decide(cell, decision),
            Step::Again(smaller) => left.push(smaller),
            Step::Halves(one, other) => left.extend([other, one]),
        }
    }
    search.found
}

struct Search<'a, E: Endpoint, const D: usize, S> {
    system: &'a S,
    limits: SearchLimits,
    found: Isolation<E, D>,
}

enum Step<E: Endpoint, const D: usize> {
    Decided(Decision),
    Again(IntervalBox<E, D>),
    Halves(IntervalBox<E, D>, IntervalBox<E, D>),
}

impl<E: Endpoint, const D: usize, S: SquareSystem<E, D>> Search<'_, E, D, S> {
    fn decide(&mut self, cell: IntervalBox<E, D>, decision: Decision) {
        if decision == Decision::Undecided {
            self.found.undecided.push(cell.clone());
        }
        self.found.decided.push((cell, decision));
    }

    fn known(&self, cell: &IntervalBox<E, D>) -> Option<usize> {
        let roots = &self.found.roots;
        roots.iter().position(|root| is_subset(cell, &root.unique))
    }

    fn examine(&mut self, cell: &IntervalBox<E, D>) -> Step<E, D> {
        if let Some(root) = self.known(cell) {
            return Step::Decided(Decision::Root(root));
        }
        let slopes = match self.system.examined(cell) {
            Ok(slopes) => slopes,
            Err(decision) => return Step::Decided(decision),
        };
        let finest = cell.iter().all(|side| width(side) < self.limits.finest);
        if let Some(image) = image(cell, &slopes, |at| Some(self.system.values(at))) {
            let Some(smaller) = intersection(&image, cell) else {
                return Step::Decided(Decision::Emptied);
            };
            if is_inside(&image, cell) {
                let root = narrow(self.system, cell.clone(), image);
                // The only one in the cell may be one that was proved before in another box.
                let known = self.known(&root.enclosure);
                return Step::Decided(Decision::Root(known.unwrap_or_else(|| {
                    self.found.roots.push(root);
                    self.found.roots.len() - 1
                })));
            }
            if let Some(root) = self.propose(cell, &image) {
                // Not decided yet: the cell may reach beyond the box in which the root is the only one.
                if is_subset(cell, &self.found.roots[root].unique) {
                    return Step::Decided(Decision::Root(root));
                }
            } else if !finest && (0..D).any(|i| width(&smaller[i]) < WORTHWHILE * width(&cell[i])) {
                return Step::Again(smaller);
            }
        }
        if finest {
            return Step::Decided(Decision::Undecided);
        }
        let (one, other) = halves(cell, &slopes);
        Step::Halves(one, other)
    }

    /// Tries to prove a root in a box around the middle of Krawczyk's image, which is a step of Newton's method from
    /// that of the cell; its number where it is a new one.
    fn propose(&mut self, cell: &IntervalBox<E, D>, image: &IntervalBox<E, D>) -> Option<usize> {
        let point = image.each_ref().map(Interval::midpoint);
        let widest = cell.iter().map(width).fold(0.0, f64::max);
        let reach = |i: usize| 0.5 * GENEROUS * width(&cell[i]).max(THINNEST * widest);
        let near = (0..D).all(|i| (point[i].clone() - cell[i].midpoint()).to_f64().abs() <= reach(i));
        if !near || self.found.roots.iter().any(|root| holds(&root.unique, &point)) {
            return None;
        }
        let root = [1.0, 0.125]
            .iter()
            .find_map(|part| prove(self.system, &point, &std::array::from_fn(|i| part * reach(i))))?;
        // From afar the step may have led to one that was proved before.
        if self.known(&root.enclosure).is_some() {
            return None;
        }
        self.found.roots.push(root);
        Some(self.found.roots.len() - 1)
    }
}

#[cfg(test)]
mod tests;
