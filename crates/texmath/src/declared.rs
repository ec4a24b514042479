//! Which names are declared, and the first name of a formula that is not.

use super::nodes::{any, any_side};
use super::shorthand::is_opaque;
use super::symbols::{Map, Symbols, base_alone, index_of, is_constant, pair_of, place_of};
use super::{Name, Tree, nearest};
use std::collections::{BTreeSet, HashSet};

/// Names shown in a message, and names among which the nearest is looked for.
const MOST_SHOWN: usize = 40;
const MOST_COMPARED: usize = 1000;
/// Names of one formula that are reported.
const MOST_REPORTED: usize = 10;

/// A symbol that nothing declares, and the declared one that was probably meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    pub name: Name,
    pub meant: Option<String>,
}

/// A name that stands for nothing: where, what to say of it, and the names that are known.
pub struct Undeclared {
    pub at: usize,
    pub message: String,
    pub known: String,
    /// The symbol, where a declaration is all that it lacks.
    pub unknown: Option<Unknown>,
}

impl Undeclared {
    fn plain(at: usize, message: String) -> Self {
        let known = String::new();
        Self {
            at,
            message,
            known,
            unknown: None,
        }
    }
}

impl Symbols {
    /// Returns true if a name needs no definition: a parameter, an abbreviation, an index, a time or a state at an impact, the
    /// running time, a function or one of its derivatives, a state in flight or one of its derivatives, a matrix,
    /// `\pi`, and `e` and `i` where nothing else is declared by that name. A pair such as `\lambda_{1,2}` is known
    /// where `\lambda` is, the conjugate `\bar z` where `z` is declared complex.
    pub fn knows(&self, name: &Name) -> bool {
        self.declares(name)
            || is_constant(name)
            || pair_of(name).is_some_and(|single| self.declares(&single))
            || self.conjugated(name).is_some()
    }

    /// Returns the complex symbol, or the imaginary unit, of which a name that is not declared itself is the conjugate, as
    /// `\bar z` and `z^*` are, and whether it is so an odd number of times.
    pub fn conjugated(&self, name: &Name) -> Option<(Name, bool)> {
        let mut plain = name.clone();
        if self.declares(name) {
            return None;
        }
        if plain.mark == "*" {
            plain.mark.clear();
        } else if plain.accents.pop()? != r"\overline" {
            return None;
        }
        match self.is_complex(&plain) || self.is_unit(&plain) {
            true => Some((plain, true)),
            false => self.conjugated(&plain).map(|(plain, is_odd)| (plain, !is_odd)),
        }
    }

    /// Returns true if a name is the imaginary unit.
    pub fn is_unit(&self, name: &Name) -> bool {
        name.base == "i" && is_constant(name) && !self.declares(name)
    }

    /// Returns true if the table declares this name.
    pub fn declares(&self, name: &Name) -> bool {
        self.is_single(name)
            || self.running() == Some(name)
            || self.is_indexed(name)
            || (name.mark.is_empty() && (self.is_function(name) || self.is_in_flight(name)))
            || self.names.matrices.contains(name)
    }

    /// Returns true if this is the time of an impact, or a state there. A mark without an index, as in `\dot{x}^+`, belongs to
    /// the impact of the index itself.
    pub fn is_indexed(&self, name: &Name) -> bool {
        let marked = matches!(name.mark.as_str(), "-" | "+");
        let numbered = self.counts(&name.subscript) || (name.subscript.is_empty() && marked);
        let bare = name.bare();
        let is_time = name.mark.is_empty() && self.is_time(&bare);
        let is_state = (name.mark.is_empty() || marked) && self.is_state(&bare);
        numbered && name.primes == 0 && (is_time || is_state)
    }

    /// Returns true if a subscript numbers an impact or a member of a sequence: `k+1`, or `0` where an index runs.
    fn counts(&self, subscript: &str) -> bool {
        let runs = self.indices().next().is_some();
        index_of(subscript, &self.index).is_some()
            || self.indices().any(|letter| place_of(subscript, &letter.base).is_some())
            || (runs && subscript.parse::<u16>().is_ok())
    }

