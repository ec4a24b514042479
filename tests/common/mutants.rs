//! Every single edit of a formula, as a hurried author or a misprint would make it.

use vibro_audit::number::{Field, Rational};
use vibro_audit::tex::{At, Equation, Invariant, Name, Tree};

fn number(value: i64) -> Tree {
    Tree::Number(Rational::from_integer(value))
}

/// The names that may stand in the place of one.
fn other_names(name: &Name) -> Vec<Name> {
    let with = |subscript: &str| Name {
        subscript: subscript.to_string(),
        ..name.clone()
    };
    let base = name.base.as_str();
    let mut others: Vec<Name> = Vec::new();
    let families: &[&[&str]] = match base {
        "t" | "Z" => &[&["k", "k+1", "k+2"]],
        "r" if name.subscript.is_empty() => return vec![with("B"), with("T")],
        "r" => &[&["B", "T"]],
        "T" => &[&["", "1", "2"]],
        r"\epsilon" => &[&["1", "2", "3", "4"]],
        _ => &[],
    };
    for family in families {
        if family.contains(&name.subscript.as_str()) {
            others.extend(
                family
                    .iter()
                    .filter(|other| **other != name.subscript)
                    .map(|other| with(other)),
            );
        }
    }
    if name.mark == "-" && !name.accents.is_empty() {
        others.push(Name {
            mark: "+".into(),
            ..name.clone()
        });
    }
    others
}

fn other_functions(name: &Name) -> Vec<Name> {
    let plain = |base: &str, subscript: &str| Name {
        base: base.into(),
        subscript: subscript.into(),
        ..Name::default()
    };
    let family = [plain("f", ""), plain("F", "1"), plain("F", "2")];
    if family.contains(name) {
        return family.into_iter().filter(|other| other != name).collect();
    }
    Vec::new()
}

fn sum(mut terms: Vec<Tree>) -> Tree {
    match terms.len() {
        0 => number(0),
        1 => terms.remove(0),
        _ => Tree::Sum(terms),
    }
}

fn product(mut factors: Vec<Tree>) -> Tree {
    match factors.len() {
        0 => number(1),
        1 => factors.remove(0),
        _ => Tree::Product(factors),
    }
}

fn negated(tree: &Tree) -> Tree {
    match tree {
        Tree::Negate(body) => (**body).clone(),
        other => Tree::Negate(Box::new(other.clone())),
    }
}

fn without<T: Clone>(list: &[T], at: usize) -> Vec<T> {
    let kept = list.iter().enumerate().filter(|(n, _)| *n != at);
    kept.map(|(_, item)| item.clone()).collect()
}

fn replaced<T: Clone>(list: &[T], at: usize, new: T) -> Vec<T> {
    let mut list = list.to_vec();
    list[at] = new;
    list
}

fn boxed(tree: Tree) -> Box<Tree> {
    Box::new(tree)
}

