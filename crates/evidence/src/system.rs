//! The premises of a claim as equations over slots, and the claim as questions.

use super::compiler::{Compiler, Unwitnessed};
use super::domain::{self, Condition, Kind};
use super::formula::{Formula, Formulas, Op, Program, Work};
use super::index::{index_runs, member};
use super::maps::{Maps, Step};
use super::space::{Slot, Space};
use super::stated_maps::read_maps;
use super::value::Function;
use claims::{Local, Premise, Statements};
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use texmath::{
    At, Condition as Assumption, Equation, Invariant, Name, Operation, Relation, Symbols, Tree, any_side, flies,
    tree_runs,
};

/// An equation of the claim.
#[derive(Clone, Debug)]
pub struct Question {
    /// The two sides, under the upper sign and, where there is one, under the lower.
    pub sides: Vec<[Formula; 2]>,
    pub relation: Relation,
    /// The slot of a symbol whose two values are meant, as in `\lambda_{1,2}`.
    pub pair: Option<usize>,
    pub program: Program,
}

/// Which forcing stands for a function that no premise gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forcing {
    /// One of many harmonics, for any function.
    Any,
    /// cos(pi t + phi).
    Cosine,
}

/// The rows of a map, in the order in which they are asked, and the slots that move in all and in each of them.
#[derive(Debug)]
pub struct StepRows {
    pub(super) all: Vec<usize>,
    pub(super) each: Vec<Vec<usize>>,
    pub(super) program: Program,
}

/// All that bears on one claim, over slots.
#[derive(Debug)]
pub struct System {
    pub space: Space,
    pub formulas: Formulas,
    pub maps: Maps,
    /// What holds of times, states and parameters.
    pub rows: Vec<Formula>,
    /// For each map the rows that its derivatives follow from, in the order in which they are asked.
    pub step_rows: Vec<Vec<Formula>>,
    /// What holds of derivatives, traces and determinants.
    pub late: Vec<Formula>,
    pub prepared_steps: Vec<StepRows>,
    /// Traces and determinants of products of maps.
    pub invariants: Vec<(Name, Invariant, Program)>,
    pub kinds: Vec<Kind>,
    /// Slots that an assumption says are integers.
    integers: Vec<usize>,
    /// By how much a running index is shifted in what is read.
    index_shift: i32,
    /// Where symbols may lie.
    pub conditions: Vec<Condition>,
    /// For each inequality of the premises a row that it holds by what its slack leaves over.
    pub slacks: Vec<Formula>,
    /// Slots that keep the value they start with.
    pub fixed: BTreeSet<usize>,
    pub questions: Vec<Question>,
    /// The time of the impact from which the flight of the claim starts.
    pub start: Option<usize>,
    /// Whether the claim has a running time.
    pub runs: bool,
    /// Whether the claim speaks of members of a sequence, at a running index.
    pub index_runs: bool,
    /// Whether a premise restricts functions of which it does not say what they are.
    pub shaped: bool,
    /// What vanishes at every running time where laws hold that give no function: rows hold them at a few times.
    pub restricting: Vec<Formula>,
    /// The same where a point needs it.
    pub tested_program: Program,
    /// Whether a law gives a function by dividing by what may vanish, as u in f u = 0.
    pub divides: bool,
    /// Whether anything is complex.
    pub is_complex: bool,
    /// The letter that numbers impacts.
    pub letter: String,
    pub rows_program: Program,
    /// The slots that the rows depend on.
    pub row_slots: Vec<usize>,
    /// Factors in generic symbols alone.
    pub factors_program: Program,
    pub conditions_program: Program,
    /// What is written and decides nothing, but has a value: definitions that no side takes up.
    pub written: Vec<Formula>,
    pub written_program: Program,
    /// Other formulas whose values are asked for; none where one has no concrete form.
    pub asked: Vec<Option<Formula>>,
    pub work: Work,
    pub forcing: Forcing,
    /// What derivatives given by laws are at the running time; nothing while it is being found.
    pub resolved: HashMap<(usize, usize), Option<Formula>>,
}

/// What a row says, before functions are replaced by what stands for them.
struct Written {
    slots: BTreeSet<usize>,
    has_functions: bool,
}

/// Operations for one claim.
pub const WORK: u64 = 100_000_000;

/// Operations for a formula of a document of which nobody says that it is a claim: there are hundreds, and most follow from words.
pub const WORK_ON_A_GUESS: u64 = 5_000_000;

