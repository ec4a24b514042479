//! Matrices, values by cases, derivatives, integrals, sums and products, and `\approx`.

use super::error::Fault;
use super::lexer::NO_BRACKET;
use super::names::BOLD;
use super::part::{DIFFERENTIAL, Form, Part, is_differential, product, starts_factor};
use super::reader::Reader;
use super::token::{Bracket, Kind, Rows, Token};
use super::{
    At, Case, Condition, DoubtKind, Doubts, Equation, Invariant, Name, Operation, OtherReading, Relation, Series, Tree,
};
use numbers::{Field, Rational};

/// The most rows, and columns, of a matrix.
const LARGEST: usize = 16;

/// The highest order of a derivative.
const HIGHEST: u32 = 20;

const WHAT_IS_DERIVED: &str = "write brackets around all that is differentiated";

/// The most tokens behind a `d` in brackets among which the differential of an integral is looked for.
const FURTHEST_DIFFERENTIAL: usize = 200;

impl<'a> Reader<'a> {
    /// A matrix, a determinant between bars, or a value by cases, whose environment stands next.
    pub(super) fn rows(&mut self, open: Token<'a>, rows: Rows) -> Result<Box<Tree>, Fault> {
        self.next += 1;
        self.deepen()?;
        let operation = match rows {
            Rows::Cases => Operation::Cases(self.cases(open)?),
            Rows::Matrix => Operation::Matrix(self.cells(open)?),
            Rows::Determinant => {
                let matrix = Operation::Matrix(self.cells(open)?);
                Operation::Determinant(Tree::Operation(Box::new(matrix), At(open.at)))
            }
        };
        self.rise();
        self.close(open, Bracket::Rows(rows))?;
        Ok(boxed(operation, open.at))
    }

    fn cells(&mut self, open: Token<'a>) -> Result<Vec<Vec<Tree>>, Fault> {
        let mut cells: Vec<Vec<Tree>> = vec![Vec::new()];
        while let Some(row) = cells.last_mut() {
            let cell = *self.sum()?;
            row.push(cell);
            self.skip_empty();
            if self.take(Kind::Column).is_some() {
                continue;
            }
            if self.take(Kind::Row).is_none() || matches!(self.peek_kind(), Some(Kind::Close(_))) {
                break;
            }
            cells.push(Vec::new());
        }
        let length = cells.first().map_or(0, Vec::len);
        if cells.iter().any(|row| row.len() != length) {
            return Err(Fault::unsupported(open.at, "this matrix", "its rows differ in length"));
        }
        if cells.len() > LARGEST || length > LARGEST {
            return Err(Fault::unsupported(
                open.at,
                "so large a matrix",
                "at most 16 rows and columns are read",
            ));
        }
        Ok(cells)
    }

    fn cases(&mut self, open: Token<'a>) -> Result<Vec<Case>, Fault> {
        let mut cases: Vec<Case> = Vec::new();
        loop {
            let value = *self.sum()?;
            self.skip_punctuation();
            self.take(Kind::Column);
            let conditions = self.case_conditions()?;
            cases.push(Case { value, conditions });
            if self.take(Kind::Row).is_none() || matches!(self.peek_kind(), Some(Kind::Close(_))) {
                break;
            }
        }
        let (last, before) = cases.split_last().ok_or_else(|| self.instead_of("a case"))?;
        if before.iter().any(|case| case.conditions.is_empty()) {
            return Err(Fault::unsupported(
                open.at,
                "a case without a condition",
                "only the last may be for all that is left",
            ));
        }
        if last.conditions.is_empty() && before.iter().any(|case| case.conditions.len() > 1) {
            return Err(Fault::unsupported(
                open.at,
                "a last case for all that is left",
                "write its condition, for others have more than one",
            ));
        }
        Ok(cases)
    }

    fn skip_punctuation(&mut self) {
        while let Some(Kind::Comma | Kind::Stop) = self.peek_kind() {
            self.next += 1;
        }
    }

