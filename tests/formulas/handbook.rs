//! 400 printed formulas of handbooks, half of them with a misprint (`tests/handbook`), each as the sheet that an author would
//! write: none is decided wrongly, and most are decided. Their truth was established by numbers, before any of this was built.

use crate::common::sample;
use serde::Deserialize;
use std::collections::BTreeMap;
use vibro_audit::claim::{Sheet, Verdict};
use vibro_audit::prove::{self, Options};
use vibro_audit::tex::Symbols;

/// Formulas that are decided rightly, at least: the first run decided 117.
const RIGHT: usize = 361;

#[derive(Deserialize)]
struct Handbook {
    formula: Vec<Formula>,
}

#[derive(Deserialize)]
struct Formula {
    id: String,
    construct: String,
    tex: String,
    premises: Vec<String>,
    symbols: BTreeMap<String, Vec<String>>,
    assume: Vec<String>,
    truth: String,
}

fn list(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().map(|item| format!("'''{item}'''")).collect();
    format!("[{}]", items.join(", "))
}

impl Formula {
    fn kind(&self, kind: &str) -> Vec<String> {
        self.symbols.get(kind).cloned().unwrap_or_default()
    }

    /// A function runs over its argument, a sequence over its index; a vector is a definition.
    fn sheet(&self) -> String {
        let declared = self.kind("functions");
        let functions: Vec<(&str, &str)> = declared
            .iter()
            .filter_map(|text| text.trim_end_matches(')').split_once('('))
            .collect();
        let integers = self.kind("integers");
        let is_sequence = |argument: &str| integers.iter().any(|name| name == argument);
        let (sequences, functions): (Vec<_>, Vec<_>) =
            functions.into_iter().partition(|(_, argument)| is_sequence(argument));
        let is_function = |name: &str| functions.iter().any(|(function, _)| *function == name);
        let running = functions
            .iter()
            .map(|(_, argument)| *argument)
            .find(|name| !is_function(name));
        let runs = |name: &String| Some(name.as_str()) == running;
        let single = self.kind("real").into_iter().chain(self.kind("positive"));
        let single =
            single.filter(|name| !runs(name) && !is_function(name) && !sequences.iter().any(|(own, _)| own == name));
        let mut lines = vec!["[symbols]".to_owned(), format!("parameters = {}", list(single))];
        for kind in ["positive", "nonnegative", "nonzero", "complex"] {
            lines.push(format!(
                "{kind} = {}",
                list(self.kind(kind).into_iter().filter(|name| !runs(name)))
            ));
        }
        let index = |name: &String| sequences.iter().any(|(_, argument)| argument == name);
        lines.push(format!(
            "integers = {}",
            list(integers.iter().filter(|name| !index(name)).cloned())
        ));
        lines.push(format!(
            "indices = {}",
            list(integers.iter().filter(|name| index(name)).cloned())
        ));
        lines.push(format!(
            "states = {}",
            list(sequences.iter().map(|(name, _)| (*name).to_owned()))
        ));
        lines.push(format!("times = {}", list(running.map(str::to_owned))));
        lines.push(format!(
            "functions = {}",
            list(functions.iter().map(|(name, _)| (*name).to_owned()))
        ));
        let mut labels = Vec::new();
        for (place, premise) in self.premises.iter().enumerate() {
            let role = if premise.starts_with("\\vec") {
                "definition"
            } else {
                "premise"
            };
            labels.push(format!("p{place}"));
            lines.push(format!(
                "[[equation]]\nlabel = \"p{place}\"\nrole = \"{role}\"\ntex = '''{premise}'''"
            ));
        }
        lines.push(format!(
            "[[equation]]\nlabel = \"c\"\nrole = \"claim\"\ntex = '''{}'''\nassume = {}\nfollows_from = {}",
            self.tex,
            list(self.assume.clone()),
            list(labels)
        ));
        lines.join("\n")
    }

    /// The verdict, and the reason of it.
    fn decided(&self) -> (Verdict, String) {
        let sheet = match Sheet::read(&self.sheet(), &Symbols::default()) {
            Ok(sheet) => sheet,
            Err(fault) => return (Verdict::Unread, fault.to_string()),
        };
        let position = sheet.find("c").unwrap();
        let decision = prove::decide(&sheet, position, &Options::default());
        (decision.verdict, decision.reason)
    }
}

/// The sheets of the formulas that a test takes, each behind its construct and its name.
pub fn sheets(takes: impl Fn(&str) -> bool) -> Vec<(String, String, Sheet)> {
    let handbook: Handbook = toml::from_str(include_str!("../handbook/formulas.toml")).unwrap();
    let taken = handbook.formula.into_iter().filter(|formula| takes(&formula.id));
    let sheet = |formula: Formula| {
        let sheet = Sheet::read(&formula.sheet(), &Symbols::default()).ok()?;
        Some((formula.construct, formula.id, sheet))
    };
    taken.filter_map(sheet).collect()
}

