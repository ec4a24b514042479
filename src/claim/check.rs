//! Whether a vocabulary makes sense: every name in it declared, nothing defined by itself.

use super::circle::circle;
use super::definition::{Local, circular};
use super::fault::Fault;
use super::nodes::any;
use super::size::Budget;
use super::vocabulary::{Map, Vocabulary};
use crate::tex::{Name, Tree};
use std::collections::HashMap;

impl Vocabulary {
    /// Checks everything that the vocabulary says, used or not.
    ///
    /// # Errors
    /// A [`Fault`] that quotes what makes no sense.
    pub fn check(&self) -> Result<(), Fault> {
        for (name, _) in &self.periods {
            if !self.names.functions.contains(name) {
                return Err(Fault::new(format!(
                    "`{name}` in `periods` is neither a function nor a state"
                )));
            }
        }
        let derivatives = self
            .functions
            .iter()
            .filter_map(|(name, tree)| Some((name, tree.as_ref()?)));
        let defined = self
            .abbreviations
            .iter()
            .chain(&self.periods)
            .map(|(name, tree)| (name, tree));
        for (name, tree) in defined.chain(derivatives) {
            self.check_tree(tree, &format!("`{name}`"))?;
        }
        let abbreviations = self.abbreviations.iter().map(|(name, tree)| Local {
            name: name.clone(),
            tree: tree.clone(),
        });
        let abbreviations: Vec<Local> = abbreviations.collect();
        if let Some(name) = circular(&abbreviations) {
            return Err(Fault::new(format!("`{name}` is defined by itself")));
        }
        self.check_sizes()?;
        let lists = [
            ("generic", &self.generic),
            ("at_most_one", &self.at_most_one),
            ("positive", &self.positive),
            ("nonnegative", &self.nonnegative),
            ("nonzero", &self.nonzero),
            ("integers", &self.integers),
            ("complex", &self.complex),
        ];
        for (list, names) in lists {
            if let Some(name) = names.iter().find(|name| !self.declares(name)) {
                let declare = "add it to `parameters`, or to what it is";
                return Err(Fault::new(format!("`{name}` in `{list}` is not declared: {declare}")));
            }
            if let Some(name) = names
                .iter()
                .find(|name| !(self.is_single(name) || self.is_indexed(name)))
            {
                let problem = "runs over times: give its value at an impact, or a premise that says it at every time";
                return Err(Fault::new(format!("`{name}` in `{list}` {problem}")));
            }
        }
        self.check_lists_of_meanings()?;
        self.check_subscripts()?;
        for letter in &self.indices {
            if letter.to_string().chars().count() != 1 {
                return Err(Fault::new(format!("`{letter}` in `indices` must be one letter")));
            }
        }
        for relation in &self.relations {
            let about = format!("relation `{relation}`");
            if !is_square(&relation.left) {
                let problem = "its left side must be the square of a symbol or of a function";
                return Err(Fault::new(format!("{about}: {problem}")));
            }
            for side in [&relation.left, &relation.right] {
                self.check_tree(side, &about)?;
            }
        }
        self.check_maps()
    }

    /// Refuses formulas that would be too large with abbreviations put in.
    fn check_sizes(&self) -> Result<(), Fault> {
        let mut sizes = self.sizes(std::iter::empty());
        let budget = Budget::of_claim();
        let named = self.abbreviations.iter().chain(&self.periods);
        let named = named.map(|(name, tree)| (name.to_string(), tree));
        let derivatives = self.functions.iter();
        let derivatives = derivatives.filter_map(|(name, tree)| Some((name.to_string(), tree.as_ref()?)));
        let equations = self.relations.iter().chain(&self.laws);
        let sides = equations.flat_map(|law| [(law.to_string(), &law.left), (law.to_string(), &law.right)]);
        for (about, tree) in named.chain(derivatives).chain(sides) {
            sizes
                .of(tree)
                .and_then(|size| budget.spend(size))
                .map_err(|problem| Fault::new(format!("`{about}` is {problem}")))?;
        }
        Ok(())
    }

    /// Refuses names that carry the index of the impacts, or one that runs, without running with it.
    fn check_subscripts(&self) -> Result<(), Fault> {
        let has_impacts = !(self.times.is_empty() && self.states.is_empty());
        let runs = |letter: &str| self.indices.iter().any(|index| index.base == letter);
        let letters = self.indices.iter().map(|index| index.base.as_str());
        let letters: Vec<&str> = letters.chain(has_impacts.then_some(self.index.as_str())).collect();
        let names = self
            .parameters
            .iter()
            .chain(self.functions.iter().map(|(name, _)| name));
        for name in names {
            if has_impacts && !runs(&self.index) && name.to_string() == self.index {
                let problem = "numbers the impacts here: call the parameter otherwise";
                return Err(Fault::new(format!("`{name}` {problem}")));
            }
            let parts = name.subscript.split(|c: char| !c.is_ascii_alphanumeric());
            let short: Vec<&str> = parts.filter(|part| part.len() <= 2).collect();
            if let Some(letter) = letters
                .iter()
                .find(|letter| short.iter().any(|part| part.contains(**letter)))
            {
                let problem = format!(
                    "carries the index {letter} and does not run with it: a state does, as {letter} or {letter}+1 alone"
                );
                return Err(Fault::new(format!("`{name}` {problem}")));
            }
        }
        Ok(())
    }

