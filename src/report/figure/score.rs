//! Digits of somebody's answers, problem by problem; and what more of them cost.

use crate::accuracy::problems::{Kind, Level};
use crate::accuracy::score::{Precision, Rating};
use crate::report::plot::{Axis, Colour, Dash, Form, Marker, Panel, Point, Series, Shape, Stroke, Ticks};

/// The looks of the levels.
const LOOKS: [(Level, Marker); 3] = [
    (Level::Easy, sized(Colour::Green, Form::Circle)),
    (Level::Hard, sized(Colour::Blue, Form::Triangle)),
    (Level::Extreme, sized(Colour::Vermillion, Form::Diamond)),
];

const fn sized(colour: Colour, form: Form) -> Marker {
    Marker {
        size: 6.0,
        ..Marker::filled(colour, form)
    }
}

/// The digits of a double.
const DOUBLE: f64 = 15.95;

/// A panel for each kind of problem that is asked: the digits of each quantity over the problems in order.
pub fn digits(ratings: &[Rating]) -> Vec<Panel> {
    let kinds = Kind::ALL.into_iter();
    kinds.filter_map(|kind| of_kind(kind, ratings)).collect()
}

fn of_kind(kind: Kind, ratings: &[Rating]) -> Option<Panel> {
    let own: Vec<&Rating> = ratings.iter().filter(|rating| rating.kind == kind).collect();
    let mut problems: Vec<&str> = own.iter().map(|rating| rating.problem).collect();
    problems.dedup();
    let place = |rating: &Rating| problems.iter().position(|name| *name == rating.problem);
    let at = |rating: &Rating, digits: f64| -> Option<Point> { Some((place(rating)? as f64 + 1.0, digits)) };
    if problems.is_empty() {
        return None;
    }
    let x = Axis::over(
        "problem of this kind, in the order of `problems`",
        (0.0, problems.len() as f64 + 1.0),
    );
    let mut panel = Panel::new(x, Axis::over("digits", (-1.0, 31.0)));
    panel.heading = kind.name().to_owned();
    let guide = Stroke {
        colour: Colour::Grey,
        dash: Dash::Dashed,
        width: 1.0,
    };
    let shape = Shape::Horizontals {
        at: vec![DOUBLE],
        stroke: guide,
    };
    panel.series.push(Series {
        name: "all digits of a double".to_owned(),
        shape,
    });
    for (level, marker) in LOOKS {
        let level_own = own.iter().filter(|rating| rating.level == level);
        let points = level_own.filter_map(|rating| at(rating, rating.digits?)).collect();
        panel.series.push(Series::dots(level.name(), points, marker));
    }
    let silent = own.iter().filter(|rating| rating.digits.is_none());
    let points = silent.filter_map(|rating| at(rating, 0.0)).collect();
    let cross = Marker {
        size: 6.0,
        ..Marker::open(Colour::Grey, Form::Cross)
    };
    panel.series.push(Series::dots("not answered", points, cross));
    Some(panel)
}

/// Worst and median digits over the seconds that a program took for all problems at one tolerance after the other.
pub fn work_precision(runs: &[(f64, Precision)]) -> Panel {
    let mut panel = Panel::new(
        Axis::new("seconds for all problems").with_ticks(Ticks::Powers),
        Axis::new("digits"),
    );
    panel.heading = "Work and precision".to_owned();
    let mut curve = |name: &str, digits: fn(&Precision) -> Option<f64>, marker: Marker, dash: Dash| {
        let point = |(seconds, run): &(f64, Precision)| (seconds.log10(), digits(run).unwrap_or(f64::NAN));
        let points: Vec<Point> = runs.iter().map(point).collect();
        let (colour, width) = (marker.colour, 1.5);
        let shape = Shape::Marked {
            marked: points.clone(),
            points,
            stroke: Stroke { colour, dash, width },
            marker,
        };
        let name = name.to_owned();
        panel.series.push(Series { name, shape });
    };
    let (circle, wedge) = (
        sized(Colour::Blue, Form::Circle),
        sized(Colour::Vermillion, Form::Wedge),
    );
    curve("median of what is answered", |run| run.median, circle, Dash::Solid);
    curve("worst of what is answered", |run| run.worst, wedge, Dash::Dashed);
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rating(problem: &'static str, level: Level, digits: Option<f64>) -> Rating {
        let (quantity, kind) = ("time".to_owned(), Kind::Run);
        Rating {
            problem,
            quantity,
            digits,
            seconds: None,
            kind,
            level,
        }
    }

    fn points(series: &Series) -> &[Point] {
        match &series.shape {
            Shape::Dots { points, .. } | Shape::Marked { points, .. } => points,
            _ => &[],
        }
    }

    #[test]
    fn every_quantity_stands_over_its_problem_under_its_level() {
        let ratings = [
            rating("a", Level::Easy, Some(9.0)),
            rating("a", Level::Easy, Some(3.0)),
            rating("b", Level::Extreme, None),
            rating("c", Level::Extreme, Some(0.0)),
        ];
        let panels = digits(&ratings);
        assert_eq!(panels.len(), 1);
        let drawn: Vec<(&str, &[Point])> = panels[0]
            .series
            .iter()
            .map(|series| (series.name.as_str(), points(series)))
            .collect();
        assert!(drawn.contains(&("easy", &[(1.0, 9.0), (1.0, 3.0)][..])), "{drawn:?}");
        assert!(
            drawn.contains(&("extreme", &[(3.0, 0.0)][..])) && drawn.contains(&("not answered", &[(2.0, 0.0)][..]))
        );
    }

    #[test]
    fn a_tolerance_at_which_nothing_is_answered_breaks_the_curve() {
        let run = |seconds, digits| {
            let ratings = [rating("a", Level::Easy, digits)];
            (seconds, Precision::of(&ratings))
        };
        let panel = work_precision(&[run(0.1, Some(3.0)), run(1.0, None), run(10.0, Some(9.0))]);
        let median = points(&panel.series[0]);
        assert_eq!((median[0], median[2]), ((-1.0, 3.0), (1.0, 9.0)));
        assert!(median[1].1.is_nan());
    }
}
