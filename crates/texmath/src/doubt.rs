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
    /// `V(x^2)`, taken as the value of `V` there; where no reading is listed, as a product.
    Argument {
        of: Name,
        inside: Tree,
        readings: Vec<OtherReading>,
    },
    /// `\frac{d}{dx}[F]_{x=a}`, taken as the derivative at that point; where no reading is listed, as that of the value.
    DerivativeOfValue { of: Tree, readings: Vec<OtherReading> },
    /// `(F)'(a)`, `\frac{dV}{dx}(a)`, taken as the derivative at that point; where no reading is listed, as a product.
    DerivativeBeforeBracket {
        of: Tree,
        inside: Tree,
        readings: Vec<OtherReading>,
    },
    /// `\exp x \exp y`, `\sin x y`, `a/b c`, taken as a product: what follows may belong to the argument or the divisor.
    Extent {
        readings: Vec<OtherReading>,
        /// True if all authors that write so mean the product.
        is_usual: bool,
    },
    /// `\frac{df}{dx}` of a function of several arguments, taken with the others held fixed.
    TotalDerivative { of: Name, by: Name },
    /// `\sum_k F + G`, `\frac{d}{dx} F + G`, taken as one that ends at the sign.
    Reach { letter: Name, readings: Vec<OtherReading> },
    /// `\int_a^b \int_c^d F \, dx \, dy`, taken as closed from the inside.
    Nesting { inner: Name, readings: Vec<OtherReading> },
    /// `[F]_{x=a}^2`, taken as a difference.
    Difference { upper: Tree },
    /// `f^2(x)`, taken as a power of the value.
    PowerOfFunction { of: Name, readings: Vec<OtherReading> },
    /// `\sin^{-1} x`, taken as the inverse function.
    Inverse {
        of: &'static str,
        readings: Vec<OtherReading>,
    },
    /// `x^{n/2}`, taken of bases that are not negative.
    PowerOfSign { base: Tree, exponent: Tree },
    /// `x^{1/3}`, taken of bases that are not negative: the cube root is one of all real numbers.
    OddRoot { power: Tree },
    /// `\log x`, taken as the natural logarithm; `\ln` beside it speaks for another base.
    Logarithm { is_beside_ln: bool },
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
    /// `e` or `i` in a document that does not say that it is the number, taken for it.
    Constant(String),
    /// A letter of a document within a derivative or integral by another, taken not to vary with it: ``` `m` as `t` varies```.
    Held(String),
    /// A formula of a document that gives a letter another value, taken to hold beside the first.
    SecondValue(String),
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
            Self::Argument { readings, .. }
            | Self::Extent { readings, .. }
            | Self::Reach { readings, .. }
            | Self::Nesting { readings, .. }
            | Self::PowerOfFunction { readings, .. }
            | Self::Inverse { readings, .. }
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
            Self::Argument { inside, readings, .. } => !readings.is_empty() || matches!(inside, Tree::Sum(_)),
            Self::DerivativeOfValue { readings, .. } | Self::DerivativeBeforeBracket { readings, .. } => {
                !readings.is_empty()
            }
            Self::Extent { is_usual, .. } => *is_usual,
            Self::Logarithm { is_beside_ln } => !is_beside_ln,
            Self::TotalDerivative { .. }
            | Self::PowerOfSign { .. }
            | Self::OddRoot { .. }
            | Self::SecondValue(_)
            | Self::Open(_)
            | Self::Marked(_) => false,
            _ => true,
        }
    }
}

/// The meanings of a place of a formula: the one that is taken, and another.
struct Choice {
    place: String,
    meanings: [String; 2],
}

impl Choice {
    fn of(place: String, taken: &str, other: &str) -> Self {
        let meanings = [taken, other].map(str::to_owned);
        Self { place, meanings }
    }

    /// The choice where the second meaning is taken, if it is.
    fn swapped_if(mut self, is_second: bool) -> Self {
        if is_second {
            self.meanings.reverse();
        }
        self
    }
}

