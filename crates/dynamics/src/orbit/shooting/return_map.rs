//! A second means: a periodic motion as the fixed point of its return map.
//!
//! Here a ball is followed by the model's own flights from impact to impact until it comes back; nothing is shared with
//! [`OneOneEquations`](crate::orbit::OneOneEquations) and [`FlightBoundaryValues`](crate::orbit::FlightBoundaryValues), which solve (9) to (13) for the phases. Derivatives are those
//! of dual numbers through the flights. Nothing is proved: it confirms what was.

use crate::model::{Flight, FlightError, Impact, Leg, Motion, MotionError, Side};
use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::equations::flight::OrbitImpact;
use crate::orbit::family::Family;
use crate::orbit::rounding::RoundedOrbit;
use crate::orbit::solve::newton::newton_by_chords;
use crate::orbit::word::Word;
use nalgebra::Matrix2;
use num_dual::DualNum;
use numbers::{Analytic, Dual, seeded};

/// A velocity at a grazing below this is that of an impact; else the flight touches a wall on its way.
const SLOW: f64 = 1e-9;

/// Where a flight is looked at for its turning points.
const SAMPLES: u32 = 4000;

/// A periodic motion that comes back to where it started, to a few roundings of `T` times its condition.
#[derive(Clone, Debug, PartialEq)]
pub struct ShootingSolution<T> {
    /// Its impacts; phases not reduced.
    pub fixes: Vec<OrbitImpact<T>>,
    /// Of the derivative of the return map; `None` where it has none.
    pub trace: Option<T>,
    /// Its determinant, likewise.
    pub determinant: Option<T>,
}

/// Why the second means has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShootingError {
    /// The ball does not fly as it should.
    #[error(transparent)]
    Flight(#[from] FlightError),
    /// A parameter cannot be.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Newton's method does not settle near the start.
    #[error("Newton's method on the return map does not settle")]
    Astray,
    /// No equations but those of the first means are known.
    #[error("no second means locates a {0}")]
    Bifurcation(BifurcationKind),
}

/// The solution near a start.
fn solved<T: Analytic, const D: usize>(
    start: [f64; D],
    equations: impl Fn(&[T; D]) -> Result<[T; D], ShootingError>,
) -> Result<[T; D], ShootingError> {
    newton_by_chords(start, equations)?.ok_or(ShootingError::Astray)
}

/// Once along the word.
struct Iterate<T> {
    impacts: Vec<Impact<T>>,
    durations: Vec<T>,
    velocity: T,
}

/// The flights of a word from one impact on, near known durations.
struct ReturnMap<'a> {
    word: &'a Word,
    periods: u32,
    durations: Vec<f64>,
}

impl ReturnMap<'_> {
    fn near<T: Analytic>(&self) -> Vec<T> {
        self.durations.iter().map(|duration| T::from_f64(*duration)).collect()
    }

    fn start<T: Analytic>(&self, time: T, velocity: T) -> Impact<T> {
        let side = self.word.sides().next().unwrap_or(Side::Bottom);
        Impact { side, time, velocity }
    }

    /// Follows the ball: each flight ends at the arrival at its wall that is nearest to the duration given, whether or
    /// not it would have passed through a wall before.
    fn lap<T: Analytic>(
        &self,
        motion: &Motion<T>,
        start: Impact<T>,
        durations: &[T],
    ) -> Result<Iterate<T>, ShootingError> {
        let forcing = motion.forcing();
        let mut lap = Iterate {
            impacts: Vec::new(),
            durations: Vec::new(),
            velocity: start.velocity.clone(),
        };
        let mut impact = start;
        for (map, duration) in self.word.flights().zip(durations) {
            let leg = Leg::closed(motion, &forcing, &impact, map.to(), duration)?;
            lap.velocity = leg.to.velocity.clone();
            lap.durations.push(leg.duration);
            lap.impacts.push(impact);
            impact = leg.to;
        }
        Ok(lap)
    }

    /// How much later than after its periods, and how much faster, the ball comes back.
    fn missed<T: Analytic>(&self, motion: &Motion<T>, time: &T, velocity: &T) -> Result<[T; 2], ShootingError> {
        let lap = self.lap(motion, self.start(time.clone(), velocity.clone()), &self.near())?;
        let total = lap
            .durations
            .into_iter()
            .fold(T::zero(), |sum, duration| sum + duration);
        let late = total - T::from_integer(2 * i64::from(self.periods));
        Ok([late, lap.velocity - velocity.clone()])
    }

    /// DP, by dual numbers.
    fn derivative<T>(&self, motion: &Motion<T>, time: &T, velocity: &T) -> Result<Matrix2<T>, ShootingError>
    where
        T: Analytic + DualNum,
    {
        // durations to the last digit first: dual parts have half the digits of what they start from
        let plain = self.lap(motion, self.start(time.clone(), velocity.clone()), &self.near())?;
        let durations: Vec<Dual<T>> = plain.durations.into_iter().map(Dual::from_re).collect();
        let lifted = motion.convert(|parameter| Dual::from_re(parameter.clone()))?;
        let column = |start: Impact<Dual<T>>| -> Result<[T; 2], ShootingError> {
            let earlier = start.time.eps.clone();
            let lap = self.lap(&lifted, start, &durations)?;
            let later = lap
                .durations
                .into_iter()
                .fold(earlier, |sum, duration| sum + duration.eps);
            Ok([later, lap.velocity.eps])
        };
        let constant = |value: &T| Dual::from_re(value.clone());
        let [a, c] = column(self.start(seeded(time.clone()), constant(velocity)))?;
        let [b, d] = column(self.start(constant(time), seeded(velocity.clone())))?;
        Ok(Matrix2::new(a, b, c, d))
    }

    fn fixes<T: Analytic>(
        &self,
        motion: &Motion<T>,
        time: &T,
        velocity: &T,
    ) -> Result<Vec<OrbitImpact<T>>, ShootingError> {
        let lap = self.lap(motion, self.start(time.clone(), velocity.clone()), &self.near())?;
        let pairs = lap.impacts.into_iter().zip(lap.durations);
        let fix = |(impact, time): (Impact<T>, T)| OrbitImpact {
            phase: impact.time * T::pi(),
            velocity: impact.velocity,
            time,
        };
        Ok(pairs.map(fix).collect())
    }

    /// The motion that starts so.
    fn returning<T>(&self, motion: &Motion<T>, time: &T, velocity: &T) -> Result<ShootingSolution<T>, ShootingError>
    where
        T: Analytic + DualNum,
    {
        let derivative = self.derivative(motion, time, velocity)?;
        Ok(ShootingSolution {
            fixes: self.fixes(motion, time, velocity)?,
            trace: Some(derivative.trace()),
            determinant: Some(
                derivative.m11.clone() * derivative.m22.clone() - derivative.m12.clone() * derivative.m21.clone(),
            ),
        })
    }
}

