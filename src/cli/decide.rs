//! Decides the claims of a sheet: proofs, witnesses and repairs.

use super::accuse::{holds_as, may_be_misprinted, misprints};
use super::audit_table::{Row, table};
use super::progress::Progress;
use super::{Failure, note};
use crate::claim::{self, Fault, Rule, Sheet, Verdict};
use crate::evidence::{Evidence, witness_near};
use crate::prove::{self, Decision, mention_refuted, settle_second_values};
use crate::repair::{Repairs, repairs};
use crate::report::{Format, Table};
use crate::stop::Token;
use crate::tex::{Equation, Tree, any_side, is_opaque};
use rayon::prelude::*;

/// Formulas that cannot be read of which a message tells.
const MOST_NOTES: usize = 10;

/// Random points at which each claim is tried; fewer where one costs much.
const POINTS: usize = 24;

/// The table of the sheet with this text, which errors call `name`.
pub fn verdicts(text: &str, name: &str) -> Result<Table, Failure> {
    let in_sheet = |fault: Fault| Failure::Sheet {
        name: name.to_owned(),
        fault: Box::new(fault),
    };
    let symbols = claim::vocabulary().map_err(in_sheet)?;
    let sheet = Sheet::read(text, &symbols).map_err(in_sheet)?;
    let rows = decide_sheet(&sheet, name, &prove::Options::default(), false)?;
    table(&rows, &sheet, Format::Text)
}

/// Decides each claim of the sheet that errors call `name`, and says what of it cannot be read.
pub fn decide_sheet(sheet: &Sheet, name: &str, options: &prove::Options, repair: bool) -> Result<Vec<Row>, Failure> {
    let mut rows = decide_all(sheet, options, repair).map_err(|fault| Failure::Sheet {
        name: name.to_owned(),
        fault: Box::new(fault),
    })?;
    complete(sheet, &mut rows, options);
    if rows.iter().any(|row| row.expected().is_none()) {
        note(&format!("{name}: {}", summary(&rows)));
        return Ok(rows);
    }
    let unread = sheet.entries.iter().filter(|entry| entry.expect != Verdict::Unread);
    let faults: Vec<&Fault> = unread.filter_map(|entry| entry.unread.as_ref()).collect();
    for fault in faults.iter().take(MOST_NOTES) {
        note(&format!("{name}: {fault}"));
    }
    if let Some(more) = faults.len().checked_sub(MOST_NOTES).filter(|more| *more > 0) {
        note(&format!(
            "{name}: {more} more formulas cannot be read; their rows say why"
        ));
    }
    Ok(rows)
}

/// Completes rows that were decided one by one with what they say of each other.
pub fn complete(sheet: &Sheet, rows: &mut [Row], options: &prove::Options) {
    settle_second_values(rows.iter_mut().map(|row| &mut row.decision));
    clear_links_behind_suspects(sheet, rows, options);
    mention_refuted(sheet, rows.iter_mut().map(|row| &mut row.decision));
}

/// Counts the rows of a document without comments by their verdicts, in the order in which their author wants
/// to see them.
fn summary(rows: &[Row]) -> String {
    let order = ["suspect", "proved", "conditional", "given", "undecided", "unread"];
    let counts = order.into_iter().filter_map(|verdict| {
        let is_it = |row: &&Row| row.decision.verdict.to_string() == verdict;
        let count = rows.iter().filter(is_it).count();
        (count > 0).then(|| format!("{count} {verdict}"))
    });
    let counts: Vec<String> = counts.collect();
    format!("{} formulas and links of chains: {}", rows.len(), counts.join(", "))
}

/// Makes a suspect link of a chain undecided that holds once the suspect one before it is repaired.
fn clear_links_behind_suspects(sheet: &Sheet, rows: &mut [Row], options: &prove::Options) {
    for place in 1..rows.len() {
        let (before, own) = rows.split_at_mut(place);
        let (Some(before), Some(row)) = (before.last(), own.first_mut()) else {
            continue;
        };
        let are_suspect = [before.decision.verdict, row.decision.verdict] == [Verdict::Suspect; 2];
        let mended = before.repairs().first().map(|repair| repair.mended.as_slice());
        let equations = sheet.entries.get(row.position).map(|entry| entry.equations.as_slice());
        if are_suspect
            && row.position == before.position + 1
            && let (Some([(_, mended)]), Some([link])) = (mended, equations)
            && holds_as(
                sheet,
                row.position,
                &format!("{} = {}", mended.right, link.right),
                options,
            )
        {
            row.decision.verdict = Verdict::Undecided;
            row.decision.reason = format!(
                "holds once ({}) is repaired; {}",
                before.decision.label, row.decision.reason
            );
            row.repairs = None;
        }
    }
}

/// Decides each claim, looks for witnesses and, where asked, for repairs, on all cores; in the order of the sheet.
fn decide_all(sheet: &Sheet, options: &prove::Options, repair: bool) -> Result<Vec<Row>, Fault> {
    let rows = sheet.rows();
    let (token, progress) = (Token::current(), Progress::bar(rows.len(), "claims"));
    let decide = |&position: &usize| {
        let row = token.during(|| decide(sheet, position, options, repair));
        progress.step();
        row
    };
    rows.par_iter().map(decide).collect()
}

