//! Points that satisfy the premises of a claim and not the claim.

use super::atom::Atom;
use super::fault::Fault;
use super::meaning::Meaning;
use super::point::{Point, is_angle, is_circle, point};
use super::problem::Problem;
use super::proof::{Question, ask_with};
use super::reading::Local;
use super::root::of_square;
use super::sheet::Entry;
use super::substitute::any;
use super::surd;
use crate::algebra::{Fraction, Variable};
use crate::number::{Field, Rational};
use crate::tex::{Equation, Tree};
use dashu_int::ops::BitTest;
use num_traits::Zero;
use std::collections::BTreeSet;

/// A point, in the names of the sheet, and what the two sides are there.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The symbols that premises and claim speak of, with their values.
    pub point: Vec<(String, String)>,
    pub left: String,
    pub right: String,
    /// The terms of the two sides with their values.
    pub terms: Vec<(String, String)>,
}

impl std::fmt::Display for Counterexample {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (name, value) in &self.point {
            write!(f, "{name}={value}; ")?;
        }
        write!(f, "left={}; right={}", self.left, self.right)
    }
}

/// A rational as it is; as a decimal where pi has gone into it, which is known to 50 digits.
fn shown(value: &Rational) -> String {
    let exact = value.to_string();
    let of_pi = value.0.denominator().bit_len() > BITS_OF_PI && exact.len() > 90;
    if of_pi {
        format!("{:.15}", value.0.to_f64().value())
    } else {
        exact
    }
}

/// A denominator of so many bits, made of tens, comes from the decimal that stands for pi.
const BITS_OF_PI: usize = 120;

/// Points tried before the search is given up. A function that is not zero has a zero at few of them; most are
/// for square roots, which need a square beneath.
const MOST_POINTS: u64 = 4000;

/// Points among which one with all positive symbols positive is looked for first.
const PHYSICAL_POINTS: u64 = 30;

/// Searches small rationals for a point where the claim fails.
pub fn search(
    problem: &mut Problem,
    entry: &Entry,
    equation: &Equation,
    question: &Question,
) -> Option<Counterexample> {
    let residuals = question.residuals();
    problem.meet_squares();
    let tried = if problem.squares.is_empty() {
        MOST_POINTS
    } else {
        MOST_POINTS / 10
    };
    let mut found = |physical: bool, seeds: std::ops::Range<u64>| {
        seeds.into_iter().find_map(|seed| {
            let point = point(problem, &residuals, seed)?;
            let (left, right) = sides(question, &point)?;
            let fits = !physical || is_physical(problem, &point);
            (fits && left != right && is_defined(problem, entry, equation, &point))
                .then(|| show(problem, equation, &point, left, right))
        })
    };
    // Where a point with lengths and times that are positive can be had, it is the better one to look at.
    let rational = found(true, 0..PHYSICAL_POINTS).or_else(|| found(false, 0..tried));
    rational.or_else(|| surd::search(problem, equation, question))
}

/// Searches the first `points` points for a counterexample by evaluating both sides at points, without expanding them.
///
/// # Errors
/// A [`Fault`] where the equation speaks of something unknown.
pub fn search_by_points(
    problem: &mut Problem,
    entry: &Entry,
    equation: &Equation,
    points: u64,
) -> Result<Option<Counterexample>, Fault> {
    meet(problem, equation);
    problem.meet_squares();
    let times = problem.times.clone();
    for seed in 0..points {
        let Some(point) = point(problem, &[], seed) else {
            continue;
        };
        let meaning = constants(problem, &point);
        let Some(question) = ask_with(problem, &meaning, Some(&times), entry, equation)? else {
            continue;
        };
        if let Some((left, right)) = sides(&question, &point)
            && left != right
        {
            return Ok(Some(show(problem, equation, &point, left, right)));
        }
    }
    Ok(None)
}

