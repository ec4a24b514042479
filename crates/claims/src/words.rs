//! Formulas in letters that need not commute, as of matrices, vectors and operators: sums of words.

use super::functional::{Mean, has_sums, mean, with_sums};
use super::premise::Statements;
use super::reduce::infinity;
use kernel::{Letter, Word, WordQuestion, Words};
use num_traits::One;
use numbers::Rational;
use std::collections::{BTreeMap, BTreeSet};
use texmath::{
    BOLD, Equation, Invariant, Name, Operation, Relation, Series, Tree, any, base_alone, is_opaque, names_in,
};

/// The most terms of a sum of words, and the highest power that is multiplied out.
const MOST_TERMS: usize = 2_000;
const HIGHEST_POWER: i32 = 12;

/// Values within values beyond which nothing is put in.
const DEEPEST: usize = 20;

/// The beginning of the names that means have as factors.
const MEAN: &str = "mean ";

/// Reads claim and premises; `None` where they say more than that equations hold, or cannot be written in words.
///
/// `columns` says that small letters are columns, so that `x^T A y` is a number.
pub fn word_question(statements: &Statements, operators: &BTreeSet<String>, columns: bool) -> Option<WordQuestion> {
    // a member of a family keeps its place where another does
    let is_member = |name: &Name| {
        let bare = Name {
            subscript: String::new(),
            ..name.clone()
        };
        let bare = bare.to_string();
        let is_one = |own: &String| {
            own.strip_prefix(&bare)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
        };
        name.subscript.contains(BOUND[0]) && operators.iter().any(is_one)
    };
    let holds_bound = |name: &Name| name.base.contains(BOUND[0]) && !operators.is_empty() && is_opaque(name);
    let is_operator = |name: &Name| operators.contains(&name.to_string()) || is_member(name) || holds_bound(name);
    let mut reader = Reader::new(&is_operator);
    (reader.may_transpose, reader.has_columns) = (!operators.is_empty(), columns);
    for local in &statements.locals {
        reader.give(&local.name, &local.tree);
    }
    let mut premises = Vec::new();
    reader.keep_readable();
    for premise in &statements.premises {
        let is_plain = premise.assume.is_empty() && premise.equation.relation == Relation::Equal;
        match &premise.equation.left {
            // of numbers all that is given counts, lest it contradict itself
            _ if !is_plain && operators.is_empty() => return None,
            _ if !is_plain => {}
            Tree::Symbol(name, _) if reader.give(name, &premise.equation.right) => {}
            _ => premises.push(&premise.equation),
        }
    }
    for claim in &statements.claims {
        reader.take_constants(claim);
    }
    reader.keep_readable();
    // what cannot be written in words is not used
    let mut givens: Vec<Words> = Vec::new();
    for premise in premises {
        givens.extend(reader.difference(premise));
    }
    let known: BTreeSet<String> = reader.inverted.keys().cloned().collect();
    let rests = !givens.is_empty() || !reader.values.is_empty();
    let mut claims = Vec::new();
    for claim in &statements.claims {
        claims.push(reader.difference(claim).filter(|_| claim.relation == Relation::Equal)?);
    }
    // x^T A y is a number, and its own transpose
    let words = claims.iter().chain(&givens).flat_map(Words::terms);
    let forms: BTreeSet<Vec<Letter>> = words
        .filter(|(word, _)| columns && !reader.has_adjoints && is_form(word))
        .map(|(word, _)| word.letters.clone())
        .collect();
    for letters in forms {
        let word = Word {
            scalars: BTreeMap::new(),
            letters,
        };
        let form = Words::of(word, Rational::one());
        let given = form.clone().plus(&form.transposed().negated());
        givens.extend((!given.is_zero()).then_some(given));
    }
    givens.extend(reader.inverses());
    // an inverse that nothing speaks of before
    let new = reader
        .inverted
        .iter()
        .filter(|(name, _)| rests && !known.contains(*name));
    let new: Vec<String> = new.map(|(_, of)| format!("{of} has an inverse")).collect();
    reader.provided.extend(new);
    if claims.is_empty() {
        return None;
    }
    let provided = reader.provided.into_iter().collect();
    Some(WordQuestion {
        claims,
        givens,
        provided,
    })
}

