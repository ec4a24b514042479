//! Points at which all premises and assumptions of a claim hold.

use super::course::{FEW_TIMES, TIMES};
use super::formula::Op;
use super::newton::{basis, lift, rough};
use super::space::Slot;
use super::system::System;
use super::tolerance::{LAWS_WIDE, PREMISE, PREMISE_REFINED, PREMISE_WIDE, VANISHING};
use super::value::{Numbers, Real, Value};
use num_traits::Zero;
use numbers::{Sequence, Wide};
use std::collections::BTreeMap;
use texmath::Relation;

/// Sets the sequences of neighbouring seeds far apart.
const SPREAD: u64 = 0xd134_2543_de82_ef95;
const START: u64 = 0x2545_f491_4f6c_dd1d;

/// Draws until one meets the conditions of the sheet by itself.
const DRAWS: usize = 40;

/// No quantity of a point is larger.
const LARGEST: f64 = 1e4;

/// By which part generic symbols are moved to see whether what is found is thin in them.
const NEARBY: f64 = 1e-5;

/// A point: a value for each slot, and a running time for claims that have one.
#[derive(Clone, Debug, PartialEq)]
pub struct Point<V> {
    pub values: Vec<V>,
    pub running: V,
}

/// From where a point is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Numbers about 1, all moved as little as possible until the premises hold.
    Moderate,
    /// Small integers and simple fractions, 0 among them; as few as possible are moved.
    Special,
    /// Numbers between 1/100 and 100; as few as possible are moved.
    Spread,
}

/// Why a start leads to no point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Miss {
    Premises,
    Conditions,
    Derivatives,
}

/// The numbers of [`Style::Special`].
const SPECIAL: [f64; 14] = [
    0.0,
    1.0,
    -1.0,
    2.0,
    -2.0,
    0.5,
    -0.5,
    3.0,
    -3.0,
    1.5,
    1.0 / 3.0,
    -2.0 / 3.0,
    0.0,
    1.0,
];

impl System {
    /// The point that a random start leads to, if it does.
    pub fn point<N: Numbers>(&self, seed: u64, style: Style) -> Result<Point<N::Of<f64>>, Miss> {
        self.point_at::<N>(seed, style, &BTreeMap::new())
    }

    /// The point that a start leads to with these values in their slots, and random ones in the others.
    pub fn point_at<N: Numbers>(
        &self,
        seed: u64,
        style: Style,
        values: &BTreeMap<usize, f64>,
    ) -> Result<Point<N::Of<f64>>, Miss> {
        let mut random = Sequence::new(seed.wrapping_mul(SPREAD).wrapping_add(START));
        let mut start = || {
            let mut start = self.start::<N>(&mut random, style);
            for (slot, value) in values {
                if let Some(place) = start.values.get_mut(*slot) {
                    *place = N::Of::<f64>::float(*value);
                }
            }
            start
        };
        let mut point = start();
        for _ in 0..DRAWS {
            if self.allows::<N>(&point) {
                break;
            }
            point = start();
        }
        let is_allowed = self.allows::<N>(&point);
        if self.rows.is_empty() && (is_allowed || self.slacks.is_empty()) {
            return if is_allowed {
                self.derived::<N>(point)
            } else {
                Err(Miss::Conditions)
            };
        }
        let mut moved = point.clone();
        let mut missed = self.settle::<N>(&mut moved, style, &mut random, false);
        if missed.is_ok() && !self.allows::<N>(&moved) {
            missed = Err(Miss::Conditions);
        }
        if missed == Err(Miss::Conditions) && !self.slacks.is_empty() {
            moved = point;
            missed = self.settle::<N>(&mut moved, style, &mut random, true);
            if missed.is_ok() && !self.allows::<N>(&moved) {
                missed = Err(Miss::Conditions);
            }
        }
        missed?;
        self.derived::<N>(moved)
    }