    /// Returns the function whose derivative this function is, as declared or by its primes.
    pub fn antiderivative_of(&self, function: &Name) -> Option<Name> {
        let is_slope = |slope: Option<&Tree>| matches!(slope, Some(Tree::Symbol(slope, _)) if slope == function);
        let mut declared = self.functions();
        let before = declared
            .find(|(_, slope)| is_slope(*slope))
            .map(|(name, _)| name.clone());
        before.or_else(|| {
            let primes = function.primes.checked_sub(1)?;
            Some(Name {
                primes,
                ..function.clone()
            })
        })
    }

    /// Returns true if this is a state in flight, or its first or second derivative.
    pub fn is_in_flight(&self, name: &Name) -> bool {
        let plain = Name {
            primes: 0,
            mark: String::new(),
            ..name.clone()
        };
        let derivatives = |state: &Name| [state.clone(), state.dotted(), state.dotted().dotted()];
        self.states().any(|state| derivatives(state).contains(&plain))
    }

    /// Returns true if this is a state, not the derivative of the last one.
    fn is_state_itself(&self, name: &Name) -> bool {
        name.primes == 0 && self.is_state(&name.bare())
    }

    /// Returns the names of the formula that stand for nothing, each once; `extra` are names that are known besides.
    pub fn undeclared(&self, tree: &Tree, extra: &dyn Fn(&Name) -> bool) -> Vec<Undeclared> {
        let mut found: Vec<Undeclared> = Vec::new();
        let mut reported: HashSet<Name> = HashSet::new();
        self.each_unbound(tree, &mut Vec::new(), &mut |node| {
            if matches!(node, Tree::Symbol(name, _) if reported.contains(name)) {
                return false;
            }
            if let Some(new) = self.undeclared_here(node, extra)
                && found.iter().all(|old| old.message != new.message)
            {
                if let Tree::Symbol(name, _) = node {
                    reported.insert(name.clone());
                }
                found.push(new);
            }
            found.len() >= MOST_REPORTED
        });
        found
    }

    /// Returns true if any node passes the test, but for the letters that operations bind, names that these number, and the
    /// `T` of a transpose.
    fn each_unbound(&self, tree: &Tree, bound: &mut Vec<Name>, test: &mut dyn FnMut(&Tree) -> bool) -> bool {
        let is_bound = |name: &Name| {
            bound
                .iter()
                .any(|letter| letter == name || index_of(&name.subscript, &letter.to_string()).is_some())
        };
        if matches!(tree, Tree::Symbol(name, _) if is_bound(name)) {
            return false;
        }
        match tree {
            Tree::Operation(operation, _) => {
                let letter = operation.letter();
                operation.parts().into_iter().any(|(part, is_inside)| {
                    let own = letter.filter(|_| is_inside);
                    bound.extend(own.cloned());
                    let passes = self.each_unbound(part, bound, test);
                    if own.is_some() {
                        bound.pop();
                    }
                    passes
                })
            }
            Tree::RealPower(base, exponent, _) if self.transposes(exponent) => self.each_unbound(base, bound, test),
            tree => {
                test(tree)
                    || tree
                        .find_below(&mut |part| self.each_unbound(part, bound, test).then_some(()))
                        .is_some()
            }
        }
    }

    /// Returns true if an exponent is that of a transpose.
    pub fn transposes(&self, exponent: &Tree) -> bool {
        matches!(exponent, Tree::Symbol(name, _)
            if matches!(name.base.as_str(), "T" | r"\top") && *name == base_alone(name) && !self.knows(name))
    }

    fn undeclared_here(&self, node: &Tree, extra: &dyn Fn(&Name) -> bool) -> Option<Undeclared> {
        match node {
            Tree::Symbol(name, _) if self.is_single(name) || extra(name) => None,
            Tree::Symbol(name, at) if self.names.matrices.contains(name) => {
                let message = format!("`{name}` is a matrix: write Tr({name}) or Det({name})");
                Some(Undeclared::plain(at.0, message))
            }
            Tree::Symbol(name, at) if !self.knows(name) => Some(self.unknown(name, at.0)),
            Tree::Call(name, argument, at) => {
                let elementary = name.base.starts_with('\\') && *name == base_alone(name);
                let at_impact = matches!(argument.as_ref(), Tree::Symbol(time, _) if self.is_time_of_impact(time));
                let message = match () {
                    () if at_impact
                        && name.mark.is_empty()
                        && self.is_in_flight(name)
                        && !self.is_state_itself(name) =>
                    {
                        format!("`{name}` has two values at an impact, before and after it: write the motion out")
                    }
                    () if self.is_in_flight(name) && (name.mark.is_empty() || at_impact) => return None,
                    () if self.is_function(name) || elementary => return None,
                    () if self.is_in_flight(name) => {
                        format!("`{name}` needs the time of an impact in its bracket")
                    }
                    () => format!("`{name}` is not a function here"),
                };
                Some(Undeclared::plain(at.0, message))
            }
            Tree::Partial { of, by, at } => {
                let unknown = [of, by].into_iter().find(|name| !self.knows(name) && !extra(name));
                match unknown {
                    Some(name) => Some(self.unknown(name, at.0)),
                    None if self.has_partial(of, by) => None,
                    None => {
                        let message = format!("no map gives the derivative of `{of}` by `{by}`");
                        Some(Undeclared::plain(at.0, message))
                    }
                }
            }
            _ => None,
        }
    }

