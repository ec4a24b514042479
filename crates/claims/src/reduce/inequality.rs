//! Inequalities in one letter by Taylor's theorem with Lagrange's remainder, and by concavity: what must hold at a point,
//! and the sign of one derivative beside it.
//!
//! With `f` the larger side less the smaller one: where `f, f', ..., f^(m-1)` are not negative at c and `f^(m)` is not
//! beyond it, `f(x) = f(c) + ... + f^(m-1)(c) (x-c)^(m-1)/(m-1)! + f^(m)(y) (x-c)^m/m!` is not negative for x > c
//! (Whittaker and Watson, A Course of Modern Analysis, section 5.4); likewise below c with alternating signs. A function
//! that is concave on an interval is at least the smaller of its values at the ends.

use super::super::premise::Statements;
use super::build::{difference, integer, negative, plain, product, quotient, sum, symbol};
use super::derivative::{By, mentions};
use super::series::{guess_at, ratio, seed};
use super::{
    Goal, Rule, bounds, defined, factorial, fresh_like, has_operation, is_spoken_of, ranges, trees, written_out,
};
use texmath::{
    Condition, Elementary, Equation, Name, Parity, Relation, Symbols, Tree, any, mapped, nodes_of, number_of, rewrite,
};

/// The highest derivative, the largest in nodes, and the most ways that are tried.
const HIGHEST: usize = 6;
const LARGEST: usize = 600;
const MOST_WAYS: usize = 6;
const MOST_ORDERS: usize = 3;
const MOST_SIDES: usize = 3;

/// Where signs are looked at before anything is claimed, as parts of the way to the end, and how far they may be off.
const FRACTIONS: [f64; 7] = [0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99];
const SLACK: f64 = 1e-9;
const SHIFTS: [f64; 6] = [0.0, 1.0, -1.5, 3.0, -0.4, 10.0];

/// Where the letter may be, as relations with the letter on their left: no value of it is beyond them.
struct Range {
    letter: Name,
    bounds: Vec<(Relation, Tree)>,
    /// What the letter is not.
    excluded: Vec<Tree>,
}

/// An inequality as `f > 0` or `f >= 0`.
struct Positive {
    function: Tree,
    is_strict: bool,
}

/// Goals that are enough together.
type Way = Vec<Goal>;

/// Alternatives to prove the claims: each a list of parts that are enough together, each with its ways.
pub fn alternatives(statements: &Statements, symbols: &Symbols) -> Vec<Vec<Vec<Way>>> {
    let first = ways(statements, symbols);
    let mut found: Vec<Vec<Vec<Way>>> = (!first.is_empty()).then_some(first).into_iter().collect();
    let (Ok(written), [_]) = (written_out(statements, symbols), statements.claims.as_slice()) else {
        return found;
    };
    let is_other = |tree: &Tree| symbols.may_be_complex(tree) || has_operation(tree, symbols);
    if !trees(&written).into_iter().any(is_other)
        && let [claim] = written.claims.as_slice()
    {
        let parts = Parts {
            statements: &written,
            symbols,
            letters: letters(&written, symbols),
        };
        found.extend(parts.of_value(claim));
        found.extend(parts.on_both_sides(claim));
    }
    found
}

/// A claim by parts of the values of a letter.
struct Parts<'a> {
    statements: &'a Statements,
    symbols: &'a Symbols,
    letters: Vec<Name>,
}