    fn derived<N: Numbers>(&self, mut point: Point<N::Of<f64>>) -> Result<Point<N::Of<f64>>, Miss> {
        match self.derive::<N, f64>(&mut point.values, PREMISE) {
            // what is solved with the derivatives must be allowed as well
            Some(rest) if rest <= PREMISE && !self.meets_laws::<N, f64>(&point, VANISHING) => Err(Miss::Premises),
            Some(rest) if rest <= PREMISE && self.allows::<N>(&point) => Ok(point),
            Some(rest) if rest <= PREMISE => Err(Miss::Conditions),
            _ => Err(Miss::Derivatives),
        }
    }

    /// Moves a start until the premises hold, and the conditions with what their slacks leave over where asked.
    fn settle<N: Numbers>(
        &self,
        point: &mut Point<N::Of<f64>>,
        style: Style,
        random: &mut Sequence,
        with_slacks: bool,
    ) -> Result<(), Miss> {
        let joined;
        let (program, slots) = if with_slacks {
            let rows: Vec<_> = self.rows.iter().chain(&self.slacks).copied().collect();
            joined = self.formulas.program(&rows);
            (&joined, self.formulas.slots(&rows))
        } else {
            (&self.rows_program, self.row_slots.clone())
        };
        let mut unknowns = self.unknowns(slots);
        if style != Style::Moderate {
            let jacobian = self.jacobian::<N>(program, &point.values, &unknowns);
            let weights: Vec<f64> = unknowns
                .iter()
                .map(|_| 10_f64.powf(random.between(-2.0, 2.0)))
                .collect();
            let columns = basis(jacobian, &weights);
            unknowns = columns
                .into_iter()
                .filter_map(|column| unknowns.get(column).copied())
                .collect();
        }
        // Not less or equal: NaN fails too.
        let meets = |rest: f64| rest <= PREMISE;
        if meets(self.solve::<N, f64>(program, &mut point.values, &unknowns, PREMISE))
            && point.values.iter().all(|value| value.size() < LARGEST)
        {
            return Ok(());
        }
        Err(Miss::Premises)
    }

    /// Returns true if laws that are held at a few times hold where the claim is looked at.
    fn meets_laws<N: Numbers, T: Real>(&self, point: &Point<N::Of<T>>, enough: f64) -> bool {
        let program = &self.tested_program;
        if program.outputs.is_empty() {
            return true;
        }
        let found = program.run(&self.inputs(&point.values, Some(&point.running)));
        let near: Vec<N::Of<f64>> = found.iter().map(rough::<N, T>).collect();
        let Some(sizes) = program.sizes(&near, &self.solved::<N, T>(&point.values)) else {
            return false;
        };
        program
            .outputs
            .iter()
            .all(|&output| match (near.get(output), sizes.get(output)) {
                (Some(value), Some(size)) => value.size() <= enough * size,
                _ => false,
            })
    }

    /// Whether the conditions hold in 40 digits too: what f64 has rounded away does not allow a point.
    pub fn allows_closely<N: Numbers>(&self, point: &Point<N::Of<Wide<40>>>) -> bool {
        let program = &self.conditions_program;
        let values = program.run(&self.inputs(&point.values, Some(&point.running)));
        let mut found = program.outputs(&values).into_iter().zip(&self.conditions);
        found.all(|(value, condition)| {
            let re = &value.parts()[0];
            let (is_above, is_below) = (*re > Wide::zero(), *re < Wide::zero());
            match condition.relation {
                Relation::LessOrEqual => !is_above,
                Relation::GreaterOrEqual => !is_below,
                _ => true,
            }
        })
    }

