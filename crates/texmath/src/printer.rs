//! Tree -> TeX that reads back to the same tree, given the same [`Names`](super::Names).

use super::argument::may_scale;
use super::command::{ABSOLUTE, CONJUGATE, DOUBLE_FACTORIAL, FACTORIAL, FLOOR};
use super::elementary::Elementary;
use super::nodes::any;
use super::{Case, Condition, Equation, Invariant, Name, Operation, Relation, Series, Tree};
use numbers::Rational;
use std::fmt;

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = match Elementary::by_command(&self.base).and_then(Elementary::operator_name) {
            Some(word) => format!("\\operatorname{{{word}}}"),
            None => self.base.clone(),
        };
        let accented = self
            .accents
            .iter()
            .fold(plain, |inner, accent| format!("{accent}{{{inner}}}"));
        f.write_str(&accented)?;
        if !self.subscript.is_empty() {
            write!(f, "_{}", script(&self.subscript))?;
        }
        for _ in 0..self.primes {
            f.write_str("'")?;
        }
        match self.mark.chars().next() {
            None => Ok(()),
            // Without \text, letters are a power, or might be.
            Some(letter) if letter.is_ascii_alphabetic() => write!(f, "^{{\\text{{{}}}}}", self.mark),
            Some(_) => write!(f, "^{}", script(&self.mark)),
        }
    }
}

/// A script in braces, where it needs them.
fn script(text: &str) -> String {
    let command = text.strip_prefix('\\');
    let letters = |name: &str| name.bytes().all(|byte| byte.is_ascii_alphabetic());
    let single = |text: &str| match text.as_bytes() {
        [byte] => byte.is_ascii_alphanumeric() || b"+-*".contains(byte),
        _ => false,
    };
    match single(text) || command.is_some_and(letters) {
        true => text.to_owned(),
        false => format!("{{{text}}}"),
    }
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Equal => "=",
            Self::NotEqual => "\\neq",
            Self::Less => "<",
            Self::LessOrEqual => "\\leq",
            Self::Greater => ">",
            Self::GreaterOrEqual => "\\geq",
        })
    }
}

impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.left, self.relation, self.right)
    }
}

impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&sum(self))
    }
}

/// A tree where any sum may stand.
fn sum(tree: &Tree) -> String {
    let Tree::Sum(terms) = tree else {
        return signed(tree, true, false);
    };
    let mut out = String::new();
    for (place, term) in terms.iter().enumerate() {
        let mut later = terms.iter().skip(place + 1);
        let is_open = term
            .open_letter()
            .is_some_and(|letter| later.any(|other| other.has_free_letter(letter)));
        out.push_str(&signed(term, out.is_empty(), is_open));
    }
    if out.is_empty() { "0".into() } else { out }
}

/// A term with its sign, as the first of a sum or a later one; in brackets where it would take in what follows.
fn signed(tree: &Tree, first: bool, is_open: bool) -> String {
    let (sign, body) = match tree {
        Tree::Negate(body) => ("-", &**body),
        Tree::PlusMinus(body) => ("\\pm", &**body),
        Tree::MinusPlus(body) => ("\\mp", &**body),
        body => ("+", body),
    };
    let body = if is_open { bracketed(body) } else { term(body) };
    match (first, sign) {
        (true, "+") => body,
        (true, "-") => format!("-{body}"),
        (true, _) => format!("{sign} {body}"),
        (false, _) => format!(" {sign} {body}"),
    }
}

/// A tree where a product may stand.
fn term(tree: &Tree) -> String {
    let factors = match tree {
        Tree::Product(factors) => factors,
        Tree::Operation(operation, _) => return self::operation(operation),
        tree => return factor(tree),
    };
    let mut out = String::new();
    let mut before: Option<&Tree> = None;
    for next in factors {
        let text = factor(next);
        match before {
            None => {}
            Some(before) if needs_dot(before, next, &text) => out.push_str(" \\cdot "),
            Some(_) => out.push(' '),
        }
        out.push_str(&text);
        before = Some(next);
    }
    if out.is_empty() { "1".into() } else { out }
}

/// Whether juxtaposition would read as something else: a number after a factor, a mixed fraction, a call. `text` is the
/// second factor as it is printed.
pub(super) fn needs_dot(before: &Tree, next: &Tree, text: &str) -> bool {
    let digit = text.starts_with(|c: char| c.is_ascii_digit());
    let bracket = text.starts_with(['(', '[']) || text.starts_with("\\{");
    let numbers = |tree: &Tree| match tree {
        Tree::Quotient(above, below, _) => {
            matches!((&**above, &**below), (Tree::Number(_), Tree::Number(_)))
        }
        Tree::Number(_) => true,
        _ => false,
    };
    let mixed = matches!(before, Tree::Number(_)) && numbers(next);
    // a product within one may stand behind a function without its argument, `\frac{a}{f} \cdot (b c)`
    let is_nested = matches!(next, Tree::Product(_)) && matches!(before, Tree::Quotient(..)) && has_symbol(before);
    digit || mixed || (bracket && (may_call(before) || is_nested)) || may_scale(before, next)
}

