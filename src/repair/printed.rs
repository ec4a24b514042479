//! A repair as it is shown: the whole formula as printed, conditions included, with the mended equations put into its TeX; and
//! the gate that each repair goes through, which reads and proves what is shown.

use super::monomial::{is_balanced, is_number, is_same_product};
use super::search::names_in;
use super::{Part, speaks};
use crate::claim::{Entry, Sheet, Verdict};
use crate::prove::{self, Options};
use crate::tex::{Condition, Equation, Tree, any};

/// Formulas with changes put into their TeX, and the sheet that is read with them.
pub struct Reprinted {
    /// The texts that change, from the first to the last character shown.
    pub formulas: Vec<String>,
    pub sheet: Sheet,
}

/// Returns the sheet in which equations of the entry at a position are put into its TeX in place of those that stand there; `None`
/// where these cannot be told apart from the text around them, or where the sheet cannot be read with them.
pub fn reprinted(sheet: &Sheet, position: usize, mended: &[(Part, Equation)]) -> Option<Reprinted> {
    let entry = sheet.entries.get(position)?;
    let (mut stated, mut local): (Vec<Change>, Vec<(String, Vec<Change>)>) = (Vec::new(), Vec::new());
    for (part, equation) in mended {
        match part {
            Part::Stated(n) => stated.push(Change::of(entry.equations.get(*n)?, equation)),
            Part::Definition(n) => {
                let (old, source) = entry.local.get(*n)?;
                let change = Change::of(old, equation);
                match local.iter_mut().find(|(tex, _)| *tex == source.tex) {
                    Some((_, changes)) => changes.push(change),
                    None => local.push((source.tex.clone(), vec![change])),
                }
            }
        }
    }
    let tex = match stated.is_empty() {
        true => entry.tex.tex.clone(),
        false => shown(&put_into(&entry.tex.tex, stated)?),
    };
    let mut formulas: Vec<String> = mended
        .iter()
        .any(|(part, _)| matches!(part, Part::Stated(_)))
        .then(|| tex.clone())
        .into_iter()
        .collect();
    let mut texts = Vec::new();
    for (before, changes) in local {
        let after = shown(&put_into(&before, changes)?);
        formulas.push(after.clone());
        texts.push((before, after));
    }
    let sheet = sheet.reprinted(position, &tex, &texts)?;
    Some(Reprinted { formulas, sheet })
}

/// A piece of TeX in place of another.
struct Change {
    start: usize,
    end: usize,
    tex: String,
}

impl Change {
    fn of(old: &Equation, new: &Equation) -> Self {
        Self {
            start: old.at.0,
            end: old.end.0,
            tex: new.to_string(),
        }
    }
}

/// The text with these changes; `None` where they overlap, or have no place.
fn put_into(text: &str, mut changes: Vec<Change>) -> Option<String> {
    changes.sort_by_key(|change| change.start);
    let (mut written, mut from) = (String::new(), 0);
    for change in changes {
        if change.start < from || change.end <= change.start {
            return None;
        }
        let before = without_size(text.get(from..change.start)?);
        written.push_str(before);
        written.push_str(&change.tex);
        from = change.end;
    }
    written.push_str(text.get(from..)?);
    Some(written)
}

/// The text without the size of a bracket that stands behind it, `\left` or `\bigl`: what is put there has its own.
fn without_size(text: &str) -> &str {
    let sizes = [
        r"\left", r"\bigl", r"\Bigl", r"\biggl", r"\Biggl", r"\big", r"\Big", r"\bigg", r"\Bigg",
    ];
    let bare = text.trim_end();
    sizes.iter().find_map(|size| bare.strip_suffix(size)).unwrap_or(text)
}

/// The text in one line, without the full stop or comma of the sentence that it ends.
fn shown(tex: &str) -> String {
    // what stands behind a comment sign would become part of it
    let line = match tex.contains('%') {
        true => tex.trim().to_owned(),
        false => tex.split_whitespace().collect::<Vec<_>>().join(" "),
    };
    let bare = line.trim_end_matches(['.', ',', ';', ' ']);
    if bare.ends_with('\\') { line } else { bare.to_owned() }
}

/// Returns a repair as it is shown, where that says what the printed formula says but for its edits, and is proved.
pub fn proved_as_printed(
    sheet: &Sheet,
    position: usize,
    mended: &[(Part, Equation)],
    may_balance: bool,
    options: &Options,
) -> Option<Vec<String>> {
    let printed = reprinted(sheet, position, mended)?;
    let (before, after) = (sheet.entries.get(position)?, printed.sheet.entries.get(position)?);
    let is_faithful = printed.sheet.entries.len() == sheet.entries.len() && keeps_the_rest(before, after, mended);
    if !is_faithful
        || !mended
            .iter()
            .all(|(part, new)| is_a_repair(*part, new, before, after, may_balance))
    {
        return None;
    }
    let is_proved = |position| {
        let decision = prove::decide(&printed.sheet, position, options);
        decision.verdict == Verdict::Proved && !decision.is_vacuous
    };
    sheet.of_same_text(position).all(is_proved).then_some(printed.formulas)
}

