//! Where one equation of a display ends and the next begins.
//!
//! A comma, a full stop or an "and" outside brackets always divides. A new row or a wide blank divides too,
//! unless one side of it cannot stand alone: `x = a \\ + b` and `x = \\ a` are one equation each.
//!
//! Conditions stand behind "for", "if", "when" or `\forall`, in brackets behind a wide blank, or say `n \in \mathbb{Z}`.

use super::Relation;
use super::bars::pair_bars;
use super::error::{Fault, Reason};
use super::lexer::{INTEGERS, lex};
use super::shorthand::{LONGEST, Plain};
use super::token::{Bracket, Kind, Set, Token};

/// The tokens of an equation, never none.
pub(super) struct Statement<'a> {
    pub tokens: Vec<Token<'a>>,
    pub stands: Stands,
    /// Follows a condition, and could be one claim more.
    follows: bool,
    /// Stands behind "for all" or `\forall`.
    pub quantifies: bool,
}

/// What a statement is to the others of its display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stands {
    /// One of what the display states.
    Stated,
    /// Behind "where" or "with".
    Explains,
    /// An inequality before or behind a statement and a comma, a wide blank or in a row of its own: one statement more, or a
    /// condition.
    Beside,
    /// A condition on the others.
    Condition,
}

impl<'a> Piece<'a> {
    /// A piece without tokens that stands as this does.
    fn like(&self) -> Self {
        Self {
            tokens: Vec::new(),
            ..*self
        }
    }
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
    /// Begins behind "and".
    apart: bool,
    /// Follows a condition behind a comma, a blank or "and".
    follows: bool,
    /// Follows a condition in front, behind a colon or "then".
    concludes: bool,
    /// Stands behind "for all" or `\forall`.
    quantifies: bool,
    stands: Stands,
}

/// The statements of a display, with its bars paired.
pub(super) fn divided<'a>(tex: &'a str, plain: &Plain<'_>) -> Result<Vec<Statement<'a>>, Fault> {
    let (bytes, most) = (tex.len(), LONGEST);
    if bytes > most {
        return Err(Fault::new(0, Reason::TooLong { bytes, most }));
    }
    let mut tokens = lex(tex).map_err(|fault| fault.moved(|at| plain.source(at)))?;
    for token in &mut tokens {
        (token.at, token.end) = (plain.source(token.at), plain.source_end(token.end));
    }
    let mut statements = statements(tokens)?;
    for statement in &mut statements {
        pair_bars(&mut statement.tokens)?;
    }
    Ok(statements)
}

