//! Witnesses of the paper's claims, and of claims made from them at random.

use proptest::prelude::*;
use vibro_audit::claim::{Role, Sheet, Verdict, read_symbols};
use vibro_audit::evidence::{Evidence, Flown, witness};

const SYMBOLS: &str = include_str!("../golden/paper/symbols.toml");
const EQUATIONS: &str = include_str!("../golden/paper/equations.toml");

fn read(text: &str) -> Sheet {
    let vocabulary = read_symbols(SYMBOLS).unwrap();
    Sheet::read(text, &vocabulary).unwrap()
}

fn claims(sheet: &Sheet) -> Vec<usize> {
    (0..sheet.entries.len())
        .filter(|&n| sheet.entries[n].role == Role::Claim)
        .collect()
}

fn evidence(sheet: &Sheet, position: usize, verdict: Verdict) -> Evidence {
    witness(sheet, position, verdict, 6).unwrap()
}

#[test]
fn premises_hold_at_every_point() {
    let sheet = read(EQUATIONS);
    for position in claims(&sheet) {
        let found = evidence(&sheet, position, sheet.entries[position].expect);
        assert_eq!(found.points, 6, "{}", sheet.entries[position].label);
        assert!(
            found.residual < Some(1e-12),
            "{} {found:?}",
            sheet.entries[position].label
        );
    }
}

#[test]
fn derivatives_are_those_of_the_maps_by_duals_and_by_differences() {
    let sheet = read(EQUATIONS);
    for label in ["20", "21", "22", "23"] {
        let position = sheet.find(label).unwrap();
        let flown = evidence(&sheet, position, sheet.entries[position].expect)
            .flown
            .unwrap();
        assert!(flown.points >= 3, "{label} {flown:?}");
        assert!(flown.duals > 12.0 && flown.products > 12.0, "{label} {flown:?}");
        // Differences lose digits towards grazing, up to some four at these points.
        let [second, fourth] = Flown::reach();
        assert!(
            flown.second > second - 4.0 && flown.fourth > fourth - 5.0,
            "{label} {flown:?}"
        );
    }
}

#[test]
fn the_same_points_every_time() {
    let sheet = read(EQUATIONS);
    let position = sheet.find("22").unwrap();
    let [first, second] = [(), ()].map(|()| evidence(&sheet, position, Verdict::Refuted));
    assert_eq!(first, second);
}

/// The paper's sheet with another right side for one claim.
fn with_right_side(label: &str, change: impl Fn(&str) -> String) -> String {
    let start = EQUATIONS.find(&format!("label = \"{label}\"\n")).unwrap();
    let tex = start + EQUATIONS[start..].find("'''").unwrap() + 3;
    let end = tex + EQUATIONS[tex..].find("'''").unwrap();
    let (left, right) = EQUATIONS[tex..end]
        .trim_end_matches(['.', ','])
        .split_once('=')
        .unwrap();
    format!("{}{left} = {}{}", &EQUATIONS[..tex], change(right), &EQUATIONS[end..])
}

const DECIDED: [&str; 8] = ["3", "4", "9", "11", "14", "15", "23", "impact-law"];

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn a_claim_rewritten_keeps_its_digits(which in 0..DECIDED.len(), above in 1..99, below in 1..99) {
        let label = DECIDED[which];
        let sheet = read(&with_right_side(label, |right| {
            format!(r"\frac{{{below}}}{{{above}}} \left({right} + r_B - \frac{{r_B^2}}{{r_B}}\right) \cdot \frac{{{above}}}{{{below}}}")
        }));
        let found = evidence(&sheet, sheet.find(label).unwrap(), Verdict::Proved);
        prop_assert_eq!(&found.against, &None, "{}", label);
        prop_assert!(found.digits > Some(10.0), "{} {:?}", label, found);
    }

    #[test]
    fn a_claim_bent_a_little_is_contradicted(which in 0..DECIDED.len(), power in 2_u32..6) {
        let label = DECIDED[which];
        let bent = 10_i64.pow(power);
        let sheet = read(&with_right_side(label, |right| format!(r"({right}) \frac{{{}}}{{{bent}}}", bent + 1)));
        let found = evidence(&sheet, sheet.find(label).unwrap(), Verdict::Proved);
        prop_assert!(found.against.is_some(), "{} {:?}", label, found);
        let found = evidence(&sheet, sheet.find(label).unwrap(), Verdict::Refuted);
        prop_assert_eq!(&found.against, &None, "{}", label);
    }
}

/// Run alone in a release build: what the paper's claims cost.
#[test]
#[ignore = "measures time"]
fn cost_of_the_paper() {
    let sheet = read(EQUATIONS);
    let mut total = 0.0;
    for position in claims(&sheet) {
        let start = std::time::Instant::now();
        let found = evidence(&sheet, position, sheet.entries[position].expect);
        let seconds = start.elapsed().as_secs_f64();
        total += seconds;
        let label = &sheet.entries[position].label;
        println!(
            "{label:12} {:5.1} {:5.1} digits, {:6.0} us",
            found.digits.unwrap(),
            found.median.unwrap(),
            seconds * 1e6
        );
    }
    println!("all of them: {:.1} ms", total * 1e3);
}
