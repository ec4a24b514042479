//! Documents as authors write them: their displays are the formulas of a sheet, comments that do not print say what each is, and
//! what nobody says is guessed, and called a guess.

mod asides;
mod citations;
mod comment;
mod dependence;
mod draft;
mod factors;
mod fonts;
mod guess;
mod links;
mod macros;
mod markdown;
mod marks;
mod members;
mod outline;
mod rows;
mod scan;
mod tex;

use super::entry::{RawEntry, Role, Standing};
use super::fault::{Fault, File, Source, Text};
use super::sheet::{RawSheet, Sheet};
use super::symbols::RawSymbols;
use super::verdict::Verdict;
use citations::{Cited, citations};
use comment::{Key, completed, keys};
use guess::{Asked, Guess};
use members::Members;
use scan::{Comment, Formula, Scan};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::ops::Range;
use texmath::{Symbols, nearest};
use toml::Spanned;

pub use scan::{Include, Markup};

/// A document, taken apart.
#[derive(Clone, Debug)]
pub struct Document {
    text: String,
    files: Vec<File>,
    raw: RawSheet,
    /// What is wrong with it, beside formulas that cannot be read.
    pub faults: Vec<Fault>,
    /// What was guessed of it as a whole, a sentence each.
    pub guesses: Vec<String>,
    /// The printed numbers that comments ask to be held against what is computed.
    pub numbers: Vec<PrintedNumber>,
}

/// A number that a document prints, and what it is said to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrintedNumber {
    pub printed: String,
    pub quantity: String,
    pub scene: String,
    /// What the scene is set to, and which row is meant.
    pub set: Vec<String>,
    /// Where the comment stands.
    pub file: Option<String>,
    pub place: (usize, usize),
}

/// What the comments beside a formula say of it.
#[derive(Clone, Debug, Default)]
struct Said {
    role: Option<Role>,
    /// True if the role is given on the row itself, not for the whole display.
    is_of_row: bool,
    skip: bool,
    label: Option<String>,
    follows_from: Option<Vec<String>>,
    with: Vec<Spanned<String>>,
    local: Vec<Spanned<String>>,
    assume: Vec<Spanned<String>>,
    expect: Option<Verdict>,
    /// Why what is said is not understood: without it the formula may be another.
    problem: Option<String>,
}

impl Said {
    /// Whether nothing is said.
    fn is_nothing(&self) -> bool {
        let lists = [&self.with, &self.local, &self.assume];
        self.role.is_none()
            && !self.skip
            && self.follows_from.is_none()
            && self.label.is_none()
            && self.expect.is_none()
            && self.problem.is_none()
            && lists.iter().all(|list| list.is_empty())
    }
}

/// What comments say of the whole document.
#[derive(Default)]
struct Whole {
    symbols: Option<(Option<Box<RawSymbols>>, std::ops::Range<usize>)>,
    /// Roles of formulas that say nothing, from this formula on.
    defaults: Vec<(usize, Option<Role>)>,
    members: Members,
    /// The formulas that the text in front of each display names.
    citations: Vec<Cited>,
}

impl Document {
    /// Takes a document apart; `include` reads the files that it includes. Nothing of it is too wrong to be read: what is, stands
    /// in `faults`.
    pub fn read(text: &str, markup: Markup, include: Include<'_>) -> Self {
        Self::read_below(text, "", markup, include)
    }

