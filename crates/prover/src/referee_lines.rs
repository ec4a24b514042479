//! The lines of a short script, and why a claim has none.

use super::script::one_line;
use super::sympy::Unprintable;

/// The most lines of a script.
pub const LONGEST: usize = 40;

/// The most characters of a line.
pub(super) const WIDEST: usize = 110;

/// Why a decided claim has no short script.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, thiserror::Error)]
pub enum NoScript {
    #[error("more than {LONGEST} lines")]
    TooLong,
    #[error("a proof by cases")]
    Cases,
    #[error("bounds by interval arithmetic over all values of letters")]
    Bounds,
    #[error("a law over time that is integrated or differentiated")]
    Laws,
    #[error("derivatives along a map")]
    Maps,
    #[error("functions of which values at several times are related")]
    Functions,
    #[error("letters that need not commute")]
    Words,
    #[error("a claim that has a value nowhere")]
    Nowhere,
    #[error("premises that contradict each other in a case")]
    Contradiction,
    #[error("a value that is no number in closed form")]
    Value,
    #[error("a step of the proof that has no form in SymPy")]
    Step,
    #[error(transparent)]
    Unprintable(#[from] Unprintable),
}

/// The part of a script about one goal.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) lines: Vec<String>,
    /// The rules that led from the claim to the goal.
    pub(super) rules: Vec<String>,
}

impl Block {
    /// Adds a comment, on as many lines as it needs.
    pub(super) fn comment(&mut self, text: &str) {
        self.lines.extend(broken(&one_line(text), "# ", "#     "));
    }

    /// Adds code with a comment: behind it where there is room, else before it. Code may be broken between brackets alone.
    pub(super) fn code(&mut self, code: &str, comment: &str) {
        let comment = one_line(comment);
        let beside = match comment.is_empty() {
            true => code.to_owned(),
            false => format!("{code}  # {comment}"),
        };
        if beside.chars().count() <= WIDEST {
            self.lines.push(beside);
            return;
        }
        if !comment.is_empty() {
            self.comment(&comment);
        }
        self.lines.extend(broken(code, "", "    "));
    }

    /// Adds that a name stands for an expression.
    pub(super) fn name(&mut self, name: &str, expression: &str, comment: &str) {
        let code = format!("{name} = {expression}");
        match code.chars().count() <= WIDEST {
            true => self.code(&code, comment),
            false => self.code(&format!("{name} = ({expression})"), comment),
        }
    }
}

/// A text as lines of at most [`WIDEST`] characters, where it can be broken: after blanks, brackets, commas and signs of products.
fn broken(text: &str, first: &str, next: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest: Vec<char> = text.trim_end().chars().collect();
    let mut indent = first;
    loop {
        let room = WIDEST.saturating_sub(indent.len());
        if rest.len() <= room {
            lines.push(format!("{indent}{}", rest.iter().collect::<String>()));
            return lines;
        }
        let is_end = |&at: &usize| {
            let (before, after) = (rest.get(at - 1), rest.get(at));
            matches!(before, Some(' ' | '(' | ',')) || (before == Some(&'*') && after != Some(&'*'))
        };
        // after a blank where that does not waste half a line
        let blank = (room / 2..=room).rev().find(|&at| rest.get(at - 1) == Some(&' '));
        let end = blank.or_else(|| (1..=room).rev().find(is_end)).unwrap_or(rest.len());
        let line: String = rest.drain(..end).collect();
        lines.push(format!("{indent}{}", line.trim_end()));
        indent = next;
        if rest.is_empty() {
            return lines;
        }
    }
}
