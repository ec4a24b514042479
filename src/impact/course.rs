//! The motion step by step: flight and impact, the end of a chatter, rest and release.

use super::chatter;
use super::event::{Event, Kind};
use super::expansion::Expansion;
use super::flight::{Arrival, Flight, Stop};
use super::scaled::{Departure, Scaled};
use super::simulation::{LISTED, Start};
use crate::model::{Motion, Side};
use crate::number::Analytic;
use std::sync::Arc;

/// Where the ball is.
#[derive(Clone, Debug)]
enum Place<T> {
    /// About to make the impact that the motion starts with, at this speed.
    Beginning { side: Side, phase: T, speed: T },
    /// Leaving a wall.
    Leaving(Departure<T>),
    /// At rest on a wall since this phase.
    Resting { side: Side, since: T },
    /// Nothing happens any more.
    Ended,
}

/// A step, with what the growth of errors needs.
#[derive(Clone, Debug)]
pub(super) enum Step<T> {
    /// The impact that the motion starts with.
    Start,
    /// A flight, and the impact that ends it.
    Flight {
        from: Side,
        start: Expansion<T>,
        arrival: Arrival<T>,
        noise: f64,
    },
    /// A chatter is complete, an angle after `start`, known by the closed form to an error.
    Rest { start: Expansion<T>, angle: T, error: f64 },
    /// The ball leaves at a phase that is known by itself.
    Release,
    /// It cannot be told.
    Undecided,
}

/// A motion, every impact of it.
#[derive(Clone, Debug)]
pub(super) struct Course<T> {
    scaled: Arc<Scaled<T>>,
    place: Place<T>,
    turns: i64,
    /// The angles of the latest flights, by the walls they left and met.
    recent: [[f64; 2]; 2],
    /// To which error of the phase a chatter is completed in closed form.
    completing: f64,
}

impl<T: Analytic> Course<T> {
    pub fn new(motion: &Motion<T>, start: &Start<T>) -> Self {
        let scaled = Scaled::new(motion);
        let speed = start.side.signed(start.velocity.clone()) * scaled.pi.clone();
        // the turns of the start, so that times count from it as it is given
        let (phase, turns) = reduced(&scaled, start.phase.clone());
        Self {
            place: Place::Beginning {
                side: start.side,
                phase,
                speed,
            },
            completing: scaled.epsilon,
            scaled: Arc::new(scaled),
            turns,
            recent: [[f64::NAN; 2]; 2],
        }
    }

    /// Completes a chatter as soon as that leaves no more than this error of the phase, not only at rounding.
    pub fn complete_to(&mut self, error: f64) {
        self.completing = error.max(self.scaled.epsilon);
    }

    pub fn scaled(&self) -> &Scaled<T> {
        &self.scaled
    }

    /// Goes on after `event`.
    pub fn resume(&mut self, event: &Event<T>) {
        let (side, phase) = (event.side, event.phase.clone());
        self.turns = event.turns;
        match event.kind {
            Kind::Impact => {
                let speed = side.signed(event.velocity.clone()) * self.scaled.pi.clone();
                self.impact(side, phase, speed);
            }
            Kind::Rest => self.place = Place::Resting { side, since: phase },
            Kind::Release => self.release(side, phase),
            Kind::Undecided => self.place = Place::Ended,
        }
    }

    /// Leaves a wall at a zero of f + g, with velocity 0.
    fn release(&mut self, side: Side, phase: T) {
        let (sin, cos) = phase.sincos();
        self.place = Place::Leaving(Departure {
            side,
            phase,
            sin,
            cos,
            speed: T::zero(),
            released: true,
        });
    }

    /// What happens next; `None` where nothing does any more.
    pub fn advance(&mut self) -> Option<(Event<T>, Step<T>)> {
        match std::mem::replace(&mut self.place, Place::Ended) {
            Place::Beginning { side, phase, speed } => Some((self.impact(side, phase, speed), Step::Start)),
            Place::Leaving(from) => self.leave(&from),
            Place::Resting { side, since } => {
                let phase = self.scaled.release(side)?;
                if (phase.clone() - since).to_f64() < 0.0 {
                    self.turns += 1;
                }
                self.release(side, phase.clone());
                Some((self.event(Kind::Release, side, phase, T::zero()), Step::Release))
            }
            Place::Ended => None,
        }
    }