impl System {
    /// Reads premises and claim.
    ///
    /// # Errors
    /// [`Unwitnessed`] where something has no concrete form.
    pub fn new(statements: &Statements, symbols: &Symbols, forcing: Forcing) -> Result<Self, Unwitnessed> {
        Self::asked(statements, symbols, forcing, &[])
    }

    /// Reads premises and claim, and other formulas in the names of the claim.
    ///
    /// # Errors
    /// As [`System::new`].
    pub fn asked(
        statements: &Statements,
        symbols: &Symbols,
        forcing: Forcing,
        asked: &[Tree],
    ) -> Result<Self, Unwitnessed> {
        let mut system = Self {
            space: Space::default(),
            formulas: Formulas::default(),
            maps: Maps::default(),
            rows: Vec::new(),
            step_rows: Vec::new(),
            late: Vec::new(),
            prepared_steps: Vec::new(),
            invariants: Vec::new(),
            kinds: Vec::new(),
            integers: Vec::new(),
            index_shift: 0,
            conditions: Vec::new(),
            slacks: Vec::new(),
            fixed: BTreeSet::new(),
            questions: Vec::new(),
            start: None,
            runs: statements.claim_runs,
            index_runs: numbers_members(statements, symbols),
            shaped: false,
            restricting: Vec::new(),
            tested_program: Program::default(),
            divides: false,
            is_complex: false,
            letter: symbols.index.clone(),
            rows_program: Program::default(),
            row_slots: Vec::new(),
            factors_program: Program::default(),
            conditions_program: Program::default(),
            written: Vec::new(),
            written_program: Program::default(),
            asked: Vec::new(),
            work: Work::new(WORK),
            forcing,
            resolved: HashMap::new(),
        };
        system.read(statements, symbols, asked)?;
        Ok(system)
    }

