//! Commands that change how a formula is printed and not what it says, written as what they stand for; and terms that are not
//! understood, `\mathbb{E}[x]` or `p(x | y)`, written as one symbol each where the reader is told so.
//!
//! They are those of the packages physics, mathtools, nicefrac, cancel, xcolor, siunitx and IEEEtrantools, and some of plain TeX.
//! Each place of what is written knows where in the source it comes from.

use super::command::{holds_unknown, invariant, is_letter as is_letter_command};
use super::elementary::Elementary;
use super::names::BOLD;
use super::relations::related;
use super::units::unit;
use super::{Name, Names};
use std::borrow::Cow;
use std::cell::Cell;

/// The longest formula that is read, in bytes.
pub const LONGEST: usize = 100_000;

/// Groups within groups beyond which nothing is rewritten; the reader refuses what is deeper.
const DEEPEST: usize = 100;

/// Looks at each byte, on average, for brackets that close.
const LOOKED_AT: usize = 20;

/// An argument of a command, as the package xparse names them.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Argument {
    /// A star, or nothing.
    Star,
    /// `[...]`, or nothing.
    Optional,
    /// `{...}` or one token.
    Needed,
    /// `{...}`, or nothing.
    Group,
    /// `(...)`, `[...]`, `|...|` or `{...}`.
    Bracketed,
}

use Argument::{Bracketed, Group, Needed, Optional, Star};

/// The text that takes the place of a command.
#[derive(Clone, Copy)]
enum Written {
    /// The last of these forms all of whose arguments are there; `#1` is the first argument.
    As(&'static [&'static str]),
    /// Its bracketed argument with brackets that grow.
    Brackets,
    /// A matrix in the brackets of its argument.
    Matrix,
    /// The relation that is its second argument.
    Relation,
    /// A number, perhaps with a power of ten: `1.5e-3`.
    Number,
    /// A number of degrees.
    Angle,
    /// A unit, and a number of it where four arguments are wanted.
    Quantity,
    /// Its argument, without the name that a brace gives it behind this sign.
    Named(u8),
}

use Written::{Angle, As, Brackets, Matrix, Named, Number, Quantity, Relation};

type Row = (&'static str, &'static [Argument], Written);

/// Returns a number of siunitx in TeX, `1.5 \cdot 10^{-3}` for `1.5e-3`; nothing for `1,000`, which may be a thousand.
fn decimal(text: &str) -> Option<String> {
    let number = text.trim().to_ascii_lowercase();
    let is_decimal = |text: &str| {
        text.trim_start_matches(['-', '+'])
            .starts_with(|c: char| c.is_ascii_digit() || c == '.')
            && text.parse::<f64>().is_ok()
    };
    match number.split_once('e') {
        Some((figures, power)) if is_decimal(figures) && power.parse::<i32>().is_ok() => {
            Some(format!(r"{figures} \cdot 10^{{{power}}}"))
        }
        None if is_decimal(&number) => Some(number),
        _ => None,
    }
}

static TABLE: &[Row] = &[
    // derivatives and differentials
    (
        "dv",
        &[Star, Optional, Needed, Group],
        As(&[
            r"\frac{d}{d #3}",
            r"\frac{d^{#2}}{d #3^{#2}}",
            r"\frac{d #3}{d #4}",
            r"\frac{d^{#2} #3}{d #4^{#2}}",
        ]),
    ),
    (
        "pdv",
        &[Star, Optional, Needed, Group, Group],
        As(&[
            r"\frac{\partial}{\partial #3}",
            r"\frac{\partial^{#2}}{\partial #3^{#2}}",
            r"\frac{\partial #3}{\partial #4}",
            r"\frac{\partial^{#2} #3}{\partial #4^{#2}}",
            r"\frac{\partial^2 #3}{\partial #4 \partial #5}",
        ]),
    ),
    ("dd", &[Optional, Needed], As(&[r"\, d #2", r"\, d^{#1} #2"])),
    // brackets
    ("qty", &[Bracketed], Brackets),
    ("pqty", &[Needed], As(&[r"\left(#1\right)"])),
    ("bqty", &[Needed], As(&[r"\left[#1\right]"])),
    ("abs", &[Star, Group], As(&[r"\left|#2\right|"])),
    ("norm", &[Star, Group], As(&[r"\left\|#2\right\|"])),
    ("eval", &[Star, Group], As(&[r"\left.#2\right|"])),
    ("order", &[Group], As(&[r"O\left(#1\right)"])),
    ("mqty", &[Star, Bracketed], Matrix),
    ("pmqty", &[Needed], As(&[r"\begin{pmatrix}#1\end{pmatrix}"])),
    ("bmqty", &[Needed], As(&[r"\begin{bmatrix}#1\end{bmatrix}"])),
    ("vmqty", &[Needed], As(&[r"\begin{vmatrix}#1\end{vmatrix}"])),
    ("mdet", &[Needed], As(&[r"\begin{vmatrix}#1\end{vmatrix}"])),
    // letters and signs
    ("va", &[Star, Needed], As(&[r"\vec{#2}"])),
    ("vb", &[Star, Needed], As(&[r"\mathbf{#2}"])),
    ("vu", &[Star, Needed], As(&[r"\hat{#2}"])),
    ("vdot", &[], As(&[r"\cdot "])),
    ("cross", &[], As(&[r"\times "])),
    ("num", &[Optional, Needed], Number),
    ("ang", &[Optional, Needed], Angle),
    ("SI", &[Optional, Needed, Optional, Needed], Quantity),
    ("si", &[Optional, Needed], Quantity),
    ("unit", &[Optional, Needed], Quantity),
    // fractions
    ("nicefrac", &[Needed, Needed], As(&[r"\frac{#1}{#2}"])),
    ("sfrac", &[Needed, Needed], As(&[r"\frac{#1}{#2}"])),
    ("xfrac", &[Needed, Needed], As(&[r"\frac{#1}{#2}"])),
    ("flatfrac", &[Needed, Needed], As(&[r"\frac{#1}{#2}"])),
    // strokes, colours and boxes
    ("cancel", &[Needed], As(&["{#1}"])),
    ("bcancel", &[Needed], As(&["{#1}"])),
    ("xcancel", &[Needed], As(&["{#1}"])),
    ("color", &[Optional, Needed], As(&[""])),
    ("textcolor", &[Optional, Needed, Needed], As(&["{#3}"])),
    ("mathcolor", &[Optional, Needed, Needed], As(&["{#3}"])),
    ("colorbox", &[Optional, Needed, Needed], As(&["{#3}"])),
    ("ensuremath", &[Needed], As(&["{#1}"])),
    ("smash", &[Optional, Needed], As(&["{#2}"])),
    ("smashoperator", &[Optional, Needed], As(&["#2"])),
    ("mathclap", &[Needed], As(&["{#1}"])),
    ("substack", &[Needed], As(&["#1"])),
    // what is set beside a formula
    ("xspace", &[], As(&[""])),
    ("mathchoice", &[Needed, Needed, Needed, Needed], As(&["{#1}"])),
    ("qed", &[], As(&[""])),
    ("qedhere", &[], As(&[""])),
    ("IEEEyesnumber", &[Star], As(&[""])),
    ("IEEEnonumber", &[Star], As(&[""])),
    ("IEEEyessubnumber", &[Star], As(&[""])),
    ("IEEEeqnarraynumspace", &[], As(&[""])),
    ("allowdisplaybreaks", &[Optional], As(&[""])),
    ("displaybreak", &[Optional], As(&[""])),
    ("underbrace", &[Needed], Named(b'_')),
    ("overbrace", &[Needed], Named(b'^')),
    // what stands above or below a relation
    ("stackrel", &[Needed, Needed], Relation),
    ("overset", &[Needed, Needed], Relation),
    ("underset", &[Needed, Needed], Relation),
];

