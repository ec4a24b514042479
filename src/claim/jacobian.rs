//! Partial derivatives of one-impact maps: the premises differentiated implicitly.

use super::angle;
use super::atom::{Atom, Atoms};
use super::reading::{Meaningless, Reading};
use super::vocabulary::{Map, Vocabulary};
use crate::algebra::{Derivation, Fraction, Polynomial, Variable};
use crate::number::{Field, Rational};
use crate::tex::{Equation, Invariant, Name, Tree};
use nalgebra::DMatrix;
use num_traits::Zero;
use std::collections::BTreeSet;

/// The maps of a vocabulary, over quantities.
#[derive(Clone, Debug, Default)]
pub struct Jacobians {
    maps: Vec<(Name, Kind)>,
    /// Whether nothing is known of any map, so that its trace and determinant are mere symbols.
    pub opaque: bool,
}

#[derive(Clone, Debug)]
enum Kind {
    Step(Step),
    Product(Vec<Name>),
}

/// A map whose derivatives are quantities of their own.
#[derive(Clone, Debug)]
pub struct Step {
    pub of: Vec<Variable>,
    pub by: Vec<Variable>,
    /// The equations of the map, where the vocabulary and not the premises give them.
    pub equations: Vec<Equation>,
}

impl Jacobians {
    /// The maps of the vocabulary; the error names a map that makes no sense.
    pub fn new(vocabulary: &Vocabulary, atoms: &mut Atoms) -> Result<Self, String> {
        let (blank, meaning) = (Self::default(), super::meaning::Meaning::default());
        let mut reading = Reading::new(vocabulary, &blank, atoms, &meaning, &[]);
        let mut maps = Vec::new();
        for (name, map) in &vocabulary.maps {
            let kind = match map {
                Map::Product(factors) => Kind::Product(factors.clone()),
                Map::Premises { of, by } => Kind::Step(Step {
                    of: quantities(of, &mut reading).ok_or(format!("map `{name}`: `of` must list times and states"))?,
                    by: quantities(by, &mut reading).ok_or(format!("map `{name}`: `by` must list times and states"))?,
                    equations: Vec::new(),
                }),
                Map::Equations(equations) => Kind::Step(explicit(equations, &mut reading).ok_or(format!(
                    "map `{name}`: its equations must take the states at one impact to the next"
                ))?),
            };
            maps.push((name.clone(), kind));
        }
        Ok(Self { maps, opaque: false })
    }

    /// The maps with derivatives of their own.
    pub fn steps(&self) -> impl Iterator<Item = (&Name, &Step)> {
        self.maps.iter().filter_map(|(name, kind)| match kind {
            Kind::Step(step) => Some((name, step)),
            Kind::Product(_) => None,
        })
    }

    /// The derivative of one quantity by another: 1 and 0 among those a map starts from, by the chain rule where impacts lie between.
    pub fn entry(&self, of: Variable, by: Variable, atoms: &mut Atoms) -> Option<Fraction> {
        self.chain(of, by, atoms, self.maps.len())
    }

    fn chain(&self, of: Variable, by: Variable, atoms: &mut Atoms, left: usize) -> Option<Fraction> {
        let here = |step: &Step| step.by.contains(&by);
        // What a map starts from is independent of one another.
        if self.steps().any(|(_, step)| here(step) && step.by.contains(&of)) {
            return Some(Fraction::from_integer(i64::from(of == by)));
        }
        if self.steps().any(|(_, step)| here(step) && step.of.contains(&of)) {
            return Some(Fraction::variable(atoms.variable(Atom::Partial { of, by })));
        }
        if left == 0 {
            return None;
        }
        self.steps().filter(|(_, step)| here(step)).find_map(|(_, step)| {
            step.of.iter().try_fold(Fraction::zero(), |sum, &between| {
                let inner = Fraction::variable(atoms.variable(Atom::Partial { of: between, by }));
                Some(sum + self.chain(of, between, atoms, left - 1)? * inner)
            })
        })
    }

    /// The matrix of a map, each derivative as `known` has it.
    pub fn matrix(
        &self,
        name: &Name,
        atoms: &mut Atoms,
        known: &dyn Fn(Variable) -> Fraction,
    ) -> Option<DMatrix<Fraction>> {
        self.product(name, atoms, known, self.maps.len())
    }

