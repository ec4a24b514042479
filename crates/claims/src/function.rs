//! Functions that definitions give, as `f(x) = x^2` and `g(x, y) = x y`, written out where they are applied; and partial
//! derivatives of what definitions give.

use super::circle::ordered;
use super::definition::{Local, local};
use super::kinds::may_take;
use super::size::{Budget, Size};
use std::cell::RefCell;
use std::collections::HashSet;
use texmath::{
    At, Equation, Name, Operation, Relation, Symbols, Tree, any, functions_given, index_of, mapped, rewrite, speaks_of,
};

/// A function that a definition gives.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Function {
    name: Name,
    /// One or more, no name twice.
    arguments: Vec<Name>,
    value: Tree,
}

/// What the definitions give that an entry may use: functions and names.
#[derive(Clone, Debug, Default)]
pub(super) struct Given {
    functions: Vec<Function>,
    names: Vec<Local>,
}

/// What cannot be written out, and where.
type Problem = (usize, String);

/// The names of functions that definitions give by their TeX: where the name is declared it is no new one, and what
/// runs, counts or means something else is no argument. The second list has those of several arguments.
pub(super) fn names_given<'t>(texts: impl Iterator<Item = &'t str>, symbols: &Symbols) -> [Vec<Name>; 2] {
    let (mut names, mut several): (Vec<Name>, Vec<Name>) = (Vec::new(), Vec::new());
    for (name, arguments) in texts.flat_map(|tex| functions_given(tex, &symbols.names)) {
        let is_new = !symbols.knows(&name) && name.mark.is_empty() && name.primes == 0 && !names.contains(&name);
        let is_time = |argument: &Name| symbols.running() == Some(argument);
        let is_plain =
            |argument: &Name| is_time(argument) || symbols.is_parameter(argument) || !symbols.knows(argument);
        if is_new && arguments.iter().all(is_plain) && are_different(&arguments) {
            if let [argument] = arguments.as_slice()
                && (is_time(argument) || argument.to_string() == "t")
            {
                names.extend([name.dotted(), name.dotted().dotted()]);
            }
            several.extend((arguments.len() > 1).then(|| name.clone()));
            names.push(name);
        }
    }
    [names, several]
}

/// Returns true if no name stands twice in a list.
pub(super) fn are_different(names: &[Name]) -> bool {
    let mut met = HashSet::new();
    names.iter().all(|name| met.insert(name))
}

/// The function that an equation gives.
fn function(equation: &Equation, symbols: &Symbols) -> Option<Function> {
    let Tree::Call(name, argument, _) = &equation.left else {
        return None;
    };
    let is_given = equation.relation == Relation::Equal && symbols.names.defined.contains(name);
    let names = argument.arguments().iter().map(|argument| match argument {
        Tree::Symbol(name, _) => Some(name.clone()),
        _ => None,
    });
    let arguments = names.collect::<Option<Vec<Name>>>()?;
    (is_given && are_different(&arguments)).then(|| Function {
        name: name.clone(),
        arguments,
        value: equation.right.clone(),
    })
}

impl Given {
    /// Takes what an equation gives; whether it gives a function, and is done with.
    ///
    /// # Errors
    /// The place and the reason: a function that has two definitions.
    pub(super) fn take(&mut self, equation: &Equation, symbols: &Symbols) -> Result<bool, Problem> {
        match function(equation, symbols) {
            Some(new) => self.add(new).map(|()| true).map_err(|problem| (equation.at.0, problem)),
            None => {
                self.names.extend(local(equation, symbols));
                Ok(false)
            }
        }
    }

    /// Refuses what gives a declared function by a formula in a parameter: it holds at that alone, and authors mean every argument.
    ///
    /// # Errors
    /// The place and the reason.
    pub(super) fn refuse_at_parameter(equation: &Equation, symbols: &Symbols) -> Result<(), Problem> {
        let Tree::Call(name, argument, _) = &equation.left else {
            return Ok(());
        };
        match &**argument {
            Tree::Symbol(at, _)
                if !symbols.names.defined.contains(name)
                    && symbols.is_parameter(at)
                    && at.subscript.is_empty()
                    && equation.relation == Relation::Equal
                    && speaks_of(&equation.right, at) =>
            {
                let instead = format!(
                    "leave `{name}` out of `functions` and give it by a definition, and it is given at every argument"
                );
                Err((equation.at.0, format!("gives `{name}` at `{at}` alone: {instead}")))
            }
            _ => Ok(()),
        }
    }

