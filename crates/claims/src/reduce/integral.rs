//! Integrals: indefinite ones by differentiation, definite ones by an antiderivative whose own claims are lemmas.

use super::super::definition::CONSTANT_OF_INTEGRATION;
use super::super::premise::Statements;
use super::build::{difference, infinity, integer, is_zero, negative, plain, product, quotient, root, sum, symbol};
use super::cases::is_absolute;
use super::derivative::{By, mentions};
use super::evaluate::evaluated;
use super::germ::End;
use super::limit::of_limit;
use super::moments::moments;
use super::series::{guess_at, is_likely_zero, seed};
use super::unbounded::{infinite, number, total, with_values};
use super::{Goal, NoProposals, Proposals, Reduced, Rule, defined, factorial, fresh, relations};
use numbers::{Field, Rational};
use texmath::{
    At, Condition, Elementary, Equation, Name, Operation, Relation, Symbols, Tree, any, any_side, holds,
    holds_indefinite, mapped, nodes_of, number_of, rewrite, speaks_of,
};

/// The most nodes of an antiderivative.
const LARGEST: usize = 20_000;

/// Whether a claim holds an integral without limits.
pub(super) fn is_indefinite(statements: &Statements) -> bool {
    statements.claims.iter().any(holds_indefinite)
}

/// The claims about indefinite integrals with both sides differentiated: these are equal up to a constant on each
/// interval exactly where the derivatives are equal.
pub(super) fn differentiated(statements: &Statements, symbols: &Symbols) -> Result<Statements, String> {
    let mut out = statements.clone().by(Rule::IntegralDifferentiated);
    out.claims.clear();
    for claim in &statements.claims {
        if !holds_indefinite(claim) {
            out.claims.push(claim.clone());
            continue;
        }
        if claim.relation != Relation::Equal {
            return Err("an antiderivative in an inequality".to_owned());
        }
        let mut by: Option<Name> = None;
        let mut slopes = Vec::new();
        for side in [&claim.left, &claim.right] {
            let mut own = Vec::new();
            terms(side, false, &mut own);
            slopes.push(own);
        }
        for (_, term) in slopes.iter().flatten() {
            if let Some((_, name)) = integrand(term) {
                if by.as_ref().is_some_and(|by| by != name) {
                    return Err("integrals by different letters".to_owned());
                }
                by = Some(name.clone());
            }
        }
        let by = by.ok_or("an integral within a product or a function")?;
        let pins = |condition: &Condition| {
            let is_equation =
                matches!(condition, Condition::Relation(relation) if relation.relation == Relation::Equal);
            is_equation && condition.sides().into_iter().any(|side| side.has_free(&by))
        };
        if super::is_spoken_of(statements, symbols, &by) || statements.assume.iter().any(pins) {
            return Err(format!("premises speak of `{by}`, which the integral is by"));
        }
        super::is_continuous(statements, symbols, &by)?;
        out.assume = statements.assume.iter().map(|own| in_the_open(own, &by)).collect();
        let constant = plain(CONSTANT_OF_INTEGRATION);
        let is_free = !symbols.knows(&constant);
        let mut sides = Vec::new();
        for own in slopes {
            let mut side = Vec::new();
            for (is_negative, term) in own {
                let slope = match integrand(&term) {
                    Some((of, _)) => of.clone(),
                    None if is_free && matches!(&term, Tree::Symbol(name, _) if *name == constant) => integer(0),
                    None if is_free && term.has_free(&constant) => {
                        return Err(format!(
                            "the constant {CONSTANT_OF_INTEGRATION} stands elsewhere than added: declare it"
                        ));
                    }
                    None => {
                        out.claims.push(Equation::between(term.clone(), term.clone()));
                        By { symbols, name: &by }.of(&term)?
                    }
                };
                side.push(if is_negative {
                    super::build::negative(slope)
                } else {
                    slope
                });
            }
            sides.push(sum(side));
        }
        let right = sides.pop().unwrap_or_else(|| integer(0));
        let left = sides.pop().unwrap_or_else(|| integer(0));
        out.claims.insert(
            0,
            Equation {
                left,
                right,
                ..claim.clone()
            },
        );
    }
    Ok(out)
}

/// A condition without its border where it speaks of a letter: what is differentiated must move.
fn in_the_open(condition: &Condition, letter: &Name) -> Condition {
    let strict = |relation: Relation| match relation {
        Relation::LessOrEqual => Relation::Less,
        Relation::GreaterOrEqual => Relation::Greater,
        relation => relation,
    };
    match condition {
        Condition::Relation(own) if own.left.has_free(letter) || own.right.has_free(letter) => {
            Condition::Relation(Equation {
                relation: strict(own.relation),
                ..own.clone()
            })
        }
        condition => condition.clone(),
    }
}

/// The terms of a side with their signs.
pub(super) fn terms(tree: &Tree, is_negative: bool, found: &mut Vec<(bool, Tree)>) {
    match tree {
        Tree::Sum(parts) => parts.iter().for_each(|part| terms(part, is_negative, found)),
        Tree::Negate(inner) => terms(inner, !is_negative, found),
        tree => found.push((is_negative, tree.clone())),
    }
}

/// The integrand and the letter of an indefinite integral.
pub(super) fn integrand(tree: &Tree) -> Option<(&Tree, &Name)> {
    match tree {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Integral { of, by, limits: None } => Some((of, by)),
            _ => None,
        },
        _ => None,
    }
}

/// Statements without integrals that come to the same where the lemmas hold.
pub(super) struct Integrated {
    pub statements: Statements,
    pub lemmas: Vec<Goal>,
    pub converging: Vec<Equation>,
}

impl Integrated {
    /// The statements as one goal.
    pub fn into_goal(mut self, symbols: &Symbols) -> Result<Reduced, String> {
        let evaluated = evaluated(&self.statements, symbols)?;
        let (simple, relations) = relations::simplified(&evaluated, symbols);
        for relation in relations {
            let mut alone = evaluated.clone().by(Rule::ValueRelations);
            let part = format!("a relation of values: {relation}");
            alone.claims = vec![relation];
            self.lemmas.push(Goal::of(&alone, symbols, part));
        }
        Ok(Reduced {
            lemmas: self.lemmas,
            converging: self.converging,
            ..Reduced::itself(Goal::of(&simple, symbols, String::new()))
        })
    }
}