    /// Takes a document apart, as [`Document::read`] does, of which a `preamble` elsewhere defines macros.
    pub fn read_below(text: &str, preamble: &str, markup: Markup, include: Include<'_>) -> Self {
        let mut scan = Scan::new(text, preamble, markup, include);
        if scan.comments.is_empty() {
            scan.formulas = links::parted(links::merged(scan.formulas, scan.asides), &scan.text);
            end_within(&asides::local_parts(&scan.text), &mut scan.formulas);
        }
        let place = |at: usize| Spanned::new(at..at, String::new());
        let lines = Text::of_files(&scan.text, &scan.files);
        let source = |at: usize| Source::new(&lines, &place(at));
        let fault = |at: usize, message: String| Fault::new(message).at(&source(at));
        let mut faults: Vec<Fault> = scan
            .faults
            .iter()
            .map(|(at, message)| fault(*at, message.clone()))
            .collect();
        let members = Members::of_text(&scan.text);
        let (mut whole, mut numbers) = (
            Whole {
                members,
                citations: citations(&scan.text, &scan.formulas),
                ..Whole::default()
            },
            Vec::new(),
        );
        let mut said: Vec<Said> = vec![Said::default(); scan.formulas.len()];
        let about: HashMap<usize, usize> = scan
            .formulas
            .iter()
            .enumerate()
            .flat_map(|(formula, own)| own.comments.iter().map(move |comment| (*comment, formula)))
            .collect();
        for (number, comment) in scan.comments.iter().enumerate() {
            let keys = keys(&comment.text).unwrap_or_else(|problem| {
                if let Some(said) = about.get(&number).and_then(|&formula| said.get_mut(formula)) {
                    said.problem = Some(problem.clone());
                }
                faults.push(fault(comment.part.start, problem));
                Vec::new()
            });
            for key in keys {
                let problem = match key {
                    Key::Symbols(symbols) => match (whole.symbols.take(), symbols) {
                        (None, symbols) => {
                            whole.symbols = Some((symbols, comment.part.clone()));
                            None
                        }
                        (Some((Some(before), at)), Some(symbols)) => match before.and(*symbols) {
                            Ok(all) => {
                                whole.symbols = Some((Some(Box::new(all)), at));
                                None
                            }
                            Err(_) => Some("a declaration with more than one `=`"),
                        },
                        (before, _) => {
                            whole.symbols = before;
                            Some("symbols of the impact pair beside others: say which are meant")
                        }
                    },
                    Key::Default(role) => {
                        whole.defaults.push((comment.after, role));
                        None
                    }
                    Key::Value { quantity, scene, set } => match printed_number(comment) {
                        Some(printed) => {
                            let at = source(comment.part.start);
                            let (file, place) = (at.file.clone(), at.place());
                            numbers.push(PrintedNumber {
                                printed,
                                quantity,
                                scene,
                                set,
                                file,
                                place,
                            });
                            None
                        }
                        None => Some("no number is printed beside this comment"),
                    },
                    key => match about.get(&number).and_then(|&formula| said.get_mut(formula)) {
                        Some(said) => {
                            said.take(key, comment);
                            None
                        }
                        None => Some("no formula follows this comment"),
                    },
                };
                faults.extend(problem.map(|problem| fault(comment.part.start, problem.to_owned())));
            }
        }
        let symbols = whole.symbols.take();
        let of_the_pair = matches!(&symbols, Some((None, _)));
        let symbols = symbols.and_then(|(symbols, at)| match completed(*symbols?) {
            Ok(symbols) => Some(Spanned::new(at, symbols)),
            Err(problem) => {
                faults.push(fault(at.start, problem));
                None
            }
        });
        let line = |at: usize| line_of(&lines, at);
        let mut raw = RawSheet {
            title: None,
            symbols,
            equation: Vec::new(),
        };
        let before = |formula: &Formula| {
            let comments = formula.comments.iter().filter_map(|&number| scan.comments.get(number));
            let ends: Vec<usize> = comments.map(|comment| comment.part.end).collect();
            formula.is_of_display || (!ends.is_empty() && ends.iter().all(|end| *end <= formula.part.start))
        };
        let of_displays: Vec<bool> = scan.formulas.iter().map(before).collect();
        let notes = scan.notes.iter();
        let mut guesses: Vec<String> = notes.map(|(at, note)| format!("line {}: {note}", line(*at))).collect();
        guesses.extend(entries(
            &scan.formulas,
            said,
            &of_displays,
            &whole,
            of_the_pair,
            &mut raw,
            &lines,
        ));
        Self {
            raw,
            faults,
            guesses,
            numbers,
            files: scan.files,
            text: scan.text,
        }
    }

    /// The sheet that the document is. `pair` are the symbols of the impact pair, for a document that asks for it.
    ///
    /// # Errors
    /// As [`Sheet::read`].
    pub fn sheet(&self, pair: &Symbols) -> Result<Sheet, Fault> {
        if !self
            .raw
            .equation
            .iter()
            .any(|entry| entry.role == Role::Claim || entry.standing == Standing::Definition)
        {
            return Err(Fault::new("nothing is to be decided here: no formula is a claim"));
        }
        Sheet::from_raw(&self.raw, &Text::of_files(&self.text, &self.files), pair)
    }

