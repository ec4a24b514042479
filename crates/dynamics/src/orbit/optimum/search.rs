//! Branch and bound over devices and motions.
//!
//! Every box of (capsule, T_1, phase) is narrowed to where motions as asked may be that are worth more than the best one
//! that is proved; what is left is halved, the box of the largest bound first (Hansen and Walster, *Global Optimization
//! Using Interval Analysis*, 2004, ch. 12). What was dropped cannot hold the optimum; the largest bound of what is left
//! encloses it from above.

use crate::orbit::interval_box::width;
use crate::orbit::optimum::cell::{Cell, Constraint, Examined, Form, Formulas, Outcome, UNKNOWNS};
use crate::orbit::optimum::design::Choice;
use crate::orbit::optimum::incumbent::{Candidate, LocalSearch, ProvedDevice};
use crate::orbit::optimum::record::{Left, SearchBatch, SearchOutcomes, SearchRecord, Start};
use crate::orbit::optimum::sensitivity::sensitivities;
use crate::orbit::optimum::supremum::{Active, active, is_attained};
use crate::orbit::parallel::each;
use numbers::Interval;
use std::collections::BinaryHeap;
use stop::{self, Token};

/// How far a search for the optimum goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptimumLimits {
    /// It ends where the largest bound is above the best value by at most this part of it.
    pub gap: f64,
    /// It ends after so many boxes.
    pub most_boxes: u64,
    /// Which part of the motions is searched.
    pub part: OptimumPart,
}

/// One of several parts of a search, of which each has other motions: the best of all parts is the best of the whole, and the
/// largest bound of all encloses it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OptimumPart {
    /// From 1.
    pub number: u32,
    /// How many there are, at least 1.
    pub of: u32,
}

impl OptimumPart {
    /// All of a search.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Of the motions in these boxes those of this part: where there are several parts, the boxes are halved until each part
    /// has [`BOXES_OF_A_PART`], which are dealt out in turn, since most of the work lies near the optimum.
    fn own(self, everything: Vec<Start>) -> Vec<Start> {
        if self.of <= 1 {
            return everything;
        }
        let mut boxes = everything;
        for direction in (0..UNKNOWNS).cycle() {
            if boxes.len() >= BOXES_OF_A_PART * self.of as usize {
                break;
            }
            let halves = boxes.into_iter().flat_map(|(cell, periods, most)| {
                let (low, high) = cell[direction].halves();
                let half = move |half| {
                    let mut cell = cell;
                    cell[direction] = half;
                    (cell, periods, most)
                };
                // a parameter that is held has no halves
                let count = if width(&cell[direction]) > 0.0 { 2 } else { 1 };
                [low, high].map(half).into_iter().rev().take(count)
            });
            boxes = halves.collect();
        }
        let own = (0..self.of).cycle().zip(boxes);
        own.filter(|(number, _)| number + 1 == self.number)
            .map(|(_, start)| start)
            .collect()
    }
}

/// The boxes that each part of a search begins with, at least.
const BOXES_OF_A_PART: usize = 64;

/// How far a search has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptimumProgress {
    /// Boxes examined.
    pub boxes: u64,
    /// Volts per forcing period of the best device that is proved.
    pub best: Option<f64>,
    /// No device of the choice is worth more.
    pub most: f64,
}

impl OptimumProgress {
    /// By which part of the bound the best value may be below it; none where nothing is proved yet.
    pub fn gap(&self) -> Option<f64> {
        self.best.map(|best| gap(best, self.most))
    }
}

/// By which part of the bound `most` the value `best` may be below it.
fn gap(best: f64, most: f64) -> f64 {
    let gap = (most - best) / most;
    // of a bound beyond all numbers, all of it
    if gap.is_nan() { 1.0 } else { gap.max(0.0) }
}

