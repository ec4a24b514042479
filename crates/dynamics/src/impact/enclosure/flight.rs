//! The first contact of every flight out of a box of departures, proved.
//!
//! Leaps: where the ball is a distance D from a wall, recedes at V at least and is pulled there by K at most, it keeps off
//! the wall for as long as D + V x - K x²/2 > 0. Leap by leap the flight comes as near to its contact as rounding lets
//! it, and never beyond; then the speed there bounds how soon it is met, and Newton's method over intervals how exactly.

use super::super::expansion::Expansion;
use super::super::swing::{REACH, Swing};
use super::super::waves::{Bounds, Waves};
use crate::model::{Motion, Side};
use numbers::{Analytic, Endpoint, Field, Interval};
use stop;

/// Beyond so many leaps, a thousand or more flights of use, it is left open what is met.
const MOST_LEAPS: usize = 20_000;

/// Newton's method doubles the digits: 200 of them take fewer steps.
const MOST_STEPS: usize = 40;

/// More halvings than any range of use: 2^-60 of half a radian.
const MOST_HALVINGS: usize = 60;

/// A leap is tried at so many times its length.
const STRETCH: f64 = 8.0;

/// What is left of a leap for the roundings of its length.
const CAUTION: f64 = 1.0 - 1e-9;

/// A box of departures from a wall.
#[derive(Clone, Debug)]
pub(super) struct Launch<E: Endpoint> {
    pub side: Side,
    /// Phase, and speed away from the wall.
    pub state: [Interval<E>; 2],
    /// The distance from the wall of a ball that starts in flight.
    pub height: Option<Interval<E>>,
    /// Whether the departure is the very phase at which f + g vanishes.
    pub released: bool,
}

/// A flight from a box of departures, in units without pi.
pub(super) struct Flight<E: Endpoint, W: Waves<Interval<E>>> {
    pub side: Side,
    pub phase: Interval<E>,
    pub start: Expansion<Interval<E>, W>,
    pub is_free: bool,
    drive: W::Drive,
    bounds: Bounds,
    /// g as seen from the wall that was left.
    g: Interval<E>,
    /// `None` without a wall at the top.
    gap: Option<Interval<E>>,
    /// Whether f + g vanishes at the departure.
    released: bool,
}

/// Where every flight of the box ends: its first contact, and the only one within the angle.
pub(super) struct Contact<E: Endpoint, W> {
    pub wall: Side,
    pub angle: Interval<E>,
    /// The rate of approach at the wall.
    pub speed: Interval<E>,
    pub there: Expansion<Interval<E>, W>,
}

/// How a wall is approached: the distance, and its rate.
struct Approach<E: Endpoint> {
    distance: Interval<E>,
    rate: Interval<E>,
}

impl<E: Endpoint, W: Waves<Interval<E>>> Flight<E, W> {
    /// Out of a box of departures.
    pub fn new(motion: &Motion<Interval<E>>, launch: &Launch<E>) -> Self {
        let side = launch.side;
        let [phase, speed] = launch.state.clone();
        let drive = W::drive(motion);
        let waves = W::at(&drive, &phase).seen(side);
        let g = side.signed(motion.g().clone());
        let zero = || Interval::from_integer(0);
        Self {
            side,
            phase,
            start: Expansion {
                y: launch.height.clone().unwrap_or_else(zero),
                w: speed,
                push: if launch.released { zero() } else { waves.f() + g.clone() },
                waves,
            },
            is_free: launch.height.is_some(),
            bounds: W::bounds(&drive, |value| above(&value.magnitude())),
            drive,
            g,
            gap: motion
                .has_top()
                .then(|| Interval::<E>::pi().square() * motion.d().clone()),
            released: launch.released,
        }
    }

    /// The forcing at an angle after the departure, as seen from the wall that was left.
    fn waves(&self, x: Interval<E>) -> W {
        W::at(&self.drive, &(self.phase.clone() + x)).seen(self.side)
    }

    fn is_short(&self, x: &Interval<E>) -> bool {
        above(&x.high()) * self.bounds.highest < REACH
    }

    /// The flight at an angle after the departure.
    fn at(&self, x: &Interval<E>) -> Expansion<Interval<E>, W> {
        if self.is_short(x) {
            return self.start.swung(x, Swing::enclosing);
        }
        self.start.far(&self.g, x, self.waves(x.clone()))
    }

    /// The derivative of the distance by the phase of the departure: x f(0) + F_1(0) - F_1(x).
    pub fn lifted(&self, contact: &Contact<E, W>) -> Interval<E> {
        let (x, waves) = (&contact.angle, &self.start.waves);
        if self.is_short(x) {
            return waves.after(x, Swing::enclosing).1.f1;
        }
        x.clone() * waves.f() + waves.f1() - contact.there.waves.f1()
    }

