//! Axioms: the rows of `axioms.txt`, each with its guards, and their instances.

use super::expand::Refusal;
use super::statement::{Instance, Property, Statement};
use super::term::{Elementary, Node, Term, Terms};
use numbers::{Field, Rational};
use std::sync::LazyLock;

/// The table of axioms as a text, with what its rows mean.
pub const AXIOMS: &str = include_str!("axioms.txt");

/// An instance of an axiom: its name, and a term for each of its letters, in their order.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Axiom {
    pub name: &'static str,
    pub terms: Vec<Term>,
}

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AxiomRow {
    pub name: &'static str,
    pub letters: Vec<&'static str>,
    pub guards: Vec<&'static str>,
    pub conclusion: &'static str,
    pub source: &'static str,
}

/// A condition that an instance needs, or its conclusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    Holds(Property, Term),
    Defined(Term),
    Real(Term),
    /// A number that is written out: 0 or more, even or odd.
    Written(&'static str, Term),
    /// Over which numbers the statement is.
    Over(&'static str),
}

static ROWS: LazyLock<Vec<AxiomRow>> = LazyLock::new(|| {
    let lines = AXIOMS.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let row = |line: &'static str| {
        let mut parts = line.split('|').map(str::trim);
        Some(AxiomRow {
            name: parts.next()?,
            letters: parts.next()?.split_whitespace().collect(),
            guards: parts.next()?.split("; ").filter(|guard| !guard.is_empty()).collect(),
            conclusion: parts.next()?,
            source: parts.next()?,
        })
    };
    lines.filter_map(row).collect()
});

impl AxiomRow {
    /// All rows, in the order of the table.
    pub fn all() -> &'static [Self] {
        &ROWS
    }

    /// The row of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        ROWS.iter().find(|row| row.name == name)
    }
}

impl Axiom {
    /// Its guards and what it concludes, as terms.
    ///
    /// # Errors
    /// A [`Refusal`] where there is no such axiom, it has another number of letters, or an index or exponent is not written out.
    pub fn instance(&self, terms: &mut Terms) -> Result<(Vec<Guard>, Guard), Refusal> {
        let row = AxiomRow::named(self.name).filter(|row| row.letters.len() == self.terms.len());
        let row = row.ok_or_else(|| Refusal::Other("there is no such axiom of as many letters".into()))?;
        let letters: Vec<(&str, Term)> = row.letters.iter().copied().zip(self.terms.iter().copied()).collect();
        let mut read = |text: &'static str| Reader::new(text, terms, &letters).guard();
        let guards = row.guards.iter().map(|guard| read(guard)).collect::<Result<_, _>>()?;
        Ok((guards, read(row.conclusion)?))
    }

    /// The property that it concludes of a term, and the conditions for that.
    ///
    /// # Errors
    /// A [`Refusal`] where there is no such axiom of as many letters.
    pub fn reading(&self, statement: &mut Statement) -> Result<Instance, Refusal> {
        let (guards, conclusion) = self.instance(&mut statement.terms)?;
        let mut conditions = Vec::new();
        for guard in guards {
            match guard {
                Guard::Holds(property, term) => {
                    conditions.extend(statement.domain(term));
                    conditions.push((property, term));
                }
                Guard::Defined(term) => conditions.extend(statement.domain(term)),
                Guard::Real(_) | Guard::Written(..) | Guard::Over(_) => {}
            }
        }
        match conclusion {
            Guard::Holds(property, term) => Ok(Instance {
                property,
                term,
                conditions,
            }),
            _ => Err(Refusal::Other("an axiom concludes a property".into())),
        }
    }
}

/// Reads a guard or a conclusion of a row, with terms for its letters.
struct Reader<'a> {
    rest: &'static str,
    terms: &'a mut Terms,
    letters: &'a [(&'a str, Term)],
}

