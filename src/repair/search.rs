//! Edits of a claim after which its sides agree at points where the premises hold.

use super::candidate::{Candidate, Formula, Valued};
use super::combine;
use super::context::Context;
use super::dictionary::{Dictionaries, Wanted, number_of};
use super::edit::{self, edits, missing_factor, missing_term, times};
use super::graph::{Graph, Overlay};
use super::matrices;
use super::path::{Path, node, replaced, size, walk};
use super::points;
use super::{Edit, Part, Repair, put};
use crate::claim::{Sheet, Statements};
use crate::evidence::sampled::{Leaves, Number, SizedValue, Value, agree};
use crate::evidence::trial;
use crate::stop::goes_on;
use crate::tex::{At, Equation, Name, Relation, Symbols, Tree, any_side};
use std::collections::{HashMap, HashSet};

/// What is looked for, the likelier first: the next where nothing before it is found and proved.
const STAGES: [Stage; 4] = [Stage::Single, Stage::Joined, Stage::Several(2), Stage::Several(3)];

/// Kinds of repairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// One edit; what is put in is a name, a short product or sum of names, or stands elsewhere.
    Single,
    /// One edit that puts in a product or a sum of two of these.
    Joined,
    /// So many edits.
    Several(usize),
}

impl Stage {
    /// How many edits are made at once.
    pub fn together(self) -> usize {
        match self {
            Self::Single | Self::Joined => 1,
            Self::Several(edits) => edits,
        }
    }
}

/// Points at which the sides are compared, and those without premises at which formulas are told apart.
const POINTS: usize = 6;
const FREE_POINTS: usize = 4;
/// Edited claims that are evaluated each by itself, the operations on numbers of all of these, and their nodes, for each unit of
/// effort; and points for each.
const MOST_TRIALS: u64 = 1_500;
const MOST_OPERATIONS: u64 = 1_000_000_000;
const MOST_TRIED_NODES: u64 = 60_000;
const TRIAL_POINTS: usize = 3;
/// The most formulas that are put in the place of one node by their values.
const MOST_OF_DICTIONARY: usize = 3;
/// By how much an edit counts as smaller where its term stands elsewhere in the sheet.
const AGREEMENT: u32 = 3;
/// A difference that is rounding.
const NOTHING: f64 = 1e-9;

/// By how much an edit counts as larger that puts a fraction in the place of a whole number, or another quantity in the place
/// of the one that the formula is about.
const OF_FRACTION: u32 = 4;
const OF_SUBJECT: u32 = 4;

/// By how much an edit counts as larger that makes a sum of what is none.
const OF_SUM: u32 = 2;

/// By how much an edit counts as larger that changes a sign beside.
const OF_SIGN: u32 = 2;

/// By how much an edit counts as larger that makes a power of a side for a power on the other.
const OF_POWER: u32 = 4;

/// By how much an edit counts as larger or smaller where the formula grows or shrinks by it.
const MOST_GROWTH: i32 = 2;

/// Edits after which the claim may be true.
#[derive(Clone, Debug)]
pub struct Found {
    pub edits: Vec<Candidate>,
    cost: u32,
}

impl Found {
    pub fn new(edits: Vec<Candidate>) -> Self {
        let cost = edits.iter().map(|candidate| candidate.edit.cost).sum();
        Self { edits, cost }
    }

    /// Whether something is put in of which the printed formula says nothing, or more than one thing is changed: after
    /// that sides may be one by making.
    pub fn may_balance(&self) -> bool {
        self.edits.len() > 1 || self.edits.iter().any(|candidate| candidate.edit.adds)
    }

    /// The formulas that change, as they should be, with their numbers.
    pub fn mended(&self, formulas: &[Formula]) -> Vec<(usize, Equation)> {
        let mut mended: Vec<(usize, Equation)> = Vec::new();
        for candidate in &self.edits {
            let known = mended.iter().position(|(number, _)| *number == candidate.formula);
            let known = known.unwrap_or_else(|| {
                let formula = formulas.get(candidate.formula);
                let none = || Equation::between(edit::number(0), edit::number(0));
                let equation = formula.map_or_else(none, |formula| formula.equation.clone());
                mended.push((candidate.formula, equation));
                mended.len() - 1
            });
            if let Some((_, equation)) = mended.get_mut(known) {
                *equation = match candidate.edit.relation {
                    Some(relation) => Equation {
                        relation,
                        ..equation.clone()
                    },
                    None => replaced(equation, &candidate.path, &candidate.edit.tree),
                };
            }
        }
        // the link behind it shares the side
        let shared = mended.iter().filter_map(|(number, equation)| {
            let next = formulas.get(number + 1).filter(|next| next.continues)?;
            Some((number + 1, equation.right.clone(), next.equation.clone()))
        });
        for (next, left, equation) in shared.collect::<Vec<_>>() {
            match mended.iter_mut().find(|(number, _)| *number == next) {
                Some((_, equation)) => equation.left = left,
                None => mended.push((next, Equation { left, ..equation })),
            }
        }
        mended
    }

