//! The points of a sweep: at each value the motion, its last impacts, what it has come to, and their voltage.

use super::following::{Depth, Execution, Followed, Following, Means, follow};
use super::pace::Pace;
use super::setting::At;
use super::sweep::{Begin, Diagram, Map, MapWant, Over, Sweep};
use super::{Quantity, Scene, SceneError, Setting, Want};
use dynamics::impact::{Event, Kind, Origin, Start, Widening};
use dynamics::model::{Membrane, Motion};
use dynamics::orbit::SteadyState;
use rayon::prelude::*;
use std::ops::Range;
use std::vec::IntoIter;
use stop::Token;

/// The points of a map that are computed row by row at once, at most; longer rows are computed one by one.
const MOST_IN_ROWS: u64 = 1024;

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

impl Point {
    fn new(value: Quantity, motion: Motion<f64>, reached: Followed) -> Self {
        Self {
            settled: reached.settled,
            voltages: reached.voltages,
            means: reached.means,
            digits: reached.digits,
            motion,
            value,
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
        let voltage = self.serves_voltage()?.then_some(Want::Voltage);
        Ok([Want::Sweep].into_iter().chain(voltage).collect())
    }

    /// Whether the voltage is told beside what is asked: where the scene wants it, or has a membrane and does not say what
    /// it wants.
    pub(super) fn serves_voltage(&self) -> Result<bool, SceneError> {
        let wants = self.want()?;
        Ok(wants.contains(&Want::Voltage) || (wants.is_empty() && self.has_membrane()))
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
        let (sweep, diagram) = (self.sweep()?, self.diagram()?);
        let execution = Execution::of(u64::from(sweep.points), &diagram);
        Ok(Points {
            diagram,
            execution,
            setting: setting.over_number(),
            typed: setting,
            start: self.start()?.start(),
            membrane,
            depth: Depth::SteadyState,
            scene: self.clone(),
            beside: None,
            left: 0..sweep.points,
            sweep,
            pace: Pace::new(execution.together()),
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
            first: 0,
            pace: Pace::new(1),
            map,
            block: Box::new(std::iter::empty()),
        })
    }
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
    execution: Execution,
    /// What else stands in the place of a key.
    beside: Option<(Over, Quantity)>,
    /// The numbers of the values that are still to come.
    left: Range<u32>,
    pace: Pace,
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

    /// The motion at number `index`, from 0.
    fn prepared(&self, index: u32) -> Result<Prepared, SceneError> {
        let value = self.sweep.value(index);
        let motion = self.setting.at(&value.value());
        let motion = motion.map_err(|error| self.scene.error(None, error))?;
        let unit = match &self.membrane {
            Some(_) => {
                let beside = self.beside.iter().map(|(over, value)| (*over, value));
                let swept: Vec<(Over, &Quantity)> = beside.chain([(self.sweep.over, &value)]).collect();
                self.scene.scales_with::<f64>(&swept)?.velocity
            }
            None => 1.0,
        };
        Ok(Prepared { value, motion, unit })
    }

    fn following<'a>(&'a self, prepared: &'a Prepared) -> Following<'a, At<'a>> {
        Following {
            diagram: self.diagram,
            depth: self.depth,
            motion: &prepared.motion,
            parameters: At {
                setting: &self.typed,
                value: &prepared.value,
            },
            membrane: self.membrane.as_ref().map(|membrane| (membrane, prepared.unit)),
        }
    }

    /// The points of these numbers, from 0, each from `[start]` or, where there is one, from where the motion before came to.
    fn at(&self, indices: Range<u32>, before: Option<&Event<f64>>) -> Vec<Result<Point, SceneError>> {
        let prepared: Vec<_> = indices.map(|index| self.prepared(index)).collect();
        let events = |motion| match before {
            None => Widening::new(motion, &self.start),
            Some(impact) if impact.kind == Kind::Impact => Widening::new(motion, &Start::from(impact)),
            Some(event) => Widening::after(motion, event),
        };
        let motions = prepared.iter().flatten();
        let motions = motions.map(|prepared| (self.following(prepared), events(&prepared.motion)));
        let mut followed = follow(motions.collect(), self.execution).into_iter();
        let point = |prepared: Result<Prepared, SceneError>| {
            let Prepared { value, motion, .. } = match prepared {
                Ok(prepared) => prepared,
                Err(error) => return Some(Err(error)),
            };
            // what is prepared is followed
            let reached = followed.next()?;
            Some(
                reached
                    .map(|reached| Point::new(value, motion, reached))
                    .map_err(|error| self.scene.error(None, error)),
            )
        };
        prepared.into_iter().filter_map(point).collect()
    }

