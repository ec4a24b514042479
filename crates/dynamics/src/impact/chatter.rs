//! The end of a chatter: infinitely many impacts in a finite time.

use super::expansion::Expansion;
use super::waves::Waves;
use numbers::Analytic;

/// Impacts of a chatter that completes are listed down to this velocity.
pub const LISTED: f64 = 1e-6;

/// The angle after which a chatter is complete, for a ball that leaves a wall with velocity `start.w` and is pressed
/// back to it, with restitution `r`; `None` where that is not yet known to the precision of the number, or where the
/// chatter may not complete at all. `most_bend` bounds |f''|.
///
/// With U = w / (1 - r), push a and its slope j, the angle is 2U/a - (4/3) jU²/a³ + O(U³): the functional equation
/// T(w, a) = flight + T(r w', a') solved order by order. The third order has the coefficients
/// (8/9)(2r²+3r+2)/(1+r+r²) j²/a⁵, at most 2.1, and -(2/3)(1+r)²/(1+r+r²) a''/a⁴, at most 0.9; twice that bounds the
/// error where U a'/a² is small.
pub(super) fn accumulation<T: Analytic, W: Waves<T>>(
    start: &Expansion<T, W>,
    r: &T,
    most_bend: f64,
    epsilon: f64,
) -> Option<T> {
    let (a, w) = (start.push.to_f64(), start.w.to_f64());
    let room = T::one() - r.clone();
    let reach = w / room.to_f64();
    let (slope, bend) = (
        start.waves.minus_slope().to_f64(),
        start.waves.minus_curvature().to_f64().abs(),
    );
    // how much the push changes meanwhile, over itself
    let change = (slope * reach / (a * a))
        .abs()
        .max(most_bend * reach * reach / (a * a * a));
    // 1 / 0 for r = 1, and NaN: no
    if !(a > 0.0 && change < 0.01) {
        return None;
    }
    let error = 2.0 * (2.1 * slope * slope / (a * a) + 0.9 * bend / a) * (reach / a).powi(3);
    if error > 0.25 * epsilon {
        return None;
    }
    let push = &start.push;
    let flight = start.w.clone() / (room * push.clone());
    let bent = start.waves.minus_slope() * flight.clone() / push.clone() * T::from_ratio(4, 3);
    Some(flight.clone() * (T::from_integer(2) + bent))
}

#[cfg(test)]
mod tests {
    use super::super::scaled::{Departure, Scaled};
    use super::super::simulation::Simulation;
    use super::super::start::Start;
    use super::super::waves::Cosine;
    use super::*;
    use crate::impact::Kind;
    use crate::model::{Motion, Side};
    use numbers::Wide;

    type Number = Wide<100>;

    fn start_at(phase: f64, speed: f64) -> (Scaled<f64>, Expansion<f64, Cosine<f64>>) {
        let motion = Motion::new(0.1, 0.3, 0.6, 0.6).expect("a motion");
        let scaled = Scaled::new(&motion);
        let from = Departure {
            side: Side::Bottom,
            phase,
            waves: Cosine::at(&(), &phase),
            speed,
            height: None,
            released: false,
        };
        let start = Expansion::start(&scaled, &from);
        (scaled, start)
    }

    /// The phase at which the impacts accumulate, summed impact by impact until nothing is left in f64.
    fn summed(phase: f64, speed: f64, r: f64) -> f64 {
        let motion = Motion::new(0.1, 0.3, r, r)
            .expect("a motion")
            .convert(|value| Number::from_f64(*value));
        let velocity = Number::from_f64(speed) / (Number::from_f64(r) * Number::pi());
        let start = Start::impact(Side::Bottom, Number::from_f64(phase), velocity);
        let rest = Simulation::new(&motion.expect("a motion"), &start).find(|event| event.kind == Kind::Rest);
        let phase = rest.expect("a rest").phase - Number::from_f64(phase);
        phase.to_f64()
    }

    #[test]
    fn the_closed_form_is_the_sum_of_all_flights_to_the_precision_it_promises() {
        for (phase, r) in [(0.3, 0.6), (5.5, 0.9), (1.2, 0.3), (0.0, 0.05)] {
            for speed in [1e-5, 1e-6, 1e-8] {
                let (_, start) = start_at(phase, speed);
                let loose = 1e-12;
                let Some(angle) = accumulation(&start, &r, 1.0, loose) else {
                    continue;
                };
                let exact = summed(phase, speed, r);
                assert!((angle - exact).abs() < loose, "{phase} {r} {speed}: {angle} {exact}");
            }
        }
        let (_, start) = start_at(0.3, 1e-6);
        assert!(accumulation(&start, &0.6, 1.0, 1e-12).is_some());
    }

    #[test]
    fn without_loss_near_the_release_and_off_the_wall_a_chatter_does_not_complete() {
        let (_, start) = start_at(0.3, 1e-6);
        assert_eq!(accumulation(&start, &1.0, 1.0, 1e-12), None);
        let release = (-0.1_f64).acos();
        let (_, start) = start_at(release - 1e-7, 1e-9);
        assert_eq!(accumulation(&start, &0.6, 1.0, 1e-12), None);
        let (_, start) = start_at(release + 0.3, 1e-9);
        assert_eq!(accumulation(&start, &0.6, 1.0, 1e-12), None);
    }

    #[test]
    fn a_ball_without_speed_rests_at_once() {
        let (_, start) = start_at(0.3, 0.0);
        assert_eq!(accumulation(&start, &0.6, 1.0, f64::EPSILON), Some(0.0));
    }
}
