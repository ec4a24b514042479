//! Integrals by the double exponential rules (Takahasi and Mori, Publ. RIMS 9 (1974) 721): the step is halved until two
//! sums agree, and in f64 an interval on which they do not is cut in two.

use super::body::{Body, Estimate, Term, tolerance};
use super::evaluation::is_wide;
use super::value::{Real, Value};
use num_dual::DualNum;
use numbers::Analytic;
use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::HashMap;

/// The largest and the smallest step, as powers of 1/2, and how far the rule goes: in f64, and in many digits.
const FIRST: i32 = 2;
const LAST: i32 = 5;
const LAST_WIDE: i32 = 8;
const REACH: f64 = 4.0;
const REACH_WIDE: f64 = 5.5;
/// Nearer to the middle than this every place must have a value.
const INNER: f64 = 2.0;
/// The smallest step where an interval may still be cut, and how often it is cut.
const LAST_OF_PART: i32 = 4;
const MOST_CUTS: u32 = 34;
/// Values of the body that are taken for one integral.
const MOST_VALUES: usize = 20_000;

/// The integral between two ends, along the straight way.
pub fn integral<V: Value>(low: &V, high: &V, at: &mut Body<V>) -> Option<Estimate<V>> {
    let length = high.clone() - low.clone();
    if length.size().is_nan() {
        return None;
    }
    let mut left = MOST_VALUES;
    let whole = part(low, &length, [0.0, 1.0], at, LAST, &mut left);
    let is_right = |found: &Estimate<V>| found.error <= 1e-3 * tolerance::<V>() * found.size;
    if whole.as_ref().is_some_and(is_right) || is_wide::<V>() {
        return whole;
    }
    let enough = 1e-2 * tolerance::<V>() * whole.as_ref().map_or(0.0, |whole| whole.size);
    let cut = halves(low, &length, [0.0, 1.0], at, enough, MOST_CUTS, &mut left);
    let error = |found: &Option<Estimate<V>>| found.as_ref().map_or(f64::INFINITY, |found| found.error);
    match error(&cut) < error(&whole) {
        true => cut,
        false => whole,
    }
}

/// The integral over a part of the way, cut again and again where it is not smooth.
fn halves<V: Value>(
    low: &V,
    length: &V,
    [from, to]: [f64; 2],
    at: &mut Body<V>,
    enough: f64,
    cuts: u32,
    left: &mut usize,
) -> Option<Estimate<V>> {
    let middle = 0.5 * (from + to);
    let mut sum: Option<Estimate<V>> = None;
    for ends in [[from, middle], [middle, to]] {
        let own = part(low, length, ends, at, LAST_OF_PART, left);
        let is_right = |own: &Estimate<V>| own.error <= enough.max(1e-3 * tolerance::<V>() * own.size);
        let own = match own {
            Some(own) if is_right(&own) => own,
            own if cuts == 0 || *left == 0 => own?,
            _ => halves(low, length, ends, at, enough, cuts - 1, left)?,
        };
        sum = Some(match sum {
            None => own,
            Some(sum) => Estimate {
                value: sum.value + own.value,
                size: sum.size + own.size,
                error: sum.error + own.error,
            },
        });
    }
    sum
}

/// A double exponential rule: tanh-sinh between two ends, exp-sinh from an end to infinity.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Rule {
    TanhSinh,
    ExpSinh,
}

/// Places and weights by the type of their numbers, the rule and the bits of its parameter.
type Nodes = HashMap<(TypeId, Rule, u64), Box<dyn Any>>;

thread_local! {
    /// An integral within another takes the same nodes again and again.
    static NODES: RefCell<Nodes> = RefCell::default();
}

/// Returns a node of a rule, as the distance from the near end (of an interval of length 1 if there are two), and its weight.
fn node<P: Real + 'static>(rule: Rule, t: f64) -> (P, P) {
    let key = (TypeId::of::<P>(), rule, t.to_bits());
    let known = NODES.with_borrow(|nodes| nodes.get(&key)?.downcast_ref::<(P, P)>().cloned());
    known.unwrap_or_else(|| {
        let found = new_node(rule, &<P as Analytic>::from_f64(t));
        NODES.with_borrow_mut(|nodes| nodes.insert(key, Box::new(found.clone())));
        found
    })
}

fn new_node<P: Real>(rule: Rule, t: &P) -> (P, P) {
    let half_pi = P::pi() * P::from_ratio(1, 2);
    let u = half_pi.clone() * DualNum::sinh(t);
    let slope = half_pi * DualNum::cosh(t);
    match rule {
        Rule::TanhSinh => {
            let one = P::from_integer(1);
            let near = one.clone() / (one.clone() + DualNum::exp(&(u.clone() + u)));
            let weight = (slope.clone() + slope) * near.clone() * (one - near.clone());
            (near, weight)
        }
        Rule::ExpSinh => {
            let away = DualNum::exp(&u);
            (away.clone(), slope * away)
        }
    }
}

/// The integral over a part of the way by the tanh-sinh rule.
fn part<V: Value>(
    low: &V,
    length: &V,
    [from, to]: [f64; 2],
    at: &mut Body<V>,
    last: i32,
    left: &mut usize,
) -> Option<Estimate<V>> {
    let width = to - from;
    let mut evaluate = |t: f64| {
        let (near, weight) = node::<V::Part>(Rule::TanhSinh, t.abs());
        let width = V::float(width);
        let away = match t > 0.0 {
            true => V::float(to) - width.clone() * V::real(near),
            false => V::float(from) + width.clone() * V::real(near),
        };
        let found = at(low.clone() + length.clone() * away);
        (found, length.clone() * width * V::real(weight))
    };
    refined(&mut evaluate, last, left)
}

