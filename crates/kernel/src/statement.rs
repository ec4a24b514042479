//! The statement of a claim: what is given, and what is to be shown, as terms.

use super::expand::{Derivatives, derivative, value};
use super::term::{Elementary, Function, Node, Symbol, Term, Terms};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use texmath::{Invariant, Name};

/// The source of a given.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// A premise or an equation of a map, with its label.
    Premise(String),
    /// A condition for the premise of this label to be defined.
    DomainOf(String),
    /// A condition for the claim to be defined.
    ClaimDomain,
    /// An assumption of the claim.
    Assumptions,
    /// A declaration of the symbol of this name.
    Declared(String),
    /// The derivative, the period or the relation that the symbol table gives.
    Table(String),
    /// The condition that derivatives of these quantities along a map exist, which a proof takes for granted.
    DerivativesExist(String),
    /// A condition on a map or a flight that a witness brings along.
    Witness(&'static str),
}

/// The words in which a given prints that derivatives exist.
pub const DERIVATIVES_EXIST: &str = "derivatives exist of";

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Premise(label) | Self::Table(label) => f.write_str(label),
            Self::DomainOf(label) => write!(f, "the domain of ({label})"),
            Self::ClaimDomain => f.write_str("the domain of the claim"),
            Self::Assumptions => f.write_str("the assumptions"),
            Self::Declared(name) => write!(f, "[symbols] {name}"),
            Self::DerivativesExist(of) => write!(f, "{DERIVATIVES_EXIST} {of}"),
            Self::Witness(what) => f.write_str(what),
        }
    }
}

/// A property of the value of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Property {
    Zero,
    Nonzero,
    Positive,
    NonNegative,
    Integer,
}

/// What a symbol stands for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    Parameter(Name),
    /// The running time.
    Running,
    /// The time of an impact, or a state just before it or just after it.
    Time {
        family: Name,
        index: i32,
    },
    State {
        state: Name,
        index: i32,
        after: bool,
    },
    /// A state at an index that is a number, as in `x_0`, while the index of the statement runs. Recursions are not
    /// followed to it: no witness gives it a value.
    Absolute {
        state: Name,
        index: i32,
    },
    /// The derivative of one quantity by another along a map.
    Partial {
        of: Symbol,
        by: Symbol,
    },
    /// The trace or determinant of a map of which no premise says anything.
    Invariant {
        kind: Invariant,
        of: Name,
    },
    /// A symbol that is defined beside an equation; the number tells such symbols of different equations apart.
    Local {
        name: Name,
        scope: usize,
    },
    /// A symbol that a certificate or a witness brings along.
    Fresh(usize),
}

/// What an unknown function is a function of.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionOf {
    /// A declared function of the real line.
    Line(Name),
    /// A state, without dots, in the flight that follows this impact.
    Flight { state: Name, impact: i32 },
}

/// Over what a given holds, where it is no single statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Law {
    /// The running time, where there is one.
    pub time: Option<Symbol>,
    /// The impact whose flight the running time is in; nothing for a law of the whole real line.
    pub flight: Option<i32>,
    /// Whether it holds with all impacts moved on by any number.
    pub every_impact: bool,
    /// What must hold of an instance for the law to say anything of it.
    pub conditions: Vec<(Property, Term)>,
}

/// Something that is taken as true.
#[derive(Clone, Debug)]
pub struct Given {
    pub origin: Origin,
    pub property: Property,
    pub term: Term,
    pub law: Option<Law>,
}

/// A law at one time, for the impacts moved on, or an axiom of some terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    pub property: Property,
    pub term: Term,
    /// The conditions under which it holds, and that all of it is defined.
    pub conditions: Vec<(Property, Term)>,
}

/// A map whose derivatives a statement speaks of.
#[derive(Clone, Debug, Default)]
pub struct Step {
    /// The name of the map; none where derivatives that are written imply it.
    pub name: String,
    pub of: Vec<Symbol>,
    pub by: Vec<Symbol>,
    /// The terms that vanish along the map and determine it, with where the givens come from that they are of.
    pub equations: Vec<(Origin, Term)>,
    /// What each of `of` is, where the equations of a map say so outright in `by` and symbols that do not move.
    pub images: Vec<Term>,
    /// What must hold for its equations to be defined, besides what their terms show.
    pub conditions: Vec<(Property, Term)>,
    /// Whether its equations are read over the reals alone.
    pub real_only: bool,
}