    /// The repair that is told of what is mended: the formulas that are edited, without the links that share a side with them.
    pub fn repair(self, formulas: &[Formula], mended: Vec<(usize, Equation)>) -> Repair {
        let edited: HashSet<usize> = self.edits.iter().map(|candidate| candidate.formula).collect();
        let part = |number: usize| formulas.get(number).map_or(Part::Stated(0), |formula| formula.part);
        let edits = self.edits.into_iter().map(|candidate| Edit {
            part: part(candidate.formula),
            path: candidate.path,
            tree: candidate.edit.tree,
            words: candidate.edit.words,
        });
        Repair {
            edits: edits.collect(),
            formulas: Vec::new(),
            mended: mended
                .into_iter()
                .filter(|(number, _)| edited.contains(number))
                .map(|(number, equation)| (part(number), equation))
                .collect(),
            size: self.cost,
        }
    }
}

/// All that bears on the repair of a claim.
pub struct Search<'a> {
    sheet: &'a Sheet,
    position: usize,
    pub formulas: Vec<Formula>,
    context: Context,
    candidates: Vec<Candidate>,
    /// Edits that put in a term.
    additions: Vec<Candidate>,
    effort: u64,
    bench: Option<Bench>,
}

/// The claim at points.
struct Bench {
    leaves: Leaves,
    /// What names mean beside those that the formulas define, and with these.
    locals: HashMap<Name, Tree>,
    definitions: HashMap<Name, Tree>,
    graph: Graph,
    /// The equations that fail.
    failing: Vec<usize>,
    /// The leaves at points where the premises need not hold.
    free: Option<Leaves>,
    valued: Vec<Valued>,
}

impl<'a> Search<'a> {
    /// Nothing where the claim cannot be read.
    pub fn new(sheet: &'a Sheet, position: usize, effort: u64) -> Option<Self> {
        let entry = sheet.entries.get(position)?;
        let statements = Statements::gather(sheet, position).ok()?;
        let given = entry.gives();
        let defines = |equation: &Equation| match &equation.left {
            Tree::Symbol(name, _) if equation.relation == Relation::Equal && given.contains(name) => Some(name.clone()),
            _ => None,
        };
        let continues = |n: usize, own: &Equation| {
            let before = n.checked_sub(1).and_then(|n| entry.equations.get(n));
            before.is_some_and(|before| before.right == own.left && own.at.0 < before.end.0)
        };
        let stated = entry.equations.iter().enumerate().map(|(n, equation)| Formula {
            part: Part::Stated(n),
            equation: equation.clone(),
            name: defines(equation),
            continues: continues(n, equation),
        });
        let local = entry.local.iter().enumerate().map(|(n, (equation, _))| Formula {
            part: Part::Definition(n),
            equation: equation.clone(),
            name: defines(equation),
            continues: false,
        });
        let local = local.filter(|formula| formula.name.is_some());
        let formulas: Vec<Formula> = stated.chain(local).collect();
        let context = Context::new(sheet, position);
        let mut candidates = candidates(&formulas, &context);
        candidates.sort_by_key(|candidate| candidate.edit.cost);
        // what other maps are is looked at too
        let mut statements = statements;
        if statements.speaks_of_maps {
            statements.maps.extend(context.maps.iter().cloned());
        }
        let additions = additions(&formulas, &context);
        let bench = Bench::new(
            &statements,
            &sheet.symbols,
            &formulas,
            &context,
            &candidates,
            &additions,
        );
        Some(Self {
            sheet,
            position,
            formulas,
            context,
            candidates,
            additions,
            effort,
            bench,
        })
    }

    /// How many edited claims may be proved: so many, or of claims with operations as many as their size allows.
    pub fn most_proofs(&self, most: u64, squares: u64) -> u64 {
        let nodes: u64 = self.formulas.iter().map(|formula| u64::from(formula.size())).sum();
        match self.formulas.iter().any(Formula::has_operation) {
            true => (squares / (nodes * nodes).max(1)).clamp(2, most),
            false => most,
        }
    }

    /// The number of single edits that are looked at.
    pub fn edits(&self) -> usize {
        let all = self.candidates.len() + self.additions.len();
        match self.bench {
            Some(_) => all,
            None => all.min(self.trials()),
        }
    }

