//! Certificates: the forms that the kernel accepts, as data.

use super::polynomial::Polynomial;
use super::statement::Property;
use super::term::{Symbol, Term};
use numbers::Rational;

/// A proof: terms that stay whole, and steps of which each adds one fact (or one law) to those known.
#[derive(Clone, Debug, Default)]
pub struct Certificate {
    /// Terms that polynomials keep as generators although they could be expanded.
    pub whole: Vec<Term>,
    pub steps: Vec<Inference>,
}

/// Where a law comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawSource {
    /// A given law, its impacts moved on.
    Given { given: usize, shift: i32 },
    /// A law that an earlier step derived, by its number.
    Derived(usize),
}

/// A summand of a sign proof: a positive number times facts that are not negative times a square.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summand {
    pub factor: Rational,
    /// Numbers of facts, each `Positive` or `NonNegative`.
    pub facts: Vec<usize>,
    pub root: Polynomial,
}

/// One step of a proof. Facts are numbered in the order in which steps add them.
#[derive(Clone, Debug, PartialEq)]
pub enum Inference {
    /// A given that is no law.
    Given(usize),
    /// An instance of a law at a time; none for laws that run over indices only.
    Law { source: LawSource, at: Option<Term> },
    /// An instance of an axiom.
    Axiom(Axiom),
    /// `target` is 0: the product of the nonzero `factors` times (target^power + sum of `squares`) is the combination
    /// of the `terms`, each a coefficient and the number of a fact `Zero`. Squares need an even power, and real numbers.
    Zero {
        target: Polynomial,
        power: u32,
        squares: Vec<(Rational, Polynomial)>,
        factors: Vec<(usize, u32)>,
        terms: Vec<(Polynomial, usize)>,
    },
    /// `target` is not 0: `cofactor` times it is the product of the nonzero `factors` plus the combination of `terms`.
    Nonzero {
        target: Polynomial,
        cofactor: Polynomial,
        factors: Vec<(usize, u32)>,
        terms: Vec<(Polynomial, usize)>,
    },
    /// `target` is positive (`strict`) or not negative: the product of the positive `factors` times it is the sum of
    /// `summands` plus the combination of `terms`; if strict, one summand has positive facts only and a root without
    /// generators.
    Sign {
        target: Polynomial,
        strict: bool,
        factors: Vec<(usize, u32)>,
        summands: Vec<Summand>,
        terms: Vec<(Polynomial, usize)>,
    },
    /// What is neither positive nor negative is 0: the numbers of the two facts `NonNegative`.
    Squeezed { low: usize, high: usize },
    /// Equal arguments have equal values: the two terms are the same function of two terms whose difference is 0.
    Congruence { left: Term, right: Term },
    /// `property` holds of `target` in every case: `on` is 0 or not; with `order`, it is positive, 0 or negative.
    Cases {
        on: Polynomial,
        order: bool,
        property: Property,
        target: Polynomial,
        branches: Vec<Vec<Inference>>,
    },
    /// The law that follows by differentiating a law with respect to its time.
    Derivative(LawSource),
    /// The law that `of`, a term in the symbol `time`, has the value at `time` that it has at `at`: its derivative is 0
    /// by the steps, at every time, and it is differentiable there.
    Constant {
        of: Term,
        time: Symbol,
        at: Term,
        /// The flight that the law is for; none for the whole real line.
        flight: Option<i32>,
        steps: Vec<Inference>,
    },
    /// A term in generic symbols alone is not 0: a thin set is excluded. The point of a proof must lie outside it.
    Generic(Term),
    /// The premises that determine a map, differentiated along it: the number of the map, of the premise, and by what.
    Along { map: usize, equation: usize, by: Symbol },
}

