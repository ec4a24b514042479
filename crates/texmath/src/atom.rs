//! Factors: numbers, brackets, braces, fractions, roots and partial derivatives.

use super::call::raise;
use super::error::Fault;
use super::evaluate::evaluate;
use super::part::{Form, Part, starts_factor};
use super::reader::Reader;
use super::token::{Bracket, Kind, Token};
use super::{At, Name, Operation, Tree};
use numbers::Rational;
use std::collections::BTreeMap;

/// The most digits of a number: exact arithmetic on longer ones would take noticeable time.
const LONGEST: usize = 1000;

/// The highest index of a root.
const HIGHEST_INDEX: u32 = 1000;

const PARTNER: &str = "write \\frac{\\partial a}{\\partial b} with one name above and one below";

/// Whether a tree is written without a sign between terms, and is no quotient.
fn is_single(tree: &Tree) -> bool {
    match tree {
        Tree::Symbol(..) | Tree::Number(_) | Tree::Power(..) => true,
        Tree::Negate(inner) => is_single(inner),
        Tree::Product(factors) => factors.iter().all(is_single),
        _ => false,
    }
}

impl<'a> Reader<'a> {
    /// One factor, with the power or the factorial sign that it carries.
    pub(super) fn factor(&mut self) -> Result<Part, Fault> {
        let part = self.plain_factor()?;
        match self.peek_kind() {
            Some(Kind::Factorial) => self.factorial(part),
            _ => Ok(part),
        }
    }

    fn plain_factor(&mut self) -> Result<Part, Fault> {
        self.skip_empty();
        let Some(token) = self.peek() else {
            return Err(self.instead_of("a factor"));
        };
        if let Some(differential) = self.differential()? {
            return Ok(differential);
        }
        match token.kind {
            Kind::Letter if self.is_order(token) => self.order_of(token),
            Kind::Letter | Kind::Word | Kind::Accent => self.named(token),
            Kind::BraceOpen => self.group(token.at),
            Kind::Function => {
                let function = super::elementary::Elementary::by_word(token.text);
                let function = function.ok_or_else(|| self.instead_of("a function"))?;
                self.elementary(function, 1)
            }
            Kind::Invariant(kind) => self.invariant(kind, 1),
            Kind::Number => self.number(token),
            Kind::Open(bar @ (Bracket::Bar | Bracket::DoubleBar)) => {
                let tree = self.absolute_value(token, bar)?;
                self.carried(tree, Form::Bracketed)
            }
            Kind::Open(Bracket::Rows(rows)) => {
                let tree = self.rows(token, rows)?;
                self.carried(tree, Form::Bracketed)
            }
            Kind::Series(kind) => self.series(token, kind),
            Kind::Integral => self.integral(token),
            Kind::Limit => self.limit_of(token),
            Kind::Open(bracket @ (Bracket::Floor | Bracket::Ceiling)) => {
                let tree = self.rounded(token, bracket)?;
                self.carried(tree, Form::Bracketed)
            }
            Kind::Open(bracket) => {
                let inside = self.next + 1;
                let tree = self.bracketed()?;
                let has_brackets = self.tokens[inside..self.next]
                    .iter()
                    .any(|token| matches!(token.kind, Kind::Open(_)));
                let is_needless =
                    !has_brackets && is_single(&tree) && !matches!(self.peek_kind(), Some(Kind::Sup | Kind::Sub));
                if matches!(bracket, Bracket::Square | Bracket::Curly) && is_needless {
                    let found = match bracket {
                        Bracket::Curly => "a single term in curly brackets",
                        _ => "a single term in square brackets",
                    };
                    let instead = "a product needs none, and they stand for the integer or the fractional part, or for a mean, too";
                    return Err(Fault::ambiguous(token.at, found, instead));
                }
                if token.kind == Kind::Open(Bracket::Square)
                    && let Some(between) = self.between_limits(&tree, token.at)?
                {
                    return Ok(between);
                }
                match self.peek_kind() {
                    Some(Kind::Prime) => {
                        let tree = self.primed(tree, token.at)?;
                        self.carried(tree, Form::Bracketed)
                    }
                    _ => self.carried(tree, Form::Bracketed),
                }
            }
            Kind::Fraction => self.fraction(token),
            Kind::Root => self.root(token),
            Kind::Partial => self.flat_partial(token),
            Kind::Extremum => self.extremum(token.text),
            Kind::Binomial => self.binomial(),
            _ => Err(self.instead_of("a factor")),
        }
    }

