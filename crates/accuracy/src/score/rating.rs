//! The digits of each answer.

use super::answers::Answers;
use crate::problems::{Certified, Kind, Level, digits};
use scenes::reference::FIGURES;

/// One quantity of one problem, rated.
#[derive(Clone, Debug, PartialEq)]
pub struct Rating {
    /// The problem.
    pub problem: &'static str,
    /// The quantity.
    pub quantity: String,
    /// -log10 of the relative error, from 0 to the 30 of the certified answer; of a phase, of the difference around the
    /// circle, rad. None where there is no answer, or it is no number.
    pub digits: Option<f64>,
    /// How long the problem took, all its quantities together, as whoever answered says; s.
    pub seconds: Option<f64>,
    /// The kind of the problem.
    pub kind: Kind,
    /// Its level.
    pub level: Level,
}

/// Every quantity that is asked for, in the order of the problems.
pub fn rate(asked: &[Certified], answers: &Answers) -> Vec<Rating> {
    let mut ratings = Vec::new();
    for Certified {
        problem,
        answers: exact,
        ..
    } in asked
    {
        let given = |quantity: &str| answers.get(problem.name, quantity);
        // a time stands in every row of a problem, or in one
        let times = exact.iter().filter_map(|answer| given(&answer.quantity)?.seconds);
        let seconds = times.reduce(f64::max);
        ratings.extend(exact.iter().map(|answer| {
            Rating {
                problem: problem.name,
                digits: given(&answer.quantity)
                    .and_then(|given| given.value.as_ref())
                    .map(|value| digits(&answer.quantity, value, &answer.value, f64::from(FIGURES))),
                quantity: answer.quantity.clone(),
                seconds,
                kind: problem.kind,
                level: problem.level,
            }
        }));
    }
    ratings
}

/// The least digits of all that is asked, 0 where one has no answer or nothing is asked.
pub fn worst(ratings: &[Rating]) -> f64 {
    let digits = ratings.iter().map(|rating| rating.digits.unwrap_or(0.0));
    digits.reduce(f64::min).unwrap_or(0.0)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::problems::{Answer, Number, list};
    use numbers::{Analytic, Field};
    use proptest::prelude::*;

    /// A problem called `one` that asks for three quantities.
    pub fn known() -> Vec<Certified> {
        let answer = |quantity: &str, text: &str| Answer {
            quantity: quantity.to_owned(),
            text: text.to_owned(),
            value: Number::parse(text).unwrap(),
        };
        let mut problem = list()[0];
        problem.name = "one";
        let answers = vec![
            answer("time", "1.23456789012345678901234567890"),
            answer("velocity", "-0.0000123456789012345678901234567890"),
            answer("phase", "0.000001"),
        ];
        vec![Certified {
            problem,
            answers,
            means: ["one", "another"],
        }]
    }

    fn rated(rows: &[String]) -> Vec<Rating> {
        let text = format!("problem,quantity,answer,seconds\n{}\n", rows.join("\n"));
        rate(&known(), &Answers::read("a.csv", &text, &known()).unwrap())
    }

    proptest! {
        #[test]
        fn an_answer_off_by_ten_to_the_minus_k_has_k_digits(k in 0.1..29.5_f64, sign in prop::bool::ANY, index in 0..2_usize) {
            let exact = &known()[0].answers[index];
            let off = if sign { 10_f64.powf(-k) } else { -10_f64.powf(-k) };
            let value = exact.value.clone() * (Number::from_integer(1) + Number::from_f64(off));
            let row = format!("one,{},{},", exact.quantity, value.to_decimal(45));
            let found = rated(&[row])[index].digits.unwrap();
            prop_assert!((found - k).abs() < 0.01, "{} {}", found, k);
        }

        #[test]
        fn the_order_of_the_rows_does_not_matter(order in Just(vec![0, 1, 2]).prop_shuffle()) {
            let rows = ["one,time,1.2345,0.5", "one,velocity,nan,", "one,phase,6.2831,0.25"].map(str::to_owned);
            let shuffled: Vec<String> = order.iter().map(|index: &usize| rows[*index].clone()).collect();
            prop_assert_eq!(rated(&shuffled), rated(&rows));
        }
    }

    #[test]
    fn what_is_not_answered_has_no_digits_and_what_is_no_number_is_no_answer() {
        for no_number in ["inf", "-Infinity", "nan", "NaN", ""] {
            let ratings = rated(&[format!("one,velocity,{no_number},2"), "one,phase,4,2".to_owned()]);
            let digits: Vec<Option<f64>> = ratings.iter().map(|rating| rating.digits).collect();
            assert_eq!(digits, [None, None, Some(0.0)], "{no_number}");
            assert!(ratings.iter().all(|rating| rating.seconds == Some(2.0)));
        }
        let ratings = rated(&[]);
        assert_eq!((worst(&ratings), worst(&[])), (0.0, 0.0));
    }

    #[test]
    fn the_worst_counts_what_has_no_answer() {
        let rows = ["one,time,1.2345,", "one,velocity,-1.23456e-5,"].map(str::to_owned);
        let ratings = rated(&rows);
        assert_eq!(worst(&ratings), 0.0);
        assert!(worst(&ratings[..2]) > 4.0);
    }
}
