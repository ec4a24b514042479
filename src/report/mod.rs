//! Tables, and how they reach the reader: text, CSV, JSON, Markdown or JUnit, on stdout or in a file;
//! findings, and the page for a reader.
//!
//! A command fills a [`Table`]; [`Table::write`] prints it in a [`Format`]; an [`Output`] says where to. What is too
//! long to be held is printed row by row through a [`Stream`].
//! CSV, JSON and Markdown print every number so that it reads back to the same value; only text rounds.
//!
//! ```
//! use vibro_audit::report::{Cell, Format, Table};
//!
//! let mut table = Table::new(["label", "digits"]);
//! table.push([Cell::from("22"), Cell::from(0.1 + 0.2)])?;
//! let mut text = Vec::new();
//! table.write(&mut text, Format::Csv, 3)?;
//! assert_eq!(String::from_utf8(text)?, "label,digits\n22,0.30000000000000004\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod baseline;
mod csv;
pub mod figure;
mod figures;
mod format;
mod frame;
mod json;
mod junit;
mod lock;
mod markdown;
mod new_directory;
mod output;
mod page;
pub mod plot;
mod printer;
mod sarif;
mod stream;
mod table;
mod text;

pub use crate::checksum::{Checksum, Summed, SummedLines};
pub use crate::markup::acts as acts_on_a_terminal;
pub use baseline::{Baseline, BaselineError, fingerprint};
pub use format::{Format, UnknownFormat};
pub use frame::{Form, Frame, Values};
pub use json::{FORMULAS, NUMBERS, write_tables as json_tables};
pub use junit::write as junit;
pub use lock::DirectoryLock;
pub use new_directory::NewDirectory;
pub use output::{
    Output, OutputError, OutputProblem, forget_inputs, is_same_file, note_input, note_stdin, open_locked,
    remove_temporaries,
};
pub use page::{Given, Page, Part, Printed, Verdicts};
pub use sarif::{Finding, Fix, Kind, sarif};
pub use stream::Stream;
pub use table::{Cell, Column, RowError, Table};

/// Significant figures of a number in text where the user names none.
pub const DEFAULT_DIGITS: usize = 12;
