//! Letters that vary with others, by what a document prints and says of them: what it differentiates, calls or marks by dots.

use super::tex::unspaced;
use std::collections::BTreeSet;
use texmath::{
    BOLD, Equation, Name, Names, Opaque, Operation, Tree, any, any_side, derivative_of, is_constant, is_opaque,
    letters, names_in, read_name, with_commands,
};

/// The letters of a document that may vary.
#[derive(Clone, Debug, Default)]
pub(super) struct Varying {
    /// Those that are differentiated, called or marked so, or of which the text says it.
    letters: BTreeSet<String>,
    /// Those that have a value in terms of others.
    valued: BTreeSet<String>,
}

impl Varying {
    /// The letters that equations differentiate by themselves, call, or mark by dots and primes, those behind a sign of a
    /// difference or differential, those that have a value, and those of which the text says that they vary.
    pub fn of<'e>(equations: impl Iterator<Item = &'e Equation>, texts: &[String], said: &BTreeSet<String>) -> Self {
        let (mut letters, mut valued) = (said.clone(), BTreeSet::new());
        for equation in equations {
            any_side(equation, &mut |node| {
                let name = match node {
                    Tree::Operation(operation, _) => match &**operation {
                        Operation::Derivative { of, .. } => match innermost(of) {
                            Tree::Symbol(name, _) => Some(name),
                            _ => None,
                        },
                        _ => None,
                    },
                    Tree::Call(name, ..) | Tree::Partial { of: name, .. } => Some(name),
                    Tree::Symbol(name, _) if is_opaque(name) => {
                        let called = name.base.split_once('(').map(|(called, _)| called);
                        letters.extend(derivative_of(&name.base).or(called).map(bare));
                        None
                    }
                    Tree::Symbol(name, _) if name.primes > 0 || is_dotted(name) => Some(name),
                    _ => None,
                };
                letters.extend(name.map(plain));
                false
            });
            // what has a value in terms of others
            if let Tree::Symbol(name, _) = &equation.left
                && any(
                    &equation.right,
                    &mut |node| matches!(node, Tree::Symbol(other, _) if !is_constant(other)),
                )
            {
                valued.insert(plain(name));
            }
        }
        for text in texts {
            letters.extend(differences(text));
        }
        Self { letters, valued }
    }

    /// Returns true if the notation of a letter, or the text, says that it varies.
    pub fn contains(&self, name: &Name) -> bool {
        self.letters.contains(&plain(name))
    }

    /// Returns true if an equation gives a letter in terms of others.
    pub fn has_value(&self, name: &Name) -> bool {
        self.valued.contains(&plain(name))
    }

    /// Returns true if a letter is constant by convention: one of those that authors take for constants, or the value at a start,
    /// `x_0`, of which the document does not say that it varies.
    fn is_constant(&self, name: &Name) -> bool {
        (CONSTANTS.contains(&name.base.as_str()) || name.subscript == "0")
            && !self.contains(name)
            && !self.has_value(name)
    }
}

/// Letters that are constants by convention, the first ones of the alphabet since Descartes (La Geometrie, 1637).
const CONSTANTS: [&str; 22] = [
    "a", "b", "c", "g", "k", "m", "n", "A", "B", "C", "M", "N", r"\alpha", r"\beta", r"\gamma", r"\kappa", r"\lambda",
    r"\mu", r"\sigma", r"\tau", r"\omega", r"\hbar",
];

/// A name as it prints without dots and primes.
fn plain(name: &Name) -> String {
    let name = Name {
        primes: 0,
        ..name.without_dots()
    };
    bare(&name.to_string())
}

/// A text without braces and blanks.
fn bare(text: &str) -> String {
    text.replace(['{', '}', ' '], "")
}

fn is_dotted(name: &Name) -> bool {
    name.accents.last().is_some_and(|accent| accent.ends_with("dot"))
}

/// Signs in front of a letter that varies.
const BEFORE: [&str; 14] = [
    r"\frac{d",
    r"\dfrac{d",
    r"\tfrac{d",
    r"\frac{\mathrm{d}",
    r"\mathrm{d}",
    r"\frac{\partial",
    r"\dfrac{\partial",
    r"\partial_",
    r"\nabla",
    r"\Delta",
    r"\delta",
    r"\dv{",
    r"\pdv{",
    r"\Box",
];

