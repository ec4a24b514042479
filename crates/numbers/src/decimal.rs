//! Decimals: how rationals are printed in papers, and how they enter other fields.

use super::{Field, Rational};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

impl Rational {
    /// The exact value of digits with at most one point, such as `2`, `0.26` or `.5`; no sign.
    pub fn from_decimal(text: &str) -> Option<Self> {
        let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
        let digits = format!("{whole}{fraction}");
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return None;
        }
        let numerator = digits.parse::<IBig>().ok()?;
        let denominator = UBig::from(10u8).pow(fraction.len());
        Some(Self(RBig::from_parts(numerator, denominator)))
    }

    /// The decimal that reads back to this value, where there is a finite one.
    pub fn to_decimal(&self) -> Option<String> {
        let mut places = 0;
        let mut left = self.0.denominator().clone();
        for prime in [2u8, 5u8] {
            let mut times = 0usize;
            while (&left % UBig::from(prime)) == UBig::ZERO {
                left /= UBig::from(prime);
                times += 1;
            }
            places = places.max(times);
        }
        if left != UBig::ONE {
            return None;
        }
        let scale = IBig::from(UBig::from(10u8).pow(places));
        let scaled = (&self.0 * RBig::from(scale)).numerator().clone();
        let sign = if scaled < IBig::ZERO { "-" } else { "" };
        let digits = if scaled < IBig::ZERO { -scaled } else { scaled };
        let digits = digits.to_string();
        let missing = (places + 1).saturating_sub(digits.len());
        let digits = "0".repeat(missing) + &digits;
        let (whole, fraction) = digits.split_at_checked(digits.len() - places)?;
        let point = if fraction.is_empty() { "" } else { "." };
        Some(format!("{sign}{whole}{point}{fraction}"))
    }

    /// The value, where it is an integer within i64.
    pub fn to_integer(&self) -> Option<i64> {
        let whole = self.0.is_int().then(|| self.0.numerator().clone())?;
        i64::try_from(whole).ok()
    }

    /// The value in another field; `None` where the denominator is zero there.
    pub fn embed<F: Field>(&self) -> Option<F> {
        let denominator: F = integer(&IBig::from(self.0.denominator().clone()));
        let numerator: F = integer(self.0.numerator());
        if self.0.is_int() {
            return Some(numerator);
        }
        (!denominator.is_zero()).then(|| numerator / denominator)
    }
}

/// `value` in the field, chunk by chunk where it is beyond an i64.
fn integer<F: Field>(value: &IBig) -> F {
    if let Ok(small) = i64::try_from(value.clone()) {
        return F::from_integer(small);
    }
    let (sign, magnitude) = value.clone().into_parts();
    let bytes = magnitude.to_be_bytes();
    let base = F::from_integer(1 << 8);
    let mut sum = F::zero();
    for byte in bytes.iter() {
        sum = sum * base.clone() + F::from_integer(i64::from(*byte));
    }
    match sign {
        dashu_int::Sign::Positive => sum,
        dashu_int::Sign::Negative => -sum,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact_and_read_back() {
        for (text, ratio) in [
            ("0.26", (13, 50)),
            ("2", (2, 1)),
            (".5", (1, 2)),
            ("1.250", (5, 4)),
            ("0", (0, 1)),
        ] {
            let value = Rational::from_decimal(text).unwrap();
            assert_eq!(Some(value), Rational::new(ratio.0, ratio.1), "{text}");
        }
        for text in ["", ".", "1.2.3", "-1", "1e5", "١"] {
            assert_eq!(Rational::from_decimal(text), None, "{text}");
        }
        let decimal = |n, d| Rational::new(n, d).and_then(|value| value.to_decimal());
        assert_eq!(decimal(13, 50).as_deref(), Some("0.26"));
        assert_eq!(decimal(-1, 8).as_deref(), Some("-0.125"));
        assert_eq!(decimal(1, 20).as_deref(), Some("0.05"));
        assert_eq!(decimal(100, 1).as_deref(), Some("100"));
        assert_eq!(decimal(1, 3), None);
    }

    #[test]
    fn embeds_integers_of_any_size() {
        let big = Rational::from_decimal("123456789012345678901234567890.5").unwrap();
        assert_eq!(big.embed::<Rational>(), Some(big.clone()));
        assert_eq!((-big.clone()).embed::<Rational>(), Some(-big));
    }
}
