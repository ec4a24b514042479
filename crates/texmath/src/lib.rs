//! TeX formulas: read, print, evaluate over any [`Field`](numbers::Field).
//!
//! ```
//! use std::collections::BTreeMap;
//! use numbers::{Field, Rational};
//! use texmath::{Names, evaluate, read, read_expression, read_name};
//!
//! let names = Names::default();
//! let equations = read(r"\epsilon = \frac1{1 - r_B r_T}, \qquad T = T_1 + T_2", &names)?;
//! assert_eq!(equations[0].to_string(), r"\epsilon = \frac{1}{1 - r_B r_T}");
//!
//! let bounds = read(r"0 \le u < \frac{\pi}{2}", &names)?;
//! assert_eq!(bounds[1].to_string(), r"u < \frac{\pi}{2}");
//! let ambiguous = read_expression(r"h/2\pi", &names).unwrap_err();
//! assert!(ambiguous.to_string().contains(r"\frac{h}{2} \pi or as \frac{h}{2 \pi}"));
//!
//! let half = Rational::from_ratio(1, 2);
//! let mut scope = BTreeMap::from([(read_name("r_B", &names)?, half.clone()), (read_name("r_T", &names)?, half)]);
//! assert_eq!(evaluate(&equations[0].right, &mut scope)?, Rational::from_ratio(4, 3));
//!
//! let error = read("a = b \\sim c", &names).unwrap_err();
//! assert_eq!(error.caret("a = b \\sim c"), "a = b \\sim c\n      ^");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// Library code never panics by its own word: errors are returned.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

pub mod markup;

mod argument;
mod atom;
mod bars;
mod bracket;
mod call;
mod command;
mod conditions;
mod declared;
mod difference;
mod display;
mod dots;
mod doubt;
mod elementary;
mod error;
mod evaluate;
mod exponent;
mod extent;
mod extremum;
mod factorial;
mod hidden;
mod lexer;
mod mathml;
mod names;
mod nearest;
mod nodes;
mod operation;
mod part;
mod place;
mod printer;
mod reader;
mod relations;
mod script;
mod shorthand;
#[cfg(test)]
mod spelled;
mod statement;
mod subscript;
mod substitute;
mod symbol;
mod symbols;
mod token;
mod tree;
mod units;

pub use command::holds_unknown;
pub use command::with_commands;
pub use conditions::read_conditions;
pub use declared::{Undeclared, Unknown};
pub use difference::{difference, difference_of};
pub use display::functions_given;
pub use display::{Display, read, read_display, read_expression, read_name};
pub use doubt::{Doubt, DoubtKind, Doubts, OtherReading};
pub use elementary::{Elementary, Parity};
pub use error::{ReadError, Reason};
pub use evaluate::{EvaluationError, Scope, Unsupported, evaluate};
pub use hidden::has_dots;
pub use lexer::{letters, printed};
pub use mathml::{letter, mathml, mathml_display, mathml_of_condition, mathml_of_name};
pub use names::{BOLD, Names, Opaque};
pub use nearest::nearest;
pub use nodes::{
    any, any_side, holds, holds_indefinite, names_in, names_of, nodes_of, parts, speaks_of, with_part, with_symbol,
};
pub use place::{Lines, Place};
pub use relations::{Related, related, sign_at};
pub use shorthand::{FUNCTION_LETTERS, LONGEST, derivative_of, is_bold, is_opaque, says_nothing};
pub use substitute::{
    flies, mapped, number_of, put_in, put_in_throughout, rewrite, rewrite_alone, rewrite_condition, rewrite_equation,
    runs, tree_runs,
};
pub use symbols::{Map, Meaning, Symbols, base_alone, index_of, is_constant, pair_of, place, place_of, subscript_of};
pub use tree::{At, Case, Condition, Equation, Invariant, Name, Operation, Relation, Series, Tree};
