//! Claims of textbooks on integrals, limits and sums, half of them with a slip of the pen (`tests/textbook`): none is decided
//! wrongly, and most are decided.

use crate::common::sample;
use vibro_audit::claim::{Role, Sheet, Verdict};
use vibro_audit::prove::{self, Options};
use vibro_audit::tex::Symbols;

/// Checks a sheet, of which at least so many claims are decided as they are expected to be, of all and of the sample.
fn holds(text: &str, [all, sampled]: [usize; 2]) {
    let sheet = Sheet::read(text, &Symbols::default()).unwrap();
    let claims = (0..sheet.entries.len()).filter(|&position| {
        let entry = &sheet.entries[position];
        entry.role == Role::Claim && sample::takes(&entry.label, 4)
    });
    let (mut count, mut decided) = (0, 0);
    for position in claims {
        let entry = &sheet.entries[position];
        let decision = prove::decide(&sheet, position, &Options::default());
        let is_decided = matches!(decision.verdict, Verdict::Proved | Verdict::Refuted);
        assert!(
            !is_decided || decision.verdict == entry.expect,
            "({}) {}: {:?}, {}",
            entry.label,
            entry.tex.tex,
            decision.verdict,
            decision.reason
        );
        count += 1;
        decided += usize::from(is_decided);
    }
    println!("{decided} of {count} are decided");
    assert!(decided >= sample::of(all, sampled), "{decided} of {count} are decided");
}

#[test]
fn no_integral_of_a_textbook_is_decided_wrongly_and_most_are_decided() {
    holds(include_str!("../textbook/integrals.toml"), [285, 78]);
}

#[test]
fn no_limit_of_a_textbook_is_decided_wrongly_and_most_are_decided() {
    holds(include_str!("../textbook/limits.toml"), [160, 52]);
}

#[test]
fn no_sum_of_a_textbook_is_decided_wrongly_and_most_are_decided() {
    holds(include_str!("../textbook/sums.toml"), [156, 47]);
}
