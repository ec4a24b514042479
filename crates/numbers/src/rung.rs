//! The number types that means are compared and chosen in, from the narrowest to the widest.

use std::fmt;

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rung {
    /// f32.
    Single,
    /// f64.
    Double,
    /// [`DoubleDouble`](super::DoubleDouble).
    DoubleDouble,
    /// [`Wide`](super::Wide) with so many decimal digits.
    Wide(u32),
}

impl Rung {
    /// Those that are compared and chosen from.
    pub const ALL: [Self; 6] = [
        Self::Single,
        Self::Double,
        Self::DoubleDouble,
        Self::Wide(50),
        Self::Wide(100),
        Self::Wide(200),
    ];

    /// The rung of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rung| rung.to_string() == name)
    }

    /// The decimal digits that the type keeps at least.
    pub fn digits(self) -> u32 {
        match self {
            Self::Single => 7,
            Self::Double => 16,
            Self::DoubleDouble => 31,
            Self::Wide(digits) => digits,
        }
    }

    /// The number to begin with where so many digits are asked of an answer: the narrowest one that is likely to bound it
    /// so closely, else the widest. A narrower number costs a fraction of the next wider one and what it falls short by is
    /// seen on the answer itself, so a wrong choice costs time and no digit.
    ///
    /// The error bounds of an answer take two digits or so off a number of the machine, or of two; the wider numbers carry
    /// some digits more than they are named by.
    pub fn reaching(digits: u32) -> Self {
        let lost = |rung: Self| match rung {
            Self::Single | Self::Double | Self::DoubleDouble => 2,
            Self::Wide(_) => 0,
        };
        let mut rungs = Self::Double.and_wider();
        let found = rungs.find(|rung| rung.digits() >= digits.saturating_add(lost(*rung)));
        found.unwrap_or(Self::ALL[Self::ALL.len() - 1])
    }

    /// This one and those wider, in order.
    pub fn and_wider(self) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |rung| *rung >= self)
    }
}

impl fmt::Display for Rung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Single => f.pad("f32"),
            Self::Double => f.pad("f64"),
            Self::DoubleDouble => f.pad("double-double"),
            Self::Wide(digits) => f.pad(&format!("{digits}-digits")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rungs_are_in_order_and_have_names_and_the_digits_of_their_types() {
        for rung in Rung::ALL {
            assert_eq!(Rung::named(&rung.to_string()), Some(rung));
            let digits: Vec<u32> = rung.and_wider().map(Rung::digits).collect();
            assert!(digits.is_sorted() && digits[0] == rung.digits());
        }
        assert_eq!(Rung::named("f16"), None);
    }
}
