//! Tree -> presentation MathML, as a browser lays it out.

use super::command::{ABSOLUTE, CONJUGATE, DOUBLE_FACTORIAL, FACTORIAL, FLOOR};
use super::printer::{self, brackets, invariant, needs_dot, twice};
use super::{Case, Condition, Equation, Name, Operation, Relation, Series, Tree};
use crate::markup::{Element, Markup, element, empty, text_in};
use std::ptr;

/// Signs that are not seen, by which readers aloud tell a product from a value.
const TIMES: &str = "\u{2062}";
const OF: &str = "\u{2061}";
const DOT: &str = "\u{22c5}";
const MINUS: &str = "\u{2212}";

/// The letters that commands print, as characters.
const LETTERS: [(&str, char); 43] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("vartheta", 'ϑ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("pi", 'π'),
    ("varpi", 'ϖ'),
    ("rho", 'ρ'),
    ("varrho", 'ϱ'),
    ("sigma", 'σ'),
    ("varsigma", 'ς'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Xi", 'Ξ'),
    ("Pi", 'Π'),
    ("Sigma", 'Σ'),
    ("Upsilon", 'Υ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
    ("ell", 'ℓ'),
    ("hbar", 'ℏ'),
    ("imath", 'ı'),
    ("jmath", 'ȷ'),
    ("top", '⊤'),
];

/// The accents, as what stands above; an overline is as wide as what is below it.
const ACCENTS: [(&str, &str); 13] = [
    ("\\dot", "\u{2d9}"),
    ("\\ddot", "\u{a8}"),
    ("\\dddot", "\u{20db}"),
    ("\\ddddot", "\u{20dc}"),
    ("\\hat", "^"),
    ("\\tilde", "~"),
    ("\\vec", "\u{2192}"),
    (OVERLINE, "\u{203e}"),
    ("\\check", "\u{2c7}"),
    ("\\breve", "\u{2d8}"),
    ("\\acute", "\u{b4}"),
    ("\\grave", "`"),
    ("\\mathring", "\u{2da}"),
];
const OVERLINE: &str = "\\overline";

/// The letter that a command prints, if it is one.
pub fn letter(command: &str) -> Option<char> {
    let name = command.strip_prefix('\\')?;
    LETTERS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, letter)| *letter)
}

/// An expression, within a line of text.
pub fn mathml(tree: &Tree) -> Element {
    element("math", Writer { marked: &[] }.sum(tree))
}

/// A name alone.
pub fn mathml_of_name(name: &Name) -> Element {
    element("math", [self::name(name, None)])
}

/// A condition, within a line of text.
pub fn mathml_of_condition(condition: &Condition) -> Element {
    let writer = Writer { marked: &[] };
    let row = match condition {
        Condition::Relation(relation) => writer.equation(relation).concat(),
        Condition::Integer(tree) => row([writer.sum(tree), vec![mo("\u{2208}"), mi("\u{2124}")]]),
    };
    element("math", row)
}

/// Equations as a display: those that go on where the one before ends are one chain. The parts between which a line may
/// break are formulas of their own, for browsers break no formula. `marked` are the trees, by where they are, that a
/// reader is to see at once.
pub fn mathml_display(equations: &[Equation], marked: &[&Tree]) -> Vec<Element> {
    let writer = Writer { marked };
    let mut displays: Vec<Vec<Vec<Markup>>> = Vec::new();
    let mut before: Option<&Equation> = None;
    for equation in equations {
        let mut pieces = writer.equation(equation);
        match displays.last_mut() {
            Some(last) if before.is_some_and(|before| before.right == equation.left) => {
                let left = pieces_of(&equation.left);
                last.extend(pieces.drain(left..));
            }
            _ => displays.push(pieces),
        }
        before = Some(equation);
    }
    let display = |pieces: Vec<Vec<Markup>>| {
        let piece = |piece: Vec<Markup>| element("math", piece).with("displaystyle", "true");
        // a blank is where a line may break
        let pieces = pieces
            .into_iter()
            .flat_map(|own| [Markup::from(" "), piece(own).into()]);
        element("div", pieces.skip(1)).with("class", "display")
    };
    displays.into_iter().map(display).collect()
}

/// The pieces of one side.
fn pieces_of(tree: &Tree) -> usize {
    match tree {
        Tree::Sum(terms) => terms.len(),
        _ => 1,
    }
}

fn mi(text: impl Into<String>) -> Markup {
    text_in("mi", text).into()
}

fn mo(text: impl Into<String>) -> Markup {
    text_in("mo", text).into()
}

fn mn(text: impl Into<String>) -> Markup {
    text_in("mn", text).into()
}