    /// The same sheet as TOML, to be edited; `name` is the document's.
    pub fn draft(&self, name: &str) -> String {
        draft::toml(&self.raw, &self.guesses, name)
    }
}

impl Said {
    fn take(&mut self, key: Key, comment: &Comment) {
        let spanned = |tex: String| Spanned::new(comment.part.clone(), tex);
        match key {
            Key::Role(role) => self.role = Some(role),
            Key::Skip => self.skip = true,
            Key::Label(label) => self.label = Some(label),
            Key::FollowsFrom(labels) => self.follows_from.get_or_insert_default().extend(labels),
            Key::With(tex) => self.with.push(spanned(tex)),
            Key::Where(tex) => self.local.push(spanned(tex)),
            Key::Assume(tex) => self.assume.push(spanned(tex)),
            Key::Expect(verdict) => self.expect = Some(verdict),
            Key::Default(_) | Key::Symbols(_) | Key::Value { .. } => {}
        }
    }

    /// What a row says that says nothing of this itself: what the row before it does, which it goes with.
    fn or(self, before: &Self, is_link: bool) -> Self {
        let list =
            |own: Vec<Spanned<String>>, before: &[Spanned<String>]| if own.is_empty() { before.to_vec() } else { own };
        // what follows the definition of a name is claimed of it, and what goes on from a row that is given of that
        let claimed = |role: Role| match role {
            Role::Definition if is_link => Role::Claim,
            Role::Premise if is_link && before.is_of_row => Role::Claim,
            role => role,
        };
        Self {
            role: self.role.or(before.role.map(claimed)),
            skip: self.skip || (before.skip && self.role.is_none()),
            follows_from: self.follows_from.or_else(|| before.follows_from.clone()),
            with: list(self.with, &before.with),
            local: list(self.local, &before.local),
            assume: list(self.assume, &before.assume),
            ..self
        }
    }
}

/// Commands whose arguments print no number that is meant.
const ARGUMENTS: [&str; 14] = [
    "label",
    "cite",
    "ref",
    "eqref",
    "footnote",
    "hspace",
    "vspace",
    "mathrm",
    "text",
    "unit",
    "si",
    "textrm",
    "mbox",
    "operatorname",
];

/// What a line prints beside its numbers left out: scripts, arguments of commands, what stands behind `\pm`.
fn plain(line: &str) -> String {
    let line = line
        .replace("{,}", ".")
        .replace(r"\,", "")
        .replace("--", " ")
        .replace('\u{2013}', " ");
    let mut shown = String::new();
    let mut at = 0;
    while let Some(c) = line.get(at..).and_then(|rest| rest.chars().next()) {
        let power = shown.ends_with("10") && c == '^';
        match c {
            '\\' => {
                let (name, end) = tex::command(&line, at);
                at = match name {
                    "pm" => return shown,
                    "\\" => tex::group(&line, end, tex::SQUARE).map_or(end, |space| space.end + 1),
                    name if ARGUMENTS.contains(&name) => {
                        tex::group(&line, end, tex::BRACES).map_or(end, |own| own.end + 1)
                    }
                    "times" | "cdot" => {
                        shown.push_str(r"\cdot ");
                        end
                    }
                    _ => end,
                };
                continue;
            }
            '_' | '^' if !power => {
                let next = at + 1;
                let one = line
                    .get(next..)
                    .and_then(|rest| rest.chars().next())
                    .map_or(0, char::len_utf8);
                at = tex::group(&line, next, tex::BRACES).map_or(next + one, |own| own.end + 1);
                continue;
            }
            c => shown.push(c),
        }
        at += c.len_utf8();
    }
    shown
}

