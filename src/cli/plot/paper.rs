//! Every figure of the paper, nothing computed twice.

use super::super::Failure;
use super::claims::{Claims, Column};
use super::swept::Swept;
use crate::model::Side;
use crate::report::figure::{Claim, Curve, Parameter, comparison as curves};
use crate::report::plot::Figure;
use crate::scene::{self, Scene, Want};
use rayon::prelude::*;

/// The figure that compares the others.
const COMPARISON: &str = "fig14";

/// The scenes of the paper, changed and checked by `change`.
///
/// # Errors
/// Those of `change`.
pub(super) fn scenes(change: impl Fn(&mut Scene) -> Result<(), Failure>) -> Result<Vec<Scene>, Failure> {
    let mut scenes = scene::built_in()?;
    for scene in &mut scenes {
        change(scene)?;
    }
    Ok(scenes)
}

/// Whether this is the paper's comparison, as the program carries it.
pub(super) fn is_comparison(scene: &Scene) -> bool {
    scene.name() == COMPARISON
}

/// The sweeps of these scenes: of those that show the same, one for all.
pub(super) struct Shared {
    swept: Vec<(Scene, Swept)>,
}

/// Computes the sweeps of all scenes but the comparison, on all cores.
///
/// # Errors
/// What a sweep requires and a scene lacks.
pub(super) fn swept(scenes: &[Scene]) -> Result<Shared, Failure> {
    let mut different: Vec<&Scene> = Vec::new();
    for scene in scenes
        .iter()
        .filter(|scene| !is_comparison(scene) && scene.sweep().is_ok())
    {
        if !different.iter().any(|known| shows(known, scene)) {
            different.push(scene);
        }
    }
    let swept: Result<Vec<(Scene, Swept)>, Failure> = different
        .into_par_iter()
        .map(|scene| Ok((scene.clone(), Swept::new(scene)?)))
        .collect();
    Ok(Shared { swept: swept? })
}

/// The sweep that this scene shows.
pub(super) fn of<'a>(shared: &'a Shared, scene: &Scene) -> Option<&'a Swept> {
    scene.sweep().ok()?;
    let found = shared.swept.iter().find(|(known, _)| shows(known, scene));
    found.map(|(_, swept)| swept)
}

/// Whether the sweep of `one` has all that `other` wants of its own.
fn shows(one: &Scene, other: &Scene) -> bool {
    let wants = |scene: &Scene| scene.want().unwrap_or_default();
    let known = wants(one);
    let swept = [Want::Branch, Want::Sweep, Want::Voltage];
    let has_all = wants(other)
        .iter()
        .all(|want| known.contains(want) || !swept.contains(want));
    has_all
        && one.swept_setting().ok() == other.swept_setting().ok()
        && one.sweep().ok() == other.sweep().ok()
        && one.diagram().ok() == other.diagram().ok()
        && one.start().ok() == other.start().ok()
        && one.words().ok() == other.words().ok()
        && one.max_periods().ok() == other.max_periods().ok()
        && (!wants(other).contains(&Want::Voltage) || has_same_voltage(one, other))
}

/// Whether the same impact gives the same voltage.
fn has_same_voltage(one: &Scene, other: &Scene) -> bool {
    one.membrane::<f64>().ok() == other.membrane::<f64>().ok() && one.scales::<f64>().ok() == other.scales::<f64>().ok()
}

/// The mean voltages of all scenes that want voltage, in one panel.
///
/// # Errors
/// A title or a parameter that cannot be read.
pub(super) fn comparison(scene: &Scene, shared: &Shared, claims: &Claims) -> Result<Figure, Failure> {
    let mut found: Vec<Curve> = Vec::new();
    let mut groups: Vec<[f64; 2]> = Vec::new();
    let mut printed: Vec<Claim> = Vec::new();
    let mut parameter: Option<Parameter> = None;
    for (scene, swept) in &shared.swept {
        let Some(energy) = &swept.energy else { continue };
        let sweep = scene.sweep()?;
        let motion = scene.swept::<f64>(sweep.over, &sweep.from)?;
        let walls = [Side::Bottom, Side::Top].map(|side| *motion.restitution(side));
        let group = groups.iter().position(|known| *known == walls).unwrap_or_else(|| {
            groups.push(walls);
            groups.len() - 1
        });
        found.push(Curve {
            name: scene.title()?.unwrap_or(scene.name()).to_owned(),
            group,
            member: found.iter().filter(|curve| curve.group == group).count(),
            mean: energy.mean.clone(),
        });
        printed.extend(claims.along(scene, Column::Mean));
        parameter.get_or_insert_with(|| energy.parameter.clone());
    }
    let title = scene.title()?.unwrap_or(scene.name());
    let parameter = parameter.ok_or_else(|| Failure::NothingDrawn(scene.name().to_owned()))?;
    let title = title.split_once(':').map_or(title, |(figure, _)| figure);
    Ok(Figure {
        panel_size: (1040.0, 500.0),
        ..Figure::new(
            format!("{title}: mean voltages of all figures"),
            vec![curves(&parameter, &found, &printed)],
        )
    })
}
