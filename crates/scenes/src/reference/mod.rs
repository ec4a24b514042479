//! Golden values: what a paper prints and what is certified, held against what is computed.
//!
//! `printed.csv` has a row for each number or word of the paper, `reference/*.csv` values with 30 digits, each made
//! by one means and confirmed by another. Nothing here knows how a value is computed: whoever checks hands over a
//! function that answers a [`Request`] with a table ([`Computed`]). Printed figures are compared in exact decimals.

mod across;
mod amplitude;
mod bless;
mod certified;
mod check;
mod compare;
mod computed;
mod directory;
mod fault;
mod figures;
mod outcome;
mod printed;
mod quantity;
mod range;
mod records;
mod request;
mod setting;
mod value;
mod verdict;

pub use bless::{Blessed, Change, Made, bless};
pub use certified::{COLUMNS as CERTIFIED_COLUMNS, Certified, FIGURES};
pub use check::{check, check_row};
pub use compare::{Comparison, certified_against, compare};
pub use computed::Computed;
pub use directory::{Directory, PRINTED};
pub use fault::Fault;
pub use figures::Figures;
pub use outcome::Outcome;
pub use printed::{COLUMNS as PRINTED_COLUMNS, Printed};
pub use quantity::{Across, FieldName, NoQuantity, Quantity};
pub use records::Lines;
pub use records::Record;
pub use request::{Answer, Asked, Request};
pub use setting::{Selector, Setting, Wanted};
pub use value::Value;
pub use verdict::{UnknownVerdict, Verdict};
