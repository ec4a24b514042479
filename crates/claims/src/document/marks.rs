//! Letters that a document marks as more than real numbers: as matrices, vectors or operators, and as complex.

use super::super::functional::letters_in;
use super::members::{Members, contains_unit, j_is_unit};
use crate::words::{Reader, transposed};
use std::collections::BTreeSet;
use texmath::{
    BOLD, Equation, Invariant, Name, Names, Opaque, Operation, Relation, Tree, any, any_side, base_alone,
    holds_unknown, is_constant, letters, names_in,
};

/// The letters that a document marks.
#[derive(Default)]
pub(super) struct Marks {
    /// Letters whose factors may not change places.
    operators: BTreeSet<Name>,
    complex: BTreeSet<Name>,
    /// Operators that are 1.
    identities: BTreeSet<Name>,
    /// Letters that are transposed, or inverted in front of a factor.
    transposed: BTreeSet<Name>,
    /// Letters that are divided by, as nobody divides by matrices.
    numbers: BTreeSet<Name>,
    /// The letters of matrices that are not square.
    rectangles: BTreeSet<String>,
    /// Those that are called square.
    squares: BTreeSet<String>,
    /// True if the text speaks of the identity.
    says_identity: bool,
}

/// Accents of vectors.
const ARROWS: [&str; 2] = [r"\vec", r"\overrightarrow"];

/// Letters by what they are factors of.
#[derive(Default)]
struct Factors {
    /// Capital letters beside a matrix, or beside each other.
    of_matrices: BTreeSet<Name>,
    /// Factors of divisors and of what roots, logarithms, sines and cosines are taken of.
    numbers: BTreeSet<Name>,
    /// Those of them that stand in divisors, or in powers with a Greek exponent, where nobody writes an estimate for an operator.
    divisors: BTreeSet<Name>,
    /// True if the text calls letters matrices, so that any two capital letters may be some: `G M` of a text about masses are none.
    are_named: bool,
}

impl Factors {
    /// Notes the letters that one node multiplies and divides by; `matrices` are letters that stand for matrices elsewhere.
    fn read(&mut self, node: &Tree, matrices: &BTreeSet<String>) {
        match node {
            Tree::Product(factors) => {
                let plain = |factor: &Tree| letter_of_power(factor).filter(|name| is_capital(name)).cloned();
                let is_of_matrices = |factor: &Tree| match factor {
                    Tree::Operation(operation, _) if matches!(**operation, Operation::Matrix(_)) => true,
                    factor if transposed(factor).is_some() => true,
                    // X^t
                    Tree::RealPower(of, ..) => letter_of_power(of).is_some_and(|name| matrices.contains(&name.base)),
                    factor => letter_of_power(factor).is_some_and(|name| {
                        is_typographic(name)
                            || matrices.contains(&name.base)
                            || (self.are_named && is_capital(name) && name.subscript.is_empty())
                    }),
                };
                for (first, last) in factors.iter().zip(factors.iter().skip(1)) {
                    self.of_matrices.extend(plain(first).filter(|_| is_of_matrices(last)));
                    self.of_matrices.extend(plain(last).filter(|_| is_of_matrices(first)));
                }
            }
            Tree::Quotient(_, of, _) | Tree::Root(of, ..) => {
                let known = std::mem::take(&mut self.numbers);
                self.read_number(of);
                self.divisors.extend(self.numbers.iter().cloned());
                self.numbers.extend(known);
            }
            Tree::RealPower(of, exponent, _) if any(exponent, &mut |node| is_greek(node)) => {
                self.numbers.extend(letter_of_power(of).cloned());
            }
            Tree::Call(name, of, _) if OF_NUMBERS.contains(&name.base.as_str()) => self.read_number(of),
            _ => {}
        }
    }

    /// Notes the letters of a product that is a number.
    fn read_number(&mut self, product: &Tree) {
        let factors = match product {
            Tree::Product(factors) => factors.as_slice(),
            one => std::slice::from_ref(one),
        };
        let letters: Vec<Option<&Name>> = factors
            .iter()
            .filter(|factor| !matches!(factor, Tree::Number(_)))
            .map(letter_of_power)
            .collect();
        if let Some(letters) = letters.into_iter().collect::<Option<BTreeSet<&Name>>>() {
            self.numbers.extend(letters.into_iter().cloned());
        }
    }
}

/// The letter of a factor, to whatever power that is a number.
fn letter_of_power(factor: &Tree) -> Option<&Name> {
    match factor {
        Tree::Symbol(name, _) => Some(name),
        Tree::Power(of, ..) => letter_of_power(of),
        _ => None,
    }
}

fn is_capital(name: &Name) -> bool {
    name.base.len() == 1 && name.base.chars().all(|c| c.is_ascii_uppercase())
}

/// Returns true for `\Lambda`, whatever its subscript.
fn is_large_greek(name: &Name) -> bool {
    let is_large = name.base.chars().nth(1).is_some_and(|c| c.is_ascii_uppercase());
    name.base.starts_with('\\') && is_large && is_letter(name)
}

/// Returns true for `\lambda`, without accents.
fn is_small_greek(name: &Name) -> bool {
    let is_small = name.base.chars().nth(1).is_some_and(|c| c.is_ascii_lowercase());
    name.accents.is_empty() && name.base.starts_with('\\') && is_small && is_letter(name)
}

/// Returns what begins a term that is a value, `T(\mathbf{q}, t)`, and all of any other: a value is of the kind of its function,
/// where no matrix is put in.
fn head(base: &str) -> &str {
    match base.find(['(', '[']) {
        Some(at) if at > 0 && at + bracketed(base.get(at..).unwrap_or_default()) == base.len() => {
            base.get(..at).unwrap_or(base)
        }
        _ => base,
    }
}

/// Returns true for a term that is a number where what is in it is one: a mean, `\mathbb{E}[X]`, a probability, a product in angles.
fn is_scalar(base: &str) -> bool {
    let is_product = base.starts_with(r"\langle") && base.ends_with(r"\rangle");
    is_product || MEANS.iter().any(|mean| base.starts_with(mean))
}

