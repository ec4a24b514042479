//! Audit sheets: what a person wrote down of a paper, read and checked for sense before anything is decided.

use super::fault::{Fault, NO_INEQUALITIES, Source};
use super::symbols::{MapEntry, Symbols};
use super::verdict::Verdict;
use super::vocabulary::Vocabulary;
use crate::tex::{Equation, Relation, read};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

use toml::Spanned;

/// A sheet, every formula read.
#[derive(Clone, Debug)]
pub struct Sheet {
    pub title: Option<String>,
    pub vocabulary: Vocabulary,
    pub entries: Vec<Entry>,
}

/// What a formula is to its sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// To be decided.
    Claim,
    /// Taken as true.
    Premise,
    /// Kept as printed; read only where a claim rests on it.
    Definition,
}

/// One `[[equation]]`.
#[derive(Clone, Debug)]
pub struct Entry {
    pub label: String,
    pub role: Role,
    /// The TeX as it stands in the sheet.
    pub tex: Source,
    /// What is read of it; nothing of a definition that nothing rests on.
    pub equations: Vec<Equation>,
    /// Local definitions, with their sources.
    pub local: Vec<(Equation, Source)>,
    /// Substitutions in the premises, with their sources.
    pub with: Vec<(Equation, Source)>,
    /// The entries it follows from, by position in the sheet.
    pub follows_from: Vec<usize>,
    pub expect: Verdict,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSheet {
    title: Option<String>,
    symbols: Option<Spanned<Symbols>>,
    #[serde(default)]
    equation: Vec<RawEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEntry {
    label: Spanned<String>,
    role: Role,
    tex: Spanned<String>,
    #[serde(default, rename = "where")]
    local: Vec<Spanned<String>>,
    #[serde(default)]
    with: Vec<Spanned<String>>,
    follows_from: Option<Vec<Spanned<String>>>,
    #[serde(default)]
    expect: Verdict,
}

/// The `[symbols]` block of a file that holds nothing else.
///
/// # Errors
/// A [`Fault`] with its place.
pub fn read_symbols(text: &str) -> Result<Vocabulary, Fault> {
    let raw: RawSheet = parse(text)?;
    read_checked(&raw.symbols.map(Spanned::into_inner).unwrap_or_default())
}

fn read_checked(symbols: &Symbols) -> Result<Vocabulary, Fault> {
    let vocabulary = Vocabulary::read(symbols)?;
    vocabulary.check()?;
    Ok(vocabulary)
}

impl Sheet {
    /// Reads a sheet. Without `[symbols]` of its own it speaks `vocabulary`.
    ///
    /// # Errors
    /// A [`Fault`]: malformed TOML or TeX, a label given twice, a premise that does not exist, a claim without
    /// premises or with itself among them, a sheet without an equation.
    pub fn read(text: &str, vocabulary: &Vocabulary) -> Result<Self, Fault> {
        let raw: RawSheet = parse(text)?;
        if raw.equation.is_empty() {
            return Err(Fault::new("the sheet has no [[equation]]"));
        }
        let vocabulary = match &raw.symbols {
            None => vocabulary.clone(),
            Some(symbols) => read_checked(&with_labels(symbols.get_ref(), &raw.equation)).map_err(|fault| {
                let here = Source::new(text, &Spanned::new(symbols.span(), String::new()));
                fault.within("[symbols]").at(&here)
            })?,
        };
        let positions = positions(text, &raw.equation)?;
        let needed: BTreeSet<&str> = raw
            .equation
            .iter()
            .filter(|e| e.role == Role::Claim)
            .flat_map(|e| e.follows_from.iter().flatten().map(|label| label.get_ref().as_str()))
            .collect();
        let mut entries = Vec::new();
        for entry in &raw.equation {
            let label = entry.label.get_ref();
            let wanted = entry.role != Role::Definition || needed.contains(label.as_str());
            let read = read_entry(text, entry, &positions, &vocabulary, wanted);
            entries.push(read.map_err(|fault| fault.of(label))?);
        }
        if entries.iter().all(|entry: &Entry| entry.role != Role::Claim) {
            let problem = "the sheet has no claim: give an equation that is to be decided `role = \"claim\"`";
            return Err(Fault::new(problem).at(&Source::new(text, &Spanned::new(0..0, String::new()))));
        }
        let sheet = Self {
            title: raw.title,
            vocabulary,
            entries,
        };
        sheet.refuse_circles()?;
        Ok(sheet)
    }

    /// The position of the entry with this label.
    pub fn find(&self, label: &str) -> Option<usize> {
        self.entries.iter().position(|entry| entry.label == label)
    }

    fn refuse_circles(&self) -> Result<(), Fault> {
        let claims = |at: usize| {
            let entry = self.entries.get(at).filter(|entry| entry.role == Role::Claim);
            entry.map(|entry| entry.follows_from.as_slice()).unwrap_or_default()
        };
        for (start, entry) in self.entries.iter().enumerate() {
            let mut reached: Vec<usize> = claims(start).to_vec();
            let mut next = 0;
            while let Some(&at) = reached.get(next) {
                if at == start {
                    let problem = "leads back to itself through `follows_from`: a claim cannot be its own premise";
                    return Err(Fault::new(problem).of(&entry.label).at(&entry.tex));
                }
                let more: Vec<usize> = claims(at).iter().filter(|n| !reached.contains(n)).copied().collect();
                reached.extend(more);
                next += 1;
            }
        }
        Ok(())
    }
}

fn parse(text: &str) -> Result<RawSheet, Fault> {
    toml::from_str(text).map_err(|error: toml::de::Error| {
        let fault = Fault::new(error.message());
        match error.span() {
            Some(span) => fault.at(&Source::new(text, &Spanned::new(span, String::new()))),
            None => fault,
        }
    })
}

/// The symbols with each map that lists labels of the sheet given the TeX of these instead.
fn with_labels(symbols: &Symbols, entries: &[RawEntry]) -> Symbols {
    let mut symbols = symbols.clone();
    let tex = |label: &String| {
        entries
            .iter()
            .find(|e| e.label.get_ref() == label)
            .map(|e| e.tex.get_ref().clone())
    };
    for entry in symbols.maps.values_mut() {
        if let MapEntry::List(list) = entry
            && let Some(equations) = list.iter().map(tex).collect::<Option<Vec<_>>>()
        {
            *list = equations;
        }
    }
    symbols
}

fn positions<'a>(text: &str, entries: &'a [RawEntry]) -> Result<BTreeMap<&'a str, usize>, Fault> {
    let mut positions = BTreeMap::new();
    for (position, entry) in entries.iter().enumerate() {
        let label = entry.label.get_ref();
        let problem = if label.trim().is_empty() {
            "a label must not be empty"
        } else if positions.insert(label.as_str(), position).is_some() {
            "this label is given twice"
        } else {
            continue;
        };
        return Err(Fault::new(problem).of(label).at(&Source::new(text, &entry.label)));
    }
    Ok(positions)
}

