//! The task `voltage`: the output of an impact, (5) and (6), as printed and without cancellation.

use super::contest::{self, BITS, EVERY, Form, Means, RIGHT, Task, Twice, relative_error};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use dynamics::model::{Membrane, MembraneError};
use numbers::{Analytic, Machine, Rung, Sequence};

/// The membrane of Table 1, each number rounded to f32, so that every number is asked about the same one: ball mass,
/// stiffness, exponent, radii of ball and membrane, input voltage.
const MEMBRANE: [f32; 6] = [0.0035, 4.0847e5, 2.6, 0.005, 0.0063, 2000.0];

/// That membrane.
pub(super) fn membrane<T: Analytic>() -> Result<Membrane<T>, MembraneError> {
    let [mass, stiffness, exponent, ball, rim, input] =
        MEMBRANE.map(|value| <T as Analytic>::from_f64(f64::from(value)));
    Membrane::new(mass, stiffness, exponent, ball, rim, input)
}

/// How fast the impacts are, as powers of ten of m/s.
const REGIONS: [(&str, [f64; 2]); 2] = [("voltage/ordinary", [-1.0, 1.3]), ("voltage/slight", [-9.0, -3.0])];

/// Printed: (5) and (6) as they stand. Stable: without the difference.
struct Way(Form);

impl Means<f64> for Way {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn rungs(&self) -> &'static [Rung] {
        EVERY
    }

    fn answer<T: Machine>(&self, speed: &f64) -> Result<Vec<T>, Unsolved> {
        let membrane = membrane::<T>().map_err(|_| Unsolved::LeftDomain)?;
        let speed = <T as Analytic>::from_f64(*speed);
        Ok(vec![match self.0 {
            Form::Printed => membrane.voltage_as_printed(&speed),
            Form::Stable => membrane.voltage(&speed),
        }])
    }
}

/// The trade of task `voltage`: impacts of 0.1 to 20 m/s, and slight ones.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut rows = Vec::new();
    for (name, [low, high]) in REGIONS {
        let mut sequence = Sequence::new(options.seed);
        let mut speed = || f64::from(10_f64.powf(sequence.on_grid(BITS, low, high)) as f32);
        let speeds: Vec<f64> = (0..options.points).map(|_| speed()).collect();
        let task = Task {
            name: name.to_owned(),
            points: &speeds,
            error: relative_error,
            miss: |_, _| Unsolved::FewDigits,
            place: |speed| format!("speed={speed}"),
            right: RIGHT,
        };
        let exact: Twice<f64> = |speed| {
            Some([
                Way(Form::Stable).answer(speed).ok()?,
                Way(Form::Printed).answer(speed).ok()?,
            ])
        };
        rows.extend(contest::rows(&task, exact, &Form::ALL.map(Way), options)?);
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_form_loses_digits_of_slight_impacts_and_ours_does_not() {
        let options = TradeOptions {
            points: 40,
            seconds_per_row: 0.0,
            ..TradeOptions::default()
        };
        let rows = rows(&options).expect("a trade");
        let worst = |task: &str, method: &str| {
            let row = rows
                .iter()
                .find(|row| row.task == task && row.method == method && row.number == Rung::Double);
            row.expect("a row").worst
        };
        assert!(worst("voltage/slight", "stable") > 14.0 && worst("voltage/ordinary", "stable") > 14.0);
        assert!(worst("voltage/slight", "printed") < 11.0);
    }
}
