//! What formulas are of which nobody says it: what stands for a symbol, a definition, a law, a claim.

use super::super::check::check;
use super::super::entry::{Entry, RawEntry, Role, Standing};
use super::super::fault::{Fault, Text};
use super::super::function::are_different;
use super::super::implication;
use super::super::reduce::infinity;
use super::super::sheet::{FOLLOWS, RawSheet, Sheet};
use super::super::symbols::{Pairs, RawOpaque, RawSymbols};
use super::dependence::{Dependence, Varying, with_dots};
use super::factors::Factors;
use super::marks::{Marked, Marks, OF_COMPLEX, Stated};
use super::members::{Members, prints_letter_t};
use super::outline::Outline;
use super::scan::Formula;
use super::tex::unspaced;
use crate::words::{Reader, is_sign_of_transpose, transposed};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::ops::Range;
use texmath::{
    Display, Doubt, DoubtKind, Elementary, Equation, FUNCTION_LETTERS, Name, Names, Opaque, Operation, ReadError,
    Relation, Symbols, Tree, any, any_side, functions_given, has_dots, index_of, is_bold, is_constant, is_opaque,
    letters, names_in, names_of, pair_of, read_display, read_name, speaks_of, with_commands,
};
use toml::Spanned;

/// What is guessed of one formula.
pub(super) struct Guessed {
    pub role: Role,
    /// What it follows from, by label.
    pub follows_from: Vec<String>,
    /// What its verdict rests on that nobody said.
    pub guessed: Vec<String>,
    /// Conditions that are guessed.
    pub assume: Vec<String>,
    /// Its standing where nobody says it: [`Standing::Law`] if nothing before speaks of one of its letters and its sides have
    /// different ones.
    pub standing: Standing,
}

/// A formula of which is asked what it is.
pub(super) struct Asked<'a> {
    /// Its number in the document.
    pub at: usize,
    pub label: &'a str,
    pub tex: &'a str,
    /// True for a link of a chain.
    pub is_link: bool,
    /// True for the first of a chain.
    pub is_head: bool,
    /// The role that its author gives it.
    pub role: Option<Role>,
    /// True if he says what it follows from.
    pub is_founded: bool,
    /// True if another row of its display could be a condition on it.
    pub is_doubtful: bool,
    /// The place in the text from which it no longer holds.
    pub until: usize,
    /// True if the rows of its display may hold one or the other.
    pub has_alternatives: bool,
    /// The labels of formulas that the text in front of it names.
    pub cited: &'a [String],
}

/// The letters met so far, and the names that have a value, as they are printed.
#[derive(Default)]
struct Outlines {
    met: BTreeSet<String>,
    given: BTreeSet<String>,
}

/// Guesses formula by formula, in the order of the document.
pub(super) struct Guess {
    /// What each formula states, where it can be read.
    read: Vec<Vec<Equation>>,
    /// The functions of time.
    functions: Vec<Name>,
    /// Those of them that are known by their dots, and whose rates are functions too.
    moving: Vec<Name>,
    /// The letters of constants, `e` and `i`, that the document uses as the numbers.
    constants: Constants,
    /// Letters of constants to which the document gives a value of its own.
    given: BTreeSet<Name>,
    /// Letters before a bracket that may be functions, and pairs of letters in a commutator.
    called: BTreeSet<String>,
    /// A letter that a formula in one letter gives, before a bracket with that one: `A(r`.
    applied: BTreeSet<String>,
    /// The labels of the formulas so far that are single equations, by how these print.
    printed: HashMap<String, Vec<String>>,
    /// The first formula of the display of each formula.
    displays: Vec<usize>,
    /// Equations for a letter that has a value, which hold beside it: in the display of that value, as of a system, or with the letter
    /// on the right too, as `x = A x + b`.
    joint: HashSet<String>,
    /// The question that each formula leaves open, by its label.
    open: HashMap<String, &'static str>,
    /// Symbols that may be complex: with a star somewhere in the document, or given by the imaginary unit.
    complex: BTreeSet<Name>,
    /// Letters that are marked as more than real numbers.
    marks: Marks,
    /// Letters before brackets.
    factors: Factors,
    /// The functions that one formula gives, `f(x) = x^2`.
    given_functions: BTreeSet<Name>,
    /// The exceptions where terms that are not understood are symbols; none where nothing is guessed.
    opaque: Option<RawOpaque>,
    /// True if small letters may be columns.
    pub may_have_columns: bool,
    /// True if the text may say to which base logarithms are.
    says_base: bool,
    /// True if the document declares symbols.
    pub has_symbols: bool,
    /// True if it uses no others.
    is_strict: bool,
    /// What the document declares itself.
    symbols: Symbols,
    /// The number of each formula, by its label.
    numbers: HashMap<String, usize>,
    /// The names met so far.
    met: HashSet<Name>,
    /// The letters and values that outlines of unread formulas are compared with.
    outlines: Outlines,
    /// Which formula defines a name.
    definitions: HashMap<Name, String>,
    /// The names that formulas within the text define.
    in_passing: HashSet<Name>,
    /// The place of each formula in the text.
    places: Vec<usize>,
    /// The last place at which a formula speaks of each letter.
    spoken_last: HashMap<Name, usize>,
    /// The parts of the text in which formulas within it gave a value to a letter, of which others speak behind it.
    scopes: BTreeMap<Name, Vec<Range<usize>>>,
    /// The formulas within the text that hold so far, by label, and where in the text they end to hold.
    asides: Vec<(String, usize)>,
    /// Conditions that the text states, each of a letter, with the place up to which it holds.
    conditions: Vec<(String, Name, usize)>,
    /// The premises so far: laws that are guessed, and what is said to be one.
    premises: Vec<String>,
    /// The formulas that give a defined name once more.
    again: HashMap<Name, Vec<String>>,
    /// The equations so far that a claim may follow from.
    stated: Vec<Stating>,
    /// The label of the formula before.
    before: String,
    /// The letters that may vary with others.
    varying: Varying,
    /// All names that need a declaration.
    names: BTreeSet<Name>,
    /// The formulas of which nobody says what they are.
    guessed: HashMap<String, Role>,
    /// The formulas on which another row of their display could be a condition.
    doubtful: HashSet<String>,
    /// The symbols beside those declared, and the declared ones that were probably meant.
    undeclared: BTreeMap<Name, Option<String>>,
    /// Those of them that each formula uses.
    uses: HashMap<String, BTreeSet<Name>>,
}

/// The symbol that a factor is, or a power of it.
fn letter_of(factor: &Tree) -> Option<&Name> {
    match factor {
        Tree::Symbol(name, _) | Tree::Call(name, ..) => Some(name),
        Tree::Power(of, ..) | Tree::RealPower(of, ..) => letter_of(of),
        _ => None,
    }
}

/// Whether a Delta, a delta or a calligraphic letter stands before a letter: mostly no factor.
fn acts_on_a_letter(node: &Tree) -> bool {
    let acts = |name: &Name| {
        matches!(name.to_string().as_str(), r"\Delta" | r"\delta")
            || name
                .accents
                .iter()
                .any(|accent| matches!(accent.as_str(), r"\mathcal" | r"\mathscr"))
    };
    let Tree::Product(factors) = node else {
        return false;
    };
    // `\delta^t` is a power
    let acts = |factor: &Tree| !matches!(factor, Tree::RealPower(..)) && letter_of(factor).is_some_and(acts);
    factors
        .windows(2)
        .any(|pair| acts(&pair[0]) && letter_of(&pair[1]).is_some())
}

/// Whether a Greek letter stands above another: mostly an index.
fn has_index_above(node: &Tree) -> bool {
    let is_greek = |part: &Tree| matches!(part, Tree::Symbol(name, _) if name.base.starts_with('\\'));
    // nobody writes the power 0 or 1
    matches!(node, Tree::Power(of, 0 | 1, _) if matches!(&**of, Tree::Symbol(name, _) if !is_constant(name)))
        || matches!(node, Tree::RealPower(of, exponent, _)
        if is_greek(of) && is_greek(exponent) && !is_sign_of_transpose(of, exponent))
}

/// Whether `e` and `i` are the numbers, by what a document prints: a letter that is never used so may be anything.
#[derive(Default)]
struct Constants {
    /// A power of it is taken whose exponent is no number.
    e: bool,
    /// It stands in such an exponent, or its square is -1.
    i: bool,
    /// It numbers what it stands at.
    i_is_index: bool,
    /// It is numbered, as the letter of a current: `i_1`.
    i_is_numbered: bool,
}

impl Constants {
    fn is_letter(tree: &Tree, letter: &str) -> bool {
        matches!(tree, Tree::Symbol(name, _) if is_constant(name) && name.base == letter)
    }

    const LETTERS: [&str; 2] = ["e", "i"];

    fn read(&mut self, equation: &Equation) {
        self.i_is_index |= has_index(equation, "i");
        let is_i = |node: &Tree| Self::is_letter(node, "i");
        let is_minus_one =
            matches!(&equation.right, Tree::Negate(one) if matches!(one.as_ref(), Tree::Number(one) if one.0.is_one()));
        self.i |= is_minus_one && matches!(&equation.left, Tree::Power(of, 2, _) if is_i(of));
        for side in [&equation.left, &equation.right] {
            any(side, &mut |node| {
                match node {
                    Tree::RealPower(of, exponent, _) if Self::is_letter(of, "e") => {
                        self.e = true;
                        self.i |= any(exponent, &mut |node| is_i(node));
                    }
                    Tree::Call(name, argument, _) if name.base == r"\exp" => {
                        self.i |= any(argument, &mut |node| is_i(node));
                    }
                    _ => {}
                }
                false
            });
        }
    }

    /// Returns true if one of the letters stands in equations, and nothing in the document says that it is the number.
    fn is_doubtful(&self, letter: &str, equations: &[&Equation]) -> bool {
        let is_said = match letter {
            "e" => self.e,
            _ => self.i && !self.i_is_index && !self.i_is_numbered,
        };
        let is_met = |equation: &&Equation| {
            let mut is_it = |node: &Tree| Self::is_letter(node, letter) && !binds_it(equation, node);
            any_side(equation, &mut is_it)
        };
        !is_said && equations.iter().any(is_met)
    }
}

/// Returns true if a letter stands in an index of an equation.
fn has_index(equation: &Equation, letter: &str) -> bool {
    any_side(equation, &mut |node| match node {
        Tree::Symbol(name, _) | Tree::Call(name, ..) => {
            let mut indices = name.subscript.split(|c: char| !c.is_alphabetic());
            indices.any(|index| index.len() < 3 && index.contains(letter))
        }
        _ => false,
    })
}

/// Returns true if a letter may number something in an equation: it stands in an index, is bound, or stands in the exponent of
/// another number than e.
fn numbers_by(equation: &Equation, letter: &str) -> bool {
    let is_it = |node: &Tree| Constants::is_letter(node, letter);
    has_index(equation, letter)
        || any_side(equation, &mut |node| match node {
            Tree::Operation(operation, _) => operation.letter().is_some_and(|bound| bound.to_string() == letter),
            Tree::RealPower(of, exponent, _) => {
                !Constants::is_letter(of, "e") && any(exponent, &mut |node| is_it(node))
            }
            _ => false,
        })
}

