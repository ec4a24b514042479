//! Definite integrals of known value: a table of rows with sources, `integrals.txt`. That an integrand is a multiple of that of
//! a row is a lemma, as are the conditions of the row.

use super::build::{plain, symbol};
use std::sync::OnceLock;
use texmath::{Condition, Equation, Name, Names, Tree, read_conditions, read_expression, rewrite, rewrite_equation};

/// The table as text.
const TABLE: &str = include_str!("integrals.txt");

/// A row of the table: the integral of `of` by x between the limits, for the letters a and b under the conditions.
#[derive(Debug)]
pub struct KnownIntegral {
    pub limits: [Tree; 2],
    pub of: Tree,
    pub value: Tree,
    conditions: Vec<Equation>,
}

/// An integral as a multiple of a row of the table at values of its letters.
#[derive(Clone, Debug)]
pub struct Matched {
    pub row: &'static KnownIntegral,
    pub factor: Tree,
    /// The values of a and b.
    pub letters: [Tree; 2],
}

/// Returns the rows of the table.
pub fn known_integrals() -> &'static [KnownIntegral] {
    static ROWS: OnceLock<Vec<KnownIntegral>> = OnceLock::new();
    let lines = || TABLE.lines().filter(|line| !line.starts_with('#'));
    ROWS.get_or_init(|| lines().filter_map(KnownIntegral::read).collect())
}

impl KnownIntegral {
    fn read(line: &str) -> Option<Self> {
        let names = Names::default();
        let parts: Vec<&str> = line.split('|').map(str::trim).collect();
        let [limits, of, value, conditions, _] = parts.as_slice() else {
            return None;
        };
        let (low, high) = limits.split_once(" to ")?;
        let tree = |tex: &str| read_expression(tex, &names).ok();
        let high = match high {
            r"\infty" => Tree::Operation(Box::new(texmath::Operation::Infinity), texmath::At::default()),
            high => tree(high)?,
        };
        let conditions = match *conditions {
            "" => Vec::new(),
            conditions => read_conditions(conditions, &names).ok()?,
        };
        let relation = |condition| match condition {
            Condition::Relation(relation) => Some(relation),
            Condition::Integer(_) => None,
        };
        let conditions = conditions.into_iter().map(relation).collect::<Option<_>>()?;
        Some(Self {
            limits: [tree(low)?, high],
            of: tree(of)?,
            value: tree(value)?,
            conditions,
        })
    }

    /// Returns true if the integrand has a letter.
    pub fn speaks_of(&self, letter: &str) -> bool {
        self.of.has_free(&plain(letter))
    }
}

impl Matched {
    fn with<'n>(&self, x: Option<&'n Name>) -> impl Fn(&Name) -> Option<Tree> + use<'n> {
        let [a, b] = self.letters.clone();
        move |name| match name.base.as_str() {
            _ if *name != plain(&name.base) => None,
            "x" => x.map(symbol),
            "a" => Some(a.clone()),
            "b" => Some(b.clone()),
            _ => None,
        }
    }

    /// Returns the integrand of the row in a letter.
    pub fn integrand(&self, x: &Name) -> Tree {
        rewrite(&self.row.of, &self.with(Some(x)))
    }

    pub(super) fn value(&self) -> Tree {
        rewrite(&self.row.value, &self.with(None))
    }

    pub(super) fn conditions(&self) -> Vec<Equation> {
        let with = self.with(None);
        let conditions = self.row.conditions.iter();
        conditions.map(|own| rewrite_equation(own, &with)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_row_is_read_and_names_its_letters() {
        let lines = TABLE.lines().filter(|line| !line.starts_with('#'));
        for line in lines {
            let row = KnownIntegral::read(line).unwrap_or_else(|| panic!("{line}"));
            for letter in ["a", "b"] {
                let in_value = row.value.has_free(&plain(letter));
                assert!(!in_value || row.speaks_of(letter), "{line}");
            }
            assert!(row.speaks_of("x"));
        }
    }
}
