#![doc = include_str!("../README.md")]
//!
//! The search for proofs and counterexamples, and the verdicts. What the search finds for a goal, the kernel accepts or not;
//! that the goals of a claim decide it is trusted, as are the reductions that they come from.

// Library code never panics by its own word: errors are returned.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

pub mod algebra;
pub mod checksum;

mod angles;
mod budget;
mod constants;
mod counterexample;
mod decision;
mod dividing;
mod explanation;
mod float;
mod formula;
pub mod integration;
mod inverse;
mod laws;
mod logarithms;
mod outcome;
mod point;
mod powers;
mod print;
mod proof;
mod referee;
mod referee_lines;
mod referee_point;
mod referee_proof;
pub mod rocq;
mod roots;
mod script;
mod session;
mod signs;
mod small_numbers;
pub mod summation;
mod sympy;
mod values;
mod words;

use budget::{Budget, Depth, PROOF_STEPS};
use dividing::Division;
use outcome::{Outcome, outcome};

pub use counterexample::Counterexample;
pub use decision::{Decision, mention_refuted, settle_second_values};
pub use explanation::{Explanation, explain, formula};
pub use referee::short_scripts;
pub use referee_lines::{LONGEST, NoScript};
pub use script::{CHECKER, Decided, Found, SCHEMA, file_names, proof_data};

use claims::{
    Conditional, Fault, Goal, Matched, Proposal, Proposals, Provided, Reduced, Rule, Rules, SeriesTest, Sheet,
    Standing, Statements, Verdict, by_induction, number_in, of_nothing, other_ways, reduced, reduced_by_cases,
    sign_cases, thin_domains, under_conditions, values, word_question,
};
use numbers::Rational;
use std::cell::Cell;
use texmath::{DoubtKind, Equation, Name, Operation, Relation, Symbols, Tree, any_side, holds, is_opaque};

/// A power of a negative number, as `(-1)^{n/2}`, of which an author may mean values of n alone for which it has one.
fn negative_power(equation: &Equation) -> Option<Tree> {
    let mut found = None;
    let mut is_one = |node: &Tree| {
        if let Tree::RealPower(base, ..) = node
            && matches!(&**base, Tree::Negate(inner) if matches!(**inner, Tree::Number(_)))
        {
            found = Some(node.clone());
        }
        found.is_some()
    };
    any_side(equation, &mut is_one);
    found
}

/// How far the search goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The limit in steps, as a multiple of the usual one.
    pub effort: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { effort: 1 }
    }
}

/// Decides the claim at a position of the sheet. What cannot be read is `unread`; what follows from such is
/// `undecided`.
pub fn decide(sheet: &Sheet, position: usize, options: &Options) -> Decision {
    let entry = sheet.entries.get(position);
    let standing = entry.map(|entry| entry.standing).unwrap_or_default();
    if standing == Standing::Definition
        && let Some(entry) = entry.filter(|entry| entry.unread.is_none())
    {
        let name = entry.equations.first().map(|equation| equation.left.to_string());
        let reason = name.map_or("a definition".to_owned(), |name| format!("a definition of `{name}`"));
        return Decision::of(sheet, position).given(reason);
    }
    if let (Standing::Definition | Standing::Law, Some(fault)) =
        (standing, entry.and_then(|entry| entry.unread.as_ref()))
    {
        return Decision::of(sheet, position).given(given_unread(standing, fault));
    }
    let Searched { decision, .. } = search(sheet, position, options, false);
    match (standing, decision.verdict) {
        (Standing::Law, Verdict::Undecided) => {
            let reason = format!(
                "a law, if it does not follow from what stands before it: {}",
                decision.reason
            );
            decision.given(reason)
        }
        _ => decision,
    }
}

/// The end of the question what letters are that a document marks.
const MARKED: &str = ", as the document marks them?";

/// The reason why a formula that cannot be read is given.
fn given_unread(standing: Standing, fault: &Fault) -> String {
    let what = match standing {
        Standing::Definition => "a definition",
        _ => "said, not derived",
    };
    format!("{what}; not all of it is read: {}", fault.message)
}

/// What decides the claim at a position, question by question: nothing for a claim that stays undecided.
pub fn decided(sheet: &Sheet, position: usize, options: &Options) -> Vec<Decided> {
    let searched = search(sheet, position, options, true);
    let (verdict, mut kept) = (searched.decision.found(), searched.kept);
    kept.retain(|one| match verdict {
        Verdict::Conditional => one.of_exception,
        verdict => !one.of_exception && one.found.verdict() == verdict,
    });
    kept
}

/// The result of the search for a claim.
struct Searched {
    decision: Decision,
    /// The sheet in which the claim is decided, where it is not the one that was given.
    instead: Option<Sheet>,
    /// The questions that were met with what decides them, where they are asked for.
    kept: Vec<Decided>,
}

