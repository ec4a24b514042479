//! What holds of every device and motion in a box, and what it is worth at most.

use crate::model::Side;
use crate::orbit::equations::flight::LaunchedFlight;
use crate::orbit::interval_box::{IntervalBox, width};
use crate::orbit::optimum::design::{Choice, Devices};
use crate::orbit::optimum::explicit::{ExplicitOneOne, Restitutions};
use numbers::{Analytic, Dual, Field, Interval, seeded};

/// The unknowns: the two parameters of the capsule, T_1, the phase halfway through the flight from bottom to top.
pub const UNKNOWNS: usize = 4;

/// A box of devices and motions.
pub type Cell = IntervalBox<f64, UNKNOWNS>;

/// A quantity over a cell: all its values, those at the midpoint, and its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    /// All values.
    pub values: Interval,
    /// At the midpoint of the cell.
    pub middle: Interval,
    /// By each unknown, over the cell.
    pub slopes: [Interval; UNKNOWNS],
}

/// What is asked of every motion: that a form is not below 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint {
    /// A speed of arrival, of the bottom impact, then of the top one.
    Arrival(usize),
    /// r_B, then r_T, is not below its least value.
    Least(usize),
    /// r_B, then r_T, is not above its largest value.
    Largest(usize),
    /// Tr <= 1 + Det - margin.
    Fold,
    /// -Tr <= 1 + Det - margin.
    PeriodDoubling,
    /// As [`Constraint::Fold`], of the restitutions that motions of the cell have at all.
    FoldOfKnown,
    /// As [`Constraint::PeriodDoubling`], of these.
    PeriodDoublingOfKnown,
    /// The flight from the bottom, then from the top, keeps off the walls.
    Clearance(usize),
}

/// A cell over which every form has a value.
#[derive(Clone, Debug)]
pub struct Examined {
    /// What is left of the cell.
    pub cell: Cell,
    /// The sum of both voltages is at most this.
    pub most: f64,
    /// The sum of both voltages; none where a speed may be 0.
    pub voltages: Option<Form>,
    /// What is asked.
    pub constraints: Vec<(Constraint, Form)>,
}

/// What became of a cell.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// No motion in it is as asked, or none is better than the best known.
    Dropped,
    /// A flight time may be 0: there are no values.
    Unbounded(Cell),
    /// What is left.
    Examined(Box<Examined>),
}

/// The formulas over intervals, for motions of one number of periods.
pub struct Formulas<'a> {
    choice: &'a Choice,
    plain: Devices<Interval>,
    dual: Devices<Dual<Interval>>,
    total: Interval,
    ranges: [[Interval; 2]; 2],
}

/// A cell is narrowed again while that makes one of its sides shorter than this part of it, ...
const WORTHWHILE: f64 = 0.7;

/// ... at most so many times.
const MOST_NARROWINGS: usize = 4;

/// The distance from a turning point beyond which the velocity has a sign is estimated; taken is so many times that.
const FARTHER: f64 = 1.2;

/// Halvings of the time between two looks.
const HALVINGS: usize = 30;

/// Times of a flight at which turning points are looked for, for each forcing period.
const LOOKS: u32 = 24;

impl<'a> Formulas<'a> {
    /// For motions over so many forcing periods.
    pub fn new(choice: &'a Choice, periods: u32) -> Self {
        let [_, _, r_b, r_t] = choice.ranges;
        Self {
            choice,
            plain: choice.devices.clone(),
            dual: choice.devices.convert(|value| Dual::from_re(*value)),
            total: Interval::from_integer(2 * i64::from(periods)),
            ranges: [r_b, r_t].map(|range| [range.low, range.high]),
        }
    }

    /// Every device and every motion.
    pub fn everything(&self) -> Cell {
        let [first, second, ..] = self.choice.ranges;
        let turn = std::f64::consts::PI.next_up();
        let flight = Interval::new(0.0, self.total.high());
        [first.hull(), second.hull(), flight, Interval::new(-turn, turn)]
    }

