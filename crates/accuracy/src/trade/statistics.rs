//! The task `statistics`: mean voltage, voltage per forcing period and largest Lyapunov exponent, against the impacts that
//! they are taken over.
//!
//! On motion that repeats they come to what the orbit has, to what the number holds. On chaotic motion the error is that of
//! sampling, and falls as one over the root of the impacts: no wider number buys a digit there.

use super::contest::{Exact, Means, OF_THE_MACHINE, Task, judged, worst_relative_error};
use super::orbit::motions;
use super::voltage::membrane;
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use dynamics::impact::{Batch, Event, Kind, Simulation, Start, Widening};
use dynamics::model::{Motion, Side};
use dynamics::orbit::{Attractor, SteadyState, largest_multiplier};
use numbers::{Analytic, Digits, Machine, Rung, at_digits};

/// The starts of each device: as many as go side by side in lanes.
const STARTS: usize = 32;

/// Devices of each region: one for so many of the points asked for, since each is followed for thousands of impacts.
const FEWER: usize = 80;

/// Motions drawn before a region is taken to have no more devices.
const DRAWN: usize = 400;

/// The impacts from each start. The first half of them is not looked at, so that the start is forgotten.
const IMPACTS: [u32; 4] = [50, 200, 1000, 4000];

/// So many from each start are too many in the wider numbers: they would show what fewer do, for minutes.
const WIDE_IMPACTS: u32 = 200;

/// From each start, for the means of chaotic motion that others are held against.
const REFERENCE: u32 = 100_000;

/// Impacts until a motion has settled.
const SETTLED: u32 = 3000;

/// How far the starts of a device are from each other, relatively: chaos tells them apart, and what repeats does not.
const APART: f64 = 1e-4;

/// A motion of a larger exponent is chaotic.
const CHAOTIC: f64 = 0.02;

/// Digits that are right: within 10%.
const RIGHT: f64 = 1.0;

/// What a motion comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Region {
    Periodic,
    Resting,
    Chaotic,
}

impl Region {
    const ALL: [Self; 3] = [Self::Periodic, Self::Resting, Self::Chaotic];

    fn name(self) -> &'static str {
        match self {
            Self::Periodic => "periodic",
            Self::Resting => "resting",
            Self::Chaotic => "chaotic",
        }
    }
}

/// What is asked of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    MeanVoltage,
    VoltageRate,
    Lyapunov,
}

impl Quantity {
    const ALL: [Self; 3] = [Self::MeanVoltage, Self::VoltageRate, Self::Lyapunov];

    fn name(self) -> &'static str {
        match self {
            Self::MeanVoltage => "mean_voltage",
            Self::VoltageRate => "voltage_rate",
            Self::Lyapunov => "lyapunov",
        }
    }
}

/// A device, and where motions start.
struct Device {
    motion: Motion<f64>,
    starts: Vec<Start<f64>>,
    /// What the motion has come to; none where it is chaotic.
    attractor: Option<Attractor>,
}

impl Device {
    /// As tables have it.
    fn place(&self) -> String {
        let [g, d] = [self.motion.g(), self.motion.d()];
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| self.motion.restitution(side));
        let start = self.starts.first();
        let [phase, velocity] = start.map_or([f64::NAN; 2], |start| [start.phase, start.velocity]);
        format!("g={g};d={d};r_B={r_b};r_T={r_t};phase={phase};velocity={velocity};starts={STARTS}")
    }
}

/// Devices whose motions come to what `region` says, from all their starts.
fn devices(region: Region, options: &TradeOptions) -> Vec<Device> {
    let found = motions(options, DRAWN)
        .into_iter()
        .filter_map(|motion| device(region, motion));
    found.take(options.points.div_ceil(FEWER)).collect()
}

fn device(region: Region, motion: Motion<f64>) -> Option<Device> {
    let (side, phase, velocity) = (Side::Bottom, 1.0, 0.5);
    let first = Start::impact(side, phase, velocity);
    let settled = SteadyState::after(Widening::new(&motion, &first).without_growth(), SETTLED, 1);
    let found = match &settled.attractor {
        None => Region::Chaotic,
        // at rest for ever there is no voltage
        Some(attractor) if attractor.periods.is_none() || attractor.resting.is_some() => return None,
        Some(attractor) if attractor.rests() => Region::Resting,
        Some(_) => Region::Periodic,
    };
    let last = settled.kept.last().filter(|_| found == region)?;
    // what f32 holds exactly, so that all numbers are asked about the same
    let narrow = |value: f64| f64::from(value as f32);
    let start = |index: usize| {
        Start::impact(
            last.side,
            narrow(last.phase * (1.0 + APART * index as f64 / STARTS as f64)),
            narrow(last.velocity),
        )
    };
    let device = Device {
        starts: (0..STARTS).map(start).collect(),
        attractor: settled.attractor,
        motion,
    };
    let is_one = match &device.attractor {
        None => mean(&device.motion, &device.starts, Quantity::Lyapunov, SETTLED).is_ok_and(|found| found > CHAOTIC),
        Some(attractor) => device.starts.iter().all(|start| {
            let motion = Widening::new(&device.motion, start).without_growth();
            let again = SteadyState::after(motion, SETTLED, 1).attractor;
            again.is_some_and(|again| again.word == attractor.word && again.periods == attractor.periods)
        }),
    };
    is_one.then_some(device)
}

