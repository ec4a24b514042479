//! The points of a sweep: at each value the motion, its last impacts, what it has come to, and their voltage.

use super::setting::At;
use super::sweep::{Begin, Diagram, Map, MapWant, Over, Sweep};
use super::{Quantity, Scene, SceneError, Setting, Want};
use crate::impact::{Event, Kind, Origin, Start, Widening};
use crate::model::{Membrane, Motion, MotionError, Parameters};
use crate::number::FIGURES_OF_F64;
use crate::orbit::{
    Attractor, Averaging, AveragingLength, CycleMeans, Estimate, LongRun, OfImpact, RestingCycle, SteadyState, lyapunov,
};
use crate::stop::Token;
use rayon::prelude::*;
use std::ops::Range;
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
    pub settled: SteadyState,
    /// U_k of (6) for each impact that is kept, V; none where no voltage is modelled.
    pub voltages: Option<Vec<f64>>,
    /// The means of the motion; none where the points are [`Points::listed`].
    pub means: Option<Means>,
    /// The digits that hold at the last event: absolute of the phase, relative of the velocity; from the release before
    /// it where there was one. 0 where none does, and the impacts tell what such a motion does, not what this one does.
    /// None where that is not asked for ([`Points::with_reliance`]).
    pub digits: Option<u32>,
}

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
    /// The largest Lyapunov exponent, per unit of time (the forcing period is 2); none where [`Point::digits`] are none.
    pub lyapunov: Option<Estimate>,
    /// Whether `sweep.error` is met; none where that was not asked for.
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
        let setting = self.swept_setting()?;
        let membrane = wants.contains(&Want::Voltage).then(|| self.membrane()).transpose()?;
        let sweep = self.sweep()?;
        Ok(Points {
            diagram: self.diagram()?,
            setting: setting.over_number(),
            typed: setting,
            start: self.start()?.start(),
            membrane,
            depth: Depth::SteadyState,
            scene: self.clone(),
            beside: None,
            left: 0..sweep.points,
            sweep,
            block: Vec::new().into_iter(),
            before: None,
        })
    }

    /// The points of the map, computed as they are asked for, on every core: y by y, for each start, along x. What comes
    /// out does not depend on the number of threads.
    ///
    /// # Errors
    /// What [`Scene::check`] says of [`Want::Map`].
    pub fn map_points(&self) -> Result<MapPoints, SceneError> {
        self.check(&[Want::Map])?;
        let map = self.map()?;
        let wants = |is_it: fn(&MapWant) -> bool| map.wants.iter().any(is_it);
        Ok(MapPoints {
            setting: self.setting_without(&[map.x.over, map.y.over])?,
            membrane: wants(|want| want.is_voltage()).then(|| self.membrane()).transpose()?,
            depth: match wants(|want| *want == MapWant::Lyapunov) {
                true => Depth::Reliable,
                false => Depth::SteadyState,
            },
            scene: self.clone(),
            rows: 0..u64::from(map.y.points) * map.starts.len() as u64,
            map,
            block: Box::new(std::iter::empty()),
        })
    }
}

/// How much is made of the motion at a value: each costs more than the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    /// Its impacts.
    Listed,
    /// What it has come to.
    SteadyState,
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
    typed: Setting,
    start: Start<f64>,
    membrane: Option<Membrane<f64>>,
    depth: Depth,
    /// What else stands in the place of a key.
    beside: Option<(Over, Quantity)>,
    /// The numbers of the values that are still to come.
    left: Range<u32>,
    block: IntoIter<Result<Point, SceneError>>,
    /// Where the motion at the value before came to, where the next one follows it.
    before: Option<Event<f64>>,
}

impl Points {
    /// The same points, each with its digits and its Lyapunov exponent; for up to twice the time.
    pub fn with_reliance(self) -> Self {
        Self {
            depth: Depth::Reliable,
            ..self
        }
    }

    /// The same impacts and their voltages alone, for what simulating them costs: neither what the motion has come to nor
    /// its means.
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