/// A sign between two terms, wherever it stands in its row.
fn infix(text: &str) -> Markup {
    text_in("mo", text).with("form", "infix").into()
}

fn prefix(text: &str) -> Markup {
    text_in("mo", text).with("form", "prefix").into()
}

fn row(parts: impl IntoIterator<Item = Vec<Markup>>) -> Vec<Markup> {
    parts.into_iter().flatten().collect()
}

/// What takes one place of an element.
fn one(mut parts: Vec<Markup>) -> Markup {
    match parts.len() {
        1 => parts.remove(0),
        _ => element("mrow", parts).into(),
    }
}

/// An element over the given parts, each in its place.
fn over(name: &'static str, parts: impl IntoIterator<Item = Vec<Markup>>) -> Markup {
    element(name, parts.into_iter().map(one)).into()
}

/// Elements that are taller than a line.
const TALL: [&str; 5] = ["mfrac", "mtable", "munderover", "munder", "mroot"];

/// A row between brackets, which are as tall as what is in them only where that is taller than a line.
fn fenced(open: &str, inner: Vec<Markup>, close: &str) -> Markup {
    let is_tall = inner.iter().any(|part| part.holds(&TALL));
    let stretchy = if is_tall { "true" } else { "false" };
    let fence = |sign: &str, form: &'static str| -> Vec<Markup> {
        let sign = text_in("mo", sign).with("fence", "true").with("form", form);
        vec![sign.with("stretchy", stretchy).into()]
    };
    one(row([fence(open, "prefix"), inner, fence(close, "postfix")]))
}

/// A letter, a word or a command as an identifier.
fn identifier(base: &str) -> Markup {
    match letter(base) {
        // Greek capitals stand upright, as TeX sets them
        Some(capital) if capital.is_uppercase() => upright(capital),
        Some(letter) => mi(letter),
        None => mi(base.trim_start_matches('\\')),
    }
}

/// A letter in a font that makes it another symbol.
fn in_font(font: &str, base: &str) -> Option<Markup> {
    let mut letters = base.chars();
    let letter = letters.next().filter(|_| letters.next().is_none())?;
    let special = match (font, letter) {
        ("\\mathfrak", letter) => "CℭHℌIℑRℜZℨ".find(letter).map(|_| ("CℭHℌIℑRℜZℨ", letter)),
        (_, letter) => "BℬEℰFℱHℋIℐLℒMℳRℛeℯgℊoℴ"
            .find(letter)
            .map(|_| ("BℬEℰFℱHℋIℐLℒMℳRℛeℯgℊoℴ", letter)),
    };
    let shown = match special {
        Some((pairs, letter)) => pairs.chars().skip_while(|c| *c != letter).nth(1)?,
        None => {
            let start = if font == "\\mathfrak" { 0x1d504 } else { 0x1d49c };
            let place = match letter {
                'A'..='Z' => u32::from(letter) - u32::from('A'),
                'a'..='z' => 26 + u32::from(letter) - u32::from('a'),
                _ => return None,
            };
            char::from_u32(start + place)?
        }
    };
    Some(mi(shown))
}

fn accented(inner: Markup, base: &str, accent: &str) -> Markup {
    if matches!(accent, "\\mathcal" | "\\mathscr" | "\\mathfrak") {
        return in_font(accent, base).unwrap_or(inner);
    }
    let sign = ACCENTS
        .iter()
        .find(|(known, _)| *known == accent)
        .map(|(_, sign)| *sign);
    let sign = text_in("mo", sign.unwrap_or(accent));
    let sign = sign.with("stretchy", if accent == OVERLINE { "true" } else { "false" });
    element("mover", [inner, sign.into()]).with("accent", "true").into()
}

/// A name with its scripts, and perhaps a power.
fn name(name: &Name, power: Option<Vec<Markup>>) -> Markup {
    let plain = identifier(&name.base);
    let accented = name
        .accents
        .iter()
        .fold(plain, |inner, accent| accented(inner, &name.base, accent));
    let mut above: Vec<Markup> = Vec::new();
    if name.primes > 0 {
        above.push(mo("\u{2032}".repeat(usize::from(name.primes))));
    }
    match name.mark.as_str() {
        "" => {}
        "-" => above.push(mo(MINUS)),
        mark if mark.starts_with(|c: char| c.is_ascii_alphabetic()) => above.push(text_in("mtext", mark).into()),
        mark => above.extend(script(mark)),
    }
    above.extend(power.into_iter().flatten());
    scripted(accented, script(&name.subscript), above)
}

