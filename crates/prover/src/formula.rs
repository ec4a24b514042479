//! The printed formulas as Python expressions, from their trees alone: the kernel's terms are compared with these.

use claims::{Local, Question, Statements};
use kernel::Symbol;
use texmath::{
    Condition, Elementary, Equation, Invariant, Map, Name, Operation, Relation, Symbols, Tree, flies, index_of,
    pair_of, subscript_of,
};

/// All formulas of a question.
pub struct Formulas<'a> {
    statements: &'a Statements,
    symbols: &'a Symbols,
    question: &'a Question,
}

/// The meaning of a name within a formula.
pub enum Meaning {
    /// A symbol of the data, by its name there.
    Symbol(String),
    /// A value of an unknown function or of a motion.
    Unknown(Unknown),
    /// A number that has a name, where nothing else has it.
    Number(String),
}

/// A derivative of an unknown function, or of a motion in the flight after an impact.
pub struct Unknown {
    pub of: Name,
    pub flight: Option<i32>,
    pub order: u32,
}

impl Unknown {
    fn python(&self, at: &str) -> String {
        let flight = self.flight.map_or("None".to_owned(), |flight| flight.to_string());
        format!(
            "v.unknown({}, {flight}, {}, {at})",
            quoted(&self.of.to_string()),
            self.order
        )
    }
}

/// What names mean within one formula.
#[derive(Clone, Copy)]
pub struct Within<'a> {
    symbols: &'a Symbols,
    locals: &'a [Local],
    /// The impact whose flight the running time is in, and whether the formula speaks of a flight.
    flight: i32,
    in_flight: bool,
    /// Whether `\pm` is plus.
    pub upper: bool,
}

impl<'a> Formulas<'a> {
    pub fn new(statements: &'a Statements, symbols: &'a Symbols, question: &'a Question) -> Self {
        Self {
            statements,
            symbols,
            question,
        }
    }

    /// The formulas as Python data: label (of the claim: none), definitions beside it, and what it says of its values.
    pub fn python(&self) -> String {
        let mut formulas = Vec::new();
        let mut push = |label: &str, within: &Within, formula: String| {
            let definitions = within.locals.iter().rev().map(|local| {
                let tree = within.python(&local.tree);
                format!("{}: lambda v: {tree}", quoted(&local.name.to_string()))
            });
            let definitions: Vec<String> = definitions.collect();
            formulas.push(format!(
                "    ({}, {{{}}}, lambda v: {formula}),",
                quoted(label),
                definitions.join(", ")
            ));
        };
        for premise in &self.statements.premises {
            let within = self.within(&premise.equation, &premise.locals, None);
            push(&premise.label, &within, within.relation(&premise.equation));
            for condition in &premise.assume {
                let label = format!("the domain of ({})", premise.label);
                push(&label, &within, within.condition(condition));
            }
        }
        let claim = &self.question.equation;
        let own = self.of_condition();
        for condition in &self.statements.assume {
            push("the assumptions", &own, own.condition(condition));
        }
        for relation in &self.symbols.relations {
            push(&relation.to_string(), &own, own.relation(relation));
        }
        let running = quoted(&self.running());
        for (name, derivative) in self.symbols.functions() {
            if let Some(tree) = derivative {
                let within = Within { locals: &[], ..own };
                let slope = format!("v.unknown({}, None, 1, v({running}))", quoted(&name.to_string()));
                push(
                    &format!("the derivative of {name}"),
                    &within,
                    format!("{slope} - ({})", within.python(tree)),
                );
            }
        }
        let pair = match &claim.left {
            Tree::Symbol(name, _) => pair_of(name),
            _ => None,
        };
        match pair {
            None => {
                let within = Within {
                    upper: self.question.instance != "lower sign",
                    ..self.of_claim(claim)
                };
                push("", &within, within.relation(claim));
            }
            Some(name) if self.question.instance == "every solution" => {
                let symbol = own.python(&Tree::Symbol(name, claim.at));
                let [plus, minus] = [true, false].map(|upper| Within { upper, ..own }.python(&claim.right));
                push("", &own, format!("({symbol} - {plus}) * ({symbol} - {minus})"));
            }
            Some(_) => {
                for upper in [true, false] {
                    push("beside the claim", &own, Within { upper, ..own }.python(&claim.right));
                }
            }
        }
        for other in self.statements.claims.iter().filter(|other| *other != claim) {
            let is_pair = matches!(&other.left, Tree::Symbol(name, _) if pair_of(name).is_some());
            for side in [&other.left, &other.right].into_iter().skip(usize::from(is_pair)) {
                for upper in [true, false] {
                    let within = Within {
                        upper,
                        ..self.of_claim(other)
                    };
                    push("beside the claim", &within, within.python(side));
                }
            }
        }
        for local in &self.statements.locals {
            push("beside the claim", &own, own.name(&local.name));
        }
        let abbreviations = self.symbols.abbreviations().map(|(name, tree)| {
            let within = Within { locals: &[], ..own };
            format!(
                "        {}: lambda v: {},",
                quoted(&name.to_string()),
                within.python(tree)
            )
        });
        let abbreviations: Vec<String> = abbreviations.collect();
        format!(
            "# The formulas once more, from another translation; the data above must agree at random points.\nREADINGS = \
             {{\n    \"maps\": {},\n    \"abbreviations\": {{\n{}\n    }},\n    \"formulas\": [\n{}\n    ],\n}}",
            self.maps(),
            abbreviations.join("\n"),
            formulas.join("\n")
        )
    }

