//! What a claim rests on, statement by statement: premises with their substitutions made, and definitions.

use super::atom::Atoms;
use super::fault::{Fault, Source};
use super::jacobian::Jacobians;
use super::meaning::Meaning;
use super::reading::{Local, Meaningless, Reading};
use super::sheet::{Entry, Sheet};
use super::substitute::{any, flies, runs, tree_runs};
use super::vocabulary::{Vocabulary, index_of};
use crate::algebra::Fraction;
use crate::number::Rational;
use crate::tex::{Equation, EvaluationError, Name, Tree};
use std::collections::BTreeSet;

/// One equation that is taken as true.
#[derive(Clone, Debug)]
pub struct Statement {
    pub label: String,
    pub equation: Equation,
    /// The symbols defined beside it.
    pub locals: Vec<Local>,
    /// The first impact it speaks of.
    pub first: Option<i32>,
    /// Whether it is a law of one impact in which `with` put a value for a parameter: said of each impact, as laws of
    /// flight are.
    substituted: bool,
    source: Source,
}

/// No claim spans more flights; the bound is for claims that name impacts far apart.
const MOST_FLIGHTS: i32 = 4;

/// All that bears on one claim.
#[derive(Clone, Debug, Default)]
pub struct Statements {
    pub premises: Vec<Statement>,
    /// The symbols that the claim may use beyond the vocabulary.
    pub locals: Vec<Local>,
    /// The equations to be decided.
    pub claims: Vec<Equation>,
    /// The first impact that the claim speaks of.
    pub first: Option<i32>,
    /// Whether the claim holds at every time of a flight.
    pub claim_runs: bool,
    /// Whether anything is said of partial derivatives, traces or determinants.
    pub speaks_of_maps: bool,
    /// Whether a partial derivative is written out anywhere.
    pub has_partials: bool,
}

impl Statement {
    /// Left side minus right side.
    pub fn residual(&self, reading: &mut Reading) -> Result<Fraction, Fault> {
        let mut side = |tree: &Tree| {
            let value = reading.tree(tree);
            value.map_err(|error| self.fault(error.at(), message(&error)))
        };
        Ok(side(&self.equation.left)? - side(&self.equation.right)?)
    }

    /// A fault in this statement.
    pub fn fault(&self, at: usize, message: String) -> Fault {
        self.source.fault(at, message).of(&self.label)
    }
}

/// What an error of evaluation means to the writer of a sheet.
pub fn message(error: &EvaluationError<Meaningless>) -> String {
    match error {
        EvaluationError::Scope { error, .. } => error.to_string(),
        EvaluationError::DivisionByZero { .. } => "this denominator is zero everywhere".to_string(),
        EvaluationError::Sign { .. } => r"`\pm` can stand in a claim only".to_string(),
    }
}

impl Statements {
    /// Gathers what bears on the entry at `position`.
    ///
    /// # Errors
    /// A [`Fault`] where a definition or a substitution makes no sense, or nothing is left to decide.
    pub fn gather(sheet: &Sheet, position: usize, jacobians: &Jacobians, atoms: &mut Atoms) -> Result<Self, Fault> {
        let Some(claim) = sheet.entries.get(position) else {
            return Ok(Self::default());
        };
        let mut gathering = Gathering {
            vocabulary: &sheet.vocabulary,
            jacobians,
            atoms,
            found: Self::default(),
        };
        for premise in claim.follows_from.iter().filter_map(|&n| sheet.entries.get(n)) {
            gathering.premise(premise)?;
        }
        gathering.claim(claim)?;
        gathering.substitute(claim)?;
        Ok(gathering.found.with_overview(&sheet.vocabulary))
    }

    /// The label of a premise, for a reader.
    pub fn label(&self, index: usize) -> String {
        self.premises.get(index).map(|s| s.label.clone()).unwrap_or_default()
    }

