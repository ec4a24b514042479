//! Derivatives of the map from impact to impact: by (20) and (21), confirmed by dual numbers.

use super::problem::Problem;
use super::values::{Number, Values, number, read};
use super::{Means, Why, orbits, runs};
use dynamics::impact::Origin;
use dynamics::model::{Forcing, Impact, JacobianError, Motion, Parameters, Passage, Side, next_impact};
use dynamics::orbit::{RoundedOrbit, shoot};
use nalgebra::Matrix2;
use numbers::{Analytic, Field, Wide};

/// What the answers rest on.
pub const MEANS: [&str; 2] = ["(20) and (21)", "dual numbers in 100 digits"];

type Many = Wide<100>;

/// The quantities by both means.
pub fn both(problem: &Problem) -> Result<[Values<Number>; 2], Why> {
    if problem.cycle.is_some() {
        of_cycle(problem)
    } else {
        of_flight(problem)
    }
}

/// The quantities in f64, by (20) and (21).
pub fn solved(problem: &Problem, means: Means) -> Result<Values<f64>, Why> {
    let motion = problem.given()?.motion::<f64>()?;
    let matrix = if problem.cycle.is_some() {
        let orbit = orbits::in_f64(problem, means)?;
        let fixes = fixes(&orbit, |value| *value);
        return Ok(with_determinant(
            &product(&motion, &fixes, Passage::by_formula)?,
            Some(orbit.trace),
            orbit.determinant,
        ));
    } else {
        let duration = one(problem, means)?;
        let passage = passage(problem, &motion, duration)?;
        passage.by_formula()?
    };
    let determinant = crossed(&matrix);
    Ok(with_determinant(&matrix, None, determinant))
}

/// The duration of the flight that follows the start, in f64.
fn one(problem: &Problem, means: Means) -> Result<f64, Why> {
    let flight = Problem {
        impacts: Some(1),
        ..*problem
    };
    let found = runs::solved(&flight, means)?;
    found.0.first().map(|(_, time)| *time).ok_or(Why::NoRest)
}

fn passage<T: Analytic>(problem: &Problem, motion: &Motion<T>, duration: T) -> Result<Passage<T>, Why> {
    let start = problem.begin()?.start::<T>();
    let forcing = Forcing::harmonic(&start.phase);
    let impact = Impact {
        side: start.side,
        time: T::zero(),
        velocity: start.velocity,
    };
    Ok(Passage::new(motion, &forcing, &impact, &duration))
}

/// The determinant: nalgebra's own asks for an order.
fn crossed<T: Analytic>(matrix: &Matrix2<T>) -> T {
    matrix.m11.clone() * matrix.m22.clone() - matrix.m12.clone() * matrix.m21.clone()
}

fn with_determinant<T: Analytic>(matrix: &Matrix2<T>, trace: Option<T>, determinant: T) -> Values<T> {
    let values = Values::of_matrix(matrix);
    let values = match trace {
        Some(trace) => values.and("trace", trace),
        None => values,
    };
    values.and("determinant", determinant)
}

/// One flight. The second means takes the duration from flights by pieces, the first from brackets.
fn of_flight(problem: &Problem) -> Result<[Values<Number>; 2], Why> {
    let motion = problem.given()?.motion::<Many>()?;
    let start = problem.begin()?.start::<Many>();
    let forcing = Forcing::harmonic(&start.phase);
    let impact = Impact {
        side: start.side,
        time: Many::from_integer(0),
        velocity: start.velocity,
    };
    let leg = next_impact(&motion, &forcing, &impact)?;
    let first = passage(problem, &motion, leg.duration)?.by_formula()?;
    // the determinant of one impact is r² times the ratio of the velocities
    let r = motion.restitution(impact.side).clone();
    let by_ratio = r.clone() * r * impact.velocity / leg.to.velocity;

    let flight = Problem {
        impacts: Some(1),
        ..*problem
    };
    let [by_pieces, _] = runs::both(&flight)?;
    let (_, duration) = by_pieces.0.first().ok_or(Why::NoRest)?;
    let second = passage(problem, &motion, duration.convert::<100>())?.by_duals()?;
    let determinant = crossed(&second);
    Ok([
        with_determinant(&first, None, by_ratio).convert(number),
        with_determinant(&second, None, determinant).convert(number),
    ])
}

/// An impact of a cycle with the flight after it: wall, phase, velocity, duration.
type Fix<T> = (Side, T, T, T);

fn fixes<N, T>(orbit: &RoundedOrbit<N>, read: impl Fn(&N) -> T) -> Vec<Fix<T>> {
    let lists = orbit
        .word
        .sides()
        .zip(&orbit.phases)
        .zip(&orbit.velocities)
        .zip(&orbit.times);
    lists
        .map(|(((side, phase), velocity), time)| (side, read(phase), read(velocity), read(time)))
        .collect()
}

/// The derivative over a cycle: the product of those of its flights.
fn product<T: Analytic>(
    motion: &Motion<T>,
    fixes: &[Fix<T>],
    means: impl Fn(&Passage<T>) -> Result<Matrix2<T>, JacobianError>,
) -> Result<Matrix2<T>, Why> {
    let mut product = Matrix2::identity();
    for (side, phase, velocity, duration) in fixes {
        let forcing = Forcing::harmonic(phase);
        let impact = Impact {
            side: *side,
            time: T::zero(),
            velocity: velocity.clone(),
        };
        product = means(&Passage::new(motion, &forcing, &impact, duration))? * product;
    }
    Ok(product)
}

/// A whole cycle, at the proved enclosure by formula, at the fixed point of the return map by dual numbers.
fn of_cycle(problem: &Problem) -> Result<[Values<Number>; 2], Why> {
    let motion = problem.given()?.motion::<Many>()?;
    let [orbit, _] = orbits::twice(problem)?;
    let exact = fixes(&orbit, |decimal| read(decimal).convert::<100>());
    let formula = product(&motion, &exact, Passage::by_formula)?;
    let [trace, determinant] = [&orbit.trace, &orbit.determinant].map(|value| read(value).convert::<100>());

    let again = shoot::<Many>(&motion, &orbit.nearest())?;
    let impacts = orbit.word.sides().zip(again.fixes);
    let found: Vec<Fix<Many>> = impacts
        .map(|(side, fix)| (side, fix.phase, fix.velocity, fix.time))
        .collect();
    let duals = product(&motion, &found, Passage::by_duals)?;
    let by_duals = (duals.trace(), crossed(&duals));
    Ok([
        with_determinant(&formula, Some(trace), determinant).convert(number),
        with_determinant(&duals, Some(by_duals.0), by_duals.1).convert(number),
    ])
}
