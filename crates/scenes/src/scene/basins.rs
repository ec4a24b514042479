//! Which attractor each of a grid of starts comes to, at one device.

use super::following::{Depth, Execution, Followed, Following, follow};
use super::pace::Pace;
use super::sweep::StartGrid;
use super::{Quantity, Scene, SceneError, Setting, Want};
use dynamics::impact::{Kind, Origin, Widening};
use dynamics::model::{Membrane, Motion, Side};
use dynamics::orbit::{Attractor, Estimate};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::ops::Range;
use std::vec::IntoIter;
use stop::Token;

/// Cycles of one word and as many periods of which an impact is no farther than this from one of the other, in phase and
/// in velocity, are one: a cycle that still settles is farther from where it ends than by rounding.
const SAME: f64 = 1e-6;

/// What some motions of one device come to.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachedAttractor {
    /// The word of the cycle; none for motions that do not repeat, which are together one row.
    pub word: Option<String>,
    /// The forcing periods of the cycle; none where it has none.
    pub periods: Option<i64>,
    /// The phases of the impacts of the cycle in word order, in [0, 2 pi); none of a cycle through a rest.
    pub phases: Vec<f64>,
    /// The velocities just before them.
    pub velocities: Vec<f64>,
    /// No phase, velocity or time of flight is farther than this from that of a motion proved to exist; none without proof.
    pub error_bound: Option<f64>,
    /// The sum of the voltages per forcing period, V, along the first motion that came here; none without a membrane.
    pub voltage_rate: Option<Estimate>,
    /// The starts that lead here.
    pub starts: u64,
    /// The phases at which the ball is released, where a wall has several.
    pub releases: Vec<f64>,
}

impl ReachedAttractor {
    /// The part of so many starts that leads here, with the standard error that as many starts at random would have: that
    /// of the mean of Jeffreys' posterior (L. D. Brown, T. T. Cai and A. DasGupta, 2001, Statistical Science 16, 101-133),
    /// which is not 0 where all or none of them do.
    pub fn fraction(&self, of: u64) -> Estimate {
        let (led, all) = (self.starts as f64, of as f64);
        let mean = (led + 0.5) / (all + 1.0);
        Estimate {
            value: led / all,
            error: Some((mean * (1.0 - mean) / (all + 2.0)).sqrt()),
        }
    }

    /// Whether it is the same, by what is known of both: motions that do not repeat are told apart by nothing; a release
    /// from a rest forgets what was before, so that the word of a cycle through one is enough, and one phase of release
    /// where a wall has several.
    pub fn is_same(&self, other: &Self) -> bool {
        let (Some(word), Some(others)) = (&self.word, &other.word) else {
            return self.word == other.word;
        };
        if self.periods != other.periods || self.phases.len() != other.phases.len() {
            return false;
        }
        let (Some(phase), Some(velocity)) = (self.phases.first(), self.velocities.first()) else {
            let is_shared = |at: &f64| other.releases.iter().any(|phase| (phase - at).abs() < SAME);
            let are_known = !self.releases.is_empty() && !other.releases.is_empty();
            return word == others && (!are_known || self.releases.iter().any(is_shared));
        };
        let mut impacts = other.phases.iter().zip(&other.velocities);
        impacts.any(|(at, with)| {
            let apart = (phase - at).abs();
            apart.min(TAU - apart) < SAME && (velocity - with).abs() < SAME
        })
    }
}

/// The attractors found so far, in the order in which starts led to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReachedAttractors {
    /// In order.
    pub list: Vec<ReachedAttractor>,
}

impl ReachedAttractors {
    /// Adds the starts of one; its number, from 0.
    pub fn add(&mut self, found: ReachedAttractor) -> usize {
        match self.list.iter_mut().position(|known| known.is_same(&found)) {
            Some(number) => {
                self.list[number].starts += found.starts;
                number
            }
            None => {
                self.list.push(found);
                self.list.len() - 1
            }
        }
    }
}

/// Where a start leads.
#[derive(Clone, Debug, PartialEq)]
pub struct BasinPoint {
    /// As typed, rad.
    pub phase: Quantity,
    /// Just before the first impact.
    pub velocity: Quantity,
    /// What the motion came to; none where an undecided contact ended it.
    pub attractor: Option<ReachedAttractor>,
}

