//! Terms and polynomials of the kernel as Rocq writes them.

use kernel::{Elementary, FunctionOf, Node, Polynomial, Property, Statement, Symbol, Term};
use num_traits::Zero;
use numbers::Rational;
use std::collections::{BTreeMap, BTreeSet};

/// The longest text of one term: shared parts are written out each time.
const LONGEST: usize = 200_000;

/// Why something is not written for Rocq.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, thiserror::Error)]
pub enum Unwritten {
    #[error("{0}")]
    Not(&'static str),
    #[error("{0}")]
    Refused(String),
}

impl From<kernel::Refusal> for Unwritten {
    fn from(refusal: kernel::Refusal) -> Self {
        Self::Refused(refusal.to_string())
    }
}

/// Names that Rocq or its libraries have taken.
const TAKEN: &[&str] = &[
    "as",
    "at",
    "by",
    "cofix",
    "else",
    "end",
    "exists",
    "fix",
    "for",
    "forall",
    "fun",
    "if",
    "in",
    "let",
    "match",
    "mod",
    "return",
    "then",
    "using",
    "where",
    "with",
    "Prop",
    "Set",
    "Type",
    "R",
    "Z",
    "N",
    "Q",
    "C",
    "S",
    "O",
    "I",
    "D",
    "E",
    "nat",
    "exp",
    "ln",
    "sin",
    "cos",
    "tan",
    "sqrt",
    "root",
    "rpow",
    "integer",
    "asin",
    "acos",
    "atan",
    "PI",
    "pow",
    "INR",
    "IZR",
    "Rabs",
    "term",
    "factor",
    "summand",
    "RInt",
    "Derive",
    "sum",
    "prod",
    "fst",
    "snd",
    "left",
    "right",
    "eq",
    "ex",
    "not",
    "or",
    "and",
    "plus",
    "minus",
    "mult",
    "div",
    "le",
    "lt",
    "ge",
    "gt",
    "id",
    "fact",
    "max",
    "min",
    "cosh",
    "sinh",
    "tanh",
    "rsum",
    "rprod",
    "factorial",
    "binomial",
    "clamp",
    "Derive_n",
    "is_lim",
];

/// Names of the symbols and functions of a statement, which nothing else in a file has.
#[derive(Clone, Debug, Default)]
pub struct Names {
    symbols: BTreeMap<Symbol, String>,
    functions: BTreeMap<(u32, u32), String>,
    letters: BTreeMap<String, String>,
    taken: BTreeSet<String>,
    /// The letter of the index.
    index: String,
}

/// A printed name as letters, digits and underscores.
fn plain(printed: &str) -> String {
    let kept: String = printed
        .chars()
        .map(|c| match c {
            c if c.is_ascii_alphanumeric() => c,
            '\'' => '\'',
            '+' => 'p',
            '-' => 'm',
            _ => '_',
        })
        .collect();
    let kept: Vec<&str> = kept.split('_').filter(|part| !part.is_empty()).collect();
    let name = kept.join("_");
    match name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        true => name,
        false => format!("x_{name}").replace('\'', "p"),
    }
}

impl Names {
    /// No names yet, where this letter is the index.
    pub fn new(index: &str) -> Self {
        Self {
            index: index.to_owned(),
            ..Self::default()
        }
    }

    /// A name like a printed one that is not taken yet.
    fn new_name(&mut self, printed: &str) -> String {
        let mut name = plain(printed);
        let is_ours = |name: &str| {
            let rest = name.trim_start_matches(|c: char| "gABCDEFGHIJKLMNOPQSTUVWXYZ".contains(c));
            rest.len() + 1 == name.len() && rest.chars().all(|c| c.is_ascii_digit()) && !rest.is_empty()
        };
        while TAKEN.contains(&name.as_str()) || is_ours(&name) || self.taken.contains(&name) {
            name.push('_');
        }
        self.taken.insert(name.clone());
        name
    }

    pub fn symbol(&mut self, statement: &Statement, symbol: Symbol) -> String {
        if let Some(known) = self.symbols.get(&symbol) {
            return known.clone();
        }
        let name = self.new_name(statement.terms().symbol_name(symbol));
        self.symbols.insert(symbol, name.clone());
        name
    }

