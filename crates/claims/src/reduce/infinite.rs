//! Sums to infinity, by terms of known sums and differences that telescope: with rows `T_j` of the table and a function
//! `G` of which `t(k) = \sum_j c_j T_j(k + s_j) + G(k + 1) - G(k)` holds at each k from 0 on, the partial sums of `t` up to
//! n - 1 are those of the rows, and `G(n) - G(0)`. So the sum is `\sum_j c_j (S_j - \sum_{k < s_j} T_j(k))`, and the limit
//! of `G` less `G(0)`, where each row converges and `G` has a limit.
//!
//! Nothing is taken on trust from a proposal: the equation between the terms, that all of it has a value at each index, the
//! conditions under which the rows converge and what the limit needs are lemmas.

use super::super::premise::Statements;
use super::build::{difference, infinity, integer, is_zero, product, sum, symbol};
use super::derivative::mentions;
use super::germ::End;
use super::induction::with_factorials;
use super::limit::of_limit;
use super::table::Row;
use super::telescope::tidy;
use super::{Goal, Proposals, Rule, defined, factorial, fresh, is_spoken_of, rewritten, trees};
use std::collections::BTreeSet;
use texmath::{
    Condition, Equation, Meaning, Name, Operation, Relation, Series, Symbols, Tree, any, index_of, mapped, number_of,
    rewrite,
};

/// The most terms of a row that stand before its part in a sum.
const MOST_BEFORE: i64 = 60;

/// A multiple of the terms of a row, from an index on.
#[derive(Clone, Debug)]
pub struct Multiple {
    pub factor: Tree,
    pub row: Row,
    pub x: Tree,
    /// The index of the row at the index 0 of the sum.
    pub shift: i64,
}

/// The terms of a sum, as those of known sums and the differences `G(k + 1) - G(k)` of a function of the index.
#[derive(Clone, Debug)]
pub struct Proposal {
    pub rows: Vec<Multiple>,
    /// G.
    pub telescoping: Tree,
}

/// The value of a sum to infinity.
struct Value {
    tree: Tree,
    /// The claims that must hold for it to be that.
    lemmas: Vec<Goal>,
    region: Region,
    /// Conditions that hold wherever the sum has a value.
    known: Vec<Equation>,
}

/// The region in which a sum to infinity converges.
#[derive(Default)]
struct Region {
    conditions: Vec<Equation>,
    /// Outside of it the sum has no value unless this is 0: then all of its terms are.
    factor: Option<Tree>,
}

impl Proposal {
    /// Returns the factor of a sum of one row, or of powers times a polynomial with numbers as coefficients.
    fn factor(&self) -> Option<Tree> {
        let first = self.rows.first().filter(|_| is_zero(&self.telescoping))?;
        let is_number = |factor: &Tree| number_of(factor).is_some_and(|value| !value.0.is_zero());
        let is_like = |own: &Multiple| {
            matches!(own.row, Row::Geometric(_))
                && own.x == first.x
                && own.shift == first.shift
                && is_number(&own.factor)
        };
        let orders: BTreeSet<Option<i64>> = self.rows.iter().map(|own| own.row.order()).collect();
        let are_powers = self.rows.iter().all(is_like) && orders.len() == self.rows.len();
        (self.rows.len() == 1 || are_powers).then(|| first.factor.clone())
    }
}

/// The statements without sums to infinity.
pub(super) struct Summed {
    pub statements: Statements,
    pub lemmas: Vec<Goal>,
    pub converging: Vec<Equation>,
    /// The statements where the terms of a sum that need these conditions are 0, which decide the claim there.
    pub where_zero: Option<Statements>,
}

/// The term of a sum to infinity, its index and where it starts.
fn parts(node: &Tree) -> Option<(&Tree, &Name, &Tree)> {
    let Tree::Operation(operation, _) = node else {
        return None;
    };
    match &**operation {
        Operation::Series {
            kind: Series::Sum,
            of,
            index,
            from,
            to,
        } => infinity(to).map(|_| (of, index, from)),
        _ => None,
    }
}

fn is_one(node: &Tree) -> bool {
    match node {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Series { to, .. } => infinity(to).is_some(),
            _ => false,
        },
        _ => false,
    }
}

/// Returns true if a sum to infinity stands in a tree.
pub(super) fn stands_in(tree: &Tree) -> bool {
    any(tree, &mut |node| is_one(node))
}

/// The sums to infinity in a tree that stand in no other one.
///
/// # Errors
/// The operation that binds a letter in which one stands.
fn outermost(tree: &Tree, found: &mut Vec<Tree>) -> Result<(), String> {
    if is_one(tree) {
        if !found.contains(tree) {
            found.push(tree.clone());
        }
        return Ok(());
    }
    if let Tree::Operation(operation, _) = tree
        && operation.letter().is_some()
        && stands_in(tree)
    {
        return Err("a sum to infinity within a sum, an integral, a limit or a derivative".to_owned());
    }
    let mut fault = None;
    tree.find_below(&mut |part| {
        fault = outermost(part, found).err();
        fault.is_some().then_some(())
    });
    fault.map_or(Ok(()), Err)
}

