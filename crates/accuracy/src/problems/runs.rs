//! One flight, many, and what ends in rest: by pieces of flights, confirmed by bracketed ones.

use super::problem::{Begin, Given, Problem};
use super::values::{Number, Values, number, read, reduced};
use super::{Means, Why};
use dynamics::impact::{Extent, History, Kind, Origin, Simulation, Start, history, history_in_decimals};
use dynamics::model::{Flight, Forcing, Impact, Parameters, Side, Watch, next_impact};
use numbers::{Analytic, Decimal, FIGURES_OF_F64, Field, Rung, Wide};

/// The figures in which the first means is told, of which all must hold.
const FIGURES: usize = 40;

/// What the answers of impacts and runs rest on.
pub const MEANS: [&str; 2] = ["flights by pieces", "bracketed flights in 100 digits"];

/// What the answers of motions to a rest rest on.
pub const MEANS_TO_REST: [&str; 2] = [
    "chatter completed in closed form",
    "impacts of the chatter in 60 digits",
];

/// The impacts before a first rest, at most.
const MOST_BEFORE_REST: usize = 10_000;

/// The quantities by both means.
pub fn both(problem: &Problem) -> Result<[Values<Number>; 2], Why> {
    let (given, begin) = (problem.given()?, problem.begin()?);
    let (extent, last) = extent(problem, &given, &begin, FIGURES as u32)?;
    let history = history_in_decimals(&given, &begin, &extent, last, Rung::Wide(50))?;
    let first = told(problem, &history, FIGURES as u32)?.convert(|decimal: Decimal| read(&decimal));
    let again = match problem.impacts {
        Some(impacts) => bracketed::<100>(&given, &begin, impacts)?,
        None => rested::<60>(&given, &begin)?,
    };
    Ok([first, again])
}

/// The quantities in f64.
pub fn solved(problem: &Problem, means: Means) -> Result<Values<f64>, Why> {
    let (given, begin) = (problem.given()?, problem.begin()?);
    match means {
        Means::Default => {
            let (extent, last) = extent(problem, &given, &begin, FIGURES_OF_F64)?;
            let history = history(&given, &begin, &extent, last, Rung::Double)?;
            told(problem, &history, 0)
        }
        Means::Double => {
            let (events, _) = plain(problem, &given, &begin)?;
            values(
                problem,
                &events
                    .iter()
                    .map(|(kind, told)| (*kind, told.each_ref()))
                    .collect::<Vec<_>>(),
            )
        }
    }
}

/// As far as the problem asks, and the last events that it needs: up to the impact, or to the one that follows a first rest.
fn extent(problem: &Problem, given: &Given, begin: &Begin, digits: u32) -> Result<(Extent, usize), Why> {
    let (impacts, last) = match problem.impacts {
        // the start is an impact too
        Some(impacts) => (u64::from(impacts) + 1, 1),
        None => (plain(problem, given, begin)?.1, usize::MAX),
    };
    let until = f64::INFINITY;
    let extent = Extent {
        impacts,
        until,
        digits,
        proved: false,
    };
    Ok((extent, last))
}

/// An event: what, and its time, phase and velocity.
type Told<N> = (Kind, [N; 3]);

/// What the events of a history say, if each holds so many digits.
fn told<N: Clone>(problem: &Problem, history: &History<N>, digits: u32) -> Result<Values<N>, Why> {
    let last = history.rows.back().ok_or(Why::NoRest)?;
    // a motion that rested on the way has more events than impacts
    let wanted = problem.impacts.map(|impacts| u64::from(impacts) + 1);
    if wanted.is_some_and(|wanted| last.event != wanted) {
        return Err(Why::NoRest);
    }
    if last.digits < digits {
        return Err(Why::Lost(last.digits));
    }
    let rows = history.rows.iter();
    let events: Vec<Told<&N>> = rows
        .map(|row| (row.kind, [&row.time, &row.phase, &row.velocity]))
        .collect();
    values(problem, &events)
}

/// What the events say: of the last, or of a first rest and what follows.
fn values<N: Clone>(problem: &Problem, events: &[Told<&N>]) -> Result<Values<N>, Why> {
    if problem.impacts.is_some() {
        let (kind, [time, phase, velocity]) = *events.last().ok_or(Why::NoRest)?;
        if kind != Kind::Impact {
            return Err(Why::NoRest);
        }
        let each = [("time", time), ("phase", phase), ("velocity", velocity)];
        return Ok(Values::new(each.map(|(name, value)| (name, value.clone()))));
    }
    let landing = events
        .windows(3)
        .position(|three| is_landing(three.iter().map(|event| event.0)));
    let landing = landing.ok_or(Why::NoRest)? + 2;
    let [rest, release, landing] = [landing - 2, landing - 1, landing].map(|index| events[index].1);
    Ok(Values::new([
        ("rest_time", rest[0].clone()),
        ("release_time", release[0].clone()),
        ("landing_time", landing[0].clone()),
        ("landing_velocity", landing[2].clone()),
    ]))
}

