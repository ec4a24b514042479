//! The smallest edits that make a refuted claim true: found by what the sides must be at points of the premises,
//! accepted where the edited claim is proved.
//!
//! Every node of the claim is edited as a misprint may call for (`edit`), or by what its sides lack (`dictionary`). Values
//! at points where the premises hold sieve what is to be proved (`points`, `leaves`, `graph`, `search`); several edits are matched by
//! what each adds to the difference of the sides (`combine`). What is shown goes through one gate (`printed`).

mod candidate;
mod combine;
mod context;
mod count_slips;
mod dictionary;
mod edit;
mod graph;
mod matrices;
mod monomial;
mod path;
mod points;
mod printed;
mod search;

pub use count_slips::slips;
pub use path::{Path, node, parts, replaced};
pub use printed::{Reprinted, reprinted};

use crate::claim::{Entry, Sheet};
use crate::prove::Options;
use crate::stop::goes_on;
use crate::tex::{Equation, Tree, any};
use candidate::Formula;
use monomial::{is_balanced, is_same_product};
use printed::proved_as_printed;
use search::{Found, Search};
use std::fmt;

/// The most repairs that are given.
pub const MOST_REPAIRS: usize = 5;

/// Edited claims for which a proof is looked for, for each unit of effort.
const MOST_PROOFS: u64 = 16;

/// The most that the squares of the numbers of their nodes come to where there are operations in them, which make many claims
/// of one, for each unit of effort; two are proved in any case.
const MOST_SQUARES: u64 = 60_000;

/// The most characters of a part of a formula that is printed beside what should stand in its place.
const LONGEST_PART: usize = 60;

/// A formula of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Part {
    /// An equation of its `tex`.
    Stated(usize),
    /// An equation of its `where`.
    Definition(usize),
}

/// A change of one place of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    pub part: Part,
    /// The node that is changed: the path is one in the formula as it stands and in the mended one.
    pub path: Path,
    /// What stands there in the mended formula.
    pub tree: Tree,
    /// What is wrong, as "wrong sign of the term `x`".
    pub words: String,
}

/// Edits after which a refuted claim is proved.
#[derive(Clone, Debug, PartialEq)]
pub struct Repair {
    /// The formulas that change, as they should be.
    pub mended: Vec<(Part, Equation)>,
    /// The texts of the claim and of its `where` that change, as they should be, conditions included: what is shown, read and
    /// proved.
    pub formulas: Vec<String>,
    pub edits: Vec<Edit>,
    /// The size of the edits: 10 for one sign, name or digit, more for what is rarer or longer.
    pub size: u32,
}

impl Repair {
    /// Whether another repair mends the same formulas to the same, factors in another order or grouping aside.
    fn is_spelling_of(&self, other: &Self) -> bool {
        let is_same = |((part, one), (place, other)): (&(Part, Equation), &(Part, Equation))| {
            part == place
                && is_same_product(&one.left, &other.left)
                && is_same_product(&one.right, &other.right)
                // of what is so by making, nothing is told by that
                && !is_same_product(&one.left, &one.right)
        };
        self.mended.len() == other.mended.len() && self.mended.iter().zip(&other.mended).all(is_same)
    }

    /// The changes of a claim, as "`a` should be `b`".
    pub fn changes(&self, claim: &Entry) -> String {
        let change = |edit: &Edit| {
            let printed = printed::equation(claim, edit.part);
            let place = match (edit.part, printed) {
                (Part::Definition(_), Some(definition)) => format!("in `{}`: ", definition.left),
                _ => String::new(),
            };
            let before = printed.and_then(|equation| node(equation, &edit.path));
            // of a long part the words say more
            let is_short = |before: &Tree| before.to_string().chars().count() <= LONGEST_PART;
            match before.filter(|before| *before != edit.tree && is_short(before)) {
                Some(before) => format!("{place}`{before}` should be `{}`", edit.tree),
                None => format!("{place}{}", edit.words),
            }
        };
        self.edits.iter().map(change).collect::<Vec<_>>().join("; ")
    }

    /// Returns true if the letters of two factors are swapped.
    pub fn swaps_letters(&self) -> bool {
        self.edits.iter().any(|edit| edit.words.starts_with(edit::SWAPPED))
    }

    /// What is wrong in the claim.
    pub fn words(&self) -> String {
        let words: Vec<&str> = self.edits.iter().map(|edit| edit.words.as_str()).collect();
        words.join("; ")
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, formula) in self.formulas.iter().enumerate() {
            let gap = if n == 0 { "" } else { ", " };
            write!(f, "{gap}${formula}$")?;
        }
        Ok(())
    }
}

/// The repairs of a claim, and how far they were looked for.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Repairs {
    /// The repairs, the smallest first; each is proved as it is shown.
    pub found: Vec<Repair>,
    /// How far they were looked for; nothing where they are not, as of approximations.
    pub extent: Option<Extent>,
}

