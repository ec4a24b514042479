//! The search for definite integrals in the table of known ones: the row, and the values of its letters.

use super::tree::{self, integer, negative, number, product, quotient, root, sum, value};
use claims::{KnownIntegral, Matched, known_integrals};
use numbers::{Field as _, Rational};
use texmath::{Name, Operation, Tree, number_of, rewrite};

/// The most values that are tried for a letter of a row.
const MOST: usize = 24;

/// The points at which integrands are compared, and the largest difference.
const POINTS: [f64; 4] = [0.137, 0.411, 0.773, 0.952];
const CLOSE: f64 = 1e-9;

/// The largest denominator of a factor.
const LARGEST: i64 = 720;

/// A number that stands for a letter.
fn stand_in(name: &Name) -> f64 {
    match name.base.as_str() {
        "e" => std::f64::consts::E,
        "\\pi" => std::f64::consts::PI,
        _ => {
            let seed = name
                .to_string()
                .bytes()
                .fold(7_u32, |sum, byte| sum.wrapping_mul(31).wrapping_add(u32::from(byte)));
            0.6 + f64::from(seed % 97) / 120.0
        }
    }
}

fn at(tree: &Tree, by: &Name, x: f64) -> Option<f64> {
    let found = value(tree, &|name| if name == by { x } else { stand_in(name) });
    found.filter(|value| value.is_finite())
}

fn is_infinite(tree: &Tree) -> bool {
    matches!(tree, Tree::Operation(operation, _) if matches!(**operation, Operation::Infinity))
}

fn is_same(one: &Tree, other: &Tree, by: &Name) -> bool {
    match (is_infinite(one), is_infinite(other)) {
        (false, false) => match (at(one, by, 0.0), at(other, by, 0.0)) {
            (Some(one), Some(other)) => (one - other).abs() < CLOSE,
            _ => false,
        },
        (one, other) => one == other,
    }
}

/// Returns the row of the table that an integral is a multiple of, with the values of its letters.
pub fn known_integral(of: &Tree, by: &Name, limits: [&Tree; 2]) -> Option<Matched> {
    let (factors, rest) = divided(of, by);
    let values = values(&rest, by);
    let fits = |row: &&KnownIntegral| {
        row.limits
            .iter()
            .zip(limits)
            .all(|(own, limit)| is_same(own, limit, by))
    };
    known_integrals().iter().filter(fits).find_map(|row| {
        let of_letter = |letter: &str| match row.speaks_of(letter) {
            true => values.clone(),
            false => vec![integer(1)],
        };
        for a in of_letter("a") {
            for b in of_letter("b") {
                let factor = integer(1);
                let letters = [a.clone(), b];
                let found = Matched { row, factor, letters };
                if let Some(ratio) = ratio(&rest, &found.integrand(by), by) {
                    let factor = product(factors.iter().cloned().chain([number(&ratio)]).collect());
                    return Some(Matched { factor, ..found });
                }
            }
        }
        None
    })
}

/// The factors without the letter, and the rest.
fn divided(of: &Tree, by: &Name) -> (Vec<Tree>, Tree) {
    if !of.has_free(by) {
        return (vec![of.clone()], integer(1));
    }
    match of {
        Tree::Negate(inner) => {
            let (mut factors, rest) = divided(inner, by);
            factors.push(integer(-1));
            (factors, rest)
        }
        Tree::Product(parts) => {
            let (mut factors, mut rest) = (Vec::new(), Vec::new());
            for part in parts {
                let (own, left) = divided(part, by);
                factors.extend(own);
                rest.push(left);
            }
            (factors, product(rest))
        }
        Tree::Quotient(above, below, _) => {
            let ((mut factors, above), (under, below)) = (divided(above, by), divided(below, by));
            factors.extend(under.into_iter().map(|factor| quotient(integer(1), factor)));
            (factors, quotient(above, below))
        }
        of => (Vec::new(), of.clone()),
    }
}

/// The rational number that an integrand is times another one, if its values are.
fn ratio(of: &Tree, row: &Tree, by: &Name) -> Option<Rational> {
    let mut found: Option<f64> = None;
    for x in POINTS {
        let own = at(of, by, x)? / at(row, by, x)?;
        let is_same = found.is_none_or(|known| (known - own).abs() <= CLOSE * known.abs().max(1e-3));
        if !is_same || !own.is_finite() {
            return None;
        }
        found = Some(own);
    }
    let found = found?;
    (1..=LARGEST).find_map(|below| {
        let above = (found * below as f64).round();
        let is_close = (above - found * below as f64).abs() < CLOSE * below as f64 && above != 0.0;
        is_close.then(|| Rational::new(above as i64, below))?
    })
}

