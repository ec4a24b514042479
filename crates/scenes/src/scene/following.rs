//! What the motion from a start comes to, and its means.

use super::sweep::{Begin, Diagram};
use dynamics::impact::{Event, Kind, Widening, in_lanes};
use dynamics::model::{Membrane, Motion, MotionError, Parameters};
use dynamics::orbit::{
    AtRelease, Attractor, Averaging, AveragingLength, CycleMeans, Estimate, LongRun, OfImpact, RestingCycle, Settling,
    SteadyState, lyapunov,
};
use numbers::FIGURES_OF_F64;
use std::ops::Range;

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

/// How a motion is followed, and what is made of it.
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

/// The motions that are computed together, at most.
const BLOCK: u64 = 1024;

/// How motions are flown: what they come to is the same but for rounding, and for chaos, which makes all of rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Execution {
    /// One after the other.
    Alone,
    /// In lanes: faster from ten on.
    InLanes,
}

/// The fewest motions that are faster in lanes.
const WORTHWHILE: u64 = 8;

/// The motions that fly together, where there are as many: at least the lanes of a core, at most so many that no core is
/// left without.
const TOGETHER: u64 = 32;
const MOST_TOGETHER: u64 = 128;

/// The impacts that may be held at once, and those that motions which fly together may make: nobody is to wait longer for
/// the first of them, nor lose more when it is stopped.
const HELD: u64 = 100_000;
const LONGEST: u32 = 1_000_000;

impl Execution {
    /// How so many motions are flown. What comes out must not depend on the parts in which they are computed, so that it
    /// goes by all of them.
    pub fn of(motions: u64, diagram: &Diagram) -> Self {
        let fits = u64::from(diagram.keep) * TOGETHER <= HELD && diagram.impacts <= LONGEST;
        match motions >= WORTHWHILE && fits && diagram.start == Begin::Each {
            true => Self::InLanes,
            false => Self::Alone,
        }
    }

    /// The motions that one core is given at once, at least.
    pub fn together(self) -> u64 {
        match self {
            Self::Alone => 1,
            Self::InLanes => TOGETHER,
        }
    }

    /// The parts of so many motions that cores are given.
    pub fn parts(self, numbers: Range<u64>) -> Vec<Range<u64>> {
        let each = match self {
            Self::Alone => 1,
            Self::InLanes => {
                let for_each_core = (numbers.end - numbers.start) / rayon::current_num_threads() as u64;
                for_each_core.clamp(TOGETHER, MOST_TOGETHER)
            }
        };
        let starts = numbers.clone().step_by(each as usize);
        starts.map(|start| start..(start + each).min(numbers.end)).collect()
    }

    /// The most motions that are computed before the first is told.
    pub fn most(self, diagram: &Diagram) -> u64 {
        let threads = rayon::current_num_threads() as u64;
        (HELD / u64::from(diagram.keep.max(1))).clamp((threads * self.together()).min(BLOCK), BLOCK)
    }

    /// Goes along motions, each with what is made of its events, until `each` wants no more; `ended` gets them as they stand.
    fn along<M>(
        self,
        motions: impl Iterator<Item = (Widening, M)>,
        with_growth: bool,
        mut each: impl FnMut(&mut M, &Event<f64>, &dyn Fn() -> f64) -> bool,
        mut ended: impl FnMut(M, Widening),
    ) {
        match self {
            Self::InLanes => in_lanes(
                motions,
                with_growth,
                |beside, event, grown| each(beside, event, &|| grown.stretch_since_release()),
                ended,
            ),
            Self::Alone => {
                for (mut motion, mut beside) in motions {
                    while let Some(event) = motion.next() {
                        if !each(&mut beside, &event, &|| motion.growth().stretch_since_release()) {
                            break;
                        }
                    }
                    ended(beside, motion);
                }
            }
        }
    }
}

