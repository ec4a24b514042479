//! The motion step by step: flight and impact, the end of a chatter, rest and release.

use super::chatter::{self, LISTED};
use super::event::{Event, Kind};
use super::expansion::Expansion;
use super::flight::{Arrival, Flight, Stop};
use super::scaled::{Departure, Scaled};
use super::start::Start;
use super::turns::Turn;
use super::waves::Waves;
use crate::model::{Motion, Side};
use numbers::Analytic;
use std::sync::Arc;

/// Where the ball is.
#[derive(Clone, Debug)]
enum Place<T, W> {
    /// About to make the impact that the motion starts with.
    Beginning { side: Side, phase: T, velocity: T },
    /// Leaving a wall, or starting in flight.
    Leaving(Departure<T, W>),
    /// At rest on a wall since this phase.
    Resting { side: Side, since: T },
    /// On a flight of which it cannot be told where it ends.
    Lost(Departure<T, W>),
    /// At a place where no motion can start.
    Outside { phase: T, velocity: T },
    /// Nothing happens any more.
    Ended,
}

/// A step, with what the growth of errors needs.
#[derive(Debug)]
pub(super) enum Step<'a, T: Analytic, W: Waves<T>> {
    /// The impact that the motion starts with.
    Start,
    /// A flight, and the impact that ends it.
    Flight {
        flight: &'a Flight<'a, T, W>,
        arrival: &'a Arrival<T, W>,
    },
    /// A chatter is complete, an angle after `start`, known by the closed form to an error.
    Rest {
        start: &'a Expansion<T, W>,
        angle: &'a T,
        error: f64,
    },
    /// The ball leaves at a phase that is known by itself.
    Release,
    /// It cannot be told.
    Undecided,
}

/// An observer that is shown each event, with the step that led there.
pub(super) trait Witness<T: Analytic> {
    fn see<W: Waves<T>>(self, event: &Event<T>, step: Step<T, W>);
}

/// Sees nothing.
impl<T: Analytic> Witness<T> for () {
    #[inline(always)]
    fn see<W: Waves<T>>(self, _: &Event<T>, _: Step<T, W>) {}
}

/// A motion, every impact of it.
#[derive(Clone, Debug)]
pub(super) struct Course<T: Analytic, W: Waves<T>> {
    scaled: Arc<Scaled<T, W>>,
    ball: Ball<T, W>,
}

impl<T: Analytic, W: Waves<T>> Course<T, W> {
    pub fn new(motion: &Motion<T>, start: &Start<T>) -> Self {
        let scaled = Scaled::new(motion);
        // the turns of the start, so that times count from it as it is given
        let (phase, turns) = reduced(&scaled, start.phase.clone());
        let velocity = start.velocity.clone();
        let place = match &start.position {
            None => Place::Beginning {
                side: start.side,
                phase,
                velocity,
            },
            Some(position) => in_flight(&scaled, motion, (phase, turns), position, velocity),
        };
        let ball = Ball {
            place,
            turns,
            latest: [[f64::NAN; 2]; 2],
            recent: [[f64::NAN; 2]; 2],
            completing: scaled.epsilon,
        };
        Self {
            scaled: Arc::new(scaled),
            ball,
        }
    }

    /// The motion of a ball that `side` is about to release, at turn 0, at the phase of release nearest to `near`; `None`
    /// where nothing ever releases it.
    pub fn released(motion: &Motion<T>, side: Side, near: f64) -> Option<Self> {
        let scaled = Scaled::<T, W>::new(motion);
        let apart = |turn: &&Turn<T, W>| (turn.phase.to_f64() - near).abs();
        let nearest = scaled
            .releases(side)
            .min_by(|one, other| apart(one).total_cmp(&apart(other)));
        let since = nearest?.phase.clone();
        let mut course = Self::new(motion, &Start::impact(side, since.clone(), T::zero()));
        course.ball.place = Place::Resting { side, since };
        Some(course)
    }

    /// Completes a chatter as soon as that leaves no more than this error of the phase, not only at rounding.
    pub fn complete_to(&mut self, error: f64) {
        self.ball.completing = error.max(self.scaled.epsilon);
    }

    pub fn scaled(&self) -> &Scaled<T, W> {
        &self.scaled
    }