/// Sums over the second half of the impacts of a motion.
struct Sums<T> {
    /// The impacts so far, those that are passed over, and all that are wanted.
    impacts: u32,
    passed: u32,
    wanted: u32,
    /// The impact that sums begin after, and the latest.
    first: Option<Event<T>>,
    last: Option<Event<T>>,
    voltage: f64,
}

impl<T: Analytic> Sums<T> {
    fn new(wanted: u32) -> Self {
        Self {
            impacts: 0,
            passed: wanted / 2,
            wanted,
            first: None,
            last: None,
            voltage: 0.0,
        }
    }

    /// Takes in an impact.
    fn add(&mut self, event: &Event<T>, voltage: impl FnOnce() -> f64) {
        self.impacts += 1;
        if self.impacts == self.passed {
            self.first = Some(event.clone());
        } else if self.impacts > self.passed {
            self.voltage += voltage();
            if self.impacts == self.wanted {
                self.last = Some(event.clone());
            }
        }
    }

    /// The mean of what the sums have, given how much a small distance has grown.
    fn mean(&self, quantity: Quantity, stretch: f64) -> Result<f64, Unsolved> {
        let both = self.first.as_ref().zip(self.last.as_ref());
        let time = both
            .map(|(first, last)| first.time_to(last).to_f64())
            .ok_or(Unsolved::Undecided)?;
        Ok(match quantity {
            Quantity::MeanVoltage => self.voltage / f64::from(self.wanted - self.passed),
            Quantity::VoltageRate => self.voltage / (0.5 * time),
            Quantity::Lyapunov => stretch / time,
        })
    }
}

/// The mean over motions that are followed one after the other in `T`. The voltage of an impact is that of `T`, but of no
/// wider number than f64: its error is far below that of a mean.
fn mean<T: Analytic>(
    motion: &Motion<T>,
    starts: &[Start<T>],
    quantity: Quantity,
    impacts: u32,
) -> Result<f64, Unsolved> {
    let own = membrane::<T>().map_err(|_| Unsolved::LeftDomain)?;
    let double = membrane::<f64>().map_err(|_| Unsolved::LeftDomain)?;
    let is_wide = T::epsilon().to_f64() < f64::EPSILON;
    let voltage = |event: &Event<T>| match quantity {
        Quantity::Lyapunov => 0.0,
        _ if is_wide => double.voltage(&event.velocity.to_f64()),
        _ => own.voltage(&event.velocity).to_f64(),
    };
    let mut total = 0.0;
    for start in starts {
        let mut events = Simulation::new(motion, start);
        if quantity == Quantity::Lyapunov {
            events = events.with_growth();
        }
        let mut sums = Sums::new(impacts);
        let mut stretch = [0.0; 2];
        while sums.impacts < impacts {
            let event = events.next().filter(|event| event.kind != Kind::Undecided);
            let event = event.ok_or(Unsolved::Undecided)?;
            if event.kind == Kind::Impact {
                sums.add(&event, || voltage(&event));
                let grown = || events.growth().map_or(f64::NAN, |growth| growth.stretch());
                if sums.impacts == sums.passed {
                    stretch[0] = grown();
                } else if sums.impacts == sums.wanted {
                    stretch[1] = grown();
                }
            }
        }
        total += sums.mean(quantity, stretch[1] - stretch[0])?;
    }
    Ok(total / starts.len() as f64)
}

/// The same of motions that are followed side by side, in f64.
fn mean_in_lanes(device: &Device, quantity: Quantity, impacts: u32) -> Result<f64, Unsolved> {
    let membrane = membrane::<f64>().map_err(|_| Unsolved::LeftDomain)?;
    let motions = device.starts.iter().map(|start| (device.motion.clone(), start.clone()));
    let motions: Vec<(Motion<f64>, Start<f64>)> = motions.collect();
    let mut sums: Vec<Sums<f64>> = motions.iter().map(|_| Sums::new(impacts)).collect();
    Batch::new(&motions).run(u64::from(impacts), |motion, event| {
        if let Some(sums) = sums.get_mut(motion).filter(|_| event.kind == Kind::Impact) {
            sums.add(event, || membrane.voltage(&event.velocity));
        }
    });
    let means = sums.iter().map(|sums| sums.mean(quantity, f64::NAN));
    let total: f64 = means.sum::<Result<f64, Unsolved>>()?;
    Ok(total / sums.len() as f64)
}

