//! Means over the impacts of one cycle, exact but for rounding.

use crate::impact::{Event, Kind};
use crate::model::{MotionError, Parameters};
use crate::orbit::long_run::attractor::Attractor;
use crate::orbit::long_run::statistics::Averaging;

/// Means over one cycle, or of a ball that rests for ever.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleMeans {
    /// The impacts of the cycle that are listed.
    pub impacts: u64,
    /// The mean (7) of the voltage over these impacts; none where no voltage is wanted, or there is no impact.
    pub voltage: Option<f64>,
    /// The sum of the voltages per forcing period, of a chatter over all of its impacts; none where no voltage is wanted.
    pub rate: Option<f64>,
}

impl CycleMeans {
    /// Those of what `measure` wants, along a cycle.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn of(measure: &Averaging, parameters: &impl Parameters, cycle: &Attractor) -> Result<Self, MotionError> {
        let mut sums = Sums::default();
        match &cycle.resting {
            None => cycle.impacts.iter().for_each(|impact| sums.add(measure, impact)),
            Some(resting) => resting.visit(parameters, |event| sums.add(measure, event))?,
        }
        let has_voltage = measure.voltage.is_some();
        Ok(Self {
            impacts: sums.impacts,
            voltage: (has_voltage && sums.impacts > 0).then(|| sums.listed / sums.impacts as f64),
            rate: has_voltage.then(|| sums.all / cycle.periods.map_or(1.0, |periods| periods as f64)),
        })
    }
}

/// Sums along a cycle.
#[derive(Default)]
struct Sums {
    impacts: u64,
    /// Of the voltages of the impacts that are listed, and of all.
    listed: f64,
    all: f64,
    last: Option<Event<f64>>,
}

impl Sums {
    fn add(&mut self, measure: &Averaging, event: &Event<f64>) {
        let Some(voltage) = measure.voltage else {
            self.impacts += u64::from(event.kind == Kind::Impact);
            return;
        };
        match event.kind {
            Kind::Impact => {
                let voltage = voltage(event);
                (self.impacts, self.listed, self.all) = (self.impacts + 1, self.listed + voltage, self.all + voltage);
                self.last = Some(event.clone());
            }
            // the impacts that are not listed: each r times as fast as the one before, and so slow that their voltages,
            // a power of the velocity, are a geometric series
            Kind::Rest => {
                let r = *measure.motion.restitution(event.side);
                if let Some(last) = self.last.take().filter(|last| last.side == event.side) {
                    let next = |times: f64| {
                        voltage(&Event {
                            velocity: last.velocity * times,
                            ..last.clone()
                        })
                    };
                    let (first, second) = (next(r), next(r * r));
                    let tail = first / (1.0 - second / first);
                    self.all += if tail.is_finite() { tail } else { 0.0 };
                }
            }
            Kind::Release | Kind::Undecided => {}
        }
    }
}
