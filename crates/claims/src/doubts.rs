//! The other meanings that a claim may have: what its verdict may not rest on.

use super::definition::letters_of;
use super::entry::{Entry, Role, Standing, approached};
use super::exponents::{is_at_times_whole, is_plainly_not_negative};
use super::sheet::Sheet;
use numbers::{Field, Rational};
use std::collections::BTreeSet;
use texmath::{
    Condition, DoubtKind, Equation, Name, Operation, OtherReading, Relation, Tree, any, any_side, flies, holds,
    names_in, number_of, speaks_of, with_symbol,
};

/// The most other readings of a claim that are decided.
const MOST_READINGS: usize = 15;

/// The most letters of a formula for which an argument is substituted.
const MOST_LETTERS: usize = 4;

/// Another reading of a place.
enum Reading {
    /// A part of the formula that the reader built otherwise.
    Part(OtherReading),
    /// The value of a letter at the content of the bracket behind it, in place of the product.
    Value { of: Name, inside: Tree, value: Tree },
    /// Powers with odd denominators as odd roots of all real numbers.
    OddRoots,
    /// `\log x` as the logarithm to a base, in the claim and in what it rests on.
    Logarithm { base: i64 },
}

/// The bases, beside that of the natural logarithm, to which `\log` may be one.
const BASES: [i64; 2] = [10, 2];

/// The function of a logarithm whose base is not printed.
const LOG: &str = r"\log";

impl Reading {
    /// Returns the tree in this reading; sets `met` if it contains the place.
    fn of(&self, tree: &Tree, met: &mut bool) -> Tree {
        match (self, tree) {
            (Self::Part(part), tree) if *tree == part.taken => {
                *met = true;
                part.other.clone()
            }
            (Self::OddRoots, Tree::RealPower(base, exponent, at)) if let Some((power, index)) = odd_root(exponent) => {
                *met = true;
                let root = Tree::Root(Box::new(self.of(base, met)), index, *at);
                match power {
                    1 => root,
                    power => Tree::Power(Box::new(root), power, *at),
                }
            }
            (Self::Logarithm { base }, Tree::Call(name, argument, at)) if name.base == LOG => {
                *met = true;
                let natural = |of: Tree| Box::new(Tree::Call(Name::plain(r"\ln"), Box::new(of), *at));
                let below = Tree::Number(Rational::from_integer(*base));
                Tree::Quotient(natural(self.of(argument, met)), natural(below), *at)
            }
            (Self::Value { of, inside, value }, Tree::Product(factors)) => {
                let mut read: Vec<Tree> = Vec::new();
                for factor in factors {
                    let new = match factor {
                        factor if factor == inside => Some(value.clone()),
                        Tree::Power(base, exponent, at) if **base == *inside => {
                            Some(Tree::Power(Box::new(value.clone()), *exponent, *at))
                        }
                        _ => None,
                    };
                    match (read.last(), new) {
                        (Some(Tree::Symbol(name, _)), Some(new)) if name == of => {
                            *met = true;
                            read.pop();
                            read.push(new);
                        }
                        (Some(Tree::Power(letter, exponent, at)), Some(new)) if is_symbol(letter, of) => {
                            *met = true;
                            let power = Tree::Power(Box::new(new), *exponent, *at);
                            read.pop();
                            read.push(power);
                        }
                        _ => read.push(self.of(factor, met)),
                    }
                }
                match read.as_slice() {
                    [one] => one.clone(),
                    _ => Tree::Product(read),
                }
            }
            (_, tree) => tree.map(&mut |below| self.of(below, met)),
        }
    }

    /// Returns true if a tree contains the place.
    fn is_in(&self, tree: &Tree) -> bool {
        let mut met = false;
        self.of(tree, &mut met);
        met
    }
}

/// The power and the index of the root of an exponent whose denominator is odd.
fn odd_root(exponent: &Tree) -> Option<(i32, u32)> {
    let value = number_of(exponent)?;
    let index = u32::try_from(value.0.denominator()).ok()?;
    let power = i32::try_from(value.0.numerator()).ok()?;
    (index > 1 && index % 2 == 1).then_some((power, index))
}

