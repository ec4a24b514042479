//! Factors of the fourth degree that are two quadratics over a square root.
//!
//! Source: Descartes' solution of the quartic by its resolvent cubic.

use super::candidates::{Candidate, Function};
use super::field::Field;
use super::fraction::Fraction;
use super::tower::{Tower, one_of};
use crate::algebra::{coefficients_in, factors};
use kernel::{Polynomial, Term};
use numbers::{Field as _, Rational};

/// The quadratics `y^2 + r y + a - b r` and `y^2 - r y + a + b r`, where y is `t + shift` and r the root.
struct Pair {
    shift: Fraction,
    root: Fraction,
    a: Fraction,
    b: Fraction,
}

fn rational(above: i64, below: i64) -> Rational {
    Rational::from_ratio(above, below)
}

/// The root of the resolvent that is positive and makes both quadratics real.
fn pair(coefficients: &[Polynomial], tower: &mut Tower) -> Option<Pair> {
    let [e, d, c, b, a] = coefficients else { return None };
    let lead = Fraction::of(a.clone());
    let mut monic = Vec::new();
    for part in [b, c, d, e] {
        monic.push(tower.over(&Fraction::of(part.clone()), &lead)?);
    }
    let [b, c, d, e] = monic.as_slice() else { return None };
    let shift = b.scaled(&rational(1, 4));
    let h2 = tower.times(&shift, &shift)?;
    let h3 = tower.times(&h2, &shift)?;
    let h4 = tower.times(&h2, &h2)?;
    // y^4 + p y^2 + q y + r at t = y - h
    let p = c.plus(&h2.scaled(&rational(-6, 1)), &mut tower.steps)?;
    let ch = tower.times(c, &shift)?.scaled(&rational(-2, 1));
    let q = d
        .plus(&ch, &mut tower.steps)?
        .plus(&h3.scaled(&rational(8, 1)), &mut tower.steps)?;
    let (ch2, dh) = (tower.times(c, &h2)?, tower.times(d, &shift)?.scaled(&rational(-1, 1)));
    let r = e.plus(&ch2, &mut tower.steps)?.plus(&dh, &mut tower.steps)?;
    let r = r.plus(&h4.scaled(&rational(-3, 1)), &mut tower.steps)?;
    let square = square(&p, &q, &r, tower)?;
    let root = tower.root(&square, 2)?;
    let a = p.plus(&square, &mut tower.steps)?.scaled(&rational(1, 2));
    let b = tower.over(&q, &square)?.scaled(&rational(1, 2));
    Some(Pair { shift, root, a, b })
}

/// A root z of `z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2` that is positive.
fn square(p: &Fraction, q: &Fraction, r: &Fraction, tower: &mut Tower) -> Option<Fraction> {
    let fresh = Term(u32::MAX);
    let z = Fraction::generator(fresh);
    let mut total = z.power(3, &mut tower.steps)?;
    let first = p
        .times(&z.power(2, &mut tower.steps)?, &mut tower.steps)?
        .scaled(&rational(2, 1));
    total = total.plus(&first, &mut tower.steps)?;
    let less = p
        .times(p, &mut tower.steps)?
        .plus(&r.scaled(&rational(-4, 1)), &mut tower.steps)?;
    total = total.plus(&less.times(&z, &mut tower.steps)?, &mut tower.steps)?;
    let last = q.times(q, &mut tower.steps)?.scaled(&rational(-1, 1));
    total = total.plus(&last, &mut tower.steps)?;
    let found = factors(&total.above, &[], &mut tower.steps).ok()?;
    for (factor, _) in found.factors {
        if let [constant, slope] = coefficients_in(&factor, fresh).as_slice() {
            let (constant, slope) = (Fraction::of(constant.negated()), Fraction::of(slope.clone()));
            let zero = constant.over(&slope, &mut tower.steps)?;
            if tower.value_at(&zero, 1.0).is_some_and(|value| value > 0.0) {
                return Some(zero);
            }
        }
    }
    None
}

