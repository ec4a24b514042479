//! Times and parameters: what is said of them alone is solved first, for functions are taken at times.

use super::atom::Atom;
use super::fault::Fault;
use super::meaning::Meaning;
use super::problem::{Given, Problem};
use super::reading::Reading;
use super::solving::back_substituted;
use crate::algebra::{self, Failure, Fraction, Polynomial, Rank, Variable};
use crate::tex::Tree;
use num_traits::Zero;
use std::collections::BTreeSet;

impl Problem<'_> {
    pub(super) fn is_pure(&self, variable: Variable) -> bool {
        matches!(self.atoms.atom(variable), Some(Atom::Time { .. } | Atom::Symbol(_)))
    }

    /// The equations between times and parameters alone.
    fn pure(&self) -> Vec<(usize, Polynomial)> {
        let all = self.raw.iter().enumerate();
        let pure = all.filter(|(_, (_, r))| r.numerator().variables().iter().all(|&v| self.is_pure(v)));
        pure.map(|(n, (_, r))| (n, r.numerator().clone())).collect()
    }

    /// Parameters in terms of the times of impacts, such as the period `T = t_{k+2} - t_k`.
    pub(super) fn bound_times(&mut self) -> Result<Meaning, Fault> {
        let rank = |v: Variable| match self.atoms.atom(v) {
            Some(Atom::Symbol(_)) => Rank::Ordinary(0),
            _ => Rank::Fixed,
        };
        let with_times = self.pure().into_iter().filter(|(_, residual)| {
            residual
                .variables()
                .iter()
                .any(|&v| matches!(self.atoms.atom(v), Some(Atom::Time { .. })))
        });
        let premises = with_times
            .map(|(origin, residual)| algebra::Premise { residual, origin })
            .collect();
        let steps = algebra::solve(premises, &rank)
            .map(|solution| solution.steps)
            .unwrap_or_default();
        Ok(Meaning {
            values: back_substituted(&steps)?,
            periods: Vec::new(),
        })
    }

    /// Solves what is said of times and parameters alone, so that the times at which functions are taken are known.
    pub(super) fn solve_times(&mut self) -> Result<(), Fault> {
        let blank = Meaning::default();
        let mut premises = Vec::new();
        for (name, tree) in &self.vocabulary.abbreviations {
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            let value = reading
                .tree(tree)
                .map_err(|error| Fault::new(super::premise::message(&error)))?;
            let short = Fraction::variable(self.atoms.variable(Atom::Symbol(name.clone())));
            premises.push(algebra::Premise {
                residual: (short - value).numerator().clone(),
                origin: usize::MAX,
            });
        }
        let known = premises.len();
        for (origin, residual) in self.pure() {
            premises.push(algebra::Premise { residual, origin });
        }
        let ranks = self.ranks(|v| self.rank_of_time(v));
        let rank = |v: Variable| ranks.get(v.0 as usize).copied().unwrap_or(Rank::Fixed);
        let mut left_over = BTreeSet::new();
        let solution = loop {
            let now = premises
                .iter()
                .filter(|p| !left_over.contains(&p.origin))
                .cloned()
                .collect();
            match algebra::solve(now, &rank) {
                Ok(solution) => break solution,
                Err(Failure::Contradiction(origins)) => return Err(self.contradiction(&origins)),
                // What is not linear may become so when the other premises are used.
                Err(Failure::Nonlinear(origins)) if origins.iter().any(|o| *o != usize::MAX) => {
                    left_over.extend(origins.into_iter().filter(|o| *o != usize::MAX));
                }
                Err(Failure::Nonlinear(_)) => {
                    return Err(Fault::new(
                        "the abbreviations of [symbols] cannot be solved for the times in them",
                    ));
                }
            }
        };
        self.meaning.values = back_substituted(&solution.steps)?;
        let used: BTreeSet<usize> = solution
            .steps
            .iter()
            .map(|s| s.origin)
            .chain(solution.redundant)
            .collect();
        for premise in premises.iter().skip(known).filter(|p| used.contains(&p.origin)) {
            let label = self.statements.label(self.raw[premise.origin].0);
            self.givens.push(Given {
                label,
                residual: premise.residual.clone(),
            });
        }
        let mut position = 0;
        self.raw.retain(|_| {
            position += 1;
            !used.contains(&(position - 1))
        });
        Ok(())
    }

    fn rank_of_time(&self, variable: Variable) -> Rank {
        match self.atoms.atom(variable) {
            // The first impact's time stays, the others follow from it, the later ones sooner.
            Some(Atom::Time { index, .. }) if Some(*index) != self.statements.first.or(Some(0)) => {
                Rank::Ordinary((100 - index).max(0) as u32)
            }
            Some(Atom::Time { .. }) => Rank::Generic(1000),
            Some(Atom::Symbol(name)) => self.rank_of_symbol(name),
            _ => Rank::Fixed,
        }
    }

    pub(super) fn read_periods(&mut self) -> Result<(), Fault> {
        let blank = Meaning::default();
        let mut periods = std::mem::take(&mut self.periods);
        for (name, tree) in &self.vocabulary.periods {
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            let period = reading
                .tree(tree)
                .map_err(|error| Fault::new(super::premise::message(&error)))?;
            periods.push((name.clone(), period));
        }
        let mut next = 0;
        // The derivative of a function repeats with it.
        while let Some((name, period)) = periods.get(next).cloned() {
            let declared = self.vocabulary.functions.iter().find(|(function, _)| *function == name);
            let derivative = match declared {
                Some((_, Some(Tree::Symbol(name, _)))) => Some(name.clone()),
                Some(_) => None,
                None if self.vocabulary.states.contains(&name.dotted()) => Some(name.dotted()),
                None => None,
            };
            if let Some(derivative) = derivative.filter(|d| !periods.iter().any(|(name, _)| name == d)) {
                periods.push((derivative, period.clone()));
            }
            next += 1;
        }
        for (name, period) in periods {
            let period = self
                .meaning
                .restrict(&period, &mut self.atoms)
                .map_err(|e| Fault::new(e.to_string()))?;
            if !period.is_zero() && !self.meaning.periods.iter().any(|(known, _)| *known == name) {
                self.meaning.periods.push((name, period));
            }
        }
        Ok(())
    }

    /// A state that repeats is the same at impacts whole periods apart.
    pub(super) fn periodic_states(&mut self) -> Vec<Given> {
        let mut equal = Vec::new();
        let families = self.vocabulary.times.first().cloned();
        let Some(family) = families else { return equal };
        for (state, _) in self.meaning.periods.clone() {
            if !self.vocabulary.states.contains(&state) {
                continue;
            }
            for index in 1..=3 {
                let [early, late] = [0, index].map(|index| {
                    let time = self.atoms.variable(Atom::Time {
                        family: family.clone(),
                        index,
                    });
                    let time = self
                        .meaning
                        .values
                        .get(&time)
                        .cloned()
                        .unwrap_or_else(|| Fraction::variable(time));
                    self.meaning.reduced(&state, time)
                });
                if early.has_form_of(&late) {
                    let [a, b] = [0, index].map(|index| {
                        self.atoms.variable(Atom::State {
                            state: state.clone(),
                            index,
                            after: false,
                        })
                    });
                    let residual = Polynomial::variable(a).minus(&Polynomial::variable(b));
                    equal.push(Given {
                        label: format!("the period of {state}"),
                        residual,
                    });
                }
            }
        }
        equal
    }

    fn contradiction(&self, origins: &BTreeSet<usize>) -> Fault {
        let label = |&n: &usize| Some(format!("({})", self.statements.label(self.raw.get(n)?.0)));
        let labels: BTreeSet<String> = origins.iter().filter_map(label).collect();
        let labels = labels.into_iter().collect::<Vec<_>>().join(", ");
        Fault::new(format!(
            "its premises have no common solution: {labels} contradict each other"
        ))
    }
}
