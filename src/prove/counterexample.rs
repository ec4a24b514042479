//! Points at which the premises of a claim hold and the claim does not.

use std::fmt;

/// A point, in the names of the sheet, and the two sides of the claim there.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The symbols that premises and claim speak of, with their values.
    pub point: Vec<(String, String)>,
    pub left: String,
    pub right: String,
    /// The terms of the two sides with their values.
    pub terms: Vec<(String, String)>,
}

impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value) in &self.point {
            write!(f, "{name}={value}; ")?;
        }
        write!(f, "left={}; right={}", self.left, self.right)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counterexample_is_one_line() {
        let text = |a: &str, b: &str| (a.to_string(), b.to_string());
        let counterexample = Counterexample {
            point: vec![text("r_B", "1/2"), text("T", "2")],
            left: "2".to_string(),
            right: "3".to_string(),
            terms: Vec::new(),
        };
        assert_eq!(counterexample.to_string(), "r_B=1/2; T=2; left=2; right=3");
    }
}
