//! What a claim rests on: its premises with their substitutions made, and its definitions.

use super::definition::{Local, circular, clash, inlined_in, is_defined, joined};
use super::entry::{Entry, Role};
use super::fault::{Fault, Source};
use super::reduce::{Rule, Rules};
use super::sheet::{RENAME, Sheet};
use super::size::{Budget, Sizes, TooLarge};
use num_traits::One;
use numbers::Rational;
use std::collections::BTreeSet;
use texmath::{
    At, Condition, Equation, Map, Name, Symbols, Tree, any, any_side, flies, index_of, rewrite_alone,
    rewrite_condition, rewrite_equation, runs, speaks_of, tree_runs,
};

/// One equation that is taken as true.
#[derive(Clone, Debug, PartialEq)]
pub struct Premise {
    pub label: String,
    pub equation: Equation,
    /// The symbols defined beside it.
    pub locals: Vec<Local>,
    /// The conditions under which it is stated.
    pub assume: Vec<Condition>,
    /// The first impact that it names.
    pub first: Option<i32>,
    /// Whether it is a law of one impact in which `with` put a value for a parameter: it holds for each impact, as laws
    /// of flight do.
    pub substituted: bool,
    pub source: Source,
}

/// The most flights that [`Statements::said`] takes a law at.
const MOST_FLIGHTS: i32 = 6;

/// All that bears on one claim.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Statements {
    /// Each premise once, at the impacts that it names itself.
    pub premises: Vec<Premise>,
    /// The symbols that the claim may use beyond the symbol table: its own definitions, then those that it follows from. A
    /// definition comes before what the symbol table says of a name.
    pub locals: Vec<Local>,
    /// The equations to be decided.
    pub claims: Vec<Equation>,
    /// The conditions under which the claim is made.
    pub assume: Vec<Condition>,
    /// The first and the last impact that the claim names.
    pub first: Option<i32>,
    pub last: Option<i32>,
    /// Whether the claim holds at every time of a flight.
    pub claim_runs: bool,
    /// True for a way of an equivalence, which must have a value wherever the other side holds.
    pub is_way: bool,
    /// Whether anything is said of partial derivatives, traces or determinants.
    pub speaks_of_maps: bool,
    /// Whether a partial derivative is written out anywhere.
    pub has_partials: bool,
    /// The rules by which all this was rewritten from what was read.
    pub rules: Rules,
    /// The maps of the symbol table that claim and premises name: in traces and determinants, also those of products and
    /// in abbreviations; and those of the premises where a derivative is written out.
    pub maps: BTreeSet<Name>,
}

impl Premise {
    /// What is true whatever the sheet says.
    pub fn known(label: &str, equation: Equation) -> Self {
        Self {
            label: label.to_string(),
            source: Source::unplaced(equation.to_string()),
            equation,
            locals: Vec::new(),
            assume: Vec::new(),
            first: None,
            substituted: false,
        }
    }

    /// A fault in this premise.
    pub fn fault(&self, at: usize, message: String) -> Fault {
        self.source.fault(at, message).of(&self.label)
    }

    /// The premise with each of its formulas rewritten.
    fn rewritten(&self, new: &dyn Fn(&Equation) -> Equation) -> Self {
        let mut premise = self.clone();
        premise.equation = new(&self.equation);
        for local in &mut premise.locals {
            local.tree = rewrite_alone(&local.tree, new);
        }
        for condition in &mut premise.assume {
            *condition = rewrite_condition(condition, new);
        }
        premise
    }

    /// The premise at impacts `by` further on.
    pub fn shifted(&self, by: i32, symbols: &Symbols) -> Self {
        if by == 0 {
            return self.clone();
        }
        let mut premise = self.rewritten(&|equation| symbols.shifted(equation, by));
        premise.first = symbols.impacts(&premise.equation).first().copied();
        premise
    }

    /// A law of flight is said of every impact: it is taken at the `flights` that the claim speaks of, from the
    /// impact `first` on. Any other premise is said once.
    fn said_of(&self, first: Option<i32>, flights: i32, symbols: &Symbols) -> Vec<Self> {
        let flights = 0..flights;
        match (self.first, first) {
            (Some(start), Some(first)) if runs(&self.equation, symbols) || (self.substituted && first >= start) => {
                flights
                    .map(|flight| self.shifted(first - start + flight, symbols))
                    .collect()
            }
            // A law that names no impact is said of every flight too.
            (None, Some(first)) if flies(&self.equation, symbols) => flights
                .map(|flight| Self {
                    first: Some(first + flight),
                    ..self.clone()
                })
                .collect(),
            _ => vec![self.clone()],
        }
    }
}

