//! Values of terms in 150 digits, complex throughout, by astro-float: nothing of the crate's numbers takes part.

use astro_float::{BigFloat, Consts, Radix, RoundingMode};
use std::cell::RefCell;
use std::collections::HashMap;
use vibro_audit::kernel::{Elementary, Node, Polynomial, Statement, Symbol, Term};
use vibro_audit::number::Rational;

const BITS: usize = 512;
const NEAREST: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("memory for constants"));
}

/// A complex number.
#[derive(Clone, Debug)]
pub struct Value {
    pub re: BigFloat,
    pub im: BigFloat,
}

fn real(value: f64) -> BigFloat {
    BigFloat::from_f64(value, BITS)
}

fn parsed(text: &str) -> BigFloat {
    CONSTANTS.with_borrow_mut(|c| BigFloat::parse(text, Radix::Dec, BITS, NEAREST, c))
}

fn negative(value: &BigFloat) -> BigFloat {
    value.neg()
}

fn is_below(a: &BigFloat, b: &BigFloat) -> bool {
    a.cmp(b).is_some_and(|order| order < 0)
}

fn pi() -> BigFloat {
    CONSTANTS.with_borrow_mut(|c| c.pi(BITS, NEAREST))
}

/// The angle of a point, in (-pi, pi].
fn angle(y: &BigFloat, x: &BigFloat) -> BigFloat {
    if x.is_zero() {
        let half = pi().div(&real(2.0), BITS, NEAREST);
        return if y.is_zero() {
            real(0.0)
        } else if y.is_negative() {
            half.neg()
        } else {
            half
        };
    }
    let ratio = y.div(x, BITS, NEAREST);
    let base = CONSTANTS.with_borrow_mut(|c| ratio.atan(BITS, NEAREST, c));
    if !x.is_negative() {
        base
    } else if y.is_negative() && !y.is_zero() {
        base.sub(&pi(), BITS, NEAREST)
    } else {
        base.add(&pi(), BITS, NEAREST)
    }
}

impl Value {
    pub fn rational(value: &Rational) -> Self {
        let above = parsed(&value.0.numerator().to_string());
        let below = parsed(&value.0.denominator().to_string());
        Self::of(above.div(&below, BITS, NEAREST))
    }

    pub fn of(re: BigFloat) -> Self {
        Self { re, im: real(0.0) }
    }

    pub fn number(value: f64) -> Self {
        Self::of(real(value))
    }

    fn unit() -> Self {
        Self {
            re: real(0.0),
            im: real(1.0),
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            re: self.re.add(&other.re, BITS, NEAREST),
            im: self.im.add(&other.im, BITS, NEAREST),
        }
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.opposite())
    }

    fn opposite(&self) -> Self {
        Self {
            re: negative(&self.re),
            im: negative(&self.im),
        }
    }

    pub fn times(&self, other: &Self) -> Self {
        let product = |a: &BigFloat, b: &BigFloat| a.mul(b, BITS, NEAREST);
        Self {
            re: product(&self.re, &other.re).sub(&product(&self.im, &other.im), BITS, NEAREST),
            im: product(&self.re, &other.im).add(&product(&self.im, &other.re), BITS, NEAREST),
        }
    }

    fn square_size(&self) -> BigFloat {
        let square = |a: &BigFloat| a.mul(a, BITS, NEAREST);
        square(&self.re).add(&square(&self.im), BITS, NEAREST)
    }

    /// The absolute value.
    pub fn size(&self) -> BigFloat {
        self.square_size().sqrt(BITS, NEAREST)
    }

    /// Smaller than 1e-45 times `scale`.
    pub fn is_nothing(&self, scale: &BigFloat) -> bool {
        is_below(&self.size(), &scale.mul(&parsed("1e-45"), BITS, NEAREST))
    }

    fn over(&self, other: &Self) -> Option<Self> {
        if other.is_nothing(&real(1.0)) {
            return None;
        }
        let size = other.square_size();
        let conjugate = Self {
            re: other.re.clone(),
            im: negative(&other.im),
        };
        let product = self.times(&conjugate);
        Some(Self {
            re: product.re.div(&size, BITS, NEAREST),
            im: product.im.div(&size, BITS, NEAREST),
        })
    }

    fn exp(&self) -> Self {
        CONSTANTS.with_borrow_mut(|c| {
            let size = self.re.exp(BITS, NEAREST, c);
            Self {
                re: size.mul(&self.im.cos(BITS, NEAREST, c), BITS, NEAREST),
                im: size.mul(&self.im.sin(BITS, NEAREST, c), BITS, NEAREST),
            }
        })
    }

    fn ln(&self) -> Option<Self> {
        if self.is_nothing(&real(1.0)) {
            return None;
        }
        let size = self.size();
        let re = CONSTANTS.with_borrow_mut(|c| size.ln(BITS, NEAREST, c));
        Some(Self {
            re,
            im: angle(&self.im, &self.re),
        })
    }

    fn sincos(&self) -> (Self, Self) {
        let turned = self.times(&Self::unit());
        let (up, down) = (turned.exp(), turned.opposite().exp());
        let half = Self::number(0.5);
        let cosine = up.plus(&down).times(&half);
        // (up - down)/2i
        let sine = up.minus(&down).times(&half).times(&Self::unit().opposite());
        (sine, cosine)
    }

    fn root(&self, index: u32) -> Self {
        let Some(logarithm) = self.ln() else {
            return Self::number(0.0);
        };
        let index = Self::number(1.0).over(&Self::number(f64::from(index))).unwrap();
        logarithm.times(&index).exp()
    }

    fn arcsin(&self) -> Option<Self> {
        // -i ln(iz + root(1 - z²))
        let root = Self::number(1.0).minus(&self.times(self)).root(2);
        let turned = self.times(&Self::unit()).plus(&root).ln()?;
        Some(turned.times(&Self::unit().opposite()))
    }

    fn arctan(&self) -> Option<Self> {
        let turned = self.times(&Self::unit());
        let (minus, plus) = (Self::number(1.0).minus(&turned), Self::number(1.0).plus(&turned));
        let difference = minus.ln()?.minus(&plus.ln()?);
        Some(difference.times(&Self::unit()).times(&Self::number(0.5)))
    }

    pub fn is_positive(&self) -> bool {
        is_below(&real(0.0), &self.re)
    }

    pub fn is_integer(&self) -> bool {
        let text = self.re.to_string();
        let value: f64 = text.parse().unwrap_or(f64::NAN);
        value.fract() == 0.0
    }
}

