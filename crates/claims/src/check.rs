//! Whether `[symbols]` makes sense: every name in it declared, nothing defined by itself.

use super::circle::circle;
use super::definition::{Local, circular};
use super::fault::Fault;
use super::size::{Budget, Sizes};
use std::collections::HashMap;
use texmath::{Map, Meaning, Name, Symbols, Tree, any};

/// Checks everything that `[symbols]` says, used or not.
///
/// # Errors
/// A [`Fault`] that quotes what makes no sense.
pub(super) fn check(symbols: &Symbols) -> Result<(), Fault> {
    for (name, _) in symbols.periods() {
        if !symbols.names.functions.contains(name) {
            return Err(Fault::new(format!(
                "`{name}` in `periods` is neither a function nor a state"
            )));
        }
    }
    let derivatives = symbols.functions().filter_map(|(name, tree)| Some((name, tree?)));
    let defined = symbols.abbreviations().chain(symbols.periods());
    for (name, tree) in defined.chain(derivatives) {
        check_tree(symbols, tree, &format!("`{name}`"))?;
    }
    let abbreviations = symbols.abbreviations().map(|(name, tree)| Local {
        name: name.clone(),
        tree: tree.clone(),
    });
    let abbreviations: Vec<Local> = abbreviations.collect();
    if let Some(name) = circular(&abbreviations) {
        return Err(Fault::new(format!("`{name}` is defined by itself")));
    }
    check_sizes(symbols)?;
    let lists = [
        ("generic", Meaning::Generic),
        ("at_most_one", Meaning::AtMostOne),
        ("positive", Meaning::Positive),
        ("nonnegative", Meaning::Nonnegative),
        ("nonzero", Meaning::Nonzero),
        ("integers", Meaning::Integer),
        ("complex", Meaning::Complex),
    ];
    for (list, kind) in lists {
        if let Some(name) = symbols.all(&kind).find(|name| !symbols.declares(name)) {
            let declare = "add it to `parameters`, or to what it is";
            return Err(Fault::new(format!("`{name}` in `{list}` is not declared: {declare}")));
        }
        if let Some(name) = symbols
            .all(&kind)
            .find(|name| !(symbols.is_single(name) || symbols.is_indexed(name)))
        {
            let problem = "runs over times: give its value at an impact, or a premise that says it at every time";
            return Err(Fault::new(format!("`{name}` in `{list}` {problem}")));
        }
    }
    check_lists_of_meanings(symbols)?;
    check_subscripts(symbols)?;
    for letter in symbols.indices() {
        if letter.to_string().chars().count() != 1 {
            return Err(Fault::new(format!("`{letter}` in `indices` must be one letter")));
        }
    }
    for relation in &symbols.relations {
        let about = format!("relation `{relation}`");
        if !is_square(&relation.left) {
            let problem = "its left side must be the square of a symbol or of a function";
            return Err(Fault::new(format!("{about}: {problem}")));
        }
        for side in [&relation.left, &relation.right] {
            check_tree(symbols, side, &about)?;
        }
    }
    check_maps(symbols)
}

