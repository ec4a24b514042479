//! The numbers that formulas are evaluated over: the reals, with the domains that functions have there, or the complex
//! numbers, with principal branches. Each over f64, many digits, and duals of both.

use num_dual::DualNum;
use numbers::Analytic;
use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

/// A real number type with every elementary function.
pub trait Real: Analytic + DualNum {}
impl<T: Analytic + DualNum> Real for T {}

/// NaN, or what stands for it.
pub fn undefined<T: Analytic>() -> T {
    T::from_f64(f64::NAN)
}

/// The elementary functions that are no quotient of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    Sin,
    Cos,
    Exp,
    Ln,
    Sinh,
    Cosh,
    Arcsin,
    Arccos,
    Arctan,
    Arsinh,
    Arcosh,
    Artanh,
    Abs,
    Sgn,
    Conjugate,
    Re,
    Im,
    Arg,
}

/// A number that formulas are evaluated over. What has no value is NaN and stays so.
pub trait Value:
    Clone + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    type Part: Real;

    /// A number by its real and imaginary parts; the reals drop the latter.
    fn new(re: Self::Part, im: Self::Part) -> Self;
    /// The real and the imaginary part.
    fn parts(&self) -> [Self::Part; 2];
    /// The absolute value, in f64.
    fn size(&self) -> f64;
    /// The quotient; NaN where the divisor is 0.
    fn over(&self, divisor: &Self) -> Self;
    /// An elementary function, NaN outside its domain and on a jump that rounding errors may have crossed.
    fn apply(&self, function: Function) -> Self;
    /// The root of an index of 2 or more: odd roots of negative reals are real.
    fn root(&self, index: u32) -> Self;
    /// A power with any exponent: over the reals the base must not be negative.
    fn power(&self, exponent: &Self) -> Self;

    fn real(value: Self::Part) -> Self {
        Self::new(value, num_traits::Zero::zero())
    }
    fn integer(value: i64) -> Self {
        Self::real(numbers::Field::from_integer(value))
    }
    fn float(value: f64) -> Self {
        Self::real(<Self::Part as Analytic>::from_f64(value))
    }
    /// A power with an integer exponent, by squaring; NaN for a negative power of 0.
    fn integer_power(&self, exponent: i32) -> Self {
        if exponent == 0 {
            // 1 where the base has a value
            return Self::integer(1) + self.clone() * Self::integer(0);
        }
        let (mut result, mut square, mut left) = (Self::integer(1), self.clone(), exponent.unsigned_abs());
        while left > 0 {
            if left & 1 == 1 {
                result = result * square.clone();
            }
            left >>= 1;
            if left > 0 {
                square = square.clone() * square;
            }
        }
        if exponent < 0 {
            Self::integer(1).over(&result)
        } else {
            result
        }
    }
}

/// A distance from a jump or a branch cut below which rounding errors may have crossed it.
fn noise<T: Analytic>() -> f64 {
    if T::epsilon().to_f64() < 1e-20 { 1e-28 } else { 1e-11 }
}

impl<T: Real> Value for T {
    type Part = T;

