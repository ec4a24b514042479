//! Proofs and counterexamples as files for Rocq: the theorem is the printed formula, its proof the steps that the kernel accepted.

mod operations;
mod printed;
mod steps;
mod text;
mod values;

use super::Decision;
use super::script::{Decided, Found};
use claims::{Sheet, Statements};
use kernel::{Certificate, Function, Given, Origin, Property, Quantity, Statement, Symbol, Term, With, Witness};
use operations::{Induction, Kind, Printed};
use printed::Printer;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use steps::{Before, Ground, Steps};
use texmath::Symbols;
pub use text::Unwritten;
use text::property;
use values::values;

/// The library that each file requires, in the order in which its files are compiled: the axioms of the kernel, what holds of
/// sums, integrals and limits, the rules of its steps, and those of claims with operations, all as lemmas.
pub const LIBRARY: [(&str, &str); 4] = [
    ("VibroAxioms.v", include_str!("VibroAxioms.v")),
    ("VibroOperations.v", include_str!("VibroOperations.v")),
    ("VibroRules.v", include_str!("VibroRules.v")),
    ("VibroClaims.v", include_str!("VibroClaims.v")),
];

/// The program that checks all files of a directory.
pub const CHECK: &str = include_str!("check.sh");

/// A text within a comment of Rocq, which may hold neither its signs nor a lone quotation mark.
fn comment(text: &str) -> String {
    let text: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    // no sign that changes the order in which others are shown
    let text = text.replace(
        |c: char| {
            c.is_control() || matches!(c, '\u{200e}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        },
        "",
    );
    // a star between blanks opens and closes nothing, whatever stands beside it
    text.replace('*', " * ").replace('"', "''")
}

/// The files about the claim at a position, which is decided by these questions, and why something is not written: one file for each question that decides it, or one about
/// the printed formula where that holds a sum, an integral or the like and is proved.
pub fn files(sheet: &Sheet, position: usize, decided: &[Decided]) -> Vec<Result<String, Unwritten>> {
    if decided.is_empty() {
        return vec![Err(Unwritten::Not(
            "letters that need not commute, or what has a value nowhere",
        ))];
    }
    let is_proved = |one: &Decided| matches!(one.found, Found::Proved { .. });
    let statements = Decision::without_search(sheet, position).ok();
    let has_operations = |statements: &Statements| statements.claims.iter().any(operations::has_operations);
    let is_reduced = decided.iter().any(|one| !one.goal.statements.rules.is_empty());
    let whole = match statements.filter(has_operations) {
        Some(statements) if decided.iter().all(is_proved) || !decided.iter().any(is_proved) => {
            Some(whole(&statements, &sheet.symbols, decided))
        }
        None if !is_reduced => None,
        _ => Some(Err(Unwritten::Not(
            "the printed formula: files say the goals that it is reduced to",
        ))),
    };
    // the questions themselves are better than nothing
    let is_written = whole.as_ref().is_some_and(Result::is_ok);
    let goals = decided.iter().filter(|_| !is_written).map(file);
    whole.into_iter().chain(goals).collect()
}

/// The theorem that a file proves, without its proof.
pub fn theorem(file: &str) -> Option<&str> {
    // in a line of its own: a label may say the same
    let begin = ["\nTheorem holds :", "\nTheorem fails :"]
        .iter()
        .find_map(|name| file.find(name))?;
    let end = file[begin..].find("\nProof.")?;
    Some(&file[begin + 1..begin + end])
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

/// The beginning of a file.
const REQUIRED: &str =
    "Require Import VibroClaims.\nRequire Import Reals Lra Lia Coquelicot.Coquelicot.\nOpen Scope R_scope.\n\n";

/// The first line of a file.
fn head(decided: &Decided) -> String {
    let part = if decided.of_exception {
        ", a part of what is conditional"
    } else {
        ""
    };
    format!(
        "(* ({}), {}{part}: {} *)\n",
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
    let body = match &decided.found {
        Found::Proved { certificate, point } => {
            let mut own = certificate.statement.clone();
            let mut steps = Steps::new(&mut own, &certificate.evidence, &decided.goal.symbols.index);
            let theorem = Theorem::of(decided, printed, &mut steps)?;
            theorem.proved(decided, &mut steps, &certificate.evidence.steps, point)?
        }
        Found::Refuted { witness } => {
            let statement = &decided.question.statement;
            if !statement.implicit().is_empty() {
                return Err(Unwritten::Not(
                    "a counterexample with a map from one impact to the next",
                ));
            }
            let mut laws = statement.givens().iter().filter_map(|given| given.law.as_ref());
            if laws.any(|law| law.every_index || law.interval.is_some()) {
                return Err(Unwritten::Not("a counterexample to a law of flight or over indices"));
            }
            let mut own = witness.statement.clone();
            let mut steps = Steps::new(&mut own, &Certificate::default(), &decided.goal.symbols.index);
            let theorem = Theorem::of(decided, printed, &mut steps)?;
            match printed {
                None => theorem.refuted(&mut steps, witness)?,
                Some(_) => theorem.refuted_as_printed(decided, &mut steps, witness)?,
            }
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
    /// The printed formula, or its origin.
    comment: String,
}

/// The theorem that a question asks, with what the steps know of it.
struct Theorem {
    hypotheses: Vec<Hypothesis>,
    claim: String,
    claim_comment: String,
    /// Assertions that lead from the hypotheses to what is given.
    bridges: Vec<String>,
    /// The functions that maps are, each with how many quantities the map starts from.
    maps: Vec<(String, usize)>,
    /// The tactics that replace the operations of the claim by their values, where it is one that holds such.
    values: Option<String>,
    /// The proof of a claim that needs no goal.
    proof: Option<String>,
    /// The kind of a claim that an operation has a value.
    kind: Option<Kind>,
    /// The tactic that leads from the goal to the claim.
    conclude: &'static str,
    /// True if the claim is one with operations as it is printed, which nothing is assumed of that holds of numbers alone.
    is_whole: bool,
}

impl Theorem {
    fn of(decided: &Decided, whole: Option<Printed>, steps: &mut Steps) -> Result<Self, Unwritten> {
        let statements = &decided.goal.statements;
        let mut own = Self {
            hypotheses: Vec::new(),
            claim: String::new(),
            claim_comment: comment(&decided.question.equation.to_string()),
            bridges: Vec::new(),
            maps: Vec::new(),
            values: None,
            proof: None,
            kind: None,
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
        for (number, given) in givens.iter().enumerate() {
            match premise_of(decided, number) {
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
        if !steps.outright.is_empty() {
            return Err(Unwritten::Not(
                "a premise with a derivative of what a map says outright",
            ));
        }
        own.claim = match whole {
            None => printer.claim(steps)?,
            Some(printed) => {
                own.claim_comment = comment(&printed.equation.to_string());
                match printed.valued(decided, steps)? {
                    Some(valued) => {
                        (own.proof, own.kind) = (valued.proof, Some(valued.kind));
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
        let statement = steps.statement().clone();
        self.flights(&statement, steps);
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
        let (before, says) = match given.law {
            Some(_) => steps.law_said(number, 0)?,
            None => (Before::default(), property(given.property, &steps.full(given.term)?)),
        };
        if !assumed.is_empty() {
            let ways: Vec<String> = assumed.iter().map(|way| format!("as_printed {way}")).collect();
            self.bridges
                .push(format!("assert ({name} : {says}) by first [{}].", ways.join(" | ")));
            return Ok(());
        }
        let Some((printed, why)) = printed else {
            let is_bare = before.conditions.is_empty() && before.time.is_none();
            match self.is_whole && is_bare && steps.statement().terms().is_closed(given.term) {
                true => self.bridges.push(format!("assert ({name} : {says}) by at_point.")),
                false => self.push(name, before.all(&says), comment(&given.origin.to_string())),
            }
            return Ok(());
        };
        let hypothesis = format!("P{}", self.hypotheses.len());
        self.bridges.push(match before.conditions.is_empty() && before.time.is_none() {
            true => format!("assert ({name} : {says}) by as_printed {hypothesis}."),
            false => {
                let names = before.names();
                format!(
                    "assert ({name} : {}) by (intros {names}; pose proof ({hypothesis} {names}) as C9; as_printed C9).",
                    before.all(&says)
                )
            }
        });
        let says = before.all(&printed);
        self.push(hypothesis, says, why);
        Ok(())
    }

    /// Takes in what maps are: functions near a point, with derivatives there, that their equations hold for.
    fn maps(&mut self, decided: &Decided, grounds: &BTreeSet<Ground>, steps: &mut Steps) -> Result<(), Unwritten> {
        let statement = steps.statement().clone();
        let printer = Printer::new(decided);
        for (number, map) in statement.implicit().iter().enumerate() {
            let partials = statement
                .quantities()
                .iter()
                .enumerate()
                .filter_map(|(place, quantity)| match quantity {
                    Quantity::Partial { of, by } if map.of.contains(of) && map.by.contains(by) => {
                        Some((Symbol(u32::try_from(place).ok()?), *of, *by))
                    }
                    _ => None,
                });
            let partials: Vec<_> = partials.filter(|(symbol, ..)| steps.names.has(*symbol)).collect();
            let is_used = |equation| grounds.contains(&Ground::Near(number, equation));
            if map.equations.is_empty() || (partials.is_empty() && !(0..map.equations.len()).any(is_used)) {
                continue;
            }
            if map.by.len() > 3 {
                return Err(Unwritten::Not("a map that starts from more than three quantities"));
            }
            let named = |steps: &mut Steps, symbol: Symbol| steps.names.symbol(&statement, symbol);
            let starts: Vec<String> = map.by.iter().map(|&by| named(steps, by)).collect();
            let starts = starts.join(" ");
            let mut images = String::new();
            for &of in &map.of {
                let (name, image) = (named(steps, of), steps.image(of));
                images += &format!("let {name} := {image} {starts} in ");
                self.push(
                    format!("V_{image}"),
                    format!("{name} = {image} {starts}"),
                    format!(
                        "{} follows from what the map starts from",
                        comment(statement.terms().symbol_name(of))
                    ),
                );
                self.maps.push((image, map.by.len()));
            }
            for (symbol, of, by) in partials {
                let (image, by, name) = (steps.image(of), named(steps, by), named(steps, symbol));
                self.push(
                    format!("S{}", self.hypotheses.len()),
                    format!("is_derive (fun {by} : R => {image} {starts}) {by} {name}"),
                    comment(statement.terms().symbol_name(symbol)),
                );
            }
            for (place, (origin, term)) in map.equations.iter().enumerate() {
                let mut givens = statement.givens().iter();
                let given = givens.position(|given| given.origin == *origin && given.term == *term);
                let premise = given.and_then(|given| premise_of(decided, given));
                let (says, why) = match premise {
                    Some(premise) => {
                        let says = printer.premise(premise, steps)?;
                        (says, format!("({}) {}", premise.label, premise.equation))
                    }
                    None => (property(Property::Zero, &steps.full(*term)?), origin.to_string()),
                };
                let says = format!("{images}{}", abbreviated(&says, steps)?);
                self.push(
                    format!("N{number}_{place}"),
                    format!("near_{} (fun {starts} : R => {says}) {starts}", map.by.len()),
                    format!("wherever the map starts near that: {}", comment(&why)),
                );
            }
        }
        Ok(())
    }

    /// Takes in how flights begin and end, and that times follow one another.
    fn flights(&mut self, statement: &Statement, steps: &mut Steps) {
        let mut own = Vec::new();
        for &flight in &steps.flights {
            let end = |index: i32| statement.instants().get(&index).filter(|time| steps.names.has(**time));
            if let (Some(&from), Some(&to)) = (end(flight), end(flight + 1)) {
                own.push((flight, from, to));
            }
        }
        let times = own.into_iter().map(|(flight, from, to)| {
            let [from, to] = [from, to].map(|time| steps.names.symbol(statement, time));
            (flight, from, to)
        });
        let times: Vec<_> = times.collect();
        let running = statement.running();
        for (flight, from, to) in times {
            let name = format!("O{}", steps::place(flight));
            self.push(name, format!("{from} < {to}"), "the impacts follow one another".into());
            if let Some(running) = running.filter(|own| statement.interval() == Some(flight) && steps.names.has(*own)) {
                let time = steps.names.symbol(statement, running);
                let says = format!("{from} <= {time} <= {to}");
                self.push(
                    format!("Q{}", steps::place(flight)),
                    says,
                    "a time of the flight".into(),
                );
            }
        }
        let functions: Vec<_> = steps
            .names
            .functions()
            .map(|(key, name)| (*key, name.clone()))
            .collect();
        for ((function, order), name) in functions {
            for (begins, mark) in [(true, 'a'), (false, 'b')] {
                let end = statement.end_of(Function(function), order, begins);
                if let Some((state, time)) =
                    end.filter(|(state, time)| steps.names.has(*state) && steps.names.has(*time))
                {
                    let [state, time] = [state, time].map(|symbol| steps.names.symbol(statement, symbol));
                    let why = if begins {
                        "how the flight begins"
                    } else {
                        "how the flight ends"
                    };
                    self.push(
                        format!("E{function}_{order}{mark}"),
                        format!("{name} {time} = {state}"),
                        why.into(),
                    );
                }
            }
        }
    }

    /// The theorem with its proof.
    fn proved(
        mut self,
        decided: &Decided,
        steps: &mut Steps,
        inferences: &[kernel::Inference],
        point: &With<Witness>,
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
                for (count, (derivative, slope)) in steps.outright.clone().into_iter().enumerate() {
                    let slope = steps.full(slope)?;
                    let _ = writeln!(
                        end,
                        "assert (Y{count} : {derivative} = {slope}) by (apply is_derive_unique; cbv zeta; differentiate_smooth).\nrewrite ?Y{count}. clear Y{count}."
                    );
                }
                let _ = writeln!(end, "{conclude} B{place}.");
            }
            Ok(end)
        })?;
        let mut named = BTreeSet::new();
        let used = grounds.clone();
        for ground in grounds {
            match ground {
                Ground::Named(term) => {
                    named.insert(term);
                }
                Ground::Generic(term) => {
                    let says = property(Property::Nonzero, &steps.full(term)?);
                    self.push(format!("H{}", term.0), says, "for generic values".into());
                }
                Ground::Shifted(given, shift) => {
                    let (before, says) = steps.law_said(given, shift)?;
                    let origin = steps
                        .statement()
                        .givens()
                        .get(given)
                        .map(|given| given.origin.to_string());
                    let why = format!("{}, {shift:+} impacts on", comment(&origin.unwrap_or_default()));
                    self.push(steps::given_name(given, shift), before.all(&says), why);
                }
                Ground::Fact(_) | Ground::Law(_) | Ground::Given(_) | Ground::Definition(_) | Ground::Near(..) => {}
            }
        }
        self.maps(decided, &used, steps)?;
        // what is given has the names of the steps
        let mut changes = String::new();
        for (number, given) in decided.question.statement.givens().iter().enumerate() {
            if given.law.is_none() {
                let short = property(given.property, &steps.short(given.term)?);
                let _ = writeln!(changes, "change ({short}) in G{number}.");
            }
        }
        named.extend(steps.named_here());
        let named = steps.named(&named)? + &changes;
        let script = self.proof.take().unwrap_or(script);
        let values = self.values.take().unwrap_or_default();
        self.of_names_in(&[&script, &named, &values], steps);
        let mut text = format!("Theorem holds :\n{}.\nProof.\n", self.stated(steps));
        let names: Vec<&str> = self.hypotheses.iter().map(|own| own.name.as_str()).collect();
        for introduced in [
            self.variables(steps),
            names.iter().map(|&name| name.to_owned()).collect(),
        ] {
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
        text += "Qed.\n\nPrint Assumptions holds.\n";
        Ok(text + &self.consistent(steps, point))
    }
}

impl Theorem {
    /// The proposition.
    fn stated(&self, steps: &Steps) -> String {
        let mut text = quantifiers(steps);
        for (name, starts) in &self.maps {
            let _ = writeln!(text, "  forall {name} : {}R,", "R -> ".repeat(*starts));
        }
        for hypothesis in &self.hypotheses {
            let _ = writeln!(text, "  (* {} *)\n  ({}) ->", hypothesis.comment, hypothesis.says);
        }
        text + &format!("  (* claim: {} *)\n  {}", self.claim_comment, self.claim)
    }

    /// The theorem that the hypotheses hold somewhere, by a point; why it is missing where the point is not written.
    fn consistent(&self, steps: &mut Steps, point: &With<Witness>) -> String {
        if self.hypotheses.is_empty() {
            return String::new();
        }
        if !self.maps.is_empty() {
            return "\n(* That the hypotheses can hold is not written: maps are functions near a point. *)\n"
                .to_owned();
        }
        let values = match values(steps, point) {
            Ok(values) => values,
            Err(unwritten) => return format!("\n(* That the hypotheses can hold is not written: {unwritten}. *)\n"),
        };
        let mut text = String::from("\nTheorem consistent :\n");
        let names = [
            steps.names.symbols().map(|(_, name)| name.as_str()).collect::<Vec<_>>(),
            steps.names.functions().map(|(_, name)| name.as_str()).collect(),
        ];
        for (names, kind) in names.iter().zip(["R", "R -> R"]) {
            if !names.is_empty() {
                let _ = writeln!(text, "  exists {} : {kind},", names.join(" "));
            }
        }
        for hypothesis in &self.hypotheses {
            let _ = writeln!(text, "  ({}) /\\", hypothesis.says);
        }
        text += "  True.\nProof.\n";
        for value in values {
            let _ = writeln!(text, "exists {value}.");
        }
        for _ in &self.hypotheses {
            text += "split; [cbv beta; at_point|].\n";
        }
        text + "exact I.\nQed.\n"
    }

    /// The theorem that the proposition fails, and how its proof begins.
    fn denied(&self, steps: &Steps) -> String {
        format!("Theorem fails :\n  ~ (\n{}).\nProof.\nintro W9.\n", self.stated(steps))
    }

    /// The theorem that the proposition fails, by its counterexample.
    fn refuted(mut self, steps: &mut Steps, witness: &With<Witness>) -> Result<String, Unwritten> {
        self.of_names_in(&[], steps);
        if !steps.outright.is_empty() {
            return Err(Unwritten::Not("a counterexample with a derivative along a map"));
        }
        let values = values(steps, witness)?;
        let mut text = self.denied(steps);
        let _ = writeln!(text, "assert (X := W9 {}).\ncbv beta in X.", values.join(" "));
        for _ in &self.hypotheses {
            text += "meet X.\n";
        }
        text += "fails X.\nQed.\n\nPrint Assumptions fails.\n";
        Ok(text)
    }
}

impl Theorem {
    /// The theorem that a claim with operations fails, whose values at the point of a counterexample are others.
    fn refuted_as_printed(
        mut self,
        decided: &Decided,
        steps: &mut Steps,
        witness: &With<Witness>,
    ) -> Result<String, Unwritten> {
        // what makes an equation of two values of the claim, or of the claim and what is 0
        let other = match (&self.kind, &self.proof) {
            (Some(Kind::OneValue(subject)), Some(proof)) => {
                let value = Printer::of_operations(decided).tree(&decided.question.equation.left, None, steps)?;
                let proof = proof.trim_end();
                Some(format!(
                    "assert (Y : {subject} {value}).\n{{ {proof} }}\none_value X Y.\n"
                ))
            }
            (Some(Kind::Antiderivative(constants)), _) => {
                let zeros = " 0".repeat(*constants);
                Some(format!("specialize (X{zeros}). one_derivative X.\n"))
            }
            _ => None,
        };
        let tactics = self.values.take().unwrap_or_default();
        // their derivatives need not be spoken of, and the theorem would be about functions without any
        if steps.names.functions().next().is_some() {
            return Err(Unwritten::Not(
                "a counterexample with unknown functions under an operation",
            ));
        }
        self.of_names_in(&[&tactics, other.as_deref().unwrap_or_default()], steps);
        let mut text = self.denied(steps);
        let values = values(steps, witness)?;
        for (name, value) in self.variables(steps).iter().zip(values) {
            let _ = writeln!(text, "destruct (has_name {value}) as [{name} E_{name}].");
        }
        let mut all = self.variables(steps);
        for hypothesis in &self.hypotheses {
            let Hypothesis { name, says, .. } = hypothesis;
            let _ = writeln!(
                text,
                "assert ({name} : {says}) by (clear W9; subst; cbv beta; at_point)."
            );
            all.push(name.clone());
        }
        let _ = writeln!(text, "assert (X := W9 {}).\nclear W9.", all.join(" "));
        text += &match other {
            Some(other) => other,
            None => format!("revert X.\n{tactics}intro X.\n"),
        };
        Ok(text + "subst; cbv beta in X. fails X.\nQed.\n\nPrint Assumptions fails.\n")
    }
}

/// The premise that a given says, of those with its label that in its place.
fn premise_of(decided: &Decided, number: usize) -> Option<&claims::Premise> {
    let givens = decided.question.statement.givens();
    let origin = &givens.get(number)?.origin;
    let Origin::Premise(label) = origin else { return None };
    let premises = &decided.goal.statements.premises;
    let own: Vec<&claims::Premise> = premises.iter().filter(|premise| premise.label == *label).collect();
    let all: Vec<usize> = (0..givens.len())
        .filter(|&n| givens.get(n).is_some_and(|given| given.origin == *origin))
        .collect();
    match own.len() == all.len() {
        true => own.get(all.iter().position(|&n| n == number)?).copied(),
        false => own.first().copied().filter(|_| all.first() == Some(&number)),
    }
}

/// A proposition about quantities that move, in which abbreviations are said anew.
pub fn abbreviated(says: &str, steps: &mut Steps) -> Result<String, Unwritten> {
    let definitions: Vec<_> = steps.statement().definitions().iter().map(|(s, t)| (*s, *t)).collect();
    let mut lets: Vec<(String, String)> = Vec::new();
    let mut text = says.to_owned();
    let is_within = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
    for _ in 0..=definitions.len() {
        for &(symbol, meaning) in &definitions {
            let term = steps.statement().terms_mut().symbol(symbol);
            let name = steps.full(term)?;
            if text.split(|c| !is_within(c)).any(|word| word == name) {
                let meaning = steps.full(meaning)?;
                text += &format!(" {meaning}");
                lets.retain(|(known, _)| *known != name);
                lets.push((name, meaning));
            }
        }
    }
    let lets = lets
        .iter()
        .rev()
        .map(|(name, meaning)| format!("let {name} := {meaning} in "));
    Ok(lets.collect::<String>() + says)
}

impl Theorem {
    fn variables(&self, steps: &Steps) -> Vec<String> {
        let symbols = steps.names.symbols().map(|(_, name)| name.clone());
        let functions = steps.names.functions().map(|(_, name)| name.clone());
        let maps = self.maps.iter().map(|(name, _)| name.clone());
        symbols.chain(functions).chain(maps).collect()
    }
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
