//! The elementary functions: one table, from which all parts of the program take what they know of them.

use super::{At, Equation, Name, Names, Relation, Tree, read, read_expression};
use num_complex::Complex64;
use std::sync::OnceLock;

/// The sign of a function at -x: f(-x) is f(x) or -f(x).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    Even,
    Odd,
}

/// The way in which the reader takes a function of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A function of the tree, known too where it is written in letters: `sin(x)`.
    Spelled,
    /// A function of the tree, by its command only: `Re` may be the Reynolds number.
    Command,
    /// Read as this expression in `x`.
    Reads(&'static str),
}

/// One elementary function: a row of the table. Formulas are TeX in `x`, and `y` is the value.
#[derive(Debug)]
pub struct Elementary {
    /// The command that prints it and names it in trees, such as `\sinh`.
    pub command: &'static str,
    /// Other words for it, without backslash.
    words: &'static [&'static str],
    kind: Kind,
    /// True if LaTeX has no such command, so that it is printed by `\operatorname`.
    is_operator: bool,
    /// True if a letter before the argument is a power, as in `\sin^n x`.
    pub has_powers: bool,
    /// The formula in simpler functions that it is equal to, where it has a value.
    definition: Option<&'static str>,
    derivative: Option<&'static str>,
    /// The condition under which it has a value; empty where it always has one.
    domain: &'static str,
    /// The bounds of its values.
    range: &'static str,
    pub parity: Option<Parity>,
    /// The function whose inverse it is, on the range of this one.
    pub inverse_of: Option<&'static str>,
    /// True if it is the sum of its Taylor series about each point of its domain, over the complex numbers too.
    pub is_analytic: bool,
    /// Its value as a function of real numbers, NaN outside the domain, and its principal value over the complex numbers.
    pub real: fn(f64) -> f64,
    pub complex: fn(Complex64) -> Complex64,
}

/// A function that is analytic everywhere and of which nothing else is said.
const ENTIRE: Elementary = Elementary {
    command: "",
    words: &[],
    kind: Kind::Spelled,
    is_operator: false,
    has_powers: true,
    definition: None,
    derivative: None,
    domain: "",
    range: "",
    parity: None,
    inverse_of: None,
    is_analytic: true,
    real: |_| f64::NAN,
    complex: |_| Complex64::new(f64::NAN, f64::NAN),
};

/// The inverse of a function.
const INVERSE: Elementary = Elementary {
    has_powers: false,
    is_analytic: false,
    ..ENTIRE
};

/// A function of complex numbers whose values are real.
const PART: Elementary = Elementary {
    kind: Kind::Command,
    ..INVERSE
};

