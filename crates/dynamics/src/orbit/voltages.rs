//! The voltages of a periodic motion, enclosed.

use crate::model::{Membrane, Side};
use crate::orbit::rounding::RoundedOrbit;
use numbers::{Analytic, Field, Interval, Told, Wide};

/// More digits than are told of any orbit.
const DIGITS: usize = 60;

/// The ends of enclosed voltages.
pub type VoltageEndpoint = Wide<DIGITS>;

/// A voltage, enclosed.
pub type EnclosedVoltage = Interval<VoltageEndpoint>;

/// The voltages (6) of a periodic motion, V, and their means; each holds the exact value where the motion is proved.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitVoltages {
    /// Of each impact, in word order.
    pub each: Vec<EnclosedVoltage>,
    /// The mean (7) over all impacts.
    pub mean: EnclosedVoltage,
    /// The mean over the impacts on the bottom; none where there is none.
    pub bottom: Option<EnclosedVoltage>,
    /// The same on the top.
    pub top: Option<EnclosedVoltage>,
    /// How far these two lie apart.
    pub apart: Option<EnclosedVoltage>,
}

impl OrbitVoltages {
    /// Those of an orbit: of every velocity within its error bound; where it has none, of the velocities as they are told.
    /// `unit` is the unit of velocity, m/s.
    pub fn of<N: Told>(orbit: &RoundedOrbit<N>, membrane: &Membrane<EnclosedVoltage>, unit: &EnclosedVoltage) -> Self {
        let room: VoltageEndpoint = orbit.error_bound.as_ref().map_or(Wide::from_integer(0), Told::wide);
        let voltage = |velocity: &N| {
            let velocity: VoltageEndpoint = velocity.wide();
            let around = Interval::new(velocity.clone() - room.clone(), velocity + room.clone());
            membrane.voltage(&(around * unit.clone()))
        };
        let each: Vec<EnclosedVoltage> = orbit.velocities.iter().map(voltage).collect();
        let mean = |side: Option<Side>| {
            let of_side = orbit.word.sides().zip(&each);
            let of_side = of_side.filter(|(wall, _)| side.is_none_or(|side| side == *wall));
            let zero = (EnclosedVoltage::from_integer(0), 0);
            let (sum, count) = of_side.fold(zero, |(sum, count), (_, voltage)| (sum + voltage.clone(), count + 1));
            (count > 0).then(|| sum / EnclosedVoltage::from_integer(count))
        };
        let [all, bottom, top] = [None, Some(Side::Bottom), Some(Side::Top)].map(mean);
        let apart = bottom.clone().zip(top.clone()).map(|(bottom, top)| {
            let apart = bottom - top;
            if apart.to_f64() < 0.0 { -apart } else { apart }
        });
        Self {
            // a word has an impact
            mean: all.unwrap_or_else(|| EnclosedVoltage::from_integer(0)),
            each,
            bottom,
            top,
            apart,
        }
    }
}
