//! The extremes that are approached step by step, each with what measures the distance.

/// Steps for each power of ten; more where digits go with the length itself, not with its logarithm.
const STEPS: f64 = 2.0;
const MORE_STEPS: f64 = 8.0;

/// An extreme, approached on a logarithmic ladder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// The extreme.
    pub name: &'static str,
    /// What is small near the extreme, or grows without bound, in symbols.
    pub distance: &'static str,
    /// The powers of ten of the distance, from harmless to extreme.
    exponents: [f64; 2],
    /// Steps for each of them.
    steps: f64,
}

const fn approach(name: &'static str, distance: &'static str, exponents: [f64; 2]) -> Approach {
    Approach {
        name,
        distance,
        exponents,
        steps: STEPS,
    }
}

pub(super) const DELTA: Approach = approach("Delta to 0", "|Tr / (2 r_B r_T) - 1|", [-1.0, -14.0]);
pub(super) const LOSSLESS: Approach = approach("r to 1", "1 - r", [-1.0, -14.0]);
pub(super) const GRAVITY: Approach = approach("|g| to 1", "1 - |g|", [-2.0, -14.0]);
pub(super) const GAP: Approach = approach("d to 0", "d", [-1.0, -14.0]);
pub(super) const GRAZING: Approach = approach("grazing", "1 - d / (d that is grazed)", [-1.0, -14.0]);
pub(super) const SLOW: Approach = approach("velocity to 0", "velocity / the other one", [-1.0, -14.0]);
pub(super) const CHAOS: Approach = Approach {
    steps: MORE_STEPS,
    ..approach("length of a chaotic run", "impacts", [0.0, 1.75])
};
pub(super) const IMPACTS: Approach = approach("number of impacts", "impacts", [1.0, 6.0]);
pub(super) const TURN: Approach = approach("T_1 to r_T T_2", "T_1 / (r_T T_2) - 1", [-1.0, -14.0]);
pub(super) const DEAD: Approach = approach("r_B to 0", "r_B", [-1.0, -14.0]);
pub(super) const SADDLE: Approach = approach("multipliers apart", "Tr", [1.0, 14.0]);
pub(super) const SHORT: Approach = approach("flight to 0", "time of flight", [-1.0, -14.0]);
pub(super) const LATE: Approach = approach("late time", "t", [0.6, 14.6]);
pub(super) const WRAP: Approach = approach("phase to its wrap", "2 - t", [-1.0, -14.0]);
pub(super) const SLIGHT: Approach = approach("voltage to 0", "velocity, m/s", [-1.0, -14.0]);

impl Approach {
    /// All of them.
    pub const ALL: [Self; 15] = [
        DELTA, LOSSLESS, GRAVITY, GAP, GRAZING, SLOW, CHAOS, IMPACTS, TURN, DEAD, SADDLE, SHORT, LATE, WRAP, SLIGHT,
    ];

    /// The powers of ten of the steps, from harmless to extreme.
    pub fn exponents(&self) -> Vec<f64> {
        let [from, to] = self.exponents;
        let last = (self.steps * (to - from).abs()).round() as u32;
        let step = (to - from).signum() / self.steps;
        (0..=last).map(|index| from + step * f64::from(index)).collect()
    }

    /// Whether the distance grows towards the extreme, as a length does.
    pub fn grows(&self) -> bool {
        self.exponents[1] > self.exponents[0]
    }

    /// How far on the ladder a distance is: its logarithm, larger towards the extreme.
    pub fn abscissa(&self, distance: f64) -> f64 {
        if self.grows() {
            distance.log10()
        } else {
            -distance.log10()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ladder_leads_towards_the_extreme_by_half_decades() {
        assert_eq!(CHAOS.exponents()[..3], [0.0, 0.125, 0.25]);
        assert_eq!(GAP.exponents()[..3], [-1.0, -1.5, -2.0]);
        for approach in Approach::ALL {
            let exponents = approach.exponents();
            let along = exponents
                .iter()
                .map(|exponent| approach.abscissa(10_f64.powf(*exponent)));
            assert!(along.is_sorted(), "{approach:?}");
            assert_eq!(exponents.last(), approach.exponents.last());
        }
    }
}
