//! Many digits, over dashu-float: the reference that f64 is measured against.

mod angle;
mod endpoint;
mod sincos;
mod text;

use super::derivable::Elementary;
use super::{Analytic, Field};
use dashu_float::round::mode::HalfEven;
use dashu_float::{ConstCache, Context, FBig, Repr};
use dashu_int::{Sign, Word};
use std::cell::{Cell, RefCell};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

type Big = FBig<HalfEven, 2>;
type Outcome = dashu_float::FpResult<Big>;

thread_local! {
    /// pi and the logarithms, computed once for each thread and length.
    static CONSTANTS: RefCell<ConstCache> = const { RefCell::new(ConstCache::new()) };
}

thread_local! {
    /// The digits of [`Digits`] on this thread.
    static SET: Cell<usize> = const { Cell::new(50) };
}

/// A [`Wide`] of as many digits as [`at_digits`] sets: one copy of a computation serves every precision.
pub type Digits = Wide<SET_AT_RUN_TIME>;

/// The `DIGITS` that stand for those set at run time.
const SET_AT_RUN_TIME: usize = 0;

/// The computation with [`Digits`] of at least so many decimal digits, on this thread. May be nested.
///
/// Values may leave it, and keep their digits until they are computed with again.
pub fn at_digits<R>(digits: u32, computation: impl FnOnce() -> R) -> R {
    /// Puts back what was set before, after a panic as well.
    struct Before(usize);
    impl Drop for Before {
        fn drop(&mut self) {
            SET.set(self.0);
        }
    }
    let _before = Before(SET.replace(digits.max(1) as usize));
    computation()
}

/// Bits carried beyond the digits asked for, so that a formula of some thousand roundings keeps them.
const GUARD_BITS: usize = 32;

/// Above this size an angle has no phase left worth computing; its reduction would need as many digits of pi.
const LARGEST_ANGLE_BITS: isize = 4096;

/// Above this size, 2^23, an exponential leaves the range of the exponents.
const LARGEST_EXPONENT_BITS: isize = 23;

/// Beyond this power of two, or its inverse, a number is invalid: to add 1 to it may fill the memory.
const LARGEST_POWER_OF_TWO: usize = 1 << 24;

/// A binary floating-point number that keeps at least `DIGITS` decimal digits, with 32 guard bits.
///
/// Every operation is rounded to nearest, its relative error below 2^-(3.32 DIGITS + 32). There is no infinity.
/// What has no value (0/0, 1/0, the root of a negative number, the arc cosine beyond 1, a NaN or infinity read
/// from f64, the sine of an angle above 2^4096, an exponential of more than 2^23 in size, any result beyond 2^(2^24) or its inverse) is **invalid**: it
/// passes through every operation, is not equal to anything, itself included, has no order and reads as NaN in f64,
/// just as NaN does. Nothing panics.
#[derive(Clone)]
pub struct Wide<const DIGITS: usize>(Option<Big>);

impl<const DIGITS: usize> Wide<DIGITS> {
    /// The number that is none.
    pub const INVALID: Self = Self(None);

    /// Whether this is a number at all.
    pub fn is_valid(&self) -> bool {
        self.0.is_some()
    }

    /// The same value with more digits, or the nearest with fewer.
    pub fn convert<const OTHER: usize>(&self) -> Wide<OTHER> {
        match &self.0 {
            Some(big) => Wide::from_repr(big.repr().clone()),
            None => Wide::INVALID,
        }
    }

    /// The decimal digits that are kept at least.
    pub fn digits() -> usize {
        if DIGITS == SET_AT_RUN_TIME { SET.get() } else { DIGITS }
    }

    fn context() -> Context<HalfEven> {
        // 3322/1000 is just above log2(10)
        Context::new(Self::digits() * 3322 / 1000 + 1 + GUARD_BITS)
    }

    /// The value of a result of dashu, invalid where it has none or is infinite.
    fn from_outcome(outcome: Outcome) -> Self {
        let fits = |big: &Big| {
            let repr = big.repr();
            !repr.is_infinite() && repr.exponent().unsigned_abs() < LARGEST_POWER_OF_TWO
        };
        Self(outcome.ok().map(|rounded| rounded.value()).filter(fits))
    }

    fn from_repr(repr: Repr<2>) -> Self {
        let exact = Big::from_repr(repr, Context::new(0));
        let rounded = exact.with_precision(Self::context().precision()).value();
        Self(Some(rounded))
    }

    fn unary(&self, function: impl Fn(&Context<HalfEven>, &Repr<2>, &mut ConstCache) -> Outcome) -> Self {
        let Some(big) = &self.0 else {
            return Self::INVALID;
        };
        CONSTANTS.with_borrow_mut(|cache| Self::from_outcome(function(&Self::context(), big.repr(), cache)))
    }

