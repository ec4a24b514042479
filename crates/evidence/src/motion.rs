//! The maps of the device itself, flown from a point of the premises: DP by dual numbers and by differences.
//!
//! Whether a point is one of the paper's motion is not told by labels: the flight from it must arrive when, where
//! and as fast as the point says.

use super::course::{HARMONICS, LONG, POWERS_OF_LAW};
use super::gap::digits;
use super::maps::Step;
use super::space::{Course, Slot};
use super::system::System;
use super::tolerance::{MOST_DIGITS, MOTION};
use dynamics::model::{Flight, Forcing, Impact, Leg, Motion, Order, Passage, Side};
use nalgebra::Matrix2;
use numbers::{Dual, seeded};
use texmath::Invariant;

/// In how many digits implicit differentiation agrees with the maps, at the worst of the points flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flown {
    pub points: usize,
    /// Entries of the matrices: by dual numbers, by differences of order 2 and of order 4.
    pub duals: f64,
    pub second: f64,
    pub fourth: f64,
    /// Traces and determinants of products, by dual numbers.
    pub products: f64,
}

impl Flown {
    /// The digits that differences of order 2 and 4 can reach in f64: epsilon to the powers 2/3 and 4/5.
    pub fn reach() -> [f64; 2] {
        [2.0 / 3.0, 4.0 / 5.0].map(|part| -part * f64::EPSILON.log10())
    }

    /// The worse of both in everything, the points added.
    pub fn and(self, other: Self) -> Self {
        Self {
            points: self.points + other.points,
            duals: self.duals.min(other.duals),
            second: self.second.min(other.second),
            fourth: self.fourth.min(other.fourth),
            products: self.products.min(other.products),
        }
    }
}

impl std::fmt::Display for Flown {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [second, fourth] = Self::reach();
        write!(
            f,
            "derivatives agree with those of the maps flown at {} points: by dual numbers to {:.1} digits, by differences \
             of order 2 to {:.1} (of {second:.1} within reach), of order 4 to {:.1} (of {fourth:.1})",
            self.points, self.duals, self.second, self.fourth
        )?;
        if self.products < MOST_DIGITS {
            write!(f, "; trace and determinant by dual numbers to {:.1}", self.products)?;
        }
        Ok(())
    }
}

/// One flight of the point, and what the derivatives of its map are by each means.
struct FlownStep {
    implicit: Matrix2<f64>,
    duals: Matrix2<f64>,
    second: Matrix2<f64>,
    fourth: Matrix2<f64>,
}

impl System {
    /// Flies the maps at a point; nothing where the point is not one of the device's motion.
    pub fn flown(&self, values: &[f64]) -> Option<Flown> {
        let steps: Vec<Option<FlownStep>> = self.maps.steps.iter().map(|step| self.fly(step, values)).collect();
        let mut flown = Flown {
            points: 1,
            duals: MOST_DIGITS,
            second: MOST_DIGITS,
            fourth: MOST_DIGITS,
            products: MOST_DIGITS,
        };
        steps.iter().any(Option::is_some).then_some(())?;
        for step in steps.iter().flatten() {
            flown.duals = flown.duals.min(agreement(&step.implicit, &step.duals));
            flown.second = flown.second.min(agreement(&step.implicit, &step.second));
            flown.fourth = flown.fourth.min(agreement(&step.implicit, &step.fourth));
        }
        for (name, factors) in &self.maps.products {
            let position = |factor: &texmath::Name| self.maps.steps.iter().position(|step| step.name == *factor);
            let of = |factor: &texmath::Name| steps.get(position(factor)?)?.as_ref().map(|step| step.duals);
            let product = factors
                .iter()
                .try_fold(Matrix2::identity(), |product, factor| Some(product * of(factor)?));
            let Some(product) = product else { continue };
            let product: Matrix2<f64> = product;
            for (_, kind, program) in self.invariants.iter().filter(|(other, ..)| other == name) {
                let known = match kind {
                    Invariant::Trace => product.trace(),
                    Invariant::Determinant => product.determinant(),
                };
                let found = program.run(&self.inputs(values, None));
                let (Some(&output), Some(sizes)) = (program.outputs.first(), program.sizes(&found, &|_| 0.0)) else {
                    continue;
                };
                let (value, size) = (found.get(output)?, sizes.get(output)?);
                flown.products = flown.products.min(digits((value - known).abs() / size));
            }
        }
        Some(flown)
    }

    fn parameter(&self, name: &str, values: &[f64]) -> Option<f64> {
        let is = |slot: &Slot| matches!(slot, Slot::Parameter(known) if known.to_string() == name);
        values.get(self.space.slots.iter().position(is)?).copied()
    }