    /// Returns true if a symbol has a name.
    pub fn has(&self, symbol: Symbol) -> bool {
        self.symbols.contains_key(&symbol)
    }

    /// A name for a letter that is bound, the same each time.
    pub fn letter(&mut self, printed: &str) -> String {
        if let Some(known) = self.letters.get(printed) {
            return known.clone();
        }
        let name = self.new_name(printed);
        self.letters.insert(printed.to_owned(), name.clone());
        name
    }

    /// Keeps the names among these words alone.
    pub fn keep(&mut self, words: &BTreeSet<&str>) {
        self.symbols.retain(|_, name| words.contains(name.as_str()));
        self.functions.retain(|_, name| words.contains(name.as_str()));
    }

    /// Gives a symbol a name, whatever it is.
    pub fn let_be(&mut self, symbol: Symbol, name: &str) {
        self.symbols.insert(symbol, name.to_owned());
    }

    /// Gives a symbol another name, or none; returns the one that it had.
    pub fn put(&mut self, symbol: Symbol, name: Option<String>) -> Option<String> {
        match name {
            Some(name) => self.symbols.insert(symbol, name),
            None => self.symbols.remove(&symbol),
        }
    }

    /// A function's derivative of an order.
    pub fn function(&mut self, statement: &Statement, function: kernel::Function, order: u32) -> String {
        if let Some(known) = self.functions.get(&(function.0, order)) {
            return known.clone();
        }
        let mut printed = statement.terms().function_name(function).to_owned();
        if let Some(FunctionOf::Interval { offset, .. }) = statement.functions().get(function.0 as usize) {
            printed = format!("{printed}_from_{}", texmath::subscript_of(*offset, &self.index));
        }
        let name = match order {
            0 => self.new_name(&printed),
            _ => self.new_name(&format!("{printed}_D{order}")),
        };
        self.functions.insert((function.0, order), name.clone());
        name
    }

    /// All symbols that have been named, in order.
    pub fn symbols(&self) -> impl Iterator<Item = (&Symbol, &String)> {
        self.symbols.iter()
    }

    /// All functions with their orders that have been named, in order.
    pub fn functions(&self) -> impl Iterator<Item = (&(u32, u32), &String)> {
        self.functions.iter()
    }
}

/// A number: a fraction in brackets where it is none of the natural numbers.
pub fn number(value: &Rational) -> String {
    let (above, below) = (value.0.numerator().to_string(), value.0.denominator().to_string());
    match (below.as_str(), above.strip_prefix('-')) {
        ("1", None) => above,
        ("1", Some(size)) => format!("(- {size})"),
        (_, None) => format!("({above} / {below})"),
        (_, Some(size)) => format!("(- ({size} / {below}))"),
    }
}

pub fn property(property: Property, of: &str) -> String {
    match property {
        Property::Zero => format!("{of} = 0"),
        Property::Nonzero => format!("{of} <> 0"),
        Property::Positive => format!("{of} > 0"),
        Property::NonNegative => format!("{of} >= 0"),
        Property::Integer => format!("integer {of}"),
    }
}

/// The writer of terms: where it is short, a generator is written as `g` and its number, and noted.
pub struct Writer<'a> {
    pub statement: &'a Statement,
    pub names: &'a mut Names,
    pub whole: &'a BTreeSet<Term>,
    /// True if generators have names.
    pub is_short: bool,
    /// The generators that were written by their names.
    pub met: BTreeSet<Term>,
    /// Terms that letters stand for.
    pub letters: BTreeMap<Term, String>,
}

