//! What was decided of a sheet, as the user wants to see it: a table, a page, findings.

use super::edits::replacements;
use super::source::Source as Input;
use super::{Answer, Content, Exit, Failure, Options, outcomes};
use crate::claim::{Sheet, Standing, Verdict};
use crate::evidence::Evidence;
use crate::prove::rocq::{self, Unwritten};
use crate::prove::{self, Counterexample, Decision, Explanation};
use crate::reference::Outcome;
use crate::repair::{Repair, Repairs};
use crate::report::{
    Baseline, BaselineError, Cell, FORMULAS, Finding, Fix, Format, Given, Kind, NUMBERS, Page, Part, Printed, Table,
    fingerprint, sarif,
};
use crate::stop::Token;
use rayon::prelude::*;

/// The columns that scripts rely on.
const COLUMNS: [&str; 12] = [
    "label",
    "verdict",
    "expected",
    "digits",
    "counterexample",
    "reason",
    "provided",
    "place",
    "repair",
    FINGERPRINT,
    "reductions",
    "reading",
];

/// The column that a person does not read.
const FINGERPRINT: &str = "fingerprint";

/// What is found of one claim.
pub struct Row {
    pub position: usize,
    pub decision: Decision,
    /// Nothing where there is no claim to be tried.
    pub evidence: Option<Evidence>,
    /// What would make a refuted claim true, where that is asked for.
    pub repairs: Option<Repairs>,
    /// Whether an earlier run knows it; nothing where none is asked.
    pub is_known: Option<bool>,
}

impl Row {
    /// Whether the verdict is what the sheet expects, or known.
    pub fn is_expected(&self) -> bool {
        self.decision.is_expected() || self.is_known == Some(true)
    }

    /// Returns true if something decides the claim that a proof can show.
    pub fn is_decided(&self) -> bool {
        match self.decision.verdict {
            Verdict::Proved | Verdict::Refuted | Verdict::Conditional => true,
            Verdict::Undecided | Verdict::Unread | Verdict::Given | Verdict::Suspect => false,
        }
    }

    /// The verdict that is expected; none of a document without comments.
    pub fn expected(&self) -> Option<Verdict> {
        match self.is_known {
            Some(true) => Some(self.decision.verdict),
            _ => (self.decision.standing == Standing::Said).then_some(self.decision.expected),
        }
    }

    /// The repairs, the smallest first.
    pub fn repairs(&self) -> &[Repair] {
        self.repairs.as_ref().map_or(&[], |repairs| &repairs.found)
    }

    fn fingerprint(&self, sheet: &Sheet) -> String {
        let entry = sheet.entries.get(self.position);
        let formula = entry.map_or("", |entry| entry.tex.tex.as_str());
        // a number changes with what stands before it, a name does not
        let name = entry.and_then(|entry| entry.names.first());
        fingerprint(
            name.unwrap_or(&self.decision.label),
            &self.decision.verdict.to_string(),
            formula,
        )
    }

    /// Returns the reason of the verdict, with what repairs and evidence say.
    pub fn reason(&self) -> String {
        let mut reason = self.decision.reason.clone();
        if let Some(repair) = self.repairs().first() {
            reason = format!("{reason}; {}", repair.words());
        }
        if let Some(none) = self.repairs.as_ref().and_then(Repairs::none) {
            reason = format!("{reason}; {none}");
        }
        if let Some(evidence) = &self.evidence {
            if let Some(against) = &evidence.against {
                reason = format!("EVIDENCE AGAINST THE VERDICT: {against}; {reason}");
            }
            // How the maps flown agree is for `--explain`: a table is read for what is amiss.
            let flown = evidence.flown.as_ref().map(ToString::to_string);
            for note in evidence.notes.iter().filter(|note| Some(*note) != flown.as_ref()) {
                reason = format!("{reason}; {note}");
            }
        }
        if self.is_known == Some(true) && !self.decision.is_expected() {
            reason = format!(
                "{reason}; known from the baseline, {} is expected",
                self.decision.expected
            );
        }
        reason
    }
}

/// 2 where something cannot be read that was expected to be, 1 where a verdict is not as expected or evidence speaks
/// against it.
pub fn exit(rows: &[Row]) -> Exit {
    let unread = |row: &Row| row.decision.verdict == Verdict::Unread && !row.is_expected();
    let as_expected = |row: &Row| {
        let speaks_for = |evidence: &Evidence| evidence.against.is_none();
        row.is_expected() && row.evidence.as_ref().is_none_or(speaks_for)
    };
    if rows.iter().any(unread) {
        Exit::Unusable
    } else {
        Exit::from_verdict(rows.iter().all(as_expected))
    }
}