/// Returns true for a letter in bold or script, and for a term that an operator begins.
fn is_set_apart(name: &Name) -> bool {
    let mut commands = OF_OPERATORS.iter().chain(&BOLD);
    let is_of_operators = !is_scalar(&name.base) && commands.any(|command| name.base.starts_with(command));
    let holds_vectors = || BOLD.iter().chain(&ARROWS).any(|sign| name.base.contains(sign));
    let is_integral = [r"\int", r"\oint", r"\iint", r"\iiint", r"\sum"]
        .iter()
        .any(|sign| name.base.contains(sign));
    let holds_transposes = || {
        [r"^\top", r"^{\top}", "^T", "^{T}"]
            .iter()
            .any(|sign| name.base.contains(sign))
    };
    is_of_operators
        || name.base.starts_with('|')
        || holds_unknown(head(&name.base))
        || holds_bold_capital(&name.base)
        || (is_integral && (holds_vectors() || holds_transposes()))
}

/// Returns true for a term with a capital letter in bold in it, as a function of a matrix is.
fn holds_bold_capital(base: &str) -> bool {
    BOLD.iter().any(|bold| {
        let mut places = base.match_indices(bold);
        places.any(|(at, _)| {
            let behind = base.get(at + bold.len()..).unwrap_or_default();
            behind
                .trim_start_matches(['{', ' '])
                .starts_with(|c: char| c.is_ascii_uppercase())
        })
    })
}

/// Returns true for `\overline{\overline{A}}` and `\underline{\underline{A}}`.
fn has_two_bars(name: &Name) -> bool {
    match name.accents.as_slice() {
        [.., one, other] => one == other && [r"\overline", r"\underline"].contains(&one.as_str()),
        _ => false,
    }
}

/// Returns true for a letter in bold, script, with an arrow or a hat, or with two bars.
fn is_typographic(name: &Name) -> bool {
    let accents = [r"\hat", r"\widehat", r"\mathcal", r"\mathscr", r"\mathfrak"];
    is_set_apart(name) || has_two_bars(name) || has_accent(name, &ARROWS) || has_accent(name, &accents)
}

/// Returns true for a letter with a hat, of an estimate more often than of an operator.
fn has_hat_alone(name: &Name) -> bool {
    has_accent(name, &[r"\hat", r"\widehat"])
        && !is_set_apart(name)
        && name.accents.len() == 1
        && name
            .base
            .trim_start_matches('\\')
            .starts_with(|c: char| c.is_ascii_lowercase())
}

/// Returns true for a small Greek letter.
fn is_greek(node: &Tree) -> bool {
    matches!(node, Tree::Symbol(name, _) if is_small_greek(name))
}

/// The letters of a claim that its document marks as more than real numbers.
#[derive(Default)]
pub(super) struct Marked {
    /// The letters that need not commute; none where it is the same for the claim.
    pub operators: Vec<String>,
    /// Those of them that are 1.
    pub identities: Vec<String>,
    /// The questions that a proof for real numbers leaves open.
    pub doubts: Vec<String>,
}

/// The equations of a claim and of everything that it follows from.
pub(super) struct Stated<'a> {
    pub own: Vec<&'a Equation>,
    pub below: Vec<&'a Equation>,
    /// True if more than definitions restricts the letters.
    pub is_restricted: bool,
}

/// The most terms of an equation that are compared with each other.
const MOST_TERMS: usize = 50;

/// Commands of functions of matrices alone.
const OF_MATRICES: [&str; 16] = [
    r"\det",
    r"\tr",
    r"\Tr",
    r"\rank",
    r"\operatorname{det}",
    r"\operatorname{tr}",
    r"\operatorname{Tr}",
    r"\operatorname{rank}",
    r"\mathrm{det}",
    r"\mathrm{tr}",
    r"\mathrm{Tr}",
    r"\mathrm{rank}",
    r"\text{det}",
    r"\text{tr}",
    r"\text{Tr}",
    r"\text{rank}",
];

/// Commands that begin a term which is not understood and may be no number, beside those of letters in bold.
const OF_OPERATORS: [&str; 5] = [r"\mathbb", r"\mathcal", r"\mathscr", r"\nabla", r"\langle"];

/// Functions of which matrices are hardly ever an argument.
const OF_NUMBERS: [&str; 8] = [
    r"\sin", r"\cos", r"\tan", r"\cot", r"\ln", r"\log", r"\arctan", r"\arccos",
];

/// Commands of means and probabilities.
const MEANS: [&str; 8] = [
    r"\mathbb{E}",
    r"\mathbb E",
    r"\mathbb{P}",
    r"\mathbb P",
    r"\mathbb{V}",
    r"\mathbb{Var}",
    r"\mathbb V",
    r"\mathbb{C}ov",
];

/// Commands of the parts of complex numbers.
pub(super) const OF_COMPLEX: [&str; 7] = [
    r"\Re",
    r"\Im",
    r"\arg",
    r"\operatorname{Re}",
    r"\operatorname{Im}",
    r"\mathrm{Re}",
    r"\mathrm{Im}",
];

/// Functions that agree with their real ones on identities of complex numbers.
const ANALYTIC: [&str; 10] = [
    r"\exp", r"\sin", r"\cos", r"\tan", r"\cot", r"\sec", r"\csc", r"\sinh", r"\cosh", r"\tanh",
];

/// The factors of terms that differ in their order alone, in an equation that does not hold where they commute: `P Q - Q P = c`.
fn reordered(equation: &Equation) -> Vec<Vec<Tree>> {
    let sides = [&equation.left, &equation.right]
        .into_iter()
        .flat_map(|side| terms(side));
    let products = sides.filter_map(|term| match term {
        Tree::Product(factors) => Some(factors.as_slice()),
        _ => None,
    });
    let all: Vec<&[Tree]> = products.take(MOST_TERMS).collect();
    let is_reordered = |one: &[Tree], other: &[Tree]| {
        one != other && one.len() == other.len() && one.iter().all(|factor| other.contains(factor))
    };
    let mut found = Vec::new();
    for (place, one) in all.iter().enumerate() {
        let others = all.iter().skip(place + 1).filter(|other| is_reordered(one, other));
        found.extend(others.map(|_| one.to_vec()));
    }
    let none = |_: &Name| false;
    let holds = || Reader::new(&none).has_identity(equation);
    match found.is_empty() || equation.relation != Relation::Equal || holds() {
        true => Vec::new(),
        false => found,
    }
}

