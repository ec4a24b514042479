//! The values of formulas, and those of functions of time that a law gives: y^(n) = G(t, y, ..., y^(n-1)), from its
//! values at one time to any other, by Taylor series from step to step (Moore, Interval Analysis, 1966, chapter 11). With
//! n = 0 nothing is left to solve; where G names no y, this is an integral.

use super::formula::{Flow, Formula, Formulas, Inputs, Op, Program, holds, price};
use super::value::{Function, Value, undefined};
use numbers::{Analytic, Field, Rational};

/// A series that does not end.
const ENDLESS: usize = 1 << 16;
/// The order of the series in f64, and in many digits.
const ORDER: usize = 24;
const ORDER_WIDE: usize = 44;
const MOST_STEPS: usize = 100;
/// Terms of a series of which one is large where the function or its slope is.
const FIRST_TERMS: usize = 2;
/// The shortest step, as a part of the way left.
const SHORTEST: f64 = 1e-4;
/// How near to 0 a divisor, or the argument of a root or logarithm or of an absolute value, may come, as a part of what
/// it is at first: a law is one function within one interval in which its right side is defined and smooth.
const NEAREST: f64 = 1e-6;
/// Flows whose laws take other flows at fixed times, within each other.
const DEEPEST: usize = 3;

impl Formulas {
    /// Prepares all laws, whose bodies must be resolved.
    pub fn prepare_flows(&mut self) {
        self.flows = (0..self.laws.len()).map(|law| self.flow(law)).collect();
    }

    /// The laws whose functions at the running time stand in the law, itself first.
    fn together(&self, law: usize) -> Vec<usize> {
        let mut laws = vec![law];
        let mut next = 0;
        while let Some(law) = laws.get(next).and_then(|&law| self.laws.get(law)) {
            for part in self.parts(&[law.body]) {
                if let Op::Flow { law, time, .. } = self.op(part)
                    && self.op(time) == Op::Running
                    && !laws.contains(&law)
                {
                    laws.push(law);
                }
            }
            next += 1;
        }
        laws
    }

    fn flow(&mut self, law: usize) -> Flow {
        let laws = self.together(law);
        let of = |law: &usize| self.laws.get(*law).map(|law| law.body);
        let bodies: Vec<Formula> = laws.iter().filter_map(of).collect();
        let bodies: Vec<Formula> = bodies.into_iter().map(|body| self.lowered(body)).collect();
        let mut outputs = bodies.clone();
        let mut slopes = Vec::new();
        // The slopes of functions bring functions of their own, until these are known.
        loop {
            let parts = self.parts(&outputs);
            let functions = parts.iter().filter_map(|part| match self.op(*part) {
                Op::Apply(function, u) => Some((*part, function, u)),
                _ => None,
            });
            let functions: Vec<_> = functions.collect();
            slopes.clear();
            for (part, function, u) in functions {
                let slope = self.derivative_of(function, u);
                slopes.push((part, self.lowered(slope)));
            }
            outputs.extend(slopes.iter().map(|(_, slope)| *slope));
            if self.parts(&outputs).len() == parts.len() {
                break;
            }
        }
        let parts = self.parts(&outputs);
        let position = |formula: &Formula| parts.binary_search(formula).unwrap_or(0);
        let mut slope_of = vec![None; parts.len()];
        for (part, slope) in &slopes {
            slope_of[position(part)] = Some(position(slope));
        }
        let program = self.program(&outputs);
        let mut lengths: Vec<usize> = Vec::with_capacity(parts.len());
        for op in &program.ops {
            let of = |formula: Formula| lengths.get(formula.position()).copied().unwrap_or(ENDLESS);
            lengths.push(match *op {
                Op::Running => 2,
                op if op.operands().all(|operand| of(operand) == 1) => 1,
                Op::Add(a, b) => of(a).max(of(b)),
                Op::Multiply(a, b) => (of(a) + of(b) - 1).min(ENDLESS),
                Op::Negate(a) => of(a),
                Op::Divide(a, b) if of(b) == 1 => of(a),
                Op::Apply(Function::Sgn, _) => 1,
                _ => ENDLESS,
            });
        }
        let cost = |order: usize| -> usize {
            let of = |formula: Formula| lengths.get(formula.position()).copied().unwrap_or(ENDLESS).min(order);
            let terms = program.ops.iter().zip(&lengths).map(|(op, length)| match *op {
                _ if *length == 1 => 1,
                Op::Multiply(a, b) => of(a).min(of(b)) * order,
                Op::Divide(_, a) | Op::Root(a, _) | Op::Apply(_, a) => of(a) * order,
                _ => order,
            });
            terms.sum()
        };
        let costs = [cost(ORDER), cost(ORDER_WIDE)];
        Flow {
            costs,
            laws,
            ops: program.ops,
            slopes: slope_of,
            lengths,
            bodies: bodies.iter().map(position).collect(),
        }
    }