/// Returns true if a symbol stands in a tree.
fn has_symbol(tree: &Tree) -> bool {
    any(tree, &mut |node| matches!(node, Tree::Symbol(..)))
}

/// Whether a bracket behind `tree` might read as its argument: the printer does not know which names are functions.
fn may_call(tree: &Tree) -> bool {
    match tree {
        Tree::Power(base, ..) | Tree::RealPower(base, ..) => matches!(**base, Tree::Symbol(..)),
        _ => matches!(tree, Tree::Symbol(..)),
    }
}

/// Returns true if a script stands behind it without brackets.
fn is_bare(tree: &Tree) -> bool {
    match tree {
        Tree::Symbol(name, _) => name.mark.is_empty() && name.primes == 0,
        tree => matches!(tree, Tree::Number(_)),
    }
}

pub(super) fn factor(tree: &Tree) -> String {
    match tree {
        Tree::Operation(operation, _) if matches!(&**operation, Operation::Transpose(of) if is_bare(of)) => {
            self::operation(operation)
        }
        Tree::Number(value) => number(value),
        Tree::Symbol(name, _) => name.to_string(),
        Tree::Call(name, argument, _) if is_factorial(name) => factorial(name, argument),
        Tree::Call(name, argument, _) if is_absolute(name) => format!("\\left|{}\\right|", sum(argument)),
        Tree::Call(name, argument, _) if name.base == FLOOR => {
            format!("\\left\\lfloor {}\\right\\rfloor", sum(argument))
        }
        Tree::Call(name, argument, _) if is_conjugate(name) => format!("\\overline{{{}}}", sum(argument)),
        Tree::Call(name, argument, _) => format!("{name}({})", sum(argument)),
        Tree::Partial { of, by, .. } => format!("\\frac{{\\partial {of}}}{{\\partial {by}}}"),
        Tree::Invariant { kind, of, .. } => format!("{}({of})", invariant(*kind)),
        Tree::Quotient(above, below, _) => format!("\\frac{{{}}}{{{}}}", sum(above), sum(below)),
        Tree::Root(radicand, 2, _) => format!("\\sqrt{{{}}}", sum(radicand)),
        Tree::Root(radicand, index, _) => format!("\\sqrt[{index}]{{{}}}", sum(radicand)),
        Tree::Power(base, exponent, _) => power(base, *exponent),
        Tree::RealPower(base, exponent, _) => real_power(base, exponent),
        Tree::Operation(operation, _) if matches!(**operation, Operation::Matrix(_)) => self::operation(operation),
        Tree::Negate(_)
        | Tree::Sum(_)
        | Tree::Product(_)
        | Tree::PlusMinus(_)
        | Tree::MinusPlus(_)
        | Tree::Operation(..) => bracketed(tree),
    }
}

fn operation(operation: &Operation) -> String {
    match operation {
        Operation::Matrix(rows) => {
            let row = |row: &Vec<Tree>| row.iter().map(sum).collect::<Vec<_>>().join(" & ");
            let rows: Vec<String> = rows.iter().map(row).collect();
            format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.join(" \\\\ "))
        }
        Operation::Arguments(parts) => parts.iter().map(sum).collect::<Vec<_>>().join(", "),
        Operation::Determinant(of) => format!("\\det({})", sum(of)),
        Operation::Trace(of) => format!("\\operatorname{{tr}}({})", sum(of)),
        Operation::Root { of, index } => format!("\\sqrt[{}]{{{}}}", sum(index), sum(of)),
        Operation::Transpose(of) if is_bare(of) => format!("{}^{{\\top}}", factor(of)),
        Operation::Transpose(of) => format!("({})^{{\\top}}", sum(of)),
        Operation::Cross(left, right) => format!("{} \\times {}", factor(left), factor(right)),
        Operation::Binomial(of, chosen) => format!("\\binom{{{}}}{{{}}}", sum(of), sum(chosen)),
        Operation::Dot(left, right) => format!("{} \\cdot {}", factor(left), factor(right)),
        Operation::Derivative { of, by, order: 0, at } => format!("[{}]_{{{by} = {}}}", sum(of), sum(at)),
        Operation::Derivative { of, by, order, .. } => {
            let order = if *order == 1 {
                String::new()
            } else {
                format!("^{}", script(&order.to_string()))
            };
            format!("\\frac{{d{order}}}{{d{by}{order}}} {}", bracketed(of))
        }
        Operation::Integral { of, by, limits } => {
            let limits = limits.as_ref();
            let limits = limits.map(|(low, high)| format!("_{{{}}}^{{{}}}", sum(low), sum(high)));
            format!("\\int{} {} \\, d{by}", limits.unwrap_or_default(), term(of))
        }
        Operation::Series {
            kind,
            of,
            index,
            from,
            to,
        } => {
            let sign = match kind {
                Series::Sum => "\\sum",
                Series::Product => "\\prod",
            };
            let of = match (kind, of) {
                (Series::Product, Tree::Product(_)) => bracketed(of),
                _ => term(of),
            };
            format!("{sign}_{{{index} = {}}}^{{{}}} {of}", sum(from), sum(to))
        }
        Operation::Limit { of, by, to } => format!("\\lim_{{{by} \\to {}}} {}", sum(to), term(of)),
        Operation::Order(of, false) => format!("O({})", sum(of)),
        Operation::Order(of, true) => format!("o({})", sum(of)),
        Operation::Approaches(to) => format!("\\to {}", sum(to)),
        Operation::OneSided(to, true) => format!("{}^+", factor(to)),
        Operation::OneSided(to, false) => format!("{}^-", factor(to)),
        Operation::Infinity => "\\infty".to_owned(),
        Operation::Cases(cases) => {
            let cases: Vec<String> = cases.iter().map(case).collect();
            format!("\\begin{{cases}} {} \\end{{cases}}", cases.join(" \\\\ "))
        }
    }
}

