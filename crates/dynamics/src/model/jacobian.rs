//! The derivative of a one-impact map: by the closed form of (20) and (21), by dual numbers, by differences.
//!
//! The three ways share the flight and nothing else: the closed form is never seen by the other two.

use super::ahead::Forced;
use super::flight::Impact;
use super::flight::{Flight, FlightError, State};
use super::forcing::Forcing;
use super::motion::{Motion, MotionError};
use nalgebra::Matrix2;
use num_dual::DualNum;
use numbers::{Analytic, Dual, seeded};

/// A flight whose duration is known: the point at which the derivative of a one-impact map is wanted.
///
/// Rows and columns of a derivative are (t, Zdot). The wall reached is the one that `duration` leads to, so the
/// entries are functions of the time, velocity and duration given, and of nothing solved for.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage<T> {
    pub(super) motion: Motion<T>,
    pub(super) forcing: Forcing<T>,
    pub(super) impact: Impact<T>,
    pub(super) duration: T,
}

/// The order of a central difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Two values a step apart on either side; error as the square of the step.
    Two,
    /// Four values; error as its fourth power.
    Four,
    /// Six values; error as its sixth power.
    Six,
}

impl Order {
    /// The weights of the differences over one, two and three steps to either side, and what their sum is divided by,
    /// times the step (Fornberg, *Math. Comp.* 51, 1988, table 1).
    fn weights(self) -> (&'static [i64], f64) {
        match self {
            Self::Two => (&[1], 2.0),
            Self::Four => (&[8, -1], 12.0),
            Self::Six => (&[45, -9, 1], 60.0),
        }
    }

    /// The step that balances rounding, epsilon / h, against truncation, as a power of epsilon.
    fn balance(self) -> f64 {
        match self {
            Self::Two => 1.0 / 3.0,
            Self::Four => 1.0 / 5.0,
            Self::Six => 1.0 / 7.0,
        }
    }
}

