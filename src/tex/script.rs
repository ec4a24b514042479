//! What hangs on a name or a bracket: subscripts, primes, marks and powers.

use super::error::{Fault, Reason};
use super::reader::Reader;
use super::subscript::{canonical, plain, subscript_text};
use super::token::{Bracket, Kind, Token};
use super::{At, Name, Tree};
use crate::number::{Field, Rational};
use num_traits::Zero;

/// The largest exponent that is read.
const HIGHEST: i32 = 1000;

/// What a superscript means.
pub(super) enum Superscript {
    Mark(String),
    Primes(u8),
    Power(Exponent),
}

/// A multiple of one half, held doubled.
#[derive(Clone, Copy)]
pub(super) struct Exponent {
    twice: i32,
    at: usize,
}

impl Exponent {
    /// `tree` to this power.
    pub(super) fn of(self, tree: Box<Tree>) -> Tree {
        let at = At(self.at);
        match (self.twice % 2 == 0, self.twice) {
            (true, twice) => Tree::Power(tree, twice / 2, at),
            (false, 1) => Tree::Root(tree, 2, at),
            (false, twice) => {
                let root = Tree::Root(tree, 2, at);
                Tree::Power(Box::new(root), twice, at)
            }
        }
    }

    /// Before an argument a negative power might mean the inverse function.
    pub(super) fn before_argument(self) -> Result<Self, Fault> {
        match self.twice < 0 {
            true => {
                let instead = "write the power behind brackets around the call, or the inverse function's own name";
                Err(Fault::ambiguous(self.at, "a negative power of a function", instead))
            }
            false => Ok(self),
        }
    }
}

impl<'a> Reader<'a> {
    /// The scripts that follow `name`: those that belong to it, and the power, if any.
    pub(super) fn scripts(&mut self, name: &mut Name) -> Result<Option<Exponent>, Fault> {
        let mut power: Option<Exponent> = None;
        while let Some(token) = self.peek() {
            let raised = power.is_some() || !name.mark.is_empty();
            match token.kind {
                Kind::Sub if name.subscript.is_empty() => name.subscript = self.subscript()?,
                Kind::Sub => return Err(double(token.at, "a second subscript")),
                Kind::Prime | Kind::Sup if raised => {
                    return Err(double(token.at, "a second superscript"));
                }
                Kind::Prime => {
                    self.next += 1;
                    name.primes = more_primes(name.primes, 1, token.at)?;
                }
                Kind::Sup => match self.superscript()? {
                    Superscript::Mark(mark) => name.mark = mark,
                    Superscript::Primes(n) => name.primes = more_primes(name.primes, n, token.at)?,
                    Superscript::Power(exponent) => power = Some(exponent),
                },
                _ => break,
            }
        }
        Ok(power)
    }

    /// The power that follows something that is no name.
    pub(super) fn power(&mut self) -> Result<Option<Exponent>, Fault> {
        let Some(token) = self.peek() else {
            return Ok(None);
        };
        let instead = "only a name may carry it";
        match token.kind {
            Kind::Sub => Err(Fault::unsupported(token.at, "a subscript on an expression", instead)),
            Kind::Prime => Err(Fault::unsupported(token.at, "a prime on an expression", instead)),
            Kind::Sup => match self.superscript()? {
                Superscript::Power(exponent) => match self.peek() {
                    Some(next) if matches!(next.kind, Kind::Sub | Kind::Sup | Kind::Prime) => {
                        Err(double(next.at, "a second script"))
                    }
                    _ => Ok(Some(exponent)),
                },
                _ => Err(Fault::unsupported(token.at, "a mark on an expression", instead)),
            },
            _ => Ok(None),
        }
    }

    fn subscript(&mut self) -> Result<String, Fault> {
        let (at, content) = self.script_tokens()?;
        let text = subscript_text(&content)?;
        let brackets = |open| text.matches(open).count();
        if brackets('(') != brackets(')') {
            return Err(Fault::unexpected(at, &text, "a plain subscript"));
        }
        match text.split(',').any(str::is_empty) {
            true => Err(Fault::unexpected(at, "nothing", "a subscript")),
            false => Ok(canonical(&text)),
        }
    }

    pub(super) fn superscript(&mut self) -> Result<Superscript, Fault> {
        let braced = self.look(1).is_some_and(|token| token.kind == Kind::BraceOpen);
        let (at, content) = self.script_tokens()?;
        let meaning = meaning(at, &content)?;
        if let (Superscript::Mark(_), false, Some(next)) = (&meaning, braced, self.peek())
            && next.kind == Kind::Number
        {
            let instead = "write ^{-2} for a power, \\cdot for a product";
            return Err(Fault::ambiguous(at, "a number right after a mark", instead));
        }
        Ok(meaning)
    }

