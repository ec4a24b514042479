//! A search for antiderivatives: substitutions, and one ansatz with undetermined coefficients for what they leave.
//!
//! Nothing rests on what is found: it is shown to be an antiderivative.

mod ansatz;
mod candidates;
mod field;
mod fraction;
mod known;
mod linear;
mod quartics;
mod tangents;
mod tower;
pub(crate) mod tree;
mod waves;
mod zeros;

use crate::algebra::{Steps, degree_in};
use field::Field;
use fraction::Fraction;
use kernel::Term;
use numbers::{Field as _, Rational};
use std::collections::BTreeSet;
use texmath::{Name, Symbols, Tree, any, mapped, names_in, nodes_of, speaks_of, with_symbol};
use tower::{Kind, Tower, VARIABLE, letter};
use tree::{integer, power, product, quotient, sum, symbol, value};

pub use known::known_integral;
pub use zeros::zeros;

/// The steps of one search, and of one attempt in it.
const STEPS: u64 = 1_350_000;

/// The most substitutions within each other.
const DEEPEST: u32 = 4;

/// The points at which integrands are evaluated.
const POINTS: [f64; 12] = [0.31, 0.73, 1.21, 2.3, 4.1, 0.052, 7.7, -0.43, -1.9, -5.3, 23.0, 105.0];

/// The largest difference of numbers that are taken to be equal, and the largest denominator of such a number.
const CLOSE: f64 = 1e-9;
const LARGEST_DENOMINATOR: i64 = 12;

/// The largest integrand, in nodes.
const LARGEST: usize = 400;

/// An antiderivative of `of` by `by`.
pub fn antiderivative(of: &Tree, by: &Name, symbols: &Symbols) -> Option<Tree> {
    antiderivatives(of, by, symbols).into_iter().next()
}

/// Antiderivatives that differ in the signs of what logarithms are of, and of letters, the likeliest first.
pub fn antiderivatives(of: &Tree, by: &Name, symbols: &Symbols) -> Vec<Tree> {
    if nodes_of(of) > LARGEST {
        return Vec::new();
    }
    let of = &in_plain_angles(of, by);
    if let Some(value) = constant(of, by) {
        return vec![product(vec![tree::number(&value), symbol(by)])];
    }
    let mut found = Vec::new();
    for is_reversed in [false, true] {
        let mut search = Search {
            symbols,
            is_reversed,
            steps: Steps::new(STEPS),
        };
        for tree in search.of(of, by, 0).unwrap_or_default() {
            let tree = gathered_powers(&search.sharpened(&tree, of, by), by);
            if !found.contains(&tree) {
                found.push(tree);
            }
        }
        if !has_letters(of, by) || found.is_empty() {
            break;
        }
    }
    found
}

/// The rational number that a tree is at all points at which it has a value, although it speaks of the letter.
fn constant(of: &Tree, by: &Name) -> Option<Rational> {
    if !speaks_of(of, by) {
        return None;
    }
    let at = |point: &f64| value(of, &|name| letter(name, by, *point, false)).filter(|value| value.is_finite());
    let values: Vec<f64> = POINTS.iter().filter_map(at).collect();
    let first = *values.first().filter(|_| values.len() >= 3)?;
    let is_same = |value: f64| (value - first).abs() < CLOSE;
    let nearest = |below: i64| (first * below as f64).round() as i64;
    let below = (1..=LARGEST_DENOMINATOR).find(|below| is_same(nearest(*below) as f64 / *below as f64))?;
    // high powers are close to 0 at all of these
    let is_told = first.abs() > CLOSE || any(of, &mut |node| matches!(node, Tree::Sum(_)));
    let is_constant = is_told && first.abs() < 1e6 && values.into_iter().all(is_same);
    is_constant.then(|| Rational::from_ratio(nearest(below), below))
}

