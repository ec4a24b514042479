//! `[symbols]` as it stands in a sheet.

use super::fault::Fault;
use serde::Deserialize;
use std::collections::BTreeMap;

/// `[symbols]` as it stands in the file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Symbols {
    pub parameters: Vec<String>,
    pub generic: Vec<String>,
    pub positive: Vec<String>,
    pub at_most_one: Vec<String>,
    pub nonnegative: Vec<String>,
    pub nonzero: Vec<String>,
    pub integers: Vec<String>,
    pub complex: Vec<String>,
    pub indices: Vec<String>,
    pub times: Vec<String>,
    pub states: Vec<String>,
    pub continuous: Vec<String>,
    pub functions: Pairs,
    pub periods: Pairs,
    pub abbreviations: Pairs,
    pub relations: Pairs,
    pub maps: BTreeMap<String, MapEntry>,
    /// True if a document uses no others; else what it does not declare is guessed.
    #[serde(skip)]
    pub only: bool,
}

impl Symbols {
    /// These and more.
    ///
    /// # Errors
    /// A [`Fault`] where a pair has more than one `=`.
    pub(super) fn and(self, more: Self) -> Result<Self, Fault> {
        let list = |one: Vec<String>, other: Vec<String>| [one, other].concat();
        let pairs = |one: Pairs, other: Pairs| -> Result<Pairs, Fault> {
            let all = [one.pairs()?, other.pairs()?].concat().into_iter();
            Ok(Pairs::List(
                all.map(|(left, right)| format!("{left} = {right}")).collect(),
            ))
        };
        Ok(Self {
            parameters: list(self.parameters, more.parameters),
            generic: list(self.generic, more.generic),
            positive: list(self.positive, more.positive),
            at_most_one: list(self.at_most_one, more.at_most_one),
            nonnegative: list(self.nonnegative, more.nonnegative),
            nonzero: list(self.nonzero, more.nonzero),
            integers: list(self.integers, more.integers),
            complex: list(self.complex, more.complex),
            indices: list(self.indices, more.indices),
            times: list(self.times, more.times),
            states: list(self.states, more.states),
            continuous: list(self.continuous, more.continuous),
            functions: pairs(self.functions, more.functions)?,
            periods: pairs(self.periods, more.periods)?,
            abbreviations: pairs(self.abbreviations, more.abbreviations)?,
            relations: pairs(self.relations, more.relations)?,
            maps: self.maps.into_iter().chain(more.maps).collect(),
            only: self.only || more.only,
        })
    }

    /// The lists of kinds: what stands in one of these need not stand among the parameters too.
    pub(super) fn kinds(&self) -> [&[String]; 6] {
        [
            &self.nonnegative,
            &self.nonzero,
            &self.integers,
            &self.complex,
            &self.at_most_one,
            &self.positive,
        ]
    }
}

/// Left and right sides, as a table or as a list of equations.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Pairs {
    Table(BTreeMap<String, String>),
    List(Vec<String>),
}

impl Default for Pairs {
    fn default() -> Self {
        Self::List(Vec::new())
    }
}

impl Pairs {
    /// The pairs; a list entry without `=` has an empty right side.
    pub(super) fn pairs(&self) -> Result<Vec<(String, String)>, Fault> {
        let clean = |a: &str, b: &str| (a.trim().to_string(), b.trim().to_string());
        match self {
            Self::Table(table) => Ok(table.iter().map(|(a, b)| clean(a, b)).collect()),
            Self::List(list) => list
                .iter()
                .map(|text| match text.split_once('=') {
                    Some((_, b)) if b.contains('=') => Err(Fault::new(format!("`{text}` has more than one `=`"))),
                    Some((a, b)) => Ok(clean(a, b)),
                    None => Ok(clean(text, "")),
                })
                .collect(),
        }
    }
}

/// An entry of `[symbols.maps]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum MapEntry {
    Product(String),
    List(Vec<String>),
    Of { of: Vec<String>, by: Vec<String> },
}
