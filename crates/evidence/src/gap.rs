//! The two sides of a claim compared at a point.

use super::formula::Formula;
use super::newton::rough;
use super::system::{Question, System};
use super::tolerance::{EQUAL_WIDE, MOST_DIGITS, PREMISE};
use super::value::{Numbers, Real, Value};
use texmath::Relation;

/// How far apart two sides are, relative to the size of their terms, and what they are.
#[derive(Clone, Debug)]
pub struct Gap {
    pub relative: f64,
    pub apart: f64,
    /// For an inequality, whether it holds; where equality decides, as near as can be told.
    pub fails: bool,
    pub is_inequality: bool,
    /// Whether it was found in many digits.
    pub is_close: bool,
    pub left: [f64; 2],
    pub right: [f64; 2],
}

impl Gap {
    /// The decimal digits in which the sides agree.
    pub fn digits(&self) -> f64 {
        digits(self.relative)
    }

    /// By how much the claim fails, for comparison.
    pub fn badness(&self) -> f64 {
        match (self.is_inequality, self.fails) {
            (true, true) => 1.0 + self.relative,
            (true, false) => 0.0,
            (false, _) => self.relative,
        }
    }
}

/// The decimal digits of a relative gap.
pub fn digits(relative: f64) -> f64 {
    if relative > 0.0 {
        (-relative.log10()).clamp(0.0, MOST_DIGITS)
    } else {
        MOST_DIGITS
    }
}

/// Where a premise that is fitted at -1, 0 and 1 must be the same quadratic: two integers would be met by absolute values.
const ELSEWHERE: [i64; 3] = [2, 7, -11];

impl System {
    /// The gap of one equation at a point; nothing where a side has no value there.
    pub fn gap<N: Numbers, T: Real>(
        &self,
        question: &Question,
        values: &[N::Of<T>],
        running: &N::Of<T>,
    ) -> Option<Gap> {
        let found = question.program.run(&self.inputs(values, Some(running)));
        let near: Vec<N::Of<f64>> = found.iter().map(rough::<N, T>).collect();
        let sizes = question.program.sizes(&near, &self.solved::<N, T>(values))?;
        let sides: Vec<(N::Of<T>, f64)> = question
            .program
            .outputs
            .iter()
            .map(|&output| Some((found.get(output)?.clone(), *sizes.get(output)?)))
            .collect::<Option<_>>()?;
        if let Some(slot) = question.pair {
            return self.pair_gap::<N, T>(slot, &sides, values).filter(Gap::is_finite);
        }
        let gaps = sides.chunks(2).map(|pair| match pair {
            [left, right] => compare::<N, T>(left, right, question.relation),
            _ => None,
        });
        let gaps: Option<Vec<Gap>> = gaps.collect();
        let worst = gaps?.into_iter().max_by(|a, b| a.badness().total_cmp(&b.badness()));
        worst.filter(Gap::is_finite)
    }

