//! A cover of the curve of 1-1 motions over a range of a parameter.
//!
//! In (T_1, psi, parameter) the motions with v > 0 > w are a curve. It is covered once by small cells; the motions at
//! one value, and the events along the range, are then looked for in these cells alone.

use crate::model::MotionError;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::family::Family;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::options::OrbitOptions;
use crate::orbit::solve::krawczyk::image;
use numbers::{Dual, Interval, seeded};
use stop;

/// Cells of a cover are at most this part of the range of each unknown, for one period of the forcing.
const PARTS: f64 = 32.0;

/// The same of a box that is covered again.
const PARTS_OF_A_BOX: f64 = 8.0;

/// Nor are they made narrower, in the parameter, than this part of its size: a narrow range needs no parts.
const NARROW: f64 = 0.01;

/// Cells are made larger by this part of the widest there are.
const MARGIN: f64 = 0.02;

/// A cell that shrinks to this part of one of its widths is narrowed again.
const WORTHWHILE: f64 = 0.7;

/// Why a curve cannot be covered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CoverError {
    /// A parameter leaves its range within the sweep.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The motions have another forcing than cos(pi t), or one wall.
    #[error("only motions between two walls under the forcing cos(pi t) are covered; follow the word BT instead")]
    Uncovered,
}

/// Cells that hold every 1-1 motion with v > 0 > w over a range of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Cover {
    /// The number of forcing periods of the motions.
    pub periods: u32,
    /// The values of the parameter that are covered.
    pub range: Interval<f64>,
    /// (T_1, psi, parameter).
    pub cells: Vec<IntervalBox<f64, 3>>,
}

impl Cover {
    /// Covers the motions of `periods` periods for parameters in `range`.
    ///
    /// # Errors
    /// A range in which a parameter of the motion cannot be; `Uncovered`.
    pub fn new(
        family: &impl Family,
        periods: u32,
        range: Interval<f64>,
        options: &OrbitOptions,
    ) -> Result<Self, CoverError> {
        if !OneOneEquations::describes(&family.motion_at(&range)?) {
            return Err(CoverError::Uncovered);
        }
        let turn = 2.0 * std::f64::consts::PI;
        let total = 2.0 * f64::from(periods);
        let share = (4.0 * width(range) / PARTS).max(NARROW * range.magnitude());
        let start = [
            Interval::new(0.0, total),
            Interval::new(-0.5 * turn, 0.5 * turn.next_up()),
            range,
        ];
        let mut cells = Vec::new();
        divide(
            family,
            periods,
            start,
            [2.0 / PARTS, turn / PARTS, share],
            options,
            &mut cells,
        )?;
        Ok(Self { periods, range, cells })
    }

    /// The part of a cover that lies in these boxes, with cells that are small beside them.
    ///
    /// # Errors
    /// As [`Cover::new`].
    pub fn within(
        &self,
        family: &impl Family,
        boxes: &[IntervalBox<f64, 3>],
        options: &OrbitOptions,
    ) -> Result<Self, CoverError> {
        let mut cells = Vec::new();
        for around in boxes {
            let widest = around.map(|side| width(side) / PARTS_OF_A_BOX);
            divide(family, self.periods, *around, widest, options, &mut cells)?;
        }
        Ok(Self { cells, ..*self })
    }

    /// The cells that reach a value of the parameter, without the parameter.
    pub fn at(&self, parameter: Interval<f64>) -> Vec<IntervalBox<f64, 2>> {
        let reached = |cell: &&IntervalBox<f64, 3>| cell[2].intersection(&parameter).is_some();
        let cells = self.cells.iter().filter(reached);
        cells.map(|[t_1, middle, _]| [*t_1, *middle]).collect()
    }
}

