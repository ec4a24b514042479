//! Edits of a claim after which its sides agree at points where the premises hold.

use super::combine;
use super::context::Context;
use super::dictionary::{Dictionary, number_of};
use super::edit::{self, edits, negated, over, plus, times};
use super::path::{Path, node, replaced, size, walk};
use super::values::{Graph, Leaves, Overlay, Sized, agree, take_leaves};
use super::{Edit, Part, Repair, put};
use crate::claim::{Sheet, Statements, Verdict, Vocabulary, any_side, reduced};
use crate::evidence::{samples, witness};
use crate::tex::{Equation, Name, Relation, Tree};
use std::collections::{HashMap, HashSet};

/// The most edits of a repair.
pub const MOST_EDITS: usize = 3;
/// Points at which the sides are compared, and those without premises at which formulas are told apart.
const POINTS: usize = 6;
const FREE_POINTS: usize = 4;
/// Edited claims that are evaluated each by itself, for each unit of effort, and points for each.
const MOST_TRIALS: u64 = 1_500;
const TRIAL_POINTS: usize = 3;
/// The most formulas that are put in the place of one node by their values.
const MOST_OF_DICTIONARY: usize = 3;
/// By how much an edit counts as smaller where its term stands elsewhere in the sheet.
const AGREEMENT: u32 = 3;

/// By how much an edit counts as larger that puts a fraction in the place of a whole number, or another quantity in the place
/// of the one that the formula is about.
const OF_FRACTION: u32 = 4;
const OF_SUBJECT: u32 = 4;

/// By how much an edit counts as larger or smaller where the formula grows or shrinks by it.
const MOST_GROWTH: i32 = 2;

/// A formula of the claim that may be wrong.
#[derive(Clone, Debug)]
pub struct Formula {
    pub part: Part,
    pub equation: Equation,
    /// The name that it defines.
    pub name: Option<Name>,
}

impl Formula {
    /// Whether a sum, an integral, a derivative or the like stands in it.
    fn has_operation(&self) -> bool {
        any_side(&self.equation, &mut |node| matches!(node, Tree::Operation(..)))
    }
}

/// An edit of a place.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub formula: usize,
    pub path: Path,
    pub edit: edit::Edit,
}

