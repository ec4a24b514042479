//! The angle of a point in many digits, from the one in f64 by one pair of sine and cosine.

use super::Big;
use super::sincos::sincos;

/// Bits beyond those of the result: the point is turned by an angle of 50 bits, after which its height has lost as many
/// as the angle is smaller than 1.
const GUARD: usize = 40;

/// Sides farther apart than this leave an angle that is too close to an axis to be found so.
const SLENDER: f64 = 1e-6;

/// The angle of the point (`x`, `y`), where f64 knows it well: with a the angle in f64, the point turned back by a is at
/// the angle b, tan b = (y cos a - x sin a) / (x cos a + y sin a), some 1e-16, whose series ends after a few terms.
///
/// `None` where the point is close to an axis or beyond the range of f64.
pub(super) fn atan2(y: &Big, x: &Big, precision: usize) -> Option<Big> {
    let [high, wide] = [y, x].map(|side| side.to_f64().value());
    let slender = high.abs().min(wide.abs()) < SLENDER * high.abs().max(wide.abs());
    let angle = high.atan2(wide);
    if slender || !(high * high + wide * wide).is_normal() {
        return None;
    }
    let working = precision + GUARD;
    let widened = |value: &Big| value.clone().with_precision(working).value();
    let (y, x) = (widened(y), widened(x));
    let angle = widened(&Big::try_from(angle).ok()?);
    let (sin, cos) = sincos(&angle, working);
    let tan = (&y * &cos - &x * &sin) / (x * cos + y * sin);
    let square = &tan * &tan;
    let (mut power, mut sum, mut n) = (tan.clone(), tan, 1_u32);
    // what is left is below the first term left out
    let least = -(working as isize) - 8;
    while power.repr().exponent() + power.digits() as isize > least {
        power = -(power * &square);
        n += 2;
        sum += &power / Big::from(n).with_precision(working).value();
        if power == Big::ZERO {
            break;
        }
    }
    Some((angle + sum).with_precision(precision).value())
}

/// The angle in [0, pi] of which `x` is the cosine, with the sine as sqrt((1 - x)(1 + x)).
///
/// `None` where `x` is not within (-1, 1), or [`atan2`] has none.
pub(super) fn acos(x: &Big, precision: usize) -> Option<Big> {
    let one = Big::ONE.with_precision(precision + GUARD).value();
    let wide = x.clone().with_precision(precision + GUARD).value();
    let square = (&one - &wide) * (&one + &wide);
    if square <= Big::ZERO {
        return None;
    }
    let context = dashu_float::Context::<dashu_float::round::mode::HalfEven>::new(precision + GUARD);
    let sine = context.sqrt::<2>(square.repr()).ok()?.value();
    atan2(&sine, x, precision)
}

#[cfg(test)]
mod tests {
    use super::super::Wide;
    use crate::{Analytic, Field, Sequence};

    #[test]
    fn an_angle_is_that_of_the_general_means() {
        fn check<const DIGITS: usize>(sequence: &mut Sequence) {
            let mut side = || {
                let size = 10_f64.powf(sequence.between(-3.0, 3.0));
                Wide::<DIGITS>::from_f64(sequence.between(-1.0, 1.0) * size) / Wide::from_f64(7.0)
            };
            let (y, x) = (side(), side());
            let found = Analytic::atan2(&y, &x);
            let exact = y.binary(&x, |context, y, x| {
                super::super::CONSTANTS.with_borrow_mut(|cache| context.atan2(y, x, Some(cache)))
            });
            assert_eq!(found, exact, "{y} {x}");
            let cosine = x.clone() / Analytic::sqrt(&(x.clone() * x.clone() + y.clone() * y));
            let found = Analytic::acos(&cosine);
            let exact = cosine.unary(|context, x, cache| context.acos(x, Some(cache)));
            let apart = ((found - exact.clone()) / exact).to_f64().abs();
            assert!(
                apart <= <Wide<DIGITS> as Analytic>::epsilon().to_f64(),
                "{cosine}: {apart}"
            );
        }
        let mut sequence = Sequence::new(3);
        for _ in 0..200 {
            check::<50>(&mut sequence);
            check::<100>(&mut sequence);
        }
        check::<200>(&mut sequence);
    }

    #[test]
    fn close_to_an_axis_and_beyond_the_range_of_f64_there_is_an_angle_too() {
        let number = Wide::<50>::from_f64;
        for (y, x) in [
            (1.0, 0.0),
            (0.0, -1.0),
            (1e-30, 1.0),
            (-1e-200, -1.0),
            (1e-250, 1e-250),
            (1e300, 1e300),
        ] {
            let angle = Analytic::atan2(&number(y), &number(x)).to_f64();
            assert!((angle - y.atan2(x)).abs() <= 1e-15 * angle.abs(), "{y} {x}: {angle}");
        }
        let huge = Field::to_power(&number(f64::MAX), 3);
        assert!((Analytic::atan2(&huge, &huge).to_f64() - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
        for cosine in [1.0, -1.0, 1.0 - 1e-16, 0.0] {
            assert!((Analytic::acos(&number(cosine)).to_f64() - cosine.acos()).abs() < 1e-15);
        }
    }
}