    /// Adds what definitions below give.
    ///
    /// # Errors
    /// The place and the reason: a function that has two definitions, or in whose formula a name stands which means
    /// something else here.
    pub(super) fn join(&mut self, below: &[&Self]) -> Result<(), Problem> {
        let functions = || below.iter().flat_map(|given| &given.functions);
        let names = || below.iter().flat_map(|given| &given.names);
        for local in &self.names {
            let is_same = names().any(|other| other == local);
            let other = functions().find(|function| !is_same && speaks_of(&function.value, &local.name));
            if let Some(function) = other {
                let problem = "stands in the definition of";
                return Err((
                    0,
                    format!(
                        "`{}` {problem} `{}`: give it another name here",
                        local.name, function.name
                    ),
                ));
            }
        }
        for function in functions() {
            self.add(function.clone()).map_err(|problem| (0, problem))?;
        }
        self.names.extend(names().cloned());
        Ok(())
    }

    fn add(&mut self, new: Function) -> Result<(), String> {
        match self.functions.iter().find(|old| old.name == new.name) {
            Some(old) if *old != new => Err(format!("`{}` is defined twice", new.name)),
            Some(_) => Ok(()),
            None => {
                self.functions.push(new);
                Ok(())
            }
        }
    }

    /// The function whose formula speaks of a name, other than as its argument.
    pub(super) fn function_of(&self, name: &Name) -> Option<&Name> {
        let speaks = |function: &&Function| !function.arguments.contains(name) && speaks_of(&function.value, name);
        self.functions.iter().find(speaks).map(|function| &function.name)
    }

    /// Whether nothing here can be written out.
    pub(super) fn is_idle(&self, symbols: &Symbols) -> bool {
        self.names.is_empty() && symbols.names.defined.is_empty()
    }

    /// Writes the functions out within each other.
    pub(super) fn close(&mut self, symbols: &Symbols) -> Result<(), Problem> {
        let applies = |value: &Tree, other: &Function| any(value, &mut |node| other.is_applied(node));
        let used = |function: &Function| {
            let all = self.functions.iter().enumerate();
            all.filter(|(_, other)| applies(&function.value, other))
                .map(|(n, _)| n)
                .collect()
        };
        let uses: Vec<Vec<usize>> = self.functions.iter().map(used).collect();
        let order = ordered(&uses).map_err(|n| {
            let name = self.functions.get(n).map(|function| function.name.to_string());
            (0, format!("`{}` is defined by itself", name.unwrap_or_default()))
        })?;
        for n in order {
            let Some(function) = self.functions.get(n) else {
                continue;
            };
            let value = self.written_out(&function.value, symbols)?;
            if let Some(function) = self.functions.get_mut(n) {
                function.value = value;
            }
        }
        Ok(())
    }

    /// The tree with functions written out where they are applied, and partial derivatives of what definitions give.
    ///
    /// # Errors
    /// The place and the reason: a function that no definition gives here, an argument beyond what `[symbols]` says of
    /// that of the function, a partial derivative that depends on what is held fixed, a tree that becomes too large.
    pub(super) fn written_out(&self, tree: &Tree, symbols: &Symbols) -> Result<Tree, Problem> {
        let out = self.written_within(tree, symbols, &Budget::of_formula())?;
        Size::of(&out).map_err(|problem| (0, problem.to_string()))?;
        Ok(out)
    }

    fn written_within(&self, tree: &Tree, symbols: &Symbols, budget: &Budget) -> Result<Tree, Problem> {
        let found: RefCell<Option<Problem>> = RefCell::new(None);
        let out = mapped(tree, &|node| {
            if found.borrow().is_some() {
                return Some(node.clone());
            }
            match self.of_node(node, symbols, budget) {
                Ok(new) => new,
                Err(problem) => {
                    found.borrow_mut().get_or_insert(problem);
                    None
                }
            }
        });
        found.into_inner().map_or(Ok(out), Err)
    }

