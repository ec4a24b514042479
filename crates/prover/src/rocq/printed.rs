//! Printed formulas as propositions of Rocq, from their trees alone: sides as they stand, nothing is moved.

use super::steps::Steps;
use super::text::{Unwritten, number};
use crate::script::Decided;
use claims::Premise;
use kernel::Symbol;
use texmath::{Condition, Elementary, Equation, Name, Operation, Relation, Series, Tree, pair_of};

/// The writer of the formulas of one question.
pub struct Printer<'a> {
    decided: &'a Decided,
    /// Whether sums, integrals and the like are written.
    has_operations: bool,
}

type Text = Result<String, Unwritten>;

impl<'a> Printer<'a> {
    pub fn new(decided: &'a Decided) -> Self {
        Self {
            decided,
            has_operations: false,
        }
    }

    /// One that writes sums, integrals and the like, too.
    pub fn of_operations(decided: &'a Decided) -> Self {
        Self {
            decided,
            has_operations: true,
        }
    }

    pub fn premise(&self, premise: &Premise, steps: &mut Steps) -> Text {
        self.relation(&premise.equation, None, steps)
    }

    pub fn condition(&self, condition: &Condition, steps: &mut Steps) -> Text {
        match condition {
            Condition::Relation(equation) => self.relation(equation, None, steps),
            Condition::Integer(tree) => Ok(format!("integer {}", self.tree(tree, None, steps)?)),
        }
    }

    pub fn claim(&self, decided: &Decided, steps: &mut Steps) -> Text {
        let question = &decided.question;
        if matches!(&question.equation.left, Tree::Symbol(name, _) if pair_of(name).is_some()) {
            return Err(Unwritten::Not("a pair of solutions"));
        }
        let upper = match question.instance.as_str() {
            "lower sign" => Some(false),
            "upper sign" => Some(true),
            _ => None,
        };
        self.relation(&question.equation, upper, steps)
    }

    pub fn relation(&self, equation: &Equation, upper: Option<bool>, steps: &mut Steps) -> Text {
        let (left, right) = (
            self.tree(&equation.left, upper, steps)?,
            self.tree(&equation.right, upper, steps)?,
        );
        let sign = match equation.relation {
            Relation::Equal => "=",
            Relation::NotEqual => "<>",
            Relation::Less => "<",
            Relation::LessOrEqual => "<=",
            Relation::Greater => ">",
            Relation::GreaterOrEqual => ">=",
        };
        Ok(format!("{left} {sign} {right}"))
    }