    /// The tokens of the script whose `_` or `^` stands next: one, or those between braces.
    fn script_tokens(&mut self) -> Result<(usize, Vec<Token<'a>>), Fault> {
        let script = self.here();
        self.next += 1;
        let Some(token) = self.peek() else {
            return Err(self.instead_of("a script"));
        };
        match token.kind {
            Kind::BraceOpen => {
                let at = token.at;
                self.braced_tokens(at).map(|tokens| (at, tokens))
            }
            Kind::Number => {
                let digit = self.first_digit(token)?;
                Ok((digit.at, vec![digit]))
            }
            Kind::Letter | Kind::Word | Kind::Plus | Kind::Minus | Kind::Star | Kind::Prime => {
                self.next += 1;
                Ok((token.at, vec![token]))
            }
            _ => Err(Fault::unexpected(
                script.max(token.at),
                token.text,
                "a script (several signs need { })",
            )),
        }
    }

    fn braced_tokens(&mut self, open: usize) -> Result<Vec<Token<'a>>, Fault> {
        let (mut tokens, mut depth) = (Vec::new(), 0usize);
        while let Some(token) = self.peek() {
            self.next += 1;
            match token.kind {
                Kind::BraceOpen => depth += 1,
                Kind::BraceClose => depth = depth.saturating_sub(1),
                _ => {}
            }
            // Braces within a script group nothing that prints, but those of \frac tell its two parts.
            match token.kind {
                Kind::BraceClose if depth == 0 => return Ok(tokens),
                Kind::BraceOpen | Kind::BraceClose => {}
                _ => tokens.push(token),
            }
        }
        Err(Fault::unclosed(open, "{"))
    }

    /// Takes the first digit of `token`, the next one; what is left of it stays, marked as split.
    pub(super) fn first_digit(&mut self, token: Token<'a>) -> Result<Token<'a>, Fault> {
        let (Some(digit), Some(rest)) = (token.text.get(..1), token.text.get(1..)) else {
            return Err(self.instead_of("a digit"));
        };
        if digit == "." {
            return Err(self.instead_of("a digit"));
        }
        let after = token.at + 1;
        match (rest.is_empty(), self.tokens.get_mut(self.next)) {
            (false, Some(left)) => {
                left.text = rest;
                left.at = after;
                left.split = true;
            }
            _ => self.next += 1,
        }
        Ok(Token {
            text: digit,
            end: after,
            ..token
        })
    }
}

fn double(at: usize, found: &str) -> Fault {
    Fault::unsupported(at, found, "put brackets around what carries the first")
}

fn more_primes(primes: u8, more: u8, at: usize) -> Result<u8, Fault> {
    let most = usize::from(u8::MAX);
    primes.checked_add(more).ok_or(Fault::new(at, Reason::TooDeep { most }))
}

