//! Conjugates, real and imaginary parts, moduli and arguments: each complex symbol is written with two real ones,
//! z = x + i y, and each formula as a pair of real formulas, its real and its imaginary part. An equation is two, one
//! of each part, and no complex number is left.
//!
//! What has another meaning over the complex numbers than over the real ones (roots, logarithms, powers, inverse
//! functions) is read where its argument is real and, by a lemma, in the real domain: there its principal value is
//! the real one.

use super::super::premise::{Premise, Statements};
use super::build::{
    call, difference, integer, is_zero, negative, plain, power, product, quotient, real_power, root, sum, symbol,
};
use super::factorial::is_integer;
use super::law::{names_function, value_of};
use super::{Goal, Reduced, Rule, fresh_like, rewritten, trees};
use numbers::{Field, Rational};
use std::collections::BTreeMap;
use texmath::{
    At, Condition, Elementary, Equation, Map, Meaning, Name, Operation, Relation, Symbols, Tree, any, any_side,
    nodes_of, number_of, pair_of, rewrite,
};

/// The largest formula of a part, in nodes.
const LARGEST: usize = 20_000;

/// The highest power that is multiplied out.
const HIGHEST: i32 = 16;

/// The most moduli of an inequality that are compared with each other.
const MOST_MODULI: usize = 3;

/// The deepest values of functions within each other.
const DEEPEST: usize = 20;

const CONJUGATE: &str = r"\conjugate";

/// Whether claim, premises or conditions need real and imaginary parts to be told what they say.
pub(super) fn takes_part(statements: &Statements, symbols: &Symbols) -> bool {
    let trees = trees(statements).into_iter();
    let trees: Vec<Tree> = trees.map(|tree| meant(tree, symbols)).collect();
    let is_complex = |tree: &Tree| any(tree, &mut |node| is_complex(node, symbols));
    trees.iter().any(|tree| has_part(tree, symbols))
        || (trees.iter().any(|tree| any(tree, &mut is_modulus)) && trees.iter().any(is_complex))
}

fn meant(tree: &Tree, symbols: &Symbols) -> Tree {
    rewrite(tree, &|name| symbols.meaning(name, &|_| false))
}

fn is_complex(node: &Tree, symbols: &Symbols) -> bool {
    matches!(node, Tree::Symbol(..)) && symbols.may_be_complex(node)
}

fn is_modulus(node: &Tree) -> bool {
    matches!(node, Tree::Call(name, ..) if name.base == r"\abs")
}

/// Whether a conjugate, a real or imaginary part, an argument or the modulus of what may be complex stands in a tree.
fn has_part(tree: &Tree, symbols: &Symbols) -> bool {
    any(tree, &mut |node| match node {
        Tree::Symbol(name, _) => symbols.conjugated(name).is_some(),
        Tree::Call(name, inner, _) if name.base == r"\abs" => any(inner, &mut |node| is_complex(node, symbols)),
        Tree::Call(name, ..) => matches!(name.base.as_str(), CONJUGATE | r"\Re" | r"\Im" | r"\arg"),
        _ => false,
    })
}

/// Refuses derivatives and integrals of what is not analytic: the rules for them are not those of real functions.
pub(super) fn refuse_inside(statements: &Statements, symbols: &Symbols) -> Result<(), String> {
    for tree in trees(statements) {
        let mut is_inside = |node: &Tree| match node {
            Tree::Operation(operation, _) => {
                matches!(**operation, Operation::Derivative { .. } | Operation::Integral { .. })
                    && has_part(&meant(node, symbols), symbols)
            }
            _ => false,
        };
        if any(tree, &mut is_inside) {
            let problem = "a conjugate, a real or imaginary part or a modulus within a derivative or an integral";
            return Err(problem.to_owned());
        }
    }
    Ok(())
}

/// The goals of a claim as goals about real numbers.
pub(super) fn as_real(reduced: Reduced, symbols: &Symbols) -> Result<Reduced, String> {
    let goals = reduced.sufficient.iter().chain(&reduced.necessary);
    let is_left = |goal: &Goal| takes_part(&goal.statements, &goal.symbols);
    if !goals.chain(&reduced.lemmas).any(is_left) {
        return Ok(reduced);
    }
    if !reduced.is_equivalent || !reduced.lemmas.is_empty() {
        return Err(
            "conjugates, real and imaginary parts and moduli in a sum of symbolic length or an integral".into(),
        );
    }
    refuse_elsewhere(symbols)?;
    let (mut sufficient, mut lemmas): (Vec<Goal>, Vec<Goal>) = (Vec::new(), Vec::new());
    for goal in &reduced.sufficient {
        let (goal, needed) = in_parts(goal)?;
        sufficient.push(goal);
        lemmas.extend(needed);
    }
    Ok(Reduced {
        lemmas,
        necessary: sufficient.clone(),
        sufficient,
        ..reduced
    })
}

