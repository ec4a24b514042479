//! Where symbols may lie: what their lists in the symbol table and the conditions of sheet and claim allow.

use super::compiler::{Compiler, Unwitnessed};
use super::formula::{Formula, Op};
use super::index::{index_runs, is_index};
use super::space::{Slot, Space};
use texmath::{At, Meaning, Name, Relation, Symbols, Tree, index_of};

/// `left - right`, compared with 0.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    pub formula: Formula,
    pub relation: Relation,
}

impl Condition {
    /// Whether the value allows it.
    pub fn holds(&self, value: f64) -> bool {
        match self.relation {
            Relation::Equal => value == 0.0,
            Relation::NotEqual => value.abs() > MARGIN,
            Relation::Less => value < -MARGIN,
            Relation::LessOrEqual => value <= 0.0,
            Relation::Greater => value > MARGIN,
            Relation::GreaterOrEqual => value >= 0.0,
        }
    }
}

/// Points keep this distance from where a strict inequality ends.
const MARGIN: f64 = 1e-6;

/// What a slot may hold.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kind {
    pub positive: bool,
    pub nonnegative: bool,
    pub nonzero: bool,
    pub at_most_one: bool,
    pub integer: bool,
    pub index: bool,
    pub complex: bool,
    pub generic: bool,
}

/// What each slot may hold.
pub fn kinds(symbols: &Symbols, space: &Space) -> Vec<Kind> {
    let kind = |(slot, what): (usize, &Slot)| {
        let Some(name) = space.name(slot) else {
            return Kind::default();
        };
        let index = match what {
            Slot::Time { index, .. } | Slot::State { index, .. } => Some(*index),
            _ => None,
        };
        let at = |known: &Name| index_of(&known.subscript, &symbols.index) == index || index_runs(symbols);
        let is_side = |known: &Name| match what {
            Slot::State { state, after, .. } => symbols.is_continuous(state) || *after == (known.mark == "+"),
            _ => true,
        };
        let indexed = |known: &Name| index.is_some() && known.bare() == *name && at(known) && is_side(known);
        let listed = |kind: Meaning| symbols.all(&kind).any(|known| known == name || indexed(known));
        Kind {
            positive: listed(Meaning::Positive),
            nonnegative: listed(Meaning::Nonnegative),
            nonzero: listed(Meaning::Nonzero),
            at_most_one: listed(Meaning::AtMostOne),
            integer: listed(Meaning::Integer) || is_index(symbols, name),
            index: index_runs(symbols) && is_index(symbols, name),
            complex: listed(Meaning::Complex),
            generic: listed(Meaning::Generic),
        }
    };
    space.slots.iter().enumerate().map(kind).collect()
}

/// The conditions that the lists of the symbol table set for slots, and for abbreviations among them.
pub fn listed(compiler: &mut Compiler, kinds: &[Kind]) -> Result<Vec<Condition>, Unwitnessed> {
    let symbols = compiler.symbols;
    let mut named: Vec<(Formula, Kind)> = Vec::new();
    for (slot, kind) in kinds.iter().enumerate() {
        named.push((compiler.formulas.slot(slot), *kind));
    }
    let lists = [
        (Meaning::Positive, Relation::Greater),
        (Meaning::Nonnegative, Relation::GreaterOrEqual),
        (Meaning::Nonzero, Relation::NotEqual),
        (Meaning::AtMostOne, Relation::LessOrEqual),
    ];
    let one = compiler.formulas.integer(1);
    let mut conditions = Vec::new();
    let mut push = |compiler: &mut Compiler, formula: Formula, relation: Relation| {
        let formula = match relation {
            Relation::LessOrEqual => compiler.formulas.subtract(formula, one),
            _ => formula,
        };
        conditions.push(Condition { formula, relation });
    };
    for (formula, kind) in named {
        let asked = [kind.positive, kind.nonnegative, kind.nonzero, kind.at_most_one];
        for ((_, relation), _) in lists.iter().zip(asked).filter(|(_, asked)| *asked) {
            push(compiler, formula, *relation);
        }
    }
    for (kind, relation) in lists {
        for name in symbols.all(&kind).filter(|name| symbols.abbreviation(name).is_some()) {
            let formula = compiler.tree(&Tree::Symbol(name.clone(), At(0)))?;
            if !matches!(compiler.formulas.op(formula), Op::Slot(_)) {
                push(compiler, formula, relation);
            }
        }
    }
    Ok(conditions)
}
