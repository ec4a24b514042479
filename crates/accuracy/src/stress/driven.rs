//! Impacts under several harmonics, over one wall, and from starts in flight, where these are at an extreme.

use super::StressError;
use super::impacts::{Setup, SimulatedImpact};
use super::row::StressRow;

/// cos x - cos(2 x)/4: with g = -3/4 and a little less, f + g falls to 0 and hardly below, for a while.
const FLAT: &[[f64; 2]] = &[[1.0, 0.0], [-0.25, 0.0]];

/// A harmonic of order 40 beside the first.
const HIGH: &[[f64; 2]] = &{
    let mut amplitudes = [[0.0; 2]; 40];
    amplitudes[0][0] = 1.0;
    amplitudes[39][1] = 0.5;
    amplitudes
};

/// A square wave of nine harmonics.
const SQUARE: &[[f64; 2]] = &{
    let mut amplitudes = [[0.0; 2]; 17];
    let mut order = 1;
    while order <= 17 {
        let sign = if order % 4 == 1 { 1.0 } else { -1.0 };
        amplitudes[order - 1][0] = sign / order as f64;
        order += 2;
    }
    amplitudes
};

/// The extremes, each with g, d, r_B, r_T, phase and velocity of the start, and the impacts after it: few enough that errors
/// which grow leave digits to compare.
const CASES: [(&str, [f64; 6], Setup, u32); 7] = [
    (
        "harmonics, f + g nearly flat at 0",
        [-0.75 + 1e-10, 0.3, 0.6, 0.6, 0.7, 0.6],
        Setup::Harmonics(FLAT),
        4,
    ),
    (
        "harmonics, order 40",
        [0.12201, 0.3, 0.6, 0.6, 0.7, 0.6],
        Setup::Harmonics(HIGH),
        4,
    ),
    (
        "harmonics, a square wave",
        [0.12201, 0.3, 0.6, 0.6, 0.7, 0.6],
        Setup::Harmonics(SQUARE),
        4,
    ),
    ("one wall, g near 0", [1e-3, 1.0, 0.6, 0.6, 0.7, 0.6], Setup::OneWall, 2),
    (
        "one wall, a slow start",
        [0.3, 1.0, 0.6, 0.6, 2.2, 1e-9],
        Setup::OneWall,
        4,
    ),
    (
        "a start in flight, near a wall",
        [0.12201, 0.3, 0.6, 0.6, 0.7, -0.2],
        Setup::InFlight(0.15 - 1e-12),
        4,
    ),
    ("a plastic impact", [0.12201, 0.3, 0.0, 0.6, 2.5, 0.6], Setup::Paper, 2),
];

/// The names of the cases.
pub(super) fn cases() -> impl Iterator<Item = &'static str> {
    CASES.into_iter().map(|(case, ..)| case)
}

/// The rows of a case: phase and velocity at an impact, some impacts on.
///
/// # Errors
/// `Point` where the motion ends before, `Reference` where the map (8) does not confirm it.
pub(super) fn rows(case: &'static str) -> Result<Vec<StressRow>, StressError> {
    let found = CASES.into_iter().find(|(name, ..)| *name == case);
    let Some((_, inputs, setup, impacts)) = found else {
        return Err(StressError::NoCase(case.to_owned()));
    };
    SimulatedImpact { inputs, setup, impacts }.rows(case)
}

#[cfg(test)]
mod tests {
    use super::super::row::Form;
    use super::*;

    #[test]
    fn no_row_is_below_the_bar_and_f64_keeps_digits() {
        for case in cases() {
            let rows = rows(case).unwrap_or_else(|error| panic!("{error}"));
            assert!(rows.iter().all(|row| !row.is_below_bar()), "{rows:#?}");
            let is_ours = |row: &&StressRow| row.form != Form::Printed && row.number == "f64";
            assert!(rows.iter().filter(is_ours).all(|row| row.digits > 6.0), "{rows:#?}");
        }
    }
}
