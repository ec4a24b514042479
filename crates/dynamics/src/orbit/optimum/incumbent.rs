//! Good devices by local search in f64, and the proof that one of them is what it seems.

use crate::model::Motion;
use crate::orbit::clearance::{OrbitFlight, least};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::optimum::design::{Choice, Devices, Range};
use crate::orbit::optimum::explicit::ExplicitOneOne;
use crate::orbit::orbit::Orbit;
use crate::orbit::solve::krawczyk::sharpen;
use crate::orbit::solve::one_one::newton_one_one;
use crate::orbit::solve::proposals::propose;
use crate::orbit::word::Word;
use nalgebra::{DMatrix, DVector};
use numbers::{Interval, Sequence};

/// A device and its best motion, in f64: likely, not proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The parameters of the capsule, r_B, r_T.
    pub parameters: [f64; 4],
    /// The forcing periods of the motion.
    pub periods: u32,
    /// T_1 and the phase halfway through the first flight.
    pub at: [f64; 2],
    /// Volts per forcing period.
    pub rate: f64,
}

/// A device of the choice with a motion that is proved to be stable and admissible as asked.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedDevice {
    /// The parameters of the capsule, r_B, r_T: numbers of f64, or enclosures of an end of a range.
    pub parameters: [Interval; 4],
    /// The motion, every value enclosed.
    pub orbit: Orbit<f64>,
    /// The phase of the forcing halfway through the flight from bottom to top.
    pub middle: Interval,
    /// Volts per forcing period.
    pub rate: Interval,
}

/// Slacks in f64 below these are left to the bounds: rounding could have made them.
const LEAST_STABILITY: f64 = 1e-9;
const LEAST_CLEARANCE: f64 = 1e-11;

/// A search takes the best of so many random devices as starts ...
const DRAWN: usize = 600;

/// ... of which it improves so many, ...
const STARTS: usize = 6;

/// ... each by so many steps, the best one by as many again.
const STEPS: usize = 500;

/// Steps as parts of the ranges: the first, and the last that is worth while.
const FIRST_STEP: f64 = 0.2;
const LAST_STEP: f64 = 1e-10;

/// A step that succeeds makes the next ones longer, one that fails shorter, so that one in five succeeds (Rechenberg,
/// *Evolutionsstrategie*, 1973).
const LONGER: f64 = 1.6;
const SHORTER: f64 = 0.88;

/// The slacks of a motion, see [`LocalSearch::slacks`], and how much of each a device is mended to have.
const SLACKS: usize = 3;
const ENOUGH: [f64; SLACKS] = [1e-8, 1e-8, 1e-9];

/// Steps of mending, and the part of a range over which slacks are differentiated.
const MENDINGS: usize = 6;
const DIFFERENCE: f64 = 1e-7;

/// Phases from which motions of a symmetric device are looked for.
const PHASES: u32 = 16;

/// A search for good devices.
pub struct LocalSearch<'a> {
    choice: &'a Choice,
    devices: Devices<f64>,
    sequence: Sequence,
}

impl<'a> LocalSearch<'a> {
    /// The same sequence of devices for the same choice.
    pub fn new(choice: &'a Choice) -> Self {
        Self {
            choice,
            devices: choice.devices.convert(Interval::midpoint),
            sequence: Sequence::new(18),
        }
    }

    /// The best device that random starts lead to.
    pub fn best(&mut self) -> Option<Candidate> {
        let mut found: Vec<Candidate> = Vec::new();
        for _ in 0..DRAWN {
            let parameters = std::array::from_fn(|i| {
                let hull = self.choice.ranges[i].hull();
                self.sequence.between(hull.low(), hull.high())
            });
            found.extend(self.at(parameters, None));
        }
        found.sort_by(|one, other| other.rate.total_cmp(&one.rate));
        found.truncate(STARTS);
        let climbed: Vec<Candidate> = found.into_iter().map(|start| self.climb(start)).collect();
        let best = climbed
            .into_iter()
            .max_by(|one, other| one.rate.total_cmp(&other.rate))?;
        Some(self.climb(best))
    }

    /// A device at least as good, by random steps from this one.
    pub fn climb(&mut self, start: Candidate) -> Candidate {
        let mut sequence = self.sequence.clone();
        let near = |parameters, best: &Candidate| self.near(parameters, best.periods, best.at);
        let rated = |candidate: &Candidate| (candidate.parameters, candidate.rate);
        let best = climb(&self.choice.ranges, &mut sequence, start, rated, near);
        self.sequence = sequence;
        best
    }

    /// The best motion of a device; where none is as asked, that of a device near it at which the motion near the given one
    /// is so.
    pub fn near(&self, parameters: [f64; 4], periods: u32, at: [f64; 2]) -> Option<Candidate> {
        let found = self.at(parameters, Some((periods, at)));
        found.or_else(|| {
            let (mended, at) = self.mended(parameters, periods, at)?;
            self.at(mended, Some((periods, at)))
        })
    }

