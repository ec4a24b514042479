//! The points at which means are compared: the same ones on every machine.

use super::contest::BITS;
use numbers::Sequence;

/// Where the points lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Region {
    /// Anywhere in the range of the paper's parameters and beyond, arrivals faster than 1/20.
    Random,
    /// The flight from the bottom arrives at the top with a speed between 1e-4 and 1e-2.
    Grazing,
}

impl Region {
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Grazing => "grazing",
        }
    }
}

/// A pair of flights that closes in phase: T_1 + T_2 = 2. Every number is one that f32 holds exactly, and so is
/// T_2 = 2 - T_1, so all numbers are asked about the very same point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub g: f64,
    pub r_b: f64,
    pub r_t: f64,
    pub time: f64,
    pub velocity: f64,
    pub durations: [f64; 2],
}

impl Point {
    /// As tables have it.
    pub fn place(&self) -> String {
        let Self {
            g,
            r_b,
            r_t,
            time,
            velocity,
            durations: [first, _],
        } = self;
        format!("g={g};r_B={r_b};r_T={r_t};t_k={time};velocity={velocity};T_1={first}")
    }
}

/// Beyond this many rejected draws for one point the region is taken to be empty.
const MOST_DRAWS: usize = 10_000;

/// `count` points of a region, or as many as were found.
pub(super) fn points(region: Region, count: usize, seed: u64) -> Vec<Point> {
    let mut sequence = Sequence::new(seed);
    let draws = || (0..MOST_DRAWS).find_map(|_| draw(region, &mut sequence));
    std::iter::repeat_with(draws)
        .take(count)
        .map_while(|point| point)
        .collect()
}

fn draw(region: Region, sequence: &mut Sequence) -> Option<Point> {
    let narrow = |value: f64| f64::from(value as f32);
    let g = narrow(sequence.on_grid(BITS, -0.5, 0.9));
    let [r_b, r_t] = [0, 1].map(|_| narrow(sequence.on_grid(BITS, 0.2, 0.9)));
    let time = sequence.on_grid(BITS, 0.0, 2.0);
    let first = sequence.on_grid(BITS, 0.0, 2.0);
    if !(0.3..=1.7).contains(&first) {
        return None;
    }
    // F_1 of the paper's forcing
    let integral = |time: f64| (std::f64::consts::PI * time).sin() / std::f64::consts::PI;
    let gained = integral(time + first) - integral(time);
    let speed = match region {
        Region::Random => sequence.on_grid(BITS, 0.05, 1.5),
        Region::Grazing => 10.0_f64.powf(sequence.on_grid(BITS, -4.0, -2.0)),
    };
    // (9) solved for Zdot_k, then (11)
    let velocity = narrow((g * first + gained + speed) / r_b);
    let last = r_t * speed + g * (2.0 - first) - gained;
    let inside = (0.05..3.0).contains(&velocity) && last > 0.05;
    inside.then_some(Point {
        g,
        r_b,
        r_t,
        time,
        velocity,
        durations: [first, 2.0 - first],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_held_exactly_by_f32_and_closes_in_phase() {
        for region in [Region::Random, Region::Grazing] {
            let points = points(region, 300, 1);
            assert_eq!(points.len(), 300);
            for Point {
                g,
                r_b,
                r_t,
                time,
                velocity,
                durations: [first, second],
            } in points
            {
                for value in [g, r_b, r_t, time, velocity, first, second] {
                    assert_eq!(f64::from(value as f32), value);
                }
                assert_eq!(first + second, 2.0);
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_points_and_another_gives_others() {
        assert_eq!(points(Region::Random, 10, 1), points(Region::Random, 10, 1));
        assert_ne!(points(Region::Random, 10, 1), points(Region::Random, 10, 2));
    }
}
