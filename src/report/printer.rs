//! What a format that prints row by row can do.

use super::Cell;
use std::io::{self, Write};

/// A format that prints row by row.
pub(super) trait Printer {
    /// Prints rows.
    fn rows(&mut self, rows: &[Vec<Cell>], to: &mut dyn Write) -> io::Result<()>;

    /// Prints what follows the last row.
    fn end(&mut self, _to: &mut dyn Write) -> io::Result<()> {
        Ok(())
    }
}