    /// Phase and speed of a ball that starts in flight, as long as nothing has happened.
    pub fn start_in_flight(&self) -> Option<[f64; 2]> {
        match &self.ball.place {
            Place::Leaving(from) if from.height.is_some() => Some([from.phase.to_f64(), from.speed.to_f64()]),
            _ => None,
        }
    }

    /// Goes on after `event`.
    pub fn resume(&mut self, event: &Event<T>) {
        self.ball.resume(&self.scaled, event);
    }

    /// The departure after the latest event, if that was an impact.
    pub fn departure(&self) -> Option<&Departure<T, W>> {
        match &self.ball.place {
            Place::Leaving(from) if !from.released && from.height.is_none() => Some(from),
            _ => None,
        }
    }

    /// Whether both have just left a wall and all that decides what follows is the same, but for whole turns.
    pub fn goes_on_like(&self, other: &Self) -> bool {
        let bits = |ball: &Ball<T, W>| [ball.latest, ball.recent].map(|angles| angles.map(|met| met.map(f64::to_bits)));
        self.departure().is_some()
            && self.departure() == other.departure()
            && bits(&self.ball) == bits(&other.ball)
            && self.ball.completing == other.ball.completing
    }

    /// The departure, in a wider number, of a flight whose end this number cannot tell; `None` while it can be.
    pub fn widened<U: Analytic, V: Waves<U>>(
        &self,
        motion: &Motion<U>,
        convert: impl Fn(&T) -> U,
    ) -> Option<Course<U, V>> {
        let Place::Lost(from) = &self.ball.place else {
            return None;
        };
        let start = Start::impact(from.side, convert(&from.phase), U::zero());
        let mut wider = Course::<U, V>::new(motion, &start);
        let departure = from.convert(&wider.scaled.drive, convert);
        wider.depart(departure, self.ball.turns);
        Some(wider)
    }

    /// Goes on from a departure, so many turns after the start.
    pub fn depart(&mut self, from: Departure<T, W>, turns: i64) {
        self.ball.place = Place::Leaving(from);
        self.ball.turns = turns;
    }

    /// What happens next, shown to a witness with the step that led there; `None` where nothing does any more.
    #[inline]
    pub fn advance(&mut self, witness: impl Witness<T>) -> Option<Event<T>> {
        self.ball.advance(&self.scaled, witness)
    }
}

/// The ball on its way.
#[derive(Clone, Debug)]
struct Ball<T, W> {
    place: Place<T, W>,
    turns: i64,
    /// The angles of the latest flights, by the walls they left and met.
    latest: [[f64; 2]; 2],
    /// The same where they hardly changed from one such flight to the next, else NaN.
    recent: [[f64; 2]; 2],
    /// To which error of the phase a chatter is completed in closed form.
    completing: f64,
}

impl<T: Analytic, W: Waves<T>> Ball<T, W> {
    fn resume(&mut self, scaled: &Scaled<T, W>, event: &Event<T>) {
        let (side, phase) = (event.side, event.phase.clone());
        self.turns = event.turns;
        match event.kind {
            Kind::Impact => {
                let speed = side.signed(event.velocity.clone()) * scaled.pi.clone();
                let (_, next) = self.impact(scaled, side, phase, speed);
                self.place = Place::Leaving(next);
            }
            Kind::Rest => self.place = Place::Resting { side, since: phase },
            Kind::Release => self.release(scaled, side, phase),
            Kind::Undecided => self.place = Place::Ended,
        }
    }

    /// Leaves a wall at a zero of f + g, with velocity 0.
    fn release(&mut self, scaled: &Scaled<T, W>, side: Side, phase: T) {
        self.place = Place::Leaving(Departure {
            side,
            waves: W::at(&scaled.drive, &phase),
            phase,
            speed: T::zero(),
            height: None,
            released: true,
        });
    }