/// Marks what an earlier run knows, and tells the labels of what it knows and is no more.
///
/// # Errors
/// A baseline of another document, where something is not as expected.
pub fn compare<'a>(
    all: impl IntoIterator<Item = &'a mut Audited>,
    baseline: &Baseline,
) -> Result<Vec<String>, BaselineError> {
    let (mut found, mut is_expected) = (Vec::new(), true);
    for audited in all {
        for row in &mut audited.rows {
            let print = row.fingerprint(&audited.sheet);
            row.is_known = Some(baseline.knows(&print));
            is_expected &= row.is_expected();
            found.push((row.decision.label.clone(), print));
        }
    }
    // where all is as expected nothing had to be known
    if !is_expected {
        baseline.refuse_other(&found)?;
    }
    Ok(baseline.gone(&found))
}

/// The rows as a table.
///
/// # Errors
/// None that is the sheet's.
pub fn table(rows: &[Row], sheet: &Sheet, format: Format) -> Result<Table, Failure> {
    let is_for_scripts = !matches!(format, Format::Text | Format::Markdown);
    let is_shown = |column: &str| is_for_scripts || column != FINGERPRINT;
    let mut table = Table::new(COLUMNS.into_iter().filter(|column| is_shown(column)));
    // a reader looks for what is suspect, a script for the order of the document
    let mut shown: Vec<&Row> = rows.iter().collect();
    if !is_for_scripts {
        shown.sort_by_key(|row| row.decision.verdict != Verdict::Suspect);
    }
    for row in shown {
        let (decision, evidence) = (&row.decision, &row.evidence);
        let digits = evidence.as_ref().and_then(|evidence| evidence.digits);
        let file = decision.file.as_ref().map_or(String::new(), |file| format!("{file}:"));
        let place = decision.place.map(|(line, column)| format!("{file}{line}:{column}"));
        let cells = [
            Cell::from(decision.label.clone()),
            Cell::from(decision.verdict.to_string()),
            Cell::from(row.expected().map(|expected| expected.to_string())),
            Cell::from(digits.map(|digits| (digits * 10.0).round().max(0.0) / 10.0 + 0.0)),
            decision.counterexample.as_ref().map_or(Cell::Empty, values),
            Cell::from(row.reason()),
            Cell::from((!decision.provided.is_empty()).then(|| decision.provided.join("; "))),
            Cell::from(place),
            Cell::from((!row.repairs().is_empty()).then(|| repairs(row, sheet, is_for_scripts))),
            Cell::from(row.fingerprint(sheet)),
            Cell::from(Some(decision.reductions()).filter(|rules| !rules.is_empty())),
            Cell::from((!decision.readings.is_empty()).then(|| decision.readings.join("; "))),
        ];
        let cells = COLUMNS.into_iter().zip(cells).filter(|(column, _)| is_shown(column));
        table.push(cells.map(|(_, cell)| cell).collect::<Vec<_>>())?;
    }
    Ok(table)
}

/// A counterexample as the column has it, and its values.
fn values(counterexample: &Counterexample) -> Cell {
    let sides = [("left", &counterexample.left), ("right", &counterexample.right)];
    let sides = sides.map(|(name, value)| (name.to_owned(), value.clone()));
    let values = counterexample.point.iter().cloned().chain(sides);
    Cell::Values(counterexample.to_string(), values.collect())
}

/// Repairs as the column has them: for people what changes, and the whole of the first.
fn repairs(row: &Row, sheet: &Sheet, is_for_scripts: bool) -> String {
    let claim = sheet.entries.get(row.position).filter(|_| !is_for_scripts);
    let shown = row
        .repairs()
        .iter()
        .enumerate()
        .map(|(place, repair)| match (claim, place) {
            (None, _) => repair.to_string(),
            (Some(claim), 0) => format!("{}: {repair}", repair.changes(claim)),
            (Some(claim), _) => repair.changes(claim),
        });
    shown.collect::<Vec<_>>().join(" ;; ")
}

/// The proof or counterexample and the evidence.
pub fn explained(sheet: &Sheet, row: &Row, options: &prove::Options) -> Explanation {
    let mut text = prove::explain(sheet, row.position, &row.decision, options);
    if let Some(fault) = sheet.entries.get(row.position).and_then(|entry| entry.unread.as_ref()) {
        text.say(&fault.to_string());
    }
    if let Some(evidence) = &row.evidence {
        text.say(&in_words(evidence));
    }
    text
}

/// How `digits` is scaled.
const DIGITS: &str = "digits: -log10 of |left - right| as a part of the larger side, where a side is as large as its terms \
    together, each without its sign: 16 is equal in f64, 0 is no figure in common";

