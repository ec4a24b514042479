//! Letters of which a document says in which set they lie, `$z \in \mathbb{C}$`, or that it marks by how it prints them.

use super::dependence::varying_within;
use std::collections::BTreeSet;

/// The letters that a text marks as complex, and as matrices, vectors or operators.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Members {
    pub complex: BTreeSet<String>,
    pub operators: BTreeSet<String>,
    /// Those of them that are called matrices.
    pub matrices: BTreeSet<String>,
    /// Those of them with two different lengths, `$X \in \mathbb{R}^{n \times p}$`, which have no inverse.
    pub rectangles: BTreeSet<String>,
    /// Those that are called square or invertible.
    pub squares: BTreeSet<String>,
    /// True if a formula prints `T` elsewhere than as an exponent, as a temperature or a last time.
    pub t_is_letter: bool,
    /// True if the text speaks of vectors, matrices or their transposes.
    pub has_vectors: bool,
    /// True if the text calls `i` the imaginary unit.
    pub says_unit: bool,
    /// True if the text speaks of operators.
    pub speaks_of_operators: bool,
    /// True if the text speaks of `I` by itself, and of no identity.
    pub i_is_other: bool,
    /// The equations within the text, but for those of a letter and a number, each with its letters.
    pub said: Vec<(BTreeSet<String>, String)>,
    /// True if words of the text may say that a product is less than it looks.
    pub says_more: bool,
    /// True if the text calls capital letters matrices or operators.
    pub large_are_matrices: bool,
    /// True if the text calls small letters so.
    pub small_are_matrices: bool,
    /// True if the text may say to which base logarithms are.
    pub says_base: bool,
    /// True if the text speaks of transposes.
    pub says_transposed: bool,
    /// True if the text speaks of complex numbers.
    pub says_complex: bool,
    /// True if the text speaks of the identity.
    pub says_identity: bool,
    /// True if small letters may be other things than columns: some are called matrices, or the text speaks of rows, operators or
    /// quaternions.
    pub has_other_columns: bool,
    /// The letters in clauses that say that something varies, and those that a formula within the text shows to vary.
    pub varying: BTreeSet<String>,
}

/// The most characters before and behind `\in` that letters and their set take.
const FARTHEST: usize = 60;

/// Words that say that something varies.
const OF_VARYING: [&str; 20] = [
    "function of",
    "functions of",
    "depend",
    "vary",
    "varies",
    "varying",
    "field",
    "increas",
    "decreas",
    "chang",
    "grows",
    "rises",
    "falls",
    "oscillat",
    "random",
    "stochastic",
    "smooth",
    "differentiable",
    "solution",
    "process",
];

/// The most equations within the text that may bear on one formula.
const MOST_SAID: usize = 8;

/// Signs and names of formulas of matrices.
const OF_MATRICES: [&str; 14] = [
    r"\otimes",
    r"\oplus",
    r"\succ",
    r"\preceq",
    r"\diag",
    r"\mathrm{diag}",
    r"\operatorname{diag}",
    r"\text{diag}",
    r"\mathrm{vec}",
    r"\operatorname{vec}",
    r"\mathrm{span}",
    r"\operatorname{span}",
    r"_{ij}]",
    r"_{ij})",
];

/// Words for what does not commute, and for complex numbers (true), beside the letters that they are said of.
const WORDS: [(&str, bool); 42] = [
    ("vector", false),
    ("positive definite", false),
    ("semidefinite", false),
    ("nilpotent", false),
    ("matrix", false),
    ("matrices", false),
    ("array", false),
    ("jacobian", false),
    ("hessian", false),
    ("operator", false),
    ("quaternion", false),
    ("octonion", false),
    ("tensor", false),
    ("hermitian", false),
    ("unitary", false),
    ("linear map", false),
    ("endomorphism", false),
    ("homomorphism", false),
    ("projection", false),
    ("rotation", false),
    ("reflection", false),
    ("propagator", false),
    ("differentiation", false),
    ("generators", false),
    ("grassmann", false),
    ("angular momentum", false),
    ("spin component", false),
    ("permutation", false),
    ("commut", false),
    ("elements of", false),
    ("observables", false),
    ("complex", true),
    ("phasor", true),
    ("wave function", true),
    ("of unity", true),
    ("impedance", true),
    ("admittance", true),
    ("frequency response", true),
    ("transfer function", true),
    ("reflection coefficient", true),
    ("fourier coefficient", true),
    ("laplace variable", true),
];

