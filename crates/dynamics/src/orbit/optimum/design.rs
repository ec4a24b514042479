//! What may be chosen of a device, within which ranges, and what it is worth.

use crate::model::Membrane;
use numbers::{Analytic, Interval};

/// How the gap follows from the first parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gap<T> {
    /// It is the parameter: d.
    Itself,
    /// The parameter is the forcing amplitude A and the capsule keeps its length s, m: d = s M omega²/(pi² A). Here is
    /// the factor of 1/A.
    HeldLength(T),
}

/// How gravity along the capsule follows from the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pull<T> {
    /// It is the second parameter: g.
    Itself,
    /// The second parameter is the incline beta: g = M gravity sin(beta)/A. Here is the factor of sin(beta).
    Inclined(T),
    /// The same where the first parameter is A. Here is the factor of sin(beta)/A.
    InclinedOverAmplitude(T),
}

/// The unit of velocity, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unit<T> {
    /// The same for every device.
    Same(T),
    /// A pi/(M omega) where the first parameter is A. Here is the factor of A.
    OfAmplitude(T),
}

/// Devices with two parameters of their capsule, over one number type: d or the forcing amplitude, then g or the incline.
#[derive(Clone, Debug, PartialEq)]
pub struct Devices<T> {
    /// d
    pub gap: Gap<T>,
    /// g
    pub pull: Pull<T>,
    /// What speeds are multiplied by.
    pub unit: Unit<T>,
    /// What makes voltages of speeds.
    pub membrane: Membrane<T>,
}

impl<T: Analytic> Devices<T> {
    /// d and g.
    pub fn capsule(&self, [first, second]: [&T; 2]) -> [T; 2] {
        let d = match &self.gap {
            Gap::Itself => first.clone(),
            Gap::HeldLength(factor) => factor.clone() / first.clone(),
        };
        let g = match &self.pull {
            Pull::Itself => second.clone(),
            Pull::Inclined(factor) => factor.clone() * second.sincos().0,
            Pull::InclinedOverAmplitude(factor) => factor.clone() * second.sincos().0 / first.clone(),
        };
        [d, g]
    }

    /// The unit of velocity.
    pub fn unit(&self, first: &T) -> T {
        match &self.unit {
            Unit::Same(unit) => unit.clone(),
            Unit::OfAmplitude(factor) => factor.clone() * first.clone(),
        }
    }

    /// The sum of the voltages of two impacts.
    pub fn voltages(&self, first: &T, [one, other]: [&T; 2]) -> T {
        let unit = self.unit(first);
        let voltage = |speed: &T| self.membrane.voltage(&(speed.clone() * unit.clone()));
        voltage(one) + voltage(other)
    }

    /// The same over another number.
    pub fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> Devices<U> {
        Devices {
            gap: match &self.gap {
                Gap::Itself => Gap::Itself,
                Gap::HeldLength(factor) => Gap::HeldLength(convert(factor)),
            },
            pull: match &self.pull {
                Pull::Itself => Pull::Itself,
                Pull::Inclined(factor) => Pull::Inclined(convert(factor)),
                Pull::InclinedOverAmplitude(factor) => Pull::InclinedOverAmplitude(convert(factor)),
            },
            unit: match &self.unit {
                Unit::Same(unit) => Unit::Same(convert(unit)),
                Unit::OfAmplitude(factor) => Unit::OfAmplitude(convert(factor)),
            },
            membrane: self.membrane.convert(convert),
        }
    }
}

/// The range of a parameter, its ends enclosed: one number where the parameter is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Its lower end.
    pub low: Interval,
    /// Its upper end, not below the lower one.
    pub high: Interval,
}

impl Range {
    /// A parameter that is held.
    pub fn held(value: Interval) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// Every value of it, and no more than rounding beside it.
    pub fn hull(&self) -> Interval {
        self.low.hull(&self.high)
    }

    /// Whether the parameter is held.
    pub fn is_held(&self) -> bool {
        self.low == self.high
    }

    /// The value of the range that is nearest to `value`, enclosed.
    pub fn nearest(&self, value: f64) -> Interval {
        if self.is_held() || value <= self.low.high() || value.is_nan() {
            self.low
        } else if value >= self.high.low() {
            self.high
        } else {
            Interval::point(value)
        }
    }

    /// From one end to the other.
    pub fn span(&self) -> f64 {
        self.high.midpoint() - self.low.midpoint()
    }
}

/// Of which devices, and of which of their motions, the one with the largest voltage is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What the parameters mean.
    pub devices: Devices<Interval>,
    /// The ranges of the two parameters of the capsule, then of r_B and r_T.
    pub ranges: [Range; 4],
    /// The motions take 1 to so many forcing periods.
    pub max_periods: u32,
    /// 1 + Det - |Tr| of the motion is at least this, not below 0.
    pub margin: Interval,
    /// Its clearance is at least this, not below 0.
    pub clearance: Interval,
}
