//! Deciding a claim by the exact normal form.

use super::atom::Atom;
use super::counterexample::{self, Counterexample};
use super::fault::Fault;
use super::meaning::Meaning;
use super::point::partial_point;
use super::premise::{message, pair_of};
use super::problem::Problem;
use super::reading::Reading;
use super::root::{either_root, of_square};
use super::sheet::Entry;
use super::substitute::{any_side, nodes};
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::number::Field;
use crate::tex::{Equation, EvaluationError, Tree};
use num_traits::{One, Zero};

/// What came of one equation.
#[derive(Clone, Debug)]
pub enum Outcome {
    Holds,
    Fails(Counterexample),
    /// A denominator vanishes wherever the premises hold.
    Nowhere,
    /// Different from zero as a function, but no point was found to show it: the premises leave no rational one.
    Unshown,
    /// Too large to expand, and true at every point tried.
    TooLarge,
}

/// What an equation asks of the two sides.
#[derive(Clone, Debug)]
pub enum Question {
    Equal {
        left: Fraction,
        right: Fraction,
    },
    /// A right side with `\pm`: the left is one of the two.
    OneOf {
        left: Fraction,
        right: [Fraction; 2],
    },
    /// The two roots of `c + b x + a x^2`.
    Roots {
        polynomial: [Fraction; 3],
        right: [Fraction; 2],
    },
}

impl Question {
    /// The functions that are zero exactly where the equation holds.
    pub fn residuals(&self) -> Vec<Fraction> {
        match self {
            Self::Equal { left, right } => vec![left.clone() - right.clone()],
            Self::OneOf { left, right: [a, b] } => vec![(left.clone() - a.clone()) * (left.clone() - b.clone())],
            Self::Roots {
                polynomial: [c, b, a],
                right: [x, y],
            } => vec![
                a.clone() * (x.clone() + y.clone()) + b.clone(),
                a.clone() * x.clone() * y.clone() - c.clone(),
            ],
        }
    }
}

/// Nodes from which on a formula is first tried at points.
const LARGE: usize = 100;

/// Points at which a formula too large to expand is evaluated instead.
const POINTS_OF_LARGE: u64 = 20;

/// Decides one equation of a claim.
///
/// # Errors
/// A [`Fault`] where the equation speaks of something unknown.
pub fn decide(problem: &mut Problem, entry: &Entry, equation: &Equation) -> Result<Outcome, Fault> {
    // Two points tell most wrong formulas, and cost less than the normal form where that is large.
    if nodes(equation) > LARGE
        && let Some(counterexample) = counterexample::search_by_points(problem, entry, equation, 2)?
    {
        return Ok(Outcome::Fails(counterexample));
    }
    let Some(question) = ask(problem, entry, equation)? else {
        return Ok(Outcome::Nowhere);
    };
    let residuals = question.residuals();
    if residuals.iter().any(|residual| residual.numerator().is_too_large()) {
        let found = counterexample::search_by_points(problem, entry, equation, POINTS_OF_LARGE)?;
        return Ok(found.map_or(Outcome::TooLarge, Outcome::Fails));
    }
    problem.meet_squares();
    let known = problem.knowledge();
    let below_vanishes = |f: &Fraction| f.factors().iter().any(|(factor, _)| known.vanishes(factor));
    if residuals.iter().any(below_vanishes) {
        return Ok(Outcome::Nowhere);
    }
    if residuals.iter().all(|residual| known.vanishes(residual.numerator())) {
        return Ok(Outcome::Holds);
    }
    Ok(counterexample::search(problem, entry, equation, &question).map_or(Outcome::Unshown, Outcome::Fails))
}

/// Evaluates both sides with all that is known; `None` where a denominator vanishes.
pub fn ask(problem: &mut Problem, entry: &Entry, equation: &Equation) -> Result<Option<Question>, Fault> {
    let meaning = std::mem::take(&mut problem.meaning);
    let question = ask_with(problem, &meaning, None, entry, equation);
    problem.meaning = meaning;
    question
}

