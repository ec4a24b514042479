//! The next flight of every lane.

use super::angle::{nearest, pick, sin_cos};
use super::flights::Flights;
use super::growth::Growths;
use super::lanes::{Lanes, Row, WIDTH, either_wall};
use super::near::Near;
use super::search::{Leaving, Stretch};
use crate::impact::chatter::LISTED;
use crate::impact::swing::REACH;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// The speeds and gaps, in units of [`Scaled`](crate::impact::scaled::Scaled), that are ordinary; above the smallest a
/// chatter is listed, not completed.
const SLOWEST: f64 = 1.5 * LISTED * PI;
const FASTEST: f64 = 100.0;
const WIDEST: f64 = 100.0;

/// A contact slower than this grazes, as far as is told here, if it is not one of a chatter.
const GRAZING: f64 = 1e-3;

/// The same of a chatter, over the speed at which the ball left.
const GRAZING_HOP: f64 = 0.05;

/// Where the cubic comes this close to the angle of the latest flight, the motion may have settled and the angle be the
/// same again.
const SETTLED: f64 = 0.12;

/// The most pieces of a flight.
const MOST_PIECES: usize = 5;

/// The most steps to a contact.
const MOST_STEPS: usize = 4;

/// Follows every lane to its next impact, and, with `GROWTH`, what that makes of rounding errors. A lane whose flight is
/// not ordinary, or not beyond doubt, is left as it is, with `flown` 0.
#[inline(always)]
pub(super) fn step<const GROWTH: bool>(lanes: &mut Lanes, flights: &mut Flights, growths: &mut Growths) {
    search::<GROWTH>(lanes, flights);
    propose(lanes, flights);
    for _ in 0..MOST_STEPS {
        let next = |lane: usize| flights.angle[lane] + flights.leap[lane];
        if any(&flights.state, |lane, state| (state > 0.0) & (next(lane) < REACH)) {
            improve::<true>(lanes, flights);
        } else {
            improve::<false>(lanes, flights);
        }
        if !any(&flights.state, |_, state| state > 0.0) {
            break;
        }
    }
    if GROWTH {
        growths.follow(lanes, flights);
    }
    let is_close = |lane: usize, state: f64| (state == 0.0) & (flights.angle[lane] < REACH);
    if any(&flights.state, is_close) {
        rebound::<true>(lanes, flights);
    } else {
        rebound::<false>(lanes, flights);
    }
}

/// Whether something holds of a lane.
#[inline(always)]
fn any(row: &Row, of: impl Fn(usize, f64) -> bool) -> bool {
    let mut holds = 0;
    for (lane, &value) in row.iter().enumerate() {
        holds |= u64::from(of(lane, value));
    }
    holds != 0
}

impl Lanes {
    #[inline(always)]
    fn leaving(&self, lane: usize) -> Leaving {
        let side = self.side[lane];
        Leaving {
            side,
            phase: self.phase[lane],
            sin: self.sin[lane],
            cos: self.cos[lane],
            speed: self.speed[lane],
            g: side * self.g[lane],
            gap: self.gap[lane],
            turn: self.turn[lane],
            turn_sin: self.turn_sin[lane],
        }
    }
}

/// In which stretches the contacts are. Most flights have two pieces at most.
#[inline(always)]
fn search<const GROWTH: bool>(lanes: &Lanes, flights: &mut Flights) {
    for lane in 0..WIDTH {
        let leaving = lanes.leaving(lane);
        let speed = leaving.speed;
        let is_ordinary = (speed > SLOWEST) & (speed < FASTEST) & (leaving.gap < WIDEST);
        let search = leaving.search(is_ordinary);
        flights.keep_search(lane, leaving.piece::<GROWTH>(leaving.piece::<GROWTH>(search)));
    }
    for _ in 2..MOST_PIECES {
        if !any(&flights.open, |_, open| open > 0.0) {
            break;
        }
        for lane in 0..WIDTH {
            let search = lanes.leaving(lane).piece::<GROWTH>(flights.search(lane));
            flights.keep_search(lane, search);
        }
    }
}

