//! The command `stress`: digits at the extremes, held to the bar and to what was frozen.

use crate::common::program::scratch;
use std::sync::LazyLock;
use vibro_audit::accuracy::stress::{Form, StressError, StressRow, WORST, frozen_text, search, stress};

fn rows(case: &str) -> Vec<StressRow> {
    stress(Some(case), WORST).unwrap_or_else(|error| panic!("{case}: {error}"))
}

/// Those of the quick cases, once for all tests.
static ROWS: LazyLock<Vec<StressRow>> = LazyLock::new(|| QUICK.into_iter().flat_map(rows).collect());

/// The cases that take no more than some seconds without optimisation.
const QUICK: [&str; 11] = [
    "r_B r_T near 1",
    "T_1 near r_T T_2",
    "r_B near 0",
    "slow impact",
    "Delta near 0",
    "multipliers far apart",
    "short flight",
    "late time",
    "phase at its wrap",
    "tiny and huge impacts",
    "d near 0",
];

#[test]
fn every_default_form_keeps_what_conditioning_allows_but_for_a_digit_and_a_half() {
    for row in ROWS.iter() {
        assert!(!row.is_below_bar(), "{row:#?}");
        assert!(!row.has_lost_a_digit(), "{row:#?}");
    }
    for case in QUICK {
        let default = |row: &&StressRow| row.case == case && row.form == Form::Stable && row.number == "f64";
        assert!(ROWS.iter().filter(default).count() >= 4, "{case}");
    }
}

#[test]
fn the_printed_form_loses_its_digits_where_it_should() {
    for (case, formula) in [
        ("r_B r_T near 1", "(14)"),
        ("r_B r_T near 1", "1-1 motion"),
        ("T_1 near r_T T_2", "(15)"),
        ("r_B near 0", "(16)"),
        ("slow impact", "(20)"),
        ("slow impact", "(21)"),
        ("slow impact", "(22)"),
        ("slow impact", "(23)"),
        ("slow impact", "Det of (20) (21)"),
        ("multipliers far apart", "(19) smaller"),
        ("Delta near 0", "(19) imaginary"),
        ("short flight", "(4)"),
        ("late time", "f"),
        ("phase at its wrap", "F_1"),
        ("tiny and huge impacts", "(5)-(6)"),
        ("d near 0", "1-1 motion"),
    ] {
        let rows: Vec<_> = ROWS.iter().filter(|row| row.case == case).collect();
        // Two that double-double saves: T_1 is 1 + 9e-17 there, so that (15) has no denominator in f64 and one of 2e-16 in
        // double-double; and of numbers of f64 the square Tr² and the product 4 Det are exact in it.
        let is_saved =
            [("r_B r_T near 1", "1-1 motion"), ("Delta near 0", "(19) imaginary")].contains(&(case, formula));
        let numbers = ["f32", "f64", "double-double"];
        for number in &numbers[..if is_saved { 2 } else { 3 }] {
            let least = |form| {
                let own = rows.iter().filter(|row| row.formula == formula && row.form == form);
                let digits = own.filter(|row| row.number == *number).map(|row| row.digits);
                digits.fold(f64::INFINITY, f64::min)
            };
            // f32 cannot hold how near 1 a number is, whatever the form
            let most = match *number {
                "f32" => 7.2 - 2.0,
                "f64" => 15.9 - 10.0,
                _ => 31.9 - 10.0,
            };
            let printed = least(Form::Printed);
            assert!(printed < most, "{case} {formula} {number}: {printed} digits printed");
        }
    }
}

#[test]
fn the_longest_motions_keep_their_digits_by_phase_and_lose_them_by_time() {
    let [rows, longer] = ["a million impacts", "a billion impacts"].map(rows);
    let digits = |form, number: &str| {
        let row = rows.iter().find(|row| row.form == form && row.number == number);
        row.map_or(f64::NAN, |row| row.digits)
    };
    assert!(digits(Form::Stable, "f64") > 14.0);
    assert!(digits(Form::Printed, "f64") < 11.0);
    assert!(digits(Form::Stable, "f32") > 5.5);
    assert!(digits(Form::Printed, "f32") < 2.0);
    assert_eq!(longer.len(), 2);
    for row in &longer {
        let again = rows
            .iter()
            .find(|other| (other.form, &other.number) == (row.form, &row.number));
        assert!(again.is_some_and(|other| row.digits > other.digits - 0.5), "{row:?}");
    }
}

#[test]
fn nonsense_is_refused_in_words() {
    for case in ["NaN", "infinite input"] {
        for row in rows(case) {
            assert_eq!(row.form, Form::Refused, "{row:#?}");
            assert!(!row.answer.is_empty());
        }
    }
}