/// Writes trees as sums of words.
pub(super) struct Reader<'a> {
    /// The letters that need not commute.
    is_operator: &'a dyn Fn(&Name) -> bool,
    /// Those that equations give, with their values.
    values: BTreeMap<Name, Tree>,
    /// The inverses that were met, by the names that they have as factors, each with what it is the inverse of.
    met: BTreeMap<String, Words>,
    /// What was inverted, as it prints first, by the names of the inverses.
    inverted: BTreeMap<String, String>,
    /// True if small letters in bold are columns.
    has_columns: bool,
    /// True if an adjoint was met, which takes conjugates.
    has_adjoints: bool,
    /// True if `A^T` may be a transpose, and no power.
    may_transpose: bool,
    /// Conditions under which the lengths of sums are what they are taken to be.
    provided: BTreeSet<String>,
    /// How many letters were bound.
    bound: usize,
    /// Letters that stand outside of means, of which these are taken to be no random variables.
    constants: BTreeSet<Name>,
}

impl<'a> Reader<'a> {
    pub fn new(is_operator: &'a dyn Fn(&Name) -> bool) -> Self {
        Self {
            is_operator,
            values: BTreeMap::new(),
            met: BTreeMap::new(),
            inverted: BTreeMap::new(),
            has_columns: true,
            has_adjoints: false,
            may_transpose: false,
            provided: BTreeSet::new(),
            bound: 0,
            constants: BTreeSet::new(),
        }
    }

    /// Gives a letter its value, where it has none and the value does not speak of it; returns whether it does now.
    pub fn give(&mut self, name: &Name, value: &Tree) -> bool {
        let mut spoken = BTreeSet::new();
        names_in(value, &mut spoken);
        let mut open: Vec<Name> = spoken.iter().cloned().collect();
        while let Some(next) = open.pop() {
            if let Some(value) = self.values.get(&next) {
                let mut below = BTreeSet::new();
                names_in(value, &mut below);
                open.extend(below.into_iter().filter(|name| spoken.insert(name.clone())));
            }
        }
        let may_have = !spoken.contains(name) && !self.values.contains_key(name);
        if may_have {
            self.values.insert(name.clone(), value.clone());
        }
        may_have
    }

    /// Forgets the values that cannot be written in words.
    fn keep_readable(&mut self) {
        let values: Vec<(Name, Tree)> = self
            .values
            .iter()
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect();
        for (name, value) in values {
            if self.expanded(&value, 0).is_none() {
                self.values.remove(&name);
            }
        }
    }

    /// Takes the small letters that an equation holds outside of means for constants.
    fn take_constants(&mut self, equation: &Equation) {
        let mut names = BTreeSet::new();
        for side in [&equation.left, &equation.right] {
            names_in(side, &mut names);
        }
        let is_constant = |name: &Name| {
            let letter = name.base.trim_start_matches('\\');
            // `a_I` is random where `I` is
            let has_random_index = name.subscript.contains(|c: char| c.is_ascii_uppercase());
            letter.starts_with(|c: char| c.is_ascii_lowercase())
                && name.accents.is_empty()
                && !is_opaque(name)
                && !has_random_index
        };
        names.retain(|name| is_constant(name) && !self.values.contains_key(name));
        self.constants.append(&mut names);
    }

    /// Returns true if an equation holds in every ring.
    pub fn has_identity(&mut self, equation: &Equation) -> bool {
        self.take_constants(equation);
        equation.relation == Relation::Equal && self.difference(equation).is_some_and(|words| words.is_zero())
    }

    /// Returns the left side less the right one.
    pub fn difference(&mut self, equation: &Equation) -> Option<Words> {
        let left = self.expanded(&equation.left, 0)?;
        Some(left.plus(&self.expanded(&equation.right, 0)?.negated()))
    }

    /// Returns that each inverse that was met is one, on either side.
    fn inverses(&self) -> Vec<Words> {
        let mut given = Vec::new();
        for (name, of) in &self.met {
            let commutes = of.words().all(|word| word.letters.is_empty());
            let inverse = match commutes {
                true => scalar(name),
                false => letter(name),
            };
            let one = Words::constant(-Rational::one());
            given.extend(inverse.times(of).map(|product| product.plus(&one)));
            if !commutes {
                given.extend(of.times(&inverse).map(|product| product.plus(&one)));
            }
        }
        given
    }

