//! Claims with derivatives, sums, products and integrals as theorems about the printed formula, from the goals that they come to.

use super::comment;
use super::printed::{Printer, condition_text};
use super::steps::Steps;
use super::text::{Unwritten, number, property};
use crate::script::Decided;
use crate::{integration, summation};
use claims::Statements;
use kernel::{Certificate, Node, Origin, Property, Symbol};
use numbers::{Field, Rational};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fmt::Write;
use texmath::{Condition, Equation, Name, Operation, Relation, Series, Symbols, Tree, any_side, mapped};

type Text = Result<String, Unwritten>;

/// The most antiderivatives of one integral that are tried.
const MOST: usize = 3;

/// A claim as it is printed, with the table of symbols in which it was read.
#[derive(Clone, Copy)]
pub struct Printed<'a> {
    pub equation: &'a Equation,
    pub symbols: &'a Symbols,
}

/// Returns true if a formula holds an operation, or a factorial.
pub fn has_operations(equation: &Equation) -> bool {
    any_side(equation, &mut |node| match node {
        Tree::Operation(..) => true,
        Tree::Call(name, ..) => name.base.contains("factorial"),
        _ => false,
    })
}

/// The one equation that a claim prints.
///
/// # Errors
/// Why the claim is not written as it is printed.
pub fn equation(statements: &Statements) -> Result<&Equation, Unwritten> {
    if !statements.locals.is_empty() {
        return Err(Unwritten::Not("an operation with definitions"));
    }
    match statements.claims.as_slice() {
        [equation] => Ok(equation),
        _ => Err(Unwritten::Not("several equations with an operation")),
    }
}

/// The question that the claim itself comes to, where that is one; that parts of it have values are others.
///
/// # Errors
/// Why there is none.
pub fn main_goal(decided: &[Decided]) -> Result<&Decided, Unwritten> {
    let own: Vec<&Decided> = decided.iter().filter(|one| one.goal.part.is_empty()).collect();
    let says_more = |one: &&&Decided| one.question.equation.left != one.question.equation.right;
    let more: Vec<&Decided> = own.iter().filter(says_more).copied().collect();
    match (more.as_slice(), own.as_slice()) {
        ([one], _) | ([], [one, ..]) => Ok(*one),
        ([], []) => Err(Unwritten::Not("an operation in a claim by cases")),
        _ => Err(Unwritten::Not("an operation in a claim of several questions")),
    }
}

/// The induction over an integer by which a claim is proved: the letter, its first value, and the question of the step.
pub struct Induction<'a> {
    letter: &'a str,
    first: i64,
    step: &'a Decided,
}

