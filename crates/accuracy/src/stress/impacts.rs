//! The impact that a motion comes to after so many: by phase, as the program simulates, and by the map (8) with the time
//! as it is, as the paper's t_k.

use super::StressError;
use super::motion::errors;
use super::quantity::{Exact, JUDGED, REFERENCE_DIGITS, largest, widen};
use super::row::{Evaluation, Form, StressRow, place};
use crate::trade::digits_of;
use dynamics::impact::{Event, Kind, Simulation, Start};
use dynamics::model::{Bracket, Flight, Forcing, Impact, Motion, Sample, Side, Watch, root};
use dynamics::orbit::OrbitImpact;
use numbers::{Analytic, Any, Dual, of_type, seeded};

/// g, d, r_B, r_T, and phase and velocity of the start impact at the bottom.
const INPUTS: [&str; 6] = ["g", "d", "r_B", "r_T", "phase", "velocity"];

/// The formula, by its number.
pub(super) const FORMULA: &str = "(8)";

/// Walls and forcing of a motion, and how it starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Setup {
    /// The paper's: two walls, one cosine, an impact at the bottom.
    Paper,
    /// Under these cosines and sines of the orders 1, 2, ...
    Harmonics(&'static [[f64; 2]]),
    /// The bottom alone; d and r_T are not read.
    OneWall,
    /// In flight at this Z, with the velocity Zdot.
    InFlight(f64),
}

/// An impact of a motion.
pub(super) struct SimulatedImpact {
    /// g, d, r_B, r_T, and phase and velocity of the start.
    pub inputs: [f64; 6],
    /// The walls, the forcing and the kind of start.
    pub setup: Setup,
    /// The impacts after the start.
    pub impacts: u32,
}

/// What is known of an impact.
pub(super) struct KnownImpact {
    pub fix: OrbitImpact<Exact>,
    pub condition: f64,
}

fn motion<T: Analytic>([g, d, r_b, r_t, phase, velocity]: &[T; 6], setup: Setup) -> Option<(Motion<T>, Start<T>)> {
    let motion = match setup {
        Setup::OneWall => Motion::one_wall(g.clone(), r_b.clone()),
        _ => Motion::new(g.clone(), d.clone(), r_b.clone(), r_t.clone()),
    };
    let mut motion = motion.ok()?;
    if let Setup::Harmonics(amplitudes) = setup {
        let part = |index: usize| {
            amplitudes
                .iter()
                .map(|pair| T::from_f64(pair[index]))
                .collect::<Vec<_>>()
        };
        let forcing = Forcing::periodic(T::from_integer(2), &part(0), &part(1)).ok()?;
        motion = motion.with_forcing(forcing).ok()?;
    }
    let (phase, velocity) = (phase.clone(), velocity.clone());
    let start = match setup {
        Setup::InFlight(position) => Start::in_flight(phase, T::from_f64(position), velocity),
        _ => Start::impact(Side::Bottom, phase, velocity),
    };
    Some((motion, start))
}

/// The impact, or what happens instead.
fn simulated<T: Analytic>(inputs: &[T; 6], setup: Setup, impacts: u32) -> Option<Event<T>> {
    let (motion, start) = motion(inputs, setup)?;
    // a start in flight is no event
    let last = impacts as usize - usize::from(start.position.is_some());
    let events = Simulation::new(&motion, &start).take(last + 1);
    let (index, event) = events.enumerate().last()?;
    (index == last || event.kind != Kind::Impact).then_some(event)
}

/// The same, for less where the motion comes to go round in this number: whole rounds are left out (Brent 1980). Of a
/// dual number the derivatives would not be compared.
fn simulated_by_rounds<T: Analytic>(inputs: &[T; 6], setup: Setup, impacts: u32) -> Option<Event<T>> {
    let (motion, start) = motion(inputs, setup)?;
    let mut events = Simulation::new(&motion, &start);
    let mut event = events.next()?;
    let (mut before, mut since, mut window) = (events.clone(), 0, 1);
    let mut left = impacts;
    while left > 0 {
        let Some(next) = events.next() else {
            return (event.kind != Kind::Impact).then_some(event);
        };
        event = next;
        left -= 1;
        since += 1;
        if events.goes_on_like(&before) {
            left %= since;
        }
        if since == window {
            (before, since, window) = (events.clone(), 0, 2 * window);
        }
    }
    Some(event)
}

