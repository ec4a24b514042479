//! Short scripts for people: the argument for a claim, or its counterexample, in SymPy, to be read in a minute.
//!
//! A script is no proof by itself: it shows the identity that a proof rests on, or the point at which a claim fails, and
//! names all else in comments. A claim for which that is longer than [`LONGEST`] lines has none, and it is said why.

use super::script::{Decided, Found, one_line};
use super::sympy::{IMPORTED, Unprintable};
use super::{Options, decided, referee_point, referee_proof};
use claims::Sheet;
use std::collections::BTreeSet;

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
    rules: Vec<String>,
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

/// The short scripts of the claim at a position: one, or several where its goals do not fit into one.
///
/// # Errors
/// [`NoScript`] where the claim, or one of its goals, has none.
pub fn short_scripts(sheet: &Sheet, position: usize, options: &Options) -> Result<Vec<String>, NoScript> {
    let decided = decided(sheet, position, options);
    if decided.is_empty() {
        return Err(NoScript::Words);
    }
    let mut parts: Vec<(&Decided, Block)> = Vec::new();
    for one in &decided {
        let block = block(one)?;
        // the same goal may come from several cases
        if parts.iter().all(|(_, known)| known.lines != block.lines) {
            parts.push((one, block));
        }
    }
    packed(&parts)
}

/// Scripts of as many goals each as fit into one.
fn packed(mut rest: &[(&Decided, Block)]) -> Result<Vec<String>, NoScript> {
    let mut scripts = Vec::new();
    while !rest.is_empty() {
        let most = (1..=rest.len())
            .rev()
            .find_map(|count| Some((count, script(&rest[..count]).ok()?)));
        let (count, text) = most.ok_or(NoScript::TooLong)?;
        scripts.push(text);
        rest = &rest[count..];
    }
    Ok(scripts)
}

fn block(one: &Decided) -> Result<Block, NoScript> {
    let mut block = Block {
        rules: one.goal.statements.rules.iter().map(ToString::to_string).collect(),
        ..Block::default()
    };
    let part = match one.goal.part.as_str() {
        "" => String::new(),
        part => format!(" ({part})"),
    };
    let instance = match one.question.instance.as_str() {
        "" => String::new(),
        instance => format!(", {instance}"),
    };
    let goal = one.question.equation.to_string();
    if !(block.rules.is_empty() && part.is_empty() && instance.is_empty() && is_same(&goal, &one.printed)) {
        block.comment(&format!("goal{part}{instance}:  {goal}"));
    }
    match &one.found {
        Found::Proved { certificate, .. } => referee_proof::write(one, certificate, &mut block)?,
        Found::Refuted { witness } => referee_point::write(one, witness, &mut block)?,
    }
    Ok(block)
}

/// Returns true if two formulas differ in blanks, brackets and points alone.
fn is_same(a: &str, b: &str) -> bool {
    let plain = |text: &str| {
        let words = [r"\left", r"\right", r"\cdot", r"\{", r"\}"];
        let text = words.iter().fold(text.to_owned(), |text, word| text.replace(word, ""));
        text.replace(|c: char| c.is_whitespace() || "()[]{}.,".contains(c), "")
    };
    plain(a) == plain(b)
}

/// A script of some goals of one claim.
fn script(parts: &[(&Decided, Block)]) -> Result<String, NoScript> {
    let mut head = Block::default();
    let verdict = |one: &Decided| match one.found {
        Found::Proved { .. } => "proved",
        Found::Refuted { .. } => "refuted",
    };
    let verdicts: BTreeSet<&str> = parts.iter().map(|(one, _)| verdict(one)).collect();
    let verdicts: Vec<&str> = verdicts.into_iter().collect();
    let (label, printed) = parts.first().map_or(("", ""), |(one, _)| (&one.label, &one.printed));
    head.comment(&format!(
        "Equation ({label}), {} by vibro-audit. Run it with python3 and SymPy: it fails where an assert does.",
        verdicts.join(" and ")
    ));
    head.comment(&format!("claim:  {printed}"));
    let rules: BTreeSet<&str> = parts
        .iter()
        .flat_map(|(_, block)| &block.rules)
        .map(String::as_str)
        .collect();
    if !rules.is_empty() {
        let rules: Vec<&str> = rules.into_iter().collect();
        head.comment(&format!(
            "reduced to what is below by rules that are trusted:  {}",
            rules.join("; ")
        ));
    }
    let mut body: Vec<String> = parts.iter().flat_map(|(_, block)| block.lines.clone()).collect();
    if body.iter().any(|line| words(line).contains("is_zero")) {
        body.insert(
            0,
            "def is_zero(x): return expand(fraction(together(x))[0]) == 0".to_owned(),
        );
    }
    let used: BTreeSet<&str> = body.iter().flat_map(|line| words(line)).collect();
    let imports: Vec<&str> = IMPORTED.into_iter().filter(|name| used.contains(name)).collect();
    if !imports.is_empty() {
        head.code(&format!("from sympy import ({})", imports.join(", ")), "");
    }
    let lines = [head.lines, body, vec!["print(\"every assert holds\")".to_owned()]].concat();
    match lines.len() <= LONGEST {
        true => Ok(lines.join("\n") + "\n"),
        false => Err(NoScript::TooLong),
    }
}

/// The words of the code in a line.
fn words(line: &str) -> BTreeSet<&str> {
    let code = line.split('#').next().unwrap_or_default();
    let is_between = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    code.split(is_between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_broken_where_python_allows_it() {
        let mut block = Block::default();
        let sum: Vec<String> = (0..40).map(|n| format!("x_{n}**2*y")).collect();
        block.name("e1", &sum.join(" + "), "a sum");
        assert_eq!(block.lines[0], "# a sum");
        assert!(block.lines[1].starts_with("e1 = (x_0**2*y + "));
        assert!(block.lines.iter().all(|line| line.len() <= WIDEST), "{block:?}");
        let joined: String = block.lines[1..].iter().map(|line| line.trim()).collect();
        assert_eq!(joined.replace([' ', '(', ')'], ""), format!("e1={}", sum.join("+")));
        let mut block = Block::default();
        block.name("e1", &sum.join("*"), "");
        assert!(block.lines.iter().all(|line| !line.starts_with("    *")), "{block:?}");
    }

    #[test]
    fn a_short_comment_stands_beside_its_code() {
        let mut block = Block::default();
        block.code("assert x == 0", "so\nit is");
        assert_eq!(block.lines, ["assert x == 0  # so it is"]);
    }
}
