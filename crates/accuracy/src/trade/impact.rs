//! The task `impact`: the impact that follows one, by fixed step, by bracketing and by our own means.

use super::contest::{self, BITS, EVERY, Exact, Means, OF_THE_MACHINE, RIGHT, Task, worst_relative_error};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use dynamics::impact::{Enclosure, Kind, Simulation, Start};
use dynamics::model::{Flight, Forcing, Impact, Motion, Side, next_impact};
use numbers::{Analytic, Digits, Interval, Machine, Rung, Sequence, at_digits};

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

    /// The middles of what they are proved to lie in.
    fn by_enclosure<T: Machine>(&self) -> Option<[T; 2]> {
        let start: Start<Interval<T>> = self.start();
        let event = Enclosure::new(&self.motion()?, &start).nth(1)?;
        let middle = |value: Interval<T>| value.midpoint();
        (event.kind == Kind::Impact).then(|| [event.time(&start.phase), event.velocity].map(middle))
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
        Start::impact(Side::Bottom, T::from_f64(self.phase), T::from_f64(self.velocity))
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
    FixedStep(i32),
    /// The first step of [`SCANNED`] across a wall, halved until it is no longer than 10^-n.
    Bisection(i32),
    /// Adaptive integration to a tolerance of 10^-n.
    Integration(i32),
    /// [`next_impact`]: the crossing bracketed between the turning points, then Newton's method.
    Bracketing,
    /// [`Simulation`].
    Own,
    /// [`Enclosure`]: the answer is proved to be within its bound.
    Enclosure,
}

/// Fixed steps, as powers of 2.
const STEPS: [i32; 7] = [-3, -5, -7, -9, -11, -13, -15];

/// Widths of bisection, as powers of 1/10.
const WIDTHS: [i32; 8] = [3, 4, 6, 9, 12, 15, 20, 30];

/// Tolerances of adaptive integration, as powers of 1/10.
const TOLERANCES: [i32; 7] = [2, 4, 6, 8, 10, 12, 14];

impl Means<Point> for Way {
    fn name(&self) -> &'static str {
        match self {
            Self::FixedStep(_) => "fixed-step",
            Self::Bisection(_) => "bisection",
            Self::Integration(_) => "dop853",
            Self::Bracketing => "bracketing",
            Self::Own => "own",
            Self::Enclosure => "enclosure",
        }
    }

    fn setting(&self) -> String {
        match self {
            Self::FixedStep(exponent) => format!("step=2^{exponent}"),
            Self::Bisection(zeros) => format!("width=1e-{zeros}"),
            Self::Integration(zeros) => format!("tol=1e-{zeros}"),
            _ => String::new(),
        }
    }

    fn is_proved(&self) -> bool {
        matches!(self, Self::Enclosure)
    }

    fn rungs(&self) -> &'static [Rung] {
        match self {
            // its error is that of the step, in any number
            Self::FixedStep(_) => OF_THE_MACHINE,
            Self::Integration(_) => &[Rung::Double],
            // no narrower than a rounding of the time
            Self::Bisection(..=6) => &EVERY[..3],
            Self::Bisection(..=15) => &EVERY[1..3],
            Self::Bisection(_) => &EVERY[2..3],
            _ => EVERY,
        }
    }

    fn answer<T: Machine>(&self, point: &Point) -> Result<Vec<T>, Unsolved> {
        let own = match self {
            Self::Own => Some(point.by_simulation()),
            Self::Enclosure => Some(point.by_enclosure()),
            _ => None,
        };
        if let Some(found) = own {
            return found.map(|answer| answer.to_vec()).ok_or(Unsolved::Undecided);
        }
        let motion = point.motion::<T>().ok_or(Unsolved::LeftDomain)?;
        let (forcing, impact) = (Forcing::harmonic(&T::zero()), point.impact());
        let flight = || Flight::after(&motion, &forcing, &impact).map_err(|_| Unsolved::LeftDomain);
        let found = match self {
            Self::FixedStep(exponent) => by_steps(&flight()?, 2_f64.powi(*exponent)),
            Self::Bisection(zeros) => by_bisection(&flight()?, 0.1_f64.powi(*zeros)),
            Self::Integration(zeros) => {
                let phase = <T as Analytic>::from_f64(point.phase);
                let given = [motion.g(), &phase];
                super::integration::by_integration(&flight()?, given, 2.0 * LONGEST, 0.1_f64.powi(*zeros))
            }
            _ => {
                let leg = next_impact(&motion, &forcing, &impact).ok();
                leg.map(|leg| vec![leg.duration, leg.to.velocity])
            }
        };
        found.ok_or(Unsolved::NoConvergence)
    }
}

