//! A scene's TOML as a table from keys to what was typed, each with its place; nothing is interpreted yet.

use super::Quantity;
use super::error::{Origin, SceneError, SceneProblem};
use super::key::{Allowed, Key, SECTIONS, instead_of_key, instead_of_section};
use std::borrow::Cow;
use texmath::Place;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The most characters of a value that an error repeats.
const MOST_SHOWN: usize = 40;

/// What was typed for a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub value: Value,
    /// As it was typed, shortened.
    pub shown: String,
    pub origin: Origin,
}

/// A value of TOML, as far as scenes have it; numbers as typed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Text(String),
    Number(String),
    List(Vec<Entry>),
    /// By name, in order.
    Table(Vec<(String, Entry)>),
    /// A flag or a date: nothing in a scene is one.
    Other,
}

/// The keys of a scene with what was typed for them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Document {
    name: String,
    entries: Vec<(&'static Key, Entry)>,
    /// The sections that are there, empty ones too.
    sections: Vec<(&'static str, Origin)>,
}

/// Text being read, and how its places are named.
struct Reading<'a> {
    text: &'a str,
    /// The argument of `--set` that the text is the value of.
    argument: Option<&'a str>,
}

impl Reading<'_> {
    fn origin(&self, at: usize) -> Origin {
        match self.argument {
            Some(argument) => Origin::Set(shortened(argument)),
            None => Origin::File(Place::of(self.text, at)),
        }
    }

    fn entry(&self, value: &Spanned<DeValue>) -> Entry {
        let shown = self.text.get(value.span()).unwrap_or_default();
        Entry {
            value: self.value(value.get_ref()),
            shown: shortened(shown),
            origin: self.origin(value.span().start),
        }
    }

    fn value(&self, value: &DeValue) -> Value {
        match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Float(float) => Value::Number(float.as_str().to_string()),
            DeValue::Integer(integer) if integer.radix() == 10 => Value::Number(integer.as_str().to_string()),
            DeValue::Integer(integer) => match i128::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(number) => Value::Number(number.to_string()),
                Err(_) => Value::Other,
            },
            DeValue::Array(list) => Value::List(list.iter().map(|item| self.entry(item)).collect()),
            DeValue::Table(keys) => {
                let entries = in_order(keys).into_iter();
                Value::Table(
                    entries
                        .map(|(key, value)| (key.get_ref().to_string(), self.entry(value)))
                        .collect(),
                )
            }
            DeValue::Boolean(_) | DeValue::Datetime(_) => Value::Other,
        }
    }
}

/// The first line of `text`, cut where it is long.
fn shortened(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    let mut shown: String = line.chars().take(MOST_SHOWN).collect();
    if shown.len() < text.trim_end().len() {
        shown.push('…');
    }
    shown
}

/// What to write instead of a line that is no TOML, where that can be told.
fn advice_on(line: &str) -> Option<String> {
    let line = line.split('#').next()?.trim();
    if line.starts_with('[') && !line.contains([']', '=']) {
        return Some(format!("the name of the section lacks its `]`: write `{line}]`"));
    }
    let Some((key, value)) = line.split_once('=') else {
        let (key, value) = line.split_once(':')?;
        return Some(format!("write `{} = {}`", key.trim(), value.trim()));
    };
    let (key, value) = (key.trim(), value.trim());
    let digits = value.trim_start_matches(['+', '-']);
    let rest = digits.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    let write = |value: &str| Some(format!("write `{key} = {value}`"));
    match rest.trim_start().chars().next() {
        _ if Quantity::read(value).is_ok() && value.contains("pi") => write(&format!("\"{value}\"")),
        None if digits.starts_with('.') => write(&value.replacen('.', "0.", 1)),
        None if digits.ends_with('.') => write(&format!("{value}0")),
        Some(',') if rest.len() < digits.len() => {
            let advice = format!("numbers have a decimal point: {}", value.replacen(',', ".", 1));
            Some(advice)
        }
        Some(c) if rest.len() < digits.len() && !"eE".contains(c) && (c.is_alphabetic() || c == '°') => Some(
            "write numbers without a unit: kg, N, rad/s, rad, m, V are taken; \"20 pi/180\" are 20 degrees".to_owned(),
        ),
        _ => None,
    }
}

