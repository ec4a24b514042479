//! Operations whose value is written out at once: matrices, derivatives, sums and products of known length.

use super::super::premise::Statements;
use super::Rule;
use super::build::{integer, sum, symbol};
use super::derivative::By;
use super::factorial;
use super::integers::{integers, whole};
use super::matrix::{self, Value};
use texmath::{
    Condition, Equation, Name, Operation, Relation, Series, Symbols, Tree, any, index_of, nodes_of, number_of, rewrite,
};

/// The most terms of a sum that is written out, and the largest tree.
const MOST_TERMS: i64 = 200;
const LARGEST: usize = 400_000;

/// The statements with every operation written out.
pub(super) fn evaluated(statements: &Statements, symbols: &Symbols) -> Result<Statements, String> {
    let WithFactorials { statements: out, .. } = but_factorials(statements, symbols)?;
    match super::trees(&out).into_iter().any(factorial::stands_in) {
        true => Err("the factorial of a symbol".to_owned()),
        false => Ok(out),
    }
}

/// Statements in which nothing is left to be written out but factorials of symbols.
pub(super) struct WithFactorials {
    pub statements: Statements,
    /// What must hold where the statements are looked at: 0 <= k <= n of each binomial coefficient that became factorials, as -1 < k < n + 1.
    pub needed: Vec<Equation>,
}

/// The statements with every operation written out but factorials of symbols.
pub(super) fn but_factorials(statements: &Statements, symbols: &Symbols) -> Result<WithFactorials, String> {
    let mut out = statements.clone();
    for tree in super::trees(statements) {
        any(tree, &mut |node| {
            out.rules.extend(match node {
                Tree::Operation(operation, _) => Rule::of_operation(operation),
                Tree::RealPower(_, exponent, _) => symbols.transposes(exponent).then_some(Rule::MatrixEntries),
                node => factorial::is_one(node).then_some(Rule::FactorialRecurrence),
            });
            false
        });
    }
    let mut needed: Vec<Equation> = Vec::new();
    out.claims.clear();
    out.premises.clear();
    let mut size = 0;
    for claim in &statements.claims {
        let mut over = Over::new(statements, symbols);
        let claims = over.equation(claim)?;
        out.claims.extend(claims);
        needed.append(&mut over.needed);
        let beside = over.beside.into_iter();
        out.claims
            .extend(beside.map(|tree| Equation::between(tree.clone(), tree)));
    }
    for premise in &statements.premises {
        let mut over = Over::new(statements, symbols);
        let equations = over.equation(&premise.equation)?;
        needed.append(&mut over.needed);
        let beside = over.beside.into_iter();
        let beside = beside.map(|tree| Equation::between(tree.clone(), tree));
        for equation in equations.into_iter().chain(beside) {
            let mut premise = premise.clone();
            premise.equation = equation;
            out.premises.push(premise);
        }
    }
    for condition in &mut out.assume {
        let mut over = Over::new(statements, symbols);
        if let Condition::Relation(relation) = condition {
            let mut relations = over.equation(relation)?;
            needed.append(&mut over.needed);
            if relations.len() != 1 || !over.beside.is_empty() {
                return Err("an operation in a condition".to_owned());
            }
            *relation = relations.remove(0);
        }
    }
    for claim in &out.claims {
        size += nodes_of(&claim.left) + nodes_of(&claim.right);
    }
    match size > LARGEST {
        true => Err("what is written out is too large".to_owned()),
        false => Ok(WithFactorials {
            statements: out,
            needed,
        }),
    }
}

/// The statements with every operation written out but factorials of symbols, where nothing more must hold.
///
/// # Errors
/// What is not written out, and the condition of a binomial coefficient.
pub(super) fn only_factorials(statements: &Statements, symbols: &Symbols) -> Result<Statements, String> {
    let WithFactorials { statements, needed } = but_factorials(statements, symbols)?;
    match needed.first() {
        Some(condition) => Err(format!("a binomial coefficient where {condition} is to be shown")),
        None => Ok(statements),
    }
}

/// One equation in the midst of being written out.
struct Over<'a> {
    statements: &'a Statements,
    symbols: &'a Symbols,
    /// What must have a value, beside what is left: what was differentiated, entries of matrices.
    beside: Vec<Tree>,
    /// What must hold for what is written.
    needed: Vec<Equation>,
}

impl<'a> Over<'a> {
    fn new(statements: &'a Statements, symbols: &'a Symbols) -> Self {
        Self {
            statements,
            symbols,
            beside: Vec::new(),
            needed: Vec::new(),
        }
    }

