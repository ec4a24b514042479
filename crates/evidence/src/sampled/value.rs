//! What a formula is worth at a point: a number, real or complex, or a matrix of numbers; and the operations on these.

use nalgebra::{Complex, DMatrix};
use numbers::Rational;
use texmath::{Elementary, Operation, Tree};

/// A difference below this part of what it is the difference of is taken for rounding, and one below this number.
const ROUNDING: f64 = 1e-7;
const SMALLEST: f64 = 1e-10;
/// How near a number must be to an integer to be taken for it.
const WHOLE: f64 = 1e-9;

pub type Number = Complex<f64>;

/// What is no number.
pub const UNDEFINED: Number = Complex {
    re: f64::NAN,
    im: f64::NAN,
};

pub fn real(value: f64) -> Number {
    Complex::new(value, 0.0)
}

pub fn rational(value: &Rational) -> f64 {
    value.0.to_f64().value()
}

/// The integer that a number is.
pub fn whole(value: Number) -> Option<i64> {
    let near = value.re.round();
    let is_whole = value.im.abs() <= WHOLE && (value.re - near).abs() <= WHOLE && near.abs() < 1e9;
    is_whole.then_some(near as i64)
}

/// The value of a formula at a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Number(Number),
    Matrix(DMatrix<Number>),
}

impl Value {
    pub const UNDEFINED: Self = Self::Number(UNDEFINED);

    pub fn is_finite(&self) -> bool {
        match self {
            Self::Number(value) => value.re.is_finite() && value.im.is_finite(),
            Self::Matrix(entries) => entries.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite()),
        }
    }

    pub fn number(&self) -> Option<Number> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Matrix(_) => None,
        }
    }

    /// The largest modulus of an entry.
    pub fn size(&self) -> f64 {
        match self {
            Self::Number(value) => modulus(*value),
            Self::Matrix(entries) => entries.iter().map(|entry| modulus(*entry)).fold(0.0, f64::max),
        }
    }

    /// One number that is linear in the entries, and tells matrices apart.
    pub fn told(&self) -> Number {
        match self {
            Self::Number(value) => *value,
            Self::Matrix(entries) => {
                let weighted = entries.iter().enumerate();
                weighted.map(|(n, entry)| entry * (1.0 + 0.618 * n as f64).sin()).sum()
            }
        }
    }

    pub fn negated(self) -> Self {
        match self {
            Self::Number(value) => Self::Number(-value),
            Self::Matrix(entries) => Self::Matrix(-entries),
        }
    }

    pub fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Number(one), Self::Number(other)) => Self::Number(one + other),
            (Self::Matrix(one), Self::Matrix(other)) if one.shape() == other.shape() => Self::Matrix(one + other),
            _ => Self::UNDEFINED,
        }
    }

    pub fn times(self, other: Self) -> Self {
        match (self, other) {
            (Self::Number(one), Self::Number(other)) => Self::Number(one * other),
            (Self::Number(by), Self::Matrix(entries)) | (Self::Matrix(entries), Self::Number(by)) => {
                Self::Matrix(entries * by)
            }
            (Self::Matrix(one), Self::Matrix(other)) if one.ncols() == other.nrows() => Self::Matrix(one * other),
            _ => Self::UNDEFINED,
        }
    }

    fn over(self, other: Self) -> Self {
        match (self, other) {
            (Self::Number(one), Self::Number(other)) => Self::Number(one / other),
            (Self::Matrix(entries), Self::Number(by)) => Self::Matrix(entries / by),
            _ => Self::UNDEFINED,
        }
    }

    fn raised(self, exponent: i32) -> Self {
        match self {
            Self::Number(value) if value.im == 0.0 => Self::Number(real(value.re.powi(exponent))),
            Self::Number(value) => Self::Number(value.powi(exponent)),
            Self::Matrix(entries) if entries.is_square() && exponent.unsigned_abs() <= 16 => {
                let base = match exponent < 0 {
                    true => entries.try_inverse(),
                    false => Some(entries),
                };
                base.map_or(Self::UNDEFINED, |base| {
                    let one = DMatrix::identity(base.nrows(), base.nrows());
                    Self::Matrix((0..exponent.unsigned_abs()).fold(one, |all, _| all * &base))
                })
            }
            Self::Matrix(_) => Self::UNDEFINED,
        }
    }
}