impl Parts<'_> {
    /// That what is given holds somewhere, where a letter has a value if one is named.
    fn somewhere(&self, value: Option<(&Name, &Tree)>) -> Vec<Way> {
        let mut alone = self.statements.clone();
        let written = alone
            .claims
            .iter()
            .map(|claim| difference(claim.left.clone(), claim.right.clone()));
        alone.claims = written.map(|tree| Equation::between(tree.clone(), tree)).collect();
        if let Some((letter, value)) = value {
            let there =
                |tree: &Tree| with_known_values(&rewrite(tree, &|name| (name == letter).then(|| value.clone())));
            alone = super::rewritten(&alone, Rule::InequalityDerivatives, &there);
            alone.assume.retain(|condition| match condition {
                Condition::Relation(own) => super::instances::relation_holds(own) != Some(true),
                Condition::Integer(_) => true,
            });
        }
        let part = "what is given holds somewhere".to_owned();
        vec![vec![Goal::of(&alone, self.symbols, part)]]
    }

    /// The ways to show that a function is positive under further bounds of a letter.
    fn ways(&self, statements: &Statements, letter: &Name, function: &Positive, bounds: &[Equation]) -> Vec<Way> {
        let mut within = statements.clone().by(Rule::InequalityDerivatives);
        within.assume.extend(bounds.iter().cloned().map(Condition::Relation));
        let kind = match function.is_strict {
            true => Relation::Greater,
            false => Relation::GreaterOrEqual,
        };
        within.claims = vec![relation(function.function.clone(), kind)];
        let printed: Vec<String> = bounds.iter().map(ToString::to_string).collect();
        let whole = Goal::of(&within, self.symbols, format!("for {}", printed.join(", ")));
        let mut all = in_letter(&within, self.symbols, function, letter, &self.letters);
        all.truncate(MOST_SIDES);
        all.extend(bounds::ways(&whole, &in_letter_of));
        all
    }

    /// An inequality in one letter on both sides of 1 or of -1.
    fn on_both_sides(&self, claim: &Equation) -> Vec<Vec<Vec<Way>>> {
        let (Some(function), [letter]) = (positive(claim), self.letters.as_slice()) else {
            return Vec::new();
        };
        let at = |point: i64| {
            let bound = |kind| Equation {
                relation: kind,
                ..Equation::between(symbol(letter), integer(point))
            };
            let mut parts: Vec<Vec<Way>> = [Relation::LessOrEqual, Relation::GreaterOrEqual]
                .into_iter()
                .map(|kind| self.ways(self.statements, letter, &function, &[bound(kind)]))
                .collect();
            parts.push(self.somewhere(None));
            parts
        };
        let is_any = |parts: &Vec<Vec<Way>>| parts.iter().all(|ways| !ways.is_empty());
        [1, -1].into_iter().map(at).filter(is_any).collect()
    }

    /// That a letter has a value wherever an equation that is assumed holds: on either side of the value one side of the
    /// equation is the larger one.
    fn of_value(&self, claim: &Equation) -> Vec<Vec<Vec<Way>>> {
        let (letter, value) = match (&claim.left, &claim.right) {
            (Tree::Symbol(name, _), value) | (value, Tree::Symbol(name, _)) => (name, value),
            _ => return Vec::new(),
        };
        if claim.relation != Relation::Equal || value.has_free(letter) || !self.letters.contains(letter) {
            return Vec::new();
        }
        let assumed = self.statements.assume.iter().enumerate();
        let equations = assumed.filter_map(|(place, condition)| match condition {
            Condition::Relation(own) if own.relation == Relation::Equal => Some((place, own)),
            _ => None,
        });
        let speaks = |own: &Equation| own.left.has_free(letter) || own.right.has_free(letter);
        let mut found = Vec::new();
        for (place, equation) in equations.filter(|(_, own)| speaks(own)) {
            let mut without = self.statements.clone();
            without.assume.remove(place);
            for is_split in [false, true] {
                let mut parts = self.beside(&without, letter, value, equation, is_split);
                parts.push(self.somewhere(Some((letter, value))));
                if parts.iter().all(|ways| !ways.is_empty()) {
                    found.push(parts);
                }
            }
        }
        found
    }

    /// The parts of the values of a letter beside one: on both sides of it, or each side near and far.
    fn beside(
        &self,
        without: &Statements,
        letter: &Name,
        value: &Tree,
        equation: &Equation,
        is_split: bool,
    ) -> Vec<Vec<Way>> {
        let to = |relation: Relation, bound: Tree| Equation {
            relation,
            ..Equation::between(symbol(letter), bound)
        };
        let mut parts = Vec::new();
        for (away, near, far, step) in [
            (Relation::Greater, Relation::LessOrEqual, Relation::GreaterOrEqual, 1),
            (Relation::Less, Relation::GreaterOrEqual, Relation::LessOrEqual, -1),
        ] {
            // the near part and the far one overlap, for 3/2 is less than half of pi
            let middle = |distance: Tree| match step > 0 {
                true => sum(vec![value.clone(), distance]),
                false => difference(value.clone(), distance),
            };
            let half_pi = quotient(symbol(&plain("\\pi")), integer(2));
            let bounds = match is_split {
                true => vec![
                    vec![to(away, value.clone()), to(near, middle(half_pi))],
                    vec![to(far, middle(ratio(3, 2)))],
                ],
                false => vec![vec![to(away, value.clone())]],
            };
            for bounds in bounds {
                let sides = [(&equation.left, &equation.right), (&equation.right, &equation.left)];
                let ways = sides.into_iter().flat_map(|(larger, smaller)| {
                    let function = Positive {
                        function: difference(larger.clone(), smaller.clone()),
                        is_strict: true,
                    };
                    self.ways(without, letter, &function, &bounds)
                });
                parts.push(ways.collect());
            }
        }
        parts
    }
}