/// The motion near one known in f64.
///
/// # Errors
/// No motion there, or one that grazes.
pub fn shoot<T>(motion: &Motion<T>, near: &RoundedOrbit) -> Result<ShootingSolution<T>, ShootingError>
where
    T: Analytic + DualNum,
{
    let course = ReturnMap {
        word: &near.word,
        periods: near.periods,
        durations: near.times.clone(),
    };
    let [Some(phase), Some(velocity)] = [near.phases.first(), near.velocities.first()] else {
        return Err(ShootingError::Astray);
    };
    let start = [phase / std::f64::consts::PI, *velocity];
    let [time, velocity] = solved(start, |[time, velocity]| course.missed(motion, time, velocity))?;
    course.returning(motion, &time, &velocity)
}

/// The bifurcation near one known in f64: the value of the parameter, and the motion there.
///
/// # Errors
/// No such event there; one that has no second means.
pub fn shoot_bifurcation<T>(
    family: &impl Family,
    near: &BifurcationPoint,
) -> Result<(T, ShootingSolution<T>), ShootingError>
where
    T: Analytic + DualNum,
{
    let course = ReturnMap {
        word: &near.word,
        periods: near.periods,
        durations: near.times.clone(),
    };
    let start = [
        near.phases[0] / std::f64::consts::PI,
        near.velocities[0],
        near.parameter,
    ];
    let slowest = near
        .velocities
        .iter()
        .map(|velocity| velocity.abs())
        .fold(f64::INFINITY, f64::min);
    match near.kind {
        BifurcationKind::SymmetryBreaking => Err(ShootingError::Bifurcation(near.kind)),
        BifurcationKind::Grazing if slowest < SLOW && near.word == Word::pair() => slow(family, near),
        BifurcationKind::Grazing if slowest < SLOW => Err(ShootingError::Bifurcation(near.kind)),
        BifurcationKind::Grazing => {
            let touch = TouchGuess::find(&family.motion_at(&near.parameter)?, near)?;
            let [time, velocity, parameter] = start;
            let found = solved(
                [time, velocity, parameter, touch.after],
                |[time, velocity, parameter, after]| {
                    let motion = family.motion_at(parameter)?;
                    let [late, gain] = course.missed(&motion, time, velocity)?;
                    let [distance, speed] = touch.excess(&motion, &course.fixes(&motion, time, velocity)?, after)?;
                    Ok([late, gain, distance, speed])
                },
            )?;
            let [time, velocity, parameter, _] = found;
            let motion = course.returning(&family.motion_at(&parameter)?, &time, &velocity)?;
            Ok((parameter, motion))
        }
        _ => {
            let [time, velocity, parameter] = solved(start, |[time, velocity, parameter]| {
                let motion = family.motion_at(parameter)?;
                let [late, gain] = course.missed(&motion, time, velocity)?;
                let trace = course.derivative(&motion, time, velocity)?.trace();
                Ok([late, gain, trace - level(&motion, near)])
            })?;
            let motion = course.returning(&family.motion_at(&parameter)?, &time, &velocity)?;
            Ok((parameter, motion))
        }
    }
}

