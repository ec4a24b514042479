//! Many balls on their way, side by side.

use super::super::scaled::{Departure, Scaled};
use super::super::waves::Cosine;
use crate::model::Side;

/// The orbits that are followed together: the compiler makes vectors of the loops over them.
pub(super) const WIDTH: usize = 32;

/// One number for each lane.
pub(super) type Row = [f64; WIDTH];

/// What belongs to the bottom or to the top. A plain choice between entries of two rows would become one of addresses,
/// and a loop with such a choice no vector.
#[inline(always)]
pub(super) fn either_wall(side: f64, bottom: f64, top: f64) -> f64 {
    let mask = u64::from(side > 0.0).wrapping_neg();
    f64::from_bits((bottom.to_bits() & mask) | (top.to_bits() & !mask))
}

/// Balls that have just left a wall, and their motions: a lane is one entry of each row.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Lanes {
    /// 1 for a ball that left the bottom, -1 for the top.
    pub side: Row,
    /// In [0, 2 pi).
    pub phase: Row,
    /// Sine and cosine of the forcing there, as seen from the wall: times `side`.
    pub sin: Row,
    pub cos: Row,
    /// Away from the wall, in units of [`Scaled`].
    pub speed: Row,
    /// The turns that the latest flight took off the phase.
    pub turns: Row,
    /// Zdot just before the latest impact.
    pub velocity: Row,
    /// Whether the latest flight was an ordinary one: 1, else 0, and nothing else has changed.
    pub flown: Row,
    /// The angles of the latest ordinary flights from bottom and top, back and across.
    pub latest: [[Row; 2]; 2],
    /// Of the motion, in units of [`Scaled`].
    pub g: Row,
    pub gap: Row,
    pub restitution: [Row; 2],
    /// cos(turn) = -g.
    pub turn: Row,
    pub turn_sin: Row,
}

impl Lanes {
    /// All lanes at rest in motions that no ordinary flight belongs to.
    pub fn idle() -> Self {
        let row = [0.0; WIDTH];
        Self {
            side: [1.0; WIDTH],
            phase: row,
            sin: row,
            cos: [1.0; WIDTH],
            speed: row,
            turns: row,
            velocity: row,
            flown: row,
            latest: [[row; 2]; 2],
            g: row,
            gap: [1.0; WIDTH],
            restitution: [row; 2],
            turn: [std::f64::consts::FRAC_PI_2; WIDTH],
            turn_sin: [1.0; WIDTH],
        }
    }

    /// Puts a motion in a lane. One whose f + g never changes sign has no ordinary flights: for those no gap is that wide.
    pub fn enter(&mut self, lane: usize, scaled: &Scaled<f64>) {
        self.g[lane] = scaled.g;
        for (row, r) in self.restitution.iter_mut().zip(scaled.restitution) {
            row[lane] = r;
        }
        self.gap[lane] = f64::INFINITY;
        if let Some(turn) = scaled.turns.first() {
            self.gap[lane] = scaled.gap;
            self.turn[lane] = turn.phase;
            self.turn_sin[lane] = turn.waves.sin;
        }
        for angles in self.latest.as_flattened_mut() {
            angles[lane] = 0.0;
        }
        self.leave(lane);
    }

    /// Makes a lane idle until it departs.
    pub fn leave(&mut self, lane: usize) {
        self.speed[lane] = 0.0;
        self.flown[lane] = 0.0;
    }

    /// Lets the ball of a lane leave a wall.
    pub fn depart(&mut self, lane: usize, from: &Departure<f64, Cosine<f64>>) {
        let sign = from.side.sign();
        self.side[lane] = sign;
        self.phase[lane] = from.phase;
        self.sin[lane] = sign * from.waves.sin;
        self.cos[lane] = sign * from.waves.cos;
        self.speed[lane] = from.speed;
    }

    /// The wall a lane's ball has left.
    pub fn side(&self, lane: usize) -> Side {
        if self.side[lane] > 0.0 { Side::Bottom } else { Side::Top }
    }

    /// The restitution of the wall a lane's ball has left.
    #[inline(always)]
    pub fn restitution_from(&self, lane: usize) -> f64 {
        let [bottom, top] = &self.restitution;
        either_wall(self.side[lane], bottom[lane], top[lane])
    }

    /// The departure of a lane's ball.
    pub fn departure(&self, lane: usize) -> Departure<f64, Cosine<f64>> {
        let sign = self.side[lane];
        Departure {
            side: self.side(lane),
            phase: self.phase[lane],
            waves: Cosine {
                sin: sign * self.sin[lane],
                cos: sign * self.cos[lane],
            },
            speed: self.speed[lane],
            height: None,
            released: false,
        }
    }
}