impl Marks {
    /// Collects the marks of formulas, each with its TeX and what it states. `unit_is_number` says that `i` is the imaginary unit.
    pub fn new<'a>(
        formulas: impl Iterator<Item = (&'a str, &'a [Equation])> + Clone,
        commutators: &[[String; 2]],
        unit_is_number: bool,
        has_matrices: bool,
        mut members: Members,
    ) -> Self {
        let mut marks = Self {
            rectangles: std::mem::take(&mut members.rectangles),
            squares: std::mem::take(&mut members.squares),
            says_identity: members.says_identity,
            ..Self::default()
        };
        let mut letters_of_matrices: BTreeSet<String> = commutators.iter().flatten().cloned().collect();
        let mut letters_of_complex = BTreeSet::new();
        let j_is_unit = j_is_unit(formulas.clone().map(|(tex, _)| tex));
        if j_is_unit {
            letters_of_complex.insert("j".to_owned());
        }
        let bold = Names {
            opaque: Some(Opaque::default()),
            ..Names::default()
        };
        for (tex, equations) in formulas.clone() {
            members.add(tex);
            // i \hbar \dot\psi = H \psi, of which nothing more is known where it cannot be read
            if equations.is_empty() && unit_is_number && contains_unit(tex) {
                letters_of_complex.extend(
                    letters(tex, &Names::default())
                        .into_iter()
                        .map(|(letter, _)| letter.to_owned()),
                );
            }
            letters_of_matrices.extend(arguments(tex, &OF_MATRICES));
            letters_of_complex.extend(arguments(tex, &OF_COMPLEX));
            // one letter in bold is a name of its own; a matrix may lose its bold, while v beside a bold v is its length
            let printed = letters(tex, &bold).into_iter();
            letters_of_matrices.extend(
                printed
                    .filter(|(letter, shape)| {
                        shape.starts_with(r"\mathbf") && !letter.starts_with(|c: char| c.is_ascii_lowercase())
                    })
                    .map(|(letter, _)| letter.to_owned()),
            );
        }
        let texts = formulas.clone().map(|(tex, _)| tex);
        letters_of_matrices.append(&mut members.operators);
        letters_of_complex.append(&mut members.complex);
        let equations: Vec<&Equation> = formulas.flat_map(|(_, equations)| equations).collect();
        let turned = turned_letters(&equations, members.says_transposed);
        let has_matrices = has_matrices || !turned.is_empty();
        letters_of_matrices.extend(turned);
        let mut factors = Factors {
            are_named: !members.matrices.is_empty(),
            ..Factors::default()
        };
        let mut multiplied = BTreeSet::new();
        for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
            any(side, &mut |node| {
                factors.read(node, &letters_of_matrices);
                false
            });
        }
        for equation in &equations {
            marks.read_order(equation);
            for side in [&equation.left, &equation.right] {
                any(side, &mut |node| {
                    marks.read(node);
                    if let Tree::Symbol(name, _) | Tree::Call(name, ..) = node {
                        let is_plain = name
                            .accents
                            .iter()
                            .all(|accent| [r"\tilde", r"\mathfrak"].contains(&accent.as_str()));
                        if letters_of_matrices.contains(&name.base) && is_plain {
                            marks.operators.insert(name.clone());
                        }
                        let is_factor = factors.of_matrices.contains(name) && !factors.numbers.contains(name);
                        if has_matrices && is_factor && !is_constant(name) {
                            multiplied.insert(name.clone());
                        }
                        let holds_matrices = || {
                            let is_matrix =
                                |own: &String| letters_of_matrices.contains(own) || members.matrices.contains(own);
                            letters_in(name).iter().any(is_matrix)
                        };
                        if is_set_apart(name) || has_two_bars(name) || holds_matrices() {
                            marks.operators.insert(name.clone());
                        }
                        if letters_of_complex.contains(&name.base) && name.accents.is_empty() {
                            marks.complex.insert(name.clone());
                        }
                    }
                    false
                });
            }
        }
        let prints_unit = || unit_is_number && texts.clone().any(contains_unit);
        let is_of_complex = |node: &Tree| match node {
            Tree::Product(factors) => has_conjugates(factors),
            Tree::Call(name, ..) => name.base == r"\abs",
            _ => false,
        };
        let has_modulus = || {
            equations
                .iter()
                .any(|equation| any_side(equation, &mut |node| is_of_complex(node)))
        };
        if !(members.says_complex || !letters_of_complex.is_empty() || prints_unit() || has_modulus()) {
            // a star and a bar are marks as any other
            marks.complex.clear();
        }
        let mut numbers = factors.numbers;
        let is_said = |name: &Name| letters_of_matrices.contains(&name.base) || marks.operators.contains(name);
        numbers.extend(entries(&equations).into_iter().filter(|name| !is_said(name)));
        extend_to_multiples(&mut numbers, &equations, &is_said);
        marks.operators.append(&mut multiplied);
        marks.numbers = numbers
            .into_iter()
            .filter(|name| {
                let is_estimate = has_hat_alone(name) && commutators.is_empty() && !members.speaks_of_operators;
                !is_typographic(name) || (is_estimate && factors.divisors.contains(name))
            })
            // who says that it is a matrix divides by another letter of the name
            .filter(|name| {
                let is_matrix = name.accents.is_empty() && members.matrices.contains(&name.base);
                !is_matrix && !marks.transposed.contains(name)
            })
            .collect();
        marks.operators.retain(|name| !marks.numbers.contains(name));
        let identities = equations.iter().filter_map(|equation| identity_in(equation));
        marks.identities = identities.cloned().collect();
        // a vector of currents or an intensity has a value
        let has_value = |name: &Name| {
            let is_own = |side: &Tree| matches!(side, Tree::Symbol(own, _) if own == name);
            let others = equations.iter().filter(|equation| identity_in(equation) != Some(name));
            others.map(|equation| &equation.left).any(is_own)
        };
        marks.identities.retain(|name| !has_value(name));
        for equation in &equations {
            let is_identity = |side: &Tree| matches!(side, Tree::Symbol(name, _) if marks.identities.contains(name));
            if [&equation.left, &equation.right].into_iter().any(is_identity) {
                marks.mark_operators(&equation.left);
                marks.mark_operators(&equation.right);
            }
        }
        let is_unit = |name: &Name| unit_is_number && is_constant(name) && name.base == "i";
        // a mean is of the kind of what is in it
        let mut means = Vec::new();
        for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
            any(side, &mut |node| {
                if let Tree::Symbol(name, _) = node
                    && MEANS.iter().any(|mean| name.base.starts_with(mean))
                {
                    let inside = letters(&name.base, &Names::default()).into_iter();
                    means.push((name.clone(), inside.map(|(letter, _)| letter).collect()));
                }
                false
            });
        }
        // forwards and backwards, as equations refer to those before and behind
        let mut is_forward = true;
        loop {
            let known = marks.operators.len() + marks.complex.len();
            match is_forward {
                true => equations.iter().for_each(|equation| marks.spread(equation, &is_unit)),
                false => equations
                    .iter()
                    .rev()
                    .for_each(|equation| marks.spread(equation, &is_unit)),
            }
            let is_of_operators =
                |(_, inside): &&(Name, BTreeSet<String>)| marks.operators.iter().any(|own| inside.contains(&own.base));
            let more: Vec<Name> = means
                .iter()
                .filter(is_of_operators)
                .map(|(name, _)| name.clone())
                .collect();
            marks.operators.extend(more);
            is_forward = !is_forward;
            if marks.operators.len() + marks.complex.len() == known {
                break;
            }
        }
        // what an expectation with a hat is added to is a number
        let mut names = BTreeSet::new();
        for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
            names_in(side, &mut names);
        }
        // z_1 is complex where z_2 or z is
        let has_marked_sibling = |name: &Name, marked: &BTreeSet<Name>, is_complex: bool| {
            let is_sibling = |other: &Name| other.base == name.base && other.accents == name.accents;
            !name.subscript.is_empty()
                && marked
                    .iter()
                    .any(|other| (is_complex || !other.subscript.is_empty()) && is_sibling(other))
        };
        for (marked, is_complex) in [(&mut marks.operators, false), (&mut marks.complex, true)] {
            let siblings = names.iter().filter(|name| has_marked_sibling(name, marked, is_complex));
            let siblings: Vec<Name> = siblings.cloned().collect();
            marked.extend(siblings);
        }
        let is_capital = |name: &Name| name.base.chars().all(|c| c.is_ascii_uppercase());
        // one letter with a hat may be an estimate, several are operators as well
        for accents in [[r"\hat", r"\widehat"], [r"\mathcal", r"\mathscr"]] {
            let own: BTreeSet<&Name> = names.iter().filter(|name| has_accent(name, &accents)).collect();
            let are_several = own.len() > 1;
            marks
                .operators
                .extend(own.into_iter().filter(|name| are_several || is_capital(name)).cloned());
        }
        marks
            .operators
            .retain(|name| !is_constant(name) && !marks.numbers.contains(name));
        marks.complex.retain(|name| !is_constant(name));
        let added = match members.i_is_other {
            true => BTreeSet::new(),
            false => marks.identities_beside_matrices(&equations),
        };
        marks
            .identities
            .extend(added.into_iter().filter(|name| !has_value(name)));
        marks.operators.extend(marks.identities.iter().cloned());
        marks
    }

    /// The letters that are called like the identity and are added to matrices, `A - \lambda I`, where no equation has them beside
    /// numbers alone.
    fn identities_beside_matrices(&self, equations: &[&Equation]) -> BTreeSet<Name> {
        let is_one = |term: &Tree| match term {
            Tree::Symbol(name, _) => is_called_identity(name).then(|| name.clone()),
            Tree::Product(factors) => match factors.last() {
                Some(Tree::Symbol(name, _)) if is_called_identity(name) => {
                    let mut before = factors.iter().take(factors.len() - 1);
                    (!before.any(|factor| self.is_operator(factor))).then(|| name.clone())
                }
                _ => None,
            },
            _ => None,
        };
        let (mut found, mut beside_numbers) = (BTreeSet::new(), BTreeSet::new());
        let is_of_matrices = |node: &Tree| transposed(node).is_some() || matches!(node, Tree::Power(_, -1, _));
        let mut made = self.transposed.clone();
        for equation in equations {
            if let Tree::Symbol(name, _) = &equation.left
                && any(&equation.right, &mut |node| is_of_matrices(node))
            {
                made.insert(name.clone());
            }
        }
        for equation in equations {
            let (mut sums, mut names) = (Vec::new(), BTreeSet::new());
            for side in [&equation.left, &equation.right] {
                collect_sums(side, &mut sums);
                names_in(side, &mut names);
            }
            for sum in &sums {
                let plain = |term: &Tree| match term {
                    Tree::Negate(of) => (**of).clone(),
                    term => term.clone(),
                };
                let terms: Vec<Tree> = sum.iter().map(|term| plain(term)).collect();
                let is_matrix = |term: &Tree| is_one(term).is_none() && self.is_operator(term);
                // of S + I nothing is told, where S is no matrix by its own look: I may be one more letter
                let is_made = |term: &Tree| {
                    let is_open = matches!(term, Tree::Symbol(name, _) if !made.contains(name));
                    is_matrix(term) && (self.says_identity || !is_open)
                };
                let is_multiple = |term: &Tree| matches!(term, Tree::Product(_));
                let has_matrix = terms.iter().any(is_made);
                let has_any = terms.iter().any(is_matrix);
                found.extend(
                    terms
                        .iter()
                        .filter_map(|term| is_one(term).filter(|_| has_matrix || (has_any && is_multiple(term)))),
                );
            }
            for side in [&equation.left, &equation.right] {
                any(side, &mut |node| {
                    beside_numbers.extend(multiplied_identity(node, equation));
                    false
                });
            }
            let is_alone = !names
                .iter()
                .any(|name| self.operators.contains(name) && !is_called_identity(name));
            beside_numbers.extend(names.into_iter().filter(|name| is_alone && is_called_identity(name)));
        }
        found.retain(|name| !beside_numbers.contains(name));
        found
    }

    /// Returns true if an equation holds the inverse of a matrix that is not square.
    pub fn inverts_a_rectangle(&self, equation: &Equation) -> bool {
        let is_rectangle = |tree: &Tree| {
            let of = transposed(tree).unwrap_or(tree);
            matches!(of, Tree::Symbol(name, _) if self.rectangles.contains(&name.base) && name.accents.is_empty())
        };
        any_side(
            equation,
            &mut |node| matches!(node, Tree::Power(base, exponent, _) if *exponent < 0 && is_rectangle(base)),
        )
    }

    /// Returns true if small letters may be columns by what formulas have them beside: no `x^\top A y` is added or equal to the
    /// identity or a large Greek letter.
    pub fn may_have_columns<'a>(mut equations: impl Iterator<Item = &'a Equation>) -> bool {
        let is_small = |factor: &Tree| {
            let of = transposed(factor).unwrap_or(factor);
            letter_of_power(of)
                .is_some_and(|name| name.base.starts_with(|c: char| c.is_ascii_lowercase()) || is_small_greek(name))
        };
        let is_form = |term: &Tree| match term {
            Tree::Product(factors) => {
                let ends = [factors.first(), factors.last()];
                ends.into_iter().flatten().all(is_small) && factors.iter().any(|factor| transposed(factor).is_some())
            }
            _ => false,
        };
        let is_matrix = |term: &Tree| match term {
            Tree::Symbol(name, _) => is_called_identity(name) || is_large_greek(name),
            Tree::Product(factors) => matches!(factors.last(), Some(Tree::Symbol(name, _)) if is_called_identity(name)),
            _ => false,
        };
        !equations.any(|equation| {
            let mut sums = vec![[terms(&equation.left), terms(&equation.right)].concat()];
            for side in [&equation.left, &equation.right] {
                collect_sums(side, &mut sums);
            }
            sums.iter()
                .any(|sum| sum.iter().any(|term| is_form(term)) && sum.iter().any(|term| is_matrix(term)))
        })
    }

    /// Returns true if a letter is the identity.
    pub fn is_identity(&self, name: &Name) -> bool {
        self.identities.contains(name)
    }

    /// Returns true if a letter is marked.
    pub fn has(&self, name: &Name) -> bool {
        self.operators.contains(name) || self.complex.contains(name)
    }

    /// Notes what one node marks.
    fn read(&mut self, node: &Tree) {
        match node {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => {
                if has_accent(name, &ARROWS) {
                    self.operators.insert(name.clone());
                }
                self.complex.extend(conjugated(name));
            }
            node if surely_transposed(node).is_some() => {
                if let Some(of) = surely_transposed(node) {
                    self.mark_operators(of);
                    names_in(of, &mut self.transposed);
                }
            }
            Tree::Product(factors) => {
                // beside w^T stands a vector or a matrix
                let is_transposed = |factor: &Tree| surely_transposed(factor).is_some();
                for (first, last) in factors.iter().zip(factors.iter().skip(1)) {
                    if is_transposed(first) {
                        self.mark_operators(last);
                    }
                    if is_transposed(last) && matches!(first, Tree::Symbol(..)) {
                        self.mark_operators(first);
                    }
                }
                // nobody writes the divisor of numbers in front, `A^{-1} b`
                for (first, _) in factors.iter().zip(factors.iter().skip(1)) {
                    if let Tree::Power(base, -1, _) = first
                        && matches!(&**base, Tree::Symbol(name, _) if name.base.chars().all(|c| c.is_ascii_uppercase()))
                    {
                        self.mark_operators(base);
                        names_in(base, &mut self.transposed);
                    }
                }
                for (at, first) in factors.iter().enumerate() {
                    for (behind, last) in factors.iter().enumerate().skip(at + 2) {
                        let between = factors.get(at + 1..behind).unwrap_or_default();
                        if are_inverse(first, last) && between.iter().all(may_be_matrix) {
                            factors[at..=behind]
                                .iter()
                                .for_each(|factor| self.mark_operators(factor));
                        }
                    }
                }
            }
            Tree::Power(base, -1, _) => {
                // nobody inverts X^T X who has the inverse of X
                let framing = terms(base).into_iter().filter_map(framing);
                self.rectangles
                    .extend(framing.filter(|letter| !self.squares.contains(letter)));
                // (I + G K)^{-1}
                let is_one = |term: &Tree| matches!(term, Tree::Symbol(name, _) if is_called_identity(name));
                if matches!(&**base, Tree::Sum(terms) if terms.iter().any(is_one)) {
                    self.mark_operators(base);
                }
            }
            Tree::Operation(operation, _) => match &**operation {
                Operation::Determinant(of) | Operation::Trace(of) => {
                    self.mark_operators(of);
                }
                Operation::Cross(left, right) => {
                    self.mark_operators(left);
                    self.mark_operators(right);
                }
                _ => {}
            },
            Tree::Invariant {
                kind: Invariant::Trace | Invariant::Determinant,
                of,
                ..
            } => {
                self.operators.insert(of.clone());
            }
            _ => {}
        }
    }

    /// Marks factors that a document says may or may not change places, `A B \neq B A`, the inverse of a product that is one of
    /// inverses, and what takes a vector to a multiple of it, `A x = \lambda x`.
    fn read_order(&mut self, equation: &Equation) {
        let inverted = |tree: &Tree| match tree {
            Tree::Power(base, -1, _) => Some((**base).clone()),
            _ => None,
        };
        for (whole, parts) in [(&equation.left, &equation.right), (&equation.right, &equation.left)] {
            if let (Some(Tree::Product(factors)), Tree::Product(parts)) = (inverted(whole), parts)
                && parts.iter().map(inverted).collect::<Option<Vec<_>>>().is_some()
            {
                factors.iter().for_each(|factor| self.mark_operators(factor));
            }
        }
        // a square that is 0, 1 or the letter itself is that of an operator
        if let Tree::Power(of, 2, _) = &equation.left
            && matches!(&**of, Tree::Symbol(name, _) if is_capital(name))
            && (equation.right == **of
                || matches!(&equation.right, Tree::Number(number) if number.0.is_zero() || number.0.is_one()))
        {
            self.mark_operators(of);
        }
        for pair in reordered(equation) {
            pair.iter().for_each(|factor| self.mark_operators(factor));
        }
        let (Tree::Product(left), Tree::Product(right)) = (&equation.left, &equation.right) else {
            return;
        };
        let is_order = left != right && left.len() == right.len() && left.iter().all(|factor| right.contains(factor));
        if is_order && matches!(equation.relation, Relation::NotEqual | Relation::Equal) {
            left.iter().for_each(|factor| self.mark_operators(factor));
        }
        if let ([matrix @ Tree::Symbol(name, _), vector], [number, other]) = (left.as_slice(), right.as_slice())
            && vector == other
            && name.base.chars().all(|c| c.is_ascii_uppercase())
            && matches!(number, Tree::Symbol(name, _) if name.base == r"\lambda")
        {
            self.mark_operators(matrix);
            self.mark_operators(vector);
        }
    }

    /// Marks the letters of sums, products and powers.
    fn mark_operators(&mut self, tree: &Tree) {
        match tree {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => {
                self.operators.insert(name.clone());
            }
            Tree::Sum(parts) => parts.iter().for_each(|part| self.mark_operators(part)),
            Tree::Product(parts) => {
                // \mu A: a Greek letter in front of a matrix is a number, one behind it a vector
                let is_number = |part: &&Tree| letter_of_power(part).is_some_and(is_small_greek);
                let is_matrix =
                    |part: &Tree| letter_of_power(part).is_none_or(|name| is_capital(name) || is_typographic(name));
                let numbers = parts.iter().take_while(is_number).count();
                let are_numbers = parts.iter().skip(numbers).any(is_matrix);
                let behind = parts.iter().skip(if are_numbers { numbers } else { 0 });
                behind.for_each(|part| self.mark_operators(part));
            }
            Tree::Negate(of) | Tree::Power(of, ..) => self.mark_operators(of),
            _ => {}
        }
    }

    /// Marks the letters that are added or equated to what is marked.
    fn spread(&mut self, equation: &Equation, is_unit: &dyn Fn(&Name) -> bool) {
        let mut sums = vec![vec![&equation.left, &equation.right]];
        for side in [&equation.left, &equation.right] {
            collect_sums(side, &mut sums);
        }
        if let [both, ..] = sums.as_mut_slice() {
            *both = both.iter().flat_map(|side| terms(side)).collect();
        }
        for sum in &sums {
            if sum.iter().any(|term| self.is_operator(term)) {
                let letters = sum.iter().filter_map(|term| letter_alone(term));
                let numbers = &self.numbers;
                self.operators
                    .extend(letters.filter(|name| !numbers.contains(name)).cloned());
            }
        }
        for (side, other) in [(&equation.left, &equation.right), (&equation.right, &equation.left)] {
            if let Tree::Symbol(name, _) | Tree::Call(name, ..) = side
                && holds(other, &|own| self.complex.contains(own) || is_unit(own))
            {
                self.complex.insert(name.clone());
            }
        }
    }

    /// Returns true if the value of a term is a matrix, a vector or an operator.
    fn is_operator(&self, term: &Tree) -> bool {
        match term {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => self.operators.contains(name),
            Tree::Negate(of) | Tree::Power(of, ..) | Tree::Quotient(of, ..) => self.is_operator(of),
            Tree::Sum(parts) => parts.iter().any(|part| self.is_operator(part)),
            // two vectors are multiplied to a number
            Tree::Product(parts) => {
                let is_vector = |part: &&Tree| letter_alone(part).is_some_and(|name| has_accent(name, &ARROWS));
                let vectors = parts.iter().filter(is_vector).count();
                vectors % 2 == 1 || parts.iter().any(|part| !is_vector(&part) && self.is_operator(part))
            }
            tree if transposed(tree).is_some() => true,
            Tree::Operation(operation, _) => match &**operation {
                Operation::Matrix(_) => true,
                Operation::Series { of, .. } => self.is_operator(of),
                _ => false,
            },
            _ => false,
        }
    }

    /// Returns the marked letters that a claim speaks of; `is_free` says that no definition gives a letter.
    pub fn marked(&self, stated: &Stated<'_>, is_free: &dyn Fn(&Name) -> bool) -> Marked {
        let all = || stated.own.iter().chain(&stated.below);
        // sums and means that are symbols speak of what stands in them
        let (mut spoken, mut within) = (BTreeSet::new(), BTreeSet::new());
        for equation in all() {
            for side in [&equation.left, &equation.right] {
                any(side, &mut |node| {
                    if let Tree::Symbol(name, _) | Tree::Call(name, ..) = node {
                        spoken.insert(name.clone());
                        within.extend(letters_in(name));
                    }
                    false
                });
            }
        }
        let all_of = |marked: &BTreeSet<Name>| -> Vec<String> {
            let is_spoken_of = |name: &&Name| spoken.contains(*name) || within.contains(&name.base);
            marked.iter().filter(is_spoken_of).map(ToString::to_string).collect()
        };
        let found = |marked: &BTreeSet<Name>| -> Vec<String> {
            let free: BTreeSet<Name> = marked.iter().filter(|name| is_free(name)).cloned().collect();
            all_of(&free).into_iter().map(|name| format!("`{name}`")).collect()
        };
        let is_real_only = |marked: &BTreeSet<Name>| {
            let is_equation = |equation: &Equation| equation.relation == Relation::Equal;
            let needs_reals = |side: &Tree| any(side, &mut |node| needs_reals(node, marked));
            !stated.own.iter().all(|equation| is_equation(equation))
                || stated.is_restricted
                || all().any(|equation| needs_reals(&equation.left) || needs_reals(&equation.right))
        };
        let operators = found(&self.operators);
        let mut doubts = Vec::new();
        // of one alone identities hold as of numbers, but no roots are taken and nothing is divided out
        let may_depend = operators.len() > 1 || !stated.below.is_empty();
        if !operators.is_empty() && (may_depend || is_real_only(&self.operators)) {
            doubts.push(format!(
                "{}: real numbers, or matrices, vectors or operators, as the document marks them?",
                operators.join(", ")
            ));
        }
        let complex = found(&self.complex);
        // a^4 = 1 has more solutions
        let is_power =
            |node: &Tree| matches!(node, Tree::Power(of, 2.., _) if holds(of, &|name| self.complex.contains(name)));
        let may_have_more =
            !stated.below.is_empty() && all().any(|equation| any_side(equation, &mut |node| is_power(node)));
        if !complex.is_empty() && (may_have_more || is_real_only(&self.complex)) {
            doubts.push(format!(
                "{}: real, or complex, as the document marks them?",
                complex.join(", ")
            ));
        }
        if doubts.is_empty() {
            return Marked::default();
        }
        // a capital letter beside one that need not commute may be a matrix, and any letter behind it a vector, but where it is
        // divided by
        let mut operators = self.operators.clone();
        let speaks_of_operators = |tree: &Tree| {
            any(
                tree,
                &mut |node| matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..) if self.operators.contains(name)),
            )
        };
        // e^{A t} x
        let is_of_e = |factor: &Tree| {
            matches!(factor, Tree::RealPower(of, exponent, _)
                if matches!(&**of, Tree::Symbol(name, _) if name.base == "e") && speaks_of_operators(exponent))
        };
        let is_exponential = |term: &Tree| matches!(term, Tree::Product(factors) if factors.iter().any(is_of_e));
        for equation in all() {
            let sides = [&equation.left, &equation.right];
            if !sides.iter().any(|side| {
                terms(side)
                    .into_iter()
                    .any(|term| self.is_operator(term) || is_exponential(term))
            }) {
                continue;
            }
            for side in sides {
                any(side, &mut |node| {
                    let Tree::Product(factors) = node else { return false };
                    let is_first = |factor: &Tree| {
                        speaks_of_operators(factor)
                            || letter_of_power(factor).is_some_and(|name| is_capital(name) || is_large_greek(name))
                    };
                    let first = factors.iter().position(is_first);
                    for (at, factor) in factors.iter().enumerate() {
                        let may_be = |name: &&Name| {
                            let is_behind = first.is_some_and(|first| at >= first);
                            is_behind && !is_constant(name) && !self.numbers.contains(*name)
                        };
                        operators.extend(letter_of_power(factor).filter(may_be).cloned());
                    }
                    false
                });
            }
        }
        Marked {
            operators: all_of(&operators),
            identities: all_of(&self.identities),
            doubts,
        }
    }
}

