//! The statement of a claim: what is given, and what is to be shown, as terms.

use super::expand::{Derivatives, derivative, value};
use super::term::{Elementary, Function, Node, Symbol, Term, Terms};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The source of a given.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// A premise or an equation of the symbol table, with its label.
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
    /// The condition that derivatives of these implicit quantities exist, which a proof takes for granted.
    DerivativesExist(String),
    /// A condition on what is implicit or on a function of an interval that a witness brings along.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// A number that is the same at every time and every index.
    Parameter,
    /// The index of sequences itself.
    Index,
    /// The running time.
    Running,
    /// The member of a sequence, by its number, at the index plus `offset`.
    Member { sequence: usize, offset: i32 },
    /// A member of a sequence at an index that is a number, as in `x_0`, while the index of the statement runs. Recursions
    /// are not followed to it: no witness gives it a value.
    Numbered,
    /// The derivative of an implicit quantity by one that it depends on.
    Partial { of: Symbol, by: Symbol },
    /// A number that belongs to one index, of which nothing is said at others.
    Fixed,
    /// A symbol that is defined: for all of the statement, or beside one equation only.
    Abbreviation { is_local: bool },
    /// A symbol that a certificate or a witness brings along.
    Fresh,
}

/// What an unknown function is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionOf {
    /// The real line.
    Line,
    /// The interval from the instant at the index plus `offset` to the next, of the piecewise function with this number.
    Interval { piecewise: usize, offset: i32 },
}

/// A sequence of real or complex numbers, or of instants, over all integers from some start.
#[derive(Clone, Debug, Default)]
pub struct Sequence {
    /// The text of its member at the index, and those before and after the offset of other members.
    pub text: [String; 3],
    /// True for instants: an interval of time lies between each and the next.
    pub has_instants: bool,
    /// True if its members may be complex.
    pub is_complex: bool,
}

/// A function of time that is another one on each interval between two instants.
#[derive(Clone, Debug, Default)]
pub struct Piecewise {
    pub text: String,
    /// The sequences of its values, and of those of its derivatives in order, at the beginnings and at the ends of intervals.
    /// Where both are one sequence, it is continuous.
    pub ends: Vec<Option<[usize; 2]>>,
}

/// Over what a given holds, where it is no single statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Law {
    /// The running time, where there is one.
    pub time: Option<Symbol>,
    /// The offset of the interval that the running time is in; none for a law of the whole real line.
    pub interval: Option<i32>,
    /// True if it holds with the index moved on by any number.
    pub every_index: bool,
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

/// A law at one time, with the index moved on, or an axiom of some terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    pub property: Property,
    pub term: Term,
    /// The conditions under which it holds, and that all of it is defined.
    pub conditions: Vec<(Property, Term)>,
}

/// Quantities that are given implicitly, as functions of others near a point, by terms that vanish.
#[derive(Clone, Debug, Default)]
pub struct Implicit {
    pub of: Vec<Symbol>,
    pub by: Vec<Symbol>,
    /// The terms that vanish and determine them, with where the givens come from that they are of.
    pub equations: Vec<(Origin, Term)>,
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
    /// The quantities whose derivatives by others the statement speaks of.
    pub(super) implicit: Vec<Implicit>,
    /// What else the entry of the claim writes: sides of its other equations, and its own definitions.
    pub(super) beside: Vec<Term>,
    /// The instants by offset: the first sequence with a member there.
    pub(super) instants: BTreeMap<i32, Symbol>,
    pub(super) sequences: Vec<Sequence>,
    pub(super) piecewise: Vec<Piecewise>,
    /// The offset of the interval that the running time of the claim is in.
    pub(super) interval: Option<i32>,
    /// The texts around and between the two symbols of a derivative.
    pub(super) derivative_text: [String; 3],
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

    /// The quantities that are given implicitly and whose derivatives the statement speaks of.
    pub fn implicit(&self) -> &[Implicit] {
        &self.implicit
    }

    /// What else the entry of the claim writes, and so must have a value.
    pub fn beside(&self) -> &[Term] {
        &self.beside
    }

    /// The instants by offset.
    pub fn instants(&self) -> &BTreeMap<i32, Symbol> {
        &self.instants
    }

    /// The functions that are others on each interval.
    pub fn piecewise(&self) -> &[Piecewise] {
        &self.piecewise
    }

