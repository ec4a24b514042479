//! The events of a motion, each enclosed: what is given holds, rounding included.

mod flight;
mod set;

use self::flight::{Contact, Flight, Launch};
use self::set::Set;
use super::chatter::LISTED;
use super::event::{Event, Kind};
use super::start::Start;
use super::turns::{around, enclosed};
use super::waves::{Cosine, Several, Waves};
use crate::model::{Motion, Side};
use numbers::{Analytic, Endpoint, Field, Interval, Rung};
use stop;

/// A chatter of more impacts below [`LISTED`] than this is listed, not completed.
const MOST_HIDDEN: usize = 1_000_000;

/// Where the ball is.
#[derive(Clone, Debug)]
enum Place<E: Endpoint> {
    /// About to make the impact that the motion starts with.
    Beginning(Start<Interval<E>>),
    /// Leaving a wall with one of these phases and speeds, or starting in flight at a distance from it; `released` where
    /// f + g is just taking it off.
    Leaving {
        side: Side,
        set: Set<E>,
        height: Option<Interval<E>>,
        released: bool,
    },
    /// At rest on a wall since this phase.
    Resting { side: Side, since: Interval<E> },
    /// Nothing happens any more, or nothing is known.
    Ended,
}

/// The events of [`Simulation`](super::Simulation), proved: phase and velocity of each are in the intervals given, and no
/// event is missed or invented, for as long as intervals over `E` tell. What they cannot tell is an event of the kind
/// [`Kind::Undecided`], the last: up to its phase nothing happens.
///
/// The exact start and parameters are any in the intervals given. Source: R. Lohner, 1987, for how sets are carried from
/// impact to impact; the first contact and the end of a chatter are proved in flight.rs.
#[derive(Clone, Debug)]
pub struct Enclosure<E: Endpoint> {
    motion: Motion<Interval<E>>,
    /// The same in f64, of a wider number: what is met, and when about, is told in that already.
    narrow: Option<Motion<Interval<f64>>>,
    place: Place<E>,
    turns: i64,
    /// A chatter is completed where that leaves no more than this of the phase open, or no more than is open already.
    completing: E,
    has_started: bool,
    /// Whether a chatter that does not complete is being listed whole.
    exhaustive: bool,
    /// The events since the last impact that was listed.
    idle: u32,
}

impl<E: Endpoint> Enclosure<E> {
    /// The motion from `start` on.
    pub fn new(motion: &Motion<Interval<E>>, start: &Start<Interval<E>>) -> Self {
        Self {
            motion: motion.clone(),
            narrow: match E::rung() {
                Rung::Single | Rung::Double => None,
                _ => motion.convert(around).ok(),
            },
            place: Place::Beginning(start.clone()),
            turns: 0,
            completing: <E as Analytic>::epsilon(),
            has_started: start.position.is_some(),
            exhaustive: false,
            idle: 0,
        }
    }

    /// The same, completing a chatter as soon as that leaves no more than this of the phase open: of many digits that
    /// spares hundreds of impacts.
    pub fn completing_to(mut self, error: f64) -> Self {
        let error = E::from_f64(error);
        if error > self.completing {
            self.completing = error;
        }
        self
    }

    /// Whether the ball has been rested and released twice over without an impact that is listed: this goes on for ever.
    pub fn is_idle(&self) -> bool {
        self.idle > 4
    }

    fn restitution(&self, side: Side) -> &Interval<E> {
        self.motion.restitution(side)
    }

    fn event(&self, kind: Kind, side: Side, phase: Interval<E>, velocity: Interval<E>) -> Event<Interval<E>> {
        Event {
            kind,
            side,
            turns: self.turns,
            phase,
            velocity,
        }
    }

    /// The last event: nothing is known beyond a phase.
    fn undecided(&mut self, side: Side, phase: Interval<E>) -> Event<Interval<E>> {
        self.place = Place::Ended;
        self.event(Kind::Undecided, side, phase, Interval::whole())
    }

