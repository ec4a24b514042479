//! Infinite sums of known value, a table with sources; the DLMF is the NIST Digital Library of Mathematical Functions.

use super::build::{
    call, difference, integer, negative, plain, power, product, quotient, real_power, root, sum, symbol,
};
use super::factorial::FACTORIAL;
use numbers::Rational;
use texmath::{At, Equation, Operation, Relation, Tree};

/// A row of the table: a sum over k from the first index of the row to infinity, with a number x in its terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// `\binom{k + i}{i} x^k` is `(1 - x)^{-i-1}` (DLMF 4.6.7).
    Geometric(i64),
    /// `k (k - 1) ... (k - i + 1) x^k/k!` is `x^i e^x` (DLMF 4.2.19, differentiated i times).
    Exponential(i64),
    /// `(-1)^k x^{2k+1}/(2k+1)!` (DLMF 4.19.1).
    Sine,
    /// `(-1)^k x^{2k}/(2k)!` (DLMF 4.19.2).
    Cosine,
    /// `x^{2k+1}/(2k+1)!` (DLMF 4.33.1).
    HyperbolicSine,
    /// `x^{2k}/(2k)!` (DLMF 4.33.2).
    HyperbolicCosine,
    /// `x^k/k` is `-\ln(1 - x)` (DLMF 4.6.1).
    Logarithm,
    /// `(-1)^k x^{2k+1}/(2k+1)` is `\arctan x` (DLMF 4.24.3).
    Arctangent,
    /// `x^{2k+1}/(2k+1)` is half the logarithm of `(1+x)/(1-x)` (DLMF 4.6.1 at x and -x).
    AreaTangent,
    /// `\binom{2k}{k} x^k` is `1/\sqrt{1 - 4x}` (DLMF 4.6.7 with the exponent -1/2).
    CentralBinomial,
    /// `1/k`, of which the sum diverges (Apostol, Calculus, volume 1, section 10.5).
    Harmonic,
    /// `1/k^p` with an even p (DLMF 25.6.1).
    Zeta(i64),
    /// `(-1)^{k+1}/k^p` with an even p (DLMF 25.2.3, 25.6.1).
    Alternating(i64),
    /// `1/(2k+1)^p` with an even p (DLMF 25.2.2, 25.6.1).
    Odd(i64),
    /// `(-1)^k/(2k+1)^p` with an odd p (Abramowitz and Stegun, 23.2.21 and 23.2.22).
    AlternatingOdd(i64),
}

fn ratio(above: i64, below: i64) -> Tree {
    Tree::Number(Rational::new(above, below).unwrap_or(Rational(0.into())))
}

fn whole_power(base: Tree, exponent: i64) -> Tree {
    power(base, i32::try_from(exponent).unwrap_or(i32::MAX))
}

/// A base to the power `a k + b`; the even powers of a square root are those of its radicand.
fn to_index(base: Tree, factor: i64, index: &Tree, offset: i64) -> Tree {
    match (base, factor) {
        (Tree::Root(radicand, 2, at), 2) => {
            let powers = real_power((*radicand).clone(), index.clone());
            product(vec![whole_power(Tree::Root(radicand, 2, at), offset), powers])
        }
        (base, factor) => {
            let exponent = sum(vec![product(vec![integer(factor), index.clone()]), integer(offset)]);
            real_power(base, exponent)
        }
    }
}

impl Row {
    /// Returns the least index of the sum.
    pub fn first(self) -> i64 {
        match self {
            Self::Logarithm | Self::Harmonic | Self::Zeta(_) | Self::Alternating(_) => 1,
            _ => 0,
        }
    }

    /// Returns the degree of the polynomial that powers are multiplied by; None where the terms are others.
    pub(super) fn order(self) -> Option<i64> {
        match self {
            Self::Geometric(order) => Some(order),
            _ => None,
        }
    }

    /// Returns the term at an index.
    pub(super) fn term(self, index: &Tree, x: &Tree) -> Tree {
        let k = || index.clone();
        let odd = || sum(vec![product(vec![integer(2), k()]), integer(1)]);
        let even = || product(vec![integer(2), k()]);
        let factorial = |tree: Tree| call(FACTORIAL, tree);
        let sign = |offset: i64| to_index(integer(-1), 1, index, offset);
        let odd_power = || to_index(x.clone(), 2, index, 1);
        let even_power = || to_index(x.clone(), 2, index, 0);
        let powers = || to_index(x.clone(), 1, index, 0);
        match self {
            Self::Geometric(i) => {
                let rising = (1..=i).map(|more| quotient(sum(vec![k(), integer(more)]), integer(more)));
                product(rising.chain([powers()]).collect())
            }
            Self::Exponential(i) => {
                let falling = (0..i).map(|less| sum(vec![k(), integer(-less)]));
                quotient(product(falling.chain([powers()]).collect()), factorial(k()))
            }
            Self::Sine => quotient(product(vec![sign(0), odd_power()]), factorial(odd())),
            Self::Cosine => quotient(product(vec![sign(0), even_power()]), factorial(even())),
            Self::HyperbolicSine => quotient(odd_power(), factorial(odd())),
            Self::HyperbolicCosine => quotient(even_power(), factorial(even())),
            Self::Logarithm => quotient(powers(), k()),
            Self::Arctangent => quotient(product(vec![sign(0), odd_power()]), odd()),
            Self::AreaTangent => quotient(odd_power(), odd()),
            Self::CentralBinomial => {
                let binomial = Operation::Binomial(even(), k());
                product(vec![Tree::Operation(Box::new(binomial), At::default()), powers()])
            }
            Self::Harmonic => quotient(integer(1), k()),
            Self::Zeta(p) => quotient(integer(1), whole_power(k(), p)),
            Self::Alternating(p) => quotient(sign(1), whole_power(k(), p)),
            Self::Odd(p) => quotient(integer(1), whole_power(odd(), p)),
            Self::AlternatingOdd(p) => quotient(sign(0), whole_power(odd(), p)),
        }
    }