    /// The forcing of the point, and the mean that its f has besides.
    fn forcing(&self, values: &[f64]) -> Option<(Forcing<f64>, f64)> {
        let course = self
            .space
            .courses
            .iter()
            .find(|course| course.flight.is_none() && course.law.is_none())?;
        let first = course.first?;
        let period = self.length(course, values)?;
        let coefficient = |term: usize| values.get(first + term).copied().unwrap_or(0.0);
        let harmonic = |part: usize| (0..HARMONICS).map(move |n| course.names.len() + POWERS_OF_LAW + 2 * n + part);
        let [cosines, sines] = [0, 1].map(|part| harmonic(part).map(coefficient).collect::<Vec<f64>>());
        let constant = course.names.len().checked_sub(1)?;
        let has_mean = course.period.is_none_or(|(level, _)| level >= constant);
        let mean = if has_mean { coefficient(constant) } else { 0.0 };
        Some((Forcing::periodic(period, &cosines, &sines).ok()?, mean))
    }

    /// The period of a forcing.
    fn length(&self, course: &Course, values: &[f64]) -> Option<f64> {
        let Some((_, period)) = course.period else {
            return Some(LONG);
        };
        let program = self.formulas.program(&[period]);
        program.outputs(&program.run(&self.inputs(values, None))).pop()
    }

    /// The flight of one map, from the impact that it starts with.
    fn fly(&self, step: &Step, values: &[f64]) -> Option<FlownStep> {
        let ([of_time, of_velocity], [by_time, by_velocity]) = (step.of.as_slice(), step.by.as_slice()) else {
            return None;
        };
        let value = |slot: &usize| values.get(*slot).copied();
        let (start, velocity) = (value(by_time)?, value(by_velocity)?);
        let (duration, arrival) = (value(of_time)? - start, value(of_velocity)?);
        let (forcing, mean) = self.forcing(values)?;
        let parameter = |name: &str| self.parameter(name, values);
        let r = |name: &str| parameter(name).unwrap_or(0.5);
        let g = parameter(r"\overline{g}").unwrap_or(0.0) + mean;
        let motion = Motion::new(g, parameter("d")?, r("r_B"), r("r_T")).ok()?;
        let side = if velocity > 0.0 { Side::Bottom } else { Side::Top };
        let impact = Impact {
            side,
            time: start,
            velocity,
        };
        let flight = Flight::after(&motion, &forcing, &impact).ok()?;
        let (state, wall) = (flight.state(&duration), flight.target(side.opposite()));
        let near = |a: f64, b: f64| (a - b).abs() <= MOTION * (1.0 + b.abs());
        if duration <= 0.0 || !near(state.displacement, wall) || !near(state.velocity, arrival) {
            return None;
        }
        let partial = |of: usize, by: usize| values.get(self.space.find(&Slot::Partial { of, by })?).copied();
        let implicit = Matrix2::new(
            partial(*of_time, *by_time)?,
            partial(*of_time, *by_velocity)?,
            partial(*of_velocity, *by_time)?,
            partial(*of_velocity, *by_velocity)?,
        );
        let passage = Passage::new(&motion, &forcing, &impact, &duration);
        Some(FlownStep {
            implicit,
            duals: by_map(&motion, &forcing, &impact, duration)?,
            second: passage.by_differences(Order::Two).ok()?,
            fourth: passage.by_differences(Order::Four).ok()?,
        })
    }
}

/// The derivative of the map to the other wall by dual numbers through its flight, closed from its known duration.
fn by_map(motion: &Motion<f64>, forcing: &Forcing<f64>, impact: &Impact<f64>, duration: f64) -> Option<Matrix2<f64>> {
    let lift = |value: &f64| Dual::from_re(*value);
    let (motion, forcing) = (motion.convert(lift).ok()?, forcing.convert(lift));
    let column = |time: Dual<f64>, velocity: Dual<f64>| {
        let from = Impact {
            side: impact.side,
            time,
            velocity,
        };
        let leg = Leg::closed(
            &motion,
            &forcing,
            &from,
            impact.side.opposite(),
            &Dual::from_re(duration),
        )
        .ok()?;
        Some(((time + leg.duration).eps, leg.to.velocity.eps))
    };
    let (a, c) = column(seeded(impact.time), lift(&impact.velocity))?;
    let (b, d) = column(lift(&impact.time), seeded(impact.velocity))?;
    Some(Matrix2::new(a, b, c, d))
}

fn agreement(a: &Matrix2<f64>, b: &Matrix2<f64>) -> f64 {
    digits((a - b).abs().max() / b.abs().max())
}
