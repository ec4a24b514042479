#![doc = include_str!("../README.md")]
// Library code never panics by its own word: errors are returned.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

mod check;
mod circle;
mod definition;
mod determining;
mod document;
mod doubts;
mod elaborate;
mod entry;
mod exponents;
mod fault;
mod fingerprint;
mod function;
mod functional;
mod implication;
mod kinds;
mod naming;
mod paper;
mod premise;
mod reduce;
mod sheet;
mod size;
mod spelling;
mod symbols;
mod verdict;
mod words;

pub use definition::Local;
pub use document::{Document, Include, Markup, PrintedNumber};
pub use elaborate::{MapStep, Question, Unreadable, questions};
pub use entry::{Entry, Role, Standing};
pub use fault::{Fault, Source};
pub use fingerprint::Fingerprint;
pub use naming::{Named, Names};
pub use paper::{EQUATIONS, SYMBOLS, paper, vocabulary};
pub use premise::{Premise, Statements};
pub use reduce::{
    Conditional, Goal, KnownIntegral, Matched, Multiple, Proposal, Proposals, Provided, Reduced, Row, Rule, Rules,
    SeriesTest, Test, along_a_sequence, by_induction, divisors, known_integrals, number_in, of_nothing, other_ways,
    reduced, reduced_by_cases, sign_cases, thin_domains, under_conditions, values,
};
pub use sheet::{Sheet, read_symbols};
pub use verdict::Verdict;
pub use words::word_question;
