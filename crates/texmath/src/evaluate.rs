//! The value of a tree over any field, once its names are given values.

use super::{At, Invariant, Name, Tree};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, HashMap};
use std::hash::BuildHasher;

/// What the names of a formula stand for. Only what a formula holds is asked for; what a scope does not answer
/// itself is [`Unsupported`].
pub trait Scope<F: Field> {
    /// Why a name has no value. [`Unsupported`] itself will do where nothing else can go wrong.
    type Error: From<Unsupported>;

    /// The value of a symbol.
    fn symbol(&mut self, name: &Name) -> Result<F, Self::Error>;

    /// The value of a function; the scope evaluates the argument, for it may be looked up rather than computed.
    fn call(&mut self, function: &Name, argument: &Tree) -> Result<F, Self::Error> {
        let _ = argument;
        Err(Unsupported::Call(function.clone()).into())
    }

    /// The value of a partial derivative.
    fn partial(&mut self, of: &Name, by: &Name) -> Result<F, Self::Error> {
        Err(Unsupported::Partial(Box::new(of.clone()), Box::new(by.clone())).into())
    }

    /// The value of a trace or a determinant.
    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<F, Self::Error> {
        let _ = kind;
        Err(Unsupported::Invariant(of.clone()).into())
    }

    /// The root of this index, 2 or more.
    fn root(&mut self, radicand: F, index: u32) -> Result<F, Self::Error> {
        let _ = (radicand, index);
        Err(Unsupported::Root.into())
    }

    /// A power whose exponent is not an integer literal.
    fn real_power(&mut self, base: F, exponent: F) -> Result<F, Self::Error> {
        let _ = (base, exponent);
        Err(Unsupported::RealPower.into())
    }

    /// A printed number in the field.
    fn number(&mut self, value: &Rational) -> Result<F, Self::Error> {
        value.embed().ok_or_else(|| Unsupported::Number(value.clone()).into())
    }

    /// Which sign `\pm` stands for: `Some(true)` the upper, `None` neither.
    fn upper_sign(&self) -> Option<bool> {
        None
    }

    /// Whether nothing may be divided by `value`.
    fn is_zero(&mut self, value: &F) -> bool {
        value.is_zero()
    }
}

/// What a scope does not know.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsupported {
    /// A symbol.
    #[error("{0} has no value")]
    Symbol(Name),
    /// A function.
    #[error("{0} is no known function")]
    Call(Name),
    /// A partial derivative: of what, by what.
    #[error("the derivative of {0} with respect to {1} is not known")]
    Partial(Box<Name>, Box<Name>),
    /// A trace or determinant of this matrix.
    #[error("{0} is no known matrix")]
    Invariant(Name),
    /// A root.
    #[error("a root has no value here")]
    Root,
    /// A power with an exponent that is no integer.
    #[error("a power whose exponent is no integer has no value here")]
    RealPower,
    /// A matrix, a derivative, an integral, a sum or product of many terms, a value by cases.
    #[error("an operation has no value here")]
    Operation,
    /// A number whose denominator is zero in the field.
    #[error("{0} has no value here")]
    Number(Rational),
}

/// Symbols alone, from a table.
impl<F: Field, S: BuildHasher> Scope<F> for HashMap<Name, F, S> {
    type Error = Unsupported;

    fn symbol(&mut self, name: &Name) -> Result<F, Unsupported> {
        self.get(name).cloned().ok_or_else(|| Unsupported::Symbol(name.clone()))
    }
}

/// Symbols alone, from a table.
impl<F: Field> Scope<F> for BTreeMap<Name, F> {
    type Error = Unsupported;

    fn symbol(&mut self, name: &Name) -> Result<F, Unsupported> {
        self.get(name).cloned().ok_or_else(|| Unsupported::Symbol(name.clone()))
    }
}

/// Why a tree has no value, and the byte offset of the place in its TeX.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EvaluationError<E> {
    /// The scope gave no value.
    #[error("{error}")]
    Scope { error: E, at: usize },
    /// A denominator, or the base of a negative power, is zero.
    #[error("a denominator is zero")]
    DivisionByZero { at: usize },
    /// The scope chose neither sign of `\pm`.
    #[error("no sign was chosen for \\pm")]
    Sign { at: usize },
}

impl<E> EvaluationError<E> {
    /// The byte offset of the place.
    pub fn at(&self) -> usize {
        match self {
            Self::Scope { at, .. } | Self::DivisionByZero { at } | Self::Sign { at } => *at,
        }
    }
}

