//! Sums and products of symbolic length, and integrals that depend on an integer, by induction over it: the first value, the step, and
//! that everything has a value at each.

use super::super::premise::{Premise, Statements};
use super::build::{difference, integer, power, product, sum, symbol};
use super::derivative::mentions;
use super::evaluate::{WithFactorials, but_factorials};
use super::integers::{free_integers, whole};
use super::integral::{outermost, tied};
use super::{Goal, NoProposals, Proposals, Rule, defined, factorial, fresh, instances, rewritten, telescope};
use numbers::{Field, Rational};
use texmath::{
    Condition, Equation, Meaning, Name, Operation, Relation, Series, Symbols, Tree, any, any_side, holds, index_of,
    mapped, rewrite, subscript_of,
};

/// The statements with least values of integers of which nothing is said: those from which the sums and products of claims
/// have a value.
pub(super) fn with_lengths(statements: &Statements, symbols: &Symbols) -> Statements {
    let mut out = statements.clone();
    if statements.is_way {
        return out;
    }
    let mut found = Vec::new();
    for claim in &statements.claims {
        for side in [&claim.left, &claim.right] {
            series_in(side, &mut found);
        }
    }
    let integers = free_integers(statements, symbols);
    for operation in found {
        let Operation::Series { from, to, .. } = &operation else {
            continue;
        };
        let length = factorial::linear(&difference(to.clone(), from.clone()));
        let Some((letters, constant)) = length else {
            continue;
        };
        let mut letters = letters.into_iter();
        let (Some((letter, 1)), None) = (letters.next(), letters.next()) else {
            continue;
        };
        let is_open = matches!(first_value(&statements.assume, symbols, &letter), Ok(None));
        if is_open && integers.contains(&letter) {
            out.assume.push(Condition::Relation(Equation {
                relation: Relation::GreaterOrEqual,
                ..Equation::between(symbol(&letter), integer(-1 - constant))
            }));
        }
    }
    out
}

/// The tree with powers whose exponent is a positive letter and a number as powers with this exponent, and with the letter.
fn with_last_powers(tree: &Tree, letter: &Name) -> Tree {
    mapped(tree, &|node| {
        let Tree::RealPower(base, exponent, at) = node else {
            return None;
        };
        let (1, more @ 1..=HIGHEST_MORE) = factorial::multiple_of(exponent, letter)? else {
            return None;
        };
        let more = i32::try_from(more).ok()?;
        let last = Tree::RealPower(base.clone(), Box::new(symbol(letter)), *at);
        Some(product(vec![power((**base).clone(), more), last]))
    })
}

/// The largest number that is added to a letter in an exponent and is taken out of it.
const HIGHEST_MORE: i64 = 8;

/// The most terms that a sum has more at the next integer, where its terms depend on that.
const MOST_STEPS: i64 = 3;

/// The first values of an integer that are looked at by themselves before a step by an equation that ties an integral to its next
/// value: small numbers refute, too.
const TIED_FROM: i64 = 3;

/// The first values of an integer that are looked at by themselves before a step of an inequality without sums.
const LATER: i64 = 2;

/// A sum or product whose limits move with the integer.
pub(super) struct Moving {
    operation: Operation,
    /// What stands for it.
    pub name: Name,
    /// The terms that the next value has more, and those that it has no longer.
    added: Vec<Tree>,
    pub removed: Vec<Tree>,
    /// What stands for its next value, where that is known by an equation.
    next: Option<Name>,
}

/// The goals of an induction.
#[derive(Default)]
pub(super) struct Induction {
    /// The claims that must hold for the values of integrals at the first numbers.
    pub lemmas: Vec<Goal>,
    /// The claim with integrals at the first numbers, where it is its values alone.
    pub necessary: Vec<Goal>,
    /// The claim holds where all of these and the lemmas do.
    pub sufficient: Vec<Goal>,
}

