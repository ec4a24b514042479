//! The author's own commands.

use super::tex::{BRACES, Groups, SQUARE, after_blanks, command, group, words};
use std::cell::Cell;
use std::collections::HashMap;
use std::ops::Range;
use texmath::LONGEST;

/// A formula that takes more replacements than this is given up: its macros recurse.
const MOST_REPLACED: usize = 10_000;

/// The most characters that the macros of a document may be read and written over, all formulas taken together.
const MOST_WRITTEN: usize = 1 << 27;

/// The least cost of a replacement, in characters that are read and written over.
const REPLACEMENT: usize = 64;

/// The longest text between a name that `\def` defines and the brace of its body.
const LONGEST_PARAMETERS: usize = 100;

/// The commands that define commands.
pub(super) const DEFINING: [&str; 11] = [
    "newcommand",
    "renewcommand",
    "providecommand",
    "DeclareMathOperator",
    "DeclarePairedDelimiter",
    "NewDocumentCommand",
    "RenewDocumentCommand",
    "ProvideDocumentCommand",
    "DeclareDocumentCommand",
    "def",
    "gdef",
];

/// Returns how many arguments xparse's `o m m` stands for, and the default of the first where it may be left out; `None` where it
/// is more than that.
fn arguments_of(kinds: &str) -> Option<(usize, Option<String>)> {
    let kinds = kinds.trim();
    let (default, rest) = match kinds.chars().next() {
        Some('o') => (Some(String::new()), kinds.get(1..)?),
        Some('O') => {
            let own = group(kinds, 1, BRACES)?;
            (Some(kinds.get(own.clone())?.to_owned()), kinds.get(own.end + 1..)?)
        }
        _ => (None, kinds),
    };
    let is_plain = rest.chars().all(|c| c == 'm' || c.is_whitespace());
    let count = rest.matches('m').count() + usize::from(default.is_some());
    is_plain.then_some((count, default))
}

/// A command of the author's.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Macro {
    parameters: usize,
    /// What the first parameter is where it is left out.
    default: Option<String>,
    body: String,
    /// True if its body prints none of its parameters.
    is_silent: bool,
    /// True if a star and a size in square brackets may stand before its argument, which print nothing of their own.
    is_sized: bool,
    /// The environment that it begins, or ends, if it does nothing else.
    layout: Option<(bool, String)>,
    /// Why it cannot be used.
    problem: Option<&'static str>,
}

/// Why a macro is not replaced.
enum Unusable {
    LacksAnArgument,
    TooLong,
}

/// The commands that a document has defined so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Macros {
    known: HashMap<String, Macro>,
    /// The characters that were read and written over so far.
    written: Cell<usize>,
}