impl<'a> Induction<'a> {
    pub fn of(decided: &'a [Decided]) -> Option<Self> {
        let letter_of = |one: &'a Decided| {
            let rest = one.goal.part.strip_prefix("the step from ")?;
            let (letter, next) = rest.split_once(" to ")?;
            (next == format!("{letter} + 1")).then_some((letter, one))
        };
        let (letter, step) = decided.iter().find_map(letter_of)?;
        let first = |one: &Decided| -> Option<i64> {
            let value = one.goal.part.strip_prefix(letter)?.strip_prefix(" = ")?;
            value.parse().ok()
        };
        let first = decided.iter().filter_map(first).min()?;
        Some(Self { letter, first, step })
    }

    /// The theorem, over the integers from the first value on.
    ///
    /// # Errors
    /// What of the claim is not written.
    pub fn theorem(&self, equation: &Equation, assume: &[Condition]) -> Text {
        let mut own = self.step.question.statement.clone();
        let steps = &mut Steps::new(&mut own, &Certificate::default(), &self.step.goal.symbols.index);
        let printer = Printer::of_operations(self.step);
        let letter = self
            .letter_in(equation)
            .ok_or(Unwritten::Not("an induction over another letter"))?;
        let name = printer.tree(&symbol(&letter), None, steps)?;
        let claim = printer.relation(equation, None, steps)?;
        let mut hypotheses = Vec::new();
        for condition in assume {
            hypotheses.push((printer.condition(condition, steps)?, condition_text(condition)));
        }
        self.add_givens(&name, &mut hypotheses, steps)?;
        let mut below = Vec::new();
        divisors(&equation.left, &mut below);
        divisors(&equation.right, &mut below);
        for own in below.into_iter().filter(|own| !own.has_free(&letter)) {
            let says = format!("{} <> 0", printer.tree(own, None, steps)?);
            if texmath::number_of(own).is_none() && hypotheses.iter().all(|(known, _)| *known != says) {
                hypotheses.push((says, Origin::ClaimDomain.to_string()));
            }
        }
        self.add_divisors_of_terms(equation, &letter, &printer, &mut hypotheses, steps)?;
        let first = number(&Rational::from_integer(self.first)).replace("(- ", "(-");
        let says = |says: &str| hypotheses.iter().any(|(own, _)| own == says);
        let is_bound = assume.iter().any(|condition| match condition {
            Condition::Relation(own) => own.left.has_free(&letter) || own.right.has_free(&letter),
            Condition::Integer(_) => false,
        });
        if !is_bound {
            let least = format!("{name} >= {first}");
            if !says(&least) {
                hypotheses.push((least, "from the first value on".into()));
            }
        }
        let (at_first, at_next) = self.ends(equation, &letter, &name, &first, &printer, steps)?;
        let variables: Vec<String> = steps.names.symbols().map(|(_, name)| name.clone()).collect();
        if steps.names.functions().next().is_some() {
            return Err(Unwritten::Not("an induction with unknown functions"));
        }
        let mut text = format!("Theorem holds :\n  forall {} : R,\n", variables.join(" "));
        for (says, why) in &hypotheses {
            let _ = writeln!(text, "  (* {} *)\n  ({says}) ->", comment(why));
        }
        let _ = writeln!(
            text,
            "  (* claim: {} *)\n  {claim}.\nProof.",
            comment(&equation.to_string())
        );
        let names: Vec<String> = (0..hypotheses.len()).map(|place| format!("P{place}")).collect();
        let _ = writeln!(text, "intros {}.\nintros {}.", variables.join(" "), names.join(" "));
        let _ = writeln!(text, "assert (L : {first} <= {name}) by lra.");
        let _ = writeln!(text, "assert (I : integer {name}) by assumption.");
        let of_letter = hypotheses
            .iter()
            .zip(&names)
            .filter(|((says, _), _)| words(says).any(|word| word == name));
        let of_letter: Vec<&str> = of_letter.map(|(_, own)| own.as_str()).collect();
        if !of_letter.is_empty() {
            let _ = writeln!(text, "clear {}.", of_letter.join(" "));
        }
        let _ = writeln!(
            text,
            "refine (integer_induction (fun {name} : R => {claim}) {first} _ _ _ {name} I L)."
        );
        let _ = writeln!(
            text,
            "{{ is_integer. }}\n{{ clear I L {name}; cbv beta.\n{at_first}first_value. }}"
        );
        let _ = writeln!(
            text,
            "{{ clear I L {name}; intros {name} I L H; cbv beta in H |- *.\n{at_next}next_terms."
        );
        let _ = writeln!(text, "step_by_algebra {name} H. }}\nQed.\n\nPrint Assumptions holds.");
        if !hypotheses.is_empty() {
            text += "\n(* That the hypotheses can hold is not written of inductions. *)\n";
        }
        Ok(text)
    }

    /// Takes in what is declared of the letters that are named, and the conditions of the claim that do not move.
    fn add_givens(
        &self,
        moves: &str,
        hypotheses: &mut Vec<(String, String)>,
        steps: &mut Steps,
    ) -> Result<(), Unwritten> {
        let named: BTreeSet<Symbol> = steps.names.symbols().map(|(symbol, _)| *symbol).collect();
        for given in self.step.question.statement.givens() {
            let is_meant = match given.origin {
                Origin::Declared(_) => true,
                Origin::ClaimDomain => matches!(given.property, Property::Nonzero | Property::Positive),
                _ => false,
            };
            let terms = steps.statement().terms();
            let mut is_named = true;
            for inner in terms.inside(given.term) {
                match terms.node(inner) {
                    Node::Symbol(symbol) => is_named &= named.contains(symbol),
                    Node::Value(..) => is_named = false,
                    _ => {}
                }
            }
            if !is_meant || !is_named || given.law.is_some() {
                continue;
            }
            let says = property(given.property, &steps.full(given.term)?);
            let is_domain = given.origin == Origin::ClaimDomain;
            let is_free =
                words(&says).all(|word| word != moves) && steps.statement().terms().inside(given.term).len() > 1;
            let is_known = hypotheses.iter().any(|(own, _)| *own == says);
            if !is_known && (!is_domain || is_free) {
                hypotheses.push((says, given.origin.to_string()));
            }
        }
        Ok(())
    }

    /// Takes in what the terms of sums and products divide by.
    ///
    /// # Errors
    /// A divisor that holds a letter and moves with the terms.
    fn add_divisors_of_terms(
        &self,
        equation: &Equation,
        letter: &Name,
        printer: &Printer,
        hypotheses: &mut Vec<(String, String)>,
        steps: &mut Steps,
    ) -> Result<(), Unwritten> {
        let mut found = Vec::new();
        outermost(&equation.left, &mut found);
        outermost(&equation.right, &mut found);
        for operation in found {
            let Operation::Series { of, index, .. } = operation else {
                continue;
            };
            let mut below = Vec::new();
            divisors(of, &mut below);
            for own in below {
                let moves = own.has_free(index) || own.has_free(letter);
                let has_letters = texmath::any(
                    own,
                    &mut |node| matches!(node, Tree::Symbol(name, _) if name != index && name != letter && own.has_free(name)),
                );
                if moves && has_letters {
                    return Err(Unwritten::Not("an induction over terms that are divided by letters"));
                }
                if has_letters {
                    let says = format!("{} <> 0", printer.tree(own, None, steps)?);
                    if hypotheses.iter().all(|(known, _)| *known != says) {
                        hypotheses.push((says, Origin::ClaimDomain.to_string()));
                    }
                }
            }
        }
        Ok(())
    }

    fn letter_in(&self, equation: &Equation) -> Option<Name> {
        let mut found = None;
        any_side(equation, &mut |node| {
            if let Tree::Symbol(name, _) = node
                && name.to_string() == self.letter
            {
                found = Some(name.clone());
            }
            found.is_some()
        });
        found
    }

    /// The tactics that write the ends of sums and products at the first value as numbers, and at the next value by the ends before.
    fn ends(
        &self,
        equation: &Equation,
        letter: &Name,
        name: &str,
        first: &str,
        printer: &Printer,
        steps: &mut Steps,
    ) -> Result<(String, String), Unwritten> {
        let mut found = Vec::new();
        outermost(&equation.left, &mut found);
        outermost(&equation.right, &mut found);
        let (mut at_first, mut at_next) = (String::new(), String::new());
        for operation in found {
            let Operation::Series {
                of, from, to, index, ..
            } = operation
            else {
                return Err(Unwritten::Not("an operation other than a sum in an induction"));
            };
            if has_operation(of) {
                return Err(Unwritten::Not("an operation within a sum"));
            }
            if index != letter && of.has_free(letter) || from.has_free(letter) {
                return Err(Unwritten::Not("a sum whose terms depend on its length"));
            }
            let at = |value: i64| linear_value(to, letter, value);
            let (Some(zero), Some(one), Some(two), Some(value)) = (at(0), at(1), at(2), at(self.first)) else {
                return Err(Unwritten::Not("a sum whose length is not linear"));
            };
            let more = one - zero;
            if two - one != more || !(0..=3).contains(&more) {
                return Err(Unwritten::Not("a sum whose length is not linear"));
            }
            let low = printer.tree(from, None, steps)?;
            if let Some(low_value) = linear_value(from, letter, 0)
                && low_value < 0
            {
                let _ = writeln!(at_first, "replace {low} with ({low_value}) by lra.");
            }
            let now = printer.tree(to, None, steps)?;
            let own = printer.at(to, letter, first, steps)?;
            let _ = writeln!(at_first, "try replace {own} with ({value}) by lra.");
            let next = printer.at(to, letter, &format!("({name} + 1)"), steps)?;
            let sum = (0..more).fold(now, |sum, _| format!("({sum} + 1)"));
            if next != sum {
                let _ = writeln!(at_next, "try replace {next} with {sum} by ring.");
            }
        }
        Ok((at_first, at_next))
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '\''))
}