    #[inline]
    fn advance(&mut self, scaled: &Scaled<T, W>, witness: impl Witness<T>) -> Option<Event<T>> {
        match &self.place {
            Place::Leaving(from) => {
                let flight = Flight::new(scaled, from);
                if let Some(angle) = self.completion(&flight) {
                    let (phase, turns) = if angle.is_zero() {
                        (from.phase.clone(), 0)
                    } else {
                        reduced(scaled, from.phase.clone() + angle.clone())
                    };
                    let event = self.event(Kind::Rest, from.side, phase, T::zero()).later(turns);
                    let (start, error) = (&flight.start, self.completing);
                    let angle = &angle;
                    witness.see(&event, Step::Rest { start, angle, error });
                    return Some(self.rest(event));
                }
                match flight.arrival(&self.recent) {
                    Ok(arrival) => {
                        let (event, next) = self.arrive(&flight, &arrival);
                        let (walls, angle) = ((from.side, arrival.side), arrival.angle.to_f64());
                        let (flight, arrival) = (&flight, &arrival);
                        witness.see(&event, Step::Flight { flight, arrival });
                        self.remember(walls, angle);
                        self.turns = event.turns;
                        self.place = Place::Leaving(next);
                        Some(event)
                    }
                    Err(Stop::Unending) => {
                        self.place = Place::Ended;
                        None
                    }
                    Err(Stop::Undecided { wall, angle }) => {
                        let (phase, turns) = reduced(scaled, from.phase.clone() + T::from_f64(angle));
                        let event = self.event(Kind::Undecided, wall, phase, T::zero()).later(turns);
                        witness.see(&event, Step::<T, W>::Undecided);
                        self.place = Place::Lost(from.clone());
                        Some(event)
                    }
                }
            }
            Place::Beginning { side, phase, velocity } => {
                let speed = side.signed(velocity.clone()) * scaled.pi.clone();
                if !may_start(self.turns, phase.to_f64(), speed.to_f64()) {
                    self.turns = 0;
                    let event = self.event(Kind::Undecided, *side, phase.clone(), velocity.clone());
                    witness.see(&event, Step::<T, W>::Undecided);
                    self.place = Place::Ended;
                    return Some(event);
                }
                let (mut event, next) = self.impact(scaled, *side, phase.clone(), speed);
                // as it was given, not there and back through pi
                event.velocity = velocity.clone();
                witness.see(&event, Step::<T, W>::Start);
                self.place = Place::Leaving(next);
                Some(event)
            }
            Place::Resting { side, since } => {
                let side = *side;
                let (phase, turns) = scaled.release(side, since)?;
                self.turns += turns;
                let event = self.event(Kind::Release, side, phase, T::zero());
                witness.see(&event, Step::<T, W>::Release);
                self.release(scaled, side, event.phase.clone());
                Some(event)
            }
            Place::Outside { phase, velocity } => {
                self.turns = 0;
                let event = self.event(Kind::Undecided, Side::Bottom, phase.clone(), velocity.clone());
                witness.see(&event, Step::<T, W>::Undecided);
                self.place = Place::Ended;
                Some(event)
            }
            Place::Lost(_) | Place::Ended => None,
        }
    }

    /// A motion that has settled repeats its flights: the next angle is known then but for rounding.
    #[inline]
    fn remember(&mut self, (from, to): (Side, Side), angle: f64) {
        let latest = &mut self.latest[from as usize][to as usize];
        let is_settled = (angle - *latest).abs() < SETTLED;
        *latest = angle;
        self.recent[from as usize][to as usize] = if is_settled { angle } else { f64::NAN };
    }

    /// The angle after which the chatter that `flight` is part of is complete, where that is known.
    #[inline]
    fn completion(&self, flight: &Flight<T, W>) -> Option<T> {
        let speed = flight.start.w.to_f64() * std::f64::consts::FRAC_1_PI;
        if speed >= LISTED || flight.from.height.is_some() {
            return None;
        }
        let r = flight.scaled.restitution(flight.from.side);
        if flight.starts_at_rest() {
            return Some(T::zero());
        }
        chatter::accumulation(&flight.start, r, flight.scaled.bounds.bend, self.completing)
    }

    fn rest(&mut self, event: Event<T>) -> Event<T> {
        self.turns = event.turns;
        self.place = Place::Resting {
            side: event.side,
            since: event.phase.clone(),
        };
        event
    }

    /// An impact at a phase with a speed towards the wall, and the departure after it.
    fn impact(&self, scaled: &Scaled<T, W>, side: Side, phase: T, speed: T) -> (Event<T>, Departure<T, W>) {
        let waves = W::at(&scaled.drive, &phase);
        self.rebound(scaled, side, phase, waves, speed)
    }

