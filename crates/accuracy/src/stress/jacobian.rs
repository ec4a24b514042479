//! The derivative of the return map where an impact is slow: (20) to (23), and in the scaled form without a division.

use super::StressError;
use super::approach::{Approach, SLOW};
use super::closed::{self, Closed};
use super::paper::{Formula, Paper, Values};
use super::quantity::{Number, Quantity, Visitor};
use dynamics::model::{Forced, Forcing, Motion, Pair, Passage, Side};
use dynamics::orbit::{FlightJacobian, OrbitImpact, determinant, flight_jacobians, trace};
use nalgebra::Matrix2;

/// What of the derivative.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    /// (20), the flight to the top.
    First,
    /// (21), the flight back.
    Second,
    /// (22)
    Trace,
    /// (23)
    Determinant,
    /// The determinant of the product of (20) and (21), m_11 m_22 - m_12 m_21.
    Product,
}

struct Derivative<'a> {
    part: Part,
    formulas: &'a [Formula],
}

/// Visits (20) to (23) and the determinant as a difference of products.
pub(super) fn each(paper: &Paper, visitor: &mut impl Visitor) -> Result<(), StressError> {
    // (22): a factor epsilon_1 and a factor epsilon_2 are missing, and a sign is wrong
    let mended = [
        ("[r_B + r_B T_1(", r"[r_B \epsilon_1 + r_B T_1("),
        ("[r_T - r_T T_2(", r"[r_T \epsilon_2 - r_T T_2("),
        (r"T_1 + \dot{Z}_k r_B", r"T_1 - \dot{Z}_k r_B"),
    ];
    let entries = [paper.formula("20", &[])?, paper.formula("21", &[])?];
    let [trace, determinant] = [paper.formula("22", &mended)?, paper.formula("23", &[])?];
    for (part, formulas) in [
        (Part::First, &entries[..1]),
        (Part::Second, &entries[1..]),
        (Part::Trace, std::slice::from_ref(&trace)),
        (Part::Determinant, std::slice::from_ref(&determinant)),
        (Part::Product, &entries[..]),
    ] {
        visitor.visit(&Derivative { part, formulas })?;
    }
    Ok(())
}

fn entries<T: Number>(matrix: &Matrix2<T>) -> Vec<T> {
    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| matrix[at].clone()).to_vec()
}

/// What the equations are written in.
fn values<T: Number>(closed: Closed<T>) -> Values<T> {
    let forcing = Forcing::harmonic(&T::zero());
    let [start, end] = closed.times.each_ref().map(|time| forcing.at(time));
    let [t_1, t_2] = closed.flights;
    let [v, w] = closed.velocities;
    let Forced { f, f1, .. } = start;
    Values::new([
        ("r_B", closed.r_b),
        ("r_T", closed.r_t),
        (r"\overline{g}", closed.g),
        ("T_1", t_1),
        ("T_2", t_2),
        (r"\dot{Z}_k", v),
        (r"\dot{Z}_{k+1}", w),
        ("f(t_k)", f.clone()),
        ("f(t_{k+1})", end.f),
        ("f(t_{k+2})", f),
        ("F_1(t_k)", f1.clone()),
        ("F_1(t_{k+1})", end.f1),
        ("F_1(t_{k+2})", f1),
    ])
}

fn matrix<T: Number>(values: Vec<T>) -> Option<Matrix2<T>> {
    // in the order of (20): by row
    let [a, b, c, d] = <[T; 4]>::try_from(values).ok()?;
    Some(Matrix2::new(a, b, c, d))
}

fn determinant_of<T: Number>(matrix: &Matrix2<T>) -> T {
    let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| matrix[at].clone());
    a * d - b * c
}

impl<'a> Derivative<'a> {
    fn links<T: Number>(closed: Closed<T>) -> Option<Vec<FlightJacobian<T>>> {
        let motion = Motion::new(closed.g, closed.d, closed.r_b, closed.r_t).ok()?;
        let [start, end] = closed.times.map(|time| time * T::pi());
        let ([v, w], [t_1, t_2]) = (closed.velocities, closed.flights);
        let fix = |phase, velocity, time| OrbitImpact { phase, velocity, time };
        let fixes = [fix(start, v, t_1), fix(end, w, t_2)];
        Some(flight_jacobians(&[Side::Bottom, Side::Top], &motion, &fixes))
    }
}