impl Macros {
    /// Reads the definition by the command that ends at byte `end`; says what it defines, and where it ends. What is no
    /// definition of a kind that is known is passed over. With a `problem` it cannot be used.
    pub(super) fn read(
        &mut self,
        text: &str,
        name: &str,
        end: usize,
        groups: &Groups,
        problem: Option<&'static str>,
    ) -> Option<(String, usize)> {
        let group = |text: &str, at: usize, brackets: [u8; 2]| groups.group(text, at, brackets);
        let name = if name == "gdef" { "def" } else { name };
        let star = usize::from(text.as_bytes().get(end) == Some(&b'*'));
        let start = after_blanks(text, end + star);
        // \newcommand{\x} or \newcommand\x
        let (defined, next) = match group(text, start, BRACES) {
            Some(own) if name != "def" => (
                text.get(own.clone())?.trim().strip_prefix('\\')?.to_owned(),
                own.end + 1,
            ),
            _ if text.as_bytes().get(start) == Some(&b'\\') => {
                let (defined, next) = command(text, start);
                (defined.to_owned(), next)
            }
            _ => return None,
        };
        let (parameters, default, body) = match name {
            "def" => {
                let open = next
                    + text
                        .as_bytes()
                        .get(next..)?
                        .iter()
                        .take(LONGEST_PARAMETERS)
                        .position(|c| *c == b'{')?;
                let parameters = text.get(next..open)?.trim();
                // only #1#2 in their order
                let plain: String = (1..=parameters.len() / 2).map(|n| format!("#{n}")).collect();
                if parameters != plain {
                    return Some((defined, group(text, open, BRACES)?.end + 1));
                }
                (parameters.len() / 2, None, group(text, open, BRACES)?)
            }
            "DeclareMathOperator" => (0, None, group(text, next, BRACES)?),
            "DeclarePairedDelimiter" => {
                let left = group(text, next, BRACES)?;
                (1, None, left.start..group(text, left.end + 1, BRACES)?.end)
            }
            "NewDocumentCommand" | "RenewDocumentCommand" | "ProvideDocumentCommand" | "DeclareDocumentCommand" => {
                let arguments = group(text, next, BRACES)?;
                let (count, default) = arguments_of(text.get(arguments.clone())?)?;
                (count, default, group(text, arguments.end + 1, BRACES)?)
            }
            _ => {
                let count = group(text, next, SQUARE);
                let next = count.as_ref().map_or(next, |count| count.end + 1);
                let default = group(text, next, SQUARE).filter(|_| count.is_some());
                let next = default.as_ref().map_or(next, |default| default.end + 1);
                let count = count
                    .and_then(|count| text.get(count))
                    .map_or(Some(0), |count| count.trim().parse().ok());
                let default = default.and_then(|default| text.get(default)).map(str::to_owned);
                (count?, default, group(text, next, BRACES)?)
            }
        };
        let end = body.end + 1;
        let body = text.get(body)?.to_owned();
        let body = match name {
            "DeclareMathOperator" => format!(r"\operatorname{{{body}}}"),
            "DeclarePairedDelimiter" => {
                let (left, right) = body.split_once('}')?;
                format!(r"\left{left}#1\right{}", right.split_once('{')?.1)
            }
            _ => body,
        };
        if !matches!(name, "providecommand" | "ProvideDocumentCommand") || !self.known.contains_key(&defined) {
            let known = Macro {
                parameters,
                default,
                is_sized: name == "DeclarePairedDelimiter",
                is_silent: parameters > 0 && problem.is_none() && !body.contains('#'),
                layout: layout(&body).filter(|_| problem.is_none() && parameters == 0),
                body,
                problem,
            };
            self.known.insert(defined.clone(), known);
        }
        Some((defined, end))
    }

    /// Reads the definitions of a text that prints nothing, as a preamble; what is none is passed over.
    pub(super) fn learn(&mut self, text: &str) {
        let groups = Groups::of(text);
        let mut read_to = 0;
        for (word, next) in words(text) {
            if next >= read_to && DEFINING.contains(&word) {
                read_to = self.read(text, word, next, &groups, None).map_or(next, |(_, end)| end);
            }
        }
    }

    /// Returns the end of the arguments of a macro that starts behind byte `next`, if it prints none of them.
    pub(super) fn leaves_out(&self, name: &str, text: &str, next: usize, groups: &Groups) -> Option<usize> {
        let known = self.known.get(name).filter(|known| known.is_silent)?;
        let find = |at: usize, brackets: [u8; 2]| groups.group(text, at, brackets);
        known.arguments(text, next, &find).map(|(_, end)| end)
    }

    /// Whether a macro is the beginning of an environment, or its end, and nothing else; and of which.
    pub(super) fn layout(&self, name: &str) -> Option<(bool, &str)> {
        let (opens, own) = self.known.get(name)?.layout.as_ref()?;
        Some((*opens, own))
    }

    /// The formula with every macro replaced.
    ///
    /// # Errors
    /// A message about macros that recurse, lack an argument or make the formula, or the document, too long.
    pub(super) fn expanded(&self, tex: &str) -> Result<String, String> {
        let (mut text, mut at, mut replaced) = (tex.to_owned(), 0, 0);
        while let Some(found) = text.get(at..).and_then(|rest| rest.find('\\')) {
            let start = at + found;
            let (name, end) = command(&text, start);
            let Some(known) = self.known.get(name) else {
                at = end;
                continue;
            };
            if let Some(problem) = known.problem {
                return Err(format!(r"the macro `\{name}` {problem}"));
            }
            replaced += 1;
            if replaced > MOST_REPLACED {
                return Err(format!(r"the macro `\{name}` goes on for ever"));
            }
            let written = self.written.get() + text.len() + REPLACEMENT;
            self.written.set(written);
            if written > MOST_WRITTEN {
                return Err(format!(
                    r"the macro `\{name}` is not replaced: the macros of this document come to more than {} million characters",
                    MOST_WRITTEN / 1_000_000
                ));
            }
            let (put_in, end) = known.applied(&text, end).map_err(|unusable| match unusable {
                Unusable::LacksAnArgument => format!(r"the macro `\{name}` lacks an argument"),
                Unusable::TooLong => {
                    format!(r"the macro `\{name}` makes the formula longer than {LONGEST} characters")
                }
            })?;
            let before = text.get(..start).unwrap_or_default();
            let behind = text.get(end..).unwrap_or_default();
            let space = if goes_on(before, &put_in) { " " } else { "" };
            // a blank behind it too where it is a command or ends with a letter, as a word would
            let is_word = put_in.ends_with(|c: char| c.is_ascii_alphabetic());
            let blank = if is_word && begins_with_letter(behind) { " " } else { "" };
            text.replace_range(start..end, &format!("{space}{put_in}{blank}"));
            at = start;
        }
        Ok(text)
    }
}