/// Where in their stretches the contacts are, about.
#[inline(always)]
fn propose(lanes: &Lanes, flights: &mut Flights) {
    for lane in 0..WIDTH {
        let stretch = flights.stretch(lane);
        let [bottom, top] = &lanes.latest;
        let latest = pick(
            stretch.is_far,
            either_wall(lanes.side[lane], bottom[1][lane], top[1][lane]),
            either_wall(lanes.side[lane], bottom[0][lane], top[0][lane]),
        );
        flights.angle[lane] = proposal(&lanes.leaving(lane), &stretch, latest);
        flights.leap[lane] = 0.0;
        flights.state[lane] = pick(stretch.is_found, 1.0, -1.0);
    }
}

/// A short hop under a push that hardly changes, the angle of the `latest` flight like this one where that fits, or the
/// cubic through both ends of the stretch.
#[inline(always)]
fn proposal(leaving: &Leaving, stretch: &Stretch, latest: f64) -> f64 {
    let inverse = 1.0 / (leaving.cos + leaving.g);
    let rough = leaving.speed * inverse;
    let hop = 2.0 * rough * (1.0 + 2.0 / 3.0 * leaving.sin * rough * inverse);
    let is_hop = !stretch.is_far & (stretch.low == 0.0) & (hop > 0.0) & (hop < stretch.high) & (hop < REACH);
    let cubic = stretch.cubic();
    let is_settled = ((latest - cubic).abs() < SETTLED) & (latest > stretch.low) & (latest < stretch.high);
    pick(is_hop, hop, pick(is_settled, latest, cubic))
}

/// One step nearer to each contact that is not found yet, by the series of the inverse function to the fourth order, as
/// in meeting.rs. `CLOSE`: whether one of them may be close to its departure.
#[inline(always)]
fn improve<const CLOSE: bool>(lanes: &Lanes, flights: &mut Flights) {
    for lane in 0..WIDTH {
        let leaving = lanes.leaving(lane);
        let angle = flights.angle[lane] + flights.leap[lane];
        let far = leaving.at(angle);
        let there = if CLOSE {
            leaving.close(angle).or(far, angle < REACH)
        } else {
            far
        };
        let is_far = flights.far[lane] > 0.0;
        let towards = |value: f64| pick(is_far, -value, value);
        let distance = pick(is_far, leaving.gap - there.y, there.y);
        let approach = pick(is_far, there.w, -there.w);
        let inverse = 1.0 / approach;
        let first = distance * inverse;
        let b = towards(there.push) * inverse * 0.5;
        let c = -towards(there.sin) * inverse * (1.0 / 6.0);
        let d = -towards(there.cos) * inverse * (1.0 / 24.0);
        let bb = b * b;
        let third = bb + bb - c;
        let fourth = b * (5.0 * (c - bb)) - d;
        let series = first + first * first * (first * (third + first * fourth) - b);
        let size = first.abs();
        let product = (b * first).abs();
        let bent = pick(product > size, product, size);
        let is_bent = bent >= 0.1;
        let leap = pick(is_bent, first, series);
        let left = 14.0 * size * ((bent * bent) * (bent * bent));
        let next = angle + leap;
        // no angle of a stretch is tried that is not in it, nor one from which the ball recedes
        let is_right = (approach > 0.0) & (next > flights.low[lane]) & (next <= flights.high[lane]);
        let is_done = is_right & !is_bent & (left <= 0.25 * f64::EPSILON * next);

        let state = flights.state[lane];
        let is_open = state > 0.0;
        let keep = |new: f64, old: f64| pick(is_open, new, old);
        flights.angle[lane] = keep(angle, flights.angle[lane]);
        flights.leap[lane] = keep(leap, flights.leap[lane]);
        flights.keep_near(lane, there.or(flights.near(lane), is_open));
        flights.state[lane] = keep(pick(is_done, 0.0, pick(is_right, 1.0, -1.0)), state);
    }
}

