//! What the names of a sheet stand for: its `[symbols]`.

use super::fault::Fault;
use super::nodes::speaks_of;
use super::size::Sizes;
use super::symbols::{MapEntry, Symbols};
use crate::tex::{At, Equation, Name, Names, Relation, Tree, read, read_expression};
use std::collections::{BTreeMap, HashMap, HashSet};

/// A matrix of partial derivatives.
#[derive(Clone, Debug)]
pub enum Map {
    /// The derivatives of these quantities by those, along whatever the premises say.
    Premises { of: Vec<Tree>, by: Vec<Tree> },
    /// The Jacobian of explicit equations.
    Equations(Vec<Equation>),
    /// A product of other maps, the last applied first.
    Product(Vec<Name>),
}

/// The meaning of every name that needs no premise.
#[derive(Clone, Debug, Default)]
pub struct Vocabulary {
    /// Symbols with one value throughout, real unless they are listed in `complex`.
    pub parameters: Vec<Name>,
    /// Symbols that may be taken to avoid sets that are thin in them alone.
    pub generic: Vec<Name>,
    /// Symbols that are positive, and those among them that do not exceed 1.
    pub positive: Vec<Name>,
    pub at_most_one: Vec<Name>,
    /// Symbols that are not negative, that are not 0, that are integers, that are complex.
    pub nonnegative: Vec<Name>,
    pub nonzero: Vec<Name>,
    pub integers: Vec<Name>,
    pub complex: Vec<Name>,
    /// The letter that numbers impacts: `k`.
    pub index: String,
    /// Letters that run over all integers: a premise holds for each value of these. An index that is not among them
    /// has one value throughout.
    pub indices: Vec<Name>,
    /// Families of times, without index; the first is that of the impacts.
    pub times: Vec<Name>,
    /// The running time of a flight.
    pub running: Option<Name>,
    /// States, without index.
    pub states: Vec<Name>,
    /// The states that an impact does not change.
    pub continuous: Vec<Name>,
    /// Functions of time, each with its derivative where it has one.
    pub functions: Vec<(Name, Option<Tree>)>,
    /// Functions or states with their period.
    pub periods: Vec<(Name, Tree)>,
    /// Symbols that stand for an expression.
    pub abbreviations: Vec<(Name, Tree)>,
    /// Squares of symbols: `s^2 = ...`.
    pub relations: Vec<Equation>,
    /// Squares of what runs over times or indices, which hold throughout: a premise of every claim.
    pub laws: Vec<Equation>,
    /// Jacobians by name.
    pub maps: Vec<(Name, Map)>,
    /// What the reader of formulas needs to know of all this.
    pub names: Names,
    /// Parameters, abbreviations and indices.
    singles: HashSet<Name>,
}

/// The impact number of a subscript such as `k+1`, for the index letter `k`.
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

/// The subscript of impact number `index`.
pub fn subscript_of(index: i32, letter: &str) -> String {
    if index == 0 {
        letter.to_string()
    } else {
        format!("{letter}{index:+}")
    }
}