fn symbol(name: &Name) -> Tree {
    Tree::Symbol(name.clone(), texmath::At::default())
}

/// The value of a linear tree in one letter at an integer.
fn linear_value(tree: &Tree, letter: &Name, at: i64) -> Option<i64> {
    let of = |tree: &Tree| linear_value(tree, letter, at);
    match tree {
        Tree::Number(value) => (0..=1_000_000_i64).find(|own| Rational::from_integer(*own) == *value),
        Tree::Symbol(name, _) => (name == letter).then_some(at),
        Tree::Negate(inner) => of(inner)?.checked_neg(),
        Tree::Sum(parts) => parts.iter().try_fold(0_i64, |sum, part| sum.checked_add(of(part)?)),
        Tree::Product(parts) => parts
            .iter()
            .try_fold(1_i64, |product, part| product.checked_mul(of(part)?)),
        _ => None,
    }
}

/// The kinds of such claims.
pub enum Kind {
    /// A limit or an improper integral: the claim without its value, of which there is one.
    OneValue(String),
    /// An antiderivative, for all values of so many constants.
    Antiderivative(usize),
}

/// A claim that an operation has a value which is no number by itself in Rocq, with its proof.
pub struct Valued {
    pub claim: String,
    pub kind: Kind,
    /// The proof, where it needs no goal.
    pub proof: Option<String>,
}

