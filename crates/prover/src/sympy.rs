//! Terms of the kernel as SymPy expressions, in names that readers know from the TeX.

use kernel::{Elementary, Function, Node, Property, Statement, Symbol, Term};
use num_traits::{One, Zero};
use numbers::Rational;
use std::collections::{BTreeMap, BTreeSet};

/// The binding strength of an expression in Python.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

/// A term that has no expression in SymPy that means the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, thiserror::Error)]
pub enum Unprintable {
    #[error("an integral that has a number for its value")]
    Integral,
    #[error("an odd root of what may be negative, which SymPy takes for a complex number")]
    OddRoot,
}

/// The names that a script imports from SymPy where it uses them.
pub const IMPORTED: [&str; 29] = [
    "Function",
    "I",
    "Integer",
    "N",
    "Rational",
    "S",
    "acos",
    "asin",
    "atan",
    "cos",
    "diff",
    "expand",
    "exp",
    "fraction",
    "log",
    "pi",
    "root",
    "simplify",
    "sin",
    "sqrt",
    "symbols",
    "together",
    "Derivative",
    "Symbol",
    "E",
    "oo",
    "zoo",
    "nan",
    "Abs",
];

/// Words that are no names of symbols: of Python, and those that scripts use themselves.
const RESERVED: [&str; 41] = [
    "and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del", "elif", "else", "except",
    "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise",
    "return", "try", "while", "with", "yield", "None", "True", "False", "abs", "print", "claim", "is_zero", "self",
    "real",
];

/// The names that a script has given so far, and how it writes terms.
#[derive(Clone, Debug, Default)]
pub struct Printer {
    symbols: BTreeMap<Symbol, String>,
    functions: BTreeMap<(Function, u32), String>,
    taken: BTreeSet<String>,
}

impl Printer {
    /// The symbols named so far.
    pub fn symbols(&self) -> &BTreeMap<Symbol, String> {
        &self.symbols
    }

    /// The unknown functions named so far, each with the order of its derivative.
    pub fn functions(&self) -> &BTreeMap<(Function, u32), String> {
        &self.functions
    }

    /// The name of a symbol.
    pub fn symbol(&mut self, statement: &Statement, symbol: Symbol) -> String {
        if let Some(name) = self.symbols.get(&symbol) {
            return name.clone();
        }
        let name = self.free(&identifier(statement.terms().symbol_name(symbol)));
        self.symbols.insert(symbol, name.clone());
        name
    }

    /// The name of an unknown function, or of its derivative of this order.
    pub fn function(&mut self, statement: &Statement, function: Function, order: u32) -> String {
        if let Some(name) = self.functions.get(&(function, order)) {
            return name.clone();
        }
        let plain = identifier(statement.terms().function_name(function));
        let name = self.free(&format!("{}{plain}", "d".repeat(order as usize)));
        self.functions.insert((function, order), name.clone());
        name
    }

    /// A name that nothing else has.
    pub fn free(&mut self, wanted: &str) -> String {
        let is_step = wanted
            .strip_prefix('e')
            .is_some_and(|rest| !rest.is_empty() && rest.chars().all(|c| c.is_ascii_digit()));
        let is_reserved = is_step || RESERVED.contains(&wanted) || IMPORTED.contains(&wanted);
        let mut name = match (is_reserved, wanted) {
            (true, "lambda") => "lamda".to_owned(),
            (true, wanted) => format!("{wanted}_"),
            (false, wanted) => wanted.to_owned(),
        };
        while !self.taken.insert(name.clone()) {
            name.push('_');
        }
        name
    }

    /// A term as an expression.
    ///
    /// # Errors
    /// [`Unprintable`] where SymPy has nothing that means the same.
    pub fn expression(&mut self, statement: &Statement, term: Term) -> Result<String, Unprintable> {
        Ok(self.print(statement, term)?.0)
    }

    /// A term as a factor of a product.
    ///
    /// # Errors
    /// As [`Printer::expression`].
    pub fn factor(&mut self, statement: &Statement, term: Term) -> Result<String, Unprintable> {
        self.within(statement, term, Binding::Product)
    }