    pub fn compiler<'a>(&'a mut self, symbols: &'a Symbols, locals: &'a [Local]) -> Compiler<'a> {
        let shift = self.index_shift;
        let mut compiler = Compiler::new(symbols, &mut self.space, &mut self.formulas, &self.maps);
        (compiler.locals, compiler.index_shift) = (locals, shift);
        compiler
    }

    fn read(&mut self, statements: &Statements, symbols: &Symbols, asked: &[Tree]) -> Result<(), Unwitnessed> {
        let is_complex = |local: &Local| symbols.may_be_complex(&local.tree);
        self.is_complex = statements.locals.iter().any(is_complex);
        let first = statements.first.unwrap_or(0);
        let mut maps = read_maps(symbols, &mut self.compiler(symbols, &[]))?;
        maps.tell_led(statements, &mut self.compiler(symbols, &[]));
        let mut written = partials(statements);
        // a derivative over several impacts is that over each of them where these are written too
        written.sort_by_key(|(of, by)| symbols.impact(of).unwrap_or(0) - symbols.impact(by).unwrap_or(0));
        for (of, by) in written {
            let is_of = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if *name == of);
            let said = statements
                .premises
                .iter()
                .any(|premise| any_side(&premise.equation, &mut |tree| is_of(tree)));
            maps.add_step(&of, &by, said, &mut self.compiler(symbols, &[]));
        }
        self.maps = maps;
        if let (Some(first), false) = (statements.first, symbols.times().next().is_none()) {
            self.start = Some(self.compiler(symbols, &[]).time(first));
        }
        let mut laws = Vec::new();
        let mut of_matrices: Vec<(&Equation, &[Local], Option<i32>)> = Vec::new();
        let mut premises = said(statements, symbols).ok_or(Unwitnessed::Kind(TOO_FAR))?;
        premises.extend(beside(statements, symbols).into_iter().map(|premise| (premise, 0)));
        for (premise, by) in &premises {
            self.index_shift = *by;
            // an inequality at every integer binds more than it does at those few that are looked at
            let is_inequality = premise.equation.relation != Relation::Equal;
            self.shaped |= is_inequality && speaks_of_index(&premise.equation, symbols);
            let flight = if statements.claim_runs {
                first
            } else {
                premise.first.unwrap_or(first)
            };
            if speaks_of_matrix(&premise.equation) {
                of_matrices.push((&premise.equation, &premise.locals, premise.first));
                continue;
            }
            let sides = self.sides(&premise.equation, symbols, &premise.locals, premise.first, flight)?;
            if matches!(&premise.equation.left, Tree::Symbol(name, _) if is_pair(name)) {
                // The symbol has either value.
                let apart: Vec<Formula> = sides
                    .into_iter()
                    .map(|(left, right)| self.formulas.subtract(left, right))
                    .collect();
                let product = self.formulas.product(apart);
                self.rows.push(product);
                continue;
            }
            for (left, right) in sides {
                self.sort(left, right, premise.equation.relation, &mut laws)?;
            }
        }
        let claimed = statements
            .assume
            .iter()
            .map(|condition| (condition, statements.locals.as_slice(), None));
        self.index_shift = 0;
        let brought = premises.iter().flat_map(|(premise, _)| {
            premise
                .assume
                .iter()
                .map(|condition| (condition, premise.locals.as_slice(), premise.first))
        });
        let of_times = premises.iter().flat_map(|(premise, _)| &premise.assume);
        if of_times
            .flat_map(Assumption::sides)
            .any(|side| tree_runs(side, symbols))
        {
            return Err(Unwitnessed::Kind("a law that holds at some times alone has no witness"));
        }
        let given = self.rows.len();
        for (condition, locals, at) in claimed.chain(brought) {
            if let Assumption::Relation(equation) = condition
                && equation.relation == Relation::Equal
                && speaks_of_matrix(equation)
            {
                of_matrices.push((equation, locals, at));
                continue;
            }
            self.assume(condition, symbols, locals, at, &mut laws)?;
        }
        let assumed = given..self.rows.len();
        for equation in &symbols.relations {
            for (left, right) in self.sides(equation, symbols, &[], None, first)? {
                self.sort(left, right, equation.relation, &mut laws)?;
            }
        }
        for (name, shift) in symbols.periods() {
            let mut compiler = self.compiler(symbols, &[]);
            let value = compiler.tree(&Tree::Symbol(name.clone(), At(0)))?;
            let shift = compiler.tree(shift)?;
            if let Op::Value { course, level, .. } = self.formulas.op(value) {
                self.declare(course, level, shift);
            }
        }
        self.choose_laws(laws, symbols)?;
        self.tie_flights(statements, symbols);
        let rows = std::mem::take(&mut self.rows);
        let written: Vec<Written> = rows.iter().map(|row| self.written(*row)).collect();
        let rows: Vec<Formula> = rows.into_iter().map(|row| self.resolve(row, symbols)).collect();
        self.rows = rows;
        self.choose_step_rows(statements, &written, &assumed, symbols);
        self.maps.opaque = self.step_rows.iter().all(Vec::is_empty) && !statements.has_partials;
        for (equation, locals, at) in of_matrices {
            for (left, right) in self.sides(equation, symbols, locals, at, first)? {
                let row = self.formulas.subtract(left, right);
                self.late.push(row);
            }
        }
        let late = std::mem::take(&mut self.late);
        self.late = late.into_iter().map(|row| self.resolve(row, symbols)).collect();
        let mut used = Vec::new();
        for equation in &statements.claims {
            let pair = self.pair(equation, symbols, &statements.locals);
            let sides = self.claimed(equation, statements, symbols, first)?;
            used.extend(sides.iter().flat_map(|(left, right)| [*left, *right]));
            let resolved = |(left, right): (Formula, Formula)| [left, right].map(|side| self.resolve(side, symbols));
            let sides = sides.into_iter().map(resolved).collect();
            self.questions.push(Question {
                sides,
                relation: equation.relation,
                pair,
                program: Program::default(),
            });
        }
        for local in &statements.locals {
            let mut compiler = self.compiler(symbols, &statements.locals);
            for value in compiler.value(&local.tree)?.flat() {
                let value = self.resolve(value, symbols);
                self.written.push(value);
            }
        }
        for tree in asked {
            let mut compiler = self.compiler(symbols, &statements.locals);
            compiler.flight = first;
            let value = compiler.tree(tree).ok();
            used.extend(value);
            let value = value.map(|value| self.resolve(value, symbols));
            self.asked.push(value);
        }
        self.test_laws(&used, symbols);
        self.finish(symbols)
    }

    /// Both sides of an equation, under the upper sign and, where there is one, under the lower.
    pub(super) fn sides(
        &mut self,
        equation: &Equation,
        symbols: &Symbols,
        locals: &[Local],
        first: Option<i32>,
        flight: i32,
    ) -> Result<Vec<(Formula, Formula)>, Unwitnessed> {
        let signed = any_side(equation, &mut |tree| {
            matches!(tree, Tree::PlusMinus(_) | Tree::MinusPlus(_))
        });
        let left = match &equation.left {
            Tree::Symbol(name, at) if is_pair(name) => Tree::Symbol(single(name), *at),
            left => left.clone(),
        };
        let mut sides = Vec::new();
        for upper in if signed { vec![true, false] } else { vec![true] } {
            let mut compiler = self.compiler(symbols, locals);
            (compiler.first, compiler.flight, compiler.upper) = (first, flight, upper);
            sides.extend(compiler.between(&left, &equation.right)?);
        }
        Ok(sides)
    }

    /// Takes in one assumption.
    fn assume(
        &mut self,
        condition: &Assumption,
        symbols: &Symbols,
        locals: &[Local],
        first: Option<i32>,
        laws: &mut Vec<[Formula; 2]>,
    ) -> Result<(), Unwitnessed> {
        match condition {
            Assumption::Relation(equation) if is_approach(equation) => {}
            Assumption::Relation(equation) => {
                for (left, right) in self.sides(equation, symbols, locals, first, first.unwrap_or(0))? {
                    self.sort(left, right, equation.relation, laws)?;
                }
            }
            Assumption::Integer(tree) => {
                let formula = self.compiler(symbols, locals).tree(tree)?;
                match self.formulas.op(formula) {
                    Op::Slot(slot) => self.integers.push(slot),
                    _ => {
                        let slot = self.space.slot(Slot::Slack(1000 + self.integers.len()));
                        self.integers.push(slot);
                        let integer = self.formulas.slot(slot);
                        let row = self.formulas.subtract(formula, integer);
                        self.rows.push(row);
                    }
                }
            }
        }
        Ok(())
    }

    fn pair(&mut self, equation: &Equation, symbols: &Symbols, locals: &[Local]) -> Option<usize> {
        let Tree::Symbol(name, at) = &equation.left else {
            return None;
        };
        if !is_pair(name) {
            return None;
        }
        let symbol = self
            .compiler(symbols, locals)
            .tree(&Tree::Symbol(single(name), *at))
            .ok()?;
        match self.formulas.op(symbol) {
            Op::Slot(slot) => Some(slot),
            _ => None,
        }
    }

    /// Takes in one premise.
    fn sort(
        &mut self,
        left: Formula,
        right: Formula,
        relation: Relation,
        laws: &mut Vec<[Formula; 2]>,
    ) -> Result<(), Unwitnessed> {
        let formula = self.formulas.subtract(left, right);
        if relation != Relation::Equal {
            if self.formulas.runs(formula) {
                return Err(Unwitnessed::Kind("an inequality for every time has no witness"));
            }
            self.conditions.push(Condition { formula, relation });
            return Ok(());
        }
        if let Some((course, level, shift)) = self.period_of(left, right) {
            self.declare(course, level, shift);
            return Ok(());
        }
        let slots = &self.space.slots;
        let is_partial = |op: Op| matches!(op, Op::Slot(slot) if matches!(slots.get(slot), Some(Slot::Partial { .. })));
        if self.formulas.any(formula, is_partial) {
            self.late.push(formula);
        } else if self.formulas.runs(formula) {
            laws.push([left, right]);
        } else {
            self.rows.push(formula);
        }
        Ok(())
    }

    /// What is written in a row: the slots of a function's period and coefficients are left out, those of a flight are
    /// the time and the states that it starts with.
    fn written(&self, row: Formula) -> Written {
        let mut slots: BTreeSet<usize> = self.formulas.slots(&[row]).into_iter().collect();
        let mut has_functions = false;
        for part in self.formulas.parts(&[row]) {
            let Op::Value { course, .. } = self.formulas.op(part) else {
                continue;
            };
            has_functions = true;
            let Some(course) = self.space.courses.get(course).filter(|course| course.flight.is_some()) else {
                continue;
            };
            if let Some(law) = course.flow.and_then(|law| self.formulas.laws.get(law)) {
                slots.extend(self.formulas.slots(&[law.start]));
                slots.extend(&law.initial);
            }
        }
        Written { slots, has_functions }
    }

    /// The impacts of a row, with those of parameters that are bound to times.
    fn impacts(&self, row: &Written, bound: &[(usize, BTreeSet<i32>)]) -> BTreeSet<i32> {
        let of = |&slot: &usize| -> BTreeSet<i32> {
            let own = self.space.impact(slot).into_iter();
            let bound = bound.iter().filter(|(known, _)| *known == slot);
            own.chain(bound.flat_map(|(_, impacts)| impacts.clone())).collect()
        };
        row.slots.iter().flat_map(of).collect()
    }

    /// Parameters that an equation of times and parameters alone gives, such as the period `T = t_{k+2} - t_k`.
    fn bound(&self, written: &[Written]) -> Vec<(usize, BTreeSet<i32>)> {
        let mut bound = Vec::new();
        for row in written.iter().filter(|row| self.is_pure(row)) {
            let impacts = self.impacts(row, &[]);
            let parameters = row.slots.iter().filter(|&&slot| self.space.impact(slot).is_none());
            bound.extend(
                parameters
                    .filter(|_| !impacts.is_empty())
                    .map(|&slot| (slot, impacts.clone())),
            );
        }
        bound
    }

    /// Whether a row speaks of times and parameters alone.
    fn is_pure(&self, row: &Written) -> bool {
        !row.has_functions && !row.slots.iter().any(|&slot| self.space.is_state(slot))
    }

    /// The rows each map follows from: what has a state first, then the rest, last what speaks of times alone.
    fn choose_step_rows(
        &mut self,
        statements: &Statements,
        written: &[Written],
        assumed: &Range<usize>,
        symbols: &Symbols,
    ) {
        let bound = self.bound(written);
        let rows = self.rows.clone();
        let steps = self.maps.steps.clone();
        let is_named = |step: &Step| statements.maps.contains(&step.name) || step.name == Name::default();
        for (number, step) in steps.iter().enumerate() {
            if !statements.speaks_of_maps || !is_named(step) {
                self.step_rows.push(Vec::new());
                continue;
            }
            if !step.equations.is_empty() {
                let rows: Vec<Formula> = step.equations.iter().map(|row| self.resolve(*row, symbols)).collect();
                let others = steps.iter().enumerate().filter(|(other, _)| *other != number);
                let mut others = others.filter(|(_, other)| is_named(other));
                // of two maps that lead to the same quantities the equations do not hold together
                if !others.any(|(_, other)| other.of.iter().any(|slot| step.of.contains(slot))) {
                    self.rows.extend(&rows);
                }
                self.step_rows.push(rows);
                continue;
            }
            let impacts: BTreeSet<i32> = step
                .of
                .iter()
                .chain(&step.by)
                .filter_map(|&s| self.space.impact(s))
                .collect();
            let speaks = |slot: &usize| self.space.impact(*slot).is_some() && !step.by.contains(slot);
            let fits = |(_, row): &(&Formula, &Written)| {
                row.slots.iter().any(speaks) && self.impacts(row, &bound).is_subset(&impacts)
            };
            let rows = rows.iter().zip(written).enumerate();
            // a condition on the point is no equation of the map
            let given = rows.filter(|(number, _)| !assumed.contains(number)).map(|(_, row)| row);
            let mut chosen: Vec<(&Formula, &Written)> = given.filter(fits).collect();
            let has_state = |row: &Written| row.slots.iter().any(|&slot| self.space.is_state(slot));
            chosen.sort_by_key(|(_, row)| (!has_state(row), self.is_pure(row)));
            self.step_rows.push(chosen.into_iter().map(|(row, _)| *row).collect());
        }
    }

    /// Programs, conditions, and what stays fixed.
    fn finish(&mut self, symbols: &Symbols) -> Result<(), Unwitnessed> {
        for law in 0..self.formulas.laws.len() {
            let Some(body) = self.formulas.laws.get(law).map(|law| law.body) else {
                continue;
            };
            let body = self.resolve(body, symbols);
            if let Some(law) = self.formulas.laws.get_mut(law) {
                law.body = body;
            }
        }
        self.formulas.prepare_flows();
        self.prepare_steps();
        if !self.step_rows.iter().all(Vec::is_empty) {
            for (name, _) in self.maps.products.clone() {
                for kind in [Invariant::Trace, Invariant::Determinant] {
                    if let Some(formula) = self.maps.invariant(kind, &name, &mut self.space, &mut self.formulas) {
                        self.invariants
                            .push((name.clone(), kind, self.formulas.program(&[formula])));
                    }
                }
            }
        }
        let given = std::mem::take(&mut self.conditions);
        for condition in given {
            let formula = self.resolve(condition.formula, symbols);
            let condition = Condition { formula, ..condition };
            let slack = Slot::Slack(self.slacks.len());
            let slack = self.space.slot(slack);
            let slack = self.formulas.slot(slack);
            let over = self.formulas.make(Op::Power(slack, 2));
            self.slacks.extend(match condition.relation {
                Relation::Less | Relation::LessOrEqual => Some(self.formulas.add(formula, over)),
                Relation::Greater | Relation::GreaterOrEqual => Some(self.formulas.subtract(formula, over)),
                Relation::Equal | Relation::NotEqual => None,
            });
            self.conditions.push(condition);
        }
        self.kinds = domain::kinds(symbols, &self.space);
        let kinds = self.kinds.clone();
        let listed = domain::listed(&mut self.compiler(symbols, &[]), &kinds)?;
        self.conditions.extend(listed);
        self.kinds = domain::kinds(symbols, &self.space);
        for slot in &self.integers {
            if let Some(kind) = self.kinds.get_mut(*slot) {
                kind.integer = true;
            }
        }
        for (number, slot) in self.space.slots.iter().enumerate() {
            let fixed = match slot {
                Slot::Coefficient { course, .. } => {
                    let free = self
                        .space
                        .courses
                        .get(*course)
                        .is_some_and(|course| course.law.is_none());
                    free && !(self.shaped && self.forcing == Forcing::Any)
                }
                _ => self.kinds.get(number).is_some_and(|kind| kind.integer),
            };
            if fixed {
                self.fixed.insert(number);
            }
        }
        self.is_complex |= self.speaks_of_complex();
        self.drop_definitions();
        self.rows_program = self.formulas.program(&self.rows);
        self.written_program = self.formulas.program(&self.written);
        let formulas: Vec<Formula> = self.conditions.iter().map(|condition| condition.formula).collect();
        self.conditions_program = self.formulas.program(&formulas);
        for question in &mut self.questions {
            question.program = self.formulas.program(question.sides.as_flattened());
        }
        let sides = self.questions.iter().flat_map(|question| question.sides.as_flattened());
        let all: Vec<Formula> = sides.chain(&self.rows).chain(&self.late).copied().collect();
        self.row_slots = self.formulas.slots(&self.rows);
        self.factors_program = self.formulas.program(&self.generic_factors(&all));
        Ok(())
    }
}

