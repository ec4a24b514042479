//! Multiples of exponentials of polynomials.

use super::build::{integer, is_zero, negative, plain, product, quotient, sum};
use super::derivative::mentions;
use texmath::{Name, Symbols, Tree};

/// The most coefficients of a polynomial.
const MOST: usize = 24;

/// A factor and the coefficients, from the constant on, of the polynomial in the exponent of a multiple of an exponential.
pub(super) fn exponential(of: &Tree, by: &Name, symbols: &Symbols) -> Option<(Tree, Vec<Tree>)> {
    let search = Search { by };
    match of {
        Tree::Negate(inner) => {
            let (factor, coefficients) = exponential(inner, by, symbols)?;
            Some((negative(factor), coefficients))
        }
        Tree::Quotient(above, below, _) if !mentions(below, by) => {
            let (factor, coefficients) = exponential(above, by, symbols)?;
            Some((quotient(factor, (**below).clone()), coefficients))
        }
        Tree::Product(factors) => {
            let (mut rest, mut free): (Vec<Tree>, Vec<Tree>) =
                factors.iter().cloned().partition(|factor| mentions(factor, by));
            let single = rest.pop().filter(|_| rest.is_empty())?;
            let (factor, coefficients) = exponential(&single, by, symbols)?;
            free.push(factor);
            Some((product(free), coefficients))
        }
        tree => Some((integer(1), search.polynomial(exponent_of_e(tree, symbols)?)?)),
    }
}

/// The exponent of a power of e.
pub(super) fn exponent_of_e<'t>(tree: &'t Tree, symbols: &Symbols) -> Option<&'t Tree> {
    let euler = plain("e");
    match tree {
        Tree::RealPower(base, exponent, _) => {
            let is_euler = matches!(&**base, Tree::Symbol(name, _) if *name == euler);
            (is_euler && !symbols.declares(&euler)).then_some(&**exponent)
        }
        // e^2 and the like are read as integer powers
        Tree::Call(name, argument, _) if name.base == "\\exp" => Some(&**argument),
        _ => None,
    }
}

/// The coefficients of a polynomial in a letter, from the constant on.
pub(super) fn polynomial(tree: &Tree, by: &Name) -> Option<Vec<Tree>> {
    Search { by }.polynomial(tree)
}

struct Search<'a> {
    by: &'a Name,
}

impl Search<'_> {
    /// The coefficients of a polynomial, from the constant on, the last one not written as 0.
    fn polynomial(&self, tree: &Tree) -> Option<Vec<Tree>> {
        let mut coefficients = match tree {
            tree if !mentions(tree, self.by) => vec![tree.clone()],
            Tree::Symbol(..) => vec![integer(0), integer(1)],
            Tree::Negate(inner) => self.polynomial(inner)?.into_iter().map(negative).collect(),
            Tree::Sum(terms) => {
                let mut total: Vec<Vec<Tree>> = Vec::new();
                for term in terms {
                    for (degree, coefficient) in self.polynomial(term)?.into_iter().enumerate() {
                        if total.len() <= degree {
                            total.resize(degree + 1, Vec::new());
                        }
                        if let Some(sum) = total.get_mut(degree) {
                            sum.push(coefficient);
                        }
                    }
                }
                total.into_iter().map(sum).collect()
            }
            Tree::Product(factors) => {
                let mut total = vec![integer(1)];
                for factor in factors {
                    total = times(&total, &self.polynomial(factor)?)?;
                }
                total
            }
            Tree::Quotient(above, below, _) if !mentions(below, self.by) => {
                let above = self.polynomial(above)?.into_iter();
                above
                    .map(|coefficient| quotient(coefficient, (**below).clone()))
                    .collect()
            }
            Tree::Power(base, exponent, _) if (0..=12).contains(exponent) => {
                let base = self.polynomial(base)?;
                let mut total = vec![integer(1)];
                for _ in 0..*exponent {
                    total = times(&total, &base)?;
                }
                total
            }
            _ => return None,
        };
        while coefficients.len() > 1 && coefficients.last().is_some_and(is_zero) {
            coefficients.pop();
        }
        Some(coefficients)
    }
}

fn times(left: &[Tree], right: &[Tree]) -> Option<Vec<Tree>> {
    let length = (left.len() + right.len()).saturating_sub(1);
    if length > MOST {
        return None;
    }
    let mut total: Vec<Vec<Tree>> = vec![Vec::new(); length];
    for (one, left) in left.iter().enumerate() {
        for (other, right) in right.iter().enumerate() {
            if let Some(terms) = total.get_mut(one + other) {
                terms.push(product(vec![left.clone(), right.clone()]));
            }
        }
    }
    Some(total.into_iter().map(sum).collect())
}
