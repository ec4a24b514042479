//! Terms of the kernel as TeX.

use kernel::{Elementary, Node, Term, Terms};
use num_traits::{One, Zero};
use numbers::Rational;

/// How tightly what is printed binds: sums, products, and what needs no brackets.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

/// A term as TeX.
pub fn tex(terms: &Terms, term: Term) -> String {
    print(terms, term).0
}

fn within(terms: &Terms, term: Term, binding: Binding) -> String {
    let (text, own) = print(terms, term);
    let negative = text.starts_with('-') && binding > Binding::Sum;
    match own < binding || negative {
        true => format!("({text})"),
        false => text,
    }
}

/// A factor that is a number: beside letters `1/2 x` could be read in two ways.
fn coefficient(value: &Rational) -> String {
    let (above, below) = (value.0.numerator(), value.0.denominator());
    match below == &dashu_int::UBig::ONE {
        true => number(value),
        false => format!("\\frac{{{above}}}{{{below}}}"),
    }
}

/// A rational number, as `1/2`.
pub fn number(value: &Rational) -> String {
    value.0.to_string()
}

fn print(terms: &Terms, term: Term) -> (String, Binding) {
    match terms.node(term) {
        Node::Number(value) => match value.0.denominator() == &dashu_int::UBig::ONE {
            true => (number(value), Binding::Atom),
            false => (number(value), Binding::Product),
        },
        Node::Pi => ("\\pi".into(), Binding::Atom),
        Node::Imaginary => ("i".into(), Binding::Atom),
        Node::Bound => ("x".into(), Binding::Atom),
        Node::Integral { of, low, high } => {
            let [of, low, high] = [of, low, high].map(|part| tex(terms, *part));
            (format!("\\int_{{{low}}}^{{{high}}} {of} dx"), Binding::Sum)
        }
        Node::Symbol(symbol) => (terms.symbol_name(*symbol).to_string(), Binding::Atom),
        Node::Sum(parts) => {
            let mut text = String::new();
            for part in parts {
                let (part, _) = print(terms, *part);
                match (text.is_empty(), part.strip_prefix('-')) {
                    (true, _) => text = part,
                    (false, Some(part)) => text = format!("{text} - {part}"),
                    (false, None) => text = format!("{text} + {part}"),
                }
            }
            (text, Binding::Sum)
        }
        Node::Product(parts) => {
            let mut negative = false;
            let mut rest = Vec::new();
            for part in parts {
                let Node::Number(value) = terms.node(*part) else {
                    rest.push(within(terms, *part, Binding::Product));
                    continue;
                };
                let is_below = *value < Rational::zero();
                negative ^= is_below;
                let size = if is_below { -value.clone() } else { value.clone() };
                if size != Rational::one() {
                    rest.push(coefficient(&size));
                }
            }
            let text = rest
                .into_iter()
                .reduce(|text, factor| match factor.starts_with(|c: char| c.is_ascii_digit()) {
                    true => format!("{text} \\cdot {factor}"),
                    false => format!("{text} {factor}"),
                });
            let text = text.unwrap_or_else(|| "1".to_string());
            match negative {
                true => (format!("-{text}"), Binding::Product),
                false => (text, Binding::Product),
            }
        }
        // as derivatives of squares leave it
        Node::Power(base, 1) => print(terms, *base),
        Node::Power(base, exponent) => (
            format!("{}^{{{exponent}}}", within(terms, *base, Binding::Atom)),
            Binding::Power,
        ),
        Node::Quotient(above, below) => (
            format!("\\frac{{{}}}{{{}}}", tex(terms, *above), tex(terms, *below)),
            Binding::Power,
        ),
        Node::RealPower(base, exponent) => (
            format!("{}^{{{}}}", within(terms, *base, Binding::Atom), tex(terms, *exponent)),
            Binding::Power,
        ),
        Node::Elementary(Elementary::Exp, of) => match tex(terms, *of).as_str() {
            "1" => ("e".into(), Binding::Atom),
            of => (format!("e^{{{of}}}"), Binding::Power),
        },
        Node::Elementary(function, of) => {
            let of = tex(terms, *of);
            let text = match function {
                Elementary::Root(2) => format!("\\sqrt{{{of}}}"),
                Elementary::Root(index) => format!("\\sqrt[{index}]{{{of}}}"),
                Elementary::Exp => format!("\\exp({of})"),
                Elementary::Sin => format!("\\sin({of})"),
                Elementary::Cos => format!("\\cos({of})"),
                Elementary::Ln => format!("\\ln({of})"),
                Elementary::Arcsin => format!("\\arcsin({of})"),
                Elementary::Arccos => format!("\\arccos({of})"),
                Elementary::Arctan => format!("\\arctan({of})"),
            };
            (text, Binding::Atom)
        }
        Node::Value(function, order, at) => (
            format!(
                "{}{}({})",
                terms.function_name(*function),
                "'".repeat(*order as usize),
                tex(terms, *at)
            ),
            Binding::Atom,
        ),
    }
}

