//! Three documents laid out as journals do, and thirty misprints in them (`tests/papers`), both made by somebody who knew of
//! this program only what the README and doc/reference/verdicts.md say: no true formula is accused, and each misprint that is found is.

use crate::common::sample;
use std::collections::BTreeSet;
use vibro_audit::claim::{Document, Markup, Verdict};
use vibro_audit::prove::{self, Decision, Options};
use vibro_audit::tex::Symbols;

/// Name, as it is right, with ten misprints.
const PAPERS: [[&str; 3]; 3] = [
    [
        "bouncing_ball.tex",
        include_str!("../papers/bouncing_ball.tex"),
        include_str!("../papers/misprinted/bouncing_ball.tex"),
    ],
    [
        "impact_oscillator.tex",
        include_str!("../papers/impact_oscillator.tex"),
        include_str!("../papers/misprinted/impact_oscillator.tex"),
    ],
    [
        "rigid_body_optics.tex",
        include_str!("../papers/rigid_body_optics.tex"),
        include_str!("../papers/misprinted/rigid_body_optics.tex"),
    ],
];

/// Misprints that are found and formulas that are proved, at least, of all documents and of the first; the other misprints
/// stand in formulas that are undecided or not read.
const LEAST: [[usize; 2]; 2] = [[28, 157], [8, 46]];

fn decisions(text: &str) -> Vec<Decision> {
    let document = Document::read(text, Markup::Tex, &mut |_| Err("nothing is included".to_owned()));
    let sheet = document.sheet(&Symbols::default()).unwrap();
    prove::audit(&sheet, &Options::default())
}

fn refuted(decisions: &[Decision]) -> BTreeSet<String> {
    let refuted = decisions.iter().filter(|decision| decision.verdict == Verdict::Refuted);
    refuted.map(|decision| decision.label.clone()).collect()
}

#[test]
fn no_formula_of_three_papers_is_accused_but_for_its_misprint() {
    let mut misprints = csv::Reader::from_reader(include_str!("../papers/misprints.csv").as_bytes());
    let misprints: Vec<csv::StringRecord> = misprints.records().map(Result::unwrap).collect();
    let (mut found, mut proved) = (0, 0);
    let papers = sample::of(3, 1);
    for [name, text, altered] in &PAPERS[..papers] {
        let correct = decisions(text);
        assert_eq!(refuted(&correct), BTreeSet::new(), "{name} is right");
        proved += correct
            .iter()
            .filter(|decision| decision.verdict == Verdict::Proved)
            .count();
        let own: Vec<_> = misprints.iter().filter(|misprint| misprint[0] == **name).collect();
        assert_eq!(own.len(), 10);
        let accused = refuted(&decisions(altered));
        for label in &accused {
            let number = label.split('.').next().unwrap();
            assert!(
                own.iter().any(|misprint| &misprint[2] == number),
                "{name}: ({label}) is right"
            );
        }
        found += accused.len();
    }
    let [least_found, least_proved] = sample::of(LEAST[0], LEAST[1]);
    println!("{found} misprints found, {proved} formulas proved");
    assert!(
        found >= least_found && proved >= least_proved,
        "{found} misprints, {proved} proved"
    );
}