/// Questions that the notation of a claim, and that of the formulas it follows from, leaves open.
pub(super) struct OpenQuestions {
    /// Questions, with one of which nothing is proved.
    pub doubts: Vec<String>,
    /// Letters that are taken for the numbers `e` and `i`.
    pub constants: Vec<String>,
    /// Letters that are taken not to depend on others.
    pub held: Vec<String>,
    /// Labels of formulas that give a letter another value than one before.
    pub second_values: Vec<String>,
    /// Letters that are more than real numbers.
    pub marked: Marked,
}

/// Returns true if a formula prints an upright i as a factor, or the root of a negative number.
fn prints_unit(tex: &str) -> bool {
    let upright = tex.match_indices(r"\mathrm{i}").filter_map(|(at, _)| tex.get(..at));
    let roots = tex
        .match_indices(r"\sqrt{-")
        .filter_map(|(at, sign)| tex.get(at + sign.len()..));
    upright.map(str::trim_end).any(|before| !before.ends_with(['_', '{']))
        || roots
            .map(str::bytes)
            .any(|mut inside| inside.next().is_some_and(|byte| byte.is_ascii_digit()))
}

/// Returns true if a letter is the index of each sum of an equation that it stands in, and stands nowhere else.
fn binds_it(equation: &Equation, letter: &Tree) -> bool {
    let Tree::Symbol(name, _) = letter else { return false };
    [&equation.left, &equation.right]
        .into_iter()
        .all(|side| !side.has_free(name))
}

/// Returns true if a name is a function of time, or a rate of it by dots.
fn is_rate_of(name: &Name, function: &Name) -> bool {
    let rates = [function.clone(), function.dotted(), function.dotted().dotted()];
    rates.contains(name)
}

/// Whether this is `\frac{D u}{D t}`.
fn is_rate(node: &Tree) -> bool {
    let is_d = |part: &Tree| {
        let first = if let Tree::Product(factors) = part {
            factors.first()
        } else {
            None
        };
        matches!(first, Some(Tree::Symbol(name, _)) if name.to_string() == "D")
    };
    matches!(node, Tree::Quotient(above, below, _) if is_d(above) && is_d(below))
}

/// Whether an equation says that factors may change places, and nothing else: nobody prints that of numbers.
fn only_reorders(equation: &Equation) -> bool {
    fn terms<'t>(side: &'t Tree, is_negated: bool, into: &mut Vec<(&'t Tree, bool)>) {
        match side {
            Tree::Sum(parts) => parts.iter().for_each(|part| terms(part, is_negated, into)),
            Tree::Negate(inner) => terms(inner, !is_negated, into),
            Tree::Number(number) if number.0.is_zero() => {}
            _ => into.push((side, is_negated)),
        }
    }
    fn factors(term: &Tree) -> Vec<String> {
        match term {
            Tree::Product(parts) => parts.iter().map(ToString::to_string).collect(),
            _ => vec![term.to_string()],
        }
    }
    let mut all = Vec::new();
    terms(&equation.left, false, &mut all);
    terms(&equation.right, true, &mut all);
    // terms that cancel leave nothing
    let cancel = |printed: &dyn Fn(&Tree) -> Vec<String>| {
        let mut left: HashMap<Vec<String>, i32> = HashMap::new();
        for (term, is_negated) in &all {
            *left.entry(printed(term)).or_default() += if *is_negated { -1 } else { 1 };
        }
        left.values().all(|count| *count == 0)
    };
    let sorted = |term: &Tree| {
        let mut factors = factors(term);
        factors.sort_unstable();
        factors
    };
    cancel(&sorted) && !cancel(&factors)
}

/// Whether two letters with hats are multiplied, as operators are that do not commute.
fn multiplies_operators(node: &Tree) -> bool {
    let Tree::Product(factors) = node else {
        return false;
    };
    let has_hat = |name: &&Name| {
        name.accents
            .iter()
            .any(|accent| accent == r"\hat" || accent == r"\widehat")
    };
    let hats: BTreeSet<&Name> = factors.iter().filter_map(letter_of).filter(has_hat).collect();
    hats.len() > 1
}

/// Questions that a proof in letters that keep their places settles.
const MAY_CHANGE_PLACES: &str = "may factors change places?";
const MAY_BE_OPERATORS: &str = "operators, or numbers?";

/// Returns the question that is open for all that rests on these equations.
fn question_below(equations: &[Equation]) -> Option<&'static str> {
    let is_guess = |doubt: &Doubt| matches!(doubt.kind, DoubtKind::Guess(_));
    if equations.iter().any(|equation| equation.doubts.0.iter().any(is_guess)) {
        return Some("a remark that may be a condition");
    }
    let is_loose = |node: &Tree| is_antiderivative(node) || is_order(node) || is_left_out(node);
    let has_loose = |equation: &Equation| any_side(equation, &mut |node| is_loose(node));
    equations
        .iter()
        .any(has_loose)
        .then_some("what is given up to a constant, an order or dots")
}

/// Returns true for a term with dots.
fn is_left_out(node: &Tree) -> bool {
    matches!(node, Tree::Symbol(name, _) if has_dots(&name.base))
}

fn is_antiderivative(node: &Tree) -> bool {
    matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Integral { limits: None, .. }))
}

fn is_order(node: &Tree) -> bool {
    matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Order(..)))
}

fn binds(node: &Tree) -> bool {
    matches!(node, Tree::Operation(operation, _) if operation.letter().is_some())
}

fn is_opaque_symbol(node: &Tree) -> bool {
    matches!(node, Tree::Symbol(name, _) if is_opaque(name))
}

/// The running time of a document that does not say it.
const TIME: &str = "t";

/// Equations, with their chains, that a claim is taken to follow from beside definitions, at most.
const MOST_PREMISES: usize = 2;

/// The most second values of a letter, the last ones, of which a claim may follow.
const MOST_SECOND_VALUES: usize = 8;

/// The most formulas that the text names of which a claim may follow.
const MOST_CITED: usize = 6;

/// Readings of all formulas for values and functions that others depend on; after them no function is taken to be given.
const MOST_ROUNDS: usize = 5;

/// The equations that are looked at for those, the last ones.
const MOST_STATED: usize = 300;

/// The longest chain that is taken for one equation.
const LONGEST_CHAIN: usize = 3;

/// An equation that later claims may follow from.
struct Stating {
    /// The labels of the links that it takes, its own last.
    chain: Vec<String>,
    left: BTreeSet<Name>,
    right: BTreeSet<Name>,
}

impl Stating {
    fn names(&self) -> impl Iterator<Item = &Name> {
        self.left.union(&self.right)
    }
}

/// The letters of a side that are no numbers.
fn letters_of(side: &Tree) -> BTreeSet<Name> {
    let mut names = BTreeSet::new();
    names_in(side, &mut names);
    names.retain(|name| !is_constant(name));
    names
}

/// Guesses that a verdict tells one by one.
const MOST_TOLD: usize = 6;

/// Returns the equations of a formula, none if it cannot be read.
fn stated(formula: &Formula, names: &Names) -> Vec<Equation> {
    let tex = formula.tex.as_deref().unwrap_or_default();
    let read = implication::formulas(tex)
        .into_iter()
        .map(|part| read_display(&part, names));
    let read: Result<Vec<Display>, ReadError> = read.collect();
    let displays = read.unwrap_or_default().into_iter();
    displays.flat_map(|display| display.equations).collect()
}

/// The letters to which equations give values that hold other letters, as they print.
fn values_given<'a>(equations: impl Iterator<Item = &'a Equation>) -> BTreeSet<String> {
    let given = equations.filter_map(|equation| match &equation.left {
        Tree::Symbol(name, _) if equation.relation == Relation::Equal && !is_opaque(name) => {
            let letters = letters_of(&equation.right);
            (!letters.is_empty() && !letters.contains(name) && !letters.iter().any(is_opaque)).then(|| name.to_string())
        }
        _ => None,
    });
    given.collect()
}

/// The functions that are not given by what looks like their definition: it holds a term that is not understood, which may depend on
/// the argument, or the function itself; or the function is met before, or has another number of arguments elsewhere.
fn hidden_functions<'a>(
    equations: impl Iterator<Item = &'a Equation> + Clone,
    given: &BTreeSet<Name>,
) -> BTreeSet<Name> {
    let mut counts: HashMap<Name, BTreeSet<usize>> = HashMap::new();
    // those that are met before an equation that looks like their definition
    let (mut met, mut early) = (BTreeSet::new(), BTreeSet::new());
    for equation in equations.clone() {
        if let Tree::Call(name, argument, _) = &equation.left
            && equation.relation == Relation::Equal
            && given.contains(name)
            && met.contains(name)
            && argument.arguments().iter().all(|own| matches!(own, Tree::Symbol(..)))
        {
            early.insert(name.clone());
        }
        met.extend(names_of([equation]));
        any_side(equation, &mut |node| {
            if let Tree::Call(name, argument, _) = node {
                counts
                    .entry(name.clone())
                    .or_default()
                    .insert(argument.arguments().len());
            }
            false
        });
    }
    let is_hidden = |equation: &Equation, name: &Name| {
        let is_itself = |node: &Tree| matches!(node, Tree::Call(own, ..) if own == name);
        any(&equation.right, &mut |node| is_opaque_symbol(node) || is_itself(node))
            || early.contains(name)
            || counts.get(name).is_some_and(|counts| counts.len() > 1)
    };
    let named = equations.filter_map(|equation| match &equation.left {
        Tree::Call(name, ..) if given.contains(name) && is_hidden(equation, name) => Some(name.clone()),
        _ => None,
    });
    named.collect()
}