#[test]
fn no_formula_of_the_handbooks_is_decided_wrongly_and_most_are_decided() {
    let mut handbook: Handbook = toml::from_str(include_str!("../handbook/formulas.toml")).unwrap();
    handbook.formula.retain(|formula| sample::takes(&formula.id, 4));
    let half = handbook.formula.len() / 2;
    let decide = |formulas: &'static [Formula]| -> Vec<_> { formulas.iter().map(Formula::decided).collect() };
    let formulas: &'static [Formula] = Box::leak(handbook.formula.into_boxed_slice());
    let verdicts = std::thread::scope(|scope| {
        let first = scope.spawn(|| decide(&formulas[..half]));
        let second = decide(&formulas[half..]);
        [first.join().unwrap(), second].concat()
    });
    let (mut table, mut wrong) = (BTreeMap::<&str, [usize; 2]>::new(), Vec::new());
    for (formula, (verdict, reason)) in formulas.iter().zip(verdicts) {
        let truth = if formula.truth == "true" {
            Verdict::Proved
        } else {
            Verdict::Refuted
        };
        let [right, all] = table.entry(&formula.construct).or_default();
        *right += usize::from(verdict == truth);
        *all += 1;
        if !matches!(verdict, Verdict::Proved | Verdict::Refuted) {
            println!(
                "{} {} {}: {verdict:?}: {reason}",
                formula.id, formula.truth, formula.tex
            );
        }
        if matches!(verdict, Verdict::Proved | Verdict::Refuted) && verdict != truth {
            wrong.push(&formula.id);
        }
    }
    for (construct, [right, all]) in &table {
        println!("{construct}: {right} of {all} decided rightly");
    }
    assert!(wrong.is_empty(), "wrong: {wrong:?}");
    let right: usize = table.values().map(|[right, _]| right).sum();
    println!("in all {right} of {}", formulas.len());
    assert!(right >= sample::of(RIGHT, RIGHT / 5), "{right} are decided rightly");
}

/// The examples of the guide: a line `true: TEX; given PREMISE; assume CONDITION` or `false: ...` each.
#[test]
fn each_example_of_the_guide_is_decided_as_it_says() {
    let guide = include_str!("../../doc/reference/operations.md");
    let examples = guide.lines().filter_map(|line| {
        let truth = line.strip_prefix("true:").map(|rest| (Verdict::Proved, rest));
        truth.or_else(|| line.strip_prefix("false:").map(|rest| (Verdict::Refuted, rest)))
    });
    let mut count = 0;
    for (wanted, example) in examples {
        let mut parts = example.split("; ").map(str::trim);
        let tex = parts.next().unwrap();
        let (mut given, mut assume) = (Vec::new(), Vec::new());
        for part in parts {
            match (part.strip_prefix("given "), part.strip_prefix("assume ")) {
                (Some(premise), _) => given.push(premise.to_owned()),
                (_, Some(condition)) => assume.push(condition.to_owned()),
                _ => panic!("{part}"),
            }
        }
        let has_differential = ["{d}{d", "{d^2}", "\\, d"].iter().any(|text| tex.contains(text));
        let d = if has_differential { "" } else { "'d', " };
        // a is a sequence where a recurrence gives it
        let (a, sequence) = match given.is_empty() {
            true => ("'a', ", "integers = ['n']"),
            false => ("", "indices = ['n']\nstates = ['a']"),
        };
        let premises = given.iter().enumerate().map(|(number, premise)| {
            format!("[[equation]]\nlabel = \"p{number}\"\nrole = \"premise\"\ntex = '''{premise}'''\n")
        });
        let sheet = format!(
            "[symbols]\nparameters = [{a}'b', 'c', {d}'x', 'y', 'p']\npositive = ['p']\n{sequence}\n\
             complex = ['z', 'w']\ntimes = ['t']\nfunctions = ['f', 'g']\n{}\
             [[equation]]\nlabel = \"c\"\nrole = \"claim\"\ntex = '''{tex}'''\nassume = {}\nfollows_from = {}",
            premises.collect::<String>(),
            list(assume),
            list((0..given.len()).map(|number| format!("p{number}"))),
        );
        let sheet = Sheet::read(&sheet, &Symbols::default()).unwrap_or_else(|fault| panic!("{tex}: {fault}"));
        let decision = prove::decide(&sheet, given.len(), &Options::default());
        assert_eq!(decision.verdict, wanted, "{tex}: {}", decision.reason);
        count += 1;
    }
    assert!(count >= 34, "{count} examples");
}
