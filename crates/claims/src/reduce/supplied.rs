//! Antiderivatives that premises give: an indefinite integral that a claim follows from. That it is one is a lemma.

use super::super::definition::CONSTANT_OF_INTEGRATION;
use super::super::premise::Statements;
use super::build::{negative, plain, sum, symbol};
use super::defined::necessary;
use super::derivative::By;
use super::integral::{integrand, terms};
use super::{Goal, Matched, Proposal, Proposals, Rule, SeriesTest, has_operation};
use texmath::{Condition, Equation, Name, Relation, Symbols, Tree, rewrite};

/// A search that knows the antiderivatives which premises give.
pub(super) struct Supplied<'a> {
    search: &'a dyn Proposals,
    /// Integrands, the letter of each and its antiderivative.
    known: Vec<(Tree, Name, Tree)>,
}

impl Proposals for Supplied<'_> {
    fn antiderivative(&self, of: &Tree, by: &Name, symbols: &Symbols) -> Option<Tree> {
        let found = self.known.iter().find_map(|(integrand, letter, whole)| {
            let renamed = |tree: &Tree| rewrite(tree, &|name| (name == letter).then(|| symbol(by)));
            (renamed(integrand) == *of).then(|| renamed(whole))
        });
        found.or_else(|| self.search.antiderivative(of, by, symbols))
    }

    fn zeros(&self, of: &Tree, by: &Name, between: [&Tree; 2]) -> Vec<Tree> {
        self.search.zeros(of, by, between)
    }

    fn known_integral(&self, of: &Tree, by: &Name, limits: [&Tree; 2]) -> Option<Matched> {
        self.search.known_integral(of, by, limits)
    }

    fn telescoping(&self, term: &Tree, index: &Name, symbols: &Symbols) -> Option<Tree> {
        self.search.telescoping(term, index, symbols)
    }

    fn summation(&self, term: &Tree, index: &Name, symbols: &Symbols) -> Option<Proposal> {
        self.search.summation(term, index, symbols)
    }

    fn series_test(&self, term: &Tree, index: &Name, symbols: &Symbols) -> Option<SeriesTest> {
        self.search.series_test(term, index, symbols)
    }
}

/// The statements without premises that give an antiderivative, the search that knows these, and that they are ones as lemmas;
/// None where there is no such premise.
pub(super) fn supplied<'a>(
    statements: &Statements,
    symbols: &Symbols,
    search: &'a dyn Proposals,
) -> Option<(Statements, Supplied<'a>, Vec<Goal>)> {
    let constant = plain(CONSTANT_OF_INTEGRATION);
    let without_constant = |tree: &Tree| {
        let mut own = Vec::new();
        terms(tree, false, &mut own);
        let is_constant = |term: &Tree| !symbols.knows(&constant) && *term == symbol(&constant);
        let own = own.into_iter().filter(|(_, term)| !is_constant(term));
        sum(own
            .map(|(is_negative, term)| if is_negative { negative(term) } else { term })
            .collect())
    };
    let (mut known, mut lemmas, mut given) = (Vec::new(), Vec::new(), Vec::new());
    let mut rest = statements.clone();
    let mut premises = std::mem::take(&mut rest.premises);
    premises.retain(|premise| {
        let Equation { left, right, .. } = &premise.equation;
        let pairs = [(left, right), (right, left)].into_iter();
        let mut integrals = pairs.filter_map(|(side, other)| integrand(side).map(|own| (own, other)));
        let Some(((of, by), other)) = integrals.next() else {
            return true;
        };
        let whole = without_constant(other);
        let is_plain = premise.equation.relation == Relation::Equal && premise.locals.is_empty();
        let has_operation = |tree: &Tree| has_operation(tree, symbols);
        if !is_plain || has_operation(of) || has_operation(&whole) || whole.has_free(&constant) {
            return true;
        }
        let Ok(slope) = (By { symbols, name: by }).of(&whole) else {
            return true;
        };
        lemmas.push((Equation::between(slope, of.clone()), premise.assume.clone()));
        // it says of its letters what it needs to have a value
        let mut needed = Vec::new();
        [left, right].into_iter().for_each(|side| necessary(side, &mut needed));
        given.extend(premise.assume.iter().cloned());
        given.extend(
            needed
                .into_iter()
                .filter(|own| !own.left.has_free(by) && !own.right.has_free(by))
                .map(Condition::Relation),
        );
        known.push((of.clone(), by.clone(), whole));
        false
    });
    rest.premises = premises;
    rest.assume.extend(given);
    let lemma = |(claim, assume): (Equation, Vec<Condition>)| {
        let mut alone = rest.clone().by(Rule::IntegralDifferentiated);
        let part = format!("a premise: {claim}");
        alone.assume.extend(assume);
        alone.claims = vec![claim];
        Goal::of(&alone, symbols, part)
    };
    let lemmas: Vec<Goal> = lemmas.into_iter().map(lemma).collect();
    (!known.is_empty()).then(|| (rest, Supplied { search, known }, lemmas))
}