impl Vocabulary {
    /// The sizes of formulas with these definitions and all abbreviations put in.
    pub(super) fn sizes<'a>(&'a self, definitions: impl Iterator<Item = (&'a Name, &'a Tree)>) -> Sizes<'a> {
        let abbreviations = self.abbreviations.iter().map(|(name, tree)| (name, tree));
        Sizes::new(definitions.chain(abbreviations))
    }

    /// Reads a `[symbols]` block.
    ///
    /// # Errors
    /// A [`Fault`] that quotes the entry that cannot be read.
    pub fn read(symbols: &Symbols) -> Result<Self, Fault> {
        let mut vocabulary = Self {
            names: first_names(symbols)?,
            ..Self::default()
        };
        vocabulary.parameters = vocabulary.list(&symbols.parameters)?;
        vocabulary.indices = vocabulary.list(&symbols.indices)?;
        vocabulary.states = vocabulary.list(&symbols.states)?;
        vocabulary.let_indices_run();
        vocabulary.continuous = vocabulary.list(&symbols.continuous)?;
        vocabulary.read_times(symbols)?;
        let as_states = |names: &[Name]| names.iter().map(Name::bare).collect::<Vec<_>>();
        vocabulary.states = as_states(&vocabulary.states);
        vocabulary.states.dedup();
        vocabulary.continuous = as_states(&vocabulary.continuous);
        vocabulary.read_functions(symbols)?;
        for (name, period) in symbols.periods.pairs()? {
            vocabulary
                .periods
                .push((vocabulary.name(&name)?, vocabulary.expression(&period)?));
        }
        for (name, meaning) in symbols.abbreviations.pairs()? {
            vocabulary
                .abbreviations
                .push((vocabulary.name(&name)?, vocabulary.expression(&meaning)?));
        }
        for (square, value) in symbols.relations.pairs()? {
            vocabulary
                .relations
                .extend(vocabulary.equations(&format!("{square} = {value}"))?);
        }
        vocabulary.generic = vocabulary.list(&symbols.generic)?;
        vocabulary.read_kinds(symbols)?;
        let relations = std::mem::take(&mut vocabulary.relations).into_iter();
        (vocabulary.laws, vocabulary.relations) = relations.partition(|relation| vocabulary.moves(relation));
        vocabulary.read_maps(symbols)?;
        vocabulary.refuse_twice()?;
        let abbreviations = vocabulary.abbreviations.iter().map(|(name, _)| name);
        let singles = vocabulary
            .parameters
            .iter()
            .chain(abbreviations)
            .chain(&vocabulary.indices);
        vocabulary.singles = singles.cloned().collect();
        Ok(vocabulary)
    }

    /// What an index counts runs with it as a state does, in whichever list it stands.
    fn let_indices_run(&mut self) {
        let counts = |name: &Name| {
            let is_counted = |letter: &Name| index_of(&name.subscript, &letter.base).is_some();
            self.indices.iter().any(is_counted)
        };
        let (running, single) = self.parameters.drain(..).partition(counts);
        self.parameters = single;
        let running: Vec<Name> = running;
        for name in running.iter().map(Name::bare) {
            if !self.states.contains(&name) {
                self.states.push(name);
            }
        }
    }

    /// The lists that say of which kind a symbol is.
    fn read_kinds(&mut self, symbols: &Symbols) -> Result<(), Fault> {
        let kinds = symbols.kinds().map(|texts| self.list(texts));
        let [nonnegative, nonzero, integers, complex, at_most_one, positive] = kinds;
        (self.nonnegative, self.nonzero) = (nonnegative?, nonzero?);
        (self.integers, self.complex) = (integers?, complex?);
        (self.at_most_one, self.positive) = (at_most_one?, positive?);
        self.positive.extend(self.at_most_one.iter().cloned());
        self.names.complex.clone_from(&self.complex);
        let real: HashSet<&Name> = self
            .positive
            .iter()
            .chain(&self.nonnegative)
            .chain(&self.integers)
            .collect();
        if let Some(name) = self.complex.iter().find(|name| real.contains(name)) {
            let problem = "is in `complex` and in a list of real symbols";
            return Err(Fault::new(format!("`{name}` {problem}")));
        }
        let mut known: HashSet<Name> = self.parameters.iter().cloned().collect();
        known.extend(self.abbreviations.iter().map(|(name, _)| name.clone()));
        known.extend(self.functions.iter().map(|(name, _)| name.clone()));
        known.extend(self.running.clone());
        let kinds = [
            &self.positive,
            &self.nonnegative,
            &self.nonzero,
            &self.integers,
            &self.complex,
        ];
        let new: Vec<Name> = kinds
            .into_iter()
            .flatten()
            .filter(|name| !self.is_indexed(name) && known.insert((*name).clone()))
            .cloned()
            .collect();
        self.parameters.extend(new);
        self.let_indices_run();
        Ok(())
    }

    /// The integer that a parameter carries as its index, where it does: it has one value, and would not move with it.
    pub(super) fn index_in(&self, name: &Name) -> Option<&Name> {
        let is_index = |letter: &&Name| index_of(&name.subscript, &letter.base).is_some();
        let is_parameter = self.parameters.contains(name);
        self.integers.iter().find(is_index).filter(|_| is_parameter)
    }

    fn read_times(&mut self, symbols: &Symbols) -> Result<(), Fault> {
        for name in self.list(&symbols.times)? {
            // One letter with perhaps an offset numbers the impacts.
            let letter: String = name.subscript.chars().take_while(char::is_ascii_lowercase).collect();
            if name.subscript.is_empty() {
                self.names.running = Some(name.clone());
                self.running = Some(name);
            } else if letter.chars().count() == 1 && index_of(&name.subscript, &letter).is_some() {
                if self.index.is_empty() {
                    self.index = letter;
                }
                if !self.times.contains(&name.bare()) {
                    self.times.push(name.bare());
                }
            } else {
                let problem = format!("the subscript of the time `{name}` must be an index such as k or k+1");
                return Err(Fault::new(problem));
            }
        }
        if self.index.is_empty() {
            let of_states = self.states.iter().find_map(|name| name.subscript.chars().next());
            let running = self.indices.first().map(|name| name.base.clone());
            self.index = of_states.map(String::from).or(running).unwrap_or("k".to_string());
        }
        Ok(())
    }

    fn read_functions(&mut self, symbols: &Symbols) -> Result<(), Fault> {
        let pairs = symbols.functions.pairs()?;
        let functions = pairs
            .iter()
            .map(|(name, _)| self.name(name))
            .collect::<Result<Vec<_>, _>>()?;
        self.names.functions = functions.clone();
        for state in &self.states {
            // The motion law is a formula for the derivative of the last state.
            self.names
                .functions
                .extend([state.clone(), state.dotted(), state.dotted().dotted()]);
        }
        let mut slopes = Vec::new();
        for (_, derivative) in &pairs {
            slopes.push(match derivative.trim() {
                "" => None,
                tex => Some(self.expression(tex)?),
            });
        }
        for (at, name) in functions.into_iter().enumerate() {
            // who writes f as the derivative of F gives derivatives names of his own
            let is_slope = slopes.iter().flatten().any(|slope| speaks_of(slope, &name));
            match slopes[at].clone() {
                None if !is_slope => self.declare_with_dots(name),
                slope => self.functions.push((name, slope)),
            }
        }
        Ok(())
    }

    /// A function whose derivative has no name of its own: of time it has dots, where nothing else is called so.
    fn declare_with_dots(&mut self, name: Name) {
        let (dot, dots) = (name.dotted(), name.dotted().dotted());
        let is_taken = |other: &Name| self.names.functions.contains(other) || self.parameters.contains(other);
        let is_dotted = name.accents.iter().any(|accent| accent.ends_with("dot"));
        if self.running.is_none() || name.primes > 0 || is_dotted || is_taken(&dot) || is_taken(&dots) {
            self.functions.push((name, None));
            return;
        }
        self.names.functions.extend([dot.clone(), dots.clone()]);
        let named = |name: &Name| Some(Tree::Symbol(name.clone(), At::default()));
        self.functions.push((name, named(&dot)));
        self.functions.push((dot, named(&dots)));
        self.functions.push((dots, None));
    }

    fn read_maps(&mut self, symbols: &Symbols) -> Result<(), Fault> {
        let names = symbols
            .maps
            .keys()
            .map(|name| self.name(name))
            .collect::<Result<Vec<_>, _>>()?;
        self.names.matrices = names.clone();
        for (name, entry) in names.into_iter().zip(symbols.maps.values()) {
            let map = match entry {
                MapEntry::Of { of, by } => Map::Premises {
                    of: of.iter().map(|tex| self.expression(tex)).collect::<Result<_, _>>()?,
                    by: by.iter().map(|tex| self.expression(tex)).collect::<Result<_, _>>()?,
                },
                MapEntry::List(list) if list.iter().any(|tex| tex.contains('=')) => {
                    let equations = list
                        .iter()
                        .map(|tex| self.equations(tex))
                        .collect::<Result<Vec<_>, _>>()?;
                    Map::Equations(equations.concat())
                }
                MapEntry::List(list) => self.product(&list.join(" "))?,
                MapEntry::Product(product) => self.product(product)?,
            };
            self.maps.push((name, map));
        }
        Ok(())
    }

    fn product(&self, text: &str) -> Result<Map, Fault> {
        let factors = text.split_whitespace().filter(|word| *word != r"\cdot");
        let factors = factors.map(|word| {
            let name = self.name(word)?;
            if self.names.matrices.contains(&name) {
                return Ok(name);
            }
            Err(Fault::new(format!(
                "`{word}` is no map: name maps, or write equations with `=`"
            )))
        });
        Ok(Map::Product(factors.collect::<Result<_, _>>()?))
    }

    /// A name with two meanings has none.
    fn refuse_twice(&self) -> Result<(), Fault> {
        let functions: Vec<&Name> = self.functions.iter().map(|(name, _)| name).collect();
        let abbreviations: Vec<&Name> = self.abbreviations.iter().map(|(name, _)| name).collect();
        let lists: [(&str, Vec<&Name>); 6] = [
            ("parameters", self.parameters.iter().collect()),
            ("indices", self.indices.iter().collect()),
            ("functions", functions),
            ("abbreviations", abbreviations),
            ("states", self.states.iter().collect()),
            ("times", self.running.iter().collect()),
        ];
        let mut seen: HashMap<&Name, &str> = HashMap::new();
        for (list, names) in lists {
            for name in names {
                let place = match seen.insert(name, list) {
                    None => continue,
                    Some(known) if known == list => format!("twice in `{list}`"),
                    Some(known) => format!("in `{known}` and in `{list}`"),
                };
                let problem = format!("`{name}` is declared twice, {place}: leave one of them out");
                return Err(Fault::new(problem));
            }
        }
        Ok(())
    }

    /// Declares one more parameter, real or positive.
    pub(super) fn let_be_parameter(&mut self, name: &Name, is_positive: bool) {
        self.parameters.push(name.clone());
        self.singles.insert(name.clone());
        if is_positive {
            self.positive.push(name.clone());
        }
    }

    /// The vocabulary with each complex symbol replaced by its real and its imaginary part.
    pub(super) fn with_parts(&self, parts: &BTreeMap<Name, [Name; 2]>) -> Self {
        let mut real = self.clone();
        let Self {
            parameters,
            nonzero,
            complex,
            ..
        } = &mut real;
        for list in [parameters, nonzero, complex] {
            list.retain(|name| !parts.contains_key(name));
        }
        real.singles.retain(|name| !parts.contains_key(name));
        for part in parts.values().flatten() {
            real.let_be_parameter(part, false);
        }
        real
    }

    fn list(&self, texts: &[String]) -> Result<Vec<Name>, Fault> {
        texts.iter().map(|text| self.name(text)).collect()
    }

    /// Reads one name.
    pub(super) fn name(&self, text: &str) -> Result<Name, Fault> {
        read_name(text, &self.names)
    }

    fn expression(&self, tex: &str) -> Result<Tree, Fault> {
        read_expression(tex, &self.names).map_err(|error| Fault::new(format!("`{tex}`: {error}")))
    }

    fn equations(&self, tex: &str) -> Result<Vec<Equation>, Fault> {
        let equations = read(tex, &self.names).map_err(|error| Fault::new(format!("`{tex}`: {error}")))?;
        match equations.iter().all(|equation| equation.relation == Relation::Equal) {
            true => Ok(equations),
            false => Err(Fault::new(format!("`{tex}`: an equation must stand here"))),
        }
    }

    /// Whether anything that `[symbols]` says speaks of a name.
    pub(super) fn uses(&self, name: &Name) -> bool {
        let pairs = self.abbreviations.iter().chain(&self.periods).map(|(_, tree)| tree);
        let derivatives = self.functions.iter().filter_map(|(_, derivative)| derivative.as_ref());
        let of_maps = self.maps.iter().flat_map(|(_, map)| match map {
            Map::Equations(equations) => equations.as_slice(),
            _ => &[],
        });
        let equations = self.relations.iter().chain(&self.laws).chain(of_maps);
        let sides = equations.flat_map(|equation| [&equation.left, &equation.right]);
        pairs.chain(derivatives).chain(sides).any(|tree| speaks_of(tree, name))
    }

    /// Whether a name stands for one value throughout, for an expression, or for an index.
    pub(super) fn is_single(&self, name: &Name) -> bool {
        self.singles.contains(name)
    }
}

