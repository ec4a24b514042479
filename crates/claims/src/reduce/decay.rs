//! What vanishes faster than each power of what is small: exponentials that decay, times what grows like a power at most.

use super::build::plain;
use super::derivative::mentions;
use super::evaluate::may_be_undefined;
use super::series::{Small, is_likely_zero, is_zero, relation};
use numbers::{Field, Rational};
use texmath::{Elementary, Relation, Tree, any, number_of};

impl Small<'_> {
    /// Whether a tree is o(h^n) for every n: its series is 0 then, as far as any is followed.
    pub(super) fn vanishes_fast(&mut self, tree: &Tree) -> bool {
        if !any(tree, &mut |node| self.exponent(node).is_some()) {
            return false;
        }
        let (needed, written) = (self.needed.len(), self.written.len());
        let vanishes = self.is_flat(tree);
        if !vanishes {
            self.needed.truncate(needed);
            self.written.truncate(written);
        }
        vanishes
    }

    /// The exponent of a power of e which moves.
    fn exponent<'t>(&self, tree: &'t Tree) -> Option<&'t Tree> {
        let exponent = match tree {
            Tree::RealPower(base, exponent, _) => {
                let euler = plain("e");
                let is_euler = matches!(&**base, Tree::Symbol(name, _) if *name == euler);
                (is_euler && !self.symbols.declares(&euler)).then_some(&**exponent)
            }
            Tree::Call(name, exponent, _) if name.base == "\\exp" => Some(&**exponent),
            _ => None,
        };
        exponent.filter(|exponent| mentions(exponent, self.name))
    }

    fn is_flat(&mut self, tree: &Tree) -> bool {
        if !mentions(tree, self.name) {
            return false;
        }
        if let Some(exponent) = self.exponent(tree) {
            return self.falls_without_bound(exponent);
        }
        match tree {
            Tree::Negate(inner) | Tree::Power(inner, 1.., _) => self.is_flat(inner),
            Tree::Sum(terms) => terms.iter().all(|term| self.is_flat(term)),
            Tree::Product(factors) => {
                let mut is_any = false;
                factors.iter().all(|factor| {
                    let is_flat = self.is_flat(factor);
                    is_any |= is_flat;
                    is_flat || self.is_moderate(factor)
                }) && is_any
            }
            Tree::Quotient(above, below, _) => self.is_divisor(below) && self.is_flat(above),
            _ => false,
        }
    }

    /// Whether an exponent tends to minus infinity like a power of 1/h, which the sign of its first term says.
    fn falls_without_bound(&mut self, exponent: &Tree) -> bool {
        let Ok(series) = self.of(exponent) else {
            return false;
        };
        let Some(place) = series.terms.iter().position(|term| !is_zero(term)) else {
            return false;
        };
        let Some(first) = series.terms.get(place).cloned() else {
            return false;
        };
        let degree = i32::try_from(place).map_or(0, |place| series.low.saturating_add(place));
        let has_sign = self.is_positive || degree % 2 == 0;
        if number_of(&first).is_some_and(|rate| rate >= Rational::from_integer(0)) {
            return false;
        }
        if degree >= 0 || !has_sign || is_likely_zero(&first) || self.symbols.may_be_complex(&first) {
            return false;
        }
        self.need(relation(first, Relation::Less));
        true
    }

    /// Whether a tree has a value where h is small, and is of the order of some power of 1/h there.
    fn is_moderate(&mut self, tree: &Tree) -> bool {
        if !mentions(tree, self.name) {
            if may_be_undefined(tree) && !self.written.contains(tree) {
                self.written.push(tree.clone());
            }
            return true;
        }
        match tree {
            Tree::Negate(inner) | Tree::Power(inner, 0.., _) => self.is_moderate(inner),
            Tree::Sum(parts) | Tree::Product(parts) => parts.iter().all(|part| self.is_moderate(part)),
            Tree::Quotient(above, below, _) => self.is_divisor(below) && self.is_moderate(above),
            // bounded, wherever their argument has a value
            Tree::Call(name, argument, _)
                if Elementary::named(name).is_some_and(|function| function.is_bounded() && function.is_total()) =>
            {
                !self.symbols.speaks_of_complex(argument) && self.is_moderate(argument)
            }
            tree => self.is_flat(tree) || self.of(tree).is_ok(),
        }
    }

    /// Whether a tree does not move; that it is not 0 is needed then.
    fn is_divisor(&mut self, below: &Tree) -> bool {
        if mentions(below, self.name) || is_likely_zero(below) || !self.is_moderate(below) {
            return false;
        }
        self.need(relation(below.clone(), Relation::NotEqual));
        true
    }
}
