//! The proof that an orbit exists near a proposal, that it is the only one there, and where exactly it is.

use crate::orbit::equations::words::WordEquations;
use crate::orbit::interval_box::apart;
use crate::orbit::solve::contraction::{contraction, largest, times};
use nalgebra::DMatrix;
use numbers::{Analytic, Endpoint, Field, Interval};

/// A box with one orbit in it.
///
/// H the residuals, Y the inverse of their derivative at the centre c, about: if |I - Y H'| <= q < 1 on the box
/// |x - c| <= R in the maximum norm and |Y H(c)| < (1 - q) R, then x - Y H(x) maps the box into its inside and
/// contracts it, so that H has one zero there and no other (Krawczyk; Moore, Kearfott and Cloud 2009, 8.2). All of it
/// is checked in intervals, for every motion within the intervals of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Proof {
    pub centre: Vec<f64>,
    /// R, in radians.
    pub radius: f64,
    /// How far from the centre the orbit is at most.
    pub error: f64,
    inverse: DMatrix<f64>,
    contraction: f64,
}

/// Radii tried, from the first: below the last one only rounding is left.
const RADII: usize = 14;
const LARGEST_RADIUS: f64 = 0.1;
const SHRINK: f64 = 0.125;

/// Newton steps with a fixed derivative: each gains as many digits as f64 has, less the condition.
const MOST_STEPS: usize = 60;

/// The proof around `phases`, with the largest radius tried that has one: over a wider number, of motions whose flights
/// are so short that f64 cannot tell them from none.
pub(crate) fn prove<E: Endpoint>(system: &WordEquations<Interval<E>>, phases: &[f64]) -> Option<Proof> {
    let at_centre: Vec<_> = phases.iter().map(|phase| Interval::from_f64(*phase)).collect();
    let inverse = inverse_at(system, &at_centre)?;
    let step = largest(&times(&inverse, &system.residuals(&at_centre)));
    let mut radius = LARGEST_RADIUS;
    for _ in 0..RADII {
        let reach = Interval::new(-E::from_f64(radius), E::from_f64(radius));
        let whole: Vec<_> = at_centre.iter().map(|phase| phase.clone() + reach.clone()).collect();
        let contraction = contraction(&inverse, &system.jacobian(&whole));
        if contraction < 1.0 {
            let error = error(step.clone(), contraction).to_f64().next_up();
            if error < radius {
                return Some(Proof {
                    centre: phases.to_vec(),
                    radius,
                    error,
                    inverse,
                    contraction,
                });
            }
        }
        radius *= SHRINK;
    }
    None
}

/// The inverse of the derivatives at a point, about, if it has one in f64.
fn inverse_at<E: Endpoint>(system: &WordEquations<Interval<E>>, point: &[Interval<E>]) -> Option<DMatrix<f64>> {
    let rows = system.jacobian(point);
    let middle = DMatrix::from_fn(rows.len(), rows.len(), |row, column| rows[row][column].to_f64());
    let inverse = middle.try_inverse()?;
    inverse.iter().all(|entry| entry.is_finite()).then_some(inverse)
}

/// Where Newton's method leads from `phases` in a wider number, to about its last step: proposed, not proved.
pub(crate) fn approached<E: Endpoint>(system: &WordEquations<Interval<E>>, phases: &[f64]) -> Vec<Interval<E>> {
    let mut point: Vec<Interval<E>> = phases.iter().map(|phase| Interval::from_f64(*phase)).collect();
    let mut least: Option<E> = None;
    for _ in 0..MOST_STEPS {
        let Some(inverse) = inverse_at(system, &point) else {
            break;
        };
        let step = times(&inverse, &system.residuals(&point));
        let size = largest(&step);
        if !size.is_finite() || least.as_ref().is_some_and(|least| size >= *least) {
            break;
        }
        let moved = point.into_iter().zip(step);
        point = moved
            .map(|(phase, step)| Interval::point((phase - step).midpoint()))
            .collect();
        least = Some(size);
    }
    let far = least.unwrap_or_else(|| E::from_f64(LARGEST_RADIUS));
    let off = Interval::new(-far.clone(), far);
    point.into_iter().map(|phase| phase + off.clone()).collect()
}

/// |Y H(x)| / (1 - q) bounds the distance of x from the zero: x - x* is Y H(x) + (I - Y H')(x - x*) for some H'.
fn error<E: Endpoint>(step: E, contraction: f64) -> E {
    let left = Interval::from_integer(1) - Interval::from_f64(contraction);
    (Interval::point(step) / left).high()
}

