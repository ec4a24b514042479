//! Limits, and what is of an order, by the growth of functions.

use super::super::premise::Statements;
use super::build::{difference, infinity, integer, is_zero, negative, plain, quotient, sum, symbol};
use super::defined;
use super::derivative::mentions;
use super::germ::{End, Germs, SHORT, Wave};
use super::prepared::with_factorials;
use super::series::{add, point_of, relation};
use super::unbounded::{falsehood, has_value, of_infinity};
use super::{Goal, Rule, factorial, fresh, fresh_like, integers, is_spoken_of, rewritten, trees};
use std::collections::{BTreeSet, HashMap};
use texmath::{
    Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, holds, mapped, names_in, number_of, rewrite,
};

/// The numbers of terms of series that are tried, each where fewer do not tell.
const LENGTHS: [usize; 3] = [5, 12, 26];

/// Returns true if limits or orders stand in the statements.
pub(super) fn stands_in(statements: &Statements) -> bool {
    trees(statements).into_iter().any(|tree| {
        any(tree, &mut |node| {
            matches!(node, Tree::Operation(operation, _)
                if matches!(**operation, Operation::Limit { .. } | Operation::Order(..) | Operation::Approaches(_)))
        })
    })
}

/// Returns the statements without limits and orders, and what must hold for these to be what they are.
pub(super) fn evaluated(statements: &Statements, symbols: &Symbols) -> Result<(Statements, Vec<Goal>), String> {
    let mut out = rewritten(statements, Rule::BinomialFactorials, &with_factorials);
    let approached = approached(&mut out)?;
    let mut lemmas = Vec::new();
    // the innermost first
    while let Some(limit) = first_limit(&out) {
        let Operation::Limit { of, by, to } = &limit else {
            break;
        };
        let found = of_limit(&out, symbols, of, by, to, &[])?;
        if any(of, &mut |node| is_of_factorials(node)) {
            out = out.by(Rule::FactorialStirling);
        }
        out.claims.extend(
            found
                .written
                .into_iter()
                .map(|tree| Equation::between(tree.clone(), tree)),
        );
        lemmas.extend(found.lemmas);
        let Some(End::Finite(value)) = found.end else {
            out = without_value(&out, &limit, found.end.as_ref())?;
            continue;
        };
        out = rewritten(&out, Rule::LimitSeries, &|tree| {
            mapped(tree, &|node| match node {
                Tree::Operation(operation, _) if **operation == limit => Some((*value).clone()),
                _ => None,
            })
        });
    }
    let mut claims = Vec::new();
    for claim in std::mem::take(&mut out.claims) {
        if let Some(own) = of_infinity(&claim)? {
            claims.extend(own);
            continue;
        }
        if !holds(&claim, &|operation| matches!(operation, Operation::Order(..))) {
            claims.push(claim);
            continue;
        }
        let approached = approached.clone().or_else(|| implied(&claim, symbols));
        let (by, to) = approached.ok_or("what tends to what? write `x \\to 0` as an assumption")?;
        let (own, needed) = of_order(&out, symbols, &claim, &by, &to)?;
        out = out.by(Rule::OrderSeries);
        lemmas.extend(needed);
        claims.extend(own);
    }
    out.claims = claims;
    Ok((out, lemmas))
}

fn is_of_factorials(node: &Tree) -> bool {
    let is_binomial =
        |node: &Tree| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Binomial(..)));
    factorial::is_one(node) || is_binomial(node)
}

/// Returns the statements with a limit that is no number: infinity where it is one side of an equation. No equation of numbers holds
/// where one side is no limit at all.
fn without_value(statements: &Statements, limit: &Operation, end: Option<&End>) -> Result<Statements, String> {
    let is_limit = |tree: &Tree| matches!(tree, Tree::Operation(operation, _) if **operation == *limit);
    let mut out = statements.clone().by(Rule::LimitSeries);
    for claim in &mut out.claims {
        let other = match (is_limit(&claim.left), is_limit(&claim.right)) {
            (true, false) => claim.right.clone(),
            (false, true) => claim.left.clone(),
            _ => continue,
        };
        if claim.relation != Relation::Equal || any(&other, &mut |node| holds_limit(node)) {
            continue;
        }
        let infinite = Tree::Operation(Box::new(Operation::Infinity), claim.at);
        match end {
            Some(End::Infinite(is_positive)) => {
                claim.left = if *is_positive { infinite } else { negative(infinite) };
                claim.right = other;
            }
            _ if infinity(&other).is_some() => *claim = falsehood(),
            _ => {
                claim.left = infinite;
                claim.right = other;
            }
        }
    }
    let is_left = trees(&out)
        .into_iter()
        .any(|tree| any(tree, &mut |node| is_limit(node)));
    match is_left {
        true => Err("a limit that is infinite or does not exist".to_owned()),
        false => Ok(out),
    }
}

