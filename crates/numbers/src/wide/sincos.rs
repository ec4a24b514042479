//! Sine and cosine in many digits, by integers: some twenty times as fast as the general means.
//!
//! The angle is brought to r = x - k pi/2 with |r| <= pi/4, halved until it is below 2^-`HALVINGS`, put into the series
//! of sin and of 1 - cos, and doubled again by sin 2a = 2 sin a cos a, 1 - cos 2a = 2 sin² a, which do not cancel.
//! Everything is an integer over 2^fraction, with as many guard bits as all roundings together may spoil.

use super::{Big, CONSTANTS};
use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig, Repr};
use dashu_int::IBig;
use dashu_int::ops::{BitTest, DivEuclid, RemEuclid};
use std::cell::RefCell;
use std::collections::HashMap;

/// Times that the angle is halved: more shorten the series, and cost two products each.
const HALVINGS: usize = 8;

/// Bits beyond those of the result: each of some sixty roundings spoils one unit of the last bit, which the doublings
/// multiply by 2^[`HALVINGS`]; what is left makes the result right to a millionth of its last bit.
const GUARD: usize = 20 + 8 + HALVINGS;

/// An r with so many bits fewer than pi/4 is computed again with as many more.
const SHORT: usize = 4;

thread_local! {
    /// pi/2 over 2^fraction, for the fractions used so far.
    static QUARTERS: RefCell<HashMap<usize, IBig>> = RefCell::new(HashMap::new());
}

/// floor(pi/2 2^fraction).
fn quarter(fraction: usize) -> IBig {
    QUARTERS.with_borrow_mut(|quarters| {
        let compute = || {
            let context = Context::<HalfEven>::new(fraction + 16);
            let pi: Big = CONSTANTS.with_borrow_mut(|cache| context.pi::<2>(Some(cache))).value();
            scaled(&pi, fraction) >> 1
        };
        quarters.entry(fraction).or_insert_with(compute).clone()
    })
}

/// floor(x 2^fraction).
fn scaled(x: &Big, fraction: usize) -> IBig {
    let repr = x.repr();
    let shift = repr.exponent() + fraction as isize;
    let significand = repr.significand().clone();
    if shift >= 0 {
        significand << shift.unsigned_abs()
    } else {
        significand >> shift.unsigned_abs()
    }
}

/// The bits of the size of an integer.
fn bits(integer: &IBig) -> usize {
    let size = if *integer < IBig::ZERO {
        -integer
    } else {
        integer.clone()
    };
    size.bit_len()
}

/// An angle as a quarter turn, r, and the fraction of r.
struct Reduced {
    quarter: u8,
    r: IBig,
    fraction: usize,
}

/// x = k pi/2 + r; r has at least `wanted` bits, unless x is 0.
fn reduced(x: &Big, wanted: usize) -> Reduced {
    let repr = x.repr();
    // |x| < 2^size
    let size = repr.exponent() + bits(repr.significand()) as isize;
    if size < 0 {
        let fraction = wanted + size.unsigned_abs();
        let r = scaled(x, fraction);
        return Reduced {
            quarter: 0,
            r,
            fraction,
        };
    }
    // k has as many bits, by which the error of pi/2 is multiplied
    let more = size.unsigned_abs() + 8;
    let mut fraction = wanted + SHORT;
    loop {
        let fine = fraction + more;
        let (x, quarter) = (scaled(x, fine), quarter(fine));
        let k: IBig = ((&x << 1) + &quarter).div_euclid(&(&quarter << 1));
        let r: IBig = (x - &k * quarter) >> more;
        let found = bits(&r);
        if found >= wanted {
            let quarter = u8::try_from(k.rem_euclid(IBig::from(4))).unwrap_or(0);
            return Reduced { quarter, r, fraction };
        }
        fraction += wanted - found;
    }
}

