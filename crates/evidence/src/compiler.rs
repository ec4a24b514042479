//! From trees to formulas: every name is resolved once.

use super::formula::{Formula, Formulas, Op};
use super::index::{index_runs, is_index, member};
use super::maps::Maps;
use super::space::{Slot, Space};
use super::value::Function;
use claims::Local;
use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::collections::HashMap;
use texmath::{Elementary, Invariant, Name, Symbols, Tree, index_of, number_of};

/// Why there is no witness.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unwitnessed {
    /// A name without a meaning.
    #[error("`{0}` has no value here")]
    Unknown(String),
    /// A symbol defined by itself.
    #[error("`{0}` is defined by itself")]
    Circular(String),
    /// A derivative that no map has.
    #[error("no map gives the derivative of `{0}` by `{1}`")]
    NoMap(String, String),
    /// Premises of a kind that has no witness.
    #[error("{0}")]
    Kind(&'static str),
}

/// The letter of the constant of integration, which any antiderivative may have.
pub const CONSTANT: &str = "C";

/// Turns trees into formulas.
pub struct Compiler<'a> {
    pub symbols: &'a Symbols,
    pub space: &'a mut Space,
    pub formulas: &'a mut Formulas,
    pub maps: &'a Maps,
    pub locals: &'a [Local],
    /// The first impact of the equation: there a state without a mark, in a bracket, is the one just after.
    pub first: Option<i32>,
    /// The impact that the flight spoken of starts from.
    pub flight: i32,
    /// Which sign `\pm` stands for.
    pub upper: bool,
    /// By how much a running index is shifted.
    pub index_shift: i32,
    /// Whether antiderivatives may start anywhere, and orders are left out.
    pub is_up_to: bool,
    /// The letters that are bound around what is read, the innermost last.
    pub bound: Vec<Bound>,
    pub(super) open: Vec<Name>,
    pub(super) known: HashMap<Name, Formula>,
}

/// A name that an operation binds.
#[derive(Clone, Debug)]
pub struct Bound {
    pub name: Name,
    pub formula: Formula,
    pub is_integer: bool,
}

impl<'a> Compiler<'a> {
    pub fn new(symbols: &'a Symbols, space: &'a mut Space, formulas: &'a mut Formulas, maps: &'a Maps) -> Self {
        Self {
            symbols,
            space,
            formulas,
            maps,
            locals: &[],
            first: None,
            flight: 0,
            upper: true,
            index_shift: 0,
            is_up_to: false,
            bound: Vec::new(),
            open: Vec::new(),
            known: HashMap::new(),
        }
    }

