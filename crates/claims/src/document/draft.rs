//! A document as a sheet to edit.

use super::super::entry::{RawEntry, Standing};
use super::super::sheet::RawSheet;
use super::super::symbols::{MapEntry, Pairs, RawSymbols};
use super::super::verdict::Verdict;
use std::fmt::Write;
use toml::Spanned;

/// The sheet as TOML.
pub(super) fn toml(raw: &RawSheet, guesses: &[String], name: &str) -> String {
    let mut text = format!(
        "# A draft from {}: decided as the document is. Where a guess, doubt or `unread` is settled, remove it.\n",
        name.replace(char::is_control, " ")
    );
    for guess in guesses {
        let _ = writeln!(text, "# {guess}");
    }
    if let Some(symbols) = &raw.symbols {
        text.push_str(&of_symbols(symbols.get_ref()));
    }
    for entry in &raw.equation {
        text.push_str(&of_entry(entry));
    }
    text
}

fn of_entry(entry: &RawEntry) -> String {
    let mut text = format!("\n[[equation]]\nlabel = {}\n", word(entry.label.get_ref()));
    let _ = writeln!(
        text,
        "role = \"{}\"\ntex = {}",
        entry.role,
        formula(entry.tex.get_ref())
    );
    for (key, list) in [
        ("where", &entry.local),
        ("with", &entry.with),
        ("assume", &entry.assume),
    ] {
        if !list.is_empty() {
            let _ = writeln!(text, "{key} = {}", joined(list, formula));
        }
    }
    if let Some(labels) = entry.follows_from.as_ref().filter(|labels| !labels.is_empty()) {
        let _ = writeln!(text, "follows_from = {}", joined(labels, word));
    }
    if entry.expect != Verdict::default() {
        let _ = writeln!(text, "expect = \"{}\"", entry.expect);
    }
    let standing = match entry.standing {
        Standing::Said => "",
        Standing::Definition => "definition",
        Standing::Law => "law",
        Standing::Link => "link",
        Standing::Open => "open",
    };
    if !standing.is_empty() {
        let _ = writeln!(text, "standing = \"{standing}\"");
    }
    let lists = [
        ("guessed", &entry.guessed),
        ("doubts", &entry.doubts),
        ("constants", &entry.constants),
        ("held", &entry.held),
        ("second_values", &entry.second_values),
        ("operators", &entry.operators),
        ("identities", &entry.identities),
        ("marked", &entry.marked),
    ];
    for (key, list) in lists {
        if !list.is_empty() {
            let items: Vec<String> = list.iter().map(|item| format!("\n  {},", word(item))).collect();
            let _ = writeln!(text, "{key} = [{}\n]", items.concat());
        }
    }
    if entry.columns {
        let _ = writeln!(text, "columns = true");
    }
    if let Some(problem) = &entry.unread {
        let _ = writeln!(text, "unread = {}", word(problem));
    }
    text
}

fn joined(list: &[Spanned<String>], show: fn(&str) -> String) -> String {
    let shown: Vec<String> = list.iter().map(|item| show(item.get_ref())).collect();
    format!("[{}]", shown.join(", "))
}

fn word(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// TeX as a literal string, where it can be one.
fn formula(tex: &str) -> String {
    let is_literal =
        !tex.contains("'''") && !tex.ends_with('\'') && !tex.chars().any(|c| c.is_control() && !"\n\t".contains(c));
    if is_literal && !tex.starts_with('\n') {
        format!("'''{tex}'''")
    } else {
        word(tex)
    }
}

fn of_symbols(symbols: &RawSymbols) -> String {
    let mut text = "\n[symbols]\n".to_owned();
    let lists = [
        ("parameters", &symbols.parameters),
        ("generic", &symbols.generic),
        ("positive", &symbols.positive),
        ("at_most_one", &symbols.at_most_one),
        ("nonnegative", &symbols.nonnegative),
        ("nonzero", &symbols.nonzero),
        ("integers", &symbols.integers),
        ("complex", &symbols.complex),
        ("indices", &symbols.indices),
        ("times", &symbols.times),
        ("states", &symbols.states),
        ("continuous", &symbols.continuous),
    ];
    let list = |names: &[String]| {
        format!(
            "[{}]",
            names.iter().map(|name| word(name)).collect::<Vec<_>>().join(", ")
        )
    };
    for (key, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
        let _ = writeln!(text, "{key} = {}", list(names));
    }
    if let Some(opaque) = &symbols.opaque {
        let [factors, functions, values] = [&opaque.factors, &opaque.functions, &opaque.values]
            .map(|names| list(&names.iter().cloned().collect::<Vec<_>>()));
        let letters = list(&opaque.letters);
        let _ = writeln!(
            text,
            "opaque = {{ factors = {factors}, functions = {functions}, values = {values}, letters = {letters}, transposes = {} }}",
            opaque.transposes
        );
    }
    let pairs = [
        ("functions", &symbols.functions),
        ("periods", &symbols.periods),
        ("abbreviations", &symbols.abbreviations),
        ("relations", &symbols.relations),
    ];
    for (key, pairs) in pairs {
        let names: Vec<String> = match pairs {
            Pairs::List(list) => list.clone(),
            Pairs::Table(table) => table.iter().map(|(left, right)| format!("{left} = {right}")).collect(),
        };
        if !names.is_empty() {
            let _ = writeln!(text, "{key} = {}", list(&names));
        }
    }
    if !symbols.maps.is_empty() {
        text.push_str("\n[symbols.maps]\n");
    }
    for (name, map) in &symbols.maps {
        let shown = match map {
            MapEntry::Product(product) => word(product),
            MapEntry::List(equations) => list(equations),
            MapEntry::Of { of, by } => format!("{{ of = {}, by = {} }}", list(of), list(by)),
        };
        let _ = writeln!(text, "{} = {shown}", word(name));
    }
    text
}