/// The two sides at a point, as text; `None` where one of them has no rational value there.
fn sides(question: &Question, point: &Point) -> Option<(String, String)> {
    let text = |value: Rational| shown(&value);
    let pair = |a: &Rational, b: &Rational| {
        let (low, high) = if a <= b { (a, b) } else { (b, a) };
        format!("{{{}, {}}}", shown(low), shown(high))
    };
    match question {
        Question::Equal { left, right } => Some((text(point.value(left)?), text(point.value(right)?))),
        Question::OneOf { left, right: [a, b] } => {
            let (left, a, b) = (point.value(left)?, point.value(a)?, point.value(b)?);
            let right = pair(&a, &b);
            if left == a || left == b {
                Some((right.clone(), right))
            } else {
                Some((text(left), right))
            }
        }
        Question::Roots {
            polynomial: [c, b, a],
            right: [x, y],
        } => {
            let (c, b, a) = (point.value(c)?, point.value(b)?, point.value(a)?);
            let right = pair(&point.value(x)?, &point.value(y)?);
            if a.is_zero() {
                return None;
            }
            let two = Rational::from_integer(2);
            let square = b.clone() * b.clone() - Rational::from_integer(4) * a.clone() * c.clone();
            let root = of_square(&Fraction::from(&square)).and_then(|root| root.as_constant());
            let left = match root {
                Some(root) => {
                    let below = two * a;
                    pair(&((-b.clone() - root.clone()) / below.clone()), &((root - b) / below))
                }
                None => format!("two numbers of sum {} and product {}", -b / a.clone(), c / a),
            };
            Some((left, right))
        }
    }
}

pub(super) fn show(
    problem: &mut Problem,
    equation: &Equation,
    point: &Point,
    left: String,
    right: String,
) -> Counterexample {
    let mut listed: Vec<(String, String)> = Vec::new();
    for variable in spoken(problem, equation) {
        let value = problem
            .meaning
            .restrict(&Fraction::variable(variable), &mut problem.atoms);
        if let Some(value) = value.ok().and_then(|value| point.value(&value)) {
            let name = problem.atoms.show(variable);
            if !listed.iter().any(|(known, _)| *known == name) {
                listed.push((name, shown(&value)));
            }
        }
    }
    let terms = terms(problem, equation, point);
    Counterexample {
        point: listed,
        left,
        right,
        terms,
    }
}

/// Whether no denominator of the equation, as it is written, vanishes at the point.
fn is_defined(problem: &mut Problem, entry: &Entry, equation: &Equation, point: &Point) -> bool {
    let meaning = constants(problem, point);
    let times = problem.times.clone();
    matches!(ask_with(problem, &meaning, Some(&times), entry, equation), Ok(Some(_)))
}

/// The point as what is known.
fn constants(problem: &Problem, point: &Point) -> Meaning {
    let values = point
        .0
        .iter()
        .map(|(variable, value)| (*variable, Fraction::from(value)))
        .collect();
    Meaning {
        values,
        periods: problem.meaning.periods.clone(),
    }
}

/// Whether the symbols that are positive, or at most 1, are so at the point.
fn is_physical(problem: &Problem, point: &Point) -> bool {
    let (zero, one) = (Rational::zero(), Rational::from_integer(1));
    problem.atoms.variables().all(|variable| {
        let (Some(Atom::Symbol(name)), Some(value)) = (problem.atoms.atom(variable), point.0.get(&variable)) else {
            return true;
        };
        let vocabulary = problem.vocabulary;
        (!vocabulary.positive.contains(name) || *value > zero)
            && (!vocabulary.at_most_one.contains(name) || *value <= one)
    })
}

/// Makes the quantities of an equation known, without evaluating it.
fn meet(problem: &mut Problem, equation: &Equation) {
    let locals: Vec<Tree> = problem
        .statements
        .locals
        .iter()
        .map(|local| local.tree.clone())
        .collect();
    for tree in [&equation.left, &equation.right].into_iter().chain(&locals) {
        any(tree, &mut |node| {
            if matches!(node, Tree::Symbol(..) | Tree::Call(..) | Tree::Partial { .. }) {
                let mut reading = problem.reading();
                reading.upper = Some(true);
                // What has no meaning is said when the equation is evaluated.
                let _ = reading.tree(node);
            }
            false
        });
    }
}