impl<'a> Reader<'a> {
    fn new(text: &'static str, terms: &'a mut Terms, letters: &'a [(&'a str, Term)]) -> Self {
        Self {
            rest: text,
            terms,
            letters,
        }
    }

    fn refused<T>(&self) -> Result<T, Refusal> {
        Err(Refusal::Other(format!("an axiom cannot be read at `{}`", self.rest)))
    }

    /// Takes a sign if it stands here.
    fn takes(&mut self, sign: &str) -> bool {
        match self.rest.trim_start().strip_prefix(sign) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn word(&mut self) -> &'static str {
        let own = self.rest.trim_start();
        let end = own.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(own.len());
        let (word, rest) = own.split_at(end);
        self.rest = rest;
        word
    }

    /// `complex`, `real(x)`, `a = b`, all of the text.
    fn guard(&mut self) -> Result<Guard, Refusal> {
        let whole = self.rest;
        let word = self.word();
        if matches!(word, "complex" | "reals") {
            return Ok(Guard::Over(word));
        }
        let found = match word {
            "defined" | "real" | "integer" | "natural" | "even" | "odd" => {
                let of = self.bracketed()?;
                match word {
                    "defined" => Guard::Defined(of),
                    "real" => Guard::Real(of),
                    "integer" => Guard::Holds(Property::Integer, of),
                    _ => Guard::Written(word, of),
                }
            }
            _ => {
                self.rest = whole;
                self.relation()?
            }
        };
        if self.rest.is_empty() {
            Ok(found)
        } else {
            self.refused()
        }
    }

    fn relation(&mut self) -> Result<Guard, Refusal> {
        let left = self.sum()?;
        let relations = [
            ("=", Property::Zero),
            ("!=", Property::Nonzero),
            (">=", Property::NonNegative),
            (">", Property::Positive),
        ];
        let Some((_, property)) = relations.into_iter().find(|(sign, _)| self.takes(sign)) else {
            return self.refused();
        };
        let right = self.sum()?;
        let is_nothing = *self.terms.node(right) == Node::Number(Rational::from_integer(0));
        let of = if is_nothing {
            left
        } else {
            self.terms.difference(left, right)
        };
        Ok(Guard::Holds(property, of))
    }

    fn sum(&mut self) -> Result<Term, Refusal> {
        let mut parts = Vec::new();
        loop {
            let is_negative = self.takes("-");
            if !is_negative && !parts.is_empty() && !self.takes("+") {
                return Ok(self.terms.sum(parts));
            }
            let is_numeral = self.rest.trim_start().starts_with(|c: char| c.is_ascii_digit());
            let part = self.product()?;
            parts.push(match (is_negative, self.terms.node(part)) {
                (false, _) => part,
                (true, Node::Number(number)) if is_numeral => {
                    let number = Rational(-number.0.clone());
                    self.terms.number(number)
                }
                (true, _) => self.terms.negative(part),
            });
        }
    }

    fn product(&mut self) -> Result<Term, Refusal> {
        let mut factors = vec![self.power()?];
        loop {
            if self.takes("*") {
                factors.push(self.power()?);
            } else if self.takes("/") {
                let (above, below) = (self.terms.product(factors), self.power()?);
                factors = vec![self.terms.quotient(above, below)];
            } else {
                return Ok(self.terms.product(factors));
            }
        }
    }

    fn power(&mut self) -> Result<Term, Refusal> {
        let base = self.atom()?;
        if self.takes("^") {
            let exponent = self.atom()?;
            let exponent = self.written(exponent)?;
            return Ok(self.terms.add(Node::Power(base, exponent)));
        }
        Ok(base)
    }

    /// The number that a term is, where it is 0 or more.
    fn written(&self, term: Term) -> Result<i32, Refusal> {
        match written(self.terms, term).and_then(|number| i32::try_from(number).ok()) {
            Some(number) => Ok(number),
            None => Err(Refusal::Other("an index or exponent is not written out".into())),
        }
    }

    fn bracketed(&mut self) -> Result<Term, Refusal> {
        let open = self.takes("(");
        let inside = self.sum()?;
        if open && self.takes(")") {
            Ok(inside)
        } else {
            self.refused()
        }
    }

    fn atom(&mut self) -> Result<Term, Refusal> {
        if self.rest.trim_start().starts_with('(') {
            return self.bracketed();
        }
        let word = self.word();
        if let Some((_, term)) = self.letters.iter().find(|(letter, _)| *letter == word) {
            return Ok(*term);
        }
        if let Ok(number) = word.parse() {
            return Ok(self.terms.integer(number));
        }
        let function = match word {
            "pi" => return Ok(self.terms.add(Node::Pi)),
            "i" => return Ok(self.terms.add(Node::Imaginary)),
            "root" | "power" => return self.of_two(word),
            "sin" => Elementary::Sin,
            "cos" => Elementary::Cos,
            "exp" => Elementary::Exp,
            "ln" => Elementary::Ln,
            "arcsin" => Elementary::Arcsin,
            "arccos" => Elementary::Arccos,
            "arctan" => Elementary::Arctan,
            _ => return self.refused(),
        };
        let of = self.bracketed()?;
        Ok(self.terms.elementary(function, of))
    }

    /// Reads the two arguments behind `root` or `power`.
    fn of_two(&mut self, function: &str) -> Result<Term, Refusal> {
        let open = self.takes("(");
        let first = self.sum()?;
        let comma = self.takes(",");
        let second = self.sum()?;
        if !(open && comma && self.takes(")")) {
            return self.refused();
        }
        if function == "power" {
            return Ok(self.terms.add(Node::RealPower(first, second)));
        }
        match u32::try_from(self.written(first)?) {
            Ok(index @ 2..) => Ok(self.terms.elementary(Elementary::Root(index), second)),
            _ => Err(Refusal::Other("a root has an index of 2 or more".into())),
        }
    }
}

/// The number that a term is, where it is a whole one.
pub(super) fn written(terms: &Terms, term: Term) -> Option<i64> {
    match terms.node(term) {
        Node::Number(number) => number.to_integer(),
        _ => None,
    }
}