    /// `\text{if } -1 \le x \le 1`, `n \text{ even}`, `\text{otherwise}`.
    fn case_conditions(&mut self) -> Result<Vec<Condition>, Fault> {
        let mut conditions = Vec::new();
        let said = |token: Option<Token<'a>>, words: &[&str]| {
            token.is_some_and(|token| token.kind == Kind::Said && words.contains(&token.text))
        };
        if said(self.peek(), &["if", "for", "when", "\\forall"]) {
            self.next += 1;
        }
        if said(self.peek(), &["otherwise", "else"]) {
            self.next += 1;
            self.skip_punctuation();
            return Ok(conditions);
        }
        loop {
            let at = self.here();
            let left = *self.sum()?;
            let word = self.take(Kind::Said);
            match word.map(|word| word.text) {
                Some("even") => conditions.push(Condition::Integer(half(left, 0))),
                Some("odd") => conditions.push(Condition::Integer(half(left, 1))),
                Some(_) => return Err(self.instead_of("a relation, `even` or `odd`")),
                None => {
                    let mut relations = Vec::new();
                    self.relations(at, left, &mut relations)?;
                    if relations.is_empty() {
                        return Err(self.instead_of("a relation"));
                    }
                    conditions.extend(relations.into_iter().map(Condition::Relation));
                }
            }
            if self.take(Kind::And).is_some() {
                continue;
            }
            let before = self.next;
            self.skip_punctuation();
            if self.next == before || matches!(self.peek_kind(), Some(Kind::Row | Kind::Close(_)) | None) {
                return Ok(conditions);
            }
        }
    }

    /// What a trace or determinant is of, where that is no name of a map.
    pub(super) fn invariant_of(&mut self, kind: Invariant, at: usize) -> Result<Box<Tree>, Fault> {
        let of = match self.open() {
            Some((open, bracket)) => {
                let of = self.sum()?;
                self.close(open, bracket)?;
                of
            }
            None => match self.peek() {
                Some(token) => match token.kind {
                    Kind::Open(Bracket::Rows(Rows::Matrix)) => {
                        let rows = self.rows(token, Rows::Matrix)?;
                        if self.peek_kind() == Some(Kind::Sup) {
                            let instead = "write brackets around the matrix with its power, or around the whole";
                            return Err(Fault::ambiguous(at, "a power behind this matrix", instead));
                        }
                        rows
                    }
                    Kind::Letter | Kind::Word | Kind::Accent => self.matrix_by_name(token)?,
                    _ => return Err(self.instead_of("a matrix")),
                },
                None => return Err(self.instead_of("a matrix")),
            },
        };
        Ok(boxed(
            match kind {
                Invariant::Trace => Operation::Trace(*of),
                Invariant::Determinant => Operation::Determinant(*of),
            },
            at,
        ))
    }

    /// `A` or `D(\theta)` behind `\det` or `\tr`, which must end there.
    fn matrix_by_name(&mut self, token: Token<'a>) -> Result<Box<Tree>, Fault> {
        let name = self.bare_name()?;
        let at = self.here();
        let part = self.symbol(name, token.at)?;
        let is_plain = matches!(*part.tree, Tree::Symbol(..) | Tree::Call(..));
        self.skip_empty();
        let goes_on = |kind: Kind| starts_factor(kind) && !matches!(kind, Kind::Invariant(_));
        if !is_plain || self.peek_kind().is_some_and(goes_on) {
            let instead = "write brackets around all that the determinant or trace is of";
            return Err(Fault::ambiguous(at, "what follows this matrix", instead));
        }
        Ok(part.tree)
    }

    /// Whether a matrix is written out in the bracket, or the environment, that stands next.
    pub(super) fn rows_follow(&self) -> bool {
        let mut depth = 0_usize;
        for token in self.tokens.iter().skip(self.next) {
            match token.kind {
                Kind::Open(Bracket::Rows(_)) => return true,
                Kind::Open(_) | Kind::BraceOpen => depth += 1,
                Kind::Close(_) | Kind::BraceClose => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth == 0 {
                return false;
            }
        }
        false
    }

    /// `\sum_{k=1}^{n}` and the term behind it.
    pub(super) fn series(&mut self, token: Token<'a>, kind: Series) -> Result<Part, Fault> {
        self.next += 1;
        self.deepen()?;
        let (mut below, mut to) = (None, None);
        loop {
            match self.peek_kind() {
                Some(Kind::Sub) if below.is_none() => {
                    self.next += 1;
                    below = Some(self.first_index()?);
                }
                Some(Kind::Sup) if to.is_none() => {
                    self.next += 1;
                    to = Some(self.end_of_series()?);
                }
                _ => break,
            }
        }
        let (Some((index, from)), Some(to)) = (below, to) else {
            let instead = "write both limits: \\sum_{k=1}^{n}";
            return Err(Fault::unsupported(token.at, token.text, instead));
        };
        let of = self.term()?;
        let is_bracketed = of.form == Form::Bracketed;
        let of = *of.tree;
        self.rise();
        if let (Series::Product, false, Tree::Product(factors)) = (kind, is_bracketed, &of)
            && !factors.iter().all(|factor| mentions(factor, &index))
        {
            let instead = "write brackets around what is multiplied, or around the product";
            return Err(Fault::ambiguous(token.at, "a product of several factors", instead));
        }
        let operation = Operation::Series {
            kind,
            of,
            index,
            from,
            to,
        };
        Ok(Part {
            tree: boxed(operation, token.at),
            form: Form::Knot,
        })
    }

    /// `{k=1}`.
    fn first_index(&mut self) -> Result<(Name, Tree), Fault> {
        let at = self.here();
        if self.take(Kind::BraceOpen).is_none() {
            return Err(self.instead_of("`{k = 1}`"));
        }
        let index = self.full_name()?;
        if self.take(Kind::Relation(Relation::Equal)).is_none() {
            return Err(self.instead_of("`=` and where the index starts"));
        }
        let start = self.here();
        let from = match self.infinity_ahead() {
            Some(_) => self.limit_or_infinity()?,
            None => *self.sum()?,
        };
        if matches!(&from, Tree::Operation(operation, _) if **operation == Operation::Infinity) {
            let instead = "a sum starts at a number or at minus infinity";
            return Err(Fault::unsupported(start, "this limit", instead));
        }
        self.close_brace(at)?;
        Ok((index, from))
    }

    /// The upper limit of a sum or a product: a letter, a digit, what stands between braces, or infinity.
    fn end_of_series(&mut self) -> Result<Tree, Fault> {
        let at = self.here();
        match self.limit_or_infinity()? {
            Tree::Negate(inner) if matches!(&*inner, Tree::Operation(operation, _) if **operation == Operation::Infinity) => {
                Err(Fault::unsupported(
                    at,
                    "this limit",
                    "a sum ends at a number or at infinity",
                ))
            }
            end => Ok(end),
        }
    }

    /// A limit of an integral, or of what is taken between limits: that of a sum, or infinity with or without a sign.
    pub(super) fn limit_or_infinity(&mut self) -> Result<Tree, Fault> {
        let Some(ahead) = self.infinity_ahead() else {
            return Ok(*self.argument()?);
        };
        let at = self.here();
        let braced = self.take(Kind::BraceOpen).is_some();
        let signs = ahead.saturating_sub(usize::from(braced));
        let is_negative = self.peek_kind() == Some(Kind::Minus);
        if signs > 1 {
            return Err(Fault::unsupported(at, "this limit", "one sign stands before infinity"));
        }
        self.next += signs + 1;
        if braced {
            self.close_brace(at)?;
        }
        let infinity = *boxed(Operation::Infinity, at);
        Ok(match is_negative {
            true => Tree::Negate(Box::new(infinity)),
            false => infinity,
        })
    }

    /// How many signs and braces stand before the sign of infinity that stands next.
    pub(super) fn infinity_ahead(&self) -> Option<usize> {
        let infinite = (0..3).find(|&ahead| self.look(ahead).is_some_and(|token| token.kind == Kind::Infinity));
        infinite.filter(|&ahead| (0..ahead).all(|at| self.is_sign_or_brace(at)))
    }

    fn is_sign_or_brace(&self, ahead: usize) -> bool {
        self.look(ahead)
            .is_some_and(|token| matches!(token.kind, Kind::BraceOpen | Kind::Plus | Kind::Minus))
    }

    /// `\lim_{x \to 0}` and the term behind it.
    pub(super) fn limit_of(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        self.deepen()?;
        let below = self.here() + 1;
        if self.take(Kind::Sub).is_none() || self.take(Kind::BraceOpen).is_none() {
            return Err(self.instead_of("`_{x \\to a}`"));
        }
        let by = self.full_name()?;
        let mut to = self.approached()?;
        if self.take(Kind::Comma).is_some() {
            to = self.on_side(&by, to)?;
        }
        self.close_brace(below)?;
        let of = *self.term()?.tree;
        self.rise();
        Ok(Part {
            tree: boxed(Operation::Limit { of, by, to }, token.at),
            form: Form::Knot,
        })
    }

    /// `\to a`, `\to 0^+`, `\to a - 0`, `\downarrow a`, `\to -\infty`.
    pub(super) fn approached(&mut self) -> Result<Tree, Fault> {
        let at = self.here();
        let Some(Kind::To(given)) = self.peek_kind() else {
            return Err(self.instead_of("`\\to`"));
        };
        self.next += 1;
        let is_negative = self.peek_kind() == Some(Kind::Minus);
        let signed = usize::from(matches!(self.peek_kind(), Some(Kind::Minus | Kind::Plus)));
        if self.look(signed).is_some_and(|token| token.kind == Kind::Infinity) {
            self.next += signed + 1;
            let infinity = *boxed(Operation::Infinity, at);
            return Ok(if is_negative {
                Tree::Negate(Box::new(infinity))
            } else {
                infinity
            });
        }
        let (target, side) = match self.sided() {
            Some((length, mark, is_above)) => {
                let target = self.within(length)?;
                self.next += mark;
                (target, Some(is_above))
            }
            None => (*self.sum()?, None),
        };
        Ok(match given.or(side) {
            Some(is_above) => *boxed(Operation::OneSided(target, is_above), at),
            None => target,
        })
    }

    /// Reads the side that is said behind what is approached: `x > 0` behind `x \to 0`.
    fn on_side(&mut self, by: &Name, to: Tree) -> Result<Tree, Fault> {
        let at = self.here();
        let wrong = |at| Fault::unexpected(at, "this", "the side on which the letter stays, as `x > a`");
        let (name, relation) = (self.full_name()?, self.peek_kind());
        self.next += 1;
        let is_same = name == *by && *self.sum()? == to;
        let is_above = match relation {
            Some(Kind::Relation(Relation::Greater)) => true,
            Some(Kind::Relation(Relation::Less)) => false,
            _ => return Err(wrong(at)),
        };
        match is_same {
            true => Ok(*boxed(Operation::OneSided(to, is_above), at)),
            false => Err(wrong(at)),
        }
    }

    /// Returns how many tokens are what is approached, how many say behind it from which side, and if this is from above: a raised
    /// sign, a sign and 0, or a sign alone.
    fn sided(&self) -> Option<(usize, usize, bool)> {
        let rest = self.tokens.get(self.next..)?;
        let mut depth = 0_usize;
        let end = rest.iter().position(|token| {
            match token.kind {
                Kind::BraceOpen => depth += 1,
                Kind::BraceClose if depth > 0 => depth -= 1,
                Kind::BraceClose | Kind::Comma => return depth == 0,
                _ => {}
            }
            false
        });
        let target = rest.get(..end.unwrap_or(rest.len()))?;
        let kinds: Vec<Kind> = target.iter().map(|token| token.kind).collect();
        let is_zero = target.last().is_some_and(|token| token.text == "0");
        let (mark, sign) = match kinds.as_slice() {
            [.., Kind::Sup, Kind::BraceOpen, sign, Kind::BraceClose] => (4, sign),
            [.., Kind::Sup, sign] => (2, sign),
            [.., sign, Kind::Number] if is_zero => (2, sign),
            [.., sign] => (1, sign),
            [] => return None,
        };
        let length = target.len().checked_sub(mark)?;
        match sign {
            Kind::Plus => Some((length, mark, true)),
            Kind::Minus => Some((length, mark, false)),
            _ => None,
        }
    }

    /// Reads the next tokens, all of them, as a sum: 0 where there are none.
    fn within(&mut self, length: usize) -> Result<Tree, Fault> {
        if length == 0 {
            return Ok(Tree::Number(Rational::from_integer(0)));
        }
        let behind = self.tokens.split_off((self.next + length).min(self.tokens.len()));
        let read = self.sum().and_then(|tree| match self.peek() {
            Some(token) => Err(Fault::unexpected(token.at, token.text, "the end of what is approached")),
            None => Ok(*tree),
        });
        self.tokens.extend(behind);
        read
    }

    /// Returns true if `O(` or `o(` stands next, and the letter is not declared.
    pub(super) fn is_order(&self, token: Token<'a>) -> bool {
        ["O", "o"].contains(&token.text)
            && !self.names.letters.iter().any(|letter| letter == token.text)
            && self.look(1).is_some_and(|next| next.kind == Kind::Open(Bracket::Round))
    }

    /// `O(x^2)`, `o(x)`.
    pub(super) fn order_of(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        let of = *self.bracketed()?;
        Ok(Part {
            tree: boxed(Operation::Order(of, token.text == "o"), token.at),
            form: Form::Plain,
        })
    }

    /// `\int_a^b f \, dx`, `\int \frac{dx}{x}`.
    pub(super) fn integral(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        self.next += 1;
        self.deepen()?;
        let (mut low, mut high) = (None, None);
        loop {
            match self.peek_kind() {
                Some(Kind::Sub) if low.is_none() => {
                    self.next += 1;
                    low = Some(self.limit_or_infinity()?);
                }
                Some(Kind::Sup) if high.is_none() => {
                    self.next += 1;
                    high = Some(self.limit_or_infinity()?);
                }
                _ => break,
            }
        }
        let limits = match (low, high) {
            (Some(low), Some(high)) => Some((low, high)),
            (None, None) => None,
            _ => {
                let instead = "write both limits, or none";
                return Err(Fault::unsupported(token.at, "an integral with one limit", instead));
            }
        };
        let outer = self.integral.replace(None);
        let body = self.term();
        let by = std::mem::replace(&mut self.integral, outer).flatten();
        let body = *body?.tree;
        self.rise();
        let Some(by) = by else {
            let instead = "end it with dx, or with whatever letter it is by";
            return Err(Fault::unsupported(token.at, "an integral without its letter", instead));
        };
        let Some(mut of) = without_differential(body) else {
            let instead = "write what is integrated, in brackets if it is a sum, and dx behind it";
            return Err(Fault::ambiguous(token.at, "where this integral ends", instead));
        };
        let ends_outer = self.integral == Some(None) && self.differential_ahead().is_some();
        let goes_on = self.peek_kind().is_some_and(starts_factor) || self.peek_kind() == Some(Kind::Slash);
        let (mut behind, mut leads) = (None, false);
        if goes_on && !ends_outer {
            let is_first = matches!(&of, Tree::Number(one) if *one == Rational::from_integer(1));
            let instead = "write brackets around the integral, or dx behind all that is integrated";
            let fault = Fault::ambiguous(self.here(), "a factor behind an integral", instead);
            if self.peek_kind() == Some(Kind::Slash) {
                return Err(fault);
            }
            // \int dx f(x) is of what follows; behind \int f(x) dx the integral has ended
            let rest = *self.term()?.tree;
            match (is_first, mentions(&rest, &by)) {
                (true, true) => (of, leads) = (rest, true),
                (false, false) => behind = Some(rest),
                _ => return Err(fault),
            }
        }
        if (self.integral.is_some() && limits.is_none()) || (limits.is_none() && holds_integral(&of)) {
            let instead = "write both limits of each";
            return Err(Fault::unsupported(token.at, "an integral within an integral", instead));
        }
        if !self.integrated.contains(&by) {
            self.integrated.push(by.clone());
        }
        let inner = nested(&of, limits.as_ref(), &by).filter(|_| !leads).cloned();
        let tree = boxed(Operation::Integral { of, by, limits }, token.at);
        if let Some(inner) = inner {
            let other = from_outside(&tree);
            let taken = (*tree).clone();
            let readings = other.map(|other| OtherReading { taken, other }).into_iter().collect();
            self.doubt(token.at, DoubtKind::Nesting { inner, readings });
        }
        let tree = match behind {
            Some(rest) => product(vec![*tree, rest]),
            None => tree,
        };
        Ok(Part { tree, form: Form::Knot })
    }

    /// What `of` between square brackets is between the limits that follow: `[F]_a^b`, `[F]_{x=a}^{x=b}` or, at one
    /// point, `[F]_{x=a}`; `None` where no subscript follows.
    pub(super) fn between_limits(&mut self, of: &Tree, at: usize) -> Result<Option<Part>, Fault> {
        let has_subscript = match self.peek_kind() {
            Some(Kind::Sub) => true,
            Some(Kind::Sup) => self.behind_script().map(|token| token.kind) == Some(Kind::Sub),
            _ => false,
        };
        if !has_subscript {
            return Ok(None);
        }
        let (mut low, mut high) = (None, None);
        loop {
            match self.peek_kind() {
                Some(Kind::Sub) if low.is_none() => {
                    self.next += 1;
                    low = Some(self.point()?);
                }
                Some(Kind::Sup) if high.is_none() => {
                    self.next += 1;
                    high = Some(self.point()?);
                }
                _ => break,
            }
        }
        let (named, low) = low.ok_or_else(|| self.instead_of("the lower limit"))?;
        let Some((also, high)) = high else {
            let Some(by) = named else {
                let instead = "only a name may carry it";
                return Err(Fault::unsupported(at, "a subscript on an expression", instead));
            };
            self.refuse_running(of, at)?;
            let form = Form::Bracketed;
            return Ok(Some(Part {
                tree: Box::new(at_point(of, &by, low, at)),
                form,
            }));
        };
        if let (Some(one), Some(other)) = (&named, &also)
            && one != other
        {
            let instead = "both limits are of one letter";
            return Err(Fault::unsupported(at, "this bracket", instead));
        }
        self.refuse_running(of, at)?;
        if named.is_some() && also.is_none() && may_be_power(&high) {
            self.doubt(at, DoubtKind::Difference { upper: high.clone() });
        }
        let by = match named.or(also) {
            Some(by) => by,
            None => self.letter_between(of, [&low, &high], at)?,
        };
        let tree = Tree::Sum(vec![
            at_point(of, &by, high, at),
            Tree::Negate(Box::new(at_point(of, &by, low, at))),
        ]);
        let form = Form::Bracketed;
        Ok(Some(Part {
            tree: Box::new(tree),
            form,
        }))
    }

    /// The token behind the script that stands next.
    fn behind_script(&self) -> Option<Token<'a>> {
        let (mut ahead, mut depth) = (1, 0_usize);
        loop {
            match self.look(ahead)?.kind {
                Kind::BraceOpen => depth += 1,
                Kind::BraceClose => depth = depth.checked_sub(1)?,
                _ => {}
            }
            ahead += 1;
            if depth == 0 {
                return self.look(ahead);
            }
        }
    }

    /// A limit with or without its letter: `a`, `{x=a}`.
    fn point(&mut self) -> Result<(Option<Name>, Tree), Fault> {
        let (start, at) = (self.mark(), self.here());
        if self.take(Kind::BraceOpen).is_some()
            && let Ok(by) = self.full_name()
            && self.take(Kind::Relation(Relation::Equal)).is_some()
        {
            let to = *self.sum()?;
            self.close_brace(at)?;
            return Ok((Some(by), to));
        }
        self.reset(start);
        Ok((None, self.limit_or_infinity()?))
    }

    /// The letter that a bracket with limits is of: the one letter of it that an integral before it is by, or else its
    /// one letter that is none of the limits'.
    fn letter_between(&self, of: &Tree, limits: [&Tree; 2], at: usize) -> Result<Name, Fault> {
        let (mut met, mut outside) = (Vec::new(), Vec::new());
        symbols(of, &mut met);
        limits.into_iter().for_each(|limit| symbols(limit, &mut outside));
        let constants = ["e", "i", "\\pi"].map(Name::plain);
        let integrated: Vec<&Name> = met.iter().filter(|name| self.integrated.contains(name)).collect();
        let free: Vec<&Name> = met
            .iter()
            .filter(|name| !outside.contains(name) && !constants.contains(name))
            .collect();
        let by = match (integrated.as_slice(), free.as_slice()) {
            ([by], _) => Some(*by),
            ([], [by]) if self.integral.is_none() => Some(*by),
            _ => None,
        };
        by.cloned().ok_or_else(|| {
            let instead = "write the letter that it is of: [F]_{x=a}^{x=b}";
            Fault::ambiguous(at, "this bracket with limits", instead)
        })
    }

    /// Refuses functions without their argument in what is taken at a point.
    fn refuse_running(&self, of: &Tree, at: usize) -> Result<(), Fault> {
        let mut met = Vec::new();
        symbols(of, &mut met);
        match met.iter().any(|name| self.names.is_function(name)) {
            true => {
                let instead = "write the argument of each function in it";
                Err(Fault::ambiguous(at, "this bracket with limits", instead))
            }
            false => Ok(()),
        }
    }

    /// The differential of an integral that stands next, while one is read.
    pub(super) fn differential(&mut self) -> Result<Option<Part>, Fault> {
        let Some(length) = self.differential_ahead() else {
            return Ok(None);
        };
        let at = self.here();
        self.next += length;
        let by = self.full_name()?;
        match self.integral.replace(Some(by)) {
            Some(None) => Ok(Some(Part {
                tree: Box::new(Tree::Symbol(Name::plain(DIFFERENTIAL), At(at))),
                form: Form::Plain,
            })),
            _ => {
                let instead = "one integral has one";
                Err(Fault::unsupported(at, "a second differential", instead))
            }
        }
    }

    /// The tokens of the `d` of the differential that stands next, while an integral is read.
    pub(super) fn differential_ahead(&self) -> Option<usize> {
        let length = self.differential_sign(0).filter(|_| self.integral.is_some())?;
        let named = self.look(length)?;
        let is_named = matches!(named.kind, Kind::Letter | Kind::Accent);
        (is_named && !self.is_letter_in_brackets(length)).then_some(length)
    }

    /// Returns true if the `d` that stands next, in so many tokens, is a letter within brackets: behind these stands the
    /// differential of the letter behind it, as in `\int (c + d x) dx`.
    fn is_letter_in_brackets(&self, length: usize) -> bool {
        let named = self.look(length).map(|token| token.text);
        let (mut depth, mut is_behind) = (0_usize, false);
        for ahead in length + 1..length + FURTHEST_DIFFERENTIAL {
            let Some(token) = self.look(ahead) else { return false };
            match token.kind {
                Kind::Open(_) => depth += 1,
                Kind::Close(_) => {
                    is_behind |= depth == 0;
                    depth = depth.saturating_sub(1);
                }
                Kind::Relation(_) | Kind::Approximately | Kind::Integral => return false,
                _ => {
                    let behind = self.differential_sign(ahead).filter(|_| is_behind && depth == 0);
                    let by = behind.and_then(|length| self.look(ahead + length));
                    if by.is_some_and(|by| Some(by.text) == named) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Whether the integral that is read ends with this factor.
    pub(super) fn is_past_differential(&self, last: Option<&Tree>) -> bool {
        self.integral.is_some() && last.is_some_and(is_differential)
    }

    /// The tokens of the `d` of a differential, `ahead` of the next.
    fn differential_sign(&self, ahead: usize) -> Option<usize> {
        let is_letter = |at: usize| {
            self.look(at)
                .is_some_and(|token| token.kind == Kind::Letter && token.text == "d")
        };
        let is = |at: usize, kind: Kind| self.look(at).is_some_and(|token| token.kind == kind);
        match is(ahead, Kind::BraceOpen) {
            true if is_letter(ahead + 1) && is(ahead + 2, Kind::BraceClose) => Some(3),
            false if is_letter(ahead) => Some(1),
            _ => None,
        }
    }

    /// `\frac{d}{dx} f`, `\frac{d^2 f}{dx^2}`, `\frac{\partial^2}{\partial x^2} f` with what is differentiated, behind
    /// the command of the fraction; `None` for any other fraction.
    pub(super) fn derivative(&mut self, at: usize) -> Result<Option<Tree>, Fault> {
        let Some(shape) = self.derivative_ahead() else {
            return Ok(None);
        };
        if !shape.is_partial && self.names.letters.iter().any(|letter| letter == "d") {
            let instead = "`d` is declared: write \\partial for a derivative, or the quotient in another way";
            return Err(Fault::ambiguous(at, "this fraction", instead));
        }
        let above = self.here();
        self.next += shape.above;
        let of = match self.peek_kind() {
            Some(Kind::BraceClose) => None,
            _ => Some(self.term()?.tree),
        };
        self.close_brace(above)?;
        self.next += shape.below;
        let mut letters = vec![(self.full_name_before_power()?, self.order_below()?)];
        while shape.is_partial && self.take(Kind::Partial).is_some() {
            letters.push((self.full_name_before_power()?, self.order_below()?));
        }
        if letters.iter().map(|(_, order)| order).sum::<u32>() != shape.order {
            let instead = "its order above differs from that below";
            return Err(Fault::unsupported(at, "this derivative", instead));
        }
        self.close_brace(above)?;
        let is_bracketed = matches!(self.peek_kind(), Some(Kind::Open(_)));
        let is_operator = of.is_none() && !is_bracketed;
        let of = match of {
            Some(of) => of,
            None => self.differentiated()?,
        };
        let first = letters.first().filter(|_| is_operator);
        self.derivative = first.map(|(by, _)| (self.next, by.clone()));
        if !shape.is_partial
            && let Some(name) = self.names.several_in(&of)
        {
            let by = letters.first().map_or_else(Name::default, |(by, _)| by.clone());
            self.doubt(at, DoubtKind::TotalDerivative { of: name, by });
        }
        let is_doubtful = letters.iter().any(|(by, _)| self.may_be_taken_later(&of, by));
        let derived = |of: Tree, (by, order): (Name, u32)| {
            let value = Tree::Symbol(by.clone(), At(at));
            let operation = Operation::Derivative {
                of,
                by,
                order,
                at: value,
            };
            *boxed(operation, at)
        };
        let value = match letters.as_slice() {
            [(by, _)] if is_doubtful => self.value_of(&of, by),
            _ => None,
        };
        // the last letter below is the first by which is differentiated
        let of_value = letters.iter().cloned().rev().fold((*of).clone(), derived);
        let taken = match value {
            Some((inside, by, there)) => {
                let derivative = letters.into_iter().fold(inside, derived);
                Some(at_point(&derivative, &by, there, at))
            }
            None => None,
        };
        if is_doubtful {
            let other = |taken: &Tree| OtherReading {
                taken: taken.clone(),
                other: of_value.clone(),
            };
            let readings = taken.iter().map(other).collect();
            self.doubt(at, DoubtKind::DerivativeOfValue { of: *of, readings });
        }
        Ok(Some(taken.unwrap_or(of_value)))
    }

    /// Parts a value at a point, `[F]_{x=a}` or `R(a)`, into the formula in a letter, the letter and the point.
    fn value_of(&self, of: &Tree, by: &Name) -> Option<(Tree, Name, Tree)> {
        match of {
            Tree::Operation(operation, _) => match &**operation {
                Operation::Derivative {
                    of,
                    by: own,
                    order: 0,
                    at,
                } if own == by => Some((of.clone(), own.clone(), at.clone())),
                _ => None,
            },
            Tree::Call(name, argument, at) if self.names.is_function(name) && !argument.has_free(by) => {
                let letter = Box::new(Tree::Symbol(by.clone(), *at));
                Some((Tree::Call(name.clone(), letter, *at), by.clone(), (**argument).clone()))
            }
            _ => None,
        }
    }

    /// Whether `of`, differentiated by a letter, is the value at a point that may be put in after that: `[F]_{x=a}`, or `R(a)`.
    fn may_be_taken_later(&self, of: &Tree, by: &Name) -> bool {
        let is_value = |node: &Tree| match node {
            Tree::Operation(operation, _) => match &**operation {
                Operation::Derivative {
                    by: own, order: 0, at, ..
                }
                | Operation::Limit { by: own, to: at, .. } => own == by || at.has_free(by),
                _ => false,
            },
            Tree::Call(name, argument, _) => self.names.is_function(name) && !argument.has_free(by),
            _ => false,
        };
        let mut met = is_value(of);
        of.find_below(&mut |part| {
            met |= is_value(part) || matches!(part, Tree::Negate(inner) if is_value(inner));
            None::<()>
        });
        met && !of.has_free(by) && !self.names.has_bare_function(of)
    }

    /// What stands behind `\frac{d}{dx}`: one factor.
    fn differentiated(&mut self) -> Result<Box<Tree>, Fault> {
        if self.peek().is_some_and(|token| token.text == NO_BRACKET) {
            let instead = "write the derivative within \\left. and \\right|";
            return Err(Fault::ambiguous(
                self.here(),
                "a derivative before the bar of a value",
                instead,
            ));
        }
        let of = self.factor()?;
        self.skip_empty();
        // behind brackets a sign of multiplication tells where they end
        let is_sign = |kind| matches!(kind, Kind::Slash | Kind::Times | Kind::Star) && of.form != Form::Bracketed;
        match self
            .peek_kind()
            .is_some_and(|kind| starts_factor(kind) || is_sign(kind))
        {
            false => Ok(of.tree),
            true => Err(Fault::ambiguous(
                self.here(),
                "a factor behind what is differentiated",
                WHAT_IS_DERIVED,
            )),
        }
    }

    /// A name, before the power that is the order of a derivative.
    fn full_name_before_power(&mut self) -> Result<Name, Fault> {
        let mut name = self.bare_name()?;
        if self.peek_kind() == Some(Kind::Sub) {
            self.subscripts(&mut name)?;
        }
        Ok(name)
    }

    fn order_below(&mut self) -> Result<u32, Fault> {
        match self.take(Kind::Sup) {
            None => Ok(1),
            Some(_) => self.order(),
        }
    }

    /// The order of a derivative, a number with or without braces.
    fn order(&mut self) -> Result<u32, Fault> {
        let at = self.here();
        let braced = self.take(Kind::BraceOpen).is_some();
        let order = self
            .take(Kind::Number)
            .and_then(|token| token.text.parse::<u32>().ok())
            .filter(|order| (1..=HIGHEST).contains(order));
        if braced {
            self.close_brace(at)?;
        }
        order.ok_or_else(|| Fault::unsupported(at, "this order", "the order of a derivative is a number up to 20"))
    }

    /// How many tokens stand before the end of an open group, its brace among them, from the one `ahead` of the next.
    fn end_of_group(&self, ahead: usize) -> Option<usize> {
        let (mut depth, mut length) = (1_usize, 0);
        while depth > 0 {
            match self.look(ahead + length)?.kind {
                Kind::BraceOpen => depth += 1,
                Kind::BraceClose => depth -= 1,
                _ => {}
            }
            length += 1;
        }
        Some(length)
    }

    /// Whether the two groups that stand next are those of a derivative.
    fn derivative_ahead(&self) -> Option<Shape> {
        let kind = |at: usize| self.look(at).map(|token| token.kind);
        if kind(0) != Some(Kind::BraceOpen) {
            return None;
        }
        let is_partial = kind(1) == Some(Kind::Partial);
        let sign = |ahead: usize| match is_partial {
            true => (kind(ahead) == Some(Kind::Partial)).then_some(1),
            false => self.differential_sign(ahead),
        };
        let mut above = 1 + sign(1)?;
        let mut order = 1;
        if kind(above) == Some(Kind::Sup) {
            let braced = usize::from(kind(above + 1) == Some(Kind::BraceOpen));
            let first = above + 1 + braced;
            let mut end = first + 1;
            if braced == 1 {
                end = first + self.end_of_group(first)?;
            }
            let number = self
                .look(first)
                .filter(|token| token.kind == Kind::Number && end == first + 1 + braced);
            // of any other order none is read
            order = number.map_or(Some(0), |number| number.text.parse().ok())?;
            above = end;
        }
        let end = above + self.end_of_group(above)?;
        if kind(end) != Some(Kind::BraceOpen) {
            return None;
        }
        let below = 1 + sign(end + 1)?;
        matches!(kind(end + below), Some(Kind::Letter | Kind::Accent | Kind::BraceOpen)).then_some(Shape {
            is_partial,
            order,
            above,
            below,
        })
    }

    /// The derivative that primes on a bracket mean, by the letter that runs or the only one there is.
    pub(super) fn primed(&mut self, of: Box<Tree>, at: usize) -> Result<Box<Tree>, Fault> {
        let mut order = 0;
        while self.take(Kind::Prime).is_some() {
            order += 1;
        }
        if let Some(Kind::Sup | Kind::Sub) = self.peek_kind() {
            let instead = "put brackets around the derivative";
            return Err(Fault::unsupported(self.here(), "a script behind primes", instead));
        }
        let mut met: Vec<Name> = Vec::new();
        symbols(&of, &mut met);
        let running = self.names.running.clone().filter(|_| self.names.has_bare_function(&of));
        met.retain(|name| !self.names.is_function(name) && !matches!(name.base.as_str(), "e" | "\\pi"));
        let by = match (running, met.as_slice()) {
            (Some(running), _) => running,
            (None, [only]) if !matches!(*of, Tree::Symbol(..)) => only.clone(),
            _ => {
                let instead = "write \\frac{d}{dx} and brackets";
                return Err(Fault::ambiguous(at, "a prime on an expression", instead));
            }
        };
        let value = Tree::Symbol(by.clone(), At(at));
        let operation = Operation::Derivative {
            of: *of,
            by,
            order,
            at: value,
        };
        Ok(boxed(operation, at))
    }

    /// Returns the value of a derivative at the point in brackets right behind it, `\frac{dV}{dx}(a)` or `(F)'(a)`; a sum or a
    /// power there is a factor.
    pub(super) fn value_behind(&mut self, before: Option<&Tree>, inside: &Part, at: usize) -> Option<Tree> {
        let (of, by) = match before? {
            of @ Tree::Operation(operation, _) => match &**operation {
                Operation::Derivative { by, order: 1.., .. } => (of.clone(), by.clone()),
                _ => return None,
            },
            Tree::Partial { of, by, at } if self.names.is_defined(of) => {
                let [function, value] = [of, by].map(|name| Tree::Symbol(name.clone(), *at));
                let derivative = Operation::Derivative {
                    of: function,
                    by: by.clone(),
                    order: 1,
                    at: value,
                };
                (*boxed(derivative, at.0), by.clone())
            }
            _ => return None,
        };
        if inside.form != Form::Bracketed
            || matches!(*inside.tree, Tree::Sum(_) | Tree::Power(..) | Tree::RealPower(..))
        {
            return None;
        }
        let taken = at_point(&of, &by, (*inside.tree).clone(), at);
        let kind = DoubtKind::DerivativeBeforeBracket {
            of: of.clone(),
            inside: (*inside.tree).clone(),
            readings: vec![OtherReading {
                taken: taken.clone(),
                other: Tree::Product(vec![of, (*inside.tree).clone()]),
            }],
        };
        self.doubt(at, kind);
        Some(taken)
    }

    /// `\vec{a} \times \vec{b}` and `\vec{a} \cdot \vec{b}`, where a side is plainly no number; else `None`.
    pub(super) fn vector_product(operator: Token<'_>, left: &[Tree], right: &Tree) -> Option<Tree> {
        // unit vectors have hats, and so have operators, which have no cross between
        let is_crossed = |tree: &Tree| operator.text == "\\times" && has_hat(tree);
        let is_one = |tree: &Tree| is_vector(tree) || is_crossed(tree);
        if operator.kind != Kind::Times || !(left.iter().any(is_one) || is_one(right)) {
            return None;
        }
        let left = match left {
            [single] => single.clone(),
            several => Tree::Product(several.to_vec()),
        };
        let operation = match operator.text {
            "\\times" => Operation::Cross(left, right.clone()),
            _ => Operation::Dot(left, right.clone()),
        };
        Some(*boxed(operation, operator.at))
    }

    /// The two inequalities that `left \approx right` means, one side a printed number: the other lies within half a
    /// unit of its last figure, of two printed numbers within that of the coarser. The right side is what was read from token `start` on, the left one what was from
    /// token `before` on.
    pub(super) fn approximately(
        &self,
        [before, start]: [usize; 2],
        [left, right]: [&Tree; 2],
        at: usize,
    ) -> Result<[Equation; 2], Fault> {
        let number = |from: usize, to: usize| {
            let tokens = self.tokens.get(from..to)?;
            tokens.iter().find(|token| token.kind == Kind::Number)
        };
        let side = |from: usize, to: usize, tree: &Tree| printed_unit(tree, number(from, to)?.text);
        for (from, to, tree) in [(before, start, left), (start, self.next, right)] {
            let printed = number(from, to).filter(|_| side(from, to, tree).is_some());
            if let Some(round) =
                printed.filter(|token| token.text.len() > 1 && token.text.ends_with('0') && !token.text.contains('.'))
            {
                let instead = "write the figures that count, as in `1.00 \\cdot 10^3`";
                return Err(Fault::ambiguous(
                    round.at,
                    "how many zeros of this number count",
                    instead,
                ));
            }
        }
        // of two printed numbers the coarser one tells
        let unit = match (side(start, self.next, right), side(before, start, left)) {
            (Some(Tree::Number(one)), Some(Tree::Number(other))) => {
                Some(Tree::Number(if one < other { other } else { one }))
            }
            (unit, other) => unit.or(other),
        };
        let Some(unit) = unit else {
            let instead = "one of its sides must be a printed number";
            return Err(Fault::unsupported(at, "\\approx", instead));
        };
        let equation = |relation, shifted: Tree| Equation {
            left: left.clone(),
            relation,
            right: Tree::Sum(vec![right.clone(), shifted]),
            at: At(at),
            end: At(self.look_back()),
            explains: false,
            doubts: Doubts::default(),
        };
        Ok([
            equation(Relation::GreaterOrEqual, Tree::Negate(Box::new(unit.clone()))),
            equation(Relation::LessOrEqual, unit),
        ])
    }
}

/// The fractions that are derivatives: the tokens up to what is differentiated, and up to the letter below.
struct Shape {
    is_partial: bool,
    order: u32,
    above: usize,
    below: usize,
}

fn boxed(operation: Operation, at: usize) -> Box<Tree> {
    Box::new(Tree::Operation(Box::new(operation), At(at)))
}

/// The letter of an integral right below another with other limits.
fn nested<'t>(of: &'t Tree, limits: Option<&(Tree, Tree)>, by: &Name) -> Option<&'t Name> {
    // limits with the outer variable are those of the inner sign
    let is_bound = |own: &Option<(Tree, Tree)>| {
        own.as_ref()
            .is_some_and(|(low, high)| low.has_free(by) || high.has_free(by))
    };
    let inner = |tree: &'t Tree| match tree {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Integral { by, limits: own, .. } => (own.as_ref() != limits && !is_bound(own)).then_some(by),
            _ => None,
        },
        _ => None,
    };
    match of {
        Tree::Product(factors) => factors.iter().find_map(inner),
        of => inner(of),
    }
}

