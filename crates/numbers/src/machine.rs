//! What every number type that means are compared in can do, and a computation done in any of them.

use super::{Analytic, Digits, DoubleDouble, Endpoint, Rung, Wide, at_digits};
use num_dual::DualNum;

/// The numbers that means are compared in: each can be counted, can end an interval, and can be judged.
pub trait Machine: Endpoint + DualNum {
    /// The value in more digits: exactly, where `DIGITS` are as many as the type has.
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS>;
}

impl Machine for f32 {
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        Analytic::from_f64(f64::from(*self))
    }
}

impl Machine for f64 {
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        Analytic::from_f64(*self)
    }
}

impl Machine for DoubleDouble {
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        DoubleDouble::to_wide(self)
    }
}

impl<const OWN: usize> Machine for Wide<OWN> {
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        self.convert()
    }
}

/// A computation that can be done in any of the number types.
pub trait AtRung {
    /// What is computed: nothing that has the number in its type.
    type Output;
    /// The computation in `T`.
    fn run<T: Machine>(self) -> Self::Output;
}

impl Rung {
    /// The computation in this number.
    pub fn at<C: AtRung>(self, computation: C) -> C::Output {
        match self {
            Self::Single => computation.run::<f32>(),
            Self::Double => computation.run::<f64>(),
            Self::DoubleDouble => computation.run::<DoubleDouble>(),
            Self::Wide(digits) => at_digits(digits, || computation.run::<Digits>()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Rounding;
    impl AtRung for Rounding {
        type Output = f64;
        fn run<T: Machine>(self) -> f64 {
            <T as Analytic>::epsilon().to_f64()
        }
    }

    #[test]
    fn every_rung_rounds_as_its_digits_say() {
        for rung in Rung::ALL {
            let digits = -(0.5 * rung.at(Rounding)).log10();
            assert!(digits > f64::from(rung.digits()) - 0.1, "{rung} {digits}");
        }
    }
}
