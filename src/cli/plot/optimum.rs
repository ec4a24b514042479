//! The best device of the box of a scene, and the devices around it.

use super::super::{Failure, optimise};
use crate::model::Motion;
use crate::number::Interval;
use crate::orbit::{Choice, Optimum, Word, find};
use crate::report::figure::{BestValue, Parameter, Slice, slices};
use crate::report::plot::Panel;
use crate::scene::{BoxChoice, Scene};
use rayon::prelude::*;

/// So many devices along each parameter: of every one all 1-1 motions are found.
const POINTS: usize = 41;

/// A panel for each two of the parameters that have a range; of one alone, a line.
pub(super) fn panels(scene: &Scene) -> Result<Vec<Panel>, Failure> {
    let asked = scene.choice()?;
    if asked.local.is_some() {
        let usage = "the box is drawn for BT under the forcing of the paper; `optimise` finds devices of other motions";
        return Err(Failure::Usage(usage.to_owned()));
    }
    let found = optimise::usual(&asked);
    let ranges = &asked.choice.ranges;
    let free: Vec<usize> = (0..ranges.len()).filter(|&i| !ranges[i].is_held()).collect();
    let drawn: Vec<Vec<usize>> = match free.as_slice() {
        [one] => vec![vec![*one]],
        several => several
            .iter()
            .enumerate()
            .flat_map(|(place, &x)| several[place + 1..].iter().map(move |&y| vec![x, y]))
            .collect(),
    };
    let drawn: Vec<Slice> = drawn.iter().map(|own| slice(&asked, &found, &free, own)).collect();
    let name = match &found.device {
        Some(device) => format!("best device, {:.3} kV", device.rate.midpoint() / 1000.0),
        None => "best device".to_owned(),
    };
    Ok(slices(&drawn, &name))
}

/// The devices over some parameters of the box; the others are those of the best device, or in the middle of their ranges
/// where there is none.
fn slice(asked: &BoxChoice, found: &Optimum, free: &[usize], own: &[usize]) -> Slice {
    let choice = &asked.choice;
    let base: [f64; 4] = std::array::from_fn(|i| match &found.device {
        Some(device) => device.parameters[i].midpoint(),
        None => choice.ranges[i].hull().midpoint(),
    });
    let count = own.iter().map(|_| POINTS).product();
    let at = |index: usize| {
        let mut parameters = base;
        let mut rest = index;
        for &i in own {
            let (low, high) = (choice.ranges[i].low.midpoint(), choice.ranges[i].high.midpoint());
            let part = (rest % POINTS) as f64 / (POINTS - 1) as f64;
            parameters[i] = (low + (high - low) * part).min(high);
            rest /= POINTS;
        }
        parameters
    };
    let values: Vec<usize> = (0..count).collect();
    let values = values
        .par_iter()
        .map(|&index| rate(choice, at(index)).unwrap_or(f64::NAN));
    let parameter = |&i: &usize| {
        let ends = (choice.ranges[i].low.midpoint(), choice.ranges[i].high.midpoint());
        let best = found.device.as_ref().zip(found.place);
        let best = best.map(|(device, place)| BestValue {
            found: device.parameters[i].midpoint(),
            proved: (place[i].low(), place[i].high()),
        });
        (Parameter::new(asked.parameters[i].name(), ends), best)
    };
    let held = free.iter().filter(|i| !own.contains(i));
    let held: Vec<String> = held
        .map(|&i| format!("{} = {:.4}", symbol(asked.parameters[i].name()), base[i]))
        .collect();
    Slice {
        parameters: own.iter().map(parameter).collect(),
        points: POINTS,
        values: values.collect(),
        heading: match held.join(", ") {
            held if held.is_empty() => String::new(),
            held => format!("Devices with {held}"),
        },
    }
}

/// The symbol of a parameter of a box.
fn symbol(name: &str) -> &str {
    match name {
        "r_b" => "r_B",
        "r_t" => "r_T",
        "incline" => "beta",
        "forcing_amplitude" => "A",
        other => other,
    }
}

/// Volts per forcing period of the best 1-1 motion of a device that is as asked; `None` where there is none.
fn rate(choice: &Choice, [first, second, r_b, r_t]: [f64; 4]) -> Option<f64> {
    let devices = choice.devices.convert(Interval::midpoint);
    let [d, g] = devices.capsule([&first, &second]);
    let motion = Motion::new(g, d, r_b, r_t).ok()?;
    let found = find(&motion, &Word::pair(), choice.max_periods).ok()?;
    let (margin, clearance) = (choice.margin.midpoint(), choice.clearance.midpoint());
    let as_asked = found.orbits.iter().filter(|orbit| {
        let slack = 1.0 + orbit.determinant - margin - orbit.trace.abs();
        orbit.stable && orbit.admissible && slack >= 0.0 && orbit.clearance >= clearance
    });
    let rates = as_asked.map(|orbit| {
        let speeds = [orbit.velocities[0].abs(), orbit.velocities[1].abs()];
        devices.voltages(&first, [&speeds[0], &speeds[1]]) / f64::from(orbit.periods)
    });
    rates.reduce(f64::max)
}