impl System {
    /// Whether a complex symbol or the imaginary unit stands in what is evaluated.
    fn speaks_of_complex(&self) -> bool {
        let sides = self.questions.iter().flat_map(|question| question.sides.as_flattened());
        let conditions = self.conditions.iter().map(|condition| &condition.formula);
        let rows = self.rows.iter().chain(&self.late).chain(conditions);
        let all: Vec<Formula> = sides.chain(rows).copied().collect();
        let is_complex = |part: Formula| match self.formulas.op(part) {
            Op::Imaginary => true,
            Op::Slot(slot) => self.kinds.get(slot).is_some_and(|kind| kind.complex),
            _ => false,
        };
        self.formulas.parts(&all).into_iter().any(is_complex)
    }

    /// Drops rows that only say what a symbol is of which nothing else is said.
    fn drop_definitions(&mut self) {
        let sides = self.questions.iter().flat_map(|question| question.sides.as_flattened());
        let conditions = self.conditions.iter().map(|condition| &condition.formula);
        let steps = self.step_rows.iter().flatten();
        let others: Vec<Formula> = sides
            .chain(conditions)
            .chain(steps)
            .chain(&self.late)
            .chain(&self.slacks)
            .chain(self.asked.iter().flatten())
            .copied()
            .collect();
        let needed: BTreeSet<usize> = self.formulas.slots(&others).into_iter().collect();
        let steps: BTreeSet<Formula> = self.step_rows.iter().flatten().copied().collect();
        loop {
            let mut counts: HashMap<usize, usize> = HashMap::new();
            for row in &self.rows {
                for slot in self.formulas.slots(&[*row]) {
                    *counts.entry(slot).or_default() += 1;
                }
            }
            // a real symbol that is said to be what may be complex restricts that
            let is_free = |slot: &usize| !self.is_complex || self.kinds.get(*slot).is_some_and(|kind| kind.complex);
            // and of a generic one it matters what it is, though nothing else be said of it
            let is_generic = |slot: &usize| self.kinds.get(*slot).is_some_and(|kind| kind.generic);
            let defines = |slot: &usize| {
                let is_open = !needed.contains(slot) && !self.fixed.contains(slot) && !is_generic(slot);
                counts.get(slot) == Some(&1) && is_open && is_free(slot)
            };
            // where what it is said to be does not exist, there is no point
            let is_partial = |op: Op| matches!(op, Op::Root(..) | Op::RealPower(..) | Op::Apply(Function::Ln, _));
            let restricts = |row: &Formula| steps.contains(row) || self.formulas.any(*row, is_partial);
            let idle = |row: &Formula| !restricts(row) && self.alone(*row).iter().any(defines);
            let Some(position) = self.rows.iter().position(idle) else {
                return;
            };
            let row = self.rows.remove(position);
            self.written.push(row);
        }
    }

