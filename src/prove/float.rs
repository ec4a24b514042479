//! Terms in floating point: to choose points before anything exact is done.

use crate::kernel::{Elementary, Node, Symbol, Term, Terms};
use std::collections::HashMap;

/// A complex number; over the reals the imaginary part is 0.
pub type Complex = (f64, f64);

fn times((a, b): Complex, (c, d): Complex) -> Complex {
    (a * c - b * d, a * d + b * c)
}

fn over((a, b): Complex, (c, d): Complex) -> Complex {
    let size = c * c + d * d;
    ((a * c + b * d) / size, (b * c - a * d) / size)
}

fn exp((a, b): Complex) -> Complex {
    let size = a.exp();
    if b == 0.0 {
        (size, 0.0)
    } else {
        (size * b.cos(), size * b.sin())
    }
}

fn ln((a, b): Complex) -> Complex {
    (a.hypot(b).ln(), b.atan2(a))
}

/// The value of a term; NaN where it has none, or where `real` and a function leaves the reals.
pub fn value(
    terms: &Terms,
    term: Term,
    symbols: &HashMap<Symbol, Complex>,
    real: bool,
    known: &mut HashMap<Term, Complex>,
) -> Complex {
    const NONE: Complex = (f64::NAN, f64::NAN);
    for inner in terms.inside(term) {
        if known.contains_key(&inner) {
            continue;
        }
        let of = |part: &Term| known.get(part).copied().unwrap_or(NONE);
        let result = match terms.node(inner) {
            Node::Number(value) => (value.0.to_f64().value(), 0.0),
            Node::Pi => (std::f64::consts::PI, 0.0),
            Node::Imaginary => (0.0, 1.0),
            Node::Symbol(symbol) => symbols.get(symbol).copied().unwrap_or(NONE),
            Node::Sum(parts) => parts.iter().map(of).fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d)),
            Node::Product(parts) => parts.iter().map(of).fold((1.0, 0.0), times),
            Node::Power(base, exponent) => {
                let base = of(base);
                if base.1 == 0.0 {
                    (base.0.powi(*exponent), 0.0)
                } else {
                    (0..(*exponent).min(1000)).fold((1.0, 0.0), |power, _| times(power, base))
                }
            }
            Node::Quotient(above, below) => over(of(above), of(below)),
            Node::RealPower(base, exponent) => {
                let (base, exponent) = (of(base), of(exponent));
                if base == (0.0, 0.0) && exponent.0 > 0.0 {
                    (0.0, 0.0)
                } else if base.1 == 0.0 && exponent.1 == 0.0 && (real || base.0 > 0.0) {
                    (base.0.powf(exponent.0), 0.0)
                } else {
                    exp(times(exponent, ln(base)))
                }
            }
            Node::Elementary(function, at) => elementary(*function, of(at), real),
            Node::Value(..) => NONE,
        };
        known.insert(inner, result);
    }
    known.get(&term).copied().unwrap_or(NONE)
}

fn elementary(function: Elementary, at: Complex, real: bool) -> Complex {
    let (x, y) = at;
    if y == 0.0 {
        let value = match function {
            Elementary::Sin => x.sin(),
            Elementary::Cos => x.cos(),
            Elementary::Exp => x.exp(),
            Elementary::Ln => x.ln(),
            Elementary::Root(2) => x.sqrt(),
            Elementary::Root(3) if real => x.cbrt(),
            Elementary::Root(index) if real && index % 2 == 1 => x.signum() * x.abs().powf(1.0 / f64::from(index)),
            Elementary::Root(index) => x.powf(1.0 / f64::from(index)),
            Elementary::Arcsin => x.asin(),
            Elementary::Arccos => x.acos(),
            Elementary::Arctan => x.atan(),
        };
        if real || value.is_finite() {
            return (value, 0.0);
        }
    }
    match function {
        Elementary::Exp => exp(at),
        Elementary::Ln => ln(at),
        Elementary::Root(index) => {
            let (a, b) = ln(at);
            exp((a / f64::from(index), b / f64::from(index)))
        }
        Elementary::Sin => (x.sin() * y.cosh(), x.cos() * y.sinh()),
        Elementary::Cos => (x.cos() * y.cosh(), -x.sin() * y.sinh()),
        _ => (f64::NAN, f64::NAN),
    }
}
