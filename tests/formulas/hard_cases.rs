//! Claims and sheets that were once decided wrongly, or not at all, or ended badly.

use crate::common::paper;

use paper::{sheet, vocabulary};
use std::time::Duration;
use vibro_audit::claim::{Fault, Sheet, Verdict};
use vibro_audit::prove::{self, Decision, Options};

fn audit(text: &str) -> Result<Vec<Decision>, Fault> {
    Ok(prove::audit(&Sheet::read(text, &vocabulary())?, &Options::default()))
}

fn decide(premises: &[&str], tex: &str, with: &[&str]) -> Result<Verdict, Fault> {
    let premises: Vec<(String, String)> = premises
        .iter()
        .enumerate()
        .map(|(n, tex)| (format!("p{n}"), tex.to_string()))
        .collect();
    let with: Vec<String> = with.iter().map(ToString::to_string).collect();
    audit(&sheet(&premises, tex, &[], &with)).map(|decisions| decisions[0].verdict)
}

fn proved(premises: &[&str], tex: &str, with: &[&str]) {
    assert_eq!(decide(premises, tex, with), Ok(Verdict::Proved), "{tex}");
}

fn refuted(premises: &[&str], tex: &str, with: &[&str]) {
    assert_eq!(decide(premises, tex, with), Ok(Verdict::Refuted), "{tex}");
}

/// Right, but beyond the engine today: once it is decided, it belongs to `proved`.
fn not_decided_yet(premises: &[&str], tex: &str, with: &[&str]) {
    assert_eq!(decide(premises, tex, with), Ok(Verdict::Undecided), "{tex}");
}

fn in_time<T: Send + 'static>(what: &str, work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = std::sync::mpsc::channel();
    std::thread::spawn(move || sender.send(work()));
    receiver
        .recv_timeout(Duration::from_secs(10))
        .unwrap_or_else(|error| panic!("{what}: {error}"))
}

/// Runs the work in a process of its own, because it may abort; `name` is the test that calls.
fn survives(name: &str, work: impl FnOnce()) {
    if std::env::var("VIBRO_AUDIT_CHILD").is_ok() {
        return work();
    }
    let run = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--test-threads=1"])
        .env("VIBRO_AUDIT_CHILD", "1")
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}{}",
        String::from_utf8_lossy(&run.stdout),
        String::from_utf8_lossy(&run.stderr)
    );
}

const THREE: &str = r"\dot{Z}(t) = -r\dot{Z}^{-}(t_k) + \overline{g}(t - t_k) + F_1(t) - F_1(t_k)";
const FOUR: &str =
    r"Z(t) = Z_k^- - r\dot{Z}_k^-(t - t_k) + \frac{\overline{g}}{2}(t - t_k)^2 + F_2(t) - F_2(t_k) - F_1(t_k)(t - t_k)";
const NINE: &str = r"\dot{Z}_{k+1} = -r_B \dot{Z}_k + \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k)";
const TEN: &str = r"-d = -r_B \dot{Z}_k T_1 + \frac{\overline{g}}{2} T_1^2 + F_2(t_{k+1}) - F_2(t_k) - F_1(t_k) T_1";
const ELEVEN: &str = r"\dot{Z}_{k+2} = -r_T \dot{Z}_{k+1} + \overline{g}T_2 + F_1(t_{k+2}) - F_1(t_{k+1})";
const TWELVE: &str =
    r"d = -r_T \dot{Z}_{k+1} T_2 + \frac{\overline{g}}{2} T_2^2 + F_2(t_{k+2}) - F_2(t_{k+1}) - F_1(t_{k+1}) T_2";
const THIRTEEN: &str =
    r"Z_{k+2} = Z_k, \dot{Z}_{k+2} = \dot{Z}_k, T = T_1 + T_2, f(t) = f(t+T), F_1(t) = F_1(t+T), F_2(t) = F_2(t+T)";
const CHARACTERISTIC: &str = r"\lambda^2 - Tr(DP) \lambda + Det(DP) = 0";

