//! Sums to infinity without a closed form: bounds of their values, and divergence to infinity, by tests of convergence.
//!
//! With terms t(k) at k = 0, 1, ..., and u = t or u = -t from an index N on (Apostol, Calculus, volume 1, sections 10.12 to
//! 10.17):
//!
//! - F with F' = u and u' <= 0 on [N, oo): u(k + 1) <= F(k + 1) - F(k) <= u(k). Where F tends to L, the sum of u from N on lies
//!   between L - F(N) and u(N) + L - F(N); where F tends to infinity, so does the sum.
//! - 0 <= u(k) and u(k + 1) <= r u(k) with r < 1: it lies between 0 and u(N)/(1 - r).
//! - u(k) = (-1)^k a(k), where a falls to 0: it lies between 0 and u(N).
//! - u tends to a positive number or to infinity: so does the sum.
//! - |u| <= g, where the sum of g from N on is at most G: it lies between -G and G. u >= g, where that of g is infinite: so
//!   is that of u.
//!
//! A search proposes the test and the bounds. That its conditions hold, and that the bounds are ones, are lemmas.

use super::build::{difference, integer, is_zero, negative, product, quotient, real_power, related, sum, symbol};
use super::derivative::By;
use super::endless::Endless;
use super::evaluate::evaluated;
use super::germ::End;
use super::unbounded::has_value;
use super::{Goal, Proposals, defined};
use numbers::{Field, Rational};
use texmath::{Equation, Name, Relation, Tree, any, rewrite};

/// The most terms that stand before those of a test.
const MOST_BEFORE: i64 = 100;

/// A test of convergence.
#[derive(Clone, Debug)]
pub enum Test {
    /// The terms change their signs and fall to 0 in size: these sizes, with the sign of the first one.
    Alternating(Tree),
    /// Each term is at most this multiple of the one before it.
    Ratio(Rational),
    /// The terms fall, and this is an antiderivative of them.
    Integral(Tree),
    /// The terms do not tend to 0.
    Term,
}

/// A test of a sum whose index runs from 0 on.
#[derive(Clone, Debug)]
pub struct SeriesTest {
    pub test: Test,
    /// The index from which the test applies.
    pub from: i64,
    /// True if it is a test of the terms with the opposite sign.
    pub is_negative: bool,
    /// Terms, to which the test applies, that those of the sum are compared with.
    pub compared: Option<Tree>,
    /// Bounds of the sum; None where it is infinite.
    pub bounds: Option<[Rational; 2]>,
}

impl SeriesTest {
    /// Returns true if all letters of a test are those of the terms.
    fn is_about(&self, sum: &Endless) -> bool {
        let whole = match &self.test {
            Test::Alternating(tree) | Test::Integral(tree) => Some(tree),
            Test::Ratio(_) | Test::Term => None,
        };
        let is_known = |name: &Name| *name == sum.index || sum.of.has_free(name) || texmath::is_constant(name);
        let is_other = |node: &Tree| matches!(node, Tree::Symbol(name, _) if !is_known(name));
        let mut proposed = self.compared.iter().chain(whole);
        !proposed.any(|tree| any(tree, &mut |node| is_other(node)))
    }
}

/// The sum of all terms.
pub(super) enum Tested {
    Between(Box<[Tree; 2]>),
    /// Infinite, and true if it is that above all numbers.
    Infinite(bool),
}

/// Bounds of the sum of terms from an index on; None where it is infinite.
type Rest = Option<[Tree; 2]>;

/// The sum by a test that is proposed.
pub(super) fn tested(sum: &Endless, proposals: &dyn Proposals, lemmas: &mut Vec<Goal>) -> Result<Tested, String> {
    let found = proposals.series_test(&sum.of, &sum.index, &sum.symbols);
    let found = found.ok_or("no test of its convergence is found")?;
    if !(0..=MOST_BEFORE).contains(&found.from) {
        return Err("a test of a sum that applies too late".to_owned());
    }
    if !found.is_about(sum) {
        return Err("a test with letters that the terms do not have".to_owned());
    }
    let signed = |tree: Tree| if found.is_negative { negative(tree) } else { tree };
    let own = Tail {
        sum: sum.beyond(found.from),
        from: found.from,
    };
    let of = signed(sum.of.clone());
    own.everywhere(&of, Vec::new(), lemmas)?;
    let rest = match &found.compared {
        None => own.rest(&of, &found.test, lemmas)?,
        Some(other) => {
            let rest = own.rest(other, &found.test, lemmas)?;
            own.compared(&of, other, rest, lemmas)?
        }
    };
    let before: Vec<Tree> = (0..found.from).map(|k| sum.at(&sum.of, &integer(k))).collect();
    let Some([low, high]) = rest else {
        own.of_numbers(has_value(super::build::sum(before)), lemmas)?;
        return Ok(Tested::Infinite(!found.is_negative));
    };
    let bounds = found.bounds.as_ref().ok_or("a sum that converges, without bounds")?;
    let [low, high] = match found.is_negative {
        true => [negative(high), negative(low)],
        false => [low, high],
    };
    let bounds = bounds.clone().map(|bound| super::series::number(&bound));
    let [below, above] = &bounds;
    let whole = |rest: Tree| super::build::sum(before.iter().cloned().chain([rest]).collect());
    own.of_numbers(related(below.clone(), Relation::LessOrEqual, whole(low)), lemmas)?;
    own.of_numbers(related(whole(high), Relation::LessOrEqual, above.clone()), lemmas)?;
    Ok(Tested::Between(Box::new(bounds)))
}

