//! Audit sheets: what a person wrote down of a paper, read and checked for sense before anything is decided.

use super::check::check;
use super::circle::circle;
use super::definition::{Local, clash, inlined, is_defined, local, means_the_same};
use super::entry::{Entry, RawEntry, Role, Standing, read_entry};
use super::fault::{Fault, Source, Text};
use super::function::{Given, names_given};
use super::spelling::{
    note_constants_of_solutions, refuse_alternative_matrices, refuse_constants_of_solutions, refuse_indexed_parameters,
    refuse_products_of_vectors, refuse_two_spellings,
};
use super::symbols::{MapEntry, RawSymbols};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;
use texmath::{DoubtKind, Equation, Meaning, Operation, Symbols, any_side, names_of, speaks_of};
use texmath::{Name, Tree, nearest};
use toml::Spanned;

/// What to do where one name has two meanings.
pub(super) const RENAME: &str = "give one of them another name";

/// Returns true if a side of an equation is a name, or a call or a product that begins with one, that stands nowhere else in it.
fn may_give_a_name(equation: &Equation) -> bool {
    let first = |side: &Tree| match side {
        Tree::Symbol(name, _) | Tree::Call(name, ..) => Some(name.clone()),
        Tree::Product(factors) => match factors.first() {
            Some(Tree::Symbol(name, _)) => Some(name.clone()),
            _ => None,
        },
        _ => None,
    };
    let is_once = |given: &Name| {
        let mut count = 0;
        any_side(equation, &mut |node| {
            count += usize::from(matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..) if name == given));
            false
        });
        count == 1
    };
    let sides = [&equation.left, &equation.right];
    sides.into_iter().filter_map(first).any(|name| is_once(&name))
}

/// The guess that a formula of a document follows from others, before their labels.
pub(super) const FOLLOWS: &str = "this is a claim that follows from ";

/// A sheet, every formula read that can be.
#[derive(Clone, Debug)]
pub struct Sheet {
    pub title: Option<String>,
    pub symbols: Symbols,
    pub entries: Vec<Entry>,
    /// The text of each entry, from which [`Sheet::reprinted`] reads.
    raw: Arc<RawSheet>,
}

/// A sheet as it stands in the file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSheet {
    pub title: Option<String>,
    pub symbols: Option<Spanned<RawSymbols>>,
    #[serde(default)]
    pub equation: Vec<RawEntry>,
}

/// The `[symbols]` block of a file that holds nothing else.
///
/// # Errors
/// A [`Fault`] with its place.
pub fn read_symbols(text: &str) -> Result<Symbols, Fault> {
    let raw: RawSheet = parse(text)?;
    read_checked(&raw.symbols.map(Spanned::into_inner).unwrap_or_default())
}

fn read_checked(raw: &RawSymbols) -> Result<Symbols, Fault> {
    let symbols = raw.read()?;
    check(&symbols)?;
    Ok(symbols)
}

impl Sheet {
    /// Reads a sheet. Without `[symbols]` of its own it speaks `symbols`.
    ///
    /// # Errors
    /// A [`Fault`]: malformed TOML, wrong `[symbols]`, a label that is empty or given twice, a premise that does not
    /// exist, a claim with itself among its premises, a sheet without an equation or without a claim. A formula that
    /// cannot be read is no fault of the sheet: its entry says so.
    pub fn read(text: &str, symbols: &Symbols) -> Result<Self, Fault> {
        let raw: RawSheet = parse(text)?;
        if raw.equation.is_empty() {
            return Err(Fault::new("the sheet has no [[equation]]"));
        }
        Self::from_raw(&raw, &Text::new(text), symbols)
    }

