//! Where one equation of a display ends and the next begins.
//!
//! A comma, a full stop or an "and" outside brackets always divides. A new row or a wide blank divides too,
//! unless one side of it cannot stand alone: `x = a \\ + b` and `x = \\ a` are one equation each.

use super::Relation;
use super::error::Fault;
use super::token::{Bracket, Kind, Token};

/// The tokens of an equation, never none.
pub(super) struct Statement<'a> {
    pub tokens: Vec<Token<'a>>,
    /// Whether it stands behind "where" or "with".
    pub explains: bool,
}

/// What stands between two dividers.
struct Piece<'a> {
    tokens: Vec<Token<'a>>,
    /// Divided from the piece before by more than a row or a blank.
    hard: bool,
    /// Holds a relation, such as `=`, outside brackets.
    related: bool,
    /// Begins behind a `&` or a wide blank, in line with what stands above it.
    aligned: bool,
    /// Begins behind "where" or "with".
    explains: bool,
}

/// The equations, in order.
pub(super) fn statements(tokens: Vec<Token<'_>>) -> Result<Vec<Statement<'_>>, Fault> {
    let mut whole: Vec<Piece<'_>> = Vec::new();
    for piece in pieces(tokens) {
        no_condition(&piece)?;
        match whole.last_mut() {
            Some(before) if continues(before, &piece)? => {
                before.related |= piece.related;
                before.tokens.extend(piece.tokens);
            }
            _ => whole.push(piece),
        }
    }
    let statement = |Piece { tokens, explains, .. }| Statement { tokens, explains };
    Ok(whole.into_iter().map(statement).collect())
}

fn pieces(tokens: Vec<Token<'_>>) -> Vec<Piece<'_>> {
    let fresh = |hard| Piece {
        tokens: Vec::new(),
        hard,
        related: false,
        aligned: false,
        explains: false,
    };
    // which brackets are open: true for those that hold rows
    let (mut done, mut piece, mut open) = (Vec::new(), fresh(true), Vec::<bool>::new());
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        let depth = open.len();
        match token.kind {
            Kind::Column | Kind::Row if open.last() == Some(&true) => {}
            // a column of its own begins where an equation is complete, and no part of it follows
            Kind::Column => {
                let next = tokens.peek().map(|next| next.kind);
                let goes_on = next.is_none_or(|next| {
                    is_relation(next) || next == Kind::Column || (is_operator(next) && next != Kind::Minus)
                });
                piece.aligned |= piece.tokens.is_empty();
                if depth == 0 && piece.related && !ends_open(&piece.tokens) && !goes_on {
                    done.push(std::mem::replace(&mut piece, fresh(true)));
                }
                continue;
            }
            Kind::Open(bracket) => open.push(matches!(bracket, Bracket::Rows(_))),
            Kind::BraceOpen => open.push(false),
            Kind::Close(_) | Kind::BraceClose => {
                open.pop();
            }
            // Within brackets a new row is a blank.
            Kind::Row | Kind::Quad if depth > 0 => continue,
            kind if is_relation(kind) => piece.related |= depth == 0,
            Kind::Comma | Kind::Stop | Kind::And | Kind::Row | Kind::Quad if depth == 0 => {
                let hard = !matches!(token.kind, Kind::Row | Kind::Quad);
                if piece.tokens.is_empty() {
                    piece.hard |= hard;
                } else {
                    done.push(std::mem::replace(&mut piece, fresh(hard)));
                }
                piece.aligned |= token.kind == Kind::Quad;
                piece.explains |= token.kind == Kind::And && token.text != "and";
                continue;
            }
            _ => {}
        }
        piece.tokens.push(token);
    }
    if !piece.tokens.is_empty() {
        done.push(piece);
    }
    done
}

/// Refuses `\text{where } a > 0`: a condition, which would be read as one claim more.
fn no_condition(piece: &Piece<'_>) -> Result<(), Fault> {
    let is_condition = |kind| is_relation(kind) && kind != Kind::Relation(Relation::Equal);
    let mut relations = piece.tokens.iter().filter(|token| is_condition(token.kind));
    match relations.next() {
        Some(token) if piece.explains => {
            let instead = "write it as an `assume` of the entry";
            Err(Fault::unsupported(token.at, "a condition within a formula", instead))
        }
        _ => Ok(()),
    }
}

/// Whether `piece` belongs to the equation `before`.
fn continues(before: &Piece<'_>, piece: &Piece<'_>) -> Result<bool, Fault> {
    if piece.hard {
        return Ok(false);
    }
    let first = first_token(&piece.tokens);
    let operator = first.is_some_and(|token| is_operator(token.kind));
    if ends_open(&before.tokens) || first.is_some_and(|token| is_relation(token.kind)) {
        return Ok(true);
    }
    match first {
        Some(token) if operator && piece.related && (token.kind != Kind::Minus || piece.aligned) => {
            let instead = "end the equation before it with a comma, or give the row no relation";
            let found = format!("a row that starts with {} and has a relation", token.text);
            Err(Fault::ambiguous(token.at, &found, instead))
        }
        _ => Ok(operator && !piece.related),
    }
}

/// The first token that is no part of an empty group.
fn first_token<'a>(tokens: &[Token<'a>]) -> Option<Token<'a>> {
    let mut rest = tokens;
    while let [open, close, tail @ ..] = rest {
        match (open.kind, close.kind) {
            (Kind::BraceOpen, Kind::BraceClose) => rest = tail,
            _ => break,
        }
    }
    rest.first().copied()
}