/// Whether these are a rest, its release and the impact that follows.
fn is_landing(kinds: impl Iterator<Item = Kind>) -> bool {
    kinds.eq([Kind::Rest, Kind::Release, Kind::Impact])
}

/// The events in f64, whatever is lost on the way, and how many of them are impacts.
fn plain(problem: &Problem, given: &Given, begin: &Begin) -> Result<(Vec<Told<f64>>, u64), Why> {
    let (motion, start) = (given.motion()?, begin.start());
    let most = problem.impacts.map_or(MOST_BEFORE_REST, |impacts| impacts as usize + 1);
    let (mut events, mut impacts) = (Vec::<Told<f64>>::new(), 0);
    for event in Simulation::new(&motion, &start) {
        events.push((event.kind, [event.time(&start.phase), event.phase, event.velocity]));
        impacts += usize::from(event.kind == Kind::Impact);
        let lately = &events[events.len().saturating_sub(3)..];
        let has_landed = problem.impacts.is_none() && is_landing(lately.iter().map(|event| event.0));
        if has_landed || impacts == most {
            break;
        }
    }
    Ok((events, impacts as u64))
}

/// The start at time 0, under the forcing cos(pi t + phase).
fn departure<T: Analytic>(begin: &Begin) -> (Forcing<T>, Impact<T>) {
    let Start {
        side, phase, velocity, ..
    } = begin.start::<T>();
    let time = T::zero();
    (Forcing::harmonic(&phase), Impact { side, time, velocity })
}

/// Impact after impact by brackets.
fn bracketed<const DIGITS: usize>(given: &Given, begin: &Begin, impacts: u32) -> Result<Values<Number>, Why> {
    let motion = given.motion::<Wide<DIGITS>>()?;
    let (forcing, mut impact) = departure::<Wide<DIGITS>>(begin);
    let mut time = impact.time.clone();
    for _ in 0..impacts {
        let leg = next_impact(&motion, &forcing, &impact)?;
        time += leg.duration;
        impact = leg.to;
    }
    let phase = begin.start::<Wide<DIGITS>>().phase + time.clone() * Wide::pi();
    let each = [
        ("time", time),
        ("phase", reduced(&phase)),
        ("velocity", impact.velocity),
    ];
    Ok(Values::new(each).convert(number))
}

/// Impacts slower than this are not followed: what is left of the chatter is that under a constant acceleration, up to
/// the square of the velocity.
const SLOWEST: f64 = 1e-20;

/// Impact after impact of the chatter, the release, and the flight after it.
fn rested<const DIGITS: usize>(given: &Given, begin: &Begin) -> Result<Values<Number>, Why> {
    let motion = given.motion::<Wide<DIGITS>>()?;
    let (forcing, mut impact) = departure::<Wide<DIGITS>>(begin);
    let mut time = impact.time.clone();
    let mut left = MOST_BEFORE_REST;
    while impact.velocity.to_f64().abs() > SLOWEST {
        left = left.checked_sub(1).ok_or(Why::NoRest)?;
        let leg = next_impact(&motion, &forcing, &impact)?;
        time += leg.duration;
        impact = leg.to;
    }
    let (one, two) = (Wide::from_integer(1), Wide::from_integer(2));
    let side = impact.side;
    let r = motion.restitution(side).clone();
    let pressing = forcing.at(&time).f + motion.g().clone();
    let rest = time + two.clone() * r.clone() * impact.velocity / (pressing * (one - r));

    // cos = -g, falling where the bottom lets go and rising where the top does
    let angle = (-motion.g().clone()).acos();
    let phase = if side == Side::Bottom { angle } else { -angle };
    let first = (phase - begin.start::<Wide<DIGITS>>().phase) / Wide::pi();
    let turns = ((rest.clone() - first.clone()) / two.clone()).to_f64().ceil();
    let release = first + two * Wide::from_f64(turns);
    let launch = Wide::from_integer(0);
    let flight = Flight::launched(&motion, &forcing, side, &release, launch)?;
    let duration = flight.crossing(Watch::Both)?.duration;
    let velocity = flight.state(&duration).velocity;
    Ok(Values::new([
        ("rest_time", rest),
        ("release_time", release.clone()),
        ("landing_time", release + duration),
        ("landing_velocity", velocity),
    ])
    .convert(number))
}
