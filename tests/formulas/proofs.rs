//! Proofs and counterexamples checked by Python, by a checker that shares no line with the kernel.

use crate::common::program::{Scratch, program, scratch};
use crate::common::sample;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use vibro_audit::claim::{Document, EQUATIONS, Markup, Sheet, vocabulary};
use vibro_audit::kernel::{Certificate, Inference, Polynomial, With, follows};
use vibro_audit::number::{Field, Rational, Sequence};
use vibro_audit::prove::{
    CHECKER, Found, LONGEST, NoScript, Options, SCHEMA, decided, file_names, proof_data, short_scripts,
};

/// The Python that has a package: that of $VIBRO_PYTHON, or the first in the path; none, and a word, without it.
fn python(package: &str) -> Option<String> {
    let python = std::env::var("VIBRO_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let has = Command::new(&python)
        .args(["-c", &format!("import {package}")])
        .output();
    if !has.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: {python} has no {package} here");
        return None;
    }
    Some(python)
}

fn paper() -> Sheet {
    Sheet::read(EQUATIONS, &vocabulary().unwrap()).unwrap()
}

/// Claims of some fields, true and false, that want different kinds of steps.
const SHEET: &str = r#"
[symbols]
parameters = ['x', 'y', 'a', 'b', 's']
positive = ['a']
functions = { g = '', f = 'g' }
times = ['t', 't_k']
relations = ['s^2 = 2']

[[equation]]
label = "angles"
role = "claim"
tex = '\sin(3 x) = 3 \sin(x) - 4 \sin(x)^3'

[[equation]]
label = "turns"
role = "claim"
tex = '\cos(\pi/5) = \frac{1 + \sqrt{5}}{4}'

[[equation]]
label = "exponentials"
role = "claim"
tex = '\cosh(x)^2 - \sinh(x)^2 = 1'

[[equation]]
label = "roots"
role = "claim"
tex = '\sqrt{a^2} = a'

[[equation]]
label = "false roots"
role = "claim"
tex = '\sqrt{x^2} = x'

[[equation]]
label = "law"
role = "premise"
tex = 'f(t) = x t + y'

[[equation]]
label = "slope"
role = "claim"
tex = 'g(a) = x'
follows_from = ["law"]

[[equation]]
label = "free"
role = "claim"
tex = 'f(x + 1) = f(x)'

[[equation]]
label = "relation"
role = "claim"
tex = '\frac{1}{s} = \frac{s}{2}'

[[equation]]
label = "product"
role = "premise"
tex = 'x (a y - b) = 0'

[[equation]]
label = "divided"
role = "claim"
tex = 'y = \frac{b}{a}'
follows_from = ["product"]
"#;

fn own() -> Sheet {
    Sheet::read(SHEET, &vocabulary().unwrap()).unwrap()
}

/// Runs a text as a script: whether it accepts, and what it says.
fn accepts(python: &str, path: &Path, script: &[u8]) -> (bool, String) {
    std::fs::write(path, script).unwrap();
    let output = Command::new(python).arg(path).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    (output.status.success(), said)
}

#[test]
fn files_of_different_claims_have_different_names_whatever_the_labels() {
    let labels = [
        "a b",
        "a_b",
        "A:b",
        "random",
        ".a",
        "",
        &"x".repeat(300),
        &format!("{}y", "x".repeat(299)),
        "a-2",
    ];
    let of = |label: &&str| format!("[[equation]]\nlabel = '{label}'\nrole = 'claim'\ntex = '1 = 1'\n");
    let sheet = Sheet::read(&labels.iter().map(of).collect::<String>(), &vocabulary().unwrap());
    let Ok(sheet) = sheet else {
        // an empty label may be refused
        let labels = labels.iter().filter(|label| !label.is_empty());
        let sheet = Sheet::read(&labels.map(of).collect::<String>(), &vocabulary().unwrap()).unwrap();
        return differ(&sheet);
    };
    differ(&sheet);
}

fn differ(sheet: &Sheet) {
    let names = file_names(sheet, &sheet.rows());
    let lower: std::collections::BTreeSet<String> = names.iter().map(|name| name.to_lowercase()).collect();
    assert_eq!(lower.len(), names.len(), "{names:?}");
    assert!(
        names.iter().all(|name| name.len() < 250 && !name.starts_with('.')),
        "{names:?}"
    );
    // what tells several files of one claim apart stands in no name
    let ends_in_number = |name: &String| name.rsplit_once('-').is_some_and(|(_, end)| end.parse::<u32>().is_ok());
    assert!(!names.iter().any(ends_in_number), "{names:?}");
}

