//! Formulas with their names resolved to slots: equal parts are kept once, and a program evaluates them in one pass.

use super::value::{Function, Value};
use numbers::Rational;
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use texmath::Relation;

/// A formula among [`Formulas`]. What it is made of has smaller numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Formula(pub u32);

impl Formula {
    pub fn position(self) -> usize {
        self.0 as usize
    }
}

/// The last operation of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    Ratio(i64, i64),
    /// The bits of an f64.
    Float(u64),
    /// A rational beyond i64, by its position in [`Formulas::rationals`].
    Rational(usize),
    Pi,
    /// The imaginary unit.
    Imaginary,
    Slot(usize),
    /// The running time.
    Running,
    /// A function or a state in flight at a time; replaced by what stands for it before anything is evaluated.
    Value {
        course: usize,
        level: usize,
        time: Formula,
    },
    /// A function of time that a differential equation or a law for its derivative gives.
    Flow {
        law: usize,
        level: usize,
        time: Formula,
    },
    Add(Formula, Formula),
    Multiply(Formula, Formula),
    Divide(Formula, Formula),
    Negate(Formula),
    Power(Formula, i32),
    Root(Formula, u32),
    RealPower(Formula, Formula),
    /// A power whose exponent has integer values.
    IntegerPower(Formula, Formula),
    Apply(Function, Formula),
    /// A letter that an operation binds.
    Bound(u8),
    /// An operation over the values of a letter.
    Bind {
        kind: Binder,
        letter: u8,
        body: Formula,
        from: Formula,
        to: Formula,
    },
    /// One of two values, by the relation of a test to 0.
    If {
        relation: Relation,
        test: Formula,
        yes: Formula,
        no: Formula,
    },
}

/// The operations that bind a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binder {
    /// A sum or a product over the integers between two ends.
    Sum,
    Product,
    /// The same over all integers from the first end on.
    Series,
    InfiniteProduct,
    /// An integral between two ends.
    Integral,
    /// An integral from the first end to infinity.
    Ray,
    /// A limit towards the first end.
    Limit(Side),
}

/// Where a limit is approached from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    Both,
    Above,
    Below,
    /// The letter grows without bound.
    Infinity,
}

impl Op {
    /// Returns true if it has a derivative by a complex number.
    pub const fn is_analytic(self) -> bool {
        !matches!(
            self,
            Self::Apply(
                Function::Conjugate | Function::Re | Function::Im | Function::Arg | Function::Abs,
                _
            )
        )
    }

    /// What the operation is applied to.
    pub fn operands(self) -> impl Iterator<Item = Formula> {
        let operands = match self {
            Self::Add(a, b) | Self::Multiply(a, b) | Self::Divide(a, b) => [Some(a), Some(b), None],
            Self::RealPower(a, b) | Self::IntegerPower(a, b) => [Some(a), Some(b), None],
            Self::Negate(a) | Self::Power(a, _) | Self::Root(a, _) | Self::Apply(_, a) => [Some(a), None, None],
            Self::Value { time, .. } | Self::Flow { time, .. } => [Some(time), None, None],
            Self::Bind { body, from, to, .. } => [Some(body), Some(from), Some(to)],
            Self::If { test, yes, no, .. } => [Some(test), Some(yes), Some(no)],
            _ => [None, None, None],
        };
        operands.into_iter().flatten()
    }

    /// The operation on other operands.
    pub fn map(self, new: impl Fn(Formula) -> Formula) -> Self {
        match self {
            Self::Add(a, b) => Self::Add(new(a), new(b)),
            Self::Multiply(a, b) => Self::Multiply(new(a), new(b)),
            Self::Divide(a, b) => Self::Divide(new(a), new(b)),
            Self::RealPower(a, b) => Self::RealPower(new(a), new(b)),
            Self::IntegerPower(a, b) => Self::IntegerPower(new(a), new(b)),
            Self::Negate(a) => Self::Negate(new(a)),
            Self::Power(a, n) => Self::Power(new(a), n),
            Self::Root(a, n) => Self::Root(new(a), n),
            Self::Apply(function, a) => Self::Apply(function, new(a)),
            Self::Value { course, level, time } => Self::Value {
                course,
                level,
                time: new(time),
            },
            Self::Flow { law, level, time } => Self::Flow {
                law,
                level,
                time: new(time),
            },
            Self::Bind {
                kind,
                letter,
                body,
                from,
                to,
            } => Self::Bind {
                kind,
                letter,
                body: new(body),
                from: new(from),
                to: new(to),
            },
            Self::If {
                relation,
                test,
                yes,
                no,
            } => Self::If {
                relation,
                test: new(test),
                yes: new(yes),
                no: new(no),
            },
            leaf => leaf,
        }
    }
}

