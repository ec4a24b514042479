//! How the voltage changes with each parameter of a device, the motion followed.

use crate::model::Motion;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::optimum::design::Choice;
use crate::orbit::optimum::incumbent::ProvedDevice;
use numbers::{Dual, seeded};

/// The derivatives of the voltage per forcing period by the parameters of the capsule, r_B and r_T, in f64; those of a
/// parameter that is held too. `None` at a fold, where the motion cannot be followed.
///
/// By dual numbers: h_1 = h_2 = 0 gives the derivatives of T_1 and the phase (implicit function theorem), these and the
/// parameter those of the speeds.
pub fn sensitivities(choice: &Choice, device: &ProvedDevice) -> Option<[f64; 4]> {
    let devices = choice.devices.convert(|value| Dual::from_re(value.midpoint()));
    let values = device.parameters.map(|value| value.midpoint());
    let periods = device.orbit.periods;
    let (t_1, middle) = (device.orbit.times[0].midpoint(), device.middle.midpoint());
    let mut found = [0.0; 4];
    for (index, found) in found.iter_mut().enumerate() {
        let parameters: [Dual<f64>; 4] = std::array::from_fn(|i| match i == index {
            true => seeded(values[i]),
            false => Dual::from_re(values[i]),
        });
        let [first, second, r_b, r_t] = &parameters;
        let [d, g] = devices.capsule([first, second]);
        let motion = Motion::new(g, d, *r_b, *r_t).ok()?;
        let balance = OneOneEquations::new(&motion, periods);
        let (values, [[a, b], [c, e]]) = balance.linearised(&Dual::from_re(t_1), &Dual::from_re(middle));
        let determinant = a.re * e.re - b.re * c.re;
        let [one, other] = values.map(|value| -value.eps);
        let t_1 = Dual::new(t_1, (e.re * one - b.re * other) / determinant);
        let middle = Dual::new(middle, (a.re * other - c.re * one) / determinant);
        let [v, w] = balance.velocities(&t_1, &middle);
        *found = devices.voltages(first, [&v, &-w]).eps / f64::from(periods);
    }
    found.iter().all(|value| value.is_finite()).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Side;
    use crate::orbit::optimum::incumbent::LocalSearch;
    use crate::orbit::optimum::paper_choice;
    use numbers::Interval;

    #[test]
    fn the_sensitivities_are_those_of_differences() {
        let choice = paper_choice([[0.3, 0.45], [0.1, 0.13], [0.5, 0.7], [0.3, 0.5]]);
        let local = LocalSearch::new(&choice);
        let here = [0.4, 0.122_01, 0.6, 0.4];
        let candidate = local.at(here, None).expect("a motion");
        let device = choice.prove(&candidate).expect("a proof");
        let found = sensitivities(&choice, &device).expect("no fold");
        for index in 0..4 {
            let at = |shift: f64| {
                let mut there = here;
                there[index] += shift;
                local.at(there, None).expect("a motion").rate
            };
            let step = 1e-5;
            let by_difference = (at(step) - at(-step)) / (2.0 * step);
            let error = (found[index] - by_difference).abs();
            assert!(
                error < 1e-4 * by_difference.abs() + 1.0,
                "{index} {} {by_difference}",
                found[index]
            );
        }
        assert_eq!(device.orbit.word.sides().next(), Some(Side::Bottom));
        assert!(device.rate.width() < 1e-6 && Interval::point(candidate.rate).intersection(&device.rate).is_some());
    }
}