impl Quantity for Derivative<'_> {
    fn case(&self) -> &'static str {
        "slow impact"
    }

    fn formula(&self) -> &'static str {
        match self.part {
            Part::First => "(20)",
            Part::Second => "(21)",
            Part::Trace => "(22)",
            Part::Determinant => "(23)",
            Part::Product => "Det of (20) (21)",
        }
    }

    fn inputs(&self) -> &'static [&'static str] {
        // the velocities but for a common factor, which the amplitude of the forcing sets
        &["r_B", "r_T", "T_1", "bottom", "top"]
    }

    fn dials(&self) -> Vec<[f64; 2]> {
        let restitution = [0.05, 1.0];
        vec![restitution, restitution, [0.2, 1.8], [-15.0, 0.0], [-15.0, 0.0]]
    }

    fn set(&self, dials: &[f64]) -> Vec<f64> {
        let speed = |(at, dial): (usize, &f64)| if at < 3 { *dial } else { 10_f64.powf(*dial) };
        dials.iter().enumerate().map(speed).collect()
    }

    fn approach(&self) -> Approach {
        SLOW
    }

    fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
        let at_top = vec![0.6, 0.3, 0.7, 0.0, exponent];
        let at_bottom = vec![0.6, 0.3, 0.7, exponent, 0.0];
        match self.part {
            Part::First => vec![at_top],
            Part::Second => vec![at_bottom],
            _ => vec![at_top, at_bottom],
        }
    }

    fn exponents(&self) -> Vec<f64> {
        [-1, -4, -8, -12, -15].map(f64::from).to_vec()
    }

    fn given_names(&self) -> &'static [&'static str] {
        &closed::NAMES
    }

    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let [r_b, r_t, t_1, v, w] = inputs else {
            return None;
        };
        Closed::by_speeds(r_b, r_t, t_1, [v, w]).map(Closed::list)
    }

    /// By dual numbers through the flights.
    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let closed = Closed::of(&self.given(inputs)?)?;
        let motion = Motion::new(closed.g, closed.d, closed.r_b, closed.r_t).ok()?;
        let forcing = Forcing::harmonic(&T::zero());
        let [t_1, t_2] = &closed.flights;
        let pair = Pair::new(&motion, &forcing, &closed.times[0], &closed.velocities[0], [t_1, t_2]);
        Some(match self.part {
            Part::First => entries(&pair.first.by_duals().ok()?),
            Part::Second => entries(&pair.second.by_duals().ok()?),
            Part::Trace => vec![pair.product(Passage::by_duals).ok()?.trace()],
            Part::Determinant | Part::Product => vec![determinant_of(&pair.product(Passage::by_duals).ok()?)],
        })
    }

    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let values = values(Closed::of(given)?);
        let mut found = self.formulas.iter().map(|formula| formula.values(values.clone()));
        if self.part != Part::Product {
            return found.next()?;
        }
        let [first, second] = [matrix(found.next()??)?, matrix(found.next()??)?];
        Some(vec![determinant_of(&(second * first))])
    }

    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let links = Self::links(Closed::of(given)?)?;
        let scaled = |at: usize| {
            let link: &FlightJacobian<T> = links.get(at)?;
            Some(entries(
                &link.scaled_jacobian().map(|entry| entry / link.arrival.clone()),
            ))
        };
        match self.part {
            Part::First => scaled(0),
            Part::Second => scaled(1),
            Part::Trace => Some(vec![trace(&links)]),
            Part::Determinant | Part::Product => Some(vec![determinant(&links)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Agreeing;
    use super::*;

    #[test]
    fn mended_formulas_links_and_dual_numbers_agree_in_many_digits_at_every_setting() {
        each(&Paper::new().unwrap(), &mut Agreeing).unwrap();
    }
}