/// Returns an integral of an integral closed from the outside: each with the differential of the other.
fn from_outside(integral: &Tree) -> Option<Tree> {
    let parts = |tree: &Tree| match tree {
        Tree::Operation(operation, at) => match &**operation {
            Operation::Integral { of, by, limits } => Some((of.clone(), by.clone(), limits.clone(), *at)),
            _ => None,
        },
        _ => None,
    };
    let (of, by, limits, at) = parts(integral)?;
    let (innermost, inner, inner_limits, inner_at) = parts(&of)?;
    if holds_integral(&innermost) {
        return None;
    }
    let closed = |of, by, limits, At(at)| *boxed(Operation::Integral { of, by, limits }, at);
    let within = closed(innermost, by, inner_limits, inner_at);
    Some(closed(within, inner, limits, at))
}

/// Whether the upper limit of a bracket may be its power.
fn may_be_power(upper: &Tree) -> bool {
    match upper {
        Tree::Number(value) => value.to_integer().is_some_and(|value| value > 1),
        Tree::Symbol(name, _) => *name != Name::plain("\\pi"),
        _ => false,
    }
}

fn holds_integral(tree: &Tree) -> bool {
    match tree {
        Tree::Operation(operation, _) => {
            matches!(**operation, Operation::Integral { .. })
                || operation.parts().iter().any(|(part, _)| holds_integral(part))
        }
        tree => {
            let mut found = false;
            tree.map(&mut |part| {
                found |= holds_integral(part);
                part.clone()
            });
            found
        }
    }
}

