//! The laws of a flight: equations that hold at every time `t` between two impacts.

use super::atom::Atom;
use super::reading::{Meaningless, Reading};
use crate::algebra::{Derivation, Fraction, Undefined, Variable};
use crate::number::{Field, Rational};
use crate::tex::{Name, Tree};
use dashu_ratio::RBig;
use num_traits::Zero;

/// A law, what follows from it by differentiating, and by integrating over the flight from impact `start` on.
pub fn consequences(law: &Fraction, start: i32, reading: &mut Reading) -> Result<Vec<Fraction>, Meaningless> {
    let mut laws = vec![law.clone()];
    let mut integrand = law.clone();
    // A law of the second order has two integrals; the bound is for laws of any order that a sheet could state.
    for _ in 0..4 {
        let Some(integral) = antiderivative(&integrand, reading) else {
            break;
        };
        integrand = integral.clone() - at_impact(&integral, start, true, reading)?;
        laws.push(integrand.clone());
    }
    if laws.len() == 1 || mentions_lowest_state(law, reading) {
        laws.push(slope(law, reading)?);
    }
    Ok(laws)
}

/// A law of functions of time, and what follows from it by differentiating and integrating, at each of `times`.
pub fn of_functions(law: &Fraction, times: &[Fraction], reading: &mut Reading) -> Result<Vec<Fraction>, Meaningless> {
    let running = reading.atoms.variable(Atom::Running);
    let mut known = Vec::new();
    let derivative = slope(law, reading)?;
    for law in [law, &derivative] {
        for time in times {
            known.push(at_time(law, running, time, reading)?);
        }
    }
    let mut integrand = law.clone();
    let Some(first) = times.first() else { return Ok(known) };
    for _ in 0..4 {
        let Some(integral) = antiderivative(&integrand, reading) else {
            break;
        };
        integrand = integral.clone() - at_time(&integral, running, first, reading)?;
        for time in times.iter().skip(1) {
            known.push(at_time(&integrand, running, time, reading)?);
        }
    }
    Ok(known)
}

/// A law of functions at one time.
fn at_time(law: &Fraction, running: Variable, time: &Fraction, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    let mut result = law.clone();
    for variable in law.variables() {
        let Some(Atom::Value { function, argument }) = reading.atoms.atom(variable).cloned() else {
            continue;
        };
        let moved = Atom::Value {
            function,
            argument: argument.substituted(running, time)?,
        };
        result = result.substituted(variable, &Fraction::variable(reading.atoms.variable(moved)))?;
    }
    Ok(result.substituted(running, time)?)
}

/// The law at an impact: the flight that arrives there, or that departs from there.
pub fn at_impact(law: &Fraction, index: i32, departs: bool, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    let running = reading.atoms.variable(Atom::Running);
    let family = reading.vocabulary.times.first().cloned().unwrap_or_default();
    let time = Fraction::variable(reading.atoms.variable(Atom::Time { family, index }));
    let mut result = law.clone();
    for variable in law.variables() {
        let Some(Atom::Value { function, argument }) = reading.atoms.atom(variable).cloned() else {
            continue;
        };
        let is_state = reading.vocabulary.states.contains(&function);
        let moved = if is_state && argument == Fraction::variable(running) {
            let after = departs && !reading.vocabulary.continuous.contains(&function);
            Atom::State {
                state: function,
                index,
                after,
            }
        } else {
            Atom::Value {
                function,
                argument: argument.substituted(running, &time)?,
            }
        };
        result = result.substituted(variable, &Fraction::variable(reading.atoms.variable(moved)))?;
    }
    Ok(result.substituted(running, &time)?)
}

/// The derivative of a law by the running time.
fn slope(law: &Fraction, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    let running = reading.atoms.variable(Atom::Running);
    let mut failure = None;
    let slope = Derivation::new(|variable| {
        if variable == running {
            return Fraction::from_integer(1);
        }
        let Some(Atom::Value { function, argument }) = reading.atoms.atom(variable).cloned() else {
            return Fraction::zero();
        };
        let inner = Fraction::from(argument.numerator().derivative(running)) / Fraction::from(argument.denominator());
        if inner.is_zero() {
            return inner;
        }
        match reading.slope(&function, &argument) {
            Ok(value) => value * inner,
            Err(error) => {
                failure = Some(error);
                Fraction::zero()
            }
        }
    })
    .of(law);
    failure.map_or(Ok(slope), Err)
}

