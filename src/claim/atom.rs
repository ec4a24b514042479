//! The quantities that formulas speak of, each a variable of the algebra.

use super::vocabulary::subscript_of;
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::tex::{Invariant, Name};
use dashu_int::IBig;
use std::hash::{DefaultHasher, Hash, Hasher};

/// What a variable of the algebra stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Atom {
    /// A parameter, an abbreviation, or `\pi`.
    Symbol(Name),
    /// The time of an impact.
    Time { family: Name, index: i32 },
    /// The running time of a flight.
    Running,
    /// A state at an impact, just before or just after it.
    State { state: Name, index: i32, after: bool },
    /// The value of a function, or of a state in flight, at a time.
    Value { function: Name, argument: Fraction },
    /// A partial derivative of a one-impact map.
    Partial { of: Variable, by: Variable },
    /// The trace or determinant of a map that no premise says more of.
    Invariant { kind: Invariant, of: Name },
    /// The cosine or sine of an angle.
    Circular { sine: bool, angle: Fraction },
    /// A square root.
    Root { radicand: Fraction },
}

impl Atom {
    /// A number that equal quantities share.
    fn key(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        std::mem::discriminant(self).hash(&mut hasher);
        match self {
            Self::Symbol(name) | Self::Value { function: name, .. } => name.hash(&mut hasher),
            Self::Time { family, index } => (family, index).hash(&mut hasher),
            Self::State { state, index, after } => (state, index, after).hash(&mut hasher),
            Self::Partial { of, by } => (of, by).hash(&mut hasher),
            Self::Invariant { kind, of } => (kind, of).hash(&mut hasher),
            Self::Circular { sine, .. } => sine.hash(&mut hasher),
            Self::Running | Self::Root { .. } => {}
        }
        hasher.finish()
    }
}

/// The quantities met so far.
#[derive(Clone, Debug, Default)]
pub struct Atoms {
    list: Vec<Atom>,
    /// One key for each, so that names are compared only where they are likely the same.
    keys: Vec<u64>,
    letter: String,
}

impl Atoms {
    /// No quantities yet; impacts are numbered by `letter` when shown.
    pub fn new(letter: &str) -> Self {
        Self {
            letter: letter.to_string(),
            ..Self::default()
        }
    }

    /// The variable of a quantity.
    pub fn variable(&mut self, atom: Atom) -> Variable {
        let key = atom.key();
        let same = |known: &Atom| match (known, &atom) {
            // Arguments are compared as written: equal ones have one form, as they have no denominator.
            (
                Atom::Value {
                    function: f,
                    argument: a,
                },
                Atom::Value {
                    function: g,
                    argument: b,
                },
            ) => f == g && a.has_form_of(b),
            (Atom::Circular { sine: f, angle: a }, Atom::Circular { sine: g, angle: b }) => f == g && a.has_form_of(b),
            (known, atom) => known == atom,
        };
        let mut candidates = self
            .keys
            .iter()
            .zip(&self.list)
            .enumerate()
            .filter(|(_, (known, _))| **known == key);
        let position = candidates
            .find(|(_, (_, known))| same(known))
            .map(|(position, _)| position);
        let position = position.unwrap_or_else(|| {
            self.list.push(atom);
            self.keys.push(key);
            self.list.len() - 1
        });
        Variable(position as u32)
    }

    /// The quantity of a variable.
    pub fn atom(&self, variable: Variable) -> Option<&Atom> {
        self.list.get(variable.0 as usize)
    }

    /// Every variable so far.
    pub fn variables(&self) -> impl Iterator<Item = Variable> + use<> {
        (0..self.list.len() as u32).map(Variable)
    }

    /// The quantity as an author would write it.
    pub fn show(&self, variable: Variable) -> String {
        let numbered = |name: &Name, index: i32| Name {
            subscript: subscript_of(index, &self.letter),
            ..name.clone()
        };
        match self.atom(variable) {
            None => "?".to_string(),
            Some(Atom::Symbol(name)) => name.to_string(),
            Some(Atom::Time { family, index }) => numbered(family, *index).to_string(),
            Some(Atom::Running) => "t".to_string(),
            Some(Atom::State { state, index, after }) => {
                let mark = if *after { "+" } else { "" }.to_string();
                Name {
                    mark,
                    ..numbered(state, *index)
                }
                .to_string()
            }
            Some(Atom::Value { function, argument }) => format!("{function}({})", self.show_time(argument)),
            Some(Atom::Partial { of, by }) => {
                format!(r"\frac{{\partial {}}}{{\partial {}}}", self.show(*of), self.show(*by))
            }
            Some(Atom::Invariant {
                kind: Invariant::Trace,
                of,
            }) => format!("Tr({of})"),
            Some(Atom::Invariant {
                kind: Invariant::Determinant,
                of,
            }) => format!("Det({of})"),
            Some(Atom::Circular { sine, angle }) => {
                format!(r"\{}({})", if *sine { "sin" } else { "cos" }, self.show_fraction(angle))
            }
            Some(Atom::Root { radicand }) => format!(r"\sqrt{{{}}}", self.show_fraction(radicand)),
        }
    }

    /// A time as the impact it belongs to, where it is `t_k` and the flights from there on.
    fn show_time(&self, time: &Fraction) -> String {
        let mut shown = self.show_fraction(time);
        for (flights, index) in [("t_k+T_1+T_2", 2), ("t_k+T_1", 1)] {
            let plain: String = shown.chars().filter(|c| !c.is_whitespace()).collect();
            let sorted = |text: &str| {
                let mut parts: Vec<String> = text.split('+').map(str::to_string).collect();
                parts.sort();
                parts
            };
            if sorted(&plain) == sorted(flights) {
                shown = format!("t_{{{}}}", subscript_of(index, &self.letter));
            }
        }
        shown
    }

    /// A polynomial in TeX.
    pub fn show_polynomial(&self, polynomial: &Polynomial) -> String {
        if polynomial.is_too_large() {
            return r"\ldots".to_string();
        }
        let mut text = String::new();
        for (monomial, coefficient) in polynomial.terms() {
            let negative = *coefficient < IBig::ZERO;
            let size = if negative { -coefficient } else { coefficient.clone() };
            text.push_str(match (text.is_empty(), negative) {
                (true, false) => "",
                (true, true) => "-",
                (false, false) => " + ",
                (false, true) => " - ",
            });
            let mut factors: Vec<String> = Vec::new();
            if size != IBig::ONE || monomial.is_one() {
                factors.push(size.to_string());
            }
            for &(variable, exponent) in monomial.factors().iter().rev() {
                let base = self.show(variable);
                let simple = !matches!(
                    self.atom(variable),
                    Some(Atom::State { after: true, .. } | Atom::Partial { .. })
                );
                factors.push(match (exponent, simple) {
                    (1, _) => base,
                    (_, true) => format!("{base}^{{{exponent}}}"),
                    (_, false) => format!("({base})^{{{exponent}}}"),
                });
            }
            text.push_str(&factors.join(" "));
        }
        if text.is_empty() { "0".to_string() } else { text }
    }

    /// A rational function in TeX.
    pub fn show_fraction(&self, fraction: &Fraction) -> String {
        let above = self.show_polynomial(fraction.numerator());
        let below = fraction.denominator();
        if below.is_one() {
            return above;
        }
        if fraction.factors().is_empty() && fraction.numerator().as_constant().is_some() {
            return format!("{above}/{}", self.show_polynomial(&below));
        }
        format!(r"\frac{{{above}}}{{{}}}", self.show_polynomial(&below))
    }
}
