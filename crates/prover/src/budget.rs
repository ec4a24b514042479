//! The steps that the search for proofs and counterexamples of a claim may take.

use super::proof;
use std::cell::Cell;

/// Steps of the search for a proof, for all quick or all deep ones of a claim, and for a contradiction, for each unit of effort.
pub(super) const PROOF_STEPS: u64 = 5_000_000;
pub(super) const QUICK_STEPS: u64 = 1_300_000;
const ALL_QUICK_STEPS: u64 = 16_000_000;
const ALL_DEEP_STEPS: u64 = 8_000_000;
pub(super) const CONTRADICTION_STEPS: u64 = 300_000;

/// The extent of the search for a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Depth {
    Quick,
    Deep,
}

/// The steps that are left for the proofs of a claim: for those of each depth, so that quick ones are always tried.
pub(super) struct Budget {
    pub(super) effort: u64,
    quick: Cell<u64>,
    deep: Cell<u64>,
}

impl Budget {
    pub(super) fn of_claim(effort: u64) -> Self {
        Self {
            effort,
            quick: Cell::new(ALL_QUICK_STEPS.saturating_mul(effort)),
            deep: Cell::new(ALL_DEEP_STEPS.saturating_mul(effort)),
        }
    }

    /// Searches for a proof in at most so many steps.
    pub(super) fn proof(
        &self,
        statement: &kernel::Statement,
        depth: Depth,
        most: u64,
    ) -> Option<kernel::With<kernel::Certificate>> {
        let of_depth = match depth {
            Depth::Quick => &self.quick,
            Depth::Deep => &self.deep,
        };
        let (left, mut used) = (of_depth.get(), 0);
        let found = proof::search(statement, most.min(left), &mut used);
        of_depth.set(left.saturating_sub(used));
        found
    }
}
