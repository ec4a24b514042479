//! From trees to programs: every name is resolved once.

use super::course::Course;
use super::maps::Maps;
use super::program::Node;
use super::space::{Slot, Space};
use crate::claim::{Local, Vocabulary, index_of};
use crate::number::Rational;
use crate::tex::{Invariant, Name, Tree};

/// Why there is no witness: what is spoken of has no concrete form here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unwitnessed {
    /// A name without a meaning.
    #[error("`{0}` has no value here")]
    Unknown(String),
    /// A function that is no integral or derivative of one that is free.
    #[error("`{0}` is a function with a law of its own")]
    Law(String),
    /// A symbol defined by itself.
    #[error("`{0}` is defined by itself")]
    Circular(String),
    /// A derivative that no map has.
    #[error("no map gives the derivative of `{0}` by `{1}`")]
    NoMap(String, String),
    /// Premises of a kind that has no witness yet.
    #[error("{0}")]
    Kind(&'static str),
}

/// How many harmonics stand for any function: with the powers of time there are as many coefficients as values of a
/// function and two integrals at three times, or at two where it repeats.
const HARMONICS: usize = 3;
/// Powers of time in a flight: constants of integration, gravity, and one to spare.
const POWERS_OF_FLIGHT: usize = 4;
/// Powers of time that a function has where a premise says what it is: up to the square.
const POWERS_OF_LAW: usize = 2;

/// Turns trees into programs.
pub struct Compiler<'a> {
    pub vocabulary: &'a Vocabulary,
    pub space: &'a mut Space,
    pub maps: Option<&'a Maps>,
    pub locals: &'a [Local],
    /// The first impact of the equation: there a state without a mark, in a bracket, is the one just after.
    pub first: Option<i32>,
    /// The impact that the flight spoken of starts from.
    pub flight: i32,
    pub open: Vec<Name>,
}

