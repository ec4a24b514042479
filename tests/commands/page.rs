//! The report page and the findings of `audit`: what a referee attaches, and what CI shows.

use super::check::Golden;
use crate::common::program::{Scratch, program, run, scratch};
use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

/// The page as XML: without what is no XML, its type, its style and its script.
fn as_xml(html: &str) -> String {
    let mut xml = html.replace("<!DOCTYPE html>", "");
    for name in ["style", "script"] {
        let (open, close) = (format!("<{name}>"), format!("</{name}>"));
        let (start, end) = (xml.find(&open).unwrap(), xml.find(&close).unwrap());
        xml.replace_range(start..end + close.len(), "");
    }
    xml
}

/// The page of the paper, once for all tests.
static PAPER_PAGE: LazyLock<String> = LazyLock::new(|| run(&["audit", "--repair", "--format", "html"]).succeeded());

/// The page of the numbers that the paper prints, once for all tests.
static CHECK_PAGE: LazyLock<String> = LazyLock::new(|| {
    let golden = Golden::paper("page", |row| row.contains(",orbits.velocities"));
    run(&["check", golden.path(), "--format", "html"]).stdout
});

/// The labels of the paper's rows, by another format.
fn labels(arguments: &[&str]) -> Vec<String> {
    let ran = run(&[arguments, &["--format", "csv"]].concat());
    let mut reader = csv::Reader::from_reader(ran.stdout.as_bytes());
    reader.records().map(|row| row.unwrap()[0].to_owned()).collect()
}

#[test]
fn the_page_of_the_paper_is_one_short_file_with_a_place_for_each_formula() {
    let html = &*PAPER_PAGE;
    // half of it are the formulas of the explanations
    // of which the theorems for Rocq are 55,000
    assert!(html.len() < 850_000, "{} bytes", html.len());
    assert_eq!(html.matches("<summary>Theorem for Rocq</summary>").count(), 19);
    assert!(html.contains("No theorem for Rocq</summary><pre>complex numbers</pre>"));
    // what is wider than a phone is scrolled by keys too (axe-core: scrollable-region-focusable)
    for class in ["formula", "wide", "explained"] {
        let all = html.matches(&format!("class=\"{class}\"")).count();
        let by_keys = html.matches(&format!("class=\"{class}\" tabindex=\"0\"")).count();
        assert_eq!(all, by_keys, "{class}");
    }
    for outside in ["http://", "https://", "src=", "url(", "@import"] {
        assert!(!html.contains(outside), "{outside}");
    }
    let xml = as_xml(html);
    let document = roxmltree::Document::parse(&xml).unwrap();
    let ids: Vec<&str> = document.descendants().filter_map(|node| node.attribute("id")).collect();
    assert_eq!(ids.iter().collect::<HashSet<_>>().len(), ids.len(), "an id twice");
    let with_id = |id: &str| document.descendants().find(|node| node.attribute("id") == Some(id));
    for label in labels(&["audit"]) {
        let article = with_id(&format!("eq-{label}")).unwrap_or_else(|| panic!("no place for ({label})"));
        assert!(article.descendants().any(|node| node.has_tag_name("math")), "({label})");
        let proof = article
            .descendants()
            .find(|node| node.attribute("class") == Some("explained"));
        assert!(
            proof.is_some_and(|proof| proof.descendants().filter(|node| node.has_tag_name("math")).count() > 1),
            "({label})"
        );
        // no TeX is left in it
        let texts = proof
            .into_iter()
            .flat_map(|proof| proof.descendants())
            .filter_map(|node| node.text());
        let tex: Vec<&str> = texts.filter(|text| text.contains('\\')).collect();
        assert!(tex.is_empty(), "({label}): {tex:?}");
    }
    let links = document.descendants().filter_map(|node| node.attribute("href"));
    for link in links {
        assert!(with_id(link.trim_start_matches('#')).is_some(), "{link} leads nowhere");
    }
    let marked = |label: &str| {
        let article = with_id(&format!("eq-{label}")).unwrap();
        article
            .descendants()
            .filter(|node| node.attribute("class") == Some("changed"))
            .count()
    };
    assert!(marked("16") >= 2 && marked("22") >= 2 && marked("14") == 0);
}