impl DoubtKind {
    /// The meanings of the place; none of what is said of the document alone.
    fn choice(&self) -> Option<Choice> {
        let choice = match self {
            Self::Argument { of, inside, readings } => {
                let meanings = [
                    format!("the value of `{of}` at `{inside}`"),
                    format!("`{of}` times `{inside}`"),
                ];
                let place = format!("`{of}({inside})`");
                Choice { place, meanings }.swapped_if(readings.is_empty())
            }
            Self::DerivativeOfValue { of, readings } => {
                let place = format!("the derivative of `{of}`");
                Choice::of(place, "taken at that point", "of the value there").swapped_if(readings.is_empty())
            }
            Self::DerivativeBeforeBracket { of, inside, readings } => {
                let place = format!("`({inside})` behind `{of}`");
                Choice::of(place, "where the derivative is taken", "a factor").swapped_if(readings.is_empty())
            }
            Self::Extent { readings, .. } => {
                let [OtherReading { taken, other }, ..] = readings.as_slice() else {
                    return None;
                };
                let meanings = [taken, other].map(|tree| format!("`{tree}`"));
                let place = "what follows an argument or a divisor".to_owned();
                Choice { place, meanings }
            }
            Self::TotalDerivative { of, by } => Choice {
                place: format!("the derivative of `{of}` by `{by}`"),
                meanings: [
                    "the other arguments held fixed".to_owned(),
                    format!("depending on `{by}`"),
                ],
            },
            Self::Reach { letter, .. } => Choice::of(
                format!("the sum, product, limit or derivative over `{letter}`"),
                "up to the next sign",
                "to the end",
            ),
            Self::Nesting { inner, .. } => Choice::of(
                format!("the integral over `{inner}`"),
                "with the limits of the inner sign",
                "of the outer",
            ),
            Self::Difference { upper } => {
                Choice::of(format!("`{upper}` behind the bracket"), "the upper limit", "a power")
            }
            Self::PowerOfFunction { of, .. } => Choice {
                place: format!("the power of `{of}` before its argument"),
                meanings: ["of the value".to_owned(), format!("`{of}` applied again")],
            },
            Self::Inverse { of, .. } => Choice::of(format!("`{of}^{{-1}}`"), "the inverse function", "a power"),
            Self::OddRoot { power } => Choice::of(
                format!("`{power}`"),
                "of numbers that are not negative alone",
                "of all real ones",
            ),
            Self::PowerOfSign { base, exponent } => Choice {
                place: format!("`{base}` to the power `{exponent}`"),
                meanings: [
                    format!("where `{base}` is not negative"),
                    format!("where `{exponent}` is an integer too"),
                ],
            },
            Self::Logarithm { .. } => Choice::of(r"`\log`".to_owned(), "natural", "to another base"),
            Self::OfSome(name) => Choice::of(format!("`{name}`"), "every value", "some value"),
            Self::OneStep { index } => Choice {
                place: format!("the premises that take one `{index}` to the next"),
                meanings: [format!("for this `{index}` alone"), "for each".to_owned()],
            },
            Self::Tends(name) => Choice {
                place: format!("`{name}` tends to a value"),
                meanings: [format!("for every `{name}`"), "near that value".to_owned()],
            },
            Self::Constant(letter) => {
                let number = match letter.as_str() {
                    "e" => "the base of logarithms",
                    _ => "the imaginary unit",
                };
                Choice::of(format!("`{letter}`"), number, "a letter")
            }
            Self::Held(place) => Choice::of(place.clone(), "constant", "moves with it"),
            Self::SecondValue(_) | Self::Factor { .. } | Self::Guess(_) | Self::Open(_) | Self::Marked(_) => {
                return None;
            }
        };
        Some(choice)
    }

    /// The meaning that was taken where the notation has another too, as the column `reading` says it.
    pub fn taken(&self) -> Option<String> {
        let Choice {
            place,
            meanings: [taken, _],
        } = self.choice()?;
        Some(format!("{place}: {taken}"))
    }

    /// The other meaning, said likewise.
    pub fn other(&self) -> Option<String> {
        let Choice {
            place,
            meanings: [_, other],
        } = self.choice()?;
        Some(format!("{place}: {other}"))
    }
}

impl fmt::Display for DoubtKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.choice(), self) {
            (
                Some(Choice {
                    place,
                    meanings: [taken, other],
                }),
                _,
            ) => write!(f, "{place}: {taken}, or {other}?"),
            (None, Self::Factor { factor, premise }) => write!(
                f,
                "({premise}) can be solved where `{factor}` is not 0: 0 too, or divided by?"
            ),
            (None, Self::SecondValue(label)) => write!(f, "({label}) may give its letter a new meaning"),
            (None, Self::Guess(what) | Self::Open(what) | Self::Marked(what)) => write!(f, "{what}"),
            (None, _) => Ok(()),
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