/// The small letters that are entries of matrices, where no entry may be a matrix or a vector itself.
fn entries(equations: &[&Equation]) -> BTreeSet<Name> {
    let mut found = BTreeSet::new();
    let mut are_numbers = true;
    for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
        any(side, &mut |node| {
            if let Tree::Operation(operation, _) = node
                && let Operation::Matrix(rows) = &**operation
            {
                let mut names = BTreeSet::new();
                rows.iter().flatten().for_each(|entry| names_in(entry, &mut names));
                let is_block = |entry: &Tree| any(entry, &mut |node| transposed(node).is_some());
                are_numbers &= !rows.iter().flatten().any(is_block)
                    && !names.iter().any(|name| is_capital(name) || is_typographic(name));
                found.append(&mut names);
            }
            !are_numbers
        });
    }
    found.retain(|name| are_numbers && name.base.starts_with(|c: char| c.is_ascii_lowercase()));
    found
}

/// Adds the letters that an equation makes a multiple of one that is a number, `a = \frac{A}{2}`, where nothing says more of them.
fn extend_to_multiples(numbers: &mut BTreeSet<Name>, equations: &[&Equation], is_said: &dyn Fn(&Name) -> bool) {
    let letter = |side: &Tree| match side {
        Tree::Symbol(name, _) => Some(name.clone()),
        Tree::Quotient(above, below, _) if matches!(&**below, Tree::Number(_)) => match &**above {
            Tree::Symbol(name, _) => Some(name.clone()),
            _ => None,
        },
        _ => None,
    };
    let pairs = equations
        .iter()
        .filter_map(|equation| Some((letter(&equation.left)?, letter(&equation.right)?)));
    for (one, other) in pairs {
        if numbers.contains(&one) || numbers.contains(&other) {
            numbers.extend([one, other].into_iter().filter(|name| !is_said(name)));
        }
    }
}

