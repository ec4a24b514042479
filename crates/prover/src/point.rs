//! The search for points: values of symbols and functions at which all that is given holds.
//!
//! Premises are solved one after the other, each for a symbol in which it is linear, quadratic, or that a single
//! function of it can be undone for; what is left is met by small numbers and by multiples of pi. Where a coefficient
//! may vanish, the case that it does is a point of its own.

use super::float::{Complex, Program, Sized};
use super::laws::Usable;
use super::proof;
use super::session::Session;
use super::values;
use crate::algebra::{Steps, coefficients_in, degree_in, factors, primitive, rational_root, square_root};
use kernel::{
    Certificate, Elementary, Expansion, Function, FunctionOf, Inference, Law, Node, Origin, Polynomial, Property,
    Quantity, Statement, Symbol, Term, Terms, With, Witness,
};
use num_traits::Zero;
use numbers::{Field, Rational, Sequence};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Whether the goals must fail at the point, or the point is of the premises alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The premises hold, and the goals fail, if they do at one of the first points met.
    Either,
    Failure,
    Premises,
    /// The point is of the premises, whether or not the claim is defined there.
    PremisesAlone,
}

/// Cases in which a coefficient vanishes that are followed.
const MOST_CASES: usize = 24;

/// Products of terms for one numerator, and terms of all numerators for one unit of effort.
const LARGEST_FORM: u64 = 20_000;
const MOST_STEPS: u64 = 200_000;
/// What the certificates that numbers of witnesses are 0 may cost together.
const MOST_CERTIFICATE_STEPS: u64 = 500_000;

/// Terms that a solution is put into, and terms that are new then, that cost as much as one term of a numerator.
const MET_IN_A_STEP: u64 = 8;

/// Products of terms for the numerators of the claim.
const LARGEST_GOAL: u64 = 200_000;

/// Choices of functions that meet the laws in floating point.
const MOST_MODELS: usize = 60;

/// Points that the kernel is asked for, for each case and for each choice of functions.
const ASKED_OF_CASE: usize = 4;
const MOST_ASKED: usize = 16;

/// Points drawn at random for each case; those at which all that is given holds and the claim does too, before it is
/// taken to hold.
const MOST_SAMPLES: usize = 300;
const ENOUGH_SAMPLES: usize = 24;

/// Points of the premises at which the claim holds, before one of them is taken.
const FEW_SAMPLES: usize = 8;

/// A search for one point.
struct Search<'a> {
    statement: Statement,
    wanted: Wanted,
    accept: &'a mut dyn FnMut(&With<Witness>) -> bool,
    functions: Vec<(Function, Symbol, Term)>,
    /// Values of functions at single times that are symbols of their own.
    table: Vec<(Function, u32, Term, Symbol)>,
    periods: Vec<(Function, Term)>,
    /// The periods with what is solved put in.
    known_periods: Vec<(Function, Term)>,
    cases: usize,
    effort: u64,
    random: Sequence,
    /// What is declared of symbols, as far as it was asked for; whether sines or cosines are spoken of.
    declared: HashMap<Symbol, Declared>,
    circles: bool,
    /// Rational numbers about those that an inequality speaks of: these, next to them, and between.
    spoken: Vec<Rational>,
    /// The values of numbers, as far as they were asked for.
    numbers: HashMap<Term, Complex>,
    /// Numerators by term; `None` of those that are too large.
    forms: HashMap<Term, Option<Polynomial>>,
    /// What was expanded for these.
    expansion: Expansion,
    /// Equations that were factored.
    split: BTreeSet<Term>,
    /// Terms of polynomials that may still be made.
    steps_left: u64,
    /// The steps left for certificates.
    certificate_steps: u64,
    /// Points that the kernel may still be asked for.
    asks_left: usize,
    found: Option<With<Witness>>,
}

/// What is declared of a symbol.
#[derive(Clone, Copy, Debug, Default)]
struct Declared {
    positive: bool,
    integer: bool,
    at_most_one: bool,
}

/// A way to go on with an equation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// Another equation in its place.
    Instead(usize, Term),
    /// Something else vanishes too.
    Also(Term),
    /// It is solved for a symbol.
    Put(usize, Symbol, Term),
}

/// Premises being solved: what is still open, and what is solved, in terms of what is not.
#[derive(Clone, Default)]
struct System {
    open: Vec<Term>,
    solved: Vec<(Symbol, Term)>,
}

/// Looks for a point that `accept` (the kernel) takes.
pub fn search(
    statement: &Statement,
    wanted: Wanted,
    effort: u64,
    accept: &mut dyn FnMut(&With<Witness>) -> bool,
) -> Option<With<Witness>> {
    let mut session_statement = statement.clone();
    let (equations, laws) = equations(&mut session_statement);
    let mut models = models(&mut session_statement, &laws);
    if models.is_empty() {
        models.push(Vec::new());
    }
    let many = models.len() > 4;
    let (mut steps_left, mut tried) = (MOST_STEPS * effort, 0);
    let mut certificate_steps = MOST_CERTIFICATE_STEPS * effort;
    for functions in models {
        let functions = resolved(&mut session_statement, functions);
        if many && !laws_may_hold(&mut session_statement, &functions) {
            continue;
        }
        let mut search = Search {
            statement: session_statement.clone(),
            wanted,
            accept: &mut *accept,
            functions,
            table: Vec::new(),
            periods: periods(&mut session_statement.clone()),
            known_periods: Vec::new(),
            cases: MOST_CASES,
            effort,
            random: Sequence::new(7),
            declared: HashMap::new(),
            circles: speaks_of_circles(statement),
            spoken: numbers_about(statement),
            numbers: HashMap::new(),
            forms: HashMap::new(),
            expansion: Expansion::new(BTreeSet::new(), LARGEST_FORM),
            split: BTreeSet::new(),
            steps_left,
            certificate_steps,
            asks_left: MOST_ASKED,
            found: None,
        };
        let system = System {
            open: equations.clone(),
            solved: Vec::new(),
        };
        let Some(system) = search.put_in_functions(system) else {
            continue;
        };
        search.solve(system);
        if search.found.is_some() {
            return search.found;
        }
        (steps_left, certificate_steps) = (search.steps_left, search.certificate_steps);
        tried += 1;
        if tried >= MOST_MODELS {
            break;
        }
    }
    None
}

/// Named functions whose terms name no other of them.
fn resolved(statement: &mut Statement, functions: Vec<(Function, Symbol, Term)>) -> Vec<(Function, Symbol, Term)> {
    let mut resolved = functions;
    for _ in 0..4 {
        let known = resolved.clone();
        for (_, _, term) in &mut resolved {
            *term = statement.with_functions(*term, &known);
        }
        if known == resolved {
            break;
        }
    }
    resolved
}

/// Whether the laws hold of named functions in floating point, for some values of all else.
fn laws_may_hold(statement: &mut Statement, functions: &[(Function, Symbol, Term)]) -> bool {
    let mut laws = Vec::new();
    for given in statement.givens().to_vec() {
        let Some(Law {
            time: Some(time),
            interval: None,
            ..
        }) = given.law
        else {
            continue;
        };
        let term = statement.written_out(given.term);
        let term = statement.with_functions(term, functions);
        if values::values_of(statement, term).is_empty() {
            laws.push((time, term));
        }
    }
    let wanted: Vec<Term> = laws.iter().map(|(_, term)| *term).collect();
    let program = Program::new(statement.terms(), &wanted, !statement.is_complex());
    let symbols = statement.terms().symbols() as u32;
    (0..6_u32).any(|choice| {
        [0.3, 1.7, -0.7].iter().all(|&at| {
            let mut values: HashMap<Symbol, Complex> = (0..symbols)
                .map(|number| {
                    let value = match choice {
                        0 => 1.0,
                        1 => f64::from(1 + number % 2),
                        2 => f64::from(2 - number % 2),
                        3 => 0.0,
                        4 => -1.0,
                        _ => 0.37 + 0.61 * f64::from(number),
                    };
                    (Symbol(number), (value, 0.0))
                })
                .collect();
            for (time, _) in &laws {
                values.insert(*time, (at, 0.0));
            }
            let found = program.at(&values);
            found.iter().all(|value| !value.is_finite() || value.may_vanish())
        })
    })
}

/// What must vanish by the givens: premises, laws at the times spoken of, derivatives along maps.
fn equations(statement: &mut Statement) -> (Vec<Term>, Vec<Usable>) {
    let goals: Vec<Term> = statement.goal().iter().map(|(_, term)| *term).collect();
    let written: Vec<Term> = goals.iter().map(|goal| statement.written_out(*goal)).collect();
    let whole = proof::large_bases(statement);
    let mut small = Expansion::new(whole.iter().copied().collect(), LARGEST_GOAL);
    let mut session = Session::new(statement, whole, 2_000_000);
    // what is too large to be multiplied out has values all the same; derivatives have some even where they cancel
    let mut polynomials: Vec<Polynomial> = Vec::new();
    for goal in goals {
        match small.of(session.checker.statement.terms(), goal) {
            Ok(quotient) => polynomials.push(quotient.numerator),
            Err(_) => polynomials.extend(spoken_of(session.checker.statement.terms(), goal)),
        }
    }
    let inside = written
        .into_iter()
        .flat_map(|term| session.checker.statement.terms().inside(term));
    let inside: BTreeSet<Term> = inside.collect();
    polynomials.extend(
        inside
            .into_iter()
            .filter(|&term| session.is_partial(term))
            .map(Polynomial::generator),
    );
    let laws = proof::prepare_premises(&mut session, &polynomials);
    let mut found = Vec::new();
    let mut fact = 0;
    for step in session.steps.clone() {
        let adds = !matches!(step, Inference::Derivative(_) | Inference::Constant { .. });
        if !adds {
            continue;
        }
        if matches!(
            step,
            Inference::Given(_) | Inference::Law { .. } | Inference::Along { .. }
        ) && session
            .checker
            .facts
            .get(fact)
            .is_some_and(|fact| fact.property == Property::Zero)
        {
            let polynomial = session.polynomial(fact);
            if !polynomial.is_zero() {
                found.push(session.polynomial_term(&polynomial));
            }
        }
        fact += 1;
    }
    let found: Vec<Term> = found
        .into_iter()
        .map(|term| session.checker.statement.written_out(term))
        .collect();
    (found, laws)
}

