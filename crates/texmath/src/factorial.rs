//! `n!`, `(2n - 1)!!` and `\binom{n}{k}`, which are numbers where they are of small integers.

use super::command::{ABSOLUTE, DOUBLE_FACTORIAL, FACTORIAL};
use super::error::Fault;
use super::part::{Form, Part};
use super::reader::Reader;
use super::token::Kind;
use super::{At, Name, Operation, Relation, Tree};
use numbers::{Field, Rational};

/// The largest integer whose factorial is read as a number: that of the next is no `i64`.
const LARGEST: i64 = 20;

impl Reader<'_> {
    /// `part` with the factorial sign that stands next.
    pub(super) fn factorial(&mut self, part: Part) -> Result<Part, Fault> {
        let at = self.here();
        let mut signs = 0;
        let mut end = at;
        while let Some(sign) = self.take(Kind::Factorial) {
            signs += 1;
            end = sign.end;
        }
        let is_alone = match part.form {
            Form::Literal => true,
            Form::Bracketed => !matches!(&*part.tree, Tree::Call(name, ..) if name.base == ABSOLUTE),
            Form::Plain => matches!(*part.tree, Tree::Symbol(..)),
            _ => false,
        };
        if !is_alone || signs > 2 {
            let instead = "write brackets around what the sign is of";
            return Err(Fault::ambiguous(at, "this factorial", instead));
        }
        if self
            .peek()
            .is_some_and(|next| next.kind == Kind::Relation(Relation::Equal) && next.at == end)
        {
            let shown = part.tree.to_string();
            let (factorial, unequal) = (format!("{shown}! ="), format!("{shown} \\neq"));
            return Err(Fault::two_readings(at, "`!=`", &factorial, &unequal));
        }
        let value = match signs {
            1 => factorial(*part.tree, 1, at),
            _ => factorial(*part.tree, 2, at),
        };
        self.carried(Box::new(value), Form::Plain)
    }

    /// The binomial coefficient whose command stands next.
    pub(super) fn binomial(&mut self) -> Result<Part, Fault> {
        let at = self.here();
        self.next += 1;
        let (of, chosen) = (*self.argument()?, *self.argument()?);
        let tree = match (small(&of), small(&chosen)) {
            (Some(of), Some(chosen)) => Tree::Number(Rational::from_integer(choices(of, chosen))),
            _ => Tree::Operation(Box::new(Operation::Binomial(of, chosen)), At(at)),
        };
        self.carried(Box::new(tree), Form::Plain)
    }
}

/// The product of `of` and of the numbers that are each `step` less.
fn factorial(of: Tree, step: usize, at: usize) -> Tree {
    let value = small(&of).map(|of| (1..=of).rev().step_by(step).product());
    let name = if step == 1 { FACTORIAL } else { DOUBLE_FACTORIAL };
    match value {
        Some(value) => Tree::Number(Rational::from_integer(value)),
        None => Tree::Call(Name::plain(name), Box::new(of), At(at)),
    }
}

/// An integer written as one, up to [`LARGEST`].
fn small(tree: &Tree) -> Option<i64> {
    match tree {
        Tree::Number(value) => value.to_integer().filter(|value| (0..=LARGEST).contains(value)),
        _ => None,
    }
}

/// The number of ways to choose; none where there is too little to choose from.
fn choices(of: i64, chosen: i64) -> i64 {
    (0..chosen).fold(1, |ways, n| ways * (of - n) / (n + 1))
}

#[cfg(test)]
mod tests {
    use super::super::read_expression;
    use super::super::spelled::{check, names, refuse};

    #[test]
    fn factorials_and_binomials() {
        check(&[
            ("3! + 0! + 20!", "(+ 6 1 2432902008176640000)"),
            ("7!! - 6!!", "(+ 105 (- 48))"),
            (r"\binom{5}{2} \binom52 \tbinom{20}{10}", "(* 10 10 184756)"),
            (r"\dbinom{2}{3}", "0"),
            ("2n!", r"(* 2 <\factorial n>)"),
            ("(2n)!", r"<\factorial (* 2 n)>"),
            (r"k!\,(n-k)!", r"(* <\factorial k> <\factorial (+ n (- k))>)"),
            ("(2n-1)!!", r"<\doublefactorial (+ (* 2 n) (- 1))>"),
            ("n!^2", r"(^ <\factorial n> 2)"),
            ("x^{n!}", r"(^^ x <\factorial n>)"),
            ("-n_1! = ".trim_end_matches(" = "), r"(- <\factorial n_1>)"),
            ("((n)!)!", r"<\factorial <\factorial n>>"),
            (r"\frac{1}{n!}", r"(/ 1 <\factorial n>)"),
            ("21!", r"<\factorial 21>"),
            (r"|n!|", r"<\operatorname{abs} <\factorial n>>"),
        ]);
        for tex in [
            "2n! (2n)! (n!)^2",
            "n!^{-k}",
            "21! x a (2n - 1)!!",
            r"\binom{n + 1}{k - 1}^2 x",
            "((n)!)!",
            "(x^-)! (2.5)! [a(b + c)]!",
        ] {
            let tree = read_expression(tex, &names()).unwrap();
            assert_eq!(read_expression(&tree.to_string(), &names()).unwrap(), tree, "{tex}");
        }
        refuse(&[
            ("x^n!", "this factorial"),
            ("2^n!", "this factorial"),
            ("n!!!", "this factorial"),
            (r"\sin(x)!", "this factorial"),
            ("f(t)!", "this factorial"),
            ("|x|!", "this factorial"),
            (r"\frac{a}{b}!", "this factorial"),
            (r"\binom{n}{k}!", "this factorial"),
            (r"\ln n!", "write brackets around the argument"),
            (r"\ln 3!", "write brackets around the argument"),
            ("!", "a factor"),
        ]);
        let error = super::super::read("a != b", &names()).unwrap_err();
        assert!(
            error.to_string().contains(r"`!=` can be read as a! = or as a \neq"),
            "{error}"
        );
    }
}
