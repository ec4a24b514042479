//! A number that counts what is done with it: the cost of a method, whatever the machine.

use super::derivable::Elementary;
use super::{Analytic, Endpoint, Field, Machine, Rung, Wide};
use std::cell::Cell;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

/// How many operations were done. Signs, comparisons and conversions are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Additions and subtractions.
    pub additions: u64,
    /// Multiplications.
    pub multiplications: u64,
    /// Divisions, reciprocals among them.
    pub divisions: u64,
    /// Square roots.
    pub roots: u64,
    /// Pairs of sine and cosine.
    pub sincos: u64,
    /// Other functions: arc cosine, angle, power, logarithm, ...
    pub others: u64,
}

impl Counts {
    const NONE: Self = Self {
        additions: 0,
        multiplications: 0,
        divisions: 0,
        roots: 0,
        sincos: 0,
        others: 0,
    };

    /// All operations, each as one.
    pub fn total(&self) -> u64 {
        self.additions + self.multiplications + self.divisions + self.roots + self.sincos + self.others
    }

    /// What `work` did on this thread with [`Counted`] numbers, beside its result. May be nested.
    pub fn of<R>(work: impl FnOnce() -> R) -> (R, Self) {
        let outer = DONE.replace(Self::NONE);
        let result = work();
        let counts = DONE.get();
        DONE.set(outer.and(&counts));
        (result, counts)
    }

    /// So many times as many.
    pub fn times(&self, factor: u64) -> Self {
        Self {
            additions: factor * self.additions,
            multiplications: factor * self.multiplications,
            divisions: factor * self.divisions,
            roots: factor * self.roots,
            sincos: factor * self.sincos,
            others: factor * self.others,
        }
    }

    /// Both together.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            additions: self.additions + other.additions,
            multiplications: self.multiplications + other.multiplications,
            divisions: self.divisions + other.divisions,
            roots: self.roots + other.roots,
            sincos: self.sincos + other.sincos,
            others: self.others + other.others,
        }
    }
}

thread_local! {
    static DONE: Cell<Counts> = const { Cell::new(Counts::NONE) };
}

fn count(one_more: impl FnOnce(&mut Counts)) {
    let mut counts = DONE.get();
    one_more(&mut counts);
    DONE.set(counts);
}

/// A number whose operations are counted; its values are those of `T`, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Counted<T>(pub T);

impl<T: Machine> Machine for Counted<T> {
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        self.0.to_wide()
    }
}

impl<T: fmt::Display> fmt::Display for Counted<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operation {
    ($trait:ident, $method:ident, $counter:ident) => {
        impl<T: Machine> $trait for Counted<T> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                count(|counts| counts.$counter += 1);
                Self($trait::$method(self.0, other.0))
            }
        }
    };
}
operation!(Add, add, additions);
operation!(Sub, sub, additions);
operation!(Mul, mul, multiplications);
operation!(Div, div, divisions);
operation!(Rem, rem, divisions);

impl<T: Machine> Neg for Counted<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Machine> num_traits::Zero for Counted<T> {
    fn zero() -> Self {
        Self(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl<T: Machine> num_traits::One for Counted<T> {
    fn one() -> Self {
        Self(T::one())
    }
}

impl<T: Machine> Field for Counted<T> {
    fn from_integer(value: i64) -> Self {
        Self(T::from_integer(value))
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        // a constant of the formula, which a compiler folds
        Self(T::from_ratio(numerator, denominator))
    }
}

derivable!([T: Machine] Counted<T>);

impl<T: Machine> Counted<T> {
    pub(crate) fn elementary(&self, function: Elementary) -> Self {
        count(|counts| counts.others += 1);
        Self(function.of(&self.0))
    }
}

impl<T: Machine> Analytic for Counted<T> {
    fn pi() -> Self {
        Self(T::pi())
    }
    fn sqrt(&self) -> Self {
        count(|counts| counts.roots += 1);
        Self(Analytic::sqrt(&self.0))
    }
    fn sincos(&self) -> (Self, Self) {
        count(|counts| counts.sincos += 1);
        let (sin, cos) = self.0.sincos();
        (Self(sin), Self(cos))
    }
    fn acos(&self) -> Self {
        count(|counts| counts.others += 1);
        Self(Analytic::acos(&self.0))
    }
    fn atan2(&self, x: &Self) -> Self {
        count(|counts| counts.others += 1);
        Self(Analytic::atan2(&self.0, &x.0))
    }
    fn powf(&self, exponent: &Self) -> Self {
        count(|counts| counts.others += 1);
        Self(Analytic::powf(&self.0, &exponent.0))
    }
    fn from_f64(value: f64) -> Self {
        Self(<T as Analytic>::from_f64(value))
    }
    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }
    fn epsilon() -> Self {
        Self(<T as Analytic>::epsilon())
    }
}

/// A step to a neighbour is none that is counted, as a change of sign is not.
impl<T: Machine> Endpoint for Counted<T> {
    const INFINITE: bool = T::INFINITE;

    fn below(&self) -> Self {
        Self(self.0.below())
    }
    fn above(&self) -> Self {
        Self(self.0.above())
    }
    fn lowest() -> Self {
        Self(T::lowest())
    }
    fn highest() -> Self {
        Self(T::highest())
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    fn rung() -> Rung {
        T::rung()
    }
    fn bounded_sincos(&self) -> (Self, Self) {
        count(|counts| counts.sincos += 1);
        let (sin, cos) = self.0.bounded_sincos();
        (Self(sin), Self(cos))
    }
    fn bounded_acos(&self) -> Self {
        count(|counts| counts.others += 1);
        Self(self.0.bounded_acos())
    }
    fn bounded_atan2(&self, x: &Self) -> Self {
        count(|counts| counts.others += 1);
        Self(self.0.bounded_atan2(&x.0))
    }
    fn bounded_powf(&self, exponent: &Self) -> Self {
        count(|counts| counts.others += 1);
        Self(self.0.bounded_powf(&exponent.0))
    }
    fn bounded_exp(&self) -> Self {
        count(|counts| counts.others += 1);
        Self(self.0.bounded_exp())
    }
    fn bounded_ln(&self) -> Self {
        count(|counts| counts.others += 1);
        Self(self.0.bounded_ln())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Dual, seeded};
    use super::*;

    #[test]
    fn every_operation_is_counted_once_and_the_value_is_unchanged() {
        let (a, b) = (Counted(2.0_f64), Counted(1.0));
        let (value, counts) = Counts::of(|| {
            let (sin, cos) = (a + b - a).sincos();
            Analytic::sqrt(&(sin * sin + cos / b))
        });
        let expected = Counts {
            additions: 3,
            multiplications: 1,
            divisions: 1,
            roots: 1,
            sincos: 1,
            others: 0,
        };
        assert_eq!(counts, expected);
        assert_eq!(counts.total(), 7);
        let (sin, cos) = 1.0_f64.sin_cos();
        assert_eq!(value.0, (sin * sin + cos).sqrt());
    }

    #[test]
    fn a_count_inside_a_count_belongs_to_both() {
        let one = Counted(1.0_f32);
        let (inner, outer) = Counts::of(|| Counts::of(|| one + one).1);
        assert_eq!((inner.additions, outer.additions), (1, 1));
    }

    #[test]
    fn a_product_of_duals_costs_three_products_and_a_sum() {
        let x: Dual<Counted<f64>> = seeded(Counted(2.0));
        let (square, counts) = Counts::of(|| x * x);
        assert_eq!(square.eps.0, 4.0);
        assert_eq!((counts.multiplications, counts.additions), (3, 1));
    }
}