/// A step of a flight across a wall: when it begins, the places at both its ends, the wall.
struct Crossing<T> {
    time: T,
    places: [T; 2],
    wall: T,
}

/// The first step after which a flight is behind a wall. A wall touched and left within a step is missed.
fn crossing<T: Machine>(flight: &Flight<T>, step: &T) -> Option<Crossing<T>> {
    let [top, bottom] = [Side::Top, Side::Bottom].map(|side| flight.target(side));
    let (mut time, mut before) = (T::zero(), T::zero());
    while time.to_f64() < 2.0 * LONGEST {
        let next = time.clone() + step.clone();
        let place = flight.state(&next).displacement;
        if place < top || place > bottom {
            let wall = if place < top { top } else { bottom };
            let places = [before, place];
            return Some(Crossing { time, places, wall });
        }
        (time, before) = (next, place);
    }
    None
}

/// Time and velocity where the straight line over the step meets the wall.
fn by_steps<T: Machine>(flight: &Flight<T>, step: f64) -> Option<Vec<T>> {
    let step = <T as Analytic>::from_f64(step);
    let Crossing { time, places, wall } = crossing(flight, &step)?;
    let [before, place] = places;
    let part = (wall - before.clone()) / (place - before);
    let time = time + part * step;
    let velocity = flight.state(&time).velocity;
    Some(vec![time, velocity])
}

/// The step with which a crossing is looked for before it is bisected.
const SCANNED: f64 = 1.0 / 64.0;

/// Time and velocity in the middle of what is left of the step when it has been halved down to `width`.
fn by_bisection<T: Machine>(flight: &Flight<T>, width: f64) -> Option<Vec<T>> {
    let mut step = <T as Analytic>::from_f64(SCANNED);
    let Crossing { mut time, wall, .. } = crossing(flight, &step)?;
    let is_top = wall < T::zero();
    let half = T::from_ratio(1, 2);
    while step.to_f64() > width {
        step *= half.clone();
        let middle = time.clone() + step.clone();
        let place = flight.state(&middle).displacement;
        let is_behind = if is_top { place < wall } else { place > wall };
        if !is_behind {
            time = middle;
        }
    }
    let time = time + step * half;
    let velocity = flight.state(&time).velocity;
    Some(vec![time, velocity])
}

/// The trade of task `impact`: the next one of a ball at the bottom that starts with an ordinary velocity, and with a
/// small one, at which it may come back to the same wall.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut means: Vec<Way> = STEPS.map(Way::FixedStep).to_vec();
    means.extend(WIDTHS.map(Way::Bisection));
    means.extend(TOLERANCES.map(Way::Integration));
    means.extend([Way::Bracketing, Way::Own, Way::Enclosure]);
    let mut rows = Vec::new();
    for (name, speeds) in REGIONS {
        let task = Task {
            name: name.to_owned(),
            points: &points(speeds, options),
            error: worst_relative_error,
            miss: |_, _| Unsolved::FewDigits,
            place: Point::place,
            right: RIGHT,
        };
        rows.extend(contest::rows(&task, exact, &means, options)?);
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
            let is_named = |row: &TradeRow| row.method == method || row.setting == method;
            let named = |row: &&TradeRow| row.task == "impact/random" && is_named(row) && row.number == number;
            let row = rows.iter().find(named).expect("a row");
            // of all problems: those that a coarse step solves are the easy ones
            let digits = row.problems.iter().map(|outcome| outcome.digits.unwrap_or(0.0));
            quantile(&digits.collect::<Vec<_>>(), 0.5)
        };
        let gained = median("step=2^-13", Rung::Double) - median("step=2^-9", Rung::Double);
        assert!((gained - 8.0 * 2_f64.log10()).abs() < 0.3, "{gained}");
        let gained = median("width=1e-12", Rung::Double) - median("width=1e-6", Rung::Double);
        assert!((gained - 6.0).abs() < 0.5, "{gained}");
        for method in ["bracketing", "own"] {
            assert!(
                median(method, Rung::Double) > 14.0 && median(method, Rung::Wide(50)) > 57.0,
                "{method}"
            );
        }
    }
}