    fn new(re: T, _: T) -> T {
        re
    }
    fn parts(&self) -> [T; 2] {
        [self.clone(), num_traits::Zero::zero()]
    }
    fn size(&self) -> f64 {
        self.to_f64().abs()
    }
    fn over(&self, divisor: &T) -> T {
        // Duals compare as zero by value alone: a dual number over zero has no value either.
        if divisor.is_zero() {
            undefined()
        } else {
            self.clone() / divisor.clone()
        }
    }
    fn apply(&self, function: Function) -> T {
        let x = self.to_f64();
        let within = match function {
            Function::Ln => x > noise::<T>(),
            Function::Arcsin | Function::Arccos => x.abs() <= 1.0,
            Function::Arcosh => x >= 1.0,
            Function::Artanh => x.abs() < 1.0,
            Function::Sgn => x == 0.0 || x.abs() > noise::<T>(),
            Function::Arg => x.abs() > noise::<T>(),
            _ => true,
        };
        if !within {
            return undefined();
        }
        match function {
            Function::Sin => self.sincos().0,
            Function::Cos => self.sincos().1,
            Function::Exp => DualNum::exp(self),
            Function::Ln => DualNum::ln(self),
            Function::Sinh => DualNum::sinh(self),
            Function::Cosh => DualNum::cosh(self),
            Function::Arcsin => DualNum::asin(self),
            Function::Arccos => Analytic::acos(self),
            Function::Arctan => DualNum::atan(self),
            Function::Arsinh => DualNum::asinh(self),
            Function::Arcosh => DualNum::acosh(self),
            Function::Artanh => DualNum::atanh(self),
            Function::Abs if x < 0.0 => -self.clone(),
            Function::Abs => self.clone(),
            Function::Sgn if x == 0.0 => T::from_integer(0),
            Function::Sgn => <T as Analytic>::from_f64(x.signum()),
            Function::Conjugate | Function::Re => self.clone(),
            Function::Im => T::from_integer(0),
            Function::Arg if x < 0.0 => T::pi(),
            Function::Arg => T::from_integer(0),
        }
    }
    fn root(&self, index: u32) -> T {
        let x = self.to_f64();
        match index {
            _ if x < 0.0 && index % 2 == 1 => -(-self.clone()).root(index),
            _ if x < 0.0 => undefined(),
            2 => Analytic::sqrt(self),
            _ if self.is_zero() => self.clone(),
            _ => Analytic::powf(self, &T::from_ratio(1, i64::from(index))),
        }
    }
    fn power(&self, exponent: &T) -> T {
        match self.to_f64() {
            base if base > 0.0 => Analytic::powf(self, exponent),
            0.0 if exponent.to_f64() > 0.0 => T::from_integer(0),
            _ => undefined(),
        }
    }
}

/// A complex number.
#[derive(Clone, Debug, PartialEq)]
pub struct Complex<T> {
    pub re: T,
    pub im: T,
}

impl<T: Real> Add for Complex<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}
impl<T: Real> Sub for Complex<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}
impl<T: Real> Neg for Complex<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}
impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(
            self.re.clone() * other.re.clone() - self.im.clone() * other.im.clone(),
            self.re * other.im + self.im * other.re,
        )
    }
}

impl<T: Real> Complex<T> {
    fn modulus(&self) -> T {
        let (re, im) = (self.re.apply(Function::Abs), self.im.apply(Function::Abs));
        let (large, small) = if re.to_f64() >= im.to_f64() { (re, im) } else { (im, re) };
        if small.is_zero() {
            return large;
        }
        let ratio = small / large.clone();
        large * Analytic::sqrt(&(T::one() + ratio.clone() * ratio))
    }

    /// The argument in (-pi, pi]; NaN where rounding errors may have crossed the negative real axis.
    fn argument(&self) -> T {
        let (re, im) = (self.re.to_f64(), self.im.to_f64());
        if self.im.is_zero() {
            return match re {
                re if re > 0.0 => self.im.clone() / self.re.clone(),
                re if re < 0.0 => T::pi() + self.im.clone() / self.re.clone(),
                _ => undefined(),
            };
        }
        if re < 0.0 && im.abs() < noise::<T>() * re.abs() {
            return undefined();
        }
        Analytic::atan2(&self.im, &self.re)
    }

    fn times_i(self) -> Self {
        Self::new(-self.im, self.re)
    }

    fn halved(self) -> Self {
        self * Self::real(T::from_ratio(1, 2))
    }
}

impl<T: Real> Value for Complex<T> {
    type Part = T;

