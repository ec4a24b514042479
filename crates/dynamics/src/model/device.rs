//! The device in SI units, and the scales that make its motion non-dimensional.

use numbers::Analytic;

/// The harvester as Table 1 of the paper gives it, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Device<T> {
    /// M, kg, above 0.
    pub capsule_mass: T,
    /// A, the amplitude of the force, N, above 0.
    pub forcing_amplitude: T,
    /// omega, rad/s, above 0.
    pub angular_frequency: T,
    /// beta, the angle against the horizontal, rad, any finite number.
    pub incline: T,
    /// Gravity, m/s², not negative.
    pub gravity: T,
}

/// Where the non-dimensional motion and SI meet (time unit pi/omega, so that the forcing period is 2).
#[derive(Clone, Debug, PartialEq)]
pub struct Scales<T> {
    /// M gravity sin(beta) / A, without unit: the g of the motion.
    pub g: T,
    /// A pi² / (M omega²), m.
    pub length: T,
    /// A pi / (M omega), m/s.
    pub velocity: T,
    /// pi / omega, s.
    pub time: T,
}

/// A device that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DeviceError {
    /// A quantity is NaN, infinite or out of its range.
    #[error("{name} is {found}, must be {allowed}")]
    OutOfRange {
        /// The key of the quantity.
        name: &'static str,
        /// What was given.
        found: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The quantities are so extreme that a scale overflows or vanishes.
    #[error("the {name} of this device is {found}, beyond the range of the number type")]
    Scale {
        /// Which scale.
        name: &'static str,
        /// Its value.
        found: f64,
    },
}

/// M gravity sin(beta) / A: the g of the motion, in which the angular frequency has no say.
///
/// Accurate to a few roundings of `T`. Units and ranges as in [`Device`], not checked here.
pub fn gravity_component<T: Analytic>(capsule_mass: T, forcing_amplitude: T, incline: &T, gravity: T) -> T {
    gravity / (forcing_amplitude / capsule_mass) * incline.sincos().0
}

impl<T: Analytic> Device<T> {
    /// The gravity component and the units of length, velocity and time.
    ///
    /// Accurate to a few roundings of `T`. Source: the paper's section 2.1 with the scaling t = omega tau / pi.
    ///
    /// # Errors
    /// A quantity out of its range, or a scale that overflows or vanishes.
    pub fn scales(&self) -> Result<Scales<T>, DeviceError> {
        self.check()?;
        let (mass, amplitude) = (self.capsule_mass.clone(), self.forcing_amplitude.clone());
        let acceleration = amplitude / mass;
        let time = T::pi() / self.angular_frequency.clone();
        let velocity = acceleration * time.clone();
        let length = velocity.clone() * time.clone();
        let g = gravity_component(
            self.capsule_mass.clone(),
            self.forcing_amplitude.clone(),
            &self.incline,
            self.gravity.clone(),
        );
        for (name, scale) in [
            ("time unit", &time),
            ("velocity unit", &velocity),
            ("length unit", &length),
        ] {
            let found = scale.to_f64();
            if !(found > 0.0 && found.is_finite()) {
                return Err(DeviceError::Scale { name, found });
            }
        }
        let found = g.to_f64();
        if !found.is_finite() {
            return Err(DeviceError::Scale {
                name: "gravity component",
                found,
            });
        }
        Ok(Scales {
            g,
            length,
            velocity,
            time,
        })
    }

    fn check(&self) -> Result<(), DeviceError> {
        let positive = [
            ("capsule_mass", &self.capsule_mass),
            ("forcing_amplitude", &self.forcing_amplitude),
            ("angular_frequency", &self.angular_frequency),
        ];
        for (name, value) in positive {
            let found = value.to_f64();
            if !(found > 0.0 && found.is_finite()) {
                return Err(DeviceError::OutOfRange {
                    name,
                    found,
                    allowed: "finite and above 0",
                });
            }
        }
        let found = self.incline.to_f64();
        if !found.is_finite() {
            return Err(DeviceError::OutOfRange {
                name: "incline",
                found,
                allowed: "finite",
            });
        }
        let found = self.gravity.to_f64();
        if !(found >= 0.0 && found.is_finite()) {
            return Err(DeviceError::OutOfRange {
                name: "gravity",
                found,
                allowed: "finite and 0 or more",
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn paper() -> Device<f64> {
        Device {
            capsule_mass: 0.1245,
            forcing_amplitude: 5.0,
            angular_frequency: 5.0 * PI,
            incline: PI / 6.0,
            gravity: 9.8,
        }
    }

    #[test]
    fn the_device_of_the_paper_has_the_gravity_that_its_printed_velocities_imply() {
        // (9) and (11) added on Fig. 2's orbits: 2 g = 1.5 (.8327202251 - .6700402251), 1.5 (.677449 - .514769)
        let g = paper().scales().map_or(f64::NAN, |scales| scales.g);
        assert!((g - 0.75 * (0.832_720_225_1 - 0.670_040_225_1)).abs() < 1e-10);
        assert!((g - 0.75 * (0.677_449 - 0.514_769)).abs() < 1e-6);
    }

    #[test]
    fn the_scales_belong_together() {
        let Ok(scales) = paper().scales() else {
            panic!("the paper's device is one")
        };
        assert!((scales.velocity * scales.time - scales.length).abs() < 1e-15);
        assert!((scales.velocity / scales.time - 5.0 / 0.1245).abs() < 1e-13);
        assert!((scales.time - 0.2).abs() < 1e-16);
    }

    #[test]
    fn every_quantity_out_of_range_is_named() {
        type Break = fn(&mut Device<f64>);
        let breaks: [(&str, Break); 6] = [
            ("capsule_mass", |device| device.capsule_mass = 0.0),
            ("forcing_amplitude", |device| device.forcing_amplitude = f64::NAN),
            ("angular_frequency", |device| device.angular_frequency = -1.0),
            ("incline", |device| device.incline = f64::INFINITY),
            ("gravity", |device| device.gravity = -9.8),
            ("length unit", |device| device.angular_frequency = 1e-300),
        ];
        for (name, break_it) in breaks {
            let mut device = paper();
            break_it(&mut device);
            let message = device
                .scales()
                .map_or_else(|error| error.to_string(), |_| String::new());
            assert!(message.contains(name), "{name}: {message}");
        }
    }
}
