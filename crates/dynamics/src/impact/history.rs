//! The events of a motion in numbers wide enough for the digits asked.

use super::enclosure::Enclosure;
use super::event::{Event, Kind};
use super::growth::digits_of;
use super::simulation::Simulation;
use super::start::Origin;
use super::widening::Widening;
use crate::model::{MotionError, Parameters, Side};
use numbers::{
    Analytic, Decimal, Decimals, Digits, DoubleDouble, Doubles, Endpoint, FIGURES_OF_F64, Field, Interval, Rung,
    Telling, Told as Number, at_digits,
};
use std::collections::VecDeque;
use stop;

/// How much of a motion is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// At most so many impacts, the start counted.
    pub impacts: u64,
    /// Up to this time; infinite where only the impacts count.
    pub until: f64,
    /// The digits that each event is to have.
    pub digits: u32,
    /// Whether every event is to be proved: the rows end where that can no longer be.
    pub proved: bool,
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
    /// The number that found it.
    pub number: Rung,
    /// Upper bounds of how far time, phase and velocity are from the exact ones, where the event is proved.
    pub bounds: Option<[N; 3]>,
}

/// What is known of a motion at its latest row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The widest number that was needed.
    pub number: Rung,
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

/// A motion, told.
#[derive(Clone, Debug, PartialEq)]
pub struct History<N> {
    /// The events asked for, or the last of them.
    pub rows: VecDeque<Row<N>>,
    /// What is known at the last of them.
    pub known: Known,
}

/// What one number says of an event.
struct Told<N> {
    row: Row<N>,
    event: Event<f64>,
    elapsed: f64,
    /// Whether any digit holds.
    holds: bool,
    /// The logarithm of how much errors have grown.
    stretch: f64,
    is_idle: bool,
}

/// The events in one number.
type Source<N> = Box<dyn FnMut() -> Option<Told<N>>>;

/// Begins a motion anew in a number.
type Open<P, O, N> = fn(&P, &O, &Extent, Rung) -> Result<Source<N>, MotionError>;

/// The rows of a motion, one after the other, in memory that does not grow with their number.
///
/// A number is taken as long as its rows have the digits asked; the next wider one then begins anew and goes on from
/// there, up to 200 digits. What those lose too is followed on in f64 as statistics: its rows have no digits.
pub struct Rows<P, O, N> {
    parameters: P,
    origin: O,
    extent: Extent,
    open: Open<P, O, N>,
    tell: fn(f64) -> N,
    source: Source<N>,
    /// The latest row of the present number that held, and how much errors had grown.
    before: Option<(Event<f64>, f64)>,
    /// What follows what every number lost, with the growth up to there.
    further: Option<(Widening, f64)>,
    /// The events and impacts that are told, and the time of the last.
    events: u64,
    impacts: u64,
    elapsed: f64,
    is_over: bool,
    known: Known,
}

/// The motion over `first` where that holds the digits asked, else over wider numbers.
///
/// `first` is the narrowest number that may do, f64 or wider: a wrong choice costs time and no digit.
///
/// # Errors
/// A parameter out of its range.
pub fn rows<P: Parameters, O: Origin>(
    parameters: P,
    origin: O,
    extent: &Extent,
    first: Rung,
) -> Result<Rows<P, O, f64>, MotionError> {
    const FIGURES: u32 = FIGURES_OF_F64;
    Rows::new(
        parameters,
        origin,
        extent,
        |parameters, origin, extent, rung| match rung {
            Rung::Single | Rung::Double => opened::<f64, _>(parameters, origin, extent, FIGURES, Doubles),
            Rung::DoubleDouble => opened::<DoubleDouble, _>(parameters, origin, extent, FIGURES, Doubles),
            Rung::Wide(digits) => wide(digits, || {
                opened::<Digits, _>(parameters, origin, extent, FIGURES, Doubles)
            }),
        },
        |value| value,
        first.max(Rung::Double),
    )
}

/// The same in decimals of as many digits as are asked, over double-double or wider: of two figures more than that, so that
/// their rounding takes none of those that hold.
///
/// # Errors
/// A parameter out of its range.
pub fn rows_in_decimals<P: Parameters, O: Origin>(
    parameters: P,
    origin: O,
    extent: &Extent,
    first: Rung,
) -> Result<Rows<P, O, Decimal>, MotionError> {
    Rows::new(
        parameters,
        origin,
        extent,
        |parameters, origin, extent, rung| {
            let more = Decimals(extent.digits as usize + 2);
            match rung {
                Rung::Wide(digits) => wide(digits, || {
                    opened::<Digits, _>(parameters, origin, extent, extent.digits, more)
                }),
                _ => opened::<DoubleDouble, _>(parameters, origin, extent, extent.digits, more),
            }
        },
        |value| {
            let few = Decimals(FIGURES_OF_F64 as usize);
            at_digits(50, || few.tell(&Interval::<Digits>::from_f64(value)))
        },
        first.max(Rung::DoubleDouble),
    )
}

