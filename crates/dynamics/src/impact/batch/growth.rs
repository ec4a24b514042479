//! How rounding errors grow along many motions at once: what [`Growth`] does, lane by lane, without a branch.

use super::super::growth::{Growth, ROUNDED, SAFELY, STRAIGHT};
use super::super::swing::REACH;
use super::angle::pick;
use super::flights::Flights;
use super::lanes::{Lanes, Row, WIDTH};
use std::f64::consts::{LN_2, TAU};

/// Below this angle the terms of what a push lifts cancel; as in growth.rs.
const CANCELLING: f64 = 0.1;

/// Where the mantissa of an f64 begins, the exponent of 1, and 2^52, whose last bits are those of a small integer.
const MANTISSA: u32 = 52;
const ONE: u64 = 1023;
const TWO_TO_52: f64 = 4_503_599_627_370_496.0;

/// What rounding errors have become since their motions came into their lanes.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Growths {
    /// The first of the turned axes; the other is at right angles to it.
    axis: [Row; 2],
    sides: [Row; 2],
    error: [Row; 2],
    /// The stretch: this times two to the power of that.
    stretch: Row,
    power: Row,
    /// 1 where nothing is claimed any more.
    lost: Row,
}

impl Growths {
    pub fn none() -> Self {
        let row = [0.0; WIDTH];
        Self {
            axis: [[1.0; WIDTH], row],
            sides: [row; 2],
            error: [row; 2],
            stretch: [1.0; WIDTH],
            power: row,
            lost: row,
        }
    }

    /// Goes on from here in a lane.
    pub fn enter(&mut self, lane: usize, growth: &Growth) {
        let [first, second] = growth.axes;
        for part in 0..2 {
            self.axis[part][lane] = [first[0], second[0]][part];
            self.sides[part][lane] = growth.sides[part];
            self.error[part][lane] = growth.error[part];
        }
        self.stretch[lane] = 1.0;
        self.power[lane] = 0.0;
        self.lost[lane] = 0.0;
    }

    /// Tells what has come of it in a lane.
    pub fn leave(&self, lane: usize, growth: &mut Growth) {
        let [cos, sin] = self.axis.map(|row| row[lane]);
        growth.axes = [[cos, -sin], [sin, cos]];
        growth.sides = self.sides.map(|row| row[lane]);
        growth.error = self.error.map(|row| row[lane]);
        let stretch = self.stretch(lane);
        growth.stretch += stretch;
        growth.since_release += stretch;
        if self.lost[lane] > 0.0 {
            growth.lose();
        }
    }

    /// The logarithm of the stretch in a lane.
    pub fn stretch(&self, lane: usize) -> f64 {
        LN_2 * self.power[lane] + self.stretch[lane].ln()
    }

    /// Takes in the flights that are flown, before their impacts.
    #[inline(always)]
    pub fn follow(&mut self, lanes: &Lanes, flights: &Flights) {
        for lane in 0..WIDTH {
            let contact = flights.contact(lanes, lane);
            let (x, there) = (contact.angle, contact.there);
            let (launch, sin, cos) = (lanes.speed[lane], lanes.sin[lane], lanes.cos[lane]);
            let g = lanes.side[lane] * lanes.g[lane];
            let r = lanes.restitution_from(lane);
            let speed = contact.approach;
            let inverse = 1.0 / there.w;

            // the Jacobian of the flight and the impact
            let lifted = pick(
                x < CANCELLING,
                x * x * (0.5 * sin + x * (1.0 / 6.0) * cos),
                x * cos + sin - there.sin,
            );
            let (by_phase, by_speed) = (-lifted * inverse, -r * x * inverse);
            let towards = pick(contact.is_far, 1.0, -1.0);
            let (a, b) = (1.0 + by_phase, by_speed);
            let c = towards * (cos - there.cos - there.push * by_phase);
            let d = towards * (r - there.push * by_speed);

            // the errors of the flight itself
            let bent = 0.5 * x * x;
            let far = (launch + sin).abs() * x + g.abs() * bent + 2.0;
            let noise = ROUNDED * f64::EPSILON * pick(x < REACH, launch * x + bent, far);
            let own = ROUNDED * f64::EPSILON;
            let terms = launch + pick(x < REACH, (cos + g).abs() * x + x, g.abs() * x + 2.0);
            let e = noise / speed + own * (x + TAU) * 0.25;
            let f = there.push.abs() * noise / speed + own * terms;

            let (phase, velocity) = (SAFELY * self.error[0][lane], SAFELY * self.error[1][lane]);
            let at_a_dip = x * r * velocity + (x + 2.0) * phase;
            let moved = by_phase.abs() * phase + by_speed.abs() * velocity;
            let bend = moved * there.push.abs() / speed;
            // so that what is no number is lost as well
            let holds = (bend < STRAIGHT) & (at_a_dip < flights.clearance[lane]);

            let (p, q) = (self.axis[0][lane], self.axis[1][lane]);
            let (first_0, first_1) = (a * p + b * q, c * p + d * q);
            let (second_0, second_1) = (b * p - a * q, d * p - c * q);
            let length = (first_0 * first_0 + first_1 * first_1).sqrt();
            let (cosine, sine) = (first_0 / length, first_1 / length);
            let along = cosine * second_0 + sine * second_1;
            let across = cosine * second_1 - sine * second_0;
            let (side_0, side_1) = (self.sides[0][lane], self.sides[1][lane]);
            let new_0 = root_of_squares([length * side_0, along * side_1, cosine * e, sine * f]);
            let new_1 = root_of_squares([0.0, across * side_1, sine * e, cosine * f]);

            let is_flown = contact.is_flown;
            let keep = |row: &mut Row, value: f64| row[lane] = pick(is_flown, value, row[lane]);
            keep(&mut self.axis[0], cosine);
            keep(&mut self.axis[1], sine);
            keep(&mut self.sides[0], new_0);
            keep(&mut self.sides[1], new_1);
            keep(
                &mut self.error[0],
                root_of_squares([cosine * new_0, sine * new_1, 0.0, 0.0]),
            );
            keep(
                &mut self.error[1],
                root_of_squares([sine * new_0, cosine * new_1, 0.0, 0.0]),
            );
            let (stretch, power) = split(self.stretch[lane] * length);
            keep(&mut self.stretch, stretch);
            let powers = self.power[lane] + power;
            keep(&mut self.power, powers);
            let lost = pick(holds, self.lost[lane], 1.0);
            keep(&mut self.lost, lost);
        }
    }
}

/// Errors that have nothing to do with each other, together.
#[inline(always)]
fn root_of_squares([a, b, c, d]: [f64; 4]) -> f64 {
    ((a * a + b * b) + (c * c + d * d)).sqrt()
}

/// A positive number as one in [1, 2) times a power of two.
#[inline(always)]
fn split(value: f64) -> (f64, f64) {
    let bits = value.to_bits();
    let power = f64::from_bits(TWO_TO_52.to_bits() | (bits >> MANTISSA)) - (TWO_TO_52 + ONE as f64);
    let mantissa = bits & ((1 << MANTISSA) - 1) | (ONE << MANTISSA);
    (f64::from_bits(mantissa), power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_split_into_a_part_and_a_power_of_two() {
        assert_eq!(
            [1.0, 0.75, 6.0, 1e-300]
                .map(split)
                .map(|(part, power)| part * power.exp2()),
            [1.0, 0.75, 6.0, 1e-300]
        );
        assert_eq!(split(6.0), (1.5, 2.0));
    }
}