/// A function that is read as an expression in others.
const fn reads(command: &'static str, words: &'static [&'static str], means: &'static str) -> Elementary {
    Elementary {
        command,
        words,
        kind: Kind::Reads(means),
        is_operator: true,
        ..ENTIRE
    }
}

static TABLE: [Elementary; 28] = [
    Elementary {
        command: r"\sin",
        derivative: Some(r"\cos x"),
        range: r"y \ge -1, y \le 1",
        parity: Some(Parity::Odd),
        real: f64::sin,
        complex: |z| z.sin(),
        ..ENTIRE
    },
    Elementary {
        command: r"\cos",
        derivative: Some(r"-\sin x"),
        range: r"y \ge -1, y \le 1",
        parity: Some(Parity::Even),
        real: f64::cos,
        complex: |z| z.cos(),
        ..ENTIRE
    },
    Elementary {
        command: r"\tan",
        definition: Some(r"\frac{\sin x}{\cos x}"),
        derivative: Some(r"\frac{1}{\cos(x)^2}"),
        domain: r"\cos(x) \ne 0",
        parity: Some(Parity::Odd),
        real: f64::tan,
        complex: |z| z.tan(),
        ..ENTIRE
    },
    Elementary {
        command: r"\cot",
        definition: Some(r"\frac{\cos x}{\sin x}"),
        derivative: Some(r"-\frac{1}{\sin(x)^2}"),
        domain: r"\sin(x) \ne 0",
        parity: Some(Parity::Odd),
        real: |x| x.tan().recip(),
        complex: |z| z.tan().inv(),
        ..ENTIRE
    },
    Elementary {
        command: r"\sec",
        definition: Some(r"\frac{1}{\cos x}"),
        derivative: Some(r"\sec(x) \tan(x)"),
        domain: r"\cos(x) \ne 0",
        parity: Some(Parity::Even),
        real: |x| x.cos().recip(),
        complex: |z| z.cos().inv(),
        ..ENTIRE
    },
    Elementary {
        command: r"\csc",
        words: &["cosec"],
        definition: Some(r"\frac{1}{\sin x}"),
        derivative: Some(r"-\csc(x) \cot(x)"),
        domain: r"\sin(x) \ne 0",
        parity: Some(Parity::Odd),
        real: |x| x.sin().recip(),
        complex: |z| z.sin().inv(),
        ..ENTIRE
    },
    Elementary {
        command: r"\exp",
        has_powers: false,
        derivative: Some(r"\exp(x)"),
        range: "y > 0",
        real: f64::exp,
        complex: |z| z.exp(),
        ..ENTIRE
    },
    Elementary {
        command: r"\ln",
        derivative: Some(r"\frac{1}{x}"),
        domain: "x > 0",
        inverse_of: Some(r"\exp"),
        real: f64::ln,
        complex: |z| z.ln(),
        ..ENTIRE
    },
    Elementary {
        command: r"\log",
        definition: Some(r"\ln x"),
        derivative: Some(r"\frac{1}{x}"),
        domain: "x > 0",
        real: f64::ln,
        complex: |z| z.ln(),
        ..ENTIRE
    },
    Elementary {
        command: r"\sinh",
        definition: Some(r"\frac{\exp(x) - \exp(-x)}{2}"),
        derivative: Some(r"\cosh x"),
        parity: Some(Parity::Odd),
        real: f64::sinh,
        complex: |z| z.sinh(),
        ..ENTIRE
    },
    Elementary {
        command: r"\cosh",
        definition: Some(r"\frac{\exp(x) + \exp(-x)}{2}"),
        derivative: Some(r"\sinh x"),
        range: r"y \ge 1",
        parity: Some(Parity::Even),
        real: f64::cosh,
        complex: |z| z.cosh(),
        ..ENTIRE
    },
    Elementary {
        command: r"\tanh",
        definition: Some(r"\frac{\sinh x}{\cosh x}"),
        derivative: Some(r"\frac{1}{\cosh(x)^2}"),
        range: "y > -1, y < 1",
        parity: Some(Parity::Odd),
        real: f64::tanh,
        complex: |z| z.tanh(),
        ..ENTIRE
    },
    Elementary {
        command: r"\coth",
        definition: Some(r"\frac{\cosh x}{\sinh x}"),
        derivative: Some(r"-\frac{1}{\sinh(x)^2}"),
        domain: r"x \ne 0",
        parity: Some(Parity::Odd),
        real: |x| x.tanh().recip(),
        complex: |z| z.tanh().inv(),
        ..ENTIRE
    },
    Elementary {
        command: r"\arcsin",
        derivative: Some(r"\frac{1}{\sqrt{1 - x^2}}"),
        domain: r"1 - x^2 \ge 0",
        range: r"y \ge \frac{-\pi}{2}, y \le \frac{\pi}{2}",
        parity: Some(Parity::Odd),
        inverse_of: Some(r"\sin"),
        real: f64::asin,
        complex: |z| z.asin(),
        ..INVERSE
    },
    Elementary {
        command: r"\arccos",
        derivative: Some(r"-\frac{1}{\sqrt{1 - x^2}}"),
        domain: r"1 - x^2 \ge 0",
        range: r"y \ge 0, y \le \pi",
        inverse_of: Some(r"\cos"),
        real: f64::acos,
        complex: |z| z.acos(),
        ..INVERSE
    },
    Elementary {
        command: r"\arctan",
        derivative: Some(r"\frac{1}{1 + x^2}"),
        range: r"y > \frac{-\pi}{2}, y < \frac{\pi}{2}",
        parity: Some(Parity::Odd),
        inverse_of: Some(r"\tan"),
        real: f64::atan,
        complex: |z| z.atan(),
        ..INVERSE
    },
    Elementary {
        command: r"\arsinh",
        words: &["arcsinh"],
        is_operator: true,
        definition: Some(r"\ln(x + \sqrt{x^2 + 1})"),
        derivative: Some(r"\frac{1}{\sqrt{x^2 + 1}}"),
        parity: Some(Parity::Odd),
        inverse_of: Some(r"\sinh"),
        real: f64::asinh,
        complex: |z| z.asinh(),
        ..INVERSE
    },
    Elementary {
        command: r"\arcosh",
        words: &["arccosh"],
        is_operator: true,
        // (Olver et al. 2010, 4.37.19): without two roots it would not be the principal value everywhere
        definition: Some(r"\ln(x + \sqrt{x + 1} \sqrt{x - 1})"),
        derivative: Some(r"\frac{1}{\sqrt{x - 1} \sqrt{x + 1}}"),
        domain: r"x \ge 1",
        range: r"y \ge 0",
        inverse_of: Some(r"\cosh"),
        real: f64::acosh,
        complex: |z| z.acosh(),
        ..INVERSE
    },
    Elementary {
        command: r"\artanh",
        words: &["arctanh"],
        is_operator: true,
        definition: Some(r"\frac{\ln(\frac{1 + x}{1 - x})}{2}"),
        derivative: Some(r"\frac{1}{1 - x^2}"),
        domain: "1 - x^2 > 0",
        parity: Some(Parity::Odd),
        inverse_of: Some(r"\tanh"),
        real: f64::atanh,
        complex: |z| z.atanh(),
        ..INVERSE
    },
    Elementary {
        command: r"\abs",
        is_operator: true,
        derivative: Some(r"\frac{x}{\abs(x)}"),
        range: r"y \ge 0",
        parity: Some(Parity::Even),
        real: f64::abs,
        complex: |z| z.norm().into(),
        ..INVERSE
    },
    Elementary {
        command: r"\sgn",
        is_operator: true,
        range: r"y \ge -1, y \le 1",
        parity: Some(Parity::Odd),
        real: |x| if x == 0.0 { 0.0 } else { x.signum() },
        complex: |z| if z.norm() == 0.0 { z } else { z / z.norm() },
        ..INVERSE
    },
    Elementary {
        command: r"\Re",
        real: |x| x,
        complex: |z| z.re.into(),
        ..PART
    },
    Elementary {
        command: r"\Im",
        real: |x| 0.0 * x,
        complex: |z| z.im.into(),
        ..PART
    },
    Elementary {
        command: r"\arg",
        real: |x| if x < 0.0 { std::f64::consts::PI } else { 0.0 },
        complex: |z| z.arg().into(),
        ..PART
    },
    reads(r"\lg", &[], r"\frac{\ln x}{\ln 10}"),
    reads(r"\sech", &[], r"\frac{1}{\cosh x}"),
    reads(r"\csch", &["cosech"], r"\frac{1}{\sinh x}"),
    reads(r"\arsech", &["arcsech"], r"\arcosh(\frac{1}{x})"),
];

/// The formulas of a row, read.
#[derive(Debug, Default)]
struct Formulas {
    reads: Option<Tree>,
    definition: Option<Tree>,
    derivative: Option<Tree>,
    domain: Vec<Equation>,
    range: Vec<Equation>,
}

/// The formulas of each row, in the order of the table. A formula that cannot be read is missing, which a test would find.
fn formulas() -> &'static [Formulas] {
    static FORMULAS: OnceLock<Vec<Formulas>> = OnceLock::new();
    FORMULAS.get_or_init(|| {
        let names = Names::default();
        let tree = |tex: Option<&str>| read_expression(tex?, &names).ok();
        let relations = |tex: &str| match tex {
            "" => Vec::new(),
            tex => read(tex, &names).unwrap_or_default(),
        };
        let of = |row: &Elementary| Formulas {
            reads: match row.kind {
                Kind::Reads(means) => tree(Some(means)),
                _ => None,
            },
            definition: tree(row.definition),
            derivative: tree(row.derivative),
            domain: relations(row.domain),
            range: relations(row.range),
        };
        TABLE.iter().map(of).collect()
    })
}

