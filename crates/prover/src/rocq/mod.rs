//! Proofs and counterexamples as files for Rocq: the theorem is the printed formula, its proof the steps that the kernel accepted.

mod operations;
mod printed;
mod steps;
mod text;

use super::script::{Decided, Found};
use super::{Decision, Options, decided};
use claims::{Sheet, Statements};
use kernel::{
    At, Certificate, EFFORT, Function, Given, Node, Origin, Property, Statement, Symbol, Term, With, Witness,
};
use operations::{Induction, Printed};
use printed::Printer;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use steps::{Ground, Steps};
use texmath::Symbols;
pub use text::Unwritten;
use text::property;

/// The library that each file requires, in the order in which its files are compiled: the axioms of the kernel, what holds of
/// sums, integrals and limits, the rules of its steps, and those of claims with operations, all as lemmas.
pub const LIBRARY: [(&str, &str); 4] = [
    ("VibroAxioms.v", include_str!("VibroAxioms.v")),
    ("VibroOperations.v", include_str!("VibroOperations.v")),
    ("VibroRules.v", include_str!("VibroRules.v")),
    ("VibroClaims.v", include_str!("VibroClaims.v")),
];

/// A text within a comment of Rocq, which may hold neither its signs nor a lone quotation mark.
fn comment(text: &str) -> String {
    let text: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    text.replace("(*", "( *").replace("*)", "* )").replace('"', "''")
}

/// The files for the claim at a position: one for each question that decides it, or one about the printed formula where that holds
/// a sum, an integral or the like and is proved.
pub fn files(sheet: &Sheet, position: usize, options: &Options) -> Vec<Result<String, Unwritten>> {
    let decided = decided(sheet, position, options);
    let is_proved = |one: &Decided| matches!(one.found, Found::Proved { .. });
    let statements = Decision::without_search(sheet, position).ok();
    let has_operations = |statements: &Statements| statements.claims.iter().any(operations::has_operations);
    match statements.filter(has_operations) {
        Some(statements) if !decided.is_empty() && decided.iter().all(is_proved) => {
            vec![whole(&statements, &sheet.symbols, &decided)]
        }
        _ => decided.iter().map(file).collect(),
    }
}

/// The file about a claim with operations.
fn whole(statements: &Statements, symbols: &Symbols, decided: &[Decided]) -> Result<String, Unwritten> {
    let equation = operations::equation(statements)?;
    if let Some(induction) = Induction::of(decided) {
        let first = decided.first().map(head).unwrap_or_default();
        return Ok(first + REQUIRED + &induction.theorem(equation, &statements.assume)?);
    }
    let printed = Printed { equation, symbols };
    written(operations::main_goal(decided)?, Some(printed))
}

/// What a file starts with.
const REQUIRED: &str =
    "Require Import VibroClaims.\nRequire Import Reals Lra Lia Coquelicot.Coquelicot.\nOpen Scope R_scope.\n\n";

/// The first line of a file.
fn head(decided: &Decided) -> String {
    format!(
        "(* ({}), {}: {} *)\n",
        comment(&decided.label),
        verdict(decided),
        comment(&decided.printed)
    )
}

/// The file for a question with what decides it.
///
/// # Errors
/// [`Unwritten`], which names the first thing that is not written for Rocq.
pub fn file(decided: &Decided) -> Result<String, Unwritten> {
    written(decided, None)
}

