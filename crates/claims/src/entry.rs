//! One `[[equation]]` of a sheet: what it states, what it defines, and whether it can be read.

use super::definition::{Local, circular, inlined_in, is_defined, two_of_pair};
use super::definition::{definition, is_constant_of_integration, local};
use super::fault::{Fault, Source, Text};
use super::function::Given;
use super::implication::{
    Stated, Way, assumed, has_one_sided_sign, implication, integers_alone, is_equivalence, listed_values, new_integer,
    signs_go_together, stated_of, unseen,
};
use super::kinds::{List, is_complex_in, listed_with, lists_of};
use super::size::{Budget, Sizes};
use super::verdict::Verdict;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use texmath::{
    At, Condition, Doubt, DoubtKind, Equation, Name, Operation, Relation, Symbols, Tree, any, any_side, flies,
    holds_indefinite, index_of, is_constant, nearest, number_of, read, read_conditions, rewrite, speaks_of, tree_runs,
    with_commands,
};
use toml::Spanned;

/// What a formula is to its sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// To be decided.
    Claim,
    /// Taken as true.
    Premise,
    /// Kept as printed; read only where something follows from it.
    Definition,
}

impl std::fmt::Display for Role {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Claim => "claim",
            Self::Premise => "premise",
            Self::Definition => "definition",
        })
    }
}

/// One `[[equation]]`.
#[derive(Clone, Debug)]
pub struct Entry {
    pub label: String,
    pub role: Role,
    /// The TeX as it stands in the sheet.
    pub tex: Source,
    /// What is read of it; nothing of a definition that nothing follows from.
    pub equations: Vec<Equation>,
    /// The equations of `where`, with their sources.
    pub local: Vec<(Equation, Source)>,
    /// Substitutions in the premises, with their sources.
    pub with: Vec<(Equation, Source)>,
    /// The conditions that the formula prints and those of `assume`, with their sources.
    pub assume: Vec<(Condition, Source)>,
    /// How many of these, from the first, the formula prints.
    pub(super) printed: usize,
    /// The entries it follows from, by position in the sheet.
    pub follows_from: Vec<usize>,
    pub expect: Verdict,
    /// What else it is called: the names of the `\label` of a formula of a document.
    pub names: Vec<String>,
    /// What its verdict rests on that nobody said, as a document without comments makes one guess.
    pub guessed: Vec<String>,
    /// Its standing in a document without comments.
    pub standing: Standing,
    /// Whether it is a claim `A \Rightarrow B`.
    pub is_implication: bool,
    /// Whether it is a way of `A \Leftrightarrow B`.
    pub is_way: bool,
    /// Integers in its equations of which no condition says how they stand to other symbols, and parameters that may be
    /// constants of a solution.
    pub(super) of_some: Vec<Name>,
    /// The places of what was read of it that have more than one meaning.
    pub(super) doubts: Vec<Doubt>,
    /// Letters of it and of what it follows from that need not commute.
    pub operators: BTreeSet<String>,
    /// Those of them that are 1.
    pub identities: BTreeSet<String>,
    /// True if small letters among them are columns.
    pub columns: bool,
    /// True if the text around may say that it is a condition, or that a product of its letters is less than it looks.
    pub need_not_hold: bool,
    /// The letters of which it says that it holds for all of them.
    pub for_all: Vec<Name>,
    /// The equations of which it says or assumes that one holds.
    pub alternatives: Vec<Equation>,
    /// Why the entry cannot be read: its TeX, or a name in it that nothing declares.
    pub unread: Option<Fault>,
    /// The symbols that the entry defines for itself: those of `where`, and in a claim or definition those alone on the
    /// left of an equation.
    pub(super) own: Vec<Local>,
    /// What the entry states, definitions left out.
    pub(super) stated: Vec<Equation>,
    /// Equations of `where` that define nothing new: premises beside the others.
    pub(super) given: Vec<(Equation, Source)>,
    /// Names that some definition of the sheet must give, and where they stand.
    pub(super) borrowed: Vec<(Name, usize)>,
}

/// The standing of a formula in a document, where nobody says what it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Standing {
    /// Its author says what it is.
    #[default]
    Said,
    /// A definition.
    Definition,
    /// A law, if it does not follow from what stands before it: nothing before speaks of one of its letters.
    Law,
    /// A link of a chain.
    Link,
    /// Anything else.
    Open,
}

/// One `[[equation]]` as it stands in the file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawEntry {
    pub label: Spanned<String>,
    pub role: Role,
    pub tex: Spanned<String>,
    #[serde(default, rename = "where")]
    pub local: Vec<Spanned<String>>,
    #[serde(default)]
    pub with: Vec<Spanned<String>>,
    #[serde(default)]
    pub assume: Vec<Spanned<String>>,
    pub follows_from: Option<Vec<Spanned<String>>>,
    #[serde(default)]
    pub expect: Verdict,
    /// What else a formula of a document is called: the names of its `\label`.
    #[serde(skip)]
    pub names: Vec<String>,
    /// Guesses of a document, a clause each: with one of them nothing is refuted.
    #[serde(default)]
    pub guessed: Vec<String>,
    #[serde(default)]
    pub standing: Standing,
    /// What the notation leaves open, a question each: with one of them nothing is proved either.
    #[serde(default)]
    pub doubts: Vec<String>,
    /// Letters of it and of what it follows from that are taken for the numbers `e` and `i`, though nothing says so.
    #[serde(default)]
    pub constants: Vec<String>,
    /// Letters that are taken not to vary with others, ``"`m` as `t` varies"``, though nothing says so.
    #[serde(default)]
    pub held: Vec<String>,
    /// Labels of formulas that it follows from and that give a letter another value than one before.
    #[serde(default)]
    pub second_values: Vec<String>,
    /// Letters of it and of what it follows from that need not commute.
    #[serde(default)]
    pub operators: Vec<String>,
    /// Those of them that are 1.
    #[serde(default)]
    pub identities: Vec<String>,
    /// True if small letters among them are columns.
    #[serde(default)]
    pub columns: bool,
    /// True if the text around may say that it is a condition, or that a product of its letters is less than it looks.
    #[serde(skip)]
    pub need_not_hold: bool,
    /// Equations within the text about its letters alone, which nobody says that it follows from.
    #[serde(skip)]
    pub said: Vec<String>,
    /// The questions that a proof for real numbers leaves open, as the entry speaks of more.
    #[serde(default)]
    pub marked: Vec<String>,
    /// A reason why the entry is not read, beyond its formulas.
    pub unread: Option<String>,
    /// Which way of `A \Leftrightarrow B` the entry is.
    #[serde(skip)]
    pub way: Option<Way>,
}

impl RawEntry {
    /// Makes an entry of which nothing more is said.
    pub(super) fn new(label: Spanned<String>, role: Role, tex: Spanned<String>, expect: Verdict) -> Self {
        Self {
            label,
            role,
            tex,
            local: Vec::new(),
            with: Vec::new(),
            assume: Vec::new(),
            follows_from: None,
            expect,
            names: Vec::new(),
            guessed: Vec::new(),
            standing: Standing::Said,
            doubts: Vec::new(),
            constants: Vec::new(),
            held: Vec::new(),
            second_values: Vec::new(),
            operators: Vec::new(),
            identities: Vec::new(),
            columns: false,
            need_not_hold: false,
            said: Vec::new(),
            marked: Vec::new(),
            unread: None,
            way: None,
        }
    }