/// The symbols and the values of functions in a term.
fn spoken_of(terms: &Terms, term: Term) -> Vec<Polynomial> {
    let is_generator = |inner: &Term| {
        matches!(
            terms.node(*inner),
            Node::Symbol(_) | Node::Value(..) | Node::Elementary(..)
        )
    };
    let inside = terms.inside(term).into_iter().filter(is_generator);
    inside.map(Polynomial::generator).collect()
}

/// The periods that laws declare.
fn periods(statement: &mut Statement) -> Vec<(Function, Term)> {
    let mut found = Vec::new();
    for given in statement.givens().to_vec() {
        let Some(Law {
            time: Some(time),
            interval: None,
            ..
        }) = given.law
        else {
            continue;
        };
        let term = statement.written_out(given.term);
        let Some(form) = numerator(statement, term) else {
            continue;
        };
        let [(a, x), (b, y)] = form.terms() else { continue };
        let single = |monomial: &kernel::Monomial| match monomial.as_slice() {
            [(generator, 1)] => match statement.terms().node(*generator) {
                Node::Value(function, 0, at) => Some((*function, *at)),
                _ => None,
            },
            _ => None,
        };
        let (Some((f, u)), Some((g, v))) = (single(a), single(b)) else {
            continue;
        };
        if f != g || *x != -y.clone() {
            continue;
        }
        let apart = statement.terms_mut().difference(u, v);
        let moves = statement.derivative(apart, time);
        if numerator(statement, moves).is_none_or(|form| !form.is_zero()) {
            continue;
        }
        let zero = statement.terms_mut().integer(0);
        let period = statement.terms_mut().substitute(apart, time, zero);
        let mut of = Some(f);
        while let Some(function) = of {
            found.push((function, period));
            of = statement.derivatives().get(&function).copied();
        }
    }
    found
}

fn numerator(statement: &Statement, term: Term) -> Option<Polynomial> {
    let quotient = Expansion::new(BTreeSet::new(), 3_000_000)
        .of(statement.terms(), term)
        .ok()?;
    Some(quotient.numerator)
}

/// Functions that laws give, as terms in the time; several sets of them where laws only bind them.
fn models(statement: &mut Statement, laws: &[Usable]) -> Vec<Vec<(Function, Symbol, Term)>> {
    let mut named: Vec<(Function, Symbol, Term)> = Vec::new();
    let mut bound: BTreeSet<Function> = BTreeSet::new();
    let time = statement.fresh("t");
    let running = statement.terms_mut().symbol(time);
    // the premises themselves before what was derived from them
    let (given, derived): (Vec<&Usable>, Vec<&Usable>) = laws.iter().partition(|law| law.is_given());
    // those of one function first: the others are named by what these give
    let spoken = |law: &&Usable| {
        let values = values::values_of(statement, law.term()).into_iter();
        values.map(|(function, ..)| function).collect::<BTreeSet<_>>().len()
    };
    let mut ordered: Vec<&Usable> = given;
    ordered.sort_by_cached_key(spoken);
    for law in ordered.into_iter().chain(derived) {
        let term = statement.terms_mut().substitute(law.term(), law.time(), running);
        let Some(form) = numerator(statement, term) else {
            continue;
        };
        let own = values::values_of(statement, term);
        for generator in form.generators() {
            let Node::Value(function, order, at) = *statement.terms().node(generator) else {
                continue;
            };
            let family = family(statement, function);
            let once = own.iter().filter(|(f, ..)| family.contains(f)).count() == 1;
            // one of a family gives the others
            if at != running || !once || named.iter().any(|(f, ..)| family.contains(f)) || order > 0 {
                continue;
            }
            // a law of flight says what the motion is, not what drives it
            let flies = matches!(
                statement.functions().get(function.0 as usize),
                Some(FunctionOf::Interval { .. })
            );
            if law.flies() && !flies {
                continue;
            }
            let coefficients = coefficients_in(&form, generator);
            let [rest, lead] = coefficients.as_slice() else {
                continue;
            };
            let steady = |part: &Term| {
                !statement.terms().holds(*part, time) && !matches!(statement.terms().node(*part), Node::Value(..))
            };
            let inside = |part: &Term| statement.terms().inside(*part).contains(&generator);
            if !lead.generators().iter().all(steady) || rest.generators().iter().any(inside) {
                continue;
            }
            let mut session = Session::new(statement, Vec::new(), 1000);
            let formula = ratio_term(&mut session, &rest.negated(), lead);
            named.push((function, time, formula));
            // what a law names one function by, it does not name another by in turn
            break;
        }
        // a law of flight binds the motion, not what drives it
        let lines = statement.functions().to_vec();
        let is_line = |f: &Function| matches!(lines.get(f.0 as usize), Some(FunctionOf::Line));
        bound.extend(own.iter().map(|(f, ..)| *f).filter(|f| !law.flies() || !is_line(f)));
    }
    for function in statement.derivatives().keys().copied().collect::<Vec<_>>() {
        if is_own_derivative(statement, function) {
            bound.insert(function);
        }
    }
    complete(statement, &mut named, time);
    // what other functions give, but not its integral, names nothing
    let derivatives = statement.derivatives().clone();
    let known: BTreeSet<Function> = named.iter().map(|(f, ..)| *f).collect();
    let is_whole = |inner: &Function| derivatives.iter().all(|(f, g)| g != inner || known.contains(f));
    named.retain(|(function, _, term)| {
        let family = family(statement, *function);
        let is_closed = family.iter().filter(|f| known.contains(f)).all(is_whole);
        is_closed || values::values_of(statement, *term).is_empty()
    });
    let covered: BTreeSet<Function> = named.iter().map(|(f, ..)| *f).collect();
    let periodic: BTreeSet<Function> = periods(statement).into_iter().map(|(f, _)| f).collect();
    let flights = statement.functions().to_vec();
    let is_line = |function: &Function| matches!(flights.get(function.0 as usize), Some(FunctionOf::Line));
    let simple: BTreeSet<Function> = simple_periodic(statement, laws);
    let open: Vec<Function> = bound
        .into_iter()
        .filter(|function| {
            !covered.contains(function)
                && is_line(function)
                && !(periodic.contains(function) && simple.contains(function))
        })
        .collect();
    if open.is_empty() {
        return vec![named];
    }
    // functions that laws bind to each other: simple ones are tried, the kernel tells which meet the laws
    candidates(statement, &named, &open, time)
}

/// Functions of which laws say nothing but a period.
fn simple_periodic(statement: &mut Statement, laws: &[Usable]) -> BTreeSet<Function> {
    let periodic = periods(statement);
    let mut counted: BTreeMap<Function, usize> = BTreeMap::new();
    for law in laws.iter().filter(|law| law.is_given()) {
        for (function, ..) in values::values_of(statement, law.term())
            .into_iter()
            .collect::<BTreeSet<_>>()
        {
            *counted.entry(function).or_default() += 1;
        }
    }
    periodic
        .into_iter()
        .map(|(function, _)| function)
        .filter(|function| counted.get(function).is_none_or(|&n| n <= 2))
        .collect()
}

/// Whether a function comes back among its derivatives.
fn is_own_derivative(statement: &Statement, function: Function) -> bool {
    let mut next = statement.derivatives().get(&function);
    for _ in 0..statement.derivatives().len() {
        match next {
            Some(&derivative) if derivative == function => return true,
            Some(derivative) => next = statement.derivatives().get(derivative),
            None => return false,
        }
    }
    false
}

/// A function with all that are declared its derivatives, or whose derivative it is, in turn.
pub(super) fn family(statement: &Statement, function: Function) -> BTreeSet<Function> {
    let mut family = BTreeSet::from([function]);
    loop {
        let size = family.len();
        for (&f, &g) in statement.derivatives() {
            if family.contains(&f) || family.contains(&g) {
                family.extend([f, g]);
            }
        }
        if family.len() == size {
            return family;
        }
    }
}