/// The kinds of an end of an integral.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Proper,
    Singular,
    Infinite,
}

impl Printed<'_> {
    /// A limit, or an improper integral, that is claimed to have a value.
    ///
    /// # Errors
    /// What of it is not written.
    pub fn valued(&self, decided: &Decided, steps: &mut Steps) -> Result<Option<Valued>, Unwritten> {
        let Equation {
            left, relation, right, ..
        } = self.equation;
        let Tree::Operation(operation, _) = left else {
            return Ok(None);
        };
        if *relation != Relation::Equal || has_operation(right) {
            return Ok(None);
        }
        let printer = Printer::of_operations(decided);
        match &**operation {
            Operation::Limit { of, by, to } => {
                if has_operation(to) {
                    return Err(Unwritten::Not("a limit at infinity or from one side"));
                }
                if has_operation(of) {
                    return Err(Unwritten::Not("an operation within a limit"));
                }
                let value = printer.tree(right, None, steps)?;
                let at = printer.tree(to, None, steps)?;
                let function = printer.function(of, by, None, steps)?;
                let mut ways = vec!["limit_here".to_owned()];
                if let Tree::Quotient(above, below, _) = of {
                    let above = printer.function(above, by, None, steps)?;
                    let below = printer.function(below, by, None, steps)?;
                    ways.push(format!("limit_of_quotient {above} {below} {at}"));
                    ways.push("by_lhopital".into());
                }
                Ok(Some(Valued {
                    claim: format!("is_lim {function} {at} {value}"),
                    kind: Kind::OneValue(format!("is_lim {function} {at}")),
                    proof: Some(format!(
                        "first [{}].\n",
                        ways.iter()
                            .map(|way| format!("solve [{way}]"))
                            .collect::<Vec<_>>()
                            .join(" | ")
                    )),
                }))
            }
            Operation::Integral { of, by, limits: None } => {
                if has_operation(of) {
                    return Err(Unwritten::Not("an operation within an integral"));
                }
                let point = printer.tree(&symbol(by), None, steps)?;
                // a constant of integration is no letter of the goal
                let mut constants: Vec<Name> = Vec::new();
                texmath::any(right, &mut |node| {
                    if let Tree::Symbol(name, _) = node
                        && name != by
                        && !constants.contains(name)
                        && printer.tree(node, None, steps).is_err()
                    {
                        constants.push(name.clone());
                    }
                    false
                });
                let names: Vec<String> = constants.iter().map(|name| steps.bind(name)).collect();
                let function = printer.function(right, by, None, steps);
                names.iter().for_each(|_| steps.unbind());
                let claim = format!("is_derive {} {point} {}", function?, printer.tree(of, None, steps)?);
                Ok(Some(Valued {
                    claim: match names.is_empty() {
                        true => claim,
                        false => format!("forall {} : R, {claim}", names.join(" ")),
                    },
                    kind: Kind::Antiderivative(names.len()),
                    proof: None,
                }))
            }
            Operation::Integral {
                of,
                by,
                limits: Some(limits),
            } => {
                let ends = [&limits.0, &limits.1].map(|end| end_of(of, by, end));
                if is_singular_between(of, by, limits) {
                    return Err(SINGULAR);
                }
                match ends {
                    [End::Proper, End::Proper] => return Ok(None),
                    [End::Proper, End::Singular] | [End::Singular, End::Proper] => {}
                    [End::Infinite, _] | [_, End::Infinite] => {
                        return Err(Unwritten::Not("an integral to infinity"));
                    }
                    _ => return Err(Unwritten::Not("an integral that is improper at both ends")),
                }
                // from which side the singular end is approached
                let [from, to] = [&limits.0, &limits.1].map(|end| guess(end, &|_| f64::NAN));
                if from
                    .zip(to)
                    .is_none_or(|(from, to)| from.partial_cmp(&to) != Some(Ordering::Less))
                {
                    return Err(Unwritten::Not(
                        "an improper integral between letters, or from right to left",
                    ));
                }
                if has_operation(of) {
                    return Err(Unwritten::Not("an operation within an integral"));
                }
                let low = printer.tree(&limits.0, None, steps)?;
                let high = printer.tree(&limits.1, None, steps)?;
                let (low, high) = match ends {
                    [End::Singular, _] => (format!("(at_right {low})"), format!("(at_point {high})")),
                    _ => (format!("(at_point {low})"), format!("(at_left {high})")),
                };
                let value = printer.tree(right, None, steps)?;
                let function = printer.function(of, by, None, steps)?;
                let mut ways = Vec::new();
                for way in antiderivatives(of, by, self.symbols) {
                    ways.push(format!(
                        "solve [improper_by {}]",
                        printer.function(&way, by, None, steps)?
                    ));
                }
                if ways.is_empty() {
                    return Err(Unwritten::Not("an integral without an antiderivative"));
                }
                let subject = format!("is_RInt_gen {function} {low} {high}");
                Ok(Some(Valued {
                    claim: format!("{subject} {value}"),
                    kind: Kind::OneValue(subject),
                    proof: Some(format!("first\n[ {} ].\n", ways.join("\n| "))),
                }))
            }
            _ => Ok(None),
        }
    }

    /// The tactics that replace each operation of the claim by its value, line by line.
    ///
    /// # Errors
    /// Which operation has no value here.
    pub fn values(&self, decided: &Decided, steps: &mut Steps) -> Text {
        let mut found = Vec::new();
        outermost(&self.equation.left, &mut found);
        outermost(&self.equation.right, &mut found);
        let printer = Printer::of_operations(decided);
        let mut text = String::new();
        let mut written = Vec::new();
        let mut is_unrolled = false;
        for operation in found {
            let tree = Tree::Operation(Box::new(operation.clone()), texmath::At::default());
            let says = printer.tree(&tree, None, steps)?;
            if written.contains(&says) {
                continue;
            }
            let number = written.len();
            written.push(says.clone());
            match operation {
                Operation::Integral {
                    of,
                    by,
                    limits: Some(limits),
                } => text += &self.integral(number, &says, (of, by, limits), &printer, steps)?,
                Operation::Derivative { of, by, order, at } => {
                    if has_operation(of) {
                        return Err(Unwritten::Not("an operation within a derivative"));
                    }
                    let function = printer.function(of, by, None, steps)?;
                    let at = printer.tree(at, None, steps)?;
                    match order {
                        0 => {}
                        1 => {
                            let _ = writeln!(text, "value_of_derivative Q{number} {function} {at}.");
                            let _ = writeln!(text, "rewrite Q{number}; clear Q{number}.");
                        }
                        _ => {
                            let _ = writeln!(text, "higher_derivative Q{number} {function} {order}%nat {at}.");
                            let _ = writeln!(text, "rewrite Q{number}; clear Q{number}.");
                        }
                    }
                }
                Operation::Series {
                    kind,
                    of,
                    index,
                    from,
                    to,
                } => {
                    if has_operation(of) {
                        return Err(Unwritten::Not("an operation within a sum"));
                    }
                    let is_number = |tree: &Tree| texmath::number_of(tree).is_some();
                    if is_number(from) && is_number(to) {
                        is_unrolled = true;
                        continue;
                    }
                    let closed = (*kind == Series::Sum)
                        .then(|| summation::telescoping(of, index))
                        .flatten();
                    let closed = closed.ok_or(Unwritten::Not("a sum of symbolic length without a closed form"))?;
                    let function = printer.function(&closed, index, None, steps)?;
                    let [low, high] = [from, to].map(|end| printer.tree(end, None, steps));
                    let _ = writeln!(
                        text,
                        "assert (Q{number} : {says} = {function} ({} + 1) - {function} {}) by sum_by {function}.\n\
                         cbv beta in Q{number}; rewrite Q{number}; clear Q{number}.",
                        high?, low?
                    );
                }
                _ => return Err(Unwritten::Not("an operation of another kind")),
            }
        }
        if is_unrolled {
            text += "unroll.\n";
        }
        Ok(text)
    }

    /// An integral between finite limits, by an antiderivative.
    fn integral(
        &self,
        number: usize,
        says: &str,
        (of, by, limits): (&Tree, &Name, &(Tree, Tree)),
        printer: &Printer,
        steps: &mut Steps,
    ) -> Text {
        if has_operation(of) {
            return Err(Unwritten::Not("an operation within an integral"));
        }
        if [&limits.0, &limits.1]
            .into_iter()
            .any(|end| end_of(of, by, end) != End::Proper)
        {
            return Err(Unwritten::Not("an improper integral within a formula"));
        }
        if is_singular_between(of, by, limits) {
            return Err(SINGULAR);
        }
        let [low, high] = [&limits.0, &limits.1].map(|end| printer.tree(end, None, steps));
        let (low, high) = (low?, high?);
        let ways = antiderivatives(of, by, self.symbols);
        let mut lines = Vec::new();
        for way in &ways {
            let function = printer.function(way, by, None, steps)?;
            lines.push(format!(
                "assert (Q{number} : {says} = {function} {high} - {function} {low}) by (integrate_by {function})"
            ));
        }
        lines.extend(self.over_pieces(number, says, (of, by, limits), printer, steps)?);
        if lines.is_empty() {
            return Err(Unwritten::Not("an integral without an antiderivative"));
        }
        Ok(format!(
            "first\n[ {} ].\ncbv beta in Q{number}; rewrite Q{number}; clear Q{number}.\n",
            lines.join("\n| ")
        ))
    }
}