impl Field {
    /// The logarithms and angles of the two quadratics, in the pairs whose derivatives hold no root.
    pub(super) fn quartic(&self, factor: &Polynomial, tower: &mut Tower) -> Option<Vec<Candidate>> {
        let term = &self.only_generator(factor)?;
        let coefficients = coefficients_in(factor, *term);
        if coefficients.len() != 5 || coefficients.iter().any(|p| self.varies(p)) {
            return None;
        }
        let pair = pair(&coefficients, tower)?;
        let sides = [Self::quadratic(&pair, 1, tower)?, Self::quadratic(&pair, -1, tower)?];
        let [one, other] = &sides;
        let slope = tower.slope(*term)?;
        let slope = self.in_tangents(&slope, tower)?;
        let values = [product_of(one, tower, *term)?, product_of(other, tower, *term)?];
        let [first, second] = &values;
        let whole = tower.times(first, second)?;
        let mut all = Vec::new();
        let part = |own: &Fraction, other: &Fraction, sign: i64, tower: &mut Tower| {
            let both = own.plus(&other.scaled(&rational(sign, 1)), &mut tower.steps)?;
            let above = tower.times(&both, &slope)?;
            tower.over(&above, &whole)
        };
        let root = tower.print(&pair.root, &[])?;
        let angles = |tower: &mut Tower| {
            let first = self.reciprocal(*term, one.clone(), tower)?;
            Some(Box::new([first, self.reciprocal(*term, other.clone(), tower)?]))
        };
        all.push(Candidate {
            slope: part(second, first, 1, tower)?,
            function: Function::Pair(None, angles(tower)?),
        });
        let (left, right) = (tower.times(second, &pair.root)?, tower.times(first, &pair.root)?);
        all.push(Candidate {
            slope: part(&left, &right, -1, tower)?,
            function: Function::Pair(Some(root.clone()), angles(tower)?),
        });
        let mut logarithms = Vec::new();
        let mut slopes = Vec::new();
        for value in &values {
            let logarithm = self.logarithm(&value.above, tower)?;
            slopes.push(tower.times(&logarithm.slope, &pair.root)?);
            logarithms.push(logarithm.function);
        }
        if let [left, right] = slopes.as_slice() {
            let slope = left.plus(&right.scaled(&rational(-1, 1)), &mut tower.steps)?;
            let slope = tower.normal(&slope)?;
            let functions: [Function; 2] = logarithms.try_into().ok()?;
            all.push(Candidate {
                slope,
                function: Function::Pair(Some(root), Box::new(functions)),
            });
        }
        Some(all)
    }

    /// The coefficients of one of the quadratics in t, from the highest on.
    fn quadratic(pair: &Pair, sign: i64, tower: &mut Tower) -> Option<[Fraction; 3]> {
        let root = pair.root.scaled(&rational(sign, 1));
        let b = pair.shift.scaled(&rational(2, 1)).plus(&root, &mut tower.steps)?;
        let mut c = tower.times(&pair.shift, &pair.shift)?;
        c = c.plus(&tower.times(&root, &pair.shift)?, &mut tower.steps)?;
        c = c.plus(&pair.a, &mut tower.steps)?;
        c = c.plus(&tower.times(&root, &pair.b)?.scaled(&rational(-1, 1)), &mut tower.steps)?;
        Some([Fraction::integer(1), b, c])
    }
}

/// The quadratic as a function of t.
fn product_of([a, b, c]: &[Fraction; 3], tower: &mut Tower, term: Term) -> Option<Fraction> {
    let (t, square) = (Fraction::generator(term), Fraction::of(one_of(term, 2)));
    let first = a.times(&square, &mut tower.steps)?;
    let second = b.times(&t, &mut tower.steps)?;
    first.plus(&second, &mut tower.steps)?.plus(c, &mut tower.steps)
}
