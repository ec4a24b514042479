//! Limits and orders, convergence: `limits.txt` and `convergence.txt` say which claims are true, and which of them are decided.

use vibro_audit::claim::{Sheet, Verdict};
use vibro_audit::prove::{Options, decide};
use vibro_audit::tex::Symbols;

#[test]
fn limits_and_orders_are_decided_rightly() {
    decided_rightly(include_str!("../limits.txt"), 200);
}

#[test]
fn sums_and_integrals_to_infinity_are_bounded_and_diverge_rightly() {
    decided_rightly(include_str!("../convergence.txt"), 70);
}

/// Checks the verdicts of a list of claims, of which there must be so many.
fn decided_rightly(list: &str, least: usize) {
    let (mut count, mut wrong) = (0, Vec::new());
    for line in list.lines() {
        let Some((kind, claim)) = line.split_once(':').filter(|_| !line.starts_with('#')) else {
            continue;
        };
        let mut parts = claim.split("; assume ").map(str::trim);
        let tex = parts.next().unwrap();
        let assume: Vec<String> = parts.map(|condition| format!("'''{condition}'''")).collect();
        let assume = format!("assume = [{}]", assume.join(", "));
        let sheet = format!(
            "[symbols]\nparameters = ['x', 'u', 'a', 'b', 'p', 'q']\npositive = ['p']\nintegers = ['m', 'n']\n\
             [[equation]]\nlabel = 'c'\nrole = 'claim'\ntex = '''{tex}'''\n{assume}"
        );
        let sheet = Sheet::read(&sheet, &Symbols::default()).unwrap_or_else(|fault| panic!("{tex}: {fault}"));
        let decision = decide(&sheet, 0, &Options::default());
        let wanted = match kind {
            "true" => Verdict::Proved,
            "false" => Verdict::Refuted,
            "open true" | "open false" => Verdict::Undecided,
            kind => panic!("{kind}"),
        };
        count += 1;
        if decision.verdict != wanted {
            wrong.push(format!("{line}: {}: {}", decision.verdict, decision.reason));
        }
    }
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(count >= least, "{count}");
}