/// Evaluates both sides with as much known as `meaning` says.
pub fn ask_with(
    problem: &mut Problem,
    meaning: &Meaning,
    times: Option<&Meaning>,
    entry: &Entry,
    equation: &Equation,
) -> Result<Option<Question>, Fault> {
    let known = problem.knowledge();
    let test = |f: &Fraction| known.vanishes(f.numerator());
    let read = |problem: &mut Problem, tree: &Tree, upper: Option<bool>| {
        let mut reading: Reading = problem.reading_with(meaning);
        reading.times = times;
        reading.upper = upper;
        reading.vanishes = Some(&test);
        reading.first = None;
        match reading.tree(tree) {
            Ok(value) => Ok(Some(value)),
            Err(EvaluationError::DivisionByZero { .. }) => Ok(None),
            Err(error) => Err(entry.tex.fault(error.at(), message(&error)).of(&entry.label)),
        }
    };
    let pair = match &equation.left {
        Tree::Symbol(name, at) => pair_of(name).map(|base| Tree::Symbol(base, *at)),
        _ => None,
    };
    let Some(left) = read(problem, pair.as_ref().unwrap_or(&equation.left), None)? else {
        return Ok(None);
    };
    let has_sign = any_side(equation, &mut |n| matches!(n, Tree::PlusMinus(_) | Tree::MinusPlus(_)));
    if pair.is_none() && !has_sign {
        return Ok(read(problem, &equation.right, None)?.map(|right| Question::Equal { left, right }));
    }
    let (Some(plus), Some(minus)) = (
        read(problem, &equation.right, Some(true))?,
        read(problem, &equation.right, Some(false))?,
    ) else {
        return Ok(None);
    };
    let right = [plus, minus];
    match pair.and_then(|_| quadratic(problem, meaning, &left)) {
        Some(polynomial) => Ok(Some(Question::Roots { polynomial, right })),
        None => Ok(Some(Question::OneOf { left, right })),
    }
}

/// The coefficients of the premise that is quadratic in the symbol that `left` is.
fn quadratic(problem: &Problem, meaning: &Meaning, left: &Fraction) -> Option<[Fraction; 3]> {
    let variable = *left.variables().first()?;
    if *left != Fraction::variable(variable) {
        return None;
    }
    let given = problem
        .givens
        .iter()
        .find(|given| given.residual.degree(variable) == 2)?;
    let known = |p: &Polynomial| meaning.apply(&Fraction::from(p.clone())).ok();
    match given.residual.coefficients(variable).as_slice() {
        [c, b, a] => Some([known(c)?, known(b)?, known(a)?]),
        _ => None,
    }
}

/// Whether a polynomial is zero wherever the premises hold.
pub fn vanishes(problem: &mut Problem, polynomial: &Polynomial) -> bool {
    problem.meet_squares();
    problem.knowledge().vanishes(polynomial)
}

/// Points at which a radicand is tried for a square.
const SQUARE_POINTS: u64 = 3;

/// Independent roots in one claim: each doubles the parts that a proof has to look at.
const MOST_ROOTS: usize = 7;

/// What is known beyond the meaning of names: later values, and squares of roots.
#[derive(Clone, Debug, Default)]
pub struct Knowledge {
    pub late: Vec<crate::algebra::Step>,
    /// Variables with their squares, innermost first; the sign of a root that is a function is not known.
    pub squares: Vec<(Variable, Fraction)>,
    /// Values of roots whose sign is known.
    pub roots: Vec<(Variable, Fraction)>,
}

impl Knowledge {
    /// Whether a polynomial is zero wherever the premises hold.
    pub fn vanishes(&self, polynomial: &Polynomial) -> bool {
        if polynomial.is_zero() {
            return true;
        }
        if self.squares.len() > MOST_ROOTS {
            return false;
        }
        let whole = [Fraction::from(polynomial.clone())];
        let all_roots = || self.squares.iter().chain(&self.roots).map(|(root, _)| *root);
        // Roots that come in with later values belong together with those that are there; else, what cancels without
        // the later values does so while it is small.
        let hidden = self
            .late
            .iter()
            .any(|step| all_roots().any(|root| step.value.contains(root)));
        let parts = if hidden {
            self.without_roots(&whole.map(|part| self.settled(&part)))
        } else {
            self.without_roots(&whole)
        };
        let Some(parts) = parts else { return false };
        let parts: Vec<Fraction> = parts.iter().map(|part| self.settled(part)).collect();
        parts.iter().all(Fraction::is_zero)
    }

    /// The parts of functions, of which all are zero where the functions are, that hold no root.
    fn without_roots(&self, functions: &[Fraction]) -> Option<Vec<Fraction>> {
        let mut parts = Vec::new();
        for function in functions {
            let rooted = self.roots.iter().try_fold(function.clone(), |f, (root, value)| {
                Fraction::from(f.numerator().clone()).substituted(*root, value)
            });
            parts.push(rooted.ok()?);
        }
        for (root, square) in self.squares.iter().rev() {
            parts = parts
                .iter()
                .flat_map(|part| split(part.numerator(), *root, square))
                .collect();
        }
        parts.retain(|part| !part.is_zero());
        Some(parts)
    }

    /// The function with the later values put in, denominator and all.
    fn settled_whole(&self, function: &Fraction) -> Fraction {
        self.late.iter().fold(function.clone(), |f, step| {
            f.substituted(step.variable, &step.value).unwrap_or(f)
        })
    }

