//! Claims about members of sequences by their premises at each index that the claim reaches.
//!
//! Trusted is this: a premise with a running index holds wherever it has a value, from some first index on that nobody says, and
//! the claim wherever its members are there. Where each premise gives one sequence by members that come before, it gives the
//! next member or says nothing of it: members from the first one that the claim names on go on to whole sequences, and so
//! are a point of the premises. A claim is refuted behind some members that it does not name alone.

use super::super::premise::{Premise, Statements};
use super::build::{integer, product, sum, symbol};
use super::sequences::Setting;
use super::{Goal, Reduced, Rule, defined, trees};
use std::collections::{BTreeMap, BTreeSet};
use texmath::{Condition, Equation, Name, Relation, Tree, any, place_of, rewrite};

/// The most indices between the first and the last member that a claim names.
const MOST_PLACES: i64 = 12;

/// The indices before the first member that a claim names at which sequences may have begun.
const BEFORE: i64 = 3;

/// A member of a sequence: its index is a multiple of the running one, and a number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Member {
    multiple: i64,
    offset: i64,
    state: Name,
}

/// A premise that gives a sequence: one member by others, and by the index.
struct Law<'a> {
    premise: &'a Premise,
    given: Member,
    by: BTreeSet<Member>,
}

impl Member {
    fn of(name: &Name, setting: &Setting) -> Option<Self> {
        let (multiple, offset) = place_of(&name.subscript, &setting.letter.base)?;
        Some(Self {
            multiple,
            offset,
            state: setting.states.get(&name.bare()).cloned()?,
        })
    }
}

/// The members with a running index in a formula.
fn members<'t>(trees: impl IntoIterator<Item = &'t Tree>, setting: &Setting) -> BTreeSet<Member> {
    let mut met = BTreeSet::new();
    for tree in trees {
        any(tree, &mut |node| {
            if let Tree::Symbol(name, _) = node {
                met.extend(Member::of(name, setting));
            }
            false
        });
    }
    met
}

/// Reduces a claim about members of sequences to claims about parameters.
///
/// # Errors
/// Why the premises do not give the sequences one after the other.
pub(super) fn reduced(statements: &Statements, setting: &Setting) -> Result<Reduced, String> {
    let runs = |tree: &Tree| setting.runs(tree);
    let runs_in = |condition: &Condition| condition.sides().into_iter().any(runs);
    let mut rest = statements.clone();
    rest.premises.clear();
    let mut laws: BTreeMap<Name, Law> = BTreeMap::new();
    for premise in &statements.premises {
        let sides = [&premise.equation.left, &premise.equation.right];
        if premise.assume.iter().any(runs_in) {
            return Err("a condition of a premise speaks of members or of their index".to_owned());
        }
        if !sides.into_iter().any(runs) {
            rest.premises.push(premise.clone());
            continue;
        }
        let law = Law::of(premise, setting)?;
        let state = law.given.state.clone();
        if laws.insert(state.clone(), law).is_some() {
            return Err(format!("more than one premise gives {state}"));
        }
    }
    let well_founded = in_order(laws)?;
    let all = trees(&rest);
    let is_numbered = |node: &Tree| {
        matches!(node, Tree::Symbol(name, _)
            if setting.states.contains(&name.bare()) && Member::of(name, setting).is_none())
    };
    if all.iter().any(|tree| any(tree, &mut |node| is_numbered(node))) {
        return Err("a member at a number says where a sequence begins".to_owned());
    }
    let named = members(all, setting);
    let is_explicit = well_founded.iter().all(|law| law.by.is_empty());
    if named.iter().any(|member| member.multiple != 1) && !is_explicit {
        return Err("members at a multiple of the index of a sequence that no formula gives".to_owned());
    }
    let (first, mut said) = reached(&named, &well_founded, 0, setting)?;
    // a proof goes from the first members on, a point is found from the last ones back
    said.reverse();
    let mut sufficient = shown(&rest, &said, statements, setting)?;
    let goal = |said: Vec<Premise>, assume: Option<Condition>, part: &str| {
        let mut statements = rest.clone().by(Rule::SequenceInstances);
        statements.premises.extend(said);
        statements.assume.extend(assume);
        setting.goal(&statements, part.to_owned())
    };
    sufficient.push(goal(said, None, "")?);
    // wherever the sequences begin, they may have begun before
    let (_, said) = reached(&named, &well_founded, BEFORE, setting)?;
    let begun = Condition::Relation(Equation {
        relation: Relation::GreaterOrEqual,
        ..Equation::between(symbol(&setting.letter), integer(1 + BEFORE - first.min(0)))
    });
    Ok(Reduced {
        necessary: vec![goal(said, Some(begun), "behind the first members")?],
        sufficient,
        ..Reduced::default()
    })
}

/// The least offset of a member that is named, and what the premises say of these members and of those that these are given by,
/// down to some indices before the least.
fn reached(
    named: &BTreeSet<Member>,
    laws: &[Law],
    before: i64,
    setting: &Setting,
) -> Result<(i64, Vec<Premise>), String> {
    let (mut first, mut said) = (None, Vec::new());
    let multiples: BTreeSet<i64> = named.iter().map(|member| member.multiple).collect();
    for multiple in multiples {
        let offsets = named.iter().filter(|member| member.multiple == multiple);
        let offsets: Vec<i64> = offsets.map(|member| member.offset).collect();
        // the index is that of the premises, which hold there as they are written
        let written = laws.iter().filter(|_| multiple == 1).map(Law::least);
        let (Some(low), Some(&high)) = (offsets.iter().copied().chain(written).min(), offsets.iter().max()) else {
            continue;
        };
        if high.checked_sub(low).is_none_or(|places| places > MOST_PLACES) {
            return Err("the members that are spoken of lie too far apart".to_owned());
        }
        first = first.min(Some(low)).or(Some(low));
        // the last members first: what these are given by is needed too
        let (low, mut needed) = (low - before, named.clone());
        for place in (low..=high).rev() {
            for law in laws.iter().rev() {
                let by = place - law.given.offset;
                let given = Member {
                    multiple,
                    offset: place,
                    ..law.given.clone()
                };
                if needed.contains(&given) && law.least() + by >= low {
                    let members = law.by.iter().cloned();
                    needed.extend(members.map(|member| Member {
                        multiple,
                        offset: member.offset + by,
                        ..member
                    }));
                    said.push(law.at(multiple, place, setting));
                }
            }
        }
    }
    Ok((first.ok_or("no member of a sequence is spoken of")?, said))
}

