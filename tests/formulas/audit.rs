//! The command `audit`, as a reviewer runs it: the paper, a sheet of one's own, what a script reads.

use crate::common::program::{Ran, program, run, scratch};

/// Label, verdict, expected, digits of each row.
fn rows(ran: &Ran) -> Vec<(String, String, String, Option<f64>)> {
    let mut reader = csv::Reader::from_reader(ran.stdout.as_bytes());
    let header: Vec<String> = reader.headers().expect("a header").iter().map(String::from).collect();
    let columns =
        "label,verdict,expected,digits,counterexample,reason,provided,place,repair,fingerprint,reductions,reading";
    assert_eq!(header.join(","), columns);
    let row = |row: csv::StringRecord| (row[0].into(), row[1].into(), row[2].into(), row[3].parse().ok());
    reader.records().map(|record| row(record.expect("a row"))).collect()
}

const PREMISE: &str = r"
[[equation]]
label = '9'
role = 'premise'
tex = '\dot{Z}_{k+1} = -r_B \dot{Z}_k + \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k)'
";

fn claim(label: &str, tex: &str) -> String {
    format!("[[equation]]\nlabel = '{label}'\nrole = 'claim'\ntex = '{tex}'\nfollows_from = ['9']\n")
}

#[test]
fn sixteen_and_twenty_two_are_refuted_and_all_else_in_the_paper_is_proved_with_evidence() {
    let ran = run(&["audit", "--format", "csv"]);
    assert_eq!(ran.status, Some(0));
    let rows = rows(&ran);
    for label in ["3", "4", "9", "10", "11", "12", "14", "15", "19", "20", "21", "23"] {
        let row = rows
            .iter()
            .find(|row| row.0 == label)
            .unwrap_or_else(|| panic!("no row for ({label})"));
        assert_eq!(row.1, "proved", "({label})");
        assert!(
            row.3.is_some_and(|digits| digits > 12.0),
            "({label}) has {:?} digits",
            row.3
        );
    }
    for label in ["16", "22"] {
        let row = rows
            .iter()
            .find(|row| row.0 == label)
            .unwrap_or_else(|| panic!("no row for ({label})"));
        assert_eq!((row.1.as_str(), row.2.as_str()), ("refuted", "refuted"), "({label})");
        assert!(
            row.3.is_some_and(|digits| digits < 4.0),
            "({label}) has {:?} digits",
            row.3
        );
    }
}

#[test]
fn a_right_and_a_wrong_formula_of_ones_own_are_told_apart_and_the_status_says_so() {
    let right = claim(
        "a",
        r"r_B \dot{Z}_k = \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k) - \dot{Z}_{k+1}",
    );
    let wrong = claim(
        "b",
        r"r_B \dot{Z}_k = \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k) + \dot{Z}_{k+1}",
    );
    let all_right = program(["audit", "-", "--format", "csv"])
        .input(format!("{PREMISE}{right}"))
        .run();
    assert_eq!(all_right.status, Some(0));
    let ran = program(["audit", "-", "--format", "csv"])
        .input(format!("{PREMISE}{right}{wrong}"))
        .run();
    assert_eq!(ran.status, Some(1));
    let verdicts: Vec<String> = rows(&ran).into_iter().map(|row| row.1).collect();
    assert_eq!(verdicts, ["proved", "refuted"]);
    let mut reader = csv::Reader::from_reader(ran.stdout.as_bytes());
    let counterexamples: Vec<String> = reader.records().map(|row| row.expect("a row")[4].to_string()).collect();
    let side = |name: &str| counterexamples[1].split("; ").find_map(|part| part.strip_prefix(name));
    assert!(counterexamples[0].is_empty(), "{counterexamples:?}");
    assert!(
        side("left=").is_some() && side("left=") != side("right="),
        "{counterexamples:?}"
    );
}