#[test]
fn the_second_flight_though_the_claim_names_an_earlier_time() {
    let with = &["r = r_T"];
    proved(
        &[THREE],
        r"\dot{Z}_{k+2} = -r_T \dot{Z}_{k+1} + \overline{g}T_2 + F_1(t_{k+2}) - F_1(t_k + T_1)",
        with,
    );
    proved(
        &[THREE],
        r"\dot{Z}_{k+2} = -r_T \dot{Z}_{k+1} + \overline{g}(t_{k+2} - t_k - T_1) + F_1(t_{k+2}) - F_1(t_{k+1})",
        with,
    );
    let periodic = "T = T_1 + T_2, F_1(t) = F_1(t+T)";
    proved(
        &[THREE, periodic],
        r"\dot{Z}_{k+2} = -r_T \dot{Z}_{k+1} + \overline{g}T_2 + F_1(t_k) - F_1(t_{k+1})",
        with,
    );
    proved(
        &[THREE, periodic],
        r"\dot{Z}_{k+2} = -r_T \dot{Z}_{k+1} + \overline{g}(T - T_1) + F_1(t_{k+2}) - F_1(t_{k+1})",
        with,
    );
}

#[test]
fn a_law_of_flight_differentiated() {
    proved(&[THREE], r"\ddot{Z}(t) = f(t) + \overline{g}", &[]);
    proved(&[THREE, FOUR], r"\ddot{Z}(t) = f(t) + \overline{g}", &[]);
}

#[test]
fn a_premise_times_a_flight_of_the_other_map() {
    let nine = format!(r"T_2 \dot{{Z}}_{{k+1}} = T_2 ({})", NINE.split(" = ").nth(1).unwrap());
    let claim = r"\frac{\partial \dot{Z}_{k+1}}{\partial \dot{Z}_k} = -r_B + \frac{\partial t_{k+1}}{\partial \dot{Z}_k} [f(t_{k+1}) + \overline{g}]";
    proved(&[NINE, TEN], claim, &[]);
    not_decided_yet(&[&nine, TEN], claim, &[]);
}

#[test]
fn a_forcing_that_is_given() {
    proved(&[r"f(t) = \cos(\pi t + \phi)"], r"f(t_k) = \cos(\pi t_k + \phi)", &[]);
    refuted(
        &[r"f(t) = \cos(\pi t + \phi)"],
        r"f(t_k) = \cos(\pi t_{k+1} + \phi)",
        &[],
    );
}

#[test]
fn a_root_that_is_not_real() {
    refuted(
        &[CHARACTERISTIC],
        r"\lambda_{1,2} = \frac{Tr(DP) \pm \sqrt{\Delta}}{2}, \Delta = -([Tr(DP)]^2 - 4 Det(DP))",
        &[],
    );
    refuted(&["T = 1"], r"\sqrt{-T_1^2} = T_1", &[]);
    refuted(&["T = 1"], r"T_1 = \sqrt{-1}", &[]);
}

#[test]
fn roots_that_are_not_rational() {
    refuted(&["T = 1"], r"\sqrt{2} = 1", &[]);
    refuted(&["T = 1"], r"\sqrt{2} = 1.41421356", &[]);
    refuted(&["T = 1"], r"\sqrt{T_1 + T_2} = \sqrt{T_1} + \sqrt{T_2}", &[]);
    refuted(&["T = 1"], r"\sqrt{T_1} = \sqrt{2}", &[]);
    refuted(&["T = T_1 + T_2"], r"\sqrt{T_1^4 + T_2^4 + 1} = T", &[]);
}

#[test]
fn products_of_roots() {
    proved(&["T = 1"], r"\sqrt{T_1 T_2} = \sqrt{T_1} \sqrt{T_2}", &[]);
    // a root within a root: (1 + \sqrt{2})^2 = 3 + 2 \sqrt{2}
    proved(&["T = 1"], r"\sqrt{3 + 2 \sqrt{2}} = 1 + \sqrt{2}", &[]);
    refuted(&["T = 1"], r"\sqrt{3 + 2 \sqrt{2}} = 1 - \sqrt{2}", &[]);
}

#[test]
fn the_root_of_a_determinant() {
    not_decided_yet(&[NINE, TEN, ELEVEN, TWELVE, THIRTEEN], r"\sqrt{Det(DP)} = r_B r_T", &[]);
}

