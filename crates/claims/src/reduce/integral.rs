//! Integrals: indefinite ones by differentiation, definite ones by an antiderivative whose own claims are lemmas.

use super::super::definition::CONSTANT_OF_INTEGRATION;
use super::super::premise::Statements;
use super::build::{
    call, difference, infinity, integer, is_zero, negative, plain, power, product, quotient, root, sum, symbol,
};
use super::cases::is_absolute;
use super::derivative::{By, mentions};
use super::evaluate::evaluated;
use super::gaussian::quadratic_exponential;
use super::germ::End;
use super::limit::of_limit;
use super::{Antiderivatives, Goal, Reduced, Rule, defined, fresh};
use numbers::{Field, Rational};
use texmath::{
    Condition, Elementary, Equation, Name, Operation, Relation, Symbols, Tree, any, any_side, holds, holds_indefinite,
    mapped, nodes_of, number_of, rewrite, speaks_of,
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

/// The terms of a side with their signs.
pub(super) fn terms(tree: &Tree, is_negative: bool, found: &mut Vec<(bool, Tree)>) {
    match tree {
        Tree::Sum(parts) => parts.iter().for_each(|part| terms(part, is_negative, found)),
        Tree::Negate(inner) => terms(inner, !is_negative, found),
        tree => found.push((is_negative, tree.clone())),
    }
}

fn integrand(tree: &Tree) -> Option<(&Tree, &Name)> {
    match tree {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Integral { of, by, limits: None } => Some((of, by)),
            _ => None,
        },
        _ => None,
    }
}

