//! TeX source -> tokens. What does not change the meaning (blanks, sizes, fonts, alignment) ends here.

use super::Names;
use super::Relation;
use super::command::{Command, Side, WORD_SPACE, character, character_hint, command, shape, spelled};
use super::error::{Fault, Reason};
use super::hidden::DOTS;
use super::nearest::nearest;
use super::shorthand::{OPAQUE, Plain};
use super::token::{Bracket, Kind, Rows, Set, Token};
use std::collections::BTreeMap;

/// Commands that a misspelt one may be meant for.
const COMMON: [&str; 72] = [
    r"\frac",
    r"\dfrac",
    r"\tfrac",
    r"\sqrt",
    r"\sum",
    r"\prod",
    r"\int",
    r"\lim",
    r"\sin",
    r"\cos",
    r"\tan",
    r"\arcsin",
    r"\arccos",
    r"\arctan",
    r"\sinh",
    r"\cosh",
    r"\tanh",
    r"\exp",
    r"\ln",
    r"\log",
    r"\left",
    r"\right",
    r"\begin",
    r"\end",
    r"\quad",
    r"\qquad",
    r"\cdot",
    r"\times",
    r"\partial",
    r"\infty",
    r"\alpha",
    r"\beta",
    r"\gamma",
    r"\delta",
    r"\epsilon",
    r"\varepsilon",
    r"\zeta",
    r"\eta",
    r"\theta",
    r"\kappa",
    r"\lambda",
    r"\mu",
    r"\nu",
    r"\xi",
    r"\pi",
    r"\rho",
    r"\sigma",
    r"\tau",
    r"\phi",
    r"\varphi",
    r"\chi",
    r"\psi",
    r"\omega",
    r"\Omega",
    r"\Delta",
    r"\dot",
    r"\ddot",
    r"\hat",
    r"\bar",
    r"\tilde",
    r"\vec",
    r"\overline",
    r"\underline",
    r"\mathbf",
    r"\mathrm",
    r"\text",
    r"\operatorname",
    r"\boxed",
    r"\binom",
    r"\pm",
    r"\neq",
    r"\leq",
];

/// The characters around a symbol that is a whole term.
const OPENED: char = OPAQUE[0];
const CLOSED: char = OPAQUE[1];

/// The least width of a blank that may part equations, in eighteenths of a quad: two spaces between words.
const WIDE: u32 = 12;

/// The tokens of `tex`.
pub(super) fn lex(tex: &str) -> Result<Vec<Token<'_>>, Fault> {
    let mut lexer = Lexer::new(tex);
    while lexer.step()? {}
    if let Some((at, text)) = lexer.sized {
        return Err(Fault::unexpected(tex.len().max(at), text, "a bracket after it"));
    }
    match lexer.environments.pop() {
        Some((at, name)) => Err(Fault::unclosed(at, &format!("\\begin{{{name}}}"))),
        None => Ok(lexer.tokens),
    }
}

/// The letters of `tex` as far as it can be read, each with how it is printed: in bold or not, and in which of two shapes.
pub fn letters(tex: &str, names: &Names) -> Vec<(String, String)> {
    let plain = Plain::of(tex, names);
    let mut lexer = Lexer::new(&plain.text);
    while matches!(lexer.step(), Ok(true)) {}
    let printed = |(letter, shape, font): (&str, &str, &str)| match font {
        "" => (letter.to_owned(), shape.to_owned()),
        font => (letter.to_owned(), format!("{font}{{{shape}}}")),
    };
    lexer.letters.into_iter().map(printed).collect()
}