    #[inline]
    fn rebound(&self, scaled: &Scaled<T, W>, side: Side, phase: T, waves: W, speed: T) -> (Event<T>, Departure<T, W>) {
        let velocity = side.signed(speed.clone() * scaled.inverse_pi.clone());
        let event = self.event(Kind::Impact, side, phase.clone(), velocity);
        let speed = scaled.restitution(side).clone() * speed;
        let next = Departure {
            side,
            phase,
            waves,
            speed,
            height: None,
            released: false,
        };
        (event, next)
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

    #[inline]
    fn arrive(&self, flight: &Flight<T, W>, arrival: &Arrival<T, W>) -> (Event<T>, Departure<T, W>) {
        let scaled = flight.scaled;
        let from = flight.from.side;
        let side = arrival.side;
        let (phase, turns) = reduced(scaled, flight.from.phase.clone() + arrival.angle.clone());
        let speed = flight.approach(side, &arrival.there);
        let (event, next) = if arrival.angle.to_f64() < scaled.reach {
            // expanded about the departure: rounding errors of sine and cosine would add up
            self.impact(scaled, side, phase, speed)
        } else {
            let waves = arrival.there.waves.clone().seen(from);
            self.rebound(scaled, side, phase, waves, speed)
        };
        (event.later(turns), next)
    }
}

/// Where a ball starts in flight at a reduced phase; at a wall that it does not leave, with the impact there.
fn in_flight<T: Analytic, W: Waves<T>>(
    scaled: &Scaled<T, W>,
    motion: &Motion<T>,
    (phase, turns): (T, i64),
    position: &T,
    velocity: T,
) -> Place<T, W> {
    let wall = motion.d().clone() * T::from_ratio(1, 2);
    let distances = [wall.clone() - position.clone(), position.clone() + wall].map(|distance| distance.to_f64());
    // how far the number, rounded, may lie from what it stands for
    let rounded = 4.0 * scaled.epsilon * (motion.d().to_f64() + position.to_f64().abs());
    let is_off = |distance: f64| distance == 0.0 || distance > rounded;
    let is_inside = is_off(distances[0]) && (is_off(distances[1]) || !scaled.has_top);
    let speed = velocity.to_f64();
    if !(is_inside && distances[0].is_finite() && may_start(turns, phase.to_f64(), speed.abs())) {
        return Place::Outside { phase, velocity };
    }
    for side in [Side::Bottom, Side::Top] {
        if scaled.has(side) && distances[side as usize] == 0.0 && side.sign() * speed >= 0.0 {
            return Place::Beginning { side, phase, velocity };
        }
    }
    let wall = motion.d().clone() * T::from_ratio(1, 2);
    Place::Leaving(Departure {
        side: Side::Bottom,
        waves: W::at(&scaled.drive, &phase),
        phase,
        speed: -(velocity * scaled.pi.clone()),
        height: Some((wall - position.clone()) * scaled.pi.clone() * scaled.pi.clone()),
        released: false,
    })
}

/// Whether a motion can start with an impact at this reduced phase, with this speed towards the wall: not with NaN, an
/// infinity, a phase so large that its turns take all digits, or a velocity that points away.
fn may_start(turns: i64, phase: f64, speed: f64) -> bool {
    let is_reduced = (0.0..=std::f64::consts::TAU).contains(&phase) && turns.unsigned_abs() < 1 << 53;
    is_reduced && speed.is_finite() && speed >= 0.0
}

/// Flights between the same walls whose angles differ by less propose each other: closer than the cubic of a stretch
/// comes to the contact.
const SETTLED: f64 = 0.03;

/// 1 / (2 pi).
const TURN: f64 = 0.5 * std::f64::consts::FRAC_1_PI;

/// A phase in [0, 2 pi), and the turns taken off it.
#[inline]
fn reduced<T: Analytic, W: Waves<T>>(scaled: &Scaled<T, W>, phase: T) -> (T, i64) {
    let mut turns = (phase.to_f64() * TURN).floor() as i64;
    let mut phase = if turns == 0 {
        phase
    } else {
        phase - scaled.circle.clone() * T::from_integer(turns)
    };
    // the quotient may have been rounded across a whole number
    if phase.to_f64() < 0.0 {
        phase += scaled.circle.clone();
        turns = turns.saturating_sub(1);
    } else if (phase.clone() - scaled.circle.clone()).to_f64() >= 0.0 {
        phase -= scaled.circle.clone();
        turns = turns.saturating_add(1);
    }
    (phase, turns)
}