/// The claim with each definite integral replaced by its value, as one goal; `None` where there is no such integral, or no value is found.
pub(super) fn by_antiderivatives(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Option<Reduced>, String> {
    let found = integrated(statements, symbols, proposals)?;
    found.map(|found| found.into_goal(symbols)).transpose()
}

/// The claim with each definite integral replaced by its value, which holds where the lemmas do; `None` where there is no such
/// integral, or no value is found.
pub(super) fn integrated(
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Option<Integrated>, String> {
    let statements = &defined::with_domain(&gathered(statements, symbols)?, symbols);
    let is_complex = |tree: &Tree| symbols.may_be_complex(tree);
    let is_any_complex = super::trees(statements).into_iter().any(is_complex);
    let (mut found, mut lemmas, mut converging) = (Vec::<(Tree, Tree)>::new(), Vec::new(), Vec::new());
    for tree in super::trees(statements) {
        for operation in outermost(tree) {
            let node = Tree::Operation(Box::new(operation.clone()), At::default());
            if found.iter().any(|(known, _)| *known == node) {
                continue;
            }
            if is_any_complex {
                return Ok(None);
            }
            let Some(value) = value_of(&operation, statements, symbols, proposals)? else {
                return Ok(None);
            };
            lemmas.extend(value.lemmas);
            converging.extend(value.converging);
            found.push((node, value.tree));
        }
    }
    if found.is_empty() {
        return Ok(None);
    }
    let without = with_values(statements, Rule::IntegralAntiderivative, &found)?;
    Ok(Some(Integrated {
        statements: without,
        lemmas,
        converging,
    }))
}

/// The integrand of a definite integral, its letter, and its limits.
fn definite(operation: &Operation) -> Option<(&Tree, &Name, [&Tree; 2])> {
    match operation {
        Operation::Integral {
            of,
            by,
            limits: Some((low, high)),
        } => Some((of, by, [low, high])),
        _ => None,
    }
}

/// Returns true if all operations of statements are integrals of real functions of their letters alone, between numbers or
/// infinite limits.
pub(super) fn are_numbers(statements: &Statements, symbols: &Symbols) -> bool {
    let all = super::trees(statements);
    let is_number = |operation: &Operation| {
        let Some((of, by, [low, high])) = definite(operation) else {
            return false;
        };
        let is_free = |tree: &Tree| {
            any(tree, &mut |node| match node {
                Tree::Symbol(name, _) => name != by && (symbols.declares(name) || !texmath::is_constant(name)),
                Tree::Call(name, ..) => symbols.is_function(name) || Elementary::named(name).is_none(),
                Tree::Operation(..) => true,
                _ => false,
            })
        };
        let limits = || [low, high].into_iter().filter(|limit| infinity(limit).is_none());
        !limits().chain([of]).any(is_free) && !limits().any(|limit| mentions(limit, by))
    };
    let operations: Vec<Operation> = all.iter().flat_map(|tree| outermost(tree)).collect();
    let values: Vec<(Operation, Tree)> = operations.iter().map(|own| (own.clone(), integer(0))).collect();
    !operations.is_empty()
        && operations.iter().all(is_number)
        && !all.iter().any(|tree| symbols.may_be_complex(tree))
        && !all
            .iter()
            .any(|tree| super::has_operation(&replaced(tree, &values), symbols))
}

/// The tree with operations replaced by their values.
pub(super) fn replaced(tree: &Tree, values: &[(Operation, Tree)]) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Operation(operation, _) => {
            let known = values.iter().find(|(known, _)| *known == **operation);
            known.map(|(_, value)| value.clone())
        }
        _ => None,
    })
}

/// The definite integrals in a tree that stand in no other one.
pub(super) fn outermost(tree: &Tree) -> Vec<Operation> {
    let mut found = Vec::new();
    collect_outermost(tree, &mut found);
    found
}

fn collect_outermost(tree: &Tree, found: &mut Vec<Operation>) {
    if let Tree::Operation(operation, _) = tree
        && matches!(**operation, Operation::Integral { limits: Some(_), .. })
    {
        found.push((**operation).clone());
        return;
    }
    tree.find_below(&mut |part| {
        collect_outermost(part, found);
        None::<()>
    });
}

/// The value of a definite integral.
struct Value {
    /// A number, or infinity.
    tree: Tree,
    /// The claims that must hold for it to be that.
    lemmas: Vec<Goal>,
    /// Those of these conditions without which an improper integral has no value.
    converging: Vec<Equation>,
}

