//! Sheets made to attack the verdicts, from many fields. The truth of each stands in its first lines and was
//! established by other means (`tests/attacks/verify.py`): no verdict may be wrong, and few undecided.

use crate::common::attacks::{self, Decided};

use std::collections::BTreeMap;
use vibro_audit::claim::{Sheet, Verdict, vocabulary};
use vibro_audit::prove::{Options, decide};

#[test]
fn no_verdict_is_wrong_and_few_are_undecided() {
    let all = attacks::all().len();
    assert!(all >= 800 && attacks::decided().len() >= all / 6, "{all}");
    let mut wrong = Vec::new();
    // by class: claims, undecided
    let mut classes: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for Decided {
        attack,
        sheet,
        decisions,
    } in attacks::decided()
    {
        let shown = attack.path();
        if let Err(fault) = sheet
            && attack.truth("", true).as_deref() != Some("unread")
        {
            wrong.push(format!("{shown}: {fault}"));
        }
        let last = decisions.last().map(|(position, ..)| *position);
        for (position, decision, taken) in decisions {
            let label = &decision.label;
            let Some(truth) = attack.truth(label, last == Some(*position)) else {
                continue;
            };
            let class = classes.entry(&attack.class).or_default();
            class.0 += 1;
            let right = match (truth.as_str(), decision.verdict) {
                ("true", Verdict::Proved) | ("false", Verdict::Refuted) | ("unread", Verdict::Unread) => true,
                (_, Verdict::Undecided) if decision.reason.contains("broke down") => false,
                ("contradictory" | "ambiguous" | "unread", Verdict::Undecided) => true,
                ("true" | "false", Verdict::Undecided) => {
                    class.1 += 1;
                    println!("undecided ({truth}): {shown} ({label}) {taken:?}: {}", decision.reason);
                    // of a sheet that says so, each verdict is to be found
                    !attack.text.contains("# decided")
                }
                _ => false,
            };
            if taken.as_secs_f64() > 1.0 {
                println!("slow: {shown} {taken:?}");
            }
            if !right {
                let verdict = decision.verdict;
                wrong.push(format!(
                    "{shown} ({label}): {truth}, but {verdict}: {}",
                    decision.reason
                ));
            }
        }
    }
    let (claims, undecided) = classes
        .values()
        .fold((0, 0), |sum, class| (sum.0 + class.0, sum.1 + class.1));
    for (class, (claims, undecided)) in &classes {
        println!("{class}: {undecided} of {claims} undecided");
    }
    println!("in all {undecided} of {claims} undecided");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

fn sheet_of(symbols: &[String], equations: &[(&str, String)]) -> Sheet {
    let symbols: Vec<String> = symbols.iter().map(|name| format!("'{name}'")).collect();
    let mut text = format!("[symbols]\nparameters = [{}]\n", symbols.join(", "));
    let premises = equations.iter().filter(|(role, _)| *role == "premise").count();
    let follows: Vec<String> = (0..premises).map(|number| format!("'e{number}'")).collect();
    for (number, (role, tex)) in equations.iter().enumerate() {
        text += &format!("[[equation]]\nlabel = 'e{number}'\nrole = '{role}'\ntex = '''{tex}'''\n");
        if *role == "claim" {
            text += &format!("follows_from = [{}]\n", follows.join(", "));
        }
    }
    Sheet::read(&text, &vocabulary().unwrap()).unwrap()
}

#[test]
fn hostile_sheets_end_within_the_effort() {
    let numbered = |count: usize| -> Vec<String> { (0..=count).map(|number| format!("x_{{{number}}}")).collect() };
    let letters = ["x".to_string(), "y".to_string()];
    let mut sheets = Vec::new();

    let fractions: Vec<String> = (0..200)
        .map(|n| format!(r"\frac{{1}}{{x_{{{n}}}+{}}}", n + 1))
        .collect();
    let sum = fractions.join(" + ");
    let mut symbols = numbered(200);
    symbols.extend(letters.clone());
    let denominators = [
        ("premise", format!("y = {sum}")),
        ("claim", "y = x".into()),
        ("claim", format!("x_0 y = x_0 ({sum})")),
    ];
    sheets.push(("200 denominators", sheet_of(&symbols, &denominators)));

    let nested = (0..60).fold("x".to_string(), |inner, _| format!(r"\sin({inner} + x)"));
    let sines = [
        ("claim", format!("{nested} = y")),
        (
            "claim",
            format!("{nested} = \\cos(\\frac{{\\pi}}{{2}} - {})", &nested[4..]),
        ),
    ];
    sheets.push(("60 sines", sheet_of(&letters, &sines)));

    let mut chain: Vec<(&str, String)> = (0..1000)
        .map(|n| ("premise", format!("x_{{{}}} = x_{{{n}}} + 1", n + 1)))
        .collect();
    chain.push(("claim", "x_{1000} = x_0 + 1000".into()));
    sheets.push(("1000 premises", sheet_of(&numbered(1000), &chain)));

    let mut squares: Vec<(&str, String)> = (0..40)
        .map(|n| ("premise", format!("x_{{{}}} = x_{{{n}}}^2 + x_{{{n}}} + 1", n + 1)))
        .collect();
    squares.push(("claim", "x_{40} = x_0".into()));
    sheets.push(("40 squares", sheet_of(&numbered(40), &squares)));

    let powers = [
        "x^{9^{9^9}} = y",
        "2^{9^{9^9}} = y",
        "(x + y)^{1000} = x^{1000} + y^{1000}",
        r"\cos(2^{100} x) = 1",
        "e^{10^{10}} = y",
        r"\sqrt[1000]{x} = y",
    ];
    sheets.push((
        "powers",
        sheet_of(&letters, &powers.map(|tex| ("claim", tex.to_string()))),
    ));

    let many: Vec<(&str, String)> = (0..5000).map(|n| ("claim", format!("x + {n} y = {n} y + x"))).collect();
    sheets.push(("5000 claims", sheet_of(&letters, &many)));

    for (name, sheet) in sheets {
        let start = std::time::Instant::now();
        for position in (0..sheet.entries.len()).filter(|&n| sheet.is_claim(n)) {
            let decision = decide(&sheet, position, &Options::default());
            assert!(!decision.reason.contains("broke down"), "{name}: {}", decision.label);
        }
        let taken = start.elapsed().as_secs_f64();
        println!("{name}: {taken:.1} s");
        // no limit of the search lets a claim run for longer, but ten times as long is a machine under load
        assert!(taken < 60.0, "{name}: {taken} s");
    }
    // the kernel's monomials are counted, and so bound its memory
    if let Ok(status) = std::fs::read_to_string("/proc/self/status") {
        let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
        let kilobytes: u64 = most.trim().trim_end_matches("kB").trim().parse().unwrap();
        assert!(kilobytes < 1_500_000, "{most}");
    }
}
