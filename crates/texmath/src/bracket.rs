//! Brackets that print, braces that do not, and their partners.

use super::command::{ABSOLUTE, FLOOR};
use super::error::{Fault, Reason};
use super::reader::Reader;
use super::token::{Bracket, Kind, Token};
use super::{At, Name, Operation, Tree};

impl<'a> Reader<'a> {
    /// The content of the visible bracket that stands next, and its place.
    pub(super) fn bracketed(&mut self) -> Result<Box<Tree>, Fault> {
        let Some((open, kind)) = self.open() else {
            return Err(self.instead_of("a bracket"));
        };
        let tree = self.sum()?;
        self.close(open, kind).map(|()| tree)
    }

    /// Reads what stands in brackets behind the name of a function: one formula, or several with commas between.
    pub(super) fn arguments(&mut self) -> Result<Box<Tree>, Fault> {
        let Some((open, kind)) = self.open() else {
            return Err(self.instead_of("a bracket"));
        };
        let first = self.sum()?;
        let mut several = vec![*first];
        self.skip_empty();
        while self.take(Kind::Comma).is_some() {
            several.push(*self.sum()?);
            self.skip_empty();
        }
        self.close(open, kind)?;
        Ok(Box::new(match several.len() {
            1 => several.remove(0),
            _ => Tree::Operation(Box::new(Operation::Arguments(several)), At(open.at)),
        }))
    }

    /// The absolute value, or the Euclidean norm, whose opening bar stands next.
    pub(super) fn absolute_value(&mut self, open: Token<'a>, bar: Bracket) -> Result<Box<Tree>, Fault> {
        self.next += 1;
        let argument = self.sum()?;
        self.close(open, bar)?;
        // `\|x\|_2`
        let is_two = |token: &Token<'_>| token.kind == Kind::Number && token.text == "2";
        if bar == Bracket::DoubleBar
            && self.peek_kind() == Some(Kind::Sub)
            && self.look(1).is_some_and(|token| is_two(&token))
        {
            self.next += 2;
        }
        Ok(Box::new(Tree::Call(Name::plain(ABSOLUTE), argument, At(open.at))))
    }

    /// The largest integer up to a number, or the least one from it on, whose opening bracket stands next.
    pub(super) fn rounded(&mut self, open: Token<'a>, kind: Bracket) -> Result<Box<Tree>, Fault> {
        self.next += 1;
        let argument = self.sum()?;
        self.close(open, kind)?;
        let floor = |of: Box<Tree>| Box::new(Tree::Call(Name::plain(FLOOR), of, At(open.at)));
        Ok(match kind {
            Bracket::Floor => floor(argument),
            _ => Box::new(Tree::Negate(floor(Box::new(Tree::Negate(argument))))),
        })
    }

    /// Takes an opening bracket of any kind but a bar or what holds rows.
    pub(super) fn open(&mut self) -> Option<(Token<'a>, Bracket)> {
        let token = self.peek()?;
        let Kind::Open(kind) = token.kind else {
            return None;
        };
        if matches!(
            kind,
            Bracket::Bar | Bracket::DoubleBar | Bracket::Floor | Bracket::Ceiling | Bracket::Rows(_)
        ) {
            return None;
        }
        self.next += 1;
        Some((token, kind))
    }

    /// Takes the bracket that closes `open`.
    pub(super) fn close(&mut self, open: Token<'a>, kind: Bracket) -> Result<(), Fault> {
        self.skip_empty();
        match self.peek() {
            Some(token) if token.kind == Kind::Close(kind) => {
                self.next += 1;
                Ok(())
            }
            Some(token) if matches!(token.kind, Kind::Close(_)) => {
                let (open, close) = (format!("`{}`", open.text), format!("`{}`", token.text));
                Err(Fault::new(token.at, Reason::Mismatched { open, close }))
            }
            Some(token) if matches!(token.kind, Kind::Sub | Kind::Sup | Kind::Comma | Kind::Relation(_)) => {
                let wanted = format!("a closing bracket for `{}`", open.text);
                Err(Fault::unexpected(token.at, token.text, &wanted))
            }
            _ => Err(Fault::unclosed(open.at, open.text)),
        }
    }

    /// Takes the `}` that closes the `{` at `open`.
    pub(super) fn close_brace(&mut self, open: usize) -> Result<(), Fault> {
        self.skip_empty();
        match self.peek() {
            None => Err(Fault::unclosed(open, "{")),
            Some(token) if token.kind == Kind::BraceClose => {
                self.next += 1;
                Ok(())
            }
            Some(token) => Err(Fault::unexpected(token.at, token.text, "`}`")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn brackets_match() {
        check(&[(
            r"\left[ \{ a - 1 \rbrace c + \lbrack b + 1 \rbrack \right]",
            "(+ (* (+ a (- 1)) c) (+ b 1))",
        )]);
        for single in [r"\lbrack a \rbrack", r"\{ 2 a \}", "[-a]"] {
            refuse(&[(&format!("b + {single}"), "a single term in")]);
        }
        check(&[("[a b]^2", "(^ (* a b) 2)")]);
        refuse(&[
            ("a (b + c", "column 3: `(` is not closed"),
            ("a + b)", "column 6: `)` closes nothing"),
            ("(a]", "`(` is closed by `]`"),
            ("(a, b)", "a closing bracket for `(`"),
            ("{a", "`{` is not closed"),
            ("a}", "`}` closes nothing"),
            ("(a}", "`(` is not closed"),
            ("()", "where a factor"),
        ]);
    }
}