    fn of_node(&self, node: &Tree, symbols: &Symbols, budget: &Budget) -> Result<Option<Tree>, Problem> {
        match node {
            Tree::Call(name, argument, at) if is_given(name, symbols) => {
                let (function, order) = self.of_name(name).ok_or_else(|| {
                    let problem = "is a function that another definition gives: name it among what this follows from";
                    (at.0, format!("`{name}` {problem}"))
                })?;
                let argument = self.written_within(argument, symbols, budget)?;
                let put_in = argument.arguments();
                if put_in.len() != function.arguments.len() {
                    let problem = format!("has {} arguments where it is defined", function.arguments.len());
                    return Err((at.0, format!("`{name}` {problem}, and {} here", put_in.len())));
                }
                for (own, new) in function.arguments.iter().zip(put_in) {
                    may_take(symbols, own, new).map_err(|problem| (at.0, problem))?;
                    if let Some(held) = self.held(function, own, symbols)
                        && *new != Tree::Symbol(own.clone(), *at)
                    {
                        let problem = format!("depends on `{own}` without its bracket");
                        return Err((
                            at.0,
                            format!("`{held}` stands in `{name}` and {problem}: write it out there"),
                        ));
                    }
                }
                Ok(Some(function.at(put_in, order, *at, budget)?))
            }
            // u for u(x, t)
            Tree::Symbol(name, at) if is_given(name, symbols) => {
                let function = self.of_name(name);
                function
                    .map(|(function, order)| function.at(&function.own(*at), order, *at, budget))
                    .transpose()
            }
            Tree::Operation(operation, at) => match &**operation {
                Operation::Derivative {
                    of: Tree::Symbol(name, _),
                    by,
                    order,
                    at: there,
                } => {
                    let function = self
                        .functions
                        .iter()
                        .find(|function| function.name == *name && function.arguments.contains(by))
                        .filter(|_| *there == Tree::Symbol(by.clone(), *at));
                    function
                        .map(|function| function.derived(by, *order, *at, budget))
                        .transpose()
                }
                _ => Ok(None),
            },
            Tree::Partial { of, by, at } if !symbols.has_partial(of, by) => self.partial(of, by, *at, budget),
            _ => Ok(None),
        }
    }

    /// The function of this name, and how often it is differentiated there.
    fn of_name(&self, name: &Name) -> Option<(&Function, u32)> {
        let mut functions = self.functions.iter();
        functions.find_map(|function| Some((function, is_of(name, &function.name)?)))
    }

    /// The partial derivative of what a definition gives.
    fn partial(&self, of: &Name, by: &Name, at: At, budget: &Budget) -> Result<Option<Tree>, Problem> {
        let function = self
            .functions
            .iter()
            .find(|function| function.name == *of && function.arguments.contains(by));
        if let Some(function) = function {
            return function.derived(by, 1, at, budget).map(Some);
        }
        let Some(local) = self.names.iter().find(|local| local.name == *of) else {
            return Ok(None);
        };
        let mut met: Vec<&Local> = vec![local];
        let mut next = 0;
        while let Some(local) = met.get(next) {
            let within: Vec<&Local> = self
                .names
                .iter()
                .filter(|inner| speaks_of(&local.tree, &inner.name))
                .collect();
            if let Some(inner) = within
                .iter()
                .find(|inner| next == 0 && inner.name != *by && self.rests_on(inner, by))
            {
                let problem = format!(
                    "`{}` stands in `{of}` and depends on `{by}` too: write it out, or \\frac{{d}}{{d {by}}} where it is not held fixed",
                    inner.name
                );
                return Err((at.0, problem));
            }
            met.extend(
                within
                    .into_iter()
                    .filter(|inner| !met.contains(inner))
                    .collect::<Vec<_>>(),
            );
            next += 1;
        }
        Ok(Some(derivative(
            Tree::Symbol(of.clone(), at),
            by,
            1,
            &Tree::Symbol(by.clone(), at),
            at,
        )))
    }

    /// The name in the formula of a function that depends on an argument, and would not take part where another is put in.
    fn held(&self, function: &Function, argument: &Name, symbols: &Symbols) -> Option<Name> {
        let is_time = symbols.running() == Some(argument);
        let conjugates = |name: &Name| symbols.is_conjugate_of(name, argument);
        let numbers = |name: &Name| index_of(&name.subscript, &argument.to_string()).is_some();
        let means = |name: &Name| {
            symbols
                .meaning(name, &|_| false)
                .is_some_and(|tree| speaks_of(&tree, argument))
        };
        let given = |name: &Name| {
            self.names
                .iter()
                .any(|local| local.name == *name && self.rests_on(local, argument))
        };
        let mut found = None;
        any(&function.value, &mut |node| {
            let name = match node {
                Tree::Symbol(name, _) if name == argument => return false,
                Tree::Symbol(name, _) | Tree::Partial { of: name, .. } | Tree::Invariant { of: name, .. } => name,
                _ => return false,
            };
            let runs = is_time && (symbols.names.is_function(name) || symbols.is_in_flight(name));
            let is_map = !matches!(node, Tree::Symbol(..));
            if is_map || runs || conjugates(name) || numbers(name) || means(name) || given(name) {
                found = Some(name.clone());
            }
            found.is_some()
        });
        found
    }

