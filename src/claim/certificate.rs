//! Proofs a person can check: the claim as an exact combination of its premises.

use super::problem::Problem;
use super::proof::Question;
use crate::algebra::{Polynomial, Variable};
use dashu_int::IBig;

/// `multiplier * residual = sum of coefficient * given`, an identity between polynomials.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// The numerator of left side minus right side, times alone solved for.
    pub residual: Polynomial,
    /// Not zero where the claim's denominators are not.
    pub multiplier: Polynomial,
    /// The givens that are needed, by position, with their coefficients.
    pub terms: Vec<(usize, Polynomial)>,
    /// Roots with their squares: `coefficient * (below root^2 - above)` is a term too.
    pub roots: Vec<(Variable, Polynomial, Polynomial)>,
}

/// A polynomial, and how it is made of the residual and the givens.
#[derive(Clone)]
struct Tracked {
    value: Polynomial,
    multiplier: Polynomial,
    /// One for each given, then one for each root.
    coefficients: Vec<Polynomial>,
}

impl Tracked {
    /// Takes off multiples of `divisor`, which is `slope * variable^degree + ...`, until the degree is lower.
    fn reduce(&mut self, divisor: &Self, variable: Variable, degree: u32) {
        let slope = divisor.value.coefficients(variable).pop().unwrap_or_default();
        loop {
            let mut coefficients = self.value.coefficients(variable);
            let power = coefficients.len() as u32 - 1;
            if power < degree {
                return;
            }
            let lead = coefficients.pop().unwrap_or_default();
            let rise = (0..power - degree).fold(Polynomial::from(1), |p, _| p.times(&Polynomial::variable(variable)));
            let (scale, factor) = match lead.exact_quotient(&slope) {
                Some(quotient) => (Polynomial::from(1), quotient.times(&rise)),
                None => (slope.clone(), lead.times(&rise)),
            };
            let combine = |own: &Polynomial, other: &Polynomial| own.times(&scale).minus(&other.times(&factor));
            self.value = combine(&self.value, &divisor.value);
            self.multiplier = combine(&self.multiplier, &divisor.multiplier);
            let pairs = self.coefficients.iter().zip(&divisor.coefficients);
            self.coefficients = pairs.map(|(own, other)| combine(own, other)).collect();
        }
    }
}

/// The certificates of a question that is answered with yes, one for each residual; `None` where a residual is zero
/// for another reason than the premises (the sign of a root).
pub fn certify(problem: &Problem, question: &Question) -> Option<Vec<Certificate>> {
    question
        .residuals()
        .iter()
        .map(|residual| certificate(problem, residual.numerator()))
        .collect()
}

fn certificate(problem: &Problem, residual: &Polynomial) -> Option<Certificate> {
    let roots: Vec<(Variable, Polynomial, Polynomial)> = problem
        .squares
        .iter()
        .map(|(root, square)| (*root, square.numerator().clone(), square.denominator()))
        .collect();
    let count = problem.givens.len() + roots.len();
    let none = vec![Polynomial::default(); count];
    let unit = |at: usize, value: Polynomial| {
        let mut coefficients = none.clone();
        if let Some(own) = coefficients.get_mut(at) {
            *own = Polynomial::from(-1);
        }
        Tracked {
            value,
            multiplier: Polynomial::default(),
            coefficients,
        }
    };
    let mut subject = Tracked {
        value: residual.clone(),
        multiplier: Polynomial::from(1),
        coefficients: none.clone(),
    };
    let mut solved: Vec<(Tracked, Variable, u32)> = Vec::new();
    for (at, (root, above, below)) in roots.iter().enumerate().rev() {
        let square = Polynomial::variable(*root).to_power(2).times(below).minus(above);
        solved.push((unit(problem.givens.len() + at, square), *root, 2));
    }
    for &(origin, variable) in &problem.steps {
        let mut next = unit(origin, problem.givens.get(origin)?.residual.clone());
        for (earlier, of, degree) in &solved {
            next.reduce(earlier, *of, *degree);
        }
        solved.push((next, variable, 1));
    }
    for (divisor, of, degree) in &solved {
        subject.reduce(divisor, *of, *degree);
    }
    let certificate = simplified(residual, &subject, roots, problem.givens.len());
    (subject.value.is_zero() && certificate.holds(problem)).then_some(certificate)
}

/// The certificate without the factors that all its parts share.
fn simplified(
    residual: &Polynomial,
    subject: &Tracked,
    roots: Vec<(Variable, Polynomial, Polynomial)>,
    givens: usize,
) -> Certificate {
    let mut parts: Vec<Polynomial> = vec![subject.multiplier.clone()];
    parts.extend(subject.coefficients.iter().cloned());
    let nonzero: Vec<Polynomial> = parts.iter().filter(|p| !p.is_zero()).cloned().collect();
    let monomial = nonzero
        .iter()
        .map(Polynomial::common_monomial)
        .reduce(|a, b| a.common(&b))
        .unwrap_or_default();
    let content = nonzero.iter().map(Polynomial::content).fold(IBig::ZERO, |a, b| {
        use dashu_int::ops::Gcd;
        if a.is_zero() { b } else { IBig::from(a.gcd(&b)) }
    });
    let mut parts: Vec<Polynomial> = parts.iter().map(|p| p.reduced(&content, &monomial)).collect();
    // The multiplier is a product of the slopes solved by; where one divides all parts it was not needed.
    for divisor in nonzero
        .iter()
        .map(Polynomial::primitive)
        .filter(|p| p.as_constant().is_none())
    {
        while let Some(quotients) = parts
            .iter()
            .map(|p| p.exact_quotient(&divisor))
            .collect::<Option<Vec<_>>>()
        {
            parts = quotients;
        }
    }
    let multiplier = parts.remove(0);
    let terms = parts
        .into_iter()
        .enumerate()
        .filter(|(_, p)| !p.is_zero())
        .collect::<Vec<_>>();
    debug_assert!(terms.iter().all(|(at, _)| *at < givens + roots.len()));
    Certificate {
        residual: residual.clone(),
        multiplier,
        terms,
        roots,
    }
}

impl Certificate {
    /// Multiplies everything out again: whether the identity holds.
    pub fn holds(&self, problem: &Problem) -> bool {
        let part = |at: usize| match problem.givens.get(at) {
            Some(given) => Some(given.residual.clone()),
            None => self
                .roots
                .get(at - problem.givens.len())
                .map(|(root, above, below)| Polynomial::variable(*root).to_power(2).times(below).minus(above)),
        };
        let sum = self
            .terms
            .iter()
            .try_fold(Polynomial::default(), |sum, (at, coefficient)| {
                Some(sum.plus(&coefficient.times(&part(*at)?)))
            });
        !self.multiplier.is_zero() && sum.is_some_and(|sum| sum == self.multiplier.times(&self.residual))
    }
}