/// Values that the letters of a row may have: coefficients, their roots, and exponents.
fn values(of: &Tree, by: &Name) -> Vec<Tree> {
    let mut found: Vec<Tree> = Vec::new();
    let mut push = |tree: Tree| {
        let size = at(&tree, by, 0.0);
        let known = |other: &Tree| at(other, by, 0.0) == size;
        if size.is_some() && !tree.has_free(by) && found.len() < MOST && !found.iter().any(known) {
            found.push(tree);
        }
    };
    push(integer(1));
    collect(of, by, &mut push);
    push(integer(0));
    push(integer(2));
    found
}

fn collect(tree: &Tree, by: &Name, push: &mut dyn FnMut(Tree)) {
    if let Some(inner) = square_root(tree).filter(|_| !tree.has_free(by)) {
        push(inner);
    }
    if !tree.has_free(by) {
        push(tree.clone());
        push(negative(tree.clone()));
        return;
    }
    match tree {
        Tree::Call(_, inner, _) => coefficients(inner, by, push),
        Tree::RealPower(base, exponent, _) if base.has_free(by) => {
            push((**exponent).clone());
            push(sum(vec![(**exponent).clone(), integer(-1)]));
        }
        Tree::RealPower(_, exponent, _) => coefficients(exponent, by, push),
        Tree::Power(_, exponent, _) => push(integer(i64::from(*exponent))),
        _ => {}
    }
    if matches!(tree, Tree::Symbol(..)) {
        push(integer(1));
    }
    tree.find_below(&mut |part| {
        collect(part, by, push);
        None::<()>
    });
}

/// The coefficients of a polynomial of the second degree, or of the powers -2, 0 and 2: by its terms.
fn coefficients(of: &Tree, by: &Name, push: &mut dyn FnMut(Tree)) {
    let terms = match of {
        Tree::Sum(terms) => terms.clone(),
        of => vec![of.clone()],
    };
    for term in terms {
        let one = rewrite(&term, &|name| (name == by).then(|| integer(1)));
        let one = match number_of(&one) {
            Some(value) => number(&value),
            None => one,
        };
        push(one.clone());
        push(negative(one));
    }
}

/// The square root of a square, a letter or a positive number.
fn square_root(tree: &Tree) -> Option<Tree> {
    match tree {
        Tree::Power(base, 2, _) => Some((**base).clone()),
        Tree::Product(factors) => Some(product(factors.iter().map(square_root).collect::<Option<_>>()?)),
        Tree::Symbol(..) => Some(root(tree.clone(), 2)),
        tree => {
            let value: Rational = number_of(tree).filter(|value| *value > Rational::from_integer(0))?;
            Some(tree::square_root(&value))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Names, read_expression};

    fn matched(of: &str, high: &str) -> Option<Matched> {
        let tree = |tex: &str| read_expression(tex, &Names::default()).unwrap();
        let high = match high {
            "" => Tree::Operation(Box::new(Operation::Infinity), texmath::At::default()),
            high => tree(high),
        };
        known_integral(&tree(of), &Name::plain("x"), [&integer(0), &high])
    }

    #[test]
    fn integrals_are_found_in_the_table_with_the_values_of_its_letters() {
        for (of, high) in [
            (r"\frac{\sin(3 x)}{x}", ""),
            (r"\frac{2 \sin(p x)^2}{x^2}", ""),
            (r"\frac{\cos x}{x^2 + 1}", ""),
            (r"\frac{\cos(p x)}{q^2 + x^2}", ""),
            (r"\frac{x}{e^x - 1}", ""),
            (r"\frac{e^{-x} - e^{-3 x}}{x}", ""),
            (r"\frac{x^2 - 1}{\ln x}", "1"),
            (r"\frac{\ln x}{x^2 + 4}", ""),
            (r"\exp(-p x^2 - \frac{q}{x^2})", ""),
            (r"e^{-p x^2} \cos(2 x)", ""),
            (r"\ln(\sin x)", r"\frac{\pi}{2}"),
        ] {
            let found = matched(of, high).unwrap_or_else(|| panic!("{of}"));
            let whole = product(vec![found.factor.clone(), found.integrand(&Name::plain("x"))]);
            let own = read_expression(of, &Names::default()).unwrap();
            assert_eq!(
                ratio(&own, &whole, &Name::plain("x")),
                Some(Rational::from_integer(1)),
                "{of}"
            );
        }
        for of in [r"\frac{\sin x}{x + 1}", r"\frac{x}{e^x - 2}", r"\sin x"] {
            assert!(matched(of, "").is_none(), "{of}");
        }
    }
}
