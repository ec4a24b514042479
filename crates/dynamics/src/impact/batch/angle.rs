//! Sine and cosine of an angle of a few turns, without a branch or a call, so that lanes can take them together.

use std::f64::consts::FRAC_2_PI;

/// The largest angle, in size, for which [`sin_cos`] is meant.
#[cfg(test)]
const FARTHEST: f64 = 1000.0;

/// Added to a number below 2^51 in size and taken off again, it leaves the nearest integer; before it is taken off,
/// the last bits of the sum are those of the integer.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// pi / 2 in three parts; products of the first two with integers below 2^20 are exact.
const QUARTER: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    f64::from_bits(0x3BA3_198A_2E03_7073),
];

/// Sine over a quarter turn about 0: x + x³ (S0 + S1 x² + ...).
const SINE: [f64; 6] = [
    f64::from_bits(0xBFC5_5555_5555_5549),
    f64::from_bits(0x3F81_1111_1110_F8A6),
    f64::from_bits(0xBF2A_01A0_19C1_61D5),
    f64::from_bits(0x3EC7_1DE3_57B1_FE7D),
    f64::from_bits(0xBE5A_E5E6_8A2B_9CEB),
    f64::from_bits(0x3DE5_D93A_5ACF_D57C),
];

/// Cosine over a quarter turn about 0: 1 - x²/2 + x⁴ (C0 + C1 x² + ...).
const COSINE: [f64; 6] = [
    f64::from_bits(0x3FA5_5555_5555_554C),
    f64::from_bits(0xBF56_C16C_16C1_5177),
    f64::from_bits(0x3EFA_01A0_19CB_1590),
    f64::from_bits(0xBE92_7E4F_809C_52AD),
    f64::from_bits(0x3E21_EE9E_BDB4_B1C4),
    f64::from_bits(0xBDA8_FAE9_BE88_38D4),
];

/// The nearest integer, ties to even; for numbers below 2^51 in size.
#[inline(always)]
pub(super) fn nearest(x: f64) -> f64 {
    (x + ROUNDER) - ROUNDER
}

/// `yes` or `no`.
#[inline(always)]
pub(super) fn pick(condition: bool, yes: f64, no: f64) -> f64 {
    if condition { yes } else { no }
}

/// Sine and cosine, each within 0.8 of its last place, of an angle of at most 1000 in size.
///
/// The angle less quarter turns, in two parts, then two polynomials: the ones of fdlibm (Sun Microsystems, 1993),
/// whose coefficients these are.
#[inline(always)]
pub(super) fn sin_cos(angle: f64) -> (f64, f64) {
    let shifted = angle * FRAC_2_PI + ROUNDER;
    let (quarters, bits) = (shifted - ROUNDER, shifted.to_bits());
    let first = angle - quarters * QUARTER[0];
    let second = quarters * QUARTER[1];
    let rough = first - second;
    let rest = ((first - rough) - second) - quarters * QUARTER[2];
    let x = rough + rest;
    let tail = (rough - x) + rest;

    let z = x * x;
    let s = SINE[1] + z * (SINE[2] + z * (SINE[3] + z * (SINE[4] + z * SINE[5])));
    let cube = z * x;
    let sine = x - ((z * (0.5 * tail - cube * s) - tail) - cube * SINE[0]);

    let c = z * (COSINE[0] + z * (COSINE[1] + z * COSINE[2]))
        + (z * z) * (z * z) * (COSINE[3] + z * (COSINE[4] + z * COSINE[5]));
    let half = 0.5 * z;
    let top = 1.0 - half;
    let cosine = top + (((1.0 - top) - half) + (z * c - x * tail));

    let is_odd = bits & 1 != 0;
    let (sin, cos) = (pick(is_odd, cosine, sine), pick(is_odd, sine, cosine));
    let signed = |value: f64, quarters: u64| f64::from_bits(value.to_bits() ^ ((quarters & 2) << 62));
    (signed(sin, bits), signed(cos, bits.wrapping_add(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::{Analytic, Wide};
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    /// How far a value is from the exact one, in units of the exact one's last place.
    fn places(ours: f64, exact: &Wide<50>) -> f64 {
        let rounded = exact.to_f64();
        let place = (rounded.abs().next_up() - rounded.abs()).abs();
        (Wide::from_f64(ours) - exact.clone()).to_f64().abs() / place
    }

    fn worst(angle: f64) -> f64 {
        let (sin, cos) = sin_cos(angle);
        let (exact_sin, exact_cos) = Wide::<50>::from_f64(angle).sincos();
        places(sin, &exact_sin).max(places(cos, &exact_cos))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn both_are_right_to_less_than_a_last_place(angle in -FARTHEST..FARTHEST) {
            prop_assert!(worst(angle) < 0.8, "{}", angle);
        }

        #[test]
        fn they_are_where_flights_take_them(angle in 0.0..30.0) {
            prop_assert!(worst(angle) < 0.8, "{}", angle);
        }
    }

    #[test]
    fn they_are_at_the_numbers_nearest_to_quarter_turns_and_at_small_angles() {
        for quarters in 0..600 {
            let angle = f64::from(quarters) * FRAC_PI_2;
            for angle in [angle.next_down(), angle, angle.next_up()] {
                assert!(worst(angle) < 0.8, "{angle}");
            }
        }
        for angle in [1e-300, 1e-17, 1e-9, 1e-3, 0.785, 0.786, FARTHEST] {
            assert!(worst(angle) < 0.8 && worst(-angle) < 0.8, "{angle}");
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }

    #[test]
    fn the_nearest_integer_is_exact() {
        for (x, integer) in [(0.4, 0.0), (0.6, 1.0), (-0.6, -1.0), (2.5, 2.0), (1e15 + 0.5, 1e15)] {
            assert_eq!(nearest(x), integer);
        }
    }
}
