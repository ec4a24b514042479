//! Sums to infinity with an index of their own, and claims about their terms at each index.

use super::super::premise::Statements;
use super::build::{infinity, integer, negative, sum, summand, symbol};
use super::cases::is_absolute;
use super::derivative::mentions;
use super::germ::End;
use super::induction::with_factorials;
use super::limit::of_limit;
use super::telescope::tidy;
use super::{Goal, Rule, defined, factorial, fresh, is_spoken_of};
use numbers::{Field, Rational};
use texmath::{
    Condition, Equation, Meaning, Name, Operation, Relation, Series, Symbols, Tree, any, index_of, mapped, number_of,
    rewrite,
};

/// A sum to infinity with an index of its own that starts at 0.
#[derive(Clone)]
pub(super) struct Endless {
    pub of: Tree,
    pub index: Name,
    /// The statements with the index as an integer from 0 on.
    pub within: Statements,
    pub symbols: Symbols,
}

/// The term of a sum to infinity, its index and where it starts.
fn parts(node: &Tree) -> Option<(&Tree, &Name, &Tree)> {
    let (of, index, [from, to]) = summand(node)?;
    infinity(to).map(|_| (of, index, from))
}

/// Returns a sum from minus infinity on as a sum to infinity, or as two of them, each of which must have a value; None for
/// other trees.
pub(super) fn from_below(node: &Tree) -> Option<Tree> {
    let (of, index, [from, to]) = summand(node)?;
    let Tree::Operation(_, at) = node else {
        return None;
    };
    (infinity(from) == Some(false)).then_some(())?;
    let series = |of: Tree, from: Tree| {
        let series = Operation::Series {
            kind: Series::Sum,
            of,
            index: index.clone(),
            from,
            to: Tree::Operation(Box::new(Operation::Infinity), *at),
        };
        Tree::Operation(Box::new(series), *at)
    };
    let turned = tidy(&rewrite(of, &|name| (name == index).then(|| negative(symbol(index)))));
    Some(match infinity(to) {
        Some(_) => sum(vec![series(of.clone(), integer(0)), series(turned, integer(1))]),
        None => series(turned, negative(to.clone())),
    })
}

impl Endless {
    pub fn read(node: &Tree, statements: &Statements, symbols: &Symbols) -> Result<Self, String> {
        let (of, index, from) = parts(node).ok_or("a product to infinity")?;
        if is_spoken_of(statements, symbols, index) {
            return Err(format!("premises speak of `{index}`, which the sum is over"));
        }
        if [of, from].into_iter().any(|tree| symbols.may_be_complex(tree)) {
            return Err("a sum of complex numbers to infinity".to_owned());
        }
        let integers = super::integers::integers(statements, symbols);
        if !factorial::is_linear_in(from, &integers) || mentions(from, index) {
            return Err(format!("the start {from} of a sum to infinity is no integer"));
        }
        let is_numbered = |node: &Tree| match node {
            Tree::Symbol(name, _) => index_of(&name.subscript, &index.to_string()).is_some(),
            _ => false,
        };
        if any(of, &mut |node| is_numbered(node)) {
            return Err("the terms of a sum to infinity are numbered names".to_owned());
        }
        let mut symbols = symbols.clone();
        let own = fresh(statements, &symbols, &index.base);
        symbols.let_be_parameter(&own, false);
        symbols.declare(own.clone(), Meaning::Integer);
        let there = sum(vec![symbol(&own), from.clone()]);
        let of = rewrite(of, &|name| (name == index).then(|| there.clone()));
        let of = tidy(&mapped(&of, &|node| without_bars(node, &own)));
        let mut within = statements.clone().by(Rule::SeriesInfinite);
        within.assume.push(at_least(&own, 0));
        Ok(Self {
            of,
            index: own,
            within,
            symbols,
        })
    }

    /// The sum with an index that is not below a number.
    pub fn beyond(&self, first: i64) -> Self {
        let mut own = self.clone();
        own.within.assume.push(at_least(&self.index, first));
        own
    }

    /// A tree with another one in the place of the index.
    pub fn at(&self, tree: &Tree, place: &Tree) -> Tree {
        tidy(&rewrite(tree, &|name| (*name == self.index).then(|| place.clone())))
    }

    /// The claims that what is written has a value and the claim holds, each at every index.
    pub fn at_each_index(&self, claims: Vec<Equation>, lemmas: &mut Vec<Goal>) -> Result<(), String> {
        for claim in claims {
            let mut alone = self.within.clone();
            let part = format!("{claim} at each {}", self.index);
            alone.claims = vec![claim];
            lemmas.extend(with_factorials(&alone, &self.symbols, part)?);
        }
        Ok(())
    }