/// Ways to prove each claim; empty where none is of this kind.
fn ways(statements: &Statements, symbols: &Symbols) -> Vec<Vec<Way>> {
    let Ok(written) = written_out(statements, symbols) else {
        return Vec::new();
    };
    let is_other = |tree: &Tree| symbols.may_be_complex(tree) || has_operation(tree, symbols);
    if trees(&written).into_iter().any(is_other) {
        return Vec::new();
    }
    let letters = letters(&written, symbols);
    let alone = |claim: Equation, part: String| {
        let mut alone = written.clone();
        alone.claims = vec![claim];
        Goal::of(&alone, symbols, part)
    };
    let mut is_any = false;
    let of_claim = |claim: &Equation| {
        let mut own = ranges::ways(&written, symbols, claim);
        // what has a sign is not 0
        let strict = |relation: Relation| Equation {
            relation,
            ..claim.clone()
        };
        let signs = match claim.relation {
            Relation::NotEqual => vec![strict(Relation::Greater), strict(Relation::Less)],
            _ => vec![claim.clone()],
        };
        for claim in &signs {
            if signs.len() > 1 {
                let mut signed = written.clone().by(Rule::InequalityDerivatives);
                signed.claims = vec![claim.clone()];
                own.push(vec![Goal::of(&signed, symbols, claim.to_string())]);
            }
            if let Some(positive) = positive(claim) {
                let ways = |letter| in_letter(&written, symbols, &positive, letter, &letters);
                own.extend(letters.iter().flat_map(ways).take(MOST_WAYS));
                own.extend(bounds::ways(&alone(claim.clone(), String::new()), &in_letter_of));
            }
        }
        // what is given must hold somewhere, all of it together
        let written = difference(claim.left.clone(), claim.right.clone());
        let defined = Equation::between(written.clone(), written);
        let goal = alone(defined, "what is given holds somewhere".to_owned());
        own.iter_mut().for_each(|way| way.push(goal.clone()));
        match own.is_empty() {
            true => vec![vec![alone(claim.clone(), claim.to_string())]],
            false => {
                is_any = true;
                own
            }
        }
    };
    let all = written.claims.iter().map(of_claim).collect();
    if is_any { all } else { Vec::new() }
}

/// The letters by which a claim may be differentiated.
fn letters(statements: &Statements, symbols: &Symbols) -> Vec<Name> {
    let integers = super::integers::integers(statements, symbols);
    let is_met = |name: &Name| {
        let mut sides = statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
        sides.any(|side| mentions(side, name))
    };
    let is_plain = |name: &&Name| {
        let is_number = !integers.contains(name) && !symbols.is_integer(name);
        let is_alone = symbols.is_single(name) && symbols.running() != Some(name);
        is_number && is_alone && is_met(name) && !is_spoken_of(statements, symbols, name)
    };
    symbols.parameters().filter(is_plain).cloned().collect()
}

fn positive(claim: &Equation) -> Option<Positive> {
    let (larger, smaller) = match claim.relation {
        Relation::Greater | Relation::GreaterOrEqual => (&claim.left, &claim.right),
        Relation::Less | Relation::LessOrEqual => (&claim.right, &claim.left),
        Relation::Equal | Relation::NotEqual => return None,
    };
    Some(Positive {
        function: difference(larger.clone(), smaller.clone()),
        is_strict: matches!(claim.relation, Relation::Greater | Relation::Less),
    })
}