/// Words of texts about vectors and matrices.
const OF_VECTORS: [&str; 9] = [
    "ector",
    "atrix",
    "atrices",
    "ranspose",
    "olumn",
    r"\vec",
    r"\mathbf",
    r"\bm{",
    r"\boldsymbol",
];

/// The most bytes between a letter and the words for the imaginary unit.
const NEAR: usize = 40;

/// Words of texts in which a product of letters may be less than it looks.
const OF_LESS: [&str; 8] = [
    "idempotent",
    "nilpotent",
    "odulo",
    "projector",
    "indicator function",
    "zero or one",
    "binary variable",
    "Boolean",
];

/// Words for matrices and nothing else.
const MATRICES: [&str; 2] = ["matrix", "matrices"];

/// Words of texts about complex numbers, without a first letter that may be a capital.
const OF_COMPLEX_NUMBERS: [&str; 20] = [
    "omplex number",
    "omplex-valued",
    "omplex valued",
    "omplex conjuga",
    "omplex variable",
    "omplex plane",
    "omplex vector",
    "omplex matri",
    "omplex amplitude",
    "omplex scalar",
    "omplex function",
    "omplex exponential",
    "omplex coefficient",
    "omplex field",
    "onjugate transpose",
    "ermitian",
    "nitary",
    "maginary",
    r"\mathbb{C}",
    r"\mathbb C",
];

