//! From the names of a formula to the quantities of the algebra.

use super::angle;
use super::atom::{Atom, Atoms};
use super::jacobian::Jacobians;
use super::meaning::Meaning;
use super::vocabulary::{Vocabulary, index_of};
use crate::algebra::{Fraction, Undefined, Variable};
use crate::number::Rational;
use crate::tex::{EvaluationError, Invariant, Name, Scope, Tree, Unsupported, evaluate};
use num_traits::Zero;
use std::collections::HashMap;

/// Why a name could not be given a meaning.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Meaningless {
    #[error("unknown symbol `{name}` (known: {known})")]
    Unknown { name: String, known: String },
    #[error("`{0}` is defined by itself")]
    Circular(String),
    #[error("`{0}` is not a function here")]
    NotAFunction(String),
    #[error("`{0}` needs the time of an impact in its bracket")]
    NoImpact(String),
    #[error("no map gives the derivative of `{of}` by `{by}`")]
    NoMap { of: String, by: String },
    #[error("`{0}` is a matrix without equal numbers of rows and columns")]
    NotSquare(String),
    #[error("the angle `{0}` is not a sum of whole multiples")]
    Angle(String),
    #[error("`{0}` cannot be decided exactly: of elementary functions only \\cos, \\sin and \\tan can")]
    Transcendental(String),
    #[error("a denominator is zero everywhere")]
    Undefined(#[from] Undefined),
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
}

/// A symbol that stands for an expression, and whether the expression is read as it is or was already.
#[derive(Clone, Debug)]
pub struct Local {
    pub name: Name,
    pub tree: Tree,
}

/// How the names of one equation are read.
pub struct Reading<'a> {
    pub vocabulary: &'a Vocabulary,
    pub jacobians: &'a Jacobians,
    pub atoms: &'a mut Atoms,
    pub meaning: &'a Meaning,
    /// Symbols defined beside the formula.
    pub locals: &'a [Local],
    /// The first impact the equation speaks of: there a state without a mark, as the value of a motion, is the one
    /// just after the impact; at any other it is the one the flight arrives with.
    pub first: Option<i32>,
    /// What is known of times where quantities have values as numbers: functions are told apart by their times.
    pub times: Option<&'a Meaning>,
    /// The sign that `\pm` stands for.
    pub upper: Option<bool>,
    /// A test for zero that knows more than the form of a function.
    pub vanishes: Option<&'a dyn Fn(&Fraction) -> bool>,
    /// The time at which a function without a bracket is taken.
    running: Option<Fraction>,
    /// The locals being read, innermost last.
    open: Vec<Name>,
    read: HashMap<Name, Fraction>,
}

impl<'a> Reading<'a> {
    /// A reading that knows nothing beyond the vocabulary.
    pub fn new(
        vocabulary: &'a Vocabulary,
        jacobians: &'a Jacobians,
        atoms: &'a mut Atoms,
        meaning: &'a Meaning,
        locals: &'a [Local],
    ) -> Self {
        Self {
            vocabulary,
            jacobians,
            atoms,
            meaning,
            locals,
            first: None,
            times: None,
            upper: None,
            vanishes: None,
            running: None,
            open: Vec::new(),
            read: HashMap::new(),
        }
    }

    /// The function a tree stands for.
    pub fn tree(&mut self, tree: &Tree) -> Result<Fraction, EvaluationError<Meaningless>> {
        evaluate(tree, self)
    }

    /// The value of a quantity, as far as it is known.
    fn resolve(&mut self, atom: Atom) -> Fraction {
        let variable = self.atoms.variable(atom);
        self.meaning
            .values
            .get(&variable)
            .cloned()
            .unwrap_or_else(|| Fraction::variable(variable))
    }

    /// The quantity of an indexed time or state.
    pub fn quantity(&mut self, name: &Name) -> Option<Atom> {
        let (bare, index) = (name.bare(), index_of(&name.subscript, &self.vocabulary.index)?);
        if name.primes > 0 {
            return None;
        }
        if name.mark.is_empty() && self.vocabulary.times.contains(&bare) {
            return Some(Atom::Time { family: bare, index });
        }
        if self.vocabulary.states.contains(&bare) && matches!(name.mark.as_str(), "" | "-" | "+") {
            let after = name.mark == "+" && !self.vocabulary.continuous.contains(&bare);
            return Some(Atom::State {
                state: bare,
                index,
                after,
            });
        }
        None
    }