/// A function whose derivative the law is, where every term is a power of the running time, or a value at that time
/// of a function that is a derivative, times what does not change.
fn antiderivative(law: &Fraction, reading: &mut Reading) -> Option<Fraction> {
    let running = reading.atoms.variable(Atom::Running);
    if law
        .factors()
        .iter()
        .any(|(factor, _)| factor.variables().iter().any(|&v| moves(v, running, reading)))
    {
        return None;
    }
    let mut sum = Fraction::zero();
    for (monomial, coefficient) in law.numerator().terms() {
        let mut power = 0;
        let mut values: Vec<Variable> = Vec::new();
        let mut steady = Fraction::from(&Rational(RBig::from(coefficient.clone())));
        for &(variable, exponent) in monomial.factors() {
            if variable == running {
                power = exponent;
            } else if moves(variable, running, reading) {
                values.extend(std::iter::repeat_n(variable, exponent as usize));
            } else {
                steady *= Fraction::variable(variable).to_power(exponent as i32);
            }
        }
        sum += steady
            * match (power, values.as_slice()) {
                (power, []) => {
                    Fraction::variable(running).to_power(power as i32 + 1)
                        / Fraction::from_integer(i64::from(power) + 1)
                }
                (0, &[value]) => raised(value, running, reading)?,
                _ => return None,
            };
    }
    Some(sum / Fraction::from(law.denominator()))
}

/// Whether a quantity changes along the flight.
fn moves(variable: Variable, running: Variable, reading: &Reading) -> bool {
    match reading.atoms.atom(variable) {
        Some(Atom::Value { argument, .. }) => argument.contains(running),
        _ => variable == running,
    }
}

/// The value of the antiderivative at the same time.
fn raised(value: Variable, running: Variable, reading: &mut Reading) -> Option<Fraction> {
    let Some(Atom::Value { function, argument }) = reading.atoms.atom(value).cloned() else {
        return None;
    };
    // The time must run as fast as t does.
    let shift = argument.clone() - Fraction::variable(running);
    if shift.contains(running) {
        return None;
    }
    let states = &reading.vocabulary.states;
    let above_state = states
        .iter()
        .flat_map(|state| [state.clone(), state.dotted()])
        .find(|s| s.dotted() == function);
    let above = above_state.or_else(|| {
        let is_derivative = |tree: &Option<Tree>| matches!(tree, Some(Tree::Symbol(name, _)) if *name == function);
        reading
            .vocabulary
            .functions
            .iter()
            .find(|(_, tree)| is_derivative(tree))
            .map(|(name, _)| name.clone())
    })?;
    Some(Fraction::variable(reading.atoms.variable(Atom::Value {
        function: above,
        argument,
    })))
}

/// Whether the law gives a state whose derivative is a state too, so that differentiating it says something new.
fn mentions_lowest_state(law: &Fraction, reading: &Reading) -> bool {
    let states = &reading.vocabulary.states;
    let derived = |name: &Name| states.contains(name) && states.contains(&name.dotted());
    law.variables()
        .iter()
        .any(|&v| matches!(reading.atoms.atom(v), Some(Atom::Value { function, .. }) if derived(function)))
}

/// The shift of time under which a law says that a function repeats: `f(t) = f(t + T)`.
pub fn period(law: &Fraction, reading: &mut Reading) -> Result<Option<(Name, Fraction)>, Undefined> {
    let running = reading.atoms.variable(Atom::Running);
    let [(m, a), (n, b)] = law.numerator().terms() else {
        return Ok(None);
    };
    let value = |monomial: &crate::algebra::Monomial| match monomial.factors() {
        &[(variable, 1)] => match reading.atoms.atom(variable) {
            Some(Atom::Value { function, argument }) => Some((function.clone(), argument.clone())),
            _ => None,
        },
        _ => None,
    };
    let (Some((f, early)), Some((g, late))) = (value(m), value(n)) else {
        return Ok(None);
    };
    let shift = late - early.clone();
    let opposite = (a + b).is_zero();
    let backward = shift
        .numerator()
        .terms()
        .first()
        .is_some_and(|(_, c)| *c < dashu_int::IBig::ZERO);
    let shift = if backward { -shift } else { shift };
    Ok((f == g && opposite && early.contains(running) && !shift.contains(running)).then_some((f, shift)))
}
