//! A row of the table: how many digits one form of one formula keeps at one extreme point.

use crate::trade::digits_of;
use numbers::{Analytic, Rung};
use std::fmt::Display;

/// Which form of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// As the paper has it, misprints mended; where it has none, as a first program would.
    Printed,
    /// What this program uses by default.
    Stable,
    /// Nothing: the input was turned down by a typed error, or answered by NaN.
    Refused,
}

impl Form {
    /// The word in the column `form`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Stable => "stable",
            Self::Refused => "refused",
        }
    }

    /// The form of this word.
    pub fn of(name: &str) -> Option<Self> {
        [Self::Printed, Self::Stable, Self::Refused]
            .into_iter()
            .find(|form| form.name() == name)
    }
}

/// What one form keeps at one point in one number type.
#[derive(Clone, Debug, PartialEq)]
pub struct StressRow {
    /// The extreme.
    pub case: String,
    /// The formula, by the paper's number or in words.
    pub formula: String,
    /// `f32`, `f64`, `double-double`, `50-digits`, `decimal 30`.
    pub number: String,
    /// Which form.
    pub form: Form,
    /// -log10 of the relative error, from 0 to what the number holds.
    pub digits: f64,
    /// The relative condition number of the quantity: the most that it changes, relatively, for relative changes of
    /// its inputs that are small and all of one size. It belongs to the point, not to the form. Infinite for what was
    /// refused.
    pub condition: f64,
    /// The point, `key=value;...`: all that is needed to evaluate the row again: inputs, which are numbers of f64, then what a
    /// formula needs that follows from them, as the row's own type has it.
    pub at: String,
    /// The digits that the number type holds, less log10 of the condition.
    pub allowed: f64,
    /// The digits when the worst points were frozen, where this is one.
    pub frozen: Option<f64>,
    /// What was refused, and why.
    pub answer: String,
}

/// Of f64's digits a default form keeps so many, less log10 of the condition.
pub const BAR: f64 = 14.5;

/// A frozen row may have so much less before a digit is lost.
const ONE_DIGIT: f64 = 1.0;

/// What a form made of a formula in a number type.
pub(super) struct Evaluation {
    number: String,
    form: Form,
    digits: f64,
    epsilon: f64,
}

impl Evaluation {
    /// In the number `T`, called `number`, with this relative error.
    pub fn of<T: Analytic>(number: impl Display, form: Form, error: f64) -> Self {
        Self::with(number, T::epsilon().to_f64(), form, error)
    }

    /// In a number of this `epsilon`, called `number`, with this relative error.
    pub fn with(number: impl Display, epsilon: f64, form: Form, error: f64) -> Self {
        Self {
            number: number.to_string(),
            form,
            digits: digits_of(error, epsilon),
            epsilon,
        }
    }
}

impl StressRow {
    /// The names of the columns, in the order of the fields.
    pub const COLUMNS: [&str; 10] = [
        "case",
        "formula",
        "number",
        "form",
        "digits",
        "condition",
        "at",
        "allowed",
        "frozen",
        "answer",
    ];

    /// The row of a default form in f64, by its relative error.
    pub(super) fn stable(case: &str, formula: &str, error: f64, condition: f64, at: String) -> Self {
        let evaluation = Evaluation::of::<f64>(Rung::Double, Form::Stable, error);
        Self::new(case, formula, evaluation, condition, at)
    }

    /// The row of what a number type had no answer to.
    pub(super) fn refused(case: &str, formula: &str, number: impl Display, at: String, answer: String) -> Self {
        let evaluation = Evaluation::with(number, f64::EPSILON, Form::Refused, f64::NAN);
        Self {
            answer,
            ..Self::new(case, formula, evaluation, f64::INFINITY, at)
        }
    }

    /// The row of an evaluation.
    pub(super) fn new(case: &str, formula: &str, evaluation: Evaluation, condition: f64, at: String) -> Self {
        let Evaluation {
            number,
            form,
            digits,
            epsilon,
        } = evaluation;
        Self {
            case: case.to_owned(),
            formula: formula.to_owned(),
            number,
            form,
            digits,
            condition,
            at,
            allowed: allowed(epsilon, condition),
            frozen: None,
            answer: String::new(),
        }
    }

    /// Whether this is a default form that keeps fewer of f64's digits than [`BAR`] less log10 of the condition.
    pub fn is_below_bar(&self) -> bool {
        let kept = self.digits >= BAR - self.condition.log10().max(0.0);
        self.form == Form::Stable && self.number == "f64" && !kept
    }