    /// The parameters of every device whose motion is in a cell: those of the capsule, r_B, r_T. `None` where no restitution
    /// is in its range.
    pub fn device(&self, cell: &Cell) -> Option<[Interval; 4]> {
        let [r_b, r_t] = self.restitutions(&self.explicit(cell))?;
        Some([cell[0], cell[1], r_b, r_t])
    }

    /// The restitutions that are in their ranges.
    fn restitutions(&self, explicit: &ExplicitOneOne<Interval>) -> Option<[Interval; 2]> {
        let [t_1, t_2] = explicit.times;
        let [launch_b, launch_t] = explicit.scaled_launches;
        let [arrival_b, arrival_t] = explicit.scaled_arrivals;
        let quotients = [launch_b * t_2 / (arrival_b * t_1), launch_t * t_1 / (arrival_t * t_2)];
        let within = |wall: usize| quotients[wall].intersection(&self.choice.ranges[2 + wall].hull());
        Some([within(0)?, within(1)?])
    }

    /// d and g of the devices of a cell.
    pub fn capsule(&self, cell: &Cell) -> [Interval; 2] {
        self.plain.capsule([&cell[0], &cell[1]])
    }

    /// The motions of a cell.
    pub fn explicit(&self, [first, second, t_1, middle]: &Cell) -> ExplicitOneOne<Interval> {
        let [d, g] = self.plain.capsule([first, second]);
        ExplicitOneOne::new([&d, &g], &self.total, t_1, middle)
    }

    /// Narrows a cell to where motions as asked may be that are worth more than `best`, and bounds what they are worth.
    pub fn examine(&self, cell: Cell, best: f64) -> Outcome {
        let mut cell = cell;
        let mut most = f64::INFINITY;
        for round in 0.. {
            let Some(mut examined) = self.evaluated(&cell) else {
                return self.unbounded(cell);
            };
            most = most.min(examined.most);
            examined.most = most;
            if most <= best {
                return Outcome::Dropped;
            }
            let at_least = examined.voltages.map(|form| form.above(best));
            let forms = examined.constraints.iter().map(|(_, form)| *form).chain(at_least);
            let before = cell;
            for form in forms {
                if form.values.is_negative() || !form.narrow(&mut cell, &before) {
                    return Outcome::Dropped;
                }
            }
            let shrinks = (0..UNKNOWNS).any(|i| width(&cell[i]) < WORTHWHILE * width(&before[i]));
            if !shrinks || round + 1 == MOST_NARROWINGS {
                examined.cell = cell;
                return Outcome::Examined(Box::new(examined));
            }
        }
        Outcome::Unbounded(cell)
    }

    /// A cell in which a flight may take no time: the restitutions alone may exclude it.
    fn unbounded(&self, cell: Cell) -> Outcome {
        let explicit = self.explicit(&cell);
        let is_out = |form: &Interval| form.is_negative();
        if explicit.within(&self.ranges).iter().any(is_out) || explicit.scaled_arrivals.iter().any(is_out) {
            return Outcome::Dropped;
        }
        Outcome::Unbounded(cell)
    }