/// A formula as it is read.
pub(super) struct Plain<'a> {
    pub text: Cow<'a, str>,
    /// The parts of the text: the start of each, its place in the source, and true if it was copied from there.
    pub parts: Vec<(usize, usize, bool)>,
}

impl<'a> Plain<'a> {
    /// Rewrites a formula.
    pub(super) fn of(source: &'a str, names: &Names) -> Self {
        if source.len() > LONGEST {
            // the reader refuses it
            return Self {
                text: Cow::Borrowed(source),
                parts: Vec::new(),
            };
        }
        let mut writer = Writer {
            source,
            closing: closing(source),
            text: String::new(),
            parts: Vec::new(),
            is_changed: false,
            left: Cell::new(LOOKED_AT * (source.len() + 1)),
            has_angles: source.contains(r"\rangle"),
            has_differentials: names.opaque.is_some() && has_differentials(source),
            names,
        };
        writer.group(0, source.len(), 0);
        // what ends with a command ends where that does
        writer.parts.push((writer.text.len(), source.len(), true));
        match writer.is_changed {
            true => Self {
                text: Cow::Owned(writer.text),
                parts: writer.parts,
            },
            false => Self {
                text: Cow::Borrowed(source),
                parts: Vec::new(),
            },
        }
    }

    /// The text without a remark in words and brackets at its end, `\text{(difference of squares)}`, and that remark.
    pub(super) fn without_remark(&self) -> (&str, Option<&str>) {
        let whole = self.text.trim_end();
        let found = [r"\text{", r"\mbox{", r"\textrm{", r"\textit{"]
            .iter()
            .find_map(|command| {
                let start = whole.rfind(command)?;
                let said = whole.get(start + command.len()..)?.strip_suffix('}')?.trim();
                let is_in_brackets = [('(', ')'), ('[', ']')]
                    .iter()
                    .any(|(open, close)| said.starts_with(*open) && said.ends_with(*close));
                (is_in_brackets && !said.contains(['{', '}', '$', '\\'])).then_some((start, said))
            });
        match found {
            Some((start, said)) => (whole.get(..start).unwrap_or_default(), Some(said)),
            None => (&self.text, None),
        }
    }

    /// Returns the place in the source of a byte of the text.
    pub(super) fn source(&self, at: usize) -> usize {
        let after = self.parts.partition_point(|(start, ..)| *start <= at);
        match after.checked_sub(1).and_then(|last| self.parts.get(last)) {
            Some((start, from, true)) => from + (at - start),
            Some((_, from, false)) => *from,
            None => at,
        }
    }

    /// Returns the place in the source at which ends what ends in front of a byte of the text: the end of the command that was
    /// written so.
    pub(super) fn source_end(&self, at: usize) -> usize {
        let last = at.saturating_sub(1);
        let after = self.parts.partition_point(|(start, ..)| *start <= last);
        match after.checked_sub(1).and_then(|last| self.parts.get(last)) {
            Some((_, from, false)) => {
                let mut behind = self.parts.iter().skip(after);
                behind
                    .find(|(_, next, _)| next > from)
                    .map_or(from + 1, |(_, next, _)| *next)
            }
            _ => self.source(last) + 1,
        }
    }
}

/// Finds the partner of each brace that opens.
fn closing(source: &str) -> Vec<Option<usize>> {
    let mut found = vec![None; source.len()];
    let (mut open, mut is_escaped) = (Vec::new(), false);
    for (at, byte) in source.bytes().enumerate() {
        match byte {
            b'{' if !is_escaped => open.push(at),
            b'}' if !is_escaped => {
                if let Some(place) = open.pop().and_then(|start: usize| found.get_mut(start)) {
                    *place = Some(at);
                }
            }
            _ => {}
        }
        is_escaped = byte == b'\\' && !is_escaped;
    }
    found
}

struct Writer<'a, 'n> {
    source: &'a str,
    closing: Vec<Option<usize>>,
    text: String,
    parts: Vec<(usize, usize, bool)>,
    is_changed: bool,
    /// Bytes that may still be looked at for brackets that close: each bracket of a hostile formula looks to its end.
    left: Cell<usize>,
    /// True if an angle closes, so that there may be kets.
    has_angles: bool,
    /// True if `\mathrm{d}T` is a name: neither an integral nor a derivative is printed.
    has_differentials: bool,
    /// With these, terms that are not understood may become symbols.
    names: &'n Names,
}

/// An argument that was found: what stands in it, and its opening bracket.
#[derive(Clone, Copy)]
struct Found {
    start: usize,
    end: usize,
    bracket: u8,
}

