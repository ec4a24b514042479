//! Terms: what the kernel makes of the trees of a claim and its premises. Equal terms are one term.

use numbers::Rational;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

/// A term of a [`Terms`]; its number is its place in there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Term(pub u32);

/// A quick hash: no result depends on it, and what collides only costs time.
#[derive(Default)]
pub struct Mixed(u64);

/// A map from terms.
pub type TermMap<V> = HashMap<Term, V, BuildHasherDefault<Mixed>>;

/// A free symbol of a [`Terms`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// An unknown function of a [`Terms`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Function(pub u32);

/// The elementary functions that are terms of their own; all others are made of these where a statement is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Elementary {
    Sin,
    Cos,
    Exp,
    /// The natural logarithm.
    Ln,
    /// The root of this index, at least 2: of an even index not negative, of an odd one with the sign of its radicand;
    /// over complex numbers the principal one.
    Root(u32),
    Arcsin,
    Arccos,
    Arctan,
}

/// A term, one step deep.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    Number(Rational),
    /// The circle constant.
    Pi,
    /// The imaginary unit.
    Imaginary,
    Symbol(Symbol),
    Sum(Vec<Term>),
    Product(Vec<Term>),
    /// An integer power; `x^0` is 1.
    Power(Term, i32),
    Quotient(Term, Term),
    Elementary(Elementary, Term),
    /// A power whose exponent is neither an integer nor a rational number.
    RealPower(Term, Term),
    /// The derivative of this order of an unknown function, at a term.
    Value(Function, u32, Term),
    /// The letter that an integral binds.
    Bound,
    /// A number: the integral of a term in the bound letter alone, from one closed term to another. It is shown to have a value
    /// when it is added. What is inside is no part of what it stands in.
    Integral {
        of: Term,
        low: Term,
        high: Term,
    },
}

/// All terms of one statement: each is kept once, so that equal terms have equal numbers.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    nodes: Vec<Node>,
    numbers: HashMap<Node, Term, BuildHasherDefault<Mixed>>,
    /// Whether a symbol or a value of an unknown function is inside, by the number of the term.
    open: Vec<bool>,
    /// Bounds of each integral.
    integrals: TermMap<[Rational; 2]>,
    /// How each symbol is printed, by its number.
    symbols: Vec<String>,
    /// How each unknown function is printed, by its number.
    functions: Vec<String>,
}

impl Terms {
    /// The term with this node. What is inside a term is there before it: a node that holds a term still to come is
    /// taken for pi, as that term is.
    pub fn add(&mut self, node: Node) -> Term {
        if parts_of(&node).any(|part| part.0 as usize >= self.nodes.len()) {
            return self.add(Node::Pi);
        }
        if let Some(&known) = self.numbers.get(&node) {
            return known;
        }
        // an integral is added with its bounds
        match node {
            Node::Integral { .. } => self.add(Node::Pi),
            node => self.push(node),
        }
    }

