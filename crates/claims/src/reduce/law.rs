//! Functions that a premise gives by a formula, at every value of the running symbol: `p(x) = a x^2 + b`, `y = \\cos t`.

use super::super::premise::{Premise, Statements};
use super::defined;
use super::derivative::By;
use texmath::{At, Equation, Name, Operation, Relation, Symbols, Tree, any, any_side, mapped, nodes_of, rewrite};

/// The largest formula, and the deepest that laws are put into one another.
const LARGEST: usize = 20_000;
const DEEPEST: u32 = 6;

/// The argument of the function that a tree is a value of; itself where it has none.
pub(super) fn names_function<'t>(tree: &'t Tree, function: &Name) -> Option<&'t Tree> {
    match tree {
        Tree::Call(name, at, _) if name == function => Some(at),
        Tree::Symbol(name, _) if name == function => Some(tree),
        _ => None,
    }
}

/// Whether a premise says what a function is at every value of the running symbol: no condition restricts it.
fn says(premise: &Premise, function: &Name, running: &Name) -> bool {
    let is_running = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name == running || name == function);
    names_function(&premise.equation.left, function).is_some_and(is_running)
        && premise.equation.relation == Relation::Equal
        && premise.assume.is_empty()
}

/// The formula of a function at an argument, where exactly one premise says what it is; it may hold values of other
/// functions.
pub(super) fn value_of(function: &Name, argument: &Tree, statements: &Statements, symbols: &Symbols) -> Option<Tree> {
    let running = symbols.running()?;
    let mut premises = statements.premises.iter();
    let premise = premises.find(|premise| says(premise, function, running))?;
    if premises.any(|premise| says(premise, function, running)) {
        return None;
    }
    let formula = &premise.equation.right;
    let calls = |node: &Tree| matches!(node, Tree::Call(name, ..) | Tree::Symbol(name, _) if name == function);
    if any(formula, &mut |node| calls(node)) {
        return None;
    }
    Some(rewrite(formula, &|name| match name == running {
        true => Some(argument.clone()),
        false if symbols.names.is_function(name) => {
            Some(Tree::Call(name.clone(), Box::new(argument.clone()), At::default()))
        }
        false => None,
    }))
}

/// What laws make of formulas in which the running symbol is bound.
pub(super) struct Laws<'a> {
    pub statements: &'a Statements,
    pub symbols: &'a Symbols,
}

impl Laws<'_> {
    /// The tree with the formulas of functions, and of derivatives of these, put into the integrals over the running
    /// symbol. A law holds wherever its right side is defined: that this is so on the interval is for others to show, by
    /// the formulas.
    pub fn in_integrals(&self, tree: &Tree) -> Tree {
        mapped(tree, &|node| match node {
            Tree::Operation(operation, at) => match &**operation {
                Operation::Integral {
                    of,
                    by,
                    limits: Some((low, high)),
                } if self.symbols.running() == Some(by) => {
                    let operation = Operation::Integral {
                        of: self.put_in(of, DEEPEST)?,
                        by: by.clone(),
                        limits: Some((self.in_integrals(low), self.in_integrals(high))),
                    };
                    Some(Tree::Operation(Box::new(operation), *at))
                }
                _ => None,
            },
            _ => None,
        })
    }

    /// The tree with the formula of each function in it that has one; `None` where that is too large.
    fn put_in(&self, tree: &Tree, depth: u32) -> Option<Tree> {
        let running = self.symbols.running()?;
        let is_value = |name: &Name| self.symbols.is_function(name) && !self.symbols.is_parameter(name);
        let put = mapped(tree, &|node| {
            let there = match node {
                Tree::Call(name, argument, _) if is_value(name) => self.formula(name, argument),
                Tree::Symbol(name, at) if is_value(name) => self.formula(name, &Tree::Symbol(running.clone(), *at)),
                _ => None,
            }?;
            self.put_in(&there, depth.checked_sub(1)?)
        });
        (nodes_of(&put) <= LARGEST).then_some(put)
    }

    /// The formula of a function, or of the derivative of one, at an argument.
    fn formula(&self, function: &Name, argument: &Tree) -> Option<Tree> {
        self.of_order(function, argument, DEEPEST)
    }

    fn of_order(&self, function: &Name, argument: &Tree, depth: u32) -> Option<Tree> {
        if let Some(value) = value_of(function, argument, self.statements, self.symbols) {
            return Some(value);
        }
        let running = self.symbols.running()?;
        let before = self.symbols.antiderivative_of(function)?;
        let here = Tree::Symbol(running.clone(), At::default());
        let value = self.of_order(&before, &here, depth.checked_sub(1)?)?;
        // where the function itself has no formula, its derivative has none either, as that of \\ln t before 0
        let domain = defined::conditions(&value, self.symbols).ok()?;
        let is_restricted = |condition: &Equation| any_side(condition, &mut |node| *node == here);
        if domain.iter().any(is_restricted) {
            return None;
        }
        let by = By {
            symbols: self.symbols,
            name: running,
        };
        let slope = by.of(&value).ok()?;
        Some(rewrite(&slope, &|name| (name == running).then(|| argument.clone())))
    }
}