fn holds_limit(node: &Tree) -> bool {
    matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Limit { .. }))
}

/// Returns what tends to 0 in `a = 1 + x + O(x^2)`: beside an order, lower powers of the same symbol say so, for where it grows
/// they would be of that order themselves.
fn implied(claim: &Equation, symbols: &Symbols) -> Option<(Name, Tree)> {
    let Tree::Sum(terms) = &claim.right else {
        return None;
    };
    let order = |term: &Tree| match term {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Order(of, _) => Some(of.clone()),
            _ => None,
        },
        _ => None,
    };
    let (orders, lower): (Vec<&Tree>, Vec<&Tree>) = terms.iter().partition(|term| order(term).is_some());
    let (name, degree) = match order(orders.first()?)? {
        Tree::Symbol(name, _) => (name, 1),
        Tree::Power(base, degree, _) => match *base {
            Tree::Symbol(name, _) => (name, degree),
            _ => return None,
        },
        _ => return None,
    };
    let is_lower = |term: &&Tree| {
        let term = rewrite(term, &|name| symbols.meaning(name, &|_| false));
        degree_in(&term, &name).is_some_and(|own| own < degree)
    };
    let is_meant = orders.len() == 1 && !lower.is_empty() && lower.iter().all(is_lower);
    let is_number = symbols.is_parameter(&name) && !symbols.is_integer(&name);
    (is_meant && is_number).then_some((name, integer(0)))
}

/// Returns the power of a symbol that a term is a multiple of.
fn degree_in(tree: &Tree, name: &Name) -> Option<i32> {
    match tree {
        Tree::Symbol(other, _) if other == name => Some(1),
        tree if !mentions(tree, name) => Some(0),
        Tree::Negate(inner) => degree_in(inner, name),
        Tree::Product(factors) => factors.iter().map(|factor| degree_in(factor, name)).sum(),
        Tree::Quotient(above, below, _) if !mentions(below, name) => degree_in(above, name),
        Tree::Power(base, power @ 0.., _) => degree_in(base, name)?.checked_mul(*power),
        _ => None,
    }
}

/// Takes what is assumed to tend to something out of the assumptions.
fn approached(statements: &mut Statements) -> Result<Option<(Name, Tree)>, String> {
    let mut found = None;
    let mut rest = Vec::new();
    for condition in std::mem::take(&mut statements.assume) {
        let target = match &condition {
            Condition::Relation(relation) => match (&relation.left, &relation.right) {
                (Tree::Symbol(name, _), Tree::Operation(operation, _)) => match &**operation {
                    Operation::Approaches(to) => Some((name.clone(), to.clone())),
                    _ => None,
                },
                _ => None,
            },
            Condition::Integer(_) => None,
        };
        match target {
            Some(_) if found.is_some() => return Err("two quantities tend to something".to_owned()),
            Some(target) => found = Some(target),
            None => rest.push(condition),
        }
    }
    statements.assume = rest;
    Ok(found)
}

fn first_limit(statements: &Statements) -> Option<Operation> {
    let mut found = None;
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if let Tree::Operation(operation, _) = node
                && matches!(**operation, Operation::Limit { .. })
            {
                found = Some((**operation).clone());
            }
            false
        });
    }
    found
}

/// A limit with what must hold for it to be right.
pub(super) struct Limit {
    /// Nothing where there is none.
    pub end: Option<End>,
    pub lemmas: Vec<Goal>,
    /// Trees that do not move and must have a value.
    pub written: Vec<Tree>,
}

/// One function towards one side, and what is known of it there.
struct Side<'a> {
    germs: Germs<'a>,
    end: Option<End>,
}

/// A letter of statements that tends to something.
struct Approach<'a> {
    statements: &'a Statements,
    /// With the names that stand for what grows and what oscillates.
    symbols: Symbols,
    by: &'a Name,
    letter: Name,
    /// Names for functions that oscillate.
    waves: Vec<Name>,
    to: &'a Tree,
    /// Conditions that are likely to hold, of which nothing is known.
    likely: &'a [Equation],
}