fn scripted(base: Markup, below: Vec<Markup>, above: Vec<Markup>) -> Markup {
    match (below.is_empty(), above.is_empty()) {
        (true, true) => base,
        (false, true) => over("msub", [vec![base], below]),
        (true, false) => over("msup", [vec![base], above]),
        (false, false) => over("msubsup", [vec![base], below, above]),
    }
}

/// The text of a subscript, as `k+1`, `1,2`, `\phi k`, `x_i`, `in`.
fn script(text: &str) -> Vec<Markup> {
    let mut parts: Vec<Markup> = Vec::new();
    let mut rest = text;
    let mut is_below = false;
    while let Some(first) = rest.chars().next() {
        let run = |of: fn(char) -> bool, skip: usize| {
            let tail = rest.get(skip..).unwrap_or_default();
            skip + tail.find(|c| !of(c)).unwrap_or(tail.len())
        };
        let length = match first {
            '\\' => run(|c| c.is_ascii_alphabetic(), 1),
            c if c.is_ascii_alphabetic() => run(|c| c.is_ascii_alphabetic(), 0),
            c if c.is_ascii_digit() => run(|c| c.is_ascii_digit() || c == '.', 0),
            c => c.len_utf8(),
        };
        let (token, tail) = rest.split_at(length);
        rest = tail;
        let part = match first {
            ' ' => continue,
            '_' => {
                is_below = true;
                continue;
            }
            '\\' if token == "\\infty" => mi("\u{221e}"),
            c if c == '\\' || c.is_ascii_alphabetic() => identifier(token),
            c if c.is_ascii_digit() => mn(token),
            '-' => mo(MINUS),
            '\'' => mo("\u{2032}"),
            _ => mo(token),
        };
        match (std::mem::take(&mut is_below), parts.pop()) {
            (true, Some(base)) => parts.push(over("msub", [vec![base], vec![part]])),
            (_, before) => parts.extend(before.into_iter().chain([part])),
        }
    }
    parts
}

fn relation(relation: Relation) -> &'static str {
    match relation {
        Relation::Equal => "=",
        Relation::NotEqual => "\u{2260}",
        Relation::Less => "<",
        Relation::LessOrEqual => "\u{2264}",
        Relation::Greater => ">",
        Relation::GreaterOrEqual => "\u{2265}",
    }
}

struct Writer<'a> {
    marked: &'a [&'a Tree],
}

