//! Names, with their accents and scripts, and what a bracket after one makes of it.

use super::command::{elementary, elementary_at_start, invariant};
use super::error::{Fault, Reason};
use super::part::{Form, Part, starts_factor};
use super::reader::Reader;
use super::script::Exponent;
use super::token::{Bracket, Kind, Token};
use super::{At, Invariant, Name, Tree};

impl<'a> Reader<'a> {
    /// A name with all its scripts, which must not be a power.
    pub(super) fn full_name(&mut self) -> Result<Name, Fault> {
        let mut name = self.bare_name()?;
        let at = self.here();
        match self.scripts(&mut name)? {
            None => Ok(name),
            Some(_) => Err(Fault::unsupported(at, "a power here", "a name alone must stand here")),
        }
    }

    /// A name with its accents, before the scripts that follow; braces around it are dropped.
    pub(super) fn bare_name(&mut self) -> Result<Name, Fault> {
        let Some(token) = self.peek() else {
            return Err(self.instead_of("a name"));
        };
        match token.kind {
            Kind::Letter => Ok(self.run(token)?),
            Kind::Word => {
                self.next += 1;
                self.word(token)
            }
            Kind::Accent => self.accented(token),
            Kind::BraceOpen => {
                self.next += 1;
                self.deepen()?;
                let name = self.full_name()?;
                self.rise();
                self.close_brace(token.at).map(|()| name)
            }
            _ => Err(self.instead_of("a name")),
        }
    }

    fn accented(&mut self, accent: Token<'a>) -> Result<Name, Fault> {
        self.next += 1;
        self.deepen()?;
        let mut name = match self.peek() {
            // TeX takes one letter where there are no braces, whatever word it begins.
            Some(token) if token.kind == Kind::Letter => {
                self.next += 1;
                base(token.text)
            }
            _ => self.bare_name()?,
        };
        self.rise();
        name.accents.push(accent.text.to_owned());
        Ok(name)
    }

    /// The name at the start of a run of letters: a declared word, or one letter.
    fn run(&mut self, first: Token<'a>) -> Result<Name, Fault> {
        let run = self.letters(true);
        if let Some(word) = self.names.word_at_start(&run).map(str::to_owned) {
            self.next += word.len();
            return Ok(base(&word));
        }
        if let Some(function) = elementary_at_start(&run) {
            let instead = "write it with a backslash, or its letters apart for a product";
            let found = function.trim_start_matches('\\');
            return Err(Fault::ambiguous(first.at, &format!("`{found}`"), instead));
        }
        self.next += 1;
        Ok(base(first.text))
    }

    /// The Latin letters that stand next; where `close`, only up to the first gap.
    fn letters(&self, close: bool) -> String {
        let mut run = String::new();
        let mut end = None;
        // No word is longer; without this bound a long run would be walked once for each of its letters.
        for token in self.tokens.iter().skip(self.next).take(64) {
            let gap = close && end.is_some_and(|end| end != token.at);
            if token.kind != Kind::Letter || token.text.starts_with('\\') || gap {
                break;
            }
            run.push_str(token.text);
            end = Some(token.end);
        }
        run
    }

    fn word(&self, token: Token<'a>) -> Result<Name, Fault> {
        match token.text.len() == 1 || self.names.words.iter().any(|word| word == token.text) {
            true => Ok(base(token.text)),
            false => {
                let found = format!("`{}`", token.text);
                Err(Fault::new(token.at, Reason::UnknownWord { found }))
            }
        }
    }

    /// What begins with a letter, a word or an accent: a symbol, a call, a trace or an elementary function.
    pub(super) fn named(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        if token.kind == Kind::Word {
            if let Some(kind) = invariant(token.text) {
                return self.invariant(kind, 1);
            }
            if let Some(function) = elementary(token.text) {
                return self.elementary(function);
            }
        }
        if let Some((kind, length)) = self.plain_invariant() {
            return self.invariant(kind, length);
        }
        let name = self.bare_name()?;
        self.symbol(name, token.at)
    }

    /// `name` with the scripts and the argument that follow it.
    pub(super) fn symbol(&mut self, mut name: Name, at: usize) -> Result<Part, Fault> {
        let power = self.scripts(&mut name)?;
        match self.peek_kind() {
            Some(Kind::Open(kind)) if self.names.is_function(&name) => {
                self.argument_bracket(kind)?;
                let argument = Box::new(self.bracketed()?);
                self.call(Tree::Call(name, argument, At(at)), power)
            }
            _ => Ok(raise(Tree::Symbol(name, At(at)), power)),
        }
    }

    /// A finished call: the power before its argument, or the one behind.
    fn call(&mut self, call: Tree, before: Option<Exponent>) -> Result<Part, Fault> {
        let before = before.map(Exponent::before_argument).transpose()?;
        let at = self.here();
        match (before, self.power()?) {
            (Some(_), Some(_)) => Err(Fault::unsupported(
                at,
                "a second power of one call",
                "put brackets around the first",
            )),
            (power, None) | (None, power) => Ok(raise(call, power)),
        }
    }

    fn argument_bracket(&self, kind: Bracket) -> Result<(), Fault> {
        match kind {
            Bracket::Curly => {
                let instead = "an argument stands in ( ) or [ ]; write \\cdot for a product";
                Err(Fault::ambiguous(self.here(), "\\{ after a function", instead))
            }
            _ => Ok(()),
        }
    }