    /// The formula of a tree.
    pub fn tree(&mut self, tree: &Tree) -> Result<Formula, Unwitnessed> {
        Ok(match tree {
            Tree::Number(value) => self.formulas.rational(value),
            Tree::Symbol(name, _) => self.symbol(name)?,
            Tree::Call(function, argument, _) => self.call(function, argument)?,
            Tree::Partial { of, by, .. } => self.partial(of, by)?,
            Tree::Invariant { kind, of, .. } => self.invariant(*kind, of)?,
            Tree::Negate(body) => self.signed(body, false)?,
            Tree::Sum(terms) => {
                let terms = self.trees(terms)?;
                self.formulas.sum(terms)
            }
            Tree::Product(factors) => {
                let factors = self.trees(factors)?;
                self.formulas.product(factors)
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.tree(above)?, self.tree(below)?);
                self.formulas.divide(above, below)
            }
            Tree::Power(base, exponent, _) => {
                let base = self.tree(base)?;
                self.formulas.make(Op::Power(base, *exponent))
            }
            Tree::RealPower(base, exponent, _) => self.power(base, exponent)?,
            Tree::Root(radicand, index, _) => {
                let radicand = self.tree(radicand)?;
                self.formulas.make(Op::Root(radicand, *index))
            }
            Tree::PlusMinus(body) => self.signed(body, self.upper)?,
            Tree::MinusPlus(body) => self.signed(body, !self.upper)?,
            Tree::Operation(operation, _) => self.operation(operation)?,
        })
    }

    fn trees(&mut self, trees: &[Tree]) -> Result<Vec<Formula>, Unwitnessed> {
        trees.iter().map(|tree| self.tree(tree)).collect()
    }

    fn signed(&mut self, body: &Tree, plus: bool) -> Result<Formula, Unwitnessed> {
        let body = self.tree(body)?;
        Ok(if plus {
            body
        } else {
            self.formulas.make(Op::Negate(body))
        })
    }

    fn power(&mut self, base: &Tree, exponent: &Tree) -> Result<Formula, Unwitnessed> {
        let whole = self.has_integer_values(exponent);
        let is_e = matches!(base, Tree::Symbol(name, _) if self.is_constant(name, "e"));
        let written = number_of(exponent).filter(|_| !is_e).and_then(|value| fraction(&value));
        let (base, exponent) = (self.tree(base)?, self.tree(exponent)?);
        match written {
            Some((power, 1)) => return Ok(self.formulas.make(Op::Power(base, power))),
            // a power of an even root: its base must not be negative, and 0 has a positive one among complex numbers too
            Some((power, index)) => {
                let by = if index % 2 == 0 { 1 } else { 2 };
                let root = self.formulas.make(Op::Root(base, by * index));
                return Ok(self.formulas.make(Op::Power(root, by as i32 * power)));
            }
            None => {}
        }
        Ok(match (is_e, whole) {
            (true, _) => self.formulas.apply(Function::Exp, exponent),
            (false, true) => self.formulas.make(Op::IntegerPower(base, exponent)),
            (false, false) => self.formulas.make(Op::RealPower(base, exponent)),
        })
    }

    /// Whether a tree is made of integers by sums, products and powers, up to numbers that make an integer.
    fn has_integer_values(&self, tree: &Tree) -> bool {
        self.unit(tree).is_some_and(|unit| is_integer(&unit))
    }

    /// A number of which each value of the tree is a multiple, if the tree is made of numbers and integers.
    fn unit(&self, tree: &Tree) -> Option<Rational> {
        let of = |part: &Tree| self.unit(part);
        Some(match tree {
            Tree::Number(value) => value.clone(),
            Tree::Symbol(name, _) => {
                if let Some(bound) = self.bound.iter().rev().find(|bound| bound.name == *name) {
                    return bound.is_integer.then(Rational::one);
                }
                if let Some(local) = self.locals.iter().find(|local| local.name == *name) {
                    return self.unit(&local.tree);
                }
                let symbols = self.symbols;
                if let Some(meaning) = symbols.abbreviation(name) {
                    return self.unit(meaning);
                }
                let is_counted =
                    |listed: &Name| index_runs(symbols) && listed.bare() == name.bare() && symbols.is_indexed(name);
                let is_listed = |listed: &Name| listed == name || is_counted(listed);
                let is_whole = symbols.integers().any(is_listed) || is_index(symbols, name);
                return is_whole.then(Rational::one);
            }
            Tree::Negate(body) | Tree::PlusMinus(body) | Tree::MinusPlus(body) => of(body)?,
            Tree::Power(body, exponent, _) if *exponent >= 0 => of(body)?.to_power(*exponent),
            Tree::Product(parts) => parts
                .iter()
                .map(of)
                .try_fold(Rational::one(), |product, part| Some(product * part?))?,
            Tree::Sum(parts) => parts
                .iter()
                .map(of)
                .try_fold(Rational::zero(), |sum, part| Some(common_unit(&sum, &part?)))?,
            Tree::Quotient(above, below, _) => {
                let below = number_of(below).filter(|below| !below.is_zero())?;
                of(above)? / below
            }
            _ => return None,
        })
    }

    /// Whether a name is this constant, which nothing declares anew.
    fn is_constant(&self, name: &Name, base: &str) -> bool {
        name.base == base
            && *name
                == Name {
                    base: base.to_string(),
                    ..Name::default()
                }
            && !self.symbols.is_parameter(name)
            && !self.locals.iter().any(|local| local.name == *name)
    }

    fn symbol(&mut self, name: &Name) -> Result<Formula, Unwitnessed> {
        if let Some(bound) = self.bound.iter().rev().find(|bound| bound.name == *name) {
            return Ok(bound.formula);
        }
        if let Some(known) = self.known.get(name) {
            return Ok(*known);
        }
        if let Some(local) = self.locals.iter().find(|local| local.name == *name) {
            return self.defined(name, &local.tree);
        }
        if self.symbols.is_parameter(name) {
            let slot = self.space.slot(Slot::Parameter(name.clone()));
            return Ok(self.formulas.slot(slot));
        }
        if let Some(tree) = self.symbols.abbreviation(name) {
            return self.defined(name, tree);
        }
        if let Some(slot) = self.quantity(name) {
            return Ok(self.formulas.slot(slot));
        }
        if self.symbols.running() == Some(name) {
            return Ok(self.formulas.make(Op::Running));
        }
        if name.mark.is_empty()
            && let Ok((course, level)) = self.course(name)
        {
            let running = self.symbols.running().cloned();
            let bound = self
                .bound
                .iter()
                .rev()
                .find(|bound| Some(&bound.name) == running.as_ref());
            let time = match bound {
                Some(bound) => bound.formula,
                None => self.formulas.make(Op::Running),
            };
            return Ok(self.formulas.make(Op::Value { course, level, time }));
        }
        if is_index(self.symbols, name) {
            let slot = self.space.slot(Slot::Parameter(name.clone()));
            // the letter that numbers members moves with them as it is
            let is_moved = name.to_string() == self.symbols.index;
            let shift = if is_moved { 0 } else { i64::from(self.index_shift) };
            let (index, shift) = (self.formulas.slot(slot), self.formulas.integer(shift));
            return Ok(self.formulas.add(index, shift));
        }
        if self.is_constant(name, r"\pi") {
            return Ok(self.formulas.make(Op::Pi));
        }
        if self.is_constant(name, "i") {
            return Ok(self.formulas.make(Op::Imaginary));
        }
        if self.is_constant(name, "e") {
            let one = self.formulas.integer(1);
            return Ok(self.formulas.apply(Function::Exp, one));
        }
        if self.is_up_to && self.is_constant(name, CONSTANT) {
            return Ok(self.formulas.integer(0));
        }
        if let Some((plain, is_odd)) = self.symbols.conjugated(name) {
            let plain = self.symbol(&plain)?;
            return Ok(match is_odd {
                true => self.formulas.apply(Function::Conjugate, plain),
                false => plain,
            });
        }
        Err(Unwitnessed::Unknown(name.to_string()))
    }

    fn defined(&mut self, name: &Name, tree: &Tree) -> Result<Formula, Unwitnessed> {
        let formula = self.opened(name, |own| own.tree(tree))?;
        self.known.insert(name.clone(), formula);
        Ok(formula)
    }

    /// What `work` makes of the definition of a name, in which the name itself may not stand.
    pub(super) fn opened<T>(
        &mut self,
        name: &Name,
        work: impl FnOnce(&mut Self) -> Result<T, Unwitnessed>,
    ) -> Result<T, Unwitnessed> {
        if self.open.contains(name) {
            return Err(Unwitnessed::Circular(name.to_string()));
        }
        self.open.push(name.clone());
        let made = work(self);
        self.open.pop();
        made
    }

    /// The slot of an indexed time or state.
    pub fn quantity(&mut self, name: &Name) -> Option<usize> {
        let member = || member(self.symbols, name);
        let (bare, index) = (
            name.bare(),
            index_of(&name.subscript, &self.symbols.index).or_else(member)?,
        );
        if name.primes > 0 {
            return None;
        }
        if name.mark.is_empty() && self.symbols.is_time(&bare) {
            return Some(self.space.slot(Slot::Time { family: bare, index }));
        }
        if !self.symbols.is_state(&bare) || !matches!(name.mark.as_str(), "" | "-" | "+") {
            return None;
        }
        Some(self.state(bare, index, name.mark == "+"))
    }

    /// The slot of a state; one that an impact does not change is the same before and after.
    pub fn state(&mut self, state: Name, index: i32, after: bool) -> usize {
        let after = after && !self.symbols.is_continuous(&state);
        self.space.slot(Slot::State { state, index, after })
    }

    /// The time of an impact.
    pub fn time(&mut self, index: i32) -> usize {
        let family = self.symbols.times().next().cloned().unwrap_or_default();
        self.space.slot(Slot::Time { family, index })
    }

    fn call(&mut self, function: &Name, argument: &Tree) -> Result<Formula, Unwitnessed> {
        let state = function.bare();
        if function.primes == 0
            && self.symbols.is_state(&state)
            && let Tree::Symbol(time, _) = argument
            && self.symbols.is_time(&time.bare())
            && let Some(index) = index_of(&time.subscript, &self.symbols.index)
        {
            let slot = self.state(state, index, function.mark == "+");
            return Ok(self.formulas.slot(slot));
        }
        if !function.mark.is_empty() {
            return Err(Unwitnessed::Unknown(function.to_string()));
        }
        match self.course(function) {
            Ok((course, level)) => {
                let time = self.tree(argument)?;
                Ok(self.formulas.make(Op::Value { course, level, time }))
            }
            Err(unknown) if function.primes > 0 => Err(unknown),
            Err(unknown) => {
                let argument = self.tree(argument)?;
                match function.base.as_str() {
                    r"\factorial" => return self.factorial(argument, 1),
                    r"\doublefactorial" => return self.factorial(argument, 2),
                    _ => {}
                }
                self.elementary(&function.base, argument).ok_or(unknown)
            }
        }
    }

    fn elementary(&mut self, command: &str, u: Formula) -> Option<Formula> {
        use Function::{Abs, Arccos, Arcosh, Arcsin, Arctan, Arsinh, Artanh, Cos, Cosh, Exp, Ln, Sgn, Sin, Sinh};
        use Function::{Arg, Conjugate, Im, Re};
        let function = match command.trim_start_matches('\\') {
            "sin" => Sin,
            "cos" => Cos,
            "exp" => Exp,
            "ln" | "log" => Ln,
            "sinh" => Sinh,
            "cosh" => Cosh,
            "arcsin" => Arcsin,
            "arccos" => Arccos,
            "arctan" => Arctan,
            "arsinh" => Arsinh,
            "arcosh" => Arcosh,
            "artanh" => Artanh,
            "abs" => Abs,
            "sgn" => Sgn,
            "conjugate" => Conjugate,
            "Re" => Re,
            "Im" => Im,
            "arg" => Arg,
            _ => {
                let (above, below) = Elementary::by_command(command)?.quotient()?;
                let above = match above {
                    Some(above) => self.elementary(above.command, u)?,
                    None => self.formulas.integer(1),
                };
                let below = self.elementary(below.command, u)?;
                return Some(self.formulas.divide(above, below));
            }
        };
        Some(self.formulas.apply(function, u))
    }

    /// The course of a function or of a state in flight, and how many derivatives below the highest integral.
    fn course(&mut self, name: &Name) -> Result<(usize, usize), Unwitnessed> {
        let plain = Name {
            primes: 0,
            ..name.clone()
        };
        let (names, flight) = match self.motion(&plain) {
            Some(names) => (names, Some(self.flight)),
            None => (
                self.chain(&plain)
                    .ok_or_else(|| Unwitnessed::Unknown(name.to_string()))?,
                None,
            ),
        };
        let level = names.iter().position(|known| *known == plain).unwrap_or(0);
        Ok((self.space.course(names, flight), level + usize::from(name.primes)))
    }

    /// A state with its derivatives: position, velocity, acceleration.
    fn motion(&self, name: &Name) -> Option<Vec<Name>> {
        let states = self.symbols.states();
        let is_derivative = |s: &Name| self.symbols.states().any(|other| other.dotted() == *s);
        states
            .filter(|s| !is_derivative(s))
            .map(|s| vec![s.clone(), s.dotted(), s.dotted().dotted()])
            .find(|names| names.contains(name))
    }

    /// The chain of a function: it with the integrals and derivatives that have names, from the highest integral down.
    fn chain(&self, name: &Name) -> Option<Vec<Name>> {
        chains(self.symbols).into_iter().find(|chain| chain.contains(name))
    }

    fn partial(&mut self, of: &Name, by: &Name) -> Result<Formula, Unwitnessed> {
        let none = || Unwitnessed::NoMap(of.to_string(), by.to_string());
        let (Some(above), Some(below)) = (self.quantity(of), self.quantity(by)) else {
            return Err(none());
        };
        self.maps
            .entry(above, below, self.space, self.formulas)
            .ok_or_else(none)
    }

    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<Formula, Unwitnessed> {
        if self.maps.opaque {
            let slot = self.space.slot(Slot::Invariant { kind, of: of.clone() });
            return Ok(self.formulas.slot(slot));
        }
        let found = self.maps.invariant(kind, of, self.space, self.formulas);
        found.ok_or_else(|| Unwitnessed::Unknown(of.to_string()))
    }
}