impl Members {
    /// Collects what a text says of its letters, within formulas and between them.
    pub fn of_text(text: &str) -> Self {
        let mut members = Self::default();
        let lower = text.to_ascii_lowercase();
        for (word, is_complex) in WORDS {
            let marked = match is_complex {
                true => &mut members.complex,
                false => &mut members.operators,
            };
            for (at, _) in lower.match_indices(word) {
                let beside = letters_beside(text, at, at + word.len());
                if MATRICES.contains(&word) {
                    members
                        .matrices
                        .extend(beside.iter().filter(|letter| !is_small(letter)).cloned());
                }
                // `the matrix of the weights $\beta$` says nothing of \beta
                let called = letters_called(text, at, at + word.len(), true);
                marked.extend(
                    beside
                        .into_iter()
                        .filter(|letter| is_complex || !is_small(letter) || called.contains(letter)),
                );
                if MATRICES.contains(&word) {
                    members.matrices.extend(called);
                }
            }
        }
        for word in ["matrices", "operators"] {
            for (at, _) in lower.match_indices(word) {
                let (before, behind) = clause(&lower, at, at + word.len());
                let says = |words: &[&str]| words.iter().any(|word| before.contains(word) || behind.contains(word));
                // bold letters are told by their print
                if !says(&["bold"]) {
                    members.large_are_matrices |= says(&["capitals", "capital letters", "upper-case", "uppercase"]);
                    members.small_are_matrices |= says(&["lower-case", "lowercase", "small letters"]);
                }
            }
        }
        let of_bases = ["decibel", "in bits", " ph ", "$\\mathrm{ph}$", "richter", r"\log_"];
        members.says_base = lower.contains("log") && of_bases.iter().any(|word| lower.contains(word))
            || lower.match_indices("logarithm").any(|(at, word)| {
                let (before, behind) = clause(&lower, at, at + word.len());
                [before, behind]
                    .iter()
                    .any(|part| part.contains("base") || part.contains("binary"))
            })
            || lower.contains(r"\log$ for");
        let inline = inline(text);
        // `$I$`, `$I \in`, `$I(\theta)$`, `$A, I$`
        let speaks_of = |letter: &str| {
            let begins = |part: &str| {
                let behind = part.trim_start().strip_prefix(letter).map(str::trim_start);
                behind.is_some_and(|behind| {
                    behind.is_empty() || behind.starts_with(['(', '=']) || behind.starts_with(r"\in")
                })
            };
            text.contains(&format!(r"\({letter}\)")) || inline.iter().any(|formula| formula.split(',').any(begins))
        };
        let has_identity = text.contains("identity") || text.contains("Identity") || text.contains("unit matrix");
        members.says_identity = has_identity;
        members.i_is_other = !has_identity
            && ["I", r"\mathbf{I}", r"\mathbf I", r"\mathbb{1}", r"\mathbf{1}"]
                .iter()
                .any(|own| speaks_of(own));
        members
            .varying
            .extend(inline.iter().flat_map(|formula| varying_within(formula)));
        members.t_is_letter = text.contains(r"\(T\)") || inline.iter().any(|formula| prints_letter_t(formula));
        // `x = 2` says what x is, and no more
        let is_more = |side: &str| {
            let side = side.trim();
            let is_command = side.starts_with('\\') && side.chars().skip(1).all(|c| c.is_ascii_alphabetic());
            side.len() > 1 && !is_command && !side.starts_with(|c: char| c.is_ascii_digit())
        };
        let says = inline
            .iter()
            .filter(|formula| formula.contains('=') && formula.split('=').any(is_more));
        members.said = says
            .map(|formula| (letters(formula).collect(), formula.clone()))
            .collect();
        members.says_unit = text.match_indices("imaginary unit").any(|(at, words)| {
            let end = at + words.len();
            let front = (at.saturating_sub(NEAR)..at).find_map(|from| text.get(from..at));
            let behind = (end..=end + NEAR).rev().find_map(|to| text.get(end..to));
            let near = [front, behind].map(Option::unwrap_or_default);
            near.iter().any(|near| near.contains("$i$") || near.contains(r"\(i\)"))
        });
        members.speaks_of_operators = text.contains("perator");
        for word in OF_VARYING {
            for (at, _) in lower.match_indices(word) {
                let (before, behind) = clause(text, at, at + word.len());
                let before = before.rsplit('$').skip(1).step_by(2);
                let formulas = before.chain(behind.split('$').skip(1).step_by(2));
                members.varying.extend(formulas.flat_map(letters));
            }
        }
        members.has_vectors = OF_VECTORS.iter().any(|word| text.contains(word));
        let has_determinants = text.contains("eterminant");
        members.says_more = OF_LESS.iter().any(|word| text.contains(word));
        members.says_transposed = text.contains("ranspose");
        members.says_complex = OF_COMPLEX_NUMBERS.iter().any(|words| text.contains(words));
        for formula in &inline {
            // [x, p] = i \hbar, D = \frac{d}{dx}
            let plain: String = formula.chars().filter(|c| !c.is_whitespace()).collect();
            if plain.starts_with('[') && plain.contains("]=") {
                members
                    .operators
                    .extend(letters(plain.split(']').next().unwrap_or_default()));
            }
            if let Some((name, value)) = plain.split_once('=')
                && [
                    r"\frac{d}{",
                    r"\frac{\partial}{",
                    r"\frac{\mathrm{d}}{",
                    "d/d",
                    r"\partial/",
                ]
                .iter()
                .any(|start| value.starts_with(start))
            {
                members.operators.extend(letters(name));
            }
            // the determinant $|A|$
            if has_determinants && plain.starts_with('|') && plain.ends_with('|') {
                members.operators.extend(letters(&plain));
            }
            // z = x + i y, i = \sqrt{-1}
            if let Some((left, right)) = formula.split_once('=')
                && contains_unit(right)
            {
                members.complex.extend(letters(left));
            }
            // \psi: \mathbb{R} \to \mathbb{C}
            if let Some((left, right)) = formula.split_once(':').or_else(|| formula.split_once(r"\colon"))
                && [r"\mathbb{C}", r"\mathbb C"]
                    .iter()
                    .any(|set| right.trim_end().ends_with(set))
            {
                members.complex.extend(letters(left));
            }
        }
        for (at, _) in text.match_indices(r"\in") {
            let behind = text.get(at + 3..).unwrap_or_default();
            // `\int`, `\infty`
            if behind.starts_with(|c: char| c.is_ascii_alphabetic()) {
                continue;
            }
            let set = within(behind, FARTHEST);
            let set = set.split(['$', ',', ';']).next().unwrap_or_default().trim_start();
            let before = text.get(..at).unwrap_or_default();
            let start = before.char_indices().rev().nth(FARTHEST).map_or(0, |(start, _)| start);
            let before = before.get(start..).unwrap_or_default();
            let before = before
                .rsplit(['$', '=', ';', '\n', '{', '[', '('])
                .next()
                .unwrap_or_default();
            let named = |names: &[&str]| names.iter().any(|name| set.starts_with(name));
            let is_complex = named(&[r"\mathbb{C}", r"\mathbb C", r"\mathbf{C}", r"\C", r"\Complex", r"\CC"]);
            let is_real = named(&[r"\mathbb{R}", r"\mathbb R", r"\mathbf{R}", r"\R", r"\Reals", r"\RR"]);
            let is_group = named(&[
                r"\mathbb{H}",
                r"\mathbb H",
                r"\mathbb{O}",
                "M_",
                r"\mathrm{M}",
                r"\mathcal{M}",
                r"\mathrm{GL}",
                "GL",
                r"\mathrm{S",
                "SO",
                "SU",
                "SL",
            ]);
            let has_power = set.split(' ').next().is_some_and(|set| set.contains('^'));
            if is_group || ((is_complex || is_real) && has_power) {
                members.operators.extend(letters(before));
                members.matrices.extend(letters(before));
                if has_two_lengths(set) {
                    members.rectangles.extend(letters(before));
                }
            } else if is_complex {
                members.complex.extend(letters(before));
            }
        }
        for word in ["invertible", "nonsingular", "non-singular", "square"] {
            for (at, _) in text.match_indices(word) {
                members.squares.extend(letters_called(text, at, at + word.len(), false));
            }
        }
        // the $n \times p$ matrix $X$
        for (at, _) in text.match_indices('$') {
            let Some((lengths, _)) = text.get(at + 1..).and_then(|rest| rest.split_once('$')) else {
                continue;
            };
            if let Some((rows, columns)) = lengths.split_once(r"\times").filter(|_| is_shape(lengths)) {
                let beside = letters_beside(text, at, at + lengths.len() + 2);
                members.operators.extend(beside.iter().cloned());
                members.matrices.extend(beside.iter().cloned());
                match rows.trim() == columns.trim() {
                    true => members
                        .squares
                        .extend(letters_called(text, at, at + lengths.len() + 2, false)),
                    false => members.rectangles.extend(beside),
                }
            }
        }
        let others = ["row vector", "rows", "quaternion", "data matrix", "operators"];
        members.has_other_columns =
            others.iter().any(|word| text.contains(word)) || members.matrices.iter().any(|letter| is_small(letter));
        members
    }