/// The file for a question, or for the printed claim that it decides.
fn written(decided: &Decided, printed: Option<Printed>) -> Result<String, Unwritten> {
    if decided.question.statement.is_complex() {
        return Err(Unwritten::Not("complex numbers"));
    }
    if !decided.question.statement.maps().is_empty() {
        return Err(Unwritten::Not("maps from one impact to the next"));
    }
    let body = match &decided.found {
        Found::Proved { certificate, .. } => {
            let mut own = certificate.statement.clone();
            let mut steps = Steps::new(&mut own, &certificate.evidence);
            let theorem = Theorem::of(decided, printed, &mut steps)?;
            theorem.proved(decided, &mut steps, &certificate.evidence.steps)?
        }
        Found::Refuted { witness } => {
            let mut own = witness.statement.clone();
            let mut steps = Steps::new(&mut own, &Certificate::default());
            Theorem::of(decided, None, &mut steps)?.refuted(&mut steps, witness)?
        }
    };
    let mut text = head(decided);
    let rules: Vec<String> = decided.goal.statements.rules.iter().map(ToString::to_string).collect();
    if !rules.is_empty() && printed.is_none() {
        let _ = writeln!(
            text,
            "(* reduced by rules that are trusted: {} *)",
            comment(&rules.join("; "))
        );
    }
    Ok(text + REQUIRED + &body)
}

fn verdict(decided: &Decided) -> &'static str {
    match decided.found {
        Found::Proved { .. } => "proved",
        Found::Refuted { .. } => "refuted",
    }
}

/// A hypothesis of a theorem.
struct Hypothesis {
    name: String,
    says: String,
    /// What it is in print, or where it comes from.
    comment: String,
}

/// The theorem that a question asks, with what the steps know of it.
struct Theorem {
    hypotheses: Vec<Hypothesis>,
    claim: String,
    claim_comment: String,
    /// Assertions that lead from the hypotheses to what is given.
    bridges: Vec<String>,
    /// What replaces the operations of the claim by their values, where it is one that holds such.
    values: Option<String>,
    /// The proof of a claim that needs no goal.
    proof: Option<String>,
    /// The tactic that leads from the goal to the claim.
    conclude: &'static str,
    /// Whether the claim is one with operations as it is printed, which nothing is assumed of that holds of numbers alone.
    is_whole: bool,
}

/// Returns true if a term is a number.
fn is_closed(statement: &Statement, term: Term) -> bool {
    let terms = statement.terms();
    let is_free = |inner: Term| matches!(terms.node(inner), Node::Symbol(_) | Node::Value(..));
    !terms.inside(term).into_iter().any(is_free)
}

impl Theorem {
    fn of(decided: &Decided, whole: Option<Printed>, steps: &mut Steps) -> Result<Self, Unwritten> {
        let statements = &decided.goal.statements;
        let mut own = Self {
            hypotheses: Vec::new(),
            claim: String::new(),
            claim_comment: comment(&decided.question.equation.to_string()),
            bridges: Vec::new(),
            values: None,
            proof: None,
            conclude: if whole.is_some() { "conclude_claim" } else { "conclude" },
            is_whole: whole.is_some(),
        };
        let printer = Printer::new(decided);
        let definitions: Vec<_> = steps.statement().definitions().iter().map(|(s, t)| (*s, *t)).collect();
        for (symbol, meaning) in definitions {
            let term = steps.statement().terms_mut().symbol(symbol);
            let says = format!("{} = {}", steps.full(term)?, steps.full(meaning)?);
            own.push(format!("D{}", symbol.0), says, "by definition".into());
        }
        let mut printed = Vec::new();
        for condition in &statements.assume {
            let says = printer.condition(condition, steps)?;
            let name = format!("P{}", own.hypotheses.len());
            printed.push(name.clone());
            own.push(name, says, comment(&printed::condition_text(condition)));
        }
        let givens = decided.question.statement.givens().to_vec();
        let mut told = BTreeSet::new();
        for (number, given) in givens.iter().enumerate() {
            let premise = match &given.origin {
                Origin::Premise(label) => statements.premises.iter().find(|premise| premise.label == *label),
                _ => None,
            };
            let is_first = told.insert(given.origin.clone());
            match premise.filter(|_| is_first) {
                Some(premise) => {
                    let says = printer.premise(premise, steps)?;
                    let why = format!(
                        "({}) {}",
                        comment(&premise.label),
                        comment(&premise.equation.to_string())
                    );
                    own.given(number, given, Some((says, why)), &[], steps)?;
                }
                None if given.origin == Origin::Assumptions => own.given(number, given, None, &printed, steps)?,
                None => own.given(number, given, None, &[], steps)?,
            }
        }
        own.claim = match whole {
            None => printer.claim(decided, steps)?,
            Some(printed) => {
                own.claim_comment = comment(&printed.equation.to_string());
                match printed.valued(decided, steps)? {
                    Some(valued) => {
                        own.proof = valued.proof;
                        own.conclude = "conclude_derivative";
                        valued.claim
                    }
                    None => {
                        own.values = Some(printed.values(decided, steps)?);
                        Printer::of_operations(decided).relation(printed.equation, None, steps)?
                    }
                }
            }
        };
        Ok(own)
    }