/// True if signs may depend on the values of two letters or more.
fn has_letters(of: &Tree, by: &Name) -> bool {
    let mut names = BTreeSet::new();
    names_in(of, &mut names);
    names.retain(|name| name != by && !matches!(name.base.as_str(), "e" | "\\pi"));
    names.len() > 1
}

struct Search<'a> {
    symbols: &'a Symbols,
    /// True if the numbers taken for letters ascend, where signs are told by numbers, else descend.
    is_reversed: bool,
    steps: Steps,
}

impl Search<'_> {
    fn of(&mut self, tree: &Tree, by: &Name, depth: u32) -> Option<Vec<Tree>> {
        let mut found = self.of_whole(tree, by, depth);
        if let (None, Tree::Sum(terms)) = (&found, tree) {
            let parts = terms.iter().map(|term| self.of_whole(term, by, depth));
            let parts: Option<Vec<Vec<Tree>>> = parts.collect();
            found = parts.map(|parts| added(&parts));
        }
        found
    }

    fn of_whole(&mut self, tree: &Tree, by: &Name, depth: u32) -> Option<Vec<Tree>> {
        let mut tower = Tower::new(by, self.symbols, self.steps.clone());
        tower.is_reversed = self.is_reversed;
        let found = attempt(tree, &mut tower, depth, self);
        self.steps = Steps::new(self.steps.left().min(tower.steps.left()));
        let mut found = found?;
        found.sort_by_key(|whole| !self.is_likely(whole, tree, by));
        let first = found.first()?;
        self.is_likely(first, tree, by).then_some(found)
    }

    /// The tree with the signs of what logarithms are of, where each has one sign wherever the integrand has a value.
    fn sharpened(&self, whole: &Tree, of: &Tree, by: &Name) -> Tree {
        let at = |tree: &Tree, point: f64| {
            value(tree, &|name| letter(name, by, point, self.is_reversed)).filter(|value| value.is_finite())
        };
        mapped(whole, &|node| {
            let Tree::Call(name, argument, _) = node else {
                return None;
            };
            let Tree::Call(absolute, inner, _) = &**argument else {
                return None;
            };
            if name.base != "\\ln" || absolute.base != "\\abs" {
                return None;
            }
            let points = POINTS.iter().filter(|point| at(of, **point).is_some());
            let values: Vec<f64> = points.filter_map(|point| at(inner, *point)).collect();
            match values.as_slice() {
                [] => None,
                values if values.iter().all(|value| *value > 0.0) => Some(tree::call("\\ln", (**inner).clone())),
                values if values.iter().all(|value| *value < 0.0) => {
                    Some(tree::call("\\ln", candidates::opposite((**inner).clone())))
                }
                _ => None,
            }
        })
    }

    /// True if the derivative is the integrand at some points, or at none can be told.
    fn is_likely(&self, whole: &Tree, of: &Tree, by: &Name) -> bool {
        let (mut right, mut wrong, mut is_told) = (0, 0, false);
        for point in POINTS {
            let step = 1e-6 * f64::max(f64::abs(point), 0.1);
            let at = |tree: &Tree, point: f64| {
                value(tree, &|name| letter(name, by, point, self.is_reversed)).filter(|value| value.is_finite())
            };
            let sides = (at(whole, point + step), at(whole, point - step), at(of, point));
            is_told |= sides.2.is_some();
            let (Some(after), Some(before), Some(slope)) = sides else {
                continue;
            };
            let scale = slope.abs() + 1e-9 * (after.abs() + before.abs()) / step + 1e-7;
            match ((after - before) / (2.0 * step) - slope).abs() < 1e-3 * scale {
                true => right += 1,
                false => wrong += 1,
            }
        }
        right > wrong || right >= 3 || !is_told
    }
}

/// The sums of the first ones, of the second ones, and so on.
fn added(parts: &[Vec<Tree>]) -> Vec<Tree> {
    let most = parts.iter().map(Vec::len).max().unwrap_or(0);
    let at = |place: usize| {
        let terms = parts.iter().filter_map(|part| part.get(place).or_else(|| part.last()));
        sum(terms.cloned().collect())
    };
    (0..most).map(at).collect()
}