    /// A device near the given one at which the motion near the given one is as asked: the shortest steps, as parts of the
    /// ranges, in which the slacks that lack become just enough by their derivatives (Gauss and Newton).
    fn mended(&self, parameters: [f64; 4], periods: u32, at: [f64; 2]) -> Option<([f64; 4], [f64; 2])> {
        let (mut parameters, mut at) = (parameters, at);
        let free: Vec<usize> = (0..4).filter(|&i| !self.choice.ranges[i].is_held()).collect();
        for _ in 0..MENDINGS {
            let (slacks, here) = self.slacks(parameters, periods, at)?;
            at = here;
            let lacking: Vec<usize> = (0..SLACKS).filter(|&i| slacks[i] < ENOUGH[i]).collect();
            if lacking.is_empty() {
                return Some((parameters, at));
            }
            if free.is_empty() {
                return None;
            }
            let mut slopes = DMatrix::zeros(lacking.len(), free.len());
            for (column, &index) in free.iter().enumerate() {
                let range = &self.choice.ranges[index];
                let towards = if parameters[index] > range.hull().midpoint() {
                    -1.0
                } else {
                    1.0
                };
                let part = towards * DIFFERENCE;
                let mut there = parameters;
                there[index] += part * range.span();
                let (moved, _) = self.slacks(there, periods, at)?;
                for (row, &slack) in lacking.iter().enumerate() {
                    slopes[(row, column)] = (moved[slack] - slacks[slack]) / part;
                }
            }
            let missing = DVector::from_fn(lacking.len(), |row, _| {
                1.5 * ENOUGH[lacking[row]] - slacks[lacking[row]]
            });
            let steps = slopes.svd(true, true).solve(&missing, f64::EPSILON).ok()?;
            for (step, &index) in steps.iter().zip(&free) {
                let range = &self.choice.ranges[index];
                let hull = range.hull();
                let moved = parameters[index] + step * range.span();
                if !moved.is_finite() {
                    return None;
                }
                parameters[index] = moved.clamp(hull.low(), hull.high());
            }
        }
        None
    }

    /// How much 1 + Det - margin is above Tr and above -Tr, and how much the clearance is above that asked for, of the motion
    /// that Newton's method leads to; the clearance of a motion that does not turn is large.
    fn slacks(&self, parameters: [f64; 4], periods: u32, at: [f64; 2]) -> Option<([f64; SLACKS], [f64; 2])> {
        let [first, second, r_b, r_t] = parameters;
        let [d, g] = self.devices.capsule([&first, &second]);
        let motion = Motion::new(g, d, r_b, r_t).ok()?;
        let balance = OneOneEquations::new(&motion, periods);
        let at = newton_one_one(&balance, at)?;
        self.rate(first, &balance, at, periods)?;
        let [fold, doubling] = self.stability(&motion, &balance, at);
        let clearance = clearance(&motion, periods, at)?.map_or(1.0, |least| least.midpoint());
        Some(([fold, doubling, clearance - self.choice.clearance.high()], at))
    }

    /// 1 + Det - margin - Tr and 1 + Det - margin + Tr.
    fn stability(&self, motion: &Motion<f64>, balance: &OneOneEquations<f64>, [t_1, middle]: [f64; 2]) -> [f64; 2] {
        let explicit = ExplicitOneOne::new([motion.d(), motion.g()], &balance.total(), &t_1, &middle);
        let [a, b] = explicit.arrivals();
        explicit
            .stability(&self.choice.margin.high())
            .map(|slack| slack / (a * b * a * b))
    }

    /// The best motion of a device that seems to be stable and admissible as asked, among likely ones and the one that
    /// Newton's method leads to from a motion `near` it, of which the periods, T_1 and the phase are given.
    pub fn at(&self, parameters: [f64; 4], near: Option<(u32, [f64; 2])>) -> Option<Candidate> {
        let parameters: [f64; 4] = std::array::from_fn(|i| self.choice.ranges[i].nearest(parameters[i]).midpoint());
        let [first, second, r_b, r_t] = parameters;
        let [d, g] = self.devices.capsule([&first, &second]);
        let motion = Motion::new(g, d, r_b, r_t).ok()?;
        let mut best: Option<Candidate> = None;
        for periods in 1..=self.choice.max_periods {
            let balance = OneOneEquations::new(&motion, periods);
            let mut places = propose(&balance);
            places.extend(symmetric(&motion, &balance, periods));
            let near = near.filter(|(of, _)| *of == periods);
            places.extend(near.and_then(|(_, guess)| newton_one_one(&balance, guess)));
            for at in places {
                let Some(rate) = self.rate(first, &balance, at, periods) else {
                    continue;
                };
                let is_better = best.is_none_or(|best| rate > best.rate);
                if is_better && self.is_allowed(&motion, &balance, periods, at) {
                    best = Some(Candidate {
                        parameters,
                        periods,
                        at,
                        rate,
                    });
                }
            }
        }
        best
    }

    fn rate(&self, first: f64, balance: &OneOneEquations<f64>, [t_1, middle]: [f64; 2], periods: u32) -> Option<f64> {
        let [v, w] = balance.velocities(&t_1, &middle);
        let flies = v > 0.0 && w < 0.0 && t_1 > 0.0 && t_1 < balance.total();
        flies.then(|| self.devices.voltages(&first, [&v, &-w]) / f64::from(periods))
    }