    /// The value of the function `name` at a time.
    fn value(&mut self, name: &Name, time: Fraction) -> Result<Fraction, Meaningless> {
        let function = Name {
            primes: 0,
            mark: String::new(),
            ..name.clone()
        };
        if name.primes > 0 {
            let lower = Name {
                primes: name.primes - 1,
                ..name.clone()
            };
            if let Some(derivative) = self.derivative(&function) {
                return match derivative {
                    Derivative::Name(next) => self.value(
                        &Name {
                            primes: lower.primes,
                            ..next
                        },
                        time,
                    ),
                    Derivative::Tree(tree) if lower.primes == 0 => self.at_time(&tree, time),
                    Derivative::Tree(_) => Err(Meaningless::NotAFunction(name.to_string())),
                };
            }
        }
        let function = Name {
            primes: name.primes,
            ..function
        };
        let argument = self.meaning.reduced(&function, time);
        Ok(self.resolve(Atom::Value { function, argument }))
    }

    fn derivative(&self, function: &Name) -> Option<Derivative> {
        if self.vocabulary.states.contains(&function.bare()) {
            return Some(Derivative::Name(function.dotted()));
        }
        let (_, tree) = self.vocabulary.functions.iter().find(|(name, _)| name == function)?;
        match tree.as_ref()? {
            Tree::Symbol(name, _) if self.is_function(name) => Some(Derivative::Name(name.clone())),
            tree => Some(Derivative::Tree(tree.clone())),
        }
    }

    fn is_function(&self, name: &Name) -> bool {
        let plain = Name {
            primes: 0,
            ..name.clone()
        };
        self.vocabulary.functions.iter().any(|(function, _)| *function == plain)
    }

    /// Whether this is a state, or a derivative of one, in flight.
    fn is_motion(&self, name: &Name) -> bool {
        let plain = Name {
            primes: 0,
            mark: String::new(),
            ..name.clone()
        };
        let states = &self.vocabulary.states;
        states
            .iter()
            .any(|s| *s == plain || s.dotted() == plain || s.dotted().dotted() == plain)
    }

    /// A function that needs no declaration.
    fn elementary(&mut self, function: &Name, argument: &Tree) -> Result<Fraction, Meaningless> {
        if !function.base.starts_with('\\')
            || *function
                != (Name {
                    base: function.base.clone(),
                    ..Name::default()
                })
        {
            return Err(Meaningless::NotAFunction(function.to_string()));
        }
        let angle = self.time(argument)?;
        let (cosine, sine) = match function.base.as_str() {
            r"\cos" | r"\sin" | r"\tan" => angle::cosine_and_sine(&angle, self.atoms)?,
            _ => return Err(Meaningless::Transcendental(function.to_string())),
        };
        let (cosine, sine) = (self.meaning.apply(&cosine)?, self.meaning.apply(&sine)?);
        match function.base.as_str() {
            r"\cos" => Ok(cosine),
            r"\sin" => Ok(sine),
            _ if self.is_zero(&cosine) => Err(Meaningless::Undefined(Undefined)),
            _ => Ok(sine / cosine),
        }
    }

    /// The derivative by time of the value of a function at `time`.
    pub fn slope(&mut self, function: &Name, time: &Fraction) -> Result<Fraction, Meaningless> {
        let name = Name {
            primes: function.primes + 1,
            ..function.clone()
        };
        if self.is_motion(&Name {
            primes: 0,
            ..function.clone()
        }) {
            return self.value(&function.dotted(), time.clone());
        }
        self.value(&name, time.clone())
    }

    /// The function a tree stands for at a time.
    pub fn at_time(&mut self, tree: &Tree, time: Fraction) -> Result<Fraction, Meaningless> {
        let outer = self.running.replace(time);
        let result = self.nested(tree);
        self.running = outer;
        result
    }

    /// The time that stands in the bracket of a function.
    fn time(&mut self, argument: &Tree) -> Result<Fraction, Meaningless> {
        let Some(times) = self.times else {
            return self.nested(argument);
        };
        let meaning = std::mem::replace(&mut self.meaning, times);
        let read = std::mem::take(&mut self.read);
        let time = self.nested(argument);
        self.meaning = meaning;
        self.read = read;
        time
    }

    /// The function a tree stands for that the formula itself only names: a fault in it has no place in the formula.
    fn nested(&mut self, tree: &Tree) -> Result<Fraction, Meaningless> {
        self.tree(tree).map_err(|error| match error {
            EvaluationError::Scope { error, .. } => error,
            _ => Meaningless::Undefined(Undefined),
        })
    }

    fn local(&mut self, name: &Name) -> Option<Result<Fraction, Meaningless>> {
        let local = self.locals.iter().find(|local| local.name == *name)?;
        if let Some(known) = self.read.get(name) {
            return Some(Ok(known.clone()));
        }
        let result = self.opened(name, &local.tree);
        if let Ok(value) = &result {
            self.read.insert(name.clone(), value.clone());
        }
        Some(result)
    }

    /// The function that a name stands for, which must not stand for itself.
    fn opened(&mut self, name: &Name, tree: &Tree) -> Result<Fraction, Meaningless> {
        if self.open.contains(name) {
            return Err(Meaningless::Circular(name.to_string()));
        }
        self.open.push(name.clone());
        let result = self.nested(tree);
        self.open.pop();
        result
    }