    /// The equations between the entries of both sides.
    fn equation(&mut self, equation: &Equation) -> Result<Vec<Equation>, String> {
        let (left, right) = (self.value(&equation.left)?, self.value(&equation.right)?);
        let between = |left: Tree, right: Tree| Equation {
            left,
            right,
            ..equation.clone()
        };
        let (left, right) = match (left, right) {
            (Value::Number(left), Value::Number(right)) => return Ok(vec![between(left, right)]),
            (Value::Matrix(left), Value::Matrix(right)) => (left, right),
            // 0 is the matrix of zeros
            (Value::Matrix(rows), Value::Number(zero)) if super::build::is_zero(&zero) => {
                let zeros = rows
                    .iter()
                    .map(|row| row.iter().map(|_| integer(0)).collect())
                    .collect();
                (rows, zeros)
            }
            _ => return Err("a matrix is compared with a number".to_owned()),
        };
        let shape = |rows: &Vec<Vec<Tree>>| (rows.len(), rows.first().map(Vec::len));
        if shape(&left) != shape(&right) {
            return Err("matrices of different shapes are compared".to_owned());
        }
        if equation.relation != Relation::Equal {
            return Err("matrices are compared by equality alone".to_owned());
        }
        let entries = left.into_iter().flatten().zip(right.into_iter().flatten());
        Ok(entries.map(|(left, right)| between(left, right)).collect())
    }

    fn number(&mut self, tree: &Tree) -> Result<Tree, String> {
        match self.value(tree)? {
            Value::Number(tree) => Ok(tree),
            Value::Matrix(_) => Err("a matrix stands where a number must".to_owned()),
        }
    }

    fn boxed(&mut self, tree: &Tree) -> Result<Box<Tree>, String> {
        self.number(tree).map(Box::new)
    }

    /// A binomial coefficient: by factorials only of integers, and where it is not 0.
    fn binomial(&mut self, of: &Tree, chosen: &Tree) -> Result<Tree, String> {
        let written = factorial::binomial(of, chosen)?;
        if whole(chosen).is_none() {
            let integers = integers(self.statements, self.symbols);
            if !factorial::is_linear_in(of, &integers) {
                return Err(format!("a binomial coefficient of {of} over a symbol"));
            }
            if !factorial::is_linear_in(chosen, &integers) {
                return Err(format!(
                    "a binomial coefficient over {chosen}, which need not be an integer"
                ));
            }
            // of integers: not less is more than one less
            let more = |left: &Tree, right: Tree| Equation {
                relation: Relation::Greater,
                ..Equation::between(sum(vec![left.clone(), integer(1)]), right)
            };
            self.needed.extend([more(chosen, integer(0)), more(of, chosen.clone())]);
        }
        Ok(written)
    }

    fn values(&mut self, trees: &[Tree]) -> Result<Vec<Value>, String> {
        trees.iter().map(|tree| self.value(tree)).collect()
    }

