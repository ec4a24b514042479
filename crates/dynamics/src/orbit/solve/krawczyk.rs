//! A solution of a small system that is proved to be there, and to be the only one near.
//!
//! Krawczyk's operator K = m - Y F(m) + (I - Y J)(cell - m) proves one solution in a cell that it maps into its interior
//! (Krawczyk, 1969; Neumaier, *Interval Methods for Systems of Equations*, 1990, ch. 5).

#[cfg(any(test, feature = "calls"))]
use crate::model::calls::{self, Call};
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::interval_box::{IntervalBox, around, intersection, is_inside, is_subset, larger, width};
use nalgebra::SMatrix;
use numbers::{Analytic, Endpoint, Interval};

/// A proved solution.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedRoot<E: Endpoint, const D: usize> {
    /// Where it is.
    pub enclosure: IntervalBox<E, D>,
    /// The larger box in which it is the only one.
    pub unique: IntervalBox<E, D>,
}

/// The enclosure of a proved root is narrowed as long as it shrinks to this part of its width, or so many times;
/// while it nearly fills the box of the proof, as long as it shrinks at all.
const NARROWER: f64 = 0.9;
const MOST_IMAGES: usize = 40;

/// The roots without those that are another one shifted by a turn of unknown `phase`.
pub fn distinct_phases<E: Endpoint, const D: usize>(
    roots: Vec<ProvedRoot<E, D>>,
    phase: usize,
) -> Vec<ProvedRoot<E, D>> {
    let mut known: Vec<ProvedRoot<E, D>> = Vec::new();
    for root in roots {
        if !known.iter().any(|other| is_shifted(&root, other, phase)) {
            known.push(root);
        }
    }
    known
}

/// Whether `root` is `other`, shifted by a turn of unknown `phase` or not at all.
pub fn is_shifted<E: Endpoint, const D: usize>(
    root: &ProvedRoot<E, D>,
    other: &ProvedRoot<E, D>,
    phase: usize,
) -> bool {
    let turn = Interval::<E>::pi() + Interval::pi();
    let shifts = [Interval::point(E::zero()), turn.clone(), -turn];
    shifts.into_iter().any(|shift| {
        let mut shifted = root.enclosure.clone();
        shifted[phase] += shift;
        is_subset(&shifted, &other.unique)
    })
}

/// Proves a solution in the box of the given half-widths around `point`, and narrows it as far as rounding lets.
///
/// `None` where Krawczyk's operator does not map the box into its interior.
pub fn prove<E: Endpoint, const D: usize, S: SquareSystem<E, D>>(
    system: &S,
    point: &[E; D],
    half_widths: &[f64; D],
) -> Option<ProvedRoot<E, D>> {
    let unique: IntervalBox<E, D> = std::array::from_fn(|i| around(&point[i], half_widths[i]));
    let image = image_of(system, &unique)?;
    is_inside(&image, &unique).then(|| narrow(system, unique, image))
}

/// The root of which Krawczyk's operator has mapped the box `unique` into `image`, inside it. Each further image holds
/// the root as well; a few make it as narrow as rounding allows.
pub(crate) fn narrow<E: Endpoint, const D: usize, S: SquareSystem<E, D>>(
    system: &S,
    unique: IntervalBox<E, D>,
    mut image: IntervalBox<E, D>,
) -> ProvedRoot<E, D> {
    for _ in 0..MOST_IMAGES {
        let both = image_of(system, &image).and_then(|next| intersection(&next, &image));
        let Some(both) = both else {
            break;
        };
        let shrinks = (0..D).any(|i| {
            let before = width(&image[i]);
            let fills = before > 0.01 * width(&unique[i]);
            width(&both[i]) < before * if fills { 1.0 } else { NARROWER }
        });
        image = both;
        if !shrinks {
            break;
        }
    }
    let enclosure = image;
    ProvedRoot { enclosure, unique }
}

