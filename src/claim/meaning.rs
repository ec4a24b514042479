//! What is known of quantities.

use super::angle;
use super::atom::{Atom, Atoms};
use crate::algebra::{Fraction, Undefined, Variable};
use crate::number::Rational;
use crate::tex::Name;
use num_traits::Zero;
use std::collections::HashMap;

/// What is known of the quantities: values of some, periods of some functions.
#[derive(Clone, Debug, Default)]
pub struct Meaning {
    pub values: HashMap<Variable, Fraction>,
    pub periods: Vec<(Name, Fraction)>,
}

impl Meaning {
    /// The time less whole periods of the function.
    pub fn reduced(&self, function: &Name, time: Fraction) -> Fraction {
        let Some((_, period)) = self.periods.iter().find(|(name, _)| name == function) else {
            return time;
        };
        // The variable that only the later impacts have, or the constant where the period is a number.
        let Some((monomial, _)) = period.numerator().terms().first() else {
            return time;
        };
        let part = |f: &Fraction| {
            let above = f
                .numerator()
                .terms()
                .iter()
                .find(|(m, _)| m == monomial)
                .map(|(_, c)| c.clone());
            let below = f.denominator().as_constant()?;
            Some(Rational(
                dashu_ratio::RBig::from(above.unwrap_or_default()) / dashu_ratio::RBig::from(below),
            ))
        };
        match (part(&time), part(period)) {
            (Some(have), Some(one)) if !one.is_zero() => {
                let whole = Rational(dashu_ratio::RBig::from((have / one).0.floor()));
                if whole.is_zero() {
                    time
                } else {
                    time - period.clone() * Fraction::from(&whole)
                }
            }
            _ => time,
        }
    }

    /// The function with all that is known put in. No known value holds a quantity that is itself known.
    pub fn apply(&self, function: &Fraction) -> Result<Fraction, Undefined> {
        function
            .variables()
            .into_iter()
            .try_fold(function.clone(), |f, variable| match self.values.get(&variable) {
                Some(value) => f.substituted(variable, value),
                None => Ok(f),
            })
    }

    /// Rewrites a function read without this meaning: times and parameters by their values, the values of functions
    /// at the times so rewritten, less whole periods.
    pub fn restrict(&self, function: &Fraction, atoms: &mut Atoms) -> Result<Fraction, Undefined> {
        let mut result = function.clone();
        for variable in function.variables() {
            let value = match atoms.atom(variable).cloned() {
                Some(Atom::Value { function, argument }) => {
                    let argument = self.restrict(&argument, atoms)?;
                    let argument = self.reduced(&function, argument);
                    let moved = atoms.variable(Atom::Value { function, argument });
                    if moved == variable && !self.values.contains_key(&variable) {
                        continue;
                    }
                    self.values
                        .get(&moved)
                        .cloned()
                        .unwrap_or_else(|| Fraction::variable(moved))
                }
                Some(Atom::Circular { sine, angle }) => {
                    let (restricted, known) = (self.restrict(&angle, atoms)?, angle);
                    if restricted.has_form_of(&known) {
                        continue;
                    }
                    // An angle that can be read can be read at other times too.
                    let parts = angle::cosine_and_sine(&restricted, atoms).map_err(|_| Undefined)?;
                    if sine { parts.1 } else { parts.0 }
                }
                _ => match self.values.get(&variable) {
                    Some(value) => value.clone(),
                    None => continue,
                },
            };
            result = result.substituted(variable, &value)?;
        }
        Ok(result)
    }
}