    /// A term as the base of a power.
    ///
    /// # Errors
    /// As [`Printer::expression`].
    pub fn atom(&mut self, statement: &Statement, term: Term) -> Result<String, Unprintable> {
        self.within(statement, term, Binding::Atom)
    }

    fn within(&mut self, statement: &Statement, term: Term, binding: Binding) -> Result<String, Unprintable> {
        let (text, own) = self.print(statement, term)?;
        let is_negative = text.starts_with('-') && binding > Binding::Sum;
        Ok(match own < binding || is_negative {
            true => format!("({text})"),
            false => text,
        })
    }

    fn print(&mut self, statement: &Statement, term: Term) -> Result<(String, Binding), Unprintable> {
        let terms = statement.terms();
        Ok(match terms.node(term) {
            Node::Number(value) => (number(value), Binding::Atom),
            Node::Pi => ("pi".into(), Binding::Atom),
            Node::Imaginary => ("I".into(), Binding::Atom),
            Node::Bound | Node::Integral { .. } => return Err(Unprintable::Integral),
            Node::Symbol(symbol) => (self.symbol(statement, *symbol), Binding::Atom),
            Node::Sum(parts) => (self.sum(statement, parts)?, Binding::Sum),
            Node::Product(parts) => (self.product(statement, parts)?, Binding::Product),
            Node::Power(base, 1) => self.print(statement, *base)?,
            Node::Power(base, exponent) => {
                let base = self.atom(statement, *base)?;
                (format!("{base}**{exponent}"), Binding::Power)
            }
            Node::Quotient(above, below) => (self.quotient(statement, *above, *below)?, Binding::Product),
            Node::RealPower(base, exponent) => {
                let is_closed = terms.is_closed(*base) && terms.is_closed(*exponent);
                let base = match is_closed {
                    true => format!("S({})", self.expression(statement, *base)?),
                    false => self.atom(statement, *base)?,
                };
                let exponent = self.atom(statement, *exponent)?;
                (format!("{base}**{exponent}"), Binding::Power)
            }
            Node::Elementary(function, of) => (self.elementary(statement, *function, *of)?, Binding::Atom),
            Node::Value(function, order, at) => {
                let name = self.function(statement, *function, *order);
                (format!("{name}({})", self.expression(statement, *at)?), Binding::Atom)
            }
        })
    }

    fn sum(&mut self, statement: &Statement, parts: &[Term]) -> Result<String, Unprintable> {
        let mut text = String::new();
        for part in parts {
            let part = self.within(statement, *part, Binding::Sum)?;
            if part == "0" {
                continue;
            }
            match (text.is_empty(), part.strip_prefix('-')) {
                (true, _) => text = part,
                (false, Some(part)) => text = format!("{text} - {part}"),
                (false, None) => text = format!("{text} + {part}"),
            }
        }
        Ok(if text.is_empty() { "0".to_owned() } else { text })
    }

    /// Factors, with the number among them as `-3*x/2`.
    fn product(&mut self, statement: &Statement, parts: &[Term]) -> Result<String, Unprintable> {
        let (mut scale, mut rest, mut is_closed) = (Rational::one(), Vec::new(), true);
        for part in parts {
            match statement.terms().node(*part) {
                Node::Number(value) => scale *= value.clone(),
                _ => {
                    is_closed &= statement.terms().is_closed(*part);
                    // what stands behind `*` and before `/` is all above the line
                    rest.push(self.within(statement, *part, Binding::Product)?);
                }
            }
        }
        if rest.is_empty() {
            return Ok(number(&scale));
        }
        let is_negative = scale < Rational::zero();
        let size = if is_negative { -scale } else { scale };
        let sign = if is_negative { "-" } else { "" };
        let (above, below) = (size.0.numerator(), size.0.denominator());
        let is_whole = below == &dashu_int::UBig::ONE;
        match (is_whole, is_closed) {
            (true, _) if *above == dashu_int::IBig::ONE => {}
            (true, _) => rest.insert(0, above.to_string()),
            (false, true) => rest.insert(0, number(&size)),
            (false, false) => {
                if *above != dashu_int::IBig::ONE {
                    rest.insert(0, above.to_string());
                }
                return Ok(format!("{sign}{}/{below}", rest.join("*")));
            }
        }
        Ok(format!("{sign}{}", rest.join("*")))
    }