fn read_entry(
    text: &str,
    raw: &RawEntry,
    positions: &BTreeMap<&str, usize>,
    vocabulary: &Vocabulary,
    wanted: bool,
) -> Result<Entry, Fault> {
    let tex = Source::new(text, &raw.tex);
    let equations = if wanted {
        read_tex(&tex, vocabulary)?
    } else {
        Vec::new()
    };
    let sourced = |list: &[Spanned<String>]| -> Result<Vec<(Equation, Source)>, Fault> {
        let sources = list.iter().map(|text_of| Source::new(text, text_of));
        let read = sources.map(|source| {
            let equations = read_tex(&source, vocabulary)?;
            Ok(equations
                .into_iter()
                .map(|equation| (equation, source.clone()))
                .collect::<Vec<_>>())
        });
        Ok(read.collect::<Result<Vec<_>, Fault>>()?.concat())
    };
    let mut follows_from = Vec::new();
    for label in raw.follows_from.iter().flatten() {
        let Some(&position) = positions.get(label.get_ref().as_str()) else {
            let known = positions.keys().copied().collect::<Vec<_>>().join(", ");
            let problem = format!(
                "follows from `{}`, which is no label here (there are: {known})",
                label.get_ref()
            );
            return Err(Fault::new(problem).at(&Source::new(text, label)));
        };
        if !follows_from.contains(&position) {
            follows_from.push(position);
        }
    }
    if raw.role == Role::Claim && follows_from.is_empty() {
        return Err(Fault::new("a claim must say in `follows_from` what it follows from").at(&tex));
    }
    Ok(Entry {
        label: raw.label.get_ref().clone(),
        role: raw.role,
        equations,
        local: sourced(&raw.local)?,
        with: sourced(&raw.with)?,
        follows_from,
        expect: raw.expect,
        tex,
    })
}

fn read_tex(source: &Source, vocabulary: &Vocabulary) -> Result<Vec<Equation>, Fault> {
    let equations =
        read(&source.tex, &vocabulary.names).map_err(|error| source.fault(error.at, error.reason.to_string()))?;
    match equations.iter().find(|equation| equation.relation != Relation::Equal) {
        Some(other) => Err(source.fault(other.at.0, NO_INEQUALITIES)),
        None => Ok(equations),
    }
}
