//! Zeros of a function of one letter between two numbers, found by the changes of its sign and written exactly where they are
//! recognised: as rational numbers, roots of quadratic equations, multiples of pi, logarithms and angles.
//!
//! A zero at which the sign does not change is found only where a grid is close to it, and one that is not recognised is left
//! out: what is concluded from the list is shown by other means.

use super::tree::{call, integer, negative, number, product, quotient, root, sum, symbol, value};
use numbers::{Field as _, Rational};
use texmath::{Name, Operation, Tree};

/// The steps of the grid, and the most zeros.
const GRID: u32 = 1_600;
const MOST: usize = 24;

/// Beyond this, an infinite end is not looked at.
const FAR: f64 = 60.0;

/// The largest distance of a zero from the number that it is written as.
const CLOSE: f64 = 1e-11;

/// The zeros of a tree between two numbers, in ascending order.
pub fn zeros(of: &Tree, by: &Name, between: [&Tree; 2]) -> Vec<Tree> {
    let [Some(low), Some(high)] = between.map(end) else {
        return Vec::new();
    };
    let at = |x: f64| {
        let of_name = |name: &Name| if name == by { x } else { constant(name) };
        value(of, &of_name).filter(|value| value.is_finite())
    };
    let step = (high - low) / f64::from(GRID);
    let points: Vec<(f64, Option<f64>)> = (0..=GRID)
        .map(|n| low + f64::from(n) * step)
        .map(|x| (x, at(x)))
        .collect();
    let scale = points
        .iter()
        .filter_map(|(_, value)| *value)
        .fold(0.0, |most: f64, value| most.max(value.abs()).min(1e3));
    let mut found: Vec<f64> = Vec::new();
    for (place, pair) in points.windows(2).enumerate() {
        let [(from, Some(first)), (to, Some(last))] = pair else {
            continue;
        };
        if first * last < 0.0 {
            found.push(bisected(&at, [*from, *to], *first));
        }
        if place > 0 && first.abs() < 1e-9 * scale.max(1e-3) {
            found.push(*from);
        }
    }
    for triple in points.windows(3) {
        let [(from, Some(first)), (_, Some(middle)), (to, Some(last))] = triple else {
            continue;
        };
        let is_least = middle.abs() <= first.abs() && middle.abs() <= last.abs();
        if is_least && first * middle >= 0.0 && middle * last >= 0.0 && middle.abs() < 1e-2 * scale {
            found.push(least(&at, [*from, *to]));
        }
    }
    let is_zero = |x: &f64| at(*x).is_none_or(|value| value.abs() < 1e-7 * scale.max(1e-6));
    found.retain(|x| low + 1e-9 < *x && *x < high - 1e-9 && is_zero(x));
    found.sort_by(f64::total_cmp);
    found.dedup_by(|one, other| (*one - *other).abs() < 1e-6);
    let mut zeros: Vec<Tree> = Vec::new();
    for tree in found.into_iter().take(MOST).filter_map(recognised) {
        if !zeros.contains(&tree) {
            zeros.push(tree);
        }
    }
    zeros
}

fn constant(name: &Name) -> f64 {
    match name.base.as_str() {
        "\\pi" => std::f64::consts::PI,
        "e" => std::f64::consts::E,
        _ => f64::NAN,
    }
}

/// An end as a machine number, an infinite one as one that is far.
fn end(tree: &Tree) -> Option<f64> {
    match tree {
        Tree::Operation(operation, _) => matches!(**operation, Operation::Infinity).then_some(FAR),
        Tree::Negate(inner) => end(inner).map(|value| -value),
        tree => value(tree, &constant).filter(|value| value.is_finite()),
    }
}

fn bisected(at: &dyn Fn(f64) -> Option<f64>, [mut low, mut high]: [f64; 2], first: f64) -> f64 {
    for _ in 0..70 {
        let middle = 0.5 * (low + high);
        match at(middle) {
            Some(value) if value * first > 0.0 => low = middle,
            Some(_) => high = middle,
            None => return middle,
        }
    }
    0.5 * (low + high)
}

/// The place at which the size of a function is least, by thirds.
fn least(at: &dyn Fn(f64) -> Option<f64>, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..90 {
        let third = (high - low) / 3.0;
        let size = |x: f64| at(x).map_or(0.0, f64::abs);
        match size(low + third) < size(high - third) {
            true => high -= third,
            false => low += third,
        }
    }
    0.5 * (low + high)
}

/// A rational number with a denominator up to a bound that a number is close to.
fn rational(x: f64, most: i64, close: f64) -> Option<Rational> {
    let numerator = |below: i64| (x * below as f64).round();
    let below = (1..=most).find(|below| (x * *below as f64 - numerator(*below)).abs() < close * *below as f64)?;
    let above = numerator(below);
    (above.abs() < 1e9).then(|| Rational::from_ratio(above as i64, below))
}