impl Document {
    /// Reads the TOML of the scene called `name`.
    ///
    /// # Errors
    /// Malformed TOML, an unknown section or key, a section that is none.
    pub fn read(text: &str, name: &str) -> Result<Self, SceneError> {
        let reading = Reading { text, argument: None };
        let mut document = Self {
            name: name.to_string(),
            entries: Vec::new(),
            sections: Vec::new(),
        };
        let table = DeTable::parse(text).map_err(|error| {
            let origin = error.span().map(|span| reading.origin(span.start));
            let line = error.span().and_then(|span| {
                let (before, behind) = text.split_at_checked(span.start)?;
                let start = before.rfind('\n').map_or(0, |at| at + 1);
                Some(format!(
                    "{}{}",
                    before.get(start..)?,
                    behind.lines().next().unwrap_or_default()
                ))
            });
            let message = match error.message() {
                "duplicate key" => "this key is given twice; leave one of them out".to_owned(),
                message => line
                    .as_deref()
                    .and_then(advice_on)
                    .unwrap_or_else(|| message.to_owned()),
            };
            document.error(origin, SceneProblem::Syntax(message))
        })?;
        for (key, value) in in_order(table.get_ref()) {
            let origin = reading.origin(key.span().start);
            let section = SECTIONS.into_iter().find(|&section| section == key.get_ref());
            match (section, value.get_ref()) {
                (Some(section), DeValue::Table(keys)) => document.push_section(&reading, section, origin, keys)?,
                (Some(section), _) => {
                    let problem = SceneProblem::Value {
                        key: section.to_string(),
                        found: reading.entry(value).shown,
                        allowed: format!("a section, which starts with a line [{section}]"),
                    };
                    return Err(document.error(Some(origin), problem));
                }
                (None, DeValue::Table(_)) if Key::find("", key.get_ref()).is_none() => {
                    let problem = SceneProblem::Unknown {
                        what: "section",
                        found: format!("[{}]", shortened(key.get_ref())),
                        instead: instead_of_section(key.get_ref()),
                    };
                    return Err(document.error(Some(origin), problem));
                }
                (None, _) => document.push(&reading, "", key, value)?,
            }
        }
        Ok(document)
    }

    /// The keys of a section, and of the sections within it.
    fn push_section(
        &mut self,
        reading: &Reading,
        section: &'static str,
        origin: Origin,
        keys: &DeTable,
    ) -> Result<(), SceneError> {
        self.sections.push((section, origin));
        for (key, value) in in_order(keys) {
            let path = format!("{section}.{}", key.get_ref());
            match (SECTIONS.into_iter().find(|&known| known == path), value.get_ref()) {
                (Some(inner), DeValue::Table(keys)) => {
                    self.push_section(reading, inner, reading.origin(key.span().start), keys)?;
                }
                _ => self.push(reading, section, key, value)?,
            }
        }
        Ok(())
    }

    fn push(
        &mut self,
        reading: &Reading,
        section: &str,
        key: &Spanned<Cow<str>>,
        value: &Spanned<DeValue>,
    ) -> Result<(), SceneError> {
        let Some(known) = Key::find(section, key.get_ref()) else {
            return Err(self.error(
                Some(reading.origin(key.span().start)),
                unknown_key(section, key.get_ref()),
            ));
        };
        self.entries.push((known, reading.entry(value)));
        Ok(())
    }

    /// Gives a key another value, or one that it did not have, by `argument`, `key=value`. The value is TOML; what
    /// is not is text, unless it has the signs of TOML.
    ///
    /// # Errors
    /// An argument without `=`, an unknown key, a section alone, a value that is neither TOML nor a word.
    pub fn set(&mut self, argument: &str) -> Result<(), SceneError> {
        let refuse = |document: &Self, problem| Err(document.error(Some(Origin::Set(shortened(argument))), problem));
        let Some((path, typed)) = argument.split_once('=') else {
            return refuse(self, SceneProblem::Override(String::new()));
        };
        let (path, typed) = (path.trim(), typed.trim());
        let (section, name) = path.rsplit_once('.').unwrap_or(("", path));
        if let Some(own) = SECTIONS.into_iter().find(|&known| known == path) {
            if let Ok(value) = DeValue::parse(typed)
                && let DeValue::Table(keys) = value.get_ref()
            {
                return self.set_section(own, keys, argument, typed);
            }
            let problem = SceneProblem::Override(format!(": {path} is a section, name a key in it"));
            return refuse(self, problem);
        }
        let Some(key) = Key::find(section, name) else {
            let problem = if section.is_empty() || SECTIONS.contains(&section) {
                unknown_key(section, name)
            } else {
                SceneProblem::Unknown {
                    what: "section",
                    found: format!("[{}]", shortened(section)),
                    instead: instead_of_section(section),
                }
            };
            return refuse(self, problem);
        };
        let reading = Reading {
            text: typed,
            argument: Some(argument),
        };
        let entry = match DeValue::parse(typed) {
            Ok(value) => reading.entry(&value),
            Err(_) if is_bare(typed) => Entry {
                value: Value::Text(typed.to_string()),
                shown: shortened(typed),
                origin: reading.origin(0),
            },
            Err(error) => {
                let at = error.span().map_or(0, |span| span.start.min(typed.len()));
                let place = argument.trim_end().len() - typed.len() + at;
                let column = argument.get(..place).unwrap_or(argument).chars().count() + 1;
                let is_list = matches!(key.allowed, Allowed::Names) && !typed.contains(['[', '"']);
                let list = || {
                    typed
                        .split(',')
                        .map(|name| format!("\"{}\"", name.trim()))
                        .collect::<Vec<_>>()
                };
                let message = match is_list {
                    true => format!("; several are a list: --set '{path}=[{}]'", list().join(", ")),
                    false => match advice_on(argument) {
                        Some(advice) => format!("; {advice}"),
                        None => format!(": column {column}: {}", error.message()),
                    },
                };
                return refuse(self, SceneProblem::Override(message));
            }
        };
        if !key.section.is_empty() && !self.has_section(key.section) {
            self.sections.push((key.section, entry.origin.clone()));
        }
        self.put(key, entry);
        Ok(())
    }

