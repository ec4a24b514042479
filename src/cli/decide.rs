//! Decides the claims of a sheet: proofs, witnesses and repairs.

use super::progress::Progress;
use super::verdicts::{Row, table};
use super::{Failure, note};
use crate::claim::{self, Entry, Fault, Sheet, Standing, Verdict};
use crate::evidence::witness_near;
use crate::prove::{self, mention_refuted, settle_second_values};
use crate::repair::{Edit, Repair, repairs};
use crate::report::{Format, Table};
use crate::stop::Token;
use crate::tex::{Equation, Name, Operation, Relation, Tree, any, any_side, is_opaque, names_in};
use rayon::prelude::*;
use std::collections::BTreeSet;

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
    settle_second_values(rows.iter_mut().map(|row| &mut row.decision));
    clear_links_behind_suspects(sheet, &mut rows, options);
    mention_refuted(sheet, rows.iter_mut().map(|row| &mut row.decision));
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

/// Counts the rows of a document without comments by their verdicts, in the order in which their author wants to see them.
fn summary(rows: &[Row]) -> String {
    let order = ["suspect", "proved", "given", "undecided", "unread"];
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
            && let Some(again) = sheet.reprinted(row.position, &format!("{} = {}", mended.right, link.right), &[])
            && prove::decide(&again, row.position, options).verdict == Verdict::Proved
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

/// The largest edit that is a slip of the pen: one sign, name or digit.
const SLIP: u32 = 11;

/// The largest repair that shows a misprint in a formula with the same letters on both sides: a term or a factor that was dropped.
const LARGEST: u32 = 22;

/// Returns the letters of a side.
fn letters(side: &Tree) -> BTreeSet<Name> {
    let mut names = BTreeSet::new();
    names_in(side, &mut names);
    names
}

/// Returns true if both sides of each equation have the same letters, as most links of chains have.
fn have_one_set_of_letters<'e>(mut equations: impl Iterator<Item = &'e Equation>) -> bool {
    equations.all(|equation| letters(&equation.left) == letters(&equation.right))
}

/// Returns true if the equation of a claim with other TeX is proved from nothing.
fn is_identity(sheet: &Sheet, position: usize, repair: &Repair, options: &prove::Options) -> bool {
    let [(_, mended)] = repair.mended.as_slice() else {
        return false;
    };
    let alone = sheet.reprinted(position, &format!("{} = {}", mended.left, mended.right), &[]);
    alone.is_some_and(|mut alone| {
        if let Some(entry) = alone.entries.get_mut(position) {
            entry.follows_from.clear();
        }
        prove::decide(&alone, position, options).verdict == Verdict::Proved
    })
}

/// Returns true if a repair shows a misprint. Both sides of what it makes have the same letters, or it is an identity: else a
/// premise is missing; and nothing that the text says of its letters makes it hold. What puts in the difference of the sides mends
/// every formula, a number that becomes 0 takes a term away that a condition may have taken away, nobody forgets the brackets of a
/// whole side with its power, and signs of letters go without saying.
fn shows_misprint(sheet: &Sheet, position: usize, repair: &Repair, options: &prove::Options) -> bool {
    let Some(entry) = sheet.entries.get(position) else {
        return false;
    };
    let is_of_one_set = have_one_set_of_letters(entry.equations.iter());
    let is_of_names = repair
        .edits
        .iter()
        .all(|edit| matches!(edit.tree, Tree::Symbol(..) | Tree::Call(..)));
    let is_plain = (is_of_one_set || is_of_names) && !repair.edits.iter().any(|edit| edit.adds);
    let largest = if is_plain { LARGEST } else { SLIP };
    let is_power_of_side =
        |edit: &Edit| edit.path.len() == 1 && matches!(&edit.tree, Tree::Power(of, ..) if matches!(**of, Tree::Sum(_)));
    let becomes_zero = |edit: &Edit| matches!(&edit.tree, Tree::Number(number) if number.0.is_zero());
    let has_bars = |edit: &Edit| {
        any(
            &edit.tree,
            &mut |node| matches!(node, Tree::Call(name, ..) if name.base == r"\abs"),
        )
    };
    let is_idle = |edit: &Edit| becomes_zero(edit) || is_power_of_side(edit) || has_bars(edit);
    if repair.size > largest || repair.edits.iter().any(is_idle) {
        return false;
    }
    let mended = repair.mended.iter().map(|(_, equation)| equation);
    let is_whole = (entry.standing == Standing::Link && have_one_set_of_letters(mended))
        || is_identity(sheet, position, repair, options);
    is_whole
        && sheet
            .with_more_said(position)
            .all(|sheet| prove::decide(&sheet, position, options).fails)
}

