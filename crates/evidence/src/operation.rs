//! Printed operations as formulas: sums, products, integrals and limits over a bound letter, derivatives, matrices by
//! their entries, values by cases. Nothing is simplified and no closed form is used.

use super::compiler::{Bound, Compiler, Unwitnessed};
use super::formula::{Binder, Formula, Op, Side};
use super::value::Function;
use texmath::{At, Case, Condition, Name, Operation, Relation, Series, Tree, any, index_of, number_of, rewrite};

/// The most rows of a matrix whose determinant or inverse is written out.
const MOST_ROWS: usize = 5;
/// The highest power of a matrix, and the highest derivative.
const HIGHEST_POWER: i32 = 16;
const HIGHEST_DERIVATIVE: u32 = 8;
/// The most terms of a sum over the members of a sequence.
const MOST_MEMBERS: i64 = 40;

/// The value of a tree: a number, or the entries of a matrix.
#[derive(Clone, Debug)]
pub enum Entries {
    Number(Formula),
    Matrix(Vec<Vec<Formula>>),
}

impl Entries {
    /// All numbers in it.
    pub fn flat(self) -> Vec<Formula> {
        match self {
            Self::Number(number) => vec![number],
            Self::Matrix(rows) => rows.concat(),
        }
    }
}

type Rows = Vec<Vec<Formula>>;
type Found<T> = Result<T, Unwitnessed>;

fn refused<T>(why: &'static str) -> Found<T> {
    Err(Unwitnessed::Kind(why))
}

/// Returns true if a tree is `\infty`.
fn is_infinity(tree: &Tree) -> bool {
    matches!(tree, Tree::Operation(operation, _) if matches!(**operation, Operation::Infinity))
}

fn is_minus_infinity(tree: &Tree) -> bool {
    matches!(tree, Tree::Negate(inner) if is_infinity(inner))
}

