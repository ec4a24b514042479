//! What is swept, over which values.

use super::{Quantity, Start};
use dynamics::orbit::OrbitOptions;
use num_traits::Zero;
use numbers::Rational;
use std::fmt;

/// The parameter that is swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Over {
    /// The gap.
    D,
    /// The restitution of the bottom.
    RB,
    /// The restitution of the top.
    RT,
    /// The restitution of both, one value for the two.
    R,
    /// The angle of the device against the horizontal; needs `[device]`.
    Incline,
    /// Gravity along the capsule over the forcing; whatever else gives it is not read.
    G,
    /// The amplitude of the force; needs `[device]`. d stays the non-dimensional gap.
    ForcingAmplitude,
}

impl Over {
    /// Everything that can be swept.
    pub const ALL: [Self; 7] = [
        Self::D,
        Self::RB,
        Self::RT,
        Self::R,
        Self::Incline,
        Self::G,
        Self::ForcingAmplitude,
    ];

    /// The word in `over = "..."`, which is also the name of the column.
    pub const fn name(self) -> &'static str {
        match self {
            Self::D => "d",
            Self::RB => "r_b",
            Self::RT => "r_t",
            Self::R => "r",
            Self::Incline => "incline",
            Self::G => "g",
            Self::ForcingAmplitude => "forcing_amplitude",
        }
    }
}

impl fmt::Display for Over {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The values of a sweep: evenly spaced, exact, both ends among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// What is swept.
    pub over: Over,
    /// The first value.
    pub from: Quantity,
    /// The last value, above or below the first.
    pub to: Quantity,
    /// How many, at least 1.
    pub points: u32,
}

impl Sweep {
    /// The value of this number, from 0; beyond the last point, beyond `to`.
    pub fn value(&self, index: u32) -> Quantity {
        self.from.towards(&self.to, index, self.points.saturating_sub(1))
    }

    /// The distance between two values next to each other; none where there is one value, or where it is no rational.
    pub fn step(&self) -> Option<Rational> {
        let [first, second] = [0, 1].map(|index| self.value(index).rational().cloned());
        let step = second? - first?;
        let size = if step < Rational::zero() { -step } else { step };
        (self.points > 1).then_some(size)
    }

    /// Every value, in order.
    pub fn values(&self) -> impl ExactSizeIterator<Item = Quantity> {
        (0..self.points as usize).map(|index| self.value(index as u32))
    }
}

/// A parameter and the ends of its range, which may be in either order.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// The parameter.
    pub over: Over,
    /// One end.
    pub from: Quantity,
    /// The other end.
    pub to: Quantity,
}

/// Where the motion at each value of a sweep starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Begin {
    /// From `[start]`, at every value.
    Each,
    /// From the end of the value before; the first from `[start]`.
    Follow,
}

impl Begin {
    /// Both ways.
    pub const ALL: [Self; 2] = [Self::Each, Self::Follow];

    /// The word in `start = "..."`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Each => "each",
            Self::Follow => "follow",
        }
    }
}

/// What a bifurcation diagram needs besides the sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagram {
    /// The impacts computed at each value.
    pub impacts: u32,
    /// The last of them, which are kept; at most `impacts`.
    pub keep: u32,
    /// Where each value starts from.
    pub start: Begin,
    /// The relative standard error that the mean voltages of a motion that does not repeat are to have; none where
    /// `impacts` are enough.
    pub error: Option<f64>,
    /// The most impacts for that.
    pub most_impacts: u32,
    /// How what motions come to is looked for.
    pub options: OrbitOptions,
}

/// What is wanted at each point of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapWant {
    /// The word of what the motion comes to, and its periods.
    Word,
    /// The mean voltage of an impact.
    MeanVoltage,
    /// The voltage per forcing period.
    VoltageRate,
    /// The largest Lyapunov exponent, and the digits that hold.
    Lyapunov,
}

impl MapWant {
    /// All that can be wanted.
    pub const ALL: [Self; 4] = [Self::Word, Self::MeanVoltage, Self::VoltageRate, Self::Lyapunov];

    /// The word in `want = [...]`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Word => "word",
            Self::MeanVoltage => "mean_voltage",
            Self::VoltageRate => "voltage_rate",
            Self::Lyapunov => "lyapunov",
        }
    }

    /// Whether a membrane must be modelled.
    pub const fn is_voltage(self) -> bool {
        matches!(self, Self::MeanVoltage | Self::VoltageRate)
    }
}

/// A grid of two parameters, and what is computed at each of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The values along x, which change first.
    pub x: Sweep,
    /// The values along y.
    pub y: Sweep,
    /// How each motion is followed; where one follows the other, along x.
    pub diagram: Diagram,
    /// The starts, at least one.
    pub starts: Vec<Start>,
    /// What is wanted at each point, at least one thing.
    pub wants: Vec<MapWant>,
}

/// Evenly spaced numbers, both ends among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Spaced {
    /// The first.
    pub from: Quantity,
    /// The last.
    pub to: Quantity,
    /// How many, at least 1.
    pub points: u32,
}

impl Spaced {
    /// Number `index`, from 0.
    pub fn value(&self, index: u32) -> Quantity {
        self.from.towards(&self.to, index, self.points.saturating_sub(1))
    }
}

/// A grid of starts at the bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct StartGrid {
    /// The phases of the forcing at the first impact, rad, which change first.
    pub phase: Spaced,
    /// The velocities just before it, not negative.
    pub velocity: Spaced,
    /// How each motion is followed.
    pub diagram: Diagram,
}

impl StartGrid {
    /// How many starts there are.
    pub fn starts(&self) -> u64 {
        u64::from(self.phase.points) * u64::from(self.velocity.points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sweep(from: &str, to: &str, points: u32) -> Sweep {
        let [from, to] = [from, to].map(|text| Quantity::read(text).unwrap());
        Sweep {
            over: Over::D,
            from,
            to,
            points,
        }
    }

    #[test]
    fn the_grid_of_the_figures_has_the_printed_values_exactly() {
        let values: Vec<Quantity> = sweep("0.1", "0.5", 401).values().collect();
        assert_eq!(values.len(), 401);
        for (index, text) in [(0, "0.1"), (160, "0.26"), (230, "0.33"), (150, "0.25"), (400, "0.5")] {
            assert_eq!(values[index], Quantity::read(text).unwrap(), "{index}");
        }
        assert_eq!(values[160].rational(), Rational::new(13, 50).as_ref());
        assert_eq!(values[160].value::<f64>(), 0.26);
    }

    #[test]
    fn one_point_is_the_first_end() {
        assert_eq!(
            sweep("0.1", "0.5", 1).values().collect::<Vec<_>>(),
            [Quantity::read("0.1").unwrap()]
        );
    }

    proptest! {
        #[test]
        fn values_go_one_way_from_end_to_end(from in -500_i32..500, to in -500_i32..500, points in 2_u32..60, turns: bool) {
            prop_assume!(from != to);
            let unit = if turns { " pi/7" } else { "e-2" };
            let sweep = sweep(&format!("{from}{unit}"), &format!("{to}{unit}"), points);
            let values: Vec<Quantity> = sweep.values().collect();
            prop_assert_eq!(values.first(), Some(&sweep.from));
            prop_assert_eq!(values.last(), Some(&sweep.to));
            for pair in values.windows(2) {
                let (a, b): (f64, f64) = (pair[0].value(), pair[1].value());
                prop_assert_eq!(a < b, from < to);
                prop_assert_ne!(a, b);
            }
        }
    }
}