/// Refuses complex numbers in what the symbol table says beyond names: it is not rewritten.
fn refuse_elsewhere(symbols: &Symbols) -> Result<(), String> {
    let relations = symbols.relations.iter().chain(&symbols.laws);
    let relations = relations.flat_map(|relation| [&relation.left, &relation.right]);
    let derivatives = symbols.functions().filter_map(|(_, tree)| tree);
    let periods = symbols.periods().map(|(_, tree)| tree);
    let lists = [
        Meaning::Positive,
        Meaning::Nonnegative,
        Meaning::Nonzero,
        Meaning::Integer,
        Meaning::Generic,
    ];
    let listed = symbols.abbreviations();
    let listed = listed.filter(|(name, _)| lists.iter().any(|kind| symbols.is(name, kind)));
    let listed = listed.map(|(_, tree)| tree);
    let maps = symbols.maps().flat_map(|(_, map)| match map {
        Map::Equations(equations) => equations.as_slice(),
        _ => &[],
    });
    let maps = maps.flat_map(|equation| [&equation.left, &equation.right]);
    let mut said = relations.chain(derivatives).chain(periods).chain(listed).chain(maps);
    let holds = |tree: &Tree| {
        let tree = meant(tree, symbols);
        any(&tree, &mut |node| is_complex(node, symbols)) || has_part(&tree, symbols)
    };
    if said.any(holds) || symbols.generic().any(|name| symbols.is_complex(name)) {
        let problem =
            "what [symbols] says of complex numbers is not split into real and imaginary parts: write premises";
        return Err(problem.to_owned());
    }
    Ok(())
}

/// A goal about real numbers that says the same, and what must hold for it to.
fn in_parts(goal: &Goal) -> Result<(Goal, Vec<Goal>), String> {
    let symbols = &goal.symbols;
    let statements = rewritten(&goal.statements, Rule::Definitions, &|tree| meant(tree, symbols));
    let parts = parts_of_symbols(&statements, symbols)?;
    let real = symbols.with_parts(&parts);
    let mut splitter = Splitter {
        symbols,
        parts: &parts,
        statements: &statements,
        depth: 0,
        written: Vec::new(),
        written_out: Vec::new(),
        needed: Vec::new(),
    };
    let mut out = Statements {
        premises: Vec::new(),
        claims: Vec::new(),
        assume: Vec::new(),
        ..statements.clone().by(Rule::ComplexParts)
    };
    // of what a lemma speaks it may rest on what needs none
    let mut plain_ones = out.clone();
    for (_, [re, im]) in parts.iter().filter(|(name, _)| symbols.is_nonzero(name)) {
        let squares = sum(vec![power(symbol(re), 2), power(symbol(im), 2)]);
        let condition = Condition::Relation(Equation {
            relation: Relation::NotEqual,
            ..Equation::between(squares, integer(0))
        });
        out.assume.push(condition.clone());
        plain_ones.assume.push(condition);
    }
    for condition in &statements.assume {
        let before = splitter.needed.len();
        let conditions = splitter.condition(condition)?;
        if splitter.needed.len() == before {
            plain_ones.assume.extend(conditions.iter().cloned());
        }
        out.assume.extend(conditions);
    }
    for premise in &statements.premises {
        let before = splitter.needed.len();
        let premises = splitter.premise(premise)?;
        if splitter.needed.len() == before {
            plain_ones.premises.extend(premises.iter().cloned());
        }
        out.premises.extend(premises);
    }
    for claim in &statements.claims {
        if matches!(&claim.left, Tree::Symbol(name, _) if pair_of(name).is_some()) && !splitter.is_real(claim)? {
            return Err("a pair of complex values: write one equation for each".to_owned());
        }
        out.claims.extend(splitter.equations(claim)?);
        let known = splitter.cauchy_schwarz(claim)?;
        if !known.is_empty() {
            out = out.by(Rule::CauchySchwarz);
        }
        out.premises.extend(known);
    }
    let written_out = std::mem::take(&mut splitter.written_out);
    for statements in [&mut out, &mut plain_ones] {
        drop_definitions(statements, &written_out, symbols);
    }
    let mut lemmas: Vec<Goal> = Vec::new();
    for claim in std::mem::take(&mut splitter.needed) {
        let part = claim.to_string();
        if lemmas.iter().all(|lemma| lemma.part != part) {
            let alone = Statements {
                claims: vec![claim],
                ..plain_ones.clone()
            };
            lemmas.push(Goal::of(&alone, &real, part));
        }
    }
    Ok((Goal::of(&out, &real, goal.part.clone()), lemmas))
}

/// Drops the premises that say what a function is whose values are written out, where nothing else speaks of it.
fn drop_definitions(statements: &mut Statements, functions: &[Name], symbols: &Symbols) {
    let speaks = |tree: &Tree, function: &Name| {
        let mut names = |node: &Tree| matches!(node, Tree::Call(name, ..) | Tree::Symbol(name, _) if name.bare() == function.bare());
        any(tree, &mut names)
    };
    let is_alone = |function: &Name| {
        let is_listed = |name: &Name, tree: Option<&Tree>| {
            (name == function && tree.is_some()) || tree.is_some_and(|tree| speaks(tree, function))
        };
        !symbols.functions().any(|(name, tree)| is_listed(name, tree))
            && !symbols.periods().any(|(name, tree)| is_listed(name, Some(tree)))
    };
    for _ in functions {
        for function in functions.iter().filter(|function| is_alone(function)) {
            let (own, others): (Vec<Premise>, Vec<Premise>) = statements
                .premises
                .drain(..)
                .partition(|premise| names_function(&premise.equation.left, function).is_some());
            statements.premises = others;
            if own.len() > 1 || trees(statements).into_iter().any(|tree| speaks(tree, function)) {
                statements.premises.extend(own);
            }
        }
    }
}

