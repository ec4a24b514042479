//! The map and the basins of a scene as figures.

use super::super::{Failure, note};
use crate::report::figure::{HeatMap, Layer, Parameter, UNDECIDED};
use crate::report::plot::{Mark, Panel, Ticks};
use crate::scene::{MapWant, Means, ReachedAttractors, Scene, Spaced};

/// Points that are drawn, at most: more are not told apart.
const MOST_POINTS: u64 = 500_000;

/// A panel for each thing that the map wants; of several starts the first one.
pub(super) fn panels(scene: &Scene) -> Result<Vec<Panel>, Failure> {
    let points = scene.map_points()?;
    let map = points.grid().clone();
    super::swept::allowed(
        u64::from(map.x.points) * u64::from(map.y.points),
        "points of a map",
        MOST_POINTS,
        "map.x.points",
    )?;
    if map.starts.len() > 1 {
        note("the map is drawn for the first of its starts");
    }
    let mut words = Vec::new();
    let mut means: Vec<Option<Means>> = Vec::new();
    for found in points {
        let found = found?;
        if found.start == 0 {
            let attractor = found.point.settled.attractor.as_ref();
            words.push(attractor.map_or(String::new(), |found| found.word.clone()));
            means.push(found.point.means);
        }
    }
    let layer = |want: &MapWant| match want {
        MapWant::Word => Layer::Words {
            name: "impacts of a cycle (B bottom, T top, * rest)".to_owned(),
            words: words.clone(),
        },
        MapWant::MeanVoltage => values(&means, "mean voltage of an impact", "kV", |means| {
            means.voltage.map(|found| found.value / 1000.0)
        }),
        MapWant::VoltageRate => values(&means, "voltage per forcing period", "kV", |means| {
            means.rate.map(|found| found.value / 1000.0)
        }),
        MapWant::Lyapunov => values(&means, "Lyapunov exponent", "$\u{3c9}/\u{3c0}$", |means| {
            means.lyapunov.map(|found| found.value)
        }),
    };
    let parameter = |range: &crate::scene::Sweep| {
        let [from, to] = [&range.from, &range.to].map(|end| end.value::<f64>());
        Parameter::new(range.over.name(), (from, to))
    };
    let heat_map = HeatMap {
        x: parameter(&map.x),
        y: parameter(&map.y),
        points: [map.x.points as usize, map.y.points as usize],
        layers: map.wants.iter().map(layer).collect(),
        marks: (String::new(), Vec::new()),
    };
    Ok(heat_map.panels())
}

/// The starts in the colours of their attractors.
pub(super) fn basins(scene: &Scene) -> Result<Vec<Panel>, Failure> {
    let points = scene.basins()?;
    let grid = points.grid().clone();
    super::swept::allowed(grid.starts(), "starts", MOST_POINTS, "basins.phase.points")?;
    let mut all = ReachedAttractors::default();
    let mut words = Vec::new();
    for point in points {
        words.push(match point?.attractor {
            None => UNDECIDED.to_owned(),
            Some(found) => match (&found.word, all.add(found.clone()) + 1) {
                (Some(word), number) => format!("{number}: {word}"),
                (None, _) => String::new(),
            },
        });
    }
    let parameter = |name: &str, values: &Spaced| {
        let [from, to] = [&values.from, &values.to].map(|end| end.value::<f64>());
        Parameter::new(name, (from, to))
    };
    let heat_map = HeatMap {
        x: Parameter {
            ticks: Ticks::Pi,
            ..parameter("phase of the first impact, $\u{3c6}$  [rad]", &grid.phase)
        },
        y: parameter("impact velocity, $\u{17b}$  [$A\u{3c0}/(M\u{3c9})$]", &grid.velocity),
        points: [grid.phase.points as usize, grid.velocity.points as usize],
        layers: vec![Layer::Words {
            name: "attractor reached (B bottom, T top, * rest)".to_owned(),
            words,
        }],
        marks: ("bottom impacts of each cycle without rest".to_owned(), marks(&all)),
    };
    Ok(heat_map.panels())
}

/// The bottom impacts of each attractor that is a cycle, with its number.
fn marks(all: &ReachedAttractors) -> Vec<Mark> {
    let numbered = all.list.iter().zip(1..);
    let impacts = numbered.flat_map(|(found, number): (_, u32)| {
        let impacts = found.phases.iter().copied().zip(found.velocities.iter().copied());
        impacts.map(move |at| (at, number))
    });
    impacts
        .filter(|((_, velocity), _)| *velocity > 0.0)
        .map(|(at, number)| Mark {
            at,
            label: number.to_string(),
        })
        .collect()
}

fn values(means: &[Option<Means>], name: &str, unit: &str, of: fn(&Means) -> Option<f64>) -> Layer {
    Layer::Values {
        name: name.to_owned(),
        unit: unit.to_owned(),
        values: means
            .iter()
            .map(|means| means.as_ref().and_then(of).unwrap_or(f64::NAN))
            .collect(),
        ends: None,
    }
}