/// Axioms: true of all numbers that meet what is said. Sources: DLMF 4.14 to 4.45; Abramowitz and Stegun 4.1 to 4.4.
#[derive(Clone, Debug, PartialEq)]
pub enum Axiom {
    /// A whole term, or the symbol of an abbreviation, is what it stands for.
    Unfold(Term),
    /// sin² + cos² = 1.
    Pythagoras(Term),
    /// The sine of a term that is the sum of two (DLMF 4.21.2).
    SineOfSum {
        sum: Term,
        parts: [Term; 2],
    },
    /// The cosine of a term that is the sum of two (DLMF 4.21.3).
    CosineOfSum {
        sum: Term,
        parts: [Term; 2],
    },
    /// sin(-x) = -sin x, for two terms with sum 0.
    SineOfNegative {
        negative: Term,
        of: Term,
    },
    /// cos(-x) = cos x.
    CosineOfNegative {
        negative: Term,
        of: Term,
    },
    /// The sine of a term that is 0, the cosine of one.
    SineOfZero(Term),
    CosineOfZero(Term),
    /// sin pi = 0, cos pi = -1.
    SineOfPi,
    CosineOfPi,
    /// sin(pi n) = 0 and cos(2 pi n) = 1 for an integer n.
    SineOfHalfTurns(Term),
    CosineOfTurns(Term),
    /// cos(pi n) = (-1)^n for an integer n (DLMF 4.17).
    CosineOfHalfTurns(Term),
    /// exp(i x) = cos x + i sin x (DLMF 4.14.3).
    ExpOfImaginary(Term),
    /// The principal square root of -x is i times that of x, for real x that is not negative (DLMF
    /// 4.2.28, 4.2.3).
    RootOfNegative(Term),
    /// ln(-x) = ln x + i pi for real positive x (DLMF 4.2.3).
    LnOfNegative(Term),
    /// A positive integer is at least 1.
    IntegerAtLeastOne(Term),
    /// exp(x + y) = exp x exp y for a term that is the sum of two.
    ExpOfSum {
        sum: Term,
        parts: [Term; 2],
    },
    /// exp of a term that is 0.
    ExpOfZero(Term),
    /// exp x > 0 for real x.
    ExpPositive(Term),
    /// exp x is not 0.
    ExpNonzero(Term),
    /// exp x = exp y only for x = y, both real.
    ExpInjective([Term; 2]),
    /// exp(ln x) = x, where ln x is defined.
    ExpOfLn(Term),
    /// ln(exp x) = x for real x.
    LnOfExp(Term),
    /// The n-th power of the n-th root of x is x, where the root is defined.
    RootPower(Term),
    /// An even root is not negative.
    RootNonNegative(Term),
    /// `value` with the n-th power x is the n-th root of x, if n is odd or `value` is not negative; a principal root, if
    /// `value` is real and not negative.
    RootUnique {
        root: Term,
        value: Term,
    },
    /// x^y = exp(y ln x) for x > 0.
    RealPower(Term),
    /// x^(a + b) = x^a x^b for integers a and b, neither of them negative unless x is not 0; 0^0 is 1.
    IntegerPowerOfSum {
        power: Term,
        parts: [Term; 2],
    },
    /// (x y)^n = x^n y^n for an integer n, which is not negative unless x and y are not 0; 0^0 is 1.
    IntegerPowerOfProduct {
        power: Term,
        factors: [Term; 2],
    },
    /// x^n is the n-th power of x for an exponent that is the integer n, x other than 0 if n is negative.
    IntegerPower {
        power: Term,
        exponent: i32,
    },
    /// sin(arcsin x) = x, cos(arccos x) = x, sin(arctan x) = x cos(arctan x).
    SineOfArcsin(Term),
    CosineOfArccos(Term),
    SineOfArctan(Term),
    /// cos(arcsin x) >= 0, sin(arccos x) >= 0, cos(arctan x) > 0.
    CosineOfArcsin(Term),
    SineOfArccos(Term),
    CosineOfArctan(Term),
    /// The ranges: arcsin and arctan are at least -pi/2, arccos at least 0, and so on; arctan strictly.
    ArcAbove(Term),
    ArcBelow(Term),
    /// Angles less than a whole turn apart with the same sine and cosine are equal.
    AngleUnique([Term; 2]),
    /// sin x > 0 for 0 < x < pi.
    SinePositive(Term),
    /// The square of the imaginary unit is -1.
    ImaginarySquare,
    /// A polynomial without symbols and unknown functions is positive: by an enclosure.
    Enclosure(Polynomial),
}
