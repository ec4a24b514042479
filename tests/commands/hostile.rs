//! Small inputs that would come to something huge: each ends with a message that names the place, and a short answer.

use crate::common::program::{Ran, run, scratch};

/// The answer of `audit` to a file of this name.
fn audited(name: &str, text: &str) -> Ran {
    run(&["audit", &scratch(name).file(name, text)])
}

/// Checks the exit status, that a message holds `wanted`, and that the answer is short.
fn assert_ends(name: &str, text: &str, status: i32, wanted: &str) {
    let ran = audited(name, text);
    let said = ran.stdout + &ran.stderr;
    let words: Vec<&str> = said.split_whitespace().collect();
    let shown: String = said.chars().take(2000).collect();
    assert_eq!(ran.status, Some(status), "{name}: {shown}");
    assert!(words.join(" ").contains(wanted), "{name}: {shown}");
    assert!(said.len() < 100_000, "{name}: {} bytes", said.len());
}

fn entry(label: &str, role: &str, tex: &str, more: &str) -> String {
    format!("[[equation]]\nlabel = '{label}'\nrole = '{role}'\ntex = '{tex}'\n{more}\n")
}

fn sheet(entries: &[String]) -> String {
    format!("[symbols]\nparameters = ['a', 'x']\n{}", entries.concat())
}

/// A sheet with a claim and these equations of its `where`.
fn defined(claim: &str, local: &[String]) -> String {
    let quoted: Vec<String> = local.iter().map(|tex| format!("'{tex}'")).collect();
    sheet(&[entry("c", "claim", claim, &format!("where = [{}]", quoted.join(", ")))])
}

fn document(body: &str) -> String {
    format!("\\documentclass{{article}}\n\\begin{{document}}\n{body}\n\\end{{document}}\n")
}

#[test]
fn functions_put_into_each_other_end() {
    // o(x) is an order
    let letters = [
        "b", "c", "d", "f", "g", "h", "j", "l", "m", "n", "p", "q", "r", "s", "u", "v", "w",
    ];
    // twice as deep with each definition, or twice as wide
    for (first, next, wanted) in [
        ("b(x) = x^2 + a", "F(F(x))", "too deep"),
        ("b(x) = x + a", "F(x) F(x)", "too large"),
        ("b(x) = x + a", "F(x + a) F(a)", "too large"),
    ] {
        let mut entries = vec![entry("d0", "definition", first, "")];
        for (n, pair) in letters.windows(2).enumerate() {
            let right = next.replace('F', pair[0]);
            let tex = format!("{}(x) = {right}", pair[1]);
            entries.push(entry(&format!("d{}", n + 1), "definition", &tex, ""));
        }
        let labels: Vec<String> = (0..letters.len()).map(|n| format!("'d{n}'")).collect();
        let below = format!("follows_from = [{}]", labels.join(", "));
        entries.push(entry("c", "claim", "w(a) = a", &below));
        assert_ends("functions.toml", &sheet(&entries), 2, wanted);
    }
}

#[test]
fn definitions_that_double_end() {
    let doubling: Vec<String> = (0..40)
        .map(|n| format!("x_{{{}}} = x_{{{n}}} x_{{{n}}} + a", n + 1))
        .collect();
    let local = [&["x_{0} = a + a".to_owned()], doubling.as_slice()].concat();
    assert_ends(
        "where.toml",
        &defined("x_{40} = a", &local),
        2,
        "too large once its definitions",
    );
    let lines: Vec<String> = (0..40)
        .map(|n| format!("'A_{{{}}}' = 'A_{{{n}}} A_{{{n}}}'", n + 1))
        .collect();
    let symbols = format!(
        "[symbols]\nparameters = ['a']\n[symbols.abbreviations]\n'A_{{0}}' = 'a + a'\n{}\n",
        lines.join("\n")
    );
    assert_ends(
        "symbols.toml",
        &(symbols + &entry("c", "claim", "a = a", "")),
        2,
        "too large once its definitions",
    );
    // each of them small, and used often
    let sum = vec!["a"; 2000].join(" + ");
    let uses = vec!["b"; 2000].join(" + ");
    assert_ends(
        "often.toml",
        &defined(&format!("{uses} = a"), &[format!("b = {sum}")]),
        2,
        "too large once its definitions",
    );
}

