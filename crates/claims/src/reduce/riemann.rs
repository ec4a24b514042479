//! Limits of Riemann sums as integrals: where `n t(n x, n) = f(x)` for all n > 0 and all x from 0 to c, and f is continuous there, the
//! sum of `t(k, n) = f(k/n)/n` over k from a to c n - b tends to the integral of f from 0 to c, as n tends to infinity.
//!
//! That f is this function, that it is continuous and that all terms have a value are lemmas.

use super::super::premise::Statements;
use super::build::{infinity, integer, negative, product, quotient, sum, summand, symbol};
use super::derivative::mentions;
use super::integers::whole;
use super::limit::carried;
use super::{Goal, Rule, defined, factorial, fresh, has_operation, is_spoken_of, rewritten, trees};
use texmath::{Condition, Equation, Name, Operation, Relation, Symbols, Tree, mapped, rewrite};

/// A sum whose length grows with a letter.
struct RiemannSum<'a> {
    term: Tree,
    index: &'a Name,
    from: &'a Tree,
    to: &'a Tree,
}

/// Returns the statements with limits of Riemann sums as integrals, and what must hold for them to be these; None where there is none.
pub(super) fn integrated(statements: &Statements, symbols: &Symbols) -> Option<(Statements, Vec<Goal>)> {
    let is_complex = |tree: &Tree| symbols.may_be_complex(tree);
    if trees(statements).into_iter().any(is_complex) {
        return None;
    }
    let mut limits = Vec::new();
    trees(statements)
        .into_iter()
        .for_each(|tree| outermost(tree, &mut limits));
    let (mut found, mut lemmas): (Vec<(Tree, Tree)>, Vec<Goal>) = (Vec::new(), Vec::new());
    for limit in limits {
        if let Some((integral, own)) = integral_of(limit, statements, symbols) {
            found.push((limit.clone(), integral));
            lemmas.extend(own);
        }
    }
    let replaced = |node: &Tree| {
        let known = found.iter().find(|(known, _)| known == node);
        // a letter that is bound around a limit is another one than that of the lemmas
        known.map_or_else(
            || binds(node).then(|| node.clone()),
            |(_, integral)| Some(integral.clone()),
        )
    };
    let out = rewritten(statements, Rule::RiemannSum, &|tree| mapped(tree, &replaced));
    (!lemmas.is_empty()).then_some((out, lemmas))
}

fn binds(node: &Tree) -> bool {
    matches!(node, Tree::Operation(operation, _) if operation.letter().is_some())
}

/// Finds the limits in a tree around which no letter is bound, each once.
fn outermost<'a>(tree: &'a Tree, found: &mut Vec<&'a Tree>) {
    if binds(tree) {
        if !found.contains(&tree) {
            found.push(tree);
        }
        return;
    }
    tree.find_below(&mut |part| {
        outermost(part, found);
        None::<()>
    });
}

/// Returns the integral that a limit is, with lemmas.
fn integral_of(node: &Tree, statements: &Statements, symbols: &Symbols) -> Option<(Tree, Vec<Goal>)> {
    let Tree::Operation(operation, at) = node else {
        return None;
    };
    let Operation::Limit { of, by, to } = &**operation else {
        return None;
    };
    // the limit of the other terms exists where that of all does
    if let Tree::Sum(terms) = of {
        let limit = |of: Tree| {
            let (by, to) = (by.clone(), to.clone());
            Tree::Operation(Box::new(Operation::Limit { of, by, to }), *at)
        };
        let parts = terms.iter().enumerate();
        return parts.into_iter().find_map(|(place, term)| {
            let (integral, lemmas) = integral_of(&limit(term.clone()), statements, symbols)?;
            let mut others = terms.clone();
            others.remove(place);
            Some((sum(vec![limit(sum(others)), integral]), lemmas))
        });
    }
    let riemann = RiemannSum::of(of, symbols)?;
    let (times, more) = factorial::multiple_of(riemann.to, by)?;
    let is_long = times >= 1 && more <= 0 && whole(riemann.from)? >= 0;
    let is_free = |name: &Name| !is_spoken_of(statements, symbols, name) && symbols.running() != Some(name);
    let is_alone = riemann.index != by && is_free(by) && is_free(riemann.index);
    let is_carried = [by, riemann.index].into_iter().any(|name| carried(of, name).is_some());
    if infinity(to) != Some(true) || !is_long || !is_alone || is_carried || has_operation(&riemann.term, symbols) {
        return None;
    }
    let (integral, lemmas) = riemann.integral(by, times, statements, symbols)?;
    Some((Tree::Operation(Box::new(integral), *at), lemmas))
}