    /// Those of these numbers, from 0; each starts anew.
    pub fn values(mut self, values: Range<u32>) -> Self {
        self.left = values.start.min(self.left.end)..values.end.min(self.left.end);
        self
    }

    /// Whether each value follows the one before.
    pub fn follow(&self) -> bool {
        self.diagram.start == Begin::Follow
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
        let unit = match &self.membrane {
            Some(_) => {
                let beside = self.beside.iter().map(|(over, value)| (*over, value));
                let swept: Vec<(Over, &Quantity)> = beside.chain([(self.sweep.over, &value)]).collect();
                self.scene.scales_with::<f64>(&swept)?.velocity
            }
            None => 1.0,
        };
        let membrane = self.membrane.as_ref();
        let voltage = membrane.map(|membrane| move |event: &Event<f64>| membrane.voltage(&(event.velocity * unit)));
        let voltage = voltage.as_ref().map(|voltage| voltage as OfImpact);
        let (settled, digits) = self.settled(events);
        let mut point = Point {
            voltages: voltage.map(|voltage| settled.kept.iter().map(voltage).collect()),
            means: None,
            settled,
            motion,
            digits,
            value,
        };
        if self.depth != Depth::Listed {
            self.add_means(&mut point, voltage)
                .map_err(|error| self.scene.error(None, error))?;
        }
        Ok(point)
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

    /// The means, and what the motion comes to through a rest.
    fn add_means(&self, point: &mut Point, voltage: Option<OfImpact>) -> Result<(), MotionError> {
        let Diagram {
            impacts,
            error,
            most_impacts: most,
            ..
        } = self.diagram;
        let parameters = At {
            setting: &self.typed,
            value: &point.value,
        };
        let through = |side, after: u64| -> Result<Option<Attractor>, MotionError> {
            // errors may lead round a longer way than f64 has seen
            let cycle = RestingCycle::find(&parameters, side, 4 * after.max(1000))?;
            cycle.map(|cycle| Attractor::through(&parameters, cycle)).transpose()
        };
        let mut measure = Averaging {
            motion: &point.motion,
            length: AveragingLength { impacts, error, most },
            voltage,
            with_growth: self.depth == Depth::Reliable,
            at_releases: true,
        };
        if let Some(release) = &point.settled.release {
            point.settled.attractor = through(release.side, u64::from(impacts))?;
            measure.at_releases = false;
        }
        if let Some(found) = &point.settled.attractor {
            point.means = Some(of_cycle(&measure, &parameters, found)?);
            return Ok(());
        }
        let Some(end) = point.settled.end.as_ref().filter(|end| end.kind != Kind::Undecided) else {
            return Ok(());
        };
        let mut further = measure.after(end);
        if let LongRun::Released(side, after) = further {
            point.settled.attractor = through(side, after)?;
            if let Some(found) = &point.settled.attractor {
                point.means = Some(of_cycle(&measure, &parameters, found)?);
                return Ok(());
            }
            measure.at_releases = false;
            further = measure.after(end);
        }
        if let LongRun::Measured(found) = further {
            point.means = Some(Means {
                over: MeanOver::Impacts,
                impacts: found.impacts,
                voltage: found.voltage,
                rate: found.rate,
                lyapunov: found.lyapunov,
                is_met: found.is_met,
            });
        }
        Ok(())
    }

    fn fill(&mut self) {
        let left = self.left.end - self.left.start;
        let block = match self.diagram.start {
            Begin::Each => {
                let held = HELD / self.diagram.keep as usize;
                let size = held.clamp(rayon::current_num_threads().min(BLOCK), BLOCK) as u32;
                let end = self.left.start + size.min(left);
                let token = Token::current();
                (self.left.start..end)
                    .into_par_iter()
                    .map(|index| token.during(|| self.point(index, None)))
                    .collect()
            }
            Begin::Follow if left > 0 => {
                let point = self.point(self.left.start, self.before.as_ref());
                if let Some(end) = point.as_ref().ok().and_then(|point| known_end(&point.settled)) {
                    self.before = Some(end.clone());
                }
                vec![point]
            }
            Begin::Follow => Vec::new(),
        };
        self.left.start += block.len() as u32;
        self.block = block.into_iter();
    }
}

/// What a map shows at one of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPoint {
    /// The value along y.
    pub y: Quantity,
    /// The number of the start, from 0.
    pub start: usize,
    /// What is there, with the value along x.
    pub point: Point,
}

