//! Sheets as people hand them in: with mistakes, each of which is an error that says what and where; with a vocabulary
//! of their own; with odd characters; large.

#[path = "common/paper.rs"]
#[allow(dead_code)]
mod paper;

use paper::{sheet, vocabulary};
use std::time::{Duration, Instant};
use vibro_audit::claim::{Fault, Sheet, Verdict};
use vibro_audit::prove::{self, Decision, Options};

fn audit(text: &str) -> Result<Vec<Decision>, Fault> {
    Ok(prove::audit(&Sheet::read(text, &vocabulary())?, &Options::default()))
}

fn verdicts(text: &str) -> Vec<(String, Verdict)> {
    let decisions = audit(text).unwrap_or_else(|fault| panic!("{text}\n{fault}"));
    decisions
        .into_iter()
        .map(|decision| (decision.label, decision.verdict))
        .collect()
}

/// The fault of a sheet, with every word it must say and the line it must name.
fn refuse(text: &str, words: &[&str], line: Option<usize>) {
    let fault = match audit(text) {
        Err(fault) => fault,
        Ok(decisions) => panic!("{text}\nis accepted: {decisions:?}"),
    };
    let shown = fault.to_string();
    for word in words {
        assert!(shown.contains(word), "{text}\n`{word}` is missing in: {shown}");
    }
    if let Some(line) = line {
        assert_eq!(fault.place.map(|(line, _)| line), Some(line), "{text}\n{shown}");
    }
}

fn equation(label: &str, role: &str, tex: &str, more: &str) -> String {
    let more = if more.is_empty() {
        String::new()
    } else {
        format!("{more}\n")
    };
    format!("[[equation]]\nlabel = \"{label}\"\nrole = \"{role}\"\ntex = '''{tex}'''\n{more}\n")
}

fn premise(label: &str, tex: &str) -> String {
    equation(label, "premise", tex, "")
}

fn claim(label: &str, tex: &str, from: &str) -> String {
    equation(label, "claim", tex, &format!("follows_from = [{from}]"))
}

const TRUE: &str = "T = T_1 + T_2";

#[test]
fn what_is_no_sheet() {
    refuse("", &["no [[equation]]"], None);
    refuse("title = \"x\"\n", &["no [[equation]]"], None);
    refuse("[[equation]\nlabel = 1\n", &[], Some(1));
    refuse(
        "[[equation]]\nlabel = \"1\"\nrole = \"premise\"\ntex = '''a = b\n",
        &[],
        None,
    );
    refuse(
        "[[equation]]\nlabel = 1\nrole = \"premise\"\ntex = \"T = 1\"\n",
        &["string"],
        Some(2),
    );
    refuse("[[equation]]\nlabel = \"1\"\nrole = \"premise\"\n", &["tex"], Some(1));
    refuse("[[equation]]\nlabel = \"1\"\ntex = \"T = 1\"\n", &["role"], Some(1));
    refuse(
        "[[equation]]\nrole = \"premise\"\ntex = \"T = 1\"\n",
        &["label"],
        Some(1),
    );
    refuse(&(premise("1", TRUE) + "colour = \"red\"\n"), &["colour"], Some(6));
    refuse(&format!("colour = 1\n{}", premise("1", TRUE)), &["colour"], Some(1));
    refuse(&equation("1", "lemma", TRUE, ""), &["lemma", "claim"], Some(3));
    let more = "follows_from = [\"1\"]\nexpect = \"undecided\"";
    refuse(
        &(premise("1", TRUE) + &equation("2", "claim", TRUE, more)),
        &["undecided", "proved"],
        Some(11),
    );
    refuse(
        &(premise("1", TRUE) + &equation("2", "claim", TRUE, "follows_from = \"1\"")),
        &[],
        Some(10),
    );
}

