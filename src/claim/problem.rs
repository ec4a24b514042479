//! The premises of one claim, read, completed by what they imply, and solved.

use super::atom::{Atom, Atoms};
use super::fault::Fault;
use super::jacobian::Jacobians;
use super::meaning::Meaning;
use super::motion;
use super::premise::{Statement, Statements};
use super::reading::{Meaningless, Reading};
use super::sheet::Sheet;
use super::substitute::any_side;
use super::vocabulary::Vocabulary;
use crate::algebra::{Fraction, Polynomial, Step, Variable};
use crate::tex::Tree;

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
    /// The quantities among which roots were looked for.
    pub atoms_met: usize,
    pub roots: Vec<(Variable, Fraction)>,
    /// Laws of functions, with the premise each comes from.
    pub(super) function_laws: Vec<(usize, Fraction)>,
    /// The residuals before times were solved for, with the premise each comes from.
    pub(super) raw: Vec<(usize, Fraction)>,
    pub(super) periods: Vec<(crate::tex::Name, Fraction)>,
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
            atoms_met: 0,
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
            let residual = self.without_flights(residual);
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

    /// The residual without factors that are mere abbreviations, such as the time of a flight: these are not zero,
    /// and would make the premise speak of impacts that it says nothing of.
    fn without_flights(&mut self, residual: Fraction) -> Fraction {
        let blank = Meaning::default();
        let mut above = residual.numerator().clone();
        for (_, tree) in &self.vocabulary.abbreviations {
            let mut reading = Reading::new(self.vocabulary, &self.jacobians, &mut self.atoms, &blank, &[]);
            let Ok(value) = reading.tree(tree) else { continue };
            while !above.is_zero()
                && value.numerator().as_constant().is_none()
                && above.variables().len() > value.variables().len()
                && let Some(quotient) = above.exact_quotient(value.numerator())
            {
                above = quotient;
            }
        }
        if above == *residual.numerator() {
            residual
        } else {
            Fraction::from(above)
        }
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
            let start = statement.first.unwrap_or(0);
            let mut reading = Reading::new(
                self.vocabulary,
                &self.jacobians,
                &mut self.atoms,
                &blank,
                &statement.locals,
            );
            let here = |error: Meaningless| statement.fault(0, error.to_string());
            for consequence in motion::consequences(law, start, &mut reading).map_err(here)? {
                if running {
                    self.raw.push((*index, consequence));
                    continue;
                }
                for (impact, departs) in [(start + 1, false), (start, true)] {
                    let known = motion::at_impact(&consequence, impact, departs, &mut reading).map_err(here)?;
                    self.raw.push((*index, known));
                }
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