/// The best device of a choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// The best one that is proved; `None` where none was found.
    pub device: Option<ProvedDevice>,
    /// No device of the choice is worth more, in volts per forcing period. Below 0 where there is no motion as asked.
    pub most: f64,
    /// Where every device that may be the best one is: the parameters of the capsule, r_B, r_T. `None` where there is no
    /// motion as asked.
    pub place: Option<[Interval; 4]>,
    /// Whether the supremum is the value of a motion that attracts and keeps off the walls; `None` where that is not
    /// decided.
    pub attained: Option<bool>,
    /// The constraints that are active at the device.
    pub active: Vec<Active>,
    /// The derivatives of the volts per forcing period at the device by the parameters of the capsule, r_B, r_T; `None` at
    /// a fold.
    pub sensitivities: Option<[f64; 4]>,
    /// Whether the gap asked for was reached.
    pub is_complete: bool,
    /// Boxes examined.
    pub boxes: u64,
}

impl Optimum {
    /// By which part of the bound the best value may be below it.
    pub fn gap(&self) -> Option<f64> {
        self.device.as_ref().map(|device| gap(device.rate.low(), self.most))
    }
}

/// Boxes that are halved before any of their halves is: so many can be examined at once.
const BATCH: usize = 32;

/// So many boxes are examined before it is looked whether the search is to stop.
const LARGEST_BATCH: usize = 1024;

/// Sides shorter than this part of their unit are not halved.
const FINEST: f64 = 1e-12;

/// Where the gap is reached at once, so many boxes more are examined to narrow the place.
const PLACE_BOXES: u64 = 2000;

/// A device at the middle of a box is looked at once in so many batches.
const LOOKED_AT: u64 = 4;

/// The best device of a choice, with the proof that none is better by more than the gap.
///
/// The same answer however many threads examine boxes. `progress` is called from time to time.
pub fn optimum(choice: &Choice, limits: OptimumLimits, progress: impl FnMut(&OptimumProgress)) -> Optimum {
    let Ok(found) = optimum_recorded(choice, limits, &mut (), progress);
    found
}

/// The same as [`optimum`], with the outcomes that stand in a record already and those that are put down in it.
///
/// # Errors
/// What the record says.
pub fn optimum_recorded<R: SearchRecord>(
    choice: &Choice,
    limits: OptimumLimits,
    record: &mut R,
    mut progress: impl FnMut(&OptimumProgress),
) -> Result<Optimum, R::Error> {
    let formulas: Vec<Formulas> = (1..=choice.max_periods).map(|n| Formulas::new(choice, n)).collect();
    let mut local = LocalSearch::new(choice);
    let mut search = Search {
        choice,
        formulas: &formulas,
        best: None,
        left: BinaryHeap::new(),
        fine: Vec::new(),
        boxes: 0,
        record,
    };
    if nothing_attracts(choice) {
        return Ok(search.optimum(limits.gap));
    }
    if let Some(candidate) = local.best() {
        search.take(&candidate);
    }
    let everything = formulas.iter().zip(1..);
    let everything = everything.map(|(formulas, periods)| (formulas.everything(), periods, f64::INFINITY));
    search.examine(&limits.part.own(everything.collect()))?;
    let mut rounds = 0;
    while !search.is_within(limits.gap) && search.boxes < limits.most_boxes && stop::goes_on() {
        if search.left.is_empty() {
            break;
        }
        if rounds % LOOKED_AT == 0 {
            search.look(&mut local);
        }
        rounds += 1;
        search.halve()?;
        progress(&search.progress());
    }
    let is_complete = search.is_within(limits.gap);
    if is_complete {
        search.narrow_place(limits.most_boxes, &mut local)?;
    }
    Ok(search.optimum(limits.gap))
}

/// Where both restitutions are 1, Det is 1 and nothing attracts.
fn nothing_attracts(choice: &Choice) -> bool {
    let [_, _, r_b, r_t] = choice.ranges;
    [r_b, r_t].iter().all(|range| range.low.low() >= 1.0)
}

struct Search<'a, R> {
    choice: &'a Choice,
    formulas: &'a [Formulas<'a>],
    best: Option<ProvedDevice>,
    left: BinaryHeap<Left>,
    /// Boxes that are not halved again.
    fine: Vec<Left>,
    boxes: u64,
    record: &'a mut R,
}

