//! A small system of equations, as intervals see it.

use crate::orbit::equations::duals::Linearised;
use crate::orbit::interval_box::IntervalBox;
use numbers::{Endpoint, Interval};

/// `D` equations in `D` unknowns.
pub trait SquareSystem<E: Endpoint, const D: usize> {
    /// Enclosures of all values of the equations over `cell`, and of their derivatives, one row an equation.
    fn linearised(&self, cell: &IntervalBox<E, D>) -> Linearised<Interval<E>, D>;

    /// Enclosures of the values alone.
    fn values(&self, cell: &IntervalBox<E, D>) -> IntervalBox<E, D> {
        self.linearised(cell).0
    }

    /// Whether the cell may hold a solution that is asked for; `false` only where it surely does not.
    fn is_wanted(&self, _cell: &IntervalBox<E, D>) -> bool {
        true
    }

    /// The derivatives over a cell that may hold a wanted solution, or why it does not.
    ///
    /// # Errors
    /// `Unwanted` and `Excluded`.
    fn examined(&self, cell: &IntervalBox<E, D>) -> Result<[IntervalBox<E, D>; D], Decision> {
        if !self.is_wanted(cell) {
            return Err(Decision::Unwanted);
        }
        let (values, slopes) = self.linearised(cell);
        not_excluded(&values).map(|()| slopes)
    }
}

/// # Errors
/// `Excluded` by the first equation that is nowhere 0.
pub fn not_excluded<E: Endpoint, const D: usize>(values: &IntervalBox<E, D>) -> Result<(), Decision> {
    let excluding = values.iter().position(|value| !value.contains_zero());
    excluding.map_or(Ok(()), |equation| Err(Decision::Excluded(equation)))
}

/// How a cell was decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Decision {
    /// This equation, counted from 0, is nowhere 0 in it.
    Excluded(usize),
    /// Nothing in it is asked for.
    Unwanted,
    /// Krawczyk's operator leaves nothing of it.
    Emptied,
    /// It lies where this root, counted from 0, is proved to be the only one.
    Root(usize),
    /// It is as small as cells get, and neither holds.
    Undecided,
}

impl std::fmt::Display for Decision {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Excluded(equation) => write!(f, "h_{} is nowhere 0", equation + 1),
            Self::Unwanted => f.write_str("v > 0 > w nowhere"),
            Self::Emptied => f.write_str("none: Krawczyk's operator leaves nothing"),
            Self::Root(index) => write!(f, "root {} or none", index + 1),
            Self::Undecided => f.write_str("undecided"),
        }
    }
}