impl<'a> Approach<'a> {
    fn of(statements: &'a Statements, symbols: &Symbols, by: &'a Name, to: &'a Tree) -> Result<Self, String> {
        if is_spoken_of(statements, symbols, by) || symbols.running() == Some(by) {
            return Err(format!(
                "premises speak of `{by}`: what depends on it there is not followed"
            ));
        }
        let is_complex = |tree: &Tree| symbols.may_be_complex(tree);
        if is_complex(&symbol(by)) || trees(statements).into_iter().any(is_complex) {
            return Err("limits of complex numbers are not read".to_owned());
        }
        if symbols.declares(&plain("\\pi")) {
            return Err(r"a limit where `\pi` is a letter".to_owned());
        }
        let mut symbols = symbols.clone();
        let letter = fresh(statements, &symbols, "x");
        symbols.let_be_parameter(&letter, true);
        let mut waves = Vec::new();
        for place in 1..=MOST_WAVES {
            let like = Name {
                subscript: place.to_string(),
                ..plain("y")
            };
            let wave = fresh_like(statements, &symbols, like);
            symbols.let_be_parameter(&wave, false);
            waves.push(wave);
        }
        let own = Self {
            statements,
            symbols,
            by,
            letter,
            waves,
            to,
            likely: &[],
        };
        match own.is_integer() && infinity(to).is_none() {
            true => Err(format!("`{by}` is an integer and tends to a number")),
            false => Ok(own),
        }
    }

    fn is_integer(&self) -> bool {
        self.symbols.is_integer(self.by) || integers::integers(self.statements, &self.symbols).contains(self.by)
    }

    /// Returns the letter by one that grows without bound: from above and from below, where it tends to a number.
    /// Sides that the conditions on the letter exclude are left out; true if it is not known which.
    fn sides(&self, conditions: &[Equation]) -> (Vec<Tree>, bool) {
        let (to, side) = match self.to {
            Tree::Operation(operation, _) => match &**operation {
                Operation::OneSided(to, is_above) => (to, Some(*is_above)),
                _ => (self.to, None),
            },
            to => (to, None),
        };
        let large = symbol(&self.letter);
        if let Some(is_above) = infinity(to) {
            return (vec![if is_above { large } else { negative(large) }], false);
        }
        let small = quotient(integer(1), large);
        let at = |small: Tree| {
            if is_zero(to) {
                small
            } else {
                sum(vec![to.clone(), small])
            }
        };
        let (above, below) = (at(small.clone()), at(negative(small)));
        let kept: Vec<Option<Option<bool>>> = match side {
            Some(is_above) => vec![Some(Some(is_above))],
            None => conditions.iter().map(|own| self.side_kept(own, to)).collect(),
        };
        let is_kept = |is_above: bool| !kept.contains(&Some(Some(!is_above)));
        let sides = [(above, true), (below, false)].into_iter();
        let sides = sides.filter(|(_, is_above)| is_kept(*is_above)).map(|(tree, _)| tree);
        (sides.collect(), kept.contains(&None))
    }