    fn binary(&self, other: &Self, function: impl Fn(&Context<HalfEven>, &Repr<2>, &Repr<2>) -> Outcome) -> Self {
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => Self::from_outcome(function(&Self::context(), a.repr(), b.repr())),
            _ => Self::INVALID,
        }
    }

    /// Whether the size of `self` is 2^`bits` or more.
    fn is_beyond(&self, bits: isize) -> bool {
        let size = |big: &Big| big.repr().exponent().saturating_add_unsigned(big.digits());
        self.0.as_ref().is_some_and(|big| size(big) > bits)
    }

    pub(crate) fn elementary(&self, function: Elementary) -> Self {
        use Elementary::{Cosh, Exp, Exp2, ExpM1, Sinh, Tan, Tanh};
        let largest = match function {
            Tan => LARGEST_ANGLE_BITS,
            Exp | Exp2 | ExpM1 | Sinh | Cosh | Tanh => LARGEST_EXPONENT_BITS,
            _ => isize::MAX,
        };
        if self.is_beyond(largest) {
            return Self::INVALID;
        }
        let two = || <Self as Field>::from_integer(2);
        match function {
            Elementary::Cbrt => self.unary(|context, x, _| context.cbrt(x)),
            Elementary::Exp => self.unary(|context, x, cache| context.exp(x, Some(cache))),
            Elementary::Exp2 => two().powf(self),
            Elementary::ExpM1 => self.unary(|context, x, cache| context.exp_m1(x, Some(cache))),
            Elementary::Ln => self.unary(|context, x, cache| context.ln(x, Some(cache))),
            Elementary::Log2 => self.unary(|context, x, cache| context.log2(x, Some(cache))),
            Elementary::Log10 => self.unary(|context, x, cache| context.log10(x, Some(cache))),
            Elementary::Ln1p => self.unary(|context, x, cache| context.ln_1p(x, Some(cache))),
            Elementary::Tan => self.unary(|context, x, cache| context.tan(x, Some(cache))),
            Elementary::Asin => self.unary(|context, x, cache| context.asin(x, Some(cache))),
            Elementary::Atan => self.unary(|context, x, cache| context.atan(x, Some(cache))),
            Elementary::Sinh => self.unary(|context, x, cache| context.sinh(x, Some(cache))),
            Elementary::Cosh => self.unary(|context, x, cache| context.cosh(x, Some(cache))),
            Elementary::Tanh => self.unary(|context, x, cache| context.tanh(x, Some(cache))),
            Elementary::Asinh => self.unary(|context, x, cache| context.asinh(x, Some(cache))),
            Elementary::Acosh => self.unary(|context, x, cache| context.acosh(x, Some(cache))),
            Elementary::Atanh => self.unary(|context, x, cache| context.atanh(x, Some(cache))),
        }
    }
}

impl<const DIGITS: usize> fmt::Display for Wide<DIGITS> {
    /// All `DIGITS` digits in decimal; the guard bits are not shown.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(big) = &self.0 else {
            return f.write_str("NaN");
        };
        if text::needs_power_of_two(big.repr().exponent()) {
            return f.write_str(&self.to_decimal(DIGITS));
        }
        let decimal = big.clone().with_base_and_precision::<10>(Self::digits()).value();
        decimal.fmt(f)
    }
}

impl<const DIGITS: usize> fmt::Debug for Wide<DIGITS> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<const DIGITS: usize> PartialEq for Wide<DIGITS> {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl<const DIGITS: usize> PartialOrd for Wide<DIGITS> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.as_ref()?.partial_cmp(other.0.as_ref()?)
    }
}

macro_rules! operation {
    ($trait:ident, $method:ident) => {
        impl<const DIGITS: usize> $trait for Wide<DIGITS> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.binary(&other, |context, a, b| context.$method(a, b))
            }
        }
    };
}
operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);

impl<const DIGITS: usize> Rem for Wide<DIGITS> {
    type Output = Self;
    fn rem(self, other: Self) -> Self {
        if num_traits::Zero::is_zero(&other) {
            return Self::INVALID;
        }
        self.binary(&other, |context, a, b| context.rem(a, b))
    }
}

impl<const DIGITS: usize> Neg for Wide<DIGITS> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|big| -big))
    }
}

impl<const DIGITS: usize> num_traits::Zero for Wide<DIGITS> {
    fn zero() -> Self {
        <Self as Field>::from_integer(0)
    }
    fn is_zero(&self) -> bool {
        self.0.as_ref().is_some_and(|big| *big == Big::ZERO)
    }
}

