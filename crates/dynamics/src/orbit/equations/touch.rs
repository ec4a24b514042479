//! The touch of a wall within a flight that starts or ends at that wall, in equations that stay regular where the touch
//! comes together with the impact.
//!
//! Let the flight leave the wall with velocity u, or, with time reversed, come to it with velocity -u, and let it be a time
//! s from that impact. Its distance from the wall is s w(s), its velocity w(s) + s w'(s). Both are 0 at a touch, but they
//! are also 0 at s = 0 wherever u is, so that a curve of touches is singular where it ends, in a degenerate grazing
//! (u = 0 and f + g = 0). The equations w = w' = 0 hold at the same touches and are regular there. With m the phase
//! halfway between the impact and the touch, x = pi s / 2, and j_0, j_1 the spherical Bessel functions,
//!
//! - w + s w' = u + s (g + j_0(x) cos m)
//! - 2 w' = g + j_0(x) cos m - j_1(x) sin m, with + j_1 in reversed time.

use crate::model::Side;
use crate::orbit::equations::one_one::{OneOneEquations, SharedTerms};
use numbers::Analytic;

/// The motion of the ball close to an impact: after it, or in reversed time before it.
#[derive(Clone, Debug)]
pub struct FlightFromImpact<T> {
    /// The phase of the impact.
    phase: T,
    /// The velocity at the impact, in the direction in which time is counted.
    launch: T,
    /// Gravity.
    g: T,
    /// 1, or -1 in reversed time.
    direction: i64,
}

impl<T: Analytic> FlightFromImpact<T> {
    /// A flight of a 1-1 motion, seen from the impact of it at `wall`. T_1 must not contain 0.
    pub fn new(balance: &OneOneEquations<T>, (flight, wall): (usize, Side), at: &SharedTerms<T>) -> Self {
        let impact = usize::from(wall == Side::Top);
        let velocity = balance.velocities_at(at)[impact].clone();
        let starts = impact == flight;
        Self {
            phase: balance.phases_at(at)[impact].clone(),
            launch: if starts {
                -(balance.restitution(wall) * velocity)
            } else {
                -velocity
            },
            g: balance.g().clone(),
            direction: if starts { 1 } else { -1 },
        }
    }

    /// The phase at a time from the impact.
    pub fn phase_at(&self, from_impact: &T) -> T {
        self.phase.clone() + T::from_integer(self.direction) * T::pi() * from_impact.clone()
    }

    /// f + g at a time from the impact.
    pub fn acceleration(&self, from_impact: &T) -> T {
        self.phase_at(from_impact).sincos().1 + self.g.clone()
    }

    /// [w + s w', 2 w'] at a time s from the impact.
    pub fn touch_excess(&self, from_impact: &T) -> [T; 2] {
        let half = T::from_ratio(1, 2);
        let [j_0, j_1] = spherical_bessel(&(T::pi() * from_impact.clone() * half.clone()));
        let (sin, cos) = self.phase_at(&(from_impact.clone() * half)).sincos();
        let mean = self.g.clone() + j_0 * cos;
        let turned = T::from_integer(self.direction) * j_1 * sin;
        [self.launch.clone() + from_impact.clone() * mean.clone(), mean - turned]
    }
}

/// The time from the impact at `wall` to a time `after` the start of a flight that lasts `duration`, or back.
pub fn time_from_impact<T: Analytic>((flight, wall): (usize, Side), after: T, duration: T) -> T {
    if (wall == Side::Top) == (flight == 1) {
        after
    } else {
        duration - after
    }
}

/// Arguments up to this size are left to the series: beyond, the closed forms lose hardly a digit.
const SMALL: f64 = 1.0;

/// Maximum number of terms of the series: enough for some 2000 digits.
const MOST_TERMS: i64 = 400;

/// The terms after the first that does not count: they count in the derivatives by x, up to the third.
const FURTHER: u32 = 2;