    /// Multiplies a tree out, which stands in so many values; `None` where it is too large or says in which order it is
    /// multiplied nowhere.
    fn expanded(&mut self, tree: &Tree, depth: usize) -> Option<Words> {
        match tree {
            Tree::Symbol(name, _) if self.value(name).is_some() => {
                let value = self.value(name)?;
                (depth < DEEPEST).then(|| self.expanded(&value, depth + 1)).flatten()
            }
            // of a matrix nothing is drawn out
            Tree::Symbol(name, _) if (self.is_operator)(name) => Some(self.atom(tree)),
            Tree::Symbol(name, _) if is_opaque(name) => match mean(&name.base) {
                Some(mean) => self.mean(&mean, depth),
                None if has_sums(tree) => self.expanded(&with_sums(tree), depth),
                None => Some(self.atom(tree)),
            },
            Tree::Number(number) => Some(Words::constant(number.clone())),
            Tree::Negate(of) => Some(self.expanded(of, depth)?.negated()),
            Tree::PlusMinus(_) | Tree::MinusPlus(_) => None,
            Tree::Sum(parts) => {
                let mut sum = Words::default();
                for part in parts {
                    sum = sum.plus(&self.expanded(part, depth)?);
                }
                (sum.size() <= MOST_TERMS).then_some(sum)
            }
            Tree::Product(factors) => {
                let mut product = Words::constant(Rational::one());
                for factor in factors {
                    product = product.times(&self.expanded(factor, depth)?)?;
                }
                Some(product)
            }
            // what is printed above a letter is an index
            Tree::Power(of, 0 | 1, _) if matches!(**of, Tree::Symbol(..)) => None,
            // the square of a vector is that of its length
            Tree::Power(of, 2, _) if self.vector_within(of).is_some() => {
                let vector = self.vector_within(of)?;
                self.bilinear(vector, vector, depth, true)
            }
            Tree::Power(of, exponent, _) if exponent.abs() <= HIGHEST_POWER => {
                let printed = of;
                let mut of = self.expanded(of, depth)?;
                if *exponent < 0 {
                    of = self.inverse(&of)?;
                    let factors = of.words().flat_map(|word| &word.letters);
                    let names: Vec<String> = factors.map(|letter| letter.name.clone()).collect();
                    for name in names.into_iter().filter(|name| self.met.contains_key(name)) {
                        self.inverted.entry(name).or_insert_with(|| format!("${printed}$"));
                    }
                }
                (0..exponent.abs()).try_fold(Words::constant(Rational::one()), |product, _| product.times(&of))
            }
            // a quotient does not say on which side the divisor stands
            Tree::Quotient(above, below, _) => {
                let below = self.expanded(below, depth)?;
                let commutes = below.words().all(|word| word.letters.is_empty());
                let inverse = commutes.then(|| self.inverse(&below)).flatten()?;
                self.expanded(above, depth)?.times(&inverse)
            }
            Tree::RealPower(of, exponent, _) if self.may_transpose && is_adjoint(of, exponent) => {
                let of = self.expanded(of, depth)?;
                self.has_adjoints = true;
                let has_scalars = of.words().any(|word| !word.scalars.is_empty());
                match has_scalars {
                    true => Some(self.atom(tree)),
                    false => Some(of.transposed()),
                }
            }
            // A^{-T}
            Tree::RealPower(of, exponent, _)
                if self.may_transpose && matches!(&**exponent, Tree::Negate(sign) if is_adjoint(of, sign)) =>
            {
                let of = self.expanded(of, depth)?;
                self.inverse(&of).map(|inverse| inverse.transposed())
            }
            Tree::Invariant {
                kind: Invariant::Trace,
                of,
                at,
            } => self.trace(&Tree::Symbol(of.clone(), *at), depth),
            Tree::Operation(operation, _) => match &**operation {
                Operation::Series {
                    kind: Series::Sum,
                    of,
                    index,
                    from,
                    to,
                } => self.series(of, index, [from, to], depth),
                Operation::Integral {
                    of,
                    by,
                    limits: Some((low, high)),
                } => self.integral(of, by, [low, high], depth),
                Operation::Trace(of) => self.trace(of, depth),
                Operation::Transpose(of) => Some(self.expanded(of, depth)?.transposed()),
                Operation::Dot(left, right) => self.bilinear(left, right, depth, true),
                Operation::Cross(left, right) => self.bilinear(left, right, depth, false),
                _ => Some(self.atom(tree)),
            },
            tree => Some(self.atom(tree)),
        }
    }