    fn value(&mut self, tree: &Tree) -> Result<Value, String> {
        Ok(Value::Number(match tree {
            Tree::Number(_) | Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => tree.clone(),
            Tree::Sum(terms) => return matrix::added(self.values(terms)?),
            Tree::Product(factors) => {
                let values = self.values(factors)?;
                if values.iter().any(|value| matches!(value, Value::Matrix(_))) {
                    let numbers = values.iter().filter_map(|value| match value {
                        Value::Number(tree) => Some(tree),
                        Value::Matrix(_) => None,
                    });
                    self.beside
                        .extend(numbers.filter(|tree| may_be_undefined(tree)).cloned());
                }
                return matrix::multiplied(values);
            }
            Tree::Negate(inner) => match self.value(inner)? {
                Value::Number(inner) => Tree::Negate(Box::new(inner)),
                value => return Ok(matrix::negated(value)),
            },
            Tree::Quotient(above, below, at) => match self.value(above)? {
                Value::Number(above) => Tree::Quotient(Box::new(above), self.boxed(below)?, *at),
                value => {
                    let below = self.number(below)?;
                    return Ok(matrix::divided(value, &below));
                }
            },
            Tree::Call(name, argument, at) => match self.value(argument)? {
                Value::Number(argument) if factorial::is_one(tree) => match factorial::of_number(name, &argument) {
                    Some(number) => number?,
                    None => Tree::Call(name.clone(), Box::new(argument), *at),
                },
                Value::Number(argument) => Tree::Call(name.clone(), Box::new(argument), *at),
                Value::Matrix(rows) if name.base == r"\abs" && !self.is_complex() && !self.is_complex_in(&rows) => {
                    matrix::norm(&rows)?
                }
                Value::Matrix(_) => return Err(format!("`{name}` of a matrix")),
            },
            Tree::Power(base, exponent, at) => match self.value(base)? {
                Value::Number(base) => Tree::Power(Box::new(base), *exponent, *at),
                Value::Matrix(rows) if matrix::vector(&rows).is_some() && !matrix::is_square(&rows) => {
                    return Err("the power of a vector: write \\cdot".to_owned());
                }
                Value::Matrix(rows) => return Ok(Value::Matrix(matrix::raised(&rows, *exponent)?)),
            },
            Tree::RealPower(base, exponent, at) => match self.value(base)? {
                Value::Matrix(rows) if self.symbols.transposes(exponent) => {
                    return Ok(Value::Matrix(matrix::transposed(&rows)));
                }
                Value::Matrix(rows) => {
                    let exponent = number_of(exponent).and_then(|exponent| exponent.to_integer());
                    let exponent = exponent.and_then(|exponent| i32::try_from(exponent).ok());
                    let exponent = exponent.ok_or("a symbolic power of a matrix")?;
                    return Ok(Value::Matrix(matrix::raised(&rows, exponent)?));
                }
                Value::Number(_) if self.symbols.transposes(exponent) => {
                    return Err(format!("the transpose of a number, or an unknown symbol `{exponent}`"));
                }
                Value::Number(base) => Tree::RealPower(Box::new(base), self.boxed(exponent)?, *at),
            },
            Tree::Root(inner, index, at) => Tree::Root(self.boxed(inner)?, *index, *at),
            Tree::PlusMinus(inner) => Tree::PlusMinus(self.boxed(inner)?),
            Tree::MinusPlus(inner) => Tree::MinusPlus(self.boxed(inner)?),
            Tree::Operation(operation, _) => return self.operation(operation),
        }))
    }

    fn operation(&mut self, operation: &Operation) -> Result<Value, String> {
        Ok(match operation {
            Operation::Arguments(_) => return Err("a function of several arguments without a definition".to_owned()),
            Operation::Matrix(rows) => {
                let mut out = Vec::new();
                for row in rows {
                    let row = row.iter().map(|cell| self.number(cell));
                    out.push(row.collect::<Result<Vec<_>, _>>()?);
                }
                // an entry that meets a 0 must have a value all the same
                let entries = out.iter().flatten().filter(|entry| may_be_undefined(entry));
                self.beside.extend(entries.cloned());
                Value::Matrix(out)
            }
            Operation::Determinant(of) | Operation::Trace(of) => match self.value(of)? {
                Value::Matrix(rows) if matches!(operation, Operation::Trace(_)) => Value::Number(matrix::trace(&rows)?),
                Value::Matrix(rows) => Value::Number(matrix::determinant(&rows)?),
                Value::Number(_) => return Err("a determinant or trace of a number".to_owned()),
            },
            Operation::Transpose(of) => match self.value(of)? {
                Value::Matrix(rows) => Value::Matrix(matrix::transposed(&rows)),
                number => number,
            },
            Operation::Cross(left, right) => matrix::cross(&self.value(left)?, &self.value(right)?)?,
            Operation::Binomial(of, chosen) => {
                let (of, chosen) = (self.number(of)?, self.number(chosen)?);
                self.beside.extend(may_be_undefined(&of).then(|| of.clone()));
                Value::Number(self.binomial(&of, &chosen)?)
            }
            Operation::Dot(left, right) => {
                let (left, right) = (self.value(left)?, self.value(right)?);
                let is_complex = |value: &Value| matches!(value, Value::Matrix(rows) if self.is_complex_in(rows));
                if (self.is_complex() || is_complex(&left) || is_complex(&right))
                    && matches!((&left, &right), (Value::Matrix(_), Value::Matrix(_)))
                {
                    return Err("\\cdot between complex vectors may take a conjugate: write a transpose".to_owned());
                }
                matrix::dot(&left, &right)?
            }
            Operation::Derivative { of, by, order, at } => self.derivative(of, by, *order, at)?,
            Operation::Series {
                kind,
                of,
                index,
                from,
                to,
            } => {
                if super::is_spoken_of(self.statements, self.symbols, index) {
                    return Err(format!("premises speak of `{index}`, which the sum is over"));
                }
                let (Some(from), Some(to)) = (whole(from), whole(to)) else {
                    return Err(format!(
                        "the length of the {} over {index} is not a number: declare in `integers` the letters that its ends have",
                        name_of(*kind)
                    ));
                };
                if to.saturating_sub(from) >= MOST_TERMS {
                    return Err(format!("more than {MOST_TERMS} terms"));
                }
                if to.saturating_sub(from) < -1 {
                    return Err(format!("the {} over {index} ends before it begins", name_of(*kind)));
                }
                let mut terms = Vec::new();
                for value in from..=to {
                    terms.push(self.value(&at_index(of, index, value))?);
                }
                match (terms.is_empty(), kind) {
                    (true, Series::Sum) => Value::Number(integer(0)),
                    (true, Series::Product) => Value::Number(integer(1)),
                    (false, Series::Sum) => matrix::added(terms)?,
                    (false, Series::Product) => matrix::multiplied(terms)?,
                }
            }
            Operation::Integral { .. } => return Err("an integral".to_owned()),
            Operation::Root { .. } => return Err("a root whose index is a symbol".to_owned()),
            Operation::Limit { .. }
            | Operation::Order(..)
            | Operation::Approaches(_)
            | Operation::OneSided(..)
            | Operation::Infinity => return Err("a limit stands where it is not read".to_owned()),
            Operation::Cases(_) => return Err("cases within what is differentiated or summed".to_owned()),
        })
    }