/// The tree of a number, where it is recognised.
fn recognised(x: f64) -> Option<Tree> {
    use std::f64::consts::PI;
    // a place at which the sign does not change is known to half the digits alone
    let rounded = |x: f64| rational(x, 24, 3e-8).map(|value| number(&value));
    let pi = || symbol(&Name::plain("\\pi"));
    let of_pi = |value: &Rational| product(vec![number(value), pi()]);
    let plain = rational(x, 720, CLOSE).map(|value| number(&value));
    let plain = plain.or_else(|| rational(x / PI, 120, CLOSE).map(|value| of_pi(&value)));
    let plain = plain.or_else(|| quadratic(x)).or_else(|| {
        let logarithm = rational(x.exp(), 40, CLOSE).map(|value| call("\\ln", number(&value)));
        logarithm.or_else(|| angle(x))
    });
    let by_pi = || rational(x / PI, 24, 1e-8).map(|value| of_pi(&value));
    plain.or_else(|| rounded(x)).or_else(by_pi)
}

/// A root of a quadratic equation with small coefficients.
fn quadratic(x: f64) -> Option<Tree> {
    for a in 1..=12_i64 {
        for b in -24..=24_i64 {
            let c = -(a as f64 * x * x + b as f64 * x);
            if (c - c.round()).abs() > CLOSE || c.abs() > 200.0 {
                continue;
            }
            let c = c.round() as i64;
            let under = root(integer(b * b - 4 * a * c), 2);
            let is_larger = 2.0 * a as f64 * x + b as f64 > 0.0;
            let under = if is_larger { under } else { negative(under) };
            return Some(quotient(sum(vec![integer(-b), under]), integer(2 * a)));
        }
    }
    None
}

/// An angle of which the cosine, the sine or the tangent is a rational number, a turn more or less.
fn angle(x: f64) -> Option<Tree> {
    use std::f64::consts::PI;
    let turned = |tree: Tree, own: f64| {
        let halves = ((x - own) / PI).round();
        let more = product(vec![integer(halves as i64), symbol(&Name::plain("\\pi"))]);
        ((x - own - halves * PI).abs() < 1e-9).then(|| sum(vec![tree, more]))
    };
    let (sine, cosine, tangent) = (x.sin(), x.cos(), x.tan());
    let arc = |function: &str, value: &Rational| call(function, number(value));
    let found = rational(sine, 24, CLOSE).and_then(|value| {
        let own = sine.asin();
        let arc = arc("\\arcsin", &value);
        match cosine > 0.0 {
            true => turned(arc, own),
            false => turned(negative(arc), -own),
        }
    });
    let found = found.or_else(|| {
        let value = rational(cosine, 24, CLOSE)?;
        let (own, arc) = (cosine.acos(), arc("\\arccos", &value));
        match sine > 0.0 {
            true => turned(arc, own),
            false => turned(negative(arc), -own),
        }
    });
    found.or_else(|| turned(arc("\\arctan", &rational(tangent, 24, CLOSE)?), tangent.atan()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Names, read_expression};

    #[test]
    fn zeros_are_found_and_recognised() {
        for (tex, low, high, expected) in [
            ("x^2 - 1", "-2", "2", vec![-1.0, 1.0]),
            ("x^2 - 2", "0", "2", vec![2.0_f64.sqrt()]),
            (
                r"\sin x \cos x",
                "0",
                r"2 \pi",
                vec![0.5, 1.0, 1.5]
                    .into_iter()
                    .map(|n| n * std::f64::consts::PI)
                    .collect(),
            ),
            (r"1 + \cos x", "0", r"2 \pi", vec![std::f64::consts::PI]),
            ("e^x - 3", "0", "2", vec![3.0_f64.ln()]),
            (
                r"3 \sin x - 1",
                "0",
                "3",
                vec![(1.0_f64 / 3.0).asin(), std::f64::consts::PI - (1.0_f64 / 3.0).asin()],
            ),
            ("x^2 + 1", "-2", "2", vec![]),
            (r"\frac{1}{x}", "-1", "1", vec![]),
        ] {
            let read = |tex: &str| read_expression(tex, &Names::default()).unwrap();
            let found = zeros(&read(tex), &Name::plain("x"), [&read(low), &read(high)]);
            let values: Vec<f64> = found.iter().map(|tree| value(tree, &constant).unwrap()).collect();
            let is_close = values
                .iter()
                .zip(&expected)
                .all(|(one, other)| (one - other).abs() < 1e-9);
            assert!(values.len() == expected.len() && is_close, "{tex}: {values:?}");
        }
    }
}
