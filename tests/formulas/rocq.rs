//! Proofs and counterexamples as Rocq accepts them: theorems that say what is printed, with no axioms but those of the real
//! numbers. Where Rocq is not installed, nothing is checked, and a word says so.

use crate::common::rocq::{checked, library};
use crate::common::{attacks, sample};
use crate::handbook;
use std::collections::BTreeMap;
use vibro_audit::claim::{EQUATIONS, Sheet, vocabulary};
use vibro_audit::kernel::AxiomRow;
use vibro_audit::prove::{Found, Options, decided, rocq};
use vibro_audit::tex::Symbols;

/// A sheet of a corpus: the group that it is counted in, its name, and what it says.
type Own = (String, String, Sheet);

/// What became of the claims of a group that are decided.
#[derive(Default)]
struct Count {
    decided: usize,
    /// All that is written of them is accepted: of the printed claim, or of the goals that it is reduced to.
    accepted: usize,
    goals_accepted: usize,
}

/// What Rocq says of a corpus: a count of proved and of refuted claims for each group, why claims are not written, what is refused.
#[derive(Default)]
struct Table {
    groups: BTreeMap<(String, &'static str), Count>,
    unwritten: BTreeMap<String, usize>,
    refused: Vec<String>,
}

impl Table {
    /// Of the claims of a kind, the share of which all is accepted, and that of which the printed formula is.
    fn shares(&self, kind: &str) -> [f64; 2] {
        let own = self.groups.iter().filter(|((_, own), _)| *own == kind);
        let counts = own.map(|(_, count)| [count.decided, count.accepted + count.goals_accepted, count.accepted]);
        let sums = counts.fold([0; 3], |sums: [usize; 3], own| {
            [0, 1, 2].map(|place| sums[place] + own[place])
        });
        [1, 2].map(|place| sums[place] as f64 / sums[0].max(1) as f64)
    }

