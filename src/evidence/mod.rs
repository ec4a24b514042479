//! Numeric witnesses beside verdicts.
