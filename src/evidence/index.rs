//! What the subscripts of names number: impacts, and members of sequences.

use crate::claim::Vocabulary;
use crate::tex::Name;

/// Whether the name numbers impacts or members of a sequence, standing for itself.
pub fn is_index(vocabulary: &Vocabulary, name: &Name) -> bool {
    name.to_string() == vocabulary.index || vocabulary.indices.contains(name)
}

/// The value of an index that runs: premises and claim are read at it.
pub const INDEX: i32 = 4;

/// Whether the letter that numbers impacts or members of a sequence runs.
pub fn index_runs(vocabulary: &Vocabulary) -> bool {
    vocabulary
        .indices
        .iter()
        .any(|index| index.to_string() == vocabulary.index)
}

/// The place of a member of a sequence that is numbered outright, as x_0, beside the running index.
pub fn member(vocabulary: &Vocabulary, name: &Name) -> Option<i32> {
    let known = vocabulary.states.contains(&name.bare()) && index_runs(vocabulary);
    name.subscript
        .parse::<i32>()
        .ok()
        .filter(|_| known)
        .map(|number| number.saturating_sub(INDEX))
}