    /// The forms over a cell; `None` where a flight time may be 0.
    pub fn evaluated(&self, cell: &Cell) -> Option<Examined> {
        let explicit = self.explicit(cell);
        if !explicit.times.iter().all(Interval::is_positive) {
            return None;
        }
        // where none is in its range, whatever is taken for it: that range excludes the cell
        let known = self.restitutions(&explicit);
        let known = known.unwrap_or_else(|| [2, 3].map(|i| self.choice.ranges[i].hull()));
        let at = cell.map(|side| Interval::point(side.midpoint()));
        let central = self.explicit(&at);
        let free: Vec<usize> = (0..UNKNOWNS).filter(|&i| width(&cell[i]) > 0.0).collect();
        let varied: Vec<(usize, ExplicitOneOne<Dual<Interval>>, Dual<Interval>)> = free
            .iter()
            .map(|&column| {
                let [first, second, t_1, middle] = seeds(cell, column);
                let [d, g] = self.dual.capsule([&first, &second]);
                let total = Dual::from_re(self.total);
                let explicit = ExplicitOneOne::new([&d, &g], &total, &t_1, &middle);
                (column, explicit, self.dual.unit(&first))
            })
            .collect();
        let constants = Constants {
            ranges: self.ranges,
            margin: self.choice.margin,
            known: Restitutions::new(known, self.choice.margin),
        };
        let dual_constants = Constants {
            ranges: constants.ranges.map(|range| range.map(Dual::from_re)),
            margin: Dual::from_re(constants.margin),
            known: constants.known.convert(|value| Dual::from_re(*value)),
        };
        let (values, middles) = (constants.forms(&explicit), constants.forms(&central));
        let mut slopes = [[Interval::from_integer(0); UNKNOWNS]; FORMS];
        for (column, explicit, _) in &varied {
            for (row, value) in dual_constants.forms(explicit).iter().enumerate() {
                slopes[row][*column] = value.eps;
            }
        }
        let form = |row: usize| Form {
            values: values[row],
            middle: middles[row],
            slopes: slopes[row],
        };
        let mut constraints: Vec<(Constraint, Form)> = CONSTRAINTS
            .into_iter()
            .enumerate()
            .map(|(row, what)| (what, form(row)))
            .collect();
        constraints.extend(self.clearances(cell, &central));

        let speeds = explicit.arrivals();
        let unit = self.plain.unit(&cell[0]);
        let fastest = [0, 1].map(|i| Interval::point((speeds[i] * unit).high()));
        // a voltage grows with the speed: of the fastest impacts it is the largest
        let voltage = |speed: &Interval| self.plain.membrane.voltage(speed);
        let mut most = match fastest.iter().all(Interval::is_finite) {
            true => (voltage(&fastest[0]) + voltage(&fastest[1])).high(),
            false => f64::INFINITY,
        };
        let scaled = speeds.map(|speed| speed * unit);
        let mut voltages = None;
        if scaled.iter().all(|speed| speed.is_positive() && speed.is_finite()) {
            let gains = scaled.map(|speed| self.dual.membrane.voltage(&seeded(speed)));
            let central_unit = self.plain.unit(&at[0]);
            let central = central.arrivals().map(|speed| voltage(&(speed * central_unit)));
            let mut form = Form {
                values: gains[0].re + gains[1].re,
                middle: central[0] + central[1],
                slopes: [Interval::from_integer(0); UNKNOWNS],
            };
            for (column, explicit, unit) in &varied {
                let speeds = explicit.arrivals().map(|speed| speed * *unit);
                form.slopes[*column] = gains[0].eps * speeds[0].eps + gains[1].eps * speeds[1].eps;
            }
            most = most.min(form.linear(cell).high());
            voltages = Some(form);
        }
        Some(Examined {
            cell: *cell,
            most,
            voltages,
            constraints,
        })
    }

    /// Where the motion at the middle of a cell turns nearest to a wall, what every motion as asked has there: a
    /// distance from the wall.
    ///
    /// A ball that is beyond a wall has turned, or will, farther beyond it. One that flies back towards the wall that it came
    /// from has turned before, nearer to the other wall, and will turn again, nearer to the first one: where it flies
    /// so throughout the cell, its distance from both is at least the clearance.
    fn clearances(&self, cell: &Cell, central: &ExplicitOneOne<Interval>) -> Vec<(Constraint, Form)> {
        let at = cell.map(|side| side.midpoint());
        let [d, g] = self.plain.capsule([&Interval::point(at[0]), &Interval::point(at[1])]);
        let (launches, asked) = (central.launches(), &self.choice.clearance);
        let mut found = Vec::new();
        for (index, side) in [Side::Bottom, Side::Top].into_iter().enumerate() {
            let [phase, launch, time] =
                [central.phases[index], launches[index], central.times[index]].map(|value| value.midpoint());
            let launch = -side.sign() * launch;
            let flight = LaunchedFlight::new(side, phase, launch, g.midpoint(), d.midpoint());
            let Some(turn) = nearest_turn(&flight, time, self.total.high()) else {
                continue;
            };
            let reach: f64 = cell.iter().map(width).sum();
            if turn.distance > asked.high() + 2.0 * reach {
                continue;
            }
            found.extend(self.distance(cell, index, turn));
        }
        found
    }