/// A closed term in its simplest form: numbers are added up and multiplied, zeros and ones left out.
pub fn simplified(terms: &mut Terms, term: Term) -> Term {
    let value = |terms: &Terms, term: Term| match terms.node(term) {
        Node::Number(value) => Some(value.clone()),
        _ => None,
    };
    terms.rewrite(term, &mut |terms, node| match node {
        Node::Sum(parts) => {
            let mut flat = Vec::new();
            for part in parts {
                match terms.node(*part) {
                    Node::Sum(inner) => flat.extend(inner.clone()),
                    _ => flat.push(*part),
                }
            }
            let number = flat
                .iter()
                .filter_map(|part| value(terms, *part))
                .fold(Rational::zero(), |a, b| a + b);
            let mut rest: Vec<Term> = flat.into_iter().filter(|part| value(terms, *part).is_none()).collect();
            if !number.is_zero() || rest.is_empty() {
                rest.insert(0, terms.number(number));
            }
            Some(terms.sum(rest))
        }
        Node::Product(parts) => {
            let mut flat = Vec::new();
            for part in parts {
                match terms.node(*part) {
                    Node::Product(inner) => flat.extend(inner.clone()),
                    _ => flat.push(*part),
                }
            }
            let number = flat
                .iter()
                .filter_map(|part| value(terms, *part))
                .fold(Rational::one(), |a, b| a * b);
            let mut rest: Vec<Term> = flat.into_iter().filter(|part| value(terms, *part).is_none()).collect();
            if number.is_zero() {
                return Some(terms.integer(0));
            }
            if !number.is_one() || rest.is_empty() {
                rest.insert(0, terms.number(number));
            }
            Some(terms.product(rest))
        }
        Node::Power(base, 1) => Some(*base),
        Node::Power(base, exponent) => {
            let base = value(terms, *base)?;
            let power = (0..exponent.unsigned_abs().min(64)).fold(Rational::one(), |power, _| power * base.clone());
            match *exponent {
                0..=64 => Some(terms.number(power)),
                -64..0 if !base.is_zero() => Some(terms.number(Rational::one() / power)),
                _ => None,
            }
        }
        Node::Quotient(above, below) => {
            let divisor = value(terms, *below)?;
            if divisor.is_zero() {
                return None;
            }
            match value(terms, *above) {
                Some(above) => Some(terms.number(above / divisor)),
                None if divisor.is_one() => Some(*above),
                None => None,
            }
        }
        Node::Elementary(Elementary::Sin, of) if value(terms, *of)?.is_zero() => Some(*of),
        Node::Elementary(Elementary::Cos | Elementary::Exp, of) if value(terms, *of)?.is_zero() => {
            Some(terms.integer(1))
        }
        Node::Elementary(Elementary::Ln, of) if value(terms, *of)?.is_one() => Some(terms.integer(0)),
        Node::Elementary(Elementary::Root(2), of) => {
            let root = crate::algebra::rational_root(&value(terms, *of)?.0)?;
            Some(terms.number(Rational(root)))
        }
        _ => None,
    })
}
