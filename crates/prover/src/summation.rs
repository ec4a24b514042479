//! The search for sums to infinity: the term as a combination of terms of the table of sums, and of differences of a
//! function. Nothing rests on it: what it proposes is shown by lemmas.

mod convergence;
mod differences;
mod fractions;
mod monomial;

use super::integration::tree::{integer, number, product, quotient, sum, symbol};
use claims::{Multiple, Proposal, Row};
pub use convergence::tests as convergence_tests;
use fractions::{Fraction, Pole};
use monomial::Monomial;
use numbers::{Field, Rational};
use std::collections::BTreeSet;
use texmath::{Name, Operation, Symbols, Tree, any, names_in, number_of, rewrite};

/// The highest degree of a polynomial factor of a term, and the most terms of a sum.
const HIGHEST: i64 = 6;
const MOST_TERMS: usize = 40;

/// Returns a proposal for the terms of a sum over an index that runs from 0 on.
pub fn summation(of: &Tree, index: &Name, _: &Symbols) -> Option<Proposal> {
    let mut terms = Vec::new();
    expanded(of, index, &mut terms)?;
    let (mut rows, mut telescoping) = (Vec::new(), Vec::new());
    for term in terms {
        let own = Term::read(&term, index)?.proposal()?;
        rows.extend(own.rows);
        telescoping.push(own.telescoping);
    }
    rows.retain(|own: &Multiple| number_of(&own.factor) != Some(Rational::from_integer(0)));
    Some(Proposal {
        rows,
        telescoping: sum(telescoping),
    })
}

/// Returns a function of the index whose differences are the terms of a sum.
pub fn telescoping(of: &Tree, index: &Name) -> Option<Tree> {
    differences::telescoping(of, index)
}

/// Returns true if a tree is no polynomial or rational function of the index.
fn is_more(tree: &Tree, index: &Name) -> bool {
    any(tree, &mut |node| match node {
        Tree::RealPower(..) | Tree::Call(..) | Tree::Root(..) | Tree::Operation(..) => node.has_free(index),
        _ => false,
    })
}

/// The terms of a tree, with sums of more than rational functions multiplied out.
fn expanded(tree: &Tree, index: &Name, found: &mut Vec<Tree>) -> Option<()> {
    match tree {
        Tree::Sum(parts) if is_more(tree, index) => parts.iter().try_for_each(|part| expanded(part, index, found))?,
        Tree::Negate(inner) => {
            let mut own = Vec::new();
            expanded(inner, index, &mut own)?;
            found.extend(own.into_iter().map(|term| product(vec![integer(-1), term])));
        }
        Tree::Quotient(above, below, _) => {
            let mut own = Vec::new();
            expanded(above, index, &mut own)?;
            found.extend(own.into_iter().map(|term| quotient(term, (**below).clone())));
        }
        Tree::Product(factors) => {
            let mut all = vec![Vec::new()];
            for factor in factors {
                let mut own = Vec::new();
                expanded(factor, index, &mut own)?;
                let with = |known: &Vec<Tree>, term: &Tree| known.iter().chain([term]).cloned().collect::<Vec<_>>();
                all = all
                    .iter()
                    .flat_map(|known| own.iter().map(|term| with(known, term)))
                    .collect();
                if all.len() > MOST_TERMS {
                    return None;
                }
            }
            found.extend(all.into_iter().map(product));
        }
        tree => found.push(tree.clone()),
    }
    (found.len() <= MOST_TERMS).then_some(())
}

/// The tree at a value of the index, a number where it is written with numbers.
fn at(tree: &Tree, index: &Name, value: i64) -> Tree {
    let there = rewrite(tree, &|name| (name == index).then(|| integer(value)));
    number_of(&there).map_or(there, |value| number(&value))
}

/// The factor and the offset of what is linear in the index with whole coefficients.
fn linear(tree: &Tree, index: &Name) -> Option<(i64, i64)> {
    let value = |k: i64| number_of(&at(tree, index, k))?.to_integer();
    let (zero, one, two, three) = (value(0)?, value(1)?, value(2)?, value(7)?);
    (two - one == one - zero && three == zero + 7 * (one - zero)).then_some((one - zero, zero))
}

/// The number of ways to choose.
fn choose(n: i64, k: i64) -> i64 {
    (0..k).fold(1, |product, j| product * (n - j) / (j + 1))
}

/// A term: powers with the index in the exponent, rational functions of the index, and factorials below.
struct Term<'a> {
    index: &'a Name,
    powers: Monomial,
    above: Vec<Tree>,
    below: Vec<Tree>,
    /// Factor and offset of what there are factorials of, below.
    factorials: Vec<(i64, i64)>,
    /// The offset of central binomial coefficients.
    central: Vec<i64>,
}

