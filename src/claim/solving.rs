//! The premises of a claim solved one after the other.

use super::atom::Atom;
use super::fault::Fault;
use super::meaning::Meaning;
use super::premise::pair_of;
use super::problem::Problem;
use crate::algebra::{self, Failure, Fraction, Rank, Step, Variable};
use crate::tex::{Name, Tree};
use std::collections::{BTreeSet, HashMap};

impl Problem<'_> {
    pub(super) fn solve(&mut self) -> Result<(), Fault> {
        let mut fixed = BTreeSet::new();
        for variable in self.atoms.variables() {
            if let Some(Atom::Value { argument: time, .. } | Atom::Circular { angle: time, .. }) =
                self.atoms.atom(variable)
            {
                fixed.extend(time.variables());
            }
        }
        let pair = self.pair();
        let premises = self.givens.iter().enumerate();
        // What the two roots of an equation are is asked of the equation, not of one root.
        let premises = premises.filter(|(_, given)| pair.is_none_or(|pair| given.residual.degree(pair) < 2));
        let premises = premises.map(|(origin, given)| algebra::Premise {
            residual: given.residual.clone(),
            origin,
        });
        let ranks = self.ranks(|v| if fixed.contains(&v) { Rank::Fixed } else { self.rank(v) });
        let rank = |v: Variable| ranks.get(v.0 as usize).copied().unwrap_or(Rank::Fixed);
        let solution = algebra::solve(premises.collect(), &rank).map_err(|failure| match failure {
            Failure::Contradiction(origins) => self.contradiction_of(&origins),
            Failure::Nonlinear(origins) => {
                let labels = self.labels(&origins);
                Fault::new(format!(
                    "the premises cannot be solved one after the other: {labels} cannot be solved linearly for a symbol"
                ))
            }
        })?;
        let simple = |step: &Step| {
            step.value.factors().is_empty() || matches!(self.atoms.atom(step.variable), Some(Atom::Partial { .. }))
        };
        let early = solution.steps.iter().take_while(|step| simple(step)).count();
        let (early, late) = solution.steps.split_at(early);
        let mut values = back_substituted(early)?;
        // What was solved of times speaks of parameters that may have been solved since.
        let known = Meaning {
            values: values.clone(),
            periods: Vec::new(),
        };
        for (variable, value) in &self.meaning.values {
            values.insert(*variable, known.apply(value).map_err(|e| Fault::new(e.to_string()))?);
        }
        self.late = late.to_vec();
        let periods = self.meaning.periods.clone();
        self.times = std::mem::replace(&mut self.meaning, Meaning { values, periods });
        self.steps = solution.steps.iter().map(|step| (step.origin, step.variable)).collect();
        Ok(())
    }

    /// The square of a quantity by the relations of the vocabulary.
    pub fn relation(&mut self, atom: &Atom) -> Option<Fraction> {
        let name = match atom {
            Atom::Symbol(name) => name,
            Atom::Value { function, .. } => function,
            _ => return None,
        };
        let relation = self.vocabulary.relations.iter().find(|equation| match &equation.left {
            Tree::Power(base, 2, _) => match base.as_ref() {
                Tree::Symbol(known, _) | Tree::Call(known, ..) => known == name,
                _ => false,
            },
            _ => false,
        })?;
        let mut reading = self.reading();
        match atom {
            Atom::Value { argument, .. } => reading.at_time(&relation.right, argument.clone()).ok(),
            _ => reading.tree(&relation.right).ok(),
        }
    }

    /// The symbol whose two values the claim gives, as `\lambda` in `\lambda_{1,2} = ...`.
    pub(super) fn pair(&self) -> Option<Variable> {
        let names = self
            .statements
            .claims
            .iter()
            .filter_map(|equation| match &equation.left {
                Tree::Symbol(name, _) => pair_of(name),
                _ => None,
            });
        let names: Vec<Name> = names.collect();
        self.atoms
            .variables()
            .find(|&v| matches!(self.atoms.atom(v), Some(Atom::Symbol(name)) if names.contains(name)))
    }

    fn rank(&self, variable: Variable) -> Rank {
        match self.atoms.atom(variable) {
            Some(Atom::Value { function, .. }) => Rank::Ordinary(match self.depth(function) {
                Some(depth) => 10 - depth.min(10),
                None => 20,
            }),
            Some(Atom::Partial { .. }) => Rank::Dependent(30),
            Some(Atom::Invariant { .. }) => Rank::Dependent(40),
            Some(Atom::State { index, after, .. }) => {
                Rank::Ordinary(if *after { 50 } else { (100 - index).max(60) as u32 })
            }
            Some(Atom::Symbol(name)) => self.rank_of_symbol(name),
            _ => Rank::Fixed,
        }
    }

    /// How often a function can be differentiated by name.
    fn depth(&self, function: &Name) -> Option<u32> {
        let (_, derivative) = self.vocabulary.functions.iter().find(|(name, _)| name == function)?;
        match derivative {
            Some(Tree::Symbol(next, _)) if next != function => Some(1 + self.depth_below(next, 8)),
            _ => Some(0),
        }
    }

    fn depth_below(&self, function: &Name, left: u32) -> u32 {
        let found = self.vocabulary.functions.iter().find(|(name, _)| name == function);
        match found {
            Some((_, Some(Tree::Symbol(next, _)))) if left > 0 => 1 + self.depth_below(next, left - 1),
            _ => 0,
        }
    }

    fn labels(&self, origins: &BTreeSet<usize>) -> String {
        let labels: BTreeSet<String> = origins
            .iter()
            .filter_map(|&n| Some(self.givens.get(n)?.label.clone()))
            .collect();
        labels
            .iter()
            .map(|label| format!("({label})"))
            .collect::<Vec<_>>()
            .join(", ")
    }

    fn contradiction_of(&self, origins: &BTreeSet<usize>) -> Fault {
        Fault::new(format!(
            "its premises have no common solution: {} contradict each other",
            self.labels(origins)
        ))
    }

    /// The ranks of all quantities, looked up once: a search asks for them again and again.
    pub(super) fn ranks(&self, rank: impl Fn(Variable) -> Rank) -> Vec<Rank> {
        self.atoms.variables().map(rank).collect()
    }

    pub(super) fn rank_of_symbol(&self, name: &Name) -> Rank {
        if name.base == r"\pi" {
            return Rank::Fixed;
        }
        match self.vocabulary.generic.iter().position(|known| known == name) {
            // Of two generic symbols the one declared later gives way.
            Some(position) => Rank::Generic(100_u32.saturating_sub(position as u32)),
            None => Rank::Ordinary(500),
        }
    }
}

/// Values that hold none of the variables solved for.
pub fn back_substituted(steps: &[Step]) -> Result<HashMap<Variable, Fraction>, Fault> {
    let mut known = Meaning::default();
    for step in steps.iter().rev() {
        let value = known.apply(&step.value).map_err(|e| Fault::new(e.to_string()))?;
        known.values.insert(step.variable, value);
    }
    Ok(known.values)
}
