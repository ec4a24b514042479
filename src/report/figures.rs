//! Numbers as text: whole, so that they read back, or rounded to significant figures.

/// The shortest decimal that reads back to the same bits (of NaN, to a NaN). A whole number keeps its `.0`, so
/// that a script can tell a number from a count.
pub fn whole(number: f64) -> String {
    format!("{number:?}")
}

/// Numbers as [`whole`] prints them, joined by `;`.
pub fn whole_list(numbers: &[f64]) -> String {
    numbers.iter().copied().map(whole).collect::<Vec<_>>().join(";")
}

/// The number to `digits` significant figures (0 counts as 1), without trailing zeros; never more figures than
/// are needed to read it back. A power of ten stands only where plain digits would mislead or run long.
pub fn rounded(number: f64, digits: usize) -> String {
    if !number.is_finite() {
        return whole(number);
    }
    let digits = digits.max(1);
    let shortest = format!("{number:e}");
    let figures = shortest
        .bytes()
        .take_while(|&byte| byte != b'e')
        .filter(u8::is_ascii_digit)
        .count();
    let scientific = if figures > digits {
        // No f64 needs more than 17 figures, so the precision stays small here whatever `digits` is.
        format!("{number:.*e}", digits - 1)
    } else {
        shortest
    };
    plain(&scientific, digits)
}

/// `-1.2500e-3` as `-0.00125` where that is readable, else `-1.25e-3`.
fn plain(scientific: &str, digits: usize) -> String {
    let Some((mantissa, power)) = scientific.split_once('e') else {
        return scientific.to_owned();
    };
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |rest| ("-", rest));
    let figures: String = mantissa.chars().filter(|&c| c != '.').collect();
    let figures = match figures.trim_end_matches('0') {
        "" => "0",
        trimmed => trimmed,
    };
    let readable = -5..i32::try_from(digits.min(16)).unwrap_or(16);
    match power.parse::<i32>() {
        Ok(power) if readable.contains(&power) => format!("{sign}{}", place_point(figures, power)),
        _ => {
            let (first, rest) = figures.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{point}{rest}e{power}")
        }
    }
}

/// Places the decimal point: the first figure stands for `10^power`.
fn place_point(figures: &str, power: i32) -> String {
    let Ok(power) = usize::try_from(power) else {
        let zeros = "0".repeat(power.unsigned_abs() as usize - 1);
        return format!("0.{zeros}{figures}");
    };
    let before = power + 1;
    if figures.len() <= before {
        format!("{figures}{}", "0".repeat(before - figures.len()))
    } else {
        let (integer, fraction) = figures.split_at(before);
        format!("{integer}.{fraction}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_read_back_to_the_same_bits() {
        for number in [
            0.1,
            -0.0,
            5e-324,
            f64::MAX,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1.0,
            1e16,
            1.0 / 3.0,
        ] {
            assert_eq!(
                whole(number).parse::<f64>().map(f64::to_bits),
                Ok(number.to_bits()),
                "{number}"
            );
        }
        assert_eq!(whole(f64::NAN), "NaN");
    }

    #[test]
    fn rounding_keeps_the_asked_figures_and_drops_trailing_zeros() {
        let cases = [
            (0.0, 12, "0"),
            (-0.0, 12, "-0"),
            (0.5, 12, "0.5"),
            (1.0 / 3.0, 12, "0.333333333333"),
            (0.1 + 0.2, 12, "0.3"),
            (0.1 + 0.2, 17, "0.30000000000000004"),
            (0.1, 40, "0.1"),
            (-0.00125, 3, "-0.00125"),
            (1e-6, 12, "1e-6"),
            (1.234e-9, 2, "1.2e-9"),
            (12345.678, 3, "1.23e4"),
            (100.0, 3, "100"),
            (99.96, 3, "100"),
            (9.999, 1, "1e1"),
            (2.5e20, 17, "2.5e20"),
            (7.0, 0, "7"),
            (f64::INFINITY, 3, "inf"),
            (f64::NAN, 3, "NaN"),
        ];
        for (number, digits, expected) in cases {
            assert_eq!(rounded(number, digits), expected, "{number} to {digits}");
        }
    }
}