/// The tree with `put` in place of the letter, and its own place everywhere.
fn with(tree: &Tree, letter: &str, put: &Tree, at: At) -> Tree {
    match tree {
        Tree::Symbol(name, _) if name.base == letter => put.clone(),
        Tree::Symbol(name, _) => Tree::Symbol(name.clone(), at),
        tree => match tree.map(&mut |part| with(part, letter, put, at)) {
            Tree::Call(name, argument, _) => Tree::Call(name, argument, at),
            Tree::Quotient(above, below, _) => Tree::Quotient(above, below, at),
            Tree::Power(base, exponent, _) => Tree::Power(base, exponent, at),
            Tree::Root(inner, index, _) => Tree::Root(inner, index, at),
            tree => tree,
        },
    }
}

impl Elementary {
    /// All functions.
    pub fn all() -> impl Iterator<Item = &'static Self> {
        TABLE.iter()
    }

    /// The function that trees call by this name, without anything at it.
    pub fn named(name: &Name) -> Option<&'static Self> {
        let is_plain = name.accents.is_empty() && name.subscript.is_empty() && name.mark.is_empty() && name.primes == 0;
        Self::by_command(&name.base).filter(|row| is_plain && !matches!(row.kind, Kind::Reads(_)))
    }

    /// The function of this command, such as `\cos`.
    pub fn by_command(command: &str) -> Option<&'static Self> {
        TABLE.iter().find(|row| row.command == command)
    }

    /// The function that a word or a command names: `cos`, `\cos`, `arcsinh`.
    pub(super) fn by_word(word: &str) -> Option<&'static Self> {
        let word = word.strip_prefix('\\').unwrap_or(word);
        TABLE
            .iter()
            .find(|row| row.command.strip_prefix('\\') == Some(word) || row.words.contains(&word))
    }

    /// The longest function that a run of letters starts with.
    pub(super) fn at_start(run: &str) -> Option<&'static Self> {
        let starts = |row: &&Self| {
            row.kind == Kind::Spelled && row.command.strip_prefix('\\').is_some_and(|word| run.starts_with(word))
        };
        TABLE.iter().filter(starts).max_by_key(|row| row.command.len())
    }

    /// The word that `\operatorname` takes to print it, where LaTeX has no command for it.
    pub(super) fn operator_name(&self) -> Option<&'static str> {
        self.command.strip_prefix('\\').filter(|_| self.is_operator)
    }

    /// Returns the function of the table that is its inverse.
    pub(super) fn inverse(&self) -> Option<&'static Self> {
        TABLE.iter().find(|row| row.inverse_of == Some(self.command))
    }

    /// Returns true for a real or an imaginary part and for the argument of a complex number.
    pub fn is_part(&self) -> bool {
        self.kind == Kind::Command
    }

    /// Its value at an argument, as the reader makes it.
    pub(super) fn of(&self, argument: Box<Tree>, at: usize) -> Box<Tree> {
        // the table itself is read by this, so that only a row that needs one may ask for a formula
        let reads = match self.kind {
            Kind::Reads(_) => self.formulas().reads.as_ref(),
            Kind::Spelled | Kind::Command => None,
        };
        Box::new(match reads {
            Some(tree) => with(tree, "x", &argument, At(at)),
            None => Tree::Call(Name::plain(self.command), argument, At(at)),
        })
    }

    /// Returns its value at an argument in simpler functions; `None` for those that are not made of others.
    pub fn definition(&self, at: &Tree) -> Option<Tree> {
        self.at(self.formulas().definition.as_ref(), at)
    }

    /// The functions of which it is the quotient, the upper one missing where that is 1: `\tan` is sine over cosine.
    pub fn quotient(&self) -> Option<(Option<&'static Self>, &'static Self)> {
        let function = |tree: &Tree| match tree {
            Tree::Call(name, argument, _) if matches!(**argument, Tree::Symbol(..)) => Self::named(name),
            _ => None,
        };
        match self.formulas().definition.as_ref()? {
            Tree::Quotient(above, below, _) => match &**above {
                Tree::Number(_) => Some((None, function(below)?)),
                above => Some((Some(function(above)?), function(below)?)),
            },
            _ => None,
        }
    }

    /// Its derivative at an argument; `None` where it has none of one formula.
    pub fn derivative(&self, at: &Tree) -> Option<Tree> {
        self.at(self.formulas().derivative.as_ref(), at)
    }

    fn at(&self, formula: Option<&Tree>, at: &Tree) -> Option<Tree> {
        Some(with(formula?, "x", at, At::default()))
    }

    /// Returns the conditions on an argument under which it has a value, among real numbers.
    pub fn domain(&self, at: &Tree) -> Vec<Equation> {
        relations(&self.formulas().domain, "x", at)
    }

    /// Returns the bounds of its values, among real numbers.
    pub fn range(&self, value: &Tree) -> Vec<Equation> {
        relations(&self.formulas().range, "y", value)
    }

    /// Returns true if it has a value at each real number.
    pub fn is_total(&self) -> bool {
        self.domain.is_empty()
    }

    /// Returns true if its values have an upper and a lower bound.
    pub fn is_bounded(&self) -> bool {
        let has = |is_one: fn(Relation) -> bool| self.formulas().range.iter().any(|bound| is_one(bound.relation));
        has(|relation| matches!(relation, Relation::Less | Relation::LessOrEqual))
            && has(|relation| matches!(relation, Relation::Greater | Relation::GreaterOrEqual))
    }

    /// Returns true if none of its values is negative.
    pub fn is_never_negative(&self) -> bool {
        self.formulas().range.iter().any(|bound| {
            matches!(bound.relation, Relation::Greater | Relation::GreaterOrEqual)
                && matches!(bound.right, Tree::Number(_))
        })
    }

    fn formulas(&self) -> &'static Formulas {
        static NONE: OnceLock<Formulas> = OnceLock::new();
        let row = TABLE.iter().position(|row| row.command == self.command);
        row.and_then(|row| formulas().get(row))
            .unwrap_or_else(|| NONE.get_or_init(Formulas::default))
    }
}

