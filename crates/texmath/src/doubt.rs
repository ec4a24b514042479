//! Places of a formula that have more than one meaning, of which the reader took one.

use super::{At, Name, Tree};
use std::fmt;
use std::hash::{Hash, Hasher};

/// A place with more than one meaning, of which one was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    pub kind: DoubtKind,
    /// The place in the TeX.
    pub at: At,
}

/// The meanings that a place may have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DoubtKind {
    /// `V(x^2)`, taken as a product.
    Argument { of: Name, inside: Tree },
    /// `\frac{d}{dx}[F]_{x=a}`, taken as the derivative at that point; where no reading is listed, as that of the value.
    DerivativeOfValue { of: Tree, readings: Vec<OtherReading> },
    /// `(F)'(a)`, `\frac{dV}{dx}(a)`, taken as the derivative at that point; where no reading is listed, as a product.
    DerivativeBeforeBracket {
        of: Tree,
        inside: Tree,
        readings: Vec<OtherReading>,
    },
    /// `\sum_k F + G`, `\frac{d}{dx} F + G`, taken as one that ends at the sign.
    Reach { letter: Name, readings: Vec<OtherReading> },
    /// `\int_a^b \int_c^d F \, dx \, dy`, taken as closed from the inside.
    Nesting { inner: Name, readings: Vec<OtherReading> },
    /// `[F]_{x=a}^2`, taken as a difference.
    Difference { upper: Tree },
    /// `f^2(x)`, taken as a power of the value.
    PowerOfFunction { of: Name, readings: Vec<OtherReading> },
    /// `x^{n/2}`, taken of bases that are not negative.
    PowerOfSign { base: Tree, exponent: Tree },
    /// `x^{1/3}`, taken of bases that are not negative: the cube root is one of all real numbers.
    OddRoot { power: Tree },
    /// A letter in a claim that nothing bounds, taken for every value.
    OfSome(Name),
    /// A premise that is written for one step of an index, taken for that step alone.
    OneStep { index: String },
    /// `x \to a` in what is assumed, taken as if it were not there.
    Tends(Name),
    /// What a premise is divided by to solve it, which is 0 where the claim fails.
    Factor { factor: String, premise: String },
    /// What was guessed of a formula that nothing is said of.
    Guess(String),
    /// What a document leaves open, as a letter before a bracket.
    Open(String),
    /// That letters are marked as more than real numbers.
    Marked(String),
}

/// A reading of a place other than the one taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherReading {
    pub taken: Tree,
    pub other: Tree,
}

impl DoubtKind {
    /// The other readings of the place; none where not all are known.
    pub fn readings(&self) -> &[OtherReading] {
        match self {
            Self::Reach { readings, .. }
            | Self::Nesting { readings, .. }
            | Self::PowerOfFunction { readings, .. }
            | Self::DerivativeOfValue { readings, .. }
            | Self::DerivativeBeforeBracket { readings, .. } => readings,
            _ => &[],
        }
    }

    /// Returns true if a proof stands: the meaning that was taken is the usual one, or the claim holds under the others where it
    /// does under this one.
    pub fn spares_proofs(&self) -> bool {
        match self {
            // for a product of one factor nobody writes brackets
            Self::Argument { inside, .. } => matches!(inside, Tree::Sum(_)),
            Self::DerivativeOfValue { readings, .. } | Self::DerivativeBeforeBracket { readings, .. } => {
                !readings.is_empty()
            }
            Self::PowerOfSign { .. } | Self::OddRoot { .. } | Self::Open(_) | Self::Marked(_) => false,
            _ => true,
        }
    }
}

impl fmt::Display for DoubtKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Argument { of, inside } => {
                write!(
                    f,
                    "`{of}({inside})`: the value of `{of}` at `{inside}`, or `{of}` times `{inside}`?"
                )
            }
            Self::DerivativeOfValue { of, .. } => {
                write!(
                    f,
                    "the derivative of `{of}`: taken at that point, or of the value there?"
                )
            }
            Self::DerivativeBeforeBracket { of, inside, .. } => {
                write!(
                    f,
                    "`({inside})` behind `{of}`: where the derivative is taken, or a factor?"
                )
            }
            Self::Reach { letter, .. } => {
                write!(
                    f,
                    "the sum, product, limit or derivative over `{letter}`: up to the next sign, or to the end?"
                )
            }
            Self::Nesting { inner, .. } => {
                write!(
                    f,
                    "the integral over `{inner}`: with the limits of the inner sign, or of the outer?"
                )
            }
            Self::Difference { upper } => {
                write!(f, "`{upper}` behind the bracket: the upper limit, or a power?")
            }
            Self::PowerOfFunction { of, .. } => {
                write!(
                    f,
                    "the power of `{of}` before its argument: of the value, or `{of}` applied again?"
                )
            }
            Self::OddRoot { power } => write!(
                f,
                "`{power}`: of numbers that are not negative alone, or of all real ones?"
            ),
            Self::PowerOfSign { base, exponent } => write!(
                f,
                "`{base}` to the power `{exponent}`: where `{base}` is not negative, or where `{exponent}` is an integer too?"
            ),
            Self::OfSome(name) => write!(f, "`{name}`: every value, or some value?"),
            Self::OneStep { index } => {
                write!(
                    f,
                    "the premises that take one `{index}` to the next: for this `{index}` alone, or for each?"
                )
            }
            Self::Tends(name) => write!(f, "`{name}` tends to a value: for every `{name}`, or near that value?"),
            Self::Factor { factor, premise } => write!(
                f,
                "({premise}) can be solved where `{factor}` is not 0: 0 too, or divided by?"
            ),
            Self::Guess(what) | Self::Open(what) | Self::Marked(what) => write!(f, "{what}"),
        }
    }
}

/// The doubts of an equation. They take no part in comparisons.
#[derive(Clone, Debug, Default)]
pub struct Doubts(pub Vec<Doubt>);

impl PartialEq for Doubts {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
impl Eq for Doubts {}
impl Hash for Doubts {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}
