//! Claims about a sequence that a recurrence gives, by induction over its index: the first members, the step, and that
//! the claim and the recurrence have values throughout. And at numbers: the recurrence unrolled from the members that
//! are given.
//!
//! What is trusted: a recurrence a_{n+d} = r(n, a_n, ..., a_{n+d-1}) of the premises holds for every integer n, or from
//! the least on that its `assume` allows, wherever r has a value. So it may be used at an index once r is shown to have
//! a value there. Members at a window of consecutive indices that satisfy it go on upwards, since r gives the next one
//! or says nothing of it; and downwards, where r is linear in its earliest member with a factor that is not 0 and does not
//! run, or where the window begins with the recurrence. Only such windows count as points of the premises.

use super::super::premise::{Premise, Statements};
use super::build::{integer, negative, product, quotient, sum, symbol};
use super::derivative::mentions;
use super::evaluate::{at_index, only_factorials};
use super::induction::{self, Moving};
use super::instances::{self, relation_holds};
use super::sequences::{Setting, runs_by_member};
use super::series::is_zero;
use super::{Goal, Reduced, Rule, defined, rewritten, trees};
use std::collections::BTreeSet;
use texmath::{
    Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, holds, index_of, mapped, number_of, rewrite,
    subscript_of,
};

/// The most members that are written out, and the most indices at which a claim is tried.
const MOST_MEMBERS: i64 = 40;
const MOST_TRIED: i64 = 5;
/// The highest order of a recurrence.
const HIGHEST_ORDER: i64 = 4;

/// What a claim about a sequence comes to.
///
/// # Errors
/// Why the premises give no sequence that is followed here.
pub(super) fn reduced(statements: &Statements, setting: &Setting) -> Result<Reduced, String> {
    let sequence = Sequence::of(statements, setting)?;
    let (sufficient, reason) = match sequence.induction() {
        Ok(goals) => (goals, String::new()),
        Err(why) => (Vec::new(), why),
    };
    let by = |rule: Rule, goals: Vec<Goal>| -> Vec<Goal> {
        let goals = goals.into_iter();
        let goals = goals.map(|goal| Goal {
            statements: goal.statements.by(rule),
            ..goal
        });
        goals.collect()
    };
    Ok(Reduced {
        necessary: by(Rule::SequenceUnrolled, sequence.tried()),
        sufficient: by(Rule::SequenceInduction, sufficient),
        reason,
        ..Reduced::default()
    })
}

/// A claim about one sequence, and the recurrence that gives it.
struct Sequence<'a> {
    setting: &'a Setting,
    plain: &'a Symbols,
    letter: &'a Name,
    state: &'a Name,
    /// All that is said but the recurrence.
    rest: Statements,
    law: Premise,
    /// The offsets of the earliest member and of the one that the recurrence gives; the least index at which it holds.
    lowest: i64,
    highest: i64,
    least: Option<i64>,
    /// The least index that the claim is made for; none where it is made for all.
    first: Option<i64>,
    /// What must hold for each window of members to go on downwards.
    backwards: Result<Option<Equation>, String>,
}

/// The offsets of members that run, and the indices of those that do not.
#[derive(Default)]
struct Members {
    running: BTreeSet<i64>,
    numbered: BTreeSet<i64>,
}