/// The functions of a symbol table in chains, each the derivative of the one before it.
pub fn chains(symbols: &Symbols) -> Vec<Vec<Name>> {
    let functions: Vec<(&Name, Option<&Tree>)> = symbols.functions().collect();
    let below = |name: &Name| {
        let (_, tree) = functions.iter().find(|(known, _)| *known == name)?;
        match tree {
            Some(Tree::Symbol(next, _)) => functions.iter().map(|(known, _)| *known).find(|known| *known == next),
            _ => None,
        }
    };
    let is_head = |name: &Name| {
        !functions
            .iter()
            .any(|(other, _)| *other != name && below(other) == Some(name))
    };
    let (heads, rest): (Vec<&Name>, Vec<&Name>) =
        functions.iter().map(|(name, _)| *name).partition(|name| is_head(name));
    let mut chains: Vec<Vec<Name>> = Vec::new();
    for name in heads.into_iter().chain(rest) {
        let is_new = |chains: &[Vec<Name>], chain: &[Name], name: &Name| {
            !chain.contains(name) && !chains.iter().any(|known| known.contains(name))
        };
        if !is_new(&chains, &[], name) {
            continue;
        }
        let mut chain = vec![name.clone()];
        while let Some(next) = chain
            .last()
            .and_then(below)
            .filter(|next| is_new(&chains, &chain, next))
        {
            chain.push(next.clone());
        }
        chains.push(chain);
    }
    chains
}

/// Numerator and denominator of a number whose powers and roots can be evaluated.
/// The greatest number of which both are whole multiples.
fn common_unit(a: &Rational, b: &Rational) -> Rational {
    let parts = |x: &Rational, y: &Rational| x.0.numerator().clone() * IBig::from(y.0.denominator().clone());
    let (left, right) = (parts(a, b), parts(b, a));
    if left == IBig::ZERO || right == IBig::ZERO {
        return a.clone() + b.clone();
    }
    let above = IBig::from(left.gcd(&right));
    Rational(RBig::from_parts(above, a.0.denominator() * b.0.denominator()))
}

fn is_integer(value: &Rational) -> bool {
    *value.0.denominator() == UBig::ONE
}

fn fraction(value: &Rational) -> Option<(i32, u32)> {
    let power = i32::try_from(value.0.numerator())
        .ok()
        .filter(|power| power.abs() <= 10_000);
    let index = u32::try_from(value.0.denominator()).ok().filter(|index| *index <= 1000);
    power.zip(index)
}