    fn advance(&mut self) -> Option<Event<Interval<E>>> {
        match std::mem::replace(&mut self.place, Place::Ended) {
            Place::Beginning(Start {
                phase,
                velocity,
                position: Some(position),
                ..
            }) => Some(self.begin_in_flight(phase, &position, velocity)),
            Place::Beginning(start) => Some(self.begin(start)),
            Place::Leaving {
                side,
                set,
                height,
                released,
            } => Some(self.depart(side, &set, height, released)),
            Place::Resting { side, since } => self.release(side, &since),
            Place::Ended => None,
        }
    }

    /// The impact that ends a flight from between the walls; the start is no event.
    fn begin_in_flight(
        &mut self,
        phase: Interval<E>,
        position: &Interval<E>,
        velocity: Interval<E>,
    ) -> Event<Interval<E>> {
        let wall = self.motion.d().clone() * Interval::from_ratio(1, 2);
        let distances = [wall.clone() - position.clone(), position.clone() + wall];
        let is_inside = distances[0].low() > E::zero() && (distances[1].low() > E::zero() || !self.motion.has_top());
        let [reduced, _] = self.reduced([phase.clone(), phase]);
        let is_told = reduced.is_finite() && velocity.is_finite() && self.turns.unsigned_abs() < 1 << 53;
        if !(is_inside && is_told && distances[0].is_finite()) {
            return self.undecided(Side::Bottom, reduced);
        }
        let [height, _] = distances;
        let set = Set::of([reduced, -(velocity * Interval::pi())]);
        let height = Some(height * Interval::<E>::pi().square());
        self.depart(Side::Bottom, &set, height, false)
    }

    fn depart(&mut self, side: Side, set: &Set<E>, height: Option<Interval<E>>, released: bool) -> Event<Interval<E>> {
        let launch = Launch {
            side,
            state: set.hull().clone(),
            height,
            released,
        };
        match self.motion.other_forcing() {
            None => self.fly::<Cosine<Interval<E>>>(&launch, set),
            Some(_) => self.fly::<Several<Interval<E>>>(&launch, set),
        }
    }

    fn begin(&mut self, start: Start<Interval<E>>) -> Event<Interval<E>> {
        let Start {
            side, phase, velocity, ..
        } = start;
        let [phase, _] = self.reduced([phase.clone(), phase]);
        let speed = side.signed(velocity.clone());
        // the phase loses as many digits as its turns take
        let is_reduced = phase.is_finite() && self.turns.unsigned_abs() < 1 << 53;
        if !(is_reduced && speed.is_finite() && speed.low() >= E::zero()) {
            return self.undecided(side, phase);
        }
        let launch = self.restitution(side).clone() * speed * Interval::pi();
        let set = Set::of([phase.clone(), launch]);
        self.place = Place::Leaving {
            side,
            set,
            height: None,
            released: false,
        };
        self.event(Kind::Impact, side, phase, velocity)
    }

    /// Phases less the turns of the first, which are counted.
    fn reduced(&mut self, phases: [Interval<E>; 2]) -> [Interval<E>; 2] {
        let turns = (phases[0].to_f64() / std::f64::consts::TAU).floor();
        if turns == 0.0 {
            return phases;
        }
        let turns = turns as i64;
        self.turns = self.turns.saturating_add(turns);
        let angle = Interval::pi() * Interval::from_integer(turns.saturating_mul(2));
        phases.map(|phase| phase - angle.clone())
    }

    fn fly<W: Waves<Interval<E>>>(&mut self, launch: &Launch<E>, set: &Set<E>) -> Event<Interval<E>> {
        let side = launch.side;
        let flight = Flight::<E, W>::new(&self.motion, launch);
        if let Some(event) = self.completed(&flight) {
            return event;
        }
        let (clear, contact) = match self.told_in_f64(&flight, launch) {
            Some(contact) => (E::zero(), Some(contact)),
            None => flight.contact(),
        };
        let landed = contact.and_then(|contact| Some((self.landed(&flight, launch, set, &contact)?, contact)));
        let Some((set, contact)) = landed else {
            let [phase, _] = self.reduced([flight.phase.clone() + Interval::point(clear), Interval::from_integer(0)]);
            return self.undecided(side, phase);
        };
        let wall = contact.wall;
        let [phase, launch] = set.hull().clone();
        // a plastic impact leaves nothing to tell the speed by
        let restitution = self.restitution(wall);
        let by_launch = restitution.is_positive().then(|| launch / restitution.clone());
        let speed = by_launch.and_then(|speed| speed.intersection(&contact.speed));
        let speed = speed.unwrap_or(contact.speed) / Interval::pi();
        let event = self.event(Kind::Impact, wall, phase, wall.signed(speed));
        self.place = Place::Leaving {
            side: wall,
            set,
            height: None,
            released: false,
        };
        event
    }