impl<'a> Writer<'a, '_> {
    fn slice(&self, start: usize, end: usize) -> &'a str {
        self.source.get(start..end).unwrap_or_default()
    }

    fn byte(&self, at: usize) -> u8 {
        self.source.as_bytes().get(at).copied().unwrap_or_default()
    }

    fn copy(&mut self, start: usize, end: usize) {
        if let Some(text) = self.source.get(start..end)
            && !text.is_empty()
        {
            let goes_on = self
                .parts
                .last()
                .is_some_and(|(from, at, is_copied)| *is_copied && at + (self.text.len() - from) == start);
            if !goes_on {
                self.parts.push((self.text.len(), start, true));
            }
            self.text.push_str(text);
        }
    }

    fn write(&mut self, text: &str, from: usize) {
        self.parts.push((self.text.len(), from, false));
        self.text.push_str(text);
        self.is_changed = true;
    }

    /// The end of the command, comment or character at a byte.
    fn token_end(&self, at: usize) -> usize {
        let rest = self.slice(at, self.source.len());
        let mut characters = rest.chars();
        match characters.next() {
            Some('\\') => {
                let letters = rest.bytes().skip(1).take_while(u8::is_ascii_alphabetic).count();
                let length = match letters {
                    0 => characters.next().map_or(0, char::len_utf8),
                    letters => letters,
                };
                at + 1 + length
            }
            Some('%') => at + rest.find('\n').map_or(rest.len(), |end| end + 1),
            Some(c) => at + c.len_utf8(),
            None => at,
        }
    }

    fn after_blanks(&self, at: usize, end: usize) -> usize {
        let text = self.slice(at, end);
        at + (text.len() - text.trim_start().len())
    }

    /// Behind blanks and small spaces.
    fn after_spaces(&self, mut at: usize, end: usize) -> usize {
        loop {
            at = self.after_blanks(at, end);
            let next = self.token_end(at).min(end);
            if ![r"\,", r"\;", r"\!", r"\:", "~"].contains(&self.slice(at, next)) {
                return at;
            }
            at = next;
        }
    }

    /// Returns the end of a term: the next sign of a sum, relation or row.
    fn term_end(&self, mut at: usize, end: usize) -> Option<usize> {
        while at < end {
            let next = self.token_end(at).min(end);
            at = match self.byte(at) {
                b'{' => self.closing.get(at).copied().flatten()? + 1,
                b'(' | b'[' => self.partner(at, end)? + 1,
                b'+' | b'-' | b'=' | b'<' | b'>' | b'&' | b',' | b'}' | b')' | b']' => break,
                b'\\' if ends_term(self.slice(at, next)) => break,
                _ => next,
            };
        }
        Some(at)
    }

    /// Writes what stands between two bytes, which is a group or the whole.
    fn group(&mut self, start: usize, end: usize, depth: usize) {
        if depth > DEEPEST {
            return self.copy(start, end);
        }
        if depth > 0
            && let Some((at, next, command)) = self.infix(start, end)
        {
            self.write(command, at);
            for (start, end) in [(start, at), (next, end)] {
                self.write("{", start);
                self.run(start, end, depth);
                self.write("}", end);
            }
            return;
        }
        self.run(start, end, depth);
    }

    /// Finds `\over` or `\choose` in a group: the start and the end of the sign, and the command for it.
    fn infix(&self, start: usize, end: usize) -> Option<(usize, usize, &'static str)> {
        let mut at = start;
        while at < end {
            let next = match self.byte(at) {
                b'{' => self.closing.get(at).copied().flatten()? + 1,
                _ => self.token_end(at),
            };
            let command = match self.slice(at, next) {
                r"\over" => r"\frac",
                r"\choose" => r"\binom",
                _ => "",
            };
            if !command.is_empty() {
                return Some((at, next, command));
            }
            at = next;
        }
        None
    }

    /// Returns true if `\over` stands in a group between braces, with a sign of a derivative in front, which is not raised or lowered.
    fn is_derivative(&self, open: usize, close: usize) -> bool {
        let inside = self.slice(open + 1, close).trim_start();
        let behind = inside.strip_prefix('d').or_else(|| inside.strip_prefix(r"\partial"));
        let is_sign = behind.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_alphabetic()));
        let is_script = self.slice(0, open).trim_end().ends_with(['_', '^']);
        is_sign
            && !is_script
            && self
                .infix(open + 1, close)
                .is_some_and(|(.., command)| command == r"\frac")
    }

    fn run(&mut self, start: usize, end: usize, depth: usize) {
        let mut at = start;
        while at < end {
            at = self.step(at, end, depth);
        }
    }

    /// Writes what stands at a byte, and returns where it ends.
    fn step(&mut self, at: usize, end: usize, depth: usize) -> usize {
        let next = self.token_end(at).min(end);
        if let Some((close, written)) = self.derivative(at, end).or_else(|| self.imaginary_root(at, end)) {
            self.write(&written, at);
            return close;
        }
        if self.names.opaque.is_some()
            && let Some(close) = self.opaque(at, end)
        {
            self.write(&opened(self.slice(at, close)), at);
            return close;
        }
        match self.byte(at) {
            b'\\' => {
                if let Some(next) = self.command(at, next, end, depth) {
                    return next;
                }
                // 1\,000
                if self.slice(at, next) == r"\," && self.is_between_figures(at, next, Some(3)) {
                    self.is_changed = true;
                    return next;
                }
                self.copy(at, next);
                next
            }
            b'{' => match self.closing.get(at).copied().flatten().filter(|close| *close < end) {
                // 0{,}5; but 1{,}000 may be a thousand
                Some(close)
                    if self.slice(at, close + 1) == "{,}"
                        && self.is_between_figures(at, close + 1, None)
                        && !self.is_between_figures(at, close + 1, Some(3)) =>
                {
                    self.write(".", at);
                    close + 1
                }
                // {\rm Re} is one word
                Some(close) if is_word_of_old_font(self.slice(at + 1, close)) => {
                    let word = self.slice(at + 1, close).trim_start_matches(r"\rm").trim();
                    let is_script = self.slice(0, at).trim_end().ends_with(['_', '^']);
                    let shown = format!(r"\mathrm{{{word}}}");
                    self.write(&if is_script { format!("{{{shown}}}") } else { shown }, at);
                    close + 1
                }
                // {d \over dx} stands before what it is of
                Some(close) if self.is_derivative(at, close) => {
                    self.group(at + 1, close, depth + 1);
                    close + 1
                }
                Some(close) => {
                    self.copy(at, at + 1);
                    self.group(at + 1, close, depth + 1);
                    self.copy(close, close + 1);
                    close + 1
                }
                None => {
                    self.copy(at, next);
                    next
                }
            },
            b'^' => self.primes(at, end).unwrap_or_else(|| {
                self.copy(at, next);
                next
            }),
            _ => {
                self.copy(at, next);
                next
            }
        }
    }

    /// Returns true if a figure stands before a byte and figures behind another, so many where a number is given.
    fn is_between_figures(&self, before: usize, behind: usize, count: Option<usize>) -> bool {
        let figures = self.slice(behind, self.source.len());
        let figures = figures.bytes().take_while(u8::is_ascii_digit).count();
        let is_behind_figure = before > 0 && self.byte(before - 1).is_ascii_digit();
        is_behind_figure && figures > 0 && count.is_none_or(|count| figures == count)
    }

    /// `^{\prime 2}` as `'^{2}`.
    fn primes(&mut self, at: usize, end: usize) -> Option<usize> {
        let open = self.after_blanks(at + 1, end);
        let close = self.closing.get(open).copied().flatten().filter(|close| *close < end)?;
        let mut rest = open + 1;
        let mut count = 0;
        loop {
            let next = self.after_blanks(rest, close);
            if self.slice(next, self.token_end(next)) != r"\prime" {
                break;
            }
            rest = self.token_end(next);
            count += 1;
        }
        let power = self.slice(rest, close).trim();
        if count == 0 || count > 3 || !power.bytes().all(|byte| byte.is_ascii_alphanumeric()) {
            return None;
        }
        self.write(&"'".repeat(count), at);
        if !power.is_empty() {
            self.write("^{", at);
            self.copy(rest, close);
            self.write("}", close);
        }
        Some(close + 1)
    }

    /// Returns the end of `\frac{\partial y}{\partial x}` that starts at a byte, and what it is read as where nothing says that `y` is
    /// a function: the derivative of its value if it has one, else a symbol.
    fn derivative(&self, at: usize, end: usize) -> Option<(usize, String)> {
        let opaque = self.names.opaque.as_ref()?;
        if self.byte(at) != b'\\' {
            return None;
        }
        let next = self.token_end(at);
        let group = |at: usize| {
            let open = self.after_blanks(at, end);
            let close = self.closing.get(open).copied().flatten().filter(|close| *close < end)?;
            Some((open + 1, close))
        };
        // `\pdv{u}{x}` of physics
        if self.slice(at, next) == r"\pdv" && self.byte(self.after_blanks(next, end)) == b'{' {
            let (above, below) = (group(next)?, group(group(next)?.1 + 1)?);
            let [of, by] = [above, below].map(|(start, close)| self.slice(start, close).trim());
            let is_name = |(start, close): (usize, usize)| {
                let start = self.after_spaces(start, close);
                let name_end = self
                    .name_end(start, close)
                    .map(|name| self.scripts_end(name, close, false));
                name_end.is_some_and(|name_end| self.slice(name_end, close).trim().is_empty())
            };
            let is_function = |known: &Name| bare(&known.to_string()) == bare(of);
            let mut known = self.names.functions.iter().chain(&self.names.defined);
            let is_open = is_name(above) && is_name(below) && !known.any(is_function);
            let has_value = opaque.values.iter().any(|value| bare(value) == bare(of));
            let written = opened(&format!(r"\frac{{\partial {of}}}{{\partial {by}}}"));
            return (is_open && !has_value).then_some((below.1 + 1, written));
        }
        if ![r"\frac", r"\dfrac", r"\tfrac"].contains(&self.slice(at, next)) {
            return None;
        }
        let (above, below) = (group(next)?, group(group(next)?.1 + 1)?);
        // the sign, where its power ends, and that
        let sign = |(start, close): (usize, usize)| {
            let start = self.after_blanks(start, close);
            let signs = [r"\partial", r"\mathrm{d}", r"\mathrm d", r"\dd", r"{\rm d}", "d"];
            let found = signs.iter().find(|sign| self.slice(start, close).starts_with(**sign))?;
            let behind = start + found.len();
            let is_word = found.ends_with(|c: char| c.is_ascii_alphabetic()) && found.starts_with('\\');
            if is_word && self.byte(behind).is_ascii_alphabetic() {
                return None;
            }
            let is_partial = *found == r"\partial";
            let power = self.after_blanks(behind, close);
            match self.byte(power) {
                b'^' => Some((
                    is_partial,
                    self.script_end(power, close),
                    self.slice(power, self.script_end(power, close)),
                )),
                _ => Some((is_partial, behind, "")),
            }
        };
        let (is_partial, of, order) = sign(above)?;
        let (is_same, by, _) = sign(below)?;
        let (mut of, mut of_end) = (self.after_spaces(of, above.1), above.1);
        // braces around the whole name
        while let Some(close) = self.closing.get(of).copied().flatten().filter(|close| *close < of_end)
            && self.byte(of) == b'{'
            && self.slice(close + 1, of_end).trim().is_empty()
        {
            (of, of_end) = (self.after_spaces(of + 1, close), close);
        }
        let by = self.after_spaces(by, below.1);
        let name = self.slice(of, self.scripts_end(self.name_end(of, of_end)?, of_end, false));
        let end_of_letter = self.scripts_end(self.name_end(by, below.1)?, below.1, false);
        let letter = self.slice(by, end_of_letter);
        let power = self.slice(end_of_letter, below.1).trim();
        let is_whole = of + name.len() == of_end - trailing_blanks(self.slice(of, of_end));
        let is_function = |known: &Name| bare(&known.to_string()) == bare(name);
        let is_known = self.names.functions.iter().chain(&self.names.defined).any(is_function);
        if is_partial == is_same && is_whole && power.is_empty() && order.is_empty() && bare(name) == bare(letter) {
            return Some((above.1.max(below.1) + 1, "{1}".to_owned()));
        }
        if is_partial != is_same || !is_whole || power.trim() != order.trim() || is_known || letter.is_empty() {
            return None;
        }
        let d = if is_partial { r"\partial " } else { "d" };
        let written = match opaque.values.iter().any(|value| bare(value) == bare(name)) {
            true => format!(r"\frac{{d{order} {name}}}{{d{letter}{order}}}"),
            false => opened(&format!(r"\frac{{{d}{order}{name}}}{{{d}{letter}{order}}}")),
        };
        Some((above.1.max(below.1) + 1, written))
    }

    /// Returns the end of a term that starts at a byte and is not understood: an operator with its operand, brackets of a
    /// product, a letter before brackets that may hold its arguments.
    fn opaque(&self, at: usize, end: usize) -> Option<usize> {
        if let Some(behind) = self.word(at, end) {
            return Some(behind);
        }
        let is_start = matches!(self.byte(at), b'\\' | b'|') || self.byte(at).is_ascii_alphabetic();
        if !is_start {
            return None;
        }
        let next = self.token_end(at);
        match self.slice(at, next) {
            r"\langle" => return self.of_dirac(at, next, end),
            "|" => return self.has_angles.then(|| self.of_dirac(at, next, end)).flatten(),
            _ => {}
        }
        let script = self.after_blanks(next, end);
        let takes_term = match self.slice(at, next) {
            r"\max" | r"\min" | r"\sup" | r"\inf" | r"\argmax" | r"\argmin" => self.byte(script) == b'_',
            r"\sum" | r"\prod" if self.byte(script) == b'_' => {
                let below = self.script_end(script, end);
                let (from, above) = (self.slice(script, below), self.after_blanks(below, end));
                let is_endless =
                    self.byte(above) == b'^' && self.slice(above, self.script_end(above, end)).contains(r"\infty");
                is_endless || !from.contains('=') || from.contains(r"\in") || from.contains(r"\neq")
            }
            r"\oint" | r"\iint" | r"\iiint" => true,
            _ => false,
        };
        if takes_term {
            return self
                .term_end(next, end)
                .filter(|close| !self.slice(next, *close).trim().is_empty());
        }
        if [r"\Delta", r"\delta"].contains(&self.slice(at, next)) {
            // the difference or variation of a letter is one name
            let letter = self.after_spaces(next, end);
            if let Some(behind) = self.name_end(letter, end) {
                return Some(behind);
            }
        }
        if let Some(behind) = self.differential(at, end) {
            return Some(behind);
        }
        let name_end = self.name_end(at, end)?;
        let name = self.slice(at, name_end);
        let starts_with = |commands: &[&str]| commands.iter().any(|command| name.starts_with(command));
        if starts_with(&[
            r"\mathbb{Z}",
            r"\mathbb{N}",
            r"\mathbb{Q}",
            r"\mathbb{R}",
            r"\mathbb{C}",
        ]) {
            return None;
        }
        let is_operator = starts_with(&[r"\mathbb", r"\Pr", r"\nabla"]);
        let behind = self.scripts_end(name_end, end, is_operator);
        let mut open = self.after_spaces(behind, end);
        if is_operator && [r"\cdot", r"\times"].contains(&self.slice(open, self.token_end(open))) {
            open = self.after_blanks(self.token_end(open), end);
        }
        let sized = self.slice(open, self.token_end(open).min(end));
        if [r"\left", r"\bigl", r"\Bigl", r"\biggl", r"\big", r"\Big", r"\bigg"].contains(&sized) {
            open = self.after_blanks(self.token_end(open), end);
        }
        let is_brace = self.slice(open, self.token_end(open).min(end)) == r"\{";
        if open < end && (is_brace || matches!(self.byte(open), b'(' | b'[')) {
            let (start, close) = match is_brace {
                true => {
                    let length = self.slice(open, end).find(r"\}")?;
                    (open + 2, open + length + 1)
                }
                false => (open + 1, self.partner(open, end)?),
            };
            let inside = self
                .slice(start, close)
                .trim_end_matches([' ', '\\'])
                .trim_end_matches(r"\right");
            let is_given = self.is_given(self.slice(at, self.scripts_end(name_end, self.source.len(), false)));
            let has_several = has_at_top(inside, &[";", "|", r"\mid", r"\vert"])
                || (has_at_top(inside, &[","]) && (!is_given || inside.contains("dots") || inside.contains("...")));
            let is_relation = has_at_top(inside, &["=", "<", ">"]);
            // what has a power needs its brackets, (a/b)^2, but for a letter alone
            let power = self.byte(self.after_blanks(close + 1, end)) == b'^';
            let is_letter = self
                .name_end(self.after_blanks(start, close), close)
                .is_some_and(|behind| self.scripts_end(behind, close, false) >= start + inside.trim_end().len());
            let is_needed = power && !is_letter;
            let is_called =
                has_several || (self.may_be_function(at, name_end, inside, is_needed) && self.byte(open) == b'(');
            // `\sum_{k=1}^n (...)` takes nothing at its bracket
            let is_above = self.slice(0, at).trim_end().ends_with('^');
            let is_term = is_operator || (is_called && !is_above);
            return (is_term && !is_relation && !inside.trim().is_empty()).then_some(close + 1);
        }
        // a letter in bold is another than the plain one
        if is_bold(name) {
            let of = BOLD
                .iter()
                .find_map(|command| name.strip_prefix(command))
                .unwrap_or_default();
            let of = of.trim_matches(['{', '}', ' ']);
            let is_one = of.len() == 1 && of.bytes().all(|byte| byte.is_ascii_alphabetic()) || is_letter_command(of);
            return is_one.then_some(name_end);
        }
        if VARIANTS.contains(&name) {
            return Some(name_end);
        }
        if !is_operator {
            return None;
        }
        let takes_factor = [
            r"\mathbb{E}",
            r"\mathbb E",
            r"\mathbb{P}",
            r"\mathbb P",
            r"\nabla",
            r"\Pr",
        ];
        if !takes_factor.contains(&name) {
            return Some(name_end);
        }
        // an operator with the factor behind it
        match self.name_end(open, end) {
            Some(operand) => Some(self.scripts_end(operand, end, true)),
            None => self.term_end(open, end).filter(|close| *close > open),
        }
    }

    /// Returns the end of a ket `|\psi\rangle`, a bra `\langle\psi|`, or what stands between angles, whose sign `at` ends at `next`.
    fn of_dirac(&self, at: usize, next: usize, end: usize) -> Option<usize> {
        let text = self.slice(next, end);
        let end = text
            .char_indices()
            .nth(LONGEST_BRA)
            .map_or(end, |(length, _)| next + length);
        let close = self.slice(next, end).find(r"\rangle").map(|length| next + length);
        let is_plain = |inside: &str| !inside.contains(['=', '<', '>', '&']) && !inside.contains(r"\langle");
        let between = close
            .map(|close| self.slice(next, close))
            .filter(|inside| is_plain(inside));
        if self.byte(at) == b'|' {
            let is_ket = between.is_some_and(|inside| !inside.contains('|') && !inside.trim().is_empty());
            return close.filter(|_| is_ket).map(|close| close + r"\rangle".len());
        }
        // a bra ends at its bar, where a sum or nothing goes on behind it
        let bar = self.slice(next, end).find('|').map(|length| next + length);
        let ends = |bar: usize| {
            let behind = self.slice(bar + 1, end).trim_start();
            behind.is_empty() || behind.starts_with(['+', '-', '=', ')', ']', '}', ',', '.', ';', '&', '\n'])
        };
        match (bar.filter(|bar| ends(*bar) && is_plain(self.slice(next, *bar))), close) {
            (Some(bar), _) => Some(bar + 1),
            (None, Some(close)) => between.map(|_| close + r"\rangle".len()),
            (None, None) => None,
        }
    }

    /// Returns the end of a differential `\mathrm{d}T` that starts at a byte, which is one name, as in `\mathrm{d}s = c \mathrm{d}T/T`:
    /// in a formula without integrals and derivatives.
    fn differential(&self, at: usize, end: usize) -> Option<usize> {
        let mut signs = DIFFERENTIALS.into_iter().filter(|_| self.has_differentials);
        let sign = signs.find(|sign| self.slice(at, end).starts_with(sign))?;
        self.name_end(self.after_spaces(at + sign.len(), end), end)
    }

    /// Returns the end of a name of several upright letters that starts at a byte, `\mathrm{Nu}` or `{\rm Nu}`, where it acts on
    /// nothing: at the end of a term, or before a sign of multiplication.
    fn word(&self, at: usize, end: usize) -> Option<usize> {
        let own = self.slice(at, end);
        let sign = [r"\mathrm{", r"{\rm "].into_iter().find(|sign| own.starts_with(sign))?;
        let word = own.get(sign.len()..)?;
        let word = word.get(..word.find('}')?)?;
        let is_name = word.len() > 1
            && word.bytes().all(|byte| byte.is_ascii_alphabetic())
            && !NO_NAMES.contains(&word)
            && Elementary::by_word(word).is_none()
            && invariant(word).is_none()
            && !self.names.functions.iter().any(|known| known.base == word);
        let behind = at + sign.len() + word.len() + 1;
        let next = self.after_spaces(behind, end);
        let sign = self.slice(next, self.token_end(next).min(end));
        let ends = next == end
            || sign.starts_with(['+', '-', '=', ')', ']', '}', ',', '.', ';', '&', '/', '_', '<', '>'])
            || [r"\\", r"\right", r"\cdot", r"\times", r"\quad", r"\qquad"].contains(&sign)
            || related(sign).is_some();
        // x^{\mathrm{ref}} is a name itself
        let before = self.slice(0, at).trim_end();
        let before = before.strip_suffix('{').unwrap_or(before).trim_end();
        (is_name && ends && !before.ends_with(['^', '_'])).then_some(behind)
    }

    /// Returns the end of the root of a negative number that starts at a byte, and the root as a multiple of the imaginary unit.
    fn imaginary_root(&self, at: usize, end: usize) -> Option<(usize, String)> {
        self.names.opaque.as_ref()?;
        let inside = self.slice(at, end).strip_prefix(r"\sqrt{-")?;
        let number = inside.get(..inside.find('}')?)?;
        let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        let close = at + r"\sqrt{-".len() + number.len() + 1;
        is_number.then(|| (close, format!(r"{{\mathrm{{i}}\sqrt{{{number}}}}}")))
    }

    /// Returns true for the name of a function that a definition gives, perhaps with primes.
    fn is_given(&self, name: &str) -> bool {
        let whole = bare(name);
        let is_one = |known: &String| bare(known) == whole.trim_end_matches('\'');
        let opaque = self.names.opaque.as_ref();
        opaque.is_some_and(|opaque| opaque.functions.iter().any(is_one))
    }

    /// Returns true if a letter before a bracket may be a function: one that mostly is, or before a single term, which a factor
    /// would need no bracket for unless `is_needed`.
    fn may_be_function(&self, at: usize, name_end: usize, inside: &str, is_needed: bool) -> bool {
        let name = self.slice(at, name_end);
        let letter = name
            .strip_suffix('}')
            .and_then(|name| name.rsplit('{').next())
            .unwrap_or(name);
        let declared = self.names.functions.iter().any(|known| known.base == letter);
        let opaque = self.names.opaque.as_ref();
        if self.is_given(self.slice(at, self.scripts_end(name_end, self.source.len(), false))) {
            return false;
        }
        let is_word = letter.len() > 1 && letter.bytes().all(|byte| byte.is_ascii_alphabetic());
        if is_word {
            // \operatorname{Var}(x), Var(x)
            return !declared && Elementary::by_word(letter).is_none() && invariant(letter).is_none();
        }
        if declared
            || opaque.is_some_and(|opaque| opaque.factors.contains(letter))
            || ["e", "i", "d", "O", "o", r"\pi"].contains(&letter)
        {
            return false;
        }
        let single = inside.trim().trim_start_matches('-');
        let is_single = !has_at_top(single, &["+", "-", r"\pm", r"\mp"]);
        // a matrix before a product of others
        let count = |text: &str| BOLD.iter().map(|bold| text.matches(bold).count()).sum::<usize>();
        if is_bold(name) && count(inside) > 1 && !inside.contains(',') {
            return false;
        }
        (is_single && !is_needed) || FUNCTION_LETTERS.contains(&letter) || name.starts_with(r"\mathcal")
    }

    /// Returns the end of a name that starts at a byte: a letter, or a command for one with what it stands over.
    fn name_end(&self, at: usize, end: usize) -> Option<usize> {
        let next = self.token_end(at);
        if at >= end || next > end {
            return None;
        }
        let token = self.slice(at, next);
        let of_group = [
            r"\mathbb",
            r"\mathcal",
            r"\mathscr",
            r"\mathbf",
            r"\bm",
            r"\boldsymbol",
            r"\hat",
            r"\widehat",
            r"\tilde",
            r"\widetilde",
            r"\bar",
            r"\overline",
            r"\vec",
            r"\operatorname",
            r"\mathrm",
        ];
        if of_group.contains(&token) {
            let open = self.after_blanks(next, end);
            return match self.byte(open) {
                b'{' => self
                    .closing
                    .get(open)
                    .copied()
                    .flatten()
                    .filter(|close| *close < end)
                    .map(|close| close + 1),
                byte if byte.is_ascii_alphanumeric() && token.starts_with(r"\math") => Some(open + 1),
                _ => None,
            };
        }
        // Prob(A)
        let word = self.slice(at, end);
        let length = word.bytes().take_while(u8::is_ascii_alphabetic).count();
        if length > 1 && word.starts_with(|c: char| c.is_ascii_uppercase()) {
            let word = word.get(..length).unwrap_or_default();
            let behind = self.after_blanks(at + length, end);
            let is_called = matches!(self.byte(behind), b'(' | b'[') || self.slice(behind, end).starts_with(r"\left");
            let is_word = word.bytes().skip(1).all(|byte| byte.is_ascii_lowercase());
            if is_called && is_word && invariant(word).is_none() && Elementary::by_word(word).is_none() {
                return Some(at + length);
            }
        }
        let is_letter = match token.strip_prefix('\\') {
            Some("Pr" | "nabla") => true,
            Some(_) => is_letter_command(token) || VARIANTS.contains(&token),
            None => token.bytes().all(|byte| byte.is_ascii_alphabetic()),
        };
        is_letter.then_some(next)
    }

    /// Returns the end of the subscripts and primes behind a name, and of its powers where they are asked for.
    fn scripts_end(&self, name_end: usize, end: usize, has_powers: bool) -> usize {
        let mut at = name_end;
        loop {
            let start = self.after_blanks(at, end);
            at = match self.byte(start) {
                _ if start >= end => return at,
                b'\'' => start + 1,
                b'_' => self.script_end(start, end),
                b'^' if has_powers => self.script_end(start, end),
                _ => return at,
            };
        }
    }

    fn script_end(&self, sign: usize, end: usize) -> usize {
        let start = self.after_blanks(sign + 1, end);
        match self.closing.get(start).copied().flatten() {
            Some(close) => (close + 1).min(end),
            None => self.token_end(start).min(end),
        }
    }

    /// Returns true if a slash, or the sign of a script, stands in front of what begins at a place, or a power behind its end.
    fn is_parted(&self, at: usize, next: usize, end: usize) -> bool {
        self.slice(0, at).trim_end().ends_with(['/', '^', '_']) || self.byte(self.after_blanks(next, end)) == b'^'
    }

    /// Writes the command between two bytes as what it stands for, and returns where its arguments end.
    fn command(&mut self, at: usize, name_end: usize, end: usize, depth: usize) -> Option<usize> {
        let name = self.slice(at + 1, name_end);
        let (_, wanted, written) = TABLE.iter().find(|(command, ..)| *command == name)?;
        let (found, next) = self.arguments(wanted, name_end, end)?;
        let text = |argument: Option<&Found>| argument.map_or("", |found| self.slice(found.start, found.end));
        let last = found.last().copied().flatten();
        match written {
            As(forms) => {
                let form = forms.iter().rev().find(|form| {
                    let used = form.split('#').skip(1).filter_map(|rest| rest.bytes().next());
                    let mut used = used.map(|digit| usize::from(digit.wrapping_sub(b'1')));
                    used.all(|number| found.get(number).is_some_and(Option::is_some))
                })?;
                self.form(form, &found, at, depth);
            }
            Brackets => {
                let [open, close] = brackets(last?.bracket);
                self.write(&format!(r"\left{open}"), at);
                self.inside(last?, depth);
                self.write(&format!(r"\right{close}"), at);
            }
            Matrix => {
                let kind = match last?.bracket {
                    b'(' => "pmatrix",
                    b'[' => "bmatrix",
                    b'|' => "vmatrix",
                    _ => "matrix",
                };
                self.write(&format!(r"\begin{{{kind}}}"), at);
                self.inside(last?, depth);
                self.write(&format!(r"\end{{{kind}}}"), at);
            }
            Relation => {
                let relation = text(last.as_ref()).trim();
                let above = text(found.first().and_then(Option::as_ref));
                if related(relation).is_none() || !says_nothing(above) {
                    return None;
                }
                self.write(relation, at);
                self.write(" ", at);
            }
            Number => {
                let shown = decimal(text(last.as_ref()))?;
                // what a slash or a power takes of a product is not seen
                if shown.contains(' ') && self.is_parted(at, next, end) {
                    return None;
                }
                self.write(&shown, at);
            }
            Angle => {
                let number = text(last.as_ref()).trim();
                number.parse::<f64>().ok().filter(|number| number.is_finite())?;
                self.write(&format!(r"{number}^\circ "), at);
            }
            Quantity => {
                let unit = unit(text(last.as_ref()))?;
                let number = match wanted.len() {
                    4 => format!(r"{} \cdot ", decimal(text(found.get(1).and_then(Option::as_ref)))?),
                    _ => String::new(),
                };
                let is_beside = self
                    .slice(0, at)
                    .trim_end()
                    .ends_with(|c: char| c.is_alphanumeric() || c == '}');
                // a bracket behind a letter may hold its argument
                let behind = self.slice(self.after_blanks(next, end), end);
                let has_bracket = ["(", "[", r"\left", r"\big", r"\Big"]
                    .iter()
                    .any(|open| behind.starts_with(open));
                match is_beside || has_bracket || number.starts_with(['-', '+']) || self.is_parted(at, next, end) {
                    true => self.write(&format!(r"\frac{{{number}{unit}}}{{1}}"), at),
                    false => self.write(&format!("{number}{unit}"), at),
                }
            }
            Named(sign) => {
                let script = self.after_blanks(next, end);
                let (label, after) = match self.byte(script) == *sign && script < end {
                    true => self.arguments(&[Needed], script + 1, end)?,
                    false => return None,
                };
                let label = label.first().copied().flatten()?;
                let label = self.slice(label.start, label.end);
                let own = names(label);
                // within a document a label names what it stands at, or says what that is, or states an equation, which is kept apart
                let is_name = own.as_ref().is_some_and(|own| own.len() == 1);
                let is_equation = label.trim().starts_with('=') && label.matches('=').count() == 1;
                if self.names.opaque.is_some() && (is_equation || !is_name && is_description(label)) {
                    self.is_changed = true;
                    self.write("{", at);
                    self.inside(last?, depth);
                    self.write("}", after);
                    return Some(after);
                }
                let own = own?;
                let outside = [self.slice(0, script), self.slice(after, self.source.len())];
                let is_elsewhere = |name: &&str| {
                    outside
                        .iter()
                        .any(|text| names_anywhere(text).any(|other| other == *name))
                };
                // where no sign makes a factor of what is marked, it is printed as it is
                let before = self.slice(0, at).trim_end();
                let behind = self.slice(after, self.source.len()).trim_start();
                let is_term = (before.is_empty() || before.ends_with(['+', '=', '(', '&', '{', '[']))
                    && (behind.is_empty() || behind.starts_with(['+', '-', '=', ')', '&', ',', '.', '}', ']']));
                if !is_term || own.iter().any(is_elsewhere) {
                    return None;
                }
                self.is_changed = true;
                self.inside(last?, depth);
                return Some(after);
            }
        }
        Some(next)
    }

    fn inside(&mut self, argument: Found, depth: usize) {
        self.group(argument.start, argument.end, depth + 1);
    }

    fn form(&mut self, form: &str, found: &[Option<Found>], at: usize, depth: usize) {
        self.is_changed = true;
        let mut parts = form.split('#');
        self.write(parts.next().unwrap_or_default(), at);
        for part in parts {
            let (number, rest) = part.split_at(1.min(part.len()));
            let number: usize = number.parse().unwrap_or_default();
            if let Some(argument) = number
                .checked_sub(1)
                .and_then(|number| found.get(number).copied().flatten())
            {
                self.inside(argument, depth);
            }
            self.write(rest, at);
        }
    }

    /// The arguments of a command that ends at a byte, and where they end.
    fn arguments(&self, wanted: &[Argument], name_end: usize, end: usize) -> Option<(Vec<Option<Found>>, usize)> {
        let mut at = name_end;
        let mut found = Vec::new();
        for argument in wanted {
            let start = self.after_blanks(at, end);
            let first = if start < end { self.byte(start) } else { 0 };
            let between = |close: usize| Found {
                start: start + 1,
                end: close,
                bracket: first,
            };
            let group = || {
                let close = self.closing.get(start).copied().flatten()?;
                (first == b'{' && close < end).then(|| between(close))
            };
            let next = match argument {
                Star => {
                    at = if first == b'*' { start + 1 } else { at };
                    found.push(None);
                    continue;
                }
                Optional => (first == b'[').then(|| self.partner(start, end)).flatten().map(between),
                Group => group(),
                Needed if start >= end || (first == b'{' && group().is_none()) => return None,
                Needed => Some(group().unwrap_or(Found {
                    start,
                    end: self.token_end(start).min(end),
                    bracket: 0,
                })),
                Bracketed => Some(match first {
                    b'{' => group()?,
                    b'(' | b'[' | b'|' => between(self.partner(start, end)?),
                    _ => return None,
                }),
            };
            if let Some(own) = next {
                at = if own.bracket == 0 { own.end } else { own.end + 1 };
            }
            found.push(next);
        }
        Some((found, at))
    }

    /// Returns the place at which a bracket closes that opens at a byte.
    fn partner(&self, open: usize, end: usize) -> Option<usize> {
        let first = self.byte(open);
        let [_, close] = brackets(first).map(|text| text.bytes().next_back().unwrap_or_default());
        let (mut at, mut depth) = (open + 1, 1);
        while at < end {
            self.left.set(self.left.get().checked_sub(1)?);
            at = match self.byte(at) {
                b'{' => self.closing.get(at).copied().flatten()? + 1,
                byte if byte == close => {
                    depth -= 1;
                    if depth == 0 {
                        return Some(at);
                    }
                    at + 1
                }
                byte if byte == first => {
                    depth += 1;
                    at + 1
                }
                _ => self.token_end(at),
            };
        }
        None
    }
}

