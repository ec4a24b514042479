//! The TeX commands that are known, and what each does to the reading.

use super::Invariant;
use super::token::{Bracket, Kind};

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
    /// It is a wide blank, with its width in the braces after it.
    Space,
    /// A bracket must follow.
    Sized,
    Font,
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
];

/// The name of the absolute value as a function.
pub(super) const ABSOLUTE: &str = "\\abs";

/// Functions that are known without a declaration, longest first where one starts another.
const FUNCTIONS: &[&str] = &[
    "\\arccos", "\\arcsin", "\\arctan", "\\sinh", "\\cosh", "\\tanh", "\\sin", "\\cos", "\\tan", "\\exp", "\\log",
    "\\ln",
];

const SKIPPED: &[&str] = &[
    "\\,",
    "\\;",
    "\\:",
    "\\!",
    "\\ ",
    "\\\n",
    "\\\t",
    "\\\r",
    "\\>",
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
    "\\bigl",
    "\\bigr",
    "\\Bigl",
    "\\Bigr",
    "\\biggl",
    "\\biggr",
    "\\Biggl",
    "\\Biggr",
    "\\big",
    "\\Big",
    "\\bigg",
    "\\Bigg",
    "\\thinspace",
    "\\mathstrut",
    "\\strut",
];

/// The command of the elementary function `word`, as `cos` or `\cos`.
pub(super) fn elementary(word: &str) -> Option<&'static str> {
    let word = word.strip_prefix('\\').unwrap_or(word);
    let known = |command: &&&str| command.strip_prefix('\\') == Some(word);
    FUNCTIONS.iter().find(known).copied()
}

/// The elementary function that a run of letters starts with.
pub(super) fn elementary_at_start(run: &str) -> Option<&'static str> {
    let starts = |command: &&&str| command.strip_prefix('\\').is_some_and(|name| run.starts_with(name));
    FUNCTIONS.iter().find(starts).copied()
}

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
    if let Some(function) = elementary(text).filter(|_| text.starts_with('\\')) {
        return Command::Spelled(Kind::Function, function);
    }
    structure(text)
        .or_else(|| sign(text))
        .unwrap_or_else(|| Command::Unknown(hint(text)))
}

fn structure(text: &str) -> Option<Command> {
    Some(match text {
        "\\\\" | "\\cr" | "\\newline" => Command::Row,
        "\\quad" | "\\qquad" | "\\enspace" => Command::Token(Kind::Quad),
        "\\hspace" => Command::Space,
        "\\label" | "\\tag" | "\\phantom" | "\\hphantom" | "\\vphantom" => Command::SkipGroup,
        "\\left" | "\\right" => Command::Sized,
        "\\mathrm" | "\\mathbf" | "\\mathit" | "\\mathsf" | "\\mathnormal" | "\\boldsymbol" | "\\bm" | "\\rm"
        | "\\bf" | "\\it" => Command::Font,
        "\\text" | "\\textrm" | "\\textit" | "\\textbf" | "\\mbox" | "\\operatorname" => Command::Text,
        "\\begin" => Command::Begin,
        "\\end" => Command::End,
        "\\frac" | "\\dfrac" | "\\tfrac" | "\\cfrac" => Command::Token(Kind::Fraction),
        "\\sqrt" => Command::Token(Kind::Root),
        "\\partial" => Command::Token(Kind::Partial),
        "\\dot" | "\\ddot" | "\\hat" | "\\tilde" | "\\vec" | "\\overline" => Command::Token(Kind::Accent),
        "\\bar" => Command::Spelled(Kind::Accent, "\\overline"),
        "\\widehat" => Command::Spelled(Kind::Accent, "\\hat"),
        "\\widetilde" => Command::Spelled(Kind::Accent, "\\tilde"),
        "\\varepsilon" => Command::Spelled(Kind::Letter, "\\epsilon"),
        "\\varphi" => Command::Spelled(Kind::Letter, "\\phi"),
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
        "\\equiv" | "\\coloneqq" => Kind::Equals,
        "\\{" | "\\lbrace" => Kind::Open(Bracket::Curly),
        "\\}" | "\\rbrace" => Kind::Close(Bracket::Curly),
        "\\lbrack" => Kind::Open(Bracket::Square),
        "\\rbrack" => Kind::Close(Bracket::Square),
        _ => return None,
    }))
}

fn hint(text: &str) -> &'static str {
    match text {
        "\\over" => ": write \\frac{..}{..}",
        "\\bigg/" | "\\middle" => ": write / alone",
        "\\vert" | "\\lvert" | "\\rvert" | "\\mid" | "\\|" => ": absolute values are not supported",
        "\\leq" | "\\geq" | "\\le" | "\\ge" | "\\lt" | "\\gt" | "\\neq" | "\\ne" | "\\approx" | "\\sim" | "\\simeq"
        | "\\mapsto" | "\\longmapsto" | "\\to" | "\\rightarrow" | "\\in" => ": only equations are read",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longest_function_first() {
        assert_eq!(elementary_at_start("sinhx"), Some("\\sinh"));
        assert_eq!(elementary_at_start("sin"), Some("\\sin"));
        assert_eq!(elementary("cos"), Some("\\cos"));
        assert_eq!(elementary("x"), None);
    }
}