    /// The distance from a wall less the clearance asked for, at a part of the flight time.
    fn distance(&self, cell: &Cell, index: usize, turn: Turn) -> Option<(Constraint, Form)> {
        let flight_at = |cell: &Cell, part: f64| {
            let explicit = self.explicit(cell);
            let [d, g] = self.plain.capsule([&cell[0], &cell[1]]);
            let time = explicit.times[index] * Interval::point(part);
            (flight(&explicit, index, d, g), time)
        };
        let (asked, wall) = (self.choice.clearance, turn.wall);
        let mut part = turn.part;
        let (mut over_cell, mut time) = flight_at(cell, part);
        if asked.high() > 0.0 {
            // so far from the turning point that the ball flies back in all of the cell
            let reach = width(&over_cell.velocity(&time)) / over_cell.acceleration(&time).midpoint().abs();
            part += turn.back * FARTHER * reach / time.midpoint();
            if !(part > 0.0 && part < 1.0) {
                return None;
            }
            (over_cell, time) = flight_at(cell, part);
            if !over_cell.side.signed(over_cell.velocity(&time)).is_positive() {
                return None;
            }
        }
        let (at_middle, middle_time) = flight_at(&cell.map(|side| Interval::point(side.midpoint())), part);
        let mut form = Form {
            values: over_cell.distance(wall, &time) - asked,
            middle: at_middle.distance(wall, &middle_time) - asked,
            slopes: [Interval::from_integer(0); UNKNOWNS],
        };
        for column in (0..UNKNOWNS).filter(|&i| width(&cell[i]) > 0.0) {
            let [first, second, t_1, middle] = seeds(cell, column);
            let [d, g] = self.dual.capsule([&first, &second]);
            let explicit = ExplicitOneOne::new([&d, &g], &Dual::from_re(self.total), &t_1, &middle);
            let time = explicit.times[index] * Dual::from_re(Interval::point(part));
            form.slopes[column] = flight(&explicit, index, d, g).distance(wall, &time).eps;
        }
        Some((Constraint::Clearance(index), form))
    }
}

/// The forms beside the clearances.
const FORMS: usize = 10;

const CONSTRAINTS: [Constraint; FORMS] = [
    Constraint::Arrival(0),
    Constraint::Arrival(1),
    Constraint::Least(0),
    Constraint::Largest(0),
    Constraint::Least(1),
    Constraint::Largest(1),
    Constraint::Fold,
    Constraint::PeriodDoubling,
    Constraint::FoldOfKnown,
    Constraint::PeriodDoublingOfKnown,
];

/// What the forms take as constants.
struct Constants<T> {
    ranges: [[T; 2]; 2],
    margin: T,
    known: Restitutions<T>,
}

impl<T: Analytic> Constants<T> {
    fn forms(&self, explicit: &ExplicitOneOne<T>) -> [T; FORMS] {
        let [bottom, top] = explicit.scaled_arrivals.clone();
        let [least_b, largest_b, least_t, largest_t] = explicit.within(&self.ranges);
        let [fold, doubling] = explicit.stability(&self.margin);
        let [fold_of_known, doubling_of_known] = explicit.stability_of(&self.known);
        [
            bottom,
            top,
            least_b,
            largest_b,
            least_t,
            largest_t,
            fold,
            doubling,
            fold_of_known,
            doubling_of_known,
        ]
    }
}