#[test]
fn labels_and_premises() {
    refuse(&(premise("1", TRUE) + &premise("1", TRUE)), &["1", "twice"], Some(7));
    refuse(
        &(premise("1", TRUE) + &equation("1", "definition", TRUE, "")),
        &["1", "twice"],
        Some(7),
    );
    refuse(&premise("", TRUE), &["empty"], Some(2));
    refuse(&premise("  ", TRUE), &["empty"], Some(2));
    refuse(
        &(premise("1", TRUE) + &claim("2", TRUE, "\"7\"")),
        &["2", "`7`", "1"],
        Some(10),
    );
    refuse(
        &(premise("1", TRUE) + &claim("2", TRUE, "")),
        &["2", "follows_from"],
        None,
    );
    refuse(
        &(premise("1", TRUE) + &equation("2", "claim", TRUE, "")),
        &["2", "follows_from"],
        None,
    );
    refuse(&claim("2", TRUE, "\"2\""), &["2", "itself"], None);
    refuse(
        &(claim("2", TRUE, "\"3\"") + &claim("3", TRUE, "\"2\"")),
        &["itself"],
        None,
    );
    let circle: String = (0..60)
        .map(|n| claim(&n.to_string(), TRUE, &format!("\"{}\"", (n + 1) % 60)))
        .collect();
    refuse(&circle, &["itself"], None);
    // A circle is an error although another claim alone would do.
    refuse(
        &(premise("1", TRUE) + &claim("4", TRUE, "\"1\"") + &claim("5", TRUE, "\"1\", \"5\"")),
        &["5", "itself"],
        None,
    );
}

#[test]
fn formulas_that_cannot_be_read() {
    let with = |tex: &str| premise("1", TRUE) + &claim("2", tex, "\"1\"");
    for (tex, column) in [
        (r"T = \frac{1}{2", 11),
        (r"T = T_1 + ", 18),
        (r"T = (T_1 + T_2]", 22),
        (r"T = T_1 +* T_2", 17),
        (r"T = T_1 \leq 2", 16),
        (r"T = T_1 T_2)", 19),
        (r"T = \unknowncommand", 12),
        (r"T = T_1^{x}", 15),
        (r"T_1", 8),
        (r"", 8),
    ] {
        let text = with(tex);
        let fault = audit(&text).expect_err(tex);
        assert_eq!(fault.label.as_deref(), Some("2"), "{tex}");
        assert_eq!(fault.place.map(|(line, _)| line), Some(9), "{tex}: {fault}");
        assert!(
            fault.place.is_some_and(|(_, found)| found >= 7 && found <= column + 12),
            "{tex}: {fault}"
        );
        assert!(fault.to_string().contains('^'), "{tex}: {fault}");
    }
    // Also in premises that nothing rests on, but not in definitions, which are kept verbatim.
    refuse(&premise("1", r"T = \frac{1}"), &["(1)"], Some(4));
    assert_eq!(
        verdicts(&(with(TRUE) + &equation("3", "definition", r"\oint \langle x", ""))).len(),
        1
    );
}

#[test]
fn symbols_that_nobody_knows() {
    let base = premise("1", TRUE);
    refuse(
        &(base.clone() + &claim("2", "T = T_1 + x", "\"1\"")),
        &["(2)", "unknown symbol `x`", "r_B"],
        Some(9),
    );
    refuse(
        &(base.clone() + &claim("2", "x = T_1 + T_2", "\"1\"")),
        &["(2)", "`x`"],
        Some(9),
    );
    refuse(
        &(premise("1", "T = T_1 + x T_2") + &claim("2", TRUE, "\"1\"")),
        &["(1)", "`x`"],
        Some(4),
    );
    refuse(
        &(base.clone() + &claim("2", "T = r_C", "\"1\"")),
        &["(2)", "`r_C`"],
        Some(9),
    );
    refuse(
        &(base.clone() + &claim("2", "T = F_3(t_k)", "\"1\"")),
        &["(2)", "`F_3`"],
        Some(9),
    );
    refuse(
        &(base.clone() + &claim("2", "T = T_3", "\"1\"")),
        &["(2)", "`T_3`"],
        Some(9),
    );
    refuse(
        &(base.clone() + &claim("2", r"T = \overline{G}", "\"1\"")),
        &["(2)", r"`\overline{G}`"],
        Some(9),
    );
    let more = "follows_from = [\"1\"]\nwhere = ['''\\epsilon_1 = T_1 + x''']";
    refuse(
        &(base.clone() + &equation("2", "claim", r"T = \epsilon_1 + T_2 - x", more)),
        &["(2)", "`x`"],
        None,
    );
    refuse(
        &(base.clone() + &equation("2", "claim", r"T = \epsilon_1 + T_2", more)),
        &["(2)", "`x`"],
        None,
    );
    let more = "follows_from = [\"1\"]\nwith = ['''x = T_1''']";
    refuse(
        &(base.clone() + &equation("2", "claim", TRUE, more)),
        &["(2)", "`x`"],
        Some(11),
    );
    let more = "follows_from = [\"1\"]\nwith = ['''T_1 = x''']";
    refuse(&(base + &equation("2", "claim", TRUE, more)), &["(2)", "`x`"], Some(11));
}

