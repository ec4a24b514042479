//! The edits of one node that a misprint may call for.

use super::context::Context;
use super::path::size;
use crate::number::{Field, Rational};
use crate::tex::{At, Equation, Invariant, Name, Operation, Relation, Tree};

/// What is put in the place of a node, and what was wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    pub tree: Tree,
    /// The size of the edit: 10 for one sign, name or digit, more for what is rarer or longer.
    pub cost: u32,
    pub words: String,
    /// Whether a factor or a term is put in, of which the printed formula says nothing.
    pub adds: bool,
    /// The relation that the sides should have, where it is that which is wrong.
    pub relation: Option<Relation>,
}

const PLAIN: u32 = 10;
const RARE: u32 = 12;
/// For each node that is taken away or put in.
const OF_NODE: u32 = 1;

pub fn number(value: i64) -> Tree {
    Tree::Number(Rational::from_integer(value))
}

/// The number pi.
pub fn pi() -> Tree {
    let base = r"\pi".to_owned();
    let name = Name {
        base,
        ..Name::default()
    };
    Tree::Symbol(name, At::default())
}

fn is_number(tree: &Tree, value: i64) -> bool {
    *tree == number(value)
}

pub fn negated(tree: &Tree) -> Tree {
    match tree {
        Tree::Negate(body) => (**body).clone(),
        other => Tree::Negate(Box::new(other.clone())),
    }
}

pub fn sum(mut terms: Vec<Tree>) -> Tree {
    match terms.len() {
        0 => number(0),
        1 => terms.remove(0),
        _ => {
            let flat = terms.into_iter().flat_map(|term| match term {
                Tree::Sum(inner) => inner,
                other => vec![other],
            });
            Tree::Sum(flat.collect())
        }
    }
}

pub fn product(factors: Vec<Tree>) -> Tree {
    let flat = factors.into_iter().flat_map(|factor| match factor {
        Tree::Product(inner) => inner,
        other => vec![other],
    });
    let mut factors: Vec<Tree> = flat.filter(|factor| !is_number(factor, 1)).collect();
    match factors.len() {
        0 => number(1),
        1 => factors.remove(0),
        _ => Tree::Product(factors),
    }
}

pub fn quotient(above: Tree, below: Tree) -> Tree {
    match is_number(&below, 1) {
        true => above,
        false => Tree::Quotient(Box::new(above), Box::new(below), At::default()),
    }
}

fn power(base: &Tree, exponent: i32) -> Tree {
    match exponent {
        1 => base.clone(),
        _ => Tree::Power(Box::new(base.clone()), exponent, At::default()),
    }
}

/// A tree multiplied by a factor, where an author would write it.
pub fn times(tree: &Tree, factor: &Tree) -> Tree {
    match tree {
        Tree::Negate(body) => negated(&times(body, factor)),
        Tree::Quotient(above, below, _) => quotient(times(above, factor), (**below).clone()),
        _ if matches!(factor, Tree::Number(_)) => product(vec![factor.clone(), tree.clone()]),
        // \frac{1}{2} x^2 a is \frac{a}{2} x^2
        Tree::Product(factors) => {
            let is_part = |tree: &Tree| matches!(tree, Tree::Quotient(above, ..) if is_number(above, 1));
            match factors
                .iter()
                .position(is_part)
                .and_then(|n| Some((n, factors.get(n)?)))
            {
                Some((n, part)) => Tree::Product(put(factors, n, times(part, factor))),
                None => product(vec![tree.clone(), factor.clone()]),
            }
        }
        _ if is_number(tree, 1) => factor.clone(),
        _ => product(vec![tree.clone(), factor.clone()]),
    }
}

/// A tree divided by a factor.
pub fn over(tree: &Tree, factor: &Tree) -> Tree {
    match tree {
        Tree::Negate(body) => negated(&over(body, factor)),
        Tree::Quotient(above, below, _) => quotient((**above).clone(), times(below, factor)),
        _ => quotient(tree.clone(), factor.clone()),
    }
}

/// A sum with one more term.
pub fn plus(tree: &Tree, term: &Tree) -> Tree {
    sum(vec![tree.clone(), term.clone()])
}

/// A sum with one more term of this sign, which does not begin with a minus where that can be avoided.
pub fn plus_signed(tree: &Tree, term: &Tree, negative: bool) -> Tree {
    let begins_negative = match tree {
        Tree::Sum(terms) => matches!(terms.first(), Some(Tree::Negate(_))),
        other => matches!(other, Tree::Negate(_)),
    };
    match (negative, begins_negative) {
        (true, _) => plus(tree, &negated(term)),
        (false, true) => plus(term, tree),
        (false, false) => plus(tree, term),
    }
}