    fn fill(&mut self) {
        let left = self.left.end - self.left.start;
        let block = match self.diagram.start {
            Begin::Each => {
                let most = self.execution.most(&self.diagram).min(u64::from(left));
                let token = Token::current();
                let mut pace = self.pace;
                let block = pace.block(most, |size| {
                    let start = u64::from(self.left.start);
                    let parts = self
                        .execution
                        .parts(start..(start + size).min(u64::from(self.left.end)));
                    let points = parts.into_par_iter().flat_map_iter(|part| {
                        let part = part.start as u32..part.end as u32;
                        token.during(|| self.at(part, None))
                    });
                    points.collect()
                });
                self.pace = pace;
                block
            }
            Begin::Follow if left > 0 => {
                let next = self.left.start;
                let points = self.at(next..next + 1, self.before.as_ref());
                let point = points.last().and_then(|point| point.as_ref().ok());
                if let Some(end) = point.and_then(|point| known_end(&point.settled)) {
                    self.before = Some(end.clone());
                }
                points
            }
            Begin::Follow => Vec::new(),
        };
        self.left.start += block.len() as u32;
        self.block = block.into_iter();
    }
}

/// A motion of a sweep before it is followed.
struct Prepared {
    value: Quantity,
    motion: Motion<f64>,
    /// The unit of velocity, m/s; 1 where no voltage is modelled.
    unit: f64,
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
    /// The number of the first point of the next row.
    first: u32,
    pace: Pace,
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
        self.rows = (start + rows.start).min(end)..start.saturating_add(rows.end).min(end);
        self
    }

    /// Without so many points from the first on; where each value follows the one before, rows along x are whole.
    pub fn without(mut self, points: u64) -> Self {
        let along = u64::from(self.map.x.points);
        let rows = (points / along).min(self.count_rows());
        self = self.rows(rows..u64::MAX);
        // less than the points along x
        self.first = match self.follow() {
            true => 0,
            false => (points % along) as u32,
        };
        self
    }

    /// Whether each value along x follows the one before.
    pub fn follow(&self) -> bool {
        self.map.diagram.start == Begin::Follow
    }

    /// The row of this number, from this point on.
    fn row(&self, row: u64, first: u32) -> impl Iterator<Item = Result<MapPoint, SceneError>> + use<> {
        let starts = self.map.starts.len() as u64;
        let (y, start) = (self.map.y.value((row / starts) as u32), (row % starts) as usize);
        let typed = self.setting.clone().with(self.map.y.over, &y);
        let execution = Execution::of(u64::from(self.map.x.points), &self.map.diagram);
        let points = Points {
            scene: self.scene.clone(),
            sweep: self.map.x.clone(),
            diagram: self.map.diagram,
            execution,
            setting: typed.over_number(),
            typed,
            start: self.map.starts[start].start(),
            membrane: self.membrane.clone(),
            depth: self.depth,
            beside: Some((self.map.y.over, y.clone())),
            left: first..self.map.x.points,
            pace: Pace::new(execution.together()),
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
        let (next, first) = (self.rows.start, std::mem::take(&mut self.first));
        let most = (MOST_IN_ROWS / u64::from(self.map.x.points)).min(self.count_rows());
        if most <= 1 {
            self.rows.start += 1;
            self.block = Box::new(self.row(next, first));
            return;
        }
        let token = Token::current();
        let mut pace = self.pace;
        let made: Vec<Vec<Result<MapPoint, SceneError>>> = pace.block(most, |size| {
            let of = |row: u64| self.row(row, if row == next { first } else { 0 }).collect();
            let rows = (next..next + size).into_par_iter();
            rows.map(|row| token.during(|| of(row))).collect()
        });
        self.pace = pace;
        self.rows.start += made.len() as u64;
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
