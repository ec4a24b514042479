//! Means along a motion that does not repeat, each with its standard error.

use crate::impact::{Event, Kind, Widening};
use crate::model::{Motion, Side};
use crate::orbit::long_run::resting::Releases;
use crate::orbit::long_run::steady_state::BETWEEN_STOPS;
use crate::stop;

/// The batches that a standard error is taken from: enough for Student's factor to be near 2, few enough for each to
/// be long.
pub const BATCHES: usize = 20;

/// The batches at which an error that is asked for is looked at between a length and its double: lengths grow by no more
/// than 1.43 from look to look, and looks stay few, since each is one more chance to stop by luck.
const BETWEEN_DOUBLES: usize = 28;

/// A statistic with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Its value.
    pub value: f64,
    /// One standard error: 0 where the value is exact but for rounding; where it is measured, that of [`BATCHES`] batch
    /// means or a few more, of which 2.09 (Student's t of 19 degrees of freedom) are 95%; none where nothing is claimed.
    pub error: Option<f64>,
}

impl Estimate {
    /// A value that nothing had to be measured for.
    pub const fn exact(value: f64) -> Self {
        let error = Some(0.0);
        Self { value, error }
    }

    fn is_within(&self, part: f64) -> bool {
        self.error.is_some_and(|error| error <= part * self.value.abs())
    }
}

/// Over how many impacts means are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AveragingLength {
    /// So many,
    pub impacts: u32,
    /// and about half as many again until the standard errors of the voltages are no more than this part of their means,
    pub error: Option<f64>,
    /// but no more than these.
    pub most: u32,
}

/// The statistics of a motion that does not repeat.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// The impacts they are taken over.
    pub impacts: u64,
    /// The mean of the voltage over the impacts, (7), where there is one.
    pub voltage: Option<Estimate>,
    /// The sum of the voltages per forcing period.
    pub rate: Option<Estimate>,
    /// The largest Lyapunov exponent: the mean growth of the logarithm of a small distance per unit of time, of which
    /// the forcing period is 2. None where growth is not followed, or the motion grazes exactly.
    pub lyapunov: Option<Estimate>,
    /// Whether [`AveragingLength::error`] was met; none where it was not asked for, or there is no voltage.
    pub is_met: Option<bool>,
}

/// What a motion does that is followed on.
#[derive(Clone, Debug, PartialEq)]
pub enum LongRun {
    /// It has not repeated.
    Measured(Statistics),
    /// A second release from this wall, after so many impacts.
    Released(Side, u64),
}

/// The voltage of an impact, or another number that it has.
pub type OfImpact<'a> = &'a dyn Fn(&Event<f64>) -> f64;

/// Takes means along a motion.
pub struct Averaging<'a> {
    /// The motion.
    pub motion: &'a Motion<f64>,
    /// Over how many impacts.
    pub length: AveragingLength,
    /// The voltage of an impact, where it is wanted.
    pub voltage: Option<OfImpact<'a>>,
    /// Whether the growth of small distances is wanted, which costs some tens of nanoseconds an impact.
    pub with_growth: bool,
    /// Whether to stop at the second release from a wall, which closes a cycle, and begin anew at the first.
    pub at_releases: bool,
}

/// Sums over the impacts of a batch.
#[derive(Clone, Copy, Debug, Default)]
struct BatchSums {
    impacts: f64,
    voltage: f64,
    time: f64,
    stretch: f64,
}

impl BatchSums {
    fn plus(self, other: &Self) -> Self {
        Self {
            impacts: self.impacts + other.impacts,
            voltage: self.voltage + other.voltage,
            time: self.time + other.time,
            stretch: self.stretch + other.stretch,
        }
    }
}