    /// Returns the side of a number on which a condition keeps the letter, true for above, `Some(None)` for both where it holds
    /// on both; `None` if that is not known.
    fn side_kept(&self, condition: &Equation, to: &Tree) -> Option<Option<bool>> {
        let is_own = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name == self.by);
        let is_left = is_own(&condition.left);
        let bound = match is_left {
            true => &condition.right,
            false if is_own(&condition.right) => &condition.left,
            false => return None,
        };
        let is_above = match condition.relation {
            Relation::Greater | Relation::GreaterOrEqual => is_left,
            Relation::Less | Relation::LessOrEqual => !is_left,
            Relation::NotEqual => return Some(None),
            Relation::Equal => return None,
        };
        match (number_of(bound), number_of(to)) {
            _ if bound == to => Some(Some(is_above)),
            (Some(bound), Some(at)) if bound != at && (at > bound) == is_above => Some(None),
            _ => None,
        }
    }

    /// Returns the conditions on the letter that are declared, and those that are assumed.
    fn conditions(&self) -> [Vec<Equation>; 2] {
        let mut declared = Vec::new();
        let own = || symbol(self.by);
        if self.symbols.is_positive(self.by) || self.symbols.is_nonnegative(self.by) {
            declared.push(relation(own(), Relation::GreaterOrEqual));
        }
        if self.symbols.is_at_most_one(self.by) {
            declared.push(relation(difference(own(), integer(1)), Relation::LessOrEqual));
        }
        let assumed = self.statements.assume.iter().filter_map(|condition| match condition {
            Condition::Relation(relation) => Some(relation.clone()),
            Condition::Integer(_) => None,
        });
        let speaks = |own: &Equation| mentions(&own.left, self.by) || mentions(&own.right, self.by);
        [declared, assumed.filter(speaks).collect()]
    }

    fn germs(&self, of: &Tree, length: usize) -> Germs<'_> {
        let statements = self.statements;
        let spoken = |name: &Name| {
            let premises = statements.premises.iter().map(|premise| &premise.equation);
            let equations = premises.chain(&self.symbols.relations);
            let mut sides = equations.flat_map(|equation| [&equation.left, &equation.right]);
            sides.any(|side| {
                any(
                    side,
                    &mut |node| matches!(node, Tree::Call(other, ..) | Tree::Symbol(other, _) if other.bare() == name.bare()),
                )
            })
        };
        let functions = self.symbols.functions().map(|(name, _)| name);
        let mut names = BTreeSet::new();
        names_in(of, &mut names);
        names_in(self.to, &mut names);
        trees(statements)
            .into_iter()
            .for_each(|tree| names_in(tree, &mut names));
        names.remove(&self.letter);
        let conditions = statements.assume.iter().filter_map(|condition| match condition {
            Condition::Relation(relation) => Some(relation),
            Condition::Integer(_) => None,
        });
        let domain = self.domain(&[]);
        let conditions: Vec<&Equation> = conditions.chain(&domain).chain(self.likely).collect();
        let is_said = |name: &Name| {
            let is_in = |own: &&Equation| own.left.has_free(name) || own.right.has_free(name);
            spoken(name) || conditions.iter().any(is_in)
        };
        let is_unsigned = |name: &Name| {
            self.symbols.is_parameter(name) && !self.symbols.is_positive(name) && !self.symbols.is_nonnegative(name)
        };
        let unsigned = names.iter().filter(|name| is_unsigned(name) && !is_said(name));
        Germs {
            symbols: &self.symbols,
            given: functions.filter(|name| spoken(name)).cloned().collect(),
            letter: self.letter.clone(),
            by: self.by.clone(),
            names: self.waves.clone(),
            is_integer: self.is_integer(),
            unsigned: unsigned.cloned().collect(),
            point: point_of(&names.into_iter().collect::<Vec<Name>>(), &conditions, &self.symbols),
            length,
            needed: Vec::new(),
            written: Vec::new(),
            waves: Vec::new(),
            is_one_sided: false,
            limits: HashMap::new(),
            steps: 0,
            depth: 0,
        }
    }

    /// Returns conditions that hold wherever the claims and what is written have a value.
    fn domain(&self, written: &[Tree]) -> Vec<Equation> {
        let mut found = Vec::new();
        // a way of an equivalence is to be shown to have a value
        if self.statements.is_way {
            return found;
        }
        let sides = self
            .statements
            .claims
            .iter()
            .flat_map(|claim| [&claim.left, &claim.right]);
        sides
            .chain(written)
            .for_each(|tree| defined::necessary(tree, &mut found));
        found.retain(|own| !mentions(&own.left, self.by) && !mentions(&own.right, self.by));
        found
    }

    /// Returns the result of work on a function towards one side, with as many terms as it takes.
    fn followed<T>(
        &'a self,
        of: &Tree,
        side: &Tree,
        work: &dyn Fn(&mut Germs<'a>, &Tree) -> Result<T, String>,
    ) -> Result<(T, Germs<'a>), String> {
        let of = rewrite(of, &|name| (name == self.by).then(|| side.clone()));
        let mut reason = SHORT.to_owned();
        for length in LENGTHS {
            let mut germs = self.germs(&of, length);
            let found = germs.prepared(&of).and_then(|prepared| work(&mut germs, &prepared));
            match found {
                Ok(found) => return Ok((found, germs)),
                Err(short) if short == SHORT => reason = short,
                Err(reason) => return Err(reason),
            }
        }
        Err(reason)
    }

    /// Returns the limit towards one side; none where what oscillates has an effect.
    fn one_sided(&'a self, of: &Tree, side: &Tree) -> Result<Side<'a>, String> {
        let (end, mut germs) = self.followed(of, side, &|germs, prepared| germs.limit(prepared))?;
        let end = match end {
            End::Finite(value) if germs.oscillates(&value) => {
                let waves = std::mem::take(&mut germs.waves);
                let [
                    Wave {
                        name,
                        full: Some(needed),
                        ..
                    },
                ] = waves.as_slice()
                else {
                    return Err("what oscillates has an effect on the limit".to_owned());
                };
                let at = |place: i64| rewrite(&value, &|other| (other == name).then(|| integer(place)));
                let difference = add(vec![at(1), negative(at(-1))]);
                germs.need(relation(difference, Relation::NotEqual));
                needed.iter().for_each(|condition| germs.need(condition.clone()));
                None
            }
            end => Some(end),
        };
        Ok(Side { germs, end })
    }

    /// Returns each condition as a goal of its own: in one statement they would be taken to be defined together.
    fn goals(&self, needed: Vec<Equation>, written: &[Tree]) -> Vec<Goal> {
        let mut base = self.statements.clone().by(Rule::LimitSeries);
        base.premises.retain(|premise| !holds(&premise.equation, &|_| true));
        let domain = self.domain(written);
        let own = |name: &Name| {
            let tree = symbol(name);
            if *name == self.letter {
                return Some(relation(difference(tree, integer(1)), Relation::Greater));
            }
            let square = difference(super::build::power(tree, 2), integer(1));
            self.waves
                .contains(name)
                .then(|| relation(square, Relation::LessOrEqual))
        };
        let goal = |condition: Equation| {
            let mut alone = base.clone();
            let part = format!("the series: {condition}");
            let mut names = BTreeSet::new();
            names_in(&condition.left, &mut names);
            names_in(&condition.right, &mut names);
            let further = names.iter().filter_map(own).chain(domain.iter().cloned());
            for assumed in further.map(Condition::Relation) {
                if !alone.assume.contains(&assumed) {
                    alone.assume.push(assumed);
                }
            }
            alone.claims = vec![condition];
            Goal::of(&alone, &self.symbols, part)
        };
        needed.into_iter().map(goal).collect()
    }
}

/// The most functions in a limit that oscillate.
const MOST_WAVES: usize = 4;

/// Returns a name in a tree that carries a letter as an index.
pub(super) fn carried(of: &Tree, by: &Name) -> Option<Name> {
    let is_carried = |name: &Name| name.subscript.split([',', ' ']).any(|part| part == by.to_string());
    let mut found = None;
    any(of, &mut |node| {
        if let Tree::Symbol(name, _) = node {
            found = found.take().or_else(|| is_carried(name).then(|| name.clone()));
        }
        found.is_some()
    });
    found
}

/// Returns the limit of a tree, where conditions hold that are likely.
pub(super) fn of_limit(
    statements: &Statements,
    symbols: &Symbols,
    of: &Tree,
    by: &Name,
    to: &Tree,
    likely: &[Equation],
) -> Result<Limit, String> {
    let of = rewrite(of, &|name| symbols.meaning(name, &|_| false));
    if let Some(name) = carried(&of, by) {
        return Err(format!("`{name}` may move with `{by}`"));
    }
    let approach = Approach {
        likely,
        ..Approach::of(statements, symbols, by, to)?
    };
    let mut needed = Vec::new();
    let mut written = Vec::new();
    let mut keep = |germs: Germs| {
        needed.extend(germs.needed);
        for tree in germs.written {
            if !written.contains(&tree) {
                written.push(tree);
            }
        }
    };
    let [declared, assumed] = approach.conditions();
    let (sides, mut is_open) = approach.sides(&declared);
    is_open |= sides.len() > 1 && !assumed.is_empty();
    let mut sides = sides.into_iter();
    let first = sides.next().ok_or("no side")?;
    let first = approach.one_sided(&of, &first)?;
    let is_same = !first.germs.is_one_sided && matches!(first.end, Some(End::Finite(_)));
    if is_open && !is_same {
        return Err(format!("from which side `{by}` comes is not known"));
    }
    let mut end = first.end;
    keep(first.germs);
    if let Some(second) = sides.next().filter(|_| !is_same) {
        let mut second = approach.one_sided(&of, &second)?;
        end = match (end, second.end) {
            (Some(End::Finite(above)), Some(End::Finite(below))) => {
                let difference = add(vec![(*above).clone(), negative(*below)]);
                let is_equal = second.germs.is_likely_zero(&difference);
                let relates = if is_equal { Relation::Equal } else { Relation::NotEqual };
                second.germs.need(relation(difference, relates));
                is_equal.then_some(End::Finite(above))
            }
            (above, below) => above.filter(|above| Some(above) == below.as_ref()),
        };
        keep(second.germs);
    }
    let lemmas = approach.goals(needed, &written);
    Ok(Limit { end, lemmas, written })
}

/// Returns the difference of the sides of a claim without its orders, and these orders.
fn without_orders(claim: &Equation) -> Result<(Tree, Vec<(Tree, bool)>), String> {
    let is_order =
        |node: &Tree| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Order(..)));
    if claim.relation != Relation::Equal {
        return Err("an order in an inequality".to_owned());
    }
    if any(&claim.left, &mut |node| is_order(node)) {
        return Err("an order on the left of an equation".to_owned());
    }
    let terms = match &claim.right {
        Tree::Sum(terms) => terms.clone(),
        side => vec![side.clone()],
    };
    let (mut orders, mut rest) = (Vec::new(), Vec::new());
    for term in terms {
        let inner = match &term {
            Tree::Negate(inner) => inner,
            term => term,
        };
        match inner {
            Tree::Operation(operation, _) => match &**operation {
                Operation::Order(of, is_little) => orders.push((of.clone(), *is_little)),
                _ => rest.push(term.clone()),
            },
            _ => rest.push(term.clone()),
        }
    }
    let all = difference(claim.left.clone(), sum(rest));
    match any(&all, &mut |node| is_order(node)) {
        true => Err("an order within a product or a function".to_owned()),
        false => Ok((all, orders)),
    }
}

