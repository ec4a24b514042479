//! The derivative DP of the map: by the closed form of (20) to (23), by dual numbers, by differences.
//!
//! The three ways share the flight and nothing else: the closed form is never seen by the other two.

use super::flight::{Flight, FlightError};
use super::forcing::{Forced, Forcing};
use super::map::Impact;
use super::motion::{Motion, MotionError, Side};
use crate::number::{Analytic, Dual, seeded};
use nalgebra::Matrix2;
use num_dual::DualNum;

/// A flight whose duration is known: the point at which the derivative of a one-impact map is wanted.
///
/// Rows and columns of a derivative are (t, Zdot). The wall reached is the one that `duration` leads to, so the
/// entries are functions of the time, velocity and duration given, and of nothing solved for.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage<T> {
    motion: Motion<T>,
    forcing: Forcing<T>,
    impact: Impact<T>,
    duration: T,
}

/// Two flights that close a motion: P_2 after P_1, t_{k+2} = t_k and a whole number of periods.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair<T> {
    /// From the bottom to the top.
    pub first: Passage<T>,
    /// From the top to the bottom.
    pub second: Passage<T>,
}

/// The order of a central difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Two values a step apart on either side; error as the square of the step.
    Two,
    /// Four values; error as its fourth power.
    Four,
}