    /// An elementary function, whose name stands next.
    pub(super) fn elementary(&mut self, function: &'static str) -> Result<Part, Fault> {
        let at = self.here();
        self.next += 1;
        let power = match self.peek_kind() {
            Some(Kind::Sup | Kind::Sub | Kind::Prime) => self.power()?,
            _ => None,
        };
        let argument = match self.peek_kind() {
            Some(Kind::Open(kind)) => {
                self.argument_bracket(kind)?;
                self.bracketed()?
            }
            _ => {
                let argument = self.bare_argument()?;
                let call = Tree::Call(base(function), Box::new(argument), At(at));
                return Ok(raise(call, power.map(Exponent::before_argument).transpose()?));
            }
        };
        self.call(Tree::Call(base(function), Box::new(argument), At(at)), power)
    }

    /// The argument of `\cos\theta`: it must be plain that it is no more than one symbol, number or fraction.
    fn bare_argument(&mut self) -> Result<Tree, Fault> {
        self.deepen()?;
        let at = self.here();
        let brackets = || {
            let instead = "write brackets around the argument";
            Fault::ambiguous(at, "an argument without brackets", instead)
        };
        match self.peek_kind() {
            Some(kind) if starts_factor(kind) && kind != Kind::Function => {}
            _ => return Err(self.instead_of("the argument of the function")),
        }
        let part = self.factor()?;
        self.rise();
        let atom = match part.form {
            Form::Literal | Form::Fraction | Form::Bracketed => true,
            Form::Plain => matches!(part.tree, Tree::Symbol(..)),
            _ => false,
        };
        self.skip_empty();
        let more = self
            .peek_kind()
            .is_some_and(|kind| starts_factor(kind) || kind == Kind::Slash);
        match atom && !more {
            true => Ok(part.tree),
            false => Err(brackets()),
        }
    }

    /// Whether `Tr(`, `det^2[` and their like stand next, in letters: which, and how many letters.
    fn plain_invariant(&self) -> Option<(Invariant, usize)> {
        let run = self.letters(true);
        let fits = |length: &usize| run.get(..*length).and_then(invariant).is_some();
        let length = [3, 2].into_iter().find(fits)?;
        let kind = run.get(..length).and_then(invariant)?;
        self.bracket_follows(length).then_some((kind, length))
    }

    /// Whether a bracket stands behind the next `skip` tokens and, perhaps, a power.
    fn bracket_follows(&self, skip: usize) -> bool {
        let mut ahead = skip;
        if self.look(ahead).is_some_and(|token| token.kind == Kind::Sup) {
            let braced = self.look(ahead + 1).is_some_and(|token| token.kind == Kind::BraceOpen);
            // A power is short; looking further would make long input slow.
            let close = (2..12).find(|more| {
                self.look(ahead + more)
                    .is_some_and(|token| token.kind == Kind::BraceClose)
            });
            ahead += match (braced, close) {
                (true, Some(close)) => close + 1,
                (true, None) => return false,
                (false, _) => 2,
            };
        }
        let after = self.look(ahead).map(|token| token.kind);
        matches!(after, Some(Kind::Open(Bracket::Round | Bracket::Square)))
    }

    /// A trace or determinant, whose name is the next `length` tokens.
    pub(super) fn invariant(&mut self, kind: Invariant, length: usize) -> Result<Part, Fault> {
        let at = self.here();
        self.next += length;
        let power = match self.peek_kind() {
            Some(Kind::Sup | Kind::Sub | Kind::Prime) => self.power()?,
            _ => None,
        };
        let of = match self.open() {
            Some((open, bracket)) => {
                let name = self.matrix()?;
                // `DP(H_k)` says where the matrix is taken; the name alone matters.
                if let Some(Kind::Open(Bracket::Round | Bracket::Square)) = self.peek_kind() {
                    self.bracketed()?;
                }
                self.close(open, bracket)?;
                name
            }
            None => self.matrix()?,
        };
        let at = At(at);
        self.call(Tree::Invariant { kind, of, at }, power)
    }

    /// The name of a declared matrix.
    fn matrix(&mut self) -> Result<Name, Fault> {
        let at = self.here();
        let letters = self.letters(false);
        let mut name = match (letters.is_empty(), self.take(Kind::Word)) {
            (false, _) => {
                self.next += letters.len();
                base(&letters)
            }
            (true, Some(word)) => base(word.text),
            (true, None) => self.bare_name()?,
        };
        let power = self.scripts(&mut name)?;
        if power.is_none() && self.names.matrices.contains(&name) {
            return Ok(name);
        }
        let known: Vec<String> = self.names.matrices.iter().map(Name::to_string).collect();
        let known = known.join(", ");
        let found = format!("`{name}`");
        Err(Fault::new(at, Reason::UnknownMatrix { found, known }))
    }
}

/// The name that is `text` alone.
fn base(text: &str) -> Name {
    Name {
        base: text.to_owned(),
        ..Name::default()
    }
}

/// `tree` to `power`.
pub(super) fn raise(tree: Tree, power: Option<Exponent>) -> Part {
    match power {
        Some(exponent) => Part {
            tree: exponent.of(tree),
            form: Form::Knot,
        },
        None => Part {
            tree,
            form: Form::Plain,
        },
    }
}