/// Whether `behind` would make a command longer that `before` ends with.
fn goes_on(before: &str, behind: &str) -> bool {
    let letters = before.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    letters.len() < before.len() && letters.ends_with('\\') && begins_with_letter(behind)
}

fn begins_with_letter(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
}

impl Macro {
    /// Returns the ranges of the arguments of a macro that start at byte `at`, the default left out, and the end of the last.
    fn arguments(
        &self,
        text: &str,
        mut at: usize,
        group: &dyn Fn(usize, [u8; 2]) -> Option<Range<usize>>,
    ) -> Option<(Vec<Option<Range<usize>>>, usize)> {
        let mut arguments = Vec::new();
        if self.is_sized {
            at += usize::from(text.as_bytes().get(at) == Some(&b'*'));
            at = group(at, SQUARE).map_or(at, |size| size.end + 1);
        }
        if self.default.is_some() {
            let own = group(at, SQUARE);
            at = own.as_ref().map_or(at, |own| own.end + 1);
            arguments.push(own);
        }
        while arguments.len() < self.parameters {
            let start = after_blanks(text, at);
            let own = match group(start, BRACES) {
                Some(own) => {
                    at = own.end + 1;
                    own
                }
                None => {
                    let end = match text.get(start..)?.chars().next()? {
                        '\\' => command(text, start).1,
                        '}' => return None,
                        c => start + c.len_utf8(),
                    };
                    at = end;
                    start..end
                }
            };
            arguments.push(Some(own));
        }
        Some((arguments, at))
    }

    /// Returns the replacement of the macro with the arguments that start at byte `at`, and the end of these.
    fn applied(&self, text: &str, at: usize) -> Result<(String, usize), Unusable> {
        let find = |at: usize, brackets: [u8; 2]| group(text, at, brackets);
        let (arguments, at) = self.arguments(text, at, &find).ok_or(Unusable::LacksAnArgument)?;
        let default = self.default.as_deref().unwrap_or_default();
        let argument = |own: Option<Range<usize>>| own.map_or(Some(default), |own| text.get(own));
        let arguments: Option<Vec<&str>> = arguments.into_iter().map(argument).collect();
        let arguments = arguments.ok_or(Unusable::LacksAnArgument)?;
        let fits = |text: &str| text.len() <= LONGEST;
        if !fits(text) || !fits(&self.body) {
            return Err(Unusable::TooLong);
        }
        let mut parts = self.body.split('#');
        let mut body = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let number = part.chars().next().and_then(|c| c.to_digit(10));
            match number.and_then(|number| arguments.get((number as usize).checked_sub(1)?)) {
                // TeX puts in tokens: letters never make a command longer
                Some(argument) => {
                    for text in [*argument, part.get(1..).unwrap_or_default()] {
                        let space = if goes_on(&body, text) { " " } else { "" };
                        body.push_str(space);
                        body.push_str(text);
                        if !fits(&body) {
                            return Err(Unusable::TooLong);
                        }
                    }
                }
                None => {
                    body.push('#');
                    body.push_str(part);
                }
            }
        }
        Ok((body, at))
    }
}

