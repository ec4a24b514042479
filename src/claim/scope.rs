//! What the names of a formula stand for, as the evaluation of its tree asks for them.

use super::angle;
use super::atom::Atom;
use super::reading::{Meaningless, Reading};
use crate::algebra::{Fraction, Undefined, Variable};
use crate::number::Rational;
use crate::tex::{Invariant, Name, Scope, Tree};
use num_traits::Zero;

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

    fn root(&mut self, radicand: Fraction, index: u32) -> Result<Fraction, Meaningless> {
        if index != 2 {
            return Err(crate::tex::Unsupported::Root.into());
        }
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

impl Reading<'_> {
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
}