/// The quantities that one node of a tree names.
fn quantities(problem: &mut Problem, node: &Tree) -> BTreeSet<Variable> {
    if let Tree::Symbol(name, _) = node
        && problem.vocabulary.abbreviations.iter().any(|(known, _)| known == name)
    {
        return BTreeSet::from([problem.atoms.variable(Atom::Symbol(name.clone()))]);
    }
    if !matches!(
        node,
        Tree::Symbol(..) | Tree::Call(..) | Tree::Partial { .. } | Tree::Invariant { .. }
    ) {
        return BTreeSet::new();
    }
    let blank = Meaning::default();
    let read = problem.reading_with(&blank).tree(node);
    let mut met = read.map(|value| value.variables()).unwrap_or_default();
    // A law that holds at all times has no values at this point.
    if matches!(node, Tree::Invariant { .. }) {
        // What a trace is made of, rather than the derivatives that follow from it.
        let read = problem.reading().tree(node);
        met = read.map(|value| value.variables()).unwrap_or_default();
    }
    met.retain(|&v| problem.statements.claim_runs || !problem.runs(&Fraction::variable(v)));
    met
}

/// The terms of both sides, and their values at the point.
fn terms(problem: &mut Problem, equation: &Equation, point: &Point) -> Vec<(String, String)> {
    let mut listed = Vec::new();
    for side in [&equation.left, &equation.right] {
        let Tree::Sum(parts) = side else { continue };
        for part in parts {
            let mut reading = problem.reading();
            reading.upper = Some(true);
            if let Some(value) = reading.tree(part).ok().and_then(|value| point.value(&value)) {
                listed.push((part.to_string(), shown(&value)));
            }
        }
    }
    listed
}

/// The quantities that premises and claim speak of, parameters first.
fn spoken(problem: &mut Problem, equation: &Equation) -> Vec<Variable> {
    let statements = problem.statements.clone();
    let mut trees: Vec<(&Tree, &[Local])> = vec![
        (&equation.left, &statements.locals),
        (&equation.right, &statements.locals),
    ];
    for premise in &statements.premises {
        trees.push((&premise.equation.left, &premise.locals));
        trees.push((&premise.equation.right, &premise.locals));
    }
    let mut met = BTreeSet::new();
    let mut next = 0;
    let mut seen: Vec<&Local> = Vec::new();
    while let Some(&(tree, locals)) = trees.get(next) {
        next += 1;
        any(tree, &mut |node| {
            if let Tree::Symbol(name, _) = node
                && let Some(local) = locals.iter().find(|local| local.name == *name)
            {
                if !seen.iter().any(|known| std::ptr::eq(*known, local)) {
                    seen.push(local);
                    trees.push((&local.tree, locals));
                }
                return false;
            }
            met.extend(quantities(problem, node));
            false
        });
    }
    let order = |v: &Variable| match problem.atoms.atom(*v) {
        Some(Atom::Symbol(_)) => 0,
        Some(Atom::Time { .. } | Atom::Running) => 1,
        Some(Atom::State { .. }) => 2,
        Some(Atom::Value { .. }) => 3,
        _ => 4,
    };
    let abbreviated = met.iter().any(|&v| match problem.atoms.atom(v) {
        Some(Atom::Symbol(name)) => problem.vocabulary.abbreviations.iter().any(|(known, _)| known == name),
        _ => false,
    });
    let keeps = |v: &Variable| match problem.atoms.atom(*v) {
        // The flights say where the impacts are.
        Some(Atom::Time { .. }) => !abbreviated,
        Some(Atom::Root { .. }) | None => false,
        // An angle is said by its cosine and sine, unless it is so many quarter turns.
        Some(Atom::Symbol(_)) if problem.pair() == Some(*v) => false,
        Some(Atom::Symbol(_)) => !is_circle(problem, *v) && !is_angle(problem, *v),
        _ => true,
    };
    let mut spoken: Vec<Variable> = met.into_iter().filter(keeps).collect();
    spoken.sort_by_key(|v| (order(v), *v));
    spoken
}