/// Decides the claim at a position in its readings: of each index first where premises take one to the next, and by itself
/// where its premises leave it open, since what holds so holds whatever they mean.
fn search(sheet: &Sheet, position: usize, options: &Options, keep: bool) -> Searched {
    let run = |sheet: &Sheet| {
        let mut search = Search::of(sheet, position, options);
        search.kept = keep.then(Vec::new);
        (search.decide_readings(sheet, position), search.kept.unwrap_or_default())
    };
    let proved_in = |instead: Sheet| {
        let (decision, kept) = run(&instead);
        let instead = Some(instead);
        (decision.verdict == Verdict::Proved).then_some(Searched {
            decision,
            instead,
            kept,
        })
    };
    if let Some((mut searched, reading)) = sheet.at_each_index(position).and_then(|(instead, reading)| {
        let searched = proved_in(instead)?;
        Some((searched, reading))
    }) {
        searched.decision.readings.push(reading);
        searched.decision.at_each_index = true;
        return searched;
    }
    let (decision, kept) = run(sheet);
    let by_itself = match decision.verdict {
        Verdict::Undecided if !decision.fails => sheet.resting_on_nothing(position),
        _ => None,
    };
    by_itself.and_then(proved_in).unwrap_or(Searched {
        decision,
        instead: None,
        kept,
    })
}

/// Returns true if a claim follows from others.
fn rests_on_others(sheet: &Sheet, position: usize) -> bool {
    let entry = sheet.entries.get(position);
    entry.is_some_and(|entry| entry.unread.is_none() && !entry.follows_from.is_empty())
}

/// Returns true if a claim without conditions holds a sum of unknown length, of which no number is known, or a term that is not
/// understood, and may be linear.
fn speaks_of_sums(sheet: &Sheet, position: usize) -> bool {
    let is_sum = |node: &Tree| match node {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Series { from, to, .. } => [from, to].into_iter().any(|end| !matches!(end, Tree::Number(_))),
            _ => false,
        },
        Tree::Symbol(name, _) => is_opaque(name),
        _ => false,
    };
    let entry = sheet.entries.get(position).filter(|entry| entry.assume.is_empty());
    entry.is_some_and(|entry| {
        let mut equations = entry.equations.iter();
        equations.any(|equation| any_side(equation, &mut |node| is_sum(node)))
    })
}

/// Returns what proves a claim as one about letters that need not commute, with the rules by which it was read.
fn in_words(sheet: &Sheet, position: usize) -> Option<(kernel::WordQuestion, kernel::WordProof, Rules)> {
    let entry = sheet.entries.get(position)?;
    let statements = Decision::without_search(sheet, position).ok()?;
    let question = word_question(&statements, &entry.operators, entry.columns)?;
    let found = words::proof(&question)?;
    Some((question, found, statements.rules))
}

/// Returns what proves the claim at a position as one about letters that need not commute, where it is proved so.
pub(crate) fn proof_in_words(
    sheet: &Sheet,
    position: usize,
    options: &Options,
) -> Option<(kernel::WordQuestion, kernel::WordProof)> {
    let searched = search(sheet, position, options, false);
    let (decision, sheet) = (searched.decision, searched.instead.as_ref().unwrap_or(sheet));
    let is_one = decision.found() == Verdict::Proved && decision.rules.contains(&Rule::Words);
    let (question, found, _) = is_one.then(|| in_words(sheet, position)).flatten()?;
    Some((question, found))
}

/// The search for what decides one claim.
struct Search<'a> {
    /// The decision before anything is known.
    start: Decision,
    /// The reason of a proof.
    reason: String,
    /// The claim as it was read, in TeX.
    printed: String,
    options: &'a Options,
    budget: Budget,
    /// What decides the questions that were met, where it is asked for.
    kept: Option<Vec<Decided>>,
    /// True if the claim has lemmas, and all of those of the last goals were shown: other ones would bring the same goals.
    are_lemmas_shown: bool,
    /// The cases that the claim is decided in, and the lemma that was not shown last.
    cases: Vec<Equation>,
    open: Option<Equation>,
    /// The goals that were met: several ways to decide the claim ask for the same.
    met: Vec<Met>,
}

/// A goal with its decision and with what is kept of it.
struct Met {
    depth: Depth,
    statements: Statements,
    symbols: Symbols,
    decision: Decision,
    kept: Vec<Decided>,
}

impl<'a> Search<'a> {
    fn of(sheet: &Sheet, position: usize, options: &'a Options) -> Self {
        Self {
            start: Decision::of(sheet, position),
            reason: follows_from(sheet, position),
            printed: sheet
                .entries
                .get(position)
                .map_or_else(String::new, |entry| entry.tex.tex.clone()),
            options,
            budget: Budget::of_claim(options.effort),
            kept: None,
            are_lemmas_shown: false,
            cases: Vec::new(),
            open: None,
            met: Vec::new(),
        }
    }

    /// The statements of a claim, in the case in which it is decided.
    fn statements(&self, sheet: &Sheet, position: usize) -> Result<Statements, Box<Decision>> {
        let mut statements = Decision::without_search(sheet, position)?;
        for case in &self.cases {
            statements = statements.in_case(case, &sheet.symbols);
        }
        Ok(statements)
    }

