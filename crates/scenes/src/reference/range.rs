//! A range, as a paper prints it.

use super::figures::Figures;
use std::fmt;

/// The ends of a range; one that is not there is open.
pub struct Range {
    pub from: Option<Figures>,
    pub to: Option<Figures>,
}

impl Range {
    /// Reads `(a, b)`, `< b` and `> a`.
    pub fn read(text: &str) -> Option<Self> {
        let end = |text: &str| Figures::read(text.trim());
        let (from, to) = if let Some(to) = text.strip_prefix('<') {
            (None, Some(end(to)?))
        } else if let Some(from) = text.strip_prefix('>') {
            (Some(end(from)?), None)
        } else {
            let (from, to) = text.strip_prefix('(')?.strip_suffix(')')?.split_once(',')?;
            (Some(end(from)?), Some(end(to)?))
        };
        Some(Self { from, to })
    }

    /// The ends that there are.
    pub fn ends(&self) -> impl Iterator<Item = &Figures> {
        self.from.iter().chain(&self.to)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.from, &self.to) {
            (Some(from), Some(to)) => write!(f, "({from}, {to})"),
            (Some(from), None) => write!(f, "> {from}"),
            (None, Some(to)) => write!(f, "< {to}"),
            (None, None) => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_range_is_not_read() {
        for text in ["", "<", "< a", "(1, 2", "(1; 2)", "60000 <", "(1, )"] {
            assert!(Range::read(text).is_none(), "{text}");
        }
    }
}
