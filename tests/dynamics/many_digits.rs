//! Motions and bifurcations to many digits: by two means, at two precisions, and held by the references.

use crate::common::program::run;
use proptest::prelude::*;
use vibro_audit::model::Motion;
use vibro_audit::number::{Analytic, Decimal, Decimals, Interval, Rung, Wide};
use vibro_audit::orbit::{OutputPrecision, Parameters, Word, confirm_orbit, find_as};
use vibro_audit::reference::{Certified, Directory};

type Number = Wide<100>;

fn number(decimal: &Decimal) -> Number {
    Number::parse(decimal.as_str()).expect("a number")
}

/// Whether two decimals agree to so many figures.
fn agree(one: &Decimal, other: &Decimal, figures: i32) -> bool {
    let (one, other) = (number(one), number(other));
    let apart = (one.clone() - other).to_f64().abs();
    apart <= one.to_f64().abs() * 10_f64.powi(-figures)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn both_means_give_thirty_digits_of_every_motion(
        g in -0.5..0.5_f64, d in 0.05..1.2_f64, r_b in 0.2..0.95_f64, r_t in 0.2..0.95_f64, long in 0..3_usize,
    ) {
        let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
        let word: Word = ["BT", "BTT", "BBT"][long].parse().expect("a word");
        let decimals = Decimals(40);
        let found = find_as(&OutputPrecision::decimals(decimals, Rung::DoubleDouble), &motion, &word, 1).expect("a search");
        for orbit in found.orbits.iter().filter(|orbit| orbit.error_bound.is_some()) {
            let again = confirm_orbit(&motion, orbit, decimals).expect("a return");
            let lists = [(&orbit.phases, &again.phases), (&orbit.velocities, &again.velocities), (&orbit.times, &again.times)];
            for (one, other) in lists.into_iter().flat_map(|(one, other)| one.iter().zip(other)) {
                prop_assert!(agree(one, other, 30), "{one} {other}");
            }
            prop_assert!(agree(&orbit.trace, &again.trace, 30), "{} {}", orbit.trace, again.trace);
            prop_assert!(agree(&orbit.determinant, &again.determinant, 30));
        }
    }
}

/// The columns of the only row.
fn row(digits: &str) -> Vec<(String, Vec<String>)> {
    let text = run(&["orbits", "fig02", "--digits", digits, "--format", "csv"]).succeeded();
    let mut lines = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let (names, fields) = (lines.next().expect("a header"), lines.next().expect("a row"));
    assert_eq!(lines.next(), None);
    let lists = fields.iter().map(|field| field.split(';').map(str::to_owned).collect());
    names.into_iter().zip(lists).collect()
}

#[test]
fn forty_digits_are_sixty_rounded_to_a_figure_more() {
    let (forty, sixty) = (row("40"), row("60"));
    for ((name, shorter), (_, longer)) in forty.iter().zip(&sixty) {
        if name == "error_bound" {
            assert!(shorter[0].parse::<f64>().expect("a bound") < 1e-39);
            assert!(longer[0].parse::<f64>().expect("a bound") < 1e-59);
            continue;
        }
        if name == "number" {
            assert_eq!([&shorter[0], &longer[0]], ["50-digits", "100-digits"]);
            continue;
        }
        for (shorter, longer) in shorter.iter().zip(longer) {
            // words and counts stay
            let number = Number::parse(longer).filter(|_| longer.contains('.'));
            let rounded = number.map_or_else(|| longer.clone(), |number| number.to_decimal(41));
            assert_eq!(*shorter, rounded, "{name}");
        }
    }
    let figures = |text: &str| {
        text.chars()
            .filter(char::is_ascii_digit)
            .skip_while(|c| *c == '0')
            .count()
    };
    assert!(
        forty
            .iter()
            .any(|(name, list)| name == "velocities" && list.iter().all(|v| figures(v) == 41))
    );
}

#[test]
fn in_json_every_digit_reads_back() {
    let text = run(&["orbits", "fig02", "--digits", "40", "--format", "json"]).succeeded();
    let rows: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let velocity = rows[0]["velocities"][0].as_str().expect("a string");
    assert!(
        velocity.starts_with("0.677448503699313294209038777866834"),
        "{velocity}"
    );
}

#[test]
fn more_digits_than_there_are_are_refused() {
    let ran = run(&["orbits", "fig02", "--digits", "2000"]);
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("ask for at most 195"));
}

#[test]
fn a_proved_bound_holds_against_twice_the_digits() {
    let motion = Motion::new(0.12201, 0.26, 0.6, 0.3).expect("a motion");
    let decimals = |figures| {
        let found = find_as(
            &OutputPrecision::decimals(Decimals(figures), Rung::DoubleDouble),
            &motion,
            &"BTT".parse().expect("a word"),
            1,
        )
        .expect("a search");
        found.orbits.into_iter().next().expect("a motion")
    };
    let (few, many) = (decimals(25), decimals(90));
    let bound = number(few.error_bound.as_ref().expect("a bound"));
    for (one, other) in few.velocities.iter().zip(&many.velocities) {
        let apart = number(one) - number(other);
        assert!(apart <= bound && -apart <= bound);
    }
    let wide: Motion<Interval<Number>> = motion.motion().expect("a motion");
    assert!(wide.d().contains(&Number::from_f64(0.26)));
}

#[test]
fn the_paper_has_forty_references_and_more_each_confirmed() {
    let rows = Directory::BuiltIn.certified().expect("references");
    assert!(rows.len() >= 40, "{}", rows.len());
    let confirmed = |row: &Certified| row.record.field("by") != row.record.field("confirmed_by");
    assert!(rows.iter().all(confirmed));
}