fn without(list: &[Tree], at: usize) -> Vec<Tree> {
    let kept = list.iter().enumerate().filter(|(n, _)| *n != at);
    kept.map(|(_, item)| item.clone()).collect()
}

fn put(list: &[Tree], at: usize, new: Tree) -> Vec<Tree> {
    let mut list = list.to_vec();
    if let Some(place) = list.get_mut(at) {
        *place = new;
    }
    list
}

fn unsigned(tree: &Tree) -> &Tree {
    match tree {
        Tree::Negate(body) => body,
        other => other,
    }
}

struct Edits<'a> {
    found: Vec<Edit>,
    node: &'a Tree,
}

impl Edits<'_> {
    fn add(&mut self, tree: Tree, cost: u32, words: String) {
        if tree != *self.node && !self.found.iter().any(|edit| edit.tree == tree) {
            self.found.push(Edit {
                tree,
                cost,
                words,
                adds: false,
                relation: None,
            });
        }
    }

    /// An edit that puts one thing in the place of another.
    fn instead(&mut self, tree: Tree, cost: u32) {
        let words = format!("`{}` in the place of `{tree}`", self.node);
        self.add(tree, cost, words);
    }
}

/// The edits of a node; `above` is the node that it is a part of.
pub fn edits(node: &Tree, above: Option<&Tree>, context: &Context) -> Vec<Edit> {
    let mut edits = Edits {
        found: Vec::new(),
        node,
    };
    signs(node, above, &mut edits);
    match node {
        Tree::Number(value) => numbers(value, &mut edits),
        Tree::Symbol(name, at) => {
            for (other, cost) in context.others(name, false) {
                edits.instead(Tree::Symbol(other, *at), cost);
            }
        }
        Tree::Call(name, argument, at) => {
            for (other, cost) in context.others(name, true) {
                edits.instead(Tree::Call(other, argument.clone(), *at), cost);
            }
        }
        Tree::Partial { of, by, at } => {
            for (one, other) in context.partials(of, by) {
                let cost = if one == *of || other == *by { PLAIN } else { RARE };
                let tree = Tree::Partial {
                    of: one,
                    by: other,
                    at: *at,
                };
                edits.instead(tree, cost);
            }
        }
        Tree::Invariant { kind, of, at } => invariants(*kind, of, *at, context, &mut edits),
        Tree::Sum(terms) => of_sum(terms, above, &mut edits),
        Tree::Product(factors) => of_product(factors, above, &mut edits),
        Tree::Quotient(over, below, _) => of_quotient(over, below, above, &mut edits),
        Tree::Power(base, exponent, _) => {
            for (exponent, cost) in [
                (1, PLAIN),
                (exponent + 1, PLAIN),
                (exponent - 1, PLAIN),
                (-exponent, RARE),
                (2 * exponent, RARE),
                (exponent / 2, RARE),
            ] {
                if exponent != 0 {
                    edits.instead(power(base, exponent), cost);
                }
            }
        }
        Tree::RealPower(base, ..) | Tree::Root(base, ..) => edits.instead((**base).clone(), RARE),
        Tree::Operation(operation, at) => of_operation(operation, *at, &mut edits),
        Tree::Negate(_) | Tree::PlusMinus(_) | Tree::MinusPlus(_) => {}
    }
    let is_base = matches!(above, Some(Tree::Power(..) | Tree::RealPower(..)));
    let has_powers = !matches!(
        node,
        Tree::Number(_) | Tree::Negate(_) | Tree::Power(..) | Tree::Operation(..)
    );
    if has_powers && !is_base && !matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_)) {
        let is_plain = !matches!(node, Tree::Product(_));
        let cost = if is_plain { PLAIN } else { RARE };
        edits.instead(power(node, 2), cost + 1);
        edits.instead(power(node, 3), cost + 4);
        if !matches!(above, Some(Tree::Root(..))) {
            edits.instead(Tree::Root(Box::new(node.clone()), 2, At::default()), RARE + 1);
        }
    }
    edits.found
}