    /// The entry, or of a claim `A \Leftrightarrow B` its two ways, called `7 =>` and `7 <=`.
    pub(super) fn ways(&self) -> Vec<Self> {
        if self.role != Role::Claim || !is_equivalence(self.tex.get_ref()) {
            return vec![self.clone()];
        }
        let way = |(way, arrow): (Way, &str)| Self {
            label: Spanned::new(self.label.span(), format!("{} {arrow}", self.label.get_ref())),
            way: Some(way),
            ..self.clone()
        };
        [(Way::Right, "=>"), (Way::Left, "<=")].map(way).to_vec()
    }

    /// The label of the equivalence whose way from left to right the entry is.
    pub(super) fn label_of_both(&self) -> Option<&str> {
        let is_first = self.way == Some(Way::Right);
        is_first.then(|| self.label.get_ref().trim_end_matches(" =>"))
    }

    /// All formulas of the entry.
    pub(super) fn formulas(&self) -> impl Iterator<Item = &str> {
        let more = self.local.iter().chain(&self.with).chain(&self.assume);
        std::iter::once(&self.tex).chain(more).map(|tex| tex.get_ref().as_str())
    }

    /// The formulas that may define something: those of a definition, and those of `where`.
    pub(super) fn defining(&self) -> impl Iterator<Item = &str> {
        let own = (self.role == Role::Definition).then_some(&self.tex);
        own.into_iter().chain(&self.local).map(|tex| tex.get_ref().as_str())
    }
}

impl Entry {
    /// Takes the functions out of what the entry defines: they are written out where they are applied.
    ///
    /// # Errors
    /// The [`Fault`] of a function that is defined twice.
    pub(super) fn take_functions(&mut self, symbols: &Symbols) -> Result<Given, Fault> {
        let mut given = Given::default();
        let problem = |source: &Source, (at, problem): (usize, String)| source.fault(at, problem).of(&self.label);
        let mut rest = Vec::new();
        for (equation, source) in &self.local {
            if !given.take(equation, symbols).map_err(|found| problem(source, found))? {
                rest.push((equation.clone(), source.clone()));
            }
        }
        let mut stated = Vec::new();
        for equation in &self.equations {
            if self.role != Role::Claim {
                Given::refuse_at_parameter(equation, symbols).map_err(|found| problem(&self.tex, found))?;
            }
            let is_done = self.role == Role::Definition
                && given
                    .take(equation, symbols)
                    .map_err(|found| problem(&self.tex, found))?;
            if !is_done {
                stated.push(equation.clone());
            }
        }
        (self.local, self.equations) = (rest, stated);
        Ok(given)
    }

    /// Writes what definitions give out: functions where they are applied, partial derivatives of names; `own`
    /// are those of the entry itself.
    ///
    /// # Errors
    /// The [`Fault`] of what cannot be written out.
    pub(super) fn write_out(&mut self, own: Given, below: &[&Given], symbols: &Symbols) -> Result<(), Fault> {
        let fault = |source: &Source, (at, problem): (usize, String)| source.fault(at, problem).of(&self.label);
        let mut given = own;
        given
            .join(below)
            .and_then(|()| given.close(symbols))
            .map_err(|found| fault(&self.tex, found))?;
        if given.is_idle(symbols) {
            return Ok(());
        }
        for (equation, source) in &self.with {
            if let Tree::Symbol(name, _) = &equation.left
                && let Some(function) = given.function_of(name)
            {
                let problem =
                    format!("`{name}` stands in what gives `{function}`, where nothing is put in: write a premise");
                return Err(fault(source, (equation.at.0, problem)));
            }
        }
        let written =
            |tree: &Tree, source: &Source| given.written_out(tree, symbols).map_err(|found| fault(source, found));
        let both = |equation: &Equation, source: &Source| -> Result<Equation, Fault> {
            let (left, right) = (written(&equation.left, source)?, written(&equation.right, source)?);
            Ok(Equation {
                left,
                right,
                ..equation.clone()
            })
        };
        let each = |equations: &[(Equation, Source)]| -> Result<Vec<(Equation, Source)>, Fault> {
            let pairs = equations.iter();
            pairs
                .map(|(equation, source)| Ok((both(equation, source)?, source.clone())))
                .collect()
        };
        let stated: Vec<Equation> = self
            .equations
            .iter()
            .map(|equation| both(equation, &self.tex))
            .collect::<Result<_, _>>()?;
        let (local, with) = (each(&self.local)?, each(&self.with)?);
        let condition = |(condition, source): &(Condition, Source)| -> Result<(Condition, Source), Fault> {
            let condition = match condition {
                Condition::Relation(relation) => Condition::Relation(both(relation, source)?),
                Condition::Integer(tree) => Condition::Integer(written(tree, source)?),
            };
            Ok((condition, source.clone()))
        };
        let assume = self.assume.iter().map(condition).collect::<Result<_, _>>()?;
        (self.equations, self.local, self.with, self.assume) = (stated, local, with, assume);
        Ok(())
    }

    /// Parts what the entry defines from what it states; `shared` are definitions of entries that it follows from.
    ///
    /// # Errors
    /// The [`Fault`] of a definition given twice or by itself.
    pub(super) fn part(&mut self, symbols: &Symbols, shared: &[Local]) -> Result<(), Fault> {
        let (mut own, mut given): (Vec<Local>, _) = (Vec::new(), Vec::new());
        for (equation, source) in &self.local {
            match local(equation, symbols) {
                Some(local) if is_defined(&local.name, &own) => {
                    let problem = format!("`{}` is defined twice", local.name);
                    return Err(source.fault(equation.at.0, problem).of(&self.label));
                }
                Some(local) if symbols.uses(&local.name) => {
                    let problem = format!(
                        "`{0}` is the number {0} in [symbols]: give this another name",
                        local.name
                    );
                    return Err(source.fault(equation.at.0, problem).of(&self.label));
                }
                Some(local) => own.push(local),
                None => given.push((equation.clone(), source.clone())),
            }
        }
        let mut stated = Vec::new();
        for equation in &self.equations {
            let new = definition(equation, symbols)
                .filter(|local| self.role != Role::Premise && !is_defined(&local.name, &own))
                .filter(|local| !is_defined(&local.name, shared));
            match new {
                Some(local) => own.push(local),
                None if equation.explains && self.role != Role::Premise && definition(equation, symbols).is_none() => {
                    let problem = "a condition within a formula: write it as an `assume` of the entry";
                    return Err(self.tex.fault(equation.at.0, problem).of(&self.label));
                }
                None => stated.push(equation.clone()),
            }
        }
        if let Some(name) = circular(&own) {
            let problem = format!("`{name}` is defined by itself");
            return Err(self.tex.fault(0, problem).of(&self.label));
        }
        (self.own, self.given, self.stated) = (own, given, stated);
        Ok(())
    }