    /// The kinds that are looked for: edits that are tried each by itself stay single.
    pub fn stages(&self) -> &'static [Stage] {
        match self.bench {
            Some(_) => &STAGES,
            None => &[Stage::Single],
        }
    }

    /// How many edited claims are evaluated each by itself.
    fn trials(&self) -> usize {
        let nodes: u64 = self.formulas.iter().map(|formula| u64::from(formula.size())).sum();
        (MOST_TRIALS.min(MOST_TRIED_NODES / nodes.max(1)) * self.effort) as usize
    }

    /// What edits of this kind make true at the points, the smallest first.
    pub fn found(&self, stage: Stage) -> Vec<Found> {
        let found = match (&self.bench, stage) {
            (Some(bench), Stage::Single) => bench.single(&self.context, &self.additions),
            (Some(bench), Stage::Joined) => {
                let mut found = bench.missing(&self.context, true, &mut Overlay::default());
                found.retain(|found| !found.edits.iter().any(|candidate| self.puts_in_a_side(candidate)));
                found
            }
            (Some(bench), Stage::Several(edits)) => {
                let at = (&bench.graph, &bench.leaves);
                let found = combine::combined(at, &bench.valued, &bench.failing, edits, self.effort);
                found.into_iter().map(Found::new).collect()
            }
            (None, Stage::Single) => self.tried(),
            (None, Stage::Joined | Stage::Several(_)) => Vec::new(),
        };
        self.distinct(self.ranked(found))
    }

    /// The smallest first; of equal ones, what agrees with the sheet.
    fn ranked(&self, mut found: Vec<Found>) -> Vec<Found> {
        for found in &mut found {
            let mended = found.mended(&self.formulas);
            for candidate in &found.edits {
                let equation = mended.iter().find(|(number, _)| *number == candidate.formula);
                let term = equation.and_then(|(_, equation)| term_around(equation, &candidate.path));
                match term {
                    _ if candidate.edit.relation.is_some() => {}
                    // each name stands elsewhere
                    Some(Tree::Symbol(..)) if candidate.path.as_slice() == [0] && !self.is_of_subject(candidate) => {
                        found.cost += OF_SUBJECT;
                    }
                    _ if self.puts_in_a_side(candidate) => found.cost += OF_SUBJECT,
                    _ if self.makes_sum(candidate) => found.cost += OF_SUM,
                    _ if self.balances_a_power(candidate) => found.cost += OF_POWER,
                    // of its sign nothing is said elsewhere
                    Some(term) if self.is_printed(candidate, &term) => {}
                    Some(term) if self.context.said.contains(&term) => {
                        found.cost = found.cost.saturating_sub(AGREEMENT);
                    }
                    _ => {}
                }
            }
        }
        let length = |equation: &Equation| size(&equation.left) + size(&equation.right);
        let growth = |mended: &[(usize, Equation)]| {
            let each = mended.iter().map(|(number, equation)| {
                let before = self
                    .formulas
                    .get(*number)
                    .map_or(0, |formula| length(&formula.equation));
                length(equation).cast_signed() - before.cast_signed()
            });
            each.sum::<i32>().clamp(-MOST_GROWTH, MOST_GROWTH)
        };
        let key = |found: &Found| {
            let left = found
                .edits
                .iter()
                .filter(|candidate| candidate.path.first() == Some(&0));
            let mended = found.mended(&self.formulas);
            let agreement: u32 = mended
                .iter()
                .map(|(_, equation)| self.context.agreement(&equation.left) + self.context.agreement(&equation.right))
                .sum();
            let cost = found.cost.cast_signed() + growth(&mended);
            (cost, left.count(), std::cmp::Reverse(agreement))
        };
        found.sort_by_cached_key(key);
        found
    }

    /// Returns true if an edit takes the power from the quantity that the formula is about.
    fn is_of_subject(&self, candidate: &Candidate) -> bool {
        let printed = self.formulas.get(candidate.formula);
        printed.is_some_and(
            |printed| matches!(&printed.equation.left, Tree::Power(base, ..) if **base == candidate.edit.tree),
        )
    }

    /// Returns true if an edit puts in what stands on a whole side: so any sides are balanced.
    fn puts_in_a_side(&self, candidate: &Candidate) -> bool {
        let Some(printed) = self.formulas.get(candidate.formula).map(|formula| &formula.equation) else {
            return false;
        };
        let before = node(printed, &candidate.path);
        [&printed.left, &printed.right].into_iter().any(|side| {
            let own = before.as_ref().map_or(0, |before| count(before, side));
            !matches!(side, Tree::Number(_)) && count(&candidate.edit.tree, side) > own
        })
    }

    /// Returns true if an edit makes a sum of a side, or of a part of a term, that is none, no number, and begins with no minus.
    fn makes_sum(&self, candidate: &Candidate) -> bool {
        let printed = self.formulas.get(candidate.formula);
        let part = printed.and_then(|printed| node(&printed.equation, &candidate.path));
        matches!(candidate.edit.tree, Tree::Sum(_))
            && !matches!(part, Some(Tree::Sum(_) | Tree::Negate(_) | Tree::Number(_)))
    }

    /// Whether an edit of one side puts in the base of a power that is the other side, or squares the side: it balances an
    /// exponent that is one too many there.
    fn balances_a_power(&self, candidate: &Candidate) -> bool {
        let Some(Formula { equation, .. }) = self.formulas.get(candidate.formula) else {
            return false;
        };
        let Some(Tree::Power(base, ..)) = (match candidate.path.first() {
            Some(0) => Some(&equation.right),
            Some(1) => Some(&equation.left),
            _ => None,
        }) else {
            return false;
        };
        let before = node(equation, &candidate.path);
        let is_squared = candidate.path.len() == 1 && matches!(candidate.edit.tree, Tree::Power(..));
        is_squared || count(&candidate.edit.tree, base) > before.map_or(0, |before| count(&before, base))
    }

    /// Whether this stands in the printed formula, but for a sign, where an edit is made.
    fn is_printed(&self, candidate: &Candidate, term: &Tree) -> bool {
        let printed = self.formulas.get(candidate.formula);
        printed
            .and_then(|printed| term_around(&printed.equation, &candidate.path))
            .as_ref()
            == Some(term)
    }

    /// Those that are no other spelling of one before, do not hold without the premises, and hold at all points.
    fn distinct(&self, found: Vec<Found>) -> Vec<Found> {
        let Some(bench) = &self.bench else {
            return found;
        };
        let mut known: Vec<Vec<Vec<Number>>> = Vec::new();
        let mut kept = Vec::new();
        for found in found {
            if !goes_on() {
                break;
            }
            let mended = found.mended(&self.formulas);
            let (equations, definitions) = with(&self.formulas, &mended, &bench.locals);
            let gaps = |leaves: &Leaves, definitions: &HashMap<Name, Tree>| -> Vec<Vec<[SizedValue; 2]>> {
                let each = equations.iter();
                each.map(|equation| {
                    let sides = [&equation.left, &equation.right].map(|side| leaves.sized(side, definitions));
                    sides[0]
                        .iter()
                        .zip(&sides[1])
                        .map(|(left, right)| [left.clone(), right.clone()])
                        .collect()
                })
                .collect()
            };
            let own = gaps(&bench.leaves, &definitions);
            let is_met = |gaps: &[[SizedValue; 2]], point: usize| {
                let sides = gaps.get(point);
                sides.is_some_and(|[left, right]| agree(left, right))
            };
            let holds = |point: usize| own.iter().all(|gaps| is_met(gaps, point));
            if !bench.leaves.everywhere(holds) {
                continue;
            }
            let is_literal =
                |equation: &Equation| [&equation.left, &equation.right].map(|side| *side == edit::number(0));
            let is_nothing = |(gaps, equation): (&Vec<[SizedValue; 2]>, &Equation)| {
                gaps.iter().flatten().all(|side| side.value.size() < NOTHING) && !is_literal(equation).contains(&true)
            };
            // a factor that is 0 makes everything true
            if found.may_balance() && own.iter().zip(&equations).any(is_nothing) {
                continue;
            }
            let Some(free) = &bench.free else {
                kept.push(found);
                continue;
            };
            let gaps = gaps(free, &with(&self.formulas, &mended, &HashMap::new()).1);
            let is_identity = |gaps: &[[SizedValue; 2]]| gaps.iter().all(|[left, right]| agree(left, right));
            let changed = |n: usize| {
                let mut sides = bench.failing.iter().filter_map(|side| bench.graph.sides.get(*side));
                sides.any(|(formula, _)| {
                    let number = equation_number(&self.formulas, n);
                    number == Some(*formula)
                })
            };
            let is_slip = !found.may_balance() && self.speaks_of_the_same(&mended);
            let is_independent = |(n, gaps): (usize, &Vec<[SizedValue; 2]>)| changed(n) && is_identity(gaps);
            if !is_slip && gaps.iter().enumerate().any(is_independent) {
                continue;
            }
            let difference =
                |[left, right]: &[SizedValue; 2]| left.value.clone().plus(right.value.clone().negated()).told();
            let differences: Vec<Vec<Number>> = gaps.iter().map(|gaps| gaps.iter().map(difference).collect()).collect();
            if known.iter().any(|other| proportional(other, &differences)) {
                continue;
            }
            known.push(differences);
            kept.push(found);
        }
        kept
    }

    /// Whether the same names stand in the formulas as they should be as in the printed ones.
    fn speaks_of_the_same(&self, mended: &[(usize, Equation)]) -> bool {
        mended.iter().all(|(number, equation)| {
            let printed = self.formulas.get(*number);
            printed.is_some_and(|printed| names_in(&printed.equation) == names_in(equation))
        })
    }

    /// The edits after which the evidence speaks for the claim, each tried by itself.
    fn tried(&self) -> Vec<Found> {
        let mut copy = self.sheet.clone();
        let mut budget = MOST_OPERATIONS * self.effort;
        let mut found = Vec::new();
        let mut all: Vec<&Candidate> = self.candidates.iter().chain(&self.additions).collect();
        all.sort_by_key(|candidate| candidate.edit.cost);
        for candidate in all.into_iter().take(self.trials()) {
            let one = Found::new(vec![candidate.clone()]);
            put(
                &mut copy,
                self.sheet,
                self.position,
                &self.formulas,
                &one.mended(&self.formulas),
            );
            let is_read = copy
                .entries
                .get(self.position)
                .is_some_and(|entry| entry.unread.is_none());
            if !is_read {
                continue;
            }
            if budget == 0 || !goes_on() {
                break;
            }
            let Ok(evidence) = trial(&copy, self.position, TRIAL_POINTS, &mut budget) else {
                continue;
            };
            if evidence.points > 0 && evidence.against.is_none() {
                found.push(one);
            }
        }
        found
    }
}