/// What `tex` prints, without the blanks before and behind it.
pub fn printed(tex: &str) -> &str {
    let mut lexer = Lexer::new(tex);
    // what prints something, but for empty groups
    let (mut printing, mut seen) = (Vec::<Token<'_>>::new(), 0);
    let (mut start, mut end) = (0, tex.len());
    loop {
        let more = lexer.step();
        for token in lexer.tokens.iter().skip(seen) {
            match (printing.last().map(|last| last.kind), token.kind) {
                (_, Kind::Quad | Kind::Column) => {}
                (Some(Kind::BraceOpen), Kind::BraceClose) => {
                    printing.pop();
                }
                _ => printing.push(*token),
            }
        }
        seen = lexer.tokens.len();
        if printing.is_empty() && lexer.sized.is_none() && lexer.side.is_none() && more.is_ok() {
            start = lexer.at;
        }
        match more {
            Ok(true) => {}
            Ok(false) => {
                end = printing.last().map_or(start, |last| last.end);
                break;
            }
            Err(_) => break,
        }
    }
    tex.get(start..end).unwrap_or_default().trim()
}

/// What is printed around a part of a formula and says nothing of its value, or where the value is taken.
#[derive(Clone, Copy)]
enum Frame {
    /// `\boxed{...}`: its brace.
    Box,
    /// `\underbrace{...}_{...}`: the brace, and the sign before what stands at it.
    Brace(char),
    /// `\left. ... \right|_{x = a}`: the bar.
    Value,
}

struct Lexer<'a> {
    tex: &'a str,
    at: usize,
    tokens: Vec<Token<'a>>,
    /// A `\left` or `\right` that waits for its bracket.
    sized: Option<(usize, &'a str)>,
    /// Whether the letter that comes next stands alone in its font.
    styled: bool,
    /// Whether a bar that comes next opens or closes.
    side: Option<Side>,
    /// The width of the small blanks since the last token, in eighteenths of a quad.
    blank: u32,
    environments: Vec<(usize, &'a str)>,
    /// Where the letters in bold end.
    bold: usize,
    /// What ends at these bytes, of what is printed around others.
    frames: BTreeMap<usize, Frame>,
    /// The letters, each with its shape and the command of its font, if that tells it from others.
    letters: Vec<(&'a str, &'a str, &'static str)>,
}

impl<'a> Lexer<'a> {
    fn new(tex: &'a str) -> Self {
        Self {
            tex,
            at: 0,
            tokens: Vec::new(),
            sized: None,
            styled: false,
            side: None,
            blank: 0,
            environments: Vec::new(),
            bold: 0,
            frames: BTreeMap::new(),
            letters: Vec::new(),
        }
    }

    fn rest(&self) -> &'a str {
        self.tex.get(self.at..).unwrap_or("")
    }

    fn span(&self, from: usize, to: usize) -> &'a str {
        self.tex.get(from..to).unwrap_or("")
    }

    /// Reads on; whether there was more.
    fn step(&mut self) -> Result<bool, Fault> {
        match self.rest().chars().next() {
            Some(c) => self.step_over(c).map(|()| true),
            None => Ok(false),
        }
    }

    fn step_over(&mut self, c: char) -> Result<(), Fault> {
        if let Some(frame) = self.frames.remove(&self.at) {
            return self.end_frame(frame);
        }
        let rest = self.rest();
        match c {
            OPENED => {
                let length = rest.find(CLOSED).unwrap_or(rest.len());
                let text = rest.get(OPENED.len_utf8()..length).unwrap_or_default();
                let (at, end) = (self.at, (self.at + length + CLOSED.len_utf8()).min(self.tex.len()));
                return self.push_as(Kind::Letter, text, at, end);
            }
            '%' => self.at += rest.find('\n').unwrap_or(rest.len()),
            '$' => self.at += 1,
            '~' => return self.blank(WORD_SPACE, self.at + 1),
            '.' if rest.starts_with("...") => return self.push(Kind::Dots, 3),
            '…' | '⋯' => return self.push(Kind::Dots, c.len_utf8()),
            '&' => return self.push(Kind::Column, 1),
            '\\' => return self.command(),
            c if c.is_whitespace() => self.at += c.len_utf8(),
            c if c.is_ascii_digit() || (c == '.' && digit_at(rest, 1)) => {
                return self.push(Kind::Number, number_length(rest));
            }
            c if c.is_ascii_alphabetic() => return self.push(Kind::Letter, 1),
            // behind a condition in front
            ':' if !rest.starts_with(":=") && is_condition_in_front(&self.tokens) => return self.push(Kind::Comma, 1),
            ':' if rest.starts_with(":=") => return self.push(Kind::Relation(Relation::Equal), 2),
            // as programs write them
            '<' if rest.starts_with("<=") => return self.push(Kind::Relation(Relation::LessOrEqual), 2),
            '>' if rest.starts_with(">=") => return self.push(Kind::Relation(Relation::GreaterOrEqual), 2),
            c => {
                if let Some(tokens) = spelled(c) {
                    let (at, end) = (self.at, self.at + c.len_utf8());
                    return tokens
                        .iter()
                        .try_for_each(|&(kind, text)| self.push_as(kind, text, at, end));
                }
                let kind = character(c)
                    .ok_or_else(|| Fault::unreadable(self.at, c.encode_utf8(&mut [0; 4]), character_hint(c)))?;
                return self.push(kind, c.len_utf8());
            }
        }
        Ok(())
    }

    fn push(&mut self, kind: Kind, length: usize) -> Result<(), Fault> {
        let text = self.span(self.at, self.at + length);
        self.push_as(kind, text, self.at, self.at + length)
    }

    fn push_as(&mut self, kind: Kind, text: &'a str, at: usize, end: usize) -> Result<(), Fault> {
        let (kind, text, is_sign) = match self.sign_of_transpose(kind, text) {
            Some(sign) => (Kind::Letter, sign, true),
            None => (kind, text, false),
        };
        let kind = match (kind, self.side.take()) {
            (Kind::Bar, Some(Side::Opening)) => Kind::Open(Bracket::Bar),
            (Kind::Bar, Some(Side::Closing)) => Kind::Close(Bracket::Bar),
            (Kind::DoubleBar, Some(Side::Opening)) => Kind::Open(Bracket::DoubleBar),
            (Kind::DoubleBar, Some(Side::Closing)) => Kind::Close(Bracket::DoubleBar),
            _ => kind,
        };
        if let Some((_, sized)) = self.sized.take()
            && !matches!(kind, Kind::Open(_) | Kind::Close(_))
        {
            let wanted = format!("a bracket after `{sized}`");
            return Err(Fault::unexpected(at, text, &wanted));
        }
        let kind = match kind {
            Kind::BraceClose if self.closes_blanks() => Kind::Quad,
            kind => kind,
        };
        if kind == Kind::Letter {
            let shape = shape(self.span(at, end)).unwrap_or(text);
            // upright d, e, i and T are what they are in italics: a differential, constants, a transpose
            let font = match self.styled && !is_sign && !matches!(text, "d" | "e" | "i" | "T") {
                _ if at < self.bold && !is_sign => r"\mathbf",
                true => r"\mathrm",
                false => "",
            };
            self.letters.push((text, shape, font));
        }
        let styled = self.styled && kind == Kind::Letter && !is_sign;
        self.styled &= kind == Kind::BraceOpen;
        let spaced = std::mem::take(&mut self.blank) > 0;
        self.tokens.push(Token {
            kind,
            text,
            at,
            end,
            split: false,
            styled,
            spaced,
        });
        self.at = end;
        Ok(())
    }

    /// The sign of a transpose or an adjoint that an upright letter above is: `A^\mathrm{T}`, `A^\text{H}`.
    fn sign_of_transpose(&self, kind: Kind, text: &str) -> Option<&'static str> {
        let is_upright = kind == Kind::Word || (kind == Kind::Letter && self.styled);
        let is_raised = || {
            let mut before = self.tokens.iter().rev().map(|token| token.kind);
            before.find(|kind| *kind != Kind::BraceOpen) == Some(Kind::Sup)
        };
        let sign = match text {
            "T" => r"\top",
            "H" => r"\dagger",
            _ => return None,
        };
        (is_upright && is_raised()).then_some(sign)
    }

    /// Whether a brace that closes now holds wide blanks alone, which are taken away with the brace that opens.
    fn closes_blanks(&mut self) -> bool {
        let blanks = self
            .tokens
            .iter()
            .rev()
            .take_while(|token| token.kind == Kind::Quad)
            .count();
        let open = self.tokens.len() - blanks;
        let is_group = blanks > 0 && open > 0 && self.tokens[open - 1].kind == Kind::BraceOpen;
        if is_group {
            self.tokens.truncate(open - 1);
        }
        is_group
    }

    fn command(&mut self) -> Result<(), Fault> {
        let at = self.at;
        let body = self.span(at + 1, self.tex.len());
        let letters = body.find(|c: char| !c.is_ascii_alphabetic());
        let length = match letters.unwrap_or(body.len()) {
            0 => body.chars().next().map_or(0, char::len_utf8),
            length => length,
        };
        let end = at + 1 + length;
        let text = self.span(at, end);
        match command(text) {
            Command::Token(kind) => self.push(kind, length + 1),
            Command::Spelled(kind, canonical) => self.push_as(kind, canonical, at, end),
            Command::Row => {
                self.push(Kind::Row, length + 1)?;
                self.row_options();
                Ok(())
            }
            Command::Skip => {
                self.at = end;
                Ok(())
            }
            Command::SkipGroup => self.skip_group(end).map(|_| ()),
            Command::Blank(width) => self.blank(width, end),
            Command::Space => match self.skip_group(end)?.is_empty() {
                true => Ok(()),
                false => self.push_as(Kind::Quad, text, at, self.at),
            },
            Command::Blackboard => self.set(end),
            Command::Side(side) => {
                self.at = end;
                self.side = Some(side);
                Ok(())
            }
            Command::Sized(side) => {
                self.at = end;
                self.side = Some(side);
                self.sized = Some((at, text));
                self.empty_delimiter(side)
            }
            // at the start it says nothing of the formula; between two it says that one follows from the other
            Command::Therefore if self.tokens.is_empty() => {
                self.at = end;
                Ok(())
            }
            Command::Therefore => {
                let instead = ": write \\Rightarrow, or give each statement an entry of its own";
                Err(Fault::unreadable(at, text, instead))
            }
            Command::Box => self.boxed(end),
            Command::Brace(sign) => {
                let (_, close) = self.group(end)?;
                self.frames.insert(close - 1, Frame::Brace(sign));
                self.at = end;
                Ok(())
            }
            Command::Font => self.font(end),
            Command::Bold => {
                // within bold letters all are bold; looking for the end at each depth would make long input slow
                if end > self.bold {
                    self.bold = self.end_of_argument(end);
                }
                self.font(end)
            }
            Command::Glue => {
                let behind = end + glue_length(self.span(end, self.tex.len()));
                match glue_width(self.span(end, behind)) {
                    Some(width) => self.blank(width, behind),
                    None => {
                        self.at = behind;
                        self.push_as(Kind::Quad, text, at, behind)
                    }
                }
            }
            Command::Class => {
                let inside = self.skip_group(end)?;
                // one within another would be looked into at each depth
                let is_blank = !inside.contains(r"\math") && printed(inside).is_empty();
                is_blank.then_some(()).ok_or_else(|| Fault::unreadable(at, text, ""))
            }
            Command::Text => self.text(end),
            Command::Begin => self.begin(end),
            Command::End => self.end(end),
            Command::Unknown(_) if DOTS.contains(&text) => self.push(Kind::Dots, length + 1),
            Command::Unknown("") => {
                let meant = nearest(text, COMMON).map(|meant| format!(", did you mean `{meant}`?"));
                Err(Fault::unreadable(at, text, &meant.unwrap_or_default()))
            }
            Command::Unknown(instead) => Err(Fault::unreadable(at, text, instead)),
        }
    }

    /// A small blank that ends at byte `end`: several of them part equations as a wide one does.
    fn blank(&mut self, width: u32, end: usize) -> Result<(), Fault> {
        let at = std::mem::replace(&mut self.at, end);
        self.blank += width;
        match self.blank >= WIDE && self.sized.is_none() {
            true => self.push_as(Kind::Quad, self.span(at, end), at, end),
            false => Ok(()),
        }
    }

    /// `\\*` and `\\[2pt]`.
    fn row_options(&mut self) {
        if self.rest().starts_with('*') {
            self.at += 1;
        }
        let Some(inside) = self.rest().strip_prefix('[') else {
            return;
        };
        let Some((option, _)) = inside.split_once(']') else {
            return;
        };
        let units = ["pt", "em", "ex", "mm", "cm", "in"];
        let value = units.iter().find_map(|unit| option.trim().strip_suffix(unit));
        if value.is_some_and(|value| value.trim().parse::<f32>().is_ok()) {
            self.at += option.len() + 2;
        }
    }

    /// `\boxed{...}` around one equation or one side of it; within a side it could be a bracket.
    fn boxed(&mut self, end: usize) -> Result<(), Fault> {
        let divides = |kind: Kind| {
            matches!(
                kind,
                Kind::Relation(_) | Kind::Approximately | Kind::Column | Kind::Row | Kind::Quad
            )
        };
        let (_, close) = self.group(end)?;
        let behind = self.span(close, self.tex.len()).trim_start();
        let ends = behind.is_empty()
            || [
                "=", "&", r"\\", ",", ".", ";", r"\quad", r"\qquad", r"\end", r"\label", r"\tag",
            ]
            .iter()
            .any(|end| behind.starts_with(end));
        if !ends || self.tokens.last().is_some_and(|last| !divides(last.kind)) {
            let instead = ": a box is read around an equation or a side of it";
            return Err(Fault::unreadable(self.at, r"\boxed", instead));
        }
        self.at = close - self.span(end, close).trim_start().len() + 1;
        self.frames.insert(close - 1, Frame::Box);
        Ok(())
    }

    fn end_frame(&mut self, frame: Frame) -> Result<(), Fault> {
        match frame {
            Frame::Box => {
                self.at += 1;
                Ok(())
            }
            Frame::Brace(sign) => {
                self.push(Kind::BraceClose, 1)?;
                let behind = self.rest().trim_start();
                if let Some(script) = behind.strip_prefix(sign) {
                    let at = self.tex.len() - script.len();
                    let end = self.end_of_argument(at);
                    let label = self.span(at, end).trim_start_matches('{').trim_start();
                    if ![r"\text", r"\mathrm", r"\mbox"]
                        .iter()
                        .any(|command| label.starts_with(command))
                    {
                        let instead = ": words at a brace are read, what could be a name or a formula is not";
                        return Err(Fault::unreadable(at, self.span(at, end), instead));
                    }
                    self.at = end;
                }
                Ok(())
            }
            Frame::Value => {
                let bar = self.rest().find('_').unwrap_or_default();
                self.push_as(Kind::Close(Bracket::Square), "]", self.at, self.at + bar)
            }
        }
    }

    /// Where the `\right` stands that belongs to a `\left` before this byte, if `|_` follows it.
    fn bar_with_value(&self, from: usize) -> Option<usize> {
        let mut depth = 1_usize;
        let sides = self
            .span(from, self.tex.len())
            .match_indices('\\')
            .filter_map(|(at, _)| {
                let rest = self.span(from + at + 1, self.tex.len());
                let length = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
                Some((from + at, rest.get(..length)?, rest.get(length..)?))
            });
        for (at, name, behind) in sides {
            match name {
                "left" => depth += 1,
                "right" => depth -= 1,
                _ => continue,
            }
            if depth == 0 {
                let behind = behind.trim_start();
                let bar = [r"\vert", r"\rvert", "|"]
                    .iter()
                    .find_map(|bar| behind.strip_prefix(bar));
                return bar.filter(|script| script.trim_start().starts_with('_')).map(|_| at);
            }
        }
        None
    }

    /// `\left. ... \right|_{x = a}` is a bracket. Any other `\left.` leaves one open or closed out of nowhere, so that its partner
    /// cannot be checked.
    fn empty_delimiter(&mut self, side: Side) -> Result<(), Fault> {
        let behind = self.rest().trim_start();
        if behind.starts_with('.') {
            let point = self.tex.len() - behind.len();
            if matches!(side, Side::Opening)
                && let Some(bar) = self.bar_with_value(point)
            {
                self.frames.insert(bar, Frame::Value);
                return self.push_as(Kind::Open(Bracket::Square), NO_BRACKET, self.at, point + 1);
            }
            let instead = ": it prints no bracket; write the bracket that is meant";
            let text = self.sized.map_or("", |(_, text)| text);
            return Err(Fault::unreadable(self.at, &format!("{text}."), instead));
        }
        Ok(())
    }

    /// The content of the braces that follow `from`, and the offset behind them.
    fn group(&self, from: usize) -> Result<(&'a str, usize), Fault> {
        let rest = self.span(from, self.tex.len());
        let open = from + (rest.len() - rest.trim_start().len());
        let mut depth = 0usize;
        let mut escaped = false;
        for (offset, c) in self.span(open, self.tex.len()).char_indices() {
            match c {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth == 0 {
                let end = open + offset + c.len_utf8();
                return match c {
                    '}' => Ok((self.span(open + 1, open + offset), end)),
                    _ => Err(Fault::unexpected(open, c.encode_utf8(&mut [0; 4]), "`{`")),
                };
            }
        }
        match depth {
            0 => Err(Fault::unexpected(open, "the end", "`{`")),
            _ => Err(Fault::unclosed(open, "{")),
        }
    }

    /// Skips the group behind `from`; returns what it holds.
    fn skip_group(&mut self, from: usize) -> Result<&'a str, Fault> {
        let star = usize::from(self.span(from, self.tex.len()).starts_with('*'));
        let (content, end) = self.group(from + star)?;
        self.at = end;
        Ok(content)
    }

    /// A math font: it matters only where it makes one word of several letters.
    fn font(&mut self, end: usize) -> Result<(), Fault> {
        let rest = self.span(end, self.tex.len()).trim_start();
        let word = rest.strip_prefix('{').and_then(|inside| {
            let length = inside.find(|c: char| !c.is_ascii_alphabetic())?;
            (inside.get(length..)?.starts_with('}') && length > 1).then_some(())
        });
        match word {
            Some(()) => self.text(end),
            None => {
                self.at = end;
                self.styled = is_single_letter(rest);
                Ok(())
            }
        }
    }

    /// Where the argument ends that starts at byte `from`: a group, a command or a character.
    fn end_of_argument(&self, from: usize) -> usize {
        let rest = self.span(from, self.tex.len());
        let start = from + (rest.len() - rest.trim_start().len());
        let mut behind = self.span(start, self.tex.len()).chars();
        match behind.next() {
            Some('{') => self.group(from).map_or(self.tex.len(), |(_, end)| end),
            Some('\\') => start + 1 + behind.take_while(char::is_ascii_alphabetic).count(),
            Some(c) => start + c.len_utf8(),
            None => start,
        }
    }

    /// `\mathbb{R}` and its like.
    fn set(&mut self, end: usize) -> Result<(), Fault> {
        let at = self.at;
        let rest = self.span(end, self.tex.len()).trim_start();
        let (name, after) = match rest.starts_with('{') {
            true => self.group(end)?,
            false => {
                let from = self.tex.len() - rest.len();
                let to = from + rest.chars().next().map_or(0, char::len_utf8);
                (self.span(from, to), to)
            }
        };
        let text = self.span(at, after);
        let instead = match name.trim() {
            "R" => return self.push_as(Kind::Set(Set::Real), text, at, after),
            "Z" => return self.push_as(Kind::Set(Set::Integer), text, at, after),
            "C" => return self.push_as(Kind::Set(Set::Complex), text, at, after),
            "N" => ": some authors count 0 in, others do not; write n \\in \\mathbb{Z} and a bound",
            _ => ": only \\mathbb{Z}, \\mathbb{R} and \\mathbb{C} are",
        };
        Err(Fault::unreadable(at, text, instead))
    }

    fn text(&mut self, end: usize) -> Result<(), Fault> {
        let at = self.at;
        let star = usize::from(self.span(end, self.tex.len()).starts_with('*'));
        let (content, after) = self.group(end + star)?;
        let word = content.trim_matches(|c: char| c.is_whitespace() || c == ',');
        let word = match word {
            // a sentence may begin so
            "For" => "for",
            "For all" => "for all",
            "For every" => "for every",
            "If" => "if",
            "When" => "when",
            word => word,
        };
        match word {
            "and" | "where" | "with" => self.push_as(Kind::And, word, at, after),
            "for all" | "for any" | "for each" | "for every" => self.push_as(Kind::Said, "\\forall", at, after),
            "for integer" | "for integers" | "for all integers" | "for all integer" | "for any integer"
            | "for each integer" | "for every integer" => self.push_as(Kind::Said, INTEGERS, at, after),
            "then" if is_condition_in_front(&self.tokens) => self.push_as(Kind::Comma, word, at, after),
            "provided" | "provided that" | "whenever" => self.push_as(Kind::Said, "when", at, after),
            "if" | "for" | "when" | "otherwise" | "else" | "even" | "odd" => self.push_as(Kind::Said, word, at, after),
            "" if content.contains(',') => self.push_as(Kind::Comma, ",", at, after),
            "" => {
                self.at = after;
                Ok(())
            }
            _ if word.chars().all(|c| c.is_ascii_alphabetic()) && content.trim_end() == word => {
                self.push_as(Kind::Word, word, at, after)
            }
            _ => Err(Fault::unreadable(at, self.span(at, after), "")),
        }
    }

    fn begin(&mut self, end: usize) -> Result<(), Fault> {
        let (name, after) = self.group(end)?;
        if let Some(rows) = rows(name) {
            self.environments.push((self.at, name));
            let after = match name {
                "array" => self.group(after)?.1,
                _ => after,
            };
            let (at, text) = (self.at, self.span(self.at, after));
            return self.push_as(Kind::Open(Bracket::Rows(rows)), text, at, after);
        }
        let known = [
            "equation", "align", "aligned", "split", "gather", "gathered", "multline", "eqnarray",
        ];
        if !known.contains(&name.trim_end_matches('*')) {
            let text = self.span(self.at, after);
            return Err(Fault::unreadable(self.at, text, ""));
        }
        let has_position = ["aligned", "gathered"].contains(&name);
        self.environments.push((self.at, name));
        self.at = after;
        // where it stands beside the line
        let position = ["[t]", "[c]", "[b]"]
            .into_iter()
            .find(|position| has_position && self.rest().starts_with(position));
        self.at += position.map_or(0, str::len);
        Ok(())
    }

    fn end(&mut self, end: usize) -> Result<(), Fault> {
        let (name, after) = self.group(end)?;
        let close = self.span(self.at, after).to_owned();
        match self.environments.pop() {
            Some((_, open)) if open == name => match rows(name) {
                Some(rows) => {
                    let (at, text) = (self.at, self.span(self.at, after));
                    self.push_as(Kind::Close(Bracket::Rows(rows)), text, at, after)
                }
                None => {
                    self.at = after;
                    Ok(())
                }
            },
            Some((_, open)) => {
                let open = format!("\\begin{{{open}}}");
                Err(Fault::new(self.at, Reason::Mismatched { open, close }))
            }
            None => Err(Fault::new(self.at, Reason::Unopened { close })),
        }
    }
}