impl Guess {
    /// `declared` are the symbols that the document declares, `of_the_pair` whether they are those of the impact pair.
    pub fn new(formulas: &[Formula], declared: Option<&RawSymbols>, of_the_pair: bool, members: &Members) -> Self {
        let has_symbols = declared.is_some() || of_the_pair;
        let is_strict = of_the_pair || declared.is_some_and(|declared| declared.only);
        let symbols = match declared {
            _ if of_the_pair => super::super::vocabulary().unwrap_or_default(),
            Some(declared) => declared.read().unwrap_or_default(),
            None => Symbols::default(),
        };
        let (mut functions, mut moving): (Vec<Name>, Vec<Name>) = Default::default();
        if !is_strict {
            for name in formulas
                .iter()
                .flat_map(|formula| called_with_time(formula.tex.as_deref().unwrap_or_default()))
            {
                // `\dif{r}{t}(t)` makes time no function of itself
                if !functions.contains(&name) && name.to_string() != TIME && !symbols.declares(&name) {
                    functions.push(name);
                }
            }
            let texts = formulas.iter().filter_map(|formula| formula.tex.as_deref().ok());
            moving = with_dots(texts);
            moving.retain(|name| !symbols.declares(name));
            functions.extend(
                moving
                    .iter()
                    .filter(|name| !functions.contains(name))
                    .cloned()
                    .collect::<Vec<_>>(),
            );
        }
        let mut names = symbols.names.clone();
        names.functions.extend(functions.iter().cloned());
        let given = formulas
            .iter()
            .flat_map(|formula| functions_given(formula.tex.as_deref().unwrap_or_default(), &names));
        let (mut count, mut several): (HashMap<Name, usize>, Vec<Name>) = Default::default();
        for (name, arguments) in given {
            let is_letter = |argument: &Name| *argument == Name::plain(&argument.base) && !is_constant(argument);
            several.extend((arguments.len() > 1).then(|| name.clone()));
            let may_be_given = are_different(&arguments) && arguments.iter().all(is_letter);
            *count.entry(name).or_default() += if may_be_given { 1 } else { 2 };
        }
        // what is given twice is a value each time
        let once = count
            .into_iter()
            .filter(|(name, count)| *count == 1 && name.primes == 0 && !functions.contains(name));
        names.defined = once.map(|(name, _)| name).collect();
        names.defined.sort();
        names.several = several;
        let mut given_functions: BTreeSet<Name> = names.defined.iter().cloned().collect();
        let (mut values, mut rounds, mut transposes) = (BTreeSet::new(), MOST_ROUNDS, false);
        let mut factors: BTreeSet<String> = symbols.parameters().map(|name| name.base.clone()).collect();
        let shown = formulas
            .iter()
            .map(|formula| unspaced(formula.tex.as_deref().unwrap_or_default()));
        let called: BTreeSet<String> = shown.flat_map(|shown| called_with_a_letter(&shown)).collect();
        let t_is_letter = members.t_is_letter
            || formulas
                .iter()
                .any(|formula| prints_letter_t(formula.tex.as_deref().unwrap_or_default()));
        let (read, opaque) = loop {
            let opaque = (!is_strict).then(|| RawOpaque {
                factors: factors.clone(),
                functions: given_functions.iter().map(ToString::to_string).collect(),
                values: values.clone(),
                transposes,
                letters: names.letters.clone(),
            });
            names.opaque = opaque.clone().map(Opaque::from);
            let read: Vec<Vec<Equation>> = formulas.iter().map(|formula| stated(formula, &names)).collect();
            let hidden = hidden_functions(read.iter().flatten(), &given_functions);
            let defined = values_given(read.iter().flatten());
            let is_sign = !transposes && !t_is_letter && is_sign_alone(read.iter().flatten(), members.has_vectors);
            let are_known =
                !is_sign && matrices_in(read.iter().flatten()).is_subset(&factors.union(&called).cloned().collect());
            if hidden.is_empty() && (rounds == 0 || (are_known && defined.is_subset(&values))) {
                break (read, opaque);
            }
            transposes |= is_sign;
            values.extend(defined);
            let new = matrices_in(read.iter().flatten());
            factors.extend(new.into_iter().filter(|letter| !called.contains(letter)));
            given_functions.retain(|name| rounds > 0 && !hidden.contains(name));
            names.defined.retain(|name| given_functions.contains(name));
            rounds = rounds.saturating_sub(1);
        };
        let (mut given, mut complex, mut applied) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        let mut texts = formulas.iter().filter_map(|formula| formula.tex.as_deref().ok());
        let mut constants = Constants {
            i: members.says_unit || texts.any(prints_unit),
            ..Constants::default()
        };
        for equation in read.iter().flatten() {
            constants.read(equation);
            let mut names = BTreeSet::new();
            names_in(&equation.right, &mut names);
            // i_1 is a current, and i beside it
            let numbered = |name: &Name| name.base == "i" && !name.subscript.is_empty() && name.accents.is_empty();
            let mut all = names.clone();
            names_in(&equation.left, &mut all);
            constants.i_is_numbered |= all.iter().any(numbered);
            if let Tree::Symbol(name, _) = &equation.left {
                let mut letters = names.iter().filter(|name| !is_constant(name));
                if let (Some(one), None) = (letters.next(), letters.next()) {
                    applied.insert(unspaced(&format!("{name}({one}")));
                }
                // i = \sqrt{-1} says what it is
                given.extend((is_constant(name) && !names.contains(name)).then(|| name.clone()));
                let is_unit = |name: &Name| is_constant(name) && name.base == "i";
                complex.extend(names.iter().any(is_unit).then(|| name.clone()));
            }
            names_in(&equation.left, &mut names);
            let starred = names.into_iter().filter(|name| name.mark == "*");
            complex.extend(starred.map(|name| Name {
                mark: String::new(),
                ..name
            }));
        }
        let all: Vec<String> = formulas
            .iter()
            .map(|formula| unspaced(formula.tex.as_deref().unwrap_or_default()))
            .collect();
        let is_of_time = |letter: &str| functions.iter().any(|name| name.base == letter);
        let called = all.iter().flat_map(|shown| letters_called(shown, &is_of_time));
        let prints_matrices =
            |shown: &String| OF_MATRICES.iter().any(|sign| shown.contains(sign)) || has_adjoint(shown);
        let has_matrices = all.iter().any(prints_matrices) || !members.matrices.is_empty();
        let commutators: Vec<[String; 2]> = all.iter().flat_map(|shown| commutators(shown)).collect();
        let shown = formulas
            .iter()
            .map(|formula| formula.tex.as_deref().unwrap_or_default());
        let marks = match is_strict {
            true => Marks::default(),
            false => Marks::new(
                shown.zip(read.iter().map(Vec::as_slice)),
                &commutators,
                !constants.i_is_index && !constants.i_is_numbered,
                has_matrices,
                members.clone(),
            ),
        };
        Self {
            called: called.map(str::to_owned).collect(),
            applied,
            open: HashMap::new(),
            marks,
            opaque,
            given_functions,
            may_have_columns: Marks::may_have_columns(read.iter().flatten()),
            says_base: members.says_base,
            factors: Factors::new(read.iter().flatten()),
            numbers: HashMap::new(),
            spoken_last: spoken_last(formulas, &read),
            varying: Varying::of(read.iter().flatten(), &all, &members.varying),
            read,
            constants,
            given,
            complex,
            functions,
            moving,
            has_symbols,
            is_strict,
            symbols,
            met: HashSet::new(),
            outlines: Outlines::default(),
            definitions: HashMap::new(),
            in_passing: HashSet::new(),
            places: formulas.iter().map(|formula| formula.part.start).collect(),
            displays: formulas.iter().map(|formula| formula.first).collect(),
            joint: HashSet::new(),
            printed: HashMap::new(),
            scopes: BTreeMap::new(),
            asides: Vec::new(),
            conditions: Vec::new(),
            premises: Vec::new(),
            again: HashMap::new(),
            stated: Vec::new(),
            before: String::new(),
            names: BTreeSet::new(),
            guessed: HashMap::new(),
            doubtful: HashSet::new(),
            undeclared: BTreeMap::new(),
            uses: HashMap::new(),
        }
    }

    /// Forgets what formulas within the text said that no longer holds at this place of it.
    pub fn leave(&mut self, place: usize) {
        let ended: Vec<String> = self
            .asides
            .iter()
            .filter(|(_, until)| *until <= place)
            .map(|(label, _)| label.clone())
            .collect();
        if ended.is_empty() {
            return;
        }
        self.asides.retain(|(label, _)| !ended.contains(label));
        self.premises.retain(|label| !ended.contains(label));
        for labels in self.again.values_mut() {
            labels.retain(|own| !ended.contains(own));
        }
        self.stated
            .retain(|stating| !stating.chain.iter().any(|own| ended.contains(own)));
    }

    /// Takes what a formula within the text says, and returns what it is to those that follow from it, and what it follows from
    /// itself; nothing where it is neither an equation nor a condition of letters that are read. It holds up to the place `until` of the text.
    pub fn aside(&mut self, at: usize, label: &str, until: usize) -> Option<(Role, Vec<String>)> {
        self.numbers.insert(label.to_owned(), at);
        let equations = self.read.get(at).filter(|equations| equations.len() == 1)?.clone();
        let equation = equations.first()?;
        let is_condition = equation.relation != Relation::Equal;
        let is_of_letter = matches!((&equation.left, &equation.right), (Tree::Symbol(..), Tree::Number(_)));
        if is_condition && !is_of_letter {
            return None;
        }
        if self.conflict(at).is_some() || self.question(at, "").is_some() || question_below(&equations).is_some() {
            return None;
        }
        if let (Tree::Symbol(name, _), true) = (&equation.left, is_condition) {
            self.conditions.push((label.to_owned(), name.clone(), until));
            self.guessed.insert(label.to_owned(), Role::Premise);
            self.names.insert(name.clone());
            return Some((Role::Premise, Vec::new()));
        }
        let new = self.defined_until(equation, at, until);
        self.remember(equation, label);
        let mut names = self.names_of([equation]);
        let below = self.definitions_of(&names);
        let role = match &new {
            Some(name) => {
                self.definitions.insert(name.clone(), label.to_owned());
                self.in_passing.insert(name.clone());
                Role::Definition
            }
            None => {
                if let Some(name) = self.second_value(&equations) {
                    self.again.entry(name).or_default().push(label.to_owned());
                }
                self.state(label, &equations, false);
                Role::Premise
            }
        };
        self.guessed.insert(label.to_owned(), role);
        self.asides.push((label.to_owned(), until));
        self.met.extend(names.iter().cloned());
        names.retain(|name| Some(name) != new.as_ref());
        self.names.extend(names);
        Some((role, below))
    }

    /// Returns the conditions in force at a formula on these letters, and on those by which definitions give them.
    fn conditions_of(&self, names: &BTreeSet<Name>, at: usize) -> Vec<String> {
        let (reached, place) = (self.reached(names), self.places.get(at).copied().unwrap_or_default());
        let holds = |(_, name, until): &&(String, Name, usize)| place < *until && reached.contains(name);
        let all = self.conditions.iter().filter(holds);
        all.map(|(label, ..)| label.clone()).collect()
    }