    fn push(&mut self, node: Node) -> Term {
        let term = Term(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        let open = matches!(node, Node::Symbol(_) | Node::Value(..) | Node::Bound)
            || parts_of(&node).any(|part| self.open.get(part.0 as usize).is_none_or(|&open| open));
        self.open.push(open);
        self.numbers.insert(node.clone(), term);
        self.nodes.push(node);
        term
    }

    /// Adds an integral with its bounds, which are shown.
    pub(super) fn add_integral(&mut self, [of, low, high]: [Term; 3], bounds: [Rational; 2]) -> Term {
        let node = Node::Integral { of, low, high };
        let term = match self.numbers.get(&node) {
            Some(&known) => known,
            None => self.push(node),
        };
        self.integrals.insert(term, bounds);
        term
    }

    /// Bounds of an integral.
    pub fn bounds(&self, integral: Term) -> Option<&[Rational; 2]> {
        self.integrals.get(&integral)
    }

    /// The node of a term of this store.
    pub fn node(&self, term: Term) -> &Node {
        // a term of another store has no meaning here: the kernel takes certificates with the store they were made in
        self.nodes.get(term.0 as usize).unwrap_or(&Node::Pi)
    }

    /// How many terms there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no term yet.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether these are all terms, symbols and functions of another store, and perhaps more.
    pub fn extends(&self, other: &Self) -> bool {
        self.nodes.starts_with(&other.nodes)
            && self.symbols.starts_with(&other.symbols)
            && self.functions.starts_with(&other.functions)
    }

    /// A new symbol, printed like this.
    pub(super) fn new_symbol(&mut self, printed: impl Into<String>) -> Symbol {
        self.symbols.push(printed.into());
        Symbol(u32::try_from(self.symbols.len() - 1).unwrap_or(u32::MAX))
    }

    /// A new unknown function, printed like this.
    pub(super) fn new_function(&mut self, printed: impl Into<String>) -> Function {
        self.functions.push(printed.into());
        Function(u32::try_from(self.functions.len() - 1).unwrap_or(u32::MAX))
    }

    /// How a symbol is printed.
    pub fn symbol_name(&self, symbol: Symbol) -> &str {
        self.symbols.get(symbol.0 as usize).map_or("?", String::as_str)
    }

    /// How a function is printed.
    pub fn function_name(&self, function: Function) -> &str {
        self.functions.get(function.0 as usize).map_or("?", String::as_str)
    }

    /// How many symbols there are.
    pub fn symbols(&self) -> usize {
        self.symbols.len()
    }

    /// How many unknown functions there are.
    pub fn functions(&self) -> usize {
        self.functions.len()
    }

    /// A number.
    pub fn number(&mut self, value: Rational) -> Term {
        self.add(Node::Number(value))
    }

    /// An integer.
    pub fn integer(&mut self, value: i64) -> Term {
        self.number(<Rational as numbers::Field>::from_integer(value))
    }

    /// A symbol as a term.
    pub fn symbol(&mut self, symbol: Symbol) -> Term {
        self.add(Node::Symbol(symbol))
    }

    /// The sum of terms.
    pub fn sum(&mut self, mut parts: Vec<Term>) -> Term {
        match parts.len() {
            0 => self.integer(0),
            1 => parts.remove(0),
            _ => self.add(Node::Sum(parts)),
        }
    }

    /// The product of terms.
    pub fn product(&mut self, mut parts: Vec<Term>) -> Term {
        match parts.len() {
            0 => self.integer(1),
            1 => parts.remove(0),
            _ => self.add(Node::Product(parts)),
        }
    }

    /// `-term`.
    pub fn negative(&mut self, term: Term) -> Term {
        let minus = self.integer(-1);
        self.product(vec![minus, term])
    }

    /// `a - b`.
    pub fn difference(&mut self, a: Term, b: Term) -> Term {
        let negative = self.negative(b);
        self.sum(vec![a, negative])
    }

    /// `a / b`.
    pub fn quotient(&mut self, a: Term, b: Term) -> Term {
        self.add(Node::Quotient(a, b))
    }

    /// An elementary function of a term.
    pub fn elementary(&mut self, function: Elementary, of: Term) -> Term {
        self.add(Node::Elementary(function, of))
    }

    /// The terms one step inside a term.
    pub fn parts(&self, term: Term) -> Vec<Term> {
        parts_of(self.node(term)).collect()
    }

    /// The term and all that is inside it, each once, inner ones first.
    pub fn inside(&self, term: Term) -> Vec<Term> {
        let mut met: HashSet<Term, BuildHasherDefault<Mixed>> = HashSet::default();
        met.insert(term);
        let mut next = vec![term];
        while let Some(term) = next.pop() {
            next.extend(parts_of(self.node(term)).filter(|part| met.insert(*part)));
        }
        // numbers of inner terms are smaller than those of the terms they are in
        let mut inside: Vec<Term> = met.into_iter().collect();
        inside.sort_unstable();
        inside
    }

    /// The term of another store with the same symbols and functions.
    pub(super) fn copied(&mut self, other: &Self, term: Term) -> Term {
        let mut numbers: TermMap<Term> = TermMap::default();
        for inner in other.inside(term) {
            let copy = match (other.node(inner), other.bounds(inner)) {
                (&Node::Integral { of, low, high }, Some(bounds)) => {
                    let parts = [of, low, high].map(|part| self.copied(other, part));
                    self.add_integral(parts, bounds.clone())
                }
                (node, _) => self.add(node.with_parts(&|part| numbers.get(&part).copied().unwrap_or(part))),
            };
            numbers.insert(inner, copy);
        }
        numbers.get(&term).copied().unwrap_or(term)
    }

    /// The term with some terms inside replaced: `new` gives a term for a node whose parts are rewritten already.
    pub fn rewrite(&mut self, term: Term, new: &mut dyn FnMut(&mut Self, &Node) -> Option<Term>) -> Term {
        let mut done: TermMap<Term> = TermMap::default();
        for inner in self.inside(term) {
            let moved = |part: Term| done.get(&part).copied().unwrap_or(part);
            let is_moved = parts_of(self.node(inner)).any(|part| done.contains_key(&part));
            let node = self.node(inner).with_parts(&moved);
            let result = match new(self, &node) {
                Some(result) => result,
                None if is_moved => self.add(node),
                None => continue,
            };
            done.insert(inner, result);
        }
        done.get(&term).copied().unwrap_or(term)
    }

    /// The term with one symbol replaced by a term.
    pub fn substitute(&mut self, term: Term, symbol: Symbol, by: Term) -> Term {
        self.rewrite(term, &mut |_, node| (*node == Node::Symbol(symbol)).then_some(by))
    }

    /// Whether the symbol occurs in the term.
    pub fn holds(&self, term: Term, symbol: Symbol) -> bool {
        self.inside(term)
            .iter()
            .any(|&inner| *self.node(inner) == Node::Symbol(symbol))
    }

    /// Whether no symbol and no unknown function occurs in the term.
    pub fn is_closed(&self, term: Term) -> bool {
        self.open.get(term.0 as usize) == Some(&false)
    }
}

impl Hasher for Mixed {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let word = chunk.iter().fold(0, |word, byte| word << 8 | u64::from(*byte));
            self.write_u64(word);
        }
    }

    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }

    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(26) ^ value).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }

    fn write_u128(&mut self, value: u128) {
        self.write_u64(value as u64);
        self.write_u64((value >> 64) as u64);
    }

    fn write_usize(&mut self, value: usize) {
        self.write_u64(value as u64);
    }

    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
}

