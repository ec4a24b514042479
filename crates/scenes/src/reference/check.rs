//! Golden rows, each held against what is computed.

use super::outcome::{Outcome, unexpected};
use super::request::{Answer, Asked, Request};
use super::{Certified, Comparison, Fault, Printed, Verdict, amplitude, compare};

/// Holds every row against what `answer` computes: printed ones first, each in the order of its file; `step` is called after each.
/// Also returns the rows that cannot be compared, by file and line: no answer, no row or several rows meant, a number
/// against a word.
pub fn check(
    printed: &[Printed],
    certified: &[Certified],
    answer: &mut Answer<'_>,
    step: &mut dyn FnMut(),
) -> (Vec<Outcome>, Vec<Fault>) {
    let mut forward = |request: &Request| answer(request);
    let mut asked = Asked::new(&mut forward);
    let (mut outcomes, mut faults) = (Vec::new(), Vec::new());
    let mut take = |found: Result<Outcome, Fault>| {
        match found {
            Ok(outcome) => outcomes.push(outcome),
            Err(fault) => faults.push(fault),
        }
        step();
    };
    for row in printed {
        take(of_printed(row, printed, &mut asked));
    }
    for row in certified {
        take(row.hold(&mut asked));
    }
    (outcomes, faults)
}

/// Holds one of the printed rows alone.
///
/// # Errors
/// As [`check`].
pub fn check_row(row: &Printed, printed: &[Printed], answer: &mut Answer<'_>) -> Result<Outcome, Fault> {
    of_printed(row, printed, &mut Asked::new(answer))
}

fn of_printed(row: &Printed, rows: &[Printed], asked: &mut Asked<'_>) -> Result<Outcome, Fault> {
    let (computed, note, comparison, picked) = match &row.quantity {
        None => {
            let comparison = Comparison {
                verdict: Verdict::Undetermined,
                digits: None,
                reason: row.record.field("note").to_owned(),
            };
            (String::new(), String::new(), comparison, String::new())
        }
        Some(quantity) => {
            let inferred;
            let table = if quantity.command == amplitude::COMMAND {
                inferred = amplitude::infer(row, rows, asked)?;
                &inferred
            } else {
                asked.ask(&Request::new(&quantity.command, &row.record, &row.setting), &row.record)?
            };
            let value = table
                .value(quantity, &row.setting)
                .map_err(|message| row.record.fault("quantity", message))?;
            let comparison = compare(row.printed(), &value).map_err(|message| row.record.fault("printed", message))?;
            let distances = table
                .distances(&row.setting)
                .map_err(|message| row.record.fault("set", message))?;
            let picked = table.picked(quantity, &row.setting);
            (value.text, joined([distances, table.note.clone()]), comparison, picked)
        }
    };
    let mut outcome = Outcome {
        id: row.id().to_owned(),
        place: row.record.field("place").to_owned(),
        printed: row.printed().to_owned(),
        computed,
        digits: comparison.digits,
        verdict: comparison.verdict,
        expected: row.expected,
        rests_on: row.record.field("rests_on").to_owned(),
        reason: joined([comparison.reason, note]),
        picked,
    };
    if !outcome.is_expected() {
        outcome.reason = unexpected(&outcome);
    } else if row.quantity.is_some() && !outcome.reason.is_empty() {
        // What is known about a value that is not reproduced explains it only while it is as expected.
        outcome.reason = joined([outcome.reason, row.record.field("note").to_owned()]);
    }
    Ok(outcome)
}