    /// `tree` with the power that follows it, if `form` may carry one.
    pub(super) fn carried(&mut self, tree: Box<Tree>, form: Form) -> Result<Part, Fault> {
        let at = self.here();
        let power = self.power()?;
        match (&power, form) {
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
        self.no_scale(token)?;
        let tree = Box::new(Tree::Number(value(token)?));
        let form = Form::Literal;
        match self.in_degrees(Part { tree, form })? {
            Part {
                tree,
                form: Form::Literal,
            } => self.carried(tree, Form::Literal),
            angle => Ok(angle),
        }
    }

    /// Refuses `1e3` and `2.5e-3`: a programmer means a power of ten, TeX prints a product or a difference. Blanks and
    /// braces do not print; a sign makes a sum of it where the source has blanks beside it.
    fn no_scale(&self, number: Token<'a>) -> Result<(), Fault> {
        let printed = |token: &&Token<'a>| !matches!(token.kind, Kind::BraceOpen | Kind::BraceClose);
        let mut rest = self.tokens.iter().skip(self.next).filter(printed);
        let Some(letter) = rest.next().filter(|token| matches!(token.text, "e" | "E")) else {
            return Ok(());
        };
        let (mut sign, mut digits) = (None, rest.next());
        if let Some(token) = digits.filter(|token| matches!(token.kind, Kind::Plus | Kind::Minus)) {
            let close = |before: &Token<'a>, after: &Token<'a>| before.end == after.at;
            (sign, digits) = (Some(token), rest.next());
            if !(close(letter, token) && digits.is_some_and(|digits| close(token, digits))) {
                return Ok(());
            }
        }
        let Some(digits) = digits.filter(|token| token.kind == Kind::Number) else {
            return Ok(());
        };
        let (number_text, letter, digits) = (number.text, letter.text, digits.text);
        let [written, scaled, product] = match sign.map(|sign| sign.kind) {
            Some(Kind::Minus) => ["-", "-", " - "],
            Some(_) => ["+", "", " + "],
            None => ["", "", " \\cdot "],
        };
        Err(Fault::two_readings(
            number.at,
            &format!("`{number_text}{letter}{written}{digits}`"),
            &format!("{number_text} \\cdot 10^{{{scaled}{digits}}}"),
            &format!("{number_text} {letter}{product}{digits}"),
        ))
    }

    /// `{..}`: braces do not print, so what they hold must stand for itself.
    fn group(&mut self, at: usize) -> Result<Part, Fault> {
        self.next += 1;
        let part = self.sum_part()?;
        self.close_brace(at)?;
        let last = match &*part.tree {
            Tree::Product(factors) => factors.last(),
            _ => None,
        };
        let ends_in_number = matches!(last, Some(Tree::Number(_)));
        match (part.tree, part.form) {
            (tree, Form::Plain) if matches!(*tree, Tree::Symbol(..)) => self.rescripted(*tree),
            (tree, Form::Open) => self.carried(tree, Form::Braced),
            (tree, _) if ends_in_number => self.carried(tree, Form::Braced),
            (tree, Form::Bare) => {
                self.argument_ends()?;
                self.carried(tree, Form::Bare)
            }
            (tree, form) => self.carried(tree, form),
        }
    }

    /// A symbol between braces, with the scripts and the argument behind them.
    fn rescripted(&mut self, symbol: Tree) -> Result<Part, Fault> {
        match symbol {
            Tree::Symbol(name, at) => self.symbol(name, at.0),
            tree => self.carried(Box::new(tree), Form::Plain),
        }
    }

    /// What a command such as `\sqrt` takes: a group, a digit or a letter.
    pub(super) fn argument(&mut self) -> Result<Box<Tree>, Fault> {
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
                value(digit).map(|value| Box::new(Tree::Number(value)))
            }
            Kind::Letter => {
                self.next += 1;
                let base = token.text.to_owned();
                let name = Name {
                    base,
                    ..Name::default()
                };
                Ok(Box::new(Tree::Symbol(name, At(token.at))))
            }
            _ => Err(self.instead_of("an argument in { }")),
        }
    }

    fn fraction(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        let before = self.mark();
        let is_partial =
            self.peek_kind() == Some(Kind::BraceOpen) && self.look(1).is_some_and(|token| token.kind == Kind::Partial);
        // of one name by another it may be along a map
        let partial = match is_partial {
            true => Some(self.stacked_partial(token.at)),
            false => None,
        };
        let tree = match partial {
            Some(Ok(tree)) => Some(tree),
            partial => {
                self.reset(before);
                match (self.derivative(token.at)?, partial) {
                    (None, Some(Err(fault))) => return Err(fault),
                    (tree, _) => tree,
                }
            }
        };
        if let Some(tree) = tree {
            return self.carried(Box::new(tree), Form::Fraction);
        }
        let above = self.argument()?;
        let below = self.argument()?;
        let tree = Tree::Quotient(above, below, At(token.at));
        self.carried(Box::new(tree), Form::Fraction)
    }

    fn root(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        let index = match self.peek_kind() {
            Some(Kind::Open(Bracket::Square)) => self.index()?,
            _ => Ok(2),
        };
        let radicand = self.argument()?;
        let root = match index {
            Ok(index) => Tree::Root(radicand, index, At(token.at)),
            Err(index) => {
                let of = *radicand;
                Tree::Operation(Box::new(Operation::Root { of, index }), At(token.at))
            }
        };
        self.carried(Box::new(root), Form::Plain)
    }

    /// The index of a root, between the brackets that stand next: a number, or a formula with a symbol.
    fn index(&mut self) -> Result<Result<u32, Tree>, Fault> {
        let at = self.here();
        let index = self.look(1).and_then(|token| token.text.parse().ok());
        if let (Some(index), Some(Kind::Close(Bracket::Square))) = (index, self.look(2).map(|token| token.kind))
            && (2..=HIGHEST_INDEX).contains(&index)
        {
            self.next += 3;
            return Ok(Ok(index));
        }
        self.next += 1;
        let index = *self.sum()?;
        if evaluate(&index, &mut BTreeMap::<Name, Rational>::new()).is_ok() {
            let instead = "the index of a root is a number from 2 to 1000, or has a symbol in it";
            return Err(Fault::unsupported(at, "this root", instead));
        }
        if self.peek_kind() != Some(Kind::Close(Bracket::Square)) {
            return Err(self.instead_of("`]` after the index of a root"));
        }
        self.next += 1;
        Ok(Err(index))
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
            None => {
                let of = self.operand()?;
                self.skip_empty();
                if self.peek_kind().is_some_and(starts_factor) {
                    let instead = "write \\frac{\\partial a}{\\partial b}, with what is differentiated above";
                    return Err(Fault::ambiguous(
                        self.here(),
                        "a factor behind what is differentiated",
                        instead,
                    ));
                }
                of
            }
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
        let tree = Box::new(Tree::Partial { of, by, at });
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

pub(super) fn value(token: Token<'_>) -> Result<Rational, Fault> {
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

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn numbers_and_arguments() {
        check(&[
            ("0.26", "13/50"),
            (".5", "1/2"),
            ("2", "2"),
            (r"\frac12", "(/ 1 2)"),
            (r"\frac 1 2", "(/ 1 2)"),
            (r"\frac{1}2", "(/ 1 2)"),
            (r"\frac1{r_B}", "(/ 1 r_B)"),
            (r"\dfrac{a}{b} \tfrac{a}{b} \cfrac{a}{b}", "(* (/ a b) (/ a b) (/ a b))"),
            (r"\frac\pi2 x", r"(* (/ \pi 2) x)"),
            (r"\sqrt{a + b}", "(sqrt (+ a b))"),
            (r"\sqrt 2", "(sqrt 2)"),
            (r"\sqrt[2]{x}^3", "(^ (sqrt x) 3)"),
            (r"\sqrt[3]{x} \sqrt[1000]2", "(* (root x 3) (root 2 1000))"),
            ("2 e - 3", "(+ (* 2 e) (- 3))"),
            ("2e^3", "(* 2 (^ e 3))"),
            (r"1 e \cdot 3", "(* 1 e 3)"),
        ]);
        refuse(&[
            (r"\frac123", "write { }"),
            (r"\sqrt23", "write { }"),
            (r"\sqrt x_k", "only a name"),
            (r"\sqrt[1]{x}", "from 2 to 1000"),
            (r"\sqrt[1001]{x}", "from 2 to 1000"),
            (r"\sqrt[3{x}", "after the index of a root"),
            (r"1.5\mathrm{e}3", r"`1.5e3` can be read"),
            ("1.5 e 3", r"`1.5e3` can be read"),
            ("1e3", r"`1e3` can be read as 1 \cdot 10^{3} or as 1 e \cdot 3"),
            (
                "a + 2.5e-3",
                r"column 5: `2.5e-3` can be read as 2.5 \cdot 10^{-3} or as 2.5 e - 3",
            ),
            ("2E+4 x", r"2 \cdot 10^{4} or as 2 E + 4"),
            (r"\frac{}{2}{3}", "an argument"),
            (r"\frac{1}", "an argument"),
            (r"\frac1.5", "a digit"),
            (r"\frac(a)(b)", "an argument"),
            (&"1".repeat(1001), "so long a number"),
        ]);
    }

    #[test]
    fn partial_derivatives() {
        for tex in [
            r"\frac{\partial t_{k+1}}{\partial t_k}",
            r"\dfrac{\partial t_{k+1}}{\partial t_k}",
            r"\tfrac{\partial{t_{k+1}}}{\partial{t_k}}",
            r"\partial t_{k+1}/\partial t_k",
            r"\frac{\partial}{\partial t_k} t_{k+1}",
            r"\frac{\partial}{\partial t_k}(t_{k+1})",
        ] {
            check(&[(tex, "d(t_{k+1})/d(t_k)")]);
        }
        check(&[
            (
                r"\frac{\partial \dot{Z}_{k+1}}{\partial \dot{Z}_k} [f(t) + a]",
                r"(* d(\dot{Z}_{k+1})/d(\dot{Z}_k) (+ <f t> a))",
            ),
            (r"(\frac{\partial a}{\partial b})^2", "(^ d(a)/d(b) 2)"),
            (r"\frac{\partial^2 a}{\partial b^2}", r"[\frac{d^2}{db^2} (a)]"),
            (r"\frac{\partial f(t)}{\partial t}", r"[\frac{d}{dt} [f(t)]]"),
        ]);
        refuse(&[
            (r"\frac{\partial^3 a}{\partial b \partial c}", "its order above differs"),
            (r"\frac{\partial a}{\partial b^2}", "its order above differs"),
            (r"\frac{a}{\partial t}", r"\partial alone"),
            (r"\partial a", r"\partial alone"),
            (r"\frac{\partial a}{b}", r"\partial"),
            (r"\partial a/\partial b c", "brackets around it"),
            (r"\frac{\partial a}{\partial b}^2", "write brackets"),
        ]);
    }
}