/// The most characters between angles: each that opens is looked for to its end.
const LONGEST_BRA: usize = 500;

/// An upright d.
const DIFFERENTIALS: [&str; 2] = [r"\mathrm{d}", r"\mathrm d"];

/// Returns true if a formula prints an upright d, and no integral or derivative.
fn has_differentials(source: &str) -> bool {
    let others = [
        r"\int",
        r"\partial",
        r"}{\mathrm{d}",
        r"}{\mathrm d",
        r"/\mathrm{d}",
        r"/\mathrm d",
    ];
    let prints = |sign: &&str| source.contains(sign);
    DIFFERENTIALS.iter().any(prints) && !others.iter().any(prints)
}

/// Returns true for `\rm` with a word of several letters.
fn is_word_of_old_font(group: &str) -> bool {
    let word = group.strip_prefix(r"\rm ").map(str::trim);
    word.is_some_and(|word| word.len() > 1 && word.bytes().all(|byte| byte.is_ascii_alphabetic()))
}

/// Returns true if a label at a brace states nothing of its own: it holds a letter, and no relation or arrow.
fn is_description(label: &str) -> bool {
    let has_letter = label.contains(|c: char| c.is_alphabetic());
    let states = |sign: &&str| label.contains(*sign);
    let arrows = [
        r"\to", r"arrow", r"\approx", r"\equiv", r"\le", r"\ge", r"\ne", r"\propto", r"\sim",
    ];
    has_letter && !label.contains(['=', '<', '>']) && !arrows.iter().any(states)
}