/// How far repairs were looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Extent {
    /// The single edits that were tried.
    pub edits: usize,
    /// How many of them were tried together, at most.
    pub together: usize,
    /// The edited formulas that were true where they were tried, and were given to the prover.
    pub proofs: u64,
}

impl Repairs {
    /// Says that nothing is found, and how far that went; nothing where there are repairs.
    pub fn none(&self) -> Option<String> {
        if !self.found.is_empty() {
            return None;
        }
        let Some(extent) = self.extent else {
            return Some("no repair is looked for of what is no equation or inequality between values".to_owned());
        };
        let together = match extent.together {
            0 | 1 => String::new(),
            together => format!(", up to {together} together,"),
        };
        Some(format!(
            "no repair found among {} edits{together} with {} attempts to prove one",
            extent.edits, extent.proofs
        ))
    }
}

/// Returns the repairs of the refuted claim at a position, the smallest first; each is proved as it is shown.
pub fn repairs(sheet: &Sheet, position: usize, options: &Options) -> Repairs {
    // what is compared with printed figures is no equation
    let entry = sheet.entries.get(position);
    let is_approximate = entry.is_some_and(|entry| entry.tex.tex.contains(r"\approx") || entry.tex.tex.contains('≈'));
    let Some(search) = Search::new(sheet, position, options.effort).filter(|_| !is_approximate) else {
        return Repairs::default();
    };
    let mut extent = Extent {
        edits: search.edits(),
        together: 0,
        proofs: 0,
    };
    let mut found = Vec::new();
    for stage in search.stages() {
        extent.together = extent.together.max(stage.together());
        found = proved(
            sheet,
            position,
            &search,
            search.found(*stage),
            options,
            &mut extent.proofs,
        );
        if !found.is_empty() || !goes_on() {
            break;
        }
    }
    Repairs {
        found,
        extent: Some(extent),
    }
}

/// Those of the edited claims that are proved as they are shown; `proofs` counts all that are tried.
fn proved(
    sheet: &Sheet,
    position: usize,
    search: &Search,
    found: Vec<Found>,
    options: &Options,
    proofs: &mut u64,
) -> Vec<Repair> {
    let mut repairs: Vec<Repair> = Vec::new();
    let most = *proofs + search.most_proofs(MOST_PROOFS, MOST_SQUARES) * options.effort;
    for found in found {
        if repairs.len() >= MOST_REPAIRS || *proofs >= most || !goes_on() {
            break;
        }
        let mended = found.mended(&search.formulas);
        let is_empty = |(number, equation): &(usize, Equation)| {
            says_nothing(equation, search.formulas.get(*number), found.may_balance())
        };
        if mended.iter().any(is_empty) {
            continue;
        }
        let (balances, repair) = (found.may_balance(), found.repair(&search.formulas, mended));
        if repairs.iter().any(|known| known.is_spelling_of(&repair)) {
            continue;
        }
        *proofs += 1;
        let Some(formulas) = proved_as_printed(sheet, position, &repair.mended, balances, options) else {
            continue;
        };
        if repairs.iter().all(|known| known.formulas != formulas) {
            repairs.push(Repair { formulas, ..repair });
        }
    }
    repairs
}

/// Whether both sides are the same as written, or, where an edit may only balance them, the same product; or speak of no symbol where
/// the printed formula does: what need not be proved to be refused.
fn says_nothing(equation: &Equation, printed: Option<&Formula>, may_balance: bool) -> bool {
    let either = |equation: &Equation| speaks(&equation.left) || speaks(&equation.right);
    let is_same = match may_balance {
        true => printed.is_some_and(|printed| is_balanced(equation, &printed.equation)),
        false => equation.left.to_string() == equation.right.to_string(),
    };
    is_same || (!either(equation) && printed.is_some_and(|printed| either(&printed.equation)))
}

/// Returns true if a symbol stands in a formula.
fn speaks(tree: &Tree) -> bool {
    any(
        tree,
        &mut |node| matches!(node, Tree::Symbol(name, _) if name.base != r"\pi"),
    )
}

/// Puts formulas into the entry at a position of a copy of the sheet.
fn put(copy: &mut Sheet, sheet: &Sheet, position: usize, formulas: &[Formula], new: &[(usize, Equation)]) {
    let (Some(entry), Some(place)) = (sheet.entries.get(position), copy.entries.get_mut(position)) else {
        return;
    };
    *place = entry.clone();
    let mut equations = entry.equations.clone();
    let mut local: Vec<Equation> = entry.local.iter().map(|(equation, _)| equation.clone()).collect();
    for (number, equation) in new {
        let place = match formulas.get(*number).map(|formula| formula.part) {
            Some(Part::Stated(n)) => equations.get_mut(n),
            Some(Part::Definition(n)) => local.get_mut(n),
            None => None,
        };
        if let Some(place) = place {
            *place = equation.clone();
        }
    }
    copy.replace(position, equations, local);
}