impl Compiler<'_> {
    /// The value of an operation that is a number.
    pub fn operation(&mut self, operation: &Operation) -> Found<Formula> {
        match operation {
            Operation::Series {
                kind,
                of,
                index,
                from,
                to,
            } => self.series(*kind, of, index, from, to),
            Operation::Integral {
                of,
                by,
                limits: Some((low, high)),
            } => self.integral(of, by, low, high),
            Operation::Limit { of, by, to } => self.limit(of, by, to),
            Operation::Derivative { of, by, order, at } => {
                let at = self.tree(at)?;
                self.derivative(of, by, *order, at)
            }
            Operation::Determinant(of) => match self.value(of)? {
                Entries::Matrix(rows) => self.determinant(&rows),
                Entries::Number(_) => refused("the determinant of a number"),
            },
            Operation::Trace(of) => match self.value(of)? {
                Entries::Matrix(rows) if is_square(&rows) => {
                    let diagonal = rows.iter().enumerate().filter_map(|(n, row)| row.get(n).copied());
                    Ok(self.formulas.sum(diagonal))
                }
                _ => refused("the trace of what is no square matrix"),
            },
            Operation::Root { of, index } => {
                let (of, index) = (self.tree(of)?, self.tree(index)?);
                let one = self.formulas.integer(1);
                let exponent = self.formulas.divide(one, index);
                Ok(self.formulas.make(Op::RealPower(of, exponent)))
            }
            Operation::Binomial(of, chosen) => self.binomial(of, chosen),
            Operation::Cases(cases) => self.cases(cases),
            Operation::Dot(left, right) => match self.dot(left, right)? {
                Entries::Number(product) => Ok(product),
                Entries::Matrix(_) => refused("a matrix stands where a number must"),
            },
            Operation::Cross(..) => refused("a cross product of letters without entries"),
            // a number is its own transpose
            Operation::Transpose(of) => self.tree(of),
            Operation::Matrix(_) => refused("a matrix stands where a number must"),
            Operation::Arguments(_) => refused("a function of several arguments without a definition"),
            Operation::Integral { of, by, limits: None } if self.is_up_to => {
                let (letter, body) = self.with_letter(by, false, |own| own.tree(of))?;
                let low = self.formulas.float(super::claimed::ANYWHERE);
                let high = self.tree(&Tree::Symbol(by.clone(), At::default()))?;
                Ok(self.bind(Binder::Integral, letter, body, low, high))
            }
            Operation::Integral { limits: None, .. } => refused("an antiderivative within a formula"),
            Operation::Order(..) if self.is_up_to => Ok(self.formulas.integer(0)),
            Operation::Order(..) | Operation::Approaches(_) | Operation::OneSided(..) | Operation::Infinity => {
                refused("a limit stands where it is not read")
            }
        }
    }

    /// What `work` makes of a new letter that a name is bound to.
    fn with_letter<T>(
        &mut self,
        name: &Name,
        is_integer: bool,
        work: impl FnOnce(&mut Self) -> Found<T>,
    ) -> Found<(u8, T)> {
        let Some(letter) = self.formulas.letter() else {
            return refused("too many letters are bound");
        };
        let formula = self.formulas.make(Op::Bound(letter));
        self.bound.push(Bound {
            name: name.clone(),
            formula,
            is_integer,
        });
        // what a name stands for may hold the letter
        let known = std::mem::take(&mut self.known);
        let made = work(self);
        self.known = known;
        self.bound.pop();
        Ok((letter, made?))
    }

    fn bind(&mut self, kind: Binder, letter: u8, body: Formula, from: Formula, to: Formula) -> Formula {
        self.formulas.make(Op::Bind {
            kind,
            letter,
            body,
            from,
            to,
        })
    }

    /// The formula with another in the place of a letter.
    fn at_letter(&mut self, body: Formula, letter: u8, new: Formula) -> Formula {
        self.formulas
            .rewrite(body, &mut |_, op| (op == Op::Bound(letter)).then_some(new))
    }

    fn series(&mut self, kind: Series, of: &Tree, index: &Name, from: &Tree, to: &Tree) -> Found<Formula> {
        if let Some(terms) = self.members(of, index, from, to) {
            let terms = terms.iter().map(|term| self.tree(term)).collect::<Found<Vec<_>>>()?;
            return Ok(match kind {
                Series::Sum => self.formulas.sum(terms),
                Series::Product => self.formulas.product(terms),
            });
        }
        let low = self.tree(from)?;
        let (kind, high) = match (is_infinity(to), kind) {
            (true, Series::Sum) => (Binder::Series, low),
            (true, Series::Product) => (Binder::InfiniteProduct, low),
            (false, Series::Sum) => (Binder::Sum, self.tree(to)?),
            (false, Series::Product) => (Binder::Product, self.tree(to)?),
        };
        let (letter, body) = self.with_letter(index, true, |own| own.tree(of))?;
        Ok(self.bind(kind, letter, body, low, high))
    }

    /// The terms of a sum over members of a sequence, where its ends are known.
    pub fn members(&self, of: &Tree, index: &Name, from: &Tree, to: &Tree) -> Option<Vec<Tree>> {
        let letter = index.to_string();
        let is_member = |name: &Name| index_of(&name.subscript, &letter).is_some();
        let mut numbers = |node: &Tree| match node {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => name != index && is_member(name),
            _ => false,
        };
        if !any(of, &mut numbers) {
            return None;
        }
        let (first, last) = (self.whole(from)?, self.whole(to)?);
        if last.saturating_sub(first) >= MOST_MEMBERS {
            return None;
        }
        let term = |value: i64| {
            let integer = |value: i64| Tree::Number(numbers::Field::from_integer(value));
            rewrite(of, &|name| {
                if name == index {
                    return Some(match value < 0 {
                        true => Tree::Negate(Box::new(integer(-value))),
                        false => integer(value),
                    });
                }
                let offset = index_of(&name.subscript, &letter)?;
                let member = Name {
                    subscript: (value + i64::from(offset)).to_string(),
                    ..name.clone()
                };
                Some(Tree::Symbol(member, At::default()))
            })
        };
        Some((first..=last).map(term).collect())
    }

    /// The integer that a tree of numbers and of the running index is.
    fn whole(&self, tree: &Tree) -> Option<i64> {
        match tree {
            Tree::Symbol(name, _) if super::index::is_index(self.symbols, name) => {
                super::index::index_runs(self.symbols).then_some(i64::from(super::index::INDEX + self.index_shift))
            }
            Tree::Sum(terms) => terms.iter().map(|term| self.whole(term)).sum(),
            Tree::Negate(inner) => self.whole(inner).map(|value| -value),
            tree => number_of(tree).and_then(|value| value.to_integer()),
        }
    }

    fn integral(&mut self, of: &Tree, by: &Name, low: &Tree, high: &Tree) -> Found<Formula> {
        let (letter, body) = self.with_letter(by, false, |own| own.tree(of))?;
        let own = self.formulas.make(Op::Bound(letter));
        let zero = self.formulas.integer(0);
        let turned = |own_self: &mut Self, body: Formula| {
            let opposite = own_self.formulas.make(Op::Negate(own));
            own_self.at_letter(body, letter, opposite)
        };
        Ok(match (is_minus_infinity(low), is_infinity(high)) {
            (false, false) if is_infinity(low) || is_minus_infinity(high) => {
                return refused("an integral from infinity");
            }
            (false, false) => {
                let (low, high) = (self.tree(low)?, self.tree(high)?);
                self.bind(Binder::Integral, letter, body, low, high)
            }
            (false, true) => {
                let low = self.tree(low)?;
                self.bind(Binder::Ray, letter, body, low, low)
            }
            (true, false) => {
                let high = self.tree(high)?;
                let high = self.formulas.make(Op::Negate(high));
                let body = turned(self, body);
                self.bind(Binder::Ray, letter, body, high, high)
            }
            (true, true) => {
                let right = self.bind(Binder::Ray, letter, body, zero, zero);
                let body = turned(self, body);
                let left = self.bind(Binder::Ray, letter, body, zero, zero);
                self.formulas.add(left, right)
            }
        })
    }

    fn limit(&mut self, of: &Tree, by: &Name, to: &Tree) -> Found<Formula> {
        let is_integer = self.symbols.is_integer(by);
        let (letter, body) = self.with_letter(by, is_integer, |own| own.tree(of))?;
        self.towards(body, letter, to)
    }

    /// The limit of a body as a letter tends to something.
    pub fn towards(&mut self, body: Formula, letter: u8, to: &Tree) -> Found<Formula> {
        let zero = self.formulas.integer(0);
        if is_infinity(to) {
            return Ok(self.bind(Binder::Limit(Side::Infinity), letter, body, zero, zero));
        }
        if is_minus_infinity(to) {
            let own = self.formulas.make(Op::Bound(letter));
            let opposite = self.formulas.make(Op::Negate(own));
            let body = self.at_letter(body, letter, opposite);
            return Ok(self.bind(Binder::Limit(Side::Infinity), letter, body, zero, zero));
        }
        let (to, side) = match to {
            Tree::Operation(operation, _) => match &**operation {
                Operation::OneSided(to, true) => (to, Side::Above),
                Operation::OneSided(to, false) => (to, Side::Below),
                _ => (to, Side::Both),
            },
            _ => (to, Side::Both),
        };
        let to = self.tree(to)?;
        Ok(self.bind(Binder::Limit(side), letter, body, to, to))
    }

    fn derivative(&mut self, of: &Tree, by: &Name, order: u32, at: Formula) -> Found<Formula> {
        if order > HIGHEST_DERIVATIVE {
            return refused("a derivative of so high an order");
        }
        if self.symbols.is_indexed(by) || self.symbols.is_integer(by) {
            return refused("a derivative by what is no running number");
        }
        let (letter, body) = self.with_letter(by, false, |own| own.tree(of))?;
        let is_complex = self.symbols.is_complex(by);
        if is_complex && self.formulas.any(body, |op| !op.is_analytic()) {
            return refused("the derivative of what is not analytic");
        }
        let slope = (0..order).fold(body, |body, _| self.formulas.slope(body, Op::Bound(letter)));
        Ok(self.at_letter(slope, letter, at))
    }

    /// The product of n, n - step, ... down to what is not positive.
    pub fn factorial(&mut self, of: Formula, step: i64) -> Found<Formula> {
        let Some(letter) = self.formulas.letter() else {
            return refused("too many letters are bound");
        };
        let own = self.formulas.make(Op::Bound(letter));
        let one = self.formulas.integer(1);
        if step == 1 {
            return Ok(self.bind(Binder::Product, letter, own, one, of));
        }
        // the factors that are as far from n as an even number
        let apart = self.formulas.subtract(of, own);
        let minus = self.formulas.integer(-1);
        let sign = self.formulas.make(Op::IntegerPower(minus, apart));
        let body = self.formulas.make(Op::If {
            relation: Relation::Greater,
            test: sign,
            yes: own,
            no: one,
        });
        Ok(self.bind(Binder::Product, letter, body, one, of))
    }

    /// n (n - 1) ... (n - k + 1)/k!, which is 0 for k < 0.
    fn binomial(&mut self, of: &Tree, chosen: &Tree) -> Found<Formula> {
        let (of, chosen) = (self.tree(of)?, self.tree(chosen)?);
        let Some(letter) = self.formulas.letter() else {
            return refused("too many letters are bound");
        };
        let (own, one, zero) = (
            self.formulas.make(Op::Bound(letter)),
            self.formulas.integer(1),
            self.formulas.integer(0),
        );
        let others = self.formulas.subtract(of, chosen);
        let above = self.formulas.add(others, own);
        let body = self.formulas.divide(above, own);
        let product = self.bind(Binder::Product, letter, body, one, chosen);
        Ok(self.formulas.make(Op::If {
            relation: Relation::GreaterOrEqual,
            test: chosen,
            yes: product,
            no: zero,
        }))
    }

    /// The value of the first case whose conditions hold.
    fn cases(&mut self, cases: &[Case]) -> Found<Formula> {
        let mut value = self.formulas.float(f64::NAN);
        for case in cases.iter().rev() {
            let yes = self.tree(&case.value)?;
            let mut chosen = yes;
            for condition in case.conditions.iter().rev() {
                let Condition::Relation(relation) = condition else {
                    return refused("a case for integers");
                };
                let (left, right) = (self.tree(&relation.left)?, self.tree(&relation.right)?);
                let test = self.formulas.subtract(left, right);
                chosen = self.formulas.make(Op::If {
                    relation: relation.relation,
                    test,
                    yes: chosen,
                    no: value,
                });
            }
            value = chosen;
        }
        Ok(value)
    }

    /// The equations that two sides make: one for each entry of matrices, of which 0 is one of any shape.
    pub fn between(&mut self, left: &Tree, right: &Tree) -> Found<Vec<(Formula, Formula)>> {
        let zero = self.formulas.integer(0);
        let number = |formula: Formula| formula == zero;
        match (self.value(left)?, self.value(right)?) {
            (Entries::Number(left), Entries::Number(right)) => Ok(vec![(left, right)]),
            (Entries::Matrix(left), Entries::Matrix(right)) if shape(&left) == shape(&right) => {
                Ok(left.concat().into_iter().zip(right.concat()).collect())
            }
            (Entries::Matrix(rows), Entries::Number(other)) if number(other) => {
                Ok(rows.concat().into_iter().map(|entry| (entry, zero)).collect())
            }
            (Entries::Number(other), Entries::Matrix(rows)) if number(other) => {
                Ok(rows.concat().into_iter().map(|entry| (zero, entry)).collect())
            }
            _ => refused("what has different shapes is compared"),
        }
    }

    /// The value of a tree that may be a matrix.
    pub fn value(&mut self, tree: &Tree) -> Found<Entries> {
        Ok(match tree {
            Tree::Symbol(name, _) => match self.locals.iter().find(|local| local.name == *name) {
                Some(local) if self.holds_matrix(&local.tree) => {
                    let local = local.tree.clone();
                    self.opened(name, |own| own.value(&local))?
                }
                _ => Entries::Number(self.tree(tree)?),
            },
            _ if !self.holds_matrix(tree) => Entries::Number(self.tree(tree)?),
            Tree::Negate(inner) => {
                let minus = self.formulas.integer(-1);
                let inner = self.value(inner)?;
                self.scaled(inner, minus)
            }
            Tree::Sum(terms) => {
                let values = terms.iter().map(|term| self.value(term)).collect::<Found<Vec<_>>>()?;
                self.added(values)?
            }
            Tree::Product(factors) => {
                let mut product = None;
                for factor in factors {
                    let factor = self.value(factor)?;
                    product = Some(match product {
                        None => factor,
                        Some(product) => self.multiplied(product, factor)?,
                    });
                }
                product.ok_or(Unwitnessed::Kind("an empty product"))?
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.value(above)?, self.tree(below)?);
                let one = self.formulas.integer(1);
                let factor = self.formulas.divide(one, below);
                self.scaled(above, factor)
            }
            Tree::Power(base, exponent, _) => match self.value(base)? {
                Entries::Matrix(rows) => Entries::Matrix(self.raised(rows, *exponent)?),
                Entries::Number(base) => Entries::Number(self.formulas.make(Op::Power(base, *exponent))),
            },
            Tree::RealPower(base, exponent, _) => match self.value(base)? {
                Entries::Matrix(rows) if self.is_transpose(exponent) => Entries::Matrix(transposed(&rows)),
                Entries::Matrix(rows) => {
                    let power = number_of(exponent).and_then(|exponent| exponent.to_integer());
                    let power = power.and_then(|power| i32::try_from(power).ok());
                    let power = power.ok_or(Unwitnessed::Kind("a symbolic power of a matrix"))?;
                    Entries::Matrix(self.raised(rows, power)?)
                }
                Entries::Number(_) => Entries::Number(self.tree(tree)?),
            },
            Tree::Call(name, inner, _) if name.base == r"\abs" => match self.value(inner)? {
                Entries::Matrix(rows) => {
                    let squares = rows.concat().into_iter();
                    let squares: Vec<Formula> = squares.map(|entry| self.formulas.make(Op::Power(entry, 2))).collect();
                    let sum = self.formulas.sum(squares);
                    Entries::Number(self.formulas.make(Op::Root(sum, 2)))
                }
                Entries::Number(inner) => Entries::Number(self.formulas.apply(Function::Abs, inner)),
            },
            Tree::Operation(operation, _) => return self.matrix_operation(operation),
            _ => Entries::Number(self.tree(tree)?),
        })
    }

    fn is_transpose(&self, exponent: &Tree) -> bool {
        let is_name = |name: &Name| matches!(name.base.as_str(), "T" | r"\top") && name.subscript.is_empty();
        matches!(exponent, Tree::Symbol(name, _) if is_name(name) && !self.symbols.is_parameter(name))
    }

    /// Returns true if a matrix stands in a tree or in what its names stand for.
    fn holds_matrix(&self, tree: &Tree) -> bool {
        any(tree, &mut |node| match node {
            Tree::Operation(operation, _) => matches!(**operation, Operation::Matrix(_)),
            Tree::Symbol(name, _) if !self.open.contains(name) => self
                .locals
                .iter()
                .any(|local| local.name == *name && any(&local.tree, &mut |node| self.is_matrix(node))),
            _ => false,
        })
    }

    fn is_matrix(&self, node: &Tree) -> bool {
        match node {
            Tree::Operation(operation, _) => matches!(**operation, Operation::Matrix(_)),
            // definitions go in no circle
            Tree::Symbol(name, _) => self
                .locals
                .iter()
                .any(|local| local.name == *name && any(&local.tree, &mut |node| self.is_matrix(node))),
            _ => false,
        }
    }

    fn matrix_operation(&mut self, operation: &Operation) -> Found<Entries> {
        Ok(match operation {
            Operation::Matrix(rows) => {
                let row = |own: &mut Self, row: &Vec<Tree>| row.iter().map(|entry| own.tree(entry)).collect();
                Entries::Matrix(rows.iter().map(|entries| row(self, entries)).collect::<Found<_>>()?)
            }
            Operation::Transpose(of) => match self.value(of)? {
                Entries::Matrix(rows) => Entries::Matrix(transposed(&rows)),
                number => number,
            },
            Operation::Cross(left, right) => match (self.value(left)?, self.value(right)?) {
                (Entries::Matrix(left), Entries::Matrix(right)) => {
                    let ([a, b, c], [x, y, z]) = match (left.concat().as_slice(), right.concat().as_slice()) {
                        ([a, b, c], [x, y, z]) => ([*a, *b, *c], [*x, *y, *z]),
                        _ => return refused("a cross product of what are no vectors of space"),
                    };
                    let entry = |own: &mut Self, [a, y, b, x]: [Formula; 4]| {
                        let (first, second) = (own.formulas.multiply(a, y), own.formulas.multiply(b, x));
                        own.formulas.subtract(first, second)
                    };
                    let entries = [[b, z, c, y], [c, x, a, z], [a, y, b, x]].map(|four| vec![entry(self, four)]);
                    Entries::Matrix(entries.to_vec())
                }
                _ => return refused("a cross product of what has no three entries"),
            },
            Operation::Derivative { of, by, order, at } => {
                let Some(rows) = self.entries_of(of)? else {
                    return Ok(Entries::Number(self.operation(operation)?));
                };
                let at = self.tree(at)?;
                let each = |own: &mut Self, entry: &Tree| own.derivative(entry, by, *order, at);
                let row = |own: &mut Self, row: &Vec<Tree>| row.iter().map(|entry| each(own, entry)).collect();
                Entries::Matrix(rows.iter().map(|entries| row(self, entries)).collect::<Found<_>>()?)
            }
            Operation::Dot(left, right) => self.dot(left, right)?,
            operation => Entries::Number(self.operation(operation)?),
        })
    }

    /// The inner product of two vectors, or the product of what else has a dot between.
    fn dot(&mut self, left: &Tree, right: &Tree) -> Found<Entries> {
        match (self.value(left)?, self.value(right)?) {
            (Entries::Matrix(left), Entries::Matrix(right)) if shape(&left) == shape(&right) && !is_square(&left) => {
                let pairs = left.concat().into_iter().zip(right.concat());
                let products: Vec<Formula> = pairs.map(|(a, b)| self.formulas.multiply(a, b)).collect();
                Ok(Entries::Number(self.formulas.sum(products)))
            }
            (left, right) => self.multiplied(left, right),
        }
    }

    /// The entries of a matrix that is written out.
    fn entries_of(&self, tree: &Tree) -> Found<Option<Vec<Vec<Tree>>>> {
        match tree {
            Tree::Operation(operation, _) => match &**operation {
                Operation::Matrix(rows) => Ok(Some(rows.clone())),
                _ => Ok(None),
            },
            Tree::Symbol(name, _) => match self.locals.iter().find(|local| local.name == *name) {
                Some(local) => self.entries_of(&local.tree),
                None => Ok(None),
            },
            tree if self.holds_matrix(tree) => refused("the derivative of a product of matrices"),
            _ => Ok(None),
        }
    }

    fn scaled(&mut self, value: Entries, factor: Formula) -> Entries {
        match value {
            Entries::Number(number) => Entries::Number(self.formulas.multiply(factor, number)),
            Entries::Matrix(rows) => {
                let row = |row: Vec<Formula>| {
                    row.into_iter()
                        .map(|entry| self.formulas.multiply(factor, entry))
                        .collect()
                };
                Entries::Matrix(rows.into_iter().map(row).collect())
            }
        }
    }

    fn added(&mut self, values: Vec<Entries>) -> Found<Entries> {
        let mut sum: Option<Entries> = None;
        for value in values {
            sum = Some(match (sum, value) {
                (None, value) => value,
                (Some(Entries::Number(sum)), Entries::Number(value)) => Entries::Number(self.formulas.add(sum, value)),
                (Some(Entries::Matrix(sum)), Entries::Matrix(rows)) if shape(&sum) == shape(&rows) => {
                    let pairs = sum.into_iter().zip(rows);
                    let row = |(sum, row): (Vec<Formula>, Vec<Formula>)| {
                        sum.into_iter().zip(row).map(|(a, b)| self.formulas.add(a, b)).collect()
                    };
                    Entries::Matrix(pairs.map(row).collect())
                }
                _ => return refused("matrices of different shapes are added"),
            });
        }
        sum.ok_or(Unwitnessed::Kind("an empty sum"))
    }

    fn multiplied(&mut self, left: Entries, right: Entries) -> Found<Entries> {
        Ok(match (left, right) {
            (Entries::Number(number), value) | (value, Entries::Number(number)) => self.scaled(value, number),
            (Entries::Matrix(left), Entries::Matrix(right)) => Entries::Matrix(self.times(&left, &right)?),
        })
    }

    fn times(&mut self, left: &Rows, right: &Rows) -> Found<Rows> {
        let (width, columns) = (shape(left).1, transposed(right));
        if width != right.len() {
            return refused("matrices whose shapes do not fit are multiplied");
        }
        let mut product = Vec::new();
        for row in left {
            let mut entries = Vec::new();
            for column in &columns {
                let pairs = row.iter().zip(column);
                let terms: Vec<Formula> = pairs.map(|(a, b)| self.formulas.multiply(*a, *b)).collect();
                entries.push(self.formulas.sum(terms));
            }
            product.push(entries);
        }
        Ok(product)
    }

    fn raised(&mut self, rows: Rows, exponent: i32) -> Found<Rows> {
        if !is_square(&rows) || exponent.abs() > HIGHEST_POWER {
            return refused("a power of a matrix that is not square, or a high one");
        }
        let base = match exponent < 0 {
            true => self.inverse(&rows)?,
            false => rows,
        };
        let (zero, one) = (self.formulas.integer(0), self.formulas.integer(1));
        let entry = |row: usize, column: usize| if row == column { one } else { zero };
        let size = base.len();
        let mut power: Rows = (0..size)
            .map(|row| (0..size).map(|column| entry(row, column)).collect())
            .collect();
        for _ in 0..exponent.unsigned_abs() {
            power = self.times(&power, &base)?;
        }
        Ok(power)
    }

    /// The adjugate over the determinant (Cramer's rule).
    fn inverse(&mut self, rows: &Rows) -> Found<Rows> {
        let whole = self.determinant(rows)?;
        let size = rows.len();
        let mut inverse = Vec::new();
        for column in 0..size {
            let mut entries = Vec::new();
            for row in 0..size {
                let minor = self.determinant(&without(rows, row, column))?;
                let minor = match (row + column) % 2 {
                    0 => minor,
                    _ => self.formulas.make(Op::Negate(minor)),
                };
                entries.push(self.formulas.divide(minor, whole));
            }
            inverse.push(entries);
        }
        Ok(inverse)
    }

    /// The determinant by its first row (Laplace).
    fn determinant(&mut self, rows: &Rows) -> Found<Formula> {
        if !is_square(rows) || rows.len() > MOST_ROWS {
            return refused("the determinant of a matrix that is not square, or large");
        }
        let Some(first) = rows.first() else {
            return Ok(self.formulas.integer(1));
        };
        let mut terms = Vec::new();
        for (column, entry) in first.clone().into_iter().enumerate() {
            let minor = self.determinant(&without(rows, 0, column))?;
            let term = self.formulas.multiply(entry, minor);
            terms.push(match column % 2 {
                0 => term,
                _ => self.formulas.make(Op::Negate(term)),
            });
        }
        Ok(self.formulas.sum(terms))
    }
}

fn shape(rows: &Rows) -> (usize, usize) {
    (rows.len(), rows.first().map_or(0, Vec::len))
}

fn is_square(rows: &Rows) -> bool {
    shape(rows).0 == shape(rows).1
}

fn transposed(rows: &Rows) -> Rows {
    let columns = 0..shape(rows).1;
    let column = |n: usize| rows.iter().filter_map(|row| row.get(n).copied()).collect();
    columns.map(column).collect()
}

fn without(rows: &Rows, row: usize, column: usize) -> Rows {
    let kept = |n: usize, skip: usize| n != skip;
    let rows = rows.iter().enumerate().filter(|(n, _)| kept(*n, row));
    rows.map(|(_, entries)| {
        let entries = entries.iter().enumerate().filter(|(n, _)| kept(*n, column));
        entries.map(|(_, entry)| *entry).collect()
    })
    .collect()
}