/// The equation at a place of an entry.
pub(super) fn equation(entry: &Entry, part: Part) -> Option<&Equation> {
    match part {
        Part::Stated(n) => entry.equations.get(n),
        Part::Definition(n) => entry.local.get(n).map(|(equation, _)| equation),
    }
}

/// Returns true if all that stands around the mended equations is read as before: the conditions, the side of an arrow that is
/// assumed, the other equations.
fn keeps_the_rest(before: &Entry, after: &Entry, mended: &[(Part, Equation)]) -> bool {
    let conditions = |entry: &Entry| {
        entry
            .assume
            .iter()
            .map(|(condition, _)| condition.clone())
            .collect::<Vec<_>>()
    };
    let parts = (0..before.equations.len()).map(Part::Stated);
    let mut parts = parts.chain((0..before.local.len()).map(Part::Definition));
    // a side that two links of a chain share changes in both
    let shares = |own: &Equation, part: Part| {
        mended.iter().any(|(other, _)| {
            let is_stated = matches!((part, other), (Part::Stated(_), Part::Stated(_)));
            let other = equation(before, *other);
            is_stated && other.is_some_and(|other| own.at.0 < other.end.0 && other.at.0 < own.end.0)
        })
    };
    let is_kept = |part: Part| {
        let both = equation(before, part).zip(equation(after, part));
        both.is_some_and(|(old, new)| {
            let is_changed = mended.iter().any(|(other, _)| *other == part);
            is_changed || old == new || (old.relation == new.relation && shares(old, part))
        })
    };
    after.unread.is_none()
        && before.label == after.label
        && before.is_implication == after.is_implication
        && before.is_way == after.is_way
        && before.alternatives.len() == after.alternatives.len()
        && before.equations.len() == after.equations.len()
        && before.local.len() == after.local.len()
        && conditions(before) == conditions(after)
        && parts.all(is_kept)
}

/// Returns true if a mended equation, as it is read, is another one than before, with the relation that was meant, and says
/// something: its sides are not the same, it is not assumed, none of them is gone, and where something is put in no name goes.
fn is_a_repair(part: Part, meant: &Equation, before: &Entry, after: &Entry, may_balance: bool) -> bool {
    let Some((old, new)) = equation(before, part).zip(equation(after, part)) else {
        return false;
    };
    let is_other_spelling = old.relation == new.relation
        && is_same_product(&old.left, &new.left)
        && is_same_product(&old.right, &new.right);
    // where an edit may only balance the sides, the same product on both says nothing
    let is_empty = match may_balance {
        true => is_balanced(new, old),
        false => new.left == new.right,
    };
    // what is to be a number may be one whose symbols cancel
    let may_be_number = |other: &Tree, new: &Tree| matches!(other, Tree::Number(_)) && !may_balance && speaks(new);
    let is_gone = |old: &Tree, new: &Tree, other: &Tree| {
        speaks(old) && !is_number(old) && !may_be_number(other, new) && (is_number(new) || !speaks(new))
    };
    let drops_a_name = || may_balance && !names_in(old).is_subset(&names_in(new));
    let is_assumed = after.assume.iter().any(|(condition, _)| match condition {
        Condition::Relation(assumed) => {
            assumed.relation == new.relation
                && [(&assumed.left, &assumed.right), (&assumed.right, &assumed.left)]
                    .iter()
                    .any(|(left, right)| is_same_product(left, &new.left) && is_same_product(right, &new.right))
        }
        Condition::Integer(_) => false,
    });
    let cancellations = |equation: &Equation| cancelling(&equation.left) + cancelling(&equation.right);
    // L R / L = R
    let divides_whole = |equation: &Equation| {
        let is_whole = |node: &Tree, other: &Tree| match node {
            Tree::Quotient(above, below, _) => [above, below].iter().any(|part| is_same_product(part, other)),
            _ => false,
        };
        let sides = [(&equation.left, &equation.right), (&equation.right, &equation.left)];
        sides.iter().any(|(own, other)| {
            !matches!(other, Tree::Symbol(..)) && speaks(other) && any(own, &mut |node| is_whole(node, other))
        })
    };
    new.relation == meant.relation
        && (divides_whole(old) || !divides_whole(new))
        && cancellations(new) <= cancellations(old)
        && !is_assumed
        && !is_other_spelling
        && !is_empty
        && !is_gone(&old.left, &new.left, &old.right)
        && !is_gone(&old.right, &new.right, &old.left)
        && !drops_a_name()
}

