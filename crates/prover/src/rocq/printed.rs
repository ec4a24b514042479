//! Printed formulas as propositions of Rocq, from their trees alone: sides as they stand, nothing is moved.

use super::steps::Steps;
use super::text::{Unwritten, number};
use crate::formula::{Formulas, Meaning, Unknown, Within};
use crate::script::Decided;
use claims::{MapStep, Premise};
use kernel::{Function, FunctionOf, Node, Quantity, Symbol};
use texmath::{
    Condition, Elementary, Equation, Invariant, Map as Equations, Name, Operation, Relation, Series, Tree, pair_of,
};

/// The writer of the formulas of one question.
pub struct Printer<'a> {
    decided: &'a Decided,
    formulas: Formulas<'a>,
    /// True if sums, integrals and the like are written.
    has_operations: bool,
}

/// A formula that is written: what its names mean, and which sign `\pm` is.
#[derive(Clone, Copy)]
struct Reading<'a> {
    within: Within<'a>,
    upper: Option<bool>,
    decided: &'a Decided,
    has_operations: bool,
}

type Text = Result<String, Unwritten>;

impl<'a> Printer<'a> {
    pub fn new(decided: &'a Decided) -> Self {
        Self {
            decided,
            formulas: Formulas::new(&decided.goal.statements, &decided.goal.symbols, &decided.question),
            has_operations: false,
        }
    }

    /// One that writes sums, integrals and the like, too.
    pub fn of_operations(decided: &'a Decided) -> Self {
        Self {
            has_operations: true,
            ..Self::new(decided)
        }
    }

    fn reading<'b>(&'b self, within: Within<'b>) -> Reading<'b> {
        Reading {
            within,
            upper: None,
            decided: self.decided,
            has_operations: self.has_operations,
        }
    }

    pub fn premise(&self, premise: &Premise, steps: &mut Steps) -> Text {
        let within = self.formulas.within(&premise.equation, &premise.locals, None);
        self.reading(within).relation(&premise.equation, steps)
    }

    pub fn condition(&self, condition: &Condition, steps: &mut Steps) -> Text {
        let reading = self.reading(self.formulas.of_condition());
        match condition {
            Condition::Relation(equation) => reading.relation(equation, steps),
            Condition::Integer(tree) => Ok(format!("integer {}", reading.tree(tree, steps)?)),
        }
    }

    pub fn claim(&self, steps: &mut Steps) -> Text {
        let question = &self.decided.question;
        let claim = &question.equation;
        let reading = self.reading(self.formulas.of_claim(claim));
        let with = |upper: bool| Reading {
            upper: Some(upper),
            ..reading
        };
        if let Tree::Symbol(name, at) = &claim.left
            && let Some(single) = pair_of(name)
        {
            let values = [true, false].map(|upper| with(upper).tree(&claim.right, steps));
            let [upper, lower] = values;
            let (upper, lower) = (upper?, lower?);
            let symbol = reading.tree(&Tree::Symbol(single.clone(), *at), steps)?;
            return match question.instance.as_str() {
                "every solution" => Ok(format!("{symbol} = {upper} \\/ {symbol} = {lower}")),
                "the upper value is a solution" => self.solves(&symbol, &upper, steps),
                "the lower value is a solution" => self.solves(&symbol, &lower, steps),
                _ => Err(Unwritten::Not("a pair of solutions")),
            };
        }
        match question.instance.as_str() {
            "lower sign" => with(false).relation(claim, steps),
            "upper sign" => with(true).relation(claim, steps),
            _ => reading.relation(claim, steps),
        }
    }

    /// The equation that determines a symbol, said of a value of it.
    fn solves(&self, symbol: &str, value: &str, steps: &mut Steps) -> Text {
        let mut all = Vec::new();
        for premise in &self.decided.goal.statements.premises {
            let says = self.premise(premise, steps)?;
            let is_within = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
            if says.split(|c| !is_within(c)).any(|word| word == symbol) {
                all.push(says);
            }
        }
        match all.as_slice() {
            [says] => Ok(format!("let {symbol} := {value} in {says}")),
            _ => Err(Unwritten::Not("a pair of solutions of several equations")),
        }
    }
}

