//! What several tests share.

pub mod formulas;
pub mod trees;
