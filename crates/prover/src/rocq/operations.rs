//! Claims with derivatives, sums, products and integrals as theorems about the printed formula, from the goals that they come to.

use super::printed::Printer;
use super::steps::Steps;
use super::text::Unwritten;
use crate::integration;
use crate::script::{Decided, Found};
use claims::Statements;
use std::fmt::Write;
use texmath::{Equation, Name, Operation, Symbols, Tree, any_side, mapped};

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

/// The question that the claim itself comes to, where that is one and proved.
///
/// # Errors
/// Why there is none.
pub fn main_goal(decided: &[Decided]) -> Result<&Decided, Unwritten> {
    let mut goals = decided.iter().filter(|one| one.goal.part.is_empty());
    match (goals.next(), goals.next()) {
        (Some(goal), None) if matches!(goal.found, Found::Proved { .. }) => Ok(goal),
        (Some(_), Some(_)) => Err(Unwritten::Not("an operation in a claim of several questions")),
        _ => Err(Unwritten::Not("an operation in a claim by cases or by induction")),
    }
}

impl Printed<'_> {
    /// What replaces each operation of the claim by its value, line by line.
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
                            let _ = writeln!(text, "value_of_derivative E{number} {function} {at}.");
                            let _ = writeln!(text, "rewrite E{number}; clear E{number}.");
                        }
                        _ => {
                            let _ = writeln!(text, "higher_derivative E{number} {function} {order} {at}.");
                            let _ = writeln!(text, "rewrite E{number}; clear E{number}.");
                        }
                    }
                }
                Operation::Series { of, from, to, .. } => {
                    if has_operation(of) {
                        return Err(Unwritten::Not("an operation within a sum"));
                    }
                    let is_number = |tree: &Tree| texmath::number_of(tree).is_some();
                    if !is_number(from) || !is_number(to) {
                        return Err(Unwritten::Not("a sum of symbolic length that is no induction"));
                    }
                    is_unrolled = true;
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
        let [low, high] = [&limits.0, &limits.1].map(|end| printer.tree(end, None, steps));
        let (low, high) = (low?, high?);
        let ways = antiderivatives(of, by, self.symbols);
        if ways.is_empty() {
            return Err(Unwritten::Not("an integral without an antiderivative"));
        }
        let mut lines = Vec::new();
        for way in &ways {
            let function = printer.function(way, by, None, steps)?;
            lines.push(format!(
                "assert (E{number} : {says} = {function} {high} - {function} {low}) by (integrate {function}; same_value)"
            ));
        }
        Ok(format!(
            "first\n[ {} ].\ncbv beta in E{number}; rewrite E{number}; clear E{number}.\n",
            lines.join("\n| ")
        ))
    }
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
