//! Conditions on symbols: relations, integers, intervals.

use super::error::{Fault, Reason};
use super::reader::Reader;
use super::shorthand::Plain;
use super::statement::{Statement, divided};
use super::token::{Bracket, Kind, Set};
use super::{At, Condition, Doubts, Equation, Name, Names, Operation, ReadError, Relation, Tree};
use numbers::{Field, Rational};

/// Reads conditions parted by commas: relations and chains of them, `n \in \mathbb{Z}`, `x \in [a, b)`. An interval
/// gives its two inequalities, an end at infinity none; `x \in \mathbb{R}` gives nothing, for symbols are real, and
/// `z \in \mathbb{C}` nothing where `z` is declared complex. What is said of the last of a list of symbols, as in
/// `m, n \ge 0`, is said of each; `(x, y) \ne (0, 0)` of real numbers says that their differences are not all 0.
pub fn read_conditions(tex: &str, names: &Names) -> Result<Vec<Condition>, ReadError> {
    let read = || {
        let plain = Plain::of(tex, names);
        let statements = divided(&plain.text, &plain)?;
        if statements.is_empty() {
            return Err(Fault::new(0, Reason::NoCondition));
        }
        conditions_of(statements, names)
    };
    read().map_err(|fault: Fault| fault.located(tex))
}

/// The conditions that statements say.
pub(super) fn conditions_of(statements: Vec<Statement<'_>>, names: &Names) -> Result<Vec<Condition>, Fault> {
    let (mut conditions, mut listed) = (Vec::new(), Listed::default());
    for statement in statements {
        let mut reader = Reader::new(statement.tokens, names);
        reader.condition(&mut listed, &mut conditions)?;
        reader.has_one_extent()?;
    }
    match listed.first {
        Some(at) => Err(Fault::new(at, Reason::NoCondition)),
        None => Ok(conditions),
    }
}

/// Symbols before a comma, of which the next condition speaks too, and where the first of them stands.
#[derive(Default)]
struct Listed {
    first: Option<usize>,
    symbols: Vec<Tree>,
}

impl Listed {
    /// Says of each what the conditions say of a symbol.
    fn share(&mut self, said: &Tree, conditions: &mut Vec<Condition>, from: usize) {
        let of = |tree: &Tree, symbol: &Tree| if tree == said { symbol.clone() } else { tree.clone() };
        let own: Vec<Condition> = conditions.iter().skip(from).cloned().collect();
        for symbol in std::mem::take(&mut self.symbols) {
            conditions.extend(own.iter().map(|condition| match condition {
                Condition::Integer(tree) => Condition::Integer(of(tree, &symbol)),
                Condition::Relation(relation) => Condition::Relation(Equation {
                    left: of(&relation.left, &symbol),
                    right: of(&relation.right, &symbol),
                    ..relation.clone()
                }),
            }));
        }
        self.first = None;
    }
}

