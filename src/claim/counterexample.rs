//! Points that satisfy the premises of a claim and not the claim.

use super::atom::Atom;
use super::problem::Problem;
use super::proof::{Question, ask_with};
use super::reading::{Local, Meaning};
use super::root::of_square;
use super::sheet::{Entry, Fault};
use super::substitute::any;
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::number::{Field, Rational};
use crate::tex::{Equation, Tree};
use num_traits::Zero;
use std::collections::{BTreeMap, BTreeSet};

/// A point, in the names of the sheet, and what the two sides are there.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The symbols that premises and claim speak of, with their values.
    pub point: Vec<(String, Rational)>,
    pub left: String,
    pub right: String,
    /// The terms of the two sides with their values.
    pub terms: Vec<(String, Rational)>,
}

impl std::fmt::Display for Counterexample {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (name, value) in &self.point {
            write!(f, "{name}={}; ", shown(value))?;
        }
        write!(f, "left={}; right={}", self.left, self.right)
    }
}

/// A rational as it is; as a decimal where pi has gone into it.
pub fn shown(value: &Rational) -> String {
    let exact = value.to_string();
    if exact.len() < 90 {
        exact
    } else {
        format!("{:.15}", value.0.to_f64().value())
    }
}

/// Points tried before the search is given up. A function that is not zero has a zero at few of them; most are
/// for square roots, which need a square beneath.
const MOST_POINTS: u64 = 4000;

/// Searches small rationals for a point where the claim fails.
pub fn search(problem: &mut Problem, equation: &Equation, question: &Question) -> Option<Counterexample> {
    let residuals = question.residuals();
    for residual in &residuals {
        problem.meet_squares(residual.numerator());
    }
    (0..MOST_POINTS).find_map(|seed| {
        let point = point(problem, &residuals, seed)?;
        let (left, right) = sides(question, &point)?;
        (left != right).then(|| show(problem, equation, &point, left, right))
    })
}

/// Points at which a formula too large to expand is evaluated instead.
const POINTS_OF_LARGE: u64 = 20;

