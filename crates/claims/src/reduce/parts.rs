//! Antiderivatives of sums of products with derivatives of unknown functions: `f g' + f' g` is the derivative of `f g`.
//!
//! Nothing rests on what is found: it is shown to be an antiderivative.

use super::build::{integer, power, product, quotient, sum};
use super::derivative::{By, mentions};
use numbers::{Field, Rational};
use texmath::{At, Name, Symbols, Tree, any, mapped, number_of};

/// The most terms, and the most steps.
const MOST: usize = 60;
const STEPS: usize = 12;

/// A number times powers of trees, each once.
#[derive(Clone, Debug)]
struct Monomial {
    number: Rational,
    powers: Vec<(Tree, i32)>,
}

impl Monomial {
    fn number(number: Rational) -> Self {
        let powers = Vec::new();
        Self { number, powers }
    }

    fn times(&self, other: &Self) -> Self {
        let mut total = self.clone();
        total.number *= other.number.clone();
        for (tree, exponent) in &other.powers {
            total.raise(tree, *exponent);
        }
        total
    }

    fn raise(&mut self, tree: &Tree, by: i32) {
        match self.powers.iter_mut().find(|(known, _)| known == tree) {
            Some((_, exponent)) => *exponent = exponent.saturating_add(by),
            None => self.powers.push((tree.clone(), by)),
        }
        self.powers.retain(|(_, exponent)| *exponent != 0);
    }

    fn is_like(&self, other: &Self) -> bool {
        self.powers.len() == other.powers.len() && self.powers.iter().all(|power| other.powers.contains(power))
    }

    fn tree(&self) -> Tree {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let zero = Rational::from_integer(0);
        above.push(match self.number < zero {
            true => Tree::Negate(Box::new(Tree::Number(zero - self.number.clone()))),
            false => Tree::Number(self.number.clone()),
        });
        for (tree, exponent) in &self.powers {
            let factors = if *exponent < 0 { &mut below } else { &mut above };
            factors.push(power(tree.clone(), exponent.saturating_abs()));
        }
        quotient(product(above), product(below))
    }
}

/// A search for an antiderivative by `by`.
pub(super) struct Parts<'a> {
    pub by: &'a Name,
    pub symbols: &'a Symbols,
    /// The slope of what is linear.
    pub slope: &'a dyn Fn(&Tree) -> Option<Tree>,
    /// An antiderivative of what holds no unknown function.
    pub known: &'a dyn Fn(&Tree) -> Option<Tree>,
}

