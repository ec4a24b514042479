//! The premises of a claim differentiated, where it speaks of derivatives.

use super::atom::Atom;
use super::fault::Fault;
use super::jacobian::{Step, differentiate};
use super::meaning::Meaning;
use super::problem::{Given, Problem};
use super::reading::{Meaningless, Reading};
use crate::algebra::{Fraction, Polynomial, Variable};
use crate::tex::EvaluationError;
use std::collections::BTreeSet;

impl Problem<'_> {
    /// The premises differentiated, where derivatives are spoken of.
    pub(super) fn add_derivatives(&mut self) -> Result<Vec<Given>, Fault> {
        let mut derived = Vec::new();
        if !self.statements.speaks_of_maps {
            return Ok(derived);
        }
        let bound = self.bound_times()?;
        let steps: Vec<_> = self
            .jacobians
            .steps()
            .map(|(name, step)| (name.clone(), step.clone()))
            .collect();
        let mut silent = true;
        for (name, step) in steps {
            let residuals = if step.equations.is_empty() {
                self.map_premises(&step, &bound)
            } else {
                self.explicit_equations(&name.to_string(), &step)?
            };
            silent &= residuals.is_empty();
            let blank = Meaning::default();
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            let found = differentiate(&step, &residuals, &mut reading).map_err(|e| Fault::new(e.to_string()))?;
            for equation in found {
                let label = match self.statements.premises.get(equation.premise) {
                    Some(statement) => statement.label.clone(),
                    None => name.to_string(),
                };
                let label = format!(r"\partial({label})/\partial {}", self.atoms.show(equation.by));
                derived.push(Given {
                    label,
                    residual: equation.residual,
                });
            }
        }
        self.jacobians.opaque = silent && !self.statements.has_partials;
        Ok(derived)
    }

    /// The premises that speak of the impacts of one step alone.
    fn map_premises(&self, step: &Step, bound: &Meaning) -> Vec<(usize, Polynomial)> {
        let impacts = |variables: &[Variable]| -> BTreeSet<i32> {
            variables.iter().flat_map(|&v| self.impacts_of(v, bound, 0)).collect()
        };
        let of_step: BTreeSet<i32> = impacts(&step.of).union(&impacts(&step.by)).copied().collect();
        let fits = |residual: &Fraction| {
            let variables: Vec<Variable> = residual.numerator().variables().into_iter().collect();
            let is_pure = variables.iter().all(|&v| self.is_pure(v));
            let speaks = variables.iter().any(|&v| {
                let moved = match self.atoms.atom(v) {
                    Some(Atom::Value { argument, .. }) => argument.variables().iter().any(|a| !step.by.contains(a)),
                    Some(Atom::Time { .. } | Atom::State { .. }) => !step.by.contains(&v),
                    _ => false,
                };
                moved && !self.impacts_of(v, bound, 0).is_empty()
            });
            let of_maps = variables
                .iter()
                .any(|&v| matches!(self.atoms.atom(v), Some(Atom::Partial { .. } | Atom::Invariant { .. })));
            !is_pure && !of_maps && speaks && impacts(&variables).is_subset(&of_step)
        };
        let fitting = self.raw.iter().filter(|(_, residual)| fits(residual));
        fitting
            .map(|(index, residual)| (*index, residual.numerator().clone()))
            .collect()
    }

    fn explicit_equations(&mut self, name: &str, step: &Step) -> Result<Vec<(usize, Polynomial)>, Fault> {
        let blank = Meaning::default();
        let mut residuals = Vec::new();
        for equation in &step.equations {
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            let unreadable = |error: EvaluationError<Meaningless>| {
                Fault::new(format!(
                    "the equations of the map `{name}`: {}",
                    super::premise::message(&error)
                ))
            };
            let left = reading.tree(&equation.left).map_err(unreadable)?;
            let residual = left - reading.tree(&equation.right).map_err(unreadable)?;
            residuals.push((usize::MAX, residual.numerator().clone()));
            self.givens.push(Given {
                label: name.to_string(),
                residual: residual.numerator().clone(),
            });
        }
        Ok(residuals)
    }

    /// The impacts that a quantity belongs to.
    fn impacts_of(&self, variable: Variable, bound: &Meaning, depth: usize) -> BTreeSet<i32> {
        let inside = |f: &Fraction| -> BTreeSet<i32> {
            f.variables()
                .into_iter()
                .flat_map(|v| self.impacts_of(v, bound, depth + 1))
                .collect()
        };
        match self.atoms.atom(variable) {
            _ if depth > 8 => BTreeSet::new(),
            Some(Atom::Time { index, .. } | Atom::State { index, .. }) => BTreeSet::from([*index]),
            Some(Atom::Value { argument: time, .. } | Atom::Circular { angle: time, .. }) => inside(time),
            Some(Atom::Symbol(_)) => bound.values.get(&variable).map(inside).unwrap_or_default(),
            _ => BTreeSet::new(),
        }
    }
}
