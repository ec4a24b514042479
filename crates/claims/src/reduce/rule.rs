//! The rules by which claims are reduced, each with the name that the audit prints.

use std::collections::BTreeSet;
use std::fmt;
use texmath::{Operation, Series};

/// The rules by which statements were rewritten from what was read.
pub type Rules = BTreeSet<Rule>;

/// A rule by which a claim is reduced. The kernel sees what comes of it: the rule itself is trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rule {
    /// Definitions and abbreviations are replaced by their formulas.
    Definitions,
    /// Functions in integrals are replaced by the formulas that premises give them.
    FunctionFormulas,
    /// `\sgn` is written by cases.
    SignCases,
    /// `\sqrt[n]{x}` is `x^{1/n}`.
    RootPower,
    /// Both sides are differentiated.
    IntegralDifferentiated,
    /// Integrals over one interval are one integral of the sum.
    IntegralLinear,
    /// A definite integral is the difference of an antiderivative at its ends.
    IntegralAntiderivative,
    /// An integral is the sum of those over the pieces of its interval.
    IntegralPieces,
    /// An improper integral is taken to have a value.
    IntegralConverges,
    /// Powers times exponentials are integrated by the gamma function.
    IntegralGamma,
    /// An integral is a multiple of one in a table.
    IntegralTable,
    /// An integral is differentiated by a letter in its limits or its integrand.
    IntegralLeibniz,
    /// Integrals at an integer and at the next one are tied by integration by parts, and follow by induction.
    IntegralReductionFormula,
    /// The integral is half of that of the integrand and its reflection at the middle of the interval.
    IntegralReflection,
    /// Logarithms and angles are replaced by multiples of others that are shown to be equal.
    ValueRelations,
    /// A limit is read off a power series.
    LimitSeries,
    /// A claim that something is below infinity says that it has a value; something with a value is not infinite.
    Infinity,
    /// `O(x^n)` is read off a power series.
    OrderSeries,
    /// A sum or product of known length is written out.
    SeriesTerms,
    /// Sums and products of symbolic length by induction.
    SeriesInduction,
    /// Sums whose terms depend on their length by creative telescoping.
    SeriesTelescoping,
    /// A sum to infinity by sums of a table and a limit.
    SeriesInfinite,
    /// A sum to infinity lies between bounds, or is infinite, by a test of its convergence.
    SeriesTest,
    /// The region in which a sum to infinity converges is assumed.
    SeriesConverges,
    /// A claim about a sequence by induction along its recurrence.
    SequenceInduction,
    /// Members of a sequence by the recurrence at numbers.
    SequenceUnrolled,
    /// Premises about members of sequences at each index that a claim reaches.
    SequenceInstances,
    /// Integers are replaced by numbers.
    IntegerInstances,
    /// Derivatives by the rules of differentiation.
    DerivativeRules,
    /// Matrices and vectors by their entries.
    MatrixEntries,
    /// Binomial coefficients by products and factorials.
    BinomialFactorials,
    /// Factorials of numbers by their values, of letters by n! = n (n - 1)!.
    FactorialRecurrence,
    /// Factorials of what grows by Stirling's formula with the bounds of Robbins.
    FactorialStirling,
    /// The limit of a sum as an integral.
    RiemannSum,
    /// The largest integer up to a number is an integer m with m <= x < m + 1.
    FloorInteger,
    /// One goal for each case.
    CasesSplit,
    /// One goal for each sign of what stands between bars.
    ModulusCases,
    /// `|a| <= b` is `-b <= a <= b`.
    ModulusBounds,
    /// Complex numbers by their real and imaginary parts.
    ComplexParts,
    /// The Cauchy-Schwarz inequality is given for the moduli of an inequality.
    CauchySchwarz,
    /// An inequality by the signs of derivatives at and beyond a point, or by concavity.
    InequalityDerivatives,
    /// An inequality with values between known bounds as letters.
    InequalityBounds,
    /// An inequality by induction over an integer.
    InequalityInduction,
    /// A root or the value of an inverse function by the equation and the range that define it.
    InverseRange,
    /// The bases of powers whose exponents are no numbers are taken to be positive.
    PositiveBases,
    /// The bases of powers whose exponents are integers are taken not to be 0.
    NonzeroBases,
    /// Letters that need not commute, as matrices, by words.
    Words,
}

