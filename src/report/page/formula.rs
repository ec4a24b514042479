//! Formulas of a page: each typeset, with its verdict and what it rests on.

use super::table::listed;
use super::{Verdicts, anchor, badge, foreign};
use crate::claim::{Sheet, Source};
use crate::kernel::DERIVATIVES_EXIST;
use crate::markup::{Element, Markup, element, text_in};
use crate::prove::rocq::Unwritten;
use crate::prove::{Counterexample, Decision, Explanation};
use crate::repair::{Part as Place, Repair};
use crate::report::{Cell, Table};
use crate::tex::{
    Condition, Equation, Map, Name, Names, Tree, difference_of, mathml, mathml_display, mathml_of_condition, read,
    read_conditions, read_display, read_expression,
};
use std::collections::HashSet;

/// A formula as a browser lays it out; its source where it cannot be read.
#[derive(Clone, Debug)]
struct Typeset(Vec<Element>);

impl Typeset {
    /// A display, as it is printed.
    pub fn display(tex: &str, names: &Names) -> Self {
        match read_display(tex, names) {
            Ok(display) => Self::equations(&display.equations, &[]),
            Err(_) => match read_conditions(tex, names) {
                Ok(conditions) => Self::conditions(&conditions),
                Err(_) => Self::expression(tex, names),
            },
        }
    }

    fn expression(tex: &str, names: &Names) -> Self {
        match read_expression(tex, names) {
            Ok(tree) => Self(vec![mathml(&tree)]),
            Err(_) => Self(vec![source(tex)]),
        }
    }

    fn conditions<'c>(conditions: impl IntoIterator<Item = &'c Condition>) -> Self {
        Self(joined(conditions.into_iter().map(mathml_of_condition).collect()))
    }

    fn equations(equations: &[Equation], marked: &[&Tree]) -> Self {
        Self(mathml_display(equations, marked))
    }
}

/// TeX as it stands in the source.
fn source(tex: &str) -> Element {
    text_in("code", tex.trim()).with("class", "tex").with("dir", "ltr")
}

/// What stands in a line, parted by commas.
fn joined(parts: Vec<Element>) -> Vec<Element> {
    let mut line = Vec::new();
    for part in parts {
        if !line.is_empty() {
            line.push(text_in("span", ", "));
        }
        line.push(part);
    }
    line
}

/// A sentence, in which what stands between backticks is TeX.
fn sentence(text: &str, names: &Names) -> Element {
    let parts = text.split('`').enumerate();
    // an odd number of backticks ends in none that closes
    let pairs = text.matches('`').count() / 2;
    element(
        "span",
        parts.flat_map(|(place, part)| match place {
            place if place % 2 == 1 && place < 2 * pairs => Typeset::expression(part, names).0,
            _ => vec![foreign(part)],
        }),
    )
}

/// The lines of an explanation, each formula laid out; `None` where there are none.
fn typeset(explanation: &Explanation, names: &Names) -> Option<Element> {
    let line = |(indent, parts): (usize, Vec<&str>)| {
        let shown = parts.iter().enumerate().flat_map(|(place, part)| match place % 2 {
            0 => vec![sentence(part, names)],
            _ => Typeset::display(part, names).0,
        });
        element("div", shown).with("class", format!("indent-{}", indent.min(MOST_INDENT)))
    };
    let lines: Vec<Element> = explanation.lines().map(line).collect();
    (!lines.is_empty()).then(|| {
        element("div", lines)
            .with("class", "explained")
            .with("tabindex", "0")
            .with("dir", "ltr")
    })
}

/// Blanks before a line of an explanation, at most; the style has a rule for each even number.
const MOST_INDENT: usize = 10;

/// What a verdict excludes: conditions, and derivatives that must exist.
fn excluded(text: &str, names: &Names) -> Vec<Element> {
    let part = |part: &str| match part.strip_prefix(DERIVATIVES_EXIST) {
        Some(names_of) => {
            let of = names_of
                .trim()
                .split(", ")
                .map(|name| element("span", Typeset::expression(name, names).0));
            element("div", [text_in("span", format!("{DERIVATIVES_EXIST} "))]).and(joined(of.collect()))
        }
        None => match read_conditions(part, names) {
            Ok(conditions) => element("div", Typeset::conditions(&conditions).0),
            Err(_) => element("div", [sentence(part, names)]),
        },
    };
    text.split("; ").filter(|part| !part.is_empty()).map(part).collect()
}

/// What a sheet takes as given: its label and the formula.
#[derive(Clone, Debug)]
pub struct Given {
    label: String,
    role: String,
    formula: Typeset,
    source: String,
}