/// What the tokens of a superscript mean.
fn meaning(at: usize, content: &[Token<'_>]) -> Result<Superscript, Fault> {
    let kinds: Vec<Kind> = content.iter().map(|token| token.kind).collect();
    let text = || content.iter().map(plain).collect::<String>();
    match kinds.as_slice() {
        [] => Err(Fault::unexpected(at, "nothing", "a superscript")),
        [Kind::Minus | Kind::Plus | Kind::Star] | [Kind::Word] => Ok(Superscript::Mark(text())),
        [Kind::Open(Bracket::Round), Kind::Number, Kind::Close(Bracket::Round)] => Ok(Superscript::Mark(text())),
        [Kind::Prime, rest @ ..] if rest.iter().all(|kind| *kind == Kind::Prime) => {
            let primes = u8::try_from(kinds.len()).unwrap_or(u8::MAX);
            Ok(Superscript::Primes(more_primes(0, primes, at)?))
        }
        [Kind::Letter, Kind::Letter, ..] if content.iter().all(is_latin) => Ok(Superscript::Mark(text())),
        [Kind::Minus, ..] => exponent(at, content.get(1..).unwrap_or(&[]), true),
        [Kind::Plus, ..] => exponent(at, content.get(1..).unwrap_or(&[]), false),
        _ => exponent(at, content, false),
    }
}

fn is_latin(token: &Token<'_>) -> bool {
    token.kind == Kind::Letter && !token.text.starts_with('\\')
}

fn exponent(at: usize, content: &[Token<'_>], negative: bool) -> Result<Superscript, Fault> {
    let number = |text: &str| Rational::from_decimal(text).filter(|_| text.len() < 20);
    let kinds: Vec<Kind> = content.iter().map(|token| token.kind).collect();
    let texts: Vec<&str> = content.iter().map(|token| token.text).collect();
    let parts = match (kinds.as_slice(), texts.as_slice()) {
        ([Kind::Number], [above]) => Some((*above, "1")),
        ([Kind::Number, Kind::Slash, Kind::Number], [above, _, below]) => Some((*above, *below)),
        ([Kind::Fraction, Kind::Number, Kind::Number], [_, above, below]) => Some((*above, *below)),
        ([Kind::Fraction, Kind::Number], [_, both]) if both.len() == 2 => both.split_at_checked(1),
        _ => None,
    };
    let instead = "only numbers are read as powers, without brackets";
    let symbolic = || Fault::unsupported(at, "a symbolic power", instead);
    let (above, below) = parts.ok_or_else(symbolic)?;
    let values = number(above).zip(number(below));
    let range = || Fault::unsupported(at, "this power", "powers are multiples of 1/2 up to 1000");
    let twice = values
        .and_then(|(above, below)| doubled(&above, &below))
        .ok_or_else(range)?;
    let twice = if negative { -twice } else { twice };
    Ok(Superscript::Power(Exponent { twice, at }))
}

/// `2 above / below`, where that is an integer within bounds.
fn doubled(above: &Rational, below: &Rational) -> Option<i32> {
    if below.is_zero() {
        return None;
    }
    let half = below.clone() / Rational::from_integer(2);
    let twice = (above.clone() / half).to_integer()?;
    i32::try_from(twice).ok().filter(|twice| twice.abs() <= 2 * HIGHEST)
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn powers() {
        check(&[
            ("x^2", "(^ x 2)"),
            ("x^{-1}", "(^ x -1)"),
            ("x^{2}_k", "(^ x_k 2)"),
            ("x_k^2", "(^ x_k 2)"),
            ("{x}^2", "(^ x 2)"),
            ("(x)^2", "(^ x 2)"),
            ("{(a-b)}^2", "(^ (+ a (- b)) 2)"),
            ("x^{1/2}", "(sqrt x)"),
            (r"x^{\frac12}", "(sqrt x)"),
            (r"x^{-\frac{3}{2}}", "(^ (sqrt x) -3)"),
            ("x^{0.5}", "(sqrt x)"),
            ("x^{+2}", "(^ x 2)"),
            ("x^{1000}", "(^ x 1000)"),
            ("(Z_k^-)^2", "(^ Z_k^- 2)"),
            ("2^3", "(^ 2 3)"),
        ]);
        refuse(&[
            ("x^n", "symbolic power"),
            (r"x^{\alpha}", "symbolic power"),
            ("x^{(n+1)}", "symbolic power"),
            ("x^{2n}", "symbolic power"),
            ("x^{1001}", "up to 1000"),
            ("x^{1/3}", "multiples of 1/2"),
            ("x^{1/0}", "multiples of 1/2"),
            ("x^{99999999999999999999999}", "multiples of 1/2"),
            ("x^12", "write { }"),
            ("x^2^3", "second superscript"),
            ("(x)^2^3", "second script"),
            ("Z_k^{-}^2", "second superscript"),
            ("Z^-2", "write ^{-2}"),
            (r"\frac{a}{b}^2", "write brackets"),
            ("{a b}^2", "write brackets"),
            ("{x^2}^3", "write brackets"),
            ("x^{}", "`nothing`"),
            ("x^", "`the end`"),
            ("x^{2", "`{` is not closed"),
            ("(a)^-", "only a name"),
            ("(a)_k", "only a name"),
            ("(a)'", "only a name"),
        ]);
    }

    #[test]
    fn marks_and_primes() {
        check(&[
            ("Z_k^-", "Z_k^-"),
            ("Z^{-}_k", "Z_k^-"),
            (r"\mathbf{H}_k^*", "H_k^*"),
            (r"H_k^{\ast}", "H_k^*"),
            ("U_k^{imp}", "U_k^{imp}"),
            (r"U_k^{\mathrm{imp}}", "U_k^{imp}"),
            (r"U^{\text{T}}", r"U^{\text{T}}"),
            ("U^{(1)}", "U^{(1)}"),
            ("F_1'(t)", "<F_1' t>"),
            (r"F_1^{\prime}(t)", "<F_1' t>"),
            (r"f^\prime(t)", "<f' t>"),
            ("f''(t)", "<f'' t>"),
            (r"f^{\prime\prime}(t)", "<f'' t>"),
            ("f'^2(t)", "(^ <f' t> 2)"),
        ]);
        refuse(&[(&format!("f{}", "'".repeat(300)), "nested deeper")]);
    }
}
