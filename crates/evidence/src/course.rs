//! Functions of time: which premise gives them, what stands for those that none gives, and flights between impacts.

use super::compiler::{Unwitnessed, chains};
use super::formula::{Formula, Formulas, Law, Op};
use super::space::Slot;
use super::system::{Forcing, System};
use super::value::Function;
use claims::Statements;
use std::collections::{BTreeSet, HashMap};
use texmath::{Name, Symbols};

/// How many harmonics stand for any function: with the constants of integration there are as many coefficients as
/// values of a function and two integrals at three times, or at two where it repeats.
pub const HARMONICS: usize = 3;
/// Powers of time that a function has besides where a premise says how it behaves: up to the square.
pub const POWERS_OF_LAW: usize = 2;
/// The period of a function that no premise gives one: longer than any motion asked about, and in no ratio to it.
pub const LONG: f64 = 7.389_056_1;
/// The times at which a law is asked that gives no function by itself: more than a function has coefficients, none of
/// a special kind.
pub const TIMES: [f64; 12] = [0.71, 1.37, 2.31, 0.07, 0.39, 1.03, 1.67, 1.99, 2.63, 2.93, 3.29, 3.61];
/// How many of these are asked where all functions have laws of their own.
pub const FEW_TIMES: usize = 3;
/// Other times, at which a law is tested that must hold at every time.
const OTHER_TIMES: [f64; 3] = [0.53, 1.81, -1.13];
/// Values of functions that are followed through laws.
const MOST_USED: usize = 200;
/// The time from which functions with laws for their derivatives start.
const START: f64 = 0.4;

