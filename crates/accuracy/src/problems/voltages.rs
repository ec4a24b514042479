//! Voltages of impacts and of cycles: in the stable form, confirmed as printed with another closed form of the shape.

use super::problem::Problem;
use super::values::{Number, Values, number, read};
use super::{Means, Why, orbits};
use dynamics::impact::Origin;
use numbers::{Analytic, Field, Wide};

/// What the answers rest on.
pub const MEANS: [&str; 2] = ["stable form", "(5) and (6) as printed in 200 digits"];

/// Enough for the difference of (6), of which slight impacts leave few.
type Many = Wide<200>;

/// The quantity by both means.
pub fn both(problem: &Problem) -> Result<[Values<Number>; 2], Why> {
    let membrane = problem.membrane::<Number>()?;
    let unit = problem.unit::<Number>()?;
    let [first, second] = if problem.cycle.is_some() {
        orbits::twice(problem)?.map(|orbit| orbit.velocities.iter().map(read).collect::<Vec<_>>())
    } else {
        [start(problem)?, start(problem)?]
    };
    let stable = |velocity: &Number| Ok(membrane.voltage(&(velocity.clone() * unit.clone())));
    let printed = |velocity: &Number| as_printed(problem, &velocity.convert());
    Ok([mean(problem, &first, stable)?, mean(problem, &second, printed)?])
}

/// The quantity in f64.
pub fn solved(problem: &Problem, means: Means) -> Result<Values<f64>, Why> {
    let membrane = problem.membrane::<f64>()?;
    let unit = problem.unit::<f64>()?;
    let velocities = if problem.cycle.is_some() {
        orbits::in_f64(problem, means)?.velocities
    } else {
        start(problem)?
    };
    mean(
        problem,
        &velocities,
        |velocity| Ok(membrane.voltage(&(velocity * unit))),
    )
}

fn start<T: Analytic>(problem: &Problem) -> Result<Vec<T>, Why> {
    Ok(vec![problem.begin()?.start::<T>().velocity])
}

/// (7): the mean over these impacts.
fn mean<T: Analytic>(
    problem: &Problem,
    velocities: &[T],
    voltage: impl Fn(&T) -> Result<T, Why>,
) -> Result<Values<T>, Why> {
    let mut sum = T::zero();
    for velocity in velocities {
        sum += voltage(velocity)?;
    }
    let name = if problem.cycle.is_some() {
        "mean_voltage"
    } else {
        "voltage"
    };
    let count = i64::try_from(velocities.len()).unwrap_or(i64::MAX);
    Ok(Values::new([(name, sum / T::from_integer(count))]))
}

/// The balance of energy solved for delta; the contact angle from A cos a + B sin a = R_b by its phase and amplitude;
/// the area of cap and cone; (6) as printed.
fn as_printed(problem: &Problem, velocity: &Many) -> Result<Number, Why> {
    let [mass, stiffness, exponent, ball, rim, volts] = problem.membrane_values::<Many>()?;
    let speed = velocity.clone() * problem.unit::<Many>()?;
    let (one, two) = (Many::from_integer(1), Many::from_integer(2));
    let more = exponent + one.clone();
    let energy = mass * speed.clone() * speed / two.clone();
    let delta = (energy * more.clone() / stiffness).powf(&(one.clone() / more));

    let (along, across) = (ball.clone() - delta, rim.clone());
    let length = (along.clone() * along.clone() + across.clone() * across.clone()).sqrt();
    let angle = across.atan2(&along) - (ball.clone() / length).acos();
    let (sin, cos) = angle.sincos();
    let square = |value: Many| value.clone() * value;
    let cap = two * Many::pi() * square(ball.clone()) * (one - cos.clone());
    let cone = Many::pi() * (square(rim.clone()) - square(ball * sin)) / cos;
    let ratio = (cap + cone) / (Many::pi() * square(rim));
    Ok(number(square(ratio) * volts.clone() - volts))
}