fn signs(node: &Tree, above: Option<&Tree>, edits: &mut Edits) {
    let is_term = matches!(above, Some(Tree::Sum(_)));
    let what = |tree: &Tree| match is_term {
        true => format!("wrong sign of the term `{}`", unsigned(tree)),
        false => format!("wrong sign of `{}`", unsigned(tree)),
    };
    match node {
        Tree::PlusMinus(body) | Tree::MinusPlus(body) => {
            let other = match node {
                Tree::PlusMinus(_) => Tree::MinusPlus(body.clone()),
                _ => Tree::PlusMinus(body.clone()),
            };
            let signs = format!("wrong signs of `{body}`");
            edits.add(other, PLAIN, signs.clone());
            edits.add((**body).clone(), RARE, signs.clone());
            edits.add(negated(body), RARE, signs);
        }
        // as a factor, an operand of a power or beneath another sign it is the whole that has the sign
        _ => {
            let bears = match above {
                None | Some(Tree::Sum(_) | Tree::Quotient(..) | Tree::Call(..) | Tree::Operation(..)) => true,
                Some(Tree::RealPower(base, ..)) => **base != *node,
                _ => matches!(node, Tree::Negate(_)),
            };
            let is_zero = is_number(node, 0);
            if bears && !is_zero {
                let cost = if is_term || above.is_none() { PLAIN } else { PLAIN + 1 };
                edits.add(negated(node), cost, what(node));
            }
        }
    }
}

fn numbers(value: &Rational, edits: &mut Edits) {
    let integer = Rational::from_integer;
    let (one, two) = (integer(1), integer(2));
    let mut others = vec![
        value.clone() + one.clone(),
        value.clone() - one.clone(),
        value.clone() * two.clone(),
        value.clone() / two,
        value.clone() * value.clone(),
    ];
    if *value != integer(0) {
        others.push(one / value.clone());
    }
    for other in others {
        if other >= integer(0) {
            edits.instead(Tree::Number(other), PLAIN + 1);
        }
    }
}

/// A node between bars, where a root or bars stand in the formula.
pub fn within_bars(node: &Tree) -> Option<Edit> {
    let is_plain = matches!(node, Tree::Symbol(..) | Tree::Sum(_) | Tree::Product(_));
    let name = Name {
        base: r"\abs".to_owned(),
        ..Name::default()
    };
    is_plain.then(|| Edit {
        tree: Tree::Call(name, Box::new(node.clone()), At::default()),
        cost: RARE + 1,
        words: format!("the bars of `|{node}|` are missing"),
        adds: false,
        relation: None,
    })
}

/// A term that is missing in a node.
pub fn missing_term(term: &Tree, negative: bool, node: &Tree) -> Edit {
    Edit {
        tree: plus_signed(node, term, negative),
        cost: RARE + 2 * size(term) + u32::from(negative),
        words: format!("the term `{term}` is missing in `{node}`"),
        adds: true,
        relation: None,
    }
}

/// An exponent that is missing on a node.
pub fn missing_exponent(exponent: &Tree, negative: bool, node: &Tree) -> Edit {
    let exponent = if negative { negated(exponent) } else { exponent.clone() };
    Edit {
        cost: RARE + size(&exponent),
        words: format!("the exponent `{exponent}` is missing on `{node}`"),
        tree: Tree::RealPower(Box::new(node.clone()), Box::new(exponent), At::default()),
        adds: true,
        relation: None,
    }
}

/// A factor that is missing in a node, above or below the line.
pub fn missing_factor(factor: &Tree, node: &Tree, is_above: bool) -> Edit {
    let below = if is_above { "" } else { " in the denominator" };
    Edit {
        tree: if is_above {
            times(node, factor)
        } else {
            over(node, factor)
        },
        cost: RARE - 1 + size(factor) + u32::from(!is_above),
        words: format!("the factor `{factor}` is missing{below} in `{node}`"),
        adds: true,
        relation: None,
    }
}

/// The relations that one may be a slip for.
pub fn relations(equation: &Equation) -> Vec<Edit> {
    use Relation::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual, NotEqual};
    let other = match equation.relation {
        Equal | NotEqual => return Vec::new(),
        Less => LessOrEqual,
        LessOrEqual => Less,
        Greater => GreaterOrEqual,
        GreaterOrEqual => Greater,
    };
    let turned = equation.relation.turned();
    let both = match other {
        Less | LessOrEqual => [Greater, GreaterOrEqual],
        _ => [Less, LessOrEqual],
    };
    let costs = [(turned, PLAIN), (other, PLAIN + 1)].into_iter();
    let costs = costs.chain(
        both.into_iter()
            .filter(|relation| *relation != turned)
            .map(|relation| (relation, RARE)),
    );
    let edit = |(relation, cost)| Edit {
        tree: equation.left.clone(),
        cost,
        words: format!("`{}` in the place of `{relation}`", equation.relation),
        adds: false,
        relation: Some(relation),
    };
    costs.map(edit).collect()
}