#[test]
fn a_function_that_changes_sign_after_half_a_period() {
    proved(&["f(t + T/2) = -f(t), T = T_1 + T_2"], "f(t_k + T) = f(t_k)", &[]);
    proved(&["f(t + T/2) = -f(t), T = T_1 + T_2"], "f(t_{k+2}) = f(t_k)", &[]);
}

#[test]
fn derivatives_by_what_they_are_of() {
    // At each impact the time and the velocity are the variables of the map that starts there.
    let all = &[NINE, TEN, ELEVEN, TWELVE];
    proved(all, r"\frac{\partial t_{k+1}}{\partial t_{k+1}} = 1", &[]);
    proved(all, r"\frac{\partial t_{k+1}}{\partial \dot{Z}_{k+1}} = 0", &[]);
    refuted(
        all,
        r"\frac{\partial t_{k+1}}{\partial t_{k+1}} = \frac{r_{B}\dot{Z}_{k} - \overline{g}T_{1} - f(t_{k})T_{1}}{r_{B}\dot{Z}_{k} - \overline{g}T_{1} - F_{1}(t_{k+1}) + F_{1}(t_{k})}",
        &[],
    );
}

#[test]
fn powers_too_large_to_write_out() {
    survives("powers_too_large_to_write_out", || {
        for power in ["100", "1000", "100000", "2000000000"] {
            let sum = r"r_B + r_T + d + \overline{g}";
            let tex = format!("({sum})^{{{power}}} = ({sum})^{{{power}}} + d");
            let found = in_time("a power", move || decide(&["T = 1"], &tex, &[]));
            assert_ne!(found, Ok(Verdict::Proved));
        }
        let tex = format!("T = T_1 + {}2{}", "(".repeat(8), "^9)".repeat(8));
        let _ = in_time("powers of powers", move || decide(&["T = 1"], &tex, &[]));
        let found = in_time("a power of a number", || decide(&["T = 1"], "T = 2^{2000000000}", &[]));
        assert_ne!(found, Ok(Verdict::Proved));
    });
}

#[test]
fn many_fractions() {
    let sum = r"r_B + r_T + d + \overline{g}";
    let fractions = (1..40)
        .map(|n| format!(r"\frac{{1}}{{{sum} + {n} T}}"))
        .collect::<Vec<_>>()
        .join(" + ");
    let found = in_time("forty fractions", move || {
        decide(&["d = 1"], &format!("{fractions} = 1"), &[])
    });
    assert_ne!(found, Ok(Verdict::Proved));
}

#[test]
fn roots_in_roots() {
    let tex = format!("T = {}T_1{} + T_2", r"\sqrt{1 + ".repeat(50), "}".repeat(50));
    let found = in_time("fifty roots", move || decide(&["T = 1"], &tex, &[]));
    assert_ne!(found, Ok(Verdict::Proved));
}

fn vocabulary_fault(symbols: &str) -> Fault {
    let text = format!(
        "[symbols]\n{symbols}\n\n{}",
        sheet(&[("1".into(), "a = b".into())], "a = b", &[], &[])
    );
    audit(&text).expect_err(symbols)
}

#[test]
fn abbreviations_in_a_circle() {
    survives("abbreviations_in_a_circle", || {
        let fault = vocabulary_fault("parameters = [\"a\", \"b\"]\nabbreviations = [\"c = e\", \"e = c\"]");
        assert!(fault.place.is_some(), "{fault}");
    });
}

#[test]
fn relations_that_give_no_square() {
    let fault = vocabulary_fault("parameters = [\"a\", \"b\"]\nrelations = [\"a + b = 1\"]");
    assert!(fault.to_string().contains("a + b") && fault.place.is_some(), "{fault}");
}

#[test]
fn relations_of_unknown_symbols() {
    let fault = vocabulary_fault("parameters = [\"a\", \"b\"]\nrelations = [\"s^2 = 1 - a\"]");
    assert!(fault.to_string().contains('s') && fault.place.is_some(), "{fault}");
}