#[test]
fn a_case_that_is_none_is_an_error_and_so_are_frozen_points_of_none() {
    let found = stress(Some("no such case"), WORST);
    assert!(matches!(found, Err(StressError::NoCase(_))), "{found:?}");
    let header = "case,formula,number,form,digits,at\n";
    let elsewhere = format!("{header}late time,f,f64,stable,15.9,time=1.5\n");
    let found = stress(Some("late time"), &elsewhere);
    assert!(matches!(found, Err(StressError::Frozen { .. })), "{found:?}");
}

#[test]
fn a_search_finds_points_that_can_be_frozen_and_the_same_ones_again() {
    let found = search(0.5).unwrap();
    assert!(!found.is_empty() && !found.iter().any(StressRow::is_below_bar));
    let frozen = frozen_text(&found).unwrap();
    let again = stress(Some("late time"), &frozen).unwrap();
    let held: Vec<_> = again.iter().filter(|row| row.frozen.is_some()).collect();
    assert!(!held.is_empty());
    for row in held {
        assert!((row.digits - row.frozen.unwrap_or(f64::NAN)).abs() < 0.006, "{row:#?}");
    }
}

#[test]
fn the_command_prints_the_columns_and_succeeds() {
    let scratch = scratch("columns");
    let text = scratch.run(&["stress", "late", "--format", "csv"]).succeeded();
    assert!(
        text.starts_with("case,formula,number,form,digits,condition,at,"),
        "{text}"
    );
    assert!(
        text.lines()
            .any(|line| line.starts_with("late time,f,double-double,stable,")),
        "{text}"
    );
    scratch.run(&["stress", "late", "--format", "json"]).succeeded();
}

#[test]
fn a_curve_is_printed_with_its_distances_and_drawn() {
    let scratch = scratch("curve");
    let arguments = ["stress", "--curve", "Delta", "--format", "csv", "--plot", "delta.svg"];
    let text = scratch.run(&arguments).succeeded();
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("extreme,distance,formula,number,form,digits,condition,at,allowed")
    );
    // half decades from 1e-1 to 1e-14, of two formulas, in four numbers and two forms
    assert_eq!(lines.clone().count(), 27 * 2 * 4 * 2);
    assert!(lines.all(|line| line.starts_with("Delta to 0,") && line.contains("Tr=")));
    let svg = scratch.read("delta.svg");
    for words in ["f64 printed", "f64 stable", "f64 allowed", "\u{394}</tspan> to 0"] {
        assert!(svg.contains(words), "{words}");
    }
    // a reader at a terminal has the rows of f64 alone
    let text = scratch.run(&["stress", "--curve", "Delta"]).stdout;
    assert!(text.contains(" f64 ") && !text.contains("double-double"), "{text}");
}

#[test]
fn the_command_fails_when_a_frozen_digit_is_lost() {
    let scratch = scratch("lost");
    let at = |digits: f64| format!("case,formula,number,form,digits,at\nlate time,f,f32,stable,{digits},t=1.25\n");
    for (digits, status) in [(5.0, 0), (20.0, 1)] {
        scratch.file("worst.csv", at(digits));
        let ran = scratch.run(&["stress", "late", "--frozen", "worst.csv"]);
        assert_eq!(ran.status, Some(status), "{ran:?}");
        let message = ran.stderr;
        assert_eq!(
            message.contains("a digit is lost, 20 before: late time, f, f32, stable"),
            status == 1,
            "{message}"
        );
    }
}

#[test]
fn what_is_no_search_and_what_is_not_there_is_refused() {
    let scratch = scratch("refused");
    for (arguments, words) in [
        (&["stress", "--bless"][..], "--search"),
        (&["stress", "--search", "0"], "above 0"),
        (&["stress", "--search", "soon"], "number of seconds"),
        (&["stress", "--search", "0.1", "--bless"], "golden/stress/worst.csv"),
        (&["stress", "nowhere"], "nowhere"),
        (&["stress", "--frozen", "none.csv"], "none.csv"),
        (&["stress", "--curve", "nowhere"], "there are Delta to 0, r to 1, "),
        (&["stress", "--curve", "--search", "1"], "cannot be used with"),
        (&["stress", "--curve", "--frozen", "none.csv"], "cannot be used with"),
        (
            &["stress", "--curve", "--search", "1", "--bless"],
            "cannot be used with",
        ),
        (&["stress", "--plot", "delta.svg"], "--curve"),
    ] {
        let ran = scratch.run(arguments);
        let message = ran.stderr;
        assert_eq!(ran.status, Some(2), "{arguments:?}: {message}");
        assert!(message.contains(words), "{arguments:?}: {message}");
    }
}
