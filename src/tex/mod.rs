//! TeX formulas: read, print, evaluate over any [`Field`](crate::number::Field).

mod atom;
mod bracket;
mod call;
mod command;
mod display;
mod error;
mod evaluate;
mod lexer;
mod names;
mod part;
mod printer;
mod reader;
mod script;
#[cfg(test)]
mod spelled;
mod statement;
mod subscript;
mod symbol;
mod token;
mod tree;

pub use display::{read, read_expression, read_name};
pub use error::{ReadError, Reason};
pub use evaluate::{EvaluationError, Scope, Unsupported, evaluate};
pub use names::Names;
pub use tree::{At, Equation, Invariant, Name, Tree};