    /// Gives the keys of a section their values, and those of the sections within it.
    fn set_section(
        &mut self,
        section: &'static str,
        keys: &DeTable,
        argument: &str,
        typed: &str,
    ) -> Result<(), SceneError> {
        let reading = Reading {
            text: typed,
            argument: Some(argument),
        };
        // all of it, or nothing
        let mut given = Self {
            name: self.name.clone(),
            entries: Vec::new(),
            sections: Vec::new(),
        };
        given.push_section(&reading, section, reading.origin(0), keys)?;
        for (own, origin) in given.sections {
            if !self.has_section(own) {
                self.sections.push((own, origin));
            }
        }
        for (key, entry) in given.entries {
            self.put(key, entry);
        }
        Ok(())
    }

    fn put(&mut self, key: &'static Key, entry: Entry) {
        match self.entries.iter_mut().find(|(known, _)| *known == key) {
            Some((_, old)) => *old = entry,
            None => self.entries.push((key, entry)),
        }
    }

    /// How errors name the scene.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What was typed for a key.
    pub fn get(&self, key: &Key) -> Option<&Entry> {
        self.entries
            .iter()
            .find(|(known, _)| *known == key)
            .map(|(_, entry)| entry)
    }

    /// The keys that are there, with what was typed for them, in the order of the file; overrides of others after.
    pub fn entries(&self) -> impl Iterator<Item = (&'static Key, &Entry)> {
        self.entries.iter().map(|(key, entry)| (*key, entry))
    }

    /// Whether there is such a section.
    pub fn has_section(&self, name: &str) -> bool {
        self.section(name).is_some()
    }

    /// Where a section starts.
    pub fn section(&self, name: &str) -> Option<&Origin> {
        self.sections
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, origin)| origin)
    }

    /// A problem of this scene.
    pub fn error(&self, origin: Option<Origin>, problem: impl Into<SceneProblem>) -> SceneError {
        SceneError {
            name: self.name.clone(),
            origin,
            problem: Box::new(problem.into()),
        }
    }
}

fn unknown_key(section: &str, name: &str) -> SceneProblem {
    let dot = if section.is_empty() { "" } else { "." };
    SceneProblem::Unknown {
        what: "key",
        found: format!("{section}{dot}{}", shortened(name)),
        instead: instead_of_key(section, name),
    }
}

/// Whether text that is no TOML may stand for itself.
fn is_bare(text: &str) -> bool {
    !text.is_empty() && !text.contains(['"', '\'', '[', ']', '{', '}', '=', '#', ',', '\n', '\r'])
}

type Pair<'a, 'i> = (&'a Spanned<Cow<'i, str>>, &'a Spanned<DeValue<'i>>);

/// The keys in the order in which they stand in the file, so that the first mistake is the one that is told.
fn in_order<'a, 'i>(table: &'a DeTable<'i>) -> Vec<Pair<'a, 'i>> {
    let mut pairs: Vec<Pair> = table.iter().collect();
    pairs.sort_by_key(|(key, _)| key.span().start);
    pairs
}

#[cfg(test)]
mod tests {
    use super::super::key;
    use super::*;

    fn number(text: &str) -> Value {
        Value::Number(text.to_string())
    }

