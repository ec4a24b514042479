//! Whether the rows are all there are: the columns `complete`, `low`, `high`, and `--require-complete`.

use super::rows::Rows;
use super::{Answer, Content, Exit};
use crate::number::Interval;
use crate::report::Cell;

/// What is asked of the rows of a search.
#[derive(Debug, clap::Args)]
pub struct Complete {
    /// Exit with 1 unless the list is proved to be complete
    #[arg(long)]
    require_complete: bool,
}

impl Complete {
    /// The rows, and whether they are as is asked.
    pub fn answer(&self, rows: impl Into<Rows>) -> Answer {
        Answer {
            content: Content::Rows(self.required(rows.into())),
            exit: Exit::AsExpected,
        }
    }

    /// The rows, which are to be complete where that is asked.
    pub fn required(&self, rows: Rows) -> Rows {
        match self.require_complete {
            true => rows.requiring("complete"),
            false => rows,
        }
    }
}

/// The last three columns of a row that is not decided: `complete`, and the box in `low` and `high`, joined by `;`.
pub fn incomplete(place: &[Interval<f64>]) -> [Cell; 3] {
    let side = |end: &dyn Fn(&Interval<f64>) -> f64| match place {
        [] => Cell::Empty,
        place => Cell::from(place.iter().map(end).collect::<Vec<f64>>()),
    };
    [Cell::from(false), side(&|of| of.low()), side(&|of| of.high())]
}