    /// The slots that are a term of a row with a constant factor, and stand nowhere else in it.
    pub fn alone(&self, row: Formula) -> Vec<usize> {
        let (mut terms, mut open) = (Vec::new(), vec![row]);
        while let Some(formula) = open.pop() {
            match self.formulas.op(formula) {
                Op::Add(a, b) => open.extend([a, b]),
                Op::Negate(a) => open.push(a),
                Op::Multiply(a, b) if matches!(self.formulas.op(a), Op::Ratio(n, _) if n != 0) => open.push(b),
                Op::Divide(a, b) if matches!(self.formulas.op(b), Op::Ratio(..)) => open.push(a),
                _ => terms.push(formula),
            }
        }
        let slots: Vec<Vec<usize>> = terms.iter().map(|term| self.formulas.slots(&[*term])).collect();
        let is_slot = |term: &Formula| match self.formulas.op(*term) {
            Op::Slot(slot) => Some(slot),
            _ => None,
        };
        let once = |slot: &usize| slots.iter().filter(|slots| slots.contains(slot)).count() == 1;
        terms.iter().filter_map(is_slot).filter(once).collect()
    }

    /// The slots that claim and premises speak of.
    pub fn spoken_of(&self) -> Vec<usize> {
        let sides = self.questions.iter().flat_map(|question| question.sides.as_flattened());
        let all: Vec<Formula> = sides.chain(&self.rows).chain(&self.late).copied().collect();
        self.formulas.slots(&all)
    }