/// The name of what a name with a star or a bar may be the conjugate of.
fn conjugated(name: &Name) -> Option<Name> {
    let mut plain = name.clone();
    if plain.mark == "*" {
        plain.mark.clear();
    } else if plain.accents.last().is_some_and(|accent| accent == r"\overline") {
        plain.accents.pop();
    } else {
        return None;
    }
    Some(plain)
}

/// Returns true if a letter is multiplied by its conjugate.
fn has_conjugates(factors: &[Tree]) -> bool {
    let mut names = factors.iter().filter_map(letter_of_power);
    let is_factor = |plain: Name| factors.iter().filter_map(letter_of_power).any(|name| *name == plain);
    names.any(|name| conjugated(name).is_some_and(is_factor))
}

/// Returns true if what holds of real numbers at this node may not hold of the marked letters in it.
fn needs_reals(node: &Tree, marked: &BTreeSet<Name>) -> bool {
    let of = match node {
        Tree::Call(name, argument, _) if name.base.starts_with('\\') && !ANALYTIC.contains(&name.base.as_str()) => {
            // a letter that is a function is no elementary one
            if texmath::letter(&name.base).is_some() {
                return false;
            }
            argument
        }
        Tree::Root(of, ..) | Tree::RealPower(of, ..) => of,
        Tree::Operation(operation, _) => {
            let part = |(part, _): (&Tree, _)| holds(part, &|name| marked.contains(name));
            return operation.parts().into_iter().any(part);
        }
        _ => return false,
    };
    holds(of, &|name| marked.contains(name))
}