    fn with_overview(mut self, vocabulary: &Vocabulary) -> Self {
        let definitions = self.locals.iter().map(|local| &local.tree);
        let of_claim: Vec<&Tree> = self
            .claims
            .iter()
            .flat_map(|c| [&c.left, &c.right])
            .chain(definitions)
            .collect();
        let mut impacts = BTreeSet::new();
        for tree in &of_claim {
            vocabulary.collect_impacts(tree, &mut impacts);
        }
        let (first, last) = (impacts.first().copied(), impacts.last().copied());
        let claim_runs = of_claim.iter().any(|tree| tree_runs(tree, vocabulary));
        let of_premises = self.premises.iter().flat_map(|s| [&s.equation.left, &s.equation.right]);
        let everything: Vec<&Tree> = of_claim.into_iter().chain(of_premises).collect();
        let any_node = |test: fn(&Tree) -> bool| everything.iter().any(|tree| any(tree, &mut |node| test(node)));
        let has_partials = any_node(|node| matches!(node, Tree::Partial { .. }));
        let speaks_of_maps = has_partials || any_node(|node| matches!(node, Tree::Invariant { .. }));
        (self.first, self.claim_runs) = (first, claim_runs);
        (self.has_partials, self.speaks_of_maps) = (has_partials, speaks_of_maps);
        let flights = self
            .first
            .zip(last)
            .filter(|_| !self.claim_runs)
            .map_or(1, |(first, last)| (last - first).max(1));
        self.premises = self
            .premises
            .iter()
            .flat_map(|s| s.said_of(self.first, flights, vocabulary))
            .collect();
        self
    }
}

impl Statement {
    /// A law of flight is said of every impact: it is taken at the `flights` that the claim speaks of, from the
    /// impact `first` on. Any other statement is said once.
    fn said_of(&self, first: Option<i32>, flights: i32, vocabulary: &Vocabulary) -> Vec<Self> {
        let start = vocabulary.impacts(&self.equation).first().copied();
        let said = |by: i32| {
            let mut statement = self.clone();
            statement.equation = vocabulary.shifted(&self.equation, by);
            for local in &mut statement.locals {
                local.tree = vocabulary.shifted(&local.as_equation(), by).left;
            }
            statement.first = vocabulary.impacts(&statement.equation).first().copied();
            statement
        };
        match (start, first) {
            (Some(start), Some(first)) if first >= start && (self.substituted || runs(&self.equation, vocabulary)) => {
                (0..flights.min(MOST_FLIGHTS))
                    .map(|flight| said(first - start + flight))
                    .collect()
            }
            // A law that names no impact is said of every flight too.
            (None, Some(first)) if flies(&self.equation, vocabulary) => (0..flights.min(MOST_FLIGHTS))
                .map(|flight| Self {
                    first: Some(first + flight),
                    ..said(0)
                })
                .collect(),
            _ => vec![said(0)],
        }
    }
}

impl Local {
    fn as_equation(&self) -> Equation {
        let zero = Tree::Number(<Rational as num_traits::Zero>::zero());
        Equation {
            left: self.tree.clone(),
            relation: Default::default(),
            right: zero,
            at: Default::default(),
            end: Default::default(),
        }
    }
}

/// Equations, and where each stands.
type Sourced = Vec<(Equation, Source)>;

struct Gathering<'a> {
    vocabulary: &'a Vocabulary,
    jacobians: &'a Jacobians,
    atoms: &'a mut Atoms,
    found: Statements,
}

