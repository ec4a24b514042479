//! Short scripts for people: the argument for a claim, or its counterexample, in SymPy, to be read in a minute.
//!
//! A script is no proof by itself: it shows the identity that a proof rests on, or the point at which a claim fails, and
//! names all else in comments. A claim for which that is longer than [`LONGEST`] lines has none, and it is said why.

use super::referee_lines::{Block, LONGEST, NoScript};
use super::script::{Decided, Found};
use super::sympy::IMPORTED;
use super::{Options, decided, referee_point, referee_proof};
use claims::Sheet;
use std::collections::BTreeSet;

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
    use super::super::referee_lines::WIDEST;
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