/// The environment that the body of a macro begins, or ends, if it does nothing else.
fn layout(body: &str) -> Option<(bool, String)> {
    let body = body.trim();
    let (word, next) = command(body, 0);
    let own = group(body, next, BRACES).filter(|own| own.end + 1 == body.len())?;
    let is_layout = body.starts_with('\\') && matches!(word, "begin" | "end");
    is_layout.then_some((word == "begin", body.get(own)?.trim().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn macros(definitions: &[&str]) -> Macros {
        let mut macros = Macros::default();
        for text in definitions {
            let (name, end) = command(text, 0);
            let read = macros.read(text, name, end, &Groups::of(text), None);
            assert_eq!(read.map(|(_, end)| end), Some(text.len()), "{text}");
        }
        macros
    }

    #[test]
    fn macros_are_replaced_with_their_arguments() {
        let macros = macros(&[
            r"\newcommand{\vel}{\dot{x}}",
            r"\newcommand\pd[2]{\frac{\partial #1}{\partial #2}}",
            r"\newcommand{\at}[2][k]{#2_{#1}}",
            r"\def\half#1{\frac{#1}{2}}",
            r"\DeclareMathOperator*{\Tr}{Tr}",
            r"\renewcommand{\phi}{\varphi}",
            r"\providecommand{\vel}{wrong}",
            r"\newcommand{\letter}{h}",
            r"\newcommand{\id}[1]{#1}",
            r"\newcommand{\twice}[1]{\half{#1}+\half{#1}}",
            r"\newcommand{\tangent}[1]{\tan#1}",
            r"\newcommand{\first}[1]{#1}",
            r"\newcommand{\order}[2]{#1\ge#2}",
            r"\DeclarePairedDelimiter{\size}{\lvert}{\rvert}",
            r"\NewDocumentCommand{\by}{O{t} m}{\frac{d#2}{d#1}}",
        ]);
        for (tex, wanted) in [
            (r"\vel_k = a", r"\dot{x}_k = a"),
            (r"\pd{\vel}t", r"\frac{\partial \dot{x}}{\partial t}"),
            (r"\at{x} + \at[k+1]{x}", r"x_{k} + x_{k+1}"),
            (r"\half a", r"\frac{a}{2}"),
            (r"\Tr M", r"\operatorname{Tr} M"),
            (r"\cos\letter x + \cos\id{h x}", r"\cos h x + \cos h x"),
            (
                r"\size{x} + \size*[\big]{y}",
                r"\left\lvert x\right\rvert + \left\lvert y\right\rvert",
            ),
            (r"\by{x} + \by[s]{x}", r"\frac{dx}{dt} + \frac{dx}{ds}"),
            (r"\tangent{h} x + \first{\tan}h", r"\tan h x + \tan h"),
            (r"\order{p}{q}", r"p\ge q"),
            (r"\phi x \\ y", r"\varphi x \\ y"),
            (r"\twice{\vel}", r"\frac{\dot{x}}{2}+\frac{\dot{x}}{2}"),
        ] {
            assert_eq!(macros.expanded(tex).as_deref(), Ok(wanted), "{tex}");
        }
    }

    #[test]
    fn a_macro_that_recurses_is_said_and_bounded() {
        let macros = macros(&[
            r"\newcommand{\a}{\b\b}",
            r"\newcommand{\b}{\a}",
            r"\newcommand{\c}[1]{#1}",
        ]);
        assert!(macros.expanded(r"x = \a").unwrap_err().contains("for ever"));
        assert!(macros.expanded(r"{\c}").unwrap_err().contains("lacks an argument"));
    }

    #[test]
    fn a_macro_that_would_make_a_formula_too_long_is_said_before_it_is_written() {
        let long = format!(r"\newcommand{{\a}}[1]{{{}}}", "#1".repeat(100_000));
        let body = format!(r"\newcommand{{\b}}{{{}}}", "x".repeat(LONGEST + 1));
        let macros = macros(&[&long, &body, r"\newcommand{\c}{\c\c}"]);
        let argument = format!(r"\a{{{}}}", "x".repeat(50_000));
        for tex in [argument.as_str(), r"\b"] {
            assert!(
                macros.expanded(tex).unwrap_err().contains("longer than 100000"),
                "{tex:.10}"
            );
        }
        // what all formulas together may cost
        let last = (0..200).map(|_| macros.expanded(r"\c").unwrap_err()).last();
        assert!(last.unwrap().contains("of this document"));
    }

    #[test]
    fn a_macro_that_begins_or_ends_an_environment_is_told_from_one_that_has_a_group() {
        let macros = macros(&[
            r"\newcommand{\be}{\begin{equation}}",
            r"\newcommand{\ee}{\end{equation}}",
            r"\newcommand{\vx}{\mathbf{x}}",
            r"\newcommand{\sq}[1]{\begin{#1}}",
        ]);
        assert_eq!(macros.layout(r"be"), Some((true, "equation")));
        assert_eq!(macros.layout(r"ee"), Some((false, "equation")));
        assert_eq!(
            [macros.layout(r"vx"), macros.layout(r"sq"), macros.layout(r"none")],
            [None; 3]
        );
    }
}