    /// The value of a letter; of a member of a family, `y_i` with a bound index, by what is given of each, `y_j = ...`.
    fn value(&self, name: &Name) -> Option<Tree> {
        if let Some(value) = self.values.get(name) {
            return Some(value.clone());
        }
        let is_bound = name.subscript.starts_with(BOUND[0]) && name.subscript.matches(BOUND[0]).count() == 1;
        let is_bound = is_bound && name.subscript.ends_with(BOUND[1]);
        let letters = FAMILIES.iter().filter(|_| is_bound);
        letters.into_iter().find_map(|letter| {
            let subscript = (*letter).to_owned();
            let value = self.values.get(&Name {
                subscript,
                ..name.clone()
            })?;
            let letter = Name::plain(letter);
            // what is said of one member does not speak of its number, and a sum over it is none of each
            (mentions(value, &letter) && !binds(value, &letter)).then(|| bound(value, &letter, &name.subscript))
        })
    }

    /// A sum over an index, with those within it: finite ones whose ends do not depend on each other may change places.
    fn series(&mut self, of: &Tree, index: &Name, ends: [&Tree; 2], depth: usize) -> Option<Words> {
        // one that may have no value stands for no number
        if !is_finite(&ends) && matches!(ends[0], Tree::Number(_) | Tree::Negate(_)) {
            return None;
        }
        let mut ranges = vec![(index.clone(), ends.map(Tree::clone))];
        let mut of = with_sums(of);
        while let Some((index, ends, body)) = inner_sum(&of).filter(|(index, ends, _)| {
            let is_free = |end: &Tree| !ranges.iter().any(|(outer, _)| mentions(end, outer));
            is_finite(ends)
                && ranges.iter().all(|(outer, ends)| outer != index && is_finite(ends))
                && ends.iter().all(is_free)
        }) {
            ranges.push((index, ends));
            of = body;
        }
        ranges.sort_by_cached_key(|(index, ends)| (ends.each_ref().map(ToString::to_string), index.to_string()));
        let mut tokens = Vec::new();
        for (index, _) in &ranges {
            if self.depends_by_value(&of, index) {
                return None;
            }
            let token = self.token();
            of = bound(&of, index, &token);
            tokens.push(token);
        }
        let mut words = self.expanded(&of, depth)?;
        for ((_, ends), token) in ranges.iter().zip(&tokens).rev() {
            words = self.summed(&words, token, ends.each_ref(), depth)?;
        }
        Some(words)
    }

    /// A sum over the index that a token stands for: what does not depend on it stands in front of it, or behind.
    fn summed(&mut self, body: &Words, token: &str, ends: [&Tree; 2], depth: usize) -> Option<Words> {
        let [from, to] = [self.expanded(ends[0], depth)?, self.expanded(ends[1], depth)?];
        let is_start = matches!(ends[0], Tree::Number(number) if number.0.is_zero() || number.0.is_one());
        let range = format!("sum {}..{}", sum_printed(&from), sum_printed(&to));
        let length = to.plus(&from.negated()).plus(&Words::constant(Rational::one()));
        let commutes = length.words().all(|word| word.letters.is_empty());
        let length = (is_start && is_finite(&ends) && commutes).then(|| {
            let least = if matches!(ends[0], Tree::Number(number) if number.0.is_zero()) {
                "-1"
            } else {
                "0"
            };
            (length, format!(r"{} \ge {least}", ends[1]))
        });
        let is_free = |name: &str| !name.contains(token);
        Some(self.drawn_out(body, &is_free, |reader, inner| match &length {
            Some((length, condition)) if *inner == Word::default() => {
                reader.provided.insert(condition.clone());
                length.clone()
            }
            _ => closed(&range, inner, token),
        }))
    }

    /// A mean: what is constant stands in front of it, or behind. Small letters are constant beside capital ones alone, as the
    /// letters of random variables.
    fn mean(&mut self, mean: &Mean, depth: usize) -> Option<Words> {
        let body = self.expanded(&mean.of, depth)?;
        let known: BTreeSet<String> = self.constants.iter().map(ToString::to_string).collect();
        let are_random = |word: &Word| {
            word.scalars
                .keys()
                .any(|name| name.starts_with(|c: char| c.is_ascii_uppercase()))
        };
        let has_random = !mean.is_conditional && body.words().any(are_random);
        let is_free =
            |name: &str| (has_random && known.contains(name)) || (!mean.is_conditional && name.starts_with(MEAN));
        let spoken = body.words().flat_map(|word| word.scalars.keys());
        let taken = spoken.filter(|name| has_random && known.contains(*name));
        let taken: Vec<String> = taken.map(|name| format!("${name}$ is constant")).collect();
        self.provided.extend(taken);
        // a mean under a condition is random itself
        let kind = if mean.is_conditional { "conditional " } else { "" };
        let range = format!("{kind}{MEAN}{}", mean.sign);
        let token = self.token();
        Some(
            self.drawn_out(&body, &is_free, |_, inner| match *inner == Word::default() {
                true => Words::constant(Rational::one()),
                false => closed(&range, inner, &token),
            }),
        )
    }