/// The points of a map, one after the other.
pub struct MapPoints {
    scene: Scene,
    map: Map,
    setting: Setting,
    membrane: Option<Membrane<f64>>,
    depth: Depth,
    /// The rows along x that are still to come, one for each start at each value of y.
    rows: Range<u64>,
    block: Box<dyn Iterator<Item = Result<MapPoint, SceneError>> + Send + Sync>,
}

impl MapPoints {
    /// The grid that they are on.
    pub fn grid(&self) -> &Map {
        &self.map
    }

    /// How many rows along x are still to come.
    pub fn count_rows(&self) -> u64 {
        self.rows.end - self.rows.start
    }

    /// Of these rows along x those of these numbers, from 0.
    pub fn rows(mut self, rows: Range<u64>) -> Self {
        let (start, end) = (self.rows.start, self.rows.end);
        self.rows = (start + rows.start).min(end)..(start + rows.end).min(end);
        self
    }

    /// The row of this number.
    fn row(&self, row: u64) -> impl Iterator<Item = Result<MapPoint, SceneError>> + use<> {
        let starts = self.map.starts.len() as u64;
        let (y, start) = (self.map.y.value((row / starts) as u32), (row % starts) as usize);
        let typed = self.setting.clone().with(self.map.y.over, &y);
        let points = Points {
            scene: self.scene.clone(),
            sweep: self.map.x.clone(),
            diagram: self.map.diagram,
            setting: typed.over_number(),
            typed,
            start: self.map.starts[start].start(),
            membrane: self.membrane.clone(),
            depth: self.depth,
            beside: Some((self.map.y.over, y.clone())),
            left: 0..self.map.x.points,
            block: Vec::new().into_iter(),
            before: None,
        };
        points.map(move |point| {
            let y = y.clone();
            point.map(|point| MapPoint { y, start, point })
        })
    }

    /// The next rows, as many as make a block, or one that is longer, point by point.
    fn fill(&mut self) {
        let most = (BLOCK as u64 / u64::from(self.map.x.points)).max(1);
        let rows = self.rows.start..(self.rows.start + most).min(self.rows.end);
        self.rows.start = rows.end;
        if rows.end - rows.start == 1 {
            self.block = Box::new(self.row(rows.start));
            return;
        }
        let token = Token::current();
        let made = rows.into_par_iter().map(|row| token.during(|| self.row(row).collect()));
        let made: Vec<Vec<Result<MapPoint, SceneError>>> = made.collect();
        self.block = Box::new(made.into_iter().flatten());
    }
}

impl Iterator for MapPoints {
    type Item = Result<MapPoint, SceneError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if Token::current().is_stopped() {
                return None;
            }
            if let Some(point) = self.block.next() {
                return Some(point);
            }
            if self.rows.is_empty() {
                return None;
            }
            self.fill();
        }
    }
}

/// The means over a cycle, or of a ball that rests for ever.
fn of_cycle(measure: &Averaging, parameters: &impl Parameters, cycle: &Attractor) -> Result<Means, MotionError> {
    let means = CycleMeans::of(measure, parameters, cycle)?;
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

/// The last event after which the motion is known.
fn known_end(settled: &SteadyState) -> Option<&Event<f64>> {
    let end = settled.end.as_ref().filter(|end| end.kind != Kind::Undecided);
    end.or(settled.kept.last())
}

impl Iterator for Points {
    type Item = Result<Point, SceneError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.block.len() == 0 {
            self.fill();
        }
        // what was stopped on its way is no point
        self.block.next().filter(|_| !Token::current().is_stopped())
    }
}
