//! The number types and the model over each of them.

mod intervals;
mod many_digits;
mod model;
mod number;