impl Printed<'_> {
    /// The value of an integral between numbers as a sum over pieces, between the places at which what stands between bars or
    /// under an odd root is 0; nothing where there are none.
    fn over_pieces(
        &self,
        number: usize,
        says: &str,
        (of, by, limits): (&Tree, &Name, &(Tree, Tree)),
        printer: &Printer,
        steps: &mut Steps,
    ) -> Result<Option<String>, Unwritten> {
        let at = |tree: &Tree| guess(tree, &|_| f64::NAN).filter(|value| value.is_finite());
        let (Some(from), Some(to)) = (at(&limits.0), at(&limits.1)) else {
            return Ok(None);
        };
        let mut places: Vec<(f64, Tree)> = Vec::new();
        texmath::any(of, &mut |node| {
            let inner = match node {
                Tree::Call(name, inner, _) if name.base == r"\abs" => inner,
                Tree::Root(inner, index, _) if index % 2 == 1 => inner,
                _ => return false,
            };
            for place in integration::zeros(inner, by, [&limits.0, &limits.1]) {
                let value = at(&place).filter(|value| from < *value && *value < to);
                let is_new = |value: f64| places.iter().all(|(known, _)| (known - value).abs() > 1e-9);
                if let Some(value) = value.filter(|value| is_new(*value)) {
                    places.push((value, place));
                }
            }
            false
        });
        if places.is_empty() || places.len() > MOST_PLACES {
            return Ok(None);
        }
        places.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        places.push((to, limits.1.clone()));
        let (mut before, mut low) = (from, printer.tree(&limits.0, None, steps)?);
        let (mut values, mut tactics) = (Vec::new(), Vec::new());
        for (place, end) in places {
            let middle = 0.5 * (before + place);
            let own = mapped(of, &|node| match node {
                Tree::Call(name, inner, _) if name.base == r"\abs" => {
                    let value = guess(inner, &|letter| if letter == by { middle } else { f64::NAN })?;
                    without_bars(node, value < 0.0)
                }
                _ => None,
            });
            let high = printer.tree(&end, None, steps)?;
            let Some(way) = antiderivatives(&own, by, self.symbols).into_iter().next() else {
                return Ok(None);
            };
            let own = printer.function(&own, by, None, steps)?;
            let way = printer.function(&way, by, None, steps)?;
            values.push(format!("({way} {high} - {way} {low})"));
            tactics.push((high.clone(), format!("piece {own} {way}")));
            (before, low) = (place, high);
        }
        let (mut value, mut tactic) = (String::new(), String::new());
        for (own, (high, piece)) in values.into_iter().zip(tactics).rev() {
            (value, tactic) = match value.is_empty() {
                true => (own, piece),
                false => (
                    format!("({own} + {value})"),
                    format!("(split_at {high}; [{piece} | {tactic}])"),
                ),
            };
        }
        Ok(Some(format!("assert (Q{number} : {says} = {value}) by {tactic}")))
    }
}

