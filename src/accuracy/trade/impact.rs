//! The task `impact`: the impact that follows one, by fixed step, by bracketing and by our own means.

use super::contest::{self, BITS, EVERY, Exact, Means, OF_THE_MACHINE, Task, worst_relative_error};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use crate::impact::{Kind, Simulation, Start};
use crate::model::{Flight, Forcing, Impact, Motion, Side, next_impact};
use crate::number::{Analytic, Digits, Machine, Rung, Sequence, at_digits};

/// Problems for each region: a fixed step needs thousands of evaluations for one.
const FEWER: usize = 4;

/// Draws for one point before a region is taken to be empty.
const MOST_DRAWS: usize = 1000;

/// The least velocity of arrival: closer to grazing is the business of `stress`.
const LEAST_ARRIVAL: f64 = 0.01;

/// The longest flight.
const LONGEST: f64 = 8.0;

/// An impact at the bottom, by numbers that f32 holds exactly.
struct Point {
    g: f64,
    d: f64,
    r: [f64; 2],
    phase: f64,
    velocity: f64,
}

impl Point {
    fn motion<T: Analytic>(&self) -> Option<Motion<T>> {
        let [g, d, r_b, r_t] = [self.g, self.d, self.r[0], self.r[1]].map(T::from_f64);
        Motion::new(g, d, r_b, r_t).ok()
    }

    /// Time and velocity of the next impact by our own means.
    fn by_simulation<T: Analytic>(&self) -> Option<[T; 2]> {
        let start = self.start();
        let event = Simulation::new(&self.motion()?, &start).nth(1)?;
        (event.kind == Kind::Impact).then(|| [event.time(&start.phase), event.velocity])
    }

    /// As tables have it.
    fn place(&self) -> String {
        let Self {
            g,
            d,
            r: [r_b, r_t],
            phase,
            velocity,
        } = self;
        format!("g={g};d={d};r_B={r_b};r_T={r_t};phase={phase};velocity={velocity}")
    }

    fn start<T: Analytic>(&self) -> Start<T> {
        Start {
            side: Side::Bottom,
            phase: T::from_f64(self.phase),
            velocity: T::from_f64(self.velocity),
        }
    }

    /// The start as flights and maps have it.
    fn impact<T: Analytic>(&self) -> Impact<T> {
        Impact {
            side: Side::Bottom,
            time: T::from_f64(self.phase) / T::pi(),
            velocity: T::from_f64(self.velocity),
        }
    }
}

/// Random motions of ordinary start, for other measurements.
pub fn starts(options: &TradeOptions, count: usize) -> Vec<(Motion<f64>, Start<f64>)> {
    let options = TradeOptions {
        points: count * FEWER,
        ..options.clone()
    };
    let points = points(REGIONS[0].1, &options).into_iter();
    let pairs = points.filter_map(|point| Some((point.motion()?, point.start())));
    pairs.collect()
}

/// How fast the ball starts.
const REGIONS: [(&str, [f64; 2]); 2] = [("impact/random", [0.1, 1.5]), ("impact/slow", [0.01, 0.1])];

fn points(speeds: [f64; 2], options: &TradeOptions) -> Vec<Point> {
    let mut sequence = Sequence::new(options.seed);
    let mut draw = || {
        let mut between = |low, high| f64::from(sequence.on_grid(BITS, low, high) as f32);
        let point = Point {
            g: between(-0.5, 0.9),
            d: between(0.1, 1.0),
            r: [between(0.2, 0.9), between(0.2, 0.9)],
            phase: between(0.0, 6.25),
            velocity: between(speeds[0], speeds[1]),
        };
        let ordinary = |[time, velocity]: &[f64; 2]| velocity.abs() > LEAST_ARRIVAL && *time < LONGEST;
        point.by_simulation().filter(ordinary).map(|_| point)
    };
    let points = std::iter::repeat_with(|| (0..MOST_DRAWS).find_map(|_| draw()));
    points.take(options.points / FEWER).map_while(|point| point).collect()
}

/// By our own means and by bracketing.
fn exact(point: &Point) -> Option<[Vec<Exact>; 2]> {
    at_digits(100, || {
        let own = point.by_simulation::<Digits>()?;
        let bracketed = Way::Bracketing.answer::<Digits>(point).ok()?;
        Some([own.to_vec(), bracketed].map(|answer| answer.iter().map(Machine::to_wide).collect()))
    })
}

