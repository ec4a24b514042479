//! The events of a motion in numbers wide enough for the digits asked.

use super::event::{Event, Kind};
use super::simulation::Simulation;
use super::start::Origin;
use super::widening::Widening;
use crate::model::{MotionError, Parameters, Side};
use crate::number::{
    Analytic, Decimal, Decimals, Digits, DoubleDouble, Endpoint, FIGURES_OF_F64, Interval, Rung, Telling, at_digits,
};
use std::collections::VecDeque;

/// How much of a motion is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// At most so many impacts, the start counted.
    pub impacts: u64,
    /// Up to this time; infinite where only the impacts count.
    pub until: f64,
    /// Only the last so many events.
    pub last: usize,
    /// The digits that each of these is to have.
    pub digits: u32,
}

/// An event with what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<N> {
    /// Its number, from 1.
    pub event: u64,
    /// The time since the start.
    pub time: N,
    /// The phase of the forcing, rad, in [0, 2 pi).
    pub phase: N,
    /// The wall.
    pub side: Side,
    /// Zdot just before.
    pub velocity: N,
    /// What happens.
    pub kind: Kind,
    /// The digits that hold: relative of time and velocity, absolute of the phase; 0 where none does.
    pub digits: u32,
}

/// A motion, told.
#[derive(Clone, Debug, PartialEq)]
pub struct History<N> {
    /// The events asked for.
    pub rows: VecDeque<Row<N>>,
    /// The number that found them.
    pub computed_in: Rung,
    /// The first event of all of which no digit holds, although the widest number was tried: from here on rows tell
    /// what such a motion does, not what this one does.
    pub lost_at: Option<u64>,
    /// The Lyapunov exponent so far: the mean growth of the logarithm of a small error per unit of time; minus infinity
    /// once a rest has wiped errors out, NaN before time has passed.
    pub lyapunov: f64,
    /// Whether nothing follows the last row: the ball rests for ever, meets no wall any more, or is rested and released for
    /// ever without an impact that is listed.
    pub has_ended: bool,
}

/// The motion over `first` where that holds the digits asked, else over wider numbers up to 200 digits. What those lose
/// too is followed on in f64 as statistics: its rows have no digits.
///
/// `first` is the narrowest number that may do, f64 or wider: a wrong choice costs time and no digit.
///
/// # Errors
/// A parameter out of its range.
pub fn history(
    motion: &impl Parameters,
    origin: &impl Origin,
    extent: &Extent,
    first: Rung,
) -> Result<History<f64>, MotionError> {
    let asked = Asked { motion, origin, extent };
    let figures = FIGURES_OF_F64;
    let attempt = |rung| match rung {
        Rung::Single | Rung::Double => asked.attempt(figures, f64::clone),
        Rung::DoubleDouble => asked.attempt(figures, <DoubleDouble as Analytic>::to_f64),
        Rung::Wide(digits) => at_digits(digits, || asked.attempt(figures, <Digits as Analytic>::to_f64)),
    };
    asked.climb(first.max(Rung::Double), attempt, |value| value)
}

/// The same in decimals, over double-double or wider: of two figures more than asked, so that their rounding takes none
/// of those that hold.
///
/// # Errors
/// A parameter out of its range.
pub fn history_in_decimals(
    motion: &impl Parameters,
    origin: &impl Origin,
    extent: &Extent,
    decimals: Decimals,
    first: Rung,
) -> Result<History<Decimal>, MotionError> {
    fn tell<E: Endpoint>(decimals: Decimals) -> impl Fn(&E) -> Decimal
    where
        Decimals: Telling<E, Number = Decimal>,
    {
        move |value| decimals.tell(&Interval::point(value.clone()))
    }
    let asked = Asked { motion, origin, extent };
    let figures = u32::try_from(decimals.0).unwrap_or(u32::MAX);
    let more = Decimals(decimals.0 + 2);
    let attempt = |rung| match rung {
        Rung::Wide(digits) => at_digits(digits, || asked.attempt(figures, tell::<Digits>(more))),
        _ => asked.attempt(figures, tell::<DoubleDouble>(more)),
    };
    let few = Decimals(FIGURES_OF_F64 as usize);
    let tell_f64 = |value| at_digits(50, || tell::<Digits>(few)(&Analytic::from_f64(value)));
    asked.climb(first.max(Rung::DoubleDouble), attempt, tell_f64)
}

/// What an attempt in one number came to.
struct Attempt<N> {
    history: History<N>,
    /// The latest event that holds, and how much errors had grown by then; `None` where all do.
    before_loss: Option<(Event<f64>, f64)>,
    /// The contact that rounding hides, where that is why.
    undecided: Option<Event<f64>>,
    impacts: u64,
    events: u64,
    /// The time of the last event told.
    elapsed: f64,
}

impl<N> Attempt<N> {
    /// Whether every row has the digits asked.
    fn suffices(&self, extent: &Extent) -> bool {
        self.before_loss.is_none() && self.history.rows.iter().all(|row| row.digits >= extent.digits)
    }

    fn push(&mut self, row: Row<N>, extent: &Extent) {
        self.events = row.event;
        self.impacts += u64::from(row.kind == Kind::Impact);
        if self.history.rows.len() >= extent.last {
            self.history.rows.pop_front();
        }
        self.history.rows.push_back(row);
    }
}

/// A motion, and how much of it is asked for.
struct Asked<'a, P, O> {
    motion: &'a P,
    origin: &'a O,
    extent: &'a Extent,
}

