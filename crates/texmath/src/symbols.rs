//! What names stand for.

use super::nodes::{names_in, speaks_of};
use super::{Equation, Name, Names, Tree};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::mem::{Discriminant, discriminant};

/// A matrix of partial derivatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Map {
    /// The derivatives of these quantities by those, along whatever the premises say.
    Premises { of: Vec<Tree>, by: Vec<Tree> },
    /// The Jacobian of explicit equations.
    Equations(Vec<Equation>),
    /// A product of other maps, the last applied first.
    Product(Vec<Name>),
}

/// One thing that is declared of a name: what it stands for, or which values it has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// It has one value throughout, real unless it is [`Complex`](Meaning::Complex).
    Parameter,
    /// It is a letter that runs over all integers: a premise holds for each value of it. An index that is none of these has
    /// one value throughout.
    Index,
    /// It is a family of times, without index; the first family is that of the impacts.
    Time,
    /// It is a state, without index.
    State,
    /// An impact does not change this state.
    Continuous,
    /// It is a function of time, with its derivative where it has one.
    Function(Option<Tree>),
    /// The function or state has this period.
    Period(Tree),
    /// It stands for an expression.
    Abbreviation(Tree),
    /// It is a Jacobian.
    Map(Map),
    /// It may be taken to avoid sets that are thin in it alone.
    Generic,
    Positive,
    /// It does not exceed 1; it is [`Positive`](Meaning::Positive) too.
    AtMostOne,
    Nonnegative,
    Nonzero,
    Integer,
    Complex,
}

/// The table of what each name stands for that needs no premise.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Symbols {
    /// The declarations, in order.
    declared: Vec<(Name, Meaning)>,
    /// The places of each name in `declared`, and of each kind of meaning.
    of_name: HashMap<Name, Vec<usize>>,
    of_kind: HashMap<Discriminant<Meaning>, Vec<usize>>,
    /// The letter that numbers impacts: `k`.
    pub index: String,
    /// Squares of symbols: `s^2 = ...`.
    pub relations: Vec<Equation>,
    /// Squares of what runs over times or indices, which hold throughout: a premise of every claim.
    pub laws: Vec<Equation>,
    /// The names as the reader of formulas needs them.
    pub names: Names,
}

/// Returns the impact number of a subscript such as `k+1`, for the index letter `k`.
pub fn index_of(subscript: &str, letter: &str) -> Option<i32> {
    let rest = subscript.strip_prefix(letter)?;
    if rest.is_empty() {
        return (!letter.is_empty()).then_some(0);
    }
    if !rest.starts_with(['+', '-']) {
        return None;
    }
    rest.parse().ok()
}

/// Returns the positive multiple of the index and the number that a subscript adds to it: 2 and 1 for `2n+1`.
pub fn place_of(subscript: &str, letter: &str) -> Option<(i64, i64)> {
    let is_digit = |character: char| character.is_ascii_digit();
    let digits = subscript.len() - subscript.trim_start_matches(is_digit).len();
    let (multiple, rest) = subscript.split_at_checked(digits)?;
    let offset = index_of(rest, letter)?;
    let multiple = match multiple {
        "" => 1,
        // `1n` and `02n` are two indices
        multiple if multiple.starts_with('0') || multiple == "1" => return None,
        multiple => multiple.parse().ok()?,
    };
    Some((multiple, i64::from(offset)))
}

/// Returns the subscript of a multiple of the index and a number.
pub fn place(multiple: i64, offset: i64, letter: &str) -> String {
    let running = match multiple {
        1 => letter.to_owned(),
        multiple => format!("{multiple}{letter}"),
    };
    match offset {
        0 => running,
        offset => format!("{running}{offset:+}"),
    }
}

/// Returns the subscript of impact number `index`.
pub fn subscript_of(index: i32, letter: &str) -> String {
    if index == 0 {
        letter.to_string()
    } else {
        format!("{letter}{index:+}")
    }
}