    #[test]
    fn numbers_stay_as_they_were_typed() {
        let document = Document::read("[motion]\nd = 0.2600\nr_b = 5_0e-2\nr_t = 0x10", "x").unwrap();
        let value = |key| document.get(key).map(|entry| entry.value.clone());
        assert_eq!(value(&key::D), Some(number("0.2600")));
        assert_eq!(value(&key::R_B), Some(number("50e-2")));
        assert_eq!(value(&key::R_T), Some(number("16")));
        assert_eq!(
            document.get(&key::R_B).map(|entry| entry.shown.as_str()),
            Some("5_0e-2")
        );
    }

    #[test]
    fn what_is_no_toml_is_told_as_it_is_to_be_written() {
        for (line, wanted) in [
            ("d = .3", "write `d = 0.3`"),
            ("d = 3.", "write `d = 3.0`"),
            ("d = 0,3", "numbers have a decimal point: 0.3"),
            ("d = -1,5 # wide", "numbers have a decimal point: -1.5"),
            ("d: 0.3", "write `d = 0.3`"),
            ("d = 0.3 m", "write numbers without a unit"),
            ("d = 20°", "\"20 pi/180\" are 20 degrees"),
            ("d = 1e", "line 2, column 7"),
            ("d = pi/9", "write `d = \"pi/9\"`"),
            ("d = 0.3\nd = 0.4", "line 3, column 1: this key is given twice"),
            ("d = 0.3\n[start", "write `[start]`"),
        ] {
            let error = Document::read(&format!("[motion]\n{line}"), "x")
                .unwrap_err()
                .to_string();
            assert!(error.contains(wanted), "{line}: {error}");
        }
        let mut document = Document::read("motion.d = 0.26", "x").unwrap();
        for (argument, wanted) in [
            ("motion.d=0,25", "numbers have a decimal point: 0.25"),
            ("words=BT,BTT", "--set 'words=[\"BT\", \"BTT\"]'"),
            ("motion.r=0.5", "did you mean r_b or r_t?"),
            ("device.mass=1", "did you mean device.capsule_mass?"),
            ("periods=2", "did you mean max_periods?"),
        ] {
            let error = document.set(argument).unwrap_err().to_string();
            assert!(error.contains(wanted), "{argument}: {error}");
        }
    }

    #[test]
    fn an_override_replaces_or_adds_and_a_bare_word_is_text() {
        let mut document = Document::read("motion.d = 0.26", "x").unwrap();
        for argument in [
            "motion.d=0.3",
            "device.incline = pi/6",
            "sweep.start=follow",
            "words=[\"BT\", \"BTT\"]",
        ] {
            document.set(argument).unwrap();
        }
        let value = |key| document.get(key).map(|entry| entry.value.clone());
        assert_eq!(value(&key::D), Some(number("0.3")));
        assert_eq!(value(&key::INCLINE), Some(Value::Text("pi/6".to_string())));
        assert_eq!(value(&key::BEGIN), Some(Value::Text("follow".to_string())));
        assert!(matches!(value(&key::WORDS), Some(Value::List(words)) if words.len() == 2));
        assert!(document.has_section("sweep") && !document.has_section("membrane"));
        assert_eq!(document.entries().count(), 4);
    }

    #[test]
    fn a_section_may_be_given_at_once_and_whole() {
        let mut document = Document::read("motion.d = 0.26", "x").unwrap();
        document
            .set("map={impacts = 9, x = {over = \"d\", points = 3}}")
            .unwrap();
        let value = |document: &Document, key| document.get(key).map(|entry| entry.value.clone());
        assert_eq!(value(&document, &key::MAP_IMPACTS), Some(number("9")));
        assert_eq!(value(&document, &key::X_POINTS), Some(number("3")));
        assert!(document.has_section("map.x") && !document.has_section("map.y"));
        let before = document.clone();
        assert!(document.set("map.x={from = 1, form = 2}").is_err());
        assert_eq!(document, before);
    }

    #[test]
    fn an_override_that_is_none_changes_nothing() {
        let before = Document::read("motion.d = 0.26", "x").unwrap();
        for argument in [
            "",
            "=",
            "motion.d",
            "motion=0.3",
            "motion.=1",
            "motion.dd=1",
            "moton.d=1",
            "motion.d=",
            "motion.d=[1",
            "motion.d=1\nr_b=2",
            "motion.d.x=1",
            ".d=1",
        ] {
            let mut document = before.clone();
            let error = document.set(argument).unwrap_err();
            assert!(matches!(error.origin, Some(Origin::Set(_))), "{argument}: {error}");
            assert_eq!(document, before, "{argument}");
        }
    }

    #[test]
    fn the_first_mistake_in_the_file_is_told() {
        let error = Document::read("[motion]\nzeta = 1\nalpha = 2\n", "x").unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("x: line 2, column 1: there is no key motion.zeta"),
            "{error}"
        );
    }
}