/// The letters right behind signs of a difference, derivative or differential, but for that of an integral: `\mathrm{d}x`.
fn differences(tex: &str) -> Vec<String> {
    let shown = unspaced(tex);
    let has_integrals = shown.contains(r"\int");
    let mut found = Vec::new();
    for sign in BEFORE {
        if sign == r"\mathrm{d}" && has_integrals {
            continue;
        }
        for (at, _) in shown.match_indices(sign) {
            let behind = shown.get(at + sign.len()..).unwrap_or_default();
            let behind = match behind.strip_prefix('{').filter(|_| sign.ends_with('_')) {
                Some(group) => {
                    let close = group.char_indices().take(LONGEST).find(|(_, c)| *c == '}');
                    close.map_or("", |(close, _)| group.get(close + 1..).unwrap_or_default())
                }
                None if sign.ends_with('_') => behind.get(1..).unwrap_or_default(),
                None => behind,
            };
            let behind = behind.trim_start_matches(|c: char| "^{}".contains(c) || c.is_ascii_digit());
            let is_command = behind.starts_with('\\');
            let length = match is_command {
                true => 1 + behind.chars().skip(1).take_while(char::is_ascii_alphabetic).count(),
                false => behind.chars().next().map_or(0, char::len_utf8),
            };
            let (letter, behind) = behind.split_at_checked(length).unwrap_or_default();
            let subscript = match behind.strip_prefix('_') {
                Some(group) if group.starts_with('{') => {
                    let end = group.char_indices().take(LONGEST).find(|(_, c)| *c == '}');
                    end.map_or("", |(end, _)| group.get(1..end).unwrap_or_default())
                }
                Some(sign) => sign.get(..1).unwrap_or_default(),
                None => "",
            };
            let joint = if subscript.is_empty() { "" } else { "_" };
            found.extend((length > 0).then(|| format!("{letter}{joint}{subscript}")));
        }
    }
    found
}

/// The letters that a formula within the text says to vary: what it differentiates, calls, dots or relates to others, `$\dot m$`,
/// `$m(t)$`, `$p = a - b q$`.
pub(super) fn varying_within(tex: &str) -> Vec<String> {
    let mut found = differences(tex);
    let shown = unspaced(&with_commands(tex));
    let bold = Names {
        opaque: Some(Opaque::default()),
        ..Names::default()
    };
    let relations = [
        r"\propto", r"\approx", r"\sim", r"\to", r"\le", r"\ge", r"\mapsto", r"\equiv", "=", "<", ">", ":",
    ];
    let left = relations.iter().filter_map(|sign| shown.find(sign)).min();
    if let Some((left, right)) = left.and_then(|at| shown.split_at_checked(at))
        && right.contains(|c: char| c.is_ascii_alphabetic())
    {
        found.extend(
            read_name(left.trim_end_matches(':'), &bold)
                .ok()
                .map(|name| plain(&name)),
        );
    }
    for (at, _) in [r"\dot", r"\ddot", "'", "("]
        .iter()
        .flat_map(|sign| shown.match_indices(sign))
    {
        let behind = shown.get(at..).unwrap_or_default();
        let before = shown.get(..at).unwrap_or_default();
        let name = match behind.starts_with('\\') {
            true => letters_at(
                behind
                    .trim_start_matches(r"\ddot")
                    .trim_start_matches(r"\dot")
                    .trim_start_matches('{'),
            ),
            false => last_letter(before),
        };
        found.extend(name);
    }
    found
}

/// The letter or command that a text begins with.
fn letters_at(text: &str) -> Option<String> {
    let commands = text
        .strip_prefix('\\')
        .map(|rest| rest.chars().take_while(char::is_ascii_alphabetic).count());
    text.get(..commands.map_or(1, |length| length + 1)).map(str::to_owned)
}

/// The letter or command that a text ends with.
fn last_letter(text: &str) -> Option<String> {
    let name = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    match text.get(name.len()..).filter(|_| name.ends_with('\\')) {
        Some(command) => Some(format!("\\{command}")),
        None => text.chars().next_back().map(String::from),
    }
}

/// The letters of an equation that may vary with one by which it differentiates or integrates.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Dependence {
    /// True if nothing says whether a letter depends on one by which it is differentiated or integrated.
    pub is_open: bool,
    /// Letters that are taken to be the same at every value of another, with this one.
    pub held: BTreeSet<(String, String)>,
}

impl Dependence {
    /// Finds the letters of an equation. `is_value` says that the first letter has a value in terms of the second, `is_of_time` that a letter
    /// is a function of time, by which it may be differentiated.
    pub fn of(
        equation: &Equation,
        varying: &Varying,
        is_value: &dyn Fn(&Name, &Name) -> bool,
        is_of_time: &dyn Fn(&Name, &Name) -> bool,
    ) -> Self {
        let mut found = Self::default();
        any_side(equation, &mut |node| {
            match node {
                Tree::Operation(operation, _) => {
                    if let Operation::Derivative { of, by, .. } | Operation::Integral { of, by, .. } = &**operation {
                        found.take(of, by, varying, is_value, is_of_time);
                    }
                }
                Tree::Product(factors) => found.is_open |= factors.windows(2).any(is_differential),
                _ => {}
            }
            false
        });
        found
    }