    /// The first impact that the claims speak of.
    fn first(&self) -> Option<i32> {
        let impacts = |claim| self.symbols.impacts(claim).first().copied();
        self.statements.claims.iter().map(impacts).min().flatten()
    }

    /// The formula of the claim, or another one beside it.
    pub fn of_claim(&self, equation: &Equation) -> Within<'_> {
        self.within(equation, &self.statements.locals, self.first())
    }

    /// A condition that is assumed.
    pub fn of_condition(&self) -> Within<'_> {
        Within {
            flight: self.first().unwrap_or(0),
            in_flight: false,
            ..self.within(&self.question.equation, &self.statements.locals, None)
        }
    }

    pub fn within<'b>(&'b self, equation: &Equation, locals: &'b [Local], first: Option<i32>) -> Within<'b> {
        Within {
            symbols: self.symbols,
            locals,
            flight: self.symbols.impacts(equation).first().copied().or(first).unwrap_or(0),
            in_flight: flies(equation, self.symbols),
            upper: true,
        }
    }

    fn running(&self) -> String {
        let running = self.symbols.running();
        running.map_or("t".to_string(), Name::to_string)
    }

    /// What each map takes to what, and how where it says so outright; of a product, its factors.
    fn maps(&self) -> String {
        let statement = &self.question.statement;
        if statement.maps().is_empty() && statement.outright_maps().is_empty() {
            // traces and determinants are numbers of their own
            return "{}".into();
        }
        let name = |symbol: &Symbol| quoted(statement.terms().symbol_name(*symbol));
        let entry = |map: &str, first: String, second: String, images: String| {
            format!("{}: ({first}, {second}, {{{images}}})", quoted(map))
        };
        let mut maps = Vec::new();
        for (number, step) in statement.maps().iter().enumerate() {
            let (first, second) = (list(step.of.iter().map(name)), list(step.by.iter().map(name)));
            let known = match step.name.is_empty() {
                true => number.to_string(),
                false => step.name.clone(),
            };
            maps.push(entry(&known, first, second, String::new()));
        }
        for step in statement.outright_maps() {
            let (first, second) = (list(step.of.iter().map(name)), list(step.by.iter().map(name)));
            maps.push(entry(&step.name, first, second, self.images(&step.name)));
        }
        for (map, meaning) in self.symbols.maps() {
            if let Map::Product(factors) = meaning {
                let factors = factors.iter().map(|factor| quoted(&factor.to_string()));
                maps.push(entry(&map.to_string(), list(factors), "[]".into(), String::new()));
            }
        }
        format!("{{{}}}", maps.join(", "))
    }

    /// What the equations of a map say that its quantities are.
    fn images(&self, map: &str) -> String {
        let of_map = |(name, map_of): (&Name, &Map)| (name.to_string() == map).then(|| map_of.clone());
        let Some(Map::Equations(equations)) = self.symbols.maps().find_map(of_map) else {
            return String::new();
        };
        let image = |equation: &Equation| {
            let within = self.within(equation, &[], None);
            let Tree::Symbol(left, _) = &equation.left else {
                return None;
            };
            let printed = within.moving(left)?;
            Some(format!(
                "{}: lambda v: {}",
                quoted(&printed),
                within.python(&equation.right)
            ))
        };
        let images: Vec<String> = equations.iter().filter_map(image).collect();
        images.join(", ")
    }
}