impl<const DIGITS: usize> num_traits::One for Wide<DIGITS> {
    fn one() -> Self {
        <Self as Field>::from_integer(1)
    }
}

impl<const DIGITS: usize> Field for Wide<DIGITS> {
    fn from_integer(value: i64) -> Self {
        Self::from_repr(Repr::new(value.into(), 0))
    }
}

derivable!([const DIGITS: usize] Wide<DIGITS>);

impl<const DIGITS: usize> Analytic for Wide<DIGITS> {
    fn pi() -> Self {
        let pi = CONSTANTS.with_borrow_mut(|cache| Self::context().pi::<2>(Some(cache)));
        Self(Some(pi.value()))
    }

    fn sqrt(&self) -> Self {
        self.unary(|context, x, _| context.sqrt(x))
    }

    fn sincos(&self) -> (Self, Self) {
        let Some(big) = self.0.as_ref().filter(|_| !self.is_beyond(LARGEST_ANGLE_BITS)) else {
            return (Self::INVALID, Self::INVALID);
        };
        let (sin, cos) = sincos::sincos(big, Self::context().precision());
        (Self(Some(sin)), Self(Some(cos)))
    }

    fn acos(&self) -> Self {
        let quick = |x: &Big| angle::acos(x, Self::context().precision());
        if let Some(angle) = self.0.as_ref().and_then(quick) {
            return Self(Some(angle));
        }
        self.unary(|context, x, cache| context.acos(x, Some(cache)))
    }

    fn atan2(&self, x: &Self) -> Self {
        let quick = |(y, x): (&Big, &Big)| angle::atan2(y, x, Self::context().precision());
        if let Some(angle) = self.0.as_ref().zip(x.0.as_ref()).and_then(quick) {
            return Self(Some(angle));
        }
        self.binary(x, |context, y, x| {
            CONSTANTS.with_borrow_mut(|cache| context.atan2(y, x, Some(cache)))
        })
    }

    fn powf(&self, exponent: &Self) -> Self {
        if exponent.is_beyond(LARGEST_EXPONENT_BITS) {
            return Self::INVALID;
        }
        self.binary(exponent, |context, base, exponent| {
            CONSTANTS.with_borrow_mut(|cache| context.powf(base, exponent, Some(cache)))
        })
    }

    /// As by Kahan, but the sign told here: beyond 300 digits f64 has it no more.
    fn epsilon() -> Self {
        let third = Self::from_ratio(4, 3) - <Self as Field>::from_integer(1);
        let missed = <Self as Field>::from_integer(3) * third - <Self as Field>::from_integer(1);
        let zero = <Self as num_traits::Zero>::zero();
        if missed < zero { -missed } else { missed }
    }

    fn from_f64(value: f64) -> Self {
        match Repr::<2>::try_from(value) {
            Ok(repr) if !repr.is_infinite() => Self::from_repr(repr),
            _ => Self::INVALID,
        }
    }

    fn to_f64(&self) -> f64 {
        let nearest = |big: &Big| nearest_normal(big.repr()).unwrap_or_else(|| big.to_f64().value());
        self.0.as_ref().map_or(f64::NAN, nearest)
    }
}