/// The evidence in words.
fn in_words(evidence: &Evidence) -> String {
    let mut lines = vec!["\nevidence, which shares no code with the above".to_string()];
    match (evidence.digits, evidence.median) {
        // no figure in common is 0, not -0
        (Some(digits), Some(median)) => lines.push(format!(
            "left and right agree to {:.1} digits at the worst of {} random points of the premises in f64, to {:.1} at half of them",
            digits.max(0.0) + 0.0,
            evidence.points,
            median.max(0.0) + 0.0
        )),
        _ if evidence.points > 0 => lines.push(format!("the inequality was tried at {} random points", evidence.points)),
        _ => lines.push("no point".to_string()),
    }
    lines.extend(evidence.digits.map(|_| DIGITS.to_owned()));
    let worst: Vec<String> = evidence.worst.split("; ").map(prove::formula).collect();
    lines.extend((!evidence.worst.is_empty()).then(|| format!("worst point: {}", worst.join("; "))));
    lines.extend(evidence.notes.iter().cloned());
    lines.extend(
        evidence
            .against
            .as_ref()
            .map(|against| format!("AGAINST THE VERDICT: {against}")),
    );
    lines.join("\n  ")
}

/// What of the input cannot be used: a file, a comment of a document, or the number that it asks for.
#[derive(Clone, Debug)]
pub struct Unusable {
    pub file: Option<String>,
    pub place: Option<(usize, usize)>,
    pub message: String,
}

impl From<&Failure> for Unusable {
    fn from(failure: &Failure) -> Self {
        let (file, line, column) = failure.place();
        Self {
            file: file.map(str::to_owned),
            place: line.zip(column),
            message: failure.to_string(),
        }
    }
}

impl Unusable {
    fn finding(&self) -> Finding {
        let file = self.file.clone().unwrap_or_default();
        Finding {
            kind: Kind::Input,
            label: "input".to_owned(),
            verdict: UNUSABLE.to_owned(),
            is_expected: false,
            is_known: None,
            message: self.message.clone(),
            start: self.place,
            end: None,
            formula: String::new(),
            fingerprint: fingerprint(&file, UNUSABLE, &self.message),
            fixes: Vec::new(),
            file: self.file.clone(),
        }
    }

    /// What cannot be used, as rows of a test report whose first column is `first`.
    pub fn rows(all: &[Self], first: &str) -> Result<Table, Failure> {
        let mut table = Table::new([first, "verdict", "expected", "reason", "place", "file"]);
        for own in all {
            let place = own.place.map(|(line, column)| format!("{line}:{column}"));
            table.push([
                Cell::from("input"),
                Cell::from(UNUSABLE),
                Cell::from("usable"),
                Cell::from(own.message.clone()),
                Cell::from(place),
                Cell::from(own.file.clone()),
            ])?;
        }
        Ok(table)
    }
}

/// The verdict on what cannot be used.
const UNUSABLE: &str = "unusable";

/// All that was found of a sheet, and of the numbers of a document.
pub struct Audited {
    pub sheet: Sheet,
    pub name: String,
    /// The sheet or document; nothing of the built-in one.
    pub source: Option<Input>,
    /// The text of it.
    pub text: String,
    pub rows: Vec<Row>,
    pub numbers: Vec<Outcome>,
}

/// The answer in the format that the user chose; where several files are named, each row says which it is of.
///
/// # Errors
/// None that is the sheet's.
pub fn answer(
    all: &[Audited],
    unusable: &[Unusable],
    is_several: bool,
    exit: Exit,
    how: &prove::Options,
    options: &Options,
) -> Result<Answer, Failure> {
    let content = match (options.format, all) {
        (Format::Html, [audited]) => Content::Page(audited.page(how)?),
        (Format::Sarif, _) => {
            let found = all.iter().flat_map(Audited::findings);
            let findings: Vec<Finding> = found.chain(unusable.iter().map(Unusable::finding)).collect();
            Content::Text(sarif(&findings))
        }
        (format, _) => {
            let (mut verdicts, mut numbers) = (Vec::new(), Vec::new());
            for audited in all {
                let file = Cell::from(audited.name.as_str());
                let named = |table: Table| {
                    // a test report is read far from the command
                    if is_several || (format == Format::Junit && audited.source.is_some()) {
                        table.with_column("file", &file)
                    } else {
                        table
                    }
                };
                verdicts.push(named(table(&audited.rows, &audited.sheet, format)?));
                if !audited.numbers.is_empty() {
                    let brief = format == Format::Text;
                    numbers.push(named(outcomes::table(&audited.numbers, brief)?));
                }
            }
            if format == Format::Junit && !unusable.is_empty() {
                verdicts.push(Unusable::rows(unusable, "label")?);
            }
            let joined = |tables: &[Table]| Table::joined(&tables.iter().collect::<Vec<_>>());
            match numbers.is_empty() {
                true => Content::Table(joined(&verdicts)),
                false => Content::Tables(vec![(FORMULAS, joined(&verdicts)), (NUMBERS, joined(&numbers))]),
            }
        }
    };
    Ok(Answer { content, exit })
}

