//! What a sweep shows: simulated impacts, branches, voltages.

use super::super::motions::Motions;
use super::super::{Failure, note};
use super::claims::{Claims, Column};
use crate::model::Side;
use crate::orbit::{OutputPrecision, RoundedOrbit, Word};
use crate::report::figure::{Bifurcation, Course, Diagram, Energy, Impact, Parameter, Quantity, Step};
use crate::report::plot::{Panel, Point};
use crate::scene::{Quantity as Value, Scene, Want};

/// Impacts that are drawn, at most: with them a figure is made in less than 200 MB.
const MOST_IMPACTS: u64 = 500_000;

/// Values at which motions of a word over so many periods are drawn, over all of these, at most: for the same reason.
const MOST_STEPS: u64 = 50_000;

/// The diagrams of a scene over its sweep.
#[derive(Clone, Debug)]
pub(super) struct Swept {
    diagram: Diagram,
    /// Where the scene wants voltage.
    pub energy: Option<Energy>,
}

impl Swept {
    /// Computes all that the scene wants along its sweep.
    ///
    /// # Errors
    /// What the sweep requires and the scene lacks.
    pub fn new(scene: &Scene) -> Result<Self, Failure> {
        let wants = scene.want()?;
        let sweep = scene.sweep()?;
        let [from, to] = [&sweep.from, &sweep.to].map(|end| end.value::<f64>());
        let mut diagram = Diagram {
            parameter: Parameter::new(sweep.over.name(), (from.min(to), from.max(to))),
            impacts: None,
            steps: None,
            bifurcations: Vec::new(),
        };
        let is_simulated = wants.contains(&Want::Sweep) || wants.contains(&Want::Voltage);
        let points = u64::from(sweep.points);
        let is_followed = wants.contains(&Want::Branch) && !scene.branches_over_two();
        if is_followed {
            let kinds = scene.words()?.len() as u64 * u64::from(scene.max_periods()?);
            allowed(points * kinds, "values of motions", MOST_STEPS, "max_periods")?;
        }
        if is_simulated {
            let keep = u64::from(scene.diagram()?.keep);
            allowed(points * keep, "impacts", MOST_IMPACTS, "sweep.keep")?;
        }
        if is_followed {
            follow(scene, &mut diagram)?;
        }
        let mut energy = None;
        if is_simulated {
            energy = simulate(scene, &mut diagram)?;
        }
        Ok(Self { diagram, energy })
    }

    /// Velocity, and the voltage or the phase beside it, with what the paper prints of them.
    ///
    /// # Errors
    /// What is not known of the scene.
    pub fn panels(&self, scene: &Scene, claims: &Claims) -> Result<[Panel; 2], Failure> {
        let velocity = claims.along(scene, Column::Velocity);
        let second = match self
            .energy
            .as_ref()
            .filter(|_| scene.want().is_ok_and(|wants| wants.contains(&Want::Voltage)))
        {
            Some(energy) => {
                let mut printed = claims.along(scene, Column::Mean);
                printed.extend(claims.along(scene, Column::Voltage));
                energy.panel(&printed)
            }
            None => self.diagram.panel(Quantity::Phase, &claims.along(scene, Column::Phase)),
        };
        Ok([self.diagram.panel(Quantity::Velocity, &velocity), second])
    }
}

/// Refuses what is too much before anything is computed.
pub(super) fn allowed(count: u64, what: &'static str, most: u64, other: &'static str) -> Result<(), Failure> {
    match count <= most {
        true => Ok(()),
        false => Err(Failure::TooMuchDrawn {
            count,
            what,
            most,
            other,
        }),
    }
}

/// The motions of the wanted words along the sweep.
fn follow(scene: &Scene, diagram: &mut Diagram) -> Result<(), Failure> {
    let (sweep, setting, options) = (scene.sweep()?, scene.swept_setting()?, scene.options()?);
    let kinds = scene.words_and_periods()?;
    let mut steps = Vec::new();
    for (word, periods) in &kinds {
        let motions = Motions::new(&setting, &sweep, word, *periods, &options)?;
        let parting = motions.parting(&setting, &sweep, &options, scene.switches()?, &kinds);
        let parting = parting
            .into_iter()
            .map(|followed| (followed.word(), Motions::Others(followed)));
        for ((word, periods), motions) in std::iter::once(((word.clone(), *periods), motions)).chain(parting) {
            steps.extend(drawn(scene, &motions, &word, periods, diagram)?);
        }
    }
    diagram.steps = Some(steps);
    Ok(())
}

/// The motions at each value, from left to right; their bifurcations are added to the diagram.
fn drawn(
    scene: &Scene,
    motions: &Motions,
    word: &Word,
    periods: u32,
    diagram: &mut Diagram,
) -> Result<Vec<Step>, Failure> {
    let name = match periods {
        1 => word.to_string(),
        _ => format!("{word} {periods}T"),
    };
    let (events, open) = motions.bifurcations();
    open.iter().for_each(|open| note(&format!("{}: {open}", scene.name())));
    let events = events.into_iter().map(|event| Bifurcation {
        step: Step {
            at: event.parameter,
            name: name.clone(),
            phases: event.phases,
            velocities: event.velocities,
            course: Course::of(false, event.admissible),
        },
        event: event.kind,
    });
    diagram.bifurcations.extend(events);
    let values: Vec<Value> = scene.sweep()?.values().collect();
    let found = motions.points_as(&OutputPrecision::DOUBLES, &values)?;
    let of_value = values.iter().zip(found).flat_map(|(value, found)| {
        let at = value.value::<f64>();
        found.orbits.into_iter().map(move |orbit| (at, orbit))
    });
    let mut own: Vec<Step> = of_value.map(|(at, orbit)| step(at, &name, orbit)).collect();
    own.sort_by(|one, other| one.at.total_cmp(&other.at));
    Ok(own)
}

fn step(at: f64, name: &str, orbit: RoundedOrbit) -> Step {
    Step {
        at,
        name: name.to_owned(),
        course: Course::of(orbit.stable, orbit.admissible),
        phases: orbit.phases,
        velocities: orbit.velocities,
    }
}

/// The impacts at each value, and their voltages where they are wanted.
fn simulate(scene: &Scene, diagram: &mut Diagram) -> Result<Option<Energy>, Failure> {
    let mut impacts = Vec::new();
    let mut walls: [Vec<Point>; 2] = [Vec::new(), Vec::new()];
    let mut mean: Vec<Point> = Vec::new();
    let wanted = scene.want()?.contains(&Want::Voltage);
    let points = scene.points()?;
    // the mean is drawn, where voltage is
    for point in if wanted { points } else { points.listed() } {
        let point = point?;
        let at = point.value.value::<f64>();
        impacts.extend(point.settled.kept.iter().map(|event| Impact {
            at,
            phase: event.phase,
            velocity: event.velocity,
        }));
        let Some(voltages) = &point.voltages else { continue };
        for (event, voltage) in point.settled.kept.iter().zip(voltages) {
            walls[usize::from(event.side == Side::Top)].push((at, *voltage));
        }
        let found = point.means.and_then(|means| means.voltage);
        mean.push((at, found.map_or(f64::NAN, |mean| mean.value)));
    }
    diagram.impacts = Some(impacts);
    mean.sort_by(|one, other| one.0.total_cmp(&other.0));
    let [bottom, top] = walls;
    let parameter = diagram.parameter.clone();
    Ok(wanted.then_some(Energy {
        parameter,
        bottom,
        top,
        mean,
    }))
}