impl RiemannSum<'_> {
    /// Returns the integral from 0 to a number, and what must hold for the sum to tend to it.
    fn integral(
        &self,
        length: &Name,
        times: i64,
        statements: &Statements,
        symbols: &Symbols,
    ) -> Option<(Operation, Vec<Goal>)> {
        let x = fresh(statements, symbols, "x");
        let mut extended = symbols.clone();
        extended.let_be_parameter(&x, false);
        let n = fresh(statements, &extended, "n");
        extended.let_be_parameter(&n, true);
        let at_values = |place: Tree, many: Tree| {
            rewrite(&self.term, &|name| match name {
                name if name == self.index => Some(place.clone()),
                name if name == length => Some(many.clone()),
                _ => None,
            })
        };
        let term = at_values(product(vec![symbol(&n), symbol(&x)]), symbol(&n));
        let integrand = at_values(symbol(&x), integer(1));
        let mut claims = defined::conditions(&term, &extended).ok()?;
        claims.extend(defined::conditions(&integrand, &extended).ok()?);
        claims.push(Equation::between(product(vec![symbol(&n), term]), integrand.clone()));
        let mut base = statements.clone().by(Rule::RiemannSum);
        let bounds = [(Relation::GreaterOrEqual, 0), (Relation::LessOrEqual, times)];
        base.assume.extend(bounds.map(|(relation, bound)| {
            Condition::Relation(Equation {
                relation,
                ..Equation::between(symbol(&x), integer(bound))
            })
        }));
        let lemma = |claim: Equation| {
            let mut alone = base.clone();
            let part = format!("the Riemann sum: {claim}");
            alone.claims = vec![claim];
            Goal::of(&alone, &extended, part)
        };
        let lemmas = claims.into_iter().map(lemma).collect();
        let limits = Some((integer(0), integer(times)));
        let (of, by) = (integrand, x);
        Some((Operation::Integral { of, by, limits }, lemmas))
    }
}

impl<'a> RiemannSum<'a> {
    /// Reads a sum with factors, which are taken into its terms.
    fn of(tree: &'a Tree, symbols: &Symbols) -> Option<Self> {
        let scaled = |mut own: Self, by: &dyn Fn(Tree) -> Tree, factors: &[Tree]| {
            let is_apart = |factor: &Tree| !has_operation(factor, symbols) && !mentions(factor, own.index);
            factors.iter().all(is_apart).then(|| {
                own.term = by(own.term);
                own
            })
        };
        if let Some((of, index, [from, to])) = summand(tree) {
            return Some(Self {
                term: of.clone(),
                index,
                from,
                to,
            });
        }
        match tree {
            Tree::Negate(inner) => scaled(Self::of(inner, symbols)?, &negative, &[]),
            Tree::Quotient(above, below, _) => {
                let by = |term: Tree| quotient(term, (**below).clone());
                scaled(Self::of(above, symbols)?, &by, std::slice::from_ref(below))
            }
            Tree::Product(factors) => {
                let (place, own) = (factors.iter().enumerate())
                    .find_map(|(place, factor)| Some((place, Self::of(factor, symbols)?)))?;
                let mut others = factors.clone();
                others.remove(place);
                let by = |term: Tree| product(others.iter().cloned().chain([term]).collect());
                scaled(own, &by, &others)
            }
            _ => None,
        }
    }
}