/// A law for one function.
#[derive(Clone, Debug)]
pub struct Law {
    /// The order of the derivative that the law gives.
    pub order: usize,
    /// The time at which the lower derivatives are those of `initial`.
    pub start: Formula,
    pub initial: Vec<usize>,
    /// The derivative, at the running time.
    pub body: Formula,
}

/// The laws that flow together with one, as a program over power series.
#[derive(Clone, Debug, Default)]
pub struct Flow {
    pub(super) laws: Vec<usize>,
    pub(super) ops: Vec<Op>,
    /// For each function the position of its derivative by its argument.
    pub(super) slopes: Vec<Option<usize>>,
    /// How many coefficients a series has before only zeros follow; more than any order where it does not end.
    pub(super) lengths: Vec<usize>,
    /// The position of the law's derivative, for each law.
    pub(super) bodies: Vec<usize>,
    /// Operations of one step in f64, and in many digits.
    pub(super) costs: [usize; 2],
}

/// The most letters that the operations of one claim bind: a set of them is the bits of a number.
const MOST_LETTERS: u8 = 128;

/// All formulas of a claim, and the laws by which functions of time flow.
#[derive(Clone, Debug, Default)]
pub struct Formulas {
    ops: Vec<Op>,
    known: HashMap<Op, Formula>,
    pub rationals: Vec<Rational>,
    pub laws: Vec<Law>,
    pub flows: Vec<Flow>,
    letters: u8,
}

impl Formulas {
    pub fn op(&self, formula: Formula) -> Op {
        self.ops
            .get(formula.position())
            .copied()
            .unwrap_or(Op::Float(f64::NAN.to_bits()))
    }

    /// The formula with this last operation.
    pub fn make(&mut self, op: Op) -> Formula {
        if let Some(&known) = self.known.get(&op) {
            return known;
        }
        let formula = Formula(self.ops.len() as u32);
        self.ops.push(op);
        self.known.insert(op, formula);
        formula
    }

    pub fn integer(&mut self, value: i64) -> Formula {
        self.make(Op::Ratio(value, 1))
    }

    pub fn float(&mut self, value: f64) -> Formula {
        self.make(Op::Float(value.to_bits()))
    }

    pub fn rational(&mut self, value: &Rational) -> Formula {
        let text = value.to_string();
        let (above, below) = text.split_once('/').unwrap_or((&text, "1"));
        match (above.parse(), below.parse()) {
            (Ok(above), Ok(below)) => self.make(Op::Ratio(above, below)),
            _ => {
                self.rationals.push(value.clone());
                self.make(Op::Rational(self.rationals.len() - 1))
            }
        }
    }

    pub fn slot(&mut self, slot: usize) -> Formula {
        self.make(Op::Slot(slot))
    }

    fn is_integer(&self, formula: Formula, value: i64) -> bool {
        self.op(formula) == Op::Ratio(value, 1)
    }

    pub fn add(&mut self, a: Formula, b: Formula) -> Formula {
        match (self.is_integer(a, 0), self.is_integer(b, 0)) {
            (true, _) => b,
            (_, true) => a,
            _ => self.make(Op::Add(a, b)),
        }
    }

    pub fn subtract(&mut self, a: Formula, b: Formula) -> Formula {
        if self.is_integer(b, 0) {
            return a;
        }
        let b = self.make(Op::Negate(b));
        self.add(a, b)
    }

