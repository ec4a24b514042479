//! Counterexamples where a square root is not rational: the sides are compared as numbers `a + b \\sqrt{n} + ...`.

use super::atom::Atom;
use super::counterexample::{Counterexample, show};
use super::point::{Point, partial_point};
use super::problem::Problem;
use super::proof::{Knowledge, Question};
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::number::Rational;
use crate::tex::Equation;
use num_traits::Zero;

/// Points tried: each does where the sides differ, but for denominators that vanish.
const MOST_POINTS: u64 = 12;

/// Sides of real roots count as different from here on: far above the rounding of f64, far below what a misprint does.
const DIFFERENCE: f64 = 1e-9;

/// Searches for a point where the sides differ, all symbols rational and the roots not.
pub fn search(problem: &mut Problem, equation: &Equation, question: &Question) -> Option<Counterexample> {
    (0..MOST_POINTS).find_map(|seed| {
        let (point, _) = partial_point(problem, seed);
        let mut squares: Vec<(Variable, Fraction)> = Vec::new();
        for (root, square) in &problem.squares {
            if point.0.contains_key(root) {
                continue;
            }
            // A root within a root has no rational square.
            squares.push((*root, Fraction::from(&point.value(square)?)));
        }
        let knowledge = Knowledge {
            squares: squares.clone(),
            ..Knowledge::default()
        };
        let residuals: Option<Vec<Fraction>> = question
            .residuals()
            .iter()
            .map(|residual| inserted(residual, &point, &squares))
            .collect();
        let wrong = |residual: &Fraction| !knowledge.vanishes(residual.numerator()) && differ(residual, &squares);
        if !residuals?.iter().any(wrong) {
            return None;
        }
        let text = |problem: &mut Problem, side: &Fraction| {
            inserted(side, &point, &squares).map(|side| shown(problem, &side, &squares))
        };
        let (left, right) = match question {
            Question::Equal { left, right } => (text(problem, left)?, text(problem, right)?),
            Question::OneOf { left, right: [a, b] } => (
                text(problem, left)?,
                format!("{{{}, {}}}", text(problem, a)?, text(problem, b)?),
            ),
            Question::Roots {
                polynomial: [c, b, a],
                right: [x, y],
            } => {
                let (sum, product) = (-b.clone() / a.clone(), c.clone() / a.clone());
                let (sum, product) = (text(problem, &sum)?, text(problem, &product)?);
                let left = format!("two numbers of sum {sum} and product {product}");
                (left, format!("{{{}, {}}}", text(problem, x)?, text(problem, y)?))
            }
        };
        Some(show(problem, equation, &point, left, right))
    })
}

/// The side with all rational values put in; `None` where a symbol other than a root is left.
fn inserted(side: &Fraction, point: &Point, squares: &[(Variable, Fraction)]) -> Option<Fraction> {
    let mut result = side.clone();
    for variable in side.variables() {
        match point.0.get(&variable) {
            Some(value) => result = result.substituted(variable, &Fraction::from(value)).ok()?,
            None if squares.iter().any(|(root, _)| *root == variable) => {}
            None => return None,
        }
    }
    Some(result)
}

/// Whether a combination of roots that is not formally zero is not zero as a number: of one root it never is; of
/// several, which may depend on each other, it is computed.
fn differ(residual: &Fraction, squares: &[(Variable, Fraction)]) -> bool {
    let float = |value: &Rational| value.0.to_f64().value();
    let used: Vec<&(Variable, Fraction)> = squares.iter().filter(|(root, _)| residual.contains(*root)).collect();
    if used.len() < 2 {
        return true;
    }
    let root = |variable: Variable| {
        let (_, square) = used.iter().find(|(known, _)| *known == variable)?;
        let square = float(&square.as_constant()?);
        (square >= 0.0).then(|| square.sqrt())
    };
    let value = |polynomial: &Polynomial| -> Option<(f64, f64)> {
        polynomial
            .terms()
            .iter()
            .try_fold((0.0, 0.0), |(sum, size), (monomial, coefficient)| {
                let powers = monomial
                    .factors()
                    .iter()
                    .try_fold(1.0, |p, (v, e)| Some(p * root(*v)?.powi(*e as i32)));
                let term = coefficient.to_f64().value() * powers?;
                Some((sum + term, size + f64::abs(term)))
            })
    };
    value(residual.numerator()).is_some_and(|(sum, size)| sum.abs() > DIFFERENCE * size)
}

/// A side as text, each root as the root of a number.
fn shown(problem: &mut Problem, side: &Fraction, squares: &[(Variable, Fraction)]) -> String {
    let mut result = side.clone();
    for (root, square) in squares {
        let number = problem.atoms.variable(Atom::Root {
            radicand: square.clone(),
        });
        result = result.substituted(*root, &Fraction::variable(number)).unwrap_or(result);
    }
    if result.is_zero() {
        "0".to_string()
    } else {
        problem.atoms.show_fraction(&result)
    }
}