impl Gathering<'_> {
    /// Whether the equation gives a symbol that nothing else does.
    fn defines(&mut self, equation: &Equation, locals: &[Local]) -> Option<Name> {
        let Tree::Symbol(name, _) = &equation.left else {
            return None;
        };
        if locals.iter().any(|local| local.name == *name) || pair_of(name).is_some() {
            return None;
        }
        let blank = Meaning::default();
        let known = Reading::new(self.vocabulary, self.jacobians, self.atoms, &blank, &[]).knows(name);
        (!known).then(|| name.clone())
    }

    fn premise(&mut self, entry: &Entry) -> Result<(), Fault> {
        let (own, more) = self.local(entry)?;
        for equation in &entry.equations {
            let shared = self.found.locals.clone();
            match self.defines(equation, &shared) {
                // A definition uses what stands beside it; others see only its name.
                Some(name) => self.found.locals.push(Local {
                    name,
                    tree: inlined(&equation.right, &own),
                }),
                None => self.push(entry, equation.clone(), entry.tex.clone(), &own),
            }
        }
        for (equation, source) in more {
            self.push(entry, equation, source, &own);
        }
        Ok(())
    }

    /// The definitions beside an entry, and the equations among them that define nothing new.
    fn local(&mut self, entry: &Entry) -> Result<(Vec<Local>, Sourced), Fault> {
        let (mut own, mut more): (Vec<Local>, _) = (Vec::new(), Vec::new());
        for (equation, source) in &entry.local {
            match self.defines(equation, &[]) {
                Some(name) if own.iter().any(|local| local.name == name) => {
                    return Err(source
                        .fault(equation.at.0, format!("`{name}` is defined twice"))
                        .of(&entry.label));
                }
                Some(name) => own.push(Local {
                    name,
                    tree: equation.right.clone(),
                }),
                None => more.push((equation.clone(), source.clone())),
            }
        }
        Ok((own, more))
    }

    fn push(&mut self, entry: &Entry, equation: Equation, source: Source, own: &[Local]) {
        let locals = own.to_vec();
        self.found.premises.push(Statement {
            label: entry.label.clone(),
            equation,
            locals,
            first: None,
            substituted: false,
            source,
        });
    }

    fn claim(&mut self, entry: &Entry) -> Result<(), Fault> {
        let (own, more) = self.local(entry)?;
        let shared = self.found.locals.clone();
        // What the claim defines for itself goes before what a premise calls by the same name.
        self.found
            .locals
            .retain(|shared| own.iter().all(|local| local.name != shared.name));
        self.found.locals.extend(own.clone());
        for equation in &entry.equations {
            let known = self.found.locals.clone();
            match self.defines(equation, &known) {
                Some(name) => self.found.locals.push(Local {
                    name,
                    tree: equation.right.clone(),
                }),
                None => self.found.claims.push(equation.clone()),
            }
        }
        for (equation, source) in more {
            self.push(entry, equation, source, &own);
        }
        // Premises may use definitions that other premises give.
        for statement in &mut self.found.premises {
            let new = shared
                .iter()
                .filter(|s| statement.locals.iter().all(|own| own.name != s.name));
            let new: Vec<Local> = new.cloned().collect();
            statement.locals.extend(new);
        }
        if self.found.claims.is_empty() {
            let problem = "nothing to decide: each left side is a symbol that is known from nowhere else";
            let name = entry
                .equations
                .first()
                .map(|equation| equation.left.to_string())
                .unwrap_or_default();
            return Err(entry
                .tex
                .fault(0, format!("unknown symbol `{name}`; {problem}"))
                .of(&entry.label));
        }
        Ok(())
    }

    /// Makes the substitutions of `with` in the premises.
    fn substitute(&mut self, claim: &Entry) -> Result<(), Fault> {
        let (mut pairs, mut shift) = (Vec::new(), 0);
        let mut more = Vec::new();
        for (equation, source) in &claim.with {
            let fault = |message: String| source.fault(equation.at.0, message).of(&claim.label);
            match &equation.left {
                Tree::Symbol(name, _) if name.to_string() == self.vocabulary.index => {
                    let by = index_of(&equation.right.to_string().replace(' ', ""), &self.vocabulary.index);
                    shift =
                        by.ok_or_else(|| fault(format!("`{name}` can be replaced by `{name}+1` and the like only")))?;
                }
                Tree::Symbol(name, _) => {
                    let blank = Meaning::default();
                    let locals = self.found.locals.clone();
                    let mut reading = Reading::new(self.vocabulary, self.jacobians, self.atoms, &blank, &locals);
                    for side in [&equation.left, &equation.right] {
                        reading
                            .tree(side)
                            .map_err(|e| source.fault(e.at(), message(&e)).of(&claim.label))?;
                    }
                    pairs.push((name.clone(), equation.right.clone()));
                }
                _ => more.push((equation.clone(), source.clone())),
            }
        }
        if shift == 0 && pairs.is_empty() {
            for (equation, source) in more {
                self.push(claim, equation, source, &[]);
            }
            return Ok(());
        }
        for statement in &mut self.found.premises {
            let shifted = self.vocabulary.shifted(&statement.equation, shift);
            statement.equation = self.vocabulary.substituted(&shifted, &pairs);
            let one_impact = self.vocabulary.impacts(&statement.equation).len() == 1;
            statement.substituted = one_impact && statement.equation != shifted;
            for local in &mut statement.locals {
                let whole = Equation {
                    right: local.tree.clone(),
                    ..local.as_equation()
                };
                local.tree = self
                    .vocabulary
                    .substituted(&self.vocabulary.shifted(&whole, shift), &pairs)
                    .right;
            }
        }
        for (equation, source) in more {
            self.push(claim, equation, source, &[]);
        }
        Ok(())
    }
}

/// The tree with local definitions put in, as deep as they go without circles.
fn inlined(tree: &Tree, own: &[Local]) -> Tree {
    own.iter().rev().fold(tree.clone(), |tree, _| {
        super::substitute::rewrite(&tree, &|name| {
            own.iter()
                .find(|local| local.name == *name)
                .map(|local| local.tree.clone())
        })
    })
}

/// The symbol `\lambda` of a pair such as `\lambda_{1,2}`.
pub fn pair_of(name: &Name) -> Option<Name> {
    (name.subscript == "1,2" || name.subscript == r"\pm").then(|| Name {
        subscript: String::new(),
        ..name.clone()
    })
}