fn modulus(value: Number) -> f64 {
    match value.im == 0.0 {
        true => value.re.abs(),
        false => value.norm(),
    }
}

/// Whether two sides are equal but for rounding, each given with the size of its terms.
pub fn agree(left: &Value, right: &Value, sizes: f64) -> bool {
    let close = ROUNDING * sizes + SMALLEST;
    match (left, right) {
        (Value::Number(one), Value::Number(other)) => modulus(one - other) <= close,
        (Value::Matrix(one), Value::Matrix(other)) if one.shape() == other.shape() => {
            one.iter().zip(other).all(|(one, other)| modulus(one - other) <= close)
        }
        _ => false,
    }
}

/// The last operation of a node whose value follows from those of its parts.
#[derive(Clone, Copy, Debug)]
pub enum Op {
    Negate,
    Sum,
    Product,
    Quotient,
    Power(i32),
    RealPower,
    Root(u32),
    Function(&'static Elementary),
    /// `\pm`, or `\mp` where not.
    Signed(bool),
    /// With so many columns.
    Matrix(usize),
    Determinant,
    Trace,
    Transpose,
    Cross,
    Dot,
    Binomial,
    IndexedRoot,
    /// What is as small as one likes.
    Order,
}

impl Op {
    pub fn of(tree: &Tree) -> Option<Self> {
        Some(match tree {
            Tree::Negate(_) => Self::Negate,
            Tree::Sum(_) => Self::Sum,
            Tree::Product(_) => Self::Product,
            Tree::Quotient(..) => Self::Quotient,
            Tree::Power(_, exponent, _) => Self::Power(*exponent),
            Tree::RealPower(_, exponent, _) => match &**exponent {
                Tree::Symbol(name, _) if name.base == r"\top" => Self::Transpose,
                _ => Self::RealPower,
            },
            Tree::Root(_, index, _) => Self::Root(*index),
            Tree::Call(name, ..) => Self::Function(Elementary::named(name)?),
            Tree::PlusMinus(_) => Self::Signed(true),
            Tree::MinusPlus(_) => Self::Signed(false),
            Tree::Operation(operation, _) => match &**operation {
                Operation::Matrix(rows) => Self::Matrix(rows.first().map_or(0, Vec::len)),
                Operation::Determinant(_) => Self::Determinant,
                Operation::Trace(_) => Self::Trace,
                Operation::Transpose(_) => Self::Transpose,
                Operation::Cross(..) => Self::Cross,
                Operation::Dot(..) => Self::Dot,
                Operation::Binomial(..) => Self::Binomial,
                Operation::Root { .. } => Self::IndexedRoot,
                Operation::Order(..) => Self::Order,
                _ => return None,
            },
            _ => return None,
        })
    }
}

/// Over which numbers a claim is read, and which sign `\pm` stands for.
#[derive(Clone, Copy, Debug)]
pub struct Arithmetic {
    pub is_complex: bool,
    pub upper: bool,
}

impl Arithmetic {
    pub fn apply(self, op: Op, count: usize, part: impl Fn(usize) -> Value) -> Value {
        let number = |value: Option<Number>| value.map_or(Value::UNDEFINED, Value::Number);
        match op {
            Op::Negate => part(0).negated(),
            Op::Sum => (1..count).fold(part(0), |sum, n| sum.plus(part(n))),
            Op::Product => (1..count).fold(part(0), |product, n| product.times(part(n))),
            Op::Quotient => part(0).over(part(1)),
            Op::Power(exponent) => part(0).raised(exponent),
            Op::RealPower => match (part(0), part(1)) {
                (Value::Number(base), Value::Number(exponent)) => Value::Number(self.power(base, exponent)),
                _ => Value::UNDEFINED,
            },
            Op::Root(index) => number(part(0).number().map(|base| self.root(base, index))),
            Op::Function(function) => match part(0) {
                Value::Number(value) => Value::Number(self.function(function, value)),
                Value::Matrix(entries) if function.command == r"\abs" && entries.ncols() == 1 => {
                    Value::Number(real(entries.iter().map(Complex::norm_sqr).sum::<f64>().sqrt()))
                }
                Value::Matrix(_) => Value::UNDEFINED,
            },
            Op::Signed(is_plus) => match is_plus == self.upper {
                true => part(0),
                false => part(0).negated(),
            },
            Op::Matrix(columns) => {
                let entries: Option<Vec<Number>> = (0..count).map(|n| part(n).number()).collect();
                match entries {
                    Some(entries) if columns > 0 => {
                        Value::Matrix(DMatrix::from_row_iterator(count / columns, columns, entries))
                    }
                    _ => Value::UNDEFINED,
                }
            }
            Op::Determinant | Op::Trace | Op::Transpose => match (op, part(0)) {
                (Op::Determinant, Value::Matrix(entries)) if entries.is_square() => {
                    Value::Number(entries.determinant())
                }
                (Op::Trace, Value::Matrix(entries)) if entries.is_square() => Value::Number(entries.trace()),
                (Op::Transpose, Value::Matrix(entries)) => Value::Matrix(entries.transpose()),
                _ => Value::UNDEFINED,
            },
            Op::Cross | Op::Dot => match (op, part(0), part(1)) {
                (Op::Cross, Value::Matrix(one), Value::Matrix(other))
                    if one.shape() == (3, 1) && other.shape() == (3, 1) =>
                {
                    Value::Matrix(one.cross(&other))
                }
                (Op::Dot, Value::Matrix(one), Value::Matrix(other))
                    if one.shape() == other.shape() && !one.is_square() =>
                {
                    Value::Number(one.dot(&other))
                }
                (Op::Dot, one, other) | (_, one @ Value::Number(_), other @ Value::Number(_)) => one.times(other),
                _ => Value::UNDEFINED,
            },
            Op::Binomial => match (part(0), part(1)) {
                (Value::Number(of), Value::Number(chosen)) => number(binomial(of, chosen)),
                _ => Value::UNDEFINED,
            },
            Op::IndexedRoot => match (part(0), part(1)) {
                (Value::Number(index), Value::Number(of)) => Value::Number(self.power(of, index.inv())),
                _ => Value::UNDEFINED,
            },
            Op::Order => Value::Number(real(0.0)),
        }
    }