/// Returns true for a formula that may be right although it fails: one with rounded numbers, an inequality, where letters may be
/// bounded, one with a constant that takes in what is added to it, one with an angle of so many turns, and a product of vectors,
/// which numbers do not show to be wrong.
fn is_loose(entry: &Entry) -> bool {
    let figures: Vec<char> = entry.tex.tex.chars().collect();
    let is_rounded = figures
        .windows(3)
        .any(|three| three[0].is_ascii_digit() && three[1] == '.' && three[2].is_ascii_digit());
    let is_letter =
        |tree: &Tree, letters: &[&str]| matches!(tree, Tree::Symbol(name, _) if letters.contains(&name.base.as_str()));
    // what is not understood may be anything
    let is_term = |node: &Tree| matches!(node, Tree::Symbol(name, _) if is_opaque(name));
    let is_of_vectors =
        |node: &Tree| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Cross(..)));
    let counts_turns = |node: &Tree| match node {
        Tree::Product(factors) => {
            factors.iter().any(|factor| is_letter(factor, &[r"\pi"]))
                && factors
                    .iter()
                    .any(|factor| is_letter(factor, &["n", "m", "k", "l", "j"]))
        }
        _ => false,
    };
    let is_loose = |equation: &Equation| {
        equation.relation != Relation::Equal
            || any_side(equation, &mut |node| {
                counts_turns(node) || is_letter(node, &["C"]) || is_term(node) || is_of_vectors(node)
            })
    };
    is_rounded || entry.tex.tex.contains(r"\equiv") || entry.has_more_said || entry.equations.iter().any(is_loose)
}

/// Decides the claim at a position of a sheet.
pub fn decide(sheet: &Sheet, position: usize, options: &prove::Options, repair: bool) -> Result<Row, Fault> {
    let mut decision = prove::decide(sheet, position, options);
    let is_judged = !matches!(decision.verdict, Verdict::Unread | Verdict::Given);
    let read = is_judged && sheet.unread_below(position).is_empty();
    let evidence = read
        .then(|| {
            let counterexample = decision.counterexample.as_ref().map(|own| &own.point);
            witness_near(
                sheet,
                position,
                decision.verdict,
                POINTS,
                counterexample.unwrap_or(&decision.point),
            )
        })
        .transpose()?;
    let accused = sheet.entries.get(position).filter(|entry| {
        let is_claimed = match decision.standing {
            Standing::Said => false,
            Standing::Link => true,
            _ => have_one_set_of_letters(entry.equations.iter()),
        };
        decision.fails && is_claimed && !entry.equations.is_empty() && !is_loose(entry)
    });
    let mut repairs = match decision.verdict {
        Verdict::Refuted if repair => Some(repairs(sheet, position, options)),
        _ if accused.is_some() => Some(repairs(sheet, position, options)),
        _ => None,
    };
    if accused.is_some() {
        let first = repairs.as_ref().and_then(|repairs| repairs.found.first());
        match first.is_some_and(|repair| shows_misprint(sheet, position, repair, options)) {
            true => decision.suspect(),
            false => repairs = None,
        }
    }
    Ok(Row {
        position,
        decision,
        evidence,
        repairs,
        is_known: None,
    })
}