impl Entry {
    /// Returns the entry with all of its formulas in another reading.
    fn reread(&self, reading: &Reading) -> Self {
        let mut entry = self.clone();
        let new = |side: &mut Tree| *side = reading.of(side, &mut false);
        let beside = entry
            .local
            .iter_mut()
            .chain(&mut entry.with)
            .map(|(equation, _)| equation);
        let assumed = entry.assume.iter_mut().map(|(condition, _)| condition);
        let mut relations: Vec<&mut Equation> = Vec::new();
        for condition in assumed {
            match condition {
                Condition::Relation(relation) => relations.push(relation),
                Condition::Integer(tree) => new(tree),
            }
        }
        let equations = entry
            .equations
            .iter_mut()
            .chain(&mut entry.stated)
            .chain(&mut entry.alternatives);
        for equation in equations.chain(beside).chain(relations) {
            new(&mut equation.left);
            new(&mut equation.right);
        }
        entry.own.iter_mut().for_each(|local| new(&mut local.tree));
        entry
    }

    /// Returns the entry in other readings of its equations; `None` unless these contain all places.
    fn read_otherwise(&self, readings: &[&Reading]) -> Option<Self> {
        let mut entry = self.clone();
        for reading in readings {
            let mut met = false;
            let stated = entry.equations.iter_mut().chain(&mut entry.stated);
            let sides = stated.flat_map(|equation| [&mut equation.left, &mut equation.right]);
            for side in sides.chain(entry.own.iter_mut().map(|local| &mut local.tree)) {
                *side = reading.of(side, &mut met);
            }
            if !met {
                return None;
            }
        }
        Some(entry)
    }
}

/// Returns true for a limit in which a letter grows without bound.
fn grows(limit: &Tree, letter: &Tree) -> bool {
    match (limit, letter) {
        (Tree::Operation(operation, _), Tree::Symbol(letter, _)) => match &**operation {
            Operation::Limit { by, to, .. } => {
                let is_infinity = matches!(to, Tree::Operation(to, _) if matches!(**to, Operation::Infinity));
                by == letter && is_infinity
            }
            _ => false,
        },
        _ => false,
    }
}

impl Sheet {
    /// Reads letters before brackets as the values of what they stand for, `V(x^2)` after `V = a x^2 + b`, where the argument is the
    /// letter that both share; the product stays as another reading. A sum in brackets is mostly a factor.
    pub(super) fn take_values(&mut self) {
        for position in 0..self.entries.len() {
            let Some(claim) = self.entries.get(position).filter(|claim| claim.unread.is_none()) else {
                continue;
            };
            let below = self.below(claim);
            let mut read: Option<Entry> = None;
            for (number, doubt) in claim.doubts.iter().enumerate() {
                let DoubtKind::Argument { of, inside, .. } = &doubt.kind else {
                    continue;
                };
                let Some(value) = self.value_at(of, inside, claim, &below) else {
                    continue;
                };
                let reading = Reading::Value {
                    of: of.clone(),
                    inside: inside.clone(),
                    value: value.clone(),
                };
                let Some(mut new) = read.as_ref().unwrap_or(claim).read_otherwise(&[&reading]) else {
                    continue;
                };
                if let Some(doubt) = new.doubts.get_mut(number) {
                    let letter = Tree::Symbol(of.clone(), doubt.at);
                    doubt.kind = DoubtKind::Argument {
                        of: of.clone(),
                        inside: inside.clone(),
                        readings: vec![OtherReading {
                            taken: value,
                            other: Tree::Product(vec![letter, inside.clone()]),
                        }],
                    };
                }
                read = Some(new);
            }
            if let (Some(entry), Some(read)) = (self.entries.get_mut(position), read) {
                *entry = read;
            }
        }
    }