/// Why a derivative has no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JacobianError {
    /// The velocity of arrival is exactly 0 in this number: the denominators of (20) to (23) vanish.
    #[error(
        "the velocity of arrival is {velocity}: the derivative has no value where a flight grazes"
    )]
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
    pub fn convert<U: Analytic>(
        &self,
        convert: impl Fn(&T) -> U,
    ) -> Result<Passage<U>, MotionError> {
        let Impact {
            side,
            time,
            velocity,
        } = &self.impact;
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

    fn end(&self) -> T {
        self.impact.time.clone() + self.duration.clone()
    }

    /// The entries as (20) prints them for a flight from the bottom, (21) for one from the top.
    ///
    /// Digits are lost as the flight grazes: the denominator, minus the velocity of arrival, is a difference.
    ///
    /// # Errors
    /// `Grazing` where the denominator is exactly 0.
    pub fn by_formula(&self) -> Result<Matrix2<T>, JacobianError> {
        let g = || self.motion.g().clone();
        let duration = || self.duration.clone();
        let r = || self.r();
        let (start, end) = (
            self.forcing.at(&self.impact.time),
            self.forcing.at(&self.end()),
        );
        let momentum = r() * self.impact.velocity.clone() - g() * duration();
        let below = not_zero(momentum.clone() - end.f1 + start.f1)?;
        let time_by_time = (momentum - start.f.clone() * duration()) / below.clone();
        let time_by_velocity = -(r() * duration()) / below;
        let push = end.f + g();
        let velocity_by_time = time_by_time.clone() * push.clone() - (start.f + g());
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
        let Impact {
            side,
            time,
            velocity,
        } = &self.impact;
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
    /// The step balances rounding (epsilon / h) against truncation (h² or h⁴): h = epsilon^(1/3) or
    /// epsilon^(1/5), in time, whose scale is 1 (the forcing changes by its own size over 1/pi), and in velocity
    /// times its size, or times 1/1024 where that is larger. So about 2/3 and 4/5 of the digits are left at best.
    ///
    /// # Errors
    /// `Neighbour` where the wall is not reached a step away, as close to grazing.
    pub fn by_differences(&self, order: Order) -> Result<Matrix2<T>, JacobianError> {
        let root = if order == Order::Two { 3.0 } else { 5.0 };
        let step = T::epsilon().to_f64().powf(1.0 / root);
        // a power of 2, so that a step is added and divided by without rounding
        let power = |size: f64| size.log2().round().exp2();
        let speed = self.impact.velocity.to_f64().abs().max(1.0 / 1024.0);
        let base = self.flight(0.0, 0.0)?.state(&self.duration);
        let (a, c) = self.column(order, power(step), &base.displacement, |offset| {
            (offset, 0.0)
        })?;
        let (b, d) = self.column(order, power(step * speed), &base.displacement, |offset| {
            (0.0, offset)
        })?;
        Ok(Matrix2::new(a + T::one(), b, c, d))
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
        let near = rise(step)?;
        if order == Order::Two {
            let width = T::from_f64(2.0 * step);
            return Ok((near.0 / width.clone(), near.1 / width));
        }
        let far = rise(2.0 * step)?;
        let width = T::from_f64(12.0 * step);
        let combine = |near: T, far: T| (T::from_integer(8) * near - far) / width.clone();
        Ok((combine(near.0, far.0), combine(near.1, far.1)))
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

impl<T: Analytic> Pair<T> {
    /// The two flights from an impact at the bottom, with T_1 and T_2 known; Zdot_{k+1} is taken from (9).
    ///
    /// `velocity` and the velocity at the top are not asked to point towards their walls; the ways that fly do.
    pub fn new(
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        time: &T,
        velocity: &T,
        durations: [&T; 2],
    ) -> Self {
        let [first, second] = durations;
        let impact = Impact {
            side: Side::Bottom,
            time: time.clone(),
            velocity: velocity.clone(),
        };
        let between = time.clone() + first.clone();
        let (start, end) = (forcing.at(time), forcing.at(&between));
        let launch = motion.restitution(Side::Bottom).clone() * velocity.clone();
        let velocity = motion.g().clone() * first.clone() - launch + end.f1 - start.f1;
        let top = Impact {
            side: Side::Top,
            time: between,
            velocity,
        };
        let second = Passage::new(motion, forcing, &top, second);
        Self {
            first: Passage::new(motion, forcing, &impact, first),
            second,
        }
    }

    /// DP = DP_2 DP_1 of (18), each factor by `means`.
    ///
    /// # Errors
    /// Those of `means`.
    pub fn product(
        &self,
        means: impl Fn(&Passage<T>) -> Result<Matrix2<T>, JacobianError>,
    ) -> Result<Matrix2<T>, JacobianError> {
        Ok(means(&self.second)? * means(&self.first)?)
    }

    /// Tr(DP) by (22) with its three misprints mended: a factor epsilon_1 beside the first r_B, a factor epsilon_2
    /// beside the first r_T, and + r_B Zdot_k replaced by - in epsilon_4. Holds where t_{k+2} is t_k and a whole
    /// number of periods, whatever the velocities.
    ///
    /// # Errors
    /// `Grazing` where epsilon_1 or epsilon_2, the velocities of arrival up to sign, is exactly 0.
    pub fn trace_by_formula(&self) -> Result<T, JacobianError> {
        let Known {
            g,
            r_b,
            r_t,
            t_1,
            t_2,
            v,
            start,
            end,
        } = self.known();
        let e_1 = not_zero(
            start.f1.clone() - end.f1.clone() + v.clone() * r_b.clone() - g.clone() * t_1.clone(),
        )?;
        let integrals = start.f1 - end.f1 + g.clone() * t_2.clone();
        let e_2 = not_zero(integrals + r_t.clone() * e_1.clone())?;
        let e_3 = end.f.clone() * t_2.clone() + g.clone() * t_2.clone() + r_t.clone() * e_1.clone();
        let e_4 = start.f.clone() * t_1.clone() + g.clone() * t_1.clone() - v * r_b.clone();
        let (at_start, at_end) = (start.f + g.clone(), end.f + g);
        let both = e_1.clone() * e_2.clone();
        let head = (r_b.clone() * e_1.clone() + r_b.clone() * t_1.clone() * at_end.clone())
            * (r_t.clone() * e_2.clone() - r_t.clone() * t_2.clone() * at_start.clone())
            / both.clone();
        let cross = e_3.clone() * e_4.clone() / both;
        let by_top =
            r_t * t_2 / e_2.clone() * (at_start.clone() + e_4 / e_1.clone() * at_end.clone());
        let by_bottom = r_b * t_1 / e_1 * (at_end - e_3 / e_2 * at_start);
        Ok(head - cross - by_top + by_bottom)
    }

    /// Det(DP) by (23). Holds where [`Pair::trace_by_formula`] does; on a 1-1 orbit it is (r_B r_T)².
    ///
    /// # Errors
    /// `Grazing` where the denominator, the velocity of arrival at the bottom, is exactly 0.
    pub fn determinant_by_formula(&self) -> Result<T, JacobianError> {
        let Known {
            g,
            r_b,
            r_t,
            t_1,
            t_2,
            v,
            start,
            end,
        } = self.known();
        let both = r_b * r_t.clone();
        let above = both.clone() * both.clone() * v.clone();
        let integrals =
            start.f1.clone() - end.f1.clone() + r_t.clone() * start.f1 - r_t.clone() * end.f1;
        let below = integrals + g.clone() * t_2 - g * r_t * t_1 + v * both;
        Ok(above / not_zero(below)?)
    }

    fn known(&self) -> Known<T> {
        let Passage {
            motion,
            forcing,
            impact,
            duration,
        } = &self.first;
        Known {
            g: motion.g().clone(),
            r_b: motion.restitution(Side::Bottom).clone(),
            r_t: motion.restitution(Side::Top).clone(),
            t_1: duration.clone(),
            t_2: self.second.duration.clone(),
            v: impact.velocity.clone(),
            start: forcing.at(&impact.time),
            end: forcing.at(&self.first.end()),
        }
    }
}

/// What (22) and (23) are written in.
struct Known<T> {
    g: T,
    r_b: T,
    r_t: T,
    t_1: T,
    t_2: T,
    v: T,
    start: Forced<T>,
    end: Forced<T>,
}

/// `denominator`, unless it is 0 or no number.
fn not_zero<T: Analytic>(denominator: T) -> Result<T, JacobianError> {
    let velocity = denominator.to_f64();
    if denominator.is_zero() || !velocity.is_finite() {
        return Err(JacobianError::Grazing { velocity });
    }
    Ok(denominator)
}