    /// Checks that each name stands for something: `shared` are the definitions that the entry may use, `elsewhere`
    /// those of other entries, for which whatever follows from this entry has to account.
    ///
    /// # Errors
    /// The [`Fault`] of the first name that stands for nothing, of a substitution that cannot be made, and of a claim
    /// that states nothing.
    pub(super) fn check(
        &mut self,
        symbols: &Symbols,
        shared: &[Local],
        elsewhere: &HashSet<Name>,
    ) -> Result<(), Fault> {
        if self.role == Role::Claim && self.stated.is_empty() {
            let name = self.own.last().map(|local| local.name.clone()).unwrap_or_default();
            let unknown = symbols.unknown(&name, 0);
            let problem = "nothing is left to decide: each left side is a symbol that is declared nowhere";
            let message = format!("{}; {problem}{}", unknown.message, unknown.known);
            return Err(self.tex.fault(0, message).of(&self.label));
        }
        self.check_size(symbols, shared)?;
        let (mut borrowed, mut faults, mut messages) = (Vec::new(), Vec::new(), HashSet::new());
        let mine = |name: &Name| is_defined(name, &self.own) || is_defined(name, shared);
        let borrows = self.role != Role::Claim;
        let approaches: Vec<Name> = self
            .assume
            .iter()
            .filter_map(|(condition, _)| approached(condition))
            .collect();
        let is_antiderivative = self.equations.iter().any(holds_indefinite);
        let mut running: HashSet<Name> = HashSet::new();
        for (tree, _) in self.trees(symbols) {
            functions_that_run(tree, symbols, &mut running);
        }
        for (tree, source) in self.trees(symbols) {
            if let Some((name, at)) = product_or_value(tree, &running, symbols) {
                let problem = format!(
                    "`{name}(...)` can be read as a value of `{name}` or as a product: write `{name} \\cdot (...)`, or give each `{name}` its argument"
                );
                return Err(source.fault(at, problem).of(&self.label));
            }
            if let Some((name, at)) = called_with_itself(tree) {
                let problem = format!(
                    "`{name}(...{name}...)` can be read as a value of `{name}` or as a product: write `{name} \\cdot (...)`"
                );
                return Err(source.fault(at, problem).of(&self.label));
            }
            let is_formula = |name: &Name| mine(name) || symbols.meaning(name, &|_| false).is_some();
            if let Some((at, problem)) = wrong_letter(tree, &source.tex, symbols, &is_formula) {
                return Err(source.fault(at, problem).of(&self.label));
            }
            let extra = |name: &Name| {
                mine(name)
                    || approaches.contains(name)
                    || (borrows && elsewhere.contains(name))
                    || (is_antiderivative && is_constant_of_integration(name))
            };
            for found in symbols.undeclared(tree, &extra) {
                if messages.insert(found.message.clone()) {
                    // The names that are known are the same for all.
                    let known = if faults.is_empty() { found.known } else { String::new() };
                    faults.push(source.fault(found.at, found.message + &known).of_unknown(found.unknown));
                }
            }
            any(tree, &mut |node| {
                if let Tree::Symbol(name, at) = node
                    && elsewhere.contains(name)
                    && !mine(name)
                    && !symbols.knows(name)
                {
                    borrowed.push((name.clone(), at.0));
                }
                false
            });
        }
        if let Some(fault) = faults.into_iter().reduce(Fault::and) {
            return Err(fault.of(&self.label));
        }
        self.check_brackets(symbols, shared)?;
        self.check_written_out(symbols, shared)?;
        self.check_order(symbols)?;
        self.check_times_of_assume(symbols)?;
        let mut replaced = HashSet::new();
        for (equation, source) in &self.with {
            let is_mine = |node: &Tree| matches!(node, Tree::Symbol(name, _) if mine(name));
            if any(&equation.right, &mut |node| is_mine(node)) {
                let problem = "what `with` puts in stands in the premises, which do not know the names of this entry: write it out";
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
            if equation.relation != Relation::Equal {
                let problem = "`with` puts one thing in for another: write what is no equation in `assume`";
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
            let is_single = |name: &Name| {
                let is_abbreviation = || symbols.abbreviation(name).is_some();
                let is_time = || symbols.running() == Some(name) || symbols.impact(name).is_some();
                symbols.is_parameter(name) || symbols.is_index_letter(name) || is_abbreviation() || is_time()
            };
            let is_impact = |tree: &Tree| matches!(tree, Tree::Symbol(time, _) if symbols.impact(time).is_some());
            let name = match &equation.left {
                Tree::Symbol(name, _) if is_single(name) => name,
                // the value of a state at an impact, which is given beside the premises
                Tree::Call(state, time, _) if symbols.is_state(&state.bare()) && is_impact(time) => continue,
                _ => {
                    let problem = "`with` puts something in for a symbol: write what else holds as a premise";
                    return Err(source.fault(equation.at.0, problem).of(&self.label));
                }
            };
            if self.role != Role::Claim {
                let problem = "`with` puts something into the premises of a claim: this entry has none";
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
            let runs =
                |node: &Tree| matches!(node, Tree::Symbol(other, _) if other != name && is_running(symbols, other));
            if any(&equation.right, &mut |node| runs(node)) {
                let problem = "what runs in the premises cannot be put in: it would be taken for theirs";
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
            let is_replaced = !symbols.is_indexed(name) && !symbols.is_index_letter(name);
            if let Some(listed) = listed_with(symbols, name).filter(|_| is_replaced) {
                let problem =
                    format!("`{name}` stands in `{listed}`, of which [symbols] says what it may be: write a premise");
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
            if !replaced.insert(name) {
                let problem = format!("`{name}` is replaced twice");
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
            if symbols.is_index_letter(name)
                && index_of(&equation.right.to_string().replace(' ', ""), &symbols.index).is_none()
            {
                let problem = format!("`{name}` can be replaced by `{name}+1` and the like only");
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
        }
        self.check_shift(symbols)?;
        let declared = self
            .stated
            .iter()
            .find(|equation| matches!(&equation.left, Tree::Symbol(name, _) if symbols.declares(name)));
        if let Some(equation) =
            declared.filter(|equation| self.role == Role::Definition && equation.relation == Relation::Equal)
        {
            let problem = format!(
                "`{}` is declared in [symbols]: a definition gives a new name, what else holds is a premise",
                equation.left
            );
            return Err(self.tex.fault(equation.at.0, problem).of(&self.label));
        }
        if let Some((_, source)) = self.assume.first().filter(|_| self.role == Role::Definition) {
            let problem = "a definition says what a name stands for: write what else holds as a premise";
            return Err(source.fault(0, problem).of(&self.label));
        }
        if let Some(local) = self.unused().first().filter(|_| self.role == Role::Definition) {
            let problem = format!(
                "`{}` is not used in what this definition gives: leave it out",
                local.name
            );
            return Err(self.tex.fault(0, problem).of(&self.label));
        }
        let declared = self.declared_of_with(symbols)?;
        self.assume.extend(declared);
        self.borrowed = borrowed;
        Ok(())
    }

    /// Refuses what would be too large with its definitions and abbreviations put in.
    fn check_size(&self, symbols: &Symbols, shared: &[Local]) -> Result<(), Fault> {
        // what is defined by itself is said where a claim rests on it
        let locals: Vec<Local> = self.own.iter().chain(shared).cloned().collect();
        if circular(&locals).is_some() {
            return Ok(());
        }
        let mut sizes = Sizes::within_sheet(symbols, locals.iter().map(Local::pair));
        let budget = Budget::of_claim();
        for (tree, source) in self.trees(symbols) {
            sizes
                .of(tree)
                .and_then(|size| budget.spend(size))
                .map_err(|problem| source.fault(0, problem.to_string()).of(&self.label))?;
        }
        Ok(())
    }

    /// Refuses a bracket behind a name that stands for something at every time: it may hold a time or a factor.
    fn check_brackets(&self, symbols: &Symbols, shared: &[Local]) -> Result<(), Fault> {
        let abbreviations = symbols.abbreviations();
        let locals = self.own.iter().chain(shared).map(|local| (&local.name, &local.tree));
        let moves = |tree: &Tree| symbols.is_law(&Equation::between(tree.clone(), tree.clone()));
        let moving = abbreviations.chain(locals).filter(|(_, tree)| moves(tree));
        let moving: Vec<String> = moving
            .map(|(name, _)| format!("{}(", name.to_string().replace(' ', "")))
            .collect();
        let mut sources: Vec<&Source> = self.trees(symbols).into_iter().map(|(_, source)| source).collect();
        sources.dedup_by(|one, other| one.tex == other.tex);
        for source in sources {
            let shown = with_commands(&source.tex)
                .replace(r"\left", "")
                .replace(char::is_whitespace, "");
            let called = |name: &&String| {
                let before = |at: usize| shown.get(..at).and_then(|before| before.chars().next_back());
                let mut found = shown.match_indices(name.as_str());
                found.any(|(at, _)| !before(at).is_some_and(char::is_alphabetic))
            };
            if let Some(name) = moving.iter().find(called) {
                let name = name.trim_end_matches('(');
                let problem = format!(
                    "`{name}(...)` can be read as a value of `{name}` or as a product: write `{name} \\cdot (...)`"
                );
                return Err(source.fault(0, problem).of(&self.label));
            }
        }
        Ok(())
    }

    /// Refuses what the reader writes out where that does not hold: degrees where `\pi` is declared to be something
    /// else, and a maximum of values that may be complex.
    fn check_written_out(&self, symbols: &Symbols, shared: &[Local]) -> Result<(), Fault> {
        let pi = Name {
            base: r"\pi".to_string(),
            ..Name::default()
        };
        let has_degrees = |tex: &str| {
            ["\\circ", "\\degree", "\\textdegree", "°"]
                .iter()
                .any(|sign| tex.contains(sign))
        };
        let complex = self.complex_definitions(symbols);
        let is_defined = |name: &Name| {
            let mut foreign = shared.iter().filter(|local| local.name == *name);
            complex.contains(name) || foreign.any(|local| symbols.may_be_complex(&local.tree))
        };
        for (tree, source) in self.trees(symbols) {
            if symbols.declares(&pi) && has_degrees(&source.tex) {
                let problem = "a degree is \\pi/180, and `\\pi` is declared to be something else";
                return Err(source.fault(0, problem).of(&self.label));
            }
            let mut found = None;
            any(&rewrite(tree, &|name| symbols.meaning(name, &|_| false)), &mut |node| {
                let values = node.extremum_of().into_iter().flatten();
                found = values
                    .filter_map(|value| symbols.complex_in(value, &is_defined))
                    .next()
                    .cloned();
                found.is_some()
            });
            if let Some(name) = found {
                let problem = format!("`{name}` is complex, and complex values have no order");
                return Err(source.fault(0, problem).of(&self.label));
            }
        }
        Ok(())
    }

    /// Refuses a shift of the index beside something put in for what the index counts: which comes first would matter.
    fn check_shift(&self, symbols: &Symbols) -> Result<(), Fault> {
        let replaces = |test: &dyn Fn(&Name) -> bool| {
            let replaced = self.with.iter();
            let found =
                |(equation, _): &&(Equation, Source)| matches!(&equation.left, Tree::Symbol(name, _) if test(name));
            replaced
                .filter(found)
                .map(|(equation, source)| (equation, source))
                .next()
        };
        let counted = |name: &Name| {
            let is_abbreviation = symbols.abbreviation(name).is_some();
            is_abbreviation || symbols.is_indexed(name)
        };
        match (replaces(&|name| symbols.is_index_letter(name)), replaces(&counted)) {
            (Some(_), Some((equation, source))) => {
                let problem = "which comes first, the shift of the index or this? write it as a premise";
                Err(source.fault(equation.at.0, problem).of(&self.label))
            }
            _ => Ok(()),
        }
    }

    /// Refuses what `with` does not put in everywhere: a complex number whose conjugate stands there too, and the time of an
    /// impact for that of a flight, except at its end: at the start a state that an impact changes has two values, and beyond
    /// the end the law says nothing.
    ///
    /// # Errors
    /// The [`Fault`] of the substitution.
    pub(super) fn check_put_in(&self, law: &Equation, locals: &[Local], symbols: &Symbols) -> Result<(), Fault> {
        let written = inlined_in(law, locals).map(|law| symbols.expanded(&law));
        for (equation, source) in &self.with {
            let Tree::Symbol(name, _) = &equation.left else {
                continue;
            };
            let mut conjugates =
                |node: &Tree| matches!(node, Tree::Symbol(other, _) if symbols.is_conjugate_of(other, name));
            if symbols.is_complex(name)
                && written
                    .as_ref()
                    .is_none_or(|written| any_side(written, &mut conjugates))
            {
                let problem = format!(
                    "the conjugate of `{name}` stands there too, which is not put in: write what holds as a premise"
                );
                return Err(source.fault(equation.at.0, problem).of(&self.label));
            }
        }
        let at_impact = self
            .with
            .iter()
            .find_map(|(equation, source)| match (&equation.left, &equation.right) {
                (Tree::Symbol(name, _), Tree::Symbol(time, _)) if symbols.running() == Some(name) => {
                    Some((equation, source, symbols.impact(time)?))
                }
                _ => None,
            });
        let Some((equation, source, impact)) = at_impact else {
            return Ok(());
        };
        let Some(written) = inlined_in(law, locals) else {
            let problem = "what this is put into is too large once its definitions are put in";
            return Err(source.fault(equation.at.0, problem).of(&self.label));
        };
        let others = self.with.iter().filter_map(|(other, _)| match &other.left {
            Tree::Symbol(name, _) if symbols.running() != Some(name) => Some((name.clone(), other.right.clone())),
            _ => None,
        });
        let others: Vec<(Name, Tree)> = others.collect();
        let written = symbols.substituted(&symbols.expanded(&written), &others);
        let first = symbols.impacts(&written).first().copied();
        let is_kept = |name: &Name| {
            let bare = Name {
                primes: 0,
                ..name.bare()
            };
            name.primes == 0 && symbols.is_continuous(&bare)
        };
        let mut changes = |node: &Tree| match node {
            Tree::Call(name, ..) | Tree::Symbol(name, _) => {
                name.subscript.is_empty() && symbols.is_in_flight(name) && !is_kept(name)
            }
            _ => false,
        };
        let is_end = first.is_some_and(|first| impact == first + 1);
        let is_start = first.is_none_or(|first| impact == first);
        if !flies(&written, symbols) || is_end || (is_start && !any_side(&written, &mut changes)) {
            return Ok(());
        }
        let problem =
            "the law is one of a flight, and this no time within it or two values there: write what holds as a premise";
        Err(source.fault(equation.at.0, problem).of(&self.label))
    }

    /// What `[symbols]` says of the symbols that `with` replaces, said of what is put in; a number is held against it here.
    fn declared_of_with(&self, symbols: &Symbols) -> Result<Vec<(Condition, Source)>, Fault> {
        let mut declared = Vec::new();
        for (equation, source) in &self.with {
            let Tree::Symbol(name, _) = &equation.left else {
                continue;
            };
            let fault = |problem: String| Err(source.fault(equation.at.0, problem).of(&self.label));
            let is_said = symbols.declares(name) && !symbols.is_index_letter(name);
            if is_said && !symbols.is_complex(name) && is_complex_in(symbols, &equation.right) {
                return fault(format!("`{name}` is real: it cannot be {}", equation.right));
            }
            let number = number_of(&equation.right);
            let is_said_already = |list: &List| matches!(&equation.right, Tree::Symbol(other, _) if lists_of(symbols, other).contains(list));
            for list in lists_of(symbols, name) {
                match &number {
                    Some(number) if !list.allows(number) => {
                        let problem = format!("`{name}` stands in `{}`: it cannot be {}", list.name, equation.right);
                        return fault(problem);
                    }
                    Some(_) => {}
                    None if is_said_already(&list) => {}
                    None => declared.push((list.said_of(equation), source.clone())),
                }
            }
        }
        Ok(declared)
    }

    /// Refuses a condition on the running time that does not hold at one time, that of what the entry states.
    fn check_times_of_assume(&self, symbols: &Symbols) -> Result<(), Fault> {
        let runs = |tree: &Tree| tree_runs(tree, symbols);
        let moves = |tree: &Tree| {
            any(tree, &mut |node| match node {
                Tree::Call(name, argument, _) => symbols.names.is_function(name) && runs(argument),
                Tree::Symbol(name, _) => symbols.names.is_function(name) && runs(node),
                _ => false,
            })
        };
        let stated = self
            .stated
            .iter()
            .flat_map(|equation| [&equation.left, &equation.right]);
        let is_of_one_time = stated.chain(self.own.iter().map(|local| &local.tree)).any(runs);
        for (condition, source) in &self.assume {
            let (sides, at, is_equation) = match condition {
                Condition::Relation(relation) => {
                    let is_equation = relation.relation == Relation::Equal;
                    (vec![&relation.left, &relation.right], relation.at.0, is_equation)
                }
                Condition::Integer(tree) => (vec![tree], 0, false),
            };
            let is_law = is_equation && sides.iter().any(|side| moves(side));
            if sides.iter().any(|side| runs(side)) && (is_law || !is_of_one_time) {
                let problem =
                    "a condition is one at the time of the formula: write what holds at every time as a premise";
                return Err(source.fault(at, problem).of(&self.label));
            }
        }
        Ok(())
    }

    /// Refuses an inequality between values that may be complex.
    fn check_order(&self, symbols: &Symbols) -> Result<(), Fault> {
        let conditions = self.assume.iter().filter_map(|(condition, source)| match condition {
            Condition::Relation(relation) => Some((relation, source)),
            Condition::Integer(_) => None,
        });
        let stated = self.equations.iter().map(|equation| (equation, &self.tex));
        let ordered = |relation: Relation| !matches!(relation, Relation::Equal | Relation::NotEqual);
        let mut complex: Option<HashSet<&Name>> = None;
        for (equation, source) in stated
            .chain(conditions)
            .filter(|(equation, _)| ordered(equation.relation))
        {
            let defined = complex.get_or_insert_with(|| self.complex_definitions(symbols));
            for side in [&equation.left, &equation.right] {
                if let Some(name) = symbols.complex_in(side, &|name| defined.contains(name)) {
                    let problem = format!("`{name}` is complex, and complex values have no order");
                    return Err(source.fault(equation.at.0, problem).of(&self.label));
                }
            }
        }
        Ok(())
    }

    /// The symbols that the entry defines by an expression that may be complex.
    fn complex_definitions(&self, symbols: &Symbols) -> HashSet<&Name> {
        let mut complex = HashSet::new();
        loop {
            let new = self.own.iter().find(|local| {
                let known = |name: &Name| complex.contains(name);
                !complex.contains(&local.name) && symbols.complex_in(&local.tree, &known).is_some()
            });
            match new {
                Some(local) => complex.insert(&local.name),
                None => return complex,
            };
        }
    }

    /// What the entry states or assumes, side by side.
    pub(super) fn said(&self) -> Vec<&Tree> {
        let given = self.given.iter().map(|(equation, _)| equation);
        let mut said: Vec<&Tree> = Vec::new();
        for equation in self.stated.iter().chain(given) {
            said.extend([&equation.left, &equation.right]);
        }
        for (condition, _) in &self.assume {
            match condition {
                Condition::Relation(equation) => said.extend([&equation.left, &equation.right]),
                Condition::Integer(tree) => said.push(tree),
            }
        }
        said
    }

    /// The names of its own that the entry does not use, over others neither; those that a definition gives are used.
    pub(super) fn unused(&self) -> Vec<&Local> {
        let beside = |name: &Name| {
            self.local
                .iter()
                .any(|(equation, _)| matches!(&equation.left, Tree::Symbol(own, _) if own == name))
        };
        let (mut unused, given): (Vec<&Local>, Vec<&Local>) = self
            .own
            .iter()
            .partition(|local| self.role != Role::Definition || beside(&local.name));
        let mut open = self.said();
        open.extend(given.iter().map(|local| &local.tree));
        while let Some(tree) = open.pop() {
            let (used, rest): (Vec<&Local>, Vec<&Local>) =
                unused.into_iter().partition(|local| speaks_of(tree, &local.name));
            open.extend(used.iter().map(|local| &local.tree));
            unused = rest;
        }
        unused
    }

    /// The names that the entry defines.
    pub fn gives(&self) -> Vec<Name> {
        self.own.iter().map(|local| local.name.clone()).collect()
    }

    /// Both sides of everything that the entry says, with their sources; a shift of the index, as `k = k+1`, left out.
    pub(super) fn trees(&self, symbols: &Symbols) -> Vec<(&Tree, &Source)> {
        let stated = self.equations.iter().flat_map(|equation| sides(equation, &self.tex));
        let local = self.local.iter().flat_map(|(equation, source)| sides(equation, source));
        let is_shift = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if symbols.is_index_letter(name));
        let with = self.with.iter().filter(|(equation, _)| !is_shift(&equation.left));
        let with = with.flat_map(|(equation, source)| sides(equation, source));
        let assume = self.assume.iter().flat_map(|(condition, source)| match condition {
            Condition::Relation(relation) => sides(relation, source).to_vec(),
            Condition::Integer(tree) => vec![(tree, source)],
        });
        stated.chain(local).chain(with).chain(assume).collect()
    }
}

/// A name in whose argument it stands itself, as in q(1-q), and where.
fn called_with_itself(tree: &Tree) -> Option<(Name, usize)> {
    let mut found = None;
    any(tree, &mut |node| {
        if let Tree::Call(name, argument, at) = node
            && any(
                argument,
                &mut |inner| matches!(inner, Tree::Symbol(same, _) if same == name),
            )
        {
            found = Some((name.clone(), at.0));
        }
        found.is_some()
    });
    found
}

/// Takes the functions that stand in a tree at the running time, or without an argument.
fn functions_that_run(tree: &Tree, symbols: &Symbols, found: &mut HashSet<Name>) {
    let runs = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if Some(name) == symbols.names.running.as_ref());
    any(tree, &mut |node| {
        match node {
            Tree::Symbol(name, _) if symbols.names.is_function(name) => drop(found.insert(name.clone())),
            Tree::Call(name, argument, _) if symbols.names.is_function(name) && runs(argument) => {
                found.insert(name.clone());
            }
            _ => {}
        }
        false
    });
}

/// A function of time before a bracket of several terms or factors that is no time, while it stands at the running time too, and
/// where: as in `\dot{x} (m \ddot{x} + k x)`, a product.
fn product_or_value(tree: &Tree, running: &HashSet<Name>, symbols: &Symbols) -> Option<(Name, usize)> {
    let is_time = |node: &Tree| match node {
        Tree::Symbol(name, _) => {
            let is_named = matches!(name.base.as_str(), "t" | "T" | "s" | r"\tau");
            is_named || Some(name) == symbols.names.running.as_ref() || symbols.is_index_letter(name)
        }
        _ => false,
    };
    // a value within is at a time of its own
    fn speaks_of_time(tree: &Tree, is_time: &dyn Fn(&Tree) -> bool) -> bool {
        match tree {
            Tree::Call(..) => false,
            tree if is_time(tree) => true,
            tree => tree
                .find_below(&mut |part| speaks_of_time(part, is_time).then_some(()))
                .is_some(),
        }
    }
    let mut found = None;
    any(tree, &mut |node| {
        if let Tree::Call(name, argument, at) = node
            && running.contains(name)
            && matches!(**argument, Tree::Sum(_) | Tree::Product(_))
            && any(argument, &mut |node| matches!(node, Tree::Symbol(..) | Tree::Call(..)))
            && !speaks_of_time(argument, &is_time)
        {
            found = Some((name.clone(), at.0));
        }
        found.is_some()
    });
    found
}

/// What is wrong with a letter of an operation, and where: a complex one that counts terms, or one that stands for a
/// formula and is differentiated by.
fn wrong_letter(
    tree: &Tree,
    tex: &str,
    symbols: &Symbols,
    is_formula: &dyn Fn(&Name) -> bool,
) -> Option<(usize, String)> {
    let applies = |of: &Tree, by: &Name| any(of, &mut |node| matches!(node, Tree::Call(name, ..) if name == by));
    let is_function = |name: &Name| symbols.names.is_function(name);
    let runs = |name: &Name| symbols.names.running.as_ref() == Some(name);
    let is_partial = |by: &Name| {
        let mut parts = tex
            .match_indices(r"\partial")
            .filter_map(|(at, sign)| tex.get(at + sign.len()..));
        let bare = |text: &str| text.replace(['{', '}', ' '], "");
        parts.any(|behind| bare(behind).starts_with(&bare(&by.to_string())))
    };
    // more than a function that is known by its name alone
    let moves = |of: &Tree, by: &Name| {
        let is_it = |node: &Tree| match node {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => name != by && (is_function(name) || is_formula(name)),
            _ => false,
        };
        !matches!(of, Tree::Symbol(name, _) | Tree::Call(name, ..) if is_function(name))
            && any(of, &mut |node| is_it(node))
    };
    // `\frac{d x(0)}{dt}`: the derivative there, and no derivative of a constant
    let is_value_elsewhere = |of: &Tree, by: &Name| {
        let names_it = |node: &Tree| matches!(node, Tree::Symbol(name, _) if name == by || is_function(name));
        let is_value = |node: &Tree| matches!(node, Tree::Call(name, ..) if is_function(name));
        any(of, &mut |node| is_value(node)) && !any(of, &mut |node| names_it(node))
    };
    let is_on_its_own = |of: &Name, by: &Name| {
        let is_free = if is_function(of) {
            !runs(by)
        } else {
            !is_constant(of) && !is_formula(of)
        };
        of != by && is_free && !is_function(by)
    };
    let speaks_of_others = |of: &Tree, by: &Name| {
        let is_other = |name: &Name| name != by && (is_function(name) || runs(name));
        is_function(by)
            && any(
                of,
                &mut |node| matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..) if is_other(name)),
            )
    };
    let holds_operation = |of: &Tree| any(of, &mut |node| matches!(node, Tree::Operation(..)));
    // a function without its argument, where no letter runs that it would be a function of
    let of_nothing = |of: &Tree, by: &Name| {
        let mut bare = None;
        any(of, &mut |node| {
            if let Tree::Symbol(name, _) = node
                && is_function(name)
                && name != by
                && symbols.names.running.is_none()
            {
                bare = Some(name.clone());
            }
            bare.is_some()
        });
        bare
    };
    let mut found = None;
    any(tree, &mut |node| {
        if let Tree::Operation(operation, at) = node {
            let problem = match &**operation {
                Operation::Series { index, .. } if symbols.is_complex(index) => {
                    let problem = "is complex, and counts the terms here: give one of the two another name";
                    Some(format!("`{index}` {problem}"))
                }
                Operation::Derivative { by, .. } if is_formula(by) => {
                    Some(format!("`{by}` stands for a formula: nothing is differentiated by it"))
                }
                Operation::Derivative { of, by, .. } if applies(of, by) => {
                    Some(format!("`{by}` is a function here, and a letter that runs"))
                }
                // by convention the partial one holds the others fixed (Goldstein, Classical Mechanics, section 1.4)
                Operation::Derivative { of, by, order: 1.., .. }
                    if speaks_of_others(of, by) && (!is_partial(by) || holds_operation(of)) =>
                {
                    Some(format!(
                        "`{by}` is a function, and others move with it: say by the chain rule what is meant"
                    ))
                }
                Operation::Derivative { of, by, order: 1.., .. } if runs(by) && is_partial(by) && moves(of, by) => {
                    Some(format!(
                        "a partial derivative by `{by}` of what moves with it: write `\\frac{{d}}{{d{by}}}`, or say by names what is held fixed"
                    ))
                }
                Operation::Derivative { of, by, order: 1.., .. } if is_value_elsewhere(of, by) => Some(format!(
                    "a derivative by `{by}` of a value that does not move with it: is it the derivative there?"
                )),
                Operation::Derivative {
                    of: Tree::Symbol(of, _),
                    by,
                    order: 1..,
                    ..
                } if is_on_its_own(of, by) => Some(format!(
                    "whether `{of}` depends on `{by}` is not said: give it by a definition, or as a function"
                )),
                Operation::Derivative { of, by, order: 1.., .. }
                | Operation::Integral { of, by, .. }
                | Operation::Limit { of, by, .. }
                    if of_nothing(of, by).is_some() =>
                {
                    of_nothing(of, by).map(|name| {
                        format!(
                            "whether `{name}` depends on `{by}` is not said: write `{name}({by})`, or say with `times` what runs"
                        )
                    })
                }
                Operation::Integral { of, by: letter, .. } | Operation::Limit { of, by: letter, .. }
                    if applies(of, letter) || speaks_of_others(of, letter) =>
                {
                    Some(format!(
                        "`{letter}` runs here, and is a function beside others that may move with it"
                    ))
                }
                // the index of a sum is another letter, as authors bind it
                Operation::Integral { by: letter, .. } | Operation::Limit { by: letter, .. } if is_formula(letter) => {
                    Some(format!(
                        "`{letter}` stands for a formula, and runs here: give one of the two another name"
                    ))
                }
                _ => None,
            };
            found = problem.map(|problem| (at.0, problem));
        }
        found.is_some()
    });
    found
}

/// Whether a name runs over times or indices.
fn is_running(symbols: &Symbols, name: &Name) -> bool {
    symbols.running() == Some(name) || symbols.is_index(name)
}

/// Both sides of an equation with its source.
fn sides<'a>(equation: &'a Equation, source: &'a Source) -> [(&'a Tree, &'a Source); 2] {
    [(&equation.left, source), (&equation.right, source)]
}

/// Reads an entry; what cannot be read of it is kept in `unread`, a label in `follows_from` that no entry has too. Of one that
/// is not `wanted` the TeX is kept alone.
/// Returns what to say of TeX of which TOML has read a backslash and a letter, `"\frac"`, as one character.
fn escaped(tex: &str) -> Option<String> {
    // what follows the letters of commands that begin with `\t`, `\r` and `\n`
    const BEHIND: [(char, char, &[&str]); 5] = [
        ('\u{c}', 'f', &[""]),
        ('\u{8}', 'b', &[""]),
        ('\t', 't', &["heta", "an", "imes", "ext", "au", "frac", "o ", "ilde"]),
        ('\r', 'r', &["ho", "ight"]),
        ('\n', 'n', &["abla", "eq", "u ", "u_", "u^"]),
    ];
    let (letter, _) = BEHIND.iter().find_map(|(character, letter, behind)| {
        let mut places = tex.match_indices(*character);
        let is_command = |(at, found): &(usize, &str)| {
            let rest = tex.get(at + found.len()..).unwrap_or_default();
            behind.iter().any(|own| rest.starts_with(own))
        };
        places.find(is_command).map(|place| (*letter, place))
    })?;
    Some(format!(
        "between double quotes TOML reads `\\{letter}` as one character: write the TeX between ''', where a backslash stands for itself"
    ))
}

pub(super) fn read_entry(
    lines: &Text,
    raw: &RawEntry,
    positions: &BTreeMap<&str, usize>,
    symbols: &Symbols,
    wanted: bool,
) -> Entry {
    let tex = Source::new(lines, &raw.tex);
    let mut faults: Vec<Fault> = raw.unread.iter().map(|problem| tex.fault(0, problem)).collect();
    faults.extend(escaped(raw.tex.get_ref()).map(|problem| tex.fault(0, problem)));
    let mut follows_from = Vec::new();
    let mut seen = HashSet::new();
    for label in raw.follows_from.iter().flatten() {
        match positions.get(label.get_ref().as_str()) {
            Some(&position) if seen.insert(position) => follows_from.push(position),
            Some(_) => {}
            None => faults.push(no_label(label.get_ref(), positions).at(&Source::new(lines, label))),
        }
    }
    let implication = match raw.role {
        Role::Claim => implication(&tex, raw.way),
        _ => None,
    };
    if let Some(sides) = implication.as_ref().filter(|sides| signs_go_together(sides)) {
        let problem = "signs on both sides of an arrow go together: give each sign an entry of its own";
        faults.push(sides.1.fault(0, problem));
    }
    let mut keep = |read: Result<Vec<Equation>, Fault>| {
        read.unwrap_or_else(|fault| {
            faults.push(fault);
            Vec::new()
        })
    };
    let (mut assume, mut alternatives, mut for_all) = (Vec::new(), Vec::new(), Vec::new());
    let equations = if wanted {
        let rests_on_nothing = raw.follows_from.as_ref().is_none_or(Vec::is_empty) && raw.local.is_empty();
        let is_identity = rests_on_nothing && raw.assume.is_empty() && implication.is_none();
        let source = implication.as_ref().map_or(&tex, |(_, then)| then);
        keep(
            stated(source, symbols, raw.role, [is_identity, implication.is_some()]).map(|stated| {
                let printed = stated.display.conditions.into_iter();
                assume.extend(printed.map(|condition| (condition, source.clone())));
                alternatives = stated.alternatives;
                for_all = stated.display.for_all;
                stated.display.equations
            }),
        )
    } else {
        Vec::new()
    };
    let mut sourced = |list: &[Spanned<String>]| -> Vec<(Equation, Source)> {
        let sources = list.iter().filter(|_| wanted).map(|value| Source::new(lines, value));
        let read = sources.map(|source| {
            let equations = keep(read_tex(&source, symbols));
            equations.into_iter().map(move |equation| (equation, source.clone()))
        });
        read.flatten().collect()
    };
    let (local, with) = (sourced(&raw.local), sourced(&raw.with));
    let mut conditions = |source: &Source, read: Result<Vec<Condition>, Fault>| -> Vec<(Condition, Source)> {
        let read = read.unwrap_or_else(|fault| {
            faults.push(fault);
            Vec::new()
        });
        read.into_iter().map(|condition| (condition, source.clone())).collect()
    };
    let is_implication = implication.is_some();
    let when = implication.into_iter().map(|(when, _)| when).filter(|_| wanted);
    let given = assume.len();
    let (mut unseen_at, mut among) = (None, Vec::new());
    for source in when {
        let read = assumed(&source, &symbols.names);
        let read = read.map(|(read, alternatives)| {
            unseen_at = unseen(&equations, &alternatives);
            among.extend(alternatives);
            read
        });
        assume.extend(conditions(&source, read));
    }
    let printed = assume.len();
    for value in raw.assume.iter().filter(|_| wanted) {
        let source = Source::new(lines, value);
        let read = read_conditions(&source.tex, &symbols.names);
        assume.extend(conditions(&source, read.map_err(|error| source.misread(&error))));
    }
    let mut of_some = Vec::new();
    if raw.role == Role::Claim {
        let (beside, given) = assume.split_at(given.min(assume.len()));
        of_some = integers_alone(&equations, [beside, given], symbols);
        let stated = if alternatives.is_empty() {
            &equations
        } else {
            &alternatives
        };
        let new = is_implication
            .then(|| new_integer(stated, given, beside, symbols))
            .flatten();
        let is_unseen = unseen_at.map(|at| {
            let problem =
                "this may have no value where one of the alternatives holds: give each of them an entry of its own";
            (at, problem.to_owned())
        });
        let problem = new.or(is_unseen).or_else(|| listed_values(&equations));
        faults.extend(problem.map(|(at, problem)| tex.fault(at, problem)));
    }
    let conditions = assume.iter().filter_map(|(condition, _)| match condition {
        Condition::Relation(relation) => Some(relation),
        Condition::Integer(_) => None,
    });
    let beside = local.iter().chain(&with).map(|(equation, _)| equation);
    let mut doubts = noted(
        equations
            .iter()
            .chain(&alternatives)
            .chain(&among)
            .chain(beside)
            .chain(conditions),
    );
    let open = raw.doubts.iter().cloned().map(DoubtKind::Open);
    let constants = raw.constants.iter().cloned().map(DoubtKind::Constant);
    let held = raw.held.iter().cloned().map(DoubtKind::Held);
    let second_values = raw.second_values.iter().cloned().map(DoubtKind::SecondValue);
    let marked = raw.marked.iter().cloned().map(DoubtKind::Marked);
    let kinds = open.chain(constants).chain(held).chain(second_values).chain(marked);
    doubts.extend(kinds.map(|kind| Doubt {
        kind,
        at: At::default(),
    }));
    Entry {
        label: raw.label.get_ref().clone(),
        role: raw.role,
        doubts,
        operators: raw.operators.iter().cloned().collect(),
        identities: raw.identities.iter().cloned().collect(),
        columns: raw.columns,
        need_not_hold: raw.need_not_hold,
        equations,
        local,
        with,
        assume,
        printed,
        follows_from,
        is_implication,
        is_way: raw.way.is_some(),
        of_some,
        for_all,
        alternatives: [alternatives, among].concat(),
        expect: raw.expect,
        names: raw.names.clone(),
        guessed: raw.guessed.clone(),
        standing: raw.standing,
        unread: faults
            .into_iter()
            .reduce(Fault::and)
            .map(|fault| fault.of(raw.label.get_ref())),
        tex,
        own: Vec::new(),
        stated: Vec::new(),
        given: Vec::new(),
        borrowed: Vec::new(),
    }
}

/// What a condition says to tend to something.
pub(super) fn approached(condition: &Condition) -> Option<Name> {
    match condition {
        Condition::Relation(relation) => match (&relation.left, &relation.right) {
            (Tree::Symbol(name, _), Tree::Operation(operation, _)) => {
                matches!(**operation, Operation::Approaches(_)).then(|| name.clone())
            }
            _ => None,
        },
        Condition::Integer(_) => None,
    }
}

/// Labels shown in a message.
const MOST_LABELS: usize = 40;

fn no_label(found: &str, positions: &BTreeMap<&str, usize>) -> Fault {
    let mut known: Vec<(&usize, &str)> = positions.iter().map(|(label, position)| (position, *label)).collect();
    known.sort_unstable();
    let shown: Vec<&str> = known.iter().take(MOST_LABELS).map(|(_, label)| *label).collect();
    let more = known.len().saturating_sub(MOST_LABELS);
    let more = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    let meant = nearest(found, known.iter().map(|(_, label)| *label));
    let meant = meant.map_or(String::new(), |label| format!("did you mean `{label}`? "));
    Fault::new(format!(
        "follows from `{found}`, which is no label here ({meant}there are: {}{more})",
        shown.join(", ")
    ))
}

/// What a formula of this role states, and the conditions on it. An inequality behind an equation, `, \\quad x < 0`, is a
/// condition of an identity where it compares a symbol with a number or another symbol; of other claims it could be
/// either, and of a premise or definition it is one statement more.
fn stated(
    source: &Source,
    symbols: &Symbols,
    role: Role,
    [is_identity, is_implied]: [bool; 2],
) -> Result<Stated, Fault> {
    let mut stated = stated_of(source, &symbols.names, is_implied)?;
    let display = &mut stated.display;
    if role != Role::Claim {
        if let Some(at) = display.conditions_at {
            let problem = format!("a {role} under a condition: what holds only there cannot be taken as true");
            return Err(source.fault(at, problem));
        }
        let runs = |name: &&Name| symbols.is_time(name) || symbols.is_index(name);
        if let Some(name) = display.for_all.iter().find(|name| !runs(name)) {
            let problem =
                format!("`{name}` has one value in this sheet: a {role} that holds for all of them is not read");
            return Err(source.fault(0, problem));
        }
        if let Some(limited) = display
            .beside
            .iter()
            .find(|beside| limits_law(&display.equations, beside))
        {
            let problem = format!("`{limited}` says where the function is given so: a {role} holds everywhere");
            return Err(source.fault(limited.at.0, problem));
        }
        display.equations.append(&mut display.beside);
    }
    for equation in std::mem::take(&mut display.beside) {
        if !(is_identity && is_bare(&equation.left) && is_bare(&equation.right)) {
            let problem = format!(
                "`{equation}` can be a condition or one claim more: write `\\text{{for }} {equation}`, or give it an entry of its own"
            );
            return Err(source.fault(equation.at.0, problem));
        }
        display.conditions.push(Condition::Relation(equation));
    }
    display.equations = std::mem::take(&mut display.equations)
        .into_iter()
        .flat_map(|equation| two_of_pair(equation, symbols))
        .collect();
    let mut one_sided = display.equations.iter().filter(|equation| has_one_sided_sign(equation));
    match one_sided.next().filter(|_| role == Role::Claim) {
        Some(equation) => {
            let problem = "a sign \\pm on one side alone, or before both, can say that one of two equations holds, or both: write the square, or \
                           a subscript 1,2 for both";
            Err(source.fault(equation.at.0, problem))
        }
        None => Ok(stated),
    }
}

/// Whether an inequality speaks of the argument of a function that an equation gives.
fn limits_law(equations: &[Equation], beside: &Equation) -> bool {
    equations.iter().any(|equation| match &equation.left {
        Tree::Call(_, argument, _) => match &**argument {
            Tree::Symbol(name, _) => [&beside.left, &beside.right].iter().any(|side| speaks_of(side, name)),
            _ => false,
        },
        _ => false,
    })
}

/// Whether a side is a symbol, its modulus or a number.
fn is_bare(side: &Tree) -> bool {
    match side {
        Tree::Negate(inner) => is_bare(inner),
        Tree::Call(function, inner, _) => function.base == "\\abs" && is_bare(inner),
        Tree::Symbol(..) | Tree::Number(_) => true,
        // as pi/2 is
        Tree::Quotient(..) | Tree::Product(_) => {
            let is_variable = |node: &Tree| match node {
                Tree::Symbol(name, _) => !is_constant(name),
                node => matches!(node, Tree::Call(..) | Tree::Operation(..) | Tree::Partial { .. }),
            };
            !any(side, &mut |node| is_variable(node))
        }
        _ => false,
    }
}

fn read_tex(source: &Source, symbols: &Symbols) -> Result<Vec<Equation>, Fault> {
    let equations = read(&source.tex, &symbols.names);
    let equations = equations.map_err(|error| source.misread(&error))?;
    let one_or_two = equations
        .into_iter()
        .flat_map(|equation| two_of_pair(equation, symbols));
    Ok(one_or_two.collect())
}

/// The doubts of what was read.
fn noted<'e>(equations: impl Iterator<Item = &'e Equation>) -> Vec<Doubt> {
    let mut found: Vec<Doubt> = Vec::new();
    for doubt in equations.flat_map(|equation| &equation.doubts.0) {
        if !found.contains(doubt) {
            found.push(doubt.clone());
        }
    }
    found
}
