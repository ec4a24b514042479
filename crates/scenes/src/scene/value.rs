//! One key of a scene, from what was typed to what it means.

use super::document::{Entry, Value};
use super::error::{SceneError, SceneProblem};
use super::key::{self, Allowed, Key};
use super::{Quantity, QuantityError, Scene, Want};

impl Scene {
    /// What was typed for a key that `by` cannot do without.
    pub(super) fn require(&self, key: &'static Key, by: Option<Want>) -> Result<&Entry, SceneError> {
        self.document.get(key).ok_or_else(|| {
            let section = self.document.section(key.section);
            let where_to = match section {
                _ if key.section.is_empty() => String::new(),
                Some(_) => format!(", which [{}] lacks", key.section),
                None => format!("; there is no section [{}]", key.section),
            };
            let problem = SceneProblem::Missing {
                by,
                key: key.path(),
                meaning: key.asked(),
                where_to,
            };
            self.error(section.cloned(), problem)
        })
    }

    /// Checks one key by itself, where it is given.
    pub(super) fn check_key(&self, key: &'static Key) -> Result<(), SceneError> {
        let Some(entry) = self.document.get(key) else {
            return Ok(());
        };
        match key.allowed {
            Allowed::OneOf(_) => drop(self.one_of_known(key)?),
            Allowed::Text | Allowed::Parameter => drop(self.text(key, entry)?),
            Allowed::Names if *key == key::WORDS => drop(self.words()?),
            Allowed::Names if *key == key::MAP_WANT => drop(self.wants_of_map()?),
            Allowed::Names => drop(self.want()?),
            Allowed::Starts => drop(self.starts()?),
            Allowed::Numbers => drop(self.numbers(key)?),
            Allowed::Range => drop(self.range_of(key)?),
            Allowed::Count(_) => drop(self.count(key)?),
            _ => drop(self.number(key)?),
        }
        Ok(())
    }

    /// The number of a key.
    pub(super) fn number(&self, key: &'static Key) -> Result<Quantity, SceneError> {
        self.number_in(key, self.require(key, None)?)
    }

    /// The number that was typed as that of a key.
    pub(super) fn number_in(&self, key: &'static Key, entry: &Entry) -> Result<Quantity, SceneError> {
        let (Value::Text(typed) | Value::Number(typed)) = &entry.value else {
            return Err(self.wrong(key, entry, QuantityError::NoNumber.to_string()));
        };
        let told = |error: QuantityError| match error {
            QuantityError::NoNumber => format!("{error}; it is {}", key.described()),
            error => error.to_string(),
        };
        let value = Quantity::read(typed).map_err(|error| self.wrong(key, entry, told(error)))?;
        match key.allowed.instead_of(&value) {
            None => Ok(value),
            Some(allowed) => Err(self.wrong(key, entry, allowed)),
        }
    }

    /// The numbers of a list; none where the key is not given.
    pub(super) fn numbers(&self, key: &'static Key) -> Result<Vec<Quantity>, SceneError> {
        let Some(entry) = self.document.get(key) else {
            return Ok(Vec::new());
        };
        match &entry.value {
            Value::List(list) => list.iter().map(|item| self.number_in(key, item)).collect(),
            _ => Err(self.wrong(key, entry, key.allowed.in_words())),
        }
    }

    /// The text of a key, one of those that it may have; the first where it is not given.
    pub(super) fn one_of_known(&self, key: &'static Key) -> Result<&'static str, SceneError> {
        let Allowed::OneOf(known) = key.allowed else {
            return Ok("");
        };
        let Some(entry) = self.document.get(key) else {
            return Ok(known[0]);
        };
        let name = self.text(key, entry)?;
        let found = known.iter().find(|known| **known == name);
        found
            .copied()
            .ok_or_else(|| self.wrong(key, entry, key::one_of(name, known)))
    }

    pub(super) fn count_or(&self, key: &'static Key, default: u32) -> Result<u32, SceneError> {
        match self.document.get(key) {
            None => Ok(default),
            Some(_) => self.count(key),
        }
    }

    pub(super) fn count(&self, key: &'static Key) -> Result<u32, SceneError> {
        let entry = self.require(key, None)?;
        let most = match key.allowed {
            Allowed::Count(most) => most,
            _ => u32::MAX,
        };
        let number = match &entry.value {
            Value::Number(typed) => typed.parse::<u32>().ok(),
            _ => None,
        };
        number
            .filter(|number| (1..=most).contains(number))
            .ok_or_else(|| self.wrong(key, entry, key.allowed.in_words()))
    }

    pub(super) fn text<'a>(&self, key: &'static Key, entry: &'a Entry) -> Result<&'a str, SceneError> {
        match &entry.value {
            Value::Text(text) => Ok(text),
            _ => Err(self.wrong(key, entry, Allowed::Text.in_words())),
        }
    }

    /// The texts of a list; one alone counts as a list of one.
    pub(super) fn names(&self, key: &'static Key) -> Result<Vec<(&str, &Entry)>, SceneError> {
        let Some(entry) = self.document.get(key) else {
            return Ok(Vec::new());
        };
        let list = match &entry.value {
            Value::List(list) => list.iter().collect(),
            _ => vec![entry],
        };
        list.into_iter()
            .map(|item| match &item.value {
                Value::Text(text) => Ok((text.as_str(), item)),
                _ => Err(self.wrong(key, item, key.allowed.in_words())),
            })
            .collect()
    }

    pub(super) fn wrong(&self, key: &Key, entry: &Entry, allowed: String) -> SceneError {
        let problem = SceneProblem::Value {
            key: key.path(),
            found: entry.shown.clone(),
            allowed,
        };
        self.error(Some(entry.origin.clone()), problem)
    }
}