/// The integral from an end to infinity by the exp-sinh rule.
pub fn ray<V: Value>(low: &V, at: &mut Body<V>) -> Option<Estimate<V>> {
    let mut evaluate = |t: f64| {
        let (away, weight) = node::<V::Part>(Rule::ExpSinh, t);
        (at(low.clone() + V::real(away)), V::real(weight))
    };
    let mut left = MOST_VALUES;
    refined(&mut evaluate, LAST, &mut left)
}

/// Sums with smaller and smaller steps, until two agree.
fn refined<V: Value>(
    evaluate: &mut dyn FnMut(f64) -> (Term<V>, V),
    last: i32,
    left: &mut usize,
) -> Option<Estimate<V>> {
    let wide = is_wide::<V>();
    let (last, reach) = match wide {
        true => (LAST_WIDE, REACH_WIDE),
        false => (last, REACH),
    };
    let enough = if wide { 1e-36 } else { 1e-15 };
    let mut sums: Option<(V, f64)> = None;
    let mut best: Option<Estimate<V>> = None;
    // what is left out beyond the ends of the rule
    let mut cut = 0.0_f64;
    for level in FIRST..=last {
        let step = 0.5_f64.powi(level);
        let count = (reach / step) as i32;
        let (mut sum, mut size) = (V::integer(0), 0.0);
        for direction in [1, -1] {
            let mut is_missing = false;
            let mut before = 0.0_f64;
            for n in 0..=count {
                let is_new = level == FIRST || n % 2 != 0;
                if !is_new || (n == 0 && direction < 0) {
                    continue;
                }
                *left = left.checked_sub(1)?;
                let place = f64::from(n) * step;
                let (found, weight) = evaluate(f64::from(direction) * place);
                let term = found.value * weight.clone();
                let own = found.size * weight.size();
                // beside an end there may be no value: what is left out is no larger than the last term
                if !term.size().is_finite() {
                    if place < INNER {
                        return None;
                    }
                    is_missing = true;
                    cut = cut.max(before);
                    break;
                }
                before = own;
                size += own;
                sum = sum + term;
            }
            if !is_missing {
                cut = cut.max(before);
            }
        }
        let (all, all_size) = match sums.take() {
            None => (sum, size),
            Some((known, known_size)) => (known + sum, known_size + size),
        };
        let scaled = |value: &V| value.clone() * V::float(step);
        let value = scaled(&all);
        let total = all_size * step;
        sums = Some((all, all_size));
        if value.size().is_nan() {
            return None;
        }
        if let Some(before) = best.take() {
            let apart = (value.clone() - before.value).size();
            let error = apart.max(cut);
            let found = Estimate {
                value,
                size: total,
                error,
            };
            if apart <= enough * total {
                return Some(found);
            }
            best = Some(found);
        } else {
            best = Some(Estimate {
                value,
                size: total,
                error: f64::INFINITY,
            });
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::Wide;

    fn term<V: Value>(value: V) -> Term<V> {
        let size = value.size();
        Term { value, size }
    }

    fn between(low: f64, high: f64, of: impl Fn(f64) -> f64) -> Option<Estimate<f64>> {
        integral(&low, &high, &mut |x| term(of(x)))
    }

    #[test]
    fn integrals_are_found_with_an_error_that_holds() {
        let pi = std::f64::consts::PI;
        for (found, right, most) in [
            (between(0.0, 1.0, |x| x * x), 1.0 / 3.0, 1e-14),
            (between(0.0, pi, f64::sin), 2.0, 1e-14),
            (between(0.0, 1.0, |x| 1.0 / x.sqrt()), 2.0, 1e-12),
            (between(-1.0, 2.0, f64::abs), 2.5, 1e-10),
            (
                between(2.0, -1.0, |x| (x - 0.3).abs()),
                -(1.7 * 1.7 + 1.3 * 1.3) / 2.0,
                1e-10,
            ),
            (ray(&0.0, &mut |x: f64| term((-x).exp())), 1.0, 1e-12),
            (ray(&1.0, &mut |x: f64| term(1.0 / (x * x))), 1.0, 1e-12),
            (ray(&0.0, &mut |x: f64| term((-x * x).exp())), pi.sqrt() / 2.0, 1e-12),
        ] {
            let found = found.unwrap();
            assert!((found.value - right).abs() <= most, "{found:?} {right}");
            assert!(found.error <= 1e-9 * found.size, "{found:?} {right}");
        }
    }

    #[test]
    fn many_digits_are_found() {
        let number = <Wide<40> as Analytic>::from_f64;
        let found = integral(&number(0.0), &number(1.0), &mut |x| term(DualNum::exp(&x))).unwrap();
        let right = DualNum::exp(&number(1.0)) - number(1.0);
        assert!((found.value.clone() - right).size() < 1e-35, "{found:?}");
    }

    #[test]
    fn what_does_not_converge_has_no_value() {
        let tells = |found: Option<Estimate<f64>>| found.is_some_and(|found| found.error <= 1e-9 * found.size);
        assert!(!tells(between(0.0, 1.0, |x| 1.0 / x)));
        assert!(!tells(between(-1.0, 1.0, |x| 1.0 / (x - 0.1))));
        assert!(!tells(between(-1.0, 1.0, |x| 1.0 / x)));
        assert!(!tells(between(-1.0, 1.0, |x| 1.0 / (x * x))));
        assert!(!tells(ray(&1.0, &mut |x: f64| term(1.0 / x))));
        assert!(!tells(ray(&1.0, &mut |x: f64| term(x.sin()))));
    }
}