    /// Python divides its own integers with rounding: a quotient of numbers is made SymPy's.
    fn quotient(&mut self, statement: &Statement, above: Term, below: Term) -> Result<String, Unprintable> {
        let terms = statement.terms();
        if let (Node::Number(above), Node::Number(below)) = (terms.node(above), terms.node(below))
            && !below.is_zero()
        {
            return Ok(number(&(above.clone() / below.clone())));
        }
        let is_closed = terms.is_closed(above) && terms.is_closed(below);
        let divisor = self.within(statement, below, Binding::Power)?;
        Ok(match is_closed {
            true => format!("S({})/{divisor}", self.expression(statement, above)?),
            false => format!("{}/{divisor}", self.within(statement, above, Binding::Product)?),
        })
    }

    fn elementary(&mut self, statement: &Statement, function: Elementary, of: Term) -> Result<String, Unprintable> {
        let argument = self.expression(statement, of)?;
        Ok(match function {
            Elementary::Root(2) => format!("sqrt({argument})"),
            Elementary::Root(index) => {
                if index % 2 == 1 && !statement.is_complex() && !is_nonnegative(statement, of) {
                    return Err(Unprintable::OddRoot);
                }
                format!("root({argument}, {index})")
            }
            Elementary::Sin => format!("sin({argument})"),
            Elementary::Cos => format!("cos({argument})"),
            Elementary::Exp => format!("exp({argument})"),
            Elementary::Ln => format!("log({argument})"),
            Elementary::Arcsin => format!("asin({argument})"),
            Elementary::Arccos => format!("acos({argument})"),
            Elementary::Arctan => format!("atan({argument})"),
        })
    }
}

/// Returns true for a number or symbol that is given to be 0 or more.
fn is_nonnegative(statement: &Statement, term: Term) -> bool {
    let is_given = |property| assumption(statement, term, property);
    match statement.terms().node(term) {
        Node::Number(value) => *value >= Rational::zero(),
        Node::Symbol(_) => is_given(Property::Positive) || is_given(Property::NonNegative),
        _ => false,
    }
}

/// Returns true if the property of the term is given as it stands, of no time or index.
fn assumption(statement: &Statement, term: Term, property: Property) -> bool {
    let mut givens = statement.givens().iter().filter(|given| given.law.is_none());
    givens.any(|given| given.property == property && given.term == term)
}

/// The assumptions of SymPy on a symbol.
pub fn assumptions(statement: &mut Statement, symbol: Symbol) -> String {
    let term = statement.terms_mut().symbol(symbol);
    if !statement.is_real(term) {
        return "complex=True".to_owned();
    }
    let mut words = Vec::new();
    if assumption(statement, term, Property::Integer) {
        words.push("integer=True");
    }
    match [Property::Positive, Property::NonNegative, Property::Nonzero]
        .map(|property| assumption(statement, term, property))
    {
        [true, ..] => words.push("positive=True"),
        [_, true, true] => words.push("positive=True"),
        [_, true, false] => words.push("nonnegative=True"),
        [_, _, true] => words.extend(["real=True", "nonzero=True"]),
        _ if words.is_empty() => words.push("real=True"),
        _ => {}
    }
    words.join(", ")
}

/// A number as SymPy is given it beside symbols: what is whole as Python writes it.
pub fn number(value: &Rational) -> String {
    match value.0.denominator() == &dashu_int::UBig::ONE {
        true => value.to_string(),
        false => format!("Rational({}, {})", value.0.numerator(), value.0.denominator()),
    }
}

/// A name for Python, from TeX: `\dot{Z}_{k+1}` is `Zdot_k1`, `\omega` is `omega`.
pub fn identifier(tex: &str) -> String {
    let mut rest: Vec<char> = tex.chars().rev().collect();
    let mut name = words(&mut rest, false);
    while name.contains("__") {
        name = name.replace("__", "_");
    }
    let name = name.trim_end_matches('_');
    match name.chars().next() {
        None => "x_".to_owned(),
        Some(first) if first.is_ascii_alphabetic() => name.to_owned(),
        Some(_) => format!("x{name}"),
    }
}