/// How often a part stands in a tree.
fn count(tree: &Tree, part: &Tree) -> usize {
    let mut count = 0;
    walk(tree, None, &mut Vec::new(), &mut |node, _, _| {
        count += usize::from(node == part)
    });
    count
}

/// The names in an equation.
pub fn names_in(equation: &Equation) -> HashSet<Name> {
    let mut names = HashSet::new();
    for side in [&equation.left, &equation.right] {
        walk(side, None, &mut Vec::new(), &mut |node, _, _| match node {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => {
                names.insert(name.clone());
            }
            _ => {}
        });
    }
    names
}

/// The equations that are to hold, and what names mean, with new formulas in the place of some.
pub fn with(
    formulas: &[Formula],
    mended: &[(usize, Equation)],
    locals: &HashMap<Name, Tree>,
) -> (Vec<Equation>, HashMap<Name, Tree>) {
    let (mut equations, mut definitions) = (Vec::new(), locals.clone());
    for (number, formula) in formulas.iter().enumerate() {
        let new = mended.iter().find(|(other, _)| *other == number);
        let equation = new.map_or(&formula.equation, |(_, equation)| equation);
        match &formula.name {
            Some(name) => {
                definitions.insert(name.clone(), equation.right.clone());
            }
            None => equations.push(equation.clone()),
        }
    }
    (equations, definitions)
}