impl Writer<'_> {
    /// The row of a tree, in an element of its own where it is marked.
    fn seen(&self, tree: &Tree, row: Vec<Markup>) -> Vec<Markup> {
        match self.marked.iter().any(|marked| ptr::eq(*marked, tree)) {
            true => vec![element("mrow", row).with("class", "changed").into()],
            false => row,
        }
    }

    /// Both sides, in pieces between which a line may break: the first begins with the left side, each other one with a
    /// sign.
    fn equation(&self, equation: &Equation) -> Vec<Vec<Markup>> {
        let mut pieces = self.pieces(&equation.left, None);
        pieces.extend(self.pieces(&equation.right, Some(infix(relation(equation.relation)))));
        pieces
    }

    fn pieces(&self, tree: &Tree, sign: Option<Markup>) -> Vec<Vec<Markup>> {
        let is_marked = self.marked.iter().any(|marked| ptr::eq(*marked, tree));
        let mut pieces = match tree {
            Tree::Sum(terms) if !is_marked && !terms.is_empty() => self.terms(terms),
            tree => vec![self.sum(tree)],
        };
        if let (Some(sign), Some(first)) = (sign, pieces.first_mut()) {
            first.insert(0, sign);
        }
        pieces
    }

    fn terms(&self, terms: &[Tree]) -> Vec<Vec<Markup>> {
        let term = |(place, term)| self.seen(term, self.signed(term, place == 0));
        terms.iter().enumerate().map(term).collect()
    }

    /// A tree where any sum may stand.
    fn sum(&self, tree: &Tree) -> Vec<Markup> {
        self.seen(tree, self.plain_sum(tree))
    }

    fn plain_sum(&self, tree: &Tree) -> Vec<Markup> {
        match tree {
            Tree::Sum(terms) if terms.is_empty() => vec![mn("0")],
            Tree::Sum(terms) => self.terms(terms).concat(),
            tree => self.signed(tree, true),
        }
    }

    /// A term with its sign, as the first of a sum or a later one.
    fn signed(&self, tree: &Tree, first: bool) -> Vec<Markup> {
        let sign = if first { prefix } else { infix };
        let (sign, body) = match tree {
            Tree::Negate(body) => (Some(sign(MINUS)), body),
            Tree::PlusMinus(body) => (Some(sign("\u{b1}")), body),
            Tree::MinusPlus(body) => (Some(sign("\u{2213}")), body),
            body => {
                let sign = (!first).then(|| infix("+"));
                return row([sign.into_iter().collect(), self.term(body)]);
            }
        };
        row([sign.into_iter().collect(), self.seen(body, self.term(body))])
    }

    /// A tree where a product may stand.
    fn term(&self, tree: &Tree) -> Vec<Markup> {
        let factors = match tree {
            Tree::Product(factors) if factors.is_empty() => return vec![mn("1")],
            Tree::Product(factors) => factors,
            Tree::Operation(operation, _) => return self.operation(operation),
            tree => return vec![self.factor(tree)],
        };
        let mut parts = Vec::new();
        let mut before: Option<&Tree> = None;
        for next in factors {
            if let Some(before) = before {
                parts.push(mo(if needs_dot(before, next, &printer::factor(next)) {
                    DOT
                } else {
                    TIMES
                }));
            }
            parts.extend(self.seen(next, vec![self.factor(next)]));
            before = Some(next);
        }
        parts
    }

    fn factor(&self, tree: &Tree) -> Markup {
        match tree {
            Tree::Number(value) => match value.to_decimal() {
                Some(decimal) => mn(decimal),
                None => {
                    let parts = [value.0.numerator().to_string(), value.0.denominator().to_string()];
                    over("mfrac", parts.map(|part| vec![mn(part)]))
                }
            },
            Tree::Symbol(own, _) => name(own, None),
            Tree::Call(function, argument, _) => self.call(function, argument, None),
            Tree::Partial { of, by, .. } => {
                let part = |own: &Name| vec![mi("\u{2202}"), name(own, None)];
                over("mfrac", [part(of), part(by)])
            }
            Tree::Invariant { kind, of, .. } => {
                let argument = fenced("(", vec![name(of, None)], ")");
                one(vec![mi(invariant(*kind)), mo(OF), argument])
            }
            Tree::Quotient(above, below, _) => over("mfrac", [self.sum(above), self.sum(below)]),
            Tree::Root(radicand, 2, _) => over("msqrt", [self.sum(radicand)]),
            Tree::Root(radicand, index, _) => over("mroot", [self.sum(radicand), vec![mn(index.to_string())]]),
            Tree::Power(base, exponent, _) => {
                let digits = mn(exponent.unsigned_abs().to_string());
                let sign = (*exponent < 0).then(|| prefix(MINUS));
                let is_positive = *exponent >= 0;
                self.power(base, sign.into_iter().chain([digits]).collect(), is_positive)
            }
            Tree::RealPower(base, exponent, _) => self.power(base, self.sum(exponent), false),
            Tree::Operation(operation, _) if matches!(**operation, Operation::Matrix(_)) => {
                one(self.operation(operation))
            }
            Tree::Negate(_)
            | Tree::Sum(_)
            | Tree::Product(_)
            | Tree::PlusMinus(_)
            | Tree::MinusPlus(_)
            | Tree::Operation(..) => self.bracketed(tree),
        }
    }

    /// A function's value; a power of it stands before the argument.
    fn call(&self, function: &Name, argument: &Tree, power: Option<Vec<Markup>>) -> Markup {
        let inner = || self.sum(argument);
        match function.base.as_str() {
            ABSOLUTE => fenced("|", inner(), "|"),
            FLOOR => fenced("\u{230a}", inner(), "\u{230b}"),
            CONJUGATE => {
                let line = text_in("mo", "\u{203e}").with("stretchy", "true");
                over("mover", [inner(), vec![line.into()]])
            }
            FACTORIAL | DOUBLE_FACTORIAL => {
                let sign = if function.base == FACTORIAL { "!" } else { "!!" };
                let of = match argument {
                    Tree::Symbol(of, _) if of.mark.is_empty() && of.primes == 0 => inner(),
                    Tree::Number(value) if value.to_decimal().is_some() => inner(),
                    argument => self.seen(argument, vec![self.bracketed(argument)]),
                };
                one(row([of, vec![mo(sign)]]))
            }
            _ => one(vec![name(function, power), mo(OF), fenced("(", inner(), ")")]),
        }
    }

    fn power(&self, base: &Tree, exponent: Vec<Markup>, before_argument: bool) -> Markup {
        let is_plain = |name: &Name| name.mark.is_empty() && name.primes == 0;
        let own = match base {
            Tree::Symbol(symbol, _) if is_plain(symbol) => {
                // the script of the name and the power stand above each other
                let whole = vec![name(symbol, Some(exponent))];
                return one(self.seen(base, whole));
            }
            Tree::Call(function, argument, _) if before_argument && is_plain(function) && is_prefix(function) => {
                return self.call(function, argument, Some(exponent));
            }
            Tree::Number(_) | Tree::Root(..) => self.factor(base),
            Tree::Call(function, ..) if [ABSOLUTE, CONJUGATE].contains(&function.base.as_str()) => self.factor(base),
            base => self.bracketed(base),
        };
        over("msup", [self.seen(base, vec![own]), exponent])
    }

    /// The tree between brackets that differ from those within.
    fn bracketed(&self, tree: &Tree) -> Markup {
        let (open, close) = brackets(&tree.to_string());
        let sign = |bracket: &'static str| bracket.trim_start_matches('\\');
        fenced(sign(open), self.plain_sum(tree), sign(close))
    }

    fn bracketed_part(&self, tree: &Tree) -> Vec<Markup> {
        self.seen(tree, vec![self.bracketed(tree)])
    }

    /// A part of an operation that binds it as a product would.
    fn part(&self, tree: &Tree) -> Vec<Markup> {
        self.seen(tree, self.term_in_operation(tree))
    }

    fn term_in_operation(&self, tree: &Tree) -> Vec<Markup> {
        match tree {
            Tree::Operation(..) | Tree::Product(_) => self.term(tree),
            tree => vec![self.factor(tree)],
        }
    }

    fn operation(&self, operation: &Operation) -> Vec<Markup> {
        let factor = |tree: &Tree| self.seen(tree, vec![self.factor(tree)]);
        let function = |name: &str, of: &Tree| vec![mi(name), mo(OF), fenced("(", self.sum(of), ")")];
        match operation {
            Operation::Matrix(rows) => {
                let cell = |tree: &Tree| element("mtd", self.sum(tree));
                let rows = rows.iter().map(|row| element("mtr", row.iter().map(cell)));
                vec![fenced("(", vec![element("mtable", rows).into()], ")")]
            }
            Operation::Determinant(of) => function("det", of),
            Operation::Arguments(parts) => {
                let parts = parts.iter().enumerate();
                row(parts.flat_map(|(number, part)| {
                    let comma = (number > 0).then(|| vec![infix(",")]);
                    comma.into_iter().chain([self.sum(part)])
                }))
            }
            Operation::Trace(of) => function("tr", of),
            Operation::Order(of, is_little) => function(if *is_little { "o" } else { "O" }, of),
            Operation::Transpose(of) => {
                let base = match of {
                    Tree::Symbol(name, _) if name.mark.is_empty() && name.primes == 0 => factor(of),
                    of => self.bracketed_part(of),
                };
                vec![over("msup", [base, vec![mi("\u{22a4}")]])]
            }
            Operation::Root { of, index } => vec![over("mroot", [self.sum(of), self.sum(index)])],
            Operation::Cross(left, right) => row([factor(left), vec![infix("\u{d7}")], factor(right)]),
            Operation::Binomial(of, chosen) => {
                let stacked = element("mfrac", [self.sum(of), self.sum(chosen)].map(one)).with("linethickness", "0");
                vec![fenced("(", vec![stacked.into()], ")")]
            }
            Operation::Dot(left, right) => row([factor(left), vec![infix(DOT)], factor(right)]),
            Operation::Derivative { of, by, order: 0, at } => {
                let at = row([vec![name(by, None), infix("=")], self.sum(at)]);
                vec![over("msub", [vec![fenced("[", self.sum(of), "]")], at])]
            }
            Operation::Derivative { of, by, order, .. } => {
                let raised = |base: Markup| match order {
                    1 => base,
                    order => over("msup", [vec![base], vec![mn(order.to_string())]]),
                };
                let below = vec![upright("d"), raised(name(by, None))];
                let quotient = over("mfrac", [vec![raised(upright("d"))], below]);
                row([vec![quotient], self.bracketed_part(of)])
            }
            Operation::Integral { of, by, limits } => {
                let sign = mo("\u{222b}");
                let sign = match limits {
                    Some((low, high)) => over("msubsup", [vec![sign], self.sum(low), self.sum(high)]),
                    None => sign,
                };
                let gap = empty("mspace").with("width", "0.17em").into();
                row([vec![sign], self.part(of), vec![gap, upright("d"), name(by, None)]])
            }
            Operation::Series {
                kind,
                of,
                index,
                from,
                to,
            } => {
                let sign = match kind {
                    Series::Sum => "\u{2211}",
                    Series::Product => "\u{220f}",
                };
                let from = row([vec![name(index, None), infix("=")], self.sum(from)]);
                let of = match (kind, of) {
                    (Series::Product, Tree::Product(_)) => self.bracketed_part(of),
                    _ => self.part(of),
                };
                row([vec![over("munderover", [vec![mo(sign)], from, self.sum(to)])], of])
            }
            Operation::Limit { of, by, to } => {
                let to = row([vec![name(by, None), infix("\u{2192}")], self.sum(to)]);
                row([vec![over("munder", [vec![mo("lim")], to])], self.part(of)])
            }
            Operation::Approaches(to) => row([vec![prefix("\u{2192}")], self.sum(to)]),
            Operation::OneSided(to, is_above) => {
                let side = mo(if *is_above { "+" } else { MINUS });
                vec![over("msup", [factor(to), vec![side]])]
            }
            Operation::Infinity => vec![mi("\u{221e}")],
            Operation::Cases(cases) => {
                let rows = cases.iter().map(|case| self.case(case));
                let table = element("mtable", rows)
                    .with("columnalign", "left")
                    .with("class", "cases");
                let brace = text_in("mo", "{").with("fence", "true").with("form", "prefix");
                vec![one(vec![brace.into(), table.into()])]
            }
        }
    }

    fn case(&self, case: &Case) -> Element {
        let condition = |condition: &Condition| match condition {
            Condition::Relation(relation) => self.equation(relation).concat(),
            Condition::Integer(half) => row([self.sum(&twice(half)), vec![text_in("mtext", "\u{a0}even").into()]]),
        };
        let mut conditions: Vec<Markup> = Vec::new();
        for own in &case.conditions {
            if !conditions.is_empty() {
                conditions.push(text_in("mtext", ",\u{a0}").into());
            }
            conditions.extend(condition(own));
        }
        if conditions.is_empty() {
            conditions.push(text_in("mtext", "otherwise").into());
        }
        element(
            "mtr",
            [element("mtd", self.sum(&case.value)), element("mtd", conditions)],
        )
    }
}