impl Premise {
    /// A law of flight in the flight after this impact.
    pub fn said_in(&self, flight: i32, symbols: &Symbols) -> Self {
        match self.first {
            Some(start) => self.shifted(flight - start, symbols),
            None => Self {
                first: Some(flight),
                ..self.clone()
            },
        }
    }
}

impl Statements {
    /// Records a rule by which the statements were rewritten.
    pub(super) fn by(mut self, rule: Rule) -> Self {
        self.rules.insert(rule);
        self
    }

    /// Returns true if the formulas of claims, premises, definitions and conditions are those of the other.
    pub fn has_formulas_of(&self, other: &Self) -> bool {
        let locals = |locals: &[Local], other: &[Local]| {
            locals.len() == other.len() && locals.iter().zip(other).all(|(own, other)| own.tree == other.tree)
        };
        let premise = |(own, other): (&Premise, &Premise)| {
            own.equation == other.equation && own.assume == other.assume && locals(&own.locals, &other.locals)
        };
        self.claims == other.claims
            && self.assume == other.assume
            && locals(&self.locals, &other.locals)
            && self.premises.len() == other.premises.len()
            && self.premises.iter().zip(&other.premises).all(premise)
    }

    /// Gathers what bears on the claim at `position`.
    ///
    /// # Errors
    /// A [`Fault`] where the claim cannot be read, where definitions go in a circle, or where a premise needs a
    /// definition that the claim does not follow from.
    pub fn gather(sheet: &Sheet, position: usize) -> Result<Self, Fault> {
        let Some(claim) = sheet.entries.get(position) else {
            return Ok(Self::default());
        };
        if let Some(fault) = &claim.unread {
            return Err(fault.clone());
        }
        let mut found = Self {
            is_way: claim.is_way,
            ..Self::default()
        };
        let shared = sheet.shared(claim)?;
        for entry in claim.follows_from.iter().filter_map(|&n| sheet.entries.get(n)) {
            found.rest_on(sheet, entry, claim, &shared)?;
        }
        for (equation, source) in &claim.given {
            found.push(claim, equation, source, joined(claim.own.clone(), &shared));
        }
        found.locals = joined(claim.own.clone(), &shared);
        if let Some(name) = circular(&found.locals) {
            return Err(claim
                .tex
                .fault(0, format!("`{name}` is defined by itself"))
                .of(&claim.label));
        }
        found.claims.clone_from(&claim.stated);
        found.assume = claim.assume.iter().map(|(condition, _)| condition.clone()).collect();
        found.substitute(claim, &sheet.symbols)?;
        found.put_in_identities(&claim.identities);
        for law in &sheet.symbols.laws {
            found.premises.push(Premise::known(&law.to_string(), law.clone()));
        }
        Ok(found.with_overview(&sheet.symbols))
    }

    /// Puts 1 in the place of the letters that are the identity.
    fn put_in_identities(&mut self, identities: &BTreeSet<String>) {
        if identities.is_empty() {
            return;
        }
        let one = |name: &Name| {
            identities
                .contains(&name.to_string())
                .then(|| Tree::Number(Rational::one()))
        };
        let new = |equation: &Equation| rewrite_equation(equation, &one);
        self.claims.iter_mut().for_each(|claim| *claim = new(claim));
        self.premises
            .iter_mut()
            .for_each(|premise| *premise = premise.rewritten(&new));
        self.locals
            .iter_mut()
            .for_each(|local| local.tree = rewrite_alone(&local.tree, &new));
        self.assume
            .iter_mut()
            .for_each(|condition| *condition = rewrite_condition(condition, &new));
    }

    /// The label of a premise.
    pub fn label(&self, index: usize) -> String {
        self.premises
            .get(index)
            .map(|premise| premise.label.clone())
            .unwrap_or_default()
    }

    /// The premises at each flight that the claim speaks of: what is said of every flight is there once for each.
    pub fn said(&self, symbols: &Symbols) -> Option<Vec<Premise>> {
        let impacts = self.first.zip(self.last).filter(|_| !self.claim_runs);
        let flights = impacts.map_or(1, |(first, last)| last.saturating_sub(first).max(1));
        let premises = self.premises.iter();
        let said = |premise: &Premise| premise.said_of(self.first, flights.min(MOST_FLIGHTS), symbols);
        let all: Vec<Vec<Premise>> = premises.map(said).collect();
        let is_cut = flights > MOST_FLIGHTS && all.iter().any(|said| said.len() > 1);
        (!is_cut).then(|| all.concat())
    }