impl<R: SearchRecord> Search<'_, R> {
    /// Volts per forcing period of the best device.
    fn best(&self) -> Option<f64> {
        self.best.as_ref().map(|device| device.rate.low())
    }

    /// The largest bound, in volts per forcing period.
    fn most(&self) -> f64 {
        let of = |left: &Left| left.most;
        let fine = self.fine.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let left = self.left.peek().map_or(f64::NEG_INFINITY, of);
        let best = self
            .best
            .as_ref()
            .map_or(f64::NEG_INFINITY, |device| device.rate.high());
        fine.max(left).max(best)
    }

    fn progress(&self) -> OptimumProgress {
        OptimumProgress {
            boxes: self.boxes,
            best: self.best(),
            most: self.most(),
        }
    }

    fn is_within(&self, gap: f64) -> bool {
        if self.left.is_empty() && self.fine.is_empty() {
            return true;
        }
        self.progress().gap().is_some_and(|reached| reached <= gap)
    }

    /// Takes a device for the best one, where it is proved and better.
    fn take(&mut self, candidate: &Candidate) -> bool {
        if self.best().is_some_and(|best| candidate.rate <= best) {
            return false;
        }
        let Some(device) = self.choice.prove(candidate) else {
            return false;
        };
        if self.best().is_some_and(|best| device.rate.low() <= best) {
            return false;
        }
        self.best = Some(device);
        true
    }

    /// Looks for a better device where the largest bound is.
    fn look(&mut self, local: &mut LocalSearch) {
        let Some(left) = self.left.peek() else { return };
        let Some(device) = self.formulas[left.periods as usize - 1].device(&left.cell) else {
            return;
        };
        let near = [left.cell[2].midpoint(), left.cell[3].midpoint()];
        let Some(candidate) = local.near(device.map(|side| side.midpoint()), left.periods, near) else {
            return;
        };
        if self.best().is_none_or(|best| candidate.rate > best) {
            let climbed = local.climb(candidate);
            if !self.take(&climbed) {
                self.take(&candidate);
            }
        }
    }

    /// Halves the boxes of the largest bounds.
    fn halve(&mut self) -> Result<(), R::Error> {
        let mut halves = Vec::new();
        while halves.len() < 2 * BATCH {
            let Some(left) = self.left.pop() else { break };
            halves.extend(left.halves());
        }
        self.examine(&halves)
    }

    /// Examines boxes, and keeps what is left of them: all of those that a stop leaves out.
    fn examine(&mut self, boxes: &[Start]) -> Result<(), R::Error> {
        let (best, token) = (self.best(), Token::current());
        for boxes in boxes.chunks(LARGEST_BATCH) {
            if token.is_stopped() {
                let whole = |(cell, periods, most): &Start| left(Outcome::Unbounded(*cell), *periods, *most);
                self.put(boxes.iter().filter_map(whole));
                continue;
            }
            let batch = SearchBatch { boxes, best };
            let outcomes = match self.record.known(&batch)? {
                Some(outcomes) => outcomes,
                None => {
                    let outcomes = self.outcomes(&batch);
                    self.record.keep(&batch, &outcomes)?;
                    outcomes
                }
            };
            self.boxes += boxes.len() as u64;
            self.put(outcomes.0.into_iter().flatten());
        }
        Ok(())
    }

    /// What becomes of boxes.
    fn outcomes(&self, batch: &SearchBatch<'_>) -> SearchOutcomes {
        let (formulas, best) = (self.formulas, batch.best);
        SearchOutcomes(each(batch.boxes, |(cell, periods, most)| {
            let at_least = best.map_or(f64::NEG_INFINITY, |best| (best * f64::from(*periods)).next_down());
            let outcome = formulas[*periods as usize - 1].examine(*cell, at_least);
            left(outcome, *periods, *most)
        }))
    }

    fn put(&mut self, found: impl Iterator<Item = Left>) {
        for left in found {
            let side = &left.cell[left.direction];
            let scale = side.magnitude().max(1.0);
            if width(side) > FINEST * scale {
                self.left.push(left);
            } else {
                self.fine.push(left);
            }
        }
    }

    /// Halves every box that is left, again and again, for as many boxes as the gap took: where the optimum may be is
    /// narrower then.
    fn narrow_place(&mut self, most_boxes: u64, local: &mut LocalSearch) -> Result<(), R::Error> {
        let end = (self.boxes + self.boxes.max(PLACE_BOXES)).min(most_boxes);
        while self.boxes < end && !self.left.is_empty() && stop::goes_on() {
            self.look(local);
            let left = std::mem::take(&mut self.left);
            let halves: Vec<Start> = left.into_iter().flat_map(|left| left.halves()).collect();
            self.examine(&halves)?;
        }
        Ok(())
    }

    fn optimum(mut self, gap: f64) -> Optimum {
        let is_complete = self.is_within(gap);
        let most = self.most();
        let left: Vec<Left> = self.left.drain().chain(self.fine.drain(..)).collect();
        let mut place = self.best.as_ref().map(|device| device.parameters);
        for left in &left {
            let Some(here) = self.formulas[left.periods as usize - 1].device(&left.cell) else {
                continue;
            };
            place = Some(place.map_or(here, |place| std::array::from_fn(|i| place[i].hull(&here[i]))));
        }
        let cells = left.iter().map(|left| (left.cell, left.periods));
        Optimum {
            attained: match self.best.is_some() && is_complete {
                true => is_attained(self.choice, self.formulas, cells),
                false => None,
            },
            active: self
                .best
                .as_ref()
                .map_or(Vec::new(), |device| active(self.choice, device)),
            sensitivities: self.best.as_ref().and_then(|device| sensitivities(self.choice, device)),
            device: self.best,
            most,
            place,
            is_complete,
            boxes: self.boxes,
        }
    }
}

