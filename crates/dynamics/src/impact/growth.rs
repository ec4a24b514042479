//! How rounding errors grow along a motion, to first order.

use super::course::{Step, Witness};
use super::event::Event;
use super::flight::{Arrival, Flight};
use super::scaled::Scaled;
use super::turns::Turn;
use super::waves::Waves;
use crate::model::Side;
use numbers::Analytic;
use std::f64::consts::{FRAC_1_PI, TAU};

/// A step whose error changes the velocity of arrival by more than this part of it is no longer straight.
pub(super) const STRAIGHT: f64 = 0.1;

/// The rounding of a step, in epsilons of the sum of its terms: a third of the bound, which is 4, since roundings cancel.
/// With it the estimate is ten times too high in the median over 120,000 motions.
pub(super) const ROUNDED: f64 = 1.4;

/// What is said to hold, holds for errors so many times those estimated.
pub(super) const SAFELY: f64 = 8.0;

/// What rounding errors have become.
///
/// The error in (phase, pi velocity) lies in a rectangle turned by an angle: each impact maps it by the Jacobian of the
/// one-impact map, and a rectangle turned with the image of its longer side encloses what comes out (R. Lohner, 1987,
/// "QR-decomposition method"): stretching in one direction is not mixed into the others, so that on a motion that
/// attracts the estimate stays small for ever. To each impact its own rounding is added, as errors are that have nothing to
/// do with each other: by squares. First order only: where the
/// flight grazes closer than the error, or the error bends, nothing is claimed any more.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// The turned axes, by columns.
    pub(super) axes: [[f64; 2]; 2],
    /// Half the sides of the rectangle.
    pub(super) sides: [f64; 2],
    /// Errors of phase and pi velocity at the latest event.
    pub(super) error: [f64; 2],
    /// The logarithm of the stretch so far, and since the last release.
    pub(super) stretch: f64,
    pub(super) since_release: f64,
    epsilon: f64,
    /// How much g and the forcing, rounded, move the phase of a release, where f = -g: the more the slower f falls there.
    steep: f64,
    /// Of bottom and top.
    restitution: [f64; 2],
    lost: bool,
}

impl Growth {
    pub(super) fn new<T: Analytic, W: Waves<T>>(scaled: &Scaled<T, W>) -> Self {
        let g = scaled.g.to_f64().abs() + scaled.bounds.rounded;
        let steep = |turn: &Turn<T, W>| g / turn.waves.minus_slope().to_f64().abs();
        Self {
            axes: [[1.0, 0.0], [0.0, 1.0]],
            sides: [0.0; 2],
            error: [0.0; 2],
            stretch: 0.0,
            since_release: 0.0,
            epsilon: scaled.epsilon,
            steep: scaled.turns.iter().map(steep).fold(0.0, f64::max),
            restitution: [Side::Bottom, Side::Top].map(|side| scaled.restitution(side).to_f64()),
            lost: false,
        }
    }

    /// An estimate, to first order, of the error of the phase, rad: hardly ever too low, some times too high.
    pub fn phase_error(&self) -> f64 {
        if self.lost { f64::INFINITY } else { self.error[0] }
    }

    /// An estimate, to first order, of the error of the velocity: over 120,000 random motions it is too low at two impacts
    /// in 1,000, never ten times, and in the median it is ten times too high. The digits claimed all held there.
    pub fn velocity_error(&self) -> f64 {
        if self.lost {
            f64::INFINITY
        } else {
            self.error[1] * FRAC_1_PI
        }
    }

    /// The digits that hold of the latest event, at a velocity, for errors some times those estimated: relative of the
    /// velocity, absolute of the phase; none where nothing is claimed.
    pub fn digits(&self, velocity: f64) -> u32 {
        if self.lost {
            return 0;
        }
        self.kept(velocity)
    }

    fn kept(&self, velocity: f64) -> u32 {
        let [phase, speed] = self.error.map(|error| SAFELY * error);
        digits_of(phase.max(part(speed * FRAC_1_PI, velocity)))
    }

    /// The same of the time since the start as well.
    pub(super) fn digits_at(&self, time: f64, velocity: f64) -> u32 {
        // the start has an error of its own, which is not above that of the phase now where digits are claimed at all
        let time_error = SAFELY * self.phase_error() * FRAC_1_PI;
        self.digits(velocity).min(digits_of(part(time_error, time)))
    }

    /// The logarithm of the factor by which a small error has grown since the start, along the direction that grows
    /// the most; minus infinity once a rest has wiped errors out.
    pub fn stretch(&self) -> f64 {
        self.stretch
    }

    /// The same since the last release, or since the start where there was none.
    pub fn stretch_since_release(&self) -> f64 {
        self.since_release
    }

