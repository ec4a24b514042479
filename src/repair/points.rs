//! Points at which the premises of a claim hold, with or without operations in it.

use crate::claim::Statements;
use crate::evidence::sampled::{Leaves, Number, asked, real, take_leaves, take_standing};
use crate::evidence::samples;
use crate::number::Sequence;
use crate::tex::{At, Equation, Name, Operation, Symbols, Tree, any, any_side, pair_of, tree_runs};
use std::collections::{HashMap, HashSet};

/// What the power is of that an `O` leaves out, at the points at which a claim with it is looked at.
const LEFT_OUT: f64 = 1e-8;

/// A claim whose formulas are to be evaluated.
pub struct Asked<'a> {
    pub statements: &'a Statements,
    pub symbols: &'a Symbols,
    /// What is to hold.
    pub equations: &'a [Equation],
    pub definitions: &'a HashMap<Name, Tree>,
}

impl Asked<'_> {
    /// The values of the leaves of these trees at points where the premises hold, and at some where these need not. Nothing
    /// where none are found, or where something in the claim has no value by itself.
    pub fn drawn(&self, trees: &[&Tree], points: usize, free: usize) -> Option<(Leaves, Option<Leaves>)> {
        let sides = || {
            self.equations
                .iter()
                .flat_map(|equation| [&equation.left, &equation.right])
        };
        let defined: HashSet<Name> = self.definitions.keys().cloned().collect();
        if sides().chain(self.definitions.values()).any(has_no_value) {
            return None;
        }
        let mut leaves = Vec::new();
        for tree in trees {
            take_leaves(tree, &defined, &mut leaves);
        }
        let runs = |leaf: &Tree| tree_runs(leaf, self.symbols);
        for tree in sides().chain(self.definitions.values()) {
            take_standing(tree, self.symbols.running(), &runs, &mut leaves);
        }
        // in the order in which they stand: which points are drawn is the same in each run
        let mut met = HashSet::new();
        leaves.retain(|leaf| met.insert(leaf.clone()));
        let within: Vec<Tree> = sides().filter(|side| !any(side, &mut is_operation)).cloned().collect();
        let statements = self.premises();
        let sample = |statements: &Statements, points: usize| {
            let drawn = self.sample(statements, &leaves, &within, points);
            drawn.or_else(|| self.sample(statements, &leaves, &[], points))
        };
        let mut drawn = sample(&statements, points)?;
        let is_defined =
            |leaves: &Leaves, point: usize| sides().all(|side| leaves.value(side, point, self.definitions).is_finite());
        if (0..drawn.points).any(|point| is_defined(&drawn, point)) {
            let kept: Vec<bool> = (0..drawn.points).map(|point| is_defined(&drawn, point)).collect();
            drawn.keep(|point| kept.get(point) == Some(&true));
        } else if sides().any(binds) {
            return None;
        }
        let unbound = Statements {
            premises: Vec::new(),
            locals: Vec::new(),
            ..statements.clone()
        };
        let is_number = |tree: &Tree| drawn.value(tree, 0, self.definitions).number().is_some();
        let mut locals = self.statements.locals.iter();
        let is_bound = !statements.premises.is_empty() && locals.all(|local| is_number(&local.tree));
        let mut free = is_bound.then(|| sample(&unbound, free)).flatten();
        // what is defined takes any value
        let mut any = Sequence::new(1);
        for local in &self.statements.locals {
            if let Some(free) = &mut free {
                let values = (0..free.points).map(|_| real(any.between(0.2, 2.0)));
                free.values
                    .insert(Tree::Symbol(local.name.clone(), At::default()), values.collect());
            }
        }
        Some((drawn, free))
    }

    fn sample(&self, statements: &Statements, leaves: &[Tree], within: &[Tree], points: usize) -> Option<Leaves> {
        let plain: Vec<Tree> = leaves.iter().map(asked).collect();
        let drawn = samples(statements, self.symbols, &plain, within, points)?;
        let is_complex = drawn.is_complex || self.speaks_of_complex();
        let points = drawn.values.first().map_or(0, Vec::len);
        let number = |[re, im]: [f64; 2]| Number::new(re, im);
        let all = leaves.iter().zip(drawn.values);
        let mut values: HashMap<Tree, Vec<Number>> = all
            .map(|(leaf, values)| (leaf.clone(), values.into_iter().map(number).collect()))
            .collect();
        for (leaf, values) in &mut values {
            let is_unit = matches!(leaf, Tree::Symbol(name, _) if name.to_string() == "i");
            if is_unit && is_complex && !self.symbols.parameters().any(|name| name.to_string() == "i") {
                values.fill(Number::new(0.0, 1.0));
            }
        }
        self.make_small(&mut values)?;
        let mut drawn = Leaves::new(values, points, is_complex);
        drawn.running = self.symbols.running().cloned();
        let moving = leaves.iter().filter(|leaf| tree_runs(leaf, self.symbols));
        drawn.moving = moving.cloned().collect();
        let signed = |equation: &&Equation| {
            let mut is_sign = |node: &Tree| matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_));
            any(&equation.left, &mut is_sign) || any(&equation.right, &mut is_sign)
        };
        let of_pair = |equation: &Equation| matches!(&equation.left, Tree::Symbol(name, _) if pair_of(name).is_some());
        let mut signed = self.equations.iter().filter(signed).peekable();
        Some(match signed.peek().is_some() {
            true => drawn.under_both_signs(signed.all(of_pair)),
            false => drawn,
        })
    }

    fn speaks_of_complex(&self) -> bool {
        let sides = self
            .equations
            .iter()
            .flat_map(|equation| [&equation.left, &equation.right]);
        let mut all = sides.chain(self.definitions.values());
        all.any(|tree| any(tree, &mut |node| self.symbols.may_be_complex(node)))
    }

    /// Where an `O` stands in the claim, gives its letter values so small that what it leaves out is rounding. Nothing where
    /// that is no power of a letter.
    fn make_small(&self, values: &mut HashMap<Tree, Vec<Number>>) -> Option<()> {
        let mut orders: Vec<(Tree, i32)> = Vec::new();
        let mut is_read = true;
        for side in self
            .equations
            .iter()
            .flat_map(|equation| [&equation.left, &equation.right])
        {
            any(side, &mut |node| {
                if let Tree::Operation(operation, _) = node
                    && let Operation::Order(of, is_little) = &**operation
                {
                    match of {
                        _ if *is_little => is_read = false,
                        Tree::Symbol(..) => orders.push((of.clone(), 1)),
                        Tree::Power(base, exponent, _) if matches!(**base, Tree::Symbol(..)) && *exponent > 0 => {
                            orders.push(((**base).clone(), *exponent));
                        }
                        _ => is_read = false,
                    }
                }
                false
            });
        }
        let Some((letter, order)) = orders.iter().min_by_key(|(_, order)| *order).filter(|_| is_read) else {
            return is_read.then_some(());
        };
        let Tree::Symbol(name, _) = letter else { return None };
        if orders.iter().any(|(other, _)| other != letter) {
            return None;
        }
        let small = LEFT_OUT.powf(1.0 / f64::from(*order));
        for (leaf, values) in values.iter_mut() {
            for (n, value) in values.iter_mut().enumerate() {
                if leaf == letter {
                    *value = real(small * (1.0 - 0.07 * n as f64));
                } else if leaf.has_free(name) {
                    *value = crate::evidence::sampled::UNDEFINED;
                }
            }
        }
        Some(())
    }

    /// What the claim rests on, without the claim where that has operations: points are looked for by the premises.
    fn premises(&self) -> Statements {
        let mut statements = self.statements.clone();
        let has_one = |equation: &Equation| any_side(equation, &mut is_operation);
        if statements.claims.iter().any(has_one) {
            statements.claims.clear();
        }
        statements
    }
}

fn is_operation(node: &Tree) -> bool {
    matches!(node, Tree::Operation(..))
}

/// Whether a letter is bound in a tree: what stands there may have a value that is not worked out here.
fn binds(tree: &Tree) -> bool {
    any(tree, &mut |node| match node {
        Tree::Operation(operation, _) => operation.letter().is_some(),
        _ => false,
    })
}

/// Whether something in a tree has no value by itself.
fn has_no_value(tree: &Tree) -> bool {
    any(tree, &mut |node| match node {
        Tree::Operation(operation, _) => matches!(
            **operation,
            Operation::Cases(_)
                | Operation::Limit { .. }
                | Operation::Approaches(_)
                | Operation::OneSided(..)
                | Operation::Integral { limits: None, .. }
        ),
        _ => false,
    })
}
