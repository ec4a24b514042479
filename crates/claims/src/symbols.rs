//! `[symbols]` as it stands in a sheet, and the table that it fills.

use super::fault::Fault;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use texmath::{
    At, DoubtKind, Equation, Map, Meaning, Name, Names, Opaque, Relation, Symbols, Tree, index_of, read,
    read_expression, speaks_of,
};

/// `[symbols]` as it stands in the file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RawSymbols {
    pub parameters: Vec<String>,
    pub generic: Vec<String>,
    pub positive: Vec<String>,
    pub at_most_one: Vec<String>,
    pub nonnegative: Vec<String>,
    pub nonzero: Vec<String>,
    pub integers: Vec<String>,
    pub complex: Vec<String>,
    pub indices: Vec<String>,
    pub times: Vec<String>,
    pub states: Vec<String>,
    pub continuous: Vec<String>,
    pub functions: Pairs,
    pub periods: Pairs,
    pub abbreviations: Pairs,
    pub relations: Pairs,
    pub maps: BTreeMap<String, MapEntry>,
    /// True if a document uses no others; else what it does not declare is guessed.
    #[serde(skip)]
    pub only: bool,
    /// The exceptions where a term that is not understood is a symbol; none where it is an error.
    pub opaque: Option<RawOpaque>,
}

impl RawSymbols {
    /// These and more.
    ///
    /// # Errors
    /// A [`Fault`] where a pair has more than one `=`.
    pub(super) fn and(self, more: Self) -> Result<Self, Fault> {
        let list = |one: Vec<String>, other: Vec<String>| [one, other].concat();
        let pairs = |one: Pairs, other: Pairs| -> Result<Pairs, Fault> {
            let all = [one.pairs()?, other.pairs()?].concat().into_iter();
            Ok(Pairs::List(
                all.map(|(left, right)| format!("{left} = {right}")).collect(),
            ))
        };
        Ok(Self {
            parameters: list(self.parameters, more.parameters),
            generic: list(self.generic, more.generic),
            positive: list(self.positive, more.positive),
            at_most_one: list(self.at_most_one, more.at_most_one),
            nonnegative: list(self.nonnegative, more.nonnegative),
            nonzero: list(self.nonzero, more.nonzero),
            integers: list(self.integers, more.integers),
            complex: list(self.complex, more.complex),
            indices: list(self.indices, more.indices),
            times: list(self.times, more.times),
            states: list(self.states, more.states),
            continuous: list(self.continuous, more.continuous),
            functions: pairs(self.functions, more.functions)?,
            periods: pairs(self.periods, more.periods)?,
            abbreviations: pairs(self.abbreviations, more.abbreviations)?,
            relations: pairs(self.relations, more.relations)?,
            maps: self.maps.into_iter().chain(more.maps).collect(),
            only: self.only || more.only,
            opaque: self.opaque.or(more.opaque),
        })
    }

    /// The lists of kinds: what stands in one of these need not stand among the parameters too.
    fn kinds(&self) -> [(&[String], Meaning); 6] {
        [
            (&self.nonnegative, Meaning::Nonnegative),
            (&self.nonzero, Meaning::Nonzero),
            (&self.integers, Meaning::Integer),
            (&self.complex, Meaning::Complex),
            (&self.at_most_one, Meaning::AtMostOne),
            (&self.positive, Meaning::Positive),
        ]
    }

    /// Reads the table of what each name stands for.
    ///
    /// # Errors
    /// A [`Fault`] that quotes the entry that cannot be read.
    pub fn read(&self) -> Result<Symbols, Fault> {
        let mut symbols = Symbols::new(self.first_names()?);
        let parameters = list(&self.parameters, &symbols)?;
        declare(list(&self.indices, &symbols)?, &Meaning::Index, &mut symbols);
        let mut states = list(&self.states, &symbols)?;
        let (running, parameters): (Vec<Name>, Vec<Name>) =
            parameters.into_iter().partition(|name| is_counted(name, &symbols));
        declare(parameters, &Meaning::Parameter, &mut symbols);
        for name in running.iter().map(Name::bare) {
            if !states.contains(&name) {
                states.push(name);
            }
        }
        let continuous = list(&self.continuous, &symbols)?;
        self.read_times(&mut symbols, &states)?;
        let mut states: Vec<Name> = states.iter().map(Name::bare).collect();
        states.dedup();
        declare(states, &Meaning::State, &mut symbols);
        declare(continuous.iter().map(Name::bare), &Meaning::Continuous, &mut symbols);
        self.read_functions(&mut symbols)?;
        for (name, period) in self.periods.pairs()? {
            let (name, period) = (name_of(&name, &symbols)?, expression(&period, &symbols)?);
            symbols.declare(name, Meaning::Period(period));
        }
        for (name, meaning) in self.abbreviations.pairs()? {
            let (name, meaning) = (name_of(&name, &symbols)?, expression(&meaning, &symbols)?);
            symbols.declare(name, Meaning::Abbreviation(meaning));
        }
        let mut relations = Vec::new();
        for (square, value) in self.relations.pairs()? {
            relations.extend(equations(&format!("{square} = {value}"), &symbols)?);
        }
        declare(list(&self.generic, &symbols)?, &Meaning::Generic, &mut symbols);
        self.read_kinds(&mut symbols)?;
        (symbols.laws, symbols.relations) = relations.into_iter().partition(|relation| symbols.moves(relation));
        self.read_maps(&mut symbols)?;
        refuse_twice(&symbols)?;
        Ok(symbols)
    }