const EVIL: &str = "<script>alert(1)</script>\"'&\u{202e}\u{200f}";

#[test]
fn nothing_of_a_label_a_formula_or_a_title_becomes_an_element() {
    let scratch = scratch("evil");
    let entry = |label: &str, tex: &str| {
        format!(
            "[[equation]]\nlabel = {}\nrole = 'claim'\ntex = {}\n",
            quoted(label),
            quoted(tex)
        )
    };
    let quoted_title = quoted(EVIL);
    let sheet = format!(
        "title = {quoted_title}\n[symbols]\nparameters = ['a', 'b']\n{}{}{}",
        entry(EVIL, "a + b = b + a"),
        entry("2", EVIL),
        entry("\u{5d0}\u{5d1} 3", "a = \\text{<img src=x onerror=alert(1)>}"),
    );
    let path = scratch.file("evil.toml", &sheet);
    let ran = run(&["audit", &path, "--format", "html"]);
    assert_eq!(ran.status, Some(2), "two cannot be read: {}", ran.stderr);
    let html = ran.stdout;
    assert_eq!(html.matches("<script>").count(), 1, "the page's own");
    assert!(!html.contains("<img") && !html.contains('\u{202e}'));
    let xml = as_xml(&html);
    let document = roxmltree::Document::parse(&xml).unwrap();
    let articles = document
        .descendants()
        .filter(|node| node.has_tag_name("article"))
        .count();
    assert_eq!(articles, 3);
    // the same in the other formats for machines
    let sarif = run(&["audit", &path, "--format", "sarif"]);
    serde_json::from_str::<serde_json::Value>(&sarif.stdout).unwrap();
    let junit = run(&["audit", &path, "--format", "junit"]).stdout;
    roxmltree::Document::parse(&junit).unwrap();
}

/// A TOML string.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

const PAPER: &str = r"\documentclass{article}
\begin{document}
% audit: symbols parameters a, b, c
\begin{equation}\label{eq:square}
(a + b)^2 = a^2 + 2 a b + b^2
\end{equation}
and
% audit: claim
\begin{equation}\label{eq:slip}
(a - b)^2 = a^2 + 2 a b + b^2
\end{equation}
\end{document}
";

fn sarif(arguments: &[&str]) -> (serde_json::Value, Option<i32>) {
    let ran = run(&[&["audit"], arguments, &["--format", "sarif"]].concat());
    let log = serde_json::from_str(&ran.stdout).unwrap_or_else(|error| panic!("{error}: {}", ran.stderr));
    (log, ran.status)
}

#[test]
fn a_finding_marks_the_formula_in_the_source_and_its_repair_mends_it() {
    let scratch = scratch("sarif");
    let path = scratch.file("paper.tex", PAPER);
    let (log, status) = sarif(&[&path, "--repair"]);
    assert_eq!(status, Some(1));
    let results = log["runs"][0]["results"].as_array().unwrap();
    assert_eq!(results.len(), 1, "{log:#}");
    let result = &results[0];
    assert_eq!(result["ruleId"], "formula-refuted");
    let place = &result["locations"][0]["physicalLocation"];
    assert!(
        place["artifactLocation"]["uri"]
            .as_str()
            .unwrap()
            .ends_with("/paper.tex")
    );
    assert_eq!(place["region"]["startLine"], 10);
    let fix = &result["fixes"][0]["artifactChanges"][0]["replacements"][0];
    let [line, start, end] =
        ["startLine", "startColumn", "endColumn"].map(|key| fix["deletedRegion"][key].as_u64().unwrap() as usize);
    assert_eq!(fix["deletedRegion"]["endLine"], fix["deletedRegion"]["startLine"]);
    let mut lines: Vec<String> = PAPER.lines().map(str::to_owned).collect();
    let old: Vec<char> = lines[line - 1].chars().collect();
    let part = |from: usize, to: usize| old[from..to].iter().collect::<String>();
    let new = fix["insertedContent"]["text"].as_str().unwrap();
    lines[line - 1] = [&part(0, start - 1), new, &part(end - 1, old.len())].concat();
    let mended = scratch.file("mended.tex", lines.join("\n"));
    assert_eq!(run(&["audit", &mended]).status, Some(0), "{}", lines.join("\n"));
}

