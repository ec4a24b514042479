//! Formulas written in another way: each rule keeps the value wherever both sides are defined.

use vibro_audit::number::{Field, Rational};
use vibro_audit::tex::{At, Equation, Name, Tree};

/// A small generator of draws.
pub struct Dice(pub u64, /** Whether formulas may be multiplied by times. */ pub bool);

impl Dice {
    pub fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((z ^ (z >> 31)) % sides.max(1) as u64).unwrap()
    }

    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for n in (1..list.len()).rev() {
            list.swap(n, self.roll(n + 1));
        }
    }
}

fn at() -> At {
    At::default()
}

fn number(value: i64) -> Tree {
    Tree::Number(Rational::from_integer(value))
}

fn symbol(base: &str, accent: &str, subscript: &str) -> Tree {
    let accents = [accent]
        .iter()
        .filter(|a| !a.is_empty())
        .map(ToString::to_string)
        .collect();
    Tree::Symbol(
        Name {
            base: base.into(),
            accents,
            subscript: subscript.into(),
            ..Name::default()
        },
        at(),
    )
}

/// A quantity that is zero nowhere on the whole.
fn some(dice: &mut Dice) -> Tree {
    match dice.roll(8) {
        0 => symbol("r", "", "B"),
        1 => symbol("r", "", "T"),
        2 => symbol("d", "", ""),
        3 => symbol("g", r"\overline", ""),
        4 => number(dice.roll(9) as i64 + 2),
        5 if dice.1 => symbol("T", "", "1"),
        6 => Tree::Sum(vec![number(1), symbol("r", "", "T")]),
        7 if dice.1 => symbol("T", "", "2"),
        _ => number(7),
    }
}

fn minus(tree: Tree) -> Tree {
    Tree::Negate(Box::new(tree))
}

fn over(above: Tree, below: Tree) -> Tree {
    Tree::Quotient(Box::new(above), Box::new(below), at())
}

/// The tree after one rule at its root, where one fits.
fn here(tree: &Tree, periodic: bool, dice: &mut Dice) -> Tree {
    let same = || tree.clone();
    match (tree, dice.roll(9)) {
        (Tree::Sum(terms), 0..=2) => {
            let mut terms = terms.clone();
            dice.shuffle(&mut terms);
            Tree::Sum(terms)
        }
        (Tree::Sum(terms), 3) if terms.len() > 2 => {
            let (a, b) = terms.split_at(1 + dice.roll(terms.len() - 1));
            let group = |part: &[Tree]| {
                if part.len() == 1 {
                    part[0].clone()
                } else {
                    Tree::Sum(part.to_vec())
                }
            };
            Tree::Sum(vec![group(a), group(b)])
        }
        (Tree::Sum(terms), 4) => minus(Tree::Sum(terms.iter().map(|term| minus(term.clone())).collect())),
        (Tree::Product(factors), 0 | 1) => {
            let mut factors = factors.clone();
            dice.shuffle(&mut factors);
            Tree::Product(factors)
        }
        (Tree::Product(factors), 2..=5) => {
            let Some(n) = factors.iter().position(|factor| matches!(factor, Tree::Sum(_))) else {
                return same();
            };
            let Tree::Sum(terms) = &factors[n] else { return same() };
            let each = terms.iter().map(|term| {
                let mut factors = factors.clone();
                factors[n] = term.clone();
                Tree::Product(factors)
            });
            Tree::Sum(each.collect())
        }
        (Tree::Quotient(above, below, _), 0) => {
            Tree::Product(vec![(**above).clone(), Tree::Power(below.clone(), -1, at())])
        }
        (Tree::Quotient(above, below, _), 1) => {
            Tree::Product(vec![over(number(1), (**below).clone()), (**above).clone()])
        }
        (Tree::Quotient(above, below, _), 2) => over(minus((**above).clone()), minus((**below).clone())),
        (Tree::Quotient(above, below, _), 3 | 4) => {
            let Tree::Sum(terms) = &**above else { return same() };
            Tree::Sum(terms.iter().map(|term| over(term.clone(), (**below).clone())).collect())
        }
        (Tree::Power(base, exponent, _), 0..=4) if *exponent > 1 => {
            Tree::Product(vec![Tree::Power(base.clone(), exponent - 1, at()), (**base).clone()])
        }
        (Tree::Symbol(name, _), 0..=3) if name.base == "T" => match (name.subscript.as_str(), periodic) {
            ("1", true) if dice.roll(2) == 0 => Tree::Sum(vec![symbol("T", "", ""), minus(symbol("T", "", "2"))]),
            ("1", _) => Tree::Sum(vec![symbol("t", "", "k+1"), minus(symbol("t", "", "k"))]),
            ("2", _) => Tree::Sum(vec![symbol("t", "", "k+2"), minus(symbol("t", "", "k+1"))]),
            ("", true) => Tree::Sum(vec![symbol("T", "", "1"), symbol("T", "", "2")]),
            _ => same(),
        },
        (Tree::Call(name, argument, _), 0..=3) if name.base != "Z" => {
            let Tree::Symbol(time, _) = &**argument else {
                return same();
            };
            let (from, step) = match (time.subscript.as_str(), periodic) {
                ("k+2", true) => return Tree::Call(name.clone(), Box::new(symbol("t", "", "k")), at()),
                ("k", true) => ("k+2", minus(symbol("T", "", ""))),
                ("k+1", _) => ("k", symbol("T", "", "1")),
                ("k+2", _) => ("k+1", symbol("T", "", "2")),
                _ => return same(),
            };
            Tree::Call(
                name.clone(),
                Box::new(Tree::Sum(vec![symbol("t", "", from), step])),
                at(),
            )
        }
        (_, 5) => {
            let a = some(dice);
            Tree::Sum(vec![a.clone(), same(), minus(a)])
        }
        (_, 6) => {
            let a = some(dice);
            over(Tree::Product(vec![a.clone(), same()]), a)
        }
        (_, 7) => minus(minus(same())),
        (_, 8) if dice.roll(2) == 0 => Tree::Sum(vec![over(same(), number(2)), over(same(), number(2))]),
        _ => same(),
    }
}

