//! Inputs that nobody wrote: what each parser and each command makes of files with random changes.

use crate::common::attacks;
use crate::common::program::{program, scratch};
use std::panic::catch_unwind;
use std::path::Path;
use std::time::{Duration, Instant};
use vibro_audit::accuracy::problems::{Certified as Problem, all};
use vibro_audit::accuracy::score::Answers;
use vibro_audit::claim::{EQUATIONS, SYMBOLS, Sheet, read_symbols};
use vibro_audit::reference::{Certified, Printed};
use vibro_audit::scene::Scene;
use vibro_audit::tex::{Names, Symbols, read, read_conditions};

/// What is put in: what parsers look at, and what they do not expect.
const PIECES: [&str; 60] = [
    "{",
    "}",
    "[",
    "]",
    "(",
    ")",
    "^",
    "_",
    "&",
    "\\\\",
    "$",
    "$$",
    "\\frac",
    "\\sqrt",
    "\\left(",
    "\\right]",
    "\\pm",
    "\\mp",
    "\\partial",
    "\\dot",
    "\\ddot{Z}",
    "\\tag{1}",
    "\\text{",
    "\\cdot",
    "\\ln",
    "\\sin",
    "^{-1}",
    "_{k+1}",
    "_{1,2}",
    "'",
    "=",
    "\\neq",
    "<",
    "\\le",
    "1e308",
    "1e-400",
    "-",
    "+",
    "0",
    "0.1",
    "99999999999999999999",
    "9^9^9",
    "NaN",
    "inf",
    "\0",
    "\u{1b}[31m",
    "é",
    "\u{202e}",
    "＝",
    "\r\n",
    "\n",
    "\t",
    ",",
    ";",
    "\"",
    "'''",
    "#",
    "%",
    "[[equation]]",
    "near ",
];

