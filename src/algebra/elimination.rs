//! Solving equations one after the other, each linearly for one of its variables.
//!
//! Such a system has a rational parametrisation: the variables that are left are free, the others are rational
//! functions of them. What is true on the parametrised component is then a matter of one normal form.

use super::fraction::Fraction;
use super::monomial::{Monomial, Variable};
use super::polynomial::Polynomial;
use num_traits::Zero;
use std::collections::BTreeSet;
use std::rc::Rc;

/// An equation `residual = 0`, and a number by which the caller knows it.
#[derive(Clone, Debug)]
pub struct Premise {
    pub residual: Polynomial,
    pub origin: usize,
}

/// One equation solved: `variable = value`, where `value` holds none of the variables solved before it.
#[derive(Clone, Debug)]
pub struct Step {
    pub origin: usize,
    pub variable: Variable,
    pub value: Fraction,
}

/// A solved system.
#[derive(Clone, Debug, Default)]
pub struct Solution {
    /// In the order solved. A value may hold variables that later steps solve.
    pub steps: Vec<Step>,
    /// The equations that the others imply.
    pub redundant: Vec<usize>,
}

/// Whether and how soon a variable is solved for; within a kind the lower number is the sooner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    /// A variable that stands for what others determine: an equation with such a variable serves to find it.
    Dependent(u32),
    /// Any other.
    Ordinary(u32),
    /// A variable that stays free as long as anything else can be solved for, and is taken to be different from zero.
    Generic(u32),
    /// A variable that is never solved for, different from zero.
    Fixed,
}

/// Why a system could not be solved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// These equations have no common solution.
    Contradiction(BTreeSet<usize>),
    /// These equations, after all others were used, are linear in none of the variables that may be solved for.
    Nonlinear(BTreeSet<usize>),
}

/// The choices tried before an order is given up: a few dozen premises need one each.
const MOST_CHOICES: usize = 2000;

/// Solves the equations in whatever order works.
///
/// `rank` says which variables may be solved for, and how soon.
///
/// # Errors
/// [`Failure`], with the equations at fault.
pub fn solve(premises: Vec<Premise>, rank: &dyn Fn(Variable) -> Rank) -> Result<Solution, Failure> {
    let mut search = Search { rank, choices: 0 };
    let pending = premises
        .into_iter()
        .map(|p| Pending {
            used: Rc::new(BTreeSet::from([p.origin])),
            origin: p.origin,
            residual: Rc::new(p.residual.primitive()),
        })
        .collect();
    let mut solution = Solution::default();
    search.descend(pending, &mut solution)?;
    Ok(solution)
}

#[derive(Clone)]
struct Pending {
    residual: Rc<Polynomial>,
    origin: usize,
    /// The equations that have gone into this one.
    used: Rc<BTreeSet<usize>>,
}

/// A way to go on: which pending equation, for which variable, at what cost.
struct Choice {
    cost: (Class, bool, Rank, usize, usize),
    equation: usize,
    variable: Variable,
}

/// How good a choice is. What brings no denominator comes first, then what equations with dependent variables are
/// for; what brings denominators into all others waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    Plain,
    Dependent,
    WithDenominator,
    Misused,
    Generic,
}

struct Search<'a> {
    rank: &'a dyn Fn(Variable) -> Rank,
    choices: usize,
}