/// The tree rewritten at random places; the dice say how much.
pub fn rewrite(tree: &Tree, periodic: bool, dice: &mut Dice) -> Tree {
    let mut inner = |tree: &Tree| rewrite(tree, periodic, dice);
    let rebuilt = match tree {
        Tree::Sum(terms) => Tree::Sum(terms.iter().map(inner).collect()),
        Tree::Product(factors) => Tree::Product(factors.iter().map(inner).collect()),
        Tree::Quotient(above, below, at) => Tree::Quotient(Box::new(inner(above)), Box::new(inner(below)), *at),
        Tree::Negate(body) => minus(inner(body)),
        Tree::Power(base, exponent, at) => Tree::Power(Box::new(inner(base)), *exponent, *at),
        leaf => leaf.clone(),
    };
    if dice.roll(4) == 0 {
        here(&rebuilt, periodic, dice)
    } else {
        rebuilt
    }
}

/// The equation with both sides rewritten, and terms or factors moved across.
pub fn equation(equation: &Equation, periodic: bool, dice: &mut Dice) -> Equation {
    let left = match &equation.left {
        Tree::Symbol(..) => equation.left.clone(),
        other => rewrite(other, periodic, dice),
    };
    let right = rewrite(&equation.right, periodic, dice);
    let (left, right) = match dice.roll(8) {
        0 => (Tree::Sum(vec![left, minus(right)]), number(0)),
        1 => (number(0), Tree::Sum(vec![right, minus(left)])),
        2 => (right, left),
        3 => (minus(left), minus(right)),
        4 => {
            let a = some(dice);
            (Tree::Product(vec![a.clone(), left]), Tree::Product(vec![right, a]))
        }
        5 => {
            let a = some(dice);
            (Tree::Sum(vec![left, a.clone()]), Tree::Sum(vec![a, right]))
        }
        _ => (left, right),
    };
    Equation {
        left,
        right,
        ..equation.clone()
    }
}

/// The same TeX in another spelling.
pub fn spelling(tex: &str, dice: &mut Dice) -> String {
    let mut tex = tex.to_string();
    for (from, to) in [
        (r"\overline{g}", r"\bar g"),
        (r"\overline{g}", r"\bar{g}"),
        (r"\dot{Z}_k", r"{\dot Z}_k"),
        (r"\dot{Z}_", r"\dot Z_"),
        (r"\frac", r"\dfrac"),
        (r"\frac", r"\tfrac"),
        ("r_B", "r_{B}"),
        ("T_1", "T_{1}"),
        ("T_2", r"{T_2}"),
        ("(", r"\left("),
        (" + ", r"\,+\; "),
        ("t_{k+1}", "t_{k + 1}"),
        ("t_k", "t_{k}"),
        (" = ", " &= "),
        ("^2", "^{2}"),
        ("[", r"\bigl["),
    ] {
        if dice.roll(3) == 0 {
            tex = tex.replace(from, to);
            if from == "(" {
                tex = tex.replace(')', r"\right)");
            }
            if from == "[" {
                tex = tex.replace(']', r"\bigr]");
            }
        }
    }
    if dice.roll(2) == 0 { tex + "," } else { tex }
}