    /// Factors, bases of powers and denominators in generic symbols alone.
    fn generic_factors(&self, all: &[Formula]) -> Vec<Formula> {
        let mut factors = Vec::new();
        for part in self.formulas.parts(all) {
            match self.formulas.op(part) {
                Op::Multiply(a, b) => factors.extend([a, b]),
                Op::Power(base, _) | Op::Divide(_, base) => factors.push(base),
                _ => {}
            }
        }
        let is_generic = |factor: &Formula| {
            let slots = self.formulas.slots(&[*factor]);
            !slots.is_empty()
                && slots
                    .iter()
                    .all(|&slot| self.kinds.get(slot).is_some_and(|kind| kind.generic))
        };
        factors.sort_unstable();
        factors.dedup();
        factors.retain(is_generic);
        factors
    }
}

/// The derivatives written out in premises and claim: of what, by what.
fn partials(statements: &Statements) -> Vec<(Name, Name)> {
    let premises = statements.premises.iter().map(|premise| &premise.equation);
    let mut found = Vec::new();
    for equation in premises.chain(&statements.claims) {
        any_side(equation, &mut |tree| {
            if let Tree::Partial { of, by, .. } = tree {
                found.push((of.clone(), by.clone()));
            }
            false
        });
    }
    found
}

/// Returns true if a premise is about a member of a sequence that it numbers outright, as x_0.
fn numbers_members(statements: &Statements, symbols: &Symbols) -> bool {
    let is_member = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if member(symbols, name).is_some());
    let mut premises = statements.premises.iter();
    premises.any(|premise| any_side(&premise.equation, &mut |tree| is_member(tree)))
}