/// The last number that is printed before a comment on its line, else the first of the next.
fn printed_number(comment: &Comment) -> Option<String> {
    let line = plain(&comment.line);
    let mut numbers = Vec::new();
    let mut rest = line.as_str();
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let before = rest.get(..at).unwrap_or_default();
        let (before, point) = match before.strip_suffix('.') {
            Some(before) if !before.ends_with(|c: char| c.is_alphanumeric()) => (before, "0."),
            _ => (before, ""),
        };
        let is_sign =
            |text: &str| text.is_empty() || text.ends_with(|c: char| c.is_whitespace() || "$=({[&<>~".contains(c));
        let sign = before.strip_suffix(['-', '\u{2212}']).is_some_and(is_sign);
        let tail = rest.get(at..).unwrap_or_default();
        let length = tail
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(tail.len());
        let digits = tail.get(..length).unwrap_or_default().trim_end_matches('.');
        rest = tail.get(length..).unwrap_or_default();
        let power = rest
            .trim_start()
            .strip_prefix(r"\cdot")
            .and_then(|power| power.trim_start().strip_prefix("10^"));
        let power = power
            .map(|power| power.trim_start_matches('{'))
            .or(rest.strip_prefix('e'));
        let figures = |power: &str| {
            power
                .chars()
                .take_while(|c| c.is_ascii_digit() || *c == '-')
                .collect::<String>()
        };
        let exponent = power.map(figures).filter(|figures| !figures.is_empty());
        if let (Some(exponent), Some(power)) = (&exponent, power) {
            rest = power.get(exponent.len()..).unwrap_or_default();
        }
        let sign = if sign { "-" } else { "" };
        let exponent = exponent.map_or(String::new(), |exponent| format!("e{exponent}"));
        numbers.push(format!("{sign}{point}{digits}{exponent}"));
    }
    if comment.is_on_line {
        numbers.pop()
    } else {
        numbers.into_iter().next()
    }
}

/// The line of a byte, within its file.
fn line_of(lines: &Text, at: usize) -> usize {
    Source::new(lines, &Spanned::new(at..at, String::new())).place().0
}

