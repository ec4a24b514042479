//! Impacts followed in lanes, as a sweep does, and one by one, where a device is at an extreme.

use super::StressError;
use super::quantity::{Exact, largest, widen};
use super::row::{StressRow, place};
use crate::impact::{Batch, Kind, Simulation, Start};
use crate::model::{Motion, Side};
use crate::number::{Analytic, Dual, seeded};

/// What fixes a motion: g, d, r_B, r_T, and the start impact at the bottom.
const INPUTS: [&str; 6] = ["g", "d", "r_B", "r_T", "phase", "velocity"];

/// The extremes, each with a device: nothing is lost, gravity as strong as the forcing, a gap hardly wider than nothing, a
/// flight that passes a wall a billionth of the gap away.
const DEVICES: [(&str, [f64; 6]); 4] = [
    ("impacts, r near 1", [0.12201, 0.3, 1.0 - 1e-9, 1.0 - 1e-12, 0.7, 0.6]),
    ("impacts, |g| near 1", [1.0 - 1e-9, 0.3, 0.6, 0.3, 0.7, 0.6]),
    ("impacts, d near 0", [0.12201, 1e-6, 0.9, 0.8, 0.7, 0.02]),
    (
        "impacts, grazing",
        [
            0.12201,
            0.114_429_798_5,
            0.6,
            0.6,
            0.504_015_136_013_395_6,
            0.492_666_037_500_908_66,
        ],
    ),
];

/// The impacts after that of the start: few enough that errors which grow leave digits to compare.
const IMPACTS: usize = 8;

/// As many motions as make lanes worth while.
const MOTIONS: usize = 16;

/// The names of the cases.
pub(super) fn cases() -> impl Iterator<Item = &'static str> {
    DEVICES.into_iter().map(|(case, _)| case)
}

/// The rows of a case: phase and velocity at an impact, some impacts on. Stable is both what lanes and what `Simulation`
/// make of it, and they are told apart by `formula`.
///
/// # Errors
/// `Point` where the motion ends before.
pub(super) fn rows(case: &'static str) -> Result<Vec<StressRow>, StressError> {
    let found = DEVICES.into_iter().find(|(name, _)| *name == case);
    let Some((_, inputs)) = found else {
        return Err(StressError::NoCase(case.to_owned()));
    };
    let at = place(&INPUTS, &inputs);
    let fault = || StressError::Point { case, at: at.clone() };
    let lifted = inputs.map(<Exact as Analytic>::from_f64);
    let exact = last(&lifted).ok_or_else(fault)?;
    let condition = condition(&lifted, &exact).ok_or_else(fault)?;
    let made = [
        ("(8) in lanes", in_lanes(&inputs).ok_or_else(fault)?),
        ("(8)", last(&inputs).ok_or_else(fault)?),
    ];
    let row = |(formula, found): (&str, [f64; 2])| {
        let error = apart(&found.map(|value| widen(&value)), &exact);
        StressRow::stable(case, formula, error, condition, at.clone())
    };
    Ok(made.map(row).to_vec())
}

fn motion<T: Analytic>([g, d, r_b, r_t, phase, velocity]: &[T; 6]) -> Option<(Motion<T>, Start<T>)> {
    let motion = Motion::new(g.clone(), d.clone(), r_b.clone(), r_t.clone()).ok()?;
    let start = Start {
        side: Side::Bottom,
        phase: phase.clone(),
        velocity: velocity.clone(),
    };
    Some((motion, start))
}

/// Phase and velocity at the last impact, one by one.
fn last<T: Analytic>(inputs: &[T; 6]) -> Option<[T; 2]> {
    let (motion, start) = motion(inputs)?;
    let event = Simulation::new(&motion, &start).nth(IMPACTS)?;
    (event.kind == Kind::Impact).then_some([event.phase, event.velocity])
}

/// The same in lanes.
fn in_lanes(inputs: &[f64; 6]) -> Option<[f64; 2]> {
    let motions = vec![motion(inputs)?; MOTIONS];
    let mut events = Vec::new();
    Batch::new(&motions).run(IMPACTS as u64 + 1, |index, event| {
        if index == MOTIONS / 2 {
            events.push([event.phase, event.velocity]);
        }
    });
    events.get(IMPACTS).copied()
}

/// The most that phase and velocity change, relatively to themselves, for relative changes of all inputs.
fn condition(inputs: &[Exact; 6], exact: &[Exact; 2]) -> Option<f64> {
    let mut changes = [0.0; 2];
    for index in 0..inputs.len() {
        let mut lifted = inputs.each_ref().map(|input| Dual::from_re(input.clone()));
        lifted[index] = seeded(inputs[index].clone());
        let slopes = last(&lifted)?;
        for ((change, slope), value) in changes.iter_mut().zip(slopes).zip(exact) {
            *change += (slope.eps * inputs[index].clone() / value.clone()).to_f64().abs();
        }
    }
    Some(largest(changes))
}

fn apart(found: &[Exact; 2], exact: &[Exact; 2]) -> f64 {
    let pairs = found.iter().zip(exact);
    largest(pairs.map(|(found, exact)| ((found.clone() - exact.clone()) / exact.clone()).to_f64().abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_keep_as_many_digits_as_impacts_one_by_one_and_no_row_is_below_the_bar() {
        for case in cases() {
            let rows = rows(case).unwrap();
            assert!(rows.iter().all(|row| !row.is_below_bar()), "{rows:#?}");
            assert!((rows[0].digits - rows[1].digits).abs() < 1.5, "{rows:#?}");
        }
    }
}
