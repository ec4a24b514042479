//! Branches of periodic motions as lines, and their bifurcations as marks.

use super::step::{Course, Quantity, Step};
use super::strand::strands;
use crate::orbit::BifurcationKind;
use crate::report::plot::{Colour, Form, Mark, Marker, Point, Series, Stroke};

/// What happens to a motion at a value of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Bifurcation {
    /// The motion.
    pub step: Step,
    pub event: BifurcationKind,
}

const WIDTH: f64 = 1.4;

/// The branches of each motion, dashed as they are stable, and their bifurcations.
pub(super) fn series(steps: &[Step], bifurcations: &[Bifurcation], quantity: Quantity) -> Vec<Series> {
    let mut names: Vec<&str> = Vec::new();
    for step in steps {
        if !names.contains(&step.name.as_str()) {
            names.push(&step.name);
        }
    }
    let mut series = Vec::new();
    for (name, colour) in names.iter().zip(Colour::LINES.iter().cycle()) {
        let of_name = |step: &&Step| step.name == *name;
        let own: Vec<&Step> = steps.iter().filter(of_name).collect();
        let folds = bifurcations.iter().filter(|found| found.event == BifurcationKind::Fold);
        let folds: Vec<&Step> = folds.map(|found| &found.step).filter(of_name).collect();
        let strands = strands(&own, &folds);
        for course in [Course::Inadmissible, Course::Unstable, Course::Stable] {
            let mut points = Vec::new();
            for strand in &strands {
                for impact in 0..strand.first().map_or(0, |step| step.velocities.len()) {
                    points.extend(run(strand, course, |step| quantity.of(step, impact)));
                }
            }
            if points.is_empty() {
                continue;
            }
            let colour = if course == Course::Inadmissible {
                Colour::Grey
            } else {
                *colour
            };
            let stroke = Stroke {
                colour,
                dash: course.dash(),
                width: WIDTH,
            };
            series.push(Series::line(format!("orbit {name}, {}", course.name()), points, stroke));
        }
    }
    series.extend(marks(bifurcations, quantity));
    series
}

/// The parts of a strand of this course, joined to what follows, with breaks between them.
fn run(strand: &[&Step], course: Course, value: impl Fn(&Step) -> f64) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    for pair in strand.windows(2) {
        let [one, other] = [pair[0], pair[1]].map(|step| (step.at, value(step)));
        let broken = Quantity::is_broken(one.1, other.1);
        if pair[0].course != course || broken {
            points.push((f64::NAN, f64::NAN));
            continue;
        }
        if points.last() != Some(&one) {
            points.push(one);
        }
        points.push(other);
    }
    points.dedup_by(|one, other| one.0.is_nan() && other.0.is_nan());
    if points.iter().all(|point| point.0.is_nan()) {
        points.clear();
    } else {
        points.push((f64::NAN, f64::NAN));
    }
    points
}

/// A marker for each kind; hollow and grey, as its line, where the motion would pass through a wall.
fn marks(bifurcations: &[Bifurcation], quantity: Quantity) -> Vec<Series> {
    let kinds = [
        (BifurcationKind::PeriodDoubling, "period doubling", Form::Diamond),
        (BifurcationKind::Fold, "fold", Form::Square),
        (BifurcationKind::SymmetryBreaking, "symmetry breaking", Form::Plus),
        (BifurcationKind::NodeFocus, "node\u{2013}focus switch", Form::Circle),
        (BifurcationKind::Grazing, "grazing", Form::Wedge),
    ];
    let mut series = Vec::new();
    for (event, name, form) in kinds {
        let found: Vec<&Step> = bifurcations
            .iter()
            .filter(|found| found.event == event)
            .map(|found| &found.step)
            .collect();
        for admissible in [true, false] {
            let of_course = found
                .iter()
                .filter(|step| (step.course != Course::Inadmissible) == admissible);
            let marks: Vec<Mark> = of_course
                .flat_map(|step| {
                    (0..step.velocities.len()).map(|impact| Mark {
                        at: (step.at, quantity.of(step, impact)),
                        label: String::new(),
                    })
                })
                .collect();
            if marks.is_empty() {
                continue;
            }
            let size = 7.0;
            let (name, marker) = match admissible {
                true => (name.to_owned(), Marker::filled(Colour::Purple, form)),
                false => (
                    format!("{name} of an unphysical orbit"),
                    Marker::open(Colour::Grey, form),
                ),
            };
            series.push(Series::marks(name, marks, Marker { size, ..marker }));
        }
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::Shape;

    fn step(at: f64, velocity: f64, course: Course) -> Step {
        Step {
            at,
            name: "BT".to_owned(),
            phases: vec![0.1, 3.0],
            velocities: vec![velocity, -velocity],
            course,
        }
    }

    #[test]
    fn a_branch_changes_its_dash_where_it_loses_stability_and_has_no_gap_there() {
        let courses = [Course::Unstable, Course::Unstable, Course::Stable, Course::Stable];
        let steps: Vec<Step> = courses
            .iter()
            .zip(0..)
            .map(|(course, i)| step(f64::from(i), 0.5, *course))
            .collect();
        let found = series(&steps, &[], Quantity::Velocity);
        let names: Vec<&str> = found.iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["orbit BT, unstable", "orbit BT, stable"]);
        let ends = |series: &Series| match &series.shape {
            Shape::Line { points, .. } => points
                .iter()
                .map(|point| point.0)
                .filter(|x| x.is_finite())
                .fold((9.0_f64, -9.0_f64), |(low, high), x| (low.min(x), high.max(x))),
            _ => (0.0, 0.0),
        };
        assert_eq!((ends(&found[0]), ends(&found[1])), ((0.0, 2.0), (2.0, 3.0)));
    }

    #[test]
    fn what_happens_to_a_motion_that_cannot_be_is_told_apart() {
        let at = |course| Bifurcation {
            step: step(0.3, 0.5, course),
            event: BifurcationKind::Grazing,
        };
        let found = marks(&[at(Course::Unstable), at(Course::Inadmissible)], Quantity::Phase);
        let colours: Vec<Colour> = found
            .iter()
            .filter_map(|series| match series.shape {
                Shape::Marks { marker, .. } => Some(marker.colour),
                _ => None,
            })
            .collect();
        assert_eq!(colours, [Colour::Purple, Colour::Grey]);
    }
}