/// Searches for a counterexample by evaluating both sides at points, without expanding them.
///
/// # Errors
/// A [`Fault`] where the equation speaks of something unknown.
pub fn search_by_points(
    problem: &mut Problem,
    entry: &Entry,
    equation: &Equation,
) -> Result<Option<Counterexample>, Fault> {
    for seed in 0..POINTS_OF_LARGE {
        let Some(point) = point(problem, &[], seed) else {
            continue;
        };
        let values = point
            .0
            .iter()
            .map(|(variable, value)| (*variable, Fraction::from(value)))
            .collect();
        let meaning = Meaning {
            values,
            periods: problem.meaning.periods.clone(),
        };
        let Some(question) = ask_with(problem, &meaning, entry, equation)? else {
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

/// Values for all quantities.
#[derive(Clone, Debug)]
pub struct Point(BTreeMap<Variable, Rational>);

impl Point {
    /// The value of a function, where it is defined.
    pub fn value(&self, function: &Fraction) -> Option<Rational> {
        function.evaluate(&|v| self.0.get(&v).cloned()).ok()?
    }

    fn polynomial(&self, polynomial: &Polynomial) -> Option<Rational> {
        polynomial.evaluate(&|v| self.0.get(&v).cloned())
    }
}

/// A point of the solution set, the same for the same seed; `None` where this seed leads to none.
pub fn point(problem: &Problem, about: &[Fraction], seed: u64) -> Option<Point> {
    let mut solved: BTreeSet<Variable> = problem.meaning.values.keys().copied().collect();
    solved.extend(problem.late.iter().map(|step| step.variable));
    let rooted: BTreeMap<Variable, &Fraction> = problem.squares.iter().map(|(v, square)| (*v, square)).collect();
    let mut point = Point(BTreeMap::new());
    for variable in problem.atoms.variables() {
        let is_given = solved.contains(&variable)
            || rooted.contains_key(&variable)
            || problem.roots.iter().any(|(v, _)| *v == variable);
        if !is_given {
            point.0.insert(variable, small(problem, variable, seed));
        }
    }
    set_angles(problem, &mut point, seed);
    // One free symbol under each root is chosen so that a square stands there, where it is linear.
    for (&root, square) in &rooted {
        make_square(problem, root, square, &mut point, seed);
    }
    let mut open: Vec<(Variable, &Fraction, bool)> = Vec::new();
    open.extend(problem.late.iter().map(|step| (step.variable, &step.value, false)));
    open.extend(problem.meaning.values.iter().map(|(v, value)| (*v, value, false)));
    open.extend(problem.roots.iter().map(|(v, value)| (*v, value, false)));
    open.extend(rooted.iter().map(|(&v, &square)| (v, square, true)));
    // Each value rests on others; what can be computed is, until nothing is left.
    while !open.is_empty() {
        let before = open.len();
        let mut failed = false;
        open.retain(|&(variable, value, is_square)| {
            if point.0.contains_key(&variable) {
                return false;
            }
            let known = match value.evaluate(&|v| point.0.get(&v).cloned()) {
                Ok(None) => return true,
                Ok(Some(value)) if is_square => of_square(&Fraction::from(&value)).and_then(|root| root.as_constant()),
                Ok(value) => value,
                Err(_) => None,
            };
            match known {
                Some(known) => {
                    point.0.insert(variable, known);
                }
                None => failed = true,
            }
            false
        });
        if failed || open.len() == before {
            return None;
        }
    }
    let defined = |f: &Fraction| {
        f.factors()
            .iter()
            .all(|(factor, _)| point.polynomial(factor).is_some_and(|v| !v.is_zero()))
    };
    about.iter().all(defined).then_some(point)
}

/// Gives cosines and sines rational values that belong together: quarter turns where the angle is `\pi` times a
/// free symbol, which takes a value to match, else a Pythagorean pair.
fn set_angles(problem: &Problem, point: &mut Point, seed: u64) {
    let circle = problem.atoms.variables().find(|&v| is_circle(problem, v));
    if let Some(circle) = circle {
        point.0.insert(circle, circle_constant());
    }
    let mut turned = BTreeSet::new();
    for variable in problem.atoms.variables() {
        let Some(Atom::Circular { sine, angle }) = problem.atoms.atom(variable) else {
            continue;
        };
        let symbols: Vec<Variable> = angle.variables().into_iter().filter(|v| Some(*v) != circle).collect();
        let quarter = match (symbols.as_slice(), circle) {
            (&[symbol], Some(circle)) if angle.contains(circle) && angle.numerator().degree(symbol) == 1 => {
                let quarters = 1 + (mix(seed ^ u64::from(symbol.0)) % 3) as i64;
                let scale = Rational::from_ratio(quarters, 2) * below(angle);
                if turned.insert(symbol) {
                    point.0.insert(symbol, scale);
                }
                Some(quarters)
            }
            _ => None,
        };
        let key = angle
            .numerator()
            .terms()
            .iter()
            .flat_map(|(m, _)| m.factors())
            .fold(7, |k, (v, e)| k * 31 + u64::from(v.0 * 3 + e));
        let u = Rational::from_ratio((mix(seed ^ key) % 4 + 1) as i64, (mix(seed ^ key) >> 20) as i64 % 4 + 2);
        let square = u.clone() * u.clone();
        let one = Rational::from_integer(1);
        let value = match (quarter, sine) {
            (Some(quarters), true) => Rational::from_integer([0, 1, 0, -1][(quarters % 4) as usize]),
            (Some(quarters), false) => Rational::from_integer([1, 0, -1, 0][(quarters % 4) as usize]),
            (None, true) => (u.clone() + u) / (one + square),
            (None, false) => (one.clone() - square.clone()) / (one + square),
        };
        point.0.insert(variable, value);
    }
}

fn is_circle(problem: &Problem, variable: Variable) -> bool {
    matches!(problem.atoms.atom(variable), Some(Atom::Symbol(name)) if name.base == r"\pi")
}

/// The denominator of a part of an angle.
fn below(angle: &Fraction) -> Rational {
    angle
        .denominator()
        .as_constant()
        .map_or_else(|| Rational::from_integer(1), |n| Rational(dashu_ratio::RBig::from(n)))
}

/// The circle constant to 50 digits: sides that differ there by more than its error differ.
fn circle_constant() -> Rational {
    let digits = "3.14159265358979323846264338327950288419716939937511";
    Rational::from_decimal(digits).unwrap_or_else(|| Rational::from_ratio(355, 113))
}

/// Chooses a symbol in a radicand so that the root is a small rational.
fn make_square(problem: &Problem, root: Variable, square: &Fraction, point: &mut Point, seed: u64) {
    let mut whole = problem.meaning.apply(square).unwrap_or_else(|_| square.clone());
    for step in &problem.late {
        whole = whole.substituted(step.variable, &step.value).unwrap_or(whole);
    }
    let below = whole.denominator();
    let linear = whole.numerator().variables().into_iter().find(|&v| {
        whole.numerator().degree(v) == 1 && !below.contains(v) && point.0.contains_key(&v) && !is_bounded(problem, v)
    });
    let Some(variable) = linear else { return };
    let coefficients = whole.numerator().coefficients(variable);
    let [rest, slope] = coefficients.as_slice() else { return };
    let value = |p: &Polynomial| point.polynomial(p);
    if let (Some(rest), Some(slope), Some(below)) = (value(rest), value(slope), value(&below))
        && !slope.is_zero()
    {
        let wanted = small(problem, root, seed);
        let wanted = wanted.clone() * wanted;
        point.0.insert(variable, (wanted * below - rest) / slope);
    }
}

fn is_bounded(problem: &Problem, variable: Variable) -> bool {
    matches!(problem.atoms.atom(variable), Some(Atom::Symbol(name)) if problem.vocabulary.positive.contains(name))
}

/// A small rational for a free quantity: in (0, 1) where it must not exceed 1, positive where it must be.
fn small(problem: &Problem, variable: Variable, seed: u64) -> Rational {
    let draw = mix(seed.wrapping_mul(1 << 20).wrapping_add(u64::from(variable.0)));
    // The range grows slowly with the seed, so that the first points have the smallest numbers.
    let size = 3 + (seed / 6).min(12);
    let (a, b) = ((draw % size + 1) as i64, ((draw >> 20) % size + 1) as i64);
    let within = |names: &[crate::tex::Name]| match problem.atoms.atom(variable) {
        Some(Atom::Symbol(name)) => names.contains(name),
        _ => false,
    };
    if within(&problem.vocabulary.at_most_one) {
        return Rational::from_ratio(a, a + b);
    }
    let below = if (draw >> 50) & 1 == 0 { 1 } else { b };
    let value = Rational::from_ratio(a, below);
    let negative = (draw >> 40) & 3 == 0 && !within(&problem.vocabulary.positive);
    if negative { -value } else { value }
}

/// Vigna's splitmix64 finaliser: a fixed draw for each seed.
fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn show(problem: &mut Problem, equation: &Equation, point: &Point, left: String, right: String) -> Counterexample {
    let mut shown: Vec<(String, Rational)> = Vec::new();
    for variable in spoken(problem, equation) {
        let value = problem
            .meaning
            .restrict(&Fraction::variable(variable), &mut problem.atoms);
        if let Some(value) = value.ok().and_then(|value| point.value(&value)) {
            let name = problem.atoms.show(variable);
            if !shown.iter().any(|(known, _)| *known == name) {
                shown.push((name, value));
            }
        }
    }
    let terms = terms(problem, equation, point);
    Counterexample {
        point: shown,
        left,
        right,
        terms,
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
    met.retain(|&v| problem.statements.claim_runs || !problem.runs(&Fraction::variable(v)));
    met
}

/// The terms of both sides, and their values at the point.
fn terms(problem: &mut Problem, equation: &Equation, point: &Point) -> Vec<(String, Rational)> {
    let mut shown = Vec::new();
    for side in [&equation.left, &equation.right] {
        let Tree::Sum(parts) = side else { continue };
        for part in parts {
            let mut reading = problem.reading();
            reading.upper = Some(true);
            if let Some(value) = reading.tree(part).ok().and_then(|value| point.value(&value)) {
                shown.push((part.to_string(), value));
            }
        }
    }
    shown
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
        _ => true,
    };
    let mut spoken: Vec<Variable> = met.into_iter().filter(keeps).collect();
    spoken.sort_by_key(|v| (order(v), *v));
    spoken
}