    /// Whether a digit is gone since the row was frozen.
    pub fn has_lost_a_digit(&self) -> bool {
        self.frozen.is_some_and(|frozen| {
            let kept = self.digits > frozen - ONE_DIGIT;
            !kept
        })
    }
}

/// The digits that a number of this `epsilon` can have of a quantity of this `condition`.
pub(super) fn allowed(epsilon: f64, condition: f64) -> f64 {
    let most = -(0.5 * epsilon).log10();
    // what is no number allows nothing
    (most - condition.max(1.0).log10()).max(0.0)
}

/// The point as the column `at` has it.
pub(super) fn place(names: &[&str], values: &[f64]) -> String {
    let pairs = names
        .iter()
        .zip(values)
        .map(|(name, value)| format!("{name}={value:?}"));
    pairs.collect::<Vec<_>>().join(";")
}

/// The values of `at` for these names, in their order; `None` where it is not exactly these, with or without the
/// derived ones after them.
pub(super) fn values(names: &[&str], derived: &[&str], at: &str) -> Option<Vec<f64>> {
    let pairs: Vec<(&str, &str)> = at.split(';').map(|pair| pair.split_once('=')).collect::<Option<_>>()?;
    let (own, others) = pairs.split_at_checked(names.len())?;
    let keys = |pairs: &[(&str, &str)], names: &[&str]| pairs.iter().map(|(key, _)| *key).eq(names.iter().copied());
    let is_point = keys(own, names) && (others.is_empty() || keys(others, derived));
    is_point.then(|| own.iter().map(|(_, value)| value.parse().ok()).collect())?
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub fn row(form: Form, number: &str, digits: f64, condition: f64) -> StressRow {
        StressRow {
            case: "c".into(),
            formula: "(1)".into(),
            number: number.into(),
            form,
            digits,
            condition,
            at: "x=1.0".into(),
            allowed: allowed(f64::EPSILON, condition),
            frozen: None,
            answer: String::new(),
        }
    }

    #[test]
    fn the_bar_is_for_default_forms_in_f64_and_falls_with_the_condition() {
        assert!(row(Form::Stable, "f64", 14.4, 1.0).is_below_bar());
        assert!(row(Form::Stable, "f64", 14.4, 0.1).is_below_bar());
        assert!(row(Form::Stable, "f64", f64::NAN, 1.0).is_below_bar());
        assert!(!row(Form::Stable, "f64", 14.6, 1.0).is_below_bar());
        assert!(!row(Form::Stable, "f64", 4.6, 1e10).is_below_bar());
        assert!(!row(Form::Stable, "f32", 6.0, 1.0).is_below_bar());
        assert!(!row(Form::Printed, "f64", 1.0, 1.0).is_below_bar());
        assert!(!row(Form::Refused, "f64", 0.0, f64::INFINITY).is_below_bar());
    }

    #[test]
    fn a_digit_is_lost_when_it_is_gone_and_not_by_less() {
        let at = |digits, frozen| {
            let frozen = Some(frozen);
            let row = row(Form::Stable, "f64", digits, 1.0);
            StressRow { frozen, ..row }.has_lost_a_digit()
        };
        assert!(!at(14.1, 15.0) && !at(15.9, 15.0));
        assert!(at(14.0, 15.0) && at(f64::NAN, 15.0));
        assert!(!row(Form::Stable, "f64", 0.0, 1.0).has_lost_a_digit());
    }

    #[test]
    fn a_place_reads_back_to_the_same_values() {
        let (names, numbers) = (["r_B", "t"], [1.0 - 1e-15, 1e-300]);
        let (at, derived) = (place(&names, &numbers), ["g", "d"]);
        for at in [at.clone(), format!("{at};g=0.1;d=0.4")] {
            assert_eq!(values(&names, &derived, &at).as_deref(), Some(&numbers[..]));
        }
        for wrong in ["r_B=1", "r_B=1;t=2;u=3", "r_B=1;t=2;g=3", "t=1;r_B=2", "r_B=1;t=x", ""] {
            assert_eq!(values(&names, &derived, wrong), None, "{wrong}");
        }
    }

    #[test]
    fn conditioning_allows_what_the_number_holds_and_never_less_than_nothing() {
        assert!((allowed(f64::EPSILON, 1.0) - 15.95).abs() < 0.01);
        assert!((allowed(f64::EPSILON, 1e6) - 9.95).abs() < 0.01);
        assert_eq!(allowed(f64::EPSILON, f64::INFINITY), 0.0);
    }
}