    /// Returns the equations within the text that speak of letters of a formula alone, as `$P^2 = P$` of `(1 - P)^2 = 1 - P`.
    pub fn said_of(&self, tex: &str) -> Vec<String> {
        let own: BTreeSet<String> = letters(tex).collect();
        let is_of_own = |(letters, _): &&(BTreeSet<String>, String)| !letters.is_empty() && letters.is_subset(&own);
        let mut said: Vec<String> = Vec::new();
        for (_, formula) in self.said.iter().filter(is_of_own) {
            if said.len() < MOST_SAID && !said.contains(formula) {
                said.push(formula.clone());
            }
        }
        said
    }

    /// Adds what a displayed formula marks by how it is printed.
    pub fn add(&mut self, tex: &str) {
        let is_called = |letter: &String| match is_small(letter) {
            true => self.small_are_matrices,
            false => self.large_are_matrices,
        };
        let called: Vec<String> = letters(tex).filter(is_called).collect();
        self.operators.extend(called);
        let compact: String = tex.chars().filter(|c| !c.is_whitespace()).collect();
        if compact.contains(r"\angle") {
            self.complex.extend(letters(tex));
        }
        let is_capital = |letter: &String| letter.len() == 1 && letter.starts_with(|c: char| c.is_ascii_uppercase());
        if OF_MATRICES.iter().any(|sign| compact.contains(sign)) || has_anticommutator(&compact) {
            self.operators.extend(letters(tex).filter(is_capital));
        }
        for bars in [r"\|", r"\Vert", r"\lVert"] {
            let mut between = tex.split(bars);
            // every second piece stands between two of them, or in front of the closing one
            while let (Some(_), Some(inside)) = (between.next(), between.next()) {
                let inside = inside.split(r"\rVert").next().unwrap_or_default();
                self.operators.extend(letters(inside));
            }
        }
    }
}