    pub fn multiply(&mut self, a: Formula, b: Formula) -> Formula {
        match (self.is_integer(a, 1), self.is_integer(b, 1)) {
            (true, _) => b,
            (_, true) => a,
            _ => self.make(Op::Multiply(a, b)),
        }
    }

    pub fn divide(&mut self, a: Formula, b: Formula) -> Formula {
        self.make(Op::Divide(a, b))
    }

    pub fn apply(&mut self, function: Function, a: Formula) -> Formula {
        self.make(Op::Apply(function, a))
    }

    pub fn sum(&mut self, terms: impl IntoIterator<Item = Formula>) -> Formula {
        let zero = self.integer(0);
        terms.into_iter().fold(zero, |sum, term| self.add(sum, term))
    }

    pub fn product(&mut self, factors: impl IntoIterator<Item = Formula>) -> Formula {
        let one = self.integer(1);
        factors
            .into_iter()
            .fold(one, |product, factor| self.multiply(product, factor))
    }

    /// Returns a letter that nothing binds yet; none are left after 128.
    pub fn letter(&mut self) -> Option<u8> {
        let letter = self.letters;
        self.letters += 1;
        (letter < MOST_LETTERS).then_some(letter)
    }

    /// Everything that these formulas are made of, themselves included, each after its operands.
    pub fn parts(&self, of: &[Formula]) -> Vec<Formula> {
        let above = of.iter().map(|formula| formula.position() + 1).max().unwrap_or(0);
        let mut wanted = vec![false; above];
        let mark = |wanted: &mut Vec<bool>, formula: Formula| {
            if let Some(wanted) = wanted.get_mut(formula.position()) {
                *wanted = true;
            }
        };
        of.iter().for_each(|formula| mark(&mut wanted, *formula));
        let mut parts = Vec::new();
        for number in (0..above).rev() {
            if wanted.get(number) == Some(&true) {
                let formula = Formula(number as u32);
                parts.push(formula);
                self.op(formula)
                    .operands()
                    .for_each(|operand| mark(&mut wanted, operand));
            }
        }
        parts.reverse();
        parts
    }

    /// Whether any part passes the test.
    pub fn any(&self, of: Formula, test: impl Fn(Op) -> bool) -> bool {
        self.parts(&[of]).into_iter().any(|part| test(self.op(part)))
    }

    /// Whether the running time stands in a formula.
    pub fn runs(&self, formula: Formula) -> bool {
        self.any(formula, |op| op == Op::Running)
    }

    /// Every slot that the value depends on, those of laws included, in order.
    pub fn slots(&self, of: &[Formula]) -> Vec<usize> {
        let (mut slots, mut laws, mut open) = (Vec::new(), Vec::new(), of.to_vec());
        while let Some(formula) = open.pop() {
            for part in self.parts(&[formula]) {
                match self.op(part) {
                    Op::Slot(slot) => slots.push(slot),
                    Op::Flow { law, .. } if !laws.contains(&law) => {
                        laws.push(law);
                        if let Some(law) = self.laws.get(law) {
                            slots.extend(&law.initial);
                            open.extend([law.start, law.body]);
                        }
                    }
                    _ => {}
                }
            }
        }
        slots.sort_unstable();
        slots.dedup();
        slots
    }

    /// The formula with parts replaced, from the innermost out: `new` sees each operation on operands replaced before.
    pub fn rewrite(&mut self, root: Formula, new: &mut dyn FnMut(&mut Self, Op) -> Option<Formula>) -> Formula {
        let mut made: HashMap<Formula, Formula> = HashMap::new();
        for part in self.parts(&[root]) {
            let op = self
                .op(part)
                .map(|operand| made.get(&operand).copied().unwrap_or(operand));
            let formula = new(self, op).unwrap_or_else(|| self.make(op));
            made.insert(part, formula);
        }
        made.get(&root).copied().unwrap_or(root)
    }

    /// The formula at a time.
    pub fn at(&mut self, formula: Formula, time: Formula) -> Formula {
        self.rewrite(formula, &mut |_, op| (op == Op::Running).then_some(time))
    }