    /// The sheet of what stands in a text.
    ///
    /// # Errors
    /// As [`Sheet::read`].
    pub(super) fn from_raw(raw: &RawSheet, lines: &Text, symbols: &Symbols) -> Result<Self, Fault> {
        let symbols = match &raw.symbols {
            None => symbols.clone(),
            Some(own) => read_checked(&with_labels(own.get_ref(), &raw.equation)).map_err(|fault| {
                let here = Source::new(lines, &Spanned::new(own.span(), String::new()));
                fault.within("[symbols]").at(&here)
            })?,
        };
        let mut symbols = symbols;
        let equations: Vec<RawEntry> = raw.equation.iter().flat_map(RawEntry::ways).collect();
        [symbols.names.defined, symbols.names.several] =
            names_given(equations.iter().flat_map(RawEntry::defining), &symbols);
        let positions = positions(lines, &equations)?;
        let needed = needed(&equations, &positions);
        let mut entries = Vec::new();
        for entry in &equations {
            let label = entry.label.get_ref();
            let wanted = entry.role != Role::Definition
                || positions
                    .get(label.as_str())
                    .is_some_and(|position| needed.contains(position));
            entries.push(read_entry(lines, entry, &positions, &symbols, wanted));
        }
        refuse_two_spellings(&equations, &mut entries, &symbols);
        refuse_alternative_matrices(&mut entries);
        refuse_products_of_vectors(&equations, &mut entries, &symbols);
        if raw.symbols.is_some() {
            refuse_indexed_parameters(&mut entries, &symbols);
            refuse_constants_of_solutions(&mut entries, &symbols);
            note_constants_of_solutions(&mut entries, &symbols);
        }
        let is_decided = |entry: &Entry| entry.role == Role::Claim || entry.standing == Standing::Definition;
        if !entries.iter().any(is_decided) {
            let problem = "the sheet has no claim: give an equation that is to be decided `role = \"claim\"`";
            return Err(Fault::new(problem).at(&Source::new(lines, &Spanned::new(0..0, String::new()))));
        }
        let mut sheet = Self {
            title: raw.title.clone(),
            symbols,
            entries,
            raw: Arc::new(raw.clone()),
        };
        sheet.refuse_circles();
        sheet.refuse_bound_letters();
        sheet.write_functions_out();
        sheet.part_definitions();
        sheet.take_values();
        sheet.check_names();
        sheet.leave_out_laws_that_are_unread();
        Ok(sheet)
    }

    /// Lets nothing rest on a formula that is taken for a law and cannot be read.
    fn leave_out_laws_that_are_unread(&mut self) {
        let is_unread_law =
            |entry: &Entry| !matches!(entry.standing, Standing::Said | Standing::Definition) && entry.unread.is_some();
        let laws: HashSet<usize> = (0..self.entries.len())
            .filter(|&position| self.entries.get(position).is_some_and(is_unread_law))
            .collect();
        for entry in self.entries.iter_mut().filter(|entry| entry.standing != Standing::Said) {
            entry.follows_from.retain(|position| !laws.contains(position));
        }
    }

    /// Writes functions that definitions give out where they are applied.
    fn write_functions_out(&mut self) {
        let symbols = &self.symbols;
        let mut own: Vec<Given> = Vec::new();
        for entry in &mut self.entries {
            let given = entry.take_functions(symbols).unwrap_or_else(|fault| {
                entry.unread.get_or_insert(fault);
                Given::default()
            });
            own.push(given);
        }
        for position in 0..self.entries.len() {
            let follows_from = self.entries.get(position).map(|entry| entry.follows_from.as_slice());
            let below = self.definitions_among(follows_from.unwrap_or_default());
            let below: Vec<&Given> = below.iter().filter_map(|&position| own.get(position)).collect();
            let given = own.get(position).cloned().unwrap_or_default();
            if let Some(entry) = self.entries.get_mut(position).filter(|entry| entry.unread.is_none()) {
                entry.unread = entry.write_out(given, &below, symbols).err();
            }
        }
    }