impl Parts<'_> {
    pub fn integrated(&self, tree: &Tree) -> Option<Tree> {
        let mut rest = self.monomials(&self.with_declared(tree))?;
        let mut found = Vec::new();
        let by = By {
            symbols: self.symbols,
            name: self.by,
        };
        for _ in 0..STEPS {
            let is_unknown = |monomial: &Monomial| monomial.powers.iter().any(|(tree, _)| self.holds_function(tree));
            if !rest.iter().any(is_unknown) {
                if !rest.is_empty() {
                    found.push((self.known)(&sum(rest.iter().map(Monomial::tree).collect()))?);
                }
                return Some(sum(found));
            }
            let whole = rest.iter().find_map(|monomial| self.candidate(monomial, &rest))?.tree();
            let slope = self.monomials(&self.with_declared(&by.of(&whole).ok()?))?;
            let minus = Monomial::number(Rational::from_integer(-1));
            rest.extend(slope.iter().map(|monomial| monomial.times(&minus)));
            rest = gathered(rest)?;
            found.push(whole);
        }
        None
    }

    /// The tree with derivatives by the names that are declared for them, as \\dot f for f'.
    fn with_declared(&self, tree: &Tree) -> Tree {
        mapped(tree, &|node| {
            let Tree::Call(name, argument, at) = node else {
                return None;
            };
            let plain = Name {
                primes: 0,
                ..name.clone()
            };
            let mut functions = self.symbols.functions();
            let (_, slope) = functions.find(|(function, _)| name.primes > 0 && **function == plain)?;
            let Some(Tree::Symbol(slope, _)) = slope else {
                return None;
            };
            let next = Name {
                primes: slope.primes.saturating_add(name.primes).saturating_sub(1),
                ..slope.clone()
            };
            (next != *name).then(|| self.with_declared(&Tree::Call(next, argument.clone(), *at)))
        })
    }

    fn holds_function(&self, tree: &Tree) -> bool {
        any(
            tree,
            &mut |node| matches!(node, Tree::Call(name, ..) if self.symbols.is_function(name)),
        ) && mentions(tree, self.by)
    }

    /// What a monomial is the first term of the derivative of: its derivative of highest order, none higher in the rest,
    /// stands there once.
    fn candidate(&self, monomial: &Monomial, rest: &[Monomial]) -> Option<Monomial> {
        let orders = rest.iter().flat_map(|monomial| &monomial.powers);
        let highest = orders.filter_map(|(tree, _)| self.order(tree)).max()?;
        let (derivative, _) = monomial
            .powers
            .iter()
            .find(|(tree, exponent)| *exponent == 1 && self.order(tree) == Some(highest))?;
        let before = self.before(derivative)?;
        let Tree::Call(_, argument, _) = derivative else {
            return None;
        };
        let slope = (self.slope)(argument)?;
        let mut whole = monomial.clone();
        whole.raise(derivative, -1);
        whole.raise(&before, 1);
        let exponent = whole.powers.iter().find(|(tree, _)| *tree == before);
        let exponent = exponent
            .map(|(_, exponent)| *exponent)
            .filter(|exponent| *exponent != 0)?;
        whole.number /= Rational::from_integer(i64::from(exponent));
        match number_of(&slope) {
            Some(number) if number == Rational::from_integer(0) => None,
            Some(number) => {
                whole.number /= number;
                Some(whole)
            }
            None => {
                whole.raise(&slope, -1);
                Some(whole)
            }
        }
    }

    /// How often a value of an unknown function is differentiated.
    fn order(&self, tree: &Tree) -> Option<u32> {
        let Tree::Call(name, ..) = tree else {
            return None;
        };
        if !self.symbols.is_function(name) || !mentions(tree, self.by) {
            return None;
        }
        let (mut order, mut value) = (0, tree.clone());
        while let Some(before) = self.before(&value).filter(|_| order < 8) {
            order += 1;
            value = before;
        }
        Some(order)
    }

    /// The value of the function whose derivative a value is.
    fn before(&self, value: &Tree) -> Option<Tree> {
        let Tree::Call(name, argument, _) = value else {
            return None;
        };
        let name = self.symbols.antiderivative_of(name)?;
        Some(Tree::Call(name, argument.clone(), At::default()))
    }

    fn monomials(&self, tree: &Tree) -> Option<Vec<Monomial>> {
        if let Some(number) = number_of(tree) {
            return gathered(vec![Monomial::number(number)]);
        }
        match tree {
            Tree::Negate(inner) => self.multiplied(&[integer(-1), (**inner).clone()]),
            Tree::Sum(parts) => {
                let mut total = Vec::new();
                for part in parts {
                    total.extend(self.monomials(part)?);
                }
                gathered(total)
            }
            Tree::Product(factors) => self.multiplied(factors),
            Tree::Power(base, exponent @ 1..=8, _) => {
                let factors: Vec<Tree> = (0..*exponent).map(|_| (**base).clone()).collect();
                self.multiplied(&factors)
            }
            Tree::Quotient(above, below, _) if !mentions(below, self.by) => {
                let over = match number_of(below) {
                    Some(number) if number == Rational::from_integer(0) => return None,
                    Some(number) => Monomial::number(Rational::from_integer(1) / number),
                    None => Monomial {
                        number: Rational::from_integer(1),
                        powers: vec![((**below).clone(), -1)],
                    },
                };
                let above = self.monomials(above)?;
                gathered(above.iter().map(|monomial| monomial.times(&over)).collect())
            }
            tree => Some(vec![Monomial {
                number: Rational::from_integer(1),
                powers: vec![(tree.clone(), 1)],
            }]),
        }
    }

    fn multiplied(&self, factors: &[Tree]) -> Option<Vec<Monomial>> {
        let mut total = vec![Monomial::number(Rational::from_integer(1))];
        for factor in factors {
            let own = self.monomials(factor)?;
            let pairs = total.iter().flat_map(|one| own.iter().map(|other| one.times(other)));
            total = gathered(pairs.collect())?;
        }
        Some(total)
    }
}

/// The monomials with like ones added; `None` where they are too many.
fn gathered(monomials: Vec<Monomial>) -> Option<Vec<Monomial>> {
    let mut total: Vec<Monomial> = Vec::new();
    for monomial in monomials {
        match total.iter_mut().find(|known| known.is_like(&monomial)) {
            Some(known) => known.number += monomial.number,
            None => total.push(monomial),
        }
    }
    total.retain(|monomial| monomial.number != Rational::from_integer(0));
    (total.len() <= MOST).then_some(total)
}

#[cfg(test)]
mod tests {
    use super::super::super::fault::Fault;
    use super::super::super::symbols::RawSymbols;
    use super::super::antiderivative::antiderivative;
    use super::super::build::plain;

    fn found(tex: &str) -> Result<Option<String>, Fault> {
        let symbols: RawSymbols = toml::from_str("times = ['x']\nfunctions = ['f', 'g']\nparameters = ['a']").unwrap();
        let symbols = symbols.read()?;
        let tree = texmath::read_expression(tex, &symbols.names).unwrap();
        Ok(antiderivative(&tree, &plain("x"), &symbols).map(|whole| whole.to_string()))
    }

    #[test]
    fn products_of_unknown_functions_are_undone() {
        for (tex, wanted) in [
            ("f(x) g'(x) + f'(x) g(x)", "f(x) g(x)"),
            ("f''(x) f(x) + f'(x)^2", r"f(x) \dot{f}(x)"),
        ] {
            assert_eq!(found(tex).unwrap().as_deref(), Some(wanted), "{tex}");
        }
        for tex in ["f(x) g'(x)", "f(x)", "f(x) f''(x)", "f'(x^2)", "f'(x)^2"] {
            assert_eq!(found(tex).unwrap(), None, "{tex}");
        }
        for tex in ["f'(a x)", "x f'(x) + f(x)", r"f'(x) + \cos x"] {
            assert!(found(tex).unwrap().is_some(), "{tex}");
        }
    }
}