    /// `None` where there is no such wall.
    fn approach(&self, wall: Side, there: &Expansion<Interval<E>, W>) -> Option<Approach<E>> {
        if wall == self.side {
            return Some(Approach {
                distance: there.y.clone(),
                rate: -there.w.clone(),
            });
        }
        Some(Approach {
            distance: self.gap.clone()? - there.y.clone(),
            rate: there.w.clone(),
        })
    }

    /// The most that a ball is ever accelerated towards a wall, and away from it.
    fn pulls(&self, wall: Side) -> [f64; 2] {
        let g = if wall == self.side {
            self.g.clone()
        } else {
            -self.g.clone()
        };
        let f = Interval::from_f64(self.bounds.f);
        [f.clone() + g.clone(), f - g].map(|pull| above(&pull.high()).max(f64::MIN_POSITIVE))
    }

    /// The first contact; `None` where that is not decided, by how exactly the departure is known or by rounding.
    ///
    /// With it the angle up to which no wall is met.
    pub fn contact(&self) -> (E, Option<Contact<E, W>>) {
        let walls = [self.side, self.side.opposite()];
        let mut x = E::zero();
        if self.start.w.high() == E::zero() && !self.is_free {
            match self.lifted_off() {
                Some(angle) => x = angle,
                None => return (x, None),
            }
        }
        for _ in 0..MOST_LEAPS {
            let there = if x.is_zero() {
                self.start.clone()
            } else {
                self.at(&Interval::point(x.clone()))
            };
            let approaches = walls.map(|wall| self.approach(wall, &there));
            let clear = [0, 1].map(|index| self.clear(approaches[index].as_ref(), walls[index], &there));
            for (index, approach) in approaches.iter().enumerate() {
                let Some((approach, reach)) = approach
                    .as_ref()
                    .and_then(|approach| Some((approach, self.reach(approach, walls[index])?)))
                else {
                    continue;
                };
                // the other wall is not met before this one is
                if reach.to_f64() * 1.001 < clear[1 - index] {
                    let contact = self.refined(walls[index], &x, reach, approach);
                    return (x, contact);
                }
            }
            // down: the sum of an angle and a leap is rounded
            let next = (x.clone() + E::from_f64(clear[0].min(clear[1]) * CAUTION)).below();
            let has_moved = next > x;
            if !(has_moved && stop::goes_on()) {
                return (x, None);
            }
            x = next;
        }
        (x, None)
    }

    /// The wall of the first contact, with its angle and the rate of approach; `None` where that is not decided.
    pub fn told(&self) -> Option<(Side, [Interval<E>; 2])> {
        let contact = self.contact().1?;
        Some((contact.wall, [contact.angle, contact.speed]))
    }

    /// For how long a wall is not met, whatever is decided of the distance now: it is at least 0, by the leaps before.
    ///
    /// Over an angle s the pull is at most `now + slope s + bend s²/2`, with what it is now, its slope, and a bound of |f''|:
    /// less than it is ever where a flight is short, so that the leap is stretched as far as that bears.
    fn clear(&self, approach: Option<&Approach<E>>, wall: Side, there: &Expansion<Interval<E>, W>) -> f64 {
        let Some(approach) = approach else {
            return f64::INFINITY;
        };
        let [most, _] = self.pulls(wall);
        let distance = below(&approach.distance.low()).max(0.0);
        let recession = below(&(-approach.rate.clone()).low());
        if recession.is_nan() {
            return 0.0;
        }
        let leap = |pull: f64| {
            // sqrt(V² + 2 K D), without a square that underflows
            let root = recession.hypot((2.0 * pull).sqrt() * distance.sqrt());
            if recession > 0.0 {
                (recession + root) / pull
            } else if distance > 0.0 {
                2.0 * distance / (root - recession)
            } else {
                0.0
            }
        };
        let now = above(&if wall == self.side {
            there.push.high()
        } else {
            (-there.push.clone()).high()
        });
        let slope = above(&there.waves.minus_slope().magnitude());
        let mut clear = leap(most);
        while clear > 0.0 {
            let further = STRETCH * clear;
            let pull = (now + further * (slope + self.bounds.bend * further)).max(f64::MIN_POSITIVE);
            if pull.is_nan() || pull >= most {
                break;
            }
            let bears = leap(pull);
            if bears < further {
                return clear.max(bears);
            }
            clear = further;
        }
        clear
    }

    /// Within which angle from now a wall is met for certain, and approached all the while at half the rate or more.
    fn reach(&self, approach: &Approach<E>, wall: Side) -> Option<E> {
        let is_off = approach.distance.high() > E::zero();
        if !(approach.rate.is_positive() && is_off) {
            return None;
        }
        let [_, away] = self.pulls(wall);
        let rate = Interval::point(approach.rate.low());
        let distance = Interval::point(approach.distance.high());
        let reach = ((distance.clone() + distance) / rate.clone()).high();
        let slowed = Interval::from_f64(away) * Interval::point(reach.clone());
        (rate - (slowed.clone() + slowed)).is_positive().then_some(reach)
    }