    /// The offset of the interval that the running time of the claim is in.
    pub fn interval(&self) -> Option<i32> {
        self.interval
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
        let declared = &self.derivatives;
        self.terms.rewrite(term, &mut |terms, node| match node {
            Node::Value(function, order, at) => named_value(terms, declared, functions, (*function, *order, *at)),
            _ => None,
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

    /// What a symbol stands for.
    pub fn quantity(&self, symbol: Symbol) -> Option<Quantity> {
        self.quantities.get(symbol.0 as usize).copied()
    }

    /// The symbol that is the only one of its quantity: the index, the running time, a member, a derivative.
    pub(super) fn known(&self, quantity: Quantity) -> Option<Symbol> {
        let place = self.quantities.iter().position(|known| *known == quantity)?;
        u32::try_from(place).ok().map(Symbol)
    }

    /// A symbol with a text. There is one of the index and one of the running time.
    pub fn symbol_of(&mut self, quantity: Quantity, text: impl Into<String>) -> Symbol {
        let is_single = !matches!(
            quantity,
            Quantity::Parameter
                | Quantity::Numbered
                | Quantity::Fixed
                | Quantity::Abbreviation { .. }
                | Quantity::Fresh
        );
        if let Some(known) = self.known(quantity).filter(|_| is_single) {
            return known;
        }
        self.quantities.push(quantity);
        self.terms.new_symbol(text)
    }

    /// The running time, where it is met.
    pub fn running(&self) -> Option<Symbol> {
        self.known(Quantity::Running)
    }

    /// A new unknown function of the real line.
    pub fn new_function(&mut self, text: impl Into<String>) -> Function {
        self.functions.push(FunctionOf::Line);
        self.terms.new_function(text)
    }

    /// A symbol that stands for nothing in the statement.
    pub fn fresh(&mut self, text: &str) -> Symbol {
        self.symbol_of(Quantity::Fresh, text)
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

    /// The symbol of a member of a sequence.
    pub fn member(&mut self, sequence: usize, offset: i32) -> Symbol {
        let own = self.sequences.get(sequence);
        let text = own.map_or(String::new(), |own| match (offset, &own.text) {
            (0, [at, ..]) => at.clone(),
            (_, [_, before, after]) => format!("{before}{offset:+}{after}"),
        });
        let has_instants = own.is_some_and(|own| own.has_instants);
        let symbol = self.symbol_of(Quantity::Member { sequence, offset }, text);
        if has_instants {
            self.instants.entry(offset).or_insert(symbol);
        }
        symbol
    }

    /// The sequence of instants and the offset that a symbol is of.
    pub fn instant_of(&self, symbol: Symbol) -> Option<(usize, i32)> {
        self.member_of(symbol)
            .filter(|(sequence, _)| self.has_instants(*sequence))
    }

    /// The sequence of numbers and the offset that a symbol is of.
    pub fn number_of(&self, symbol: Symbol) -> Option<(usize, i32)> {
        self.member_of(symbol)
            .filter(|(sequence, _)| !self.has_instants(*sequence))
    }

    fn member_of(&self, symbol: Symbol) -> Option<(usize, i32)> {
        match self.quantity(symbol)? {
            Quantity::Member { sequence, offset } => Some((sequence, offset)),
            _ => None,
        }
    }

    fn has_instants(&self, sequence: usize) -> bool {
        self.sequences.get(sequence).is_some_and(|own| own.has_instants)
    }

    /// The instant at an offset, new of the sequence of instants that was met first; none where none was met.
    pub fn instant(&mut self, offset: i32) -> Option<Symbol> {
        let met = self.quantities.iter().filter_map(|quantity| match quantity {
            Quantity::Member { sequence, .. } if self.has_instants(*sequence) => Some(*sequence),
            _ => None,
        });
        let first = met.into_iter().next();
        let known = self.instants.get(&offset).copied();
        known.or_else(|| Some(self.member(first?, offset)))
    }

    /// An instance of a law: its running time replaced by `time` and its index moved on by `shift`; nothing where the law
    /// does not extend so far.
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
        if (shift != 0 && !(law.every_index && self.may_move(term))) || law.time.is_some() != time.is_some() {
            return None;
        }
        if let (Some(interval), Some(time)) = (law.interval, time)
            && !self.is_within(time, interval + shift, running_in)
        {
            return None;
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

    /// Returns true for a time of an interval: one of its ends, or a symbol that runs over it.
    pub(super) fn is_within(&self, time: Term, interval: i32, running_in: Option<(Symbol, i32)>) -> bool {
        let Node::Symbol(symbol) = *self.terms.node(time) else {
            return false;
        };
        let is_end = |offset: i32| self.instants.get(&offset) == Some(&symbol);
        let runs = self.interval == Some(interval) && self.quantity(symbol) == Some(Quantity::Running);
        is_end(interval) || is_end(interval + 1) || runs || running_in == Some((symbol, interval))
    }

    /// Returns true if a term means something at another index.
    pub(super) fn may_move(&mut self, term: Term) -> bool {
        let term = self.written_out(term);
        let mut symbols = self.symbols_in(term).into_iter();
        symbols.all(|symbol| self.quantity(symbol) != Some(Quantity::Fixed))
    }

    /// The term with its running time replaced and its index moved on.
    pub fn moved(&mut self, term: Term, time: Option<(Symbol, Term)>, shift: i32) -> Term {
        let mut terms = std::mem::take(&mut self.terms);
        let result = terms.rewrite(term, &mut |terms, node| match node {
            Node::Symbol(symbol) if time.is_some_and(|(running, _)| running == *symbol) => time.map(|(_, by)| by),
            Node::Symbol(symbol) if shift != 0 && self.quantity(*symbol) == Some(Quantity::Index) => {
                let (number, by) = (terms.symbol(*symbol), terms.integer(i64::from(shift)));
                Some(terms.sum(vec![number, by]))
            }
            Node::Symbol(symbol) if shift != 0 => {
                std::mem::swap(&mut self.terms, terms);
                let moved = self.moved_symbol(*symbol, shift);
                std::mem::swap(&mut self.terms, terms);
                (moved != *symbol).then(|| terms.symbol(moved))
            }
            Node::Value(function, order, at) => {
                let FunctionOf::Interval { piecewise, offset } = *self.functions.get(function.0 as usize)? else {
                    return None;
                };
                std::mem::swap(&mut self.terms, terms);
                let moved = self.value_within(piecewise, offset + shift, *order, *at);
                std::mem::swap(&mut self.terms, terms);
                Some(moved)
            }
            _ => None,
        });
        self.terms = terms;
        result
    }

    /// The symbol at another index: members of sequences move on, and derivatives of such.
    fn moved_symbol(&mut self, symbol: Symbol, shift: i32) -> Symbol {
        match self.quantity(symbol) {
            Some(Quantity::Member { sequence, offset }) => self.member(sequence, offset + shift),
            Some(Quantity::Partial { of, by }) => {
                let [of, by] = [of, by].map(|symbol| self.moved_symbol(symbol, shift));
                self.partial(of, by)
            }
            _ => symbol,
        }
    }

    /// The value of a derivative of a piecewise function in an interval: at its ends, the member of the sequence there.
    pub fn value_within(&mut self, piecewise: usize, interval: i32, order: u32, at: Term) -> Term {
        if let Node::Symbol(symbol) = *self.terms.node(at) {
            for begins in [true, false] {
                let offset = if begins { interval } else { interval + 1 };
                if self.instants.get(&offset) == Some(&symbol)
                    && let Some(sequence) = self.sequence_at(piecewise, order, begins)
                {
                    let member = self.member(sequence, offset);
                    return self.terms.symbol(member);
                }
            }
        }
        let function = self.on_interval(piecewise, interval);
        self.terms.add(Node::Value(function, order, at))
    }

    /// The function that a piecewise one is on an interval, new where it is not known yet.
    fn on_interval(&mut self, piecewise: usize, offset: i32) -> Function {
        let of = FunctionOf::Interval { piecewise, offset };
        if let Some(at) = self.functions.iter().position(|known| *known == of) {
            return Function(u32::try_from(at).unwrap_or(u32::MAX));
        }
        let text = self
            .piecewise
            .get(piecewise)
            .map_or(String::new(), |own| own.text.clone());
        self.functions.push(of);
        self.terms.new_function(text)
    }

    /// The sequence of the values of a derivative at the beginnings of intervals, or at their ends.
    fn sequence_at(&self, piecewise: usize, order: u32, begins: bool) -> Option<usize> {
        let ends = self.piecewise.get(piecewise)?.ends.get(order as usize).copied()??;
        Some(ends[usize::from(!begins)])
    }

    /// The member of a sequence that a derivative of a function is at the beginning of its interval, or at the end of it,
    /// with the time of it; nothing where there is none.
    pub fn end_of(&self, function: Function, order: u32, begins: bool) -> Option<(Symbol, Symbol)> {
        let FunctionOf::Interval { piecewise, offset } = *self.functions.get(function.0 as usize)? else {
            return None;
        };
        let sequence = self.sequence_at(piecewise, order, begins)?;
        let offset = if begins { offset } else { offset + 1 };
        let member = self.known(Quantity::Member { sequence, offset })?;
        Some((member, *self.instants.get(&offset)?))
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

    /// Returns true for a symbol that changes with what implicit quantities depend on.
    pub fn depends(&self, symbol: Symbol) -> bool {
        matches!(self.quantity(symbol), Some(Quantity::Member { .. }))
    }

    /// The derivative of a term by a symbol, all else held fixed; abbreviations are differentiated.
    pub fn derivative(&mut self, term: Term, by: Symbol) -> Term {
        let term = self.written_out(term);
        derivative(&mut self.terms, term, &self.derivatives, &mut |terms, symbol| {
            terms.integer(i64::from(symbol == by))
        })
    }

    /// The total derivative of a term by one of the quantities that implicit ones depend on.
    pub fn along(&mut self, term: Term, implicit: &Implicit, by: Symbol) -> Term {
        let term = self.written_out(term);
        let mut terms = std::mem::take(&mut self.terms);
        let declared = self.derivatives.clone();
        let result = derivative(&mut terms, term, &declared, &mut |terms, symbol| {
            if symbol == by {
                return terms.integer(1);
            }
            if !self.depends(symbol) || implicit.by.contains(&symbol) {
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

    /// The symbol of the derivative of an implicit quantity by another.
    pub fn partial(&mut self, of: Symbol, by: Symbol) -> Symbol {
        let [before, between, after] = &self.derivative_text;
        let [above, below] = [of, by].map(|symbol| self.terms.symbol_name(symbol));
        let text = format!("{before}{above}{between}{below}{after}");
        self.symbol_of(Quantity::Partial { of, by }, text)
    }

    /// The value of an unknown function, under the name that is declared for its derivative.
    pub fn value(&mut self, function: Function, order: u32, at: Term) -> Term {
        value(&mut self.terms, &self.derivatives, function, order, at)
    }

    /// Returns true if a symbol may be complex: declared so, a member of such a sequence, or not known.
    fn is_complex_symbol(&self, symbol: Symbol) -> bool {
        match self.quantity(symbol) {
            None | Some(Quantity::Fresh | Quantity::Partial { .. }) => true,
            Some(Quantity::Member { sequence, .. }) => self.is_complex_sequence(sequence),
            Some(_) => self.complex_symbols.contains(&symbol),
        }
    }

    fn is_complex_sequence(&self, sequence: usize) -> bool {
        self.sequences.get(sequence).is_none_or(|own| own.is_complex)
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

    /// Returns true if an equation of implicit quantities may be differentiated along them: functions of intervals change with
    /// what these depend on, and so do derivatives.
    pub(super) fn is_smooth_along(&self, term: Term) -> bool {
        let changes = |inner: &Term| match self.terms.node(*inner) {
            Node::Value(function, ..) => self.functions.get(function.0 as usize) != Some(&FunctionOf::Line),
            Node::Symbol(symbol) => matches!(self.quantity(*symbol), Some(Quantity::Partial { .. } | Quantity::Fixed)),
            _ => false,
        };
        !self.terms.inside(term).iter().any(changes) && self.is_differentiable(term, &|_| true)
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

    /// Returns true if a function has real values: one of an interval does if all its values at ends are real.
    fn is_real_function(&self, function: Function) -> bool {
        match self.functions.get(function.0 as usize) {
            Some(FunctionOf::Line) => true,
            Some(FunctionOf::Interval { piecewise, .. }) => self.piecewise.get(*piecewise).is_some_and(|own| {
                let mut ends = own.ends.iter().flatten().flatten();
                !own.ends.is_empty() && ends.all(|sequence| !self.is_complex_sequence(*sequence))
            }),
            None => false,
        }
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
                    Node::Value(function, ..) => self.is_real_function(*function),
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

/// The value of a derivative of an unknown function that is a term in a symbol of its own, if it is one of these.
pub(super) fn named_value(
    terms: &mut Terms,
    declared: &Derivatives,
    functions: &[(Function, Symbol, Term)],
    (function, order, at): (Function, u32, Term),
) -> Option<Term> {
    let (_, time, named) = functions.iter().find(|(known, ..)| *known == function)?;
    let mut slope = *named;
    for _ in 0..order {
        slope = derivative(terms, slope, declared, &mut |terms, symbol| {
            terms.integer(i64::from(symbol == *time))
        });
    }
    Some(terms.substitute(slope, *time, at))
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
