//! The laws of a flight: equations that hold at every time `t` between two impacts.

use super::angle;
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
    let mut derivative = law.clone();
    // A law of a state in flight gives those of its derivatives.
    for _ in 0..4 {
        if laws.len() > 1 && !mentions_state(&derivative, reading) {
            break;
        }
        derivative = slope(&derivative, reading)?;
        laws.push(derivative.clone());
    }
    Ok(laws)
}

/// A law of functions of time, and what follows from it by differentiating, at each of `times`, and by integrating
/// from the first of them to the others and over the whole periods `turns`.
pub fn of_functions(
    law: &Fraction,
    times: &[Fraction],
    turns: &[Fraction],
    reading: &mut Reading,
) -> Result<Vec<Fraction>, Meaningless> {
    let mut known = Vec::new();
    let derivative = slope(law, reading)?;
    for law in [law, &derivative] {
        for time in times {
            known.push(at_time(law, time, reading)?);
        }
    }
    let mut integrand = law.clone();
    let Some(first) = times.first() else { return Ok(known) };
    for _ in 0..4 {
        let Some(integral) = antiderivative(&integrand, reading) else {
            break;
        };
        integrand = integral.clone() - at_time(&integral, first, reading)?;
        for time in times.iter().skip(1) {
            known.push(at_time(&integrand, time, reading)?);
        }
        for turn in turns {
            known.push(at_time(&integrand, &(first.clone() + turn.clone()), reading)?);
        }
    }
    Ok(known)
}

/// A law of functions at one time.
fn at_time(law: &Fraction, time: &Fraction, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    taken(law, time, reading, &|_| None)
}

/// The law at an impact: the flight that arrives there, or that departs from there.
pub fn at_impact(law: &Fraction, index: i32, departs: bool, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    let vocabulary = reading.vocabulary;
    let family = vocabulary.times.first().cloned().unwrap_or_default();
    let time = Fraction::variable(reading.atoms.variable(Atom::Time { family, index }));
    taken(law, &time, reading, &|state| {
        let after = departs && !vocabulary.continuous.contains(state);
        vocabulary.states.contains(state).then(|| Atom::State {
            state: state.clone(),
            index,
            after,
        })
    })
}

/// The law with a time for the running time, and at the running time itself a quantity for each state that has one.
fn taken(
    law: &Fraction,
    time: &Fraction,
    reading: &mut Reading,
    state: &dyn Fn(&Name) -> Option<Atom>,
) -> Result<Fraction, Meaningless> {
    let running = reading.atoms.variable(Atom::Running);
    let mut result = law.clone();
    for variable in law.variables() {
        let moved = match reading.atoms.atom(variable).cloned() {
            Some(Atom::Value { function, argument }) => {
                let at_impact = if argument == Fraction::variable(running) {
                    state(&function)
                } else {
                    None
                };
                let argument = argument.substituted(running, time)?;
                let moved = at_impact.unwrap_or(Atom::Value { function, argument });
                Fraction::variable(reading.atoms.variable(moved))
            }
            Some(Atom::Circular { sine, angle }) => {
                let angle = angle.substituted(running, time)?;
                let (cosine, its_sine) = angle::cosine_and_sine(&angle, reading.atoms)?;
                if sine { its_sine } else { cosine }
            }
            _ => continue,
        };
        result = result.substituted(variable, &moved)?;
    }
    Ok(result.substituted(running, time)?)
}

/// The derivative of a law by the running time.
fn slope(law: &Fraction, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    let running = reading.atoms.variable(Atom::Running);
    let mut failure = None;
    let slope = Derivation::new(|variable| {
        if variable == running {
            return Fraction::from_integer(1);
        }
        let along = |f: &Fraction| Fraction::from(f.numerator().derivative(running)) / Fraction::from(f.denominator());
        match reading.atoms.atom(variable).cloned() {
            Some(Atom::Value { function, argument }) if !along(&argument).is_zero() => {
                let slope = reading.slope(&function, &argument).unwrap_or_else(|error| {
                    failure = Some(error);
                    Fraction::zero()
                });
                slope * along(&argument)
            }
            Some(Atom::Circular { sine, angle }) => angle::slope(sine, &angle, reading.atoms) * along(&angle),
            _ => Fraction::zero(),
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
        Some(Atom::Value { argument: time, .. } | Atom::Circular { angle: time, .. }) => time.contains(running),
        _ => variable == running,
    }
}

/// The value of the antiderivative at the same time.
fn raised(value: Variable, running: Variable, reading: &mut Reading) -> Option<Fraction> {
    let (function, argument) = match reading.atoms.atom(value).cloned()? {
        Atom::Value { function, argument } => (function, argument),
        Atom::Circular { sine, angle } => {
            let pace = angle.clone() / Fraction::variable(running);
            let integral = -angle::slope(sine, &angle, reading.atoms);
            return (!pace.contains(running)).then(|| integral / pace);
        }
        _ => return None,
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

/// Whether the law speaks of a state in flight.
fn mentions_state(law: &Fraction, reading: &Reading) -> bool {
    let states = &reading.vocabulary.states;
    let is_state = |v: &Variable| matches!(reading.atoms.atom(*v), Some(Atom::Value { function, .. }) if states.contains(function));
    law.variables().iter().any(is_state)
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