/// Every tree that one edit makes of this one.
pub fn edits(tree: &Tree) -> Vec<Tree> {
    let at = At::default();
    let mut found = vec![];
    let squared = |tree: &Tree| Tree::Power(boxed(tree.clone()), 2, at);
    match tree {
        // the paper has none
        Tree::Operation(..) => {}
        Tree::Number(value) => {
            let one = Rational::from_integer(1);
            let less = value.clone() - one.clone();
            found.push(Tree::Number(value.clone() + one));
            found.push(Tree::Number(less));
        }
        Tree::Symbol(name, _) => {
            found.extend(other_names(name).into_iter().map(|name| Tree::Symbol(name, at)));
            if name.base != "t" {
                found.push(squared(tree));
            }
        }
        Tree::Call(name, argument, _) => {
            found.extend(
                other_functions(name)
                    .into_iter()
                    .map(|name| Tree::Call(name, argument.clone(), at)),
            );
            found.extend(
                edits(argument)
                    .into_iter()
                    .map(|argument| Tree::Call(name.clone(), boxed(argument), at)),
            );
            if name.mark == "-" {
                let name = Name {
                    mark: "+".into(),
                    ..name.clone()
                };
                found.push(Tree::Call(name, argument.clone(), at));
            }
            found.push(squared(tree));
        }
        Tree::Partial { of, by, .. } => found.extend(partials(of, by)),
        Tree::Invariant { kind, of, .. } => {
            let kind = if *kind == Invariant::Trace {
                Invariant::Determinant
            } else {
                Invariant::Trace
            };
            found.push(Tree::Invariant {
                kind,
                of: of.clone(),
                at,
            });
            found.extend(["1", "2"].map(|subscript| Tree::Invariant {
                kind: if kind == Invariant::Trace {
                    Invariant::Determinant
                } else {
                    Invariant::Trace
                },
                of: Name {
                    subscript: subscript.into(),
                    ..of.clone()
                },
                at,
            }));
        }
        Tree::Negate(body) => {
            found.push((**body).clone());
            found.extend(edits(body).into_iter().map(|body| Tree::Negate(boxed(body))));
        }
        Tree::Sum(terms) => of_sum(terms, &mut found),
        Tree::Product(factors) => of_product(factors, &mut found),
        Tree::Quotient(above, below, _) => {
            let quotient = |above: Tree, below: Tree| Tree::Quotient(boxed(above), boxed(below), at);
            found.push((**above).clone());
            found.push(quotient(number(1), (**below).clone()));
            found.push(quotient((**below).clone(), (**above).clone()));
            found.push(quotient(negated(above), (**below).clone()));
            found.push(squared(tree));
            found.extend(edits(above).into_iter().map(|above| quotient(above, (**below).clone())));
            found.extend(edits(below).into_iter().map(|below| quotient((**above).clone(), below)));
            // One term of the numerator beside the fraction, and one factor or term of the denominator above.
            if let Tree::Sum(terms) = &**above {
                for n in 0..terms.len() {
                    found.push(Tree::Sum(vec![
                        quotient(sum(without(terms, n)), (**below).clone()),
                        terms[n].clone(),
                    ]));
                }
            }
            if let Tree::Product(factors) = &**below {
                for n in 0..factors.len() {
                    let above = product(vec![(**above).clone(), factors[n].clone()]);
                    found.push(quotient(above, product(without(factors, n))));
                }
            }
        }
        Tree::Power(base, exponent, _) => {
            found.push(Tree::Power(base.clone(), exponent + 1, at));
            found.push(Tree::Power(base.clone(), exponent - 1, at));
            found.extend(
                edits(base)
                    .into_iter()
                    .map(|base| Tree::Power(boxed(base), *exponent, at)),
            );
        }
        Tree::RealPower(base, exponent, _) => {
            found.push((**base).clone());
            let with = |exponent| Tree::RealPower(base.clone(), boxed(exponent), at);
            found.extend(edits(exponent).into_iter().map(with));
        }
        Tree::Root(body, index, _) => {
            found.push((**body).clone());
            found.extend(edits(body).into_iter().map(|body| Tree::Root(boxed(body), *index, at)));
        }
        Tree::PlusMinus(body) | Tree::MinusPlus(body) => {
            let other = if matches!(tree, Tree::PlusMinus(_)) {
                Tree::MinusPlus
            } else {
                Tree::PlusMinus
            };
            let same = if matches!(tree, Tree::PlusMinus(_)) {
                Tree::PlusMinus
            } else {
                Tree::MinusPlus
            };
            found.extend([(**body).clone(), negated(body), other(body.clone())]);
            found.extend(edits(body).into_iter().map(|body| same(boxed(body))));
        }
    }
    found
}