    /// Refuses an abbreviation that is generic of symbols that are not, and an index in a list.
    fn check_lists_of_meanings(&self) -> Result<(), Fault> {
        let lists = [&self.positive, &self.at_most_one, &self.generic];
        if let Some(index) = self
            .indices
            .iter()
            .find(|index| lists.iter().any(|list| list.contains(index)))
        {
            return Err(Fault::new(format!("`{index}` is an index: it runs over all integers")));
        }
        for (name, _) in self
            .abbreviations
            .iter()
            .filter(|(name, _)| self.generic.contains(name))
        {
            let mut is_bound = |node: &Tree| matches!(node, Tree::Symbol(inner, _) if self.parameters.contains(inner) && !self.generic.contains(inner));
            let meaning = self.meaning(name, &|_| false);
            if meaning.is_some_and(|tree| any(&tree, &mut is_bound)) {
                let problem = "stands for symbols that are not generic: list these";
                return Err(Fault::new(format!("`{name}` in `generic` {problem}")));
            }
        }
        Ok(())
    }

    fn check_tree(&self, tree: &Tree, about: &str) -> Result<(), Fault> {
        match self.undeclared(tree, &|_| false).first() {
            Some(found) => Err(Fault::new(format!("{about}: {}{}", found.message, found.known))),
            None => Ok(()),
        }
    }

    fn check_maps(&self) -> Result<(), Fault> {
        for (name, map) in &self.maps {
            let problem = match map {
                Map::Product(_) => continue,
                Map::Premises { of, by } => {
                    let counts = self.step(map).map(|(to, from)| [to.len(), from.len()]);
                    (counts != Some([of.len(), by.len()])).then_some("`of` and `by` must list times and states")
                }
                Map::Equations(equations) => {
                    for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
                        self.check_tree(side, &format!("map `{name}`"))?;
                    }
                    let fits = self.step(map).is_some();
                    (!fits).then_some("its equations must take the states at one impact to the next")
                }
            };
            if let Some(problem) = problem {
                return Err(Fault::new(format!("map `{name}`: {problem}")));
            }
        }
        let position = |name: &Name| self.maps.iter().position(|(known, _)| known == name);
        let factors = |map: &Map| match map {
            Map::Product(factors) => factors.iter().filter_map(position).collect(),
            _ => Vec::new(),
        };
        let uses: Vec<Vec<usize>> = self.maps.iter().map(|(_, map)| factors(map)).collect();
        if let Some((name, _)) = circle(&uses).and_then(|n| self.maps.get(n)) {
            return Err(Fault::new(format!("map `{name}` is a product of itself")));
        }
        let mut shapes = HashMap::new();
        match self
            .maps
            .iter()
            .find(|(name, _)| self.shape(name, &mut shapes).is_none())
        {
            Some((name, _)) => Err(Fault::new(format!("map `{name}`: its factors do not fit together"))),
            None => Ok(()),
        }
    }

    /// Rows and columns of a map that is no product of itself; `None` where factors do not fit together.
    fn shape<'a>(&'a self, name: &'a Name, shapes: &mut HashMap<&'a Name, Shape>) -> Shape {
        if let Some(known) = shapes.get(name) {
            return *known;
        }
        let (_, map) = self.maps.iter().find(|(known, _)| known == name)?;
        let shape = match map {
            Map::Product(factors) => {
                let mut factors = factors.iter();
                let first = factors.next().and_then(|factor| self.shape(factor, shapes));
                factors.fold(first, |product, factor| {
                    let ((rows, columns), next) = (product?, self.shape(factor, shapes)?);
                    (next.0 == columns).then_some((rows, next.1))
                })
            }
            _ => self.step(map).map(|(to, from)| (to.len(), from.len())),
        };
        shapes.insert(name, shape);
        shape
    }
}

/// Rows and columns, where there are any.
type Shape = Option<(usize, usize)>;

fn is_square(tree: &Tree) -> bool {
    match tree {
        Tree::Power(base, 2, _) => matches!(base.as_ref(), Tree::Symbol(..) | Tree::Call(..)),
        _ => false,
    }
}