/// The names of the real and the imaginary part of each complex symbol.
fn parts_of_symbols(statements: &Statements, symbols: &Symbols) -> Result<BTreeMap<Name, [Name; 2]>, String> {
    let mut parts = BTreeMap::new();
    let mut met: Vec<Name> = Vec::new();
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if let Tree::Symbol(name, _) = node
                && is_complex(node, symbols)
            {
                let plain = symbols.conjugated(name).map(|(plain, _)| plain);
                met.push(plain.unwrap_or_else(|| name.clone()));
            }
            false
        });
    }
    met.retain(|name| !symbols.is_unit(name));
    met.sort();
    met.dedup();
    let mut own = symbols.clone();
    for name in met {
        if !symbols.is_parameter(&name) || symbols.running() == Some(&name) {
            return Err(format!("`{name}` runs and is complex: it is not split into its parts"));
        }
        let mut part = |letter: &str| {
            let like = Name {
                subscript: name.to_string().replace(['\\', '{', '}', '_', ' '], ""),
                ..plain(letter)
            };
            let part = fresh_like(statements, &own, like);
            own.let_be_parameter(&part, false);
            part
        };
        let both = [part("x"), part("y")];
        parts.insert(name, both);
    }
    Ok(parts)
}

/// A real and an imaginary part, each a formula of real numbers.
#[derive(Clone, Debug)]
struct Pair {
    re: Tree,
    im: Tree,
}

impl Pair {
    fn real(re: Tree) -> Self {
        Self { re, im: integer(0) }
    }

    fn conjugate(self) -> Self {
        Self {
            im: negative(self.im),
            ..self
        }
    }

    fn times(self, other: Self) -> Self {
        let of = |one: &Tree, other: &Tree| product(vec![one.clone(), other.clone()]);
        Self {
            re: difference(of(&self.re, &other.re), of(&self.im, &other.im)),
            im: sum(vec![of(&self.re, &other.im), of(&self.im, &other.re)]),
        }
    }

    fn square_of_modulus(&self) -> Tree {
        sum([&self.re, &self.im].map(|part| squared(part.clone())).to_vec())
    }
}

/// The square of a tree; 0 of 0.
fn squared(tree: Tree) -> Tree {
    match is_zero(&tree) {
        true => tree,
        false => power(tree, 2),
    }
}

fn less(left: Tree, relation: Relation) -> Equation {
    Equation {
        relation,
        ..Equation::between(left, integer(0))
    }
}

/// Splits formulas into their parts.
struct Splitter<'a> {
    symbols: &'a Symbols,
    parts: &'a BTreeMap<Name, [Name; 2]>,
    statements: &'a Statements,
    /// How deep the values of functions go that are written out.
    depth: usize,
    /// What the formula split last must have a value for, whether or not it stands in its parts.
    written: Vec<Tree>,
    /// The functions of which values at complex arguments are written out.
    written_out: Vec<Name>,
    /// What must hold for the parts to be those of the formula.
    needed: Vec<Equation>,
}

