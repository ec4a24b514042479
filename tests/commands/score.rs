//! `problems` and `score` as a user has them: the frozen answers, our own solver, a program of somebody else, bad input.

use crate::common::program::{program, run, scratch};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use vibro_audit::accuracy::problems::{self, Certified, Means, Number, solve};
use vibro_audit::accuracy::problems::{Kind, Level};
use vibro_audit::accuracy::score::{Answers, Precision, Rating, parts, rate};
use vibro_audit::number::Analytic;

/// Every problem, certified once for all tests.
fn certified() -> &'static [Certified] {
    static ALL: std::sync::LazyLock<Vec<Certified>> =
        std::sync::LazyLock::new(|| problems::all(|_| true).unwrap_or_else(|error| panic!("{error}")));
    &ALL
}

/// The answers that `exact` are, as a file.
fn file_of(exact: &[Certified], change: impl Fn(&str, &str) -> String) -> String {
    let rows = exact
        .iter()
        .flat_map(|known| known.answers.iter().map(move |answer| (known.problem.name, answer)));
    let rows = rows.map(|(name, answer)| {
        format!(
            "{name},{},{}\n",
            answer.quantity,
            change(&answer.quantity, &answer.text)
        )
    });
    "problem,quantity,answer\n".to_owned() + &rows.collect::<String>()
}

fn rated(file: &str) -> Vec<Rating> {
    rate(certified(), &Answers::read("answers", file, certified()).unwrap())
}

#[test]
fn the_frozen_answers_are_those_that_are_computed() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/problems/problems.csv");
    let frozen = fs::read_to_string(path).unwrap();
    let printed = run(&["problems"]).succeeded();
    for (line, (frozen, printed)) in frozen.lines().zip(printed.lines()).enumerate() {
        assert_eq!(frozen, printed, "line {}", line + 1);
    }
    // where an answer is to change: `vibro-audit problems --out golden/problems/problems.csv`
    assert_eq!(frozen, printed);
}

#[test]
fn every_answer_has_thirty_digits_and_scores_as_many_against_itself() {
    for answer in certified().iter().flat_map(|known| &known.answers) {
        let digits = answer
            .text
            .split('e')
            .next()
            .unwrap()
            .bytes()
            .filter(u8::is_ascii_digit);
        let significant: Vec<u8> = digits.skip_while(|digit| *digit == b'0').collect();
        assert!(
            significant.len() == 30 || answer.value.to_f64() == 0.0,
            "{}",
            answer.text
        );
    }
    let ratings = rated(&file_of(certified(), |_, text| text.to_owned()));
    assert!(ratings.iter().all(|rating| rating.digits == Some(30.0)));
}

#[test]
fn an_answer_cut_to_a_double_has_the_digits_of_one() {
    let ratings = rated(&file_of(certified(), |_, text| {
        text.parse::<f64>().unwrap().to_string()
    }));
    for rating in &ratings {
        // half a unit of rounding to a double, and half of one to the shortest text that reads back to it; of a phase of
        // size 4 to 2 pi that is 8.9e-16
        assert!(rating.digits.unwrap() > 15.04, "{} {}", rating.problem, rating.quantity);
    }
}

/// Our own answers, as `problems --solve` prints them.
fn own(means: Means) -> Vec<Rating> {
    let mut file = "problem,quantity,answer\n".to_owned();
    for Certified { problem, .. } in certified() {
        for (quantity, value) in solve(problem, means).unwrap_or_default() {
            file += &format!("{},{quantity},{value}\n", problem.name);
        }
    }
    rated(&file)
}

fn digits(ratings: &[Rating], kind: Kind, level: Level) -> Precision {
    let parts = parts(ratings);
    let part = parts.into_iter().find(|part| (part.kind, part.level) == (kind, level));
    part.unwrap().precision
}

#[test]
fn our_own_orbits_impacts_and_runs_keep_the_digits_of_a_double_at_every_level() {
    let ratings = own(Means::Default);
    assert!(ratings.iter().all(|rating| rating.digits.is_some()));
    for level in Level::ALL {
        for kind in [Kind::Orbit, Kind::Impact, Kind::Run] {
            let worst = digits(&ratings, kind, level).worst.unwrap();
            assert!(worst > 15.0, "{kind} {level}: {worst}");
        }
        // (6) loses no digit in its stable form, but the power has some roundings
        let worst = digits(&ratings, Kind::Voltage, level).worst.unwrap();
        assert!(worst > 14.3, "{level}: {worst}");
    }
}