/// Returns true if what stands above a relation refers to something, or says that it is asked for or a definition: a letter
/// there, as in `\stackrel{d}{=}`, makes another relation of it.
pub fn says_nothing(above: &str) -> bool {
    let words = above.trim().trim_start_matches(r"\text").replace(r"\mathrm", "");
    let words = words.trim_matches(['{', '}', ' ', '.']);
    let is_number = !words.is_empty() && words.chars().all(|c| c.is_ascii_digit() || "()[].,!*".contains(c));
    let is_reference = [r"\eqref{", r"\ref{", r"(\ref{"]
        .iter()
        .any(|start| words.starts_with(start));
    // (a), (iii)
    let bracketed = words.strip_prefix('(').and_then(|words| words.strip_suffix(')'));
    let bracketed = bracketed.map(|words| words.trim_matches(['{', '}']));
    let is_mark =
        bracketed.is_some_and(|mark| (1..=3).contains(&mark.len()) && mark.chars().all(|c| c.is_ascii_alphabetic()));
    is_number || is_mark || words == "def" || is_reference
}

/// Letters that stand for functions more often than for factors.
pub const FUNCTION_LETTERS: [&str; 10] = ["f", "g", "h", "F", "G", "H", r"\delta", r"\Gamma", r"\zeta", r"\Theta"];

