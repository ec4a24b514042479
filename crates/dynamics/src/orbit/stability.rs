//! Stability of a periodic motion: trace, determinant and multipliers of the product of its Jacobians.

#[cfg(any(test, feature = "calls"))]
use crate::model::calls::{self, Call};
use nalgebra::Matrix2;
use numbers::{Analytic, Field};
use std::fmt;

/// What the derivative of a one-impact map is made of: the impact a flight starts from, and the flight.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightJacobian<T> {
    /// Of the wall the flight starts from.
    pub restitution: T,
    /// Just before the impact that the flight starts from.
    pub velocity: T,
    /// Of the flight.
    pub time: T,
    /// f + g at its start.
    pub push: T,
    /// f + g at its end.
    pub pull: T,
    /// The velocity with which it arrives.
    pub arrival: T,
}

impl<T: Field> FlightJacobian<T> {
    /// The derivative (20), (21) of (time, velocity) of the next impact by those of this one, times the velocity of
    /// arrival: entries without a division, so that they have values where the flight grazes.
    pub fn scaled_jacobian(&self) -> Matrix2<T> {
        #[cfg(any(test, feature = "calls"))]
        calls::count(Call::Jacobian);
        let Self {
            restitution,
            velocity,
            time,
            push,
            pull,
            arrival,
        } = self.clone();
        let time_by_time = push.clone() * time.clone() - restitution.clone() * velocity;
        let time_by_velocity = restitution.clone() * time;
        let velocity_by_time = time_by_time.clone() * pull.clone() - push * arrival.clone();
        let velocity_by_velocity = time_by_velocity.clone() * pull - restitution * arrival;
        Matrix2::new(time_by_time, time_by_velocity, velocity_by_time, velocity_by_velocity)
    }
}

/// The trace of the derivative of one period: of the product of the Jacobians of `links`, in order. The only
/// division is the last one, by the product of the velocities; the links must close.
pub fn trace<T: Field>(links: &[FlightJacobian<T>]) -> T {
    let (product, velocities) = product(links);
    product.trace() / velocities
}

/// The product of the scaled Jacobians of `links`, and that of the velocities by which they are scaled.
pub(crate) fn product<T: Field>(links: &[FlightJacobian<T>]) -> (Matrix2<T>, T) {
    let start = (Matrix2::identity(), T::one());
    links.iter().fold(start, |(product, velocities), link| {
        (link.scaled_jacobian() * product, velocities * link.arrival.clone())
    })
}

/// The determinant of the derivative of one period: the product of r² over the impacts, whatever the motion.
pub fn determinant<T: Field>(links: &[FlightJacobian<T>]) -> T {
    let root = loss_factor(links);
    root.clone() * root
}

/// The product of r over the impacts: the root of the determinant, and the size of a complex multiplier.
pub fn loss_factor<T: Field>(links: &[FlightJacobian<T>]) -> T {
    links
        .iter()
        .fold(T::one(), |product, link| product * link.restitution.clone())
}

/// The type of a fixed point by its multipliers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OrbitKind {
    /// Two real multipliers, both inside the unit circle or (never here, where D <= 1) both outside:
    /// Tr² > 4 D and |Tr| < 1 + D.
    Node,
    /// A complex pair: Tr² < 4 D.
    Focus,
    /// One real multiplier inside the unit circle, one outside: |Tr| > 1 + D.
    Saddle,
}

impl fmt::Display for OrbitKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Node => "node",
            Self::Focus => "focus",
            Self::Saddle => "saddle",
        })
    }
}

/// An eigenvalue, real or complex.
#[derive(Clone, Debug, PartialEq)]
pub struct Multiplier<T> {
    /// The real part.
    pub re: T,
    /// The imaginary part, 0 where the eigenvalue is real.
    pub im: T,
}