impl Induction {
    fn of(sufficient: Vec<Goal>) -> Self {
        Self {
            sufficient,
            ..Self::default()
        }
    }

    /// Adds the goals of the claim at a number for one of its integers.
    ///
    /// # Errors
    /// Why its integrals have no value that is known.
    fn add_number(
        &mut self,
        statements: &Statements,
        symbols: &Symbols,
        proposals: &dyn Proposals,
        part: String,
    ) -> Result<(), String> {
        if super::trees(statements)
            .into_iter()
            .all(|tree| outermost(tree).is_empty())
        {
            self.sufficient.extend(with_factorials(statements, symbols, part)?);
            return Ok(());
        }
        let mut reduced = super::over_an_index(statements, symbols, proposals, "an integral".to_owned())?;
        if reduced.sufficient.is_empty() || !reduced.converging.is_empty() {
            return Err(format!("the integral where {part} has no value that is known"));
        }
        reduced.lemmas.iter_mut().for_each(Goal::rest_on_numbers);
        let named = reduced.lemmas.iter_mut().chain(&mut reduced.sufficient);
        for goal in named.chain(&mut reduced.necessary) {
            let own = std::mem::take(&mut goal.part);
            goal.part = if own.is_empty() {
                part.clone()
            } else {
                format!("{part}: {own}")
            };
        }
        if reduced.is_equivalent {
            self.necessary.extend(reduced.sufficient.iter().cloned());
        }
        self.necessary.extend(reduced.necessary);
        self.lemmas.extend(reduced.lemmas);
        self.sufficient.extend(reduced.sufficient);
        Ok(())
    }
}