fn case(case: &Case) -> String {
    let condition = |condition: &Condition| match condition {
        Condition::Relation(relation) => relation.to_string(),
        Condition::Integer(tree) => format!("{} \\text{{ even}}", sum(&twice(tree))),
    };
    let conditions: Vec<String> = case.conditions.iter().map(condition).collect();
    match conditions.is_empty() {
        true => format!("{} & \\text{{otherwise}}", sum(&case.value)),
        false => format!("{} & {}", sum(&case.value), conditions.join(", ")),
    }
}

/// What is said to be even where half of it is an integer.
pub(super) fn twice(half: &Tree) -> Tree {
    match half {
        Tree::Quotient(above, ..) => (**above).clone(),
        tree => tree.clone(),
    }
}

fn power(base: &Tree, exponent: i32) -> String {
    let exponent = script(&exponent.to_string());
    let before_argument = !exponent.starts_with("{-");
    match base {
        Tree::Number(_) | Tree::Root(..) => format!("{}^{exponent}", factor(base)),
        Tree::Call(name, ..) if is_absolute(name) || is_conjugate(name) || name.base == FLOOR => {
            format!("{}^{exponent}", factor(base))
        }
        Tree::Symbol(name, _) if name.mark.is_empty() && name.primes == 0 => {
            format!("{name}^{exponent}")
        }
        Tree::Call(name, argument, _)
            if before_argument && name.mark.is_empty() && name.primes == 0 && !is_factorial(name) =>
        {
            format!("{name}^{exponent}({})", sum(argument))
        }
        base => format!("{}^{exponent}", bracketed(base)),
    }
}

fn real_power(base: &Tree, exponent: &Tree) -> String {
    let mut text = sum(exponent);
    if matches!(base, Tree::Symbol(..)) && text.len() > 1 && text.bytes().all(|byte| byte.is_ascii_alphabetic()) {
        // Without the sign such a run of letters is a mark, or might be.
        text.insert(0, '+');
    }
    let exponent = script(&text);
    match base {
        Tree::Number(_) | Tree::Root(..) => format!("{}^{exponent}", factor(base)),
        Tree::Call(name, ..) if is_absolute(name) || is_conjugate(name) || name.base == FLOOR => {
            format!("{}^{exponent}", factor(base))
        }
        Tree::Symbol(name, _) if name.mark.is_empty() && name.primes == 0 => format!("{name}^{exponent}"),
        base => format!("{}^{exponent}", bracketed(base)),
    }
}

/// Whether this is the absolute value, which prints as bars.
fn is_absolute(name: &Name) -> bool {
    name.base == ABSOLUTE
}

/// Whether this is the conjugate, which prints as a line.
fn is_conjugate(name: &Name) -> bool {
    name.base == CONJUGATE
}

/// Whether this is a factorial, which prints behind its argument.
fn is_factorial(name: &Name) -> bool {
    name.base == FACTORIAL || name.base == DOUBLE_FACTORIAL
}

fn factorial(name: &Name, argument: &Tree) -> String {
    let sign = if name.base == FACTORIAL { "!" } else { "!!" };
    match argument {
        Tree::Symbol(of, _) if of.mark.is_empty() && of.primes == 0 => format!("{of}{sign}"),
        Tree::Number(value) if value.to_decimal().is_some() => format!("{}{sign}", number(value)),
        argument => format!("{}{sign}", bracketed(argument)),
    }
}