impl Given {
    /// What of a sheet has no row of its own.
    pub fn all(sheet: &Sheet) -> Vec<Self> {
        let rows: HashSet<usize> = sheet.rows().into_iter().collect();
        let others = sheet
            .entries
            .iter()
            .enumerate()
            .filter(|(position, _)| !rows.contains(position));
        let given = others.map(|(_, entry)| Self {
            label: entry.label.clone(),
            role: entry.role.to_string(),
            formula: Typeset::display(&entry.tex.tex, &sheet.symbols.names),
            source: entry.tex.tex.clone(),
        });
        let symbols = &sheet.symbols;
        given
            .chain(symbols.maps().map(|(name, map)| Self::map(name, map, &symbols.names)))
            .collect()
    }

    /// A map, whose matrix of partial derivatives its name stands for.
    fn map(name: &Name, map: &Map, names: &Names) -> Self {
        let list = |trees: &[Tree]| joined(trees.iter().map(mathml).collect());
        let words = |text: &str| text_in("span", text);
        let shown = match map {
            Map::Premises { of, by } => {
                let mut line = vec![words("partial derivatives of ")];
                line.extend(list(of));
                line.push(words(" with respect to "));
                line.extend(list(by));
                line.push(words(", along the premises"));
                line
            }
            Map::Equations(equations) => {
                let mut line = vec![words("partial derivatives of ")];
                line.extend(Typeset::equations(equations, &[]).0);
                line
            }
            Map::Product(factors) => {
                let factors: Vec<String> = factors.iter().map(ToString::to_string).collect();
                Typeset::display(&format!("{name} = {}", factors.join(" ")), names).0
            }
        };
        Self {
            label: name.to_string(),
            role: "map".to_owned(),
            formula: Typeset(shown),
            source: name.to_string(),
        }
    }
}