    /// Returns a sum of words with what is done to each applied to what is not free in it: the rest stands in front of it, or behind.
    fn drawn_out(
        &mut self,
        body: &Words,
        is_free: &dyn Fn(&str) -> bool,
        done: impl Fn(&mut Self, &Word) -> Words,
    ) -> Words {
        let mut sum = Words::default();
        for (word, coefficient) in body.terms() {
            let (free, scalars) = word.scalars.clone().into_iter().partition(|(name, _)| is_free(name));
            let front = word.letters.iter().take_while(|letter| is_free(&letter.name)).count();
            let rest = word.letters.get(front..).unwrap_or_default();
            let behind = rest.iter().rev().take_while(|letter| is_free(&letter.name)).count();
            let (middle, last) = rest.split_at(rest.len() - behind);
            let inner = Word {
                scalars,
                letters: middle.to_vec(),
            };
            let front = Word {
                scalars: free,
                letters: word.letters.iter().take(front).cloned().collect(),
            };
            let behind = Word {
                scalars: BTreeMap::new(),
                letters: last.to_vec(),
            };
            let inner = done(self, &inner);
            sum.add_between(coefficient, &front, &inner, &behind);
        }
        sum
    }

    /// An integral between limits, term by term; any letter may depend on what it is over.
    fn integral(&mut self, of: &Tree, by: &Name, limits: [&Tree; 2], depth: usize) -> Option<Words> {
        if self.depends_by_value(of, by) {
            return None;
        }
        let token = self.token();
        let body = self.expanded(&bound(of, by, &token), depth)?;
        let [low, high] = [self.expanded(limits[0], depth)?, self.expanded(limits[1], depth)?];
        let range = format!("integral {}..{}", sum_printed(&low), sum_printed(&high));
        let mut sum = Words::default();
        for (word, coefficient) in body.terms() {
            let none = Word::default();
            sum.add_between(coefficient, &none, &closed(&range, word, &token), &none);
        }
        Some(sum)
    }

    /// The trace of a sum, of each word the same for all words that it is turned to.
    fn trace(&mut self, of: &Tree, depth: usize) -> Option<Words> {
        let of = self.expanded(of, depth)?;
        let mut sum = Words::default();
        for (word, coefficient) in of.terms() {
            let turned = word.transposed();
            let turns = [&word.letters, &turned.letters].into_iter().flat_map(|letters| {
                (0..letters.len().max(1)).map(move |by| {
                    let (front, behind) = letters.split_at(by.min(letters.len()));
                    printed(&[behind, front].concat())
                })
            });
            let trace = scalar(&format!("trace {}", turns.min().unwrap_or_default()));
            let scalars = Word {
                scalars: word.scalars.clone(),
                letters: Vec::new(),
            };
            sum.add_between(coefficient, &scalars, &trace, &Word::default());
        }
        Some(sum)
    }

    /// Returns true if the value of a letter speaks of one that is bound here: whether it is meant so, nobody says.
    fn depends_by_value(&self, of: &Tree, letter: &Name) -> bool {
        let mut spoken = BTreeSet::new();
        names_in(of, &mut spoken);
        let mut open: Vec<Name> = spoken.iter().cloned().collect();
        while let Some(next) = open.pop() {
            let is_member = next.subscript.contains(&letter.to_string());
            if let Some(value) = self.values.get(&next).filter(|_| !is_member) {
                if mentions(value, letter) {
                    return true;
                }
                let mut below = BTreeSet::new();
                names_in(value, &mut below);
                open.extend(below.into_iter().filter(|name| spoken.insert(name.clone())));
            }
        }
        false
    }

    /// The sign of a bound letter that no other has.
    fn token(&mut self) -> String {
        self.bound += 1;
        format!("{}{}{}", BOUND[0], self.bound, BOUND[1])
    }

