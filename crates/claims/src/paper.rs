//! The sheet and the symbols that the program carries with it.

use super::fault::Fault;
use super::sheet::{Sheet, read_symbols};
use texmath::Symbols;

/// golden/paper/equations.toml.
pub const EQUATIONS: &str = include_str!("../golden/paper/equations.toml");

/// golden/paper/symbols.toml.
pub const SYMBOLS: &str = include_str!("../golden/paper/symbols.toml");

/// What a sheet without `[symbols]` speaks: the symbols of the impact pair.
///
/// # Errors
/// None: a test reads the embedded text.
pub fn vocabulary() -> Result<Symbols, Fault> {
    read_symbols(SYMBOLS)
}

/// Equations (1) to (23) as printed.
///
/// # Errors
/// None: a test reads the embedded text.
pub fn paper() -> Result<Sheet, Fault> {
    Sheet::read(EQUATIONS, &vocabulary()?)
}
