//! Values of printed formulas at sampled points: the symbols and calls in them have a value at each point.

mod leaves;
mod value;

pub use leaves::{Leaves, SizedValue, agree, asked, take_leaves, take_standing};
pub use value::{Arithmetic, Number, Op, UNDEFINED, Value, real};
