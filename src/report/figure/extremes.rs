//! Digits left over the distance to an extreme: a panel for each extreme, a line for each number and form.

use crate::accuracy::stress::{Approach, CurveRow, Form};
use crate::report::plot::{Axis, Colour, Dash, Figure, Panel, Point, Series, Stroke, Ticks};

/// Panels side by side.
const COLUMNS: usize = 3;

/// The most formulas that a heading has room to name.
const MOST_NAMED: usize = 3;

/// The numbers by colour, the widest first: narrower ones stand above.
const NUMBERS: [(&str, Colour); 5] = [
    ("50-digits", Colour::Purple),
    ("decimal 30", Colour::Vermillion),
    ("double-double", Colour::Green),
    ("f64", Colour::Blue),
    ("f32", Colour::Orange),
];

/// The forms by dash; what stays above is drawn over what falls.
const FORMS: [(Form, Dash, f64); 2] = [(Form::Printed, Dash::Dashed, 1.8), (Form::Stable, Dash::Solid, 1.8)];

/// Every approach of some curves. Where an extreme has several formulas, a line is the fewest digits of them all.
pub fn extremes(rows: &[CurveRow]) -> Figure {
    let of = |approach: &Approach| rows.iter().filter(|row| row.approach == *approach).collect::<Vec<_>>();
    let found = Approach::ALL.iter().map(|approach| (approach, of(approach)));
    let panels: Vec<Panel> = found
        .filter(|(_, rows)| !rows.is_empty())
        .map(|(approach, rows)| panel(approach, &rows))
        .collect();
    Figure {
        columns: COLUMNS.min(panels.len().max(1)),
        panel_size: (450.0, 400.0),
        ..Figure::new("Digits left at the extremes, fewest of the formulas named", panels)
    }
}

fn panel(approach: &Approach, rows: &[&CurveRow]) -> Panel {
    let ticks = match approach.grows() {
        true => Ticks::Powers,
        false => Ticks::FallingPowers,
    };
    let mut panel = Panel::new(
        Axis::new(with_symbols(approach.distance)).with_ticks(ticks),
        Axis::new("correct digits"),
    );
    let mut formulas: Vec<&str> = rows.iter().map(|row| row.row.formula.as_str()).collect();
    formulas.dedup();
    let named = match formulas.as_slice() {
        [first, .., last] if formulas.len() > MOST_NAMED => format!("{first} to {last}"),
        _ => formulas.join(", "),
    };
    panel.heading = format!("{}: {named}", approach.name);
    for (number, colour) in NUMBERS {
        for (form, dash, width) in FORMS {
            let own = rows
                .iter()
                .filter(|row| row.row.number == number && row.row.form == form);
            let points = fewest(approach, own.map(|row| (row.distance, row.row.digits)));
            if !points.is_empty() {
                let name = format!("{number} {}", form.name());
                panel
                    .series
                    .push(Series::line(name, points, Stroke { colour, dash, width }));
            }
        }
    }
    let allowed = rows
        .iter()
        .filter(|row| row.row.number == "f64" && row.row.form == Form::Stable);
    let points = fewest(approach, allowed.map(|row| (row.distance, row.row.allowed)));
    let stroke = Stroke {
        colour: Colour::Black,
        dash: Dash::Dotted,
        width: 2.2,
    };
    panel.series.push(Series::line("f64 allowed", points, stroke));
    panel
}

/// Marks the letters that stand alone as symbols.
fn with_symbols(text: &str) -> String {
    let is_symbol = |word: &str| word.chars().count() == 1 && word.chars().all(char::is_alphabetic);
    let words = text.split(' ').map(|word| match is_symbol(word.trim_matches('|')) {
        true => format!("${word}$"),
        false => word.to_owned(),
    });
    words.collect::<Vec<_>>().join(" ")
}

/// At each distance the fewest digits.
fn fewest(approach: &Approach, found: impl Iterator<Item = (f64, f64)>) -> Vec<Point> {
    let mut points: Vec<Point> = found
        .map(|(distance, digits)| (approach.abscissa(distance), digits))
        .collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    points.dedup_by_key(|point| point.0);
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::stress::curves;

    #[test]
    fn a_panel_has_a_line_for_each_number_and_form_and_what_is_allowed() {
        let figure = extremes(&curves(Some("late time")).unwrap());
        let [panel] = figure.panels.as_slice() else {
            panic!("one extreme");
        };
        assert_eq!(panel.heading, "late time: f");
        assert_eq!(panel.series.len(), 4 * 2 + 1);
        let svg = figure.svg().expect("a figure");
        for text in ["double-double printed", "f64 stable", "f64 allowed", ">5</tspan>"] {
            assert!(svg.contains(text), "{text}");
        }
    }

    #[test]
    fn letters_alone_are_symbols() {
        assert_eq!(with_symbols("1 - |g| of d (that is)"), "1 - $|g|$ of $d$ (that is)");
    }

    #[test]
    fn of_several_digits_at_a_distance_the_fewest_are_drawn() {
        let approach = Approach::ALL[0];
        let found = [(1e-2, 5.0), (1e-1, 7.0), (1e-2, 3.0)];
        assert_eq!(fewest(&approach, found.into_iter()), [(1.0, 7.0), (2.0, 3.0)]);
    }
}
