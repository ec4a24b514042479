//! `vibro-audit --columns COMMAND [--schema]`: what stands in each column, in a form for programs.

use super::{Answer, Content, Exit, Failure};
use crate::report::{Cell, FORMULAS, Form, NUMBERS, Table};
use clap::builder::PossibleValuesParser;
use serde_json::{Map, Value, json};
use std::sync::LazyLock;

/// The version of the descriptions; it grows where a column goes or changes its type, not where one is added.
pub const COLUMNS_VERSION: u32 = 1;

/// Every column of every command, a line each.
const COLUMNS: &str = include_str!("columns.csv");

/// What a column is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Description {
    /// The command, with the flag that changes its columns.
    pub command: String,
    /// The name of the column.
    pub column: String,
    /// What its cells are.
    pub form: Form,
    /// The unit; `1` for what has none, nothing for what is no quantity.
    pub unit: String,
    /// Whether a cell may be empty, or the column not there.
    pub is_optional: bool,
    /// What it means.
    pub meaning: String,
}

static DESCRIPTIONS: LazyLock<Vec<Description>> = LazyLock::new(|| {
    let mut reader = csv::Reader::from_reader(COLUMNS.as_bytes());
    reader.records().flatten().filter_map(|record| read(&record)).collect()
});

fn read(record: &csv::StringRecord) -> Option<Description> {
    let field = |place: usize| record.get(place).map(str::to_owned);
    let form = record.get(2)?;
    Some(Description {
        command: field(0)?,
        column: field(1)?,
        form: Form::ALL.into_iter().find(|known| known.name() == form)?,
        unit: field(3)?,
        is_optional: record.get(4)?.parse().ok()?,
        meaning: field(5)?,
    })
}

/// The columns of a command, in order; a flag that changes them is part of the name, as in `sweep --summary`.
pub fn described(command: &str) -> impl Iterator<Item = &'static Description> {
    DESCRIPTIONS.iter().filter(move |known| known.command == command)
}

/// The commands whose columns are described.
pub fn described_commands() -> Vec<&'static str> {
    let mut names: Vec<&str> = DESCRIPTIONS.iter().map(|known| known.command.as_str()).collect();
    names.dedup();
    names
}

/// The arguments.
#[derive(Clone, Debug, clap::Args)]
pub struct Arguments {
    /// Describe the columns of a command, as `sweep` or "sweep --summary": name, type, unit, meaning
    #[arg(long, value_name = "COMMAND", value_parser = PossibleValuesParser::new(described_commands()), hide_possible_values = true)]
    pub columns: Option<String>,
    /// Print the columns as a JSON Schema of `--format json`
    #[arg(long, requires = "columns")]
    schema: bool,
}

impl Arguments {
    /// The descriptions of the command that is named.
    ///
    /// # Errors
    /// None but a fault of ours.
    pub(super) fn answer(&self) -> Result<Answer, Failure> {
        let command = self.columns.as_deref().unwrap_or_default();
        let content = match self.schema {
            true => Content::Text(format!("{:#}", schema(command))),
            false => Content::Table(table(command)?),
        };
        let exit = Exit::AsExpected;
        Ok(Answer { content, exit })
    }
}

fn table(command: &str) -> Result<Table, Failure> {
    let mut table = Table::new(["command", "column", "type", "unit", "optional", "meaning", "version"]);
    for known in described(command) {
        table.push([
            Cell::from(known.command.as_str()),
            Cell::from(known.column.as_str()),
            Cell::from(known.form.name()),
            Cell::from(known.unit.as_str()),
            Cell::from(known.is_optional),
            Cell::from(known.meaning.as_str()),
            Cell::from(i64::from(COLUMNS_VERSION)),
        ])?;
    }
    Ok(table)
}

/// The JSON Schema of what a command writes under `--format json`.
pub fn schema(command: &str) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    for known in described(command) {
        let mut types = match known.form {
            // JSON has no infinity and no NaN, and decimals of more figures than f64 has are strings
            Form::Number => vec![json!({"type": "number"}), json!({"type": "string", "pattern": NUMBER})],
            Form::Numbers => {
                let item = json!({"anyOf": [{"type": "number"}, {"type": "string", "pattern": NUMBER}]});
                vec![json!({"type": "array", "items": item})]
            }
            Form::Integer => vec![json!({"type": "integer"})],
            Form::Flag => vec![json!({"type": "boolean"})],
            Form::Decimal => vec![json!({"type": "string", "pattern": NUMBER})],
            // a number that is short enough to be one
            Form::Text if (command, known.column.as_str()) == ("check", "computed") => {
                vec![json!({"type": "string"}), json!({"type": "number"})]
            }
            Form::Text => vec![json!({"type": "string"})],
        };
        if known.is_optional {
            types.push(json!({"type": "null"}));
        } else {
            required.push(known.column.as_str());
        }
        let unit = match known.unit.as_str() {
            "" => String::new(),
            unit => format!(" [{unit}]"),
        };
        let meaning = format!("{}{unit}", known.meaning);
        properties.insert(known.column.clone(), json!({"description": meaning, "anyOf": types}));
    }
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": format!("vibro-audit {command} --format json"),
        "version": COLUMNS_VERSION,
        "type": "array",
        "items": {"type": "object", "properties": properties, "required": required},
    });
    if command == "audit" {
        // of a document that prints numbers: both tables
        let numbers = json!({"type": "array", "items": self::schema("check")["items"]});
        let formulas = json!({"type": "array", "items": schema["items"]});
        schema["type"] = json!(["array", "object"]);
        schema["properties"] = json!({FORMULAS: formulas, NUMBERS: numbers});
        schema["required"] = json!([FORMULAS, NUMBERS]);
    }
    schema
}

/// A number as a string.
const NUMBER: &str = "^(|NaN|-?inf|-?[0-9]+(\\.[0-9]*)?([eE][-+]?[0-9]+)?)$";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_read_and_no_column_stands_twice() {
        let lines = csv::Reader::from_reader(COLUMNS.as_bytes()).records().count();
        assert_eq!(DESCRIPTIONS.len(), lines);
        for (place, known) in DESCRIPTIONS.iter().enumerate() {
            let same = |other: &Description| (&other.command, &other.column) == (&known.command, &known.column);
            assert!(!DESCRIPTIONS[..place].iter().any(same), "{known:?}");
            assert!(!known.meaning.is_empty(), "{known:?}");
        }
        let mut names = described_commands();
        names.sort_unstable();
        names.dedup();
        assert_eq!(
            names.len(),
            described_commands().len(),
            "the lines of a command stand together"
        );
    }
}