    /// The formula with powers as products and exponentials, which series have rules for.
    fn lowered(&mut self, formula: Formula) -> Formula {
        self.rewrite(formula, &mut |formulas, op| match op {
            Op::Power(base, exponent) if exponent.unsigned_abs() <= 64 => {
                let factors = std::iter::repeat_n(base, exponent.unsigned_abs() as usize);
                let power = formulas.product(factors);
                let one = formulas.integer(1);
                Some(if exponent < 0 {
                    formulas.divide(one, power)
                } else {
                    power
                })
            }
            Op::RealPower(base, exponent) => {
                let ln = formulas.apply(Function::Ln, base);
                let product = formulas.multiply(exponent, ln);
                Some(formulas.apply(Function::Exp, product))
            }
            _ => None,
        })
    }
}

impl Program {
    /// The values of all parts.
    pub fn run<V: Value>(&self, inputs: &Inputs<V>) -> Vec<V> {
        if !inputs.work.take(self.ops.len() * price::<V>()) {
            return vec![V::real(undefined()); self.ops.len()];
        }
        if !self.loops.letters.is_empty() {
            return self.run_loops(inputs);
        }
        let mut values: Vec<V> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let value = evaluate(*op, inputs, |formula: Formula| &values[formula.position()]);
            values.push(value);
        }
        values
    }
}

/// The value of one operation.
pub(super) fn evaluate<'v, V: Value + 'v>(op: Op, inputs: &Inputs<V>, at: impl Fn(Formula) -> &'v V) -> V {
    let none = || V::real(undefined());
    match op {
        Op::Ratio(above, 1) => V::integer(above),
        Op::Ratio(above, below) => V::real(Field::from_ratio(above, below)),
        Op::Float(bits) => V::float(f64::from_bits(bits)),
        Op::Rational(n) => inputs
            .formulas
            .rationals
            .get(n)
            .and_then(Rational::embed)
            .map_or_else(none, V::real),
        Op::Pi => V::real(Analytic::pi()),
        Op::Imaginary => V::new(num_traits::Zero::zero(), num_traits::One::one()),
        Op::Slot(slot) => inputs.slots.get(slot).cloned().unwrap_or_else(none),
        Op::Running => inputs.running.cloned().unwrap_or_else(none),
        Op::Value { .. } => none(),
        Op::Flow { law, level, time } => flown(law, level, at(time), inputs),
        Op::Add(a, b) => at(a).clone() + at(b).clone(),
        Op::Multiply(a, b) => at(a).clone() * at(b).clone(),
        Op::Divide(a, b) => at(a).over(at(b)),
        Op::Negate(a) => -at(a).clone(),
        Op::Power(a, n) => at(a).integer_power(n),
        Op::Root(a, n) => at(a).root(n),
        Op::RealPower(a, b) => at(a).power(at(b)),
        Op::IntegerPower(a, b) => {
            let exponent = at(b).parts()[0].to_f64();
            match exponent.round() {
                whole if (whole - exponent).abs() < 1e-9 && whole.abs() < 1e6 => at(a).integer_power(whole as i32),
                _ => at(a).power(at(b)),
            }
        }
        Op::Apply(function, a) => at(a).apply(function),
        // what is bound has values within loops alone
        Op::Bound(_) | Op::Bind { .. } => none(),
        Op::If {
            relation,
            test,
            yes,
            no,
        } => match holds(relation, at(test)) {
            Some(true) => at(yes).clone(),
            Some(false) => at(no).clone(),
            None => none(),
        },
    }
}