    /// Guesses the role of a formula and what it follows from.
    pub fn of(&mut self, asked: &Asked) -> Guessed {
        let &Asked {
            at,
            label,
            tex,
            is_link,
            is_head,
            role,
            is_founded,
            is_doubtful,
            until,
            has_alternatives,
            cited,
        } = asked;
        self.numbers.insert(label.to_owned(), at);
        if let Some(open) = self.question(at, tex).or_else(|| self.question_beside(at, is_link)) {
            self.open.insert(label.to_owned(), open);
        }
        // what prints dots gives nothing to what follows
        let whole = |equations: &&Vec<Equation>| !equations.iter().any(|own| any_side(own, &mut is_left_out));
        let equations = self.read.get(at).filter(whole).cloned().unwrap_or_default();
        let (mut new, mut is_local) = (None, false);
        if let [equation] = equations.as_slice() {
            let defined = self.defined(equation).is_some();
            new = self.defined_until(equation, at, until);
            is_local = defined && new.is_none() && role.is_none();
        }
        let is_law = matches!(equations.as_slice(), [equation] if self.is_new_law(equation));
        let is_guess = role.is_none();
        let role = role.unwrap_or(match (&new, is_law) {
            (Some(_), _) => Role::Definition,
            (_, true) => Role::Premise,
            _ if is_local => Role::Premise,
            _ => Role::Claim,
        });
        let mut names = self.names_of(&equations);
        let mut below = self.definitions_of(&names);
        below.extend(self.conditions_of(&names, at));
        // a chain begins with an identity where its first sides have the same letters
        let begins_alike =
            is_head && matches!(equations.as_slice(), [one] if letters_of(&one.left) == letters_of(&one.right));
        let may_be_law =
            is_guess && role == Role::Claim && !is_link && !begins_alike && self.may_be_law(&equations, &names);
        let standing = match may_be_law {
            true => Standing::Law,
            false if begins_alike => Standing::Link,
            false if equations.is_empty() => self.outlined(tex),
            false if is_local => Standing::Definition,
            false => Standing::Open,
        };
        if is_local {
            self.state(label, &equations, false);
        }
        if until < usize::MAX {
            self.asides.push((label.to_owned(), until));
        }
        let loose = question_below(&equations);
        // a letter that is given a second value has either
        if let Some(name) = self
            .second_value(&equations)
            .filter(|_| is_guess && !is_link && new.is_none())
        {
            let display = |at: &usize| self.displays.get(*at);
            let first = self.definitions.get(&name).and_then(|label| self.numbers.get(label));
            let is_of_system = !is_doubtful && !has_alternatives && first.and_then(display) == display(&at);
            // x = A x + b says something of x, and x = x + h gives it a new value
            let is_itself = |term: &Tree| matches!(term, Tree::Symbol(own, _) if *own == name);
            let is_step = |side: &Tree| match side {
                Tree::Sum(terms) => terms.iter().any(is_itself),
                side => is_itself(side),
            };
            let is_implicit = |own: &Equation| speaks_of(&own.right, &name) && !is_step(&own.right);
            if is_of_system || equations.iter().any(is_implicit) {
                self.joint.insert(label.to_owned());
            }
            self.again.entry(name).or_default().push(label.to_owned());
        }
        if is_guess && role == Role::Claim {
            if let Some(known) = self.printed_before(&equations) {
                below.push(known);
            } else {
                let reached = self.reached(&names);
                let again = reached.iter().filter_map(|name| self.again.get(name));
                for values in again {
                    let others = values.iter().filter(|own| *own != label);
                    let last = others.clone().count().saturating_sub(MOST_SECOND_VALUES);
                    below.extend(others.skip(last).cloned());
                }
                below.extend(self.premises.iter().cloned());
                if !may_be_law && let [equation] = equations.as_slice() {
                    below.extend(self.premises_of(equation));
                    below.extend(self.cited(equation, label, cited));
                }
            }
            let is_plain = self.conflict(at).is_none() && !self.open.contains_key(label) && loose.is_none();
            let is_marked = names.iter().any(|name| self.marks.has(name));
            // what is derived may be wrong: only what is said is a premise, or an equation of matrices, which nobody rounds
            if is_plain && (may_be_law || (is_link && self.may_be_law(&equations, &names)) || (is_marked && !is_link)) {
                self.state(label, &equations, is_link);
            }
        }
        if let [equation] = equations.as_slice() {
            self.remember(equation, label);
        }
        let (mut guessed, mut assume) = (Vec::new(), Vec::new());
        if role == Role::Claim {
            if !self.has_symbols {
                guessed.push("each symbol is real and has one value".to_owned());
                assume.extend(equations.iter().flat_map(with_terms));
                let conditions: Vec<String> = assume.iter().map(|condition| format!("`{condition}`")).collect();
                let are_known = !conditions.is_empty();
                guessed.extend(are_known.then(|| format!("sums have a term at least, {}", conditions.join(", "))));
            }
            let from: Vec<String> = below.iter().map(|label| format!("({label})")).collect();
            let from = if from.is_empty() {
                "nothing".to_owned()
            } else {
                from.join(", ")
            };
            if is_guess && is_founded {
                guessed.push("this is a claim".to_owned());
            } else if is_guess {
                guessed.push(format!("{FOLLOWS}{from}"));
            }
        }
        // an author who says that it is a claim says what it follows from beside the meaning of its names
        let follows_from: Vec<String> = if is_founded { Vec::new() } else { below };
        match role {
            Role::Definition => {
                new.iter().for_each(|name| {
                    self.in_passing.remove(name);
                });
                self.definitions
                    .extend(new.clone().map(|name| (name, label.to_owned())));
            }
            Role::Premise if !is_local => self.premises.push(label.to_owned()),
            Role::Premise | Role::Claim => {}
        }
        if is_guess {
            self.guessed.insert(label.to_owned(), role);
        }
        if is_doubtful {
            self.doubtful.insert(label.to_owned());
            guessed
                .extend((role == Role::Claim).then(|| "no other row of its display is a condition on it".to_owned()));
        }
        if let Some(loose) = loose.filter(|_| is_guess && role == Role::Definition) {
            self.open.insert(label.to_owned(), loose);
        }
        label.clone_into(&mut self.before);
        self.met.extend(names.iter().cloned());
        self.outlines.met.extend(names.iter().map(|name| name.base.clone()));
        self.outlines.given.extend(new.iter().map(ToString::to_string));
        names.retain(|name| role != Role::Definition || Some(name) != new.as_ref());
        self.names.extend(names);
        Guessed {
            role,
            follows_from,
            guessed,
            assume,
            standing,
        }
    }

    /// The standing of a formula that cannot be read, by its outline.
    fn outlined(&mut self, tex: &str) -> Standing {
        let outline = Outline::of(tex);
        let standing = match outline.defined(&self.outlines.given) {
            Some(name) => {
                self.outlines.given.insert(name.clone());
                Standing::Definition
            }
            None if outline.is_said(&self.outlines.met) => Standing::Law,
            None => Standing::Open,
        };
        self.outlines.met.extend(outline.all().cloned());
        standing
    }

    /// Returns the defined letter to which an equation gives a value once more.
    fn second_value(&self, equations: &[Equation]) -> Option<Name> {
        match equations {
            [
                Equation {
                    left: Tree::Symbol(name, _),
                    relation: Relation::Equal,
                    ..
                },
            ] if self.definitions.contains_key(name) => Some(name.clone()),
            _ => None,
        }
    }

    /// Returns true if an equation introduces a letter, and its sides have different ones.
    fn may_be_law(&self, equations: &[Equation], names: &BTreeSet<Name>) -> bool {
        let [equation] = equations else {
            return false;
        };
        let [left, right] = [&equation.left, &equation.right].map(|side| {
            let mut own = BTreeSet::new();
            names_in(side, &mut own);
            own.retain(|name| !is_constant(name));
            own
        });
        let is_new = |name: &Name| is_constant(name) || (!self.met.contains(name) && !self.symbols.knows(name));
        let mut letters = names.iter().filter(|name| !is_constant(name));
        // P^2 = P, of which nothing before speaks
        let is_first = names.iter().all(is_new) && letters.next().is_some();
        is_first || (left != right && names.iter().any(|name| !is_constant(name) && is_new(name)))
    }

    /// True if definitions give a letter by another one and by letters of which nothing is a derivative.
    fn is_value(&self, name: &Name, by: &Name, is_partial: bool) -> bool {
        let reached = self.reached(&BTreeSet::from([name.clone()]));
        let speaks = |own: &Name| own == by || (by.to_string() == TIME && self.is_of_time(own, by));
        // a partial derivative holds what stands beside its letter fixed, whatever else is said of that
        let may_move = |own: &Name| {
            let is_written_out = self.definitions.contains_key(own);
            self.varying.contains(own) || (!is_partial && !is_written_out && self.varying.has_value(own))
        };
        let is_known = |own: &Name| own == name || own == by || self.is_of_time(own, by) || !may_move(own);
        self.definitions.contains_key(name) && reached.iter().any(speaks) && reached.iter().all(is_known)
    }

    /// The equations that define a name.
    fn values(&self, name: &Name) -> impl Iterator<Item = &Equation> {
        let number = self.definitions.get(name).and_then(|label| self.numbers.get(label));
        number.and_then(|&at| self.read.get(at)).into_iter().flatten()
    }

    /// These names, and those by which definitions give them.
    fn reached(&self, names: &BTreeSet<Name>) -> BTreeSet<Name> {
        let mut reached = names.clone();
        let mut open: Vec<Name> = names.iter().cloned().collect();
        while let Some(name) = open.pop() {
            let mut own = BTreeSet::new();
            self.values(&name).for_each(|value| names_in(&value.right, &mut own));
            open.extend(own.into_iter().filter(|name| reached.insert(name.clone())));
        }
        reached
    }

    /// True for an equation that claims may follow from.
    fn is_stated(&self, label: &str) -> bool {
        self.stated
            .iter()
            .any(|stating| stating.chain.iter().any(|own| own == label))
    }

    /// Keeps an equation for claims that come later; a link is kept as its chain up to it.
    fn state(&mut self, label: &str, equations: &[Equation], is_link: bool) {
        let [equation] = equations else { return };
        if equation.relation != Relation::Equal {
            return;
        }
        let is_before =
            |stating: &&Stating| stating.chain.last() == Some(&self.before) && stating.chain.len() < LONGEST_CHAIN;
        let chain = self.stated.last().filter(|_| is_link).filter(is_before);
        let (mut chain, left) = match chain {
            Some(before) => (before.chain.clone(), before.left.clone()),
            None => (Vec::new(), self.leaves(&equation.left)),
        };
        chain.push(label.to_owned());
        let right = self.leaves(&equation.right);
        self.stated.push(Stating { chain, left, right });
    }

    /// The letters of a side once definitions are put in.
    fn leaves(&self, side: &Tree) -> BTreeSet<Name> {
        let mut names = self.reached(&letters_of(side));
        let is_known = |name: &Name| is_constant(name) || self.marks.is_identity(name);
        names.retain(|name| !is_known(name) && !self.definitions.contains_key(name));
        names
    }