/// Names the derivatives and the integrals of functions that are named.
fn complete(statement: &mut Statement, named: &mut Vec<(Function, Symbol, Term)>, time: Symbol) {
    for _ in 0..6 {
        let derivatives: Vec<(Function, Function)> = statement.derivatives().iter().map(|(f, g)| (*f, *g)).collect();
        for (outer, inner) in derivatives {
            let of = |function: Function, named: &[(Function, Symbol, Term)]| {
                named.iter().find(|(f, ..)| *f == function).map(|(.., term)| *term)
            };
            match (of(outer, named), of(inner, named)) {
                (Some(term), None) => {
                    let slope = statement.derivative(term, time);
                    named.push((inner, time, slope));
                }
                (None, Some(term)) => {
                    let integral = match integral(statement, term, time) {
                        Some(integral) => integral,
                        None => {
                            let Some(integral) = integral_of_squares(statement, term, time) else {
                                continue;
                            };
                            // the function as the derivative; the law holds of it by Pythagoras
                            let slope = statement.derivative(integral, time);
                            for (function, _, term) in named.iter_mut() {
                                if *function == inner {
                                    *term = slope;
                                }
                            }
                            integral
                        }
                    };
                    let name = format!("c_{{{}}}", statement.terms().function_name(outer));
                    let constant = statement.fresh(&name);
                    let constant = statement.terms_mut().symbol(constant);
                    let integral = statement.terms_mut().sum(vec![integral, constant]);
                    named.push((outer, time, integral));
                }
                _ => {}
            }
        }
    }
}

/// An antiderivative, where no divisor holds the time.
fn integral(statement: &mut Statement, term: Term, time: Symbol) -> Option<Term> {
    let quotient = Expansion::new(BTreeSet::new(), 100_000)
        .of(statement.terms(), term)
        .ok()?;
    let mut session = Session::new(statement, Vec::new(), 1000);
    let mut integral = values::antiderivative_of(&mut session, &quotient.numerator, time)?;
    for (divisor, power) in &quotient.divisors {
        let below = session.polynomial_term(divisor);
        if session.checker.statement.terms().holds(below, time) {
            return None;
        }
        let below = session.terms().add(Node::Power(below, i32::try_from(*power).ok()?));
        integral = session.terms().quotient(integral, below);
    }
    Some(integral)
}

/// An antiderivative of the square of a sine or a cosine of an affine argument.
fn integral_of_squares(statement: &mut Statement, term: Term, time: Symbol) -> Option<Term> {
    let Node::Power(base, 2) = *statement.terms().node(term) else {
        return None;
    };
    let Node::Elementary(function, of) = *statement.terms().node(base) else {
        return None;
    };
    let slope = statement.derivative(of, time);
    if statement.terms().holds(slope, time) {
        return None;
    }
    let running = statement.terms_mut().symbol(time);
    let terms = statement.terms_mut();
    let (sine, cosine) = (
        terms.elementary(Elementary::Sin, of),
        terms.elementary(Elementary::Cos, of),
    );
    let product = terms.product(vec![sine, cosine]);
    let circular = terms.quotient(product, slope);
    let circular = match function {
        Elementary::Cos => circular,
        Elementary::Sin => terms.negative(circular),
        _ => return None,
    };
    let (sum, two) = (terms.sum(vec![running, circular]), terms.integer(2));
    Some(terms.quotient(sum, two))
}

/// Constants, lines, exponentials and circles for functions that laws bind to each other.
fn candidates(
    statement: &mut Statement,
    named: &[(Function, Symbol, Term)],
    open: &[Function],
    time: Symbol,
) -> Vec<Vec<(Function, Symbol, Term)>> {
    let parameters: Vec<Symbol> = (0_u32..)
        .map(Symbol)
        .zip(statement.quantities().to_vec())
        .filter(|(_, quantity)| matches!(quantity, Quantity::Parameter | Quantity::Index))
        .map(|(symbol, _)| symbol)
        .collect();
    let slope = statement.fresh("c");
    let terms = statement.terms_mut();
    let (t, coefficient) = (terms.symbol(time), terms.symbol(slope));
    let (one, two, pi) = (terms.integer(1), terms.integer(2), terms.add(Node::Pi));
    let mut rates = vec![one, pi, two];
    for parameter in parameters.into_iter().take(4) {
        let rate = terms.symbol(parameter);
        rates.push(rate);
        rates.push(terms.elementary(Elementary::Root(2), rate));
        rates.push(terms.quotient(pi, rate));
        let whole = terms.product(vec![two, pi]);
        rates.push(terms.quotient(whole, rate));
    }
    let line = terms.product(vec![coefficient, t]);
    let mut shapes = vec![one, t, line, terms.integer(0), terms.add(Node::Power(t, 2))];
    for rate in rates {
        let angle = terms.product(vec![rate, t]);
        let (sine, cosine) = (
            terms.elementary(Elementary::Sin, angle),
            terms.elementary(Elementary::Cos, angle),
        );
        shapes.extend([sine, cosine]);
        shapes.push(terms.elementary(Elementary::Exp, angle));
        let negative = terms.negative(angle);
        shapes.push(terms.elementary(Elementary::Exp, negative));
        shapes.push(terms.negative(sine));
        let (double, product) = (terms.product(vec![two, sine]), terms.product(vec![two, cosine]));
        shapes.extend([double, product]);
    }
    let mut sets = Vec::new();
    let others = [terms.integer(0), t];
    // one function leads, those that are derivatives follow; a second open family takes each shape too, further ones a few
    for &shape in &shapes {
        let mut set = named.to_vec();
        let mut left: Vec<Function> = open.to_vec();
        let Some(leader) = top(statement, &left) else { break };
        set.push((leader, time, shape));
        complete(statement, &mut set, time);
        left.retain(|function| !set.iter().any(|(f, ..)| f == function));
        let Some(second) = top(statement, &left) else {
            sets.push(set);
            continue;
        };
        for &other in &shapes {
            let mut set = set.clone();
            set.push((second, time, other));
            complete(statement, &mut set, time);
            let mut left = left.clone();
            left.retain(|function| !set.iter().any(|(f, ..)| f == function));
            if left.is_empty() {
                sets.push(set);
                continue;
            }
            for shape in others {
                let (mut set, mut left) = (set.clone(), left.clone());
                while let Some(next) = top(statement, &left) {
                    set.push((next, time, shape));
                    complete(statement, &mut set, time);
                    left.retain(|function| !set.iter().any(|(f, ..)| f == function));
                }
                sets.push(set);
            }
        }
    }
    sets.truncate(400);
    sets
}

/// Of these functions one that is no derivative of another.
fn top(statement: &Statement, of: &[Function]) -> Option<Function> {
    let derived: BTreeSet<Function> = statement
        .derivatives()
        .iter()
        .filter(|(f, _)| of.contains(f))
        .map(|(_, g)| *g)
        .collect();
    of.iter()
        .find(|function| !derived.contains(function))
        .or(of.first())
        .copied()
}

