//! TeX -> tree: sums and products. Where TeX authors mean different things by one spelling, one meaning is taken and the others are
//! noted, or reading fails and says what to write instead.

use super::error::{Fault, Reason};
use super::extent::{Belongs, Extents, last_call};
use super::part::{Form, Part, product, readable, starts_factor};
use super::token::{Bracket, Kind, Token};
use super::{At, Doubt, DoubtKind, Name, Names, Operation, OtherReading, Tree};
use std::collections::HashSet;

/// The deepest nesting that is read: it bounds the stack that reading and all later walks of the tree need.
pub(super) const DEEPEST: usize = 100;

/// The tokens of one equation and how far they are read.
pub(super) struct Reader<'a> {
    pub(super) tokens: Vec<Token<'a>>,
    pub(super) next: usize,
    /// The byte offset behind the last token.
    pub(super) end: usize,
    depth: usize,
    /// Slashes that follow a slash in their term: each deepens the tree without any nesting.
    divisions: usize,
    /// While an integral is read, its differential once it is met.
    pub(super) integral: Option<Option<Name>>,
    /// The letters that the integrals read so far are by.
    pub(super) integrated: Vec<Name>,
    /// The places read so far that have more than one meaning.
    pub(super) doubts: Vec<Doubt>,
    /// The token at which the last derivative written before a factor without brackets ends, and its letter.
    pub(super) derivative: Option<(usize, Name)>,
    /// The tokens at which an argument without brackets ends before what may belong to it.
    pub(super) argument_ends: HashSet<usize>,
    pub(super) names: &'a Names,
}

/// Returns true for what is a factor by convention behind an argument that ends in a letter, as in `\cos x \sqrt{y}` and
/// `\sin x e^x`.
fn is_apart(factor: &Tree) -> bool {
    match factor {
        Tree::Root(..) => true,
        Tree::RealPower(base, ..) | Tree::Power(base, ..) => {
            matches!(&**base, Tree::Symbol(name, _) if *name == Name::plain("e"))
        }
        _ => false,
    }
}

impl<'a> Reader<'a> {
    pub(super) fn new(tokens: Vec<Token<'a>>, names: &'a Names) -> Self {
        let end = tokens.last().map_or(0, |token| token.end);
        Self {
            tokens,
            next: 0,
            end,
            depth: 0,
            divisions: 0,
            integral: None,
            integrated: Vec::new(),
            doubts: Vec::new(),
            derivative: None,
            argument_ends: HashSet::new(),
            names,
        }
    }

