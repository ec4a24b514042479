//! Letters that one sheet prints in two ways, which are read as one.

use super::entry::{Entry, RawEntry};
use crate::tex::letters;
use std::collections::{BTreeMap, BTreeSet};

/// Makes the entries `unread` that hold a letter which the formulas print in two ways: `\mathbf{a}` and `a`, `\phi` and
/// `\varphi` are read as one letter, and are mostly two symbols where both are printed.
pub(super) fn refuse_two_spellings(raw: &[RawEntry], entries: &mut [Entry]) {
    let mut printed: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for tex in raw.iter().flat_map(RawEntry::formulas) {
        for (letter, shape) in letters(tex) {
            printed.entry(letter).or_default().insert(shape);
        }
    }
    printed.retain(|_, shapes| shapes.len() > 1);
    if printed.is_empty() {
        return;
    }
    for (raw, entry) in raw.iter().zip(entries) {
        let mut own = raw.formulas().flat_map(letters);
        if let Some(shapes) = own.find_map(|(letter, _)| printed.get(letter)) {
            let shapes: Vec<String> = shapes.iter().map(|shape| format!("`{shape}`")).collect();
            let problem = format!(
                "{} are read as one letter, and both are printed: call one of them by another letter",
                shapes.join(" and ")
            );
            entry
                .unread
                .get_or_insert_with(|| entry.tex.fault(0, problem).of(&entry.label));
        }
    }
}