#[test]
fn plain_f64_loses_what_the_condition_takes() {
    let ratings = own(Means::Double);
    let worst = |kind, level| digits(&ratings, kind, level).worst.unwrap_or(0.0);
    for kind in Kind::ALL {
        assert!(worst(kind, Level::Easy) > 13.3, "{kind}: {}", worst(kind, Level::Easy));
    }
    // the derivative of a long cycle, and a flight that arrives slowly, lose some
    for kind in Kind::ALL {
        assert!(worst(kind, Level::Hard) > 11.5, "{kind}: {}", worst(kind, Level::Hard));
    }
    // beyond a hundred impacts of a chaotic motion nothing is left
    assert_eq!(worst(Kind::Run, Level::Extreme), 0.0);
    assert!(worst(Kind::Voltage, Level::Extreme) > 14.3);
}

#[test]
fn levels_are_harder_one_after_the_other() {
    let ratings = own(Means::Double);
    let lost = |level| {
        let own: Vec<&Rating> = ratings.iter().filter(|rating| rating.level == level).collect();
        own.iter()
            .map(|rating| 16.0 - rating.digits.unwrap_or(0.0).min(16.0))
            .sum::<f64>()
            / own.len() as f64
    };
    let [easy, hard, extreme] = Level::ALL.map(lost);
    assert!(easy < hard && hard < extreme, "{easy} {hard} {extreme}");
}

#[test]
fn our_own_answers_go_from_one_command_to_the_other() {
    let scratch = scratch("plot");
    let plot = scratch.path("digits.svg");
    let solved = run(&["problems", "--solve", "--kind", "impact"]).succeeded();
    let arguments = [
        "score",
        "-",
        "--kind",
        "impact",
        "--at-least",
        "15",
        "--format",
        "csv",
        "--plot",
    ];
    let arguments = [&arguments[..], &[&plot]].concat();
    let scored = program(arguments).input(&solved).run().succeeded();
    let mut lines = scored.lines();
    assert_eq!(lines.next(), Some("problem,quantity,digits,seconds,kind,level"));
    assert!(lines.all(|line| line.contains(",impact,")));
    let svg = fs::read_to_string(&plot).unwrap();
    let drawn = roxmltree::Document::parse(&svg).unwrap();
    assert!(
        drawn
            .descendants()
            .any(|node| node.text().is_some_and(|text| text.contains("digits")))
    );

    // the same answers are too few where more is asked
    let few = program(["score", "-", "--at-least", "15", "--level", "easy"]);
    let scored = few.input(solved).run();
    assert_eq!(scored.status, Some(1));
    assert!(scored.stderr.contains("quantities have no answer"), "{}", scored.stderr);
}

#[test]
fn a_program_is_scored_at_each_tolerance() {
    let scratch = scratch("exec");
    let plot = scratch.path("curve.svg");
    // the period of a motion that takes one, 2, wrong by a thousandth or by a billionth of it
    let solver = "cat > /dev/null; echo problem,quantity,answer
        case {tolerance} in 1e-3) echo orbit-one-wall,time_1,2.002;; *) echo orbit-one-wall,time_1,2.000000002;; esac";
    let arguments = [
        "score",
        "--exec",
        solver,
        "--tolerances",
        "1e-3,1e-9",
        "--kind",
        "orbit",
        "--level",
        "easy",
    ];
    let rows = run(&[&arguments[..], &["--format", "csv"]].concat()).succeeded();
    assert!(rows.starts_with("problem,quantity,digits,seconds,kind,level,tolerance\n"));
    let summary = ["--summary", "--format", "csv", "--plot", &plot];
    let summary = run(&[&arguments[..], &summary].concat());
    let table = summary.stdout;
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|field| field.parse().unwrap()).collect())
        .collect();
    assert!(
        table.starts_with("tolerance,quantities,answered,worst,median,seconds\n"),
        "{table}"
    );
    assert_eq!(
        rows.iter().map(|row| row[0]).collect::<Vec<_>>(),
        [1e-3, 1e-9],
        "{table}"
    );
    assert_eq!(rows.iter().map(|row| row[3]).collect::<Vec<_>>(), [3.0, 9.0], "{table}");
    assert!(rows.iter().all(|row| row[2] == 1.0 && row[5] > 0.0), "{table}");
    assert!(fs::read_to_string(&plot).unwrap().contains("Work and precision"));
}

#[test]
fn a_program_that_fails_is_an_error_that_says_what() {
    for (command, limit, words) in [
        ("echo broken >&2; exit 7", "60", "exit status: 7\n  broken"),
        ("echo nonsense", "60", "line 1: the header has no `problem`"),
        ("cat", "60", "line 1: the header has no `answer`"),
        ("true", "60", "it is empty"),
        ("sleep 30", "0.5", "still ran after 0.5 s"),
    ] {
        let arguments = [
            "score", "--exec", command, "--limit", limit, "--kind", "impact", "--level", "easy",
        ];
        let ran = run(&arguments);
        assert_eq!(ran.status, Some(2), "{command}");
        assert!(ran.stderr.contains(words), "{command}: {}", ran.stderr);
    }
}