impl<'a> Sequence<'a> {
    fn of(statements: &Statements, setting: &'a Setting) -> Result<Self, String> {
        let Setting { plain, letter, states } = setting;
        let mut states = states.iter();
        let (Some(state), None) = (states.next(), states.next()) else {
            return Err("more than one sequence is spoken of".to_owned());
        };
        if setting.has_multiples(statements) {
            return Err("members at multiples of the index have no induction here".to_owned());
        }

        let mut rest = statements.clone();
        let runs = |tree: &Tree| setting.runs(tree);
        let is_law = |premise: &Premise| runs(&premise.equation.left) || runs(&premise.equation.right);
        let (mut laws, mut constant): (Vec<Premise>, Vec<Premise>) = rest.premises.drain(..).partition(is_law);
        let (Some(mut law), true) = (laws.pop(), laws.is_empty()) else {
            return Err(format!("the premises do not give {state} by one recurrence"));
        };
        // what does not run is said once, whatever the index: a condition on the index alone is one of the recurrence
        for premise in &mut constant {
            premise
                .assume
                .retain(|condition| !condition.sides().iter().any(|side| mentions(side, letter)));
        }
        let says_of_members = |condition: &Condition| {
            condition
                .sides()
                .into_iter()
                .any(|side| runs_by_member(side, state, letter))
        };
        let conditions = statements
            .assume
            .iter()
            .chain(&law.assume)
            .chain(constant.iter().flat_map(|premise| &premise.assume));
        if conditions.into_iter().any(says_of_members) {
            return Err(format!("a condition speaks of members of {state}"));
        }
        // conditions of the recurrence that do not run are premises of their own
        let (own, _): (Vec<Condition>, Vec<Condition>) = law
            .assume
            .drain(..)
            .partition(|condition| condition.sides().into_iter().any(runs));
        let least = induction::first_value(&own, plain, letter)?;
        rest.premises = constant;
        let first = induction::first_value(&statements.assume, plain, letter)?;

        let (lowest, highest, given) = solved(&law.equation, state, letter)?;
        law.equation = given;
        let mut sequence = Self {
            setting,
            plain,
            letter,
            state,
            rest,
            law,
            lowest,
            highest,
            least,
            first,
            backwards: Ok(None),
        };
        sequence.backwards = sequence.goes_back();
        Ok(sequence)
    }

    /// What must hold for the recurrence to give earlier members from later ones, over all integers.
    fn goes_back(&self) -> Result<Option<Equation>, String> {
        if self.least.is_some() {
            return Ok(None);
        }
        let refused = || {
            format!(
                "that the recurrence holds for every integer may contradict what else is given: say from where on it holds, as in assume {} \\ge 0",
                self.letter
            )
        };
        let earliest = self.member(self.lowest);
        let factor = coefficient(&self.law.equation.right, &earliest).ok_or_else(refused)?;
        let conditions = defined::conditions(&self.law.equation.right, self.plain)?;
        let mut of_conditions = conditions
            .iter()
            .flat_map(|condition| [&condition.left, &condition.right]);
        if self.runs(&factor) || of_conditions.any(|side| self.runs(side)) {
            return Err(refused());
        }
        match number_of(&factor) {
            Some(_) if is_zero(&factor) => Err(refused()),
            Some(_) => Ok(None),
            None => Ok(Some(Equation {
                relation: Relation::NotEqual,
                ..Equation::between(factor, integer(0))
            })),
        }
    }

    fn runs(&self, tree: &Tree) -> bool {
        self.setting.runs(tree)
    }

    fn member(&self, offset: i64) -> Name {
        Name {
            subscript: subscript_of(i32::try_from(offset).unwrap_or(i32::MAX), &self.letter.base),
            ..self.state.clone()
        }
    }

    fn order(&self) -> i64 {
        self.highest - self.lowest
    }

    fn collect(&self, tree: &Tree, members: &mut Members) {
        any(tree, &mut |node| {
            if let Tree::Symbol(name, _) = node
                && name.bare() == *self.state
            {
                match index_of(&name.subscript, &self.letter.base) {
                    Some(offset) => members.running.insert(i64::from(offset)),
                    None => name.subscript.parse().is_ok_and(|index| members.numbered.insert(index)),
                };
            }
            false
        });
    }

    fn members(&self, statements: &Statements) -> Members {
        let mut members = Members::default();
        for tree in trees(statements) {
            self.collect(tree, &mut members);
        }
        members
    }

    /// A formula with the index moved on.
    fn shifted(&self, tree: &Tree, by: i64) -> Tree {
        rewrite(tree, &|name| {
            if name == self.letter {
                return Some(sum(vec![symbol(name), integer(by)]));
            }
            let offset = index_of(&name.subscript, &self.letter.base).filter(|_| name.bare() == *self.state)?;
            Some(symbol(&self.member(i64::from(offset) + by)))
        })
    }