/// An edit with what it makes of a node of the graph.
#[derive(Clone, Debug)]
pub struct Valued {
    pub candidate: Candidate,
    pub node: usize,
    pub values: Vec<f64>,
}

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
                *equation = replaced(equation, &candidate.path, &candidate.edit.tree);
            }
        }
        mended
    }

    pub fn repair(self, formulas: &[Formula], mended: Vec<(usize, Equation)>) -> Repair {
        let part = |number: usize| formulas.get(number).map_or(Part::Stated(0), |formula| formula.part);
        let edits = self.edits.into_iter().map(|candidate| Edit {
            part: part(candidate.formula),
            path: candidate.path,
            tree: candidate.edit.tree,
            words: candidate.edit.words,
        });
        Repair {
            edits: edits.collect(),
            mended: mended
                .into_iter()
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
    effort: u64,
    bench: Option<Bench>,
}

/// The claim at points.
struct Bench {
    leaves: Leaves,
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
        let stated = entry.equations.iter().enumerate().map(|(n, equation)| Formula {
            part: Part::Stated(n),
            equation: equation.clone(),
            name: defines(equation),
        });
        let local = entry.local.iter().enumerate().map(|(n, (equation, _))| Formula {
            part: Part::Definition(n),
            equation: equation.clone(),
            name: defines(equation),
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
        let bench = Bench::new(&statements, &sheet.vocabulary, &formulas, &context, &candidates);
        Some(Self {
            sheet,
            position,
            formulas,
            context,
            candidates,
            effort,
            bench,
        })
    }

    /// What so many edits make true at the points, the smallest first.
    pub fn found(&self, edits: usize) -> Vec<Found> {
        let found = match (&self.bench, edits) {
            (Some(bench), 1) => bench.single(&self.context),
            (Some(bench), _) => combine::combined(&bench.graph, &bench.valued, &bench.failing, edits, self.effort)
                .into_iter()
                .map(Found::new)
                .collect(),
            (None, 1) => self.tried(),
            (None, _) => Vec::new(),
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
                    // each name stands elsewhere
                    Some(Tree::Symbol(..)) if candidate.path.as_slice() == [0] => found.cost += OF_SUBJECT,
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

    /// Those that are no other spelling of one before, do not hold without the premises, and hold at all points.
    fn distinct(&self, found: Vec<Found>) -> Vec<Found> {
        let Some(bench) = &self.bench else {
            return found;
        };
        let mut known: Vec<Vec<Vec<f64>>> = Vec::new();
        let mut kept = Vec::new();
        for found in found {
            let mended = found.mended(&self.formulas);
            let (equations, definitions) = with(&self.formulas, &mended);
            let gaps = |leaves: &Leaves| -> Vec<Vec<[Sized; 2]>> {
                let each = equations.iter();
                each.map(|equation| {
                    let sides = [&equation.left, &equation.right].map(|side| leaves.sized(side, &definitions));
                    sides[0]
                        .iter()
                        .zip(&sides[1])
                        .map(|(left, right)| [*left, *right])
                        .collect()
                })
                .collect()
            };
            let holds = |gaps: &[Vec<[Sized; 2]>]| gaps.iter().flatten().all(|[left, right]| agree(*left, *right));
            if !holds(&gaps(&bench.leaves)) {
                continue;
            }
            let is_literal =
                |equation: &Equation| [&equation.left, &equation.right].map(|side| *side == edit::number(0));
            let is_nothing = |(gaps, equation): (&Vec<[Sized; 2]>, &Equation)| {
                gaps.iter().flatten().all(|side| side.value == 0.0) && !is_literal(equation).contains(&true)
            };
            // a factor that is 0 makes everything true
            if found.may_balance() && gaps(&bench.leaves).iter().zip(&equations).any(is_nothing) {
                continue;
            }
            let Some(free) = &bench.free else {
                kept.push(found);
                continue;
            };
            let gaps = gaps(free);
            let is_identity = |gaps: &[[Sized; 2]]| gaps.iter().all(|[left, right]| agree(*left, *right));
            let changed = |n: usize| {
                let mut sides = bench.failing.iter().filter_map(|side| bench.graph.sides.get(*side));
                sides.any(|(formula, _)| {
                    let number = equation_number(&self.formulas, n);
                    number == Some(*formula)
                })
            };
            if gaps.iter().enumerate().any(|(n, gaps)| changed(n) && is_identity(gaps)) {
                continue;
            }
            let differences: Vec<Vec<f64>> = gaps
                .iter()
                .map(|gaps| gaps.iter().map(|[left, right]| left.value - right.value).collect())
                .collect();
            if known.iter().any(|other| proportional(other, &differences)) {
                continue;
            }
            known.push(differences);
            kept.push(found);
        }
        kept
    }

    /// The edits after which the evidence speaks for the claim, each tried by itself.
    fn tried(&self) -> Vec<Found> {
        let mut copy = self.sheet.clone();
        let mut found = Vec::new();
        for candidate in self.candidates.iter().take((MOST_TRIALS * self.effort) as usize) {
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
            let Ok(evidence) = witness(&copy, self.position, Verdict::Proved, TRIAL_POINTS) else {
                continue;
            };
            if evidence.points > 0 && evidence.against.is_none() {
                found.push(one);
            }
        }
        found
    }
}

/// The equations that are to hold, and the definitions, with new formulas in the place of some.
fn with(formulas: &[Formula], mended: &[(usize, Equation)]) -> (Vec<Equation>, HashMap<Name, Tree>) {
    let (mut equations, mut definitions) = (Vec::new(), HashMap::new());
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
fn proportional(one: &[Vec<f64>], other: &[Vec<f64>]) -> bool {
    let is_multiple = |(one, other): (&Vec<f64>, &Vec<f64>)| {
        let ratios: Vec<f64> = one.iter().zip(other).map(|(a, b)| a / b).collect();
        let vanish = |list: &[f64]| list.iter().all(|value| value.abs() < 1e-9);
        (vanish(one) && vanish(other))
            || ratios
                .first()
                .is_some_and(|first| ratios.iter().all(|ratio| (ratio - first).abs() <= 1e-6 * first.abs()))
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
    let numbers = [2, 3, 4].map(edit::number);
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
    }
    for (number, formula) in formulas.iter().enumerate() {
        for (side, tree) in [&formula.equation.left, &formula.equation.right]
            .into_iter()
            .enumerate()
        {
            if side == 0 && formula.name.is_some() {
                continue;
            }
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
                    for (tree, is_above) in [(times(node, factor), true), (over(node, factor), false)] {
                        let cost = 11 + size(factor) + u32::from(!is_above);
                        let (words, adds) = (missing_factor(factor, node, is_above), true);
                        found.push(Candidate {
                            formula: number,
                            path: path.clone(),
                            edit: edit::Edit {
                                tree,
                                cost,
                                words,
                                adds,
                            },
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

fn missing_factor(factor: &Tree, node: &Tree, is_above: bool) -> String {
    let below = if is_above { "" } else { " in the denominator" };
    format!("the factor `{factor}` is missing{below} in `{node}`")
}

impl Bench {
    /// The claim at points; nothing where it is no set of equations between values there.
    fn new(
        statements: &Statements,
        vocabulary: &Vocabulary,
        formulas: &[Formula],
        context: &Context,
        candidates: &[Candidate],
    ) -> Option<Self> {
        let is_plain = |formula: &Formula| {
            let has_signs = |node: &Tree| matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_));
            formula.equation.relation == Relation::Equal && !any_side(&formula.equation, &mut |node| has_signs(node))
        };
        // a sum, an integral, a derivative has a value as a whole
        let is_reduced = || matches!(reduced(statements, vocabulary), Ok(None));
        if !formulas.iter().all(is_plain) || !(formulas.iter().any(Formula::has_operation) || is_reduced()) {
            return None;
        }
        let defined: HashSet<Name> = formulas.iter().filter_map(|formula| formula.name.clone()).collect();
        let mut trees = Vec::new();
        let sides = formulas
            .iter()
            .flat_map(|formula| [&formula.equation.left, &formula.equation.right]);
        let edited = candidates.iter().map(|candidate| &candidate.edit.tree);
        for tree in sides.chain(edited).chain(&context.atoms).chain(&context.terms) {
            take_leaves(tree, &defined, &mut trees);
        }
        // what stands within a leaf makes another leaf
        for candidate in candidates {
            let Some(formula) = formulas.get(candidate.formula) else {
                continue;
            };
            if let Some(leaf) = leaf_around(&formula.equation, &candidate.path, &candidate.edit.tree) {
                take_leaves(&leaf, &defined, &mut trees);
            }
        }
        // in the order in which they stand: which points are drawn is the same in each run
        let mut met = HashSet::new();
        trees.retain(|tree| met.insert(tree.clone()));
        let stated = || formulas.iter().filter(|formula| formula.name.is_none());
        let sides: Vec<Tree> = stated()
            .flat_map(|formula| [formula.equation.left.clone(), formula.equation.right.clone()])
            .collect();
        let sample = |statements: &Statements, points: usize| {
            let values = samples(statements, vocabulary, &trees, &sides, points)?;
            let points = values.first().map_or(0, Vec::len);
            let values = trees.iter().cloned().zip(values).collect();
            Some(Leaves { values, points })
        };
        let mut leaves = sample(statements, POINTS)?;
        let (equations, definitions) = with(formulas, &[]);
        let is_defined = |point: &usize| {
            let mut sides = equations.iter().flat_map(|equation| [&equation.left, &equation.right]);
            sides.all(|side| leaves.value(side, *point, &definitions).is_finite())
        };
        let kept: Vec<usize> = (0..leaves.points).filter(is_defined).collect();
        for values in leaves.values.values_mut() {
            *values = kept.iter().filter_map(|point| values.get(*point).copied()).collect();
        }
        leaves.points = kept.len();
        if kept.is_empty() {
            return None;
        }
        let free = Statements {
            premises: Vec::new(),
            ..statements.clone()
        };
        let has_premises = !statements.premises.is_empty();
        let free = has_premises.then(|| sample(&free, FREE_POINTS)).flatten();
        let list: Vec<(Equation, Option<Name>)> = formulas
            .iter()
            .map(|formula| (formula.equation.clone(), formula.name.clone()))
            .collect();
        let graph = Graph::new(&list, &leaves);
        let overlay = Overlay::default();
        let holds = |sides: &[usize; 2]| (0..leaves.points).all(|point| graph.holds(*sides, point, &overlay));
        let failing = graph.sides.iter().enumerate().filter(|(_, (_, sides))| !holds(sides));
        let failing = failing.map(|(n, _)| n).collect();
        let mut bench = Self {
            failing,
            leaves,
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
        values.iter().all(|value| value.is_finite()).then(|| Valued {
            candidate: candidate.clone(),
            node,
            values,
        })
    }

    /// The single edits after which all equations hold.
    fn single(&self, context: &Context) -> Vec<Found> {
        if self.failing.is_empty() {
            return Vec::new();
        }
        let mut overlay = Overlay::default();
        let mut found: Vec<Found> = Vec::new();
        for valued in &self.valued {
            if self
                .graph
                .all_hold(&[(valued.node, &valued.values)], self.leaves.points, &mut overlay)
            {
                found.push(Found::new(vec![valued.candidate.clone()]));
            }
        }
        found.extend(self.missing(context, &mut overlay));
        found
    }

    /// What a node must be multiplied by, or what must be added to it, looked up among what stands in the sheet.
    fn missing(&self, context: &Context, overlay: &mut Overlay) -> Vec<Found> {
        let [failing] = self.failing.as_slice() else {
            return Vec::new();
        };
        let Some((_, sides)) = self.graph.sides.get(*failing) else {
            return Vec::new();
        };
        let factors = Dictionary::factors(context, &self.leaves, &self.definitions);
        let terms = Dictionary::terms(context, &self.leaves, &self.definitions);
        let mut found = Vec::new();
        for (number, node) in self.graph.nodes.iter().enumerate() {
            let takes = takes_factors(&node.tree, node.within.as_ref());
            let is_number = matches!(node.tree, Tree::Number(_));
            let takes_terms = match &node.within {
                Some(Tree::Sum(_)) => false,
                Some(Tree::Negate(_)) => matches!(node.tree, Tree::Sum(_)),
                _ => true,
            };
            if !takes && !is_number && !takes_terms {
                continue;
            }
            let points = 0..self.leaves.points;
            let required: Option<Vec<f64>> = points
                .map(|point| self.graph.required(number, *sides, point, overlay))
                .collect();
            let Some(required) = required else { continue };
            // beneath an even power the opposite will do too
            let opposite: Vec<f64> = required.iter().map(|value| -value).collect();
            let mut wanted = vec![required];
            if self.graph.all_hold(&[(number, &opposite)], self.leaves.points, overlay) {
                wanted.push(opposite);
            }
            let mut add = |tree: Tree, cost: u32, words: String, adds: bool| {
                found.push(Found::new(vec![Candidate {
                    formula: node.place.0,
                    path: node.place.1.clone(),
                    edit: edit::Edit {
                        tree,
                        cost,
                        words,
                        adds,
                    },
                }]));
            };
            if let Some(tree) = wanted.iter().find_map(|values| number_of(values)).filter(|_| is_number) {
                let is_whole = |tree: &Tree| matches!(tree, Tree::Number(value) if value.0.denominator().is_one());
                let cost = if is_whole(&tree) || !is_whole(&node.tree) {
                    11
                } else {
                    11 + OF_FRACTION
                };
                let words = format!("`{}` in the place of `{tree}`", node.tree);
                add(tree, cost, words, false);
            }
            let each = |of: fn(f64, f64) -> f64| -> Vec<Vec<f64>> {
                let mut all = Vec::new();
                for values in &wanted {
                    let pairs = values.iter().zip(&node.values);
                    all.push(pairs.map(|(wanted, own)| of(*wanted, *own)).collect());
                }
                all
            };
            for (list, is_above) in [
                (each(|wanted, own| wanted / own), true),
                (each(|wanted, own| own / wanted), false),
            ] {
                let found = if takes { factors.find(&list) } else { Vec::new() };
                for (factor, _) in found
                    .into_iter()
                    .filter(|(_, negative)| !negative)
                    .take(MOST_OF_DICTIONARY)
                {
                    let tree = if is_above {
                        times(&node.tree, factor)
                    } else {
                        over(&node.tree, factor)
                    };
                    let cost = 11 + size(factor) + u32::from(!is_above);
                    add(tree, cost, missing_factor(factor, &node.tree, is_above), true);
                }
            }
            if !takes_terms {
                continue;
            }
            for (term, negative) in terms
                .find(&each(|wanted, own| wanted - own))
                .into_iter()
                .take(MOST_OF_DICTIONARY)
            {
                let signed = if negative { negated(term) } else { term.clone() };
                let words = format!("the term `{term}` is missing in `{}`", node.tree);
                add(
                    plus(&node.tree, &signed),
                    12 + 2 * size(term) + u32::from(negative),
                    words,
                    true,
                );
            }
        }
        found
    }
}

/// A node that is evaluated as a whole, with a part of it edited.
fn leaf_around(equation: &Equation, path: &[usize], new: &Tree) -> Option<Tree> {
    let is_leaf = |tree: &Tree| {
        matches!(
            tree,
            Tree::Call(..) | Tree::Partial { .. } | Tree::Invariant { .. } | Tree::Operation(..)
        )
    };
    let length = (1..path.len()).find(|length| {
        let inner = path.get(..*length).and_then(|path| node(equation, path));
        inner.is_some_and(|tree| is_leaf(&tree))
    })?;
    let whole = node(equation, path.get(..length)?)?;
    Some(super::path::with(&whole, path.get(length..)?, new))
}