/// What is left of a box, with its bound per forcing period and the side to halve.
fn left(outcome: Outcome, periods: u32, of_whole: f64) -> Option<Left> {
    let (cell, sum, direction) = match outcome {
        Outcome::Dropped => return None,
        Outcome::Unbounded(cell) => (cell, f64::INFINITY, widest(&cell)),
        Outcome::Examined(examined) => {
            let direction = direction(&examined);
            (examined.cell, examined.most, direction)
        }
    };
    let most = (Interval::point(sum.min(f64::MAX)) / Interval::point(f64::from(periods))).high();
    Some(Left {
        most: most.min(of_whole),
        periods,
        cell,
        direction,
    })
}

fn widest(cell: &Cell) -> usize {
    let longest = (0..UNKNOWNS).max_by(|&i, &j| width(&cell[i]).total_cmp(&width(&cell[j])));
    longest.unwrap_or(0)
}

/// The side over which the voltages and the constraints that may fail vary most.
fn direction(examined: &Examined) -> usize {
    let cell = &examined.cell;
    let mut variation = [0.0_f64; UNKNOWNS];
    let mut add = |form: &Form| {
        let smear: [f64; UNKNOWNS] = std::array::from_fn(|i| match width(&cell[i]) {
            0.0 => 0.0,
            width => form.slopes[i].magnitude() * width,
        });
        let most = smear.iter().copied().fold(0.0, f64::max);
        if most > 0.0 && most.is_finite() {
            for (total, part) in variation.iter_mut().zip(smear) {
                *total += part / most;
            }
        }
    };
    if let Some(form) = &examined.voltages {
        add(form);
    }
    let open = |(_, form): &&(Constraint, Form)| form.values.low() < 0.0;
    examined.constraints.iter().filter(open).for_each(|(_, form)| add(form));
    let most = variation.iter().copied().fold(0.0, f64::max);
    if most == 0.0 {
        return widest(cell);
    }
    let counts = |i: &usize| variation[*i] >= 0.5 * most && width(&cell[*i]) > 0.0;
    let longest = (0..UNKNOWNS).filter(counts);
    longest
        .max_by(|&i, &j| width(&cell[i]).total_cmp(&width(&cell[j])))
        .unwrap_or_else(|| widest(cell))
}
