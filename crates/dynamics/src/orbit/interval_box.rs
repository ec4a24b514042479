//! Boxes: what is examined, and in which a solution is proved.

use numbers::{Endpoint, Interval};

/// A box: an interval for each unknown.
pub type IntervalBox<E, const D: usize> = [Interval<E>; D];

pub(crate) fn around<E: Endpoint>(point: &E, half_width: f64) -> Interval<E> {
    let reach = Interval::new(E::from_f64(-half_width), E::from_f64(half_width));
    Interval::point(point.clone()) + reach
}

pub(crate) fn width<E: Endpoint>(side: &Interval<E>) -> f64 {
    (side.high() - side.low()).to_f64()
}

pub(crate) fn is_inside<E: Endpoint, const D: usize>(cell: &IntervalBox<E, D>, other: &IntervalBox<E, D>) -> bool {
    cell.iter().zip(other).all(|(side, around)| side.is_inside(around))
}

pub(crate) fn is_subset<E: Endpoint, const D: usize>(cell: &IntervalBox<E, D>, other: &IntervalBox<E, D>) -> bool {
    cell.iter().zip(other).all(|(side, around)| side.is_subset(around))
}

pub(crate) fn holds<E: Endpoint, const D: usize>(cell: &IntervalBox<E, D>, point: &[E; D]) -> bool {
    cell.iter().zip(point).all(|(side, x)| side.contains(x))
}

pub(crate) fn intersection<E: Endpoint, const D: usize>(
    cell: &IntervalBox<E, D>,
    other: &IntervalBox<E, D>,
) -> Option<IntervalBox<E, D>> {
    let mut both = cell.clone();
    for (side, with) in both.iter_mut().zip(other) {
        *side = side.intersection(with)?;
    }
    Some(both)
}

/// The distance of two points in the maximum norm.
pub(crate) fn apart(one: &[f64], other: &[f64]) -> f64 {
    let parts = one.iter().zip(other).map(|(one, other)| (one - other).abs());
    parts.fold(0.0, f64::max)
}

/// The maximum; neither NaN nor an infinite one gets lost.
pub(crate) fn larger<E: Endpoint>(one: E, other: E) -> E {
    if other <= one || !one.is_finite() { one } else { other }
}

/// The halves in the widest of the directions in which the equations vary at least half as much as in any.
pub(crate) fn halves<E: Endpoint, const D: usize>(
    cell: &IntervalBox<E, D>,
    slopes: &[IntervalBox<E, D>; D],
) -> (IntervalBox<E, D>, IntervalBox<E, D>) {
    let widths: [f64; D] = std::array::from_fn(|i| width(&cell[i]));
    let mut variation = [0.0_f64; D];
    for row in slopes {
        let smear: [f64; D] = std::array::from_fn(|i| row[i].magnitude().to_f64() * widths[i]);
        let most = smear.iter().copied().fold(0.0, f64::max);
        for (total, part) in variation.iter_mut().zip(smear) {
            // an equation's own scale has no say in how much it counts
            *total += part / most;
        }
    }
    let most = variation.iter().copied().fold(0.0, f64::max);
    // Nothing is left out where a slope is unknown.
    let counts = |i: &usize| variation[*i].is_nan() || variation[*i] >= 0.5 * most;
    let widest = (0..D).filter(counts).max_by(|&i, &j| widths[i].total_cmp(&widths[j]));
    let direction = widest.unwrap_or(0);
    let (low, high) = cell[direction].halves();
    let (mut one, mut other) = (cell.clone(), cell.clone());
    one[direction] = low;
    other[direction] = high;
    (one, other)
}

/// Boxes that touch, each grown by `margin`, joined in one around them: what a search left undecided, told once.
pub(crate) fn joined<const D: usize>(cells: &[IntervalBox<f64, D>], margin: f64) -> Vec<IntervalBox<f64, D>> {
    let mut joined: Vec<IntervalBox<f64, D>> = Vec::new();
    for cell in cells {
        let mut grown = cell.map(|side| side + Interval::new(-margin, margin));
        let touches = |other: &IntervalBox<f64, D>, grown: &IntervalBox<f64, D>| intersection(other, grown).is_some();
        while let Some(index) = joined.iter().position(|other| touches(other, &grown)) {
            let other = joined.swap_remove(index);
            grown = std::array::from_fn(|i| grown[i].hull(&other[i]));
        }
        joined.push(grown);
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_touch_are_told_as_one_and_others_apart() {
        let at = |low: f64, high: f64| [Interval::new(low, high), Interval::new(0.0, 1.0)];
        let cells = [at(0.0, 1.0), at(5.0, 6.0), at(2.0, 3.0), at(1.0, 2.0)];
        let mut joined = joined(&cells, 0.01);
        joined.sort_by(|one, other| one[0].low().total_cmp(&other[0].low()));
        assert_eq!(joined.len(), 2);
        assert!(joined[0][0].low() <= 0.0 && joined[0][0].high() >= 3.0 && joined[0][0].high() < 3.1);
        assert!(joined[1][0].contains(&5.5));
    }

    #[test]
    fn what_is_no_number_is_the_largest_wherever_it_stands() {
        for sizes in [
            [f64::NAN, 1.0],
            [1.0, f64::NAN],
            [f64::INFINITY, 1.0],
            [1.0, f64::INFINITY],
        ] {
            assert!(!sizes.into_iter().fold(0.0, larger).is_finite(), "{sizes:?}");
        }
        assert_eq!([0.5, 2.0, 1.0].into_iter().fold(0.0, larger), 2.0);
    }
}
