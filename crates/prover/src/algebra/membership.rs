//! Membership in an ideal, in its radical, and in that of its saturation, with cofactors.

use super::division::{coefficients_in, degree_in, exact_quotient, power, times};
use super::groebner::{Engine, Target};
use super::order::Order;
use super::steps::{Result, Steps};
use kernel::{Polynomial, Term};

/// Cofactors of p in the ideal of the polynomials: `p = sum cofactors[i] * polynomials[i]`. `None` where p is not in
/// it, unless 2^61 - 1 is an unlucky prime for these polynomials.
pub fn member(
    p: &Polynomial,
    polynomials: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Vec<Polynomial>>> {
    let found = first_member(&[p], polynomials, &[], order, steps)?;
    Ok(found.map(|(_, cofactors)| cofactors))
}

/// A product of the factors that are not 0 lies in the ideal:
/// `prod nonzero[j]^exponents[j] = sum cofactors[i] * polynomials[i]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refutation {
    pub exponents: Vec<u32>,
    pub cofactors: Vec<Polynomial>,
}

/// A power of p times factors that are not 0 lies in the ideal:
/// `p^power * prod nonzero[j]^exponents[j] = sum cofactors[i] * polynomials[i]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RadicalMembership {
    pub power: u32,
    pub exponents: Vec<u32>,
    pub cofactors: Vec<Polynomial>,
}