fn replaced(tree: &Tree, values: &[(Tree, Tree)]) -> Tree {
    mapped(tree, &|node| {
        let known = values.iter().find(|(known, _)| known == node);
        known.map(|(_, value)| value.clone())
    })
}

/// The statements with each sum to infinity replaced by its value; None where there is none.
///
/// # Errors
/// Why a sum has no value that is known here.
pub(super) fn summed(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Option<Summed>, String> {
    if !trees(statements).into_iter().any(stands_in) {
        return Ok(None);
    }
    let mut all = Vec::new();
    for tree in trees(statements) {
        outermost(tree, &mut all)?;
    }
    let (mut values, mut lemmas, mut known) = (Vec::new(), Vec::new(), Vec::new());
    let mut regions: Vec<(Tree, Region)> = Vec::new();
    let plain = without_sums(statements);
    for node in all {
        let value = Endless::read(&node, &plain, symbols)?.value(proposals)?;
        lemmas.extend(value.lemmas);
        known.extend(value.known);
        if !value.region.conditions.is_empty() {
            regions.push((node.clone(), value.region));
        }
        values.push((node, value.tree));
    }
    // a way of an equivalence is to be shown to have a value
    if statements.is_way {
        known.clear();
    }
    let with = |values: &[(Tree, Tree)]| {
        let mut own = rewritten(statements, Rule::SeriesInfinite, &|tree| replaced(tree, values));
        assume(&mut own, &known);
        own
    };
    let (mut converging, mut where_zero) = (Vec::new(), None);
    // of several sums one may be 0 where another has no value
    if let [
        (
            node,
            Region {
                conditions,
                factor: Some(factor),
            },
        ),
    ] = regions.as_slice()
    {
        converging.clone_from(conditions);
        if number_of(factor).is_none() {
            let zero = |(other, value): &(Tree, Tree)| {
                let value = if other == node { integer(0) } else { value.clone() };
                (other.clone(), value)
            };
            let mut there = with(&values.iter().map(zero).collect::<Vec<_>>());
            assume(&mut there, &[Equation::between(factor.clone(), integer(0))]);
            where_zero = Some(there);
        }
    }
    for lemma in &mut lemmas {
        assume(&mut lemma.statements, &known);
    }
    Ok(Some(Summed {
        statements: with(&values),
        lemmas,
        converging,
        where_zero,
    }))
}

fn assume(statements: &mut Statements, known: &[Equation]) {
    for condition in known.iter().cloned().map(Condition::Relation) {
        if !statements.assume.contains(&condition) {
            statements.assume.push(condition);
        }
    }
}

/// The statements without what is said of sums to infinity.
fn without_sums(statements: &Statements) -> Statements {
    let mut plain = statements.clone();
    let is_plain = |condition: &Condition| !condition.sides().into_iter().any(stands_in);
    plain.assume.retain(is_plain);
    plain.premises.retain(|premise| {
        let sides = [&premise.equation.left, &premise.equation.right];
        !sides.into_iter().any(stands_in) && premise.assume.iter().all(is_plain)
    });
    plain
}

/// A sum to infinity with an index of its own that starts at 0.
struct Endless {
    of: Tree,
    index: Name,
    /// The statements with the index as an integer from 0 on.
    within: Statements,
    symbols: Symbols,
}

/// Returns true if the sum of the terms of a proposal diverges, whatever the letters are: where one row alone has terms outside of the
/// region where it converges, where these are a polynomial that is not 0 times powers, and where the harmonic series
/// stands beside what converges.
fn diverges(proposal: &Proposal) -> bool {
    let is_nonzero = |own: &&Multiple| number_of(&own.factor).is_some_and(|factor| !is_zero(&Tree::Number(factor)));
    let harmonic: Vec<&Multiple> = proposal.rows.iter().filter(|own| own.row == Row::Harmonic).collect();
    if let [single] = harmonic.as_slice() {
        let mut others = proposal.rows.iter().filter(|own| own.row != Row::Harmonic);
        return is_nonzero(single) && others.all(|own| own.row.region(&own.x).is_empty());
    }
    let Some(first) = proposal.rows.first() else {
        return false;
    };
    let orders: BTreeSet<i64> = proposal.rows.iter().filter_map(|own| own.row.order()).collect();
    let is_one_kind = proposal.rows.len() == 1 || orders.len() == proposal.rows.len();
    let is_outside = |own: &Equation| super::instances::relation_holds(own) == Some(false);
    is_one_kind
        && is_zero(&proposal.telescoping)
        && proposal
            .rows
            .iter()
            .all(|own| own.x == first.x && number_of(&own.factor).is_some())
        && proposal.rows.iter().any(|own| is_nonzero(&own))
        && first.row.region(&first.x).iter().any(is_outside)
}

impl Endless {
    fn read(node: &Tree, statements: &Statements, symbols: &Symbols) -> Result<Self, String> {
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
        let of = tidy(&rewrite(of, &|name| (name == index).then(|| there.clone())));
        let mut within = statements.clone().by(Rule::SeriesInfinite);
        within.assume.push(Condition::Relation(Equation {
            relation: Relation::GreaterOrEqual,
            ..Equation::between(symbol(&own), integer(0))
        }));
        Ok(Self {
            of,
            index: own,
            within,
            symbols,
        })
    }

    /// The claims that what is written has a value and the claim holds, each at every index.
    fn at_each_index(&self, claims: Vec<Equation>, lemmas: &mut Vec<Goal>) -> Result<(), String> {
        for claim in claims {
            let mut alone = self.within.clone();
            let part = format!("{claim} at each {}", self.index);
            alone.claims = vec![claim];
            lemmas.extend(with_factorials(&alone, &self.symbols, part)?);
        }
        Ok(())
    }

    fn value(mut self, proposals: &dyn Proposals) -> Result<Value, String> {
        let mut lemmas = Vec::new();
        let (mut known, mut inner) = (Vec::new(), Vec::new());
        let mut all = Vec::new();
        outermost(&self.of, &mut all)?;
        for node in all {
            let value = Self::read(&node, &self.within, &self.symbols)?.value(proposals)?;
            lemmas.extend(value.lemmas);
            lemmas.extend(self.lemmas_of(value.known));
            inner.push((node, value.tree));
        }
        self.of = replaced(&self.of, &inner);
        let mut needed = Vec::new();
        defined::necessary(&self.of, &mut needed);
        needed.retain(|own| !mentions(&own.left, &self.index) && !mentions(&own.right, &self.index));
        known.extend(needed);
        self.at_each_index(defined::conditions(&self.of, &self.symbols)?, &mut lemmas)?;
        let proposal = proposals.summation(&self.of, &self.index, &self.symbols);
        let proposal = proposal.ok_or("no closed form of a sum to infinity is found")?;
        let (tree, region) = self.by(&proposal, &mut lemmas)?;
        for lemma in &mut lemmas {
            assume(&mut lemma.statements, &known);
        }
        Ok(Value {
            tree,
            lemmas,
            region,
            known,
        })
    }

    fn lemmas_of(&self, claims: Vec<Equation>) -> Vec<Goal> {
        let goal = |claim: Equation| {
            let mut alone = self.within.clone();
            let part = format!("{claim} for a sum to infinity");
            alone.claims = vec![claim];
            Goal::of(&alone, &self.symbols, part)
        };
        claims.into_iter().map(goal).collect()
    }

    /// The value by a proposal, and where it is one.
    fn by(&self, proposal: &Proposal, lemmas: &mut Vec<Goal>) -> Result<(Tree, Region), String> {
        let index = symbol(&self.index);
        let telescoping = |at: Tree| {
            tidy(&rewrite(&proposal.telescoping, &|name| {
                (*name == self.index).then(|| at.clone())
            }))
        };
        let next = telescoping(sum(vec![index.clone(), integer(1)]));
        let mut terms = vec![difference(next, telescoping(index.clone()))];
        let (mut value, mut regions): (Vec<Tree>, Vec<Equation>) = (Vec::new(), Vec::new());
        let diverges = diverges(proposal);
        for Multiple { factor, row, x, shift } in &proposal.rows {
            let is_moved = mentions(factor, &self.index) || mentions(x, &self.index);
            if is_moved || *shift < row.first() || *shift > MOST_BEFORE {
                return Err("a row of the table that does not fit a sum".to_owned());
            }
            let there = sum(vec![index.clone(), integer(*shift)]);
            terms.push(product(vec![factor.clone(), tidy(&row.term(&there, x))]));
            if diverges {
                continue;
            }
            let whole = row.value(x).ok_or("a sum that the table does not have")?;
            let before = (row.first()..*shift).map(|k| tidy(&row.term(&integer(k), x)));
            value.push(product(vec![factor.clone(), difference(whole, sum(before.collect()))]));
            for condition in row.region(x) {
                if !regions.contains(&condition) {
                    regions.push(condition);
                }
            }
        }
        let right = sum(terms);
        let mut claims = defined::conditions(&right, &self.symbols)?;
        claims.push(Equation::between(self.of.clone(), right));
        self.at_each_index(claims, lemmas)?;
        lemmas.extend(self.lemmas_of(regions.clone()));
        if diverges {
            if !is_zero(&proposal.telescoping) {
                self.limit(&proposal.telescoping, lemmas)?;
            }
            // what has no value is written as a quotient that has none
            return Ok((super::build::quotient(integer(1), integer(0)), Region::default()));
        }
        if !is_zero(&proposal.telescoping) {
            value.push(self.limit(&proposal.telescoping, lemmas)?);
            value.push(super::build::negative(telescoping(integer(0))));
        }
        regions.retain(|condition| super::instances::relation_holds(condition) != Some(true));
        Ok((
            sum(value),
            Region {
                factor: proposal.factor().filter(|_| !regions.is_empty()),
                conditions: regions,
            },
        ))
    }

    /// The limit of a function of the index, which that of the function of a real number is.
    fn limit(&self, of: &Tree, lemmas: &mut Vec<Goal>) -> Result<Tree, String> {
        let mut symbols = self.symbols.clone();
        let real = fresh(&self.within, &symbols, "x");
        symbols.let_be_parameter(&real, false);
        let of = rewrite(of, &|name| (*name == self.index).then(|| symbol(&real)));
        let to = Tree::Operation(Box::new(Operation::Infinity), texmath::At::default());
        let found = of_limit(&self.within, &symbols, &of, &real, &to, &[])?;
        lemmas.extend(found.lemmas);
        let has_value = |tree: Tree| Equation::between(tree.clone(), tree);
        lemmas.extend(self.lemmas_of(found.written.into_iter().map(has_value).collect()));
        match found.end {
            Some(End::Finite(value)) => Ok(*value),
            _ => Err("a sum to infinity that diverges, as far as it is followed".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::build::{plain, real_power};
    use super::*;

    /// The sum of powers of x from 0 on with a proposal.
    struct Proposed(Proposal);

    impl Proposals for Proposed {
        fn summation(&self, _: &Tree, _: &Name, _: &Symbols) -> Option<Proposal> {
            Some(self.0.clone())
        }
    }

    fn powers(proposal: &Proposal) -> Result<Summed, String> {
        let mut symbols = Symbols::default();
        for name in ["x", "k"] {
            symbols.let_be_parameter(&plain(name), false);
        }
        symbols.declare(plain("k"), Meaning::Integer);
        let sum = Operation::Series {
            kind: Series::Sum,
            of: real_power(symbol(&plain("x")), symbol(&plain("k"))),
            index: plain("k"),
            from: integer(0),
            to: Tree::Operation(Box::new(Operation::Infinity), texmath::At::default()),
        };
        let node = Tree::Operation(Box::new(sum), texmath::At::default());
        let statements = Statements {
            claims: vec![Equation::between(node, integer(2))],
            ..Statements::default()
        };
        summed(&statements, &symbols, &Proposed(proposal.clone())).map(Option::unwrap)
    }

    fn multiple(factor: Tree, shift: i64) -> Proposal {
        Proposal {
            rows: vec![Multiple {
                factor,
                row: Row::Geometric(0),
                x: symbol(&plain("x")),
                shift,
            }],
            telescoping: integer(0),
        }
    }

    #[test]
    fn a_proposal_becomes_lemmas_on_its_terms_and_on_where_it_converges() {
        let found = powers(&multiple(integer(1), 0)).unwrap();
        assert!(!found.statements.claims.iter().any(|claim| stands_in(&claim.left)));
        assert_eq!(found.converging.len(), 2);
        let claims: Vec<String> = found
            .lemmas
            .iter()
            .map(|goal| goal.statements.claims[0].to_string())
            .collect();
        assert!(claims.iter().any(|claim| claim.contains("x < 1")), "{claims:?}");
        assert!(
            claims.iter().any(|claim| claim.matches(" = ").count() == 1),
            "{claims:?}"
        );
    }

    #[test]
    fn terms_are_compared_at_letters_outside_of_the_region_too() {
        let found = powers(&multiple(integer(1), 0)).unwrap();
        let goals = super::super::Reduced {
            lemmas: found.lemmas,
            converging: found.converging,
            ..Default::default()
        };
        let further = super::super::under_conditions(&goals).unwrap().goals;
        let is_assumed = |goal: &Goal| {
            let assumed = |claim: &Equation| goal.statements.assume.contains(&Condition::Relation(claim.clone()));
            goals.converging.iter().all(assumed)
        };
        for goal in &further.lemmas {
            let states_it = goals.converging.contains(&goal.statements.claims[0]);
            assert_eq!(is_assumed(goal), states_it, "{}", goal.part);
        }
    }

    #[test]
    fn a_factor_that_moves_and_a_row_that_begins_too_early_are_no_proposals() {
        assert!(powers(&multiple(integer(1), -1)).is_err());
        assert!(
            powers(&multiple(
                symbol(&Name {
                    primes: 1,
                    ..plain("k")
                }),
                0
            ))
            .is_err()
        );
    }
}