impl Averaging<'_> {
    /// Follows the motion on after `event` and takes its means over [`BATCHES`] batches of equally many impacts. A release
    /// forgets what was before, so the means begin again there; the second one from a wall closes a cycle.
    ///
    /// The errors are those of batch means (G. S. Fishman, 1978, "Principles of Discrete Event Simulation", 5.4), for a
    /// mean per unit of time those of the residuals of the ratio. Batches that still speak of each other show in those
    /// twice and four times as long: the largest error of the three is given. None is given where r_B r_T = 1: nothing
    /// is lost there, and a mean may drift for ever; nor of a motion that ends before its batches are full.
    pub fn after(&self, event: &Event<f64>) -> LongRun {
        let events = Widening::after(self.motion, event);
        let mut events = if self.with_growth {
            events
        } else {
            events.without_growth()
        };
        let mut releases = Releases::default();
        let (mut before, mut stretch, mut impacts) = (event.clone(), 0.0, 0);
        let mut full: Vec<BatchSums> = Vec::with_capacity(2 * BATCHES);
        let mut batch = BatchSums::default();
        let mut size = f64::from(self.length.impacts.div_ceil(BATCHES as u32));
        while let Some(event) = events.next() {
            match event.kind {
                Kind::Undecided => break,
                Kind::Rest => continue,
                Kind::Release if !self.at_releases => {
                    // what wipes out every distance has no exponent to measure
                    stretch = f64::NAN;
                    continue;
                }
                Kind::Release if releases.is_second(&event) => return LongRun::Released(event.side, impacts),
                Kind::Release => {
                    full.clear();
                    (batch, before, stretch) = (BatchSums::default(), event, 0.0);
                    continue;
                }
                Kind::Impact => {}
            }
            impacts += 1;
            if impacts % BETWEEN_STOPS == 0 && !stop::goes_on() {
                break;
            }
            let grown = events.growth().stretch_since_release();
            batch = batch.plus(&BatchSums {
                impacts: 1.0,
                voltage: self.voltage.map_or(0.0, |voltage| voltage(&event)),
                time: before.time_to(&event),
                stretch: grown - stretch,
            });
            (before, stretch) = (event, grown);
            if batch.impacts < size {
                continue;
            }
            full.push(std::mem::take(&mut batch));
            if full.len() == 2 * BATCHES {
                (full, size) = (joined(&full), 2.0 * size);
            }
            let next = match full.len() {
                BATCHES => BETWEEN_DOUBLES,
                BETWEEN_DOUBLES => 2 * BATCHES,
                _ => continue,
            };
            let may_go_on = size * next as f64 <= f64::from(self.length.most);
            if !(may_go_on && self.is_met(&full) == Some(false)) {
                return LongRun::Measured(self.statistics(&full));
            }
        }
        // what there is, as one batch
        let all = full.iter().fold(batch, BatchSums::plus);
        LongRun::Measured(self.statistics(&[all]))
    }

    fn statistics(&self, batches: &[BatchSums]) -> Statistics {
        let impacts: f64 = batches.iter().map(|batch| batch.impacts).sum();
        let is_lossless = [Side::Bottom, Side::Top]
            .iter()
            .all(|side| *self.motion.restitution(*side) == 1.0);
        let estimate = |is_wanted: bool, of: fn(&BatchSums) -> f64, over: fn(&BatchSums) -> f64| {
            let ratio = is_wanted.then(|| ratio(batches, of, over)).flatten()?;
            let error = ratio.error.filter(|_| !is_lossless);
            Some(Estimate { error, ..ratio })
        };
        let has_voltage = self.voltage.is_some();
        Statistics {
            impacts: impacts as u64,
            voltage: estimate(has_voltage, |batch| batch.voltage, |batch| batch.impacts),
            rate: estimate(has_voltage, |batch| batch.voltage, |batch| batch.time / 2.0),
            lyapunov: estimate(self.with_growth, |batch| batch.stretch, |batch| batch.time),
            is_met: self.is_met(batches),
        }
    }

    fn is_met(&self, batches: &[BatchSums]) -> Option<bool> {
        let part = self.length.error.filter(|_| self.voltage.is_some())?;
        let statistics = Self {
            length: AveragingLength {
                error: None,
                ..self.length
            },
            ..*self
        }
        .statistics(batches);
        let mut means = [statistics.voltage, statistics.rate].into_iter().flatten();
        Some(means.all(|mean| mean.is_within(part)))
    }
}

/// The batches by pairs.
fn joined(batches: &[BatchSums]) -> Vec<BatchSums> {
    batches
        .chunks(2)
        .map(|pair| pair.iter().fold(BatchSums::default(), BatchSums::plus))
        .collect()
}