/// Why nothing is said of a claim that spans many impacts.
const TOO_FAR: &str = "what the claim names lies more impacts or indices apart than are looked at";

/// The premises at each flight that the claim speaks of; where an index runs, at each value of it that premises and
/// claim name. `None` where these are too many.
fn said(statements: &Statements, symbols: &Symbols) -> Option<Vec<(Premise, i32)>> {
    let premises = statements.said(symbols)?;
    if !index_runs(symbols) {
        return Some(premises.into_iter().map(|premise| (premise, 0)).collect());
    }
    let equations = premises
        .iter()
        .map(|premise| &premise.equation)
        .chain(&statements.claims);
    // what a premise says of the member before the first restricts that too, as an inequality shows
    let is_inequality = statements.claims.iter().any(|claim| claim.relation != Relation::Equal);
    let mut all = BTreeSet::from([if is_inequality { -1 } else { 0 }, 0]);
    for equation in equations {
        all.extend(symbols.impacts(equation));
        any_side(equation, &mut |tree| {
            if let Tree::Symbol(name, _) = tree {
                all.extend(member(symbols, name));
            }
            false
        });
    }
    let (low, high) = (all.first().copied().unwrap_or(0), all.last().copied().unwrap_or(0));
    let mut instances = Vec::new();
    for premise in premises {
        let named = symbols.impacts(&premise.equation);
        match (named.first(), named.last()) {
            (Some(first), Some(last)) => {
                let shifts = low - first..=high - last;
                if shifts.clone().nth(MOST_INSTANCES).is_some() {
                    return None;
                }
                instances.extend(shifts.map(|by| (premise.shifted(by, symbols), by)));
            }
            // of an index that stands by itself a premise says something at every integer
            _ if speaks_of_index(&premise.equation, symbols) => {
                instances.extend((-3..=3).map(|by| (premise.shifted(by, symbols), by)));
            }
            _ => instances.push((premise, 0)),
        }
    }
    Some(instances)
}