/// Why a derivative has no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JacobianError {
    /// The velocity of arrival is exactly 0 in this number: the denominators of (20) to (23) vanish.
    #[error("the velocity of arrival is {velocity}: the derivative has no value where a flight grazes")]
    Grazing {
        /// The velocity of arrival.
        velocity: f64,
    },
    /// A neighbour of the point, a step of the difference away, does not reach the wall.
    #[error("a neighbour at distance {step} does not reach the wall")]
    Neighbour {
        /// The step.
        step: f64,
    },
    /// There is no such flight.
    #[error(transparent)]
    Flight(#[from] FlightError),
    /// A parameter is out of range in the number of the derivative.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

impl<T: Analytic> Passage<T> {
    /// The flight that follows `impact` and lasts `duration`.
    pub fn new(motion: &Motion<T>, forcing: &Forcing<T>, impact: &Impact<T>, duration: &T) -> Self {
        let (motion, forcing) = (motion.clone(), forcing.clone());
        Self {
            motion,
            forcing,
            impact: impact.clone(),
            duration: duration.clone(),
        }
    }

    /// The same point over another number.
    ///
    /// # Errors
    /// A parameter that leaves its range by rounding.
    pub fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> Result<Passage<U>, MotionError> {
        let Impact { side, time, velocity } = &self.impact;
        Ok(Passage {
            motion: self.motion.convert(&convert)?,
            forcing: self.forcing.convert(&convert),
            impact: Impact {
                side: *side,
                time: convert(time),
                velocity: convert(velocity),
            },
            duration: convert(&self.duration),
        })
    }

    fn r(&self) -> T {
        self.motion.restitution(self.impact.side).clone()
    }

    /// t_{k+1}, not reduced.
    pub(super) fn end(&self) -> T {
        self.impact.time.clone() + self.duration.clone()
    }

    /// The entries as (20) prints them for a flight from the bottom, (21) for one from the top.
    ///
    /// Digits are lost as the flight grazes: the denominator, minus the velocity of arrival, is a difference.
    ///
    /// # Errors
    /// `Grazing` where the denominator is exactly 0.
    pub fn by_formula(&self) -> Result<Matrix2<T>, JacobianError> {
        self.entries(&self.forcing.at(&self.impact.time), &self.forcing.at(&self.end()))
    }

    /// Computes [`Passage::by_formula`] from the forcing at the start and at the end.
    pub(super) fn entries(&self, start: &Forced<T>, end: &Forced<T>) -> Result<Matrix2<T>, JacobianError> {
        let g = || self.motion.g().clone();
        let duration = || self.duration.clone();
        let r = || self.r();
        let momentum = r() * self.impact.velocity.clone() - g() * duration();
        let below = not_zero(momentum.clone() - end.f1.clone() + start.f1.clone())?;
        let time_by_time = (momentum - start.f.clone() * duration()) / below.clone();
        let time_by_velocity = -(r() * duration()) / below;
        let push = end.f.clone() + g();
        let velocity_by_time = time_by_time.clone() * push.clone() - (start.f.clone() + g());
        let velocity_by_velocity = time_by_velocity.clone() * push - r();
        Ok(Matrix2::new(
            time_by_time,
            time_by_velocity,
            velocity_by_time,
            velocity_by_velocity,
        ))
    }

    /// The entries by dual numbers through flight and implicit function theorem, a column for each seed.
    ///
    /// # Errors
    /// `Grazing`, and those of [`Flight::after`].
    pub fn by_duals(&self) -> Result<Matrix2<T>, JacobianError>
    where
        T: DualNum,
    {
        let lift = |value: &T| Dual::from_re(value.clone());
        let (motion, forcing) = (self.motion.convert(lift)?, self.forcing.convert(lift));
        let Impact { side, time, velocity } = &self.impact;
        let column = |time: Dual<T>, velocity: Dual<T>| {
            let impact = Impact {
                side: *side,
                time: time.clone(),
                velocity,
            };
            let flight = Flight::after(&motion, &forcing, &impact)?;
            let duration = lift(&self.duration);
            let state = flight.state(&duration);
            // where the ball is at this duration is where the wall is: the real part of the residual is 0
            let residual = Dual::new(T::zero(), state.displacement.eps);
            not_zero(state.velocity.re.clone())?;
            let duration = duration - residual / state.velocity;
            let velocity = flight.state(&duration).velocity;
            Ok::<_, JacobianError>(((time + duration).eps, velocity.eps))
        };
        let (a, c) = column(seeded(time.clone()), lift(velocity))?;
        let (b, d) = column(lift(time), seeded(velocity.clone()))?;
        Ok(Matrix2::new(a, b, c, d))
    }

    /// The entries by central differences, each neighbour's flight solved anew for the same wall.
    ///
    /// The step balances rounding (epsilon / h) against truncation (h², h⁴ or h⁶): h = epsilon^(1/3), epsilon^(1/5) or
    /// epsilon^(1/7) times the distance over which the map changes by its own size, see `scales`. So about 2/3, 4/5 and
    /// 6/7 of the digits are left at best, and fewer the closer the flight grazes.
    ///
    /// # Errors
    /// `Neighbour` where the wall is not reached a step away, as close to grazing.
    pub fn by_differences(&self, order: Order) -> Result<Matrix2<T>, JacobianError> {
        self.by_differences_over(order, T::epsilon().to_f64().powf(order.balance()))
    }

    /// The same with a step that is this part of the distance over which the map changes by its own size, or 64
    /// spacings of the numbers there where that is more.
    ///
    /// # Errors
    /// As [`Passage::by_differences`].
    pub fn by_differences_over(&self, order: Order, part: f64) -> Result<Matrix2<T>, JacobianError> {
        let epsilon = T::epsilon().to_f64();
        // A power of 2 not below the spacing of numbers there, so that it is added and divided by without rounding.
        let step = |scale: f64, at: &T| {
            let spacing = 64.0 * epsilon * at.to_f64().abs().max(scale.min(1.0));
            (part * scale).max(spacing).log2().round().exp2()
        };
        let wall = self.flight(0.0, 0.0)?.state(&self.duration);
        let [time, velocity] = self.scales(&wall);
        let (time, velocity) = (step(time, &self.impact.time), step(velocity, &self.impact.velocity));
        let wall = wall.displacement;
        let (a, c) = self.column(order, time, &wall, |offset| (offset, 0.0))?;
        let (b, d) = self.column(order, velocity, &wall, |offset| (0.0, offset))?;
        Ok(Matrix2::new(a + T::one(), b, c, d))
    }

    /// How far time and velocity may change before the flight changes by its own size: 1 in time, since the forcing
    /// does so over 1/pi, and the velocity itself; or before it might graze. A ball that arrives with velocity v
    /// against an acceleration a would turn v²/(2a) behind the wall, and a change of the start by h moves the place
    /// of arrival by no more than 2 max|f| T_1 h and r T_1 h: from (4).
    fn scales(&self, arrival: &State<T>) -> [f64; 2] {
        let (speed, push) = (arrival.velocity.to_f64().abs(), arrival.acceleration.to_f64().abs());
        let margin = speed * speed / (2.0 * push);
        let duration = self.duration.to_f64().abs();
        let strongest = self.forcing.ahead(&self.impact.time).bound().to_f64();
        let by_time = margin / (2.0 * strongest * duration);
        let by_velocity = margin / (self.r().to_f64() * duration);
        // f64::min passes over NaN, from 0/0
        let scale = |own: f64, grazing: f64| own.min(grazing).max(f64::MIN_POSITIVE);
        let own = self.impact.velocity.to_f64().abs().max(1.0 / 1024.0);
        [scale(1.0, by_time), scale(own, by_velocity)]
    }

    /// Derivatives of (duration, velocity of arrival) along one direction.
    fn column(
        &self,
        order: Order,
        step: f64,
        wall: &T,
        direction: impl Fn(f64) -> (f64, f64),
    ) -> Result<(T, T), JacobianError> {
        let rise = |offset: f64| {
            let at = |offset| {
                let (time, velocity) = direction(offset);
                self.neighbour(time, velocity, wall)
                    .ok_or(JacobianError::Neighbour { step })
            };
            let (above, below) = (at(offset)?, at(-offset)?);
            Ok::<_, JacobianError>((above.0 - below.0, above.1 - below.1))
        };
        let (weights, below) = order.weights();
        let mut sum = (T::zero(), T::zero());
        for (steps, weight) in (1..).zip(weights) {
            let (duration, velocity) = rise(f64::from(steps) * step)?;
            let weight = T::from_integer(*weight);
            sum = (sum.0 + weight.clone() * duration, sum.1 + weight * velocity);
        }
        let width = T::from_f64(below * step);
        Ok((sum.0 / width.clone(), sum.1 / width))
    }

    fn flight(&self, time: f64, velocity: f64) -> Result<Flight<T>, FlightError> {
        let impact = Impact {
            side: self.impact.side,
            time: self.impact.time.clone() + T::from_f64(time),
            velocity: self.impact.velocity.clone() + T::from_f64(velocity),
        };
        Flight::after(&self.motion, &self.forcing, &impact)
    }

    /// Duration and velocity of arrival of the flight that starts a little elsewhere, by Newton's method from the
    /// known duration until the steps no longer shrink.
    fn neighbour(&self, time: f64, velocity: f64, wall: &T) -> Option<(T, T)> {
        let flight = self.flight(time, velocity).ok()?;
        let mut duration = self.duration.clone();
        let mut last = f64::INFINITY;
        // quadratic convergence from a neighbour takes some five steps in f64, eight in 40 digits
        for _ in 0..50 {
            let state = flight.state(&duration);
            let step = (state.displacement - wall.clone()) / state.velocity.clone();
            let size = step.to_f64().abs();
            if !size.is_finite() || duration.to_f64() <= 0.0 {
                return None;
            }
            duration -= step;
            if size == 0.0 || size >= last || size <= T::epsilon().to_f64() * duration.to_f64() {
                let arrival = flight.state(&duration).velocity;
                return Some((duration, arrival));
            }
            last = size;
        }
        None
    }
}

/// `denominator`, unless it is 0 or no number.
pub(super) fn not_zero<T: Analytic>(denominator: T) -> Result<T, JacobianError> {
    let velocity = denominator.to_f64();
    if denominator.is_zero() || !velocity.is_finite() {
        return Err(JacobianError::Grazing { velocity });
    }
    Ok(denominator)
}

#[cfg(test)]
mod tests {
    use super::super::Side;
    use super::*;
    use numbers::Wide;

    fn passage(side: Side, velocity: f64, duration: f64) -> Passage<f64> {
        let Ok(motion) = Motion::new(0.12, 0.4, 0.6, 0.3) else {
            panic!("a motion")
        };
        let impact = Impact {
            side,
            time: 0.25,
            velocity,
        };
        Passage::new(&motion, &Forcing::harmonic(&0.1), &impact, &duration)
    }

    #[test]
    fn three_ways_to_the_same_entries() {
        for passage in [passage(Side::Bottom, 0.8, 0.9), passage(Side::Top, -0.7, 1.1)] {
            let Ok(formula) = passage.by_formula() else {
                panic!("no grazing")
            };
            let apart = |entries: Result<Matrix2<f64>, JacobianError>| {
                entries.map_or(f64::INFINITY, |entries| (entries - formula).abs().max())
            };
            assert!(apart(passage.by_duals()) < 1e-14);
            assert!(apart(passage.by_differences(Order::Two)) < 1e-8);
            assert!(apart(passage.by_differences(Order::Four)) < 1e-10);
            assert!(apart(passage.by_differences(Order::Six)) < 1e-11);
        }
    }

    #[test]
    fn each_order_of_a_difference_has_the_digits_of_its_power() {
        let wide = |value: &f64| <Wide<50> as Analytic>::from_f64(*value);
        let passage = passage(Side::Bottom, 0.8, 0.9).convert(wide).expect("a passage");
        let formula = passage.by_formula().expect("no grazing");
        let digits = |order| {
            let apart = passage.by_differences(order).expect("a flight") - formula.clone();
            let worst = apart.iter().map(|entry| entry.to_f64().abs()).fold(0.0, f64::max);
            -worst.log10()
        };
        // of the 60 digits that 50 and the guard bits make, 2/3, 4/5 and 6/7, less what the derivatives are large
        for (order, share) in [(Order::Two, 40.0), (Order::Four, 48.0), (Order::Six, 51.4)] {
            let digits = digits(order);
            assert!(digits > share - 4.0 && digits < share + 4.0, "{order:?}: {digits}");
        }
        assert!(digits(Order::Six) > digits(Order::Four) + 1.0);
    }

    #[test]
    fn the_determinant_of_one_impact_is_r_squared_times_the_ratio_of_velocities() {
        let passage = passage(Side::Bottom, 0.8, 0.9);
        let Ok(entries) = passage.by_formula() else {
            panic!("no grazing")
        };
        let arrival = passage
            .flight(0.0, 0.0)
            .map_or(f64::NAN, |flight| flight.state(&0.9).velocity);
        assert!((entries.determinant() - 0.36 * 0.8 / arrival).abs() < 1e-14);
    }

    #[test]
    fn where_the_ball_cannot_start_or_arrive_there_is_an_error() {
        assert!(passage(Side::Bottom, -0.8, 0.9).by_duals().is_err());
        // an empty flight arrives with minus the launch velocity 0
        let none = passage(Side::Bottom, 0.0, 0.0).by_formula();
        assert_eq!(none, Err(JacobianError::Grazing { velocity: 0.0 }));
    }
}