fn seeds(cell: &Cell, column: usize) -> [Dual<Interval>; UNKNOWNS] {
    std::array::from_fn(|i| match i == column {
        true => seeded(cell[i]),
        false => Dual::from_re(cell[i]),
    })
}

/// The flight from the bottom, 0, or from the top, 1.
pub fn flight<T: Analytic>(explicit: &ExplicitOneOne<T>, index: usize, d: T, g: T) -> LaunchedFlight<T> {
    let side = [Side::Bottom, Side::Top][index];
    let launch = -side.signed(explicit.launches()[index].clone());
    LaunchedFlight::new(side, explicit.phases[index].clone(), launch, g, d)
}

/// Where a flight turns.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// The part of the flight time.
    part: f64,
    /// The wall that is meant.
    wall: Side,
    /// How far from it.
    distance: f64,
    /// -1 where the ball flies back to the wall that it came from before the turning point, 1 where it does so after it.
    back: f64,
}

/// The turning point of a flight that is nearest to a wall, or farthest beyond it; `None` where none is seen.
fn nearest_turn(flight: &LaunchedFlight<f64>, time: f64, total: f64) -> Option<Turn> {
    let looks = (f64::from(LOOKS) * total / 2.0) as u32;
    let at = |index: u32| time * f64::from(index) / f64::from(looks);
    let mut nearest: Option<Turn> = None;
    let mut before = flight.launch;
    for index in 1..=looks {
        let velocity = flight.velocity(&at(index));
        if velocity * before < 0.0 {
            let (mut low, mut high) = (at(index - 1), at(index));
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if flight.velocity(&middle) * before > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let back = if flight.side.sign() * before > 0.0 { -1.0 } else { 1.0 };
            for wall in [Side::Bottom, Side::Top] {
                let distance = flight.distance(wall, &low);
                if nearest.is_none_or(|nearest| distance < nearest.distance) {
                    let part = low / time;
                    nearest = Some(Turn {
                        part,
                        wall,
                        distance,
                        back,
                    });
                }
            }
        }
        before = velocity;
    }
    nearest
}

impl Form {
    /// The same less a number.
    fn above(&self, least: f64) -> Self {
        let least = Interval::point(least);
        Self {
            values: self.values - least,
            middle: self.middle - least,
            slopes: self.slopes,
        }
    }

    /// All values over the cell by the mean value theorem.
    pub fn linear(&self, cell: &Cell) -> Interval {
        let parts = self.slopes.iter().zip(cell);
        parts.fold(self.middle, |sum, (slope, side)| sum + *slope * from_middle(side))
    }

    /// Leaves off `cell`, a part of the box `of` that the form is of, where the form is below 0. False where that is
    /// everywhere.
    fn narrow(&self, cell: &mut Cell, of: &Cell) -> bool {
        let middles = of.map(|side| Interval::point(side.midpoint()));
        let part = |cell: &Cell, i: usize| self.slopes[i] * (cell[i] - middles[i]);
        for i in 0..UNKNOWNS {
            let others = (0..UNKNOWNS).filter(|&j| j != i);
            let rest = others.fold(self.middle, |sum, j| sum + part(cell, j)).high();
            if (Interval::point(rest) + part(cell, i)).is_negative() && rest.is_finite() {
                return false;
            }
            let slope = self.slopes[i];
            if slope.contains_zero() || !rest.is_finite() || width(&of[i]) == 0.0 {
                continue;
            }
            // slope t >= -rest
            let bound = Interval::point(-rest) / slope + middles[i];
            let kept = match slope.is_positive() {
                true => Interval::new(bound.low(), f64::MAX),
                false => Interval::new(f64::MIN, bound.high()),
            };
            match kept.intersection(&cell[i]) {
                Some(kept) => cell[i] = kept,
                None => return false,
            }
        }
        true
    }
}

fn from_middle(side: &Interval) -> Interval {
    *side - Interval::point(side.midpoint())
}
