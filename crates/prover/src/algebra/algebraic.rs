//! Algebraic numbers: the quotient of a polynomial ring by triangular relations, each of which gives a power of its
//! own generator by lower powers and other generators: `r^2 - 5`, `c^3 - c^2 - 2c + 1`.

use super::division::{coefficients_in, degree_in, divide, is_constant, shifted, times};
use super::linear::{Echelon, integral_row};
use super::order::Order;
use super::steps::{Result, Steps};
use dashu_int::IBig;
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term};
use numbers::Rational;
use std::collections::BTreeMap;

/// A polynomial ring modulo triangular relations.
#[derive(Clone, Debug)]
pub struct QuotientAlgebra {
    relations: Vec<Polynomial>,
    order: Order,
    /// Its dimension over the generators that no relation binds.
    dimension: usize,
}

/// A relation of one element: `sum coefficients[k] p^k = sum cofactors[i] * relations[i]`, of least degree, the last
/// coefficient 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MinimalPolynomial {
    pub coefficients: Vec<Rational>,
    pub cofactors: Vec<Polynomial>,
}

/// The largest dimension in which minimal polynomials are looked for: the matrix has twice its square of entries.
const LARGEST: usize = 1000;

impl MinimalPolynomial {
    /// How often it can be divided by its unknown: `p^multiplicity * (a polynomial in p whose constant is not 0)`.
    pub fn multiplicity_of_zero(&self) -> usize {
        self.coefficients.iter().take_while(|value| value.0.is_zero()).count()
    }
}

impl QuotientAlgebra {
    /// The quotient by relations, each with its own generator; `None` where one has a leading coefficient that is not
    /// a number, two have the same generator, or generators depend on each other in a circle.
    pub fn new(relations: &[(Term, Polynomial)]) -> Option<Self> {
        let degrees: BTreeMap<Term, u32> = relations.iter().map(|(own, p)| (*own, degree_in(p, *own))).collect();
        let monic = |(own, p): &(Term, Polynomial)| {
            degree_in(p, *own) > 0 && coefficients_in(p, *own).last().is_some_and(is_constant)
        };
        if degrees.len() < relations.len() || !relations.iter().all(monic) {
            return None;
        }
        // a generator goes before all others that its relation holds
        let mut ranking: Vec<Term> = Vec::new();
        let mut open: Vec<&(Term, Polynomial)> = relations.iter().collect();
        while !open.is_empty() {
            let free = |own: Term| !open.iter().any(|(other, p)| *other != own && degree_in(p, own) > 0);
            let next = open.iter().position(|(own, _)| free(*own))?;
            ranking.push(open.remove(next).0);
        }
        Some(Self {
            relations: relations.iter().map(|(_, p)| p.clone()).collect(),
            order: Order::lexicographic(&ranking),
            dimension: degrees.values().map(|degree| *degree as usize).product(),
        })
    }

    /// The normal form and cofactors: `p = normal form + sum cofactors[i] * relations[i]`, where each generator has a
    /// degree below that of its relation.
    pub fn normal_form(&self, p: &Polynomial, steps: &mut Steps) -> Result<(Polynomial, Vec<Polynomial>)> {
        let (cofactors, remainder) = divide(p, &self.relations, &self.order, steps)?;
        Ok((remainder, cofactors))
    }

    /// The minimal polynomial of an element over the rationals; `None` where it holds a generator that no relation
    /// binds, or where the dimension is beyond 1000.
    pub fn minimal_polynomial(&self, p: &Polynomial, steps: &mut Steps) -> Result<Option<MinimalPolynomial>> {
        if self.dimension > LARGEST {
            return Ok(None);
        }
        let (base, base_cofactors) = self.normal_form(p, steps)?;
        let bound = |term: &Term| self.order.generators().contains(term);
        if !base.generators().iter().chain(&self.parameters()).all(bound) {
            return Ok(None);
        }
        // p^k = powers[k].0 + sum powers[k].1[i] * relations[i]
        let zero = vec![Polynomial::default(); self.relations.len()];
        let mut powers = vec![(Polynomial::integer(1), zero)];
        let mut columns: BTreeMap<Monomial, usize> = BTreeMap::new();
        let mut echelon = Echelon::new(self.dimension);
        while let Some((last, cofactors)) = powers.last() {
            // behind the coordinates of a power stands which power it is, so that a relation shows there
            let mut row = vec![RBig::ZERO; 2 * self.dimension + 1];
            for (monomial, value) in last.terms() {
                let next = columns.len();
                let column = *columns.entry(monomial.clone()).or_insert(next);
                row[column] = value.clone();
            }
            let count = powers.len();
            row[self.dimension + count - 1] = RBig::ONE;
            if let Some(relation) = echelon.insert(integral_row(&row), steps)? {
                return self.relation(&relation[..count], &powers, steps).map(Some);
            }
            // p^(k+1) = base p^k + sum base_cofactors[i] p^k relations[i], and base last is reduced
            let (next, mut sums) = self.normal_form(&times(&base, last, steps)?, steps)?;
            for (index, sum) in sums.iter_mut().enumerate() {
                let first = times(p, &cofactors[index], steps)?;
                let second = times(&base_cofactors[index], last, steps)?;
                *sum = sum.plus(&first).plus(&second);
            }
            powers.push((next, sums));
        }
        Ok(None)
    }