/// A claim, ready to be decided: wherever all givens hold, the goals hold.
///
/// Outside the kernel it can be read, and extended by terms and symbols, but nothing given and no goal can be changed.
#[derive(Clone, Debug, Default)]
pub struct Statement {
    /// Which statement it is: copies of one are extended apart, but stay the same statement. 0 is none.
    pub(super) identity: u64,
    pub(super) terms: Terms,
    /// Whether the symbols declared complex take part, so that all functions are principal branches.
    pub(super) complex: bool,
    pub(super) givens: Vec<Given>,
    pub(super) goal: Vec<(Property, Term)>,
    /// What symbols stand for, by their number.
    pub(super) quantities: Vec<Quantity>,
    /// What unknown functions are, by their number.
    pub(super) functions: Vec<FunctionOf>,
    /// Symbols that are abbreviations.
    pub(super) definitions: BTreeMap<Symbol, Term>,
    /// The declared derivatives of unknown functions.
    pub(super) derivatives: Derivatives,
    /// Symbols that are declared complex, those declared generic.
    pub(super) complex_symbols: Vec<Symbol>,
    pub(super) generic: Vec<Symbol>,
    pub(super) steps: Vec<Step>,
    /// The explicit maps whose derivatives are those of their right sides.
    pub(super) outright: Vec<Step>,
    /// What else the entry of the claim writes: sides of its other equations, and its own definitions.
    pub(super) beside: Vec<Term>,
    /// The times of impacts by index; states that may be named; the states that an impact does not change.
    pub(super) times: BTreeMap<i32, Symbol>,
    pub(super) states: Vec<Name>,
    pub(super) continuous: Vec<Name>,
    /// The flight that the running time of the claim is in.
    pub(super) flight: Option<i32>,
    /// The letter that numbers impacts.
    pub(super) letter: String,
}

impl Statement {
    /// Its terms.
    pub fn terms(&self) -> &Terms {
        &self.terms
    }

    /// Its terms, to add to.
    pub fn terms_mut(&mut self) -> &mut Terms {
        &mut self.terms
    }

    /// What is given.
    pub fn givens(&self) -> &[Given] {
        &self.givens
    }

    /// What is to be shown.
    pub fn goal(&self) -> &[(Property, Term)] {
        &self.goal
    }

    /// Symbols that are abbreviations.
    pub fn definitions(&self) -> &BTreeMap<Symbol, Term> {
        &self.definitions
    }

    /// The maps whose derivatives are spoken of.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The declared derivatives of unknown functions.
    pub fn derivatives(&self) -> &Derivatives {
        &self.derivatives
    }

    /// What symbols stand for, by their number.
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// What unknown functions are, by their number.
    pub fn functions(&self) -> &[FunctionOf] {
        &self.functions
    }

    /// Symbols that are declared generic.
    pub fn generic(&self) -> &[Symbol] {
        &self.generic
    }

    /// Symbols that are declared complex.
    pub fn complex_symbols(&self) -> &[Symbol] {
        &self.complex_symbols
    }

    /// Whether complex numbers take part.
    pub fn is_complex(&self) -> bool {
        self.complex
    }

    /// The maps whose derivatives the statement speaks of.
    pub fn maps(&self) -> &[Step] {
        &self.steps
    }

    /// The explicit maps whose derivatives are those of their right sides.
    pub fn outright_maps(&self) -> &[Step] {
        &self.outright
    }

    /// What else the entry of the claim writes, and so must have a value.
    pub fn beside(&self) -> &[Term] {
        &self.beside
    }

    /// The times of impacts by index.
    pub fn times(&self) -> &BTreeMap<i32, Symbol> {
        &self.times
    }

    /// The states that may be named at impacts.
    pub fn states(&self) -> &[Name] {
        &self.states
    }

    /// The states that an impact does not change.
    pub fn continuous(&self) -> &[Name] {
        &self.continuous
    }

    /// The flight that the running time of the claim is in.
    pub fn flight(&self) -> Option<i32> {
        self.flight
    }

    /// The statement without what must hold for the claim to be defined, and without the claim.
    pub fn premises(&self) -> Self {
        let mut premises = self.clone();
        premises.givens.retain(|given| given.origin != Origin::ClaimDomain);
        premises.goal.clear();
        premises.identity = 0;
        premises
    }