    fn take(
        &mut self,
        of: &Tree,
        by: &Name,
        varying: &Varying,
        is_value: &dyn Fn(&Name, &Name) -> bool,
        is_of_time: &dyn Fn(&Name, &Name) -> bool,
    ) {
        // of `\frac{\partial^2 u}{\partial x \partial t}` both letters are arguments of u
        let of = match innermost(of) {
            symbol @ Tree::Symbol(..) => symbol,
            _ => of,
        };
        let mut names = BTreeSet::new();
        names_in(of, &mut names);
        let moves = names.contains(by) || names.iter().any(|name| is_of_time(name, by));
        let others = names.iter().filter(|name| *name != by && !is_constant(name));
        for name in others.filter(|name| !is_value(name, by) && !is_of_time(name, by)) {
            // what does not speak of the letter itself would be a constant, of which nobody takes a derivative
            let is_held = moves && varying.is_constant(name);
            self.is_open |= !is_held;
            self.held.extend(is_held.then(|| (name.to_string(), by.to_string())));
        }
    }
}

/// Returns true for `d x` of what is no constant.
fn is_differential(pair: &[Tree]) -> bool {
    let varies = |tree: &Tree| {
        any(
            tree,
            &mut |node| matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..) if !is_constant(name)),
        )
    };
    matches!(pair, [Tree::Symbol(name, _), of] if name.to_string() == "d" && varies(of))
}

/// Returns what a derivative of derivatives is of.
fn innermost(tree: &Tree) -> &Tree {
    match tree {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Derivative { of, .. } => innermost(of),
            _ => tree,
        },
        tree => tree,
    }
}

/// The derivative by time of more than one letter, in formulas without blanks.
const BY_TIME: [&str; 6] = [
    r"\frac{d}{dt}",
    r"\dfrac{d}{dt}",
    r"\tfrac{d}{dt}",
    r"\frac{\mathrm{d}}{\mathrm{d}t}",
    r"\dv{t}",
    r"\dv*{t}",
];

/// The most formulas that hold a letter which is a function of time: what follows from laws of functions takes long to decide.
const MOST_FORMULAS: usize = 8;

/// The most letters with dots that are looked at.
const MOST_DOTS: usize = 2_000;

/// The most bytes of a letter with dots and a subscript.
const LONGEST: usize = 40;

/// The letters with dots of formulas that hold the derivative by time of more than one letter: functions of time.
pub(super) fn with_dots<'t>(formulas: impl Iterator<Item = &'t str> + Clone) -> Vec<Name> {
    let takes_rates = |tex: &str| {
        let shown = unspaced(tex);
        BY_TIME.iter().any(|sign| shown.contains(sign))
    };
    let mut found = Vec::new();
    // a letter in bold is a name of its own
    let bold = Names {
        opaque: Some(Opaque::default()),
        ..Names::default()
    };
    let mut left = MOST_DOTS;
    for tex in formulas.clone().filter(|tex| takes_rates(tex)) {
        let tex = with_commands(tex);
        let all = [r"\dot", r"\ddot"].iter().flat_map(|sign| tex.match_indices(sign));
        for (at, _) in all.take(left) {
            left = left.saturating_sub(1);
            let behind = tex.get(at..).unwrap_or_default();
            let ends = behind.char_indices().map(|(end, c)| end + c.len_utf8()).take(LONGEST);
            let names = ends.filter_map(|end| read_name(behind.get(..end)?, &bold).ok());
            let Some(mut name) = names.filter(is_dotted).last() else {
                continue;
            };
            name.accents.pop();
            // an index may run
            let is_single = name.accents.is_empty() && !name.subscript.chars().any(|c| c.is_ascii_lowercase());
            if is_single && name.primes == 0 && name.mark.is_empty() && !found.contains(&name) {
                found.push(name);
            }
        }
    }
    // `\mathbf{v}` and its length v cannot both be functions
    let in_bold: BTreeSet<String> = formulas
        .clone()
        .flat_map(|tex| {
            let shown = bare(&unspaced(tex));
            let all = BOLD.iter().flat_map(|bold| shown.match_indices(bold));
            let behind = all.filter_map(|(at, bold)| letters_at(shown.get(at + bold.len()..)?));
            behind.collect::<Vec<_>>()
        })
        .collect();
    found.retain(|name: &Name| !in_bold.contains(&name.base));
    if !found.is_empty() {
        let met: Vec<BTreeSet<String>> = formulas
            .map(|tex| letters(tex, &bold).into_iter().map(|(letter, _)| letter).collect())
            .collect();
        let count = |name: &Name| met.iter().filter(|own| own.contains(&name.base)).count();
        found.retain(|name| count(name) <= MOST_FORMULAS);
    }
    found
}