/// Adds the cells of the curve in a box, none of them wider than `widest`.
fn divide(
    family: &impl Family,
    periods: u32,
    start: IntervalBox<f64, 3>,
    widest: [f64; 3],
    options: &OrbitOptions,
    cells: &mut Vec<IntervalBox<f64, 3>>,
) -> Result<(), CoverError> {
    let mut left = vec![start];
    while let Some(cell) = left.pop() {
        let Some(cell) = settled(family, periods, cell)? else {
            continue;
        };
        // between neighbouring numbers there is nothing to halve
        let has_halves = |side: Interval<f64>| side.low() < side.midpoint() && side.midpoint() < side.high();
        let excess = |i: usize| {
            if has_halves(cell[i]) {
                width(cell[i]) / widest[i]
            } else {
                0.0
            }
        };
        let direction = (0..3).max_by(|&i, &j| excess(i).total_cmp(&excess(j))).unwrap_or(0);
        if excess(direction) <= 1.0 || cells.len() + left.len() > options.most_cover_cells as usize || !stop::goes_on()
        {
            cells.push(grown(family, cell, widest));
            continue;
        }
        let (low, high) = cell[direction].halves();
        for half in [low, high] {
            let mut cell = cell;
            cell[direction] = half;
            left.push(cell);
        }
    }
    Ok(())
}

/// The cell with a margin: no motion is to lie on the edge of its cell, where it would be proved with more trouble. There
/// is none where the parameter would leave its range.
fn grown(family: &impl Family, cell: IntervalBox<f64, 3>, widest: [f64; 3]) -> IntervalBox<f64, 3> {
    let mut grown = std::array::from_fn(|i| {
        let margin = MARGIN * widest[i];
        cell[i] + Interval::new(-margin, margin)
    });
    let leaves = |end: f64| family.motion_at(&Interval::point(end)).is_err();
    if leaves(grown[2].low()) || leaves(grown[2].high()) {
        grown[2] = cell[2];
    }
    grown
}

/// The cell narrowed for as long as that makes it much smaller; `None` where nothing is left.
fn settled(
    family: &impl Family,
    periods: u32,
    mut cell: IntervalBox<f64, 3>,
) -> Result<Option<IntervalBox<f64, 3>>, MotionError> {
    loop {
        let Some(smaller) = contracted(family, periods, &cell)? else {
            return Ok(None);
        };
        let shrinks = (0..3).any(|i| width(smaller[i]) < WORTHWHILE * width(cell[i]));
        cell = smaller;
        if !shrinks {
            return Ok(Some(cell));
        }
    }
}

/// The cell narrowed to where both equations can hold; `None` where nothing is left.
///
/// First the parameter alone, from each equation h: h(t, psi, q) = h(t, psi, m) + h_q (q - m), m the middle of its
/// range. Then, with T_1 anywhere in its range, psi and the parameter by Krawczyk's operator, and so with psi: that
/// draws the cell close to the curve, whichever way it runs.
fn contracted(
    family: &impl Family,
    periods: u32,
    cell: &IntervalBox<f64, 3>,
) -> Result<Option<IntervalBox<f64, 3>>, MotionError> {
    let [t_1, middle, parameter] = *cell;
    let whole = OneOneEquations::new(&family.motion_at(&parameter)?, periods);
    let [v, w] = whole.scaled_velocities(&t_1, &middle);
    if v.is_negative() || w.is_positive() {
        return Ok(None);
    }
    let (values, slopes) = whole.linearised(&t_1, &middle);
    if values.iter().any(|h| !h.contains_zero()) {
        return Ok(None);
    }
    let lifted = OneOneEquations::new(&family.motion_at(&seeded(parameter))?, periods);
    let by_parameter = lifted
        .residual(&Dual::from_re(t_1), &Dual::from_re(middle))
        .map(|h| h.eps);
    let at = Interval::point(parameter.midpoint());
    let values = OneOneEquations::new(&family.motion_at(&at)?, periods).residual(&t_1, &middle);
    let mut narrowed = parameter;
    for (value, slope) in values.into_iter().zip(by_parameter) {
        let Some(both) = narrowed.intersection(&(at - value / slope)) else {
            return Ok(None);
        };
        narrowed = both;
    }
    let mut cell = [t_1, middle, narrowed];
    for free in [1, 0] {
        let jacobian = [0, 1].map(|row| [slopes[row][free], by_parameter[row]]);
        let residual = |at: &IntervalBox<f64, 2>| {
            let mut point = cell;
            [point[free], point[2]] = *at;
            let motion = family.motion_at(&point[2]).ok()?;
            Some(OneOneEquations::new(&motion, periods).residual(&point[0], &point[1]))
        };
        let Some(image) = image(&[cell[free], cell[2]], &jacobian, residual) else {
            continue;
        };
        let (Some(side), Some(range)) = (cell[free].intersection(&image[0]), cell[2].intersection(&image[1])) else {
            return Ok(None);
        };
        [cell[free], cell[2]] = [side, range];
    }
    Ok(Some(cell))
}