impl Reader<'_> {
    fn condition(&mut self, listed: &mut Listed, conditions: &mut Vec<Condition>) -> Result<(), Fault> {
        if let Some(about) = self.tokens.iter().find(|token| token.kind == Kind::Approximately) {
            let instead = ": it has no exact meaning in a condition; write the bounds";
            return Err(Fault::unreadable(about.at, about.text, instead));
        }
        let at = self.here();
        if listed.first.is_none() && self.is_tuple() {
            return self.between_tuples(at, conditions);
        }
        let left = *self.sum()?;
        let is_symbol = matches!(left, Tree::Symbol(..));
        if self.peek().is_none() && is_symbol {
            listed.first.get_or_insert(at);
            listed.symbols.push(left);
            return Ok(());
        }
        if self.peek().is_none() || (listed.first.is_some() && !is_symbol) {
            return Err(Fault::new(listed.first.unwrap_or(at), Reason::NoCondition));
        }
        let (from, said) = (conditions.len(), left.clone());
        if matches!(self.peek_kind(), Some(Kind::To(_))) {
            let to = self.approached()?;
            let right = Tree::Operation(Box::new(Operation::Approaches(to)), At(at));
            let mut condition = Equation::between(left, right);
            (condition.at, condition.end) = (At(at), At(self.look_back()));
            conditions.push(Condition::Relation(condition));
            self.finish("the end of the condition")?;
        } else if self.take(Kind::Element).is_some() {
            self.membership(at, left, &listed.symbols, conditions)?;
            self.finish("the end of the condition")?;
        } else {
            let mut equations = Vec::new();
            self.links(at, left, &mut equations)?;
            conditions.extend(equations.into_iter().map(Condition::Relation));
        }
        listed.share(&said, conditions, from);
        Ok(())
    }

    /// Whether a bracket stands next that holds a comma of its own.
    fn is_tuple(&self) -> bool {
        let mut depth = 0_usize;
        for token in self.tokens.iter().skip(self.next) {
            match token.kind {
                Kind::Open(Bracket::Round) | Kind::BraceOpen => depth += 1,
                Kind::Open(_) if depth > 0 => depth += 1,
                Kind::Close(_) | Kind::BraceClose => depth = depth.saturating_sub(1),
                Kind::Comma if depth == 1 => return true,
                _ => {}
            }
            if depth == 0 {
                return false;
            }
        }
        false
    }

    fn tuple(&mut self) -> Result<Vec<Tree>, Fault> {
        let mut entries = Vec::new();
        if self.peek_kind() != Some(Kind::Open(Bracket::Round)) {
            return Err(self.instead_of("`(`"));
        }
        while self.peek_kind() != Some(Kind::Close(Bracket::Round)) {
            self.next += 1;
            entries.push(*self.sum()?);
            if !matches!(self.peek_kind(), Some(Kind::Comma | Kind::Close(Bracket::Round))) {
                return Err(self.instead_of("a comma or `)`"));
            }
        }
        self.next += 1;
        Ok(entries)
    }

    /// `(x, y) = (a, b)`, or that these differ.
    fn between_tuples(&mut self, at: usize, conditions: &mut Vec<Condition>) -> Result<(), Fault> {
        let left = self.tuple()?;
        let relation = match self.peek_kind() {
            Some(Kind::Relation(relation @ (Relation::Equal | Relation::NotEqual))) => relation,
            _ => return Err(self.instead_of("= or \\ne")),
        };
        self.next += 1;
        let other = self.here();
        let right = self.tuple()?;
        self.finish("the end of the condition")?;
        if left.len() != right.len() {
            return Err(Fault::unsupported(
                other,
                "this condition",
                "both sides have as many entries",
            ));
        }
        if !self.names.complex.is_empty() {
            return Err(Fault::unsupported(
                at,
                "this condition",
                "write it for each of the numbers",
            ));
        }
        let (start, end) = (At(at), At(self.look_back()));
        let mut push = |left: Tree, right: Tree| {
            conditions.push(Condition::Relation(Equation {
                relation,
                at: start,
                end,
                ..Equation::between(left, right)
            }));
        };
        let pairs = left.into_iter().zip(right);
        if relation == Relation::Equal {
            pairs.for_each(|(left, right)| push(left, right));
            return Ok(());
        }
        // real numbers are all 0 where the sum of their squares is
        let squares = pairs.map(|(left, right)| {
            let difference = Tree::Sum(vec![left, Tree::Negate(Box::new(right))]);
            Tree::Power(Box::new(difference), 2, start)
        });
        push(Tree::Sum(squares.collect()), Tree::Number(Rational::from_integer(0)));
        Ok(())
    }

    /// What follows `element \in`.
    fn membership(
        &mut self,
        at: usize,
        element: Tree,
        others: &[Tree],
        conditions: &mut Vec<Condition>,
    ) -> Result<(), Fault> {
        match self.peek_kind() {
            Some(Kind::Set(set)) => {
                self.next += 1;
                if let Some(Kind::Sub | Kind::Sup) = self.peek_kind() {
                    let instead = "write the bound as an inequality";
                    return Err(Fault::unsupported(self.here(), "a set with a script", instead));
                }
                for element in others.iter().chain([&element]) {
                    self.is_in(at, set, element)?;
                }
                if set == Set::Integer {
                    conditions.push(Condition::Integer(element));
                }
                Ok(())
            }
            Some(Kind::Open(Bracket::Round | Bracket::Square)) => self.interval(at, element, conditions),
            _ => Err(self.instead_of("an interval, \\mathbb{Z} or \\mathbb{R}")),
        }
    }

    /// Refuses a set of which the symbols say something else: what is in it is declared.
    fn is_in(&self, at: usize, set: Set, element: &Tree) -> Result<(), Fault> {
        let complex = &self.names.complex;
        let is_complex = |name: &Name| complex.contains(name);
        let (agrees, instead) = match (set, element) {
            (Set::Complex, Tree::Symbol(name, _)) => (is_complex(name), "declare the symbol in `complex`"),
            (Set::Complex, _) => (false, "only a symbol may stand here"),
            (Set::Real, Tree::Symbol(name, _)) => (!is_complex(name), "the symbol is declared complex"),
            (Set::Real, _) => (complex.is_empty(), "write that the imaginary part is 0"),
            (Set::Integer, _) => (true, ""),
        };
        match agrees {
            true => Ok(()),
            false => Err(Fault::unsupported(at, "this condition", instead)),
        }
    }

    fn interval(&mut self, at: usize, element: Tree, conditions: &mut Vec<Condition>) -> Result<(), Fault> {
        let closed = self.peek_kind() == Some(Kind::Open(Bracket::Square));
        self.next += 1;
        let low = self.end_of_interval(Kind::Minus)?;
        self.closed_at_infinity(&low, closed)?;
        if self.take(Kind::Comma).is_none() {
            return Err(self.instead_of("a comma between the ends of the interval"));
        }
        let high = self.end_of_interval(Kind::Plus)?;
        let closed_above = match self.peek_kind() {
            Some(Kind::Close(Bracket::Square)) => true,
            Some(Kind::Close(Bracket::Round)) => false,
            _ => return Err(self.instead_of("`)` or `]` at the end of the interval")),
        };
        self.closed_at_infinity(&high, closed_above)?;
        self.next += 1;
        let end = At(self.look_back());
        let at = At(at);
        let mut push = |left, relation, right| {
            conditions.push(Condition::Relation(Equation {
                left,
                relation,
                right,
                at,
                end,
                explains: false,
                doubts: Doubts::default(),
            }));
        };
        let relation = |closed| match closed {
            true => Relation::LessOrEqual,
            false => Relation::Less,
        };
        if let Some(low) = low {
            push(*low, relation(closed), element.clone());
        }
        if let Some(high) = high {
            push(element, relation(closed_above), *high);
        }
        Ok(())
    }

    /// An end of an interval; `None` for infinity, which must have this sign.
    fn end_of_interval(&mut self, sign: Kind) -> Result<Option<Box<Tree>>, Fault> {
        let signed = matches!(self.peek_kind(), Some(Kind::Plus | Kind::Minus));
        let infinite = self.look(usize::from(signed)).map(|token| token.kind) == Some(Kind::Infinity);
        if !infinite {
            return self.sum().map(Some);
        }
        let found = match signed {
            true => self.peek_kind(),
            false => Some(Kind::Plus),
        };
        if found != Some(sign) {
            let instead = "an interval goes from its lower end to its upper one";
            return Err(Fault::unsupported(self.here(), "infinity at this end", instead));
        }
        self.next += 1 + usize::from(signed);
        Ok(None)
    }

    fn closed_at_infinity(&self, end: &Option<Box<Tree>>, closed: bool) -> Result<(), Fault> {
        match (end, closed) {
            (None, true) => {
                let instead = "an interval is open at infinity: write ( or )";
                Err(Fault::unsupported(
                    self.here(),
                    "an interval closed at infinity",
                    instead,
                ))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::spelled::names;
    use super::*;

    fn shown(tex: &str) -> Vec<String> {
        let conditions = match read_conditions(tex, &names()) {
            Ok(conditions) => conditions,
            Err(error) => return vec![error.to_string()],
        };
        let shown = |condition: &Condition| match condition {
            Condition::Relation(equation) => equation.to_string(),
            Condition::Integer(tree) => format!("{tree} integer"),
        };
        conditions.iter().map(shown).collect()
    }

    #[test]
    fn conditions() {
        for (tex, wanted) in [
            (r"x > 0, r_B r_T \neq 1", vec!["x > 0", r"r_B r_T \neq 1"]),
            (r"0 \le u < \pi/2", vec![r"0 \leq u", r"u < \frac{\pi}{2}"]),
            (r"n \in \mathbb{Z}", vec!["n integer"]),
            (r"n, m \in \mathbb Z", vec!["m integer", "n integer"]),
            (r"x, y, u \ge 0", vec![r"u \geq 0", r"x \geq 0", r"y \geq 0"]),
            (r"x, y \in (0, 1]", vec!["0 < y", r"y \leq 1", "0 < x", r"x \leq 1"]),
            (r"(x, y) \ne (0, 1)", vec![r"(x - 0)^2 + (y - 1)^2 \neq 0"]),
            (r"(x, y) = (0, 1)", vec!["x = 0", "y = 1"]),
            (r"x \in \mathbb{R}", vec![]),
            (
                r"x \in \mathbb{R}, 2 k \in \mathbb{Z}, y = 1",
                vec!["2 k integer", "y = 1"],
            ),
            (r"x \in [a, b]", vec![r"a \leq x", r"x \leq b"]),
            (
                r"x \in \left(-1, b + 1\right) \text{ and } y > 0",
                vec!["-1 < x", "x < b + 1", "y > 0"],
            ),
            (r"x \in [a,b)", vec![r"a \leq x", "x < b"]),
            (r"r \in (0, 1]", vec!["0 < r", r"r \leq 1"]),
            (r"x \in (-\infty, b]", vec![r"x \leq b"]),
            (r"x \in [|a|, +\infty)", vec![r"\left|a\right| \leq x"]),
            (r"x \in (-\infty, \infty)", vec![]),
        ] {
            assert_eq!(shown(tex), wanted, "{tex}");
        }
    }

    #[test]
    fn sets_agree_with_what_is_declared() {
        let names = Names {
            complex: vec![crate::Name::plain("z")],
            ..names()
        };
        let read = |tex: &str| read_conditions(tex, &names).map(|conditions| conditions.len());
        assert_eq!((read(r"z \in \mathbb{C}"), read(r"x \in \mathbb{R}")), (Ok(0), Ok(0)));
        for tex in [
            r"z \in \mathbb{R}",
            r"x \in \mathbb{C}",
            r"z x \in \mathbb{R}",
            r"z x \in \mathbb{C}",
        ] {
            assert!(read(tex).is_err(), "{tex}");
        }
    }

    #[test]
    fn what_is_no_condition() {
        for (tex, wanted) in [
            ("", "no condition"),
            ("x", "no condition"),
            ("x, y", "no condition"),
            ("x, y + 1 > 0", "no condition"),
            ("(x, y) > (0, 0)", "= or"),
            ("(x, y) = (0, 0, 0)", "as many entries"),
            (r"x \in", "an interval"),
            (r"x \in y", "an interval"),
            (r"x \in \{1, 2\}", "an interval"),
            (r"x \in \mathbb{R}^+", "write the bound as an inequality"),
            (r"x \in \mathbb{R}_{> 0}", "write the bound as an inequality"),
            (r"n \in \mathbb{N}", "some authors count 0 in"),
            (r"x \in \mathbb{C}", "declare the symbol in `complex`"),
            (r"x \in \mathbb{Q}", r"only \mathbb{Z}, \mathbb{R} and"),
            (r"x \in [0, \infty]", "open at infinity"),
            (r"x \in (\infty, 1)", "infinity at this end"),
            (r"x \in (0, -\infty)", "infinity at this end"),
            (r"x \in (0 1)", "write \\cdot"),
            (r"x \in (0)", "a comma"),
            (r"x \in (0, 1, 2)", "at the end of the interval"),
            (r"x \in (0, 1) y", "the end of the condition"),
            (r"x \notin \mathbb{Z}", r"only \in is read"),
            (r"x \approx 1", "no exact meaning"),
        ] {
            let found = shown(tex).join("; ");
            assert!(found.contains(wanted), "{tex}: {found}");
        }
    }
}