    /// Takes over the terms that a copy was extended by; `false` where it is no extension of this.
    pub fn adopt(&mut self, copy: &Self) -> bool {
        let extends = copy.extends(self);
        if extends {
            self.terms = copy.terms.clone();
            self.quantities.clone_from(&copy.quantities);
            self.functions.clone_from(&copy.functions);
        }
        extends
    }

    /// Whether its terms, symbols and functions are those of another statement, and perhaps more.
    pub(super) fn extends(&self, other: &Self) -> bool {
        self.terms.extends(&other.terms)
            && self.quantities.starts_with(&other.quantities)
            && self.functions.starts_with(&other.functions)
            && self.terms.symbols() == self.quantities.len()
            && self.terms.functions() == self.functions.len()
    }

    /// A term with unknown functions replaced by terms in a symbol of their own.
    pub fn with_functions(&mut self, term: Term, functions: &[(Function, Symbol, Term)]) -> Term {
        let declared = self.derivatives.clone();
        self.terms.rewrite(term, &mut |terms, node| {
            let Node::Value(function, order, at) = node else {
                return None;
            };
            let (_, time, named) = functions.iter().find(|(f, ..)| f == function)?;
            let mut slope = *named;
            for _ in 0..*order {
                slope = derivative(terms, slope, &declared, &mut |terms, symbol| {
                    terms.integer(i64::from(symbol == *time))
                });
            }
            Some(terms.substitute(slope, *time, *at))
        })
    }

    /// The statement with some of what is given.
    pub fn with_givens(&self, kept: &dyn Fn(&Given) -> bool) -> Self {
        let mut fewer = self.clone();
        fewer.givens.retain(kept);
        fewer.goal.clear();
        fewer.identity = 0;
        fewer
    }

