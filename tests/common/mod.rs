//! What several tests share; each binary uses a part.

#![allow(dead_code)]

pub mod attacks;
pub mod formulas;
pub mod judge;
pub mod mutants;
pub mod paper;
pub mod program;
pub mod rewrite;
pub mod rocq;
pub mod sample;
pub mod trees;
