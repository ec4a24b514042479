//! TeX formulas: read, print, evaluate over any [`Field`](crate::number::Field).

mod atom;
mod bracket;
mod command;
mod error;
mod evaluate;
mod lexer;
mod names;
mod part;
mod printer;
mod reader;
mod script;
mod statement;
mod symbol;
mod token;
mod tree;

pub use error::{ReadError, Reason};
pub use evaluate::{EvaluationError, Scope, Unsupported, evaluate};
pub use names::Names;
pub use reader::{read, read_expression, read_name};
pub use tree::{At, Equation, Invariant, Name, Tree};