/// `tree` between brackets that differ from those within.
fn bracketed(tree: &Tree) -> String {
    let inner = sum(tree);
    let (open, close) = brackets(&inner);
    format!("{open}{inner}{close}")
}

/// Brackets around what prints so, that differ from those within.
pub(super) fn brackets(inner: &str) -> (&'static str, &'static str) {
    match (inner.contains('('), inner.contains('[')) {
        (true, false) => ("[", "]"),
        (_, true) if !inner.contains("\\{") => ("\\{", "\\}"),
        _ => ("(", ")"),
    }
}

pub(super) fn invariant(kind: Invariant) -> &'static str {
    match kind {
        Invariant::Trace => "Tr",
        Invariant::Determinant => "Det",
    }
}

/// A decimal where there is a finite one; the reader makes no other numbers.
fn number(value: &Rational) -> String {
    match value.to_decimal() {
        Some(decimal) if decimal.starts_with('-') => format!("({decimal})"),
        Some(decimal) => decimal,
        None => format!("\\frac{{{}}}{{{}}}", value.0.numerator(), value.0.denominator()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::spelled::names;
    use super::super::{read, read_expression};

    #[test]
    fn a_transpose_in_a_product_is_read_again() {
        for tex in [r"r A^\top", r"r 0.26^\mathrm{T}", r"A_1^{\top} A", r"2 A^\top"] {
            let tree = read_expression(tex, &names()).unwrap();
            let printed = tree.to_string();
            assert_eq!(read_expression(&printed, &names()).unwrap(), tree, "{printed}");
        }
    }

    #[test]
    fn prints_what_an_author_would() {
        for (tex, wanted) in [
            (r"\dot Z_{1+k}", r"\dot{Z}_{k+1}"),
            ("r_{B}T_{1}", "r_B T_1"),
            (r"a-(b-(c+d))", "a - [b - (c + d)]"),
            (r"1/2 \cdot T_1", r"\frac{1}{2} T_1"),
            ("2 \\cdot 3 \\cdot x_1 \\cdot 2", r"2 \cdot 3 x_1 \cdot 2"),
            (r"2 \cdot \frac12", r"2 \cdot \frac{1}{2}"),
            (r"r_B\cdot(a+b)(c+d)", r"r_B \cdot (a + b) (c + d)"),
            (r"\left(F_1(t)\right)^2", "F_1^2(t)"),
            ("(F_1(t))^{-1}", "[F_1(t)]^{-1}"),
            (r"(\frac a b)^2", r"(\frac{a}{b})^2"),
            (r"(Z_k^-)^2", "(Z_k^-)^2"),
            ("0.50 x", "0.5 x"),
            (r"\partial a/\partial b", r"\frac{\partial a}{\partial b}"),
            (r"[\operatorname{tr}(DP)]^2 - 4\det DP", "[Tr(DP)]^2 - 4 Det(DP)"),
            (r"-(\pm (-a))", r"-[\pm (-a)]"),
            (r"|a - b|^2", r"\left|a - b\right|^2"),
            (r"f \lvert x \rvert^n", r"f \left|x\right|^n"),
            (r"\sqrt[3]{x}^{1/3}", r"\sqrt[3]{x}^{\frac{1}{3}}"),
            ("x^{a b}", "x^{a b}"),
            ("x^{+eta}", "x^{+eta}"),
            ("e^{eta}", "e^{+eta}"),
            ("e^{-a t}", "e^{-a t}"),
            ("(Z_k^-)^n", "(Z_k^-)^n"),
            (r"(\cos(x))^{-n}", r"[\cos(x)]^{-n}"),
            ("x^n (a + b)", r"x^n \cdot (a + b)"),
            (r"\operatorname{sgn}(x)^2", r"\operatorname{sgn}^2(x)"),
            (r"\sin(n + 1) \cdot x", r"\sin(n + 1) \cdot x"),
            (r"\sin 18^\circ", r"\sin(\frac{18 \pi}{180})"),
            (r"\log_a x \cdot b", r"\frac{\ln(x)}{\ln(a)} b"),
            (r"(2n)! (n + 1)!!", r"(2 n)! (n + 1)!!"),
            (r"\mathcal L \dddot x", r"\mathcal{L} \dddot{x}"),
            (r"2π²", r"2 \pi^2"),
        ] {
            let tree = read_expression(tex, &names()).unwrap();
            assert_eq!(tree.to_string(), wanted, "{tex}");
            assert_eq!(read_expression(wanted, &names()).unwrap(), tree, "{tex}");
        }
        let equations = read("-d&=a=b", &names()).unwrap();
        let printed: Vec<String> = equations.iter().map(ToString::to_string).collect();
        assert_eq!(printed, ["-d = a", "a = b"]);
    }
}
