//! What a reader must be told of a formula's vocabulary.

use super::nodes::any;
use super::{Name, Tree};
use std::collections::BTreeSet;

/// The names that are read in a special way. All else is a symbol of one letter, and a bracket after it a factor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Names that a bracket turns into a call, without mark and primes: `F_1`, `\dot{Z}`. They must match with
    /// accents and subscript: with `\dot{Z}` here, `\dot{Z}(t)` is a call and `\dot{Z}_k(t)` a product.
    pub functions: Vec<Name>,
    /// Names of functions that a definition gives, with their dots where they are of time: a bracket turns these into a
    /// call too.
    pub defined: Vec<Name>,
    /// Those of them that have several arguments.
    pub several: Vec<Name>,
    /// Names of several letters that are one symbol where the letters stand in a run: `eta`.
    pub words: Vec<String>,
    /// Matrices whose trace and determinant may be written: `DP`.
    pub matrices: Vec<Name>,
    /// The declared names of one letter: where `d` or `T` is among them, it is no differential and no transpose.
    pub letters: Vec<String>,
    /// The symbols that are complex.
    pub complex: Vec<Name>,
    /// The symbol that functions without an argument are taken at.
    pub running: Option<Name>,
    /// The exceptions where a term that is not understood is a symbol; none where it is an error.
    pub opaque: Option<Opaque>,
}

/// The letters before brackets that are read where a term that is not understood is a symbol: `\mathbb{E}[x]`, `p(x | y)`, and a letter before brackets that
/// may hold its argument.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Opaque {
    /// Letters that are factors before brackets.
    pub factors: BTreeSet<String>,
    /// Functions whose arguments stand in them, as they print.
    pub functions: BTreeSet<String>,
    /// Letters that have a value, as they print: derivatives of all others are terms that are not understood.
    pub values: BTreeSet<String>,
    /// Whether `A^T` is a transpose, as `T` stands nowhere else.
    pub transposes: bool,
}

/// Commands of letters in bold.
pub const BOLD: [&str; 3] = [r"\mathbf", r"\bm", r"\boldsymbol"];

impl Names {
    /// Whether `name`, whatever its mark and primes, was declared a function.
    pub fn is_function(&self, name: &Name) -> bool {
        self.is_defined(name) || self.functions.iter().any(|function| is_same_function(function, name))
    }

    /// Returns true if a definition gives a function of this name, whatever its mark and primes.
    pub fn is_defined(&self, name: &Name) -> bool {
        self.defined.iter().any(|function| is_same_function(function, name))
    }

    /// Returns the first function of several arguments in a tree.
    pub(super) fn several_in(&self, tree: &Tree) -> Option<Name> {
        let mut found = None;
        any(tree, &mut |node| {
            if let Tree::Symbol(name, _) | Tree::Call(name, ..) | Tree::Partial { of: name, .. } = node
                && self.several.iter().any(|own| is_same_function(own, name))
            {
                found = Some(name.clone());
            }
            found.is_some()
        });
        found
    }

    /// Returns true if a function stands without an argument in sums, products and quotients of a tree.
    pub(super) fn has_bare_function(&self, tree: &Tree) -> bool {
        self.has_bare(tree, &|_| true)
    }

    /// Returns true if a function of the same letter, perhaps with other dots or primes, stands so.
    pub(super) fn has_bare_derivative_of(&self, name: &Name, tree: &Tree) -> bool {
        self.has_bare(tree, &|other| {
            other.base == name.base && other.subscript == name.subscript
        })
    }

    fn has_bare(&self, tree: &Tree, test: &dyn Fn(&Name) -> bool) -> bool {
        let has = |tree: &Tree| self.has_bare(tree, test);
        match tree {
            Tree::Symbol(name, _) => self.is_function(name) && test(name),
            Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(has),
            Tree::Quotient(above, below, _) => has(above) || has(below),
            Tree::Negate(body) | Tree::Power(body, ..) | Tree::Root(body, ..) => has(body),
            Tree::RealPower(base, exponent, _) => has(base) || has(exponent),
            Tree::Call(name, body, _) => !self.is_function(name) && has(body),
            Tree::Operation(operation, _) => operation.parts().iter().any(|(part, _)| has(part)),
            _ => false,
        }
    }

    /// The longest declared word that `run` starts with.
    pub(super) fn word_at_start(&self, run: &str) -> Option<&str> {
        let fits = self
            .words
            .iter()
            .filter(|word| !word.is_empty() && run.starts_with(word.as_str()));
        fits.max_by_key(|word| word.len()).map(String::as_str)
    }
}

fn is_same_function(one: &Name, other: &Name) -> bool {
    one.base == other.base && one.accents == other.accents && one.subscript == other.subscript
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longest_word_wins() {
        let names = Names {
            words: vec!["et".into(), "eta".into(), String::new()],
            ..Names::default()
        };
        assert_eq!(names.word_at_start("etab"), Some("eta"));
        assert_eq!(names.word_at_start("e"), None);
    }
}