    /// The contact between `x`, up to which there is none, and `reach` further on.
    fn refined(&self, wall: Side, x: &E, reach: E, approach: &Approach<E>) -> Option<Contact<E, W>> {
        let end = Interval::point(x.clone()) + Interval::point(reach.clone());
        let angle = Interval::new(x.clone(), end.high());
        let half = approach.rate.clone() / Interval::from_integer(2);
        let gained = Interval::from_f64(self.pulls(wall)[0]) * Interval::point(reach);
        let rates = half.hull(&(approach.rate.clone() + gained));
        self.narrowed(wall, angle, &rates)
    }

    /// The contact in an angle that holds one and no other, where the wall is approached at one of the rates.
    pub fn narrowed(&self, wall: Side, mut angle: Interval<E>, rates: &Interval<E>) -> Option<Contact<E, W>> {
        for step in 0..=MOST_STEPS {
            let there = self.at(&angle);
            let speed = self.approach(wall, &there)?.rate.intersection(rates)?;
            let middle = Interval::point(angle.midpoint());
            let distance = self.approach(wall, &self.at(&middle))?.distance;
            let narrower = (middle + distance / speed.clone()).intersection(&angle)?;
            let width = Interval::point(angle.width());
            let gain = width.clone() - Interval::point(narrower.width());
            if step == MOST_STEPS || !(gain.clone() + gain - width).is_positive() {
                let contact = Contact {
                    wall,
                    speed,
                    there,
                    angle,
                };
                return contact.speed.is_positive().then_some(contact);
            }
            angle = narrower;
        }
        None
    }

    /// An angle within which a ball without velocity has left its wall for certain and meets none.
    fn lifted_off(&self) -> Option<E> {
        let wall = self.side.opposite();
        let other = self.clear(self.approach(wall, &self.start).as_ref(), wall, &self.start);
        let mut angle = E::from_f64((other * CAUTION).min(0.5));
        for _ in 0..MOST_HALVINGS {
            let all = Interval::new(E::zero(), angle.clone());
            let waves = self.waves(all);
            // from a push of 0 that falls, or from one below 0 that stays there, the distance only grows
            let lifts = if self.released {
                waves.minus_slope().is_positive()
            } else {
                (waves.f() + self.g.clone()).is_negative()
            };
            if lifts {
                return Some(angle);
            }
            angle *= E::from_ratio(1, 2);
        }
        None
    }

    /// The angle after which a chatter is complete; `None` where it is not known to complete by what is known here.
    ///
    /// While the push a stays in [l, h], a hop of launch speed u takes between 2u/h and 2u/l, rises to u²/(2l) at most, and
    /// ends with a speed between u sqrt(l/h) and u sqrt(h/l): with restitution r the times are bounded by geometric
    /// series of the ratios r sqrt(l/h) and r sqrt(h/l).
    pub fn accumulation(&self, restitution: &Interval<E>) -> Option<Interval<E>> {
        if self.released || self.is_free {
            return None;
        }
        let one = || Interval::<E>::from_integer(1);
        if self.start.w.high().is_zero() && self.start.w.low().is_zero() && self.start.push.is_positive() {
            return Some(Interval::from_integer(0));
        }
        let twice = self.start.w.clone() + self.start.w.clone();
        let room = one() - restitution.clone();
        if !(self.start.push.is_positive() && room.is_positive() && self.start.w.low() >= E::zero()) {
            return None;
        }
        let guess = (twice.clone() + twice.clone()) / (self.start.push.clone() * room);
        let window = Interval::new(E::zero(), guess.high());
        let push = self.waves(window.clone()).f() + self.g.clone();
        if !push.is_positive() {
            return None;
        }
        let [low, high] = [push.low(), push.high()].map(Interval::point);
        let total = |speed: E, push: &Interval<E>, ratio: Interval<E>| {
            let room = one() - restitution.clone() * ratio.sqrt();
            let all = Interval::point(speed) / (push.clone() * room.clone());
            room.is_positive().then_some(all)
        };
        let latest = total(twice.high(), &low, high.clone() / low.clone())?;
        let earliest = total(twice.low(), &high, low.clone() / high.clone())?;
        let angle = Interval::new(earliest.low(), latest.high());
        let rise = self.start.w.square() / (low.clone() + low);
        let is_below_top = match &self.gap {
            Some(gap) => (gap.clone() - rise).is_positive(),
            None => true,
        };
        (angle.is_subset(&window) && is_below_top).then_some(angle)
    }
}

/// A lower bound in f64.
fn below<E: Endpoint>(value: &E) -> f64 {
    value.to_f64().next_down()
}

/// An upper bound in f64.
fn above<E: Endpoint>(value: &E) -> f64 {
    value.to_f64().next_up()
}