impl Search<'_> {
    /// Puts the named functions in. Values of other functions become symbols once their times are solved for.
    fn put_in_functions(&mut self, system: System) -> Option<System> {
        let open = system
            .open
            .into_iter()
            .map(|term| self.named(term))
            .collect::<Option<Vec<Term>>>()?;
        Some(System { open, ..system })
    }

    fn named(&mut self, term: Term) -> Option<Term> {
        let mut term = term;
        for _ in 0..4 {
            let next = self.statement.with_functions(term, &self.functions);
            if next == term {
                return Some(term);
            }
            term = next;
        }
        None
    }

    /// Solves what is open; samples where nothing is, or nothing more can be solved.
    fn solve(&mut self, mut system: System) {
        loop {
            if self.found.is_some() || self.steps_left == 0 || !self.drop_zeros(&mut system) {
                return;
            }
            // times first, so that values of functions at equal times are one
            let mut ways = if self.table.is_empty() {
                self.ways(&system, true)
            } else {
                Vec::new()
            };
            if ways.is_empty() {
                self.make_table(&mut system);
                if !self.drop_zeros(&mut system) {
                    return;
                }
                ways = self.ways(&system, false);
            }
            ways.truncate(self.cases + 1);
            let Some(last) = ways.pop() else { break };
            for way in ways {
                self.cases = self.cases.saturating_sub(1);
                let table = self.table.clone();
                let mut case = system.clone();
                self.follow(&mut case, way);
                self.solve(case);
                if self.found.is_some() {
                    return;
                }
                self.table = table;
            }
            self.follow(&mut system, last);
        }
        self.sample(&system);
    }

    /// Drops equations that hold; `false` where one cannot.
    fn drop_zeros(&mut self, system: &mut System) -> bool {
        let mut kept = Vec::new();
        for term in std::mem::take(&mut system.open) {
            match self.form(term) {
                Some(form) if form.is_zero() => {}
                Some(form) if form.as_constant().is_some() => return false,
                _ if kept.contains(&term) => {}
                _ => kept.push(term),
            }
        }
        system.open = kept;
        true
    }

    /// The primitive numerator of a term, where it is small.
    fn form(&mut self, term: Term) -> Option<Polynomial> {
        if let Some(known) = self.forms.get(&term) {
            return known.clone();
        }
        self.expansion.effort = LARGEST_FORM;
        let quotient = self.expansion.of(self.statement.terms(), term);
        let form = quotient
            .ok()
            .map(|quotient| self.without_imaginary_squares(&quotient.numerator))
            .map(|form| primitive(&form).map_or(form.clone(), |(_, part)| part));
        let cost = form.as_ref().map_or(LARGEST_FORM, |form| 1 + form.terms().len() as u64);
        self.steps_left = self.steps_left.saturating_sub(cost);
        self.forms.insert(term, form.clone());
        form
    }

    fn without_imaginary_squares(&mut self, form: &Polynomial) -> Polynomial {
        if !self.statement.is_complex() {
            return form.clone();
        }
        let unit = self.statement.terms_mut().add(Node::Imaginary);
        let reduced = form.terms().iter().map(|(monomial, value)| {
            let power = monomial.iter().find(|(term, _)| *term == unit).map_or(0, |part| part.1);
            let mut rest: Vec<(Term, u32)> = monomial.iter().copied().filter(|(term, _)| *term != unit).collect();
            if power % 2 == 1 {
                rest.push((unit, 1));
                rest.sort();
            }
            let value = if power % 4 >= 2 { -value.clone() } else { value.clone() };
            (rest.into_iter().collect(), value)
        });
        Polynomial::from_terms(reduced.collect::<Vec<_>>())
    }

    /// The ways to go on with the equation that is easiest to solve: cases that together cover it.
    fn ways(&mut self, system: &System, times: bool) -> Vec<Way> {
        type Rank = (u8, u8, usize);
        let mut best: Option<(Rank, usize, Polynomial, Term)> = None;
        for (number, &term) in system.open.iter().enumerate() {
            if times && !values::values_of(&self.statement, term).is_empty() {
                continue;
            }
            let Some(form) = self.form(term) else { continue };
            if form.terms().len() > 300 {
                continue;
            }
            if let Some(factors) = self.split(term, &form) {
                let some = factors.iter().any(|&factor| !self.is_generic_only(factor));
                let kept = factors
                    .into_iter()
                    .filter(|&factor| !some || !self.is_generic_only(factor));
                return kept.map(|factor| Way::Instead(number, factor)).collect();
            }
            for generator in form.generators() {
                if let Some(rank) = self.rank(&form, generator)
                    && best.as_ref().is_none_or(|(known, ..)| rank < *known)
                {
                    best = Some((rank, number, form.clone(), generator));
                }
            }
        }
        if let Some((number, form, generator)) = self.single_complex(system) {
            best = Some(((0, 0, 0), number, form, generator));
        }
        let Some((_, number, form, generator)) = best else {
            return Vec::new();
        };
        let mut ways = self.solutions(number, &form, generator);
        if ways.is_empty() {
            // one that cannot be solved after all is only met by sampling
            self.forms.insert(system.open[number], None);
            return self.ways(system, times);
        }
        ways.dedup();
        ways
    }

    /// A complex symbol that a single equation speaks of, a quadratic one with a number as leading coefficient: it has
    /// a value whatever all else is.
    fn single_complex(&mut self, system: &System) -> Option<(usize, Polynomial, Term)> {
        for symbol in self.statement.complex_symbols().to_vec() {
            let holds = |term: &Term| self.statement.terms().holds(*term, symbol);
            let mut speaking = system.open.iter().enumerate().filter(|(_, term)| holds(term));
            let (Some((number, &term)), None) = (speaking.next(), speaking.next()) else {
                continue;
            };
            let own = matches!(
                self.statement.quantity(symbol),
                Some(Quantity::Parameter | Quantity::Index)
            );
            if !own || !self.statement.is_complex() || system.solved.iter().any(|(_, term)| holds(term)) {
                continue;
            }
            let Some(form) = self.form(term) else { continue };
            let generator = self.statement.terms_mut().symbol(symbol);
            let coefficients = coefficients_in(&form, generator);
            let lead = coefficients.last().and_then(Polynomial::as_constant);
            let inside = |other: &Term| *other != generator && self.statement.terms().holds(*other, symbol);
            if coefficients.len() == 3 && lead.is_some() && !form.generators().iter().any(inside) {
                return Some((number, form, generator));
            }
        }
        None
    }

    /// The factors of an equation, where it has several or a square.
    fn split(&mut self, term: Term, form: &Polynomial) -> Option<Vec<Term>> {
        if !self.split.insert(term) || form.terms().len() > 60 {
            return None;
        }
        let mut steps = Steps::new(100_000);
        let found = factors(form, &[], &mut steps).ok()?;
        self.steps_left = self.steps_left.saturating_sub(20);
        let trivial = matches!(found.factors.as_slice(), [(_, 1)] | []);
        if trivial {
            return None;
        }
        let mut statement = std::mem::take(&mut self.statement);
        let mut session = Session::new(&mut statement, Vec::new(), 1000);
        let parts = found.factors.iter().map(|(factor, _)| session.polynomial_term(factor));
        let parts = parts.collect();
        self.statement = statement;
        Some(parts)
    }

    /// How easily an equation is solved for a generator; the lower the better.
    fn rank(&self, form: &Polynomial, generator: Term) -> Option<(u8, u8, usize)> {
        let terms = self.statement.terms();
        let generic = !self.statement.generic().is_empty();
        let degree = degree_in(form, generator);
        let alone = |symbol: Symbol| {
            !form
                .generators()
                .iter()
                .any(|&other| other != generator && terms.holds(other, symbol))
        };
        match terms.node(generator) {
            Node::Symbol(symbol) => {
                let preference = preference(&self.statement, *symbol);
                if preference == u8::MAX || !alone(*symbol) {
                    return None;
                }
                let coefficients = coefficients_in(form, generator);
                let lead = coefficients.last()?;
                let class = match degree {
                    1 if lead.as_constant().is_some() => 0,
                    1 if form.terms().len() < 40 => 1,
                    2 if !generic && form.terms().len() < 20 => 3,
                    _ if !generic
                        && form.terms().len() < 20
                        && coefficients[1..coefficients.len() - 1].iter().all(Polynomial::is_zero) =>
                    {
                        4
                    }
                    1 => 5,
                    _ => return None,
                };
                Some((class, preference, lead.terms().len() + form.terms().len()))
            }
            Node::Elementary(..) if degree == 1 && !generic => {
                let symbol = self.undoable(generator, &alone)?;
                Some((2, preference(&self.statement, symbol), form.terms().len()))
            }
            _ => None,
        }
    }

    /// The symbol for which the argument of a function is solved.
    fn undoable(&self, generator: Term, alone: &dyn Fn(Symbol) -> bool) -> Option<Symbol> {
        let terms = self.statement.terms();
        let Node::Elementary(_, of) = terms.node(generator) else {
            return None;
        };
        let quotient = Expansion::new(BTreeSet::new(), 10_000).of(terms, *of).ok()?;
        let form = quotient.numerator;
        let divisors = quotient.divisors;
        form.generators().into_iter().find_map(|term| match terms.node(term) {
            Node::Symbol(symbol)
                if degree_in(&form, term) == 1
                    && alone(*symbol)
                    && !divisors.iter().any(|(divisor, _)| degree_in(divisor, term) > 0)
                    && preference(&self.statement, *symbol) != u8::MAX
                    && !form
                        .generators()
                        .iter()
                        .any(|&other| other != term && terms.holds(other, *symbol)) =>
            {
                Some(*symbol)
            }
            _ => None,
        })
    }

    fn is_generic_only(&self, term: Term) -> bool {
        let generic = self.statement.generic();
        !generic.is_empty()
            && self
                .statement
                .terms()
                .inside(term)
                .iter()
                .all(|&inner| match self.statement.terms().node(inner) {
                    Node::Symbol(symbol) => generic.contains(symbol),
                    Node::Value(..) => false,
                    _ => true,
                })
    }

    fn follow(&mut self, system: &mut System, way: Way) {
        match way {
            Way::Instead(number, term) => system.open[number] = term,
            Way::Also(term) => system.open.push(term),
            Way::Put(number, symbol, solution) => {
                system.open.remove(number);
                let terms = self.statement.terms_mut();
                let known = terms.len();
                for term in &mut system.open {
                    *term = terms.substitute(*term, symbol, solution);
                }
                for (_, term) in &mut system.solved {
                    *term = terms.substitute(*term, symbol, solution);
                }
                system.solved.push((symbol, solution));
                for (_, _, time, _) in &mut self.table {
                    *time = terms.substitute(*time, symbol, solution);
                }
                let met = system.open.len() + system.solved.len() + terms.len() - known;
                self.steps_left = self.steps_left.saturating_sub(met as u64 / MET_IN_A_STEP);
            }
        }
    }

    /// The ways to solve an equation for a generator.
    fn solutions(&mut self, number: usize, form: &Polynomial, generator: Term) -> Vec<Way> {
        let coefficients = coefficients_in(form, generator);
        let mut statement = std::mem::take(&mut self.statement);
        let mut session = Session::new(&mut statement, Vec::new(), 1000);
        let mut ways = Vec::new();
        let mut leads = Vec::new();
        match session.node(generator) {
            Node::Symbol(symbol) => {
                let lead = coefficients.last().cloned().unwrap_or_default();
                if lead.as_constant().is_none() {
                    leads.push(session.polynomial_term(&lead));
                }
                let is_complex = session.checker.statement.complex_symbols().contains(&symbol);
                let found = match coefficients.as_slice() {
                    [rest, lead] => vec![ratio_term(&mut session, &rest.negated(), lead)],
                    [c, b, a] => {
                        // (-b + sqrt(b^2 - 4ac)) / 2a
                        let four = Rational::from_ratio(4, 1);
                        let radicand = b.times(b).minus(&a.times(c).scaled(&four));
                        let root = root_term(&mut session, &radicand, &Polynomial::integer(1), 2);
                        let b = session.polynomial_term(b);
                        let below = session.polynomial_term(&a.scaled(&Rational::from_ratio(2, 1)));
                        let terms = session.terms();
                        let other = terms.negative(root);
                        [root, other]
                            .into_iter()
                            .map(|root| {
                                let above = terms.difference(root, b);
                                terms.quotient(above, below)
                            })
                            .collect()
                    }
                    _ => {
                        let index = u32::try_from(coefficients.len() - 1).unwrap_or(2);
                        let root = root_term(&mut session, &coefficients[0].negated(), &lead, index);
                        let terms = session.terms();
                        let mut found = vec![root];
                        if index % 2 == 0 {
                            found.push(terms.negative(root));
                        }
                        if is_complex {
                            let unit = terms.add(Node::Imaginary);
                            let factor = match index {
                                3 => {
                                    let (three, minus) = (terms.integer(3), terms.integer(-1));
                                    let root = terms.elementary(Elementary::Root(2), three);
                                    let imaginary = terms.product(vec![root, unit]);
                                    let above = terms.sum(vec![minus, imaginary]);
                                    let two = terms.integer(2);
                                    Some(terms.quotient(above, two))
                                }
                                4 => Some(unit),
                                _ => None,
                            };
                            if let Some(factor) = factor {
                                found.push(terms.product(vec![factor, root]));
                            }
                        }
                        found
                    }
                };
                ways.extend(found.into_iter().map(|term| (symbol, term)));
            }
            Node::Elementary(function, of) => {
                let wanted = ratio_term(&mut session, &coefficients[0].negated(), &coefficients[1]);
                if coefficients[1].as_constant().is_none() {
                    leads.push(session.polynomial_term(&coefficients[1]));
                }
                self.statement = std::mem::take(session.checker.statement);
                let alone = |symbol: Symbol| {
                    !form
                        .generators()
                        .iter()
                        .any(|&other| other != generator && self.statement.terms().holds(other, symbol))
                };
                let symbol = self.undoable(generator, &alone);
                statement = std::mem::take(&mut self.statement);
                session = Session::new(&mut statement, Vec::new(), 1000);
                if let Some(symbol) = symbol {
                    for argument in arguments(&mut session, function, wanted) {
                        if let Some(solution) = solved_affine(&mut session, of, symbol, argument) {
                            ways.push((symbol, solution));
                        }
                    }
                }
            }
            _ => {}
        }
        self.statement = statement;
        let mut found = Vec::new();
        for (symbol, term) in ways {
            if let Some(term) = self.made_real(symbol, term) {
                found.push(Way::Put(number, symbol, term));
            }
        }
        if !found.is_empty() {
            for lead in leads {
                if !self.is_generic_only(lead) {
                    found.push(Way::Also(lead));
                }
            }
        }
        found
    }

    /// The term without the imaginary unit, for a symbol that is real; `None` where it is not.
    fn made_real(&mut self, symbol: Symbol, term: Term) -> Option<Term> {
        let terms = self.statement.terms();
        let holds_unit = |term: Term, terms: &kernel::Terms| {
            terms
                .inside(term)
                .iter()
                .any(|&inner| *terms.node(inner) == Node::Imaginary)
        };
        if self.statement.complex_symbols().contains(&symbol) || !holds_unit(term, terms) {
            return Some(term);
        }
        let quotient = Expansion::new(BTreeSet::new(), LARGEST_FORM).of(terms, term).ok()?;
        if !quotient.divisors.is_empty() {
            return None;
        }
        let form = self.without_imaginary_squares(&quotient.numerator);
        let mut statement = std::mem::take(&mut self.statement);
        let mut session = Session::new(&mut statement, Vec::new(), 1000);
        let term = session.polynomial_term(&form);
        self.statement = statement;
        (!holds_unit(term, self.statement.terms())).then_some(term)
    }

    /// Makes the values of functions at single times symbols of their own, one for each time.
    fn make_table(&mut self, system: &mut System) {
        let mut known = Vec::new();
        for (function, period) in self.periods.clone() {
            let written = self.statement.written_out(period);
            known.push((function, self.with_solved(written, system)));
        }
        self.known_periods = known;
        let mut wanted: BTreeSet<(Function, u32, Term)> = BTreeSet::new();
        for &term in &system.open {
            wanted.extend(values::values_of(&self.statement, term));
        }
        let goals: Vec<Term> = self.statement.goal().iter().map(|(_, term)| *term).collect();
        let others: Vec<Term> = self
            .statement
            .givens()
            .iter()
            .filter(|given| given.law.is_none())
            .map(|given| given.term)
            .collect();
        for term in goals.into_iter().chain(others) {
            let term = self.statement.written_out(term);
            let Some(term) = self.named(term) else { continue };
            let term = self.with_solved(term, system);
            wanted.extend(values::values_of(&self.statement, term));
        }
        for (function, order, at) in wanted {
            if self.lookup(function, order, at).is_none() {
                let name = format!(
                    "{}({})",
                    self.statement.terms().function_name(function),
                    self.statement.terms().len()
                );
                let symbol = self.statement.fresh(&name);
                // functions that are derivatives of each other have their values at the same times
                let at = self.known_time(function, at).unwrap_or(at);
                self.table.push((function, order, at, symbol));
            }
        }
        for number in 0..system.open.len() {
            system.open[number] = self.with_table(system.open[number]);
        }
    }

    fn with_solved(&mut self, term: Term, system: &System) -> Term {
        let solved: HashMap<Symbol, Term> = system.solved.iter().copied().collect();
        self.statement.terms_mut().rewrite(term, &mut |_, node| match node {
            Node::Symbol(symbol) => solved.get(symbol).copied(),
            _ => None,
        })
    }

    fn with_table(&mut self, term: Term) -> Term {
        let mut statement = std::mem::take(&mut self.statement);
        let result = {
            let values = values::values_of(&statement, term);
            let mut by: HashMap<(Function, u32, Term), Term> = HashMap::new();
            self.statement = statement;
            for (function, order, at) in values {
                if let Some(symbol) = self.lookup(function, order, at) {
                    let symbol = self.statement.terms_mut().symbol(symbol);
                    by.insert((function, order, at), symbol);
                }
            }
            statement = std::mem::take(&mut self.statement);
            statement.terms_mut().rewrite(term, &mut |_, node| match node {
                Node::Value(function, order, at) => by.get(&(*function, *order, *at)).copied(),
                _ => None,
            })
        };
        self.statement = statement;
        result
    }

    /// The symbol for a value at a time that is the same, but for whole periods.
    fn lookup(&mut self, function: Function, order: u32, at: Term) -> Option<Symbol> {
        let table = self.table.clone().into_iter();
        for (_, _, time, symbol) in table.filter(|(f, n, ..)| (*f, *n) == (function, order)) {
            if self.is_same_time(function, at, time) {
                return Some(symbol);
            }
        }
        None
    }

    /// A time of the table for a function of the same family that is the same, but for whole periods.
    fn known_time(&mut self, function: Function, at: Term) -> Option<Term> {
        let family = family(&self.statement, function);
        let table = self.table.clone().into_iter();
        table
            .filter(|(f, ..)| family.contains(f))
            .map(|(_, _, time, _)| time)
            .find(|&time| self.is_same_time(function, at, time))
    }

    /// Whether two times are the same for a function, but for whole periods of it.
    fn is_same_time(&mut self, function: Function, at: Term, time: Term) -> bool {
        let apart = self.statement.terms_mut().difference(at, time);
        if numerator(&self.statement, apart).is_some_and(|form| form.is_zero()) {
            return true;
        }
        let period = self
            .known_periods
            .iter()
            .find(|(f, _)| *f == function)
            .map(|(_, period)| *period);
        let Some(period) = period else {
            return false;
        };
        let turns = self.statement.terms_mut().quotient(apart, period);
        let Ok(quotient) = Expansion::new(BTreeSet::new(), 100_000).of(self.statement.terms(), turns) else {
            return false;
        };
        let whole = match quotient.divisors.as_slice() {
            [] => quotient.numerator.as_constant(),
            [(divisor, 1)] => ratio(&quotient.numerator, divisor),
            _ => None,
        };
        whole.is_some_and(|turns| *turns.0.denominator() == dashu_int::UBig::ONE)
    }

    /// Tries numbers for what is free.
    fn sample(&mut self, system: &System) {
        let free = self.free_symbols(system);
        let conditions = self.conditions(system);
        let goals = self.statement.goal().to_vec();
        let goals = goals
            .into_iter()
            .filter_map(|(property, term)| Some((property, self.translated(term, system)?)));
        let goals: Vec<(Property, Term)> = goals.collect();
        let mut vanishing = system.open.clone();
        vanishing.extend(self.laws_at_times(system));
        let wanted: Vec<Term> = vanishing
            .iter()
            .copied()
            .chain(conditions.iter().chain(&goals).map(|(_, term)| *term))
            .collect();
        let program = Program::new(self.statement.terms(), &wanted, !self.statement.is_complex());
        let (mut asked, mut met, mut holds) = (0, 0, None);
        let special = self.special_points(&free);
        let specials = special.len();
        let most = specials + MOST_SAMPLES * usize::try_from(self.effort.min(8)).unwrap_or(1);
        for attempt in 0..most {
            let chosen: Vec<(Symbol, Term)> = match special.get(attempt) {
                Some(point) => point.clone(),
                None if free.is_empty() => break,
                None => free
                    .iter()
                    .map(|symbol| (*symbol, self.number_for(*symbol, attempt - specials)))
                    .collect(),
            };
            let symbols: HashMap<Symbol, Complex> = chosen
                .iter()
                .map(|(symbol, number)| (*symbol, self.number_value(*number)))
                .collect();
            let values = program.at(&symbols);
            let (open, rest) = values.split_at(vanishing.len());
            let (bounds, claims) = rest.split_at(conditions.len());
            let sure = free.is_empty();
            if !open
                .iter()
                .all(|value| sure || value.value.0.is_nan() || value.may_vanish())
                || !conditions
                    .iter()
                    .zip(bounds)
                    .all(|((property, _), value)| may_hold(*property, *value))
            {
                continue;
            }
            let fails = goals
                .iter()
                .zip(claims)
                .any(|((property, _), value)| !may_hold(*property, *value) || barely_fails(*property, *value));
            let near = conditions.iter().chain(&goals).map(|(_, term)| *term).zip(rest);
            let near = near.filter(|(_, value)| value.may_vanish()).map(|(term, _)| term);
            let near: Vec<Term> = near.collect();
            if !fails && !sure {
                met += 1;
                match self.wanted {
                    Wanted::Failure if attempt >= specials && met >= ENOUGH_SAMPLES => return,
                    Wanted::Failure => continue,
                    Wanted::Either if met < FEW_SAMPLES => {
                        holds.get_or_insert((chosen, near));
                        continue;
                    }
                    _ => {}
                }
            }
            let (chosen, near) = match holds.take() {
                Some(first) if !fails => first,
                _ => (chosen, near),
            };
            asked += 1;
            if self.ask(system, &chosen, &near) || asked >= ASKED_OF_CASE || self.asks_left == 0 {
                return;
            }
        }
        if let Some((chosen, near)) = holds {
            self.ask(system, &chosen, &near);
        }
    }

    /// Whether the kernel takes a choice of numbers.
    fn ask(&mut self, system: &System, chosen: &[(Symbol, Term)], near: &[Term]) -> bool {
        self.asks_left = self.asks_left.saturating_sub(1);
        if let Some(witness) = self.witness(system, chosen, near)
            && (self.accept)(&witness)
        {
            self.found = Some(witness);
        }
        self.found.is_some()
    }

    fn number_value(&mut self, number: Term) -> Complex {
        let terms = self.statement.terms();
        *self.numbers.entry(number).or_insert_with(|| {
            let values = Program::new(terms, &[number], false).at(&HashMap::new());
            values.first().map_or((f64::NAN, 0.0), |value| value.value)
        })
    }

    /// What laws say of named functions at some times, and at the running time of the claim.
    fn laws_at_times(&mut self, system: &System) -> Vec<Term> {
        let mut found = Vec::new();
        if self.functions.is_empty() {
            return found;
        }
        for given in self.statement.givens().to_vec() {
            let Some(Law {
                time: Some(time),
                interval: None,
                ..
            }) = given.law
            else {
                continue;
            };
            let Some(term) = self.named_law(given.term, system) else {
                continue;
            };
            for (above, below) in [(3, 10), (17, 10), (-7, 10)] {
                let terms = self.statement.terms_mut();
                let number = terms.number(Rational::from_ratio(above, below));
                found.push(terms.substitute(term, time, number));
            }
        }
        found
    }

    /// A law with the named functions put in; `None` where it speaks of others.
    fn named_law(&mut self, term: Term, system: &System) -> Option<Term> {
        let term = self.statement.written_out(term);
        let term = self.named(term)?;
        let term = self.with_solved(term, system);
        values::values_of(&self.statement, term).is_empty().then_some(term)
    }

    /// Points of simple numbers, which random ones miss: all alike, single ones special, all pairs of two.
    fn special_points(&mut self, free: &[Symbol]) -> Vec<Vec<(Symbol, Term)>> {
        let mut points: Vec<Vec<(Symbol, Term)>> = Vec::new();
        let choices: Vec<Vec<Term>> = free.iter().map(|&symbol| self.special_numbers(symbol)).collect();
        let mut plain: Vec<(Symbol, Term)> = Vec::new();
        for (place, &symbol) in free.iter().enumerate() {
            let impact = self.statement.instant_of(symbol).map(|(_, index)| i64::from(index));
            let number = match impact {
                Some(index) => self.statement.terms_mut().integer(index),
                None => {
                    let order = [1, 3, 2, 0];
                    let wanted = order[place % order.len()].min(choices[place].len() - 1);
                    choices[place][wanted]
                }
            };
            plain.push((symbol, number));
        }
        points.push(plain.clone());
        let most = choices.iter().map(Vec::len).max().unwrap_or(0);
        for n in 0..most {
            let alike = free.iter().zip(&choices);
            points.push(
                alike
                    .map(|(&symbol, numbers)| (symbol, numbers[n % numbers.len()]))
                    .collect(),
            );
        }
        for (place, numbers) in choices.iter().enumerate() {
            for &number in numbers {
                let mut point = plain.clone();
                point[place].1 = number;
                points.push(point);
                if points.len() > 120 {
                    return points;
                }
            }
        }
        if let [first, second] = choices.as_slice() {
            for &a in first {
                for &b in second {
                    points.push(vec![(free[0], a), (free[1], b)]);
                }
            }
        }
        points
    }

    /// Simple numbers for a symbol.
    fn special_numbers(&mut self, symbol: Symbol) -> Vec<Term> {
        let Declared { positive, integer, .. } = self.declared(symbol);
        let circles = self.circles;
        let complex = self.statement.complex_symbols().contains(&symbol);
        let terms = self.statement.terms_mut();
        let mut numbers = vec![(0, 1), (1, 1), (2, 1), (3, 1)];
        if !integer {
            numbers.push((1, 2));
        }
        if !positive {
            numbers.extend([(-1, 1), (-2, 1)]);
        }
        let mut found: Vec<Term> = numbers
            .into_iter()
            .map(|(above, below)| terms.number(Rational::from_ratio(above, below)))
            .collect();
        for number in &self.spoken {
            let fits = (!positive || *number > Rational::zero())
                && (!integer || *number.0.denominator() == dashu_int::UBig::ONE);
            if fits {
                found.push(terms.number(number.clone()));
            }
        }
        if circles && !integer {
            let pi = terms.add(Node::Pi);
            found.push(pi);
            for (above, below) in [(1, 2), (2, 1), (1, 4), (1, 3), (-1, 2), (3, 2)] {
                if above < 0 && positive {
                    continue;
                }
                let factor = terms.number(Rational::from_ratio(above, below));
                found.push(terms.product(vec![factor, pi]));
            }
        }
        if complex {
            let unit = terms.add(Node::Imaginary);
            let (negative, one) = (terms.negative(unit), terms.integer(1));
            found.extend([unit, negative, terms.sum(vec![one, unit])]);
        }
        found
    }

    fn declared(&mut self, symbol: Symbol) -> Declared {
        if let Some(known) = self.declared.get(&symbol) {
            return *known;
        }
        let terms = self.statement.terms();
        let is_symbol = |term: Term| matches!(terms.node(term), Node::Symbol(known) if *known == symbol);
        let mut declared = Declared::default();
        for given in self.statement.givens().iter().filter(|given| given.law.is_none()) {
            match given.property {
                Property::Positive | Property::NonNegative if is_symbol(given.term) => declared.positive = true,
                Property::Integer if is_symbol(given.term) => declared.integer = true,
                Property::NonNegative if terms.holds(given.term, symbol) => {
                    declared.at_most_one |= numerator(&self.statement, given.term).is_some_and(|form| {
                        let one = |(monomial, value): &(kernel::Monomial, dashu_ratio::RBig)| {
                            monomial.is_empty() && *value == dashu_ratio::RBig::ONE
                        };
                        let generators = form.generators();
                        generators.len() == 1
                            && is_symbol(generators[0])
                            && form.terms().len() == 2
                            && form.terms().iter().any(one)
                    });
                }
                _ => {}
            }
        }
        self.declared.insert(symbol, declared);
        declared
    }

    fn translated(&mut self, term: Term, system: &System) -> Option<Term> {
        let term = self.statement.written_out(term);
        let term = self.named(term)?;
        let term = self.with_solved(term, system);
        Some(self.with_table(term)).map(|term| self.with_solved(term, system))
    }

    /// What must hold at the point besides equations.
    fn conditions(&mut self, system: &System) -> Vec<(Property, Term)> {
        let givens: Vec<(Property, Term)> = self
            .statement
            .givens()
            .iter()
            .filter(|given| given.law.is_none() && given.property != Property::Zero)
            .filter(|given| self.wanted != Wanted::PremisesAlone || given.origin != Origin::ClaimDomain)
            .map(|given| (given.property, given.term))
            .collect();
        let mut conditions: Vec<(Property, Term)> = givens
            .into_iter()
            .filter_map(|(property, term)| Some((property, self.translated(term, system)?)))
            .collect();
        for (_, term) in &system.solved {
            for condition in self.statement.domain(*term) {
                conditions.push(condition);
            }
        }
        if !self.statement.generic().is_empty() {
            // no bound is just met: that would be a thin set
            for (property, _) in &mut conditions {
                if *property == Property::NonNegative {
                    *property = Property::Positive;
                }
            }
        }
        conditions.extend(self.times_apart(system));
        conditions
    }

    /// Times at which a function has values of its own are different, but for whole periods too.
    fn times_apart(&mut self, system: &System) -> Vec<(Property, Term)> {
        let mut apart = Vec::new();
        for (n, (f, _, a, _)) in self.table.clone().iter().enumerate() {
            let family = family(&self.statement, *f);
            for (g, _, b, _) in self.table.clone().iter().skip(n + 1) {
                if !family.contains(g) || a == b {
                    continue;
                }
                let period = self
                    .periods
                    .iter()
                    .find(|(f, _)| family.contains(f))
                    .map(|found| found.1);
                let terms = self.statement.terms_mut();
                let mut term = terms.difference(*a, *b);
                if let Some(period) = period {
                    let pi = terms.add(Node::Pi);
                    let turns = terms.quotient(term, period);
                    let angle = terms.product(vec![pi, turns]);
                    term = terms.elementary(Elementary::Sin, angle);
                }
                if let Some(term) = self.translated(term, system) {
                    apart.push((Property::Nonzero, term));
                }
            }
        }
        apart
    }

    fn free_symbols(&mut self, system: &System) -> Vec<Symbol> {
        let solved: BTreeSet<Symbol> = system.solved.iter().map(|(symbol, _)| *symbol).collect();
        let mut met: BTreeSet<Symbol> = BTreeSet::new();
        let mut terms: Vec<Term> = system.solved.iter().map(|(_, term)| *term).collect();
        terms.extend(&system.open);
        terms.extend(self.table.iter().map(|(_, _, time, _)| *time));
        let statement_terms: Vec<Term> = self
            .statement
            .givens()
            .iter()
            .map(|given| given.term)
            .chain(self.statement.goal().iter().map(|(_, term)| *term))
            .collect();
        let running: BTreeSet<Symbol> = self
            .statement
            .givens()
            .iter()
            .filter_map(|given| given.law.as_ref().and_then(|law| law.time))
            .collect();
        for term in statement_terms {
            let term = self.statement.written_out(term);
            if let Some(term) = self.named(term) {
                terms.push(term);
            }
            terms.push(term);
        }
        terms.extend(self.functions.iter().map(|(.., term)| *term));
        met.extend(self.table.iter().map(|(.., symbol)| *symbol));
        for term in terms {
            for inner in self.statement.terms().inside(term) {
                if let Node::Symbol(symbol) = self.statement.terms().node(inner) {
                    met.insert(*symbol);
                }
            }
        }
        let own: BTreeSet<Symbol> = self.functions.iter().map(|(_, time, _)| *time).collect();
        let goal_runs = |symbol: &Symbol, search: &Self| {
            search
                .statement
                .goal()
                .iter()
                .any(|(_, term)| search.statement.terms().holds(*term, *symbol))
        };
        met.into_iter()
            .filter(|symbol| !solved.contains(symbol) && !own.contains(symbol))
            .filter(|symbol| !self.statement.definitions().contains_key(symbol))
            .filter(|symbol| !running.contains(symbol) || goal_runs(symbol, self))
            .collect()
    }

    /// A number for a symbol: small ones first, then more of them.
    fn number_for(&mut self, symbol: Symbol, attempt: usize) -> Term {
        let Declared {
            positive,
            integer,
            at_most_one,
        } = self.declared(symbol);
        let spread = 3 + attempt / 40;
        let mut pick = |most: usize| (self.random.draw() % most.max(1) as u64) as i64;
        let closed = attempt % 5 == 4;
        if let Some((_, index)) = self.statement.instant_of(symbol) {
            // impacts follow each other
            let number = Rational::from_ratio(8 * i64::from(index) + pick(8), 8);
            return self.statement.terms_mut().number(number);
        }
        if at_most_one && positive {
            let above = pick(spread) + 1;
            let number = Rational::from_ratio(above, above + pick(spread) + 1);
            return self.statement.terms_mut().number(number);
        }
        let (above, below) = match (positive, integer) {
            (true, true) => (pick(spread + 2) + 1, 1),
            (false, true) => (pick(2 * spread + 1) - spread as i64, 1),
            (true, false) => (pick(2 * spread) + 1, pick(spread) + 1),
            (false, false) => (pick(4 * spread + 1) - 2 * spread as i64, pick(spread) + 1),
        };
        let has_functions = closed && !integer;
        let number = self.statement.terms_mut().number(Rational::from_ratio(above, below));
        if has_functions && self.circles {
            // multiples of pi, where circles are spoken of
            let count = [1, 2, 3, 4, 6, 12][(self.random.draw() % 6) as usize];
            let terms = self.statement.terms_mut();
            let (pi, factor) = (terms.add(Node::Pi), terms.number(Rational::from_ratio(above, count)));
            return terms.product(vec![factor, pi]);
        }
        number
    }

    /// The named functions, and 0 for those of which nothing speaks but laws.
    fn functions_with_silent_ones(&mut self) -> Vec<(Function, Symbol, Term)> {
        let mut functions = self.functions.clone();
        let spoken: BTreeSet<Function> = functions
            .iter()
            .map(|(f, ..)| *f)
            .chain(self.table.iter().map(|(f, ..)| *f))
            .collect();
        let lines = self.statement.functions().to_vec();
        for (number, of) in (0_u32..).zip(&lines) {
            let function = Function(number);
            let is_silent = matches!(of, FunctionOf::Line) && family(&self.statement, function).is_disjoint(&spoken);
            if is_silent {
                let time = self.statement.fresh("t");
                let zero = self.statement.terms_mut().integer(0);
                functions.push((function, time, zero));
            }
        }
        functions
    }

    /// The witness of a choice, with what shows that its numbers meet the premises.
    fn witness(&mut self, system: &System, chosen: &[(Symbol, Term)], near: &[Term]) -> Option<With<Witness>> {
        let table: Vec<(Function, u32, Term, Term)> = self
            .table
            .clone()
            .into_iter()
            .map(|(function, order, time, symbol)| {
                let value = self.statement.terms_mut().symbol(symbol);
                (
                    function,
                    order,
                    self.with_solved(time, system),
                    self.with_solved(value, system),
                )
            })
            .collect();
        let mut solved = Vec::new();
        for &(symbol, term) in &system.solved {
            solved.push((symbol, self.made_real(symbol, term)?));
        }
        let system = &System {
            solved,
            ..system.clone()
        };
        let mut witness = Witness {
            solved: system.solved.clone(),
            sample: chosen.to_vec(),
            functions: self.functions_with_silent_ones(),
            table,
            certificate: Certificate::default(),
        };
        let sample: HashMap<Symbol, Term> = chosen.iter().copied().collect();
        let givens: Vec<Term> = self
            .statement
            .givens()
            .iter()
            .filter(|given| given.law.is_none() && given.property == Property::Zero)
            .map(|given| given.term)
            .collect();
        let mut zeros = Vec::new();
        let mut wished = Vec::new();
        for term in givens {
            let term = self.translated(term, system)?;
            // what is too large as it is may be small at the numbers
            if numerator(&self.statement, term).is_some_and(|form| form.is_zero()) {
                continue;
            }
            let term = self.statement.terms_mut().rewrite(term, &mut |_, node| match node {
                Node::Symbol(symbol) => sample.get(symbol).copied(),
                _ => None,
            });
            if !numerator(&self.statement, term)?.is_zero() {
                zeros.push(term);
            }
        }
        let mut others = near.to_vec();
        if !self.functions.is_empty() {
            for given in self.statement.givens().to_vec() {
                if given.law.is_some()
                    && let Some(term) = self.named_law(given.term, system)
                {
                    others.push(term);
                }
            }
        }
        for term in others {
            let term = self.statement.terms_mut().rewrite(term, &mut |_, node| match node {
                Node::Symbol(symbol) => sample.get(symbol).copied(),
                _ => None,
            });
            if !zeros.contains(&term) && !numerator(&self.statement, term).is_none_or(|form| form.is_zero()) {
                wished.push(term);
            }
        }
        let mut statement = self.statement.clone();
        if !zeros.is_empty() || !wished.is_empty() {
            let all: Vec<Term> = zeros.iter().chain(&wished).copied().collect();
            match numbers_vanish(&mut statement, &all, &mut self.certificate_steps) {
                Some(certificate) => witness.certificate = certificate,
                None => {
                    statement = self.statement.clone();
                    if !zeros.is_empty() {
                        witness.certificate = numbers_vanish(&mut statement, &zeros, &mut self.certificate_steps)?;
                    }
                }
            }
        }
        Some(With {
            statement,
            evidence: witness,
        })
    }
}