    /// Returns true if a function of the index has a meaning at integers alone, or another one there.
    pub fn needs_integers(&self, tree: &Tree) -> bool {
        any(tree, &mut |node| needs_integers(node, &self.index))
    }

    /// The claims that what is written has a value and the claim holds, each at every real number from the first one on.
    pub fn at_each_number(&self, claims: Vec<Equation>, first: i64, lemmas: &mut Vec<Goal>) -> Result<(), String> {
        let mut sides = claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
        if sides.any(|side| self.needs_integers(side)) {
            return Err("a function of integers as one of real numbers".to_owned());
        }
        let (x, symbols) = self.real();
        let there = |tree: &Tree| rewrite(tree, &|name| (*name == self.index).then(|| symbol(&x)));
        let mut needed: Vec<Equation> = Vec::new();
        for claim in &claims {
            let claim = Equation {
                left: there(&claim.left),
                right: there(&claim.right),
                ..claim.clone()
            };
            for side in [&claim.left, &claim.right] {
                needed.extend(defined::conditions(side, &symbols)?);
            }
            needed.extend((claim.left != claim.right).then_some(claim));
        }
        let mut alone = self.within.clone();
        let is_of_index = |own: &Condition| own.sides().into_iter().any(|side| side.has_free(&self.index));
        alone.assume.retain(|own| !is_of_index(own));
        alone.assume.push(at_least(&x, first));
        for claim in needed {
            let part = format!("{claim} at each {x}");
            alone.claims = vec![claim];
            let goal = Goal::of(&alone, &symbols, part);
            if !lemmas.iter().any(|own| own.statements == goal.statements) {
                lemmas.push(goal);
            }
        }
        Ok(())
    }

    pub fn lemmas_of(&self, claims: Vec<Equation>) -> Vec<Goal> {
        let goal = |claim: Equation| {
            let mut alone = self.within.clone();
            let part = format!("{claim} for a sum to infinity");
            alone.claims = vec![claim];
            Goal::of(&alone, &self.symbols, part)
        };
        claims.into_iter().map(goal).collect()
    }

    /// The index as a real number: its name, and the symbols with it.
    pub fn real(&self) -> (Name, Symbols) {
        let mut symbols = self.symbols.clone();
        let real = fresh(&self.within, &symbols, "x");
        symbols.let_be_parameter(&real, false);
        (real, symbols)
    }

    /// The limit of a function of the index, which that of the function of a real number is.
    pub fn limit(&self, of: &Tree, lemmas: &mut Vec<Goal>) -> Result<Option<End>, String> {
        let (real, symbols) = self.real();
        let of = rewrite(of, &|name| (*name == self.index).then(|| symbol(&real)));
        let to = Tree::Operation(Box::new(Operation::Infinity), texmath::At::default());
        let found = of_limit(&self.within, &symbols, &of, &real, &to, &[])?;
        lemmas.extend(found.lemmas);
        let has_value = |tree: Tree| Equation::between(tree.clone(), tree);
        lemmas.extend(self.lemmas_of(found.written.into_iter().map(has_value).collect()));
        Ok(found.end)
    }
}

/// The condition that a letter is not below a number.
pub(super) fn at_least(letter: &Name, first: i64) -> Condition {
    Condition::Relation(Equation {
        relation: Relation::GreaterOrEqual,
        ..Equation::between(symbol(letter), integer(first))
    })
}

/// Returns true for a function of the index that has no meaning at other numbers, or another one.
fn needs_integers(node: &Tree, index: &Name) -> bool {
    match node {
        Tree::RealPower(base, exponent, _) => {
            let is_positive = number_of(base).is_none_or(|base: Rational| base > Rational::from_integer(0));
            exponent.has_free(index) && !is_positive
        }
        Tree::Operation(..) => true,
        node => factorial::is_one(node),
    }
}

/// The modulus of a multiple of the index and a number that both have one sign.
fn without_bars(node: &Tree, index: &Name) -> Option<Tree> {
    let Tree::Call(_, inner, _) = node else {
        return None;
    };
    let (factor, offset) = factorial::multiple_of(inner, index).filter(|_| is_absolute(node))?;
    match (factor >= 0 && offset >= 0, factor <= 0 && offset <= 0) {
        (true, _) => Some((**inner).clone()),
        (_, true) => Some(negative((**inner).clone())),
        _ => None,
    }
}