    fn relation(
        &self,
        relation: &[IBig],
        powers: &[(Polynomial, Vec<Polynomial>)],
        steps: &mut Steps,
    ) -> Result<MinimalPolynomial> {
        let lead = relation.last().cloned().unwrap_or(IBig::ONE);
        let coefficients: Vec<Rational> = relation
            .iter()
            .map(|value| Rational(RBig::from(value.clone()) / &lead))
            .collect();
        let mut cofactors = vec![Polynomial::default(); self.relations.len()];
        for (value, (_, parts)) in coefficients.iter().zip(powers) {
            for (sum, part) in cofactors.iter_mut().zip(parts) {
                steps.take(part.terms().len() as u64)?;
                *sum = sum.plus(&part.scaled(value));
            }
        }
        Ok(MinimalPolynomial {
            coefficients,
            cofactors,
        })
    }

    /// The inverse and cofactors: `p * inverse = 1 + sum cofactors[i] * relations[i]`. `None` where p is a divisor of
    /// 0 or holds a generator that no relation binds.
    pub fn inverse(&self, p: &Polynomial, steps: &mut Steps) -> Result<Option<(Polynomial, Vec<Polynomial>)>> {
        let Some(minimal) = self.minimal_polynomial(p, steps)? else {
            return Ok(None);
        };
        let Some((constant, others)) = minimal.coefficients.split_first() else {
            return Ok(None);
        };
        if constant.0.is_zero() {
            return Ok(None);
        }
        // p (a_1 + a_2 p + ..) = -a_0 modulo the relations
        let mut sum = Polynomial::default();
        for coefficient in others.iter().rev() {
            let raised = times(&sum, p, steps)?.plus(&Polynomial::constant(coefficient));
            sum = self.normal_form(&raised, steps)?.0;
        }
        let inverse = shifted(&sum, &Monomial::new(), &(RBig::NEG_ONE / &constant.0));
        let (_, cofactors) = self.normal_form(&times(p, &inverse, steps)?, steps)?;
        Ok(Some((inverse, cofactors)))
    }

    /// The generators that relations hold but none binds.
    fn parameters(&self) -> Vec<Term> {
        let held = self.relations.iter().flat_map(Polynomial::generators);
        held.filter(|term| !self.order.generators().contains(term)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, generator, plenty, poly, polys, sum_of_products};
    use super::*;
    use proptest::prelude::*;

    fn value(coefficients: &[Rational], p: &Polynomial) -> Polynomial {
        let horner = |sum: Polynomial, c: &Rational| sum.times(p).plus(&Polynomial::constant(c));
        coefficients.iter().rev().fold(Polynomial::default(), horner)
    }

    fn integers(list: &[i64]) -> Vec<Rational> {
        list.iter().map(|&n| Rational::new(n, 1).unwrap()).collect()
    }

    #[test]
    fn known_minimal_polynomials() {
        // c = 2 cos(pi/7); Watkins, Zeitlin, The minimal polynomial of cos(2 pi/n), Amer. Math. Monthly 100 (1993)
        let relations = polys(&["c^3 - c^2 - 2c + 1"]);
        let field = QuotientAlgebra::new(&[(generator('c'), relations[0].clone())]).unwrap();
        for (p, minimal) in [
            ("c^2 - 2", &[-1, -2, 1, 1][..]),
            ("c", &[1, -2, -1, 1]),
            ("c^3 - c^2 - 2c", &[1, 1]),
        ] {
            let found = field.minimal_polynomial(&poly(p), &mut plenty()).unwrap().unwrap();
            assert_eq!(found.coefficients, integers(minimal));
            assert_eq!(
                value(&found.coefficients, &poly(p)),
                sum_of_products(&found.cofactors, &relations)
            );
        }
        let relations = polys(&["2r^2 - 4", "s^2 - 3 - r"]);
        let field = QuotientAlgebra::new(&[
            (generator('r'), relations[0].clone()),
            (generator('s'), relations[1].clone()),
        ]);
        let field = field.unwrap();
        let found = field.minimal_polynomial(&poly("s"), &mut plenty()).unwrap().unwrap();
        assert_eq!(found.coefficients, integers(&[7, 0, -6, 0, 1]));
        let (inverse, cofactors) = field.inverse(&poly("r + s"), &mut plenty()).unwrap().unwrap();
        let one = sum_of_products(&cofactors, &relations).plus(&poly("1"));
        assert_eq!(poly("r + s").times(&inverse), one);
        // a nilpotent element
        let algebra = QuotientAlgebra::new(&[(generator('e'), poly("e^3"))]).unwrap();
        let found = algebra.minimal_polynomial(&poly("2e"), &mut plenty()).unwrap().unwrap();
        assert_eq!(found.multiplicity_of_zero(), 3);
        assert_eq!(algebra.inverse(&poly("e"), &mut plenty()), Ok(None));
        assert_eq!(algebra.minimal_polynomial(&poly("x e"), &mut plenty()), Ok(None));
        assert!(QuotientAlgebra::new(&[(generator('r'), poly("r - s")), (generator('s'), poly("s - r"))]).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn relations_multiply_out(p in any_polynomial(3, 4, 2)) {
            let relations = polys(&["a^2 - 5", "3b^2 - a b + 1", "c^3 - b"]);
            let owned: Vec<(Term, Polynomial)> = "abc".chars().map(generator).zip(relations.iter().cloned()).collect();
            let algebra = QuotientAlgebra::new(&owned).unwrap();
            let found = algebra.minimal_polynomial(&p, &mut plenty()).unwrap().unwrap();
            prop_assert_eq!(value(&found.coefficients, &p), sum_of_products(&found.cofactors, &relations));
            if let Some((inverse, cofactors)) = algebra.inverse(&p, &mut plenty()).unwrap() {
                let one = sum_of_products(&cofactors, &relations).plus(&poly("1"));
                prop_assert_eq!(p.times(&inverse), one);
            }
        }
    }
}
