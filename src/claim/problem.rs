//! The premises of one claim, read, completed by what they imply, and solved.

use super::atom::{Atom, Atoms};
use super::jacobian::{Jacobians, differentiate};
use super::motion;
use super::premise::{Statement, Statements};
use super::reading::{Meaning, Meaningless, Reading};
use super::sheet::{Fault, Sheet};
use super::substitute::any_side;
use super::vocabulary::Vocabulary;
use crate::algebra::{self, Failure, Fraction, Polynomial, Rank, Step, Variable};
use crate::tex::{EvaluationError, Tree};
use num_traits::Zero;
use std::collections::BTreeSet;

/// An equation that holds, over quantities.
#[derive(Clone, Debug)]
pub struct Given {
    /// Where it comes from, for a reader: `(9)`, or `d(9)/d t_k` for what follows by differentiating.
    pub label: String,
    pub residual: Polynomial,
}

/// A claim with its premises solved.
pub struct Problem<'a> {
    pub vocabulary: &'a Vocabulary,
    pub atoms: Atoms,
    pub jacobians: Jacobians,
    pub statements: Statements,
    pub givens: Vec<Given>,
    /// Periods, and the values of quantities in terms of such as stay free at first: all that have simple ones.
    pub meaning: Meaning,
    /// What is solved after that, to be put in one after the other.
    pub late: Vec<Step>,
    /// What is known of times and periods alone.
    pub times: Meaning,
    /// Which given was solved for which quantity, in this order.
    pub steps: Vec<(usize, Variable)>,
    /// Squares of roots met, and values of roots whose sign is known.
    pub squares: Vec<(Variable, Fraction)>,
    pub roots: Vec<(Variable, Fraction)>,
    /// Laws of functions, with the premise each comes from.
    function_laws: Vec<(usize, Fraction)>,
    /// The residuals before times were solved for, with the premise each comes from.
    raw: Vec<(usize, Fraction)>,
    periods: Vec<(crate::tex::Name, Fraction)>,
}

impl<'a> Problem<'a> {
    /// Reads and solves the premises of the entry at `position` of the sheet.
    ///
    /// # Errors
    /// A [`Fault`]: an unknown symbol, premises that cannot be solved or contradict each other.
    pub fn new(sheet: &'a Sheet, position: usize) -> Result<Self, Fault> {
        let vocabulary = &sheet.vocabulary;
        let mut atoms = Atoms::new(&vocabulary.index);
        number_times(vocabulary, &mut atoms);
        let jacobians = Jacobians::new(vocabulary, &mut atoms).map_err(Fault::new)?;
        let statements = Statements::gather(sheet, position, &jacobians, &mut atoms)?;
        let mut problem = Self {
            vocabulary,
            atoms,
            jacobians,
            statements,
            givens: Vec::new(),
            meaning: Meaning::default(),
            late: Vec::new(),
            times: Meaning::default(),
            steps: Vec::new(),
            squares: Vec::new(),
            roots: Vec::new(),
            function_laws: Vec::new(),
            raw: Vec::new(),
            periods: Vec::new(),
        };
        problem.read_premises()?;
        problem.solve_times()?;
        problem.read_periods()?;
        problem.restrict()?;
        problem.solve()?;
        Ok(problem)
    }