    /// Reads the lists that say of which kind a symbol is.
    fn read_kinds(&self, symbols: &mut Symbols) -> Result<(), Fault> {
        for (texts, kind) in self.kinds() {
            declare(list(texts, symbols)?, &kind, symbols);
        }
        let at_most_one: Vec<Name> = symbols.at_most_one().cloned().collect();
        declare(at_most_one, &Meaning::Positive, symbols);
        symbols.names.complex = symbols.complex().cloned().collect();
        let is_real =
            |name: &Name| symbols.is_positive(name) || symbols.is_nonnegative(name) || symbols.is_integer(name);
        if let Some(name) = symbols.complex().find(|name| is_real(name)) {
            let problem = "is in `complex` and in a list of real symbols";
            return Err(Fault::new(format!("`{name}` {problem}")));
        }
        let abbreviations = symbols.abbreviations().map(|(name, _)| name);
        let functions = symbols.functions().map(|(name, _)| name);
        let known = symbols.parameters().chain(abbreviations).chain(functions);
        let mut known: HashSet<Name> = known.chain(symbols.running()).cloned().collect();
        let kinds = [
            Meaning::Positive,
            Meaning::Nonnegative,
            Meaning::Nonzero,
            Meaning::Integer,
            Meaning::Complex,
        ];
        let new: Vec<Name> = kinds
            .iter()
            .flat_map(|kind| symbols.all(kind))
            .filter(|name| !symbols.is_indexed(name) && known.insert((*name).clone()))
            .cloned()
            .collect();
        for name in new {
            match is_counted(&name, symbols) {
                false => symbols.declare(name, Meaning::Parameter),
                true if symbols.is_state(&name.bare()) => {}
                true => symbols.declare(name.bare(), Meaning::State),
            }
        }
        Ok(())
    }

    fn read_times(&self, symbols: &mut Symbols, states: &[Name]) -> Result<(), Fault> {
        for name in list(&self.times, symbols)? {
            // One letter with perhaps an offset numbers the impacts.
            let letter: String = name.subscript.chars().take_while(char::is_ascii_lowercase).collect();
            if name.subscript.is_empty() {
                symbols.names.running = Some(name);
            } else if letter.chars().count() == 1 && index_of(&name.subscript, &letter).is_some() {
                if symbols.index.is_empty() {
                    symbols.index = letter;
                }
                if !symbols.is_time(&name.bare()) {
                    symbols.declare(name.bare(), Meaning::Time);
                }
            } else {
                let problem = format!("the subscript of the time `{name}` must be an index such as k or k+1");
                return Err(Fault::new(problem));
            }
        }
        if symbols.index.is_empty() {
            let of_states = states.iter().find_map(|name| name.subscript.chars().next());
            let running = symbols.indices().next().map(|name| name.base.clone());
            symbols.index = of_states.map(String::from).or(running).unwrap_or("k".to_string());
        }
        Ok(())
    }

    fn read_functions(&self, symbols: &mut Symbols) -> Result<(), Fault> {
        let pairs = self.functions.pairs()?;
        let functions = pairs
            .iter()
            .map(|(name, _)| name_of(name, symbols))
            .collect::<Result<Vec<_>, _>>()?;
        // The motion law is a formula for the derivative of the last state.
        let of_states = symbols
            .states()
            .flat_map(|state| [state.clone(), state.dotted(), state.dotted().dotted()]);
        symbols.names.functions = functions.iter().cloned().chain(of_states).collect();
        let mut slopes = Vec::new();
        for (_, derivative) in &pairs {
            slopes.push(match derivative.trim() {
                "" => None,
                tex => Some(expression(tex, symbols)?),
            });
        }
        for (at, name) in functions.into_iter().enumerate() {
            // who writes f as the derivative of F gives derivatives names of his own
            let is_slope = slopes.iter().flatten().any(|slope| speaks_of(slope, &name));
            match slopes[at].clone() {
                None if !is_slope => declare_with_dots(symbols, name),
                slope => symbols.declare(name, Meaning::Function(slope)),
            }
        }
        Ok(())
    }

