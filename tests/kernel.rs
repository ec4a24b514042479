//! The kernel against whoever searches for certificates: what it must not accept, whatever it is handed.
//!
//! `attacks` holds one test for each hole that was found by reading: a certificate or a witness that was accepted
//! once, and the wrong verdict that it would have made.

#[path = "kernel/attacks.rs"]
mod attacks;
#[path = "kernel/axioms.rs"]
mod axioms;
#[path = "kernel/breaks.rs"]
mod breaks;
#[path = "kernel/digits.rs"]
mod digits;
#[path = "kernel/forge.rs"]
mod forge;
