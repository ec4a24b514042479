//! Exponents: multiples of one half, which make powers and roots, and all others.

use super::error::Fault;
use super::reader::Reader;
use super::token::{Kind, Token};
use super::{At, Name, Operation, Tree};
use num_traits::Zero;
use numbers::{Field, Rational};

/// The largest integer exponent that is read.
const HIGHEST: i32 = 10_000;

/// The most digits of a number that is an exponent; a longer number is not read anywhere.
const MOST_DIGITS: usize = 1000;

/// What something is raised to.
pub(super) struct Exponent {
    value: Value,
    at: usize,
}

enum Value {
    /// A multiple of one half, held doubled.
    Half(i32),
    Real(Box<Tree>),
}

impl Exponent {
    /// A multiple of one half, written as a number with or without a sign; `None` for any other exponent.
    pub(super) fn of_number(at: usize, content: &[Token<'_>]) -> Result<Option<Self>, Fault> {
        let (negative, content) = match content {
            [sign, rest @ ..] if matches!(sign.kind, Kind::Plus | Kind::Minus) => (sign.kind == Kind::Minus, rest),
            unsigned => (false, unsigned),
        };
        let number = |text: &str| Rational::from_decimal(text).filter(|_| text.len() <= MOST_DIGITS);
        let kinds: Vec<Kind> = content.iter().map(|token| token.kind).collect();
        let texts: Vec<&str> = content.iter().map(|token| token.text).collect();
        let parts = match (kinds.as_slice(), texts.as_slice()) {
            ([Kind::Number], [above]) => Some((*above, "1")),
            ([Kind::Number, Kind::Slash, Kind::Number], [above, _, below]) => Some((*above, *below)),
            ([Kind::Fraction, Kind::Number, Kind::Number], [_, above, below]) => Some((*above, *below)),
            ([Kind::Fraction, Kind::Number], [_, both]) if both.len() == 2 => both.split_at_checked(1),
            _ => None,
        };
        let values = parts.and_then(|(above, below)| number(above).zip(number(below)));
        let Some(twice) = values.and_then(|(above, below)| doubled(&above, &below)) else {
            return Ok(None);
        };
        let Some(twice) = twice.filter(|twice| twice.abs() <= 2 * HIGHEST) else {
            let instead = "integer powers are read up to 10000";
            return Err(Fault::unsupported(at, "this power", instead));
        };
        let value = Value::Half(if negative { -twice } else { twice });
        Ok(Some(Self { value, at }))
    }

    /// `tree` to this power.
    pub(super) fn of(self, tree: Box<Tree>) -> Tree {
        let at = At(self.at);
        match self.value {
            Value::Real(exponent) if is_transpose(&exponent) => {
                Tree::Operation(Box::new(Operation::Transpose(*tree)), at)
            }
            Value::Real(exponent) => match *exponent {
                // A^{-\top}
                Tree::Negate(sign) if is_transpose(&sign) => {
                    let inverse = Tree::Power(tree, -1, at);
                    Tree::Operation(Box::new(Operation::Transpose(inverse)), at)
                }
                exponent => Tree::RealPower(tree, Box::new(exponent), at),
            },
            Value::Half(twice) if twice % 2 == 0 => Tree::Power(tree, twice / 2, at),
            Value::Half(1) => Tree::Root(tree, 2, at),
            Value::Half(twice) => {
                let root = Tree::Root(tree, 2, at);
                Tree::Power(Box::new(root), twice, at)
            }
        }
    }

    /// Returns true for -1, which may mark an inverse function.
    pub(super) fn is_minus_one(&self) -> bool {
        matches!(self.value, Value::Half(-2))
    }

    /// Before an argument a negative power might mean the inverse function, a symbolic one an iterate.
    pub(super) fn before_argument(self) -> Result<Self, Fault> {
        let positive = |tree: &Tree| match tree {
            Tree::Number(_) => true,
            Tree::Quotient(above, below, _) => {
                matches!((&**above, &**below), (Tree::Number(_), Tree::Number(_)))
            }
            _ => false,
        };
        match &self.value {
            Value::Half(twice) if *twice < 0 => {
                let instead = "write the power behind brackets around the call, or the inverse function's own name";
                Err(Fault::ambiguous(self.at, "a negative power of a function", instead))
            }
            Value::Real(exponent) if !positive(exponent) => {
                let instead =
                    "write it behind brackets around the call, [f(t)]^n, if no iterate or derivative is meant";
                Err(Fault::ambiguous(self.at, "a symbolic power of a function", instead))
            }
            _ => Ok(self),
        }
    }
}

impl Reader<'_> {
    /// An exponent that is no number, from byte `at`: a letter, or an expression between braces.
    pub(super) fn exponent(&mut self, at: usize) -> Result<Exponent, Fault> {
        let Some(token) = self.peek() else {
            return Err(self.instead_of("an exponent"));
        };
        self.next += 1;
        let tree = match token.kind {
            Kind::Letter => Box::new(Tree::Symbol(Name::plain(token.text), At(token.at))),
            _ => {
                let tree = self.sum()?;
                self.close_brace(token.at).map(|()| tree)?
            }
        };
        let may_transpose = self.names.opaque.as_ref().is_some_and(|opaque| opaque.transposes);
        let signed = |tree: &Tree| match tree {
            Tree::Symbol(name, at) if may_transpose && *name == Name::plain("T") => {
                Some(Tree::Symbol(Name::plain("\\top"), *at))
            }
            _ => None,
        };
        let tree = match &*tree {
            Tree::Negate(inner) => signed(inner).map(|sign| Box::new(Tree::Negate(Box::new(sign)))),
            own => signed(own).map(Box::new),
        }
        .unwrap_or(tree);
        let value = Value::Real(tree);
        Ok(Exponent { value, at })
    }
}

/// `2 above / below` where that is an integer; within, `None` where it does not fit.
fn doubled(above: &Rational, below: &Rational) -> Option<Option<i32>> {
    if below.is_zero() {
        return None;
    }
    let half = below.clone() / Rational::from_integer(2);
    let twice = above.clone() / half;
    let small = |twice: &Rational| i32::try_from(twice.to_integer()?).ok();
    twice.0.is_int().then(|| small(&twice))
}
/// Returns true for the sign of a transpose, which is no number.
fn is_transpose(exponent: &Tree) -> bool {
    matches!(exponent, Tree::Symbol(name, _) if *name == Name::plain("\\top"))
}
