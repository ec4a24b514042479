//! Whether the supremum is the value of a motion, or only approached where the motion stops attracting or grazes.

use crate::orbit::clearance::OrbitFlight;
use crate::orbit::interval_box::width;
use crate::orbit::optimum::cell::{Cell, Constraint, Form, Formulas, UNKNOWNS, flight};
use crate::orbit::optimum::design::Choice;
use nalgebra::{DMatrix, DVector};
use numbers::Interval;

/// A direction in the space of the unknowns.
type Direction = [Interval; UNKNOWNS];

/// Singular values below this part of the largest count as 0.
const SINGULAR: f64 = 1e-9;

/// Whether the supremum over a choice is attained, of which the best motions are all in `cells`; `None` where neither is
/// proved.
///
/// The motions that are not asked to be stable by a margin are to attract: |Tr| < 1 + Det. It is attained where every motion
/// of the cells does so and keeps off the walls: these are then a closed set. It is not attained where from every motion of
/// the cells that does so there is a way to a better one: then the best ones do not.
pub fn is_attained<'a>(
    choice: &Choice,
    formulas: &[Formulas<'a>],
    cells: impl Iterator<Item = (Cell, u32)> + Clone,
) -> Option<bool> {
    let of = |periods: u32| &formulas[periods as usize - 1];
    if cells
        .clone()
        .all(|(cell, periods)| of(periods).is_inside(choice, &cell))
    {
        return Some(true);
    }
    if choice.clearance.high() > 0.0 {
        // a turning point may come to be nearer to a wall than that: the motions as asked are no closed set
        return None;
    }
    let mut cells = cells;
    cells
        .all(|(cell, periods)| of(periods).is_improvable(choice, &cell))
        .then_some(false)
}

impl Formulas<'_> {
    /// Whether every motion of a cell that is in the ranges attracts and keeps off the walls as asked.
    fn is_inside(&self, choice: &Choice, cell: &Cell) -> bool {
        let Some(examined) = self.evaluated(cell) else {
            return false;
        };
        let has_margin = choice.margin.low() > 0.0;
        let is_stable = |bounds: [Constraint; 2]| {
            let of = |(what, _): &&(Constraint, Form)| bounds.contains(what);
            has_margin
                || examined
                    .constraints
                    .iter()
                    .filter(of)
                    .any(|(_, form)| form.values.is_positive())
        };
        let Some([_, _, r_b, r_t]) = self.device(cell) else {
            return true;
        };
        let loses = (r_b * r_t).high() < 1.0;
        let is_stable = is_stable([Constraint::Fold, Constraint::FoldOfKnown])
            && is_stable([Constraint::PeriodDoubling, Constraint::PeriodDoublingOfKnown]);
        loses && is_stable && self.keeps_off(choice, cell)
    }

    /// Whether every motion of a cell keeps off the walls as asked.
    fn keeps_off(&self, choice: &Choice, cell: &Cell) -> bool {
        let explicit = self.explicit(cell);
        let [d, g] = self.capsule(cell);
        (0..2).all(|index| {
            let flight = flight(&explicit, index, d, g);
            let time = explicit.times[index];
            let turns = OrbitFlight { flight, time }.clearance();
            turns.is_ok_and(|least| {
                least.is_none_or(|least| least.is_positive() && (least - choice.clearance).low() >= 0.0)
            })
        })
    }

    /// Whether from every motion of a cell that attracts and keeps off the walls a way leads on to a better one in the
    /// ranges: a direction in which the voltage grows and no restitution that may be at an end of its range leaves it.
    /// A restitution that is held is so along a curve, whose direction follows from the others.
    fn is_improvable(&self, choice: &Choice, cell: &Cell) -> bool {
        let Some(examined) = self.evaluated(cell) else {
            return false;
        };
        let Some(voltages) = examined.voltages else {
            return false;
        };
        let [first, second, r_b, r_t] = &choice.ranges;
        let is_free = |i: usize| {
            let range = match i {
                0 => first,
                1 => second,
                _ => return true,
            };
            // beside its ends it may go either way
            !range.is_held() && cell[i].low() > range.low.high() && cell[i].high() < range.high.low()
        };
        let free: Vec<usize> = (0..UNKNOWNS).filter(|&i| is_free(i)).collect();
        if free.iter().any(|&i| width(&cell[i]) == 0.0) {
            return false;
        }
        let held = [r_b.is_held(), r_t.is_held()];
        let has_margin = choice.margin.low() > 0.0;
        let (mut grow, mut stay) = (vec![voltages.slopes], Vec::new());
        for (what, form) in &examined.constraints {
            let may_fail = !form.values.is_positive();
            match what {
                Constraint::Arrival(_) if may_fail => return false,
                Constraint::Least(wall) if held[*wall] => stay.push(form.slopes),
                Constraint::Largest(wall) if held[*wall] => {}
                Constraint::Least(_) | Constraint::Largest(_) if may_fail => grow.push(form.slopes),
                Constraint::Fold | Constraint::PeriodDoubling if may_fail && has_margin => grow.push(form.slopes),
                _ => {}
            }
        }
        let Some(direction) = proposed(&grow, &stay, &free).and_then(|proposed| along(&stay, &free, proposed)) else {
            return false;
        };
        grow.iter().all(|slopes| rate(slopes, &direction).is_positive())
    }
}

