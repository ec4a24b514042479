//! The TeX commands and characters that are known, and what each does to the reading.

use super::elementary::Elementary;
use super::token::{Bracket, Kind};
use super::{Invariant, Relation, Series};

/// Which end of a pair of brackets.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Opening,
    Closing,
}

/// What a command does.
pub(super) enum Command {
    /// It is a token under its own text.
    Token(Kind),
    /// It is a token under another, canonical text.
    Spelled(Kind, &'static str),
    Row,
    Skip,
    /// It is dropped together with the braces after it.
    SkipGroup,
    /// `\therefore`.
    Therefore,
    /// `\boxed`.
    Box,
    /// `\underbrace`, `\overbrace`, with the sign before what stands at the brace.
    Brace(char),
    /// It is a blank of this width, in eighteenths of a quad.
    Blank(u32),
    /// It is a wide blank, with its width in the braces after it, or what would fill it.
    Space,
    /// A bracket must follow; a bar after it opens or closes.
    Sized(Side),
    /// It is dropped; a bar after it opens or closes.
    Side(Side),
    /// A set of numbers follows.
    Blackboard,
    Font,
    /// A font whose letters are often other symbols than those in italics.
    Bold,
    /// It is a blank as wide as the dimension behind it.
    Glue,
    /// What is in the braces after it is spaced as a relation or operator.
    Class,
    Text,
    Begin,
    End,
    /// With what to say beyond "cannot read".
    Unknown(&'static str),
}

/// Commands that print one letter.
const LETTERS: &[&str] = &[
    "\\alpha",
    "\\beta",
    "\\gamma",
    "\\delta",
    "\\epsilon",
    "\\zeta",
    "\\eta",
    "\\theta",
    "\\vartheta",
    "\\iota",
    "\\kappa",
    "\\lambda",
    "\\mu",
    "\\nu",
    "\\xi",
    "\\pi",
    "\\varpi",
    "\\rho",
    "\\varrho",
    "\\sigma",
    "\\varsigma",
    "\\tau",
    "\\upsilon",
    "\\phi",
    "\\chi",
    "\\psi",
    "\\omega",
    "\\Gamma",
    "\\Delta",
    "\\Theta",
    "\\Lambda",
    "\\Xi",
    "\\Pi",
    "\\Sigma",
    "\\Upsilon",
    "\\Phi",
    "\\Psi",
    "\\Omega",
    "\\ell",
    "\\hbar",
    "\\imath",
    "\\jmath",
    "\\top",
    "\\dagger",
];

/// Commands of LaTeX and amsmath that are no terms and are not read: relations, arrows, dots, operators between terms and with their
/// terms, brackets, words and references.
const NO_TERMS: &str = "
    sim simeq cong propto varpropto asymp doteq doteqdot prec succ preceq succeq ll gg lesssim gtrsim lessgtr gtrless
    subset subseteq subsetneq supset supseteq ni notin perp parallel vdash models bowtie triangleq eqqcolon coloneq
    eqdef defeq overset underset stackrel not approxeq leadsto vartriangleleft trianglelefteq ngeq nleq nless ngtr
    colon
    Rightarrow Leftarrow Leftrightarrow Longrightarrow Longleftarrow Longleftrightarrow longrightarrow longleftarrow
    leftarrow leftrightarrow longleftrightarrow implies impliedby iff mapsto longmapsto xrightarrow xleftarrow
    xlongequal hookrightarrow rightharpoonup uparrow downarrow nearrow searrow rightsquigarrow gets rightleftharpoons
    because
    dots ldots cdots vdots ddots dotsc dotsb dotsm dotsi hdots adots
    oplus ominus otimes odot wedge vee land lor lnot neg cap cup setminus bigcap bigcup bigoplus bigotimes bigwedge
    bigvee star bullet amalg uplus sqcup sqcap ltimes rtimes coprod bmod pmod mod forall exists nexists backslash
    sup inf max min argmax argmin limsup liminf iint iiint oint idotsint nabla Pr
    langle rangle ulcorner urcorner lgroup rgroup middle over atop choose above hline
    multicolumn limits substack sideset prescript intertext shortintertext
    emph textsc textsf texttt textnormal footnote footnotemark ref eqref cref Cref autoref cite citep citet href url
    item par noindent bf rm it sf tt cal index hspace vspace raisebox fbox mathchoice mathpalette newcommand
    renewcommand def let
";

/// Returns true for a command that is not known, `\qdot` of a macro that is not at hand.
fn is_unknown(text: &str) -> bool {
    let name = text.strip_prefix('\\').unwrap_or_default();
    !name.is_empty()
        && name.bytes().all(|byte| byte.is_ascii_alphabetic())
        && matches!(command(text), Command::Unknown(""))
        && ![FACTORIAL, DOUBLE_FACTORIAL, CONJUGATE, FLOOR].contains(&text)
        && !NO_TERMS.split_whitespace().any(|known| known == name)
}

/// Returns true for a command that is not read, known or not.
pub(super) fn is_unread(text: &str) -> bool {
    text.starts_with('\\') && matches!(command(text), Command::Unknown(_))
}

/// Returns true if a command that is not known stands in a text.
pub fn holds_unknown(text: &str) -> bool {
    text.match_indices('\\').any(|(at, _)| {
        let rest = text.get(at + 1..).unwrap_or_default();
        let length = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        text.get(at..=at + length).is_some_and(is_unknown)
    })
}

/// Returns true for the command of a letter, `\alpha`.
pub(super) fn is_letter(command: &str) -> bool {
    LETTERS.contains(&command)
}

/// The name of the absolute value as a function.
pub(super) const ABSOLUTE: &str = "\\abs";

/// The names of the factorials as functions.
pub(super) const FACTORIAL: &str = "\\factorial";
pub(super) const DOUBLE_FACTORIAL: &str = "\\doublefactorial";

/// The name of the largest integer up to a number as a function.
pub(super) const FLOOR: &str = "\\floor";

/// The name of the conjugate as a function: a line over its argument.
pub(super) const CONJUGATE: &str = "\\conjugate";

const SKIPPED: &[&str] = &[
    "\\!",
    "\\/",
    "\\[",
    "\\]",
    "\\(",
    "\\)",
    "\\displaystyle",
    "\\textstyle",
    "\\scriptstyle",
    "\\nonumber",
    "\\notag",
    "\\limits",
    "\\nolimits",
    "\\big",
    "\\Big",
    "\\bigg",
    "\\Bigg",
    "\\mathstrut",
    "\\strut",
];

/// The width of the blank between two words, in eighteenths of a quad.
pub(super) const WORD_SPACE: u32 = 6;

/// The invariant that `word` names, as `Tr` or `det`.
pub(super) fn invariant(word: &str) -> Option<Invariant> {
    match word {
        "Tr" | "tr" => Some(Invariant::Trace),
        "Det" | "det" => Some(Invariant::Determinant),
        _ => None,
    }
}

/// What the command `text`, backslash and all, does.
pub(super) fn command(text: &str) -> Command {
    if SKIPPED.contains(&text) {
        return Command::Skip;
    }
    if LETTERS.contains(&text) {
        return Command::Token(Kind::Letter);
    }
    if let Some(function) = Elementary::by_word(text).filter(|_| text.starts_with('\\')) {
        return Command::Spelled(Kind::Function, function.command);
    }
    structure(text)
        .or_else(|| sign(text))
        .unwrap_or_else(|| Command::Unknown(hint(text)))
}

fn structure(text: &str) -> Option<Command> {
    Some(match text {
        "\\\\" | "\\cr" | "\\newline" => Command::Row,
        "\\quad" | "\\qquad" | "\\enspace" | "\\hfill" | "\\hfil" => Command::Token(Kind::Quad),
        "\\hskip" | "\\mskip" | "\\kern" | "\\mkern" => Command::Glue,
        "\\mathrel" | "\\mathbin" | "\\mathord" => Command::Class,
        "\\," | "\\thinspace" => Command::Blank(3),
        "\\:" | "\\>" => Command::Blank(4),
        "\\;" => Command::Blank(5),
        "\\ " | "\\\n" | "\\\t" | "\\\r" => Command::Blank(WORD_SPACE),
        "\\hspace" | "\\phantom" | "\\hphantom" => Command::Space,
        "\\label" | "\\tag" | "\\vphantom" => Command::SkipGroup,
        "\\therefore" => Command::Therefore,
        "\\boxed" => Command::Box,
        "\\underbrace" => Command::Brace('_'),
        "\\overbrace" => Command::Brace('^'),
        "\\left" => Command::Sized(Side::Opening),
        "\\right" => Command::Sized(Side::Closing),
        "\\bigl" | "\\Bigl" | "\\biggl" | "\\Biggl" => Command::Side(Side::Opening),
        "\\bigr" | "\\Bigr" | "\\biggr" | "\\Biggr" => Command::Side(Side::Closing),
        "\\mathbb" => Command::Blackboard,
        "\\mathrm" | "\\mathit" | "\\mathnormal" | "\\rm" | "\\it" => Command::Font,
        "\\mathbf" | "\\mathsf" | "\\boldsymbol" | "\\bm" => Command::Bold,
        "\\text" | "\\textrm" | "\\textit" | "\\textbf" | "\\mbox" | "\\operatorname" => Command::Text,
        "\\begin" => Command::Begin,
        "\\end" => Command::End,
        "\\frac" | "\\dfrac" | "\\tfrac" | "\\cfrac" => Command::Token(Kind::Fraction),
        "\\sqrt" => Command::Token(Kind::Root),
        "\\partial" => Command::Token(Kind::Partial),
        "\\sum" => Command::Token(Kind::Series(Series::Sum)),
        "\\prod" => Command::Token(Kind::Series(Series::Product)),
        "\\int" => Command::Token(Kind::Integral),
        "\\lim" => Command::Token(Kind::Limit),
        "\\dot" | "\\ddot" | "\\dddot" | "\\ddddot" | "\\hat" | "\\tilde" | "\\vec" | "\\overline" | "\\check"
        | "\\breve" | "\\acute" | "\\grave" | "\\mathring" => Command::Token(Kind::Accent),
        // a letter in such a font is a symbol of its own
        "\\mathcal" | "\\mathscr" | "\\mathfrak" => Command::Token(Kind::Accent),
        "\\bar" => Command::Spelled(Kind::Accent, "\\overline"),
        "\\widehat" => Command::Spelled(Kind::Accent, "\\hat"),
        "\\widetilde" => Command::Spelled(Kind::Accent, "\\tilde"),
        "\\varepsilon" => Command::Spelled(Kind::Letter, "\\epsilon"),
        "\\varphi" => Command::Spelled(Kind::Letter, "\\phi"),
        // of packages and macros that are often not at hand
        "\\T" | "\\Tsp" | "\\tran" | "\\trans" | "\\transp" | "\\transpose" | "\\intercal" => {
            Command::Spelled(Kind::Letter, "\\top")
        }
        "\\dag" => Command::Spelled(Kind::Letter, "\\dagger"),
        "\\det" | "\\Det" => Command::Token(Kind::Invariant(Invariant::Determinant)),
        "\\Tr" | "\\tr" => Command::Token(Kind::Invariant(Invariant::Trace)),
        _ => return None,
    })
}

fn sign(text: &str) -> Option<Command> {
    Some(Command::Token(match text {
        "\\prime" => Kind::Prime,
        "\\cdot" | "\\times" => Kind::Times,
        "\\ast" => Kind::Star,
        "\\div" => Kind::Slash,
        "\\pm" => Kind::PlusMinus,
        "\\mp" => Kind::MinusPlus,
        "\\equiv" | "\\coloneqq" => Kind::Relation(Relation::Equal),
        "\\ne" | "\\neq" => Kind::Relation(Relation::NotEqual),
        "\\lt" => Kind::Relation(Relation::Less),
        "\\gt" => Kind::Relation(Relation::Greater),
        "\\le" | "\\leq" | "\\leqslant" | "\\leqq" => Kind::Relation(Relation::LessOrEqual),
        "\\ge" | "\\geq" | "\\geqslant" | "\\geqq" => Kind::Relation(Relation::GreaterOrEqual),
        "\\approx" => Kind::Approximately,
        "\\to" | "\\rightarrow" => Kind::To(None),
        "\\downarrow" | "\\searrow" => Kind::To(Some(true)),
        "\\uparrow" | "\\nearrow" => Kind::To(Some(false)),
        "\\in" => Kind::Element,
        "\\forall" => Kind::Said,
        "\\infty" => Kind::Infinity,
        "\\circ" | "\\degree" | "\\textdegree" => Kind::Degree,
        "\\max" | "\\min" => Kind::Extremum,
        "\\binom" | "\\dbinom" | "\\tbinom" => Kind::Binomial,
        "\\vert" | "\\mid" => Kind::Bar,
        "\\lvert" => Kind::Open(Bracket::Bar),
        "\\rvert" => Kind::Close(Bracket::Bar),
        "\\|" | "\\Vert" => Kind::DoubleBar,
        "\\lVert" => Kind::Open(Bracket::DoubleBar),
        "\\rVert" => Kind::Close(Bracket::DoubleBar),
        "\\{" | "\\lbrace" => Kind::Open(Bracket::Curly),
        "\\}" | "\\rbrace" => Kind::Close(Bracket::Curly),
        "\\lfloor" => Kind::Open(Bracket::Floor),
        "\\rfloor" => Kind::Close(Bracket::Floor),
        "\\lceil" => Kind::Open(Bracket::Ceiling),
        "\\rceil" => Kind::Close(Bracket::Ceiling),
        "\\lbrack" => Kind::Open(Bracket::Square),
        "\\rbrack" => Kind::Close(Bracket::Square),
        _ => return None,
    }))
}

/// The token that a single character makes.
pub(super) fn character(c: char) -> Option<Kind> {
    Some(match c {
        '+' => Kind::Plus,
        '-' | '−' => Kind::Minus,
        '*' => Kind::Star,
        '/' => Kind::Slash,
        '=' => Kind::Relation(Relation::Equal),
        '≠' => Kind::Relation(Relation::NotEqual),
        '<' => Kind::Relation(Relation::Less),
        '>' => Kind::Relation(Relation::Greater),
        '≤' | '⩽' => Kind::Relation(Relation::LessOrEqual),
        '≥' | '⩾' => Kind::Relation(Relation::GreaterOrEqual),
        '|' => Kind::Bar,
        ',' | ';' => Kind::Comma,
        '.' => Kind::Stop,
        '(' => Kind::Open(Bracket::Round),
        ')' => Kind::Close(Bracket::Round),
        '[' => Kind::Open(Bracket::Square),
        ']' => Kind::Close(Bracket::Square),
        '{' => Kind::BraceOpen,
        '}' => Kind::BraceClose,
        '_' => Kind::Sub,
        '^' => Kind::Sup,
        '\'' | '’' | '′' => Kind::Prime,
        '!' => Kind::Factorial,
        '°' => Kind::Degree,
        '·' | '⋅' | '×' => Kind::Times,
        '÷' => Kind::Slash,
        '±' => Kind::PlusMinus,
        '∓' => Kind::MinusPlus,
        '∂' => Kind::Partial,
        '∈' => Kind::Element,
        '∞' => Kind::Infinity,
        _ => return None,
    })
}

/// What a letter outside ASCII, or a raised digit, is written as: the tokens it makes.
pub(super) fn spelled(c: char) -> Option<&'static [(Kind, &'static str)]> {
    let tokens: &[(Kind, &str)] = match c {
        '²' => &[(Kind::Sup, "^"), (Kind::Number, "2")],
        '³' => &[(Kind::Sup, "^"), (Kind::Number, "3")],
        'α' => &[(Kind::Letter, "\\alpha")],
        'β' => &[(Kind::Letter, "\\beta")],
        'γ' => &[(Kind::Letter, "\\gamma")],
        'δ' => &[(Kind::Letter, "\\delta")],
        'ε' | 'ϵ' => &[(Kind::Letter, "\\epsilon")],
        'ζ' => &[(Kind::Letter, "\\zeta")],
        'η' => &[(Kind::Letter, "\\eta")],
        'θ' => &[(Kind::Letter, "\\theta")],
        'ϑ' => &[(Kind::Letter, "\\vartheta")],
        'ι' => &[(Kind::Letter, "\\iota")],
        'κ' => &[(Kind::Letter, "\\kappa")],
        'λ' => &[(Kind::Letter, "\\lambda")],
        'μ' | 'µ' => &[(Kind::Letter, "\\mu")],
        'ν' => &[(Kind::Letter, "\\nu")],
        'ξ' => &[(Kind::Letter, "\\xi")],
        'π' => &[(Kind::Letter, "\\pi")],
        'ρ' => &[(Kind::Letter, "\\rho")],
        'ϱ' => &[(Kind::Letter, "\\varrho")],
        'σ' => &[(Kind::Letter, "\\sigma")],
        'ς' => &[(Kind::Letter, "\\varsigma")],
        'τ' => &[(Kind::Letter, "\\tau")],
        'υ' => &[(Kind::Letter, "\\upsilon")],
        'φ' | 'ϕ' => &[(Kind::Letter, "\\phi")],
        'χ' => &[(Kind::Letter, "\\chi")],
        'ψ' => &[(Kind::Letter, "\\psi")],
        'ω' => &[(Kind::Letter, "\\omega")],
        'Γ' => &[(Kind::Letter, "\\Gamma")],
        'Δ' => &[(Kind::Letter, "\\Delta")],
        'Θ' => &[(Kind::Letter, "\\Theta")],
        'Λ' => &[(Kind::Letter, "\\Lambda")],
        'Ξ' => &[(Kind::Letter, "\\Xi")],
        'Π' => &[(Kind::Letter, "\\Pi")],
        'Σ' => &[(Kind::Letter, "\\Sigma")],
        'Φ' => &[(Kind::Letter, "\\Phi")],
        'Ψ' => &[(Kind::Letter, "\\Psi")],
        'Ω' => &[(Kind::Letter, "\\Omega")],
        'ℓ' => &[(Kind::Letter, "\\ell")],
        'ħ' => &[(Kind::Letter, "\\hbar")],
        _ => return None,
    };
    Some(tokens)
}