/// The terms of a sum from an index on.
struct Tail {
    sum: Endless,
    from: i64,
}

impl Tail {
    /// Adds the claim between numbers.
    fn of_numbers(&self, claim: Equation, lemmas: &mut Vec<Goal>) -> Result<(), String> {
        let mut alone = self.sum.within.clone();
        let part = format!("bounds of a sum: {}", claim.relation);
        alone.assume.clear();
        alone.premises.clear();
        alone.claims = vec![claim];
        let evaluated = evaluated(&alone, &self.sum.symbols)?;
        lemmas.push(Goal::of(&evaluated, &self.sum.symbols, part));
        Ok(())
    }

    /// Adds that a function of the index falls, as one of all real numbers from the first index on: its derivative is not positive,
    /// or it is a number that is not negative over a function that rises.
    fn falls(&self, of: &Tree, lemmas: &mut Vec<Goal>) -> Result<(), String> {
        let mut claims = vec![has_value(of.clone())];
        if let Tree::Quotient(above, below, _) = of
            && !above.has_free(&self.sum.index)
        {
            claims.push(related((**above).clone(), Relation::GreaterOrEqual, integer(0)));
            self.rises(below, &mut claims)?;
            return self.sum.at_each_number(claims, self.from, lemmas);
        }
        let slope = self.slope(of)?;
        claims.push(has_value(slope.clone()));
        // a square below does not change the sign
        let sign = match slope {
            Tree::Quotient(above, below, _) if matches!(&*below, Tree::Power(_, 2, _)) => *above,
            slope => slope,
        };
        claims.push(related(sign, Relation::LessOrEqual, integer(0)));
        self.sum.at_each_number(claims, self.from, lemmas)
    }

    /// Adds claims, sufficient together, that a function of the index is positive and rises: then its powers and roots do, and
    /// products of such functions.
    fn rises(&self, of: &Tree, claims: &mut Vec<Equation>) -> Result<(), String> {
        match of {
            Tree::Product(factors) => return factors.iter().try_for_each(|factor| self.rises(factor, claims)),
            Tree::Power(inner, 1.., _) | Tree::Root(inner, ..) => return self.rises(inner, claims),
            _ => claims.push(related(of.clone(), Relation::Greater, integer(0))),
        }
        let slope = self.slope(of)?;
        claims.push(has_value(slope.clone()));
        claims.push(related(slope, Relation::GreaterOrEqual, integer(0)));
        Ok(())
    }

    /// The derivative of a function of the index as one of real numbers.
    fn slope(&self, of: &Tree) -> Result<Tree, String> {
        let (x, symbols) = self.sum.real();
        let there = |tree: &Tree, from: &Name, to: &Name| rewrite(tree, &|name| (name == from).then(|| symbol(to)));
        let by = By {
            symbols: &symbols,
            name: &x,
        };
        let slope = by.of(&there(of, &self.sum.index, &x))?;
        Ok(there(&slope, &x, &self.sum.index))
    }