    /// Parts what each entry defines from what it states: definitions first, for the others may use them.
    fn part_definitions(&mut self) {
        for definitions in [true, false] {
            for position in 0..self.entries.len() {
                let Some(entry) = self.entries.get(position) else {
                    continue;
                };
                if (entry.role == Role::Definition) != definitions || entry.unread.is_some() {
                    continue;
                }
                let shared = if definitions {
                    Ok(Vec::new())
                } else {
                    self.shared(entry)
                };
                let symbols = &self.symbols;
                if let Some(entry) = self.entries.get_mut(position) {
                    let parted = shared.and_then(|shared| entry.part(symbols, &shared));
                    entry.unread = parted.err();
                }
            }
        }
    }

    /// Checks that each name of each formula stands for something.
    fn check_names(&mut self) {
        let elsewhere = self.names_of_definitions();
        for position in 0..self.entries.len() {
            let Some(entry) = self.entries.get(position) else {
                continue;
            };
            // Names that a formula may define which cannot be read are not held against those who use them.
            let below = self.definitions_below(entry);
            if entry.unread.is_some() || below.iter().any(|definition| definition.unread.is_some()) {
                continue;
            }
            let shared = self.shared(entry);
            let shared = shared.and_then(|shared| self.refuse_two_meanings(entry, &shared).map(|()| shared));
            let symbols = &self.symbols;
            if let Some(entry) = self.entries.get_mut(position) {
                let checked = shared.and_then(|shared| entry.check(symbols, &shared, &elsewhere));
                entry.unread = checked.err();
            }
        }
    }

    /// Puts other formulas in the place of those of the entry at a position: what it states, and as many definitions of
    /// `where` as it has. What cannot be read then is `unread` as it would be in a sheet.
    pub fn replace(&mut self, position: usize, equations: Vec<Equation>, local: Vec<Equation>) {
        let Some(entry) = self.entries.get_mut(position) else {
            return;
        };
        entry.unread = None;
        entry.equations = equations;
        for ((equation, _), new) in entry.local.iter_mut().zip(local) {
            *equation = new;
        }
        let elsewhere = self.names_of_definitions();
        let Some(entry) = self.entries.get(position) else {
            return;
        };
        let shared = self.shared(entry);
        let symbols = &self.symbols;
        let mut entry = entry.clone();
        let checked = shared.and_then(|shared| {
            entry.part(symbols, &shared)?;
            self.refuse_two_meanings(&entry, &shared)?;
            entry.check(symbols, &shared, &elsewhere)
        });
        entry.unread = checked.err();
        if let Some(place) = self.entries.get_mut(position) {
            *place = entry;
        }
    }

    /// Returns the sheet with other TeX in the entry at a position, all of it read anew: its formula, and of the texts of its
    /// `where` those that are given in pairs, before and after. `None` where it has no such text, or the sheet cannot be read.
    pub fn reprinted(&self, position: usize, tex: &str, local: &[(String, String)]) -> Option<Self> {
        let mut raw = (*self.raw).clone();
        let (number, _) = self.printed_with(position)?;
        let entry = raw.equation.get_mut(number)?;
        let with = |old: &Spanned<String>, new: &str| Spanned::new(old.span(), new.to_owned());
        entry.tex = with(&entry.tex, tex);
        for (before, after) in local {
            let text = entry.local.iter_mut().find(|text| text.get_ref() == before)?;
            *text = with(text, after);
        }
        Self::from_raw(&raw, &Text::new(""), &self.symbols).ok()
    }

