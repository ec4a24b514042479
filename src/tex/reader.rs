//! TeX -> tree: equations, sums and products. Where TeX authors mean different things by one spelling, reading
//! fails and says what to write instead; nothing is guessed.

use super::error::{Fault, Reason};
use super::lexer::lex;
use super::part::{Form, Part, readable, starts_factor};
use super::statement::statements;
use super::token::{Bracket, Kind, Token};
use super::{At, Equation, Name, Names, ReadError, Tree};

/// The longest formula that is read, in bytes.
const LONGEST: usize = 100_000;
/// The deepest nesting that is read: it bounds the stack that reading and all later walks of the tree need.
const DEEPEST: usize = 200;

/// Reads the equations of a display, in order; a chain `a = b = c` gives `a = b` and `b = c`.
pub fn read(tex: &str, names: &Names) -> Result<Vec<Equation>, ReadError> {
    read_equations(tex, names).map_err(|fault| fault.located(tex))
}

/// Reads an expression, without an `=`.
pub fn read_expression(tex: &str, names: &Names) -> Result<Tree, ReadError> {
    let read = || {
        let mut reader = single(tex, names)?;
        let tree = reader.sum()?;
        reader.finish("the end of the expression").map(|()| tree)
    };
    read().map_err(|fault| fault.located(tex))
}

/// Reads one name, such as `\dot{Z}_{k+1}^-`, as a formula would hold it.
pub fn read_name(tex: &str, names: &Names) -> Result<Name, ReadError> {
    let read = || {
        let mut reader = single(tex, names)?;
        let name = reader.full_name()?;
        reader.finish("the end of the name").map(|()| name)
    };
    read().map_err(|fault| fault.located(tex))
}

fn read_equations(tex: &str, names: &Names) -> Result<Vec<Equation>, Fault> {
    let mut equations = Vec::new();
    for tokens in divided(tex)? {
        // Text taken from a PDF carries the number of the display along.
        if !equations.is_empty() && is_number_of_display(&tokens) {
            continue;
        }
        Reader::new(tokens, names).chain(&mut equations)?;
    }
    match equations.is_empty() {
        true => Err(Fault::new(0, Reason::NoEquation)),
        false => Ok(equations),
    }
}

/// `(23)` or `(20a)`.
fn is_number_of_display(tokens: &[Token<'_>]) -> bool {
    let kinds: Vec<Kind> = tokens.iter().map(|token| token.kind).take(5).collect();
    let (open, close) = (Kind::Open(Bracket::Round), Kind::Close(Bracket::Round));
    kinds == [open, Kind::Number, close] || kinds == [open, Kind::Number, Kind::Letter, close]
}

fn divided(tex: &str) -> Result<Vec<Vec<Token<'_>>>, Fault> {
    let (bytes, most) = (tex.len(), LONGEST);
    if bytes > most {
        return Err(Fault::new(0, Reason::TooLong { bytes, most }));
    }
    statements(lex(tex)?)
}

fn single<'a>(tex: &'a str, names: &'a Names) -> Result<Reader<'a>, Fault> {
    let mut all = divided(tex)?.into_iter();
    let Some(tokens) = all.next() else {
        return Err(Fault::unexpected(tex.trim_end().len(), "nothing", "a formula"));
    };
    match all.next().and_then(|more| more.first().copied()) {
        Some(token) => Err(Fault::unexpected(token.at, token.text, "the end")),
        None => Ok(Reader::new(tokens, names)),
    }
}

/// The tokens of one equation and how far they are read.
pub(super) struct Reader<'a> {
    pub(super) tokens: Vec<Token<'a>>,
    pub(super) next: usize,
    /// The byte offset behind the last token.
    end: usize,
    depth: usize,
    /// Slashes that follow a slash in their term: each deepens the tree without any nesting.
    divisions: usize,
    pub(super) names: &'a Names,
}

impl<'a> Reader<'a> {
    fn new(tokens: Vec<Token<'a>>, names: &'a Names) -> Self {
        let end = tokens.last().map_or(0, |token| token.end);
        Self {
            tokens,
            next: 0,
            end,
            depth: 0,
            divisions: 0,
            names,
        }
    }