    fn new(re: T, im: T) -> Self {
        Self { re, im }
    }
    fn parts(&self) -> [T; 2] {
        [self.re.clone(), self.im.clone()]
    }
    fn size(&self) -> f64 {
        self.re.to_f64().hypot(self.im.to_f64())
    }
    fn over(&self, divisor: &Self) -> Self {
        if divisor.im.is_zero() {
            return Self::new(self.re.over(&divisor.re), self.im.over(&divisor.re));
        }
        let square = divisor.re.clone() * divisor.re.clone() + divisor.im.clone() * divisor.im.clone();
        let product = self.clone() * Self::new(divisor.re.clone(), -divisor.im.clone());
        Self::new(product.re.over(&square), product.im.over(&square))
    }
    fn apply(&self, function: Function) -> Self {
        let one = || Self::integer(1);
        let square = || self.clone() * self.clone();
        let ln = |z: Self| z.apply(Function::Ln);
        match function {
            Function::Exp => {
                let (size, (sin, cos)) = (DualNum::exp(&self.re), self.im.sincos());
                Self::new(size.clone() * cos, size * sin)
            }
            Function::Ln => Self::new(self.modulus().apply(Function::Ln), self.argument()),
            Function::Sin | Function::Cos => {
                let (sin, cos) = self.re.sincos();
                let (sinh, cosh) = (DualNum::sinh(&self.im), DualNum::cosh(&self.im));
                match function {
                    Function::Sin => Self::new(sin * cosh, cos * sinh),
                    _ => Self::new(cos * cosh, -(sin * sinh)),
                }
            }
            // sinh z = -i sin iz, cosh z = cos iz
            Function::Sinh => -self.clone().times_i().apply(Function::Sin).times_i(),
            Function::Cosh => self.clone().times_i().apply(Function::Cos),
            // NIST Handbook of Mathematical Functions, 4.23(iv) and 4.37(iv)
            Function::Arcsin => -self.clone().times_i().apply(Function::Arsinh).times_i(),
            Function::Arccos => Self::real(T::pi()).halved() - self.apply(Function::Arcsin),
            Function::Arctan => {
                let iz = self.clone().times_i();
                (ln(one() - iz.clone()) - ln(one() + iz)).halved().times_i()
            }
            // of the two logarithms, which are each other's negative, the one whose argument does not cancel
            Function::Arsinh => {
                let root = (square() + one()).root(2);
                let (sum, difference) = (root.clone() + self.clone(), root - self.clone());
                match sum.size() >= difference.size() {
                    true => ln(sum),
                    false => -ln(difference),
                }
            }
            Function::Arcosh => ln(self.clone() + (self.clone() + one()).root(2) * (self.clone() - one()).root(2)),
            // half the logarithm of (1 + z)/(1 - z), whose size is near 1 where z is large: it is told by what it differs by
            Function::Artanh => {
                let (re, im) = (self.re.clone(), self.im.clone());
                let (below, above) = (T::one() - re.clone(), T::one() + re.clone());
                let square = below.clone() * below.clone() + im.clone() * im.clone();
                let more = T::from_ratio(4, 1) * re;
                let turned = Self::new(below * above - im.clone() * im.clone(), im.clone() + im);
                let size = DualNum::ln_1p(&more.over(&square)) * T::from_ratio(1, 4);
                Self::new(size, turned.argument() * T::from_ratio(1, 2))
            }
            Function::Abs => Self::real(self.modulus()),
            Function::Sgn if self.im.is_zero() => Self::real(self.re.apply(Function::Sgn)),
            Function::Sgn => self.over(&Self::real(self.modulus())),
            Function::Conjugate => Self::new(self.re.clone(), -self.im.clone()),
            Function::Re => Self::real(self.re.clone()),
            Function::Im => Self::real(self.im.clone()),
            Function::Arg => Self::real(self.argument()),
        }
    }
    fn root(&self, index: u32) -> Self {
        if self.re.is_zero() && self.im.is_zero() {
            return self.clone();
        }
        if index == 2 && self.im.is_zero() {
            let root = Analytic::sqrt(&self.re.apply(Function::Abs));
            let zero = self.im.clone() / (root.clone() + root.clone());
            return match self.re.to_f64() {
                re if re < 0.0 => Self::new(zero, root),
                _ => Self::new(root, zero),
            };
        }
        let part = T::from_ratio(1, i64::from(index));
        let size = self.modulus().root(index);
        let (sin, cos) = (self.argument() * part).sincos();
        Self::new(size.clone() * cos, size * sin)
    }
    fn power(&self, exponent: &Self) -> Self {
        (exponent.clone() * self.apply(Function::Ln)).apply(Function::Exp)
    }
}

