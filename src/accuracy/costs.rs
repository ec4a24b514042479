//! The model of digits and operations by which numbers are chosen, measured.

use super::choice::{Cost, Purpose};
use super::trade::{TradeError, TradeOptions, motions, quantile, starts};
use super::weights::Weights;
use crate::impact::{Kind, Simulation};
use crate::number::{Analytic, Any, Counted, Counts, Interval, Rung, of_type};
use crate::orbit::{Orbit, ProvedOrbit, isolate_one_one};

/// The problems of each purpose.
const PROBLEMS: usize = 30;

/// The impacts of each motion.
const IMPACTS: usize = 10;

/// The numbers that are chosen from.
const CHOSEN: [Rung; 5] = [
    Rung::Double,
    Rung::DoubleDouble,
    Rung::Wide(50),
    Rung::Wide(100),
    Rung::Wide(200),
];

/// Any of the numbers, its operations counted.
type Number = Counted<Any>;

/// The digits of the bounds and the operations of both purposes in every number that is chosen from: what
/// `golden/accuracy/costs.csv` holds. The same in every run.
///
/// An orbit is proved again from where f64 proved it, with stability and clearance; an impact is one of the first ten of
/// a motion, with the growth of its errors.
///
/// # Errors
/// `Points` where no problem has an answer.
pub fn measured_costs() -> Result<Vec<Cost>, TradeError> {
    let weights = Weights::measured();
    let mut rows = Vec::new();
    for (purpose, method) in [(Purpose::Orbit, "certified"), (Purpose::Impact, "own")] {
        for rung in CHOSEN {
            let (digits, counts) = of_type(rung, || match purpose {
                Purpose::Orbit => orbits(),
                Purpose::Impact => impacts(),
            });
            let cost = weights.cost(rung, &counts);
            let (Some(cost), false) = (cost, digits.is_empty()) else {
                return Err(TradeError::Points {
                    task: purpose.name().to_owned(),
                });
            };
            let mean = |total: u64| total / digits.len() as u64;
            let rounded = |digits: f64| (10.0 * digits).round() / 10.0;
            rows.push(Cost {
                task: purpose.name().to_owned(),
                method: method.to_owned(),
                number: rung.to_string(),
                worst_digits: rounded(quantile(&digits, 0.0)),
                median_digits: rounded(quantile(&digits, 0.5)),
                best_digits: rounded(quantile(&digits, 1.0)),
                operations: mean(counts.total()),
                sincos: mean(counts.sincos),
                divisions: mean(counts.divisions),
                cost: mean(cost),
            });
        }
    }
    Ok(rows)
}

/// The digits of each orbit's bound, and all operations.
fn orbits() -> (Vec<f64>, Counts) {
    let mut digits = Vec::new();
    let mut all = Counts::default();
    for motion in motions(&TradeOptions::default(), PROBLEMS) {
        let Ok(line) = motion.convert(|value| Interval::from_f64(*value)) else {
            continue;
        };
        for root in &isolate_one_one(&line, 1).motions {
            let proved = ProvedOrbit::Pair { root, periods: 1 };
            let (orbit, counts) = Counts::of(|| proved.orbit::<Number>(&motion));
            let Ok(orbit) = orbit else { continue };
            digits.push(digits_of_bounds(&orbit));
            all = all.and(&counts);
        }
    }
    (digits, all)
}

/// The least digits of any value told of an orbit.
fn digits_of_bounds(orbit: &Orbit<Number>) -> f64 {
    let least = std::cell::Cell::new(f64::INFINITY);
    orbit.all_are(|value| {
        let digits = if value.contains_zero() {
            -value.magnitude().to_f64().log10()
        } else {
            (value.mignitude().to_f64() / value.radius().to_f64()).log10()
        };
        least.set(least.get().min(digits));
        true
    });
    least.get()
}

/// The digits of each impact, and all operations.
fn impacts() -> (Vec<f64>, Counts) {
    let mut digits = Vec::new();
    let mut all = Counts::default();
    for (motion, start) in starts(&TradeOptions::default(), PROBLEMS) {
        let number = |value: &f64| <Number as Analytic>::from_f64(*value);
        let Ok(motion) = motion.convert(number) else { continue };
        let start = start.convert(number);
        let (found, counts) = Counts::of(|| {
            let mut simulation = Simulation::new(&motion, &start).with_growth();
            let mut found = Vec::new();
            while let Some(event) = simulation.next().filter(|_| found.len() < IMPACTS) {
                if event.kind != Kind::Impact {
                    break;
                }
                let growth = simulation.growth();
                let digits = growth.map_or(0, |growth| growth.digits(event.velocity.to_f64()));
                found.push(f64::from(digits));
            }
            found
        });
        digits.extend(found);
        all = all.and(&counts);
    }
    (digits, all)
}