    /// The derivative of a function by its argument.
    pub fn derivative_of(&mut self, function: Function, u: Formula) -> Formula {
        let one = self.integer(1);
        let square = self.make(Op::Power(u, 2));
        let one_less = self.subtract(one, square);
        let one_more = self.add(one, square);
        match function {
            Function::Sin => self.apply(Function::Cos, u),
            Function::Cos => {
                let sin = self.apply(Function::Sin, u);
                self.make(Op::Negate(sin))
            }
            Function::Exp => self.apply(Function::Exp, u),
            Function::Ln => self.divide(one, u),
            Function::Sinh => self.apply(Function::Cosh, u),
            Function::Cosh => self.apply(Function::Sinh, u),
            Function::Arcsin => {
                let root = self.make(Op::Root(one_less, 2));
                self.divide(one, root)
            }
            Function::Arccos => {
                let slope = self.derivative_of(Function::Arcsin, u);
                self.make(Op::Negate(slope))
            }
            Function::Arctan => self.divide(one, one_more),
            Function::Arsinh => {
                let root = self.make(Op::Root(one_more, 2));
                self.divide(one, root)
            }
            Function::Arcosh => {
                let above = self.subtract(square, one);
                let root = self.make(Op::Root(above, 2));
                self.divide(one, root)
            }
            Function::Artanh => self.divide(one, one_less),
            // none at 0
            Function::Abs => {
                let size = self.apply(Function::Abs, u);
                self.divide(u, size)
            }
            Function::Sgn => self.integer(0),
            Function::Conjugate | Function::Re | Function::Im | Function::Arg => self.float(f64::NAN),
        }
    }

    /// The derivative by the running time or by a slot, all else held.
    pub fn slope(&mut self, root: Formula, by: Op) -> Formula {
        let zero = self.integer(0);
        let mut slopes: HashMap<Formula, Formula> = HashMap::new();
        for part in self.parts(&[root]) {
            let op = self.op(part);
            let of = |formula: Formula| slopes.get(&formula).copied().unwrap_or(zero);
            let slope = match op {
                op if op == by => self.integer(1),
                _ if op.operands().all(|operand| of(operand) == zero) => zero,
                Op::Value { course, level, time } => {
                    let level = level + 1;
                    let inner = self.make(Op::Value { course, level, time });
                    self.multiply(inner, of(time))
                }
                Op::Add(a, b) => self.add(of(a), of(b)),
                Op::Negate(a) => self.make(Op::Negate(of(a))),
                Op::Multiply(a, b) => self.cross(a, of(a), b, of(b), zero),
                Op::Divide(a, b) => {
                    let fall = self.multiply(part, of(b));
                    let above = self.subtract(of(a), fall);
                    self.divide(above, b)
                }
                Op::Power(a, n) => {
                    let factors = [
                        self.integer(i64::from(n)),
                        self.make(Op::Power(a, n.saturating_sub(1))),
                        of(a),
                    ];
                    self.product(factors)
                }
                Op::Root(a, n) => {
                    let below = self.integer(i64::from(n));
                    let below = self.multiply(below, a);
                    let above = self.multiply(part, of(a));
                    self.divide(above, below)
                }
                Op::RealPower(a, b) | Op::IntegerPower(a, b) => {
                    // y' = y (b' ln a + b a'/a)
                    let rate = self.divide(of(a), a);
                    let mut sum = self.multiply(b, rate);
                    if of(b) != zero {
                        let ln = self.apply(Function::Ln, a);
                        let more = self.multiply(of(b), ln);
                        sum = self.add(sum, more);
                    }
                    self.multiply(part, sum)
                }
                // by a real letter
                Op::Apply(function @ (Function::Conjugate | Function::Re | Function::Im), a) => {
                    self.apply(function, of(a))
                }
                // of a complex number, that along the number
                Op::Apply(Function::Abs, a) if self.any(a, |op| op == Op::Imaginary) => {
                    let conjugate = self.apply(Function::Conjugate, a);
                    let along = self.multiply(conjugate, of(a));
                    let along = self.apply(Function::Re, along);
                    self.divide(along, part)
                }
                Op::Apply(function, a) => {
                    let slope = self.derivative_of(function, a);
                    let slope = self.multiply(slope, of(a));
                    match function {
                        // 1/u has values where ln u has none, and no derivative
                        Function::Ln | Function::Artanh => {
                            let none_of_it = self.make(Op::Multiply(zero, part));
                            self.make(Op::Add(slope, none_of_it))
                        }
                        _ => slope,
                    }
                }
                Op::If {
                    relation,
                    test,
                    yes,
                    no,
                } => {
                    let (yes, no, none) = (of(yes), of(no), self.float(f64::NAN));
                    let inner = Op::If {
                        relation,
                        test,
                        yes,
                        no,
                    };
                    // where a case ends there is none
                    let outer = Op::If {
                        relation: Relation::NotEqual,
                        test,
                        yes: self.make(inner),
                        no: none,
                    };
                    self.make(outer)
                }
                Op::Bind { body, from, to, .. } => self.slope_of_bound(part, op, [of(body), of(from), of(to)]),
                _ => self.float(f64::NAN),
            };
            slopes.insert(part, slope);
        }
        slopes.get(&root).copied().unwrap_or(zero)
    }

