//! The binary as a script sees it: exit status, stdout, stderr.

use crate::common::program::{program, run, scratch};
use std::fs;
use std::process::{Command, Output, Stdio};

/// Asserts that the input was refused: status 2, nothing on stdout, one message on stderr that has `words`.
fn assert_refused(arguments: &[&str], words: &[&str]) {
    let message = run(arguments).refused(words);
    assert!(message.starts_with("error: "), "{arguments:?}: {message}");
    assert!(!message.contains("backtrace"), "{message}");
    assert!(
        !message.contains('\u{1b}'),
        "colours where there is no terminal: {message:?}"
    );
}

#[test]
fn help_and_version_succeed_on_stdout() {
    for arguments in [
        &["--help"][..],
        &["help"],
        &["audit", "--help"],
        &["trade", "--help"],
        &["--version"],
    ] {
        let ran = run(arguments);
        assert_eq!(ran.status, Some(0), "{arguments:?}");
        assert!(!ran.stdout.is_empty() && ran.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn help_names_every_command_format_and_exit_status() {
    let help = run(&["--help"]).stdout;
    for word in [
        "audit",
        "trade",
        "scenes",
        "run",
        "--format",
        "text, csv, json, jsonl, markdown",
        "--out",
        "--digits",
        "Exit status: 0",
    ] {
        assert!(help.contains(word), "help does not say `{word}`:\n{help}");
    }
}

#[test]
fn advice_names_a_means_that_does_what_is_asked_and_else_the_closest() {
    let advised = |need: &str| {
        let ran = run(&["trade", "--advise", need, "--format", "csv"]);
        let text = ran.stdout;
        let rows: Vec<Vec<String>> = text
            .lines()
            .map(|line| line.split(',').map(str::to_owned).collect())
            .collect();
        (ran.status, rows)
    };
    let (code, rows) = advised("digits=12,task=multipliers/saddle");
    assert_eq!(code, Some(0));
    assert_eq!(
        rows[0].join(","),
        "task,rank,by,number,method,kept,seconds,setting,solved,problems,cost,proved"
    );
    let cheapest: Vec<_> = rows.iter().filter(|row| row[1] == "cheapest").collect();
    assert_eq!(cheapest.len(), 2);
    for row in cheapest {
        assert!(row[5].parse::<f64>().unwrap() >= 12.0, "{row:?}");
        // (19) as printed keeps fewer digits of a saddle in f64; by time another may be cheapest on a busy machine
        if row[2] == "operations" {
            assert_eq!((row[3].as_str(), row[4].as_str()), ("f64", "stable"));
        }
    }
    let (code, rows) = advised("digits=70,task=multipliers/random");
    assert_eq!(code, Some(1));
    assert_eq!((rows.len(), rows[1][1].as_str()), (2, "closest"));
}

#[test]
fn no_command_at_all_shows_help_and_is_refused() {
    let ran = run(&[]);
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("Usage: vibro-audit"));
}

#[test]
fn an_unknown_command_option_task_or_format_is_refused() {
    assert_refused(&["prove"], &["prove"]);
    assert_refused(&["audit", "--colour"], &["--colour"]);
    assert_refused(&["trade", "tea"], &["tea", "dp"]);
    assert_refused(&["trade", "--advise", "digits=8,task=tea"], &["tea", "dp", "orbit"]);
    assert_refused(&["trade", "--advise", "digits=8,solved=2"], &["solved=2", "at most 1"]);
    assert_refused(&["trade", "--advise", "speed=8"], &["speed", "digits", "error"]);
    assert_refused(&["trade", "dp", "--advise", "digits=8"], &["--advise"]);
    assert_refused(&["trade", "--problems", "--plot", "a.svg"], &["--problems", "--plot"]);
    assert_refused(
        &["audit", "--format", "xml"],
        &["xml", "text", "csv", "json", "markdown"],
    );
    assert_refused(&["audit", "--digits", "NaN"], &["NaN", "--digits"]);
    assert_refused(&["audit", "--digits", "0"], &["0", "--digits"]);
}

#[test]
fn a_sheet_that_cannot_be_read_is_named() {
    let scratch = scratch("sheet");
    assert_refused(&["audit", &scratch.path("none.toml")], &["none.toml", "no such file"]);
    assert_refused(&["audit", &scratch.path("")], &["directory"]);
    fs::write(scratch.path("bytes.toml"), b"title = \"\xff\"").unwrap();
    assert_refused(
        &["audit", &scratch.path("bytes.toml")],
        &["bytes.toml", "UTF-8", "byte 9"],
    );
}

#[test]
fn out_into_a_missing_directory_is_refused_and_creates_nothing() {
    let scratch = scratch("missing");
    assert_refused(
        &["audit", "--out", &scratch.path("none/table.csv")],
        &["none/table.csv", "no directory"],
    );
    assert_eq!(scratch.names().len(), 0);
}

#[test]
fn out_onto_a_directory_is_refused() {
    let scratch = scratch("directory");
    assert_refused(&["audit", "--out", &scratch.path("")], &["it is a directory"]);
    assert_refused(&["audit", "--out", &scratch.path("new/")], &["it is a directory"]);
    assert_eq!(scratch.names().len(), 0);
}

#[cfg(unix)]
#[test]
fn a_reader_that_stops_reading_is_no_error() {
    for arguments in [&["--help"][..], &["audit", "--help"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut command = program(arguments).command();
        let output = command.stdout(writer).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(String::from_utf8(output.stderr).unwrap(), "", "{arguments:?}");
    }
}

#[test]
fn whether_the_rows_are_all_is_a_column_and_can_be_required() {
    let last = |arguments: &[&str]| {
        let ran = run(&[arguments, &["--format", "csv", "--require-complete"]].concat());
        let text = ran.stdout;
        let rows: Vec<String> = text.lines().skip(1).map(str::to_owned).collect();
        assert!(
            text.lines().next().unwrap().ends_with(",number,complete,low,high"),
            "{text}"
        );
        (ran.status, rows)
    };
    let (status, rows) = last(&["orbits", "fig02"]);
    assert!(
        status == Some(0) && rows.iter().all(|row| row.ends_with(",true,,")),
        "{rows:?}"
    );
    let (status, rows) = last(&["branch", "fig02", "--set", "sweep.points=3"]);
    assert!(
        status == Some(0) && rows.iter().all(|row| row.ends_with(",true,,")),
        "{rows:?}"
    );
    // nor where it finds nothing along a branch
    let none = [
        "branch",
        "fig02",
        "--set",
        "words=BBBT",
        "--set",
        "sweep.from=50",
        "--set",
        "sweep.to=51",
    ];
    let (status, rows) = last(&[&none[..], &["--set", "sweep.points=2"]].concat());
    assert!(
        status == Some(1) && rows.len() == 1 && rows[0].starts_with("undecided,BBBT,"),
        "{rows:?}"
    );
    // a search for another word proves nothing, and says so where it finds nothing
    let (status, rows) = last(&["orbits", "fig02", "--set", "words=BTT"]);
    assert!(status == Some(1) && !rows.is_empty(), "{rows:?}");
    assert!(rows.iter().all(|row| row.contains(",false,")), "{rows:?}");
    let none = ["orbits", "fig02", "--set", "words=BBBBTT", "--set", "motion.d=50"];
    let (status, rows) = last(&none);
    assert!(
        status == Some(1) && rows.len() == 1 && rows[0].contains(",undecided,"),
        "{rows:?}"
    );
}

#[test]
fn more_digits_lose_no_orbit() {
    // close to a symmetry breaking, where 60 digits could not prove the one in the middle
    let scene = "want = ['orbits']\nwords = ['BT']\n[motion]\ng = 0.0\nd = 0.26343156\nr_b = 0.5\nr_t = 0.5\n";
    let scratch = scratch("digits");
    let path = scratch.path("scene.toml");
    fs::write(&path, scene).unwrap();
    for digits in ["15", "30", "60", "100"] {
        let text = run(&["orbits", &path, "--digits", digits, "--format", "csv"]).stdout;
        assert_eq!(text.lines().count(), 5, "{digits}: {text}");
        assert!(!text.contains("undecided"), "{digits}: {text}");
    }
}

#[test]
fn no_output_replaces_an_input() {
    let scratch = scratch("inputs");
    let [sheet, link] = [scratch.path("sheet.toml"), scratch.path("link.toml")];
    let text = "[[equation]]\nlabel = 'a'\nrole = 'claim'\ntex = 'd = d'\n";
    fs::write(&sheet, text).unwrap();
    std::os::unix::fs::symlink(&sheet, &link).unwrap();
    for out in [&sheet, &link] {
        assert_refused(&["audit", &sheet, "--out", out], &["read as an input", "another file"]);
        assert_eq!(fs::read_to_string(&sheet).unwrap(), text);
    }
    assert_refused(&["audit", &link, "--out", &sheet], &["read as an input"]);
    // by another name of the file itself, and where it is standard input
    let hard = scratch.path("hard.toml");
    fs::hard_link(&sheet, &hard).unwrap();
    assert_refused(&["audit", &sheet, "--out", &hard], &["read as an input"]);
    let mut command = program(["audit", "-", "--out", &sheet]).command();
    let output = command.stdin(fs::File::open(&sheet).unwrap()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("read as an input"));
    assert_eq!(fs::read_to_string(&sheet).unwrap(), text);
    // behind standard output, whatever its name
    let mut command = program(["audit", &sheet, "--out", "/dev/stdout"]).command();
    let behind = fs::OpenOptions::new().append(true).open(&sheet).unwrap();
    let output = command.stdout(behind).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_to_string(&sheet).unwrap(), text);
    // below a directory that is read
    let scenes = scratch.path("golden/scenes");
    fs::create_dir_all(&scenes).unwrap();
    let scene = format!("{scenes}/a.toml");
    fs::write(&scene, run(&["scenes", "fig02"]).stdout).unwrap();
    let row = "id,place,scene,set,quantity,printed,unit,expected,rests_on,note\na,p,scenes/a.toml,,orbits.determinant,7,,wrong,,\n";
    fs::write(scratch.path("golden/printed.csv"), row).unwrap();
    assert_refused(
        &["check", &scratch.path("golden"), "--out", &scene],
        &["read as an input"],
    );
    // beside it there is room
    assert_eq!(
        run(&["audit", &sheet, "--out", &scratch.path("rows.txt")]).status,
        Some(0)
    );
}

#[test]
fn a_table_and_a_drawing_are_two_files_however_they_are_spelled() {
    let scratch = scratch("both");
    for out in ["x.svg", "./x.svg", "sub/../x.svg"] {
        fs::create_dir_all(scratch.path("sub")).unwrap();
        let (plot, out) = (scratch.path("x.svg"), scratch.path(out));
        assert_refused(
            &["trade", "multipliers", "--plot", &plot, "--out", &out],
            &["hold both"],
        );
    }
}

#[test]
fn a_file_behind_stdout_keeps_what_is_in_it() {
    let scratch = scratch("behind");
    let log = scratch.path("log.txt");
    let mut file = fs::File::create(&log).unwrap();
    std::io::Write::write_all(&mut file, b"before\n").unwrap();
    let mut command = program(["scenes", "--out", "/dev/stdout"]).command();
    let status = command.stdout(file).status().unwrap();
    let text = fs::read_to_string(&log).unwrap();
    assert!(
        status.success() && text.starts_with("before\n") && text.contains("fig02"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_parsed_is_told_by_line_and_column() {
    assert_refused(&["orbits", "fig02", "--set", "words = [3 x] "], &["column 10"]);
    let scratch = scratch("answers");
    let answers = scratch.path("answers.csv");
    for (row, place) in [
        ("foo,phase_1,1", "line 2, column problem"),
        ("impact-fast,phase_9,1", "line 2, column quantity"),
        ("impact-fast,time,one", "line 2, column answer"),
    ] {
        fs::write(&answers, format!("problem,quantity,answer\n{row}\n")).unwrap();
        assert_refused(&["score", &answers, "--kind", "impact"], &[place]);
    }
}

#[test]
fn an_endless_input_is_refused() {
    assert_refused(&["audit", "/dev/zero"], &["/dev/zero", "2 MB"]);
    assert_refused(&["orbits", "/dev/zero"], &["/dev/zero", "2 MB"]);
    assert_refused(&["score", "/dev/zero"], &["/dev/zero", "16 MB"]);
    assert_refused(&["stress", "--frozen", "/dev/zero"], &["/dev/zero", "16 MB"]);
    assert_refused(&["audit", "--baseline", "/dev/zero"], &["/dev/zero", "16 MB"]);
    assert_refused(&["merge", "/dev/zero"], &["/dev/zero", "not a regular file"]);
    #[cfg(unix)]
    {
        let scratch = scratch("endless");
        // three gigabytes without a line break, of which the disk holds none
        let long = scratch.path("long.csv");
        fs::File::create(&long).unwrap().set_len(3 << 30).unwrap();
        assert_refused(&["merge", &long], &["long.csv", "a line has more than 16 MB"]);
        let part = scratch.path("rows.csv.part");
        fs::rename(&long, &part).unwrap();
        let rows = scratch.path("rows.csv");
        let resumed = [
            "map", "fig03", "--set", MAP, "--format", "csv", "--resume", "--out", &rows,
        ];
        assert_refused(&resumed, &["rows.csv.part", "a line has more than 16 MB"]);
        std::os::unix::fs::symlink("/dev/zero", scratch.path("printed.csv")).unwrap();
        let directory = scratch.path("");
        assert_refused(&["check", &directory], &["printed.csv", "not a regular file"]);
    }
}

/// A map of one point.
const MAP: &str = r#"map={impacts = 60, starts = [{phase = 6.18, velocity = 0.53}], x = {over = "d", from = 0.1, to = 0.2, points = 1}, y = {over = "r_b", from = 0.3, to = 0.9, points = 1}}"#;

#[cfg(unix)]
#[test]
fn a_name_that_the_program_chose_is_never_written_through_a_link() {
    let scratch = scratch("links");
    let precious = scratch.path("precious");
    fs::write(&precious, "precious").unwrap();
    let directory = scratch.path("all");
    fs::create_dir(&directory).unwrap();
    let rows = scratch.path("rows.csv");
    let resumed = [
        "map", "fig03", "--set", MAP, "--format", "csv", "--resume", "--out", &rows,
    ];
    let run_all = [
        "run",
        "fig02",
        "--set",
        "want=[\"orbits\"]",
        "--format",
        "html",
        "--out",
        &directory,
    ];
    let added = [
        "check",
        &directory,
        "--add",
        "a",
        "--place",
        "p",
        "--scene",
        "fig02",
        "--set",
        "motion.d=0.4",
        "--quantity",
        "orbits.velocities[0]",
        "--printed",
        "0.83272",
    ];
    for (name, arguments) in [
        ("all/vibro-audit-map.1", &["man", &directory][..]),
        ("all/orbits.csv", &run_all),
        ("all/report.html", &run_all),
        ("all/printed.csv", &added),
        ("rows.csv.part", &resumed),
    ] {
        for to in [&precious, &scratch.path("nothing")] {
            let link = scratch.path(name);
            std::os::unix::fs::symlink(to, &link).unwrap();
            assert_refused(arguments, &[name, "is a symbolic link to"]);
            assert!(fs::read_link(&link).is_ok(), "{name}");
            fs::remove_file(&link).unwrap();
        }
    }
    assert_eq!(fs::read_to_string(&precious).unwrap(), "precious");
    assert!(!scratch.join("nothing").exists() && !scratch.join("rows.csv").exists());
    // a directory between may be a link
    std::os::unix::fs::symlink(&directory, scratch.path("way")).unwrap();
    assert_eq!(run(&["man", &scratch.path("way")]).status, Some(0));
}

#[test]
fn a_figure_of_more_than_it_shows_is_refused_before_it_is_computed() {
    let few = [
        "--set",
        "sweep.points=1000",
        "--set",
        "sweep.keep=1000",
        "--set",
        "sweep.impacts=1000",
    ];
    assert_refused(
        &[&["plot", "fig04"], &few[..]].concat(),
        &["1000000 impacts", "sweep.keep"],
    );
    let many = ["plot", "fig02", "--set", "sweep.points=1000000"];
    assert_refused(&many, &["values of motions", "sweep.points"]);
}

#[test]
fn a_branch_of_more_values_than_are_computed_together_is_in_order_with_each_event_at_its_place() {
    for ends in [["0.24", "0.42"], ["0.42", "0.24"]] {
        let [from, to] = ends.map(String::from);
        let (from, to) = (format!("sweep.from={from}"), format!("sweep.to={to}"));
        let sets = ["--set", &from, "--set", &to, "--set", "sweep.points=2500"];
        let text = run(&[&["branch", "fig02", "--format", "csv"], &sets[..]].concat()).stdout;
        let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
        let gaps: Vec<f64> = rows.iter().map(|row| row[3].parse().unwrap()).collect();
        let rises = ends[0] < ends[1];
        assert!(
            gaps.windows(2)
                .all(|two| if rises { two[0] <= two[1] } else { two[0] >= two[1] })
        );
        let kinds: Vec<&str> = rows.iter().map(|row| row[0]).filter(|kind| *kind != "point").collect();
        assert!(
            rows.len() > 2500 + kinds.len() && kinds.contains(&"period-doubling"),
            "{kinds:?}"
        );
    }
}

/// What a command that would run for ever comes to under a signal that is sent after its first output, or after a time.
#[cfg(unix)]
fn signalled(arguments: &[&str], signal: &str) -> Output {
    let mut command = program(arguments).command();
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(700));
    let id = child.id().to_string();
    // the pipe is full by now: nobody may wait for what is read after the signal alone
    let mut stdout = child.stdout.take().unwrap();
    let read = std::thread::spawn(move || {
        let mut bytes = Vec::new();
        std::io::Read::read_to_end(&mut stdout, &mut bytes).unwrap();
        bytes
    });
    assert!(
        Command::new("kill")
            .args(["-s", signal, &id])
            .status()
            .unwrap()
            .success()
    );
    let mut output = child.wait_with_output().unwrap();
    output.stdout = read.join().unwrap();
    output
}

#[cfg(unix)]
#[test]
fn a_signal_ends_with_whole_rows_and_leaves_no_file() {
    let endless = ["simulate", "fig03", "--impacts", "100000000000"];
    let stopped = signalled(&[&endless[..], &["--format", "json"]].concat(), "INT");
    assert_eq!(stopped.status.code(), Some(130));
    let rows: serde_json::Value = serde_json::from_slice(&stopped.stdout).unwrap();
    assert!(rows.as_array().unwrap().len() >= 1000);
    assert!(
        String::from_utf8(stopped.stderr)
            .unwrap()
            .contains("stopped by a signal after")
    );
    let scratch = scratch("signals");
    let out = scratch.join("rows.csv");
    fs::write(&out, "before").unwrap();
    let out = out.to_str().unwrap();
    let sweep = ["sweep", "fig04", "--set", "sweep.impacts=1000000000"];
    for (command, signal) in [(&endless[..], "TERM"), (&sweep[..], "HUP"), (&sweep[..], "INT")] {
        let stopped = signalled(&[command, &["--out", out]].concat(), signal);
        assert_eq!(stopped.status.code(), Some(130), "{signal}");
        assert_eq!(scratch.names().len(), 1, "{signal}");
        assert_eq!(fs::read_to_string(out).unwrap(), "before", "{signal}");
    }
}

#[cfg(unix)]
#[test]
fn a_replaced_file_keeps_its_permissions_and_a_link_to_nothing_is_said() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = scratch("permissions");
    let out = scratch.join("rows.csv");
    fs::write(&out, "").unwrap();
    fs::set_permissions(&out, fs::Permissions::from_mode(0o600)).unwrap();
    assert_eq!(run(&["scenes", "--out", out.to_str().unwrap()]).status, Some(0));
    assert!(fs::metadata(&out).unwrap().len() > 0);
    assert_eq!(fs::metadata(&out).unwrap().permissions().mode() & 0o777, 0o600);
    let link = scratch.join("link");
    std::os::unix::fs::symlink(scratch.join("nowhere"), &link).unwrap();
    let refused = run(&["scenes", "--out", link.to_str().unwrap()]);
    let message = refused.stderr;
    assert!(
        refused.status == Some(2) && message.contains("is a link to"),
        "{message}"
    );
    assert!(fs::read_link(&link).is_ok() && !scratch.join("nowhere").exists());
}

#[test]
fn nothing_of_an_input_reaches_a_terminal_as_a_control_character() {
    let scratch = scratch("control");
    let scene = scratch.file("scene.toml", "\"\\u001b[31mkey\" = 1\n");
    let sheet = |label: &str, tex: &str| {
        format!("[symbols]\nparameters = ['x']\n[[equation]]\nlabel = \"{label}\"\nrole = \"claim\"\ntex = \"{tex}\"\n")
    };
    let label = scratch.file("label.toml", sheet("a\\u0000b", "x=x"));
    let tex = scratch.file("tex.toml", sheet("a", "x=y\\u001b[31m"));
    for arguments in [
        &["orbits", "fig02", "--set", "motion.d=\u{1b}[31mred"][..],
        &["orbits", &scene],
        &["audit", &label],
        &["audit", &tex],
        &["audit", &tex, "--format", "csv"],
        &["\u{1b}[31mred"],
    ] {
        let ran = run(arguments);
        assert_eq!(ran.status, Some(2), "{arguments:?}");
        let said = ran.stdout + &ran.stderr;
        assert!(!said.contains(['\u{1b}', '\0']), "{arguments:?}");
    }
    let title =
        "title = \"\\u001b[31m\\u009b\"\nwant = [\"orbits\"]\n[motion]\nd = 0.3\ng = 0.1\nr_b = 0.5\nr_t = 0.5\n";
    let titled = scratch.file("titled.toml", title);
    let text = run(&["run", &titled, "--explain"]).succeeded();
    assert!(!text.contains(['\u{1b}', '\u{9b}']), "{text:?}");
    let formula = scratch.file("formula.toml", sheet("=cmd()", "x=x"));
    let text = run(&["audit", &formula, "--format", "csv"]).stdout;
    assert!(text.lines().nth(1).unwrap().starts_with("'=cmd(),"), "{text}");
}

#[test]
fn an_explained_run_names_the_values_that_keys_have_where_they_are_not_given() {
    let text = run(&["run", "fig02", "--explain"]).succeeded();
    for line in [
        "digits = 12:",
        "options.finest_cell = 0.000000002:",
        "options.most_cells = 200000:",
        "sweep.error = as many impacts as are given:",
        "sweep.most_impacts = 1000000:",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    assert!(!text.contains("= nothing:"), "{text}");
}

#[test]
fn a_very_long_word_of_a_message_is_cut() {
    let long = format!("motion.{}=1", "d".repeat(100_000));
    let message = run(&["orbits", "fig02", "--set", &long]).stderr;
    assert!(
        message.len() < 5000 && message.contains('\u{2026}'),
        "{}",
        message.len()
    );
}

#[test]
fn rows_come_before_the_motion_is_over() {
    let mut command = program(["simulate", "fig03", "--impacts", "100000000000", "--format", "jsonl"]).command();
    let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
    let lines = std::io::BufRead::lines(std::io::BufReader::new(child.stdout.take().unwrap()));
    let rows: Vec<serde_json::Value> = lines
        .take(5)
        .map(|line| serde_json::from_str(&line.unwrap()).unwrap())
        .collect();
    assert_eq!(rows[4]["event"], 5);
    // a reader that stops reading ends it
    assert!(child.wait().unwrap().success());
}