/// The most places at which an integral is divided.
const MOST_PLACES: usize = 4;

/// The kind of an end of an integral, as its integrand looks there: letters are taken to be some numbers.
fn end_of(of: &Tree, by: &Name, end: &Tree) -> End {
    if has_operation(end) {
        return End::Infinite;
    }
    let at = guess(end, &some_number);
    let is_finite = at
        .and_then(|at| guess(of, &|letter| if letter == by { at } else { some_number(letter) }))
        .is_none_or(|value| value.is_finite() && value.abs() < 1e9);
    if is_finite { End::Proper } else { End::Singular }
}

const SINGULAR: Unwritten = Unwritten::Not("an integral over a point at which its integrand has no value");

/// Returns true if the integrand has no finite value somewhere between the ends, as it is sampled, letters taken to be some
/// numbers. In Rocq the integral has some value then too.
fn is_singular_between(of: &Tree, by: &Name, limits: &(Tree, Tree)) -> bool {
    let (Some(from), Some(to)) = (guess(&limits.0, &some_number), guess(&limits.1, &some_number)) else {
        return false;
    };
    let places = (1..SAMPLES).map(|n| from + (to - from) * f64::from(n) / f64::from(SAMPLES));
    let whole = (-3..=3).map(f64::from).filter(|at| (at - from) * (at - to) < 0.0);
    places.chain(whole).any(|at| {
        let value = guess(of, &|letter| if letter == by { at } else { some_number(letter) });
        value.is_some_and(|value| !value.is_finite() || value.abs() > 1e9)
    })
}