/// Fills the sheet with the formulas, and tells what was guessed of all.
fn entries(
    formulas: &[Formula],
    said: Vec<Said>,
    of_displays: &[bool],
    whole: &Whole,
    of_the_pair: bool,
    raw: &mut RawSheet,
    lines: &Text,
) -> Vec<String> {
    let line = |at: usize| line_of(lines, at);
    let mut said: Vec<Said> = said;
    let is_silent: Vec<bool> = said.iter().map(Said::is_nothing).collect();
    // an author who says of each row what it is leaves no doubt
    let silent_displays: BTreeSet<usize> = (0..formulas.len())
        .filter(|&at| is_silent[at] || of_displays.get(at) == Some(&true))
        .map(|at| formulas[at].first)
        .collect();
    for at in 0..said.len() {
        let is_of_display = of_displays[at] && formulas[at].first == at;
        said[at].is_of_row = !is_silent[at] && !is_of_display;
    }
    for at in 1..said.len() {
        // what stands before a display is said of each of its rows that says nothing of its own
        if let Some(formula) = formulas
            .get(at)
            .filter(|formula| formula.first < at && !formula.goes_with_last)
            && of_displays.get(formula.first) == Some(&true)
            && said.get(at).is_some_and(Said::is_nothing)
            && let Some(head) = said.get(formula.first).cloned()
            && let Some(own) = said.get_mut(at)
        {
            *own = Said {
                label: None,
                expect: None,
                ..head
            };
        }
        if let Some(formula) = formulas.get(at).filter(|formula| formula.goes_with_last)
            && let Some(before) = said.get(at - 1).cloned()
            && let Some(own) = said.get_mut(at)
        {
            *own = std::mem::take(own).or(&before, formula.is_link);
        }
    }
    let mut labels = labels(formulas, &said, &line);
    // a label that is said of one row, or before the display, is that of the rows after it that say nothing
    let mut named: Option<(usize, &String)> = None;
    for (at, formula) in formulas.iter().enumerate() {
        if !is_silent[at] {
            named = said[at].label.as_ref().map(|label| (at, label));
        } else if let Some((from, name)) = named {
            let is_of_display = formula.goes_with_last || of_displays.get(from) == Some(&true);
            if formula.first != formulas[from].first || !is_of_display {
                named = None;
                continue;
            }
            let own = labels.own[at].clone();
            if let Some(known) = labels.known.get_mut(name)
                && let Some(place) = known.first().map(|(place, _)| *place)
            {
                known.push((place, own));
            }
        }
    }
    let mut guess = Guess::new(
        formulas,
        raw.symbols.as_ref().map(Spanned::get_ref),
        of_the_pair,
        &whole.members,
    );
    // nobody says anything of any formula
    let is_plain = is_silent.iter().all(|is_silent| *is_silent) && whole.defaults.is_empty() && !guess.has_symbols;
    // each link of a chain with those before it
    let mut links: HashMap<String, Vec<String>> = HashMap::new();
    for (place, (formula, label)) in formulas.iter().zip(&labels.own).enumerate() {
        let before = place
            .checked_sub(1)
            .filter(|_| formula.is_link)
            .and_then(|before| labels.own.get(before));
        if let Some(before) = before {
            let mut chain = links.get(before).cloned().unwrap_or_else(|| vec![before.clone()]);
            chain.push(label.clone());
            links.insert(label.clone(), chain);
        }
    }
    let cited = labels.cited(formulas, &whole.citations);
    for (at, ((formula, own), label)) in formulas.iter().zip(said).zip(&labels.own).enumerate() {
        let tex = formula.tex.clone().unwrap_or_default();
        // a default is of what states something
        let default = whole.defaults.iter().rev().find(|(from, _)| *from <= at);
        let (role, is_skipped) = match (own.role, default) {
            (None, Some((_, role))) => (*role, role.is_none()),
            (role, _) => (role, false),
        };
        let states = tex::relates(&tex);
        if own.skip || is_skipped || (own.role.is_none() && !states && formula.tex.is_ok()) {
            continue;
        }
        let here = |text: String| Spanned::new(formula.part.clone(), text);
        guess.leave(formula.part.start);
        if formula.is_aside {
            raw.equation
                .extend(guess.aside(at, label, formula.until).map(|(role, below)| RawEntry {
                    follows_from: Some(below.into_iter().map(here).collect()),
                    ..RawEntry::new(here(label.clone()), role, here(tex), own.expect.unwrap_or_default())
                }));
            continue;
        }
        let is_doubtful = formula.is_doubtful && silent_displays.contains(&formula.first);
        let in_front = whole.citations.get(formula.first);
        let guessed = guess.of(&Asked {
            at,
            label,
            tex: &tex,
            is_link: formula.is_link,
            is_head: formulas.get(at + 1).is_some_and(|next| next.is_link),
            role,
            is_founded: own.follows_from.is_some(),
            is_doubtful,
            has_alternatives: in_front.is_some_and(|cited| cited.has_alternatives),
            until: formula.until,
            cited: cited.get(formula.first).map_or(&[][..], Vec::as_slice),
        });
        let mut unread = formula.tex.clone().err().or(own.problem).or_else(|| guess.conflict(at));
        let mut follows_from = guessed.follows_from;
        for asked in own.follows_from.iter().flatten() {
            match labels.find(asked) {
                // a = b = c under (2) is what (1) and (2) say together, but for a row of this chain
                Ok(found) => {
                    let whole = |cited: String| {
                        let chain = links.get(&cited).filter(|chain| !chain.contains(label));
                        chain.cloned().unwrap_or_else(|| vec![cited])
                    };
                    follows_from.extend(found.into_iter().flat_map(whole));
                }
                Err(problem) => unread = Some(format!("follows from `{asked}`, which is {problem}")),
            }
        }
        let standing = match guessed.role {
            _ if !is_plain || role.is_some() => Standing::Said,
            Role::Definition => Standing::Definition,
            _ if formula.is_link => Standing::Link,
            _ => guessed.standing,
        };
        raw.equation.push(RawEntry {
            local: own.local,
            with: own.with,
            assume: own
                .assume
                .into_iter()
                .chain(guessed.assume.into_iter().map(here))
                .collect(),
            follows_from: Some(follows_from.into_iter().map(here).collect()),
            names: formula.labels.clone(),
            guessed: guessed.guessed,
            standing,
            said: whole.members.said_of(&tex),
            need_not_hold: whole.members.says_more || in_front.is_some_and(|cited| cited.is_condition),
            unread,
            ..RawEntry::new(
                here(label.clone()),
                guessed.role,
                here(tex),
                own.expect.unwrap_or_default(),
            )
        });
    }
    guess.complete(raw, lines);
    // a claim rests on what is guessed of all that it follows from
    let labels = |entry: &RawEntry| {
        entry
            .follows_from
            .iter()
            .flatten()
            .map(|own| own.get_ref().clone())
            .collect()
    };
    let below: HashMap<String, Vec<String>> = raw
        .equation
        .iter()
        .map(|entry| (entry.label.get_ref().clone(), labels(entry)))
        .collect();
    for entry in raw.equation.iter_mut().filter(|entry| entry.role == Role::Claim) {
        entry.guessed.extend(guess.beneath(entry.label.get_ref(), &below));
        let open = guess.open_questions(entry, &below);
        (entry.doubts, entry.constants, entry.held) = (open.doubts, open.constants, open.held);
        entry.second_values = open.second_values;
        let marked = open.marked;
        (entry.operators, entry.identities, entry.marked) = (marked.operators, marked.identities, marked.doubts);
        entry.columns = !entry.operators.is_empty() && guess.may_have_columns && !whole.members.has_other_columns;
    }
    guess.told()
}