fn attempt(tree: &Tree, tower: &mut Tower, depth: u32, search: &mut Search) -> Option<Vec<Tree>> {
    let mut apart = Tower::new(tower.by, tower.symbols, tower.steps.clone());
    let found = waves::integrated(tree, &mut apart);
    tower.steps = apart.steps;
    if let Some(whole) = found {
        return Some(vec![whole]);
    }
    by_linear(tree, tower, depth, search).or_else(|| by_reading(tree, tower, depth, search))
}

/// The antiderivative of what is read as a quotient of polynomials in generators.
fn by_reading(tree: &Tree, tower: &mut Tower, depth: u32, search: &mut Search) -> Option<Vec<Tree>> {
    let f = tower.read_all(tree)?;
    if f.is_zero() {
        return Some(vec![integer(0)]);
    }
    if depth < DEEPEST
        && let Some(found) = by_substitution(&f, tower, depth, search)
    {
        return Some(found);
    }
    by_ansatz(&f, tower)
}

/// The letter that a substitution at this depth puts in.
fn fresh(depth: u32) -> Name {
    Name {
        subscript: depth.to_string(),
        ..Name::plain("\\upsilon")
    }
}

/// The antiderivative as a function of a sum that is linear, and the argument of a wave or the base of a high power.
fn by_linear(tree: &Tree, tower: &mut Tower, depth: u32, search: &mut Search) -> Option<Vec<Tree>> {
    let mut met: Option<Tree> = None;
    any(tree, &mut |node| {
        let inner = match node {
            Tree::Call(name, argument, _) if ["\\sin", "\\cos", "\\tan"].contains(&name.base.as_str()) => argument,
            Tree::Power(base, exponent, _) if exponent.abs() > 8 => base,
            _ => return false,
        };
        let is_sum = matches!(**inner, Tree::Sum(_)) && speaks_of(inner, tower.by);
        if is_sum && met.is_none() {
            met = Some((**inner).clone());
        }
        false
    });
    let old = met.filter(|_| depth < DEEPEST)?;
    let mut apart = Tower::new(tower.by, tower.symbols, tower.steps.clone());
    let (constant, slope) = waves::linear(&old, &mut apart)?;
    if constant.is_zero() || slope.is_zero() {
        return None;
    }
    let (constant, slope) = (apart.print(&constant, &[])?, apart.print(&slope, &[])?);
    let name = fresh(depth);
    let new = symbol(&name);
    let variable = quotient(sum(vec![new.clone(), tree::negative(constant)]), slope.clone());
    let inside = mapped(tree, &|node| match node {
        node if *node == old => Some(new.clone()),
        Tree::Symbol(name, _) if name == tower.by => Some(variable.clone()),
        _ => None,
    });
    search.steps = Steps::new(tower.steps.left());
    let found = search.of(&quotient(inside, slope), &name, depth + 1);
    tower.steps = Steps::new(search.steps.left());
    Some(
        found?
            .iter()
            .map(|whole| tidied(&with_symbol(whole, &name, &old)))
            .collect(),
    )
}

fn by_ansatz(f: &Fraction, tower: &mut Tower) -> Option<Vec<Tree>> {
    tower.is_turned = false;
    let f = tower.normal(f)?;
    Field::of(&f, tower)?.integrated(tower)
}