/// The nearest f64, where it is no subnormal one and no infinity: from the 128 leading bits, in a tenth of the time of the
/// general way.
fn nearest_normal(repr: &Repr<2>) -> Option<f64> {
    let (sign, words) = repr.significand().as_sign_words();
    let (below, leading) = words.split_at(words.len().saturating_sub(128 / Word::BITS as usize));
    let leading = leading
        .iter()
        .rev()
        .fold(0, |sum, word| sum << Word::BITS | u128::from(*word));
    // what is cut off tells on which side of a tie it was
    let leading = leading | u128::from(below.iter().any(|word| *word != 0));
    let exponent = repr.exponent() + isize::try_from(below.len() * Word::BITS as usize).ok()?;
    let power = u64::try_from(exponent + 1023)
        .ok()
        .filter(|biased| (1..2047).contains(biased))?;
    let size = leading as f64 * f64::from_bits(power << 52);
    let is_exact = size.is_finite() && size > 2.0 * f64::MIN_POSITIVE;
    is_exact.then_some(if sign == Sign::Negative { -size } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::DualNum;

    type Number = Wide<40>;

    #[test]
    fn pi_is_right_to_forty_digits() {
        assert_eq!(Number::pi().to_string(), "3.141592653589793238462643383279502884197");
        assert_eq!(
            Wide::<60>::pi().to_string(),
            "3.14159265358979323846264338327950288419716939937510582097494"
        );
    }

    #[test]
    fn epsilon_lies_below_the_digits_promised() {
        let epsilon = <Number as Analytic>::epsilon().to_f64();
        assert!(epsilon > 0.0 && epsilon < 1e-40, "{epsilon}");
        // where f64 would tell it from 0 no more
        let epsilon = <Wide<1000> as Analytic>::epsilon();
        assert!(epsilon > Wide::from_f64(0.0) && epsilon.to_f64() == 0.0);
    }

    #[test]
    fn digits_set_at_run_time_are_those_of_the_type_that_has_as_many() {
        let third = |digits| at_digits(digits, || Digits::from_ratio(1, 3).convert::<200>());
        assert_eq!(third(40), Wide::<40>::from_ratio(1, 3).convert());
        assert_eq!(third(100), Wide::<100>::from_ratio(1, 3).convert());
        at_digits(30, || {
            at_digits(70, || assert_eq!(Digits::digits(), 70));
            assert_eq!(Digits::digits(), 30);
        });
    }

    #[test]
    fn f64_passes_through_unchanged() {
        for value in [0.0, -0.0, 1.0, -0.1, 1e300, 5e-324, f64::MIN_POSITIVE, f64::MAX] {
            assert_eq!(Number::from_f64(value).to_f64(), value);
        }
    }

    /// As dashu rounds, which takes its time; ties and what a far bit makes of them among the numbers.
    #[test]
    fn the_nearest_f64_is_found() {
        let halves = [0u64, 1 << 10, 1 << 63, u64::MAX, 0x0123_4567_89ab_cdef];
        for high in [
            1u64,
            (1 << 53) + 1,
            (1 << 54) + 2,
            (1 << 63) | (1 << 10),
            (3 << 62) | (3 << 10),
            u64::MAX,
        ] {
            for (middle, low) in halves.into_iter().flat_map(|middle| halves.map(|low| (middle, low))) {
                for exponent in (-1300..1200).step_by(61).chain([-1150, -1149, -1148, 830, 831, 832]) {
                    for words in [vec![high], vec![low, middle, high], vec![low, middle, low, high]] {
                        let significand = dashu_int::UBig::from_words(&words);
                        let repr = Repr::new(significand.into(), exponent);
                        let big = Big::from_repr(repr.clone(), Context::new(0));
                        let expected = big.to_f64().value();
                        let found = Wide::<90>(Some(big.clone())).to_f64();
                        assert_eq!(found, expected, "{words:?} 2^{exponent}");
                        assert_eq!(Wide::<90>(Some(-big)).to_f64(), -expected);
                    }
                }
            }
        }
    }

    #[test]
    fn what_has_no_value_is_invalid_and_stays_so() {
        let number = Number::from_f64;
        let (zero, one) = (number(0.0), number(1.0));
        let cases = [
            number(f64::NAN),
            number(f64::INFINITY),
            zero.clone() / zero.clone(),
            one.clone() / zero.clone(),
            one.clone() % zero.clone(),
            Analytic::sqrt(&number(-1.0)),
            Analytic::acos(&number(1.5)),
            Analytic::acos(&-number(1.5)),
            Analytic::powf(&number(-2.0), &number(0.5)),
            number(-2.0).ln(),
            zero.ln(),
            number(2.0).asin(),
            number(2.0).atanh(),
        ];
        for (index, case) in cases.into_iter().enumerate() {
            assert!(!case.is_valid(), "case {index} is {case}");
            assert!(case.to_f64().is_nan() && case.partial_cmp(&case).is_none());
            assert!(!(case.clone() + one.clone()).is_valid());
            assert!(!case.sincos().0.is_valid() && !Analytic::atan2(&one, &case).is_valid());
        }
    }

    #[test]
    fn an_angle_beyond_all_phases_is_invalid_and_not_a_wait() {
        let huge = Field::to_power(&Number::from_f64(f64::MAX), 1000);
        assert!(huge.is_valid() && !huge.sincos().0.is_valid() && !huge.tan().is_valid());
    }

    #[test]
    fn elementary_functions_undo_each_other() {
        let x = Number::from_ratio(3, 7);
        let close = |y: Number| (y - x.clone()).to_f64().abs() < 1e-40;
        assert!(close(x.exp().ln()) && close(x.exp_m1().ln_1p()) && close(x.exp2().log2()));
        assert!(close(x.sinh().asinh()) && close(x.tanh().atanh()) && close(x.tan().atan()));
        assert!(close(x.sin().asin()) && close(x.cbrt().powi(3)));
        assert!(close(DualNum::sqrt(&DualNum::powf(&x, 2.0))));
    }
}