impl Printer<'_> {
    fn of_claim(&self, upper: Option<bool>) -> Reading<'_> {
        Reading {
            upper,
            ..self.reading(self.formulas.of_claim(&self.decided.question.equation))
        }
    }

    pub fn relation(&self, equation: &Equation, upper: Option<bool>, steps: &mut Steps) -> Text {
        self.of_claim(upper).relation(equation, steps)
    }

    pub fn tree(&self, tree: &Tree, upper: Option<bool>, steps: &mut Steps) -> Text {
        self.of_claim(upper).tree(tree, steps)
    }

    /// A function of a letter that is bound.
    pub fn function(&self, of: &Tree, by: &Name, upper: Option<bool>, steps: &mut Steps) -> Text {
        self.of_claim(upper).function(of, by, steps)
    }

    /// A tree with a text in the place of a letter.
    pub fn at(&self, tree: &Tree, letter: &Name, text: &str, steps: &mut Steps) -> Text {
        steps.put(letter, text);
        let text = self.tree(tree, None, steps);
        steps.unbind();
        text
    }
}

impl Reading<'_> {
    fn relation(&self, equation: &Equation, steps: &mut Steps) -> Text {
        let (left, right) = (self.tree(&equation.left, steps)?, self.tree(&equation.right, steps)?);
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

    fn tree(&self, tree: &Tree, steps: &mut Steps) -> Text {
        let mut of = |tree: &Tree| self.tree(tree, steps);
        Ok(match tree {
            Tree::Number(value) => number(value),
            Tree::Symbol(name, _) => return self.name(name, steps),
            Tree::Negate(body) => format!("(- {})", of(body)?),
            Tree::Sum(parts) => {
                let mut text = String::from("(");
                for (place, part) in parts.iter().enumerate() {
                    match part {
                        Tree::Negate(inner) if place > 0 => text += &format!(" - {}", of(inner)?),
                        Tree::PlusMinus(inner) if place > 0 && self.upper == Some(false) => {
                            text += &format!(" - {}", of(inner)?);
                        }
                        Tree::MinusPlus(inner) if place > 0 && self.upper == Some(true) => {
                            text += &format!(" - {}", of(inner)?);
                        }
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
            Tree::Power(base, exponent, _) => raised(&of(base)?, *exponent),
            Tree::RealPower(base, exponent, _) => match base.as_ref() {
                Tree::Symbol(name, _) if name.to_string() == "e" && !self.within.is_declared(name) => {
                    format!("(exp {})", of(exponent)?)
                }
                base => {
                    let base = of(base)?;
                    match rational(exponent) {
                        Some((power, 1)) => raised(&base, power),
                        Some((power, 2)) => raised(&format!("(sqrt {base})"), power),
                        Some((power, index)) => raised(&format!("(root {index} {base})"), power),
                        None => format!("(rpow {base} {})", of(exponent)?),
                    }
                }
            },
            Tree::Root(radicand, 2, _) => format!("(sqrt {})", of(radicand)?),
            Tree::Root(radicand, index, _) => format!("(root {index} {})", of(radicand)?),
            Tree::PlusMinus(body) | Tree::MinusPlus(body) => {
                let is_plus =
                    matches!(tree, Tree::PlusMinus(_)) == self.upper.ok_or(Unwritten::Not("a sign of two"))?;
                let body = of(body)?;
                if is_plus { body } else { format!("(- {body})") }
            }
            Tree::Call(name, argument, _) => return self.call(name, argument, steps),
            Tree::Partial { of, by, .. } => return self.partial(of, by, steps),
            Tree::Invariant { kind, of, .. } => return self.invariant(*kind, of, steps),
            Tree::Operation(operation, _) => return self.operation(operation, steps),
        })
    }

    fn function(&self, of: &Tree, by: &Name, steps: &mut Steps) -> Text {
        let letter = steps.bind(by);
        let body = self.tree(of, steps);
        steps.unbind();
        Ok(format!("(fun {letter} : R => {})", body?))
    }

    fn operation(&self, operation: &Operation, steps: &mut Steps) -> Text {
        if !self.has_operations {
            return Err(Unwritten::Not("a sum, an integral, a limit or the like"));
        }
        Ok(match operation {
            Operation::Derivative { of, by, order, at } => {
                let function = self.function(of, by, steps)?;
                let at = self.tree(at, steps)?;
                match order {
                    0 => format!("({function} {at})"),
                    1 => format!("(Derive {function} {at})"),
                    _ => format!("(Derive_n {function} {order} {at})"),
                }
            }
            Operation::Integral { of, by, limits } => {
                let (low, high) = limits.as_ref().ok_or(Unwritten::Not("an indefinite integral"))?;
                let ends = [self.tree(low, steps)?, self.tree(high, steps)?];
                format!("(RInt {} {} : R)", self.function(of, by, steps)?, ends.join(" "))
            }
            Operation::Series {
                kind,
                of,
                index,
                from,
                to,
            } => {
                let ends = [self.tree(from, steps)?, self.tree(to, steps)?];
                let name = match kind {
                    Series::Sum => "rsum",
                    Series::Product => "rprod",
                };
                format!("({name} {} {})", ends.join(" "), self.function(of, index, steps)?)
            }
            Operation::Binomial(of, chosen) => {
                let parts = [self.tree(of, steps)?, self.tree(chosen, steps)?];
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

    fn name(&self, name: &Name, steps: &mut Steps) -> Text {
        if let Some(bound) = steps.bound(&name.to_string()) {
            return Ok(bound);
        }
        match self.within.meaning(name) {
            Meaning::Symbol(printed) => symbol(&printed, steps),
            Meaning::Unknown(unknown) => {
                let at = symbol(&self.within.running(), steps)?;
                value(&unknown, &at, steps)
            }
            Meaning::Number(printed) => match (symbol(&printed, steps), printed.as_str()) {
                (Err(NO_SYMBOL), "\\pi") => Ok("PI".into()),
                (Err(NO_SYMBOL), "e") => Ok("(exp 1)".into()),
                (known, _) => known,
            },
        }
    }

    /// A derivative along a map, which has a name of its own.
    fn partial(&self, of: &Name, by: &Name, steps: &mut Steps) -> Text {
        let mut found = Vec::new();
        for name in [of, by] {
            let printed = self.within.moving(name).ok_or(NO_SYMBOL)?;
            found.push(symbol_of(&printed, steps)?);
        }
        match found.as_slice() {
            &[of, by] => {
                let leads = |map: &&MapStep| map.implicit.of.contains(&of) && map.implicit.by.contains(&by);
                let maps = || self.decided.question.maps.iter().filter(leads);
                let own = maps().find(|map| map.images.is_empty());
                let mut outright = maps().filter(|map| !map.images.is_empty());
                let map = own.or_else(|| outright.next().filter(|_| outright.next().is_none()));
                let map = map.ok_or(Unwritten::Not("a derivative along several maps"))?;
                self.entry(of, by, map, steps)
            }
            _ => Err(NO_SYMBOL),
        }
    }

    /// A derivative of what a map gives by what it starts from: a symbol of its own, or that of what the map says outright.
    fn entry(&self, of: Symbol, by: Symbol, map: &MapStep, steps: &mut Steps) -> Text {
        let quantity = Quantity::Partial { of, by };
        let statement = steps.statement().clone();
        if map.images.is_empty() {
            let place = statement.quantities().iter().position(|known| *known == quantity);
            let symbol = Symbol(u32::try_from(place.ok_or(NO_SYMBOL)?).unwrap_or(u32::MAX));
            let term = steps.statement().terms_mut().symbol(symbol);
            return steps.full(term);
        }
        let place = map.implicit.of.iter().position(|own| *own == of);
        let image = *place.and_then(|place| map.images.get(place)).ok_or(NO_SYMBOL)?;
        let mut maps = self.decided.goal.symbols.maps();
        let Some(Equations::Equations(equations)) =
            maps.find_map(|(name, own)| (name.to_string() == map.name).then_some(own))
        else {
            return Err(Unwritten::Not(
                "a derivative along a map that says outright what comes next",
            ));
        };
        let printed = statement.terms().symbol_name(of);
        let says = equations.iter().find(|equation| match &equation.left {
            Tree::Symbol(left, _) => self.within.moving(left).as_deref() == Some(printed),
            _ => false,
        });
        let says = self.tree(&says.ok_or(NO_SYMBOL)?.right, steps)?;
        let says = super::abbreviated(&says, steps)?;
        let written = steps.statement().written_out(image);
        let statement = steps.statement().clone();
        for inner in statement.terms().inside(written) {
            if let Node::Symbol(symbol) = statement.terms().node(inner)
                && statement.depends(*symbol)
                && !map.implicit.by.contains(symbol)
            {
                return Err(Unwritten::Not("a quantity that moves along a map without being of it"));
            }
        }
        let slope = steps.statement().along(image, &map.implicit, by);
        let by = steps.names.symbol(&statement, by);
        let text = format!("(Derive (fun {by} : R => {says}) {by})");
        steps.outright.insert(text.clone(), slope);
        Ok(text)
    }

    /// The trace or the determinant of a matrix of derivatives, written out.
    fn invariant(&self, kind: Invariant, of: &Name, steps: &mut Steps) -> Text {
        let word = if kind == Invariant::Trace { "Tr" } else { "Det" };
        if let Ok(known) = symbol(&format!("{word}({of})"), steps) {
            return Ok(known);
        }
        let matrix = self.matrix(of, steps)?;
        if matrix.iter().any(|row| row.len() != matrix.len()) {
            return Err(Unwritten::Not("a matrix without equal numbers of rows and columns"));
        }
        Ok(match kind {
            Invariant::Trace => {
                let diagonal = matrix.iter().enumerate().filter_map(|(n, row)| row.get(n).cloned());
                format!("({})", diagonal.collect::<Vec<_>>().join(" + "))
            }
            Invariant::Determinant => determinant(&matrix),
        })
    }

    fn matrix(&self, name: &Name, steps: &mut Steps) -> Result<Vec<Vec<String>>, Unwritten> {
        let mut all = self.decided.question.maps.iter();
        if let Some(map) = all.find(|map| map.name == name.to_string()) {
            let mut rows = Vec::new();
            let own = &map.implicit;
            for of in &own.of {
                let row: Result<Vec<String>, Unwritten> =
                    own.by.iter().map(|by| self.entry(*of, *by, map, steps)).collect();
                rows.push(row?);
            }
            return Ok(rows);
        }
        let maps = self.decided.goal.symbols.maps();
        let map = maps.into_iter().find_map(|(known, map)| (known == name).then_some(map));
        let Some(Equations::Product(factors)) = map else {
            return Err(Unwritten::Not("a map that says outright what comes next"));
        };
        let mut product: Option<Vec<Vec<String>>> = None;
        for factor in factors {
            let next = self.matrix(factor, steps)?;
            product = Some(match product {
                None => next,
                Some(before) => {
                    let columns = next.first().map_or(0, Vec::len);
                    let entry = |row: &Vec<String>, column: usize| {
                        let parts = row
                            .iter()
                            .zip(&next)
                            .filter_map(|(a, below)| Some(format!("{a} * {}", below.get(column)?)));
                        format!("({})", parts.collect::<Vec<_>>().join(" + "))
                    };
                    let row = |row: &Vec<String>| (0..columns).map(|column| entry(row, column)).collect();
                    before.iter().map(row).collect()
                }
            });
        }
        product.ok_or(NO_SYMBOL)
    }

    fn call(&self, name: &Name, argument: &Tree, steps: &mut Steps) -> Text {
        match self.within.called(name, argument) {
            Some(Meaning::Symbol(printed)) => return symbol(&printed, steps),
            Some(Meaning::Unknown(unknown)) => {
                let at = self.tree(argument, steps)?;
                return value(&unknown, &at, steps);
            }
            _ => {}
        }
        let at = self.tree(argument, steps)?;
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
                    return self.tree(&definition, steps);
                }
                return Err(Unwritten::Not("a function that is no function of its own"));
            }
        };
        Ok(format!("({function} {at})"))
    }
}

/// An integer power as the kernel has it: that of exponent 1 is the base.
fn raised(base: &str, exponent: i32) -> String {
    let power = match exponent.unsigned_abs() {
        1 => base.to_owned(),
        size => format!("({base} ^ {size})"),
    };
    if exponent < 0 { format!("(1 / {power})") } else { power }
}

const NO_SYMBOL: Unwritten = Unwritten::Not("a name that is no symbol of its own");

/// The symbol of a printed name.
fn symbol_of(printed: &str, steps: &mut Steps) -> Result<Symbol, Unwritten> {
    let statement = steps.statement();
    let all = (0..u32::try_from(statement.terms().symbols()).unwrap_or(0)).map(Symbol);
    let mut named = all.filter(|symbol| {
        let is_own = statement.quantity(*symbol) != Some(Quantity::Fresh);
        is_own && statement.terms().symbol_name(*symbol) == printed
    });
    match (named.next(), named.next()) {
        (Some(symbol), None) => Ok(symbol),
        (None, _) => Err(NO_SYMBOL),
        _ => Err(Unwritten::Not("a name of two symbols")),
    }
}

fn symbol(printed: &str, steps: &mut Steps) -> Text {
    let symbol = symbol_of(printed, steps)?;
    let term = steps.statement().terms_mut().symbol(symbol);
    steps.full(term)
}

/// The value of an unknown function, under the name that is declared for its derivative.
fn value(unknown: &Unknown, at: &str, steps: &mut Steps) -> Text {
    let statement = steps.statement().clone();
    let name = unknown.of.to_string();
    let is_own = |(place, of): (usize, &FunctionOf)| match *of {
        FunctionOf::Line => {
            let function = u32::try_from(place).map(Function);
            unknown.flight.is_none() && function.is_ok_and(|own| statement.terms().function_name(own) == name)
        }
        FunctionOf::Interval { piecewise, offset } => {
            let text = statement.piecewise().get(piecewise).map(|own| &own.text);
            unknown.flight == Some(offset) && text == Some(&name)
        }
    };
    let place = statement.functions().iter().enumerate().position(is_own);
    let place = place.ok_or(Unwritten::Not("a function that is no function of its own"))?;
    let mut function = Function(u32::try_from(place).unwrap_or(u32::MAX));
    let mut order = unknown.order;
    while order > 0
        && let Some(next) = statement.derivatives().get(&function)
    {
        (function, order) = (*next, order - 1);
    }
    let name = steps.names.function(&statement, function, order);
    Ok(format!("({name} {at})"))
}

/// The determinant of a square matrix, by its first row.
fn determinant(matrix: &[Vec<String>]) -> String {
    let Some((first, rest)) = matrix.split_first() else {
        return "1".to_owned();
    };
    if rest.is_empty() {
        return first.concat();
    }
    let mut text = String::from("(");
    for (column, entry) in first.iter().enumerate() {
        let without = |row: &Vec<String>| {
            let kept = row.iter().enumerate().filter(|(n, _)| *n != column);
            kept.map(|(_, entry)| entry.clone()).collect()
        };
        let minor: Vec<Vec<String>> = rest.iter().map(without).collect();
        text += match column {
            0 => "",
            n if n % 2 == 1 => " - ",
            _ => " + ",
        };
        text += &format!("{entry} * {}", determinant(&minor));
    }
    text + ")"
}

/// The exponent m/n of a power, where it is written with numbers alone.
fn rational(exponent: &Tree) -> Option<(i32, u32)> {
    let value = texmath::number_of(exponent)?;
    Some((
        i32::try_from(value.0.numerator()).ok()?,
        u32::try_from(value.0.denominator()).ok()?,
    ))
}

/// A condition in TeX.
pub fn condition_text(condition: &Condition) -> String {
    match condition {
        Condition::Relation(equation) => equation.to_string(),
        Condition::Integer(tree) => format!("{tree} is an integer"),
    }
}