    /// The value of a letter at the content of the bracket behind it, where one formula in letters gives it, and one letter of that
    /// stands in the bracket.
    fn value_at(&self, of: &Name, inside: &Tree, claim: &Entry, below: &[&Entry]) -> Option<Tree> {
        let is_known = self.symbols.is_parameter(of) || self.symbols.impact(of).is_some();
        let meanings = self.meanings(of, claim, below);
        let [meaning] = meanings.as_slice() else {
            return None;
        };
        let inner = letters_of(inside);
        // a letter that runs in the formula is none of its arguments, and would catch one in the bracket
        let runs = any(
            meaning,
            &mut |node| matches!(node, Tree::Operation(operation, _) if operation.letter().is_some_and(|letter| inner.contains(letter))),
        );
        let shared: Vec<Name> = letters_of(meaning)
            .into_iter()
            .filter(|letter| !runs && inner.contains(letter))
            .collect();
        match shared.as_slice() {
            [letter] if !is_known && !matches!(inside, Tree::Sum(_)) => Some(with_symbol(meaning, letter, inside)),
            _ => None,
        }
    }

    /// The places at which the claim at a position, or something that it rests on, has a meaning that was not taken.
    pub fn doubts(&self, position: usize) -> Vec<DoubtKind> {
        let Some(claim) = self.entries.get(position) else {
            return Vec::new();
        };
        let mut found: Vec<DoubtKind> = claim.guessed.iter().cloned().map(DoubtKind::Guess).collect();
        let below = self.below(claim);
        // what is printed again holds in whatever meaning it did
        let mut given = claim.follows_from.iter().filter_map(|&at| self.entries.get(at));
        let is_plain = |own: &Entry| own.assume.is_empty() && own.with.is_empty() && own.local.is_empty();
        if given.any(|own| own.equations == claim.equations && is_plain(own)) {
            let marked = claim.doubts.iter().map(|doubt| &doubt.kind);
            found.extend(marked.filter(|kind| matches!(kind, DoubtKind::Marked(_))).cloned());
            return found;
        }
        let read = std::iter::once(claim).chain(below.iter().copied());
        let read = read.flat_map(|entry| &entry.doubts).map(|doubt| &doubt.kind);
        for kind in read.filter(|kind| self.is_plausible(kind, claim, &below)) {
            if !found.contains(kind) {
                found.push(kind.clone());
            }
        }
        found.extend(self.powers_of_signs(claim, &below));
        found.extend(self.odd_roots(claim, &below));
        found.extend(self.logarithm(claim, &below));
        found.extend(self.of_some(claim, &below).into_iter().map(DoubtKind::OfSome));
        found.extend(self.one_step(claim, &below));
        found.extend(tends(claim).map(DoubtKind::Tends));
        found
    }

