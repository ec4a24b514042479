//! A whole display: its equations, an expression or a name.

use super::conditions::conditions_of;
use super::error::{Fault, Reason};
use super::hidden;
use super::reader::Reader;
use super::shorthand::Plain;
use super::statement::{Stands, Statement, divided, end_at_conditions, is_relation};
use super::token::{Bracket, Kind, Token};
use super::{
    At, Condition, Doubt, DoubtKind, Doubts, Equation, Name, Names, Operation, ReadError, Relation, Series, Tree,
};

/// What a display says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Display {
    /// Its equations and inequalities, in order; a chain `a = b < c` gives `a = b` and `b < c`.
    pub equations: Vec<Equation>,
    /// The inequalities behind a statement and a comma or a wide blank, each of which can be one statement more or a
    /// condition: `\sqrt{x^2} = -x, \quad x < 0`.
    pub beside: Vec<Equation>,
    /// The conditions on its one equation or chain: those behind "for", "if", "when" or `\forall`, inequalities behind "where"
    /// or "with", those in brackets behind a wide blank, and `n \in \mathbb{Z}`.
    pub conditions: Vec<Condition>,
    /// The letters of which it says that it holds for all of them.
    pub for_all: Vec<Name>,
    /// Where the first of the conditions stands, in bytes.
    pub conditions_at: Option<usize>,
}

/// Reads a display with the conditions that stand in it.
///
/// # Errors
/// The first place that cannot be read, or only in two ways: conditions behind more than one statement among them.
pub fn read_display(tex: &str, names: &Names) -> Result<Display, ReadError> {
    read_statements(tex, names).map_err(|fault| fault.located(tex))
}

/// Reads the equations and inequalities of a display without conditions, in order.
///
/// # Errors
/// The first place that cannot be read, or a condition.
pub fn read(tex: &str, names: &Names) -> Result<Vec<Equation>, ReadError> {
    let read = || {
        let display = read_statements(tex, names)?;
        let is_for_all = !display.for_all.is_empty();
        match display.conditions_at.or(is_for_all.then_some(0)) {
            Some(at) => Err(Fault::unsupported(
                at,
                "a condition within a formula",
                "write it as an `assume` of the entry",
            )),
            None => Ok(display.equations.into_iter().chain(display.beside).collect()),
        }
    };
    read().map_err(|fault: Fault| fault.located(tex))
}

/// Reads an expression, without a relation.
pub fn read_expression(tex: &str, names: &Names) -> Result<Tree, ReadError> {
    let read = || {
        let plain = Plain::of(tex, names);
        let mut reader = single(&plain, names)?;
        let tree = reader.sum()?;
        reader.finish("the end of the expression")?;
        reader.has_one_extent().map(|()| *tree)
    };
    let hidden = || Some(Tree::Symbol(hidden::name(tex, names)?, At(0)));
    read().or_else(|fault| hidden().ok_or_else(|| fault.located(tex)))
}

/// Reads one name, such as `\dot{Z}_{k+1}^-`, as a formula would hold it.
pub fn read_name(tex: &str, names: &Names) -> Result<Name, ReadError> {
    let read = || {
        let plain = Plain::of(tex, names);
        let mut reader = single(&plain, names)?;
        let name = reader.full_name()?;
        reader.finish("the end of the name").map(|()| name)
    };
    read().map_err(|fault| fault.located(tex))
}

/// The functions that a display gives by equations `f(x) = ...`, `g(x, y) = ...`, each with its arguments.
pub fn functions_given(tex: &str, names: &Names) -> Vec<(Name, Vec<Name>)> {
    let plain = Plain::of(tex, names);
    let statements = divided(&plain.text, &plain).unwrap_or_default();
    let given = |statement: Statement<'_>| {
        let mut reader = Reader::new(statement.tokens, names);
        let name = reader.full_name().ok()?;
        let (open, kind) = reader.open().filter(|(_, kind)| *kind == Bracket::Round)?;
        let mut arguments = vec![reader.full_name().ok()?];
        reader.skip_empty();
        while reader.take(Kind::Comma).is_some() {
            arguments.push(reader.full_name().ok()?);
            reader.skip_empty();
        }
        reader.close(open, kind).ok()?;
        reader.skip_empty();
        (reader.peek_kind() == Some(Kind::Relation(Relation::Equal))).then_some((name, arguments))
    };
    statements.into_iter().filter_map(given).collect()
}

