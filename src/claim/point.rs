//! Points of the solution set, in small rationals.

use super::atom::Atom;
use super::problem::Problem;
use super::root::of_square;
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::number::{Field, Rational, mix};
use num_traits::Zero;
use std::collections::{BTreeMap, BTreeSet};

/// Values for all quantities.
#[derive(Clone, Debug)]
pub struct Point(pub BTreeMap<Variable, Rational>);

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
    let (point, complete) = partial_point(problem, seed);
    let defined = |f: &Fraction| {
        f.factors()
            .iter()
            .all(|(factor, _)| point.polynomial(factor).is_some_and(|v| !v.is_zero()))
    };
    // However the point was made, the premises are what it has to satisfy.
    let pair = problem.pair();
    let asked = problem
        .givens
        .iter()
        .filter(|g| pair.is_none_or(|pair| g.residual.degree(pair) < 2));
    let satisfied = || {
        asked
            .clone()
            .all(|g| point.polynomial(&g.residual).is_none_or(|v| v.is_zero()))
    };
    (complete && about.iter().all(defined) && satisfied()).then_some(point)
}

/// As much of a point as is rational, and whether that is all of it.
pub fn partial_point(problem: &Problem, seed: u64) -> (Point, bool) {
    let mut solved: BTreeSet<Variable> = problem.meaning.values.keys().copied().collect();
    solved.extend(problem.late.iter().map(|step| step.variable));
    let rooted: BTreeMap<Variable, &Fraction> = problem.squares.iter().map(|(v, square)| (*v, square)).collect();
    let mut point = Point(BTreeMap::new());
    for variable in problem.atoms.variables() {
        // A root that was not asked for yet has no value until its square does.
        let is_given = matches!(problem.atoms.atom(variable), Some(Atom::Root { .. }))
            || solved.contains(&variable)
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
    let mut complete = true;
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
        complete &= !failed;
        if open.len() == before {
            return (point, false);
        }
    }
    (point, complete)
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

pub fn is_circle(problem: &Problem, variable: Variable) -> bool {
    matches!(problem.atoms.atom(variable), Some(Atom::Symbol(name)) if name.base == r"\pi")
}

/// Whether the symbol stands in an angle that takes its cosine and sine from a Pythagorean pair.
pub fn is_angle(problem: &Problem, variable: Variable) -> bool {
    problem.atoms.variables().any(|v| match problem.atoms.atom(v) {
        Some(Atom::Circular { angle, .. }) => {
            angle.contains(variable) && !angle.variables().iter().any(|&v| is_circle(problem, v))
        }
        _ => false,
    })
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