/// The value at a point, which is the derivative of order 0 there; towards infinity it is a limit.
fn at_point(of: &Tree, by: &Name, there: Tree, at: usize) -> Tree {
    let is_infinite = |tree: &Tree| matches!(tree, Tree::Operation(operation, _) if **operation == Operation::Infinity);
    let (of, by) = (of.clone(), by.clone());
    let is_limit = match &there {
        Tree::Negate(inner) => is_infinite(inner),
        tree => is_infinite(tree),
    };
    *boxed(
        match is_limit {
            true => Operation::Limit { of, by, to: there },
            false => Operation::Derivative {
                of,
                by,
                order: 0,
                at: there,
            },
        },
        at,
    )
}

/// `(tree + more)/2`.
fn half(tree: Tree, more: i64) -> Tree {
    let number = |value| Tree::Number(Rational::from_integer(value));
    let above = match more {
        0 => tree,
        _ => Tree::Sum(vec![tree, number(more)]),
    };
    Tree::Quotient(Box::new(above), Box::new(number(2)), At::default())
}

/// Half a unit of the last figure of a printed number, times whatever stands behind it; `None` where the tree is no
/// such number.
fn printed_unit(tree: &Tree, text: &str) -> Option<Tree> {
    match tree {
        Tree::Number(value) if *value == Rational::from_decimal(text)? => {
            let figures = text.split_once('.').map_or(0, |(_, figures)| figures.len());
            let mut half = Rational::from_ratio(1, 2);
            for _ in 0..figures {
                half /= Rational::from_integer(10);
            }
            Some(Tree::Number(half))
        }
        Tree::Negate(inner) => printed_unit(inner, text),
        // in degrees
        Tree::Quotient(above, below, at) => {
            let Tree::Product(factors) = &**above else {
                return None;
            };
            let [first, Tree::Symbol(pi, _)] = factors.as_slice() else {
                return None;
            };
            let half_turn = Tree::Number(Rational::from_integer(180));
            let unit = printed_unit(first, text).filter(|_| *pi == Name::plain("\\pi") && **below == half_turn)?;
            let above = Tree::Product(vec![unit, factors.get(1)?.clone()]);
            Some(Tree::Quotient(Box::new(above), below.clone(), *at))
        }
        // times a power of ten
        Tree::Product(factors) => {
            let [first, scale] = factors.as_slice() else {
                return None;
            };
            let ten = Tree::Number(Rational::from_integer(10));
            let is_scale = match scale {
                Tree::Power(base, ..) => **base == ten,
                scale => *scale == ten,
            };
            let unit = printed_unit(first, text).filter(|_| is_scale && matches!(first, Tree::Number(_)))?;
            Some(Tree::Product(vec![unit, scale.clone()]))
        }
        _ => None,
    }
}