/// What opens a bracket that prints nothing, before the bar of a value.
pub(super) const NO_BRACKET: &str = "\\left.";

/// The word before letters that are integers.
pub(super) const INTEGERS: &str = "for integers";

/// Whether these tokens are a condition that stands in front, behind "for", "if", "when" or `\forall`.
fn is_condition_in_front(tokens: &[Token<'_>]) -> bool {
    let is_said = tokens.first().is_some_and(|first| first.kind == Kind::Said);
    // what follows a colon or "then" is in front of nothing, and looked at once
    let ends = |token: &Token<'_>| matches!(token.kind, Kind::Row | Kind::Quad) || matches!(token.text, ":" | "then");
    is_said && !tokens.iter().any(ends)
}

/// The length of the dimension behind `\hskip`: `1em plus 1fil minus 2pt`.
fn glue_length(rest: &str) -> usize {
    const STRETCHES: [&str; 2] = ["plus", "minus"];
    const UNITS: [&str; 13] = [
        "filll", "fill", "fil", "pt", "em", "ex", "mm", "cm", "in", "mu", "sp", "bp", "pc",
    ];
    let belongs = |c: char| c.is_ascii_digit() || c.is_whitespace() || "+-.".contains(c);
    let mut length = 0;
    loop {
        let behind = rest.get(length..).unwrap_or_default();
        let number = behind.len() - behind.trim_start_matches(belongs).len();
        let mut words = STRETCHES.iter().chain(&UNITS);
        let Some(word) = words.find(|word| behind.get(number..).is_some_and(|unit| unit.starts_with(**word))) else {
            return length;
        };
        length += number + word.len();
        let next = rest.get(length..).unwrap_or_default().trim_start();
        if !STRETCHES.contains(word) && !STRETCHES.iter().any(|stretch| next.starts_with(stretch)) {
            return length;
        }
    }
}

/// The width of a dimension in mu, of which a quad has 18; none where it is wide or stretches without end.
fn glue_width(dimension: &str) -> Option<u32> {
    let unit = dimension
        .trim()
        .trim_start_matches(|c: char| c.is_ascii_digit() || "+-. ".contains(c));
    let mu = match unit.get(..2)? {
        "mu" => 1.0,
        "em" => 18.0,
        "ex" => 8.0,
        "pt" | "bp" => 1.8,
        "mm" => 5.1,
        "sp" => 0.0,
        _ => return None,
    };
    let number = dimension.trim().split(unit).next()?.trim().parse::<f64>().ok()?;
    let width = (number * mu).clamp(0.0, f64::from(WIDE));
    // a whole number between 0 and WIDE
    (width < f64::from(WIDE)).then_some(width as u32)
}

/// What the rows of the environment `name` mean; `None` for any other.
fn rows(name: &str) -> Option<Rows> {
    match name {
        "matrix" | "pmatrix" | "bmatrix" | "Bmatrix" | "smallmatrix" | "array" => Some(Rows::Matrix),
        "vmatrix" => Some(Rows::Determinant),
        "cases" | "dcases" => Some(Rows::Cases),
        _ => None,
    }
}

/// Whether `rest` starts with a letter alone between braces, or without braces.
fn is_single_letter(rest: &str) -> bool {
    let inside = rest.strip_prefix('{').unwrap_or(rest);
    let mut letters = inside.chars().map(|c| c.is_ascii_alphabetic());
    letters.next() == Some(true) && letters.next() != Some(true)
}

fn digit_at(text: &str, offset: usize) -> bool {
    text.as_bytes().get(offset).is_some_and(u8::is_ascii_digit)
}

/// The length of the number at the start of `rest`: a point belongs to it only before a digit.
fn number_length(rest: &str) -> usize {
    let digits = |from: usize| {
        let tail = rest.get(from..).unwrap_or("");
        tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len())
    };
    let whole = digits(0);
    let point = rest.get(whole..).is_some_and(|tail| tail.starts_with('.'));
    match point && digit_at(rest, whole + 1) {
        true => whole + 1 + digits(whole + 1),
        false => whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(tex: &str) -> Vec<&str> {
        lex(tex).unwrap().iter().map(|token| token.text).collect()
    }

    #[test]
    fn drops_what_does_not_change_the_meaning() {
        let tex = r"\begin{align} \displaystyle \left( a \, b~\;\! \right) \nonumber \label{x{y}} % c
            \bigl[ \biggr] \tag{3} $ $$ \[ \] \end{align}";
        assert_eq!(texts(tex), ["(", "a", "b", ")", "[", "]"]);
    }

    #[test]
    fn inequalities_are_read_as_programs_write_them() {
        let kinds = |tex: &str| lex(tex).unwrap()[1].kind;
        assert_eq!(kinds("a <= b"), Kind::Relation(Relation::LessOrEqual));
        assert_eq!(kinds("a >= b"), Kind::Relation(Relation::GreaterOrEqual));
    }

    #[test]
    fn boxes_braces_and_bars_of_values_are_read_through() {
        assert_eq!(texts(r"\boxed{a = b}."), ["a", "=", "b", "."]);
        assert_eq!(texts(r"a = \boxed {b}"), ["a", "=", "b"]);
        assert_eq!(
            texts(r"\underbrace{a + b}_{\text{sum}} + \overbrace{c}^{\mbox{c}}"),
            ["{", "a", "+", "b", "}", "+", "{", "c", "}"]
        );
        assert_eq!(
            texts(r"\left. \left( a \right) \right|_{x}"),
            [r"\left.", "(", "a", ")", "]", "_", "{", "x", "}"]
        );
        assert_eq!(texts(r"\text{For } x > 0: a"), ["for", "x", ">", "0", ":", "a"]);
    }

    #[test]
    fn letters_and_signs_outside_ascii_are_those_of_commands() {
        assert_eq!(
            texts("πα·ϕ² ± Ω"),
            [r"\pi", r"\alpha", "·", r"\phi", "^", "2", "±", r"\Omega"]
        );
        let kinds = |tex: &str| lex(tex).unwrap().iter().map(|token| token.kind).collect::<Vec<_>>();
        assert_eq!(kinds("·×⋅∓÷∂∞°"), kinds(r"\cdot\times\cdot\mp\div\partial\infty\circ"));
    }

    #[test]
    fn the_position_of_lines_is_no_factor() {
        assert_eq!(texts(r"\begin{aligned}[b] a &= b \end{aligned}"), ["a", "&", "=", "b"]);
        assert_eq!(
            texts(r"\begin{equation}[b] a = b \end{equation}"),
            ["[", "b", "]", "a", "=", "b"]
        );
    }

    #[test]
    fn numbers_end_before_a_full_stop() {
        assert_eq!(texts("0.26 .5 2. 3.x"), ["0.26", ".5", "2", ".", "3", ".", "x"]);
    }

    #[test]
    fn fonts_make_words_and_are_gone_otherwise() {
        assert_eq!(texts(r"\mathrm{Tr} \mathbf{H} \rm B"), ["Tr", "{", "H", "}", "B"]);
        let tokens = lex(r"\text{ and } \quad \\[2pt] \\*").unwrap();
        let kinds: Vec<Kind> = tokens.iter().map(|token| token.kind).collect();
        assert_eq!(kinds, [Kind::And, Kind::Quad, Kind::Row, Kind::Row]);
    }

    #[test]
    fn several_small_blanks_are_a_wide_one() {
        let kinds = |tex: &str| lex(tex).unwrap().iter().map(|token| token.kind).collect::<Vec<_>>();
        for wide in [
            r"\;\;\;",
            "~~~",
            r"\ \ ",
            r"\phantom{xx}",
            r"\hspace{1em}",
            r"\hskip 1em plus 1fil ",
            r"\hfill ",
            r"{\qquad}",
            r"{\quad\quad}",
        ] {
            assert!(kinds(&format!("a{wide}b")).contains(&Kind::Quad), "{wide}");
        }
        for small in [r"\,\;", "~", r"\phantom{}", r"\vphantom{x}"] {
            assert_eq!(kinds(&format!("a{small}b")).len(), 2, "{small}");
        }
    }

    #[test]
    fn what_prints_starts_and_ends_behind_all_blanks() {
        for blank in [
            r"\phantom{=}",
            r"\hphantom{{}={}}",
            r"\hspace{1cm}",
            r"\hspace*{1cm}",
            r"\hskip 1em",
            r"\hskip1em plus 1fil",
            r"\hfill",
            r"\enspace",
            r"\text{}",
            r"\mbox{ }",
            r"\mathrel{\phantom{=}}",
            r"\quad {}",
            r"& \,",
        ] {
            assert_eq!(printed(&format!("{blank} + b {blank}")), "+ b", "{blank}");
        }
        assert_eq!(printed(r"{} \left( a + b \right) \quad"), r"\left( a + b \right)");
        assert_eq!(printed(r"\quad \unknown + b \quad"), r"\unknown + b \quad");
        assert_eq!(printed(r"\quad"), "");
        assert!(lex(r"a \mathrel{R} b").is_err());
        for deep in [r"\mathrel{", r"\mathbf{", r"{\quad"] {
            let (levels, end) = (99_000 / deep.len(), "}".repeat(99_000 / deep.len()));
            assert!(lex(&deep.repeat(levels)).is_err() || !deep.contains("rel"), "{deep}");
            printed(&(deep.repeat(levels) + &end));
        }
    }

    #[test]
    fn letters_are_told_by_how_they_print() {
        let shown = |tex: &str| {
            letters(tex, &Names::default())
                .iter()
                .map(|(_, printed)| printed.clone())
                .collect::<Vec<_>>()
                .join(" ")
        };
        assert_eq!(
            shown(r"\mathbf{a} \cdot b + \boldsymbol\lambda c = \bm{\dot x}_k + \mathrm{m} \mathrm{d} x"),
            r"\mathbf{a} b \mathbf{\lambda} c \mathbf{x} k \mathrm{m} d x"
        );
        assert_eq!(shown(r"\phi \varphi φ ϕ"), r"\phi \varphi \varphi \phi");
    }

    #[test]
    fn refuses() {
        for tex in [
            r"\left. a",
            r"\left. a \right|",
            r"\left. a \right) _b",
            r"2 \boxed{a + b}",
            r"x^\boxed{ab}",
            r"\boxed{a} b",
            r"\underbrace{a + b}_{=0}",
            r"\underbrace{a + b}_{c}",
            r"a = b \therefore c = d",
            "a : b = c : d",
            r"\left a",
            r"\sim",
            r"\mathbb{N}",
            r"\mathbb",
            r"\mathbb{R",
            r"\left",
            r"\oint",
            "é",
            "√",
            r"\begin{cases}",
            r"\begin{align}",
            r"\end{align}",
            r"\label",
            r"\label{",
            r"\text{a b}",
            r"3 \text{ m}",
            "\\",
            r"\begin{align}\end{split}",
        ] {
            assert!(lex(tex).is_err(), "{tex}");
        }
    }
}