    /// The product of two vectors with a dot or a cross between, of which each is a sum.
    fn bilinear(&mut self, left: &Tree, right: &Tree, depth: usize, is_dot: bool) -> Option<Words> {
        let (left, right) = (self.expanded(left, depth)?, self.expanded(right, depth)?);
        if left.size().saturating_mul(right.size()) > MOST_TERMS {
            return None;
        }
        let mut sum = Words::default();
        for (one, first) in left.terms() {
            for (other, second) in right.terms() {
                let coefficient = first.clone() * second.clone();
                let (scalars, mut vectors) = (
                    Word {
                        letters: Vec::new(),
                        ..one.clone()
                    }
                    .times(&Word {
                        letters: Vec::new(),
                        ..other.clone()
                    }),
                    [one, other].map(|word| printed(&word.letters)),
                );
                // of numbers both are the product
                if vectors.iter().all(String::is_empty) {
                    sum.add(scalars, coefficient);
                    continue;
                }
                if vectors.iter().any(String::is_empty) {
                    return None;
                }
                // what may be a matrix keeps its place
                let are_vectors = [one, other]
                    .iter()
                    .all(|word| word.letters.iter().all(|letter| self.is_vector(letter)));
                let is_turned = vectors[0] > vectors[1] && (!is_dot || are_vectors);
                if is_turned {
                    vectors.reverse();
                }
                let [first, second] = vectors;
                let product = match is_dot {
                    true if are_vectors => scalar(&format!("{first} . {second}")),
                    true => letter(&format!("{first} . {second}")),
                    false if first == second => continue,
                    false => letter(&format!("{first} x {second}")),
                };
                let sign = if is_turned && !is_dot {
                    -coefficient
                } else {
                    coefficient
                };
                sum.add_between(&sign, &scalars, &product, &Word::default());
            }
        }
        Some(sum)
    }

    /// Returns true for a letter that is a vector, and no matrix.
    fn is_vector(&self, letter: &Letter) -> bool {
        is_vector(letter) && (self.has_columns || letter.is_vector)
    }

    /// The vector that a tree is, or is the length of.
    fn vector_within<'t>(&self, tree: &'t Tree) -> Option<&'t Tree> {
        match tree {
            Tree::Symbol(name, _) => self.is_vector(&letter_of(name.to_string())).then_some(tree),
            Tree::Call(name, of, _) if name.base == r"\abs" => self.vector_within(of),
            _ => None,
        }
    }

    /// The inverse of a sum: of one commuting word its inverse, else a factor of its own.
    fn inverse(&mut self, words: &Words) -> Option<Words> {
        let (word, coefficient) = match words.only() {
            Some((word, coefficient)) => (word.clone(), coefficient.clone()),
            None if words.is_zero() => return None,
            None => (Word::default(), Rational::one()),
        };
        let scalars = word.scalars.iter().map(|(factor, power)| (factor.clone(), -power));
        let scalars = Words::of(
            Word {
                scalars: scalars.collect(),
                letters: Vec::new(),
            },
            Rational::one() / coefficient,
        );
        let rest = match words.only() {
            Some(_) => Words::of(
                Word {
                    scalars: BTreeMap::new(),
                    ..word
                },
                Rational::one(),
            ),
            None => words.clone(),
        };
        if rest == Words::constant(Rational::one()) {
            return Some(scalars);
        }
        // nothing is divided by a vector
        let is_of_vector = |letter: &Letter| {
            is_vector(&Letter {
                is_transposed: false,
                ..letter.clone()
            })
        };
        if rest
            .words()
            .any(|word| matches!(word.letters.as_slice(), [only] if is_of_vector(only)))
        {
            return None;
        }
        // (A^T)^{-1} is the transpose of A^{-1}
        let turned = rest.transposed();
        let signs = |words: &Words| {
            let letters = words.words().flat_map(|word| &word.letters);
            letters.filter(|letter| letter.is_transposed).count()
        };
        let is_turned = (signs(&turned), &turned) < (signs(&rest), &rest);
        let of = if is_turned { turned } else { rest };
        let name = format!("({})^-1", sum_printed(&of));
        let inverse = match of.words().all(|word| word.letters.is_empty()) {
            true => scalar(&name),
            false => letter(&name),
        };
        self.met.insert(name, of);
        let inverse = if is_turned { inverse.transposed() } else { inverse };
        scalars.times(&inverse)
    }

    /// A factor that is not looked into.
    fn atom(&self, tree: &Tree) -> Words {
        let is_operator = |node: &Tree| {
            let is_letter = matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..)
                if (self.is_operator)(name) || self.values.contains_key(name));
            is_letter || matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Matrix(_)))
        };
        let name = tree.to_string();
        match any(tree, &mut |node| is_operator(node)) {
            true => letter(&name),
            false => scalar(&name),
        }
    }
}

