//! Sums and products of two f64 with the rounding error beside them, both exact.
//!
//! Muller et al., "Handbook of Floating-Point Arithmetic", 2nd edition 2018, sections 4.3 and 4.4.

/// The rounded sum and its error (Knuth and Møller); exact unless the sum overflows.
#[inline]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// The same for |a| >= |b| or a = 0, in half the operations (Dekker).
#[inline]
pub(crate) fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The rounded product and its error, for factors below 2^995 in size and a product that is 0 or above 2^-968.
///
/// By one fused operation where the machine is compiled for with one; else by Dekker's splitting, since the
/// function that stands in for the operation is slower.
#[inline]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    if cfg!(target_feature = "fma") {
        return (product, a.mul_add(b, -product));
    }
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

/// Two halves of 26 bits (Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const FACTOR: f64 = ((1_u64 << 27) + 1) as f64;
    let scaled = FACTOR * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::super::Sequence;
    use super::*;

    #[test]
    fn sum_and_product_are_exact_with_their_errors() {
        let mut sequence = Sequence::new(5);
        for _ in 0..1000 {
            let (a, b) = (sequence.between(-1e9, 1e9), sequence.between(-1.0, 1.0));
            // the correctly rounded fused operation is the reference
            assert_eq!(two_product(a, b), (a * b, a.mul_add(b, -(a * b))));
            let (sum, error) = two_sum(a, b);
            assert_eq!(two_sum(b, a), (sum, error));
            assert_eq!(
                quick_two_sum(a.max(b.abs()), b.min(1.0)),
                two_sum(a.max(b.abs()), b.min(1.0))
            );
            assert!(error.abs() <= sum.abs() * f64::EPSILON / 2.0);
        }
        assert_eq!(two_sum(1.0, 1e-30), (1.0, 1e-30));
    }
}