/// The statements, in order.
fn statements(tokens: Vec<Token<'_>>) -> Result<Vec<Statement<'_>>, Fault> {
    let pieces = pieces(tokens);
    refuse_shared_bounds(&pieces)?;
    let mut whole: Vec<Piece<'_>> = Vec::new();
    for piece in pieces.into_iter().flat_map(of_integers) {
        let is_behind_first = whole.len() < 2;
        match whole.last_mut() {
            Some(before) if continues(before, &piece)? => {
                if !is_behind_first && !matches!(standing(before), Stands::Stated | Stands::Explains) {
                    let at = piece.tokens.first().map_or(0, |token| token.at);
                    let instead =
                        "write the side that is meant before the relation, or give each statement an entry of its own";
                    return Err(Fault::ambiguous(at, "a row that goes on behind a condition", instead));
                }
                before.related |= piece.related;
                before.tokens.extend(piece.tokens);
            }
            _ => whole.push(piece),
        }
    }
    let in_front = in_front(&whole);
    let is_said = in_front > 0 && whole.first().is_some_and(|first| first.stands == Stands::Condition);
    let mut found: Vec<Statement<'_>> = Vec::new();
    for (place, piece) in whole.into_iter().enumerate() {
        let stands = match place == 0 && in_front == 0 {
            true => piece.stands,
            false => match standing(&piece) {
                // behind "for" all of them are conditions
                Stands::Beside if is_said && place < in_front => Stands::Condition,
                stands => stands,
            },
        };
        match conditions_in_brackets(&piece) {
            Some(inside) if stands == Stands::Condition => {
                let conditions = statements(inside)?.into_iter();
                found.extend(conditions.map(|condition| Statement { stands, ..condition }));
            }
            _ => found.push(Statement {
                follows: piece.follows && !compares_letters(&piece.tokens),
                quantifies: piece.quantifies,
                tokens: piece.tokens,
                stands,
            }),
        }
    }
    Ok(found)
}

/// A piece, and what "for integers" says of the letter that begins it.
fn of_integers(mut piece: Piece<'_>) -> Vec<Piece<'_>> {
    let Some(word) = piece
        .tokens
        .first()
        .copied()
        .filter(|token| token.kind == Kind::Said && token.text == INTEGERS)
    else {
        return vec![piece];
    };
    piece.tokens.remove(0);
    let letter = piece.tokens.iter().take_while(|token| !is_relation(token.kind));
    let mut belongs: Vec<Token<'_>> = letter.copied().collect();
    let token = |kind, text| Token { kind, text, ..word };
    belongs.extend([
        token(Kind::Element, "\\in"),
        token(Kind::Set(Set::Integer), "\\mathbb{Z}"),
    ]);
    let is_related = piece.related;
    let integers = Piece {
        tokens: belongs,
        related: true,
        ..piece.like()
    };
    let bounds = is_related.then_some(piece);
    std::iter::once(integers).chain(bounds).collect()
}

/// To which side a relation is smaller: -1 or 1; 0 for one that does not order.
fn direction(relation: Relation) -> i8 {
    match relation {
        Relation::Less | Relation::LessOrEqual => -1,
        Relation::Greater | Relation::GreaterOrEqual => 1,
        Relation::Equal | Relation::NotEqual => 0,
    }
}

/// Refuses `0 < a, b < 1`: two inequalities, or both letters between both numbers.
fn refuse_shared_bounds(pieces: &[Piece<'_>]) -> Result<(), Fault> {
    let is_letter = |token: &Token<'_>| matches!(token.kind, Kind::Letter | Kind::Word) && token.text != "\\pi";
    let has_letter = |tokens: &[Token<'_>]| tokens.iter().any(is_letter);
    let mut open: Option<Relation> = None;
    for piece in pieces {
        let tokens = piece.tokens.as_slice();
        let orders = tokens.iter().enumerate().filter_map(|(at, token)| match token.kind {
            Kind::Relation(relation) => Some((at, relation)),
            _ => None,
        });
        let orders: Vec<(usize, Relation)> = orders.collect();
        let Some(&(at, relation)) = orders.first() else {
            open = open.filter(|_| has_letter(tokens) && !piece.apart);
            continue;
        };
        let (left, right) = (&tokens[..at], &tokens[at + 1..]);
        let is_alone = orders.len() == 1;
        let ends = open.filter(|before| direction(*before) == direction(relation) && !piece.apart);
        if ends.is_some() && is_alone && has_letter(left) && !has_letter(right) {
            let at = tokens.first().map_or(0, |token| token.at);
            let instead = "give each letter both of its bounds";
            return Err(Fault::ambiguous(at, "a comma between two bounds", instead));
        }
        let begins = is_alone && !has_letter(left) && has_letter(right);
        open = Some(relation).filter(|relation| begins && direction(*relation) != 0);
    }
    Ok(())
}

/// How many inequalities and sets stand before the first statement that is neither, as conditions can; 0 where there is
/// no such statement, or where "and" makes it one statement more.
fn in_front(whole: &[Piece<'_>]) -> usize {
    if let Some(count) = whole.iter().position(|piece| piece.concludes) {
        return count;
    }
    let is_condition = |piece: &Piece<'_>| matches!(standing(piece), Stands::Beside | Stands::Condition);
    let count = whole.iter().take_while(|piece| is_condition(piece)).count();
    let goes_with = whole.get(count).is_some_and(|next| next.related && !next.apart);
    if goes_with { count } else { 0 }
}

/// Refuses what stands behind a condition and could be one claim more; conditions may stand in front.
pub(super) fn end_at_conditions(statements: &[Statement<'_>]) -> Result<(), Fault> {
    let is_condition = |one: &&Statement<'_>| matches!(one.stands, Stands::Condition | Stands::Beside);
    let in_front = statements.iter().take_while(is_condition).count();
    let (front, rest) = statements.split_at(in_front);
    let stated = rest.iter().filter(|one| one.stands == Stands::Stated);
    let of_several = if front.is_empty() { None } else { stated.clone().nth(1) };
    let mut behind = rest.iter().skip_while(|one| !is_condition(one)).skip(1);
    match of_several.or_else(|| behind.find(|one| one.stands == Stands::Stated || one.follows)) {
        Some(one) => {
            let at = one.tokens.first().map_or(0, |token| token.at);
            let instead = "give each statement with its conditions an entry of its own";
            Err(Fault::ambiguous(at, "what stands behind a condition", instead))
        }
        None => Ok(()),
    }
}

/// What a piece is to the display that it does not begin.
fn standing(piece: &Piece<'_>) -> Stands {
    let mut outside = outside_brackets(&piece.tokens).filter(|kind| is_relation(*kind));
    let (mut orders, mut equates, mut belongs) = (false, false, false);
    for kind in &mut outside {
        match kind {
            Kind::Element => belongs = true,
            Kind::Relation(Relation::Equal) | Kind::Approximately => equates = true,
            _ => orders = true,
        }
    }
    match piece.stands {
        Stands::Explains if orders || belongs => Stands::Condition,
        Stands::Stated if belongs || conditions_in_brackets(piece).is_some() => Stands::Condition,
        Stands::Stated if orders && !equates && !piece.apart && !piece.concludes => Stands::Beside,
        stands => stands,
    }
}

/// Whether a relation other than `=` stands between letters and numbers alone, as conditions mostly do.
fn compares_letters(tokens: &[Token<'_>]) -> bool {
    let is_plain = |token: &Token<'_>| match token.kind {
        Kind::Relation(relation) => relation != Relation::Equal,
        Kind::Element | Kind::Letter | Kind::Word | Kind::Number | Kind::Minus | Kind::Sub | Kind::Comma => true,
        Kind::BraceOpen | Kind::BraceClose | Kind::Prime | Kind::Slash | Kind::Accent | Kind::Fraction => true,
        Kind::Bar | Kind::Open(Bracket::Bar) | Kind::Close(Bracket::Bar) => true,
        _ => false,
    };
    let belongs = tokens.iter().any(|token| token.kind == Kind::Element);
    belongs || tokens.iter().all(is_plain)
}

/// The conditions of `\quad (x > 0)`, which state nothing else.
fn conditions_in_brackets<'a>(piece: &Piece<'a>) -> Option<Vec<Token<'a>>> {
    let [open, inside @ .., close] = piece.tokens.as_slice() else {
        return None;
    };
    let round = (Kind::Open(Bracket::Round), Kind::Close(Bracket::Round));
    let is_pair = (open.kind, close.kind) == round && outside_brackets(&piece.tokens).count() == 0;
    (is_pair && outside_brackets(inside).any(is_relation)).then(|| inside.to_vec())
}

/// The kinds of the tokens that stand in no bracket.
fn outside_brackets<'b>(tokens: &'b [Token<'_>]) -> impl Iterator<Item = Kind> + 'b {
    let mut depth = 0_usize;
    tokens.iter().filter_map(move |token| {
        match token.kind {
            Kind::Open(_) | Kind::BraceOpen => depth += 1,
            Kind::Close(_) | Kind::BraceClose => {
                depth = depth.saturating_sub(1);
                return None;
            }
            _ => {}
        }
        (depth == 0).then_some(token.kind)
    })
}

fn pieces(tokens: Vec<Token<'_>>) -> Vec<Piece<'_>> {
    let fresh = |hard, stands| Piece {
        tokens: Vec::new(),
        hard,
        related: false,
        aligned: false,
        apart: false,
        follows: false,
        concludes: false,
        quantifies: false,
        stands,
    };
    // which brackets are open: true for those that hold rows
    let mut in_front = false;
    let (mut done, mut piece, mut open) = (Vec::new(), fresh(true, Stands::Stated), Vec::<bool>::new());
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
                    let stands = piece.stands;
                    done.push(std::mem::replace(&mut piece, fresh(true, stands)));
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
                let stands = match (token.kind, token.text) {
                    (Kind::And, "where" | "with") => Stands::Explains,
                    // what a condition of a row is about ends with it
                    (Kind::Row, _) if piece.stands == Stands::Condition => Stands::Stated,
                    // a condition in front ends here, or more of them follow
                    _ if std::mem::take(&mut in_front) => Stands::Stated,
                    _ => piece.stands,
                };
                if piece.tokens.is_empty() {
                    piece.hard |= hard;
                    piece.stands = stands;
                } else {
                    let quantifies = piece.quantifies && stands == Stands::Condition;
                    let next = Piece {
                        quantifies,
                        ..fresh(hard, stands)
                    };
                    done.push(std::mem::replace(&mut piece, next));
                }
                piece.aligned |= token.kind == Kind::Quad;
                piece.apart |= token.kind == Kind::And;
                piece.concludes |= matches!(token.text, ":" | "then");
                piece.follows = piece.stands == Stands::Condition;
                continue;
            }
            Kind::Said if depth == 0 && is_about(token.text) => {
                let is_first = done.is_empty() && piece.tokens.is_empty();
                let condition = Piece {
                    quantifies: matches!(token.text, "\\forall" | INTEGERS),
                    ..fresh(true, Stands::Condition)
                };
                let before = std::mem::replace(&mut piece, condition);
                done.extend((!before.tokens.is_empty()).then_some(before));
                in_front = is_first;
                if token.text != INTEGERS {
                    continue;
                }
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

/// Whether a word says that a condition follows.
fn is_about(word: &str) -> bool {
    matches!(word, "for" | "if" | "when" | "\\forall" | INTEGERS)
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

pub(super) fn is_relation(kind: Kind) -> bool {
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
    fn conditions_may_stand_in_front_of_one_statement() {
        let standing = |tex: &str| -> Vec<Stands> {
            let found = statements(lex(tex).unwrap()).unwrap();
            found.into_iter().map(|statement| statement.stands).collect()
        };
        use Stands::{Beside, Condition, Stated};
        assert_eq!(standing(r"x > 0, \quad |x| = x"), [Beside, Stated]);
        assert_eq!(standing(r"n \in N, x > 0, f = x"), [Condition, Beside, Stated]);
        assert_eq!(standing("x > 0, y > 0"), [Stated, Beside]);
        assert_eq!(standing(r"x > 0 \text{ and } x = y"), [Stated, Stated]);
        let ends = |tex: &str| end_at_conditions(&statements(lex(tex).unwrap()).unwrap()).is_ok();
        assert!(ends("x > 0, a = b") && ends("x > 0, a = b, x < 2"));
        assert!(!ends("x > 0, a = b, c = d") && !ends("a = b, x > 0, c = d"));
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
    fn conditions_stand_beside_what_they_are_about() {
        let stand = |tex: &str| -> Vec<Stands> {
            let statements = statements(lex(tex).unwrap()).unwrap();
            statements.into_iter().map(|statement| statement.stands).collect()
        };
        use Stands::{Beside, Condition, Explains, Stated};
        for (tex, wanted) in [
            (r"|a| = a \text{ where } a > 0", vec![Stated, Condition]),
            (r"a = n b \text{ with } n \in \mathbb{Z}", vec![Stated, Condition]),
            (
                r"a = b \text{ where } c = d \text{ and } e < f",
                vec![Stated, Explains, Condition],
            ),
            (
                r"a = b \quad \text{for } x > 0, y < 0",
                vec![Stated, Condition, Condition],
            ),
            (r"a = b \text{ for all } x > 0", vec![Stated, Condition]),
            (r"a = b \quad \forall x > 0", vec![Stated, Condition]),
            (r"a = b \quad (x > 0, y > 0)", vec![Stated, Condition, Condition]),
            (r"a = b, \quad n \in \mathbb{Z}", vec![Stated, Condition]),
            (r"a = b, \quad x < 0", vec![Stated, Beside]),
            (r"a = b, x < 0", vec![Stated, Beside]),
            (r"a = b \\ x < 0", vec![Stated, Beside]),
            (r"a = b \text{ and } x < 0", vec![Stated, Stated]),
            (r"a < b, x < 0", vec![Stated, Beside]),
            (r"x^2 > 1 \quad x > 1", vec![Stated, Beside]),
            (r"a = b \text{ for } x > 0 \\ c = d", vec![Stated, Condition, Stated]),
            (r"a = b, \quad (x - y) = c", vec![Stated, Stated]),
            (r"a = b \quad (x - y)", vec![Stated, Stated]),
        ] {
            assert_eq!(stand(tex), wanted, "{tex}");
        }
    }

    #[test]
    fn a_statement_behind_a_condition_is_refused() {
        for tex in [
            r"a = b \text{ for } x > 0 \\ c = d",
            r"|x| = x \quad \text{for } x > 0, \qquad |y| = y",
            r"|x| = x \text{ for } x > 0 \text{ and } |y| = -y \text{ for } y < 1",
            r"a = b, \quad x > 0, \\ a = c, \quad y > 0",
            r"\ln x \le x - 1 \text{ for } x > 0, \quad \ln x \ge 0",
        ] {
            assert!(
                end_at_conditions(&statements(lex(tex).unwrap()).unwrap()).is_err(),
                "{tex}"
            );
        }
        for tex in [
            r"a = b \text{ for } x > 0, y < 0",
            r"a = b \quad (x > 0, y = 0)",
            r"a = b, \quad 0 < x < 1, \quad n \in \mathbb{Z}",
        ] {
            assert!(
                end_at_conditions(&statements(lex(tex).unwrap()).unwrap()).is_ok(),
                "{tex}"
            );
        }
    }

    #[test]
    fn a_row_that_goes_on_behind_a_condition_is_refused() {
        for tex in [
            r"|x| &= x, x \ge 0 \\ &= -x, x < 0",
            r"|x| &= x \quad \text{for } x \ge 0 \\ &= -x",
            r"|x| &= x && (x \ge 0) \\ &= -x && (x < 0)",
            r"a &= b, \quad x > 0 \\ &\quad + c",
        ] {
            assert!(statements(lex(tex).unwrap()).is_err(), "{tex}");
        }
        assert!(statements(lex(r"a > b \\ = c").unwrap()).is_ok());
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
