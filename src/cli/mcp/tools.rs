//! The tools: their schemas, their arguments, and their results as text and as data.

use crate::claim::Verdict;
use crate::cli::audit_table::{Audited, Row, table};
use crate::cli::caller::{Input, during, line};
use crate::cli::edits::{Replacement, replacements};
use crate::cli::jsonrpc::Error;
use crate::cli::{Command, Content, Exit, Failure, Options, audit, outcomes};
use crate::report::{DEFAULT_DIGITS, Format, Table};
use crate::stop::Token;
use crate::tex::nearest;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The names of the tools.
const NAMES: [&str; 5] = ["audit", "explain", "repair", "check", "orbits"];

/// Describes the tools for a client.
pub fn list() -> Vec<Value> {
    NAMES.iter().map(|name| described(name)).collect()
}

/// The arguments that name formulas.
fn formulas() -> Map<String, Value> {
    object(json!({
        "text": {
            "type": "string",
            "description": "The whole text of a document (TeX or Markdown) or of a sheet (TOML). Give `text` or \
                            `path`.",
        },
        "name": {
            "type": "string",
            "description": "The file name of `text`, which need not exist: its ending (.tex, .md, .ipynb, .toml) says \
                            what the text is, and files that it includes are looked for beside it.",
        },
        "path": {
            "type": "string",
            "description": "The path of a file, relative to the directory in which the server was started.",
        },
        "effort": {
            "type": "integer",
            "minimum": 1,
            "maximum": 1_000_000,
            "description": "Search so many times as far. Default: 1.",
        },
    }))
}

fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// Returns the arguments of a tool, and those of them that are required.
fn arguments(name: &str) -> (Map<String, Value>, &'static [&'static str]) {
    let with = |more: Value| formulas().into_iter().chain(object(more)).collect();
    match name {
        "audit" => {
            let more = json!({
                "repair": {
                    "type": "boolean",
                    "description": "Also look for repairs of refuted formulas (column `repair`). Default: false.",
                },
                "findings_only": {
                    "type": "boolean",
                    "description": "Return only the rows that need attention: unexpected, undecided or unread. \
                                    Default: false.",
                },
            });
            (with(more), &[])
        }
        "explain" => {
            let label = json!({ "label": { "type": "string", "description": "The label of a row of `audit`, as 3 or speed." } });
            (with(label), &["label"])
        }
        "repair" => {
            let label = json!({
                "label": {
                    "type": "string",
                    "description": "Repair this formula alone. Default: each that is refuted or suspect.",
                },
            });
            (with(label), &[])
        }
        "check" => {
            let directory = json!({
                "directory": {
                    "type": "string",
                    "description": "A directory with printed.csv. Default: the values of the built-in paper, which \
                                    take about a minute.",
                },
            });
            (object(directory), &[])
        }
        _ => {
            let scene = json!({
                "text": {
                    "type": "string",
                    "description": "A scene in TOML, as \"[motion]\\ng = 0.122\\nd = 0.4\\nr_b = 0.5\\nr_t = 0.5\\n\". Give `text` or `scene`.",
                },
                "scene": {
                    "type": "string",
                    "description": "The name of a built-in scene, as fig02, or the path of a file.",
                },
                "set": {
                    "type": "array",
                    "items": { "type": "string" },
                    "description": "Changes of keys, as [\"motion.d=0.3\"].",
                },
                "digits": {
                    "type": "integer", "minimum": 1, "maximum": 10_000,
                    "description": "Significant digits to compute.",
                },
            });
            (object(scene), &[])
        }
    }
}

