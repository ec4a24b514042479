//! Factors: numbers, brackets, braces, fractions, roots and partial derivatives.

use super::error::Fault;
use super::part::{Form, Part, starts_factor};
use super::reader::Reader;
use super::symbol::raise;
use super::token::{Bracket, Kind, Token};
use super::{At, Name, Tree};
use crate::number::Rational;

/// The most digits of a number: exact arithmetic on longer ones would take noticeable time.
const LONGEST: usize = 1000;

const PARTNER: &str = "write \\frac{\\partial a}{\\partial b} with one name above and one below";

impl<'a> Reader<'a> {
    /// One factor, with the power it carries.
    pub(super) fn factor(&mut self) -> Result<Part, Fault> {
        self.skip_empty();
        let Some(token) = self.peek() else {
            return Err(self.instead_of("a factor"));
        };
        match token.kind {
            Kind::Letter | Kind::Word | Kind::Accent => self.named(token),
            Kind::BraceOpen => self.group(token.at),
            Kind::Function => {
                let function = super::command::elementary(token.text);
                let function = function.ok_or_else(|| self.instead_of("a function"))?;
                self.elementary(function)
            }
            Kind::Invariant(kind) => self.invariant(kind, 1),
            Kind::Number => self.number(token),
            Kind::Open(_) => {
                let tree = self.bracketed()?;
                self.carried(tree, Form::Bracketed)
            }
            Kind::Fraction => self.fraction(token),
            Kind::Root => self.root(token),
            Kind::Partial => self.flat_partial(token),
            _ => Err(self.instead_of("a factor")),
        }
    }

    /// `tree` with the power that follows it, if `form` may carry one.
    fn carried(&mut self, tree: Tree, form: Form) -> Result<Part, Fault> {
        let at = self.here();
        let power = self.power()?;
        match (power, form) {
            (None, _) => Ok(Part { tree, form }),
            (Some(_), Form::Literal | Form::Plain | Form::Bracketed) => Ok(raise(tree, power)),
            (Some(_), _) => {
                let instead = "write brackets around what is raised";
                Err(Fault::ambiguous(at, "a power of something without brackets", instead))
            }
        }
    }

    fn number(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        if token.split {
            let instead = "write { } around all that belongs to the script or argument";
            return Err(Fault::ambiguous(token.at, "this digit", instead));
        }
        self.next += 1;
        let tree = Tree::Number(value(token)?);
        self.carried(tree, Form::Literal)
    }

    /// `{..}`: braces do not print, so what they hold must stand for itself.
    fn group(&mut self, at: usize) -> Result<Part, Fault> {
        self.next += 1;
        let part = self.sum_part()?;
        self.close_brace(at)?;
        match (part.tree, part.form) {
            (Tree::Symbol(name, at), Form::Plain) => self.symbol(name, at.0),
            (tree, Form::Open) => self.carried(tree, Form::Braced),
            (tree, form) => self.carried(tree, form),
        }
    }

    /// What a command such as `\sqrt` takes: a group, a digit or a letter.
    fn argument(&mut self) -> Result<Tree, Fault> {
        let Some(token) = self.peek() else {
            return Err(self.instead_of("an argument in { }"));
        };
        match token.kind {
            Kind::BraceOpen => {
                self.next += 1;
                if self.peek_kind() == Some(Kind::BraceClose) {
                    return Err(self.instead_of("an argument"));
                }
                let tree = self.sum()?;
                self.close_brace(token.at).map(|()| tree)
            }
            Kind::Number => {
                let digit = self.first_digit(token)?;
                value(digit).map(Tree::Number)
            }
            Kind::Letter => {
                self.next += 1;
                let base = token.text.to_owned();
                let name = Name {
                    base,
                    ..Name::default()
                };
                Ok(Tree::Symbol(name, At(token.at)))
            }
            _ => Err(self.instead_of("an argument in { }")),
        }
    }