impl Range {
    fn of(statements: &Statements, symbols: &Symbols, letter: &Name) -> Self {
        let mut bounds = Vec::new();
        let mut excluded = Vec::new();
        let lists = [
            (symbols.is_positive(letter), Relation::Greater, 0),
            (symbols.is_nonnegative(letter), Relation::GreaterOrEqual, 0),
            (symbols.is_at_most_one(letter), Relation::Greater, 0),
            (symbols.is_at_most_one(letter), Relation::LessOrEqual, 1),
        ];
        for (is_listed, relation, bound) in lists {
            if is_listed {
                bounds.push((relation, integer(bound)));
            }
        }
        if symbols.is_nonzero(letter) {
            excluded.push(integer(0));
        }
        let is_letter = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name == letter);
        for condition in &statements.assume {
            let Condition::Relation(relation) = condition else {
                continue;
            };
            let (other, kind) = match (is_letter(&relation.left), is_letter(&relation.right)) {
                (true, false) => (&relation.right, relation.relation),
                (false, true) => (&relation.left, relation.relation.turned()),
                _ => continue,
            };
            match kind {
                _ if other.has_free(letter) => {}
                Relation::NotEqual => excluded.push(other.clone()),
                Relation::Equal => {}
                kind => bounds.push((kind, other.clone())),
            }
        }
        Self {
            letter: letter.clone(),
            bounds,
            excluded,
        }
    }

    /// The same where this has a value: logarithms and roots of the letter, or of the letter and a number.
    fn within_domain_of(mut self, function: &Tree) -> Self {
        let mut bounds = Vec::new();
        any(function, &mut |node| {
            let (argument, strict) = match node {
                Tree::Call(name, argument, _) if name.base == "\\ln" => (argument, true),
                Tree::Root(of, index, _) if index % 2 == 0 => (of, false),
                _ => return false,
            };
            if let Some((slope @ (..=-1 | 1..), offset)) = factorial::multiple_of(argument, &self.letter) {
                let kind = match (slope > 0, strict) {
                    (true, true) => Relation::Greater,
                    (true, false) => Relation::GreaterOrEqual,
                    (false, true) => Relation::Less,
                    (false, false) => Relation::LessOrEqual,
                };
                bounds.push((kind, ratio(-offset, slope)));
            }
            false
        });
        self.bounds.extend(bounds);
        self
    }

    fn side(&self, is_above: bool) -> impl Iterator<Item = &(Relation, Tree)> {
        let is_own = move |relation: &Relation| match is_above {
            true => matches!(relation, Relation::Less | Relation::LessOrEqual),
            false => matches!(relation, Relation::Greater | Relation::GreaterOrEqual),
        };
        self.bounds.iter().filter(move |(relation, _)| is_own(relation))
    }

    /// Whether the letter is not this.
    fn excludes(&self, point: &Tree) -> bool {
        let is_strict = |(relation, bound): &(Relation, Tree)| {
            matches!(relation, Relation::Less | Relation::Greater) && bound == point
        };
        self.excluded.contains(point) || self.bounds.iter().any(is_strict)
    }

    /// Whether the letter is nowhere beyond a point on this side.
    fn ends_at(&self, point: &Tree, is_above: bool) -> bool {
        self.side(is_above).any(|(_, bound)| bound == point)
    }

    /// Points that may be a smallest value: the bounds, 0, 1 and the other letters.
    fn points(&self, letters: &[Name]) -> Vec<Tree> {
        let mut points: Vec<Tree> = Vec::new();
        let bounds = self.bounds.iter().map(|(_, bound)| bound.clone());
        let others = letters.iter().filter(|other| **other != self.letter).map(symbol);
        for point in bounds.chain([integer(0), integer(1)]).chain(others) {
            if !points.contains(&point) {
                points.push(point);
            }
        }
        points
    }
}

/// A question about one letter of a claim: what is posed, of which letter, over which numbers.
struct Question<'a> {
    /// What is given that does not speak of the letter.
    given: &'a Statements,
    symbols: &'a Symbols,
    range: &'a Range,
    /// The letter that stands for the numbers between a point and the letter of the claim.
    between: &'a Name,
    is_strict: bool,
    /// What is added to the numbers that stand for the other letters, so that what is given holds of them.
    shift: f64,
    /// The function and its derivatives by `between`.
    derivatives: Vec<Tree>,
}