#[test]
fn long_chains_are_decided_or_refused() {
    let chain = |n: usize| {
        let steps = (1..=n).map(|i| format!("x_{{{i}}} = x_{{{}}} + a", i - 1));
        let local: Vec<String> = std::iter::once("x_{0} = a".to_owned()).chain(steps).collect();
        defined(&format!("x_{{{n}}} = {} a", n + 1), &local)
    };
    assert_ends("short.toml", &chain(60), 0, "proved");
    assert_ends("long.toml", &chain(3000), 2, "too deep once its definitions");
    let links = |n: usize| sheet(&[entry("c", "claim", &vec!["x"; n].join(" = "), "")]);
    assert_ends("links.toml", &links(20), 0, "proved");
    assert_ends("many.toml", &links(4000), 2, "too many for one entry");
    // what `with` puts into a premise
    let (premise, sum) = (vec!["x"; 2000].join(" + "), vec!["a"; 2000].join(" + "));
    let with = format!("follows_from = ['p']\nwith = ['x = {sum}']");
    let entries = [
        entry("p", "premise", &format!("{premise} = a"), ""),
        entry("c", "claim", "a = a", &with),
    ];
    assert_ends("with.toml", &sheet(&entries), 2, "too large once its definitions");
}

#[test]
fn long_lists_end_at_what_is_tried_of_them() {
    let joined = |n: usize, sign: &str, of: &dyn Fn(usize) -> String| (0..n).map(of).collect::<Vec<_>>().join(sign);
    let claim = |tex: String| sheet(&[entry("c", "claim", &tex, "")]);
    let too_many = "more than 64 choices of cases";
    let cases = joined(3000, r"\\", &|n| format!("x & x > {n}"));
    let cases = claim(format!(r"\begin{{cases}} {cases} \end{{cases}} = x"));
    assert_ends("cases.toml", &cases, 1, too_many);
    let signs = joined(1500, " + ", &|n| format!(r"\operatorname{{sgn}}(x - {n})"));
    assert_ends("signs.toml", &claim(format!("{signs} = x")), 1, too_many);
    let bounds = joined(500, ", ", &|n| format!("x > {n}"));
    assert_ends("bounds.toml", &claim(format!(r"x = x, \quad {bounds}")), 0, "too large");
    // where the sum over n ends is open at each sign
    let sum = claim(format!(r"\sum_{{n=1}}^3 n{} = x", " + x".repeat(8000)));
    assert_ends("sum.toml", &sum, 1, "up to the next sign, or to the end?");
    let rows = format!(
        "% audit: default skip\n\\begin{{align}}\n{}\\end{{align}}\n",
        "x &= x \\\\\n".repeat(30_000)
    );
    assert_ends("rows.tex", &rows, 2, "more than 20000 formulas");
}

#[test]
fn macros_that_would_grow_without_end_end() {
    let formula = "\\[ a = \\m \\] % audit: claim\n";
    let symbols = "% audit: symbols a\n";
    let wide = format!(
        "\\newcommand{{\\n}}[1]{{{}}}\n\\newcommand{{\\m}}{{\\n{{{}}}}}\n",
        "#1".repeat(50_000),
        "a".repeat(90_000)
    );
    for (name, macros, wanted) in [
        ("wide.tex", wide, "longer than 100000"),
        (
            "long.tex",
            format!("\\newcommand{{\\m}}{{{}}}\n", "a".repeat(900_000)),
            "longer than 100000",
        ),
        (
            "itself.tex",
            "\\newcommand{\\m}{\\m\\m}\n".to_owned(),
            "goes on for ever",
        ),
    ] {
        assert_ends(
            name,
            &document(&(symbols.to_owned() + &macros + &formula.repeat(50))),
            2,
            wanted,
        );
    }
}

#[test]
fn what_never_closes_is_searched_once() {
    // half a megabyte of each: searching on from each of them would be 10^10 steps and more
    for unclosed in [
        "\\begin{",
        "\\begin{equation}",
        "\\begin{comment}",
        "\\newcommand{\\a}[",
        "\\newcommand{\\a}{",
        "\\setcounter{",
        "\\label{",
        "\\def\\a",
        "\\$$ ",
        "$$ a\n\n",
        "\\[ ",
        "{",
        "\\ifx",
    ] {
        let body = unclosed.repeat(500_000 / unclosed.len());
        let ran = audited("unclosed.tex", &document(&body));
        assert_eq!(ran.status, Some(2), "{unclosed}");
        assert!(ran.stderr.len() < 100_000, "{unclosed}");
    }
}