    /// Returns the sheets in which the claim at a position is read otherwise, one for each choice of readings at the places with
    /// other known readings, and these places; none if a place is not in the claim's equations alone, or there are too many
    /// choices.
    pub fn read_otherwise(&self, position: usize) -> (Vec<Sheet>, Vec<DoubtKind>) {
        let none = || (Vec::new(), Vec::new());
        let Some(claim) = self.entries.get(position) else {
            return none();
        };
        let below = self.below(claim);
        let places = self.doubts(position).into_iter().map(|kind| {
            let readings = self.readings(&kind, claim, &below);
            (kind, readings)
        });
        let places: Vec<(DoubtKind, Vec<Reading>)> = places.filter(|(_, readings)| !readings.is_empty()).collect();
        let choices = places.iter().map(|(_, readings)| readings.len() + 1);
        let choices = choices.fold(1_usize, usize::saturating_mul);
        if choices > MOST_READINGS + 1 {
            return none();
        }
        let beside = claim.local.iter().chain(&claim.with).map(|(equation, _)| equation);
        let beside = beside
            .chain(&claim.alternatives)
            .chain(below.iter().flat_map(|entry| &entry.equations));
        let assumed = claim.assume.iter().flat_map(|(condition, _)| condition.sides());
        let mut elsewhere = beside
            .flat_map(|equation| [&equation.left, &equation.right])
            .chain(assumed);
        let is_joint = |reading: &&Reading| matches!(reading, Reading::Logarithm { .. });
        let readings = places.iter().flat_map(|(_, readings)| readings);
        let readings: Vec<&Reading> = readings.filter(|reading| !is_joint(reading)).collect();
        if elsewhere.any(|side| readings.iter().any(|reading| reading.is_in(side))) {
            return none();
        }
        let otherwise = (1..choices).map(|mut choice| {
            let mut chosen = Vec::new();
            for (_, readings) in &places {
                let which = choice % (readings.len() + 1);
                choice /= readings.len() + 1;
                chosen.extend(which.checked_sub(1).and_then(|which| readings.get(which)));
            }
            let (joint, own): (Vec<&Reading>, Vec<&Reading>) = chosen.into_iter().partition(is_joint);
            claim.read_otherwise(&own).map(|claim| {
                let mut sheet = self.clone();
                if let Some(entry) = sheet.entries.get_mut(position) {
                    *entry = claim;
                }
                for reading in joint {
                    sheet.symbols.reread(&mut |tree| *tree = reading.of(tree, &mut false));
                    let reread = sheet.entries.iter().map(|entry| entry.reread(reading));
                    sheet.entries = reread.collect();
                }
                sheet
            })
        });
        match otherwise.collect::<Option<Vec<Sheet>>>() {
            Some(sheets) => (sheets, places.into_iter().map(|(kind, _)| kind).collect()),
            None => none(),
        }
    }

    /// Returns the sheet in which the index of the claim at a position runs, and this reading in words, where the claim is on
    /// a step that no premise is about and a premise is about another one. Beside times the index is one impact.
    pub fn at_each_index(&self, position: usize) -> Option<(Sheet, String)> {
        if self.symbols.times().next().is_some() {
            return None;
        }
        let claim = self.entries.get(position).filter(|entry| entry.unread.is_none())?;
        let kind = self.one_step(claim, &self.below(claim))?;
        let mut sheet = self.clone();
        sheet
            .symbols
            .declare(Name::plain(&self.symbols.index), texmath::Meaning::Index);
        Some((sheet, kind.other()?))
    }

    /// The other readings of a place, where all are known.
    fn readings(&self, kind: &DoubtKind, claim: &Entry, below: &[&Entry]) -> Vec<Reading> {
        let (of, inside) = match kind {
            DoubtKind::Argument { of, inside, readings } if readings.is_empty() => (of, inside),
            DoubtKind::OddRoot { .. } => return vec![Reading::OddRoots],
            DoubtKind::Logarithm { .. } => return BASES.map(|base| Reading::Logarithm { base }).into(),
            kind => return kind.readings().iter().cloned().map(Reading::Part).collect(),
        };
        let mut readings = Vec::new();
        for meaning in self.meanings(of, claim, below) {
            let letters = letters_of(meaning);
            if letters.len() > MOST_LETTERS {
                return Vec::new();
            }
            readings.extend(letters.into_iter().map(|letter| Reading::Value {
                of: of.clone(),
                inside: inside.clone(),
                value: with_symbol(meaning, &letter, inside),
            }));
        }
        readings
    }

