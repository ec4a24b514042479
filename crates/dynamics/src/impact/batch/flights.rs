//! What is known of the flights of all lanes while they are worked out.

use super::angle::pick;
use super::lanes::{Row, WIDTH};
use super::near::Near;
use super::search::{Search, Stretch};

/// The flights from their departures to their contacts, one in each lane.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Flights {
    /// 1 while a stretch with a contact is looked for, else 0.
    pub open: Row,
    /// As [`Search`] and [`Stretch`] have it; 1 for yes, 0 for no.
    found: Row,
    pub far: Row,
    pub low: Row,
    pub high: Row,
    distances: [Row; 2],
    approaches: [Row; 2],
    piece_low: [Row; 3],
    piece_high: Row,
    falling: Row,
    /// The least distance of the dips before the contact, where growth is followed.
    pub clearance: Row,
    /// 1 while the contact is looked for, 0 where it is found, -1 where it is not.
    pub state: Row,
    /// An angle near the contact, the flight there, and the step from there to the contact.
    pub angle: Row,
    w: Row,
    push: Row,
    sin: Row,
    cos: Row,
    pub leap: Row,
}

impl Flights {
    pub fn none() -> Self {
        let row = [0.0; WIDTH];
        Self {
            open: row,
            found: row,
            far: row,
            low: row,
            high: row,
            distances: [row; 2],
            approaches: [row; 2],
            piece_low: [row; 3],
            piece_high: row,
            falling: row,
            clearance: row,
            state: row,
            angle: row,
            w: row,
            push: row,
            sin: row,
            cos: row,
            leap: row,
        }
    }

    #[inline(always)]
    pub fn stretch(&self, lane: usize) -> Stretch {
        Stretch {
            is_found: self.found[lane] > 0.0,
            is_far: self.far[lane] > 0.0,
            low: self.low[lane],
            high: self.high[lane],
            distances: [self.distances[0][lane], self.distances[1][lane]],
            approaches: [self.approaches[0][lane], self.approaches[1][lane]],
        }
    }

    #[inline(always)]
    pub fn search(&self, lane: usize) -> Search {
        let low = &self.piece_low;
        Search {
            is_open: self.open[lane] > 0.0,
            found: self.stretch(lane),
            low: [low[0][lane], low[1][lane], low[2][lane]],
            high: self.piece_high[lane],
            falling: self.falling[lane],
            clearance: self.clearance[lane],
        }
    }

    #[inline(always)]
    pub fn keep_search(&mut self, lane: usize, search: Search) {
        let flag = |is: bool| pick(is, 1.0, 0.0);
        let found = search.found;
        self.open[lane] = flag(search.is_open);
        self.found[lane] = flag(found.is_found);
        self.far[lane] = flag(found.is_far);
        self.low[lane] = found.low;
        self.high[lane] = found.high;
        for end in 0..2 {
            self.distances[end][lane] = found.distances[end];
            self.approaches[end][lane] = found.approaches[end];
        }
        for part in 0..3 {
            self.piece_low[part][lane] = search.low[part];
        }
        self.piece_high[lane] = search.high;
        self.falling[lane] = search.falling;
        self.clearance[lane] = search.clearance;
    }

    /// The flight near the contact; its distance is not kept.
    #[inline(always)]
    pub fn near(&self, lane: usize) -> Near {
        Near {
            y: 0.0,
            w: self.w[lane],
            push: self.push[lane],
            sin: self.sin[lane],
            cos: self.cos[lane],
        }
    }

    #[inline(always)]
    pub fn keep_near(&mut self, lane: usize, near: Near) {
        self.w[lane] = near.w;
        self.push[lane] = near.push;
        self.sin[lane] = near.sin;
        self.cos[lane] = near.cos;
    }
}