/// The value of a term; `None` where it has none.
pub fn value(statement: &Statement, term: Term, at: &HashMap<Symbol, Value>) -> Option<Value> {
    let terms = statement.terms();
    let of = |part: &Term| value(statement, *part, at);
    Some(match terms.node(term) {
        Node::Number(value) => Value::rational(value),
        Node::Pi => Value::of(pi()),
        Node::Imaginary => Value::unit(),
        Node::Symbol(symbol) => match statement.definitions().get(symbol) {
            Some(meaning) => of(meaning)?,
            None => at.get(symbol)?.clone(),
        },
        Node::Sum(parts) => {
            let mut sum = Value::number(0.0);
            for part in parts {
                sum = sum.plus(&of(part)?);
            }
            sum
        }
        Node::Product(parts) => {
            let mut product = Value::number(1.0);
            for part in parts {
                product = product.times(&of(part)?);
            }
            product
        }
        Node::Power(base, exponent) => power(&of(base)?, u32::try_from(*exponent).ok()?),
        Node::Quotient(above, below) => of(above)?.over(&of(below)?)?,
        Node::RealPower(base, exponent) => of(base)?.ln()?.times(&of(exponent)?).exp(),
        Node::Elementary(function, of_term) => {
            let of = of(of_term)?;
            let is_real = !statement.is_complex();
            match function {
                Elementary::Sin => of.sincos().0,
                Elementary::Cos => of.sincos().1,
                Elementary::Exp => of.exp(),
                Elementary::Ln => of.ln()?,
                Elementary::Root(index) if is_real && index % 2 == 1 && of.re.is_negative() => {
                    of.opposite().root(*index).opposite()
                }
                Elementary::Root(index) => of.root(*index),
                Elementary::Arcsin => of.arcsin()?,
                Elementary::Arccos => Value::of(pi().div(&real(2.0), BITS, NEAREST)).minus(&of.arcsin()?),
                Elementary::Arctan => of.arctan()?,
            }
        }
        Node::Value(..) | Node::Bound | Node::Integral { .. } => return None,
    })
}

fn power(base: &Value, exponent: u32) -> Value {
    (0..exponent).fold(Value::number(1.0), |product, _| product.times(base))
}

/// The value of a polynomial, and the sum of the sizes of its terms.
pub fn polynomial(
    statement: &Statement,
    polynomial: &Polynomial,
    at: &HashMap<Symbol, Value>,
) -> Option<(Value, BigFloat)> {
    let (mut sum, mut scale) = (Value::number(0.0), real(1.0));
    for (monomial, coefficient) in polynomial.terms() {
        let mut product = Value::rational(&Rational(coefficient.clone()));
        for (generator, exponent) in monomial {
            product = product.times(&power(&value(statement, *generator, at)?, *exponent));
        }
        scale = scale.add(&product.size(), BITS, NEAREST);
        sum = sum.plus(&product);
    }
    Some((sum, scale))
}