    pub(super) fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.next).copied()
    }

    pub(super) fn peek_kind(&self) -> Option<Kind> {
        self.peek().map(|token| token.kind)
    }

    /// The token `ahead` of the next one.
    pub(super) fn look(&self, ahead: usize) -> Option<Token<'a>> {
        self.tokens.get(self.next + ahead).copied()
    }

    /// Where the next token stands.
    pub(super) fn here(&self) -> usize {
        self.peek().map_or(self.end, |token| token.at)
    }

    pub(super) fn take(&mut self, kind: Kind) -> Option<Token<'a>> {
        let token = self.peek().filter(|token| token.kind == kind)?;
        self.next += 1;
        Some(token)
    }

    /// The fault of finding the next token where `wanted` must stand.
    pub(super) fn instead_of(&self, wanted: &str) -> Fault {
        match self.peek() {
            Some(token) if token.kind == Kind::Dots => dots_left_open(token),
            Some(token) => Fault::unexpected(token.at, token.text, wanted),
            None => Fault::unexpected(self.end, "the end", wanted),
        }
    }

    pub(super) fn deepen(&mut self) -> Result<(), Fault> {
        self.depth += 1;
        let most = DEEPEST;
        match self.depth > most {
            true => Err(Fault::new(self.here(), Reason::TooDeep { most })),
            false => Ok(()),
        }
    }

    /// Where reading stands, to read again from there.
    pub(super) fn mark(&self) -> (usize, usize) {
        (self.next, self.depth)
    }

    pub(super) fn reset(&mut self, (next, depth): (usize, usize)) {
        (self.next, self.depth) = (next, depth);
        let here = self.here();
        self.doubts.retain(|doubt| doubt.at.0 < here);
    }

    /// Notes that a place has another meaning than the one taken.
    pub(super) fn doubt(&mut self, at: usize, kind: DoubtKind) {
        self.doubts.push(Doubt { kind, at: At(at) });
    }

    /// Refuses a term with several readings none of which is usual, where it is not decided in each of them.
    pub(super) fn has_one_extent(&self) -> Result<(), Fault> {
        let open = self.doubts.iter().find_map(|doubt| match &doubt.kind {
            DoubtKind::Extent {
                readings,
                is_usual: false,
            } => Some((doubt.at.0, readings.first()?)),
            _ => None,
        });
        open.map_or(Ok(()), |(at, OtherReading { taken, other })| {
            let found = "what follows an argument or a divisor";
            Err(Fault::two_readings(at, found, &taken.to_string(), &other.to_string()))
        })
    }

    pub(super) fn rise(&mut self) {
        self.depth -= 1;
    }

    /// Skips `{}`, which authors put before a sign for its spacing.
    pub(super) fn skip_empty(&mut self) {
        while self.peek_kind() == Some(Kind::BraceOpen)
            && self.look(1).is_some_and(|token| token.kind == Kind::BraceClose)
        {
            self.next += 2;
        }
    }

    /// A sum, up to what cannot belong to it.
    pub(super) fn sum(&mut self) -> Result<Box<Tree>, Fault> {
        self.sum_part().map(|part| part.tree)
    }

    pub(super) fn sum_part(&mut self) -> Result<Part, Fault> {
        self.deepen()?;
        let first = self.signed_term()?;
        self.skip_empty();
        let part = match self.peek_kind().is_some_and(is_sign) {
            true => self.more_terms(first)?,
            false => first,
        };
        self.rise();
        Ok(part)
    }

    /// Returns the letter of the derivative that ends here, if it is written before a factor without brackets.
    fn derivative_behind(&mut self) -> Option<Name> {
        let (end, letter) = self.derivative.take()?;
        (end == self.next).then_some(letter)
    }

    fn more_terms(&mut self, first: Part) -> Result<Part, Fault> {
        let mut open: Vec<Name> = open_letter(&first).into_iter().collect();
        // the terms that may reach over the next ones, and the first sign behind one with its letter
        let mut reaching: Vec<usize> = open.iter().map(|_| 0).collect();
        let mut doubt: Option<(usize, Name)> = None;
        let mut derived = self.derivative_behind();
        // braces around a whole term print the sum that stands there
        let mut terms = vec![*first.tree];
        while self.peek_kind().is_some_and(is_sign) {
            if let Some(dots) = self.look(1).filter(|token| token.kind == Kind::Dots) {
                self.next += 2;
                terms = vec![self.terms_between(dots, &terms)?];
                continue;
            }
            let at = self.here();
            if let Some(letter) = derived.take() {
                if reaching.last() != Some(&(terms.len() - 1)) {
                    reaching.push(terms.len() - 1);
                }
                doubt.get_or_insert((at, letter));
            }
            let term = self.signed_term()?;
            if let Some(letter) = open.iter().find(|letter| term.tree.has_free_letter(letter)) {
                let found = format!("how far the sum or limit over `{letter}` reaches");
                return Err(Fault::ambiguous(at, &found, "write brackets around what it is of"));
            }
            if let Some(letter) = open.last().cloned() {
                doubt.get_or_insert((at, letter));
            }
            if let Some(letter) = open_letter(&term) {
                open.push(letter);
                reaching.push(terms.len());
            }
            derived = self.derivative_behind();
            terms.push(*self.beside(term)?);
            self.skip_empty();
        }
        if let [tree] = terms.as_mut_slice() {
            let tree = Box::new(std::mem::replace(tree, Tree::Sum(Vec::new())));
            return Ok(Part { tree, form: Form::Open });
        }
        if let Some((at, letter)) = doubt {
            let readings = readings_of_reach(&terms, &reaching);
            self.doubt(at, DoubtKind::Reach { letter, readings });
        }
        Ok(Part {
            tree: Box::new(Tree::Sum(terms)),
            form: Form::Open,
        })
    }

    /// A term with the sign before it, if any.
    pub(super) fn signed_term(&mut self) -> Result<Part, Fault> {
        self.skip_empty();
        let Some(kind) = self.peek_kind().filter(|kind| is_sign(*kind)) else {
            return self.term();
        };
        self.next += 1;
        self.no_sign("a sign")?;
        let term = self.term()?;
        let term = match kind {
            Kind::Plus => term.tree,
            _ => self.beside(term)?,
        };
        let tree = match kind {
            Kind::Minus => Box::new(Tree::Negate(term)),
            Kind::PlusMinus => Box::new(Tree::PlusMinus(term)),
            Kind::MinusPlus => Box::new(Tree::MinusPlus(term)),
            _ => term,
        };
        let form = Form::Open;
        Ok(Part { tree, form })
    }

    fn no_sign(&mut self, before: &str) -> Result<(), Fault> {
        self.skip_empty();
        match self.peek() {
            Some(token) if is_sign(token.kind) => {
                let wanted = format!("a factor after {before} (a negative one needs brackets)");
                Err(Fault::unexpected(token.at, token.text, &wanted))
            }
            _ => Ok(()),
        }
    }

    /// The tree of `part`, if something may stand beside it.
    pub(super) fn beside(&self, part: Part) -> Result<Box<Tree>, Fault> {
        match part.form {
            Form::Braced => {
                let instead = "TeX braces do not print; write ( ) around it";
                Err(Fault::ambiguous(self.here(), "what these braces hold", instead))
            }
            _ => Ok(part.tree),
        }
    }

    /// Factors and divisors, from left to right.
    pub(super) fn term(&mut self) -> Result<Part, Fault> {
        let first = self.factor()?;
        self.skip_empty();
        match self.peek_kind() {
            Some(kind) if is_operation(kind) || kind == Kind::Dots || starts_factor(kind) => self.more_factors(first),
            _ => Ok(first),
        }
    }

    fn more_factors(&mut self, first: Part) -> Result<Part, Fault> {
        let mut form = first.form;
        let mut factors = vec![*self.beside(first)?];
        let mut divided = false;
        let (start, mut extents) = (self.here(), Extents::default());
        while let Some(token) = self.peek() {
            let is_open = self.argument_ends.contains(&self.next);
            let juxtaposed = starts_factor(token.kind);
            if self.is_past_differential(factors.last()) {
                break;
            }
            if let Some(dots) = self.dots_of_factors() {
                if divided {
                    return Err(dots_left_open(dots));
                }
                factors = vec![self.factors_between(dots, &factors)?];
                (form, extents) = (Form::Knot, Extents::default());
                self.skip_empty();
                continue;
            }
            if !juxtaposed {
                if !is_operation(token.kind) {
                    break;
                }
                self.next += 1;
                self.no_sign(token.text)?;
            }
            let printed = self.first_printed();
            let is_power_of_negative = self.power_of_negative_follows();
            let factor = self.factor()?;
            if juxtaposed {
                readable(form, &factor, printed.unwrap_or(token))?;
            }
            if juxtaposed
                && matches!(
                    token.kind,
                    Kind::Open(Bracket::Round | Bracket::Square | Bracket::Curly)
                )
            {
                if let Some(value) = self.value_behind(factors.last(), &factor, token.at) {
                    factors.pop();
                    factors.push(value);
                    form = Form::Knot;
                    self.skip_empty();
                    continue;
                }
                if token.kind != Kind::Open(Bracket::Curly) {
                    self.no_operator(factors.last(), &factor.tree, token.at)?;
                }
                if !is_power_of_negative {
                    self.doubt_bracket(factors.last(), &factor.tree, token.at);
                }
            }
            let number = factors.len().saturating_sub(1);
            if token.kind != Kind::Slash {
                let belongs = match is_open && juxtaposed {
                    true => Some(Belongs {
                        is_usual: is_apart(&factor.tree) && ends_in_letter(factors.last()),
                    }),
                    false => Self::may_belong(factors.last(), form, &factor.tree, token),
                };
                belongs
                    .into_iter()
                    .for_each(|belongs| extents.argument(number, belongs));
            }
            let by = factor.form;
            let tree = self.beside(factor)?;
            self.skip_empty();
            if let Some(combined) = Self::vector_product(token, &factors, &tree) {
                let ended = std::mem::take(&mut extents).doubt(&factors);
                ended.into_iter().for_each(|kind| self.doubt(start, kind));
                factors = vec![combined];
                form = by;
                continue;
            }
            if token.kind == Kind::Slash {
                let ended = std::mem::take(&mut extents).doubt_of_quotient(&factors, &tree, At(token.at), is_open);
                ended.into_iter().for_each(|kind| self.doubt(start, kind));
                let above = product(factors);
                self.divisor(by, token.at, divided)?;
                if let (Tree::Product(below), Form::Knot | Form::Bare) = (&*tree, by) {
                    return Err(two_quotients(above, below.clone(), token.at));
                }
                if self.peek_kind().is_some_and(starts_factor) {
                    extents.divisor(0);
                }
                factors = vec![Tree::Quotient(above, tree, At(token.at))];
                divided = true;
            } else {
                factors.push(*tree);
            }
            form = by;
        }
        let ended = extents.doubt(&factors);
        ended.into_iter().for_each(|kind| self.doubt(start, kind));
        let form = match form {
            _ if divided => Form::Open,
            Form::Bare => Form::Bare,
            _ => Form::Knot,
        };
        let tree = product(factors);
        Ok(Part { tree, form })
    }

    /// The next token that prints something.
    pub(super) fn first_printed(&self) -> Option<Token<'a>> {
        let mut rest = self.tokens.iter().skip(self.next);
        rest.find(|token| token.kind != Kind::BraceOpen).copied()
    }

    /// Refuses `(f + g)(t)` and `{f^2}(t)`, which may be values at t or products; `(1 - f)(f - a)` is a product.
    fn no_operator(&self, before: Option<&Tree>, inside: &Tree, at: usize) -> Result<(), Fault> {
        let is_bare = |tree: &Tree| self.names.has_bare_function(tree);
        match before.is_some_and(is_bare) && !is_bare(inside) {
            true => {
                let instead = "write the argument behind each function, or \\cdot for a product";
                Err(Fault::ambiguous(
                    at,
                    "a bracket after a function without argument",
                    instead,
                ))
            }
            false => Ok(()),
        }
    }

    /// Notes that `inside`, which stands between brackets right behind a letter or a derivative, may be its argument.
    fn doubt_bracket(&mut self, before: Option<&Tree>, inside: &Tree, at: usize) {
        let last = self.next.checked_sub(1).and_then(|last| self.tokens.get(last));
        let inside = match inside {
            // a power behind the bracket is none of what stands in it
            Tree::Power(base, ..) | Tree::RealPower(base, ..)
                if last.is_some_and(|last| !matches!(last.kind, Kind::Close(_))) =>
            {
                (**base).clone()
            }
            inside => inside.clone(),
        };
        let letter = match before {
            Some(Tree::Power(base, ..) | Tree::RealPower(base, ..) | Tree::Root(base, ..)) => Some(&**base),
            before => before,
        };
        let kind = match letter {
            Some(Tree::Symbol(of, _)) => DoubtKind::Argument {
                of: of.clone(),
                inside,
                readings: Vec::new(),
            },
            Some(of @ Tree::Partial { .. }) => DoubtKind::DerivativeBeforeBracket {
                of: of.clone(),
                inside,
                readings: Vec::new(),
            },
            Some(of @ Tree::Operation(operation, _))
                if matches!(**operation, Operation::Derivative { order: 1.., .. }) =>
            {
                DoubtKind::DerivativeBeforeBracket {
                    of: of.clone(),
                    inside,
                    readings: Vec::new(),
                }
            }
            _ => return,
        };
        self.doubt(at, kind);
    }

    /// Refuses a divisor that holds a slash itself, and too many slashes in a term.
    fn divisor(&mut self, form: Form, at: usize, again: bool) -> Result<(), Fault> {
        if again {
            self.divisions += 1;
            let most = DEEPEST;
            if self.divisions > most {
                return Err(Fault::new(at, Reason::TooDeep { most }));
            }
        }
        match form {
            // `x/\partial a/\partial b`
            Form::Open => {
                let instead = "write \\frac{..}{..}, or brackets around the divisor";
                Err(Fault::ambiguous(at, "a slash in a divisor", instead))
            }
            _ => Ok(()),
        }
    }
}