impl Scene {
    /// The starts of `[basins]` and where each leads, computed as they are asked for, on every core: velocity by velocity,
    /// along the phase. What comes out does not depend on the number of threads.
    ///
    /// # Errors
    /// What [`Scene::check`] says of [`Want::Basins`].
    pub fn basins(&self) -> Result<BasinPoints, SceneError> {
        self.check(&[Want::Basins])?;
        let grid = self.start_grid()?;
        let membrane = match self.serves_voltage()? {
            true => Some((self.membrane()?, self.scales::<f64>()?.velocity)),
            false => None,
        };
        let execution = Execution::of(grid.starts(), &grid.diagram);
        Ok(BasinPoints {
            scene: self.clone(),
            motion: self.motion()?,
            setting: self.setting()?,
            membrane,
            left: 0..grid.starts(),
            grid,
            pace: Pace::new(execution.together()),
            block: Vec::new().into_iter(),
            known: Vec::new(),
        })
    }
}

/// The starts of a grid, one after the other.
#[derive(Debug)]
pub struct BasinPoints {
    scene: Scene,
    grid: StartGrid,
    motion: Motion<f64>,
    setting: Setting,
    /// With the unit of velocity, m/s.
    membrane: Option<(Membrane<f64>, f64)>,
    left: Range<u64>,
    pace: Pace,
    block: IntoIter<Result<Simulated, SceneError>>,
    /// The cycles without a rest that starts have led to.
    known: Vec<ReachedAttractor>,
}

/// A start, and what the motion from it has come to.
type Simulated = (super::Start, Followed);

impl BasinPoints {
    /// The grid.
    pub fn grid(&self) -> &StartGrid {
        &self.grid
    }

    /// Of these starts those of these numbers, from 0.
    pub fn starts(mut self, numbers: Range<u64>) -> Self {
        let (start, end) = (self.left.start, self.left.end);
        self.left = (start + numbers.start).min(end)..(start + numbers.end).min(end);
        self
    }

    /// What the motions from the starts of these numbers come to.
    fn simulated(&self, numbers: Range<u64>) -> Vec<Result<Simulated, SceneError>> {
        let along = u64::from(self.grid.phase.points);
        let start = |number: u64| super::Start {
            phase: self.grid.phase.value((number % along) as u32),
            velocity: self.grid.velocity.value((number / along) as u32),
            side: Side::Bottom,
            position: None,
        };
        let starts: Vec<_> = numbers.map(start).collect();
        let following = || Following {
            diagram: self.grid.diagram,
            depth: Depth::SteadyState,
            motion: &self.motion,
            parameters: &self.setting,
            membrane: self.membrane.as_ref().map(|(membrane, unit)| (membrane, *unit)),
        };
        let motions = starts.iter();
        let motions = motions.map(|start| (following(), Widening::new(&self.motion, &start.start())));
        let followed = follow(motions.collect(), self.execution());
        let reached = |(start, reached): (_, Result<_, _>)| match reached {
            Ok(reached) => Ok((start, reached)),
            Err(error) => Err(self.scene.error(None, error)),
        };
        starts.into_iter().zip(followed).map(reached).collect()
    }

    fn execution(&self) -> Execution {
        Execution::of(self.grid.starts(), &self.grid.diagram)
    }

    /// Where a motion leads: to a cycle that is known, or to one that is proved now if it can be.
    fn point(&mut self, (start, reached): Simulated) -> Result<BasinPoint, SceneError> {
        let cycle = reached.settled.attractor;
        let attractor = match reached.means {
            Some(means) => Some(self.attractor(cycle.as_ref(), means.rate)?),
            // without means the motion has ended, nobody knows where
            None => None,
        };
        Ok(BasinPoint {
            phase: start.phase,
            velocity: start.velocity,
            attractor,
        })
    }

    fn attractor(
        &mut self,
        cycle: Option<&Attractor>,
        voltage_rate: Option<Estimate>,
    ) -> Result<ReachedAttractor, SceneError> {
        let mut found = ReachedAttractor {
            word: cycle.map(|cycle| cycle.word.clone()),
            periods: cycle.and_then(|cycle| cycle.periods),
            phases: Vec::new(),
            velocities: Vec::new(),
            error_bound: None,
            voltage_rate,
            starts: 1,
            releases: Vec::new(),
        };
        if let Some(resting) = cycle.and_then(|cycle| cycle.resting.as_ref())
            && self.motion.other_forcing().is_some()
        {
            let mut releases = Vec::new();
            let seen = resting.visit(&self.setting, |event| {
                if event.kind == Kind::Release {
                    releases.push(event.phase);
                }
            });
            seen.map_err(|error| self.scene.error(None, error))?;
            found.releases = releases;
        }
        let Some(cycle) = cycle.filter(|cycle| !cycle.rests()) else {
            return Ok(found);
        };
        found.phases = cycle.impacts.iter().map(|impact| impact.phase).collect();
        found.velocities = cycle.impacts.iter().map(|impact| impact.velocity).collect();
        if let Some(known) = self.known.iter().find(|known| known.is_same(&found)) {
            return Ok(ReachedAttractor {
                voltage_rate,
                ..known.clone()
            });
        }
        let proved = cycle.proved(&self.setting);
        if let Some(orbit) = proved.map_err(|error| self.scene.error(None, error))? {
            found.phases = orbit.phases;
            found.velocities = orbit.velocities;
            found.error_bound = orbit.error_bound;
        }
        self.known.push(found.clone());
        Ok(found)
    }