#[test]
fn what_a_baseline_knows_does_not_fail_wherever_it_stands_now() {
    let scratch = scratch("baseline");
    let path = scratch.file("paper.tex", PAPER);
    for format in ["sarif", "json", "jsonl", "csv"] {
        let baseline = scratch.path(&format!("baseline.{format}"));
        assert_eq!(
            run(&["audit", &path, "--format", format, "--out", &baseline]).status,
            Some(1)
        );
        let moved = scratch.file("moved.tex", PAPER.replace("and\n", "and\n\n\nmore text\n"));
        let ran = run(&["audit", &moved, "--baseline", &baseline]);
        assert_eq!(ran.status, Some(0), "{format}: {}", ran.stderr);
        assert!(ran.stdout.contains("known from the baseline"));
        let (log, status) = sarif(&[&moved, "--baseline", &baseline]);
        assert_eq!(status, Some(0));
        assert_eq!(log["runs"][0]["results"][0]["baselineState"], "unchanged");
        // nor does a formula before it, which changes its number
        let more = PAPER.replace("and\n", "and\n\\begin{equation}\na + b = b + a\n\\end{equation}\n");
        let shifted = scratch.file("shifted.tex", &more);
        let ran = run(&["audit", &shifted, "--baseline", &baseline]);
        assert_eq!(ran.status, Some(0), "{}", ran.stdout);
        assert!(ran.stdout.contains("\n3 "), "{}", ran.stdout);
        // a new misprint in the same formula is not known
        let worse = scratch.file("worse.tex", PAPER.replace("(a - b)^2", "(a - 2 b)^2"));
        let ran = run(&["audit", &worse, "--baseline", &baseline]);
        assert_eq!(ran.status, Some(1));
        assert!(ran.stderr.contains("not found any more: (2)"), "{}", ran.stderr);
        // and one that is mended is told
        let mended = scratch.file("mended.tex", PAPER.replace("(a - b)^2 = a^2 +", "(a - b)^2 = a^2 -"));
        let ran = run(&["audit", &mended, "--baseline", &baseline]);
        assert_eq!(ran.status, Some(0), "{}", ran.stdout);
        assert!(ran.stderr.contains("not found any more: (2)"));
    }
}

#[test]
fn a_formula_is_explained_by_the_name_of_its_label() {
    let scratch = scratch("named");
    let path = scratch.file("paper.tex", PAPER);
    let [by_name, by_number] = ["eq:slip", "2"].map(|label| run(&["audit", &path, "--explain", label]).stdout);
    assert!(by_name.contains("refuted") && by_name == by_number, "{by_name}");
    let ran = run(&["audit", &path, "--explain", "eq:none"]);
    assert!(ran.stderr.contains("no claim `eq:none`"), "{}", ran.stderr);
}