/// Looks for a proof that the polynomials have no common zero, over the complex numbers, where none of the factors
/// is 0. `None` where there are such zeros, unless 2^61 - 1 is an unlucky prime.
///
/// First factors are only divided out where they show; then their inverses are adjoined (Rabinowitsch).
pub fn contradiction(
    polynomials: &[Polynomial],
    nonzero: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Refutation>> {
    if nonzero.iter().any(Polynomial::is_zero) {
        let exponents = nonzero.iter().map(|factor| u32::from(factor.is_zero())).collect();
        return Ok(Some(Refutation {
            exponents,
            cofactors: vec![Polynomial::default(); polynomials.len()],
        }));
    }
    let one = Polynomial::integer(1);
    let inverses = with_inverses(nonzero);
    let quick = |steps: &mut Steps| first_member(&[&one], polynomials, &inverses, order, steps);
    let half = steps.left() / 2;
    let found = if nonzero.is_empty() {
        quick(steps)?
    } else {
        steps.attempt(half, quick).flatten()
    };
    let cofactors = match found {
        Some((_, cofactors)) => Some(cofactors),
        None if nonzero.is_empty() => None,
        None => adjoined(polynomials, &inverses, order, steps)?,
    };
    let Some(cofactors) = cofactors else { return Ok(None) };
    let (exponents, cofactors) = clear_inverses(cofactors, &inverses, steps)?;
    Ok(Some(Refutation { exponents, cofactors }))
}

/// Looks for a proof that p is 0 at all common zeros of the polynomials, over the complex numbers, where none of the
/// factors is 0. `None` where it is not, unless 2^61 - 1 is an unlucky prime.
///
/// First small powers of p are reduced while factors are divided out; then the inverses of the factors and of p are
/// adjoined (Rabinowitsch), which decides.
pub fn radical_member(
    p: &Polynomial,
    polynomials: &[Polynomial],
    nonzero: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<RadicalMembership>> {
    // factors of p that are not 0 are split off first
    let (mut core, mut split) = (p.clone(), Polynomial::integer(1));
    for factor in nonzero.iter().filter(|factor| factor.as_constant().is_none()) {
        while !core.is_zero()
            && let Some(quotient) = exact_quotient(&core, factor, steps)?
        {
            core = quotient;
            split = times(&split, factor, steps)?;
        }
    }
    let mut inverses = with_inverses(nonzero);
    let mut powers = vec![core.clone()];
    if core.terms().len() <= 12 {
        powers.push(times(&core, &core, steps)?);
    }
    let half = steps.left() / 2;
    let quick = |steps: &mut Steps| {
        let powers: Vec<&Polynomial> = powers.iter().collect();
        first_member(&powers, polynomials, &inverses, order, steps)
    };
    let (power_of_core, exponents, cofactors) = match steps.attempt(half, quick).flatten() {
        Some((index, cofactors)) => {
            let (exponents, cofactors) = clear_inverses(cofactors, &inverses, steps)?;
            (index as u32 + 1, exponents, cofactors)
        }
        None => {
            inverses = with_inverses(&[nonzero, &[core]].concat());
            let Some(cofactors) = adjoined(polynomials, &inverses, order, steps)? else {
                return Ok(None);
            };
            let (mut exponents, cofactors) = clear_inverses(cofactors, &inverses, steps)?;
            (exponents.pop().unwrap_or(0), exponents, cofactors)
        }
    };
    let factor = power(&split, power_of_core, steps)?;
    let mut whole = Vec::with_capacity(cofactors.len());
    for cofactor in &cofactors {
        whole.push(times(cofactor, &factor, steps)?);
    }
    Ok(Some(RadicalMembership {
        power: power_of_core,
        exponents,
        cofactors: whole,
    }))
}

/// The first target that lies in the ideal, where the factors may be divided by; its cofactors may hold the
/// generators that stand for inverses.
fn first_member(
    targets: &[&Polynomial],
    polynomials: &[Polynomial],
    inverses: &[(Polynomial, Term)],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<(usize, Vec<Polynomial>)>> {
    let mut order = order.clone();
    order.cover(
        polynomials
            .iter()
            .chain(targets.iter().copied())
            .chain(inverses.iter().map(|(p, _)| p)),
    );
    order.push_block(&inverses.iter().map(|(_, inverse)| *inverse).collect::<Vec<_>>());
    let mut engine = Engine::new(polynomials, inverses, order)?;
    let mut targets: Vec<Target> = targets.iter().map(|p| engine.target(p)).collect::<Result<_>>()?;
    let Some(index) = engine.run(&mut targets, steps)? else {
        return Ok(None);
    };
    let cofactors = engine.cofactors(&targets[index], steps)?;
    Ok(cofactors.map(|cofactors| (index, cofactors)))
}

/// Cofactors of 1 in the ideal of the polynomials and the relations `inverse * factor - 1`.
fn adjoined(
    polynomials: &[Polynomial],
    inverses: &[(Polynomial, Term)],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Vec<Polynomial>>> {
    let mut all = polynomials.to_vec();
    let one = Polynomial::integer(1);
    for (factor, inverse) in inverses {
        all.push(times(factor, &Polynomial::generator(*inverse), steps)?.minus(&one));
    }
    let found = first_member(&[&one], &all, inverses, order, steps)?;
    Ok(found.map(|(_, mut cofactors)| {
        cofactors.truncate(polynomials.len());
        cofactors
    }))
}

/// A generator of its own for the inverse of each factor: numbers from the end, which no statement reaches.
fn with_inverses(factors: &[Polynomial]) -> Vec<(Polynomial, Term)> {
    factors
        .iter()
        .zip(0u32..)
        .map(|(factor, index)| (factor.clone(), Term(u32::MAX - index)))
        .collect()
}

/// Replaces the generators for inverses: all is multiplied by the least powers of the factors that clear them.
fn clear_inverses(
    cofactors: Vec<Polynomial>,
    inverses: &[(Polynomial, Term)],
    steps: &mut Steps,
) -> Result<(Vec<u32>, Vec<Polynomial>)> {
    let (mut exponents, mut cleared) = (Vec::with_capacity(inverses.len()), cofactors);
    for (factor, inverse) in inverses {
        let mut most = cleared
            .iter()
            .map(|cofactor| degree_in(cofactor, *inverse))
            .max()
            .unwrap_or(0);
        for cofactor in &mut cleared {
            // sum a_k / factor^k, times factor^most, by Horner's scheme
            let coefficients = coefficients_in(cofactor, *inverse);
            let (mut sum, missing) = (Polynomial::default(), most + 1 - coefficients.len().max(1) as u32);
            for coefficient in &coefficients {
                sum = times(&sum, factor, steps)?.plus(coefficient);
            }
            for _ in 0..missing {
                sum = times(&sum, factor, steps)?;
            }
            *cofactor = sum;
        }
        while most > 0 {
            let mut quotients = Vec::with_capacity(cleared.len());
            for cofactor in &cleared {
                match exact_quotient(cofactor, factor, steps)? {
                    Some(quotient) => quotients.push(quotient),
                    None => break,
                }
            }
            if quotients.len() < cleared.len() {
                break;
            }
            (cleared, most) = (quotients, most - 1);
        }
        exponents.push(most);
    }
    Ok((exponents, cleared))
}

#[cfg(test)]
mod tests {
    use super::super::groebner::groebner;
    use super::super::steps::Exhausted;
    use super::super::testing::{any_polynomial, generator, plenty, poly, polys, sum_of_products};
    use super::*;
    use proptest::prelude::*;

    fn power_of(p: &Polynomial, exponent: u32) -> Polynomial {
        power(p, exponent, &mut plenty()).unwrap()
    }

    fn letters(text: &str) -> Vec<Term> {
        text.chars().map(generator).collect()
    }

    fn proved(found: &RadicalMembership, p: &Polynomial, given: &[Polynomial], nonzero: &[Polynomial]) {
        let mut left = power(p, found.power, &mut plenty()).unwrap();
        for (factor, exponent) in nonzero.iter().zip(&found.exponents) {
            left = left.times(&power(factor, *exponent, &mut plenty()).unwrap());
        }
        assert_eq!(left, sum_of_products(&found.cofactors, given));
    }

    #[test]
    fn known_bases() {
        // Cox, Little, O'Shea, section 2.7, example 1 and section 2.8, example 2
        let given = polys(&["x^3 - 2x y", "x^2 y - 2y^2 + x"]);
        let basis = groebner(&given, &Order::graded(&letters("xy")), &mut plenty()).unwrap();
        assert_eq!(basis.elements(), polys(&["x^2", "2y^2 - x", "x y"]));
        for (index, element) in basis.elements().iter().enumerate() {
            assert_eq!(
                *element,
                sum_of_products(&basis.cofactors(index, &mut plenty()).unwrap(), &given)
            );
        }
        let sphere = polys(&["x^2 + y^2 + z^2 - 1", "x^2 + z^2 - y", "x - z"]);
        let basis = groebner(&sphere, &Order::lexicographic(&letters("xyz")), &mut plenty()).unwrap();
        let reduced = basis.normal_form(&poly("4z^4 + 2z^2"), &mut plenty()).unwrap();
        assert_eq!(reduced, poly("1"));
        assert_eq!(
            basis.normal_form(&poly("w x - w z + w"), &mut plenty()).unwrap(),
            poly("w")
        );
    }

    #[test]
    fn cyclic_and_katsura() {
        let cyclic = polys(&[
            "a + b + c + d",
            "a b + b c + c d + d a",
            "a b c + b c d + c d a + d a b",
            "a b c d - 1",
        ]);
        let basis = groebner(&cyclic, &Order::graded(&letters("abcd")), &mut plenty()).unwrap();
        assert_eq!(basis.elements().len(), 7);
        // a square that is in the ideal, of a polynomial that is not: (d + b)^2
        let p = poly("b + d");
        assert_eq!(
            member(&p, &cyclic, &Order::graded(&letters("abcd")), &mut plenty()),
            Ok(None)
        );
        let found = radical_member(&p, &cyclic, &[], &Order::graded(&letters("abcd")), &mut plenty())
            .unwrap()
            .unwrap();
        assert_eq!(found.power, 2);
        proved(&found, &p, &cyclic, &[]);
        let katsura = polys(&[
            "x + 2y + 2z + 2t - 1",
            "x^2 + 2y^2 + 2z^2 + 2t^2 - x",
            "2x y + 2y z + 2z t - y",
            "y^2 + 2x z + 2y t - z",
        ]);
        let basis = groebner(&katsura, &Order::graded(&letters("xyzt")), &mut plenty()).unwrap();
        assert_eq!(basis.elements().len(), 7);
        for (index, element) in basis.elements().iter().enumerate() {
            assert_eq!(
                *element,
                sum_of_products(&basis.cofactors(index, &mut plenty()).unwrap(), &katsura)
            );
        }
    }

    #[test]
    fn factors_that_are_not_zero() {
        let order = Order::default();
        let given = polys(&["a x - a y", "b y - b z"]);
        let nonzero = polys(&["a", "b"]);
        let p = poly("x - z");
        let found = radical_member(&p, &given, &nonzero, &order, &mut plenty())
            .unwrap()
            .unwrap();
        assert_eq!((found.power, found.exponents.as_slice()), (1, &[1, 1][..]));
        proved(&found, &p, &given, &nonzero);
        assert_eq!(
            radical_member(&p, &given, &polys(&["a"]), &order, &mut plenty()),
            Ok(None)
        );
        // x^3 = 0 and x y != 0
        let given = polys(&["x^3"]);
        let refuted = contradiction(&given, &polys(&["x y + x"]), &order, &mut plenty())
            .unwrap()
            .unwrap();
        let left = power(&poly("x y + x"), refuted.exponents[0], &mut plenty()).unwrap();
        assert_eq!(left, sum_of_products(&refuted.cofactors, &given));
        assert_eq!(contradiction(&given, &polys(&["y"]), &order, &mut plenty()), Ok(None));
        // the budget is kept
        assert_eq!(
            member(&p, &polys(&["x y - 1", "y^2 - x"]), &order, &mut Steps::new(3)),
            Err(Exhausted)
        );
    }

    #[test]
    fn a_chain_of_definitions_takes_few_steps() {
        // each of 20 generators is a quadratic polynomial of the next two
        let letters: Vec<char> = ('a'..='v').collect();
        let given: Vec<Polynomial> = (0..20)
            .map(|i| {
                let (x, y, z) = (letters[i], letters[i + 1], letters[i + 2]);
                poly(&if i % 8 == 0 {
                    format!("2{x} - {y} {z} + {z}")
                } else {
                    format!("3{x} - {y} + 2{z} - 1")
                })
            })
            .collect();
        let order = Order::triangular(&given);
        let p = poly("2a - b c + c")
            .times(&poly("f + g"))
            .plus(&poly("6e - 2f g + f + g - 1 + 2 g - 1 + 3"));
        let steps = &mut Steps::new(200_000);
        assert_eq!(member(&p, &given, &order, steps), Ok(None));
        let p = poly("a b").minus(&poly("1/2 (b c - c) b"));
        let cofactors = member(&p, &given, &order, steps).unwrap().unwrap();
        assert_eq!(p, sum_of_products(&cofactors, &given));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn members_are_found_and_proved(
            given in prop::collection::vec(any_polynomial(3, 3, 2), 2..=3),
            factors in prop::collection::vec(any_polynomial(3, 2, 1), 3),
            graded: bool,
        ) {
            let ranking = letters("abc");
            let order = if graded { Order::graded(&ranking) } else { Order::lexicographic(&ranking) };
            let p = sum_of_products(&given, &factors[..given.len()]);
            match member(&p, &given, &order, &mut Steps::new(3_000_000)) {
                Ok(Some(cofactors)) => prop_assert_eq!(&p, &sum_of_products(&cofactors, &given)),
                Ok(None) => prop_assert!(false, "a member is missed"),
                Err(Exhausted) => {}
            }
            let square = radical_member(&p, &given, &[], &order, &mut Steps::new(3_000_000));
            if let Ok(found) = square {
                proved(&found.unwrap(), &p, &given, &[]);
            }
        }

        #[test]
        fn inverses_are_cleared(
            given in any_polynomial(3, 3, 2),
            p in any_polynomial(3, 3, 1),
            factor in any_polynomial(3, 2, 1),
            cubed: bool,
        ) {
            let factor = factor.plus(&poly("d"));
            let power = if cubed { p.times(&p).times(&p) } else { p.clone() };
            let relations = vec![given.clone(), power.times(&factor)];
            let found = radical_member(&p, &relations, std::slice::from_ref(&factor), &Order::default(), &mut Steps::new(3_000_000));
            if let Ok(found) = found {
                proved(&found.unwrap(), &p, &relations, std::slice::from_ref(&factor));
            }
            let nonzero = [factor, p];
            if let Ok(found) = contradiction(&relations, &nonzero, &Order::default(), &mut Steps::new(3_000_000)) {
                let Refutation { exponents, cofactors } = found.unwrap();
                let left = nonzero.iter().zip(&exponents).fold(Polynomial::integer(1), |left, (factor, exponent)| {
                    left.times(&power_of(factor, *exponent))
                });
                prop_assert_eq!(left, sum_of_products(&cofactors, &relations));
            }
        }
    }
}