/// The number of nodes in which something cancels as it stands: `\frac{x}{x}`, `\frac{a x}{b x}`, `x - x`, `x \frac{a}{x}`. They
/// come of edits that balance the sides, and no author means them.
fn cancelling(tree: &Tree) -> usize {
    let share = |one: &[Tree], other: &[Tree]| one.iter().any(|factor| speaks(factor) && other.contains(factor));
    let own = match tree {
        Tree::Quotient(above, below, _) => {
            (speaks(below) && is_same_product(above, below)) || share(factors_of(above), factors_of(below))
        }
        Tree::Sum(terms) => terms.iter().any(|term| match term {
            Tree::Negate(inner) => speaks(inner) && terms.contains(inner),
            _ => false,
        }),
        Tree::Product(factors) => factors.iter().any(|factor| match factor {
            Tree::Quotient(_, below, _) => share(factors_of(below), factors),
            _ => false,
        }),
        _ => false,
    };
    usize::from(own) + super::parts(tree).iter().map(cancelling).sum::<usize>()
}

/// The factors of a product; anything else is the only one.
fn factors_of(tree: &Tree) -> &[Tree] {
    match tree {
        Tree::Product(factors) => factors,
        one => std::slice::from_ref(one),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tex::{Names, Symbols, read};

    fn sheet(tex: &str) -> Sheet {
        let text = format!(
            "[symbols]\nparameters = ['x', 'y']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '''{tex}'''\n"
        );
        Sheet::read(&text, &Symbols::default()).expect("a sheet")
    }

    fn shown_with(tex: &str, n: usize, new: &str) -> Option<String> {
        let new = read(new, &Names::default()).expect("an equation").remove(0);
        let printed = reprinted(&sheet(tex), 0, &[(Part::Stated(n), new)])?;
        printed.formulas.first().cloned()
    }

    #[test]
    fn what_stands_around_an_equation_stays() {
        assert_eq!(
            shown_with("\\sqrt{x^2} = -x,\n \\quad \\text{for } x > 0.", 0, "\\sqrt{x^2} = x").as_deref(),
            Some(r"\sqrt{x^2} = x, \quad \text{for } x > 0")
        );
        assert_eq!(
            shown_with(r"x = 2 \Rightarrow x^2 = 5", 0, "x^2 = 4").as_deref(),
            Some(r"x = 2 \Rightarrow x^2 = 4")
        );
        assert_eq!(
            shown_with("x + x = 3 x = x 3", 0, "x + x = 2 x").as_deref(),
            Some("x + x = 2 x = x 3")
        );
        for size in [r"\left", r"\bigl", r"\big ", r"x > 0 \Rightarrow \left"] {
            let close = if size.contains("left") {
                r"\right".to_owned()
            } else {
                size.replace("gl", "gr")
            };
            let before = size.split_at(size.rfind('\\').unwrap_or_default()).0;
            assert_eq!(
                shown_with(&format!("{size}(x + y{close})^2 = x^2"), 0, "(x + y)^2 = y^2").as_deref(),
                Some(format!("{before}(x + y)^2 = y^2").as_str())
            );
        }
    }

    #[test]
    fn only_what_is_true_as_printed_passes() {
        let passes = |tex: &str, n: usize, new: &str| {
            let new = read(new, &Names::default()).expect("an equation").remove(0);
            proved_as_printed(&sheet(tex), 0, &[(Part::Stated(n), new)], false, &Options::default()).is_some()
        };
        assert!(passes(
            r"\sqrt{x^2} = -x, \quad \text{for } x > 0",
            0,
            r"\sqrt{x^2} = x"
        ));
        assert!(!passes(r"\sqrt{x^2} = -x", 0, r"\sqrt{x^2} = x"));
        // the link behind it shares the side
        assert!(!passes("x + x = 3 x = x 3", 0, "x + x = 2 x"));
        assert!(passes("x + x = 3 x = x 2", 0, "x + x = 2 x"));
        // another spelling, nothing, a side gone
        for (wrong, new) in [
            ("x y = x", "y x = x"),
            ("x y = x", "x y = x y"),
            ("x + y = x", "x - x = 0"),
            ("x - y = 0", "y - y = 0"),
            ("x^2 = y", "x - x = y - y"),
            (r"2^{x + 1} = 2^x + 2", r"2^{\frac{x}{x} + 1} = 2^{\frac{x}{x}} + 2"),
            ("x + y = y", r"x \frac{y}{x} = y"),
        ] {
            assert!(!passes(wrong, 0, new), "{wrong}: {new}");
        }
        assert!(passes("x^0 = 0", 0, "x^0 = 1"));
    }
}