/// Reduces the claim that both sides differ by what is of an order: their difference divided by it stays bounded, so each coefficient
/// of what grows vanishes.
fn of_order(
    statements: &Statements,
    symbols: &Symbols,
    claim: &Equation,
    by: &Name,
    to: &Tree,
) -> Result<(Vec<Equation>, Vec<Goal>), String> {
    let (all, orders) = without_orders(claim)?;
    let is_single = orders.len() == 1;
    let meant = |tree: &Tree| rewrite(tree, &|name| symbols.meaning(name, &|_| false));
    let approach = Approach::of(statements, symbols, by, to)?;
    let (mut claims, mut needed, mut written) = (Vec::new(), Vec::new(), Vec::new());
    let (sides, is_open) = approach.sides(&approach.conditions().concat());
    for side in &sides {
        let mut orders = orders.iter().map(|(order, is_little)| (meant(order), *is_little));
        let (mut order, mut is_little) = orders.next().ok_or("an order of nothing")?;
        // the largest of the orders bounds all of them
        for (other, is_other_little) in orders {
            let ratio = quotient(order.clone(), other.clone());
            let compare = |germs: &mut Germs, prepared: &Tree| {
                let end = germs.limit(prepared)?;
                match &end {
                    End::Finite(ratio) if germs.oscillates(ratio) => Err("orders that oscillate".to_owned()),
                    End::Finite(ratio) if !is_zero(ratio) => germs.nonzero(ratio).map(|()| end),
                    _ => Ok(end),
                }
            };
            let (end, germs) = approach.followed(&ratio, side, &compare)?;
            needed.extend(germs.needed);
            match end {
                End::Finite(ratio) if is_zero(&ratio) => (order, is_little) = (other, is_other_little),
                End::Finite(_) => is_little &= is_other_little,
                End::Infinite(_) => {}
            }
        }
        // one that moves is not 0 where the ratio is followed
        if !mentions(&order, by) {
            needed.push(relation(order.clone(), Relation::NotEqual));
        }
        let ratio = quotient(meant(&all), order);
        let (own, germs) = approach.followed(&ratio, side, &|germs, prepared| germs.unbounded(prepared, is_little))?;
        claims.extend(own.into_iter().map(|term| Equation {
            left: term,
            right: integer(0),
            ..claim.clone()
        }));
        needed.extend(germs.needed);
        written.extend(germs.written);
        if !germs.is_one_sided && is_single {
            break;
        }
        if is_open {
            return Err(format!("from which side `{by}` comes is not known"));
        }
    }
    if claims.is_empty() {
        claims.push(Equation::between(integer(0), integer(0)));
    }
    // the claim does not write the ratio, so that this may have no value where the claim has one
    let lemmas = approach.goals(needed, &[claim.left.clone(), claim.right.clone()]);
    claims.extend(written.into_iter().map(has_value));
    Ok((claims, lemmas))
}
