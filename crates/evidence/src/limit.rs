//! Limits by extrapolation: values nearer and nearer, as a polynomial in the distance (Neville's scheme), with the error
//! that its columns show (Press and others, Numerical Recipes, section 5.7).

use super::body::{Body, Estimate};
use super::evaluation::is_wide;
use super::formula::Side;
use super::value::Value;

/// Values of the body: in f64, and in many digits.
const VALUES: usize = 18;
const VALUES_WIDE: usize = 40;
/// The first distance, and the power of 2 that the letter starts with where it grows.
const FIRST: i32 = 2;

/// The limit of a body towards a value.
pub fn limit<V: Value>(to: &V, side: Side, at: &mut Body<V>) -> Option<Estimate<V>> {
    let sides: &[i64] = match side {
        Side::Both => &[1, -1],
        Side::Below => &[-1],
        Side::Above | Side::Infinity => &[1],
    };
    let mut found: Option<Estimate<V>> = None;
    for sign in sides {
        let Some(own) = one_sided(to, *sign, side == Side::Infinity, at) else {
            continue;
        };
        found = Some(match found {
            None => own,
            Some(other) => {
                let apart = (own.value.clone() - other.value.clone()).size();
                let nearer = if own.error <= other.error {
                    own.value
                } else {
                    other.value
                };
                Estimate {
                    value: nearer,
                    size: own.size.max(other.size),
                    error: own.error.max(other.error).max(apart),
                }
            }
        });
    }
    found
}

/// The limit from one side; None where the body has no values there.
fn one_sided<V: Value>(to: &V, sign: i64, is_at_infinity: bool, at: &mut Body<V>) -> Option<Estimate<V>> {
    let count = if is_wide::<V>() { VALUES_WIDE } else { VALUES };
    let mut distances: Vec<V> = Vec::new();
    let mut row: Vec<V> = Vec::new();
    let mut best: Option<Estimate<V>> = None;
    // near the limit terms may grow that cancel: what a value is compared with is the body far from it
    let mut far_size = 0.0_f64;
    for k in 0..count {
        let power = V::integer(1 << (k as u32).min(40));
        let (place, distance) = match is_at_infinity {
            // odd and even integers in turn, so that what alternates does not converge
            true => {
                let place = power * V::integer(4) + V::integer((k % 2) as i64);
                (place.clone(), V::integer(1).over(&place))
            }
            false => {
                let distance = V::integer(sign).over(&(power * V::integer(1 << FIRST)));
                (to.clone() + distance.clone(), distance)
            }
        };
        let next = at(place);
        if !next.value.size().is_finite() {
            // far from the limit nothing need have a value; near it everything must
            match row.is_empty() {
                true => continue,
                false => break,
            }
        }
        if row.is_empty() {
            far_size = next.value.size();
        }
        distances.push(distance);
        let mut extrapolated = vec![next.value];
        let last = distances.len() - 1;
        for (j, before) in row.iter().enumerate() {
            let (Some(far), Some(near), Some(known)) = (
                distances.get(last - j - 1),
                distances.get(last),
                extrapolated.get(j).cloned(),
            ) else {
                break;
            };
            let ratio = far.over(near) - V::integer(1);
            let next = known.clone() + (known.clone() - before.clone()).over(&ratio);
            // both neighbours of an entry must agree with it
            let apart = (next.clone() - known)
                .size()
                .max((next.clone() - before.clone()).size());
            let size = far_size.max(next.size());
            if j > 0 && best.as_ref().is_none_or(|best| apart / size < best.error / best.size) {
                best = Some(Estimate {
                    value: next.clone(),
                    size,
                    error: apart,
                });
            }
            extrapolated.push(next);
        }
        row = extrapolated;
    }
    best.map(|best| Estimate {
        error: 4.0 * best.error,
        ..best
    })
}