/// The ways to prove a goal in a letter of it.
fn in_letter_of(goal: &Goal, letter: &Name) -> Vec<Way> {
    let claim = goal.statements.claims.first();
    let positive = claim.and_then(positive);
    let ways = |positive| in_letter(&goal.statements, &goal.symbols, &positive, letter, &[]);
    positive.map_or_else(Vec::new, ways)
}

fn in_letter(
    statements: &Statements,
    symbols: &Symbols,
    positive: &Positive,
    letter: &Name,
    others: &[Name],
) -> Vec<Vec<Goal>> {
    let is_unknown = |node: &Tree| match node {
        Tree::Call(name, argument, _) => {
            (symbols.is_function(name) || symbols.is_in_flight(name)) && mentions(argument, letter)
        }
        _ => false,
    };
    if !mentions(&positive.function, letter) || any(&positive.function, &mut |node| is_unknown(node)) {
        return Vec::new();
    }
    let range = Range::of(statements, symbols, letter).within_domain_of(&positive.function);
    let between = fresh_like(statements, symbols, letter.clone());
    let mut extended = symbols.clone();
    extended.let_be_parameter(&between, false);
    let mut given = statements.clone();
    let is_of_letter = |condition: &Condition| condition.sides().into_iter().any(|side| side.has_free(letter));
    given.assume.retain(|condition| !is_of_letter(condition));
    let mut found = Vec::new();
    for (function, denominator) in [(positive.function.clone(), None)]
        .into_iter()
        .chain(cleared(&positive.function))
    {
        let Ok(derivatives) = derivatives(&function, letter, &between, &extended) else {
            continue;
        };
        let question = Question {
            given: &given,
            symbols: &extended,
            range: &range,
            between: &between,
            is_strict: positive.is_strict,
            shift: shift(&given),
            derivatives,
        };
        let mut ways: Vec<Vec<Goal>> = question.by_concavity().into_iter().collect();
        let points = range.points(others);
        for later in 0..MOST_ORDERS {
            ways.extend(points.iter().filter_map(|point| question.by_taylor(point, later)));
        }
        // a quotient has the sign of its numerator where its denominator is positive
        if let Some(below) = denominator {
            let mut alone = statements.clone().by(Rule::InequalityDerivatives);
            alone.claims = vec![relation(below, Relation::Greater)];
            let goal = Goal::of(&alone, symbols, "the denominator is positive".to_owned());
            ways.iter_mut().for_each(|way| way.push(goal.clone()));
        }
        found.extend(ways);
        if !found.is_empty() {
            break;
        }
    }
    found
}

/// The step that shows that a function or a derivative is defined.
const DEFINED: &str = "what is defined";

/// The name of a derivative of the larger side less the smaller one.
fn nth(order: usize) -> String {
    match order {
        1 => "the derivative".to_owned(),
        2 => "the second derivative".to_owned(),
        3 => "the third derivative".to_owned(),
        n => format!("the derivative of order {n}"),
    }
}

fn relation(left: Tree, relation: Relation) -> Equation {
    Equation {
        relation,
        ..Equation::between(left, integer(0))
    }
}

/// What may be added to the numbers that stand for letters so that the conditions hold, where something may.
fn shift(given: &Statements) -> f64 {
    let holds = |shift: f64| {
        let value = |tree: &Tree| guess_at(tree, &|name| Some(seed(name) + shift));
        given.assume.iter().all(|condition| match condition {
            Condition::Relation(relation) => {
                let (Some(left), Some(right)) = (value(&relation.left), value(&relation.right)) else {
                    return false;
                };
                match relation.relation {
                    Relation::Less | Relation::LessOrEqual => left < right,
                    Relation::Greater | Relation::GreaterOrEqual => left > right,
                    Relation::Equal | Relation::NotEqual => true,
                }
            }
            Condition::Integer(_) => true,
        })
    };
    SHIFTS.into_iter().find(|shift| holds(*shift)).unwrap_or(0.0)
}