/// Which numbers a claim is read over.
pub trait Numbers {
    type Of<T: Real>: Value<Part = T>;
    const COMPLEX: bool;
}

/// The reals.
#[derive(Clone, Copy, Debug)]
pub struct Reals;
impl Numbers for Reals {
    type Of<T: Real> = T;
    const COMPLEX: bool = false;
}

/// The complex numbers.
#[derive(Clone, Copy, Debug)]
pub struct Complexes;
impl Numbers for Complexes {
    type Of<T: Real> = Complex<T>;
    const COMPLEX: bool = true;
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Function; 14] = [
        Function::Sin,
        Function::Cos,
        Function::Exp,
        Function::Ln,
        Function::Sinh,
        Function::Cosh,
        Function::Arcsin,
        Function::Arccos,
        Function::Arctan,
        Function::Arsinh,
        Function::Arcosh,
        Function::Artanh,
        Function::Abs,
        Function::Sgn,
    ];

    #[test]
    fn on_its_real_domain_a_function_has_the_same_value_over_the_complex_numbers() {
        for function in ALL {
            for x in [-2.5, -0.6, 0.25, 0.9, 1.0, 3.5] {
                let (real, complex) = (x.apply(function), Complex::<f64>::real(x).apply(function));
                if real.is_finite() {
                    let apart = (real - complex.re).abs() + complex.im.abs();
                    assert!(
                        apart < 1e-14 * (1.0 + real.abs()),
                        "{function:?} {x} {real} {complex:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn complex_branches_are_the_principal_ones() {
        let minus = Complex::<f64>::real(-1.0);
        assert_eq!(minus.root(2), Complex::new(0.0, 1.0));
        assert!((minus.apply(Function::Ln).im - std::f64::consts::PI).abs() < 1e-15);
        assert!((minus.root(3).re - 0.5).abs() < 1e-15);
        let z = Complex::new(-0.3, 1.7);
        let back = z.apply(Function::Arcsin).apply(Function::Sin);
        assert!((back - z.clone()).size() < 1e-14);
        for far in [
            Complex::<f64>::new(-3e7, 4e6),
            Complex::new(2e8, -1e9),
            Complex::new(-5.0, -8e9),
        ] {
            for (there, back) in [(Function::Arcsin, Function::Sin), (Function::Arccos, Function::Cos)] {
                let apart = far.apply(there).apply(back) - far.clone();
                assert!(apart.size() < 1e-13 * far.size(), "{there:?} {far:?} {apart:?}");
            }
        }
        let far = Complex::new(-4e9, 3e9);
        let back = far.apply(Function::Artanh);
        let back = back.apply(Function::Sinh).over(&back.apply(Function::Cosh));
        assert!((back - far.clone()).size() < 1e-6 * far.size());
        let back = z.apply(Function::Artanh);
        let tanh = back.apply(Function::Sinh).over(&back.apply(Function::Cosh));
        assert!((tanh - z).size() < 1e-14);
    }

    #[test]
    fn outside_the_domain_there_is_no_value() {
        assert!((-1.0_f64).apply(Function::Ln).is_nan() && 0.0_f64.apply(Function::Ln).is_nan());
        assert!(Value::root(&-1.0_f64, 2).is_nan() && (Value::root(&-8.0_f64, 3) + 2.0).abs() < 1e-15);
        assert!((-2.0_f64).power(&0.5).is_nan() && 0.0_f64.power(&0.0).is_nan());
        assert_eq!(0.0_f64.integer_power(0), 1.0);
        assert!(1.0_f64.over(&0.0).is_nan() && 1e-14_f64.apply(Function::Sgn).is_nan());
    }
}