/// The ratio of two sums with its standard error; `None` where it is no number.
fn ratio(batches: &[BatchSums], of: fn(&BatchSums) -> f64, over: fn(&BatchSums) -> f64) -> Option<Estimate> {
    let sum = |of: fn(&BatchSums) -> f64| batches.iter().map(of).sum::<f64>();
    let value = sum(of) / sum(over);
    let error = |batches: &[BatchSums]| {
        let count = batches.len() as f64;
        let squares: f64 = batches
            .iter()
            .map(|batch| (of(batch) - value * over(batch)).powi(2))
            .sum();
        (squares * count / (count - 1.0)).sqrt() / sum(over)
    };
    let longer = joined(batches);
    let error = (batches.len() >= BATCHES).then(|| error(batches).max(error(&longer)).max(error(&joined(&longer))));
    value.is_finite().then_some(Estimate { value, error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Start;
    use crate::orbit::{SteadyState, lyapunov};

    fn measured(motion: &Motion<f64>, length: AveragingLength) -> Option<Statistics> {
        let (side, phase, velocity) = (Side::Bottom, 6.18, 0.5293);
        let start = Start { side, phase, velocity };
        let settled = SteadyState::after(Widening::new(motion, &start), 500, 60);
        let voltage = |impact: &Event<f64>| impact.velocity.abs();
        let measure = Averaging {
            motion,
            length,
            voltage: Some(&voltage),
            with_growth: true,
            at_releases: true,
        };
        match measure.after(&settled.end?) {
            LongRun::Measured(found) => Some(found),
            LongRun::Released(..) => None,
        }
    }

    fn over(impacts: u32) -> AveragingLength {
        let error = None;
        AveragingLength {
            impacts,
            error,
            most: impacts,
        }
    }

    #[test]
    fn along_a_cycle_the_means_are_its_own() {
        for d in [0.26, 0.27, 0.33, 0.45] {
            let motion = Motion::new(0.12201, d, 0.6, 0.3).unwrap();
            let (side, phase, velocity) = (Side::Bottom, 6.18, 0.5293);
            let settled = SteadyState::after(Widening::new(&motion, &Start { side, phase, velocity }), 500, 60);
            let cycle = settled.attractor.unwrap();
            let found = measured(&motion, over(2000)).unwrap();
            let exact = lyapunov(&motion, &cycle).unwrap();
            assert!((exact - found.lyapunov.unwrap().value).abs() < 0.01, "{d}: {exact}");
            let sum: f64 = cycle.impacts.iter().map(|impact| impact.velocity.abs()).sum();
            let rate = sum / cycle.periods.unwrap() as f64;
            assert!((rate - found.rate.unwrap().value).abs() < 1e-3 * rate, "{d}: {rate}");
            let mean = sum / cycle.impacts.len() as f64;
            assert!((mean - found.voltage.unwrap().value).abs() < 1e-3 * mean, "{d}: {mean}");
        }
    }

    #[test]
    fn impacts_are_added_until_the_error_is_met_or_the_most_are_reached() {
        let motion = Motion::new(0.244, 0.31, 0.579, 0.709).unwrap();
        let asked = |error, most| {
            measured(
                &motion,
                AveragingLength {
                    impacts: 500,
                    error: Some(error),
                    most,
                },
            )
            .unwrap()
        };
        let met = asked(0.002, 1_000_000);
        assert!(
            met.is_met == Some(true) && met.impacts > 500 && met.impacts.is_multiple_of(100),
            "{met:?}"
        );
        assert!(
            [met.voltage, met.rate]
                .iter()
                .all(|mean| mean.unwrap().is_within(0.002))
        );
        let unmet = asked(1e-6, 5000);
        assert_eq!((unmet.is_met, unmet.impacts), (Some(false), 4000));
        let between = asked(1e-6, 6000);
        assert_eq!((between.is_met, between.impacts), (Some(false), 5600));
        assert_eq!(asked(1.0, 1).impacts, 500);
    }

    #[test]
    fn nothing_is_claimed_of_a_device_that_loses_nothing() {
        let motion = Motion::new(0.1, 0.3, 1.0, 1.0).unwrap();
        let found = measured(&motion, over(1000)).unwrap();
        assert!(
            [found.voltage, found.rate, found.lyapunov]
                .iter()
                .all(|mean| mean.unwrap().error.is_none())
        );
    }

    #[test]
    fn batches_that_speak_of_each_other_widen_the_error() {
        let batch = |voltage: f64| BatchSums {
            impacts: 1.0,
            voltage,
            time: 1.0,
            stretch: 0.0,
        };
        let error = |of: &dyn Fn(usize) -> f64| {
            let batches: Vec<BatchSums> = (0..BATCHES).map(|index| batch(of(index))).collect();
            ratio(&batches, |batch| batch.voltage, |batch| batch.impacts)
                .unwrap()
                .error
                .unwrap()
        };
        let alternating = error(&|index| (index % 2) as f64);
        let slow = error(&|index| (index / 4 % 2) as f64);
        assert!(
            (alternating - 0.5 / 19_f64.sqrt()).abs() < 1e-12 && slow > 1.8 * alternating,
            "{alternating} {slow}"
        );
    }
}
