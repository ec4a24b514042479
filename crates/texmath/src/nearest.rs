//! The name that was probably meant.

/// Of `known`, the name that takes the fewest letters changed, added, left out or swapped with their neighbour to
/// become `found`; none where more than a third of the letters differ.
pub fn nearest<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let most = (found.chars().count().max(3) / 3).min(3);
    // Of a long name nothing is near, and its table would be large.
    if found.len() > 64 {
        return None;
    }
    known
        .into_iter()
        .map(|name| (distance(found, name), name))
        .filter(|&(distance, _)| distance <= most)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, name)| name)
}

/// The optimal string alignment distance of two names, upper and lower case taken as one.
fn distance(left: &str, right: &str) -> usize {
    let letters = |text: &str| text.to_lowercase().chars().collect::<Vec<_>>();
    let (left, right) = (letters(left), letters(right));
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=right.len()).collect();
    for (i, a) in left.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, b) in right.iter().enumerate() {
            let at = |row: &[usize], j: usize| row.get(j).copied().unwrap_or(usize::MAX / 2);
            let change = at(&last, j) + usize::from(a != b);
            let mut least = change.min(at(&last, j + 1) + 1).min(at(&row, j) + 1);
            let swapped = i > 0 && j > 0 && left.get(i - 1) == Some(b) && right.get(j - 1) == Some(a);
            if swapped {
                least = least.min(at(&before, j - 1) + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut last, row);
    }
    last.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_keyboard_are_understood() {
        let known = ["capsule_mass", "incline", "r_b", "r_t", "d", "fig02"];
        for (found, name) in [
            ("capsul_mass", "capsule_mass"),
            ("inlcine", "incline"),
            ("R_B", "r_b"),
            ("rb", "r_b"),
            ("dd", "d"),
            ("fig2", "fig02"),
        ] {
            assert_eq!(nearest(found, known), Some(name), "{found}");
        }
        for found in ["restitution", "", "xyz", &"d".repeat(100_000)] {
            assert_eq!(nearest(found, ["capsule_mass", "incline"]), None);
        }
    }

    #[test]
    fn two_neighbours_swapped_are_one_slip() {
        assert_eq!(
            [distance("ab", "ba"), distance("abc", "cab"), distance("", "abc")],
            [1, 2, 3]
        );
    }
}
