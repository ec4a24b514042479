//! Formulas: read, decided, proved, refuted, and what is printed of them.

#[path = "../common/mod.rs"]
mod common;

mod attacks;
mod audit;
mod claims;
mod documents;
mod edits;
mod evidence;
mod handbook;
mod hard_cases;
mod integrals;
mod kernel;
mod limits;
mod papers;
mod proofs;
mod reductions;
mod repairs;
mod rewriting;
mod rocq;
mod sheets;
mod tex;
mod textbook;