/// j_0(x) = sin(x)/x and j_1(x) = -j_0'(x).
///
/// The series of j_0 is its Taylor polynomial. Since j_0(x) is the integral of cos(x c) over c from 0 to 1, its derivative
/// of order n is at most 1/(n + 1) in size, so that the remainder and its derivatives, for all x, are those of
/// theta x^(2k) / (2k + 1)! with a constant theta in [-1, 1]; likewise for j_1.
pub fn spherical_bessel<T: Analytic>(x: &T) -> [T; 2] {
    let size = x.to_f64().abs();
    if size > SMALL {
        let (sin, cos) = x.sincos();
        let j_0 = sin / x.clone();
        let j_1 = (j_0.clone() - cos) / x.clone();
        return [j_0, j_1];
    }
    let enough = T::epsilon().to_f64();
    let minus_square = -(x.clone() * x.clone());
    // (-x²)^k / (2k + 1)!, and its size
    let (mut term, mut left) = (T::one(), 1.0);
    let [mut j_0, mut j_1] = [T::zero(), T::zero()];
    let (mut k, mut further) = (0, FURTHER);
    while k < MOST_TERMS && further > 0 {
        if left <= enough {
            further -= 1;
        }
        j_0 += term.clone();
        j_1 += term.clone() / T::from_integer(2 * k + 3);
        k += 1;
        let divisor = 2 * k * (2 * k + 1);
        term = term * minus_square.clone() / T::from_integer(divisor);
        left *= size * size / divisor as f64;
    }
    let remainder = T::unit() * term;
    [
        j_0 + remainder.clone(),
        x.clone() * (j_1 + remainder / T::from_integer(2 * k + 3)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::equations::conditions::touch_excess;
    use numbers::{Dual, Field, Interval, Sequence, seeded};

    #[test]
    fn series_and_closed_form_of_the_bessel_functions_agree_and_their_derivatives_are_enclosed() {
        let mut sequence = Sequence::new(3);
        for _ in 0..2000 {
            let x = sequence.between(-6.0, 6.0);
            let [j_0, j_1] = spherical_bessel(&x);
            let slopes = spherical_bessel(&seeded(x)).map(|value| value.eps);
            // j_0' = -j_1 and j_1' = j_0 - 2 j_1 / x; where the closed form starts it loses a digit
            assert!((slopes[0] + j_1).abs() < 1e-14, "{x}");
            assert!((slopes[1] * x - (j_0 * x - 2.0 * j_1)).abs() < 1e-13, "{x}");
            assert!((x * j_0 - x.sin()).abs() < 1e-15, "{x}");
            // a box with x in it, which may be wide and may contain 0
            let reach = 10.0_f64.powf(sequence.between(-9.0, 1.0));
            let cell = Interval::new(
                x - reach * sequence.between(0.0, 1.0),
                x + reach * sequence.between(0.0, 1.0),
            );
            let enclosed = spherical_bessel(&seeded(cell));
            for (enclosed, (value, slope)) in enclosed.iter().zip([j_0, j_1].into_iter().zip(slopes)) {
                let near = |side: Interval<f64>| side + Interval::new(-1e-14, 1e-14);
                assert!(Interval::point(value).is_subset(&near(enclosed.re)), "{x} {cell}");
                assert!(Interval::point(slope).is_subset(&near(enclosed.eps)), "{x} {cell}");
            }
        }
        // at 0 itself, where the closed forms divide by 0: j_0 = 1, j_1' = 1/3
        let [j_0, j_1] = spherical_bessel(&seeded(0.0));
        assert_eq!((j_0.re, j_0.eps, j_1.re), (1.0, 0.0, 0.0));
        assert_eq!(j_1.eps, 1.0 / 3.0);
    }

    #[test]
    fn the_regular_equations_are_distance_and_velocity_divided() {
        let mut sequence = Sequence::new(5);
        for _ in 0..500 {
            let [g, d, r_b, r_t, part, middle] = std::array::from_fn(|_| sequence.between(0.05, 0.95));
            let motion = Motion::new(g - 0.5, d, r_b, r_t).unwrap();
            let balance = OneOneEquations::new(&motion, 1);
            let (t_1, middle) = (2.0 * part, 6.0 * middle);
            let after = t_1 * sequence.between(0.1, 0.9);
            // flight 0 leaves the bottom and ends at the top for any T_1 and psi: (10) holds identically
            let flight = balance.flight(0, &t_1, &middle);
            let seen = FlightFromImpact::new(&balance, (0, Side::Bottom), &balance.parts(&t_1, &middle));
            let [distance, velocity] = touch_excess(&flight, Side::Bottom, &after);
            let [first, second] = seen.touch_excess(&after);
            // the bottom is at the positive end: inwards is negative
            let w = -distance / after;
            assert!((first - velocity).abs() < 1e-13);
            assert!((second - 2.0 * (velocity - w) / after).abs() < 1e-12 / after);
            assert!((seen.acceleration(&after) - flight.acceleration(&after)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_remainder_is_the_whole_unit_of_intervals_alone() {
        assert_eq!(<Interval<f64> as Analytic>::unit(), Interval::new(-1.0, 1.0));
        assert_eq!(<f64 as Analytic>::unit(), 0.0);
        let unit = <Dual<Interval<f64>> as Analytic>::unit();
        assert_eq!(
            (unit.re, unit.eps),
            (Interval::new(-1.0, 1.0), Interval::from_integer(0))
        );
    }
}