/// A course of random numbers (G. Steele, D. Lea and C. Flood, 2014, "Fast splittable pseudorandom number generators").
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % end.max(1) as u64) as usize
    }

    /// A place between two characters.
    fn place(&mut self, text: &str) -> usize {
        let mut at = self.below(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    fn range(&mut self, text: &str) -> std::ops::Range<usize> {
        let start = self.place(text);
        let mut end = (start + 1 + self.below(12)).min(text.len());
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        start..end.max(start)
    }

    /// One of the texts with some changes.
    fn changed(&mut self, texts: &[String]) -> String {
        let mut text = texts[self.below(texts.len())].clone();
        for _ in 0..=self.below(5) {
            let range = self.range(&text);
            let piece = match self.below(4) {
                0 => String::new(),
                1 => PIECES[self.below(PIECES.len())].to_owned(),
                2 => text[range.clone()].repeat(2),
                _ => {
                    let other = &texts[self.below(texts.len())];
                    other[self.range(other)].to_owned()
                }
            };
            text.replace_range(range, &piece);
        }
        text
    }
}

/// Texts that are read, by what reads them.
struct Texts {
    formulas: Vec<String>,
    sheets: Vec<String>,
    scenes: Vec<String>,
    printed: Vec<String>,
    certified: Vec<String>,
    answers: Vec<String>,
}

fn file(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The header of a table with each of its first rows.
fn short(table: &str) -> Vec<String> {
    let (header, rows) = table.split_once('\n').unwrap();
    rows.lines().take(40).map(|row| format!("{header}\n{row}\n")).collect()
}

impl Texts {
    fn new() -> Self {
        let small = attacks::all().into_iter().map(|attack| attack.text);
        let sheets: Vec<String> = small.filter(|text| text.len() < 1500).collect();
        let formulas = EQUATIONS.lines().chain(sheets.iter().flat_map(|sheet| sheet.lines()));
        let formulas = formulas.filter_map(|line| line.strip_prefix("tex = '''")?.strip_suffix("'''"));
        let scenes = vibro_audit::scene::BUILT_IN.iter().map(|(_, text)| *text);
        Self {
            formulas: formulas.map(str::to_owned).collect(),
            scenes: scenes.map(str::to_owned).collect(),
            printed: short(&file("golden/paper/printed.csv")),
            certified: short(&file("golden/paper/reference/orbits.csv")),
            answers: vec![
                "problem,quantity,answer\norbit-focus,phase_1,0.489395114654519\norbit-focus,velocity_1,1\n".into(),
            ],
            sheets,
        }
    }

    /// Reads one of them, changed; what comes out is of no account.
    fn read(&self, random: &mut Random, known: &Known) {
        match random.below(20) {
            0 => drop(Sheet::read(&random.changed(&self.sheets), &known.symbols)),
            1 => drop(read_symbols(&random.changed(&self.sheets))),
            2 => drop(Scene::read(&random.changed(&self.scenes), "x")),
            3 => drop(Printed::read("x", &random.changed(&self.printed))),
            4 => drop(Certified::read("x", &random.changed(&self.certified))),
            5 => drop(Answers::read("x", &random.changed(&self.answers), &known.problems)),
            6 => drop(read_conditions(&random.changed(&self.formulas), &known.names)),
            _ => drop(read(&random.changed(&self.formulas), &known.names)),
        }
    }
}

/// What parsers are told.
struct Known {
    symbols: Symbols,
    names: Names,
    problems: Vec<Problem>,
}

impl Known {
    fn new() -> Self {
        let symbols = read_symbols(SYMBOLS).unwrap();
        Self {
            names: symbols.names.clone(),
            problems: all(|problem| problem.name == "orbit-focus").unwrap(),
            symbols,
        }
    }
}

/// No input that is read takes longer; on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);

/// Runs a check on so many seeds on two threads.
fn on_seeds(count: u64, check: impl Fn(u64) + Sync) {
    std::thread::scope(|scope| {
        for first in 0..2 {
            let check = &check;
            scope.spawn(move || (first..count).step_by(2).for_each(check));
        }
    });
}

fn parsers(count: u64) {
    let (texts, known) = (Texts::new(), Known::new());
    on_seeds(count, |seed| {
        let start = Instant::now();
        let read = || texts.read(&mut Random(seed), &known);
        assert!(catch_unwind(std::panic::AssertUnwindSafe(read)).is_ok(), "seed {seed}");
        assert!(start.elapsed() < LONGEST, "seed {seed}");
    });
}

/// A scene of little work, whatever else is changed in it.
const SMALL: [&str; 12] = [
    "--set",
    "max_periods=1",
    "--set",
    "sweep.points=3",
    "--set",
    "sweep.impacts=20",
    "--set",
    "sweep.keep=5",
    "--effort",
    "1",
    "--impacts",
    "20",
];

/// The options among [`SMALL`] that a command has.
fn arguments(command: &str) -> Vec<&'static str> {
    match command {
        "audit" => SMALL[8..10].to_vec(),
        "simulate" => [&SMALL[..2], &SMALL[10..]].concat(),
        "orbits" => SMALL[..2].to_vec(),
        // the file is read, and few problems are solved
        "score" => vec!["--kind", "orbit", "--level", "easy"],
        _ => SMALL[..8].to_vec(),
    }
}

fn commands(count: u64) {
    let texts = Texts::new();
    let scratch = scratch(&format!("commands-{count}"));
    on_seeds(count, |seed| {
        if seed > 0 && seed.is_multiple_of(1000) {
            println!("{seed} inputs answered");
        }
        let mut random = Random(seed);
        let command = ["audit", "orbits", "branch", "sweep", "simulate", "score", "plot"][random.below(7)];
        let text = random.changed(match command {
            "audit" => &texts.sheets,
            "score" => &texts.answers,
            _ => &texts.scenes,
        });
        let path = scratch.file(&format!("{}", seed % 2), text);
        let start = Instant::now();
        let ran = program([&[command, &path], &arguments(command)[..]].concat()).run();
        let said = ran.stderr;
        let is_told = matches!(ran.status, Some(0..=2)) && !said.contains("panicked");
        assert!(
            is_told && start.elapsed() < 3 * LONGEST,
            "{command}, seed {seed}: {:?} {said}",
            ran.status
        );
        let is_clean = !said.chars().any(|c| c.is_ascii_control() && !"\n\t".contains(c));
        assert!(is_clean, "{command}, seed {seed}: {said:?}");
        let _ = std::fs::remove_file(path);
    });
}

#[test]
fn parsers_answer_each_of_20000_inputs() {
    parsers(20_000);
}

#[test]
fn commands_answer_each_of_60_inputs() {
    commands(60);
}

#[test]
#[ignore = "minutes: part of .ci/long"]
fn parsers_answer_each_of_ten_million_inputs() {
    parsers(10_000_000);
}

#[test]
#[ignore = "half an hour: part of .ci/long"]
fn commands_answer_each_of_50000_inputs() {
    commands(50_000);
}
