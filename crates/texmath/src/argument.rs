//! The argument of an elementary function that no brackets enclose: `\sin 2\pi t`, `\ln\frac{x}{y}`, `\cos\omega t`.
//!
//! It is one symbol, number, fraction, root or absolute value, one function of such an argument, or a run of a number
//! and symbols that ends in its variable. It ends before a sign, a relation, a closing bracket, `\cdot` and the next
//! function. Whatever else follows may print as more of it: it is taken as a factor or divisor, and both readings are kept.

use super::elementary::Elementary;
use super::error::Fault;
use super::extent::{Belongs, last_call};
use super::part::{Form, Part, product, starts_factor};
use super::reader::Reader;
use super::token::{Kind, Token};
use super::{Name, Operation, Tree};

/// Letters that commonly are the factor of a variable, as in `\cos\omega t`. Any other may be the whole argument: in
/// `v_0\cos\alpha t` and `\sin\theta F` it is.
const COEFFICIENTS: &[&str] = &[
    "a", "b", "c", "i", "j", "k", "l", "m", "n", "p", "q", "s", "\\kappa", "\\lambda", "\\mu", "\\nu", "\\pi",
    "\\omega", "\\Omega",
];

/// Letters of which no argument of several letters is made alone: `\sin a b` may be a product.
const CONSTANTS: &[&str] = &["a", "b", "c"];

/// Letters that commonly are what a factor before them is of.
const VARIABLES: &[&str] = &["x", "y", "z", "t", "\\theta", "\\vartheta", "\\phi", "\\psi"];

impl<'a> Reader<'a> {
    /// The argument without brackets of `function`.
    pub(super) fn bare_argument(&mut self, function: &Elementary) -> Result<Box<Tree>, Fault> {
        self.deepen()?;
        let (at, start) = (self.here(), self.next);
        let is_logarithm = ["\\ln", "\\log"].contains(&function.command);
        let token = match self.peek() {
            Some(token) if starts_factor(token.kind) => token,
            _ => return Err(self.instead_of("the argument of the function")),
        };
        let part = self.factor()?;
        let mut factors = match (part.form, *part.tree) {
            (Form::Knot, Tree::Product(factors)) if self.prints_as_run(start) && self.is_run(&factors) => factors,
            (form, tree) if self.is_argument(token.kind, form, &tree) => vec![tree],
            // `\arg G(x)` has one reading
            (Form::Plain, tree @ Tree::Call(..)) if function.is_part() => vec![tree],
            _ => {
                let instead = "write brackets around the argument";
                return Err(Fault::ambiguous(at, "an argument without brackets", instead));
            }
        };
        while let Some(More { mark, next, token }) = self.more_of_argument()? {
            let is_symbol = matches!(token.kind, Kind::Letter | Kind::Word) && !token.spaced;
            let is_one = |before: &Tree| self.goes_on(before, &next) || (is_logarithm && are_letters(before, &next));
            // braces do not print, but tell where the author ends the argument
            let ended = self
                .tokens
                .get(start)
                .is_some_and(|first| first.kind == Kind::BraceOpen);
            if ended || !is_symbol || !factors.last().is_some_and(is_one) {
                self.argument_ends_at(mark);
                break;
            }
            factors.push(next);
        }
        self.rise();
        Ok(product(factors))
    }

    /// Notes what would print as more of the argument without brackets that ends here.
    pub(super) fn argument_ends(&mut self) -> Result<(), Fault> {
        if let Some(More { mark, .. }) = self.more_of_argument()? {
            self.argument_ends_at(mark);
        }
        Ok(())
    }

    /// Goes back to the end of an argument without brackets, behind which something stands that may belong to it.
    fn argument_ends_at(&mut self, mark: (usize, usize)) {
        self.reset(mark);
        self.argument_ends.insert(self.next);
    }

