//! A search for the points at which a form keeps the fewest digits of those allowed.

use super::StressError;
use super::quantity::{Judge, Quantity, Visitor, rows};
use super::row::{Form, StressRow, allowed};
use crate::trade::digits_of;
use numbers::Sequence;
use std::time::{Duration, Instant};

/// The seed of the first quantity; the others count on.
const SEED: u64 = 20;

/// A climb that has not come further in so many steps starts anew.
const PATIENCE: u32 = 30;

/// The longest step, as a part of the range of a dial, and how much shorter each failure makes it.
const STEP: f64 = 0.2;
const SHORTER: f64 = 0.85;

/// Tries for a start that is a motion.
const MOST_STARTS: u32 = 200;

/// Finds worst points, one for each form of a quantity, for a share of the time.
pub(super) struct Search {
    /// For each form of a quantity.
    pub share: Duration,
    pub visited: u64,
    pub rows: Vec<StressRow>,
}

/// A point and how many more digits a form keeps there than are allowed: below 0 as a rule.
#[derive(Clone)]
struct Place {
    dials: Vec<f64>,
    margin: f64,
}

struct Climb<'a, Q> {
    quantity: &'a Q,
    form: Form,
    ranges: Vec<[f64; 2]>,
    sequence: Sequence,
    until: Instant,
}

impl Visitor for Search {
    fn visit(&mut self, quantity: &impl Quantity) -> Result<(), StressError> {
        for form in [Form::Printed, Form::Stable] {
            let mut climb = Climb {
                quantity,
                form,
                ranges: quantity.dials(),
                sequence: Sequence::new(SEED + self.visited),
                until: Instant::now() + self.share,
            };
            self.visited += 1;
            if let Some(worst) = climb.worst()? {
                let found = rows(quantity, &quantity.set(&worst.dials))?;
                self.rows.extend(found.unwrap_or_default());
            }
        }
        Ok(())
    }
}

impl<Q: Quantity> Climb<'_, Q> {
    fn is_over(&self) -> bool {
        Instant::now() >= self.until
    }

    /// The worst point of all climbs; none where no start is a motion.
    fn worst(&mut self) -> Result<Option<Place>, StressError> {
        let mut worst: Option<Place> = None;
        while let Some(found) = self.once(worst.as_ref())? {
            if worst.as_ref().is_none_or(|worst| found.margin < worst.margin) {
                worst = Some(found);
            }
            if self.is_over() {
                break;
            }
        }
        Ok(worst)
    }

    /// The margin at a point, or nothing where it is not below `bound` or there is no motion.
    fn margin(&self, dials: &[f64], bound: f64) -> Result<Option<f64>, StressError> {
        let Some(judge) = Judge::new(self.quantity, &self.quantity.set(dials))? else {
            return Ok(None);
        };
        let digits = digits_of(judge.error::<f64>(self.quantity, self.form), f64::EPSILON);
        // what is allowed is at most this: the dear condition number need not be known
        if digits - allowed(f64::EPSILON, 1.0) >= bound {
            return Ok(None);
        }
        let margin = digits - allowed(f64::EPSILON, judge.condition(self.quantity));
        Ok((margin < bound).then_some(margin))
    }

    /// One climb from a random start, until it is stuck; `None` where no start is a motion.
    fn once(&mut self, known: Option<&Place>) -> Result<Option<Place>, StressError> {
        let mut place = None;
        for _ in 0..MOST_STARTS {
            let dials: Vec<f64> = (0..self.ranges.len())
                .map(|at| self.sequence.between(self.ranges[at][0], self.ranges[at][1]))
                .collect();
            if let Some(margin) = self.margin(&dials, f64::INFINITY)? {
                place = Some(Place { dials, margin });
                break;
            }
            if self.is_over() && known.is_some() {
                return Ok(None);
            }
        }
        let Some(mut place) = place else {
            return Ok(None);
        };
        let (mut failures, mut step) = (0, STEP);
        while failures < PATIENCE && !self.is_over() {
            let mut dials = place.dials.clone();
            for (dial, [low, high]) in dials.iter_mut().zip(&self.ranges) {
                let moved = *dial + step * (high - low) * self.sequence.between(-1.0, 1.0);
                *dial = moved.clamp(*low, *high);
            }
            match self.margin(&dials, place.margin)? {
                Some(margin) => {
                    place = Place { dials, margin };
                    (failures, step) = (0, STEP);
                }
                None => {
                    failures += 1;
                    step *= SHORTER;
                }
            }
        }
        Ok(Some(place))
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Loss;
    use super::*;

    #[test]
    fn a_climb_comes_below_where_it_may_start() {
        let loss = Loss { broken: false };
        let share = Duration::from_millis(300);
        let (visited, found) = (0, Vec::new());
        let mut search = Search {
            share,
            visited,
            rows: found,
        };
        search.visit(&loss).unwrap();
        let least = |rows: &[StressRow]| {
            let printed = rows
                .iter()
                .filter(|row| row.form == Form::Printed && row.number == "f64");
            printed
                .map(|row| row.digits - row.allowed)
                .fold(f64::INFINITY, f64::min)
        };
        let harmless = rows(&loss, &loss.set(&loss.settings()[0])).unwrap().unwrap();
        assert!(least(&search.rows) <= least(&harmless));
        assert_eq!(search.rows.len(), 2 * harmless.len());
    }
}