/// Commands that end a term, beside relations.
const ENDS: [&str; 11] = [
    r"\\", r"\pm", r"\mp", r"\sim", r"\to", r"\in", r"\quad", r"\qquad", r"\text", r"\right", r"\end",
];

fn ends_term(command: &str) -> bool {
    ENDS.contains(&command) || related(command).is_some()
}

/// Upright words that are no names: parts of sentences, and functions that may stand before what they act on.
const NO_NAMES: [&str; 18] = [
    "const",
    "mod",
    "lim",
    "for",
    "if",
    "and",
    "or",
    "on",
    "in",
    "as",
    "with",
    "where",
    "otherwise",
    "else",
    "Re",
    "Im",
    "sgn",
    "id",
];

/// Second shapes of letters, which are letters of their own where an author prints both.
const VARIANTS: [&str; 2] = [r"\varepsilon", r"\varphi"];

/// Returns true for the base of a letter in bold.
pub fn is_bold(base: &str) -> bool {
    BOLD.iter().any(|command| base.starts_with(command))
}

/// Returns true for the symbol that a term which is not understood was read as; a letter in bold is understood.
pub fn is_opaque(name: &Name) -> bool {
    let is_term = name.base.contains(['(', '[', '{', '_', '^', '|', ' ']) || holds_unknown(&name.base);
    is_term && !is_bold(&name.base)
}