/// Whether sines or cosines are spoken of.
/// The most numbers that inequalities are looked at about.
const MOST_SPOKEN: usize = 6;

/// The numbers that inequalities of a statement speak of, the numbers next to them, and those between two.
fn numbers_about(statement: &Statement) -> Vec<Rational> {
    let ordered = |property: Property| matches!(property, Property::Positive | Property::NonNegative);
    if !statement.goal().iter().any(|(property, _)| *property != Property::Zero)
        && !statement.givens().iter().any(|given| ordered(given.property))
    {
        return Vec::new();
    }
    let terms = statement.terms();
    let mut spoken: BTreeSet<Rational> = BTreeSet::new();
    let givens = statement.givens().iter().map(|given| given.term);
    for term in statement.goal().iter().map(|(_, term)| *term).chain(givens) {
        for inner in terms.inside(term) {
            let closed = terms.is_closed(inner) && spoken.len() < 2 * MOST_SPOKEN;
            let number = closed.then(|| Expansion::new(BTreeSet::new(), 100).of(terms, inner).ok());
            let number = number.flatten().filter(|quotient| quotient.divisors.is_empty());
            if let Some(value) = number.and_then(|quotient| quotient.numerator.as_constant()) {
                spoken.extend([value.clone(), Rational::zero() - value]);
            }
        }
    }
    spoken.insert(Rational::zero());
    let spoken: Vec<Rational> = spoken.into_iter().collect();
    let (one, half) = (Rational::from_integer(1), Rational::from_ratio(1, 2));
    let mut about: BTreeSet<Rational> = spoken.iter().cloned().collect();
    for number in &spoken {
        about.extend([number.clone() + one.clone(), number.clone() - one.clone()]);
    }
    for pair in spoken.windows(2) {
        if let [low, high] = pair {
            about.insert((low.clone() + high.clone()) * half.clone());
        }
    }
    about.into_iter().collect()
}