/// What a row of verdicts is about, beyond what the row says.
#[derive(Clone, Debug)]
pub struct Printed {
    formula: Typeset,
    /// What is printed where it differs from the first repair, the repair, and the TeX of all that was proved of it.
    mended: Option<(Typeset, Typeset, String)>,
    others: Vec<Typeset>,
    /// `where`, `with`, `assume`.
    said: Vec<(&'static str, Vec<Typeset>)>,
    follows_from: Vec<String>,
    guessed: Vec<String>,
    counterexample: Vec<Element>,
    names: Names,
    source: String,
    explained: Option<Element>,
    /// Theorems for Rocq, or why there is none.
    theorems: Vec<Result<String, Unwritten>>,
}

impl Printed {
    /// The formula of the claim at a position; `explained` is its proof or counterexample, `theorems` what Rocq can check of it.
    pub fn new(
        sheet: &Sheet,
        position: usize,
        decision: &Decision,
        repairs: &[Repair],
        explained: &Explanation,
        theorems: Vec<Result<String, Unwritten>>,
    ) -> Self {
        let names = &sheet.symbols.names;
        let entry = sheet.entries.get(position);
        let tex = entry.map(|entry| entry.tex.tex.clone()).unwrap_or_default();
        let displays = |sources: Vec<&Source>| {
            sources
                .into_iter()
                .map(|own| Typeset::display(&own.tex, names))
                .collect()
        };
        let mut said: Vec<(&'static str, Vec<Typeset>)> = Vec::new();
        if let Some(entry) = entry {
            said.push(("where", displays(once(&entry.local))));
            said.push(("with", displays(once(&entry.with))));
            let assumed =
                (!entry.assume.is_empty()).then(|| Typeset::conditions(entry.assume.iter().map(|(own, _)| own)));
            said.push(("assuming", assumed.into_iter().collect()));
        }
        let labels = entry.iter().flat_map(|entry| &entry.follows_from);
        let labels = labels.filter_map(|&position| sheet.entries.get(position));
        let printed = |place: Place| match (place, entry) {
            (Place::Stated(n), Some(entry)) => entry.equations.get(n),
            (Place::Definition(n), Some(entry)) => entry.local.get(n).map(|(equation, _)| equation),
            _ => None,
        };
        let mut repairs = repairs.iter();
        let mended = repairs.next().map(|first| {
            let (mut before, mut after) = (Vec::new(), Vec::new());
            for (place, new) in &first.mended {
                let Some(old) = printed(*place) else { continue };
                let (gone, come) = difference_of(old, new);
                before.extend(Typeset::equations(std::slice::from_ref(old), &gone).0);
                after.extend(Typeset::equations(std::slice::from_ref(new), &come).0);
            }
            (Typeset(before), Typeset(after), first.formulas.join("\n"))
        });
        let others = repairs.map(|other| {
            let mut lines = Vec::new();
            for (place, new) in &other.mended {
                let come = printed(*place).map(|old| difference_of(old, new).1).unwrap_or_default();
                lines.extend(Typeset::equations(std::slice::from_ref(new), &come).0);
            }
            Typeset(lines)
        });
        Self {
            formula: Typeset::display(&tex, names),
            mended,
            others: others.collect(),
            said,
            follows_from: labels.map(|premise| premise.label.clone()).collect(),
            guessed: entry.map(|entry| entry.guessed.clone()).unwrap_or_default(),
            counterexample: decision
                .counterexample
                .as_ref()
                .map(|own| point(own, names))
                .unwrap_or_default(),
            names: names.clone(),
            source: tex,
            explained: typeset(explained, names),
            theorems,
        }
    }
}

/// The sources of a list, each once: one may hold several formulas.
fn once<T>(list: &[(T, Source)]) -> Vec<&Source> {
    let mut found: Vec<&Source> = Vec::new();
    for (_, source) in list {
        if found
            .last()
            .is_none_or(|last| (last.place(), &last.tex) != (source.place(), &source.tex))
        {
            found.push(source);
        }
    }
    found
}

/// The values of a counterexample.
fn point(counterexample: &Counterexample, names: &Names) -> Vec<Element> {
    let Counterexample { point, left, right, .. } = counterexample;
    let value = |name: &str, value: &str| {
        let both = format!("{name} = {value}");
        match read(&both, names) {
            Ok(equations) if equations.len() == 1 => element("span", Typeset::equations(&equations, &[]).0),
            _ => element("span", [source(&both)]),
        }
    };
    let side = |name: &str, value: &str| {
        let name = text_in("span", format!("{name} "));
        element("span", [name]).and(Typeset::expression(value, names).0)
    };
    let values = point.iter().map(|(name, own)| value(name, own));
    let sides = [side("left side", left), side("right side", right)];
    values.chain(sides).map(|own| own.with("class", "value")).collect()
}

/// The verdicts that are folded where nothing is expected, as in a document without comments, and what its author can do.
const FOLDED: [(&str, &str); 3] = [
    (
        "given",
        "definitions and laws. What follows from others is checked in a chain with them, or after `% audit: claim; follows from (1)`",
    ),
    (
        "undecided",
        "neither proved nor failing by a slip. Say what each follows from, `% audit: follows from (1)`, or what its letters are, `% audit: symbols ...`",
    ),
    (
        "unread",
        "each says which sign is not read. Write it in another way, or leave it out by `% audit: skip`",
    ),
];

/// The verdicts, and what is given; in a document without comments what its author need not look at is folded.
pub fn section(table: &Table, printed: &[Printed], given: &[Given], verdicts: &Verdicts) -> Vec<Element> {
    let known: HashSet<&str> = given.iter().map(|given| given.label.as_str()).collect();
    let text = |row: &[Cell], name: &str| -> String {
        let cell = table.position(name).and_then(|place| row.get(place));
        cell.map(|cell| cell.plain().into_owned()).unwrap_or_default()
    };
    let labels: HashSet<String> = table.rows().iter().map(|row| text(row, "label")).collect();
    let is_there = |label: &str| labels.contains(label) || known.contains(label);
    let links = table.rows().iter().map(|row| {
        let (label, verdict, expected) = (text(row, "label"), text(row, "verdict"), text(row, "expected"));
        let link = link(&label);
        let class = if Table::is_expected(&verdict, &expected) {
            "as-expected"
        } else {
            "unexpected"
        };
        element("li", [link])
            .with("class", class)
            .with("data-show", verdicts.shown_as(&verdict, &expected))
    });
    let index = element("nav", [element("ul", links)]).with("aria-label", "Formulas");
    let mut section = element("section", [text_in("h2", "Formulas"), index]);
    let mut folds = FOLDED.map(|(verdict, advice)| (verdict, advice, Vec::new()));
    for (row, own) in table.rows().iter().zip(printed) {
        let text = |name: &str| text(row, name);
        let article = article(&text, own, verdicts, &is_there);
        let verdict = text("verdict");
        let fold = folds.iter_mut().find(|(folded, ..)| *folded == verdict);
        match fold.filter(|_| text("expected").is_empty()) {
            Some((.., articles)) => articles.push(article),
            None => section = section.and([article]),
        }
    }
    for (verdict, advice, articles) in folds.into_iter().filter(|(.., articles)| !articles.is_empty()) {
        let summary = format!("{} {verdict}: {advice}", articles.len());
        let fold = element("details", [text_in("summary", summary)]).and(articles);
        section = section.and([fold.with("data-show", verdicts.shown_as(verdict, ""))]);
    }
    let mut sections = vec![section];
    if !given.is_empty() {
        let articles = given.iter().map(|given| {
            let role = text_in("span", given.role.as_str()).with("class", "verdict plain");
            let head = element("h3", [Markup::from(link(&given.label)), " ".into(), role.into()]);
            let article = element("article", [head]).and([formula(&given.formula)]);
            article
                .and([tex_source(&given.source)])
                .with("id", anchor("eq", &given.label))
        });
        sections.push(element("section", [text_in("h2", "Taken as given")]).and(articles));
    }
    sections
}

/// A label that leads to its formula.
fn link(label: &str) -> Element {
    let shown = foreign(&format!("({label})"));
    element("a", [shown]).with("href", format!("#{}", anchor("eq", label)))
}

/// A formula, which may be wider than the page: it is scrolled by keys too.
fn formula(typeset: &Typeset) -> Element {
    element("div", typeset.0.clone())
        .with("class", "formula")
        .with("tabindex", "0")
}

fn tex_source(tex: &str) -> Element {
    let source = element("pre", [source(tex)]);
    element("details", [text_in("summary", "TeX"), source])
}

fn article(
    text: &dyn Fn(&str) -> String,
    own: &Printed,
    verdicts: &Verdicts,
    is_there: &dyn Fn(&str) -> bool,
) -> Element {
    let (label, verdict, expected) = (text("label"), text("verdict"), text("expected"));
    let mut head: Vec<Markup> = vec![link(&label).into(), " ".into(), badge(&verdict).into()];
    if !Table::is_expected(&verdict, &expected) && !expected.is_empty() {
        head.push(" ".into());
        head.push(
            text_in("span", format!("expected {expected}"))
                .with("class", "not-expected")
                .into(),
        );
    }
    let mut article = element("article", [element("h3", head)]).and([formula(&own.formula)]);
    let is_reduced = own.theorems.iter().any(Result::is_err);
    article = article.and(own.theorems.iter().map(|theorem| {
        let [name, text] = match theorem {
            Ok(theorem) if is_reduced => ["Theorem for Rocq of a goal that the claim is reduced to", theorem],
            Ok(theorem) => ["Theorem for Rocq", theorem],
            Err(why) => ["No theorem for Rocq", &why.to_string()],
        };
        element("details", [text_in("summary", name), text_in("pre", text)]).with("class", "theorem")
    }));
    if let Some((before, after, whole)) = &own.mended {
        let line = |name: &str, class: &'static str, typeset: &Typeset| {
            element("div", [text_in("p", name), formula(typeset)]).with("class", class)
        };
        let both = [
            line("printed", "printed", before),
            line("repair, proved", "repair", after),
        ];
        article = article.and([element("div", both).with("class", "mended"), tex_source(whole)]);
        if !own.others.is_empty() {
            let count = own.others.len();
            let name = if count == 1 {
                "1 other repair".to_owned()
            } else {
                format!("{count} other repairs")
            };
            let others = element("div", own.others.iter().map(formula)).with("class", "repair");
            article = article.and([element("details", [text_in("summary", name), others])]);
        }
    }
    let mut facts: Vec<Element> = Vec::new();
    for (name, typeset) in &own.said {
        facts.extend(listed(
            name,
            typeset.iter().map(|own| element("div", own.0.clone())).collect(),
        ));
    }
    let premise = |label: &String| {
        if is_there(label) {
            link(label)
        } else {
            foreign(&format!("({label})"))
        }
    };
    facts.extend(listed(
        "follows from",
        joined(own.follows_from.iter().map(premise).collect()),
    ));
    facts.extend(listed(
        "guessed",
        own.guessed
            .iter()
            .map(|guess| element("div", [foreign(guess)]))
            .collect(),
    ));
    facts.extend(listed("reason", vec![sentence(&text("reason"), &own.names)]));
    facts.extend(listed("provided", excluded(&text("provided"), &own.names)));
    let reading = text("reading");
    if !reading.is_empty() {
        facts.extend(listed("read as", vec![sentence(&reading, &own.names)]));
    }
    let reductions = text("reductions");
    if !reductions.is_empty() {
        facts.extend(listed("reduced by", vec![text_in("span", reductions)]));
    }
    facts.extend(listed("fails at", own.counterexample.clone()));
    let digits = text("digits");
    if !digits.is_empty() {
        let said = match verdict.as_str() {
            "refuted" => format!("at random points of the premises the sides agree to no more than {digits} digits"),
            _ => format!("both sides agree to {digits} digits at random points of the premises"),
        };
        facts.extend(listed("evidence", vec![text_in("span", said)]));
    }
    let place = text("place");
    facts.extend(listed(
        "place",
        if place.is_empty() {
            Vec::new()
        } else {
            vec![foreign(&place)]
        },
    ));
    article = article.and([element("dl", facts)]);
    if let Some(explained) = &own.explained {
        let name = match verdict.as_str() {
            "proved" => "Proof",
            "refuted" => "Counterexample, worked out",
            _ => "What is known",
        };
        let text = explained.clone();
        article = article.and([element("details", [text_in("summary", name), text]).with("class", "proof")]);
    }
    article = article.and([tex_source(&own.source)]);
    article
        .with("id", anchor("eq", &label))
        .with("data-show", verdicts.shown_as(&verdict, &expected))
}