    fn push(&mut self, name: String, says: String, comment: String) {
        self.hypotheses.push(Hypothesis { name, says, comment });
    }

    /// Speaks of the names that occur in the theorem and these texts alone, and says what functions are.
    fn of_names_in(&mut self, texts: &[&str], steps: &mut Steps) {
        let own = self.hypotheses.iter().map(|hypothesis| hypothesis.says.as_str());
        let all = own.chain([self.claim.as_str()]).chain(texts.iter().copied());
        let is_within = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
        let words: BTreeSet<&str> = all.flat_map(|text| text.split(|c| !is_within(c))).collect();
        steps.names.keep(&words);
        self.smooth(steps);
    }

    /// Takes in that unknown functions have the derivatives that are spoken of.
    fn smooth(&mut self, steps: &mut Steps) {
        let declared: Vec<_> = steps
            .statement()
            .derivatives()
            .iter()
            .map(|(of, to)| (of.0, to.0))
            .collect();
        let mut highest: BTreeMap<u32, u32> = BTreeMap::new();
        for ((function, order), _) in steps.names.functions() {
            let own = highest.entry(*function).or_default();
            *own = (*own).max(*order);
        }
        let mut pairs = Vec::new();
        for (&function, &order) in &highest {
            pairs.extend((0..order).map(|below| [(function, below), (function, below + 1)]));
        }
        let is_spoken_of = |function: &u32| highest.contains_key(function);
        let declared = declared.iter().filter(|(of, to)| is_spoken_of(of) && is_spoken_of(to));
        pairs.extend(declared.map(|(of, to)| [(*of, 0), (*to, 0)]));
        for [of, to] in pairs {
            let statement = steps.statement().clone();
            let [of, to] =
                [of, to].map(|(function, order)| steps.names.function(&statement, Function(function), order));
            let says = format!("forall T0 : R, is_derive {of} T0 ({to} T0)");
            let name = format!("S{}", self.hypotheses.len());
            self.push(name, says, "a smooth function".into());
        }
    }

    /// Takes a given in: as it is printed, from what is assumed, or by its term.
    fn given(
        &mut self,
        number: usize,
        given: &Given,
        printed: Option<(String, String)>,
        assumed: &[String],
        steps: &mut Steps,
    ) -> Result<(), Unwritten> {
        let name = format!("G{number}");
        let (before, says) = self.law(number, given, steps)?;
        if !assumed.is_empty() {
            let ways: Vec<String> = assumed.iter().map(|way| format!("as_printed {way}")).collect();
            self.bridges
                .push(format!("assert ({name} : {says}) by first [{}].", ways.join(" | ")));
            return Ok(());
        }
        let Some((printed, why)) = printed else {
            let is_bare = before.conditions.is_empty() && before.time.is_none();
            match self.is_whole && is_bare && is_closed(steps.statement(), given.term) {
                true => self.bridges.push(format!("assert ({name} : {says}) by at_point.")),
                false => self.push(name, before.all(&says), comment(&given.origin.to_string())),
            }
            return Ok(());
        };
        let hypothesis = format!("P{}", self.hypotheses.len());
        self.bridges.push(match before.conditions.is_empty() && before.time.is_none() {
            true => format!("assert ({name} : {says}) by as_printed {hypothesis}."),
            false => {
                let names: Vec<String> = (0..before.conditions.len()).map(|n| format!("C{n}")).collect();
                let time = before.time.as_ref().map_or("", |_| "T0");
                let names = names.join(" ");
                format!(
                    "assert ({name} : {}) by (intros {time} {names}; pose proof ({hypothesis} {time} {names}) as C; as_printed C).",
                    before.all(&says)
                )
            }
        });
        let says = before.all(&printed);
        self.push(hypothesis, says, why);
        Ok(())
    }