fn described(name: &str) -> Value {
    let (title, description) = match name {
        "audit" => (
            "Audit formulas",
            "Decide for each formula of a document or sheet whether it follows from its premises. Returns a row for each: \
             label, verdict (proved, refuted, undecided, unread, given, suspect, conditional), reason, counterexample, \
             place as line:column. Call it after each change of a formula. `as_expected` is false where a verdict is not \
             the one that the document expects.",
        ),
        "explain" => (
            "Explain a verdict",
            "Print the proof of one formula step by step, or its counterexample with both sides worked out.",
        ),
        "repair" => (
            "Repair refuted formulas",
            "Find the smallest edits that make a refuted or suspect formula provable; each is proved. An edit replaces the \
             text `old` between `start` and `end` (line and column from 1, in characters; `end` is behind the last one) by `new`. \
             No file is changed: apply one repair yourself, then call `audit` again.",
        ),
        "check" => (
            "Check printed numbers",
            "Compare printed numbers with computed ones of known accuracy: those of a directory with printed.csv.",
        ),
        _ => (
            "Find periodic motions",
            "Find the periodic motions of a vibro-impact device (a ball between two walls of a shaken capsule) in a scene. \
             `complete` of a row says that a proof excludes any other 1-1 motion.",
        ),
    };
    let (properties, required) = arguments(name);
    let mut tool = json!({
        "name": name,
        "title": title,
        "description": description,
        "inputSchema": {
            "type": "object",
            "properties": properties,
            "required": required,
            "additionalProperties": false,
        },
        "annotations": {
            "title": title,
            "readOnlyHint": true,
            "destructiveHint": false,
            "idempotentHint": true,
            "openWorldHint": false,
        },
    });
    if let Some(schema) = output(name) {
        tool["outputSchema"] = schema;
    }
    tool
}

/// Returns the schema of the structured result of a tool; the explanation is text.
fn output(name: &str) -> Option<Value> {
    let string = || json!({ "type": "string" });
    let text_or_null = || json!({ "type": ["string", "null"] });
    let rows = |properties: Value, required: &[&str]| {
        let row = json!({ "type": "object", "properties": properties, "required": required });
        json!({ "type": "array", "items": row })
    };
    let mut properties = json!({
        "as_expected": { "type": "boolean" },
        "notes": { "type": "array", "items": string() },
    });
    let key = match name {
        "audit" => {
            let columns = json!({
                "label": string(), "verdict": string(), "expected": text_or_null(), "reason": string(),
                "counterexample": text_or_null(), "place": text_or_null(), "repair": text_or_null(),
            });
            properties["formulas"] = rows(columns, &["label", "verdict"]);
            properties["numbers"] = rows(json!({}), &[]);
            properties["counts"] = json!({ "type": "object", "additionalProperties": { "type": "integer" } });
            "formulas"
        }
        "repair" => {
            let place = || {
                let number = json!({ "type": "integer", "minimum": 1 });
                json!({ "type": "object", "properties": { "line": number, "column": number }, "required": ["line", "column"] })
            };
            let edit =
                json!({ "file": text_or_null(), "start": place(), "end": place(), "old": string(), "new": string() });
            let edits = rows(edit, &["start", "end", "old", "new"]);
            let repair =
                json!({ "what": string(), "formulas": { "type": "array", "items": string() }, "edits": edits });
            let columns = json!({
                "label": string(), "verdict": string(), "place": text_or_null(), "formula": string(),
                "reason": string(), "repairs": rows(repair, &["what", "formulas", "edits"]),
            });
            properties["formulas"] = rows(columns, &["label", "verdict", "repairs"]);
            "formulas"
        }
        "check" => {
            properties["values"] = rows(json!({ "id": string(), "verdict": string() }), &["id", "verdict"]);
            "values"
        }
        "orbits" => {
            properties["orbits"] = rows(json!({ "word": string(), "kind": string() }), &["word", "kind"]);
            "orbits"
        }
        _ => return None,
    };
    Some(json!({
        "type": "object",
        "properties": properties,
        "required": [key, "as_expected", "notes"],
    }))
}

/// A call of a tool, with arguments of the right types.
#[derive(Debug)]
pub struct Call {
    tool: &'static str,
    /// The command line, and what stands for its standard input.
    line: Vec<String>,
    input: Input,
    label: Option<String>,
    findings_only: bool,
}

/// The arguments of a call, by their names.
struct Given(Map<String, Value>);

impl Given {
    fn text(&self, name: &str) -> Result<Option<&str>, Error> {
        match self.0.get(name) {
            None | Some(Value::Null) => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(_) => Err(Error::params(format!("`{name}` should be a string"))),
        }
    }

    fn flag(&self, name: &str) -> Result<bool, Error> {
        match self.0.get(name) {
            None | Some(Value::Null) => Ok(false),
            Some(Value::Bool(flag)) => Ok(*flag),
            Some(_) => Err(Error::params(format!("`{name}` should be true or false"))),
        }
    }

