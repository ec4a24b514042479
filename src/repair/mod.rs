//! The smallest edits that make a refuted claim true: found by what the sides must be at points of the premises,
//! accepted where the edited claim is proved.
//!
//! Every node of the claim is edited as a misprint may call for (`edit`), or by what its sides lack (`dictionary`). Values
//! at points where the premises hold sieve what is to be proved (`points`, `leaves`, `graph`, `search`); several edits are matched by
//! what each adds to the difference of the sides (`combine`).

mod candidate;
mod combine;
mod context;
mod dictionary;
mod edit;
mod graph;
mod matrices;
mod monomial;
mod path;
mod points;
mod search;

pub use path::{Path, node, parts, replaced};

use crate::claim::{Sheet, Verdict, any_side};
use crate::prove::{self, Options};
use crate::tex::{Equation, Tree};
use monomial::is_same_product;
use search::{Formula, Found, Search};
use std::fmt;

/// The most repairs that are given.
pub const MOST_REPAIRS: usize = 5;

/// Edited claims for which a proof is looked for, for each unit of effort.
const MOST_PROOFS: u64 = 16;

/// The most that the squares of the numbers of their nodes come to where there are operations in them, which make many claims
/// of one, for each unit of effort; two are proved in any case.
const MOST_SQUARES: u64 = 60_000;

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
    pub edits: Vec<Edit>,
    /// The size of the edits: 10 for one sign, name or digit, more for what is rarer or longer.
    pub size: u32,
}

impl Repair {
    /// Whether these formulas are the mended ones, factors in another order or grouping aside.
    fn is_spelling_of(&self, formulas: &[Formula], mended: &[(usize, Equation)]) -> bool {
        let is_same = |((part, one), (number, other)): (&(Part, Equation), &(usize, Equation))| {
            formulas.get(*number).is_some_and(|formula| formula.part == *part)
                && is_same_product(&one.left, &other.left)
                && is_same_product(&one.right, &other.right)
                // of what is so by making, nothing is told by that
                && !is_same_product(&one.left, &one.right)
        };
        self.mended.len() == mended.len() && self.mended.iter().zip(mended).all(is_same)
    }

    /// What is wrong in the claim.
    pub fn words(&self) -> String {
        let words: Vec<&str> = self.edits.iter().map(|edit| edit.words.as_str()).collect();
        words.join("; ")
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, (_, equation)) in self.mended.iter().enumerate() {
            let gap = if n == 0 { "" } else { ", " };
            write!(f, "{gap}${equation}$")?;
        }
        Ok(())
    }
}

/// The repairs of the refuted claim at a position, the smallest first; each is proved.
pub fn repairs(sheet: &Sheet, position: usize, options: &Options) -> Vec<Repair> {
    // what is compared with printed figures is no equation
    let entry = sheet.entries.get(position);
    let is_approximate = entry.is_some_and(|entry| entry.tex.tex.contains(r"\approx") || entry.tex.tex.contains('≈'));
    let Some(search) = Search::new(sheet, position, options.effort).filter(|_| !is_approximate) else {
        return Vec::new();
    };
    for stage in search::STAGES {
        let found = search.found(stage);
        let repairs = proved(sheet, position, &search, found, options);
        if !repairs.is_empty() {
            return repairs;
        }
    }
    Vec::new()
}

/// Those of the edited claims that are proved.
fn proved(sheet: &Sheet, position: usize, search: &Search, found: Vec<Found>, options: &Options) -> Vec<Repair> {
    let mut edited = sheet.clone();
    let (mut repairs, mut proofs): (Vec<Repair>, _) = (Vec::new(), 0);
    let most = search.most_proofs(MOST_PROOFS, MOST_SQUARES) * options.effort;
    for found in found {
        if repairs.len() >= MOST_REPAIRS || proofs >= most {
            break;
        }
        let mended = found.mended(&search.formulas);
        let is_known = |known: &Repair| known.is_spelling_of(&search.formulas, &mended);
        if repairs.iter().any(is_known) {
            continue;
        }
        if mended
            .iter()
            .any(|(number, equation)| says_nothing(equation, search.formulas.get(*number), found.may_balance()))
        {
            continue;
        }
        put(&mut edited, sheet, position, &search.formulas, &mended);
        proofs += 1;
        let decision = prove::decide(&edited, position, options);
        if decision.verdict == Verdict::Proved && !decision.is_vacuous {
            repairs.push(found.repair(&search.formulas, mended));
        }
    }
    repairs
}

/// Whether both sides are the same as written, or, where an edit may only balance them, the same product; or speak of no symbol where
/// the printed formula does.
fn says_nothing(equation: &Equation, printed: Option<&Formula>, may_balance: bool) -> bool {
    let is_symbol = |node: &Tree| matches!(node, Tree::Symbol(name, _) if name.base != r"\pi");
    let speaks = |equation: &Equation| any_side(equation, &mut |node| is_symbol(node));
    let is_same = match may_balance {
        true => is_same_product(&equation.left, &equation.right),
        false => equation.left.to_string() == equation.right.to_string(),
    };
    is_same || (!speaks(equation) && printed.is_some_and(|printed| speaks(&printed.equation)))
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