fn scalar(name: &str) -> Words {
    let scalars = BTreeMap::from([(name.to_owned(), 1)]);
    Words::of(
        Word {
            scalars,
            letters: Vec::new(),
        },
        Rational::one(),
    )
}

/// Accents of vectors.
const ARROWS: [&str; 2] = [r"\vec", r"\overrightarrow"];

/// The factor of a name; under an arrow it is a vector.
fn letter_of(name: String) -> Letter {
    Letter {
        is_vector: ARROWS.iter().any(|arrow| name.contains(arrow)),
        name,
        is_transposed: false,
    }
}

fn letter(name: &str) -> Words {
    Words::of(
        Word {
            scalars: BTreeMap::new(),
            letters: vec![letter_of(name.to_owned())],
        },
        Rational::one(),
    )
}

/// Returns true for a small letter, in bold or not, with whatever stands at it: by custom it is a column.
fn is_small(name: &str) -> bool {
    let of = BOLD.iter().find_map(|bold| name.strip_prefix(bold)).unwrap_or(name);
    let of = of.trim_start_matches(['{', ' ', '\\']);
    let ends = of.find(['_', '^', '}']).unwrap_or(of.len());
    let letter = of.get(..ends).unwrap_or_default();
    let is_name = letter.chars().count() == 1 || texmath::letter(&format!("\\{letter}")).is_some();
    is_name && letter.starts_with(|c: char| c.is_ascii_lowercase())
}

/// Returns true if a word is a number: a column transposed, matrices, a column.
fn is_form(word: &Word) -> bool {
    match word.letters.as_slice() {
        [first, inner @ .., last] => {
            let is_column = |letter: &Letter| is_small(&letter.name);
            first.is_transposed
                && is_column(first)
                && is_column(last)
                && !last.is_transposed
                && !inner.iter().any(is_column)
        }
        _ => false,
    }
}

/// Returns true for a small letter in bold, or one under an arrow: it is a vector, and no matrix.
fn is_vector(letter: &Letter) -> bool {
    let of = BOLD.iter().find_map(|bold| letter.name.strip_prefix(bold));
    let begins_small = |of: &str| {
        of.trim_start_matches(['{', ' '])
            .starts_with(|c: char| c.is_ascii_lowercase())
    };
    !letter.is_transposed && (letter.is_vector || of.is_some_and(begins_small))
}

/// The characters around the sign of a bound letter.
const BOUND: [char; 2] = ['\u{1}', '\u{2}'];

/// Letters that number the members of a family, of which all is given what is given of one.
const FAMILIES: [&str; 4] = ["i", "j", "k", "l"];

/// Puts the sign of a bound letter in its place, in subscripts too; a term that is not understood depends on it.
fn bound(tree: &Tree, letter: &Name, token: &str) -> Tree {
    let printed = letter.to_string();
    let named = |name: &Name| {
        if name == letter {
            return Name::plain(token);
        }
        let mut name = name.clone();
        name.subscript = with_token(&name.subscript, &printed, token);
        if is_opaque(&name) {
            name.base = with_token(&name.base, &printed, token) + token;
        }
        name
    };
    let again = |part: &Tree| bound(part, letter, token);
    match tree {
        Tree::Symbol(name, at) => Tree::Symbol(named(name), *at),
        Tree::Call(name, argument, at) => Tree::Call(named(name), Box::new(again(argument)), *at),
        Tree::Partial { of, by, at } => Tree::Partial {
            of: named(of),
            by: named(by),
            at: *at,
        },
        Tree::Operation(operation, at) => {
            let is_own = operation.letter() == Some(letter);
            let operation = operation.map(&mut |part, is_bound| match is_own && is_bound {
                true => part.clone(),
                false => again(part),
            });
            Tree::Operation(Box::new(operation), *at)
        }
        tree => tree.map(&mut |part| again(part)),
    }
}

/// Returns true if a letter stands in a tree, in a subscript too.
fn mentions(tree: &Tree, letter: &Name) -> bool {
    bound(tree, letter, "\u{3}") != *tree
}

/// Returns true if an operation in a tree binds a letter.
fn binds(tree: &Tree, letter: &Name) -> bool {
    any(
        tree,
        &mut |node| matches!(node, Tree::Operation(operation, _) if operation.letter() == Some(letter)),
    )
}

/// Returns true if a sum between these ends has so many terms.
fn is_finite(ends: &[impl std::borrow::Borrow<Tree>; 2]) -> bool {
    ends.iter()
        .all(|end| !matches!(end.borrow(), Tree::Operation(..)) && infinity(end.borrow()).is_none())
}