/// Whether this is plainly no number: a matrix, a cross product, a name with an arrow.
fn is_vector(tree: &Tree) -> bool {
    match tree {
        Tree::Symbol(name, _) => {
            name.accents.iter().any(|accent| accent == "\\vec") || BOLD.iter().any(|bold| name.base.starts_with(bold))
        }
        Tree::Operation(operation, _) => match &**operation {
            Operation::Matrix(_) | Operation::Cross(..) => true,
            Operation::Transpose(of) => !matches!(of, Tree::Number(_)),
            _ => false,
        },
        Tree::Negate(inner) => is_vector(inner),
        Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(is_vector),
        Tree::Quotient(above, ..) => is_vector(above),
        _ => false,
    }
}

/// Returns true for a letter with a hat.
fn has_hat(tree: &Tree) -> bool {
    matches!(tree, Tree::Symbol(name, _) if name.accents.iter().any(|accent| accent == "\\hat"))
}

/// The tree without the differential that ends it, which is none of its factors elsewhere.
fn without_differential(tree: Tree) -> Option<Tree> {
    let one = || Tree::Number(Rational::from_integer(1));
    match tree {
        tree if is_differential(&tree) => Some(one()),
        Tree::Product(mut factors) => {
            let last = factors.pop()?;
            if !is_differential(&last) {
                factors.push(without_differential(last)?);
            }
            Some(match factors.len() {
                1 => factors.pop()?,
                _ => Tree::Product(factors),
            })
        }
        Tree::Quotient(above, below, at) => {
            let above = without_differential(*above)?;
            Some(Tree::Quotient(Box::new(above), below, at))
        }
        _ => None,
    }
}