#[test]
fn local_definitions() {
    let with = |list: &str, tex: &str| {
        let more = format!("follows_from = [\"1\"]\nwhere = [{list}]");
        premise("1", TRUE) + &equation("2", "claim", tex, &more)
    };
    let twice = r"'''\epsilon_1 = T_1''', '''\epsilon_1 = T_2'''";
    refuse(&with(twice, r"T = \epsilon_1 + T_2"), &["(2)", "twice"], Some(11));
    let itself = r"'''\epsilon_1 = \epsilon_1 + T_1'''";
    refuse(
        &with(itself, r"T = \epsilon_1 + T_2"),
        &["(2)", r"\epsilon_1", "itself"],
        None,
    );
    let circle = r"'''\epsilon_1 = \epsilon_2''', '''\epsilon_2 = \epsilon_1'''";
    refuse(&with(circle, r"T = \epsilon_1 + T_2"), &["(2)", "itself"], None);
    let unread = r"'''\epsilon_1 = \frac{T_1}{'''";
    refuse(&with(unread, r"T = \epsilon_1 + T_2"), &["(2)"], Some(11));
    // In any order, and unused ones are no harm.
    let good = r"'''\epsilon_2 = 2 \epsilon_1''', '''\epsilon_1 = T_1''', '''x = 5'''";
    assert_eq!(
        verdicts(&with(good, r"T = \frac{\epsilon_2}{2} + T_2"))[0].1,
        Verdict::Proved
    );
}

#[test]
fn premises_that_contradict_each_other() {
    let two = |a: &str, b: &str| premise("1", a) + &premise("2", b) + &claim("3", TRUE, "\"1\", \"2\"");
    for (a, b) in [
        ("T = 1", "T = 2"),
        (r"d = r_B", r"d = r_B + 1"),
        (r"\dot{Z}_k = d, T = 1", r"\dot{Z}_k = d + 1"),
        (r"F_1(t) = F_1(t + T), T = T_1 + T_2", r"F_1(t_{k+2}) = F_1(t_k) + 1"),
        (r"T_1 = t_{k+1} - t_k + 1", "T = 2"),
        ("0 = 1", "T = 1"),
    ] {
        refuse(&two(a, b), &["no common solution"], None);
    }
    // Said twice is no contradiction.
    assert_eq!(
        verdicts(&two("T = T_1 + T_2", "T_1 + T_2 - T = 0"))[0].1,
        Verdict::Proved
    );
}

#[test]
fn files_as_they_come() {
    let text = premise("1", TRUE) + &claim("2", "T_1 = T - T_2", "\"1\"");
    let wanted = verdicts(&text);
    assert_eq!(wanted, [("2".to_string(), Verdict::Proved)]);
    assert_eq!(verdicts(&text.replace('\n', "\r\n")), wanted);
    assert_eq!(verdicts(&format!("\u{feff}{text}")), wanted);
    assert_eq!(verdicts(&text.replace("T_1 = ", "T_1\r\n  = \t")), wanted);
    assert_eq!(verdicts(&text.replace("\"2\"", "\"é–∂ 2\"")).len(), 1);
    // A place counts characters.
    let odd = premise("1", TRUE) + &claim("∂2", "T_1 = T - T_2 + é", "\"1\"");
    refuse(&odd, &["∂2", "é"], Some(9));
    let basic = text.replace("'''T_1 = T - T_2'''", "\"\\u0054_1 = T - T_2 + x\"");
    refuse(&basic, &["(2)", "`x`"], Some(9));
}

fn in_time<T: Send + 'static>(limit: Duration, what: &str, work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = std::sync::mpsc::channel();
    std::thread::spawn(move || sender.send(work()));
    let start = Instant::now();
    let answer = receiver
        .recv_timeout(limit)
        .unwrap_or_else(|error| panic!("{what}: {error} after {limit:?}"));
    println!("{what}: {:?}", start.elapsed());
    answer
}