    /// The derivative of an operation over a letter, from those of its body and its ends (Leibniz's rule).
    fn slope_of_bound(&mut self, whole: Formula, op: Op, [inner, low, high]: [Formula; 3]) -> Formula {
        let zero = self.integer(0);
        let Op::Bind {
            kind,
            letter,
            body,
            from,
            to,
        } = op
        else {
            return zero;
        };
        let moves = low != zero || high != zero;
        let over = |formulas: &mut Self, kind: Binder, body: Formula| match body == zero {
            true => zero,
            false => formulas.make(Op::Bind {
                kind,
                letter,
                body,
                from,
                to,
            }),
        };
        match kind {
            Binder::Integral | Binder::Ray => {
                let mut sum = over(self, kind, inner);
                for (end, slope, is_upper) in [(to, high, true), (from, low, false)] {
                    if slope != zero && (kind == Binder::Integral || !is_upper) {
                        let there = self.rewrite(body, &mut |_, op| (op == Op::Bound(letter)).then_some(end));
                        let part = self.multiply(there, slope);
                        sum = match is_upper {
                            true => self.add(sum, part),
                            false => self.subtract(sum, part),
                        };
                    }
                }
                sum
            }
            // a sum over integers jumps where its ends move
            _ if moves => self.float(f64::NAN),
            Binder::Product | Binder::InfiniteProduct => {
                let ratio = self.divide(inner, body);
                let kind = match kind {
                    Binder::Product => Binder::Sum,
                    _ => Binder::Series,
                };
                let sum = over(self, kind, ratio);
                self.multiply(whole, sum)
            }
            _ => over(self, kind, inner),
        }
    }

    /// a' b + a b'.
    fn cross(&mut self, a: Formula, da: Formula, b: Formula, db: Formula, zero: Formula) -> Formula {
        let mut sum = zero;
        if da != zero {
            sum = self.multiply(da, b);
        }
        if db != zero {
            let more = self.multiply(a, db);
            sum = self.add(sum, more);
        }
        sum
    }

    /// A program for these formulas.
    pub fn program(&self, outputs: &[Formula]) -> Program {
        let parts = self.parts(outputs);
        let position = |formula: Formula| parts.binary_search(&formula).unwrap_or(usize::MAX);
        let op = |part: &Formula| self.op(*part).map(|operand| Formula(position(operand) as u32));
        let ops: Vec<Op> = parts.iter().map(op).collect();
        Program {
            loops: Loops::new(&ops),
            ops,
            outputs: outputs.iter().map(|&output| position(output)).collect(),
        }
    }
}

/// Formulas in the order of their evaluation; the operands of each are positions before its own.
#[derive(Clone, Debug, Default)]
pub struct Program {
    pub ops: Vec<Op>,
    pub outputs: Vec<usize>,
    pub(super) loops: Loops,
}