/// The impact that ends a flight from between the walls, by (4): the wall is looked for by steps of a thousandth.
fn landed<T: Analytic>(motion: &Motion<T>, time: &T, position: &T, velocity: &T) -> Option<Impact<T>> {
    let forcing = motion.forcing();
    let flight = Flight::launched(motion, &forcing, Side::Bottom, time, velocity.clone()).ok()?;
    let half = motion.d().clone() * T::from_ratio(1, 2);
    let beyond = |side: Side, s: &T| {
        let z = position.clone() + flight.state(s).displacement;
        side.signed(z) - half.clone()
    };
    let step = T::from_ratio(1, 1000);
    let mut low = T::zero();
    for _ in 0..100_000 {
        let high = low.clone() + step.clone();
        let met = [Side::Bottom, Side::Top].into_iter();
        let met = met.filter(|side| motion.has_top() || *side == Side::Bottom);
        let mut met = met.filter(|side| beyond(*side, &high).to_f64() > 0.0);
        let Some(side) = met.next() else {
            low = high;
            continue;
        };
        let values = [&low, &high].map(|end| beyond(side, end).to_f64());
        let (low, high) = (&low, &high);
        let duration = root(&Bracket { low, high, values }, |s| Sample {
            value: beyond(side, s),
            slope: side.signed(flight.state(s).velocity),
            size: 1.0,
        });
        return Some(Impact {
            side,
            velocity: flight.state(&duration).velocity,
            time: time.clone() + duration,
        });
    }
    None
}

/// An impact, without the flight after it.
pub(super) fn fix(phase: Exact, velocity: Exact) -> OrbitImpact<Exact> {
    let time = Exact::from(0.0);
    OrbitImpact { phase, velocity, time }
}

/// Of the phase in radians, of the velocity relatively; NaN where there is no answer.
pub(super) fn error(found: Option<OrbitImpact<Exact>>, exact: &OrbitImpact<Exact>) -> f64 {
    found.map_or(f64::NAN, |found| {
        let exact = fix(exact.phase.clone(), exact.velocity.clone());
        largest(errors(&[found], &[exact]))
    })
}

impl SimulatedImpact {
    /// All of it, as the column `at` has it.
    pub fn at(&self) -> String {
        let more = match self.setup {
            Setup::Paper => String::new(),
            Setup::Harmonics(amplitudes) => format!(";harmonics={}", amplitudes.len()),
            Setup::OneWall => ";walls=bottom".to_owned(),
            Setup::InFlight(position) => format!(";z={position:?}"),
        };
        format!("{}{more};impacts={}", place(&INPUTS, &self.inputs), self.impacts)
    }

    /// As the program simulates; `None` where something else happens.
    pub fn by_phase<T: Analytic>(&self) -> Option<OrbitImpact<Exact>> {
        let found = simulated(&self.inputs.map(T::from_f64), self.setup, self.impacts)?;
        (found.kind == Kind::Impact).then(|| fix(widen(&found.phase), widen(&found.velocity)))
    }

    /// The same, for many impacts.
    pub fn by_rounds<T: Analytic>(&self) -> Option<OrbitImpact<Exact>> {
        let found = simulated_by_rounds(&self.inputs.map(T::from_f64), self.setup, self.impacts)?;
        (found.kind == Kind::Impact).then(|| fix(widen(&found.phase), widen(&found.velocity)))
    }

    /// Whether the program says that this number cannot tell what happens.
    fn is_undecided<T: Analytic>(&self) -> bool {
        let found = simulated(&self.inputs.map(T::from_f64), self.setup, self.impacts);
        found.is_some_and(|event| event.kind == Kind::Undecided)
    }

    /// By the map (8).
    pub fn by_time<T: Analytic>(&self) -> Option<OrbitImpact<Exact>> {
        let (motion, start) = motion(&self.inputs.map(T::from_f64), self.setup)?;
        let forcing = motion.forcing();
        let time = start.phase / T::pi();
        let (mut impact, left) = match start.position {
            None => {
                let (side, velocity) = (Side::Bottom, start.velocity);
                (Impact { side, time, velocity }, self.impacts)
            }
            Some(position) => (landed(&motion, &time, &position, &start.velocity)?, self.impacts - 1),
        };
        for _ in 0..left {
            let flight = Flight::after(&motion, &forcing, &impact).ok()?;
            let crossing = flight.crossing(Watch::Both).ok()?;
            let velocity = flight.state(&crossing.duration).velocity;
            impact = Impact {
                side: crossing.side,
                time: impact.time + crossing.duration,
                velocity,
            };
        }
        Some(fix(widen(&impact.time) * Exact::pi(), widen(&impact.velocity)))
    }

