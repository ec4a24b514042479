//! The search for points: values of symbols and functions at which all that is given holds.
//!
//! Premises are solved one after the other, each for a symbol in which it is linear, quadratic, or that a single
//! function of it can be undone for; what is left is met by small numbers and by multiples of pi. Where a coefficient
//! may vanish, the case that it does is a point of its own.

use super::angles::polynomial_term;
use super::float::{Complex, value};
use super::proof;
use super::session::Session;
use super::values::{self, Usable};
use crate::algebra::{coefficients_in, degree_in, primitive};
use crate::kernel::{
    Certificate, Elementary, Expansion, Function, FunctionOf, Inference, Law, Node, Polynomial, Property, Quantity,
    Statement, Symbol, Term, With, Witness,
};
use crate::number::{Field, Rational, Sequence};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Whether the goals must fail at the point, or the point is of the premises alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    Failure,
    Premises,
}

/// Cases in which a coefficient vanishes that are followed.
const MOST_CASES: usize = 24;

/// Samples tried in floating point for each case, and those of them that the kernel is asked for.
const MOST_SAMPLES: usize = 600;
const MOST_ASKED: usize = 6;

/// A search for one point.
struct Search<'a> {
    statement: Statement,
    wanted: Wanted,
    accept: &'a dyn Fn(&With<Witness>) -> bool,
    functions: Vec<(Function, Symbol, Term)>,
    /// Values of functions at single times that are symbols of their own.
    table: Vec<(Function, u32, Term, Symbol)>,
    periods: Vec<(Function, Term)>,
    cases: usize,
    effort: u64,
    random: Sequence,
    found: Option<With<Witness>>,
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
    accept: &dyn Fn(&With<Witness>) -> bool,
) -> Option<With<Witness>> {
    let mut session_statement = statement.clone();
    let (equations, laws) = equations(&mut session_statement)?;
    let mut models = models(&mut session_statement, &laws);
    if models.is_empty() {
        models.push(Vec::new());
    }
    for functions in models {
        let mut search = Search {
            statement: session_statement.clone(),
            wanted,
            accept,
            functions,
            table: Vec::new(),
            periods: periods(&mut session_statement.clone()),
            cases: MOST_CASES,
            effort,
            random: Sequence::new(7),
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
    }
    None
}

/// What must vanish by the givens: premises, laws at the times spoken of, derivatives along maps.
fn equations(statement: &mut Statement) -> Option<(Vec<Term>, Vec<Usable>)> {
    let goals: Vec<Term> = statement.goal().iter().map(|(_, term)| *term).collect();
    let mut session = Session::new(statement, Vec::new(), 2_000_000);
    let mut polynomials = Vec::new();
    for goal in goals {
        polynomials.push(session.numerator(goal)?);
    }
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
                found.push(polynomial_term(&mut session, &polynomial));
            }
        }
        fact += 1;
    }
    let found: Vec<Term> = found
        .into_iter()
        .map(|term| session.checker.statement.written_out(term))
        .collect();
    Some((found, laws))
}

