//! The premises of a claim as equations over slots, and the claim as questions.

use super::compiler::{Compiler, Unwitnessed, chains};
use super::derivative::StepRows;
use super::domain::{self, Condition, Kind};
use super::flow::Law;
use super::formula::{Formula, Formulas, Op, Program, Work};
use super::maps::{Maps, read_maps};
use super::space::{Slot, Space};
use super::value::Function;
use crate::claim::{Local, Premise, Statements, Vocabulary};
use crate::tex::{At, Condition as Assumption, Equation, Invariant, Name, Relation, Tree};
use std::collections::{BTreeSet, HashMap};

/// How many harmonics stand for any function: with the constants of integration there are as many coefficients as
/// values of a function and two integrals at three times, or at two where it repeats.
pub const HARMONICS: usize = 3;
/// Powers of time that a function has besides where a premise says how it behaves: up to the square.
pub const POWERS_OF_LAW: usize = 2;
/// The period of a function that no premise gives one: longer than any motion asked about, and in no ratio to it.
pub const LONG: f64 = 7.389_056_1;
/// The times at which a law is asked that gives no function by itself: more than a function has coefficients, none of
/// a special kind.
const TIMES: [f64; 12] = [0.71, 1.37, 2.31, 0.07, 0.39, 1.03, 1.67, 1.99, 2.63, 2.93, 3.29, 3.61];
/// How many of these are asked where all functions have laws of their own.
const FEW_TIMES: usize = 3;
/// The time from which functions with laws for their derivatives start.
const START: f64 = 0.4;

/// Which forcing stands for a function that no premise gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forcing {
    /// One of many harmonics, for any function.
    Any,
    /// cos(pi t + phi).
    Cosine,
}

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
    /// Whether a premise restricts functions of which it does not say what they are.
    pub shaped: bool,
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
    pub work: Work,
    forcing: Forcing,
    resolved: HashMap<(usize, usize), Option<Formula>>,
}

/// What a row says, before functions are replaced by what stands for them.
struct Written {
    slots: BTreeSet<usize>,
    has_functions: bool,
}

/// Operations for one claim.
const WORK: u64 = 100_000_000;