    /// The impact in the number that judges, confirmed by the map (8) in it.
    ///
    /// # Errors
    /// `Point` where the motion ends before; `Reference` where the two disagree.
    pub fn known(&self, case: &'static str) -> Result<KnownImpact, StressError> {
        let fault = || StressError::Point { case, at: self.at() };
        let fix = self.by_phase::<Exact>().ok_or_else(fault)?;
        let digits = digits_of(error(self.by_time::<Exact>(), &fix), 1e-100);
        if digits < REFERENCE_DIGITS {
            let at = self.at();
            return Err(StressError::Reference { case, at, digits });
        }
        let condition = self.condition(&fix).ok_or_else(fault)?;
        Ok(KnownImpact { fix, condition })
    }

    /// The most that phase, in radians, and velocity, relatively, change for relative changes of all inputs.
    fn condition(&self, exact: &OrbitImpact<Exact>) -> Option<f64> {
        let inputs = self.inputs.map(<Exact as Analytic>::from_f64);
        let mut changes = [0.0; 2];
        for (index, input) in inputs.iter().enumerate() {
            let mut lifted = inputs.each_ref().map(|input| Dual::from_re(input.clone()));
            lifted[index] = seeded(input.clone());
            let found = simulated(&lifted, self.setup, self.impacts)?;
            let [phase, velocity] = [found.phase, found.velocity].map(|value| value.eps * input.clone());
            for (change, slope) in changes.iter_mut().zip([phase, velocity / exact.velocity.clone()]) {
                *change += slope.to_f64().abs();
            }
        }
        Some(largest(changes))
    }

    /// The rows of both forms in every number that is judged.
    ///
    /// # Errors
    /// Those of [`SimulatedImpact::known`].
    pub fn rows(&self, case: &'static str) -> Result<Vec<StressRow>, StressError> {
        let known = self.known(case)?;
        let row = |form: Form, rung| {
            of_type(rung, || {
                let found = match form {
                    Form::Printed => self.by_time::<Any>(),
                    _ if self.is_undecided::<Any>() => {
                        let answer = Kind::Undecided.name().to_owned();
                        return StressRow::refused(case, FORMULA, rung, self.at(), answer);
                    }
                    _ => self.by_phase::<Any>(),
                };
                let evaluation = Evaluation::of::<Any>(rung, form, error(found, &known.fix));
                StressRow::new(case, FORMULA, evaluation, known.condition, self.at())
            })
        };
        let forms = [Form::Printed, Form::Stable].into_iter();
        Ok(forms.flat_map(|form| JUDGED.map(|rung| row(form, rung))).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_harmless_motion_has_all_digits_by_phase_and_by_time() {
        let inputs = [0.12201, 0.4, 0.5, 0.5, 1.6, 0.9];
        let found = SimulatedImpact {
            inputs,
            setup: Setup::Paper,
            impacts: 4,
        }
        .rows("harmless")
        .unwrap();
        assert_eq!(found.len(), 8);
        for row in &found {
            assert!(row.digits > row.allowed - 1.5, "{row:#?}");
        }
    }

    #[test]
    fn a_wall_that_a_number_cannot_tell_to_be_touched_is_refused_and_no_wrong_answer() {
        let inputs = [0.12201, 0.018_960_349_941_308_473, 0.6, 0.6, 0.5, 0.3];
        let rows = SimulatedImpact {
            inputs,
            setup: Setup::Paper,
            impacts: 2,
        }
        .rows("grazing")
        .unwrap();
        let form = |number: &str| {
            let own = rows
                .iter()
                .filter(|row| row.number == number && row.form != Form::Printed);
            own.map(|row| row.form).collect::<Vec<_>>()
        };
        assert_eq!(form("f64"), [Form::Refused]);
        assert_eq!(form("double-double"), [Form::Stable]);
        assert!(!rows.iter().any(StressRow::is_below_bar));
    }

    #[test]
    fn a_motion_that_rests_before_is_an_error() {
        // gravity holds the ball at the bottom for ever
        let inputs = [2.0, 0.4, 0.5, 0.5, 0.1, 0.1];
        let found = SimulatedImpact {
            inputs,
            setup: Setup::Paper,
            impacts: 100,
        }
        .known("rests");
        assert!(matches!(found, Err(StressError::Point { .. })));
    }
}