/// The fault of a factor right after a divisor, `above/below next`, perhaps between braces: it may belong to the
/// divisor or not.
#[inline(never)]
fn two_quotients(above: Box<Tree>, below: Vec<Tree>, at: usize) -> Fault {
    let quotient = |below| Tree::Quotient(above.clone(), below, At(at));
    let mut outside = below.clone();
    if let Some(first) = outside.first_mut() {
        *first = quotient(Box::new(first.clone()));
    }
    let outside = Tree::Product(outside);
    let inside = quotient(Box::new(Tree::Product(below)));
    let found = "a factor right after a divisor";
    Fault::two_readings(at, found, &outside.to_string(), &inside.to_string())
}

/// The fault of dots of which it is not clear what they stand for.
pub(super) fn dots_left_open(dots: Token<'_>) -> Fault {
    Fault::unreadable(dots.at, dots.text, ": write out what is meant")
}

/// The letter of the sum, product or limit that a term ends in without brackets.
fn open_letter(term: &Part) -> Option<Name> {
    let letter = term.tree.open_letter().cloned();
    letter.filter(|_| term.form != Form::Bracketed)
}

/// The most readings of one sum.
const MOST_REACHES: usize = 8;

/// Returns the other readings of a sum, in which terms at the positions reach over the next one, the next two and so on; none if
/// there are too many.
fn readings_of_reach(terms: &[Tree], positions: &[usize]) -> Vec<OtherReading> {
    let taken = Tree::Sum(terms.to_vec());
    let reading = |mut terms: Vec<Tree>| OtherReading {
        taken: taken.clone(),
        other: match terms.len() {
            1 => terms.remove(0),
            _ => Tree::Sum(terms),
        },
    };
    let all = reaches(terms, 0, positions).unwrap_or_default();
    all.into_iter().skip(1).map(reading).collect()
}

