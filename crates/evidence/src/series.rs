//! Infinite sums and products by their terms: directly where these become negligible, else by Levin's u transform
//! (Levin, Int. J. Comput. Math. B3 (1973) 371), whose last steps estimate its error.

use super::body::{Body, Estimate, Term};
use super::evaluation::is_wide;
use super::value::Value;
use numbers::Analytic;

/// The most terms that are added up, and those that are transformed: in f64, and in many digits.
const MOST_TERMS: usize = 400;
const TRANSFORMED: usize = 30;
const TRANSFORMED_WIDE: usize = 90;
/// The estimates of which the last ones tell how near they are.
const LEAST: usize = 8;
/// Negligible terms in a row after which the rest is left out.
const NEGLIGIBLE: usize = 4;
/// The largest ratio of terms of which the rest is as small as they are.
const GEOMETRIC: f64 = 0.9;
/// How much smaller than the middle ones the last terms must be of a sum that converges.
const FALLING: f64 = 0.95;

/// The sum, or the product, of a body over all integers from the first on.
pub fn series<V: Value>(is_sum: bool, first: i64, at: &mut Body<V>) -> Option<Estimate<V>> {
    let wide = is_wide::<V>();
    let negligible = if wide { 1e-42 } else { 1e-18 };
    let most = if wide { TRANSFORMED_WIDE } else { TRANSFORMED };
    let mut all = Term {
        value: V::integer(i64::from(!is_sum)),
        size: if is_sum { 0.0 } else { 1.0 },
    };
    let (mut terms, mut sums): (Vec<V>, Vec<V>) = (Vec::new(), Vec::new());
    let mut small = 0;
    for n in 0..MOST_TERMS {
        let Term { value, size } = at(V::integer(first.checked_add(n as i64)?));
        if value.size().is_nan() {
            return None;
        }
        // a product is the sum of what each factor adds
        let (next, next_size) = match is_sum {
            true => (value, size),
            false => {
                let added = all.value.clone() * (value - V::integer(1));
                let size = added.size();
                (added, size)
            }
        };
        all.value = all.value + next.clone();
        all.size += next_size;
        // terms that are 0 before any other tell nothing
        small = match !terms.is_empty() && next.size() <= negligible * all.size {
            true => small + 1,
            false => 0,
        };
        if small == NEGLIGIBLE {
            return falls_fast(&terms).then(|| Estimate {
                error: negligible * all.size,
                value: all.value,
                size: all.size,
            });
        }
        if next.size() > 0.0 {
            terms.push(next);
            sums.push(all.value.clone());
        }
        // terms that hardly fall are not waited for
        if terms.len() == most && !falls_fast(&terms) {
            break;
        }
    }
    if terms.is_empty() {
        return Some(Estimate {
            error: 0.0,
            value: all.value,
            size: all.size,
        });
    }
    terms.truncate(most);
    sums.truncate(most);
    converges(&terms)
        .then(|| transformed(&terms, &sums, all.size))
        .flatten()
}

/// Returns true if the last terms fall at least as fast as a geometric series.
fn falls_fast<V: Value>(terms: &[V]) -> bool {
    let last = terms.iter().rev().take(2 * NEGLIGIBLE).map(Value::size);
    let last: Vec<f64> = last.collect();
    match (last.first(), last.last()) {
        (Some(near), Some(far)) if last.len() > 1 => (near / far).powf(1.0 / (last.len() - 1) as f64) <= GEOMETRIC,
        _ => true,
    }
}

/// Returns true if the terms fall as those of a convergent sum do: faster than 1/n, unless their signs alternate.
fn converges<V: Value>(terms: &[V]) -> bool {
    let middle = terms.len() / 2;
    let (Some(half), Some(end), true) = (terms.get(middle), terms.last(), middle > 2) else {
        return false;
    };
    let sign = |term: &V| term.parts()[0].to_f64();
    let alternates = terms.windows(2).all(|pair| match pair {
        [one, other] => sign(one) * sign(other) < 0.0,
        _ => false,
    });
    let weight = |place: usize| if alternates { 1.0 } else { (place + 1) as f64 };
    end.size() * weight(terms.len() - 1) <= FALLING * half.size() * weight(middle)
}

/// The value that partial sums tend to.
fn transformed<V: Value>(terms: &[V], sums: &[V], size: f64) -> Option<Estimate<V>> {
    let (mut above, mut below): (Vec<V>, Vec<V>) = (Vec::new(), Vec::new());
    let mut found: Vec<V> = Vec::new();
    let mut best: Option<Estimate<V>> = None;
    for (n, (term, sum)) in terms.iter().zip(sums).enumerate() {
        // (n + 1) a_n estimates what is left, up to a factor
        let place = V::integer(n as i64 + 1);
        let rest = place.clone() * place.clone() * term.clone();
        above.push(sum.over(&rest));
        below.push(V::integer(1).over(&rest));
        let mut weight = V::integer(1).over(&place);
        let ratio = V::integer(n as i64).over(&place);
        for j in 1..=n {
            let factor = V::integer((n - j) as i64 + 1) * weight.clone();
            for row in [&mut above, &mut below] {
                if let (Some(later), Some(own)) = (row.get(n - j + 1).cloned(), row.get_mut(n - j)) {
                    *own = later - factor.clone() * own.clone();
                }
            }
            weight = weight * ratio.clone();
        }
        let value = above.first()?.over(below.first()?);
        if let [.., earlier, before, last] = found.as_slice()
            && found.len() >= LEAST
        {
            // of the first ones a few may agree by chance
            let apart = |one: &V, other: &V| (one.clone() - other.clone()).size();
            let error = 10.0 * apart(&value, last) + apart(last, before) + apart(before, earlier);
            if best.as_ref().is_none_or(|best| error < best.error) {
                best = Some(Estimate {
                    value: value.clone(),
                    size,
                    error,
                });
            }
        }
        found.push(value);
    }
    let rounding = <V::Part as Analytic>::epsilon().to_f64();
    best.map(|best| Estimate {
        error: best.error.max(rounding * size),
        ..best
    })
}
