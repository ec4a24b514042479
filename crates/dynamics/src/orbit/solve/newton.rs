//! Newton's method, for any number of equations over any number type. It proposes: nothing is proved here.

use crate::orbit::equations::duals::{LANES, by_duals};
use crate::orbit::interval_box::larger;
use nalgebra::{SMatrix, SVector};
use numbers::{Analytic, Gradient};

/// When Newton's method stops. The size of a step is that of its largest component, if not said otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ending {
    /// After so many steps there is no answer.
    pub most_steps: usize,
    /// A step of at most this size is the last one: the next would be below rounding.
    pub last_step: f64,
    /// A step that is not below this times the one before leads nowhere, and there is no answer;
    pub growth: f64,
    /// but one below this size that is not half the one before is rounding, and the last one.
    pub rounding: f64,
}

/// The point that Newton's method settles at; `step` gives what is taken off a point.
pub(crate) fn newton<T: Analytic, P: AsMut<[T]> + AsRef<[T]>>(
    start: P,
    ending: &Ending,
    mut step: impl FnMut(&P) -> Option<P>,
) -> Option<P> {
    newton_sized(start, ending, |point| {
        let step = step(point)?;
        let sizes = step.as_ref().iter().map(|part| part.to_f64().abs());
        let size = sizes.fold(0.0, larger);
        Some((step, size))
    })
}

/// The same where `step` says itself what size its steps count as.
pub(crate) fn newton_sized<T: Analytic, P: AsMut<[T]>>(
    start: P,
    ending: &Ending,
    mut step: impl FnMut(&P) -> Option<(P, f64)>,
) -> Option<P> {
    let mut point = start;
    let mut last = f64::INFINITY;
    for _ in 0..ending.most_steps {
        let (mut step, size) = step(&point)?;
        let is_last = size <= ending.last_step || (size < ending.rounding && size >= 0.5 * last);
        let shrinks = size < ending.growth * last && size.is_finite();
        if !(is_last || shrinks) {
            return None;
        }
        for (unknown, part) in point.as_mut().iter_mut().zip(step.as_mut()) {
            *unknown -= part.clone();
        }
        if is_last {
            return Some(point);
        }
        last = size;
    }
    None
}

/// Newton's method in f64 with derivatives by dual numbers; `None` too where the equations have no value.
pub(crate) fn newton_by_duals<const D: usize>(
    start: [f64; D],
    ending: &Ending,
    equations: impl Fn(&[Gradient<f64, LANES>; D]) -> Option<[Gradient<f64, LANES>; D]>,
) -> Option<[f64; D]> {
    newton(start, ending, |point| {
        let (values, slopes) = by_duals(&equations, point)?;
        let matrix = SMatrix::<f64, D, D>::from_fn(|row, column| slopes[row][column]);
        let step = matrix.try_inverse()? * SVector::from(values);
        Some(step.into())
    })
}

/// Each step of a fixed derivative gains as many digits as f64 has, less the condition of the equations.
const CHORDS: Ending = Ending {
    most_steps: 200,
    last_step: 0.0,
    growth: 0.5,
    rounding: 0.0,
};

/// Newton's method in many digits for equations that come without derivatives: differences in many digits give these once,
/// to f64, and serve every step. Exact to a few roundings of `T` times the condition of the equations; `None` where the
/// steps do not shrink down to rounding.
///
/// # Errors
/// Those of the equations.
pub(crate) fn newton_by_chords<T: Analytic, F, const D: usize>(
    start: [f64; D],
    equations: impl Fn(&[T; D]) -> Result<[T; D], F>,
) -> Result<Option<[T; D]>, F> {
    let start = start.map(T::from_f64);
    let values = equations(&start)?;
    // half of the digits: the quotient has the other half
    let shift = T::epsilon().sqrt();
    let mut slopes = SMatrix::<f64, D, D>::zeros();
    for column in 0..D {
        let mut moved = start.clone();
        moved[column] += shift.clone();
        let there = equations(&moved)?;
        for row in 0..D {
            slopes[(row, column)] = ((there[row].clone() - values[row].clone()) / shift.clone()).to_f64();
        }
    }
    let Some(inverse) = slopes.try_inverse() else {
        return Ok(None);
    };
    let ending = Ending {
        rounding: shift.to_f64(),
        ..CHORDS
    };
    let mut failure = None;
    let found = newton(start, &ending, |point| {
        let values = equations(point).map_err(|why| failure = Some(why)).ok()?;
        Some(std::array::from_fn(|row| {
            let terms = (0..D).map(|k| T::from_f64(inverse[(row, k)]) * values[k].clone());
            terms.fold(T::zero(), |sum, term| sum + term)
        }))
    });
    failure.map_or(Ok(found), Err)
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::{Field, Wide};

    #[test]
    fn a_root_is_found_to_the_last_digits() {
        let found = newton_by_chords([1.4], |[x]: &[Wide<60>; 1]| {
            Ok::<_, ()>([x.clone() * x.clone() - Wide::from_integer(2)])
        });
        let root = Analytic::sqrt(&Wide::<60>::from_integer(2));
        assert!(found.is_ok_and(|found| found.is_some_and(|[x]| (x - root).to_f64().abs() < 1e-60)));
    }

    #[test]
    fn where_there_is_no_root_none_is_found() {
        let found = newton_by_chords([0.5], |[x]: &[Wide<60>; 1]| {
            Ok::<_, ()>([x.clone() * x.clone() + Wide::from_integer(1)])
        });
        assert_eq!(found, Ok(None));
    }
}