#[test]
fn vocabularies_that_name_what_they_do_not_declare() {
    let mut accepted = Vec::new();
    for (symbols, word) in [
        ("parameters = [\"a\", \"b\"]\nperiods = { g = \"a\" }", "g"),
        ("parameters = [\"a\", \"b\"]\n[symbols.maps]\nM = \"M\"", "M"),
        ("parameters = [\"a\", \"b\"]\ngeneric = [\"q\"]", "q"),
        (
            "parameters = [\"a\", \"b\"]\nfunctions = [\"q = p\"]\ntimes = [\"t\"]\npositive = [\"q\"]",
            "q",
        ),
    ] {
        let text = format!(
            "[symbols]\n{symbols}\n\n{}",
            sheet(&[("1".into(), "a = b".into())], "a = b", &[], &[])
        );
        match audit(&text) {
            Err(fault) if fault.to_string().contains(word) && fault.place.is_some() => {}
            other => accepted.push(format!("{symbols}\n{other:?}")),
        }
    }
    assert!(accepted.is_empty(), "{}", accepted.join("\n"));
}

#[test]
fn the_motion_law_holds_at_each_impact_and_on_each_flight() {
    let motion = &[r"\ddot{Z}(t) = f(t) + \overline{g}"];
    // an acceleration has two values at an impact, which agree here alone
    let found = decide(motion, r"\ddot{Z}(t_k) = f(t_k) + \overline{g}", &[]);
    assert_ne!(found, Ok(Verdict::Refuted));
    assert_ne!(found, Ok(Verdict::Proved));
    proved(
        motion,
        r"\dot{Z}_{k+2} - \dot{Z}_{k+1}^+ + \dot{Z}_{k+1} - \dot{Z}_k^+ = \overline{g}(T_1 + T_2) + F_1(t_{k+2}) - F_1(t_k)",
        &[],
    );
    let law = r"\dot{Z}_k^+ = -r \dot{Z}_k^-";
    // k is fixed: the law says nothing of the impact after it
    refuted(&[motion[0], law], ELEVEN, &["r = r_T"]);
    let next = r"\dot{Z}_{k+1}^+ = -r \dot{Z}_{k+1}^-";
    proved(&[motion[0], next], ELEVEN, &["r = r_T"]);
    not_decided_yet(&[THREE], NINE, &["r = r_B", "t = t_k + T_1"]);
}

#[test]
fn a_grazing_impact_proves_nothing_of_derivatives() {
    let graze = r"\dot{Z}_{k+1} = 0";
    let found = decide(
        &[NINE, TEN, ELEVEN, TWELVE, THIRTEEN, graze],
        "Det(DP) = r_B^2 r_T",
        &[],
    );
    assert_ne!(found, Ok(Verdict::Proved));
}

#[test]
fn eigenvalues_that_are_not_rational_are_still_told_apart() {
    let all = &[NINE, TEN, ELEVEN, TWELVE, THIRTEEN, CHARACTERISTIC];
    refuted(
        all,
        r"\lambda_{1,2} = \frac{Tr(DP) \pm \sqrt{Tr(DP)^2 - 4 r_B r_T}}{2}",
        &[],
    );
    not_decided_yet(
        all,
        r"\lambda_{1,2} = \frac{Tr(DP) \pm \sqrt{Tr(DP)^2 - 4 r_B^2 r_T^2}}{2}",
        &[],
    );
}

#[test]
fn a_counterexample_is_a_point_where_the_formula_as_written_is_defined() {
    let text = sheet(
        &[("p".into(), "d = 1".into())],
        r"\frac{T_1^2 - T_2^2}{T_1 - T_2} = T",
        &[],
        &[],
    );
    let decisions = audit(&text).expect("a decision");
    let point = &decisions[0].counterexample.as_ref().expect("a counterexample").point;
    let value = |name: &str| {
        point
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, value)| value.clone())
    };
    assert!(value("T_1").is_some() && value("T_1") != value("T_2"), "{point:?}");
}

#[test]
fn a_sheet_without_a_claim_is_no_audit_that_passes() {
    let fault = audit("[[equation]]\nlabel = 'p'\nrole = 'premise'\ntex = 'd = 1'\n").expect_err("no claim");
    assert!(fault.to_string().contains("no claim"), "{fault}");
}