/// What a program evaluates again and again, below the operations that bind a letter.
#[derive(Clone, Debug, Default)]
pub(super) struct Loops {
    /// For each position the letters that its value depends on, as bits; empty where nothing is bound.
    pub letters: Vec<u128>,
    /// For each position that binds a letter those below it that depend on the letter.
    pub inner: Vec<Vec<usize>>,
    /// The sizes that the last run found of what binds a letter.
    pub sizes: RefCell<Vec<f64>>,
}

impl Loops {
    fn new(ops: &[Op]) -> Self {
        if !ops.iter().any(|op| matches!(op, Op::Bound(_))) && !ops.iter().any(|op| matches!(op, Op::Bind { .. })) {
            return Self::default();
        }
        let mut letters: Vec<u128> = Vec::with_capacity(ops.len());
        let mut inner: Vec<Vec<usize>> = Vec::with_capacity(ops.len());
        for op in ops {
            let of = |formula: Formula| letters.get(formula.position()).copied().unwrap_or(0);
            let bit = |letter: u8| 1_u128.checked_shl(u32::from(letter)).unwrap_or(0);
            let (own, below) = match *op {
                Op::Bound(letter) => (bit(letter), Vec::new()),
                Op::Bind {
                    letter, body, from, to, ..
                } => {
                    let mut wanted = vec![false; body.position() + 1];
                    let mut below = Vec::new();
                    if let Some(last) = wanted.last_mut() {
                        *last = true;
                    }
                    for position in (0..=body.position()).rev() {
                        let depends = letters.get(position).is_some_and(|own| own & bit(letter) != 0);
                        if wanted.get(position) != Some(&true) || !depends {
                            continue;
                        }
                        below.push(position);
                        for operand in ops.get(position).into_iter().flat_map(|op| op.operands()) {
                            if let Some(wanted) = wanted.get_mut(operand.position()) {
                                *wanted = true;
                            }
                        }
                    }
                    below.reverse();
                    ((of(body) & !bit(letter)) | of(from) | of(to), below)
                }
                op => (op.operands().fold(0, |all, operand| all | of(operand)), Vec::new()),
            };
            letters.push(own);
            inner.push(below);
        }
        let sizes = RefCell::new(vec![0.0; ops.len()]);
        Self { letters, inner, sizes }
    }
}

/// What a program is evaluated with.
pub struct Inputs<'a, V> {
    pub slots: &'a [V],
    pub running: Option<&'a V>,
    pub formulas: &'a Formulas,
    pub work: &'a Work,
    /// How many flows are evaluated within each other.
    pub depth: usize,
}

/// Operations left, so that hostile formulas end: each operation on an f64 is one.
#[derive(Debug)]
pub struct Work(Cell<u64>);

impl Work {
    pub fn new(operations: u64) -> Self {
        Self(Cell::new(operations))
    }

    /// Takes operations off; false once none are left.
    pub fn take(&self, operations: usize) -> bool {
        let left = self.0.get().saturating_sub(operations as u64);
        self.0.set(left);
        left > 0
    }

    pub fn is_over(&self) -> bool {
        self.0.get() == 0
    }

    pub fn left(&self) -> u64 {
        self.0.get()
    }
}

/// An operation on a number of this type, in operations on f64.
pub fn price<V>() -> usize {
    match std::mem::size_of::<V>() {
        0..=8 => 1,
        // complex f64 and many digits
        9..=16 => 4,
        17..=63 => 60,
        // gradients
        64..=160 => 6,
        _ => 60,
    }
}

/// A quotient, or the argument of a jump, smaller than this part of its terms is rounding error.
const NOISE: f64 = 1e-11;

/// A sum of terms larger than this that comes to 0 may have lost its value: below, terms of small integers cancel exactly.
const LOST: f64 = 1e3;

impl Program {
    /// The values of the outputs.
    pub fn outputs<V: Value>(&self, values: &[V]) -> Vec<V> {
        self.outputs.iter().filter_map(|&n| values.get(n).cloned()).collect()
    }