/// The contact that a flight ends with.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    /// The angle of the forcing since the departure.
    pub angle: f64,
    /// Whether that, but for the last step to it, is within [`REACH`].
    pub is_close: bool,
    /// The flight there.
    pub there: Near,
    /// Whether it is the other wall, and how fast the ball approaches it.
    pub is_far: bool,
    pub approach: f64,
    /// Whether the flight is an ordinary one, and beyond doubt.
    pub is_flown: bool,
}

impl Flights {
    /// The contact of a lane.
    #[inline(always)]
    pub fn contact(&self, lanes: &Lanes, lane: usize) -> Contact {
        let (angle, leap) = (self.angle[lane], self.leap[lane]);
        let is_close = angle < REACH;
        let there = self.near(lane).after(leap);
        let is_far = self.far[lane] > 0.0;
        let approach = pick(is_far, there.w, -there.w);
        let slowest = pick(!is_far & is_close, GRAZING_HOP * lanes.speed[lane], GRAZING);
        Contact {
            angle: angle + leap,
            is_close,
            there,
            is_far,
            approach,
            is_flown: (self.state[lane] == 0.0) & (approach > slowest) & (approach > SLOWEST) & (approach < FASTEST),
        }
    }
}

/// The impacts, and the departures after them. `CLOSE`: whether one of them may be close to its departure.
#[inline(always)]
fn rebound<const CLOSE: bool>(lanes: &mut Lanes, flights: &Flights) {
    for lane in 0..WIDTH {
        let Contact {
            angle,
            is_close,
            there,
            is_far,
            approach,
            is_flown,
        } = flights.contact(lanes, lane);
        let (phase, turns) = reduced(lanes.phase[lane] + angle);
        let left = lanes.side[lane];
        let side = pick(is_far, -left, left);
        let (mut sin, mut cos) = (pick(is_far, -there.sin, there.sin), pick(is_far, -there.cos, there.cos));
        if CLOSE {
            // expanded about the departure: rounding errors of sine and cosine would add up
            let fresh = sin_cos(phase);
            sin = pick(is_close, side * fresh.0, sin);
            cos = pick(is_close, side * fresh.1, cos);
        }
        let r = either_wall(side, lanes.restitution[0][lane], lanes.restitution[1][lane]);
        let keep = |new: f64, old: f64| pick(is_flown, new, old);
        lanes.side[lane] = keep(side, left);
        lanes.phase[lane] = keep(phase, lanes.phase[lane]);
        lanes.sin[lane] = keep(sin, lanes.sin[lane]);
        lanes.cos[lane] = keep(cos, lanes.cos[lane]);
        lanes.speed[lane] = keep(r * approach, lanes.speed[lane]);
        lanes.turns[lane] = turns;
        lanes.velocity[lane] = side * (approach * FRAC_1_PI);
        lanes.flown[lane] = keep(1.0, 0.0);
        for (wall, angles) in lanes.latest.iter_mut().enumerate() {
            let is_from = if wall == 0 { left > 0.0 } else { left < 0.0 };
            let new = is_flown & is_from;
            angles[0][lane] = pick(new & !is_far, angle, angles[0][lane]);
            angles[1][lane] = pick(new & is_far, angle, angles[1][lane]);
        }
    }
}

