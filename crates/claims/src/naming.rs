//! Names of what a statement is about: the kernel knows symbols, sequences and functions by their numbers.

use kernel::{Draft, Function, Piecewise, Quantity, Sequence, Statement, Symbol};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use texmath::{Invariant, Name, Symbols, subscript_of};

/// The most derivatives of a motion that may be states.
const MOST_DOTS: usize = 8;

/// The placeholder for an offset while the text of a member is made.
const OFFSET: &str = "\u{1}";

/// The name of a symbol, with the place where it belongs.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Named {
    Parameter(Name),
    /// The running time.
    Running,
    /// The time of an impact.
    Time {
        family: Name,
        index: i32,
    },
    /// A state just before an impact or just after it.
    State {
        state: Name,
        index: i32,
        after: bool,
    },
    /// A state at an index that is a number, as in `x_0`, while the index of the statement runs.
    Absolute {
        state: Name,
        index: i32,
    },
    /// The trace or determinant of a map of which no premise says anything.
    Invariant {
        kind: Invariant,
        of: Name,
    },
    /// A symbol that is defined beside an equation; the number tells such symbols of different equations apart.
    Local {
        name: Name,
        scope: usize,
    },
}

/// The names of one statement.
#[derive(Clone, Debug, Default)]
pub struct Names {
    symbols: BTreeMap<Symbol, Named>,
    numbers: HashMap<Named, Symbol>,
    functions: HashMap<Name, Function>,
    /// The name of each sequence of the statement, and of what kind its members are.
    sequences: Vec<(Name, Kind)>,
    /// The name of each motion of the statement, without dots.
    motions: Vec<Name>,
}

/// The kind of the members of a sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Time,
    Before,
    After,
}

impl Names {
    /// The names of times and states, and a statement about these.
    pub fn new(symbols: &Symbols, complex: bool) -> (Self, Draft) {
        let mut names = Self::default();
        for family in symbols.times() {
            names.sequences.push((family.clone(), Kind::Time));
        }
        for state in symbols.states() {
            names.sequences.push((state.clone(), Kind::Before));
            if !symbols.is_continuous(state) {
                names.sequences.push((state.clone(), Kind::After));
            }
        }
        let roots: BTreeSet<Name> = symbols.states().map(|state| undotted(state).0).collect();
        names.motions = roots.into_iter().collect();
        let sequences = names
            .sequences
            .iter()
            .map(|(name, kind)| sequence(name, *kind, symbols));
        let piecewise = names.motions.iter().map(|root| names.piecewise(root));
        let derivative = [r"\frac{\partial ", r"}{\partial ", "}"].map(str::to_owned);
        let draft = Draft::new(complex, sequences.collect(), piecewise.collect(), derivative);
        (names, draft)
    }

    /// The motion that is another function in each flight: the states that it and its derivatives are at the ends.
    fn piecewise(&self, root: &Name) -> Piecewise {
        let mut dotted = root.clone();
        let mut ends = Vec::new();
        for _ in 0..=MOST_DOTS {
            let after = self.state(&dotted, true);
            ends.push(after.and_then(|after| Some([after, self.state(&dotted, false)?])));
            dotted = dotted.dotted();
        }
        while ends.last() == Some(&None) {
            ends.pop();
        }
        Piecewise {
            text: root.to_string(),
            ends,
        }
    }

    /// The sequence of the times of impacts.
    pub fn time(&self, family: &Name) -> Option<usize> {
        self.sequence(family, Kind::Time)
    }

    /// The sequence of a state before impacts or after them: one and the same of a continuous state.
    pub fn state(&self, state: &Name, after: bool) -> Option<usize> {
        let after = self.sequence(state, Kind::After).filter(|_| after);
        after.or_else(|| self.sequence(state, Kind::Before))
    }

    fn sequence(&self, name: &Name, kind: Kind) -> Option<usize> {
        let mut sequences = self.sequences.iter();
        sequences.position(|(known, own)| known == name && *own == kind)
    }

    /// The number of a motion.
    pub fn motion(&self, root: &Name) -> Option<usize> {
        self.motions.iter().position(|known| known == root)
    }

    /// The name of a motion.
    pub fn motion_name(&self, motion: usize) -> Option<&Name> {
        self.motions.get(motion)
    }

    /// The symbol of a name, new where it is not known yet: of this quantity, with this text.
    pub fn symbol(&mut self, draft: &mut Draft, named: Named, quantity: Quantity, text: String) -> Symbol {
        let Self { symbols, numbers, .. } = self;
        *numbers.entry(named.clone()).or_insert_with(|| {
            let symbol = draft.symbol_of(quantity, text);
            symbols.insert(symbol, named);
            symbol
        })
    }

    /// The unknown function of a name, new where it is not known yet.
    pub fn function(&mut self, draft: &mut Draft, name: &Name) -> Function {
        let functions = self.functions.entry(name.clone());
        *functions.or_insert_with(|| draft.new_function(name.to_string()))
    }

    /// The name of a symbol of a statement or of an extension of it; none of derivatives and of symbols of the search.
    pub fn of(&self, statement: &Statement, symbol: Symbol) -> Option<Named> {
        match statement.quantity(symbol)? {
            Quantity::Running => Some(Named::Running),
            Quantity::Member {
                sequence,
                offset: index,
            } => {
                let (name, kind) = self.sequences.get(sequence)?.clone();
                Some(match kind {
                    Kind::Time => Named::Time { family: name, index },
                    Kind::Before | Kind::After => Named::State {
                        state: name,
                        index,
                        after: kind == Kind::After,
                    },
                })
            }
            _ => self.symbols.get(&symbol).cloned(),
        }
    }
}

/// The sequence of what a name stands for at the impacts.
fn sequence(name: &Name, kind: Kind, symbols: &Symbols) -> Sequence {
    let text = |subscript: String| {
        let mut name = name.clone();
        name.subscript = subscript;
        name.mark = if kind == Kind::After { "+".into() } else { String::new() };
        name.to_string()
    };
    let moved = text(format!("{}{OFFSET}", symbols.index));
    let (before, after) = moved.split_once(OFFSET).unwrap_or((&moved, ""));
    let is_complex = symbols.states().any(|state| {
        state.without_dots() == name.without_dots() && symbols.complex().any(|complex| complex.bare() == *state)
    });
    Sequence {
        text: [
            text(subscript_of(0, &symbols.index)),
            before.to_owned(),
            after.to_owned(),
        ],
        has_instants: kind == Kind::Time,
        is_complex: kind != Kind::Time && is_complex,
    }
}

/// A state without its dots, and their number.
pub fn undotted(state: &Name) -> (Name, u32) {
    let mut root = state.clone();
    let dots = match root.accents.last().map(String::as_str) {
        Some(r"\dot") => 1,
        Some(r"\ddot") => 2,
        Some(r"\dddot") => 3,
        _ => 0,
    };
    if dots > 0 {
        root.accents.pop();
    }
    (root, dots)
}

/// Returns true if a name is this letter, without marks.
pub fn is_letter(name: &Name, letter: &str) -> bool {
    *name
        == Name {
            base: letter.to_string(),
            ..Name::default()
        }
}