/// The number among all formulas of the n-th that is to hold.
fn equation_number(formulas: &[Formula], n: usize) -> Option<usize> {
    let mut stated = formulas
        .iter()
        .enumerate()
        .filter(|(_, formula)| formula.name.is_none());
    stated.nth(n).map(|(number, _)| number)
}

/// Whether two lists of differences are the same but for a factor each.
fn proportional(one: &[Vec<Number>], other: &[Vec<Number>]) -> bool {
    let is_multiple = |(one, other): (&Vec<Number>, &Vec<Number>)| {
        let ratios: Vec<Number> = one.iter().zip(other).map(|(a, b)| a / b).collect();
        let vanish = |list: &[Number]| list.iter().all(|value| value.norm() < NOTHING);
        (vanish(one) && vanish(other))
            || ratios
                .first()
                .is_some_and(|first| ratios.iter().all(|ratio| (ratio - first).norm() <= 1e-6 * first.norm()))
    };
    one.len() == other.len() && one.iter().zip(other).all(is_multiple)
}

/// The term of a sum, or the side, that a node stands in.
fn term_around(equation: &Equation, path: &[usize]) -> Option<Tree> {
    let mut length = path.len();
    while length > 1 && !matches!(node(equation, path.get(..length - 1)?), Some(Tree::Sum(_))) {
        length -= 1;
    }
    let term = node(equation, path.get(..length)?)?;
    Some(match term {
        Tree::Negate(body) => *body,
        other => other,
    })
}