/// The goals that prove the claim.
///
/// # Errors
/// Why there is no induction.
pub(super) fn goals(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Induction, String> {
    let moves = |operation: &Operation| matches!(operation, Operation::Series { .. } | Operation::Integral { .. });
    if !statements.claims.iter().any(|claim| holds(claim, &moves)) {
        return with_factorials(statements, symbols, String::new()).map(Induction::of);
    }
    if statements
        .premises
        .iter()
        .any(|premise| holds(&premise.equation, &|_| true))
    {
        return Err("a premise holds a sum of symbolic length".to_owned());
    }
    if super::trees(statements)
        .into_iter()
        .any(|tree| symbols.may_be_complex(tree))
    {
        return Err("sums of complex numbers have no induction here".to_owned());
    }
    let letters = free_integers(statements, symbols);
    let mut reason = "the length of a sum is no integer".to_owned();
    for letter in &letters {
        match over(statements, symbols, letter, proposals) {
            Ok(goals) => return Ok(goals),
            Err(why) => reason = why,
        }
    }
    Err(reason)
}

/// The goal with factorials as quantities, and one for each condition of a binomial coefficient: that is decided without what
/// factorials say of their arguments.
pub(super) fn with_factorials(statements: &Statements, symbols: &Symbols, part: String) -> Result<Vec<Goal>, String> {
    let WithFactorials {
        statements: written,
        needed,
    } = but_factorials(statements, symbols)?;
    let mut goals = Vec::new();
    for condition in needed {
        let mut alone = written.clone();
        alone
            .premises
            .retain(|premise| !any_side(&premise.equation, &mut factorial::is_one));
        alone.claims = vec![condition.clone()];
        if super::trees(&alone).into_iter().any(factorial::stands_in) {
            return Err(format!("{condition} is not decided"));
        }
        let part = match part.as_str() {
            "" => condition.to_string(),
            part => format!("{part}: {condition}"),
        };
        goals.push(Goal::of(&alone, symbols, part));
    }
    let (quantities, symbols) = factorial::as_quantities(&written, symbols)?;
    goals.push(Goal::of(&quantities, &symbols, part));
    Ok(goals)
}

/// The goals that prove inequalities without sums by induction over one of their integers.
pub(super) fn of_inequalities(statements: &Statements, symbols: &Symbols) -> Option<Vec<Goal>> {
    let is_inequality = |claim: &Equation| !matches!(claim.relation, Relation::Equal | Relation::NotEqual);
    let is_other = |operation: &Operation| !matches!(operation, Operation::Binomial(..));
    let is_plain = |claim: &Equation| is_inequality(claim) && !holds(claim, &is_other);
    let is_real = !super::trees(statements)
        .into_iter()
        .any(|tree| symbols.may_be_complex(tree));
    if !is_real || !statements.premises.is_empty() || !statements.claims.iter().all(is_plain) {
        return None;
    }
    let letters = free_integers(statements, symbols);
    letters
        .iter()
        .find_map(|letter| over(statements, symbols, letter, &NoProposals).ok())
        .map(|found| found.sufficient)
}

fn over(
    statements: &Statements,
    symbols: &Symbols,
    letter: &Name,
    proposals: &dyn Proposals,
) -> Result<Induction, String> {
    let statements = &statements.clone().by(Rule::SeriesInduction);
    let first = first_value(&statements.assume, symbols, letter)?;
    let first = first.ok_or_else(|| format!("{letter} has no lower bound"))?;
    if super::is_spoken_of(statements, symbols, letter) {
        return Err(format!("premises speak of {letter}"));
    }
    let mut symbols = symbols.clone();
    let mut moving: Vec<Moving> = Vec::new();
    let mut found: Vec<Operation> = Vec::new();
    for claim in &statements.claims {
        for side in [&claim.left, &claim.right] {
            series_in(side, &mut found);
        }
    }
    // what is known of sums whose terms depend on the letter, and over which numbers the terms are
    let (mut telescoped, mut over_terms) = (Vec::new(), Vec::new());
    for operation in found {
        let name = fresh(statements, &symbols, "S");
        symbols.let_be_parameter(&name, false);
        let Some(sum) = telescope::Sum::read(&operation, letter) else {
            moving.push(moved(&operation, letter, first, name, None)?);
            continue;
        };
        let next = fresh(statements, &symbols, "S");
        symbols.let_be_parameter(&next, false);
        let index = fresh(statements, &symbols, "k");
        symbols.let_be_parameter(&index, false);
        symbols.declare(index.clone(), Meaning::Integer);
        let of = rewrite(sum.of, &|name| (name == sum.index).then(|| symbol(&index)));
        let sum = telescope::Sum {
            of: &of,
            index: &index,
            ..sum
        };
        let length = motion(sum.to, letter, first).filter(|_| factorial::is_linear(sum.to));
        let length = length.filter(|(last, step)| (1..=MOST_STEPS).contains(step) && last - sum.from >= -1);
        let known = length.and_then(|(_, step)| sum.telescoped(&name, &next, step));
        let known = known.ok_or_else(|| format!("the terms of a sum depend on {letter}"))?;
        over_terms.push((index.clone(), sum.from, sum.to.clone(), of.clone(), known.of_terms));
        telescoped.push(known.of_sums);
        moving.push(Moving {
            next: Some(next),
            added: Vec::new(),
            removed: Vec::new(),
            operation,
            name,
        });
    }
    let (integrals, mut goals) = tied_integrals(statements, &mut symbols, letter, first, proposals)?;
    let (is_telescoped, is_tied) = (!telescoped.is_empty(), !integrals.is_empty());
    for (own, equation) in integrals {
        moving.push(own);
        telescoped.push(equation);
    }
    let named = |tree: &Tree| mapped(tree, &|node| name_of(node, &moving));
    let now = rewritten(statements, Rule::SeriesInduction, &named);
    // the claim at the next value, by what stands for its sums now
    let step = |tree: &Tree| {
        let next = rewrite(tree, &|name| {
            (name == letter).then(|| sum(vec![symbol(letter), integer(1)]))
        });
        rewrite(&next, &|name| {
            let moving = moving.iter().find(|moving| moving.name == *name)?;
            Some(next_value(moving))
        })
    };
    let mut next = now.clone();
    let equation = |claim: &Equation| Equation {
        left: step(&claim.left),
        right: step(&claim.right),
        ..claim.clone()
    };
    next.claims = now.claims.iter().map(equation).collect();
    let known = format!("the claim at {letter}");
    for claim in &now.claims {
        match claim.relation {
            Relation::Equal => next.premises.push(Premise::known(&known, claim.clone())),
            _ => next.assume.push(Condition::Relation(claim.clone())),
        }
    }
    if is_telescoped {
        next = next.by(Rule::SeriesTelescoping);
    }
    if is_tied {
        next = next.by(Rule::IntegralReductionFormula);
    }
    let of_sums = telescoped
        .into_iter()
        .map(|equation| Premise::known("what ties it to the next", equation));
    // what an equation gives of the next sum may be nothing at the first value, and powers outgrow others a little later
    let later = match (is_tied, is_telescoped, moving.is_empty()) {
        (true, ..) => TIED_FROM,
        (_, true, _) => 1,
        (.., true) => LATER,
        (.., false) => 0,
    };
    if later > 0 {
        next.assume.push(Condition::Relation(Equation {
            relation: Relation::GreaterOrEqual,
            ..Equation::between(symbol(letter), integer(first + later))
        }));
    }
    next.premises.extend(of_sums);
    if moving.is_empty() && first + later >= 1 {
        next = rewritten(&next, Rule::InequalityInduction, &|tree| with_last_powers(tree, letter));
    }
    let mut induction = Induction::default();
    for base in first..=first + later {
        let at_base = instances::at(statements, &symbols, &[(letter, Rational::from_integer(base))]);
        let at_base = at_base.ok_or("the first value is not admissible")?;
        induction.add_number(&at_base, &symbols, proposals, format!("{letter} = {base}"))?;
    }
    goals.extend(with_factorials(
        &next,
        &symbols,
        format!("the step from {letter} to {letter} + 1"),
    )?);
    for (index, from, to, of, equation) in over_terms {
        let mut terms = statements.clone();
        let bound = |relation: Relation, bound: Tree| {
            Condition::Relation(Equation {
                relation,
                ..Equation::between(symbol(&index), bound)
            })
        };
        terms.assume.push(bound(Relation::GreaterOrEqual, integer(from)));
        terms.assume.push(bound(Relation::LessOrEqual, to));
        let conditions = defined::conditions(&of, &symbols)?;
        let conditions = conditions.into_iter().filter(|condition| {
            let sides = [&condition.left, &condition.right];
            sides
                .into_iter()
                .any(|side| mentions(side, letter) || mentions(side, &index))
        });
        for claim in conditions.chain([equation]) {
            terms.claims = vec![claim.clone()];
            goals.extend(with_factorials(&terms, &symbols, format!("{claim} at each {index}"))?);
        }
    }
    // where the claim has no value at one integer, no step leads over it
    let mut needed: Vec<Equation> = Vec::new();
    for claim in &now.claims {
        for side in [&claim.left, &claim.right] {
            needed.extend(defined::conditions(side, &symbols)?);
        }
    }
    for removed in moving.iter().flat_map(|moving| &moving.removed) {
        needed.extend(defined::conditions(removed, &symbols)?);
    }
    needed.retain(|condition| mentions(&condition.left, letter));
    needed.dedup();
    for condition in needed {
        let mut alone = now.clone();
        alone.claims = vec![condition.clone()];
        goals.extend(with_factorials(
            &alone,
            &symbols,
            format!("{condition} at each {letter}"),
        )?);
    }
    induction.sufficient.extend(goals);
    Ok(induction)
}

/// An integral whose integrand depends on the letter, and what ties it to the next one.
type MovingIntegral = (Moving, Equation);

/// The integrals of the claims that depend on the integer, each with an equation that ties it to its next value, and the goals
/// that show it from one later than the first value on.
fn tied_integrals(
    statements: &Statements,
    symbols: &mut Symbols,
    letter: &Name,
    first: i64,
    proposals: &dyn Proposals,
) -> Result<(Vec<MovingIntegral>, Vec<Goal>), String> {
    let mut later = statements.clone();
    later.assume.push(Condition::Relation(Equation {
        relation: Relation::GreaterOrEqual,
        ..Equation::between(symbol(letter), integer(first + TIED_FROM))
    }));
    let mut operations: Vec<Operation> = Vec::new();
    for claim in &statements.claims {
        let own = [&claim.left, &claim.right].into_iter().flat_map(outermost);
        operations.extend(own);
    }
    let (mut found, mut goals): (Vec<MovingIntegral>, Vec<Goal>) = (Vec::new(), Vec::new());
    for operation in operations {
        if found.iter().any(|(known, _)| known.operation == operation) {
            continue;
        }
        let [name, next] = ["I", "I"].map(|like| {
            let name = fresh(statements, symbols, like);
            symbols.let_be_parameter(&name, false);
            name
        });
        let mut tied = tied(&operation, letter, [&name, &next], &later, symbols, proposals)?;
        tied.lemmas.iter_mut().for_each(Goal::rest_on_numbers);
        goals.extend(tied.lemmas);
        let moving = Moving {
            operation,
            name,
            added: Vec::new(),
            removed: Vec::new(),
            next: Some(next),
        };
        found.push((moving, tied.equation));
    }
    Ok((found, goals))
}

/// The first value of the integer, by its conditions; `None` where it has no lower bound.
///
/// # Errors
/// The condition that is none.
pub(super) fn first_value(assume: &[Condition], symbols: &Symbols, letter: &Name) -> Result<Option<i64>, String> {
    let is_letter = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name == letter);
    let listed = [(symbols.is_positive(letter), 1), (symbols.is_nonnegative(letter), 0)];
    let bounds = listed
        .into_iter()
        .filter(|(is_listed, _)| *is_listed)
        .map(|(_, bound)| bound);
    let mut all: Vec<i64> = bounds.collect();
    for condition in assume {
        if !condition.sides().iter().any(|side| mentions(side, letter)) {
            continue;
        }
        let relation = match condition {
            Condition::Relation(relation) => relation,
            Condition::Integer(tree) if is_letter(tree) => continue,
            Condition::Integer(tree) => return Err(format!("steps of 1 leave what {tree} \\in \\mathbb{{Z}} allows")),
        };
        let bound = match (is_letter(&relation.left), is_letter(&relation.right), relation.relation) {
            (true, false, Relation::GreaterOrEqual) => whole(&relation.right),
            (true, false, Relation::Greater) => whole(&relation.right).map(|bound| bound + 1),
            (false, true, Relation::LessOrEqual) => whole(&relation.left),
            (false, true, Relation::Less) => whole(&relation.left).map(|bound| bound + 1),
            _ => None,
        };
        match bound {
            Some(bound) => all.push(bound),
            None => return Err(format!("the condition {relation} is no lower bound")),
        }
    }
    Ok(all.into_iter().max())
}

