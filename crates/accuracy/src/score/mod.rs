//! Anyone's answers held against certified ones: digits, and the work they took.

mod answers;
mod program;
mod rating;
mod summary;

pub use answers::{AnswerError, Answers, Given};
pub use program::{Program, ProgramError, Ran};
pub use rating::{Rating, rate, worst};
pub use summary::{Part, Precision, parts};
