//! The points of a sweep: at each value the motion, its last impacts, what it has come to, and their voltage.

use super::sweep::{Begin, Diagram, Sweep};
use super::{Quantity, Scene, SceneError, Setting, Want};
use crate::impact::{Event, Kind, Origin, Start, Widening};
use crate::model::{Membrane, Motion};
use crate::number::FIGURES_OF_F64;
use crate::orbit::{Settled, lyapunov};
use rayon::prelude::*;
use std::vec::IntoIter;

/// The impacts that may be held at once, if a point for each thread does not take more.
const HELD: usize = 100_000;

/// The points that are computed together, at most.
const BLOCK: usize = 1024;

/// What a sweep shows at one of its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The value of what is swept.
    pub value: Quantity,
    /// The motion there.
    pub motion: Motion<f64>,
    /// The last impacts, and what the motion has come to.
    pub settled: Settled,
    /// U_k of (6) for each impact that is kept, V; none where no voltage is modelled.
    pub voltages: Option<Vec<f64>>,
    /// The mean (7) of U_k over [`Point::counted`], V; none where no voltage is modelled, there is no impact, or the points
    /// are [`Points::listed`].
    pub mean_voltage: Option<f64>,
    /// How far the last impact can be relied on; none where that is not asked for ([`Points::with_reliance`]).
    pub reliance: Option<Reliance>,
}

/// How far a motion can be relied on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reliance {
    /// The digits that hold at the last event: absolute of the phase, relative of the velocity. 0 where none does, and
    /// the impacts tell what such a motion does, not what this one does.
    pub digits: u32,
    /// The largest Lyapunov exponent of what the motion has come to, per unit of time, as [`lyapunov`] has it.
    pub lyapunov: Option<f64>,
}

/// What a mean is taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeanOver {
    /// The impacts of one cycle, a whole number of forcing periods.
    Periods,
    /// The impacts that are kept, as many as there are.
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

impl Point {
    /// The impacts that stand for the motion: those of its last cycle where it is periodic, else those that are kept.
    /// Of a chatter that comes to rest, those that are listed.
    pub fn counted(&self) -> (&[Event<f64>], MeanOver) {
        match &self.settled.attractor {
            // at rest for ever: none
            Some(attractor) => (&attractor.impacts, MeanOver::Periods),
            _ => (&self.settled.kept, MeanOver::Impacts),
        }
    }
}

impl Scene {
    /// The wants that a sweep of this scene serves: the diagram, and the voltage where the scene wants it or, where it
    /// does not say what it wants, where it has a membrane.
    ///
    /// # Errors
    /// As [`Scene::want`].
    pub fn wants_of_sweep(&self) -> Result<Vec<Want>, SceneError> {
        let wants = self.want()?;
        let is_silent = wants.is_empty() && self.has_membrane();
        let mut served = vec![Want::Sweep];
        if is_silent || wants.contains(&Want::Voltage) {
            served.push(Want::Voltage);
        }
        Ok(served)
    }

    /// The points of the sweep in order, computed as they are asked for, a block of them at a time on every core; where
    /// each value follows the one before, one by one. What is held at once does not grow with their number, and what
    /// comes out depends neither on the number of threads nor on the blocks.
    ///
    /// # Errors
    /// What [`Scene::check`] says of [`Scene::wants_of_sweep`].
    pub fn points(&self) -> Result<Points, SceneError> {
        let wants = self.wants_of_sweep()?;
        self.check(&wants)?;
        let membrane = wants.contains(&Want::Voltage).then(|| self.membrane()).transpose()?;
        Ok(Points {
            sweep: self.sweep()?,
            diagram: self.diagram()?,
            setting: self.swept_setting()?.over_number(),
            start: self.start()?.start(),
            membrane,
            depth: Depth::Settled,
            scene: self.clone(),
            next: 0,
            block: Vec::new().into_iter(),
            before: None,
        })
    }
}

/// How much is made of the motion at a value: each costs more than the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    /// Its impacts.
    Listed,
    /// What it has come to.
    Settled,
    /// How far that can be relied on.
    Reliable,
}

/// The points of a sweep, one after the other.
#[derive(Debug)]
pub struct Points {
    scene: Scene,
    sweep: Sweep,
    diagram: Diagram,
    setting: Setting<f64>,
    start: Start<f64>,
    membrane: Option<Membrane<f64>>,
    depth: Depth,
    next: u32,
    block: IntoIter<Result<Point, SceneError>>,
    /// Where the motion at the value before came to, where the next one follows it.
    before: Option<Event<f64>>,
}

