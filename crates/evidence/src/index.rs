//! What the subscripts of names number: impacts, and members of sequences.

use texmath::{Name, Symbols};

/// Whether the name numbers impacts or members of a sequence, standing for itself.
pub fn is_index(symbols: &Symbols, name: &Name) -> bool {
    name.to_string() == symbols.index || symbols.is_index(name)
}

/// The value of an index that runs: premises and claim are read at it.
pub const INDEX: i32 = 4;

/// Whether the letter that numbers impacts or members of a sequence runs.
pub fn index_runs(symbols: &Symbols) -> bool {
    symbols.indices().any(|index| index.to_string() == symbols.index)
}

/// The place of a member of a sequence that is numbered outright, as x_0, beside the running index.
pub fn member(symbols: &Symbols, name: &Name) -> Option<i32> {
    let known = symbols.is_state(&name.bare()) && index_runs(symbols);
    name.subscript
        .parse::<i32>()
        .ok()
        .filter(|_| known)
        .map(|number| number.saturating_sub(INDEX))
}