/// Reads what a display states. Where terms that are not understood are symbols, one that cannot be read is.
fn read_statements(tex: &str, names: &Names) -> Result<Display, Fault> {
    let mut plain = Plain::of(tex, names);
    let first = match statements_of(&plain, names) {
        Err(fault) if names.opaque.is_some() => fault,
        read => return read,
    };
    let mut place = first.place();
    for _ in 0..hidden::MOST {
        let Some(next) = place.and_then(|place| plain.hidden(place)) else {
            break;
        };
        plain = next;
        match statements_of(&plain, names) {
            Ok(display) => return Ok(display),
            Err(fault) => place = fault.place(),
        }
    }
    Err(first)
}

fn statements_of(plain: &Plain<'_>, names: &Names) -> Result<Display, Fault> {
    let (mut display, mut conditions, mut stated) = (Display::default(), Vec::new(), 0);
    let (text, remark) = plain.without_remark();
    let statements = divided(text, plain)?;
    end_at_conditions(&statements)?;
    for statement in statements {
        let (tokens, stands) = (&statement.tokens, statement.stands);
        // Text taken from a PDF carries the number of the display along.
        if stated > 0 && is_number_of_display(tokens) {
            continue;
        }
        if stands == Stands::Condition {
            let first = tokens.first().map(|token| token.at);
            display.conditions_at = display.conditions_at.or(first);
            conditions.push(statement);
            continue;
        }
        let list = match stands {
            Stands::Beside => &mut display.beside,
            _ => &mut display.equations,
        };
        let known = list.len();
        Reader::new(statement.tokens, names).chain(list)?;
        for equation in list.iter_mut().skip(known) {
            equation.explains = stands == Stands::Explains;
        }
        stated += usize::from(stands != Stands::Explains);
    }
    if display.equations.is_empty() {
        return Err(Fault::new(0, Reason::NoEquation));
    }
    if let Some(remark) = remark {
        let kind = DoubtKind::Guess(format!("the remark `{remark}`: is it a condition?"));
        let at = At(plain.source(text.len()));
        let doubt = |equation: &mut Equation| equation.doubts.0.push(Doubt { kind: kind.clone(), at });
        display.equations.iter_mut().chain(&mut display.beside).for_each(doubt);
    }
    if let Some(at) = display.conditions_at.filter(|_| stated > 1) {
        let instead = "give each statement an entry of its own, or write it as an `assume`";
        return Err(Fault::ambiguous(
            at,
            "a condition beside more than one statement",
            instead,
        ));
    }
    // "for all t" alone is no condition
    while let Some(name) = conditions
        .last()
        .and_then(|last: &Statement<'_>| name_alone(&last.tokens, names))
    {
        display.for_all.push(name);
        conditions.pop();
    }
    if conditions.is_empty() {
        display.conditions_at = None;
    }
    for statement in conditions.iter().filter(|statement| statement.quantifies) {
        let first = statement.tokens.split(|token| is_relation(token.kind));
        display
            .for_all
            .extend(first.filter_map(|side| name_alone(side, names)).next());
    }
    display.conditions = conditions_of(conditions, names)?;
    Ok(display)
}

fn name_alone(tokens: &[Token<'_>], names: &Names) -> Option<Name> {
    let mut reader = Reader::new(tokens.to_vec(), names);
    let name = reader.full_name().ok()?;
    reader.finish("the end").is_ok().then_some(name)
}

/// `(23)` or `(20a)`.
fn is_number_of_display(tokens: &[Token<'_>]) -> bool {
    let kinds: Vec<Kind> = tokens.iter().map(|token| token.kind).take(5).collect();
    let (open, close) = (Kind::Open(Bracket::Round), Kind::Close(Bracket::Round));
    kinds == [open, Kind::Number, close] || kinds == [open, Kind::Number, Kind::Letter, close]
}

fn single<'a>(plain: &'a Plain<'_>, names: &'a Names) -> Result<Reader<'a>, Fault> {
    let mut all = divided(&plain.text, plain)?.into_iter();
    let Some(Statement { tokens, .. }) = all.next() else {
        let end = plain.source(plain.text.trim_end().len());
        return Err(Fault::unexpected(end, "nothing", "a formula"));
    };
    match all.next().and_then(|more| more.tokens.first().copied()) {
        Some(token) => Err(Fault::unexpected(token.at, token.text, "the end")),
        None => Ok(Reader::new(tokens, names)),
    }
}

impl Reader<'_> {
    pub(super) fn finish(&self, wanted: &str) -> Result<(), Fault> {
        match self.peek() {
            None => Ok(()),
            Some(token) if matches!(token.kind, Kind::Close(_) | Kind::BraceClose) => {
                let close = format!("`{}`", token.text);
                Err(Fault::new(token.at, Reason::Unopened { close }))
            }
            Some(token) if token.kind == Kind::Element => {
                let instead = ": a set stands only in a condition";
                Err(Fault::unreadable(token.at, token.text, instead))
            }
            Some(_) => Err(self.instead_of(wanted)),
        }
    }

    /// `a = b < c`, appended to `equations`.
    fn chain(&mut self, equations: &mut Vec<Equation>) -> Result<(), Fault> {
        let at = self.here();
        let left = *self.sum()?;
        match self.peek() {
            None => Err(Fault::new(at, Reason::NoEquation)),
            Some(_) => self.links(at, left, equations),
        }
    }

    /// What follows the first side of a chain, which starts at byte `at`.
    pub(super) fn links(&mut self, at: usize, left: Tree, equations: &mut Vec<Equation>) -> Result<(), Fault> {
        self.relations(at, left, equations)?;
        self.finish("a relation, an operator or the end of the equation")
    }

    /// The relations that follow the first side of a chain, which starts at byte `at`.
    pub(super) fn relations(
        &mut self,
        mut at: usize,
        mut left: Tree,
        equations: &mut Vec<Equation>,
    ) -> Result<(), Fault> {
        // where the tokens of the left side start
        let (mut before, known) = (0, equations.len());
        while let Some(kind) = self.peek_kind() {
            let relation = match kind {
                Kind::Relation(relation) => Some(relation),
                Kind::Approximately => None,
                _ => break,
            };
            self.next += 1;
            let side = self.next;
            let start = self.here();
            let right = match may_be_infinite(&left) && self.infinity_ahead().is_some() {
                true => self.limit_or_infinity()?,
                false => *self.sum()?,
            };
            let end = self.look_back();
            let left = std::mem::replace(&mut left, right.clone());
            let Some(relation) = relation else {
                equations.extend(self.approximately([before, side], [&left, &right], at)?);
                (at, before) = (start, side);
                continue;
            };
            before = side;
            equations.push(Equation {
                left,
                relation,
                right,
                at: At(at),
                end: At(end),
                explains: false,
                doubts: Doubts::default(),
            });
            at = start;
        }
        for equation in equations.iter_mut().skip(known) {
            equation.doubts = Doubts(self.doubts.clone());
        }
        Ok(())
    }

    /// Where the token before the next one ends.
    pub(super) fn look_back(&self) -> usize {
        let before = self.next.checked_sub(1).and_then(|last| self.tokens.get(last));
        before.map_or(0, |token| token.end)
    }
}