    /// Returns sheets in each of which the claim at a position of a document follows from one more thing that is said of its letters
    /// alone and can be read: an equation within the text or a law in front of it.
    pub fn with_more_said(&self, position: usize) -> impl Iterator<Item = Self> {
        let number = self.printed_with(position).map(|(number, _)| number);
        let raw = number.and_then(|number| self.raw.equation.get(number));
        let names = |entry: &Entry| names_of(&entry.equations);
        let own = self.entries.get(position).map(names).unwrap_or_default();
        let before = self.entries.get(..position).unwrap_or_default();
        let is_of_own = |law: &&Entry| {
            let names = names(law);
            law.standing == Standing::Law && !names.is_empty() && names.is_subset(&own)
        };
        let laws = before.iter().filter(is_of_own).map(|law| law.tex.tex.clone());
        let said: Vec<String> = raw.into_iter().flat_map(|raw| raw.said.clone()).chain(laws).collect();
        said.into_iter().filter_map(move |tex| {
            let mut raw = (*self.raw).clone();
            let entry = raw.equation.get_mut(number?)?;
            entry.assume.push(Spanned::new(entry.tex.span(), tex));
            let sheet = Self::from_raw(&raw, &Text::new(""), &self.symbols).ok()?;
            let is_read = sheet.entries.get(position).is_some_and(|entry| entry.unread.is_none());
            is_read.then_some(sheet)
        })
    }

    /// Returns a sheet in which the claim at a position of a document follows from nothing, where it was taken to follow from
    /// something; nothing where it may say what a name is.
    pub fn resting_on_nothing(&self, position: usize) -> Option<Self> {
        let is_guess = |entry: &&Entry| entry.standing != Standing::Said && !entry.follows_from.is_empty();
        let claim = self.entries.get(position).filter(is_guess)?;
        if claim.equations.iter().any(may_give_a_name) {
            return None;
        }
        let names = names_of(&claim.equations);
        // what was defined is any number, but not where its value may move with a letter that runs
        let unknown: Vec<Name> = names.into_iter().filter(|name| !self.symbols.knows(name)).collect();
        let moves = |node: &Tree| match node {
            Tree::Operation(operation, _) => {
                let runs = operation.letter().is_some() && !matches!(&**operation, Operation::Series { .. });
                runs && unknown.iter().any(|name| speaks_of(node, name))
            }
            _ => false,
        };
        if claim
            .equations
            .iter()
            .any(|equation| any_side(equation, &mut |node| moves(node)))
        {
            return None;
        }
        let mut sheet = self.clone();
        let Self { symbols, entries, .. } = &mut sheet;
        let entry = entries.get_mut(position)?;
        entry.follows_from.clear();
        entry.guessed.retain(|guess| !guess.starts_with(FOLLOWS));
        entry
            .doubts
            .retain(|doubt| !matches!(doubt.kind, DoubtKind::SecondValue(_)));
        for name in &unknown {
            symbols.declare(name.clone(), Meaning::Parameter);
        }
        let mut raw = (*self.raw).clone();
        let own = raw.equation.get_mut(self.printed_with(position)?.0)?;
        own.follows_from = Some(Vec::new());
        own.second_values.clear();
        if let Some(symbols) = &mut raw.symbols {
            let parameters = &mut symbols.get_mut().parameters;
            parameters.extend(unknown.iter().map(ToString::to_string));
        }
        sheet.raw = Arc::new(raw);
        Some(sheet)
    }

    /// The entries as they stand in the file.
    pub(super) fn printed(&self) -> impl Iterator<Item = &RawEntry> {
        self.raw.equation.iter()
    }

    /// The number of the `[[equation]]` that the entry at a position is read from, and the positions of all that is read
    /// from it: both ways of an equivalence.
    fn printed_with(&self, position: usize) -> Option<(usize, Range<usize>)> {
        let mut start = 0;
        for (number, entry) in self.raw.equation.iter().enumerate() {
            let end = start + entry.ways().len();
            if (start..end).contains(&position) {
                return Some((number, start..end));
            }
            start = end;
        }
        None
    }

    /// The positions of the entries that are read from the same text as the one at a position: both ways of an equivalence.
    pub fn of_same_text(&self, position: usize) -> Range<usize> {
        self.printed_with(position)
            .map_or(position..position + 1, |(_, positions)| positions)
    }

