//! What is compared of a claim: its two sides, their derivatives where it is between antiderivatives, and the coefficients
//! of powers of what tends to 0 where it holds up to an order.

use super::compiler::{CONSTANT, Unwitnessed};
use super::formula::{Binder, Formula, Op};
use super::system::System;
use claims::Statements;
use texmath::{At, Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, any_side};

/// The highest order up to which coefficients are compared.
const HIGHEST: u32 = 6;

/// Where antiderivatives start: any place does.
pub const ANYWHERE: f64 = 0.392_917;

type Sides = Vec<(Formula, Formula)>;

/// What a letter tends to, as it is assumed.
fn approached(statements: &Statements) -> Option<(Name, Tree)> {
    statements.assume.iter().find_map(|condition| match condition {
        Condition::Relation(relation) => match (&relation.left, &relation.right) {
            (Tree::Symbol(name, _), Tree::Operation(operation, _)) => match &**operation {
                Operation::Approaches(to) => Some((name.clone(), to.clone())),
                _ => None,
            },
            _ => None,
        },
        Condition::Integer(_) => None,
    })
}

/// What the orders of an equation are of.
fn orders(equation: &Equation) -> Vec<(Tree, bool)> {
    let mut found = Vec::new();
    any_side(equation, &mut |node| {
        if let Tree::Operation(operation, _) = node
            && let Operation::Order(of, is_little) = &**operation
        {
            found.push((of.clone(), *is_little));
        }
        false
    });
    found
}

/// Returns true if the constant of integration stands only as a term of a side, if at all.
fn is_added_constant(equation: &Equation) -> bool {
    let is_constant =
        |node: &Tree| matches!(node, Tree::Symbol(name, _) if name.base == CONSTANT && name.subscript.is_empty());
    let holds = |tree: &Tree| any(tree, &mut |node| is_constant(node));
    let is_added = |term: &Tree| match term {
        Tree::Negate(inner) => is_constant(inner) || !holds(inner),
        term => is_constant(term) || !holds(term),
    };
    [&equation.left, &equation.right].into_iter().all(|side| match side {
        Tree::Sum(terms) => terms.iter().all(is_added),
        side => is_added(side),
    })
}

/// The letter of an integral without limits.
fn integrated(equation: &Equation) -> Option<Name> {
    let mut found = None;
    any_side(equation, &mut |node| {
        if let Tree::Operation(operation, _) = node
            && let Operation::Integral { by, limits: None, .. } = &**operation
        {
            found = Some(by.clone());
        }
        false
    });
    found
}

/// The power of the distance of a letter from what it tends to.
fn degree(of: &Tree, by: &Name, to: &Tree) -> Option<u32> {
    let is_infinite = any(
        to,
        &mut |node| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Infinity)),
    );
    let is_letter = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name == by);
    let is_zero = *to == Tree::Number(numbers::Field::from_integer(0));
    let is_distance = |tree: &Tree| match tree {
        Tree::Sum(terms) => match terms.as_slice() {
            [letter, Tree::Negate(other)] => is_letter(letter) && **other == *to,
            _ => false,
        },
        tree => is_letter(tree) && is_zero,
    };
    let is_one = |tree: &Tree| *tree == Tree::Number(numbers::Field::from_integer(1));
    match (is_infinite, of) {
        (_, of) if is_one(of) => Some(0),
        (true, Tree::Power(base, power, _)) if is_letter(base) && *power < 0 => Some(power.unsigned_abs()),
        (true, Tree::Quotient(above, below, _)) if is_one(above) => match &**below {
            Tree::Power(base, power, _) if is_letter(base) => u32::try_from(*power).ok(),
            below => is_letter(below).then_some(1),
        },
        (false, Tree::Power(base, power, _)) if is_distance(base) => u32::try_from(*power).ok(),
        (false, of) => is_distance(of).then_some(1),
        _ => None,
    }
}