/// The value of `tree`, its names as `scope` has them.
pub fn evaluate<F: Field, S: Scope<F>>(tree: &Tree, scope: &mut S) -> Result<F, EvaluationError<S::Error>> {
    match tree {
        Tree::Number(value) => known(scope.number(value), tree),
        Tree::Symbol(name, _) => known(scope.symbol(name), tree),
        Tree::Call(function, argument, _) => known(scope.call(function, argument), tree),
        Tree::Partial { of, by, .. } => known(scope.partial(of, by), tree),
        Tree::Invariant { kind, of, .. } => known(scope.invariant(*kind, of), tree),
        Tree::Negate(body) => evaluate(body, scope).map(|value: F| -value),
        Tree::Sum(terms) => sum(terms, scope),
        Tree::Product(factors) => product(factors, scope),
        Tree::Quotient(above, below, at) => quotient(above, below, at.0, scope),
        Tree::Power(base, exponent, at) => power(base, *exponent, at.0, scope),
        Tree::RealPower(base, exponent, at) => real_power(base, exponent, *at, scope),
        Tree::Root(radicand, index, at) => root(radicand, *index, *at, scope),
        Tree::PlusMinus(body) => signed(body, true, scope),
        Tree::MinusPlus(body) => signed(body, false, scope),
        Tree::Operation(..) => known(Err(Unsupported::Operation.into()), tree),
    }
}

// One function for each kind of node keeps the stack that a deep tree takes small: each has only its own values.

type Value<F, E> = Result<F, EvaluationError<E>>;

fn known<F, E>(value: Result<F, E>, tree: &Tree) -> Value<F, E> {
    value.map_err(|error| EvaluationError::Scope { error, at: place(tree) })
}

#[inline(never)]
fn sum<F: Field, S: Scope<F>>(terms: &[Tree], scope: &mut S) -> Value<F, S::Error> {
    let mut total = F::zero();
    for term in terms {
        total += evaluate(term, scope)?;
    }
    Ok(total)
}

#[inline(never)]
fn product<F: Field, S: Scope<F>>(factors: &[Tree], scope: &mut S) -> Value<F, S::Error> {
    let mut total = F::one();
    for factor in factors {
        total *= evaluate(factor, scope)?;
    }
    Ok(total)
}

#[inline(never)]
fn quotient<F: Field, S: Scope<F>>(above: &Tree, below: &Tree, at: usize, scope: &mut S) -> Value<F, S::Error> {
    let denominator: F = evaluate(below, scope)?;
    if scope.is_zero(&denominator) {
        return Err(EvaluationError::DivisionByZero { at });
    }
    evaluate(above, scope).map(|numerator: F| numerator / denominator)
}

#[inline(never)]
fn power<F: Field, S: Scope<F>>(base: &Tree, exponent: i32, at: usize, scope: &mut S) -> Value<F, S::Error> {
    let base: F = evaluate(base, scope)?;
    if exponent >= 0 {
        return Ok(base.to_power(exponent));
    }
    let zero = scope.is_zero(&base);
    let denominator = match exponent.checked_neg() {
        Some(positive) if !zero => base.to_power(positive),
        _ => return Err(EvaluationError::DivisionByZero { at }),
    };
    // A power may vanish where its base does not: by underflow, or where squares are zero.
    match scope.is_zero(&denominator) {
        true => Err(EvaluationError::DivisionByZero { at }),
        false => Ok(F::one() / denominator),
    }
}

#[inline(never)]
fn root<F: Field, S: Scope<F>>(radicand: &Tree, index: u32, at: At, scope: &mut S) -> Value<F, S::Error> {
    let radicand = evaluate(radicand, scope)?;
    let at = at.0;
    scope
        .root(radicand, index)
        .map_err(|error| EvaluationError::Scope { error, at })
}

#[inline(never)]
fn real_power<F: Field, S: Scope<F>>(base: &Tree, exponent: &Tree, at: At, scope: &mut S) -> Value<F, S::Error> {
    let base = evaluate(base, scope)?;
    let exponent = evaluate(exponent, scope)?;
    let at = at.0;
    scope
        .real_power(base, exponent)
        .map_err(|error| EvaluationError::Scope { error, at })
}

#[inline(never)]
fn signed<F: Field, S: Scope<F>>(body: &Tree, plus_above: bool, scope: &mut S) -> Value<F, S::Error> {
    let Some(upper) = scope.upper_sign() else {
        return Err(EvaluationError::Sign { at: place(body) });
    };
    let value: F = evaluate(body, scope)?;
    Ok(if upper == plus_above { value } else { -value })
}