impl<'a> Term<'a> {
    fn read(tree: &Tree, index: &'a Name) -> Option<Self> {
        let mut term = Self {
            index,
            powers: Monomial::default(),
            above: Vec::new(),
            below: Vec::new(),
            factorials: Vec::new(),
            central: Vec::new(),
        };
        term.collect(tree, false)?;
        Some(term)
    }

    fn collect(&mut self, tree: &Tree, is_below: bool) -> Option<()> {
        let sign = if is_below { -1 } else { 1 };
        if !tree.has_free(self.index) {
            self.powers.constant(tree, sign);
            return Some(());
        }
        match tree {
            Tree::Negate(inner) => {
                self.powers.constant(&integer(-1), 1);
                self.collect(inner, is_below)
            }
            Tree::Product(factors) => factors.iter().try_for_each(|factor| self.collect(factor, is_below)),
            Tree::Quotient(above, below, _) => {
                self.collect(above, is_below)?;
                self.collect(below, !is_below)
            }
            Tree::Power(base, exponent @ -8..=8, _) => {
                let is_below = is_below != (*exponent < 0);
                (0..exponent.unsigned_abs()).try_for_each(|_| self.collect(base, is_below))
            }
            Tree::RealPower(base, exponent, _) if !base.has_free(self.index) => {
                self.power(base, exponent, sign);
                Some(())
            }
            Tree::Call(name, argument, _) if name.base == "\\exp" => {
                let euler = Tree::Symbol(Name::plain("e"), texmath::At::default());
                self.power(&euler, argument, sign);
                Some(())
            }
            Tree::Call(name, argument, _) if name.base == "\\factorial" && is_below => {
                self.factorials.push(linear(argument, self.index)?);
                Some(())
            }
            Tree::Operation(operation, _) => match &**operation {
                Operation::Binomial(of, chosen) => self.binomial(of, chosen, is_below),
                _ => None,
            },
            tree if is_more(tree, self.index) => None,
            tree => {
                let (above, below) = fractions::quotient_of(tree);
                let (above, below) = if is_below { (below, above) } else { (above, below) };
                self.above.push(above);
                if number_of(&below) != Some(Rational::from_integer(1)) {
                    self.below.push(below);
                }
                Some(())
            }
        }
    }

    fn power(&mut self, base: &Tree, exponent: &Tree, sign: i64) {
        match linear(exponent, self.index) {
            Some((slope, offset)) => self.powers.with(base, sign * slope, sign * offset),
            None => {
                let start = at(exponent, self.index, 0);
                let slope = sum(vec![
                    at(exponent, self.index, 1),
                    product(vec![integer(-1), start.clone()]),
                ]);
                self.powers.with_letters(base, slope, start, sign);
            }
        }
    }

    fn binomial(&mut self, of: &Tree, chosen: &Tree, is_below: bool) -> Option<()> {
        let below = number_of(chosen).and_then(|chosen| chosen.to_integer());
        if let Some(chosen @ 0..=HIGHEST) = below {
            for less in 0..chosen {
                self.collect(&sum(vec![of.clone(), integer(-less)]), is_below)?;
                self.collect(&integer(less + 1), !is_below)?;
            }
            return Some(());
        }
        match (linear(of, self.index)?, linear(chosen, self.index)?) {
            ((2, twice), (1, offset)) if twice == 2 * offset && !is_below => self.central.push(offset),
            _ => return None,
        }
        Some(())
    }

    fn proposal(&self) -> Option<Proposal> {
        let rows = match (self.factorials.as_slice(), self.central.as_slice()) {
            ([], []) if self.below.is_empty() => self.geometric()?,
            ([], []) => return self.rational(),
            ([], [offset]) if self.above.is_empty() && self.below.is_empty() => {
                vec![self.multiple(self.powers.shifted(*offset), Row::CentralBinomial, *offset)]
            }
            ([(1, offset)], []) => self.exponential(*offset)?,
            ([(2, offset)], []) if self.above.is_empty() && self.below.is_empty() => {
                let half = offset.div_euclid(2);
                match offset.rem_euclid(2) {
                    0 => {
                        let (x, is_negative) = self.powers.root()?;
                        let row = if is_negative {
                            Row::Cosine
                        } else {
                            Row::HyperbolicCosine
                        };
                        let sign = if is_negative && half % 2 != 0 { -1 } else { 1 };
                        let factor = product(vec![integer(sign), self.powers.shifted_size(half)]);
                        vec![Multiple {
                            factor,
                            row,
                            x,
                            shift: half,
                        }]
                    }
                    _ => vec![self.odd(half, integer(1), Row::Sine, Row::HyperbolicSine)?],
                }
            }
            _ => return None,
        };
        Some(Proposal {
            rows,
            telescoping: integer(0),
        })
    }

