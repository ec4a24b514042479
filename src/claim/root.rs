//! Square roots in formulas.

use crate::algebra::{Fraction, Polynomial, square_root};

/// The polynomials `(p, q)` with `radicand = p / q^2`.
pub fn over_a_square(radicand: &Fraction) -> (Polynomial, Polynomial) {
    let below = radicand.denominator();
    (radicand.numerator().times(&below), below)
}

/// A function whose square is `radicand`, of whichever sign, where there is one.
pub fn either_root(radicand: &Fraction) -> Option<Fraction> {
    let (above, below) = over_a_square(radicand);
    if above.is_zero() {
        return Some(Fraction::from(above));
    }
    Some(Fraction::from(square_root(&above)?) / Fraction::from(below))
}

/// The root of a function that is the square of a number.
pub fn of_square(radicand: &Fraction) -> Option<Fraction> {
    let root = either_root(radicand)?;
    let value = root.as_constant()?;
    Some(Fraction::from(&if value.0 < dashu_ratio::RBig::ZERO {
        -value
    } else {
        value
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Variable;
    use crate::number::Field;

    #[test]
    fn the_root_of_a_rational_square_is_not_negative() {
        assert_eq!(of_square(&Fraction::from_ratio(4, 9)), Some(Fraction::from_ratio(2, 3)));
        assert_eq!(of_square(&Fraction::from_integer(2)), None);
        assert_eq!(of_square(&Fraction::from_integer(0)), Some(Fraction::from_integer(0)));
    }

    #[test]
    fn a_square_of_a_quotient_has_a_root_of_unknown_sign() {
        let x = Fraction::variable(Variable(0));
        let quotient = x.clone() / (x + Fraction::from_integer(1));
        let root = either_root(&(quotient.clone() * quotient.clone())).unwrap();
        assert!(root == quotient || root == -quotient.clone());
        assert_eq!(of_square(&(quotient.clone() * quotient)), None);
    }
}