fn speaks_of_circles(statement: &Statement) -> bool {
    let terms = statement.terms();
    let given = statement.givens().iter().map(|given| given.term);
    let goal = statement.goal().iter().map(|(_, term)| *term);
    let circle = |inner: &Term| {
        matches!(
            terms.node(*inner),
            Node::Elementary(Elementary::Sin | Elementary::Cos, _)
        )
    };
    given.chain(goal).any(|term| terms.inside(term).iter().any(circle))
}

/// Whether a value has a property but for rounding.
fn may_hold(property: Property, value: Sized) -> bool {
    if !value.is_finite() {
        return false;
    }
    match property {
        Property::Zero => value.may_vanish(),
        Property::Nonzero => !value.vanishes(),
        Property::Positive => value.value.0 > 0.0 && !value.vanishes() && value.is_real(),
        Property::NonNegative => (value.value.0 > 0.0 || value.vanishes()) && value.is_real(),
        Property::Integer => (value.value.0 - value.value.0.round()).abs() < 1e-9,
    }
}

/// Whether a value that is 0 but for rounding would not have a property.
fn barely_fails(property: Property, value: Sized) -> bool {
    matches!(property, Property::Positive | Property::Nonzero) && value.vanishes()
}

fn ratio(a: &Polynomial, b: &Polynomial) -> Option<Rational> {
    let (first, second) = (a.terms().first()?, b.terms().first()?);
    let ratio = Rational(&first.1 / &second.1);
    (*a == b.scaled(&ratio)).then_some(ratio)
}