/// Returns true for a limit, a definite integral and a sum to infinity.
fn may_be_infinite(tree: &Tree) -> bool {
    let Tree::Operation(operation, _) = tree else {
        return false;
    };
    match &**operation {
        Operation::Limit { .. } | Operation::Integral { limits: Some(_), .. } => true,
        Operation::Series { kind, to, .. } => {
            *kind == Series::Sum && matches!(to, Tree::Operation(to, _) if **to == Operation::Infinity)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::reader::DEEPEST;
    use super::super::shorthand::LONGEST;
    use super::super::spelled::names;
    use super::*;

    #[test]
    fn infinity_is_a_side_beside_what_may_be_infinite_alone() {
        for tex in [
            r"\sum_{k=1}^\infty a = \infty",
            r"\int_0^1 a \, db < \infty",
            r"0 < \int_0^\infty a \, db < +\infty",
            r"\lim_{a \to 0} a = -\infty",
            r"b = \lim_{a \to 0} a = {+\infty}",
            r"a = o(a^2) + O(a^3)",
        ] {
            let printed = read(tex, &names()).map(|equations| equations.last().map(ToString::to_string));
            assert!(printed.is_ok(), "{tex}: {printed:?}");
        }
        for tex in [
            r"a = \infty",
            r"\sum_{k=1}^n a < \infty",
            r"\prod_{k=1}^\infty a < \infty",
            r"\lim_{a \to 0} a = 2 \infty",
            r"\lim_{a \to 0} a = \infty + 1",
        ] {
            assert!(read(tex, &names()).is_err(), "{tex}");
        }
    }

    #[test]
    fn displays() {
        let count = |tex: &str| read(tex, &names()).map(|equations| equations.len());
        for (tex, wanted) in [
            ("a = b = c", 2),
            (r"a := b \equiv c.", 2),
            (r"\begin{align} a &= b + \\ &\quad c \\ &= d, \\ -e &= f \end{align}", 3),
            (r"a = b \text{ and } c = d \text{where} e = f;", 3),
            (r"a = b, \quad (23)", 1),
            (r"a = b \qquad (20a)", 1),
            ("x = 2.", 1),
            (r"0 \le u < \frac{\pi}{2}", 2),
            (r"a \leqslant b \\ \geq c \ne d", 3),
            (
                r"a \lt b, c \gt d, e ≤ f, g ≥ h, i ≠ j, k \geqslant l, m \neq n, o \ge p, q > r",
                9,
            ),
        ] {
            assert_eq!(count(tex).map_err(|error| error.to_string()), Ok(wanted), "{tex}");
        }
        for tex in [
            "",
            "a",
            "(23)",
            "a = ",
            "= a",
            "a = b, c",
            "a = b) = c",
            "x = 0,26",
            "a = b \\\\ c",
            "a == b",
            "a <",
            r"a \approx b",
            r"a \sim b",
            r"a \to b",
            r"x \in \mathbb{R}",
        ] {
            assert!(count(tex).is_err(), "{tex}");
        }
        let chain = read(r"0 \le u < v \neq w", &names()).unwrap();
        let printed: Vec<String> = chain.iter().map(ToString::to_string).collect();
        assert_eq!(printed, [r"0 \leq u", "u < v", r"v \neq w"]);
        let equations = read("a = b = c + d.", &names()).unwrap();
        let places: Vec<_> = equations
            .iter()
            .map(|equation| (equation.at.0, equation.end.0))
            .collect();
        assert_eq!(places, [(0, 5), (4, 13)]);
    }

    #[test]
    fn what_is_too_much_is_refused() {
        let names = Names::default();
        for unit in [
            "(",
            "[",
            "{",
            "-",
            r"\frac{",
            r"\sqrt{",
            r"\dot",
            r"\dot{",
            "x^{",
            "x_{",
            r"\cos",
            r"\text{cos}",
            "a/",
            "|",
            r"\left|",
            r"\sqrt[3]{",
            "x^{(",
            "x^{1+",
            "-|a",
        ] {
            let deep = unit.repeat(99_000 / unit.len());
            assert!(read(&deep, &names).is_err(), "{unit}");
            assert!(read_name(&deep, &names).is_err(), "{unit}");
        }
        let nested = |levels: usize| format!("{}a{}", "(".repeat(levels), ")".repeat(levels));
        assert!(read_expression(&nested(DEEPEST - 1), &names).is_ok());
        assert!(read_expression(&nested(DEEPEST + 1), &names).is_err());
        assert!(read_expression(&"a".repeat(LONGEST + 1), &names).is_err());
        assert!(read_expression(&"a".repeat(LONGEST), &names).is_ok());
    }
}