    /// The equations so far that a claim may follow from: those that hold the letters of one of its sides alone, and few others.
    fn premises_of(&self, claim: &Equation) -> Vec<String> {
        let (left, right) = (self.leaves(&claim.left), self.leaves(&claim.right));
        let own: BTreeSet<Name> = left.union(&right).cloned().collect();
        let mut wanted: BTreeSet<Name> = left.symmetric_difference(&right).cloned().collect();
        let mut found: Vec<String> = Vec::new();
        let mut left_over: Vec<&Stating> = self.stated.iter().rev().take(MOST_STATED).collect();
        for _ in 0..MOST_PREMISES {
            let score = |stating: &Stating| {
                let useful = stating.names().filter(|name| wanted.contains(*name)).count();
                let foreign = stating
                    .names()
                    .filter(|name| !own.contains(*name) && !wanted.contains(*name))
                    .count();
                (2 * useful).saturating_sub(3 * foreign)
            };
            // the last of the best, which is the first of them here
            let best = (0..left_over.len())
                .rev()
                .max_by_key(|&at| left_over.get(at).map_or(0, |stating| score(stating)));
            let Some(at) = best.filter(|&at| left_over.get(at).is_some_and(|stating| score(stating) > 0)) else {
                break;
            };
            let stating = left_over.remove(at);
            let new: BTreeSet<Name> = stating.names().filter(|name| !own.contains(*name)).cloned().collect();
            wanted = wanted
                .into_iter()
                .filter(|name| !stating.names().any(|own| own == name))
                .chain(new)
                .collect();
            found.extend(
                stating
                    .chain
                    .iter()
                    .filter(|label| !found.contains(label))
                    .cloned()
                    .collect::<Vec<_>>(),
            );
        }
        found
    }

    /// The formula before that says the same, in which nothing is open, among those that claims may follow from.
    fn printed_before(&self, claim: &[Equation]) -> Option<String> {
        let [claim] = claim else { return None };
        let is_given = |label: &&String| {
            let mut again = self.again.values().flatten();
            !self.open.contains_key(*label)
                && (self.is_stated(label)
                    || self.definitions.values().any(|own| own == *label)
                    || again.any(|own| own == *label)
                    || self.premises.contains(label))
        };
        let printed = self.printed.get(&claim.to_string());
        printed.into_iter().flatten().find(is_given).cloned()
    }

    /// Remembers how an equation prints.
    fn remember(&mut self, equation: &Equation, label: &str) {
        self.printed
            .entry(equation.to_string())
            .or_default()
            .push(label.to_owned());
    }

    /// Those of the formulas that the text in front of a claim names from which it may follow: equations before it that are read and
    /// leave nothing open. A claim whose sides have the same letters needs none.
    fn cited(&self, claim: &Equation, label: &str, cited: &[String]) -> Vec<String> {
        if cited.is_empty() || self.leaves(&claim.left) == self.leaves(&claim.right) {
            return Vec::new();
        }
        let is_usable = |label: &&String| {
            let equations = self.numbers.get(*label).and_then(|&at| self.read.get(at));
            let equations = equations.filter(|_| !self.open.contains_key(*label));
            equations.is_some_and(|own| {
                matches!(own.as_slice(), [equation] if equation.relation == Relation::Equal)
                    && question_below(own).is_none()
            })
        };
        let others = cited.iter().filter(|own| *own != label);
        others.filter(is_usable).take(MOST_CITED).cloned().collect()
    }

    /// Why formula number `at` is not read beside the others: a letter in it has two meanings.
    pub fn conflict(&self, at: usize) -> Option<String> {
        let is_pair = |node: &Tree| matches!(node, Tree::Symbol(name, _) if self.is_pair_of_functions(name));
        let mut equations = self.read.get(at).into_iter().flatten();
        let is_met = !self.has_symbols && equations.any(|equation| any_side(equation, &mut |node| is_pair(node)));
        is_met.then(|| {
            "a letter that is a function elsewhere and a pair of numbers here is not guessed: say the symbols by `% audit: symbols ...`".to_owned()
        })
    }