    /// Whether what a definition gives depends on a name, over other definitions too.
    fn rests_on(&self, local: &Local, name: &Name) -> bool {
        let (mut seen, mut open) = (vec![&local.name], vec![&local.tree]);
        while let Some(tree) = open.pop() {
            if speaks_of(tree, name) {
                return true;
            }
            for inner in self.names.iter().filter(|inner| speaks_of(tree, &inner.name)) {
                if !seen.contains(&&inner.name) {
                    seen.push(&inner.name);
                    open.push(&inner.tree);
                }
            }
        }
        false
    }
}

impl Function {
    /// Whether a node is this function, or a derivative of it, of something.
    fn is_applied(&self, node: &Tree) -> bool {
        matches!(node, Tree::Call(name, ..) | Tree::Symbol(name, _) if is_of(name, &self.name).is_some())
    }

    /// Its value where each argument is put in, or that of a derivative of a function of one.
    ///
    /// # Errors
    /// The place and the reason: a value that would be too large, a derivative of a function of several arguments.
    fn at(&self, put_in: &[Tree], order: u32, at: At, budget: &Budget) -> Result<Tree, Problem> {
        let pairs: Vec<(Name, Tree)> = self.arguments.iter().cloned().zip(put_in.iter().cloned()).collect();
        let size = Size::with(&self.value, &pairs);
        size.and_then(|size| budget.spend(size))
            .map_err(|problem| (at.0, format!("`{}` is {problem}", self.name)))?;
        match (order, pairs.as_slice()) {
            (0, _) => Ok(rewrite(&self.value, &|name| {
                let own = pairs.iter().find(|(own, _)| own == name);
                own.map(|(_, new)| new.clone())
            })),
            (_, [(by, there)]) => Ok(derivative(self.value.clone(), by, order, there, at)),
            _ => {
                let instead = "write \\frac{\\partial}{\\partial x}";
                Err((
                    at.0,
                    format!(
                        "a prime or a dot on `{}`, which has several arguments: {instead}",
                        self.name
                    ),
                ))
            }
        }
    }

    /// Its derivative by one of its arguments.
    ///
    /// # Errors
    /// The place and the reason: a value that would be too large.
    fn derived(&self, by: &Name, order: u32, at: At, budget: &Budget) -> Result<Tree, Problem> {
        let value = self.at(&self.own(at), 0, at, budget)?;
        Ok(derivative(value, by, order, &Tree::Symbol(by.clone(), at), at))
    }

    /// Its arguments as they stand in its definition.
    fn own(&self, at: At) -> Vec<Tree> {
        self.arguments
            .iter()
            .map(|name| Tree::Symbol(name.clone(), at))
            .collect()
    }
}

fn derivative(of: Tree, by: &Name, order: u32, there: &Tree, at: At) -> Tree {
    let (by, there) = (by.clone(), there.clone());
    Tree::Operation(
        Box::new(Operation::Derivative {
            of,
            by,
            order,
            at: there,
        }),
        at,
    )
}

/// How often a function is differentiated in a name that is it, with primes or dots.
fn is_of(name: &Name, function: &Name) -> Option<u32> {
    let dotted = [function.clone(), function.dotted(), function.dotted().dotted()];
    let primed = Name {
        primes: name.primes,
        ..function.clone()
    };
    match dotted.iter().position(|dotted| dotted == name) {
        Some(dots) => u32::try_from(dots).ok(),
        None => (primed == *name).then_some(u32::from(name.primes)),
    }
}

/// Whether a name is that of a function which some definition gives, perhaps with primes.
fn is_given(name: &Name, symbols: &Symbols) -> bool {
    let plain = Name {
        primes: 0,
        ..name.clone()
    };
    symbols.names.defined.contains(&plain)
}
