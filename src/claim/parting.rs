//! Where a refuted formula parts from the right one: the one term which, changed by a simple factor, mends it.

use super::problem::Problem;
use super::proof::{Question, ask, vanishes};
use super::sheet::Entry;
use super::substitute::nodes;
use crate::algebra::{Fraction, Polynomial};
use crate::number::{Field, Rational};
use crate::tex::{Equation, Tree};
use num_traits::{One, Zero};

/// Nodes of an equation that is searched; a longer one costs more time than the hint is worth.
const MOST_NODES: usize = 60;

/// What mends the right side, in words; `None` where no single term does.
pub fn parting(problem: &mut Problem, entry: &Entry, equation: &Equation) -> Option<String> {
    if nodes(equation) > MOST_NODES {
        return None;
    }
    let Some(Question::Equal { left, right }) = ask(problem, entry, equation).ok()? else {
        return None;
    };
    let missing = left.clone() - right.clone();
    if missing.numerator().is_too_large() {
        return None;
    }
    // Best of all a term to strike or to turn; then one to add; then one with a factor, the shorter the better.
    let mut best: Option<(usize, String)> = missing_term(problem, &missing).map(|said| (1, said));
    for (term, without) in terms(&equation.right) {
        let without = Equation {
            right: without,
            ..equation.clone()
        };
        let Ok(Some(Question::Equal { right: rest, .. })) = ask(problem, entry, &without) else {
            continue;
        };
        let share = right.clone() - rest;
        if vanishes(problem, share.numerator()) {
            continue;
        }
        let factor = Fraction::one() + missing.clone() / share;
        let Some(shown) = simple(problem, &factor) else {
            continue;
        };
        let (size, said) = match factor.as_constant() {
            Some(zero) if zero.is_zero() => (0, format!("the term `{term}` does not belong there")),
            Some(minus) if minus == -Rational::from_integer(1) => (0, format!("the term `{term}` has the wrong sign")),
            _ => (1 + shown.len(), format!("the term `{term}` lacks a factor `{shown}`")),
        };
        if best.as_ref().is_none_or(|(least, _)| size < *least) {
            best = Some((size, said));
        }
    }
    best.map(|(_, said)| said)
}

/// The term to be added on the right, where it is one term.
fn missing_term(problem: &Problem, missing: &Fraction) -> Option<String> {
    let text = simple(problem, missing)?;
    let (sign, text) = match text.strip_prefix('-') {
        Some(text) => ("-", text.to_string()),
        None => ("+", text),
    };
    Some(format!("a term `{sign} {text}` is missing on the right"))
}

/// The function in TeX, where numerator and denominator are one term each.
fn simple(problem: &Problem, function: &Fraction) -> Option<String> {
    let known = problem
        .late
        .iter()
        .try_fold(function.clone(), |f, step| f.substituted(step.variable, &step.value));
    let forms = [function.clone(), known.ok()?];
    let form = forms.into_iter().find(|f| {
        let few = |p: &Polynomial| p.terms().len() <= 1;
        few(f.numerator()) && few(&f.denominator())
    })?;
    Some(problem.atoms.show_fraction(&form))
}

/// Each term of a sum in the tree, with the tree in which it is zero.
fn terms(tree: &Tree) -> Vec<(Tree, Tree)> {
    let inside = |inner: &Tree, build: &dyn Fn(Tree) -> Tree| -> Vec<(Tree, Tree)> {
        terms(inner)
            .into_iter()
            .map(|(term, rest)| (term, build(rest)))
            .collect()
    };
    let parts = |parts: &[Tree], build: &dyn Fn(Vec<Tree>) -> Tree| -> Vec<(Tree, Tree)> {
        let each = parts.iter().enumerate().flat_map(|(at, part)| {
            let replaced = |new: Tree| {
                let mut all = parts.to_vec();
                if let Some(slot) = all.get_mut(at) {
                    *slot = new;
                }
                build(all)
            };
            inside(part, &replaced)
        });
        each.collect()
    };
    match tree {
        Tree::Sum(all) => {
            let mut found = parts(all, &Tree::Sum);
            for (at, term) in all.iter().enumerate() {
                let mut rest = all.clone();
                if let Some(slot) = rest.get_mut(at) {
                    *slot = Tree::Number(Rational::zero());
                }
                found.push((term.clone(), Tree::Sum(rest)));
            }
            found
        }
        Tree::Product(all) => parts(all, &Tree::Product),
        Tree::Negate(inner) => inside(inner, &|new| Tree::Negate(Box::new(new))),
        Tree::Quotient(above, below, at) => {
            let (at, under, over) = (*at, below.clone(), above.clone());
            let mut found = inside(above, &|new| Tree::Quotient(Box::new(new), under.clone(), at));
            found.extend(inside(below, &|new| Tree::Quotient(over.clone(), Box::new(new), at)));
            found
        }
        _ => Vec::new(),
    }
}