    fn count(&self, name: &str) -> Result<Option<u64>, Error> {
        match self.0.get(name) {
            None | Some(Value::Null) => Ok(None),
            Some(value) => match value.as_u64().filter(|count| *count > 0) {
                Some(count) => Ok(Some(count)),
                None => Err(Error::params(format!("`{name}` should be a whole number from 1 on"))),
            },
        }
    }

    fn texts(&self, name: &str) -> Result<Vec<&str>, Error> {
        let problem = || Error::params(format!("`{name}` should be a list of strings"));
        match self.0.get(name) {
            None | Some(Value::Null) => Ok(Vec::new()),
            Some(Value::Array(all)) => all.iter().map(|one| one.as_str().ok_or_else(problem)).collect(),
            Some(_) => Err(problem()),
        }
    }
}

/// A path as an argument: `-` is a file of this name, for standard input belongs to the protocol.
fn path(path: &str) -> String {
    if path == "-" { "./-".to_owned() } else { path.to_owned() }
}

/// Returns the last words of a command line that name the formulas or the scene, and the text that stands for
/// standard input.
fn source(
    text: Option<&str>,
    name: Option<&str>,
    file: Option<&str>,
    key: &str,
) -> Result<(Vec<String>, Input), Error> {
    let input = |name: &str, text: &str| Input {
        name: name.to_owned(),
        text: text.to_owned(),
    };
    let dashes = "--".to_owned();
    match (text, file) {
        (Some(_), Some(_)) => Err(Error::params(format!("give `text` or `{key}`, not both"))),
        (None, None) => Err(Error::params(format!("give `text` or `{key}`"))),
        (None, Some(file)) => Ok((vec![dashes, path(file)], input("", ""))),
        (Some(text), None) => {
            let named = name.map(|name| format!("--stdin-name={name}"));
            let words = named.into_iter().chain([dashes, "-".to_owned()]);
            Ok((words.collect(), input(name.unwrap_or("text"), text)))
        }
    }
}

impl Call {
    /// Reads the arguments of a call.
    ///
    /// # Errors
    /// An unknown tool, and arguments that it does not take.
    pub fn read(name: &str, given: Value) -> Result<Self, Error> {
        let Some(tool) = NAMES.into_iter().find(|known| *known == name) else {
            let problem = format!("there is no tool `{name}`; there are: {}", NAMES.join(", "));
            return Err(Error::params(problem));
        };
        let given = match given {
            Value::Null => Given(Map::new()),
            Value::Object(given) => Given(given),
            _ => return Err(Error::params("`arguments` should be an object")),
        };
        let (known, required) = arguments(tool);
        let known = || known.keys().map(String::as_str);
        if let Some(unknown) = given.0.keys().find(|key| known().all(|name| name != *key)) {
            let meant = nearest(unknown, known()).map(|near| format!("; did you mean `{near}`?"));
            let there = known().collect::<Vec<_>>().join(", ");
            let problem = format!(
                "`{tool}` has no argument `{unknown}`{} (there are: {there})",
                meant.unwrap_or_default()
            );
            return Err(Error::params(problem));
        }
        if let Some(missing) = required.iter().find(|name| !given.0.contains_key(**name)) {
            return Err(Error::params(format!("`{missing}` is missing")));
        }
        let label = if known().any(|key| key == "label") {
            given.text("label")?
        } else {
            None
        };
        let mut words: Vec<String> = ["vibro-audit", command(tool), "--format=json"]
            .map(str::to_owned)
            .to_vec();
        let (last, input) = match tool {
            "check" => {
                let directory = given.text("directory")?;
                let last = directory.map(|directory| vec!["--".to_owned(), directory.to_owned()]);
                let (name, text) = (String::new(), String::new());
                (last.unwrap_or_default(), Input { name, text })
            }
            "orbits" => {
                words.extend(given.texts("set")?.into_iter().map(|set| format!("--set={set}")));
                words.extend(given.count("digits")?.map(|digits| format!("--digits={digits}")));
                source(given.text("text")?, None, given.text("scene")?, "scene")?
            }
            _ => {
                words.extend(given.count("effort")?.map(|effort| format!("--effort={effort}")));
                let is_asked = tool == "repair" || (tool == "audit" && given.flag("repair")?);
                words.extend(is_asked.then(|| "--repair".to_owned()));
                if let Some(label) = label.filter(|_| tool == "explain") {
                    words.push(format!("--explain={label}"));
                }
                source(given.text("text")?, given.text("name")?, given.text("path")?, "path")?
            }
        };
        words.extend(last);
        Ok(Self {
            tool,
            line: words,
            input,
            label: label.map(str::to_owned),
            findings_only: tool == "audit" && given.flag("findings_only")?,
        })
    }