impl System {
    /// The period that an equation `f(t) = f(t + T)`, or `f(t + T) - f(t) = 0`, declares.
    pub fn period_of(&mut self, left: Formula, right: Formula) -> Option<(usize, usize, Formula)> {
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
            if self.formulas.slope(time, Op::Running) != one {
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
    pub fn declare(&mut self, course: usize, level: usize, shift: Formula) {
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
        let time = self.formulas.make(Op::Running);
        let later = self.formulas.add(time, shift);
        let [early, late] = [time, later].map(|time| self.formulas.make(Op::Value { course, level, time }));
        let residual = self.formulas.subtract(early, late);
        self.restricting.push(residual);
        for time in TIMES.into_iter().take(if gives_way { TIMES.len() } else { FEW_TIMES }) {
            let time = self.formulas.float(time);
            let later = self.formulas.add(time, shift);
            let [early, late] = [time, later].map(|time| self.formulas.make(Op::Value { course, level, time }));
            let row = self.formulas.subtract(early, late);
            self.rows.push(row);
        }
    }

    /// Sorts laws into those that give a function and those that restrict one.
    pub fn choose_laws(&mut self, laws: Vec<[Formula; 2]>, symbols: &Symbols) -> Result<(), Unwitnessed> {
        for chain in chains(symbols) {
            let tail = symbols.functions().find(|(name, _)| Some(*name) == chain.last());
            if let Some((_, Some(tree))) = tail {
                let body = self.compiler(symbols, &[]).tree(tree)?;
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
        // A law of flight is one of the state in flight, not of the functions that drive it; else the law of the lowest
        // derivative says most.
        let is_driven = |course: usize| self.space.courses.get(course).is_some_and(|c| c.flight.is_none());
        given.sort_by_key(|(level, _, course, _)| (is_driven(*course), *level));
        let mut used: Vec<[Formula; 2]> = Vec::new();
        for (level, law, course, body) in given {
            let open = self
                .space
                .courses
                .get(course)
                .is_some_and(|course| course.law.is_none());
            if open && !used.contains(&law) && !self.is_circular(course, level, body) {
                // where the law is undefined, it says nothing
                self.divides |= self.divides_by_what_runs(body);
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
            self.restricting.push(residual);
            for time in TIMES.into_iter().take(if shaped { TIMES.len() } else { FEW_TIMES }) {
                let time = self.formulas.float(time);
                let row = self.formulas.at(residual, time);
                self.rows.push(row);
            }
        }
        self.start_flows(symbols);
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
            // where it vanishes, the law says something else or nothing
            self.divides |= self.varies(slope);
            self.formulas.divide(at_zero, slope)
        };
        // Its own value at a fixed time would have to be known before.
        let own = |op: Op| matches!(op, Op::Value { course: other, level: l, .. } if other == course && l >= level);
        (!self.formulas.any(body, own)).then_some((level, body))
    }

    /// Whether a formula is no number.
    fn varies(&self, formula: Formula) -> bool {
        self.formulas.any(formula, |op| {
            matches!(op, Op::Slot(_) | Op::Running | Op::Value { .. } | Op::Flow { .. })
        })
    }

    /// Whether what is divided by in a formula runs.
    fn divides_by_what_runs(&self, formula: Formula) -> bool {
        let is_running = |op: Op| matches!(op, Op::Running | Op::Value { .. } | Op::Flow { .. });
        self.formulas
            .parts(&[formula])
            .into_iter()
            .any(|part| match self.formulas.op(part) {
                Op::Divide(_, below) | Op::Power(below, i32::MIN..0) => self.formulas.any(below, is_running),
                _ => false,
            })
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
    fn start_flows(&mut self, symbols: &Symbols) {
        for number in 0..self.space.courses.len() {
            let Some(course) = self.space.courses.get(number).cloned() else {
                continue;
            };
            let Some((order, body)) = course.law.filter(|(order, _)| *order > 0) else {
                continue;
            };
            let start = match course.flight {
                Some(flight) => {
                    let time = self.compiler(symbols, &[]).time(flight);
                    self.formulas.slot(time)
                }
                None => self.formulas.float(START),
            };
            let mut initial = Vec::new();
            for term in 0..order {
                let state = course.names.get(term).filter(|name| symbols.is_state(name));
                initial.push(match (state, course.flight) {
                    (Some(state), Some(flight)) => self.compiler(symbols, &[]).state(state.clone(), flight, true),
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

    /// Chooses where laws that give no function are tested at a point: at the running time where nothing else is used of
    /// the functions that they speak of, else at other times too, at which they hold if they do at every one.
    pub fn test_laws(&mut self, used: &[Formula], symbols: &Symbols) {
        let running = self.formulas.make(Op::Running);
        let all = self.values_used(used, running);
        if all.is_empty() || self.restricting.is_empty() {
            return;
        }
        let mut tested = Vec::new();
        for residual in self.restricting.clone() {
            let own = self.values_in(residual);
            let is_told = |(course, level, time): &(usize, usize, Option<Formula>)| {
                let of_course = || own.iter().filter(|(other, ..)| other == course);
                let is_own = of_course().any(|(_, other, at)| other == level && at == time && *time == Some(running));
                of_course().next().is_none() || is_own
            };
            let is_enough = all.iter().all(is_told);
            tested.push(residual);
            for time in OTHER_TIMES.into_iter().filter(|_| !is_enough) {
                let time = self.formulas.float(time);
                tested.push(self.formulas.at(residual, time));
            }
        }
        let tested: Vec<Formula> = tested.into_iter().map(|row| self.resolve(row, symbols)).collect();
        self.tested_program = self.formulas.program(&tested);
    }

    fn values_in(&self, formula: Formula) -> Vec<(usize, usize, Option<Formula>)> {
        let parts = self.formulas.parts(&[formula]).into_iter();
        let value = |part| match self.formulas.op(part) {
            Op::Value { course, level, time } => Some((course, level, Some(time))),
            _ => None,
        };
        parts.filter_map(value).collect()
    }

    /// The values of functions that formulas use, by way of laws too; no time where it may be any.
    fn values_used(&self, formulas: &[Formula], running: Formula) -> BTreeSet<(usize, usize, Option<Formula>)> {
        let mut open: Vec<_> = formulas.iter().flat_map(|formula| self.values_in(*formula)).collect();
        let mut used = BTreeSet::new();
        while let Some((course, level, time)) = open.pop() {
            if !used.insert((course, level, time)) || used.len() > MOST_USED {
                continue;
            }
            let Some((order, body)) = self.space.courses.get(course).and_then(|course| course.law) else {
                continue;
            };
            for (inner, below, at) in self.values_in(body) {
                open.push(match level.checked_sub(order) {
                    Some(more) if at == Some(running) => (inner, below + more, time),
                    _ => (inner, below, None),
                });
            }
        }
        used
    }

    /// A flight starts with the states of its impact and, unless the claim has a running time of its own, ends with
    /// those of the next one.
    pub fn tie_flights(&mut self, statements: &Statements, symbols: &Symbols) {
        for number in 0..self.space.courses.len() {
            let Some(course) = self.space.courses.get(number).cloned() else {
                continue;
            };
            let (Some(flight), Some((order, _))) = (course.flight, course.law) else {
                continue;
            };
            // a claim at the running time is about the end of the flight only where it speaks of that
            let to_its_end = !statements.claim_runs || statements.last.is_some_and(|last| last > flight);
            let ends = [(flight, true, order), (flight + 1, false, 0)];
            for (index, after, lowest) in ends.into_iter().take(1 + usize::from(to_its_end)) {
                for (level, name) in course.names.iter().enumerate().skip(lowest) {
                    if !symbols.is_state(name) {
                        continue;
                    }
                    let mut compiler = self.compiler(symbols, &[]);
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
    pub fn resolve(&mut self, formula: Formula, symbols: &Symbols) -> Formula {
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
                Op::Value { course, level, time } => self.value_at(course, level, time, symbols),
                op => self.formulas.make(op),
            };
            new.insert(part, made);
        }
        new.get(&formula).copied().unwrap_or(formula)
    }

    fn value_at(&mut self, number: usize, level: usize, time: Formula, symbols: &Symbols) -> Formula {
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
                let slope = (order..level).fold(body, |body, _| self.formulas.slope(body, Op::Running));
                let body = self.resolve(slope, symbols);
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
}
