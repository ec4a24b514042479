//! What the reader sees of the source.

use super::{Invariant, Relation, Series};

/// The kinds of visible brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bracket {
    Round,
    Square,
    Curly,
    /// The bars of an absolute value.
    Bar,
    /// The double bars of a norm.
    DoubleBar,
    /// `\lfloor`, around what is rounded down.
    Floor,
    /// `\lceil`, around what is rounded up.
    Ceiling,
    /// `\begin{pmatrix}` and its like: rows and columns.
    Rows(Rows),
}

/// What an environment of rows means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rows {
    Matrix,
    Determinant,
    Cases,
}

/// The sets of numbers that a condition may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Set {
    Real,
    Integer,
    Complex,
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Digits, perhaps with a decimal point.
    Number,
    /// A Latin letter, or a command that prints one.
    Letter,
    /// A word set upright: `\mathrm{Tr}`, `\text{in}`; the text is the word alone.
    Word,
    Accent,
    /// An elementary function; the text is its command.
    Function,
    Invariant(Invariant),
    Fraction,
    Root,
    Partial,
    /// `\sum`, `\prod`.
    Series(Series),
    /// `\int`.
    Integral,
    /// `\lim`.
    Limit,
    /// `\to`; from above, true, for `\downarrow`, from below for `\uparrow`.
    To(Option<bool>),
    Open(Bracket),
    Close(Bracket),
    BraceOpen,
    BraceClose,
    Sub,
    Sup,
    Prime,
    Plus,
    Minus,
    PlusMinus,
    MinusPlus,
    Times,
    Star,
    Slash,
    Relation(Relation),
    /// `\approx`.
    Approximately,
    /// A bar that does not show whether it opens or closes.
    Bar,
    /// A double bar that does not show it either.
    DoubleBar,
    /// `\in`.
    Element,
    Set(Set),
    Infinity,
    /// The sign of an angle in degrees: `\circ`, raised, or a character that prints raised.
    Degree,
    /// `\max` or `\min`.
    Extremum,
    /// `!`.
    Factorial,
    Binomial,
    Comma,
    Stop,
    /// Dots in the place of terms or factors.
    Dots,
    /// `&`, which prints nothing.
    Column,
    Row,
    Quad,
    /// `\text{if}`, `\text{even}` and other words of a case.
    Said,
    /// `\text{and}` and its like between equations.
    And,
}

/// A token: its kind, its canonical text, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub kind: Kind,
    pub text: &'a str,
    pub at: usize,
    pub end: usize,
    /// The rest of a number whose first digit went to a script or an argument, as the 2 of `\frac12`.
    pub split: bool,
    /// A single letter in a font of its own, as in `\mathrm{T}`.
    pub styled: bool,
    /// Behind a blank that prints, as `\,` does.
    pub spaced: bool,
}
