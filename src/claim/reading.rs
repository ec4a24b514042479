//! From the names of a formula to the quantities of the algebra.

use super::atom::{Atom, Atoms};
use super::jacobian::Jacobians;
use super::meaning::Meaning;
use super::vocabulary::{Vocabulary, index_of};
use crate::algebra::{Fraction, Undefined};
use crate::tex::{EvaluationError, Name, Scope, Tree, Unsupported, evaluate};
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
    pub(super) running: Option<Fraction>,
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
    pub(super) fn resolve(&mut self, atom: Atom) -> Fraction {
        let variable = self.atoms.variable(atom);
        self.meaning
            .values
            .get(&variable)
            .cloned()
            .unwrap_or_else(|| Fraction::variable(variable))
    }

    /// The quantity of an indexed time or state.
    pub fn quantity(&mut self, name: &Name) -> Option<Atom> {
        // A mark without an index, as in `\dot{x}^+ = -r \dot{x}^-`, is said of the impact k.
        let unnumbered = name.subscript.is_empty() && matches!(name.mark.as_str(), "-" | "+");
        let index = if unnumbered {
            0
        } else {
            index_of(&name.subscript, &self.vocabulary.index)?
        };
        let bare = name.bare();
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
    pub(super) fn value(&mut self, name: &Name, time: Fraction) -> Result<Fraction, Meaningless> {
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
        // A state at the time of an impact, however that is written, is the state there.
        if self.vocabulary.states.contains(&function)
            && let Some(Atom::Time { index, .. }) = self.time_of_impact(&time)
        {
            let after = self.first == Some(index) && !self.vocabulary.continuous.contains(&function);
            return Ok(self.resolve(Atom::State {
                state: function,
                index,
                after,
            }));
        }
        let argument = self.meaning.reduced(&function, time);
        Ok(self.resolve(Atom::Value { function, argument }))
    }

    /// The impact that a time is the time of.
    fn time_of_impact(&self, time: &Fraction) -> Option<Atom> {
        let variable = *time.variables().first()?;
        let atom = self.atoms.atom(variable)?;
        (matches!(atom, Atom::Time { .. }) && *time == Fraction::variable(variable)).then(|| atom.clone())
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

    pub(super) fn is_function(&self, name: &Name) -> bool {
        let plain = Name {
            primes: 0,
            ..name.clone()
        };
        self.vocabulary.functions.iter().any(|(function, _)| *function == plain)
    }

    /// Whether this is a state, or a derivative of one, in flight.
    pub(super) fn is_motion(&self, name: &Name) -> bool {
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
    pub(super) fn time(&mut self, argument: &Tree) -> Result<Fraction, Meaningless> {
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
    pub(super) fn nested(&mut self, tree: &Tree) -> Result<Fraction, Meaningless> {
        self.tree(tree).map_err(|error| match error {
            EvaluationError::Scope { error, .. } => error,
            _ => Meaningless::Undefined(Undefined),
        })
    }

    pub(super) fn local(&mut self, name: &Name) -> Option<Result<Fraction, Meaningless>> {
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
    pub(super) fn opened(&mut self, name: &Name, tree: &Tree) -> Result<Fraction, Meaningless> {
        if self.open.contains(name) {
            return Err(Meaningless::Circular(name.to_string()));
        }
        self.open.push(name.clone());
        let result = self.nested(tree);
        self.open.pop();
        result
    }

    pub(super) fn unknown(&self, name: &Name) -> Meaningless {
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
