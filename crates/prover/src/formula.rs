//! Meanings of names in the printed formulas of a question, and texts as JSON writes them.

use claims::{Local, Question, Statements};
use texmath::{Equation, Name, Symbols, Tree, flies, index_of, subscript_of};

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

/// Meanings of names within one formula.
#[derive(Clone, Copy)]
pub struct Within<'a> {
    symbols: &'a Symbols,
    locals: &'a [Local],
    /// The impact whose flight the running time is in, and whether the formula speaks of a flight.
    flight: i32,
    in_flight: bool,
}

impl<'a> Formulas<'a> {
    pub fn new(statements: &'a Statements, symbols: &'a Symbols, question: &'a Question) -> Self {
        Self {
            statements,
            symbols,
            question,
        }
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
        }
    }
}

impl Within<'_> {
    pub fn is_declared(&self, name: &Name) -> bool {
        self.locals.iter().any(|local| local.name == *name)
            || self.symbols.is_parameter(name)
            || self.symbols.abbreviation(name).is_some()
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
