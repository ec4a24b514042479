//! What the motion from a start comes to, and its means.

use super::sweep::Diagram;
use crate::impact::{Event, Kind, Widening};
use crate::model::{Membrane, Motion, MotionError, Parameters};
use crate::number::FIGURES_OF_F64;
use crate::orbit::{
    Attractor, Averaging, AveragingLength, CycleMeans, Estimate, LongRun, OfImpact, RestingCycle, SteadyState, lyapunov,
};

/// The means of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Means {
    /// What they are taken over.
    pub over: MeanOver,
    /// The impacts among that, as they are listed.
    pub impacts: u64,
    /// The mean (7) of U_k over these impacts, V; none where no voltage is modelled, or there is no impact.
    pub voltage: Option<Estimate>,
    /// The sum of U_k per forcing period, V: of a chatter that comes to rest, over all of its impacts. None where no
    /// voltage is modelled.
    pub rate: Option<Estimate>,
    /// The largest Lyapunov exponent, per unit of time (the forcing period is 2); none where
    /// [`Point::digits`](super::Point::digits) are none.
    pub lyapunov: Option<Estimate>,
    /// Whether the error that was asked for is met; none where none was.
    pub is_met: Option<bool>,
}

/// What a mean is taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeanOver {
    /// The impacts of one cycle, a whole number of forcing periods.
    Periods,
    /// Impacts after those of the diagram, at least as many as these.
    Impacts,
}

impl MeanOver {
    /// The word in the column `mean_over`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Periods => "periods",
            Self::Impacts => "impacts",
        }
    }
}

/// How much is made of a motion: each costs more than the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Depth {
    /// Its impacts.
    Listed,
    /// What it has come to.
    SteadyState,
    /// How far that can be relied on.
    Reliable,
}

/// How motions of one device are followed, and what is made of them.
pub(super) struct Following<'a, P> {
    pub diagram: Diagram,
    pub depth: Depth,
    pub motion: &'a Motion<f64>,
    /// The same as typed.
    pub parameters: P,
    /// What gives the voltage, and the unit of velocity in m/s.
    pub membrane: Option<(&'a Membrane<f64>, f64)>,
}

/// What a motion has come to.
#[derive(Debug)]
pub(super) struct Followed {
    pub settled: SteadyState,
    /// Of the impacts that are kept.
    pub voltages: Option<Vec<f64>>,
    pub means: Option<Means>,
    pub digits: Option<u32>,
}

impl<P: Parameters> Following<'_, P> {
    /// Follows a motion from its first events on.
    pub fn follow(&self, events: Widening) -> Result<Followed, MotionError> {
        let voltage = self
            .membrane
            .map(|(membrane, unit)| move |event: &Event<f64>| membrane.voltage(&(event.velocity * unit)));
        let voltage = voltage.as_ref().map(|voltage| voltage as OfImpact);
        let (mut settled, digits) = self.settled(events);
        let means = match self.depth {
            Depth::Listed => None,
            Depth::SteadyState | Depth::Reliable => self.means(&mut settled, voltage)?,
        };
        Ok(Followed {
            voltages: voltage.map(|voltage| settled.kept.iter().map(voltage).collect()),
            settled,
            means,
            digits,
        })
    }

    /// The impacts and, where that is asked for, what they come to without a rest, and the digits that hold.
    fn settled(&self, events: Widening) -> (SteadyState, Option<u32>) {
        let Diagram { impacts, keep, .. } = self.diagram;
        let mut events = match self.depth {
            Depth::Listed => return (SteadyState::listed(events.without_growth(), impacts, keep), None),
            Depth::SteadyState => events.without_growth(),
            Depth::Reliable => events,
        };
        let mut settled = SteadyState::after(events.by_ref(), impacts, keep);
        let end = settled.end.as_ref();
        let digits = end.map_or(0, |end| events.growth().digits_since_release(end.velocity));
        // on to rounding nobody asks what still holds
        let further = events.without_growth();
        settled.attractor = settled.attractor.map(|found| found.settled_further(further));
        (
            settled,
            (self.depth == Depth::Reliable).then_some(digits.min(FIGURES_OF_F64)),
        )
    }

    /// The means; what the motion comes to through a rest is added to what it has settled to.
    fn means(&self, settled: &mut SteadyState, voltage: Option<OfImpact>) -> Result<Option<Means>, MotionError> {
        let Diagram {
            impacts,
            error,
            most_impacts: most,
            ..
        } = self.diagram;
        let through = |side, after: u64| -> Result<Option<Attractor>, MotionError> {
            // errors may lead round a longer way than f64 has seen
            let cycle = RestingCycle::find(&self.parameters, side, 4 * after.max(1000))?;
            cycle
                .map(|cycle| Attractor::through(&self.parameters, cycle))
                .transpose()
        };
        let mut measure = Averaging {
            motion: self.motion,
            length: AveragingLength { impacts, error, most },
            voltage,
            with_growth: self.depth == Depth::Reliable,
            at_releases: true,
        };
        if let Some(release) = &settled.release {
            settled.attractor = through(release.side, u64::from(impacts))?;
            measure.at_releases = false;
        }
        if let Some(found) = &settled.attractor {
            return self.of_cycle(&measure, found).map(Some);
        }
        let Some(end) = settled.end.as_ref().filter(|end| end.kind != Kind::Undecided) else {
            return Ok(None);
        };
        let mut further = measure.after(end);
        if let LongRun::Released(side, after) = further {
            settled.attractor = through(side, after)?;
            if let Some(found) = &settled.attractor {
                return self.of_cycle(&measure, found).map(Some);
            }
            measure.at_releases = false;
            further = measure.after(end);
        }
        Ok(match further {
            LongRun::Measured(found) => Some(Means {
                over: MeanOver::Impacts,
                impacts: found.impacts,
                voltage: found.voltage,
                rate: found.rate,
                lyapunov: found.lyapunov,
                is_met: found.is_met,
            }),
            LongRun::Released(..) => None,
        })
    }

    /// The means over a cycle, or of a ball that rests for ever.
    fn of_cycle(&self, measure: &Averaging, cycle: &Attractor) -> Result<Means, MotionError> {
        let means = CycleMeans::of(measure, &self.parameters, cycle)?;
        let has_voltage = measure.voltage.is_some();
        let lyapunov = if measure.with_growth {
            lyapunov(measure.motion, cycle)
        } else {
            None
        };
        let [voltage, rate, lyapunov] = [means.voltage, means.rate, lyapunov].map(|value| value.map(Estimate::exact));
        Ok(Means {
            over: MeanOver::Periods,
            impacts: means.impacts,
            voltage,
            rate,
            lyapunov,
            is_met: measure.length.error.filter(|_| has_voltage).map(|_| true),
        })
    }
}