    fn product(
        &self,
        name: &Name,
        atoms: &mut Atoms,
        known: &dyn Fn(Variable) -> Fraction,
        left: usize,
    ) -> Option<DMatrix<Fraction>> {
        match &self.maps.iter().find(|(map, _)| map == name)?.1 {
            Kind::Step(step) => Some(DMatrix::from_fn(step.of.len(), step.by.len(), |row, column| {
                known(atoms.variable(Atom::Partial {
                    of: step.of[row],
                    by: step.by[column],
                }))
            })),
            Kind::Product(_) if left == 0 => None,
            Kind::Product(factors) => factors
                .iter()
                .try_fold(None, |product: Option<DMatrix<Fraction>>, factor| {
                    let next = self.product(factor, atoms, known, left - 1)?;
                    Some(Some(match product {
                        Some(product) if product.ncols() != next.nrows() => return None,
                        Some(product) => product * next,
                        None => next,
                    }))
                })?,
        }
    }
}

/// Trace or determinant of a square matrix.
pub fn invariant(kind: Invariant, matrix: &DMatrix<Fraction>) -> Option<Fraction> {
    if !matrix.is_square() {
        return None;
    }
    Some(match kind {
        Invariant::Trace => matrix
            .diagonal()
            .iter()
            .fold(Fraction::zero(), |sum, entry| sum + entry.clone()),
        Invariant::Determinant => determinant(matrix),
    })
}

/// By the first row: the maps of impacts have two rows, and nothing here may be divided by.
fn determinant(matrix: &DMatrix<Fraction>) -> Fraction {
    if matrix.is_empty() {
        return Fraction::from_integer(1);
    }
    (0..matrix.ncols()).fold(Fraction::zero(), |sum, column| {
        let entry = matrix[(0, column)].clone();
        if entry.is_zero() {
            return sum;
        }
        // Not nalgebra's remove_column: in 0.35 it drops twice what it removes.
        let minor = DMatrix::from_fn(matrix.nrows() - 1, matrix.ncols() - 1, |i, j| {
            matrix[(i + 1, if j < column { j } else { j + 1 })].clone()
        });
        let product = entry * determinant(&minor);
        if column % 2 == 0 { sum + product } else { sum - product }
    })
}

fn quantities(trees: &[Tree], reading: &mut Reading) -> Option<Vec<Variable>> {
    let quantity = |tree: &Tree| match tree {
        Tree::Symbol(name, _) => reading.quantity(name).map(|atom| reading.atoms.variable(atom)),
        _ => None,
    };
    trees.iter().map(quantity).collect()
}

/// The map from the first impact that its equations name to the last: times before states, as declared.
fn explicit(equations: &[Equation], reading: &mut Reading) -> Option<Step> {
    let mut met = BTreeSet::new();
    for equation in equations {
        for side in [&equation.left, &equation.right] {
            met.extend(reading.tree(side).ok()?.variables());
        }
    }
    let mut order: Vec<(i32, usize, Variable)> = Vec::new();
    for variable in met {
        match reading.atoms.atom(variable) {
            Some(Atom::Time { index, .. }) => order.push((*index, 0, variable)),
            Some(Atom::State { state, index, .. }) => {
                let rank = reading.vocabulary.states.iter().position(|known| known == state)?;
                order.push((*index, rank + 1, variable));
            }
            _ => {}
        }
    }
    order.sort();
    let (first, last) = (order.first()?.0, order.last()?.0);
    let side = |index| {
        order
            .iter()
            .filter(|(i, ..)| *i == index)
            .map(|(.., v)| *v)
            .collect::<Vec<_>>()
    };
    (first < last).then(|| Step {
        of: side(last),
        by: side(first),
        equations: equations.to_vec(),
    })
}

/// An equation that the premises imply for the derivatives of a map.
pub struct Derived {
    /// The premise differentiated, by its position in the list given.
    pub premise: usize,
    pub by: Variable,
    pub residual: Polynomial,
}

/// Differentiates along `step` as many of the premises as determine it: those that speak of no other impact, the
/// ones with a state before the others. What is left over restricts the point, not the map.
pub fn differentiate(
    step: &Step,
    premises: &[(usize, Polynomial)],
    reading: &mut Reading,
) -> Result<Vec<Derived>, Meaningless> {
    let mut order: Vec<&(usize, Polynomial)> = premises.iter().collect();
    let has_state = |p: &Polynomial, atoms: &Atoms| {
        p.variables()
            .iter()
            .any(|&v| matches!(atoms.atom(v), Some(Atom::State { .. })))
    };
    order.sort_by_key(|(_, residual)| !has_state(residual, reading.atoms));
    let (mut derived, mut unknown, mut rows) = (Vec::new(), BTreeSet::new(), Vec::new());
    let Some(&first) = step.by.first() else {
        return Ok(derived);
    };
    for (premise, residual) in order {
        let slope = along(residual, first, step, reading)?;
        unknown.extend(
            residual
                .variables()
                .into_iter()
                .filter(|v| depends(*v, step, reading.atoms)),
        );
        rows.push(slope.clone());
        derived.push(Derived {
            premise: *premise,
            by: first,
            residual: slope,
        });
        for &by in step.by.iter().skip(1) {
            derived.push(Derived {
                premise: *premise,
                by,
                residual: along(residual, by, step, reading)?,
            });
        }
        let columns: Vec<Variable> = unknown
            .iter()
            .map(|&of| reading.atoms.variable(Atom::Partial { of, by: first }))
            .collect();
        if step.of.iter().all(|of| unknown.contains(of)) && rank(&rows, &columns) >= unknown.len() {
            break;
        }
    }
    Ok(derived)
}

