//! Terms in floating point: to choose points before anything exact is done.

use kernel::{Elementary, Node, Symbol, Term, Terms};
use std::collections::{BTreeSet, HashMap};

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

/// A value with the size of what cancels in it: the sum of the sizes of the terms of sums.
#[derive(Clone, Copy, Debug)]
pub struct Sized {
    pub value: Complex,
    pub size: f64,
}

impl Sized {
    const NONE: Self = Self {
        value: (f64::NAN, f64::NAN),
        size: f64::NAN,
    };

    fn plain(value: Complex) -> Self {
        Self {
            value,
            size: value.0.hypot(value.1),
        }
    }

    pub fn is_finite(&self) -> bool {
        self.value.0.is_finite() && self.value.1.is_finite()
    }

    /// Whether it may be 0 but for rounding.
    pub fn may_vanish(&self) -> bool {
        self.value.0.hypot(self.value.1) <= 1e-9 * self.size.max(1e-3)
    }

    /// Whether it is 0 as far as can be told.
    pub fn vanishes(&self) -> bool {
        self.value.0.hypot(self.value.1) <= 1e-12 * self.size.max(1.0)
    }

    /// Whether its imaginary part is 0 as far as can be told.
    pub fn is_real(&self) -> bool {
        self.value.1.abs() <= 1e-12 * self.size.max(1.0)
    }
}

/// Terms, to be evaluated at many points.
pub struct Program {
    /// Each with the places of its parts, and its value where it is a number.
    nodes: Vec<(Node, Vec<usize>, f64)>,
    wanted: Vec<usize>,
    real: bool,
}

impl Program {
    /// The program for these terms.
    pub fn new(terms: &Terms, wanted: &[Term], real: bool) -> Self {
        let all: BTreeSet<Term> = wanted.iter().flat_map(|&term| terms.inside(term)).collect();
        let places: HashMap<Term, usize> = all.iter().enumerate().map(|(place, term)| (*term, place)).collect();
        let place = |term: &Term| places.get(term).copied().unwrap_or_default();
        let nodes = all.iter().map(|&term| {
            let node = terms.node(term).clone();
            let number = match &node {
                Node::Number(value) => value.0.to_f64().value(),
                Node::Integral { .. } => terms.bounds(term).map_or(f64::NAN, |[low, _]| low.0.to_f64().value()),
                _ => f64::NAN,
            };
            (node, terms.parts(term).iter().map(place).collect(), number)
        });
        Self {
            nodes: nodes.collect(),
            wanted: wanted.iter().map(place).collect(),
            real,
        }
    }

    /// The values at a point; NaN where there is none, or where a function leaves the reals.
    pub fn at(&self, symbols: &HashMap<Symbol, Complex>) -> Vec<Sized> {
        let mut values: Vec<Sized> = Vec::with_capacity(self.nodes.len());
        for (node, parts, number) in &self.nodes {
            let of = |n: usize| {
                parts
                    .get(n)
                    .and_then(|&place| values.get(place))
                    .copied()
                    .unwrap_or(Sized::NONE)
            };
            let all = || (0..parts.len()).map(of);
            let value = match node {
                Node::Number(_) | Node::Integral { .. } => Sized::plain((*number, 0.0)),
                Node::Pi => Sized::plain((std::f64::consts::PI, 0.0)),
                Node::Imaginary => Sized::plain((0.0, 1.0)),
                Node::Symbol(symbol) => symbols.get(symbol).copied().map_or(Sized::NONE, Sized::plain),
                Node::Sum(_) => Sized {
                    value: all().fold((0.0, 0.0), |(a, b), part| (a + part.value.0, b + part.value.1)),
                    size: all().map(|part| part.size).sum(),
                },
                Node::Product(_) => Sized {
                    value: all().fold((1.0, 0.0), |product, part| times(product, part.value)),
                    size: all().map(|part| part.size).product(),
                },
                Node::Power(_, exponent) => Sized {
                    value: power(of(0).value, *exponent),
                    size: of(0).size.powi(*exponent),
                },
                Node::Quotient(..) => {
                    let (above, below) = (of(0), of(1));
                    if below.value == (0.0, 0.0) {
                        Sized::NONE
                    } else {
                        Sized {
                            value: over(above.value, below.value),
                            size: above.size / below.value.0.hypot(below.value.1),
                        }
                    }
                }
                Node::RealPower(..) => Sized::plain(real_power(of(0).value, of(1).value, self.real)),
                Node::Elementary(function, _) => Sized::plain(elementary(*function, of(0).value, self.real)),
                Node::Value(..) | Node::Bound => Sized::NONE,
            };
            values.push(value);
        }
        let wanted = self.wanted.iter();
        wanted
            .map(|&place| values.get(place).copied().unwrap_or(Sized::NONE))
            .collect()
    }
}

fn power(base: Complex, exponent: i32) -> Complex {
    if base.1 == 0.0 {
        (base.0.powi(exponent), 0.0)
    } else {
        (0..exponent.min(1000)).fold((1.0, 0.0), |power, _| times(power, base))
    }
}

fn real_power(base: Complex, exponent: Complex, real: bool) -> Complex {
    if base == (0.0, 0.0) && exponent.0 > 0.0 {
        (0.0, 0.0)
    } else if base.1 == 0.0 && exponent.1 == 0.0 && (real || base.0 > 0.0) {
        (base.0.powf(exponent.0), 0.0)
    } else {
        exp(times(exponent, ln(base)))
    }
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