/// The derivative of order `level` below that of the law, at a time; NaN where the series do not reach it.
fn flown<V: Value>(law: usize, level: usize, time: &V, inputs: &Inputs<V>) -> V {
    let none = || V::real(undefined());
    let formulas = inputs.formulas;
    let (Some(flow), true) = (formulas.flows.get(law), inputs.depth < DEEPEST) else {
        return none();
    };
    let start_of = |law: usize| formulas.laws.get(law).map(|law| law.start);
    let inner = Inputs {
        depth: inputs.depth + 1,
        running: None,
        ..*inputs
    };
    let Some(start) = start_of(law) else { return none() };
    let program = formulas.program(&[start]);
    let Some(mut now) = program.outputs(&program.run(&inner)).pop() else {
        return none();
    };
    // The lower derivatives of every law that flows along.
    let mut states: Vec<Vec<V>> = Vec::new();
    for &other in &flow.laws {
        let Some(known) = formulas.laws.get(other) else {
            return none();
        };
        states.push(if start_of(other) == Some(start) {
            known
                .initial
                .iter()
                .map(|slot| inputs.slots.get(*slot).cloned().unwrap_or_else(none))
                .collect()
        } else {
            (0..known.order)
                .map(|level| flown(other, level, &now, &inner))
                .collect()
        });
    }
    let mut first_guards: Option<Vec<f64>> = None;
    for _ in 0..MOST_STEPS {
        let Some([series, guards]) = flow.series(&states, &now, &inner) else {
            return none();
        };
        let left = time.clone() - now.clone();
        let reach = series
            .iter()
            .map(|series| reach::<V>(series))
            .fold(f64::INFINITY, f64::min);
        let distance = left.size();
        if reach.is_nan() || distance.is_nan() || reach <= SHORTEST * distance {
            return none();
        }
        let last = distance <= reach;
        let step = if last {
            left
        } else {
            V::float(left.parts()[0].to_f64() * (reach / distance))
        };
        let ends = guards.iter().map(|guard| {
            let end = |value: V| value.parts().map(|part| part.to_f64());
            Some((end(guard.first()?.clone()), end(derivative(guard, 0, &step))))
        });
        let Some(ends) = ends.collect::<Option<Vec<_>>>() else {
            return none();
        };
        let size = |[re, im]: [f64; 2]| re.hypot(im);
        let first = first_guards.get_or_insert_with(|| ends.iter().map(|(from, _)| size(*from)).collect());
        let passes = |((from, to), first): (&([f64; 2], [f64; 2]), &f64)| {
            let turns = from[1] == 0.0 && to[1] == 0.0 && from[0] * to[0] <= 0.0;
            turns || size(*to) < NEAREST * first
        };
        if ends.iter().zip(first.iter()).any(passes) {
            return none();
        }
        if last {
            return series
                .first()
                .map_or_else(none, |series| derivative(series, level, &step));
        }
        for (state, series) in states.iter_mut().zip(&series) {
            for (level, state) in state.iter_mut().enumerate() {
                *state = derivative(series, level, &step);
            }
        }
        now = now + step;
    }
    none()
}

/// The derivative of a power series at a step.
fn derivative<V: Value>(series: &[V], level: usize, step: &V) -> V {
    let mut sum = V::integer(0);
    for (power, coefficient) in series.iter().enumerate().skip(level).rev() {
        let falling = (power - level + 1..=power).map(|n| n as i64).product();
        sum = sum * step.clone() + coefficient.clone() * V::integer(falling);
    }
    sum
}

/// How far a series can be used: where its last terms are rounding errors beside one of the first.
fn reach<V: Value>(series: &[V]) -> f64 {
    let tolerance = if is_wide::<V>() { 1e-44 } else { 1e-18 };
    let last = series.iter().enumerate().rev().take(3);
    let reach = last.map(|(power, coefficient)| match coefficient.size() {
        0.0 => f64::INFINITY,
        size => {
            let first = series.iter().map(Value::size).enumerate().take(FIRST_TERMS);
            let beside = first.map(|(n, first)| (tolerance * first / size).powf(1.0 / (power - n) as f64));
            // one that is no number makes the reach none
            beside.fold(0.0, |far, next| if next > far || next.is_nan() { next } else { far })
        }
    });
    reach.fold(
        f64::INFINITY,
        |near, next| if next < near || next.is_nan() { next } else { near },
    )
}

pub(super) fn is_wide<V: Value>() -> bool {
    <V::Part as Analytic>::epsilon().to_f64() < 1e-20
}

