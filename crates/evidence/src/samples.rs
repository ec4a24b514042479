//! Values of formulas at points where the premises of a claim hold.

use super::point::Style;
use super::system::{Forcing, System};
use super::value::{Complexes, Numbers, Reals, Value};
use claims::Statements;
use texmath::{Symbols, Tree};

/// Starts for each point wanted.
const MOST_STARTS: usize = 12;

/// Values of formulas at points where premises hold.
#[derive(Clone, Debug)]
pub struct Samples {
    /// For each formula the real and the imaginary part at each point, NaN where it has no value.
    pub values: Vec<Vec<[f64; 2]>>,
    /// Whether the claim is read over the complex numbers.
    pub is_complex: bool,
}

/// The values of these formulas, in the names of the claim, at up to `wanted` points where its premises hold and the
/// formulas `within` have values. Nothing where no such point is found.
pub fn samples(
    statements: &Statements,
    symbols: &Symbols,
    of: &[Tree],
    within: &[Tree],
    wanted: usize,
) -> Option<Samples> {
    let all = [of, within].concat();
    let system = System::asked(statements, symbols, Forcing::Any, &all).ok()?;
    let values = match system.is_complex {
        true => drawn::<Complexes>(&system, of.len(), wanted),
        false => drawn::<Reals>(&system, of.len(), wanted),
    };
    Some(Samples {
        values: values?,
        is_complex: system.is_complex,
    })
}

fn drawn<N: Numbers>(system: &System, count: usize, wanted: usize) -> Option<Vec<Vec<[f64; 2]>>> {
    let (asked, within) = system.asked.split_at_checked(count)?;
    let known: Vec<_> = asked.iter().flatten().copied().collect();
    let program = system.formulas.program(&known);
    let domain: Vec<_> = within.iter().flatten().copied().collect();
    let domain = system.formulas.program(&domain);
    let mut values = vec![Vec::new(); count];
    let mut found = 0;
    for start in 0..wanted * MOST_STARTS {
        if found >= wanted || system.work.is_over() {
            break;
        }
        let Ok(point) = system.point::<N>(start as u64, Style::Moderate) else {
            continue;
        };
        if system.is_excluded::<N>(&point) {
            continue;
        }
        let inputs = system.inputs(&point.values, Some(&point.running));
        let is_finite = |value: &N::Of<f64>| value.parts().iter().all(|part| part.is_finite());
        if !domain.outputs(&domain.run(&inputs)).iter().all(is_finite) {
            continue;
        }
        found += 1;
        let all = program.run(&inputs);
        let mut outputs = program.outputs(&all).into_iter();
        for (value, formula) in values.iter_mut().zip(asked) {
            let next = formula.and_then(|_| outputs.next());
            value.push(next.map_or([f64::NAN; 2], |next| next.parts()));
        }
    }
    (found > 0).then_some(values)
}