    /// Whether a condition that is more than the sign of a symbol holds with nothing to spare: such points are a thin part of
    /// what it allows, or all of it.
    pub fn is_at_an_end<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> bool {
        let program = &self.conditions_program;
        let values = program.run(&self.inputs(&point.values, Some(&point.running)));
        let mut found = program.outputs(&values).into_iter().zip(&self.conditions);
        found.any(|(value, condition)| {
            let is_compound = !matches!(self.formulas.op(condition.formula), Op::Slot(_));
            let is_open = matches!(condition.relation, Relation::LessOrEqual | Relation::GreaterOrEqual);
            is_compound && is_open && value.size() < VANISHING
        })
    }

    /// Whether the conditions hold.
    fn allows<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> bool {
        let program = &self.conditions_program;
        let values = program.run(&self.inputs(&point.values, Some(&point.running)));
        let mut found = program.outputs(&values).into_iter().zip(&self.conditions);
        found.all(|(value, condition)| {
            let [re, im] = value.parts();
            match condition.relation {
                Relation::NotEqual => condition.holds(value.size()),
                _ => im == 0.0 && condition.holds(re),
            }
        })
    }

    /// Whether a factor in generic symbols alone vanishes: a proof may exclude such a point.
    pub fn is_excluded<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> bool {
        let program = &self.factors_program;
        let values = program.run(&self.inputs(&point.values, Some(&point.running)));
        let Some(sizes) = program.sizes(&values, &self.solved::<N, f64>(&point.values)) else {
            return true;
        };
        let vanishes = |&output: &usize| {
            let (value, size) = (
                values.get(output).map_or(0.0, Value::size),
                sizes.get(output).copied().unwrap_or(0.0),
            );
            value <= VANISHING * size || value == 0.0
        };
        program.outputs.iter().any(vanishes)
    }

    /// A point with generic symbols a little different; itself nothing where there are none of these, and no answer where
    /// the premises do not hold nearby.
    pub fn nearby<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> Option<Option<Point<N::Of<f64>>>> {
        let generic = |slot: &usize| self.kinds.get(*slot).is_some_and(|kind| kind.generic);
        if !(0..point.values.len()).any(|slot| generic(&slot)) {
            return Some(None);
        }
        let mut near = point.clone();
        for (slot, value) in near.values.iter_mut().enumerate().filter(|(slot, _)| generic(slot)) {
            let part = NEARBY * (1.0 + 0.1 * slot as f64);
            *value = value.clone() * N::Of::<f64>::float(1.0 - part) - N::Of::<f64>::float(part * part);
        }
        let unknowns = self.unknowns(self.row_slots.iter().copied().filter(|slot| !generic(slot)));
        let rest = self.solve::<N, f64>(&self.rows_program, &mut near.values, &unknowns, PREMISE);
        let near = (rest <= PREMISE).then(|| self.derived::<N>(near))?;
        near.ok().map(Some)
    }

    /// The point over 40 digits, where all premises hold to them.
    pub fn widened<N: Numbers>(&self, point: &Point<N::Of<f64>>) -> Option<Point<N::Of<Wide<40>>>> {
        let values = point.values.iter().map(lift::<N, Wide<40>>).collect();
        let wide = Point {
            values,
            running: lift::<N, Wide<40>>(&point.running),
        };
        self.met::<N>(wide, PREMISE_WIDE)
    }

    /// The point after further steps: beside a double root it moves on and on.
    pub fn refined<N: Numbers>(&self, wide: Point<N::Of<Wide<40>>>) -> Option<Point<N::Of<Wide<40>>>> {
        self.met::<N>(wide, PREMISE_REFINED)
    }

    fn met<N: Numbers>(&self, mut wide: Point<N::Of<Wide<40>>>, residual: f64) -> Option<Point<N::Of<Wide<40>>>> {
        let unknowns = self.unknowns(self.row_slots.iter().copied());
        let met = self.solve::<N, Wide<40>>(&self.rows_program, &mut wide.values, &unknowns, residual);
        let derived = met <= residual && self.derive::<N, Wide<40>>(&mut wide.values, PREMISE_WIDE)? <= PREMISE_WIDE;
        (derived && self.meets_laws::<N, Wide<40>>(&wide, LAWS_WIDE)).then_some(wide)
    }

