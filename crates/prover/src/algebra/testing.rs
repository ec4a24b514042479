//! What the tests share: polynomials from text, random polynomials, identities multiplied out.

use super::{Steps, combination};
use kernel::{Polynomial, Term};
use numbers::Rational;
use proptest::prelude::*;

/// The generator of a letter.
pub(super) fn generator(letter: char) -> Term {
    Term(letter as u32)
}

/// A polynomial in letters: `poly("x^2 y - 3/2 z + (a + 1)^2 b")`.
pub(super) fn poly(text: &str) -> Polynomial {
    let text: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
    let mut at = 0;
    let sum = parse_sum(&text, &mut at);
    assert_eq!(at, text.len(), "all of the text is read");
    sum
}

pub(super) fn polys(texts: &[&str]) -> Vec<Polynomial> {
    texts.iter().map(|text| poly(text)).collect()
}

fn parse_sum(text: &[char], at: &mut usize) -> Polynomial {
    let mut sum = Polynomial::default();
    loop {
        let negative = match text.get(*at) {
            Some('+') => {
                *at += 1;
                false
            }
            Some('-') => {
                *at += 1;
                true
            }
            None | Some(')') => return sum,
            _ => false,
        };
        let mut product = Polynomial::integer(if negative { -1 } else { 1 });
        while let Some(&c) = text.get(*at)
            && !"+-)".contains(c)
        {
            product = product.times(&parse_factor(text, at));
        }
        sum = sum.plus(&product);
    }
}

fn parse_number(text: &[char], at: &mut usize) -> i64 {
    let start = *at;
    while text.get(*at).is_some_and(char::is_ascii_digit) {
        *at += 1;
    }
    text[start..*at].iter().collect::<String>().parse().unwrap()
}

fn parse_factor(text: &[char], at: &mut usize) -> Polynomial {
    let base = match text[*at] {
        '(' => {
            *at += 1;
            let inner = parse_sum(text, at);
            assert_eq!(text[*at], ')');
            *at += 1;
            inner
        }
        c if c.is_ascii_digit() => {
            let numerator = parse_number(text, at);
            let denominator = if text.get(*at) == Some(&'/') {
                *at += 1;
                parse_number(text, at)
            } else {
                1
            };
            Polynomial::constant(&Rational::new(numerator, denominator).unwrap())
        }
        c => {
            *at += 1;
            Polynomial::generator(generator(c))
        }
    };
    if text.get(*at) != Some(&'^') {
        return base;
    }
    *at += 1;
    (0..parse_number(text, at)).fold(Polynomial::integer(1), |power, _| power.times(&base))
}

/// Enough for every test.
pub(super) fn plenty() -> Steps {
    Steps::new(1_000_000_000)
}

/// `sum a[i] b[i]`
pub(super) fn sum_of_products(a: &[Polynomial], b: &[Polynomial]) -> Polynomial {
    assert_eq!(a.len(), b.len());
    combination(a.iter().zip(b), &mut plenty()).unwrap()
}

/// A random polynomial in the first letters with few terms.
pub(super) fn any_polynomial(generators: usize, terms: usize, degree: u32) -> impl Strategy<Value = Polynomial> {
    let term = (prop::collection::vec(0..=degree, generators), -5i64..=5, 1i64..=2);
    prop::collection::vec(term, 1..=terms).prop_map(|list| {
        list.into_iter()
            .fold(Polynomial::default(), |sum, (exponents, numerator, denominator)| {
                let start = Polynomial::constant(&Rational::new(numerator, denominator).unwrap());
                let product = exponents.iter().zip('a'..).fold(start, |product, (exponent, letter)| {
                    (0..*exponent).fold(product, |power, _| {
                        power.times(&Polynomial::generator(generator(letter)))
                    })
                });
                sum.plus(&product)
            })
    })
}
