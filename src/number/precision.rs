//! A number of digits that is known only when the program runs.

use super::Wide;

/// A computation that can be done in any number of digits.
///
/// The digits of [`Wide`] are part of its type. Where they come from a user, the computation is written once, as a
/// `run` over all `DIGITS`, and [`with_digits`] does it at the next size of [`LADDER`]:
///
/// ```
/// use vibro_audit::number::{AtPrecision, Analytic, Wide, with_digits};
/// struct Pi(usize);
/// impl AtPrecision for Pi {
///     type Output = String;
///     fn run<const DIGITS: usize>(self) -> String {
///         Wide::<DIGITS>::pi().to_decimal(self.0)
///     }
/// }
/// assert_eq!(with_digits(33, Pi(33)).as_deref(), Some("3.14159265358979323846264338327950"));
/// ```
pub trait AtPrecision {
    /// What is computed: nothing that has `DIGITS` in its type, so text, f64 or a narrower `Wide`.
    type Output;
    /// The computation in `DIGITS` digits.
    fn run<const DIGITS: usize>(self) -> Self::Output;
}

macro_rules! ladder {
    ($($digits:literal),*) => {
        /// The sizes there are; each costs a copy of the code that uses it.
        pub const LADDER: &[usize] = &[$($digits),*];

        /// The computation in the least number of digits of [`LADDER`] that is at least `digits`; `None` beyond it.
        pub fn with_digits<C: AtPrecision>(digits: usize, computation: C) -> Option<C::Output> {
            let next = LADDER.iter().copied().find(|size| *size >= digits)?;
            match next {
                $($digits => Some(computation.run::<$digits>()),)*
                _ => None,
            }
        }
    };
}
ladder!(20, 30, 40, 50, 75, 100, 200, 500, 1000);

/// The digits of a type as a number, so that a test can see which was taken.
impl<const DIGITS: usize> Wide<DIGITS> {
    /// The decimal digits that are kept at least.
    pub const DIGITS: usize = DIGITS;
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Taken;
    impl AtPrecision for Taken {
        type Output = usize;
        fn run<const DIGITS: usize>(self) -> usize {
            Wide::<DIGITS>::DIGITS
        }
    }

    #[test]
    fn takes_the_next_size_and_none_beyond_the_last() {
        for (asked, taken) in [(0, 20), (20, 20), (21, 30), (45, 50), (1000, 1000)] {
            assert_eq!(with_digits(asked, Taken), Some(taken));
        }
        assert_eq!(with_digits(1001, Taken), None);
        assert!(LADDER.is_sorted());
    }
}