    /// Adds what an entry states to the premises.
    fn rest_on(&mut self, sheet: &Sheet, entry: &Entry, claim: &Entry, shared: &[Local]) -> Result<(), Fault> {
        let is_shared = |condition: &Condition| claim.assume.iter().any(|(own, _)| own == condition);
        let mut printed = entry.assume.iter().take(entry.printed);
        if !printed.all(|(condition, _)| is_shared(condition)) {
            let problem = format!(
                "follows from ({}), which holds under conditions that it prints: state them here too, by `assume`",
                entry.label
            );
            return Err(claim.tex.fault(0, problem).of(&claim.label));
        }
        let brought = sheet.shared(entry)?;
        for (name, at) in &entry.borrowed {
            if !is_defined(name, shared) && !is_defined(name, &brought) {
                let definition = sheet.definition_of(name).unwrap_or_default();
                let problem = format!(
                    "speaks of `{name}`, which ({definition}) defines: ({}) must follow from ({definition}) too",
                    claim.label
                );
                return Err(entry.tex.fault(*at, problem).of(&entry.label));
            }
        }
        if let Some((equation, source)) = entry.put_into(&brought, &sheet.symbols) {
            let problem = format!(
                "({}) puts something in for `{}` in a definition, which stands for something else in ({}): write it as a premise",
                entry.label, equation.left, claim.label
            );
            return Err(source.fault(equation.at.0, problem).of(&entry.label));
        }
        let known = joined(entry.own.clone(), &brought);
        let locals = if entry.borrows(&known, shared) {
            if let Some(name) = clash(&known, shared) {
                let problem = format!(
                    "`{name}` means one thing here and another in what ({}) follows from: {RENAME}",
                    claim.label
                );
                return Err(entry.tex.fault(0, problem).of(&entry.label));
            }
            joined(known, shared)
        } else {
            known
        };
        if !(brought.is_empty() && shared.is_empty())
            && let Some(name) = circular(&locals)
        {
            return Err(entry
                .tex
                .fault(0, format!("`{name}` is defined by itself"))
                .of(&entry.label));
        }
        for equation in &entry.stated {
            self.push(entry, equation, &entry.tex, locals.clone());
        }
        // what is too large to be written out may run
        let is_law =
            |equation: &Equation| inlined_in(equation, &locals).is_none_or(|written| sheet.symbols.is_law(&written));
        let has_law = entry.stated.iter().any(is_law);
        if has_law {
            self.assume_outright(entry, &locals, &sheet.symbols);
        }
        self.define_beside(entry, has_law, &locals, &sheet.symbols)?;
        for (equation, source) in &entry.given {
            self.push(entry, equation, source, locals.clone());
        }
        Ok(())
    }

    /// What an entry defines and does not use is written all the same: it has a value.
    fn define_beside(
        &mut self,
        entry: &Entry,
        has_law: bool,
        locals: &[Local],
        symbols: &Symbols,
    ) -> Result<(), Fault> {
        for local in entry.unused().into_iter().filter(|_| entry.role != Role::Definition) {
            let equation = Equation::between(local.tree.clone(), local.tree.clone());
            let of_map = |node: &Tree| matches!(node, Tree::Partial { .. } | Tree::Invariant { .. });
            let is_constant = |written: Equation| {
                let moves = symbols.is_law(&written) || !symbols.impacts(&written).is_empty();
                !moves && !any_side(&written, &mut |node| of_map(node))
            };
            if !inlined_in(&equation, locals).is_some_and(is_constant) {
                let problem = format!("`{}` is used nowhere here and is no constant: leave it out", local.name);
                return Err(entry.tex.fault(0, problem).of(&entry.label));
            }
            self.push(entry, &equation, &entry.tex, locals.to_vec());
            if let Some(premise) = self.premises.last_mut().filter(|_| has_law) {
                premise.assume = Vec::new();
            }
        }
        Ok(())
    }

    /// The conditions of a law that speak of nothing that runs hold whether or not the law says anything: they are premises.
    fn assume_outright(&mut self, entry: &Entry, locals: &[Local], symbols: &Symbols) {
        for (condition, source) in &entry.assume {
            // of an integer the condition itself is what is said
            let (equation, assume) = match condition {
                Condition::Relation(relation) => (relation.clone(), Vec::new()),
                Condition::Integer(tree) => (Equation::between(tree.clone(), tree.clone()), vec![condition.clone()]),
            };
            // what is too large to be written out may run
            let is_constant = |written: Equation| !symbols.is_law(&written) && symbols.impacts(&written).is_empty();
            if inlined_in(&equation, locals).is_some_and(is_constant) {
                self.push(entry, &equation, source, locals.to_vec());
                if let Some(premise) = self.premises.last_mut() {
                    premise.assume = assume;
                }
            }
        }
    }