    /// Whether the two values on the right are the two solutions of a premise for the slot: of a quadratic by their sum
    /// and product, else by the premises' residuals.
    fn pair_gap<N: Numbers, T: Real>(
        &self,
        slot: usize,
        sides: &[(N::Of<T>, f64)],
        values: &[N::Of<T>],
    ) -> Option<Gap> {
        let rights: Vec<&(N::Of<T>, f64)> = sides.iter().skip(1).step_by(2).collect();
        let (x, y) = (rights.first()?, rights.last()?);
        let premises: Vec<_> = self
            .rows
            .iter()
            .chain(&self.late)
            .copied()
            .filter(|row| self.formulas.slots(&[*row]).contains(&slot))
            .collect();
        if premises.is_empty() {
            return None;
        }
        let at = |value: &N::Of<T>, premise: Formula| -> Option<(N::Of<T>, f64)> {
            let mut values = values.to_vec();
            *values.get_mut(slot)? = value.clone();
            let program = self.formulas.program(&[premise]);
            let found = program.run(&self.inputs(&values, None));
            let near: Vec<N::Of<f64>> = found.iter().map(rough::<N, T>).collect();
            let output = *program.outputs.first()?;
            Some((
                found.get(output)?.clone(),
                *program.sizes(&near, &self.solved::<N, T>(&values))?.get(output)?,
            ))
        };
        let number = |n: i64| N::Of::<T>::integer(n);
        // a condition may leave one of the two solutions
        let both = premises.iter().filter(|_| self.conditions.is_empty());
        for &premise in both {
            let at_integer = |n: i64| at(&number(n), premise);
            let (Some((c, _)), Some((plus, _)), Some((minus, _))) = (at_integer(0), at_integer(1), at_integer(-1))
            else {
                continue;
            };
            let b = (plus.clone() - minus.clone()).over(&number(2));
            let a = (plus + minus).over(&number(2)) - c.clone();
            let is_quadratic = |n: i64| {
                at_integer(n).is_some_and(|(found, size)| {
                    let fitted = (number(n) * a.clone() + b.clone()) * number(n) + c.clone();
                    a.size() > 1e-9 * size && (fitted - found).size() <= 1e-9 * size
                })
            };
            if !ELSEWHERE.into_iter().all(is_quadratic) {
                continue;
            }
            let (p, q) = (x.0.size(), y.0.size());
            let sum = ((-b.over(&a), p + q), (x.0.clone() + y.0.clone(), x.1 + y.1));
            let product = (
                (c.over(&a), p * q),
                (x.0.clone() * y.0.clone(), x.1 * q.max(p) + y.1 * p.max(q)),
            );
            let gaps = [
                compare::<N, T>(&sum.0, &sum.1, Relation::Equal)?,
                compare::<N, T>(&product.0, &product.1, Relation::Equal)?,
            ];
            return gaps.into_iter().max_by(|a, b| a.relative.total_cmp(&b.relative));
        }
        // Both must satisfy every premise, and be distinct ways to the value that there is.
        let known = (values.get(slot)?.clone(), values.get(slot)?.size());
        let own = [x, y].map(|side| compare::<N, T>(&known, side, Relation::Equal));
        let nearest = own
            .into_iter()
            .flatten()
            .min_by(|a, b| a.relative.total_cmp(&b.relative));
        let mut gaps: Vec<Gap> = nearest.into_iter().collect();
        for side in [x, y] {
            for &premise in &premises {
                let zero = (number(0), 0.0);
                gaps.extend(compare::<N, T>(&at(&side.0, premise)?, &zero, Relation::Equal));
            }
        }
        gaps.into_iter().max_by(|a, b| a.relative.total_cmp(&b.relative))
    }
}

impl Gap {
    fn is_finite(&self) -> bool {
        let all = self.left.iter().chain(&self.right);
        self.relative.is_finite() && all.into_iter().all(|part| part.is_finite())
    }
}

/// Compares two sides, each with the size of its terms.
fn compare<N: Numbers, T: Real>(left: &(N::Of<T>, f64), right: &(N::Of<T>, f64), relation: Relation) -> Option<Gap> {
    let difference = left.0.clone() - right.0.clone();
    let gap = difference.size();
    let size = left.1.max(right.1);
    let is_zero = difference.parts().iter().all(num_traits::Zero::is_zero);
    // what f64 cannot show the size of is not told
    if !size.is_finite() || (gap == 0.0 && !is_zero) {
        return None;
    }
    let relative = if gap == 0.0 { 0.0 } else { gap / size };
    let [re, im] = difference.parts().map(|part| part.to_f64());
    let is_wide = T::epsilon().to_f64() < 1e-20;
    // Below this the sides may as well be equal.
    let equal = relative <= if is_wide { EQUAL_WIDE } else { PREMISE };
    let is_inequality = relation != Relation::Equal;
    if is_inequality && relation != Relation::NotEqual && im != 0.0 {
        return None;
    }
    let fails = match relation {
        Relation::Equal => !equal,
        Relation::NotEqual => equal,
        Relation::Less => equal || re >= 0.0,
        Relation::LessOrEqual => !equal && re > 0.0,
        Relation::Greater => equal || re <= 0.0,
        Relation::GreaterOrEqual => !equal && re < 0.0,
    };
    let parts = |value: &N::Of<T>| value.parts().map(|part| part.to_f64());
    Some(Gap {
        relative,
        apart: gap,
        fails,
        is_inequality,
        is_close: is_wide,
        left: parts(&left.0),
        right: parts(&right.0),
    })
}
