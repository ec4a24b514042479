//! Symbols that a formula defines for itself.

use super::circle::circle;
use super::size::Sizes;
use std::collections::HashMap;
use texmath::{
    Equation, Name, Relation, Symbols, Tree, any, base_alone, is_constant, pair_of, put_in_throughout, speaks_of,
};

/// A symbol that stands for an expression within one entry of a sheet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Local {
    pub name: Name,
    pub tree: Tree,
}

impl Local {
    /// Returns the name and what it stands for.
    pub(super) fn pair(&self) -> (&Name, &Tree) {
        (&self.name, &self.tree)
    }
}

/// Returns the letters of a tree, each once.
pub(super) fn letters_of(tree: &Tree) -> Vec<Name> {
    let mut found = Vec::new();
    any(tree, &mut |node| {
        if let Tree::Symbol(name, _) = node
            && !is_constant(name)
            && !found.contains(name)
        {
            found.push(name.clone());
        }
        false
    });
    found
}

/// The pub(super) constant of integration, where nothing else has its name.
pub(super) const CONSTANT_OF_INTEGRATION: &str = "C";

/// Whether an undeclared name is the constant of integration.
pub(super) fn is_constant_of_integration(name: &Name) -> bool {
    name.base == CONSTANT_OF_INTEGRATION && *name == base_alone(name)
}

/// Whether one of the definitions has this name.
pub(super) fn is_defined(name: &Name, locals: &[Local]) -> bool {
    locals.iter().any(|local| local.name == *name)
}

/// `x_{1,2} = a \pm b` of two declared symbols as the two equations x_1 = a + b and x_2 = a - b, where neither x nor the
/// pair itself is declared.
pub(super) fn two_of_pair(equation: Equation, symbols: &Symbols) -> Vec<Equation> {
    let Tree::Symbol(name, at) = &equation.left else {
        return vec![equation];
    };
    let of = |subscript: &str| Name {
        subscript: subscript.to_string(),
        ..name.clone()
    };
    let is_pair = *name == of("1,2") && !symbols.knows(name) && equation.relation == Relation::Equal;
    if !is_pair || !has_sign(&equation.right) || ![of("1"), of("2")].iter().all(|one| symbols.declares(one)) {
        return vec![equation];
    }
    let one = |subscript: &str, upper: bool| Equation {
        left: Tree::Symbol(of(subscript), *at),
        right: with_sign(&equation.right, upper),
        ..equation.clone()
    };
    let two = vec![one("1", true), one("2", false)];
    match two.iter().any(|equation| has_sign(&equation.right)) {
        true => vec![equation],
        false => two,
    }
}

/// Whether `\pm` or `\mp` stands in a tree.
pub(super) fn has_sign(tree: &Tree) -> bool {
    any(tree, &mut |node| {
        matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_))
    })
}

/// The tree under the upper or the lower signs.
pub(super) fn with_sign(tree: &Tree, upper: bool) -> Tree {
    let again = |tree: &Tree| with_sign(tree, upper);
    match tree {
        Tree::PlusMinus(body) if upper => again(body),
        Tree::MinusPlus(body) if !upper => again(body),
        Tree::PlusMinus(body) | Tree::MinusPlus(body) => Tree::Negate(Box::new(again(body))),
        Tree::Operation(..) => tree.clone(),
        _ => tree.map(&mut |part| again(part)),
    }
}

/// The definition that an equation is: a new name alone on its left.
pub(super) fn definition(equation: &Equation, symbols: &Symbols) -> Option<Local> {
    local(equation, symbols).filter(|local| !is_constant(&local.name))
}

/// The definition that an equation of `where` is: there `e` and `i` may be defined too.
pub(super) fn local(equation: &Equation, symbols: &Symbols) -> Option<Local> {
    let Tree::Symbol(name, _) = &equation.left else {
        return None;
    };
    let new = !symbols.knows(name) || matches!(name.base.as_str(), "e" | "i");
    let free = new && !symbols.declares(name) && pair_of(name).is_none();
    (equation.relation == Relation::Equal && free).then(|| Local {
        name: name.clone(),
        tree: equation.right.clone(),
    })
}

/// A name that is defined by itself, over one definition or more.
pub(super) fn circular(locals: &[Local]) -> Option<&Name> {
    let positions: HashMap<&Name, usize> = locals.iter().enumerate().map(|(n, local)| (&local.name, n)).collect();
    let used = |local: &Local| {
        let mut used = Vec::new();
        any(&local.tree, &mut |node| {
            if let Tree::Symbol(name, _) = node {
                used.extend(positions.get(name));
            }
            false
        });
        used
    };
    let uses: Vec<Vec<usize>> = locals.iter().map(used).collect();
    circle(&uses).and_then(|n| locals.get(n)).map(|local| &local.name)
}

