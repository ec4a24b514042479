//! What a golden row is about: a column of a command.

use std::fmt;
use std::str::FromStr;

/// `command.column`, `command.column[n]`, and either with `.min`, `.max`, `.spread`, `.trend` or `.count`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The command whose table has the column.
    pub command: String,
    /// The column, and which number of its list.
    pub field: FieldName,
    /// What is asked of several rows, instead of one row's value.
    pub across: Option<Across>,
}

/// A column, and in a list joined by `;` the number counted from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldName {
    /// The name in the header.
    pub column: String,
    /// Which of the list.
    pub index: Option<usize>,
}

/// What is asked of several rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Across {
    /// The least value.
    Least,
    /// The greatest value.
    Greatest,
    /// The greatest less the least.
    Spread,
    /// Which way the values go from row to row: `increases`, `decreases` or `neither`.
    Trend,
    /// How many rows they are; none is an answer too.
    Count,
}

impl Across {
    const ALL: [Self; 5] = [Self::Least, Self::Greatest, Self::Spread, Self::Trend, Self::Count];

    /// As it stands behind the column.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Least => "min",
            Self::Greatest => "max",
            Self::Spread => "spread",
            Self::Trend => "trend",
            Self::Count => "count",
        }
    }
}

/// Text that names no quantity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no quantity: `command.column` or `command.column[n]` is, such as \
     orbits.velocities[0]; `.min`, `.max`, `.spread`, `.trend` or `.count` may follow"
)]
pub struct NoQuantity(pub String);

impl FromStr for FieldName {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let (column, index) = match text.split_once('[') {
            Some((column, rest)) => {
                let digits = rest.strip_suffix(']').ok_or(())?;
                let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
                let index = digits.parse().map_err(drop)?;
                (column, plain.then_some(Some(index)).ok_or(())?)
            }
            None => (text, None),
        };
        let named = !column.is_empty() && column.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        named
            .then(|| Self {
                column: column.to_owned(),
                index,
            })
            .ok_or(())
    }
}

impl FromStr for Quantity {
    type Err = NoQuantity;

    fn from_str(text: &str) -> Result<Self, NoQuantity> {
        let bad = || NoQuantity(text.to_owned());
        let (command, rest) = text.split_once('.').ok_or_else(bad)?;
        let asked = |(field, name)| {
            let across = Across::ALL.into_iter().find(|across| across.name() == name);
            across.map(|across| (field, Some(across)))
        };
        let (field, across) = rest.rsplit_once('.').and_then(asked).unwrap_or((rest, None));
        let named = !command.is_empty() && command.bytes().all(|byte| byte.is_ascii_lowercase());
        if !named {
            return Err(bad());
        }
        Ok(Self {
            command: command.to_owned(),
            field: field.parse().map_err(|()| bad())?,
            across,
        })
    }
}

impl fmt::Display for FieldName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.column)?;
        self.index.map_or(Ok(()), |index| write!(f, "[{index}]"))
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.command, self.field)?;
        self.across.map_or(Ok(()), |across| write!(f, ".{}", across.name()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_read_back_as_written() {
        for text in [
            "orbits.velocities[0]",
            "branch.d",
            "audit.verdict",
            "branch.velocities[12].max",
            "branch.error_bound.min",
            "sweep.mean_voltage.spread",
            "branch.velocities[0].trend",
            "simulate.velocity.count",
        ] {
            assert_eq!(
                text.parse::<Quantity>().map(|quantity| quantity.to_string()).as_deref(),
                Ok(text)
            );
        }
    }

    #[test]
    fn what_names_no_column_is_refused() {
        for text in [
            "",
            "orbits",
            "orbits.",
            ".d",
            "orbits.v[",
            "orbits.v[-1]",
            "orbits.v[+1]",
            "orbits.v[]",
            "orbits.v[1",
            "orbits.v[1].mean",
            "orbits.a.b",
            "Orbits.d",
            "orbits.v[99999999999999999999]",
        ] {
            assert!(text.parse::<Quantity>().is_err(), "{text}");
        }
    }
}