impl Flow {
    /// The power series of each law's function about a time, and those of what must not become 0.
    fn series<V: Value>(&self, states: &[Vec<V>], now: &V, inputs: &Inputs<V>) -> Option<[Vec<Vec<V>>; 2]> {
        let (order, cost) = if is_wide::<V>() {
            (ORDER_WIDE, self.costs[1])
        } else {
            (ORDER, self.costs[0])
        };
        if !inputs.work.take(cost * price::<V>()) {
            return None;
        }
        let factorial = |n: usize| (1..=n as i64).product::<i64>();
        let mut functions: Vec<Vec<V>> = states
            .iter()
            .map(|state| {
                let term = |(n, value): (usize, &V)| value.over(&V::integer(factorial(n)));
                state.iter().enumerate().map(term).collect()
            })
            .collect();
        let mut series: Vec<Vec<V>> = vec![Vec::new(); self.ops.len()];
        for k in 0..=order {
            for position in 0..self.ops.len() {
                if k < self.lengths[position] {
                    let next = self.coefficient(position, k, &series, &functions, now, inputs);
                    series[position].push(next);
                }
            }
            for ((law, function), body) in self.laws.iter().zip(&mut functions).zip(&self.bodies) {
                let order = inputs.formulas.laws.get(*law)?.order;
                let next = series[*body].get(k).cloned().unwrap_or_else(|| V::integer(0));
                let falling: i64 = (k + 1..=k + order).map(|n| n as i64).product();
                function.push(next.over(&V::integer(falling)));
            }
        }
        let guarded = self.ops.iter().filter_map(|op| match *op {
            Op::Divide(_, a) | Op::Root(a, _) | Op::Apply(Function::Ln | Function::Abs | Function::Sgn, a) => Some(a),
            Op::If { test, .. } => Some(test),
            _ => None,
        });
        let moving = guarded.filter(|a| self.lengths.get(a.position()).is_some_and(|&length| length > 1));
        let guards = moving.filter_map(|a| series.get(a.position()).cloned()).collect();
        Some([functions, guards])
    }