/// Whether a function stands before its argument.
fn is_prefix(function: &Name) -> bool {
    ![ABSOLUTE, CONJUGATE, FACTORIAL, DOUBLE_FACTORIAL].contains(&function.base.as_str())
}

fn upright(letter: impl Into<String>) -> Markup {
    text_in("mi", letter).with("mathvariant", "normal").into()
}

#[cfg(test)]
mod tests {
    use super::super::{At, Names, read, read_conditions, read_expression};
    use super::*;
    use numbers::{Field, Rational};
    use proptest::prelude::*;

    fn names() -> Names {
        let name = |base: &str| Name {
            base: base.to_owned(),
            ..Name::default()
        };
        Names {
            functions: vec![name("f")],
            words: vec!["eta".to_owned()],
            matrices: vec![name("DP")],
            ..Names::default()
        }
    }

    /// The MathML without what is the same in all of it.
    fn shown(tex: &str) -> String {
        let tree = read_expression(tex, &names()).unwrap_or_else(|error| panic!("{tex}: {error}"));
        well_formed(&mathml(&tree))
    }

    fn well_formed(math: &Element) -> String {
        let xml = math.to_string();
        let document = roxmltree::Document::parse(&xml).unwrap();
        for node in document.descendants().filter(roxmltree::Node::is_element) {
            let parts = node.children().filter(roxmltree::Node::is_element).count();
            let wanted = match node.tag_name().name() {
                "mfrac" | "msub" | "msup" | "mover" | "munder" | "mroot" => 2,
                "msubsup" | "munderover" => 3,
                "msqrt" => 1,
                _ => parts,
            };
            assert_eq!(parts, wanted, "{xml}");
        }
        let inner = xml.trim_start_matches("<math>").trim_end_matches("</math>").to_owned();
        let inner = inner.replace(" form=\"infix\"", "").replace(" form=\"prefix\"", "");
        inner
            .replace(" form=\"postfix\"", "")
            .replace(" fence=\"true\"", "")
            .replace(" stretchy=\"false\"", "")
    }

