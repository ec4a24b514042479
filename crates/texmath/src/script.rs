//! What hangs on a name or a bracket: subscripts, primes, marks and powers.

use super::error::{Fault, Reason};
use super::exponent::Exponent;
use super::part::{Form, Part};
use super::reader::Reader;
use super::subscript::{canonical, plain, subscript_text};
use super::token::{Bracket, Kind, Token};
use super::{At, Name, Tree};
use numbers::{Field, Rational};

/// The most tokens of a mark.
const LONGEST_MARK: usize = 64;

/// Symbols that a degree sign makes an angle of; behind others, as in `E^\circ`, it may be a mark.
const ANGLES: &[&str] = &[
    "x",
    "\\alpha",
    "\\beta",
    "\\gamma",
    "\\theta",
    "\\vartheta",
    "\\phi",
    "\\psi",
];

/// What a superscript means.
pub(super) enum Superscript {
    Mark(String),
    Primes(u8),
    Power(Exponent),
}

impl<'a> Reader<'a> {
    /// The scripts that follow `name`: those that belong to it, and the power, if any.
    pub(super) fn scripts(&mut self, name: &mut Name) -> Result<Option<Exponent>, Fault> {
        let mut power: Option<Exponent> = None;
        while let Some(token) = self.peek() {
            if self.degree_sign() > 0 {
                break;
            }
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
                Kind::Sup => match self.superscript(Some(name))? {
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
            Kind::Sup => match self.superscript(None)? {
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

    /// Takes the subscript that stands next into `name`.
    pub(super) fn subscripts(&mut self, name: &mut Name) -> Result<(), Fault> {
        name.subscript = self.subscript()?;
        Ok(())
    }

    /// The number of tokens of the degree sign that stands next; 0 where none does.
    fn degree_sign(&self) -> usize {
        let kind = |ahead: usize| self.look(ahead).map(|token| token.kind);
        let (raised, degree) = (kind(0) == Some(Kind::Sup), Some(Kind::Degree));
        match self.peek() {
            Some(_) if raised && kind(1) == degree => 2,
            Some(_)
                if raised && [kind(1), kind(2), kind(3)] == [Some(Kind::BraceOpen), degree, Some(Kind::BraceClose)] =>
            {
                4
            }
            // this alone is the sign of a composition
            Some(sign) if sign.text != "\\circ" => usize::from(sign.kind == Kind::Degree),
            _ => 0,
        }
    }

    /// A number or a symbol with the degree sign that may follow it: 18° is 18 \pi/180.
    pub(super) fn in_degrees(&mut self, part: Part) -> Result<Part, Fault> {
        let (at, length) = (self.here(), self.degree_sign());
        if length == 0 {
            return Ok(part);
        }
        self.next += length;
        let shown = part.tree.to_string();
        let is_angle = match &*part.tree {
            Tree::Symbol(name, _) => ANGLES.iter().any(|angle| *name == Name::plain(angle)),
            tree => matches!(tree, Tree::Number(_)),
        };
        let is_unit = |token: Token<'_>| token.kind == Kind::Number || matches!(token.text, "C" | "F" | "K");
        let of = Tree::Product(vec![*part.tree, Tree::Symbol(Name::plain("\\pi"), At(at))]);
        let half_turn = Tree::Number(Rational::from_integer(180));
        let angle = Tree::Quotient(Box::new(of), Box::new(half_turn), At(at));
        if self.first_printed().is_some_and(is_unit) {
            let instead = "write \\cdot for a product; neither temperatures nor minutes of arc are read";
            return Err(Fault::ambiguous(at, "what follows this degree sign", instead));
        }
        match is_angle {
            true => Ok(Part {
                tree: Box::new(angle),
                form: Form::Knot,
            }),
            false => {
                let mark = format!("{shown}^{{\\text{{o}}}}");
                Err(Fault::two_readings(at, "this degree sign", &angle.to_string(), &mark))
            }
        }
    }

    fn subscript(&mut self) -> Result<String, Fault> {
        if let Some(sign) = self
            .look(1)
            .filter(|sign| matches!(sign.kind, Kind::Infinity | Kind::Extremum))
        {
            self.next += 2;
            return Ok(plain(&sign).to_owned());
        }
        let (at, content) = self.script_tokens(usize::MAX)?;
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

    /// The superscript that stands next, on a name or on an expression.
    fn superscript(&mut self, on: Option<&Name>) -> Result<Superscript, Fault> {
        let braced = self.look(1).is_some_and(|token| token.kind == Kind::BraceOpen);
        let start = self.next;
        let (at, content) = self.script_tokens(LONGEST_MARK)?;
        let Some(meaning) = self.meaning(at, &content, on)? else {
            self.next = start + 1;
            return self.exponent(at).map(Superscript::Power);
        };
        if let (Superscript::Mark(_), false, Some(next)) = (&meaning, braced, self.peek())
            && next.kind == Kind::Number
        {
            let instead = "write ^{-2} for a power, \\cdot for a product";
            return Err(Fault::ambiguous(at, "a number right after a mark", instead));
        }
        Ok(meaning)
    }

    /// What the tokens of a superscript mean; `None` if they are an expression.
    fn meaning(&self, at: usize, content: &[Token<'_>], on: Option<&Name>) -> Result<Option<Superscript>, Fault> {
        let kinds: Vec<Kind> = content.iter().map(|token| token.kind).collect();
        let text = || content.iter().map(plain).collect::<String>();
        let mark = || Ok(Some(Superscript::Mark(text())));
        // The base of the exponential function carries no marks.
        let name = on.filter(|name| **name != Name::plain("e"));
        match (kinds.as_slice(), name) {
            ([], _) => Err(Fault::unexpected(at, "nothing", "a superscript")),
            ([Kind::Minus | Kind::Plus | Kind::Star] | [Kind::Word], _) => mark(),
            ([Kind::Open(Bracket::Round), Kind::Number, Kind::Close(Bracket::Round)], _) => mark(),
            ([Kind::Prime, rest @ ..], _) if rest.iter().all(|kind| *kind == Kind::Prime) => {
                let primes = u8::try_from(kinds.len()).unwrap_or(u8::MAX);
                Ok(Some(Superscript::Primes(more_primes(0, primes, at)?)))
            }
            ([Kind::Plus, Kind::Number], Some(name))
                if !(name.subscript.is_empty() && name.accents.is_empty()) || self.names.is_function(name) =>
            {
                let instead = "write ^2, or (v_k^+)^2 for the square of the value just after an impact";
                Err(Fault::ambiguous(at, "a plus sign before a power", instead))
            }
            ([Kind::Letter], Some(name)) if content.iter().all(|token| token.styled) => {
                Err(two_superscripts(at, name, &format!("\\text{{{}}}", text()), &text()))
            }
            ([Kind::Letter, Kind::Letter, ..], Some(name)) if is_run(content) => {
                let text = text();
                if text.len() > 2 && self.names.word_at_start(&text) != Some(&text) {
                    return mark();
                }
                let power = match self.names.word_at_start(&text) == Some(&text) {
                    true => format!("+{text}"),
                    false => text.chars().map(String::from).collect::<Vec<_>>().join(" "),
                };
                Err(two_superscripts(at, name, &format!("\\text{{{text}}}"), &power))
            }
            (
                [
                    Kind::Open(Bracket::Round),
                    Kind::Number,
                    Kind::Close(Bracket::Round),
                    _,
                    ..,
                ],
                Some(_),
            ) => {
                let instead = "write (x^{(1)})^2 for a power of what carries an index";
                Err(Fault::ambiguous(
                    at,
                    "a superscript behind an index in brackets",
                    instead,
                ))
            }
            (
                [Kind::Open(Bracket::Round), inner @ .., Kind::Close(Bracket::Round)]
                | [Kind::Open(Bracket::Square), inner @ .., Kind::Close(Bracket::Square)],
                Some(_),
            ) if is_closed(inner) => {
                let instead = "write ^{n} for a power; an index in brackets is read only if it is a number";
                Err(Fault::ambiguous(at, "a superscript in brackets", instead))
            }
            _ => Ok(Exponent::of_number(at, content)?.map(Superscript::Power)),
        }
    }

    /// The tokens of the script whose `_` or `^` stands next: one, or those between braces, of more than `most` only
    /// the first.
    fn script_tokens(&mut self, most: usize) -> Result<(usize, Vec<Token<'a>>), Fault> {
        let script = self.here();
        self.next += 1;
        let Some(token) = self.peek() else {
            return Err(self.instead_of("a script"));
        };
        match token.kind {
            Kind::BraceOpen => {
                let at = token.at;
                self.braced_tokens(at, most).map(|tokens| (at, tokens))
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

    /// The tokens between braces; of more than `most` only the first.
    fn braced_tokens(&mut self, open: usize, most: usize) -> Result<Vec<Token<'a>>, Fault> {
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
            if tokens.len() > most {
                return Ok(tokens);
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

/// The fault of a superscript that is a mark of `name` or a power of it.
fn two_superscripts(at: usize, name: &Name, mark: &str, power: &str) -> Fault {
    let [mark, power] = [mark, power].map(|script| format!("{name}^{{{script}}}"));
    Fault::two_readings(at, "this superscript", &mark, &power)
}

/// Whether these are Latin letters without a gap.
fn is_run(content: &[Token<'_>]) -> bool {
    let latin = |token: &Token<'_>| token.kind == Kind::Letter && !token.text.starts_with('\\');
    let close = content.windows(2).all(|pair| matches!(pair, [a, b] if a.end == b.at));
    close && content.iter().all(latin)
}

/// Whether no bracket closes that did not open among these.
fn is_closed(kinds: &[Kind]) -> bool {
    let mut depth = 0usize;
    kinds.iter().all(|kind| {
        match kind {
            Kind::Open(_) => depth += 1,
            Kind::Close(_) if depth == 0 => return false,
            Kind::Close(_) => depth -= 1,
            _ => {}
        }
        true
    })
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
        for tex in [
            r"A^\mathrm{T}",
            r"A^{\mathsf T}",
            r"A^\text{T}",
            r"A^\top",
            r"A^\intercal",
        ] {
            check(&[(tex, r"[A^{\top}]")]);
        }
        check(&[
            ("x^{1/3}", "(^^ x (/ 1 3))"),
            (r"x^{-\frac13}", "(^^ x (- (/ 1 3)))"),
            ("x^{0.4}", "(^^ x 2/5)"),
            ("x^n", "(^^ x n)"),
            ("x_k^T", "(^^ x_k T)"),
            ("x^n_k", "(^^ x_k n)"),
            (r"x^\alpha", r"(^^ x \alpha)"),
            ("x^{a+1}", "(^^ x (+ a 1))"),
            ("x^{-n}", "(^^ x (- n))"),
            ("x^{2n}", "(^^ x (* 2 n))"),
            ("x^{a b}", "(^^ x (* a b))"),
            ("x^{+a}", "(^^ x a)"),
            ("x^{+eta}", "(^^ x eta)"),
            ("x^{n_1}", "(^^ x n_1)"),
            (r"e^{-\zeta t}", r"(^^ e (- (* \zeta t)))"),
            ("e^{st}", "(^^ e (* s t))"),
            (r"\mathrm{e}^{eta}", "(^^ e eta)"),
            ("e^{(a + b)}", "(^^ e (+ a b))"),
            ("e^{x^2}", "(^^ e (^ x 2))"),
            ("2^{n}", "(^^ 2 n)"),
            ("2^{(n)}", "(^^ 2 n)"),
            ("(a+b)^{mn}", "(^^ (+ a b) (* m n))"),
            (r"(a+b)^{\frac{2}{3}}", "(^^ (+ a b) (/ 2 3))"),
            ("x^{(a)(b)}", "(^^ x (* a b))"),
            ("x^{9^{9^9}}", "(^^ x (^^ 9 (^ 9 9)))"),
            (r"\sqrt{x}^n", "(^^ (sqrt x) n)"),
        ]);
        refuse(&[
            (
                "x^{ab}",
                r"column 3: this superscript can be read as x^{\text{ab}} or as x^{a b}",
            ),
            ("x_k^{eta}", r"x_k^{\text{eta}} or as x_k^{+eta}"),
            (r"A^\mathrm{B}", r"A^{\text{B}} or as A^{B}"),
            (r"A^{\rm B}", r"A^{\text{B}} or as A^{B}"),
            ("x^{(n)}", "a superscript in brackets"),
            ("x^{(n+1)}", "a superscript in brackets"),
            ("x^{1/2a}", r"\frac{1}{2} a or as \frac{1}{2 a}"),
            ("x^{10001}", "up to 10000"),
            ("x^{20001/2}", "up to 10000"),
            ("x^{99999999999999999999999}", "up to 10000"),
            ("x^n^m", "second superscript"),
            ("(x)^n_k", "second script"),
            ("x^{n", "`{` is not closed"),
            ("x^{n)}", "found `)` where `}`"),
            ("x^{n=1}", "found `=` where `}`"),
            ("{x^n}^m", "write brackets"),
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
        ]);
    }

    #[test]
    fn degrees() {
        check(&[
            (r"18^\circ", r"(/ (* 18 \pi) 180)"),
            (
                r"\sin 18^{\circ} + 1°",
                r"(+ <\sin (/ (* 18 \pi) 180)> (/ (* 1 \pi) 180))",
            ),
            (
                r"90^\circ - \alpha^\circ",
                r"(+ (/ (* 90 \pi) 180) (- (/ (* \alpha \pi) 180)))",
            ),
            (
                r"\sin{18^\circ}\cos(x°)",
                r"(* <\sin (/ (* 18 \pi) 180)> <\cos (/ (* x \pi) 180)>)",
            ),
            (
                r"\cos 36^\circ \cos 72^\circ",
                r"(* <\cos (/ (* 36 \pi) 180)> <\cos (/ (* 72 \pi) 180)>)",
            ),
            (r"22.5\degree", r"(/ (* 45/2 \pi) 180)"),
            (r"|{-18^\circ}|", r"<\operatorname{abs} (- (/ (* 18 \pi) 180))>"),
        ]);
        refuse(&[
            (
                r"E^\circ",
                r"this degree sign can be read as \frac{E \pi}{180} or as E^{\text{o}}",
            ),
            (r"f^\circ", "this degree sign"),
            (r"x_1^\circ", "this degree sign"),
            (r"20^\circ C", "temperatures"),
            (r"20^\circ\mathrm{C}", "temperatures"),
            (r"20^\circ 30", "temperatures"),
            (r"\sin 18^\circ x", "can be read as"),
            (r"(a + b)^\circ", r"found `\circ`"),
            (r"(a + b)^{\circ}", r"found `\circ`"),
            (r"\sin^\circ x", r"found `\circ`"),
            (r"x^2°", "the end"),
            (r"18°^2", "the end"),
            (r"f \circ g", r"found `\circ`"),
            (r"18 \circ g", r"found `\circ`"),
        ]);
    }

    #[test]
    fn marks_and_primes() {
        check(&[
            ("Z_k^-", "Z_k^-"),
            ("Z^{-}_k", "Z_k^-"),
            (r"\mathbf{H}_k^*", "H_k^*"),
            (r"H_k^{\ast}", "H_k^*"),
            ("U_k^{imp}", r"U_k^{\text{imp}}"),
            (r"U_k^{\mathrm{imp}}", r"U_k^{\text{imp}}"),
            (r"U^{\text{B}}", r"U^{\text{B}}"),
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
