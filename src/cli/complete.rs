//! Whether the rows are all there are: the columns `complete`, `low`, `high`, and `--require-complete`.

use super::{Answer, Content, Exit};
use crate::number::Interval;
use crate::report::{Cell, Table};

/// What is asked of the rows of a search.
#[derive(Debug, clap::Args)]
pub struct Complete {
    /// Exit with 1 unless it is proved that there are no others than those listed
    #[arg(long)]
    require_complete: bool,
}

impl Complete {
    /// The table, and whether it is as is asked.
    pub fn answer(&self, table: Table) -> Answer {
        let column = table.position("complete");
        let is_open = |row: &Vec<Cell>| column.and_then(|at| row.get(at)) != Some(&Cell::Flag(true));
        let is_complete = !table.rows().iter().any(is_open);
        let exit = Exit::from_verdict(is_complete || !self.require_complete);
        let content = Content::Table(table);
        Answer { content, exit }
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
