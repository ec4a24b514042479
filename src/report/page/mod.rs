//! The report page: one HTML file that refers to nothing outside itself, is read without scripts, and is printed whole.
//!
//! It is a tree of [`Markup`], so that nothing of a formula, a label or a file becomes an element. Its style and its one
//! script stand in the source.

mod formula;
mod table;

pub use formula::{Given, Printed};

use super::Table;
use super::plot::{Figure, Level, PlotError};
use crate::markup::{Element, Markup, Written, element, empty, text_in};
use std::io::{self, Write};

/// What a page says.
#[derive(Clone, Debug)]
pub struct Page {
    pub title: String,
    /// A sentence each, beneath the title.
    pub notes: Vec<String>,
    pub parts: Vec<Part>,
}

/// A part of a page.
#[derive(Clone, Debug)]
pub enum Part {
    /// Verdicts on formulas, a row each, and what each is about; and what is taken as given.
    Formulas(Table, Vec<Printed>, Vec<Given>),
    /// A table under its heading, with what is said of it.
    Table(String, String, Table),
    /// A drawing.
    Figure(Figure),
}

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// What the page may do: nothing from outside is loaded, whatever it holds.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The verdicts that a filter tells apart, at most; the style has a rule for each.
const MOST_VERDICTS: usize = 8;

/// The place of what is not as expected among what the filter shows.
const OPEN: usize = 9;

/// The verdicts of tables and how often each stands there, in the order of their first.
pub struct Verdicts {
    counts: Vec<(String, usize)>,
    unexpected: usize,
}

impl Verdicts {
    /// Counts the verdicts of the tables that have columns `verdict` and `expected`.
    pub fn of<'a>(tables: impl Iterator<Item = &'a Table>) -> Self {
        let (mut counts, mut unexpected): (Vec<(String, usize)>, usize) = (Vec::new(), 0);
        for (table, verdict, expected) in
            tables.filter_map(|table| Some((table, table.position("verdict")?, table.position("expected")?)))
        {
            for row in table.rows() {
                let cell = |place: usize| row.get(place).map(|cell| cell.plain().into_owned()).unwrap_or_default();
                let found = cell(verdict);
                unexpected += usize::from(!Table::is_expected(&found, &cell(expected)));
                match counts.iter_mut().find(|(known, _)| *known == found) {
                    Some((_, count)) => *count += 1,
                    None => counts.push((found, 1)),
                }
            }
        }
        Self { counts, unexpected }
    }

    /// What the filter knows a row by.
    fn shown_as(&self, verdict: &str, expected: &str) -> String {
        let place = self.counts.iter().position(|(known, _)| known == verdict);
        let own = place
            .filter(|place| *place < MOST_VERDICTS)
            .map(|place| (place + 1).to_string());
        let open = (!Table::is_expected(verdict, expected)).then(|| OPEN.to_string());
        let parts: Vec<String> = own.into_iter().chain(open).collect();
        parts.join(" ")
    }

    /// The counts, each of which shows what it counts alone.
    fn filter(&self) -> Option<Element> {
        let all: usize = self.counts.iter().map(|(_, count)| count).sum();
        if all == 0 {
            return None;
        }
        let choice = |place: usize, label: Markup, count: usize| {
            let id = format!("show-{place}");
            let radio = empty("input")
                .with("type", "radio")
                .with("name", "show")
                .with("id", id.clone());
            let radio = if place == 0 {
                radio.with("checked", "checked")
            } else {
                radio
            };
            let count = text_in("span", count.to_string()).with("class", "count");
            [
                radio,
                element("label", [label, Markup::from(" "), count.into()]).with("for", id),
            ]
        };
        let mut choices = vec![choice(0, "all".into(), all)];
        for (place, (verdict, count)) in self.counts.iter().enumerate().take(MOST_VERDICTS) {
            choices.push(choice(place + 1, badge(verdict).into(), *count));
        }
        choices.push(choice(OPEN, "not as expected".into(), self.unexpected));
        let legend = text_in("legend", "Show");
        Some(
            element("fieldset", [legend])
                .and(choices.into_iter().flatten())
                .with("class", "filter"),
        )
    }

    /// Returns true if each verdict is the expected one.
    pub fn are_expected(&self) -> bool {
        self.unexpected == 0
    }

    /// Returns the counts as `13 proved, 2 refuted: all as expected`; nothing where there are no verdicts.
    pub fn in_words(&self) -> Option<String> {
        let counts: Vec<String> = self
            .counts
            .iter()
            .map(|(verdict, count)| format!("{count} {verdict}"))
            .collect();
        let end = match self.unexpected {
            0 => "all as expected".to_owned(),
            1 => "1 not as expected".to_owned(),
            count => format!("{count} not as expected"),
        };
        (!counts.is_empty()).then(|| format!("{}: {end}", counts.join(", ")))
    }
}

/// A verdict, in a colour that says whether it is good.
fn badge(verdict: &str) -> Element {
    let class = match verdict {
        "proved" | "reproduced" => "verdict good",
        "refuted" | "wrong" | "unread" | "suspect" => "verdict bad",
        "truncated" | "off-by-one" | "rounded" => "verdict fair",
        _ => "verdict open",
    };
    text_in("span", verdict).with("class", class)
}

/// The anchor of a label: letters, digits, points and dashes as they are, all else by its number, so that no two are one.
pub fn anchor(kind: &str, label: &str) -> String {
    let mut id = format!("{kind}-");
    for c in label.chars() {
        match c {
            c if c.is_ascii_alphanumeric() || ".-".contains(c) => id.push(c),
            c => id.push_str(&format!("_{:x}_", u32::from(c))),
        }
    }
    id
}