/// Returns true if a letter that passes the test stands in a tree, outside of moduli and real and imaginary parts.
fn holds(tree: &Tree, test: &dyn Fn(&Name) -> bool) -> bool {
    match tree {
        Tree::Call(name, ..) if [r"\Re", r"\Im", r"\arg"].contains(&name.base.as_str()) => false,
        Tree::Symbol(name, _) => test(name),
        Tree::Call(name, ..) if test(name) => true,
        _ => tree.find_below(&mut |part| holds(part, test).then_some(())).is_some(),
    }
}

fn has_accent(name: &Name, accents: &[&str]) -> bool {
    name.accents.iter().any(|accent| accents.contains(&accent.as_str()))
}

/// Returns true for `I` and `\mathbf{I}`, with nothing at it.
fn is_called_identity(name: &Name) -> bool {
    let bases = [
        "I",
        r"\mathbf{I}",
        r"\mathbb{I}",
        r"\mathbb{1}",
        r"\bm{I}",
        r"\boldsymbol{I}",
        r"\mathrm{I}",
    ];
    bases.contains(&name.base.as_str()) && *name == base_alone(name)
}

/// Returns the capital letters of which `X'` or `X^t` is the transpose: it stands beside `X`, or the text speaks of transposes.
fn turned_letters(equations: &[&Equation], says_transposed: bool) -> BTreeSet<String> {
    let turned = |tree: &Tree| match tree {
        Tree::Symbol(name, _) if name.primes == 1 && is_capital(name) => Some(name.base.clone()),
        Tree::RealPower(of, exponent, _) => match (&**of, &**exponent) {
            (Tree::Symbol(name, _), Tree::Symbol(sign, _)) if *sign == Name::plain("t") && is_capital(name) => {
                Some(name.base.clone())
            }
            _ => None,
        },
        _ => None,
    };
    let is_letter = |tree: &Tree, base: &str| matches!(tree, Tree::Symbol(name, _) if name.base == base);
    let mut found = BTreeSet::new();
    for side in equations.iter().flat_map(|equation| [&equation.left, &equation.right]) {
        any(side, &mut |node| {
            found.extend(turned(node).filter(|_| says_transposed));
            if let Tree::Product(factors) = node {
                for (first, last) in factors.iter().zip(factors.iter().skip(1)) {
                    found.extend(turned(first).filter(|base| is_letter(last, base)));
                    found.extend(turned(last).filter(|base| is_letter(first, base)));
                }
            }
            false
        });
    }
    found
}

