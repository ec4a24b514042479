//! The author's own commands.

use super::tex::{BRACES, SQUARE, after_blanks, command, group};
use std::collections::HashMap;

/// A formula that takes more replacements than this, or grows longer, is given up: its macros recurse.
const MOST_REPLACED: usize = 10_000;
const LONGEST: usize = 1_000_000;

/// A command of the author's.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Macro {
    parameters: usize,
    /// What the first parameter is where it is left out.
    default: Option<String>,
    body: String,
    /// Why it cannot be used.
    problem: Option<&'static str>,
}

/// The commands that a document has defined so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Macros(HashMap<String, Macro>);

impl Macros {
    /// Reads the definition by the command that ends at byte `end`; says what it defines, and where it ends. What is no
    /// definition of a kind that is known is passed over. With a `problem` it cannot be used.
    pub(super) fn read(
        &mut self,
        text: &str,
        name: &str,
        end: usize,
        problem: Option<&'static str>,
    ) -> Option<(String, usize)> {
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
                let open = next + text.get(next..)?.find('{')?;
                let parameters = text.get(next..open)?.trim();
                // only #1#2 in their order
                let plain: String = (1..=parameters.len() / 2).map(|n| format!("#{n}")).collect();
                if parameters != plain {
                    return Some((defined, group(text, open, BRACES)?.end + 1));
                }
                (parameters.len() / 2, None, group(text, open, BRACES)?)
            }
            "DeclareMathOperator" => (0, None, group(text, next, BRACES)?),
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
            _ => body,
        };
        if name != "providecommand" || !self.0.contains_key(&defined) {
            let known = Macro {
                parameters,
                default,
                body,
                problem,
            };
            self.0.insert(defined.clone(), known);
        }
        Some((defined, end))
    }

    /// Where the arguments of a macro end that starts behind byte `next`, if it prints none of them.
    pub(super) fn leaves_out(&self, name: &str, text: &str, next: usize) -> Option<usize> {
        let known = self.0.get(name)?;
        let is_silent = known.parameters > 0 && known.problem.is_none() && !known.body.contains('#');
        is_silent
            .then(|| known.applied(text, next).map(|(_, end)| end))
            .flatten()
    }

    /// Whether a macro is the beginning of an environment, or its end, and nothing else; and of which.
    pub(super) fn layout(&self, name: &str) -> Option<(bool, &str)> {
        let known = self
            .0
            .get(name)
            .filter(|known| known.problem.is_none() && known.parameters == 0)?;
        let body = known.body.trim();
        let (word, next) = command(body, 0);
        let own = group(body, next, BRACES).filter(|own| own.end + 1 == body.len())?;
        let is_layout = body.starts_with('\\') && matches!(word, "begin" | "end");
        is_layout.then_some((word == "begin", body.get(own)?.trim()))
    }

    /// The formula with every macro replaced.
    ///
    /// # Errors
    /// What to say of macros that recurse or lack an argument.
    pub(super) fn expanded(&self, tex: &str) -> Result<String, String> {
        let (mut text, mut at, mut replaced) = (tex.to_owned(), 0, 0);
        while let Some(found) = text.get(at..).and_then(|rest| rest.find('\\')) {
            let start = at + found;
            let (name, end) = command(&text, start);
            let Some(known) = self.0.get(name) else {
                at = end;
                continue;
            };
            if let Some(problem) = known.problem {
                return Err(format!(r"the macro `\{name}` {problem}"));
            }
            replaced += 1;
            if replaced > MOST_REPLACED || text.len() > LONGEST {
                return Err(format!(r"the macro `\{name}` goes on for ever"));
            }
            let (put_in, end) = known
                .applied(&text, end)
                .ok_or_else(|| format!(r"the macro `\{name}` lacks an argument"))?;
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
    /// What stands for the macro with the arguments that start at byte `at`, and where these end.
    fn applied(&self, text: &str, mut at: usize) -> Option<(String, usize)> {
        let mut arguments: Vec<String> = Vec::new();
        if let Some(default) = &self.default {
            match group(text, at, SQUARE) {
                Some(own) => {
                    at = own.end + 1;
                    arguments.push(text.get(own)?.to_owned());
                }
                None => arguments.push(default.clone()),
            }
        }
        while arguments.len() < self.parameters {
            let start = after_blanks(text, at);
            let own = match group(text, start, BRACES) {
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
            arguments.push(text.get(own)?.to_owned());
        }
        let mut parts = self.body.split('#');
        let mut body = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let number = part.chars().next().and_then(|c| c.to_digit(10));
            match number.and_then(|number| arguments.get((number as usize).checked_sub(1)?)) {
                // TeX puts in tokens: letters never make a command longer
                Some(argument) => {
                    for text in [argument, part.get(1..).unwrap_or_default()] {
                        let space = if goes_on(&body, text) { " " } else { "" };
                        body.push_str(space);
                        body.push_str(text);
                    }
                }
                None => {
                    body.push('#');
                    body.push_str(part);
                }
            }
        }
        Some((body, at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn macros(definitions: &[&str]) -> Macros {
        let mut macros = Macros::default();
        for text in definitions {
            let (name, end) = command(text, 0);
            let read = macros.read(text, name, end, None);
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
        ]);
        for (tex, wanted) in [
            (r"\vel_k = a", r"\dot{x}_k = a"),
            (r"\pd{\vel}t", r"\frac{\partial \dot{x}}{\partial t}"),
            (r"\at{x} + \at[k+1]{x}", r"x_{k} + x_{k+1}"),
            (r"\half a", r"\frac{a}{2}"),
            (r"\Tr M", r"\operatorname{Tr} M"),
            (r"\cos\letter x + \cos\id{h x}", r"\cos h x + \cos h x"),
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