    /// Decides a claim, and in its other readings too, where these are known: what is so in all of them stands.
    fn decide_readings(&mut self, sheet: &Sheet, position: usize) -> Decision {
        let mut doubts = sheet.doubts(position);
        self.start.readings = doubts.iter().filter_map(DoubtKind::taken).collect();
        // what holds of letters that need not commute holds of numbers too
        let is_marked = |kind: &DoubtKind| matches!(kind, DoubtKind::Marked(_));
        let of_all = match doubts.iter().any(is_marked) {
            true => self.in_words(sheet, position),
            false => None,
        };
        let decision = match of_all {
            Some(mut decision) => {
                let (marked, others) = doubts.into_iter().partition(|kind| is_marked(kind));
                doubts = others;
                let either = |kind: DoubtKind| match kind {
                    DoubtKind::Marked(letters) => Some(format!("{}: either", letters.strip_suffix(MARKED)?)),
                    _ => None,
                };
                decision.readings.extend(Vec::into_iter(marked).filter_map(either));
                decision
            }
            // nothing else would prove it of all of them; a link that fails for numbers fails
            None if doubts.iter().any(is_marked) && rests_on_others(sheet, position) => {
                let open: Vec<String> = doubts
                    .iter()
                    .filter(|kind| is_marked(kind))
                    .map(ToString::to_string)
                    .collect();
                let reason = format!("no proof is found that keeps the order of factors: {}", open.join("; "));
                match Decision::without_search(sheet, position) {
                    Ok(_) => {
                        let is_link = self.start.standing == Standing::Link;
                        let of_numbers = is_link.then(|| self.decide(sheet, position));
                        let refuted = of_numbers.filter(|decision| decision.verdict == Verdict::Refuted);
                        refuted.unwrap_or_else(|| Decision {
                            reason,
                            ..self.start.clone()
                        })
                    }
                    Err(unread) => *unread,
                }
            }
            None => {
                let decision = self.decide(sheet, position);
                // numbers in the place of sums and means do not refute what is linear
                let is_open = decision.verdict != Verdict::Proved && !decision.is_vacuous;
                let is_of_sums = || is_open && !doubts.iter().any(is_marked) && speaks_of_sums(sheet, position);
                let further = is_of_sums().then(|| self.in_words(sheet, position)).flatten();
                further.unwrap_or(decision)
            }
        };
        let is_open = match decision.verdict {
            Verdict::Refuted => true,
            Verdict::Proved => !doubts.iter().all(DoubtKind::spares_proofs),
            _ => false,
        };
        if is_open {
            let (otherwise, places) = sheet.read_otherwise(position);
            let is_same = |sheet: &Sheet| {
                Search::of(sheet, position, self.options)
                    .decide(sheet, position)
                    .verdict
                    == decision.verdict
            };
            if otherwise.iter().all(is_same) {
                doubts.retain(|kind| !places.contains(kind));
            }
        }
        if decision.verdict == Verdict::Refuted {
            // where a letter has no part in the counterexample, no value of it helps
            let point = decision.counterexample.iter().flat_map(|own| &own.point);
            let named: Vec<&String> = point.map(|(name, _)| name).collect();
            let is_named = |name: &Name| named.iter().any(|known| known.contains(&name.to_string()));
            doubts.retain(|kind| !matches!(kind, DoubtKind::OfSome(name) if !is_named(name)));
        }
        decision.on_doubts(doubts)
    }

    /// Decides a claim as one about letters that need not commute; nothing where it is not proved so.
    fn in_words(&mut self, sheet: &Sheet, position: usize) -> Option<Decision> {
        let (question, found, rules) = in_words(sheet, position)?;
        // what its author says is claimed for empty sums too
        if self.start.standing == Standing::Said && !question.provided.is_empty() {
            return None;
        }
        let proved = kernel::prove_in_words(&question, &found).ok()?;
        let mut decision = self.start.clone();
        decision.reason.clone_from(&self.reason);
        decision.accept_proofs(&[proved]);
        decision.provide(question.provided);
        decision.rules.extend(rules);
        decision.rules.insert(Rule::Words);
        Some(decision)
    }

    /// Decides a claim by the first antiderivatives that are found for its integrals; by others where these are not shown to be
    /// such, and by none.
    fn decide(&mut self, sheet: &Sheet, position: usize) -> Decision {
        let known = self.known();
        let (first, ways) = self.decide_by(sheet, position, Some(0));
        let is_open = |decision: &Decision| decision.verdict == Verdict::Undecided && !decision.is_vacuous;
        if !is_open(&first) {
            return first;
        }
        if let Some(decision) = self.by_signs(sheet, position) {
            return decision;
        }
        if !has_ways(sheet, position) || self.are_lemmas_shown {
            return first;
        }
        for place in (1..ways.min(MOST_WAYS)).map(Some).chain([None]) {
            self.forget(known);
            let (decision, _) = self.decide_by(sheet, position, place);
            if !is_open(&decision) && decision.verdict != Verdict::Unread {
                return decision;
            }
        }
        self.forget(known);
        first
    }