impl Search<'_> {
    fn descend(&mut self, mut pending: Vec<Pending>, solution: &mut Solution) -> Result<(), Failure> {
        for equation in &mut pending {
            if let Some(reduced) = self.without_generic_factor(&equation.residual) {
                equation.residual = Rc::new(reduced);
            }
        }
        pending.retain(|p| {
            let done = p.residual.is_zero();
            if done {
                solution.redundant.push(p.origin);
            }
            !done
        });
        if let Some(impossible) = pending.iter().find(|p| p.residual.as_constant().is_some()) {
            return Err(Failure::Contradiction(impossible.used.as_ref().clone()));
        }
        if pending.is_empty() {
            return Ok(());
        }
        let mut choices = self.choices(&pending);
        choices.sort_by_key(|c| (c.cost, c.equation, c.variable));
        // Another way through a generic variable would only hide that it has to vanish.
        if choices.first().is_some_and(|best| best.cost.0 < Class::Generic) {
            choices.retain(|c| c.cost.0 < Class::Generic);
        }
        let mut failure = None;
        for choice in choices {
            self.choices += 1;
            if self.choices > MOST_CHOICES {
                break;
            }
            let (steps, redundant) = (solution.steps.len(), solution.redundant.len());
            match self.take(&choice, &pending, solution) {
                Ok(()) => return Ok(()),
                Err(found) => failure = failure.or(Some(found)),
            }
            solution.steps.truncate(steps);
            solution.redundant.truncate(redundant);
        }
        Err(failure.unwrap_or_else(|| Failure::Nonlinear(pending.iter().map(|p| p.origin).collect())))
    }

    fn take(&mut self, choice: &Choice, pending: &[Pending], solution: &mut Solution) -> Result<(), Failure> {
        let mut rest = pending.to_vec();
        let chosen = rest.swap_remove(choice.equation);
        let coefficients = chosen.residual.coefficients(choice.variable);
        let [free, slope] = coefficients.as_slice() else {
            return Err(Failure::Nonlinear(chosen.used.as_ref().clone()));
        };
        let value = Fraction::from(free.negated()) / Fraction::from(slope.clone());
        for other in rest.iter_mut().filter(|p| p.residual.contains(choice.variable)) {
            let inserted = Fraction::from(other.residual.as_ref().clone()).substituted(choice.variable, &value);
            // The residual has no denominator that could vanish.
            if let Ok(inserted) = inserted {
                other.residual = Rc::new(inserted.numerator().primitive());
            }
            other.used = Rc::new(other.used.union(&chosen.used).copied().collect());
        }
        // What is different from zero cannot come out as zero, unless an equation says just that of it.
        let said = chosen.used.len() == 1 && *chosen.residual == Polynomial::variable(choice.variable);
        if value.is_zero() && !said && matches!((self.rank)(choice.variable), Rank::Generic(_)) {
            return Err(Failure::Contradiction(chosen.used.as_ref().clone()));
        }
        solution.steps.push(Step {
            origin: chosen.origin,
            variable: choice.variable,
            value,
        });
        self.descend(rest, solution)
    }

    /// Every equation with every variable it is linear in.
    fn choices(&self, pending: &[Pending]) -> Vec<Choice> {
        let mut choices = Vec::new();
        for (equation, p) in pending.iter().enumerate() {
            let uses = p.residual.uses();
            let of_dependents = uses
                .iter()
                .any(|u| matches!((self.rank)(u.variable), Rank::Dependent(_)));
            for usage in uses.iter().filter(|usage| usage.degree == 1) {
                let class = match (self.rank)(usage.variable) {
                    Rank::Fixed => continue,
                    Rank::Generic(_) => Class::Generic,
                    Rank::Dependent(_) => Class::Dependent,
                    Rank::Ordinary(_) if of_dependents => Class::Misused,
                    Rank::Ordinary(_) if usage.is_plain => Class::Plain,
                    Rank::Ordinary(_) => Class::WithDenominator,
                };
                let rank = (self.rank)(usage.variable);
                let cost = (class, !usage.is_plain, rank, usage.terms, p.residual.terms().len());
                choices.push(Choice {
                    cost,
                    equation,
                    variable: usage.variable,
                });
            }
        }
        choices
    }

    /// The residual divided by the generic variables that divide every term, as they are not zero.
    fn without_generic_factor(&self, residual: &Polynomial) -> Option<Polynomial> {
        let common = residual.common_monomial();
        let is_generic = |v: Variable| matches!((self.rank)(v), Rank::Generic(_) | Rank::Fixed);
        let generic = || common.factors().iter().filter(|&&(v, _)| is_generic(v));
        // A lone power of generic variables says that one of them is zero, and stays.
        let is_lone = residual.terms().len() == 1 && common.factors().iter().all(|&(v, _)| is_generic(v));
        if is_lone || generic().next().is_none() {
            return None;
        }
        let divisor = generic().fold(Monomial::one(), |m, &(v, e)| m.times(&Monomial::power(v, e)));
        Some(residual.reduced(&1.into(), &divisor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::Zero;

    /// Variables from 100 on are generic.
    fn rank(variable: Variable) -> Rank {
        if variable.0 < 100 {
            Rank::Ordinary(variable.0)
        } else {
            Rank::Generic(variable.0)
        }
    }

    fn x(n: u32) -> Polynomial {
        Polynomial::variable(Variable(n))
    }

    fn system(residuals: Vec<Polynomial>) -> Result<Solution, Failure> {
        let premises = residuals.into_iter().enumerate();
        solve(
            premises
                .map(|(origin, residual)| Premise { residual, origin })
                .collect(),
            &rank,
        )
    }

    #[test]
    fn a_solved_system_makes_each_equation_vanish() {
        // x0 + x1 x100 - 1, x0 - x1 - x101
        let residuals = vec![
            x(0).plus(&x(1).times(&x(100))).minus(&Polynomial::from(1)),
            x(0).minus(&x(1)).minus(&x(101)),
        ];
        let solution = system(residuals.clone()).unwrap();
        for residual in residuals {
            let reduced = solution.steps.iter().fold(Fraction::from(residual), |f, step| {
                f.substituted(step.variable, &step.value).unwrap()
            });
            assert!(reduced.is_zero());
        }
    }

    #[test]
    fn an_equation_said_twice_is_redundant_and_one_with_another_value_contradicts() {
        let first = x(0).minus(&x(100));
        assert_eq!(
            system(vec![first.clone(), first.scaled(&2.into())]).unwrap().redundant,
            [1]
        );
        let second = first.plus(&Polynomial::from(1));
        assert_eq!(
            system(vec![first, second]).unwrap_err(),
            Failure::Contradiction(BTreeSet::from([0, 1]))
        );
    }

    #[test]
    fn a_square_alone_cannot_be_solved() {
        let failure = system(vec![x(0).to_power(2).minus(&Polynomial::from(2))]).unwrap_err();
        assert_eq!(failure, Failure::Nonlinear(BTreeSet::from([0])));
    }

    #[test]
    fn a_product_with_a_generic_factor_makes_the_other_factor_zero() {
        let solution = system(vec![x(0).times(&x(100))]).unwrap();
        assert_eq!(solution.steps[0].variable, Variable(0));
        assert!(solution.steps[0].value.is_zero());
    }
}