    fn unknown(&self, name: &Name) -> Meaningless {
        Meaningless::Unknown {
            name: name.to_string(),
            known: self.vocabulary.known(),
        }
    }

    /// Whether a name needs no definition.
    pub fn knows(&mut self, name: &Name) -> bool {
        Scope::<Fraction>::symbol(self, name).is_ok()
    }
}

enum Derivative {
    Name(Name),
    Tree(Tree),
}

impl Scope<Fraction> for Reading<'_> {
    type Error = Meaningless;

    fn symbol(&mut self, name: &Name) -> Result<Fraction, Meaningless> {
        if let Some(local) = self.local(name) {
            return local;
        }
        if self.vocabulary.parameters.contains(name) {
            return Ok(self.resolve(Atom::Symbol(name.clone())));
        }
        if let Some((name, tree)) = self.vocabulary.abbreviations.iter().find(|(known, _)| known == name) {
            // Before premises are solved, an abbreviation is what it abbreviates, so that derivatives see its times.
            let variable = self.atoms.variable(Atom::Symbol(name.clone()));
            return match self.meaning.values.get(&variable) {
                Some(value) => Ok(value.clone()),
                None if !self.meaning.values.is_empty() => Ok(Fraction::variable(variable)),
                None => self.opened(name, tree),
            };
        }
        if let Some(atom) = self.quantity(name) {
            return Ok(self.resolve(atom));
        }
        if self.vocabulary.running.as_ref() == Some(name) {
            return Ok(self
                .running
                .clone()
                .unwrap_or_else(|| Fraction::variable(self.atoms.variable(Atom::Running))));
        }
        if name.mark.is_empty() && (self.is_function(name) || self.is_motion(name)) {
            let running = self.running.clone();
            let time = running.unwrap_or_else(|| Fraction::variable(self.atoms.variable(Atom::Running)));
            return self.value(name, time);
        }
        if name.base == r"\pi"
            && *name
                == (Name {
                    base: name.base.clone(),
                    ..Name::default()
                })
        {
            return Ok(self.resolve(Atom::Symbol(name.clone())));
        }
        Err(self.unknown(name))
    }

    fn call(&mut self, function: &Name, argument: &Tree) -> Result<Fraction, Meaningless> {
        let motion = self.is_motion(function);
        if !motion && !self.is_function(function) {
            return self.elementary(function, argument);
        }
        if motion
            && function.primes == 0
            && let Tree::Symbol(time, _) = argument
            && let Some(Atom::Time { index, .. }) = self.quantity(time)
            && self.vocabulary.states.contains(&function.bare())
        {
            let state = function.bare();
            let departs = function.mark == "+" || (function.mark.is_empty() && self.first == Some(index));
            let after = departs && !self.vocabulary.continuous.contains(&state);
            return Ok(self.resolve(Atom::State { state, index, after }));
        }
        if !function.mark.is_empty() {
            return Err(Meaningless::NoImpact(function.to_string()));
        }
        let time = self.time(argument)?;
        self.value(function, time)
    }

    fn partial(&mut self, of: &Name, by: &Name) -> Result<Fraction, Meaningless> {
        let none = Meaningless::NoMap {
            of: of.to_string(),
            by: by.to_string(),
        };
        let (Some(above), Some(below)) = (self.quantity(of), self.quantity(by)) else {
            return Err(none);
        };
        let (above, below) = (self.atoms.variable(above), self.atoms.variable(below));
        let entry = self.jacobians.entry(above, below, self.atoms).ok_or(none)?;
        Ok(self.meaning.apply(&entry)?)
    }

    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<Fraction, Meaningless> {
        if self.jacobians.opaque {
            return Ok(self.resolve(Atom::Invariant { kind, of: of.clone() }));
        }
        let meaning = self.meaning;
        let known = |v: Variable| meaning.values.get(&v).cloned().unwrap_or_else(|| Fraction::variable(v));
        let matrix = self
            .jacobians
            .matrix(of, self.atoms, &known)
            .ok_or_else(|| self.unknown(of))?;
        super::jacobian::invariant(kind, &matrix).ok_or_else(|| Meaningless::NotSquare(of.to_string()))
    }

    fn root(&mut self, radicand: Fraction) -> Result<Fraction, Meaningless> {
        if let Some(root) = super::root::of_square(&radicand) {
            return Ok(root);
        }
        Ok(self.resolve(Atom::Root { radicand }))
    }

    fn number(&mut self, value: &Rational) -> Result<Fraction, Meaningless> {
        Ok(Fraction::from(value))
    }

    fn upper_sign(&self) -> Option<bool> {
        self.upper
    }

    fn is_zero(&mut self, value: &Fraction) -> bool {
        value.is_zero() || self.vanishes.is_some_and(|vanishes| vanishes(value))
    }
}