    /// The contact of a flight over a wider number, where intervals over f64 prove which it is.
    fn told_in_f64<W: Waves<Interval<E>>>(&self, flight: &Flight<E, W>, launch: &Launch<E>) -> Option<Contact<E, W>> {
        let narrow = self.narrow.as_ref()?;
        let launch = Launch {
            side: launch.side,
            state: launch.state.each_ref().map(around),
            height: launch.height.as_ref().map(around),
            released: launch.released,
        };
        let contact = match narrow.other_forcing() {
            None => Flight::<f64, Cosine<Interval<f64>>>::new(narrow, &launch).told(),
            Some(_) => Flight::<f64, Several<Interval<f64>>>::new(narrow, &launch).told(),
        };
        let (wall, [angle, speed]) = contact?;
        let [angle, speed] =
            [angle, speed].map(|value| Interval::new(E::from_f64(value.low()), E::from_f64(value.high())));
        flight.narrowed(wall, angle, &speed)
    }

    /// The departures after a contact.
    fn landed<W: Waves<Interval<E>>>(
        &mut self,
        flight: &Flight<E, W>,
        launch: &Launch<E>,
        set: &Set<E>,
        contact: &Contact<E, W>,
    ) -> Option<Set<E>> {
        let (wall, released) = (contact.wall, launch.released);
        let restitution = self.restitution(wall).clone();
        let after = |flight: &Flight<E, W>, contact: &Contact<E, W>| {
            [
                flight.phase.clone() + contact.angle.clone(),
                restitution.clone() * contact.speed.clone(),
            ]
        };
        let hull = after(flight, contact);
        // a release is one departure, known as exactly as can be
        let image = if released {
            hull.clone()
        } else {
            let launch = Launch {
                state: set.centre(),
                ..launch.clone()
            };
            let centre = Flight::<E, W>::new(&self.motion, &launch);
            let narrowed = centre.narrowed(wall, contact.angle.clone(), &contact.speed)?;
            after(&centre, &narrowed)
        };
        let [phase, centre] = self.reduced([hull[0].clone(), image[0].clone()]);
        let [_, speed] = hull;
        let hull = [phase, speed];
        if released {
            return Some(Set::of(hull));
        }
        let [_, image_speed] = image;
        let slopes = slopes(flight, contact, &restitution);
        set.mapped([centre, image_speed], &slopes, &hull)
    }

    /// The rest that a chatter ends with, where what is known here proves that it does.
    fn completed<W: Waves<Interval<E>>>(&mut self, flight: &Flight<E, W>) -> Option<Event<Interval<E>>> {
        let side = flight.side;
        let is_slow = flight.start.w.high().to_f64() < LISTED;
        let angle = flight.accumulation(self.restitution(side)).filter(|_| is_slow)?;
        if angle.width() > self.completing && angle.width() > flight.phase.width() {
            return None;
        }
        let phase = flight.phase.clone() + angle;
        let [phase, _] = self.reduced([phase.clone(), phase]);
        let since = phase.clone();
        self.place = Place::Resting { side, since };
        Some(self.event(Kind::Rest, side, phase, Interval::from_integer(0)))
    }

