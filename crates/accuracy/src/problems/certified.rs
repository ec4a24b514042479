//! Problems with answers of 30 digits: computed by one means, confirmed by another, or not there at all.

use super::problem::{Kind, Problem};
use super::values::{Number, Values, digits, is_phase};
use super::{Why, jacobians, list, orbits, runs, voltages};
use numbers::Field;
use rayon::prelude::*;
use scenes::reference::FIGURES;

/// A problem that has no certified answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("problem {problem} is not certified: {why}")]
pub struct ProblemError {
    /// The problem.
    pub problem: String,
    /// Why not.
    pub why: Why,
}

/// A quantity and its certified value.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Its name, such as `velocity_1`.
    pub quantity: String,
    /// 30 significant digits.
    pub text: String,
    /// The value of the text.
    pub value: Number,
}

/// A problem with its answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Certified {
    /// What is asked.
    pub problem: Problem,
    /// Every quantity that is asked for, in order.
    pub answers: Vec<Answer>,
    /// The two means.
    pub means: [&'static str; 2],
}

/// Digits to which the two means have to agree: those of the answer and one to spare.
const AGREED: f64 = FIGURES as f64 + 1.5;

/// The answers of a problem.
///
/// # Errors
/// One of the means fails, or they do not agree to more digits than are told.
pub fn certified(problem: &Problem) -> Result<Certified, ProblemError> {
    let failed = |why| ProblemError {
        problem: problem.name.to_owned(),
        why,
    };
    let (both, means) = match problem.kind {
        Kind::Orbit => (orbits::both(problem), orbits::MEANS),
        Kind::Impact | Kind::Run if problem.impacts.is_some() => (runs::both(problem), runs::MEANS),
        Kind::Impact | Kind::Run => (runs::both(problem), runs::MEANS_TO_REST),
        Kind::Jacobian => (jacobians::both(problem), jacobians::MEANS),
        Kind::Voltage => (voltages::both(problem), voltages::MEANS),
    };
    let answers = both
        .and_then(|[first, second]| agreed(first, &second))
        .map_err(failed)?;
    Ok(Certified {
        problem: *problem,
        answers,
        means,
    })
}

/// The problems that are `wanted`, with their answers, on every core.
///
/// # Errors
/// The first that is not certified.
pub fn all(wanted: impl Fn(&Problem) -> bool) -> Result<Vec<Certified>, ProblemError> {
    let problems: Vec<Problem> = list().into_iter().filter(wanted).collect();
    problems.par_iter().map(certified).collect()
}

fn agreed(first: Values<Number>, second: &Values<Number>) -> Result<Vec<Answer>, Why> {
    if first.0.len() != second.0.len() {
        return Err(Why::Unlike);
    }
    let mut answers = Vec::new();
    for ((quantity, value), (name, again)) in first.0.into_iter().zip(&second.0) {
        if quantity != *name {
            return Err(Why::Unlike);
        }
        let agreed = digits(&quantity, again, &value, 2.0 * AGREED);
        if value == Number::from_integer(0) && !is_phase(&quantity) {
            return Err(Why::Zero(quantity));
        }
        if agreed < AGREED {
            return Err(Why::Apart {
                quantity,
                digits: agreed,
            });
        }
        let text = value.to_decimal(FIGURES.unsigned_abs() as usize);
        let value = Number::parse(&text).unwrap_or(Number::INVALID);
        answers.push(Answer { quantity, text, value });
    }
    Ok(answers)
}