/// The function and its derivatives by the letter, of which `between` is written.
fn derivatives(function: &Tree, letter: &Name, between: &Name, symbols: &Symbols) -> Result<Vec<Tree>, String> {
    let by = By { symbols, name: between };
    let mut all = vec![rewrite(function, &|name| (name == letter).then(|| symbol(between)))];
    while let Some(last) = all.last()
        && all.len() <= HIGHEST
    {
        let next = by.of(last)?;
        if nodes_of(&next) > LARGEST {
            break;
        }
        all.push(next);
    }
    Ok(all)
}

/// Numerator and denominator of a sum of quotients.
fn fraction(tree: &Tree) -> (Tree, Tree) {
    match tree {
        Tree::Quotient(above, below, _) => {
            let ((up, under), (over, down)) = (fraction(above), fraction(below));
            (product(vec![up, down]), product(vec![under, over]))
        }
        Tree::Negate(inner) => {
            let (above, below) = fraction(inner);
            (negative(above), below)
        }
        Tree::Product(factors) => {
            let (above, below) = factors.iter().map(fraction).unzip();
            (product(above), product(below))
        }
        Tree::Sum(terms) => terms
            .iter()
            .map(fraction)
            .fold((integer(0), integer(1)), |(above, below), (up, down)| {
                match below == down {
                    true => (sum(vec![above, up]), below),
                    false => {
                        let over = sum(vec![
                            product(vec![above, down.clone()]),
                            product(vec![up, below.clone()]),
                        ]);
                        (over, product(vec![below, down]))
                    }
                }
            }),
        tree => (tree.clone(), integer(1)),
    }
}

/// The numerator of a function that is a quotient, with its denominator.
fn cleared(function: &Tree) -> Option<(Tree, Option<Tree>)> {
    let (above, below) = fraction(function);
    (!matches!(below, Tree::Number(_))).then_some((above, Some(below)))
}

/// The derivative with the sign that it has in a power series below the point.
fn signed(tree: &Tree, order: usize, is_above: bool) -> Tree {
    match is_above || order.is_multiple_of(2) {
        true => tree.clone(),
        false => negative(tree.clone()),
    }
}

/// The tree with the values of inverse functions that are 0: of odd ones at 0, and of the logarithm at 1.
fn with_known_values(tree: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Call(name, argument, _) => {
            let own = number_of(argument)?;
            let is_odd = |function: &Elementary| function.inverse_of.is_some() && function.parity == Some(Parity::Odd);
            let is_zero = match own.to_integer()? {
                0 => Elementary::named(name).is_some_and(is_odd),
                1 => name.base == "\\ln",
                _ => false,
            };
            is_zero.then(|| integer(0))
        }
        _ => None,
    })
}