    /// Returns what formula number `at` leaves open beside others: antiderivatives that differ by constants, and orders, which
    /// are not equal where they are printed alike.
    fn question_beside(&self, at: usize, is_link: bool) -> Option<&'static str> {
        let equations = self.read.get(at).into_iter().flatten();
        let (mut antiderivatives, mut orders, mut is_alone) = (0, 0, false);
        for equation in equations {
            is_alone |= [&equation.left, &equation.right].into_iter().any(is_antiderivative);
            any_side(equation, &mut |node| {
                antiderivatives += usize::from(is_antiderivative(node));
                orders += usize::from(is_order(node));
                false
            });
        }
        if antiderivatives > 0 && (is_link || !is_alone || antiderivatives > 1) {
            return Some("antiderivatives up to which constants?");
        }
        (orders > 0 && (is_link || orders > 1)).then_some("orders that need not be equal")
    }

    /// Returns the question that formula number `at` leaves open, so that nothing is decided of it.
    fn question(&self, at: usize, tex: &str) -> Option<&'static str> {
        let shown = unspaced(tex);
        let inverts = |letter: &String| {
            [r"^{-1}", r"^-1"]
                .iter()
                .any(|power| shown.contains(&format!("{letter}{power}")))
        };
        let has = |parts: &[&str]| parts.iter().any(|part| shown.contains(part));
        if self.called.iter().any(inverts) {
            return Some("an inverse function, or a power?");
        }
        if self.applied.iter().any(|call| shown.contains(call.as_str())) {
            return Some("a formula before a bracket that may be its argument");
        }
        if has(&OF_COMPLEX) {
            return Some("real symbols, or complex ones?");
        }
        if shown.contains(r"\ast") {
            return Some("a convolution, or a product?");
        }
        let signs = |signs: &[&str]| signs.iter().map(|sign| shown.matches(sign).count()).sum::<usize>();
        let read = |is_one: fn(&Operation) -> bool| {
            let mut count = 0;
            for equation in self.read.get(at).into_iter().flatten() {
                any_side(equation, &mut |node| {
                    count += usize::from(matches!(node, Tree::Operation(operation, _) if is_one(operation)));
                    false
                });
            }
            count
        };
        // read as one of vectors it is decided as such
        let are_dots = signs(&[r"\cdot"]) <= read(|operation| matches!(operation, Operation::Dot(..)));
        let are_crosses = signs(&[r"\times", "×"]) <= read(|operation| matches!(operation, Operation::Cross(..)));
        if (has(&["|", "vert"]) && !are_dots) || (crosses_letters(&shown) && !are_crosses) {
            return Some("a product of vectors, or of numbers?");
        }
        if has(&[r"\|", r"\Vert", r"\lVert"]) {
            return Some("the norm of what?");
        }
        self.read.get(at).into_iter().flatten().find_map(|equation| {
            let is_some = |test: &mut dyn FnMut(&Tree) -> bool| any_side(equation, test);
            if is_some(&mut is_left_out) {
                Some("what do the dots stand for?")
            } else if self.dependence(equation, shown.contains(r"\partial")).is_open
                || is_with_and_without_time(equation)
                || is_some(&mut is_rate)
                || (is_some(&mut is_opaque_symbol) && is_some(&mut binds))
            {
                Some("what depends on what?")
            } else if only_reorders(equation) {
                Some(MAY_CHANGE_PLACES)
            } else if is_some(&mut |node| acts_on_a_letter(node)) {
                Some("a difference, a variation or an operator, or a factor?")
            } else if is_some(&mut |node| multiplies_operators(node)) {
                Some(MAY_BE_OPERATORS)
            } else if is_some(&mut |node| has_index_above(node)) {
                Some("an index, or an exponent?")
            } else if is_some(&mut |node| matches!(node, Tree::Symbol(name, _) if self.given.contains(name))) {
                Some("a letter of a constant that the document gives a value")
            } else if is_some(&mut |node| self.is_modulus(node)) {
                Some("real symbols, or complex ones?")
            } else {
                None
            }
        })
    }

    /// Returns the questions that the notation of a claim leaves open; `below` lists the formulas that each follows from.
    pub fn open_questions(&self, claim: &RawEntry, below: &HashMap<String, Vec<String>>) -> OpenQuestions {
        let equations = |label: &str| {
            self.numbers
                .get(label)
                .and_then(|&at| self.read.get(at))
                .into_iter()
                .flatten()
        };
        let label = claim.label.get_ref();
        let labels = labels_below(label, below);
        let is_restricted = labels.iter().any(|label| self.premises.contains(label))
            || !claim.assume.is_empty()
            || !claim.with.is_empty()
            || implication::formulas(claim.tex.get_ref()).len() > 1;
        let stated = Stated {
            own: equations(label).collect(),
            below: labels.iter().flat_map(|label| equations(label)).collect(),
            is_restricted,
        };
        let is_free = |name: &Name| match self.has_symbols {
            true => self.undeclared.contains_key(name),
            false => !self.definitions.contains_key(name),
        };
        let mut marked = self.marks.marked(&stated, &is_free);
        let mut doubts = Vec::new();
        let mut all = stated.own.iter().chain(&stated.below);
        if all.clone().any(|equation| self.moves_a_value(equation)) {
            doubts.push("a value that speaks of an index, which a sum moves".to_owned());
        }
        doubts.extend(self.another_value(labels.iter().copied().chain([label])));
        let is_logarithm = |node: &Tree| matches!(node, Tree::Call(name, ..) if name.base == r"\log");
        let takes_logarithms = all
            .clone()
            .any(|equation| any_side(equation, &mut |node| is_logarithm(node)));
        if self.says_base && takes_logarithms {
            doubts.push(r"`\log`: natural, or to the base that the text says?".to_owned());
        }
        if all.any(|equation| self.marks.inverts_a_rectangle(equation)) {
            doubts.push("the inverse of a matrix that is not square?".to_owned());
        }
        let again = self.again.values().flatten();
        let again: BTreeSet<&String> = again.filter(|own| !self.joint.contains(*own)).collect();
        let (rivals, others): (Vec<&String>, Vec<&String>) =
            labels.iter().copied().partition(|own| again.contains(own));
        let others: Vec<&Equation> = others.iter().flat_map(|own| equations(own)).collect();
        let none = |_: &Name| false;
        let mut reader = Reader::new(&none);
        for equation in &others {
            if let (Tree::Symbol(name, _), Relation::Equal) = (&equation.left, equation.relation) {
                reader.give(name, &equation.right);
            }
        }
        let second_values = rivals
            .into_iter()
            .filter(|own| !equations(own).all(|equation| reader.has_identity(equation)))
            .cloned()
            .collect();
        let mut constants = Vec::new();
        let mut held = BTreeSet::new();
        if !self.has_symbols {
            let all: Vec<&Equation> = stated.own.iter().chain(&stated.below).copied().collect();
            held = all
                .iter()
                .flat_map(|equation| self.dependence(equation, true).held)
                .collect();
            for letter in Constants::LETTERS
                .into_iter()
                .filter(|letter| self.constants.is_doubtful(letter, &all))
            {
                let is_letter = letter == "i" && (!self.constants.i || self.constants.i_is_numbered);
                match is_letter || all.iter().any(|equation| numbers_by(equation, letter)) {
                    true => doubts.push(format!("`{letter}`: the number, or a letter?")),
                    false => constants.push(letter.to_owned()),
                }
            }
            let own = labels.iter().map(|label| label.as_str()).chain([label.as_str()]);
            let open = own
                .filter_map(|label| self.open.get(label))
                .map(|open| (*open).to_owned());
            let (orders, others): (BTreeSet<String>, BTreeSet<String>) =
                open.partition(|open| [MAY_CHANGE_PLACES, MAY_BE_OPERATORS].contains(&open.as_str()));
            doubts.extend(others);
            // any letter may be one that keeps its place
            if !orders.is_empty() {
                let all = names_of(stated.own.iter().chain(&stated.below).copied());
                marked.operators = all.iter().map(ToString::to_string).collect();
                marked.doubts.extend(orders);
            }
        }
        for argument in stated
            .own
            .iter()
            .chain(&stated.below)
            .flat_map(|equation| self.factors.doubts(equation))
        {
            if !doubts.contains(&argument) {
                doubts.push(argument);
            }
        }
        OpenQuestions {
            doubts,
            constants,
            held: held
                .into_iter()
                .map(|(letter, by)| format!("`{letter}` as `{by}` varies"))
                .collect(),
            second_values,
            marked,
        }
    }

    /// Returns what an equation differentiates or integrates by what, and whether that varies with it.
    fn dependence(&self, equation: &Equation, is_partial: bool) -> Dependence {
        let is_value = |name: &Name, by: &Name| self.is_value(name, by, is_partial);
        Dependence::of(equation, &self.varying, &is_value, &|name, by| {
            self.is_of_time(name, by)
        })
    }

    /// Returns true for a function of time that is differentiated by time, or held fixed where another is differentiated by.
    fn is_of_time(&self, name: &Name, by: &Name) -> bool {
        let moves = |name: &Name| self.moving.iter().any(|function| is_rate_of(name, function));
        moves(name) && (by.to_string() == TIME || moves(by))
    }

    /// Returns the doubt about formulas that share a letter, if it has a value of its own in a part of the text, and some of them
    /// stand within that part and others behind it.
    fn another_value<'l>(&self, labels: impl Iterator<Item = &'l String>) -> Option<String> {
        let placed = labels.filter_map(|label| self.numbers.get(label));
        let placed = placed.filter_map(|&at| Some((*self.places.get(at)?, self.read.get(at)?)));
        let placed: Vec<(usize, BTreeSet<Name>)> = placed.map(|(place, own)| (place, names_of(own))).collect();
        let names: BTreeSet<&Name> = placed.iter().flat_map(|(_, own)| own).collect();
        let is_mixed = |name: &Name, parts: &[Range<usize>]| {
            let speaking = placed.iter().filter(|(_, own)| own.contains(name));
            let places: Vec<usize> = speaking.map(|(place, _)| *place).collect();
            let is_within = |part: &Range<usize>| places.iter().any(|place| part.contains(place));
            let is_behind = |part: &Range<usize>| places.iter().any(|place| *place >= part.end);
            parts.iter().any(|part| is_within(part) && is_behind(part))
        };
        let mut scopes = names
            .into_iter()
            .filter_map(|name| Some((name, self.scopes.get(name)?)));
        let (name, _) = scopes.find(|(name, parts)| is_mixed(name, parts))?;
        Some(format!("`{name}` has a value of its own in another part of the text"))
    }

    /// Returns true if a letter within a sum or a product has a value that speaks of its index, or where it is written out term by
    /// term prints the index where none is looked for, as `a_{ij}` does.
    fn moves_a_value(&self, equation: &Equation) -> bool {
        any_side(equation, &mut |node| {
            let Tree::Operation(operation, _) = node else {
                return false;
            };
            let Operation::Series {
                of, index, from, to, ..
            } = &**operation
            else {
                return false;
            };
            let mut names = BTreeSet::new();
            names_in(of, &mut names);
            names.remove(index);
            let is_written_out = [from, to].iter().all(|end| matches!(end, Tree::Number(_)));
            let hides = |name: &Name| is_written_out && hides_index(name, index);
            // of y_i = a + b x_i it is seen
            let shows = |name: &&Name| prints_letter(name, index);
            let moves = |name: &Name| self.values(name).any(|value| moves_with(&value.right, index));
            names.iter().any(hides) || self.reached(&names).iter().filter(|name| !shows(name)).any(moves)
        })
    }

    /// Returns true if a pair such as `h_{1,2}` is of a letter that is a function, or that functions run over.
    fn is_pair_of_functions(&self, name: &Name) -> bool {
        pair_of(name).is_some_and(|single| self.is_function(&single))
    }

    /// Returns true if a name is a function of time, or time itself where there is one.
    fn is_function(&self, name: &Name) -> bool {
        let plain = Name {
            primes: 0,
            ..name.clone()
        };
        let is_rate = self.moving.iter().any(|function| is_rate_of(&plain, function));
        is_rate || self.functions.contains(&plain) || (!self.functions.is_empty() && name.to_string() == TIME)
    }

    /// Whether this is the modulus of what may be complex.
    fn is_modulus(&self, node: &Tree) -> bool {
        let may_be_complex = |node: &Tree| matches!(node, Tree::Symbol(name, _) if self.complex.contains(name));
        matches!(node, Tree::Call(name, of, _) if name.base == r"\abs" && any(of, &mut |node| may_be_complex(node)))
    }

    /// The name that an equation gives, where it is the first to speak of it.
    fn defined(&self, equation: &Equation) -> Option<Name> {
        let name = match &equation.left {
            Tree::Symbol(name, _) => name,
            Tree::Call(name, argument, _)
                if self.given_functions.contains(name)
                    && argument.arguments().iter().all(|own| matches!(own, Tree::Symbol(..))) =>
            {
                name
            }
            _ => return None,
        };
        let mut right = BTreeSet::new();
        names_in(&equation.right, &mut right);
        // what a display defines counts before what the text says in passing
        let is_met = self.met.contains(name) && !self.in_passing.contains(name);
        let is_new = !is_met && !self.symbols.knows(name) && !is_constant(name);
        let is_function = self.functions.contains(name) || name.base == TIME;
        let is_one = pair_of(name).is_none() && name.primes == 0 && !is_function;
        let none = |_: &Name| false;
        // the mean of a sum is no name
        let is_law = || is_opaque(name) && Reader::new(&none).has_identity(equation);
        let is_definition =
            equation.relation == Relation::Equal && is_new && is_one && !right.contains(name) && !is_law();
        is_definition.then(|| name.clone())
    }

    /// The name that an equation gives which holds up to the place `until` of the text; none where it has the value up to there alone, and
    /// is spoken of later.
    fn defined_until(&mut self, equation: &Equation, at: usize, until: usize) -> Option<Name> {
        let name = self.defined(equation)?;
        if self.spoken_last.get(&name).is_some_and(|last| *last >= until) {
            let from = self.places.get(at).copied().unwrap_or_default();
            self.scopes.entry(name).or_default().push(from..until);
            return None;
        }
        Some(name)
    }

    /// Whether an equation is the first to speak of a function, and says what it is.
    fn is_new_law(&self, equation: &Equation) -> bool {
        let Tree::Call(name, argument, _) = &equation.left else {
            return false;
        };
        let is_time = matches!(argument.as_ref(), Tree::Symbol(time, _) if time.to_string() == TIME);
        let mut right = BTreeSet::new();
        names_in(&equation.right, &mut right);
        // a dot says what it is already
        let is_derivative = self.functions.iter().any(|function| function.dotted() == *name);
        let is_new =
            self.functions.contains(name) && !self.met.contains(name) && !right.contains(name) && !is_derivative;
        equation.relation == Relation::Equal && is_time && is_new
    }

    /// Returns the names in equations; a derivative of a function that a definition gives is named by that function.
    fn names_of<'e>(&self, equations: impl IntoIterator<Item = &'e Equation>) -> BTreeSet<Name> {
        let is_given =
            |function: &Name| self.given_functions.contains(function) && self.definitions.contains_key(function);
        let plain = |name: Name| undotted(&name).filter(is_given).unwrap_or(name);
        names_of(equations).into_iter().map(plain).collect()
    }

    /// The definitions of these names.
    fn definitions_of(&self, names: &BTreeSet<Name>) -> Vec<String> {
        names
            .iter()
            .filter_map(|name| self.definitions.get(name))
            .cloned()
            .collect()
    }

    /// What of the formulas that a claim rests on nobody says, a part of a sentence each; `below` says what each follows from.
    pub fn beneath(&self, label: &str, below: &HashMap<String, Vec<String>>) -> Vec<String> {
        let mut guessed: Vec<(&String, String)> = Vec::new();
        for next in labels_below(label, below) {
            let role = self
                .guessed
                .get(next)
                .map(|role| match self.is_stated(next) && *role == Role::Claim {
                    true => format!("({next}) holds"),
                    false => format!("({next}) is a {role}"),
                });
            let doubt = format!("no other row of its display is a condition on ({next})");
            let told = role.into_iter().chain(self.doubtful.contains(next).then_some(doubt));
            guessed.extend(told.map(|told| (next, told)));
        }
        guessed.sort();
        let told = guessed.iter().take(MOST_TOLD).map(|(_, told)| told.clone());
        let more = guessed.len().saturating_sub(MOST_TOLD);
        let more = (more > 0).then(|| format!("{more} more are what they are taken for"));
        self.undeclared_beneath(label, below)
            .into_iter()
            .chain(told)
            .chain(more)
            .collect()
    }

    /// Returns what a claim takes for granted of the symbols that nothing declares.
    fn undeclared_beneath(&self, label: &str, below: &HashMap<String, Vec<String>>) -> Vec<String> {
        let labels = labels_below(label, below).into_iter().map(String::as_str);
        let used: BTreeSet<&Name> = labels
            .chain([label])
            .filter_map(|label| self.uses.get(label))
            .flatten()
            .collect();
        let (functions, numbers): (Vec<&Name>, Vec<&Name>) =
            used.into_iter().partition(|name| self.functions.contains(name));
        let list = |names: &[&Name], argument: &str| -> String {
            let shown: Vec<String> = names.iter().map(|name| format!("`{name}{argument}`")).collect();
            shown.join(", ")
        };
        let kind = |count: usize, kind: &str| match count {
            0 => None,
            1 => Some(format!("is a real {kind}")),
            _ => Some(format!("are real {kind}s")),
        };
        let told = |names: &[&Name], argument: &str, kind: Option<String>| {
            kind.map(|kind| format!("{}, which no comment declares, {kind}", list(names, argument)))
        };
        let numbers_are = told(&numbers, "", kind(numbers.len(), "number"));
        let functions_are = told(&functions, &format!("({TIME})"), kind(functions.len(), "function"));
        let meant = numbers.iter().filter_map(|name| {
            let meant = self.undeclared.get(*name)?.as_ref()?;
            Some(format!("`{name}` is no misprint of `{meant}`"))
        });
        numbers_are.into_iter().chain(functions_are).chain(meant).collect()
    }

    /// Declares in `raw` what its formulas use beside the symbols that the document declares, or that its formulas were seen to hold:
    /// real numbers and functions of time.
    pub fn complete(&mut self, raw: &mut RawSheet, lines: &Text) {
        if self.is_strict {
            return;
        }
        if !self.has_symbols {
            return self.complete_guess(raw, lines);
        }
        while let Ok(sheet) = Sheet::from_raw(raw, lines, &Symbols::default()) {
            let new = self.unknown(&sheet);
            let more = self.with(raw.symbols.as_ref(), &new);
            let Some(symbols) = more.filter(|_| !new.is_empty()) else {
                self.uses = self.uses(&sheet);
                return;
            };
            raw.symbols = Some(symbols);
            self.undeclared.extend(new);
        }
    }

    /// Declares the symbols of a document that declares none itself, and what is met when its formulas are read with these: a letter, or
    /// a term that is not understood where nothing in the formula runs that it may depend on.
    fn complete_guess(&mut self, raw: &mut RawSheet, lines: &Text) {
        for _ in 0..MOST_ROUNDS {
            raw.symbols = self.raw_symbols().map(|symbols| Spanned::new(0..0, symbols));
            let Ok(sheet) = Sheet::from_raw(raw, lines, &Symbols::default()) else {
                return;
            };
            let mut new = BTreeSet::new();
            for entry in &sheet.entries {
                let unknown = entry
                    .unread
                    .iter()
                    .flat_map(Fault::unknown)
                    .map(|unknown| &unknown.name);
                let mut equations = entry.equations.iter();
                let is_bound = entry.equations.is_empty() || equations.any(|equation| any_side(equation, &mut binds));
                let may_be_symbol = |name: &&Name| !is_opaque(name) || !is_bound;
                new.extend(unknown.filter(may_be_symbol).cloned());
            }
            let known = self.names.len();
            self.names.extend(new);
            if self.names.len() == known {
                return;
            }
        }
    }

    /// The symbols of the document and these, where they go together.
    fn with(
        &self,
        symbols: Option<&Spanned<RawSymbols>>,
        new: &BTreeMap<Name, Option<String>>,
    ) -> Option<Spanned<RawSymbols>> {
        let names: BTreeSet<Name> = new.keys().cloned().collect();
        let functions: Vec<Name> = self
            .functions
            .iter()
            .filter(|name| names.contains(name))
            .cloned()
            .collect();
        let symbols = symbols?;
        let declared = symbols.get_ref().clone();
        let mut more = self.declared(&names, &functions);
        more.times.retain(|time| !declared.times.contains(time));
        let all = declared.and(more).ok()?;
        let is_consistent = all.read().is_ok_and(|symbols| check(&symbols).is_ok());
        is_consistent.then(|| Spanned::new(symbols.span(), all))
    }

    /// The symbols that formulas lack and that are not declared yet, where their kind can be guessed.
    fn unknown(&self, sheet: &Sheet) -> BTreeMap<Name, Option<String>> {
        let of_time = |entry: &Entry| called_with_time(&entry.tex.tex);
        let (read, unread): (Vec<&Entry>, Vec<&Entry>) = sheet.entries.iter().partition(|entry| entry.unread.is_none());
        let known: HashSet<Name> = read.into_iter().flat_map(of_time).collect();
        let mut found = BTreeMap::new();
        for entry in unread {
            let at = self.numbers.get(printed_label(&entry.label));
            if at.is_none_or(|&at| self.question(at, &entry.tex.tex).is_some()) {
                continue;
            }
            let functions = of_time(entry)
                .into_iter()
                .filter(|name| self.functions.contains(name) && !known.contains(name));
            found.extend(functions.map(|name| (name, None)));
            let symbols = entry.unread.iter().flat_map(Fault::unknown);
            let symbols = symbols.filter(|unknown| !is_derivative(&unknown.name));
            for unknown in symbols {
                // of a pair its single symbol is what is declared
                found.extend(pair_of(&unknown.name).map(|single| (single, None)));
                found.insert(unknown.name.clone(), unknown.meant.clone());
            }
        }
        found.retain(|name, _| !self.undeclared.contains_key(name));
        found
    }

    /// Returns the symbols that nothing declares, for each formula that uses some.
    fn uses(&self, sheet: &Sheet) -> HashMap<String, BTreeSet<Name>> {
        let mut uses: HashMap<String, BTreeSet<Name>> = HashMap::new();
        for entry in &sheet.entries {
            let mut names = BTreeSet::new();
            for (tree, _) in entry.trees(&sheet.symbols) {
                names_in(tree, &mut names);
            }
            let undeclared = names
                .iter()
                .flat_map(|name| [Some(name.clone()), pair_of(name), undotted(name)]);
            let own = undeclared.flatten().filter(|name| self.undeclared.contains_key(name));
            uses.entry(printed_label(&entry.label).to_owned())
                .or_default()
                .extend(own);
        }
        uses
    }

    /// The symbols that occur, where the document declares none.
    pub fn raw_symbols(&self) -> Option<RawSymbols> {
        if self.has_symbols {
            return None;
        }
        Some(self.declared(&self.names, &self.functions))
    }

    /// Declarations of names that the document does not declare or define: functions of time, and real numbers.
    fn declared(&self, names: &BTreeSet<Name>, functions: &[Name]) -> RawSymbols {
        let single = |name: &Name| pair_of(name).unwrap_or_else(|| name.clone());
        let is_needed = |name: &&Name| !is_constant(name) && !self.definitions.contains_key(*name);
        let needed = names.iter().filter(is_needed).map(single);
        // what cannot be declared costs the formulas that hold it, and no other
        let is_declared = |name: &String| {
            let alone = RawSymbols {
                parameters: vec![name.clone()],
                opaque: self.opaque.clone(),
                ..RawSymbols::default()
            };
            alone.read().is_ok()
        };
        let parameters: BTreeSet<String> = needed
            .filter(|name| !self.is_function(name))
            .map(|name| name.to_string())
            .filter(is_declared)
            .collect();
        let derivative = |name: &Name| {
            let next = name.dotted();
            let next = functions.contains(&next).then(|| next.to_string());
            format!("{name} = {}", next.unwrap_or_default())
        };
        let symbols = RawSymbols {
            parameters: parameters.into_iter().collect(),
            opaque: self.opaque.clone(),
            ..RawSymbols::default()
        };
        let with_functions = RawSymbols {
            times: match functions.is_empty() || self.declares_time() {
                true => Vec::new(),
                false => vec![TIME.to_owned()],
            },
            functions: Pairs::List(functions.iter().map(derivative).collect()),
            ..symbols.clone()
        };
        let is_consistent = with_functions.read().is_ok_and(|symbols| check(&symbols).is_ok());
        if is_consistent { with_functions } else { symbols }
    }

    /// Returns true if the document declares the running time itself.
    fn declares_time(&self) -> bool {
        read_name(TIME, &Names::default()).is_ok_and(|time| self.symbols.knows(&time))
    }

    /// What is guessed of the document as a whole.
    pub fn told(&self) -> Vec<String> {
        let mut told = Vec::new();
        let definitions = self.guessed.iter().filter(|(_, role)| **role == Role::Definition);
        let mut labels: Vec<String> = definitions.map(|(label, _)| format!("({label})")).collect();
        labels.sort_unstable();
        if !labels.is_empty() {
            told.push(format!("definitions are guessed: {}", listed(&labels)));
        }
        if !self.undeclared.is_empty() {
            let names: Vec<String> = self.undeclared.keys().map(ToString::to_string).collect();
            told.push(format!(
                "symbols beside those declared are guessed, all real: {} (`% audit: symbols only` forbids it)",
                listed(&names)
            ));
        }
        if let Some(symbols) = self
            .raw_symbols()
            .filter(|symbols| !symbols.parameters.is_empty() || !self.functions.is_empty())
        {
            let is_letter = |name: &&String| read_name(name, &Names::default()).is_ok_and(|name| !is_opaque(&name));
            let letters: Vec<String> = symbols.parameters.iter().filter(is_letter).cloned().collect();
            let terms = match symbols.parameters.len() - letters.len() {
                0 => String::new(),
                terms => format!("; {terms} terms are one symbol each"),
            };
            let functions: Vec<String> = self.functions.iter().map(ToString::to_string).collect();
            let of_time = if functions.is_empty() {
                String::new()
            } else {
                format!("; functions of {TIME}: {}", functions.join(", "))
            };
            told.push(format!(
                "symbols are guessed, all real: {}{of_time}{terms}",
                listed(&letters)
            ));
        }
        told
    }
}