/// The antiderivative as a function of one generator, of a power of the variable, or of a root of what is linear.
fn by_substitution(f: &Fraction, tower: &mut Tower, depth: u32, search: &mut Search) -> Option<Vec<Tree>> {
    let fresh = fresh(depth);
    let new = symbol(&fresh);
    let count = u32::try_from(tower.kinds.len()).ok()?;
    for term in (1..count).rev().map(Term) {
        if matches!(tower.kind(term), Kind::Unknown(..) | Kind::Constant(_)) {
            continue;
        }
        let Some((tree, old)) = by_generator(f, term, &new, tower) else {
            continue;
        };
        search.steps = Steps::new(tower.steps.left());
        let found = search.of(&tree, &fresh, depth + 1);
        tower.steps = Steps::new(search.steps.left());
        if let Some(found) = found {
            return Some(
                found
                    .iter()
                    .map(|whole| tidied(&with_symbol(whole, &fresh, &old)))
                    .collect(),
            );
        }
    }
    if is_simple(f, tower) {
        return None;
    }
    for exponent in (2..=8_u32).rev() {
        let less = Fraction::generator(VARIABLE).power(1 - i32::try_from(exponent).ok()?, &mut tower.steps)?;
        let g = f
            .times(&less, &mut tower.steps)?
            .scaled(&Rational::from_ratio(1, i64::from(exponent)));
        let Some(tree) = tower.print(&g, &[(VARIABLE, exponent, new.clone())]) else {
            continue;
        };
        search.steps = Steps::new(tower.steps.left());
        let found = search.of(&tree, &fresh, depth + 1);
        tower.steps = Steps::new(search.steps.left());
        if let Some(found) = found {
            let old = power(symbol(tower.by), exponent);
            return Some(
                found
                    .iter()
                    .map(|whole| tidied(&with_symbol(whole, &fresh, &old)))
                    .collect(),
            );
        }
    }
    None
}

/// The tree with powers of powers, and logarithms of exponentials, taken together.
fn tidied(tree: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Power(base, exponent, at) => match tidied(base) {
            Tree::Power(inner, other, _) => Some(Tree::Power(inner, exponent.checked_mul(other)?, *at)),
            Tree::RealPower(inner, other, _) => {
                let exponent = product(vec![integer(i64::from(*exponent)), *other]);
                Some(Tree::RealPower(inner, Box::new(exponent), *at))
            }
            Tree::Root(inner, index, _) if *exponent > 0 && exponent.unsigned_abs() == index => Some(*inner),
            _ => None,
        },
        Tree::Call(name, argument, _) if name.base == "\\ln" => match tidied(argument) {
            Tree::RealPower(base, exponent, _) if matches!(&*base, Tree::Symbol(name, _) if name.base == "e") => {
                Some(*exponent)
            }
            _ => None,
        },
        _ => None,
    })
}

/// The tree with sines and cosines of a letter and quarter turns by those of the letter, as `\cos x` for `\sin(\pi/2 - x)`.
fn in_plain_angles(tree: &Tree, by: &Name) -> Tree {
    mapped(tree, &|node| {
        let Tree::Call(name, argument, _) = node else {
            return None;
        };
        let place = ["\\sin", "\\cos"].iter().position(|own| *own == name.base)?;
        let at = |x: f64| value(argument, &|name| letter(name, by, x, false));
        let (phase, slope) = (at(0.0)?, at(1.0)? - at(0.0)?);
        let quarters = phase / std::f64::consts::FRAC_PI_2;
        let is_linear = (at(3.7)? - phase - 3.7 * slope).abs() < 1e-9;
        let is_turned = quarters.abs() > 0.5 && (quarters - quarters.round()).abs() < 1e-9;
        let is_plain = (slope.abs() - slope.abs().round()).abs() < 1e-9 && (0.5..40.0).contains(&slope.abs());
        if !is_linear || !is_turned || !is_plain {
            return None;
        }
        let factor = (1..40_i64).find(|factor| (slope.abs() - *factor as f64).abs() < 0.5)?;
        let inner = product(vec![integer(factor), symbol(by)]);
        // of the sine, k quarters more; of the cosine, one more than that
        let quarters = (0..4).find(|k| {
            (quarters - f64::from(*k))
                .rem_euclid(4.0)
                .min(4.0 - (quarters - f64::from(*k)).rem_euclid(4.0))
                < 0.5
        })?;
        let turned = (quarters + i32::from(place == 1)) % 4;
        let function = if turned % 2 == 0 { "\\sin" } else { "\\cos" };
        let is_negative = (turned >= 2) != (turned % 2 == 0 && slope < 0.0);
        let plain = tree::call(function, inner);
        Some(if is_negative { tree::negative(plain) } else { plain })
    })
}