#[cfg(unix)]
#[test]
fn a_program_does_not_outlive_an_interrupt() {
    let scratch = scratch("interrupt");
    let path = scratch.join("id");
    let command = format!("echo $$ > '{}'; sleep 300 | sleep 300", path.display());
    let mut scoring = program([
        "score", "--exec", &command, "--limit", "300", "--kind", "impact", "--level", "easy",
    ])
    .spawn();
    let start = Instant::now();
    let wait_for = |what: &dyn Fn() -> bool| {
        while !what() {
            assert!(start.elapsed().as_secs() < 60);
            std::thread::sleep(Duration::from_millis(50));
        }
    };
    let id = || fs::read_to_string(&path).unwrap_or_default().trim().to_owned();
    wait_for(&|| !id().is_empty());
    scoring.kill().unwrap();
    scoring.wait().unwrap();
    let lives = || {
        Command::new("kill")
            .args(["-0", &id()])
            .stderr(Stdio::null())
            .status()
            .unwrap()
            .success()
    };
    wait_for(&|| !lives());
}

#[test]
fn what_makes_no_sense_is_refused_before_anything_runs() {
    for arguments in [
        &["score"][..],
        &["score", "a.csv", "--exec", "true"],
        &["score", "a.csv", "--tolerances", "1e-3"],
        &["score", "--exec", "true", "--tolerances", "0"],
        &["score", "--exec", "true", "--limit", "NaN"],
        &["score", "-", "--at-least", "31"],
        &["score", "-", "--kind", "orbits"],
        &["score", "no/such/file.csv"],
        &["score", "-", "--plot", "no/such/directory/plot.svg"],
        &["problems", "--solve", "--without-answers"],
        &["problems", "--level", "easiest"],
    ] {
        let ran = run(arguments);
        assert_eq!(ran.status, Some(2), "{arguments:?}");
        assert!(ran.stderr.starts_with("error: "), "{arguments:?}: {}", ran.stderr);
    }
}

#[test]
fn problems_without_answers_hide_them_and_say_the_rest() {
    let all = run(&["problems", "--level", "easy"]);
    let hidden = run(&["problems", "--level", "easy", "--without-answers"]);
    let (all, hidden) = (all.stdout, hidden.stdout);
    assert_eq!(all.lines().count(), hidden.lines().count());
    for (line, all) in hidden.lines().zip(all.lines()) {
        assert!(all.starts_with(line), "{line}");
    }
    assert!(
        hidden
            .lines()
            .next()
            .is_some_and(|header| header.ends_with(",quantity"))
    );
}

/// python3 that has SciPy, or a word that there is none.
fn python() -> Option<String> {
    let python = std::env::var("VIBRO_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let found = Command::new(&python).args(["-c", "import scipy, numpy"]).output();
    if found.is_ok_and(|found| found.status.success()) {
        return Some(python);
    }
    println!("skipped: {python} has no SciPy");
    None
}

#[test]
fn the_scipy_example_answers_better_where_it_is_asked_to() {
    let Some(python) = python() else { return };
    let solver = format!("{python} {}/examples/scipy_solver.py", env!("CARGO_MANIFEST_DIR"));
    let arguments = [
        "score",
        "--exec",
        &solver,
        "--tolerances",
        "1e-5,1e-11",
        "--level",
        "easy",
        "--limit",
        "600",
    ];
    let table = run(&[&arguments[..], &["--summary", "--format", "csv"]].concat()).succeeded();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|field| field.parse().unwrap()).collect())
        .collect();
    let [loose, tight] = [&rows[0], &rows[1]];
    // all but the motion to rest, of four quantities; at the loose tolerance fsolve gives one or two up
    assert!(tight[1] - tight[2] == 4.0 && loose[1] - loose[2] < 20.0, "{rows:?}");
    assert!(tight[4] > loose[4] + 3.0 && tight[4] > 8.0, "{rows:?}");
}

#[test]
fn a_thousand_times_as_many_rows_are_refused_at_the_first_that_comes_twice() {
    let once = file_of(certified(), |_, text| text.to_owned());
    let body = once.split_once('\n').unwrap().1;
    let many = once.clone() + &body.repeat(1000);
    let error = Answers::read("answers", &many, certified()).unwrap_err();
    assert_eq!(error.line, Some(once.lines().count() as u64 + 1));
    assert!(Number::parse("1").is_some());
}
