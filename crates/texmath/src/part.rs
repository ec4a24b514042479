//! A piece of formula as it was written, and what may stand beside it.

use super::error::Fault;
use super::token::{Kind, Token};
use super::{Name, Tree};

/// The symbol in the place of the differential of an integral while the integrand is read.
pub(super) const DIFFERENTIAL: &str = "\\differential";

pub(super) fn is_differential(tree: &Tree) -> bool {
    matches!(tree, Tree::Symbol(name, _) if *name == Name::plain(DIFFERENTIAL))
}

/// How a piece of formula was written, as far as it bears on what may stand beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// A bare number.
    Literal,
    /// A fraction: a power of it needs brackets.
    Fraction,
    /// A product or a power: a power of it needs brackets, even where TeX braces stand around it.
    Knot,
    /// What ends in a function with an argument that no brackets close, as `\cos x`: what follows would print as
    /// part of the argument.
    Bare,
    /// A sum, a negation or a quotient with a slash.
    Open,
    /// Such a one between TeX braces, which do not print: nothing may stand beside it.
    Braced,
    /// All else, which stands for itself.
    Plain,
    /// Between visible brackets.
    Bracketed,
}

/// A tree and how it was written. The box keeps the stack of the recursive reader small.
pub(super) struct Part {
    pub tree: Box<Tree>,
    pub form: Form,
}

/// Refuses neighbours that print as something else: `2 3`, `2\frac{1}{2}`; `token` is the first of the factor that
/// prints.
pub(super) fn readable(before: Form, factor: &Part, token: Token<'_>) -> Result<(), Fault> {
    let literal = token.kind == Kind::Number;
    let numbers = matches!(&*factor.tree, Tree::Quotient(above, below, _)
        if matches!((&**above, &**below), (Tree::Number(_), Tree::Number(_))));
    let after_number = before == Form::Literal;
    let mixed = after_number && factor.form == Form::Fraction && numbers;
    if mixed || (literal && (after_number || token.text.starts_with('.'))) {
        let instead = "write \\cdot between them";
        return Err(Fault::ambiguous(
            token.at,
            "a number right after another factor",
            instead,
        ));
    }
    Ok(())
}

/// Whether a factor may begin with a token of this kind.
pub(super) fn starts_factor(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Number
            | Kind::Letter
            | Kind::Word
            | Kind::Accent
            | Kind::Function
            | Kind::Invariant(_)
            | Kind::Fraction
            | Kind::Root
            | Kind::Partial
            | Kind::Series(_)
            | Kind::Integral
            | Kind::Limit
            | Kind::Extremum
            | Kind::Binomial
            | Kind::Open(_)
            | Kind::BraceOpen
    )
}

/// The product of one factor or several.
pub(super) fn product(mut factors: Vec<Tree>) -> Box<Tree> {
    Box::new(match factors.len() {
        1 => factors.remove(0),
        _ => Tree::Product(factors),
    })
}
