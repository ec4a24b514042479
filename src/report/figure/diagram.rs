//! A bifurcation diagram: simulated impacts under the branches of periodic motions.

use super::branch::{self, Bifurcation};
use super::claim::{self, Claim};
use super::parameter::Parameter;
use super::step::{Quantity, Step};
use crate::report::plot::{Colour, Form, Marker, Panel, Point, Series};

/// An impact at a value of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// The value.
    pub at: f64,
    /// In [0, 2 pi).
    pub phase: f64,
    /// Just before: positive at the bottom, negative at the top.
    pub velocity: f64,
}

/// All that a bifurcation diagram shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    pub parameter: Parameter,
    /// Simulated impacts; `None` where nothing was simulated.
    pub impacts: Option<Vec<Impact>>,
    /// Periodic motions in order of the parameter; `None` where none were followed.
    pub steps: Option<Vec<Step>>,
    /// What happens to them.
    pub bifurcations: Vec<Bifurcation>,
}

/// The looks of simulated impacts, at the bottom and at the top.
pub(super) const BOTTOM: Marker = Marker::dot(Colour::Sky, 2.8);
pub(super) const TOP: Marker = Marker {
    colour: Colour::Orange,
    form: Form::Triangle,
    filled: true,
    size: 2.8,
};

impl Diagram {
    /// The panel of one quantity, with what is printed of it.
    pub fn panel(&self, quantity: Quantity, claims: &[Claim]) -> Panel {
        let mut panel = Panel::new(self.parameter.axis(), quantity.axis());
        panel.heading = quantity.heading().to_owned();
        if let Some(impacts) = &self.impacts {
            let points = |is_bottom: bool| -> Vec<Point> {
                let own = impacts.iter().filter(|impact| (impact.velocity > 0.0) == is_bottom);
                own.map(|impact| {
                    let value = match quantity {
                        Quantity::Velocity => impact.velocity,
                        Quantity::Phase => impact.phase,
                    };
                    (impact.at, value)
                })
                .collect()
            };
            panel
                .series
                .push(Series::dots("simulated impacts, bottom", points(true), BOTTOM));
            panel
                .series
                .push(Series::dots("simulated impacts, top", points(false), TOP));
        }
        let steps = self.steps.as_deref().unwrap_or_default();
        panel.series.extend(branch::series(steps, &self.bifurcations, quantity));
        panel.series.extend(claim::series(claims));
        panel
    }
}

#[cfg(test)]
mod tests {
    use super::super::step::Course;
    use super::*;
    use crate::report::plot::Shape;

    #[test]
    fn impacts_are_told_apart_by_wall_and_a_branch_breaks_at_the_cut_of_the_circle() {
        let step = |at, phase| Step {
            at,
            name: "B".to_owned(),
            phases: vec![phase],
            velocities: vec![0.5],
            course: Course::Stable,
        };
        let impact = |velocity| Impact {
            at: 0.3,
            phase: 1.0,
            velocity,
        };
        let diagram = Diagram {
            parameter: Parameter::new("d", (0.1, 0.5)),
            impacts: Some(vec![impact(0.4), impact(-0.3), impact(-0.2)]),
            steps: Some(vec![step(0.2, 6.1), step(0.3, 6.2), step(0.4, 0.02), step(0.5, 0.1)]),
            bifurcations: Vec::new(),
        };
        let panel = diagram.panel(Quantity::Phase, &[]);
        let counts: Vec<usize> = panel
            .series
            .iter()
            .map(|series| match &series.shape {
                Shape::Dots { points, .. } => points.len(),
                Shape::Line { points, .. } => points.iter().filter(|point| point.0.is_nan()).count(),
                _ => 0,
            })
            .collect();
        assert_eq!(counts, [1, 2, 2]);
    }
}