/// The laws of flight that restrict the states at its ends, in the flights that end at the first impact and start at the
/// last: those that give a state itself, and name fewer states at their own impact than there are.
fn beside(statements: &Statements, symbols: &Symbols) -> Vec<Premise> {
    // a claim that names no impact is bound by those that its premises name
    let named = statements
        .premises
        .iter()
        .flat_map(|premise| symbols.impacts(&premise.equation));
    let named: BTreeSet<i32> = named.collect();
    let of_premises = named.first().copied().zip(named.last().copied());
    let of_claim = statements.first.zip(statements.last);
    let Some((first, last)) = of_claim.or(of_premises).filter(|_| !statements.claim_runs) else {
        return Vec::new();
    };
    let is_state = |name: &Name| symbols.is_state(&name.bare());
    let gives_a_state = |tree: &Tree| match tree {
        Tree::Call(name, ..) | Tree::Symbol(name, _) => name.subscript.is_empty() && is_state(name),
        _ => false,
    };
    let named = |equation: &Equation| {
        let mut found = BTreeSet::new();
        any_side(equation, &mut |tree| {
            if let Tree::Symbol(name, _) = tree
                && is_state(name)
                && !name.subscript.is_empty()
            {
                found.insert(name.clone());
            }
            false
        });
        found.len()
    };
    let restricts = |premise: &&Premise| {
        gives_a_state(&premise.equation.left)
            && flies(&premise.equation, symbols)
            && named(&premise.equation) < symbols.states().count()
    };
    let laws = statements.premises.iter().filter(restricts);
    // there is one flight where one impact is named
    let after = last.max(first + 1);
    laws.flat_map(|law| [first - 1, after].map(|flight| law.said_in(flight, symbols)))
        .collect()
}

/// Values of a running index at which a premise is taken.
const MOST_INSTANCES: usize = 16;

fn speaks_of_index(equation: &Equation, symbols: &Symbols) -> bool {
    any_side(
        equation,
        &mut |tree| matches!(tree, Tree::Symbol(name, _) if symbols.is_index(name)),
    )
}

/// Whether a name stands for two values, as `\lambda_{1,2}` does.
fn is_pair(name: &Name) -> bool {
    matches!(name.subscript.as_str(), "1,2" | r"\pm")
}

fn single(name: &Name) -> Name {
    Name {
        subscript: String::new(),
        ..name.clone()
    }
}

/// Whether a trace or a determinant stands in an equation.
fn speaks_of_matrix(equation: &Equation) -> bool {
    any_side(equation, &mut |tree| matches!(tree, Tree::Invariant { .. }))
}

/// Returns true for a condition that says what something tends to.
pub fn is_approach(equation: &Equation) -> bool {
    matches!(&equation.right, Tree::Operation(operation, _) if matches!(**operation, Operation::Approaches(_)))
}