/// Refuses formulas that would be too large with abbreviations put in.
fn check_sizes(symbols: &Symbols) -> Result<(), Fault> {
    let mut sizes = Sizes::within_sheet(symbols, std::iter::empty());
    let budget = Budget::of_claim();
    let named = symbols.abbreviations().chain(symbols.periods());
    let named = named.map(|(name, tree)| (name.to_string(), tree));
    let derivatives = symbols.functions();
    let derivatives = derivatives.filter_map(|(name, tree)| Some((name.to_string(), tree?)));
    let equations = symbols.relations.iter().chain(&symbols.laws);
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
fn check_subscripts(symbols: &Symbols) -> Result<(), Fault> {
    let has_impacts = symbols.times().chain(symbols.states()).next().is_some();
    let runs = |letter: &str| symbols.indices().any(|index| index.base == letter);
    let letters = symbols.indices().map(|index| index.base.as_str());
    let letters: Vec<&str> = letters.chain(has_impacts.then_some(symbols.index.as_str())).collect();
    let names = symbols.parameters().chain(symbols.functions().map(|(name, _)| name));
    for name in names {
        if has_impacts && !runs(&symbols.index) && name.to_string() == symbols.index {
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
fn check_lists_of_meanings(symbols: &Symbols) -> Result<(), Fault> {
    let is_listed = |index: &&Name| symbols.is_positive(index) || symbols.is_generic(index);
    if let Some(index) = symbols.indices().find(is_listed) {
        return Err(Fault::new(format!("`{index}` is an index: it runs over all integers")));
    }
    for (name, _) in symbols.abbreviations().filter(|(name, _)| symbols.is_generic(name)) {
        let mut is_bound = |node: &Tree| matches!(node, Tree::Symbol(inner, _) if symbols.is_parameter(inner) && !symbols.is_generic(inner));
        let meaning = symbols.meaning(name, &|_| false);
        if meaning.is_some_and(|tree| any(&tree, &mut is_bound)) {
            let problem = "stands for symbols that are not generic: list these";
            return Err(Fault::new(format!("`{name}` in `generic` {problem}")));
        }
    }
    Ok(())
}

fn check_tree(symbols: &Symbols, tree: &Tree, about: &str) -> Result<(), Fault> {
    match symbols.undeclared(tree, &|_| false).first() {
        Some(found) => Err(Fault::new(format!("{about}: {}{}", found.message, found.known))),
        None => Ok(()),
    }
}

fn check_maps(symbols: &Symbols) -> Result<(), Fault> {
    for (name, map) in symbols.maps() {
        let problem = match map {
            Map::Product(_) => continue,
            Map::Premises { of, by } => {
                let counts = symbols.step(map).map(|(to, from)| [to.len(), from.len()]);
                (counts != Some([of.len(), by.len()])).then_some("`of` and `by` must list times and states")
            }
            Map::Equations(equations) => {
                for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
                    check_tree(symbols, side, &format!("map `{name}`"))?;
                }
                let fits = symbols.step(map).is_some();
                (!fits).then_some("its equations must take the states at one impact to the next")
            }
        };
        if let Some(problem) = problem {
            return Err(Fault::new(format!("map `{name}`: {problem}")));
        }
    }
    let position = |name: &Name| symbols.maps().position(|(known, _)| known == name);
    let factors = |map: &Map| match map {
        Map::Product(factors) => factors.iter().filter_map(position).collect(),
        _ => Vec::new(),
    };
    let uses: Vec<Vec<usize>> = symbols.maps().map(|(_, map)| factors(map)).collect();
    if let Some((name, _)) = circle(&uses).and_then(|n| symbols.maps().nth(n)) {
        return Err(Fault::new(format!("map `{name}` is a product of itself")));
    }
    let mut shapes = HashMap::new();
    match symbols
        .maps()
        .find(|(name, _)| shape(symbols, name, &mut shapes).is_none())
    {
        Some((name, _)) => Err(Fault::new(format!("map `{name}`: its factors do not fit together"))),
        None => Ok(()),
    }
}

/// Rows and columns of a map that is no product of itself; `None` where factors do not fit together.
fn shape<'a>(symbols: &'a Symbols, name: &'a Name, shapes: &mut HashMap<&'a Name, Shape>) -> Shape {
    if let Some(known) = shapes.get(name) {
        return *known;
    }
    let shape = match symbols.map(name)? {
        Map::Product(factors) => {
            let mut factors = factors.iter();
            let first = factors.next().and_then(|factor| shape(symbols, factor, shapes));
            factors.fold(first, |product, factor| {
                let ((rows, columns), next) = (product?, shape(symbols, factor, shapes)?);
                (next.0 == columns).then_some((rows, next.1))
            })
        }
        map => symbols.step(map).map(|(to, from)| (to.len(), from.len())),
    };
    shapes.insert(name, shape);
    shape
}

/// Rows and columns, where there are any.
type Shape = Option<(usize, usize)>;

fn is_square(tree: &Tree) -> bool {
    match tree {
        Tree::Power(base, 2, _) => matches!(base.as_ref(), Tree::Symbol(..) | Tree::Call(..)),
        _ => false,
    }
}