    #[test]
    fn each_kind_of_node_has_its_element() {
        for (tex, wanted) in [
            ("0.25", "<mn>0.25</mn>"),
            ("x", "<mi>x</mi>"),
            ("eta", "<mi>eta</mi>"),
            (r"\beta", "<mi>β</mi>"),
            (r"\Delta", "<mi mathvariant=\"normal\">Δ</mi>"),
            ("r_B", "<msub><mi>r</mi><mi>B</mi></msub>"),
            (
                "t_{k+1}",
                "<msub><mi>t</mi><mrow><mi>k</mi><mo>+</mo><mn>1</mn></mrow></msub>",
            ),
            ("x_1^2", "<msubsup><mi>x</mi><mn>1</mn><mn>2</mn></msubsup>"),
            ("x'", "<msup><mi>x</mi><mo>′</mo></msup>"),
            ("Z_k^-", "<msubsup><mi>Z</mi><mi>k</mi><mo>−</mo></msubsup>"),
            (r"U^{\text{imp}}", "<msup><mi>U</mi><mtext>imp</mtext></msup>"),
            (r"\dot{Z}", "<mover accent=\"true\"><mi>Z</mi><mo>˙</mo></mover>"),
            (
                r"\bar g",
                "<mover accent=\"true\"><mi>g</mi><mo stretchy=\"true\">‾</mo></mover>",
            ),
            (r"\mathcal{L}", "<mi>ℒ</mi>"),
            ("-a", "<mo>−</mo><mi>a</mi>"),
            ("a - b", "<mi>a</mi><mo>−</mo><mi>b</mi>"),
            (r"a \pm b \mp c", "<mi>a</mi><mo>±</mo><mi>b</mi><mo>∓</mo><mi>c</mi>"),
            ("a b", "<mi>a</mi><mo>\u{2062}</mo><mi>b</mi>"),
            (r"2 \cdot 3", "<mn>2</mn><mo>⋅</mo><mn>3</mn>"),
            (r"\frac{a}{b}", "<mfrac><mi>a</mi><mi>b</mi></mfrac>"),
            (r"\sqrt{x}", "<msqrt><mi>x</mi></msqrt>"),
            (r"\sqrt[3]{x}", "<mroot><mi>x</mi><mn>3</mn></mroot>"),
            (r"\sqrt[n]{x}", "<mroot><mi>x</mi><mi>n</mi></mroot>"),
            ("x^{-1}", "<msup><mi>x</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>"),
            ("x^a", "<msup><mi>x</mi><mi>a</mi></msup>"),
            (
                "(a + b)^2",
                "<msup><mrow><mo>(</mo><mi>a</mi><mo>+</mo><mi>b</mi><mo>)</mo></mrow><mn>2</mn></msup>",
            ),
            (
                r"\sin^2(x)",
                "<mrow><msup><mi>sin</mi><mn>2</mn></msup><mo>\u{2061}</mo><mrow><mo>(</mo><mi>x</mi><mo>)</mo></mrow></mrow>",
            ),
            (
                "f(t)",
                "<mrow><mi>f</mi><mo>\u{2061}</mo><mrow><mo>(</mo><mi>t</mi><mo>)</mo></mrow></mrow>",
            ),
            ("|x|", "<mrow><mo>|</mo><mi>x</mi><mo>|</mo></mrow>"),
            ("n!", "<mrow><mi>n</mi><mo>!</mo></mrow>"),
            (
                "Tr(DP)",
                "<mrow><mi>Tr</mi><mo>\u{2061}</mo><mrow><mo>(</mo><mi>DP</mi><mo>)</mo></mrow></mrow>",
            ),
            (
                r"\frac{\partial a}{\partial b}",
                "<mfrac><mrow><mi>∂</mi><mi>a</mi></mrow><mrow><mi>∂</mi><mi>b</mi></mrow></mfrac>",
            ),
        ] {
            assert_eq!(shown(tex), wanted, "{tex}");
        }
    }