    fn is_time_of_impact(&self, name: &Name) -> bool {
        self.is_time(&name.bare()) && self.is_indexed(name)
    }

    /// Returns the first symbol of the formula that may be complex, left out what stands in absolute values, real and imaginary
    /// parts and arguments, which are real; `extra` are complex besides.
    pub fn complex_in<'t>(&self, tree: &'t Tree, extra: &dyn Fn(&Name) -> bool) -> Option<&'t Name> {
        self.complex_beside(tree, extra, &[])
    }

    /// Does so beside letters that are bound: an index `i` is no imaginary unit.
    fn complex_beside<'t>(&self, tree: &'t Tree, extra: &dyn Fn(&Name) -> bool, bound: &[&Name]) -> Option<&'t Name> {
        match tree {
            Tree::Symbol(name, _) if bound.contains(&name) => None,
            Tree::Symbol(name, _) => {
                let single = pair_of(name);
                let listed = self.is_complex(single.as_ref().unwrap_or(name));
                let meaning = self.abbreviation(name);
                let is_complex = meaning.is_some_and(|meaning| self.complex_in(meaning, extra).is_some());
                let is_complex = listed || is_complex || self.is_unit(name) || self.conjugated(name).is_some();
                (is_complex || extra(name)).then_some(name)
            }
            Tree::Call(name, ..) if matches!(name.base.as_str(), r"\abs" | r"\Re" | r"\Im" | r"\arg") => None,
            Tree::Operation(operation, _) => {
                let within: Vec<&Name> = bound.iter().copied().chain(operation.letter()).collect();
                let parts = operation.parts().into_iter();
                let mut bound = parts.map(|(part, is_bound)| (part, if is_bound { within.as_slice() } else { bound }));
                bound.find_map(|(part, bound)| self.complex_beside(part, extra, bound))
            }
            _ => tree.find_below(&mut |part| self.complex_beside(part, extra, bound)),
        }
    }

    /// Returns true if a complex symbol or the imaginary unit stands in a formula, left out what is real whatever stands
    /// in it.
    pub fn may_be_complex(&self, tree: &Tree) -> bool {
        self.complex_in(tree, &|_| false).is_some()
    }

    /// Returns true if a complex symbol, the conjugate of one or the imaginary unit stands anywhere in a formula.
    pub fn speaks_of_complex(&self, tree: &Tree) -> bool {
        any(tree, &mut |node| match node {
            Tree::Symbol(name, _) => {
                let single = pair_of(name);
                let is_listed = self.is_complex(single.as_ref().unwrap_or(name));
                is_listed || self.is_unit(name) || self.conjugated(name).is_some()
            }
            _ => false,
        })
    }

    /// Returns true if a name is the conjugate of another.
    pub fn is_conjugate_of(&self, name: &Name, of: &Name) -> bool {
        self.conjugated(name).is_some_and(|(plain, _)| plain == *of)
    }

    /// Returns what to say of a name that nothing declares.
    pub fn unknown(&self, name: &Name, at: usize) -> Undeclared {
        let found = name.to_string();
        let mut all = self.shown();
        // terms that are one symbol each are no names to write
        all.retain(|(name, _)| !is_opaque(name));
        let plain: Vec<String> = all
            .iter()
            .take(MOST_COMPARED)
            .map(|(name, _)| name.to_string())
            .collect();
        let meant = nearest(&found, plain.iter().map(String::as_str));
        // Of one letter alone any other is near.
        let meant = meant.filter(|meant| found.chars().count() > 1 || meant.eq_ignore_ascii_case(&found));
        let advice = meant.map_or(String::new(), |name| format!(", did you mean `{name}`?"));
        let mut known: Vec<&str> = all.iter().take(MOST_SHOWN).map(|(_, shown)| shown.as_str()).collect();
        let more = all.len().saturating_sub(MOST_SHOWN);
        let more = (more > 0).then(|| format!("and {more} more"));
        known.extend(more.as_deref());
        let known = if known.is_empty() {
            "nothing is declared".to_string()
        } else {
            format!("known: {}", known.join(", "))
        };
        Undeclared {
            at,
            message: format!("unknown symbol `{found}`{advice}"),
            known: format!(" ({known})"),
            unknown: Some(Unknown {
                name: name.clone(),
                meant: meant.map(str::to_owned),
            }),
        }
    }

    /// Every declared name, and how it is shown in a message.
    fn shown(&self) -> Vec<(Name, String)> {
        let plain = |name: &Name| (name.clone(), name.to_string());
        let indexed = |name: &Name| {
            let subscript = self.index.clone();
            plain(&Name {
                subscript,
                ..name.clone()
            })
        };
        let functions = self.functions().map(|(name, _)| (name.clone(), format!("{name}(t)")));
        let abbreviations = self.abbreviations().map(|(name, _)| name);
        let singles = self.parameters().chain(abbreviations).chain(self.indices()).map(plain);
        singles
            .chain(self.times().chain(self.states()).map(indexed))
            .chain(functions)
            .collect()
    }

    /// Returns true if a map has this derivative, or a chain of maps: 1 or 0 among the quantities that a map starts from. Where
    /// no maps are declared, the premises may give the derivative of any time or state at an impact by another.
    pub fn has_partial(&self, of: &Name, by: &Name) -> bool {
        if self.maps().next().is_none() {
            return self.is_indexed(of) && self.is_indexed(by);
        }
        let steps: Vec<(Vec<Name>, Vec<Name>)> = self.maps().filter_map(|(_, map)| self.step(map)).collect();
        let (of, mut reached) = (self.quantity(of), vec![self.quantity(by)]);
        if steps
            .iter()
            .any(|(_, from)| from.contains(&of) && from.contains(&reached[0]))
        {
            return true;
        }
        for _ in 0..steps.len() {
            for (to, from) in &steps {
                if from.iter().any(|name| reached.contains(name)) {
                    let new: Vec<Name> = to.iter().filter(|name| !reached.contains(name)).cloned().collect();
                    reached.extend(new);
                }
            }
        }
        reached.iter().skip(1).any(|name| *name == of)
    }

    /// Returns what a map leads to and what it starts from, times before states as declared: the quantities at the last and at
    /// the first impact that its equations name. `None` for a product of maps, and where there are no two impacts.
    pub fn step(&self, map: &Map) -> Option<(Vec<Name>, Vec<Name>)> {
        let name = |tree: &Tree| match tree {
            Tree::Symbol(name, _) if self.is_indexed(name) => Some(self.quantity(name)),
            _ => None,
        };
        let equations = match map {
            Map::Product(_) => return None,
            Map::Premises { of, by } => {
                let names = |trees: &[Tree]| trees.iter().filter_map(name).collect();
                return Some((names(of), names(by)));
            }
            Map::Equations(equations) => equations,
        };
        let mut met: BTreeSet<(i32, usize, Name)> = BTreeSet::new();
        for equation in equations.iter().map(|equation| self.expanded(equation)) {
            any_side(&equation, &mut |node| {
                if let Some(name) = name(node)
                    && let Some(index) = self.impact(&name)
                {
                    let state = self.states().position(|state| *state == name.bare());
                    met.insert((index, state.map_or(0, |rank| rank + 1), name));
                }
                false
            });
        }
        let (first, last) = (met.first()?.0, met.last()?.0);
        let at = |index: i32| met.iter().filter(|m| m.0 == index).map(|m| m.2.clone()).collect();
        (first < last).then(|| (at(last), at(first)))
    }

    /// The name of a quantity: a state without a mark is the value just before the impact.
    fn quantity(&self, name: &Name) -> Name {
        let unchanged = name.mark == "-" || self.is_continuous(&name.bare());
        let mark = if unchanged { String::new() } else { name.mark.clone() };
        Name { mark, ..name.clone() }
    }
}