/// Every edit of every node.
fn candidates(formulas: &[Formula], context: &Context) -> Vec<Candidate> {
    let mut found = Vec::new();
    let mut numbers = [2, 3, 4].map(edit::number).to_vec();
    numbers.push(edit::pi());
    // elsewhere what lacks is looked up by its value
    let has_operation = formulas.iter().any(Formula::has_operation);
    let is_bar =
        |node: &Tree| matches!(node, Tree::Root(..)) || matches!(node, Tree::Call(name, ..) if name.base == r"\abs");
    let has_bars = formulas
        .iter()
        .any(|formula| any_side(&formula.equation, &mut |node| is_bar(node)));
    let mut factors: Vec<Tree> = context.atoms.iter().chain(&numbers).cloned().collect();
    if has_operation {
        // a chain rule forgotten leaves both out
        let multiples = |atom| numbers.iter().map(move |number| times(atom, number));
        factors.extend(context.atoms.iter().flat_map(multiples));
        // the mean over a period
        let turn = edit::product(vec![edit::number(2), edit::pi()]);
        factors.extend(
            context
                .atoms
                .iter()
                .map(|atom| edit::quotient(atom.clone(), turn.clone())),
        );
    }
    for (number, formula) in formulas.iter().enumerate() {
        found.extend(edit::relations(&formula.equation).into_iter().map(|edit| Candidate {
            formula: number,
            path: Vec::new(),
            edit,
        }));
        for (side, tree) in formula.sides() {
            walk(tree, None, &mut Vec::new(), &mut |node, above, path| {
                let path: Path = std::iter::once(side).chain(path.iter().copied()).collect();
                let digits = if has_operation {
                    edit::other_digits(node)
                } else {
                    Vec::new()
                };
                let bars = if has_bars { edit::within_bars(node) } else { None };
                for edit in edits(node, above, context).into_iter().chain(digits).chain(bars) {
                    found.push(Candidate {
                        formula: number,
                        path: path.clone(),
                        edit,
                    });
                }
                if !takes_factors(node, above) {
                    return;
                }
                for factor in &factors {
                    for is_above in [true, false] {
                        found.push(Candidate {
                            formula: number,
                            path: path.clone(),
                            edit: missing_factor(factor, node, is_above),
                        });
                    }
                }
            });
        }
    }
    found
}

/// Whether a factor that is missing is put in here, and not in what stands around it.
fn takes_factors(node: &Tree, above: Option<&Tree>) -> bool {
    let is_within = match above {
        Some(Tree::Product(_) | Tree::Negate(_) | Tree::PlusMinus(_) | Tree::MinusPlus(_)) => true,
        Some(Tree::Quotient(upper, ..)) => **upper == *node,
        _ => false,
    };
    !is_within && !matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_))
}

/// Whether a term that is missing is put in here, and not in what stands around it.
fn takes_terms(node: &Tree, above: Option<&Tree>) -> bool {
    match above {
        None if *node == edit::number(0) => false,
        Some(Tree::Sum(_)) => false,
        Some(Tree::Negate(_)) => matches!(node, Tree::Sum(_)),
        _ => true,
    }
}

/// Every edit that puts in 1, a name, or the square of one as a term; within an elementary function also pi, half of it, or a
/// product of two names.
fn additions(formulas: &[Formula], context: &Context) -> Vec<Candidate> {
    let square = |atom: &Tree| Tree::Power(Box::new(atom.clone()), 2, At::default());
    let mut terms = vec![edit::number(1)];
    terms.extend(context.atoms.iter().cloned());
    terms.extend(context.atoms.iter().map(square));
    let pi = edit::pi();
    let mut products = vec![edit::quotient(pi.clone(), edit::number(2)), pi];
    for (n, one) in context.atoms.iter().enumerate() {
        let others = context.atoms.iter().skip(n + 1);
        products.extend(others.map(|other| edit::product(vec![one.clone(), other.clone()])));
    }
    let mut found = Vec::new();
    for (number, formula) in formulas.iter().enumerate() {
        for (side, tree) in formula.sides() {
            walk(tree, None, &mut Vec::new(), &mut |node, above, path| {
                if !takes_terms(node, above) || matches!(node, Tree::Operation(..)) {
                    return;
                }
                // of what is within an elementary function nothing is looked up by its value
                let is_argument = matches!(above, Some(Tree::Call(name, ..)) if name.base.starts_with('\\'));
                let terms = terms.iter().chain(if is_argument { products.as_slice() } else { &[] });
                for (term, negative) in terms.flat_map(|term| [(term, false), (term, true)]) {
                    found.push(Candidate {
                        formula: number,
                        path: std::iter::once(side).chain(path.iter().copied()).collect(),
                        edit: missing_term(term, negative, node),
                    });
                }
            });
        }
    }
    found
}

