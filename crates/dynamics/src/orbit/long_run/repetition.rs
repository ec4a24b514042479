//! The cycle that a list of impacts ends with, and where its word starts.

use crate::model::Side;
use crate::orbit::long_run::symbols::Symbol;
use crate::orbit::options::OrbitOptions;

/// Cycles that differ by less are one that is still settling, not two that a period doubling has parted: the parts lie
/// as far from each other as the square root of the distance from the bifurcation, so this one is some 1e-12 wide.
const UNPARTED: f64 = 1e-6;

/// The shortest cycle that the letters end with, and its turns.
///
/// A motion that comes in turning over at each cycle, with a multiplier near -1, agrees over two cycles before it does
/// over one: so a part of a cycle that repeats to [`UNPARTED`] is the cycle.
pub fn repeated<'a>(letters: &'a [Symbol], options: &OrbitOptions) -> Option<(&'a [Symbol], i64)> {
    let longest = (options.longest_word as usize).min(letters.len() / 2);
    let (length, found) =
        (1..=longest).find_map(|length| Some((length, repeated_by(letters, length, options.settled)?)))?;
    let parts = (1..length).filter(|part| length % part == 0);
    let part = parts.filter_map(|part| repeated_by(letters, part, UNPARTED)).next();
    Some(part.unwrap_or(found))
}

/// The last so many letters and their turns, where those before are the same to a tolerance.
fn repeated_by(letters: &[Symbol], length: usize, tolerance: f64) -> Option<(&[Symbol], i64)> {
    let cycle = &letters[letters.len() - length..];
    let scale = cycle.iter().map(|letter| letter.speed).fold(0.0, f64::max);
    let repeats = if cycle.iter().any(|letter| letter.rests) { 1 } else { 2 };
    let needed = (repeats + 1) * length;
    let compared = &letters[letters.len().checked_sub(needed)?..];
    let mut turns = compared[length..]
        .iter()
        .zip(compared)
        .rev()
        .map(|(letter, before)| letter.turns_since(before, scale, tolerance));
    let first = turns.next()??;
    (first > 0 && turns.all(|other| other == Some(first))).then_some((cycle, first))
}

/// Impacts of a cycle whose speeds differ by no more than this part of them are equally fast: those of a cycle that has
/// settled differ by less where they are the same.
const EQUALLY_FAST: f64 = 2e-9;

/// Where the word of a cycle starts. Of starts that are equally fast, the one whose word comes first in the alphabet.
pub fn start(cycle: &[Symbol]) -> usize {
    let length = cycle.len();
    let before = |index: usize| &cycle[(index + length - 1) % length];
    let one_wall = cycle.iter().all(|letter| letter.side == cycle[0].side);
    let may_start =
        |index: &usize| one_wall || (cycle[*index].side == Side::Bottom && before(*index).side == Side::Top);
    let fastest = (0..length)
        .filter(may_start)
        .map(|index| cycle[index].speed)
        .fold(0.0, f64::max);
    let word = |first: usize| (0..length).map(move |index| cycle[(first + index) % length].text());
    (0..length)
        .filter(may_start)
        .filter(|index| cycle[*index].speed >= fastest * (1.0 - EQUALLY_FAST))
        .min_by(|one, other| word(*one).cmp(word(*other)))
        .unwrap_or(0)
}
