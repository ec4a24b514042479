//! Sheets of claims: read, decided, explained.

mod angle;
mod atom;
mod audit;
mod certificate;
mod counterexample;
mod derivatives;
mod explain;
mod fault;
mod functions;
mod jacobian;
mod meaning;
mod motion;
mod paper;
mod parting;
mod point;
mod premise;
mod problem;
mod proof;
mod reading;
mod root;
mod sheet;
mod solving;
mod substitute;
mod symbols;
mod times;
mod verdict;
mod vocabulary;

pub use audit::Decision;
pub use counterexample::Counterexample;
pub use fault::Fault;
pub use paper::{EQUATIONS, SYMBOLS, paper, vocabulary};
pub use premise::{Statement, Statements};
pub use reading::Local;
pub use sheet::{Entry, Role, Sheet, read_symbols};
pub use verdict::Verdict;
pub use vocabulary::{Map, Vocabulary, index_of};