impl Bench {
    /// The claim at points; nothing where it is no set of equations between values there.
    fn new(
        statements: &Statements,
        symbols: &Symbols,
        formulas: &[Formula],
        context: &Context,
        candidates: &[Candidate],
        additions: &[Candidate],
    ) -> Option<Self> {
        let is_equation = |formula: &Formula| formula.equation.relation == Relation::Equal;
        if !formulas.iter().all(is_equation) {
            return None;
        }
        let locals = statements.locals.iter();
        let locals: HashMap<Name, Tree> = locals.map(|local| (local.name.clone(), local.tree.clone())).collect();
        let (equations, definitions) = with(formulas, &[], &locals);
        let mut trees: Vec<&Tree> = definitions.values().collect();
        let sides = formulas
            .iter()
            .flat_map(|formula| [&formula.equation.left, &formula.equation.right]);
        trees.extend(sides);
        trees.extend(candidates.iter().chain(additions).map(|candidate| &candidate.edit.tree));
        trees.extend(context.atoms.iter().chain(&context.terms).chain(&context.near));
        // what stands within a leaf makes another leaf
        let within: Vec<Tree> = candidates
            .iter()
            .chain(additions)
            .filter_map(|candidate| {
                let formula = formulas.get(candidate.formula)?;
                leaf_around(&formula.equation, &candidate.path, &candidate.edit.tree)
            })
            .collect();
        trees.extend(&within);
        let asked = points::Asked {
            statements,
            symbols,
            equations: &equations,
            definitions: &definitions,
        };
        let (leaves, free) = asked.drawn(&trees, POINTS, FREE_POINTS)?;
        let graph = Graph::new(formulas, &leaves, &definitions);
        let overlay = Overlay::default();
        let failing = graph.sides.iter().enumerate();
        let failing =
            failing.filter(|(_, (_, sides))| !leaves.everywhere(|point| graph.holds(*sides, point, &overlay)));
        let failing = failing.map(|(n, _)| n).collect();
        let mut bench = Self {
            failing,
            leaves,
            locals,
            definitions,
            graph,
            free,
            valued: Vec::new(),
        };
        bench.valued = candidates
            .iter()
            .filter_map(|candidate| bench.valued(candidate))
            .collect();
        Some(bench)
    }

    fn valued(&self, candidate: &Candidate) -> Option<Valued> {
        let (node, rest) = self.graph.nearest(candidate.formula, &candidate.path)?;
        let whole = self.graph.nodes.get(node)?;
        let tree = super::path::with(&whole.tree, &rest, &candidate.edit.tree);
        let values = self.leaves.all(&tree, &self.definitions);
        values.iter().all(Value::is_finite).then(|| Valued {
            candidate: candidate.clone(),
            node,
            values,
        })
    }

    /// The single edits after which all equations hold.
    fn single(&self, context: &Context, additions: &[Candidate]) -> Vec<Found> {
        if self.failing.is_empty() {
            return Vec::new();
        }
        let mut overlay = Overlay::default();
        let mut found: Vec<Found> = Vec::new();
        for valued in &self.valued {
            if self
                .graph
                .all_hold(&[(valued.node, &valued.values)], &self.leaves, &mut overlay)
            {
                found.push(Found::new(vec![valued.candidate.clone()]));
            }
        }
        let matrices = matrices::inserted(&self.graph, context, &self.leaves, &self.definitions);
        for candidate in additions.iter().chain(&matrices) {
            if self.holds_with(candidate, &mut overlay) {
                found.push(Found::new(vec![candidate.clone()]));
            }
        }
        found.extend(self.missing(context, false, &mut overlay));
        found
    }

    /// Whether all equations hold after an edit, which is worked out at one point after the other.
    fn holds_with(&self, candidate: &Candidate, overlay: &mut Overlay) -> bool {
        let Some((node, rest)) = self.graph.nearest(candidate.formula, &candidate.path) else {
            return false;
        };
        let Some(whole) = self.graph.nodes.get(node) else {
            return false;
        };
        let tree = super::path::with(&whole.tree, &rest, &candidate.edit.tree);
        self.leaves.everywhere(|point| {
            let value = self.leaves.value(&tree, point, &self.definitions);
            self.graph.change(point, &[(node, &value)], overlay);
            let mut sides = self.graph.sides.iter();
            sides.all(|(_, sides)| self.graph.holds(*sides, point, overlay))
        })
    }

    /// What a node must be at each place for an equation to hold, and the opposite where that will do too, as beneath an
    /// even power.
    fn wanted(&self, node: usize, sides: [usize; 2], overlay: &mut Overlay) -> Option<Wanted> {
        let own = |point: usize| self.graph.value(node, point);
        let mut at = |point: usize| -> Vec<(usize, Number)> {
            let Some(required) = self.graph.required(node, sides, point, overlay) else {
                return Vec::new();
            };
            let opposite = match own(point) {
                Value::Number(_) => Value::Number(-required),
                own @ Value::Matrix(_) => own.times(Value::Number(-required)),
            };
            self.graph.change(point, &[(node, &opposite)], overlay);
            match self.graph.holds(sides, point, overlay) {
                true => vec![(point, required), (point, -required)],
                false => vec![(point, required)],
            }
        };
        let places = match self.leaves.is_either {
            false => (0..self.leaves.points).map(at).collect::<Vec<_>>(),
            true => (0..self.leaves.points / 2)
                .map(|place| [at(2 * place), at(2 * place + 1)].concat())
                .collect(),
        };
        let is_whole = !places.is_empty() && places.iter().all(|place| !place.is_empty());
        is_whole.then_some(Wanted { places })
    }