    fn function(self, function: &Elementary, value: Number) -> Number {
        match self.is_complex {
            false => real((function.real)(value.re)),
            true => (function.complex)(value),
        }
    }

    fn root(self, base: Number, index: u32) -> Number {
        let part = 1.0 / f64::from(index);
        match index {
            2 if self.is_complex => base.sqrt(),
            2 => real(base.re.sqrt()),
            _ if self.is_complex => base.powf(part),
            _ if index % 2 == 1 => real(base.re.signum() * base.re.abs().powf(part)),
            _ => real(base.re.powf(part)),
        }
    }

    fn power(self, base: Number, exponent: Number) -> Number {
        match whole(exponent) {
            Some(whole) if whole.abs() < 1000 && base.im == 0.0 => real(base.re.powi(whole as i32)),
            Some(whole) if whole.abs() < 1000 => base.powi(whole as i32),
            _ if self.is_complex && base.im == 0.0 && base.re > 0.0 => (exponent * base.re.ln()).exp(),
            _ if self.is_complex => base.powc(exponent),
            _ => real(base.re.powf(exponent.re)),
        }
    }
}

/// For integers only.
fn binomial(of: Number, chosen: Number) -> Option<Number> {
    let chosen = whole(chosen).filter(|chosen| (0..200).contains(chosen))?;
    let factors = 0..chosen;
    Some(real(
        factors.fold(1.0, |product, n| product * (of.re - n as f64) / (n + 1) as f64),
    ))
}