/// The two multipliers (19) of a trace and a [`loss_factor`], the root of the determinant, that are of `kind`. Real
/// ones: the larger in size first, which does not cancel, the other from their product; a complex pair: the one with
/// the positive imaginary part first.
///
/// Delta/4 is taken as (Tr/2 - loss)(Tr/2 + loss): Tr² - 4 Det loses half of the digits where it is near 0. So the
/// multipliers are accurate to a few roundings of the trace and the loss factor, times their condition, for any trace.
pub fn multipliers<T: Analytic>(trace: &T, loss_factor: &T, kind: OrbitKind) -> [Multiplier<T>; 2] {
    let half = trace.clone() * T::from_ratio(1, 2);
    let apart = (half.clone() - loss_factor.clone()) * (half.clone() + loss_factor.clone());
    if kind == OrbitKind::Focus {
        let im = (-apart).sqrt();
        let at = |im| Multiplier { re: half.clone(), im };
        return [at(im.clone()), at(-im)];
    }
    let root = apart.sqrt();
    let larger = if trace.to_f64() < 0.0 { half - root } else { half + root };
    let smaller = loss_factor.clone() / larger.clone() * loss_factor.clone();
    [larger, smaller].map(|re| Multiplier { re, im: T::zero() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Forcing, Impact, Motion, Passage, Side};
    use std::f64::consts::PI;

    /// Passage and link of the same flight, at any velocities and times: no wall has to be there.
    fn both(side: Side, phase: f64, velocity: f64, time: f64) -> (Passage<f64>, FlightJacobian<f64>) {
        let (g, r_b, r_t) = (0.12, 0.6, 0.3);
        let motion = Motion::new(g, 0.4, r_b, r_t).expect("a motion");
        let impact = Impact {
            side,
            time: phase / PI,
            velocity,
        };
        let passage = Passage::new(&motion, &Forcing::harmonic(&0.0), &impact, &time);
        let r = *motion.restitution(side);
        let end = phase + PI * time;
        let link = FlightJacobian {
            restitution: r,
            velocity,
            time,
            push: phase.cos() + g,
            pull: end.cos() + g,
            arrival: g * time - r * velocity + (end.sin() - phase.sin()) / PI,
        };
        (passage, link)
    }

    #[test]
    fn a_scaled_jacobian_is_the_printed_one_times_the_velocity_of_arrival() {
        for (side, velocity) in [(Side::Bottom, 0.8), (Side::Top, -0.7)] {
            let (passage, link) = both(side, 0.9, velocity, 1.1);
            let entries = link.scaled_jacobian() / link.arrival;
            let apart = |other: Matrix2<f64>| (other - entries).abs().max();
            assert!(apart(passage.by_formula().expect("no grazing")) < 1e-14);
            assert!(apart(passage.by_duals().expect("no grazing")) < 1e-14);
            let r = link.restitution;
            assert!((entries.determinant() - r * r * velocity / link.arrival).abs() < 1e-14);
        }
    }

    #[test]
    fn the_trace_of_a_pair_is_its_closed_form() {
        // any two links whose velocities join and whose times add up to 2 n, as the closed form asks
        let (r_b, r_t, v, w, t_1, t_2, at_bottom, at_top) = (0.6, 0.3, 0.7, -0.5, 0.9, 3.1, 0.4, -0.8);
        let link = |restitution, velocity, time, push, pull, arrival| FlightJacobian {
            restitution,
            velocity,
            time,
            push,
            pull,
            arrival,
        };
        let links: [FlightJacobian<f64>; 2] = [
            link(r_b, v, t_1, at_bottom, at_top, w),
            link(r_t, w, t_2, at_top, at_bottom, v),
        ];
        let mixed = r_b * (1.0 + r_t) * at_top * v + r_t * (1.0 + r_b) * at_bottom * w;
        let above = (1.0 + r_b) * (1.0 + r_t) * at_bottom * at_top * t_1 * t_2 - (t_1 + t_2) * mixed;
        let closed = 2.0 * r_b * r_t + above / (v * w);
        assert!((trace(&links) - closed).abs() < 1e-12, "{} {closed}", trace(&links));
        assert!((determinant(&links) - (r_b * r_t).powi(2)).abs() < 1e-16);
    }

    #[test]
    fn multipliers_have_the_trace_as_sum_and_the_determinant_as_product() {
        let [large, small] = multipliers::<f64>(&-1e9, &1e-9_f64.sqrt(), OrbitKind::Saddle);
        assert!((large.re + 1e9).abs() < 1e-6 && (small.re / -1e-18 - 1.0).abs() < 1e-14);
        let [up, down] = multipliers::<f64>(&0.2, &0.3, OrbitKind::Focus);
        assert!((up.re - 0.1).abs() < 1e-16 && up.im > 0.0 && down.im == -up.im);
        assert!((up.re * up.re + up.im * up.im - 0.09).abs() < 1e-16);
        let [large, small] = multipliers::<f64>(&0.9, &0.18_f64.sqrt(), OrbitKind::Node);
        assert!((large.re - 0.6).abs() < 1e-15 && (small.re - 0.3).abs() < 1e-15);
    }
}