#[test]
fn proof_data_say_the_claim_as_read_its_reductions_and_the_goal() {
    let text = "[symbols]\nparameters = ['x']\n[[equation]]\nlabel = 'area'\nrole = 'claim'\ntex = '\\int_0^x s^2 ds = \\frac{x^3}{3}'\n";
    let sheet = Sheet::read(text, &vocabulary().unwrap()).unwrap();
    let all = all_data(&sheet);
    assert!(!all.is_empty());
    for (_, text) in all {
        let data: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(data["claim"], r"\int_0^x s^2 ds = \frac{x^3}{3}");
        assert_eq!(data["reductions"][0], "integral: antiderivative");
        assert!(data["goal"].as_str().is_some_and(|goal| !goal.is_empty()), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn an_export_that_is_killed_leaves_no_directory_and_no_file_that_is_cut() {
    let scratch = scratch("killed");
    scratch.file("sheet.toml", SHEET);
    for trial in 0..10_u64 {
        let export = program(["audit", "sheet.toml", "--proof", "proofs"]);
        let mut child = export.within(&*scratch).spawn();
        std::thread::sleep(std::time::Duration::from_millis(5 + 37 * trial));
        let _ = child.kill();
        child.wait().unwrap();
        for entry in std::fs::read_dir(&*scratch).unwrap() {
            let place = entry.unwrap().path();
            for file in std::fs::read_dir(&place).into_iter().flatten() {
                let file = file.unwrap().path();
                // what is not whole yet has another ending
                if file.extension().is_some_and(|extension| extension == "json") {
                    let text = std::fs::read_to_string(&file).unwrap();
                    assert!(serde_json::from_str::<Value>(&text).is_ok(), "{text}");
                }
            }
            if place.is_dir() {
                std::fs::remove_dir_all(&place).unwrap();
            }
        }
    }
}

/// The short scripts of the claims of a sheet that have some, each with its label.
fn short(sheet: &Sheet) -> Vec<(String, String)> {
    let claims = (0..sheet.entries.len()).filter(|&position| sheet.is_claim(position));
    let scripts = |position: usize| {
        let label = sheet.entries[position].label.clone();
        let scripts = short_scripts(sheet, position, &Options::default()).unwrap_or_default();
        scripts.into_iter().map(move |script| (label.clone(), script))
    };
    claims.flat_map(scripts).collect()
}

#[test]
fn short_scripts_can_be_read_and_their_asserts_hold() {
    let (own, paper) = (short(&own()), short(&paper()));
    let labels = |of: &[(String, String)]| -> BTreeSet<String> { of.iter().map(|(label, _)| label.clone()).collect() };
    assert!(labels(&own).len() >= 6, "{:?}", labels(&own));
    let expected = ["impact-law", "9", "10", "11", "12", "14", "15", "16", "19", "20", "21"];
    assert_eq!(labels(&paper), expected.map(str::to_owned).into_iter().collect());
    for (label, script) in own.iter().chain(&paper) {
        let lines: Vec<&str> = script.lines().collect();
        assert!(lines.len() <= LONGEST, "({label}): {script}");
        assert!(
            lines.iter().all(|line| line.chars().count() <= 110),
            "({label}): {script}"
        );
        assert!(script.contains("\nassert "), "({label}): {script}");
    }
    let Some(python) = python("sympy") else { return };
    let scratch = scratch("short");
    for (label, script) in own.iter().chain(&paper) {
        let (accepted, said) = accepts(&python, &scratch.join("short.py"), script.as_bytes());
        assert!(
            accepted && said.trim_end() == "every assert holds",
            "({label}): {said}\n{script}"
        );
    }
}

#[test]
fn a_short_script_with_a_wrong_sign_fails() {
    let Some(python) = python("sympy") else { return };
    let scratch = scratch("wrong");
    let (own, paper) = (short(&own()), short(&paper()));
    let breaks = [
        (
            &paper,
            "9",
            "claim = Zdot_k1 - (-r_B*Zdot_k +",
            "claim = Zdot_k1 - (r_B*Zdot_k +",
        ),
        (
            &paper,
            "20",
            "claim = dt_k1_by_dt_k - (r_B*Zdot_k -",
            "claim = dt_k1_by_dt_k - (r_B*Zdot_k +",
        ),
        (&paper, "16", "Zdot_k = Integer(4)", "Zdot_k = Integer(-4)"),
        (
            &own,
            "angles",
            "claim = sin(3*x) - (3*sin(x) -",
            "claim = sin(3*x) - (3*sin(x) +",
        ),
    ];
    for (scripts, label, right, wrong) in breaks {
        let (_, script) = scripts.iter().find(|(own, _)| own == label).unwrap();
        let broken = script.replace(right, wrong);
        assert_ne!(*script, broken, "({label}): {script}");
        let (accepted, said) = accepts(&python, &scratch.join("wrong.py"), broken.as_bytes());
        assert!(!accepted && said.contains("AssertionError"), "({label}): {said}");
    }
}

#[test]
fn a_claim_without_a_short_script_is_named_with_the_reason() {
    let reason = |sheet: &Sheet, label: &str| {
        let scripts = short_scripts(sheet, sheet.find(label).unwrap(), &Options::default());
        scripts.unwrap_err()
    };
    assert_eq!(reason(&paper(), "3"), NoScript::Laws);
    assert_eq!(reason(&paper(), "22"), NoScript::Maps);
    assert_eq!(reason(&paper(), "23"), NoScript::TooLong);
    let scratch = scratch("told");
    let ran = program(["audit", "--proof", "proofs", "--format", "sympy"])
        .within(&*scratch)
        .run();
    assert!(ran.stdout.starts_with("label "), "{}", ran.stdout);
    let said = [
        "4 of 15 decided claims are not written as short scripts",
        "more than 40 lines: (23)",
        "derivatives along a map: (22)",
    ];
    assert!(said.iter().all(|words| ran.stderr.contains(words)), "{}", ran.stderr);
    let ran = program(["audit", "--format", "sympy"]).within(&*scratch).run();
    assert!(ran.stderr.contains("--proof DIR"), "{}", ran.stderr);
}

/// The checker's lines on files of proof data, one each, and whether it accepts them all.
fn checked(python: &str, scratch: &Scratch, files: &[(String, String)]) -> (bool, Vec<String>) {
    let checker = scratch.file("check.py", CHECKER.as_str());
    let paths = files.iter().map(|(name, text)| scratch.file(name, text));
    let output = Command::new(python).arg(&checker).args(paths).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    (output.status.success(), said.lines().map(str::to_owned).collect())
}

/// The proof data of the claims of a sheet, each with its place there.
fn all_data(sheet: &Sheet) -> Vec<(String, String)> {
    let claims = (0..sheet.entries.len()).filter(|&position| sheet.is_claim(position));
    let data = |position: usize| {
        let texts = proof_data(sheet, position, &Options::default()).into_iter().enumerate();
        texts.map(move |(number, text)| (format!("{position}-{number}.json"), text))
    };
    claims.flat_map(data).collect()
}

/// The word of the checker for files that it leaves out to be short.
const LEFT_OUT: &str = ": left out: ";

#[test]
fn proof_data_is_accepted_by_its_checker() {
    let Some(python) = python("flint") else { return };
    let matrices = include_str!("../papers/matrices.tex");
    let matrices = Document::read(matrices, Markup::Tex, &mut |_| Err(String::new()));
    let matrices = matrices.sheet(&vocabulary().unwrap()).unwrap();
    let named = |of: &str, sheet: &Sheet| -> Vec<(String, String)> {
        let data = all_data(sheet).into_iter();
        data.map(|(name, text)| (format!("{of}{name}"), text)).collect()
    };
    let mut files = named("own", &own());
    files.extend(named("matrices", &matrices));
    files.push(("schema.json".to_owned(), SCHEMA.to_owned()));
    let (all, said) = checked(&python, &scratch("data"), &files);
    assert!(all && said.len() > 15, "{}", said.join("\n"));
    // of the paper, periods of single values and derivatives along maps are left out
    let (all, said) = checked(&python, &scratch("paper"), &named("paper", &paper()));
    let is_known = |line: &&String| line.contains(": accepted: ") || line.contains(LEFT_OUT);
    assert!(!all && said.iter().all(|line| is_known(&line)), "{}", said.join("\n"));
    let left_out = said.iter().filter(|line| line.contains(LEFT_OUT)).count();
    assert!(said.len() >= 20 && left_out <= 12, "{}", said.join("\n"));
}

#[test]
fn a_file_that_is_cut_is_refused() {
    let Some(python) = python("flint") else { return };
    let (_, whole) = all_data(&own()).swap_remove(0);
    let cuts = (0..whole.trim_end().len()).step_by(sample::of(1 + whole.len() / 400, 1 + whole.len() / 40));
    let files: Vec<(String, String)> = cuts
        .map(|cut| (format!("{cut}.json"), whole[..cut].to_owned()))
        .collect();
    let (_, said) = checked(&python, &scratch("cut"), &files);
    assert_eq!(said.len(), files.len());
    assert!(
        said.iter().all(|line| line.contains(": refused: ")),
        "{}",
        said.join("\n")
    );
}

#[test]
fn a_conditional_claim_has_a_proof_and_two_points() {
    let sheet = own();
    let of = decided(&sheet, sheet.find("divided").unwrap(), &Options::default());
    let verdicts: Vec<&str> = (of.iter())
        .map(|one| match one.found {
            Found::Proved { .. } => "proved",
            Found::Refuted { .. } => "refuted",
        })
        .collect();
    assert_eq!(verdicts, ["proved", "refuted", "proved"]);
    let texts = proof_data(&sheet, sheet.find("divided").unwrap(), &Options::default());
    for (text, part) in texts
        .iter()
        .zip([r"where x \\neq 0", "where x = 0", "where x = 0 and it holds"])
    {
        assert!(text.contains(&format!("\"part\": \"{part}\"")), "{part}: {text}");
    }
    assert_eq!(texts.len(), 3);
}

#[test]
fn proof_data_that_is_cut_hostile_or_of_another_version_is_refused_with_its_place() {
    let Some(python) = python("flint") else { return };
    let (_, whole) = all_data(&own())
        .into_iter()
        .find(|(_, text)| text.contains("\"zero\""))
        .unwrap();
    let put = |old: &str, new: &str| {
        assert!(whole.contains(old), "{old}: {whole}");
        whole.replacen(old, new, 1)
    };
    let digits = "9".repeat(10_000);
    let cases = [
        (whole[..whole.len() / 2].to_owned(), "JSONDecodeError"),
        (String::new(), "JSONDecodeError"),
        ("[]".to_owned(), "data"),
        (put("\"version\": 1", "\"version\": 2"), "data.version"),
        (put("\"verdict\": \"proved\"", "\"verdict\": \"true\""), "data.verdict"),
        (put("\"label\":", "\"label\": \"1\", \"label\":"), "twice"),
        (put("\"complex\": 0", "\"complex\": true"), "data.complex"),
        (put("\"complex\": 0", "\"more\": 0, \"complex\": 0"), "`more`"),
        (put("\"steps\": [[\"", "\"steps\": [[\"__init__"), "data.proof.steps[0]"),
        (
            put("[\"number\", \"2\"]", &format!("[\"number\", \"{digits}\"]")),
            "refused",
        ),
        (put("[\"number\", \"2\"]", "[\"number\", \"2/0\"]"), "divides by 0"),
        (put("[\"number\", \"2\"]", "[\"power\", 0, 999999999]"), "out of range"),
        (
            put("\"steps\": [", "\"steps\": [[\"given\", 99999], "),
            "step 1 (given)",
        ),
        // a point at which 0 is taken not to be 0
        (include_str!("kernel/forged-proof.json").to_owned(), "step 1 (generic)"),
        (
            include_str!("kernel/forged-refutation.json").to_owned(),
            "step 1 (generic)",
        ),
        (
            format!("{}{}", "[".repeat(100_000), "]".repeat(100_000)),
            "RecursionError",
        ),
    ];
    let files = cases.iter().enumerate();
    let files: Vec<(String, String)> = files
        .map(|(n, (text, _))| (format!("{n}.json"), text.clone()))
        .collect();
    let (all, said) = checked(&python, &scratch("hostile"), &files);
    assert!(!all && said.len() == cases.len(), "{}", said.join("\n"));
    for (line, (_, words)) in said.iter().zip(&cases) {
        // the forged files begin with a step that is not checked there
        let is_refused = line.contains(": refused: ") || words.contains("generic") && line.contains(LEFT_OUT);
        assert!(is_refused && line.contains(words), "{words}: {line}");
    }
}

/// Claims with complex values, some of them on the cuts of the functions in them.
const COMPLEX: &[&str] = &[
    r"\artanh(2) = \frac{1}{2} \ln 3 + \frac{i \pi}{2}",
    r"\cosh(\arcosh z) = z",
    r"\arsinh z = \ln(z + \sqrt{z^2 + 1})",
    r"\ln(-1) = i \pi",
    r"(-8)^{1/3} = 1 + i \sqrt{3}",
    r"z^{1/2} z^{1/2} = z",
    r"|z|^2 = z \bar z",
    r"|z|^2 = z^2",
    r"z^2 = -1",
];

#[test]
fn proof_data_of_complex_claims_is_accepted() {
    let Some(python) = python("flint") else { return };
    let claims = COMPLEX.iter().enumerate();
    let claims = claims.map(|(n, tex)| format!("[[equation]]\nlabel = '{n}'\nrole = 'claim'\ntex = '{tex}'\n"));
    let text = format!("[symbols]\ncomplex = ['z']\n{}", claims.collect::<String>());
    let files = all_data(&Sheet::read(&text, &vocabulary().unwrap()).unwrap());
    assert!(files.len() >= COMPLEX.len(), "{} files", files.len());
    let (all, said) = checked(&python, &scratch("complex"), &files);
    assert!(all, "{}", said.join("\n"));
}

/// A number below `bound`.
fn below(random: &mut Sequence, bound: usize) -> usize {
    (random.draw() % bound.max(1) as u64) as usize
}

/// Changes a coefficient, a sign or an exponent of a polynomial.
fn break_polynomial(polynomial: &mut Polynomial, random: &mut Sequence) {
    let mut terms: Vec<_> = polynomial.terms().to_vec();
    if terms.is_empty() {
        *polynomial = Polynomial::integer(1);
        return;
    }
    let at = below(random, terms.len());
    match below(random, 4) {
        0 => terms[at].1 = -terms[at].1.clone(),
        1 => terms[at].1 += Rational::from_integer(1).0,
        2 => {
            terms.remove(at);
        }
        _ => match terms[at].0.first_mut() {
            Some(factor) => factor.1 += 1,
            None => terms[at].1 *= Rational::from_integer(2).0,
        },
    }
    *polynomial = Polynomial::from_terms(terms);
}

fn break_number(number: &mut usize, random: &mut Sequence) {
    *number = match below(random, 3) {
        0 => *number + 1,
        1 => number.saturating_sub(1),
        _ => below(random, *number + 8),
    };
}

/// Changes one thing in one step; `false` where nothing was found to change.
fn break_step(steps: &mut Vec<Inference>, random: &mut Sequence) -> bool {
    if steps.is_empty() {
        return false;
    }
    let at = below(random, steps.len());
    if below(random, 12) == 0 {
        steps.remove(at);
        return true;
    }
    match &mut steps[at] {
        Inference::Given(number) => break_number(number, random),
        Inference::Zero {
            target,
            power,
            factors,
            terms,
            ..
        } => match below(random, 5) {
            0 => break_polynomial(target, random),
            1 => *power += 1,
            2 if !factors.is_empty() => {
                let n = below(random, factors.len());
                factors[n].1 += 1;
            }
            3 if !terms.is_empty() => {
                let n = below(random, terms.len());
                break_number(&mut terms[n].1, random);
            }
            _ if !terms.is_empty() => {
                let n = below(random, terms.len());
                break_polynomial(&mut terms[n].0, random);
            }
            _ => break_polynomial(target, random),
        },
        Inference::Nonzero {
            target,
            cofactor,
            terms,
            ..
        } => match below(random, 3) {
            0 => break_polynomial(target, random),
            1 if !terms.is_empty() => {
                let n = below(random, terms.len());
                break_polynomial(&mut terms[n].0, random);
            }
            _ => break_polynomial(cofactor, random),
        },
        Inference::Sign {
            target,
            strict,
            summands,
            ..
        } => match below(random, 4) {
            0 => break_polynomial(target, random),
            1 => *strict = !*strict,
            _ => match summands.first_mut() {
                Some(first) if below(random, 2) == 0 => first.factor = -first.factor.clone(),
                Some(first) => break_polynomial(&mut first.root, random),
                None => break_polynomial(target, random),
            },
        },
        Inference::Squeezed { low, high } => std::mem::swap(low, high),
        Inference::Between { target, within } => match within.first_mut() {
            Some(pair) if below(random, 2) == 0 => pair.swap(0, 1),
            _ => break_polynomial(target, random),
        },
        Inference::Congruence { left, right } => {
            left.0 = left.0.saturating_sub(1);
            right.0 = right.0.saturating_sub(below(random, 2) as u32);
        }
        Inference::Cases { on, branches, .. } => match below(random, 3) {
            0 => break_polynomial(on, random),
            _ => {
                let n = below(random, branches.len());
                return break_step(&mut branches[n], random);
            }
        },
        Inference::Constant { steps, .. } => return break_step(steps, random),
        Inference::Along { equation, .. } => break_number(equation, random),
        Inference::Generic(term) | Inference::Unfold(term) => term.0 = term.0.saturating_sub(1),
        Inference::Enclosure(polynomial) => break_polynomial(polynomial, random),
        Inference::Axiom(_) | Inference::Law { .. } | Inference::Derivative(_) => {
            let moved = steps.remove(at);
            let to = below(random, steps.len() + 1);
            steps.insert(to, moved);
        }
    }
    true
}

#[test]
fn what_the_kernel_accepts_of_broken_certificates_python_accepts_too() {
    let Some(python) = python("flint") else { return };
    let breaks: usize = std::env::var("BREAKS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let (own, paper) = (own(), paper());
    let mut all = Vec::new();
    for (sheet, labels) in [
        (
            &own,
            &["angles", "turns", "exponentials", "roots", "slope", "relation"][..],
        ),
        (&paper, &["9", "16"]),
    ] {
        for label in labels {
            let position = sheet.find(label).unwrap();
            let texts = proof_data(sheet, position, &Options::default());
            all.extend(decided(sheet, position, &Options::default()).into_iter().zip(texts));
        }
    }
    let mut random = Sequence::new(11);
    let (mut files, mut kernels) = (Vec::new(), Vec::new());
    let count = all.len();
    for (one, text) in &all {
        let Found::Proved { certificate, .. } = &one.found else {
            continue;
        };
        let mut data: Value = serde_json::from_str(text).unwrap();
        for _ in 0..breaks / count + 1 {
            let mut broken = certificate.evidence.clone();
            if !break_step(&mut broken.steps, &mut random) || broken.steps == certificate.evidence.steps {
                continue;
            }
            let with = With {
                statement: certificate.statement.clone(),
                evidence: broken.clone(),
            };
            let steps: Value = serde_json::from_str(&one.steps(&broken).unwrap()).unwrap();
            data["proof"]["steps"] = steps["steps"].clone();
            data["proof"]["whole"] = steps["whole"].clone();
            files.push((format!("{}.json", files.len()), data.to_string()));
            let differs = differing(&certificate.evidence, &broken);
            kernels.push((one.label.clone(), follows(&with).is_ok(), differs));
        }
    }
    let (_, said) = checked(&python, &scratch("breaks"), &files);
    assert_eq!(said.len(), files.len());
    let (mut valid, mut stricter) = (0, 0);
    for (line, (label, kernel, differs)) in said.iter().zip(&kernels) {
        let accepted = line.contains(": accepted: ");
        assert!(
            accepted || !kernel,
            "({label}): accepted by the kernel alone: {differs:?}: {line}"
        );
        valid += usize::from(*kernel);
        stricter += usize::from(accepted && !kernel);
    }
    let tried = files.len();
    println!("{tried} broken certificates: {valid} are proofs all the same, {stricter} refused by the kernel alone");
    assert!(tried >= breaks / 2, "{tried}");
}

/// Certificates for derivatives of laws and maps that hold at single points, each of which was accepted once.
#[test]
fn nothing_is_differentiated_that_holds_at_single_points() {
    let Some(python) = python("flint") else { return };
    let head = r#"{"format": "vibro-audit-proof", "version": 1, "label": "", "claim": "", "goal": "", "part": "",
        "instance": "", "reductions": [], "premises": [], "#;
    let lines = include_str!("kernel/single-times.jsonl").lines().enumerate();
    let files: Vec<(String, String)> = lines
        .map(|(n, line)| (format!("{n}.json"), format!("{head}{}", &line[1..])))
        .collect();
    let (_, said) = checked(&python, &scratch("single-times"), &files);
    assert_eq!(said.len(), files.len());
    for line in said {
        assert!(
            line.contains(": refused: step") || line.contains(": left out: step"),
            "{line}"
        );
        let is_known = line.ends_with("a term is not known to be nonzero") || line.contains("(along): such a step");
        assert!(is_known, "{line}");
    }
}

/// The first step that differs.
fn differing(a: &Certificate, b: &Certificate) -> Option<Inference> {
    let pair = a.steps.iter().zip(&b.steps).find(|(a, b)| a != b);
    pair.map(|(_, b)| b.clone()).or_else(|| b.steps.last().cloned())
}