/// Returns the letters that TeX prints.
fn letters(tex: &str) -> impl Iterator<Item = String> {
    let printed = texmath::letters(tex, &texmath::Names::default()).into_iter();
    printed.map(|(letter, _)| letter)
}

/// Returns the formulas between single dollars, paragraph by paragraph, where their signs come in pairs.
fn inline(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for paragraph in text.split("\n\n").filter(|paragraph| paragraph.contains('$')) {
        let plain = paragraph.replace(r"\$", " ").replace("$$", " ");
        let pieces: Vec<&str> = plain.split('$').collect();
        if pieces.len() % 2 == 1 {
            found.extend(pieces.into_iter().skip(1).step_by(2).map(str::to_owned));
        }
    }
    found
}

/// Returns the letters that stand alone, `$A$` or `$A, B$`, in the clause around a word of a text, near it.
fn letters_beside(text: &str, start: usize, end: usize) -> Vec<String> {
    let (before, behind) = clause(text, start, end);
    // `$A$ and $B$ are matrices`: every second piece, counted from the word on either side
    let before = before.rsplit('$').skip(1).step_by(2);
    let behind = behind.split('$').skip(1).step_by(2);
    before.chain(behind).flat_map(listed).collect()
}

/// Returns true for a small letter, Greek or not.
fn is_small(letter: &str) -> bool {
    letter
        .trim_start_matches('\\')
        .starts_with(|c: char| c.is_ascii_lowercase())
}

/// Verbs that say what a letter is.
const VERBS: [&str; 9] = [
    "is",
    "are",
    "be",
    "denote",
    "denotes",
    "stand",
    "stands",
    "form",
    "represent",
];

/// Words that begin something else.
const PREPOSITIONS: [&str; 8] = ["at", "for", "from", "in", "of", "on", "to", "with"];

