//! The exact normal form: polynomials and rational functions over the rationals, side relations, derivations and
//! the elimination of premises. Nothing here knows what a variable stands for.

mod arithmetic;
mod derivation;
mod division;
mod elimination;
mod fraction;
mod monomial;
mod polynomial;
mod relation;

pub use derivation::Derivation;
pub use elimination::{Failure, Premise, Rank, Solution, Step, solve};
pub use fraction::{Fraction, Undefined};
pub use monomial::{Monomial, Variable};
pub use polynomial::Polynomial;
pub use relation::{Relation, square_root};