    /// Decides a claim in each case of the sign of what a lemma says that is not shown; nothing where it is not decided so.
    fn by_signs(&mut self, sheet: &Sheet, position: usize) -> Option<Decision> {
        let (open, known) = (self.open.take()?, self.known());
        if self.cases.len() >= MOST_CASES {
            return None;
        }
        let statements = self.statements(sheet, position).ok()?;
        let mut shown: Vec<(Decision, Equation)> = Vec::new();
        let (mut is_open, mut is_undefined) = (false, false);
        for case in sign_cases(&open, &statements, &sheet.symbols) {
            let part = format!("where {case}");
            self.cases.push(case.clone());
            let decision = self.decide(sheet, position);
            let is_case = decision.verdict == Verdict::Proved || !self.is_contradictory(sheet, position);
            self.cases.pop();
            match decision.verdict {
                Verdict::Proved => shown.push((decision, case)),
                Verdict::Refuted if !decision.is_vacuous => {
                    let values: Vec<(Name, Rational)> = number_in(&case, &sheet.symbols).into_iter().collect();
                    let mut decision = decision.in_part(&part).with(&values);
                    decision.exception = None;
                    return Some(decision);
                }
                // nothing lies in such a case, or the claim has no value there, which may be part of it
                _ if !is_case => {}
                Verdict::Refuted if !statements.assert_values() => is_undefined = true,
                _ => is_open = true,
            }
        }
        if is_open || shown.is_empty() {
            self.forget(known);
            return None;
        }
        // conditions of different cases do not add up to one: where it holds without any is said
        let is_bare = |(own, _): &(Decision, Equation)| own.provided.is_empty();
        if shown.iter().any(is_bare) && !shown.iter().all(is_bare) {
            shown.retain(is_bare);
            is_undefined = true;
        }
        let (shown, holding): (Vec<Decision>, Vec<Equation>) = shown.into_iter().unzip();
        let mut decision = Decision {
            reason: self.reason.clone(),
            ..self.start.clone()
        };
        decision.conclude(shown);
        if is_undefined {
            decision.provide(joined(&holding).map(|condition| condition.to_string()));
        }
        Some(decision)
    }

    /// Returns true if what is given contradicts itself in the case in which a claim is decided, or the claim has no value there.
    fn is_contradictory(&mut self, sheet: &Sheet, position: usize) -> bool {
        let statements = self.statements(sheet, position);
        statements.is_ok_and(|statements| {
            let known = self.known();
            let found = self.decided_goal(&of_nothing(&statements, &sheet.symbols));
            self.forget(known);
            found.is_vacuous
        })
    }

    /// Decides a claim by the antiderivatives at a place among those that are found, or by none; and how many are found at most.
    fn decide_by(&mut self, sheet: &Sheet, position: usize, place: Option<usize>) -> (Decision, usize) {
        let ways = Cell::new(0);
        let statements = self.statements(sheet, position);
        let decision = match statements.and_then(|statements| goals(statements, sheet, position, place, &ways)) {
            Ok(goals) => self.decide_goals(sheet, position, &goals),
            Err(decision) => *decision,
        };
        (decision, ways.get())
    }

    /// Decides a claim by the goals that it comes to.
    fn decide_goals(&mut self, sheet: &Sheet, position: usize, goals: &Reduced) -> Decision {
        let decision = self.together(goals);
        let is_plain = goals.is_equivalent && goals.sufficient.iter().all(|goal| goal.part.is_empty());
        let further = match (decision.verdict, goals.sufficient.as_slice()) {
            (Verdict::Undecided, [goal]) if is_plain && !decision.is_vacuous => {
                reduced_by_cases(&goal.statements, &goal.symbols)
            }
            _ => None,
        };
        let further = further.map(|mut further| {
            further.lemmas.extend(goals.lemmas.iter().cloned());
            further
        });
        let decision = match further.as_ref().map(|further| self.together(further)) {
            Some(further) if further.verdict != Verdict::Undecided || !further.reason.ends_with(": ") => further,
            _ => decision,
        };
        let decision = match decision.verdict {
            Verdict::Undecided if !decision.is_vacuous => {
                let mut ways = std::iter::once(goals).chain(&further);
                ways.find_map(|way| self.under_conditions(way)).unwrap_or(decision)
            }
            _ => decision,
        };
        let decision = match decision.verdict {
            Verdict::Undecided if !decision.is_vacuous => self.by_induction(sheet, position).unwrap_or(decision),
            _ => decision,
        };
        if decision.verdict != Verdict::Proved {
            return decision;
        }
        let mut ways = goals.sufficient.iter().filter(|goal| goal.statements.is_way);
        let thin = ways
            .find_map(|goal| self.without_value(goal))
            .or_else(|| match goals.sufficient.as_slice() {
                [goal] => self.thin(goal),
                _ => None,
            });
        thin.unwrap_or(decision)
    }