    fn each(&self, equation: &Equation, new: &dyn Fn(&Tree) -> Tree) -> Equation {
        Equation {
            left: new(&equation.left),
            right: new(&equation.right),
            ..equation.clone()
        }
    }

    /// All that is said but the recurrence, with the claim at an index; `None` where the claim is not made there.
    fn at(&self, index: i64) -> Result<Option<Statements>, String> {
        let numbered = rewritten(&self.rest, Rule::SequenceUnrolled, &|tree| {
            at_index(tree, self.letter, index)
        });
        let admissible = self.first.is_none_or(|first| index >= first);
        let Some(there) = instances::at(&numbered, self.plain, &[]).filter(|_| admissible) else {
            return Ok(None);
        };
        only_factorials(&there, self.plain).map(Some)
    }

    /// What must hold at numbers for the recurrence to have a value behind the last member that is met: where it has none
    /// there, the premises hold no longer.
    fn next(&self, statements: &Statements) -> Result<Vec<Equation>, String> {
        let members = self.members(statements).numbered;
        let Some(index) = members.last().map(|end| end + 1 - self.highest) else {
            return Ok(Vec::new());
        };
        if self.least.is_some_and(|least| index < least) {
            return Ok(Vec::new());
        }
        let mut conditions = defined::conditions(&self.law_at(index)?.right, self.plain)?;
        conditions.retain(|condition| relation_holds(condition).is_none());
        Ok(conditions)
    }

    /// What the recurrence says at a number.
    fn law_at(&self, index: i64) -> Result<Equation, String> {
        let mut alone = self.rest.clone();
        alone.premises.clear();
        alone.assume.clear();
        alone.claims = vec![self.each(&self.law.equation, &|tree| at_index(tree, self.letter, index))];
        let there = instances::at(&alone, self.plain, &[]);
        let equation = there.and_then(|there| there.claims.into_iter().next());
        equation.ok_or_else(|| "the recurrence cannot be read at a number".to_owned())
    }

    /// What the recurrence says at numbers, for all members from the first to the last that are met.
    fn unrolled(&self, statements: &Statements) -> Result<Vec<Equation>, String> {
        let mut members = self.members(statements).numbered;
        for side in [&self.law.equation.left, &self.law.equation.right] {
            let mut own = Members::default();
            self.collect(side, &mut own);
            members.extend(own.numbered);
        }
        let (Some(start), Some(&end)) = (members.first(), members.last()) else {
            return Ok(Vec::new());
        };
        // a recurrence that begins above the window determines nothing in it
        let start = self.least.map_or(*start, |least| (least + self.lowest).min(*start));
        if end - start > MOST_MEMBERS {
            return Err("the members that are spoken of lie too far apart".to_owned());
        }
        let mut said = Vec::new();
        for index in (start - self.lowest)..=(end - self.highest) {
            if self.least.is_some_and(|least| index < least) {
                continue;
            }
            said.push(self.law_at(index)?);
        }
        Ok(said)
    }

    /// Takes what the recurrence says as given, each once it is shown to have a value.
    fn given(
        &self,
        mut context: Statements,
        said: Vec<Equation>,
        symbols: &Symbols,
        goals: &mut Vec<Goal>,
    ) -> Result<Statements, String> {
        for equation in said {
            let mut conditions = defined::conditions(&equation.left, symbols)?;
            conditions.extend(defined::conditions(&equation.right, symbols)?);
            if conditions
                .iter()
                .any(|condition| relation_holds(condition) == Some(false))
            {
                continue;
            }
            conditions.retain(|condition| relation_holds(condition).is_none());
            for condition in conditions {
                let mut alone = context.clone();
                let part = format!("{condition} in the recurrence");
                alone.claims = vec![condition];
                goals.push(self.setting.goal_in(&alone, symbols, part)?);
            }
            context.premises.push(Premise::known(&self.law.label, equation));
        }
        Ok(context)
    }

