//! Documents as authors write them, in TeX and Markdown: which formulas are taken from them, what is guessed, what is wrong with
//! them; and the paper's own as one.

use crate::common::paper;
use crate::common::program::{Ran, program, scratch};

use paper::vocabulary;
use proptest::prelude::*;
use std::collections::HashMap;
use std::time::{Duration, Instant};
use vibro_audit::claim::{Document, Markup, Sheet, Verdict};
use vibro_audit::prove::{self, Decision, Options};

fn document(text: &str, files: &[(&str, &str)]) -> Document {
    let files: HashMap<&str, &str> = files.iter().copied().collect();
    let mut include = |name: &str| {
        files
            .get(name)
            .map(ToString::to_string)
            .ok_or("there is no such file".to_owned())
    };
    Document::read(text, Markup::Tex, &mut include)
}

fn markdown(text: &str) -> Document {
    Document::read(text, Markup::Markdown, &mut |_| Err("nothing is included".to_owned()))
}

fn decisions(document: &Document) -> Vec<Decision> {
    let sheet = document.sheet(&vocabulary()).unwrap_or_else(|fault| panic!("{fault}"));
    prove::audit(&sheet, &Options::default())
}

/// Label and verdict of each row, as `7.1 proved`.
fn verdicts(document: &Document) -> Vec<String> {
    let shown = |decision: &Decision| format!("{} {}", decision.label, decision.verdict);
    decisions(document).iter().map(shown).collect()
}

fn faults(document: &Document) -> String {
    document.faults.iter().map(|fault| format!("{fault}\n")).collect()
}

const SYMBOLS: &str = "% audit: symbols a, b, c, x, y\n";

#[test]
fn the_papers_document_has_the_verdicts_of_its_sheet() {
    let document = document(include_str!("../../golden/paper/paper.tex"), &[]);
    assert_eq!(
        (faults(&document), document.guesses.as_slice()),
        (String::new(), &[][..])
    );
    let sheet = Sheet::read(include_str!("../../golden/paper/equations.toml"), &vocabulary()).unwrap();
    let of = |decisions: Vec<Decision>| -> Vec<(String, Verdict, Verdict, String)> {
        let all = decisions.into_iter();
        all.map(|own| (own.label, own.verdict, own.expected, own.reason))
            .collect()
    };
    assert_eq!(of(decisions(&document)), of(prove::audit(&sheet, &Options::default())));
}