/// Returns true if a term that is not understood stands in an equation as a symbol.
fn has_opaque_symbols(equation: &Equation) -> bool {
    any_side(
        equation,
        &mut |node| matches!(node, Tree::Symbol(name, _) if is_opaque(name)),
    )
}

/// The verdict on a claim before its repairs are looked for.
#[derive(Clone)]
pub struct Judged {
    decision: Decision,
    evidence: Option<Evidence>,
    /// The decision on the formula by itself, where it may be misprinted.
    accused: Option<Decision>,
}

impl Judged {
    /// Returns true if the verdict may depend on the formulas around the claim: they say whether it is a misprint.
    pub fn is_accused(&self) -> bool {
        self.accused.is_some()
    }

    /// Returns true if numbers speak against the formula with the premises that are guessed.
    fn differs(&self) -> bool {
        self.evidence.as_ref().is_some_and(|evidence| evidence.differs)
    }

    /// Returns the verdict so far.
    pub fn verdict(&self) -> Verdict {
        self.decision.verdict
    }

    /// Returns the row with the repairs that were found; an accused formula that has some is suspect.
    pub fn row(mut self, position: usize, repairs: Option<Repairs>) -> Row {
        if let Some(own) = self.accused.filter(|_| repairs.is_some()) {
            self.decision = own;
            self.decision.suspect();
        }
        Row {
            position,
            decision: self.decision,
            evidence: self.evidence,
            repairs,
            is_known: None,
        }
    }

    /// Moves the verdict to the place of the claim at a position, which says the same elsewhere.
    pub fn moved(mut self, sheet: &Sheet, position: usize) -> Self {
        let place = Decision::of(sheet, position).place;
        self.decision.place = place;
        if let Some(own) = &mut self.accused {
            own.place = place;
        }
        self
    }
}

/// Decides the claim at a position of a sheet.
pub fn decide(sheet: &Sheet, position: usize, options: &prove::Options, repair: bool) -> Result<Row, Fault> {
    let judged = judge(sheet, position, options)?;
    let repairs = mend(sheet, position, options, &judged, repair);
    Ok(judged.row(position, repairs))
}

/// Finds the repairs of a claim: where they are asked for and it is refuted, and where it may be misprinted.
pub fn mend(
    sheet: &Sheet,
    position: usize,
    options: &prove::Options,
    judged: &Judged,
    repair: bool,
) -> Option<Repairs> {
    if judged.verdict() == Verdict::Refuted && repair {
        return Some(repairs(sheet, position, options));
    }
    if !judged.is_accused() {
        return None;
    }
    // the premises are a guess: the formula may be mended without them
    let by_itself = (judged.decision.fails || judged.differs()).then(|| sheet.resting_on_nothing(position));
    let by_itself = by_itself.flatten();
    let mut sheets = std::iter::once(sheet).chain(&by_itself);
    let find = |sheet: &Sheet| misprints(sheet, position, repairs(sheet, position, options), options);
    sheets.find_map(find)
}

/// Decides the claim at a position of a sheet without looking for repairs.
pub fn judge(sheet: &Sheet, position: usize, options: &prove::Options) -> Result<Judged, Fault> {
    let decision = prove::decide(sheet, position, options);
    let is_judged = !matches!(decision.verdict, Verdict::Unread | Verdict::Given);
    // sums and means that are symbols have any value at a point
    let is_linear = decision.verdict == Verdict::Proved && decision.rules.contains(&Rule::Words);
    let has_terms = || {
        sheet
            .entries
            .get(position)
            .is_some_and(|entry| entry.equations.iter().any(has_opaque_symbols))
    };
    let read = is_judged && sheet.unread_below(position).is_empty() && !(is_linear && has_terms());
    let at_each_index = decision.at_each_index.then(|| sheet.at_each_index(position));
    let decided = at_each_index.flatten().map(|(sheet, _)| sheet);
    let evidence = read
        .then(|| {
            let counterexample = decision.counterexample.as_ref().map(|own| &own.point);
            witness_near(
                decided.as_ref().unwrap_or(sheet),
                position,
                decision.verdict,
                POINTS,
                counterexample.unwrap_or(&decision.point),
            )
        })
        .transpose()?;
    let mut judged = Judged {
        decision,
        evidence,
        accused: None,
    };
    if let (Verdict::Undecided | Verdict::Given, Some(entry)) = (judged.verdict(), sheet.entries.get(position)) {
        // the premises are a guess: where numbers speak against the formula with them, it may fail without them
        let by_itself = judged.differs().then(|| sheet.resting_on_nothing(position)).flatten();
        let own = match (&by_itself, judged.decision.fails) {
            (Some(sheet), false) => prove::decide(sheet, position, options),
            _ => judged.decision.clone(),
        };
        judged.accused = may_be_misprinted(entry, &own).then_some(own);
    }
    Ok(judged)
}