/// Lets the displays within parts of the text that hold to their ends alone hold to these.
fn end_within(parts: &[Range<usize>], formulas: &mut [Formula]) {
    for formula in formulas.iter_mut().filter(|formula| !formula.is_aside) {
        let around = parts.iter().filter(|part| part.contains(&formula.part.start));
        formula.until = around.map(|part| part.end).min().unwrap_or(usize::MAX);
    }
}

/// A formula that a name calls: where its display starts, the line of that, and its label.
type Called = ((usize, usize), String);

/// The labels of the formulas, and what else they are called.
struct Labels {
    own: Vec<String>,
    /// The formulas that are called by a name: where their display or row starts, on which line, and their label.
    known: HashMap<String, Vec<Called>>,
}

impl Labels {
    /// The labels of what is called by a name.
    ///
    /// # Errors
    /// What to say of a name that is none, or that of more displays or rows than one.
    fn find(&self, asked: &str) -> Result<Vec<String>, String> {
        let found = self.known.get(asked).map_or(&[][..], Vec::as_slice);
        let places: BTreeSet<(usize, usize)> = found.iter().map(|(place, _)| *place).collect();
        let shown: Vec<String> = places.iter().map(|(_, line)| format!("line {line}")).collect();
        match shown.len() {
            0 => {
                let meant = nearest(asked, self.known.keys().map(String::as_str));
                let meant = meant.map_or(String::new(), |label| format!("; did you mean `{label}`?"));
                Err(format!("no label here{meant}"))
            }
            1 => Ok(found.iter().map(|(_, label)| label.clone()).collect()),
            _ => Err(format!(
                "the name of more than one formula, at {}: call one of them by another label",
                shown.join(" and ")
            )),
        }
    }

    /// Returns for each display, by the number of its first formula, the labels of the formulas that are named in front of it.
    fn cited(&self, formulas: &[Formula], citations: &[Cited]) -> Vec<Vec<String>> {
        let mut before: Option<usize> = None;
        let mut last: Option<usize> = None;
        let mut all = Vec::new();
        for (formula, cited) in formulas.iter().zip(citations) {
            if !formula.is_aside && last != Some(formula.first) {
                (before, last) = (last, Some(formula.first));
            }
            let names = cited.names.iter().filter_map(|name| self.find(name).ok());
            let mut found: Vec<String> = names.flatten().collect();
            if let Some(before) = before.filter(|_| cited.goes_on) {
                let rows = formulas.iter().zip(&self.own).skip(before);
                let rows = rows.take_while(|(own, _)| own.first == before || own.is_aside);
                found.extend(rows.filter(|(own, _)| !own.is_aside).map(|(_, label)| label.clone()));
            }
            all.push(found);
        }
        all
    }
}