    /// The function with the later values put in; where that makes a denominator vanish, as far as it goes.
    fn settled(&self, function: &Fraction) -> Fraction {
        self.late.iter().fold(function.clone(), |f, step| {
            if f.is_zero() {
                return f;
            }
            // The numerator decides, and it has no denominator that could vanish.
            let inserted = Fraction::from(f.numerator().clone()).substituted(step.variable, &step.value);
            inserted.unwrap_or(f)
        })
    }
}

/// `a` and `b` of `a + b root`, even powers of the root replaced by its square.
fn split(polynomial: &Polynomial, root: Variable, square: &Fraction) -> [Fraction; 2] {
    let mut parts = [Fraction::zero(), Fraction::zero()];
    for (power, coefficient) in polynomial.coefficients(root).into_iter().enumerate() {
        parts[power % 2] += Fraction::from(coefficient) * square.to_power(power as i32 / 2);
    }
    parts
}

impl Problem<'_> {
    /// What is known beyond the meaning of names.
    pub fn knowledge(&self) -> Knowledge {
        Knowledge {
            late: self.late.clone(),
            squares: self.squares.clone(),
            roots: self.roots.clone(),
        }
    }

    /// Learns the squares of all roots among the quantities: what is solved for late may hold some that a claim does not.
    pub fn meet_squares(&mut self) {
        let mut open: Vec<Variable> = self.atoms.variables().skip(self.atoms_met).collect();
        self.atoms_met += open.len();
        while let Some(variable) = open.pop() {
            let known = self
                .squares
                .iter()
                .chain(&self.roots)
                .any(|(known, _)| *known == variable);
            if known {
                continue;
            }
            let Some(square) = self.square_of(variable) else {
                continue;
            };
            open.extend(square.variables());
            match self.root_of(&square) {
                Some(root) => self.roots.push((variable, root)),
                None => self.squares.push((variable, square)),
            }
        }
        // A root inside another was made before it.
        self.squares.sort_by_key(|(variable, _)| *variable);
        self.roots.sort_by_key(|(variable, _)| std::cmp::Reverse(*variable));
    }

    fn square_of(&mut self, variable: Variable) -> Option<Fraction> {
        match self.atoms.atom(variable)?.clone() {
            Atom::Root { radicand } => Some(radicand),
            Atom::Circular { sine: true, angle } => {
                let cosine = Fraction::variable(self.atoms.variable(Atom::Circular { sine: false, angle }));
                Some(Fraction::one() - cosine.clone() * cosine)
            }
            atom => self.relation(&atom),
        }
    }

    /// The root of a square whose sign is known, or its multiple of a root met before.
    fn root_of(&self, square: &Fraction) -> Option<Fraction> {
        let signed = |root: Fraction| {
            let negative = self.sign(&root)?;
            Some(if negative { -root } else { root })
        };
        let known = self.knowledge();
        let root = |square: &Fraction| {
            // A function that is no square at some point is none: that is cheaper to see than to expand it.
            let is_square_at = |seed| match partial_point(self, seed).0.value(square) {
                Some(value) => of_square(&Fraction::from(&value)).is_some(),
                None => true,
            };
            if (0..SQUARE_POINTS).all(is_square_at) {
                either_root(&known.settled_whole(square))
            } else {
                None
            }
        };
        if let Some(root) = root(square) {
            return signed(root);
        }
        if self.squares.len() > MOST_ROOTS {
            return None;
        }
        // Times the squares of some roots met before it may be a square itself, as that of \sqrt{4 x} is beside \sqrt{x}.
        (1..1_usize << self.squares.len()).find_map(|chosen| {
            let chosen = self
                .squares
                .iter()
                .enumerate()
                .filter(|(bit, _)| chosen >> bit & 1 == 1);
            let (mut product, mut roots) = (square.clone(), Fraction::one());
            for (_, (other, known)) in chosen {
                product *= known.clone();
                roots *= Fraction::variable(*other);
            }
            Some(signed(root(&product)?)? / roots)
        })
    }

    /// Whether a function is negative, where it has one sign for all values that its symbols may take.
    fn sign(&self, function: &Fraction) -> Option<bool> {
        let of = |polynomial: &Polynomial| {
            let positive = |v: &Variable| match self.atoms.atom(*v) {
                Some(Atom::Symbol(name)) => self.vocabulary.positive.contains(name),
                _ => false,
            };
            let signs = || polynomial.terms().iter().map(|(_, c)| *c < dashu_int::IBig::ZERO);
            let one_sign = signs().all(|negative| negative) || !signs().any(|negative| negative);
            let first = signs().next()?;
            (one_sign && polynomial.variables().iter().all(positive)).then_some(first)
        };
        Some(of(function.numerator())? != of(&function.denominator())?)
    }
}