    /// The sum of a function of the index from the first index on, by a test of it.
    fn rest(&self, of: &Tree, test: &Test, lemmas: &mut Vec<Goal>) -> Result<Rest, String> {
        let first = integer(self.from);
        let own = self.sum.at(of, &first);
        let index = symbol(&self.sum.index);
        match test {
            Test::Ratio(ratio) => {
                let one = Rational::from_integer(1);
                if *ratio >= one || *ratio < Rational::from_integer(0) {
                    return Err("a ratio that is not below 1".to_owned());
                }
                let next = self.sum.at(of, &sum(vec![index, integer(1)]));
                let mut claims = vec![related(of.clone(), Relation::GreaterOrEqual, integer(0))];
                claims.extend(at_most(&next, &super::series::number(ratio), of));
                self.everywhere(&next, claims, lemmas)?;
                let most = quotient(own, super::series::number(&(one - ratio.clone())));
                Ok(Some([integer(0), most]))
            }
            Test::Alternating(sizes) => {
                let signs = real_power(integer(-1), index);
                let terms = Equation::between(of.clone(), product(vec![signs, sizes.clone()]));
                self.sum.at_each_index(vec![terms], lemmas)?;
                self.falls(sizes, lemmas)?;
                match self.sum.limit(sizes, lemmas)? {
                    Some(End::Finite(limit)) if is_zero(&limit) => {}
                    _ => return Err("alternating terms that do not tend to 0".to_owned()),
                }
                Ok(Some(match self.from % 2 == 0 {
                    true => [integer(0), own],
                    false => [own, integer(0)],
                }))
            }
            Test::Integral(whole) => {
                self.falls(of, lemmas)?;
                let slope = Equation::between(self.slope(whole)?, of.clone());
                self.sum
                    .at_each_number(vec![has_value(whole.clone()), slope], self.from, lemmas)?;
                match self.sum.limit(whole, lemmas)? {
                    Some(End::Finite(limit)) => {
                        let low = difference(*limit, self.sum.at(whole, &first));
                        Ok(Some([low.clone(), sum(vec![own, low])]))
                    }
                    Some(End::Infinite(true)) => Ok(None),
                    _ => Err("an integral test without a limit".to_owned()),
                }
            }
            Test::Term => match self.sum.limit(of, lemmas)? {
                Some(End::Finite(limit)) if !is_zero(&limit) => {
                    let claim = related(*limit, Relation::Greater, integer(0));
                    lemmas.extend(self.sum.lemmas_of(vec![claim]));
                    Ok(None)
                }
                Some(End::Infinite(true)) => Ok(None),
                _ => Err("terms without a positive limit".to_owned()),
            },
        }
    }

    /// The sum of terms that are compared with others, whose sum is known.
    fn compared(&self, of: &Tree, other: &Tree, rest: Rest, lemmas: &mut Vec<Goal>) -> Result<Rest, String> {
        let (one, is_infinite) = (integer(1), rest.is_none());
        let claims = match is_infinite {
            true => at_most(other, &one, of),
            false => [of.clone(), negative(of.clone())]
                .iter()
                .flat_map(|of| at_most(of, &one, other))
                .collect(),
        };
        self.everywhere(other, claims, lemmas)?;
        Ok(rest.map(|[_, most]| [negative(most.clone()), most]))
    }

    /// Adds that a function of the index has a value and claims hold at each number, or integer, from the first index on.
    fn everywhere(&self, of: &Tree, claims: Vec<Equation>, lemmas: &mut Vec<Goal>) -> Result<(), String> {
        let of_integers = |claim: &Equation| {
            [&claim.left, &claim.right]
                .into_iter()
                .any(|side| self.sum.needs_integers(side))
        };
        if !self.sum.needs_integers(of) && !claims.iter().any(of_integers) {
            let all = std::iter::once(has_value(of.clone())).chain(claims).collect();
            return self.sum.at_each_number(all, self.from, lemmas);
        }
        let mut all = defined::conditions(of, &self.sum.symbols)?;
        all.extend(claims);
        self.sum.at_each_index(all, lemmas)
    }
}