    /// Proves inequalities by induction over one of their integers; nothing where they are not proved so.
    fn by_induction(&mut self, sheet: &Sheet, position: usize) -> Option<Decision> {
        let statements = self.statements(sheet, position).ok()?;
        let goals = by_induction(&statements, &sheet.symbols)?;
        let known = self.known();
        let decision = self.together(&goals);
        if decision.verdict != Verdict::Proved {
            self.forget(known);
            return None;
        }
        Some(decision)
    }

    /// Decides a claim where the bases of its powers are positive and its integrals have values; nothing where it is not decided so.
    fn under_conditions(&mut self, goals: &Reduced) -> Option<Decision> {
        let Conditional { goals, provided } = under_conditions(goals)?;
        let known = self.known();
        let mut decision = self.together(&goals);
        match decision.verdict {
            Verdict::Proved => {
                let shown = self.known();
                let mut holds = |goal: &Goal| self.decided_goal(goal).verdict == Verdict::Proved;
                let needed: Vec<Provided> = provided
                    .into_iter()
                    .filter(|own| !own.at_zero.iter().any(&mut holds))
                    .collect();
                self.forget(shown);
                // that it has a value is part of the claim
                if !needed.is_empty() && goals.sufficient.iter().any(|goal| goal.statements.assert_values()) {
                    self.forget(known);
                    return None;
                }
                decision.provide(needed.into_iter().map(|own| own.printed));
            }
            Verdict::Refuted if !decision.is_vacuous => {}
            _ => {
                self.forget(known);
                return None;
            }
        }
        Some(decision)
    }

    /// Of a way of an equivalence that is proved but may have no value where what is assumed holds: that the solutions of the
    /// two sides are not shown to be the same.
    fn without_value(&mut self, goal: &Goal) -> Option<Decision> {
        let known = self.known();
        let open = match values(goal) {
            Ok(values) => {
                let mut values = values.into_iter();
                let open = values.find(|(_, goal)| self.decided_goal(goal).verdict != Verdict::Proved);
                open.map(|(condition, _)| format!("{condition} is not shown"))
            }
            Err(unknown) => Some(unknown),
        };
        self.forget(known);
        Some(Decision {
            reason: format!(
                "holds where it has a value, but {} where the other side of the arrow holds",
                open?
            ),
            ..self.start.clone()
        })
    }

    /// Of a claim that is proved but has a value on a thin set alone: that it says next to nothing. Mostly a sign under a
    /// root is wrong.
    fn thin(&mut self, goal: &Goal) -> Option<Decision> {
        let known = self.known();
        let found = thin_domains(goal).into_iter().find(|(_, goal)| {
            let found = self.decided_goal(goal);
            found.verdict == Verdict::Proved && !found.is_vacuous
        });
        self.forget(known);
        let (radicand, _) = found?;
        Some(Decision {
            reason: format!(
                "has a value only where {radicand} = 0: this is nowhere above 0, by what is given and what else must have a value"
            ),
            ..self.start.clone()
        })
    }

    /// What the goals of a claim come to together.
    fn together(&mut self, goals: &Reduced) -> Decision {
        let mut shown = Vec::new();
        self.are_lemmas_shown = false;
        self.open = None;
        for lemma in &goals.lemmas {
            let found = self.settled_otherwise(lemma);
            if lemma.may_be_empty && found.is_vacuous {
                continue;
            }
            if found.verdict != Verdict::Proved {
                self.open = match lemma.statements.claims.as_slice() {
                    [claim] => Some(claim.clone()),
                    _ => None,
                };
                return Decision {
                    reason: format!("{} is not shown: {}", lemma.part, found.reason),
                    ..self.start.clone()
                };
            }
            shown.push(found);
        }
        self.are_lemmas_shown = !goals.lemmas.is_empty();
        for goal in &goals.necessary {
            let known = self.known();
            let found = self.settled_otherwise(goal);
            if matches!(found.verdict, Verdict::Refuted | Verdict::Unread) && !found.is_vacuous {
                let mut found = found.in_part(&goal.part).with(&goal.values);
                found.exception = None;
                return found;
            }
            // what is necessary shows nothing where it holds
            self.forget(known);
        }
        let (mut met, mut vacuous, mut open) = (0, None, None);
        for goal in &goals.sufficient {
            let found = self.settled_otherwise(goal);
            match found.verdict {
                Verdict::Undecided | Verdict::Refuted if found.is_vacuous && goal.may_be_empty => {}
                // a case that nothing is in says nothing, where another one holds
                Verdict::Undecided | Verdict::Refuted if found.is_vacuous && goals.sufficient.len() > 1 => {
                    vacuous = Some(found.in_part(&goal.part));
                }
                Verdict::Proved => {
                    // what holds at the border of its domain alone says next to nothing
                    met += usize::from(!goal.may_be_empty);
                    shown.push(found);
                }
                // what is enough for the claim may fail where the claim holds
                Verdict::Refuted if !goals.is_equivalent => {
                    let part = if goal.part.is_empty() {
                        "what would prove it"
                    } else {
                        &goal.part
                    };
                    open = Some(Decision {
                        reason: format!("no counterexample is found, nor a proof: {part} fails"),
                        ..self.start.clone()
                    });
                    break;
                }
                Verdict::Refuted | Verdict::Unread => {
                    let mut found = found.in_part(&goal.part).with(&goal.values);
                    found.exception = found.exception.filter(|_| goals.sufficient.len() == 1);
                    return found;
                }
                Verdict::Undecided | Verdict::Conditional | Verdict::Given | Verdict::Suspect => {
                    open = Some(found.in_part(&goal.part))
                }
            }
        }
        match (vacuous, open) {
            _ if goals.sufficient.is_empty() => Decision {
                reason: format!("no counterexample is found, nor a proof: {}", goals.reason),
                ..self.start.clone()
            },
            (_, Some(open)) => open,
            (Some(found), None) if met == 0 || !goals.is_equivalent => Decision {
                verdict: Verdict::Undecided,
                ..found
            },
            _ => {
                let mut decision = Decision {
                    reason: self.reason.clone(),
                    ..self.start.clone()
                };
                decision.conclude(shown);
                decision
            }
        }
    }

