//! The `set` of a golden row: overrides of its scene, and what names one row of several.

use super::quantity::FieldName;
use super::records::Record;
use super::{Fault, Figures};

/// What stands before a selector's column.
const ROW: &str = "row.";

/// What a `set` holds.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Setting {
    /// Keys of the scene with their values as written, in order.
    pub overrides: Vec<(String, String)>,
    /// Which row is meant.
    pub selectors: Vec<Selector>,
}

/// A condition on a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selector {
    /// The field it looks at.
    pub field: FieldName,
    /// What it must be.
    pub wanted: Wanted,
}

/// What a field must be for its row to be meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// A number that rounds to this one: within half a unit of its last figure; a count is equal to it.
    Number(Figures),
    /// The number nearest to this one.
    Nearest(Figures),
    /// This word.
    Word(String),
}

impl Setting {
    /// Reads `key=value;row.column=value`: overrides as `--set` takes them, joined by `;`, and selectors. `;` may
    /// stand within quotes.
    ///
    /// # Errors
    /// A part without `=` or with an empty side, a key that stands twice, a selector that names no field.
    pub fn read(record: &Record) -> Result<Self, Fault> {
        let fault = |message: String| record.fault("set", message);
        let mut setting = Self::default();
        for part in parts(record.field("set")) {
            let allowed = "`key=value` or `row.column=value`, joined by `;`, is";
            let (key, value) = part
                .split_once('=')
                .map(|(key, value)| (key.trim(), value.trim()))
                .filter(|(key, value)| !key.is_empty() && !value.is_empty())
                .ok_or_else(|| fault(format!("`{part}` is no setting; {allowed}")))?;
            let Some(field) = key.strip_prefix(ROW) else {
                if setting.overrides.iter().any(|(known, _)| known == key) {
                    return Err(fault(format!("`{key}` is set twice")));
                }
                setting.overrides.push((key.to_owned(), value.to_owned()));
                continue;
            };
            let field: FieldName = field
                .parse()
                .map_err(|()| fault(format!("`{key}` names no column; `row.column` or `row.column[n]` does")))?;
            if setting.selectors.iter().any(|known| known.field == field) {
                return Err(fault(format!("`{key}` is set twice")));
            }
            let wanted = wanted(value).ok_or_else(|| fault(format!("`{value}`: a number follows `near`")))?;
            setting.selectors.push(Selector { field, wanted });
        }
        Ok(setting)
    }

    /// Whether the rows it names are those of this word, by its own statement.
    pub fn names_word(&self, word: &str) -> bool {
        self.selectors
            .iter()
            .any(|selector| selector.field.column == "word" && selector.wanted == Wanted::Word(word.to_owned()))
    }
}

fn wanted(value: &str) -> Option<Wanted> {
    if let Some(number) = value.strip_prefix("near ") {
        return Figures::read(number.trim()).map(Wanted::Nearest);
    }
    Some(Figures::read(value).map_or_else(|| Wanted::Word(value.to_owned()), Wanted::Number))
}

/// The parts between those `;` that stand outside quotes; empty ones left out.
fn parts(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut quote = None;
    let mut start = 0;
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            (None, ';') => {
                parts.extend(text.get(start..at));
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.extend(text.get(start..));
    parts.retain(|part| !part.trim().is_empty());
    parts
}

#[cfg(test)]
mod tests {
    use super::super::records;
    use super::*;

    fn read(set: &str) -> Result<Setting, String> {
        let text = format!("id,set\na,\"{}\"\n", set.replace('"', "\"\""));
        let records = records::read("x.csv", &text, &["id", "set"]).map_err(|fault| fault.to_string())?;
        let record = records.first().ok_or("no record")?;
        Setting::read(record).map_err(|fault| fault.to_string())
    }

    #[test]
    fn overrides_and_selectors_are_told_apart() {
        let setting =
            read("motion.d = 0.26; words=['BTT'];row.word=BTT;row.d=near 0.4;title='a;b'").unwrap_or_default();
        let keys: Vec<(&str, &str)> = setting
            .overrides
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()))
            .collect();
        assert_eq!(keys, [("motion.d", "0.26"), ("words", "['BTT']"), ("title", "'a;b'")]);
        assert!(setting.names_word("BTT") && !setting.names_word("BT"));
        assert!(matches!(
            setting.selectors.get(1).map(|selector| &selector.wanted),
            Some(Wanted::Nearest(_))
        ));
        assert_eq!(read(""), Ok(Setting::default()));
    }

    #[test]
    fn what_is_no_setting_is_named() {
        for (set, word) in [
            ("motion.d", "`motion.d` is no setting"),
            ("=3", "is no setting"),
            ("motion.d=", "is no setting"),
            ("a=1;a=2", "`a` is set twice"),
            ("row.d=1;row.d=2", "`row.d` is set twice"),
            ("row.=1", "names no column"),
            ("row.v[x]=1", "names no column"),
            ("row.d=near here", "a number follows `near`"),
        ] {
            let found = read(set).map_or_else(|message| message, |setting| format!("{setting:?}"));
            assert!(
                found.contains(word) && found.starts_with("x.csv, line 2, column `set`"),
                "{set}: {found}"
            );
        }
    }
}