/// Returns true for a factor without quotients, functions and powers with letters, which are of numbers.
fn may_be_matrix(factor: &Tree) -> bool {
    let is_of_numbers = |node: &Tree| match node {
        Tree::RealPower(..) => transposed(node).is_none(),
        node => matches!(node, Tree::Quotient(..) | Tree::Root(..) | Tree::Call(..)),
    };
    !any(factor, &mut |node| is_of_numbers(node))
}

/// Returns what is transposed, where that is what a tree is: `\beta^T` of a text that speaks of `T` by itself is a power.
fn surely_transposed(tree: &Tree) -> Option<&Tree> {
    let of = transposed(tree)?;
    let is_power = matches!(tree, Tree::RealPower(..)) && matches!(of, Tree::Symbol(name, _) if is_small_greek(name));
    (!is_power).then_some(of)
}

/// Returns the letter that stands with its transpose at the ends of a product: `X^T X`, `H P H^T`.
fn framing(product: &Tree) -> Option<String> {
    let Tree::Product(factors) = product else { return None };
    let (first, last) = (factors.first()?, factors.last()?);
    let plain = match (transposed(first), transposed(last)) {
        (Some(of), None) if of == last => of,
        (None, Some(of)) if of == first => of,
        _ => return None,
    };
    match plain {
        Tree::Symbol(name, _) => Some(name.base.clone()),
        _ => None,
    }
}