impl Splitter<'_> {
    fn condition(&mut self, condition: &Condition) -> Result<Vec<Condition>, String> {
        match condition {
            Condition::Relation(relation) => {
                let relations = self.without_signs(relation)?;
                Ok(relations.into_iter().map(Condition::Relation).collect())
            }
            Condition::Integer(tree) => {
                self.written.clear();
                let Pair { re, im } = self.pair(tree)?;
                let im = (!is_zero(&im)).then(|| Condition::Relation(Equation::between(im, integer(0))));
                let written = std::mem::take(&mut self.written);
                let written = written.into_iter().map(|tree| Equation::between(tree.clone(), tree));
                let written = written.map(Condition::Relation);
                Ok(im.into_iter().chain(written).chain([Condition::Integer(re)]).collect())
            }
        }
    }

    fn premise(&mut self, premise: &Premise) -> Result<Vec<Premise>, String> {
        let mut assume = Vec::new();
        for condition in &premise.assume {
            assume.extend(self.condition(condition)?);
        }
        let equations = self.without_signs(&premise.equation)?;
        let own = |equation| Premise {
            equation,
            assume: assume.clone(),
            ..premise.clone()
        };
        Ok(equations.into_iter().map(own).collect())
    }

    /// What an equation says that is taken as true.
    fn without_signs(&mut self, equation: &Equation) -> Result<Vec<Equation>, String> {
        let mut is_sign = |node: &Tree| matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_));
        match any_side(equation, &mut is_sign) {
            true => Err(format!("`{equation}`: a premise or condition with two signs")),
            false => self.equations(equation),
        }
    }

    /// Whether both sides are real by their form.
    fn is_real(&mut self, equation: &Equation) -> Result<bool, String> {
        let (left, right) = (self.pair(&equation.left)?, self.pair(&equation.right)?);
        Ok(is_zero(&left.im) && is_zero(&right.im))
    }

    /// What an equation or inequality says, of real numbers.
    fn equations(&mut self, equation: &Equation) -> Result<Vec<Equation>, String> {
        self.written.clear();
        let (left, right) = match self.squares(equation)? {
            Some([left, right]) => (Pair::real(left), Pair::real(right)),
            None => (self.pair(&equation.left)?, self.pair(&equation.right)?),
        };
        let of = |left: &Tree, right: &Tree| Equation {
            left: left.clone(),
            right: right.clone(),
            ..equation.clone()
        };
        let (no_re, no_im) = (
            is_zero(&left.re) && is_zero(&right.re),
            is_zero(&left.im) && is_zero(&right.im),
        );
        let mut all = match equation.relation {
            _ if no_im => vec![of(&left.re, &right.re)],
            Relation::Equal | Relation::NotEqual if no_re => vec![of(&left.im, &right.im)],
            Relation::Equal => vec![of(&left.re, &right.re), of(&left.im, &right.im)],
            Relation::NotEqual => {
                let apart = Pair {
                    re: difference(left.re, right.re),
                    im: difference(left.im, right.im),
                };
                vec![of(&apart.square_of_modulus(), &integer(0))]
            }
            _ => return Err(format!("`{equation}`: complex values have no order")),
        };
        for equation in &all {
            if nodes_of(&equation.left).max(nodes_of(&equation.right)) > LARGEST {
                return Err("the real or imaginary part is too large".to_owned());
            }
        }
        let mut lost: Vec<Tree> = Vec::new();
        for tree in std::mem::take(&mut self.written) {
            let divisor = match &tree {
                Tree::Quotient(_, below, _) => Some(&**below),
                _ => None,
            };
            let mut stands = |node: &Tree| match node {
                Tree::Quotient(_, below, _) => *node == tree || divisor == Some(&**below),
                node => *node == tree,
            };
            if !all.iter().any(|equation| any_side(equation, &mut stands)) && !lost.contains(&tree) {
                lost.push(tree);
            }
        }
        all.extend(lost.into_iter().map(|tree| Equation {
            relation: Relation::Equal,
            ..of(&tree, &tree)
        }));
        Ok(all)
    }

    /// The squares of both sides, which compare as the sides do where neither is negative: without the roots of moduli.
    fn squares(&mut self, equation: &Equation) -> Result<Option<[Tree; 2]>, String> {
        let symbols = self.symbols;
        let mut is_root = |node: &Tree| match node {
            Tree::Call(_, inner, _) if is_modulus(node) => any(inner, &mut |node| is_complex(node, symbols)),
            _ => false,
        };
        if !any_side(equation, &mut is_root) {
            return Ok(None);
        }
        let [left, right] = [self.square(&equation.left)?, self.square(&equation.right)?];
        Ok(left.zip(right).map(|(left, right)| [left, right]))
    }

    /// The square of what is not negative by its form.
    fn square(&mut self, tree: &Tree) -> Result<Option<Tree>, String> {
        Ok(match tree {
            Tree::Call(_, inner, _) if is_modulus(tree) => Some(self.square_of_modulus(inner)?),
            Tree::Product(factors) => {
                let squares = factors.iter().map(|factor| self.square(factor));
                let squares: Option<Vec<Tree>> = squares.collect::<Result<_, _>>()?;
                squares.map(product)
            }
            Tree::Quotient(above, below, _) => match (self.square(above)?, self.square(below)?) {
                (Some(above), Some(below)) => Some(self.quotient(Pair::real(above), Pair::real(below)).re),
                _ => None,
            },
            tree => {
                let Pair { re, im } = self.pair(tree)?;
                let is_known = is_zero(&im) && self.sign(&re).is_some();
                is_known.then(|| squared(re))
            }
        })
    }

    /// |u| |v| is no less than the real part of u times the conjugate of v, nor than its opposite, for the moduli that an
    /// inequality speaks of: what triangle inequalities rest on. Where it speaks of a real or an imaginary part, this holds of both
    /// parts of that product and of u v.
    fn cauchy_schwarz(&mut self, equation: &Equation) -> Result<Vec<Premise>, String> {
        let symbols = self.symbols;
        let mut met: Vec<Tree> = Vec::new();
        any_side(equation, &mut |node| {
            if let Tree::Call(_, inner, _) = node
                && is_modulus(node)
                && any(inner, &mut |node| is_complex(node, symbols))
                && !has_part(inner, symbols)
                && !met.contains(inner)
            {
                met.push((**inner).clone());
            }
            false
        });
        let is_order = !matches!(equation.relation, Relation::Equal | Relation::NotEqual);
        if !is_order || !(2..=MOST_MODULI).contains(&met.len()) {
            return Ok(Vec::new());
        }
        let is_component =
            |node: &Tree| matches!(node, Tree::Call(name, ..) if [r"\Re", r"\Im"].contains(&name.base.as_str()));
        let has_component = any_side(equation, &mut |node| is_component(node));
        let mut facts = Vec::new();
        for (place, one) in met.iter().enumerate() {
            for other in met.iter().skip(place + 1) {
                let moduli = product(vec![self.modulus(one)?, self.modulus(other)?]);
                let crossed = self.pair(one)?.times(self.pair(other)?.conjugate());
                let mut bounds = vec![crossed.re.clone()];
                if has_component {
                    let plain = self.pair(one)?.times(self.pair(other)?);
                    bounds.extend([crossed.im, plain.re, plain.im]);
                }
                for bound in bounds.into_iter().flat_map(|bound| [bound.clone(), negative(bound)]) {
                    let equation = Equation {
                        relation: Relation::GreaterOrEqual,
                        ..Equation::between(moduli.clone(), bound)
                    };
                    facts.push(Premise::known("the Cauchy-Schwarz inequality", equation));
                }
            }
        }
        Ok(facts)
    }

    /// Notes that a tree must have a value.
    fn noted(&mut self, tree: Tree) -> Tree {
        self.written.push(tree.clone());
        tree
    }

    fn need(&mut self, equation: Equation) {
        self.needed.push(equation);
    }

    /// The real number that a tree is; a lemma says so where its form does not.
    fn real(&mut self, tree: &Tree) -> Result<Tree, String> {
        let Pair { re, im } = self.pair(tree)?;
        if !is_zero(&im) {
            self.need(Equation::between(im, integer(0)));
        }
        Ok(re)
    }

    /// The same of a number above 0.
    fn positive(&mut self, tree: &Tree) -> Result<Tree, String> {
        let real = self.real(tree)?;
        if self.sign(&real) != Some(true) {
            self.need(less(real.clone(), Relation::Greater));
        }
        Ok(real)
    }

    fn pair(&mut self, tree: &Tree) -> Result<Pair, String> {
        Ok(match tree {
            Tree::Number(_) => Pair::real(tree.clone()),
            Tree::Symbol(name, _) => self.of_symbol(name, tree)?,
            Tree::Negate(inner) => {
                let Pair { re, im } = self.pair(inner)?;
                Pair {
                    re: negative(re),
                    im: negative(im),
                }
            }
            Tree::Sum(terms) => {
                let terms: Vec<Pair> = terms.iter().map(|term| self.pair(term)).collect::<Result<_, _>>()?;
                Pair {
                    re: sum(terms.iter().map(|term| term.re.clone()).collect()),
                    im: sum(terms.into_iter().map(|term| term.im).collect()),
                }
            }
            Tree::Product(factors) => {
                let mut total = Pair::real(integer(1));
                for factor in factors {
                    total = total.times(self.pair(factor)?);
                    if nodes_of(&total.re) > LARGEST {
                        return Err("the real part is too large".to_owned());
                    }
                }
                total
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.pair(above)?, self.pair(below)?);
                self.quotient(above, below)
            }
            Tree::Power(base, exponent, _) => self.of_power(base, *exponent)?,
            Tree::RealPower(base, exponent, _) => self.of_real_power(base, exponent)?,
            Tree::Root(radicand, index, at) => self.of_root(radicand, *index, *at)?,
            Tree::Call(name, argument, at) => self.of_call(name, argument, *at)?,
            Tree::PlusMinus(inner) => {
                let Pair { re, im } = self.pair(inner)?;
                let signed = |part: Tree| match is_zero(&part) {
                    true => part,
                    false => Tree::PlusMinus(Box::new(part)),
                };
                Pair {
                    re: signed(re),
                    im: signed(im),
                }
            }
            Tree::MinusPlus(inner) => {
                let upper = Tree::Negate(Box::new(Tree::PlusMinus(inner.clone())));
                self.pair(&upper)?
            }
            Tree::Partial { .. } | Tree::Invariant { .. } | Tree::Operation(..) => {
                return Err(format!("the real and imaginary part of `{tree}`"));
            }
        })
    }

    fn of_symbol(&self, name: &Name, tree: &Tree) -> Result<Pair, String> {
        let (plain, is_conjugate) = match self.symbols.conjugated(name) {
            Some(found) => found,
            None => (name.clone(), false),
        };
        let pair = match self.parts.get(&plain) {
            Some([re, im]) => Pair {
                re: symbol(re),
                im: symbol(im),
            },
            None if self.symbols.is_unit(&plain) => Pair {
                re: integer(0),
                im: integer(1),
            },
            None if self.symbols.may_be_complex(tree) => return Err(format!("the parts of `{name}`")),
            None => Pair::real(tree.clone()),
        };
        Ok(match is_conjugate {
            true => pair.conjugate(),
            false => pair,
        })
    }

    /// The quotient, by the conjugate of its divisor, whose modulus must not be 0.
    fn quotient(&mut self, above: Pair, below: Pair) -> Pair {
        if is_zero(&below.im) {
            self.noted(Tree::Quotient(
                Box::new(integer(1)),
                Box::new(below.re.clone()),
                At::default(),
            ));
            return Pair {
                re: quotient(above.re, below.re.clone()),
                im: quotient(above.im, below.re),
            };
        }
        if is_zero(&below.re) {
            // (a + i b)/(i d) = (b - i a)/d
            let turned = Pair {
                re: above.im,
                im: negative(above.re),
            };
            return self.quotient(turned, Pair::real(below.im));
        }
        let square = below.square_of_modulus();
        let above = above.times(below.conjugate());
        self.quotient(above, Pair::real(square))
    }

    fn of_power(&mut self, base: &Tree, exponent: i32) -> Result<Pair, String> {
        if exponent == 0 {
            return Err("a power with exponent 0".to_owned());
        }
        if let Tree::Call(name, inner, _) = base
            && name.base == r"\abs"
            && exponent % 2 == 0
        {
            let square = self.square_of_modulus(inner)?;
            let whole = power(square, exponent / 2);
            return Ok(Pair::real(self.raised(whole, exponent)));
        }
        let pair = self.pair(base)?;
        if is_zero(&pair.im) {
            let whole = power(pair.re, exponent);
            return Ok(Pair::real(self.raised(whole, exponent)));
        }
        if exponent < 0 {
            let below = self.of_power(base, exponent.checked_neg().ok_or("so high a power")?)?;
            return Ok(self.quotient(Pair::real(integer(1)), below));
        }
        if is_zero(&pair.re) {
            let whole = power(pair.im, exponent);
            let (zero, minus) = (integer(0), negative(whole.clone()));
            let (re, im) = match exponent % 4 {
                0 => (whole, zero),
                1 => (zero, whole),
                2 => (minus, zero),
                _ => (zero, minus),
            };
            return Ok(Pair { re, im });
        }
        if exponent > HIGHEST {
            return Err(format!("a power of a complex number above the {HIGHEST}th"));
        }
        // by the binomial theorem
        let (mut re, mut im): (Vec<Tree>, Vec<Tree>) = (Vec::new(), Vec::new());
        let mut factor: i64 = 1;
        for k in 0..=exponent {
            let term = product(vec![
                integer(factor),
                power(pair.re.clone(), exponent - k),
                power(pair.im.clone(), k),
            ]);
            let term = if k % 4 >= 2 { negative(term) } else { term };
            match k % 2 {
                0 => re.push(term),
                _ => im.push(term),
            }
            factor = factor * i64::from(exponent - k) / i64::from(k + 1);
        }
        Ok(Pair {
            re: sum(re),
            im: sum(im),
        })
    }

    /// A power as it is; that of a negative exponent must have a value.
    fn raised(&mut self, whole: Tree, exponent: i32) -> Tree {
        match exponent < 0 {
            true => self.noted(whole),
            false => whole,
        }
    }

    fn of_real_power(&mut self, base: &Tree, exponent: &Tree) -> Result<Pair, String> {
        if self.symbols.transposes(exponent) {
            return Err(format!("the transpose of `{base}`"));
        }
        if self.is_euler(base) {
            let exponent = self.pair(exponent)?;
            return Ok(exponential(exponent));
        }
        if is_integer(exponent, self.symbols) {
            let pair = self.pair(base)?;
            let nonzero = |name: &Name| self.symbols.is_nonzero(name);
            let is_nonzero = match &pair.re {
                Tree::Symbol(name, _) if nonzero(name) => true,
                re => {
                    self.sign(re) == Some(true) || number_of(re).is_some_and(|value| value != Rational::from_integer(0))
                }
            };
            return match is_zero(&pair.im) && is_nonzero {
                true => Ok(Pair::real(self.noted(real_power(pair.re, exponent.clone())))),
                false => Err(format!("a symbolic power of `{base}`, which may be complex or 0")),
            };
        }
        let base = self.positive(base)?;
        let Pair { re, im } = self.pair(exponent)?;
        if is_zero(&im) {
            return Ok(Pair::real(self.noted(real_power(base, re))));
        }
        let logarithm = self.noted(call(r"\ln", base));
        let times = |part: Tree| product(vec![part, logarithm.clone()]);
        Ok(exponential(Pair {
            re: times(re),
            im: times(im),
        }))
    }

    fn is_euler(&self, base: &Tree) -> bool {
        let euler = plain("e");
        matches!(base, Tree::Symbol(name, _) if *name == euler) && !self.symbols.declares(&euler)
    }

    fn of_root(&mut self, radicand: &Tree, index: u32, at: At) -> Result<Pair, String> {
        let of = self.real(radicand)?;
        let boxed = |of: Tree| Tree::Root(Box::new(of), index, at);
        if let (Tree::Negate(inner), 2) = (&of, index)
            && self.sign(inner).is_some()
        {
            return Ok(Pair {
                re: integer(0),
                im: boxed((**inner).clone()),
            });
        }
        if self.sign(&of).is_none() {
            self.need(less(of.clone(), Relation::GreaterOrEqual));
        }
        Ok(Pair::real(self.noted(boxed(of))))
    }

    /// Whether a real formula is positive by its form, or else not negative.
    fn sign(&self, tree: &Tree) -> Option<bool> {
        let zero = Rational::from_integer(0);
        match tree {
            Tree::Number(value) => (*value >= zero).then_some(*value > zero),
            Tree::Symbol(name, _) if self.symbols.is_positive(name) => Some(true),
            Tree::Symbol(name, _) if self.symbols.is_nonnegative(name) => Some(false),
            Tree::Symbol(name, _) => {
                let is_constant = [plain("e"), plain(r"\pi")].contains(name) && !self.symbols.declares(name);
                is_constant.then_some(true)
            }
            Tree::Sum(terms) => {
                let signs: Option<Vec<bool>> = terms.iter().map(|term| self.sign(term)).collect();
                signs.map(|signs| signs.contains(&true))
            }
            Tree::Product(factors) => {
                let signs: Option<Vec<bool>> = factors.iter().map(|factor| self.sign(factor)).collect();
                signs.map(|signs| !signs.contains(&false))
            }
            Tree::Quotient(above, below, _) => self.sign(below).and(self.sign(above)),
            Tree::Power(base, exponent, _) => match (self.sign(base), exponent % 2) {
                (Some(sign), _) => Some(sign),
                (None, 0) => Some(false),
                _ => None,
            },
            Tree::Root(radicand, ..) => self.sign(radicand),
            Tree::RealPower(base, ..) => self.sign(base).filter(|is_positive| *is_positive),
            Tree::Call(name, ..) if matches!(name.base.as_str(), r"\exp" | r"\cosh") => Some(true),
            Tree::Call(name, ..) if name.base == r"\abs" => Some(false),
            _ => None,
        }
    }

    fn of_call(&mut self, name: &Name, argument: &Tree, at: At) -> Result<Pair, String> {
        let again = |argument: Tree| Tree::Call(name.clone(), Box::new(argument), at);
        if self.symbols.names.is_function(name) || self.symbols.is_function(name) {
            let Pair { re, im } = self.pair(argument)?;
            return match is_zero(&im) {
                true => Ok(Pair::real(again(re))),
                false => self.of_value(name, argument),
            };
        }
        Ok(match name.base.as_str() {
            CONJUGATE => {
                let is_complex = |node: &Tree| is_complex(node, self.symbols);
                if !any(argument, &mut |node| is_complex(node)) {
                    return Err(format!(
                        "a line over `{argument}`, which is real: is it a mean value or the length of a segment?"
                    ));
                }
                self.pair(argument)?.conjugate()
            }
            r"\Re" => Pair::real(self.pair(argument)?.re),
            r"\Im" => Pair::real(self.pair(argument)?.im),
            r"\abs" => Pair::real(self.modulus(argument)?),
            r"\arg" => {
                // where the real part is positive, the principal value is the arctangent
                let Pair { re, im } = self.pair(argument)?;
                if self.sign(&re) != Some(true) {
                    self.need(less(re.clone(), Relation::Greater));
                }
                let Pair { re: slope, .. } = self.quotient(Pair::real(im), Pair::real(re));
                Pair::real(call(r"\arctan", slope))
            }
            r"\exp" => {
                let exponent = self.pair(argument)?;
                exponential(exponent)
            }
            r"\sin" | r"\cos" | r"\sinh" | r"\cosh" => {
                let argument = self.pair(argument)?;
                circular(&name.base, argument)
            }
            r"\ln" | r"\log" => {
                let argument = self.positive(argument)?;
                Pair::real(self.noted(again(argument)))
            }
            _ => {
                let unknown = || format!("the real and imaginary part of `{name}`");
                let function = Elementary::named(name).ok_or_else(unknown)?;
                if let Some((above, below)) = function.quotient() {
                    let argument = self.pair(argument)?;
                    if is_zero(&argument.im) {
                        return Ok(Pair::real(self.noted(again(argument.re))));
                    }
                    let of = |function: &Elementary| circular(function.command, argument.clone());
                    self.quotient(above.map_or_else(|| Pair::real(integer(1)), of), of(below))
                } else if function.inverse_of.is_some() {
                    let argument = self.real(argument)?;
                    let domain = function.domain(&argument).into_iter();
                    for condition in domain {
                        self.need(less(difference(condition.left, condition.right), condition.relation));
                    }
                    match function.is_total() {
                        true => Pair::real(again(argument)),
                        false => Pair::real(self.noted(again(argument))),
                    }
                } else {
                    return Err(unknown());
                }
            }
        })
    }

    /// The value of a function at a complex argument, where one premise says what the function is.
    fn of_value(&mut self, function: &Name, argument: &Tree) -> Result<Pair, String> {
        let unknown = || format!("the value of `{function}` at the complex argument `{argument}`");
        let there = value_of(function, argument, self.statements, self.symbols).ok_or_else(unknown)?;
        if self.depth >= DEEPEST {
            return Err(unknown());
        }
        if nodes_of(&there) > LARGEST {
            return Err(unknown());
        }
        self.written_out.push(function.clone());
        self.depth += 1;
        let pair = self.pair(&there);
        self.depth -= 1;
        pair
    }

    /// The modulus, a product or quotient of moduli where it can be.
    fn modulus(&mut self, tree: &Tree) -> Result<Tree, String> {
        Ok(match tree {
            Tree::Product(factors) => {
                let moduli = factors.iter().map(|factor| self.modulus(factor));
                product(moduli.collect::<Result<_, _>>()?)
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.modulus(above)?, self.modulus(below)?);
                self.quotient(Pair::real(above), Pair::real(below)).re
            }
            Tree::Negate(inner) => self.modulus(inner)?,
            Tree::Power(_, 0, _) => return Err("a power with exponent 0".to_owned()),
            Tree::Power(base, exponent, _) => {
                let whole = power(self.modulus(base)?, *exponent);
                self.raised(whole, *exponent)
            }
            Tree::RealPower(base, exponent, _) if self.is_euler(base) => growth(self.pair(exponent)?.re),
            Tree::Call(name, inner, _) => match name.base.as_str() {
                r"\abs" | CONJUGATE => self.modulus(inner)?,
                r"\exp" => growth(self.pair(inner)?.re),
                _ => self.plain_modulus(tree)?,
            },
            tree => self.plain_modulus(tree)?,
        })
    }

    fn plain_modulus(&mut self, tree: &Tree) -> Result<Tree, String> {
        let pair = self.pair(tree)?;
        let of_real = |part: Tree| match self.sign(&part) {
            Some(_) => part,
            None => call(r"\abs", part),
        };
        Ok(match (is_zero(&pair.re), is_zero(&pair.im)) {
            (_, true) => of_real(pair.re),
            (true, false) => of_real(pair.im),
            _ => root(pair.square_of_modulus()),
        })
    }

    /// The square of the modulus, without a root.
    fn square_of_modulus(&mut self, tree: &Tree) -> Result<Tree, String> {
        Ok(match tree {
            Tree::Product(factors) => {
                let squares = factors.iter().map(|factor| self.square_of_modulus(factor));
                product(squares.collect::<Result<_, _>>()?)
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.square_of_modulus(above)?, self.square_of_modulus(below)?);
                self.quotient(Pair::real(above), Pair::real(below)).re
            }
            Tree::Negate(inner) => self.square_of_modulus(inner)?,
            Tree::RealPower(base, ..) if self.is_euler(base) => squared(self.modulus(tree)?),
            Tree::Call(name, inner, _) if matches!(name.base.as_str(), r"\abs" | CONJUGATE) => {
                self.square_of_modulus(inner)?
            }
            Tree::Call(name, ..) if name.base == r"\exp" => squared(self.modulus(tree)?),
            tree => self.pair(tree)?.square_of_modulus(),
        })
    }
}

