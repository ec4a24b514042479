//! The scripts of benches/peers can be read, and what SciPy finds is what is certified here.

use crate::common::program;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn peers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers")
}

/// The Python that has the packages: that of $PEERS_PYTHON, or the first in the path.
fn python() -> String {
    std::env::var("PEERS_PYTHON").unwrap_or_else(|_| "python3".to_owned())
}

/// What Python says to these arguments; `None`, and a word, where it is not there or fails at what `needs` names.
fn run(needs: &str, arguments: &[&str]) -> Option<Output> {
    let python = python();
    let has = Command::new(&python).args(["-c", needs]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: {python} -c '{needs}' fails here");
        return None;
    }
    let output = Command::new(&python).args(arguments).current_dir(peers()).output();
    Some(output.expect("Python, as a moment ago"))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn every_python_script_of_the_peers_parses() {
    let parse = "import ast, glob; files = ['run', *sorted(glob.glob('*.py'))]; \
                 [ast.parse(open(file).read(), file) for file in files]; print(len(files))";
    let Some(output) = run("import sys; assert sys.version_info >= (3, 10)", &["-c", parse]) else {
        return;
    };
    assert!(output.status.success(), "{}", text(&output.stderr));
    let count: usize = text(&output.stdout).trim().parse().expect("a count");
    assert!(count >= 8, "{count} scripts");
}

#[test]
fn the_readme_of_the_peers_names_every_script() {
    let readme = std::fs::read_to_string(peers().join("README.md")).expect("a README");
    for entry in std::fs::read_dir(peers()).expect("a directory") {
        let name = entry.expect("an entry").file_name().to_string_lossy().into_owned();
        assert!(
            name.starts_with(['.', '_']) || name == "README.md" || readme.contains(&name),
            "{name}"
        );
    }
}

#[test]
fn scipy_finds_what_is_certified() {
    let arguments = ["run", "--csv", "--only", "scipy", "--binary", program::PATH];
    let Some(output) = run("import scipy", &arguments) else {
        return;
    };
    let table = text(&output.stdout);
    assert!(output.status.success(), "{table}{}", text(&output.stderr));
    let mut lines = table.lines();
    let columns: Vec<&str> = lines.next().expect("the names of the columns").split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let at = |name: &str| columns.iter().position(|column| *column == name).expect("a column");
    // solve_ivp at rtol 1e-12, fsolve at xtol 1e-12, brentq at xtol 1e-11
    for (task, least) in [
        ("impact-focus", 10.0),
        ("impact-three", 10.0),
        ("orbit", 12.0),
        ("doubling", 10.0),
    ] {
        let row = rows.iter().find(|row| row[at("task")] == task).expect(task);
        let digits: f64 = row[at("digits")].parse().expect("digits");
        assert!(digits >= least, "{row:?}");
        assert!(
            row[at("seconds")].parse().is_ok_and(|seconds: f64| seconds > 0.0),
            "{row:?}"
        );
    }
}

#[test]
fn answers_are_judged_by_their_digits() {
    let judged = "import importlib.machinery as m, importlib.util as u; loader = m.SourceFileLoader('run', 'run'); \
                  run = u.module_from_spec(u.spec_from_loader('run', loader)); loader.exec_module(run); \
                  print(run.judge('orbit', ['1.0001', '-2'], ['1.000000', '-2.000000'])); \
                  print(run.judge('orbit', ['1', 'nan'], ['1.000000', '-2.000000'])); \
                  print(run.judge('orbit', ['1'], ['1.000000', '-2.000000'])); \
                  print(run.judge('proof-22', ['refuted'], 'proved')); \
                  print(run.judge('sweep', ['1', 'nan', '3'], [(1.0, True), (2.0, True), None]))";
    let Some(output) = run("import sys; assert sys.version_info >= (3, 10)", &["-B", "-c", judged]) else {
        return;
    };
    let expected = [
        "('4.0', '', False)",
        "('0.0', 'no answer', False)",
        "('0.0', 'no answer', False)",
        "('', 'WRONG: refuted', False)",
        "('', 'right at 1 of 2 gaps, 1 of 2 with rests', False)",
    ];
    let found = text(&output.stdout);
    assert_eq!(found.lines().collect::<Vec<_>>(), expected, "{}", text(&output.stderr));
}

#[test]
fn a_peer_nobody_knows_is_refused() {
    let Some(output) = run("pass", &["run", "--only", "abacus"]) else {
        return;
    };
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("abacus"));
}