    fn multiple(&self, factor: Tree, row: Row, shift: i64) -> Multiple {
        Multiple {
            factor,
            row,
            x: self.powers.step(),
            shift,
        }
    }

    /// A row of odd powers of the root of what the powers grow by, with alternating signs or not, times a number.
    fn odd(&self, half: i64, by: Tree, alternating: Row, other: Row) -> Option<Multiple> {
        let (x, is_negative) = self.powers.root()?;
        let sign = if is_negative && half % 2 != 0 { -1 } else { 1 };
        let factor = product(vec![integer(sign), by, self.powers.shifted_by_root(2 * half + 1)?]);
        let row = if is_negative { alternating } else { other };
        Some(Multiple {
            factor,
            row,
            x,
            shift: half,
        })
    }

    /// The value of the polynomial factor.
    fn factor_at(&self, value: i64) -> Tree {
        let factors = self.above.iter().map(|factor| at(factor, self.index, value));
        let value = product(factors.collect());
        number_of(&value).map_or(value, |value| number(&value))
    }

    /// The differences of the polynomial factor of each order, by the places and weights that `of` gives.
    fn differences(&self, of: &dyn Fn(i64, i64) -> (i64, i64)) -> Option<Vec<Tree>> {
        let difference = |order: i64| {
            let terms = (0..=order).map(|j| {
                let (weight, place) = of(order, j);
                product(vec![integer(weight), self.factor_at(place)])
            });
            let tree = sum(terms.collect());
            number_of(&tree).map_or(tree, |value| number(&value))
        };
        let mut all: Vec<Tree> = (0..=HIGHEST + 2).map(difference).collect();
        let is_zero = |tree: &Tree| {
            let seed =
                |name: &Name| 0.4 + f64::from(name.to_string().bytes().map(u32::from).sum::<u32>() % 101) / 101.0;
            super::integration::tree::value(tree, &seed).is_some_and(|value| value.abs() < 1e-9)
        };
        let degree = all.iter().rposition(|tree| !is_zero(tree))?;
        all.truncate(degree + 1);
        (i64::try_from(degree).ok()? <= HIGHEST).then_some(all)
    }

    /// A polynomial times powers, by the polynomials `\binom{k + i}{i}`.
    fn geometric(&self) -> Option<Vec<Multiple>> {
        let backward = |order: i64, j: i64| (if j % 2 == 0 { 1 } else { -1 } * choose(order, j), -1 - j);
        let factors = self.differences(&backward)?;
        let constant = self.powers.shifted(0);
        let rows = (0..)
            .zip(factors)
            .map(|(order, factor)| self.multiple(product(vec![constant.clone(), factor]), Row::Geometric(order), 0));
        Some(rows.collect())
    }

    /// A polynomial times powers over the factorial of `k + offset`, by the falling powers of that.
    fn exponential(&self, offset: i64) -> Option<Vec<Multiple>> {
        if !self.below.is_empty() {
            let (above, offset) = fractions::over_factorial(&self.above, &self.below, self.index, offset)?;
            let own = Self {
                index: self.index,
                powers: self.powers.clone(),
                above: vec![above],
                below: Vec::new(),
                factorials: Vec::new(),
                central: Vec::new(),
            };
            return own.exponential(offset);
        }
        let forward = |order: i64, j: i64| {
            let sign = if (order - j) % 2 == 0 { 1 } else { -1 };
            (sign * choose(order, j), j - offset)
        };
        let factors = self.differences(&forward)?;
        let constant = self.powers.shifted(offset);
        let rows = (0..).zip(factors).map(|(order, factor)| {
            let below = integer((1..=order).product());
            let factor = product(vec![constant.clone(), quotient(factor, below)]);
            self.multiple(factor, Row::Exponential(order), offset)
        });
        Some(rows.collect())
    }

    /// A rational function times powers, by its partial fractions.
    fn rational(&self) -> Option<Proposal> {
        let Some(Fraction { whole, poles }) = fractions::partial(&self.above, &self.below, self.index) else {
            return self.beside_a_letter();
        };
        let (mut rows, mut open) = (Vec::new(), Vec::new());
        if !whole.is_empty() {
            let polynomial = Self {
                index: self.index,
                powers: self.powers.clone(),
                above: vec![fractions::tree(&whole, self.index)],
                below: Vec::new(),
                factorials: Vec::new(),
                central: Vec::new(),
            };
            rows.extend(polynomial.geometric()?);
        }
        for pole in poles {
            match self.of_pole(&pole) {
                Some(multiple) => rows.push(multiple),
                None => open.push(pole),
            }
        }
        let is_one = self.powers.number() == Some(Rational::from_integer(1));
        if !open.is_empty() && !is_one {
            return None;
        }
        let constant = self.powers.shifted(0);
        if let Some((factor, shift)) = fractions::balanced(&mut open) {
            let factor = product(vec![constant.clone(), number(&factor)]);
            rows.push(Multiple {
                factor,
                row: Row::Harmonic,
                x: integer(1),
                shift,
            });
        }
        let telescoping = fractions::telescoped(&open, self.index)?;
        Some(Proposal {
            rows,
            telescoping: product(vec![constant, telescoping]),
        })
    }