    /// Whether complex numbers may stand in a matrix.
    fn is_complex_in(&self, rows: &[Vec<Tree>]) -> bool {
        rows.iter().flatten().any(|entry| self.symbols.may_be_complex(entry))
    }

    /// Whether complex numbers may take part.
    fn is_complex(&self) -> bool {
        super::trees(self.statements)
            .into_iter()
            .any(|tree| self.symbols.may_be_complex(tree))
    }

    fn derivative(&mut self, of: &Tree, by: &Name, order: u32, at: &Tree) -> Result<Value, String> {
        let symbols = self.symbols;
        let of = self.value(of)?;
        let runs = symbols.running() == Some(by);
        super::is_continuous(self.statements, symbols, by)?;
        // a function is a coordinate: of what is written the others are held fixed, unless a premise ties one of them to it
        let is_apart = symbols.is_function(by) && !super::ties_functions(self.statements, symbols, by, &of);
        if !runs && !is_apart && super::is_spoken_of(self.statements, symbols, by) {
            return Err(format!(
                "premises speak of `{by}`: what depends on it there is not differentiated; write it out, or let `{by}` run"
            ));
        }
        if symbols.is_indexed(by) || symbols.is_index_letter(by) {
            return Err(format!(
                "a derivative by `{by}` is written \\frac{{\\partial a}}{{\\partial b}}"
            ));
        }
        let mut each = |tree: &Tree| -> Result<Tree, String> {
            let slope = By { symbols, name: by }.of_order(tree, order)?;
            let there = |tree: Tree| match at {
                Tree::Symbol(name, _) if name == by => tree,
                at => rewrite(&tree, &|name| (name == by).then(|| at.clone())),
            };
            // a derivative exists where that of each order before it does
            for before in 0..order {
                let before = By { symbols, name: by }.of_order(tree, before)?;
                self.beside.push(there(before));
            }
            Ok(there(slope))
        };
        Ok(match of {
            Value::Number(tree) => Value::Number(each(&tree)?),
            Value::Matrix(rows) => {
                let mut out = Vec::new();
                for row in &rows {
                    out.push(row.iter().map(&mut each).collect::<Result<Vec<_>, _>>()?);
                }
                Value::Matrix(out)
            }
        })
    }
}

/// Whether a tree is more than sums and products of numbers and symbols.
pub(super) fn may_be_undefined(tree: &Tree) -> bool {
    any(tree, &mut |node| {
        !matches!(
            node,
            Tree::Number(_)
                | Tree::Symbol(..)
                | Tree::Negate(_)
                | Tree::Sum(_)
                | Tree::Product(_)
                | Tree::Power(_, 0.., _)
        )
    })
}

fn name_of(kind: Series) -> &'static str {
    match kind {
        Series::Sum => "sum",
        Series::Product => "product",
    }
}

/// A term of a sum: its index a number, also where it numbers a name.
pub(super) fn at_index(of: &Tree, index: &Name, value: i64) -> Tree {
    let letter = index.to_string();
    rewrite(of, &|name| {
        if name == index {
            return Some(integer(value));
        }
        let offset = index_of(&name.subscript, &letter)?;
        Some(symbol(&Name {
            subscript: (value + i64::from(offset)).to_string(),
            ..name.clone()
        }))
    })
}