    /// The index at which an induction over all integers begins, or the trials of a claim.
    fn start(&self) -> i64 {
        let known = self.members(&self.rest).numbered.first().copied();
        self.first.or(known).unwrap_or(0)
    }

    /// The claim at small indices, with the recurrence unrolled.
    fn tried(&self) -> Vec<Goal> {
        let Ok(condition) = &self.backwards else {
            return Vec::new();
        };
        let tried = (self.start()..self.start() + MOST_TRIED).filter_map(|index| {
            let mut there = self.at(index).ok()??;
            there.assume.extend(condition.clone().map(Condition::Relation));
            let next = self.next(&there).ok()?.into_iter();
            there.assume.extend(next.map(Condition::Relation));
            for equation in self.unrolled(&there).ok()? {
                let mut conditions = defined::conditions(&equation.right, self.plain).ok()?.into_iter();
                // where it has no value, the recurrence says nothing
                if !conditions.any(|condition| relation_holds(&condition) == Some(false)) {
                    there.premises.push(Premise::known(&self.law.label, equation));
                }
            }
            self.setting.goal(&there, format!("{} = {index}", self.letter)).ok()
        });
        tried.collect()
    }

    fn induction(&self) -> Result<Vec<Goal>, String> {
        let condition = self.backwards.clone()?;
        let letter = self.letter;
        let is_series = |operation: &Operation| matches!(operation, Operation::Series { .. });
        let has_series = self.rest.claims.iter().any(|claim| holds(claim, &is_series));
        let (order, start) = match has_series {
            true => (1, self.first.ok_or_else(|| format!("{letter} has no lower bound"))?),
            false => (self.order(), self.start()),
        };
        let mut goals = Vec::new();
        for index in start..start + order {
            let there = self.at(index)?.ok_or("the first value is not admissible")?;
            let part = format!("{letter} = {index}");
            let said = self.unrolled(&there)?;
            let known = self.given(there.clone(), said, self.plain, &mut goals)?;
            goals.push(self.setting.goal(&known, part.clone())?);
            if let Some(condition) = &condition {
                let mut known = known;
                known.assume.push(Condition::Relation(condition.clone()));
                goals.push(self.setting.goal(&known, part)?);
            }
        }
        let mut plain = self.plain.clone();
        let mut found: Vec<Operation> = Vec::new();
        for claim in &self.rest.claims {
            for side in [&claim.left, &claim.right] {
                induction::series_in(side, &mut found);
            }
        }
        let mut moving: Vec<Moving> = Vec::new();
        for operation in found {
            let name = super::fresh(&self.rest, &plain, "S");
            plain.let_be_parameter(&name, false);
            moving.push(induction::moved(&operation, letter, start, name, Some(self.state))?);
        }
        let named = |tree: &Tree| mapped(tree, &|node| induction::name_of(node, &moving));
        let now = rewritten(&self.rest, Rule::SeriesInduction, &named);
        // where the claim has no value at one index, no step leads over it
        let mut needed: Vec<Equation> = Vec::new();
        let of_claims = now.claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
        for side in of_claims.chain(moving.iter().flat_map(|moving| &moving.removed)) {
            needed.extend(defined::conditions(side, &plain)?);
        }
        needed.retain(|condition| self.runs(&condition.left) || self.runs(&condition.right));
        needed.dedup();
        for condition in needed {
            let mut alone = now.clone();
            let part = format!("{condition} at each {letter}");
            alone.claims = vec![condition];
            goals.push(self.setting.goal_in(&alone, &plain, part)?);
        }
        let up: Vec<i64> = (0..order).collect();
        self.step(&now, &moving, &up, order, &plain, &mut goals)?;
        if self.first.is_none() {
            let down: Vec<i64> = (1..=order).collect();
            self.step(&now, &moving, &down, 0, &plain, &mut goals)?;
        }
        Ok(goals)
    }