    /// What a node must be multiplied by, or what must be added to it, looked up among what stands in the sheet; where
    /// `joined`, among the products and sums of two of these.
    fn missing(&self, context: &Context, joined: bool, overlay: &mut Overlay) -> Vec<Found> {
        let failing = self.failing.first().and_then(|failing| self.graph.sides.get(*failing));
        let Some((_, sides)) = failing else {
            return Vec::new();
        };
        let dictionaries = Dictionaries::new(context, &self.leaves, &self.definitions);
        let mut found = Vec::new();
        for (number, node) in self.graph.nodes.iter().enumerate() {
            let takes = takes_factors(&node.tree, node.within.as_ref());
            let is_number = matches!(node.tree, Tree::Number(_));
            let is_matrix = node.values.iter().any(|value| value.number().is_none());
            let takes_terms = !is_matrix && takes_terms(&node.tree, node.within.as_ref());
            if !takes && !is_number && !takes_terms {
                continue;
            }
            let Some(wanted) = self.wanted(number, *sides, overlay) else {
                continue;
            };
            let own = |point: usize| match node.values.get(point) {
                Some(Value::Number(own)) => *own,
                _ => Number::new(1.0, 0.0),
            };
            let mut add = |edit: edit::Edit| {
                found.push(Found::new(vec![Candidate {
                    formula: node.place.0,
                    path: node.place.1.clone(),
                    edit,
                }]));
            };
            let other_number = number_of(&wanted).filter(|_| is_number);
            let is_replaced = other_number.is_some();
            if let Some(tree) = other_number.filter(|_| !joined) {
                let is_whole = |tree: &Tree| matches!(tree, Tree::Number(value) if value.0.denominator().is_one());
                let cost = if is_whole(&tree) || !is_whole(&node.tree) {
                    11
                } else {
                    11 + OF_FRACTION
                };
                add(edit::Edit {
                    words: format!("`{}` in the place of `{tree}`", node.tree),
                    tree,
                    cost,
                    adds: false,
                    relation: None,
                });
            }
            if is_replaced {
                continue;
            }
            let factors = [
                (wanted.map(|at, wanted| wanted / own(at)), true),
                (wanted.map(|at, wanted| own(at) / wanted), false),
            ];
            for (list, is_above) in factors.into_iter().filter(|_| takes) {
                let found = dictionaries.factor(&list, joined);
                // in the place of 1 a sum is a term that is missing beside it
                let is_one = node.tree == edit::number(1);
                let found = found
                    .iter()
                    .filter(|(factor, _)| !(is_one && matches!(factor, Tree::Sum(_))));
                for (factor, negative) in found.take(MOST_OF_DICTIONARY) {
                    let mut edit = missing_factor(factor, &node.tree, is_above);
                    if is_matrix && is_above {
                        edit.tree = times(factor, &node.tree);
                    }
                    if *negative {
                        edit.tree = edit::negated(&edit.tree);
                        edit.cost += OF_SIGN;
                        edit.words = format!("{}, and the sign is wrong", edit.words);
                    }
                    add(edit);
                }
            }
            if !takes_terms {
                continue;
            }
            let terms = dictionaries.term(&wanted.map(|at, wanted| wanted - own(at)), joined);
            for (term, negative) in terms.iter().take(MOST_OF_DICTIONARY) {
                add(missing_term(term, *negative, &node.tree));
            }
            // a power without its exponent
            let is_power = matches!(node.within, Some(Tree::Power(..) | Tree::RealPower(..)));
            if !is_power && matches!(&node.tree, Tree::Symbol(name, _) if name.to_string() == "e") {
                let exponents = dictionaries.term(&wanted.map(|_, wanted| wanted.ln()), joined);
                for (exponent, negative) in exponents.iter().take(MOST_OF_DICTIONARY) {
                    add(edit::missing_exponent(exponent, *negative, &node.tree));
                }
            }
        }
        found
    }
}

/// A node that is evaluated as a whole, with a part of it edited.
fn leaf_around(equation: &Equation, path: &[usize], new: &Tree) -> Option<Tree> {
    let is_leaf = |tree: &Tree| matches!(tree, Tree::Call(..) | Tree::Partial { .. } | Tree::Invariant { .. });
    let length = (1..path.len()).find(|length| {
        let inner = path.get(..*length).and_then(|path| node(equation, path));
        inner.is_some_and(|tree| is_leaf(&tree))
    })?;
    let whole = node(equation, path.get(..length)?)?;
    Some(super::path::with(&whole, path.get(length..)?, new))
}