#[test]
fn a_sheet_of_a_thousand_claims() {
    let mut text = premise("1", TRUE);
    for n in 0..1000 {
        text.push_str(&claim(
            &format!("c{n}"),
            &format!("T_1 + {n} r_B = T - T_2 + {} r_B", n / 2 * 2),
            "\"1\"",
        ));
    }
    let found = in_time(Duration::from_secs(20), "a thousand claims", move || verdicts(&text));
    assert_eq!(found.len(), 1000);
    for (n, (_, verdict)) in found.iter().enumerate() {
        assert_eq!(
            *verdict,
            if n % 2 == 0 { Verdict::Proved } else { Verdict::Refuted },
            "c{n}"
        );
    }
}

#[test]
fn a_chain_of_claims() {
    let mut text = premise("0", TRUE);
    for n in 1..1000 {
        text.push_str(&claim(&n.to_string(), TRUE, &format!("\"{}\"", n - 1)));
    }
    let found = in_time(Duration::from_secs(20), "a chain", move || verdicts(&text));
    assert!(found.iter().all(|(_, verdict)| *verdict == Verdict::Proved));
}

#[test]
fn huge_formulas_end() {
    let limit = Duration::from_secs(20);
    let decide = move |what: &'static str, tex: String| {
        in_time(limit, what, move || {
            audit(&(premise("1", TRUE) + &claim("2", &tex, "\"1\""))).map(|d| d[0].verdict)
        })
    };
    let many = |n: usize| {
        (0..n)
            .map(|n| format!("{} r_B^{} d", n + 1, n % 7))
            .collect::<Vec<_>>()
            .join(" + ")
    };
    let terms = format!("T_1 + {0} = T - T_2 + {0}", many(2500));
    assert_eq!(decide("5,000 terms", terms), Ok(Verdict::Proved));
    // Longer than what is read at all: an error, at once.
    let _ = decide("10,000 terms", format!("T = {}", many(10_000)));
    let sum = r"r_B + r_T + d + \overline{g}";
    for power in [10, 20, 40] {
        let tex = format!("({sum})^{{{power}}} = ({sum})^{{{power}}} + d");
        let found = decide("a power", tex);
        assert_ne!(found, Ok(Verdict::Proved), "{power}");
        let tex = format!("({sum})^{{{power}}} = ({sum})^{{{power}}}");
        let found = decide("a power", tex);
        assert_ne!(found, Ok(Verdict::Refuted), "{power}");
    }
    let product = (1..30).map(|n| format!("({sum} + {n} T)")).collect::<Vec<_>>().join("");
    let _ = decide("a product of thirty sums", format!("{product} = 1"));
    for depth in [10, 50, 100, 1000, 20_000] {
        let _ = decide(
            "brackets",
            format!("T = {}T_1{} + T_2", "(".repeat(depth), ")".repeat(depth)),
        );
        let _ = decide(
            "fractions",
            format!("T = {}T_1{} + T_2", r"\frac{1}{1 + ".repeat(depth), "}".repeat(depth)),
        );
    }
    let _ = decide(
        "roots",
        format!("T = {}T_1{} + T_2", r"\sqrt{1 + ".repeat(10), "}".repeat(10)),
    );
    let _ = decide("digits", format!("T = T_1 + T_2 + {}", "9".repeat(50_000)));
    let _ = decide("a large power of a symbol", "T = T_1 + r_B^{2000000000}".to_string());
    let _ = decide("a large negative power", "T = T_1 + (r_B + d)^{-200000}".to_string());
    let _ = decide(
        "roots of roots",
        format!(
            "T = {}",
            (1..8)
                .map(|n| format!(r"\sqrt{{r_B + {n}}}"))
                .collect::<Vec<_>>()
                .join(" + ")
        ),
    );
}

/// A sheet with a vocabulary of its own: each claim with the verdict it must get.
fn own(symbols: &str, premises: &[(&str, &str)], claims: &[(&str, bool)]) {
    let premises: Vec<(String, String)> = premises.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect();
    for (tex, right) in claims {
        let mut text = format!("[symbols]\n{symbols}\n\n{}", sheet(&premises, tex, &[], &[]));
        if premises.is_empty() {
            text = text.replace(
                "[[equation]]",
                "[[equation]]\nlabel = \"none\"\nrole = \"premise\"\ntex = \"0 = 0\"\n\n[[equation]]",
            );
            text = text.replace("follows_from = []", "follows_from = [\"none\"]");
        }
        let wanted = if *right { Verdict::Proved } else { Verdict::Refuted };
        match audit(&text) {
            Err(fault) => panic!("{text}\n{fault}"),
            Ok(decisions) => assert_eq!(decisions[0].verdict, wanted, "{tex}: {:?}", decisions[0]),
        }
    }
}