/// The places at which an integrand is sampled; divisible, so that thirds, quarters and fifths are among them.
const SAMPLES: u32 = 240;

/// A number in place of a letter, another for each.
fn some_number(letter: &Name) -> f64 {
    0.7 + 0.01 * letter.to_string().bytes().map(f64::from).sum::<f64>().sin()
}

/// The value of a tree as a machine number; `None` where a function is not known here.
fn guess(tree: &Tree, value: &dyn Fn(&Name) -> f64) -> Option<f64> {
    let of = |tree: &Tree| guess(tree, value);
    Some(match tree {
        Tree::Number(own) => own.0.to_f64().value(),
        Tree::Symbol(name, _) => match name.to_string().as_str() {
            r"\pi" => std::f64::consts::PI,
            "e" => std::f64::consts::E,
            _ => value(name),
        },
        Tree::Negate(inner) => -of(inner)?,
        Tree::Sum(parts) => parts.iter().map(of).sum::<Option<f64>>()?,
        Tree::Product(parts) => parts.iter().map(of).product::<Option<f64>>()?,
        Tree::Quotient(above, below, _) => of(above)? / of(below)?,
        Tree::Power(base, exponent, _) => of(base)?.powi(*exponent),
        Tree::RealPower(base, exponent, _) => of(base)?.powf(of(exponent)?),
        Tree::Root(inner, index, _) => match index % 2 {
            0 => of(inner)?.powf(1.0 / f64::from(*index)),
            _ => {
                let inner = of(inner)?;
                inner.signum() * inner.abs().powf(1.0 / f64::from(*index))
            }
        },
        Tree::Call(name, inner, _) => {
            let inner = of(inner)?;
            match name.base.as_str() {
                r"\abs" => inner.abs(),
                r"\sin" => inner.sin(),
                r"\cos" => inner.cos(),
                r"\tan" => inner.tan(),
                r"\exp" => inner.exp(),
                r"\ln" => inner.ln(),
                r"\arcsin" => inner.asin(),
                r"\arccos" => inner.acos(),
                r"\arctan" => inner.atan(),
                r"\sinh" => inner.sinh(),
                r"\cosh" => inner.cosh(),
                r"\tanh" => inner.tanh(),
                _ => return None,
            }
        }
        _ => return None,
    })
}

/// Antiderivatives to be tried, and those with and without the bars of their logarithms.
fn antiderivatives(of: &Tree, by: &Name, symbols: &Symbols) -> Vec<Tree> {
    let mut found: Vec<Tree> = Vec::new();
    for way in integration::antiderivatives(of, by, symbols).into_iter().take(MOST) {
        for sign in [None, Some(false), Some(true)] {
            let own = match sign {
                None => way.clone(),
                Some(is_negative) => mapped(&way, &|node| without_bars(node, is_negative)),
            };
            if !found.contains(&own) {
                found.push(own);
            }
        }
    }
    found
}