    /// A rational function of the index and a letter added up, that telescopes.
    fn beside_a_letter(&self) -> Option<Proposal> {
        let mut names = BTreeSet::new();
        self.above
            .iter()
            .chain(&self.below)
            .for_each(|tree| names_in(tree, &mut names));
        let mut others = names.into_iter().filter(|name| name != self.index);
        let letter = others.next().filter(|_| others.next().is_none())?;
        let at_zero = |trees: &[Tree]| -> Vec<Tree> {
            let trees = trees.iter();
            trees
                .map(|tree| rewrite(tree, &|name| (*name == letter).then(|| integer(0))))
                .collect()
        };
        let Fraction { whole, poles } = fractions::partial(&at_zero(&self.above), &at_zero(&self.below), self.index)?;
        if !whole.is_empty() || self.powers.number() != Some(Rational::from_integer(1)) {
            return None;
        }
        let telescoping = fractions::telescoped(&poles, self.index)?;
        let together = sum(vec![symbol(self.index), symbol(&letter)]);
        let telescoping = rewrite(&telescoping, &|name| (name == self.index).then(|| together.clone()));
        Some(Proposal {
            rows: Vec::new(),
            telescoping: product(vec![self.powers.shifted(0), telescoping]),
        })
    }

    /// `r/(k + s)^p` times powers, where the table has its sum.
    fn of_pole(&self, pole: &Pole) -> Option<Multiple> {
        let power = pole.order;
        let twice = (pole.shift.clone() * Rational::from_integer(2)).to_integer()?;
        let (half, is_odd) = (twice.div_euclid(2), twice.rem_euclid(2) == 1);
        let scaled = |by: i64| number(&(pole.factor.clone() * Rational::from_integer(by)));
        let sign = |exponent: i64| if exponent.rem_euclid(2) == 0 { 1 } else { -1 };
        let doubled = 1_i64.checked_shl(u32::try_from(power).ok()?)?;
        let plain = self.powers.shifted(0);
        let of_numbers = |factor: i64, row: Row| {
            let factor = product(vec![plain.clone(), scaled(factor)]);
            Multiple {
                factor,
                row,
                x: integer(1),
                shift: half,
            }
        };
        let grows_by = self.powers.number().and_then(|value| value.to_integer());
        Some(match (grows_by, is_odd, power) {
            (Some(1), false, 2 | 4 | 6) => of_numbers(1, Row::Zeta(power)),
            (Some(1), true, 2 | 4) => of_numbers(doubled, Row::Odd(power)),
            (Some(1), ..) => return None,
            (Some(-1), false, 2 | 4) => of_numbers(sign(half + 1), Row::Alternating(power)),
            (Some(-1), true, 1 | 3) => of_numbers(doubled * sign(half), Row::AlternatingOdd(power)),
            (_, false, 1) => {
                let factor = product(vec![scaled(1), self.powers.shifted(half)]);
                self.multiple(factor, Row::Logarithm, half)
            }
            (_, true, 1) => self.odd(half, scaled(2), Row::Arctangent, Row::AreaTangent)?,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Names, read_expression};

    fn rows(tex: &str) -> Option<Vec<Row>> {
        let names = Names::default();
        let of = read_expression(tex, &names).ok()?;
        let found = summation(&of, &Name::plain("k"), &Symbols::default())?;
        Some(found.rows.iter().map(|own| own.row).collect())
    }

    #[test]
    fn terms_are_found_in_the_table() {
        assert_eq!(rows(r"\frac{1}{3^k}"), Some(vec![Row::Geometric(0)]));
        assert_eq!(rows(r"(k + 1) x^k"), Some(vec![Row::Geometric(1)]));
        assert_eq!(rows(r"\frac{1}{(k + 1)^2}"), Some(vec![Row::Zeta(2)]));
        assert_eq!(rows(r"\frac{(-1)^k x^{2k + 1}}{2k + 1}"), Some(vec![Row::Arctangent]));
        assert_eq!(rows(r"\frac{1}{(k + 1)(k + 2)}"), Some(vec![]));
        assert_eq!(rows(r"\frac{1}{k + 1} - \frac{1}{k + 2}"), Some(vec![]));
        assert_eq!(rows(r"\frac{1}{k + 1}"), Some(vec![Row::Harmonic]));
        assert_eq!(rows(r"\frac{1}{(k + 1)^3}"), None);
    }
}