impl Compiler<'_> {
    /// The program of a tree.
    pub fn tree(&mut self, tree: &Tree) -> Result<Node, Unwitnessed> {
        let boxed = |node| Box::new(node);
        Ok(match tree {
            Tree::Number(value) => number(value),
            Tree::Symbol(name, _) => self.symbol(name)?,
            Tree::Call(function, argument, _) => self.call(function, argument)?,
            Tree::Partial { of, by, .. } => self.partial(of, by)?,
            Tree::Invariant { kind, of, .. } => self.invariant(*kind, of)?,
            Tree::Negate(body) => Node::Negate(boxed(self.tree(body)?)),
            Tree::Sum(terms) => Node::Sum(self.trees(terms)?),
            Tree::Product(factors) => Node::Product(self.trees(factors)?),
            Tree::Quotient(above, below, _) => Node::Quotient(boxed(self.tree(above)?), boxed(self.tree(below)?)),
            Tree::Power(base, exponent, _) => Node::Power(boxed(self.tree(base)?), *exponent),
            Tree::Root(radicand, 2, _) => Node::Root(boxed(self.tree(radicand)?)),
            Tree::Root(..) => return Err(Unwitnessed::Kind("roots other than square roots have no witness yet")),
            Tree::RealPower(..) => {
                return Err(Unwitnessed::Kind(
                    "powers whose exponent is no integer have no witness yet",
                ));
            }
            Tree::PlusMinus(body) => Node::Signed(boxed(self.tree(body)?), true),
            Tree::MinusPlus(body) => Node::Signed(boxed(self.tree(body)?), false),
        })
    }

    fn trees(&mut self, trees: &[Tree]) -> Result<Vec<Node>, Unwitnessed> {
        trees.iter().map(|tree| self.tree(tree)).collect()
    }

    fn symbol(&mut self, name: &Name) -> Result<Node, Unwitnessed> {
        if let Some(local) = self.locals.iter().find(|local| local.name == *name) {
            if self.open.contains(name) {
                return Err(Unwitnessed::Circular(name.to_string()));
            }
            self.open.push(name.clone());
            let node = self.tree(&local.tree);
            self.open.pop();
            return node;
        }
        if self.vocabulary.parameters.contains(name) {
            return Ok(Node::Slot(self.space.slot(Slot::Parameter(name.clone()))));
        }
        if let Some((_, tree)) = self.vocabulary.abbreviations.iter().find(|(known, _)| known == name) {
            return self.tree(tree);
        }
        if let Some(slot) = self.quantity(name) {
            return Ok(Node::Slot(slot));
        }
        if self.vocabulary.running.as_ref() == Some(name) {
            return Ok(Node::Running);
        }
        if name.mark.is_empty()
            && let Ok((course, level)) = self.course(name)
        {
            return Ok(Node::Value {
                course,
                level,
                time: Box::new(Node::Running),
            });
        }
        match *name
            == (Name {
                base: r"\pi".to_string(),
                ..Name::default()
            }) {
            true => Ok(Node::Pi),
            false => Err(Unwitnessed::Unknown(name.to_string())),
        }
    }

    /// The slot of an indexed time or state.
    pub fn quantity(&mut self, name: &Name) -> Option<usize> {
        let (bare, index) = (bare(name), index_of(&name.subscript, &self.vocabulary.index)?);
        if name.primes > 0 {
            return None;
        }
        if name.mark.is_empty() && self.vocabulary.times.contains(&bare) {
            return Some(self.space.slot(Slot::Time { family: bare, index }));
        }
        if !self.vocabulary.states.contains(&bare) || !matches!(name.mark.as_str(), "" | "-" | "+") {
            return None;
        }
        Some(self.state(bare, index, name.mark == "+"))
    }

    /// The slot of a state; one that an impact does not change is the same before and after.
    pub fn state(&mut self, state: Name, index: i32, after: bool) -> usize {
        let after = after && !self.vocabulary.continuous.contains(&state);
        self.space.slot(Slot::State { state, index, after })
    }

    /// The time of an impact.
    pub fn time(&mut self, index: i32) -> usize {
        let family = self.vocabulary.times.first().cloned().unwrap_or_default();
        self.space.slot(Slot::Time { family, index })
    }

    fn call(&mut self, function: &Name, argument: &Tree) -> Result<Node, Unwitnessed> {
        let state = bare(function);
        if function.primes == 0
            && self.vocabulary.states.contains(&state)
            && let Tree::Symbol(time, _) = argument
            && self.vocabulary.times.contains(&bare(time))
            && let Some(index) = index_of(&time.subscript, &self.vocabulary.index)
        {
            let departs = function.mark == "+" || (function.mark.is_empty() && self.first == Some(index));
            return Ok(Node::Slot(self.state(state, index, departs)));
        }
        if !function.mark.is_empty() {
            return Err(Unwitnessed::Unknown(function.to_string()));
        }
        let (course, level) = self.course(function)?;
        let time = Box::new(self.tree(argument)?);
        Ok(Node::Value { course, level, time })
    }

    /// The course of a function or of a state in flight, and how many derivatives below the highest integral.
    fn course(&mut self, name: &Name) -> Result<(usize, usize), Unwitnessed> {
        let (plain, primes) = (
            Name {
                primes: 0,
                ..name.clone()
            },
            usize::from(name.primes),
        );
        if let Some(names) = self.motion(&plain) {
            let level = names.iter().position(|known| *known == plain).unwrap_or(0);
            let flight = Some(self.flight);
            return Ok((self.known_course(names, flight), level + primes));
        }
        let names = self.chain(&plain)?;
        let level = names.iter().position(|known| *known == plain).unwrap_or(0);
        Ok((self.known_course(names, None), level + primes))
    }

    fn known_course(&mut self, names: Vec<Name>, flight: Option<i32>) -> usize {
        let same = |course: &Course| course.flight == flight && course.names == names;
        if let Some(known) = self.space.courses.iter().position(same) {
            return known;
        }
        // Without functions a flight is moved by gravity alone.
        let powers = match flight {
            Some(_) => POWERS_OF_FLIGHT,
            None => names.len() + POWERS_OF_LAW,
        };
        let harmonics = if flight.is_some() && self.vocabulary.functions.is_empty() {
            0
        } else {
            HARMONICS
        };
        self.space.add_course(Course {
            names,
            flight,
            first: 0,
            powers,
            harmonics,
            period: None,
        })
    }

    /// A state with its derivatives: position, velocity, acceleration.
    fn motion(&self, name: &Name) -> Option<Vec<Name>> {
        let states = &self.vocabulary.states;
        let lowest = states
            .iter()
            .filter(|s| !states.iter().any(|other| dotted(other) == **s));
        lowest
            .map(|s| vec![s.clone(), dotted(s), dotted(&dotted(s))])
            .find(|names| names.contains(name))
    }

    /// A function with the integrals and derivatives that have names, from the highest integral down.
    fn chain(&self, name: &Name) -> Result<Vec<Name>, Unwitnessed> {
        let functions = &self.vocabulary.functions;
        let below = |name: &Name| functions.iter().find(|(known, _)| known == name).map(|(_, tree)| tree);
        if below(name).is_none() {
            return Err(Unwitnessed::Unknown(name.to_string()));
        }
        let mut names = vec![name.clone()];
        while names.len() <= functions.len() {
            let Some(first) = names.first().cloned() else { break };
            let is = |tree: &Option<Tree>| matches!(tree, Some(Tree::Symbol(known, _)) if *known == first);
            let mut above = functions.iter().filter(|(_, tree)| is(tree)).map(|(above, _)| above);
            match (above.next(), above.next()) {
                (Some(above), None) => names.insert(0, above.clone()),
                (None, _) => break,
                _ => return Err(Unwitnessed::Law(first.to_string())),
            }
        }
        while let Some(Some(tree)) = names.last().and_then(below) {
            match tree {
                Tree::Symbol(next, _) if below(next).is_some() && !names.contains(next) => names.push(next.clone()),
                _ => return Err(Unwitnessed::Law(name.to_string())),
            }
        }
        Ok(names)
    }

    fn partial(&mut self, of: &Name, by: &Name) -> Result<Node, Unwitnessed> {
        let none = || Unwitnessed::NoMap(of.to_string(), by.to_string());
        let (Some(above), Some(below)) = (self.quantity(of), self.quantity(by)) else {
            return Err(none());
        };
        let maps = self.maps.ok_or_else(none)?;
        maps.entry(above, below, self.space).ok_or_else(none)
    }

    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<Node, Unwitnessed> {
        let unknown = || Unwitnessed::Unknown(of.to_string());
        let maps = self.maps.ok_or_else(unknown)?;
        if maps.opaque {
            return Ok(Node::Slot(self.space.slot(Slot::Invariant { kind, of: of.clone() })));
        }
        maps.invariant(kind, of, self.space).ok_or_else(unknown)
    }
}

fn number(value: &Rational) -> Node {
    let part = |part: &str| part.parse::<i64>().ok();
    let text = value.to_string();
    let (above, below) = text.split_once('/').unwrap_or((&text, "1"));
    match (part(above), part(below)) {
        (Some(above), Some(below)) => Node::Number(above, below),
        _ => Node::Float(value.embed().unwrap_or(f64::NAN)),
    }
}

/// The name without subscript, mark and primes.
pub fn bare(name: &Name) -> Name {
    Name {
        base: name.base.clone(),
        accents: name.accents.clone(),
        ..Name::default()
    }
}

/// The name of the derivative by time: one dot more.
fn dotted(name: &Name) -> Name {
    let mut name = name.clone();
    match name.accents.last_mut() {
        Some(last) if last == r"\dot" => *last = r"\ddot".to_string(),
        Some(last) if last == r"\ddot" => *last = r"\dddot".to_string(),
        _ => name.accents.push(r"\dot".to_string()),
    }
    name
}