/// Returns the terms with each choice of how far those at the positions reach, as they are first. Positions count from `start`.
fn reaches(terms: &[Tree], start: usize, positions: &[usize]) -> Option<Vec<Vec<Tree>>> {
    let Some((position, later)) = positions.split_first() else {
        return Some(vec![terms.to_vec()]);
    };
    let (before, behind) = terms.split_at_checked(position.checked_sub(start)?)?;
    let (own, behind) = behind.split_first()?;
    let mut found = Vec::new();
    let rests = reaches(behind, position + 1, later)?;
    let longest = rests.iter().map(Vec::len).max()?;
    for count in 0..=longest {
        for rest in &rests {
            let Some((over, rest)) = rest.split_at_checked(count) else {
                continue;
            };
            let wide = match over {
                [] => vec![own.clone()],
                over => reaching_over(own, over)?,
            };
            found.extend(wide.into_iter().map(|own| [before, &[own], rest].concat()));
            // a long sum has many, each as long as the sum
            if found.len() > MOST_REACHES + 1 {
                return None;
            }
        }
    }
    Some(found)
}

/// Returns the ways in which a term that ends in sums, products, limits or derivatives of each other reaches over the next terms,
/// each of these over some of them.
fn reaching_over(term: &Tree, next: &[Tree]) -> Option<Vec<Tree>> {
    let negated = |inner| Tree::Negate(Box::new(inner));
    Some(match term {
        Tree::Product(factors) => {
            let (last, before) = factors.split_last()?;
            let product = |last| Tree::Product([before, &[last]].concat());
            reaching_over(last, next)?.into_iter().map(product).collect()
        }
        Tree::Negate(inner) => reaching_over(inner, next)?.into_iter().map(negated).collect(),
        Tree::Operation(operation, at) => {
            let (Operation::Series { of, .. } | Operation::Limit { of, .. } | Operation::Derivative { of, .. }) =
                &**operation
            else {
                return None;
            };
            let mut found = Vec::new();
            for count in 0..=next.len() {
                let (inside, behind) = next.split_at_checked(count)?;
                let inner = match inside {
                    [] => Some(vec![of.clone()]),
                    inside => reaching_over(of, inside),
                };
                found.extend(inner.into_iter().flatten().map(|inner| {
                    let mut wide = (**operation).clone();
                    if let Operation::Series { of, .. }
                    | Operation::Limit { of, .. }
                    | Operation::Derivative { of, .. } = &mut wide
                    {
                        *of = match behind {
                            [] => inner,
                            behind => Tree::Sum([&[inner], behind].concat()),
                        };
                    }
                    Tree::Operation(Box::new(wide), *at)
                }));
            }
            found
        }
        _ => return None,
    })
}