    fn fraction(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        let partial = self.look(1).is_some_and(|token| token.kind == Kind::Partial);
        if partial && self.peek_kind() == Some(Kind::BraceOpen) {
            let tree = self.stacked_partial(token.at)?;
            return self.carried(tree, Form::Fraction);
        }
        let above = Box::new(self.argument()?);
        let below = Box::new(self.argument()?);
        self.carried(Tree::Quotient(above, below, At(token.at)), Form::Fraction)
    }

    fn root(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        let index = |reader: &Self, ahead: usize| reader.look(ahead).map(|token| token.text);
        if self.peek_kind() == Some(Kind::Open(Bracket::Square)) {
            match (index(self, 1), index(self, 2)) {
                (Some("2"), Some("]")) => self.next += 3,
                _ => {
                    return Err(Fault::unsupported(token.at, "this root", "only square roots are read"));
                }
            }
        }
        let radicand = Box::new(self.argument()?);
        self.carried(Tree::Root(radicand, At(token.at)), Form::Plain)
    }

    /// `\frac{\partial a}{\partial b}` or `\frac{\partial}{\partial b} a`, after its command.
    fn stacked_partial(&mut self, at: usize) -> Result<Tree, Fault> {
        let above = self.here();
        self.next += 1;
        self.partial_sign()?;
        let of = match self.peek_kind() {
            Some(Kind::BraceClose) => None,
            _ => Some(self.full_name()?),
        };
        self.close_brace(above)?;
        let below = self.here();
        if self.take(Kind::BraceOpen).is_none() {
            return Err(self.instead_of("`{`"));
        }
        self.partial_sign()?;
        let by = self.full_name()?;
        if self.peek_kind() == Some(Kind::Partial) {
            return Err(Fault::unsupported(self.here(), "a second derivative", PARTNER));
        }
        self.close_brace(below)?;
        let of = match of {
            Some(of) => of,
            None => self.operand()?,
        };
        let at = At(at);
        Ok(Tree::Partial { of, by, at })
    }

    /// The name behind `\frac{\partial}{\partial b}`, perhaps in brackets.
    fn operand(&mut self) -> Result<Name, Fault> {
        match self.open() {
            Some((open, kind)) => {
                let name = self.full_name()?;
                self.close(open, kind).map(|()| name)
            }
            None => self.full_name(),
        }
    }

    /// `\partial a/\partial b`.
    fn flat_partial(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.partial_sign()?;
        let of = self.full_name()?;
        if self.take(Kind::Slash).is_none() {
            return Err(Fault::unsupported(token.at, "\\partial alone", PARTNER));
        }
        self.partial_sign()?;
        let by = self.full_name()?;
        self.skip_empty();
        if self.peek_kind().is_some_and(starts_factor) {
            let instead = "write \\frac{\\partial ..}{\\partial ..}, or brackets around it";
            return Err(Fault::ambiguous(self.here(), "a factor right after a divisor", instead));
        }
        let at = At(token.at);
        // As a quotient with a slash, it is no base of a power and no content of bare braces.
        let tree = Tree::Partial { of, by, at };
        let form = Form::Open;
        Ok(Part { tree, form })
    }

    /// Takes a `\partial` of first order.
    fn partial_sign(&mut self) -> Result<(), Fault> {
        let Some(token) = self.take(Kind::Partial) else {
            return Err(self.instead_of("\\partial"));
        };
        match self.peek_kind() {
            Some(Kind::Sup | Kind::Sub) => Err(Fault::unsupported(
                token.at,
                "a derivative of higher order or with a script",
                PARTNER,
            )),
            _ => Ok(()),
        }
    }
}

fn value(token: Token<'_>) -> Result<Rational, Fault> {
    if token.text.len() > LONGEST {
        return Err(Fault::unsupported(
            token.at,
            "so long a number",
            "at most 1000 digits are read",
        ));
    }
    let unreadable = || Fault::unreadable(token.at, token.text, "");
    Rational::from_decimal(token.text).ok_or_else(unreadable)
}