    /// Where the start of this number leads; `None` where there is none of that number.
    ///
    /// # Errors
    /// None but a fault of ours.
    pub fn at(&mut self, number: u64) -> Result<Option<BasinPoint>, SceneError> {
        let number = number.min(self.grid.starts());
        let simulated = self.simulated(number..(number + 1).min(self.grid.starts())).pop();
        simulated.map(|simulated| self.point(simulated?)).transpose()
    }

    fn fill(&mut self) {
        let token = Token::current();
        let mut pace = self.pace;
        let execution = self.execution();
        let most = execution.most(&self.grid.diagram);
        let block: Vec<_> = pace.block(most.min(self.left.end - self.left.start), |size| {
            let numbers = execution.parts(self.left.start..(self.left.start + size).min(self.left.end));
            let simulated = numbers.into_par_iter();
            let simulated = simulated.flat_map_iter(|part| token.during(|| self.simulated(part)));
            simulated.collect()
        });
        self.pace = pace;
        self.left.start += block.len() as u64;
        self.block = block.into_iter();
    }
}

impl Iterator for BasinPoints {
    type Item = Result<BasinPoint, SceneError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.block.len() == 0 {
            self.fill();
        }
        // what was stopped on its way is no point
        let next = self.block.next().filter(|_| !Token::current().is_stopped())?;
        Some(next.and_then(|simulated| self.point(simulated)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cycle(phases: &[f64], velocities: &[f64]) -> ReachedAttractor {
        ReachedAttractor {
            word: Some("BT".to_owned()),
            periods: Some(1),
            phases: phases.to_vec(),
            velocities: velocities.to_vec(),
            error_bound: None,
            voltage_rate: None,
            starts: 1,
            releases: Vec::new(),
        }
    }

    #[test]
    fn cycles_through_rests_are_one_where_they_share_a_release() {
        let at = |releases: &[f64]| ReachedAttractor {
            word: Some("B*".to_owned()),
            releases: releases.to_vec(),
            ..cycle(&[], &[])
        };
        assert!(at(&[1.0, 4.0]).is_same(&at(&[4.0])) && at(&[]).is_same(&at(&[])));
        assert!(!at(&[1.0]).is_same(&at(&[4.0])));
    }

    #[test]
    fn cycles_are_one_where_an_impact_of_the_one_is_an_impact_of_the_other() {
        let one = cycle(&[1e-9, 3.0], &[0.7, -0.5]);
        assert!(one.is_same(&cycle(&[TAU - 1e-9, 3.0], &[0.7, -0.5])));
        assert!(one.is_same(&cycle(&[3.0, 0.0], &[-0.5, 0.7])));
        assert!(!one.is_same(&cycle(&[1e-5, 3.0], &[0.7, -0.5])));
        assert!(!one.is_same(&cycle(&[0.0, 3.0], &[-0.7, 0.5])));
        let longer = ReachedAttractor {
            periods: Some(2),
            ..one.clone()
        };
        assert!(!one.is_same(&longer));
        let chaos = ReachedAttractor {
            word: None,
            ..cycle(&[], &[])
        };
        assert!(chaos.is_same(&chaos) && !chaos.is_same(&one) && !one.is_same(&chaos));
    }

    #[test]
    fn each_attractor_is_counted_under_its_first_number() {
        let mut all = ReachedAttractors::default();
        let [one, other] = [cycle(&[1.0, 3.0], &[0.7, -0.5]), cycle(&[2.0, 3.0], &[0.7, -0.5])];
        let numbers = [&one, &other, &one, &one].map(|found| all.add(found.clone()));
        assert_eq!(numbers, [0, 1, 0, 0]);
        assert_eq!(all.list.iter().map(|found| found.starts).collect::<Vec<_>>(), [3, 1]);
        let fraction = all.list[0].fraction(4);
        let error = fraction.error.unwrap();
        assert!(fraction.value == 0.75 && (error - 0.035_f64.sqrt()).abs() < 1e-15);
        assert!(all.list[0].fraction(3).error > Some(0.1));
    }
}