    /// The step from the claim at some offsets to the claim at another one.
    fn step(
        &self,
        now: &Statements,
        moving: &[Moving],
        from: &[i64],
        to: i64,
        plain: &Symbols,
        goals: &mut Vec<Goal>,
    ) -> Result<(), String> {
        let claims_at = |offset: i64| -> Vec<Equation> {
            let moved_on = |tree: &Tree| {
                let shifted = self.shifted(tree, offset);
                match offset == 0 {
                    true => shifted,
                    false => rewrite(&shifted, &|name| {
                        let moving = moving.iter().find(|moving| moving.name == *name)?;
                        Some(induction::next_value(moving))
                    }),
                }
            };
            let claims = now.claims.iter();
            claims.map(|claim| self.each(claim, &moved_on)).collect()
        };
        let mut context = now.clone();
        context.claims = claims_at(to);
        for &offset in from {
            let label = format!("the claim at {}", self.shifted(&symbol(self.letter), offset));
            let claims = claims_at(offset).into_iter();
            context
                .premises
                .extend(claims.map(|claim| Premise::known(&label, claim)));
        }
        let members = self.members(&context).running;
        let (Some(start), Some(end)) = (members.first(), members.last()) else {
            return Err(format!("the claim speaks of no member {}", self.member(0)));
        };
        let holds_at = |offset: &i64| match (self.least, self.first) {
            (None, _) => true,
            (Some(least), Some(first)) => first + offset >= least,
            (Some(_), None) => false,
        };
        let offsets = (start - self.lowest)..=(end - self.highest);
        let said = offsets.filter(holds_at);
        let said = said.map(|by| self.each(&self.law.equation, &|tree| self.shifted(tree, by)));
        let said: Vec<Equation> = said.collect();
        let context = self.given(context, said, plain, goals)?;
        let part = match to {
            0 => format!("the step back to {}", self.letter),
            to => format!("the step to {} + {to}", self.letter),
        };
        goals.push(self.setting.goal_in(&context, plain, part)?);
        Ok(())
    }
}

/// The recurrence solved for its last member, with the offsets of its earliest member and of the last.
fn solved(law: &Equation, state: &Name, letter: &Name) -> Result<(i64, i64, Equation), String> {
    let refused = || format!("the recurrence {law} does not give a member by those before it");
    let offset = |node: &Tree| match node {
        Tree::Symbol(name, _) if name.bare() == *state => index_of(&name.subscript, &letter.base).map(i64::from),
        _ => None,
    };
    let offsets = |tree: &Tree| {
        let mut met = BTreeSet::new();
        any(tree, &mut |node| {
            met.extend(offset(node));
            false
        });
        met
    };
    if law.relation != Relation::Equal {
        return Err(refused());
    }
    for (left, right) in [(&law.left, &law.right), (&law.right, &law.left)] {
        let before = offsets(right);
        if let (Some(highest), Some(&lowest), Some(&last)) = (offset(left), before.first(), before.last())
            && last < highest
            && highest - lowest <= HIGHEST_ORDER
        {
            let given = Equation {
                left: left.clone(),
                right: right.clone(),
                ..law.clone()
            };
            return Ok((lowest, highest, given));
        }
    }
    Err(refused())
}

/// The factor of a symbol in a formula that is linear in it.
fn coefficient(tree: &Tree, name: &Name) -> Option<Tree> {
    if !mentions(tree, name) {
        return Some(integer(0));
    }
    Some(match tree {
        Tree::Symbol(..) => integer(1),
        Tree::Negate(inner) => negative(coefficient(inner, name)?),
        Tree::Sum(terms) => {
            let terms = terms.iter().map(|term| coefficient(term, name));
            sum(terms.collect::<Option<_>>()?)
        }
        Tree::Product(factors) => {
            let mut with = factors.iter().filter(|factor| mentions(factor, name));
            let (Some(_), None) = (with.next(), with.next()) else {
                return None;
            };
            let factors = factors.iter().map(|factor| match mentions(factor, name) {
                true => coefficient(factor, name),
                false => Some(factor.clone()),
            });
            product(factors.collect::<Option<_>>()?)
        }
        Tree::Quotient(above, below, _) if !mentions(below, name) => {
            quotient(coefficient(above, name)?, (**below).clone())
        }
        _ => return None,
    })
}
