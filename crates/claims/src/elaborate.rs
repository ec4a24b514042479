//! Elaboration: the statement of a claim from its trees, what each name stands for, what is given, what is to be shown.

use super::definition::Local;
use super::determining::determining;
use super::naming::{Named, Names, is_letter, undotted};
use super::premise::Statements;
use super::reduce::infinity;
use kernel::{
    Draft, Elementary, Expansion, FunctionOf, Given, Implicit, Law, Monomial, Node, Origin, Property, Quantity,
    Statement, Symbol, Term, determinant, slope_determinant,
};
use num_traits::Zero;
use numbers::{Field, Rational};
use std::collections::{BTreeSet, HashMap};
use texmath::{
    self, At, Condition, Equation, Invariant, Map, Meaning, Name, Operation, Relation, Symbols, Tree, index_of, pair_of,
};

/// What a claim asks of one of its equations: all of these must hold for it.
#[derive(Clone, Debug)]
pub struct Question {
    pub equation: Equation,
    /// Which sign stands for `\pm`, where the equation has one; the solutions of the premises for pairs.
    pub instance: String,
    pub statement: Statement,
    /// The names of its symbols.
    pub names: Names,
    /// The maps whose derivatives it speaks of. Those without images come first, in the order of what the statement has
    /// as implicit.
    pub maps: Vec<MapStep>,
}

/// A map from one impact to the next.
#[derive(Clone, Debug, Default)]
pub struct MapStep {
    /// The name of the map; none where derivatives that are written imply it.
    pub name: String,
    /// From what it leads to what, by equations.
    pub implicit: Implicit,
    /// The terms that it gives, where its equations say so outright in what it leads from and symbols that do not move.
    pub images: Vec<Term>,
    /// The conditions for its equations to be defined, besides what their terms show.
    conditions: Vec<(Property, Term)>,
    /// True if its equations are read over the reals alone.
    real_only: bool,
}

/// Why no statement can be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Unreadable {
    pub message: String,
    /// Where in the formula, and the label of the premise that has it; none for the claim.
    pub at: usize,
    pub premise: Option<String>,
}

/// A limit of an integral: a term, or infinity, above all numbers or below.
#[derive(Clone, Copy)]
enum Limit {
    At(Term),
    Infinite(bool),
}

/// The most terms that the trees of one claim and its premises may come to.
const MOST_TERMS: usize = 400_000;

/// The questions that a claim asks.
///
/// # Errors
/// [`Unreadable`] where something has no meaning among these symbols.
pub fn questions(statements: &Statements, symbols: &Symbols) -> Result<Vec<Question>, Unreadable> {
    // what functions need to have values depends on whether complex numbers take part
    let asked = asked(statements, symbols, false)?;
    if asked.iter().any(|question| question.statement.is_complex()) {
        return self::asked(statements, symbols, true);
    }
    Ok(asked)
}

fn asked(statements: &Statements, symbols: &Symbols, complex: bool) -> Result<Vec<Question>, Unreadable> {
    let mut questions = Vec::new();
    for equation in &statements.claims {
        let pair = match &equation.left {
            Tree::Symbol(name, _) => pair_of(name),
            _ => None,
        };
        match pair {
            Some(name) => questions.extend(pair_questions(statements, symbols, equation, &name, complex)?),
            None => {
                let signs: &[Option<bool>] = match has_sign(&equation.left) || has_sign(&equation.right) {
                    true => &[Some(true), Some(false)],
                    false => &[None],
                };
                for &upper in signs {
                    let (mut builder, at) = Builder::given(statements, symbols, complex)?;
                    builder.upper = upper;
                    let goal = builder.claim(equation, at)?;
                    builder.write_claims(statements, equation)?;
                    let instance = upper.map_or("", |upper| if upper { "upper sign" } else { "lower sign" });
                    questions.push(builder.finish(equation, instance, vec![goal])?);
                }
            }
        }
    }
    Ok(questions)
}

/// `x_{1,2} = a \pm b`: every solution of the premises for x is one of the two values, and where there is one, each value is a solution.
fn pair_questions(
    statements: &Statements,
    symbols: &Symbols,
    equation: &Equation,
    name: &Name,
    complex: bool,
) -> Result<Vec<Question>, Unreadable> {
    let values = |builder: &mut Builder, at: usize| -> Result<[Term; 2], Unreadable> {
        let mut of = |upper| {
            builder.upper = Some(upper);
            builder.in_claim(&equation.right, at)
        };
        Ok([of(true)?, of(false)?])
    };
    let mut questions = Vec::new();
    let (mut builder, at) = Builder::given(statements, symbols, complex)?;
    let [first, second] = values(&mut builder, at)?;
    let symbol = builder.in_claim(&Tree::Symbol(name.clone(), equation.at), at)?;
    let Node::Symbol(pair) = *builder.statement.terms().node(symbol) else {
        return Err(unreadable(
            equation.at.0,
            format!("`{name}` is no symbol that premises could be solved for"),
        ));
    };
    builder.written.extend([first, second]);
    builder.write_claims(statements, equation)?;
    let factors = [first, second].map(|value| builder.statement.terms_mut().difference(symbol, value));
    let product = builder.statement.terms_mut().product(factors.to_vec());
    questions.push(builder.finish(equation, "every solution", vec![(Property::Zero, product)])?);
    for sign in [0, 1] {
        let (mut builder, at) = Builder::given(statements, symbols, complex)?;
        let values = values(&mut builder, at)?;
        builder.statement.parts().beside.extend(values);
        builder.written.extend(values);
        builder.write_claims(statements, equation)?;
        let goals = builder.solution(pair, values[sign], equation.at.0)?;
        let instance = if sign == 0 {
            "the upper value is a solution"
        } else {
            "the lower value is a solution"
        };
        questions.push(builder.finish(equation, instance, goals)?);
    }
    Ok(questions)
}

fn has_sign(tree: &Tree) -> bool {
    texmath::any(tree, &mut |node| {
        matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_))
    })
}

fn unreadable(at: usize, message: impl Into<String>) -> Unreadable {
    Unreadable {
        message: message.into(),
        at,
        premise: None,
    }
}

/// What a name may stand for within one equation.
#[derive(Clone, Copy)]
struct Scope<'a> {
    locals: &'a [Local],
    number: usize,
    /// The impact whose flight the running time of the equation is in, and whether the equation speaks of that flight.
    flight: i32,
    in_flight: bool,
}

struct Builder<'a> {
    symbols: &'a Symbols,
    statement: Draft,
    names: Names,
    locals: &'a [Local],
    scope: Scope<'a>,
    upper: Option<bool>,
    /// What stands for the running time.
    running: Option<Term>,
    /// Terms of the claim, whose domain is given.
    written: Vec<Term>,
    /// Conditions that the reading itself brings along: the base of a real power is not negative.
    brought: Vec<(Property, Term)>,
    /// The same of what an abbreviation stands for, and whether that is read over the reals alone.
    meant: HashMap<Term, (Vec<(Property, Term)>, bool)>,
    open: Vec<Name>,
    /// The letter of the integral that is read.
    bound: Option<Name>,
    known: HashMap<(Name, usize), Term>,
    real_only: bool,
    opaque: bool,
    /// Whether what `[symbols]` says of signs is among the givens.
    is_declared: bool,
    /// The premises whose own conditions may hold at single points only: no map is differentiated there.
    pointwise: Vec<Origin>,
    /// The maps from one impact to the next whose derivatives are written, where the symbol table names no map.
    implied: Vec<(Name, MapStep)>,
    /// The maps whose derivatives are symbols of their own, and those that say outright what they lead to.
    maps: Vec<MapStep>,
    outright: Vec<MapStep>,
    /// The names that the premises write, and whether one of them is a law of flight.
    spoken: BTreeSet<Name>,
    has_flight: bool,
    /// The parameters that the claim assumes to be integers.
    assumed_integers: BTreeSet<Name>,
}