/// The characters around a symbol that is a whole term.
pub(super) const OPAQUE: [char; 2] = ['\u{e000}', '\u{e001}'];

/// A text without braces and blanks.
fn bare(text: &str) -> String {
    text.replace(['{', '}', ' '], "")
}

fn trailing_blanks(text: &str) -> usize {
    text.len() - text.trim_end().len()
}

/// The letter of which a symbol that is not understood is a derivative.
pub fn derivative_of(base: &str) -> Option<&str> {
    let above = base.strip_prefix(r"\frac{")?.split('}').next()?;
    let of = above.strip_prefix(r"\partial").or_else(|| above.strip_prefix('d'))?;
    let of = of.trim_start();
    Some(match of.strip_prefix('^') {
        Some(order) => order.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start(),
        None => of,
    })
}

/// A term as one symbol, however its brackets and blanks are printed.
pub(super) fn opened(term: &str) -> String {
    let sizes = [
        r"\left", r"\right", r"\bigl", r"\bigr", r"\Bigl", r"\Bigr", r"\biggl", r"\biggr", r"\,", r"\;", r"\!", r"\:",
    ];
    let plain = sizes
        .iter()
        .fold(term.to_owned(), |plain, size| plain.replace(size, " "));
    let words: Vec<&str> = plain.split_whitespace().collect();
    let mut text = String::new();
    for word in words {
        // a command ends before a letter
        let ends_in_command = text
            .rfind('\\')
            .is_some_and(|at| text[at + 1..].bytes().all(|byte| byte.is_ascii_alphabetic()));
        if ends_in_command && word.starts_with(|c: char| c.is_ascii_alphabetic()) {
            text.push(' ');
        }
        text.push_str(word);
    }
    // \mathbf x is \mathbf{x}
    let of = BOLD
        .iter()
        .find_map(|command| Some((command, text.strip_prefix(command)?)));
    if let Some((command, of)) = of.filter(|(_, of)| !of.starts_with('{')) {
        text = format!("{command}{{{}}}", of.trim());
    }
    format!("{}{text}{}", OPAQUE[0], OPAQUE[1])
}

/// Returns true if one of these signs stands in a text outside of brackets and braces.
fn has_at_top(text: &str, signs: &[&str]) -> bool {
    let mut depth = 0_i32;
    text.char_indices().any(|(at, c)| {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        depth == 0
            && signs
                .iter()
                .any(|sign| text.get(at..).is_some_and(|rest| rest.starts_with(sign)))
    })
}