/// That premises moved to other indices have a value there: where they have none, they say nothing.
fn shown(rest: &Statements, said: &[Premise], written: &Statements, setting: &Setting) -> Result<Vec<Goal>, String> {
    let mut context = defined::with_domain(rest, &setting.plain);
    let (as_written, moved): (Vec<&Premise>, Vec<&Premise>) = said.iter().partition(|premise| {
        let mut premises = written.premises.iter();
        premises.any(|own| own.equation == premise.equation)
    });
    context.premises.extend(as_written.into_iter().cloned());
    let mut goals = Vec::new();
    for premise in moved {
        let mut conditions = Vec::new();
        for side in [&premise.equation.left, &premise.equation.right] {
            let needed = defined::conditions(side, &setting.plain)?.into_iter();
            conditions.extend(needed.map(|condition| of_base(condition, side, &context)));
        }
        let is_new = |condition: &Equation| setting.runs(&condition.left) || condition.relation == Relation::NotEqual;
        for condition in conditions.into_iter().filter(is_new) {
            let part = format!("{condition} in ({})", premise.label);
            let mut alone = context.clone();
            alone.claims = vec![condition];
            goals.push(setting.goal(&alone, part)?);
        }
        context.premises.push(premise.clone());
    }
    Ok(goals)
}

/// That the base of a power is not 0 in place of the sign of its exponent, of which nothing is assumed.
fn of_base(condition: Equation, side: &Tree, context: &Statements) -> Equation {
    let is_assumed = context.assume.iter().any(|own| own.sides().contains(&&condition.left));
    let mut base = None;
    any(side, &mut |node| {
        if let Tree::RealPower(own, exponent, _) = node
            && **exponent == condition.left
        {
            base = Some((**own).clone());
        }
        base.is_some()
    });
    match base.filter(|_| !is_assumed && condition.relation == Relation::GreaterOrEqual) {
        Some(base) => Equation {
            relation: Relation::NotEqual,
            ..Equation::between(base, integer(0))
        },
        None => condition,
    }
}

impl<'a> Law<'a> {
    fn of(premise: &'a Premise, setting: &Setting) -> Result<Self, String> {
        let equation = &premise.equation;
        let refused = || format!("({}) gives no member by others", premise.label);
        for (left, right) in [(&equation.left, &equation.right), (&equation.right, &equation.left)] {
            let Tree::Symbol(name, _) = left else { continue };
            let Some(given) = Member::of(name, setting).filter(|member| member.multiple == 1) else {
                continue;
            };
            let by = members([right], setting);
            if equation.relation != Relation::Equal || by.iter().any(|member| member.multiple != 1) {
                return Err(refused());
            }
            // a member that stands for itself is given by nothing
            if !by.contains(&given) {
                return Ok(Self { premise, given, by });
            }
        }
        Err(refused())
    }

    /// The least offset of a member that it speaks of.
    fn least(&self) -> i64 {
        let offsets = self.by.iter().chain([&self.given]).map(|member| member.offset);
        offsets.min().unwrap_or_default()
    }

    /// The premise about the member at a place.
    fn at(&self, multiple: i64, offset: i64, setting: &Setting) -> Premise {
        let by = offset - self.given.offset;
        let moved = |tree: &Tree| {
            rewrite(tree, &|name| {
                if *name == setting.letter {
                    let running = match multiple {
                        1 => symbol(name),
                        multiple => product(vec![integer(multiple), symbol(name)]),
                    };
                    return Some(match by {
                        0 => running,
                        by => sum(vec![running, integer(by)]),
                    });
                }
                let member = Member::of(name, setting)?;
                Some(symbol(&Name {
                    subscript: texmath::place(multiple, member.offset + by, &setting.letter.base),
                    ..member.state
                }))
            })
        };
        let mut premise = self.premise.clone();
        premise.equation.left = moved(&premise.equation.left);
        premise.equation.right = moved(&premise.equation.right);
        premise
    }
}

/// The premises in an order in which each gives a sequence by members before, and by sequences that are given already.
fn in_order(mut laws: BTreeMap<Name, Law>) -> Result<Vec<Law>, String> {
    let mut ordered: Vec<Law> = Vec::new();
    while !laws.is_empty() {
        let is_next = |law: &Law| {
            law.by.iter().all(|member| {
                let is_before = member.offset < law.given.offset;
                let is_beside = member.offset == law.given.offset;
                !laws.contains_key(&member.state) && (is_beside || !gives(&ordered, member)) || is_before
            })
        };
        let next = laws
            .iter()
            .find(|(_, law)| is_next(law))
            .map(|(state, _)| state.clone());
        let law = next.and_then(|state| laws.remove(&state));
        ordered.push(law.ok_or("the premises do not give the sequences one after the other")?);
    }
    Ok(ordered)
}

fn gives(laws: &[Law], member: &Member) -> bool {
    laws.iter().any(|law| law.given.state == member.state)
}