/// Follows motions from their first events on.
pub(super) fn follow<P: Parameters>(
    motions: Vec<(Following<P>, Widening)>,
    execution: Execution,
) -> Vec<Result<Followed, MotionError>> {
    let (motions, events): (Vec<_>, Vec<_>) = motions.into_iter().unzip();
    let with_growth = motions.iter().any(|motion| motion.depth == Depth::Reliable);
    let begun = motions.iter().zip(events).enumerate();
    let begun = begun.map(|(index, (motion, events))| (motion.tracked(events), (index, motion.settling())));
    let mut settled = Vec::with_capacity(motions.len());
    execution.along(
        begun,
        with_growth,
        |(_, settling), event, _| settling.take(event),
        |(index, settling): (usize, Settling), events| settled.push((index, motions[index].settled(settling, events))),
    );

    settled.sort_by_key(|(index, _)| *index);
    let voltages: Vec<_> = motions.iter().map(Following::voltage).collect();
    let averagings: Vec<Averaging> = motions
        .iter()
        .zip(&voltages)
        .map(|(motion, voltage)| motion.averaging(voltage.as_ref()))
        .collect();
    // motions of which nothing is known after their cycles and rests have been looked for
    let mut open = Vec::new();
    let mut followed: Vec<Result<Followed, MotionError>> = Vec::with_capacity(motions.len());
    for (index, (mut settled, digits)) in settled {
        let means = motions[index].known_means(&mut settled, &averagings[index]);
        let means = means.map(|means| match means {
            KnownMeans::Known(means) => means,
            KnownMeans::Open { end, at_release } => {
                open.push((
                    index,
                    end,
                    Averaging {
                        at_release,
                        ..averagings[index]
                    },
                ));
                None
            }
        });
        let voltages = voltages[index]
            .as_ref()
            .map(|voltage| settled.kept.iter().map(voltage).collect());
        followed.push(means.map(|means| Followed {
            settled,
            voltages,
            means,
            digits,
        }));
    }

    let mut long_runs = Vec::with_capacity(open.len());
    let begun = open
        .iter()
        .map(|(index, end, averaging)| (averaging.events_after(end), (*index, averaging.begin(end))));
    execution.along(
        begun,
        with_growth,
        |(_, means), event, grown| means.take(event, grown),
        |(index, means), _| long_runs.push((index, means.long_run())),
    );
    for (index, long_run) in long_runs {
        if let Ok(reached) = &mut followed[index] {
            match motions[index].after_long_run(&mut reached.settled, &averagings[index], long_run) {
                Ok(means) => reached.means = means,
                Err(error) => followed[index] = Err(error),
            }
        }
    }
    followed
}

/// The means of a motion, if they are known without following it on.
enum KnownMeans {
    Known(Option<Means>),
    /// From this event on.
    Open {
        end: Event<f64>,
        at_release: AtRelease,
    },
}

