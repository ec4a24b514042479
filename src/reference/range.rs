//! A range, as a paper prints it.

use super::Verdict;
use super::compare::{Comparison, plain, shown};
use super::computed::Value;
use super::figures::Figures;
use crate::number::Rational;
use std::fmt;

/// The ends of a range; one that is not there is open.
pub struct Range {
    from: Option<Figures>,
    to: Option<Figures>,
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

    /// `reproduced` where the number lies strictly within, whatever its bound leaves open, `wrong` where it does not.
    pub fn compare(&self, number: &Rational, computed: &Value) -> Comparison {
        let places = self.ends().map(|end| end.places).max().unwrap_or(0);
        let shown = shown(number, places, computed);
        let Some(bound) = &computed.bound else {
            let reason = format!("no bound of the computed value is certified: nothing is decided; computed {shown}");
            return Comparison::new(Verdict::Undecided, None, reason);
        };
        let (least, most) = (number.clone() - bound.clone(), number.clone() + bound.clone());
        let from = self.from.as_ref().map(|end| &end.value);
        let to = self.to.as_ref().map(|end| &end.value);
        if from.is_none_or(|from| *from < least) && to.is_none_or(|to| most < *to) {
            return Comparison::new(Verdict::Reproduced, None, String::new());
        }
        if from.is_some_and(|from| most <= *from) || to.is_some_and(|to| *to <= least) {
            let which = if self.ends().count() > 1 { "outside" } else { "not" };
            let reason = format!("computed {shown}, which is {which} {self}");
            return Comparison::new(Verdict::Wrong, None, reason);
        }
        let reason = format!("computed {shown}, too near an end of {self} to tell");
        Comparison::new(Verdict::Undecided, None, reason)
    }

    fn ends(&self) -> impl Iterator<Item = &Figures> {
        self.from.iter().chain(&self.to)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.from, &self.to) {
            (Some(from), Some(to)) => write!(f, "({}, {})", plain(from), plain(to)),
            (Some(from), None) => write!(f, "> {}", plain(from)),
            (_, to) => write!(f, "< {}", to.as_ref().map(plain).unwrap_or_default()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(range: &str, computed: &str, bound: Option<&str>) -> (Verdict, String) {
        let value = Value {
            text: computed.to_owned(),
            bound: bound.and_then(Figures::read).map(|figures| figures.value),
        };
        let number = Figures::read(computed).unwrap().value;
        let found = Range::read(range).unwrap().compare(&number, &value);
        (found.verdict, found.reason)
    }

    #[test]
    fn a_range_open_to_a_side_has_one_end() {
        assert_eq!(verdict("< 60000", "58670.78", Some("1e-3")).0, Verdict::Reproduced);
        let (found, reason) = verdict("<60000", "61152.5", Some("1e-3"));
        assert_eq!(found, Verdict::Wrong);
        assert!(reason.ends_with("which is not < 60000"), "{reason}");
        assert_eq!(verdict("> 0", "-0.5", Some("1e-3")).0, Verdict::Wrong);
        assert_eq!(verdict("> 0", "1e-4", Some("1e-3")).0, Verdict::Undecided);
        assert_eq!(verdict("> 0", "0.5", None).0, Verdict::Undecided);
    }

    #[test]
    fn what_is_no_range_is_not_read() {
        for text in ["", "<", "< a", "(1, 2", "(1; 2)", "60000 <", "(1, )"] {
            assert!(Range::read(text).is_none(), "{text}");
        }
    }
}