/// Narrows a solution known to lie near `point`, which has fewer digits than `E`: Newton steps in point arithmetic with
/// one inverse in f64, each worth some fifteen digits, then one Krawczyk operator on a box as small as rounding lets.
///
/// The answer is the box that is proved to hold one solution, and the narrower enclosure of it. `None` where the steps
/// do not settle or nothing is proved.
pub fn sharpen<E: Endpoint, const D: usize, S: SquareSystem<E, D>>(
    system: &S,
    point: [E; D],
) -> Option<ProvedRoot<E, D>> {
    let mut point = point;
    let (mut values, slopes) = system.linearised(&point.clone().map(Interval::point));
    let inverse = inverse(&slopes)?;
    // sizes in E: those of many digits are below all of f64
    let mut last: Option<E> = None;
    let size = loop {
        let step: [E; D] = std::array::from_fn(|row| {
            let terms = (0..D).map(|k| E::from_f64(inverse[(row, k)]) * values[k].midpoint());
            terms.fold(E::zero(), |sum, term| sum + term)
        });
        let size = step.iter().map(size).fold(E::zero(), larger);
        if !size.is_finite() {
            return None;
        }
        if last.as_ref().is_some_and(|last| size.clone() + size.clone() >= *last) {
            // only rounding is left
            break size;
        }
        point = std::array::from_fn(|i| point[i].clone() - step[i].clone());
        if size.is_zero() {
            break size;
        }
        // The next step would be shorter than this one by the same factor as this one than the last.
        let next = last.map(|last| size.clone() * size.clone() / last);
        if let Some(next) = next.filter(|next| *next <= E::epsilon()) {
            break next;
        }
        last = Some(size);
        values = system.values(&point.clone().map(Interval::point));
    };
    let largest = point.iter().map(self::size).fold(E::one(), larger);
    let blur = size + E::epsilon() * largest;
    ROOM.iter().find_map(|room| {
        let half_width = E::from_f64(*room) * blur.clone();
        let reach = Interval::new(-half_width.clone(), half_width);
        let unique = point.clone().map(|side| Interval::point(side) + reach.clone());
        let enclosure = image_of(system, &unique)?;
        let inside = is_inside(&enclosure, &unique);
        inside.then_some(ProvedRoot { enclosure, unique })
    })
}

fn size<E: Endpoint>(number: &E) -> E {
    if *number < E::zero() {
        -number.clone()
    } else {
        number.clone()
    }
}

/// How much wider than the rounding of a point a box around it is tried to be: beside another root the rounding of the
/// equations is some 1e10 times that of the point.
const ROOM: [f64; 9] = [8.0, 128.0, 2e3, 3e4, 1e6, 1e8, 1e10, 1e12, 1e15];

/// The inverse of the midpoints of derivatives, if it has one in f64.
fn inverse<E: Endpoint, const D: usize>(slopes: &[IntervalBox<E, D>; D]) -> Option<SMatrix<f64, D, D>> {
    let middle = SMatrix::<f64, D, D>::from_fn(|row, column| slopes[row][column].midpoint().to_f64());
    let inverse = middle.try_inverse()?;
    inverse.iter().all(|entry| entry.is_finite()).then_some(inverse)
}

/// K = m - Y F(m) + (I - Y J)(cell - m), of enclosures `slopes` of J over the cell, m its midpoint and Y the inverse of
/// the midpoints of J: it holds every solution in the cell. `None` where there is no such inverse, or no value.
pub fn image<E: Endpoint, const D: usize>(
    cell: &IntervalBox<E, D>,
    slopes: &[IntervalBox<E, D>; D],
    values: impl FnOnce(&IntervalBox<E, D>) -> Option<IntervalBox<E, D>>,
) -> Option<IntervalBox<E, D>> {
    #[cfg(any(test, feature = "calls"))]
    calls::count(Call::Certificate);
    let inverse = inverse(slopes)?;
    let at = cell.each_ref().map(|side| Interval::point(side.midpoint()));
    let values = values(&at)?;
    let y = |row: usize, column: usize| Interval::<E>::point(E::from_f64(inverse[(row, column)]));
    Some(std::array::from_fn(|row| {
        let mut image = at[row].clone();
        for (k, value) in values.iter().enumerate() {
            image -= y(row, k) * value.clone();
        }
        for column in 0..D {
            let mut rest = Interval::point(if row == column { E::one() } else { E::zero() });
            for (k, slope) in slopes.iter().enumerate() {
                rest -= y(row, k) * slope[column].clone();
            }
            image += rest * (cell[column].clone() - at[column].clone());
        }
        image
    }))
}

/// Krawczyk's image of a cell under a system.
fn image_of<E: Endpoint, const D: usize, S: SquareSystem<E, D>>(
    system: &S,
    cell: &IntervalBox<E, D>,
) -> Option<IntervalBox<E, D>> {
    let (_, slopes) = system.linearised(cell);
    image(cell, &slopes, |at| Some(system.values(at)))
}

/// The root over `E`, proved again there: the only one in the box that `F` proved.
///
/// `None` where no box around it proves it.
pub fn prove_over<F: Endpoint, E: Endpoint, const D: usize>(
    system: &impl SquareSystem<E, D>,
    root: &ProvedRoot<F, D>,
) -> Option<IntervalBox<E, D>> {
    let proved = sharpen(system, root.enclosure.each_ref().map(|side| carried(&side.midpoint())))?;
    let known = |side: &Interval<F>| Interval::new(carried(&side.low()), carried(&side.high()));
    // one solution in the new box, and it lies where the old one is the only one: the same
    let mut sides = proved.enclosure.iter().zip(&root.unique);
    sides
        .all(|(side, unique)| side.is_subset(&known(unique)))
        .then_some(proved.enclosure)
}

/// A number in another type, to some thirty digits.
fn carried<F: Endpoint, E: Endpoint>(number: &F) -> E {
    let high = number.to_f64();
    let low = (number.clone() - F::from_f64(high)).to_f64();
    E::from_f64(high) + E::from_f64(low)
}