/// The trace at the bifurcation.
fn level<T: Analytic>(motion: &Motion<T>, near: &BifurcationPoint) -> T {
    let losses = near.word.sides().map(|side| motion.restitution(side).clone());
    let loss = losses.fold(T::one(), |product, r| product * r);
    let condition = match (near.kind == BifurcationKind::NodeFocus, near.trace < 0.0) {
        (true, true) => BifurcationCondition::DoubleNegative,
        (true, false) => BifurcationCondition::DoublePositive,
        (false, true) => BifurcationCondition::MultiplierMinusOne,
        (false, false) => BifurcationCondition::MultiplierOne,
    };
    condition.trace(&loss).unwrap_or_else(T::zero)
}

/// A touch within a flight.
struct TouchGuess {
    flight: usize,
    side: Side,
    wall: Side,
    after: f64,
}

impl TouchGuess {
    /// Of all turning points, that nearest to a wall.
    fn find(motion: &Motion<f64>, near: &BifurcationPoint) -> Result<Self, ShootingError> {
        let forcing = motion.forcing();
        let mut best: Option<(f64, Self)> = None;
        for (flight, side) in near.word.sides().enumerate() {
            let launch = -motion.restitution(side) * near.velocities[flight];
            let time = near.phases[flight] / std::f64::consts::PI;
            let path = Flight::launched(motion, &forcing, side, &time, launch)?;
            let at = |sample: u32| near.times[flight] * f64::from(sample) / f64::from(SAMPLES);
            for sample in 1..SAMPLES - 1 {
                let [before, after] = [sample, sample + 1].map(|sample| path.state(&at(sample)));
                if before.velocity * after.velocity > 0.0 {
                    continue;
                }
                for wall in [Side::Bottom, Side::Top]
                    .into_iter()
                    .take(if motion.has_top() { 2 } else { 1 })
                {
                    let apart = (after.displacement - path.target(wall)).abs();
                    if best.as_ref().is_none_or(|(least, _)| apart < *least) {
                        let after = at(sample);
                        best = Some((
                            apart,
                            Self {
                                flight,
                                side,
                                wall,
                                after,
                            },
                        ));
                    }
                }
            }
        }
        best.map(|(_, touch)| touch).ok_or(ShootingError::Astray)
    }

    /// The distance from the wall and the velocity there.
    fn excess<T: Analytic>(
        &self,
        motion: &Motion<T>,
        fixes: &[OrbitImpact<T>],
        after: &T,
    ) -> Result<[T; 2], ShootingError> {
        let fix = fixes.get(self.flight).ok_or(ShootingError::Astray)?;
        let launch = -(motion.restitution(self.side).clone() * fix.velocity.clone());
        let time = fix.phase.clone() / T::pi();
        let flight = Flight::launched(motion, &motion.forcing(), self.side, &time, launch)?;
        let state = flight.state(after);
        Ok([state.displacement - flight.target(self.wall), state.velocity])
    }
}

/// An impact of velocity 0, where the return map has no derivative: both flights shot from their starts.
fn slow<T: Analytic>(family: &impl Family, near: &BifurcationPoint) -> Result<(T, ShootingSolution<T>), ShootingError> {
    let first = usize::from(near.velocities[1].abs() < near.velocities[0].abs());
    let (side, second) = ([Side::Bottom, Side::Top][first], 1 - first);
    let total = || T::from_integer(2 * i64::from(near.periods));
    let start = [
        near.phases[first] / std::f64::consts::PI,
        near.times[first],
        near.velocities[second],
        near.parameter,
    ];
    let found = solved(start, |[time, lasts, arrival, parameter]| {
        let motion = family.motion_at(parameter)?;
        let forcing = motion.forcing();
        let away = Flight::launched(&motion, &forcing, side, time, T::zero())?;
        let there = away.state(lasts);
        let launch = -(motion.restitution(side.opposite()).clone() * arrival.clone());
        let turned = time.clone() + lasts.clone();
        let back = Flight::launched(&motion, &forcing, side.opposite(), &turned, launch)?;
        let home = back.state(&(total() - lasts.clone()));
        Ok([
            there.displacement - away.target(side.opposite()),
            there.velocity - arrival.clone(),
            home.displacement - back.target(side),
            home.velocity,
        ])
    })?;
    let [time, lasts, arrival, parameter] = found;
    let fix = |time: T, velocity, lasts| OrbitImpact {
        phase: time * T::pi(),
        velocity,
        time: lasts,
    };
    let mut fixes = vec![
        fix(time.clone(), T::zero(), lasts.clone()),
        fix(time + lasts.clone(), arrival, total() - lasts),
    ];
    fixes.rotate_right(first);
    let motion = ShootingSolution {
        fixes,
        trace: None,
        determinant: None,
    };
    Ok((parameter, motion))
}
