//! Values of formulas at points where the premises of a claim hold.

use super::course::Forcing;
use super::point::Style;
use super::system::System;
use super::value::Reals;
use crate::claim::{Statements, Vocabulary};
use crate::tex::Tree;

/// Starts for each point wanted.
const MOST_STARTS: usize = 12;

/// The values of these formulas, in the names of the claim, at up to `wanted` points where its premises hold and the
/// formulas `within` have values: for each formula one at each point, NaN where it has none. Nothing where no such point
/// is found, or where values are complex.
pub fn samples(
    statements: &Statements,
    vocabulary: &Vocabulary,
    of: &[Tree],
    within: &[Tree],
    wanted: usize,
) -> Option<Vec<Vec<f64>>> {
    let all = [of, within].concat();
    let system = System::asked(statements, vocabulary, Forcing::Any, &all).ok()?;
    if system.is_complex {
        return None;
    }
    let (asked, within) = system.asked.split_at_checked(of.len())?;
    let known: Vec<_> = asked.iter().flatten().copied().collect();
    let program = system.formulas.program(&known);
    let domain: Vec<_> = within.iter().flatten().copied().collect();
    let domain = system.formulas.program(&domain);
    let mut values = vec![Vec::new(); of.len()];
    let mut found = 0;
    for start in 0..wanted * MOST_STARTS {
        if found >= wanted || system.work.is_over() {
            break;
        }
        let Ok(point) = system.point::<Reals>(start as u64, Style::Moderate) else {
            continue;
        };
        if system.is_excluded::<Reals>(&point) {
            continue;
        }
        let inputs = system.inputs(&point.values, Some(&point.running));
        if !domain
            .outputs(&domain.run(&inputs))
            .iter()
            .all(|value| value.is_finite())
        {
            continue;
        }
        found += 1;
        let all = program.run(&inputs);
        let mut outputs = program.outputs(&all).into_iter();
        for (value, formula) in values.iter_mut().zip(asked) {
            value.push(formula.and_then(|_| outputs.next()).unwrap_or(f64::NAN));
        }
    }
    (found > 0).then_some(values)
}
