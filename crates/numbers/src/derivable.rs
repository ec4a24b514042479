//! What num-dual asks of a number before it can stand inside a dual number.
//!
//! `DualNum` wants some forty operator impls and every elementary function. A type of ours gives the four
//! operations, an ordering and one `elementary` that matches on [`Elementary`]; `derivable!` writes the rest.

/// The elementary functions of one argument that num-dual names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Elementary {
    Cbrt,
    Exp,
    Exp2,
    ExpM1,
    Ln,
    Log2,
    Log10,
    Ln1p,
    Tan,
    Asin,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
}

impl Elementary {
    /// Its value.
    pub fn of<T: num_dual::DualNum>(self, x: &T) -> T {
        match self {
            Elementary::Cbrt => x.cbrt(),
            Elementary::Exp => x.exp(),
            Elementary::Exp2 => x.exp2(),
            Elementary::ExpM1 => x.exp_m1(),
            Elementary::Ln => x.ln(),
            Elementary::Log2 => x.log2(),
            Elementary::Log10 => x.log10(),
            Elementary::Ln1p => x.ln_1p(),
            Elementary::Tan => x.tan(),
            Elementary::Asin => x.asin(),
            Elementary::Atan => x.atan(),
            Elementary::Sinh => x.sinh(),
            Elementary::Cosh => x.cosh(),
            Elementary::Tanh => x.tanh(),
            Elementary::Asinh => x.asinh(),
            Elementary::Acosh => x.acosh(),
            Elementary::Atanh => x.atanh(),
        }
    }
}

/// Operators between `$type` and references or f64, all through the operator on two values.
macro_rules! derivable_operator {
    ([$($generics:tt)*] $type:ty, $trait:ident, $method:ident, $assign_trait:ident, $assign:ident) => {
        impl<$($generics)*> std::ops::$trait<&$type> for $type {
            type Output = $type;
            fn $method(self, other: &$type) -> $type {
                std::ops::$trait::$method(self, other.clone())
            }
        }
        impl<$($generics)*> std::ops::$trait<f64> for $type {
            type Output = $type;
            fn $method(self, other: f64) -> $type {
                std::ops::$trait::$method(self, <$type as $crate::Analytic>::from_f64(other))
            }
        }
        impl<$($generics)*> std::ops::$assign_trait<f64> for $type {
            fn $assign(&mut self, other: f64) {
                *self = std::ops::$trait::$method(self.clone(), other);
            }
        }
    };
}

/// An assigning operator on two values.
macro_rules! derivable_assigning {
    ([$($generics:tt)*] $type:ty, $assign_trait:ident, $assign:ident, $trait:ident, $method:ident) => {
        impl<$($generics)*> std::ops::$assign_trait for $type {
            fn $assign(&mut self, other: $type) {
                *self = std::ops::$trait::$method(self.clone(), other);
            }
        }
    };
}

/// `DualNum` methods that are one elementary function each.
macro_rules! derivable_functions {
    ($($method:ident => $function:ident),* $(,)?) => {
        $(fn $method(&self) -> Self {
            self.elementary($crate::derivable::Elementary::$function)
        })*
    };
}

/// `DualNum`, and all that it rests on, for `$type`, which has `Analytic`, `Rem`, `PartialOrd`, `Display` and
/// an inherent `elementary`. With `own signs and assigning`, `Signed` and the
/// assigning operators of a field are there already.
macro_rules! derivable {
    ([$($generics:tt)*] $type:ty) => {
        derivable_assigning!([$($generics)*] $type, AddAssign, add_assign, Add, add);
        derivable_assigning!([$($generics)*] $type, SubAssign, sub_assign, Sub, sub);
        derivable_assigning!([$($generics)*] $type, MulAssign, mul_assign, Mul, mul);
        derivable_assigning!([$($generics)*] $type, DivAssign, div_assign, Div, div);
        derivable_signs!([$($generics)*] $type);
        derivable!([$($generics)*] $type, own signs and assigning);
    };
    ([$($generics:tt)*] $type:ty, own signs and assigning) => {
        derivable_assigning!([$($generics)*] $type, RemAssign, rem_assign, Rem, rem);
        derivable_operator!([$($generics)*] $type, Add, add, AddAssign, add_assign);
        derivable_operator!([$($generics)*] $type, Sub, sub, SubAssign, sub_assign);
        derivable_operator!([$($generics)*] $type, Mul, mul, MulAssign, mul_assign);
        derivable_operator!([$($generics)*] $type, Div, div, DivAssign, div_assign);
        derivable_operator!([$($generics)*] $type, Rem, rem, RemAssign, rem_assign);
        derivable_conversions!([$($generics)*] $type);

        impl<$($generics)*> num_dual::DualNum for $type {
            type Primitive = f64;
            const NDERIV: usize = 0;
            type InnerDual = Self;

            fn from_re(re: Self) -> Self {
                re
            }
            fn scale(self, factor: &Self) -> Self {
                self * factor
            }
            fn recip(&self) -> Self {
                <Self as num_traits::One>::one() / self.clone()
            }
            fn powi(&self, n: i32) -> Self {
                $crate::Field::to_power(self, n)
            }
            fn powf(&self, n: f64) -> Self {
                let exponent = <Self as $crate::Analytic>::from_f64(n);
                $crate::Analytic::powf(self, &exponent)
            }
            fn sqrt(&self) -> Self {
                $crate::Analytic::sqrt(self)
            }
            fn log(&self, base: f64) -> Self {
                let base = <Self as $crate::Analytic>::from_f64(base);
                num_dual::DualNum::ln(self) / num_dual::DualNum::ln(&base)
            }
            fn sin(&self) -> Self {
                $crate::Analytic::sincos(self).0
            }
            fn cos(&self) -> Self {
                $crate::Analytic::sincos(self).1
            }
            fn sin_cos(&self) -> (Self, Self) {
                $crate::Analytic::sincos(self)
            }
            fn acos(&self) -> Self {
                $crate::Analytic::acos(self)
            }
            fn atan2(&self, other: Self) -> Self {
                $crate::Analytic::atan2(self, &other)
            }
            derivable_functions!(
                cbrt => Cbrt, exp => Exp, exp2 => Exp2, exp_m1 => ExpM1, ln => Ln, log2 => Log2, log10 => Log10,
                ln_1p => Ln1p, tan => Tan, asin => Asin, atan => Atan, sinh => Sinh, cosh => Cosh, tanh => Tanh,
                asinh => Asinh, acosh => Acosh, atanh => Atanh,
            );

            // The spherical Bessel functions by their textbook forms, which lose digits near 0; nothing here
            // calls them, but the trait will not do without.
            fn sph_j0(&self) -> Self {
                let (sin, _) = $crate::Analytic::sincos(self);
                sin / self
            }
            fn sph_j1(&self) -> Self {
                let (sin, cos) = $crate::Analytic::sincos(self);
                (sin / self - cos) / self
            }
            fn sph_j2(&self) -> Self {
                let three = <Self as $crate::Field>::from_integer(3);
                num_dual::DualNum::sph_j1(self) * three / self - num_dual::DualNum::sph_j0(self)
            }
        }
    };
}

