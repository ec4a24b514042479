//! Sheets of claims: read, decided, explained.

mod angle;
mod atom;
mod audit;
mod certificate;
mod counterexample;
mod explain;
mod jacobian;
mod motion;
mod paper;
mod parting;
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
pub use paper::{EQUATIONS, SYMBOLS, paper, vocabulary};
pub use premise::{Statement, Statements};
pub use reading::Local;
pub use sheet::{Entry, Fault, Role, Sheet, read_symbols};
pub use verdict::Verdict;
pub use vocabulary::{Map, Vocabulary, index_of};