/// Returns a letter called as the identity that is multiplied by another capital letter, as nobody multiplies by 1; `I A = A` says
/// that it is 1.
fn multiplied_identity(node: &Tree, equation: &Equation) -> Option<Name> {
    let Tree::Product(factors) = node else { return None };
    let name = factors.iter().find_map(|factor| match factor {
        Tree::Symbol(name, _) if is_called_identity(name) => Some(name),
        _ => None,
    })?;
    let is_other = |factor: &Tree| letter_of_power(factor).is_some_and(|own| is_capital(own) && own != name);
    (factors.iter().any(is_other) && identity_in(equation) != Some(name)).then(|| name.clone())
}

/// Returns the letter that an equation says is 1: `A A^{-1} = I`, `Q^T Q = I`, `A I = A`.
fn identity_in(equation: &Equation) -> Option<&Name> {
    let is_named = is_called_identity;
    let sides = [(&equation.left, &equation.right), (&equation.right, &equation.left)];
    // on the left it is something else that is given a value
    let is_right = |side: &Tree| std::ptr::eq(side, &equation.right);
    sides.into_iter().find_map(|(side, other)| match (side, other) {
        (Tree::Symbol(name, _), Tree::Product(factors)) if is_named(name) && is_right(side) => match factors.as_slice()
        {
            [first, last] if are_inverse(first, last) || are_transposes(first, last) => Some(name),
            _ => None,
        },
        (one, Tree::Product(factors)) => match factors.as_slice() {
            [Tree::Symbol(name, _), last] if is_named(name) && one == last => Some(name),
            [first, Tree::Symbol(name, _)] if is_named(name) && one == first => Some(name),
            _ => None,
        },
        _ => None,
    })
}

/// Returns true if one factor is the transpose of the other.
fn are_transposes(first: &Tree, last: &Tree) -> bool {
    transposed(first) == Some(last) || transposed(last) == Some(first)
}

/// Returns true if one factor is the inverse of the other, to the same power.
fn are_inverse(first: &Tree, last: &Tree) -> bool {
    let split = |tree: &Tree| match tree {
        Tree::Power(of, exponent, _) => ((**of).clone(), *exponent),
        tree => (tree.clone(), 1),
    };
    let ((first, one), (last, other)) = (split(first), split(last));
    first == last && one + other == 0 && !matches!(first, Tree::Number(_))
}

/// The terms of a sum.
fn terms(tree: &Tree) -> Vec<&Tree> {
    match tree {
        Tree::Sum(parts) => parts.iter().flat_map(terms).collect(),
        Tree::Negate(of) => terms(of),
        tree => vec![tree],
    }
}

/// Collects the terms of each sum in a tree.
fn collect_sums<'t>(tree: &'t Tree, sums: &mut Vec<Vec<&'t Tree>>) {
    if let Tree::Sum(_) = tree {
        sums.push(terms(tree));
    }
    tree.find_below(&mut |part| {
        collect_sums(part, sums);
        None::<()>
    });
}

/// The letter that a term is, with a number before it or not.
fn letter_alone(term: &Tree) -> Option<&Name> {
    match term {
        Tree::Symbol(name, _) | Tree::Call(name, ..) if !name.base.starts_with('\\') || is_letter(name) => Some(name),
        Tree::Negate(of) => letter_alone(of),
        Tree::Product(factors) => {
            let mut others = factors.iter().filter(|factor| !matches!(factor, Tree::Number(_)));
            let only = others.next()?;
            others.next().is_none().then(|| letter_alone(only)).flatten()
        }
        _ => None,
    }
}

fn is_letter(name: &Name) -> bool {
    texmath::letter(&name.base).is_some()
}

/// The letters of what stands behind one of these commands, in brackets or alone.
fn arguments(tex: &str, commands: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for command in commands {
        for (at, _) in tex.match_indices(command) {
            let rest = tex.get(at + command.len()..).unwrap_or_default();
            // `\treat` is no trace
            if !command.ends_with('}') && rest.starts_with(|c: char| c.is_ascii_alphabetic()) {
                continue;
            }
            let rest = rest.trim_start_matches([' ', '~']);
            let rest = [r"\,", r"\;", r"\!", r"\ "]
                .iter()
                .fold(rest, |rest, blank| rest.trim_start_matches(blank));
            let rest = rest.trim_start().trim_start_matches(r"\left").trim_start();
            let length = match rest.chars().next() {
                Some('(' | '[' | '{') => bracketed(rest),
                Some('\\') => 1 + rest.chars().skip(1).take_while(char::is_ascii_alphabetic).count(),
                Some(c) => c.len_utf8(),
                None => 0,
            };
            let own = letters(rest.get(..length).unwrap_or_default(), &Names::default());
            found.extend(own.into_iter().map(|(letter, _)| letter.to_owned()));
        }
    }
    found
}

/// The length of what stands in the bracket that opens a text.
fn bracketed(text: &str) -> usize {
    let mut depth = 0_i32;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + c.len_utf8();
        }
    }
    text.len()
}
