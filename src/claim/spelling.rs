//! Letters that one sheet prints in two ways, which are read as one, and products of vectors that are read as numbers.

use super::entry::{Entry, RawEntry};
use super::vocabulary::Vocabulary;
use crate::tex::{Name, letters};
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

/// Makes the entries `unread` that print a product `\times`, or `\cdot` of several letters, of letters in bold or under an arrow that
/// are declared as numbers.
pub(super) fn refuse_products_of_vectors(raw: &[RawEntry], entries: &mut [Entry], vocabulary: &Vocabulary) {
    let is_number = |letter: &str, accents: &[&str]| {
        let is_it = |name: &Name| name.base == letter && name.subscript.is_empty() && name.accents == accents;
        vocabulary.parameters.iter().any(is_it)
    };
    for (raw, entry) in raw.iter().zip(entries) {
        for tex in raw.formulas() {
            let bold = |(letter, printed): (&str, String)| {
                let is_vector = (printed.starts_with(r"\mathbf") && is_number(letter, &[]))
                    || (tex.contains(r"\vec") && is_number(letter, &[r"\vec"]));
                is_vector.then(|| letter.to_owned())
            };
            let vectors: BTreeSet<String> = letters(tex).into_iter().filter_map(bold).collect();
            let is_cross = !vectors.is_empty() && (tex.contains(r"\times") || tex.contains('×'));
            let is_dot = vectors.len() > 1 && (tex.contains(r"\cdot") || tex.contains(['·', '⋅']));
            if is_cross || is_dot {
                let problem = "a product of vectors by the look of its letters, which are declared as numbers: define them as columns";
                entry
                    .unread
                    .get_or_insert_with(|| entry.tex.fault(0, problem).of(&entry.label));
            }
        }
    }
}
