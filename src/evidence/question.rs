//! One equation of a claim, asked at a point.

use super::compiler::{Compiler, Unwitnessed};
use super::program::{Env, Node};
use super::space::Slot;
use super::system::System;
use super::tolerance::MOST_DIGITS;
use crate::number::Analytic;
use crate::tex::{Equation, Name, Tree};

/// An equation to be compared.
#[derive(Clone, Debug)]
pub struct Question {
    pub left: Node,
    pub right: Node,
    /// Whether `\pm` stands in it: the left is one of the two.
    pub signed: bool,
    /// The slot of a symbol whose two values are meant, as in `\lambda_{1,2}`.
    pub pair: Option<usize>,
}

/// How far apart two sides are, relative to the size of their terms, and what they are.
#[derive(Clone, Debug)]
pub struct Gap {
    pub relative: f64,
    pub left: f64,
    pub right: f64,
}

impl Gap {
    /// The decimal digits in which the sides agree.
    pub fn digits(&self) -> f64 {
        if self.relative > 0.0 {
            (-self.relative.log10()).clamp(0.0, MOST_DIGITS)
        } else {
            MOST_DIGITS
        }
    }
}

impl Question {
    /// Reads an equation.
    pub fn new(equation: &Equation, compiler: &mut Compiler) -> Result<Self, Unwitnessed> {
        let signed = any(equation, &|tree| {
            matches!(tree, Tree::PlusMinus(_) | Tree::MinusPlus(_))
        });
        let base = match &equation.left {
            Tree::Symbol(name, at) if matches!(name.subscript.as_str(), "1,2" | r"\pm") => Some(Tree::Symbol(
                Name {
                    subscript: String::new(),
                    ..name.clone()
                },
                *at,
            )),
            _ => None,
        };
        let left = compiler.tree(base.as_ref().unwrap_or(&equation.left))?;
        let pair = match (&base, &left) {
            (Some(_), Node::Slot(slot)) => Some(*slot),
            _ => None,
        };
        Ok(Self {
            left,
            right: compiler.tree(&equation.right)?,
            signed: signed || pair.is_some(),
            pair,
        })
    }

    /// The gap at a point; `None` where a side has no value there.
    pub fn gap<T: Analytic>(&self, system: &System, values: &[T], running: &T) -> Option<Gap> {
        let rough: Vec<f64> = values.iter().map(Analytic::to_f64).collect();
        let at = Asked {
            system,
            values,
            rough: &rough,
            running,
        };
        let gap = match (
            self.pair.and_then(|slot| Some((slot, at.quadratic(slot)?))),
            self.signed,
        ) {
            (Some((slot, of)), _) => at.roots(self, slot, of)?,
            (None, false) => at.equal(&self.left, &self.right, None),
            (None, true) => {
                let [a, b] = [true, false].map(|upper| at.equal(&self.left, &self.right, Some(upper)));
                // Not less: NaN is passed over.
                if b.relative < a.relative { b } else { a }
            }
        };
        (gap.relative.is_finite() && gap.left.is_finite() && gap.right.is_finite()).then_some(gap)
    }
}

/// A point at which questions are asked.
struct Asked<'a, T> {
    system: &'a System,
    values: &'a [T],
    rough: &'a [f64],
    running: &'a T,
}

impl<T: Analytic> Asked<'_, T> {
    fn value(&self, node: &Node, upper: Option<bool>) -> T {
        let courses = &self.system.space.courses;
        node.value(&Env {
            values: self.values,
            running: Some(self.running.clone()),
            upper,
            courses,
        })
    }

    fn size(&self, node: &Node, upper: Option<bool>) -> f64 {
        let courses = &self.system.space.courses;
        node.sized(&Env {
            values: self.rough,
            running: Some(self.running.to_f64()),
            upper,
            courses,
        })
        .1
    }

    fn equal(&self, left: &Node, right: &Node, upper: Option<bool>) -> Gap {
        let (a, b) = (self.value(left, upper), self.value(right, upper));
        let size = self.size(left, upper).max(self.size(right, upper));
        let gap = (a.clone() - b.clone()).to_f64().abs();
        Gap {
            relative: if gap == 0.0 { 0.0 } else { gap / size },
            left: a.to_f64(),
            right: b.to_f64(),
        }
    }

    /// A premise with this slot squared.
    fn quadratic(&self, slot: usize) -> Option<&Node> {
        let squared = |node: &Node| match node {
            Node::Power(base, 2) => matches!(base.as_ref(), Node::Slot(known) if *known == slot),
            Node::Product(factors) => {
                factors
                    .iter()
                    .filter(|factor| matches!(factor, Node::Slot(known) if *known == slot))
                    .count()
                    == 2
            }
            _ => false,
        };
        let rows = self.system.rows.iter().map(|row| &row.node);
        rows.chain(&self.system.late).find(|node| node.any(squared))
    }

    /// Whether the two values of the right side are the two roots of a premise, by their sum and product.
    fn roots(&self, question: &Question, slot: usize, premise: &Node) -> Option<Gap> {
        let mut values = self.values.to_vec();
        let mut with = |x: i64| {
            *values.get_mut(slot)? = T::from_integer(x);
            Some(premise.value(&self.system.env(&values)))
        };
        let (c, plus, minus) = (with(0)?, with(1)?, with(-1)?);
        let two = || T::from_integer(2);
        let b = (plus.clone() - minus.clone()) / two();
        let a = (plus + minus) / two() - c.clone();
        let [x, y] = [true, false].map(|upper| self.value(&question.right, Some(upper)));
        let gap = |left: T, right: T, size: f64| Gap {
            relative: (left.clone() - right.clone()).to_f64().abs() / size,
            left: left.to_f64(),
            right: right.to_f64(),
        };
        let (p, q) = (x.to_f64().abs(), y.to_f64().abs());
        let sum = gap(-(b / a.clone()), x.clone() + y.clone(), p + q);
        let product = gap(c / a, x * y, p * q + (p + q).powi(2) / 4.0);
        Some(if sum.relative > product.relative { sum } else { product })
    }
}

/// Whether a slot is one that a reader names.
pub fn is_named(slot: &Slot) -> bool {
    matches!(slot, Slot::Parameter(_) | Slot::Time { .. } | Slot::State { .. })
}

/// Whether any node of an equation passes the test.
pub fn any(equation: &Equation, test: &dyn Fn(&Tree) -> bool) -> bool {
    fn below(tree: &Tree, test: &dyn Fn(&Tree) -> bool) -> bool {
        test(tree)
            || match tree {
                Tree::Number(_) | Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => false,
                Tree::Call(_, body, _) | Tree::Negate(body) | Tree::Power(body, ..) | Tree::Root(body, ..) => {
                    below(body, test)
                }
                Tree::PlusMinus(body) | Tree::MinusPlus(body) => below(body, test),
                Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(|part| below(part, test)),
                Tree::Quotient(a, b, _) | Tree::RealPower(a, b, _) => below(a, test) || below(b, test),
            }
    }
    below(&equation.left, test) || below(&equation.right, test)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_stay_between_none_and_all() {
        let digits = |relative| {
            Gap {
                relative,
                left: 1.0,
                right: 1.0,
            }
            .digits()
        };
        assert_eq!(digits(0.0), MOST_DIGITS);
        assert_eq!(digits(1e-30), MOST_DIGITS);
        assert_eq!(digits(7.0), 0.0);
        assert!((digits(1e-5) - 5.0).abs() < 1e-12);
    }
}