/// The shape of a letter that has two, which are read as one: its command.
pub(super) fn shape(letter: &str) -> Option<&'static str> {
    match letter {
        "\\varphi" | "φ" => Some("\\varphi"),
        "\\varepsilon" | "ε" => Some("\\varepsilon"),
        _ => None,
    }
}

/// The TeX with its letters outside ASCII written as commands.
pub fn with_commands(tex: &str) -> String {
    let letter = |c: char| match spelled(c) {
        Some([(Kind::Letter, text)]) => (*text).to_string(),
        _ => c.to_string(),
    };
    tex.chars().map(letter).collect()
}

/// What to say of a character that is not read, beyond "cannot read".
pub(super) fn character_hint(c: char) -> &'static str {
    match c {
        _ if c.is_alphabetic() => ": letters outside ASCII are written as TeX commands",
        _ => "",
    }
}

fn hint(text: &str) -> &'static str {
    match text {
        "\\over" => ": write \\frac{..}{..}",
        "\\bf" => ": write \\mathbf{..}",
        "\\bigg/" | "\\middle" => ": write / alone",
        "\\sim" | "\\simeq" | "\\cong" | "\\propto" | "\\ll" | "\\gg" => {
            ": it has no exact meaning; write =, \\neq, <, >, \\leq or \\geq"
        }
        "\\mapsto" | "\\longmapsto" | "\\longrightarrow" => ": write what is claimed as an equation or inequality",
        "\\not" => ": write \\neq",
        "\\Rightarrow" | "\\implies" | "\\Leftrightarrow" | "\\iff" => {
            ": one implication is read in a claim; give each an entry of its own"
        }
        "\\notin" | "\\subset" | "\\subseteq" => ": only \\in is read, and only in a condition",
        _ => "",
    }
}
