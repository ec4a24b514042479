//! What a golden row is about: a column of a command.

use std::fmt;
use std::str::FromStr;

/// `command.column`, `command.column[n]`, and either with `.min` or `.max`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The command whose table has the column.
    pub command: String,
    /// The column, and which number of its list.
    pub field: FieldName,
    /// Of several rows: the least or the greatest value, instead of one row's.
    pub extreme: Option<Extreme>,
}

/// A column, and in a list joined by `;` the number counted from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldName {
    /// The name in the header.
    pub column: String,
    /// Which of the list.
    pub index: Option<usize>,
}

/// Which value of several rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The least.
    Least,
    /// The greatest.
    Greatest,
}

/// Text that names no quantity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no quantity: `command.column` or `command.column[n]` is, such as \
     orbits.velocities[0]; `.min` or `.max` may follow"
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
        let (field, extreme) = match rest.rsplit_once('.') {
            Some((field, "min")) => (field, Some(Extreme::Least)),
            Some((field, "max")) => (field, Some(Extreme::Greatest)),
            _ => (rest, None),
        };
        let named = !command.is_empty() && command.bytes().all(|byte| byte.is_ascii_lowercase());
        if !named {
            return Err(bad());
        }
        Ok(Self {
            command: command.to_owned(),
            field: field.parse().map_err(|()| bad())?,
            extreme,
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
        f.write_str(match self.extreme {
            Some(Extreme::Least) => ".min",
            Some(Extreme::Greatest) => ".max",
            None => "",
        })
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
