//! Tables of a page, whose rows a script sorts.

use super::{Verdicts, anchor, badge, foreign, scrolled};
use crate::markup::{Element, element, text_in};
use crate::report::figures::rounded;
use crate::report::{Cell, Table};

/// A table under its heading.
pub fn section(place: usize, heading: &str, said: &str, table: &Table, verdicts: &Verdicts, figures: usize) -> Element {
    let numeric: Vec<bool> = (0..table.columns().len())
        .map(|column| table.is_numeric(column))
        .collect();
    let is_numeric = |column: usize| numeric.get(column) == Some(&true);
    let head = table.columns().iter().enumerate().map(|(column, own)| {
        let head = element("th", [foreign(&own.name)]).with("scope", "col");
        if is_numeric(column) {
            head.with("class", "number")
        } else {
            head
        }
    });
    let judged = table.position("verdict").zip(table.position("expected"));
    let row = |cells: &Vec<Cell>| {
        let text = |column: usize| {
            cells
                .get(column)
                .map(|cell| cell.plain().into_owned())
                .unwrap_or_default()
        };
        let shown = cells.iter().enumerate().map(|(column, own)| {
            let is_verdict = judged.is_some_and(|(verdict, _)| verdict == column);
            cell(own, column, is_numeric(column), is_verdict, figures)
        });
        let row = element("tr", shown);
        match judged {
            Some((verdict, expected)) => {
                let row = row.with("data-show", verdicts.shown_as(&text(verdict), &text(expected)));
                row.with("id", anchor(&format!("row{place}"), &text(0)))
            }
            None => row,
        }
    };
    let head = element("thead", [element("tr", head)]);
    let body = element("tbody", table.rows().iter().map(row));
    let table = element("table", [head, body]).with("class", "sortable");
    let section = element("section", [element("h2", [foreign(heading)])]);
    let said = (!said.is_empty()).then(|| element("p", [foreign(said)]));
    section.and(said).and([scrolled(heading, table)])
}

fn cell(cell: &Cell, column: usize, is_numeric: bool, is_verdict: bool, figures: usize) -> Element {
    let whole = cell.plain();
    let shown = match cell {
        Cell::Number(number) => rounded(*number, figures),
        Cell::Numbers(numbers) => {
            let shown: Vec<String> = numbers.iter().map(|number| rounded(*number, figures)).collect();
            shown.join("; ")
        }
        _ => whole.clone().into_owned(),
    };
    let inner = if is_verdict { badge(&shown) } else { foreign(&shown) };
    let element = match column {
        0 => element("th", [inner]).with("scope", "row"),
        _ => element("td", [inner]),
    };
    let element = if is_numeric {
        element.with("class", "number")
    } else {
        element
    };
    // the whole number, by which rows are sorted too
    match cell {
        Cell::Number(_) if shown != *whole => element.with("title", whole.into_owned()),
        _ => element,
    }
}

/// A list of what words name, as far as there are any.
pub fn listed(name: &str, parts: Vec<Element>) -> Vec<Element> {
    if parts.is_empty() {
        return Vec::new();
    }
    vec![text_in("dt", name), element("dd", parts)]
}
