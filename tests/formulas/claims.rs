//! Claims on the impact pair in many spellings, with premises of many kinds: `claims.txt` says what is right.

use crate::common::{paper, sample};

use paper::{Bench, sheet};

#[test]
fn claims_in_many_forms() {
    let bench = Bench::new();
    let (mut premises, mut local, mut with): (Vec<String>, Vec<String>, Vec<String>) = Default::default();
    let (mut count, mut wrong) = (0, Vec::new());
    for (number, line) in include_str!("../claims.txt").lines().enumerate() {
        let (kind, rest) = line.trim().split_once(' ').unwrap_or((line.trim(), ""));
        let append = |list: &mut Vec<String>| match rest {
            "" => list.clear(),
            tex => list.push(tex.to_string()),
        };
        match kind {
            "" | "#" => {}
            "R" => {
                premises.clear();
                local.clear();
                with.clear();
            }
            "P" => premises.extend(rest.split(" ;; ").map(|tex| match bench.paper.find(tex) {
                Some(_) => bench.printed(tex).0,
                None => tex.to_string(),
            })),
            "W" => append(&mut local),
            "S" => append(&mut with),
            "C" => {
                let (wanted, tex) = rest.split_once(' ').expect("a verdict and a claim");
                if !sample::takes(&format!("{premises:?} {local:?} {with:?} {rest}"), 4) {
                    continue;
                }
                let labelled: Vec<(String, String)> = premises
                    .iter()
                    .enumerate()
                    .map(|(n, tex)| (format!("p{n}"), tex.clone()))
                    .collect();
                let found = match bench.decide(&sheet(&labelled, tex, &local, &with)) {
                    Ok(decision) => (decision.verdict.to_string(), decision.reason),
                    Err(fault) => (fault.to_string(), String::new()),
                };
                count += 1;
                let (verdict, reason) = found;
                if verdict != wanted {
                    wrong.push(format!(
                        "line {}: {wanted} wanted of {tex}: {verdict}: {reason}",
                        number + 1
                    ));
                }
            }
            other => panic!("line {}: {other}", number + 1),
        }
    }
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(count >= sample::of(200, 40), "{count}");
}

/// What follows from a refuted claim is decided with that claim taken as given, and the reason says so.
#[test]
fn a_claim_that_rests_on_a_refuted_one() {
    let entry = |label: &str, role: &str, tex: &str, more: &str| {
        format!("[[equation]]\nlabel = \"{label}\"\nrole = \"{role}\"\ntex = '''{tex}'''\n{more}\n")
    };
    let text = entry("1", "premise", "T = T_1 + T_2", "")
        + &entry("3", "claim", "T = 3 T_1", "follows_from = [\"2\"]")
        + &entry(
            "2",
            "claim",
            "T = 2 T_1, T_1 = T_2 + d",
            "follows_from = [\"1\"]\nexpect = \"refuted\"",
        )
        + &entry("4", "claim", "T_2 = T_1 - d", "follows_from = [\"2\"]");
    let bench = Bench::new();
    let sheet = vibro_audit::claim::Sheet::read(&text, &bench.symbols).unwrap();
    let decisions = vibro_audit::prove::audit(&sheet, &vibro_audit::prove::Options::default());
    let shown: Vec<(String, String)> = decisions
        .iter()
        .map(|decision| (decision.label.clone(), decision.verdict.to_string()))
        .collect();
    let wanted = [("3", "refuted"), ("2", "refuted"), ("4", "proved")];
    assert_eq!(
        shown,
        wanted.map(|(label, verdict)| (label.to_string(), verdict.to_string()))
    );
    assert!(
        decisions[0].reason.contains("(2)") && decisions[2].reason.contains("refuted: (2)"),
        "{decisions:?}"
    );
}
