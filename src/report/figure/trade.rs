//! Cost against digits: a panel for each task, the front as a line.

use crate::accuracy::TradeRow;
use crate::number::Rung;
use crate::report::plot::{Axis, Colour, Dash, Figure, Form, Mark, Marker, Panel, Point, Series, Stroke, Ticks};

/// Panels side by side.
const COLUMNS: usize = 3;

/// The numbers, by colour and form.
const NUMBERS: [(Rung, Colour, Form); 4] = [
    (Rung::Single, Colour::Orange, Form::Triangle),
    (Rung::Double, Colour::Blue, Form::Circle),
    (Rung::DoubleDouble, Colour::Green, Form::Square),
    (Rung::Wide(50), Colour::Purple, Form::Diamond),
];

/// The sizes of the markers, in the order in which they are drawn.
fn size(number: Rung) -> f64 {
    let place = NUMBERS.iter().position(|(known, ..)| *known == number);
    10.5 - 1.5 * place.unwrap_or_default() as f64
}

/// Every task of a trade, the time in latencies of one f64 sine and cosine on a logarithmic axis. What a means comes to as
/// its step, tolerance or count changes is a line; what no means beats is filled, and joined by a dotted line.
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
        ..Figure::new(format!("Digits against time, {}", processor(machine)), panels)
    }
}

/// What a title has room for: the machine without its system and our version.
fn processor(machine: &str) -> &str {
    let commas = machine.match_indices(',').map(|(at, _)| at);
    commas.take(2).last().map_or(machine, |end| &machine[..end])
}

/// The share of the problems at which digits are drawn: half of them.
const DRAWN: f64 = 0.5;

/// What hollow markers are.
const BEATEN: &str = "hollow: beaten in time and digits";

fn at(row: &TradeRow) -> Point {
    (row.latencies.log10(), row.kept(DRAWN))
}

fn panel(task: &str, rows: &[&TradeRow]) -> Panel {
    let mut panel = Panel::new(
        Axis::new("time / $L$  ($L$: one f64 sine and cosine)").with_ticks(Ticks::Powers),
        Axis::new("correct digits at half of the problems"),
    );
    panel.heading = in_words(task);
    let mut front: Vec<Point> = rows.iter().filter(|row| row.on_front).map(|row| at(row)).collect();
    front.sort_by(|one, other| one.0.total_cmp(&other.0));
    let stroke = |colour, dash, width| Stroke { colour, dash, width };
    let dotted = stroke(Colour::Black, Dash::Dotted, 1.0);
    panel.series.push(Series::line("front", front, dotted));
    let mut named: Vec<&str> = Vec::new();
    for (number, colour, form) in NUMBERS {
        let of_number: Vec<&TradeRow> = rows.iter().copied().filter(|row| row.number == number).collect();
        for line in ladders(&of_number) {
            panel
                .series
                .push(Series::line("", line, stroke(colour, Dash::Solid, 0.7)));
        }
        let (on, off): (Vec<&TradeRow>, Vec<&TradeRow>) = of_number.iter().partition(|row| row.on_front);
        // the first to be drawn is the largest, so that none hides another
        let open = Marker {
            size: size(number),
            ..Marker::open(colour, form)
        };
        let filled = Marker { filled: true, ..open };
        let mut mark = |row: &&TradeRow| {
            // a means is named once, where it is best
            let has_name = row.on_front || !row.setting.is_empty();
            let is_first = has_name && !named.contains(&row.method);
            let label = if is_first { row.method.to_owned() } else { String::new() };
            named.extend(is_first.then_some(row.method));
            let at = at(row);
            Mark { at, label }
        };
        let mut name = number.to_string();
        for (rows, marker) in [(on, filled), (off, open)] {
            if !rows.is_empty() {
                let marks = rows.iter().rev().map(&mut mark).collect();
                panel.series.push(Series::marks(name.clone(), marks, marker));
            }
            // the legend names a number once, and once what a hollow marker is
            BEATEN.clone_into(&mut name);
        }
    }
    panel
}

/// The name of a task, as `dp/random/trace`, in words.
fn in_words(task: &str) -> String {
    let (what, rest) = task.split_once('/').unwrap_or((task, ""));
    let what = match what {
        "dp" => "Jacobian of a 1-1 motion",
        "multipliers" => "Multipliers",
        "voltage" => "Voltage of an impact",
        "impact" => "Next impact",
        "orbit" => "1-1 orbit",
        "statistics" => "Long run",
        other => other,
    };
    match rest.replace('/', ", ").replace(['-', '_'], " ") {
        rest if rest.is_empty() => what.to_owned(),
        rest => format!("{what}: {rest}"),
    }
}

/// The means that stand there with more than one setting, each as a line in the order of its settings.
fn ladders(rows: &[&TradeRow]) -> Vec<Vec<Point>> {
    let mut methods: Vec<&str> = rows.iter().map(|row| row.method).collect();
    methods.dedup();
    let line = |method: &str| -> Vec<Point> {
        let settings = rows
            .iter()
            .filter(|row| row.method == method && !row.setting.is_empty());
        settings.map(|row| at(row)).collect()
    };
    methods.into_iter().map(line).filter(|line| line.len() > 1).collect()
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
            setting: String::new(),
            cost: 1,
            proved: false,
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
        for text in [
            "1-1 orbit",
            "Next impact",
            "newton",
            "own",
            "a machine",
            "double-double",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(!svg.contains("secant"));
    }

    #[test]
    fn the_settings_of_a_means_are_one_line_and_a_means_without_settings_is_none() {
        let with = |setting: &str| TradeRow {
            setting: setting.to_owned(),
            ..row("impact", "fixed-step", Rung::Double, false)
        };
        let rows = [
            with("step=2^-3"),
            with("step=2^-5"),
            with("step=2^-7"),
            row("impact", "own", Rung::Double, true),
        ];
        let rows: Vec<&TradeRow> = rows.iter().collect();
        let lines = ladders(&rows);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].len(), 3);
    }
}