impl Rule {
    /// Returns the rule by which an operation is written out at once; None where another step has to remove it first.
    pub(super) fn of_operation(operation: &Operation) -> Option<Self> {
        match operation {
            Operation::Matrix(_)
            | Operation::Determinant(_)
            | Operation::Trace(_)
            | Operation::Transpose(_)
            | Operation::Cross(..)
            | Operation::Dot(..) => Some(Self::MatrixEntries),
            Operation::Binomial(..) => Some(Self::BinomialFactorials),
            Operation::Derivative { .. } => Some(Self::DerivativeRules),
            Operation::Series {
                kind: Series::Sum | Series::Product,
                ..
            } => Some(Self::SeriesTerms),
            Operation::Arguments(_)
            | Operation::Root { .. }
            | Operation::Integral { .. }
            | Operation::Limit { .. }
            | Operation::Order(..)
            | Operation::Approaches(_)
            | Operation::OneSided(..)
            | Operation::Infinity
            | Operation::Cases(_) => None,
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Definitions => "definitions: substituted",
            Self::FunctionFormulas => "functions: formulas",
            Self::SignCases => "sign: cases",
            Self::RootPower => "root: power",
            Self::IntegralDifferentiated => "integral: differentiated",
            Self::IntegralLinear => "integral: linearity",
            Self::IntegralAntiderivative => "integral: antiderivative",
            Self::IntegralPieces => "integral: pieces",
            Self::IntegralConverges => "integral: converges",
            Self::IntegralGamma => "integral: gamma function",
            Self::IntegralTable => "integral: table",
            Self::IntegralLeibniz => "integral: Leibniz",
            Self::IntegralReductionFormula => "integral: reduction formula",
            Self::IntegralReflection => "integral: reflection",
            Self::ValueRelations => "values: relations",
            Self::LimitSeries => "limit: series",
            Self::Infinity => "infinity: values",
            Self::OrderSeries => "order: series",
            Self::SeriesTerms => "sum: terms",
            Self::SeriesInduction => "sum: induction",
            Self::SeriesTelescoping => "sum: telescoping",
            Self::SeriesInfinite => "sum: to infinity",
            Self::SeriesTest => "sum: test of convergence",
            Self::SeriesConverges => "sum: converges",
            Self::SequenceInduction => "sequence: induction",
            Self::SequenceUnrolled => "sequence: unrolled",
            Self::SequenceInstances => "sequence: instances",
            Self::IntegerInstances => "integers: instances",
            Self::DerivativeRules => "derivative: rules",
            Self::MatrixEntries => "matrix: entries",
            Self::BinomialFactorials => "binomial: factorials",
            Self::FactorialRecurrence => "factorial: recurrence",
            Self::FactorialStirling => "factorial: Stirling",
            Self::RiemannSum => "sum: Riemann integral",
            Self::FloorInteger => "floor: integer",
            Self::CasesSplit => "cases: split",
            Self::ModulusCases => "modulus: cases",
            Self::ModulusBounds => "modulus: bounds",
            Self::ComplexParts => "complex: parts",
            Self::CauchySchwarz => "modulus: Cauchy-Schwarz",
            Self::InequalityDerivatives => "inequality: signs of derivatives",
            Self::InequalityBounds => "inequality: bounds",
            Self::InequalityInduction => "inequality: induction",
            Self::InverseRange => "inverse: range",
            Self::PositiveBases => "powers: positive bases",
            Self::NonzeroBases => "powers: nonzero bases",
            Self::Words => "words: any ring",
        })
    }
}