impl<P: Parameters> Following<'_, P> {
    fn voltage(&self) -> Option<impl Fn(&Event<f64>) -> f64> {
        self.membrane
            .map(|(membrane, unit)| move |event: &Event<f64>| membrane.voltage(&(event.velocity * unit)))
    }

    /// The events with as much of their growth as is wanted.
    fn tracked(&self, events: Widening) -> Widening {
        match self.depth {
            Depth::Listed | Depth::SteadyState => events.without_growth(),
            Depth::Reliable => events,
        }
    }

    fn settling(&self) -> Settling {
        let Diagram {
            impacts, keep, options, ..
        } = self.diagram;
        match self.depth {
            Depth::Listed => Settling::listed(impacts, keep),
            Depth::SteadyState | Depth::Reliable => Settling::new(impacts, keep, &options),
        }
    }

    fn averaging<'b>(&'b self, voltage: Option<&'b impl Fn(&Event<f64>) -> f64>) -> Averaging<'b> {
        let Diagram {
            impacts,
            error,
            most_impacts: most,
            options,
            ..
        } = self.diagram;
        Averaging {
            motion: self.motion,
            length: AveragingLength { impacts, error, most },
            voltage: voltage.map(|voltage| voltage as OfImpact),
            with_growth: self.depth == Depth::Reliable,
            at_release: AtRelease::Ends {
                followed: Some(options),
            },
        }
    }

    /// What the impacts come to without a rest, where that is asked for, and the digits that hold.
    fn settled(&self, settling: Settling, events: Widening) -> (SteadyState, Option<u32>) {
        let mut settled = settling.steady_state();
        let end = settled.end.as_ref();
        let digits = end.map_or(0, |end| events.growth().digits(end.velocity));
        // on to rounding nobody asks what still holds
        let further = events.without_growth();
        settled.attractor = settled
            .attractor
            .map(|found| found.settled_further(further, &self.diagram.options));
        (
            settled,
            (self.depth == Depth::Reliable).then_some(digits.min(FIGURES_OF_F64)),
        )
    }

    /// The cycle through a rest after a second release from a wall, after so many impacts; else the impacts of it that are
    /// known.
    fn through(&self, release: &Event<f64>, after: u64) -> Result<Result<Attractor, u64>, MotionError> {
        // errors may lead round a longer way than f64 has seen
        let most = 4 * after.max(1000);
        match RestingCycle::find(
            &self.parameters,
            (release.side, release.phase),
            most,
            self.diagram.options.resting_digits,
        )? {
            Ok(cycle) => Attractor::through(&self.parameters, cycle).map(Ok),
            Err(known) => Ok(Err(known)),
        }
    }

    /// The means, where they are known; what the motion comes to through a rest is added to what it has settled to.
    fn known_means(&self, settled: &mut SteadyState, measure: &Averaging) -> Result<KnownMeans, MotionError> {
        if self.depth == Depth::Listed {
            return Ok(KnownMeans::Known(None));
        }
        let mut at_release = measure.at_release;
        if let Some(release) = &settled.release {
            let found = self.through(release, u64::from(self.diagram.impacts))?;
            if let Err(longer_than) = found {
                at_release = AtRelease::Passes { longer_than };
            }
            settled.attractor = found.ok();
        }
        if let Some(found) = &settled.attractor {
            return Ok(KnownMeans::Known(Some(self.of_cycle(measure, found)?)));
        }
        let end = settled.end.clone().filter(|end| end.kind != Kind::Undecided);
        Ok(match end {
            Some(end) => KnownMeans::Open { end, at_release },
            None => KnownMeans::Known(None),
        })
    }

    /// The means of a motion that was followed on.
    fn after_long_run(
        &self,
        settled: &mut SteadyState,
        measure: &Averaging,
        long_run: LongRun,
    ) -> Result<Option<Means>, MotionError> {
        let found = match long_run {
            LongRun::Measured(found) => found,
            LongRun::Repeats(cycle) => {
                let further = cycle
                    .impacts
                    .last()
                    .map(|last| Widening::after(self.motion, last).without_growth());
                let cycle = cycle.settled_further(further.into_iter().flatten(), &self.diagram.options);
                let means = self.of_cycle(measure, &cycle)?;
                settled.attractor = Some(cycle);
                return Ok(Some(means));
            }
            LongRun::Released(release, after) => match self.through(&release, after)? {
                Ok(cycle) => {
                    let means = self.of_cycle(measure, &cycle)?;
                    settled.attractor = Some(cycle);
                    return Ok(Some(means));
                }
                Err(longer_than) => {
                    let anew = Averaging {
                        at_release: AtRelease::Passes { longer_than },
                        ..*measure
                    };
                    match anew.after(&release) {
                        LongRun::Measured(found) => found,
                        LongRun::Released(..) | LongRun::Repeats(_) => return Ok(None),
                    }
                }
            },
        };
        Ok(Some(Means {
            over: MeanOver::Impacts,
            impacts: found.impacts,
            voltage: found.voltage,
            rate: found.rate,
            lyapunov: found.lyapunov,
            is_met: found.is_met,
        }))
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