    /// Whether the motion is stable and keeps off the walls as asked.
    fn is_allowed(&self, motion: &Motion<f64>, balance: &OneOneEquations<f64>, periods: u32, at: [f64; 2]) -> bool {
        let slacks = self.stability(motion, balance, at);
        if !slacks.iter().all(|slack| *slack > LEAST_STABILITY) {
            return false;
        }
        let least_clearance = self.choice.clearance.high() + LEAST_CLEARANCE;
        clearance(motion, periods, at).is_some_and(|least| least.is_none_or(|least| least.low() > least_clearance))
    }
}

/// Improves a candidate by random steps: `rated` gives the parameters and the rate of a candidate,
/// `near` the candidate at parameters near those of another one.
pub(crate) fn climb<C>(
    ranges: &[Range; 4],
    sequence: &mut Sequence,
    start: C,
    rated: impl Fn(&C) -> ([f64; 4], f64),
    near: impl Fn([f64; 4], &C) -> Option<C>,
) -> C {
    let (mut best, mut step) = (start, FIRST_STEP);
    for _ in 0..STEPS {
        if step < LAST_STEP {
            break;
        }
        let (here, rate) = rated(&best);
        let parameters = std::array::from_fn(|i| {
            let range = &ranges[i];
            if range.is_held() {
                return here[i];
            }
            // the sum of three is near enough to a normal distribution
            let parts: f64 = (0..3).map(|_| sequence.between(-1.0, 1.0)).sum();
            let hull = range.hull();
            (here[i] + step * range.span() * parts).clamp(hull.low(), hull.high())
        });
        match near(parameters, &best) {
            Some(better) if rated(&better).1 > rate => {
                best = better;
                step *= LONGER;
            }
            _ => step *= SHORTER,
        }
    }
    best
}

/// The clearance of a motion, as far as it is known; none where it does not turn. `None` where that is not decided.
fn clearance(motion: &Motion<f64>, periods: u32, at: [f64; 2]) -> Option<Option<Interval>> {
    let motion = motion.convert(|value| Interval::point(*value)).ok()?;
    let balance = OneOneEquations::new(&motion, periods);
    let [t_1, middle] = at.map(Interval::point);
    let mut clearance = None;
    for (index, time) in [t_1, balance.total() - t_1].into_iter().enumerate() {
        let flight = balance.flight(index, &t_1, &middle);
        clearance = least(clearance, OrbitFlight { flight, time }.clearance().ok()?);
    }
    Some(clearance)
}

/// Where h_2 = 0 says nothing of the phase, at T_1 = n odd of a device that is its own mirror image, the motions that
/// Newton's method leads to.
fn symmetric(motion: &Motion<f64>, balance: &OneOneEquations<f64>, periods: u32) -> Vec<[f64; 2]> {
    if motion.mirrored().as_ref() != Some(motion) || periods.is_multiple_of(2) {
        return Vec::new();
    }
    let turn = 2.0 * std::f64::consts::PI;
    let phases = (0..PHASES).map(|index| turn * f64::from(index) / f64::from(PHASES));
    let found = phases.filter_map(|phase| newton_one_one(balance, [f64::from(periods), phase]));
    found.collect()
}

impl Choice {
    /// Proves that there is this motion and that it is as asked; `None` where that cannot be decided, or is not so.
    pub fn prove(&self, candidate: &Candidate) -> Option<ProvedDevice> {
        let parameters: [Interval; 4] = std::array::from_fn(|i| self.ranges[i].nearest(candidate.parameters[i]));
        let [first, second, r_b, r_t] = parameters;
        let [d, g] = self.devices.capsule([&first, &second]);
        let motion = Motion::new(g, d, r_b, r_t).ok()?;
        let balance = OneOneEquations::new(&motion, candidate.periods);
        let [t_1, middle] = sharpen(&balance, candidate.at)?.enclosure;
        if !(t_1.is_positive() && (balance.total() - t_1).is_positive()) {
            return None;
        }
        let impacts = balance.impacts(&t_1, &middle);
        let orbit = Orbit::from_impacts(&Word::pair(), candidate.periods, &motion, &impacts).ok()?;
        let slack = Interval::point(1.0) + orbit.determinant - self.margin - orbit.trace.size();
        let is_clear = match &orbit.clearance {
            None => true,
            Some(clearance) => (*clearance - self.clearance).low() >= 0.0,
        };
        if !(orbit.stable && orbit.admissible && is_clear && slack.low() >= 0.0) {
            return None;
        }
        let speeds = [orbit.velocities[0], -orbit.velocities[1]];
        let periods = Interval::point(f64::from(candidate.periods));
        let rate = self.devices.voltages(&first, [&speeds[0], &speeds[1]]) / periods;
        rate.is_finite().then_some(ProvedDevice {
            parameters,
            orbit,
            middle,
            rate,
        })
    }
}