/// Reads characters, the next one last, up to a closing brace if `in_group`.
fn words(rest: &mut Vec<char>, in_group: bool) -> String {
    let mut name = String::new();
    while let Some(c) = rest.pop() {
        match c {
            '}' if in_group => break,
            '\\' => name.push_str(&command(rest)),
            '{' => name.push_str(&words(rest, true)),
            '_' => name.push_str(&format!("_{}", group(rest))),
            '^' => name.push_str(&mark(rest)),
            '\'' => name.push_str("_prime"),
            '-' => name.push('m'),
            '*' => name.push_str("_star"),
            '(' | ',' => name.push('_'),
            c if c.is_ascii_alphanumeric() => name.push(c),
            _ => {}
        }
    }
    name
}

/// The next group in braces, or the next single character or command.
fn group(rest: &mut Vec<char>) -> String {
    match rest.pop() {
        Some('{') => words(rest, true),
        Some('\\') => command(rest),
        Some(c) => words(&mut vec![c], false),
        None => String::new(),
    }
}

/// The word for a superscript that is no power.
fn mark(rest: &mut Vec<char>) -> String {
    match rest.pop() {
        Some('+') => "_plus".to_owned(),
        Some('-') => "_minus".to_owned(),
        Some(c) => {
            rest.push(c);
            format!("_{}", group(rest))
        }
        None => String::new(),
    }
}

/// The word for a command, whose backslash was read: an accent stands behind its letter.
fn command(rest: &mut Vec<char>) -> String {
    let mut word = String::new();
    while let Some(c) = rest.pop_if(|c| c.is_ascii_alphabetic()) {
        word.push(c);
    }
    match word.as_str() {
        "dot" | "ddot" | "dddot" | "hat" | "tilde" | "vec" | "widehat" | "widetilde" | "check" | "breve" => {
            format!("{}{word}", group(rest))
        }
        "overline" | "bar" => format!("{}bar", group(rest)),
        "underline" => format!("{}under", group(rest)),
        "mathrm" | "mathbf" | "mathit" | "mathcal" | "mathbb" | "operatorname" | "text" | "bm" | "boldsymbol"
        | "mathsf" | "mathfrak" => group(rest),
        "frac" => format!("{}_by_{}", group(rest), group(rest)),
        "partial" => "d".to_owned(),
        _ => word,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_that_readers_know() {
        let names = [
            ("a_1", "a_1"),
            (r"\omega", "omega"),
            ("v_k", "v_k"),
            (r"\dot{Z}_{k+1}", "Zdot_k1"),
            ("t_{k-1}", "t_km1"),
            (r"\overline{g}", "gbar"),
            (r"\dot{Z}_k^+", "Zdot_k_plus"),
            (r"\frac{\partial t_{k+1}}{\partial t_k}", "dt_k1_by_dt_k"),
            ("Tr(DP)", "Tr_DP"),
            ("x'", "x_prime"),
            (r"x^{\text{imp}}", "x_imp"),
            ("{", "x_"),
        ];
        for (tex, name) in names {
            assert_eq!(identifier(tex), name, "{tex}");
        }
    }

    #[test]
    fn no_symbol_takes_a_name_of_python_or_sympy() {
        let mut printer = Printer::default();
        let names = ["lambda", "I", "e1", "claim", "x", "x"].map(|wanted| printer.free(wanted));
        assert_eq!(names, ["lamda", "I_", "e1_", "claim_", "x", "x_"]);
    }

    #[test]
    fn quotients_of_numbers_are_exact() {
        let mut statement = Statement::default();
        let terms = statement.terms_mut();
        let [one, two, three] = [1, 2, 3].map(|n| terms.integer(n));
        let half = terms.quotient(one, two);
        let sum = terms.sum(vec![one, two]);
        let third = terms.quotient(sum, three);
        let scaled = terms.product(vec![half, three]);
        let mut printer = Printer::default();
        let mut of = |term| printer.expression(&statement, term).unwrap();
        assert_eq!(of(half), "Rational(1, 2)");
        assert_eq!(of(third), "S(1 + 2)/3");
        assert_eq!(of(scaled), "3*Rational(1, 2)");
    }
}