    fn push(&mut self, entry: &Entry, equation: &Equation, source: &Source, locals: Vec<Local>) {
        self.premises.push(Premise {
            label: entry.label.clone(),
            equation: equation.clone(),
            locals,
            assume: entry.assume.iter().map(|(condition, _)| condition.clone()).collect(),
            first: None,
            substituted: false,
            source: source.clone(),
        });
    }

    /// Makes the substitutions of `with` in the premises. The value of a state at an impact is a premise.
    ///
    /// # Errors
    /// The [`Fault`] of a time of an impact put in for the time of a flight that is not the end of the flight.
    fn substitute(&mut self, claim: &Entry, symbols: &Symbols) -> Result<(), Fault> {
        let (mut pairs, mut more, mut shift) = (Vec::new(), Vec::new(), 0);
        for (equation, source) in &claim.with {
            match &equation.left {
                Tree::Symbol(name, _) if symbols.is_index_letter(name) => {
                    let to = equation.right.to_string().replace(' ', "");
                    shift = index_of(&to, &symbols.index).unwrap_or(0);
                }
                Tree::Symbol(name, _) if !symbols.is_indexed(name) || symbols.renames(equation) => {
                    pairs.push((name.clone(), equation.right.clone()));
                }
                _ => more.push((equation, source)),
            }
        }
        self.check_size(&pairs, symbols)
            .map_err(|problem| claim.tex.fault(0, problem).of(&claim.label))?;
        if shift != 0 || !pairs.is_empty() {
            for premise in &mut self.premises {
                let is_other = |local: &&Local| pairs.iter().any(|(_, tree)| speaks_of(tree, &local.name));
                if let Some(local) = premise.locals.iter().find(is_other) {
                    let problem = format!(
                        "`{}` is put in, which is something else in ({}): {RENAME}",
                        local.name, premise.label
                    );
                    return Err(claim.tex.fault(0, problem).of(&claim.label));
                }
                let shifted = premise.shifted(shift, symbols);
                claim.check_put_in(&shifted.equation, &shifted.locals, symbols)?;
                let put_in = shifted.rewritten(&|equation| symbols.substituted(equation, &pairs));
                let one_impact = symbols.impacts(&put_in.equation).len() == 1;
                let substituted = one_impact && put_in.equation != shifted.equation;
                *premise = Premise { substituted, ..put_in };
            }
            // what the claim defines itself is no premise
            let followed = self
                .locals
                .iter_mut()
                .filter(|local| !is_defined(&local.name, &claim.own));
            for local in followed {
                let left = Tree::Symbol(local.name.clone(), At(0));
                let equation = Equation::between(left, local.tree.clone());
                claim.check_put_in(&equation, &[], symbols)?;
                local.tree = symbols.substituted(&equation, &pairs).right;
            }
        }
        for (equation, source) in more {
            self.push(claim, equation, source, Vec::new());
        }
        Ok(())
    }

    /// Refuses premises, definitions and claims that would be too large with everything put in. Each claim is decided with all
    /// the others beside it.
    fn check_size(&self, pairs: &[(Name, Tree)], symbols: &Symbols) -> Result<(), String> {
        let (budget, claims) = (Budget::of_claim(), self.claims.len());
        for premise in &self.premises {
            let problem = |problem: TooLarge| format!("what it follows from, ({}), is {problem}", premise.label);
            let sizes = Sizes::within_sheet(symbols, premise.locals.iter().map(Local::pair));
            let mut sizes = sizes.replacing(pairs).map_err(problem)?;
            let conditions = premise.assume.iter().flat_map(Condition::sides);
            for tree in conditions.chain([&premise.equation.left, &premise.equation.right]) {
                let size = sizes.of(tree).map_err(problem)?;
                budget.spend_times(size, claims).map_err(problem)?;
            }
        }
        let mut sizes = Sizes::within_sheet(symbols, self.locals.iter().map(Local::pair));
        for local in &self.locals {
            sizes
                .of(&local.tree)
                .and_then(|size| budget.spend(size))
                .map_err(|problem| format!("`{}` is {problem}", local.name))?;
        }
        for claim in &self.claims {
            let all = [&claim.left, &claim.right].map(|side| sizes.of(side).map_err(|problem| problem.to_string()));
            for size in all {
                let problem = format!("{claims} equations are too many for one entry: give them entries of their own");
                budget.spend_times(size?, claims).map_err(|_| problem)?;
            }
        }
        Ok(())
    }