    /// The symbols in a term.
    pub(super) fn symbols_in(&self, term: Term) -> Vec<Symbol> {
        let inside = self.terms.inside(term).into_iter();
        let symbol = |inner| match self.terms.node(inner) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        };
        inside.filter_map(symbol).collect()
    }

    /// The letter that numbers impacts, or the index that runs.
    pub fn letter(&self) -> &str {
        &self.letter
    }

    /// What a symbol stands for.
    pub fn quantity(&self, symbol: Symbol) -> Option<&Quantity> {
        self.quantities.get(symbol.0 as usize)
    }

    /// The symbol of a quantity, new where it is not known yet.
    pub fn symbol_of(&mut self, quantity: Quantity, printed: impl FnOnce() -> String) -> Symbol {
        if let Some(at) = self.quantities.iter().position(|known| *known == quantity) {
            return Symbol(u32::try_from(at).unwrap_or(u32::MAX));
        }
        self.quantities.push(quantity);
        self.terms.new_symbol(printed())
    }

    /// The unknown function, new where it is not known yet.
    pub fn function_of(&mut self, of: FunctionOf) -> Function {
        if let Some(at) = self.functions.iter().position(|known| *known == of) {
            return Function(u32::try_from(at).unwrap_or(u32::MAX));
        }
        let printed = match &of {
            FunctionOf::Line(name) => name.to_string(),
            FunctionOf::Flight { state, .. } => state.to_string(),
        };
        self.functions.push(of);
        self.terms.new_function(printed)
    }

    /// A symbol that stands for nothing in the statement.
    pub fn fresh(&mut self, printed: &str) -> Symbol {
        let number = self.quantities.len();
        self.symbol_of(Quantity::Fresh(number), || printed.to_string())
    }

    /// The term with all abbreviations written out, also those in others; one that stands in itself is left.
    pub fn written_out(&mut self, term: Term) -> Term {
        if self.definitions.is_empty() {
            return term;
        }
        let definitions = std::mem::take(&mut self.definitions);
        let mut written: BTreeMap<Symbol, Term> = BTreeMap::new();
        let mut begun: BTreeSet<Symbol> = BTreeSet::new();
        let mut open: Vec<(Option<Symbol>, Term)> = vec![(None, term)];
        let (mut result, mut has_begun) = (term, false);
        while let Some(&(symbol, meant)) = open.last() {
            if symbol.is_some_and(|symbol| written.contains_key(&symbol)) {
                open.pop();
                continue;
            }
            let is_new = match symbol {
                Some(symbol) => begun.insert(symbol),
                None => !std::mem::replace(&mut has_begun, true),
            };
            if is_new {
                // first those that it needs
                let needed = self.symbols_in(meant).into_iter();
                let needed = needed.filter(|inner| !begun.contains(inner) && !written.contains_key(inner));
                open.extend(needed.filter_map(|inner| Some((Some(inner), *definitions.get(&inner)?))));
                continue;
            }
            open.pop();
            result = self.terms.rewrite(meant, &mut |_, node| match node {
                Node::Symbol(symbol) => written.get(symbol).copied(),
                _ => None,
            });
            if let Some(symbol) = symbol {
                written.insert(symbol, result);
            }
        }
        self.definitions = definitions;
        result
    }

    /// The symbol of a state, printed with its index and mark.
    pub fn state(&mut self, state: &Name, index: i32, after: bool, letter: &str) -> Symbol {
        let after = after && !self.continuous.contains(state);
        let quantity = Quantity::State {
            state: state.clone(),
            index,
            after,
        };
        let mut name = state.clone();
        name.subscript = texmath::subscript_of(index, letter);
        name.mark = if after { "+".into() } else { String::new() };
        self.symbol_of(quantity, || name.to_string())
    }

    /// The symbol of the time of an impact.
    pub fn time(&mut self, family: &Name, index: i32, letter: &str) -> Symbol {
        let quantity = Quantity::Time {
            family: family.clone(),
            index,
        };
        let mut name = family.clone();
        name.subscript = texmath::subscript_of(index, letter);
        let symbol = self.symbol_of(quantity, || name.to_string());
        self.times.entry(index).or_insert(symbol);
        symbol
    }

    /// An instance of a law: its running time replaced by `time` and its impacts moved on by `shift`; nothing where the
    /// law does not extend so far.
    pub fn instance(
        &mut self,
        given: usize,
        time: Option<Term>,
        shift: i32,
        running_in: Option<(Symbol, i32)>,
    ) -> Option<Instance> {
        let Given {
            property, term, law, ..
        } = self.givens.get(given)?.clone();
        let Some(law) = law else {
            let conditions = Vec::new();
            return (time.is_none() && shift == 0).then_some(Instance {
                property,
                term,
                conditions,
            });
        };
        if (shift != 0 && !(law.every_impact && self.may_move(term))) || law.time.is_some() != time.is_some() {
            return None;
        }
        if let (Some(flight), Some(time)) = (law.flight, time) {
            let flight = flight + shift;
            let is = |index: i32, of: &Self| match (of.times.get(&index), of.terms.node(time)) {
                (Some(known), Node::Symbol(symbol)) => known == symbol,
                _ => false,
            };
            let running = match self.terms.node(time) {
                Node::Symbol(symbol) => {
                    running_in == Some((*symbol, flight))
                        || (self.quantity(*symbol) == Some(&Quantity::Running) && self.flight == Some(flight))
                }
                _ => false,
            };
            if !running && !is(flight, self) && !is(flight + 1, self) {
                return None;
            }
        }
        let mut moved = |of: Term| {
            let of = self.written_out(of);
            self.moved(of, law.time.zip(time), shift)
        };
        let term = moved(term);
        let conditions = law.conditions.iter().map(|(property, of)| (*property, moved(*of)));
        let mut conditions: Vec<(Property, Term)> = conditions.collect();
        for of in conditions.iter().map(|(_, of)| *of).chain([term]).collect::<Vec<_>>() {
            conditions.extend(self.domain(of));
        }
        Some(Instance {
            property,
            term,
            conditions,
        })
    }

    /// Whether a term means something at other impacts: the trace of a map is that of one map.
    pub(super) fn may_move(&mut self, term: Term) -> bool {
        let term = self.written_out(term);
        let fixed = |inner: Term| match self.terms.node(inner) {
            Node::Symbol(symbol) => matches!(self.quantity(*symbol), Some(Quantity::Invariant { .. })),
            _ => false,
        };
        !self.terms.inside(term).into_iter().any(fixed)
    }

    /// The term with its running time replaced and its impacts moved on.
    pub fn moved(&mut self, term: Term, time: Option<(Symbol, Term)>, shift: i32) -> Term {
        let mut terms = std::mem::take(&mut self.terms);
        let result = terms.rewrite(term, &mut |terms, node| match node {
            Node::Symbol(symbol) if time.is_some_and(|(running, _)| running == *symbol) => time.map(|(_, by)| by),
            Node::Symbol(symbol) if shift != 0 => {
                let quantity = match self.quantities.get(symbol.0 as usize)? {
                    Quantity::Time { family, index } => Quantity::Time {
                        family: family.clone(),
                        index: index + shift,
                    },
                    Quantity::State { state, index, after } => Quantity::State {
                        state: state.clone(),
                        index: index + shift,
                        after: *after,
                    },
                    Quantity::Partial { of, by } => {
                        let pair = [*of, *by];
                        std::mem::swap(&mut self.terms, terms);
                        let [of, by] = pair.map(|symbol| {
                            let term = self.terms.symbol(symbol);
                            match self.moved(term, None, shift) {
                                moved if moved == term => symbol,
                                moved => match self.terms.node(moved) {
                                    Node::Symbol(moved) => *moved,
                                    _ => symbol,
                                },
                            }
                        });
                        let partial = self.partial(of, by);
                        std::mem::swap(&mut self.terms, terms);
                        return Some(terms.symbol(partial));
                    }
                    // the index itself
                    Quantity::Parameter(name) if is_letter(name, &self.letter) => {
                        let (number, by) = (terms.symbol(*symbol), terms.integer(i64::from(shift)));
                        return Some(terms.sum(vec![number, by]));
                    }
                    _ => return None,
                };
                std::mem::swap(&mut self.terms, terms);
                let symbol = self.of_quantity(quantity);
                std::mem::swap(&mut self.terms, terms);
                Some(terms.symbol(symbol))
            }
            Node::Value(function, order, at) => {
                let FunctionOf::Flight { state, impact } = self.functions.get(function.0 as usize)?.clone() else {
                    return None;
                };
                std::mem::swap(&mut self.terms, terms);
                let moved = self.in_flight(&state, impact + shift, *order, *at);
                std::mem::swap(&mut self.terms, terms);
                Some(moved)
            }
            _ => None,
        });
        self.terms = terms;
        result
    }

    fn of_quantity(&mut self, quantity: Quantity) -> Symbol {
        // the letter is that of any index that is known
        let letter = self.letter.clone();
        match quantity {
            Quantity::Time { family, index } => self.time(&family, index, &letter),
            Quantity::State { state, index, after } => self.state(&state, index, after, &letter),
            other => self.symbol_of(other, String::new),
        }
    }

    /// The value of a state of this order in a flight: at the impacts that end it, the state there.
    pub fn in_flight(&mut self, state: &Name, impact: i32, order: u32, at: Term) -> Term {
        let named = (0..order).fold(state.clone(), |name, _| name.dotted());
        if let Node::Symbol(symbol) = self.terms.node(at)
            && self.states.contains(&named)
        {
            let symbol = *symbol;
            let letter = self.letter.clone();
            for (index, after) in [(impact, true), (impact + 1, false)] {
                if self.times.get(&index) == Some(&symbol) {
                    let symbol = self.state(&named, index, after, &letter);
                    return self.terms.symbol(symbol);
                }
            }
        }
        let function = self.function_of(FunctionOf::Flight {
            state: state.clone(),
            impact,
        });
        self.terms.add(Node::Value(function, order, at))
    }

    /// The state that a motion's derivative of an order is at the beginning of its flight, or at the end of it, with the
    /// time of it; nothing where it has no name.
    pub fn end_of(&self, function: Function, order: u32, begins: bool) -> Option<(Symbol, Symbol)> {
        let FunctionOf::Flight { state, impact } = self.functions.get(function.0 as usize)? else {
            return None;
        };
        let named = (0..order).fold(state.clone(), |name, _| name.dotted());
        if !self.states.contains(&named) {
            return None;
        }
        let index = if begins { *impact } else { impact + 1 };
        let quantity = Quantity::State {
            after: begins && !self.continuous.contains(&named),
            state: named,
            index,
        };
        let place = self.quantities.iter().position(|known| *known == quantity)?;
        Some((Symbol(u32::try_from(place).ok()?), *self.times.get(&index)?))
    }

    /// What must hold for a term to have a value: no divisor is 0, roots and logarithms are of what they are defined for.
    pub fn domain(&mut self, term: Term) -> Vec<(Property, Term)> {
        let mut conditions = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        let mut open = vec![term];
        while let Some(term) = open.pop() {
            for inner in self.terms.inside(term) {
                if !seen.insert(inner) {
                    continue;
                }
                if let Node::Symbol(symbol) = self.terms.node(inner) {
                    open.extend(self.definitions.get(symbol));
                    continue;
                }
                for condition in domain_of(&mut self.terms, inner, self.complex) {
                    if !conditions.contains(&condition) {
                        conditions.push(condition);
                    }
                }
            }
        }
        conditions
    }

    /// What must hold besides these conditions, for what holds at a point under them to hold near it too, as symbols move:
    /// no root or inverse function is at the end of its domain there, no power has the base 0. `None` where a condition
    /// holds at single points only, as an equation does.
    ///
    /// The conditions must include the domains of the terms.
    pub fn holding_near(
        &self,
        conditions: &[(Property, Term)],
        terms: &[Term],
        moves: &dyn Fn(&Self, Symbol) -> bool,
    ) -> Option<Vec<(Property, Term)>> {
        let is_moving = |term: Term| self.symbols_in(term).into_iter().any(|symbol| moves(self, symbol));
        let mut near = Vec::new();
        for &(property, of) in conditions.iter().filter(|(_, of)| is_moving(*of)) {
            match property {
                Property::Positive | Property::Nonzero => {}
                Property::NonNegative => near.push((Property::Nonzero, of)),
                Property::Zero | Property::Integer => return None,
            }
        }
        for inner in terms.iter().flat_map(|&term| self.terms.inside(term)) {
            match self.terms.node(inner) {
                Node::RealPower(base, exponent) if is_moving(*exponent) => near.push((Property::Positive, *base)),
                Node::RealPower(base, _) if is_moving(*base) => near.push((Property::Nonzero, *base)),
                _ => {}
            }
        }
        Some(near)
    }

    /// Whether a symbol changes along a map.
    pub fn moves_along(&self, symbol: Symbol) -> bool {
        matches!(
            self.quantity(symbol),
            Some(Quantity::Time { .. } | Quantity::State { .. })
        )
    }

    /// The derivative of a term by a symbol, all else held fixed; abbreviations are differentiated.
    pub fn derivative(&mut self, term: Term, by: Symbol) -> Term {
        let term = self.written_out(term);
        derivative(&mut self.terms, term, &self.derivatives, &mut |terms, symbol| {
            terms.integer(i64::from(symbol == by))
        })
    }

    /// The derivative of a term along a map by one of the quantities that the map starts from.
    pub fn along(&mut self, term: Term, step: &Step, by: Symbol) -> Term {
        let term = self.written_out(term);
        let mut terms = std::mem::take(&mut self.terms);
        let declared = self.derivatives.clone();
        let result = derivative(&mut terms, term, &declared, &mut |terms, symbol| {
            if symbol == by {
                return terms.integer(1);
            }
            if !self.moves_along(symbol) || step.by.contains(&symbol) {
                return terms.integer(0);
            }
            std::mem::swap(&mut self.terms, terms);
            let partial = self.partial(symbol, by);
            std::mem::swap(&mut self.terms, terms);
            terms.symbol(partial)
        });
        self.terms = terms;
        result
    }

    /// The symbol of a derivative along a map.
    pub fn partial(&mut self, of: Symbol, by: Symbol) -> Symbol {
        let printed = format!(
            "\\frac{{\\partial {}}}{{\\partial {}}}",
            self.terms.symbol_name(of),
            self.terms.symbol_name(by)
        );
        self.symbol_of(Quantity::Partial { of, by }, || printed)
    }

    /// The value of an unknown function, under the name that is declared for its derivative.
    pub fn value(&mut self, function: Function, order: u32, at: Term) -> Term {
        value(&mut self.terms, &self.derivatives, function, order, at)
    }

    /// Whether a symbol may be complex: declared so, a state whose symbols at other impacts are, or not known.
    fn is_complex_symbol(&self, symbol: Symbol) -> bool {
        match self.quantity(symbol) {
            None | Some(Quantity::Fresh(_) | Quantity::Partial { .. }) => true,
            Some(Quantity::State { state, .. }) => self.is_complex_state(state),
            Some(_) => self.complex_symbols.contains(&symbol),
        }
    }

    fn is_complex_state(&self, state: &Name) -> bool {
        self.complex_symbols.iter().any(|symbol| match self.quantity(*symbol) {
            Some(Quantity::State { state: complex, .. }) => complex.without_dots() == state.without_dots(),
            _ => false,
        })
    }

    /// Whether a term may be differentiated by what moves: over complex numbers, roots, logarithms, real powers and
    /// inverse functions jump where the principal branch does.
    pub fn is_differentiable(&self, term: Term, moves: &dyn Fn(Symbol) -> bool) -> bool {
        let jumps = |inner: &Term| {
            let branches = match self.terms.node(*inner) {
                Node::RealPower(..) => true,
                Node::Elementary(function, _) => {
                    !matches!(function, Elementary::Sin | Elementary::Cos | Elementary::Exp)
                }
                _ => false,
            };
            branches
                && self
                    .terms
                    .inside(*inner)
                    .iter()
                    .any(|part| match self.terms.node(*part) {
                        Node::Symbol(symbol) => moves(*symbol),
                        _ => false,
                    })
        };
        !self.complex || !self.terms.inside(term).iter().any(jumps)
    }

    /// Whether an equation of a map may be differentiated along it: a flight changes with what the map starts from, and so
    /// do derivatives along maps.
    pub(super) fn is_smooth_along(&self, term: Term) -> bool {
        let flies = |inner: &Term| match self.terms.node(*inner) {
            Node::Value(function, ..) => !matches!(self.functions.get(function.0 as usize), Some(FunctionOf::Line(_))),
            Node::Symbol(symbol) => matches!(
                self.quantity(*symbol),
                Some(Quantity::Partial { .. } | Quantity::Invariant { .. })
            ),
            _ => false,
        };
        !self.terms.inside(term).iter().any(flies) && self.is_differentiable(term, &|_| true)
    }

    /// The sign of a polynomial without symbols, by an enclosure. Over complex numbers, an odd root of a negative
    /// number is not the real one.
    pub fn sign_of(&self, polynomial: &super::polynomial::Polynomial) -> Option<i8> {
        let sign = super::enclosure::sign(&self.terms, polynomial)?;
        let principal = |inner: Term| match self.terms.node(inner) {
            Node::Elementary(Elementary::Root(index), of) if index % 2 == 1 => {
                let radicand = super::polynomial::Polynomial::generator(*of);
                super::enclosure::sign(&self.terms, &radicand) == Some(1)
            }
            _ => true,
        };
        let mut inside = polynomial
            .generators()
            .into_iter()
            .flat_map(|term| self.terms.inside(term));
        (!self.complex || inside.all(principal)).then_some(sign)
    }

    /// Whether the value of a term is real for certain, over complex numbers.
    pub fn is_real(&self, term: Term) -> bool {
        !self.complex
            || self
                .terms
                .inside(term)
                .into_iter()
                .all(|inner| match self.terms.node(inner) {
                    Node::Symbol(symbol) => {
                        !self.is_complex_symbol(*symbol)
                            && self
                                .definitions
                                .get(symbol)
                                .is_none_or(|&meaning| self.is_real(meaning))
                    }
                    Node::Value(function, ..) => match self.functions.get(function.0 as usize) {
                        Some(FunctionOf::Flight { state, .. }) => !self.is_complex_state(state),
                        Some(FunctionOf::Line(_)) => true,
                        None => false,
                    },
                    Node::Imaginary | Node::RealPower(..) => false,
                    Node::Elementary(function, _) => {
                        matches!(
                            function,
                            Elementary::Sin | Elementary::Cos | Elementary::Exp | Elementary::Arctan
                        )
                    }
                    _ => true,
                })
    }
}

/// What the outermost step of a term needs to have a value.
fn domain_of(terms: &mut Terms, term: Term, complex: bool) -> Vec<(Property, Term)> {
    match terms.node(term).clone() {
        Node::Quotient(_, below) => vec![(Property::Nonzero, below)],
        Node::Elementary(Elementary::Root(index), of) if !complex && index % 2 == 0 => {
            vec![(Property::NonNegative, of)]
        }
        Node::Elementary(Elementary::Ln, of) if complex => vec![(Property::Nonzero, of)],
        Node::Elementary(Elementary::Ln, of) => vec![(Property::Positive, of)],
        Node::Elementary(Elementary::Arcsin | Elementary::Arccos, of) if !complex => {
            let one = terms.integer(1);
            let (above, below) = (terms.difference(one, of), terms.sum(vec![one, of]));
            vec![(Property::NonNegative, above), (Property::NonNegative, below)]
        }
        _ => Vec::new(),
    }
}

/// Whether a name is this letter, without marks.
pub fn is_letter(name: &Name, letter: &str) -> bool {
    *name
        == Name {
            base: letter.to_string(),
            ..Name::default()
        }
}