/// Whether the last token waits for more; the `-` of `Z_k^-` does not.
fn ends_open(tokens: &[Token<'_>]) -> bool {
    let mut rest = tokens;
    while let [head @ .., open, close] = rest
        && (open.kind, close.kind) == (Kind::BraceOpen, Kind::BraceClose)
    {
        rest = head;
    }
    match rest {
        [.., before, last] => {
            let waits = is_operator(last.kind) || is_relation(last.kind);
            waits && !matches!(before.kind, Kind::Sup | Kind::Sub)
        }
        [only] => is_operator(only.kind) || is_relation(only.kind),
        [] => false,
    }
}

fn is_relation(kind: Kind) -> bool {
    matches!(kind, Kind::Relation(_) | Kind::Element | Kind::Approximately)
}

fn is_operator(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Plus | Kind::Minus | Kind::PlusMinus | Kind::MinusPlus | Kind::Times | Kind::Star | Kind::Slash
    )
}

#[cfg(test)]
mod tests {
    use super::super::lexer::lex;
    use super::*;

    fn divided(tex: &str) -> Vec<String> {
        let join = |statement: Statement<'_>| statement.tokens.iter().map(|token| token.text).collect();
        let statements = statements(lex(tex).unwrap()).unwrap();
        statements.into_iter().map(join).collect()
    }

    #[test]
    fn columns_divide_where_an_equation_is_complete() {
        assert_eq!(divided(r"a &= b & c &= d"), ["a=b", "c=d"]);
        assert_eq!(divided(r"a &= b & -c &= d"), ["a=b", "-c=d"]);
        assert_eq!(divided(r"a & = & b \\ & = & c"), ["a=b=c"]);
        assert_eq!(divided(r"a = {} & b & + c"), ["a={}b+c"]);
        assert_eq!(divided(r"f(a & b) &= c"), ["f(ab)=c"]);
    }

    #[test]
    fn divides_at_commas_and_rows() {
        assert_eq!(
            divided(r"a = b, c = d; \qquad e = f \\ g = h \text{and} i=j."),
            ["a=b", "c=d", "e=f", "g=h", "i=j"]
        );
        assert_eq!(divided(r"\lambda_{1,2} = (a \\ + b)"), [r"\lambda_{1,2}=(a+b)"]);
        assert!(divided(r", \\ .").is_empty());
    }

    #[test]
    fn a_condition_is_no_equation() {
        for tex in [
            r"|a| = a \text{ where } a > 0",
            r"a = n b \text{ with } n \in \mathbb{Z}",
        ] {
            assert!(statements(lex(tex).unwrap()).is_err(), "{tex}");
        }
        assert_eq!(
            divided(r"a = b \text{ where } c = d \text{ and } e < f"),
            ["a=b", "c=d", "e<f"]
        );
    }

    #[test]
    fn rows_that_cannot_stand_alone_continue() {
        assert_eq!(divided(r"a = b \\ {}+ c \\ = d"), ["a=b{}+c=d"]);
        assert_eq!(divided(r"a = \\ b + \quad c"), ["a=b+c"]);
        assert_eq!(divided(r"a = Z^- \\ -d = c"), ["a=Z^-", "-d=c"]);
        assert!(statements(lex(r"a &= b \\ &- c = d").unwrap()).is_err());
        assert!(statements(lex(r"a = b \\ + c = d").unwrap()).is_err());
    }
}