impl<'a> Builder<'a> {
    /// All that is given, before the claim is read; and the flight that the claim speaks of.
    fn given(statements: &'a Statements, symbols: &'a Symbols, complex: bool) -> Result<(Self, usize), Unreadable> {
        let none = Scope {
            locals: &[],
            number: 0,
            flight: 0,
            in_flight: false,
        };
        let (names, statement) = Names::new(symbols, complex);
        let mut builder = Self {
            symbols,
            statement,
            names,
            locals: &statements.locals,
            scope: none,
            upper: None,
            running: None,
            written: Vec::new(),
            brought: Vec::new(),
            meant: HashMap::new(),
            open: Vec::new(),
            bound: None,
            known: HashMap::new(),
            real_only: false,
            opaque: false,
            is_declared: false,
            pointwise: Vec::new(),
            implied: Vec::new(),
            maps: Vec::new(),
            outright: Vec::new(),
            spoken: BTreeSet::new(),
            has_flight: false,
            assumed_integers: statements.assume.iter().filter_map(assumed_integer).collect(),
        };
        for premise in &statements.premises {
            builder.has_flight |= texmath::flies(&premise.equation, symbols);
            builder.spoken.append(&mut names_in(&premise.equation));
        }
        builder.opaque = builder.is_opaque(statements);
        builder.declare_derivatives()?;
        for (number, premise) in statements.premises.iter().enumerate() {
            let named = |mut fault: Unreadable| {
                fault.premise = Some(premise.label.clone());
                fault
            };
            builder.scope = builder.scope_of(&premise.equation, &premise.locals, number + 2, None);
            builder.brought.clear();
            let (property, term) = builder.relation(&premise.equation).map_err(named)?;
            let mut conditions = Vec::new();
            for condition in &premise.assume {
                conditions.push(builder.condition(condition).map_err(named)?);
            }
            builder.give(Origin::Premise(premise.label.clone()), property, term, conditions);
        }
        let number = statements
            .claims
            .iter()
            .map(|claim| builder.first_impact(claim))
            .min()
            .flatten();
        builder.own_scope(number.unwrap_or(0), false);
        for condition in &statements.assume {
            let (property, term) = builder.condition(condition)?;
            builder.written.push(term);
            builder.push(Origin::Assumptions, property, term, None);
            for (property, term) in std::mem::take(&mut builder.brought) {
                builder.push(Origin::ClaimDomain, property, term, None);
            }
        }
        for relation in &symbols.relations {
            let (property, term) = builder.relation(relation)?;
            builder.push(Origin::Table(relation.to_string()), property, term, None);
            for (property, term) in std::mem::take(&mut builder.brought) {
                builder.push(Origin::Table(relation.to_string()), property, term, None);
            }
        }
        builder.declare_periods()?;
        builder.imply_maps(statements);
        builder.declare_maps(statements)?;
        Ok((builder, 1))
    }

    fn own_scope(&mut self, flight: i32, in_flight: bool) {
        self.scope = Scope {
            locals: self.locals,
            number: 1,
            flight,
            in_flight,
        };
        self.brought.clear();
    }

    fn first_impact(&self, equation: &Equation) -> Option<i32> {
        self.symbols.impacts(equation).first().copied()
    }