    /// Begins with a start in flight: each value is rounded once.
    pub(super) fn begin(&mut self, phase: f64, speed: f64) {
        let own = 0.5 * self.epsilon;
        self.restart([own * phase.abs(), own * speed.abs()]);
    }

    fn fly(&mut self, flown: &Flown, clearance: f64) {
        let [phase, speed] = self.error.map(|error| SAFELY * error);
        let [f, f1] = flown.bounds;
        let at_a_dip = flown.angle * flown.restitution * speed + (f * flown.angle + 2.0 * f1) * phase;
        let [[by_phase, by_speed], _] = flown.jacobian;
        let moved = (by_phase - 1.0).abs() * phase + by_speed.abs() * speed;
        let bend = moved * flown.push.abs() / flown.speed;
        if bend.is_nan() || bend >= STRAIGHT || at_a_dip >= clearance {
            self.lose();
        }

        let [[a, b], [c, d]] = flown.jacobian;
        let [[p, q], [r, s]] = self.axes;
        let first = [a * p + b * r, c * p + d * r];
        let second = [a * q + b * s, c * q + d * s];
        let length = first[0].hypot(first[1]);
        // a flight from a release depends on nothing before
        let (cos, sin) = if length > 0.0 {
            (first[0] / length, first[1] / length)
        } else {
            (1.0, 0.0)
        };
        let along = (cos * second[0] + sin * second[1]).abs();
        let across = (cos * second[1] - sin * second[0]).abs();
        let [e, f] = flown.rounding;
        self.sides = [
            together([length * self.sides[0], along * self.sides[1], cos * e, sin * f]),
            together([0.0, across * self.sides[1], sin * e, cos * f]),
        ];
        self.axes = [[cos, -sin], [sin, cos]];
        self.error = [
            (cos * self.sides[0]).hypot(sin * self.sides[1]),
            (sin * self.sides[0]).hypot(cos * self.sides[1]),
        ];
        self.stretch += length.ln();
        self.since_release += length.ln();
    }

    /// Claims nothing any more.
    pub(super) fn lose(&mut self) {
        self.lost = true;
    }

    /// Whether anything is claimed; once it is not, it never is again.
    pub fn holds(&self) -> bool {
        !self.lost
    }

    /// Whether the errors of phase and velocity of the latest event, some times those estimated, stay below `error`.
    pub fn holds_to(&self, error: f64) -> bool {
        !self.lost && self.error.iter().all(|estimate| SAFELY * estimate <= error)
    }

    fn restart(&mut self, sides: [f64; 2]) {
        self.axes = [[1.0, 0.0], [0.0, 1.0]];
        self.sides = sides;
        self.error = sides;
    }
}

impl<T: Analytic> Witness<T> for &mut Growth {
    fn see<W: Waves<T>>(self, event: &Event<T>, step: Step<T, W>) {
        // a value that is rounded once
        let own = 0.5 * self.epsilon;
        match step {
            Step::Start => {
                // phase and velocity, rounded once
                let speed = event.velocity.to_f64().abs() * std::f64::consts::PI;
                self.restart([own * event.phase.to_f64(), own * speed]);
            }
            Step::Release => {
                self.restart([own * (TAU + self.steep), 0.0]);
                // the flight forgets the phase of its release: what may grow is the velocity
                self.axes = [[0.0, 1.0], [1.0, 0.0]];
                self.sides.swap(0, 1);
                self.since_release = 0.0;
                self.stretch = f64::NEG_INFINITY;
            }
            Step::Undecided => self.lose(),
            Step::Rest { start, angle, error } => {
                // the phase of rest alone; what follows does not depend on it
                let (push, angle) = (start.push.to_f64(), angle.to_f64());
                let r = self.restitution[event.side as usize];
                let by_speed = 2.0 * r / (push * (1.0 - r)) * self.error[1];
                let by_push = angle * (start.waves.minus_slope().to_f64().abs() / push).min(1e8) * self.error[0];
                // the push itself has an absolute error
                let rounding = error + own * (TAU + angle / push);
                self.error = [self.error[0] + by_speed + by_push + rounding, 0.0];
            }
            Step::Flight { flight, arrival } => {
                self.fly(&Flown::new(flight, arrival), arrival.clearance);
            }
        }
    }
}

/// Errors that have nothing to do with each other, together; the square of an error in many digits would be 0.
fn together(errors: [f64; 4]) -> f64 {
    errors.into_iter().fold(0.0, f64::hypot)
}

/// An error as a part of a value; one of 0 has none.
fn part(error: f64, value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { error / value.abs() }
}

