//! The body of a sum, integral or limit, and an estimate of the whole.

use super::evaluation::is_wide;
use super::value::Value;

/// The largest error of a value, as a part of the size of what it is made of: in f64, and in many digits.
const INEXACT: f64 = 1e-9;
const INEXACT_WIDE: f64 = 1e-26;

/// A value with the size of the terms that it is made of.
#[derive(Clone, Debug)]
pub struct Term<V> {
    pub value: V,
    pub size: f64,
}

/// A value with the size of its terms and an estimate of its error.
#[derive(Clone, Debug)]
pub struct Estimate<V> {
    pub value: V,
    pub size: f64,
    pub error: f64,
}

/// The error that a value may have, as a part of its size.
pub fn tolerance<V: Value>() -> f64 {
    match is_wide::<V>() {
        true => INEXACT_WIDE,
        false => INEXACT,
    }
}

/// The body of an operation at values of its letter.
pub type Body<'a, V> = dyn FnMut(V) -> Term<V> + 'a;
