//! Sheets as people hand them in: with mistakes, each of which says what and where, and stops nothing that can be
//! decided all the same; with a vocabulary of their own; with odd characters; large.

use crate::common::paper;

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

/// The row of an entry that cannot be read, with every word its reason must say and the line it must name.
fn unread(text: &str, label: &str, words: &[&str], line: Option<usize>) {
    let decisions = audit(text).unwrap_or_else(|fault| panic!("{text}\n{fault}"));
    let row = decisions.iter().find(|decision| decision.label == label);
    let row = row.unwrap_or_else(|| panic!("{text}\nno row for {label}: {decisions:?}"));
    assert_eq!(row.verdict, Verdict::Unread, "{text}\n{row:?}");
    for word in words {
        assert!(
            row.reason.contains(word),
            "{text}\n`{word}` is missing in: {}",
            row.reason
        );
    }
    assert!(row.place.is_some(), "{text}\n{row:?}");
    if let Some(line) = line {
        assert_eq!(row.place.map(|(line, _)| line), Some(line), "{text}\n{row:?}");
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
fn a_claim_with_several_readings_is_decided_in_each_and_says_which_is_taken() {
    let symbols =
        "title = 'readings'\n[symbols]\nparameters = ['x', 'y', 'a', 'b']\nabbreviations = ['M = \\log 100']\n";
    let given = equation("V", "definition", "V = a x^2 + b", "")
        + &equation("R", "definition", "R(x) = a x^3", "")
        + &equation("L", "definition", r"L = \log 100", "")
        + &equation("S", "definition", r"S = \sum_{k=1}^{n} k", "");
    for (tex, from, verdict, reading) in [
        // usual, or the same in all
        (r"\exp x \exp y = e^{x + y}", "", Verdict::Proved, r"`\exp(x) \exp(y)`"),
        (r"\sin x \cos y = \cos y \sin x", "", Verdict::Proved, ""),
        ("a/b x - a/b x = 0", "", Verdict::Proved, r"`\frac{a}{b} x`"),
        (
            r"\sum_{k=1}^{n} k + 1 = 1 + \sum_{k=1}^{n} k",
            "",
            Verdict::Proved,
            "up to the next sign",
        ),
        ("V(x^2) = a x^4 + b", "V", Verdict::Proved, "the value of `V` at `x^2`"),
        ("(x + 1) V = V(x + 1)", "V", Verdict::Proved, "`V` times `x + 1`"),
        (
            r"\frac{\partial R}{\partial x}(2) = 12 a",
            "R",
            Verdict::Proved,
            "where the derivative is taken",
        ),
        (
            r"\frac{d}{dx} \log x = \frac{1}{x}",
            "",
            Verdict::Proved,
            r"`\log`: natural",
        ),
        (
            r"\log_{10} x = \frac{\log x}{\log 10}",
            "",
            Verdict::Proved,
            r"`\log`: natural",
        ),
        (r"\log(2 x) - \log x = \log 2", "", Verdict::Proved, r"`\log`: natural"),
        // true in one of them
        (r"\log 100 = 2", "", Verdict::Undecided, r"`\log`: natural"),
        (r"\log 8 = 3", "", Verdict::Undecided, r"`\log`: natural"),
        (
            r"\log x = \frac{\ln x}{\ln 10}",
            "",
            Verdict::Undecided,
            r"`\log`: natural",
        ),
        (r"L = 2", "L", Verdict::Undecided, r"`\log`: natural"),
        (r"M + x = 2 + x", "", Verdict::Undecided, r"`\log`: natural"),
        (r"\sin x y = y \sin x", "", Verdict::Undecided, r"`\sin(x) y`"),
        (r"\sin x y = \sin(x y)", "", Verdict::Undecided, r"`\sin(x) y`"),
        (r"a/b x = \frac{a}{b x}", "", Verdict::Undecided, r"`\frac{a}{b} x`"),
        (r"\cos x y/2 = \cos\frac{x y}{2}", "", Verdict::Undecided, r"\cos(x) y"),
        (r"1/2 a = \frac{a}{2}", "", Verdict::Undecided, r"`\frac{1}{2} a`"),
        (r"x^{1/2 a} = x^{a/2}", "", Verdict::Undecided, r"`\frac{1}{2} a`"),
        ("V(x^2) = x^2 V", "V", Verdict::Undecided, "the value of `V` at `x^2`"),
        // the letter of the sum is no argument
        (
            r"S(k^2) = \sum_{k=1}^{n} k^2",
            "S",
            Verdict::Undecided,
            "`S` times `k^2`",
        ),
        // false in all
        ("a/b x = a/b y", "", Verdict::Refuted, r"`\frac{a}{b} x`"),
        (r"\log(3 x) = 3 \log x", "", Verdict::Refuted, r"`\log`: natural"),
        (r"L = 3", "L", Verdict::Refuted, r"`\log`: natural"),
        (r"M = 3", "", Verdict::Refuted, r"`\log`: natural"),
        (r"\cos x y/2 = 5", "", Verdict::Refuted, r"\cos(x) y"),
    ] {
        let from = if from.is_empty() {
            String::new()
        } else {
            format!("follows_from = ['{from}']")
        };
        let decided = audit(&format!(
            "{symbols}integers = ['n', 'k']\n{given}{}",
            equation("1", "claim", tex, &from)
        ));
        let row = decided.unwrap().pop().unwrap();
        assert_eq!(row.verdict, verdict, "{tex}: {}", row.reason);
        let shown = row.readings.join("; ");
        assert!(
            shown.contains(reading) && shown.is_empty() == reading.is_empty(),
            "{tex}: {shown}"
        );
    }
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
    // a label that is not there is of its row alone
    let text = premise("1", TRUE) + &claim("2", TRUE, "\"7\"") + &claim("3", TRUE, "\"1\"");
    unread(&text, "2", &["`7`", "1"], Some(10));
    assert_eq!(verdicts(&text)[1], ("3".to_string(), Verdict::Proved));
    // An identity follows from nothing.
    let identity = r"(T_1 + T_2)^2 - T_1^2 = T_2 (2 T_1 + T_2)";
    for text in [claim("2", identity, ""), equation("2", "claim", identity, "")] {
        assert_eq!(verdicts(&text), [("2".to_string(), Verdict::Proved)]);
    }
    assert_eq!(verdicts(&claim("2", TRUE, "")), [("2".to_string(), Verdict::Refuted)]);
    // what is its own premise is unread, and nothing else is
    unread(&claim("2", TRUE, "\"2\""), "2", &["itself"], None);
    let circle = |length: usize| -> String {
        let follows = |n: usize| format!("\"{}\"", (n + 1) % length);
        (0..length).map(|n| claim(&n.to_string(), TRUE, &follows(n))).collect()
    };
    for length in [2, 60] {
        let decisions = audit(&circle(length)).unwrap();
        let unread = decisions.iter().filter(|row| row.reason.contains("itself"));
        assert!(unread.map(|row| row.verdict).eq([Verdict::Unread]), "{decisions:?}");
        // what follows from the one that is unread waits, all else is taken as given
        assert_eq!(
            decisions.iter().filter(|row| row.verdict == Verdict::Undecided).count(),
            1
        );
    }
    let text = premise("1", TRUE) + &claim("4", TRUE, "\"1\"") + &claim("5", TRUE, "\"1\", \"5\"");
    unread(&text, "5", &["itself"], None);
    assert_eq!(verdicts(&text)[0], ("4".to_string(), Verdict::Proved));
}

#[test]
fn formulas_that_cannot_be_read() {
    let with = |tex: &str| premise("1", TRUE) + &claim("2", tex, "\"1\"");
    for (tex, column) in [
        (r"T = \frac{1}{2", 11),
        (r"T = T_1 + ", 18),
        (r"T = (T_1 + T_2]", 22),
        (r"T = T_1 +* T_2", 17),
        (r"T = T_1 T_2)", 19),
        (r"T = \unknowncommand", 12),
        (r"T = T_1^{x}", 15),
        (r"T_1", 8),
        (r"", 8),
    ] {
        let text = with(tex);
        unread(&text, "2", &[], Some(9));
        let sheet = Sheet::read(&text, &vocabulary()).unwrap();
        let fault = sheet.entries[1].unread.as_ref().unwrap();
        assert!(
            fault.place.is_some_and(|(_, found)| found >= 7 && found <= column + 12),
            "{tex}: {fault}"
        );
        assert!(fault.to_string().contains('^'), "{tex}: {fault}");
    }
    // Definitions that nothing follows from are kept verbatim.
    assert_eq!(
        verdicts(&(with(TRUE) + &equation("3", "definition", r"\oint \langle x", ""))).len(),
        1
    );
}

/// A sheet with faults of every kind, and right claims between them.
#[test]
fn what_cannot_be_read_stops_nothing_else() {
    let text = premise("1", TRUE)
        + &premise("2", r"T = \frac{1}")
        + &claim("3", "T_1 = T - T_2", "\"1\"")
        + &claim("4", "T_1 = T - T_2", "\"1\", \"2\"")
        + &equation("5", "claim", TRUE, "follows_from = [\"1\"]\nassume = ['''T < ''']")
        + &equation(
            "6",
            "claim",
            "T = (",
            "where = ['''x = ''']\nwith = ['''q = r''', '''r = )''']",
        )
        + &equation("7", "definition", r"\Theta = \oint", "")
        + &claim("8", r"\Theta = 1", "\"7\"")
        + &claim("9", "T_2 = T_1 - T", "\"1\"")
        + &claim("10", "T_2 = T", "\"6\"")
        + &claim("11", r"\lambda > 1", "")
        + &equation("12", "claim", "T = x + y_1 + x", "expect = \"unread\"");
    let decisions = audit(&text).unwrap();
    let found: Vec<(&str, Verdict)> = decisions.iter().map(|d| (d.label.as_str(), d.verdict)).collect();
    let wanted = [
        ("2", Verdict::Unread),
        ("3", Verdict::Proved),
        ("4", Verdict::Undecided),
        ("5", Verdict::Unread),
        ("6", Verdict::Unread),
        ("7", Verdict::Unread),
        ("8", Verdict::Undecided),
        ("9", Verdict::Refuted),
        ("10", Verdict::Undecided),
        ("11", Verdict::Unread),
        ("12", Verdict::Unread),
    ];
    assert_eq!(found, wanted);
    let row = |label: &str| decisions.iter().find(|d| d.label == label).unwrap();
    let says = |label: &str, part: &str| assert!(row(label).reason.contains(part), "{:?}", row(label));
    says("4", "rests on (2), which cannot be read");
    says("8", "rests on (7)");
    says("10", "rests on (6)");
    says("11", "no order");
    // Each fault of an entry is there, and each unknown name once.
    assert_eq!(row("6").reason.matches("line ").count(), 2, "{:?}", row("6"));
    says("12", "`y_1`");
    assert_eq!(row("12").reason.matches("`x`").count(), 1, "{:?}", row("12"));
    assert!(row("12").is_expected());
}

#[test]
fn symbols_that_nobody_knows() {
    let base = premise("1", TRUE);
    for (tex, word) in [
        ("T = T_1 + x", "unknown symbol `x`"),
        ("x = T_1 + T_2", "`x`"),
        ("T = r_C", "`r_C`, did you mean `r_B`?"),
        ("T = F_3(t_k)", "`F_3`"),
        ("T = T_3", "`T_3`, did you mean `T_1`?"),
        (r"T = \overline{G}", r"`\overline{G}`, did you mean `\overline{g}`?"),
        (r"T = DP", "Tr(DP)"),
        (r"\dot{Z}^-(t) = T", "time of an impact"),
        (r"\frac{\partial T}{\partial r} = 0", "no map"),
        (r"\frac{\partial t_k}{\partial t_{k+1}} = 0", "no map"),
        (r"\frac{\partial t_k}{\partial q} = 0", "`q`"),
        ("q_{1,2} = 1", "`q_{1,2}`"),
    ] {
        unread(&(base.clone() + &claim("2", tex, "\"1\"")), "2", &[word], Some(9));
    }
    let known = base.clone() + &claim("2", "T = T_1 + x", "\"1\"");
    unread(&known, "2", &["known: r, r_B"], Some(9));
    // On either side of a premise too, whatever follows from it.
    for tex in ["T = T_1 + x T_2", "x = T_1 + T_2", "T_1 = T, x = T"] {
        let text = premise("1", tex) + &claim("2", TRUE, "\"1\"") + &claim("3", "T_1 = t_{k+1} - t_k", "");
        unread(&text, "1", &["`x`"], Some(4));
        let wanted = [("2", Verdict::Undecided), ("3", Verdict::Proved)];
        assert_eq!(
            verdicts(&text)[1..],
            wanted.map(|(label, verdict)| (label.to_string(), verdict))
        );
    }
    for more in [
        "where = ['''\\epsilon_1 = T_1 + x''']",
        "with = ['''x = T_1''']",
        "with = ['''T_1 = x''']",
        "with = ['''k = T_1''']",
        "assume = ['''T > x''']",
        "assume = ['''x \\in \\mathbb{Z}''']",
    ] {
        let more = format!("follows_from = [\"1\"]\n{more}");
        unread(
            &(base.clone() + &equation("2", "claim", TRUE, &more)),
            "2",
            &[],
            Some(11),
        );
    }
}

#[test]
fn constants_that_everybody_knows() {
    let proved = [("2".to_string(), Verdict::Proved)];
    let identity = r"(e + i)^2 + \pi = e^2 + 2 e i - 1 + \pi";
    assert_eq!(verdicts(&claim("2", identity, "")), proved);
    let more = "where = ['''e = T_1''']";
    assert_eq!(verdicts(&equation("2", "claim", "e = t_{k+1} - t_k", more)), proved);
}

#[test]
fn local_definitions() {
    let with = |list: &str, tex: &str| {
        let more = format!("follows_from = [\"1\"]\nwhere = [{list}]");
        premise("1", TRUE) + &equation("2", "claim", tex, &more)
    };
    let twice = r"'''\epsilon_1 = T_1''', '''\epsilon_1 = T_2'''";
    unread(&with(twice, r"T = \epsilon_1 + T_2"), "2", &["twice"], Some(11));
    let itself = r"'''\epsilon_1 = \epsilon_1 + T_1'''";
    unread(
        &with(itself, r"T = \epsilon_1 + T_2"),
        "2",
        &[r"\epsilon_1", "itself"],
        None,
    );
    let circle = r"'''\epsilon_1 = \epsilon_2''', '''\epsilon_2 = \epsilon_1'''";
    unread(&with(circle, r"T = \epsilon_1 + T_2"), "2", &["itself"], None);
    let broken = r"'''\epsilon_1 = \frac{T_1}{'''";
    unread(&with(broken, r"T = \epsilon_1 + T_2"), "2", &[], Some(11));
    // In any order, and unused ones are no harm.
    let good = r"'''\epsilon_2 = 2 \epsilon_1''', '''\epsilon_1 = T_1''', '''x = 5'''";
    assert_eq!(
        verdicts(&with(good, r"T = \frac{\epsilon_2}{2} + T_2"))[0].1,
        Verdict::Proved
    );
    // A new symbol alone on a left side is defined for that equation alone.
    let row = with("", r"T = \Theta + T_2, \Theta = T_1");
    assert_eq!(verdicts(&row)[0].1, Verdict::Proved);
    unread(
        &(row + &claim("3", r"T - T_2 = \Theta", "\"2\"")),
        "3",
        &[r"\Theta"],
        None,
    );
}

/// A definition gives its symbol to whatever follows from it, over other definitions too.
#[test]
fn definitions_that_others_use() {
    let definition = |label: &str, tex: &str, more: &str| equation(label, "definition", tex, more);
    let delay = definition("delay", r"\tau = 2 \rho", "where = ['''\\rho = T_1''']");
    let proved = |text: String, label: &str| {
        let found = verdicts(&text);
        assert!(
            found.contains(&(label.to_string(), Verdict::Proved)),
            "{text}\n{found:?}"
        );
    };
    let square = r"\tau^2 = 4 T_1^2";
    proved(delay.clone() + &claim("2", square, "\"delay\""), "2");
    unread(&(delay.clone() + &claim("2", square, "")), "2", &[r"\tau"], None);
    // What stands beside a definition stays there.
    let beside = delay.clone() + &claim("2", r"\tau = 2 \rho", "\"delay\"");
    unread(&beside, "2", &[r"`\rho`"], None);
    let twice = definition("twice", r"\sigma = 2 \tau", "follows_from = [\"delay\"]");
    proved(
        delay.clone() + &twice + &claim("2", r"\sigma = 4 T_1", "\"twice\""),
        "2",
    );
    // A premise may use the symbol where the claim follows from the definition too.
    let law = premise("law", r"T = \tau");
    proved(
        delay.clone() + &law + &claim("2", r"T = 2 T_1", "\"law\", \"delay\""),
        "2",
    );
    let text = delay + &law + &claim("2", r"T = 2 T_1", "\"law\"") + &claim("3", r"\tau = 1", "\"delay\"");
    unread(&text, "2", &["(2) must follow from (delay) too"], None);
    let circle = definition("a", r"\sigma = 2 \tau", "follows_from = [\"b\"]")
        + &definition("b", r"\tau = 2 \sigma", "follows_from = [\"a\"]");
    unread(&(circle + &claim("2", r"\tau = 1", "\"a\"")), "2", &["itself"], None);
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
        let decisions = audit(&two(a, b)).unwrap();
        let row = &decisions[0];
        assert_eq!(row.verdict, Verdict::Undecided, "{a}; {b}: {row:?}");
        assert!(row.reason.contains("contradict"), "{a}; {b}: {row:?}");
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
    unread(&odd, "∂2", &["é"], Some(9));
    let basic = text.replace("'''T_1 = T - T_2'''", "\"\\u0054_1 = T - T_2 + x\"");
    unread(&basic, "2", &["`x`"], Some(9));
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
        let text = format!("[symbols]\n{symbols}\n\n{}", sheet(&premises, tex, &[], &[]));
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
fn kinds_of_symbols() {
    let sheet = |tex: &str, more: &str| {
        format!(
            "[symbols]\npositive = ['a']\nnonnegative = ['b']\nnonzero = ['c']\nintegers = ['p']\n\
             complex = ['z']\nparameters = ['a', 'x']\n\n{}",
            equation("1", "claim", tex, more)
        )
    };
    let verdict = |tex: &str, more: &str| verdicts(&sheet(tex, more))[0].1;
    for (tex, more, wanted) in [
        (r"\sqrt{a^2} = a", "", Verdict::Proved),
        (r"\sqrt{b^2} = b", "", Verdict::Proved),
        (r"\sqrt{x^2} = x", "", Verdict::Refuted),
        (r"\sqrt{x^2} = x", "assume = ['x \\ge 0']", Verdict::Proved),
        (r"c^2 > 0", "", Verdict::Proved),
        (r"x^2 > 0", "", Verdict::Refuted),
        (r"x^2 > 0", "assume = ['x \\neq 0']", Verdict::Proved),
        (r"\sin(\pi p) = 0", "", Verdict::Proved),
        (r"\sin(\pi x) = 0", "", Verdict::Refuted),
        (r"\sin(\pi x) = 0", "assume = ['x \\in \\mathbb{Z}']", Verdict::Proved),
        (r"z^2 + 1 = (z + i)(z - i)", "", Verdict::Proved),
        (r"\sqrt{z^2} = z", "", Verdict::Refuted),
        (r"z^2 \ge 0", "", Verdict::Unread),
        (r"w \ge 0", "where = ['w = z^2']", Verdict::Unread),
        (r"i x \le 0", "", Verdict::Unread),
        (r"x = x", "assume = ['z > 0']", Verdict::Unread),
    ] {
        assert_eq!(verdict(tex, more), wanted, "{tex} {more}");
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
        ("parameters = [\"a\", \"b\"]\ngeneric = [\"c\"]", "c"),
        (
            "parameters = [\"a\", \"b\"]\ncomplex = [\"z\"]\npositive = [\"z\"]",
            "complex",
        ),
        ("parameters = [\"a\", \"b\"]\nindices = [\"n_1\"]", "one letter"),
        ("parameters = [\"a\", \"b\"]\nindices = [\"a\"]", "twice"),
        (
            "parameters = [\"a\", \"b\"]\nabbreviations = [\"c = 2 h\", \"h = 2 c\"]",
            "itself",
        ),
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

#[test]
fn what_prints_nothing_parts_statements_as_blanks_do() {
    let text = "[symbols]\nparameters = ['a', 'b']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = 'a = a \\phantom{aa} b = b'\n";
    assert_eq!(verdicts(text), [("1".to_owned(), Verdict::Proved)]);
}

#[test]
fn a_refutation_is_never_as_expected_where_proofs_are() {
    for standing in ["law", "link", "open"] {
        let text = format!(
            "[symbols]\nparameters = ['a', 'b']\n[[equation]]\nlabel = '1'\nrole = 'claim'\nstanding = '{standing}'\ntex = 'a + b = a'\n"
        );
        let decision = audit(&text).unwrap().remove(0);
        assert_eq!(
            (decision.verdict, decision.is_expected()),
            (Verdict::Refuted, false),
            "{standing}"
        );
    }
}

#[test]
fn powers_with_letters_as_exponents_are_multiplied_at_positive_bases() {
    let decide = |tex: &str| {
        let text = format!(
            "[symbols]\nparameters = ['K', 'L', 'a', 'b']\nintegers = ['n']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '{tex}'\n"
        );
        let sheet = Sheet::read(&text, &vocabulary()).unwrap();
        let decision = prove::decide(&sheet, 0, &Options::default());
        (decision.verdict, decision.provided.join("; "))
    };
    let proved = |provided: &str| (Verdict::Proved, provided.to_owned());
    assert_eq!(decide(r"K^a L^{1-a} = L \left(\frac{K}{L}\right)^a"), proved("L > 0"));
    assert_eq!(
        decide(r"\frac{\partial}{\partial K} K^a = a \frac{K^a}{K}"),
        proved("K > 0")
    );
    // where K is 0 both sides are, or have no value
    assert_eq!(decide("K^{a + b} = K^a K^b"), proved(""));
    // of integers the base may be negative
    assert_eq!(decide("K^{n + 1} = K K^n"), proved(r"K \neq 0"));
    for wrong in ["(K + L)^a = K^a + L^a", "K^{a b} = K^a K^b", "(K L)^a = K^a L"] {
        assert_ne!(decide(wrong).0, Verdict::Proved, "{wrong}");
    }
}

#[test]
fn an_antiderivative_may_be_asked_for_under_conditions_but_not_at_one_point() {
    let decide = |tex: &str, assume: &str| {
        let text = format!(
            "[symbols]\nparameters = ['a', 'b', 'x']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '{tex}'\nassume = ['{assume}']\n"
        );
        let sheet = Sheet::read(&text, &vocabulary()).unwrap();
        prove::decide(&sheet, 0, &Options::default()).verdict
    };
    assert_eq!(decide(r"\int \frac{1}{x} \, dx = \ln x + C", "x > 0"), Verdict::Proved);
    let cosine = r"\int \cos(a x) \, dx = \frac{\sin(a x)}{a} + C";
    assert_eq!(decide(cosine, "b = 1"), Verdict::Proved);
    assert_eq!(decide(r"\int x \, dx = x + C", "x = 1"), Verdict::Undecided);
}

/// The verdict of a claim without premises, and what is provided.
fn decide(symbols: &str, tex: &str) -> (Verdict, String) {
    let text = format!("[symbols]\n{symbols}\n{}", equation("1", "claim", tex, ""));
    let decision = audit(&text).unwrap().remove(0);
    (decision.verdict, decision.provided.join("; "))
}

/// Checks the verdicts of claims, each with what it follows from, its premises first.
fn verdicts_of(symbols: &str, premises: &[(&str, &str)], claims: &[(&str, &str, Verdict)]) {
    let premises: String = premises.iter().map(|(label, tex)| premise(label, tex)).collect();
    for (number, (from, tex, wanted)) in claims.iter().enumerate() {
        let (label, from) = (format!("c{number}"), format!("follows_from = [{from}]\n"));
        let text = format!(
            "[symbols]\n{symbols}\n{premises}{}",
            equation(&label, "claim", tex, &from)
        );
        let decisions = audit(&text).unwrap();
        let decision = decisions.iter().find(|own| own.label == label).unwrap();
        assert_eq!(decision.verdict, *wanted, "{tex}: {}", decision.reason);
    }
}

#[test]
fn members_of_sequences_are_taken_at_each_index_that_a_claim_reaches() {
    let premises = [
        ("q", "a_n = n^2"),
        ("z", r"b_n = \frac{1}{n}"),
        ("x", r"\phi_{n+1} = \phi_n + v_n"),
        ("v", r"v_{n+1} = \alpha v_n - \gamma \cos\phi_{n+1}"),
        ("g", "g_n = d^n"),
    ];
    verdicts_of(
        "parameters = ['\\alpha', '\\gamma', 'd']\nstates = ['a', 'b', 'v', '\\phi', 'g']\nindices = ['n']",
        &premises,
        &[
            ("'q'", "a_{n+1} - a_n = 2 n + 1", Verdict::Proved),
            ("'q'", "a_{n+1} - a_n = 2 n + 2", Verdict::Refuted),
            ("'q'", "a_{2n} = 4 n^2", Verdict::Proved),
            ("'q'", "a_{2n+1} - a_{2n} = 4 n", Verdict::Refuted),
            // two indices
            ("'q'", "a_{02n} = 4 n^2", Verdict::Unread),
            ("'q'", "a_{1n} = n^2", Verdict::Unread),
            ("'q', 'z'", "a_{n+1} b_n = n + 2 + b_n", Verdict::Proved),
            ("'z'", r"b_{n+1} - b_n = -\frac{1}{n (n + 1)}", Verdict::Proved),
            ("'g'", "g_{n+1} = d g_n", Verdict::Proved),
            ("'g'", "g_{n-1} g_{n+1} = g_n^2", Verdict::Proved),
            ("'g'", "g_{2n} = 2 g_n", Verdict::Refuted),
            (
                "'x', 'v'",
                r"v_{n+2} = \alpha^2 v_n - \gamma (\alpha \cos\phi_{n+1} + \cos\phi_{n+2})",
                Verdict::Proved,
            ),
            (
                "'x', 'v'",
                r"v_{n+2} = \alpha^2 v_n - \gamma (\alpha \cos\phi_{n+1} - \cos\phi_{n+2})",
                Verdict::Refuted,
            ),
            (
                "'x'",
                r"\phi_{n+2} - 2 \phi_{n+1} + \phi_n = v_{n+1} - v_n",
                Verdict::Proved,
            ),
        ],
    );
}

#[test]
fn a_way_of_an_equivalence_has_a_value_wherever_the_other_side_holds() {
    let symbols = "parameters = ['x', 't']\nfunctions = ['f']";
    let ways = |tex: &str| {
        let text = format!("[symbols]\n{symbols}\n{}", equation("1", "claim", tex, ""));
        let decisions = audit(&text).unwrap();
        [0, 1].map(|way| decisions[way].verdict)
    };
    use Verdict::{Proved, Refuted, Undecided};
    for (tex, wanted) in [
        // x = 0 solves the left side alone, where the right one has no value
        (
            r"x (x - 1) = 0 \Leftrightarrow \int_0^1 \frac{1}{x} dt = 1",
            [Undecided, Proved],
        ),
        (
            r"x - 1 = 0 \Leftrightarrow \int_0^1 \frac{1}{x} dt = 1",
            [Proved, Proved],
        ),
        (r"x - 1 = 0 \Leftrightarrow \int_0^x 2 t dt = 1", [Proved, Refuted]),
        (
            r"x (x - 1) = 0 \Leftrightarrow \frac{f(x)}{x} = f(x)",
            [Undecided, Refuted],
        ),
        (r"x^2 = x \Leftrightarrow \frac{|x|}{x} = 1", [Undecided, Refuted]),
        // the integral has a value where x > 1 alone
        (
            r"x \neq 1 \Leftrightarrow \int_1^\infty t^{-x} dt = \frac{1}{x-1}",
            [Undecided, Undecided],
        ),
        (
            r"x > 1 \Leftrightarrow \int_1^\infty t^{-x} dt = \frac{1}{x-1}",
            [Proved, Undecided],
        ),
        (
            r"x \neq 0 \Leftrightarrow \int_0^\infty e^{-x t} dt = \frac{1}{x}",
            [Undecided, Undecided],
        ),
    ] {
        assert_eq!(ways(tex), wanted, "{tex}");
    }
}

#[test]
fn premises_that_contradict_each_other_further_on_prove_nothing() {
    // a_{n+1} = a_n + 1 beside a_n = n^2, which no sequence satisfies
    let premises = [("q", "a_n = n^2"), ("s", "a_{n+1} = a_n + 1"), ("z", "a_0 = 1")];
    verdicts_of(
        "parameters = ['c']\nstates = ['a', 'b']\nindices = ['n']",
        &premises,
        &[
            ("'q', 's'", "a_{n+1} - a_n = 1", Verdict::Undecided),
            ("'q', 'z'", "a_{n+1} - a_n = 2 n + 1", Verdict::Undecided),
        ],
    );
}

#[test]
fn a_map_from_one_index_to_the_next_is_read_for_each_where_a_claim_goes_on() {
    let premises = [
        ("x", r"\phi_{k+1} = \phi_k + v_k"),
        ("v", r"v_{k+1} = \alpha v_k - \gamma \cos(\phi_k + v_k)"),
    ];
    verdicts_of(
        "parameters = ['\\alpha', '\\gamma']\nstates = ['v', '\\phi']",
        &premises,
        &[
            (
                "'x', 'v'",
                r"v_{k+2} = \alpha v_{k+1} - \gamma \cos\phi_{k+2}",
                Verdict::Proved,
            ),
            (
                "'x', 'v'",
                r"v_{k+2} = \alpha v_{k+1} + \gamma \cos\phi_{k+2}",
                Verdict::Undecided,
            ),
        ],
    );
}

#[test]
fn the_laws_of_integer_powers_hold_at_bases_that_are_not_0() {
    let decide = |tex: &str| decide("parameters = ['x', 'y']\nintegers = ['n', 'm']", tex);
    for (tex, provided) in [
        ("x^{n+m} = x^n x^m", r"x \neq 0"),
        ("x^{n-m} = \\frac{x^n}{x^m}", r"x \neq 0"),
        ("(x y)^n = x^n y^n", r"x \neq 0; y \neq 0"),
        (
            "\\left(\\frac{x}{y}\\right)^n = \\frac{x^n}{y^n}",
            r"x \neq 0; y \neq 0",
        ),
        ("(x^n)^m = x^{n m}", r"x \neq 0"),
        ("x^{-n} = \\frac{1}{x^n}", r"x \neq 0"),
        ("(-x)^{2n+1} = -x^{2n+1}", r"x \neq 0"),
        ("(-1)^{2n} = 1", ""),
    ] {
        assert_eq!(decide(tex), (Verdict::Proved, provided.to_owned()), "{tex}");
    }
    for tex in [
        "x^{n+m} = x^n + x^m",
        "(-x)^n = -x^n",
        "(x^n)^m = x^{n+m}",
        "x^{-n} = -x^n",
    ] {
        assert_eq!(decide(tex).0, Verdict::Refuted, "{tex}");
    }
}

#[test]
fn what_follows_but_for_a_factor_of_a_premise_is_conditional() {
    let premises = [
        ("e", r"\beta S I - \gamma I = 0"),
        ("f", r"I (\beta S - \gamma) = 0"),
        ("g", "x y = x z"),
        ("h", "x y = 0"),
        ("i", "x^2 = x"),
    ];
    verdicts_of(
        "parameters = ['\\beta', 'S', 'I', '\\gamma', 'x', 'y', 'z']",
        &premises,
        &[
            ("'e'", r"S = \frac{\gamma}{\beta}", Verdict::Conditional),
            ("'f'", r"S = \frac{\gamma}{\beta}", Verdict::Conditional),
            ("'g'", "y = z", Verdict::Conditional),
            ("'g'", "y = 2 z", Verdict::Refuted),
            // a product of one term, and a point at which the claim holds nowhere
            ("'h'", "y = 0", Verdict::Refuted),
            ("'i'", "x = 1", Verdict::Refuted),
        ],
    );
}

#[test]
fn a_sum_to_infinity_is_taken_where_it_has_a_value() {
    let decide = |tex: &str| decide("parameters = ['a', 'b', 'q', 'x']", tex);
    let region = r"q > -1; q < 1; q \neq 0";
    for (tex, provided) in [
        (r"\sum_{k=0}^\infty q^k = \frac{1}{1-q}", region),
        (r"\sum_{k=0}^\infty a q^k = \frac{a}{1-q}", region),
        (r"\sum_{k=1}^\infty k q^{k-1} = \frac{1}{(1-q)^2}", region),
    ] {
        assert_eq!(decide(tex), (Verdict::Proved, provided.to_owned()), "{tex}");
    }
    // beyond the region all terms are 0 at one point, where the sum is 0
    for tex in [
        r"\sum_{k=0}^\infty (1-q) q^k = 1",
        r"\sum_{k=0}^\infty (x-2) x^k < 0",
        r"\sum_{k=0}^\infty \frac{x^2}{(1+x^2)^k} = 1 + x^2",
        r"\sum_{k=0}^\infty (x-3)(x-\frac12) x^k = 0 \Rightarrow x = \frac12",
        r"\sum_{k=0}^\infty (a-b) x^k = 0 \Rightarrow |x| < 1",
    ] {
        assert_eq!(decide(tex).0, Verdict::Refuted, "{tex}");
    }
    assert_eq!(decide(r"\sum_{k=1}^\infty (q^{k-1} - q^k) = 1").0, Verdict::Undecided);
}

#[test]
fn powers_are_decided_where_their_bases_are_0_too() {
    let symbols = "parameters = ['x', 'y']\npositive = ['p', 'q']\nintegers = ['n', 'm']";
    let decide = |tex: &str| decide(symbols, tex).0;
    for tex in [
        r"|x|^{2p} > 0",
        r"|x|^{p+1} > 0",
        r"|x|^p + |y|^p > 0",
        r"\frac{1}{1 + |x|^{2p}} < 1",
        r"|x|^p |x|^q = |x|^{p+q} + 1 - \operatorname{sgn}(x)^2",
        r"\begin{cases} |x|^p |x|^q & x \neq 0 \\ 5 & x = 0 \end{cases} = |x|^{p+q}",
    ] {
        assert_eq!(decide(tex), Verdict::Refuted, "{tex}");
    }
    for tex in [
        r"|x|^p |x|^q = |x|^{p+q}",
        r"|x|^{2p} \ge 0",
        r"x^{n-m} = \frac{x^n}{x^m}",
        r"(x y)^n = x^n y^n",
    ] {
        assert_eq!(decide(tex), Verdict::Proved, "{tex}");
    }
}

/// The verdict on a claim under assumptions.
fn verdict_under(symbols: &str, assume: &str, tex: &str) -> Verdict {
    let assume = format!("assume = [{assume}]");
    let text = format!("[symbols]\n{symbols}\n{}", equation("1", "claim", tex, &assume));
    audit(&text).unwrap_or_else(|fault| panic!("{tex}\n{fault}"))[0].verdict
}

#[test]
fn what_is_said_of_a_free_letter_is_not_said_of_a_bound_one() {
    let real = "parameters = ['a', 'b', 'x']";
    let positive = "parameters = ['x']\npositive = ['x']";
    for (symbols, assume, tex) in [
        (
            real,
            "'x > 0'",
            r"\left[ \lim_{t \to \infty} e^{-x t} \right]_{x=-1} = 0",
        ),
        (real, "'x > 0'", r"\lim_{x \to -1} \lim_{t \to \infty} e^{-x t} = 0"),
        (real, "'x > 0'", r"\sum_{x=-2}^{-1} \lim_{t \to \infty} e^{-x t} = 0"),
        (
            positive,
            "",
            r"\lim_{x \to -1} \left( \lim_{t \to \infty} e^{-x t} \right) = 0",
        ),
        (real, "'x > 0'", r"\left[ \int_1^x \frac{dt}{t^2} \right]_{x=-1} = 2"),
        (
            positive,
            "",
            r"\left[ \frac{d}{dx} \int_1^x \frac{dt}{t} \right]_{x=-1} = -1",
        ),
        (
            real,
            "",
            r"\int_{-1}^{1} \left( \lim_{t \to \infty} \arctan(x t) \right) dx = \frac{\pi |x|}{x}",
        ),
    ] {
        assert_ne!(verdict_under(symbols, assume, tex), Verdict::Proved, "{tex}");
    }
    let integers = "parameters = ['a', 'x', 'n']\nintegers = ['n']";
    let inner = r"\sum_{n=0}^{3} \left( \lim_{t \to \infty} \frac{n t}{1 + n t} \right) = 3";
    assert_ne!(verdict_under(integers, r"'n \ge 1'", inner), Verdict::Refuted);
    // of a letter by itself nothing changes
    for (assume, tex) in [
        ("'x > 0'", r"\lim_{x \to 0} \frac{\sin x}{x} = 1"),
        ("'x > 0'", r"\int_0^x x \, dx = \frac{x^2}{2}"),
        ("'x < 0'", r"\int_1^2 \frac{dx}{x} = \ln 2"),
        ("", r"\frac{d}{dx} \int_0^x x e^x \, dx = x e^x"),
    ] {
        assert_eq!(verdict_under(real, assume, tex), Verdict::Proved, "{tex}");
    }
}

#[test]
fn a_closed_sum_has_a_value_where_its_sum_has_one() {
    let integers = "parameters = ['q', 'n']\nintegers = ['n']";
    // with n = 0 the sum is empty and its term has no value
    let empty = r"\sum_{k=1}^{n} \frac{1}{n} = 1";
    assert_ne!(verdict_under(integers, r"'n \ge 0'", empty), Verdict::Proved);
    assert_eq!(verdict_under(integers, r"'n \ge 1'", empty), Verdict::Proved);
    let nested = r"\sum_{n=0}^{3} \sum_{k=1}^{n} \frac{1}{n} = 3";
    assert_ne!(verdict_under(integers, "", nested), Verdict::Refuted);
}

#[test]
fn a_premise_with_an_integral_says_what_it_assumes() {
    let of = |premise: &str, assume: &str, claim: &str| {
        let premise = equation("p", "premise", premise, &format!("assume = [{assume}]"));
        let claim = equation("1", "claim", claim, "follows_from = ['p']");
        let text = format!("[symbols]\nparameters = ['a', 'b', 'x']\n{premise}{claim}");
        audit(&text).unwrap()[0].verdict
    };
    assert_ne!(
        of(r"\int a x \, dx = \frac{a x^2}{2} + C", "'a > 0'", "|a| = a"),
        Verdict::Refuted
    );
    assert_ne!(
        of(r"\int \frac{dx}{a} = \frac{x}{a} + C", "", "a^2 > 0"),
        Verdict::Refuted
    );
}

#[test]
fn an_antiderivative_is_compared_where_its_letter_moves() {
    let real = "parameters = ['x', 'y']";
    for (assume, tex) in [
        (r"'x \ge 0', 'x \le 0'", r"\int x \, dx = x^3 + C"),
        (r"'x^2 \le 0'", r"\int x \, dx = x^3 + C"),
        (r"'(x - y)^2 \le 0'", r"\int y \, dx = \frac{x^2}{2} + C"),
    ] {
        assert_ne!(verdict_under(real, assume, tex), Verdict::Proved, "{tex}");
    }
    let half_line = verdict_under(real, r"'x \ge 0'", r"\int x \, dx = \frac{x^2}{2} + C");
    assert_eq!(half_line, Verdict::Proved);
}

#[test]
fn an_odd_root_that_is_written_as_a_power_has_no_value_at_negative_numbers_in_an_integral() {
    for tex in [
        r"\int_{-1}^{1} x^{1/3} e^{x} dx > 0",
        r"\int_0^1 \left( (-8)^{1/3} + e^{x^2} \right) dx < 0",
    ] {
        assert_ne!(verdict_under("parameters = ['a']", "", tex), Verdict::Proved, "{tex}");
    }
    for tex in [
        r"\int_0^1 x^{1/3} e^{x} dx > 1",
        r"\int_{-1}^{1} \sqrt[3]{x} e^{x} dx > 0",
    ] {
        assert_eq!(verdict_under("parameters = ['a']", "", tex), Verdict::Proved, "{tex}");
    }
}

#[test]
fn a_counterexample_names_the_numbers_that_stand_for_letters() {
    for (tex, name, value) in [
        (
            r"\int_0^\infty \frac{\cos(a x)}{x^2 + 1} dx = \frac{\pi}{2} e^{-a}",
            "a",
            "-1",
        ),
        (r"\lim_{t \to 0} \frac{\sqrt{a^2 + t^2} - |a|}{t} = 0", "a", "0"),
    ] {
        let text = format!("[symbols]\nparameters = ['a']\n{}", equation("1", "claim", tex, ""));
        let decision = audit(&text).unwrap().remove(0);
        assert_eq!(decision.verdict, Verdict::Refuted, "{tex}");
        let point = decision.counterexample.unwrap().point;
        assert!(point.contains(&(name.to_owned(), value.to_owned())), "{tex}: {point:?}");
    }
}

#[test]
fn powers_with_a_value_at_one_point_alone_prove_nothing() {
    let symbols = "parameters = ['a', 'x']\npositive = ['p']";
    for tex in [
        r"(-x)^a = 5 x^a",
        r"(-x)^p = 5 x^p",
        r"(x-1)^p = 7 (1-x)^p",
        r"(-|x|)^p = 7 |x|^p",
    ] {
        assert_ne!(verdict_under(symbols, "", tex), Verdict::Proved, "{tex}");
    }
    assert_ne!(verdict_under(symbols, "'x = 0'", "x^a = 5 x^a"), Verdict::Proved);
}

#[test]
fn what_is_said_to_be_finite_is_so_for_all_letters() {
    let real = "parameters = ['a', 'x']";
    for tex in [
        r"\sum_{k=0}^\infty x^k < \infty",
        r"\sum_{k=1}^\infty \frac{x^k}{k} < \infty",
        r"\int_0^\infty e^{-a x} dx < \infty",
        r"\int_0^\infty \frac{dx}{x^2 + a^2} < \infty",
    ] {
        assert_ne!(verdict_under(real, "", tex), Verdict::Proved, "{tex}");
    }
    for (assume, tex) in [
        ("'x > -1', 'x < 1'", r"\sum_{k=0}^\infty x^k < \infty"),
        ("'a > 0'", r"\int_0^\infty e^{-a x} dx < \infty"),
        ("", r"\sum_{k=1}^\infty \frac{1}{k^2} < \infty"),
        ("", r"\sum_{k=0}^\infty 2^k = \infty"),
    ] {
        assert_eq!(verdict_under(real, assume, tex), Verdict::Proved, "{tex}");
    }
    // two sums, of which one is infinite
    let both = r"\sum_{k=-\infty}^\infty 2^k = \infty";
    assert_ne!(verdict_under(real, "", both), Verdict::Refuted);
}

#[test]
fn a_function_without_its_argument_is_not_taken_to_be_constant() {
    let symbols = "parameters = ['x', 'a', 'b']\nfunctions = ['f', 'g']";
    for tex in [
        r"\frac{d}{dx} f^2 = 0",
        r"\frac{d}{dx} (f g) = f' g + f g'",
        r"\int_a^b f \, dx = (b - a) f",
        r"\int f \, dx = x f + C",
        r"\lim_{x \to a} (x f) = a f",
    ] {
        assert_eq!(verdict_under(symbols, "", tex), Verdict::Unread, "{tex}");
    }
    let of_t = r"\frac{d}{dt} (f(t) g(t)) = f'(t) g(t) + f(t) g'(t)";
    assert_eq!(
        verdict_under("times = ['t']\nfunctions = ['f', 'g']", "", of_t),
        Verdict::Proved
    );
}

#[test]
fn powers_that_cancel_have_a_sum_everywhere() {
    let tex = r"\sum_{k=0}^{\infty} (x^k - x^k) = |x - 2| + x - 2";
    assert_ne!(verdict_under("parameters = ['x']", "", tex), Verdict::Proved);
}

#[test]
fn a_power_of_real_exponent_has_no_value_at_negative_bases_at_any_exponent() {
    let assume = "assume = ['a > 0', 'a < 2', 'b < 1/10']";
    let decide = |tex: &str| {
        let text = format!(
            "[symbols]\nparameters = ['a', 'b']\n{}{assume}\n",
            equation("1", "claim", tex, "")
        );
        audit(&text).unwrap()[0].verdict
    };
    // a cube root has values there, and the integral is negative from -1 on
    let above = r"\int_b^1 x^a e^{-x^2} dx > \frac{1}{100}";
    assert_ne!(decide(above), Verdict::Refuted);
    assert_eq!(decide(r"\int_0^1 x^a e^{-x^2} dx > \frac{1}{2}"), Verdict::Refuted);
}

#[test]
fn a_lemma_that_is_open_is_decided_by_the_signs_of_letters() {
    let decide = |tex: &str| decide("parameters = ['a', 'b', 'x', 'p']\nintegers = ['n', 'm']", tex);
    let proved = |provided: &str| (Verdict::Proved, provided.to_owned());
    for (tex, wanted) in [
        (r"\int_0^\infty \frac{dx}{x^2 + a^2} = \frac{\pi}{2|a|}", proved("")),
        (r"\int_{-\pi}^{\pi} \sin m x \cos n x \, dx = 0", proved("")),
        (r"\int_1^\infty x^{-p} dx = \frac{1}{p-1}", proved("-1 + p > 0")),
        (r"\lim_{x \to \infty} \frac{\sqrt{a^2 x^2 + 1}}{x} = |a|", proved("")),
    ] {
        assert_eq!(decide(tex), wanted, "{tex}");
    }
    for tex in [
        r"\int_0^\infty \frac{dx}{x^2 + a^2} = \frac{\pi}{2 a}",
        r"\int_{-\pi}^{\pi} \cos m x \cos n x \, dx = 0",
        r"\lim_{x \to \infty} \frac{\sqrt{a^2 x^2 + 1}}{x} = a",
        r"\lim_{x \to a} \frac{x - a}{x - b} = 0",
    ] {
        assert_eq!(decide(tex).0, Verdict::Refuted, "{tex}");
    }
}

#[test]
fn antiderivatives_may_be_given_by_premises() {
    let of = r"2 x \cos(x^2) \ln(x + 2) + \frac{\sin(x^2)}{x + 2}";
    let given = format!(r"\int ({of}) dx = \sin(x^2) \ln(x + 2) + C");
    let wrong = format!(r"\int ({of}) dx = \sin(x^2) \ln(x + 3) + C");
    let value = |right: &str| format!(r"\int_0^1 ({of}) dx = {right}");
    let premises = [("f", given.as_str()), ("g", wrong.as_str())];
    verdicts_of(
        "parameters = ['x']",
        &premises,
        &[
            ("'f'", &value(r"\sin(1) \ln 3"), Verdict::Proved),
            ("'f'", &value(r"\sin(1) \ln 2"), Verdict::Refuted),
            ("'g'", &value(r"\sin(1) \ln 4"), Verdict::Undecided),
        ],
    );
}

#[test]
fn sums_have_a_value_from_one_before_their_beginning_on() {
    let decide = |tex: &str| decide("parameters = ['a']\nintegers = ['n']", tex).0;
    for (tex, wanted) in [
        (r"\sum_{k=1}^n 1 = n", Verdict::Proved),
        (r"\sum_{k=1}^n a = n a", Verdict::Proved),
        (r"\sum_{k=3}^n k = \frac{n(n+1)}{2} - 3", Verdict::Proved),
        (r"\sum_{k=1}^n 1 = n - 1", Verdict::Refuted),
        // one without terms is 0
        (r"\sum_{k=1}^n 1 > 0", Verdict::Refuted),
        (r"n \ge 0", Verdict::Refuted),
        (r"\sum_{k=1}^{-3} 1 = 0", Verdict::Undecided),
    ] {
        assert_eq!(decide(tex), wanted, "{tex}");
    }
}

#[test]
fn an_integral_is_taken_where_it_has_a_value() {
    let decide = |tex: &str| decide("parameters = ['a', 'N', '\\mu', 'p', 'q', 'T']", tex);
    for (tex, provided) in [
        (r"\int_0^\infty e^{-a x} dx = \frac{1}{a}", "a > 0"),
        (r"\int_{-\infty}^\infty e^{-a x^2} dx = \sqrt{\frac{\pi}{a}}", ""),
        (r"\int_0^\infty e^{-t (\mu + a)} dt = \frac{1}{\mu + a}", r"\mu + a > 0"),
        (r"\int_p^q \frac{dx}{x} = \ln q - \ln p", ""),
        (r"\int_0^T \cos(a t) dt = \frac{\sin(a T)}{a}", ""),
        (r"\int_0^1 |2x - 1| dx = \frac12", ""),
        (r"\int_2^{-1} a |x| dx = -\frac{5 a}{2}", ""),
        (r"\int_0^3 |x - 1| |x - 2| dx = \frac{11}{6}", ""),
    ] {
        assert_eq!(decide(tex), (Verdict::Proved, provided.to_owned()), "{tex}");
    }
    for tex in [
        r"\int_0^\infty e^{a x} dx = \frac{1}{a}",
        r"\int_0^\infty x e^{-a x} dx = \frac{1}{a}",
        r"\int_{-1}^2 |x| dx = \frac32",
    ] {
        assert_eq!(decide(tex).0, Verdict::Refuted, "{tex}");
    }
    // conditions of the limit of an antiderivative are none of convergence
    for tex in [
        r"\int_{-\infty}^\infty \frac{dx}{x^2 + a^2} = \frac{\pi}{a}",
        r"\int_0^\infty e^{-\sqrt{a^2} x} dx = \frac{1}{a}",
        r"\int_0^\infty a e^{-a x} dx = 1",
        r"\int_0^\infty (p e^{-a x} + e^{-x}) dx = \frac{p + |a|}{a}",
        r"\int_{-\infty}^\infty p e^{-a x^2} dx + |a| = p \sqrt{\frac{\pi}{|a|}} + a",
    ] {
        assert_ne!(decide(tex).0, Verdict::Proved, "{tex}");
    }
    // positive ends are not said
    assert_ne!(decide(r"\int_p^q \frac{dx}{x} = \ln \frac{q}{p}").0, Verdict::Refuted);
    assert_ne!(
        decide(r"\int_p^q \frac{dx}{x^2} = \frac{1}{p} - \frac{1}{q}").0,
        Verdict::Proved
    );
}

#[test]
fn no_sequence_is_taken_to_begin_at_the_members_that_a_claim_names() {
    let premises = [
        ("a", "a_n = n"),
        ("b", "b_{n+1} = a_n"),
        ("s", "a_{n+1} = a_n^2"),
        ("c", "c_{n+1} = c_n"),
        ("d", "a_{n+1} = -a_n"),
        ("e", "b_{n+1} = a_n + a_{n+1}"),
    ];
    verdicts_of(
        "parameters = ['x']\nstates = ['a', 'b', 'c']\nindices = ['n']",
        &premises,
        &[
            ("'a', 'b'", "b_n = n - 1", Verdict::Undecided),
            ("'s', 'c'", r"a_n \ge 0", Verdict::Undecided),
            ("'d', 'e'", "b_n = 0", Verdict::Undecided),
            ("'d', 'e'", "b_{n+1} = 0", Verdict::Proved),
            ("'d', 'e'", "b_n = 1", Verdict::Refuted),
        ],
    );
}

#[test]
fn a_d_within_brackets_is_a_letter_where_the_differential_stands_behind_them() {
    let decide = |tex: &str| decide("parameters = ['c', 'd', 'x']", tex).0;
    assert_eq!(
        decide(r"\int (c + d x) dx = c x + \frac{d x^2}{2} + C"),
        Verdict::Proved
    );
    assert_eq!(decide(r"\int_0^1 (c \, dx) = c"), Verdict::Proved);
}

#[test]
fn an_integral_of_numbers_is_enclosed() {
    let decide = |tex: &str| decide("parameters = ['a']", tex).0;
    for (tex, wanted) in [
        (r"\int_0^1 e^{-x^2} dx \approx 0.7468", Verdict::Proved),
        (r"\int_0^1 e^{-x^2} dx \approx 0.7486", Verdict::Refuted),
        (r"\int_0^1 e^{x^2} dx > \frac{7}{5}", Verdict::Proved),
        (r"\int_0^1 e^{x^2} dx > \frac{3}{2}", Verdict::Refuted),
        (r"a + \int_0^1 \sin(x^2) dx = a + \frac13", Verdict::Refuted),
        (r"\int_0^{2\pi} \frac{dx}{2 + \cos x} = 3", Verdict::Refuted),
        // defined nowhere, as the antiderivative shows; without one there is nothing to say
        (r"\int_{-1}^1 \frac{dx}{x^2} < 1", Verdict::Refuted),
        (r"\int_0^2 \frac{e^{x^2}}{x - 1} dx < 100", Verdict::Undecided),
    ] {
        assert_eq!(decide(tex), wanted, "{tex}");
    }
}

#[test]
fn an_improper_integral_of_numbers_is_enclosed() {
    let decide = |tex: &str| decide("parameters = ['a']", tex).0;
    for (tex, wanted) in [
        (r"\int_0^\infty e^{-x^2} dx = 1", Verdict::Refuted),
        (r"\int_0^1 \frac{\ln x}{1+x} dx \approx -0.822467", Verdict::Proved),
        (r"\int_0^1 \frac{\ln x}{1+x} dx \approx -0.822476", Verdict::Refuted),
        (r"\int_0^\infty \frac{dx}{1+x^4} = 1", Verdict::Refuted),
        (r"\int_0^1 \frac{\sin x}{x} dx \approx 0.946083", Verdict::Proved),
        (r"\int_0^1 \frac{dx}{\sqrt{1-x^3}} \approx 1.40218", Verdict::Proved),
        (
            r"\int_0^\infty \frac{x^3}{e^x-1} dx = \frac{\pi^4}{12}",
            Verdict::Refuted,
        ),
        (r"\int_0^{1} x^{x} dx \approx 0.783431", Verdict::Proved),
        (r"\int_0^{\pi/2} \ln(\cos x) dx \approx -1.0888", Verdict::Proved),
        (r"\int_{-\infty}^\infty \frac{dx}{1+x^6} = 2", Verdict::Refuted),
        (r"\int_{-\infty}^\infty \frac{dx}{\cosh x} > 3.1415", Verdict::Proved),
        (r"\int_\infty^0 e^{-x^3} dx \approx -0.8930", Verdict::Proved),
        (
            r"\int_0^\infty \frac{\sin^2 x}{x^2} dx = \frac{\pi}{3}",
            Verdict::Refuted,
        ),
        (
            r"\int_{-2}^{14} \frac{dx}{\sqrt[4]{x+2}} = \frac{16}{3}",
            Verdict::Refuted,
        ),
        (
            r"a + \int_0^\infty \frac{\ln x}{1+x^2} dx = a + \frac{1}{10}",
            Verdict::Refuted,
        ),
        // without a value, or with one that is no absolute one, there is nothing to say
        (r"\int_1^\infty \frac{dx}{x} < 100", Verdict::Refuted),
        (r"\int_0^\infty e^{x} dx < 100", Verdict::Undecided),
        (r"\int_0^1 \frac{\cos x}{x} dx < 100", Verdict::Undecided),
        (r"\int_{-\infty}^\infty \frac{dx}{x^2} < 100", Verdict::Refuted),
        (r"\int_0^\infty \frac{\sin x}{\sqrt{1+x}} dx = 2", Verdict::Undecided),
    ] {
        assert_eq!(decide(tex), wanted, "{tex}");
    }
}

#[test]
fn a_sum_of_squares_is_not_negative_as_it_is_written() {
    let decide = |tex: &str| decide("parameters = ['a', 'b']", tex).0;
    assert_eq!(decide(r"\cos^2 a \sin^2 b + \cos^2 b \ge 0"), Verdict::Proved);
    assert_eq!(decide(r"\cos^2 a \sin^2 b + \cos^2 b > 0"), Verdict::Refuted);
    assert_eq!(decide(r"\cos^2 a \sin^2 b - \cos^2 b \ge 0"), Verdict::Refuted);
}
