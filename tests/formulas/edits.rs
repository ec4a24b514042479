//! Every single edit of every true formula of the paper, decided with the paper's own premises: the verdict is that of
//! a judge who shares no code with the decision.

use crate::common::judge;
use crate::common::mutants;
use crate::common::paper;
use crate::common::sample;

use paper::{Bench, Claim, display};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use vibro_audit::claim::Verdict;
use vibro_audit::tex::Equation;

/// A formula to be decided, and what the judge says of it.
struct Case {
    label: &'static str,
    tex: String,
    local: Vec<String>,
    right: bool,
}

fn case(bench: &Bench, claim: &Claim, equations: &[Equation], local: &[String]) -> Case {
    let locals: Vec<Equation> = local.iter().flat_map(|tex| bench.read(tex)).collect();
    Case {
        label: claim.label,
        tex: display(equations),
        local: local.to_vec(),
        right: judge::follows(claim.premises, equations, &locals),
    }
}

fn cases(bench: &Bench, claim: &Claim) -> Vec<Case> {
    let equations = bench.read(&claim.tex);
    let mut cases = vec![case(bench, claim, &equations, &claim.local)];
    assert!(cases[0].right, "the judge does not accept ({})", claim.label);
    for (n, equation) in equations.iter().enumerate() {
        // (19) gives a symbol of its own and a pair of eigenvalues: names, not formulas.
        for edited in mutants::edited(equation, claim.label != "19") {
            let mut whole = equations.clone();
            whole[n] = edited;
            // One equation of several is decided alone where it can be: the others are true.
            let decided = if claim.label == "19" { &whole[..] } else { &whole[n..=n] };
            cases.push(case(bench, claim, decided, &claim.local));
        }
    }
    for (n, tex) in claim.local.iter().enumerate() {
        for edited in mutants::edited(&bench.read(tex)[0], false) {
            // What is defined by itself is no formula but an error.
            if edited.right.to_string().contains(&edited.left.to_string()) {
                continue;
            }
            let mut local = claim.local.clone();
            local[n] = edited.to_string();
            cases.push(case(bench, claim, &equations, &local));
        }
    }
    cases
}

/// Slips of the pen: what stands in the TeX, and what is written for it.
const SLIPS: &[(&str, &str)] = &[
    ("k+1", "k"),
    ("k+1", "k+2"),
    ("k+2", "k+1"),
    ("_k", "_{k+1}"),
    ("{k}", "{k+1}"),
    ("r_B", "r_T"),
    ("r_T", "r_B"),
    ("T_1", "T_2"),
    ("T_2", "T_1"),
    ("F_1", "F_2"),
    ("F_2", "F_1"),
    ("F_1", "f"),
    ("f(", "F_1("),
    (" + ", " - "),
    (" - ", " + "),
    ("= -", "= "),
    ("{2}", "{3}"),
    ("^2", "^3"),
    (r"\overline{g}", "d"),
    (r"\overline{g}", r"\overline{g}^2"),
    (r"\dot{Z}_k", r"\dot{Z}_{k+1}"),
    ("Det", "Tr"),
    ("Tr(", "Det("),
    (r"\pm", "+"),
    (r"\pm", r"\mp"),
];

/// The claim with one slip of the pen; at most one equation differs.
fn slips(bench: &Bench, claim: &Claim) -> Vec<Case> {
    let equations = bench.read(&claim.tex);
    let mut cases = Vec::new();
    for (from, to) in SLIPS {
        for (at, _) in claim.tex.match_indices(from) {
            // A subscript is no number.
            if *from == "{2}" && claim.tex[..at].ends_with('_') {
                continue;
            }
            let tex = format!("{}{to}{}", &claim.tex[..at], &claim.tex[at + from.len()..]);
            let Ok(edited) = vibro_audit::tex::read(&tex, &bench.symbols.names) else {
                continue;
            };
            let n = edited
                .iter()
                .zip(&equations)
                .position(|(edited, equation)| edited != equation);
            let Some(n) = n.filter(|_| edited.len() == equations.len()) else {
                continue;
            };
            // A derivative by a quantity that is no earlier belongs to no map.
            let backward = mutants::is_backward(&edited[n].left) || mutants::is_backward(&edited[n].right);
            if backward || (claim.label == "19" && !tex.starts_with(r"\lambda_{1,2} =")) {
                continue;
            }
            let decided = if claim.label == "19" {
                &edited[..]
            } else {
                &edited[n..=n]
            };
            cases.push(Case {
                tex: if claim.label == "19" { tex } else { display(decided) },
                ..case(bench, claim, decided, &claim.local)
            });
        }
    }
    cases
}

#[test]
fn every_single_edit_of_the_paper_is_decided_rightly() {
    let bench = Bench::new();
    let mut cases: Vec<Case> = bench.claims().iter().flat_map(|claim| cases(&bench, claim)).collect();
    cases.extend(
        bench
            .claims()
            .iter()
            .filter(|claim| claim.label != "22")
            .flat_map(|claim| slips(&bench, claim)),
    );
    let (next, wrong, undecided) = (AtomicUsize::new(0), Mutex::new(Vec::new()), AtomicUsize::new(0));
    let decide = || {
        while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
            if !sample::takes(&format!("{} {} {:?}", case.label, case.tex, case.local), 24) {
                continue;
            }
            let decision = bench.decide(&bench.sheet(case.label, &case.tex, &case.local));
            let wanted = if case.right { Verdict::Proved } else { Verdict::Refuted };
            let complaint = match decision {
                Ok(decision) if decision.verdict == wanted => continue,
                // one form of (22), with F_1(t_{k+2}) in epsilon_1, takes too long to multiply out
                Ok(decision)
                    if decision.verdict == Verdict::Undecided && undecided.fetch_add(1, Ordering::Relaxed) < 1 =>
                {
                    continue;
                }
                Ok(decision) => format!("{}: {}", decision.verdict, decision.reason),
                Err(fault) => format!("error: {fault}"),
            };
            let Case { label, tex, local, .. } = case;
            wrong.lock().unwrap().push(format!(
                "({label}) {tex}\n  where {local:?}\n  {wanted} wanted, {complaint}"
            ));
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(decide);
        }
    });
    let wrong = wrong.into_inner().unwrap();
    let right = cases.iter().filter(|case| case.right).count();
    println!(
        "{} formulas, {right} of them right, {} decided wrongly",
        cases.len(),
        wrong.len()
    );
    assert!(
        wrong.is_empty(),
        "{} of {} wrong:\n{}",
        wrong.len(),
        cases.len(),
        wrong.join("\n")
    );
    assert!(cases.len() >= 1500, "only {} formulas", cases.len());
    assert!(
        right >= 30 && cases.len() - right >= 1400,
        "{right} right of {}",
        cases.len()
    );
}