impl Within<'_> {
    /// What must vanish, be positive or the like.
    fn relation(&self, equation: &Equation) -> String {
        let (left, right) = (self.python(&equation.left), self.python(&equation.right));
        match equation.relation {
            Relation::Less | Relation::LessOrEqual => format!("{right} - {left}"),
            _ => format!("{left} - {right}"),
        }
    }

    fn condition(&self, condition: &Condition) -> String {
        match condition {
            Condition::Relation(equation) => self.relation(equation),
            Condition::Integer(tree) => self.python(tree),
        }
    }

    fn joined(&self, parts: &[Tree], by: &str) -> String {
        let parts: Vec<String> = parts.iter().map(|part| self.python(part)).collect();
        format!("({})", parts.join(by))
    }

    fn python(&self, tree: &Tree) -> String {
        let of = |tree: &Tree| self.python(tree);
        match tree {
            Tree::Number(value) => format!("v.number({})", quoted(&value.to_string())),
            Tree::Symbol(name, _) => self.name(name),
            Tree::Call(name, argument, _) => self.call(name, argument),
            Tree::Partial { of, by, .. } => format!(
                "v.derivative({}, {})",
                quoted(&self.moving(of).unwrap_or_default()),
                quoted(&self.moving(by).unwrap_or_default())
            ),
            Tree::Invariant { kind, of, .. } => {
                let kind = if *kind == Invariant::Trace { "Tr" } else { "Det" };
                format!("v.invariant({}, {})", quoted(kind), quoted(&of.to_string()))
            }
            Tree::Negate(body) => format!("(-{})", of(body)),
            Tree::Sum(parts) => self.joined(parts, " + "),
            Tree::Product(parts) => self.joined(parts, " * "),
            Tree::Quotient(above, below, _) => format!("({} / {})", of(above), of(below)),
            Tree::Power(base, exponent, _) => format!("({} ** {exponent})", of(base)),
            Tree::RealPower(base, exponent, _) => match base.as_ref() {
                Tree::Symbol(name, _) if name.to_string() == "e" && !self.is_declared(name) => {
                    format!("mpmath.exp({})", of(exponent))
                }
                base => format!("v.power({}, {})", of(base), of(exponent)),
            },
            Tree::Root(radicand, index, _) => format!("v.root({}, {index})", of(radicand)),
            Tree::PlusMinus(body) if self.upper => of(body),
            Tree::MinusPlus(body) if !self.upper => of(body),
            Tree::PlusMinus(body) | Tree::MinusPlus(body) => format!("(-{})", of(body)),
            Tree::Operation(operation, _) => match &**operation {
                Operation::Integral {
                    of: integrand,
                    by,
                    limits: Some((low, high)),
                } => format!(
                    "v.integral(lambda: {}, {}, lambda: {}, lambda: {})",
                    of(integrand),
                    quoted(&by.to_string()),
                    of(low),
                    of(high)
                ),
                Operation::Infinity => "mpmath.inf".to_owned(),
                _ => "v.operation()".to_owned(),
            },
        }
    }

    pub fn is_declared(&self, name: &Name) -> bool {
        self.locals.iter().any(|local| local.name == *name)
            || self.symbols.is_parameter(name)
            || self.symbols.abbreviation(name).is_some()
    }

    fn name(&self, name: &Name) -> String {
        let value = |printed: &str| format!("v({})", quoted(printed));
        match self.meaning(name) {
            Meaning::Symbol(printed) => value(&printed),
            Meaning::Unknown(unknown) => unknown.python(&value(&self.running())),
            Meaning::Number(printed) => match printed.as_str() {
                "\\pi" => "mpmath.pi".into(),
                "e" => "mpmath.e".into(),
                "i" => "mpmath.mpc(0, 1)".into(),
                other => value(other),
            },
        }
    }

    /// The name of the running time.
    pub fn running(&self) -> String {
        self.symbols.running().map_or("t".to_string(), Name::to_string)
    }

    /// The meaning of a name without an argument: functions are taken at the running time.
    pub fn meaning(&self, name: &Name) -> Meaning {
        let symbols = self.symbols;
        if self.is_declared(name) || symbols.is_index(name) {
            return Meaning::Symbol(name.to_string());
        }
        if let Some(printed) = self.moving(name) {
            return Meaning::Symbol(printed);
        }
        if symbols.running() == Some(name) {
            return Meaning::Symbol(self.running());
        }
        if name.mark.is_empty()
            && let Some(unknown) = self.unknown(name)
        {
            return Meaning::Unknown(unknown);
        }
        Meaning::Number(name.to_string())
    }

    /// The name of an impact's time, or of a state just before or just after it, in the form in which data have it.
    pub fn moving(&self, name: &Name) -> Option<String> {
        let letter = &self.symbols.index;
        let index = match name.subscript.is_empty() && !name.mark.is_empty() {
            true => 0,
            false => index_of(&name.subscript, letter)?,
        };
        let bare = name.bare();
        let time = name.mark.is_empty() && self.symbols.is_time(&bare);
        let state = self.symbols.is_state(&bare) && name.primes == 0;
        if !time && !state {
            return None;
        }
        let after = name.mark == "+" && !self.symbols.is_continuous(&bare);
        Some(indexed(bare, index, after, letter))
    }

    /// The function, or motion, that a name is of.
    fn unknown(&self, name: &Name) -> Option<Unknown> {
        let plain = Name {
            primes: 0,
            mark: String::new(),
            ..name.clone()
        };
        let primes = u32::from(name.primes);
        for state in self.symbols.states() {
            let mut dotted = state.clone();
            for more in 0..3 {
                if dotted == plain {
                    let (of, dots) = undotted(state);
                    return Some(Unknown {
                        of,
                        flight: Some(self.flight),
                        order: dots + more + primes,
                    });
                }
                dotted = dotted.dotted();
            }
        }
        let is_function = self.symbols.functions().any(|(function, _)| *function == plain);
        is_function.then_some(Unknown {
            of: plain,
            flight: None,
            order: primes,
        })
    }

    /// The meaning of a name with an argument, where it is no elementary function.
    pub fn called(&self, name: &Name, argument: &Tree) -> Option<Meaning> {
        if let Tree::Symbol(time, _) = argument
            && self.symbols.is_time(&time.bare())
            && let Some(index) = index_of(&time.subscript, &self.symbols.index)
            && self.symbols.is_state(&name.bare())
        {
            let departs = name.mark == "+" || (name.mark.is_empty() && self.in_flight && self.flight == index);
            let after = departs && !self.symbols.is_continuous(&name.bare());
            return Some(Meaning::Symbol(indexed(name.bare(), index, after, &self.symbols.index)));
        }
        self.unknown(name).map(Meaning::Unknown)
    }

    fn call(&self, name: &Name, argument: &Tree) -> String {
        let at = self.python(argument);
        match self.called(name, argument) {
            Some(Meaning::Symbol(printed)) => return format!("v({})", quoted(&printed)),
            Some(Meaning::Unknown(unknown)) => return unknown.python(&at),
            _ => {}
        }
        let function = match name.base.as_str() {
            r"\arsinh" | r"\arcosh" | r"\artanh" => {
                return format!("v.{}({at})", name.base.trim_start_matches('\\'));
            }
            r"\abs" => return format!("v.root({at} ** 2, 2)"),
            _ => Elementary::named(name).map_or(name.base.as_str(), |function| function.sympy),
        };
        format!("mpmath.{function}({at})")
    }
}

fn indexed(bare: Name, index: i32, after: bool, letter: &str) -> String {
    let name = Name {
        subscript: subscript_of(index, letter),
        mark: if after { "+".into() } else { String::new() },
        ..bare
    };
    name.to_string()
}

/// A state without its dots, and their number.
fn undotted(state: &Name) -> (Name, u32) {
    let mut root = state.clone();
    let dots = match root.accents.last().map(String::as_str) {
        Some(r"\dot") => 1,
        Some(r"\ddot") => 2,
        Some(r"\dddot") => 3,
        _ => return (root, 0),
    };
    root.accents.pop();
    (root, dots)
}

/// A string as JSON and Python write it.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            c if c.is_control() || !c.is_ascii() => {
                let mut units = [0; 2];
                out.extend(c.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

pub(super) fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(", "))
}