impl Writer<'_> {
    /// A term; a generator by its name, unless it is written out.
    pub fn term(&mut self, term: Term) -> Result<String, Unwritten> {
        if let Some(letter) = self.letters.get(&term) {
            return Ok(letter.clone());
        }
        let is_made = match self.statement.terms().node(term) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => false,
            Node::Sum(_) | Node::Product(_) | Node::Power(..) | Node::Quotient(..) => self.whole.contains(&term),
            _ => true,
        };
        if is_made && self.is_short {
            self.met.insert(term);
            return Ok(format!("g{}", term.0));
        }
        self.written(term)
    }

    /// A term by its parts.
    pub fn written(&mut self, term: Term) -> Result<String, Unwritten> {
        let statement = self.statement;
        let text = match statement.terms().node(term) {
            Node::Number(value) => number(value),
            Node::Pi => "PI".to_owned(),
            Node::Symbol(symbol) => self.names.symbol(statement, *symbol),
            Node::Sum(parts) => {
                let mut text = String::from("(");
                for (place, &part) in parts.iter().enumerate() {
                    let (sign, part) = match (place, self.negated(part)) {
                        (0, _) => ("", part),
                        (_, Some(inner)) => (" - ", inner),
                        _ => (" + ", part),
                    };
                    text += sign;
                    text += &self.term(part)?;
                }
                text + ")"
            }
            Node::Product(parts) => match self.negated(term) {
                Some(inner) => format!("(- {})", self.term(inner)?),
                None => {
                    let parts = parts.iter().map(|&part| self.term(part));
                    format!("({})", parts.collect::<Result<Vec<_>, _>>()?.join(" * "))
                }
            },
            Node::Power(base, exponent) => format!("({} ^ {exponent})", self.term(*base)?),
            Node::Quotient(above, below) => format!("({} / {})", self.term(*above)?, self.term(*below)?),
            Node::Elementary(function, of) => {
                let of = self.term(*of)?;
                match function {
                    Elementary::Sin => format!("(sin {of})"),
                    Elementary::Cos => format!("(cos {of})"),
                    Elementary::Exp => format!("(exp {of})"),
                    Elementary::Ln => format!("(ln {of})"),
                    Elementary::Root(2) => format!("(sqrt {of})"),
                    Elementary::Root(index) => format!("(root {index} {of})"),
                    Elementary::Arcsin => format!("(asin {of})"),
                    Elementary::Arccos => format!("(acos {of})"),
                    Elementary::Arctan => format!("(atan {of})"),
                }
            }
            Node::RealPower(base, exponent) => format!("(rpow {} {})", self.term(*base)?, self.term(*exponent)?),
            Node::Value(function, order, at) => {
                let name = self.names.function(statement, *function, *order);
                format!("({name} {})", self.term(*at)?)
            }
            Node::Imaginary => return Err(Unwritten::Not("complex numbers")),
            Node::Bound | Node::Integral { .. } => return Err(Unwritten::Not("an enclosed integral")),
        };
        match text.len() > LONGEST {
            true => Err(Unwritten::Not("a term that is too long written out")),
            false => Ok(text),
        }
    }

    /// The term of which another is the negative.
    pub fn negated(&self, term: Term) -> Option<Term> {
        match self.statement.terms().node(term) {
            Node::Product(parts) => match parts.as_slice() {
                [sign, inner] => match self.statement.terms().node(*sign) {
                    Node::Number(value) if *value == Rational((-1).into()) => Some(*inner),
                    _ => None,
                },
                _ => None,
            },
            _ => None,
        }
    }

    /// A polynomial over generators.
    pub fn polynomial(&mut self, polynomial: &Polynomial) -> Result<String, Unwritten> {
        let mut text = String::new();
        for (monomial, coefficient) in polynomial.terms() {
            let value = Rational(coefficient.clone());
            let is_negative = value < Rational::zero();
            let size = if is_negative {
                Rational(-coefficient.clone())
            } else {
                value
            };
            let is_one = size == Rational(1.into()) && !monomial.is_empty();
            let mut factors = if is_one { Vec::new() } else { vec![number(&size)] };
            for (generator, power) in monomial {
                let name = self.term(*generator)?;
                factors.push(if *power == 1 { name } else { format!("{name} ^ {power}") });
            }
            text += match (text.is_empty(), is_negative) {
                (true, false) => "",
                (true, true) => "- ",
                (false, false) => " + ",
                (false, true) => " - ",
            };
            text += &factors.join(" * ");
        }
        Ok(if text.is_empty() {
            "0".to_owned()
        } else {
            format!("({text})")
        })
    }
}
