//! What rows of golden values came to, as a table.

use super::Failure;
use crate::reference::{Outcome, Verdict};
use crate::report::{Cell, Table};

/// The columns: those that scripts rely on, and the reason.
const COLUMNS: [&str; 10] = [
    "id", "place", "printed", "computed", "digits", "verdict", "expected", "rests_on", "reason", "picked",
];

/// The table of what rows of golden values came to; where it is brief, without what nobody asks of a number that is right.
pub fn table(outcomes: &[Outcome], is_brief: bool) -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS);
    for outcome in outcomes {
        let is_told = !is_brief || outcome.verdict != Verdict::Reproduced || !outcome.is_expected();
        table.push(vec![
            Cell::from(outcome.id.as_str()),
            Cell::from(outcome.place.as_str()),
            Cell::from(outcome.printed.as_str()),
            computed(&outcome.computed),
            Cell::from(outcome.digits.map(|digits| (digits * 10.0).round() / 10.0)),
            Cell::from(outcome.verdict.name()),
            Cell::from(outcome.expected.name()),
            Cell::from(outcome.rests_on.as_str()),
            Cell::from(outcome.reason.as_str()),
            if is_told {
                Cell::from(outcome.picked.as_str())
            } else {
                Cell::Empty
            },
        ])?;
    }
    Ok(table)
}

/// A number where the text is that of an f64, so that text rounds it as any other; else the text.
fn computed(text: &str) -> Cell {
    if text.is_empty() {
        return Cell::Empty;
    }
    let number = text.parse::<f64>().ok().map(Cell::Number);
    number
        .filter(|cell| cell.plain() == text)
        .unwrap_or_else(|| Cell::from(text))
}