#[test]
fn a_map_with_a_jacobian() {
    let symbols = r#"parameters = ["a", "b"]
states = ["x", "y"]
[symbols.maps]
H = ["x_{k+1} = 1 - a x_k^2 + y_k", "y_{k+1} = b x_k"]
HH = "H H""#;
    own(
        symbols,
        &[],
        &[
            ("Tr(H) = -2 a x_k", true),
            ("Det(H) = -b", true),
            ("Det(H) = b", false),
            ("Tr(H) = -2 a x_k + y_k", false),
            (r"\frac{\partial x_{k+1}}{\partial x_k} = -2 a x_k", true),
            (r"\frac{\partial x_{k+1}}{\partial y_k} = 1", true),
            (r"\frac{\partial y_{k+1}}{\partial x_k} = b", true),
            (r"\frac{\partial y_{k+1}}{\partial y_k} = 0", true),
            (r"\frac{\partial y_{k+1}}{\partial y_k} = 1", false),
        ],
    );
    let labelled = format!(
        "[symbols]\nparameters = [\"a\", \"b\"]\nstates = [\"x\", \"y\"]\n[symbols.maps]\nH = [\"1\", \"2\"]\n\n{}{}{}",
        premise("1", "x_{k+1} = 1 - a x_k^2 + y_k"),
        premise("2", "y_{k+1} = b x_k"),
        claim("3", "Det(H) = -b", "\"1\", \"2\"")
    );
    assert_eq!(verdicts(&labelled)[0].1, Verdict::Proved);
}

#[test]
fn a_fixed_point() {
    let symbols = r#"parameters = ["a", "b"]
states = ["x", "y"]
[symbols.maps]
H = ["x_{k+1} = 1 - a x_k^2 + y_k", "y_{k+1} = b x_k"]"#;
    own(
        symbols,
        &[
            ("map", "x_{k+1} = 1 - a x_k^2 + y_k, y_{k+1} = b x_k"),
            ("fixed", "x_{k+1} = x_k, y_{k+1} = y_k"),
        ],
        &[
            ("a x_k^2 + (1 - b) x_k - 1 = 0", true),
            ("a x_k^2 + (1 + b) x_k - 1 = 0", false),
            ("Tr(H) = -2 a x_k", true),
            (r"Tr(H) = -\frac{2 (1 - (1 - b) x_k)}{x_k}", true),
        ],
    );
}

#[test]
fn a_damped_oscillator() {
    let symbols = r#"parameters = ["c", "s", "h", '\zeta']
states = ["x", "v"]
relations = ["s^2 = 1 - c^2"]
[symbols.maps]
M = ['x_{k+1} = h (c x_k + s v_k)', 'v_{k+1} = h (-s x_k + c v_k)']"#;
    own(
        symbols,
        &[],
        &[
            ("Det(M) = h^2", true),
            ("Tr(M) = 2 h c", true),
            ("Det(M) = h", false),
            ("c^2 + s^2 = 1", true),
            ("s^4 = 1 - 2 c^2 + c^4", true),
            ("s^3 = s - c^2 s", true),
            ("s = 1 - c", false),
        ],
    );
    own(
        symbols,
        &[("map", "x_{k+1} = h (c x_k + s v_k), v_{k+1} = h (-s x_k + c v_k)")],
        &[
            ("x_{k+1}^2 + v_{k+1}^2 = h^2 (x_k^2 + v_k^2)", true),
            ("x_{k+1}^2 - v_{k+1}^2 = h^2 (x_k^2 - v_k^2)", false),
        ],
    );
}