/// The sign of a number that is one.
macro_rules! derivable_signs {
    ([$($generics:tt)*] $type:ty) => {
        impl<$($generics)*> num_traits::Signed for $type {
            fn abs(&self) -> Self {
                if num_traits::Signed::is_negative(self) { -self.clone() } else { self.clone() }
            }
            fn abs_sub(&self, other: &Self) -> Self {
                if *self <= *other { num_traits::Zero::zero() } else { self.clone() - other }
            }
            fn signum(&self) -> Self {
                let one = <Self as num_traits::One>::one();
                if num_traits::Signed::is_negative(self) { -one } else { one }
            }
            fn is_positive(&self) -> bool {
                *self > <Self as num_traits::Zero>::zero()
            }
            fn is_negative(&self) -> bool {
                *self < <Self as num_traits::Zero>::zero()
            }
        }
    };
}

/// The traits of num-traits and num-dual around the operators.
macro_rules! derivable_conversions {
    ([$($generics:tt)*] $type:ty) => {
        impl<$($generics)*> From<f64> for $type {
            fn from(value: f64) -> Self {
                <Self as $crate::Analytic>::from_f64(value)
            }
        }
        impl<$($generics)*> PartialEq<f64> for $type {
            fn eq(&self, other: &f64) -> bool {
                self.partial_cmp(other) == Some(std::cmp::Ordering::Equal)
            }
        }
        impl<$($generics)*> PartialOrd<f64> for $type {
            fn partial_cmp(&self, other: &f64) -> Option<std::cmp::Ordering> {
                self.partial_cmp(&Self::from(*other))
            }
        }
        impl<$($generics)*> num_traits::Inv for $type {
            type Output = Self;
            fn inv(self) -> Self {
                <Self as num_traits::One>::one() / self
            }
        }
        impl<$($generics)*> num_traits::FromPrimitive for $type {
            fn from_i64(n: i64) -> Option<Self> {
                Some(<Self as $crate::Field>::from_integer(n))
            }
            fn from_u64(n: u64) -> Option<Self> {
                i64::try_from(n).ok().map(<Self as $crate::Field>::from_integer)
            }
            fn from_f64(n: f64) -> Option<Self> {
                Some(<Self as $crate::Analytic>::from_f64(n))
            }
        }
        impl<$($generics)*> num_traits::Num for $type {
            type FromStrRadixErr = num_traits::ParseFloatError;
            fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
                <f64 as num_traits::Num>::from_str_radix(text, radix).map(Self::from)
            }
        }
        impl<$($generics)*> std::iter::Sum for $type {
            fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
                numbers.fold(num_traits::Zero::zero(), |sum, number| sum + number)
            }
        }
        impl<$($generics)*> std::iter::Product for $type {
            fn product<I: Iterator<Item = Self>>(numbers: I) -> Self {
                numbers.fold(num_traits::One::one(), |product, number| product * number)
            }
        }
        impl<$($generics)*> num_dual::DualStruct for $type {
            type Real = f64;
            type Inner = Self;
            fn re(&self) -> f64 {
                $crate::Analytic::to_f64(self)
            }
            fn from_inner(inner: &Self) -> Self {
                inner.clone()
            }
        }
        impl<$($generics)*> num_dual::Mappable<Self> for $type {
            type Output<O> = O;
            fn map_dual<M: Fn(Self) -> O, O>(self, f: M) -> O {
                f(self)
            }
        }
    };
}