/// Whether two trees are the same once definitions are put in.
pub(super) fn means_the_same(one: &Tree, other: &Tree, locals: &[Local]) -> bool {
    one == other || inlined(one, locals).is_some_and(|one| inlined(other, locals) == Some(one))
}

/// A name of `inner` that means something else in `outer`, which gives it another meaning or speaks of it and gives it none:
/// together these could be taken for each other.
pub(super) fn clash<'l>(inner: &'l [Local], outer: &[Local]) -> Option<&'l Name> {
    let all = joined(inner.to_vec(), outer);
    let differs = |local: &&Local| match outer.iter().find(|other| other.name == local.name) {
        Some(other) => !means_the_same(&local.tree, &other.tree, &all),
        None => outer.iter().any(|other| speaks_of(&other.tree, &local.name)),
    };
    inner.iter().find(differs).map(|local| &local.name)
}

/// The definitions, and those of `more` whose names are not among them.
pub(super) fn joined(mut locals: Vec<Local>, more: &[Local]) -> Vec<Local> {
    let new: Vec<Local> = more
        .iter()
        .filter(|local| !is_defined(&local.name, &locals))
        .cloned()
        .collect();
    locals.extend(new);
    locals
}

/// The tree with definitions put in; `None` where it would become too large, or where they are circular.
pub(super) fn inlined(tree: &Tree, own: &[Local]) -> Option<Tree> {
    let mut sizes = Sizes::new(own.iter().map(Local::pair));
    sizes.of(tree).ok()?;
    Some(put_in_throughout(tree, &|name| sizes.meaning(name).cloned()))
}

/// The equation with definitions put in; `None` where it would become too large.
pub(super) fn inlined_in(equation: &Equation, own: &[Local]) -> Option<Equation> {
    let (left, right) = (inlined(&equation.left, own)?, inlined(&equation.right, own)?);
    Some(Equation {
        left,
        right,
        ..equation.clone()
    })
}

#[cfg(test)]
mod tests {
    use super::super::symbols::RawSymbols;
    use super::*;
    use texmath::{At, Names, read};

    fn locals(texts: &[&str]) -> Vec<Local> {
        let symbols = Symbols::default();
        let read = |tex: &&str| read(tex, &Names::default()).unwrap();
        let equations = texts.iter().flat_map(read);
        equations.filter_map(|equation| local(&equation, &symbols)).collect()
    }

    #[test]
    fn a_circle_of_definitions_is_named() {
        let found = |texts: &[&str]| circular(&locals(texts)).map(ToString::to_string);
        assert_eq!(
            found(&["a = b + 1", "b = c", "c = 2 b", "d = a"]),
            Some("b".to_string())
        );
        assert_eq!(found(&["a = a"]), Some("a".to_string()));
        assert_eq!(found(&["a = b b", "b = c + c", "c = x"]), None);
    }

    #[test]
    fn a_pair_of_declared_symbols_is_two_equations() {
        let printed = |parameters: &[&str], tex: &str| -> Vec<String> {
            let symbols = RawSymbols {
                parameters: parameters.iter().map(ToString::to_string).collect(),
                ..RawSymbols::default()
            };
            let symbols = symbols.read().unwrap();
            let equations = read(tex, &symbols.names).unwrap().into_iter();
            let two = equations.flat_map(|equation| two_of_pair(equation, &symbols));
            two.map(|equation| equation.to_string()).collect()
        };
        let both = ["x_1", "x_2", "a"];
        let tex = r"x_{1,2} = \frac{-a \pm b \sqrt{1 \mp c}}{2}";
        assert_eq!(
            printed(&both, tex),
            [
                r"x_1 = \frac{-a + b \sqrt{1 - c}}{2}",
                r"x_2 = \frac{-a - b \sqrt{1 + c}}{2}"
            ]
        );
        let one = ["x_{1,2} = -a \\pm b"];
        assert_eq!(printed(&["x", "x_1", "x_2"], one[0]), one);
        assert_eq!(printed(&["x_{1,2}", "x_1", "x_2"], one[0]), one);
        assert_eq!(printed(&["x_1"], one[0]), one);
        assert_eq!(printed(&both, "x_{1,2} = a"), ["x_{1,2} = a"]);
        assert_eq!(printed(&both, r"x_{1,2} < \pm a"), [r"x_{1,2} < \pm a"]);
    }

    #[test]
    fn definitions_are_put_in_until_they_would_be_too_large() {
        let own = locals(&["a = b + b", "b = c + c"]);
        let a = Tree::Symbol(own[0].name.clone(), At(0));
        assert_eq!(inlined(&a, &own).unwrap().to_string(), "(c + c) + (c + c)");
        let doubling: Vec<String> = (0..60)
            .map(|n| format!("x_{{{n}}} = x_{{{0}}} x_{{{0}}}", n + 1))
            .collect();
        let own = locals(&doubling.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(inlined(&Tree::Symbol(own[0].name.clone(), At(0)), &own), None);
    }
}