/// Claims, sufficient together, that a tree is at most a multiple of another one: of quotients, whose denominators are
/// positive, without these.
fn at_most(of: &Tree, factor: &Tree, other: &Tree) -> Vec<Equation> {
    let parts = |tree: &Tree| match tree {
        Tree::Quotient(above, below, _) => Some(((**above).clone(), (**below).clone())),
        Tree::Negate(inner) => match &**inner {
            Tree::Quotient(above, below, _) => Some((negative((**above).clone()), (**below).clone())),
            _ => None,
        },
        _ => None,
    };
    match (parts(of), parts(other)) {
        (Some((above, below)), Some((other_above, other_below))) => {
            let positive = |tree: &Tree| related(tree.clone(), Relation::Greater, integer(0));
            let mut claims = vec![positive(&below), positive(&other_below)];
            claims.extend(match (&below, &other_below) {
                (below, other_below) if below == other_below => vec![related(
                    above,
                    Relation::LessOrEqual,
                    product(vec![factor.clone(), other_above]),
                )],
                // powers with one exponent, which is not negative, are in the order of their bases
                (Tree::RealPower(base, exponent, _), Tree::RealPower(other_base, other, _))
                    if exponent == other && above == other_above && *factor == integer(1) =>
                {
                    vec![
                        related(above, Relation::GreaterOrEqual, integer(0)),
                        related((**exponent).clone(), Relation::GreaterOrEqual, integer(0)),
                        positive(other_base),
                        related((**other_base).clone(), Relation::LessOrEqual, (**base).clone()),
                    ]
                }
                _ => vec![related(
                    product(vec![above, other_below]),
                    Relation::LessOrEqual,
                    product(vec![factor.clone(), other_above, below]),
                )],
            });
            claims
        }
        _ => vec![related(
            of.clone(),
            Relation::LessOrEqual,
            product(vec![factor.clone(), other.clone()]),
        )],
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::premise::Statements;
    use super::super::build::{plain, power};
    use super::*;
    use texmath::{Operation, Series, Symbols};

    struct Proposed(SeriesTest);

    impl Proposals for Proposed {
        fn series_test(&self, _: &Tree, _: &Name, _: &Symbols) -> Option<SeriesTest> {
            Some(self.0.clone())
        }
    }

    fn index() -> Tree {
        symbol(&Name {
            primes: 1,
            ..plain("k")
        })
    }

    /// The result of a test of the sum of `1/(k+1)^p`, or of the same with alternating signs.
    fn proposed(p: i32, is_alternating: bool, test: SeriesTest) -> Result<(Tested, Vec<Goal>), String> {
        let mut symbols = Symbols::default();
        symbols.let_be_parameter(&plain("k"), false);
        let above = match is_alternating {
            true => real_power(integer(-1), symbol(&plain("k"))),
            false => integer(1),
        };
        let series = Operation::Series {
            kind: Series::Sum,
            of: quotient(above, power(sum(vec![symbol(&plain("k")), integer(1)]), p)),
            index: plain("k"),
            from: integer(0),
            to: Tree::Operation(Box::new(Operation::Infinity), texmath::At::default()),
        };
        let node = Tree::Operation(Box::new(series), texmath::At::default());
        let sum = Endless::read(&node, &Statements::default(), &symbols)?;
        let mut lemmas = Vec::new();
        let found = tested(&sum, &Proposed(test), &mut lemmas)?;
        Ok((found, lemmas))
    }

    fn test(test: Test, is_bounded: bool) -> SeriesTest {
        let bound = |value: i64| Rational::from_integer(value);
        SeriesTest {
            test,
            from: 3,
            is_negative: false,
            compared: None,
            bounds: is_bounded.then(|| [bound(1), bound(2)]),
        }
    }

    /// An antiderivative of 1/(k+1)^2.
    fn whole() -> Tree {
        quotient(integer(-1), sum(vec![index(), integer(1)]))
    }

    #[test]
    fn the_conditions_of_a_test_and_its_bounds_are_lemmas() {
        // one that is none is left to a lemma, which is false
        let twice = product(vec![integer(2), whole()]);
        let (found, lemmas) = proposed(2, false, test(Test::Integral(twice), true)).unwrap();
        assert!(matches!(found, Tested::Between(_)));
        let claims: Vec<String> = lemmas
            .iter()
            .map(|goal| goal.statements.claims[0].to_string())
            .collect();
        for wanted in [" = \\frac{1}{(x + 1)^2}", "x + 1 > 0", "1 \\leq ", "\\leq 2"] {
            assert!(
                claims.iter().any(|claim| claim.contains(wanted)),
                "{wanted}: {claims:?}"
            );
        }
    }

    #[test]
    fn a_test_that_does_not_apply_is_refused() {
        let ratio = |value: i64| Test::Ratio(Rational::from_integer(value));
        let refused = [
            (false, test(ratio(1), true)),
            (false, test(ratio(-1), true)),
            // a sum that converges is not infinite
            (false, test(Test::Integral(whole()), false)),
            (false, test(Test::Term, false)),
            (false, test(Test::Integral(symbol(&plain("x"))), true)),
            // the signs are no function of real numbers
            (true, test(Test::Integral(whole()), true)),
            (
                true,
                test(
                    Test::Alternating(quotient(real_power(integer(-1), index()), integer(2))),
                    true,
                ),
            ),
            // the sizes do not tend to 0
            (true, test(Test::Alternating(integer(1)), true)),
            (
                false,
                SeriesTest {
                    from: -1,
                    ..test(Test::Integral(whole()), true)
                },
            ),
            (
                false,
                SeriesTest {
                    from: 1000,
                    ..test(Test::Integral(whole()), true)
                },
            ),
        ];
        for (is_alternating, own) in refused {
            let printed = format!("{own:?}");
            assert!(proposed(2, is_alternating, own).is_err(), "{printed}");
        }
    }
}