    #[test]
    fn each_operation_has_its_elements() {
        for (tex, wanted) in [
            (
                r"\begin{pmatrix} a & b \\ c & d \end{pmatrix}",
                "<mtable><mtr><mtd><mi>a</mi></mtd><mtd>",
            ),
            (r"\int_0^1 x \, dx", "<msubsup><mo>∫</mo><mn>0</mn><mn>1</mn></msubsup>"),
            (
                r"\sum_{n=1}^{N} n",
                "<munderover><mo>∑</mo><mrow><mi>n</mi><mo>=</mo><mn>1</mn></mrow><mi>N</mi></munderover>",
            ),
            (r"\prod_{n=1}^{N} n", "<mo>∏</mo>"),
            (
                r"\lim_{x \to 0} x",
                "<munder><mo>lim</mo><mrow><mi>x</mi><mo>→</mo><mn>0</mn></mrow></munder>",
            ),
            (r"\frac{d^2}{dx^2} (x^3)", "<msup><mi>x</mi><mn>2</mn></msup>"),
            (
                r"\begin{cases} a & x > 0 \\ b & \text{otherwise} \end{cases}",
                "<mtext>otherwise</mtext>",
            ),
            (r"\det\begin{pmatrix} a & b \\ c & d \end{pmatrix}", "<mi>det</mi>"),
        ] {
            let found = shown(tex);
            assert!(found.contains(wanted), "{tex}: {found}");
        }
        let x = || Tree::Symbol(super::super::read_name("x", &names()).unwrap(), At(0));
        let y = super::super::read_name("y", &names()).unwrap();
        for (operation, wanted) in [
            (
                Operation::Arguments(vec![x(), Tree::Symbol(y.clone(), At(0))]),
                "<mi>x</mi><mo>,</mo><mi>y</mi>",
            ),
            (Operation::Trace(x()), "<mi>tr</mi>"),
            (Operation::Order(x(), false), "<mi>O</mi>"),
            (Operation::Transpose(x()), "<msup><mi>x</mi><mi>⊤</mi></msup>"),
            (Operation::Cross(x(), x()), "<mo>×</mo>"),
            (Operation::Dot(x(), x()), "<mo>⋅</mo>"),
            (Operation::Binomial(x(), x()), "linethickness=\"0\""),
            (Operation::Approaches(x()), "<mo>→</mo><mi>x</mi>"),
            (Operation::OneSided(x(), true), "<msup><mi>x</mi><mo>+</mo></msup>"),
            (Operation::Infinity, "<mi>∞</mi>"),
            (
                Operation::Derivative {
                    of: x(),
                    by: y,
                    order: 0,
                    at: Tree::Number(Rational::from_ratio(1, 3)),
                },
                "<msub><mrow><mo>[</mo><mi>x</mi><mo>]</mo></mrow><mrow><mi>y</mi><mo>=</mo><mfrac><mn>1</mn><mn>3</mn></mfrac></mrow></msub>",
            ),
        ] {
            let found = well_formed(&mathml(&Tree::Operation(Box::new(operation), At(0))));
            assert!(found.contains(wanted), "{found}");
        }
    }