    /// How much is kept.
    fn known(&self) -> usize {
        self.kept.as_ref().map_or(0, Vec::len)
    }

    /// Drops what was kept since.
    fn forget(&mut self, known: usize) {
        if let Some(kept) = &mut self.kept {
            kept.truncate(known);
        }
    }

    /// Decides one goal of a claim, an inequality by the signs of derivatives where it is not decided as it stands. All of these
    /// ways are tried quickly before one of them is followed far.
    fn settled_otherwise(&mut self, goal: &Goal) -> Decision {
        let known = self.known();
        let mut decision = self.settled(goal, Depth::Quick);
        let is_open = |decision: &Decision| decision.verdict == Verdict::Undecided && !decision.is_vacuous;
        if !is_open(&decision) {
            return decision;
        }
        let ways = other_ways(&goal.statements, &goal.symbols);
        for depth in [Depth::Quick, Depth::Deep] {
            self.forget(known);
            if depth == Depth::Deep {
                decision = self.settled(goal, depth);
            }
            if !is_open(&decision) {
                break;
            }
            self.forget(known);
            let mut shown = ways.iter().filter_map(|parts| {
                let shown = self.shown_by_parts(parts, depth).filter(|shown| !shown.is_empty());
                if shown.is_none() {
                    self.forget(known);
                }
                shown
            });
            if let Some(shown) = shown.next() {
                let mut decision = self.start.clone();
                decision.conclude(shown);
                return decision;
            }
        }
        decision
    }

    /// The decisions on goals by which all parts of a claim are proved, each by the first way that succeeds.
    fn shown_by_parts(&mut self, parts: &[Vec<Vec<Goal>>], depth: Depth) -> Option<Vec<Decision>> {
        let mut shown = Vec::new();
        for ways in parts {
            shown.extend(ways.iter().find_map(|way| self.holding(way, depth))?);
        }
        Some(shown)
    }

    /// The decisions on the goals where all are proved, for every number: a derivative must have its sign everywhere, and what
    /// is provided for one number is no proof.
    fn holding(&mut self, way: &[Goal], depth: Depth) -> Option<Vec<Decision>> {
        let known = self.known();
        let mut shown = Vec::new();
        for goal in way {
            let found = self.settled(goal, depth);
            if found.verdict != Verdict::Proved || !found.provided.is_empty() {
                self.forget(known);
                return None;
            }
            shown.push(found);
        }
        Some(shown)
    }

    /// Decides one goal of a claim as it stands.
    fn decided_goal(&mut self, goal: &Goal) -> Decision {
        let known = self.known();
        let decision = self.settled(goal, Depth::Quick);
        if decision.verdict != Verdict::Undecided {
            return decision;
        }
        self.forget(known);
        self.settled(goal, Depth::Deep)
    }

    /// Decides one goal of a claim, once for each depth.
    fn settled(&mut self, goal: &Goal, depth: Depth) -> Decision {
        let is_open = |met: &Met| met.decision.verdict == Verdict::Undecided && met.depth < depth;
        let is_same = |met: &Met| met.statements == goal.statements && met.symbols == goal.symbols;
        let is_it = |met: &&Met| !is_open(met) && is_same(met);
        if let Some(met) = self.met.iter().find(is_it) {
            if let Some(kept) = &mut self.kept {
                kept.extend(met.kept.iter().cloned());
            }
            return met.decision.clone();
        }
        let known = self.known();
        let decision = self.searched(goal, depth);
        self.met.push(Met {
            depth,
            statements: goal.statements.clone(),
            symbols: goal.symbols.clone(),
            decision: decision.clone(),
            kept: self
                .kept
                .iter()
                .flat_map(|kept| kept.iter().skip(known))
                .cloned()
                .collect(),
        });
        decision
    }

