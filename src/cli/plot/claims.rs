//! What the paper prints, where it belongs in its figures.

use super::super::Failure;
use crate::model::{Motion, Side};
use crate::reference::{Directory, Printed, Wanted};
use crate::report::figure::Claim;
use crate::scene::{self, Over, Scene};

/// The rows of the paper's printed.csv that have a place in a figure.
pub(super) struct Claims {
    rows: Vec<Row>,
}

/// A printed number of a motion.
struct Row {
    claim: Claim,
    column: Column,
    /// Of the motion that the row is about; its gap is that of the claim.
    motion: Motion<f64>,
}

/// What is printed of the impacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Velocity,
    Phase,
    /// Of one impact.
    Voltage,
    Mean,
}

/// Numbers of fewer figures are the ends of a range, not points.
const FEWEST_FIGURES: usize = 3;

/// Motions whose parameters differ by less are one.
const SAME: f64 = 1e-12;

impl Claims {
    /// From the printed values that the program carries with it; verdicts are those that `check` holds them to.
    ///
    /// # Errors
    /// None: a test reads them.
    pub fn read() -> Result<Self, Failure> {
        let mut rows = Vec::new();
        for printed in Directory::BuiltIn.printed()? {
            rows.extend(row(&printed)?);
        }
        Ok(Self { rows })
    }

    /// Those of a column at any gap, for a sweep over the gap of a scene of the paper.
    pub fn along(&self, scene: &Scene, column: Column) -> Vec<Claim> {
        let sweep = scene.sweep().ok().filter(|sweep| sweep.over == Over::D);
        let Some(sweep) = sweep.filter(|_| scene::find(scene.name()).is_some()) else {
            return Vec::new();
        };
        let Ok(motion) = scene.swept::<f64>(Over::D, &sweep.from) else {
            return Vec::new();
        };
        let own = self
            .rows
            .iter()
            .filter(|row| row.column == column && is_same(&row.motion, &motion));
        own.map(|row| row.claim.clone()).collect()
    }

    /// The velocities at this very motion of a scene of the paper, at (Z, Zdot).
    pub fn at(&self, scene: &Scene) -> Vec<Claim> {
        let Some(motion) = scene
            .motion::<f64>()
            .ok()
            .filter(|_| scene::find(scene.name()).is_some())
        else {
            return Vec::new();
        };
        let here = |row: &&Row| {
            let is_there = (row.claim.at.0 - motion.d()).abs() < SAME;
            row.column == Column::Velocity && is_there && is_same(&row.motion, &motion)
        };
        let own = self
            .rows
            .iter()
            .filter(here)
            .filter(|row| row.claim.bifurcation.is_none());
        own.map(|row| {
            let (d, velocity) = row.claim.at;
            Claim {
                at: (velocity.signum() * d / 2.0, velocity),
                ..row.claim.clone()
            }
        })
        .collect()
    }
}

/// Whether two motions differ in the gap alone, if at all.
fn is_same(one: &Motion<f64>, other: &Motion<f64>) -> bool {
    let parameters = |motion: &Motion<f64>| {
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| *motion.restitution(side));
        [*motion.g(), r_b, r_t]
    };
    let pairs = parameters(one).into_iter().zip(parameters(other));
    pairs.into_iter().all(|(one, other)| (one - other).abs() < SAME)
}

