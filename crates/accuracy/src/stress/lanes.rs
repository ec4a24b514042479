//! Impacts followed in lanes, as a sweep does, and one by one, where a device is at an extreme.

use super::StressError;
use super::impacts::{Setup, SimulatedImpact, error, fix};
use super::quantity::{Exact, widen};
use super::row::StressRow;
use dynamics::impact::{Batch, Start};
use dynamics::model::{Motion, Side};
use dynamics::orbit::OrbitImpact;

/// The extremes, each with g, d, r_B, r_T and the start impact at the bottom: nothing is lost, gravity as strong as the
/// forcing, a gap hardly wider than nothing, a flight that passes a wall a billionth of the gap away.
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
pub(super) const IMPACTS: u32 = 8;

/// As many motions as make lanes worth while.
const MOTIONS: usize = 16;

/// The names of the cases.
pub(super) fn cases() -> impl Iterator<Item = &'static str> {
    DEVICES.into_iter().map(|(case, _)| case)
}

/// The rows of a case: phase and velocity at an impact, some impacts on, in lanes and one by one.
///
/// # Errors
/// `Point` where the motion ends before, `Reference` where the map (8) does not confirm it.
pub(super) fn rows(case: &'static str) -> Result<Vec<StressRow>, StressError> {
    let found = DEVICES.into_iter().find(|(name, _)| *name == case);
    let Some((_, inputs)) = found else {
        return Err(StressError::NoCase(case.to_owned()));
    };
    let impacts = IMPACTS;
    let simulated = SimulatedImpact {
        inputs,
        setup: Setup::Paper,
        impacts,
    };
    let known = simulated.known(case)?;
    let error = error(in_lanes(&inputs), &known.fix);
    let at = format!("{};motions={MOTIONS}", simulated.at());
    let mut rows = vec![StressRow::stable(case, "(8) in lanes", error, known.condition, at)];
    rows.extend(simulated.rows(case)?);
    Ok(rows)
}

/// The impact in lanes.
fn in_lanes([g, d, r_b, r_t, phase, velocity]: &[f64; 6]) -> Option<OrbitImpact<Exact>> {
    let motion = Motion::new(*g, *d, *r_b, *r_t).ok()?;
    let start = Start::impact(Side::Bottom, *phase, *velocity);
    let motions = vec![(motion, start); MOTIONS];
    let mut events = Vec::new();
    Batch::new(&motions).run(u64::from(IMPACTS) + 1, |index, event| {
        if index == MOTIONS / 2 {
            events.push(fix(widen(&event.phase), widen(&event.velocity)));
        }
    });
    events.into_iter().nth(IMPACTS as usize)
}

#[cfg(test)]
mod tests {
    use super::super::row::Form;
    use super::*;

    #[test]
    fn lanes_keep_as_many_digits_as_impacts_one_by_one_and_no_row_is_below_the_bar() {
        for case in cases() {
            let rows = rows(case).unwrap();
            assert!(rows.iter().all(|row| !row.is_below_bar()), "{rows:#?}");
            let of_f64 = |row: &&StressRow| row.form == Form::Stable && row.number == "f64";
            let digits: Vec<f64> = rows.iter().filter(of_f64).map(|row| row.digits).collect();
            assert!((digits[0] - digits[1]).abs() < 1.5, "{rows:#?}");
        }
    }
}
