//! Sheets of claims: read, decided, explained.

mod atom;
mod audit;
mod counterexample;
mod jacobian;
mod motion;
mod premise;
mod problem;
mod proof;
mod reading;
mod root;
mod sheet;
mod substitute;
mod verdict;
mod vocabulary;

pub use audit::Decision;
pub use counterexample::Counterexample;
pub use premise::{Statement, Statements};
pub use reading::Local;
pub use sheet::{Entry, Fault, Role, Sheet, read_symbols};
pub use verdict::Verdict;
pub use vocabulary::{Map, Vocabulary, index_of};
