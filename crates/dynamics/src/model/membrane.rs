//! The membrane under an impact and the voltage it gives, equations (5) to (7).
//!
//! The ball presses the membrane in by delta, until the energy of the impact is that of the membrane's force:
//! m v²/2 = K delta^(nu+1)/(nu+1). The membrane then has the shape of a cap of the ball's radius R_b with contact
//! angle a, and of a cone that touches the cap and ends at the rim, of radius R_c:
//! (R_b - delta) cos a + R_c sin a = R_b. The paper does not print the shape; with this one its voltages come out.

#[cfg(any(test, feature = "calls"))]
use super::calls::{self, Call};
use numbers::Analytic;

/// A membrane of a dielectric elastomer and the ball that strikes it, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Membrane<T> {
    ball_radius: T,
    membrane_radius: T,
    input_voltage: T,
    /// sqrt((nu+1) m / (2 K)): by it the speed becomes delta^((nu+1)/2).
    softness: T,
    /// 2/(nu+1).
    power: T,
}

/// A membrane that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MembraneError {
    /// A quantity is NaN, infinite or not positive.
    #[error("{name} is {found}, must be finite and above 0")]
    OutOfRange {
        /// The key of the quantity.
        name: &'static str,
        /// What was given.
        found: f64,
    },
    /// The ball does not fit through the rim: no cone is left around the cap when the ball is pressed in far.
    #[error("membrane_radius is {found}, must be above ball_radius, {ball_radius}")]
    Narrow {
        /// R_c.
        found: f64,
        /// R_b.
        ball_radius: f64,
    },
    /// The quantities are so extreme that the membrane gives way to nothing or to everything.
    #[error("ball_mass over stiffness is beyond the range of the number type")]
    Extreme,
}

/// The shape of the pressed membrane, by the contact angle a.
struct Shape<T> {
    /// cos a.
    cos: T,
    /// 1 - cos a.
    fall: T,
}

impl<T: Analytic> Membrane<T> {
    /// A membrane of the radius R_c `membrane_radius`, m, whose force is `stiffness` delta^`exponent`, N, under
    /// `input_voltage`, V, struck by a ball of `ball_mass`, kg, and of the radius R_b `ball_radius`, m.
    ///
    /// # Errors
    /// What is not finite and above 0, by name; a membrane that is not wider than the ball.
    pub fn new(
        ball_mass: T,
        stiffness: T,
        exponent: T,
        ball_radius: T,
        membrane_radius: T,
        input_voltage: T,
    ) -> Result<Self, MembraneError> {
        #[cfg(any(test, feature = "calls"))]
        calls::count(Call::Membrane);
        for (name, value) in [
            ("ball_mass", &ball_mass),
            ("stiffness", &stiffness),
            ("exponent", &exponent),
            ("ball_radius", &ball_radius),
            ("membrane_radius", &membrane_radius),
            ("input_voltage", &input_voltage),
        ] {
            let found = value.to_f64();
            if !(found > 0.0 && found.is_finite()) {
                return Err(MembraneError::OutOfRange { name, found });
            }
        }
        // the difference: two wide radii may be one in f64
        let room = (membrane_radius.clone() - ball_radius.clone()).to_f64();
        if room <= 0.0 || room.is_nan() {
            let (found, ball_radius) = (membrane_radius.to_f64(), ball_radius.to_f64());
            return Err(MembraneError::Narrow { found, ball_radius });
        }
        let one_more = exponent + T::one();
        let softness = (one_more.clone() * ball_mass / (stiffness.clone() + stiffness)).sqrt();
        let size = softness.to_f64();
        if !(size > 0.0 && size.is_finite()) {
            return Err(MembraneError::Extreme);
        }
        Ok(Self {
            ball_radius,
            membrane_radius,
            input_voltage,
            softness,
            power: T::from_integer(2) / one_more,
        })
    }

    /// The same over another number.
    pub fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> Membrane<U> {
        Membrane {
            ball_radius: convert(&self.ball_radius),
            membrane_radius: convert(&self.membrane_radius),
            input_voltage: convert(&self.input_voltage),
            softness: convert(&self.softness),
            power: convert(&self.power),
        }
    }