/// For which symbols premises are solved first: those that maps and motions determine, parameters last; none for
/// symbols that are not free.
fn preference(statement: &Statement, symbol: Symbol) -> u8 {
    if statement.definitions().contains_key(&symbol) {
        return u8::MAX;
    }
    match statement.quantity(symbol) {
        Some(Quantity::Partial { .. } | Quantity::Fixed) => 0,
        Some(Quantity::Member { .. }) if statement.instant_of(symbol).is_some() => 4,
        Some(Quantity::Member { .. }) => 1,
        Some(Quantity::Fresh) => 2,
        Some(Quantity::Running) | None => u8::MAX,
        _ if statement.generic().contains(&symbol) => 7,
        _ => {
            let bound = statement.givens().iter().any(|given| {
                given.property != Property::Zero
                    && matches!(statement.terms().node(given.term), Node::Symbol(known) if *known == symbol)
            });
            if bound { 6 } else { 5 }
        }
    }
}

/// A quotient of polynomials as a term.
fn ratio_term(session: &mut Session, above: &Polynomial, below: &Polynomial) -> Term {
    if let Some(number) = below.as_constant()
        && !number.is_zero()
    {
        return session.polynomial_term(&above.scaled(&(Rational::from_ratio(1, 1) / number)));
    }
    let (above, below) = (session.polynomial_term(above), session.polynomial_term(below));
    session.terms().quotient(above, below)
}