    /// What a claim follows from, and the definitions below that.
    fn below<'e>(&'e self, claim: &Entry) -> Vec<&'e Entry> {
        let mut below: Vec<&Entry> = claim.follows_from.iter().filter_map(|&n| self.entries.get(n)).collect();
        for definition in self.definitions_below(claim) {
            if !below.iter().any(|known| known.label == definition.label) {
                below.push(definition);
            }
        }
        below
    }

    /// Returns true if a reader would think of the other meaning of a place:
    /// - A letter may have an argument if a formula in letters gives it, and it is no state at an impact.
    /// - A derivative may be taken at what a bracket behind it contains, but a sum behind the derivative of a state at an
    ///   impact is a factor.
    /// - A function may be applied again if its values are given, and it is no state.
    fn is_plausible(&self, kind: &DoubtKind, claim: &Entry, below: &[&Entry]) -> bool {
        let of = match kind {
            DoubtKind::Argument { of, .. } => of,
            DoubtKind::DerivativeBeforeBracket { of, inside, .. } => {
                return !(self.is_of_impacts(of) && matches!(inside, Tree::Sum(_)));
            }
            DoubtKind::PowerOfFunction { of, .. } => return self.is_given(of, below),
            _ => return true,
        };
        // a state at an impact is a number
        self.symbols.impact(of).is_none()
            && self
                .meanings(of, claim, below)
                .into_iter()
                .any(|meaning| !letters_of(meaning).is_empty())
    }

    /// What a letter stands for by what a claim follows from, its own definitions and the abbreviations of the sheet.
    fn meanings<'e>(&'e self, of: &Name, claim: &'e Entry, below: &[&'e Entry]) -> Vec<&'e Tree> {
        let own = std::iter::once(claim).chain(below.iter().copied());
        let said = own.clone().flat_map(|entry| {
            let local = entry.local.iter().map(|(equation, _)| equation);
            let equations = entry.equations.iter().filter(|_| entry.role != Role::Claim);
            local.chain(equations)
        });
        let sides = said.flat_map(|equation| [(&equation.left, &equation.right), (&equation.right, &equation.left)]);
        let sides = sides
            .filter(|(name, _)| is_symbol(name, of))
            .map(|(_, meaning)| meaning);
        let locals = own.flat_map(|entry| &entry.own).filter(|local| local.name == *of);
        // T_1 = t_{k+1} - t_k is a number
        let is_of_impacts = |meaning: &Tree| !self.symbols.impacts_in(meaning).is_empty();
        let abbreviations = self.symbols.abbreviations();
        let abbreviations = abbreviations.filter(|(name, meaning)| *name == of && !is_of_impacts(meaning));
        let mut found: Vec<&Tree> = Vec::new();
        for meaning in sides
            .chain(locals.map(|local| &local.tree))
            .chain(abbreviations.map(|(_, meaning)| meaning))
        {
            // a vector that its components give is no function
            let is_vector =
                matches!(meaning, Tree::Operation(operation, _) if matches!(**operation, Operation::Matrix(_)));
            if !is_vector && !found.contains(&meaning) {
                found.push(meaning);
            }
        }
        found
    }

    /// Returns true if an equation that a claim follows from gives the values of a function, f(x) = ..., that is no state.
    fn is_given(&self, function: &Name, below: &[&Entry]) -> bool {
        let is_value = |side: &Tree| matches!(side, Tree::Call(name, argument, _) if name == function && matches!(**argument, Tree::Symbol(..)));
        let takes = |side: &Tree| {
            any(
                side,
                &mut |node| matches!(node, Tree::Call(name, ..) if name == function),
            )
        };
        let gives = |given: &Equation| {
            [(&given.left, &given.right), (&given.right, &given.left)]
                .into_iter()
                .any(|(own, other)| is_value(own) && !takes(other))
        };
        let mut given = below.iter().flat_map(|entry| &entry.equations);
        let is_defined = self.symbols.names.defined.contains(&function.bare());
        !self.symbols.is_in_flight(function) && (is_defined || given.any(gives))
    }

    /// Returns true for the derivative of a state at an impact by one, `\partial t_{k+1}/\partial t_k`.
    fn is_of_impacts(&self, derivative: &Tree) -> bool {
        matches!(derivative, Tree::Partial { of, by, .. }
            if [of, by].iter().all(|name| self.symbols.impact(name).is_some()))
    }

    /// A logarithm whose base is not printed, in a claim or in what it rests on.
    fn logarithm(&self, claim: &Entry, below: &[&Entry]) -> Option<DoubtKind> {
        let mut trees: Vec<&Tree> = std::iter::once(claim)
            .chain(below.iter().copied())
            .flat_map(|entry| entry.trees(&self.symbols))
            .map(|(tree, _)| tree)
            .collect();
        let mut names = BTreeSet::new();
        trees.iter().for_each(|tree| names_in(tree, &mut names));
        trees.extend(self.symbols.declared_of(names));
        let holds = |command: &str| {
            let mut is_one = |node: &Tree| matches!(node, Tree::Call(name, ..) if name.base == command);
            trees.iter().any(|tree| any(tree, &mut is_one))
        };
        holds(LOG).then(|| DoubtKind::Logarithm {
            is_beside_ln: holds(r"\ln"),
        })
    }

    /// The first power with an odd denominator of a base that may be negative.
    fn odd_roots(&self, claim: &Entry, below: &[&Entry]) -> Option<DoubtKind> {
        let assumed: Vec<&Condition> = claim.assume.iter().map(|(condition, _)| condition).collect();
        let equations = std::iter::once(claim)
            .chain(below.iter().copied())
            .flat_map(|entry| &entry.equations);
        let mut found = None;
        for side in equations.flat_map(|equation| [&equation.left, &equation.right]) {
            any(side, &mut |node| {
                if let Tree::RealPower(base, exponent, _) = node
                    && odd_root(exponent).is_some()
                    && !is_plainly_not_negative(base, &self.symbols, &assumed)
                    && !self.symbols.may_be_complex(base)
                {
                    found.get_or_insert_with(|| DoubtKind::OddRoot { power: node.clone() });
                }
                found.is_some()
            });
        }
        found
    }

    /// The powers with exponents that are integers at times of bases that may be negative.
    fn powers_of_signs(&self, claim: &Entry, below: &[&Entry]) -> Vec<DoubtKind> {
        let assumed: Vec<&Condition> = claim.assume.iter().map(|(condition, _)| condition).collect();
        let mut integers: Vec<Name> = self.symbols.integers().cloned().collect();
        integers.extend(assumed.iter().filter_map(|condition| match condition {
            Condition::Integer(Tree::Symbol(name, _)) => Some(name.clone()),
            _ => None,
        }));
        let entries = std::iter::once(claim).chain(below.iter().copied());
        let mut found = Vec::new();
        for side in entries
            .flat_map(|entry| &entry.equations)
            .flat_map(|equation| [&equation.left, &equation.right])
        {
            any(side, &mut |node| {
                if let Tree::RealPower(base, exponent, _) = node
                    && is_at_times_whole(exponent, &integers)
                    && !is_plainly_not_negative(base, &self.symbols, &assumed)
                    && !any(side, &mut |limit| grows(limit, base))
                {
                    let (base, exponent) = ((**base).clone(), (**exponent).clone());
                    found.push(DoubtKind::PowerOfSign { base, exponent });
                }
                false
            });
        }
        found.truncate(1);
        found
    }

    /// The letters of a claim that authors mean for some value: integers and constants of which nothing speaks that the
    /// claim rests on, letters behind an implication alone, and letters between bounds at which an unknown function is taken.
    fn of_some(&self, claim: &Entry, below: &[&Entry]) -> Vec<Name> {
        let beside = claim.local.iter().chain(&claim.with).map(|(equation, _)| equation);
        let known = below.iter().flat_map(|entry| &entry.equations).chain(beside);
        let known: Vec<&Tree> = known.flat_map(|equation| [&equation.left, &equation.right]).collect();
        let is_known = |name: &Name| known.iter().any(|side| speaks_of(side, name));
        let is_restricted = claim.is_implication || below.iter().any(|entry| entry.role != Role::Definition);
        let noted = claim
            .of_some
            .iter()
            .filter(|name| is_restricted || is_added(name, &claim.equations) || is_multiple(name, claim));
        let mut found: Vec<Name> = noted.cloned().collect();
        let assumed: Vec<&Tree> = claim
            .assume
            .iter()
            .flat_map(|(condition, _)| condition.sides())
            .collect();
        for name in self.symbols.parameters() {
            let stands = || {
                claim
                    .equations
                    .iter()
                    .any(|equation| any_side(equation, &mut |node| is_symbol(node, name)))
            };
            let is_assumed = assumed.iter().any(|side| speaks_of(side, name));
            let is_new = !is_assumed && (claim.is_implication || self.is_unknown(name, claim, is_restricted));
            let is_new = is_new && !self.links_again(name, claim);
            if (is_new || (is_assumed && self.is_between(name, claim))) && stands() {
                found.push(name.clone());
            }
        }
        found.retain(|name| !is_known(name));
        found.dedup();
        found
    }

    /// Returns true if a claim is a link of a chain, and something before it in the document speaks of a letter.
    fn links_again(&self, name: &Name, claim: &Entry) -> bool {
        let mut before = self.entries.iter().take_while(|entry| entry.label != claim.label);
        let speaks = |equation: &Equation| any_side(equation, &mut |node| is_symbol(node, name));
        claim.standing == Standing::Link && before.any(|entry| entry.equations.iter().any(speaks))
    }

    /// Returns true for a constant that a claim seems to introduce: it stands on one side alone, in each of several equations or,
    /// where no premise restricts anything, in one of a variable that stands on both, or as the argument of an unknown
    /// function.
    fn is_unknown(&self, name: &Name, claim: &Entry, is_restricted: bool) -> bool {
        let is_argument = |node: &Tree| match node {
            Tree::Call(function, argument, _) => self.symbols.names.is_function(function) && is_symbol(argument, name),
            _ => false,
        };
        let is_introduced = |equation: &Equation| {
            is_one_sided(name, equation)
                && (any_side(equation, &mut |node| is_argument(node))
                    || letters_of(&equation.left)
                        .iter()
                        .any(|letter| self.is_variable(letter) && speaks_of(&equation.right, letter)))
        };
        let everywhere =
            claim.equations.len() > 1 && claim.equations.iter().all(|equation| is_one_sided(name, equation));
        let is_integer = || self.symbols.is_integer(name) || claim.of_some.contains(name);
        !self.is_variable(name)
            && !is_integer()
            && (everywhere || (!is_restricted && claim.equations.iter().any(is_introduced)))
    }

    /// Returns true for times, and for letters that stand for variables by custom.
    fn is_variable(&self, name: &Name) -> bool {
        let by_custom = name.subscript.is_empty() && ["t", "u", "v", "w", "x", "y", "z"].contains(&name.base.as_str());
        by_custom || self.symbols.is_time(&name.bare())
    }

    /// Returns true if a letter stands between two bounds that are assumed, and an unknown function is taken there or the letter
    /// stands on one side alone of an equation between others, as those of mean value theorems do.
    fn is_between(&self, name: &Name, claim: &Entry) -> bool {
        let bound = |is_above: bool| {
            claim.assume.iter().any(|(condition, _)| match condition {
                Condition::Relation(Equation {
                    left, relation, right, ..
                }) => {
                    let (low, high) = match relation {
                        Relation::Less | Relation::LessOrEqual => (left, right),
                        Relation::Greater | Relation::GreaterOrEqual => (right, left),
                        Relation::Equal | Relation::NotEqual => return false,
                    };
                    is_symbol(if is_above { low } else { high }, name)
                }
                Condition::Integer(_) => false,
            })
        };
        let is_argument = |node: &Tree| match node {
            Tree::Call(function, argument, _) => self.symbols.names.is_function(function) && speaks_of(argument, name),
            _ => false,
        };
        // \sin x - \sin y = (x - y) \cos\xi
        let is_introduced = |equation: &Equation| {
            let stands_on_both = |letter: &Name| letter != name && speaks_of(&equation.right, letter);
            is_one_sided(name, equation) && letters_of(&equation.left).iter().any(stands_on_both)
        };
        let mut equations = claim.equations.iter();
        bound(true)
            && bound(false)
            && equations.any(|equation| is_introduced(equation) || any_side(equation, &mut |node| is_argument(node)))
    }

    /// Returns the doubt of a claim on a step of an index that no premise is about, although one is about another step: it
    /// may be meant for each. A premise with an abbreviation of states at two impacts, such as T_1 = t_{k+1} - t_k, is about
    /// that step alone.
    fn one_step(&self, claim: &Entry, below: &[&Entry]) -> Option<DoubtKind> {
        let letter = &self.symbols.index;
        let runs = self.symbols.indices().any(|name| name.base == *letter);
        let steps = below
            .iter()
            .filter(|entry| entry.role != Role::Definition)
            .flat_map(|entry| &entry.equations);
        let steps: Vec<(&Equation, BTreeSet<i32>)> = steps
            .filter(|equation| !flies(equation, &self.symbols))
            .map(|equation| (equation, self.symbols.impacts(equation)))
            .collect();
        let said: BTreeSet<i32> = steps.iter().flat_map(|(_, impacts)| impacts).copied().collect();
        let asked = claim
            .equations
            .iter()
            .flat_map(|equation| self.symbols.impacts(equation));
        let goes_on = asked.into_iter().any(|index| !said.contains(&index));
        let is_fixed = |equation: &Equation| {
            self.symbols.abbreviations().any(|(name, meaning)| {
                any_side(equation, &mut |node| is_symbol(node, name)) && self.symbols.impacts_in(meaning).len() > 1
            })
        };
        let is_step = steps
            .iter()
            .any(|(equation, impacts)| impacts.len() > 1 && !is_fixed(equation));
        (!runs && is_step && goes_on).then(|| DoubtKind::OneStep { index: letter.clone() })
    }
}