#[test]
fn a_baseline_of_another_document_or_of_none_is_an_error() {
    let scratch = scratch("another");
    let path = scratch.file("paper.tex", PAPER);
    let baseline = scratch.path("baseline.sarif");
    run(&["audit", &path, "--format", "sarif", "--out", &baseline]);
    let other = scratch.file("other.tex", PAPER.replace(r"\label{eq:slip}", r"\tag{B}"));
    let ran = run(&["audit", &other, "--baseline", &baseline]);
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("of another document"), "{}", ran.stderr);
    // where nothing is wrong nothing had to be known: what was is gone
    let ran = run(&["audit", "--baseline", &baseline]);
    assert_eq!(ran.status, Some(0));
    assert!(ran.stderr.contains("not found any more: (2)"), "{}", ran.stderr);
    for (text, why) in [("", "column `label`"), ("{\"runs\": 3}", "no label"), ("[", "EOF")] {
        let wrong = scratch.file("wrong", text);
        run(&["audit", "--baseline", &wrong]).refused(&[why]);
    }
}

#[test]
fn each_format_is_for_the_commands_that_have_it() {
    for (arguments, why) in [
        (
            ["stress", "--format", "html"],
            "[possible values: text, csv, json, jsonl, markdown]",
        ),
        (
            ["check", "--format", "sarif"],
            "[possible values: text, csv, json, jsonl, markdown, junit, html]",
        ),
        (
            ["--format", "junit", "scenes"],
            "`scenes` has no --format junit; choose text, csv, json, jsonl, markdown",
        ),
    ] {
        let ran = run(&arguments);
        assert_eq!(ran.status, Some(2));
        assert!(ran.stderr.contains(why), "{}", ran.stderr);
    }
}

#[test]
fn verdicts_are_tests_in_ci() {
    let text = run(&["audit", "--format", "junit"]).stdout;
    let document = roxmltree::Document::parse(&text).unwrap();
    let tests: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name("testcase"))
        .filter_map(|node| node.attribute("name"))
        .collect();
    assert_eq!(tests, labels(&["audit"]));
    assert_eq!(document.root_element().attribute("failures"), Some("0"));
}

#[test]
fn the_other_commands_have_a_page_of_their_tables_and_figures() {
    let scratch = scratch("others");
    let directory = scratch.path("run");
    let few = ["--set", "sweep.points=41"];
    run(&[&["run", "fig02", "--format", "html", "--out", &directory], &few[..]].concat()).succeeded();
    let of_run = fs::read_to_string(Path::new(&directory).join("report.html")).unwrap();
    let trade = run(&["trade", "orbit", "--problems", "--format", "html"]).stdout;
    for (html, words) in [(&of_run, "<svg"), (&trade, "solved"), (&*CHECK_PAGE, "reproduced")] {
        let xml = as_xml(html);
        let document = roxmltree::Document::parse(&xml).unwrap();
        let heads = document.descendants().filter(|node| node.has_tag_name("th"));
        assert!(html.contains(words) && heads.clone().count() > 3, "{words}");
        assert!(heads.into_iter().all(|head| head.attribute("scope").is_some()));
    }
}

/// Formulas of every kind, many times over.
fn long_sheet(count: usize) -> String {
    let mut sheet = "[symbols]\nparameters = ['a', 'b', 'c']\nnonzero = ['c']\n".to_owned();
    for n in 0..count {
        let tex = match n % 4 {
            0 => format!("(a + {n} b)^2 = a^2 + {} a b + {} b^2", 2 * n, n * n),
            1 => format!(r"\frac{{a + {n}}}{{c}} - \frac{{{n}}}{{c}} = \frac{{a}}{{c}}"),
            2 => format!(r"\sin^2(a + {n}) + \cos^2(a + {n}) = 1"),
            _ => format!(r"\sqrt{{(a^2 + {n})^2}} = a^2 + {n}"),
        };
        sheet.push_str(&format!(
            "[[equation]]\nlabel = 'f{n}'\nrole = 'claim'\ntex = '''{tex}'''\n"
        ));
    }
    sheet
}

#[test]
#[ignore = "a minute: the size and time of a page of 2,000 formulas"]
fn a_page_of_two_thousand_formulas_is_written() {
    let scratch = scratch("long");
    let path = scratch.file("long.toml", long_sheet(2000));
    let page = scratch.path("long.html");
    let start = std::time::Instant::now();
    run(&["audit", &path, "--format", "html", "--out", &page]).succeeded();
    let html = fs::read_to_string(&page).unwrap();
    println!(
        "2,000 formulas: {} kB in {:.1} s",
        html.len() / 1000,
        start.elapsed().as_secs_f64()
    );
    assert_eq!(html.matches("<article").count(), 2000);
    assert!(html.len() < 16_000_000);
}