    pub fn tree(&self, tree: &Tree, upper: Option<bool>, steps: &mut Steps) -> Text {
        let mut of = |tree: &Tree| self.tree(tree, upper, steps);
        Ok(match tree {
            Tree::Number(value) => number(value),
            Tree::Symbol(name, _) => return self.name(name, steps),
            Tree::Negate(body) => format!("(- {})", of(body)?),
            Tree::Sum(parts) => {
                let mut text = String::from("(");
                for (place, part) in parts.iter().enumerate() {
                    match part {
                        Tree::Negate(inner) if place > 0 => text += &format!(" - {}", of(inner)?),
                        part if place > 0 => text += &format!(" + {}", of(part)?),
                        part => text += &of(part)?,
                    }
                }
                text + ")"
            }
            Tree::Product(parts) => {
                let parts = parts.iter().map(of).collect::<Result<Vec<_>, _>>()?;
                format!("({})", parts.join(" * "))
            }
            Tree::Quotient(above, below, _) => format!("({} / {})", of(above)?, of(below)?),
            Tree::Power(base, exponent @ 0.., _) => format!("({} ^ {exponent})", of(base)?),
            Tree::Power(base, exponent, _) => match exponent.unsigned_abs() {
                1 => format!("(1 / {})", of(base)?),
                size => format!("(1 / ({} ^ {size}))", of(base)?),
            },
            Tree::RealPower(base, exponent, _) => match base.as_ref() {
                Tree::Symbol(name, _) if self.is_euler(name) => format!("(exp {})", of(exponent)?),
                base => {
                    let base = of(base)?;
                    match rational(exponent) {
                        Some((power, index)) => {
                            let root = if index == 2 {
                                format!("(sqrt {base})")
                            } else {
                                format!("(root {index} {base})")
                            };
                            match power {
                                1 => root,
                                0.. => format!("({root} ^ {power})"),
                                -1 => format!("(1 / {root})"),
                                _ => format!("(1 / ({root} ^ {}))", power.unsigned_abs()),
                            }
                        }
                        None => format!("(rpow {base} {})", of(exponent)?),
                    }
                }
            },
            Tree::Root(radicand, 2, _) => format!("(sqrt {})", of(radicand)?),
            Tree::Root(radicand, index, _) => format!("(root {index} {})", of(radicand)?),
            Tree::PlusMinus(body) | Tree::MinusPlus(body) => {
                let is_plus = matches!(tree, Tree::PlusMinus(_)) == upper.ok_or(Unwritten::Not("a sign of two"))?;
                let body = of(body)?;
                if is_plus { body } else { format!("(- {body})") }
            }
            Tree::Call(name, argument, _) => return self.call(name, argument, upper, steps),
            Tree::Partial { .. } | Tree::Invariant { .. } => {
                return Err(Unwritten::Not("maps from one impact to the next"));
            }
            Tree::Operation(operation, _) => return self.operation(operation, upper, steps),
        })
    }

    /// A function of a letter that is bound.
    pub fn function(&self, of: &Tree, by: &Name, upper: Option<bool>, steps: &mut Steps) -> Text {
        let letter = steps.bind(by);
        let body = self.tree(of, upper, steps);
        steps.unbind();
        Ok(format!("(fun {letter} : R => {})", body?))
    }

    /// A tree with a text in the place of a letter.
    pub fn at(&self, tree: &Tree, letter: &Name, text: &str, steps: &mut Steps) -> Text {
        steps.put(letter, text);
        let text = self.tree(tree, None, steps);
        steps.unbind();
        text
    }

    fn operation(&self, operation: &Operation, upper: Option<bool>, steps: &mut Steps) -> Text {
        if !self.has_operations {
            return Err(Unwritten::Not("a sum, an integral, a limit or the like"));
        }
        Ok(match operation {
            Operation::Derivative { of, by, order, at } => {
                let function = self.function(of, by, upper, steps)?;
                let at = self.tree(at, upper, steps)?;
                match order {
                    0 => format!("({function} {at})"),
                    1 => format!("(Derive {function} {at})"),
                    _ => format!("(Derive_n {function} {order} {at})"),
                }
            }
            Operation::Integral { of, by, limits } => {
                let (low, high) = limits.as_ref().ok_or(Unwritten::Not("an indefinite integral"))?;
                let ends = [self.tree(low, upper, steps)?, self.tree(high, upper, steps)?];
                format!("(RInt {} {} : R)", self.function(of, by, upper, steps)?, ends.join(" "))
            }
            Operation::Series {
                kind,
                of,
                index,
                from,
                to,
            } => {
                let ends = [self.tree(from, upper, steps)?, self.tree(to, upper, steps)?];
                let name = match kind {
                    Series::Sum => "rsum",
                    Series::Product => "rprod",
                };
                format!(
                    "({name} {} {})",
                    ends.join(" "),
                    self.function(of, index, upper, steps)?
                )
            }
            Operation::Binomial(of, chosen) => {
                let parts = [self.tree(of, upper, steps)?, self.tree(chosen, upper, steps)?];
                format!("(binomial {})", parts.join(" "))
            }
            Operation::Infinity => return Err(Unwritten::Not("infinity within a formula")),
            Operation::Limit { .. } => return Err(Unwritten::Not("a limit within a formula")),
            Operation::Matrix(_)
            | Operation::Determinant(_)
            | Operation::Trace(_)
            | Operation::Transpose(_)
            | Operation::Cross(..)
            | Operation::Dot(..) => return Err(Unwritten::Not("matrices")),
            Operation::Order(..) | Operation::Approaches(_) | Operation::OneSided(..) => {
                return Err(Unwritten::Not("an order or a side"));
            }
            Operation::Cases(_) => return Err(Unwritten::Not("values by cases")),
            Operation::Root { .. } | Operation::Arguments(_) => {
                return Err(Unwritten::Not(
                    "a root of symbolic index or a function of several arguments",
                ));
            }
        })
    }