/// Every motion on its own, or side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum How {
    OneByOne,
    Lanes,
}

struct Way {
    quantity: Quantity,
    how: How,
    impacts: u32,
}

impl Way {
    fn all_for(quantity: Quantity) -> Vec<Self> {
        let hows: &[How] = match quantity {
            // [`Batch`], which is measured here, does not follow how distances grow
            Quantity::Lyapunov => &[How::OneByOne],
            _ => &[How::OneByOne, How::Lanes],
        };
        let of_how = |how: &How| {
            let how = *how;
            IMPACTS.map(|impacts| Self { quantity, how, impacts })
        };
        hows.iter().flat_map(of_how).collect()
    }

    fn one_by_one<T: Machine>(&self, device: &Device, starts: &[Start<f64>]) -> Result<Vec<T>, Unsolved> {
        let number = <T as Analytic>::from_f64;
        let motion = device.motion.convert(|value| number(*value));
        let motion = motion.map_err(|_| Unsolved::LeftDomain)?;
        let starts = starts.iter().map(|start| start.convert(|value| number(*value)));
        let starts: Vec<Start<T>> = starts.collect();
        Ok(vec![number(mean(&motion, &starts, self.quantity, self.impacts)?)])
    }
}

impl Means<Device> for Way {
    fn name(&self) -> &'static str {
        match self.how {
            How::OneByOne => "one-by-one",
            How::Lanes => "lanes",
        }
    }

    fn setting(&self) -> String {
        format!("impacts={}", self.impacts as usize * STARTS)
    }

    fn rungs(&self) -> &'static [Rung] {
        match self.how {
            How::Lanes => &[Rung::Double],
            How::OneByOne if self.impacts > WIDE_IMPACTS => OF_THE_MACHINE,
            How::OneByOne => &[Rung::Single, Rung::Double, Rung::DoubleDouble],
        }
    }

    fn answer<T: Machine>(&self, device: &Device) -> Result<Vec<T>, Unsolved> {
        if self.how == How::Lanes {
            let found = mean_in_lanes(device, self.quantity, self.impacts)?;
            return Ok(vec![<T as Analytic>::from_f64(found)]);
        }
        self.one_by_one(device, &device.starts)
    }

    /// Lanes do the operations of motions that are followed one by one; and each start takes as many as any other.
    fn operate<T: Machine>(&self, device: &Device) -> u64 {
        let first = &device.starts[..1.min(device.starts.len())];
        let _ = self.one_by_one::<T>(device, first);
        STARTS as u64
    }
}

/// The digits in which an orbit is followed to its means.
const DIGITS: u32 = 50;

/// Impacts after which what is left of the rounding of a settled motion is less than f64 tells.
const CONVERGED: usize = 400;

/// The exact mean: that of the orbit where the motion repeats; else that of so many impacts that its error is a tenth
/// of those that are compared.
fn exact(device: &Device, quantity: Quantity) -> Option<f64> {
    match &device.attractor {
        Some(attractor) if attractor.rests() => {
            of_cycle(&device.motion, &attractor.impacts, attractor.periods?, quantity)
        }
        Some(attractor) => at_digits(DIGITS, || {
            let number = |value: &f64| Digits::from_f64(*value);
            let motion = device.motion.convert(number).ok()?;
            // as near to the orbit as f64 has it
            let start = Start::from(attractor.impacts.first()?).convert(number);
            let impacts = Simulation::new(&motion, &start).filter(|event| event.kind == Kind::Impact);
            let length = attractor.impacts.len();
            let cycle: Vec<Event<Digits>> = impacts.skip(CONVERGED).take(length).collect();
            (cycle.len() == length).then(|| of_cycle(&motion, &cycle, attractor.periods?, quantity))?
        }),
        None if quantity == Quantity::Lyapunov => mean(&device.motion, &device.starts, quantity, REFERENCE).ok(),
        None => mean_in_lanes(device, quantity, REFERENCE).ok(),
    }
}