/// The most names or labels that a message lists.
const MOST_LISTED: usize = 40;

/// Lists the first of these, and says how many more there are.
fn listed(names: &[String]) -> String {
    let first = names.get(..MOST_LISTED).unwrap_or(names).join(", ");
    match names.len().saturating_sub(MOST_LISTED) {
        0 => first,
        more => format!("{first} and {more} more"),
    }
}

/// The label that a formula has in the document, of which an equivalence `7` is decided as `7 =>` and `7 <=`.
fn printed_label(label: &str) -> &str {
    label.trim_end_matches(" =>").trim_end_matches(" <=")
}

/// The name that this is a derivative of, where it has dots or primes.
fn undotted(name: &Name) -> Option<Name> {
    let accents = name.accents.iter().filter(|accent| !accent.contains("dot"));
    is_derivative(name).then(|| Name {
        primes: 0,
        accents: accents.cloned().collect(),
        ..name.clone()
    })
}

/// Returns true for a name with dots or primes, which is the derivative of another.
fn is_derivative(name: &Name) -> bool {
    name.primes > 0 || name.accents.iter().any(|accent| accent.contains("dot"))
}

/// The labels of everything that a formula follows from.
fn labels_below<'a>(label: &str, below: &'a HashMap<String, Vec<String>>) -> BTreeSet<&'a String> {
    let of = |label: &str| below.get(label).into_iter().flatten();
    let (mut met, mut open): (BTreeSet<&String>, Vec<&String>) = (BTreeSet::new(), of(label).collect());
    while let Some(next) = open.pop() {
        if met.insert(next) {
            open.extend(of(next));
        }
    }
    met
}

/// The names that stand before `(t)`.
fn called_with_time(tex: &str) -> Vec<Name> {
    let mut found = Vec::new();
    let argument = format!("({TIME})");
    let plain = with_commands(tex).replace(r"\left(", "(").replace(r"\right)", ")");
    for (at, _) in plain.match_indices(&argument) {
        let before = plain.get(..at).unwrap_or_default().trim_end().trim_end_matches('\'');
        found.extend(last_name(before));
    }
    found
}

/// The name that a text ends with.
fn last_name(before: &str) -> Option<Name> {
    let starts = before.char_indices().rev().map(|(at, _)| at).take(40);
    // a letter in bold is a name of its own
    let bold = Names {
        opaque: Some(Opaque::default()),
        ..Names::default()
    };
    // the longest that is one name with an accent or subscript, else its last letter
    let names = starts.filter_map(|at| {
        let text = before.get(at..)?;
        let name = read_name(text, &bold).ok()?;
        let is_elementary = Elementary::named(&name).is_some();
        (!is_elementary && name.primes == 0 && name.mark.is_empty()).then_some(name)
    });
    names.last()
}