    /// Reads formulas with all that is known.
    pub fn reading(&mut self) -> Reading<'_> {
        Reading::new(
            self.vocabulary,
            &self.jacobians,
            &mut self.atoms,
            &self.meaning,
            &self.statements.locals,
        )
    }

    /// Reads formulas with as much known as `meaning` says.
    pub fn reading_with<'b>(&'b mut self, meaning: &'b Meaning) -> Reading<'b> {
        Reading::new(
            self.vocabulary,
            &self.jacobians,
            &mut self.atoms,
            meaning,
            &self.statements.locals,
        )
    }

    fn raw_residual(&mut self, index: usize) -> Result<Fraction, Fault> {
        let statement = &self.statements.premises[index];
        let blank = Meaning::default();
        let mut reading = Reading::new(
            self.vocabulary,
            &self.jacobians,
            &mut self.atoms,
            &blank,
            &statement.locals,
        );
        reading.first = statement.first;
        statement.residual(&mut reading)
    }

    fn read_premises(&mut self) -> Result<(), Fault> {
        // What is said of derivatives is read last, when it is known whether the maps are given.
        let of_maps = |s: &Statement| any_side(&s.equation, &mut |node| matches!(node, Tree::Invariant { .. }));
        let (last, first): (Vec<usize>, Vec<usize>) =
            (0..self.statements.premises.len()).partition(|&n| of_maps(&self.statements.premises[n]));
        let mut laws = Vec::new();
        for index in first {
            let residual = self.raw_residual(index)?;
            self.sort_in(index, residual, &mut laws)?;
        }
        self.add_motion(&laws)?;
        let derived = self.add_derivatives()?;
        for index in last {
            let residual = self.raw_residual(index)?;
            self.sort_in(index, residual, &mut Vec::new())?;
        }
        self.function_laws = laws.into_iter().filter(|(_, law)| !self.is_motion(law)).collect();
        self.givens.extend(derived);
        Ok(())
    }

    /// Keeps an equation, or a law that holds at all times.
    fn sort_in(&mut self, index: usize, residual: Fraction, laws: &mut Vec<(usize, Fraction)>) -> Result<(), Fault> {
        if !self.runs(&residual) {
            self.raw.push((index, residual));
            return Ok(());
        }
        let blank = Meaning::default();
        let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
        match motion::period(&residual, &mut reading).map_err(|e| Fault::new(e.to_string()))? {
            Some(period) => self.periods.push(period),
            None => laws.push((index, residual)),
        }
        Ok(())
    }

    /// Whether the running time stands in a function.
    pub fn runs(&mut self, function: &Fraction) -> bool {
        let running = self.atoms.variable(Atom::Running);
        function.variables().iter().any(|&v| match self.atoms.atom(v) {
            Some(Atom::Value { argument: time, .. } | Atom::Circular { angle: time, .. }) => time.contains(running),
            _ => v == running,
        })
    }

    /// Whether a law says something of a state in flight.
    fn is_motion(&self, law: &Fraction) -> bool {
        let states = &self.vocabulary.states;
        law.variables().iter().any(|&v| match self.atoms.atom(v) {
            Some(Atom::Value { function, .. }) => states
                .iter()
                .any(|s| s == function || s.dotted() == *function || s.dotted().dotted() == *function),
            _ => false,
        })
    }

    /// Laws of flight: kept with the running time where the claim speaks of it, else taken at the next impact.
    fn add_motion(&mut self, laws: &[(usize, Fraction)]) -> Result<(), Fault> {
        let running = self.statements.claim_runs;
        let blank = Meaning::default();
        for (index, law) in laws {
            if !self.is_motion(law) {
                continue;
            }
            let statement = &self.statements.premises[*index];
            let start = statement.first.or(self.statements.first).unwrap_or(0);
            let mut reading = Reading::new(
                self.vocabulary,
                &self.jacobians,
                &mut self.atoms,
                &blank,
                &statement.locals,
            );
            let here = |error: Meaningless| statement.fault(0, error.to_string());
            for consequence in motion::consequences(law, start, &mut reading).map_err(here)? {
                let known = if running {
                    consequence
                } else {
                    motion::at_impact(&consequence, start + 1, false, &mut reading).map_err(here)?
                };
                self.raw.push((*index, known));
            }
        }
        Ok(())
    }

    /// Laws of functions: taken at every time at which any function is.
    fn add_function_laws(&mut self) -> Result<Vec<Given>, Fault> {
        let laws = std::mem::take(&mut self.function_laws);
        if laws.is_empty() {
            return Ok(Vec::new());
        }
        self.meet_claim();
        let running = self.atoms.variable(Atom::Running);
        let mut times: Vec<Fraction> = Vec::new();
        for variable in self.atoms.variables().collect::<Vec<_>>() {
            let Some(Atom::Value { argument, .. }) = self.atoms.atom(variable).cloned() else {
                continue;
            };
            let Ok(time) = self.meaning.restrict(&Fraction::variable(variable), &mut self.atoms) else {
                continue;
            };
            for variable in time.variables() {
                if let Some(Atom::Value { argument: time, .. }) = self.atoms.atom(variable)
                    && !argument.contains(running)
                    && !times.iter().any(|known| known.has_form_of(time))
                {
                    times.push(time.clone());
                }
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
        for (index, law) in laws {
            let statement = &self.statements.premises[index];
            let here = |error: Meaningless| statement.fault(0, error.to_string());
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            for residual in motion::of_functions(&law, &times, &turns, &mut reading).map_err(here)? {
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

    /// The premises differentiated, where derivatives are spoken of.
    fn add_derivatives(&mut self) -> Result<Vec<Given>, Fault> {
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
    fn map_premises(&self, step: &super::jacobian::Step, bound: &Meaning) -> Vec<(usize, Polynomial)> {
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

    fn explicit_equations(
        &mut self,
        name: &str,
        step: &super::jacobian::Step,
    ) -> Result<Vec<(usize, Polynomial)>, Fault> {
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

    fn is_pure(&self, variable: Variable) -> bool {
        matches!(self.atoms.atom(variable), Some(Atom::Time { .. } | Atom::Symbol(_)))
    }

    /// The equations between times and parameters alone.
    fn pure(&self) -> Vec<(usize, Polynomial)> {
        let all = self.raw.iter().enumerate();
        let pure = all.filter(|(_, (_, r))| r.numerator().variables().iter().all(|&v| self.is_pure(v)));
        pure.map(|(n, (_, r))| (n, r.numerator().clone())).collect()
    }

    /// Parameters in terms of the times of impacts, such as the period `T = t_{k+2} - t_k`.
    fn bound_times(&mut self) -> Result<Meaning, Fault> {
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
    fn solve_times(&mut self) -> Result<(), Fault> {
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

    /// The ranks of all quantities, looked up once: a search asks for them again and again.
    fn ranks(&self, rank: impl Fn(Variable) -> Rank) -> Vec<Rank> {
        self.atoms.variables().map(rank).collect()
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

    fn rank_of_symbol(&self, name: &crate::tex::Name) -> Rank {
        if name.base == r"\pi" {
            return Rank::Fixed;
        }
        match self.vocabulary.generic.iter().position(|known| known == name) {
            // Of two generic symbols the one declared later gives way.
            Some(position) => Rank::Generic(100_u32.saturating_sub(position as u32)),
            None => Rank::Ordinary(500),
        }
    }

    fn read_periods(&mut self) -> Result<(), Fault> {
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

    /// Rewrites all equations with the times as solved.
    fn restrict(&mut self) -> Result<(), Fault> {
        let mut restricted = Vec::new();
        for (index, residual) in std::mem::take(&mut self.raw) {
            let label = self.statements.label(index);
            let residual = self.meaning.restrict(&residual, &mut self.atoms);
            let residual = residual.map_err(|_| {
                Fault::new("with the other premises, a denominator in it is zero everywhere").of(&label)
            })?;
            restricted.push(Given {
                label,
                residual: residual.numerator().primitive(),
            });
        }
        for given in std::mem::take(&mut self.givens) {
            let function = self.meaning.restrict(&Fraction::from(given.residual), &mut self.atoms);
            let residual = function.map_err(|e| Fault::new(e.to_string()))?.numerator().primitive();
            restricted.push(Given { residual, ..given });
        }
        self.givens = restricted;
        let of_functions = self.add_function_laws()?;
        self.givens.extend(of_functions);
        let repeated = self.periodic_states();
        self.givens.extend(repeated);
        Ok(())
    }

    /// A state that repeats is the same at impacts whole periods apart.
    fn periodic_states(&mut self) -> Vec<Given> {
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

    fn solve(&mut self) -> Result<(), Fault> {
        let mut fixed = BTreeSet::new();
        for variable in self.atoms.variables() {
            if let Some(Atom::Value { argument: time, .. } | Atom::Circular { angle: time, .. }) =
                self.atoms.atom(variable)
            {
                fixed.extend(time.variables());
            }
        }
        let premises = self.givens.iter().enumerate();
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
    fn depth(&self, function: &crate::tex::Name) -> Option<u32> {
        let (_, derivative) = self.vocabulary.functions.iter().find(|(name, _)| name == function)?;
        match derivative {
            Some(Tree::Symbol(next, _)) if next != function => Some(1 + self.depth_below(next, 8)),
            _ => Some(0),
        }
    }

    fn depth_below(&self, function: &crate::tex::Name, left: u32) -> u32 {
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

    fn contradiction(&self, origins: &BTreeSet<usize>) -> Fault {
        let label = |&n: &usize| Some(format!("({})", self.statements.label(self.raw.get(n)?.0)));
        let labels: BTreeSet<String> = origins.iter().filter_map(label).collect();
        let labels = labels.into_iter().collect::<Vec<_>>().join(", ");
        Fault::new(format!(
            "its premises have no common solution: {labels} contradict each other"
        ))
    }
}

/// Values that hold none of the variables solved for.
fn back_substituted(steps: &[Step]) -> Result<std::collections::HashMap<Variable, Fraction>, Fault> {
    let mut known = Meaning::default();
    for step in steps.iter().rev() {
        let value = known.apply(&step.value).map_err(|e| Fault::new(e.to_string()))?;
        known.values.insert(step.variable, value);
    }
    Ok(known.values)
}

/// Numbers times and abbreviations before all else, the later ones higher: whole periods are taken off the highest.
fn number_times(vocabulary: &Vocabulary, atoms: &mut Atoms) {
    for family in &vocabulary.times {
        for index in 0..=3 {
            atoms.variable(Atom::Time {
                family: family.clone(),
                index,
            });
        }
    }
    for name in vocabulary
        .parameters
        .iter()
        .chain(vocabulary.abbreviations.iter().map(|(name, _)| name))
    {
        atoms.variable(Atom::Symbol(name.clone()));
    }
}