/// Somebody's text in a line of ours, whichever way its letters run.
fn foreign(text: &str) -> Element {
    text_in("bdi", text)
}

impl Page {
    /// Writes the page. Numbers in tables have so many figures, and are whole in what a pointer shows.
    ///
    /// # Errors
    /// What the writer says, and a figure that cannot be drawn.
    pub fn write(&self, to: &mut dyn Write, figures: usize) -> io::Result<()> {
        let page = self.markup(figures).map_err(io::Error::other)?;
        writeln!(to, "<!DOCTYPE html>\n{page}")
    }

    /// The rows of its tables.
    pub fn rows(&self) -> usize {
        self.tables().map(|table| table.rows().len()).sum()
    }

    fn tables(&self) -> impl Iterator<Item = &Table> {
        self.parts.iter().filter_map(|part| match part {
            Part::Formulas(table, ..) | Part::Table(.., table) => Some(table),
            Part::Figure(_) => None,
        })
    }

    fn markup(&self, figures: usize) -> Result<Element, PlotError> {
        let verdicts = Verdicts::of(self.tables());
        let head = element(
            "head",
            [
                empty("meta").with("charset", "utf-8"),
                empty("meta")
                    .with("http-equiv", "Content-Security-Policy")
                    .with("content", POLICY),
                empty("meta")
                    .with("name", "viewport")
                    .with("content", "width=device-width, initial-scale=1"),
                empty("meta").with("name", "color-scheme").with("content", "light dark"),
                text_in("title", self.title.as_str()),
                element("style", [Markup::Source(STYLE)]),
            ],
        );
        let about = format!("vibro-audit {}", env!("CARGO_PKG_VERSION"));
        let top = element("header", [element("h1", [foreign(&self.title)])])
            .and(
                verdicts
                    .in_words()
                    .map(|words| text_in("p", format!("{words}.")).with("class", "summary")),
            )
            .and(self.notes.iter().map(|note| element("p", [foreign(note)])))
            .and(verdicts.filter());
        let mut main = element("main", [top]);
        for (place, part) in self.parts.iter().enumerate() {
            main = main.and(match part {
                Part::Formulas(table, printed, given) => formula::section(table, printed, given, &verdicts),
                Part::Table(heading, said, table) => {
                    vec![table::section(place, heading, said, table, &verdicts, figures)]
                }
                Part::Figure(figure) => vec![drawing(figure)?],
            });
        }
        let foot = element("footer", [text_in("p", format!("Written by {about}."))]);
        let body = element("body", [main, foot, element("script", [Markup::Source(SCRIPT)])]);
        Ok(element("html", [head, body]).with("lang", "en"))
    }
}

fn drawing(figure: &Figure) -> Result<Element, PlotError> {
    let drawn = Markup::from(Written::by_our_writer(figure.svg()?));
    let pieces = super::plot::pieces(&figure.title);
    let name: String = pieces.iter().map(|piece| piece.text.as_str()).collect();
    let heading = pieces.into_iter().map(|piece| match (piece.level, piece.is_symbol) {
        (Level::Below, _) => Markup::from(text_in("sub", piece.text)),
        (Level::Above, _) => Markup::from(text_in("sup", piece.text)),
        (Level::Line, true) => Markup::from(text_in("i", piece.text)),
        (Level::Line, false) => Markup::from(piece.text),
    });
    let drawn = element("div", [drawn]).with("role", "img").with("aria-label", name);
    let wide = scrolled("Figure", drawn);
    Ok(element("section", [element("h2", heading), element("figure", [wide])]))
}

/// What may be wider than the page, and is then moved by itself.
fn scrolled(name: &str, inner: impl Into<Markup>) -> Element {
    let region = element("div", [inner.into()])
        .with("class", "wide")
        .with("tabindex", "0");
    region.with("role", "region").with("aria-label", name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Cell;
    use std::collections::HashSet;

    fn written(page: &Page) -> String {
        let mut bytes = Vec::new();
        page.write(&mut bytes, 12).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn two_labels_never_have_one_anchor() {
        let labels = [
            "22",
            "a b",
            "a_b",
            "a_20_b",
            "a-b",
            "a\u{202e}b",
            "\"><script>",
            "Ж",
            "",
        ];
        let anchors: HashSet<String> = labels.iter().map(|label| anchor("eq", label)).collect();
        assert_eq!(anchors.len(), labels.len());
        let plain = |c: char| c.is_ascii_alphanumeric() || "_.-".contains(c);
        assert!(anchors.iter().all(|anchor| anchor.chars().all(plain)), "{anchors:?}");
        assert_eq!(anchor("eq", "22"), "eq-22");
    }

    #[test]
    fn nothing_of_a_table_becomes_markup() {
        let mut table = Table::new(["id", "verdict", "expected", "reason"]);
        let evil = "</td><script>alert(1)</script>\u{202e}\"'&";
        table.push([evil, "wrong", "reproduced", evil].map(Cell::from)).unwrap();
        let page = Page {
            title: evil.to_owned(),
            notes: vec![evil.to_owned()],
            parts: vec![Part::Table(evil.to_owned(), evil.to_owned(), table)],
        };
        let html = written(&page);
        assert_eq!(html.matches("<script>").count(), 1, "the page's own");
        assert!(!html.contains('\u{202e}'));
        for outside in ["http://", "https://", "src=", "url(", "@import"] {
            assert!(!html.contains(outside), "{outside}");
        }
    }
}