impl System {
    /// The pairs of formulas that are equal where an equation of the claim holds.
    pub(super) fn claimed(
        &mut self,
        equation: &Equation,
        statements: &Statements,
        symbols: &Symbols,
        flight: i32,
    ) -> Result<Sides, Unwitnessed> {
        let orders = orders(equation);
        let holds_order = |side: &Tree| {
            any(
                side,
                &mut |node| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Order(..))),
            )
        };
        // O(x^2) is O(x), and not the other way round
        if holds_order(&equation.left) {
            return Err(Unwitnessed::Kind("an order on the left of an equation"));
        }
        if !orders.is_empty() {
            return self.up_to_orders(equation, &orders, statements, symbols, flight);
        }
        let Some(by) = integrated(equation) else {
            return self.sides(equation, symbols, &statements.locals, None, flight);
        };
        if !is_added_constant(equation) {
            return Err(Unwitnessed::Kind("a constant of integration that is not added"));
        }
        let sides = self.leaving_out(equation, statements, symbols, flight)?;
        let by = self.letter_of(&by, statements, symbols)?;
        let start = self.formulas.float(ANYWHERE);
        let mut slopes = Vec::new();
        for (left, right) in sides {
            let [left, right] = [left, right].map(|side| self.formulas.slope(side, by));
            let is_open = |op: Op| matches!(op, Op::Bind { kind: Binder::Integral, from, .. } if from == start);
            if self.formulas.any(left, is_open) || self.formulas.any(right, is_open) {
                return Err(Unwitnessed::Kind("an antiderivative within a formula"));
            }
            slopes.push((left, right));
        }
        Ok(slopes)
    }

    /// The sides with antiderivatives from anywhere, and without what orders leave out.
    fn leaving_out(
        &mut self,
        equation: &Equation,
        statements: &Statements,
        symbols: &Symbols,
        flight: i32,
    ) -> Result<Sides, Unwitnessed> {
        if equation.relation != Relation::Equal {
            return Err(Unwitnessed::Kind("an inequality up to a constant or an order"));
        }
        let mut compiler = self.compiler(symbols, &statements.locals);
        (compiler.flight, compiler.is_up_to) = (flight, true);
        compiler.between(&equation.left, &equation.right)
    }

    /// The operation that a letter is read as, of which nothing else is said.
    fn letter_of(&mut self, by: &Name, statements: &Statements, symbols: &Symbols) -> Result<Op, Unwitnessed> {
        let mut compiler = self.compiler(symbols, &statements.locals);
        let formula = compiler.tree(&Tree::Symbol(by.clone(), At::default()))?;
        match self.formulas.op(formula) {
            Op::Running => Ok(Op::Running),
            Op::Slot(slot) if !self.formulas.slots(&self.rows).contains(&slot) => Ok(Op::Slot(slot)),
            _ => Err(Unwitnessed::Kind("premises speak of the letter that runs")),
        }
    }

    fn up_to_orders(
        &mut self,
        equation: &Equation,
        orders: &[(Tree, bool)],
        statements: &Statements,
        symbols: &Symbols,
        flight: i32,
    ) -> Result<Sides, Unwitnessed> {
        let unread = Unwitnessed::Kind("an order that is no power of what tends to something");
        let letter = |of: &Tree| match of {
            Tree::Symbol(name, _) => Some(name.clone()),
            Tree::Power(base, ..) => match &**base {
                Tree::Symbol(name, _) => Some(name.clone()),
                _ => None,
            },
            _ => None,
        };
        let zero = || Tree::Number(numbers::Field::from_integer(0));
        let implied = || Some((orders.iter().find_map(|(of, _)| letter(of))?, zero()));
        let (by, to) = approached(statements).or_else(implied).ok_or_else(|| unread.clone())?;
        let degrees: Option<Vec<u32>> = orders
            .iter()
            .map(|(of, is_little)| Some(degree(of, &by, &to)? + u32::from(*is_little)))
            .collect();
        let degree = degrees
            .and_then(|all| all.into_iter().min())
            .filter(|least| *least <= HIGHEST);
        let degree = degree.ok_or(unread)?;
        let sides = self.leaving_out(equation, statements, symbols, flight)?;
        let own = self.letter_of(&by, statements, symbols)?;
        let sides_of = sides.iter().flat_map(|(left, right)| [*left, *right]);
        if symbols.is_complex(&by)
            && sides_of
                .into_iter()
                .any(|side| self.formulas.any(side, |op| !op.is_analytic()))
        {
            return Err(Unwitnessed::Kind("an expansion of what is not analytic"));
        }
        let Some(letter) = self.formulas.letter() else {
            return Err(Unwitnessed::Kind("too many letters are bound"));
        };
        let bound = self.formulas.make(Op::Bound(letter));
        // the letter by its distance from what it tends to
        let is_infinite = any(
            &to,
            &mut |node| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Infinity)),
        );
        let (there, side) = match (is_infinite, &to) {
            (true, to) => {
                let sign = self
                    .formulas
                    .integer(if matches!(to, Tree::Negate(_)) { -1 } else { 1 });
                (self.formulas.divide(sign, bound), Some(true))
            }
            (false, Tree::Operation(operation, _)) => match &**operation {
                Operation::OneSided(to, is_above) => {
                    let to = self.compiler(symbols, &statements.locals).tree(to)?;
                    (self.formulas.add(to, bound), Some(*is_above))
                }
                _ => return Err(Unwitnessed::Kind("a limit stands where it is not read")),
            },
            (false, to) => {
                let to = self.compiler(symbols, &statements.locals).tree(to)?;
                (self.formulas.add(to, bound), None)
            }
        };
        let mut coefficients = Vec::new();
        for (left, right) in sides {
            let mut pair =
                [left, right].map(|side| self.formulas.rewrite(side, &mut |_, op| (op == own).then_some(there)));
            for _ in 0..degree {
                let towards = match side {
                    None => zero(),
                    Some(is_above) => Tree::Operation(Box::new(Operation::OneSided(zero(), is_above)), At::default()),
                };
                let mut compiler = self.compiler(symbols, &statements.locals);
                let left = compiler.towards(pair[0], letter, &towards)?;
                let right = compiler.towards(pair[1], letter, &towards)?;
                coefficients.push((left, right));
                pair = pair.map(|side| self.formulas.slope(side, Op::Bound(letter)));
            }
        }
        match coefficients.is_empty() {
            true => Err(Unwitnessed::Kind("what is bounded has no coefficients")),
            false => Ok(coefficients),
        }
    }
}