#[test]
fn a_proof_prints_the_combination_of_premises_that_is_the_claim() {
    let text = run(&["audit", "--explain", "14"]).succeeded();
    // what each step says, and the combination of these that is the claim
    let number = |label: &str, part: &str| {
        let mut lines = text.lines().zip(text.lines().skip(1));
        let by = format!("By {label}:");
        let found = lines.find(|(source, fact)| source.ends_with(&by) && fact.contains(part));
        let (source, _) = found.unwrap_or_else(|| panic!("no {label} in\n{text}"));
        source.trim().split_once('.').expect("a number").0.to_string()
    };
    let combination = text.lines().find(|line| line.contains("N = (-"));
    let combination = combination.unwrap_or_else(|| panic!("no combination in\n{text}"));
    for part in [
        format!("(-r_T) [{}]", number("(9)", r"\dot{Z}_k")),
        format!("[{}]", number("(11)", r"\dot{Z}_{k+2}")),
        format!("[{}]", number("(13), at t_k", "F_1(t_k + T)")),
    ] {
        assert!(combination.contains(&part), "no {part} in {combination} of\n{text}");
    }
    for part in [
        "equal arguments of F_1(t_k + T) and F_1(t_{k+2})",
        // a premise solved, inserted, and nothing left
        "so T = T_1 + T_2",
        "Insert T from step",
        "N = 0\n  so N = 0",
        "evidence",
        "random points",
        "digits: -log10",
    ] {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
}

#[test]
fn json_has_the_counterexample_as_an_object_too() {
    let text = run(&["audit", "--format", "json"]).stdout;
    let rows: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let sixteen = rows.as_array().expect("rows").iter().find(|row| row["label"] == "16");
    let sixteen = sixteen.expect("a row");
    let values = sixteen["counterexample_values"].as_object().expect("an object");
    let shown: Vec<String> = values
        .iter()
        .map(|(name, value)| format!("{name}={}", value.as_str().expect("a value")))
        .collect();
    let mut told: Vec<&str> = sixteen["counterexample"].as_str().expect("text").split("; ").collect();
    told.sort_unstable();
    assert_eq!(shown, told);
}

const WRONG: &str = r"
[[equation]]
label = 'p'
role = 'premise'
tex = 'd = r_B T_1 + \overline{g}'

[[equation]]
label = 'c'
role = 'claim'
tex = '\overline{g} = d + r_B T_1'
follows_from = ['p']
expect = 'refuted'
";

#[test]
fn a_repair_fills_its_column_and_names_what_is_wrong_where_it_is_asked_for() {
    let row = |arguments: &[&str]| {
        let ran = program(arguments).input(WRONG).run();
        assert_eq!(ran.status, Some(0));
        let mut reader = csv::Reader::from_reader(ran.stdout.as_bytes());
        reader.records().next().expect("a row").expect("a row")
    };
    let without = row(&["audit", "-", "--format", "csv"]);
    assert_eq!((&without[8], &without[5]), ("", "does not follow from its premises"));
    let with = row(&["audit", "-", "--repair", "--format", "csv"]);
    let first = with[8].split(" ;; ").next();
    assert_eq!(first, Some(r"$\overline{g} = d - r_B T_1$"), "{with:?}");
    assert!(with[5].ends_with("wrong sign of the term `r_B T_1`"), "{with:?}");
}

#[test]
fn the_first_repair_is_written_beside_the_original_and_over_no_input() {
    let scratch = scratch("mended");
    let (sheet, mended) = (scratch.file("sheet.toml", WRONG), scratch.path("mended.toml"));
    let refused = run(&["audit", &sheet, "--repair-into", &sheet]);
    assert_eq!(refused.status, Some(2));
    assert_eq!(scratch.read("sheet.toml"), WRONG);
    assert_eq!(run(&["audit", &sheet, "--repair-into", &mended]).status, Some(0));
    let written = scratch.read("mended.toml");
    let comment = "# repair of (c): $\\overline{g} = d - r_B T_1$ (wrong sign of the term `r_B T_1`)\n";
    assert!(written.contains(&format!("{comment}tex = ")), "{written}");
    assert_eq!(written.replace(comment, ""), WRONG);
    // what is written is audited as the original is
    let verdicts = |path: &str| {
        run(&["audit", path, "--format", "csv"])
            .stdout
            .replace(",11:8,", ",10:8,")
    };
    assert_eq!(verdicts(&mended), verdicts(&sheet));
    let tex =
        "\\begin{equation} % audit: claim; symbols parameters x, y\n  (x + y)^2 = x^2 + 2 x y - y^2\n\\end{equation}\n";
    let document = scratch.file("paper.tex", tex);
    run(&["audit", &document, "--repair-into", &scratch.path("mended.tex")]);
    let written = scratch.read("mended.tex");
    assert!(
        written.contains("\n  % repair of (1): $(x + y)^2 = x^2 + 2 x y + y^2$"),
        "{written}"
    );
}

#[test]
fn a_proof_names_its_axioms_and_its_cases() {
    let explained = |tex: &str| {
        let sheet =
            format!("[symbols]\nparameters = ['x', 'y']\n\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '{tex}'\n");
        program(["audit", "-", "--explain", "1"])
            .input(&sheet)
            .run()
            .succeeded()
    };
    let addition = explained(r"\sin(x + y) = \sin(x) \cos(y) + \cos(x) \sin(y)");
    assert!(addition.contains("axiom: sine of sum (DLMF 4.21.2)"), "{addition}");
    let expanded = explained("(x + y)^2 = x^2 + 2 x y + y^2");
    assert!(expanded.contains("multiplied out"), "{expanded}");
    let squares = explained(r"x^2 + y^2 \ge 2 x y");
    assert!(squares.contains("squares"), "{squares}");
    let tangent = explained(r"e^x \ge 1 + x");
    for step in [
        "Taylor's theorem at 0: the larger side less the smaller one there",
        "Taylor's theorem at 0, the remainder: the second derivative, for x' < 0",
        "axiom: exp positive",
    ] {
        assert!(tangent.contains(step), "{step}\n{tangent}");
    }
}

#[test]
fn a_refutation_is_worked_out_and_every_premise_holds_there() {
    let text = run(&["audit", "--explain", "16"]).stdout;
    let value = |name: &str| {
        let mut lines = text.lines().filter_map(|line| line.trim_start().split_once('='));
        let found = lines
            .find(|(left, _)| left.trim() == name)
            .map(|(_, value)| value.trim().to_string());
        found.unwrap_or_else(|| panic!("no {name} in\n{text}"))
    };
    assert_ne!(value("left"), value("right"), "{text}");
    assert!(text.contains("every premise holds, exactly"), "{text}");
    let (_, premises) = text.split_once("there the premises are").expect("premises");
    let ten = premises
        .trim_start()
        .lines()
        .next()
        .and_then(|line| line.trim().strip_prefix("(10)"));
    let (left, right) = ten.and_then(|sides| sides.split_once('=')).expect("both sides of (10)");
    assert_eq!(left.trim(), right.trim(), "{text}");
}

#[test]
fn a_refutation_shows_periods_and_derives_the_derivatives_of_the_map() {
    let text = run(&["audit", "--explain", "22"]).stdout;
    let value = |name: &str| {
        let found = text
            .lines()
            .find_map(|line| line.trim().strip_prefix(&format!("{name} = ")));
        found.unwrap_or_else(|| panic!("no {name} in\n{text}")).to_owned()
    };
    // a period apart
    assert_eq!(value("f(-7/4)"), value("f(9/4)"), "{text}");
    // (10) differentiated: one linear equation, which the value shown solves
    let slope = r"\frac{\partial t_{k+1}}{\partial t_k}";
    assert_eq!(value(slope), "167/704", "{text}");
    assert!(
        text.contains(&format!(r"\frac{{176}}{{15}} {slope} - 167/60 = 0")),
        "{text}"
    );
    assert!(text.contains("functions with these values exist"), "{text}");
    assert!(!text.contains("F_1(0)") && !text.contains("^{1}"), "{text}");
}

#[test]
fn derivatives_along_maps_cite_the_equations_of_their_own_map() {
    let text = run(&["audit", "--explain", "23"]).stdout;
    for (label, by) in [("9", "t_k"), ("10", "t_k"), ("11", "t_{k+1}"), ("12", "t_{k+1}")] {
        let cited = format!("By ({label}) along the map, differentiated with respect to {by}:");
        assert!(text.contains(&cited), "{cited}\n{text}");
    }
}

#[test]
fn sheets_of_another_field_are_audited_in_their_own_words() {
    let ran = run(&["audit", "golden/oscillator/equations.toml", "--format", "csv"]);
    assert_eq!(ran.status, Some(0), "{}", ran.stdout);
    assert_eq!(rows(&ran).len(), 4);
}

#[test]
fn each_misprint_of_a_public_work_is_refuted_and_its_right_form_is_proved() {
    let found = std::fs::read_dir("examples/found").unwrap();
    let mut sheets: Vec<String> = found.map(|entry| entry.unwrap().path().display().to_string()).collect();
    sheets.sort();
    assert!(sheets.len() >= 20, "{sheets:?}");
    for sheet in &sheets {
        let ran = run(&["audit", sheet, "--format", "csv"]);
        assert_eq!(ran.status, Some(0), "{sheet}\n{}", ran.stdout);
        let rows = rows(&ran);
        assert!(rows.iter().all(|row| row.1 == row.2), "{sheet}: {rows:?}");
        for verdict in ["refuted", "proved"] {
            assert!(
                rows.iter().any(|row| row.1 == verdict),
                "{sheet} has no row that is {verdict}"
            );
        }
        let page = include_str!("../../doc/found.md");
        let name = sheet.rsplit(['/', '\\']).next().unwrap();
        assert!(page.contains(name), "doc/found.md does not name {name}");
    }
}

#[test]
fn a_sheet_that_cannot_be_used_says_where_and_exits_with_two() {
    let nowhere = claim("a", r"d = d").replace("'9'", "'99'");
    let twice = format!("{}{}", claim("a", "d = d"), claim("a", "d = d"));
    let circle = format!(
        "{}{}",
        claim("a", "d = d").replace("'9'", "'b'"),
        claim("b", "d = d").replace("'9'", "'a'")
    );
    for (sheet, word) in [(twice.as_str(), "twice"), (r"[[equation", "line")] {
        let ran = program(["audit", "-"]).input(format!("{PREMISE}{sheet}")).run();
        ran.refused(&[word, "line"]);
    }
    // what is its own premise, or follows from what is not there, stops nothing else
    for (sheet, word) in [(circle, "itself"), (nowhere, "`99`")] {
        let ran = program(["audit", "-"])
            .input(format!("{PREMISE}{sheet}{}", claim("c", "d = d")))
            .run();
        let table = ran.stdout;
        assert_eq!(ran.status, Some(2), "{table}");
        assert!(
            table.contains(word) && table.contains("unread") && table.contains("proved"),
            "{table}"
        );
    }
    assert_eq!(program(["audit", "-"]).input("").run().status, Some(2));
    assert_eq!(run(&["audit", "no-such-file.toml"]).status, Some(2));
    assert_eq!(run(&["audit", "--explain", "99"]).status, Some(2));
    assert_eq!(run(&["audit", "--effort", "0"]).status, Some(2));
}

#[test]
fn what_cannot_be_read_is_a_row_beside_the_others_and_exits_with_two() {
    let right = claim(
        "a",
        r"r_B \dot{Z}_k = \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k) - \dot{Z}_{k+1}",
    );
    let unknown = claim("b", r"r_X = 1 + q");
    let broken = claim("c", r"\frac{1}{ = 2");
    let sheet = format!("{PREMISE}{right}{unknown}{broken}");
    let ran = program(["audit", "-", "--format", "csv"]).input(&sheet).run();
    assert_eq!(ran.status, Some(2));
    let found: Vec<(String, String)> = rows(&ran).into_iter().map(|row| (row.0, row.1)).collect();
    let wanted = [("a", "proved"), ("b", "unread"), ("c", "unread")];
    assert_eq!(found, wanted.map(|(label, verdict)| (label.into(), verdict.into())));
    let table = ran.stdout;
    assert!(table.contains("unknown symbol `r_X`, did you mean `r_B`?"), "{table}");
    assert!(table.contains(",14:8,"), "{table}");
    let error = ran.stderr;
    for part in ["line 14, column 8", "(b)", "(c)", "    r_X = 1 + q\n    ^"] {
        assert!(error.contains(part), "no {part} in\n{error}");
    }
    // An author who knows of it says so.
    let known = sheet
        .replace("label = 'b'", "label = 'b'\nexpect = 'unread'")
        .replace("label = 'c'", "label = 'c'\nexpect = 'unread'");
    let ran = program(["audit", "-"]).input(&known).run();
    assert_eq!(ran.status, Some(0), "{}", ran.stdout);
    assert!(ran.stderr.is_empty());
    let explained = program(["audit", "-", "--explain", "b"]).input(&sheet).run();
    assert_eq!(explained.status, Some(2));
    assert!(explained.stdout.contains("^"), "{}", explained.stdout);
}

#[test]
fn premises_that_contradict_each_other_are_named_and_prove_nothing() {
    let contrary = format!(
        "{PREMISE}{}[[equation]]\nlabel = 'c'\nrole = 'premise'\ntex = 'd = 1, d = 2'\n",
        claim("a", "d = 1").replace("['9']", "['9', 'c']")
    );
    let ran = program(["audit", "-", "--format", "csv"]).input(&contrary).run();
    assert_eq!(ran.status, Some(1));
    assert_eq!(rows(&ran)[0].1, "undecided");
    let table = ran.stdout;
    assert!(table.contains("contradict") && table.contains("(c)"), "{table}");
}

#[test]
fn an_identity_needs_no_premise() {
    let identity = claim("a", "(d + r)^2 = d^2 + 2 d r + r^2").replace("follows_from = ['9']\n", "");
    program(["audit", "-"]).input(&identity).run().succeeded();
}

#[test]
fn the_template_has_every_key_and_is_audited_as_it_says() {
    let template = run(&["audit", "--template"]).stdout;
    let keys = [
        "title",
        "parameters",
        "positive",
        "nonnegative",
        "nonzero",
        "at_most_one",
        "integers",
        "complex",
        "generic",
        "times",
        "states",
        "continuous",
        "indices",
        "functions",
        "periods",
        "abbreviations",
        "relations",
        "label",
        "role",
        "tex",
        "follows_from",
        "where",
        "with",
        "assume",
        "expect",
    ];
    for key in keys {
        assert!(
            template.lines().any(|line| line.starts_with(&format!("{key} = "))),
            "no {key}"
        );
    }
    assert!(template.contains("[symbols.maps]"));
    program(["audit", "-"]).input(&template).run().succeeded();
}

#[test]
fn the_long_help_says_what_the_verdicts_promise() {
    let help = run(&["audit", "--help"]).stdout;
    for word in [
        "proved",
        "refuted",
        "undecided",
        "unread",
        "never a pass",
        "Exit status",
    ] {
        assert!(help.contains(word), "no {word} in\n{help}");
    }
}
