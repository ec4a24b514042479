//! Sums, products, integrals and limits as printed: their bodies are evaluated at one value of the letter after another.
//!
//! Each method estimates its own error. A value whose error is not small has no digits: it is NaN.

use super::body::{Body, Estimate, Term, tolerance};
use super::evaluation::evaluate;
use super::formula::{Binder, Formula, Inputs, Op, Program, holds, price};
use super::limit::limit;
use super::quadrature::{integral, ray};
use super::series::series;
use super::value::{Value, undefined};
use numbers::Analytic;
use std::cell::RefCell;

/// The most terms of a sum between two ends.
const MOST_TERMS: i64 = 20_000;
/// How near an end of a sum must be to an integer.
const WHOLE: f64 = 1e-9;
/// How deep the terms of a body are looked at for their size.
const DEEPEST: usize = 6;

impl Program {
    /// Evaluates a program with operations that bind letters. What depends on a bound letter is left at NaN.
    pub(super) fn run_loops<V: Value>(&self, inputs: &Inputs<V>) -> Vec<V> {
        let mut values = vec![V::real(undefined()); self.ops.len()];
        for position in 0..self.ops.len() {
            self.step(position, 0, inputs, &mut values);
        }
        values
    }

    /// Evaluates one position where the letters that it depends on have values.
    fn step<V: Value>(&self, position: usize, known: u128, inputs: &Inputs<V>, values: &mut [V]) {
        let (Some(op), Some(letters)) = (self.ops.get(position), self.loops.letters.get(position)) else {
            return;
        };
        if letters & !known != 0 || matches!(op, Op::Bound(_)) {
            return;
        }
        let value = match op {
            Op::Bind { .. } => {
                let found = self.bound(position, known, inputs, values);
                if let Some(size) = self.loops.sizes.borrow_mut().get_mut(position) {
                    *size = found.size;
                }
                found.value
            }
            op => {
                let none = V::real(undefined());
                evaluate(*op, inputs, |formula: Formula| {
                    values.get(formula.position()).unwrap_or(&none)
                })
            }
        };
        if let Some(place) = values.get_mut(position) {
            *place = value;
        }
    }

    fn bound<V: Value>(&self, position: usize, known: u128, inputs: &Inputs<V>, values: &mut [V]) -> Term<V> {
        let none = || Term {
            value: V::real(undefined()),
            size: f64::NAN,
        };
        let (Some(&op), Some(inner)) = (self.ops.get(position), self.loops.inner.get(position)) else {
            return none();
        };
        let Op::Bind {
            kind,
            letter,
            body,
            from,
            to,
        } = op
        else {
            return none();
        };
        let get = |formula: Formula| values.get(formula.position()).cloned();
        let (Some(low), Some(high)) = (get(from), get(to)) else {
            return none();
        };
        let known = known | 1_u128.checked_shl(u32::from(letter)).unwrap_or(0);
        let cost = (inner.len() + 1) * price::<V>();
        let values = RefCell::new(values);
        let mut at = |value: V| {
            if !inputs.work.take(cost) {
                return none();
            }
            let mut values = values.borrow_mut();
            for &position in inner {
                match self.ops.get(position) {
                    Some(Op::Bound(own)) if *own == letter => {
                        if let Some(place) = values.get_mut(position) {
                            *place = value.clone();
                        }
                    }
                    _ => self.step(position, known, inputs, &mut values),
                }
            }
            let size = self.size_of(body, &values, 0);
            let value = values.get(body.position()).cloned();
            value.map_or_else(none, |value| Term { value, size })
        };
        let found = match kind {
            Binder::Sum | Binder::Product => return finite(kind, &low, &high, &mut at).unwrap_or_else(none),
            Binder::Series | Binder::InfiniteProduct => {
                whole(&low).and_then(|first| series(kind == Binder::Series, first, &mut at))
            }
            Binder::Integral => integral(&low, &high, &mut at),
            Binder::Ray => ray(&low, &mut at),
            Binder::Limit(side) => limit(&low, side, &mut at),
        };
        let is_right = |found: &Estimate<V>| found.error <= tolerance::<V>() * found.size || found.error == 0.0;
        match found.filter(is_right) {
            Some(Estimate { value, size, .. }) => Term { value, size },
            None => none(),
        }
    }

    /// The size of the terms that a value is the sum of.
    fn size_of<V: Value>(&self, formula: Formula, values: &[V], depth: usize) -> f64 {
        let own = |formula: Formula| values.get(formula.position()).map_or(f64::NAN, Value::size);
        let below = |formula: Formula| self.size_of(formula, values, depth + 1);
        match self.ops.get(formula.position()) {
            _ if depth == DEEPEST => own(formula),
            Some(Op::Add(a, b)) => below(*a) + below(*b),
            Some(Op::Negate(a)) => below(*a),
            Some(Op::Multiply(a, b)) => (own(*a) * below(*b)).max(below(*a) * own(*b)),
            Some(Op::Divide(a, b)) => below(*a).max(own(formula) * below(*b)) / own(*b),
            Some(Op::If {
                relation,
                test,
                yes,
                no,
            }) => match values.get(test.position()).and_then(|test| holds(*relation, test)) {
                Some(true) => below(*yes),
                Some(false) => below(*no),
                None => f64::NAN,
            },
            Some(Op::Bind { .. }) => {
                let sizes = self.loops.sizes.borrow();
                sizes.get(formula.position()).copied().unwrap_or(f64::NAN)
            }
            _ => own(formula),
        }
    }
}

/// The integer that a value is.
fn whole<V: Value>(value: &V) -> Option<i64> {
    let [re, im] = value.parts().map(|part| part.to_f64());
    let near = re.round();
    ((re - near).abs() <= WHOLE && im.abs() <= WHOLE && near.abs() < 1e9).then_some(near as i64)
}

/// A sum or product of known length; one over no integers has a value where it ends just before it starts.
fn finite<V: Value>(kind: Binder, low: &V, high: &V, at: &mut Body<V>) -> Option<Term<V>> {
    let (first, last) = (whole(low)?, whole(high)?);
    if last < first - 1 || last - first > MOST_TERMS {
        return None;
    }
    let is_sum = kind == Binder::Sum;
    let mut all = Term {
        value: V::integer(i64::from(!is_sum)),
        size: if is_sum { 0.0 } else { 1.0 },
    };
    for n in first..=last {
        let next = at(V::integer(n));
        let is_undefined = next.value.size().is_nan();
        all = match is_sum {
            true => Term {
                value: all.value + next.value,
                size: all.size + next.size,
            },
            false => Term {
                size: (all.size * next.value.size()).max(all.value.size() * next.size),
                value: all.value * next.value,
            },
        };
        if is_undefined {
            return None;
        }
    }
    Some(all)
}