    /// Returns whether a factor, begun by `token` or by the sign of a product before it, may belong to the argument in which
    /// `before` ends: `\cos\frac{\pi}{2} \cos\theta`, `\ln 2 \cos x`, `\sin 2 \cdot x`, and `\sin(n + 1) x`.
    pub(super) fn may_belong(before: Option<&Tree>, form: Form, next: &Tree, token: Token<'_>) -> Option<Belongs> {
        let (before, (function, argument)) = before.and_then(|tree| Some((tree, last_call(tree)?)))?;
        let dotted = matches!(token.kind, Kind::Times | Kind::Star);
        let calls = last_call(next).is_some();
        let unclear = match form {
            Form::Bare if dotted && calls => false,
            Form::Bare => {
                let grows = match function.base.as_str() {
                    "\\exp" => !dotted,
                    "\\ln" | "\\log" => matches!(argument, Tree::Product(_) | Tree::Number(_)),
                    _ => false,
                };
                grows
                    || (matches!(argument, Tree::Number(_)) && !calls)
                    || (is_constant(argument) && !is_constant(next) && !is_in_degrees(argument))
                    || (last_call(argument).is_some() && !matches!(argument, Tree::Quotient(..)))
            }
            _ => !dotted && !token.spaced && may_scale(before, next),
        };
        // \sin x \cos y is a product
        let is_usual = form == Form::Bare && calls && !dotted;
        unclear.then_some(Belongs { is_usual })
    }

    /// The factor or divisor that follows an argument without brackets; a function does not follow, nor what is known not to belong to
    /// it for sure.
    fn more_of_argument(&mut self) -> Result<Option<More<'a>>, Fault> {
        self.skip_empty();
        if self.argument_ends.contains(&self.next) {
            return Ok(None);
        }
        let mark = self.mark();
        let Some(token) = self.peek().filter(|_| self.differential_ahead().is_none()) else {
            return Ok(None);
        };
        match token.kind {
            Kind::Slash => self.next += 1,
            kind if starts_factor(kind) && !self.first_printed().is_some_and(|token| self.is_function(token)) => {}
            _ => return Ok(None),
        }
        let Part { tree, .. } = self.factor()?;
        let next = *tree;
        Ok(Some(More { mark, next, token }))
    }

    /// Whether an elementary function begins with this token.
    fn is_function(&self, token: Token<'_>) -> bool {
        token.kind == Kind::Function || (token.kind == Kind::Word && self.function_word(token.text).is_some())
    }

    /// Whether what begins with a token of this kind is an argument by itself.
    fn is_argument(&self, kind: Kind, form: Form, tree: &Tree) -> bool {
        match (form, tree) {
            (Form::Literal | Form::Fraction | Form::Bracketed | Form::Bare, _) => true,
            (Form::Plain, Tree::Call(name, ..)) => {
                Elementary::by_command(&name.base).is_some() && !self.names.is_function(name)
            }
            (Form::Plain, Tree::Symbol(..) | Tree::Root(..)) => true,
            (Form::Plain, Tree::Operation(operation, _)) => matches!(**operation, Operation::Root { .. }),
            // an angle in degrees
            (Form::Knot, Tree::Quotient(..)) => true,
            (Form::Knot, tree) => kind != Kind::Root && (is_number(tree) || symbol_of(tree).is_some()),
            _ => false,
        }
    }

    /// Whether no sign and no blank stands among the tokens from `start` on.
    fn prints_as_run(&self, start: usize) -> bool {
        let read = self.tokens.get(start + 1..self.next).unwrap_or_default();
        !read
            .iter()
            .any(|token| token.spaced || matches!(token.kind, Kind::Times | Kind::Star | Kind::Slash))
    }

    fn is_run(&self, factors: &[Tree]) -> bool {
        factors
            .windows(2)
            .all(|pair| matches!(pair, [before, next] if self.goes_on(before, next)))
    }

    /// Whether `next` belongs to an argument in which `before` stands right before it.
    fn goes_on(&self, before: &Tree, next: &Tree) -> bool {
        let plain = |name: &&Name| !self.names.is_function(name);
        let Some(next) = symbol_of(next).filter(|name| plain(name) || is_number(before)) else {
            return false;
        };
        // `\cos\theta\dot\theta` and `\cos\theta\hat{x}` are products of two
        if !next.accents.is_empty() || !next.mark.is_empty() || next.primes > 0 {
            return false;
        }
        match symbol_of(before) {
            Some(before) => {
                let is_factor = |name: &Name, of: &[&str]| of.contains(&name.base.as_str());
                let are_constants = is_factor(before, CONSTANTS) && is_factor(next, CONSTANTS);
                plain(&before) && is_factor(before, COEFFICIENTS) && !are_constants
            }
            None => is_number(before),
        }
    }
}