fn read_name(text: &str, names: &Names) -> Result<Name, Fault> {
    match read_expression(text, names) {
        Ok(Tree::Symbol(name, At(_))) => Ok(name),
        Ok(_) => Err(Fault::new(format!("`{text}` is not one name"))),
        Err(error) => Err(Fault::new(format!("`{text}` is not a name: {error}"))),
    }
}

/// The words of several letters among the declared names, so that these can be read at all.
fn first_names(symbols: &Symbols) -> Result<Names, Fault> {
    let pairs = [&symbols.functions, &symbols.periods, &symbols.abbreviations];
    let mut texts: Vec<String> = Vec::new();
    for pair in pairs {
        texts.extend(pair.pairs()?.into_iter().map(|(name, _)| name));
    }
    let kinds = symbols.kinds().into_iter().flatten().chain(&symbols.indices);
    let plain = symbols.parameters.iter().chain(&symbols.times).chain(&symbols.states);
    texts.extend(plain.chain(kinds).cloned());
    texts.extend(symbols.maps.keys().cloned());
    let word = |text: &String| -> String { text.trim().chars().take_while(char::is_ascii_alphabetic).collect() };
    let words = texts.iter().map(word).filter(|word| word.len() > 1).collect();
    let letter = |text: &String| -> Option<String> {
        let text = text.trim();
        (text.len() == 1).then(|| text.to_owned())
    };
    Ok(Names {
        letters: texts.iter().filter_map(letter).collect(),
        words,
        ..Names::default()
    })
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

    #[test]
    fn the_running_time_is_no_parameter() {
        let symbols = Symbols {
            parameters: vec!["a".to_string(), "t".to_string()],
            times: vec!["t".to_string(), "t_k".to_string()],
            ..Symbols::default()
        };
        let fault = Vocabulary::read(&symbols).unwrap_err();
        assert_eq!(
            fault.to_string(),
            "`t` is declared twice, in `parameters` and in `times`: leave one of them out"
        );
    }
}