/// What stands for a sum.
pub(super) fn name_of(node: &Tree, moving: &[Moving]) -> Option<Tree> {
    let Tree::Operation(operation, _) = node else {
        return None;
    };
    let of = moving.iter().find(|moving| moving.operation == **operation)?;
    Some(symbol(&of.name))
}

pub(super) fn series_in(tree: &Tree, found: &mut Vec<Operation>) {
    any(tree, &mut |node| {
        if let Tree::Operation(operation, _) = node
            && matches!(**operation, Operation::Series { .. })
            && !found.contains(operation)
        {
            found.push((**operation).clone());
        }
        false
    });
}

/// How a limit moves: its value at the first integer, and by how much with each.
fn motion(limit: &Tree, letter: &Name, first: i64) -> Option<(i64, i64)> {
    let at = |value: i64| whole(&rewrite(limit, &|name| (name == letter).then(|| integer(value))));
    let (zero, one, two) = (at(first)?, at(first + 1)?, at(first + 2)?);
    (one - zero == two - one).then_some((zero, one - zero))
}

/// How a sum moves with the integer; its terms may be members of the sequence.
pub(super) fn moved(
    operation: &Operation,
    letter: &Name,
    first: i64,
    name: Name,
    sequence: Option<&Name>,
) -> Result<Moving, String> {
    let Operation::Series {
        kind,
        of,
        index,
        from,
        to,
    } = operation
    else {
        return Err("no sum".to_owned());
    };
    if mentions(of, letter) {
        return Err(format!("the terms of a sum depend on {letter}"));
    }
    let linear = |limit: &Tree| {
        let is_linear = factorial::is_linear(limit);
        motion(limit, letter, first)
            .filter(|_| is_linear)
            .ok_or_else(|| format!("the limit {limit} does not move evenly with {letter}"))
    };
    let ((low, lower), (high, higher)) = (linear(from)?, linear(to)?);
    // where terms go, the sum is not empty: what they need, it needs
    let shortest = if lower > 0 { 0 } else { -1 };
    let is_whole = high - low >= shortest && higher >= lower && (0..=8).contains(&lower) && (0..=8).contains(&higher);
    if !is_whole || (*kind == Series::Product && lower != 0) {
        return Err("the limits of a sum move in a way that has no induction".to_owned());
    }
    let numbered = |name: &Name| index_of(&name.subscript, &index.to_string());
    let is_strange = |node: &Tree| match node {
        Tree::Symbol(name, _) => numbered(name).is_some() && Some(&name.bare()) != sequence,
        _ => false,
    };
    if any(of, &mut |node| is_strange(node)) {
        return Err("the terms of a sum are numbered names".to_owned());
    }
    let term = |limit: &Tree, more: i64| -> Result<Tree, String> {
        let at = sum(vec![limit.clone(), integer(more)]);
        let subscript = |offset: i32| {
            let place = offset_of(&at, letter)?.checked_add(i64::from(offset))?;
            Some(subscript_of(i32::try_from(place).ok()?, &letter.base))
        };
        if any(
            of,
            &mut |node| matches!(node, Tree::Symbol(name, _) if numbered(name).is_some_and(|offset| subscript(offset).is_none())),
        ) {
            return Err(format!("the limit {limit} is not {letter} and a number"));
        }
        Ok(rewrite(of, &|name| {
            if name == index {
                return Some(at.clone());
            }
            let subscript = subscript(numbered(name)?)?;
            Some(symbol(&Name {
                subscript,
                ..name.clone()
            }))
        }))
    };
    Ok(Moving {
        next: None,
        operation: operation.clone(),
        name,
        added: (1..=higher).map(|more| term(to, more)).collect::<Result<_, _>>()?,
        removed: (0..lower).map(|more| term(from, more)).collect::<Result<_, _>>()?,
    })
}

/// What a limit is more than the letter.
fn offset_of(limit: &Tree, letter: &Name) -> Option<i64> {
    let (zero, step) = motion(limit, letter, 0)?;
    (step == 1).then_some(zero)
}

pub(super) fn next_value(moving: &Moving) -> Tree {
    if let Some(next) = &moving.next {
        return symbol(next);
    }
    let own = symbol(&moving.name);
    let Operation::Series { kind, .. } = &moving.operation else {
        return own;
    };
    let all = std::iter::once(own).chain(moving.added.iter().cloned()).collect();
    match kind {
        Series::Product => product(all),
        Series::Sum => difference(sum(all), sum(moving.removed.clone())),
    }
}