    /// For each part the size of the terms it is made of: what a rounding error is to be compared with. By running
    /// error analysis (Wilkinson, Rounding Errors in Algebraic Processes, 1963), up to factors of the order of 1.
    /// Nothing where a denominator, or the argument of a jump or a root, is no more than rounding error.
    ///
    /// A slot that `solved` knows was moved until the premises held: its errors are those of the largest of these.
    pub fn sizes<V: Value>(&self, values: &[V], solved: &dyn Fn(usize) -> f64) -> Option<Vec<f64>> {
        let mut sizes: Vec<f64> = Vec::with_capacity(self.ops.len());
        for (n, op) in self.ops.iter().enumerate() {
            let value = values.get(n)?.size();
            let size_of = |formula: Formula| sizes.get(formula.position()).copied().unwrap_or(f64::NAN);
            let at = |formula: Formula| values.get(formula.position());
            let is_noise = |formula: Formula| {
                let size = at(formula).map_or(f64::NAN, Value::size);
                size > 0.0 && size <= NOISE * size_of(formula)
            };
            // The size of the argument times the slope of the function there.
            let through = |formula: Formula, slope: f64| match size_of(formula) {
                size if size == 0.0 || slope == 0.0 => 0.0,
                size => slope * size,
            };
            let is_within = self.loops.letters.get(n).is_some_and(|letters| *letters != 0);
            let size = match *op {
                // its value is that of the last round of a loop
                _ if is_within => value,
                Op::Add(a, b) => size_of(a) + size_of(b),
                Op::Multiply(a, b) => (at(a)?.size() * size_of(b)).max(at(b)?.size() * size_of(a)),
                Op::Divide(_, b) | Op::Power(b, i32::MIN..0) if is_noise(b) => return None,
                Op::Divide(a, b) => size_of(a).max(value * size_of(b)) / at(b)?.size(),
                Op::Negate(a) => size_of(a),
                Op::Power(a, power) => {
                    // beside 0 it is the power of the error itself that counts
                    let base = at(a)?.size().max(f64::EPSILON * size_of(a)).max(f64::MIN_POSITIVE);
                    value.max(through(a, f64::from(power).abs() * base.powf(f64::from(power) - 1.0)))
                }
                // a root of what is lost has a part of the digits of that, and no more
                Op::Root(a, _) if is_noise(a) || (at(a)?.size() == 0.0 && size_of(a) > LOST) => return None,
                Op::Root(a, index) => {
                    value + through(a, value / (f64::from(index) * at(a)?.size()).max(f64::MIN_POSITIVE))
                }
                Op::RealPower(a, b) | Op::IntegerPower(a, b) => {
                    let base = at(a)?.size().max(f64::MIN_POSITIVE);
                    value
                        + through(a, at(b)?.size() * value / base)
                        + through(b, if value == 0.0 { 0.0 } else { value * base.ln().abs() })
                }
                Op::Bind { .. } => self.loops.sizes.borrow().get(n).copied().unwrap_or(value).max(value),
                Op::If {
                    relation,
                    test,
                    yes,
                    no,
                } => match holds(relation, at(test)?) {
                    Some(true) => size_of(yes),
                    Some(false) => size_of(no),
                    None => f64::NAN,
                },
                Op::Apply(Function::Sgn, a) if is_noise(a) => return None,
                Op::Apply(function, a) => value + through(a, slope_size(function, at(a)?, value)),
                Op::Flow { .. } => value + 1.0,
                Op::Slot(slot) => value.max(solved(slot)),
                _ => value,
            };
            sizes.push(size);
        }
        Some(sizes)
    }
}