/// Returns the index and the ends of a sum that a tree is, or has for a factor whose index the others do not speak of, and what is
/// summed then.
fn inner_sum(tree: &Tree) -> Option<(Name, [Tree; 2], Tree)> {
    match tree {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Series {
                kind: Series::Sum,
                of,
                index,
                from,
                to,
            } => Some((index.clone(), [from.clone(), to.clone()], of.clone())),
            _ => None,
        },
        Tree::Product(factors) => factors.iter().enumerate().find_map(|(at, factor)| {
            let (index, ends, body) = inner_sum(factor)?;
            let mut others = factors.iter().enumerate().filter(|(other, _)| *other != at);
            if others.any(|(_, other)| mentions(other, &index)) {
                return None;
            }
            let mut factors = factors.clone();
            *factors.get_mut(at)? = body;
            Some((index, ends, Tree::Product(factors)))
        }),
        _ => None,
    }
}

/// Puts a sign in the place of a letter in a subscript or a term.
fn with_token(text: &str, letter: &str, token: &str) -> String {
    let (mut written, mut rest) = (String::new(), text);
    while let Some(c) = rest.chars().next() {
        let behind = rest.get(c.len_utf8()..).unwrap_or_default();
        let length = match c {
            '\\' => c.len_utf8() + behind.bytes().take_while(u8::is_ascii_alphabetic).count(),
            c => c.len_utf8(),
        };
        let (sign, behind) = rest.split_at(length);
        written.push_str(if sign == letter { token } else { sign });
        rest = behind;
    }
    written
}

/// A factor that binds a letter: a word within, with the letter numbered by how many are bound in it.
fn closed(range: &str, word: &Word, token: &str) -> Words {
    let inner = sum_printed(&Words::of(word.clone(), Rational::one()));
    let level = (1..)
        .find(|level| !inner.contains(&format!("#{level}#")))
        .unwrap_or(1_usize);
    let name = format!("{range} {}", inner.replace(token, &format!("#{level}#")));
    match word.letters.is_empty() {
        true => scalar(&name),
        false => letter(&name),
    }
}

/// Factors as they are named within the name of another.
fn printed(letters: &[Letter]) -> String {
    let mark = |letter: &Letter| if letter.is_transposed { "'" } else { "" };
    let letters = letters
        .iter()
        .map(|letter| format!("[{}]{}", letter.name, mark(letter)));
    letters.collect()
}

/// A sum as it is named within the name of another factor.
fn sum_printed(words: &Words) -> String {
    let terms = words.terms().map(|(word, coefficient)| {
        let scalars = word.scalars.iter().map(|(factor, power)| format!("[{factor}]^{power}"));
        format!(
            "{coefficient:?}{}{}",
            scalars.collect::<String>(),
            printed(&word.letters)
        )
    });
    terms.collect::<Vec<_>>().join(" + ")
}

/// Returns what is transposed, where that is what a tree is.
pub(super) fn transposed(tree: &Tree) -> Option<&Tree> {
    match tree {
        Tree::RealPower(of, exponent, _) => match &**exponent {
            Tree::Negate(sign) => is_sign_of_transpose(of, sign).then_some(of),
            sign => is_sign_of_transpose(of, sign).then_some(of),
        },
        Tree::Operation(operation, _) => match &**operation {
            Operation::Transpose(of) => Some(of),
            _ => None,
        },
        _ => None,
    }
}

/// Returns true if an exponent is the sign of an adjoint; `T` may be a number where the reader took it for none of a transpose.
fn is_adjoint(of: &Tree, exponent: &Tree) -> bool {
    let is_t = matches!(exponent, Tree::Symbol(name, _) if name.base == "T");
    !is_t && is_sign_of_transpose(of, exponent)
}

/// Returns true if an exponent is the sign of a transpose or an adjoint.
pub(super) fn is_sign_of_transpose(of: &Tree, exponent: &Tree) -> bool {
    let Tree::Symbol(name, _) = exponent else {
        return false;
    };
    // I^H of a number is a power
    let is_small = |node: &Tree| {
        matches!(node, Tree::Number(_))
            || matches!(node, Tree::Symbol(name, _) if !name.base.chars().all(|c| c.is_ascii_uppercase()))
    };
    let is_alone = *name == base_alone(name);
    match name.base.as_str() {
        r"\dagger" => true,
        "T" => is_alone && !matches!(of, Tree::Number(_)),
        "H" => is_alone && !any(of, &mut |node| is_small(node)),
        _ => false,
    }
}