/// The value of a definite integral; `None` where no antiderivative is found.
fn value_of(
    operation: &Operation,
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Option<Value>, String> {
    let Some((of, by, [low, high])) = definite(operation) else {
        return Ok(None);
    };
    may_be_bound(statements, symbols, by, of)?;
    let letter = fresh(statements, symbols, &by.base);
    let mut extended = symbols.clone();
    extended.let_be_parameter(&letter, false);
    let mut definite = Definite {
        statements,
        symbols: &extended,
        of: rewrite(of, &|name| (name == by).then(|| symbol(&letter))),
        letter: &letter,
        limits: [low, high],
        proposals,
    };
    // the inner integrals first, at each number of the interval
    let (mut inner, mut lemmas, mut converging) = (Vec::new(), Vec::new(), Vec::new());
    let mut within = statements.clone();
    within.assume.extend(definite.interval(false)?);
    for operation in outermost(&definite.of) {
        let Some(value) = value_of(&operation, &within, &extended, proposals)? else {
            return Ok(None);
        };
        lemmas.extend(value.lemmas);
        // what an inner one needs may move with the letter
        converging.extend(value.converging.into_iter().filter(|own| !mentions(&own.left, &letter)));
        inner.push((operation, number(value.tree)));
    }
    definite.of = replaced(&definite.of, &inner);
    if super::has_operation(&definite.of, symbols) {
        return Ok(None);
    }
    Ok(definite.over_pieces()?.map(|mut value| {
        value.lemmas.extend(lemmas);
        value.converging.extend(converging);
        value
    }))
}

/// An equation that ties an integral at an integer to that at the next one.
pub(super) struct Tied {
    pub equation: Equation,
    /// The claims that must hold for it.
    pub lemmas: Vec<Goal>,
}

/// The equation `I(n) + c I(n + 1) = v` for the integrals of f(x, n), where `f(x, n) + c f(x, n + 1)` is the derivative of a
/// function that rises by v from one limit to the other, and c is not 0: the next integral has a value where this one has.
///
/// # Errors
/// Why there is none.
pub(super) fn tied(
    operation: &Operation,
    integer_letter: &Name,
    names: [&Name; 2],
    statements: &Statements,
    symbols: &Symbols,
    proposals: &dyn Proposals,
) -> Result<Tied, String> {
    let statements = &statements.clone().by(Rule::IntegralReductionFormula);
    let (of, by, limits) = definite(operation).ok_or("an integral without limits")?;
    may_be_bound(statements, symbols, by, of)?;
    let moves = |tree: &&Tree| mentions(tree, integer_letter);
    if by == integer_letter || limits.iter().any(moves) || !mentions(of, integer_letter) {
        return Err(format!("an integral does not move with {integer_letter} alone"));
    }
    let letter = fresh(statements, symbols, &by.base);
    let mut extended = symbols.clone();
    extended.let_be_parameter(&letter, false);
    let of = rewrite(of, &|name| (name == by).then(|| symbol(&letter)));
    if super::has_operation(&of, symbols) {
        return Err("an integral of what holds a factorial or another operation".to_owned());
    }
    let more = sum(vec![symbol(integer_letter), integer(1)]);
    let next = rewrite(&of, &|name| (name == integer_letter).then(|| more.clone()));
    let found = proposals.reduction_formula(&of, &next, &letter, &extended);
    let [factor, whole] = found.ok_or_else(|| format!("no reduction formula by {integer_letter} is found"))?;
    if mentions(&factor, &letter) {
        return Err("a reduction formula whose factor is no number".to_owned());
    }
    let definite = Definite {
        statements,
        symbols: &extended,
        of: sum(vec![of, product(vec![factor.clone(), next])]),
        letter: &letter,
        limits,
        proposals,
    };
    let mut conditions = definite.conditions(&[&factor])?;
    conditions.push(Equation {
        relation: Relation::NotEqual,
        ..Equation::between(factor.clone(), integer(0))
    });
    let about = "the factor of a reduction formula";
    let lemmas = definite.lemmas(Rule::IntegralReductionFormula, about, conditions, Vec::new())?;
    let value = definite.by_antiderivative(&whole, lemmas)?;
    let is_nowhere = |node: &Tree| matches!(node, Tree::Quotient(_, below, _) if is_zero(below));
    if infinity(&value.tree).is_some() || any(&value.tree, &mut |node| is_nowhere(node)) {
        return Err("a reduction formula with an infinite value at an end".to_owned());
    }
    let [own, next] = names.map(symbol);
    Ok(Tied {
        equation: Equation::between(sum(vec![own, product(vec![factor, next])]), value.tree),
        lemmas: value.lemmas,
    })
}

/// That trees are continuous on the closed interval of a definite integral, and around each number of it, as goals.
pub(super) fn continuous(
    operation: &Operation,
    trees: &[Tree],
    statements: &Statements,
    symbols: &Symbols,
    rule: Rule,
) -> Result<Vec<Goal>, String> {
    let Some((of, by, limits)) = definite(operation) else {
        return Ok(Vec::new());
    };
    may_be_bound(statements, symbols, by, of)?;
    let letter = fresh(statements, symbols, &by.base);
    let mut extended = symbols.clone();
    extended.let_be_parameter(&letter, false);
    let within = |tree: &Tree| rewrite(tree, &|name| (name == by).then(|| symbol(&letter)));
    let definite = Definite {
        statements,
        symbols: &extended,
        of: within(of),
        letter: &letter,
        limits,
        proposals: &NoProposals,
    };
    let trees: Vec<Tree> = trees.iter().map(within).collect();
    let mut conditions = definite.conditions(&trees.iter().collect::<Vec<_>>())?;
    for condition in &mut conditions {
        condition.relation = match condition.relation {
            Relation::GreaterOrEqual => Relation::Greater,
            Relation::LessOrEqual => Relation::Less,
            relation => relation,
        };
    }
    definite.lemmas(rule, "the integrand", conditions, definite.interval(true)?)
}

/// The claims with several integrals of unknown functions over one interval as one: parts that have no antiderivative may
/// have one together. Each exists where all do that the sum is of, for the interval is finite.
fn gathered(statements: &Statements, symbols: &Symbols) -> Result<Statements, String> {
    let mut out = statements.clone();
    let mut is_any = false;
    for claim in &mut out.claims {
        if claim.relation != Relation::Equal {
            continue;
        }
        let mut all = Vec::new();
        terms(&claim.left, false, &mut all);
        terms(&claim.right, true, &mut all);
        let has_unknown = |of: &Tree| {
            any(
                of,
                &mut |node| matches!(node, Tree::Call(name, ..) if symbols.is_function(name)),
            )
        };
        let is_one = |term: &Tree| {
            multiple(term).is_some_and(|(_, of, _, limits)| {
                has_unknown(of) && limits.iter().all(|limit| infinity(limit).is_none())
            })
        };
        let shared = all.iter().find_map(|(_, term)| {
            let own = multiple(term).filter(|_| is_one(term)).map(|(.., limits)| limits)?;
            let others = all
                .iter()
                .filter(|(_, other)| is_one(other) && multiple(other).is_some_and(|(.., limits)| limits == own));
            (others.count() > 1).then(|| own.map(Clone::clone))
        });
        let Some([low, high]) = shared else { continue };
        let letter = fresh(statements, symbols, "x");
        let (mut integrands, mut rest) = (Vec::new(), Vec::new());
        for (is_negative, term) in &all {
            let signed = |tree: Tree| if *is_negative { negative(tree) } else { tree };
            match multiple(term).filter(|_| is_one(term)) {
                Some((factors, of, by, [own_low, own_high])) if *own_low == low && *own_high == high => {
                    may_be_bound(statements, symbols, by, of)?;
                    let of = rewrite(of, &|name| (name == by).then(|| symbol(&letter)));
                    let factors = factors.into_iter().chain([of]).collect();
                    integrands.push(signed(Tree::Product(factors)));
                }
                _ => rest.push(signed(term.clone())),
            }
        }
        let operation = Operation::Integral {
            of: sum(integrands),
            by: letter,
            limits: Some((low, high)),
        };
        rest.push(Tree::Operation(Box::new(operation), claim.at));
        claim.left = sum(rest);
        claim.right = integer(0);
        is_any = true;
    }
    Ok(if is_any { out.by(Rule::IntegralLinear) } else { out })
}

/// What a term is of one definite integral, which stands in no other factor of it: the factors, what is integrated, by
/// what, and the limits.
fn multiple(term: &Tree) -> Option<(Vec<Tree>, &Tree, &Name, [&Tree; 2])> {
    match term {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Integral {
                of,
                by,
                limits: Some((low, high)),
            } => Some((Vec::new(), of, by, [low, high])),
            _ => None,
        },
        Tree::Negate(inner) => {
            let (mut factors, of, by, limits) = multiple(inner)?;
            factors.push(integer(-1));
            Some((factors, of, by, limits))
        }
        Tree::Quotient(above, below, _) if outermost(below).is_empty() => {
            let (mut factors, of, by, limits) = multiple(above)?;
            factors.push(quotient(integer(1), (**below).clone()));
            Some((factors, of, by, limits))
        }
        Tree::Product(all) => {
            let mut with = all.iter().filter(|factor| !outermost(factor).is_empty());
            let (Some(single), None) = (with.next(), with.next()) else {
                return None;
            };
            let (mut factors, of, by, limits) = multiple(single)?;
            factors.extend(all.iter().filter(|factor| outermost(factor).is_empty()).cloned());
            Some((factors, of, by, limits))
        }
        _ => None,
    }
}