impl Proof {
    /// The phases of the orbit over another number, as narrow as that number allows. `system` has to be at the motion
    /// of the proof: its intervals inside those.
    ///
    /// The proof holds on for all numbers; only the point it is told from is improved.
    pub fn refined<E: Endpoint>(&self, system: &WordEquations<Interval<E>>) -> Vec<Interval<E>> {
        let mut best = self.around_centre();
        let mut point: Vec<Interval<E>> = self.centre.iter().map(|phase| Interval::from_f64(*phase)).collect();
        let mut least = None;
        for _ in 0..MOST_STEPS {
            let step = times(&self.inverse, &system.residuals(&point));
            let size = largest(&step);
            let error = error(size.clone(), self.contraction);
            // steps shrink until rounding is all that they are made of
            let shrinks = least.as_ref().is_none_or(|least| size < *least);
            if !shrinks || !self.holds(&point) || !error.is_finite() {
                break;
            }
            best = point
                .iter()
                .map(|phase| phase.clone() + Interval::new(-error.clone(), error.clone()))
                .collect();
            least = Some(size);
            let moved = point.into_iter().zip(step);
            point = moved
                .map(|(phase, step)| Interval::point((phase - step).midpoint()))
                .collect();
        }
        best
    }

    fn around_centre<E: Endpoint>(&self) -> Vec<Interval<E>> {
        let error = E::from_f64(self.error).above();
        let around = |phase: &f64| Interval::from_f64(*phase) + Interval::new(-error.clone(), error.clone());
        self.centre.iter().map(around).collect()
    }

    /// Whether the point is in the box.
    fn holds<E: Endpoint>(&self, point: &[Interval<E>]) -> bool {
        let reach = Interval::new(-E::from_f64(self.radius), E::from_f64(self.radius));
        let pairs = point.iter().zip(&self.centre);
        pairs
            .map(|(phase, centre)| phase.clone() - Interval::from_f64(*centre))
            .all(|apart| apart.is_inside(&reach))
    }

    /// Whether an orbit within `error` of `phases` lies in this box, so that it is this orbit. `phases` are in the
    /// same turn and order as the centre.
    pub fn covers(&self, phases: &[f64], error: f64) -> bool {
        // whole turns were added in f64, to phases of a few turns at most
        let rounding = 1e-13;
        apart(phases, &self.centre) + error + rounding < self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::solve::starts::{solve_word, starts};
    use numbers::Wide;

    fn system<T: Analytic>(word: &str) -> WordEquations<T> {
        let [g, d, r_b, r_t] = [12, 26, 60, 30].map(|hundredths| T::from_ratio(hundredths, 100));
        WordEquations {
            motion: Motion::new(g, d, r_b, r_t).expect("a motion"),
            word: word.parse().expect("a word"),
            periods: 1,
        }
    }

    #[test]
    fn a_proved_box_holds_the_orbit_of_many_digits_and_no_second_one() {
        let narrow = system::<f64>("BTT");
        let intervals = system::<Interval<f64>>("BTT");
        let mut proved = 0;
        for phases in starts(&narrow, 200).filter_map(|start| solve_word(&narrow, start)) {
            let proof = prove(&intervals, &phases).expect("a proof");
            proved += 1;
            assert!(
                proof.error < 1e-12 && proof.radius > 1e-5,
                "{} {}",
                proof.error,
                proof.radius
            );
            let refined = proof.refined(&intervals);
            assert!(refined.iter().all(|phase| phase.width() < 1e-12));
            // Newton's method in 40 digits shares the equations and nothing else
            let wide = system::<Wide<40>>("BTT");
            let mut exact: Vec<Wide<40>> = phases.iter().map(|phase| Wide::from_f64(*phase)).collect();
            for _ in 0..6 {
                let residuals = wide.residuals(&exact);
                for (row, phase) in exact.iter_mut().enumerate() {
                    for (column, residual) in residuals.iter().enumerate() {
                        *phase -= Wide::from_f64(proof.inverse[(row, column)]) * residual.clone();
                    }
                }
            }
            for (phase, exact) in refined.iter().zip(&exact) {
                assert!(Wide::from_f64(phase.low()) <= *exact && *exact <= Wide::from_f64(phase.high()));
            }
        }
        assert!(proved > 20);
    }

    #[test]
    fn where_there_is_no_orbit_there_is_no_proof() {
        let intervals = system::<Interval<f64>>("BT");
        assert_eq!(prove(&intervals, &[0.3, 3.0]), None);
    }
}
