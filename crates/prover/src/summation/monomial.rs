//! Powers of what does not move, with exponents that are linear in an index: `\prod b^{s k + o}`.

use super::super::integration::tree::{integer, number, power, product, quotient, real_power, root, square_root, sum};
use numbers::{Field, Rational};
use texmath::{Tree, number_of};

/// A base with a whole factor of the index and an offset in its exponent.
type Power = (Tree, i64, i64);

/// The product of powers; `-1` and other numbers are bases like letters.
#[derive(Clone, Debug, Default)]
pub(super) struct Monomial {
    powers: Vec<Power>,
    /// Bases with other factors and offsets.
    others: Vec<(Tree, Tree, Tree)>,
}

/// The base to a whole power.
fn to_power(base: &Tree, exponent: i64) -> Tree {
    let size = power(base.clone(), u32::try_from(exponent.unsigned_abs()).unwrap_or(u32::MAX));
    match exponent < 0 {
        true => quotient(integer(1), size),
        false => size,
    }
}

fn tidy(tree: Tree) -> Tree {
    number_of(&tree).map_or(tree, |value| number(&value))
}

/// Numbers as one, and the rest as it is.
fn joined(factors: Vec<Tree>) -> Tree {
    let (numbers, rest): (Vec<Tree>, Vec<Tree>) = factors.into_iter().partition(|tree| number_of(tree).is_some());
    product(std::iter::once(tidy(product(numbers))).chain(rest).collect())
}

impl Monomial {
    pub(super) fn constant(&mut self, tree: &Tree, sign: i64) {
        match tree {
            Tree::Product(factors) => factors.iter().for_each(|factor| self.constant(factor, sign)),
            Tree::Negate(inner) => {
                self.with(&integer(-1), 0, 1);
                self.constant(inner, sign);
            }
            Tree::Quotient(above, below, _) => {
                self.constant(above, sign);
                self.constant(below, -sign);
            }
            Tree::Power(base, exponent, _) => self.with(base, 0, sign * i64::from(*exponent)),
            tree => self.with(tree, 0, sign),
        }
    }

    /// Multiplies by a base to the power of the slope times the index and the offset.
    pub(super) fn with(&mut self, base: &Tree, slope: i64, offset: i64) {
        match base {
            Tree::Product(factors) => factors.iter().for_each(|factor| self.with(factor, slope, offset)),
            Tree::Negate(inner) if number_of(inner) != Some(Rational::from_integer(1)) => {
                self.with(&integer(-1), slope, offset);
                self.with(inner, slope, offset);
            }
            Tree::Quotient(above, below, _) => {
                self.with(above, slope, offset);
                self.with(below, -slope, -offset);
            }
            Tree::Power(inner, exponent, _) => {
                self.with(inner, slope * i64::from(*exponent), offset * i64::from(*exponent));
            }
            base => match self.powers.iter_mut().find(|(known, ..)| known == base) {
                Some((_, own, start)) => {
                    *own += slope;
                    *start += offset;
                }
                None => self.powers.push((base.clone(), slope, offset)),
            },
        }
    }

    pub(super) fn with_letters(&mut self, base: &Tree, slope: Tree, offset: Tree, sign: i64) {
        let signed = |tree: Tree| product(vec![integer(sign), tree]);
        self.others.push((base.clone(), signed(slope), signed(offset)));
    }

    /// Returns the factor of the powers from an index to the next.
    pub(super) fn step(&self) -> Tree {
        let powers = self.powers.iter().map(|(base, slope, _)| to_power(base, *slope));
        let others = self
            .others
            .iter()
            .map(|(base, slope, _)| real_power(base.clone(), slope.clone()));
        joined(powers.chain(others).collect())
    }

    pub(super) fn number(&self) -> Option<Rational> {
        number_of(&self.step())
    }

    /// The factor that the powers have beside those of the step to the power k + shift.
    pub(super) fn shifted(&self, shift: i64) -> Tree {
        self.beside(&|slope| slope * shift, shift, true)
    }

    /// The same for the step without its sign.
    pub(super) fn shifted_size(&self, shift: i64) -> Tree {
        self.beside(&|slope| slope * shift, shift, false)
    }

    fn beside(&self, less: &dyn Fn(i64) -> i64, shift: i64, with_sign: bool) -> Tree {
        let minus_one = integer(-1);
        let powers = self
            .powers
            .iter()
            .map(|(base, slope, offset)| match *base == minus_one && !with_sign {
                true => to_power(base, *offset),
                false => to_power(base, offset - less(*slope)),
            });
        let others = self.others.iter().map(|(base, slope, offset)| {
            let exponent = sum(vec![offset.clone(), product(vec![integer(-shift), slope.clone()])]);
            match number_of(&exponent) == Some(Rational::from_integer(0)) {
                true => integer(1),
                false => real_power(base.clone(), exponent),
            }
        });
        joined(powers.chain(others).collect())
    }

    /// The sizes of the bases but for numbers, and what the numbers together grow by.
    fn sizes(&self) -> Option<(Vec<&Power>, Rational)> {
        let one = || Rational::from_integer(1);
        let (numbers, letters): (Vec<_>, Vec<_>) = self.powers.iter().partition(|(base, ..)| number_of(base).is_some());
        let size = numbers.iter().try_fold(one(), |size, (base, slope, _)| {
            let value = number_of(&to_power(base, *slope))?;
            Some(
                size * if value < Rational::from_integer(0) {
                    -value
                } else {
                    value
                },
            )
        })?;
        self.others.is_empty().then_some((letters, size))
    }

    /// The number whose square is the step without its sign, and whether that is minus.
    pub(super) fn root(&self) -> Option<(Tree, bool)> {
        let (letters, size) = self.sizes()?;
        let is_negative = |(base, slope, _): &&Power| {
            slope % 2 != 0 && number_of(base).is_some_and(|value| value < Rational::from_integer(0))
        };
        let is_negative = self.powers.iter().filter(is_negative).count() % 2 == 1;
        let roots = letters.iter().map(|(base, slope, _)| match slope % 2 {
            0 => to_power(base, slope / 2),
            _ => to_power(&root(base.clone(), 2), *slope),
        });
        Some((joined(roots.chain([square_root(&size)]).collect()), is_negative))
    }

    /// The factor that the powers have beside those of the root of the step to the power 2 k + shift, without the sign of
    /// the step.
    pub(super) fn shifted_by_root(&self, shift: i64) -> Option<Tree> {
        let (letters, size) = self.sizes()?;
        let letters = letters.iter().map(|(base, slope, offset)| match slope % 2 {
            0 => to_power(base, offset - slope / 2 * shift),
            _ => product(vec![
                to_power(base, *offset),
                to_power(&root(base.clone(), 2), -slope * shift),
            ]),
        });
        let numbers = self.powers.iter().filter(|(base, ..)| number_of(base).is_some());
        let numbers = numbers.map(|(base, _, offset)| to_power(base, *offset));
        let by_root = to_power(&square_root(&size), -shift);
        Some(joined(letters.chain(numbers).chain([by_root]).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{At, Name};

    #[test]
    fn what_stands_before_the_powers_of_the_step_has_no_power_that_cancels() {
        let x = Tree::Symbol(Name::plain("x"), At::default());
        let mut own = Monomial::default();
        own.with(&integer(-1), 1, 1);
        own.with(&x, 1, 1);
        assert_eq!(own.shifted(1), integer(1));
        assert_eq!(own.step(), product(vec![integer(-1), x]));
    }
}