/// sin and 1 - cos of a small r, by their series.
fn series(r: &IBig, fraction: usize) -> (IBig, IBig) {
    let one = IBig::from(1) << fraction;
    let square: IBig = (r * r) >> fraction;
    // the terms fall by at least the square each
    let fall = fraction - bits(&square).min(fraction - 1);
    let terms = (fraction / fall + 1) as u64;
    let (mut sine, mut versine) = (one.clone(), one.clone());
    for n in (1..=terms).rev() {
        sine = &one - ((&square * sine) >> fraction) / ((2 * n) * (2 * n + 1));
        versine = &one - ((&square * versine) >> fraction) / ((2 * n + 1) * (2 * n + 2));
    }
    ((r * sine) >> fraction, (square * versine) >> (fraction + 1))
}

/// Sine and cosine, each within half a unit and a millionth of the last of `precision` bits.
pub(super) fn sincos(x: &Big, precision: usize) -> (Big, Big) {
    if x.repr().significand() == &IBig::ZERO {
        return (Big::ZERO, Big::ONE);
    }
    let size = x
        .repr()
        .exponent()
        .saturating_add_unsigned(bits(x.repr().significand()));
    if size < -isize::try_from(precision).unwrap_or(isize::MAX) {
        // x - x^3/6 and 1 - x^2/2 round to these
        return (x.clone().with_precision(precision).value(), Big::ONE);
    }
    let Reduced { quarter, r, fraction } = reduced(x, precision + GUARD);
    let (mut sine, mut versine) = series(&(r >> HALVINGS), fraction);
    for _ in 0..HALVINGS {
        let square: IBig = (&sine * &sine) >> (fraction - 1);
        let cosine = (IBig::from(1) << fraction) - versine;
        sine = (sine * cosine) >> (fraction - 1);
        versine = square;
    }
    let cosine = (IBig::from(1) << fraction) - versine;
    let (sine, cosine) = match quarter {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    };
    let value = |integer: IBig| {
        let exact = FBig::from_repr(Repr::new(integer, -(fraction as isize)), Context::new(0));
        exact.with_precision(precision).value()
    };
    (value(sine), value(cosine))
}

#[cfg(test)]
mod tests {
    use super::super::Wide;
    use super::*;
    use crate::{Analytic, Sequence};

    /// By the general means, in more digits.
    fn general<const DIGITS: usize>(x: &Wide<DIGITS>) -> [Wide<DIGITS>; 2] {
        let x: Big = x.0.clone().expect("a number");
        let context = Context::<HalfEven>::new(2 * Wide::<DIGITS>::context().precision());
        let (sin, cos) = CONSTANTS.with_borrow_mut(|cache| context.sin_cos(x.repr(), Some(cache)));
        [sin, cos].map(|value| Wide::from_repr(value.expect("a value").value().repr().clone()))
    }

    fn check<const DIGITS: usize>(x: &Wide<DIGITS>) {
        let (sin, cos) = x.sincos();
        let [sine, cosine] = general(x);
        assert_eq!((sin, cos), (sine, cosine), "{x}");
    }

    #[test]
    fn they_are_the_nearest_numbers() {
        let mut sequence = Sequence::new(5);
        for _ in 0..400 {
            let size = 10_f64.powf(sequence.between(-12.0, 12.0));
            let x = sequence.between(-1.0, 1.0) * size;
            check(&(Wide::<50>::from_f64(x) / Wide::from_f64(3.0)));
            check(&Wide::<100>::from_f64(x));
        }
        check(&(Wide::<200>::from_f64(1.0) / Wide::from_f64(3.0)));
    }

    #[test]
    fn beside_a_zero_they_keep_their_digits() {
        for quarters in [1, 2, 3, 4, 7, 1000] {
            for away in [0.0, 1e-10, -1e-25, 1e-40] {
                let quarter = Wide::<50>::pi() * Wide::from_f64(f64::from(quarters) / 2.0);
                check(&(quarter + Wide::from_f64(away)));
            }
        }
    }

    #[test]
    fn the_slightest_and_the_largest_angles_have_values() {
        for x in [0.0, 1e-300, 5e-324, 1e300, -1e300, 1e22] {
            check(&Wide::<50>::from_f64(x));
        }
    }
}