/// Returns true for two letters as in `\ln x y`: a factor of a logarithm is printed before it.
fn are_letters(one: &Tree, other: &Tree) -> bool {
    let is_letter =
        |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if *name == Name::plain(&name.base) && name.base.len() == 1);
    is_letter(one) && is_letter(other)
}

/// A number, a power of one or a fraction of two.
fn is_number(tree: &Tree) -> bool {
    match tree {
        Tree::Number(_) => true,
        Tree::Power(base, ..) | Tree::RealPower(base, ..) => matches!(**base, Tree::Number(_)),
        Tree::Quotient(above, below, _) => matches!((&**above, &**below), (Tree::Number(_), Tree::Number(_))),
        _ => false,
    }
}

/// The symbol that a tree is, or is a power of.
fn symbol_of(tree: &Tree) -> Option<&Name> {
    match tree {
        Tree::Symbol(name, _) => Some(name),
        Tree::Power(base, ..) | Tree::RealPower(base, ..) | Tree::Root(base, 2, _) => symbol_of(base),
        _ => None,
    }
}

/// A factor or divisor behind an argument without brackets.
struct More<'a> {
    /// The place before it.
    mark: (usize, usize),
    next: Tree,
    /// The token that it begins with.
    token: Token<'a>,
}

/// Whether `next` right behind the function's value `before` may belong to its argument, as in `\sin(n + 1) x`: a
/// variable, behind brackets that hold a sum without one.
pub(super) fn may_scale(before: &Tree, next: &Tree) -> bool {
    let Some((_, argument @ Tree::Sum(_))) = last_call(before).filter(|_| is_call(before)) else {
        return false;
    };
    let is_variable = |name: &Name| VARIABLES.contains(&name.base.as_str());
    let scaled = match next {
        Tree::Quotient(above, ..) => match &**above {
            Tree::Product(factors) => factors.first().and_then(symbol_of),
            above => symbol_of(above),
        },
        next => symbol_of(next),
    };
    scaled.is_some_and(|name| is_variable(name) || is_pi(name)) && all_symbols(argument, &|name| !is_variable(name))
}

/// A function's value or a power of one.
fn is_call(tree: &Tree) -> bool {
    match tree {
        Tree::Power(base, ..) | Tree::RealPower(base, ..) => matches!(**base, Tree::Call(..)),
        tree => matches!(tree, Tree::Call(..)),
    }
}

fn is_pi(name: &Name) -> bool {
    *name == Name::plain("\\pi")
}

/// Whether this is an angle as [`Reader::in_degrees`] writes it.
fn is_in_degrees(tree: &Tree) -> bool {
    matches!(tree, Tree::Quotient(_, below, _) if matches!(&**below, Tree::Number(half_turn) if half_turn.to_integer() == Some(180)))
}

/// Whether a tree is written with numbers and `\pi` alone.
fn is_constant(tree: &Tree) -> bool {
    all_symbols(tree, &is_pi)
}