/// The first place known within `tree`.
fn place(tree: &Tree) -> usize {
    match tree {
        Tree::Number(_) => 0,
        Tree::Symbol(_, at)
        | Tree::Call(_, _, at)
        | Tree::Partial { at, .. }
        | Tree::Invariant { at, .. }
        | Tree::Quotient(_, _, at)
        | Tree::Power(_, _, at)
        | Tree::RealPower(_, _, at)
        | Tree::Root(_, _, at)
        | Tree::Operation(_, at) => at.0,
        Tree::Negate(body) | Tree::PlusMinus(body) | Tree::MinusPlus(body) => place(body),
        Tree::Sum(parts) | Tree::Product(parts) => parts
            .iter()
            .find(|part| !matches!(part, Tree::Number(_)))
            .map_or(0, place),
    }
}

#[cfg(test)]
mod tests {
    use super::super::spelled::names;
    use super::super::{read_expression, read_name};
    use super::*;

    /// A scope that knows it all: symbols are 3, functions double, integer roots below 10.
    struct Known(Option<bool>);

    impl Scope<Rational> for Known {
        type Error = Unsupported;

        fn symbol(&mut self, _: &Name) -> Result<Rational, Unsupported> {
            Ok(Rational::from_integer(3))
        }
        fn call(&mut self, _: &Name, argument: &Tree) -> Result<Rational, Unsupported> {
            let value = evaluate(argument, self).map_err(|_| Unsupported::Root)?;
            Ok(value * Rational::from_integer(2))
        }
        fn root(&mut self, radicand: Rational, index: u32) -> Result<Rational, Unsupported> {
            let whole = (0..10).map(Rational::from_integer);
            let index = i32::try_from(index).map_err(|_| Unsupported::Root)?;
            let fits = |root: &Rational| root.to_power(index) == radicand;
            whole.into_iter().find(fits).ok_or(Unsupported::Root)
        }
        fn upper_sign(&self) -> Option<bool> {
            self.0
        }
    }

    fn value(tex: &str, sign: Option<bool>) -> Result<Rational, EvaluationError<Unsupported>> {
        evaluate(&read_expression(tex, &names()).unwrap(), &mut Known(sign))
    }

    #[test]
    fn every_kind_of_node() {
        for (tex, numerator, denominator) in [
            ("a - 1/2 + 0.25", 11, 4),
            ("-a b^2", -27, 1),
            ("a^{-2}", 1, 9),
            ("f(a + 1)", 8, 1),
            (r"\sqrt{a b} - 9^{-1/2}", 8, 3),
            ("0^0", 1, 1),
        ] {
            assert_eq!(value(tex, None).ok(), Rational::new(numerator, denominator), "{tex}");
        }
        for (sign, wanted) in [(true, 2), (false, 4)] {
            assert_eq!(value(r"a \mp 1", Some(sign)), Ok(Rational::from_integer(wanted)));
        }
    }

    #[test]
    fn what_has_no_value_is_placed() {
        let at = |tex: &str| value(tex, None).map_err(|error| error.at());
        assert_eq!(
            value(r"1 + \frac{a}{b - 3}", None),
            Err(EvaluationError::DivisionByZero { at: 4 })
        );
        assert!(matches!(
            value("a + (a - b)^{-1}", None),
            Err(EvaluationError::DivisionByZero { .. })
        ));
        assert_eq!(value(r"1 \pm a", None), Err(EvaluationError::Sign { at: 6 }));
        assert_eq!(at(r"a + \frac{\partial a}{\partial b}"), Err(4));
        assert_eq!(at(r"a + Tr(DP)"), Err(4));
        assert_eq!(at(r"a + \sqrt{2}"), Err(4));
    }

    #[test]
    fn a_table_is_a_scope() {
        let r = read_name("r_B", &names()).unwrap();
        let mut table = BTreeMap::from([(r.clone(), Rational::from_integer(5))]);
        let tree = read_expression("2 r_B + x", &names()).unwrap();
        let error = evaluate(&tree, &mut table).unwrap_err();
        assert_eq!((error.to_string(), error.at()), ("x has no value".to_owned(), 8));
        let mut table = HashMap::from([(r, Rational::from_integer(5))]);
        table.insert(read_name("x", &names()).unwrap(), Rational::from_integer(1));
        assert_eq!(evaluate(&tree, &mut table), Ok(Rational::from_integer(11)));
    }
}