/// A phase in [0, 2 pi), and the turns taken off it.
#[inline(always)]
fn reduced(phase: f64) -> (f64, f64) {
    // the nearest whole number to half a turn less; rounding may put it one off
    let turns = nearest(phase * (0.5 * FRAC_1_PI) - 0.5);
    let phase = phase - TAU * turns;
    let (less, more) = (phase < 0.0, phase >= TAU);
    (
        phase + pick(less, TAU, 0.0) - pick(more, TAU, 0.0),
        turns - pick(less, 1.0, 0.0) + pick(more, 1.0, 0.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::scaled::{Departure, Scaled};
    use crate::impact::waves::{Cosine, Waves};
    use crate::model::{Motion, Side};

    /// A ball that leaves the bottom, in every lane.
    fn lanes(motion: [f64; 4], phase: f64, speed: f64) -> Lanes {
        let [g, d, r_b, r_t] = motion;
        let scaled = Scaled::new(&Motion::new(g, d, r_b, r_t).expect("a motion"));
        let from = Departure {
            side: Side::Bottom,
            phase,
            waves: Cosine::at(&(), &phase),
            speed,
            height: None,
            released: false,
        };
        let mut lanes = Lanes::idle();
        for lane in 0..WIDTH {
            lanes.enter(lane, &scaled);
            lanes.depart(lane, &from);
        }
        lanes
    }

    /// How many of so many flights one after the other are flown in lanes.
    fn flown(lanes: &mut Lanes, flights: usize) -> usize {
        let mut rows = Flights::none();
        let mut step_by = || {
            step::<false>(lanes, &mut rows, &mut Growths::none());
            assert!(lanes.flown.iter().all(|flown| *flown == lanes.flown[0]));
            lanes.flown[0] == 1.0
        };
        (0..flights).take_while(|_| step_by()).count()
    }

    #[test]
    fn a_motion_that_settles_is_flown_in_lanes_alone() {
        // near the orbits, each start at a bottom impact of about that velocity
        for (r_b, r_t, d, phase, velocity) in [
            (0.5, 0.5, 0.4, 0.49, 0.83),
            (0.6, 0.3, 0.26, 0.93, 0.70),
            (0.6, 0.3, 0.33, 1.21, 0.73),
        ] {
            let mut lanes = lanes([0.12201, d, r_b, r_t], phase, r_b * velocity * PI);
            assert_eq!(flown(&mut lanes, 1000), 1000, "{d}");
        }
    }

    #[test]
    fn a_chatter_is_flown_in_lanes_down_to_what_is_listed() {
        let mut lanes = lanes([0.1, 0.3, 0.6, 0.6], 5.5, 0.1);
        let impacts = flown(&mut lanes, 100);
        assert!((15..30).contains(&impacts), "{impacts}");
        let speed = lanes.speed[0];
        assert!(speed < 3.0 * SLOWEST, "{speed}");
    }

    #[test]
    fn what_is_not_beyond_doubt_is_left_as_it_is() {
        // turned back at the top by pi² times 1e-8, as the test of grazing contacts in simulation.rs has it
        let (g, phase, launch): (f64, f64, f64) = (0.12, 5.6, 0.45 * PI);
        let mut x: f64 = 1.2;
        for _ in 0..60 {
            x += (launch + phase.sin() - g * x - (phase + x).sin()) / ((phase + x).cos() + g);
        }
        let height = (launch + phase.sin()) * x - 0.5 * g * x * x - phase.cos() + (phase + x).cos();
        let d = height / (PI * PI) - 1e-8;
        let grazing = ([g, d, 0.5, 0.5], phase, launch);
        let doubtful = [
            grazing,
            ([0.12, 0.4, 0.5, 0.5], 6.18, SLOWEST * 0.5),
            ([0.12, 0.4, 0.5, 0.5], 6.18, FASTEST * 2.0),
            ([0.12, WIDEST, 0.5, 0.5], 6.18, 1.0),
            ([1.1, 0.4, 0.5, 0.5], 6.18, 1.0),
        ];
        for (motion, phase, speed) in doubtful {
            let mut lanes = lanes(motion, phase, speed);
            let before = lanes.clone();
            assert_eq!(flown(&mut lanes, 1), 0, "{motion:?}");
            let same = |of: fn(&Lanes) -> Row| assert_eq!(of(&lanes), of(&before), "{motion:?}");
            same(|lanes| lanes.side);
            same(|lanes| lanes.phase);
            same(|lanes| lanes.sin);
            same(|lanes| lanes.cos);
            same(|lanes| lanes.speed);
        }
    }

    #[test]
    fn phases_are_reduced_at_and_beside_whole_turns() {
        for (phase, turns) in [(0.0, 0.0), (TAU.next_down(), 0.0), (TAU, 1.0), (3.0 * TAU + 1.0, 3.0)] {
            let (rest, taken) = reduced(phase);
            assert_eq!(taken, turns);
            assert!((0.0..TAU).contains(&rest) && (rest + taken * TAU - phase).abs() < 1e-14);
        }
    }
}