/// The row's claim, where it is about the impacts of a motion at a known gap and prints a number.
fn row(printed: &Printed) -> Result<Option<Row>, Failure> {
    let Some(quantity) = printed.quantity.as_ref().filter(|quantity| quantity.across.is_none()) else {
        return Ok(None);
    };
    let column = match quantity.field.column.as_str() {
        "velocities" | "velocity" => Column::Velocity,
        "phases" | "phase" => Column::Phase,
        "voltage" | "voltages" | "bottom_voltage" | "top_voltage" => Column::Voltage,
        "mean_voltage" => Column::Mean,
        _ => return Ok(None),
    };
    let text = printed.printed();
    let figures = text
        .trim_start_matches(['-', '0', '.'])
        .bytes()
        .filter(u8::is_ascii_digit)
        .count();
    let Some(value) = text.parse::<f64>().ok().filter(|_| figures >= FEWEST_FIGURES) else {
        return Ok(None);
    };
    let name = printed.record.field("scene");
    let name = name
        .strip_prefix("scenes/")
        .and_then(|name| name.strip_suffix(".toml"))
        .unwrap_or(name);
    let Some(text_of_scene) = scene::find(name) else {
        return Ok(None);
    };
    let mut scene = Scene::read(text_of_scene, name)?;
    for (key, value) in &printed.setting.overrides {
        scene.set(&format!("{key}={value}"))?;
    }
    let selected = |column: &str| {
        let selector = printed
            .setting
            .selectors
            .iter()
            .find(|selector| selector.field.column == column);
        selector.map(|selector| &selector.wanted)
    };
    let gap = match (selected("d"), quantity.command.as_str()) {
        (Some(Wanted::Number(figures) | Wanted::Nearest(figures)), _) => Some(figures.value.0.to_f64().value()),
        (_, "orbits" | "simulate") => scene.motion::<f64>().ok().map(|motion| *motion.d()),
        // of a sweep, where it has one value
        _ => scene
            .sweep()
            .ok()
            .filter(|sweep| sweep.points == 1)
            .map(|sweep| sweep.from.value::<f64>()),
    };
    let motion = match scene.sweep() {
        Ok(sweep) if sweep.over == Over::D => scene.swept::<f64>(Over::D, &sweep.from).ok(),
        _ => scene.motion::<f64>().ok(),
    };
    let (Some(gap), Some(motion)) = (gap, motion) else {
        return Ok(None);
    };
    let bifurcation = match selected("kind") {
        Some(Wanted::Word(kind)) if kind != "point" => Some(kind.clone()),
        _ => None,
    };
    let claim = Claim {
        at: (gap, value),
        printed: text.replace('-', "\u{2212}"),
        verdict: printed.expected,
        bifurcation,
    };
    Ok(Some(Row { claim, column, motion }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Verdict;

    fn built_in(name: &str) -> Scene {
        Scene::read(scene::find(name).unwrap(), name).unwrap()
    }

    #[test]
    fn a_figure_has_the_values_printed_of_its_motion_and_no_others() {
        let claims = Claims::read().unwrap();
        let found = claims.along(&built_in("fig02"), Column::Velocity);
        let at = |at: (f64, f64)| found.iter().filter(|claim| claim.at == at).collect::<Vec<_>>();
        assert!(
            at((0.4, 0.83272))
                .iter()
                .any(|claim| claim.verdict == Verdict::Reproduced)
        );
        assert!(
            at((0.26, 0.677449))
                .iter()
                .any(|claim| claim.bifurcation.as_deref() == Some("period-doubling"))
        );
        assert!(at((0.33, 0.729028)).is_empty() && at((0.5, 1.0)).is_empty());
        assert!(claims.along(&built_in("fig07"), Column::Phase).is_empty());
    }

    #[test]
    fn figure_11_has_the_velocities_and_phases_that_figures_12_and_13_start_from() {
        let claims = Claims::read().unwrap();
        let printed = |column| -> Vec<(f64, f64)> {
            let found = claims.along(&built_in("fig11"), column);
            found.iter().map(|claim| claim.at).collect()
        };
        assert_eq!(printed(Column::Phase), [(0.33, 1.21387), (0.25, 0.922985)]);
        assert!(printed(Column::Velocity).contains(&(0.25, 0.689829)));
    }

    #[test]
    fn a_phase_portrait_has_the_printed_velocity_at_the_wall() {
        let claims = Claims::read().unwrap();
        let found = claims.at(&built_in("fig12"));
        assert!(found.iter().any(|claim| claim.at == (0.165, 0.729028)));
        let mut other = built_in("fig12");
        other.set("motion.r_b=0.61").unwrap();
        assert!(claims.at(&other).is_empty());
    }
}