/// The letters and commands of a text, in which letters of commands are none.
fn names_anywhere(text: &str) -> impl Iterator<Item = &str> {
    let bytes = text.as_bytes();
    let mut at = 0;
    std::iter::from_fn(move || {
        while let Some(byte) = bytes.get(at) {
            let start = at;
            at += 1;
            if *byte == b'\\' {
                at += bytes
                    .iter()
                    .skip(at)
                    .take_while(|byte| byte.is_ascii_alphabetic())
                    .count();
            }
            if at > start + 1 || byte.is_ascii_alphabetic() {
                return text.get(start..at);
            }
        }
        None
    })
}

/// The names of a text that holds nothing but names, signs of scripts and figures.
fn names(text: &str) -> Option<Vec<&str>> {
    let is_name = |c: char| c.is_ascii_alphanumeric() || "\\_{}' ".contains(c);
    let found: Vec<&str> = names_anywhere(text).collect();
    let is_words = found.iter().any(|name| [r"\text", r"\mathrm", r"\mbox"].contains(name));
    (text.chars().all(is_name) && !found.is_empty() && !is_words).then_some(found)
}

fn brackets(open: u8) -> [&'static str; 2] {
    match open {
        b'[' => ["[", "]"],
        b'|' => ["|", "|"],
        b'{' => [r"\{", r"\}"],
        _ => ["(", ")"],
    }
}

#[cfg(test)]
mod tests {
    use super::super::Opaque;
    use super::*;

    fn plain(source: &str) -> String {
        let rewritten = Plain::of(source, &Names::default());
        rewritten.text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn each_command_is_written_as_what_it_stands_for() {
        for (source, wanted) in [
            (r"\dv{x} x^3", r"\frac{d}{d x} x^3"),
            (r"\dv[2]{f}{t}", r"\frac{d^{2} f}{d t^{2}}"),
            (
                r"\pdv{u}{x}{y} + \pdv{u}{t}",
                r"\frac{\partial^2 u}{\partial x \partial y} + \frac{\partial u}{\partial t}",
            ),
            (r"\qty(a+\qty[b])^2", r"\left(a+\left[b\right]\right)^2"),
            (r"\int_0^1 x \dd{x}", r"\int_0^1 x \, d x"),
            (r"\nicefrac12 + \sfrac{a}{b}", r"\frac{1}{2} + \frac{a}{b}"),
            (r"{\color{red} a} + \textcolor{blue}{b}", r"{ a} + {b}"),
            (r"{a + b \over 2}", r"{\frac{a + b }{ 2}}"),
            (r"{d \over dx} x^{d \over 2}", r"\frac{d }{ dx} x^{\frac{d }{ 2}}"),
            (r"{n \choose {a \over b}}", r"{\binom{n }{ {\frac{a }{ b}}}}"),
            (r"a \stackrel{(3)}{=} b", "a = b"),
            (r"a \overset{!}{\le} b", r"a \le b"),
            (r"a \overset{(a)}{=} b", r"a = b"),
            (r"\overset{a}{b}", r"\overset{a}{b}"),
            (r"X \stackrel{d}{=} Y", r"X \stackrel{d}{=} Y"),
            (r"1{,}000 x", r"1{,}000 x"),
            (r"0{,}5 x + 1\,000 y \, z", r"0.5 x + 1000 y \, z"),
            (
                r"x^{\prime 2} + y^{\prime\prime} + z^\prime",
                r"x'^{ 2} + y'' + z^\prime",
            ),
            (r"\mqty[a & b \\ c & d]", r"\begin{bmatrix}a & b \\ c & d\end{bmatrix}"),
            (r"x / \num{2e3}", r"x / \num{2e3}"),
            (r"\num{1.5e-3} m", r"1.5 \cdot 10^{-3} m"),
            (r"\ang{30} + x", r"30^\circ + x"),
            (r"\ang{1;30;}", r"\ang{1;30;}"),
            (
                r"x - \SI{-2}{\meter}",
                r"x - \frac{-2 \cdot \upsilon_{\mathrm{meter}}}{1}",
            ),
            (
                r"\SI{2e3}{\meter} (a + b)",
                r"\frac{2 \cdot 10^{3} \cdot \upsilon_{\mathrm{meter}}}{1} (a + b)",
            ),
            (r"x/\si{\second}", r"x/\frac{\upsilon_{\mathrm{second}}}{1}"),
            (
                r"\SI{5}{\parsec} + \SI{1,000}{\meter}",
                r"\SI{5}{\parsec} + \SI{1,000}{\meter}",
            ),
            (r"a = b \qed", "a = b"),
            (r"\underbrace{a + b}_{c} - b", "a + b - b"),
            (r"\underbrace{a + b}_{c} - c", r"\underbrace{a + b}_{c} - c"),
            (r"\underbrace{a + b}_{= 0} - c", r"\underbrace{a + b}_{= 0} - c"),
            (r"\abs(x) + \abs{x}", r"\abs(x) + \left|x\right|"),
        ] {
            assert_eq!(plain(source), wanted, "{source}");
        }
    }

    #[test]
    fn what_needs_nothing_is_left_as_it_is_and_places_are_those_of_the_source() {
        let source = r"\frac{a}{b} = c % \dv{x}";
        assert!(matches!(Plain::of(source, &Names::default()).text, Cow::Borrowed(_)));
        let source = r"a + \cancel{b} = \qty(c) ? d";
        let rewritten = Plain::of(source, &Names::default());
        for sign in ["b", "?", "d"] {
            let at = rewritten.text.rfind(sign).unwrap();
            assert_eq!(rewritten.source(at), source.rfind(sign).unwrap(), "{sign}");
        }
    }

    #[test]
    fn a_term_that_is_not_understood_is_one_symbol_where_that_is_asked_for() {
        let names = Names {
            opaque: Some(Opaque::default()),
            functions: vec![Name::plain("x")],
            ..Names::default()
        };
        for (source, wanted) in [
            (r"\mathbb{E}[X + 1] = a", "<\\mathbb{E}[X+1]> = a"),
            (
                r"\mathbb E_t \left[ c_{t+1} \right] + x(t)",
                "<\\mathbb E_t[c_{t+1}]> + x(t)",
            ),
            (r"p(x | y) p(y) = p(x, y)", "<p(x|y)> <p(y)> = <p(x,y)>"),
            (r"m(a + b) + f(a + b) + \sin(a)", r"m(a + b) + <f(a+b)> + \sin(a)"),
            (r"\nabla^2 u + \nabla \cdot v", r"<\nabla^2u> + <\nabla\cdot v>"),
            (r"O(h^2) + \mathcal{O}(h)", r"O(h^2) + \mathcal{O}(h)"),
            (r"\langle a, b \rangle^2", r"<\langle a,b\rangle>^2"),
            (r"n \in \mathbb{Z}", r"n \in \mathbb{Z}"),
            (r"\sum_{t=0}^\infty b^t c_t + 1", r"<\sum_{t=0}^\infty b^tc_t>+ 1"),
        ] {
            let text = Plain::of(source, &names)
                .text
                .replace(OPAQUE[0], "<")
                .replace(OPAQUE[1], ">");
            assert_eq!(text, wanted, "{source}");
            assert!(!Plain::of(source, &Names::default()).text.contains(OPAQUE[0]));
        }
    }

    #[test]
    fn hostile_nesting_ends() {
        for part in [
            "{",
            "{\\over",
            r"\qty(",
            r"\dv{",
            r"^{\prime",
            r"\cancel",
            r"\mqty[",
            "0{,}",
        ] {
            let deep = part.repeat(20_000);
            assert!(
                Plain::of(
                    &deep,
                    &Names {
                        opaque: Some(Opaque::default()),
                        ..Names::default()
                    }
                )
                .text
                .len()
                    <= 12 * deep.len(),
                "{part}"
            );
        }
    }
}
