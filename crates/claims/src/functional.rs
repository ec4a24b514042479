//! Terms that are linear in what stands in them: sums over an index of which no ends are printed, `\sum_i x_i`, and means,
//! `\mathbb{E}[X]`.

use std::collections::BTreeSet;
use texmath::{
    At, BOLD, Name, Names, Opaque, Operation, Series, Tree, any, is_opaque, names_in, read_expression, read_name,
};

/// A mean, and what it is of.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mean {
    /// The sign and the condition.
    pub sign: String,
    /// True if more may be constant than the letters that stand outside of means.
    pub is_conditional: bool,
    pub of: Tree,
}

/// Signs of means.
const MEANS: [&str; 4] = [r"\mathbb{E}", r"\mathbb E", r"\operatorname{E}", r"\mathrm{E}"];

/// Signs of vectors, matrices and operators, of which nothing more is known within a term.
const OF_OPERATORS: [&str; 12] = [
    r"\vec",
    r"\overrightarrow",
    r"\hat",
    r"\widehat",
    r"\mathcal",
    r"\nabla",
    r"\top",
    r"\intercal",
    r"\dagger",
    "^T",
    "^{T}",
    "'",
];

/// Brackets around what a mean is of.
const BRACKETS: [[&str; 2]; 3] = [["[", "]"], ["(", ")"], [r"\{", r"\}"]];

/// The names by which what stands in terms is read.
fn names() -> Names {
    Names {
        opaque: Some(Opaque::default()),
        ..Names::default()
    }
}

/// Returns the letters in a sum or a mean that is a symbol, without accents.
pub(super) fn letters_in(name: &Name) -> Vec<String> {
    let within = || sum(&name.base, At::default()).or_else(|| mean(&name.base).map(|mean| mean.of));
    let mut names = BTreeSet::new();
    if let Some(within) = is_opaque(name).then(within).flatten() {
        names_in(&within, &mut names);
    }
    let letters = |name: Name| match letters_in(&name) {
        inner if inner.is_empty() => vec![name.base],
        inner => inner,
    };
    names.into_iter().flat_map(letters).collect()
}

/// Returns a tree with the sums that are symbols in it as sums over their indices, from what is printed below the sign to nobody says
/// what.
pub(super) fn with_sums(tree: &Tree) -> Tree {
    match tree {
        Tree::Symbol(name, at) => sum(&name.base, *at).unwrap_or_else(|| tree.clone()),
        _ => tree.map(&mut |part| with_sums(part)),
    }
}

/// Returns true if a tree holds a sum that is a symbol.
pub(super) fn has_sums(tree: &Tree) -> bool {
    any(
        tree,
        &mut |node| matches!(node, Tree::Symbol(name, at) if is_opaque(name) && sum(&name.base, *at).is_some()),
    )
}

/// The most sums and means within a term, and its most bytes: each is read anew within the one around it.
const MOST_SIGNS: usize = 12;
const LONGEST: usize = 2_000;

/// Returns true if a term is not looked into: one that is long, and one in which something may be more than a number by how it is
/// printed.
fn is_left_alone(term: &str) -> bool {
    let signs = ["\\sum"].iter().chain(&MEANS).map(|sign| term.matches(sign).count());
    let may_be_operators = || BOLD.iter().chain(&OF_OPERATORS).any(|sign| term.contains(sign));
    term.len() > LONGEST || signs.sum::<usize>() > MOST_SIGNS || may_be_operators()
}

fn sum(term: &str, at: At) -> Option<Tree> {
    if is_left_alone(term) {
        return None;
    }
    let (below, body) = script(term.strip_prefix(r"\sum_")?)?;
    let index = below.split(r"\in").next().unwrap_or(below);
    let index = read_name(index.trim(), &names()).ok()?;
    let over = Name::plain(&format!("over {below}"));
    let series = Operation::Series {
        kind: Series::Sum,
        of: with_sums(&read_expression(body, &names()).ok()?),
        index,
        from: Tree::Symbol(over, at),
        to: Tree::Operation(Box::new(Operation::Infinity), at),
    };
    Some(Tree::Operation(Box::new(series), at))
}