    /// How far an impact of `speed`, m/s, presses the membrane in, m. The sign of the speed does not matter; what is
    /// not a number gives none.
    ///
    /// Accurate to a few roundings of `T` times ln(delta / 1 m), which is below 32 for speeds from 1e-12 on.
    pub fn deflection(&self, speed: &T) -> T {
        #[cfg(any(test, feature = "calls"))]
        calls::count(Call::Deflection);
        // at 0 a power has no logarithm and, over dual numbers, no derivative
        if speed.is_zero() {
            return T::zero();
        }
        let sign = T::from_integer(if speed.to_f64() < 0.0 { -1 } else { 1 });
        // the root before the power: v² may leave the range where delta does not
        (sign * speed.clone() * self.softness.clone()).powf(&self.power)
    }

    /// A_k, the area of the membrane that an impact of `speed`, m/s, has pressed in, m².
    ///
    /// Accurate to a few roundings of `T`.
    pub fn area(&self, speed: &T) -> T {
        let growth = self.growth(&self.shape(&self.deflection(speed)));
        self.flat() * (T::one() + growth)
    }

    /// U_k of (6), the absolute output voltage of an impact of `speed`, m/s, in V. The sign of the speed does not
    /// matter; 0 gives 0, what is not a number gives none.
    ///
    /// Of (A_k / pi R_c²)² - 1 it forms neither the square nor the difference, so the relative accuracy is kept for
    /// the slightest and the hardest impacts: in f64 within 1e-14 for speeds from 1e-12 to 1e3 m/s.
    pub fn voltage(&self, speed: &T) -> T {
        let growth = self.growth(&self.shape(&self.deflection(speed)));
        self.input_voltage.clone() * growth.clone() * (T::from_integer(2) + growth)
    }

    /// U_k by (5) and (6) as they are printed, from the area of cap and cone.
    ///
    /// Its digits are lost in the difference for slight impacts: with the paper's membrane in f64, half of them at
    /// 1e-7 m/s and all of them at 1e-15 m/s. For comparison with [`Membrane::voltage`] only.
    pub fn voltage_as_printed(&self, speed: &T) -> T {
        let Shape { cos, .. } = self.shape(&self.deflection(speed));
        let square = |value: &T| value.clone() * value.clone();
        let cap = T::from_integer(2) * T::pi() * square(&self.ball_radius) * (T::one() - cos.clone());
        let sin_square = T::one() - square(&cos);
        let cone = T::pi() * (square(&self.membrane_radius) - square(&self.ball_radius) * sin_square) / cos;
        let ratio = (cap + cone) / self.flat();
        square(&ratio) * self.input_voltage.clone() - self.input_voltage.clone()
    }

    /// pi R_c².
    fn flat(&self) -> T {
        T::pi() * self.membrane_radius.clone() * self.membrane_radius.clone()
    }

    /// The contact angle of a deflection. With t = tan(a/2) the relation of the shape is a quadratic,
    /// (2 R_b - delta) t² - 2 R_c t + delta = 0, and t its root in [0, 1).
    fn shape(&self, deflection: &T) -> Shape<T> {
        let (ball, rim) = (&self.ball_radius, &self.membrane_radius);
        let beyond = deflection.clone() - ball.clone();
        let room = rim.clone() - ball.clone();
        // R_c² - delta (2 R_b - delta), as a sum of what is positive
        let between = room.clone() * (rim.clone() + ball.clone());
        let root = (between.clone() + beyond.clone() * beyond.clone()).sqrt();
        let below = rim.clone() + root.clone();
        let t = deflection.clone() / below.clone();
        // root - beyond, which cancels where the ball is deep
        let left = if beyond.to_f64() > 0.0 {
            between / (root + beyond)
        } else {
            root - beyond
        };
        // 1 - t cancels there too: (R_c - R_b + root - beyond) / (R_c + root) does not
        let short = (room + left) / below;
        let square = t.clone() * t.clone();
        let sum = T::one() + square.clone();
        Shape {
            cos: short * (T::one() + t) / sum.clone(),
            fall: (square.clone() + square) / sum,
        }
    }

    /// A_k / (pi R_c²) - 1 = (1 - cos a)/cos a · (1 - (R_b/R_c)² (1 - cos a)).
    fn growth(&self, Shape { cos, fall }: &Shape<T>) -> T {
        let (ball, rim) = (&self.ball_radius, &self.membrane_radius);
        let ratio = ball.clone() / rim.clone();
        let rest = (rim.clone() - ball.clone()) * (rim.clone() + ball.clone()) / (rim.clone() * rim.clone());
        // the last factor as a sum, since 1 - cos a may come near 1 and the radii near one another
        fall.clone() / cos.clone() * (rest + ratio.clone() * ratio * cos.clone())
    }
}

#[cfg(test)]
mod tests;