fn without_bars(node: &Tree, is_negative: bool) -> Option<Tree> {
    match node {
        Tree::Call(name, inner, _) if name.base == r"\abs" => Some(match is_negative {
            true => Tree::Negate(inner.clone()),
            false => (**inner).clone(),
        }),
        _ => None,
    }
}

fn has_operation(tree: &Tree) -> bool {
    texmath::any(tree, &mut |node| matches!(node, Tree::Operation(..)))
}

/// Finds the divisors that stand outside of operations.
fn divisors<'t>(tree: &'t Tree, found: &mut Vec<&'t Tree>) {
    match tree {
        Tree::Operation(..) => return,
        Tree::Quotient(_, below, _) => found.push(below),
        Tree::Power(base, exponent, _) if *exponent < 0 => found.push(base),
        _ => {}
    }
    tree.find_below(&mut |node| -> Option<()> {
        divisors(node, found);
        None
    });
}

/// The operations that stand in no other one.
fn outermost<'t>(tree: &'t Tree, found: &mut Vec<&'t Operation>) {
    let mut visit = |node: &'t Tree| -> Option<()> {
        match node {
            Tree::Operation(operation, _) => found.push(operation),
            node => outermost(node, found),
        }
        None
    };
    match tree {
        Tree::Operation(operation, _) => found.push(operation),
        tree => {
            tree.find_below(&mut visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::files;
    use crate::{Options, decided};
    use claims::Sheet;

    fn written(tex: &str, assume: &str) -> String {
        let text = format!(
            "title = \"t\"\n[symbols]\nparameters = ['a', 'x']\nintegers = ['n', 'k']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\n\
             tex = '{tex}'\nassume = [{assume}]\nexpect = \"proved\"\n"
        );
        let sheet = Sheet::read(&text, &texmath::Symbols::default()).expect("a sheet");
        let mut files = files(&sheet, 0, &decided(&sheet, 0, &Options::default()));
        assert_eq!(files.len(), 1, "{tex}");
        files.remove(0).expect("a file")
    }

    #[test]
    fn theorems_are_what_is_printed() {
        let integral = written(r"\int_0^a x^2 \, dx = \frac{a^3}{3}", "");
        assert!(
            integral.contains("(RInt (fun x : R => (x ^ 2)) 0 a : R) = ((a ^ 3) / 3)."),
            "{integral}"
        );
        let sum = written(r"\sum_{k=1}^n k = \frac{n (n + 1)}{2}", r"'n \ge 0'");
        assert!(
            sum.contains("(rsum 1 n (fun k : R => k)) = ((n * (n + 1)) / 2)."),
            "{sum}"
        );
        let limit = written(r"\lim_{x \to 0} \frac{\sin x}{x} = 1", "");
        assert!(limit.contains("is_lim (fun x : R => ((sin x) / x)) 0 1."), "{limit}");
    }

    #[test]
    fn what_rocq_would_read_in_another_way_is_not_written_as_printed() {
        for tex in [
            r"\int_{-1}^{1} \frac{1}{\sqrt{|x|}} dx = 4",
            r"\int_1^0 \frac{1}{\sqrt x} dx = -2",
            r"\int_0^b \frac{1}{\sqrt x} dx = \sqrt b",
            r"\prod_{k=1}^n \frac{a+k}{a+k-1} = \frac{a+n}{a}",
            r"\frac{d}{dx} f(x)^2 = 2 f(x)",
        ] {
            let text = format!(
                "title = \"t\"\n[symbols]\nparameters = ['a', 'b', 'x']\nintegers = ['n', 'k']\n\
                 functions = {{ f = 'g', g = '' }}\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\ntex = '{tex}'\n"
            );
            let sheet = Sheet::read(&text, &texmath::Symbols::default()).expect("a sheet");
            let files = files(&sheet, 0, &decided(&sheet, 0, &Options::default()));
            assert!(files.first().is_some_and(Result::is_err), "{tex}");
        }
    }

    #[test]
    fn nothing_holds_that_is_refuted() {
        let sheet = "title = \"t\"\n[symbols]\nparameters = ['x']\n[[equation]]\nlabel = \"1\"\nrole = \"claim\"\n\
                     tex = '\\int_0^1 x \\, dx = 1'\nexpect = \"refuted\"\n";
        let sheet = Sheet::read(sheet, &texmath::Symbols::default()).expect("a sheet");
        for file in files(&sheet, 0, &decided(&sheet, 0, &Options::default()))
            .into_iter()
            .flatten()
        {
            assert!(!file.contains("Theorem holds"), "{file}");
        }
    }
}