    /// Returns true if the call has no rows to count: its progress is in steps of a computation.
    pub fn counts_steps(&self) -> bool {
        matches!(self.tool, "explain" | "orbits")
    }

    /// Computes the result of the call. One that cannot be used says what to do.
    pub fn run(&self) -> Value {
        let (found, notes) = during(Some(self.input.clone()), || self.found());
        let (mut text, mut data, exit) = match found {
            Ok(Found { text, data, exit }) => (text, data, exit),
            Err(failure) => return error(&failure.to_string(), &notes),
        };
        for note in &notes {
            let _ = write!(text, "\nnote: {note}");
        }
        let mut result = json!({ "content": [{ "type": "text", "text": text.trim_end() }], "isError": false });
        if let Some(data) = &mut data {
            data["as_expected"] = (exit == Exit::AsExpected).into();
            data["notes"] = notes.into();
            result["structuredContent"] = data.take();
        }
        result
    }

    fn found(&self) -> Result<Found, Failure> {
        let line = line(self.line.iter().map(Into::into))?;
        let options = &line.options;
        match &line.command {
            Some(Command::Audit(arguments)) if self.tool != "explain" => {
                let (audited, exit) = audit::decided(arguments, options)?;
                match self.tool {
                    "audit" => self.audited(audited, exit, options),
                    _ => self.repaired(&audited, exit),
                }
            }
            _ => {
                let answer = line.answer()?;
                match answer.content {
                    Content::Text(text) => Ok(Found {
                        text,
                        data: None,
                        exit: answer.exit,
                    }),
                    Content::Table(table) => tabled("values", table, answer.exit),
                    Content::Rows(rows) => {
                        let (mut table, token) = (Table::new(rows.columns.clone()), Token::current());
                        rows.each(|row| {
                            table.push(row)?;
                            Ok(!token.is_stopped())
                        })?;
                        tabled("orbits", table, answer.exit)
                    }
                    _ => Err(Failure::Usage(format!("`{}` has no table", self.tool))),
                }
            }
        }
    }

    fn audited(&self, mut audited: Audited, exit: Exit, options: &Options) -> Result<Found, Failure> {
        let mut counts: BTreeMap<String, u64> = BTreeMap::new();
        for row in &audited.rows {
            *counts.entry(row.decision.verdict.to_string()).or_default() += 1;
        }
        let said: Vec<String> = counts
            .iter()
            .map(|(verdict, count)| format!("{count} {verdict}"))
            .collect();
        let end = if exit == Exit::AsExpected {
            "all as expected"
        } else {
            "not all as expected"
        };
        let claims = if audited.rows.len() == 1 { "claim" } else { "claims" };
        let mut text = format!("{} {claims}: {}; {end}\n", audited.rows.len(), said.join(", "));
        if self.findings_only {
            audited.rows.retain(needs_attention);
        }
        if !audited.rows.is_empty() {
            let rows = table(&audited.rows, &audited.sheet, Format::Text)?;
            let _ = write!(text, "\n{}", written(&rows));
        }
        let mut data = json!({ "counts": counts });
        data["formulas"] = of_table(&table(&audited.rows, &audited.sheet, options.format)?);
        if !audited.numbers.is_empty() {
            let numbers = outcomes::table(&audited.numbers, false)?;
            let _ = write!(text, "\n{}", written(&numbers));
            data["numbers"] = of_table(&numbers);
        }
        let data = Some(data);
        Ok(Found { text, data, exit })
    }