    fn read_maps(&self, symbols: &mut Symbols) -> Result<(), Fault> {
        let names = self
            .maps
            .keys()
            .map(|name| name_of(name, symbols))
            .collect::<Result<Vec<_>, _>>()?;
        symbols.names.matrices.clone_from(&names);
        for (name, entry) in names.into_iter().zip(self.maps.values()) {
            let map = match entry {
                MapEntry::Of { of, by } => Map::Premises {
                    of: of
                        .iter()
                        .map(|tex| expression(tex, symbols))
                        .collect::<Result<_, _>>()?,
                    by: by
                        .iter()
                        .map(|tex| expression(tex, symbols))
                        .collect::<Result<_, _>>()?,
                },
                MapEntry::List(list) if list.iter().any(|tex| tex.contains('=')) => {
                    let equations = list
                        .iter()
                        .map(|tex| equations(tex, symbols))
                        .collect::<Result<Vec<_>, _>>()?;
                    Map::Equations(equations.concat())
                }
                MapEntry::List(list) => product(&list.join(" "), symbols)?,
                MapEntry::Product(text) => product(text, symbols)?,
            };
            symbols.declare(name, Meaning::Map(map));
        }
        Ok(())
    }

    /// The words of several letters among the declared names, so that these can be read at all.
    fn first_names(&self) -> Result<Names, Fault> {
        let pairs = [&self.functions, &self.periods, &self.abbreviations];
        let mut texts: Vec<String> = Vec::new();
        for pair in pairs {
            texts.extend(pair.pairs()?.into_iter().map(|(name, _)| name));
        }
        let kinds = self
            .kinds()
            .into_iter()
            .flat_map(|(texts, _)| texts)
            .chain(&self.indices);
        let plain = self.parameters.iter().chain(&self.times).chain(&self.states);
        texts.extend(plain.chain(kinds).cloned());
        texts.extend(self.maps.keys().cloned());
        let word = |text: &String| {
            let text = text.trim();
            let (word, script) = text.split_at(text.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len()));
            let is_index = |index: &str| match index.strip_prefix('{').and_then(|index| index.split_once('}')) {
                Some((_, behind)) => behind.is_empty(),
                None => index.chars().count() == 1,
            };
            // `Cov(X_1, X_2)` and `mr^2 \hat{z}` are symbols, `Cov` and `mr` none
            let is_name = self.opaque.is_none() || script.is_empty() || script.strip_prefix('_').is_some_and(is_index);
            (is_name && word.len() > 1).then(|| word.to_owned())
        };
        let words = texts.iter().filter_map(word).collect();
        let letter = |text: &String| -> Option<String> {
            let text = text.trim();
            (text.len() == 1).then(|| text.to_owned())
        };
        let letters = match &self.opaque {
            Some(opaque) => opaque.letters.clone(),
            None => texts.iter().filter_map(letter).collect(),
        };
        Ok(Names {
            letters,
            words,
            opaque: self.opaque.clone().map(Opaque::from),
            ..Names::default()
        })
    }
}

/// Declares the same of several names.
fn declare(names: impl IntoIterator<Item = Name>, meaning: &Meaning, symbols: &mut Symbols) {
    for name in names {
        symbols.declare(name, meaning.clone());
    }
}

/// Returns true for what an index counts: it runs with it as a state does, in whichever list it stands.
fn is_counted(name: &Name, symbols: &Symbols) -> bool {
    let counts = |letter: &Name| index_of(&name.subscript, &letter.base).is_some();
    symbols.indices().any(counts)
}

/// Declares a function whose derivative has no name of its own: of time it has dots, where nothing else is called so.
fn declare_with_dots(symbols: &mut Symbols, name: Name) {
    let (dot, dots) = (name.dotted(), name.dotted().dotted());
    let is_taken = |other: &Name| symbols.names.functions.contains(other) || symbols.is_parameter(other);
    let is_dotted = name.accents.iter().any(|accent| accent.ends_with("dot"));
    if symbols.running().is_none() || name.primes > 0 || is_dotted || is_taken(&dot) || is_taken(&dots) {
        symbols.declare(name, Meaning::Function(None));
        return;
    }
    symbols.names.functions.extend([dot.clone(), dots.clone()]);
    let named = |name: &Name| Meaning::Function(Some(Tree::Symbol(name.clone(), At::default())));
    symbols.declare(name, named(&dot));
    symbols.declare(dot, named(&dots));
    symbols.declare(dots, Meaning::Function(None));
}