    fn scope_of(&self, equation: &Equation, locals: &'a [Local], number: usize, first: Option<i32>) -> Scope<'a> {
        let first = self.first_impact(equation).or(first);
        Scope {
            locals,
            number,
            flight: first.unwrap_or(0),
            in_flight: texmath::flies(equation, self.symbols),
        }
    }

    /// Takes what was read as given: once, or as a law where it runs over times or indices.
    fn give(&mut self, origin: Origin, property: Property, term: Term, mut conditions: Vec<(Property, Term)>) {
        if !self.holds_near(&conditions) {
            self.pointwise.push(origin.clone());
        }
        conditions.append(&mut self.brought);
        let said: Vec<Term> = conditions.iter().map(|(_, of)| *of).chain([term]).collect();
        let time = self.statement.running().filter(|&time| {
            said.iter().any(|&term| {
                let written = self.statement.written_out(term);
                self.statement.terms().holds(written, time)
            })
        });
        let every_index = self.scope.in_flight || self.runs_over_indices(term);
        if time.is_none() && !every_index {
            let mut all = self.statement.domain(term);
            for (_, of) in &conditions {
                all.extend(self.statement.domain(*of));
            }
            all.extend(conditions);
            self.push(origin.clone(), property, term, None);
            for (property, of) in all {
                self.push(Origin::DomainOf(origin.to_string()), property, of, None);
            }
            return;
        }
        let law = Law {
            time,
            interval: (self.scope.in_flight && time.is_some()).then_some(self.scope.flight),
            every_index,
            conditions,
        };
        self.push(origin, property, term, Some(law));
    }

    /// Whether these conditions hold near any point at which they hold, as times and states change.
    fn holds_near(&mut self, conditions: &[(Property, Term)]) -> bool {
        let terms: Vec<Term> = conditions
            .iter()
            .map(|(_, of)| self.statement.written_out(*of))
            .collect();
        let mut all: Vec<(Property, Term)> = conditions
            .iter()
            .map(|(property, _)| *property)
            .zip(terms.clone())
            .collect();
        for &term in &terms {
            all.extend(self.statement.domain(term));
        }
        let near = self.statement.holding_near(&all, &terms, &Statement::depends);
        near.is_some_and(|near| near.is_empty())
    }

    fn push(&mut self, origin: Origin, property: Property, term: Term, law: Option<Law>) {
        let known = |given: &Given| given.property == property && given.term == term && given.law == law;
        if !self.statement.givens().iter().any(known) {
            self.statement.parts().givens.push(Given {
                origin,
                property,
                term,
                law,
            });
        }
    }

    fn runs_over_indices(&mut self, term: Term) -> bool {
        let mut indices = self.symbols.indices();
        let members_run = indices.any(|letter| letter.to_string() == self.symbols.index);
        let written = self.statement.written_out(term);
        self.statement
            .terms()
            .inside(written)
            .into_iter()
            .any(|inner| match self.statement.terms().node(inner) {
                Node::Symbol(symbol) => match self.names.of(&self.statement, *symbol) {
                    Some(Named::State { .. } | Named::Time { .. }) => members_run,
                    // the index itself
                    Some(Named::Parameter(name)) => self.symbols.is_index(&name),
                    _ => false,
                },
                _ => false,
            })
    }

    /// The goal of a claim.
    fn claim(&mut self, equation: &Equation, _at: usize) -> Result<(Property, Term), Unreadable> {
        let scope = self.scope_of(equation, self.locals, 1, Some(self.scope.flight));
        self.own_scope(scope.flight, scope.in_flight);
        if scope.in_flight {
            *self.statement.parts().interval = Some(scope.flight);
        }
        let goal = self.relation(equation)?;
        self.written.push(goal.1);
        let brought = std::mem::take(&mut self.brought);
        for (property, term) in brought {
            self.push(Origin::ClaimDomain, property, term, None);
        }
        Ok(goal)
    }

    /// What else the claim writes is defined too: the other equations, at the same time of a flight where the claim speaks
    /// of that flight and at every time of theirs otherwise, and its own definitions.
    fn write_claims(&mut self, statements: &Statements, decided: &Equation) -> Result<(), Unreadable> {
        let upper = self.upper;
        let Scope { flight, in_flight, .. } = self.scope;
        for other in statements.claims.iter().filter(|&other| other != decided) {
            let flies = texmath::flies(other, self.symbols);
            self.own_scope(self.first_impact(other).unwrap_or(flight), flies);
            for sign in match upper.is_none() && (has_sign(&other.left) || has_sign(&other.right)) {
                true => vec![Some(true), Some(false)],
                false => vec![upper],
            } {
                self.upper = sign;
                let is_pair = matches!(&other.left, Tree::Symbol(name, _) if pair_of(name).is_some());
                for side in [&other.left, &other.right].into_iter().skip(usize::from(is_pair)) {
                    let term = self.tree(side)?;
                    let conditions = std::mem::take(&mut self.brought);
                    if flies && !(in_flight && self.scope.flight == flight) {
                        let domain = self.statement.domain(term);
                        if conditions.iter().chain(&domain).any(|(_, of)| self.runs(*of)) {
                            let why =
                                format!("where `{side}` is defined changes in flight: write it in an entry of its own");
                            return Err(unreadable(other.at.0, why));
                        }
                    }
                    self.statement.parts().beside.push(term);
                    self.written.push(term);
                    for (property, of) in conditions {
                        self.push(Origin::ClaimDomain, property, of, None);
                    }
                }
            }
        }
        self.upper = upper;
        self.own_scope(flight, in_flight);
        for local in self.locals {
            let scope = self.scope.number;
            let term = self.abbreviation(&local.name, &local.tree, scope, 0)?;
            self.statement.parts().beside.push(term);
            self.written.push(term);
        }
        for (property, term) in std::mem::take(&mut self.brought) {
            self.push(Origin::ClaimDomain, property, term, None);
        }
        Ok(())
    }

    /// Whether a term changes in flight.
    fn runs(&mut self, term: Term) -> bool {
        let running = self.statement.running();
        let written = self.statement.written_out(term);
        let inside = self.statement.terms().inside(written);
        inside
            .into_iter()
            .any(|inner| match self.statement.terms().node(inner) {
                Node::Symbol(symbol) => Some(*symbol) == running,
                Node::Value(function, ..) => matches!(
                    self.statement.functions().get(function.0 as usize),
                    Some(FunctionOf::Interval { .. })
                ),
                _ => false,
            })
    }

    fn in_claim(&mut self, tree: &Tree, _at: usize) -> Result<Term, Unreadable> {
        self.own_scope(self.scope.flight, false);
        let term = self.tree(tree)?;
        let brought = std::mem::take(&mut self.brought);
        for (property, term) in brought {
            self.push(Origin::ClaimDomain, property, term, None);
        }
        Ok(term)
    }

    /// What must hold for `value` to be a solution of the givens for `symbol`, of which it is one itself: of the premises,
    /// and of what is declared of the symbol.
    fn solution(&mut self, symbol: Symbol, value: Term, at: usize) -> Result<Vec<(Property, Term)>, Unreadable> {
        self.declare_signs()?;
        let mut goals = Vec::new();
        let mut solved = Vec::new();
        for (number, given) in self.statement.givens().to_vec().into_iter().enumerate() {
            let term = self.statement.written_out(given.term);
            let conditions = given.law.iter().flat_map(|law| law.conditions.clone());
            let conditions: Vec<Term> = conditions.map(|(_, of)| self.statement.written_out(of)).collect();
            if !conditions
                .iter()
                .chain([&term])
                .any(|&of| self.statement.terms().holds(of, symbol))
            {
                continue;
            }
            if given.law.is_some() {
                let message = format!("({}) is a law: it is not solved for single values", given.origin);
                return Err(unreadable(at, message));
            }
            goals.push((
                given.property,
                self.statement.terms_mut().substitute(term, symbol, value),
            ));
            solved.push((number, given.property, term));
        }
        // one equation with a number as leading coefficient has a complex solution, whatever the others are
        if let [(number, Property::Zero, term)] = solved[..]
            && self.may_be_complex(symbol)
            && self.has_roots(term, symbol)
        {
            self.statement.parts().givens.remove(number);
        }
        Ok(goals)
    }

    /// Whether a symbol is declared complex.
    fn may_be_complex(&self, symbol: Symbol) -> bool {
        let named = self.names.of(&self.statement, symbol);
        matches!(named, Some(Named::Parameter(name)) if self.symbols.is_complex(&name))
    }

    /// Whether a term is a polynomial in a symbol of degree 1 or more, with a number that is not 0 as leading coefficient
    /// and the symbol nowhere else.
    fn has_roots(&self, term: Term, symbol: Symbol) -> bool {
        let terms = self.statement.terms();
        let quotient = Expansion::new(BTreeSet::new(), MOST_ROOT_STEPS).of(terms, term);
        let Ok(quotient) = quotient else { return false };
        let degree = |monomial: &Monomial| -> u32 {
            let powers = monomial
                .iter()
                .filter(|(of, _)| *terms.node(*of) == Node::Symbol(symbol));
            powers.map(|(_, power)| *power).sum()
        };
        let hidden = |of: &Term| *terms.node(*of) != Node::Symbol(symbol) && terms.holds(*of, symbol);
        let numerator = &quotient.numerator;
        let most = numerator.terms().iter().map(|(monomial, _)| degree(monomial)).max();
        let mut leading = numerator
            .terms()
            .iter()
            .filter(|(monomial, _)| Some(degree(monomial)) == most);
        quotient.divisors.is_empty()
            && !numerator.generators().iter().any(hidden)
            && most >= Some(1)
            && leading
                .next()
                .is_some_and(|(monomial, _)| monomial.iter().all(|(of, _)| *terms.node(*of) == Node::Symbol(symbol)))
            && leading.next().is_none()
    }

    /// What must vanish, be positive or the like for a relation to hold.
    fn relation(&mut self, equation: &Equation) -> Result<(Property, Term), Unreadable> {
        let (left, right) = (self.tree(&equation.left)?, self.tree(&equation.right)?);
        let terms = self.statement.terms_mut();
        Ok(match equation.relation {
            Relation::Equal => (Property::Zero, terms.difference(left, right)),
            Relation::NotEqual => (Property::Nonzero, terms.difference(left, right)),
            Relation::Less => (Property::Positive, terms.difference(right, left)),
            Relation::LessOrEqual => (Property::NonNegative, terms.difference(right, left)),
            Relation::Greater => (Property::Positive, terms.difference(left, right)),
            Relation::GreaterOrEqual => (Property::NonNegative, terms.difference(left, right)),
        })
    }

    fn condition(&mut self, condition: &Condition) -> Result<(Property, Term), Unreadable> {
        match condition {
            Condition::Relation(equation) => self.relation(equation),
            Condition::Integer(tree) => Ok((Property::Integer, self.tree(tree)?)),
        }
    }

    /// The statement with these goals: the domain of the claim, and what is declared of every symbol met, are given.
    fn finish(
        mut self,
        equation: &Equation,
        instance: &str,
        goal: Vec<(Property, Term)>,
    ) -> Result<Question, Unreadable> {
        let goal = self.complete(goal)?;
        self.maps.append(&mut self.outright);
        Ok(Question {
            equation: equation.clone(),
            instance: instance.to_string(),
            statement: self.statement.finish(goal),
            names: self.names,
            maps: self.maps,
        })
    }

    /// Gives what the goals need, and the goals; none where the statement is to be built anew over complex numbers.
    fn complete(&mut self, goal: Vec<(Property, Term)>) -> Result<Vec<(Property, Term)>, Unreadable> {
        // a pair has its signs among the goals
        if !self.is_declared {
            self.declare_signs()?;
        }
        self.derivatives_exist(&goal);
        self.name_times();
        if self.is_complex() && !self.statement.is_complex() {
            // it is built anew, with principal branches
            *self.statement.parts().complex = true;
            return Ok(Vec::new());
        }
        if self.statement.is_complex() && self.real_only {
            return Err(unreadable(
                0,
                "absolute values are not read where complex numbers take part",
            ));
        }
        for term in std::mem::take(&mut self.written) {
            for (property, of) in self.statement.domain(term) {
                self.push(Origin::ClaimDomain, property, of, None);
            }
        }
        if self.statement.is_complex() {
            let ordered = |property: Property| matches!(property, Property::Positive | Property::NonNegative);
            let givens = self.statement.givens().iter().map(|given| (given.property, given.term));
            for (property, term) in givens.chain(goal.iter().copied()) {
                if ordered(property) && !self.statement.is_real(term) {
                    if goal.iter().all(|(property, _)| *property == Property::Zero) {
                        return Err(unreadable(
                            0,
                            "roots, powers and conditions of what may be complex are not read",
                        ));
                    }
                    return Err(unreadable(0, "an inequality between complex numbers has no meaning"));
                }
            }
        }
        if self.statement.is_complex() {
            let goals = goal.iter().map(|(_, term)| *term);
            let spoken: Vec<Term> = self
                .statement
                .givens()
                .iter()
                .map(|given| given.term)
                .chain(goals)
                .collect();
            for term in spoken {
                let term = self.statement.written_out(term);
                for inner in self.statement.terms().inside(term) {
                    if let Node::Value(_, _, at) = self.statement.terms().node(inner)
                        && !self.statement.is_real(*at)
                    {
                        return Err(unreadable(0, "an unknown function of a complex number has no meaning"));
                    }
                }
            }
        }
        if self.statement.terms().len() > MOST_TERMS {
            return Err(unreadable(
                0,
                format!("the claim and its premises come to more than {MOST_TERMS} terms"),
            ));
        }
        Ok(goal)
    }

    /// Where laws of flight are given, the impacts at which states are named have times.
    fn name_times(&mut self) {
        let is_flight = |given: &Given| given.law.as_ref().is_some_and(|law| law.interval.is_some());
        let (Some(family), true) = (
            self.symbols.times().next().and_then(|family| self.names.time(family)),
            self.statement.givens().iter().any(is_flight),
        ) else {
            return;
        };
        for number in 0..self.statement.quantities().len() {
            if let Some((_, index)) = self.statement.number_of(symbol(number)) {
                self.statement.member(family, index);
            }
        }
    }

    fn is_complex(&mut self) -> bool {
        let declared = |symbol: &Symbol| match self.names.of(&self.statement, *symbol) {
            Some(Named::Parameter(name)) => self.symbols.is_complex(&name),
            Some(Named::State { state, .. } | Named::Absolute { state, .. }) => {
                self.symbols.complex().any(|name| name.bare() == state)
            }
            _ => false,
        };
        let all = (0..self.statement.quantities().len()).map(symbol);
        let complex: Vec<Symbol> = all.filter(declared).collect();
        let conditions = |given: &Given| given.law.clone().map_or(Vec::new(), |law| law.conditions);
        let given = self.statement.givens().iter();
        let given = given.flat_map(|given| conditions(given).into_iter().map(|(_, of)| of).chain([given.term]));
        let given: Vec<Term> = given.collect();
        let mut inside = BTreeSet::new();
        for term in given.into_iter().chain(self.written.clone()) {
            let term = self.statement.written_out(term);
            inside.extend(self.statement.terms().inside(term));
        }
        let takes_part = |term: &Term| match self.statement.terms().node(*term) {
            Node::Imaginary => true,
            Node::Symbol(symbol) => complex.contains(symbol),
            _ => false,
        };
        let result = inside.iter().any(takes_part);
        *self.statement.parts().complex_symbols = complex;
        result
    }

    /// What `[symbols]` says of each symbol that the claim or its premises speak of.
    fn declare_signs(&mut self) -> Result<(), Unreadable> {
        self.is_declared = true;
        let symbols = self.symbols;
        let lists = [
            (Meaning::Positive, Property::Positive),
            (Meaning::Nonnegative, Property::NonNegative),
            (Meaning::Nonzero, Property::Nonzero),
            (Meaning::Integer, Property::Integer),
            (Meaning::Index, Property::Integer),
        ];
        // an abbreviation that is declared positive is so whether or not it is written
        for (name, _) in symbols.abbreviations() {
            let is_listed = lists.iter().any(|(kind, _)| symbols.is(name, kind)) || symbols.is_at_most_one(name);
            let symbol = Tree::Symbol(name.clone(), Default::default());
            let is_timeless = symbols.impacts(&Equation::between(symbol.clone(), symbol)).is_empty();
            if is_listed && (is_timeless || !self.statement.instants().is_empty()) {
                self.own_scope(0, false);
                self.tree(&Tree::Symbol(name.clone(), Default::default()))?;
            }
        }
        for at in 0..self.statement.quantities().len() {
            let symbol = symbol(at);
            let Some(named) = self.names.of(&self.statement, symbol) else {
                continue;
            };
            let name = match &named {
                Named::Parameter(name) | Named::Local { name, scope: 0 } => name.clone(),
                Named::State { state, .. } => state.clone(),
                Named::Time { family, .. } => family.clone(),
                Named::Running => symbols.running().cloned().unwrap_or_default(),
                _ => continue,
            };
            let origin = Origin::Declared(name.to_string());
            let term = self.statement.terms_mut().symbol(symbol);
            for (kind, property) in &lists {
                if self.is_listed(&named, kind) {
                    self.push(origin.clone(), *property, term, None);
                }
            }
            if self.is_listed(&named, &Meaning::AtMostOne) {
                let one = self.statement.terms_mut().integer(1);
                let rest = self.statement.terms_mut().difference(one, term);
                self.push(origin.clone(), Property::NonNegative, rest, None);
            }
            if self.is_listed(&named, &Meaning::Generic) {
                self.statement.parts().generic.push(symbol);
            }
        }
        Ok(())
    }

    /// Returns true if a list of `[symbols]` names a symbol: states and times by an index, which stands for every one where it runs.
    fn is_listed(&self, named: &Named, kind: &Meaning) -> bool {
        let letter = &self.symbols.index;
        let runs = self.symbols.indices().any(|name| is_letter(name, letter));
        let at =
            |name: &Name, index: i32| index_of(&name.subscript, letter).is_some_and(|listed| runs || listed == index);
        self.symbols.all(kind).any(|name| match named {
            Named::Parameter(known) | Named::Local { name: known, scope: 0 } => name == known,
            Named::State { state, index, after } => {
                let continuous = self.symbols.is_continuous(state);
                name.bare() == *state && at(name, *index) && (continuous || *after == (name.mark == "+"))
            }
            Named::Time { family, index } => name.bare() == *family && at(name, *index),
            Named::Running => self.symbols.running() == Some(name),
            _ => false,
        })
    }

    fn declare_derivatives(&mut self) -> Result<(), Unreadable> {
        for (name, derivative) in self.symbols.functions() {
            if let Some(Tree::Symbol(next, _)) = derivative
                && self.symbols.is_function(next)
            {
                let [function, next] = [name, next].map(|name| self.names.function(&mut self.statement, name));
                self.statement.parts().derivatives.insert(function, next);
            }
        }
        // a derivative that is a formula is a law: f' = formula at every time
        for (name, derivative) in self.symbols.functions() {
            let Some(tree) =
                derivative.filter(|tree| !matches!(tree, Tree::Symbol(next, _) if self.symbols.is_function(next)))
            else {
                continue;
            };
            let time = self.running()?;
            let right = self.tree(tree)?;
            let function = self.names.function(&mut self.statement, name);
            let left = self.statement.value(function, 1, time);
            let term = self.statement.terms_mut().difference(left, right);
            self.give(
                Origin::Table(format!("the derivative of {name}")),
                Property::Zero,
                term,
                Vec::new(),
            );
        }
        Ok(())
    }

    fn declare_periods(&mut self) -> Result<(), Unreadable> {
        for (name, period) in self.symbols.periods() {
            let (time, period) = (self.running()?, self.tree(period)?);
            let later = self.statement.terms_mut().sum(vec![time, period]);
            let (now, then) = (self.value_of(name, 0, time)?, self.value_of(name, 0, later)?);
            let term = self.statement.terms_mut().difference(then, now);
            self.give(
                Origin::Table(format!("the period of {name}")),
                Property::Zero,
                term,
                Vec::new(),
            );
        }
        Ok(())
    }

    /// The running time of the equation being read.
    fn running(&mut self) -> Result<Term, Unreadable> {
        if let Some(running) = self.running {
            return Ok(running);
        }
        let text = self.symbols.running().map_or("t".to_string(), Name::to_string);
        let symbol = self.statement.symbol_of(Quantity::Running, text);
        Ok(self.statement.terms_mut().symbol(symbol))
    }

    /// The state, without dots, and the number of dots of a name of a motion.
    fn motion(&self, name: &Name) -> Option<(Name, u32)> {
        let bare = name.bare();
        if !name.subscript.is_empty() {
            return None;
        }
        for state in self.symbols.states() {
            let mut dotted = state.clone();
            for more in 0..3 {
                if dotted == bare {
                    let (root, dots) = undotted(state);
                    return Some((root, dots + more));
                }
                dotted = dotted.dotted();
            }
        }
        None
    }

    /// A function's derivative of some order, at a time.
    fn value_of(&mut self, name: &Name, order: u32, at: Term) -> Result<Term, Unreadable> {
        let plain = Name {
            primes: 0,
            mark: String::new(),
            ..name.clone()
        };
        if let Some((state, dots)) = self.motion(&plain)
            && let Some(motion) = self.names.motion(&state)
        {
            let flight = self.scope.flight;
            return Ok(self.statement.value_within(motion, flight, dots + order, at));
        }
        let function = self.names.function(&mut self.statement, &plain);
        Ok(self.statement.value(function, order, at))
    }

    fn trees(&mut self, trees: &[Tree]) -> Result<Vec<Term>, Unreadable> {
        trees.iter().map(|tree| self.tree(tree)).collect()
    }

    /// The term of a tree.
    fn tree(&mut self, tree: &Tree) -> Result<Term, Unreadable> {
        if self.statement.terms().len() > MOST_TERMS {
            return Err(unreadable(
                0,
                format!("the claim and its premises come to more than {MOST_TERMS} terms"),
            ));
        }
        Ok(match tree {
            Tree::Number(value) => self.statement.terms_mut().number(value.clone()),
            Tree::Symbol(name, at) => self.name(name, at.0)?,
            Tree::Call(name, argument, at) => self.call(name, argument, at.0)?,
            Tree::Partial { of, by, at } => self.partial(of, by, at.0)?,
            Tree::Invariant { kind, of, at } => self.invariant(*kind, of, at.0)?,
            Tree::Negate(body) => {
                let body = self.tree(body)?;
                self.statement.terms_mut().negative(body)
            }
            Tree::Sum(parts) => {
                let parts = self.trees(parts)?;
                self.statement.terms_mut().sum(parts)
            }
            Tree::Product(parts) => {
                let parts = self.trees(parts)?;
                self.statement.terms_mut().product(parts)
            }
            Tree::Quotient(above, below, at) => {
                if let Some(by) = differentiated_by(below)
                    && (self.symbols.running() == Some(by) || is_letter(by, "t") || begins_with_d(above))
                {
                    let message = "this can be read as a derivative and as a quotient: write the derivative by its name, or `d` beside another factor";
                    return Err(unreadable(at.0, message));
                }
                let (above, below) = (self.tree(above)?, self.tree(below)?);
                self.statement.terms_mut().quotient(above, below)
            }
            Tree::Power(base, exponent, _) => {
                let base = self.tree(base)?;
                self.power(base, *exponent)
            }
            Tree::RealPower(base, exponent, at) => self.real_power(base, exponent, at.0)?,
            Tree::Root(radicand, index, _) => {
                let radicand = self.tree(radicand)?;
                self.statement
                    .terms_mut()
                    .elementary(Elementary::Root(*index), radicand)
            }
            Tree::PlusMinus(body) => self.signed(body, true)?,
            Tree::MinusPlus(body) => self.signed(body, false)?,
            Tree::Operation(operation, at) => match &**operation {
                Operation::Integral {
                    of,
                    by,
                    limits: Some((low, high)),
                } => self.integral(of, by, [low, high], at.0)?,
                _ => return Err(unreadable(at.0, "this operation stands where it is not read")),
            },
        })
    }

    /// The number that an integral without other letters is.
    fn integral(&mut self, of: &Tree, by: &Name, ends: [&Tree; 2], at: usize) -> Result<Term, Unreadable> {
        let refused = || unreadable(at, "this integral is not known to have a value");
        if self.statement.is_complex() || self.bound.is_some() {
            return Err(refused());
        }
        let mut limits = Vec::new();
        for end in ends {
            limits.push(match infinity(end) {
                Some(is_above) => Limit::Infinite(is_above),
                None => Limit::At(self.tree(end)?),
            });
        }
        let brought = self.brought.len();
        self.bound = Some(by.clone());
        let of = self.tree(of);
        self.bound = None;
        let of = of?;
        // what the integrand needs of its letter is shown where the integral is made
        let needed = self.brought.split_off(brought);
        let moves = |term: Term| {
            let terms = self.statement.terms();
            terms
                .inside(term)
                .into_iter()
                .any(|inner| *terms.node(inner) == Node::Bound)
        };
        let fixed: Vec<(Property, Term)> = needed.into_iter().filter(|(_, term)| !moves(*term)).collect();
        self.brought.extend(fixed);
        let zero = self.statement.terms_mut().integer(0);
        let value = match *limits.as_slice() {
            [Limit::At(low), Limit::At(high)] => self.statement.terms_mut().integral(of, low, high),
            [Limit::At(low), Limit::Infinite(is_above)] => self.integral_over_a_ray(of, low, is_above),
            [Limit::Infinite(is_above), Limit::At(high)] => {
                let value = self.integral_over_a_ray(of, high, is_above);
                value.map(|value| self.statement.terms_mut().negative(value))
            }
            [Limit::Infinite(first), Limit::Infinite(second)] if first != second => {
                let parts = [second, first].map(|is_above| self.integral_over_a_ray(of, zero, is_above));
                let [Some(second), Some(first)] = parts else {
                    return Err(refused());
                };
                Some(self.statement.terms_mut().difference(second, first))
            }
            _ => None,
        };
        value.ok_or_else(refused)
    }

    /// The integral of a term in the bound letter x from a closed term a to infinity, or to minus infinity.
    ///
    /// To infinity it is the integral from a to a + 1 and that from a + 1 on, with x = a + 1/u: of f(a + 1/u)/u^2 from 0 to 1. To
    /// minus infinity it is the integral from a to a - 1 less that of f(a - 1/u)/u^2 from 0 to 1.
    fn integral_over_a_ray(&mut self, of: Term, from: Term, is_above: bool) -> Option<Term> {
        let terms = self.statement.terms_mut();
        let sign = if is_above { 1 } else { -1 };
        let (letter, step) = (terms.add(Node::Bound), terms.integer(sign));
        let inverse = terms.quotient(step, letter);
        let (next, far) = match terms.node(from).clone() {
            Node::Number(number) if number.is_zero() => (step, inverse),
            Node::Number(number) => {
                let next = terms.number(number + Rational::from_integer(sign));
                (next, terms.sum(vec![from, inverse]))
            }
            _ => (terms.sum(vec![from, step]), terms.sum(vec![from, inverse])),
        };
        let near = terms.integral(of, from, next)?;
        let moved = terms.rewrite(of, &mut |_, node| (*node == Node::Bound).then_some(far));
        let square = terms.add(Node::Power(letter, 2));
        let moved = terms.quotient(moved, square);
        let (zero, one) = (terms.integer(0), terms.integer(1));
        let rest = terms.integral(moved, zero, one)?;
        Some(match is_above {
            true => terms.sum(vec![near, rest]),
            false => terms.difference(near, rest),
        })
    }

    fn signed(&mut self, body: &Tree, plus_above: bool) -> Result<Term, Unreadable> {
        let Some(upper) = self.upper else {
            return Err(unreadable(0, r"`\pm` can stand in a claim only"));
        };
        let body = self.tree(body)?;
        Ok(if upper == plus_above {
            body
        } else {
            self.statement.terms_mut().negative(body)
        })
    }

    fn power(&mut self, base: Term, exponent: i32) -> Term {
        let terms = self.statement.terms_mut();
        match exponent {
            1 => base,
            2.. | 0 => terms.add(Node::Power(base, exponent)),
            _ => {
                let below = match exponent.checked_neg() {
                    Some(1) => base,
                    Some(positive) => terms.add(Node::Power(base, positive)),
                    None => {
                        let most = terms.add(Node::Power(base, i32::MAX));
                        terms.product(vec![most, base])
                    }
                };
                let one = terms.integer(1);
                terms.quotient(one, below)
            }
        }
    }

    fn real_power(&mut self, base: &Tree, exponent: &Tree, at: usize) -> Result<Term, Unreadable> {
        // what is written with symbols is no number, whatever it adds up to
        let is_number = !texmath::any(exponent, &mut |tree| {
            !matches!(
                tree,
                Tree::Number(_) | Tree::Sum(_) | Tree::Product(_) | Tree::Negate(_) | Tree::Quotient(..)
            )
        });
        let exponent = self.tree(exponent)?;
        if let Tree::Symbol(name, _) = base
            && is_letter(name, "e")
            && !self.is_declared(name)
        {
            return Ok(self.statement.terms_mut().elementary(Elementary::Exp, exponent));
        }
        let base = self.tree(base)?;
        let mut expansion = Expansion::new(BTreeSet::new(), 1000);
        let constant = expansion.of(self.statement.terms(), exponent).ok();
        let constant = constant.filter(|quotient| is_number && quotient.divisors.is_empty());
        if let Some(Rational(value)) = constant.and_then(|quotient| quotient.numerator.as_constant()) {
            let index = u32::try_from(value.denominator()).ok().filter(|index| *index <= 1000);
            let power = i32::try_from(value.numerator())
                .ok()
                .filter(|power| power.abs() <= 10_000);
            let (Some(index), Some(power)) = (index, power) else {
                return Err(unreadable(at, "this exponent is too large to be read"));
            };
            if index == 1 {
                return Ok(self.power(base, power));
            }
            if !self.statement.is_complex() {
                self.brought.push((Property::NonNegative, base));
            }
            // an odd root has values at negative numbers, which the power has not: within an integral an even one says so
            let (index, power) = match self.bound.is_some() && index % 2 == 1 {
                true => (2 * index, 2 * power),
                false => (index, power),
            };
            let root = self.statement.terms_mut().elementary(Elementary::Root(index), base);
            return Ok(self.power(root, power));
        }
        // what the exponent is called does not matter where it is an integer
        let meant = self.statement.written_out(exponent);
        let integer = [exponent, meant].into_iter().find(|term| self.is_integer(*term));
        let (whole, exponent) = (integer.is_some(), integer.unwrap_or(exponent));
        if !whole {
            let principal = self.statement.is_complex();
            let property = if principal {
                Property::Nonzero
            } else {
                Property::NonNegative
            };
            self.brought.push((property, base));
        }
        if matches!(self.statement.terms().node(base), Node::Number(value) if value.0.is_zero()) {
            if self.statement.is_complex() {
                return Err(unreadable(at, "powers of 0 among complex numbers are not read"));
            }
            // 0^0 is 1 where the exponent is an integer
            let property = if whole {
                Property::NonNegative
            } else {
                Property::Positive
            };
            self.brought.push((property, exponent));
        }
        Ok(self.statement.terms_mut().add(Node::RealPower(base, exponent)))
    }

    fn is_assumed_integer(&self, named: &Named) -> bool {
        matches!(named, Named::Parameter(name) if self.assumed_integers.contains(name))
    }

    /// Whether a term is written with numbers and symbols declared or assumed to be integers alone, and is, multiplied out, a polynomial
    /// that is an integer wherever these are.
    fn is_integer(&self, term: Term) -> bool {
        let terms = self.statement.terms();
        let may_stand = |inner: Term| match terms.node(inner) {
            Node::Number(_) | Node::Sum(_) | Node::Product(_) | Node::Power(..) | Node::Quotient(..) => true,
            Node::Symbol(symbol) => self.names.of(&self.statement, *symbol).is_some_and(|named| {
                let is_index = matches!(&named, Named::Parameter(name) if self.symbols.is_index(name));
                is_index || self.is_listed(&named, &Meaning::Integer) || self.is_assumed_integer(&named)
            }),
            _ => false,
        };
        if !terms.inside(term).into_iter().all(may_stand) {
            return false;
        }
        let mut expansion = Expansion::new(BTreeSet::new(), 1000);
        expansion
            .of(terms, term)
            .is_ok_and(|quotient| quotient.divisors.is_empty() && quotient.numerator.is_integer_valued())
    }

    fn is_declared(&self, name: &Name) -> bool {
        self.scope.locals.iter().any(|local| local.name == *name)
            || self.symbols.is_parameter(name)
            || self.symbols.abbreviation(name).is_some()
    }

    fn name(&mut self, name: &Name, at: usize) -> Result<Term, Unreadable> {
        if self.bound.as_ref() == Some(name) {
            return Ok(self.statement.terms_mut().add(Node::Bound));
        }
        if let Some(local) = self.scope.locals.iter().find(|local| local.name == *name) {
            return self.abbreviation(&local.name, &local.tree, self.scope.number, at);
        }
        if self.symbols.is_parameter(name) || self.symbols.is_index(name) {
            let quantity = match is_letter(name, &self.symbols.index) {
                true => Quantity::Index,
                false => Quantity::Parameter,
            };
            let symbol = self.symbol(Named::Parameter(name.clone()), quantity, name.to_string());
            return Ok(self.statement.terms_mut().symbol(symbol));
        }
        if let Some(tree) = self.symbols.abbreviation(name) {
            return self.abbreviation(name, tree, 0, at);
        }
        if let Some(symbol) = self.quantity(name).or_else(|| self.absolute(name)) {
            return Ok(self.statement.terms_mut().symbol(symbol));
        }
        if self.symbols.running() == Some(name) {
            return self.running();
        }
        if name.mark.is_empty() && (self.symbols.is_function(name) || (name.primes == 0 && self.motion(name).is_some()))
        {
            let time = self.running()?;
            return self.value_of(name, u32::from(name.primes), time);
        }
        if is_letter(name, r"\pi") {
            return Ok(self.statement.terms_mut().add(Node::Pi));
        }
        if is_letter(name, "e") {
            let one = self.statement.terms_mut().integer(1);
            return Ok(self.statement.terms_mut().elementary(Elementary::Exp, one));
        }
        if is_letter(name, "i") {
            return Ok(self.statement.terms_mut().add(Node::Imaginary));
        }
        Err(unreadable(at, format!("unknown symbol `{name}`")))
    }

    /// The symbol of an abbreviation, defined by its tree.
    fn abbreviation(&mut self, name: &Name, tree: &'a Tree, scope: usize, at: usize) -> Result<Term, Unreadable> {
        if let Some(&known) = self.known.get(&(name.clone(), scope)) {
            let (conditions, real_only) = self.meant.get(&known).cloned().unwrap_or_default();
            self.brought.extend(conditions);
            self.real_only |= real_only;
            return Ok(known);
        }
        if self.open.contains(name) {
            return Err(unreadable(at, format!("`{name}` is defined by itself")));
        }
        self.open.push(name.clone());
        let (before, real_only) = (self.brought.len(), std::mem::take(&mut self.real_only));
        let meaning = self.tree(tree);
        self.open.pop();
        let meaning = meaning?;
        let needs = (self.brought.get(before..).unwrap_or_default().to_vec(), self.real_only);
        self.real_only |= real_only;
        let named = Named::Local {
            name: name.clone(),
            scope,
        };
        let symbol = self.symbol(named, Quantity::Abbreviation { is_local: scope > 0 }, name.to_string());
        self.statement.parts().definitions.insert(symbol, meaning);
        let term = self.statement.terms_mut().symbol(symbol);
        self.known.insert((name.clone(), scope), term);
        self.meant.insert(term, needs);
        Ok(term)
    }

    fn symbol(&mut self, named: Named, quantity: Quantity, text: String) -> Symbol {
        self.names.symbol(&mut self.statement, named, quantity, text)
    }

    /// The symbol of an indexed time or state.
    fn quantity(&mut self, name: &Name) -> Option<Symbol> {
        // a mark without an index, as in \dot{x}^+ = -r \dot{x}^-, is said of the impact k
        let unnumbered = name.subscript.is_empty() && matches!(name.mark.as_str(), "-" | "+");
        let index = match unnumbered {
            true => 0,
            false => index_of(&name.subscript, &self.symbols.index)?,
        };
        let bare = name.bare();
        if name.primes > 0 {
            return None;
        }
        if name.mark.is_empty() && self.symbols.is_time(&bare) {
            return Some(self.statement.member(self.names.time(&bare)?, index));
        }
        let is_state = self.symbols.is_state(&bare) && matches!(name.mark.as_str(), "" | "-" | "+");
        let sequence = self.names.state(&bare, name.mark == "+").filter(|_| is_state)?;
        Some(self.statement.member(sequence, index))
    }

    /// The symbol of a state at an index that is a number, where indices run.
    fn absolute(&mut self, name: &Name) -> Option<Symbol> {
        let runs = self
            .symbols
            .indices()
            .any(|letter| is_letter(letter, &self.symbols.index));
        let index: i32 = name.subscript.parse().ok()?;
        let state = name.bare();
        let plain = name.primes == 0 && name.mark.is_empty() && self.symbols.is_state(&state);
        (runs && plain).then(|| self.symbol(Named::Absolute { state, index }, Quantity::Numbered, name.to_string()))
    }

    fn call(&mut self, name: &Name, argument: &Tree, at: usize) -> Result<Term, Unreadable> {
        if self.symbols.is_function(name) {
            let time = self.tree(argument)?;
            return self.value_of(name, u32::from(name.primes), time);
        }
        if let Some((_, dots)) = self.motion(name) {
            return self.motion_at(name, dots, argument, at);
        }
        let function = name.base.as_str();
        if !function.starts_with('\\') || !is_letter(name, function) {
            return Err(unreadable(at, format!("`{name}` is not a function here")));
        }
        let of = self.tree(argument)?;
        self.elementary(name, of)
            .ok_or_else(|| unreadable(at, format!("`{name}` is not read yet")))
    }

    /// The value of a state at a time: at the time of an impact, the value there.
    fn motion_at(&mut self, name: &Name, dots: u32, argument: &Tree, at: usize) -> Result<Term, Unreadable> {
        if let Tree::Symbol(time, _) = argument
            && self.symbols.is_time(&time.bare())
            && let Some(index) = index_of(&time.subscript, &self.symbols.index)
            && self.symbols.is_state(&name.bare())
        {
            if name.primes > 0 || !matches!(name.mark.as_str(), "" | "+" | "-") {
                let what = format!("`{name}({time})` is no state at an impact");
                return Err(unreadable(
                    at,
                    format!("{what}: write \\dot{{x}}_k for a derivative, and + or - for a side"),
                ));
            }
            let at_departure = name.mark.is_empty() && self.scope.in_flight && self.scope.flight == index;
            if at_departure && !self.symbols.is_continuous(&name.bare()) {
                let what = format!("`{name}({time})` in a law of flight is the value before the impact or after it");
                return Err(unreadable(at, format!("{what}: write the index, or a mark `+` or `-`")));
            }
            let departs = name.mark == "+" || at_departure;
            let sequence = self.names.state(&name.bare(), departs);
            let sequence = sequence.ok_or_else(|| unreadable(at, format!("`{name}` is no state")))?;
            let symbol = self.statement.member(sequence, index);
            return Ok(self.statement.terms_mut().symbol(symbol));
        }
        if !name.mark.is_empty() {
            return Err(unreadable(
                at,
                format!("`{name}` needs the time of an impact in its bracket"),
            ));
        }
        let _ = dots;
        let time = self.tree(argument)?;
        self.value_of(name, u32::from(name.primes), time)
    }

    /// An elementary function: a term of its own, or what it is defined to be.
    fn elementary(&mut self, function: &Name, of: Term) -> Option<Term> {
        let own = match function.base.as_str() {
            r"\sin" => Elementary::Sin,
            r"\cos" => Elementary::Cos,
            r"\exp" => Elementary::Exp,
            r"\ln" => Elementary::Ln,
            r"\arcsin" => Elementary::Arcsin,
            r"\arccos" => Elementary::Arccos,
            r"\arctan" => Elementary::Arctan,
            r"\abs" => {
                self.real_only = true;
                let square = self.statement.terms_mut().add(Node::Power(of, 2));
                return Some(self.statement.terms_mut().elementary(Elementary::Root(2), square));
            }
            _ => {
                let letter = Tree::Symbol(Name::default(), At::default());
                let definition = texmath::Elementary::named(function)?.definition(&letter)?;
                return self.defined(&definition, of);
            }
        };
        Some(self.statement.terms_mut().elementary(own, of))
    }

    /// The term of a definition, where each symbol stands for this one.
    fn defined(&mut self, definition: &Tree, of: Term) -> Option<Term> {
        let mut part = |tree: &Tree| self.defined(tree, of);
        Some(match definition {
            Tree::Symbol(..) => of,
            Tree::Number(value) => self.statement.terms_mut().number(value.clone()),
            Tree::Negate(inner) => {
                let inner = part(inner)?;
                self.statement.terms_mut().negative(inner)
            }
            Tree::Sum(parts) => {
                let parts = parts.iter().map(part).collect::<Option<_>>()?;
                self.statement.terms_mut().sum(parts)
            }
            Tree::Product(parts) => {
                let parts = parts.iter().map(part).collect::<Option<_>>()?;
                self.statement.terms_mut().product(parts)
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (part(above)?, part(below)?);
                self.statement.terms_mut().quotient(above, below)
            }
            Tree::Power(base, exponent, _) => {
                let base = part(base)?;
                self.statement.terms_mut().add(Node::Power(base, *exponent))
            }
            Tree::Root(radicand, index, _) => {
                let radicand = part(radicand)?;
                self.statement
                    .terms_mut()
                    .elementary(Elementary::Root(*index), radicand)
            }
            Tree::Call(name, argument, _) => {
                let argument = part(argument)?;
                self.elementary(name, argument)?
            }
            _ => return None,
        })
    }

    /// Whether trace and determinant are symbols only: no derivative is written, and no premise speaks of a map.
    fn is_opaque(&self, statements: &Statements) -> bool {
        let maps = self.symbols.maps();
        if maps.clone().any(|(_, map)| matches!(map, Map::Equations(_))) {
            return false;
        }
        let mut trees = statements
            .claims
            .iter()
            .chain(statements.premises.iter().map(|premise| &premise.equation));
        let writes =
            |equation: &Equation| texmath::any_side(equation, &mut |node| matches!(node, Tree::Partial { .. }));
        if trees.any(writes) {
            return false;
        }
        let steps = maps.filter_map(|(_, map)| match map {
            Map::Premises { of, .. } => Some(of),
            _ => None,
        });
        let named: BTreeSet<i32> = steps
            .flatten()
            .filter_map(|tree| match tree {
                Tree::Symbol(name, _) => index_of(&name.subscript, &self.symbols.index),
                _ => None,
            })
            .collect();
        !statements.premises.iter().any(|premise| {
            self.symbols
                .impacts(&premise.equation)
                .iter()
                .any(|index| named.contains(index))
                || texmath::flies(&premise.equation, self.symbols)
        })
    }

    fn partial(&mut self, of: &Name, by: &Name, at: usize) -> Result<Term, Unreadable> {
        let none = || unreadable(at, format!("no map gives the derivative of `{of}` by `{by}`"));
        let (above, below) = (self.quantity(of).ok_or_else(none)?, self.quantity(by).ok_or_else(none)?);
        let (explicit, mut steps): (Vec<_>, Vec<_>) = self
            .map_steps()?
            .into_iter()
            .partition(|(_, step)| !step.implicit.equations.is_empty());
        let leads = |step: &MapStep| step.implicit.of.contains(&above) && step.implicit.by.contains(&below);
        if explicit.iter().any(|(_, step)| leads(step)) {
            steps.retain(|(_, step)| self.is_led_to(step));
        }
        if !steps.iter().any(|(_, step)| leads(step)) {
            // where the premises lead nowhere, along the one explicit map that does
            let mut explicit = explicit.into_iter().filter(|(_, step)| leads(step));
            steps.extend(explicit.next().filter(|_| explicit.next().is_none()));
        }
        self.entry(above, below, &steps, steps.len()).ok_or_else(none)
    }

    /// Whether a premise says something of what a map gives.
    fn is_led_to(&mut self, step: &MapStep) -> bool {
        let mut spoken = self.spoken.clone().into_iter();
        self.has_flight
            || spoken.any(|name| {
                self.quantity(&name)
                    .is_some_and(|symbol| step.implicit.of.contains(&symbol))
            })
    }

    /// The derivative of one quantity by another: 1 and 0 among those a map starts from, by the chain rule where
    /// impacts lie between.
    fn entry(&mut self, of: Symbol, by: Symbol, steps: &[(Name, MapStep)], left: usize) -> Option<Term> {
        let here: Vec<&MapStep> = steps
            .iter()
            .map(|(_, step)| step)
            .filter(|step| step.implicit.by.contains(&by))
            .collect();
        if here.iter().any(|step| step.implicit.by.contains(&of)) {
            return Some(self.statement.terms_mut().integer(i64::from(of == by)));
        }
        if let Some(step) = here.iter().find(|step| step.implicit.of.contains(&of)) {
            return Some(self.slope(of, by, step));
        }
        if left == 0 {
            return None;
        }
        for step in here {
            let chained = step.implicit.of.iter().map(|&between| {
                let inner = self.slope(between, by, step);
                let outer = self.entry(of, between, steps, left - 1)?;
                Some(self.statement.terms_mut().product(vec![outer, inner]))
            });
            if let Some(parts) = chained.collect::<Option<Vec<Term>>>() {
                return Some(self.statement.terms_mut().sum(parts));
            }
        }
        None
    }

    /// A derivative along one map: a symbol of its own, or the derivative of what the map says outright.
    fn slope(&mut self, of: Symbol, by: Symbol, step: &MapStep) -> Term {
        let place = step.implicit.of.iter().position(|&known| known == of);
        let Some(&image) = place.and_then(|place| step.images.get(place)) else {
            let partial = self.statement.partial(of, by);
            return self.statement.terms_mut().symbol(partial);
        };
        self.written.push(image);
        self.follows(step);
        // the derivative of an equation that holds at single points only says nothing
        let domain = self.statement.domain(image);
        let near = self.statement.holding_near(&domain, &[image], &Statement::depends);
        let origin = Origin::DerivativesExist(self.statement.terms().symbol_name(of).to_owned());
        for (property, of) in near.unwrap_or_default() {
            self.push(origin.clone(), property, of, None);
        }
        self.statement.along(image, &step.implicit, by)
    }

    /// Lists an explicit map among those that derivatives are taken along.
    fn follows(&mut self, step: &MapStep) {
        if self.outright.iter().all(|known| known.name != step.name) {
            self.outright.push(step.clone());
        }
    }

    fn invariant(&mut self, kind: Invariant, of: &Name, at: usize) -> Result<Term, Unreadable> {
        if self.opaque {
            let named = Named::Invariant { kind, of: of.clone() };
            let word = if kind == Invariant::Trace { "Tr" } else { "Det" };
            let symbol = self.symbol(named, Quantity::Fixed, format!("{word}({of})"));
            return Ok(self.statement.terms_mut().symbol(symbol));
        }
        let steps = self.map_steps()?;
        let matrix = self.matrix(of, &steps, self.symbols.maps().count()).ok_or_else(|| {
            unreadable(
                at,
                format!("`{of}` is no known matrix, or one to which no premise leads"),
            )
        })?;
        if matrix.iter().any(|row| row.len() != matrix.len()) {
            return Err(unreadable(
                at,
                format!("`{of}` is a matrix without equal numbers of rows and columns"),
            ));
        }
        Ok(match kind {
            Invariant::Trace => {
                let diagonal = (0..matrix.len()).map(|n| matrix[n][n]).collect();
                self.statement.terms_mut().sum(diagonal)
            }
            Invariant::Determinant => determinant(&mut self.statement, &matrix),
        })
    }

    fn matrix(&mut self, name: &Name, steps: &[(Name, MapStep)], left: usize) -> Option<Vec<Vec<Term>>> {
        if let Some((_, step)) = steps.iter().find(|(known, _)| known == name) {
            let shares = |other: &Implicit| other.of.iter().any(|of| step.implicit.of.contains(of));
            let is_rival =
                |(_, other): &(Name, MapStep)| !other.implicit.equations.is_empty() && shares(&other.implicit);
            if step.implicit.equations.is_empty() && steps.iter().any(is_rival) && !self.is_led_to(step) {
                return None;
            }
            let own = &step.implicit;
            let row = |of: &Symbol| own.by.iter().map(|by| self.slope(*of, *by, step)).collect();
            return Some(own.of.iter().map(row).collect());
        }
        let map = self.symbols.map(name)?;
        let Map::Product(factors) = map else { return None };
        if left == 0 {
            return None;
        }
        let mut product: Option<Vec<Vec<Term>>> = None;
        for factor in factors {
            let next = self.matrix(factor, steps, left - 1)?;
            product = Some(match product {
                None => next,
                Some(before) => self.matrix_product(&before, &next)?,
            });
        }
        product
    }

    fn matrix_product(&mut self, a: &[Vec<Term>], b: &[Vec<Term>]) -> Option<Vec<Vec<Term>>> {
        let columns = b.first()?.len();
        if a.iter().any(|row| row.len() != b.len()) {
            return None;
        }
        let terms = self.statement.terms_mut();
        let mut entry = |row: &Vec<Term>, column: usize| {
            let parts = row
                .iter()
                .zip(b)
                .map(|(left, right)| terms.product(vec![*left, right[column]]));
            let parts = parts.collect();
            terms.sum(parts)
        };
        Some(
            a.iter()
                .map(|row| (0..columns).map(|column| entry(row, column)).collect())
                .collect(),
        )
    }

    /// The maps whose derivatives are symbols of their own: what they take to what.
    fn map_steps(&mut self) -> Result<Vec<(Name, MapStep)>, Unreadable> {
        let mut steps = self.implied.clone();
        for (name, map) in self.symbols.maps() {
            let step = match map {
                Map::Product(_) => continue,
                Map::Premises { of, by } => MapStep {
                    name: name.to_string(),
                    implicit: Implicit {
                        of: self.quantities(of, name)?,
                        by: self.quantities(by, name)?,
                        equations: Vec::new(),
                    },
                    ..MapStep::default()
                },
                Map::Equations(equations) => self.explicit(equations, name)?,
            };
            steps.push((name.clone(), step));
        }
        Ok(steps)
    }

    fn quantities(&mut self, trees: &[Tree], map: &Name) -> Result<Vec<Symbol>, Unreadable> {
        let fault = || unreadable(0, format!("map `{map}` must list times and states"));
        let of = |tree: &Tree, builder: &mut Self| match tree {
            Tree::Symbol(name, _) => builder.quantity(name).ok_or_else(fault),
            _ => Err(fault()),
        };
        trees.iter().map(|tree| of(tree, self)).collect()
    }

    /// The map from the first impact that its equations name to the last: times before states, as declared.
    fn explicit(&mut self, equations: &[Equation], map: &Name) -> Result<MapStep, Unreadable> {
        let named: BTreeSet<Name> = equations.iter().flat_map(names_in).collect();
        let mut order: Vec<(i32, usize, Symbol)> = Vec::new();
        for name in named {
            if let Some(symbol) = self.quantity(&name) {
                let found = match self.names.of(&self.statement, symbol) {
                    Some(Named::Time { index, .. }) => (index, 0),
                    Some(Named::State { state, index, .. }) => {
                        let rank = self.symbols.states().position(|known| *known == state);
                        (index, rank.unwrap_or(0) + 1)
                    }
                    _ => continue,
                };
                order.push((found.0, found.1, symbol));
            }
        }
        order.sort();
        order.dedup();
        let (Some(first), Some(last)) = (order.first().map(|o| o.0), order.last().map(|o| o.0)) else {
            return Err(unreadable(0, format!("map `{map}`: its equations name no states")));
        };
        if first == last {
            let message = format!("map `{map}`: its equations must take the states at one impact to the next");
            return Err(unreadable(0, message));
        }
        let side = |at| {
            order
                .iter()
                .filter(|(index, ..)| *index == at)
                .map(|(.., symbol)| *symbol)
                .collect()
        };
        // what its equations need bears on a claim that names the map alone
        let (brought, real_only) = (std::mem::take(&mut self.brought), std::mem::take(&mut self.real_only));
        let mut rows = Vec::new();
        for equation in equations {
            let (_, term) = self.relation(equation)?;
            rows.push((Origin::Table(format!("the map {map}")), term));
        }
        let implicit = Implicit {
            of: side(last),
            by: side(first),
            equations: rows,
        };
        let images: Option<Vec<Term>> = (implicit.of.iter())
            .map(|&of| self.image(of, equations, &implicit))
            .collect();
        Ok(MapStep {
            name: map.to_string(),
            implicit,
            images: images.unwrap_or_default(),
            conditions: std::mem::replace(&mut self.brought, brought),
            real_only: std::mem::replace(&mut self.real_only, real_only),
        })
    }

    /// What a quantity is, where one of the equations says so outright.
    fn image(&mut self, of: Symbol, equations: &[Equation], implicit: &Implicit) -> Option<Term> {
        let mut outright = equations.iter().filter_map(|equation| {
            let left = self.tree(&equation.left).ok()?;
            let is_outright =
                equation.relation == Relation::Equal && *self.statement.terms().node(left) == Node::Symbol(of);
            is_outright.then(|| self.tree(&equation.right).ok()).flatten()
        });
        let image = outright.next().filter(|_| equations.len() == implicit.of.len())?;
        let written = self.statement.written_out(image);
        let moves = |symbol: Symbol| self.statement.depends(symbol) && !implicit.by.contains(&symbol);
        let mut inside = self.statement.terms().inside(written).into_iter();
        let moved =
            inside.any(|inner| matches!(self.statement.terms().node(inner), Node::Symbol(symbol) if moves(*symbol)));
        (!moved).then_some(written)
    }

    /// Where no map is declared, a derivative of a quantity at one impact by one at the impact before is that of the map
    /// of the premises: from all times and states that these name at the one impact to all at the other.
    fn imply_maps(&mut self, statements: &Statements) {
        let of_premises = |(_, map): (&Name, &Map)| matches!(map, Map::Premises { .. });
        if self.symbols.maps().any(of_premises) || self.opaque {
            return;
        }
        let premises = statements.premises.iter().map(|premise| &premise.equation);
        let mut written: BTreeSet<(Name, Name)> = BTreeSet::new();
        for equation in statements.claims.iter().chain(premises) {
            texmath::any_side(equation, &mut |node| {
                if let Tree::Partial { of, by, .. } = node {
                    written.insert((of.clone(), by.clone()));
                }
                false
            });
        }
        let place = |named: &Named| match named {
            Named::Time { index, .. } => Some((*index, false)),
            Named::State { index, after, .. } => Some((*index, *after)),
            _ => None,
        };
        let premises = statements.premises.iter().map(|premise| &premise.equation);
        let said: Vec<&Equation> = premises.collect();
        let has_explicit = self.symbols.maps().next().is_some();
        for (of, by) in written {
            let names = |equation: &&Equation| {
                texmath::any_side(
                    equation,
                    &mut |node| matches!(node, Tree::Symbol(name, _) if *name == of),
                )
            };
            if has_explicit && !said.iter().any(names) {
                continue;
            }
            let ends = [of, by].map(|name| {
                let symbol = self.quantity(&name)?;
                place(&self.names.of(&self.statement, symbol)?)
            });
            let [Some((last, false)), Some((first, false))] = ends else {
                continue;
            };
            let all = (0..self.statement.quantities().len()).map(symbol);
            let all = all.filter_map(|symbol| Some((symbol, place(&self.names.of(&self.statement, symbol)?)?)));
            let all: Vec<(Symbol, (i32, bool))> = all.collect();
            let at = |index: i32| -> Vec<Symbol> {
                let there = all.iter().filter(|(_, place)| *place == (index, false));
                there.map(|(symbol, _)| *symbol).collect()
            };
            // what an impact changes is not told apart here
            let is_plain = all.iter().all(|(_, (_, after))| !after);
            let implicit = Implicit {
                of: at(last),
                by: at(first),
                equations: Vec::new(),
            };
            let known =
                |(_, known): &(Name, MapStep)| known.implicit.of == implicit.of && known.implicit.by == implicit.by;
            if last == first + 1 && is_plain && !self.implied.iter().any(known) {
                let step = MapStep {
                    implicit,
                    ..MapStep::default()
                };
                self.implied.push((Name::default(), step));
            }
        }
    }

    /// Finds the equations that determine each map that is named, and takes those of explicit maps as given. Of two maps
    /// that lead to the same quantities the equations do not hold together: neither is given then.
    fn declare_maps(&mut self, statements: &Statements) -> Result<(), Unreadable> {
        if (self.symbols.maps().next().is_none() && self.implied.is_empty()) || self.opaque {
            return Ok(());
        }
        let implied = self.implied.len();
        let steps = (0..).zip(self.map_steps()?);
        let steps = steps.filter(|(number, (name, _))| *number < implied || statements.maps.contains(name));
        let steps: Vec<(Name, MapStep)> = steps.map(|(_, step)| step).collect();
        for (number, (name, step)) in steps.iter().enumerate() {
            let others = steps.iter().enumerate().filter(|(other, _)| *other != number);
            let mut others = others.map(|(_, other)| other);
            let rival = others.find(|(_, other)| other.implicit.of.iter().any(|of| step.implicit.of.contains(of)));
            let mut step = step.clone();
            self.real_only |= step.real_only;
            match rival {
                _ if step.implicit.equations.is_empty() => {
                    step.implicit.equations = determining(&mut self.statement, &step.implicit, &self.pointwise);
                }
                None => {
                    for (origin, term) in step.implicit.equations.clone() {
                        self.give(origin, Property::Zero, term, step.conditions.clone());
                    }
                }
                Some((rival, _)) if step.images.is_empty() => {
                    let message = format!(
                        "the maps `{name}` and `{rival}` lead to the same quantities: solve the equations of `{name}` for these, or part the claim"
                    );
                    return Err(unreadable(0, message));
                }
                Some(_) => {}
            }
            match step.images.is_empty() {
                true => {
                    self.statement.parts().implicit.push(step.implicit.clone());
                    self.maps.push(step);
                }
                false => self.follows(&step),
            }
        }
        Ok(())
    }

    /// Takes as given that derivatives along maps exist, where the claim or a premise speaks of such.
    fn derivatives_exist(&mut self, goal: &[(Property, Term)]) {
        let givens = self.statement.givens().iter().map(|given| given.term);
        let beside = self.statement.beside().iter().copied();
        let spoken: Vec<Term> = givens.chain(goal.iter().map(|(_, term)| *term)).chain(beside).collect();
        let mut partials: BTreeSet<Symbol> = BTreeSet::new();
        for term in spoken {
            let term = self.statement.written_out(term);
            for inner in self.statement.terms().inside(term) {
                if let Node::Symbol(symbol) = self.statement.terms().node(inner)
                    && let Some(Quantity::Partial { of, .. }) = self.statement.quantity(*symbol)
                {
                    partials.insert(of);
                }
            }
        }
        for step in self.statement.implicit().to_vec() {
            let is_determined = step.equations.len() == step.of.len();
            if is_determined && step.of.iter().any(|of| partials.contains(of)) {
                let term = slope_determinant(&mut self.statement, &step);
                let names: Vec<&str> = step
                    .of
                    .iter()
                    .map(|of| self.statement.terms().symbol_name(*of))
                    .collect();
                let origin = Origin::DerivativesExist(names.join(", "));
                self.push(origin, Property::Nonzero, term, None);
            }
        }
    }
}

/// The symbol with this number.
fn symbol(number: usize) -> Symbol {
    Symbol(u32::try_from(number).unwrap_or(u32::MAX))
}

/// The symbols that an equation writes.
fn names_in(equation: &Equation) -> BTreeSet<Name> {
    let mut named = BTreeSet::new();
    texmath::any_side(equation, &mut |node| {
        if let Tree::Symbol(name, _) = node {
            named.insert(name.clone());
        }
        false
    });
    named
}

/// Products of terms for the equation of which a claim states the solutions.
const MOST_ROOT_STEPS: u64 = 100_000;

/// The symbol that a condition says to be an integer.
fn assumed_integer(condition: &Condition) -> Option<Name> {
    match condition {
        Condition::Integer(Tree::Symbol(name, _)) => Some(name.clone()),
        _ => None,
    }
}

/// The x of `d x` or `d x^2`, which may print a derivative.
fn differentiated_by(below: &Tree) -> Option<&Name> {
    let Tree::Product(parts) = below else { return None };
    let [first, second] = parts.as_slice() else {
        return None;
    };
    match second {
        _ if !begins_with_d(first) => None,
        Tree::Symbol(by, _) => Some(by),
        Tree::Power(base, ..) => match base.as_ref() {
            Tree::Symbol(by, _) => Some(by),
            _ => None,
        },
        _ => None,
    }
}

/// Whether a formula is `d`, or begins with it or a power of it.
fn begins_with_d(tree: &Tree) -> bool {
    match tree {
        Tree::Symbol(name, _) => is_letter(name, "d") || is_letter(name, r"\mathrm{d}"),
        Tree::Power(base, ..) => begins_with_d(base),
        Tree::Product(parts) => parts.first().is_some_and(begins_with_d),
        _ => false,
    }
}