    fn repaired(&self, audited: &Audited, exit: Exit) -> Result<Found, Failure> {
        let is_wrong = |row: &&Row| match row.decision.verdict {
            Verdict::Refuted => !row.is_expected(),
            verdict => verdict == Verdict::Suspect,
        };
        let is_asked = |row: &&Row| match &self.label {
            Some(label) => row.decision.label == *label || format!("({})", row.decision.label) == *label,
            None => is_wrong(row),
        };
        let rows: Vec<&Row> = audited.rows.iter().filter(is_asked).collect();
        if let (Some(label), []) = (&self.label, rows.as_slice()) {
            let known: Vec<&str> = audited.rows.iter().map(|row| row.decision.label.as_str()).collect();
            return Err(Failure::Usage(format!(
                "no claim `{label}` (there are: {})",
                known.join(", ")
            )));
        }
        let mut text = match rows.len() {
            0 => "No formula is refuted or suspect: there is nothing to repair.\n".to_owned(),
            _ => String::new(),
        };
        let mut formulas = Vec::new();
        for row in rows {
            let decision = &row.decision;
            let place = decision.place.map(|(line, column)| format!("{line}:{column}"));
            let at = place.as_ref().map_or(String::new(), |place| format!(" at {place}"));
            let _ = writeln!(text, "({}) {}{at}: {}", decision.label, decision.verdict, row.reason());
            let mut repairs = Vec::new();
            for repair in row.repairs() {
                let _ = writeln!(text, "  repair: {}: {repair}", repair.words());
                let edits = replacements(&audited.sheet, row.position, repair, &audited.text).unwrap_or_default();
                if edits.is_empty() {
                    text.push_str("    no exact edit: write the formula anew\n");
                }
                for edit in &edits {
                    let [from, to] = [edit.start, edit.end].map(|(line, column)| format!("{line}:{column}"));
                    let _ = writeln!(text, "    from {from} to {to} replace `{}` by `{}`", edit.old, edit.new);
                }
                let file = decision.file.as_deref();
                let edits: Vec<Value> = edits.iter().map(|edit| of_edit(edit, file)).collect();
                repairs.push(json!({ "what": repair.words(), "formulas": repair.formulas, "edits": edits }));
            }
            let entry = audited.sheet.entries.get(row.position);
            formulas.push(json!({
                "label": decision.label,
                "verdict": decision.verdict.to_string(),
                "place": place,
                "formula": entry.map_or("", |entry| entry.tex.tex.as_str()),
                "reason": row.reason(),
                "repairs": repairs,
            }));
        }
        let data = Some(json!({ "formulas": formulas }));
        Ok(Found { text, data, exit })
    }
}

/// The command that a tool runs.
fn command(tool: &'static str) -> &'static str {
    match tool {
        "explain" | "repair" => "audit",
        tool => tool,
    }
}

/// The result of a call.
struct Found {
    text: String,
    data: Option<Value>,
    exit: Exit,
}

/// Returns true if an author has something to do about a row.
fn needs_attention(row: &Row) -> bool {
    let is_open = matches!(
        row.decision.verdict,
        Verdict::Undecided | Verdict::Unread | Verdict::Conditional
    );
    let is_against = row.evidence.as_ref().is_some_and(|evidence| evidence.against.is_some());
    !row.is_expected() || is_open || is_against
}

fn tabled(key: &str, table: Table, exit: Exit) -> Result<Found, Failure> {
    let text = written(&table);
    let data = Some(json!({ key: of_table(&table) }));
    Ok(Found { text, data, exit })
}

fn of_table(table: &Table) -> Value {
    serde_json::to_value(table).unwrap_or_default()
}

fn of_edit(edit: &Replacement, file: Option<&str>) -> Value {
    let place = |(line, column): (usize, usize)| json!({ "line": line, "column": column });
    json!({
        "file": file,
        "start": place(edit.start),
        "end": place(edit.end),
        "old": edit.old,
        "new": edit.new,
    })
}

/// A table as text.
fn written(table: &Table) -> String {
    let mut bytes = Vec::new();
    // memory takes all that is written
    let _ = table.write(&mut bytes, Format::Text, DEFAULT_DIGITS);
    String::from_utf8_lossy(&bytes).into_owned()
}

fn error(problem: &str, notes: &[String]) -> Value {
    let notes: String = notes.iter().map(|note| format!("\nnote: {note}")).collect();
    json!({ "content": [{ "type": "text", "text": format!("{problem}{notes}") }], "isError": true })
}

/// The result of a call that ended in a panic.
pub fn fault() -> Value {
    error(
        "the computation ended in a panic: this is a fault of vibro-audit, please report it with the call",
        &[],
    )
}