/// The letters before a bracket that may be functions: those that mostly are, and those before a single term, which a factor would
/// need no bracket for; those of time are known. What is shown has no blanks, and no `\left`.
fn letters_called<'a>(shown: &'a str, is_of_time: &'a dyn Fn(&str) -> bool) -> impl Iterator<Item = &'a str> {
    shown.match_indices(['(', '[']).filter_map(move |(at, bracket)| {
        let (before, inside) = (&shown[..at], &shown[at + 1..]);
        let letter = letter_before(before)?;
        if inside.starts_with("t)") {
            return None;
        }
        let close = if bracket == "(" { ')' } else { ']' };
        let inside = inside.split([close, '(', '[']).next().unwrap_or_default();
        let is_closed = shown[at + 1 + inside.len()..].starts_with(close);
        let is_single = is_closed && !inside.trim_start_matches('-').contains(['+', '-', '=', ',']);
        let may_be_called = is_single || (bracket == "[" && is_closed);
        (FUNCTION_LETTERS.contains(&letter) || (may_be_called && !is_of_time(letter))).then_some(letter)
    })
}

/// What a document with matrices prints.
const OF_MATRICES: [&str; 8] = [
    "matrix}",
    r"\det",
    r"\top",
    r"\operatorname{tr}",
    r"\mathrm{tr}",
    r"\operatorname{rank}",
    r"\operatorname{diag}",
    r"\Tr",
];

/// Whether a capital letter has the mark of a transpose or an adjoint.
fn has_adjoint(shown: &str) -> bool {
    let marks = [
        "^T",
        "^{T}",
        "^H",
        "^{H}",
        "^*",
        "^{*}",
        "^+",
        "^{+}",
        r"^\dagger",
        r"^{\dagger}",
    ];
    marks.iter().any(|mark| {
        let mut before = shown
            .match_indices(mark)
            .filter_map(|(at, _)| shown.get(..at)?.chars().next_back());
        before.any(|c| c.is_ascii_uppercase())
    })
}

/// Returns true if a letter stands at the running time and by itself, `A(t) = A`: as a function and as a value of it, or as two.
fn is_with_and_without_time(equation: &Equation) -> bool {
    let (mut called, mut alone) = (BTreeSet::new(), BTreeSet::new());
    any_side(equation, &mut |node| {
        match node {
            Tree::Call(name, of, _) if matches!(&**of, Tree::Symbol(time, _) if time.to_string() == TIME) => {
                called.insert(name.clone());
            }
            Tree::Symbol(name, _) => {
                alone.insert(name.clone());
            }
            _ => {}
        }
        false
    });
    !called.is_disjoint(&alone)
}

/// Returns true if `T` stands above letters and brackets and nowhere else: as the sign of a transpose.
fn is_sign_alone<'e>(equations: impl Iterator<Item = &'e Equation>, has_vectors: bool) -> bool {
    let is_sign = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if *name == Name::plain("T"));
    let (mut signs, mut all, mut is_of_matrix, mut is_power) = (0_usize, 0_usize, has_vectors, false);
    for equation in equations {
        any_side(equation, &mut |node| {
            let exponent = match node {
                Tree::RealPower(of, exponent, _) if !matches!(**of, Tree::Number(_)) => match &**exponent {
                    Tree::Negate(inner) => Some((&**of, &**inner)),
                    exponent => Some((&**of, exponent)),
                },
                _ => None,
            };
            if let Some((of, _)) = exponent.filter(|(_, exponent)| is_sign(exponent)) {
                signs += 1;
                is_of_matrix |= letter_of(of)
                    .is_none_or(|name| name.base.chars().all(|c| c.is_ascii_uppercase()) || is_bold(&name.base));
                is_power |= matches!(of, Tree::Sum(terms) if terms.iter().any(|term| matches!(term, Tree::Number(_))));
            }
            all += usize::from(is_sign(node) || matches!(node, Tree::Call(name, ..) if *name == Name::plain("T")));
            false
        });
    }
    signs > 0 && signs == all && is_of_matrix && !is_power
}

/// Returns the last place at which a formula speaks of each letter.
fn spoken_last(formulas: &[Formula], read: &[Vec<Equation>]) -> HashMap<Name, usize> {
    let mut last = HashMap::new();
    for (formula, equations) in formulas.iter().zip(read) {
        last.extend(names_of(equations).into_iter().map(|name| (name, formula.part.start)));
    }
    last
}

/// Returns true if a name prints a letter, in its subscripts too.
fn prints_letter(name: &Name, letter: &Name) -> bool {
    let letters = letters(&name.to_string(), &Names::default());
    letters.iter().any(|(own, _)| *own == letter.base)
}

/// Returns true if a value speaks of an index otherwise than in a sum of its own by it.
fn moves_with(value: &Tree, index: &Name) -> bool {
    match value {
        Tree::Symbol(name, _) => prints_letter(name, index),
        Tree::Operation(operation, _) if operation.letter() == Some(index) => false,
        Tree::Call(name, ..) if prints_letter(name, index) => true,
        _ => value
            .find_below(&mut |part| moves_with(part, index).then_some(()))
            .is_some(),
    }
}

/// Returns true if a name prints an index and is no member of a family by it, `x_i` or `x_{i+1}`.
fn hides_index(name: &Name, index: &Name) -> bool {
    let is_member = index_of(&name.subscript, &index.base).is_some() && !is_opaque(name);
    prints_letter(name, index) && !is_member
}

/// The capital letters that are transposed or inverted, or stand beside what is, or beside a letter in bold: `P \bm{d}`, `x^\top P`.
fn matrices_in<'e>(equations: impl Iterator<Item = &'e Equation> + Clone) -> BTreeSet<String> {
    let is_capital = |base: &&String| base.len() == 1 && base.chars().all(|c| c.is_ascii_uppercase());
    let base = |tree: &Tree| letter_of(tree).map(|name| name.base.clone());
    let is_bold = |tree: &Tree| base(tree).is_some_and(|base| is_bold(&base));
    let mut found: BTreeSet<String> = BTreeSet::new();
    let each = |test: &mut dyn FnMut(&Tree)| {
        for equation in equations.clone() {
            any_side(equation, &mut |node| {
                test(node);
                false
            });
        }
    };
    each(&mut |node| match node {
        node if transposed(node).is_some() => found.extend(transposed(node).and_then(base)),
        Tree::Product(factors) => {
            let inverses = factors.iter().filter(|factor| matches!(factor, Tree::Power(_, -1, _)));
            found.extend(inverses.filter_map(base).filter(|base| is_capital(&base)));
        }
        _ => {}
    });
    let beside = found.clone();
    let is_marked = |tree: &Tree| is_bold(tree) || base(tree).is_some_and(|base| beside.contains(&base));
    each(&mut |node| {
        if let Tree::Product(factors) = node {
            for (first, last) in factors.iter().zip(factors.iter().skip(1)) {
                found.extend(base(first).filter(|_| is_marked(last)));
                found.extend(base(last).filter(|_| is_marked(first)));
            }
        }
    });
    found.retain(|base| is_capital(&base));
    found
}

/// The letters that stand before a bracket with one letter, a number or a list in it, as functions do: `P(x)`, `P(0)`, `P(x, y)`.
fn called_with_a_letter(shown: &str) -> Vec<String> {
    let is_argument = |inside: &str| {
        let printed = letters(inside, &Names::default()).len();
        inside.contains(',') || (printed <= 1 && !inside.contains(['+', '-', '^', '(']))
    };
    shown
        .match_indices('(')
        .filter(|(at, _)| {
            let inside = shown.get(at + 1..).and_then(|rest| rest.split(')').next());
            inside.is_some_and(is_argument)
        })
        .filter_map(|(at, _)| letter_before(shown.get(..at)?).map(str::to_owned))
        .collect()
}

/// The conditions under which the sums and products of an equation have a term at least, `n \in \mathbb{Z}` and `n \ge 1`; none
/// where members of a family stand in it, `x_i`, of which nothing is decided number by number.
fn with_terms(equation: &Equation) -> BTreeSet<String> {
    let (mut ranges, mut letters, mut subscripts) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    any_side(equation, &mut |node| {
        match node {
            Tree::Operation(operation, _) => {
                if let Operation::Series { index, from, to, .. } = &**operation {
                    letters.insert(index.clone());
                    ranges.push((index.clone(), from.clone(), to.clone()));
                }
            }
            Tree::Symbol(name, _) | Tree::Call(name, ..) => {
                subscripts.extend((!name.subscript.is_empty()).then(|| name.subscript.clone()))
            }
            _ => {}
        }
        false
    });
    let mut conditions = BTreeSet::new();
    for (_, from, to) in &ranges {
        let is_number = |end: &Tree| infinity(end).is_none() && !matches!(end, Tree::Operation(..));
        let is_known = [from, to]
            .into_iter()
            .all(|end| is_number(end) && letters.iter().all(|index| !end.has_free(index)));
        if is_known && !matches!((from, to), (Tree::Number(_), Tree::Number(_))) {
            let mut names = BTreeSet::new();
            names_in(from, &mut names);
            names_in(to, &mut names);
            conditions.extend(names.iter().map(|name| format!(r"{name} \in \mathbb{{Z}}")));
            conditions.insert(format!(r"{to} \ge {from}"));
            letters.extend(names);
        }
    }
    let numbers = |subscript: &String| letters.iter().any(|letter| subscript.contains(&letter.to_string()));
    match subscripts.iter().any(numbers) {
        true => BTreeSet::new(),
        false => conditions,
    }
}

/// Whether `\times` stands between letters.
fn crosses_letters(shown: &str) -> bool {
    shown.split(r"\times").collect::<Vec<_>>().windows(2).any(|sides| {
        let ends_in_letter = !sides[0].ends_with(|c: char| c.is_ascii_digit() || c == ')');
        ends_in_letter && !sides[1].starts_with(|c: char| c.is_ascii_digit() || c == '(')
    })
}

/// The pairs of letters in `[x,p]`.
fn commutators(shown: &str) -> impl Iterator<Item = [String; 2]> {
    shown.match_indices('[').filter_map(|(at, _)| {
        let (one, other) = shown[at + 1..].split(']').next()?.split_once(',')?;
        let is_letter = |text: &str| text.len() == 1 && text.chars().all(|c| c.is_ascii_alphabetic());
        (is_letter(one) && is_letter(other)).then(|| [one.to_owned(), other.to_owned()])
    })
}

/// The letter at the end, without its scripts and primes.
fn letter_before(text: &str) -> Option<&str> {
    let text = text.trim_end_matches('\'');
    let bare = match text.strip_suffix('}') {
        Some(open) => open
            .rfind('{')
            .map(|brace| &open[..brace])
            .filter(|head| head.ends_with('_')),
        None => text.get(..text.len().saturating_sub(1)),
    };
    let text = bare.and_then(|head| head.strip_suffix('_')).unwrap_or(text);
    let last = text.chars().next_back().filter(|c| c.is_alphabetic())?;
    let head = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    match head.strip_suffix('\\') {
        Some(before) => {
            let command = &text[before.len()..];
            let is_letter = texmath::letter(command).is_some() && command != r"\pi";
            is_letter.then_some(command)
        }
        None => Some(&text[text.len() - last.len_utf8()..]),
    }
}