    /// Returns the value of the sum; None where the table has none.
    pub(super) fn value(self, x: &Tree) -> Option<Tree> {
        let x = || x.clone();
        let less = || difference(integer(1), x());
        let of_pi =
            |above: i64, below: i64, p: i64| product(vec![ratio(above, below), whole_power(symbol(&plain("\\pi")), p)]);
        Some(match self {
            Self::Geometric(i @ 0..=20) => quotient(integer(1), whole_power(less(), i + 1)),
            Self::Exponential(i @ 0..=20) => product(vec![whole_power(x(), i), real_power(symbol(&plain("e")), x())]),
            Self::Sine => call("\\sin", x()),
            Self::Cosine => call("\\cos", x()),
            Self::HyperbolicSine => call("\\sinh", x()),
            Self::HyperbolicCosine => call("\\cosh", x()),
            Self::Logarithm => negative(call("\\ln", less())),
            Self::Arctangent => call("\\arctan", x()),
            Self::AreaTangent => {
                let more = call("\\ln", sum(vec![integer(1), x()]));
                quotient(difference(more, call("\\ln", less())), integer(2))
            }
            Self::CentralBinomial => {
                let radicand = difference(integer(1), product(vec![integer(4), x()]));
                quotient(integer(1), root(radicand))
            }
            Self::Zeta(2) => of_pi(1, 6, 2),
            Self::Zeta(4) => of_pi(1, 90, 4),
            Self::Zeta(6) => of_pi(1, 945, 6),
            Self::Alternating(2) => of_pi(1, 12, 2),
            Self::Alternating(4) => of_pi(7, 720, 4),
            Self::Odd(2) => of_pi(1, 8, 2),
            Self::Odd(4) => of_pi(1, 96, 4),
            Self::AlternatingOdd(1) => of_pi(1, 4, 1),
            Self::AlternatingOdd(3) => of_pi(1, 32, 3),
            _ => return None,
        })
    }

    /// Returns the conditions on x outside of which the sum has no value.
    pub(super) fn region(self, x: &Tree) -> Vec<Equation> {
        let to = |relation: Relation, bound: Tree| Equation {
            relation,
            ..Equation::between(x.clone(), bound)
        };
        let between = |low: Relation, high: Relation, bound: i64| {
            let bound = ratio(1, bound);
            vec![to(low, negative(bound.clone())), to(high, bound)]
        };
        match self {
            Self::Geometric(_) | Self::AreaTangent => between(Relation::Greater, Relation::Less, 1),
            Self::Logarithm => between(Relation::GreaterOrEqual, Relation::Less, 1),
            Self::Arctangent => between(Relation::GreaterOrEqual, Relation::LessOrEqual, 1),
            Self::CentralBinomial => between(Relation::GreaterOrEqual, Relation::Less, 4),
            _ => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::series::guess_at;
    use super::*;
    use texmath::{Name, any, mapped, number_of, rewrite};

    /// The term at a number, with factorials and binomial coefficients as numbers.
    fn term(row: Row, k: i64, x: &Tree) -> f64 {
        let index = Name::plain("k");
        let there = rewrite(&row.term(&symbol(&index), x), &|name| {
            (*name == index).then(|| integer(k))
        });
        let factorial = |n: i64| (1..=n).product::<i64>();
        let there = mapped(&there, &|node| match node {
            Tree::Call(name, argument, _) if name.base == FACTORIAL => {
                Some(integer(factorial(number_of(argument)?.to_integer()?)))
            }
            Tree::Operation(operation, _) => match &**operation {
                Operation::Binomial(of, chosen) => {
                    let of = number_of(of)?.to_integer()?;
                    let chosen = number_of(chosen)?.to_integer()?;
                    let falling: i64 = (0..chosen).map(|less| of - less).product();
                    Some(integer(falling / factorial(chosen)))
                }
                _ => None,
            },
            _ => None,
        });
        assert!(!any(&there, &mut |node| matches!(node, Tree::Operation(..))));
        guess_at(&there, &|_| None).unwrap()
    }

    #[test]
    fn the_terms_of_each_row_add_up_to_its_value() {
        let x = ratio(1, 20);
        let rows = [
            Row::Geometric(0),
            Row::Geometric(2),
            Row::Exponential(0),
            Row::Exponential(2),
            Row::Sine,
            Row::Cosine,
            Row::HyperbolicSine,
            Row::HyperbolicCosine,
            Row::Logarithm,
            Row::Arctangent,
            Row::AreaTangent,
            Row::CentralBinomial,
            Row::Zeta(2),
            Row::Zeta(4),
            Row::Zeta(6),
            Row::Alternating(2),
            Row::Alternating(4),
            Row::Odd(2),
            Row::Odd(4),
            Row::AlternatingOdd(1),
            Row::AlternatingOdd(3),
        ];
        for row in rows {
            let is_slow = matches!(
                row,
                Row::Zeta(_) | Row::Alternating(_) | Row::Odd(_) | Row::AlternatingOdd(_)
            );
            let last = if is_slow { 4000 } else { row.first() + 9 };
            let total: f64 = (row.first()..=last).map(|k| term(row, k, &x)).sum();
            let value = guess_at(&row.value(&x).unwrap(), &|_| None).unwrap();
            let slack = if is_slow { 3e-4 } else { 1e-4 };
            assert!((total - value).abs() < slack, "{row:?}: {total} {value}");
        }
    }
}