/// Whether a tree is written with numbers, functions and such symbols alone.
fn all_symbols(tree: &Tree, test: &dyn Fn(&Name) -> bool) -> bool {
    let again = |tree: &Tree| all_symbols(tree, test);
    match tree {
        Tree::Number(_) => true,
        Tree::Symbol(name, _) => test(name),
        Tree::Call(_, inner, _) | Tree::Negate(inner) | Tree::Power(inner, ..) | Tree::Root(inner, ..) => again(inner),
        Tree::Sum(parts) | Tree::Product(parts) => parts.iter().all(again),
        Tree::Quotient(one, other, _) | Tree::RealPower(one, other, _) => again(one) && again(other),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::read_display;
    use super::super::spelled::{check, names, refuse};

    #[test]
    fn one_symbol_number_or_fraction() {
        check(&[
            (r"2\cos\theta", r"(* 2 <\cos \theta>)"),
            (r"\cos 2 + 1", r"(+ <\cos 2> 1)"),
            (r"\cos\frac{\pi}{2}", r"<\cos (/ \pi 2)>"),
            (r"\cos t_k", r"<\cos t_k>"),
            (r"\cos{\theta}", r"<\cos \theta>"),
            (r"\sin^2\theta", r"(^ <\sin \theta> 2)"),
            (r"\ln x^2", r"<\ln (^ x 2)>"),
            (r"\sin\theta^2", r"<\sin (^ \theta 2)>"),
            (r"\ln x^n", r"<\ln (^^ x n)>"),
            (r"\ln x^{1/2}", r"<\ln (sqrt x)>"),
            (r"\ln|x|", r"<\ln <\operatorname{abs} x>>"),
            (
                r"\ln\left|\tan\frac{x}{2}\right|",
                r"<\ln <\operatorname{abs} <\tan (/ x 2)>>>",
            ),
            (r"\arctan\sqrt{x}", r"<\arctan (sqrt x)>"),
            (r"\ln\sqrt[3]{x}", r"<\ln (root x 3)>"),
            (r"\sin f + 1", r"(+ <\sin f> 1)"),
            (r"\sin\dot Z_k", r"<\sin \dot{Z}_k>"),
            (r"\ln\cos x", r"<\ln <\cos x>>"),
            (r"\cos\arcsin x", r"<\cos <\arcsin x>>"),
            (r"\ln\ln\cos(x)", r"<\ln <\ln <\cos x>>>"),
            (r"\operatorname{arsinh} x", r"<\operatorname{arsinh} x>"),
            (r"\operatorname{sgn} x", r"<\operatorname{sgn} x>"),
        ]);
    }

    #[test]
    fn runs_that_end_in_their_variable() {
        check(&[
            (r"\sin 2x", r"<\sin (* 2 x)>"),
            (r"\sin 2\pi t", r"<\sin (* 2 \pi t)>"),
            (r"\cos \omega t", r"<\cos (* \omega t)>"),
            (r"\cos\omega_0 t + 1", r"(+ <\cos (* \omega_0 t)> 1)"),
            (r"\sin n\pi", r"<\sin (* n \pi)>"),
            (r"\sin \pi t", r"<\sin (* \pi t)>"),
            (r"\cos 2^k x", r"<\cos (* (^^ 2 k) x)>"),
            (r"\sin 2^2 x", r"<\sin (* (^ 2 2) x)>"),
            (r"\sin a x", r"<\sin (* a x)>"),
            (r"\sin a x^2", r"<\sin (* a (^ x 2))>"),
            (r"\cos k_n^2 x", r"<\cos (* (^ k_n 2) x)>"),
            (r"\sin\frac12 x", r"<\sin (* (/ 1 2) x)>"),
            (
                r"\cos\lambda l \cosh\lambda l",
                r"(* <\cos (* \lambda l)> <\cosh (* \lambda l)>)",
            ),
            (r"e^{at}\sin bx", r"(* (^^ e (* a t)) <\sin (* b x)>)"),
            (
                r"\cos n\varphi + i\sin n\varphi",
                r"(+ <\cos (* n \phi)> (* i <\sin (* n \phi)>))",
            ),
            (r"\cos iz - \sinh iy", r"(+ <\cos (* i z)> (- <\sinh (* i y)>))"),
            (r"\sin{2x}", r"<\sin (* 2 x)>"),
            (r"\sin{2x}\cos{k y}", r"(* <\sin (* 2 x)> <\cos (* k y)>)"),
            (r"\sin\,2x", r"<\sin (* 2 x)>"),
            (r"\sin^2 2x", r"(^ <\sin (* 2 x)> 2)"),
            (r"\sqrt{\sin 2x}", r"(sqrt <\sin (* 2 x)>)"),
            (r"\left(1 - \cos 2x\right) y", r"(* (+ 1 (- <\cos (* 2 x)>)) y)"),
            (r"\frac{1 - \cos 2x}{2}", r"(/ (+ 1 (- <\cos (* 2 x)>)) 2)"),
            (r"e^{-\cos 2x}", r"(^^ e (- <\cos (* 2 x)>))"),
            (r"|\sin 2x|", r"<\operatorname{abs} <\sin (* 2 x)>>"),
            (r"\sin 2eta", r"<\sin (* 2 eta)>"),
            (r"\sin 2f \cos f", r"(* <\sin (* 2 f)> <\cos f>)"),
        ]);
    }

    #[test]
    fn an_argument_ends_before_the_next_function() {
        check(&[
            (r"\sin u \cos v", r"(* <\sin u> <\cos v>)"),
            (r"\sin u\,\cos v", r"(* <\sin u> <\cos v>)"),
            (r"a\cos x\cos y\cos z", r"(* a <\cos x> <\cos y> <\cos z>)"),
            (r"\sin 2x \cos 3x", r"(* <\sin (* 2 x)> <\cos (* 3 x)>)"),
            (r"\sin^2 x \cos^3 y", r"(* (^ <\sin x> 2) (^ <\cos y> 3))"),
            (
                r"\sin\frac{x+y}{2} \cos\frac{x-y}{2}",
                r"(* <\sin (/ (+ x y) 2)> <\cos (/ (+ x (- y)) 2)>)",
            ),
            (r"\ln x \ln y", r"(* <\ln x> <\ln y>)"),
            (
                r"\cos\frac{\pi}{7} \cos\frac{2\pi}{7}",
                r"(* <\cos (/ \pi 7)> <\cos (/ (* 2 \pi) 7)>)",
            ),
            (r"\cos\theta \cdot x", r"(* <\cos \theta> x)"),
            (r"\cos\omega t \times x", r"(* <\cos (* \omega t)> x)"),
            (r"\ln 2 \cdot \ln 3", r"(* <\ln 2> <\ln 3>)"),
            (r"{\cos a} \sin b", r"(* <\cos a> <\sin b>)"),
            (r"\cos x \operatorname{sgn} y", r"(* <\cos x> <\operatorname{sgn} y>)"),
            (r"\cos(x) y", r"(* <\cos x> y)"),
            (r"\cos{\left(x \right)} y", r"(* <\cos x> y)"),
            (r"\sin^{2}{\left(x \right)} y", r"(* (^ <\sin x> 2) y)"),
            (r"\sin(x + y) z", r"(* <\sin (+ x y)> z)"),
            (r"\sin(n + 1)\,x", r"(* <\sin (+ n 1)> x)"),
            (r"\sin(n + 1) \cdot x", r"(* <\sin (+ n 1)> x)"),
            (r"\cos\frac{\pi}{2} \cos\theta", r"(* <\cos (/ \pi 2)> <\cos \theta>)"),
            (r"\ln 2 \cos x", r"(* <\ln 2> <\cos x>)"),
            (r"\ln\cos x \sin y", r"(* <\ln <\cos x>> <\sin y>)"),
            (r"\exp x \cos y", r"(* <\exp x> <\cos y>)"),
        ]);
        refuse(&[
            (r"\sin 2 \cdot 3 x", r"\sin(2) \cdot 3 x or as \sin(2 \cdot 3) x"),
            (r"\ln 2a \cdot b", r"or as \ln("),
            (r"\sin(n + \frac12)x", r"or as \sin((n + \frac{1}{2}) x)"),
            (r"\sin(2n + 1)\pi", r"or as \sin((2 n + 1) \pi)"),
            (r"\sin(2n + 1)\frac{\pi}{2}", r"or as \sin("),
            (r"\cos^2(m - n)x", r"or as \cos^2("),
        ]);
    }

    #[test]
    fn what_may_be_more_of_the_argument_is_refused_where_one_reading_is_wanted() {
        refuse(&[
            (r"\sin x (a + b)", r"\sin(x) (a + b) or as \sin(x \cdot (a + b))"),
            (r"\cos\theta(x)", r"`\theta` before a single term in brackets"),
            (r"\sin 2x/3", r"\frac{\sin(2 x)}{3} or as \sin(\frac{2 x}{3})"),
            (r"\cos\theta/2", r"\frac{\cos(\theta)}{2} or as \cos(\frac{\theta}{2})"),
            (r"\sin x\, y", r"\sin(x) y or as \sin(x y)"),
            (r"\sin x y", r"\sin(x) y or as \sin(x y)"),
            (r"\sin\omega\, t", r"\sin(\omega) t or as \sin(\omega t)"),
            (r"\cos\theta F", r"\cos(\theta) F or as \cos(\theta F)"),
            (r"v_0\cos\alpha t", r"v_0 \cos(\alpha) t or as v_0 \cos(\alpha t)"),
            (r"\cos\beta l \cosh\beta l", r"\cos(\beta) l \cosh(\beta) l or as"),
            (r"\sin eta x", r"\sin(eta) x or as"),
            (r"\cos\omega t F", r"\cos(\omega t) F or as"),
            (r"\cos 2\theta\dot\theta", r"\cos(2 \theta) \dot{\theta} or as"),
            (r"\sin\omega\hat x", r"\sin(\omega) \hat{x} or as"),
            (r"\sin\omega x'", r"\sin(\omega) x' or as"),
            (r"\sin{2x} y", r"\sin(2 x) y or as \sin(2 x y)"),
            (r"\cos{k} x", r"\cos(k) x or as \cos(k x)"),
            (r"\sin\frac{x}{2} y", r"\sin(\frac{x}{2}) y or as"),
            (r"\cos\frac{n\pi}{2}x", r"or as \cos(\frac{n \pi}{2} x)"),
            (r"\sin x \frac{a}{b}", r"\sin(x) \frac{a}{b} or as"),
            (r"\sin 2 \frac{x}{3}", r"\sin(2) \frac{x}{3} or as"),
            (r"\ln|x| y", r"or as \ln("),
            (r"\sin f x", r"\sin(f) x or as"),
            (r"\sin 2f x", r"\sin(2 f) x or as"),
            (r"\sin 2f(t)", r"\sin(2) f(t) or as"),
            (r"\sin A b", r"\sin(A) b or as"),
            (r"\sin a f", r"\sin(a) f or as"),
            (r"\sin a f(t)", r"\sin(a) f(t) or as"),
            (r"\sin x cos(y)", r"\sin(x) \cos(y) or as"),
            (r"\sin x |y|", r"or as \sin(x \left|y\right|)"),
            (r"{\cos a} b", r"\cos(a) b or as \cos(a b)"),
            (r"{2 \cos a}/b", r"\frac{2 \cos(a)}{b} or as 2 \cos(\frac{a}{b})"),
            (r"\cos{a+b}", "write brackets around the argument"),
            (r"\cos{2 \cdot x}", "write brackets around the argument"),
            (r"\cos{2\,x}", "write brackets around the argument"),
            (r"\cos{x y}", "write brackets around the argument"),
            (r"\cos F_1(t)", "write brackets around the argument"),
            (r"\sin|x|^2", "write brackets around the argument"),
            (r"\sin\sqrt{x}^2", "write brackets around the argument"),
            (r"\sin\det DP", "write brackets around the argument"),
            (r"\cos", "the argument of the function"),
            (r"\cos -x", "the argument of the function"),
        ]);
    }

    #[test]
    fn what_follows_an_argument_or_a_divisor_has_each_reading_once() {
        for (tex, wanted) in [
            (r"\sin x y", r"\sin(x) y: \sin(x y)"),
            (r"\exp x \exp y", r"\exp(x) \exp(y): \exp(x \exp(y))"),
            (r"a/b x y", r"\frac{a}{b} x y: \frac{a}{b x} y; \frac{a}{b x y}"),
            (r"\sin x/2", r"\frac{\sin(x)}{2}: \sin(\frac{x}{2})"),
            (
                r"\cos x y/2",
                r"\frac{\cos(x) y}{2}: \frac{\cos(x y)}{2}; \cos(\frac{x y}{2})",
            ),
            (
                r"\sin x y \cos u v",
                r"\sin(x) y \cos(u) v: \sin(x) y \cos(u v); \sin(x y) \cos(u) v; \sin(x y \cos(u) v); \sin(x y) \cos(u v); \sin(x y \cos(u v))",
            ),
            (r"\sin x \cos y", ""),
            (r"1/(2 x) y + \sin(x) y/2", r"\frac{1}{2 x} y: \frac{1}{2 x y}"),
        ] {
            let display = read_display(&format!("{tex} = 0"), &names()).unwrap();
            let doubts = display.equations.iter().flat_map(|equation| &equation.doubts.0);
            let shown = doubts.map(|doubt| {
                let readings = doubt.kind.readings();
                let others: Vec<String> = readings.iter().map(|reading| reading.other.to_string()).collect();
                let taken = readings.first().map(|reading| reading.taken.to_string());
                format!("{}: {}", taken.unwrap_or_default(), others.join("; "))
            });
            assert_eq!(shown.collect::<Vec<_>>().join(" and "), wanted, "{tex}");
        }
    }

    #[test]
    fn a_long_product_has_more_readings_than_are_decided_and_ends() {
        for factors in [r"\exp x ", r"\sin x y "] {
            let display = read_display(&format!("{} = 0", factors.repeat(1000)), &names()).unwrap();
            let doubts = &display.equations[0].doubts.0;
            assert!((16..100).contains(&doubts[0].kind.readings().len()), "{factors}");
        }
    }

    #[test]
    fn powers_of_functions() {
        check(&[
            (r"\cos^3 x", r"(^ <\cos x> 3)"),
            (r"\sin^n x", r"(^^ <\sin x> n)"),
            (r"\sin^{2n} x", r"(^^ <\sin x> (* 2 n))"),
            (r"\sin^{n-1} x \cos x", r"(* (^^ <\sin x> (+ n (- 1))) <\cos x>)"),
            (r"\ln^k 2x", r"(^^ <\ln (* 2 x)> k)"),
            (r"\sin^n(x)", r"(^^ <\sin x> n)"),
            (r"\sin^{-1} x", r"<\arcsin x>"),
            (r"\tanh^{-1}(2x) y", r"(* <\operatorname{artanh} (* 2 x)> y)"),
            (r"\cos^{-3} x", r"(^ <\cos x> -3)"),
            (r"\sin^{-n} x", r"(^^ <\sin x> (- n))"),
        ]);
        refuse(&[
            (r"\sin^{(n)} x", "behind brackets around the call"),
            (r"\arcsin^n x", "behind brackets around the call"),
            (r"\exp^n x", "behind brackets around the call"),
            (r"\cos^* x", "only a name"),
        ]);
    }
}