/// The tree with powers of one base in a product as one, where one of them has an exponent that is no number: `x x^a` is defined
/// at 0 by the sum of the exponents alone.
fn gathered_powers(tree: &Tree, by: &Name) -> Tree {
    mapped(tree, &|node| {
        let Tree::Product(factors) = node else { return None };
        let base = factors.iter().find_map(|factor| match factor {
            Tree::RealPower(base, ..) if speaks_of(base, by) => Some(&**base),
            _ => None,
        })?;
        let exponent_of = |factor: &Tree| match factor {
            factor if factor == base => Some(integer(1)),
            Tree::Power(own, exponent, _) if **own == *base => Some(integer(i64::from(*exponent))),
            Tree::RealPower(own, exponent, _) if **own == *base => Some((**exponent).clone()),
            _ => None,
        };
        let (powers, others): (Vec<&Tree>, Vec<&Tree>) = factors.iter().partition(|own| exponent_of(own).is_some());
        let exponent = sum(powers.into_iter().filter_map(exponent_of).collect());
        let others = gathered_powers(&product(others.into_iter().cloned().collect()), by);
        Some(product(vec![others, tree::real_power(base.clone(), exponent)]))
    })
}

/// Returns a factor and a function whose derivative is a tree plus the factor times another tree.
pub fn reduction_formula(of: &Tree, other: &Tree, by: &Name, symbols: &Symbols) -> Option<[Tree; 2]> {
    if nodes_of(of) > LARGEST {
        return None;
    }
    let free = symbol(&fresh(DEEPEST));
    let mut tower = Tower::new(by, symbols, Steps::new(STEPS));
    let both = sum(vec![of.clone(), product(vec![free.clone(), other.clone()])]);
    let f = tower.read_all(&both)?;
    let free = tower.term_of(Kind::Constant(free));
    let (factor, whole) = Field::of(&f, &mut tower)?.integrated_with(free, &mut tower)?;
    Some([tower.print(&factor, &[])?, gathered_powers(&whole, by)])
}

/// True of a power of the variable, or what is of a low degree in it and holds no other function.
fn is_simple(f: &Fraction, tower: &mut Tower) -> bool {
    let is_power = f.above.terms().len() == 1 && f.below.terms().len() == 1;
    let degree = degree_in(&f.above, VARIABLE) + degree_in(&f.below, VARIABLE);
    let mut others = f.generators().into_iter().filter(|term| *term != VARIABLE);
    (is_power || degree < 3) && !others.any(|term| tower.varies(term))
}