/// A root of a quotient of polynomials, written without it where it is rational.
fn root_term(session: &mut Session, above: &Polynomial, below: &Polynomial, index: u32) -> Term {
    if index == 2
        && let (Some(a), Some(b)) = (above.as_constant(), below.as_constant())
        && !b.is_zero()
        && let Some(root) = rational_root(&(a / b).0)
    {
        return session.terms().number(Rational(root));
    }
    if index == 2
        && *below == Polynomial::integer(1)
        && let Ok(Some(root)) = square_root(above, &mut Steps::new(20_000))
    {
        return session.polynomial_term(&root);
    }
    if index == 2 && session.checker.statement.is_complex() {
        let negative = below.as_constant().is_some_and(|below| below > Rational::zero())
            && above.terms().iter().all(|(monomial, value)| {
                value.sign() == dashu_int::Sign::Negative && monomial.iter().all(|(_, power)| power % 2 == 0)
            });
        if negative && !above.is_zero() {
            let root = root_term(session, &above.negated(), below, 2);
            let unit = session.terms().add(Node::Imaginary);
            return session.terms().product(vec![unit, root]);
        }
    }
    let radicand = ratio_term(session, above, below);
    match session.node(radicand) {
        Node::Number(value) if value == Rational::from_ratio(1, 1) || value.is_zero() => radicand,
        _ => session.terms().elementary(Elementary::Root(index), radicand),
    }
}

/// Arguments at which a function has a value.
fn arguments(session: &mut Session, function: Elementary, wanted: Term) -> Vec<Term> {
    let node = session.node(wanted);
    let terms = session.terms();
    let pi = terms.add(Node::Pi);
    let turn = |terms: &mut kernel::Terms, above: i64, below: i64| {
        let factor = terms.number(Rational::from_ratio(above, below));
        match above {
            0 => factor,
            _ => terms.product(vec![factor, pi]),
        }
    };
    let is = |above: i64, below: i64| node == Node::Number(Rational::from_ratio(above, below));
    match function {
        Elementary::Sin | Elementary::Cos => {
            if let Node::Elementary(other, of) = node
                && other == function
            {
                let whole = turn(terms, 2, 1);
                let mirrored = match function {
                    Elementary::Sin => terms.difference(pi, of),
                    _ => terms.negative(of),
                };
                return vec![terms.sum(vec![of, whole]), mirrored, of];
            }
            let sines = [(0, 0), (1, 6), (1, 2), (-1, 6), (-1, 2)];
            let known = [(0, 1), (1, 2), (1, 1), (-1, 2), (-1, 1)]
                .iter()
                .position(|&(above, below)| is(above, below))
                .and_then(|place| sines.get(place));
            if let Some(&(above, below)) = known {
                let below = if below == 0 { 1 } else { below };
                // cos(x) = sin(pi/2 - x)
                return match function {
                    Elementary::Sin => vec![turn(terms, above, below), turn(terms, below - above, below)],
                    _ => vec![
                        turn(terms, below - 2 * above, 2 * below),
                        turn(terms, 2 * above - below, 2 * below),
                    ],
                };
            }
            match function {
                Elementary::Sin => {
                    let first = terms.elementary(Elementary::Arcsin, wanted);
                    vec![first, terms.difference(pi, first)]
                }
                _ => {
                    let first = terms.elementary(Elementary::Arccos, wanted);
                    vec![first, terms.negative(first)]
                }
            }
        }
        Elementary::Exp if is(1, 1) => vec![terms.integer(0)],
        Elementary::Exp => vec![terms.elementary(Elementary::Ln, wanted)],
        Elementary::Ln if is(0, 1) => vec![terms.integer(1)],
        Elementary::Ln => vec![terms.elementary(Elementary::Exp, wanted)],
        Elementary::Root(index) => match i32::try_from(index) {
            Ok(index) => vec![terms.add(Node::Power(wanted, index))],
            Err(_) => Vec::new(),
        },
        Elementary::Arcsin => vec![terms.elementary(Elementary::Sin, wanted)],
        Elementary::Arccos => vec![terms.elementary(Elementary::Cos, wanted)],
        Elementary::Arctan => {
            let (sine, cosine) = (
                terms.elementary(Elementary::Sin, wanted),
                terms.elementary(Elementary::Cos, wanted),
            );
            vec![terms.quotient(sine, cosine)]
        }
    }
}

/// The value of a symbol at which a term, affine in it, has a value.
fn solved_affine(session: &mut Session, term: Term, symbol: Symbol, wanted: Term) -> Option<Term> {
    let difference = session.terms().difference(term, wanted);
    let form = session.numerator(difference)?;
    let generator = session.terms().symbol(symbol);
    match coefficients_in(&form, generator).as_slice() {
        [rest, lead] => Some(ratio_term(session, &rest.negated(), lead)),
        _ => None,
    }
}

/// A certificate that these numbers, which are no rationals, are 0; takes its steps from those that are left.
fn numbers_vanish(statement: &mut Statement, zeros: &[Term], left: &mut u64) -> Option<Certificate> {
    let mut bare = statement.with_givens(&|_| false);
    let mut session = Session::new(&mut bare, Vec::new(), *left);
    let shown = (|| {
        let polynomials: Vec<Polynomial> = zeros
            .iter()
            .map(|&term| session.numerator(term))
            .collect::<Option<_>>()?;
        proof::prepare(&mut session, &polynomials)?;
        polynomials
            .iter()
            .try_for_each(|polynomial| session.show_zero(polynomial).map(drop))
    })();
    *left = session.budget.left();
    shown?;
    let steps = std::mem::take(&mut session.steps);
    statement.adopt(&bare).then_some(Certificate {
        whole: Vec::new(),
        steps,
    })
}
