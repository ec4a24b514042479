//! The laws of each number type, held against the others and against references of many digits.

mod intervals;
mod number;
mod references;