// In a browser.

/// What a browser prints of a page; nothing, and a word on stderr, where there is none.
fn browser(scratch: &Scratch, page: &str, arguments: &[&str]) -> Option<Output> {
    let profile = scratch.path("profile");
    let _ = fs::remove_dir_all(&profile);
    let output = Command::new("chromium")
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
        ])
        .args([
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        ])
        .arg(format!("--user-data-dir={profile}"))
        .args(arguments)
        .arg(format!("file://{page}"))
        .output();
    match output {
        Ok(output) => Some(output),
        Err(_) => {
            eprintln!("skipped: there is no `chromium` on the path to look at the page with");
            None
        }
    }
}

/// What a script finds of the page, run before its end; the page's own policy is about other scripts.
fn measured(scratch: &Scratch, html: &str, script: &str) -> Option<serde_json::Value> {
    let wrapped = format!(
        "<script>onload = () => {{ const found = (() => {{ {script} }})(); const told = document.createElement('pre'); \
         told.id = 'measured'; told.textContent = JSON.stringify(found); document.body.append(told); }};</script></body>"
    );
    let page = scratch.file("measured.html", html.replace("</body>", &wrapped));
    let output = browser(
        scratch,
        &page,
        &["--virtual-time-budget=5000", "--window-size=1100,900", "--dump-dom"],
    )?;
    let dom = String::from_utf8(output.stdout).expect("UTF-8");
    let (_, found) = dom
        .rsplit_once("<pre id=\"measured\">")
        .unwrap_or_else(|| panic!("nothing measured: {dom}"));
    let found = found.split_once("</pre>").unwrap().0;
    let found = found.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    Some(serde_json::from_str(&found).unwrap())
}

#[test]
fn a_browser_lays_the_page_out_and_has_nothing_to_complain_of() {
    let scratch = scratch("browser");
    let html = &*PAPER_PAGE;
    let page = scratch.file("page.html", html);
    let Some(output) = browser(
        &scratch,
        &page,
        &["--enable-logging=stderr", "--virtual-time-budget=3000", "--dump-dom"],
    ) else {
        return;
    };
    let complaints: Vec<String> = String::from_utf8_lossy(&output.stderr)
        .lines()
        .filter(|line| line.contains("CONSOLE"))
        .map(str::to_owned)
        .collect();
    assert!(complaints.is_empty(), "{complaints:?}");
    let script = "const box = (e) => { const b = e.getBoundingClientRect(); return b.width > 0 && b.height > 0; };\
        const articles = [...document.querySelectorAll('article')];\
        const maths = [...document.querySelectorAll('article > .formula math')];\
        const leaves = [...document.querySelectorAll('article > .formula :is(mi, mn)')];\
        const texts = [...document.querySelectorAll('details > pre')];\
        const folded = texts.filter((t) => t.checkVisibility({ contentVisibilityAuto: true }) && box(t)).length;\
        document.querySelectorAll('details').forEach((d) => { d.open = true; });\
        const unfolded = texts.filter(box).length;\
        document.querySelector('#show-2').click();\
        const refuted = articles.filter((a) => a.dataset.show && box(a)).map((a) => a.id);\
        document.querySelector('#show-0').click();\
        return { articles: articles.map((a) => a.id), maths: maths.length, flat: maths.filter((m) => !box(m)).length,\
          leaves: leaves.length, empty: leaves.filter((m) => !box(m)).length,\
          texts: texts.length, folded, unfolded, refuted, wide: document.documentElement.scrollWidth };";
    let found = measured(&scratch, html, script).unwrap();
    let articles: Vec<&str> = found["articles"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|id| id.as_str())
        .collect();
    for label in labels(&["audit"]) {
        assert!(articles.contains(&&*format!("eq-{label}")), "({label}): {articles:?}");
    }
    assert!(found["maths"].as_u64().unwrap() > 40, "{found}");
    assert_eq!((&found["flat"], &found["empty"]), (&0.into(), &0.into()), "{found}");
    assert_eq!(found["unfolded"], found["texts"]);
    assert_eq!(found["folded"], 0, "{found}");
    assert_eq!(found["refuted"], serde_json::json!(["eq-16", "eq-22"]));
    assert!(found["wide"].as_u64().unwrap() <= 1100, "{found}");
}