    /// An impact at a phase with a speed towards the wall, and the departure after it.
    fn impact(&mut self, side: Side, phase: T, speed: T) -> Event<T> {
        let (sin, cos) = phase.sincos();
        self.rebound(side, phase, sin, cos, speed)
    }

    #[inline]
    fn rebound(&mut self, side: Side, phase: T, sin: T, cos: T, speed: T) -> Event<T> {
        let velocity = side.signed(speed.clone() * self.scaled.inverse_pi.clone());
        let event = self.event(Kind::Impact, side, phase.clone(), velocity);
        let speed = self.scaled.restitution(side).clone() * speed;
        self.place = Place::Leaving(Departure {
            side,
            phase,
            sin,
            cos,
            speed,
            released: false,
        });
        event
    }

    fn event(&self, kind: Kind, side: Side, phase: T, velocity: T) -> Event<T> {
        Event {
            kind,
            side,
            turns: self.turns,
            phase,
            velocity,
        }
    }

    /// The flight from a wall, or the rest that a complete chatter on it ends with.
    #[inline]
    fn leave(&mut self, from: &Departure<T>) -> Option<(Event<T>, Step<T>)> {
        let scaled = Arc::clone(&self.scaled);
        let flight = Flight::new(&scaled, from);
        let is_slow = (from.speed.clone() * scaled.inverse_pi.clone()).to_f64() < LISTED;
        if is_slow && flight.start.push.to_f64() > 0.0 {
            let r = scaled.restitution(from.side);
            if let Some(angle) = chatter::accumulation(&flight.start, r, self.completing) {
                return Some(self.rest(from, flight.start, angle));
            }
        }
        match flight.arrival(&self.recent) {
            Ok(arrival) => Some(self.arrive(&flight, arrival)),
            Err(Stop::Unending) => None,
            Err(Stop::Undecided(side)) => {
                let event = self.event(Kind::Undecided, side, from.phase.clone(), T::zero());
                Some((event, Step::Undecided))
            }
        }
    }

    #[inline]
    fn arrive(&mut self, flight: &Flight<T>, arrival: Arrival<T>) -> (Event<T>, Step<T>) {
        let scaled = flight.scaled;
        let from = flight.from.side;
        let side = arrival.side;
        let angle = arrival.angle.to_f64();
        self.recent[from as usize][side as usize] = angle;
        let (phase, turns) = reduced(scaled, flight.from.phase.clone() + arrival.angle.clone());
        self.turns += turns;
        let speed = flight.approach(side, &arrival.there);
        let event = if angle < super::swing::REACH {
            // expanded about the departure: rounding errors of sine and cosine would add up
            self.impact(side, phase, speed)
        } else {
            let [sin, cos] = [&arrival.there.sin, &arrival.there.cos].map(|value| from.signed(value.clone()));
            self.rebound(side, phase, sin, cos, speed)
        };
        let noise = flight.noise(angle);
        (
            event,
            Step::Flight {
                from,
                start: flight.start.clone(),
                arrival,
                noise,
            },
        )
    }

    fn rest(&mut self, from: &Departure<T>, start: Expansion<T>, angle: T) -> (Event<T>, Step<T>) {
        let side = from.side;
        let (phase, turns) = reduced(&self.scaled, from.phase.clone() + angle.clone());
        self.turns += turns;
        self.place = Place::Resting {
            side,
            since: phase.clone(),
        };
        (
            self.event(Kind::Rest, side, phase, T::zero()),
            Step::Rest {
                start,
                angle,
                error: self.completing,
            },
        )
    }
}

/// A phase in [0, 2 pi), and the turns taken off it.
#[inline]
fn reduced<T: Analytic>(scaled: &Scaled<T>, phase: T) -> (T, i64) {
    let mut turns = (phase.to_f64() / std::f64::consts::TAU).floor() as i64;
    let mut phase = if turns == 0 {
        phase
    } else {
        phase - scaled.circle.clone() * T::from_integer(turns)
    };
    // the quotient may have been rounded across a whole number
    if phase.to_f64() < 0.0 {
        phase += scaled.circle.clone();
        turns -= 1;
    } else if (phase.clone() - scaled.circle.clone()).to_f64() >= 0.0 {
        phase -= scaled.circle.clone();
        turns += 1;
    }
    (phase, turns)
}