/// The integrand with a letter for a generator, and what the letter stands for.
fn by_generator(f: &Fraction, term: Term, new: &Tree, tower: &mut Tower) -> Option<(Tree, Tree)> {
    let slope = tower.slope(term)?;
    if slope.is_zero() {
        return None;
    }
    let old = tower.print(&Fraction::generator(term), &[])?;
    if let Kind::Root(radicand, index) = tower.kind(term).clone() {
        let coefficients = crate::algebra::coefficients_in(&radicand, VARIABLE);
        if let [constant, first] = coefficients.as_slice()
            && [constant, first]
                .iter()
                .all(|p| p.generators().iter().all(|term| !tower.varies(*term)))
        {
            // x = (y^n - b)/a
            let [constant, first] = [constant, first].map(|p| Fraction::of(p.clone()));
            let (constant, first) = (tower.print(&constant, &[])?, tower.print(&first, &[])?);
            let whole = sum(vec![power(new.clone(), index), tree::negative(constant)]);
            let variable = quotient(whole, first.clone());
            let inside = tower.print(f, &[(term, 1, new.clone()), (VARIABLE, 1, variable)])?;
            let slope = product(vec![integer(i64::from(index)), power(new.clone(), index - 1)]);
            return Some((product(vec![inside, quotient(slope, first)]), old));
        }
    }
    tower.is_turned = matches!(tower.kind(term), Kind::Cosine(_));
    let g = tower.over(f, &slope);
    let g = g.and_then(|g| tower.normal(&g));
    tower.is_turned = false;
    Some((tower.print(&g?, &[(term, 1, new.clone())])?, old))
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Meaning, Names, read_expression};

    fn found(tex: &str) -> Vec<Tree> {
        let names = Names::default();
        let tree = read_expression(tex, &names).unwrap();
        antiderivatives(&tree, &Name::plain("x"), &Symbols::new(names))
    }

    fn at(tree: &Tree, point: f64) -> f64 {
        value(tree, &|name| letter(name, &Name::plain("x"), point, false)).unwrap_or(f64::NAN)
    }

    /// Checks by differences at points that one of the antiderivatives has the integrand as its derivative.
    fn check(tex: &str, points: &[f64]) {
        let of = read_expression(tex, &Names::default()).unwrap();
        let found = found(tex);
        assert!(!found.is_empty(), "{tex}");
        let is_right = |whole: &Tree, point: f64| {
            let slope = (at(whole, point + 1e-5) - at(whole, point - 1e-5)) / 2e-5;
            (slope - at(&of, point)).abs() < 1e-4 * (1.0 + slope.abs())
        };
        let is_found = found
            .iter()
            .any(|whole| points.iter().all(|point| is_right(whole, *point)));
        let first = found.first().unwrap();
        assert!(is_found, "{tex}: {first}");
    }

    #[test]
    fn powers_and_logarithms_of_0_come_to_an_end() {
        for tex in ["0^x", r"x \ln 0", r"\ln(x - x)", r"\sqrt{0} x"] {
            found(tex);
        }
    }

    #[test]
    fn polynomials_powers_and_waves() {
        for tex in [
            "x^2",
            "a x^{24} + b x",
            "(a x + b)^{c}",
            r"\sqrt{a x + b}",
            r"e^{-a x} \cos(b x)",
            r"x^2 e^{-a x} \cos(b x)",
            r"\sin m x \cos n x",
            r"x e^{-x} \sin x",
            r"(e^{-x} \cos x)^2",
            r"\cos(\omega t + x)",
            r"\sin^3 x \cos x",
            r"\sin(20 x) \cos(43 x)",
            "x^{n}",
            "x^{-n}",
            "a^x",
            r"e^{-x/\tau}",
            r"\sinh x",
            "x (1 - x)^{99}",
            r"(\cos x + \cos(x + \frac{2 \pi}{3}) + \cos(x - \frac{2 \pi}{3}))^2",
        ] {
            check(tex, &[0.2, 0.7]);
        }
    }

    #[test]
    fn rational_functions() {
        for tex in [
            r"\frac{x}{x^2 + 1}",
            r"\frac{1}{x^2 + a^2}",
            r"\frac{1}{a + b x^2}",
            r"\frac{\pi}{x}",
            r"\frac{a}{x}",
            r"\frac{1}{x (x + 1)}",
            r"\frac{1}{(x + a)(x + b)}",
            r"\frac{1}{x^3 + 1}",
            r"\frac{1}{x^4 + 1}",
            r"\frac{x^2}{(x^2 + a^2)^2}",
            r"\frac{1}{x^6 + 1}",
            r"\frac{1}{x^4 + a^4}",
            r"\frac{1}{1 + e^x}",
            r"\frac{1}{\cosh x}",
        ] {
            check(tex, &[0.3, 1.7, 5.0]);
        }
    }

    #[test]
    fn logarithms_and_inverse_functions() {
        for tex in [
            r"\ln x",
            r"x \ln x",
            r"\ln^2(x + 3)",
            r"\ln(x^2 + 1)",
            r"\frac{\ln x}{x}",
            r"\frac{1}{x \ln x}",
            r"\arctan x",
            r"x \arctan x",
            r"\sin(\ln x)",
            r"x^n \ln x",
            r"e^{\sqrt x}",
            r"x e^{-a x^2}",
        ] {
            check(tex, &[1.3, 1.7, 5.0]);
        }
        for tex in [r"\arcsin x", r"x \arcsin x", r"\arccos x"] {
            check(tex, &[-0.6, 0.3]);
        }
    }

    #[test]
    fn roots() {
        for tex in [
            r"\sqrt{1 - x^2}",
            r"\frac{1}{\sqrt{1 - x^2}}",
            r"\frac{1}{\sqrt{x^2 + 1}}",
            r"x \sqrt{x^2 + 1}",
            r"\sqrt{a^2 - x^2}",
            r"\sqrt{\frac{1 - x}{1 + x}}",
            r"\frac{1}{x \sqrt{1 - x^2}}",
            "|x|",
        ] {
            check(tex, &[0.2, 0.7]);
        }
    }

    #[test]
    fn tangents_leave_no_jumps() {
        for tex in [
            r"\frac{1}{2 + \cos x}",
            r"\frac{1}{2 + \sin x}",
            r"\frac{1}{5 + 3 \cos x + \sin x}",
            r"\frac{1}{1 + 3 \sin^2 x}",
            r"\frac{x}{1 + x^2} + \cos^4 x",
        ] {
            check(tex, &[0.2, 2.0, 4.0]);
            let whole = found(tex).remove(0);
            let steps = (0..2000).map(|step| f64::from(step) * 0.01);
            let is_continuous = steps
                .map(|point| at(&whole, point + 0.01) - at(&whole, point))
                .all(|difference| difference.abs() < 0.05);
            assert!(is_continuous, "{tex}: {whole}");
        }
        for tex in [
            r"\tan x",
            r"\frac{1}{\cos^2 x}",
            r"\frac{1}{\cos x}",
            r"\frac{1}{1 + \sin x}",
        ] {
            check(tex, &[0.2, 1.2]);
        }
    }

    #[test]
    fn signs_of_letters_have_alternatives() {
        assert!(found(r"\frac{1}{a + b \cos x}").len() > 1);
        check(r"\frac{1}{a + b \cos x}", &[0.2, 1.2]);
    }

    #[test]
    fn unknown_functions_are_undone() {
        let functions = ["f", "g"].map(Name::plain);
        let names = Names {
            functions: functions.to_vec(),
            ..Names::default()
        };
        let mut symbols = Symbols::new(names.clone());
        for function in functions {
            symbols.declare(function, Meaning::Function(None));
        }
        let found = |tex: &str| {
            let tree = read_expression(tex, &names).unwrap();
            antiderivative(&tree, &Name::plain("x"), &symbols).map(|whole| whole.to_string())
        };
        for (tex, wanted) in [
            ("f(x) g'(x) + f'(x) g(x)", "f(x) g(x)"),
            ("f''(x) f(x) + f'(x)^2", "f(x) f'(x)"),
            ("x f'(x) + f(x)", "x f(x)"),
            ("f'(a x)", r"\frac{f(x a)}{a}"),
        ] {
            assert_eq!(found(tex).as_deref(), Some(wanted), "{tex}");
        }
        for tex in ["f(x) g'(x)", "f(x)", "f(x) f''(x)", "f'(x^2)", "f'(x)^2"] {
            assert_eq!(found(tex), None, "{tex}");
        }
    }

    #[test]
    fn what_is_not_elementary_is_not_found() {
        for tex in [
            r"e^{-x^2}",
            r"\frac{\sin x}{x}",
            r"\frac{e^x}{x}",
            r"\sqrt{1 + x^3}",
            r"\cos(x^2)",
        ] {
            assert!(found(tex).is_empty(), "{tex}");
        }
    }
}