    /// What stands before a given that is a law, and what it says.
    fn law(&mut self, number: usize, given: &Given, steps: &mut Steps) -> Result<(Before, String), Unwritten> {
        let mut before = Before::default();
        let Some(law) = &given.law else {
            let says = property(given.property, &steps.full(given.term)?);
            return Ok((before, says));
        };
        let Some(time) = law.time.filter(|_| law.flight.is_none() && !law.every_impact) else {
            return Err(Unwritten::Not("a law of flight or over indices"));
        };
        let at = steps.statement().terms_mut().symbol(time);
        let instance = steps.statement().instance(number, Some(at), 0, None);
        let instance = instance.ok_or(Unwritten::Not("a law that does not extend to its own time"))?;
        before.time = Some(steps.full(at)?);
        for (shown, of) in instance.conditions {
            before.conditions.push(property(shown, &steps.full(of)?));
        }
        let says = property(instance.property, &steps.full(instance.term)?);
        Ok((before, says))
    }

    /// The theorem with its proof.
    fn proved(
        mut self,
        decided: &Decided,
        steps: &mut Steps,
        inferences: &[kernel::Inference],
    ) -> Result<String, Unwritten> {
        let goals: Vec<(Property, Term)> = match &self.proof {
            Some(_) => Vec::new(),
            None => decided.question.statement.goal().to_vec(),
        };
        let conclude = self.conclude;
        let (script, grounds) = steps.scope(inferences, &mut |steps| {
            let mut end = String::new();
            for (place, &(shown, term)) in goals.iter().enumerate() {
                let (short, full) = (steps.short(term)?, steps.full(term)?);
                let by = steps.shown(shown, term)?;
                let _ = writeln!(end, "assert (B{place} : {}).\n{{ {by}. }}", property(shown, &short));
                let _ = writeln!(end, "change ({}) in B{place}.", property(shown, &full));
                let _ = writeln!(end, "{conclude} B{place}.");
            }
            Ok(end)
        })?;
        let mut named = BTreeSet::new();
        for ground in grounds {
            match ground {
                Ground::Named(term) => {
                    named.insert(term);
                }
                Ground::Generic(term) => {
                    let says = property(Property::Nonzero, &steps.full(term)?);
                    self.push(format!("H{}", term.0), says, "for generic values".into());
                }
                Ground::Fact(_) | Ground::Law(_) | Ground::Given(_) | Ground::Definition(_) => {}
            }
        }
        let named = steps.named(&named)?;
        let script = self.proof.take().unwrap_or(script);
        let values = self.values.take().unwrap_or_default();
        self.of_names_in(&[&script, &named, &values], steps);
        let mut text = format!("Theorem holds :\n{}.\nProof.\n", self.stated(steps));
        let names: Vec<&str> = self.hypotheses.iter().map(|own| own.name.as_str()).collect();
        for introduced in [variables(steps), names.iter().map(|&name| name.to_owned()).collect()] {
            if !introduced.is_empty() {
                let _ = writeln!(text, "intros {}.", introduced.join(" "));
            }
        }
        for bridge in &self.bridges {
            let _ = writeln!(text, "{bridge}");
        }
        let printed: Vec<&str> = names.iter().copied().filter(|name| name.starts_with('P')).collect();
        if !printed.is_empty() {
            let _ = writeln!(text, "clear {}.", printed.join(" "));
        }
        text += &values;
        text += &named;
        text += &script;
        text += "Qed.\n";
        Ok(text)
    }
}