/// Returns the symbol `\lambda` of a pair such as `\lambda_{1,2}`.
pub fn pair_of(name: &Name) -> Option<Name> {
    (name.subscript == "1,2" || name.subscript == r"\pm").then(|| Name {
        subscript: String::new(),
        ..name.clone()
    })
}

/// Returns true if a name stands for a number that everybody knows: `\pi`, `e`, `i`.
pub fn is_constant(name: &Name) -> bool {
    matches!(name.base.as_str(), r"\pi" | "e" | "i") && *name == base_alone(name)
}

/// Returns the name with nothing but its letter or command.
pub fn base_alone(name: &Name) -> Name {
    Name {
        base: name.base.clone(),
        ..Name::default()
    }
}

/// Two methods for each meaning without more to it: the names that have it, in order of declaration, and whether one has it.
macro_rules! meanings {
    ($($(#[$all:meta])* $names:ident, $(#[$one:meta])* $is:ident: $meaning:ident;)*) => {$(
        $(#[$all])*
        pub fn $names(&self) -> impl Iterator<Item = &Name> + Clone {
            self.all(&Meaning::$meaning)
        }

        $(#[$one])*
        pub fn $is(&self, name: &Name) -> bool {
            self.is(name, &Meaning::$meaning)
        }
    )*};
}

impl Symbols {
    meanings! {
        /// Iterates over the symbols with one value throughout.
        parameters,
        /// Returns true if a symbol has one value throughout.
        is_parameter: Parameter;
        /// Iterates over the letters that run over all integers.
        indices,
        /// Returns true if a letter runs over all integers.
        is_index: Index;
        /// Iterates over the families of times, without index.
        times,
        /// Returns true if a name without index is a family of times.
        is_time: Time;
        /// Iterates over the states, without index.
        states,
        /// Returns true if a name without index is a state.
        is_state: State;
        /// Iterates over the states that an impact does not change.
        continuous,
        /// Returns true if an impact does not change the state of this name without index.
        is_continuous: Continuous;
        /// Iterates over the symbols that may be taken to avoid sets that are thin in them alone.
        generic,
        /// Returns true if a symbol may be taken to avoid sets that are thin in it alone.
        is_generic: Generic;
        /// Iterates over the symbols that are positive, those that do not exceed 1 among them.
        positive,
        /// Returns true if a symbol is positive.
        is_positive: Positive;
        /// Iterates over the positive symbols that do not exceed 1.
        at_most_one,
        /// Returns true if a symbol is positive and does not exceed 1.
        is_at_most_one: AtMostOne;
        /// Iterates over the symbols that are not negative.
        nonnegative,
        /// Returns true if a symbol is not negative.
        is_nonnegative: Nonnegative;
        /// Iterates over the symbols that are not 0.
        nonzero,
        /// Returns true if a symbol is not 0.
        is_nonzero: Nonzero;
        /// Iterates over the symbols that are integers.
        integers,
        /// Returns true if a symbol is an integer.
        is_integer: Integer;
        /// Iterates over the symbols that are complex.
        complex,
        /// Returns true if a symbol is complex.
        is_complex: Complex;
    }

    /// Makes a table in which nothing is declared.
    pub fn new(names: Names) -> Self {
        Self {
            names,
            ..Self::default()
        }
    }

    /// Declares one thing more of a name.
    pub fn declare(&mut self, name: Name, meaning: Meaning) {
        let place = self.declared.len();
        self.of_name.entry(name.clone()).or_default().push(place);
        self.of_kind.entry(discriminant(&meaning)).or_default().push(place);
        self.declared.push((name, meaning));
    }

    /// Returns all that is declared, in order.
    pub fn declarations(&self) -> &[(Name, Meaning)] {
        &self.declared
    }

    /// Keeps what passes the test of all that is declared.
    pub fn retain(&mut self, test: impl Fn(&Name, &Meaning) -> bool) {
        self.of_name.clear();
        self.of_kind.clear();
        for (name, meaning) in std::mem::take(&mut self.declared) {
            if test(&name, &meaning) {
                self.declare(name, meaning);
            }
        }
    }

    /// Iterates over the names of which something of this kind is declared, in order of declaration.
    pub fn all(&self, kind: &Meaning) -> impl Iterator<Item = &Name> + Clone {
        self.of_kind(kind).map(|(name, _)| name)
    }

    fn of_kind(&self, kind: &Meaning) -> impl Iterator<Item = &(Name, Meaning)> + Clone {
        let places = self.of_kind.get(&discriminant(kind)).into_iter().flatten();
        places.filter_map(|place| self.declared.get(*place))
    }

    /// Returns true if exactly this is declared of a name.
    pub fn is(&self, name: &Name, meaning: &Meaning) -> bool {
        self.meanings(name).any(|own| own == meaning)
    }

    /// Iterates over all that is declared of a name.
    fn meanings(&self, name: &Name) -> impl Iterator<Item = &Meaning> {
        let places = self.of_name.get(name).into_iter().flatten();
        places
            .filter_map(|place| self.declared.get(*place))
            .map(|(_, meaning)| meaning)
    }

    /// The running time of a flight.
    pub fn running(&self) -> Option<&Name> {
        self.names.running.as_ref()
    }

    /// Iterates over the functions of time, each with its derivative where it has one.
    pub fn functions(&self) -> impl Iterator<Item = (&Name, Option<&Tree>)> + Clone {
        self.of_kind(&Meaning::Function(None))
            .filter_map(|(name, meaning)| match meaning {
                Meaning::Function(derivative) => Some((name, derivative.as_ref())),
                _ => None,
            })
    }

    /// Iterates over functions and states with their periods.
    pub fn periods(&self) -> impl Iterator<Item = (&Name, &Tree)> + Clone {
        self.declared.iter().filter_map(|(name, meaning)| match meaning {
            Meaning::Period(period) => Some((name, period)),
            _ => None,
        })
    }

    /// Iterates over the symbols that stand for an expression.
    pub fn abbreviations(&self) -> impl Iterator<Item = (&Name, &Tree)> + Clone {
        self.declared.iter().filter_map(|(name, meaning)| match meaning {
            Meaning::Abbreviation(tree) => Some((name, tree)),
            _ => None,
        })
    }

    /// Returns the expression that a symbol stands for.
    pub fn abbreviation(&self, name: &Name) -> Option<&Tree> {
        self.meanings(name).find_map(|meaning| match meaning {
            Meaning::Abbreviation(tree) => Some(tree),
            _ => None,
        })
    }

    /// Iterates over the Jacobians.
    pub fn maps(&self) -> impl Iterator<Item = (&Name, &Map)> + Clone {
        self.declared.iter().filter_map(|(name, meaning)| match meaning {
            Meaning::Map(map) => Some((name, map)),
            _ => None,
        })
    }

    /// Returns the Jacobian of this name.
    pub fn map(&self, name: &Name) -> Option<&Map> {
        self.meanings(name).find_map(|meaning| match meaning {
            Meaning::Map(map) => Some(map),
            _ => None,
        })
    }

    /// Returns true if this is the letter that numbers impacts.
    pub fn is_index_letter(&self, name: &Name) -> bool {
        name.to_string() == self.index
    }

    /// Returns true if a name stands for one value throughout, for an expression, or for an index.
    pub fn is_single(&self, name: &Name) -> bool {
        let is_single = |own: &Meaning| matches!(own, Meaning::Parameter | Meaning::Index | Meaning::Abbreviation(_));
        self.meanings(name).any(is_single)
    }

    /// Returns true if this is a declared function, or a derivative of one by primes.
    pub fn is_function(&self, name: &Name) -> bool {
        let plain = Name {
            primes: 0,
            ..name.clone()
        };
        self.meanings(&plain).any(|own| matches!(own, Meaning::Function(_)))
    }

    /// Returns the integer that a parameter carries as its index, where it does: it has one value, and would not move with it.
    pub fn index_in(&self, name: &Name) -> Option<&Name> {
        let is_index = |letter: &&Name| index_of(&name.subscript, &letter.base).is_some();
        self.integers().find(is_index).filter(|_| self.is_parameter(name))
    }

    /// Declares one more parameter, real or positive.
    pub fn let_be_parameter(&mut self, name: &Name, is_positive: bool) {
        self.declare(name.clone(), Meaning::Parameter);
        if is_positive {
            self.declare(name.clone(), Meaning::Positive);
        }
    }

    /// Returns the table with each complex symbol replaced by its real and its imaginary part.
    pub fn with_parts(&self, parts: &BTreeMap<Name, [Name; 2]>) -> Self {
        let mut real = self.clone();
        let of_whole = |meaning: &Meaning| matches!(meaning, Meaning::Parameter | Meaning::Nonzero | Meaning::Complex);
        real.retain(|name, meaning| !(parts.contains_key(name) && of_whole(meaning)));
        for part in parts.values().flatten() {
            real.let_be_parameter(part, false);
        }
        real
    }

    /// Iterates over the expressions that are declared, each with what it is declared of.
    fn declared_trees(&self) -> impl Iterator<Item = (&Name, &Tree)> {
        let derivatives = self
            .functions()
            .filter_map(|(name, derivative)| Some((name, derivative?)));
        let of_maps = self.maps().flat_map(|(name, map)| match map {
            Map::Equations(equations) => sides_of(name, equations),
            _ => Vec::new(),
        });
        let pairs = self.abbreviations().chain(self.periods());
        pairs.chain(derivatives).chain(of_maps)
    }

    /// Returns the expressions that are declared of names, and of what these expressions speak of in turn.
    pub fn declared_of(&self, mut names: BTreeSet<Name>) -> Vec<&Tree> {
        let mut others: Vec<(BTreeSet<Name>, Vec<&Tree>)> = Vec::new();
        for (name, tree) in self.declared_trees() {
            others.push((BTreeSet::from([name.clone()]), vec![tree]));
        }
        for equation in self.relations.iter().chain(&self.laws) {
            let mut left = BTreeSet::new();
            names_in(&equation.left, &mut left);
            others.push((left, vec![&equation.left, &equation.right]));
        }
        let mut found = Vec::new();
        loop {
            let (met, rest): (Vec<_>, Vec<_>) = others.into_iter().partition(|(own, _)| !own.is_disjoint(&names));
            if met.is_empty() {
                return found;
            }
            for tree in met.into_iter().flat_map(|(_, trees)| trees) {
                names_in(tree, &mut names);
                found.push(tree);
            }
            others = rest;
        }
    }

    /// Puts another expression in the place of each that is declared.
    pub fn reread(&mut self, new: &mut dyn FnMut(&mut Tree)) {
        for (_, meaning) in &mut self.declared {
            match meaning {
                Meaning::Function(Some(tree)) | Meaning::Period(tree) | Meaning::Abbreviation(tree) => new(tree),
                Meaning::Map(Map::Equations(equations)) => equations.iter_mut().for_each(|equation| {
                    new(&mut equation.left);
                    new(&mut equation.right);
                }),
                _ => {}
            }
        }
        for equation in self.relations.iter_mut().chain(&mut self.laws) {
            new(&mut equation.left);
            new(&mut equation.right);
        }
    }

    /// Returns true if anything that is declared speaks of a name.
    pub fn uses(&self, name: &Name) -> bool {
        let equations = self.relations.iter().chain(&self.laws);
        let sides = equations.flat_map(|equation| [&equation.left, &equation.right]);
        let trees = self.declared_trees().map(|(_, tree)| tree);
        trees.chain(sides).any(|tree| speaks_of(tree, name))
    }
}

/// Returns the sides of equations, each with a name.
fn sides_of<'e>(name: &'e Name, equations: &'e [Equation]) -> Vec<(&'e Name, &'e Tree)> {
    let sides = equations.iter().flat_map(|equation| [&equation.left, &equation.right]);
    sides.map(|side| (name, side)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_subscript_gives_its_impact_and_back() {
        for index in [-2, -1, 0, 1, 2] {
            assert_eq!(index_of(&subscript_of(index, "k"), "k"), Some(index));
        }
        assert_eq!(index_of("B", "k"), None);
        assert_eq!(index_of("k1", "k"), None);
    }
}
