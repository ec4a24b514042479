//! Which number reaches the digits asked at the least cost: a model of digits and operations, the same on every machine.
//!
//! A narrower number costs a fraction of the next one, and what it falls short by is seen on the answer itself. So the
//! narrowest number that has reached the digits in any of the problems measured is tried first; where its bound is too
//! wide, the next one is taken. Seconds play no part.

use crate::number::Rung;

/// The model: written by [`measured_costs`](super::measured_costs()), which a test holds it against.
pub const COSTS: &str = include_str!("../../golden/accuracy/costs.csv");

/// What is to be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Purpose {
    /// A periodic motion or a bifurcation, with a proof and its bound.
    Orbit,
    /// The impacts of a motion, with the growth of their errors.
    Impact,
}

impl Purpose {
    /// As the model has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit",
            Self::Impact => "impact",
        }
    }
}

/// A row of the model.
#[derive(Clone, Debug, PartialEq, serde::Deserialize, serde::Serialize)]
pub struct Cost {
    /// The purpose.
    pub task: String,
    /// The means.
    pub method: String,
    /// The number.
    pub number: String,
    /// The digits of the bound at the worst problem measured.
    pub worst_digits: f64,
    /// At half of the problems.
    pub median_digits: f64,
    /// At the best one: more are not tried for.
    pub best_digits: f64,
    /// Mean count of operations of one answer, functions among them.
    pub operations: u64,
    /// Pairs of sine and cosine among them.
    pub sincos: u64,
    /// Divisions among them.
    pub divisions: u64,
    /// Their cost in instructions, by `golden/accuracy/weights.csv`.
    pub cost: u64,
}

/// A model that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ChoiceError {
    /// No table.
    #[error("golden/accuracy/costs.csv: {0}")]
    Table(#[from] csv::Error),
    /// A number type that is none.
    #[error("golden/accuracy/costs.csv: there is no number {0}")]
    Number(String),
}

/// The rows of a model.
///
/// # Errors
/// What is no such table.
pub fn costs(text: &str) -> Result<Vec<Cost>, ChoiceError> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    Ok(reader.deserialize().collect::<Result<Vec<Cost>, _>>()?)
}

/// The number to begin with where so many digits are asked: the cheapest one that has reached them, or the widest.
///
/// # Errors
/// A model that cannot be read; the one in the program can be.
pub fn cheapest(purpose: Purpose, digits: u32) -> Result<Rung, ChoiceError> {
    cheapest_of(&costs(COSTS)?, purpose, digits)
}

fn cheapest_of(costs: &[Cost], purpose: Purpose, digits: u32) -> Result<Rung, ChoiceError> {
    let reaching = costs
        .iter()
        .filter(|cost| cost.task == purpose.name() && cost.best_digits >= f64::from(digits));
    let Some(cost) = reaching.min_by_key(|cost| cost.cost) else {
        return Ok(Rung::ALL[Rung::ALL.len() - 1]);
    };
    Rung::named(&cost.number).ok_or_else(|| ChoiceError::Number(cost.number.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_cheaper_number_that_reaches_the_digits_is_taken_and_none_that_does_not() {
        let model = "task,method,number,worst_digits,median_digits,best_digits,operations,sincos,divisions,cost\n\
                     orbit,certified,f64,9,12,14,100,2,3,1000\n\
                     orbit,certified,double-double,25,28,30,100,2,3,9000\n\
                     impact,own,50-digits,9,55,58,1,1,1,5\n";
        let costs = costs(model).expect("a model");
        let chosen = |digits| cheapest_of(&costs, Purpose::Orbit, digits).expect("a number");
        assert_eq!(
            [14, 15, 30].map(chosen),
            [Rung::Double, Rung::DoubleDouble, Rung::DoubleDouble]
        );
        assert_eq!(chosen(31), Rung::Wide(200), "what none has reached goes to the widest");
    }

    #[test]
    fn a_model_that_is_none_is_an_error() {
        assert!(costs("task,number\norbit,f64\n").is_err());
        let text = COSTS.replace("double-double", "quadruple");
        let costs = costs(&text).expect("a table");
        assert!((1..60).any(|digits| cheapest_of(&costs, Purpose::Orbit, digits).is_err()));
    }

    proptest! {
        #[test]
        fn more_digits_are_never_cheaper(digits in 1_u32..195, more in 0_u32..50) {
            for purpose in [Purpose::Orbit, Purpose::Impact] {
                let [few, many] = [digits, digits + more].map(|digits| cheapest(purpose, digits).expect("a number"));
                prop_assert!(few <= many);
            }
        }
    }
}