impl<P: Parameters, O: Origin> Asked<'_, P, O> {
    /// The first attempt that suffices, from `first` on; else what the widest number has, followed on in f64.
    fn climb<N>(
        &self,
        first: Rung,
        attempt: impl Fn(Rung) -> Result<Attempt<N>, MotionError>,
        tell: impl Fn(f64) -> N,
    ) -> Result<History<N>, MotionError> {
        let mut rung = first;
        loop {
            let attempt = attempt(rung)?;
            if attempt.suffices(self.extent) {
                return Ok(attempt.history);
            }
            let Some(wider) = self.wider(rung, &attempt) else {
                return self.at_last(attempt, tell);
            };
            rung = wider;
        }
    }

    /// The next number to try: of the wider ones the narrowest that has the digits which `attempt` lacked, if errors go on
    /// growing as they did.
    fn wider<N>(&self, rung: Rung, attempt: &Attempt<N>) -> Option<Rung> {
        let extent = self.extent;
        let had = f64::from(rung.digits());
        let least = attempt.history.rows.iter().map(|row| row.digits).min();
        let needed = if attempt.before_loss.is_some() {
            let whole = (extent.impacts as f64).min(extent.until / attempt.elapsed * attempt.impacts as f64);
            had * whole / attempt.impacts.max(1) as f64
        } else {
            had + f64::from(extent.digits.saturating_sub(least.unwrap_or(0)))
        };
        let mut wider = rung.and_wider().skip(1);
        let widest = rung.and_wider().skip(1).last();
        wider.find(|rung| f64::from(rung.digits()) >= needed).or(widest)
    }

    /// The motion over `T`, as far as that number holds it; at most `figures` digits are told.
    fn attempt<T: Endpoint, N>(&self, figures: u32, tell: impl Fn(&T) -> N) -> Result<Attempt<N>, MotionError> {
        let extent = self.extent;
        let start = self.origin.start::<T>();
        // digits of a rest are relative to the time it comes at, which a slow start makes short
        let pace = start.velocity.to_f64().abs().clamp(f64::MIN_POSITIVE, 1.0);
        let pace = if start.velocity.is_zero() { 1.0 } else { pace };
        let completing = pace * 10_f64.powi(-(figures.max(extent.digits) as i32) - 2);
        let simulation = Simulation::new(&self.motion.motion::<T>()?, &start).with_growth();
        let mut simulation = simulation.completing_to(completing);
        let mut attempt = Attempt {
            history: History {
                rows: VecDeque::new(),
                computed_in: T::rung(),
                lost_at: None,
                lyapunov: f64::NAN,
                has_ended: false,
            },
            before_loss: None,
            undecided: None,
            impacts: 0,
            events: 0,
            elapsed: 0.0,
        };
        let mut before: Option<(Event<f64>, f64)> = None;
        while attempt.impacts < extent.impacts {
            let Some(event) = simulation.next() else {
                attempt.history.has_ended = true;
                break;
            };
            let time = event.time(&start.phase);
            let elapsed = time.to_f64();
            if elapsed > extent.until {
                break;
            }
            let growth = simulation.tracked();
            if !growth.holds() {
                attempt.history.lost_at = Some(attempt.events + 1);
                attempt.before_loss = before;
                attempt.undecided = (event.kind == Kind::Undecided).then_some(event.convert(T::to_f64));
                break;
            }
            let row = Row {
                event: attempt.events + 1,
                time: tell(&time),
                phase: tell(&event.phase),
                side: event.side,
                velocity: tell(&event.velocity),
                kind: event.kind,
                digits: growth.digits_at(elapsed, event.velocity.to_f64()).min(figures),
            };
            attempt.elapsed = elapsed;
            attempt.push(row, extent);
            attempt.history.lyapunov = growth.stretch() / elapsed;
            if simulation.is_idle() && extent.until.is_infinite() {
                attempt.history.has_ended = true;
                break;
            }
            before = Some((event.convert(T::to_f64), growth.stretch()));
        }
        Ok(attempt)
    }

    /// The attempt in the widest number, followed on in f64 where that lost the motion.
    fn at_last<N>(&self, attempt: Attempt<N>, tell: impl Fn(f64) -> N) -> Result<History<N>, MotionError> {
        let mut attempt = attempt;
        let Some((before, grown)) = attempt.before_loss.take() else {
            return Ok(attempt.history);
        };
        let start = self.origin.start::<f64>();
        let extent = self.extent;
        let row = |event: &Event<f64>, number: u64| Row {
            event: number,
            time: tell(event.time(&start.phase)),
            phase: tell(event.phase),
            side: event.side,
            velocity: tell(event.velocity),
            kind: event.kind,
            digits: 0,
        };
        if let Some(event) = attempt.undecided.take() {
            attempt.push(row(&event, attempt.events + 1), extent);
            attempt.history.has_ended = true;
            return Ok(attempt.history);
        }
        let mut widening = Widening::after(&self.motion.motion::<f64>()?, &before);
        while attempt.impacts < extent.impacts {
            let Some(event) = widening.next() else {
                attempt.history.has_ended = true;
                break;
            };
            let elapsed = event.time(&start.phase);
            if elapsed > extent.until {
                break;
            }
            attempt.push(row(&event, attempt.events + 1), extent);
            attempt.history.lyapunov = (grown + widening.growth().stretch()) / elapsed;
            if widening.is_idle() && extent.until.is_infinite() {
                attempt.history.has_ended = true;
                break;
            }
        }
        Ok(attempt.history)
    }
}