    /// The bytes of the file at which the TeX of the entry at a position stands, quotes included.
    pub fn span(&self, position: usize) -> Option<Range<usize>> {
        let (number, _) = self.printed_with(position)?;
        self.raw.equation.get(number).map(|entry| entry.tex.span())
    }

    /// The names that definitions give.
    fn names_of_definitions(&self) -> HashSet<Name> {
        let definitions = self.entries.iter().filter(|entry| entry.role == Role::Definition);
        definitions.flat_map(Entry::gives).collect()
    }

    /// The definitions that an entry follows from, over other definitions too.
    pub(super) fn definitions_below(&self, entry: &Entry) -> Vec<&Entry> {
        let below = self.definitions_among(&entry.follows_from);
        below
            .into_iter()
            .filter_map(|position| self.entries.get(position))
            .collect()
    }

    /// The positions of the definitions among these entries and below them.
    fn definitions_among(&self, positions: &[usize]) -> Vec<usize> {
        let (mut found, mut seen) = (Vec::new(), HashSet::new());
        let mut next: Vec<usize> = positions.iter().rev().copied().collect();
        while let Some(position) = next.pop() {
            let Some(below) = self
                .entries
                .get(position)
                .filter(|below| below.role == Role::Definition)
            else {
                continue;
            };
            if seen.insert(position) {
                next.extend(below.follows_from.iter().rev());
                found.push(position);
            }
        }
        found
    }

    /// The definitions that an entry may use because it follows from them, each with what its own `where` defines put in.
    ///
    /// # Errors
    /// The [`Fault`] of two definitions that give one name different meanings, or of one that is too large.
    pub(super) fn shared(&self, entry: &Entry) -> Result<Vec<Local>, Fault> {
        let mut found: Vec<Local> = Vec::new();
        let (mut givers, mut again) = (HashMap::new(), Vec::new());
        for definition in self.definitions_below(entry) {
            let beside: Vec<Name> = definition
                .local
                .iter()
                .filter_map(|(e, _)| Some(local(e, &self.symbols)?.name))
                .collect();
            let (own, new): (Vec<Local>, Vec<Local>) = definition
                .own
                .iter()
                .cloned()
                .partition(|local| beside.contains(&local.name));
            for local in new {
                let Some(tree) = inlined(&local.tree, &own) else {
                    let problem = format!("`{}` is too large once its definitions are put in", local.name);
                    return Err(definition.tex.fault(0, problem).of(&definition.label));
                };
                let local = Local { tree, ..local };
                match givers.get(&local.name) {
                    Some(_) => again.push((local, definition)),
                    None => {
                        givers.insert(local.name.clone(), definition);
                        found.push(local);
                    }
                }
            }
        }
        for (local, definition) in again {
            let first = found.iter().find(|first| first.name == local.name);
            if first.is_some_and(|first| !means_the_same(&first.tree, &local.tree, &found)) {
                let first = givers.get(&local.name).map_or("", |first| first.label.as_str());
                let problem = format!(
                    "`{}` means one thing in ({first}) and another in ({}): {RENAME}",
                    local.name, definition.label
                );
                return Err(entry.tex.fault(0, problem).of(&entry.label));
            }
        }
        Ok(found)
    }

    /// Refuses a name of an entry's own that means something else in a definition that the entry follows from.
    ///
    /// # Errors
    /// The [`Fault`] with the label of that definition.
    fn refuse_two_meanings(&self, entry: &Entry, shared: &[Local]) -> Result<(), Fault> {
        let Some(name) = clash(&entry.own, shared) else {
            return Ok(());
        };
        let below = self.definitions_below(entry);
        let gives = below.iter().find(|below| is_defined(name, &below.own));
        let uses = || {
            let speaks = |below: &&&Entry| below.own.iter().any(|local| speaks_of(&local.tree, name));
            below.iter().find(speaks)
        };
        let other = gives.or_else(uses).map(|below| below.label.clone()).unwrap_or_default();
        let problem = format!(
            "`{name}` means one thing in ({}) and another in ({other}): {RENAME}",
            entry.label
        );
        Err(entry.tex.fault(0, problem).of(&entry.label))
    }