fn relations(all: &[Equation], letter: &str, put: &Tree) -> Vec<Equation> {
    let of = |tree: &Tree| with(tree, letter, put, At::default());
    all.iter()
        .map(|equation| Equation {
            relation: equation.relation,
            ..Equation::between(of(&equation.left), of(&equation.right))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The value of a formula in `x`.
    fn value(tree: &Tree, x: Complex64) -> Complex64 {
        let of = |tree: &Tree| value(tree, x);
        match tree {
            Tree::Number(number) => number.0.to_f64().value().into(),
            Tree::Symbol(name, _) => match name.base.as_str() {
                "x" => x,
                r"\pi" => std::f64::consts::PI.into(),
                other => panic!("{other}"),
            },
            Tree::Negate(inner) => -of(inner),
            Tree::Sum(terms) => terms.iter().map(of).sum(),
            Tree::Product(factors) => factors.iter().map(of).product(),
            Tree::Quotient(above, below, _) => of(above) / of(below),
            Tree::Power(base, exponent, _) => of(base).powi(*exponent),
            Tree::Root(inner, 2, _) => of(inner).sqrt(),
            Tree::Call(name, argument, _) => (Elementary::named(name).unwrap().complex)(of(argument)),
            other => panic!("{other}"),
        }
    }

    fn holds(equation: &Equation, x: f64) -> bool {
        let side = |tree: &Tree| value(tree, x.into()).re;
        let (left, right) = (side(&equation.left), side(&equation.right));
        match equation.relation {
            Relation::Equal => left == right,
            Relation::NotEqual => left != right,
            Relation::Less => left < right,
            Relation::LessOrEqual => left <= right,
            Relation::Greater => left > right,
            Relation::GreaterOrEqual => left >= right,
        }
    }

    fn near(one: Complex64, other: Complex64, digits: f64) -> bool {
        (one - other).norm() <= digits * (1.0 + one.norm() + other.norm())
    }

    fn at_x() -> Tree {
        Tree::Symbol(Name::plain("x"), At::default())
    }

    #[test]
    fn the_longest_function_is_read_and_each_word_names_one() {
        let found = |run: &str| Elementary::at_start(run).map(|row| row.command);
        assert_eq!(found("sinhx"), Some(r"\sinh"));
        assert_eq!(found("sin"), Some(r"\sin"));
        assert_eq!(found("Re"), None);
        for row in Elementary::all() {
            let words = row.words.iter().copied().chain([row.command]);
            assert!(
                words
                    .map(|word| Elementary::by_word(word).unwrap().command)
                    .all(|command| command == row.command)
            );
            assert_eq!(
                matches!(row.kind, Kind::Reads(_)),
                row.formulas().reads.is_some(),
                "{}",
                row.command
            );
            assert_eq!(
                row.definition.is_some(),
                row.formulas().definition.is_some(),
                "{}",
                row.command
            );
            assert_eq!(
                row.derivative.is_some(),
                row.formulas().derivative.is_some(),
                "{}",
                row.command
            );
            assert_eq!(
                row.domain.is_empty(),
                row.formulas().domain.is_empty(),
                "{}",
                row.command
            );
            assert_eq!(row.range.is_empty(), row.formulas().range.is_empty(), "{}", row.command);
        }
    }

    proptest! {
        #[test]
        fn each_column_is_true_of_the_values(x in -4.0..4.0_f64, im in -4.0..4.0_f64) {
            let tree = at_x();
            for row in Elementary::all().filter(|row| !matches!(row.kind, Kind::Reads(_))) {
                let inside = row.domain(&tree).iter().all(|condition| holds(condition, x));
                let y = (row.real)(x);
                // cos x is nowhere 0 among floating-point numbers
                prop_assert_eq!(inside, y.is_finite(), "{} at {}", row.command, x);
                if inside {
                    // close to a pole both lose digits
                    let digits = 1e-12 * (1.0 + y * y);
                    prop_assert!(near((row.complex)(x.into()), y.into(), digits), "{} at {}", row.command, x);
                    for bound in row.range(&tree) {
                        prop_assert!(holds(&bound, y), "{} at {}: {}", row.command, x, bound);
                    }
                }
                if let Some(function) = row.inverse_of.and_then(Elementary::by_command).filter(|_| inside) {
                    prop_assert!(near((function.real)(y).into(), x.into(), 1e-9), "{} at {}", row.command, x);
                }
                match row.parity {
                    Some(parity) => {
                        let sign = if parity == Parity::Odd { -1.0 } else { 1.0 };
                        let turned = (row.real)(-x);
                        prop_assert!(!inside || near(turned.into(), (sign * y).into(), 1e-12), "{} at {}", row.command, x);
                    }
                    None => prop_assert!(row.domain(&tree).is_empty() || !inside || x.abs() < 1e-9 || !near((row.real)(-x).into(), y.into(), 1e-12)),
                }
                let z = Complex64::new(x, im);
                if let Some(definition) = row.definition(&tree) {
                    prop_assert!(near(value(&definition, z), (row.complex)(z), 1e-9 * (1.0 + (row.complex)(z).norm_sqr())), "{} at {}", row.command, z);
                    prop_assert!(!inside || near(value(&definition, x.into()), y.into(), 1e-9 * (1.0 + y * y)), "{} at {}", row.command, x);
                }
                if let Some(derivative) = row.derivative(&tree).filter(|_| inside) {
                    let step = 1e-6;
                    let difference = ((row.real)(x + step) - (row.real)(x - step)) / (2.0 * step);
                    let slope = value(&derivative, x.into()).re;
                    // a chord says little of a steep curve
                    let is_steep = slope.abs() > 30.0 || !difference.is_finite() || x.abs() < 0.03;
                    prop_assert!(is_steep || (difference - slope).abs() < 1e-4 * (1.0 + slope.abs()), "{} at {}", row.command, x);
                }
            }
        }
    }
}