/// Returns true if a value has a relation to 0; None where it is too near 0 for rounding to say so.
pub fn holds<V: Value>(relation: Relation, test: &V) -> Option<bool> {
    use numbers::Analytic;
    let [re, im] = test.parts().map(|part| part.to_f64());
    let size = re.hypot(im);
    let is_zero = size == 0.0;
    if size.is_nan() || (!is_zero && size <= NOISE) {
        return None;
    }
    let is_ordered = im == 0.0;
    Some(match relation {
        Relation::Equal => is_zero,
        Relation::NotEqual => !is_zero,
        _ if !is_ordered => return None,
        Relation::Less => re < 0.0,
        Relation::LessOrEqual => re <= 0.0,
        Relation::Greater => re > 0.0,
        Relation::GreaterOrEqual => re >= 0.0,
    })
}

/// The size of the derivative of a function.
fn slope_size<V: Value>(function: Function, u: &V, value: f64) -> f64 {
    let one = || V::integer(1);
    let square = u.clone() * u.clone();
    match function {
        Function::Sin | Function::Cos | Function::Abs => 1.0,
        Function::Exp => value,
        Function::Ln => 1.0 / u.size(),
        Function::Sinh | Function::Cosh => value + 1.0,
        Function::Arcsin | Function::Arccos => 1.0 / (one() - square).size().sqrt(),
        Function::Arctan => 1.0 / (one() + square).size(),
        Function::Arsinh => 1.0 / (one() + square).size().sqrt(),
        Function::Arcosh => 1.0 / (square - one()).size().sqrt(),
        Function::Artanh => 1.0 / (one() - square).size(),
        Function::Sgn => 0.0,
        Function::Conjugate | Function::Re | Function::Im => 1.0,
        Function::Arg => 1.0 / u.size(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run<V: Value>(formulas: &Formulas, formula: Formula, slots: &[V]) -> (V, f64) {
        let program = formulas.program(&[formula]);
        let work = Work::new(1000);
        let inputs = Inputs {
            slots,
            running: None,
            formulas,
            work: &work,
            depth: 0,
        };
        let values = program.run(&inputs);
        let sizes = program.sizes(&values, &|_| 0.0).unwrap();
        (values[program.outputs[0]].clone(), sizes[program.outputs[0]])
    }

    #[test]
    fn a_difference_knows_the_size_of_its_terms() {
        let mut formulas = Formulas::default();
        let (a, b, two) = (formulas.slot(0), formulas.slot(1), formulas.integer(2));
        let difference = formulas.subtract(a, b);
        let product = formulas.multiply(two, difference);
        assert_eq!(run(&formulas, product, &[5.0, 4.0]), (2.0, 18.0));
        assert_eq!(formulas.slots(&[product]), [0, 1]);
        assert_eq!(formulas.multiply(two, difference), product);
    }

    #[test]
    fn a_denominator_of_rounding_errors_has_no_size() {
        let mut formulas = Formulas::default();
        let (a, b, one) = (formulas.slot(0), formulas.slot(1), formulas.integer(1));
        let difference = formulas.subtract(a, b);
        let quotient = formulas.divide(one, difference);
        let program = formulas.program(&[quotient]);
        let work = Work::new(1000);
        let mut slots = [0.3, 0.1 + 0.2];
        for noise in [true, false] {
            let inputs = Inputs {
                slots: &slots,
                running: None,
                formulas: &formulas,
                work: &work,
                depth: 0,
            };
            let values = program.run(&inputs);
            assert_eq!(program.sizes(&values, &|_| 0.0).is_none(), noise);
            slots[1] = 0.4;
        }
    }

    #[test]
    fn slopes_are_those_of_the_textbook() {
        let mut formulas = Formulas::default();
        let t = formulas.make(Op::Running);
        let square = formulas.make(Op::Power(t, 2));
        let root = formulas.make(Op::Root(square, 3));
        let sin = formulas.apply(Function::Sin, root);
        let quotient = formulas.divide(sin, t);
        let slope = formulas.slope(quotient, Op::Running);
        let time = formulas.slot(0);
        let [value, slope] = [quotient, slope].map(|formula| formulas.at(formula, time));
        let at = |x: f64| run(&formulas, value, &[x]).0;
        let difference = (at(1.3 + 1e-5) - at(1.3 - 1e-5)) / 2e-5;
        assert!((run(&formulas, slope, &[1.3]).0 - difference).abs() < 1e-9);
    }
}