#[derive(Clone, Copy)]
enum Way {
    /// The flight followed at every step of 2^-n until it is behind a wall, the impact between two steps by a straight
    /// line, as the paper's figures were made.
    FixedStep(i32, &'static str),
    /// [`next_impact`]: the crossing bracketed between the turning points, then Newton's method.
    Bracketing,
    /// [`Simulation`].
    Own,
}

impl Means<Point> for Way {
    fn name(&self) -> &'static str {
        match self {
            Self::FixedStep(_, name) => name,
            Self::Bracketing => "bracketing",
            Self::Own => "own",
        }
    }

    fn rungs(&self) -> &'static [Rung] {
        match self {
            // its error is that of the step, in any number
            Self::FixedStep(..) => OF_THE_MACHINE,
            _ => EVERY,
        }
    }

    fn answer<T: Machine>(&self, point: &Point) -> Result<Vec<T>, Unsolved> {
        if let Self::Own = self {
            let found = point.by_simulation();
            return found.map(|answer| answer.to_vec()).ok_or(Unsolved::NoConvergence);
        }
        let motion = point.motion::<T>().ok_or(Unsolved::LeftDomain)?;
        let (forcing, impact) = (Forcing::harmonic(&T::zero()), point.impact());
        match self {
            Self::FixedStep(exponent, _) => {
                let flight = Flight::after(&motion, &forcing, &impact).map_err(|_| Unsolved::LeftDomain)?;
                by_steps(&flight, 2_f64.powi(*exponent)).ok_or(Unsolved::NoConvergence)
            }
            _ => {
                let leg = next_impact(&motion, &forcing, &impact).map_err(|_| Unsolved::NoConvergence)?;
                Ok(vec![leg.duration, leg.to.velocity])
            }
        }
    }
}

/// Time and velocity where a flight is first found behind a wall. A wall touched and left within a step is missed.
fn by_steps<T: Machine>(flight: &Flight<T>, step: f64) -> Option<Vec<T>> {
    let [top, bottom] = [Side::Top, Side::Bottom].map(|side| flight.target(side));
    let step = <T as Analytic>::from_f64(step);
    let (mut time, mut before) = (T::zero(), T::zero());
    while time.to_f64() < 2.0 * LONGEST {
        let next = time.clone() + step.clone();
        let place = flight.state(&next).displacement;
        let wall = if place < top {
            Some(&top)
        } else if place > bottom {
            Some(&bottom)
        } else {
            None
        };
        if let Some(wall) = wall {
            let part = (wall.clone() - before.clone()) / (place - before);
            let time = time + part * step;
            let velocity = flight.state(&time).velocity;
            return Some(vec![time, velocity]);
        }
        (time, before) = (next, place);
    }
    None
}

/// The trade of task `impact`: the next one of a ball at the bottom that starts with an ordinary velocity, and with a
/// small one, at which it may come back to the same wall.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let means = [
        Way::FixedStep(-7, "fixed-step-2^-7"),
        Way::FixedStep(-10, "fixed-step-2^-10"),
        Way::FixedStep(-13, "fixed-step-2^-13"),
        Way::Bracketing,
        Way::Own,
    ];
    let mut rows = Vec::new();
    for (name, speeds) in REGIONS {
        let task = Task {
            name: name.to_owned(),
            points: &points(speeds, options),
            exact,
            error: worst_relative_error,
            miss: |_, _| Unsolved::FewDigits,
            place: Point::place,
        };
        rows.extend(contest::rows(&task, &means, options)?);
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::super::quantile;
    use super::*;

    #[test]
    fn a_fixed_step_gains_with_its_square_and_brackets_find_the_impact_to_rounding() {
        let options = TradeOptions {
            points: 80,
            seconds_per_row: 0.0,
            ..TradeOptions::default()
        };
        let rows = rows(&options).expect("a trade");
        let median = |method: &str, number: Rung| {
            let named = |row: &&TradeRow| row.task == "impact/random" && row.method == method && row.number == number;
            let row = rows.iter().find(named).expect("a row");
            // of all problems: those that a coarse step solves are the easy ones
            let digits = row.problems.iter().map(|outcome| outcome.digits.unwrap_or(0.0));
            quantile(&digits.collect::<Vec<_>>(), 0.5)
        };
        let gained = median("fixed-step-2^-13", Rung::Double) - median("fixed-step-2^-10", Rung::Double);
        assert!((gained - 6.0 * 2_f64.log10()).abs() < 0.3, "{gained}");
        for method in ["bracketing", "own"] {
            assert!(
                median(method, Rung::Double) > 14.0 && median(method, Rung::Wide(50)) > 57.0,
                "{method}"
            );
        }
    }
}
