//! What operations cost in instructions.

use numbers::{Counts, Rung};
use std::collections::HashMap;

/// What one operation of each number costs in instructions.
///
/// Measured once by `valgrind --tool=callgrind`, which counts the same on every machine of one architecture: the mean
/// over 2000 operations, the loop around them included. They order the numbers; no digit depends on them.
pub const WEIGHTS: &str = include_str!("../golden/accuracy/weights.csv");

#[derive(serde::Deserialize)]
struct Weight {
    number: String,
    addition: u64,
    multiplication: u64,
    division: u64,
    root: u64,
    sincos: u64,
    other: u64,
}

/// What the operations of each number cost.
pub(super) struct Weights(HashMap<String, Weight>);

impl Weights {
    /// Those of [`WEIGHTS`].
    pub fn measured() -> Self {
        let mut reader = csv::Reader::from_reader(WEIGHTS.as_bytes());
        let rows = reader.deserialize().filter_map(Result::ok);
        Self(rows.map(|weight: Weight| (weight.number.clone(), weight)).collect())
    }

    /// The instructions of so many operations; none of a number that was not measured.
    pub fn cost(&self, rung: Rung, counts: &Counts) -> Option<u64> {
        let weight = self.0.get(&rung.to_string())?;
        Some(
            counts.additions * weight.addition
                + counts.multiplications * weight.multiplication
                + counts.divisions * weight.division
                + counts.roots * weight.root
                + counts.sincos * weight.sincos
                + counts.others * weight.other,
        )
    }
}