fn of_sum(terms: &[Tree], found: &mut Vec<Tree>) {
    for (n, term) in terms.iter().enumerate() {
        found.push(sum(without(terms, n)));
        found.push(sum(replaced(terms, n, negated(term))));
        found.extend(edits(term).into_iter().map(|term| Tree::Sum(replaced(terms, n, term))));
        // A bracket that closes later: it takes the next term in.
        if let (Tree::Product(factors), Some(next)) = (term, terms.get(n + 1))
            && let Some(Tree::Sum(inner)) = factors.last()
        {
            let mut longer = inner.clone();
            longer.push(next.clone());
            let factors = replaced(factors, factors.len() - 1, Tree::Sum(longer));
            found.push(sum(without(&replaced(terms, n, Tree::Product(factors)), n + 1)));
        }
    }
}

fn of_product(factors: &[Tree], found: &mut Vec<Tree>) {
    for (n, factor) in factors.iter().enumerate() {
        found.push(product(without(factors, n)));
        found.extend(
            edits(factor)
                .into_iter()
                .map(|factor| Tree::Product(replaced(factors, n, factor))),
        );
        // A bracket that closes earlier: its last term stands outside, or its first before it.
        if let Tree::Sum(terms) = factor {
            for out in [0, terms.len() - 1] {
                let shorter = product(replaced(factors, n, sum(without(terms, out))));
                found.push(Tree::Sum(vec![shorter, terms[out].clone()]));
            }
        }
    }
    found.push(Tree::Negate(boxed(Tree::Product(factors.to_vec()))));
}

/// The derivatives that one edit makes of a derivative, those that the maps of the paper have.
fn partials(of: &Name, by: &Name) -> Vec<Tree> {
    let swapped = |name: &Name| match name.base.as_str() {
        "t" => Name {
            base: "Z".into(),
            accents: vec![r"\dot".into()],
            ..name.clone()
        },
        _ => Name {
            base: "t".into(),
            accents: vec![],
            ..name.clone()
        },
    };
    let later = |name: &Name| ["k", "k+1", "k+2"].iter().position(|index| *index == name.subscript);
    let mut pairs = vec![(swapped(of), by.clone()), (of.clone(), swapped(by))];
    pairs.extend(other_names(of).into_iter().map(|of| (of, by.clone())));
    pairs.extend(other_names(by).into_iter().map(|by| (of.clone(), by)));
    pairs.retain(|(of, by)| later(of) > later(by));
    pairs
        .into_iter()
        .map(|(of, by)| Tree::Partial {
            of,
            by,
            at: At::default(),
        })
        .collect()
}

/// Whether a derivative in the tree is by a quantity that is no earlier.
#[allow(dead_code)]
pub fn is_backward(tree: &Tree) -> bool {
    let later = |name: &Name| ["k", "k+1", "k+2"].iter().position(|index| *index == name.subscript);
    match tree {
        Tree::Partial { of, by, .. } => later(of) <= later(by),
        Tree::Negate(body)
        | Tree::Power(body, ..)
        | Tree::Root(body, ..)
        | Tree::PlusMinus(body)
        | Tree::MinusPlus(body) => is_backward(body),
        Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(is_backward),
        Tree::Quotient(above, below, _) | Tree::RealPower(above, below, _) => is_backward(above) || is_backward(below),
        Tree::Number(_) | Tree::Symbol(..) | Tree::Call(..) | Tree::Invariant { .. } | Tree::Operation(..) => false,
    }
}

/// Every equation that one edit makes of this one, and none twice.
pub fn edited(equation: &Equation, left_too: bool) -> Vec<Equation> {
    let mut found: Vec<Equation> = Vec::new();
    let mut sides: Vec<(Tree, Tree)> = edits(&equation.right)
        .into_iter()
        .map(|right| (equation.left.clone(), right))
        .collect();
    sides.push((equation.left.clone(), negated(&equation.right)));
    if left_too {
        sides.extend(
            edits(&equation.left)
                .into_iter()
                .map(|left| (left, equation.right.clone())),
        );
    }
    for (left, right) in sides {
        let edited = Equation {
            left,
            right,
            ..equation.clone()
        };
        if !found.contains(&edited) && edited != *equation {
            found.push(edited);
        }
    }
    found
}
