//! Sums to infinity, by terms of known sums and differences that telescope: with rows `T_j` of the table and a function
//! `G` of which `t(k) = \sum_j c_j T_j(k + s_j) + G(k + 1) - G(k)` holds at each k from 0 on, the partial sums of `t` up to
//! n - 1 are those of the rows, and `G(n) - G(0)`. So the sum is `\sum_j c_j (S_j - \sum_{k < s_j} T_j(k))`, and the limit
//! of `G` less `G(0)`, where each row converges and `G` has a limit.
//!
//! Nothing is taken on trust from a proposal: the equation between the terms, that all of it has a value at each index, the
//! conditions under which the rows converge and what the limit needs are lemmas.

use super::super::premise::Statements;
use super::build::{difference, infinity, integer, is_zero, product, quotient, related, sum, symbol};
use super::derivative::mentions;
use super::endless::{Endless, from_below};
use super::germ::End;
use super::series::guess_at;
use super::table::Row;
use super::tails::{Tested, tested};
use super::telescope::tidy;
use super::unbounded::{infinite, is_infinite, with_values, without_value};
use super::{Goal, Proposals, Rule, defined, fresh, has_operation, rewritten, trees};
use std::collections::BTreeSet;
use texmath::{Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, mapped, number_of, rewrite};

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
    amount: Amount,
    /// The claims that must hold for it to be that.
    lemmas: Vec<Goal>,
    region: Region,
    /// Conditions that hold wherever the sum has a value.
    known: Vec<Equation>,
}

enum Amount {
    /// A number, or infinity.
    Is(Box<Tree>),
    Between(Box<[Tree; 2]>),
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
    /// The symbols with letters for sums, which lie between bounds.
    pub symbols: Symbols,
    /// True if such letters are left in the statements, which the claim follows from.
    pub is_bounded: bool,
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

/// The values of the sums to infinity in statements.
struct Values {
    values: Vec<(Tree, Tree)>,
    lemmas: Vec<Goal>,
    known: Vec<Equation>,
    regions: Vec<(Tree, Region)>,
    /// The symbols with letters, from 0 to 1, for the places of sums between their bounds.
    symbols: Symbols,
    letters: Vec<Name>,
}

impl Values {
    fn of(statements: &Statements, symbols: &Symbols, proposals: &dyn Proposals) -> Result<Self, String> {
        let mut own = Self {
            values: Vec::new(),
            lemmas: Vec::new(),
            known: Vec::new(),
            regions: Vec::new(),
            symbols: symbols.clone(),
            letters: Vec::new(),
        };
        let mut all = Vec::new();
        for tree in trees(statements) {
            outermost(tree, &mut all)?;
        }
        let plain = without_sums(statements);
        let may_be_infinite = statements.claims.iter().any(is_infinite);
        for node in all {
            let value = Endless::read(&node, &plain, symbols)?.value(proposals, may_be_infinite)?;
            own.lemmas.extend(value.lemmas);
            own.known.extend(value.known);
            if !value.region.conditions.is_empty() {
                own.regions.push((node.clone(), value.region));
            }
            let tree = match value.amount {
                Amount::Is(tree) => *tree,
                Amount::Between(bounds) => {
                    let [low, high] = *bounds;
                    let name = fresh(statements, &own.symbols, "s");
                    own.symbols.let_be_parameter(&name, false);
                    own.letters.push(name.clone());
                    sum(vec![low.clone(), product(vec![symbol(&name), difference(high, low)])])
                }
            };
            own.values.push((node, tree));
        }
        let is_claimed = trees(&plain).len() == trees(statements).len();
        if !own.letters.is_empty() && (statements.is_way || !own.regions.is_empty() || !is_claimed) {
            return Err("bounds of a sum in a condition, or beside one that converges under conditions".to_owned());
        }
        Ok(own)
    }
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
    let whole = rewritten(statements, Rule::SeriesInfinite, &|tree| mapped(tree, &from_below));
    let statements = &whole;
    if !trees(statements).into_iter().any(stands_in) {
        return Ok(None);
    }
    let Values {
        values,
        mut lemmas,
        mut known,
        regions,
        symbols: extended,
        letters,
    } = Values::of(statements, symbols, proposals)?;
    // a way of an equivalence is to be shown to have a value
    if statements.assert_values() {
        known.clear();
    }
    let with = |values: &[(Tree, Tree)]| {
        let mut own = with_values(statements, Rule::SeriesInfinite, values)?;
        assume(&mut own, &known);
        Ok::<Statements, String>(own)
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
            let mut there = with(&values.iter().map(zero).collect::<Vec<_>>())?;
            assume(&mut there, &[Equation::between(factor.clone(), integer(0))]);
            where_zero = Some(there);
        }
    }
    for lemma in &mut lemmas {
        assume(&mut lemma.statements, &known);
    }
    let (statements, refuting) = within_bounds(with(&values)?, &letters, &extended);
    let is_bounded = !letters.is_empty() && refuting.is_none();
    lemmas.extend(refuting);
    Ok(Some(Summed {
        statements,
        lemmas,
        converging,
        where_zero,
        symbols: extended,
        is_bounded,
    }))
}