/// Whether a quantity changes when the start of the step does, other than being that start.
fn depends(variable: Variable, step: &Step, atoms: &Atoms) -> bool {
    matches!(atoms.atom(variable), Some(Atom::Time { .. } | Atom::State { .. })) && !step.by.contains(&variable)
}

/// The derivative of a residual by one of the quantities the step starts from, the others held.
fn along(residual: &Polynomial, by: Variable, step: &Step, reading: &mut Reading) -> Result<Polynomial, Meaningless> {
    let mut failure = None;
    let slope = Derivation::new(|variable| {
        slope_of(variable, by, step, reading).unwrap_or_else(|error| {
            failure = Some(error);
            Fraction::zero()
        })
    })
    .of_polynomial(residual);
    failure.map_or(Ok(slope.numerator().clone()), Err)
}

fn slope_of(variable: Variable, by: Variable, step: &Step, reading: &mut Reading) -> Result<Fraction, Meaningless> {
    if variable == by {
        return Ok(Fraction::from_integer(1));
    }
    if depends(variable, step, reading.atoms) {
        return Ok(Fraction::variable(
            reading.atoms.variable(Atom::Partial { of: variable, by }),
        ));
    }
    match reading.atoms.atom(variable).cloned() {
        Some(Atom::Value { function, argument }) => {
            let mut inner = Fraction::zero();
            for inside in argument.variables() {
                let slope = slope_of(inside, by, step, reading)?;
                let along =
                    Fraction::from(argument.numerator().derivative(inside)) / Fraction::from(argument.denominator());
                inner += along * slope;
            }
            if inner.is_zero() {
                Ok(inner)
            } else {
                Ok(inner * reading.slope(&function, &argument)?)
            }
        }
        Some(Atom::Circular { sine, angle }) => {
            let mut inner = Fraction::zero();
            for inside in angle.variables() {
                let along = Fraction::from(angle.numerator().derivative(inside)) / Fraction::from(angle.denominator());
                inner += along * slope_of(inside, by, step, reading)?;
            }
            if inner.is_zero() {
                Ok(inner)
            } else {
                Ok(inner * angle::slope(sine, &angle, reading.atoms))
            }
        }
        Some(Atom::Root { radicand }) => {
            let mut inner = Fraction::zero();
            let mut failure = None;
            let slope = Derivation::new(|v| {
                slope_of(v, by, step, reading).unwrap_or_else(|error| {
                    failure = Some(error);
                    Fraction::zero()
                })
            })
            .of(&radicand);
            inner += slope / (Fraction::from_integer(2) * Fraction::variable(variable));
            failure.map_or(Ok(inner), Err)
        }
        _ => Ok(Fraction::zero()),
    }
}

/// The rank of linear forms in `columns` at a point without any special property.
fn rank(rows: &[Polynomial], columns: &[Variable]) -> usize {
    let anywhere = |v: Variable| Some(Rational::from_ratio(i64::from(v.0) * 37 + 11, 97 - i64::from(v.0 % 13)));
    let mut matrix: Vec<Vec<Rational>> = rows
        .iter()
        .map(|row| {
            let slope = |column: &Variable| {
                row.derivative(*column)
                    .evaluate(&anywhere)
                    .unwrap_or_else(Rational::zero)
            };
            columns.iter().map(slope).collect()
        })
        .collect();
    let mut rank = 0;
    for column in 0..columns.len() {
        let Some(pivot) = (rank..matrix.len()).find(|&row| !matrix[row][column].is_zero()) else {
            continue;
        };
        matrix.swap(rank, pivot);
        let lead = matrix[rank].clone();
        for row in matrix.iter_mut().skip(rank + 1) {
            let factor = row[column].clone() / lead[column].clone();
            for (entry, top) in row.iter_mut().zip(&lead) {
                *entry -= factor.clone() * top.clone();
            }
        }
        rank += 1;
    }
    rank
}