    /// Coefficient number `k` of an operation, from those before it (Moore, as above; Griewank and Walther,
    /// Evaluating Derivatives, 2008, chapter 13).
    fn coefficient<V: Value>(
        &self,
        position: usize,
        k: usize,
        series: &[Vec<V>],
        functions: &[Vec<V>],
        now: &V,
        inputs: &Inputs<V>,
    ) -> V {
        let none = || V::real(undefined());
        let Some(op) = self.ops.get(position).copied() else {
            return none();
        };
        let of = |n: usize, j: usize| series.get(n).and_then(|series| series.get(j));
        let get = |a: Formula, j: usize| of(a.position(), j).cloned().unwrap_or_else(|| V::integer(0));
        // The sum of c(j) a_j b_(k-j) over j from `from` to k.
        let convolution = |a: usize, b: usize, from: usize, factor: &dyn Fn(usize) -> V| {
            let last = series.get(a).map_or(0, Vec::len).min(k + 1);
            (from..last).fold(V::integer(0), |sum, j| match (of(a, j), of(b, k - j)) {
                (Some(x), Some(y)) => sum + factor(j) * x.clone() * y.clone(),
                _ => sum,
            })
        };
        let index = |n: usize| V::integer(n as i64);
        match op {
            Op::Flow { law, level, time } if self.ops.get(time.position()) == Some(&Op::Running) => {
                let known = self.laws.iter().position(|other| *other == law);
                let coefficient = known
                    .and_then(|n| functions.get(n))
                    .and_then(|function| function.get(k + level));
                let falling: i64 = (k + 1..=k + level).map(|n| n as i64).product();
                coefficient.map_or_else(none, |coefficient| coefficient.clone() * V::integer(falling))
            }
            Op::Running if k == 0 => now.clone(),
            Op::Running => V::integer(1),
            // A law that takes a function at another time that runs too.
            Op::Flow { time, .. } if self.lengths.get(time.position()) != Some(&1) => none(),
            _ if k == 0 => {
                let first = |formula: Formula| &series[formula.position()][0];
                evaluate(op, inputs, first)
            }
            Op::Add(a, b) => get(a, k) + get(b, k),
            Op::Negate(a) => -get(a, k),
            Op::Multiply(a, b) => {
                // The shorter series leads.
                let (a, b) = (a.position(), b.position());
                let (a, b) = if self.lengths.get(a) <= self.lengths.get(b) {
                    (a, b)
                } else {
                    (b, a)
                };
                let last = series.get(a).map_or(0, Vec::len).min(k + 1);
                (0..last).fold(V::integer(0), |sum, j| match (of(a, j), of(b, k - j)) {
                    (Some(x), Some(y)) => sum + x.clone() * y.clone(),
                    _ => sum,
                })
            }
            Op::Divide(a, b) => {
                let rest = convolution(b.position(), position, 1, &|_| V::integer(1));
                (get(a, k) - rest).over(&get(b, 0))
            }
            Op::Root(a, n) => {
                // u y' = u' y / n
                let part = V::integer(1).over(&index(n as usize));
                let factor = |j: usize| part.clone() * index(j) - index(k - j);
                let sum = convolution(a.position(), position, 1, &factor);
                sum.over(&(get(a, 0) * index(k)))
            }
            Op::Apply(_, a) => match self.slopes.get(position).copied().flatten() {
                Some(slope) => convolution(a.position(), slope, 1, &index).over(&index(k)),
                None => none(),
            },
            _ => none(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::formula::{Law, Work};
    use super::*;
    use numbers::{Dual, Wide, seeded};

    fn at<V: Value>(formulas: &Formulas, level: usize, slots: &[V], time: V) -> V {
        let work = Work::new(1 << 40);
        let inputs = Inputs {
            slots,
            running: None,
            formulas,
            work: &work,
            depth: 0,
        };
        flown(0, level, &time, &inputs)
    }

    /// y'' = -y from t = 1/2.
    fn oscillator() -> Formulas {
        let mut formulas = Formulas::default();
        let time = formulas.make(Op::Running);
        let y = formulas.make(Op::Flow { law: 0, level: 0, time });
        let body = formulas.make(Op::Negate(y));
        let start = formulas.make(Op::Ratio(1, 2));
        formulas.laws = vec![Law {
            order: 2,
            start,
            initial: vec![0, 1],
            body,
        }];
        formulas.prepare_flows();
        formulas
    }

    #[test]
    fn the_oscillator_swings_in_sixteen_and_in_forty_digits_and_back() {
        let formulas = oscillator();
        for time in [0.5_f64, 3.0, -7.25, 40.0] {
            assert!((at(&formulas, 0, &[1.0, 0.0], time) - (time - 0.5).cos()).abs() < 1e-14);
            assert!((at(&formulas, 1, &[1.0, 0.0], time) + (time - 0.5).sin()).abs() < 1e-14);
        }
        let slots = [1.0, 0.0].map(<Wide<40> as Analytic>::from_f64);
        let found = at(&formulas, 0, &slots, <Wide<40> as Analytic>::from_f64(3.5));
        let cosine = <Wide<40> as Analytic>::from_f64(3.0).sincos().1;
        assert!((found - cosine).to_f64().abs() < 1e-38);
    }

    #[test]
    fn duals_flow_through() {
        let formulas = oscillator();
        let slots = [1.0, 0.0].map(Dual::from_re);
        let slope = at(&formulas, 0, &slots, seeded(3.0_f64)).eps;
        assert!((slope + 2.5_f64.sin()).abs() < 1e-13);
    }

    #[test]
    fn an_integral_of_a_root_and_an_arctangent() {
        let mut formulas = Formulas::default();
        let t = formulas.make(Op::Running);
        let square = formulas.make(Op::Power(t, 2));
        let one = formulas.integer(1);
        let sum = formulas.add(one, square);
        let root = formulas.make(Op::Root(sum, 2));
        let angle = formulas.apply(Function::Arctan, t);
        let body = formulas.add(root, angle);
        let start = formulas.integer(0);
        formulas.laws = vec![Law {
            order: 1,
            start,
            initial: vec![0],
            body,
        }];
        formulas.prepare_flows();
        let t = 2.5_f64;
        let by_hand = 0.5 * (t * (1.0 + t * t).sqrt() + t.asinh()) + t * t.atan() - 0.5 * (1.0 + t * t).ln();
        assert!((at(&formulas, 0, &[0.0], t) - by_hand).abs() < 1e-13);
    }
}
