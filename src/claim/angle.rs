//! Cosine and sine of angles: polynomials in those of the angle's parts.

use super::atom::{Atom, Atoms};
use super::reading::Meaningless;
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::number::Field;
use crate::tex::Name;
use dashu_int::IBig;
use num_traits::{One, Zero};

/// The multiples of one part that are expanded.
const MOST_TURNS: i64 = 24;

/// The variable of `\pi`.
pub fn pi(atoms: &mut Atoms) -> Variable {
    atoms.variable(Atom::Symbol(Name {
        base: r"\pi".to_string(),
        ..Name::default()
    }))
}

/// Cosine and sine, each term of the angle taken apart by the addition theorem.
///
/// # Errors
/// Where the angle is no polynomial, or holds too large a multiple of a part.
pub fn cosine_and_sine(angle: &Fraction, atoms: &mut Atoms) -> Result<(Fraction, Fraction), Meaningless> {
    let unsupported = |atoms: &Atoms| Meaningless::Angle(atoms.show_fraction(angle));
    let Some(below) = angle.denominator().as_constant() else {
        return Err(unsupported(atoms));
    };
    let circle = pi(atoms);
    let mut sum = (Fraction::one(), Fraction::zero());
    for (monomial, coefficient) in angle.numerator().terms() {
        let alone = monomial.factors() == [(circle, 1)];
        let twice = coefficient * IBig::from(2);
        let turn = if alone && (&twice % &below).is_zero() {
            quarter_turns(&(twice / &below))
        } else {
            let whole = (coefficient % &below).is_zero();
            let (times, part) = if whole {
                (coefficient / &below, IBig::ONE)
            } else {
                (coefficient.clone(), below.clone())
            };
            let times = i64::try_from(times).ok().filter(|n| n.abs() <= MOST_TURNS);
            let Some(times) = times else {
                return Err(unsupported(atoms));
            };
            let unit = Fraction::from(Polynomial::term(monomial.clone(), IBig::ONE))
                / Fraction::from(Polynomial::constant(part));
            multiple(unit, times, atoms)
        };
        sum = add(&sum, &turn);
    }
    Ok(sum)
}

/// By the addition theorem.
fn add(a: &(Fraction, Fraction), b: &(Fraction, Fraction)) -> (Fraction, Fraction) {
    let product = |x: &Fraction, y: &Fraction| x.clone() * y.clone();
    (
        product(&a.0, &b.0) - product(&a.1, &b.1),
        product(&a.0, &b.1) + product(&a.1, &b.0),
    )
}

fn quarter_turns(number: &IBig) -> (Fraction, Fraction) {
    let value = Fraction::from_integer;
    let left = ((number % IBig::from(4)) + IBig::from(4)) % IBig::from(4);
    match i64::try_from(left) {
        Ok(0) => (value(1), value(0)),
        Ok(1) => (value(0), value(1)),
        Ok(2) => (value(-1), value(0)),
        _ => (value(0), value(-1)),
    }
}

fn multiple(unit: Fraction, times: i64, atoms: &mut Atoms) -> (Fraction, Fraction) {
    let cosine = Fraction::variable(atoms.variable(Atom::Circular {
        sine: false,
        angle: unit.clone(),
    }));
    let sine = Fraction::variable(atoms.variable(Atom::Circular {
        sine: true,
        angle: unit,
    }));
    let one = (cosine, if times < 0 { -sine } else { sine });
    (0..times.abs()).fold((Fraction::one(), Fraction::zero()), |sum, _| add(&sum, &one))
}

/// The derivative of the cosine or sine of a part by its angle.
pub fn slope(sine: bool, angle: &Fraction, atoms: &mut Atoms) -> Fraction {
    let other = Fraction::variable(atoms.variable(Atom::Circular {
        sine: !sine,
        angle: angle.clone(),
    }));
    if sine { other } else { -other }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_of_angles_is_expanded_and_whole_turns_vanish() {
        let mut atoms = Atoms::new("k");
        let x = atoms.variable(Atom::Running);
        let circle = Fraction::variable(pi(&mut atoms));
        let x = Fraction::variable(x);
        let plain = cosine_and_sine(&x, &mut atoms).unwrap();
        let turned = x.clone() + Fraction::from_integer(2) * circle.clone();
        assert_eq!(cosine_and_sine(&turned, &mut atoms).unwrap(), plain);
        let half = x.clone() + circle;
        assert_eq!(
            cosine_and_sine(&half, &mut atoms).unwrap(),
            (-plain.0.clone(), -plain.1.clone())
        );
        let double = cosine_and_sine(&(x.clone() + x.clone()), &mut atoms).unwrap();
        assert_eq!(double.1, Fraction::from_integer(2) * plain.0 * plain.1);
        assert!(cosine_and_sine(&(Fraction::from_integer(1) / x), &mut atoms).is_err());
    }
}