    fn start<N: Numbers>(&self, random: &mut Sequence, style: Style) -> Point<N::Of<f64>> {
        // times may be negative, but where a motion starts
        let mut clock = match style {
            Style::Moderate => random.between(0.0, 0.5),
            _ => random.between(-3.0, 0.5),
        };
        let mut values = vec![N::Of::<f64>::integer(0); self.space.slots.len()];
        // Impacts one after the other, towards one wall and the other in turn.
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by_key(|slot| (self.space.impact(*slot), *slot));
        for slot in order {
            let value = self.draw(slot, &mut clock, random, style);
            let imaginary = match self.kinds.get(slot) {
                Some(kind) if kind.complex => match style {
                    Style::Special => pick(random),
                    _ => random.between(-1.5, 1.5),
                },
                _ => 0.0,
            };
            if let Some(place) = values.get_mut(slot) {
                *place = N::Of::<f64>::new(value, imaginary);
            }
        }
        // where premises shape functions, constants are what meets them soonest
        if self.shaped && random.draw() & 1 == 0 {
            for (slot, value) in self.space.slots.iter().zip(&mut values) {
                if let Slot::Coefficient { course, term } = slot
                    && self
                        .space
                        .courses
                        .get(*course)
                        .is_some_and(|course| *term >= course.names.len())
                {
                    *value = N::Of::<f64>::integer(0);
                }
            }
        }
        let running = match self.start.and_then(|slot| values.get(slot)) {
            Some(start) => start.parts()[0] + random.between(0.1, 1.0),
            // laws that give no function hold at the times of their rows
            None if !self.tested_program.outputs.is_empty() => {
                let number = (random.draw() >> 33) as usize % FEW_TIMES;
                TIMES.get(number).copied().unwrap_or(1.0)
            }
            None if style == Style::Special => pick(random),
            None => random.between(-2.0, 3.0),
        };
        Point {
            values,
            running: N::Of::<f64>::float(running),
        }
    }

    fn draw(&self, slot: usize, clock: &mut f64, random: &mut Sequence, style: Style) -> f64 {
        let kind = self.kinds.get(slot).copied().unwrap_or_default();
        let moderate = style == Style::Moderate;
        let value = match self.space.slots.get(slot) {
            Some(Slot::Time { .. }) => {
                *clock += random.between(0.6, 1.4);
                return *clock;
            }
            Some(Slot::Slack(_)) => return random.between(0.2, 1.5),
            _ if kind.index => return f64::from(super::index::INDEX),
            _ if kind.integer && moderate => random.between(-3.5, 6.5).round(),
            _ if kind.integer => random.between(-8.5, 9.5).round(),
            Some(Slot::Coefficient { .. }) => return random.between(-1.0, 1.0),
            Some(Slot::State { index, .. }) if moderate => {
                let size = random.between(0.3, 1.5);
                if index % 2 == 0 { size } else { -size }
            }
            _ if kind.at_most_one && style != Style::Special => random.between(0.1, 0.95),
            _ if moderate && kind.positive => random.between(0.4, 2.2),
            _ if moderate => random.between(-1.5, 1.5),
            _ if style == Style::Special => pick(random),
            _ => {
                let size = 10_f64.powf(random.between(-2.0, 2.0));
                if random.draw() & 1 == 0 { size } else { -size }
            }
        };
        let value = if kind.positive || kind.nonnegative {
            value.abs()
        } else {
            value
        };
        let value = if (kind.positive || kind.nonzero) && value == 0.0 {
            1.0
        } else {
            value
        };
        if kind.at_most_one { value.min(1.0) } else { value }
    }
}

/// A special number.
fn pick(random: &mut Sequence) -> f64 {
    let position = (random.draw() >> 33) as usize % SPECIAL.len();
    SPECIAL.get(position).copied().unwrap_or(1.0)
}