/// Returns the letters that a word of a text, between two places, is said of: `invertible matrices $A$ and $B$`, `$A$ is
/// invertible`, `let $A$ be a square matrix`; one that may be a noun by itself, `quaternions $q$ and $r$`, too. No letter is
/// returned for `$X^\top X$ is invertible` or `least square`.
fn letters_called(text: &str, start: usize, end: usize, may_be_noun: bool) -> Vec<String> {
    let rest = text.get(end..).unwrap_or_default();
    let ending = rest
        .bytes()
        .take_while(|c| may_be_noun && c.is_ascii_alphabetic())
        .count();
    let end = end + ending;
    let (before, behind) = clause(text, start, end);
    let words = |text: &str| -> Vec<String> {
        let words = text.split(|c: char| !c.is_alphabetic() && c != '-');
        words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    let (told, adjectives) = (
        words(before.rsplit('$').next().unwrap_or_default()),
        words(behind.split('$').next().unwrap_or_default()),
    );
    let is_part = before.ends_with(|c: char| c.is_alphanumeric() || c == '-')
        || behind.starts_with(|c: char| c.is_alphanumeric() || c == '-');
    // `symbols $x$, $y$ that do not commute`
    let says_not = !may_be_noun && told.iter().chain(&adjectives).any(|word| word == "not");
    if (is_part && !may_be_noun) || says_not {
        return Vec::new();
    }
    let is_noun = |word: &String| word.starts_with("matri");
    let noun = adjectives.iter().position(is_noun);
    let is_verb = |word: &String| VERBS.contains(&word.as_str());
    let is_said = told.iter().any(is_verb);
    // `quaternions $q$`, `Grassmann variables $u$ and $v$`, `operators are written $b$`
    let is_noun_itself = match adjectives.as_slice() {
        [] => true,
        [.., last] => {
            let is_named = ["by", "as", "written", "called", "denoted"].contains(&last.as_str());
            // `the matrix of the weights $w$`
            let has_another = adjectives.iter().any(|word| PREPOSITIONS.contains(&word.as_str()));
            adjectives.len() < 4 && !has_another && (last.ends_with('s') || is_named)
        }
    };
    // the formulas of a list have nothing but these between them
    let goes_on = |between: &str| ["", ",", "and", ", and"].contains(&between.trim());
    let pieces: Vec<&str> = match noun {
        // `an invertible matrix $A$`
        Some(noun) if noun + 1 == adjectives.len() && behind.contains('$') => behind.split('$').skip(1).collect(),
        _ if is_said && before.contains('$') => before.rsplit('$').skip(1).collect(),
        _ if may_be_noun && is_noun_itself && behind.contains('$') => behind.split('$').skip(1).collect(),
        _ => return Vec::new(),
    };
    let mut found = Vec::new();
    for pair in pieces.chunks(2) {
        let Some(formula) = pair.first() else { break };
        found.extend(listed(formula));
        if !pair.get(1).is_some_and(|between| goes_on(between)) {
            break;
        }
    }
    found
}

/// Returns what stands before and behind a word of a text in its clause, near it.
fn clause(text: &str, start: usize, end: usize) -> (&str, &str) {
    let before = text.get(..start).unwrap_or_default();
    let near = before.char_indices().rev().nth(FARTHEST).map_or(0, |(near, _)| near);
    let ends = [". ", ".\n", ";", "\n\n", r"\]", r"\end{", "$$"];
    let last_end = |text: &str| {
        ends.iter()
            .filter_map(|end| text.rfind(end).map(|at| at + end.len()))
            .max()
    };
    let first_end = |text: &str| ends.iter().filter_map(|end| text.find(end)).min();
    let before = before.get(near..).unwrap_or_default();
    let before = before.get(last_end(before).unwrap_or_default()..).unwrap_or_default();
    let behind = within(text.get(end..).unwrap_or_default(), FARTHEST);
    let behind = behind
        .get(..first_end(behind).unwrap_or(behind.len()))
        .unwrap_or_default();
    (before, behind)
}

/// Returns the letters of a list of letters, `A, B`, `R_x` as R; none of any other formula.
fn listed(formula: &str) -> Vec<String> {
    let root = |part: &str| -> Vec<String> { letters(part.split('_').next().unwrap_or_default()).collect() };
    let is_letter = |part: &str| root(part).len() == 1 && !part.contains(['=', '^', '(', '+', '<', '>']);
    match formula.split(',').all(is_letter) {
        true => formula.split(',').flat_map(root).collect(),
        false => Vec::new(),
    }
}

/// Returns true for `n \times p`, `3\times2`: two letters or numbers.
fn is_shape(lengths: &str) -> bool {
    let is_length = |side: &str| {
        let side = side.trim();
        let is_number = side.chars().all(|c| c.is_ascii_digit());
        !side.is_empty() && (is_number || side.chars().count() == 1)
    };
    lengths
        .split_once(r"\times")
        .is_some_and(|(rows, columns)| is_length(rows) && is_length(columns))
}

/// Returns true for `\mathbb{R}^{n \times p}`, and not for `\mathbb{R}^{n \times n}`.
fn has_two_lengths(set: &str) -> bool {
    let lengths = set.split_once("^{").and_then(|(_, lengths)| lengths.split_once('}'));
    lengths
        .and_then(|(lengths, _)| lengths.split_once(r"\times"))
        .is_some_and(|(rows, columns)| rows.trim() != columns.trim())
}

/// Returns true if a formula prints `T` elsewhere than as an exponent alone.
pub(super) fn prints_letter_t(tex: &str) -> bool {
    let signs = ["^{-T}", "^{T}", "^T", "^ T"];
    let rest = signs.iter().fold(tex.to_owned(), |rest, sign| rest.replace(sign, ""));
    letters(&rest).any(|letter| letter == "T")
}

/// Returns the first characters of a text.
fn within(text: &str, most: usize) -> &str {
    let end = text.char_indices().nth(most).map_or(text.len(), |(end, _)| end);
    text.get(..end).unwrap_or_default()
}

/// Returns true for `\{A,B\}` of two capital letters.
fn has_anticommutator(compact: &str) -> bool {
    compact.match_indices(r"\{").any(|(at, _)| {
        let inside = compact.get(at + 2..).unwrap_or_default();
        let mut inside = inside.chars();
        let is_capital = |c: Option<char>| c.is_some_and(|c| c.is_ascii_uppercase());
        is_capital(inside.next())
            && inside.next() == Some(',')
            && is_capital(inside.next())
            && inside.next() == Some('\\')
    })
}

/// Returns true if a formula prints `i` as a factor, and numbers nothing by it.
pub(super) fn contains_unit(tex: &str) -> bool {
    let is_index = tex.match_indices('_').any(|(at, _)| {
        let behind = tex.get(at + 1..).unwrap_or_default().trim_start();
        let subscript = match behind.strip_prefix('{') {
            Some(inside) => inside.split('}').next().unwrap_or_default(),
            None => within(behind, 1),
        };
        letters(subscript).any(|letter| letter == "i")
    });
    !is_index && letters(tex).any(|letter| letter == "i")
}

/// Returns true if formulas use `j` as the imaginary unit: its square is -1, it stands in an exponent of e or before a
/// frequency; where it numbers something it is none.
pub(super) fn j_is_unit<'t>(formulas: impl Iterator<Item = &'t str>) -> bool {
    let mut is_unit = false;
    for tex in formulas {
        let compact: String = tex.chars().filter(|c| !c.is_whitespace()).collect();
        let compact = compact.replace(r"\mathrm{j}", "j").replace(r"\,", "");
        if ["_j", "_{j", r"\sum_{j", r"\sum_j", "ij}", "jk}", "j="]
            .iter()
            .any(|index| compact.contains(index))
        {
            return false;
        }
        is_unit |= [
            "j^2=-1",
            "j^{2}=-1",
            r"j=\sqrt{-1}",
            "e^{j",
            "e^{-j",
            r"\exp(j",
            r"\exp(-j",
            r"j\omega",
        ]
        .iter()
        .any(|sign| compact.contains(sign));
    }
    is_unit
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(text: &str) -> [String; 2] {
        let members = Members::of_text(text);
        [members.complex, members.operators].map(|letters| letters.into_iter().collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn sets_mark_their_members() {
        assert_eq!(
            marked(r"with $z, w \in \mathbb{C}$ and $x \in \mathbb{R}$"),
            ["w z", ""]
        );
        assert_eq!(marked(r"$A, B \in \mathbb{R}^{n \times n}$"), ["", "A B"]);
        assert_eq!(marked(r"\[ \int_0^1 x \, dx \] for $n \in \mathbb{N}$"), ["", ""]);
        assert_eq!(marked(r"\[ y \in \mathbb C \]"), ["y", ""]);
    }

    #[test]
    fn what_has_two_lengths_has_no_inverse() {
        let members = Members::of_text(r"$X, Y \in \mathbb{R}^{n \times p}$ and $A \in \mathbb{R}^{n\times n}$");
        assert_eq!(members.rectangles.into_iter().collect::<Vec<_>>(), ["X", "Y"]);
    }

    #[test]
    fn t_is_a_letter_where_it_stands_elsewhere_too() {
        for tex in [
            r"S = A^T B^{T}",
            "A^{-T}",
            r"\Theta",
            r"\text{Total}",
            r"x_{\mathrm{Tot}}",
        ] {
            assert!(!prints_letter_t(tex), "{tex}");
        }
        for tex in [r"x_T = A^T x_0", r"x_{T}", r"t \le T"] {
            assert!(prints_letter_t(tex), "{tex}");
        }
    }

    #[test]
    fn words_mark_the_letters_beside_them() {
        assert_eq!(marked("Let $A$ and $B$ be matrices. Then $x$ is"), ["", "A B"]);
        assert_eq!(marked("of the matrices $P, Q$; here $x + y$ is small"), ["", "P Q"]);
        assert_eq!(
            marked("where $z_1$ and $w$ are complex numbers with $|z| = 1$"),
            ["w z", ""]
        );
        assert_eq!(marked("Let $z$ be complex. Here $y$ is real"), ["z", ""]);
        assert_eq!(marked("two non-commuting variables $u$ and $v$"), ["", "u v"]);
        assert_eq!(
            marked(r"with $z = x + i y$ and $\psi\colon \mathbb{R}\to\mathbb{C}$"),
            [r"\psi z", ""]
        );
        assert_eq!(marked("the $3\\times 3$ inertia tensor $J$"), ["", "J"]);
        assert_eq!(marked("$x$ is a number. The matrix has rank two. $y$ is not"), ["", ""]);
    }

    #[test]
    fn square_and_invertible_are_said_of_the_letters_they_belong_to() {
        let squares = |text: &str| Members::of_text(text).squares.into_iter().collect::<Vec<_>>().join(" ");
        for (text, expected) in [
            ("Let $A$ be a square matrix.", "A"),
            ("the invertible matrices $A$, $B$ and $C$ of $x$", "A B C"),
            ("If $P$ and $Q$ are invertible, then", "P Q"),
            ("the $n \\times n$ matrix $A$ and the data $X$", "A"),
            ("Let $M$ be $2 \\times 2$ matrix of the data $X$", "M"),
            ("The least squares solution for the data $X$, $y$", ""),
            ("where $X$ is the data and $X^\\top X$ is invertible", ""),
            ("$X$ need not be square; $Y$ is not invertible", ""),
            ("the least square error of $X$", ""),
        ] {
            assert_eq!(squares(text), expected, "{text}");
        }
    }

    #[test]
    fn a_unit_numbers_nothing() {
        assert!(contains_unit(r"i \hbar \dot\psi = H \psi"));
        assert!(!contains_unit(r"x_i = i a") && !contains_unit(r"\sum_{i=1}^n i") && !contains_unit(r"\sin x"));
    }

    #[test]
    fn a_unit_is_no_number_of_anything() {
        assert!(j_is_unit([r"s = \sigma + j \omega"].into_iter()));
        assert!(j_is_unit([r"y = c e^{\mathrm{j}\phi}"].into_iter()));
        assert!(!j_is_unit([r"e^{j x} = a_j"].into_iter()));
        assert!(!j_is_unit([r"a = b j"].into_iter()));
    }
}
