//! Conditions on symbols: relations, integers, intervals.

use super::error::{Fault, Reason};
use super::reader::Reader;
use super::statement::{Statement, divided};
use super::token::{Bracket, Kind, Set};
use super::{At, Condition, Equation, Name, Names, Operation, ReadError, Relation, Tree};

/// Reads conditions parted by commas: relations and chains of them, `n \in \mathbb{Z}`, `x \in [a, b)`. An interval
/// gives its two inequalities, an end at infinity none; `x \in \mathbb{R}` gives nothing, for symbols are real, and
/// `z \in \mathbb{C}` nothing where `z` is declared complex.
pub fn read_conditions(tex: &str, names: &Names) -> Result<Vec<Condition>, ReadError> {
    let read = || {
        let statements = divided(tex)?;
        if statements.is_empty() {
            return Err(Fault::new(0, Reason::NoCondition));
        }
        conditions_of(statements, names)
    };
    read().map_err(|fault: Fault| fault.located(tex))
}

/// The conditions that statements say.
pub(super) fn conditions_of(statements: Vec<Statement<'_>>, names: &Names) -> Result<Vec<Condition>, Fault> {
    let mut conditions = Vec::new();
    for statement in statements {
        Reader::new(statement.tokens, names).condition(&mut conditions)?;
    }
    Ok(conditions)
}

impl Reader<'_> {
    fn condition(&mut self, conditions: &mut Vec<Condition>) -> Result<(), Fault> {
        if let Some(about) = self.tokens.iter().find(|token| token.kind == Kind::Approximately) {
            let instead = ": it has no exact meaning in a condition; write the bounds";
            return Err(Fault::unreadable(about.at, about.text, instead));
        }
        let at = self.here();
        let left = *self.sum()?;
        if self.peek().is_none() {
            return Err(Fault::new(at, Reason::NoCondition));
        }
        if self.peek_kind() == Some(Kind::To) {
            let to = self.approached()?;
            let right = Tree::Operation(Box::new(Operation::Approaches(to)), At(at));
            let mut condition = Equation::between(left, right);
            (condition.at, condition.end) = (At(at), At(self.look_back()));
            conditions.push(Condition::Relation(condition));
            return self.finish("the end of the condition");
        }
        if self.take(Kind::Element).is_some() {
            self.membership(at, left, conditions)?;
            return self.finish("the end of the condition");
        }
        let mut equations = Vec::new();
        self.links(at, left, &mut equations)?;
        conditions.extend(equations.into_iter().map(Condition::Relation));
        Ok(())
    }

    /// What follows `element \in`.
    fn membership(&mut self, at: usize, element: Tree, conditions: &mut Vec<Condition>) -> Result<(), Fault> {
        match self.peek_kind() {
            Some(Kind::Set(set)) => {
                self.next += 1;
                if let Some(Kind::Sub | Kind::Sup) = self.peek_kind() {
                    let instead = "write the bound as an inequality";
                    return Err(Fault::unsupported(self.here(), "a set with a script", instead));
                }
                self.is_in(at, set, &element)?;
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
            (
                r"n, m \in \mathbb Z",
                vec!["line 1, column 1: no condition here: write `x > 0`, `x \\in [0, 1]` or `n \\in \\mathbb{Z}`"],
            ),
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
            complex: vec![super::super::symbol::base("z")],
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
