//! Places within formulas.

use crate::tex::{Equation, Tree};

pub use crate::tex::parts;

/// The way from an equation to a node: 0 for the left side or 1 for the right, then the position among the parts of each
/// node.
pub type Path = Vec<usize>;

/// The node with the one at the end of the path replaced.
pub fn with(tree: &Tree, path: &[usize], new: &Tree) -> Tree {
    let Some((&first, rest)) = path.split_first() else {
        return new.clone();
    };
    let mut place = 0;
    tree.map(&mut |part| {
        place += 1;
        match place == first + 1 {
            true => with(part, rest, new),
            false => part.clone(),
        }
    })
}

/// The equation with a node replaced, and no minus before a side that is 0 by that.
pub fn replaced(equation: &Equation, path: &[usize], new: &Tree) -> Equation {
    let mut equation = equation.clone();
    if let Some((side, rest)) = path.split_first() {
        let side = match side {
            0 => &mut equation.left,
            _ => &mut equation.right,
        };
        let is_zero = matches!(new, Tree::Number(number) if number.0.is_zero());
        let is_negative = matches!(side, Tree::Negate(_)) && rest.len() == 1;
        *side = if is_zero && is_negative {
            new.clone()
        } else {
            with(side, rest, new)
        };
    }
    equation
}

/// The node at the end of the path.
pub fn node(equation: &Equation, path: &[usize]) -> Option<Tree> {
    let (side, rest) = path.split_first()?;
    match side {
        0 => at(&equation.left, rest),
        _ => at(&equation.right, rest),
    }
}

fn at(tree: &Tree, path: &[usize]) -> Option<Tree> {
    let below = |tree: Tree, &place: &usize| parts(&tree).into_iter().nth(place);
    path.iter().try_fold(tree.clone(), below)
}

/// What is called with a node of a tree, the node above it, and its path.
type Visit<'a> = dyn FnMut(&Tree, Option<&Tree>, &[usize]) + 'a;

/// Calls with each node of a tree, its path, and the node above it; from the outside in.
pub fn walk(tree: &Tree, above: Option<&Tree>, path: &mut Path, visit: &mut Visit) {
    visit(tree, above, path);
    for (place, part) in parts(tree).iter().enumerate() {
        path.push(place);
        walk(part, Some(tree), path, visit);
        path.pop();
    }
}

/// The number of nodes of a tree.
pub fn size(tree: &Tree) -> u32 {
    1 + parts(tree).iter().map(size).sum::<u32>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tex::{Names, read, read_expression};

    #[test]
    fn a_node_is_found_and_replaced_by_its_path() {
        let names = Names::default();
        let equation = read(r"x = \frac{a + b}{c} d", &names).unwrap().remove(0);
        let path = vec![1, 0, 0, 1];
        assert_eq!(node(&equation, &path).unwrap().to_string(), "b");
        let new = read_expression("y^2", &names).unwrap();
        assert_eq!(replaced(&equation, &path, &new).to_string(), r"x = \frac{a + y^2}{c} d");
        let zero = super::super::edit::number(0);
        for (negative, path, with_zero) in [
            ("x = -a", [1, 0].as_slice(), "x = 0"),
            ("x = b - a", &[1, 1, 0], "x = b - 0"),
        ] {
            let negative = read(negative, &names).unwrap().remove(0);
            assert_eq!(replaced(&negative, path, &zero).to_string(), with_zero);
        }
        let mut found = 0;
        for side in [&equation.left, &equation.right] {
            walk(side, None, &mut Vec::new(), &mut |_, _, _| found += 1);
        }
        assert_eq!(found as u32, size(&equation.left) + size(&equation.right));
    }
}