    /// Where f + g begins to pull the ball off: cos(phase) = -g under the forcing of the paper.
    fn release(&mut self, side: Side, since: &Interval<E>) -> Option<Event<Interval<E>>> {
        let released = match self.motion.other_forcing() {
            None => self.release_of_cosine(side),
            Some(_) => enclosed(&Several::drive(&self.motion), self.motion.g()).map(|turns| {
                let falling = side == Side::Bottom;
                let turns = turns.into_iter().filter(|turn| turn.1 == falling);
                turns.map(|(phase, _)| phase).collect()
            }),
        };
        let Some(phases) = released else {
            return Some(self.undecided(side, since.clone()));
        };
        // the push is positive from the rest on: the two are apart
        let later = phases.iter().find(|phase| phase.midpoint() >= since.midpoint());
        let phase = later.or(phases.first())?.clone();
        if later.is_none() {
            self.turns += 1;
        }
        let set = Set::of([phase.clone(), Interval::from_integer(0)]);
        self.place = Place::Leaving {
            side,
            set,
            height: None,
            released: true,
        };
        Some(self.event(Kind::Release, side, phase, Interval::from_integer(0)))
    }

    /// The phase at which a wall releases under the forcing of the paper, if it does; `None` where that is not told.
    fn release_of_cosine(&self, side: Side) -> Option<Vec<Interval<E>>> {
        let one = || Interval::<E>::from_integer(1);
        let g = self.motion.g().clone();
        let room = (one() - g.clone()) * (one() + g.clone());
        if room.high() <= E::zero() {
            return Some(Vec::new());
        }
        let angle = room.is_positive().then(|| (-g).acos())?;
        Some(vec![match side {
            Side::Bottom => angle,
            Side::Top => Interval::pi() + Interval::pi() - angle,
        }])
    }

    /// The next event that is listed.
    fn listed(&mut self) -> Option<Event<Interval<E>>> {
        let event = self.advance()?;
        let is_start = !std::mem::replace(&mut self.has_started, true);
        if !is_hidden(&event) {
            self.exhaustive = false;
            return Some(event);
        }
        if self.exhaustive || is_start || self.restitution(event.side).high() >= E::one() {
            return Some(event);
        }
        match self.completion(&event) {
            Some((ahead, rest)) => {
                *self = ahead;
                Some(rest)
            }
            None => {
                self.exhaustive = true;
                Some(event)
            }
        }
    }

    /// The rest that the chatter which goes on with `event` ends with, if it does.
    fn completion(&self, event: &Event<Interval<E>>) -> Option<(Self, Event<Interval<E>>)> {
        let mut ahead = self.clone();
        for _ in 0..MOST_HIDDEN {
            if !stop::goes_on() {
                return None;
            }
            let next = ahead.advance()?;
            match next.kind {
                Kind::Rest => return Some((ahead, next)),
                Kind::Impact if next.side == event.side && is_hidden(&next) => {}
                _ => return None,
            }
        }
        None
    }
}

/// Too slow to be listed where its chatter completes.
fn is_hidden<E: Endpoint>(event: &Event<Interval<E>>) -> bool {
    event.kind == Kind::Impact && event.velocity.to_f64().abs() < LISTED
}

/// The derivatives of phase and launch speed after a contact by those before: (20), (21) in units without pi.
fn slopes<E: Endpoint, W: Waves<Interval<E>>>(
    flight: &Flight<E, W>,
    contact: &Contact<E, W>,
    restitution: &Interval<E>,
) -> [[Interval<E>; 2]; 2] {
    let is_back = contact.wall == flight.side;
    let towards = |value: Interval<E>| if is_back { -value } else { value };
    let (start, there) = (&flight.start, &contact.there);
    let rate = towards(contact.speed.clone());
    let one = Interval::<E>::from_integer(1);
    let by_phase = -(flight.lifted(contact) / rate.clone());
    let by_speed = -(contact.angle.clone() / rate);
    let gained = start.waves.f() - there.waves.f();
    let speed = |direct: Interval<E>, angle: &Interval<E>| {
        restitution.clone() * towards(direct - there.push.clone() * angle.clone())
    };
    [
        [one.clone() + by_phase.clone(), by_speed.clone()],
        [speed(gained, &by_phase), speed(one, &by_speed)],
    ]
}

impl<E: Endpoint> Iterator for Enclosure<E> {
    type Item = Event<Interval<E>>;

    fn next(&mut self) -> Option<Self::Item> {
        let event = self.listed()?;
        self.idle = if event.kind == Kind::Impact { 0 } else { self.idle + 1 };
        Some(event)
    }
}

#[cfg(test)]
mod tests;