/// The claim with each definite integral replaced by the difference of an antiderivative, which holds where the lemmas
/// do; `None` where there is no such integral, or no antiderivative is found.
pub(super) fn by_antiderivatives(
    statements: &Statements,
    symbols: &Symbols,
    search: Antiderivatives,
) -> Result<Option<Reduced>, String> {
    let statements = &defined::with_domain(&gathered(statements, symbols)?, symbols);
    let is_complex = |tree: &Tree| symbols.may_be_complex(tree);
    let is_any_complex = super::trees(statements).into_iter().any(is_complex);
    let (mut found, mut lemmas, mut converging) = (Vec::<(Operation, Tree)>::new(), Vec::new(), Vec::new());
    for tree in super::trees(statements) {
        for operation in outermost(tree) {
            if found.iter().any(|(known, _)| *known == operation) {
                continue;
            }
            if is_any_complex {
                return Ok(None);
            }
            let Some(value) = value_of(&operation, statements, symbols, search)? else {
                return Ok(None);
            };
            lemmas.extend(value.lemmas);
            converging.extend(value.converging);
            found.push((operation, value.tree));
        }
    }
    if found.is_empty() {
        return Ok(None);
    }
    let without = super::rewritten(statements, Rule::IntegralAntiderivative, &|tree| replaced(tree, &found));
    let goal = Goal::of(&evaluated(&without, symbols)?, symbols, String::new());
    Ok(Some(Reduced {
        lemmas,
        sufficient: vec![goal],
        is_equivalent: true,
        converging,
        ..Reduced::default()
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

/// Returns true if all operations of statements are integrals of real functions of their letters alone, between numbers.
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
        ![of, low, high].into_iter().any(is_free)
            && ![low, high]
                .into_iter()
                .any(|limit| mentions(limit, by) || infinity(limit).is_some())
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
fn replaced(tree: &Tree, values: &[(Operation, Tree)]) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Operation(operation, _) => {
            let known = values.iter().find(|(known, _)| *known == **operation);
            known.map(|(_, value)| value.clone())
        }
        _ => None,
    })
}

/// The definite integrals in a tree that stand in no other one.
fn outermost(tree: &Tree) -> Vec<Operation> {
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
    search: Antiderivatives,
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
        search,
    };
    // the inner integrals first, at each number of the interval
    let (mut inner, mut lemmas, mut converging) = (Vec::new(), Vec::new(), Vec::new());
    let mut within = statements.clone();
    within.assume.extend(definite.interval(true)?);
    for operation in outermost(&definite.of) {
        let Some(value) = value_of(&operation, &within, &extended, search)? else {
            return Ok(None);
        };
        lemmas.extend(value.lemmas);
        // what an inner one needs may move with the letter
        converging.extend(value.converging.into_iter().filter(|own| !mentions(&own.left, &letter)));
        inner.push((operation, value.tree));
    }
    definite.of = replaced(&definite.of, &inner);
    if super::has_operation(&definite.of, symbols) {
        return Ok(None);
    }
    let found = match definite.changes_of_sign() {
        places if places.is_empty() => definite.value()?,
        places => definite.by_pieces(&places)?,
    };
    Ok(found.map(|mut value| {
        value.lemmas.extend(lemmas);
        value.converging.extend(converging);
        value
    }))
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

/// The constant and the slope of what is linear in a letter, with numbers.
fn linear(tree: &Tree, by: &Name, symbols: &Symbols) -> Option<[Rational; 2]> {
    let coefficients = super::gaussian::polynomial(tree, by, symbols)?;
    let numbers: Option<Vec<Rational>> = coefficients.iter().map(number_of).collect();
    numbers?.try_into().ok()
}

/// One definite integral, perhaps an improper one, which is the limit towards an infinite end.
struct Definite<'a> {
    statements: &'a Statements,
    symbols: &'a Symbols,
    /// What is integrated, without operations.
    of: Tree,
    /// What it is integrated by, which stands for any number of the interval.
    letter: &'a Name,
    limits: [&'a Tree; 2],
    search: Antiderivatives<'a>,
}

impl Definite<'_> {
    /// The numbers between limits that are numbers at which what is linear between bars changes its sign, in order.
    fn changes_of_sign(&self) -> Vec<Rational> {
        let ends = self.limits.map(number_of);
        let [Some(low), Some(high)] = ends else {
            return Vec::new();
        };
        let mut places: Vec<Rational> = Vec::new();
        any(&self.of, &mut |node| {
            if let Tree::Call(_, inner, _) = node
                && is_absolute(node)
                && let Some([constant, slope]) = linear(inner, self.letter, self.symbols)
                && slope != Rational::from_integer(0)
            {
                places.push(-constant / slope);
            }
            false
        });
        places.retain(|place| (low < *place && *place < high) || (high < *place && *place < low));
        places.sort_by(|one, other| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal));
        places.dedup();
        if high < low {
            places.reverse();
        }
        places
    }

    /// The sum of the integrals from one place to the next, on each of which what is between bars has a sign that is shown.
    fn by_pieces(&self, places: &[Rational]) -> Result<Option<Value>, String> {
        let [low, high] = self.limits;
        let inner = places.iter().map(|place| Tree::Number(place.clone()));
        let ends: Vec<Tree> = [low.clone()].into_iter().chain(inner).chain([high.clone()]).collect();
        let (mut terms, mut lemmas) = (Vec::new(), Vec::new());
        for (from, to) in ends.iter().zip(ends.iter().skip(1)) {
            let (of, signs) = self.without_bars(from, to);
            let piece = Definite {
                statements: self.statements,
                symbols: self.symbols,
                of,
                letter: self.letter,
                limits: [from, to],
                search: self.search,
            };
            lemmas.extend(piece.lemmas(Rule::IntegralPieces, "the sign", signs, piece.interval(true)?)?);
            let Some(value) = piece.value()? else {
                return Ok(None);
            };
            lemmas.extend(value.lemmas);
            terms.push(value.tree);
        }
        Ok(Some(Value {
            tree: sum(terms),
            lemmas,
            converging: Vec::new(),
        }))
    }

    /// The integrand with the signs that linear terms between bars have in the middle of a piece, and the claims that they have these signs.
    fn without_bars(&self, from: &Tree, to: &Tree) -> (Tree, Vec<Equation>) {
        let ends = [from, to].map(number_of);
        let middle = match ends {
            [Some(from), Some(to)] => (from + to) / Rational::from_integer(2),
            _ => return (self.of.clone(), Vec::new()),
        };
        let zero = Rational::from_integer(0);
        let signed = |node: &Tree| {
            let Tree::Call(_, inner, _) = node else { return None };
            let [constant, slope] = linear(inner, self.letter, self.symbols).filter(|_| is_absolute(node))?;
            let is_negative = constant + slope * middle.clone() < zero;
            Some((is_negative, (**inner).clone()))
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
        if let Some(found) = self.gaussian()? {
            return Ok(Some(found));
        }
        let Some(whole) = (self.search)(&self.of, self.letter, self.symbols) else {
            return Ok(None);
        };
        let slope = By {
            symbols: self.symbols,
            name: self.letter,
        }
        .of(&whole)?;
        // both are continuous on the whole interval, and one is the slope of the other within it
        let (rule, about) = (Rule::IntegralAntiderivative, "the antiderivative");
        let closed = self.conditions(&[&self.of, &whole])?;
        let mut lemmas = self.lemmas(rule, about, closed.clone(), self.interval(true)?)?;
        let mut within = self.conditions(&[&slope])?;
        within.retain(|condition| !closed.contains(condition));
        within.push(Equation::between(slope, self.of.clone()));
        lemmas.extend(self.lemmas(rule, about, within, self.interval(false)?)?);
        if nodes_of(&whole) > LARGEST {
            return Err("the value of an integral is too large".to_owned());
        }
        let [low, high] = self.limits;
        if self.limits.iter().all(|limit| infinity(limit).is_none()) && !speaks_of(&self.of, self.letter) {
            let length = difference(high.clone(), low.clone());
            return Ok(Some(Value {
                tree: product(vec![self.of.clone(), length]),
                lemmas,
                converging: Vec::new(),
            }));
        }
        let mut ends = Vec::new();
        let likely: Vec<Equation> = self.convergence().into_iter().collect();
        for limit in self.limits {
            ends.push(match infinity(limit) {
                None => rewrite(&whole, &|name| (name == self.letter).then(|| limit.clone())),
                Some(_) => {
                    // what does not move in the antiderivative has a value, by the lemmas
                    let found = of_limit(self.statements, self.symbols, &whole, self.letter, limit, &likely)?;
                    lemmas.extend(found.lemmas);
                    match found.end {
                        Some(End::Finite(value)) => *value,
                        _ => return Err("an integral that diverges, as far as it is followed".to_owned()),
                    }
                }
            });
        }
        let high = ends.pop().unwrap_or_else(|| integer(0));
        let low = ends.pop().unwrap_or_else(|| integer(0));
        Ok(Some(Value {
            tree: difference(high, low),
            lemmas,
            converging: likely,
        }))
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

    /// The integral of e^(c + b x - a x^2) over all numbers, which is e^(c + b^2/(4 a)) \sqrt{\pi/a} for positive a; half
    /// of it from 0 on, where b is 0.
    fn gaussian(&self) -> Result<Option<Value>, String> {
        let [low, high] = self.limits;
        let Some((factor, [constant, linear, square])) = quadratic_exponential(&self.of, self.letter, self.symbols)
        else {
            return Ok(None);
        };
        let is_half = match (infinity(low), infinity(high)) {
            (Some(false), Some(true)) => false,
            (None, Some(true)) if is_zero(low) && is_zero(&linear) => true,
            _ => return Ok(None),
        };
        let letter = symbol(self.letter);
        let exponent = sum(vec![
            constant.clone(),
            product(vec![linear.clone(), letter.clone()]),
            product(vec![square.clone(), power(letter, 2)]),
        ]);
        let mut claims = self.conditions(&[&self.of, &factor])?;
        let decays = Equation {
            relation: Relation::Less,
            ..Equation::between(square.clone(), integer(0))
        };
        claims.push(decays);
        claims.push(Equation::between(
            self.of.clone(),
            product(vec![factor.clone(), call("\\exp", exponent)]),
        ));
        let about = "the integral of a normal distribution";
        let lemmas = self.lemmas(Rule::IntegralGaussian, about, claims, self.interval(true)?)?;
        let least = quotient(power(linear, 2), product(vec![integer(4), square.clone()]));
        let pi = symbol(&plain("\\pi"));
        let value = product(vec![
            factor,
            call("\\exp", difference(constant, least)),
            root(quotient(pi, negative(square))),
        ]);
        let tree = if is_half { quotient(value, integer(2)) } else { value };
        Ok(Some(Value {
            tree,
            lemmas,
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
        Ok(needed)
    }

    /// The claims at each number of an interval, each as a goal of its own, once.
    fn lemmas(
        &self,
        rule: Rule,
        about: &str,
        claims: Vec<Equation>,
        interval: Option<Condition>,
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
            let part = format!("{about}: {claim}");
            alone.claims = vec![claim];
            lemmas.push(Goal::of(&alone, self.symbols, part));
        }
        Ok(lemmas)
    }

    /// That the letter lies between the limits, these included or not; nothing where these are all numbers.
    fn interval(&self, is_closed: bool) -> Result<Option<Condition>, String> {
        let [low, high] = self.limits;
        let letter = || symbol(self.letter);
        let (below, above) = match is_closed {
            true => (Relation::LessOrEqual, Relation::GreaterOrEqual),
            false => (Relation::Less, Relation::Greater),
        };
        let (left, relation, right) = match (infinity(low), infinity(high)) {
            (None, None) => {
                let between = vec![difference(letter(), low.clone()), difference(letter(), high.clone())];
                (product(between), below, integer(0))
            }
            (None, Some(true)) => (letter(), above, low.clone()),
            (Some(false), None) => (letter(), below, high.clone()),
            (Some(false), Some(true)) => return Ok(None),
            _ => return Err("an integral from infinity down, or to minus infinity".to_owned()),
        };
        Ok(Some(Condition::Relation(Equation {
            relation,
            ..Equation::between(left, right)
        })))
    }
}