/// All of [`rows`] at once, or the last so many.
///
/// # Errors
/// A parameter out of its range.
pub fn history(
    parameters: &impl Parameters,
    origin: &impl Origin,
    extent: &Extent,
    last: usize,
    first: Rung,
) -> Result<History<f64>, MotionError> {
    rows(parameters, origin, extent, first)?.last(last)
}

/// All of [`rows_in_decimals`] at once, or the last so many.
///
/// # Errors
/// A parameter out of its range.
pub fn history_in_decimals(
    parameters: &impl Parameters,
    origin: &impl Origin,
    extent: &Extent,
    last: usize,
    first: Rung,
) -> Result<History<Decimal>, MotionError> {
    rows_in_decimals(parameters, origin, extent, first)?.last(last)
}

impl<P: Parameters, O: Origin, N: Number> Rows<P, O, N> {
    fn new(
        parameters: P,
        origin: O,
        extent: &Extent,
        open: Open<P, O, N>,
        tell: fn(f64) -> N,
        first: Rung,
    ) -> Result<Self, MotionError> {
        Ok(Self {
            source: open(&parameters, &origin, extent, first)?,
            parameters,
            origin,
            extent: *extent,
            open,
            tell,
            before: None,
            further: None,
            events: 0,
            impacts: 0,
            elapsed: 0.0,
            is_over: false,
            known: Known {
                number: first,
                lost_at: None,
                lyapunov: f64::NAN,
                has_ended: false,
            },
        })
    }

    /// What is known at the latest row.
    pub fn known(&self) -> &Known {
        &self.known
    }

    /// The last so many rows, or all there are.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn last(mut self, count: usize) -> Result<History<N>, MotionError> {
        let mut rows = VecDeque::new();
        for row in self.by_ref() {
            if rows.len() >= count {
                rows.pop_front();
            }
            rows.push_back(row?);
        }
        Ok(History {
            rows,
            known: self.known,
        })
    }

    /// The next row of the present number or of a wider one; what every number loses is followed on.
    fn told(&mut self) -> Result<Option<Row<N>>, MotionError> {
        loop {
            let told = (self.source)();
            // what was stopped on its way has told nothing
            if !stop::goes_on() {
                return Ok(None);
            }
            let Some(told) = told else {
                self.known.has_ended = true;
                return Ok(None);
            };
            if told.row.event <= self.events {
                self.before = Some((told.event, told.stretch));
                continue;
            }
            if told.elapsed > self.extent.until {
                return Ok(None);
            }
            if !told.holds || told.row.digits < self.extent.digits {
                if let Some(wider) = self.wider(&told) {
                    self.source = (self.open)(&self.parameters, &self.origin, &self.extent, wider)?;
                    (self.known.number, self.before) = (wider, None);
                    continue;
                }
                if !told.holds {
                    return self.lose(&told);
                }
            }
            self.known.lyapunov = told.stretch / told.elapsed;
            self.known.has_ended = told.is_idle && self.extent.until.is_infinite();
            self.before = Some((told.event, told.stretch));
            self.elapsed = told.elapsed;
            return Ok(Some(told.row));
        }
    }

    /// The next number to try: of the wider ones the narrowest that has the digits which are lacking, if errors go on
    /// growing as they did.
    fn wider(&self, told: &Told<N>) -> Option<Rung> {
        let rung = self.known.number;
        let had = f64::from(rung.digits());
        let needed = if told.holds {
            had + f64::from(self.extent.digits - told.row.digits)
        } else {
            let by_time = self.extent.until / self.elapsed * self.impacts as f64;
            let whole = by_time.min(self.extent.impacts as f64);
            had * whole / self.impacts.max(1) as f64
        };
        let mut wider = rung.and_wider().skip(1);
        let widest = rung.and_wider().skip(1).last();
        wider.find(|rung| f64::from(rung.digits()) >= needed).or(widest)
    }

    /// Goes on in f64 from the last row that held.
    fn lose(&mut self, told: &Told<N>) -> Result<Option<Row<N>>, MotionError> {
        self.known.lost_at = Some(self.events + 1);
        let Some((before, grown)) = self.before.take() else {
            return Ok(None);
        };
        if told.event.kind == Kind::Undecided {
            self.known.has_ended = true;
            return Ok(Some(self.without_digits(&told.event)));
        }
        let motion = self.parameters.motion::<f64>()?;
        self.further = Some((Widening::after(&motion, &before), grown));
        Ok(self.followed())
    }

    /// The next row of what no number holds.
    fn followed(&mut self) -> Option<Row<N>> {
        if !stop::goes_on() {
            return None;
        }
        let (widening, grown) = self.further.as_mut()?;
        let Some(event) = widening.next() else {
            self.known.has_ended = true;
            return None;
        };
        let elapsed = event.time(&self.origin.start::<f64>().phase);
        if elapsed > self.extent.until {
            return None;
        }
        self.known.lyapunov = (*grown + widening.growth().stretch()) / elapsed;
        self.known.has_ended = widening.is_idle() && self.extent.until.is_infinite();
        Some(self.without_digits(&event))
    }

    fn without_digits(&self, event: &Event<f64>) -> Row<N> {
        let tell = self.tell;
        Row {
            event: self.events + 1,
            time: tell(event.time(&self.origin.start::<f64>().phase)),
            phase: tell(event.phase),
            side: event.side,
            velocity: tell(event.velocity),
            kind: event.kind,
            digits: 0,
            number: Rung::Double,
            bounds: self.extent.proved.then(|| std::array::from_fn(|_| N::infinite())),
        }
    }
}