    /// The positions of the entries by their labels.
    pub fn positions(&self) -> HashMap<&str, usize> {
        let labels = self.entries.iter().map(|entry| entry.label.as_str());
        labels.enumerate().map(|(position, label)| (label, position)).collect()
    }

    /// The label of the definition that gives a name.
    pub(super) fn definition_of(&self, name: &Name) -> Option<&str> {
        let definitions = self.entries.iter().filter(|entry| entry.role == Role::Definition);
        let mut giving = definitions.filter(|entry| is_defined(name, &entry.own));
        giving.next().map(|entry| entry.label.as_str())
    }

    /// Whether the entry at a position is to be decided.
    pub fn is_claim(&self, position: usize) -> bool {
        self.entries
            .get(position)
            .is_some_and(|entry| entry.role == Role::Claim)
    }

    /// The positions of the entries that a table of verdicts has a row for: the claims, what a document without comments gives,
    /// and whatever cannot be read.
    pub fn rows(&self) -> Vec<usize> {
        let is_told = |n: &usize| {
            let entry = self.entries.get(*n);
            entry.is_some_and(|entry| entry.unread.is_some() || entry.standing == Standing::Definition)
        };
        (0..self.entries.len())
            .filter(|n| self.is_claim(*n) || is_told(n))
            .collect()
    }

    /// The labels of the entries that the claim at a position follows from and that cannot be read.
    pub fn unread_below(&self, position: usize) -> Vec<&str> {
        let Some(claim) = self.entries.get(position) else {
            return Vec::new();
        };
        let premises = claim.follows_from.iter().filter_map(|&n| self.entries.get(n));
        let mut unread: Vec<&str> = Vec::new();
        let below = premises.flat_map(|premise| [vec![premise], self.definitions_below(premise)].concat());
        for entry in below.filter(|entry| entry.unread.is_some()) {
            if !unread.contains(&entry.label.as_str()) {
                unread.push(&entry.label);
            }
        }
        unread
    }

    /// The position of the entry with this label; else of the only one that a document calls so.
    pub fn find(&self, label: &str) -> Option<usize> {
        let by_label = self.entries.iter().position(|entry| entry.label == label);
        by_label.or_else(|| {
            let is_called = |(_, entry): &(usize, &Entry)| entry.names.iter().any(|name| name == label);
            let mut called = self.entries.iter().enumerate().filter(is_called);
            let (position, _) = called.next()?;
            called.next().is_none().then_some(position)
        })
    }

    /// Makes the claims `unread` that hold for all values of a letter of which a premise speaks.
    fn refuse_bound_letters(&mut self) {
        let problem = |claim: &Entry| {
            let below = claim.follows_from.iter().filter_map(|&n| self.entries.get(n));
            let said = below.flat_map(|entry| &entry.equations);
            let said: Vec<&Tree> = said.flat_map(|equation| [&equation.left, &equation.right]).collect();
            let assumed = claim.assume.iter().skip(claim.printed);
            let assumed: Vec<&Tree> = assumed.flat_map(|(condition, _)| condition.sides()).collect();
            let is_said = |name: &&Name| {
                let of_it = |side: &&Tree| speaks_of(side, name);
                let runs = self.symbols.is_time(name);
                assumed.iter().any(of_it) || (!runs && said.iter().any(of_it))
            };
            claim.for_all.iter().find(is_said).map(|name| {
                let problem = format!("`{name}` stands for all values here, and for some in what is given");
                claim.tex.fault(0, problem).of(&claim.label)
            })
        };
        let problems: Vec<Option<Fault>> = self.entries.iter().map(problem).collect();
        for (claim, problem) in self.entries.iter_mut().zip(problems) {
            claim.unread = claim.unread.take().or(problem);
        }
    }