/// How fast a form grows in a direction.
fn rate(slopes: &Direction, direction: &Direction) -> Interval {
    let zero = Interval::point(0.0);
    slopes
        .iter()
        .zip(direction)
        .fold(zero, |sum, (slope, part)| sum + *slope * *part)
}

/// A direction in which, in f64 and at the middle, `grow` grow and `stay` do not change.
fn proposed(grow: &[Direction], stay: &[Direction], free: &[usize]) -> Option<[f64; UNKNOWNS]> {
    let rows: Vec<&Direction> = grow.iter().chain(stay).collect();
    let middle = |row: usize, column: usize| rows[row][free[column]].midpoint();
    let mut matrix = DMatrix::from_fn(rows.len(), free.len(), middle);
    for mut row in matrix.row_iter_mut() {
        let size = row.norm();
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        row /= size;
    }
    let wanted = DVector::from_fn(rows.len(), |row, _| if row < grow.len() { 1.0 } else { 0.0 });
    let solution = matrix.svd(true, true).solve(&wanted, SINGULAR).ok()?;
    let mut direction = [0.0; UNKNOWNS];
    for (column, part) in free.iter().zip(solution.iter()) {
        direction[*column] = *part;
    }
    direction.iter().all(|part| part.is_finite()).then_some(direction)
}

/// The direction near the one proposed in which `stay`, at most two, do not change at all: one of its parts for each
/// follows from the others, by Cramer's rule.
fn along(stay: &[Direction], free: &[usize], proposed: [f64; UNKNOWNS]) -> Option<Direction> {
    let mut direction = proposed.map(Interval::point);
    match stay {
        [] => {}
        [one] => {
            let size = |i: &&usize| one[**i].mignitude();
            let solved = *free.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
            direction[solved] = Interval::point(0.0);
            direction[solved] = -rate(one, &direction) / one[solved];
        }
        [one, other] => {
            let determinant = |i: usize, j: usize| one[i] * other[j] - one[j] * other[i];
            let pairs = free
                .iter()
                .flat_map(|&i| free.iter().map(move |&j| (i, j)))
                .filter(|(i, j)| i < j);
            let size = |&(i, j): &(usize, usize)| determinant(i, j).mignitude();
            let (i, j) = pairs.max_by(|a, b| size(a).total_cmp(&size(b)))?;
            (direction[i], direction[j]) = (Interval::point(0.0), Interval::point(0.0));
            let [first, second] = [one, other].map(|slopes| -rate(slopes, &direction));
            direction[i] = (first * other[j] - one[j] * second) / determinant(i, j);
            direction[j] = (one[i] * second - first * other[i]) / determinant(i, j);
        }
        _ => return None,
    }
    direction.iter().all(Interval::is_finite).then_some(direction)
}

/// A constraint that holds with next to nothing to spare at a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Active {
    /// A parameter, of those of the capsule, r_B, r_T, is at the lower end of its range.
    Low(usize),
    /// It is at the upper end.
    High(usize),
    /// Tr = 1 + Det - margin.
    Fold,
    /// -Tr = 1 + Det - margin.
    PeriodDoubling,
    /// The least distance from a wall where the ball turns.
    Grazing,
}

/// Slacks are next to nothing below this: of a parameter, as a part of its range.
const SPARE: f64 = 1e-5;

/// The constraints that are active at a proved device, to rounding and to what a local search leaves.
pub fn active(choice: &Choice, device: &crate::orbit::optimum::incumbent::ProvedDevice) -> Vec<Active> {
    let mut found = Vec::new();
    for (index, (range, value)) in choice.ranges.iter().zip(&device.parameters).enumerate() {
        let value = value.midpoint();
        if range.is_held() {
            continue;
        }
        if value - range.low.midpoint() <= SPARE * range.span() {
            found.push(Active::Low(index));
        }
        if range.high.midpoint() - value <= SPARE * range.span() {
            found.push(Active::High(index));
        }
    }
    let orbit = &device.orbit;
    let (trace, most) = (
        orbit.trace.midpoint(),
        1.0 + orbit.determinant.midpoint() - choice.margin.midpoint(),
    );
    if most - trace <= SPARE {
        found.push(Active::Fold);
    }
    if most + trace <= SPARE {
        found.push(Active::PeriodDoubling);
    }
    let spare = |clearance: &Interval| clearance.midpoint() - choice.clearance.midpoint();
    if orbit
        .clearance
        .as_ref()
        .is_some_and(|clearance| spare(clearance) <= SPARE)
    {
        found.push(Active::Grazing);
    }
    found
}