fn joined(parts: [String; 2]) -> String {
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::super::printed::COLUMNS;
    use super::super::{Computed, certified};
    use super::*;

    fn rows(lines: &[&str]) -> Vec<Printed> {
        Printed::read("printed.csv", &format!("{}\n{}\n", COLUMNS.join(","), lines.join("\n"))).unwrap()
    }

    /// One stable orbit, whatever is asked for.
    fn orbits(request: &Request) -> Result<Computed, String> {
        if request.command != "orbits" {
            return Err(format!("there is no command {}", request.command));
        }
        let text = |fields: &[&str]| fields.iter().map(|&field| field.to_owned()).collect::<Vec<_>>();
        Ok(Computed {
            columns: text(&["word", "velocities", "kind", "error_bound"]),
            rows: vec![text(&["BTT", "0.7017134314;-0.555471663", "focus", "1e-12"])],
            note: String::new(),
            swept: None,
        })
    }

    fn outcomes(lines: &[&str]) -> Result<Vec<Outcome>, String> {
        let (outcomes, faults) = check(&rows(lines), &[], &mut orbits, &mut || ());
        faults.first().map_or(Ok(outcomes), |fault| Err(fault.to_string()))
    }

    #[test]
    fn each_row_gets_its_verdict_and_a_reason_to_act_on() {
        let found = outcomes(&[
            "a,Fig. 3,s,,orbits.velocities[0],0.701752,,wrong,,",
            "b,Fig. 3,s,,orbits.velocities[1],-0.555468,,reproduced,,",
            "c,Fig. 3,s,,orbits.word,BTT,,reproduced,,",
            "d,Fig. 3,s,,,any,,undetermined,,the paper names no start",
        ])
        .unwrap();
        let verdicts: Vec<(Verdict, bool)> = found.iter().map(|row| (row.verdict, row.is_expected())).collect();
        let expected = [
            (Verdict::Wrong, true),
            (Verdict::Rounded, false),
            (Verdict::Reproduced, true),
            (Verdict::Undetermined, true),
        ];
        assert_eq!(verdicts, expected);
        assert!(
            found[0].reason.starts_with("differs from the 5th figure on"),
            "{}",
            found[0].reason
        );
        assert!(
            found[1]
                .reason
                .starts_with("EXPECTED reproduced, IS rounded: right but for the last figure"),
            "{}",
            found[1].reason
        );
        assert_eq!(found[3].reason, "the paper names no start");
    }

    #[test]
    fn a_row_that_cannot_be_compared_is_named() {
        for (line, words) in [
            (
                "a,p,s,,orbits.kind,0.5,,wrong,,",
                "line 2, column `printed`: `0.5` is a number, and what is computed is a word: focus",
            ),
            (
                "a,p,s,,orbits.velocities[0],abc,,wrong,,",
                "column `printed`: `abc` is not a number",
            ),
            (
                "a,p,s,,orbits.speed,1,,wrong,,",
                "column `quantity`: there is no column `speed`",
            ),
            (
                "a,p,s,row.word=BT,orbits.word,BT,,wrong,,",
                "no row is meant; there are: kind=focus word=BTT",
            ),
            ("a,p,s,,sail.d,1,,wrong,,", "line 2: there is no command sail"),
        ] {
            let found = outcomes(&[line]).unwrap_err();
            assert!(found.contains(words), "{line}: {found}");
        }
    }

    #[test]
    fn a_request_is_answered_once() {
        let mut asked = 0;
        let mut counted = |request: &Request| {
            asked += 1;
            orbits(request)
        };
        let rows = rows(&[
            "a,p,s,,orbits.velocities[0],1,,wrong,,",
            "b,p,s,,orbits.velocities[1],1,,wrong,,",
            "c,p,s,motion.d=1,orbits.velocities[1],1,,wrong,,",
        ]);
        assert!(check(&rows, &[], &mut counted, &mut || ()).1.is_empty());
        assert_eq!(asked, 2);
    }

    #[test]
    fn a_certified_value_is_held_too_and_an_empty_one_is_to_be_blessed() {
        let read = |value: &str| {
            let text = format!(
                "{}\na,s,,orbits.velocities[0],{value},curve,Newton\n",
                certified::COLUMNS.join(",")
            );
            Certified::read("reference/orbits.csv", &text).unwrap()
        };
        let found = |value: &str| {
            let (outcomes, faults) = check(&[], &read(value), &mut orbits, &mut || ());
            let verdict = outcomes.first().map(|outcome| outcome.verdict);
            verdict.ok_or_else(|| faults[0].to_string())
        };
        assert_eq!(found("0.701713431400000000000000000000"), Ok(Verdict::Reproduced));
        assert_eq!(found("0.701713441400000000000000000000"), Ok(Verdict::Wrong));
        assert!(found("").is_err_and(|fault| fault.contains("--bless")));
    }
}