fn mentions(tree: &Tree, name: &Name) -> bool {
    let mut met = Vec::new();
    symbols(tree, &mut met);
    met.iter()
        .any(|other| other == name || other.subscript.starts_with(&name.base))
}

/// The names of the symbols in a tree, each once.
fn symbols(tree: &Tree, met: &mut Vec<Name>) {
    if let Tree::Symbol(name, _) = tree
        && !met.contains(name)
    {
        met.push(name.clone());
    }
    tree.find_below(&mut |part| {
        symbols(part, met);
        None::<()>
    });
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};
    use super::super::{Names, read, read_expression};

    /// What is read of `tex`, as it is printed; checks that this reads back to the same.
    fn printed(tex: &str) -> String {
        let names = Names::default();
        let tree = read_expression(tex, &names).unwrap_or_else(|error| panic!("{tex}: {error}"));
        let printed = tree.to_string();
        assert_eq!(
            read_expression(&printed, &names).as_ref(),
            Ok(&tree),
            "{tex}: {printed}"
        );
        printed
    }

    #[test]
    fn operations_read_back() {
        for (tex, wanted) in [
            (
                r"\begin{bmatrix} a & -b \\ c & d \\ \end{bmatrix}^{-1} x",
                r"(\begin{pmatrix} a & -b \\ c & d \end{pmatrix})^{-1} x",
            ),
            (
                r"\left(\begin{array}{cc} a & |b| \\ |c| & d \end{array}\right)",
                r"\begin{pmatrix} a & \left|b\right| \\ \left|c\right| & d \end{pmatrix}",
            ),
            (
                r"\begin{vmatrix} a & b \\ c & d \end{vmatrix}",
                r"\det(\begin{pmatrix} a & b \\ c & d \end{pmatrix})",
            ),
            (
                r"\operatorname{tr}\left[\begin{pmatrix} a & b \\ c & d \end{pmatrix} A\right]",
                r"\operatorname{tr}(\begin{pmatrix} a & b \\ c & d \end{pmatrix} A)",
            ),
            (
                r"2 \vec a\times(\vec b\times\vec c) + \vec a \cdot \vec b \, c",
                r"(2 \vec{a}) \times (\vec{b} \times \vec{c}) + (\vec{a} \cdot \vec{b}) c",
            ),
            (r"\frac{d}{dx}\sin(x)", r"\frac{d}{dx} [\sin(x)]"),
            (
                r"\frac{\mathrm{d}^2}{\mathrm{d}x^2}(x^2 a) \cdot b",
                r"[\frac{d^2}{dx^2} (x^2 a)] b",
            ),
            (r"\frac{d^{2} y}{d x^{2}}", r"\frac{d^2}{dx^2} (y)"),
            (
                r"\frac{\partial^2}{\partial x^2}\sqrt{x + y}",
                r"\frac{d^2}{dx^2} (\sqrt{x + y})",
            ),
            (r"(\sin(x))''", r"\frac{d^2}{dx^2} [\sin(x)]"),
            (
                r"\int_0^1 \frac{dx}{1 + x^2} + C",
                r"\int_{0}^{1} \frac{1}{1 + x^2} \, dx + C",
            ),
            (r"\int_0^1 dx \, x y + 1", r"\int_{0}^{1} x y \, dx + 1"),
            (
                r"\int_0^a dx \int_0^b dy \, x y",
                r"\int_{0}^{a} \int_{0}^{b} x y \, dy \, dx",
            ),
            (
                r"\int_0^1 x \, dx \int_0^1 y \, dy",
                r"(\int_{0}^{1} x \, dx) (\int_{0}^{1} y \, dy)",
            ),
            (r"\int_0^1 x \, dx \, y", r"(\int_{0}^{1} x \, dx) y"),
            (
                r"\int_0^a \int_0^b x y \, dy \, dx",
                r"\int_{0}^{a} \int_{0}^{b} x y \, dy \, dx",
            ),
            (
                r"\int_{-\infty}^{+\infty} x dx + \int_a^\infty x dx",
                r"\int_{-\infty}^{\infty} x \, dx + \int_{a}^{\infty} x \, dx",
            ),
            (r"\bigl[x^2\bigr]_a^b", "[x^2]_{x = b} - [x^2]_{x = a}"),
            (r"\left[ a x \right]^{x=2}_{x=a}", "[a x]_{x = 2} - [a x]_{x = a}"),
            (r"[e^{-x}]_0^\infty", r"\lim_{x \to \infty} e^{-x} - [e^{-x}]_{x = 0}"),
            (
                r"\int_a^b t dx - [a t x]_0^1",
                r"\int_{a}^{b} t \, dx - \{[a t x]_{x = 1} - [a t x]_{x = 0}\}",
            ),
            (r"\int x (x + 1) \, \mathrm{d}x", r"\int x \cdot (x + 1) \, dx"),
            (r"\sum_{k=1}^n k(k + 1) - b", r"\sum_{k = 1}^{n} k \cdot (k + 1) - b"),
            (r"\prod\limits_{k=1}^{2n} (2k) ", r"\prod_{k = 1}^{2 n} (2 k)"),
            (r"(\sum_{k=1}^{3} k) + a - k", r"(\sum_{k = 1}^{3} k) + a - k"),
            (
                r"\begin{cases} x, & \text{if } x > 0, \\ -x & x < 0 \\ 0, & \text{otherwise}. \end{cases}",
                r"\begin{cases} x & x > 0 \\ -x & x < 0 \\ 0 & \text{otherwise} \end{cases}",
            ),
            (
                r"\begin{cases} 1 & n \text{ even} \\ 2 & 0 \le x < 1, y > 0 \end{cases}",
                r"\begin{cases} 1 & n \text{ even} \\ 2 & 0 \leq x, x < 1, y > 0 \end{cases}",
            ),
        ] {
            assert_eq!(printed(tex), wanted, "{tex}");
        }
    }

    #[test]
    fn what_operations_are_not() {
        check(&[(r"\frac{d}{2}", "(/ d 2)"), (r"a \cdot b \times c", "(* a b c)")]);
        refuse(&[
            (r"\begin{pmatrix} a & b \\ c \end{pmatrix}", "rows differ in length"),
            (r"\frac{d}{dx} (x + 1)(x - 1)", "a factor behind what is differentiated"),
            (
                r"\sum_{k=1}^{3} k + a - k^2",
                "how far the sum or limit over `k` reaches",
            ),
            (r"\begin{pmatrix} a & b", "is not closed"),
            (r"\begin{pmatrix} & b \end{pmatrix}", "a factor"),
            (r"\frac{d^2}{dx} x", "its order above differs"),
            (r"\frac{d}{dx} x y", "write brackets around all that is differentiated"),
            (
                r"\frac{d}{dx} x \cdot y",
                "write brackets around all that is differentiated",
            ),
            (
                r"\operatorname{tr}\begin{pmatrix} a \end{pmatrix}^2",
                "a power behind this matrix",
            ),
            (r"(a x)'", r"write \frac{d}{dx}"),
            ("(a)'", r"write \frac{d}{dx}"),
            (r"\int x", "without its letter"),
            (r"\int_0^1 x \, dx \, x", "a factor behind an integral"),
            (r"\int_0^1 dx \, y", "a factor behind an integral"),
            (r"\int x + 1 dx", "without its letter"),
            (r"\int (x dx + 1)", "where this integral ends"),
            (r"\int_0 x dx", "with one limit"),
            (r"\int \int x dx dy", "within an integral"),
            (r"[a x]_0^1", "write the letter"),
            (r"[x]_0", "a subscript on an expression"),
            (r"(x)_0^1", "a subscript on an expression"),
            (r"[x]_{x=0}^{y=1}", "of one letter"),
            (r"\sum_{k=1} k", "both limits"),
            (r"\sum_{k=1}^{-\infty} k", "at infinity"),
            (r"\sum_{k=\infty}^{\infty} k", "at minus infinity"),
            (r"\sum_{k}^{n} k", "`=`"),
            (r"\prod_{k=1}^{n} k a", "a product of several factors"),
            (r"\begin{cases} 1 \\ 2 & x > 0 \end{cases}", "a factor"),
            (
                r"\begin{cases} 1 & \text{otherwise} \\ 2 & x > 0 \end{cases}",
                "only the last",
            ),
            (
                r"\begin{cases} 1 & 0 < x < 1 \\ 2 & \text{otherwise} \end{cases}",
                "write its condition",
            ),
        ]);
    }

    #[test]
    fn about_a_printed_number_is_within_half_a_unit_of_its_last_figure() {
        let shown = |tex: &str| -> Vec<String> {
            let equations = read(tex, &Names::default()).unwrap();
            equations.iter().map(ToString::to_string).collect()
        };
        assert_eq!(
            shown(r"\pi \approx 3.140"),
            [r"\pi \geq 3.14 - 0.0005", r"\pi \leq 3.14 + 0.0005"]
        );
        assert_eq!(
            shown(r"x = -2.5 \cdot 10^3 \approx y"),
            [
                r"x = -2.5 \cdot 10^3",
                r"-2.5 \cdot 10^3 \geq y - 0.05 \cdot 10^3",
                r"-2.5 \cdot 10^3 \leq y + 0.05 \cdot 10^3"
            ]
        );
        assert!(read(r"x \approx y", &Names::default()).is_err());
        assert!(read(r"x \approx 2 + y", &Names::default()).is_err());
    }
}