    pub(super) fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.next).copied()
    }

    pub(super) fn peek_kind(&self) -> Option<Kind> {
        self.peek().map(|token| token.kind)
    }

    /// The token `ahead` of the next one.
    pub(super) fn look(&self, ahead: usize) -> Option<Token<'a>> {
        self.tokens.get(self.next + ahead).copied()
    }

    /// Where the next token stands.
    pub(super) fn here(&self) -> usize {
        self.peek().map_or(self.end, |token| token.at)
    }

    pub(super) fn take(&mut self, kind: Kind) -> Option<Token<'a>> {
        let token = self.peek().filter(|token| token.kind == kind)?;
        self.next += 1;
        Some(token)
    }

    /// The fault of finding the next token where `wanted` must stand.
    pub(super) fn instead_of(&self, wanted: &str) -> Fault {
        match self.peek() {
            Some(token) => Fault::unexpected(token.at, token.text, wanted),
            None => Fault::unexpected(self.end, "the end", wanted),
        }
    }

    pub(super) fn deepen(&mut self) -> Result<(), Fault> {
        self.depth += 1;
        let most = DEEPEST;
        match self.depth > most {
            true => Err(Fault::new(self.here(), Reason::TooDeep { most })),
            false => Ok(()),
        }
    }

    pub(super) fn rise(&mut self) {
        self.depth -= 1;
    }

    /// Skips `{}`, which authors put before a sign for its spacing.
    pub(super) fn skip_empty(&mut self) {
        while self.peek_kind() == Some(Kind::BraceOpen)
            && self.look(1).is_some_and(|token| token.kind == Kind::BraceClose)
        {
            self.next += 2;
        }
    }

    fn finish(&self, wanted: &str) -> Result<(), Fault> {
        match self.peek() {
            None => Ok(()),
            Some(token) if matches!(token.kind, Kind::Close(_) | Kind::BraceClose) => {
                let close = format!("`{}`", token.text);
                Err(Fault::new(token.at, Reason::Unopened { close }))
            }
            Some(_) => Err(self.instead_of(wanted)),
        }
    }

    /// `a = b = c`, appended to `equations`.
    fn chain(&mut self, equations: &mut Vec<Equation>) -> Result<(), Fault> {
        let mut at = self.here();
        let mut left = self.sum()?;
        if self.peek().is_none() {
            return Err(Fault::new(at, Reason::NoEquation));
        }
        while self.take(Kind::Equals).is_some() {
            let start = self.here();
            let right = self.sum()?;
            let end = self.look_back();
            let left = std::mem::replace(&mut left, right.clone());
            equations.push(Equation {
                left,
                right,
                at: At(at),
                end: At(end),
            });
            at = start;
        }
        self.finish("`=`, an operator or the end of the equation")
    }

    /// Where the token before the next one ends.
    fn look_back(&self) -> usize {
        let before = self.next.checked_sub(1).and_then(|last| self.tokens.get(last));
        before.map_or(0, |token| token.end)
    }

    /// A sum, up to what cannot belong to it.
    pub(super) fn sum(&mut self) -> Result<Tree, Fault> {
        self.sum_part().map(|part| part.tree)
    }

    pub(super) fn sum_part(&mut self) -> Result<Part, Fault> {
        self.deepen()?;
        let first = self.signed_term()?;
        self.skip_empty();
        let part = match self.peek_kind().is_some_and(is_sign) {
            true => self.more_terms(first)?,
            false => first,
        };
        self.rise();
        Ok(part)
    }

    fn more_terms(&mut self, first: Part) -> Result<Part, Fault> {
        let mut terms = vec![self.beside(first)?];
        while self.peek_kind().is_some_and(is_sign) {
            let term = self.signed_term()?;
            terms.push(self.beside(term)?);
            self.skip_empty();
        }
        Ok(Part {
            tree: Tree::Sum(terms),
            form: Form::Open,
        })
    }

    /// A term with the sign before it, if any.
    fn signed_term(&mut self) -> Result<Part, Fault> {
        self.skip_empty();
        let Some(kind) = self.peek_kind().filter(|kind| is_sign(*kind)) else {
            return self.term();
        };
        self.next += 1;
        self.no_sign("a sign")?;
        let term = self.term()?;
        let term = self.beside(term)?;
        let tree = match kind {
            Kind::Minus => Tree::Negate(Box::new(term)),
            Kind::PlusMinus => Tree::PlusMinus(Box::new(term)),
            Kind::MinusPlus => Tree::MinusPlus(Box::new(term)),
            _ => term,
        };
        let form = Form::Open;
        Ok(Part { tree, form })
    }

    fn no_sign(&mut self, before: &str) -> Result<(), Fault> {
        self.skip_empty();
        match self.peek() {
            Some(token) if is_sign(token.kind) => {
                let wanted = format!("a factor after {before} (a negative one needs brackets)");
                Err(Fault::unexpected(token.at, token.text, &wanted))
            }
            _ => Ok(()),
        }
    }

    /// The tree of `part`, if something may stand beside it.
    fn beside(&self, part: Part) -> Result<Tree, Fault> {
        match part.form {
            Form::Braced => {
                let instead = "TeX braces do not print; write ( ) around it";
                Err(Fault::ambiguous(
                    self.here(),
                    "a sum or quotient between braces",
                    instead,
                ))
            }
            _ => Ok(part.tree),
        }
    }

    /// Factors and divisors, from left to right.
    fn term(&mut self) -> Result<Part, Fault> {
        let first = self.factor()?;
        self.skip_empty();
        match self.peek_kind() {
            Some(kind) if is_operation(kind) || starts_factor(kind) => self.more_factors(first),
            _ => Ok(first),
        }
    }

    fn more_factors(&mut self, first: Part) -> Result<Part, Fault> {
        let mut form = first.form;
        let mut factors = vec![self.beside(first)?];
        let mut divided = false;
        while let Some(token) = self.peek() {
            let juxtaposed = starts_factor(token.kind);
            if !juxtaposed {
                if !is_operation(token.kind) {
                    break;
                }
                self.next += 1;
                self.no_sign(token.text)?;
            }
            let factor = self.factor()?;
            if juxtaposed {
                readable(form, &factor, token)?;
            }
            let by = factor.form;
            let tree = self.beside(factor)?;
            self.skip_empty();
            if token.kind == Kind::Slash {
                self.divisor(by, &tree, token.at, divided)?;
                let above = Box::new(product(factors));
                factors = vec![Tree::Quotient(above, Box::new(tree), At(token.at))];
                divided = true;
            } else {
                factors.push(tree);
            }
            form = by;
        }
        let form = if divided { Form::Open } else { Form::Knot };
        let tree = product(factors);
        Ok(Part { tree, form })
    }

    /// Refuses a divisor that does not show where it ends: `a/b c`.
    fn divisor(&mut self, form: Form, tree: &Tree, at: usize, again: bool) -> Result<(), Fault> {
        if again {
            self.divisions += 1;
            let most = DEEPEST;
            if self.divisions > most {
                return Err(Fault::new(at, Reason::TooDeep { most }));
            }
        }
        let whole = matches!(tree, Tree::Number(value) if value.0.is_int()) && form == Form::Literal;
        let instead = "write \\frac{..}{..}, or brackets around the divisor";
        match self.peek_kind() {
            // `x/\partial a/\partial b`
            _ if form == Form::Open => Err(Fault::ambiguous(at, "a slash in a divisor", instead)),
            Some(kind) if starts_factor(kind) && !whole => {
                Err(Fault::ambiguous(at, "a factor right after a divisor", instead))
            }
            _ => Ok(()),
        }
    }
}

fn product(mut factors: Vec<Tree>) -> Tree {
    match factors.len() {
        1 => factors.remove(0),
        _ => Tree::Product(factors),
    }
}

fn is_sign(kind: Kind) -> bool {
    matches!(kind, Kind::Plus | Kind::Minus | Kind::PlusMinus | Kind::MinusPlus)
}

fn is_operation(kind: Kind) -> bool {
    matches!(kind, Kind::Times | Kind::Star | Kind::Slash)
}