impl Points {
    /// The same points, each with its [`Reliance`]; for up to twice the time.
    pub fn with_reliance(self) -> Self {
        Self {
            depth: Depth::Reliable,
            ..self
        }
    }

    /// The same impacts and their voltages alone, for what simulating them costs: neither what the motion has come to nor a
    /// mean voltage.
    pub fn listed(self) -> Self {
        Self {
            depth: Depth::Listed,
            ..self
        }
    }

    /// The sweep.
    pub fn sweep(&self) -> &Sweep {
        &self.sweep
    }

    /// Point number `index`, from 0, from where the one before came to or from `[start]`.
    fn point(&self, index: u32, before: Option<&Event<f64>>) -> Result<Point, SceneError> {
        let value = self.sweep.value(index);
        let motion = self.setting.at(&value.value());
        let motion = motion.map_err(|error| self.scene.error(None, error))?;
        let events = match before {
            None => Widening::new(&motion, &self.start),
            Some(impact) if impact.kind == Kind::Impact => Widening::new(&motion, &Start::from(impact)),
            Some(event) => Widening::after(&motion, event),
        };
        let (settled, reliance) = self.settled(&motion, events);
        let mut point = Point {
            value,
            motion,
            settled,
            voltages: None,
            mean_voltage: None,
            reliance,
        };
        self.add_voltages(&mut point)?;
        Ok(point)
    }

    /// What the events come to, as deep as is asked for.
    fn settled(&self, motion: &Motion<f64>, events: Widening) -> (Settled, Option<Reliance>) {
        let Diagram { impacts, keep, .. } = self.diagram;
        let mut events = match self.depth {
            Depth::Listed => return (Settled::listed(events.without_growth(), impacts, keep), None),
            Depth::Settled => events.without_growth(),
            Depth::Reliable => events,
        };
        let mut settled = Settled::after(events.by_ref(), impacts, keep);
        let end = settled.end.as_ref();
        let digits = end.map_or(0, |end| events.growth().digits(end.velocity));
        // on to rounding nobody asks what still holds
        let further = events.without_growth();
        settled.attractor = settled.attractor.map(|found| found.settled_further(further));
        let reliance = (self.depth == Depth::Reliable).then(|| Reliance {
            digits: digits.min(FIGURES_OF_F64),
            lyapunov: lyapunov(motion, &settled, impacts),
        });
        (settled, reliance)
    }

    fn add_voltages(&self, point: &mut Point) -> Result<(), SceneError> {
        let Some(membrane) = &self.membrane else {
            return Ok(());
        };
        let unit = self.scene.swept_scales::<f64>(self.sweep.over, &point.value)?.velocity;
        let voltage = |event: &Event<f64>| membrane.voltage(&(event.velocity * unit));
        if self.depth != Depth::Listed {
            let (counted, _) = point.counted();
            let sum: f64 = counted.iter().map(voltage).sum();
            point.mean_voltage = (!counted.is_empty()).then_some(sum / counted.len() as f64);
        }
        point.voltages = Some(point.settled.kept.iter().map(voltage).collect());
        Ok(())
    }

    fn fill(&mut self) {
        let left = self.sweep.points - self.next;
        let block = match self.diagram.start {
            Begin::Each => {
                let held = HELD / self.diagram.keep as usize;
                let size = held.clamp(rayon::current_num_threads().min(BLOCK), BLOCK) as u32;
                let end = self.next + size.min(left);
                (self.next..end)
                    .into_par_iter()
                    .map(|index| self.point(index, None))
                    .collect()
            }
            Begin::Follow if left > 0 => {
                let point = self.point(self.next, self.before.as_ref());
                if let Some(end) = point.as_ref().ok().and_then(|point| known_end(&point.settled)) {
                    self.before = Some(end.clone());
                }
                vec![point]
            }
            Begin::Follow => Vec::new(),
        };
        self.next += block.len() as u32;
        self.block = block.into_iter();
    }
}

/// The last event after which the motion is known.
fn known_end(settled: &Settled) -> Option<&Event<f64>> {
    let end = settled.end.as_ref().filter(|end| end.kind != Kind::Undecided);
    end.or(settled.kept.last())
}

impl Iterator for Points {
    type Item = Result<Point, SceneError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.block.len() == 0 {
            self.fill();
        }
        self.block.next()
    }
}