fn product(text: &str, symbols: &Symbols) -> Result<Map, Fault> {
    let factors = text.split_whitespace().filter(|word| *word != r"\cdot");
    let factors = factors.map(|word| {
        let name = name_of(word, symbols)?;
        if symbols.names.matrices.contains(&name) {
            return Ok(name);
        }
        Err(Fault::new(format!(
            "`{word}` is no map: name maps, or write equations with `=`"
        )))
    });
    Ok(Map::Product(factors.collect::<Result<_, _>>()?))
}

/// Refuses a name with two meanings: it has none.
fn refuse_twice(symbols: &Symbols) -> Result<(), Fault> {
    let lists: [(&str, Vec<&Name>); 6] = [
        ("parameters", symbols.parameters().collect()),
        ("indices", symbols.indices().collect()),
        ("functions", symbols.functions().map(|(name, _)| name).collect()),
        ("abbreviations", symbols.abbreviations().map(|(name, _)| name).collect()),
        ("states", symbols.states().collect()),
        ("times", symbols.running().into_iter().collect()),
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

fn list(texts: &[String], symbols: &Symbols) -> Result<Vec<Name>, Fault> {
    texts.iter().map(|text| name_of(text, symbols)).collect()
}

/// Reads one name.
fn name_of(text: &str, symbols: &Symbols) -> Result<Name, Fault> {
    match read_expression(text, &symbols.names) {
        Ok(Tree::Symbol(name, At(_))) => Ok(name),
        Ok(_) => Err(Fault::new(format!("`{text}` is not one name"))),
        Err(error) => Err(Fault::new(format!("`{text}` is not a name: {error}"))),
    }
}

fn expression(tex: &str, symbols: &Symbols) -> Result<Tree, Fault> {
    read_expression(tex, &symbols.names).map_err(|error| Fault::new(format!("`{tex}`: {error}")))
}

fn equations(tex: &str, symbols: &Symbols) -> Result<Vec<Equation>, Fault> {
    let equations = read(tex, &symbols.names).map_err(|error| Fault::new(format!("`{tex}`: {error}")))?;
    let mut doubts = equations.iter().flat_map(|equation| &equation.doubts.0);
    if let Some(doubt) = doubts.find(|doubt| matches!(doubt.kind, DoubtKind::Extent { is_usual: false, .. })) {
        return Err(Fault::new(format!("`{tex}`: {}", doubt.kind)));
    }
    match equations.iter().all(|equation| equation.relation == Relation::Equal) {
        true => Ok(equations),
        false => Err(Fault::new(format!("`{tex}`: an equation must stand here"))),
    }
}

/// The keys of [`Opaque`] in a sheet.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RawOpaque {
    pub factors: BTreeSet<String>,
    pub functions: BTreeSet<String>,
    pub values: BTreeSet<String>,
    pub transposes: bool,
    /// The letters that the document itself declares: `d` is a differential beside a guessed letter `d`.
    pub letters: Vec<String>,
}

impl From<RawOpaque> for Opaque {
    fn from(raw: RawOpaque) -> Self {
        Self {
            factors: raw.factors,
            functions: raw.functions,
            values: raw.values,
            transposes: raw.transposes,
        }
    }
}

/// Left and right sides, as a table or as a list of equations.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Pairs {
    Table(BTreeMap<String, String>),
    List(Vec<String>),
}

impl Default for Pairs {
    fn default() -> Self {
        Self::List(Vec::new())
    }
}

impl Pairs {
    /// The pairs; a list entry without `=` has an empty right side.
    pub(super) fn pairs(&self) -> Result<Vec<(String, String)>, Fault> {
        let clean = |a: &str, b: &str| (a.trim().to_string(), b.trim().to_string());
        match self {
            Self::Table(table) => Ok(table.iter().map(|(a, b)| clean(a, b)).collect()),
            Self::List(list) => list
                .iter()
                .map(|text| match text.split_once('=') {
                    Some((_, b)) if b.contains('=') => Err(Fault::new(format!("`{text}` has more than one `=`"))),
                    Some((a, b)) => Ok(clean(a, b)),
                    None => Ok(clean(text, "")),
                })
                .collect(),
        }
    }
}

/// An entry of `[symbols.maps]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum MapEntry {
    Product(String),
    List(Vec<String>),
    Of { of: Vec<String>, by: Vec<String> },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_running_time_is_no_parameter() {
        let symbols = RawSymbols {
            parameters: vec!["a".to_string(), "t".to_string()],
            times: vec!["t".to_string(), "t_k".to_string()],
            ..RawSymbols::default()
        };
        assert_eq!(
            symbols.read().unwrap_err().to_string(),
            "`t` is declared twice, in `parameters` and in `times`: leave one of them out"
        );
    }
}