    #[test]
    fn every_letter_that_is_read_is_a_letter_here() {
        for (name, letter) in LETTERS {
            let command = format!("\\{name}");
            let read = read_expression(&command, &Names::default());
            assert!(matches!(read, Ok(Tree::Symbol(..))), "{command}");
            assert_eq!(super::letter(&command), Some(letter));
        }
    }

    #[test]
    fn a_chain_is_one_display_and_lines_break_before_a_sign() {
        let equations = read("a = b + c = d, \\quad e < f", &Names::default()).unwrap();
        let displays = mathml_display(&equations, &[]);
        let texts: Vec<String> = displays
            .iter()
            .map(|display| {
                let xml = display.to_string();
                let document = roxmltree::Document::parse(&xml).unwrap();
                document
                    .descendants()
                    .filter_map(|node| node.text().filter(|_| node.is_text()))
                    .collect()
            })
            .collect();
        assert_eq!(texts, ["a =b +c =d", "e <f"]);
    }

    #[test]
    fn what_is_marked_is_seen_and_nothing_else() {
        let equations = read("a = b - c d", &Names::default()).unwrap();
        let Tree::Sum(terms) = &equations[0].right else {
            panic!()
        };
        let display = mathml_display(&equations, &[&terms[1]]);
        let xml = display[0].to_string();
        assert_eq!(xml.matches("changed").count(), 1);
        assert!(
            xml.contains("<mrow class=\"changed\"><mo form=\"infix\">−</mo><mi>c</mi>"),
            "{xml}"
        );
    }

    #[test]
    fn conditions_are_typeset() {
        let conditions = read_conditions(r"0 \le u, n \in \mathbb{Z}", &Names::default()).unwrap();
        let shown: Vec<String> = conditions
            .iter()
            .map(|own| well_formed(&mathml_of_condition(own)))
            .collect();
        assert_eq!(
            shown,
            ["<mn>0</mn><mo>≤</mo><mi>u</mi>", "<mi>n</mi><mo>∈</mo><mi>ℤ</mi>"]
        );
    }

    proptest! {
        #[test]
        fn no_name_becomes_an_element(
            base in any::<String>(),
            accent in any::<String>(),
            subscript in any::<String>(),
            mark in any::<String>(),
            primes in 0_u8..3,
        ) {
            let name = Name { base, accents: vec![accent], subscript, mark, primes };
            let known = ["math", "mrow", "mi", "mn", "mo", "mtext", "msub", "msup", "msubsup", "mover"];
            let xml = mathml_of_name(&name).to_string();
            let document = roxmltree::Document::parse(&xml).unwrap();
            for node in document.descendants().filter(roxmltree::Node::is_element) {
                prop_assert!(known.contains(&node.tag_name().name()));
            }
        }
    }
}
