//! Cost against digits: a panel for each task, the front as a line.

use crate::accuracy::TradeRow;
use crate::number::Rung;
use crate::report::plot::{Axis, Colour, Dash, Figure, Form, Mark, Marker, Panel, Point, Series, Stroke};

/// Panels side by side.
const COLUMNS: usize = 3;

/// The numbers, by colour and form.
const NUMBERS: [(Rung, Colour, Form); 4] = [
    (Rung::Single, Colour::Orange, Form::Triangle),
    (Rung::Double, Colour::Blue, Form::Circle),
    (Rung::DoubleDouble, Colour::Green, Form::Square),
    (Rung::Wide(50), Colour::Purple, Form::Diamond),
];

/// Every task of a trade, the time in latencies of one f64 sine and cosine on a logarithmic axis; what no means beats is
/// filled, named and joined by a line.
pub fn trades(rows: &[TradeRow], machine: &str) -> Figure {
    let mut tasks: Vec<&str> = Vec::new();
    for row in rows {
        if !tasks.contains(&row.task.as_str()) {
            tasks.push(&row.task);
        }
    }
    let of_task = |task: &str| rows.iter().filter(|row| row.task == task).collect::<Vec<_>>();
    let panels: Vec<Panel> = tasks.iter().map(|task| panel(task, &of_task(task))).collect();
    Figure {
        columns: COLUMNS.min(panels.len().max(1)),
        ..Figure::new(format!("Digits against time, {machine}"), panels)
    }
}

fn at(row: &TradeRow) -> Point {
    (row.latencies.log10(), row.digits)
}

fn panel(task: &str, rows: &[&TradeRow]) -> Panel {
    let mut panel = Panel::new(
        Axis::new("log10 of time / L, L the latency of an f64 sin_cos"),
        Axis::new("digits that 19 of 20 problems keep"),
    );
    panel.heading = task.to_owned();
    let mut front: Vec<Point> = rows.iter().filter(|row| row.on_front).map(|row| at(row)).collect();
    front.sort_by(|one, other| one.0.total_cmp(&other.0));
    let stroke = Stroke {
        colour: Colour::Black,
        dash: Dash::Dotted,
        width: 1.0,
    };
    panel.series.push(Series::line("front", front, stroke));
    for (number, colour, form) in NUMBERS {
        let of_number = rows.iter().filter(|row| row.number == number);
        let (on, off): (Vec<&TradeRow>, Vec<&TradeRow>) = of_number.partition(|row| row.on_front);
        let open = Marker::open(colour, form);
        let filled = Marker { filled: true, ..open };
        let mark = |row: &&TradeRow| Mark {
            at: at(row),
            label: if row.on_front {
                row.method.to_owned()
            } else {
                String::new()
            },
        };
        let mut name = number.to_string();
        for (rows, marker) in [(on, filled), (off, open)] {
            if !rows.is_empty() {
                // the legend names a number once
                let marks = rows.iter().map(mark).collect();
                panel
                    .series
                    .push(Series::marks(std::mem::take(&mut name), marks, marker));
            }
        }
    }
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(task: &str, method: &'static str, number: Rung, on_front: bool) -> TradeRow {
        TradeRow {
            task: task.to_owned(),
            number,
            method,
            operations: 1,
            seconds: 1e-6,
            digits: 12.0,
            on_front,
            worst: 11.0,
            solved: 1,
            problems: Vec::new(),
            divisions: 0,
            sincos: 0,
            spread: 0.0,
            latencies: 60.0,
        }
    }

    #[test]
    fn each_task_has_a_panel_and_only_the_front_is_named() {
        let rows = [
            row("orbit", "newton", Rung::Double, true),
            row("orbit", "secant", Rung::Double, false),
            row("impact", "own", Rung::DoubleDouble, true),
        ];
        let svg = trades(&rows, "a machine").svg().expect("a figure");
        for text in ["orbit", "impact", "newton", "own", "a machine", "double-double"] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(!svg.contains("secant"));
    }
}