/// The periods that laws declare.
fn periods(statement: &mut Statement) -> Vec<(Function, Term)> {
    let mut found = Vec::new();
    for given in statement.givens().to_vec() {
        let Some(Law {
            time: Some(time),
            flight: None,
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
        let single = |monomial: &crate::kernel::Monomial| match monomial.as_slice() {
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
    for law in laws {
        let term = statement.terms_mut().substitute(law.term(), law.time(), running);
        let Some(form) = numerator(statement, term) else {
            continue;
        };
        let own = values::values_of(statement, term);
        for (monomial, lead) in form.terms() {
            let [(generator, 1)] = monomial.as_slice() else {
                continue;
            };
            let Node::Value(function, order, at) = *statement.terms().node(*generator) else {
                continue;
            };
            let family = family(statement, function);
            let once = own.iter().filter(|(f, ..)| family.contains(f)).count() == 1;
            if at != running || !once || named.iter().any(|(f, ..)| *f == function) || order > 0 {
                continue;
            }
            let rest = form
                .minus(&Polynomial::generator(*generator).scaled(&Rational(lead.clone())))
                .scaled(&Rational(-dashu_ratio::RBig::ONE / lead));
            let mut session = Session::new(statement, Vec::new(), 1000);
            let formula = polynomial_term(&mut session, &rest);
            named.push((function, time, formula));
        }
        bound.extend(own.iter().map(|(f, ..)| *f));
    }
    complete(statement, &mut named, time);
    let covered: BTreeSet<Function> = named.iter().map(|(f, ..)| *f).collect();
    let periodic: BTreeSet<Function> = periods(statement).into_iter().map(|(f, _)| f).collect();
    let flights = statement.functions().to_vec();
    let is_line = |function: &Function| matches!(flights.get(function.0 as usize), Some(FunctionOf::Line(_)));
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

/// A function with all that are connected with it by derivatives.
fn family(statement: &Statement, function: Function) -> BTreeSet<Function> {
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
                    let Some(form) = numerator(statement, term) else {
                        continue;
                    };
                    let mut session = Session::new(statement, Vec::new(), 1000);
                    let Some(integral) = values::antiderivative_of(&mut session, &form, time) else {
                        continue;
                    };
                    let constant = statement.fresh("c");
                    let constant = statement.terms_mut().symbol(constant);
                    let integral = statement.terms_mut().sum(vec![integral, constant]);
                    named.push((outer, time, integral));
                }
                _ => {}
            }
        }
    }
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
        .filter(|(_, quantity)| matches!(quantity, Quantity::Parameter(_)))
        .map(|(symbol, _)| symbol)
        .collect();
    let terms = statement.terms_mut();
    let t = terms.symbol(time);
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
    let mut shapes = vec![one, t, terms.integer(0), terms.add(Node::Power(t, 2))];
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
    // one function leads, those that are derivatives follow; a second open family takes the first shapes
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
            sets.push(set);
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

    fn numerator(&self, term: Term) -> Option<Polynomial> {
        numerator(&self.statement, term).map(|form| primitive(&form).map_or(form.clone(), |(_, part)| part))
    }

    /// Solves what is open; samples where nothing is, or nothing more can be solved.
    fn solve(&mut self, mut system: System) {
        loop {
            if self.found.is_some() {
                return;
            }
            // times first, so that values of functions at equal times are one
            if !self.table_is_made() && self.solve_one(&mut system, true) {
                continue;
            }
            self.make_table(&mut system);
            system
                .open
                .retain(|&term| numerator(&self.statement, term).is_none_or(|form| !form.is_zero()));
            for &term in &system.open {
                if numerator(&self.statement, term).is_some_and(|form| form.as_constant().is_some()) {
                    return;
                }
            }
            if !self.solve_one(&mut system, false) {
                break;
            }
        }
        self.sample(&system);
    }

    fn table_is_made(&self) -> bool {
        !self.table.is_empty()
    }

    /// Solves one of the open equations. With `times`, one without values of functions only.
    fn solve_one(&mut self, system: &mut System, times: bool) -> bool {
        let mut best: Option<((u8, u8, usize), usize, Symbol, Term, Option<Polynomial>)> = None;
        for (number, &term) in system.open.iter().enumerate() {
            let has_values = !values::values_of(&self.statement, term).is_empty();
            if times && has_values {
                continue;
            }
            let Some(form) = self.numerator(term) else { continue };
            for (rank, symbol, solution, lead) in self.solutions(&form) {
                if best.as_ref().is_none_or(|(known, ..)| rank < *known) {
                    best = Some((rank, number, symbol, solution, lead));
                }
            }
        }
        let Some((_, number, symbol, solution, lead)) = best else {
            return false;
        };
        if let Some(lead) = lead
            && self.cases > 0
        {
            // the case that the coefficient vanishes is one of its own
            self.cases -= 1;
            let mut other = system.clone();
            let mut session_statement = self.statement.clone();
            let mut session = Session::new(&mut session_statement, Vec::new(), 1000);
            let lead = polynomial_term(&mut session, &lead);
            self.statement = session_statement;
            other.open.push(lead);
            let table = self.table.clone();
            let first = self.cases;
            self.try_first(system, number, symbol, solution);
            if self.found.is_some() {
                return false;
            }
            self.table = table;
            self.cases = self.cases.min(first);
            if !self.is_generic_only(lead) {
                *system = other;
                // the coefficient may not be solved for again by the same equation
                return true;
            }
            system.open.clear();
            system.open.push(self.statement.terms_mut().integer(1));
            return true;
        }
        self.put_in(system, number, symbol, solution);
        true
    }

    fn try_first(&mut self, system: &System, number: usize, symbol: Symbol, solution: Term) {
        let mut first = system.clone();
        self.put_in(&mut first, number, symbol, solution);
        self.solve(first);
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

    fn put_in(&mut self, system: &mut System, number: usize, symbol: Symbol, solution: Term) {
        system.open.remove(number);
        let terms = self.statement.terms_mut();
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
    }

    /// Ways to solve a polynomial equation for a symbol: the better the lower the rank. The lead is what must not be 0.
    fn solutions(&mut self, form: &Polynomial) -> Vec<((u8, u8, usize), Symbol, Term, Option<Polynomial>)> {
        let mut found = Vec::new();
        for generator in form.generators() {
            let coefficients = coefficients_in(form, generator);
            let others: Vec<Term> = form
                .generators()
                .into_iter()
                .filter(|term| *term != generator)
                .collect();
            let mut session_statement = std::mem::take(&mut self.statement);
            let mut session = Session::new(&mut session_statement, Vec::new(), 1000);
            match session.node(generator) {
                Node::Symbol(symbol) => {
                    let inside = others
                        .iter()
                        .any(|&term| session.checker.statement.terms().holds(term, symbol));
                    let rank = preference(session.checker.statement, symbol);
                    if inside || rank == u8::MAX {
                    } else if let [rest, lead] = coefficients.as_slice() {
                        let above = polynomial_term(&mut session, &rest.negated());
                        let solution = if *lead == Polynomial::integer(1) {
                            above
                        } else {
                            let below = polynomial_term(&mut session, lead);
                            session.terms().quotient(above, below)
                        };
                        let constant = lead.as_constant().is_some();
                        let lead_size = if constant { 0 } else { 1 };
                        found.push((
                            (lead_size, rank, lead.terms().len()),
                            symbol,
                            solution,
                            (!constant).then(|| lead.clone()),
                        ));
                    } else if let [c, b, a] = coefficients.as_slice()
                        && session.checker.statement.generic().is_empty()
                    {
                        // (-b + sqrt(b² - 4ac)) / 2a
                        let [a, b, c] = [a, b, c].map(|part| polynomial_term(&mut session, part));
                        let terms = session.terms();
                        let (square, four, two) = (terms.add(Node::Power(b, 2)), terms.integer(4), terms.integer(2));
                        let product = terms.product(vec![four, a, c]);
                        let radicand = terms.difference(square, product);
                        let root = terms.elementary(Elementary::Root(2), radicand);
                        let root = if self.random.draw() % 2 == 0 {
                            root
                        } else {
                            terms.negative(root)
                        };
                        let (above, below) = (terms.difference(root, b), terms.product(vec![two, a]));
                        let solution = terms.quotient(above, below);
                        found.push(((3, rank, form.terms().len()), symbol, solution, None));
                    } else if coefficients.len() > 3
                        && coefficients[1..coefficients.len() - 1].iter().all(Polynomial::is_zero)
                        && session.checker.statement.generic().is_empty()
                    {
                        let (Some(rest), Some(lead)) = (coefficients.first(), coefficients.last()) else {
                            continue;
                        };
                        let above = polynomial_term(&mut session, &rest.negated());
                        let below = polynomial_term(&mut session, lead);
                        let index = u32::try_from(coefficients.len() - 1).unwrap_or(2);
                        let terms = session.terms();
                        let radicand = terms.quotient(above, below);
                        let solution = terms.elementary(Elementary::Root(index), radicand);
                        found.push(((4, rank, form.terms().len()), symbol, solution, None));
                    }
                }
                Node::Elementary(function, of)
                    if coefficients.len() == 2 && session.checker.statement.generic().is_empty() =>
                {
                    if let Some((symbol, solution)) = undone(&mut session, function, of, &coefficients, &others) {
                        let rank = preference(session.checker.statement, symbol);
                        if rank != u8::MAX {
                            found.push(((2, rank, form.terms().len()), symbol, solution, None));
                        }
                    }
                }
                _ => {}
            }
            self.statement = session_statement;
        }
        found
    }

    /// Makes the values of functions at single times symbols of their own, one for each time.
    fn make_table(&mut self, system: &mut System) {
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
        let period = self
            .periods
            .iter()
            .find(|(f, _)| *f == function)
            .map(|(_, period)| *period);
        for (_, _, time, symbol) in self
            .table
            .clone()
            .into_iter()
            .filter(|(f, n, ..)| (*f, *n) == (function, order))
        {
            let apart = self.statement.terms_mut().difference(at, time);
            let form = numerator(&self.statement, apart)?;
            if form.is_zero() {
                return Some(symbol);
            }
            if let Some(period) = period {
                let turns = self.statement.terms_mut().quotient(apart, period);
                let Ok(quotient) = Expansion::new(BTreeSet::new(), 100_000).of(self.statement.terms(), turns) else {
                    continue;
                };
                let whole = match quotient.divisors.as_slice() {
                    [] => quotient.numerator.as_constant(),
                    [(divisor, 1)] => ratio(&quotient.numerator, divisor),
                    _ => None,
                };
                if whole.is_some_and(|turns| *turns.0.denominator() == dashu_int::UBig::ONE) {
                    return Some(symbol);
                }
            }
        }
        None
    }

    /// Tries numbers for what is free.
    fn sample(&mut self, system: &System) {
        let free = self.free_symbols(system);
        let conditions = self.conditions(system);
        let goals: Vec<(Property, Term)> = self.statement.goal().to_vec();
        let goals: Vec<(Property, Term)> = goals
            .into_iter()
            .filter_map(|(property, term)| Some((property, self.translated(term, system)?)))
            .collect();
        let open = system.open.clone();
        let mut asked = 0;
        let samples = if open.is_empty() {
            MOST_SAMPLES / 2
        } else {
            3 * MOST_SAMPLES
        };
        for attempt in 0..samples * usize::try_from(self.effort.min(8)).unwrap_or(1) {
            let chosen: Vec<(Symbol, Term)> = free
                .iter()
                .map(|symbol| (*symbol, self.number_for(*symbol, attempt)))
                .collect();
            if !self.fits(&chosen, &conditions, &open, &goals) {
                continue;
            }
            let witness = self.witness(system, &chosen);
            asked += 1;
            if let Some(witness) = witness
                && (self.accept)(&witness)
            {
                self.found = Some(witness);
                return;
            }
            if asked >= MOST_ASKED {
                return;
            }
        }
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
        conditions
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
        let givens = self.statement.givens();
        let term_is = |term: Term| matches!(self.statement.terms().node(term), Node::Symbol(known) if *known == symbol);
        let declared = |property: Property| {
            givens
                .iter()
                .any(|given| given.property == property && term_is(given.term))
        };
        let (positive, integer) = (
            declared(Property::Positive) || declared(Property::NonNegative),
            declared(Property::Integer),
        );
        let spread = 3 + attempt / 40;
        let mut pick = |most: usize| (self.random.draw() % most.max(1) as u64) as i64;
        let closed = attempt % 5 == 4;
        let (above, below) = match (positive, integer) {
            (true, true) => (pick(spread + 2) + 1, 1),
            (false, true) => (pick(2 * spread + 1) - spread as i64, 1),
            (true, false) => (pick(2 * spread) + 1, pick(spread) + 1),
            (false, false) => (pick(4 * spread + 1) - 2 * spread as i64, pick(spread) + 1),
        };
        let has_functions = closed && !integer;
        let number = self.statement.terms_mut().number(Rational::from_ratio(above, below));
        if has_functions && self.speaks_of_circles() {
            // multiples of pi, where circles are spoken of
            let count = [1, 2, 3, 4, 6, 12][(self.random.draw() % 6) as usize];
            let terms = self.statement.terms_mut();
            let (pi, factor) = (terms.add(Node::Pi), terms.number(Rational::from_ratio(above, count)));
            return terms.product(vec![factor, pi]);
        }
        number
    }

    fn speaks_of_circles(&self) -> bool {
        let terms = self.statement.terms();
        (0..terms.len()).any(|n| {
            matches!(
                terms.node(Term(n as u32)),
                Node::Elementary(Elementary::Sin | Elementary::Cos, _)
            )
        })
    }

    /// Whether a choice of numbers meets, in floating point, what it must.
    fn fits(
        &self,
        chosen: &[(Symbol, Term)],
        conditions: &[(Property, Term)],
        open: &[Term],
        goals: &[(Property, Term)],
    ) -> bool {
        let real = !self.statement.is_complex();
        let terms = self.statement.terms();
        let mut symbols: HashMap<Symbol, Complex> = HashMap::new();
        for (symbol, number) in chosen {
            let number = value(terms, *number, &HashMap::new(), real, &mut HashMap::new());
            symbols.insert(*symbol, number);
        }
        let mut known = HashMap::new();
        let mut of = |term: Term| value(terms, term, &symbols, real, &mut known);
        let near = |(a, b): Complex| a.hypot(b) < 1e-9;
        let holds = |property: Property, value: Complex| match property {
            Property::Zero => near(value),
            Property::Nonzero => !near(value) && value.0.is_finite(),
            Property::Positive => value.0 > 1e-9,
            Property::NonNegative => value.0 > -1e-12,
            Property::Integer => (value.0 - value.0.round()).abs() < 1e-9,
        };
        if !conditions.iter().all(|(property, term)| holds(*property, of(*term))) {
            return false;
        }
        if !open.iter().all(|term| near(of(*term))) {
            return false;
        }
        match self.wanted {
            Wanted::Premises => true,
            Wanted::Failure => {
                goals.iter().any(|(property, term)| {
                    let value = of(*term);
                    value.0.is_finite() && !holds(*property, value)
                }) || goals.iter().any(|(_, term)| !of(*term).0.is_finite())
            }
        }
    }

    /// The witness of a choice, with what shows that its numbers meet the premises.
    fn witness(&mut self, system: &System, chosen: &[(Symbol, Term)]) -> Option<With<Witness>> {
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
        let mut witness = Witness {
            solved: system.solved.clone(),
            sample: chosen.to_vec(),
            functions: self.functions.clone(),
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
        for term in givens {
            let term = self.translated(term, system)?;
            if numerator(&self.statement, term)?.is_zero() {
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
        let mut statement = self.statement.clone();
        if !zeros.is_empty() {
            witness.certificate = numbers_vanish(&mut statement, &zeros)?;
        }
        Some(With {
            statement,
            evidence: witness,
        })
    }
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
        Some(Quantity::Partial { .. } | Quantity::Invariant { .. }) => 0,
        Some(Quantity::State { .. }) => 1,
        Some(Quantity::Fresh(_)) => 2,
        Some(Quantity::Time { .. }) => 4,
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

/// Solves a linear equation in a function of a symbol by the inverse function.
fn undone(
    session: &mut Session,
    function: Elementary,
    of: Term,
    coefficients: &[Polynomial],
    others: &[Term],
) -> Option<(Symbol, Term)> {
    let form = session.numerator(of)?;
    let symbols: Vec<Term> = form
        .generators()
        .into_iter()
        .filter(|&term| matches!(session.node(term), Node::Symbol(_)))
        .collect();
    let generator = symbols.into_iter().find(|&term| {
        let Node::Symbol(symbol) = session.node(term) else {
            return false;
        };
        degree_in(&form, term) == 1
            && !others
                .iter()
                .any(|&other| session.checker.statement.terms().holds(other, symbol))
            && preference(session.checker.statement, symbol) != u8::MAX
    })?;
    let Node::Symbol(symbol) = session.node(generator) else {
        return None;
    };
    let quotient = session
        .checker
        .expansion
        .of(session.checker.statement.terms(), of)
        .ok()?;
    if !quotient.divisors.is_empty() {
        return None;
    }
    let above = polynomial_term(session, &coefficients[0].negated());
    let below = polynomial_term(session, &coefficients[1]);
    let wanted = session.terms().quotient(above, below);
    let terms = session.terms();
    let argument = match function {
        Elementary::Sin => terms.elementary(Elementary::Arcsin, wanted),
        Elementary::Cos => terms.elementary(Elementary::Arccos, wanted),
        Elementary::Exp => terms.elementary(Elementary::Ln, wanted),
        Elementary::Ln => terms.elementary(Elementary::Exp, wanted),
        Elementary::Root(index) => terms.add(Node::Power(wanted, i32::try_from(index).ok()?)),
        _ => return None,
    };
    let parts = coefficients_in(&form, generator);
    let rest = polynomial_term(session, &parts[0]);
    let slope = polynomial_term(session, &parts[1]);
    let terms = session.terms();
    let difference = terms.difference(argument, rest);
    Some((symbol, terms.quotient(difference, slope)))
}

/// A certificate that these numbers, which are no rationals, are 0.
fn numbers_vanish(statement: &mut Statement, zeros: &[Term]) -> Option<Certificate> {
    let mut bare = statement.with_givens(&|_| false);
    let mut session = Session::new(&mut bare, Vec::new(), 2_000_000);
    let mut polynomials = Vec::new();
    for &term in zeros {
        polynomials.push(session.numerator(term)?);
    }
    proof::prepare(&mut session, &polynomials)?;
    for polynomial in &polynomials {
        session.show_zero(polynomial)?;
    }
    let steps = std::mem::take(&mut session.steps);
    statement.adopt(&bare).then_some(Certificate {
        whole: Vec::new(),
        steps,
    })
}