impl System {
    /// Reads premises and claim.
    ///
    /// # Errors
    /// [`Unwitnessed`] where something has no concrete form.
    pub fn new(statements: &Statements, vocabulary: &Vocabulary, forcing: Forcing) -> Result<Self, Unwitnessed> {
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
            shaped: false,
            is_complex: false,
            letter: vocabulary.index.clone(),
            rows_program: Program::default(),
            row_slots: Vec::new(),
            factors_program: Program::default(),
            conditions_program: Program::default(),
            work: Work::new(WORK),
            forcing,
            resolved: HashMap::new(),
        };
        system.read(statements, vocabulary)?;
        Ok(system)
    }

    fn compiler<'a>(&'a mut self, vocabulary: &'a Vocabulary, locals: &'a [Local]) -> Compiler<'a> {
        let shift = self.index_shift;
        let mut compiler = Compiler::new(vocabulary, &mut self.space, &mut self.formulas, &self.maps);
        (compiler.locals, compiler.index_shift) = (locals, shift);
        compiler
    }

    fn read(&mut self, statements: &Statements, vocabulary: &Vocabulary) -> Result<(), Unwitnessed> {
        let first = statements.first.unwrap_or(0);
        let mut maps = read_maps(vocabulary, &mut self.compiler(vocabulary, &[]))?;
        for (of, by) in partials(statements) {
            maps.add_step(&of, &by, &mut self.compiler(vocabulary, &[]));
        }
        self.maps = maps;
        if let (Some(first), false) = (statements.first, vocabulary.times.is_empty()) {
            self.start = Some(self.compiler(vocabulary, &[]).time(first));
        }
        let mut laws = Vec::new();
        let mut of_matrices = Vec::new();
        let premises = said(statements, vocabulary);
        for (premise, by) in &premises {
            self.index_shift = *by;
            let flight = if statements.claim_runs {
                first
            } else {
                premise.first.unwrap_or(first)
            };
            if speaks_of_matrix(&premise.equation) {
                of_matrices.push(premise);
                continue;
            }
            let sides = self.sides(&premise.equation, vocabulary, &premise.locals, premise.first, flight)?;
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
        for (condition, locals, at) in claimed.chain(brought) {
            self.assume(condition, vocabulary, locals, at, &mut laws)?;
        }
        for equation in &vocabulary.relations {
            for (left, right) in self.sides(equation, vocabulary, &[], None, first)? {
                self.sort(left, right, equation.relation, &mut laws)?;
            }
        }
        for (name, shift) in &vocabulary.periods {
            let mut compiler = self.compiler(vocabulary, &[]);
            let value = compiler.tree(&Tree::Symbol(name.clone(), At(0)))?;
            let shift = compiler.tree(shift)?;
            if let Op::Value { course, level, .. } = self.formulas.op(value) {
                self.declare(course, level, shift);
            }
        }
        self.choose_laws(laws, vocabulary)?;
        self.tie_flights(statements, vocabulary);
        let rows = std::mem::take(&mut self.rows);
        let written: Vec<Written> = rows.iter().map(|row| self.written(*row)).collect();
        let rows: Vec<Formula> = rows.into_iter().map(|row| self.resolve(row, vocabulary)).collect();
        self.rows = rows;
        self.choose_step_rows(statements.speaks_of_maps, &written, vocabulary);
        self.maps.opaque = self.step_rows.iter().all(Vec::is_empty) && !statements.has_partials;
        for premise in of_matrices {
            for (left, right) in self.sides(&premise.equation, vocabulary, &premise.locals, premise.first, first)? {
                let row = self.formulas.subtract(left, right);
                self.late.push(row);
            }
        }
        let late = std::mem::take(&mut self.late);
        self.late = late.into_iter().map(|row| self.resolve(row, vocabulary)).collect();
        for equation in &statements.claims {
            let pair = self.pair(equation, vocabulary, &statements.locals);
            let sides = self.sides(equation, vocabulary, &statements.locals, None, first)?;
            let resolved = |(left, right): (Formula, Formula)| [left, right].map(|side| self.resolve(side, vocabulary));
            let sides = sides.into_iter().map(resolved).collect();
            self.questions.push(Question {
                sides,
                relation: equation.relation,
                pair,
                program: Program::default(),
            });
        }
        self.finish(vocabulary)
    }

    /// Both sides of an equation, under the upper sign and, where there is one, under the lower.
    fn sides(
        &mut self,
        equation: &Equation,
        vocabulary: &Vocabulary,
        locals: &[Local],
        first: Option<i32>,
        flight: i32,
    ) -> Result<Vec<(Formula, Formula)>, Unwitnessed> {
        let signed = any(equation, &|tree| {
            matches!(tree, Tree::PlusMinus(_) | Tree::MinusPlus(_))
        });
        let left = match &equation.left {
            Tree::Symbol(name, at) if is_pair(name) => Tree::Symbol(single(name), *at),
            left => left.clone(),
        };
        let mut sides = Vec::new();
        for upper in if signed { vec![true, false] } else { vec![true] } {
            let mut compiler = self.compiler(vocabulary, locals);
            (compiler.first, compiler.flight, compiler.upper) = (first, flight, upper);
            sides.push((compiler.tree(&left)?, compiler.tree(&equation.right)?));
        }
        Ok(sides)
    }

    /// Takes in one assumption.
    fn assume(
        &mut self,
        condition: &Assumption,
        vocabulary: &Vocabulary,
        locals: &[Local],
        first: Option<i32>,
        laws: &mut Vec<[Formula; 2]>,
    ) -> Result<(), Unwitnessed> {
        match condition {
            Assumption::Relation(equation) => {
                for (left, right) in self.sides(equation, vocabulary, locals, first, first.unwrap_or(0))? {
                    self.sort(left, right, equation.relation, laws)?;
                }
            }
            Assumption::Integer(tree) => {
                let formula = self.compiler(vocabulary, locals).tree(tree)?;
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

    fn pair(&mut self, equation: &Equation, vocabulary: &Vocabulary, locals: &[Local]) -> Option<usize> {
        let Tree::Symbol(name, at) = &equation.left else {
            return None;
        };
        if !is_pair(name) {
            return None;
        }
        let symbol = self
            .compiler(vocabulary, locals)
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

    /// The period that an equation `f(t) = f(t + T)`, or `f(t + T) - f(t) = 0`, declares.
    fn period_of(&mut self, left: Formula, right: Formula) -> Option<(usize, usize, Formula)> {
        let value = |formulas: &Formulas, formula: Formula| match formulas.op(formula) {
            Op::Value { course, level, time } => Some((course, level, time)),
            _ => None,
        };
        let zero = self.formulas.integer(0);
        let (left, right) = match (self.formulas.op(left), self.formulas.op(right)) {
            (Op::Add(a, b), _) if right == zero => self.opposed(a, b)?,
            (_, Op::Add(a, b)) if left == zero => self.opposed(a, b)?,
            _ => (left, right),
        };
        let ((course, level, early), (other, same, late)) =
            (value(&self.formulas, left)?, value(&self.formulas, right)?);
        if course != other || level != same {
            return None;
        }
        // Both times must run as fast as t does.
        let one = self.formulas.integer(1);
        for time in [early, late] {
            if self.formulas.slope(time) != one {
                return None;
            }
        }
        let zero = self.formulas.integer(0);
        let [early, late] = [early, late].map(|time| self.formulas.at(time, zero));
        (early != late).then(|| (course, level, self.formulas.subtract(late, early)))
    }

    /// The two terms of a difference.
    fn opposed(&self, a: Formula, b: Formula) -> Option<(Formula, Formula)> {
        match (self.formulas.op(a), self.formulas.op(b)) {
            (Op::Negate(a), _) => Some((b, a)),
            (_, Op::Negate(b)) => Some((a, b)),
            _ => None,
        }
    }

    /// Makes a course repeat; a second period must agree with the first.
    fn declare(&mut self, course: usize, level: usize, shift: Formula) {
        let Some(known) = self.space.courses.get_mut(course) else {
            return;
        };
        let is_new = known.period.is_none() && known.flight.is_none() && known.law.is_none();
        if is_new && self.forcing == Forcing::Any {
            known.period = Some((level, shift));
            return;
        }
        if self.forcing == Forcing::Cosine && known.flight.is_none() && known.law.is_none() {
            // The period is 2.
            let (square, four) = (self.formulas.make(Op::Power(shift, 2)), self.formulas.integer(4));
            let row = self.formulas.subtract(square, four);
            self.rows.push(row);
            return;
        }
        if let Some((known, period)) = &mut known.period {
            *known = level.min(*known);
            if *period == shift {
                return;
            }
        }
        // Where the second period is a number, only the function can give way.
        let gives_way = known.law.is_none() && self.formulas.slots(&[shift]).is_empty();
        self.shaped |= gives_way;
        for time in TIMES.into_iter().take(if gives_way { TIMES.len() } else { FEW_TIMES }) {
            let time = self.formulas.float(time);
            let later = self.formulas.add(time, shift);
            let [early, late] = [time, later].map(|time| self.formulas.make(Op::Value { course, level, time }));
            let row = self.formulas.subtract(early, late);
            self.rows.push(row);
        }
    }

    /// Sorts laws into those that give a function and those that restrict one.
    fn choose_laws(&mut self, laws: Vec<[Formula; 2]>, vocabulary: &Vocabulary) -> Result<(), Unwitnessed> {
        for chain in chains(vocabulary) {
            let tail = vocabulary.functions.iter().find(|(name, _)| Some(name) == chain.last());
            if let Some((_, Some(tree))) = tail {
                let body = self.compiler(vocabulary, &[]).tree(tree)?;
                let order = chain.len();
                let course = self.space.course(chain, None);
                if let Some(course) = self.space.courses.get_mut(course) {
                    course.law = Some((order, body));
                }
            }
        }
        let mut given = Vec::new();
        for [left, right] in &laws {
            for course in self.courses_of(&[*left, *right]) {
                if let Some((level, body)) = self.solved_for(course, *left, *right) {
                    given.push((level, [*left, *right], course, body));
                }
            }
        }
        // The law of the lowest derivative says most.
        given.sort_by_key(|(level, ..)| *level);
        let mut used: Vec<[Formula; 2]> = Vec::new();
        for (level, law, course, body) in given {
            let open = self
                .space
                .courses
                .get(course)
                .is_some_and(|course| course.law.is_none());
            if open && !used.contains(&law) && !self.is_circular(course, level, body) {
                if let Some(course) = self.space.courses.get_mut(course) {
                    course.law = Some((level, body));
                }
                used.push(law);
            }
        }
        // A declared period of a function with a law restricts its symbols.
        for course in 0..self.space.courses.len() {
            if let Some(known) = self.space.courses.get_mut(course)
                && known.law.is_some()
                && let Some((level, shift)) = known.period.take()
            {
                self.declare(course, level, shift);
            }
        }
        for law in laws.into_iter().filter(|law| !used.contains(law)) {
            let lawless = |course: &usize| {
                self.space
                    .courses
                    .get(*course)
                    .is_some_and(|course| course.law.is_none())
            };
            let shaped = self.courses_of(&law).iter().any(lawless);
            self.shaped |= shaped;
            let residual = self.formulas.subtract(law[0], law[1]);
            for time in TIMES.into_iter().take(if shaped { TIMES.len() } else { FEW_TIMES }) {
                let time = self.formulas.float(time);
                let row = self.formulas.at(residual, time);
                self.rows.push(row);
            }
        }
        self.start_flows(vocabulary);
        Ok(())
    }

    /// The courses in formulas, those alone on a side first.
    fn courses_of(&self, formulas: &[Formula]) -> Vec<usize> {
        let mut courses = Vec::new();
        let parts = self.formulas.parts(formulas);
        for part in formulas.iter().chain(&parts) {
            if let Op::Value { course, .. } = self.formulas.op(*part)
                && !courses.contains(&course)
            {
                courses.push(course);
            }
        }
        courses
    }

    /// The law solved for the highest derivative of a course: its order, and what it is at the running time.
    fn solved_for(&mut self, course: usize, left: Formula, right: Formula) -> Option<(usize, Formula)> {
        let running = self.formulas.make(Op::Running);
        let mut order = None;
        for part in self.formulas.parts(&[left, right]) {
            if let Op::Value {
                course: other,
                level,
                time,
            } = self.formulas.op(part)
                && other == course
            {
                if time == running {
                    order = order.max(Some(level));
                } else if self.formulas.runs(time) {
                    return None;
                }
            }
        }
        let level = order?;
        let target = self.formulas.make(Op::Value {
            course,
            level,
            time: running,
        });
        let body = if left == target && !self.formulas.parts(&[right]).contains(&target) {
            right
        } else if right == target && !self.formulas.parts(&[left]).contains(&target) {
            left
        } else {
            let residual = self.formulas.subtract(left, right);
            if !self.is_affine(residual, target) {
                return None;
            }
            let [at_zero, at_one] = [0, 1].map(|value| {
                let value = self.formulas.integer(value);
                let target = self.formulas.op(target);
                self.formulas
                    .rewrite(residual, &mut |_, op| (op == target).then_some(value))
            });
            let slope = self.formulas.subtract(at_zero, at_one);
            self.formulas.divide(at_zero, slope)
        };
        // Its own value at a fixed time would have to be known before.
        let own = |op: Op| matches!(op, Op::Value { course: other, level: l, .. } if other == course && l >= level);
        (!self.formulas.any(body, own)).then_some((level, body))
    }

    /// Whether the formula is of the first degree in a part of it.
    fn is_affine(&self, formula: Formula, target: Formula) -> bool {
        let mut degrees: HashMap<Formula, usize> = HashMap::new();
        for part in self.formulas.parts(&[formula]) {
            let degree = |formula: Formula| degrees.get(&formula).copied().unwrap_or(0);
            let found = match self.formulas.op(part) {
                _ if part == target => 1,
                Op::Add(a, b) => degree(a).max(degree(b)),
                Op::Negate(a) => degree(a),
                Op::Multiply(a, b) => degree(a) + degree(b),
                Op::Divide(a, b) if degree(b) == 0 => degree(a),
                op if op.operands().all(|operand| degree(operand) == 0) => 0,
                _ => 2,
            };
            degrees.insert(part, found.min(2));
        }
        degrees.get(&formula) == Some(&1)
    }

    /// Whether a law would need the value that it gives, over the laws there are.
    fn is_circular(&self, course: usize, level: usize, body: Formula) -> bool {
        let (mut open, mut seen) = (vec![body], BTreeSet::new());
        while let Some(body) = open.pop() {
            for part in self.formulas.parts(&[body]) {
                let Op::Value {
                    course: other,
                    level: at,
                    ..
                } = self.formulas.op(part)
                else {
                    continue;
                };
                if other == course && at >= level {
                    return true;
                }
                if let Some((order, body)) = self.space.courses.get(other).and_then(|course| course.law)
                    && at >= order
                    && seen.insert(other)
                {
                    open.push(body);
                }
            }
        }
        false
    }

    /// Gives each course with a law for its derivative the values that it starts with.
    fn start_flows(&mut self, vocabulary: &Vocabulary) {
        for number in 0..self.space.courses.len() {
            let Some(course) = self.space.courses.get(number).cloned() else {
                continue;
            };
            let Some((order, body)) = course.law.filter(|(order, _)| *order > 0) else {
                continue;
            };
            let start = match course.flight {
                Some(flight) => {
                    let time = self.compiler(vocabulary, &[]).time(flight);
                    self.formulas.slot(time)
                }
                None => self.formulas.float(START),
            };
            let mut initial = Vec::new();
            for term in 0..order {
                let state = course.names.get(term).filter(|name| vocabulary.states.contains(name));
                initial.push(match (state, course.flight) {
                    (Some(state), Some(flight)) => self.compiler(vocabulary, &[]).state(state.clone(), flight, true),
                    _ => self.space.slot(Slot::Coefficient { course: number, term }),
                });
            }
            self.formulas.laws.push(Law {
                order,
                start,
                initial,
                body,
            });
            if let Some(course) = self.space.courses.get_mut(number) {
                course.flow = Some(self.formulas.laws.len() - 1);
            }
        }
    }

    /// A flight starts with the states of its impact and, unless the claim has a running time of its own, ends with
    /// those of the next one.
    fn tie_flights(&mut self, statements: &Statements, vocabulary: &Vocabulary) {
        for number in 0..self.space.courses.len() {
            let Some(course) = self.space.courses.get(number).cloned() else {
                continue;
            };
            let (Some(flight), Some((order, _))) = (course.flight, course.law) else {
                continue;
            };
            let ends = [(flight, true, order), (flight + 1, false, 0)];
            for (index, after, lowest) in ends.into_iter().take(if statements.claim_runs { 1 } else { 2 }) {
                for (level, name) in course.names.iter().enumerate().skip(lowest) {
                    if !vocabulary.states.contains(name) {
                        continue;
                    }
                    let mut compiler = self.compiler(vocabulary, &[]);
                    let (time, state) = (compiler.time(index), compiler.state(name.clone(), index, after));
                    let (time, state) = (self.formulas.slot(time), self.formulas.slot(state));
                    let value = self.formulas.make(Op::Value {
                        course: number,
                        level,
                        time,
                    });
                    let row = self.formulas.subtract(value, state);
                    self.rows.push(row);
                }
            }
        }
    }

    /// The formula with each function of time replaced by what stands for it.
    fn resolve(&mut self, formula: Formula, vocabulary: &Vocabulary) -> Formula {
        if !self.formulas.any(formula, |op| matches!(op, Op::Value { .. })) {
            return formula;
        }
        let mut new: HashMap<Formula, Formula> = HashMap::new();
        for part in self.formulas.parts(&[formula]) {
            let op = self
                .formulas
                .op(part)
                .map(|operand| new.get(&operand).copied().unwrap_or(operand));
            let made = match op {
                Op::Value { course, level, time } => self.value_at(course, level, time, vocabulary),
                op => self.formulas.make(op),
            };
            new.insert(part, made);
        }
        new.get(&formula).copied().unwrap_or(formula)
    }

    fn value_at(&mut self, number: usize, level: usize, time: Formula, vocabulary: &Vocabulary) -> Formula {
        let Some(course) = self.space.courses.get(number).cloned() else {
            return self.formulas.float(f64::NAN);
        };
        let Some((order, body)) = course.law else {
            return self.harmonics(number, level, time);
        };
        if let Some(law) = course.flow.filter(|_| level < order) {
            return self.formulas.make(Op::Flow { law, level, time });
        }
        let body = match self.resolved.get(&(number, level)) {
            Some(Some(known)) => *known,
            // It needs itself.
            Some(None) => return self.formulas.float(f64::NAN),
            None => {
                self.resolved.insert((number, level), None);
                let slope = (order..level).fold(body, |body, _| self.formulas.slope(body));
                let body = self.resolve(slope, vocabulary);
                self.resolved.insert((number, level), Some(body));
                body
            }
        };
        self.formulas.at(body, time)
    }

    /// Value of the member `level` steps below the highest integral of a function of which nothing is known: a
    /// trigonometric polynomial with a polynomial, and its integrals and derivatives.
    ///
    /// It stands for any function: its values and those of its integrals at a few times are independent of each other,
    /// since it has more coefficients than there are values.
    fn harmonics(&mut self, number: usize, level: usize, time: Formula) -> Formula {
        let Some(course) = self.space.courses.get(number).cloned() else {
            return self.formulas.float(f64::NAN);
        };
        let members = course.names.len();
        let powers = match &course.period {
            _ if self.forcing == Forcing::Cosine => 0,
            Some((level, _)) => level + 1,
            // Constants of integration are enough for any function at a few times.
            None if self.shaped => members + POWERS_OF_LAW,
            None => members,
        };
        let first = course.first.unwrap_or_else(|| {
            let all = members + POWERS_OF_LAW + 2 * HARMONICS;
            let first = self.space.slots.len();
            self.space
                .slots
                .extend((0..all).map(|term| Slot::Coefficient { course: number, term }));
            if let Some(course) = self.space.courses.get_mut(number) {
                course.first = Some(first);
            }
            first
        });
        let formulas = &mut self.formulas;
        // Horner's scheme in t^j / j!
        let mut sum = formulas.integer(0);
        for power in (level..powers).rev() {
            let next = formulas.integer((power - level + 1) as i64);
            let below = formulas.multiply(sum, time);
            let below = if sum == formulas.integer(0) {
                sum
            } else {
                formulas.divide(below, next)
            };
            let coefficient = formulas.slot(first + power);
            sum = formulas.add(coefficient, below);
        }
        let (length, harmonics) = match (&course.period, self.forcing) {
            (_, Forcing::Cosine) => (formulas.integer(2), 1),
            (Some((_, period)), _) => (*period, HARMONICS),
            (None, _) => (formulas.float(LONG), HARMONICS),
        };
        let (two, pi) = (formulas.integer(2), formulas.make(Op::Pi));
        let turn = formulas.multiply(two, pi);
        let base = formulas.divide(turn, length);
        let angle = formulas.multiply(base, time);
        let (s, c) = (
            formulas.apply(Function::Sin, angle),
            formulas.apply(Function::Cos, angle),
        );
        let (mut sin, mut cos) = (s, c);
        // The coefficients are those of the lowest member that has a name.
        let integrals = members as i32 - 1 - level as i32;
        for n in 0..harmonics {
            if n > 0 {
                // By the addition theorems.
                let (sc, cs) = (formulas.multiply(sin, c), formulas.multiply(cos, s));
                let (cc, ss) = (formulas.multiply(cos, c), formulas.multiply(sin, s));
                (sin, cos) = (formulas.add(sc, cs), formulas.subtract(cc, ss));
            }
            let [a, b] = match self.forcing {
                Forcing::Any => [0, 1].map(|part| formulas.slot(first + members + POWERS_OF_LAW + 2 * n + part)),
                Forcing::Cosine => {
                    let phase = self.space.slot(Slot::Parameter(Name {
                        base: r"\phi".to_string(),
                        ..Name::default()
                    }));
                    let phase = formulas.slot(phase);
                    let sine = formulas.apply(Function::Sin, phase);
                    [formulas.apply(Function::Cos, phase), formulas.make(Op::Negate(sine))]
                }
            };
            let (x, y, plus) = match integrals.rem_euclid(4) {
                0 => (cos, sin, true),
                1 => (sin, cos, false),
                2 => (cos, sin, true),
                _ => (sin, cos, false),
            };
            let (ax, by) = (formulas.multiply(a, x), formulas.multiply(b, y));
            let mut term = if plus {
                formulas.add(ax, by)
            } else {
                formulas.subtract(ax, by)
            };
            if matches!(integrals.rem_euclid(4), 2 | 3) {
                term = formulas.make(Op::Negate(term));
            }
            let n = formulas.integer(n as i64 + 1);
            let rate = formulas.multiply(n, base);
            let scale = formulas.make(Op::Power(rate, -integrals));
            let term = if integrals == 0 {
                term
            } else {
                formulas.multiply(term, scale)
            };
            sum = formulas.add(sum, term);
        }
        sum
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

    /// The rows each map follows from: what has a state first, then the rest.
    fn choose_step_rows(&mut self, speaks_of_maps: bool, written: &[Written], vocabulary: &Vocabulary) {
        let bound = self.bound(written);
        let rows = self.rows.clone();
        for step in self.maps.steps.clone() {
            if !speaks_of_maps {
                self.step_rows.push(Vec::new());
                continue;
            }
            if !step.equations.is_empty() {
                let rows: Vec<Formula> = step
                    .equations
                    .iter()
                    .map(|row| self.resolve(*row, vocabulary))
                    .collect();
                self.rows.extend(&rows);
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
                !self.is_pure(row) && row.slots.iter().any(speaks) && self.impacts(row, &bound).is_subset(&impacts)
            };
            let mut chosen: Vec<(&Formula, &Written)> = rows.iter().zip(written).filter(fits).collect();
            chosen.sort_by_key(|(_, row)| !row.slots.iter().any(|&slot| self.space.is_state(slot)));
            self.step_rows.push(chosen.into_iter().map(|(row, _)| *row).collect());
        }
    }

    /// Programs, conditions, and what stays fixed.
    fn finish(&mut self, vocabulary: &Vocabulary) -> Result<(), Unwitnessed> {
        for law in 0..self.formulas.laws.len() {
            let Some(body) = self.formulas.laws.get(law).map(|law| law.body) else {
                continue;
            };
            let body = self.resolve(body, vocabulary);
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
            let formula = self.resolve(condition.formula, vocabulary);
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
        self.kinds = domain::kinds(vocabulary, &self.space);
        let kinds = self.kinds.clone();
        let listed = domain::listed(&mut self.compiler(vocabulary, &[]), &kinds)?;
        self.conditions.extend(listed);
        self.kinds = domain::kinds(vocabulary, &self.space);
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
        self.drop_definitions();
        self.rows_program = self.formulas.program(&self.rows);
        let formulas: Vec<Formula> = self.conditions.iter().map(|condition| condition.formula).collect();
        self.conditions_program = self.formulas.program(&formulas);
        for question in &mut self.questions {
            question.program = self.formulas.program(question.sides.as_flattened());
        }
        let sides = self.questions.iter().flat_map(|question| question.sides.as_flattened());
        let all: Vec<Formula> = sides.chain(&self.rows).chain(&self.late).copied().collect();
        let complex = self
            .formulas
            .slots(&all)
            .iter()
            .any(|&slot| self.kinds.get(slot).is_some_and(|kind| kind.complex));
        self.row_slots = self.formulas.slots(&self.rows);
        self.factors_program = self.formulas.program(&self.generic_factors(&all));
        let imaginary = |part: &Formula| self.formulas.op(*part) == Op::Imaginary;
        self.is_complex = complex || self.formulas.parts(&all).iter().any(imaginary);
        Ok(())
    }
}

impl System {
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
            let defines =
                |slot: &usize| counts.get(slot) == Some(&1) && !needed.contains(slot) && !self.fixed.contains(slot);
            let idle = |row: &Formula| !steps.contains(row) && self.alone(*row).iter().any(defines);
            let Some(position) = self.rows.iter().position(idle) else {
                return;
            };
            self.rows.remove(position);
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
    let found = std::cell::RefCell::new(Vec::new());
    for equation in premises.chain(&statements.claims) {
        any(equation, &|tree| {
            if let Tree::Partial { of, by, .. } = tree {
                found.borrow_mut().push((of.clone(), by.clone()));
            }
            false
        });
    }
    found.into_inner()
}

/// The premises at each flight that the claim speaks of; where an index runs, at each value of it that premises and
/// claim name.
fn said(statements: &Statements, vocabulary: &Vocabulary) -> Vec<(Premise, i32)> {
    let premises = statements.said(vocabulary);
    if !domain::index_runs(vocabulary) {
        return premises.into_iter().map(|premise| (premise, 0)).collect();
    }
    let equations = premises
        .iter()
        .map(|premise| &premise.equation)
        .chain(&statements.claims);
    let mut all = BTreeSet::from([0]);
    for equation in equations {
        all.extend(vocabulary.impacts(equation));
        let members = std::cell::RefCell::new(&mut all);
        any(equation, &|tree| {
            if let Tree::Symbol(name, _) = tree {
                members.borrow_mut().extend(domain::member(vocabulary, name));
            }
            false
        });
    }
    let (low, high) = (all.first().copied().unwrap_or(0), all.last().copied().unwrap_or(0));
    let mut instances = Vec::new();
    for premise in premises {
        let named = vocabulary.impacts(&premise.equation);
        match (named.first(), named.last()) {
            (Some(first), Some(last)) => {
                let shifts = (low - first..=high - last).take(MOST_INSTANCES);
                instances.extend(shifts.map(|by| (premise.shifted(by, vocabulary), by)));
            }
            _ => instances.push((premise, 0)),
        }
    }
    instances
}

/// Values of a running index at which a premise is taken.
const MOST_INSTANCES: usize = 8;

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
    any(equation, &|tree| matches!(tree, Tree::Invariant { .. }))
}

/// Whether any node of an equation passes the test.
pub fn any(equation: &Equation, test: &dyn Fn(&Tree) -> bool) -> bool {
    fn below(tree: &Tree, test: &dyn Fn(&Tree) -> bool) -> bool {
        test(tree)
            || match tree {
                Tree::Number(_) | Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => false,
                Tree::Call(_, body, _) | Tree::Negate(body) | Tree::Power(body, ..) | Tree::Root(body, ..) => {
                    below(body, test)
                }
                Tree::PlusMinus(body) | Tree::MinusPlus(body) => below(body, test),
                Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(|part| below(part, test)),
                Tree::Quotient(a, b, _) | Tree::RealPower(a, b, _) => below(a, test) || below(b, test),
            }
    }
    below(&equation.left, test) || below(&equation.right, test)
}
