//! Newton's method in many digits for equations that come without derivatives.

use crate::number::Analytic;
use crate::orbit::shooting::return_map::ShootingError;
use nalgebra::SMatrix;

/// Steps tried; each gains as many digits as f64 has, less the condition.
const MOST_STEPS: usize = 200;

/// The root near `start`: differences in many digits give the derivatives once, to f64, and serve every step. Exact to a
/// few roundings of `T` times the condition of the equations.
///
/// # Errors
/// What the equations say; `Astray` where the steps do not shrink down to rounding.
pub(crate) fn solved<T: Analytic, const N: usize>(
    start: [f64; N],
    equations: impl Fn(&[T; N]) -> Result<[T; N], ShootingError>,
) -> Result<[T; N], ShootingError> {
    let mut point = start.map(T::from_f64);
    let mut values = equations(&point)?;
    // half of the digits: the quotient has the other half
    let shift = T::epsilon().sqrt();
    let mut slopes = SMatrix::<f64, N, N>::zeros();
    for column in 0..N {
        let mut moved = point.clone();
        moved[column] += shift.clone();
        let there = equations(&moved)?;
        for row in 0..N {
            slopes[(row, column)] = ((there[row].clone() - values[row].clone()) / shift.clone()).to_f64();
        }
    }
    let inverse = slopes.try_inverse().ok_or(ShootingError::Astray)?;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let mut size = 0.0_f64;
        for row in 0..N {
            let terms = (0..N).map(|k| T::from_f64(inverse[(row, k)]) * values[k].clone());
            let step = terms.fold(T::zero(), |sum, term| sum + term);
            size = size.max(step.to_f64().abs());
            point[row] -= step;
        }
        // half of the digits are there, and no more come
        if size == 0.0 || (size >= 0.5 * last && size < shift.to_f64()) {
            return Ok(point);
        }
        if !size.is_finite() || size >= 0.5 * last {
            return Err(ShootingError::Astray);
        }
        last = size;
        values = equations(&point)?;
    }
    Err(ShootingError::Astray)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Field, Wide};

    #[test]
    fn a_root_is_found_to_the_last_digits() {
        let found = solved([1.4], |[x]: &[Wide<60>; 1]| {
            Ok([x.clone() * x.clone() - Wide::from_integer(2)])
        });
        let root = Analytic::sqrt(&Wide::<60>::from_integer(2));
        assert!(found.is_ok_and(|[x]| (x - root).to_f64().abs() < 1e-60));
    }

    #[test]
    fn where_there_is_no_root_none_is_found() {
        let found = solved([0.5], |[x]: &[Wide<60>; 1]| {
            Ok([x.clone() * x.clone() + Wide::from_integer(1)])
        });
        assert_eq!(found, Err(ShootingError::Astray));
    }
}