/// Refuses an integral by a letter of which premises speak, for other symbols may depend on it there. Laws of functions at
/// each value of the running symbol say nothing of its other values; no function may be left in the integral then.
fn may_be_bound(statements: &Statements, symbols: &Symbols, by: &Name, of: &Tree) -> Result<(), String> {
    if !super::is_spoken_of(statements, symbols, by) {
        return Ok(());
    }
    let is_value = |tree: &Tree| match tree {
        Tree::Call(name, ..) | Tree::Symbol(name, _) => {
            symbols.is_in_flight(name) || (symbols.is_function(name) && !symbols.is_parameter(name))
        }
        _ => false,
    };
    let is_law = |equation: &Equation| {
        is_value(&equation.left)
            && match &equation.left {
                Tree::Call(_, argument, _) => {
                    matches!(&**argument, Tree::Symbol(name, _) if name == by)
                }
                _ => true,
            }
    };
    let mut spoken = statements
        .premises
        .iter()
        .map(|premise| &premise.equation)
        .filter(|equation| equation.left.has_free(by) || equation.right.has_free(by));
    let is_allowed = symbols.running() == Some(by)
        && !super::is_tied(statements, symbols, by)
        && !super::stands_in_symbols(symbols, by)
        && spoken.all(is_law)
        && !any(of, &mut |node| is_value(node));
    match is_allowed {
        true => Ok(()),
        false => Err(format!("premises speak of `{by}`, which the integral is by")),
    }
}

/// Returns true for a positive number plus even powers, which is not 0 where it has a value.
fn is_one_and_squares(tree: &Tree) -> bool {
    let Tree::Sum(terms) = tree else { return false };
    let is_positive = |term: &Tree| number_of(term).is_some_and(|value| value > Rational::from_integer(0));
    let is_square = |term: &Tree| matches!(term, Tree::Power(_, exponent @ 0.., _) if exponent % 2 == 0);
    terms.iter().any(is_positive) && terms.iter().all(|term| is_positive(term) || is_square(term))
}

/// The largest denominator of a ratio of radicands.
const LARGEST_RATIO: i64 = 144;

/// The positive rational number that a tree is likely to be times another one.
fn rational_ratio(above: &Tree, below: &Tree) -> Option<Rational> {
    let [above_value, below_value] = [above, below].map(|tree| guess_at(tree, &|name| Some(seed(name))));
    let ratio = above_value? / below_value?;
    let parts = (1..=LARGEST_RATIO).find(|parts| {
        let whole = ratio * *parts as f64;
        whole > 0.5 && whole < 1e6 && (whole - whole.round()).abs() < 1e-9
    })?;
    let factor = Rational::from_ratio((ratio * parts as f64).round() as i64, parts);
    let multiple = product(vec![Tree::Number(factor.clone()), below.clone()]);
    is_likely_zero(&difference(above.clone(), multiple)).then_some(factor)
}

/// One definite integral, perhaps an improper one, which is the limit towards an infinite end, or towards one at which the
/// antiderivative has no value.
#[derive(Clone)]
struct Definite<'a> {
    statements: &'a Statements,
    symbols: &'a Symbols,
    /// What is integrated, without operations.
    of: Tree,
    /// What it is integrated by, which stands for any number of the interval.
    letter: &'a Name,
    limits: [&'a Tree; 2],
    proposals: &'a dyn Proposals,
}