impl<P: Parameters, O: Origin, N: Number> Iterator for Rows<P, O, N> {
    type Item = Result<Row<N>, MotionError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over || self.impacts >= self.extent.impacts {
            return None;
        }
        let row = if self.further.is_some() {
            Ok(self.followed())
        } else {
            self.told()
        };
        self.is_over = self.known.has_ended || !matches!(row, Ok(Some(_)));
        if let Ok(Some(row)) = &row {
            self.events = row.event;
            self.impacts += u64::from(row.kind == Kind::Impact);
        }
        row.transpose()
    }
}

/// The events over `T`; at most `figures` digits are told.
fn opened<T: Endpoint, N: Telling<T> + 'static>(
    parameters: &impl Parameters,
    origin: &impl Origin,
    extent: &Extent,
    figures: u32,
    telling: N,
) -> Result<Source<N::Number>, MotionError> {
    let start = origin.start::<T>();
    // digits of a rest are relative to the time it comes at, which a slow start makes short
    let pace = start.velocity.to_f64().abs().clamp(f64::MIN_POSITIVE, 1.0);
    let pace = if start.velocity.is_zero() { 1.0 } else { pace };
    let completing = pace * 10_f64.powi(-(figures.max(extent.digits) as i32) - 2);
    if extent.proved {
        return proved(parameters, origin, figures, completing, telling);
    }
    let tell = move |value: &T| telling.tell(&Interval::point(value.clone()));
    let simulation = Simulation::new(&parameters.motion::<T>()?, &start).with_growth();
    let mut simulation = simulation.completing_to(completing);
    let mut events = 0;
    Ok(Box::new(move || {
        let event = simulation.next()?;
        let time = event.time(&start.phase);
        let elapsed = time.to_f64();
        let growth = simulation.tracked();
        events += 1;
        Some(Told {
            row: Row {
                event: events,
                time: tell(&time),
                phase: tell(&event.phase),
                side: event.side,
                velocity: tell(&event.velocity),
                kind: event.kind,
                // an impact at the very instant of the start was only rounded to it
                digits: match events > 1 && elapsed == 0.0 && event.kind == Kind::Impact {
                    true => 0,
                    false => growth.digits_at(elapsed, event.velocity.to_f64()).min(figures),
                },
                number: T::rung(),
                bounds: None,
            },
            event: event.convert(T::to_f64),
            elapsed,
            holds: growth.holds(),
            stretch: growth.stretch(),
            is_idle: simulation.is_idle(),
        })
    }))
}

/// The same, enclosed. Growth of errors is not followed beside.
fn proved<T: Endpoint, N: Telling<T> + 'static>(
    parameters: &impl Parameters,
    origin: &impl Origin,
    figures: u32,
    completing: f64,
    telling: N,
) -> Result<Source<N::Number>, MotionError> {
    let start = origin.start::<Interval<T>>();
    let mut enclosure = Enclosure::new(&parameters.motion()?, &start).completing_to(completing);
    let mut events = 0;
    Ok(Box::new(move || {
        let event = enclosure.next()?;
        events += 1;
        // that of the start, which is given, is 0
        let time = if events == 1 && start.position.is_none() {
            Interval::from_integer(0)
        } else {
            event.time(&start.phase)
        };
        let values = [&time, &event.phase, &event.velocity];
        let told = values.map(|value| telling.tell(value));
        let errors = [0, 1, 2].map(|index| telling.error(&told[index], values[index]));
        // what is told has the digits of the enclosure, and those that it is rounded to
        let apart = |index: usize| errors[index].to_f64().max(values[index].width().to_f64());
        let part = |index: usize| match values[index].mignitude().to_f64() {
            0.0 if values[index].width().is_zero() => 0.0,
            least => apart(index) / least,
        };
        let error = apart(1).max(part(0)).max(part(2));
        let bounds = errors.map(|error| telling.bound(error));
        let [told_time, phase, velocity] = told;
        Some(Told {
            row: Row {
                event: events,
                time: told_time,
                phase,
                side: event.side,
                velocity,
                kind: event.kind,
                digits: digits_of(error).min(figures),
                number: T::rung(),
                bounds: Some(bounds),
            },
            event: event.convert(Analytic::to_f64),
            elapsed: time.to_f64(),
            holds: event.kind != Kind::Undecided,
            stretch: f64::NAN,
            is_idle: enclosure.is_idle(),
        })
    }))
}

/// What is opened and run at so many digits.
fn wide<N: 'static>(
    digits: u32,
    open: impl FnOnce() -> Result<Source<N>, MotionError>,
) -> Result<Source<N>, MotionError> {
    let mut source = at_digits(digits, open)?;
    Ok(Box::new(move || at_digits(digits, &mut source)))
}