impl Theorem {
    /// The proposition.
    fn stated(&self, steps: &Steps) -> String {
        let mut text = quantifiers(steps);
        for hypothesis in &self.hypotheses {
            let _ = writeln!(text, "  (* {} *)\n  ({}) ->", hypothesis.comment, hypothesis.says);
        }
        text + &format!("  (* claim: {} *)\n  {}", self.claim_comment, self.claim)
    }

    /// The theorem that the proposition fails, by its counterexample.
    fn refuted(mut self, steps: &mut Steps, witness: &With<Witness>) -> Result<String, Unwritten> {
        self.of_names_in(&[], steps);
        let values = values(steps, witness)?;
        let mut text = format!("Theorem fails :\n  ~ (\n{}).\nProof.\nintro W.\n", self.stated(steps));
        let _ = writeln!(text, "assert (X := W {}).\ncbv beta in X.", values.join(" "));
        for _ in &self.hypotheses {
            text += "meet X.\n";
        }
        text += "fails X.\nQed.\n";
        Ok(text)
    }
}

/// The values at a point of the symbols and functions that have names, in the order of these.
fn values(steps: &mut Steps, witness: &With<Witness>) -> Result<Vec<String>, Unwritten> {
    let mut own = witness.statement.clone();
    let mut at = At::unchecked(&mut own, &witness.evidence, EFFORT);
    let symbols: Vec<Symbol> = steps.names.symbols().map(|(symbol, _)| *symbol).collect();
    let functions: Vec<(u32, u32)> = steps.names.functions().map(|(function, _)| *function).collect();
    let mut values = Vec::new();
    for symbol in symbols {
        let term = at.statement().terms_mut().symbol(symbol);
        let value = at.value(term)?;
        values.push(closed(at.statement(), value)?);
    }
    for (function, order) in functions {
        let named = witness.evidence.functions.iter().find(|(own, ..)| own.0 == function);
        let (_, time, term) = named.ok_or(Unwritten::Not("a function given at single times"))?;
        let mut value = at.value(*term)?;
        for _ in 0..order {
            value = at.statement().derivative(value, *time);
        }
        let body = closed(at.statement(), value)?;
        values.push(format!("(fun {} : R => {body})", RUNNING));
    }
    Ok(values)
}

/// The letter of the functions of a point.
const RUNNING: &str = "u";

/// A term in which one symbol at most is left, which runs.
fn closed(statement: &Statement, term: Term) -> Result<String, Unwritten> {
    let mut names = text::Names::default();
    for inner in statement.terms().inside(term) {
        if let Node::Symbol(symbol) = statement.terms().node(inner) {
            names.let_be(*symbol, RUNNING);
        }
    }
    let mut writer = text::Writer {
        statement,
        names: &mut names,
        whole: &BTreeSet::new(),
        is_short: false,
        met: BTreeSet::new(),
    };
    writer.term(term)
}

/// What stands before a law: the time over which it runs, and its conditions.
#[derive(Default)]
struct Before {
    time: Option<String>,
    conditions: Vec<String>,
}

impl Before {
    fn all(&self, says: &str) -> String {
        let mut text = String::new();
        if let Some(time) = &self.time {
            let _ = write!(text, "forall {time} : R, ");
        }
        for condition in &self.conditions {
            let _ = write!(text, "{condition} -> ");
        }
        text + says
    }
}

fn variables(steps: &Steps) -> Vec<String> {
    let symbols = steps.names.symbols().map(|(_, name)| name.clone());
    symbols
        .chain(steps.names.functions().map(|(_, name)| name.clone()))
        .collect()
}

fn quantifiers(steps: &Steps) -> String {
    let symbols: Vec<&str> = steps.names.symbols().map(|(_, name)| name.as_str()).collect();
    let functions: Vec<&str> = steps.names.functions().map(|(_, name)| name.as_str()).collect();
    let mut text = String::new();
    if !symbols.is_empty() {
        let _ = writeln!(text, "  forall {} : R,", symbols.join(" "));
    }
    if !functions.is_empty() {
        let _ = writeln!(text, "  forall {} : R -> R,", functions.join(" "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
}