#[test]
fn a_linear_impact_oscillator() {
    let table = r#"parameters = ["r", "c", "d", '\tau']
generic = ["r", "c"]
times = ["t", "t_n", "t_{n+1}"]
states = ["v"]
functions = { S = "C", C = "" }
periods = { S = '2 \tau' }
abbreviations = { D = "t_{n+1} - t_n" }
[symbols.maps]
P = { of = ["t_{n+1}", "v_{n+1}"], by = ["t_n", "v_n"] }"#;
    let list = table
        .replace(r#"{ S = "C", C = "" }"#, r#"["S = C", "C"]"#)
        .replace(r"{ S = '2 \tau' }", r"['S = 2 \tau']")
        .replace(r#"{ D = "t_{n+1} - t_n" }"#, r#"["D = t_{n+1} - t_n"]"#);
    for symbols in [table, &list] {
        own(
            symbols,
            &[
                ("speed", "v_{n+1} = -r v_n + c D + S(t_{n+1}) - S(t_n)"),
                ("place", "d = -r v_n D + S(t_{n+1})"),
            ],
            &[
                (
                    r"\frac{\partial t_{n+1}}{\partial v_n} = \frac{r D}{C(t_{n+1}) - r v_n}",
                    true,
                ),
                (
                    r"\frac{\partial t_{n+1}}{\partial t_n} = \frac{-r v_n}{C(t_{n+1}) - r v_n}",
                    true,
                ),
                (
                    r"\frac{\partial t_{n+1}}{\partial t_n} = \frac{r v_n}{C(t_{n+1}) - r v_n}",
                    false,
                ),
                (
                    r"\frac{\partial v_{n+1}}{\partial v_n} = -r + (c + C(t_{n+1})) \frac{\partial t_{n+1}}{\partial v_n}",
                    true,
                ),
                (r"S(t_n + 2 \tau) = S(t_n)", true),
                (r"C(t_n - 4 \tau) = C(t_n)", true),
                (r"S(t_n + \tau) = S(t_n)", false),
                (r"D = t_{n+1} - t_n", true),
                (r"v_{n+1} = -r v_n + c (t_{n+1} - t_n) + S(t_{n+1}) - S(t_n)", true),
                (r"S'(t_n) = C(t_n)", true),
            ],
        );
    }
}

#[test]
fn wrong_vocabularies() {
    let with = |symbols: &str| {
        format!(
            "title = \"x\"\n[symbols]\n{symbols}\n\n{}{}",
            premise("1", "a = b"),
            claim("2", "a = b", "\"1\"")
        )
    };
    let mut wrong: Vec<String> = Vec::new();
    for (symbols, word) in [
        ("parameters = \"a\"", ""),
        ("parameters = [1]", ""),
        ("colours = [\"a\"]", "colours"),
        ("parameters = [\"a\", \"b\", \"a\"]", "twice"),
        ("parameters = [\"a\", \"b + c\"]", "b + c"),
        ("parameters = [\"a\", \"b\", \"\"]", ""),
        ("parameters = [\"a\", \"b\"]\nfunctions = { a = \"\" }", "twice"),
        ("parameters = [\"a\", \"b\"]\nfunctions = { f = \"(\" }", "("),
        ("parameters = [\"a\", \"b\"]\nabbreviations = [\"a = b = c\"]", "="),
        ("parameters = [\"a\", \"b\"]\nabbreviations = [\"c = x\"]", "x"),
        ("parameters = [\"a\", \"b\"]\nabbreviations = [\"c\"]", "c"),
        ("parameters = [\"a\", \"b\"]\ntimes = [\"t_{B}\"]", "t_B"),
        ("parameters = [\"a\", \"b\"]\n[symbols.maps]\nM = [\"N\"]", "N"),
        (
            "parameters = [\"a\", \"b\"]\nstates = [\"x\"]\n[symbols.maps]\nM = [\"x_{k+1} = q x_k\"]",
            "q",
        ),
        (
            "parameters = [\"a\", \"b\"]\nstates = [\"x\"]\n[symbols.maps]\nM = { of = [\"x_{k+1}\"] }",
            "M",
        ),
        (
            "parameters = [\"a\", \"b\"]\nstates = [\"x\"]\n[symbols.maps]\nM = { of = [\"a\"], by = [\"x_k\"] }",
            "M",
        ),
    ] {
        match audit(&with(symbols)) {
            Ok(_) => wrong.push(format!("accepted: {symbols}")),
            Err(fault) if !fault.to_string().contains(word) => {
                wrong.push(format!("{symbols}\n`{word}` is missing in: {fault}"));
            }
            Err(fault) if fault.place.is_none() => wrong.push(format!("{symbols}\nno place: {fault}")),
            Err(_) => {}
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