    /// Decides one goal of a claim by a search.
    fn searched(&mut self, goal: &Goal, depth: Depth) -> Decision {
        let mut decision = self.start.clone();
        let questions = match claims::questions(&goal.statements, &goal.symbols) {
            Ok(questions) => questions,
            Err(fault) => {
                decision.verdict = Verdict::Unread;
                decision.reason = fault.to_string();
                return decision;
            }
        };
        decision.rules.clone_from(&goal.statements.rules);
        let (mut is_open, count) = (false, questions.len());
        let mut proofs = Vec::new();
        for question in questions {
            let search = std::panic::AssertUnwindSafe(|| outcome(&question.statement, depth, &self.budget));
            // a fault of the search costs its own claim a verdict, and no other
            let outcome = std::panic::catch_unwind(search).unwrap_or_else(|_| Outcome::Undecided(BROKE_DOWN.into()));
            match outcome {
                Outcome::Proved(proof, certificate, point) => {
                    let terms = certificate.statement.terms();
                    let excluded = proof.excluded().iter();
                    let excluded = excluded.map(|&term| format!(r"{} \neq 0", print::tex(terms, term)));
                    decision.provide(proof.provided().iter().cloned().chain(excluded));
                    if decision.point.is_empty() {
                        decision.point = counterexample::point(&point);
                    }
                    proofs.push(proof);
                    self.keep(goal, question, Found::Proved { certificate, point }, false);
                }
                Outcome::Refuted(refuted, witness) => {
                    let power = negative_power(&question.equation);
                    if let Some(power) = power.filter(|_| refuted.is_nowhere_defined()) {
                        is_open = true;
                        decision.reason = format!(
                            "`{power}` has a value where its exponent is written as a polynomial with integer coefficients: nowhere defined as it is"
                        );
                        break;
                    }
                    decision.accept_refutation(&refuted);
                    decision.failed = Some(question.equation.clone());
                    if decision.is_vacuous {
                        decision.reason = "nowhere defined".into();
                        break;
                    }
                    // what nothing is named for is judged as an identity
                    decision.reason = match self.reason.as_str() {
                        AN_IDENTITY => "not an identity, and it names nothing that it follows from".into(),
                        _ => "does not follow from its premises".into(),
                    };
                    decision.counterexample = counterexample::at(&witness, question.equation.relation);
                    if let Some(division) = Division::of(goal, &question, self.options.effort) {
                        decision.doubts.push(division.doubt);
                        if let Some(exception) = division.exception.filter(|_| count == 1) {
                            for (goal, question, found) in exception.shown {
                                self.keep(&goal, question, found, true);
                            }
                            decision.exception = Some(exception.condition);
                        }
                    }
                    self.keep(goal, question, Found::Refuted { witness }, false);
                    break;
                }
                Outcome::Contradictory(labels) => {
                    let labels: Vec<String> = labels.iter().map(|label| format!("({label})")).collect();
                    is_open = true;
                    decision.is_vacuous = true;
                    decision.reason = match labels.as_slice() {
                        [single] => format!("the premise {single} contradicts itself"),
                        _ => format!("the premises {} contradict each other", labels.join(", ")),
                    };
                    decision.failed = Some(question.equation.clone());
                }
                Outcome::Undecided(reason) => {
                    is_open = true;
                    decision.reason = reason;
                    decision.failed = Some(question.equation.clone());
                }
            }
        }
        if !is_open && decision.verdict != Verdict::Refuted {
            decision.accept_proofs(&proofs);
        }
        decision
    }

    fn keep(&mut self, goal: &Goal, question: claims::Question, found: Found, of_exception: bool) {
        if let Some(kept) = &mut self.kept {
            kept.push(Decided {
                label: self.start.label.clone(),
                printed: self.printed.clone(),
                question,
                found,
                goal: goal.clone(),
                of_exception,
            });
        }
    }
}

/// The condition that one of some cases of a sign holds, where these are not all.
fn joined(cases: &[Equation]) -> Option<Equation> {
    let [first, rest @ ..] = cases else {
        return None;
    };
    let holds = |relation: Relation| cases.iter().any(|case| case.relation == relation);
    let relation = match (holds(Relation::Greater), holds(Relation::Less), holds(Relation::Equal)) {
        _ if rest.is_empty() => first.relation,
        (true, true, false) => Relation::NotEqual,
        (true, false, true) => Relation::GreaterOrEqual,
        (false, true, true) => Relation::LessOrEqual,
        _ => return None,
    };
    Some(Equation {
        relation,
        ..first.clone()
    })
}

/// Returns true if a definite integral or a sum to infinity stands in a claim, of which there may be several ways to its value.
fn has_ways(sheet: &Sheet, position: usize) -> bool {
    let is_infinite = |tree: &Tree| matches!(tree, Tree::Operation(own, _) if matches!(**own, Operation::Infinity));
    let is_one = |operation: &Operation| match operation {
        Operation::Integral { limits, .. } => limits.is_some(),
        Operation::Series { to, .. } => is_infinite(to),
        _ => false,
    };
    let entry = sheet.entries.get(position);
    entry.is_some_and(|entry| entry.equations.iter().any(|own| holds(own, &is_one)))
}

