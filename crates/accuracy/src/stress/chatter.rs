//! The end of a chatter: infinitely many impacts, one after the other until none can be told apart, or in closed form.

use super::StressError;
use super::row::{Evaluation, Form, StressRow, place};
use crate::trade::digits_of;
use dynamics::impact::{Kind, Simulation, Start};
use dynamics::model::{Forcing, Impact, Motion, Parameters, Side, next_impact};
use numbers::{Analytic, DoubleDouble, Wide};

/// The number that judges, and how well it has to be confirmed by the other means.
type Judge = Wide<50>;
const CONFIRMED: f64 = 20.0;

/// A chatter is completed in closed form where that leaves so much of the phase at most.
const COMPLETING: f64 = 1e-30;

/// g, d, r_T and the phase of the impact at the bottom that the chatter starts with.
const G: f64 = 0.3;
const D: f64 = 0.4;
const R_T: f64 = 0.5;
const PHASE: f64 = 0.1;

/// How long a chatter about lasts, in units of time.
const LASTS: f64 = 0.3;

/// The fastest impact to start with: one that stays below the top.
const FASTEST: f64 = 0.3;

/// Impacts that a motion may have before its rest; of so many more none is expected.
const MOST_IMPACTS: usize = 2_000_000;

/// A relative step for differences over 31 digits.
const STEP: f64 = 1e-10;

/// What a chatter starts from: r_B and the velocity of the first impact.
#[derive(Clone, Copy)]
struct Chatter {
    r: f64,
    velocity: f64,
}

impl Chatter {
    fn new(r: f64) -> Self {
        // 2 r v / (a (1 - r)), a near 1.3
        let velocity = (0.65 * LASTS * (1.0 - r) / r).min(FASTEST);
        Self { r, velocity }
    }

    fn motion<T: Analytic>(&self) -> Option<Motion<T>> {
        Motion::new(G, D, self.r, R_T).ok()?.motion().ok()
    }

    /// The phase at which the ball comes to rest, as the program has it.
    fn by_law<T: Analytic>(&self, moved: [f64; 4], completing: f64) -> Option<T> {
        // the parameters and the start, each moved by a part of itself
        let at = |value: f64, part: f64| T::from_f64(value) * (T::one() + T::from_f64(part));
        let [r, g, phase, velocity] = moved;
        let (d, r_t) = (T::from_f64(D), T::from_f64(R_T));
        let motion = Motion::new(at(G, g), d, at(self.r, r), r_t).ok()?;
        let start = Start::impact(Side::Bottom, at(PHASE, phase), at(self.velocity, velocity));
        let simulation = Simulation::new(&motion, &start).completing_to(completing);
        let mut events = simulation.take(MOST_IMPACTS);
        let rest = events.find(|event| event.kind != Kind::Impact)?;
        (rest.kind == Kind::Rest).then_some(rest.phase)
    }

    /// The same by the map (8) alone, one impact after the other, until the next one is at the same time.
    fn by_impacts<T: Analytic>(&self) -> Option<T> {
        let motion = self.motion()?;
        let forcing = Forcing::harmonic(&T::zero());
        let mut impact = Impact {
            side: Side::Bottom,
            time: T::from_f64(PHASE) / T::pi(),
            velocity: T::from_f64(self.velocity),
        };
        for _ in 0..MOST_IMPACTS {
            match next_impact(&motion, &forcing, &impact) {
                Ok(leg) if leg.to.side == Side::Bottom && leg.to.time != impact.time => impact = leg.to,
                _ => return Some(impact.time * T::pi()),
            }
        }
        None
    }

    /// The relative condition of the phase by the four numbers that it depends on, by differences.
    fn condition(&self) -> f64 {
        let Some(rest) = self.by_law::<DoubleDouble>([0.0; 4], COMPLETING) else {
            return f64::NAN;
        };
        let changes = (0..4).map(|index| {
            let mut moved = [0.0; 4];
            moved[index] = -STEP;
            let other = self.by_law::<DoubleDouble>(moved, COMPLETING);
            other.map_or(f64::NAN, |other| ((other - rest) / rest).to_f64().abs() / STEP)
        });
        changes.sum()
    }

    fn row<T: Analytic>(&self, number: &str, form: Form, exact: &Judge, condition: f64) -> StressRow {
        let found = match form {
            Form::Printed => self.by_impacts::<T>(),
            _ => self.by_law::<T>([0.0; 4], 0.0),
        };
        let error = found.map_or(f64::NAN, |found| apart(&found, exact));
        let evaluation = Evaluation::of::<T>(number, form, error);
        StressRow::new(case(self.r), "rest", evaluation, condition, self.place())
    }

    fn place(&self) -> String {
        let names = ["g", "d", "r_B", "r_T", "phase", "velocity"];
        place(&names, &[G, D, self.r, R_T, PHASE, self.velocity])
    }
}

/// The relative error of a number of up to 31 digits.
fn apart<T: Analytic>(found: &T, exact: &Judge) -> f64 {
    let high = found.to_f64();
    let low = (found.clone() - T::from_f64(high)).to_f64();
    let [high, low] = [high, low].map(<Judge as Analytic>::from_f64);
    ((high + low - exact.clone()) / exact.clone()).to_f64().abs()
}

/// The restitutions looked at: from 0 on, and to 1. What is nearer to 1 takes minutes in the number that judges.
pub(super) const RESTITUTIONS: [f64; 7] = [1e-15, 1e-9, 1e-3, 0.1, 0.9, 0.99, 0.996];

/// The extreme that a restitution is.
pub(super) fn case(r: f64) -> &'static str {
    if r < 0.5 {
        "chatter, r near 0"
    } else {
        "chatter, r near 1"
    }
}

/// The rows of a chatter at the bottom.
///
/// # Errors
/// `Point` where the ball does not come to rest, `Reference` where the two means of the reference disagree.
pub(super) fn rows(r: f64) -> Result<Vec<StressRow>, StressError> {
    let chatter = Chatter::new(r);
    let (case, at) = (case(r), chatter.place());
    let exact = chatter.by_law::<Judge>([0.0; 4], COMPLETING);
    let exact = exact.ok_or_else(|| StressError::Point { case, at: at.clone() })?;
    let other = chatter.by_impacts::<DoubleDouble>();
    let digits = digits_of(other.map_or(f64::NAN, |other| apart(&other, &exact)), 1e-32);
    if digits < CONFIRMED {
        return Err(StressError::Reference { case, at, digits });
    }
    let condition = chatter.condition();
    Ok(vec![
        chatter.row::<f32>("f32", Form::Printed, &exact, condition),
        chatter.row::<f64>("f64", Form::Printed, &exact, condition),
        chatter.row::<f32>("f32", Form::Stable, &exact, condition),
        chatter.row::<f64>("f64", Form::Stable, &exact, condition),
        chatter.row::<DoubleDouble>("double-double", Form::Stable, &exact, condition),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_chatter_is_exact_in_closed_form() {
        for r in [1e-9, 0.1] {
            for row in rows(r).unwrap() {
                assert!(row.digits > row.allowed - 1.0, "{row:#?}");
            }
        }
    }

    #[test]
    fn a_ball_that_keeps_all_its_speed_never_rests() {
        let (r, velocity) = (1.0, 0.01);
        assert_eq!(Chatter { r, velocity }.by_law::<f64>([0.0; 4], 0.0), None);
    }
}