    fn print(&self) {
        println!(
            "{:24} {:8} {:>7} {:>8} {:>14}",
            "group", "verdict", "claims", "accepted", "goals accepted"
        );
        for (
            (group, kind),
            Count {
                decided,
                accepted,
                goals_accepted,
            },
        ) in &self.groups
        {
            println!("{group:24} {kind:8} {decided:>7} {accepted:>8} {goals_accepted:>14}");
        }
        self.unwritten
            .iter()
            .for_each(|(why, count)| println!("not written {count:>4}: {why}"));
        self.refused.iter().for_each(|refused| println!("refused: {refused}"));
    }
}

/// How many files one Rocq checks before another one begins.
const AT_ONCE: usize = 60;

/// Writes and checks what decides the claims of sheets; none where there is no Rocq.
fn table(sheets: &[Own]) -> Option<Table> {
    table_of(sheets, &|_| true)
}

/// Writes and checks what decides the claims of sheets whose labels are taken.
fn table_of(sheets: &[Own], takes: &dyn Fn(&str) -> bool) -> Option<Table> {
    let folder = library()?;
    let mut table = Table::default();
    let (mut texts, mut owners, mut claims) = (Vec::new(), Vec::new(), Vec::new());
    for (group, name, sheet) in sheets {
        for (position, entry) in sheet.entries.iter().enumerate() {
            if !takes(&entry.label) {
                continue;
            }
            let decided = decided(sheet, position, &Options::default());
            let Some(first) = decided.first() else { continue };
            let kind = match first.found {
                Found::Refuted { .. } => "refuted",
                Found::Proved { .. } => "proved",
            };
            let files = rocq::files(sheet, position, &decided);
            let is_whole = files.iter().all(Result::is_ok);
            for why in files.iter().filter_map(|file| file.as_ref().err()) {
                *table.unwritten.entry(why.to_string()).or_default() += 1;
            }
            let place = format!("{name} ({}): {}", first.label, first.printed);
            for text in files.into_iter().flatten() {
                texts.push(text);
                owners.push(claims.len());
            }
            claims.push((group.clone(), kind, place, is_whole));
        }
    }
    let mut faults: Vec<Vec<Option<String>>> = vec![Vec::new(); claims.len()];
    for (texts, owners) in texts.chunks(AT_ONCE).zip(owners.chunks(AT_ONCE)) {
        for (owner, fault) in owners
            .iter()
            .zip(checked(folder, texts, &["holds", "fails", "consistent"]))
        {
            faults[*owner].push(fault);
        }
    }
    for ((group, kind, place, is_whole), faults) in claims.into_iter().zip(faults) {
        let count = table.groups.entry((group, kind)).or_default();
        let is_accepted = !faults.is_empty() && faults.iter().all(Option::is_none);
        count.decided += 1;
        count.accepted += usize::from(is_accepted && is_whole);
        count.goals_accepted += usize::from(is_accepted && !is_whole);
        let refused = faults
            .into_iter()
            .flatten()
            .map(|fault| format!("{place}\n    {fault}"));
        table.refused.extend(refused);
    }
    table.print();
    Some(table)
}

/// A row of the table of axioms as Rocq states it: `power(x, y)` as `rpow x y`, natural letters as such.
fn stated(row: &AxiomRow) -> String {
    let all = format!("{} ; {}", row.guards.join(" ; "), row.conclusion);
    let is_index = |letter: &str| all.contains(&format!("root({letter},"));
    let is_natural = |letter: &str| {
        let kinds = ["natural", "even", "odd"];
        kinds.iter().any(|kind| all.contains(&format!("{kind}({letter})"))) || is_index(letter)
    };
    let mut premises = Vec::new();
    if row.letters.iter().any(|letter| is_index(letter)) {
        premises.push("(2 <= n)%nat".to_owned());
    }
    for guard in &row.guards {
        let (kind, of) = guard.split_once('(').unwrap_or((guard, ""));
        let of = of.trim_end_matches(')');
        match kind {
            "real" | "reals" | "natural" => {}
            "defined" => match of.split_once('(') {
                None => {}
                Some(("ln", x)) => premises.push(format!("{x} > 0")),
                Some(("root", _)) => premises.push("(Nat.even n = true -> x >= 0)".to_owned()),
                Some(("arcsin" | "arccos", x)) => premises.extend([format!("1 - {x} >= 0"), format!("1 + {x} >= 0")]),
                Some(("arctan", _)) => {}
                other => panic!("{other:?}"),
            },
            "even" | "odd" => premises.push(format!("Nat.{kind} {of} = true")),
            "integer" => premises.push(format!("integer {of}")),
            _ => {
                let natural = row.letters.iter().find(|letter| {
                    is_natural(letter)
                        && (guard.ends_with(&format!("= {letter}")) || guard.ends_with(&format!("= -{letter}")))
                });
                premises.push(match natural {
                    Some(letter) => guard
                        .replace(&format!("-{letter}"), &format!("- INR {letter}"))
                        .replace(&format!("= {letter}"), &format!("= INR {letter}")),
                    None => term(guard),
                });
            }
        }
    }
    let letters = row
        .letters
        .iter()
        .map(|letter| format!("({letter} : {})", if is_natural(letter) { "nat" } else { "R" }));
    let letters = letters.collect::<Vec<_>>().join(" ");
    let quantified = if letters.is_empty() {
        String::new()
    } else {
        format!("forall {letters}, ")
    };
    let premises = premises
        .iter()
        .map(|premise| format!("{premise} -> "))
        .collect::<String>();
    format!("{quantified}{premises}{}", term(row.conclusion))
}

/// A formula of the table in Rocq's words.
fn term(text: &str) -> String {
    let words = [
        ("!=", "<>"),
        ("arc", "a"),
        ("pi", "PI"),
        ("power(", "rpow2 ("),
        ("root(", "root2 ("),
    ];
    words
        .iter()
        .fold(text.to_owned(), |text, (ours, theirs)| text.replace(ours, theirs))
}

#[test]
fn each_axiom_of_the_kernel_is_a_lemma() {
    let Some(folder) = library() else { return };
    let rows: Vec<&AxiomRow> = AxiomRow::all()
        .iter()
        .filter(|row| !row.guards.contains(&"complex"))
        .collect();
    let head = "Notation \"'rpow2' ( x , y )\" := (rpow x y).\nNotation \"'root2' ( n , x )\" := (root n x).\n";
    let text = |row: &&AxiomRow| format!("{head}Theorem holds : {}.\nexact {}.\nQed.\n", stated(row), row.name);
    let texts: Vec<String> = rows.iter().map(text).collect();
    for (row, fault) in rows.iter().zip(checked(folder, &texts, &["holds"])) {
        assert_eq!(fault, None, "{}: {}", row.name, stated(row));
    }
    // the complex ones have their lemmas too
    let complex = AxiomRow::all().iter().filter(|row| !row.guards.contains(&"reals"));
    let names: Vec<&str> = complex.map(|row| row.name).collect();
    let text = |name: &&str| format!("Theorem holds : True.\npose proof C_{name}. exact I.\nQed.\n");
    let texts: Vec<String> = names.iter().map(text).collect();
    for (name, fault) in names.iter().zip(checked(folder, &texts, &["holds"])) {
        assert_eq!(fault, None, "{name}");
    }
}

#[test]
fn most_of_the_handbook_is_accepted() {
    let sheets = handbook::sheets(|id| sample::takes(id, 8));
    let Some(table) = table(&sheets) else { return };
    // matrices and vectors, of which the sample holds many, are goals by entries
    let [[proved, printed], [refuted, _]] = ["proved", "refuted"].map(|kind| table.shares(kind));
    assert!(
        proved >= 0.9 && printed >= 0.35 && refuted >= 0.7,
        "{proved} {printed} {refuted}"
    );
}

#[test]
fn most_of_the_attacks_are_accepted() {
    let attacks = attacks::all()
        .into_iter()
        .filter(|attack| sample::takes(&attack.path(), 16));
    let read = |attack: attacks::Attack| Some((attack.class.clone(), attack.path(), attack.read().ok()?));
    let sheets: Vec<Own> = attacks.filter_map(read).collect();
    let Some(table) = table(&sheets) else { return };
    let [[proved, printed], [refuted, _]] = ["proved", "refuted"].map(|kind| table.shares(kind));
    assert!(
        proved >= 0.9 && printed >= 0.8 && refuted >= 0.7,
        "{proved} {printed} {refuted}"
    );
}

#[test]
fn most_of_the_textbooks_are_accepted() {
    let texts = [
        ("integrals", include_str!("../textbook/integrals.toml")),
        ("limits", include_str!("../textbook/limits.toml")),
        ("sums", include_str!("../textbook/sums.toml")),
    ];
    let sheet = |(name, text): (&str, &str)| {
        let sheet = Sheet::read(text, &Symbols::default()).unwrap();
        (name.to_owned(), name.to_owned(), sheet)
    };
    let Some(table) = table_of(&texts.map(sheet), &|label| sample::takes(label, 12)) else {
        return;
    };
    // what goes to infinity, a third of it, is goals by itself
    let [[proved, printed], [refuted, refuted_printed]] = ["proved", "refuted"].map(|kind| table.shares(kind));
    assert!(
        proved >= 0.7 && printed >= 0.15 && refuted >= 0.8 && refuted_printed >= 0.05,
        "{proved} {printed} {refuted} {refuted_printed}"
    );
}

#[test]
fn the_equations_of_the_paper_are_theorems() {
    let sheet = Sheet::read(EQUATIONS, &vocabulary().unwrap()).unwrap();
    let Some(table) = table(&[("paper".to_owned(), "paper".to_owned(), sheet)]) else {
        return;
    };
    assert_eq!(table.refused, Vec::<String>::new());
    // all but (19), which is complex
    let Count { decided, accepted, .. } = &table.groups[&("paper".to_owned(), "proved")];
    assert_eq!(decided - accepted, 1);
}

#[test]
fn a_changed_theorem_is_refused() {
    let Some(folder) = library() else { return };
    let sheets = handbook::sheets(|id| sample::takes(id, 2));
    let (mut texts, mut whole) = (Vec::new(), Vec::new());
    for (_, _, sheet) in &sheets {
        let Some(position) = sheet.find("c") else { continue };
        for one in decided(sheet, position, &Options::default()).iter().take(1) {
            let Ok(text) = rocq::file(one) else { continue };
            let Some((before, claim)) = text.split_once("  (* claim: ") else {
                continue;
            };
            let Some((comment, rest)) = claim.split_once("*)\n  ") else {
                continue;
            };
            // the claim with 1 more on its right side, or that a side is more by 1
            let Some((claim, proof)) = rest.split_once(".\nProof.") else {
                continue;
            };
            if !text.contains("Theorem holds") || !claim.contains(" = ") {
                continue;
            }
            texts.push(format!(
                "{before}  (* claim: {comment}*)\n  {claim} + 1.\nProof.{proof}"
            ));
            whole.push(text.clone());
        }
    }
    assert!(texts.len() >= 50, "{}", texts.len());
    for (text, fault) in texts.iter().zip(checked(folder, &texts, &["holds"])) {
        assert!(fault.is_some(), "{text}");
    }
    assert!(checked(folder, &whole, &["holds"]).iter().all(Option::is_none));
}