/// The longest number whose digits are taken for misprints.
const MOST_DIGITS: usize = 4;

/// The whole numbers that one may be a slip for: two of its digits in the wrong order, or one digit in the place of another.
pub fn other_digits(node: &Tree) -> Vec<Edit> {
    let mut edits = Edits {
        found: Vec::new(),
        node,
    };
    let digits = match node {
        Tree::Number(value) => value.to_string().into_bytes(),
        _ => Vec::new(),
    };
    if digits.len() > MOST_DIGITS || !digits.iter().all(u8::is_ascii_digit) {
        return Vec::new();
    }
    let mut add = |digits: &[u8], cost: u32| {
        let text = String::from_utf8_lossy(digits);
        let is_number = digits.len() == 1 || !text.starts_with('0');
        if let Some(other) = text.parse().ok().filter(|_| is_number) {
            edits.instead(number(other), cost);
        }
    };
    for place in 1..digits.len() {
        let mut swapped = digits.clone();
        swapped.swap(place - 1, place);
        add(&swapped, PLAIN + 1);
    }
    for place in 0..digits.len() {
        for digit in b'0'..=b'9' {
            let mut other = digits.clone();
            other[place] = digit;
            add(&other, RARE);
        }
    }
    edits.found
}

fn invariants(kind: Invariant, of: &Name, at: At, context: &Context, edits: &mut Edits) {
    let other = match kind {
        Invariant::Trace => Invariant::Determinant,
        Invariant::Determinant => Invariant::Trace,
    };
    for (kind, cost) in [(kind, 0), (other, 1)] {
        for of in std::iter::once(of).chain(&context.maps) {
            let tree = Tree::Invariant {
                kind,
                of: of.clone(),
                at,
            };
            edits.instead(tree, PLAIN + cost);
        }
    }
}

fn of_operation(operation: &Operation, at: At, edits: &mut Edits) {
    match operation {
        Operation::Derivative {
            of,
            by,
            order,
            at: place,
        } => {
            for order in [order + 1, order.saturating_sub(1)] {
                let other = Operation::Derivative {
                    of: of.clone(),
                    by: by.clone(),
                    order,
                    at: place.clone(),
                };
                edits.instead(Tree::Operation(Box::new(other), at), PLAIN + 1);
            }
        }
        Operation::Transpose(of) | Operation::Trace(of) | Operation::Determinant(of) => {
            edits.instead(of.clone(), RARE);
        }
        Operation::Cross(left, right) => {
            let turned = Operation::Cross(right.clone(), left.clone());
            edits.instead(Tree::Operation(Box::new(turned), at), PLAIN + 1);
        }
        _ => {}
    }
}

/// The ways in which a term may be taken into a bracket of another: what becomes of that one, and whether the bracket
/// was there.
fn taken_in(into: &Tree, term: &Tree) -> Vec<(Tree, bool)> {
    let is_sum = |tree: &Tree| matches!(tree, Tree::Sum(_));
    match into {
        Tree::Negate(body) => taken_in(body, term)
            .into_iter()
            .map(|(tree, was)| (negated(&tree), was))
            .collect(),
        Tree::Product(factors) => {
            let mut ways = Vec::new();
            for (n, factor) in factors.iter().enumerate() {
                ways.push((product(put(factors, n, plus(factor, term))), is_sum(factor)));
                // or with the factors before it, or behind it
                for (from, to) in [(0, n + 1), (n, factors.len())] {
                    if let Some(group) = factors.get(from..to).filter(|group| group.len() > 1) {
                        let bracket = plus(&product(group.to_vec()), term);
                        let before = factors.get(..from).unwrap_or_default().iter().cloned();
                        let behind = factors.get(to..).unwrap_or_default().iter().cloned();
                        let all: Vec<Tree> = before.chain([bracket]).chain(behind).collect();
                        if all.len() > 1 {
                            ways.push((product(all), false));
                        }
                    }
                }
                if let Tree::Quotient(..) = factor {
                    for (taken, was) in taken_in(factor, term) {
                        ways.push((product(put(factors, n, taken)), was));
                    }
                }
            }
            ways
        }
        Tree::Quotient(above, below, _) => {
            let mut ways = vec![(quotient(plus(above, term), (**below).clone()), true)];
            ways.push((quotient((**above).clone(), plus(below, term)), is_sum(below)));
            if !is_sum(above) {
                let inner = taken_in(above, term).into_iter();
                ways.extend(inner.map(|(above, was)| (quotient(above, (**below).clone()), was)));
            }
            ways
        }
        Tree::Call(name, argument, at) => {
            vec![(Tree::Call(name.clone(), Box::new(plus(argument, term)), *at), false)]
        }
        Tree::Power(base, exponent, _) => vec![(power(&plus(base, term), *exponent), is_sum(base))],
        Tree::Root(base, index, at) => vec![(Tree::Root(Box::new(plus(base, term)), *index, *at), false)],
        _ => Vec::new(),
    }
}