/// The statements with letters from 0 to 1 for the places of sums between their bounds; where a claim is likely to fail for
/// all of these, which is a lemma, the statements at one of them.
fn within_bounds(mut statements: Statements, letters: &[Name], symbols: &Symbols) -> (Statements, Option<Goal>) {
    let within = letters.iter().flat_map(|letter| {
        let related = |relation: Relation, bound: i64| related(symbol(letter), relation, integer(bound));
        [related(Relation::GreaterOrEqual, 0), related(Relation::LessOrEqual, 1)]
    });
    assume(&mut statements, &within.collect::<Vec<_>>());
    let opposite = |claim: &Equation| {
        let sides = [&claim.left, &claim.right];
        let is_plain = !letters.is_empty() && !sides.iter().any(|side| has_operation(side, symbols));
        let more = |place: f64| {
            let value = |side: &Tree| guess_at(side, &|name| letters.contains(name).then_some(place));
            Some(value(&claim.left)? - value(&claim.right)?)
        };
        let (low, high) = (more(0.0)?, more(1.0)?);
        let relation = match claim.relation {
            Relation::Equal if low * high > 0.0 => Relation::NotEqual,
            Relation::Less if low >= 0.0 && high >= 0.0 => Relation::GreaterOrEqual,
            Relation::LessOrEqual if low > 0.0 && high > 0.0 => Relation::Greater,
            Relation::Greater if low <= 0.0 && high <= 0.0 => Relation::LessOrEqual,
            Relation::GreaterOrEqual if low < 0.0 && high < 0.0 => Relation::Less,
            _ => return None,
        };
        is_plain.then(|| related(claim.left.clone(), relation, claim.right.clone()))
    };
    let Some(opposite) = statements.claims.iter().find_map(opposite) else {
        return (statements, None);
    };
    let mut lemma = statements.clone().by(Rule::SeriesTest);
    let part = format!("{opposite} for all values of a sum between its bounds");
    lemma.claims = vec![opposite];
    let half = |name: &Name| letters.contains(name).then(|| quotient(integer(1), integer(2)));
    let refuted = rewritten(&statements, Rule::SeriesTest, &|tree| rewrite(tree, &half));
    (refuted, Some(Goal::of(&lemma, symbols, part)))
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
    fn value(mut self, proposals: &dyn Proposals, may_be_infinite: bool) -> Result<Value, String> {
        let mut lemmas = Vec::new();
        let (mut known, mut inner) = (Vec::new(), Vec::new());
        let mut all = Vec::new();
        outermost(&self.of, &mut all)?;
        for node in all {
            let value = Self::read(&node, &self.within, &self.symbols)?.value(proposals, false)?;
            lemmas.extend(value.lemmas);
            lemmas.extend(self.lemmas_of(value.known));
            match value.amount {
                Amount::Is(tree) if infinity(&tree).is_none() => inner.push((node, *tree)),
                _ => return Err("a sum to infinity of sums that have no closed form".to_owned()),
            }
        }
        self.of = replaced(&self.of, &inner);
        let mut needed = Vec::new();
        defined::necessary(&self.of, &mut needed);
        needed.retain(|own| !mentions(&own.left, &self.index) && !mentions(&own.right, &self.index));
        known.extend(needed);
        let (of_value, amount, region) = self.amount(proposals, may_be_infinite)?;
        lemmas.extend(of_value);
        for lemma in &mut lemmas {
            assume(&mut lemma.statements, &known);
        }
        Ok(Value {
            amount,
            lemmas,
            region,
            known,
        })
    }

    /// The value by a proposal, or bounds by a test of convergence, with what must hold for it to be that.
    fn amount(&self, proposals: &dyn Proposals, may_be_infinite: bool) -> Result<(Vec<Goal>, Amount, Region), String> {
        let proposal = proposals.summation(&self.of, &self.index, &self.symbols);
        let by_value = || {
            let proposal = proposal
                .as_ref()
                .ok_or("no closed form of a sum to infinity is found")?;
            let mut lemmas = Vec::new();
            self.at_each_index(defined::conditions(&self.of, &self.symbols)?, &mut lemmas)?;
            let (value, region) = self.by(proposal, &mut lemmas)?;
            Ok((lemmas, Amount::Is(Box::new(value)), region))
        };
        let by_test = || {
            let mut lemmas = Vec::new();
            let amount = match tested(self, proposals, &mut lemmas)? {
                Tested::Between(bounds) => Amount::Between(bounds),
                Tested::Infinite(is_above) => Amount::Is(Box::new(infinite(is_above))),
            };
            for lemma in &mut lemmas {
                lemma.statements.rules.insert(Rule::SeriesTest);
            }
            Ok((lemmas, amount, Region::default()))
        };
        match may_be_infinite && proposal.as_ref().is_some_and(diverges) {
            true => by_test().or_else(|_: String| by_value()),
            false => by_value().or_else(|reason: String| by_test().map_err(|why: String| format!("{reason}; {why}"))),
        }
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
                self.finite_limit(&proposal.telescoping, lemmas)?;
            }
            return Ok((without_value(), Region::default()));
        }
        if !is_zero(&proposal.telescoping) {
            value.push(self.finite_limit(&proposal.telescoping, lemmas)?);
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

    fn finite_limit(&self, of: &Tree, lemmas: &mut Vec<Goal>) -> Result<Tree, String> {
        match self.limit(of, lemmas)? {
            Some(End::Finite(value)) => Ok(*value),
            _ => Err("a sum to infinity that diverges, as far as it is followed".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::build::{plain, real_power};
    use super::*;
    use texmath::{Meaning, Series};

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