impl Audited {
    fn page(&self, how: &prove::Options) -> Result<Page, Failure> {
        let token = Token::current();
        let printed = |row: &Row| {
            let explained = token.during(|| explained(&self.sheet, row, how));
            let decided = match row.is_decided() {
                true => token.during(|| prove::decided(&self.sheet, row.position, how)),
                false => Vec::new(),
            };
            let files = match decided.is_empty() {
                true => Vec::new(),
                false => rocq::files(&self.sheet, row.position, &decided),
            };
            let theorems = files.into_iter().map(|file| {
                let theorem = rocq::theorem(&file?).map(str::to_owned);
                theorem.ok_or(Unwritten::Not("a theorem"))
            });
            let (decision, repairs) = (&row.decision, row.repairs());
            Printed::new(
                &self.sheet,
                row.position,
                decision,
                repairs,
                &explained,
                theorems.collect(),
            )
        };
        let printed: Vec<Printed> = self.rows.par_iter().map(printed).collect();
        let verdicts = table(&self.rows, &self.sheet, Format::Html)?;
        let mut parts = vec![Part::Formulas(verdicts, printed, Given::all(&self.sheet))];
        if !self.numbers.is_empty() {
            let said = "Numbers that the document prints, against what is computed.".to_owned();
            parts.push(Part::Table(
                "Numbers".to_owned(),
                said,
                outcomes::table(&self.numbers, false)?,
            ));
        }
        let title = self.sheet.title.clone().unwrap_or_else(|| self.name.clone());
        Ok(Page {
            title: format!("Audit of {title}"),
            notes: Vec::new(),
            parts,
        })
    }

    fn findings(&self) -> Vec<Finding> {
        let formulas = self.rows.iter().map(|row| self.finding(row));
        formulas
            .chain(self.numbers.iter().map(|outcome| self.number(outcome)))
            .collect()
    }

    /// The path of a file that the document includes, or of the document.
    fn path(&self, included: Option<&str>) -> Option<String> {
        let Some(Input::File(file)) = &self.source else {
            return None;
        };
        let path = match included {
            Some(name) => file.with_file_name(name),
            None => file.clone(),
        };
        Some(path.display().to_string())
    }

    fn finding(&self, row: &Row) -> Finding {
        let decision = &row.decision;
        let source = self.sheet.entries.get(row.position).map(|entry| &entry.tex);
        let end = source.filter(|source| decision.place == Some(source.place()));
        let is_against = row.evidence.as_ref().is_some_and(|evidence| evidence.against.is_some());
        Finding {
            kind: Kind::Formula,
            label: decision.label.clone(),
            verdict: decision.verdict.to_string(),
            is_expected: row.is_expected() && !is_against,
            is_known: row.is_known,
            message: std::iter::once(row.reason())
                .chain(
                    decision
                        .counterexample
                        .iter()
                        .map(|point| format!("counterexample: {point}")),
                )
                .chain((!decision.readings.is_empty()).then(|| format!("read as: {}", decision.readings.join("; "))))
                .collect::<Vec<_>>()
                .join("; "),
            file: self.path(decision.file.as_deref()),
            start: decision.place,
            end: end.and_then(|source| source.place_of(source.tex.len())),
            formula: source.map(|source| source.tex.clone()).unwrap_or_default(),
            fingerprint: row.fingerprint(&self.sheet),
            fixes: row
                .repairs()
                .iter()
                .filter_map(|repair| self.fix(row, repair))
                .collect(),
        }
    }

    /// Returns a repair as edits of the source.
    fn fix(&self, row: &Row, repair: &Repair) -> Option<Fix> {
        let replacements = replacements(&self.sheet, row.position, repair, &self.text)?.into_iter();
        Some(Fix {
            words: repair.words(),
            replacements: replacements.map(|own| ([own.start, own.end], own.new)).collect(),
        })
    }

    fn number(&self, outcome: &Outcome) -> Finding {
        let mut place = outcome.place.rsplitn(3, ':');
        let (column, line) = (place.next(), place.next());
        let start = line
            .and_then(|line| line.parse().ok())
            .zip(column.and_then(|column| column.parse().ok()));
        let message = match outcome.computed.as_str() {
            "" => outcome.reason.clone(),
            computed => format!(
                "{} is printed, {computed} is computed; {}",
                outcome.printed, outcome.reason
            ),
        };
        let verdict = outcome.verdict.name().to_owned();
        Finding {
            kind: Kind::Number,
            label: outcome.id.clone(),
            is_expected: outcome.is_expected(),
            is_known: None,
            message,
            file: self.path(place.next()),
            start,
            end: None,
            formula: outcome.printed.clone(),
            fingerprint: fingerprint(&outcome.id, &verdict, &outcome.printed),
            fixes: Vec::new(),
            verdict,
        }
    }
}