impl Definite<'_> {
    /// The integral; where what is between bars changes its sign between limits that are numbers, the sum of those over the
    /// pieces, on each of which it has a sign that is shown.
    fn over_pieces(&self) -> Result<Option<Value>, String> {
        let mut bars: Vec<Tree> = Vec::new();
        any(&self.of, &mut |node| {
            if let Tree::Call(_, inner, _) = node
                && is_absolute(node)
                && mentions(inner, self.letter)
                && !bars.contains(inner)
            {
                bars.push((**inner).clone());
            }
            false
        });
        let places = match bars.is_empty() {
            true => Vec::new(),
            false => self.places(&bars),
        };
        if bars.is_empty() {
            return self.value();
        }
        if places.is_empty() && self.ends().is_none() {
            return match self.by_symmetry()? {
                Some(found) => Ok(Some(found)),
                None => self.value(),
            };
        }
        self.sum_over(&places, &|piece| {
            let (of, signs) = piece.without_bars();
            let signs = piece.lemmas(Rule::IntegralPieces, "the sign", signs, piece.interval(false)?)?;
            let piece = Definite { of, ..piece.clone() };
            let value = piece.value()?;
            Ok(value.map(|mut value| {
                value.lemmas.extend(signs);
                value
            }))
        })
    }

    /// The sum of what is found for the pieces between one place and the next, in the order of the limits.
    fn sum_over(
        &self,
        places: &[Tree],
        found: &dyn Fn(&Definite) -> Result<Option<Value>, String>,
    ) -> Result<Option<Value>, String> {
        let [low, high] = self.limits;
        let ends = [low.clone()]
            .into_iter()
            .chain(places.iter().cloned())
            .chain([high.clone()]);
        let ends: Vec<Tree> = ends.collect();
        let (mut terms, mut lemmas) = (Vec::new(), Vec::new());
        for (from, to) in ends.iter().zip(ends.iter().skip(1)) {
            let piece = Definite {
                limits: [from, to],
                ..self.clone()
            };
            let Some(value) = found(&piece)? else {
                return Ok(None);
            };
            lemmas.extend(value.lemmas);
            terms.push(value.tree);
        }
        Ok(Some(Value {
            tree: total(terms),
            lemmas,
            converging: Vec::new(),
        }))
    }

    /// The ends as machine numbers, where they are numbers or infinite.
    fn ends(&self) -> Option<[f64; 2]> {
        let value = |limit: &Tree| match infinity(limit) {
            Some(true) => Some(f64::INFINITY),
            Some(false) => Some(f64::NEG_INFINITY),
            None => {
                let is_free = |node: &Tree| match node {
                    Tree::Symbol(name, _) => self.symbols.declares(name) || !texmath::is_constant(name),
                    Tree::Call(name, ..) => self.symbols.is_function(name),
                    _ => false,
                };
                let value = (!any(limit, &mut |node| is_free(node))).then(|| guess_at(limit, &|_| None))?;
                value.filter(|value| value.is_finite())
            }
        };
        let [low, high] = self.limits.map(value);
        Some([low?, high?]).filter(|[low, high]| low != high)
    }

    /// The numbers within the interval, from one limit to the other, at which trees are likely to be 0.
    fn places(&self, trees: &[Tree]) -> Vec<Tree> {
        let Some([from, to]) = self.ends() else {
            return Vec::new();
        };
        let [low, high] = self.limits;
        let between = if from < to { [low, high] } else { [high, low] };
        let mut places: Vec<(f64, Tree)> = Vec::new();
        for tree in trees {
            for place in self.proposals.zeros(tree, self.letter, between) {
                let value = guess_at(&place, &|_| None).filter(|value| from.min(to) < *value && *value < from.max(to));
                let is_known = |value: f64| places.iter().any(|(known, _)| (known - value).abs() < 1e-9);
                if let Some(value) = value.filter(|value| !is_known(*value)) {
                    places.push((value, place));
                }
            }
        }
        places.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        if to < from {
            places.reverse();
        }
        places.into_iter().map(|(_, place)| place).collect()
    }

    /// The integrand with the signs that terms between bars have within the piece, and the claims that they have these signs.
    fn without_bars(&self) -> (Tree, Vec<Equation>) {
        let middle = match self.ends() {
            Some([from, to]) if from.is_finite() && to.is_finite() => 0.5 * (from + to),
            Some([from, _]) if from.is_finite() => from + 1.0,
            Some([_, to]) if to.is_finite() => to - 1.0,
            _ => return (self.of.clone(), Vec::new()),
        };
        let signed = |node: &Tree| {
            let Tree::Call(_, inner, _) = node else { return None };
            let is_one = is_absolute(node) && mentions(inner, self.letter);
            let value = guess_at(inner, &|name| (name == self.letter).then_some(middle)).filter(|_| is_one)?;
            Some((value < 0.0, (**inner).clone()))
        };
        let of = mapped(&self.of, &|node| {
            let (is_negative, inner) = signed(node)?;
            Some(if is_negative { negative(inner) } else { inner })
        });
        let mut signs = Vec::new();
        any(&self.of, &mut |node| {
            signs.extend(signed(node).map(|(is_negative, inner)| Equation {
                relation: match is_negative {
                    true => Relation::LessOrEqual,
                    false => Relation::GreaterOrEqual,
                },
                ..Equation::between(inner, integer(0))
            }));
            false
        });
        (of, signs)
    }

    /// The value; `None` where no antiderivative is found.
    fn value(&self) -> Result<Option<Value>, String> {
        if let Some(found) = self.moments()? {
            return Ok(Some(found));
        }
        match self.proposals.antiderivative(&self.of, self.letter, self.symbols) {
            Some(whole) => self.by_antiderivative(&whole, Vec::new()).map(Some),
            None => {
                if let Some(found) = self.by_table()? {
                    return Ok(Some(found));
                }
                match self.by_symmetry()? {
                    Some(found) => Ok(Some(found)),
                    None => self.by_reflection(),
                }
            }
        }
    }

    /// Twice the integral over the upper half of an interval around 0, where the integrand is even.
    fn by_symmetry(&self) -> Result<Option<Value>, String> {
        let [low, high] = self.limits;
        let ends = match (infinity(low), infinity(high)) {
            (Some(false), Some(true)) => None,
            (None, None) => Some(Equation::between(low.clone(), negative(high.clone()))),
            _ => return Ok(None),
        };
        let is_around = |ends: &Equation| is_likely_zero(&difference(ends.left.clone(), ends.right.clone()));
        let turned = rewrite(&self.of, &|name| (name == self.letter).then(|| negative(symbol(name))));
        let is_even = is_likely_zero(&difference(self.of.clone(), turned.clone()));
        if !is_even || !mentions(&self.of, self.letter) || !ends.iter().all(is_around) {
            return Ok(None);
        }
        let zero = integer(0);
        let half = Definite {
            limits: [&zero, high],
            ..self.clone()
        };
        let Some(mut value) = half.over_pieces()? else {
            return Ok(None);
        };
        let (rule, about) = (Rule::IntegralReflection, "an even integrand");
        let mut within = self.conditions(&[&self.of, &turned])?;
        within.push(Equation::between(turned, self.of.clone()));
        let interval = half.interval(false)?;
        value.lemmas.extend(self.lemmas(rule, about, within, interval)?);
        let ends = ends.into_iter().collect();
        value.lemmas.extend(self.lemmas(rule, about, ends, Vec::new())?);
        if infinity(&value.tree).is_none() {
            value.tree = product(vec![integer(2), value.tree]);
        }
        Ok(Some(value))
    }

    /// The value as a multiple of an integral of the table.
    fn by_table(&self) -> Result<Option<Value>, String> {
        let Some(found) = self.proposals.known_integral(&self.of, self.letter, self.limits) else {
            return Ok(None);
        };
        let parts = found.letters.iter().chain([&found.factor]);
        let mut needed = Vec::new();
        for (own, limit) in found.row.limits.iter().zip(self.limits) {
            match (infinity(own), infinity(limit)) {
                (None, None) => needed.push(Equation::between(limit.clone(), own.clone())),
                (own, limit) if own == limit => {}
                _ => return Ok(None),
            }
        }
        if parts.into_iter().any(|part| mentions(part, self.letter)) {
            return Ok(None);
        }
        needed.extend(found.conditions());
        let (rule, about) = (Rule::IntegralTable, "a row of the table");
        let mut lemmas = self.lemmas(rule, about, needed, Vec::new())?;
        let row = product(vec![found.factor.clone(), found.integrand(self.letter)]);
        let mut within = self.conditions(&[&self.of, &row])?;
        within.push(Equation::between(self.of.clone(), row));
        lemmas.extend(self.lemmas(rule, about, within, self.interval(false)?)?);
        Ok(Some(Value {
            tree: product(vec![found.factor.clone(), found.value()]),
            lemmas,
            converging: Vec::new(),
        }))
    }

    /// The maps of the interval onto itself that exchange its ends, each with the size of its slope and what must hold for it to be one:
    /// the reflection at the middle of a finite interval, and the reciprocal between ends that are reciprocal.
    fn exchanges(&self) -> Vec<(Tree, Tree, Vec<Equation>)> {
        let [low, high] = self.limits;
        let letter = || symbol(self.letter);
        let is_finite = self.limits.iter().all(|limit| infinity(limit).is_none());
        let mut found = Vec::new();
        if is_finite {
            let turned = difference(sum(vec![low.clone(), high.clone()]), letter());
            found.push((turned, integer(1), Vec::new()));
        }
        let reciprocal = || quotient(integer(1), letter());
        let slope = || quotient(integer(1), super::build::power(letter(), 2));
        let product_of_ends = Equation::between(product(vec![low.clone(), high.clone()]), integer(1));
        if is_zero(low) && infinity(high) == Some(true) {
            found.push((reciprocal(), slope(), Vec::new()));
        } else if is_finite && is_likely_zero(&difference(product_of_ends.left.clone(), integer(1))) {
            let positive = Equation {
                relation: Relation::Greater,
                ..Equation::between(low.clone(), integer(0))
            };
            found.push((reciprocal(), slope(), vec![positive, product_of_ends]));
        }
        found
    }

    /// Half of the integral of the sum of the integrand and its image under a map that exchanges the ends. The integrand is
    /// continuous on the closed interval; or it has one sign, so that its integral has a value where that of the sum has one.
    fn by_reflection(&self) -> Result<Option<Value>, String> {
        let (rule, about) = (Rule::IntegralReflection, "the integrand that is reflected");
        let statements = &self.statements.clone().by(rule);
        for (image, slope, needed) in self.exchanges() {
            let reflected = rewrite(&self.of, &|name| (name == self.letter).then(|| image.clone()));
            let reflected = product(vec![slope, reflected]);
            let both = Definite {
                of: quotient(sum(vec![self.of.clone(), reflected]), integer(2)),
                statements,
                ..self.clone()
            };
            let Some(whole) = self.proposals.antiderivative(&both.of, self.letter, self.symbols) else {
                continue;
            };
            let mut conditions = self.conditions(&[&self.of])?;
            let is_closed = self
                .limits
                .iter()
                .all(|limit| infinity(limit).is_none() && !self.is_singular(&conditions, limit));
            if !is_closed {
                let signed = self.with_sign(Equation {
                    relation: Relation::NotEqual,
                    ..Equation::between(self.of.clone(), integer(0))
                });
                let relation = match signed.relation {
                    Relation::Greater => Relation::GreaterOrEqual,
                    Relation::Less => Relation::LessOrEqual,
                    _ => continue,
                };
                conditions.push(Equation { relation, ..signed });
            }
            let mut lemmas = self.lemmas(rule, about, conditions, self.interval(is_closed)?)?;
            lemmas.extend(self.lemmas(rule, about, needed, Vec::new())?);
            return both.by_antiderivative(&whole, lemmas).map(Some);
        }
        Ok(None)
    }

    /// The integral by an antiderivative on each piece between places at which it has no value or no slope. Within a piece the integrand is
    /// continuous and its slope; it is continuous up to an end, or has a limit there.
    fn by_antiderivative(&self, whole: &Tree, lemmas: Vec<Goal>) -> Result<Value, String> {
        if nodes_of(whole) > LARGEST {
            return Err("the value of an integral is too large".to_owned());
        }
        let by = By {
            symbols: self.symbols,
            name: self.letter,
        };
        let divisors = self.conditions(&[whole, &by.of(whole)?])?.into_iter();
        let divisors =
            divisors.filter(|own| own.relation != Relation::GreaterOrEqual && mentions(&own.left, self.letter));
        let divisors: Vec<Tree> = divisors.map(|own| difference(own.left, own.right)).collect();
        let places = self.places(&divisors);
        let pieces = self.sum_over(&places, &|piece| piece.on_piece(whole).map(Some))?;
        let mut value = pieces.ok_or("an integral without pieces")?;
        value.lemmas.extend(lemmas);
        value.converging = self.convergence().into_iter().collect();
        Ok(value)
    }

    fn on_piece(&self, whole: &Tree) -> Result<Value, String> {
        let by = By {
            symbols: self.symbols,
            name: self.letter,
        };
        let slope = by.of(whole)?;
        let (rule, about) = (Rule::IntegralAntiderivative, "the antiderivative");
        let vanishing = self.vanishing_powers(whole);
        let conditions = self.continuity(whole, &vanishing)?;
        let is_singular = self
            .limits
            .map(|limit| infinity(limit).is_none() && self.is_singular(&conditions, limit));
        let closed = self.region(is_singular.map(|is_singular| !is_singular))?;
        let mut lemmas = self.lemmas(rule, about, conditions.clone(), closed)?;
        let mut within = self.conditions(&[&self.of, &slope])?;
        within.retain(|condition| !conditions.contains(condition));
        let (slope, related) = self.by_own_roots(&slope);
        within.extend(related);
        within.push(Equation::between(slope, self.of.clone()));
        lemmas.extend(self.lemmas(rule, about, within, self.interval(false)?)?);
        let [low, high] = self.limits;
        if self.limits.iter().all(|limit| infinity(limit).is_none()) && !speaks_of(&self.of, self.letter) {
            let length = difference(high.clone(), low.clone());
            return Ok(Value {
                tree: product(vec![self.of.clone(), length]),
                lemmas,
                converging: Vec::new(),
            });
        }
        if is_singular.contains(&true) && self.ends().is_none() {
            let ordered = Equation {
                relation: Relation::Less,
                ..Equation::between(low.clone(), high.clone())
            };
            lemmas.extend(self.lemmas(rule, "the order of the limits", vec![ordered], Vec::new())?);
        }
        let is_ascending = self.ends().is_none_or(|[low, high]| low < high);
        let [at_low, at_high] = is_singular;
        let low = self.towards(low, at_low.then_some(is_ascending));
        let high = self.towards(high, at_high.then_some(!is_ascending));
        let mut value = |limit: &Tree| self.value_at(whole, &vanishing, limit, &mut lemmas);
        let (high, low) = (value(&high)?, value(&low)?);
        Ok(Value {
            tree: total(vec![high, negative(low)]),
            lemmas,
            converging: Vec::new(),
        })
    }

    /// A derivative with its square roots as multiples of those of the integrand, where their radicands are likely to be rational multiples,
    /// and the equations of these roots: each is shown by itself.
    fn by_own_roots(&self, slope: &Tree) -> (Tree, Vec<Equation>) {
        let mut own: Vec<Tree> = Vec::new();
        any(&self.of, &mut |node| {
            let is_root = matches!(node, Tree::Root(radicand, 2, _) if mentions(radicand, self.letter));
            if is_root && !own.contains(node) {
                own.push(node.clone());
            }
            false
        });
        let related = std::cell::RefCell::new(Vec::new());
        let slope = mapped(slope, &|node| {
            let Tree::Root(radicand, 2, _) = node else { return None };
            let (factor, known) = own.iter().find_map(|known| match known {
                Tree::Root(other, ..) if node != known => Some((rational_ratio(radicand, other)?, known)),
                _ => None,
            })?;
            let new = product(vec![root(Tree::Number(factor)), known.clone()]);
            related.borrow_mut().push(Equation::between(node.clone(), new.clone()));
            Some(new)
        });
        (slope, related.into_inner())
    }

    /// A limit, or what tends to it from above or below.
    fn towards(&self, limit: &Tree, is_above: Option<bool>) -> Tree {
        let one_sided =
            |is_above| Tree::Operation(Box::new(Operation::OneSided(limit.clone(), is_above)), At::default());
        is_above.map_or_else(|| limit.clone(), one_sided)
    }

    /// The value or the limit of an antiderivative at an end, with the goals that it needs.
    fn value_at(&self, whole: &Tree, vanishing: &[Tree], limit: &Tree, lemmas: &mut Vec<Goal>) -> Result<Tree, String> {
        if infinity(limit).is_none() && !matches!(limit, Tree::Operation(..)) {
            let (value, needed) = self.at_end(whole, vanishing, limit);
            let about = "the value at an end";
            lemmas.extend(self.lemmas(Rule::IntegralAntiderivative, about, needed, Vec::new())?);
            return Ok(value);
        }
        // what does not move in the antiderivative has a value, by the lemmas
        let likely: Vec<Equation> = self.convergence().into_iter().collect();
        let found = of_limit(self.statements, self.symbols, whole, self.letter, limit, &likely)?;
        lemmas.extend(found.lemmas);
        match found.end {
            Some(End::Finite(value)) => Ok(*value),
            Some(End::Infinite(is_above)) => Ok(infinite(is_above)),
            None => Err("an integral whose antiderivative has no limit, as far as it is followed".to_owned()),
        }
    }

    /// The powers of what vanishes at an end, whose exponents do not move: where these are positive, such a power is continuous
    /// there, and 0.
    fn vanishing_powers(&self, whole: &Tree) -> Vec<Tree> {
        let mut found = Vec::new();
        any(whole, &mut |node| {
            let Tree::RealPower(base, exponent, _) = node else {
                return false;
            };
            let is_zero_at = |limit: &&Tree| infinity(limit).is_none() && is_likely_zero(&self.at(base, limit));
            let is_one =
                mentions(base, self.letter) && !mentions(exponent, self.letter) && self.limits.iter().any(is_zero_at);
            if is_one && !found.contains(node) {
                found.push(node.clone());
            }
            false
        });
        found
    }

    fn at(&self, tree: &Tree, place: &Tree) -> Tree {
        rewrite(tree, &|name| (name == self.letter).then(|| place.clone()))
    }

    /// The conditions under which a tree has a value and is continuous, where powers that vanish at an end have positive exponents.
    fn continuity(&self, whole: &Tree, vanishing: &[Tree]) -> Result<Vec<Equation>, String> {
        // a root is continuous where such a power is
        let as_roots = mapped(whole, &|node| match node {
            Tree::RealPower(base, exponent, _) if vanishing.contains(node) => {
                (!factorial::is_integer(exponent, self.symbols)).then(|| root((**base).clone()))
            }
            _ => None,
        });
        let mut conditions = self.conditions(&[&as_roots])?;
        for node in vanishing {
            if let Tree::RealPower(_, exponent, _) = node {
                conditions.extend(self.conditions(&[exponent])?);
                conditions.push(Equation {
                    relation: Relation::Greater,
                    ..Equation::between((**exponent).clone(), integer(0))
                });
            }
        }
        Ok(conditions)
    }

    /// Returns true if a condition is likely not to hold at an end.
    fn is_singular(&self, conditions: &[Equation], limit: &Tree) -> bool {
        conditions.iter().any(|condition| {
            let moves = [&condition.left, &condition.right]
                .into_iter()
                .any(|side| mentions(side, self.letter));
            let is_strict =
                condition.relation != Relation::GreaterOrEqual && condition.relation != Relation::LessOrEqual;
            moves
                && is_strict
                && is_likely_zero(&self.at(&difference(condition.left.clone(), condition.right.clone()), limit))
        })
    }

    /// The value of an antiderivative at an end at which it is continuous, and what must hold for it to be that.
    fn at_end(&self, whole: &Tree, vanishing: &[Tree], limit: &Tree) -> (Tree, Vec<Equation>) {
        let mut needed = Vec::new();
        for node in vanishing {
            if let Tree::RealPower(base, ..) = node {
                let base = self.at(base, limit);
                if is_likely_zero(&base) && number_of(&base) != Some(Rational::from_integer(0)) {
                    needed.push(Equation::between(base, integer(0)));
                }
            }
        }
        let there = mapped(whole, &|node| match node {
            Tree::RealPower(base, ..) if vanishing.contains(node) => {
                is_likely_zero(&self.at(base, limit)).then(|| integer(0))
            }
            _ => None,
        });
        (self.plain(&self.at(&there, limit), &mut needed), needed)
    }

    /// The tree with arguments of functions, roots and powers that are likely to be -1, 0 or 1 as these numbers, which must be shown.
    fn plain(&self, tree: &Tree, needed: &mut Vec<Equation>) -> Tree {
        let found = std::cell::RefCell::new(Vec::new());
        let whole = |inner: &Tree| -> Option<Tree> {
            let number = [0, 1, -1].into_iter().map(integer);
            let number = number
                .into_iter()
                .find(|number| is_likely_zero(&difference(inner.clone(), number.clone())))?;
            if number_of(inner).is_none() {
                found
                    .borrow_mut()
                    .push(Equation::between(inner.clone(), number.clone()));
            }
            Some(number)
        };
        let plain = mapped(tree, &|node| match node {
            Tree::Call(name, inner, at) if Elementary::named(name).is_some() => {
                Some(Tree::Call(name.clone(), Box::new(whole(inner)?), *at))
            }
            Tree::Root(inner, index, at) => Some(Tree::Root(Box::new(whole(inner)?), *index, *at)),
            Tree::RealPower(base, ..) => whole(base).filter(|base| number_of(base) == Some(Rational::from_integer(1))),
            _ => None,
        });
        needed.extend(found.into_inner());
        // all of it has a value, so that a factor 0 leaves nothing
        let zero = Rational::from_integer(0);
        mapped(&plain, &|node| match node {
            Tree::Product(factors) if factors.iter().any(|factor| number_of(factor).as_ref() == Some(&zero)) => {
                Some(integer(0))
            }
            _ => None,
        })
    }

    /// The condition that a tree is not 0 as one that it has a sign, where it has one at some numbers of an interval between numbers:
    /// that is shown more often.
    fn with_sign(&self, condition: Equation) -> Equation {
        let Some([from, to]) = self.ends().filter(|_| condition.relation == Relation::NotEqual) else {
            return condition;
        };
        let far = |end: f64, other: f64| match (end.is_finite(), other.is_finite()) {
            (true, _) => end,
            (false, true) => other + 40.0_f64.copysign(end),
            (false, false) => 40.0_f64.copysign(end),
        };
        let [from, to] = [far(from, to), far(to, from)];
        let whole = difference(condition.left.clone(), condition.right.clone());
        let at = |part: f64| {
            let x = from + part * (to - from);
            guess_at(&whole, &|name| (name == self.letter).then_some(x)).filter(|value| value.is_finite())
        };
        let values: Option<Vec<f64>> = [0.01, 0.13, 0.29, 0.5, 0.61, 0.83, 0.99].into_iter().map(at).collect();
        let relation = match values {
            Some(values) if values.iter().all(|value| *value > 0.0) => Relation::Greater,
            Some(values) if values.iter().all(|value| *value < 0.0) => Relation::Less,
            _ => Relation::NotEqual,
        };
        Equation { relation, ..condition }
    }

    /// The condition without which an improper integral has no value: that the exponential decays in a multiple, by a number
    /// other than 0, of a power times an exponential. Of other integrals none is known.
    fn convergence(&self) -> Option<Equation> {
        let [low, high] = self.limits;
        let is_power = |factor: &Tree| match factor {
            Tree::Symbol(name, _) => name == self.letter,
            Tree::Power(base, 1.., _) => matches!(&**base, Tree::Symbol(name, _) if name == self.letter),
            _ => false,
        };
        let exponential = match &self.of {
            Tree::Product(factors) => {
                let rest = factors.iter().filter(|factor| !is_power(factor));
                product(rest.cloned().collect())
            }
            of => of.clone(),
        };
        let (factor, mut coefficients) = super::gaussian::exponential(&exponential, self.letter, self.symbols)?;
        number_of(&factor).filter(|factor| *factor != Rational::from_integer(0))?;
        let of = coefficients.pop()?;
        let relation = match (infinity(low), infinity(high), coefficients.as_slice()) {
            (None, Some(true), [_]) => Relation::Less,
            (Some(false), None, [_]) => Relation::Greater,
            (Some(false), Some(true), [_, _]) => Relation::Less,
            (None, Some(true), [_, linear]) if is_zero(linear) => Relation::Less,
            _ => return None,
        };
        Some(Equation {
            relation,
            ..Equation::between(of, integer(0))
        })
    }

    /// The integral of powers times exponentials.
    fn moments(&self) -> Result<Option<Value>, String> {
        let Some(found) = moments(&self.of, self.letter, self.limits, self.symbols) else {
            return Ok(None);
        };
        let mut claims = self.conditions(&[&self.of, &found.sum])?;
        claims.push(Equation::between(self.of.clone(), found.sum));
        claims.extend(found.needed);
        let about = "the integral of powers times exponentials";
        Ok(Some(Value {
            tree: found.value,
            lemmas: self.lemmas(Rule::IntegralGamma, about, claims, self.interval(false)?)?,
            converging: self.convergence().into_iter().collect(),
        }))
    }

    /// What must hold for trees to have a value at each number of the interval. A function of which nothing speaks is
    /// smooth, and has one everywhere.
    fn conditions(&self, trees: &[&Tree]) -> Result<Vec<Equation>, String> {
        let is_function = |name: &Name| self.symbols.is_function(name) || self.symbols.is_in_flight(name);
        let is_spoken = |node: &Tree| matches!(node, Tree::Call(name, ..) | Tree::Symbol(name, _) if is_function(name));
        let mut premises = self.statements.premises.iter().map(|premise| &premise.equation);
        let is_open = self.symbols.relations.is_empty()
            && !premises.any(|equation| any_side(equation, &mut |node| is_spoken(node)));
        let is_smooth = |name: &Name| is_open && self.symbols.is_function(name);
        let mut needed = Vec::new();
        for tree in trees {
            needed.extend(defined::conditions_beside(tree, self.symbols, &is_smooth)?);
        }
        needed.retain(|condition| condition.relation != Relation::NotEqual || !is_one_and_squares(&condition.left));
        Ok(needed)
    }

    /// The claims at each number of an interval, each as a goal of its own, once.
    fn lemmas(
        &self,
        rule: Rule,
        about: &str,
        claims: Vec<Equation>,
        interval: Vec<Condition>,
    ) -> Result<Vec<Goal>, String> {
        let mut alone = self.statements.clone().by(rule);
        alone.premises.retain(|premise| !holds(&premise.equation, &|_| true));
        alone.assume.extend(interval);
        let mut known: Vec<Equation> = Vec::new();
        let mut lemmas = Vec::new();
        for claim in claims {
            if known.contains(&claim) {
                continue;
            }
            known.push(claim.clone());
            let claim = self.with_sign(claim);
            let part = format!("{about}: {claim}");
            alone.claims = vec![claim];
            lemmas.push(Goal::of(&alone, self.symbols, part));
        }
        Ok(lemmas)
    }

    /// That the letter lies between the limits, these included or not; nothing where these are all numbers.
    fn interval(&self, is_closed: bool) -> Result<Vec<Condition>, String> {
        self.region([is_closed; 2])
    }

    /// That the letter lies between the limits, each of these included or not.
    fn region(&self, is_closed: [bool; 2]) -> Result<Vec<Condition>, String> {
        let letter = || symbol(self.letter);
        let related = |left: Tree, relation: Relation, right: &Tree| {
            Condition::Relation(Equation {
                relation,
                ..Equation::between(left, right.clone())
            })
        };
        let above = |place: usize| match is_closed.get(place) {
            Some(true) => Relation::GreaterOrEqual,
            _ => Relation::Greater,
        };
        let below = |place: usize| match is_closed.get(place) {
            Some(true) => Relation::LessOrEqual,
            _ => Relation::Less,
        };
        let [low, high] = self.limits;
        Ok(match (infinity(low), infinity(high), self.ends()) {
            (Some(false), Some(true), _) => Vec::new(),
            (None, Some(true), _) => vec![related(letter(), above(0), low)],
            (Some(false), None, _) => vec![related(letter(), below(1), high)],
            (None, None, Some([from, to])) if from < to => {
                vec![related(letter(), above(0), low), related(letter(), below(1), high)]
            }
            (None, None, Some(_)) => vec![related(letter(), below(0), low), related(letter(), above(1), high)],
            (None, None, None) => {
                let between = vec![difference(letter(), low.clone()), difference(letter(), high.clone())];
                let relation = match is_closed.contains(&true) {
                    true => Relation::LessOrEqual,
                    false => Relation::Less,
                };
                let open = self
                    .limits
                    .into_iter()
                    .zip(is_closed)
                    .filter(|(_, is_closed)| !is_closed);
                let open = open.filter(|_| relation == Relation::LessOrEqual);
                let open = open.map(|(limit, _)| related(letter(), Relation::NotEqual, limit));
                std::iter::once(related(product(between), relation, &integer(0)))
                    .chain(open)
                    .collect()
            }
            _ => return Err("an integral from infinity down, or to minus infinity".to_owned()),
        })
    }
}