#[test]
fn a_browser_sorts_a_table_by_its_numbers() {
    let scratch = scratch("sort");
    let script = "const heads = [...document.querySelectorAll('thead th')];\
        const at = heads.findIndex((h) => h.textContent === 'digits');\
        const column = () => [...document.querySelectorAll('tbody tr')].map((r) => r.cells[at].textContent).filter((t) => t !== '').map(Number);\
        const button = heads[at].querySelector('button');\
        button.click(); const up = column(); const said = heads[at].getAttribute('aria-sort');\
        button.click(); return { up, down: column(), said };";
    let Some(found) = measured(&scratch, &CHECK_PAGE, script) else {
        return;
    };
    let list = |key: &str| -> Vec<f64> {
        found[key]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|n| n.as_f64())
            .collect()
    };
    let (up, down) = (list("up"), list("down"));
    assert!(up.len() > 20 && up.is_sorted(), "{up:?}");
    assert!(down.iter().rev().is_sorted() && down.len() == up.len());
    assert_eq!(found["said"], "ascending");
}

#[test]
fn a_printed_page_has_every_formula_and_every_proof() {
    let scratch = scratch("print");
    let page = scratch.file("page.html", &*PAPER_PAGE);
    let pdf = scratch.path("page.pdf");
    if browser(&scratch, &page, &[&format!("--print-to-pdf={pdf}")]).is_none() {
        return;
    }
    let Ok(printed) = Command::new("pdftotext").args(["-layout", &pdf, "-"]).output() else {
        eprintln!("skipped: there is no `pdftotext` on the path to read the printed page with");
        return;
    };
    let text = String::from_utf8(printed.stdout).expect("UTF-8");
    for label in labels(&["audit"]) {
        assert!(text.contains(&format!("({label})")), "({label})");
    }
    let proofs = text.matches("from a certificate of").count();
    let decided = labels(&["audit"]).len();
    assert!(proofs + 2 >= decided, "{proofs} proofs of {decided} formulas");
}

#[test]
fn what_the_author_of_a_document_without_comments_need_not_look_at_is_folded() {
    let text =
        r"\begin{align*} D &= m (v - u)^2 \\ &= m (v^2 - 2 u v - u^2) \\ &= m v^2 - 2 m u v + m u^2 \end{align*}";
    let ran = program(["audit", "-", "--format", "html"]).input(text).run();
    let xml = as_xml(&ran.stdout);
    let document = roxmltree::Document::parse(&xml).unwrap();
    let folded = |verdict: &str| {
        let mut articles = document.descendants().filter(|node| node.has_tag_name("article"));
        let has_badge = |node: &roxmltree::Node<'_, '_>| {
            let is_badge = |node: roxmltree::Node<'_, '_>| {
                node.attribute("class")
                    .is_some_and(|class| class.starts_with("verdict"))
            };
            node.descendants()
                .any(|node| is_badge(node) && node.text() == Some(verdict))
        };
        let article = articles.find(has_badge).unwrap();
        article.parent().unwrap().has_tag_name("details")
    };
    assert!(folded("given") && !folded("suspect"));
    assert!(
        ran.stdout.contains("<summary>1 given: definitions and laws."),
        "{}",
        ran.stdout
    );
}