/// The whole digits before an error. A float saturates as an integer: an error above 1 leaves none.
pub(super) fn digits_of(error: f64) -> u32 {
    if error.is_nan() {
        0
    } else {
        (-error.log10()).floor() as u32
    }
}

/// A flight as the errors see it, in f64.
struct Flown {
    angle: f64,
    restitution: f64,
    /// Of |f| and |F_1|.
    bounds: [f64; 2],
    /// f + g at arrival, and the speed there.
    push: f64,
    speed: f64,
    /// Of (phase, pi speed) at the impacts on both ends; (20), (21) in units without pi.
    jacobian: [[f64; 2]; 2],
    /// The flight's own errors of both.
    rounding: [f64; 2],
}

impl Flown {
    fn new<T: Analytic, W: Waves<T>>(flight: &Flight<T, W>, arrival: &Arrival<T, W>) -> Self {
        let (scaled, start, from) = (flight.scaled, &flight.start, flight.from.side);
        let bounds = &scaled.bounds;
        let noise = ROUNDED / 4.0 * flight.noise(arrival.angle.to_f64());
        let there = &arrival.there;
        let [x, w, push] = [&arrival.angle, &there.w, &there.push].map(Analytic::to_f64);
        let [f, f1] = [there.waves.f(), there.waves.f1()].map(|value| value.to_f64());
        let [launch, push_0] = [&start.w, &start.push].map(Analytic::to_f64);
        let [f_0, f1_0] = [start.waves.f(), start.waves.f1()].map(|value| value.to_f64());
        let r = match flight.from.height {
            None => scaled.restitution(from).to_f64(),
            Some(_) => 1.0,
        };
        // x f(0) + F_1(0) - F_1(x), which cancels where x is small
        let lifted = if x * bounds.highest < 0.1 {
            x * x * (0.5 * start.waves.minus_slope().to_f64() + x / 6.0 * start.waves.minus_curvature().to_f64())
        } else {
            x * f_0 + f1_0 - f1
        };
        let (by_phase, by_speed) = (-lifted / w, -r * x / w);
        let towards = if arrival.side == from { -1.0 } else { 1.0 };
        let speed = w.abs();
        let own = ROUNDED * scaled.epsilon;
        let terms = if x < scaled.reach {
            launch.abs() + push_0.abs() * x + bounds.f * x
        } else {
            launch.abs() + scaled.g.to_f64().abs() * x + 2.0 * bounds.f1
        };
        Self {
            angle: x,
            restitution: r,
            bounds: [bounds.f, bounds.f1],
            push,
            speed,
            jacobian: [
                [1.0 + by_phase, by_speed],
                [towards * (f_0 - f - push * by_phase), towards * (r - push * by_speed)],
            ],
            rounding: [
                noise / speed + own * (x + TAU) * 0.25,
                push.abs() * noise / speed + own * terms,
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::course::Course;
    use super::super::event::Kind;
    use super::super::start::Start;
    use super::super::waves::Cosine;
    use super::*;
    use crate::model::Motion;

    fn motion() -> Motion<f64> {
        Motion::new(0.12, 0.3, 0.5, 0.6).unwrap()
    }

    /// The last impact of a chatter before its rest.
    fn last() -> Event<f64> {
        let start = Start::impact(Side::Bottom, 1.0, 1e-3);
        let mut course = Course::<f64, Cosine<f64>>::new(&motion(), &start);
        let mut events = std::iter::from_fn(|| course.advance(()));
        let events: Vec<Event<f64>> = events.by_ref().take_while(|event| event.kind == Kind::Impact).collect();
        events.last().unwrap().clone()
    }

    /// The phase at which it rests if its last impact is so much faster, and what the error is told to be for an error of
    /// that velocity alone.
    fn rest(faster: f64, error: f64) -> (f64, f64) {
        let mut event = last();
        event.velocity += faster;
        let mut course = Course::<f64, Cosine<f64>>::new(&motion(), &Start::from(&event));
        let mut growth = Growth::new(course.scaled());
        course.advance(&mut growth).unwrap();
        growth.restart([0.0, error * std::f64::consts::PI]);
        let event = course.advance(&mut growth).unwrap();
        assert_eq!(event.kind, Kind::Rest);
        (event.phase, growth.phase_error())
    }

    #[test]
    fn the_phase_of_a_rest_moves_with_the_velocity_of_the_last_impact_by_what_its_error_says() {
        let error = 1e-3 * last().velocity;
        let told = rest(0.0, error).1 - rest(0.0, 0.0).1;
        let moved = (rest(error, 0.0).0 - rest(0.0, 0.0).0).abs();
        assert!(
            moved > 0.5 * error && (told / moved - 1.0).abs() < 0.01,
            "{told:e} {moved:e}"
        );
    }
}