/// The most cases within each other.
const MOST_CASES: usize = 3;

/// The most antiderivatives of one integral that are tried.
const MOST_WAYS: usize = 3;

/// The antiderivatives at a place among those that are found, or none, and how many are found at most.
struct Ways<'a> {
    place: Option<usize>,
    most: &'a Cell<usize>,
}

impl Proposals for Ways<'_> {
    fn antiderivative(&self, of: &Tree, by: &Name, symbols: &Symbols) -> Option<Tree> {
        let place = self.place?;
        let mut found = integration::antiderivatives(of, by, symbols);
        self.most.set(self.most.get().max(found.len()));
        let last = found.len().checked_sub(1)?;
        Some(found.swap_remove(place.min(last)))
    }

    fn reduction_formula(&self, of: &Tree, other: &Tree, by: &Name, symbols: &Symbols) -> Option<[Tree; 2]> {
        self.place?;
        integration::reduction_formula(of, other, by, symbols)
    }

    fn zeros(&self, of: &Tree, by: &Name, between: [&Tree; 2]) -> Vec<Tree> {
        integration::zeros(of, by, between)
    }

    fn known_integral(&self, of: &Tree, by: &Name, limits: [&Tree; 2]) -> Option<Matched> {
        self.place.and_then(|_| integration::known_integral(of, by, limits))
    }

    fn telescoping(&self, term: &Tree, index: &Name, _: &Symbols) -> Option<Tree> {
        summation::telescoping(term, index)
    }

    fn summation(&self, term: &Tree, index: &Name, symbols: &Symbols) -> Option<Proposal> {
        summation::summation(term, index, symbols)
    }

    fn series_test(&self, term: &Tree, index: &Name, symbols: &Symbols) -> Option<SeriesTest> {
        let mut found = summation::convergence_tests(term, index, symbols);
        self.most.set(self.most.get().max(found.len()));
        let last = found.len().checked_sub(1)?;
        Some(found.swap_remove(self.place.unwrap_or(last).min(last)))
    }
}

/// The goals that a claim comes to by the antiderivatives at a place among those that are found, of which it counts the most;
/// itself, where it is about numbers.
fn goals(
    statements: Statements,
    sheet: &Sheet,
    position: usize,
    place: Option<usize>,
    ways: &Cell<usize>,
) -> Result<Reduced, Box<Decision>> {
    let search = Ways { place, most: ways };
    match reduced(&statements, &sheet.symbols, &search) {
        Ok(Some(reduced)) => Ok(reduced),
        Ok(None) => {
            let goal = Goal {
                statements,
                symbols: sheet.symbols.clone(),
                part: String::new(),
                values: Vec::new(),
                may_be_empty: false,
            };
            Ok(Reduced::itself(goal))
        }
        Err(reason) => Err(Box::new(Decision {
            reason,
            ..Decision::of(sheet, position)
        })),
    }
}

/// The reason of a claim at which the search itself fails.
const BROKE_DOWN: &str = "the search broke down here, which is a fault of this program: please report the sheet";

/// The reason of a claim without premises.
const AN_IDENTITY: &str = "an identity";

fn follows_from(sheet: &Sheet, position: usize) -> String {
    let premises = sheet
        .entries
        .get(position)
        .map(|entry| entry.follows_from.as_slice())
        .unwrap_or_default();
    let labels = premises
        .iter()
        .filter_map(|&n| sheet.entries.get(n))
        .map(|entry| format!("({})", entry.label));
    let labels: Vec<String> = labels.collect();
    match labels.is_empty() {
        true => AN_IDENTITY.to_string(),
        false => format!("follows from {}", labels.join(", ")),
    }
}

/// The certificates that the search finds for the questions of the claim at a position, each with its statement.
pub fn certificates(sheet: &Sheet, position: usize) -> Vec<kernel::With<kernel::Certificate>> {
    let statements = Decision::without_search(sheet, position);
    let goals = statements.and_then(|statements| goals(statements, sheet, position, Some(0), &Cell::new(0)));
    let Ok(goals) = goals else {
        return Vec::new();
    };
    let of = |goal: &Goal| claims::questions(&goal.statements, &goal.symbols).unwrap_or_default();
    let questions = goals.lemmas.iter().chain(&goals.sufficient).flat_map(of);
    questions
        .filter_map(|question| proof::search(&question.statement, PROOF_STEPS, &mut 0))
        .collect()
}

/// Decides each claim, in the order of the sheet. What cannot be read has a row too, whatever its role.
pub fn audit(sheet: &Sheet, options: &Options) -> Vec<Decision> {
    let rows = sheet.rows().into_iter();
    let mut decisions: Vec<Decision> = rows.map(|position| decide(sheet, position, options)).collect();
    settle_second_values(decisions.iter_mut());
    mention_refuted(sheet, decisions.iter_mut());
    decisions
}
