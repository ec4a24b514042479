//! What several tests share.

pub mod formulas;