#[test]
fn each_row_of_a_display_is_a_formula_and_each_link_of_a_chain_a_claim() {
    let text = format!(
        r"{SYMBOLS}% audit: default claim
\begin{{align}}
  (a + b)^2 &= a^2 + 2 a b \\
     &\quad + b^2 \label{{square}} \\
     &= (b + a)^2, \nonumber \\
  a^2 - b^2 &= (a - b)(a + b)
\end{{align}}
\begin{{equation}}\begin{{split}} (a + 1)^2 &= a^2 + 2 a + 1 \\ &= a (a + 2) + 1 \\ &= a (a + 2) \end{{split}}\end{{equation}}
\begin{{equation*}} a + a = 2 a \tag{{A}} \end{{equation*}}
\[ \left\{{ \begin{{aligned}} x + 0 &= x \\ y - y &= 0 \end{{aligned}} \right. \]
$$ \begin{{pmatrix}} a & b \\ c & x \end{{pmatrix}} $$
\begin{{gather}} a b = b a, \\ -a = 0 - a \label{{minus}} \end{{gather}}
\begin{{multline}} a + b + c \\ = c + b + a \end{{multline}}
"
    );
    let found = verdicts(&document(&text, &[]));
    let wanted = [
        "1.1 proved",
        "1.2 proved",
        "3 proved",
        "4.1 proved",
        "4.2 proved",
        "4.3 refuted",
        "A proved",
        "line 11.1 proved",
        "line 11.2 proved",
        "5 proved",
        "6 proved",
        "7 proved",
    ];
    assert_eq!(found, wanted);
}

#[test]
fn comments_say_what_a_formula_is_and_what_it_follows_from() {
    let text = format!(
        r"{SYMBOLS}
\begin{{subequations}}
\begin{{equation}} y = a x \label{{law}} \end{{equation}} % audit: premise
% audit: premise
\begin{{equation}} x = 2 \end{{equation}}
\end{{subequations}}
% audit: claim; follows from \eqref{{law}}, (1b)
\begin{{equation}} y = 2 a \end{{equation}}
\begin{{align}}
 y &= 3 x \\ % audit: claim; follows from (1a); with a = 3
 y &= b x \\ % audit: claim; follows from (1a); assume a = b
 y &= w x \\ % audit: claim; follows from (1a); where w = a
 y &= 4 x \\ % audit: claim; follows from (1a); expect refuted
 y &= anything   % audit: skip
\end{{align}}
"
    );
    let found = document(&text, &[]);
    assert_eq!(faults(&found), "");
    assert_eq!(
        verdicts(&found),
        ["2 proved", "3 proved", "4 proved", "5 proved", "6 refuted"]
    );
    assert!(decisions(&found).iter().all(Decision::is_expected));
}

#[test]
fn macros_and_included_files_are_read_in_their_places() {
    let main = r"\newcommand{\sq}[1]{#1^2} \def\two{2}
% audit: symbols a, b
\begin{equation} \sq{(a+b)} = \sq a + \two a b + \sq b \end{equation} % audit: claim
\input{part}
\begin{equation} \diff = b - a \end{equation} % audit: claim
";
    let part = "% nothing \\[ a = b \\]\n\\newcommand{\\diff}{(b-a)}\n\n\\[ a \\diff = a b - a^3 \\] % audit: claim\n";
    let found = document(main, &[("part", part)]);
    assert_eq!(faults(&found), "");
    let rows = decisions(&found);
    let shown: Vec<String> = rows
        .iter()
        .map(|row| format!("{} {}", row.label, row.verdict))
        .collect();
    assert_eq!(shown, ["1 proved", "line 4 refuted", "2 proved"]);
    assert_eq!((rows[1].file.as_deref(), rows[1].place), (Some("part"), Some((4, 4))));
    assert_eq!(rows[0].place.map(|(line, _)| line), Some(3));
}

#[test]
fn equations_are_numbered_as_they_print() {
    let text = format!(
        "{SYMBOLS}% audit: default claim\r\n\\numberwithin{{equation}}{{section}}\r\n\\section{{One}} \\verb|%| $5\r\n\\begin{{align}} a &= a \\\\ \\intertext{{and $b$}} b &= b \\end{{align}}\r\n\
         \\section*{{None}}\\section{{Two}}\r\n\\iffalse \\[ a = 1 \\] \\fi\r\n$$\r\n c = c\r\n $$\r\n\\begin{{equation}} x = x \\end{{equation}}\r\n\\appendix \\section{{Three}}\\begin{{equation}} y = y \\end{{equation}}\r\n"
    );
    let found = document(&text, &[]);
    assert_eq!(
        (faults(&found), verdicts(&found).join(", ")),
        (
            String::new(),
            "1.1 proved, 1.2 proved, line 9 proved, 2.1 proved, A.1 proved".into()
        )
    );
}

/// Faults of a document with these symbols, and its verdicts.
fn read(text: &str) -> (String, String) {
    let found = document(&format!("{SYMBOLS}{text}"), &[]);
    (faults(&found), verdicts(&found).join(", "))
}

/// A display with one number that is an identity.
fn numbered(letter: &str) -> String {
    format!(r"\begin{{equation}} {letter} = {letter} \end{{equation}} % audit: claim")
}

#[test]
fn counters_are_followed() {
    let sum = numbered("a");
    for (before, label) in [
        (r"\setcounter{equation}{6}", "7"),
        (r"\addtocounter{equation}{-1}", "1"),
        (r"\addtocounter{equation}{2}", "4"),
        (r"\stepcounter{equation}", "3"),
        (r"\refstepcounter{equation}\label{by-hand}", "3"),
        (
            r"\numberwithin{equation}{section}\setcounter{section}{4}\section{Five}",
            "5.1",
        ),
        (r"\section{One}\section{Two}\numberwithin{equation}{section}", "2.2"),
        (r"\begin{subequations}\setcounter{equation}{2}", "2c"),
        (r"\setcounter{page}{9}", "2"),
    ] {
        let found = read(&format!("{sum}\n{before}\n{sum}\n"));
        let wanted = (String::new(), format!("1 proved, {label} proved"));
        let again = format!("1 proved, {label} (line 4) proved");
        assert!(
            found == wanted || (found.0.is_empty() && found.1 == again),
            "{before}: {found:?}"
        );
    }
    for before in [
        r"\setcounter{equation}{\value{section}}",
        r"\addtocounter{equation}{-5}",
        r"\setcounter{parentequation}{2}",
        r"\newcommand{\again}{\setcounter{equation}{0}}",
        r"\newcommand{\nn}{\nonumber}",
    ] {
        let (faults, rows) = read(&format!("{sum}\n{before}\n{sum}\n"));
        assert!(
            faults.contains("line 3") && rows.ends_with("2 proved"),
            "{before}: {faults} {rows}"
        );
    }
    let book = |more: &str| {
        let text = format!(
            "\\documentclass[a4paper]{{book}}\n\\chapter{{A}}\\section{{B}}\n{sum}\n{more}\\chapter{{C}}\n{sum}\n"
        );
        read(&text).1
    };
    assert_eq!(book(""), "1.1 proved, 2.1 proved");
    assert_eq!(book("\\appendix"), "1.1 proved, A.1 proved");
    let (faults, _) = read(r"\begin{equation} a = a \setcounter{equation}{4} \end{equation} % audit: claim");
    assert!(faults.contains("within a display"), "{faults}");
}

#[test]
fn a_reference_to_two_formulas_is_unread_and_names_both() {
    let claim = r"\[ a = 1 \] % audit: claim; follows from \eqref{1}";
    for (text, lines) in [
        (
            r"\begin{equation} a = 1 \label{x} \end{equation} % audit: premise
\begin{equation} a = 2 \label{1} \end{equation} % audit: premise",
            "line 2 and line 3",
        ),
        (
            r"\[ a = 2 \tag{1} \] % audit: premise
\begin{equation} a = 1 \end{equation} % audit: premise",
            "line 2 and line 3",
        ),
        (
            r"\[ a = 2 \label{1} \] % audit: premise
\[ a = 1 \label{1} \] % audit: premise",
            "line 2 and line 3",
        ),
        (
            r"\begin{equation} a = 1 \end{equation} % audit: premise
\setcounter{equation}{0}
\begin{equation} a = 2 \end{equation} % audit: premise",
            "line 2 and line 4",
        ),
    ] {
        let rows = decisions(&document(&format!("{SYMBOLS}{text}\n{claim}"), &[]));
        let last = rows.last().unwrap();
        assert!(
            last.verdict == Verdict::Unread && last.reason.contains(lines),
            "{text}: {rows:?}"
        );
    }
    let (_, rows) = read(&format!(
        "\\begin{{equation}} a = 1 \\label{{1}} \\end{{equation}} % audit: premise\n{claim}"
    ));
    assert!(rows.ends_with(" proved"), "{rows}");
}

#[test]
fn a_macro_of_a_group_is_a_fault_and_so_is_what_an_unknown_conditional_decides() {
    let claim = r"\begin{equation} \q = a \end{equation} % audit: claim";
    let q = r"\newcommand{\q}{a}";
    for (text, fault, rows) in [
        (r"{\renewcommand{\q}{b}}", "within a group", "1 unread"),
        (r"\begingroup\def\q{b}\endgroup", "within a group", "1 unread"),
        (
            r"\begin{center}\renewcommand{\q}{b}\end{center}",
            "within a group",
            "1 unread",
        ),
        (r"{\gdef\q{b}}", "", "1 refuted"),
        (r"{\global\def\q{b}}", "", "1 refuted"),
        (
            r"{\bf x} \begin{document} \emph{y} \renewcommand{\q}{b}",
            "",
            "1 refuted",
        ),
        (r"\iftrue\else\renewcommand{\q}{b}\fi", "", "1 proved"),
        (r"\iftrue\renewcommand{\q}{b}\else\[ a = 2 \]\fi", "", "1 refuted"),
        (r"\iffalse\ifx\a\b\else\fi\renewcommand{\q}{b}\else\fi", "", "1 proved"),
        (r"\iffalse\else\renewcommand{\q}{b}\fi", "", "1 refuted"),
        (r"\iflong\renewcommand{\q}{b}\fi", r"`\iflong` prints", "1 unread"),
        (r"\newif\iflong \iflong\renewcommand{\q}{b}\fi", "", "1 proved"),
        (
            r"\newif\iflong \longtrue \iflong\renewcommand{\q}{b}\fi",
            "",
            "1 refuted",
        ),
        // what a group or another conditional sets is not known behind it
        (
            r"\newif\iflong {\longtrue} \iflong\renewcommand{\q}{b}\fi",
            r"`\iflong` prints",
            "1 unread",
        ),
        (
            r"\newif\iflong \ifx\a\b\longtrue\fi \iflong\renewcommand{\q}{b}\fi",
            r"`\iflong` prints",
            "1 unread",
        ),
        // what number the claim has is not known
        (
            r"\iflong\begin{equation} a = 1 \end{equation}\else\fi",
            r"`\iflong` prints",
            "line 4 proved",
        ),
        (
            r"\ifthenelse{x}{\setcounter{equation}{7}}{}",
            r"`\ifthenelse` prints",
            "line 4 proved",
        ),
        (r"\ifpdf\usepackage{x}\else\usepackage{y}\fi $a \iff b$", "", "1 proved"),
    ] {
        let (faults, found) = read(&format!("{q}\n{text}\n{claim}"));
        let is_fault = if fault.is_empty() {
            faults.is_empty()
        } else {
            faults.contains(fault) && faults.contains("line 3")
        };
        assert!(is_fault && found.ends_with(rows), "{text}: {faults} {found}");
    }
    let (faults, rows) = read(&format!(
        "{q}\n\\iffalse\n\\[ a = 1 \\] % audit: claim; follows from (9)\n\\fi\n{claim}"
    ));
    assert_eq!((faults, rows), (String::new(), "1 proved".to_owned()));
}

#[test]
fn macros_that_are_a_display_are_followed() {
    let (faults, rows) = read(
        r"\def\be{\begin{equation}} \def\ee{ \end{equation} }
\newcommand{\bea}{\begin{eqnarray}} \newcommand\eea{\end{eqnarray}} \newcommand{\beq}{\begin{equation*}} \newcommand{\eeq}{\end{equation*}}
% audit: default claim
\be a + b = b + a \ee
\bea a &=& a \\ b &=& c \eea
\beq x = x \eeq
\be y = y \end{equation}
\begin{equation} y = x \ee
",
    );
    assert_eq!(faults, "");
    assert_eq!(
        rows,
        "1 proved, 2 proved, 3 refuted, line 7 proved, 4 proved, 5 refuted"
    );
    let (faults, _) = read(&format!(
        r"\newcommand{{\beq}}[1]{{\begin{{equation}}\label{{#1}}}} {}",
        numbered("a")
    ));
    assert!(faults.contains("write it out"), "{faults}");
}

#[test]
fn columns_labels_and_conditions_of_rows_are_their_own() {
    let text = format!(
        r"{SYMBOLS}\newcommand{{\h}}{{a}}
\begin{{align}} a &= 1 \label{{u}} & b &= 2 \\ % audit: premise
 c &= 3 \label{{v}} \tag{{C}} % audit: premise
\end{{align}}
\begin{{equation}} a = 2 \end{{equation}} % audit: claim; follows from \eqref{{u}}; expect refuted
\begin{{equation}} c = 3 \end{{equation}} % audit: claim; follows from \eqref{{v}}
\begin{{equation}} \cos\h^2 = \cos(a^2) \end{{equation}} % audit: claim
\begin{{align*}} x x &= x^2 \\ &= x \cdot x \\ &\quad - y + y, \qquad x > 0 \end{{align*}} % audit: premise
\begin{{equation}} \fancybox{{a = b}} \end{{equation}}
"
    );
    let found = document(&text, &[]);
    assert_eq!(faults(&found), "");
    let sheet = found.sheet(&vocabulary()).unwrap();
    let tex = |label: &str| {
        let entry = sheet.entries.iter().find(|entry| entry.label == label).unwrap();
        entry.tex.tex.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    assert_eq!(
        (tex("1"), tex("C"), tex("4")),
        ("a = 1 , b = 2".into(), "c = 3".into(), r"\cos a^2 = \cos(a^2)".into())
    );
    assert_eq!(tex("line 9.2"), r"x^2 = x \cdot x - y + y, \qquad x > 0");
    let rows = verdicts(&found);
    assert!(
        rows.starts_with(&["2 refuted".into(), "3 proved".into()]) && rows.last() == Some(&"5 unread".to_owned()),
        "{rows:?}"
    );
}

#[test]
fn a_row_that_states_nothing_belongs_to_the_one_before_and_cases_share_their_left_side() {
    let text = format!(
        r"{SYMBOLS}
\begin{{align}} (a+b)^2 &= a^2 + 2 a b \\ &\phantom{{=}} + b^2 \notag \end{{align}} % audit: claim
\begin{{align}} (a-b)^2 &= a^2 \\ &\hspace*{{1cm}} - 2 a b \notag \\ &\mathrel{{\phantom{{=}}}} + b^2 \notag \end{{align}} % audit: claim
\begin{{align}} |x| &= x \text{{ for }} x \ge 0, \\ &= -x \text{{ for }} x < 0 \end{{align}}
\begin{{align}} \sqrt{{x^2}} &= x \\ &\text{{for }} x \ge 0 \notag \end{{align}} % audit: claim
\begin{{align}} a &= b \\ &\unknown c \notag \end{{align}} % audit: claim
"
    );
    let text = text
        .replace("&= -x", "% audit: claim\n&= -x")
        .replace("x < 0 \\end{align}", "x < 0 \\end{align} % audit: claim");
    let found = document(&text, &[]);
    assert_eq!(faults(&found), "");
    let rows = verdicts(&found).join(", ");
    assert_eq!(rows, "1 proved, 2 proved, 3 proved, 4 proved, 5 proved, 6 unread");
}

#[test]
fn what_could_be_a_condition_of_another_row_refutes_nothing() {
    for (display, wanted) in [
        (r"\begin{gather*} \sqrt{x^2} = x \\ (x > 0) \end{gather*}", "proved"),
        (
            r"\begin{align*} \sqrt{x^2 y^2} &= x y \text{ for } x > 0 \text{ and}\\ & \quad y > 0. \end{align*}",
            "undecided undecided",
        ),
        (
            r"\begin{align*} \sqrt{x^2 y^2} &= x y, & x &> 0,\\ & & y &> 0. \end{align*}",
            "undecided undecided",
        ),
        (
            r"\begin{gather*} \text{If } x > 0 \text{ then} \\ \sqrt{x^2} = x. \end{gather*}",
            "unread undecided",
        ),
        (
            r"\begin{align*} \sqrt{x^2} &= x, \\ x &> 0. \end{align*}",
            "undecided undecided",
        ),
        (
            r"\begin{equation}\begin{split} \sqrt{x^2 y^2} &= x \sqrt{y^2} \\ &= x y \quad (x,y > 0) \end{split}\end{equation}",
            "undecided proved",
        ),
        (
            r"\begin{align*} \intertext{For $x > 0$} \sqrt{x^2} &= x \end{align*}",
            "undecided",
        ),
        (r"\begin{align*} x &= 1 \\ \Rightarrow x^2 &= 1. \end{align*}", "proved"),
        (
            r"\begin{gather*} x = 1 \\ \Downarrow \\ x^2 = 1 \end{gather*}",
            "undecided unread",
        ),
        (
            r"\begin{align*} \sqrt{x^2 y^2} &= x \sqrt{y^2} \quad (x > 0) \\ &= -x y \quad (y < 0) \end{align*}",
            "proved undecided",
        ),
        (r"\begin{align*} x &= y, \\ y &= x. \end{align*}", "refuted refuted"),
        (
            r"\begin{align*} x = 1 \implies x^2 &= 1 \\ &= x \end{align*}",
            "proved unread",
        ),
        (
            r"\begin{equation}\begin{split} x > 0 \iff |x| &= x \\ &= y \\ &= z \end{split}\end{equation}",
            "proved refuted unread unread",
        ),
        (
            r"\begin{align*} x &> 0 \\ \Rightarrow |x| &= x \\ &= \sqrt{x^2} \end{align*}",
            "proved unread",
        ),
        (
            r"\begin{align*} x + y &= 3 \\ x - y &= 1 \\ \Rightarrow \quad x &= 2 \end{align*}",
            "undecided undecided",
        ),
        (
            r"\begin{align*} x &= 1 \\ x &= 1 \\ \Longrightarrow x^2 &= 1 \end{align*}",
            "undecided proved",
        ),
        (
            r"\begin{align*} x &= y \\ \Rightarrow x^2 &= y^2, \\ x^3 &= y^3 \end{align*}",
            "proved undecided",
        ),
        (
            r"\begin{align*} x &= y \nonumber \\ &\Downarrow \nonumber \\ x^2 &= y^2 \end{align*}",
            "unread undecided",
        ),
        (
            r"\begin{multline*} (x + y)^2 - 2 x y \\ - x^2 - y^2 = 0 \end{multline*}",
            "unread",
        ),
        (
            r"\begin{multline*} (x + y)^2 = x^2 \\ + 2 x y \\ + y^2 \end{multline*}",
            "proved",
        ),
        (
            r"\begin{gather*} (x + y)^2 - 2 x y \\ - x^2 - y^2 = 0 \end{gather*}",
            "unread",
        ),
        (
            r"\begin{aligned} (x + y)^2 & = 2 x y \\ + x^2 + y^2 &= (y+x)^2 \end{aligned}",
            "unread",
        ),
        (
            r"\begin{align*} a b &= b a, & (a+b)(a-b) &= a^2 \\ &= 2 a b - a b & &\quad - b^2 \end{align*}",
            "unread unread",
        ),
    ] {
        let display = display.replace(r"\begin{aligned}", r"\begin{equation}\begin{aligned}");
        let display = display.replace(r"\end{aligned}", r"\end{aligned}\end{equation}");
        let found = document(&format!("{SYMBOLS}% audit: claim\n{display}\n"), &[]);
        let rows: Vec<String> = decisions(&found).iter().map(|row| row.verdict.to_string()).collect();
        assert_eq!(rows.join(" "), wanted, "{display}");
    }
}

#[test]
fn code_of_markdown_states_nothing_and_a_comment_is_of_the_row_on_its_line() {
    let text = "<!-- audit: symbols x -->\n<!-- audit: default claim -->\n~~~\n$$ 1 = 6 $$\n~~~\n\n```\n$$ 1 = 5 $$\n```\n\n$$ x + x = 2 x $$\n";
    assert_eq!(verdicts(&markdown(text)), ["line 11 proved"]);
    let text = r"% audit: symbols x
\begin{align}
 x^2 &= 2 % audit: claim
\\ x &= 1 % audit: premise
\end{align}
";
    assert_eq!(verdicts(&document(text, &[])), ["1 refuted"]);
}

#[test]
fn what_no_author_means_is_not_guessed() {
    for tex in [
        r"\frac{dx}{dt} = 0",
        r"\frac{d}{dt} (m v^2) = 0",
        r"d x^2 = x\, d x",
        r"\lim_{n\to\infty} \frac{a_n}{n} = 0",
        r"\frac{\Delta x}{\Delta t} = \frac{x}{t}",
        r"\Delta x^2 = \Delta x x",
        r"\frac{\delta W}{\delta q} = \frac{W}{q}",
        r"\frac{D u}{D t} = \frac{u}{t}",
        r"\hat{x}\hat{p} = \hat p \hat x",
        r"\|x y\|^2 = \|x\|^2 \|y\|^2",
    ] {
        let text =
            format!("\\begin{{equation}} {tex} \\end{{equation}}\n\\begin{{equation}} b = b \\end{{equation}}\n");
        let rows = verdicts(&document(&text, &[]));
        assert!(
            ["1 unread", "1 undecided", "1 given"].contains(&rows[0].as_str()),
            "{tex}: {rows:?}"
        );
    }
}

#[test]
fn a_guess_is_said_and_never_refutes() {
    let text = r"
\begin{equation} E = \frac{m v^2}{2} + m g h \end{equation}
\begin{align} E &= \frac{m}{2} (v^2 + 2 g h) \\ &= m (v^2 + 2 g h) \end{align}
$$ f(t) = \sin(\omega t) $$
$$ f(t)^2 = 1 - \cos^2(\omega t) $$
$$ f(t) = 1 $$
";
    // a current is a function too
    let current = document(r"\[ v(t) = R i(t) \] \[ v(t)^2 = R^2 i(t)^2 \]", &[]);
    assert!(
        current.guesses.join("\n").contains("functions of t: v, i"),
        "{:?}",
        current.guesses
    );
    assert_ne!(decisions(&current)[0].verdict, Verdict::Unread);
    let found = document(text, &[]);
    let rows = decisions(&found);
    let shown: Vec<String> = rows
        .iter()
        .map(|row| format!("{} {}", row.label, row.verdict))
        .collect();
    assert_eq!(
        shown,
        [
            "1 given",
            "2 proved",
            "3 undecided",
            "line 5 proved",
            "line 6 undecided"
        ]
    );
    let rows = &rows[1..];
    assert!(
        rows[0].reason.contains("guessed") && rows[0].reason.contains("follows from (1)"),
        "{}",
        rows[0].reason
    );
    assert!(
        rows[1].reason.starts_with("fails at") && rows[1].reason.contains("if the guess is right"),
        "{}",
        rows[1].reason
    );
    assert!(rows[1].counterexample.is_none());
    let guesses = found.guesses.join("\n");
    assert!(
        guesses.contains("(1)") && guesses.contains(r"\omega") && guesses.contains("functions of t: f"),
        "{guesses}"
    );
}

#[test]
fn the_label_of_a_display_with_one_number_is_that_of_all_its_rows() {
    let text = format!(
        r"{SYMBOLS}
\begin{{equation}} \begin{{split}} a &= c , \\ b &= 2 c \end{{split}} \label{{both}} \end{{equation}} % audit: premise
\begin{{equation}} a + b = 3 c \end{{equation}} % audit: claim; follows from \eqref{{both}}
"
    );
    let rows = decisions(&document(&text, &[]));
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].verdict, Verdict::Proved, "{}", rows[0].reason);
}

#[test]
fn what_is_said_before_a_display_is_said_of_its_rows_that_say_nothing() {
    let text = format!(
        r"{SYMBOLS}
\begin{{align}} % audit: premise
  a &= c \\
  b &= 2 c
\end{{align}}
% audit: claim; follows from (1), (2)
\begin{{align}}
  a + b &= 3 c \\
  a - b &= c \\
  b &= a % audit: definition
\end{{align}}
"
    );
    let rows = decisions(&document(&text, &[]));
    let verdicts: Vec<Verdict> = rows.iter().map(|row| row.verdict).collect();
    assert_eq!(verdicts[..2], [Verdict::Proved, Verdict::Refuted]);
}

#[test]
fn a_claim_that_its_author_rests_on_a_guess_is_not_refuted() {
    let text = format!(
        r"{SYMBOLS}
\begin{{equation}} E = a b \end{{equation}}
\begin{{equation}} F = E \end{{equation}} % audit: definition
\begin{{equation}} F = 2 a b \end{{equation}} % audit: claim; follows from (2)
\begin{{equation}} a = 2 a \end{{equation}} % audit: claim
"
    );
    let rows = decisions(&document(&text, &[]));
    assert_eq!(
        (rows[0].verdict, rows[1].verdict),
        (Verdict::Undecided, Verdict::Refuted)
    );
    assert!(rows[0].reason.contains("(1) is a definition"), "{}", rows[0].reason);
}

#[test]
fn symbols_beside_those_declared_are_guessed_and_never_refute() {
    let formulas = r"
\begin{equation} E = \frac{m}{2} v^2 + m g h \label{e} \end{equation} % audit: premise
\begin{equation} v^2 = \frac{2 E}{m} - 2 g h \end{equation} % audit: claim; follows from e
\begin{equation} v^2 = \frac{2 E}{m} - 3 g h \end{equation} % audit: claim; follows from e
\begin{equation} q = m v \end{equation} % audit: definition
\begin{equation} q - m v = 0 \end{equation} % audit: claim
\begin{equation} M + v = v + M \end{equation} % audit: claim
\begin{equation} m + m = m \end{equation} % audit: claim
\begin{equation} u(t) + u(t) = 2 u(t) \end{equation} % audit: claim
\begin{equation} \dot w + \dot w = 2 \dot w \end{equation} % audit: claim
\begin{equation} f(w + 1) = f w + f \end{equation} % audit: claim
";
    let found = document(&format!("% audit: symbols positive m\n{formulas}"), &[]);
    let wanted = [
        (
            "2",
            Verdict::Proved,
            "`E`, `g`, `h`, `v`, which no comment declares, are real numbers",
        ),
        (
            "3",
            Verdict::Undecided,
            "`E`, `g`, `h`, `v`, which no comment declares, are real numbers",
        ),
        ("5", Verdict::Proved, "`v`, which no comment declares, is a real number"),
        ("6", Verdict::Proved, "`M` is no misprint of `m`"),
        // what holds declared symbols alone is refuted
        ("7", Verdict::Refuted, "not an identity"),
        (
            "8",
            Verdict::Proved,
            "`u(t)`, which no comment declares, is a real function",
        ),
        // a dot is no letter of its own, and a letter before a bracket may be a function
        ("9", Verdict::Unread, r"unknown symbol `\dot{w}`"),
        ("10", Verdict::Unread, "unknown symbol"),
    ];
    let decided = decisions(&found);
    assert_eq!(decided.len(), wanted.len());
    for (row, (label, verdict, reason)) in decided.iter().zip(wanted) {
        assert_eq!((row.label.as_str(), row.verdict), (label, verdict), "{}", row.reason);
        assert!(row.reason.contains(reason), "{}", row.reason);
        assert_eq!(row.counterexample.is_some(), label == "7", "{label}");
    }
    assert!(
        found.guesses.join("\n").contains("E, M, f, g, h, u, v"),
        "{:?}",
        found.guesses
    );
    decided_as_its_draft(&found);
    // nor do derivatives of a guessed function, and single symbols of a guessed pair
    let beside = r"
\begin{equation} u(t) + u(t) = 2 u(t) \end{equation} % audit: claim
\begin{equation} \dot u + \dot u = \dot u \end{equation} % audit: claim
\begin{equation} x_{1,2} = m \pm m \end{equation} % audit: premise
\begin{equation} 2 x = x \end{equation} % audit: claim
";
    let rows = decisions(&document(&format!("% audit: symbols positive m\n{beside}"), &[]));
    assert!(rows.iter().all(|row| row.verdict != Verdict::Refuted), "{rows:?}");
    let strict = document(&format!("% audit: symbols positive m; only\n{formulas}"), &[]);
    let unread = decisions(&strict)
        .into_iter()
        .filter(|row| row.verdict == Verdict::Unread);
    let unread: Vec<String> = unread.map(|row| row.label).collect();
    for label in ["1", "2", "3", "6", "8", "9", "10"] {
        assert!(unread.iter().any(|own| own == label), "({label}): {unread:?}");
    }
    assert!(!unread.contains(&"7".to_owned()), "{unread:?}");
}

/// Label, verdict and reason of each row of a sheet.
fn rows(sheet: &Sheet) -> Vec<(String, Verdict, String)> {
    let all = prove::audit(sheet, &Options::default()).into_iter();
    all.map(|own| (own.label, own.verdict, own.reason)).collect()
}

/// Checks that the draft of a document, read as a sheet, is decided as the document is; returns the verdicts.
fn decided_as_its_draft(found: &Document) -> Vec<Verdict> {
    let Ok(sheet) = found.sheet(&vocabulary()) else {
        return Vec::new();
    };
    let draft = found.draft("paper.tex");
    let again = Sheet::read(&draft, &vocabulary()).unwrap_or_else(|fault| panic!("{draft}\n{fault}"));
    let entries = |sheet: &Sheet| -> Vec<(String, String, Vec<usize>)> {
        let all = sheet.entries.iter();
        all.map(|own| (own.label.clone(), own.tex.tex.clone(), own.follows_from.clone()))
            .collect()
    };
    assert_eq!(entries(&sheet), entries(&again), "{draft}");
    let wanted = rows(&sheet);
    let verdicts = |rows: &[(String, Verdict, String)]| -> Vec<(String, Verdict)> {
        rows.iter()
            .map(|(label, verdict, _)| (label.clone(), *verdict))
            .collect()
    };
    assert_eq!(verdicts(&rows(&again)), verdicts(&wanted), "{draft}");
    wanted.into_iter().map(|(_, verdict, _)| verdict).collect()
}

#[test]
fn a_draft_is_decided_as_its_document_is() {
    let written = [
        include_str!("../../golden/paper/paper.tex").to_owned(),
        include_str!("../papers/misprinted/bouncing_ball.tex").to_owned(),
        "\\[ y = a x'' \\]\n\\[ y^2 = a^2 x''^2 \\]\n$$ f'(t) = f(t) $$".to_owned(),
        format!("{SYMBOLS}\\begin{{align}} a + b &= b + a \\\\ &= b + a + 0 \\end{{align}} % audit: claim"),
        r"\[ \mathbf{A}\mathbf{B} = \mathbf{B}\mathbf{A} \] \[ a + a = 2 a \]".to_owned(),
        r"\[ S^{-1} A S = A \] \[ a + b = 3 \] \[ f(x) = x^2 \] \[ |z| = z \]".to_owned(),
        "\\begin{equation} a + b = 3 \\end{equation} % audit: claim; expect refuted".to_owned(),
        "\\[ a = \"b\" \\\\ '''c''' = 2 \\]\n\\[ a = a \\]".to_owned(),
    ];
    for text in &written {
        decided_as_its_draft(&document(text, &[]));
    }
}

/// A formula of letters, some of them marked, and of what makes a document guess.
fn formula() -> impl Strategy<Value = String> {
    let letter = prop::sample::select(vec![
        "a",
        "b",
        "x",
        "A",
        "B",
        r"\vec a",
        r"\mathbf{A}",
        r"\bar z",
        "z",
        "x(t)",
        r"\dot x",
        "f(x)",
        "h_{1,2}",
        "h(t)",
        "t",
        r"\Delta x",
        "F(x^2)",
        "A^T",
        r"\det A",
        "e",
        "i",
        "|z|",
        r"\hat H",
        "t_{1,2}",
        r"\mathrm{Re} z",
        r"\dif{r}{t}(t)",
    ]);
    let term = prop::collection::vec(letter, 1..4).prop_map(|factors| factors.join(" "));
    let side = prop::collection::vec(term, 1..3).prop_map(|terms| terms.join(" + "));
    (side.clone(), side).prop_map(|(left, right)| format!("{left} = {right}"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_draft_decides_nothing_that_its_document_does_not(
        formulas in prop::collection::vec(formula(), 1..6),
        comments in prop::collection::vec(prop::sample::select(vec!["", "", "", "% audit: claim", "% audit: premise"]), 6),
    ) {
        let displays = formulas.iter().zip(&comments);
        let displays: Vec<String> =
            displays.map(|(formula, comment)| format!("\\[ {formula} \\] {comment}\n")).collect();
        let text = displays.concat() + "\\[ (a + b)^2 = a^2 + 2 a b + b^2 \\]\n";
        let found = document(&text, &[]);
        // a formula that makes no sense costs no other
        prop_assert!(found.sheet(&vocabulary()).is_ok(), "{}", text);
        let verdicts = decided_as_its_draft(&found);
        let says_nothing = comments.iter().all(|comment| comment.is_empty());
        prop_assert!(!says_nothing || !verdicts.contains(&Verdict::Refuted), "{}", text);
    }
}

#[test]
fn a_letter_of_two_meanings_costs_the_formulas_that_hold_it() {
    for (text, wanted) in [
        (
            "\\[ g_{1,2} = k h_{1,2} \\]\n\\[ h(t) = 2 q(t) \\]\n\\[ (a+b)^2 = a^2 + 2 a b + b^2 \\]\n",
            "line 1 given, line 3 proved",
        ),
        (
            "\\[ t_{1,2} = a \\]\n\\[ x(t) = 2 a t \\]\n\\[ a + b = b + a + 0 \\]\n",
            "line 1 given, line 3 proved",
        ),
        (
            "\\[ v = \\dif{r}{t}(t) \\]\n\\[ x(t) = 2 a t \\]\n\\[ a + b = b + a + 0 \\]\n",
            "line 1 given, line 3 proved",
        ),
    ] {
        assert_eq!(verdicts(&document(text, &[])).join(", "), wanted, "{text}");
    }
}

#[test]
fn what_goes_on_from_a_premise_is_claimed() {
    let row = |comment: &str| {
        format!(
            "% audit: symbols a, b, D\n\\begin{{align}}\n D &= (a-b)^2 \\\\ {comment}\n &= a^2 + b^2\n\\end{{align}}\n\
             \\begin{{equation}} a b = 0 \\end{{equation}} % audit: claim; follows from (1), (2)\n"
        )
    };
    let found = decisions(&document(&row("% audit: premise"), &[]));
    let shown: Vec<String> = found
        .iter()
        .map(|own| format!("{} {}", own.label, own.verdict))
        .collect();
    assert_eq!(shown, ["2 refuted", "3 proved"]);
    assert!(found[1].reason.contains("although refuted: (2)"), "{}", found[1].reason);
    // an author who says it of all rows gives all of them
    let whole = row("").replace(r"\begin{align}", "% audit: premise\n\\begin{align}");
    assert_eq!(verdicts(&document(&whole, &[])), ["3 proved"]);
    let each = row("% audit: premise").replace("a^2 + b^2\n", "a^2 + b^2 % audit: premise\n");
    assert_eq!(verdicts(&document(&each, &[])), ["3 proved"]);
}

#[test]
fn a_declared_letter_before_a_bracket_may_be_a_function() {
    for argument in [
        r"\dot x",
        "x^2",
        r"\frac x2",
        "t_{k+1}",
        "x_{n+1}",
        "x/2",
        r"\omega^2 x",
        r"\cos x",
    ] {
        for letter in ["F", r"\hat F", r"2 \pi F", "F_{n+1}"] {
            let text = format!(
                "% audit: symbols m, F, \\hat F, F_{{n+1}}, x, \\dot x, x_{{n+1}}, t_{{k+1}}, \\omega\n\
                 \\[ F_{{n+1}} = m \\] % audit: premise; label a\n\
                 \\[ {letter}({argument}) = m \\] % audit: claim; follows from a\n"
            );
            let found = decisions(&document(&text, &[]));
            assert!(
                matches!(found[0].verdict, Verdict::Undecided | Verdict::Unread),
                "{letter}({argument}): {} {}",
                found[0].verdict,
                found[0].reason
            );
        }
    }
    let text = "% audit: symbols m, a, b\n\\[ m(a + b) = m a + m b \\] % audit: claim\n\\[ m(a + b) = m a \\] % audit: claim\n";
    assert_eq!(verdicts(&document(text, &[])), ["line 2 proved", "line 3 refuted"]);
    // a letter that the formula uses as a factor too is one, unless the document gives it by a letter of the bracket
    let text = "% audit: symbols M, L, V, a, x\n\\[ M(L/2)^2 = \\frac14 M L^2 \\] % audit: claim\n\
                \\[ M(L/2)^2 = \\frac12 M L^2 \\] % audit: claim\n\\[ V = a x^2 \\] % audit: premise\n\
                \\[ V(x^2) = x^2 V \\] % audit: claim\n\\[ V(x^2) = x V \\] % audit: claim\n";
    assert_eq!(
        verdicts(&document(text, &[])),
        [
            "line 2 proved",
            "line 3 refuted",
            "line 5 undecided",
            "line 6 undecided"
        ]
    );
}

#[test]
fn letters_that_a_document_marks_are_not_taken_for_real_numbers() {
    let product = r"\[ (A + B)(A - B) = A^2 - B^2 \]";
    let power = r"\[ e^{A + B} = e^A e^B \]";
    let modulus = r"\[ |z|^2 = z^2 \]";
    let literal = r"\[ C = A + B \] \[ C + D = \begin{pmatrix} 1 & 2 \\ 3 & 4 \end{pmatrix} \]";
    for (mark, formula) in [
        ("", r"\[ S^{-1} A S = A \]"),
        ("", r"\[ S A S^{-1} + B = A + B \]"),
        ("", r"\[ S^{-2} A S^2 = A \]"),
        (r"\[ \mathbf{N} = A + B \]", product),
        (r"\[ \vec{N} = A + 2 B \]", power),
        (literal, product),
        (r"\[ \det(A) = 1 \] \[ \operatorname{tr}(A B) = 2 \]", power),
        (r"\[ A^\top = A \] \[ B^T = B \]", product),
        (r"\[ [A, B] = 0 \]", power),
        (r"\[ P^{-1} A P = B \]", product),
        (
            r"\[ a^\top b = 1 \] \[ b^T a = 1 \]",
            r"\[ (a + b)(a - b) = a^2 - b^2 \]",
        ),
        (
            "",
            r"\[ (\hat{A} + \hat{B})(\hat{A} - \hat{B}) = \hat{A}^2 - \hat{B}^2 \]",
        ),
        (r"\[ \bar z + w = 1 \]", modulus),
        (r"\[ \overline{z} w = 1 \]", modulus),
        (r"\[ w = \Re z \]", modulus),
        (r"\[ z = x + i y \] \[ e^{i x} = y \]", modulus),
        (r"\[ \bar w = 1 \] \[ z = 2 w \]", modulus),
        (r"\[ z^* = 3 \]", r"\[ \sqrt{z^2} = |z| \]"),
    ] {
        let found = decisions(&document(&format!("{mark}\n{formula}\n"), &[]));
        let last = found.last().unwrap();
        assert!(
            matches!(last.verdict, Verdict::Undecided | Verdict::Unread | Verdict::Given),
            "{mark} {formula}: {} {}",
            last.verdict,
            last.reason
        );
    }
    let group = r"\[ (a_1 b_1)(a_2 b_2)^{-1} = a_1 a_2^{-1} (a_2 b_1 a_2^{-1})(a_2 b_2^{-1} a_2^{-1}) \]";
    for (mark, formula) in [
        ("", r"\[ S^{-1} A S + S^{-1} B S = S^{-1} B S + S^{-1} A S + 0 \]"),
        (r"\[ \vec{N} = A + B \]", r"\[ (A + B) C = A C + B C \]"),
        (r"\[ \vec{N} = A + B \]", r"\[ (p + q)^2 = p^2 + 2 p q + q^2 \]"),
        ("", group),
        (
            r"\[ p = a + b \hat{E} p \]",
            r"\[ \beta (1 - b) = a \implies \beta = \frac{a}{1 - b} \text{ for } b \neq 1 \]",
        ),
        (r"\[ \bar z + w = 1 \]", r"\[ (z + w)^2 = z^2 + 2 z w + w^2 \]"),
        (
            r"\[ \bar z + w = 1 \]",
            r"\[ \sin(z + w) = \sin(z) \cos(w) + \cos(z) \sin(w) \]",
        ),
    ] {
        let found = decisions(&document(&format!("{mark}\n{formula}\n"), &[]));
        let last = found.last().unwrap();
        assert_eq!(last.verdict, Verdict::Proved, "{mark} {formula}: {}", last.reason);
    }
}

#[test]
fn displays_in_directives_of_markdown_are_read() {
    let text = "# Notes\n
```{admonition} Lemma
$$ (a+b)^2 = a^2 + 2ab + b^2 $$
```

$$
\\begin{aligned}
 D &= (a-b)^2 \\\\ % audit: definition
   &= a^2 - 2ab + b^2
\\end{aligned}
$$

:::{math}
:label: swapped

a + b = b + a + 0
:::
  ```{prf:lemma} X
  $$ a - b = -b + a $$
  ```
````{tip}
```{math}
:label: doubled
a + a = 2 a
```
```python
$$ 1 = 2 $$
```
````
:::{theory}
$$ a a = a^2 $$
:::
```{python}
x = \"$$ a = b $$\"
```
```mathematica
a = b
```
~~~{note}
$$ b b = b^2 $$ <!-- audit: claim -->
~~~
";
    let found = markdown(text);
    assert_eq!(faults(&found), "");
    let wanted = [
        "line 4 proved",
        "line 9.2 proved",
        "swapped proved",
        "line 20 proved",
        "doubled proved",
        "line 32 proved",
        "line 41 proved",
    ];
    assert_eq!(verdicts(&found), wanted);
    let said = |guess: &String| guess.contains("`{python}` is taken for code");
    assert!(found.guesses.iter().any(said), "{:?}", found.guesses);
    assert!(found.draft("x").contains("label = \"line 9.1\"\nrole = \"definition\""));
}

#[test]
fn comments_within_displays_of_markdown_say_what_formulas_are() {
    let text = "$$ a + b = 3 % audit: premise\n$$\n```math\n% audit: claim; follows from line 1\na = 3 - b\n```\n\
                $$ 5 \\% = x % a note\n$$\n";
    let found = markdown(text);
    assert_eq!(faults(&found), "");
    assert_eq!(verdicts(&found)[0], "line 5 proved");
}

#[test]
fn a_misspelt_comment_is_reported_and_prose_is_not() {
    let good = r"\begin{equation} a + b = b + a \end{equation} % audit: claim";
    for comment in [
        "% audti: premise",
        "% Audit : claim",
        "% adit: claim; label z",
        "% audit claim",
    ] {
        let found = document(&format!("{SYMBOLS}{good}\n\\[ a = b \\] {comment}\n"), &[]);
        let said = faults(&found);
        assert!(said.contains("did you mean `audit:`?"), "{comment}: {said}");
        assert_eq!(verdicts(&found), ["1 proved", "line 3 unread"], "{comment}");
    }
    let found = markdown("$$ a + b = b + a $$ <!-- audti: claim -->\n");
    assert!(faults(&found).contains("did you mean `audit:`?"), "{}", faults(&found));
    for comment in [
        "% audited by two",
        "% Audit: see the report",
        "% edit: claim",
        "% audit with care",
    ] {
        let found = document(&format!("{SYMBOLS}{good}\n{comment}\n\\[ a + a = 2 a \\]\n"), &[]);
        assert_eq!(faults(&found), "", "{comment}");
    }
    // what does not print says nothing
    let found = document(&format!("{SYMBOLS}{good}\n\\iffalse % audti: claim\n\\fi\n"), &[]);
    assert_eq!(faults(&found), "");
}

#[test]
fn what_is_wrong_is_said_with_its_place_and_the_rest_is_decided() {
    let good = r"\begin{equation} a + b = b + a \end{equation} % audit: claim";
    for (bad, words, line) in [
        (r"\begin{equation} a = {b \end{equation}", "", 0),
        ("\\begin{align} a = b\n\n", r"has no `\end{align}`", 2),
        (r"\begin{dmat} a \end{dmat}", "", 0),
        (r"\[ a = b", r"no `\]`", 2),
        ("$$ a = b\n\n", "no second `$$`", 2),
        (r"\newcommand{\x}[", r"`\newcommand` cannot be read", 2),
        (
            r"\input{nowhere}",
            "`nowhere` cannot be included: there is no such file",
            2,
        ),
        (r"\input{self}", "`self` includes itself", 1),
        ("% audit: symbols impact pair\n", "impact pair beside others", 2),
        ("% audit: value orbits.d, scene fig02\n\n", "no number is printed", 2),
    ] {
        let text = format!("{SYMBOLS}{bad}\n{good}\n");
        let found = document(&text, &[("self", r"\input{self}")]);
        let shown = faults(&found);
        assert!(shown.contains(words), "{bad}\n`{words}` is missing in: {shown}");
        let place = found.faults.first().and_then(|fault| fault.place);
        assert!(
            line == 0 || place.map(|(line, _)| line) == Some(line),
            "{bad}: {place:?}"
        );
        let rows = verdicts(&found);
        assert!(rows.iter().any(|row| row.ends_with(" proved")), "{bad}: {rows:?}");
    }
    let unread = |text: &str, words: &str| {
        let found = document(&format!("{SYMBOLS}{text} % audit: claim\n{good}"), &[]);
        let rows = decisions(&found);
        assert!(
            rows[0].verdict == Verdict::Unread && rows[0].reason.contains(words),
            "{text}: {rows:?}"
        );
        assert_eq!(
            (rows[0].place.map(|(line, _)| line), rows[1].verdict),
            (Some(2), Verdict::Proved),
            "{text}"
        );
    };
    unread(
        "\\[ a = a \\] % audit: clam\n",
        "`clam` says nothing here; did you mean `claim`?",
    );
    unread("\\[ a = a \\] % audit: qed\n", "known: claim, premise");
    unread(r"\newcommand{\r}{\r} \[ a = \r \]", "goes on for ever");
    unread(r"\newcommand{\two}[2]{#1} \[ a = {\two} \]", "lacks an argument");
    unread(r"\[ a = \begin{unknown} b \end{unknown} \]", "unknown");
    unread(r"\[ a = {b \]", "");
    let text = format!("{SYMBOLS}\\[ a = a \\] % audit: claim; follows from (99)\n{good}");
    let rows = decisions(&document(&text, &[]));
    assert!(
        rows[0].reason.contains("`99`, which is no label") && rows[1].verdict == Verdict::Proved,
        "{rows:?}"
    );
}

#[test]
fn markdown_has_displays_fences_and_comments_that_do_not_print() {
    let text = "# Notes\n<!-- audit: symbols a, b -->\nIt costs $5, and `$$ x $$` is code; $a$ is a price.\n\n$$ (a + b)^2 = a^2 + 2 a b + b^2 $$ <!-- audit: claim -->\n\
                \n```math\na b = b a + a\n```\n<!-- audit: claim; expect refuted -->\n\\[ a = b \\tag{7} \\]\n\n```\n$$ a = 1 $$\n```\n";
    let found = markdown(text);
    assert_eq!(faults(&found), "");
    let shown = verdicts(&found);
    assert_eq!(shown.len(), 3, "{shown:?}");
    assert_eq!((shown[0].as_str(), shown[2].as_str()), ("line 5 proved", "7 refuted"));
}

#[test]
fn a_document_of_200_formulas_takes_seconds() {
    let mut text = SYMBOLS.to_owned();
    for n in 1..=200 {
        text.push_str(&format!(
            "\\begin{{equation}} (a + {n} b)^2 = a^2 + {} a b + {} b^2 \\end{{equation}} % audit: claim\n",
            2 * n,
            n * n
        ));
    }
    let start = Instant::now();
    let found = verdicts(&document(&text, &[]));
    assert!(
        found.len() == 200 && found.iter().all(|row| row.ends_with(" proved")),
        "{found:?}"
    );
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_text_is_read_without_a_panic(pieces in prop::collection::vec(prop_oneof![
        prop::sample::select(vec![
            "\\begin{align}", "\\end{align}", "\\begin{equation}", "\\end{equation}", "\\begin{split}", "\\end{split}", "\\[", "\\]",
            "$$", "$", "\\\\", "&", "=", "\\left(", "\\right)", "{", "}", "\\label{é}", "\\tag{7}", "% audit: claim", "% audit: default skip",
            "\n", "a", "b", "\\newcommand{\\x}[1]{#1#1}", "\\x", "\\input{f}", "\\verb|", "\\begin{", "`", "```", "<!--", "-->", "\\", "é", "+",
        ]).prop_map(ToString::to_string),
        ".{0,5}",
    ], 0..40), markdown in any::<bool>()) {
        let text = pieces.concat();
        let markup = if markdown { Markup::Markdown } else { Markup::Tex };
        let found = Document::read(&text, markup, &mut |_| Ok("\\[ a = b \\]".to_owned()));
        let _ = found.sheet(&vocabulary());
        let _ = found.draft("x");
    }
}

#[test]
fn the_command_reads_documents_includes_what_lies_below_and_checks_printed_numbers() {
    let scratch = scratch("commands");
    std::fs::create_dir(scratch.join("sub")).unwrap();
    scratch.file("sub/part.tex", "\\[ a b = b a \\] % audit: claim\n");
    scratch.file("macros.tex", "\\newcommand{\\twice}[1]{2 #1}\n");
    scratch.file(
        "sub/chapter.tex",
        "% audit: symbols a\n\\input{../macros}\n\\[ \\twice{a} = a + a \\] % audit: claim\n",
    );
    assert_eq!(scratch.run(&["audit", "sub/chapter.tex"]).status, Some(0));
    scratch.file(
        "sub/main.tex",
        "% audit: symbols a, b\n\\input{part}\nThe velocity is 0.83272, % audit: value orbits.velocities[0], scene fig02, motion.d=0.4\n",
    );
    let ran = scratch.run(&["audit", "sub/main.tex"]);
    let shown = ran.stdout;
    assert!(
        ran.status == Some(0) && shown.contains("part:1:4") && shown.contains("reproduced"),
        "{shown}"
    );
    scratch.file(
        "sub/wrong.tex",
        "% audit: symbols a, b\n\\input{/etc/passwd}\n\\[ a b = b a \\] % audit: claim\n% audit: value orbits.velocities[0], scene fig02, motion.d=0.4\nIt is 0.9.\n",
    );
    let ran = scratch.run(&["audit", "sub/wrong.tex", "--format", "csv"]);
    let (shown, said) = (ran.stdout, ran.stderr);
    assert_eq!(ran.status, Some(2), "{said}");
    assert!(
        said.contains("leads out of")
            && shown.contains("proved")
            && shown.contains("0.9")
            && shown.contains("off-by-one"),
        "{shown}{said}"
    );
    let ran = scratch.run(&["audit", "sub/main.tex", "--draft"]);
    assert!(ran.stdout.contains("[[equation]]"));
    scratch.file("sheet.toml", "");
    let ran = scratch.run(&["audit", "sheet.toml", "--draft"]);
    assert!(ran.stderr.contains("--draft is of a document"));
}

#[cfg(unix)]
#[test]
fn a_document_without_an_end_is_refused() {
    let scratch = scratch("endless");
    std::os::unix::fs::symlink("/dev/zero", scratch.join("endless.tex")).unwrap();
    let ran = scratch.run(&["audit", "endless.tex"]);
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("more than 8 MB"));
}

#[test]
fn the_document_of_the_guide_is_proved() {
    let guide = include_str!("../../doc/reference/documents.md");
    let (_, rest) = guide.split_once("```tex\n").expect("a document");
    let (text, _) = rest.split_once("```").expect("its end");
    let found = document(text, &[]);
    assert_eq!(faults(&found), "");
    assert_eq!(verdicts(&found), ["2 proved", "3 proved"]);
    assert!(
        decisions(&found)
            .iter()
            .all(|decision| !decision.reason.contains("guess"))
    );
}

#[test]
fn a_label_in_a_comment_is_that_of_all_rows_under_it_that_say_nothing() {
    let text = r"
% audit: symbols x, y
\begin{equation} \begin{cases} x+y=2\\ x-y=0\end{cases} \end{equation} % audit: premise; label S
\begin{equation} x=1 \end{equation} % audit: claim; follows from S
% audit: premise; label G
\begin{gather*} x + 2 y = 4\\ x - y = 1 \end{gather*}
\[ x = 2 \] % audit: claim; follows from G
% audit: premise; label R
\begin{align} x &= y + 3 \\ y &= 1 \end{align}
\[ x = 4 \] % audit: claim; follows from R
";
    let verdicts: Vec<Verdict> = decisions(&document(text, &[])).iter().map(|row| row.verdict).collect();
    assert_eq!(verdicts, [Verdict::Proved; 3]);
}

#[test]
fn what_does_not_print_is_not_judged_and_takes_no_number() {
    let premise = |tex: &str| format!("\\begin{{equation}} {tex} \\end{{equation}} % audit: premise\n");
    let claim = |number: u32| {
        format!("\\begin{{equation}} a^2 = 4 \\end{{equation}} % audit: claim; follows from ({number})\n")
    };
    let (one, two) = (premise("a = 1"), premise("a = 2"));
    for (text, wanted) in [
        (
            format!(
                "\\newcommand{{\\ignore}}[1]{{}}\n\\ignore{{\n{one}}}\n{two}{}",
                claim(1)
            ),
            "2 proved",
        ),
        (
            format!("\\long\\def\\omit#1{{}}\n\\omit{{\n{one}}}\n{two}{}", claim(1)),
            "2 proved",
        ),
        (
            format!(
                "\\excludecomment{{sol}}\n\\begin{{sol}}\n{one}\\end{{sol}}\n{two}{}",
                claim(1)
            ),
            "2 proved",
        ),
        (
            format!(
                "\\begin{{filecontents}}{{a.tex}}\n{one}\\end{{filecontents}}\n{two}{}",
                claim(1)
            ),
            "2 proved",
        ),
        (
            format!("\\newif\\ifdraft\n\\ifdraft\n{one}\\fi\n{two}{}", claim(1)),
            "2 proved",
        ),
        (
            format!("\\newif\\ifdraft\n\\drafttrue\n\\ifdraft\n{one}\\fi\n{two}{}", claim(2)),
            "3 proved",
        ),
        (
            format!(
                "\\newenvironment{{eqn}}{{\\begin{{equation}}}}{{\\end{{equation}}}}\n\\begin{{eqn}} a = 1 \\end{{eqn}} % audit: premise\n{two}{}",
                claim(2)
            ),
            "3 proved",
        ),
        // a number that is not known is no reference
        (
            format!(
                "\\newenvironment{{eqn}}{{\\hrule\\begin{{equation}}}}{{\\end{{equation}}\\hrule}}\n{one}\\begin{{eqn}} a = 1 \\end{{eqn}}\n{two}{}",
                claim(2)
            ),
            "line 6 unread",
        ),
        (
            format!(
                "\\newcommand{{\\shown}}{{\\begin{{equation}} a = 1 \\end{{equation}}}}\n{one}\\shown\n{two}{}",
                claim(2)
            ),
            "line 6 unread",
        ),
        (
            format!(
                "\\begin{{empheq}}[left=\\empheqlbrace]{{align}} a = 1 \\end{{empheq}} % audit: premise\n{two}{}",
                claim(2)
            ),
            "3 proved",
        ),
        (
            format!(
                "\\begin{{subnumcases}}{{\\label{{all}}}} a = 1 \\end{{subnumcases}} % audit: premise\n{two}{}",
                claim(2)
            ),
            "3 proved",
        ),
        (
            format!(
                "\\begin{{dgroup}} a = 1 \\end{{dgroup}} % audit: premise\n{two}{}",
                claim(2)
            ),
            "line 4 unread",
        ),
        (
            format!(
                "\\renewcommand{{\\theequation}}{{A.\\arabic{{equation}}}}\n{two}{}",
                claim(1)
            ),
            "line 4 unread",
        ),
        // a row behind the last sign of a row prints a number
        (
            format!(
                "% audit: premise\n\\begin{{align}} a &= 1 \\\\ \\end{{align}}\n{two}{}",
                claim(3)
            ),
            "4 proved",
        ),
        (
            format!(
                "% audit: premise\n\\begin{{align}} a &= 1 \\\\ \\nonumber \\end{{align}}\n{two}{}",
                claim(2)
            ),
            "3 proved",
        ),
    ] {
        let (_, rows) = read(&text);
        assert!(rows.ends_with(wanted), "{text}: {rows}");
    }
}

#[test]
fn displays_on_one_line_have_labels_of_their_own() {
    let text = r"\[ a + a = 2 a \] and \[ a - a = 0 \] and \[ a = b \]";
    let rows = verdicts(&document(
        &format!("% audit: symbols a, b\n% audit: default claim\n{text}\n"),
        &[],
    ));
    assert_eq!(rows, ["line 3 proved", "line 3 (2) proved", "line 3 (3) refuted"]);
}

#[test]
fn what_a_comment_says_wrong_is_of_its_row_alone() {
    let premise = "\\begin{equation} a = 1 \\end{equation} % audit: premise\n";
    let (_, rows) = read(&format!(
        "{premise}\\begin{{equation}} a = 1 \\end{{equation}} % audit: claim; follow from (1)\n"
    ));
    assert_eq!(rows, "2 unread");
    let own = "\\begin{equation} a = 1 \\end{equation} % audit: claim; follows from (2)\n";
    let (_, rows) = read(&format!(
        "{premise}{own}\\begin{{equation}} a + a = 2 a \\end{{equation}} % audit: claim\n"
    ));
    assert_eq!(rows, "2 unread, 3 proved");
    let text = "% audit: symbols positive b; default claim\n\\[ b + b = 2 b \\]\n";
    assert_eq!(verdicts(&document(text, &[])), ["line 2 proved"]);
    let found = document(
        "% audit: symbols x\n% audit: symbols positive k, functions f\n\\[ x = x \\] % audit: claim\n",
        &[],
    );
    assert!(faults(&found).contains("line 2"), "{}", faults(&found));
    // behind a display it is of all rows, behind a row of that
    let rows = |end: &str, said: &str| {
        let rows = format!("\\begin{{align}}\n a + 1 &= 2 \\\\\n a + 2 &= 3{end}\\end{{align}} % audit: {said}\n");
        read(&format!("{premise}{rows}{}", numbered("a"))).1
    };
    assert_eq!(rows("\n", "claim; follows from (1)"), "2 proved, 3 proved, 4 proved");
    assert_eq!(rows("\n", "skip"), "4 proved");
    assert_eq!(rows(" ", "skip"), "2 proved, 4 proved");
    let line = "\\begin{align} a &= 1 \\\\ 2 a &= 2 \\end{align} % audit: skip\n";
    assert_eq!(read(&format!("{premise}{line}{}", numbered("a"))).1, "4 proved");
    // also where the first row stands behind comments on the document
    let system = "\\begin{align} x + y &= 1 \\\\\n x - y &= 0 \\\\\n\\end{align} % audit: premise; label sys\n\
                  \\[ x = \\frac12 \\] % audit: claim; follows from sys\n";
    for symbols in ["symbols x, y; default claim", "symbols x, y"] {
        let text = format!("% audit: {symbols}\n{system}");
        assert_eq!(verdicts(&document(&text, &[])), ["line 5 proved"], "{symbols}");
    }
}

#[test]
fn letters_that_a_document_uses_in_another_way_are_not_guessed() {
    let last = |formulas: &[&str]| {
        let shown: Vec<String> = formulas.iter().map(|tex| format!("\\[ {tex} \\]\n")).collect();
        let found = decisions(&document(&shown.concat(), &[]));
        found.last().map(|row| row.verdict)
    };
    let proved = Some(Verdict::Proved);
    for formulas in [
        [r"i = \frac{V}{R}", "P = i^2 R", "P = -R"].as_slice(),
        &[r"e = \frac{c}{a}", r"\ln e = 1"],
        &["|z|^2 = z z^*", "|z|^2 = z^2"],
        &[r"z = e^{i k x}", "|z|^2 = z^2"],
        &[r"A = \begin{pmatrix} a & b \\ c & d \end{pmatrix}", "A B = B A"],
        &[r"\det(A B) = \det A \det B", "A B = B A"],
        &[r"A^\top A = A A^\top"],
        &["f(x) = a x + b", r"f^{-1} = \frac{1}{f}"],
        &[r"[x, p] = i \hbar", "x p = p x"],
        &["A^{T} A = A A^{T}"],
        &["A^* A = A A^*"],
        &["i_1 = i_2 + i_3", "u = R i", "P = u i", "P = -R"],
        &["x_i = a + i h", "x_i^4 = (a + i h)^4", "i^2 h = -h"],
        &[r"r (1 + e) = a (1 - e^2)"],
        &[r"\mathcal{L} f g = g \mathcal{L} f"],
        &[r"\sigma_x \sigma_y = \sigma_y \sigma_x"],
        &["p q - q p = 0"],
        &["x = 1", r"\forall x: x^2 = x"],
        &[r"\int_0^t v \, d\tau = v t"],
        &[r"\operatorname{Im} z = 0"],
        &[r"f \ast g = f g"],
        &[r"|u \cdot v| = |u| |v|"],
        &[r"A = \pi r^2", r"A(r + 1) = \pi r^2 (r + 1)"],
        &["2 L u + c = c + 2 u L"],
        &[r"u \times v + w = w + u v"],
        &[r"\gamma^\mu \gamma^\nu = \gamma^\nu \gamma^\mu"],
        &[r"x(t) = A \cos \omega t", r"\dot{x}(t) = A \omega \cos \omega t"],
    ] {
        let found = last(formulas);
        assert!(
            matches!(found, Some(Verdict::Unread | Verdict::Undecided | Verdict::Given)),
            "{formulas:?}: {found:?}"
        );
    }
    assert_eq!(last(&["i^2 = -1"]), proved);
    let found = decisions(&document(
        "\\[ z = e^{i k x_i} \\] \\[ (a + i b)(a - i b) = a^2 + b^2 \\]",
        &[],
    ));
    let row = found.last().unwrap();
    assert_eq!(
        (row.verdict, row.readings.as_slice()),
        (Verdict::Proved, &["`i`: the imaginary unit".to_owned()][..])
    );
    assert_eq!(last(&[r"e^{i x} = \cos x + i \sin x"]), proved);
    assert_eq!(last(&[r"2 \times 3 x = 6 x"]), proved);
    assert_eq!(last(&[r"x^2 = 1 \Rightarrow x = \pm 1"]), proved);
    assert_eq!(last(&[r"x^2 = y \Rightarrow x^4 = y^2"]), proved);
    assert_eq!(last(&[r"\int_0^1 x^2 \, dx = \frac{1}{3}"]), proved);
    assert_eq!(last(&["(x + y)(x - y) + y^2 = x^2"]), proved);
    assert_eq!(last(&["|z|^2 = z^2"]), proved);
    assert_eq!(
        last(&[r"\Delta = b^2 - 4 a c", r"2 a \Delta = 2 a (b^2 - 4 a c)"]),
        proved
    );
    assert_eq!(last(&[r"D = \frac{a}{b}", r"\frac{D}{c} = \frac{a}{b c}"]), proved);
}

#[test]
fn letters_before_brackets_that_may_be_functions_are_not_guessed_to_be_factors() {
    let open = [
        "E[X^2] = E[X]^2",
        r"\delta(2x) = 2\delta(x)",
        r"\zeta(4) = 2 \zeta(2)",
        "[2x] = 2[x]",
        "[x] + [-x] = 0",
        "J_0(2x) = 2 J_0(x)",
        r"\{x\} = x - [x]",
    ];
    for tex in open {
        let verdict = decisions(&document(&format!("\\[ {tex} \\]"), &[]))[0].verdict;
        let is_open = !matches!(verdict, Verdict::Proved | Verdict::Refuted | Verdict::Suspect);
        assert!(is_open, "{tex}: {verdict}");
    }
    let factors = [
        r"\omega(t_2 - t_1) = \omega t_2 - \omega t_1",
        "A(1-x)(1+x) = A(1-x^2)",
        r"\left[ \frac{a}{b} \right]^2 = \frac{a^2}{b^2}",
        "a [ b (c + d) + k ] = a b c + a b d + a k",
    ];
    for tex in factors {
        assert_eq!(
            decisions(&document(&format!("\\[ {tex} \\]"), &[]))[0].verdict,
            Verdict::Proved,
            "{tex}"
        );
    }
}

#[test]
fn a_pair_of_roots_and_its_members_are_guessed_as_one_symbol_each() {
    let text = "\\[ x_{1,2} = \\pm\\sqrt{a} \\]\n\\[ x_1 x_2 = -a \\]\n\\[ x^2 = a \\]\n";
    assert!(
        decisions(&document(text, &[]))
            .iter()
            .all(|row| row.verdict != Verdict::Refuted)
    );
}

#[test]
fn words_and_commutators_mark_letters_and_a_link_stands_for_its_chain() {
    let text = r"Let $z$ be complex.

\[ |z|^2 = z^2 \]

Two non-commuting variables $u$ and $v$:

\[ (u+v)^2 = u^2 + 2uv + v^2 \]
\[ p_1 q_2 - q_2 p_1 = 3 \]
\[ (p_1 + q_2)^2 = p_1^2 + 2 p_1 q_2 + q_2^2 \]
\[ (a + b)^2 = a^2 + 2ab + b^2 \]
";
    let found = verdicts(&document(text, &[]));
    assert_eq!(
        found,
        [
            "line 3 given",
            "line 7 given",
            "line 8 given",
            "line 9 undecided",
            "line 10 proved"
        ]
    );
    // a = b + 1 = x + 2 under its second number
    let chain = r"% audit: symbols a, b, x
% audit: premise
\begin{align} a &= b + 1 \label{q1} \\ &= x + 2 \label{q2} \end{align}
\begin{equation} a = x + 2 \end{equation} % audit: claim; follows from \eqref{q2}
";
    assert_eq!(verdicts(&document(chain, &[])), ["3 proved"]);
}

#[test]
fn a_document_without_comments_has_what_it_gives_what_follows_and_what_is_suspect() {
    let text = r"
\[ f(x) = x^2 \]
\[ f(x+h) - f(x) = 2 x h + h^2 \]
\[ a x_1^2 + b x_1 = 0 \]
\[ b = -a (x_1 + x_2) \]
\[ x_1 x_2 a = 0 \]
\begin{align*} \Delta E &= m (v - u)^2 \\ &= m (v^2 - 2 u v - u^2) \\ &= m v^2 - 2 m u v - m u^2 \end{align*}
\[ \mathbb{E}[X] + p(x | y) - p(x \mid y) = \mathbb{E} \left[ X \right] + Y - Y + p(x|y) - p(x \mid y) \]
";
    let found = document(text, &[]);
    let shown = verdicts(&found);
    assert_eq!(
        shown,
        [
            "line 2 given",
            "line 3 proved",
            "line 4 given",
            "line 5 given",
            "line 6 proved",
            "line 7.1 given",
            "line 7.2 undecided",
            "line 7.3 proved",
            "line 8 proved"
        ],
        "{shown:?}"
    );
    assert!(decisions(&found).iter().all(|row| row.is_expected()));
}

#[test]
fn what_a_letter_may_mean_before_a_bracket_is_one_symbol_in_a_document_without_comments() {
    for (text, wanted) in [
        (r"\[ G(x, y) + G(x, y) = 2 G(x, y) \]", Verdict::Proved),
        (r"\[ G(x, y) = G(y, x) \]", Verdict::Undecided),
        (r"\[ \nabla u - \nabla u = 0 \]", Verdict::Proved),
        (
            r"\[ \mathbb{E}[X] \mathbb{E}[Y] = \mathbb{E}[Y] \mathbb{E}[X] \]",
            Verdict::Undecided,
        ),
        (
            r"\[ \sum_{i=1}^{3} \mathbb{E}[X_i] = 3 \mathbb{E}[X_i] \]",
            Verdict::Undecided,
        ),
        (
            r"\[ \sum_{j=1}^{2} \max_i x_{ij} = 2 \max_i x_{ij} \]",
            Verdict::Undecided,
        ),
        (r"\[ v(w) - b (1 - a) v(w) = v(w) (1 - b + a b) \]", Verdict::Proved),
    ] {
        let found = decisions(&document(text, &[]));
        let verdict = found[0].verdict;
        let is_open = matches!(verdict, Verdict::Undecided | Verdict::Given);
        assert!(
            verdict == wanted || (is_open && wanted == Verdict::Undecided),
            "{text}: {verdict} {}",
            found[0].reason
        );
    }
}

#[test]
fn what_rests_on_something_loose_is_not_proved_in_a_document_without_comments() {
    for text in [
        r"\begin{align*} x^2 &= \int 2 x \, dx \\ &= x^2 + 1 \end{align*}",
        r"\[ F = \int 2 x \, dx \] \[ F = x^2 \]",
        r"\[ \int 2 x \, dx - \int 2 x \, dx = 1 \]",
        r"\[ f = g + O(h^2) \] \[ k = g + O(h^2) \] \[ f - k = 0 \]",
        r"\[ O(h) - O(h) = 0 \]",
        r"\[ \mathcal{O}(h) - \mathcal{O}(h) = 0 \]",
        r"\[ a = 2 \] \[ a = 3 \] \[ b = 5 a \] \[ b = 10 \]",
        r"\[ y = 0 \quad \text{(at equilibrium)} \] \[ y + 1 = 1 \]",
        r"\[ (\hat a - \hat b)(\hat a + \hat b) = \hat a^2 - \hat b^2 \]",
        r"\[ (\mathcal{L} - \mathcal{M})(\mathcal{L} + \mathcal{M}) = \mathcal{L}^2 - \mathcal{M}^2 \]",
        r"\[ x = 1.5 \] \[ y = 10{,}000 x \] \[ y = 15 \]",
    ] {
        let found = decisions(&document(text, &[]));
        let last = found.last().unwrap();
        assert!(
            last.verdict != Verdict::Proved,
            "{text}: {} {}",
            last.verdict,
            last.reason
        );
    }
}

/// Runs `audit` on a document.
fn audited(text: &str) -> Ran {
    program(["audit", "-", "--format", "csv"]).input(text).run()
}

#[test]
fn a_slip_in_a_chain_is_suspect_and_the_link_behind_it_is_not() {
    let text =
        r"\begin{align*} D &= m (v - u)^2 \\ &= m (v^2 - 2 u v - u^2) \\ &= m v^2 - 2 m u v + m u^2 \end{align*}";
    let ran = audited(text);
    let rows: Vec<&str> = ran.stdout.lines().skip(1).collect();
    assert_eq!((ran.status, rows.len()), (Some(1), 3), "{}", ran.stdout);
    let wanted = ["given,", "suspect,", "undecided,"];
    assert!(
        rows.iter().zip(wanted).all(|(row, verdict)| row.contains(verdict)),
        "{}",
        ran.stdout
    );
    assert!(rows[1].contains("wrong sign of the term"), "{}", rows[1]);
    assert!(rows[2].contains("holds once"), "{}", rows[2]);
    // people are told how many there are, and see what is suspect first
    let ran = program(["audit", "-"]).input(text).run();
    let counts = "3 formulas and links of chains: 1 suspect, 1 given, 1 undecided";
    assert!(ran.stderr.contains(counts), "{}", ran.stderr);
    let verdict = ran.stdout.lines().nth(2).and_then(|row| row.split_whitespace().nth(2));
    assert_eq!(verdict, Some("suspect"), "{}", ran.stdout);
}

#[test]
fn a_derivation_under_a_condition_that_stands_in_words_is_not_suspect() {
    for chain in [
        r"(1 - p)^2 &= 1 - 2 p + p^2 \\ &= 1 - 2 p + p \\ &= 1 - p",
        r"(a + b)^2 &= a^2 + 2 a b + b^2 \\ &= a^2 + b^2",
        r"(x + h)^2 - x^2 &= 2 x h + h^2 \\ &= 2 x h",
        r"\phi^3 &= \phi \cdot \phi^2 \\ &= \phi (\phi + 1) \\ &= \phi^2 + \phi",
    ] {
        let ran = audited(&format!("\\begin{{align*}} {chain} \\end{{align*}}"));
        assert_eq!(
            (ran.status, ran.stdout.contains(",suspect,")),
            (Some(0), false),
            "{chain}: {}",
            ran.stdout
        );
    }
}

#[test]
fn each_link_of_a_chain_on_one_line_is_judged_by_itself() {
    let text = r"
$$ y = (a+b)^2 = a^2 + 2 a b + b^2 = a^2 + b (2 a - b) $$
$$ y = a^2 + 2 a b + b^2 $$
";
    let found = Document::read(text, Markup::Markdown, &mut |_| Err(String::new()));
    assert_eq!(
        verdicts(&found),
        [
            "line 2.1 given",
            "line 2.2 proved",
            "line 2.3 undecided",
            "line 3 proved"
        ]
    );
    let ran = audited("\\[ y = (a+b)^2 = a^2 + 2 a b + b^2 = a^2 + b (2 a - b) \\]");
    assert!(
        ran.status == Some(1) && ran.stdout.contains("line 1.3,suspect"),
        "{}",
        ran.stdout
    );
}

#[test]
fn a_formula_that_is_not_read_is_given_where_it_only_defines_or_says_something() {
    let text = r"
\[ X = [x_1, \ldots, x_n] \otimes P \]
\[ Y \sim \mathcal{N}(\mu, \sigma^2) \]
\begin{align*} c &= a + b \\ &= b \oplus a \end{align*}
";
    let found = document(text, &[]);
    let shown = verdicts(&found);
    assert_eq!(
        shown,
        ["line 2 given", "line 3 given", "line 4.1 given", "line 4.2 undecided"]
    );
}

#[test]
fn the_term_of_a_macro_that_is_not_at_hand_is_one_symbol() {
    let text = r"
\begin{align*} c &= \inv{2} \qdot_1 + a + b \\ &= b + \inv{2} \qdot_1 + a \\ &= b + \qdot_1 \inv{2} + a \end{align*}
\[ \inv{a} + \inv{b} = \inv{b} + \inv{a} \]
";
    let found = document(text, &[]);
    assert_eq!(
        verdicts(&found),
        [
            "line 2.1 given",
            "line 2.2 proved",
            "line 2.3 undecided",
            "line 3 proved"
        ]
    );
    // nothing says what it prints: a derivative, an operator, a function, a sign
    for chain in [
        r"\frac{\pa u}{\pa x} = \frac{u}{x}",
        r"z = \ddt u^2 = u \ddt u",
        r"\Var (X - Y) = \Var X - \Var Y",
        r"2 (a \pl b) = 2 a \pl b",
        r"a + b \mx c - a = b \mx c",
        r"a + b \wedge c - a = b \wedge c",
        r"(A B)\tp = A B\tp",
        r"\frac{\Log a}{\Log b} = \frac{a}{b}",
        r"z = \ddt \frac{u^2}{2} = u \ddt u",
        r"z = 2 (a \pl b) = 2 a \pl 2 b",
        r"z = \dist(x - y) = \dist(y - x)",
    ] {
        let ran = audited(&format!("\\[ {chain} \\]"));
        let has = |verdict: &str| ran.stdout.contains(&format!(",{verdict},"));
        assert!(!has("proved") && !has("suspect"), "{chain}: {}", ran.stdout);
    }
}

#[test]
fn a_term_that_cannot_be_read_is_one_symbol_and_what_has_no_value_is_not() {
    let text = r"
\begin{align*} a &= 2 \int_S v dS + b - c \\ &= b - c + 2 \int_S v dS \\ &= b - c + \int_S v dS \end{align*}
\[ (x + y)^2 - 2 x y + \{u\}_+ = x^2 + y^2 + \{u\}_+ \]
\[ |p + \{u\}_+| - |p + \{v\}_+| = \{u\}_+| - \{v\}_+| \]
\[ x_1 + x_2 + \dots = \dots + x_2 + x_1 \]
\[ x = \int y dx + z \]
";
    let found = document(text, &[]);
    assert_eq!(
        verdicts(&found),
        [
            "line 2.1 given",
            "line 2.2 proved",
            "line 2.3 undecided",
            "line 3 proved",
            "line 4 given",
            "line 5 undecided",
            "line 6 given"
        ]
    );
}

#[test]
fn each_arrow_of_a_chain_is_judged_by_itself_and_what_it_assumes_holds_nowhere_else() {
    let text = r"
\begin{align} 2 x &= 4 z \\ \Rightarrow x &= 2 z \\ \Rightarrow x^2 &= 4 z^2 \end{align}
\[ 3 u + 6 w = 0 \Leftrightarrow 3 u = -6 w \iff u = 2 w \]
\[ p - q = 0 \Rightarrow p = q \]
\[ \Rightarrow p^2 = q^2 \]
\[ g = 0 \Rightarrow h = 3 \Rightarrow h^2 = 9 \]
\[ g s = 0 \]
\[ y = 1 \iff 0 y = 0 \iff 0 = 0 \]
";
    let found = document(text, &[]);
    let shown = verdicts(&found);
    let proved: Vec<&str> = shown.iter().filter_map(|row| row.strip_suffix(" proved")).collect();
    assert_eq!(
        proved,
        [
            "1.1",
            "1.2",
            "line 3.1 =>",
            "line 3.1 <=",
            "line 4",
            "line 5",
            "line 6.2",
            "line 8.1 =>",
            "line 8.2 =>",
            "line 8.2 <="
        ],
        "{shown:?}"
    );
}

#[test]
fn what_rests_on_a_letter_with_another_value_is_not_proved() {
    let text = "\\section{A}\n\\[ f = a + b \\]\n\\section{B}\n\\[ f = a b \\]\n\\[ f - a = b \\]\n\\[ g = a + b \\]\n\\[ g = b + a \\]\n\\[ g - a = b \\]\n";
    assert_eq!(
        verdicts(&document(text, &[])),
        [
            "line 2 given",
            "line 4 undecided",
            "line 5 undecided",
            "line 6 given",
            "line 7 proved",
            "line 8 proved"
        ]
    );
}

#[test]
fn an_inverse_of_a_product_says_of_no_factor_that_it_has_one() {
    for text in [
        "\\[ \\mathbf{x} = (\\mathbf{A}^T \\mathbf{A})^{-1} \\mathbf{A}^T \\mathbf{b} \\]\n\\[ \\mathbf{A} \\mathbf{x} = \\mathbf{b} \\]\n",
        "\\[ S = H P H^T \\]\n\\[ K = P H^T S^{-1} \\]\n\\[ K H = 1 \\]\n",
        "\\[ s = w^\\top x \\]\n\\[ s = x w^\\top \\]\n",
        "\\[ w = (\\vec b \\vec c + \\vec b \\vec e) \\vec d \\]\n\\[ w = \\vec b (\\vec c \\vec d + \\vec e \\vec d) \\]\n",
    ] {
        let shown = verdicts(&document(text, &[]));
        assert!(shown.iter().all(|row| !row.ends_with("proved")), "{text}: {shown:?}");
    }
}

#[test]
fn a_claim_rests_on_the_equations_before_it_that_hold_its_letters() {
    let text = r"
\[ m = \rho v A = \rho w B \]
\[ c^2 = \frac{p}{q} \]
\[ F = m (v - w) \]
\begin{align*} P &= F v \\ &= \rho w B (v - w) v \end{align*}
";
    let found = document(text, &[]);
    assert_eq!(verdicts(&found).last().map(String::as_str), Some("line 5.2 proved"));
}

#[test]
fn letters_in_bold_and_second_shapes_are_letters_of_their_own() {
    let text = r"
\[ W + 2 \mathbf{W} = 3 \mathbf W + W - \mathbf{W} \]
\[ W - \mathbf{W} = 0 \]
\[ \epsilon + \varepsilon - \epsilon = \varepsilon \]
";
    let found = document(text, &[]);
    assert_eq!(verdicts(&found), ["line 2 proved", "line 3 undecided", "line 4 proved"]);
}

#[test]
fn a_function_whose_formula_is_not_understood_depends_on_its_argument() {
    let text = r"
\[ H(f) = \sum_i f_i \log(f_i) \]
\begin{align*} K &= 2 H(f) + c - H(f) \\ &= H(3 f) + c \end{align*}
";
    let found = document(text, &[]);
    assert!(
        !verdicts(&found).contains(&"line 3.2 proved".to_owned()),
        "{:?}",
        verdicts(&found)
    );
}

#[test]
fn macros_are_those_of_the_document_that_includes_this_one() {
    let scratch = scratch("root");
    std::fs::create_dir_all(scratch.join("book/chapters")).unwrap();
    scratch.file(
        "book/main.tex",
        "\\documentclass{book}\n\\usepackage{own}\n\\newcommand{\\half}{\\frac{1}{2}}\n\\begin{document}\n\\include{chapters/one}\n\\end{document}\n",
    );
    scratch.file("book/own.sty", "\\DeclarePairedDelimiter{\\size}{\\lvert}{\\rvert}\n");
    // \xe9 is a letter of Latin-1
    let chapter = "% caf\u{e9}\n\\[ \\half a + \\half a = a \\]\n\\[ \\size{-b} = \\size*{b} \\]\n";
    let latin: Vec<u8> = chapter.chars().map(|c| c as u8).collect();
    std::fs::write(scratch.join("book/chapters/one.tex"), latin).unwrap();
    let ran = scratch.run(&["audit", "book/chapters/one.tex", "--format", "csv"]);
    assert_eq!(
        ran.stdout.matches(",proved,").count(),
        2,
        "{}{}",
        ran.stdout,
        ran.stderr
    );
    assert!(
        ran.stderr.contains("macros of") && ran.stderr.contains("Latin-1"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_file_is_looked_for_in_the_directories_above_too() {
    let scratch = scratch("above");
    std::fs::create_dir_all(scratch.join("book/one/two")).unwrap();
    std::fs::create_dir_all(scratch.join("book/.git")).unwrap();
    scratch.file("book/header.tex", "\\newcommand{\\half}{\\frac{1}{2}}\n");
    scratch.file("outside.tex", "\\newcommand{\\third}{\\frac{1}{3}}\n");
    scratch.file(
        "book/one/two/own.tex",
        "\\documentclass{article}\\input{header}\\input{outside}\\begin{document}\n\\[ \\half a + \\half a = a \\]\n\\[ 3 \\third a = a \\]\n\\end{document}\n",
    );
    let ran = scratch.run(&["audit", "book/one/two/own.tex", "--format", "csv"]);
    assert!(ran.stdout.contains("line 2,proved,"), "{}{}", ran.stdout, ran.stderr);
    assert!(!ran.stdout.contains("line 3,proved,"), "{}{}", ran.stdout, ran.stderr);
}

#[test]
fn functions_of_several_arguments_are_put_in_where_a_definition_gives_them() {
    let text = r"
$$ Q(x, y) = a x^2 y $$
$$ Q(1, 2) = 2 a $$
$$ 2 Q(y, x) = 2 a y^2 x $$
$$ \frac{\partial Q}{\partial x} = 2 a x y $$
$$ 2 Q(x, y) = 2 a x y^2 $$
$$ Q(1, 2) = 3 a $$

The wave is
$$ u(x, t) = A \sin(k x - \omega t) $$
$$ \frac{\partial^2 u}{\partial t^2} = -\omega^2 u(x, t) $$
$$ \frac{\partial^2 u}{\partial x \partial t} = k \omega u $$
$$ \frac{\partial^2 u}{\partial x^2} = k^2 u $$
$$ u(x, 0) = A \sin k x $$
";
    let is_proved = |text: &str| -> Vec<bool> {
        let decided = decisions(&document(text, &[]));
        decided.iter().map(|row| row.verdict == Verdict::Proved).collect()
    };
    let wanted = [false, true, true, true, false, false, false, true, true, false, true];
    assert_eq!(is_proved(text), wanted);
    // of what is no definition nothing is known, and it is read all the same
    for text in [
        "$$ G(x, y) = - G(y, x) $$\n\n$$ G(1, 2) = - G(2, 1) $$",
        "$$ P(A, B) = c P(A) $$\n\n$$ P(A) = 1 $$\n\n$$ P(1, 2) = c $$",
        "$$ h(1, 2) = 3 $$\n\n$$ h(x, y) = x + y $$\n\n$$ h(2, 2) = 5 $$",
        "$$ h(x, x) = 2 x $$\n\n$$ h(1, 2) = 2 $$",
        // what else may depend on x, and on t
        "$$ f(x, y) = x^2 y $$\n\n$$ \\frac{d f}{d x} = 2 x y $$",
        "$$ L(x, v) = m v^2 - k x $$\n\n$$ \\frac{d}{dt} \\frac{\\partial L}{\\partial v} = 0 $$",
        "$$ u(x, t) = t x $$\n\n$$ \\int_0^1 u \\, dx = t x $$",
        "$$ h(x_1, \\dots, x_n) = x_1 $$\n\n$$ h(1, 2) = 1 $$",
    ] {
        let decided = decisions(&document(text, &[]));
        let is_wanted = |row: &Decision| !matches!(row.verdict, Verdict::Proved | Verdict::Unread);
        assert!(decided.iter().all(is_wanted), "{text}: {decided:#?}");
    }
}

#[test]
fn nothing_follows_from_a_derived_formula_that_is_not_proved() {
    for text in [
        "$$ f = (1+x)^2 = 1 + 2 x $$\n\n$$ z = 1 - 7 x $$\n\n$$ z = x^2 $$\n",
        "$$ E = \\frac{m c^2}{\\sqrt{1 - v^2/c^2}} = m c^2 + \\frac{1}{2} m v^2 $$\n\n$$ T = E - m c^2 $$\n\n$$ T = m v^2 $$\n",
        "$$ p = m v $$\n\n$$ T = \\frac{1}{2} m v^2 = \\frac{m^2 v^2}{m} = \\frac{p^2}{2 m} $$\n",
    ] {
        let found = Document::read(text, Markup::Markdown, &mut |_| Err(String::new()));
        let shown = verdicts(&found);
        assert!(shown.iter().all(|row| !row.ends_with("proved")), "{text}: {shown:?}");
    }
}

#[test]
fn the_first_link_of_a_chain_may_be_suspect_and_what_may_be_meant_otherwise_is_not() {
    for (chain, is_suspect) in [
        (r"(x+1)^3 = x^3 + 3 x^2 + 3 x + 3 = x (x^2 + 3 x + 3) + 3", true),
        (r"y = \frac{x}{3} + x = 1.33 x", false),
        (r"y = \frac{x^2}{2} + 2 C = \frac{x^2}{2} + C", false),
        (r"a^2 + b^2 \ge 2 a b \ge a b", false),
        (r"r = \cos(n \pi - x) = \cos(n \pi + x)", false),
    ] {
        let ran = audited(&format!("\\[ {chain} \\]"));
        assert_eq!(ran.stdout.contains(",suspect,"), is_suspect, "{chain}: {}", ran.stdout);
    }
}

#[test]
fn a_root_file_that_includes_itself_many_times_is_read_once() {
    let scratch = scratch("circles");
    let inputs = "\\input{main}\n".repeat(2000);
    scratch.file(
        "main.tex",
        format!("\\newcommand{{\\half}}{{\\frac{{1}}{{2}}}}\n{inputs}\\begin{{document}}\n\\input{{one}}\n"),
    );
    scratch.file("one.tex", "\\[ \\half a + \\half a = a \\]\n");
    let ran = scratch.run(&["audit", "one.tex", "--format", "csv"]);
    assert!(ran.stdout.contains(",proved,"), "{}{}", ran.stdout, ran.stderr);
}

/// Matrices and vectors of which no entry is known, in documents without comments: what holds of all of them.
const OF_MATRICES: [(&str, &str); 17] = [
    (
        r"Let $X$ be a matrix.",
        r"(X^\top X + \mu I)^{-1} X^\top = X^\top (X X^\top + \mu I)^{-1} \[ I A = A \]",
    ),
    (
        r"\[ \mathbf{y} = \mathbf{X} \boldsymbol\beta + \boldsymbol\epsilon \]",
        r"(\mathbf{X}^\top \mathbf{X})^{-1} \mathbf{X}^\top \mathbf{y} = \boldsymbol\beta + (\mathbf{X}^\top \mathbf{X})^{-1} \mathbf{X}^\top \boldsymbol\epsilon",
    ),
    (r"\[ H = X (X^\top X)^{-1} X^\top \]", r"H H = H"),
    (r"\[ H = X (X^\top X)^{-1} X^\top \]", r"H^\top = H"),
    (r"\[ Q^\T Q = I \] \[ B = Q^\T A Q \]", r"B^\T = Q^\T A^\T Q"),
    (r"Let $A$, $B$ be matrices.", r"(A + B)^2 = A^2 + A B + B A + B^2"),
    (
        r"Let $A$, $B$, $C$ be matrices.",
        r"(A B C)^\mathrm{T} = C^\mathrm{T} B^\mathrm{T} A^\mathrm{T}",
    ),
    (r"\[ A = P D P^{-1} \]", r"A^3 = P D^3 P^{-1}"),
    (
        r"\[ K \mathbf{c} + P \mathbf{d} = \mathbf{f} \]",
        r"\mathbf{c} = K^{-1} (\mathbf{f} - P \mathbf{d})",
    ),
    (
        r"\[ \vec{u} = \vec{a} + \vec{b} \]",
        r"\vec{u} \cdot \vec{u} = \vec{a} \cdot \vec{a} + 2 \vec{a} \cdot \vec{b} + \vec{b} \cdot \vec{b}",
    ),
    (
        r"\[ \vec{u} = \vec{a} + k \vec{b} \]",
        r"\vec{u} \times \vec{b} = \vec{a} \times \vec{b}",
    ),
    (r"Let $A$ and $B$ be operators.", r"A B - B A + B A = A B"),
    (r"\[ P = X (X^\top X)^{-1} X^\top \] \[ Q = I - P \]", r"Q X = 0"),
    (r"Let $A$ be a matrix.", r"(A - \lambda I) v = A v - \lambda v"),
    (r"\[ A = Q R \] \[ Q^\top Q = I \]", r"A^\top A = R^\top R"),
    (
        r"\[ f = (y - X b)^\top (y - X b) \]",
        r"f = y^\top y - 2 b^\top X^\top y + b^\top X^\top X b",
    ),
    (r"Let $A$ be a matrix.", r"x^\top A x = \frac12 x^\top (A + A^\top) x"),
];

#[test]
fn what_holds_of_matrices_without_entries_is_proved_in_a_document_without_comments() {
    for (before, claim) in OF_MATRICES {
        let (claim, behind) = claim
            .split_once(r" \[ ")
            .map_or((claim, String::new()), |(claim, behind)| {
                (claim, format!(r"\[ {behind}"))
            });
        let text = format!("{before} {behind}\n\\[ {claim} \\]\n");
        let found = decisions(&document(&text, &[]));
        let last = found.last().unwrap();
        assert_eq!(last.verdict, Verdict::Proved, "{text}: {}", last.reason);
    }
}

#[test]
fn what_the_text_says_where_words_announce_it_is_given() {
    let text = r"The mean is
\begin{equation} m = \frac{a N_t + b N_c}{N}, \end{equation}
where $N = N_t + N_c$ and $p = \frac{N_t}{N}$. Hence
\begin{equation} m = a p + b (1 - p) . \end{equation}
If $a = b$ we have
\begin{equation} m = a . \end{equation}
Let $u = x^2 + 1$. Then
\begin{equation} (x^2 + 1)^3 = u^3 . \end{equation}
";
    let found = decisions(&document(text, &[]));
    let verdicts: Vec<Verdict> = found.iter().map(|row| row.verdict).collect();
    let [given, proved, open] = [Verdict::Given, Verdict::Proved, Verdict::Undecided];
    // what holds in a case alone is not taken
    assert_eq!(verdicts, [given, proved, open, proved]);
    for text in [
        "If we set $a = b$ this is simple.",
        "We do not set $a = b$.",
        "Let $a = b$ if $x > 0$.",
        "It is wrong to write $a = b$.",
        "It has a maximum where $a = b$.",
        "On the set $a = b$ it vanishes.",
        "where $a = b$ does not hold.",
        "where $a = b$ for small $c$.",
        r"A note.\footnote{Let $a = b$.}",
        "One might think that since $a = b$, all is done.",
    ] {
        let text = format!("\\[ y = a + b \\]\n{text}\n\\[ y = 2 a \\]\n");
        let found = decisions(&document(&text, &[]));
        assert_ne!(found.last().unwrap().verdict, Verdict::Proved, "{text}");
    }
    assert!(found[1].reason.contains("text of line 3"), "{}", found[1].reason);
}

#[test]
fn what_the_text_says_holds_in_its_part_alone() {
    let last = |text: &str| decisions(&document(text, &[])).pop().unwrap().verdict;
    let sum = r"\[ y = a + b \] Hence \[ y = 2 a \]";
    for part in [
        r"\begin{example} Let $a = b$. \end{example}",
        r"\begin{proof} Let $a = b$. Contradiction. \end{proof}",
        r"\section{Symmetric case} Let $a = b$. \section{General case}",
        "Case 1: let $a = b$. Case 2: let $a = c$.",
        r"\begin{itemize} \item Let $a = b$. \item \end{itemize}",
        "Let $a = b$, a special case.",
    ] {
        assert_ne!(last(&format!("{part} {sum}")), Verdict::Proved, "{part}");
    }
    assert_eq!(last(&format!("Let $a = b$. {sum}")), Verdict::Proved);
    let within = format!(r"\begin{{example}} Let $a = b$. {sum} \end{{example}}");
    assert_eq!(last(&within), Verdict::Proved);
    // another value in each part
    let two = r"\paragraph{One.} Let $u = x^2$. \[ y = u + 1 \] \paragraph{Two.} Let $u = 3 x$. \[ z = u - 1 \] \[ z = y - 2 \]";
    assert_ne!(last(two), Verdict::Proved);
}

#[test]
fn displays_of_an_example_a_case_or_a_proof_hold_to_its_end() {
    let all = |text: &str, markup: Markup| decisions(&Document::read(text, markup, &mut |_| Err(String::new())));
    let last = |text: &str, markup: Markup| all(text, markup).pop().unwrap();
    let claim = r"\[ 3 k = 6 m \]";
    for part in [
        r"\begin{example} Let \[ k = 2 m. \] \end{example}",
        r"\begin{proof} Suppose \[ k = 2 m. \] That is absurd. \end{proof}",
        r"\begin{Exercise}[Easy] Let \[ k = 2 m. \] \end{Exercise} \begin{Exercise}",
        r"\begin{itemize} \item Case 1: here \[ k = 2 m. \] \item Case 2:",
        r"\begin{enumerate} \item[(a)] If $m$ is small, \[ k = 2 m. \] \end{enumerate}",
        "\\subsection{Example: a spring} Let \\[ k = 2 m. \\]\n\n\\subsection{In general}\n",
        "Case 1. Let \\[ k = 2 m. \\]\n\nCase 2. Here\n",
    ] {
        let decision = last(&format!("{part} {claim}"), Markup::Tex);
        assert_ne!(decision.verdict, Verdict::Proved, "{part}: {}", decision.reason);
        assert_ne!(decision.verdict, Verdict::Unread, "{part}: {}", decision.reason);
        // within the part it holds
        let within = part.replacen(r"2 m. \]", &format!(r"2 m. \] so {claim} "), 1);
        let found = all(&within, Markup::Tex);
        let is_proved = found.iter().any(|row| row.verdict == Verdict::Proved);
        assert!(is_proved, "{within}: {found:#?}");
    }
    for part in [
        "## Example 1\n\n$$ k = 2 m $$\n\n## Example 2",
        ":::{exercise}\n$$ k = 2 m $$\n:::",
    ] {
        let decision = last(&format!("{part}\n\n$$ 3 k = 6 m $$\n"), Markup::Markdown);
        assert_ne!(decision.verdict, Verdict::Proved, "{part}: {}", decision.reason);
    }
    // what holds on
    for part in [
        r"\[ k = 2 m. \]",
        r"\begin{definition} Let \[ k = 2 m. \] \end{definition}",
        r"\begin{itemize} \item The stiffness is \[ k = 2 m. \] \item The mass is m. \end{itemize}",
        r"\section{The spring} Let \[ k = 2 m. \] \section{Results}",
    ] {
        let decision = last(&format!("{part} {claim}"), Markup::Tex);
        assert_eq!(decision.verdict, Verdict::Proved, "{part}: {}", decision.reason);
    }
}

#[test]
fn what_holds_by_more_than_is_read_is_not_suspect() {
    for text in [
        r"The projection $P$ satisfies $P^2 = P$, so \begin{align*} (1 - P)^2 &= 1 - 2 P + P^2 \\ &= 1 - P \end{align*}",
        r"\[ H^2 = H \] \begin{align*} H^3 &= H H^2 \\ &= H \end{align*}",
        r"Pauli: $\sigma^2 = 1$. \begin{align*} \sigma^3 &= \sigma^2 \sigma \\ &= \sigma \end{align*}",
    ] {
        let ran = audited(&format!("% a note\n{text}\n"));
        assert_eq!(ran.status, Some(0), "{text}: {}", ran.stdout);
    }
    // what is said of another letter too does not bind these
    let text = r"With $s = R \theta$ we have \begin{align*} W &= - g R \theta \cdot R \theta \\ &= - g R^2 \theta^3 \end{align*}";
    assert_eq!(audited(&format!("% a note\n{text}\n")).status, Some(1));
}

#[test]
fn a_slip_is_suspect_wherever_a_formula_is_claimed() {
    for text in [
        // a letter that cancels
        r"\[ a = q (1 - r) - q r = q \]",
        // no link of a chain
        r"It follows that \[ (1 + a^2) b + (1 + b^2) a - 4 a b = a (1 + b)^2 + b (1 - a)^2. \]",
        // letters of matrices, behind what says more of them
        r"Let $A$ and $B$ be matrices and \[ C = A + B. \] Then \begin{align*} V &= A (A + B) - B A \\ &= A A + A B + B A. \end{align*}",
        // beside a law about the same letters
        r"\[ q + r = 1 \] \begin{align*} V &= q^2 (q + r) \\ &= q^3 + q^3 r \end{align*}",
        // a term is missing that the sides beside have
        r"\begin{align*} V &= (a + b)^2 - a b \\ &= a^2 + a b \\ &= a (a + b) + b^2 \end{align*}",
        // letters are swapped between sides that agree
        r"\begin{align*} V &= m l^2 (1 + \dot{x}) + m l^2 \dot{x} \\ &= l m^2 (1 + 2 \dot{x}) \\ &= m l^2 + 2 m l^2 \dot{x} \end{align*}",
        // a letter too often, where all should cancel
        r"\begin{align*} V &= (a + b) c - c (b + a) \\ &= a c + b c - c b - c c \\ &= 0 \end{align*}",
        // a long sum that should be a number
        r"\[ (1-q)(1-r) + (1-q) r + q (1-q) + q r = 1 \]",
    ] {
        let ran = audited(&format!("% a note\n{text}\n"));
        assert_eq!(ran.status, Some(1), "{text}: {}", ran.stdout);
    }
    for text in [
        // what is neglected, rounded or a case in words
        r"For a few percent the cross term plays no role, and \[ (1+g)(1+n)-1 = g+n. \]",
        r"\begin{align*} A &= \pi\left(D s - s^2\right) \\ &= \pi D s \end{align*}",
        r"Rounded to the nearest hundred, \[ 47\cdot 23 = 1100. \]",
        r"Each $x_i\in\{0,1\}$, thus \begin{align*} (x_1+x_2)^2 &= x_1^2+2x_1x_2+x_2^2 \\ &= x_1+2x_1x_2+x_2 \end{align*}",
        // what is asked for
        r"We solve \[ (1 + a^2) b + (1 + b^2) a - 4 a b = a (1 + b)^2 + b (1 - a)^2. \]",
        r"If \[ a = q (1 - r) - q r = q \]",
        // a product of vectors is none of numbers
        r"\begin{align*} V &= \vec{a} \times \vec{b} + \vec{b} \times \vec{a} \\ &= 0 \end{align*}",
        // letters that are equal, by a formula of the text or by nothing that is read
        r"The lengths are equal, $l = m$. Thus \begin{align*} V &= \tfrac{1}{2} l^2 m + 3 l m \\ &= \tfrac{1}{2} l m^2 + 3 l m \end{align*}",
        r"The curves meet where \[ x^2 y = x y^2. \]",
        r"With equal masses, $m = M$, hence \begin{align*} V &= m v^2 + M v^2 \\ &= m v^2 + m v^2 \end{align*}",
        r"Let $P$ be a projector. \begin{align*} (1 - P)^2 &= 1 - 2 P + P^2 \\ &= 1 - P \end{align*}",
        r"It would be a mistake to write \[ (2 + 3)^2 = 2^2 + 3^2. \]",
        // a short one may be a condition
        r"\[ \frac{a b}{a c} = 1 \]",
        // where a premise may be missing
        r"Here $\rho$ is constant. \[ m = \rho_1 v_1 A_1 \] \[ Q = m/\rho = v_1 A_1 \]",
    ] {
        let ran = audited(&format!("% a note\n{text}\n"));
        assert_eq!(ran.status, Some(0), "{text}: {}", ran.stdout);
    }
}

#[test]
fn what_holds_by_itself_is_proved_whatever_stands_before_it() {
    for (text, wanted) in [
        // a second value of a letter
        (r"\[ r = 2 s \] \[ r = 3 t + s \] \[ 1 - r + r - q + q = 1 \]", "proved"),
        // a letter that stands on one side alone, and is no new one
        (
            r"\[ E = m v^2 \] \begin{align*} V &= 2 x (m v^2 + 1) - 2 x \\ &= 2 x m v^2 + m - m \end{align*}",
            "proved",
        ),
        // `mr` is a product, whatever stands in a term that is not read
        (
            r"\[ \unread{L} = mr^2 \unread{z} \] \begin{align*} V &= \frac{2 a}{mr} \\ &= \frac{2}{m} \frac{a}{r} \end{align*}",
            "proved",
        ),
        // an estimate that is divided by, and a power with a Greek exponent
        (
            r"\[ x = \frac{y}{\hat{a}} + \hat{b} \] \begin{align*} V &= \hat{a} c \hat{a} \\ &= c \hat{a}^2 \end{align*}",
            "proved",
        ),
        (
            r"Let $\mathbf{M} = \mathbf{K}_t$. \begin{align*} V &= K_t^\alpha N_t^{1 - \alpha} \\ &= N_t \left(\frac{K_t}{N_t}\right)^\alpha \end{align*}",
            "proved",
        ),
        // a power of a letter that elsewhere makes variations
        (
            r"\begin{align*} V &= \delta^t p (1 + q) \\ &= \delta^t p + \delta^t p q \end{align*}",
            "proved",
        ),
        (
            r"\begin{align*} V &= 2 \cos\phi \sqrt{x} \\ &= \sqrt{x} \cos\phi + \cos\phi \sqrt{x} \end{align*}",
            "proved",
        ),
    ] {
        let ran = audited(&format!("% a note\n{text}\n"));
        let last = ran.stdout.lines().last().unwrap_or_default();
        assert!(last.contains(&format!(",{wanted},")), "{text}: {}", ran.stdout);
    }
}

#[test]
fn a_slip_is_found_whatever_stands_before_it() {
    // of letters with marks, and with a second value
    let text = r"\[ P = Q^\top Q \] \[ P = a Q \] \begin{align*} V &= \frac{(m a)^2}{2 m} - P - \frac{1}{2} m a^2 \\ &= P \end{align*}";
    let ran = audited(&format!("% a note\n{text}\n"));
    assert!(ran.stdout.contains(",suspect,"), "{}", ran.stdout);
}

#[test]
fn the_imaginary_unit_is_what_words_and_use_say() {
    for (text, is_proved) in [
        (
            r"Here $i$ is the imaginary unit. \begin{align*} Z &= (1 + i w) (1 - i w) \\ &= 1 + w^2 \end{align*}",
            true,
        ),
        (
            r"\begin{align*} Z &= (1 + i w) (1 - i w) \\ &= 1 + w^2 \end{align*}",
            false,
        ),
        (
            r"\[ Y = j \omega C \] \begin{align*} Z &= (R + j \omega L) (R - j \omega L) \\ &= R^2 + \omega^2 L^2 \end{align*}",
            true,
        ),
        // a current
        (
            r"\[ Y = j \omega C i \] \begin{align*} Z &= (R + j \omega L) (R - j \omega L) \\ &= R^2 + \omega^2 L^2 \end{align*}",
            false,
        ),
        // an index
        (
            r"\[ Y_j = j \omega \] \begin{align*} Z &= (R + j \omega L) (R - j \omega L) \\ &= R^2 + \omega^2 L^2 \end{align*}",
            false,
        ),
    ] {
        let ran = audited(&format!("% a note\n{text}\n"));
        let last = ran.stdout.lines().last().unwrap_or_default();
        assert_eq!(last.contains(",proved,"), is_proved, "{text}: {}", ran.stdout);
    }
}

#[test]
fn a_partial_derivative_of_physics_is_one_symbol() {
    let text = r"\begin{align*} V &= \pdv{u}{x} + (a + b)^2 \\ &= \pdv{u}{x} + a^2 + 2 a b + b^2 \end{align*}";
    let ran = audited(&format!("% a note\n{text}\n"));
    assert!(ran.stdout.contains(",proved,"), "{}", ran.stdout);
}

/// The verdicts of a document without comments, in the order of its rows.
fn verdicts_of(text: &str) -> Vec<String> {
    let ran = audited(text);
    let rows = csv::Reader::from_reader(ran.stdout.as_bytes()).into_records();
    rows.map(|row| row.unwrap()[1].to_owned()).collect()
}

#[test]
fn letters_with_dots_are_functions_of_time_where_it_is_differentiated_by() {
    let law = r"\[ L = \frac12 m \dot{q}^2 - \frac12 k q^2 \] so that";
    for (text, wanted) in [
        (
            r"\[ \frac{d}{dt}\frac{\partial L}{\partial \dot q} = m \ddot q, \qquad \frac{\partial L}{\partial q} = - k q \]",
            &["given", "proved", "proved"][..],
        ),
        (
            r"\[ \frac{d}{dt}\frac{\partial L}{\partial \dot q} - \frac{\partial L}{\partial q} = m \ddot q + k q \]",
            &["given", "proved"],
        ),
        (
            r"\[ \frac{d}{dt}\frac{\partial L}{\partial \dot q} - \frac{\partial L}{\partial q} = m \ddot q - k q \]",
            &["given", "given"],
        ),
    ] {
        assert_eq!(verdicts_of(&format!("{law} {text}")), wanted, "{text}");
    }
    let beside = r"\[ \frac{d}{dt}\frac{\partial L}{\partial \dot x} = m \ddot x, \quad L = \frac12 m \dot x^2 \]";
    let mut verdicts = verdicts_of(beside);
    verdicts.sort_unstable();
    assert_eq!(verdicts, ["given", "proved"]);
}

#[test]
fn a_letter_of_which_nothing_says_that_it_varies_is_held_fixed_and_this_is_said() {
    let proved = r"\[ \int_0^1 a x^2 \, dx = \frac{a}{3} \]";
    let ran = audited(proved);
    assert!(
        ran.stdout.contains(",proved,") && ran.stdout.contains("`a` as `x` varies: constant"),
        "{}",
        ran.stdout
    );
    for varies in [
        r"\[ \frac{d a}{d x} = 1 \]",
        r"Here $a$ is a function of $x$.",
        r"\[ a' = a \]",
        r"\[ \Delta a = b \]",
        r"\[ a(x) = b - c + a(x) \]",
        r"The speed is $\frac{da}{dx}$.",
        r"Let $a(x)$ be the area.",
        r"The load is $a = b - c x$.",
        r"The area $a$ increases along the beam.",
    ] {
        let verdicts = verdicts_of(&format!("\\section{{Work}}\n{varies} {proved}"));
        assert!(
            verdicts.last().is_some_and(|last| last != "proved"),
            "{varies}: {verdicts:?}"
        );
    }
}

#[test]
fn equations_side_by_side_are_judged_one_by_one() {
    for (text, wanted) in [
        (
            r"\[ T = 2 \pi/\omega, \qquad \omega = k/m \] so \[ T = 2 \pi m/k \]",
            &["given", "given", "proved"][..],
        ),
        (
            r"\[ a = b^2 - c^2 \quad \text{and} \quad d = (b - c)(b + c) \] so \[ a = d \]",
            &["given", "given", "proved"],
        ),
        (
            r"\[ \frac1R = \frac1p + \frac1q, \quad \text{so that} \quad R = \frac{p q}{p + q} \]",
            &["given", "proved"],
        ),
        // a condition, and two values of one letter
        (
            r"\[ y = a x + b, \quad x = 1 \] so \[ y = a + b \]",
            &["undecided", "undecided"],
        ),
        (r"\[ x = a + b, \quad x = a - b \]", &["undecided"]),
    ] {
        assert_eq!(verdicts_of(text), wanted, "{text}");
    }
}

#[test]
fn what_stands_at_a_brace_or_above_a_sign_changes_nothing() {
    for text in [
        r"\begin{align*} s &= x + \underbrace{y - y}_{=0} + z \\ &= x + z \end{align*}",
        r"\begin{align*} s &= \overbrace{a + b}^{\text{gain}} - \underbrace{c}_{\text{loss}} + c \\ &= a + b \end{align*}",
        r"\begin{align*} s &= a + a \\ &\overset{(a)}{=} 2 a \end{align*}",
        r"\[ s = a + a \stackrel{(\mathrm{ii})}{=} 2 a \]",
        r"\begin{align*} s &= {\color{red} a + b} + c \\ &= c + b + a \end{align*}",
    ] {
        assert_eq!(verdicts_of(text), ["given", "proved"], "{text}");
    }
    // what a brace says holds in its own row
    let text = r"\begin{align} s &= x + \underbrace{q}_{=0} = x, \\ t &= x + q (x - l) = x. \end{align}";
    assert_eq!(verdicts_of(text), ["given", "proved", "given", "undecided"]);
}

#[test]
fn conditions_in_words_hold_of_the_displays_that_they_are_said_of() {
    let root = |letter: &str| format!(r"\[ \sqrt{{{letter}^2}} = {letter} \]");
    let (first, second) = (root("d"), r"\[ \sqrt{d^2} + 1 = d + 1 \]");
    let wanted = |text: &str, wanted: &[&str]| {
        assert_eq!(verdicts_of(&format!("\\section{{Work}}\n{text}")), wanted, "{text}");
    };
    wanted(
        r"For $\lambda>0$ we have \[\int_0^\infty\lambda e^{-\lambda x}\,dx=1.\]",
        &["proved"],
    );
    wanted(r"Let $a, b > 0$. Then \[ \sqrt{a^2 b} = a \sqrt b \]", &["proved"]);
    wanted(&format!("{first} where $d > 0$."), &["proved"]);
    wanted(
        &format!("If $d > 0$, then {first} and in general {second}"),
        &["proved", "undecided"],
    );
    wanted(&format!("{first} If $d > 0$, then {second}"), &["given", "proved"]);
    for text in [
        "Unless $d > 0$,",
        "We do not assume $d > 0$.",
        "Let $d > 0$ or $d < 0$.",
        r"Is $d > 0$?",
    ] {
        let verdicts = verdicts_of(&format!("\\section{{Work}}\n{text} {first}"));
        assert!(verdicts[0] != "proved", "{text}");
    }
}

#[test]
fn what_is_given_may_move_under_an_integral() {
    for text in [
        r"The current is $I = b e^{-t/\tau}$, so the charge is \[ \int_0^T t I \, dt = \frac{I T^2}{2}. \]",
        r"\[ p = \begin{cases} q, & x < a \\ 0, & x \geq a \end{cases} \] so \[ \int_0^L x p \, dx = \frac{p L^2}{2}. \]",
        // nobody calls a displacement constant
        r"\[ \int_0^L x u \, dx = \frac{u L^2}{2}. \]",
    ] {
        let verdicts = verdicts_of(&format!("\\section{{Work}}\n{text}"));
        assert!(
            verdicts.last().is_some_and(|last| last != "proved"),
            "{text}: {verdicts:?}"
        );
    }
}

#[test]
fn what_gives_a_function_is_not_proved_by_itself() {
    let text = r"\[ F(x) = P(X \leq x) \quad \forall x \in \mathbb{R} \] \[ F(x) = \sum_{x_i \leq x} p(x_i) \] so \[ F(x) = \begin{cases} 0 & x < 0 \\ 1 & x \geq 0 \end{cases} \]";
    let ran = audited(&format!("% a note\n{text}\n"));
    assert!(!ran.stdout.contains(",proved,"), "{}", ran.stdout);
}

#[test]
fn a_formula_within_the_text_is_put_into_the_next_display() {
    let display =
        |sides: &str| format!("\\begin{{align*}} E &= \\frac{{1}}{{2}} m v^2 \\\\ &= {sides} \\end{{align*}}");
    for said in [
        "With $v = g t$ we get",
        "Since $v = g t$, we get",
        "Substituting $v = g t$ into it,",
        "By $v = g t$, the energy is",
        "We have $v = g t$, so",
        "Let $m > 0$ and $v = g t$.",
        "Let $m$ be the mass and $v = g t$ the speed.",
        "Let $v = g t$ denote the speed.",
    ] {
        let right = audited(&format!("% a note\n{said}\n{}\n", display(r"\frac{1}{2} m g^2 t^2")));
        assert!(right.stdout.contains(",proved,"), "{said}: {}", right.stdout);
        let wrong = audited(&format!("% a note\n{said}\n{}\n", display(r"\frac{1}{2} m g^2 t")));
        assert!(wrong.stdout.contains(",suspect,"), "{said}: {}", wrong.stdout);
    }
    for said in [
        "If $v = g t$, then",
        "The speed is not given by $v = g t$, but",
        "Only when $v = g t$ do we get",
        "We want to show that with $v = g t$",
        "The claim is $v = g t$. Then",
    ] {
        let ran = audited(&format!("% a note\n{said}\n{}\n", display(r"\frac{1}{2} m g^2 t^2")));
        assert!(!ran.stdout.contains(",proved,"), "{said}: {}", ran.stdout);
    }
    // it is said of that display alone
    let text = format!(
        "% a note\nWith $v = g t$ we get\n{}\nIn general\n{}\n",
        display(r"\frac{1}{2} m g^2 t^2"),
        r"\begin{align*} Q &= v^3 \\ &= g^3 t^3 \end{align*}",
    );
    assert_eq!(audited(&text).stdout.matches(",proved,").count(), 1);
}

#[test]
fn sums_and_means_are_linear() {
    for (text, is_proved) in [
        (r"\sum_i (a_i + c b_i) = \sum_i a_i + c \sum_i b_i", true),
        (r"\sum_{k \in K} c a_k = c \sum_{k \in K} a_k", true),
        (
            r"\sum_{j=1}^n \sum_{i=1}^m x_{ij} = \sum_{i=1}^m \sum_{j=1}^n x_{ij}",
            true,
        ),
        (
            r"\sum_{i=1}^n q_i \sum_{j=1}^m d_{ij} p_j = \sum_{j=1}^m \left(\sum_{i=1}^n d_{ij} q_i\right) p_j",
            true,
        ),
        (r"\mathbb{E}[Y + \sigma Z] = \mathbb{E}[Y] + \sigma \mathbb{E}[Z]", true),
        (
            r"\mathbb{E}(X^2) - 2 \mathbb{E}(X \mathbb{E}X) + (\mathbb{E}X)^2 = \mathbb{E}X^2 - (\mathbb{E}X)^2",
            true,
        ),
        (r"\mathbb{E}[X + Z | Y] = \mathbb{E}[X | Y] + \mathbb{E}[Z | Y]", true),
        (r"\sum_i a_i b_i = b_i \sum_i a_i", false),
        (
            r"\sum_i a_i b_i = \left(\sum_i a_i\right) \left(\sum_i b_i\right)",
            false,
        ),
        (r"\sum_i (a_i + c) = \sum_i a_i + c", false),
        (r"\sum_i a_i = \sum_j a_j", false),
        (
            r"\sum_{i=1}^n \sum_{j=1}^i x_{ij} = \sum_{j=1}^i \sum_{i=1}^n x_{ij}",
            false,
        ),
        (
            r"\sum_{i=1}^\infty \sum_{j=1}^\infty x_{ij} = \sum_{j=1}^\infty \sum_{i=1}^\infty x_{ij}",
            false,
        ),
        (r"\mathbb{E}[X Y] = \mathbb{E}[X] \mathbb{E}[Y]", false),
        (r"\mathbb{E}[X Y] = X \mathbb{E}[Y]", false),
        (r"\mathbb{E}[x Y | z] = x \mathbb{E}[Y | z]", false),
        (r"\mathbb{E}[X^2] = \mathbb{E}[X]^2", false),
        (r"\mathbb{E}[a x + b] = a x + b", false),
        (r"\mathbb{E}[X \mathbb{E}[Y]] = \mathbb{E}[Y] \mathbb{E}[X]", true),
        (
            r"\mathbb{E}[X \mathbb{E}[Y | Z]] = \mathbb{E}[Y | Z] \mathbb{E}[X]",
            false,
        ),
        (r"\mathbb{E}[X \mathbb{E}_t[Y]] = \mathbb{E}_t[Y] \mathbb{E}[X]", false),
        (r"\mathbb{E}[x y] = x \mathbb{E}[y]", false),
        (r"\mathbb{E}[a_I X_I] = a_I \mathbb{E}[X_I]", false),
        (
            r"\sum_i \mathbf{x}_i \mathbf{y}_i = \sum_i \mathbf{y}_i \mathbf{x}_i",
            false,
        ),
    ] {
        let ran = audited(&format!(
            "% a note\n\\begin{{align*}} V &= {} \\end{{align*}}\n",
            text.replacen(" = ", r" \\ &= ", 1)
        ));
        let last = ran.stdout.lines().last().unwrap_or_default();
        assert_eq!(last.contains(",proved,"), is_proved, "{text}: {}", ran.stdout);
    }
    // thousands of sums within each other are one symbol
    let sums = |of: &str| format!("{}{of}", r"\sum_i ".repeat(3_000));
    let text = format!(
        "\\begin{{align*}} V &= {} \\\\ &= {} \\end{{align*}}",
        sums("a_i"),
        sums("b_i")
    );
    let ran = audited(&format!("% a note\n{text}\n"));
    assert!(ran.stdout.contains(",undecided,"), "{}", ran.stderr);
    // letters of matrices do not change places within a sum
    let text = r"Let $A$ and $B$ be matrices. \begin{align*} V &= \sum_i a_i A B \\ &= \sum_i a_i B A \end{align*}";
    let ran = audited(&format!("% a note\n{text}\n"));
    assert!(!ran.stdout.contains(",proved,"), "{}", ran.stdout);
}

#[test]
fn what_words_say_of_letters_and_logarithms_is_not_proved_of_real_numbers() {
    for said in [
        r"Lower-case letters denote matrices throughout.",
        r"The Jacobian $u$ and the Hessian $v$ enter as",
        r"Rotations $u$ and $v$ of space are composed as",
        r"Let $u, v$ be reflections in the plane and",
        r"Bosonic ladder operators are written $u$ and $v$.",
        r"Anticommuting (Grassmann) variables $u$ and $v$ obey",
        r"Let $u$, $v$ be formal symbols that do not commute, and",
        r"In what follows $u$ and $v$ stand for endomorphisms.",
        r"Let $u, v \in \mathbb{H}$ with",
    ] {
        let ran = audited(&format!("% a note\n{said} \\[ z = u v. \\] Then \\[ z = v u. \\]\n"));
        assert!(!ran.stdout.contains(",proved,"), "{said}: {}", ran.stdout);
    }
    for (text, is_proved) in [
        (
            r"The complex amplitude $a$ fulfils \[ a^4 = 1. \] Then \[ a^2 = 1. \]",
            false,
        ),
        (r"A length fulfils \[ a^4 = 1. \] Then \[ a^2 = 1. \]", true),
        (
            r"The impedance $Z$ has modulus \[ M = |Z|. \] Then \[ M^2 = Z^2. \]",
            false,
        ),
        (
            r"Here $\log$ denotes the logarithm to base $10$. \[ y = \log x \] Then \[ x = e^y. \]",
            false,
        ),
        (r"Taking logarithms, \[ y = \log x \] Then \[ x = e^y. \]", true),
        (
            r"The matrix of the weights $\beta$ and $x$ has \[ z = \beta x \] Then \[ z = x \beta. \]",
            true,
        ),
    ] {
        let ran = audited(&format!("% a note\n{text}\n"));
        assert_eq!(ran.stdout.contains(",proved,"), is_proved, "{text}: {}", ran.stdout);
    }
}

#[test]
fn a_marked_link_that_rests_on_what_is_not_read_stops_no_document() {
    // Y^* marks letters of the second link, which follows from a formula that prints its conditions
    let text = r"# Solution:

$$g(s) = \frac{1}{\sqrt{2\pi}} e^{-s^2/2}$$

# Curves

$$g(s) = \frac{1}{r\sqrt{2\pi}} e^{-(s - m)^2/(2 r^2)}, \quad -\infty < s < \infty.$$

$$V(Y) = Q[(Y - m)^2] = \int_{-\infty}^{\infty} (s - m)^2 g(s) ds$$

$$r_{aY+b} = |a| r_Y$$

$$Y^* = \frac{(Y - m)}{r}$$
";
    let ran = program(["audit", "-", "--stdin-name", "curves.md", "--format", "csv"])
        .input(text)
        .run();
    assert_eq!(ran.status, Some(0), "{} {}", ran.stdout, ran.stderr);
}

#[test]
fn the_first_repair_is_one_with_which_the_links_beside_it_hold() {
    let text = r"\begin{align*} S &= (a-b)^2 + (b-c)^2 + (c-a)^2 \\ &= (a^2-2ab+b^2) + (b^2-2bc+c^2) + (c-a)^2 \\ &= (a-b)^2 + (b-c)^2 + (c+a)^2 \end{align*}";
    let ran = audited(&format!("% a note\n{text}\n"));
    let first = ran.stdout.split(" ;; ").next().unwrap_or_default();
    assert!(
        first.contains(",suspect,") && first.contains("(c - a)^2$"),
        "{}",
        ran.stdout
    );
}

#[test]
fn units_are_converted() {
    for text in [
        r"\[ v = \SI{36}{\kilo\meter\per\hour} = \SI{10}{\meter\per\second} \]",
        r"\[ p = \frac{\SI{20}{\newton}}{\SI{4}{\meter\squared}} = \SI{5}{\pascal} \]",
        r"\[ 2 \sin\ang{30} = 1 \]",
        r"\[ 3 \si{\watt\second} = \num{3e3} \unit{\milli\joule} \]",
    ] {
        let ran = audited(text);
        let last = ran.stdout.lines().last().unwrap_or_default();
        assert!(last.contains(",proved,"), "{text}: {}", ran.stdout);
    }
    let ran = audited(r"\[ x = \SI{3}{\meter} + \SI{2}{\meter} = \SI{6}{\meter} \]");
    assert!(ran.stdout.contains(",suspect,"), "{}", ran.stdout);
}

#[test]
fn what_may_be_a_number_or_another_letter_is_no_sign_of_matrices() {
    for text in [
        r"\[ x_T = A^T x_0 \] \[ x_T^T = x_0^T A \]",
        r"Let $0 \le t \le T$. \[ q = u^T v \] \[ q = v^T u \]",
        r"\[ D = (1 + r)^T \] \[ K = D^T \] \[ K = 1 + r \]",
        r"Let $A$ be a matrix. \[ A = S + I \] \[ A S = S^2 + S \]",
        r"\[ V = I R \] \[ K = A^\top A + I \] \[ K A^\top = A^\top A A^\top + A^\top \]",
        r"Let $a, b \in \mathbb{R}^{n \times n}$. \[ c = a^\top b \] \[ c = b^\top a \]",
        r"\[ q q^\top = I \] \[ K = k^\top Q q \] \[ K = q^\top Q^\top k \]",
        r"Let $A_i \in \mathbb{R}^{n \times n}$. \[ S = \sum_{i=1}^n A_i B \] \[ S = B \sum_{i=1}^n A_i \]",
        r"\[ S = \sum_i \mathbf{x}_i \mathbf{y}_i^\top \] \[ S^\top = S \]",
        r"Let $X \in \mathbb{R}^{n \times p}$. \[ b = (X^\top X)^{-1} X^\top y \] \[ b = X^{-1} y \]",
        r"\[ S = (I + G K)^{-1} \] \[ T = G K S \] \[ T = K S G \]",
        r"\[ q = c k \] \[ S = \sum_{k=1}^n q k \] \[ S = c \sum_{k=1}^n k^2 \]",
        r"\[ A = \sum_{i=1}^2 \sum_{j=1}^3 a_{ij} \] \[ A = 6 a_{ij} \]",
        r"\[ m_n = \frac13 \sum_{k=0}^2 x_{n-k} \] \[ m_n = x_{n-k} \]",
        r"Let $q = c_i v$. \[ Q = \sum_{i=1}^2 q \] \[ Q = 2 q \]",
        r"Let $X$ be an $n \times p$ matrix. \[ b = (X^T X)^{-1} X^T y \] \[ b = X^{-1} y \]",
        r"\[ b = (X^\top X)^{-1} X^\top y \] \[ b = X^{-1} y \]",
        r"\[ C = X' X \] \[ C = X X' \]",
        r"\[ b = (X^t X)^{-1} X^t y \] \[ b = y X^{-1} \]",
        r"The data matrix is transposed in \[ C = X^t Y \] \[ C = Y X^t \]",
        r"The least squares solution for the data $X$, $y$ is \[ b = (X^\top X)^{-1} X^\top y \] \[ b = X^{-1} y \]",
        r"Here $X$ is the data and $X^\top X$ is invertible. \[ b = (X^\top X)^{-1} X^\top y \] \[ b = X^{-1} y \]",
    ] {
        let last = decisions(&document(text, &[])).pop().unwrap();
        assert_ne!(last.verdict, Verdict::Proved, "{text}");
    }
}

#[test]
fn sums_of_unknown_length_are_linear() {
    let text = r"\begin{equation} \bar x = \frac1n \sum_{i=1}^n x_i \end{equation}
\begin{equation} \sum_{i=1}^n (x_i - \bar x)^2 = \sum_{j=1}^n x_j^2 - n \bar x^2 \end{equation}
\begin{equation} \sum_{i=1}^n \sum_{j=1}^n x_i y_j = \left( \sum_{i=1}^n x_i \right) \sum_{j=1}^n y_j \end{equation}
\begin{equation} \sum_{i=1}^n \frac{1}{i (i+1)} = \frac{n}{n+1} \end{equation}
\begin{equation} \sum_{i=1}^n x_i y_i = \sum_{i=1}^n x_i \sum_{i=1}^n y_i \end{equation}
\begin{equation} \sum_{i=1}^n x_i^2 = \left( \sum_{i=1}^n x_i \right)^2 \end{equation}
\begin{equation} \sum_{i=1}^n x_i = n x_i \end{equation}
\begin{equation} w = \frac{1}{v_i} \end{equation}
\begin{equation} \sum_{i=1}^n w x_i = w \sum_{i=1}^n x_i \end{equation}
\begin{equation} y_k = c \end{equation}
\begin{equation} \sum_{k=1}^n y_k = n c \end{equation}
\begin{equation} \sum_{i=1}^n \sum_{j=1}^n z_i z_j = \left( \sum_{i=1}^n z_i \right)^2 \end{equation}
";
    let found = decisions(&document(text, &[]));
    let is_proved: Vec<bool> = found.iter().map(|row| row.verdict == Verdict::Proved).collect();
    let reasons: Vec<&str> = found.iter().map(|row| row.reason.as_str()).collect();
    let first = [false, true, true, true, false, false, false];
    // a letter that the index gives, and what is said of one member
    let further = [false, false, false, false, true];
    assert_eq!(is_proved, [first.as_slice(), &further].concat(), "{reasons:?}");
    // of members of a family it is seen that they have the index
    for text in [
        r"\[ y_i = a x_i + b \] \[ \sum_{i=1}^n y_i = a \sum_{i=1}^n x_i + n b \]",
        r"\[ p_i = \frac{w_i}{\sum_{j=1}^n w_j} \] \[ \sum_{i=1}^n p_i = 1 \]",
    ] {
        let last = decisions(&document(text, &[])).pop().unwrap();
        assert_eq!(last.verdict, Verdict::Proved, "{text}: {}", last.reason);
    }
}

#[test]
fn least_squares_and_a_filter_are_proved_row_by_row() {
    let found = document(include_str!("../papers/matrices.tex"), &[]);
    let sheet = found.sheet(&vocabulary()).unwrap();
    let decided = prove::audit(&sheet, &Options::default());
    let of = |verdict: Verdict| -> Vec<&str> {
        let rows = decided.iter().filter(|row| row.verdict == verdict);
        rows.map(|row| row.label.as_str()).collect()
    };
    assert_eq!(of(Verdict::Given), ["1", "2", "4", "9", "10"]);
    assert_eq!(of(Verdict::Proved), ["3", "5", "6", "7.1", "7.2", "8", "11", "12"]);
    assert_eq!(of(Verdict::Undecided), ["13", "14"]);
    // each has proof data, which .ci/proofs checks
    for label in of(Verdict::Proved) {
        let position = sheet.find(label).unwrap();
        let data = prove::proof_data(&sheet, position, &Options::default());
        assert_eq!(data.len(), 1, "{label}");
        assert!(data[0].contains("\"words\": {"), "{label}");
    }
}

#[test]
fn what_holds_of_numbers_alone_is_not_proved_of_matrices() {
    for (before, claim) in [
        ("Let $A$ and $B$ be matrices.", r"(A + B)^2 = A^2 + 2 A B + B^2"),
        ("Let $A$ and $B$ be matrices.", r"(A B)^\top = A^\top B^\top"),
        ("Let $A$ and $B$ be matrices.", r"(A B)^{-1} = A^{-1} B^{-1}"),
        (r"\[ A = P D P^{-1} \]", "A = D"),
        (r"\[ A B = I \] \[ C C^{-1} = I \]", "B A = I"),
        (r"\[ H = X (X^\top X)^{-1} X^\top \]", "H = I"),
        (
            r"\[ K \mathbf{c} + P \mathbf{d} = \mathbf{f} \]",
            r"\mathbf{c} = (\mathbf{f} - P \mathbf{d}) K^{-1}",
        ),
        (
            r"\[ \vec{u} = \vec{a} + \vec{b} \]",
            r"\vec{u} \times \vec{b} = \vec{b} \times \vec{a}",
        ),
        (
            r"\[ \vec{u} = \vec{a} + \vec{b} \]",
            r"(\vec{u} \cdot \vec{a}) \vec{b} = \vec{u} (\vec{a} \cdot \vec{b})",
        ),
        (r"\[ \vec{a} \cdot \vec{b} = k \]", r"\vec{a} = \frac{k}{\vec{b}}"),
        (r"\[ x^\top A x = 1 \]", r"A x x^\top = 1"),
        // functions of time
        (
            r"\[ \mathbf{C}(t) = \mathbf{A}(t) \mathbf{B}(t) \]",
            r"\mathbf{C}(t) = \mathbf{B}(t) \mathbf{A}(t)",
        ),
        (
            r"\[ \vec{L}(t) = \vec{r}(t) \times \vec{p}(t) \]",
            r"\vec{L}(t) = \vec{p}(t) \times \vec{r}(t)",
        ),
        (r"\[ V(t) = x(t)^\top P x(t) \]", r"V(t) = P x(t)^\top x(t)"),
        // who divides by one of that name elsewhere
        (
            r"Let $A$ and $B$ be matrices. \[ C = A B \] \[ z = \frac{q}{A} \]",
            "C = B A",
        ),
        (r"\[ A^\top P + P A = -Q \] \[ z = \frac{q}{2 A} \]", "2 A P = -Q"),
        // zero divisors and roots of one matrix
        (r"\[ \mathbf{N}^2 = 0 \]", r"\mathbf{N} = 0"),
        (r"\[ \mathbf{R}^3 = 1 \]", r"\mathbf{R} = 1"),
        // nothing is divided by a vector
        (
            r"\[ \mathbf{F} = k \mathbf{x} \]",
            r"\frac{1}{k} = \frac{\mathbf{x}}{\mathbf{F}}",
        ),
        (r"\[ \mathbf{a} = s \mathbf{b} \]", r"s = \mathbf{a} \mathbf{b}^{-1}"),
        (
            r"\[ A = \begin{pmatrix} a & b \\ c & d \end{pmatrix} \] \[ \mathbf{y} = A \mathbf{x} \]",
            r"\mathbf{y} = \mathbf{x} A",
        ),
        (
            r"\[ \mathbf{C} = \mathbf{A} (\mathbf{B} \mathbf{D})^{-1} \]",
            r"\mathbf{C}^{-1} = \mathbf{A} (\mathbf{B} \mathbf{D})",
        ),
        (
            r"\[ \mathbf{C}_{k+1} = \mathbf{A}_{k+1} \mathbf{B}_{k+1}^2 \]",
            r"\mathbf{C}_{k+1} = \mathbf{B}_{k+1}^2 \mathbf{A}_{k+1}",
        ),
        // an upper index, unit vectors, a vector of currents
        (
            r"\[ \mathbf{v}^1 = \mathbf{R}^1_0 \mathbf{v}^0 \]",
            r"\mathbf{v}^1 = \mathbf{R}^1_0",
        ),
        (
            r"\[ \hat n_1 = \hat e_1 \times \hat e_2 \]",
            r"\hat n_1 = \hat e_1 \cdot \hat e_2",
        ),
        (
            r"\[ \mathbf{I} = \mathbf{Y} \mathbf{V} \]",
            r"\mathbf{I} \mathbf{A} = \mathbf{A}",
        ),
        // letters beside what is marked
        ("Let $A$ be a matrix. \\[ C = A B \\]", "C = B A"),
        ("Let $A$ be a matrix. \\[ y = A x \\]", "y = x A"),
        (
            r"Let $A$ be the system matrix. \[ \dot{x} = A x + B u \] \[ u = -K x \]",
            r"\dot{x} = (A - K B) x",
        ),
        (r"\[ A(t) = U^\dagger A U \]", "A(t) = A"),
        // members of a family keep their places in sums
        (r"\[ S = \sum_{i=1}^n x_i y_i^\top \]", r"S^\top = S"),
        (
            r"\[ \vec L = \sum_{i=1}^n \vec r_i \times \vec p_i \]",
            r"\vec L = \sum_{i=1}^n \vec p_i \times \vec r_i",
        ),
        // I and T that are something else, small letters that are matrices
        (
            r"Let $A$ be a matrix and $I$ the current. \[ P = A - I \]",
            "P A = A^2 - A",
        ),
        (r"\[ I = X^\top X \] \[ V = I^{-1} \]", "V X = X"),
        (r"\[ \tau = \frac{T}{2} \] \[ y = a^T b \]", "y = b^T a"),
        (r"Let $a$, $b$ be matrices. \[ c = a^\top b \]", r"c = b^\top a"),
        (
            r"Let $\mathbf{a}$, $\mathbf{b}$ be matrices. \[ \mathbf{c} = \mathbf{a} \mathbf{b}^2 \]",
            r"\mathbf{c} = \mathbf{b}^2 \mathbf{a}",
        ),
    ] {
        let text = format!("{before}\n\\[ {claim} \\]\n");
        let found = decisions(&document(&text, &[]));
        let last = found.last().unwrap();
        assert_ne!(last.verdict, Verdict::Proved, "{text}: {}", last.reason);
    }
}

#[test]
fn what_is_a_matter_of_print_is_read_as_it_is_meant() {
    let last = |text: &str| {
        let tex = document(
            &format!("\\documentclass{{article}}\n\\begin{{document}}\n{text}\n\\end{{document}}\n"),
            &[],
        );
        decisions(&tex).pop().unwrap()
    };
    let unit = r"\newcommand{\iu}{\mathbf{i}\mkern1mu} Let $\iu = \sqrt{-1}$.";
    for (context, formula) in [
        (unit, r"\[ \iu^3 = -\iu \]"),
        (unit, r"\[ \mathbf{e}^{\iu \pi} = -1 \]"),
        (
            unit,
            r"\[ \begin{aligned} z &= a d\iu + b\iu c \\ &= (a d + b c) \iu \end{aligned} \]",
        ),
        ("", r"\[ (a + c\sqrt{-5})^2 = a^2 + 2\sqrt{-5} a c - 5 c^2 \]"),
        (
            "",
            r"\[ \mathrm{d}s = \frac{\mathrm{d}u + p\,\mathrm{d}v}{T} = \frac{\mathrm{d}u}{T} + \frac{p\,\mathrm{d}v}{T} \]",
        ),
        ("", r"\[ y = \frac{\partial x}{\partial x} + x = 1 + x \]"),
        (
            "",
            r"\[ q = p + \frac{c^2}{2} - \underbrace{c\,u}_{c_u u} = \frac{2 p + c^2 - 2 c u}{2} \]",
        ),
        (
            "",
            "\\begin{eqnarray} y &=& (a + b)^2 = \\nonumber \\\\ &=& a^2 + 2 a b + b^2 \\end{eqnarray}",
        ),
        (
            "",
            r"\[ \boxed{\begin{gathered} y = 2 x, \\ 2 y = 4 x \end{gathered}} \]",
        ),
        (
            "",
            r"\[ Y = \bar A \left(\frac{\bar K}{\bar L}\right)^2 = \frac{\bar A \bar K^2}{\bar L^2} \]",
        ),
        (
            "",
            r"\[ |\psi\rangle = a |0\rangle + b |1\rangle + a |0\rangle = 2 a |0\rangle + b |1\rangle \]",
        ),
        (
            r"\[ x^{\mathrm{ref}} = a \]",
            r"\[ y = 2 x^{\mathrm{ref}} + \mathrm{Nu} = 2 a + \mathrm{Nu} \]",
        ),
        ("", r"\[ {\rm Nu} = h L \] \[ y = 2 {\rm Nu} = 2 h L \]"),
        (
            r"\[ \mathbf{F} = m \mathbf{a} \]",
            r"\[ E = \frac{m v^2}{2} + m g h = m \left(\frac{v^2}{2} + g h\right) \]",
        ),
        (
            r"\[ \begin{pmatrix} 1 & 2 \\ 0 & 1 \end{pmatrix} \begin{pmatrix} a \\ b \end{pmatrix} = \begin{pmatrix} a + 2 b \\ b \end{pmatrix} \]",
            r"\[ A = 2 a \] \[ B = 2 b \] \[ (A + B)(A - B) = A^2 - B^2 \]",
        ),
    ] {
        let decision = last(&format!("{context}\n{formula}"));
        assert_eq!(
            decision.verdict,
            Verdict::Proved,
            "{context} {formula}: {}",
            decision.reason
        );
    }
    for (context, formula) in [
        (unit, r"\[ \iu^3 = \iu \]"),
        (
            r"Let $\mathbf{i}^2 = -1$ and $\mathbf{j}^2 = -1$.",
            r"\[ \mathbf{i}\mathbf{j} = \mathbf{j}\mathbf{i} \]",
        ),
        ("", r"\[ \sqrt{-4}\sqrt{-9} = 6 \]"),
        (
            "",
            r"\[ P = |0\rangle\langle 0| + |1\rangle\langle 1| = \langle 0| |0\rangle + \langle 1| |1\rangle \]",
        ),
        ("", r"\[ S = 1 + 2 + \cdots + n = n + \cdots + 2 + 1 \]"),
        (
            "",
            r"\[ e^x = 1 + x + \cdots \] \[ \frac{1}{1 - x} = 1 + x + \cdots \] \[ e^x = \frac{1}{1 - x} \]",
        ),
        ("", r"\[ (a + c\sqrt{-5})^2 = a^2 + 2\sqrt{-5} a c + 5 c^2 \]"),
        ("", r"\[ \frac{\partial^2 x}{\partial x^2} = 1 \]"),
        ("", r"\[ x \underbrace{a + b}_{c d} = x a + b \]"),
        ("", r"\[ a + \underbrace{b c}_{= 0} = a \]"),
        (
            r"\[ M = \begin{pmatrix} a & b \\ b & a \end{pmatrix} \] \[ a b - b a = c \]",
            r"\[ (a + b)(a - b) = a^2 - b^2 \]",
        ),
        (
            r"\[ z = \begin{pmatrix} x \\ y \end{pmatrix} \] \[ A = x y^\top \]",
            r"\[ x y^\top x y^\top = x^2 (y^\top)^2 \]",
        ),
        (
            r"Let $\bar z$ be the complex conjugate of $z$.",
            r"\[ \bar z + z = 1 \] \[ z^2 \geq 0 \]",
        ),
    ] {
        let decision = last(&format!("{context}\n{formula}"));
        assert_ne!(
            decision.verdict,
            Verdict::Proved,
            "{context} {formula}: {}",
            decision.reason
        );
    }
}

#[test]
fn words_between_rows_part_them() {
    let text = r"
\begin{align}
  V &= I R \\
  V &= 2 I R - I R
  \intertext{Twice that is}
  2 V &= 2 I R
\end{align}";
    assert_eq!(verdicts(&document(text, &[])), ["1 given", "2 proved", "3 proved"]);
}

#[test]
fn equations_of_one_display_hold_together_and_others_may_give_a_letter_a_new_meaning() {
    let system = r"
\begin{align}
  \tau &= K I \\
  \tau &= J \alpha \\
  V &= R I
\end{align}
Then
\[ V = \frac{R \tau}{K} \]
\[ V = \frac{R J \alpha}{K} \]
\[ J \alpha = \frac{K V}{R} \]
";
    let found = verdicts(&document(system, &[]));
    let proved = ["line 8 proved", "line 9 proved", "line 10 proved"];
    assert_eq!(found[3..], proved, "the second value of V is proved to be the first");
    let roots = "The roots are\n\\begin{align} x &= a \\\\ x &= b \\end{align}\n\\[ a = b \\]\n";
    assert_ne!(verdicts(&document(roots, &[])).last().unwrap(), "line 3 proved");
    let step = "\\[ x = x_0 + g \\]\n\\[ x = x + h \\]\n\\[ x + 2 h = x_0 + g \\]\n";
    assert_ne!(verdicts(&document(step, &[])).last().unwrap(), "line 3 proved");
    let parted = r"
\[ \tau = K I \]
Now something else.
\[ \tau = J \alpha \]
\[ K I = J \alpha \]
";
    assert_ne!(verdicts(&document(parted, &[])).last().unwrap(), "line 5 proved");
}

#[test]
fn a_claim_may_follow_from_what_the_text_in_front_of_it_names() {
    let text = |words: &str| {
        format!(
            r"
\begin{{equation}}\label{{force}} F = \rho v_1^2 A_1 - \rho v_3^2 A_3 \end{{equation}}
\begin{{equation}}\label{{mass}} \rho v_1 A_1 = \rho v_3 A_3 \end{{equation}}
{words}
\begin{{equation}} F = \rho v_1 A_1 (v_1 - v_3) \end{{equation}}
"
        )
    };
    let last = |words: &str| verdicts(&document(&text(words), &[])).pop().unwrap();
    assert_eq!(last(r"By \eqref{mass} this is"), "3 proved");
    assert_eq!(last("it follows that"), "3 proved");
    assert_ne!(last("This is"), "3 proved");
    assert_ne!(last(r"In contrast to \eqref{mass}, some print"), "3 proved");
    assert_ne!(last(r"By \eqref{force} this is"), "3 proved");
    // nothing follows from itself
    let text = r"\[ a = b + c \] By \eqref{y} \begin{align} a &= b d \label{x} \\ a &= b d^2 \label{y} \end{align}";
    assert_eq!(verdicts(&document(text, &[]))[1..], ["1 given", "2 undecided"]);
}