impl Question<'_> {
    /// The value at a point; inverse functions of 0 that are 0 are written so.
    fn at(&self, tree: &Tree, point: &Tree) -> Tree {
        with_known_values(&rewrite(tree, &|name| (name == self.between).then(|| point.clone())))
    }

    /// The goals by Taylor's theorem at a point, on each side on which the letter may be, with the first order that may
    /// have the sign, with the last, or with one between.
    fn by_taylor(&self, point: &Tree, later: usize) -> Option<Vec<Goal>> {
        let mut goals = Vec::new();
        let mut sides = 0;
        for is_above in [true, false] {
            if self.range.ends_at(point, is_above) {
                continue;
            }
            let orders = (1..self.derivatives.len()).filter(|order| self.is_likely(point, *order, is_above));
            let orders: Vec<usize> = orders.collect();
            let order = match later {
                0 => orders.first(),
                1 => orders.last(),
                later => orders.get(later - 1),
            };
            let order = *order?;
            self.on_side(point, order, is_above, &mut goals)?;
            sides += 1;
        }
        let function = self.derivatives.first()?;
        let kind = match self.is_strict && !self.range.excludes(point) {
            true => Relation::Greater,
            false => Relation::GreaterOrEqual,
        };
        let step = format!("Taylor's theorem at {point}: the larger side less the smaller one there");
        self.push(&step, relation(self.at(function, point), kind), &[], &mut goals);
        (sides > 0).then_some(goals)
    }

    /// What is assumed of `between` beyond a point: closed at the point or not, up to where the letter may be.
    fn beyond(&self, point: &Tree, is_above: bool, is_closed: bool) -> Vec<Condition> {
        let kind = match (is_above, is_closed) {
            (true, true) => Relation::GreaterOrEqual,
            (true, false) => Relation::Greater,
            (false, true) => Relation::LessOrEqual,
            (false, false) => Relation::Less,
        };
        let bounds = self.range.side(is_above).cloned();
        let all = std::iter::once((kind, point.clone())).chain(bounds);
        all.map(|(kind, bound)| {
            Condition::Relation(Equation {
                relation: kind,
                ..Equation::between(symbol(self.between), bound)
            })
        })
        .collect()
    }

    /// Adds a goal; `step` says what it is for.
    fn push(&self, step: &str, claim: Equation, assumed: &[Condition], goals: &mut Vec<Goal>) {
        let is_known = |goal: &Goal| goal.statements.claims.first() == Some(&claim);
        if assumed.is_empty() && goals.iter().any(is_known) {
            return;
        }
        let mut alone = self.given.clone().by(Rule::InequalityDerivatives);
        alone.assume.extend(assumed.iter().cloned());
        let part = match assumed.is_empty() {
            true => step.to_owned(),
            false => {
                let assumed: Vec<String> = assumed
                    .iter()
                    .map(|condition| match condition {
                        Condition::Relation(relation) => relation.to_string(),
                        Condition::Integer(name) => format!(r"{name} \in \mathbb{{Z}}"),
                    })
                    .collect();
                format!("{step}, for {}", assumed.join(", "))
            }
        };
        alone.claims = vec![claim];
        goals.push(Goal::of(&alone, self.symbols, part));
    }

    /// The goals beyond a point: the function and the derivatives below `order` are defined there and not negative at the
    /// point, that of `order` is defined and not negative, or positive, beyond it.
    fn on_side(&self, point: &Tree, order: usize, is_above: bool, goals: &mut Vec<Goal>) -> Option<()> {
        let (closed, open) = (self.beyond(point, is_above, true), self.beyond(point, is_above, false));
        let mut met: Vec<Equation> = Vec::new();
        for (n, derivative) in self.derivatives.iter().enumerate().take(order + 1) {
            for condition in defined::conditions(derivative, self.symbols).ok()? {
                if !met.contains(&condition) {
                    let range = if n < order { &closed } else { &open };
                    self.push(DEFINED, condition.clone(), range, goals);
                    met.push(condition);
                }
            }
            if (1..order).contains(&n) {
                let value = signed(&self.at(derivative, point), n, is_above);
                let step = format!("Taylor's theorem at {point}: {}", nth(n));
                self.push(&step, relation(value, Relation::GreaterOrEqual), &[], goals);
            }
        }
        let kind = match self.is_strict {
            true => Relation::Greater,
            false => Relation::GreaterOrEqual,
        };
        let last = signed(self.derivatives.get(order)?, order, is_above);
        let step = format!("Taylor's theorem at {point}, the remainder: {}", nth(order));
        self.push(&step, relation(last, kind), &open, goals);
        Some(())
    }

    /// The goals by concavity between two bounds.
    fn by_concavity(&self) -> Option<Vec<Goal>> {
        let [function, slope, curvature] = self.derivatives.get(..3)? else {
            return None;
        };
        let (_, low) = self.range.side(false).next()?;
        let (_, high) = self.range.side(true).next()?;
        let ends = |kinds: [Relation; 2]| -> Vec<Condition> {
            let pairs = kinds.into_iter().zip([low, high]);
            pairs
                .map(|(relation, bound)| {
                    Condition::Relation(Equation {
                        relation,
                        ..Equation::between(symbol(self.between), bound.clone())
                    })
                })
                .collect()
        };
        let closed = ends([Relation::GreaterOrEqual, Relation::LessOrEqual]);
        let open = ends([Relation::Greater, Relation::Less]);
        let is_near = |y: f64| self.value(curvature, y).is_some_and(|value| value <= SLACK);
        let (from, to) = (self.number(low)?, self.number(high)?);
        if !FRACTIONS.iter().all(|part| is_near(from + part * (to - from))) {
            return None;
        }
        let mut goals = Vec::new();
        for bound in [low, high] {
            let kind = match self.is_strict && !self.range.excludes(bound) {
                true => Relation::Greater,
                false => Relation::GreaterOrEqual,
            };
            let step = format!("concavity: the larger side less the smaller one at {bound}");
            self.push(&step, relation(self.at(function, bound), kind), &[], &mut goals);
        }
        for condition in defined::conditions(function, self.symbols).ok()? {
            self.push(DEFINED, condition, &closed, &mut goals);
        }
        for derivative in [slope, curvature] {
            for condition in defined::conditions(derivative, self.symbols).ok()? {
                self.push(DEFINED, condition, &open, &mut goals);
            }
        }
        // of a line that is positive at one end and not negative at the other each value between is positive
        let may_be_zero_at_ends = [low, high].into_iter().all(|bound| self.range.excludes(bound));
        let kind = match self.is_strict && may_be_zero_at_ends {
            true => Relation::Less,
            false => Relation::LessOrEqual,
        };
        let step = format!("concavity: {}", nth(2));
        self.push(&step, relation(curvature.clone(), kind), &open, &mut goals);
        Some(goals)
    }

    fn value(&self, tree: &Tree, y: f64) -> Option<f64> {
        guess_at(tree, &|name| {
            Some(if name == self.between {
                y
            } else {
                seed(name) + self.shift
            })
        })
    }

    fn number(&self, tree: &Tree) -> Option<f64> {
        self.value(tree, f64::NAN)
    }

    /// Whether the signs are right at some numbers.
    fn is_likely(&self, point: &Tree, order: usize, is_above: bool) -> bool {
        let Some(from) = self.number(point) else {
            return false;
        };
        let sign = |n: usize| if is_above || n.is_multiple_of(2) { 1.0 } else { -1.0 };
        let is_kept = |n: usize, y: f64| {
            let value = self.derivatives.get(n).and_then(|derivative| self.value(derivative, y));
            value.is_some_and(|value| sign(n) * value >= -SLACK)
        };
        let end = self.range.side(is_above).find_map(|(_, bound)| self.number(bound));
        let beyond = |part: f64| match end {
            Some(end) => from + part * (end - from),
            None => from + sign(1) * part / (1.0 - part),
        };
        (0..order).all(|n| is_kept(n, from)) && FRACTIONS.iter().all(|part| is_kept(order, beyond(*part)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_of_quotients_has_one_numerator_and_one_denominator() {
        let (x, y) = (symbol(&plain("x")), symbol(&plain("y")));
        let (above, below) = fraction(&difference(quotient(x.clone(), y), quotient(integer(1), x)));
        let at = |tree: &Tree| guess_at(tree, &|name| Some(if name.base == "x" { 3.0 } else { 5.0 }));
        assert_eq!((at(&above), at(&below)), (Some(4.0), Some(15.0)));
    }

    #[test]
    fn the_logarithm_of_a_number_and_the_letter_bounds_the_letter() {
        let range = |bounds| Range {
            letter: plain("x"),
            bounds,
            excluded: Vec::new(),
        };
        let argument = sum(vec![integer(1), product(vec![integer(-2), symbol(&plain("x"))])]);
        let logarithm = super::super::build::call("\\ln", argument);
        let found = range(Vec::new()).within_domain_of(&logarithm).bounds;
        assert_eq!(found, vec![(Relation::Less, ratio(-1, -2))]);
        let other = product(vec![symbol(&plain("x")), symbol(&plain("y"))]);
        let logarithm = super::super::build::call("\\ln", other);
        assert!(range(Vec::new()).within_domain_of(&logarithm).bounds.is_empty());
    }

    #[test]
    fn derivatives_below_a_point_alternate() {
        let tree = symbol(&plain("x"));
        assert_eq!(signed(&tree, 1, true), tree);
        assert_eq!(signed(&tree, 1, false), negative(tree.clone()));
        assert_eq!(signed(&tree, 2, false), tree);
    }

    #[test]
    fn a_bound_that_is_strict_excludes_its_point() {
        let range = Range {
            letter: plain("x"),
            bounds: vec![(Relation::Greater, integer(0)), (Relation::LessOrEqual, integer(2))],
            excluded: vec![integer(1)],
        };
        assert!(range.excludes(&integer(0)) && range.excludes(&integer(1)) && !range.excludes(&integer(2)));
        assert!(range.ends_at(&integer(2), true) && !range.ends_at(&integer(2), false));
    }
}