fn is_sign(kind: Kind) -> bool {
    matches!(kind, Kind::Plus | Kind::Minus | Kind::PlusMinus | Kind::MinusPlus)
}

fn is_operation(kind: Kind) -> bool {
    matches!(kind, Kind::Times | Kind::Star | Kind::Slash)
}

/// Returns true if a factor ends in a function of one letter.
fn ends_in_letter(factor: Option<&Tree>) -> bool {
    let call = factor.and_then(last_call);
    call.is_some_and(|(_, argument)| matches!(argument, Tree::Symbol(..)))
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn sums_and_signs() {
        check(&[
            ("a - b + c", "(+ a (- b) c)"),
            ("-a b + c", "(+ (- (* a b)) c)"),
            ("+a", "a"),
            ("-(-r)", "(- (- r))"),
            ("(-r_B)", "(- r_B)"),
            ("a − b", "(+ a (- b))"),
            ("a {}- b {}", "(+ a (- b))"),
            (r"-b \pm c \mp d", "(+ (- b) (+- c) (-+ d))"),
            (r"\pm c", "(+- c)"),
            ("a + (b - c)", "(+ a (+ b (- c)))"),
            ("((a))", "a"),
            ("{a + b}", "(+ a b)"),
            ("{a + b} - c", "(+ (+ a b) (- c))"),
            ("a + {b - c} + d", "(+ a (+ b (- c)) d)"),
        ]);
        refuse(&[
            ("2 -- b", "a negative one needs brackets"),
            ("a + -b", "a negative one needs brackets"),
            (r"a \cdot -b", "a negative one needs brackets"),
            (r"a \cdot {} -b", "a negative one needs brackets"),
            ("a + ", "found `the end` where a factor"),
            ("a - {b + c}", "TeX braces do not print"),
            ("-{b + c} + a", "TeX braces do not print"),
            ("a{-b}", "TeX braces do not print"),
            ("a {b/c}", "TeX braces do not print"),
            ("", "found `nothing`"),
            ("a = b", "the end of the expression"),
            ("a, b", "found `b` where the end"),
        ]);
    }

    #[test]
    fn products_and_slashes() {
        check(&[
            (r"a b \cdot c \times d * e \ast f", "(* a b c d e f)"),
            ("a(b + c)", "(* a (+ b c))"),
            ("a/b/c", "(/ (/ a b) c)"),
            (r"a b \div c \cdot d", "(* (/ (* a b) c) d)"),
            (r"\frac12(a + b)", "(* (/ 1 2) (+ a b))"),
            (r"1/2 \cdot T_1", "(* (/ 1 2) T_1)"),
            ("(1/2) T_1", "(* (/ 1 2) T_1)"),
            ("-a/b", "(- (/ a b))"),
            (r"2\frac{a}{b}", "(* 2 (/ a b))"),
            (r"2 \cdot 3", "(* 2 3)"),
            (r"{a b} c", "(* (* a b) c)"),
            (
                r"{\cos a \cdot \cos b} + {\cos(a)} b",
                r"(+ (* <\cos a> <\cos b>) (* <\cos a> b))",
            ),
        ]);
        refuse(&[
            (
                "a/b c",
                r"column 2: what follows an argument or a divisor can be read as \frac{a}{b} c or as \frac{a}{b c}",
            ),
            (
                r"x + h/2\pi",
                r"column 6: what follows an argument or a divisor can be read as \frac{h}{2} \pi or as \frac{h}{2 \pi}",
            ),
            ("1/2a", r"\frac{1}{2} a or as \frac{1}{2 a}"),
            ("a b/2c d", r"\frac{a b}{2} c d or as \frac{a b}{2 c} d"),
            ("1/2 T_1", r"\frac{1}{2} T_1 or as \frac{1}{2 T_1}"),
            ("1/2(a + b)", r"\frac{1}{2} (a + b) or as \frac{1}{2 (a + b)}"),
            ("a/(b) c", r"\frac{a}{b} c or as"),
            ("1/r_B(a)", r"`r_B` before a single term in brackets"),
            ("1/0.5 x", r"or as \frac{1}{0.5 x}"),
            ("1/2^2 x", r"or as \frac{1}{2^2 x}"),
            ("1/2 3", "a number right after another factor"),
            ("a/b (c", "`(` is not closed"),
            (r"x/\partial a/\partial b", r"write \frac"),
            ("2 3", r"write \cdot"),
            ("2 {3 a}", r"write \cdot"),
            ("2 2^3", r"write \cdot"),
            ("2 {{2}^3}", r"write \cdot"),
            ("{a 2} 3", "do not print"),
            ("{a 2}^3", "write brackets around"),
            ("1/{2a}", r"\frac{1}{2} a or as \frac{1}{2 a}"),
            (r"1/{2 \cos a}", r"or as \frac{1}{2 \cos"),
            (r"2\frac{1}{2}", r"write \cdot"),
            ("x.5", r"write \cdot"),
            ("a \\over b", r"write \frac"),
        ]);
    }
}