/// Returns the mean that a symbol is which is a whole term.
pub(super) fn mean(term: &str) -> Option<Mean> {
    if is_left_alone(term) {
        return None;
    }
    let names = names();
    let (mut sign, mut rest) = MEANS.iter().find_map(|mean| Some((*mean, term.strip_prefix(mean)?)))?;
    let mut is_conditional = false;
    if let Some(below) = rest.strip_prefix('_') {
        is_conditional = true;
        rest = script(below)?.1;
        sign = term.get(..term.len() - rest.len())?;
    }
    let inside = BRACKETS
        .iter()
        .find_map(|[open, close]| rest.strip_prefix(open)?.strip_suffix(close));
    let Some(inside) = inside else {
        // of a letter alone
        let of = read_expression(rest.trim(), &names).ok()?;
        let sign = sign.to_owned();
        let is_letter = |tree: &Tree| matches!(tree, Tree::Symbol(..));
        let is_one = is_letter(&of) || matches!(&of, Tree::Power(base, ..) if is_letter(base));
        return is_one.then_some(Mean {
            sign,
            is_conditional,
            of,
        });
    };
    let mut parts = [r"\mid", r"\vert", "|"].iter().filter_map(|bar| inside.split_once(bar));
    let (of, sign) = match parts.next() {
        Some((of, condition)) => (of, format!("{sign} given {condition}")),
        None => (inside, sign.to_owned()),
    };
    is_conditional |= sign.contains(" given ");
    let of = with_sums(&read_expression(of, &names).ok()?);
    Some(Mean {
        sign,
        is_conditional,
        of,
    })
}

/// Returns the script that a text begins with, without braces, and the rest.
fn script(text: &str) -> Option<(&str, &str)> {
    if let Some(inside) = text.strip_prefix('{') {
        let mut depth = 1;
        let close = inside.find(|c: char| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            depth == 0
        })?;
        return Some((inside.get(..close)?, inside.get(close + 1..)?));
    }
    let length = match text.strip_prefix('\\') {
        Some(name) => 1 + name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len()),
        None => text.chars().next()?.len_utf8(),
    };
    text.split_at_checked(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(term: &str) -> Option<String> {
        let of_mean = |mean: Mean| format!("{} {}: {}", mean.sign, mean.is_conditional, mean.of);
        let of_sum = |tree: Tree| tree.to_string();
        mean(term).map(of_mean).or_else(|| sum(term, At::default()).map(of_sum))
    }

    #[test]
    fn sums_and_means_are_linear() {
        for (term, wanted) in [
            (r"\sum_ix_iy_i", r"\sum_{i = over i}^{\infty} x_i y_i"),
            (r"\sum_{k\in K}(a_k+b)", r"\sum_{k = over k\in K}^{\infty} (a_k + b)"),
            (
                r"\sum_i\sum_ja_ib_j",
                r"\sum_{i = over i}^{\infty} \sum_{j = over j}^{\infty} a_i b_j",
            ),
            (r"\mathbb{E}[aX+b]", r"\mathbb{E} false: a X + b"),
            (r"\mathbb{E}X^{2}", r"\mathbb{E} false: X^2"),
            (r"\mathbb{E}_t[x_{t+1}]", r"\mathbb{E}_t true: x_{t+1}"),
            (r"\mathbb{E}[X|Y]", r"\mathbb{E} given Y true: X"),
        ] {
            assert_eq!(told(term).as_deref(), Some(wanted), "{term}");
        }
    }

    #[test]
    fn letters_stand_in_them() {
        let within = |base: &str| letters_in(&Name::plain(base));
        assert_eq!(within(r"\sum_ia_iAB"), ["A", "B", "a", "over i"]);
        assert_eq!(within(r"\mathbb{E}[aX]"), ["X", "a"]);
        assert!(within("a").is_empty());
    }

    #[test]
    fn others_are_not() {
        for term in [
            r"\sum_{i<j}x_i",
            r"\sum_i\mathbf{x}_i",
            r"\sum_ix_iy_i^\top",
            r"\prod_ix_i",
            r"\mathbb{P}(X)",
            r"\mathbb{E}",
            r"\max_ix_i",
        ] {
            assert_eq!(told(term), None, "{term}");
        }
    }
}