/// Of one cycle.
fn of_cycle<T: Analytic>(motion: &Motion<T>, impacts: &[Event<T>], periods: i64, quantity: Quantity) -> Option<f64> {
    let voltage = || {
        let membrane = membrane::<T>().ok()?;
        let voltages = impacts.iter().map(|event| membrane.voltage(&event.velocity));
        Some(voltages.fold(T::zero(), |sum, voltage| sum + voltage).to_f64())
    };
    let periods_taken = periods as f64;
    Some(match quantity {
        Quantity::MeanVoltage => voltage()? / impacts.len() as f64,
        Quantity::VoltageRate => voltage()? / periods_taken,
        Quantity::Lyapunov => largest_multiplier(motion, impacts, periods)?.to_f64().ln() / (2.0 * periods_taken),
    })
}

/// The parts of task `statistics`, with their names.
fn parts() -> impl Iterator<Item = (Region, Quantity, String)> {
    let quantities = |region: Region| Quantity::ALL.into_iter().map(move |quantity| (region, quantity));
    let all = Region::ALL.into_iter().flat_map(quantities);
    // a rest wipes every distance out
    let all = all.filter(|part| *part != (Region::Resting, Quantity::Lyapunov));
    all.map(|(region, quantity)| {
        let name = format!("statistics/{}/{}", region.name(), quantity.name());
        (region, quantity, name)
    })
}

/// Whether a part has this in its name.
pub(super) fn is_named(text: &str) -> bool {
    parts().any(|(.., name)| name.contains(text))
}

/// The trade of task `statistics`: a part for each kind of motion and quantity. Each problem is a device with
/// [`STARTS`] starts; their impacts are counted together, and the first half of each motion is passed over.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    rows_of(&Region::ALL, options)
}

fn rows_of(regions: &[Region], options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut rows = Vec::new();
    for region in regions.iter().copied() {
        let devices = devices(region, options);
        for (_, quantity, name) in parts().filter(|(of, ..)| *of == region) {
            let exact: Option<Vec<Vec<Exact>>> = devices
                .iter()
                .map(|device| Some(vec![<Exact as Analytic>::from_f64(exact(device, quantity)?)]))
                .collect();
            let Some(exact) = exact.filter(|exact| !exact.is_empty()) else {
                return Err(TradeError::Points { task: name });
            };
            let task = Task {
                name,
                points: &devices,
                error: worst_relative_error,
                miss: |_, _| Unsolved::FewDigits,
                place: Device::place,
                right: RIGHT,
            };
            rows.extend(judged(&task, &exact, &Way::all_for(quantity), options));
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_impacts_buy_digits_and_a_wider_number_buys_none_where_sampling_rules() {
        let options = TradeOptions {
            points: FEWER,
            seconds_per_row: 0.0,
            ..TradeOptions::default()
        };
        let rows = rows_of(&[Region::Periodic, Region::Chaotic], &options).expect("a trade");
        let row = |task: &str, method: &str, number: Rung, impacts: u32| {
            let setting = format!("impacts={}", impacts as usize * STARTS);
            let is_meant = |row: &&TradeRow| {
                row.task == task && row.method == method && row.number == number && row.setting == setting
            };
            rows.iter().find(is_meant).expect("a row")
        };
        let half = |task: &str, method: &str, number, impacts| row(task, method, number, impacts).kept(0.5);
        for quantity in ["mean_voltage", "voltage_rate", "lyapunov"] {
            let chaotic = format!("statistics/chaotic/{quantity}");
            let by = |number, impacts| half(&chaotic, "one-by-one", number, impacts);
            assert!(
                (by(Rung::DoubleDouble, 200) - by(Rung::Double, 200)).abs() < 1.0,
                "{quantity}"
            );
            // a hundredfold is a digit
            assert!(by(Rung::Double, 4000) > by(Rung::Double, 50) + 0.5, "{quantity}");
            assert!(by(Rung::Double, 4000) < 5.0, "{quantity}");
        }
        let periodic = "statistics/periodic/mean_voltage";
        assert!(half(periodic, "one-by-one", Rung::Double, 4000) > 12.0);
        assert!(half(periodic, "one-by-one", Rung::Single, 4000) < 8.0);
        let [own, lanes] = ["one-by-one", "lanes"].map(|method| row(periodic, method, Rung::Double, 4000));
        assert_eq!(own.operations, lanes.operations);
        assert!(own.kept(0.5) - lanes.kept(0.5) < 1.0);
    }

    #[test]
    fn lanes_and_motions_one_by_one_have_one_mean_where_they_repeat() {
        for device in devices(Region::Periodic, &TradeOptions::default()) {
            for quantity in [Quantity::MeanVoltage, Quantity::VoltageRate] {
                let own = mean(&device.motion, &device.starts, quantity, 1000).expect("a mean");
                let lanes = mean_in_lanes(&device, quantity, 1000).expect("a mean");
                assert!((own - lanes).abs() <= 1e-10 * own, "{own} {lanes}");
            }
        }
    }
}