fn width(side: Interval<f64>) -> f64 {
    side.high() - side.low()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::solve::one_one::isolate_one_one;
    use numbers::Analytic;

    #[test]
    fn every_orbit_at_every_value_lies_in_the_cover() {
        let mut orbits = 0;
        for (g, r_b, r_t, periods) in [(0.12201, 0.5, 0.5, 1), (0.0, 0.6, 0.6, 1), (0.12201, 0.6, 0.3, 2)] {
            let family = Motion::new(g, 0.5, r_b, r_t).expect("a motion");
            let cover = Cover::new(&family, periods, Interval::new(0.2, 0.7), &OrbitOptions::DEFAULT).expect("a cover");
            for step in 0..=10 {
                let d = Interval::point(0.2 + 0.05 * f64::from(step))
                    .intersection(&cover.range)
                    .expect("a value");
                let cells = cover.at(d);
                for root in isolate_one_one(
                    &family.motion_at(&d).expect("a motion"),
                    periods,
                    &OrbitOptions::DEFAULT,
                )
                .motions
                {
                    let [t_1, middle] = root.enclosure;
                    let inside = |[time, phase]: &[Interval<f64>; 2]| {
                        let turn = Interval::pi() + Interval::pi();
                        let shifted = [middle, middle + turn, middle - turn];
                        t_1.intersection(time).is_some()
                            && shifted.iter().any(|middle| middle.intersection(phase).is_some())
                    };
                    assert!(cells.iter().any(inside), "{g} {d} {t_1} {middle}");
                    orbits += 1;
                }
            }
        }
        assert!(orbits > 30, "{orbits}");
    }

    #[test]
    fn a_box_of_neighbouring_numbers_is_covered_by_few_cells() {
        let family = Motion::new(1.055e-10, 0.5, 0.084_455_544_531_243_32, 0.084_455_544_531_243_32).expect("a motion");
        let whole = Cover::new(&family, 1, Interval::new(0.3530, 0.3531), &OrbitOptions::DEFAULT).expect("a cover");
        let tight = [
            Interval::new(1.000_000_000_138_732_4, 1.000_000_000_138_733_7),
            Interval::new(3.033_708_538_134_507, 3.033_708_545_391_402),
            Interval::new(0.353_024_136_797_091_2, 0.353_024_138_553_708_5),
        ];
        let mut point = tight;
        point[0] = Interval::point(1.000_000_000_138_733);
        let cover = whole
            .within(&family, &[tight, point], &OrbitOptions::DEFAULT)
            .expect("a cover");
        assert!(cover.cells.len() < 1000, "{}", cover.cells.len());
    }

    #[test]
    fn a_range_in_which_there_is_no_motion_is_refused() {
        let family = Motion::new(0.1, 0.5, 0.5, 0.5).expect("a motion");
        let refused = Cover::new(&family, 1, Interval::new(-0.1, 0.2), &OrbitOptions::DEFAULT);
        assert!(
            matches!(refused, Err(CoverError::Motion(MotionError::Gap { .. }))),
            "{refused:?}"
        );
    }

    #[test]
    fn only_cells_that_reach_a_value_are_given_for_it() {
        let family = Motion::new(0.12201, 0.5, 0.5, 0.5).expect("a motion");
        let cover = Cover::new(&family, 1, Interval::new(0.2, 0.7), &OrbitOptions::DEFAULT).expect("a cover");
        let here = cover.at(Interval::point(0.3)).len();
        assert!(
            0 < here && here < cover.cells.len() / 4,
            "{here} of {}",
            cover.cells.len()
        );
        assert!(cover.at(Interval::point(0.8)).is_empty());
    }
}
