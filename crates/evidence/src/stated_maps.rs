//! The maps that the symbol table and the premises state.

use super::compiler::{Compiler, Unwitnessed};
use super::formula::{Formula, Op};
use super::maps::{Maps, Step};
use super::space::Slot;
use claims::Statements;
use texmath::{Equation, Map, Name, Symbols, Tree, any_side, flies};

/// The maps of a symbol table.
///
/// # Errors
/// [`Unwitnessed`] where the equations of a map have no concrete form.
pub fn read_maps(symbols: &Symbols, compiler: &mut Compiler) -> Result<Maps, Unwitnessed> {
    let mut maps = Maps::default();
    for (name, map) in symbols.maps() {
        let step = match map {
            Map::Product(factors) => {
                maps.products.push((name.clone(), factors.clone()));
                continue;
            }
            Map::Premises { of, by } => {
                let mut slots = |trees: &[Tree]| {
                    let slot = |tree: &Tree| match tree {
                        Tree::Symbol(name, _) => compiler.quantity(name),
                        _ => None,
                    };
                    trees.iter().filter_map(slot).collect()
                };
                Step {
                    name: name.clone(),
                    of: slots(of),
                    by: slots(by),
                    equations: Vec::new(),
                    images: Vec::new(),
                    is_led: false,
                }
            }
            Map::Equations(equations) => explicit(name, equations, compiler)?,
        };
        maps.steps.push(step);
    }
    Ok(maps)
}

impl Maps {
    /// Tells to which maps premises lead: those of which one names what the map gives, all where there are laws of flight.
    pub fn tell_led(&mut self, statements: &Statements, compiler: &mut Compiler) {
        let equations = || statements.premises.iter().map(|premise| &premise.equation);
        let symbols = compiler.symbols;
        let flies = equations().any(|equation| flies(equation, symbols));
        for step in &mut self.steps {
            let is_of = |tree: &Tree, compiler: &mut Compiler| match tree {
                Tree::Symbol(name, _) => compiler.quantity(name).is_some_and(|slot| step.of.contains(&slot)),
                _ => false,
            };
            let names = |equation: &Equation| any_side(equation, &mut |tree| is_of(tree, compiler));
            step.is_led = flies || equations().any(names);
        }
    }

    /// Adds the map from one impact to another where a derivative between them belongs to no map: all times and states
    /// of the one, each with the others held. An explicit map is that map only where no premise is `said` of the one.
    pub fn add_step(&mut self, of: &Name, by: &Name, said: bool, compiler: &mut Compiler) {
        let (Some(above), Some(below)) = (compiler.quantity(of), compiler.quantity(by)) else {
            return;
        };
        let is_explicit = |step: &Step| !step.equations.is_empty();
        let explicit = self.steps.iter().all(is_explicit) && said;
        if !explicit && self.entry(above, below, compiler.space, compiler.formulas).is_some() {
            return;
        }
        let symbols = compiler.symbols;
        let mut all = |subscript: &str| -> Vec<usize> {
            let families = symbols.times().chain(symbols.states());
            let indexed = families.map(|name| Name {
                subscript: subscript.to_string(),
                ..name.clone()
            });
            indexed.filter_map(|name| compiler.quantity(&name)).collect()
        };
        let step = Step {
            name: Name::default(),
            of: all(&of.subscript),
            by: all(&by.subscript),
            equations: Vec::new(),
            images: Vec::new(),
            is_led: said,
        };
        self.steps.push(step);
    }
}

/// The map from the first impact that its equations name to the last: times before states, as declared.
fn explicit(name: &Name, equations: &[Equation], compiler: &mut Compiler) -> Result<Step, Unwitnessed> {
    let (mut rows, mut sides) = (Vec::new(), Vec::new());
    for equation in equations {
        let (left, right) = (compiler.tree(&equation.left)?, compiler.tree(&equation.right)?);
        rows.push(compiler.formulas.subtract(left, right));
        sides.push((left, right));
    }
    let mut order: Vec<(i32, usize, usize)> = Vec::new();
    for slot in compiler.formulas.slots(&rows) {
        match compiler.space.slots.get(slot) {
            Some(Slot::Time { index, .. }) => order.push((*index, 0, slot)),
            Some(Slot::State { state, index, .. }) => {
                let rank = compiler.symbols.states().position(|known| known == state);
                order.push((*index, rank.map_or(usize::MAX, |rank| rank + 1), slot));
            }
            _ => {}
        }
    }
    order.sort_unstable();
    order.dedup();
    let side = |index: Option<i32>| {
        let there = order.iter().filter(|(i, ..)| Some(*i) == index);
        there.map(|(.., slot)| *slot).collect()
    };
    let (of, by): (Vec<usize>, Vec<usize>) = (side(order.last().map(|o| o.0)), side(order.first().map(|o| o.0)));
    let image = |slot: &usize| {
        let mut own = sides
            .iter()
            .filter(|(left, _)| compiler.formulas.op(*left) == Op::Slot(*slot));
        let (_, right) = own.next()?;
        let moves = compiler
            .formulas
            .slots(&[*right])
            .into_iter()
            .any(|slot| of.contains(&slot));
        (!moves && sides.len() == of.len()).then_some(*right)
    };
    let images: Option<Vec<Formula>> = of.iter().map(image).collect();
    Ok(Step {
        name: name.clone(),
        images: images.unwrap_or_default(),
        of,
        by,
        equations: rows,
        is_led: false,
    })
}
