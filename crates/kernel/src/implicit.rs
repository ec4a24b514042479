//! Determinants of quantities that are given implicitly.

use super::statement::{Implicit, Statement};
use super::term::Term;

/// The determinant of the slopes of the determining terms by the implicit quantities: where it is not 0, these have
/// derivatives (implicit function theorem).
pub fn slope_determinant(statement: &mut Statement, implicit: &Implicit) -> Term {
    let equations = implicit.equations.iter();
    let matrix = equations.map(|(_, term)| {
        let row = implicit.of.iter().map(|&of| statement.derivative(*term, of));
        row.collect()
    });
    let matrix: Vec<Vec<Term>> = matrix.collect();
    determinant(statement, &matrix)
}

/// The determinant of a square matrix, by its first row.
pub fn determinant(statement: &mut Statement, matrix: &[Vec<Term>]) -> Term {
    let Some((first, rest)) = matrix.split_first() else {
        return statement.terms.integer(1);
    };
    let mut sum = Vec::new();
    for (column, entry) in first.iter().enumerate() {
        let without = |row: &Vec<Term>| {
            row.iter()
                .enumerate()
                .filter(|(n, _)| *n != column)
                .map(|(_, t)| *t)
                .collect()
        };
        let minor: Vec<Vec<Term>> = rest.iter().map(without).collect();
        let minor = determinant(statement, &minor);
        let product = statement.terms.product(vec![*entry, minor]);
        sum.push(match column % 2 {
            0 => product,
            _ => statement.terms.negative(product),
        });
    }
    statement.terms.sum(sum)
}