/// The ways in which a term may be taken out of a bracket: what remains, the term, and whether it stood at an end.
fn taken_out(of: &Tree) -> Vec<(Tree, Tree, bool)> {
    let from_sum = |terms: &[Tree]| -> Vec<(Tree, Tree, bool)> {
        let each = terms.iter().enumerate();
        each.map(|(n, term)| (sum(without(terms, n)), term.clone(), n == 0 || n + 1 == terms.len()))
            .collect()
    };
    match of {
        Tree::Negate(body) => taken_out(body)
            .into_iter()
            .map(|(rest, term, end)| (negated(&rest), term, end))
            .collect(),
        Tree::Product(factors) => {
            let mut ways = Vec::new();
            for (n, factor) in factors.iter().enumerate() {
                let inner = match factor {
                    Tree::Sum(terms) => from_sum(terms),
                    Tree::Quotient(..) => taken_out(factor),
                    _ => Vec::new(),
                };
                ways.extend(
                    inner
                        .into_iter()
                        .map(|(rest, term, end)| (product(put(factors, n, rest)), term, end)),
                );
            }
            ways
        }
        Tree::Quotient(above, below, _) => {
            let inner = match &**above {
                Tree::Sum(terms) => from_sum(terms),
                other => taken_out(other),
            };
            inner
                .into_iter()
                .map(|(rest, term, end)| (quotient(rest, (**below).clone()), term, end))
                .collect()
        }
        Tree::Call(name, argument, at) => match &**argument {
            Tree::Sum(terms) => from_sum(terms)
                .into_iter()
                .map(|(rest, term, end)| (Tree::Call(name.clone(), Box::new(rest), *at), term, end))
                .collect(),
            _ => Vec::new(),
        },
        Tree::Power(base, exponent, _) => match &**base {
            Tree::Sum(terms) => from_sum(terms)
                .into_iter()
                .map(|(rest, term, end)| (power(&rest, *exponent), term, end))
                .collect(),
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

/// How much smaller an edit is that moves a bracket which groups nothing as it stands.
const OF_IDLE: u32 = 4;

/// Whether a factor stands in brackets for which there is no reason: a product, a sign, or 1.
fn has_idle_bracket(term: &Tree) -> bool {
    let is_idle = |factor: &Tree| matches!(factor, Tree::Product(_) | Tree::Negate(_)) || is_number(factor, 1);
    matches!(unsigned(term), Tree::Product(factors) if factors.iter().any(is_idle))
}

fn of_sum(terms: &[Tree], above: Option<&Tree>, edits: &mut Edits) {
    let is_idle = matches!(above, Some(Tree::Sum(_)));
    for (n, term) in terms.iter().enumerate() {
        let cost = RARE + OF_NODE * size(term).min(10);
        let words = format!("the term `{}` is too much", unsigned(term));
        edits.add(sum(without(terms, n)), cost, words);
        let doubled = times(term, &number(2));
        edits.add(
            sum(put(terms, n, doubled)),
            RARE + 1,
            format!("the factor 2 is missing in `{}`", unsigned(term)),
        );
        for other in (0..terms.len()).filter(|other| *other != n) {
            let Some(into) = terms.get(other) else { continue };
            let is_idle = is_idle || has_idle_bracket(into);
            for (taken, was) in taken_in(into, term) {
                let cost = if was { RARE } else { RARE + 2 };
                let cost = if is_idle { cost - OF_IDLE } else { cost };
                let words = format!("the term `{}` belongs inside the bracket", unsigned(term));
                edits.add(sum(without(&put(terms, other, taken), n)), cost, words);
            }
        }
        for (rest, out, end) in taken_out(term) {
            let mut moved = put(terms, n, rest);
            let words = format!("the term `{}` belongs outside the bracket", unsigned(&out));
            moved.insert(n + 1, out);
            edits.add(sum(moved), if end { RARE } else { RARE + 1 }, words);
        }
    }
}

/// What stands alone, its bracket shorter by a term that stands beside it.
fn beside(node: &Tree, above: Option<&Tree>, edits: &mut Edits) {
    if matches!(above, Some(Tree::Sum(_) | Tree::Negate(_))) {
        return;
    }
    for (rest, out, end) in taken_out(node) {
        let words = format!("the term `{}` belongs outside the bracket", unsigned(&out));
        edits.add(plus(&rest, &out), if end { RARE } else { RARE + 1 }, words);
    }
}

fn of_product(factors: &[Tree], above: Option<&Tree>, edits: &mut Edits) {
    if let [Tree::Call(one, ..), Tree::Call(other, ..)] = factors
        && one == other
    {
        edits.instead(sum(factors.to_vec()), RARE + 1);
    }
    beside(edits.node, above, edits);
    for (n, factor) in factors.iter().enumerate() {
        for (other, with) in factors.iter().enumerate().skip(n + 1) {
            if let Some((one, two)) = swapped_letters(factor, with) {
                let words = format!("{SWAPPED} `{factor}` and `{with}` are swapped");
                edits.add(product(put(&put(factors, n, one), other, two)), PLAIN + 2, words);
            }
        }
        let cost = RARE - 1 + OF_NODE * size(factor).min(10);
        let words = format!("the factor `{factor}` is too much");
        edits.add(product(without(factors, n)), cost, words);
        let words = format!("the factor `{factor}` belongs in the denominator");
        let rest = without(factors, n);
        let lowered = match rest.iter().position(|other| matches!(other, Tree::Quotient(..))) {
            Some(place) => {
                let below = rest.get(place).map(|other| over(other, factor));
                below.map_or_else(|| number(1), |below| product(put(&rest, place, below)))
            }
            None => quotient(product(rest), factor.clone()),
        };
        edits.add(lowered, RARE, words);
    }
}

/// The beginning of the words of an edit that swaps the letters of two factors.
pub const SWAPPED: &str = "the letters of";

/// Returns two factors with the letter of each in the place of that of the other, where this makes other powers of them.
fn swapped_letters(one: &Tree, other: &Tree) -> Option<(Tree, Tree)> {
    let split = |tree: &Tree| match tree {
        Tree::Symbol(..) => Some((tree.clone(), 1)),
        Tree::Power(base, exponent, _) if matches!(**base, Tree::Symbol(..)) => Some(((**base).clone(), *exponent)),
        _ => None,
    };
    let ((letter, exponent), (with, its_own)) = (split(one)?, split(other)?);
    (exponent != its_own).then(|| (power(&with, exponent), power(&letter, its_own)))
}

fn of_quotient(above: &Tree, below: &Tree, parent: Option<&Tree>, edits: &mut Edits) {
    let node = edits.node;
    beside(node, parent, edits);
    let turned = quotient(below.clone(), above.clone());
    edits.add(
        turned,
        PLAIN + 1,
        format!("numerator and denominator of `{node}` are swapped"),
    );
    let cost = |part: &Tree| RARE + OF_NODE * size(part).min(10);
    edits.add(
        above.clone(),
        cost(below),
        format!("the denominator `{below}` is too much"),
    );
    let words = format!("the numerator `{above}` is too much");
    edits.add(quotient(number(1), below.clone()), cost(above), words);
    // as of two logarithms
    if let (Tree::Call(one, ..), Tree::Call(other, ..)) = (above, below)
        && one == other
    {
        edits.instead(sum(vec![above.clone(), negated(below)]), RARE + 1);
    }
    let factors_of = |tree: &Tree| match tree {
        Tree::Product(factors) => factors.clone(),
        other => vec![other.clone()],
    };
    let lower = factors_of(below);
    for (n, factor) in lower.iter().enumerate() {
        let words = format!("the factor `{factor}` belongs in the numerator");
        edits.add(quotient(times(above, factor), product(without(&lower, n))), RARE, words);
    }
    let (negative, body) = match above {
        Tree::Negate(body) => (true, &**body),
        other => (false, other),
    };
    let upper = factors_of(body);
    for (n, factor) in upper
        .iter()
        .enumerate()
        .filter(|(_, factor)| !matches!(factor, Tree::Number(_)))
    {
        let words = format!("the factor `{factor}` belongs in the denominator");
        let rest = product(without(&upper, n));
        let rest = if negative { negated(&rest) } else { rest };
        edits.add(quotient(rest, times(below, factor)), RARE, words);
    }
}