/// e^x.
fn growth(exponent: Tree) -> Tree {
    match is_zero(&exponent) {
        true => integer(1),
        false => call(r"\exp", exponent),
    }
}

/// e^(x + i y) = e^x (cos y + i sin y).
fn exponential(Pair { re, im }: Pair) -> Pair {
    let size = growth(re);
    if is_zero(&im) {
        return Pair::real(size);
    }
    let times = |function: &str| product(vec![size.clone(), call(function, im.clone())]);
    Pair {
        re: times(r"\cos"),
        im: times(r"\sin"),
    }
}

/// A sine or cosine, circular or hyperbolic, by its addition theorem.
fn circular(function: &str, Pair { re, im }: Pair) -> Pair {
    if is_zero(&im) {
        return Pair::real(call(function, re));
    }
    // the other functions of the real part and those of the imaginary one
    let (other, of_im, other_of_im, sign) = match function {
        r"\sin" => (r"\cos", r"\cosh", r"\sinh", 1),
        r"\cos" => (r"\sin", r"\cosh", r"\sinh", -1),
        r"\sinh" => (r"\cosh", r"\cos", r"\sin", 1),
        _ => (r"\sinh", r"\cos", r"\sin", 1),
    };
    let value = |function: &str, at: &Tree| match (is_zero(at), function) {
        (true, r"\sin" | r"\sinh") => integer(0),
        (true, _) => integer(1),
        (false, _) => call(function, at.clone()),
    };
    let im = match sign {
        1 => (value(of_im, &im), value(other_of_im, &im)),
        _ => (value(of_im, &im), negative(value(other_of_im, &im))),
    };
    Pair {
        re: product(vec![value(function, &re), im.0]),
        im: product(vec![value(other, &re), im.1]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbols::RawSymbols;

    /// What an equation comes to, and what must hold for it to.
    fn shown(tex: &str) -> Result<[Vec<String>; 2], String> {
        let list = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();
        let symbols = RawSymbols {
            parameters: list(&["x", "y"]),
            complex: list(&["z"]),
            ..RawSymbols::default()
        };
        let symbols = symbols.read().unwrap();
        let statements = Statements {
            claims: texmath::read(tex, &symbols.names).unwrap(),
            ..Statements::default()
        };
        let goal = Goal::of(&statements, &symbols, String::new());
        let (goal, lemmas) = in_parts(&goal)?;
        let claims = goal.statements.claims.iter().map(ToString::to_string).collect();
        Ok([claims, lemmas.into_iter().map(|lemma| lemma.part).collect()])
    }

    #[test]
    fn an_equation_is_one_of_each_part() {
        for (tex, wanted) in [
            (r"z = x + i y", vec!["x_z = x", "y_z = y"]),
            (r"\operatorname{Re} z = x", vec!["x_z = x"]),
            (r"|z|^2 = x", vec!["x_z^2 + y_z^2 = x"]),
            (r"|z| = 2", vec!["x_z^2 + y_z^2 = 2^2"]),
            (r"\bar z \neq x", vec!["(x_z - x)^2 + (-y_z)^2 \\neq 0"]),
            (r"|e^{i x}| > 0", vec!["1^2 > 0"]),
            (
                r"\overline{\cos z} = 0",
                vec![r"\cos(x_z) \cosh(y_z) = 0", r"-\sin(x_z) [-\sinh(y_z)] = 0"],
            ),
            // where z is 0 it has no value
            (
                r"\operatorname{Re}\frac{0}{z} = 0",
                vec![r"0 = 0", r"\frac{1}{x_z^2 + y_z^2} = \frac{1}{x_z^2 + y_z^2}"],
            ),
        ] {
            assert_eq!(shown(tex).unwrap()[0], wanted, "{tex}");
        }
    }

    #[test]
    fn what_differs_over_complex_numbers_needs_a_lemma() {
        assert_eq!(shown(r"|z| = \sqrt{x}").unwrap()[1], [r"x \geq 0"]);
        assert_eq!(shown(r"|z| = \sqrt{2}").unwrap()[1], [""; 0]);
        assert_eq!(shown(r"|z| = \ln z").unwrap()[1], ["y_z = 0", "x_z > 0"]);
        assert_eq!(shown(r"\arg z = x").unwrap()[1], ["x_z > 0"]);
        for tex in [r"z < \bar z", r"\overline{x y} = x y + z", r"|z| = z^x"] {
            let refused = shown(tex).map_or(true, |[_, lemmas]| !lemmas.is_empty());
            assert!(refused, "{tex}");
        }
    }

    #[test]
    fn i_and_its_conjugate() {
        assert_eq!(shown(r"\bar i = -i").unwrap()[0], ["-1 = -1"]);
        assert_eq!(shown(r"\overline{z^2} = x").unwrap()[0][0], "x_z^2 - y_z^2 = x");
    }
}