fn is_symbol(tree: &Tree, name: &Name) -> bool {
    matches!(tree, Tree::Symbol(own, _) if own == name)
}

/// Returns true if a letter stands in the equations once, as a factor of a term of a whole side, beside letters of its own.
fn is_added(name: &Name, equations: &[Equation]) -> bool {
    let mut places = 0;
    for equation in equations {
        any_side(equation, &mut |node| {
            places += usize::from(is_symbol(node, name));
            false
        });
    }
    let is_added = equations.iter().any(|equation| {
        [&equation.left, &equation.right]
            .into_iter()
            .any(|side| matches!(side, Tree::Sum(terms) if terms.iter().any(|term| has_factor(term, name))))
    });
    places == 1 && is_added
}

fn has_factor(term: &Tree, name: &Name) -> bool {
    match term {
        Tree::Negate(inner) | Tree::PlusMinus(inner) | Tree::MinusPlus(inner) => has_factor(inner, name),
        Tree::Product(factors) => factors.iter().any(|factor| has_factor(factor, name)),
        Tree::Quotient(above, ..) => has_factor(above, name),
        Tree::Sum(terms) => terms.iter().any(|term| has_factor(term, name)),
        term => is_symbol(term, name),
    }
}

/// Returns true if a letter stands on one side of an equation alone, and other letters on the other.
fn is_one_sided(name: &Name, equation: &Equation) -> bool {
    let sides = [(&equation.left, &equation.right), (&equation.right, &equation.left)];
    let mut sides = sides.into_iter();
    equation.relation == Relation::Equal
        && sides.any(|(own, other)| speaks_of(own, name) && !speaks_of(other, name) && !letters_of(other).is_empty())
}

/// Returns true if a side of an equation is a sum or a multiple of a letter that stands on this side alone.
fn is_multiple(name: &Name, claim: &Entry) -> bool {
    let is_multiple = |equation: &Equation| {
        let mut sides = [&equation.left, &equation.right].into_iter();
        is_one_sided(name, equation) && sides.any(|side| has_factor(side, name))
    };
    claim.equations.iter().chain(&claim.alternatives).any(is_multiple)
}

/// What tends to a value by what is assumed of a claim that is no expansion.
fn tends(claim: &Entry) -> Option<Name> {
    let is_expansion = |equation: &Equation| holds(equation, &|operation| matches!(operation, Operation::Order(..)));
    let mut assumed = claim.assume.iter().filter_map(|(condition, _)| approached(condition));
    assumed.next().filter(|_| !claim.equations.iter().any(is_expansion))
}