    /// Whether a name is the base of the natural logarithm.
    fn is_euler(&self, name: &Name) -> bool {
        let statements = &self.decided.goal.statements;
        let symbols = &self.decided.goal.symbols;
        let is_declared = statements.locals.iter().any(|local| local.name == *name)
            || symbols.is_parameter(name)
            || symbols.abbreviation(name).is_some();
        name.to_string() == "e" && !is_declared
    }

    fn name(&self, name: &Name, steps: &mut Steps) -> Text {
        let printed = name.to_string();
        if let Some(bound) = steps.bound(&printed) {
            return Ok(bound);
        }
        let known = {
            let terms = steps.statement().terms();
            let all = (0..u32::try_from(terms.symbols()).unwrap_or(0)).map(Symbol);
            all.into_iter().find(|symbol| terms.symbol_name(*symbol) == printed)
        };
        if let Some(symbol) = known {
            let term = steps.statement().terms_mut().symbol(symbol);
            return steps.full(term);
        }
        match printed.as_str() {
            "\\pi" => Ok("PI".into()),
            "e" => Ok("(exp 1)".into()),
            _ => Err(Unwritten::Not("a name that is no symbol of its own")),
        }
    }

    fn call(&self, name: &Name, argument: &Tree, upper: Option<bool>, steps: &mut Steps) -> Text {
        let at = self.tree(argument, upper, steps)?;
        let function = match name.base.as_str() {
            r"\abs" => "Rabs",
            r"\sin" => "sin",
            r"\cos" => "cos",
            r"\tan" => "tan",
            r"\exp" => "exp",
            r"\ln" => "ln",
            r"\arcsin" => "asin",
            r"\arccos" => "acos",
            r"\arctan" => "atan",
            r"\sinh" => "sinh",
            r"\cosh" => "cosh",
            r"\tanh" => "tanh",
            r"\factorial" if self.has_operations => "factorial",
            _ => {
                if let Some(definition) = Elementary::named(name).and_then(|function| function.definition(argument)) {
                    return self.tree(&definition, upper, steps);
                }
                let printed = name.to_string();
                let plain = printed.trim_end_matches('\'');
                let order = u32::try_from(printed.len() - plain.len()).unwrap_or(0);
                let function = {
                    let terms = steps.statement().terms();
                    let mut all = (0..u32::try_from(terms.functions()).unwrap_or(0)).map(kernel::Function);
                    all.find(|function| terms.function_name(*function) == plain)
                };
                let function = function.ok_or(Unwritten::Not("a function that is no function of its own"))?;
                let statement = steps.statement().clone();
                let name = steps.names.function(&statement, function, order);
                return Ok(format!("({name} {at})"));
            }
        };
        Ok(format!("({function} {at})"))
    }
}

/// The exponent m/n of a root's power, where it is written with numbers and n is more than 1.
fn rational(exponent: &Tree) -> Option<(i32, u32)> {
    let value = texmath::number_of(exponent)?;
    let index = u32::try_from(value.0.denominator()).ok().filter(|index| *index > 1)?;
    Some((i32::try_from(value.0.numerator()).ok()?, index))
}

/// A condition in TeX.
pub fn condition_text(condition: &Condition) -> String {
    match condition {
        Condition::Relation(equation) => equation.to_string(),
        Condition::Integer(tree) => format!("{tree} is an integer"),
    }
}
