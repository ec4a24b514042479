//! Premises that give a function at every time.

use super::atom::Atom;
use super::fault::Fault;
use super::meaning::Meaning;
use super::motion;
use super::problem::{Given, Problem};
use super::reading::{Meaningless, Reading};
use crate::algebra::Fraction;

/// Steps by which a law is followed from the times that a sheet speaks of.
const MOST_SHIFTS: usize = 3;

impl Problem<'_> {
    /// Laws of functions: taken at every time at which any function is.
    pub(super) fn add_function_laws(&mut self) -> Result<Vec<Given>, Fault> {
        let laws = std::mem::take(&mut self.function_laws);
        if laws.is_empty() {
            return Ok(Vec::new());
        }
        self.meet_claim();
        let mut times = self.times_met();
        // A law may lead from the times met to others, as `f(t + T/2) = -f(t)` does, and from these back.
        for _ in 0..MOST_SHIFTS {
            let before = times.len();
            for (_, law) in &laws {
                times.extend(self.times_led_to(law, &times));
            }
            let mut distinct: Vec<Fraction> = Vec::new();
            for time in times {
                if !distinct.iter().any(|known| known.has_form_of(&time)) {
                    distinct.push(time);
                }
            }
            times = distinct;
            if times.len() == before {
                break;
            }
        }
        // A period in other symbols would make a relation between angles that has no rational solution.
        let mut turns: Vec<Fraction> = Vec::new();
        for (_, period) in &self.meaning.periods {
            if period.as_constant().is_some() && !turns.contains(period) {
                turns.push(period.clone());
            }
        }
        let blank = Meaning::default();
        let mut known = Vec::new();
        for (index, law) in &laws {
            let statement = &self.statements.premises[*index];
            let here = |error: Meaningless| statement.fault(0, error.to_string());
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            for residual in motion::of_functions(law, &times, &turns, &mut reading).map_err(here)? {
                let restricted = self.meaning.restrict(&residual, &mut self.atoms);
                let residual = restricted.map_err(|error| here(error.into()))?.numerator().primitive();
                known.push(Given {
                    label: statement.label.clone(),
                    residual,
                });
            }
        }
        Ok(known)
    }

    /// The times at which functions are taken, as far as these have been read.
    fn times_met(&mut self) -> Vec<Fraction> {
        let running = self.atoms.variable(Atom::Running);
        let mut times: Vec<Fraction> = Vec::new();
        for variable in self.atoms.variables() {
            let Some(Atom::Value { argument, .. }) = self.atoms.atom(variable).cloned() else {
                continue;
            };
            let Ok(value) = self.meaning.restrict(&Fraction::variable(variable), &mut self.atoms) else {
                continue;
            };
            for variable in value.variables() {
                if let Some(Atom::Value { argument: time, .. }) = self.atoms.atom(variable)
                    && !argument.contains(running)
                    && !times.iter().any(|known| known.has_form_of(time))
                {
                    times.push(time.clone());
                }
            }
        }
        times
    }

    /// The times that a law speaks of when it is taken at `times`.
    fn times_led_to(&mut self, law: &Fraction, times: &[Fraction]) -> Vec<Fraction> {
        let running = self.atoms.variable(Atom::Running);
        let mut found = Vec::new();
        for variable in law.variables() {
            let Some(Atom::Value { function, argument }) = self.atoms.atom(variable).cloned() else {
                continue;
            };
            for time in times {
                let moved = argument
                    .substituted(running, time)
                    .and_then(|t| self.meaning.restrict(&t, &mut self.atoms));
                found.extend(moved.map(|time| self.meaning.reduced(&function, time)));
            }
        }
        found
    }

    /// Reads the claim once, so that the times it speaks of are known.
    fn meet_claim(&mut self) {
        for equation in self.statements.claims.clone() {
            let mut reading = self.reading();
            reading.upper = Some(true);
            for side in [&equation.left, &equation.right] {
                // What is wrong with the claim is said when it is decided.
                let _ = reading.tree(side);
            }
        }
    }
}
