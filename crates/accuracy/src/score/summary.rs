//! Worst and median: of each kind and level, and of each tolerance.

use super::rating::Rating;
use crate::problems::{Kind, Level};
use crate::trade::quantile;

/// What the quantities of one kind and level come to.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The kind.
    pub kind: Kind,
    /// The level.
    pub level: Level,
    /// What they come to.
    pub precision: Precision,
}

/// What quantities come to.
#[derive(Clone, Debug, PartialEq)]
pub struct Precision {
    /// How many are asked for.
    pub quantities: usize,
    /// How many of them are answered.
    pub answered: usize,
    /// The least digits of those answered; none where none is.
    pub worst: Option<f64>,
    /// The digits of half of those answered.
    pub median: Option<f64>,
    /// The times of the problems, where they are told, summed; s.
    pub seconds: Option<f64>,
}

impl Precision {
    /// What these come to.
    pub fn of<'a>(ratings: impl IntoIterator<Item = &'a Rating>) -> Self {
        let ratings: Vec<&Rating> = ratings.into_iter().collect();
        let digits: Vec<f64> = ratings.iter().filter_map(|rating| rating.digits).collect();
        let part = |part: f64| (!digits.is_empty()).then(|| quantile(&digits, part));
        let mut times: Vec<(&str, f64)> = Vec::new();
        for rating in &ratings {
            let is_new = times.last().is_none_or(|(problem, _)| *problem != rating.problem);
            times.extend(
                rating
                    .seconds
                    .filter(|_| is_new)
                    .map(|seconds| (rating.problem, seconds)),
            );
        }
        Self {
            quantities: ratings.len(),
            answered: digits.len(),
            worst: part(0.0),
            median: part(0.5),
            seconds: (!times.is_empty()).then(|| times.iter().map(|(_, seconds)| seconds).sum()),
        }
    }
}

/// Every kind and level of which something is asked, in order.
pub fn parts(ratings: &[Rating]) -> Vec<Part> {
    let each = Kind::ALL
        .into_iter()
        .flat_map(|kind| Level::ALL.map(|level| (kind, level)));
    let parts = each.map(|(kind, level)| Part {
        kind,
        level,
        precision: Precision::of(
            ratings
                .iter()
                .filter(|rating| (rating.kind, rating.level) == (kind, level)),
        ),
    });
    parts.filter(|part| part.precision.quantities > 0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rating(problem: &'static str, kind: Kind, digits: Option<f64>, seconds: Option<f64>) -> Rating {
        Rating {
            problem,
            quantity: "time".to_owned(),
            digits,
            seconds,
            kind,
            level: Level::Hard,
        }
    }

    #[test]
    fn worst_and_median_are_of_what_is_answered_and_a_problem_takes_its_time_once() {
        let ratings = [
            rating("a", Kind::Run, Some(3.0), Some(0.5)),
            rating("a", Kind::Run, Some(9.0), Some(0.5)),
            rating("b", Kind::Run, Some(7.0), None),
            rating("c", Kind::Run, None, None),
            rating("d", Kind::Orbit, Some(1.0), Some(2.0)),
        ];
        let parts = parts(&ratings);
        let kinds: Vec<Kind> = parts.iter().map(|part| part.kind).collect();
        assert_eq!(kinds, [Kind::Orbit, Kind::Run]);
        let Precision {
            quantities,
            answered,
            worst,
            median,
            seconds,
        } = parts[1].precision;
        assert_eq!((quantities, answered, worst, median), (4, 3, Some(3.0), Some(7.0)));
        assert_eq!(seconds, Some(0.5));
        assert_eq!(Precision::of(&ratings).seconds, Some(2.5));
    }

    #[test]
    fn of_nothing_answered_nothing_is_said() {
        let none = Precision::of(&[rating("a", Kind::Run, None, None)]);
        assert_eq!((none.worst, none.median, none.seconds), (None, None, None));
    }
}