/// A formula is called by its number or tag, else by its label, else by its line. Several under one number are called 7.1, 7.2.
fn labels(formulas: &[Formula], said: &[Said], line: &dyn Fn(usize) -> usize) -> Labels {
    let mut labels = Labels {
        own: Vec::new(),
        known: HashMap::new(),
    };
    let (mut start, mut taken) = (0, HashSet::new());
    // how often a label was counted up
    let mut counts: HashMap<String, usize> = HashMap::new();
    while start < formulas.len() {
        let length = 1 + formulas
            .iter()
            .skip(start + 1)
            .take_while(|formula| formula.goes_with_last)
            .count();
        let chain: Vec<&Formula> = formulas.iter().skip(start).take(length).collect();
        let mut numbers: Vec<Option<String>> = chain.iter().map(|formula| formula.number.clone()).collect();
        // a number that stands beside the last row of several is that of all
        for at in (0..length.saturating_sub(1)).rev() {
            if numbers[at].is_none() {
                numbers[at] = numbers[at + 1].clone();
            }
        }
        for at in 1..length {
            if numbers[at].is_none() {
                numbers[at] = numbers[at - 1].clone();
            }
        }
        let head = chain.first().map_or(0, |formula| formula.part.start);
        let name = chain.iter().find_map(|formula| formula.labels.first().cloned());
        let place = if chain.iter().all(|formula| formula.is_aside) {
            "text of line"
        } else {
            "line"
        };
        let name = name.unwrap_or_else(|| format!("{place} {}", line(head)));
        let bases: Vec<String> = numbers
            .into_iter()
            .map(|number| number.unwrap_or_else(|| name.clone()))
            .collect();
        let mut alike: HashMap<&str, Vec<&Formula>> = HashMap::new();
        let mut ranks: HashMap<(&str, usize), usize> = HashMap::new();
        for (formula, base) in chain.iter().zip(&bases) {
            alike.entry(base).or_default().push(formula);
        }
        // what is given beside an equation may stand behind it
        for beside in alike.values_mut() {
            beside.sort_by_key(|formula| formula.part.start);
        }
        for (at, (formula, base)) in chain.iter().zip(&bases).enumerate() {
            let beside = alike.get(base.as_str()).map_or(&[][..], Vec::as_slice);
            let before = beside.partition_point(|other| other.part.start < formula.part.start);
            let here = ranks.entry((base, before)).or_default();
            *here += 1;
            let rank = before + *here;
            let mut label = if beside.len() > 1 {
                format!("{base}.{rank}")
            } else {
                base.clone()
            };
            if let Some(own) = said.get(start + at).and_then(|said| said.label.clone()) {
                label = own;
            }
            if !taken.insert(label.clone()) {
                // of several on one line the second is `line 3 (2)`
                let here = format!("line {}", line(formula.part.start));
                let by_line = if base == &here {
                    None
                } else {
                    Some(format!("{label} ({here})"))
                };
                let count = counts.entry(label.clone()).or_insert(1);
                let counted = std::iter::repeat_with(|| {
                    *count += 1;
                    format!("{label} ({count})")
                });
                let mut names = by_line.into_iter().chain(counted);
                label = names.find(|name| !taken.contains(name)).unwrap_or_default();
                taken.insert(label.clone());
            }
            let mut called: Vec<&String> = vec![&label];
            called.extend((*base != label).then_some(base));
            // what stands under one number has its labels together
            let names = beside.iter().flat_map(|formula| &formula.labels);
            called.extend(names.filter(|name| **name != label && **name != *base));
            called.dedup();
            for name in called {
                let known = labels.known.entry(name.clone()).or_default();
                known.push(((head, line(head)), label.clone()));
            }
            labels.own.push(label);
        }
        start += length;
    }
    labels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_beside_a_comment_is_the_one_that_prints() {
        for (line, wanted) in [
            ("$v_0 = 0.68$, $v_1$", "0.68"),
            ("0{,}68", "0.68"),
            ("is .68", "0.68"),
            (r"0.677\,448", "0.677448"),
            (r"$6.8\cdot 10^{-1}$", "6.8e-1"),
            (r"$-6.8 \times 10^{4}$ V", "-6.8e4"),
            ("6.8e-1", "6.8e-1"),
            ("0.5--0.68", "0.68"),
            ("$a-0.68$", "0.68"),
            (r"$-0.68\,\mathrm{m/s^2}$", "-0.68"),
            (r"0.68 \pm 0.01", "0.68"),
            (r"x & 0.68 \\[2pt]", "0.68"),
            (r"0.68~\cite{x2010} \label{eq3}", "0.68"),
        ] {
            let comment = Comment {
                part: 0..0,
                text: String::new(),
                line: line.to_owned(),
                is_on_line: true,
                after: 0,
            };
            assert_eq!(printed_number(&comment).as_deref(), Some(wanted), "{line}");
        }
    }
}