    /// Refuses the claims that are their own premises.
    fn refuse_circles(&mut self) {
        let uses = |entry: &Entry| match entry.role {
            Role::Claim => entry.follows_from.clone(),
            _ => Vec::new(),
        };
        let mut uses: Vec<Vec<usize>> = self.entries.iter().map(uses).collect();
        while let Some(position) = circle(&uses) {
            if let Some(own) = uses.get_mut(position) {
                own.clear();
            }
            if let Some(entry) = self.entries.get_mut(position) {
                let problem = "leads back to itself through `follows_from`: a claim cannot be its own premise";
                let fault = Fault::new(problem).of(&entry.label).at(&entry.tex);
                entry.unread.get_or_insert(fault);
                entry.follows_from.clear();
            }
        }
    }
}

/// Returns what TOML says of a text, with the key that was probably meant, and with how TeX is quoted.
fn instead_of_key(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    if message.starts_with("unknown field")
        && let Some(found) = quoted.next()
        && let Some(meant) = nearest(found, quoted)
    {
        return format!("{message}; did you mean `{meant}`?");
    }
    match message.contains("escape") {
        true => format!("{message}; write TeX between ''', where a backslash stands for itself"),
        false => message.to_owned(),
    }
}

fn parse(text: &str) -> Result<RawSheet, Fault> {
    toml::from_str(text).map_err(|error: toml::de::Error| {
        let fault = Fault::new(instead_of_key(error.message()));
        match error.span() {
            Some(span) => fault.at(&Source::new(&Text::new(text), &Spanned::new(span, String::new()))),
            None => fault,
        }
    })
}

/// The symbols with each map that lists labels of the sheet given the TeX of these instead.
fn with_labels(symbols: &RawSymbols, entries: &[RawEntry]) -> RawSymbols {
    let mut symbols = symbols.clone();
    let tex = |label: &String| {
        entries
            .iter()
            .find(|e| e.label.get_ref() == label)
            .map(|e| e.tex.get_ref().clone())
    };
    for entry in symbols.maps.values_mut() {
        if let MapEntry::List(list) = entry
            && let Some(equations) = list.iter().map(tex).collect::<Option<Vec<_>>>()
        {
            *list = equations;
        }
    }
    symbols
}

fn positions<'a>(lines: &Text, entries: &'a [RawEntry]) -> Result<BTreeMap<&'a str, usize>, Fault> {
    let mut positions = BTreeMap::new();
    for (position, entry) in entries.iter().enumerate() {
        let label = entry.label.get_ref();
        let problem = if label.trim().is_empty() {
            "a label must not be empty"
        } else if label.chars().any(char::is_control) {
            "a label must not have control characters"
        } else if positions.insert(label.as_str(), position).is_some() {
            "this label is given twice"
        } else {
            continue;
        };
        return Err(Fault::new(problem).of(label).at(&Source::new(lines, &entry.label)));
    }
    // what follows from an equivalence is told that its ways have conditions
    for (position, entry) in entries.iter().enumerate() {
        if let Some(label) = entry.label_of_both() {
            positions.entry(label).or_insert(position);
        }
    }
    Ok(positions)
}

/// What claims and premises follow from, over definitions too.
fn needed(entries: &[RawEntry], positions: &BTreeMap<&str, usize>) -> HashSet<usize> {
    let below = |entry: &RawEntry| -> Vec<usize> {
        let labels = entry.follows_from.iter().flatten();
        labels
            .filter_map(|label| positions.get(label.get_ref().as_str()).copied())
            .collect()
    };
    let mut needed = HashSet::new();
    let mut next: Vec<usize> = entries
        .iter()
        .filter(|e| e.role != Role::Definition)
        .flat_map(below)
        .collect();
    while let Some(position) = next.pop() {
        if needed.insert(position)
            && let Some(entry) = entries.get(position).filter(|entry| entry.role == Role::Definition)
        {
            next.extend(below(entry));
        }
    }
    needed
}