    fn named_maps(&self, symbols: &Symbols) -> BTreeSet<Name> {
        let premises = self.premises.iter();
        let equations = self
            .claims
            .iter()
            .chain(premises.clone().map(|premise| &premise.equation));
        let sides = |equation: &'_ Equation| [equation.left.clone(), equation.right.clone()];
        let mut open: Vec<Tree> = equations.chain(&symbols.relations).flat_map(sides).collect();
        for condition in self.assume.iter().chain(premises.flat_map(|premise| &premise.assume)) {
            match condition {
                Condition::Relation(equation) => open.extend(sides(equation)),
                Condition::Integer(tree) => open.push(tree.clone()),
            }
        }
        open.extend(self.locals.iter().map(|local| local.tree.clone()));
        let (mut met, mut maps): (BTreeSet<Name>, BTreeSet<Name>) = Default::default();
        while let Some(tree) = open.pop() {
            any(&tree, &mut |node| {
                match node {
                    Tree::Symbol(name, _) if met.insert(name.clone()) => {
                        open.extend(symbols.abbreviation(name).cloned());
                    }
                    Tree::Invariant { of, .. } => {
                        maps.insert(of.clone());
                    }
                    _ => {}
                }
                false
            });
        }
        let mut named = BTreeSet::new();
        while let Some(name) = maps.pop_first() {
            if named.insert(name.clone())
                && let Some(Map::Product(factors)) = symbols.map(&name)
            {
                maps.extend(factors.iter().cloned());
            }
        }
        named
    }

    pub(super) fn with_overview(mut self, symbols: &Symbols) -> Self {
        for premise in &mut self.premises {
            premise.first = symbols.impacts(&premise.equation).first().copied();
        }
        let definitions = self.locals.iter().map(|local| &local.tree);
        let of_claim: Vec<&Tree> = self
            .claims
            .iter()
            .flat_map(|c| [&c.left, &c.right])
            .chain(definitions)
            .collect();
        let mut impacts = BTreeSet::new();
        for tree in &of_claim {
            symbols.collect_impacts(tree, &mut impacts);
        }
        let claim_runs = of_claim.iter().any(|tree| tree_runs(tree, symbols));
        let of_premises = self.premises.iter().flat_map(|s| [&s.equation.left, &s.equation.right]);
        let everything: Vec<&Tree> = of_claim.into_iter().chain(of_premises).collect();
        let any_node = |test: fn(&Tree) -> bool| everything.iter().any(|tree| any(tree, &mut |node| test(node)));
        let has_partials = any_node(|node| matches!(node, Tree::Partial { .. }));
        (self.first, self.last) = (impacts.first().copied(), impacts.last().copied());
        self.maps = self.named_maps(symbols);
        let speaks_of_maps = has_partials || !self.maps.is_empty();
        if has_partials {
            // what is written out is along the maps that the premises give
            let given = symbols.maps().filter(|(_, map)| matches!(map, Map::Premises { .. }));
            self.maps.extend(given.map(|(name, _)| name.clone()));
        }
        (self.claim_runs, self.has_partials, self.speaks_of_maps) = (claim_runs, has_partials, speaks_of_maps);
        self
    }
}

impl Entry {
    /// What `with` puts in for something of which these definitions speak: outside this entry they stand for something else.
    fn put_into(&self, definitions: &[Local], symbols: &Symbols) -> Option<&(Equation, Source)> {
        let is_put_in = |equation: &Equation, tree: &Tree| {
            let written = Equation::between(tree.clone(), tree.clone());
            let replaced = match &equation.left {
                Tree::Symbol(name, _) if symbols.is_index_letter(name) => return false,
                Tree::Symbol(name, _) => {
                    let pairs = [(name.clone(), equation.right.clone())];
                    symbols.substituted(&written, &pairs) != symbols.substituted(&written, &[])
                }
                _ => false,
            };
            replaced || any_side(&symbols.expanded(&written), &mut |node| *node == equation.left)
        };
        let mut with = self.with.iter();
        with.find(|(equation, _)| definitions.iter().any(|local| is_put_in(equation, &local.tree)))
    }

    /// Whether what the entry says, with its definitions, speaks of names that only those of `others` give.
    fn borrows(&self, known: &[Local], others: &[Local]) -> bool {
        let mut said = self.said();
        said.extend(known.iter().map(|local| &local.tree));
        let mut others = others.iter().filter(|other| !is_defined(&other.name, known));
        others.any(|other| said.iter().any(|tree| speaks_of(tree, &other.name)))
    }
}
