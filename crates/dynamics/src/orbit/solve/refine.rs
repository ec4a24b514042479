//! A 1-1 motion known to f64, to some fifty digits by one evaluation of its equations in many digits.
//!
//! Krawczyk's identity, for x* in a box B around x_1 that double-double proved, and any matrix Y:
//! x* is in x_1 - Y F(x_1) + (I - Y J(B)) (B - x_1). With B of radius 1e-27 and Y, J(B) in double-double the last term
//! is below 1e-52, so that F(x_1), the two sines and cosines of it, is all that many digits are needed for.

use crate::model::Motion;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::solve::krawczyk::ProvedRoot;
use crate::orbit::solve::krawczyk::prove_over;
use numbers::{Analytic, DoubleDouble, Endpoint, Field, Interval};

type Line = Interval<DoubleDouble>;

/// (T_1, psi) at a proved root, to more than fifty digits, or as many as `E` has.
///
/// `None` where the root is next to another one, and double-double cannot prove it again.
pub fn refine_one_one<F: Endpoint, E: Endpoint>(
    motion: &Motion<Interval<E>>,
    periods: u32,
    root: &ProvedRoot<F, 2>,
) -> Option<IntervalBox<E, 2>> {
    let narrow = OneOneEquations::new(&motion.convert(around).ok()?, periods);
    let cell = prove_over(&narrow, root)?;
    let point = cell.each_ref().map(Interval::midpoint);
    let (_, slopes) = narrow.linearised(&cell[0], &cell[1]);
    let inverse = inverse(&slopes)?;
    let rest: [Line; 2] = std::array::from_fn(|row| {
        let terms = (0..2).map(|column| {
            let identity = Line::from_integer(i64::from(row == column));
            let product = (0..2).map(|k| Line::point(inverse[row][k]) * slopes[k][column]);
            let left = product.fold(identity, |left, term| left - term);
            left * (cell[column] - Line::point(point[column]))
        });
        terms.fold(Line::from_integer(0), |sum, term| sum + term)
    });
    let start = point.each_ref().map(lifted::<E>);
    let values = OneOneEquations::new(motion, periods).residual(&start[0], &start[1]);
    Some(std::array::from_fn(|row| {
        let [first, second] = [0, 1].map(|k| lifted::<E>(&inverse[row][k]) * values[k].clone());
        let ends = [rest[row].low(), rest[row].high()].map(|end| lifted::<E>(&end));
        start[row].clone() - first - second + ends[0].hull(&ends[1])
    }))
}

/// The inverse of the midpoints.
fn inverse([[a, b], [c, d]]: &[[Line; 2]; 2]) -> Option<[[DoubleDouble; 2]; 2]> {
    let [a, b, c, d] = [a, b, c, d].map(Interval::midpoint);
    let determinant = a * d - b * c;
    let inverse = [[d, -b], [-c, a]].map(|row| row.map(|entry| entry / determinant));
    let finite = inverse.iter().flatten().all(Endpoint::is_finite);
    finite.then_some(inverse)
}

/// Double-double numbers around an interval of more digits.
fn around<E: Endpoint>(interval: &Interval<E>) -> Line {
    let nearest = |end: E| {
        let high = end.to_f64();
        let low = (end - E::from_f64(high)).to_f64();
        DoubleDouble::from_f64(high) + DoubleDouble::from_f64(low)
    };
    Interval::new(nearest(interval.low()).below(), nearest(interval.high()).above())
}

/// A double-double number over another type.
fn lifted<E: Endpoint>(number: &DoubleDouble) -> Interval<E> {
    let high = number.to_f64();
    let low = (*number - DoubleDouble::from_f64(high)).to_f64();
    Interval::from_f64(high) + Interval::from_f64(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::krawczyk::sharpen;
    use crate::orbit::solve::one_one::isolate_one_one;
    use numbers::Wide;

    #[test]
    fn fifty_digits_by_one_evaluation_are_those_of_newtons_method_in_a_hundred() {
        let motion = |hundredths: [i64; 3]| -> Motion<Interval<Wide<100>>> {
            let [d, r_b, r_t] = hundredths.map(|part| Interval::from_ratio(part, 100));
            Motion::new(Interval::from_ratio(12_201, 100_000), d, r_b, r_t).expect("a motion")
        };
        for parameters in [[40, 50, 50], [26, 50, 50], [33, 60, 30], [50, 60, 30]] {
            let wide = motion(parameters);
            let less = |side: &Interval<Wide<100>>| Interval::new(side.low().convert(), side.high().convert());
            let fifty: Motion<Interval<Wide<50>>> = wide
                .convert(|side| {
                    less(side) * Interval::new(Wide::from_ratio(1, 1).below(), Wide::from_ratio(1, 1).above())
                })
                .expect("a motion");
            let coarse = wide.convert(|side| {
                let end = side.to_f64();
                Interval::new(end.next_down(), end.next_up())
            });
            let search = isolate_one_one(&coarse.expect("a motion"), 1, &OrbitOptions::DEFAULT);
            assert!(!search.motions.is_empty());
            for root in &search.motions {
                let found = refine_one_one(&fifty, 1, root).expect("a motion");
                let balance = OneOneEquations::new(&wide, 1);
                let near = found.each_ref().map(|side| side.midpoint().convert::<100>());
                let exact = sharpen(&balance, near).expect("a motion");
                for (side, exact) in found.iter().zip(&exact.enclosure) {
                    let [low, high] = [side.low(), side.high()].map(|end| end.convert::<100>());
                    assert!(low <= exact.low() && exact.high() <= high);
                    // fifty digits of a number of size 1, and one to spare
                    assert!(side.radius().to_f64() < 1e-51, "{}", side.radius());
                }
            }
        }
    }
}
