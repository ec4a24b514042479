//! Every single edit of every true formula of the paper, decided with the paper's own premises: the verdict is that of
//! a judge who shares no code with the decision.

#[path = "common/judge.rs"]
mod judge;
#[path = "common/mutants.rs"]
mod mutants;
#[path = "common/paper.rs"]
mod paper;

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

#[test]
fn every_single_edit_of_the_paper_is_decided_rightly() {
    let bench = Bench::new();
    let cases: Vec<Case> = bench.claims().iter().flat_map(|claim| cases(&bench, claim)).collect();
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let times = Mutex::new(Vec::new());
    let decide = || {
        while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
            let start = std::time::Instant::now();
            let decision = bench.decide(&bench.sheet(case.label, &case.tex, &case.local));
            times.lock().unwrap().push((case.label, start.elapsed(), case.right, case.tex.clone()));
            let wanted = if case.right { Verdict::Proved } else { Verdict::Refuted };
            let complaint = match decision {
                Ok(decision) if decision.verdict == wanted => continue,
                Ok(decision) => format!("{}: {}", decision.verdict, decision.reason),
                Err(fault) => format!("error: {fault}"),
            };
            let Case { label, tex, local, .. } = case;
            wrong.lock().unwrap().push(format!("({label}) {tex}\n  where {local:?}\n  {wanted} wanted, {complaint}"));
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(decide);
        }
    });
    let mut times = times.into_inner().unwrap();
    times.sort_by_key(|t| std::cmp::Reverse(t.1));
    for (l, t, r, x) in times.iter().take(30) { println!("{l} {t:?} {r} {x}"); }
    let mut by: std::collections::BTreeMap<&str, (usize, f64)> = Default::default();
    for (l, t, ..) in &times { let e = by.entry(l).or_default(); e.0 += 1; e.1 += t.as_secs_f64(); }
    println!("{by:?}");
    let wrong = wrong.into_inner().unwrap();
    let right = cases.iter().filter(|case| case.right).count();
    println!("{} formulas, {right} of them right, {} decided wrongly", cases.len(), wrong.len());
    assert!(wrong.is_empty(), "{} of {} wrong:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
    assert!(cases.len() >= 1500, "only {} formulas", cases.len());
    assert!(right >= 30 && cases.len() - right >= 1400, "{right} right of {}", cases.len());
}