impl Node {
    /// The node with the terms one step inside replaced.
    pub(super) fn with_parts(&self, new: &dyn Fn(Term) -> Term) -> Self {
        let all = |parts: &[Term]| parts.iter().map(|&part| new(part)).collect();
        match self {
            Self::Sum(parts) => Self::Sum(all(parts)),
            Self::Product(parts) => Self::Product(all(parts)),
            Self::Power(base, exponent) => Self::Power(new(*base), *exponent),
            Self::Quotient(a, b) => Self::Quotient(new(*a), new(*b)),
            Self::RealPower(a, b) => Self::RealPower(new(*a), new(*b)),
            Self::Elementary(function, of) => Self::Elementary(*function, new(*of)),
            Self::Value(function, order, of) => Self::Value(*function, *order, new(*of)),
            node => node.clone(),
        }
    }
}

/// The terms one step inside a node.
fn parts_of(node: &Node) -> impl Iterator<Item = Term> {
    let (many, few): (&[Term], [Option<Term>; 2]) = match node {
        Node::Number(_) | Node::Pi | Node::Imaginary | Node::Symbol(_) | Node::Bound | Node::Integral { .. } => {
            (&[], [None, None])
        }
        Node::Sum(parts) | Node::Product(parts) => (parts, [None, None]),
        Node::Power(base, _) => (&[], [Some(*base), None]),
        Node::Quotient(a, b) | Node::RealPower(a, b) => (&[], [Some(*a), Some(*b)]),
        Node::Elementary(_, of) | Node::Value(_, _, of) => (&[], [Some(*of), None]),
    };
    many.iter().copied().chain(few.into_iter().flatten())
}
