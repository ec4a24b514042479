//! Means along a motion that does not repeat, each with its standard error.

use crate::impact::{Event, Kind, Widening};
use crate::model::{Motion, Side};
use crate::orbit::long_run::attractor::Attractor;
use crate::orbit::long_run::resting::Releases;
use crate::orbit::long_run::steady_state::{BETWEEN_STOPS, Settling};
use crate::orbit::options::OrbitOptions;
use stop;

/// The frequencies of the periodogram that a standard error is taken from, the lowest: each has two degrees of freedom,
/// enough for Student's factor to be near 2, and all of them are waves that are long beside what the motion remembers.
pub const FREQUENCIES: usize = 10;

/// A length is a multiple of so many impacts, at least two to a wave.
const LEAST: u64 = 2 * FREQUENCIES as u64;

/// The most cells that sums are kept in: so many that the waves of those frequencies are long beside a cell.
const MOST_CELLS: usize = 1024;

/// A statistic with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Its value.
    pub value: f64,
    /// One standard error: 0 where the value is exact but for rounding; where it is measured, that of the periodogram at
    /// its [`FREQUENCIES`] lowest frequencies, of which 2.09 (Student's t of 20 degrees of freedom) are 95%; none where
    /// nothing is claimed.
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
    /// It repeats after a transient.
    Repeats(Attractor),
    /// A second release from a wall, after so many impacts.
    Released(Event<f64>, u64),
}

/// The voltage of an impact, or another number that it has.
pub type OfImpact<'a> = &'a dyn Fn(&Event<f64>) -> f64;

/// The effect of a release on the means along a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtRelease {
    /// The second release from a wall closes a cycle and ends the run; the means begin anew at the first.
    ///
    /// A chaotic motion may come to rest, or to any other cycle, after thousands of impacts only: its means before that are
    /// those of a transient. So with options it is followed on after its means are taken, for
    /// [`settling_impacts`](OrbitOptions::settling_impacts), and they are taken back at a release.
    Ends {
        /// The options of the search for a cycle, if it is followed on.
        followed: Option<OrbitOptions>,
    },
    /// The motion repeats, but its cycle is longer than the impacts that could be computed of it.
    ///
    /// The mean of a cycle of n impacts deviates from that of the chaotic motion along it by as much as a mean over n
    /// impacts does: the variance of a mean over N impacts is 1 + N/n times what is measured.
    Passes {
        /// The cycle is longer than so many impacts.
        longer_than: u64,
    },
}

/// Takes means along a motion.
#[derive(Clone, Copy)]
pub struct Averaging<'a> {
    /// The motion.
    pub motion: &'a Motion<f64>,
    /// Over how many impacts.
    pub length: AveragingLength,
    /// The voltage of an impact, where it is wanted.
    pub voltage: Option<OfImpact<'a>>,
    /// Whether the growth of small distances is wanted, which costs some tens of nanoseconds an impact.
    pub with_growth: bool,
    /// The effect of a release.
    pub at_release: AtRelease,
}

/// Sums over consecutive impacts.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    impacts: f64,
    voltage: f64,
    time: f64,
    stretch: f64,
}

impl Sums {
    fn plus(self, other: &Self) -> Self {
        Self {
            impacts: self.impacts + other.impacts,
            voltage: self.voltage + other.voltage,
            time: self.time + other.time,
            stretch: self.stretch + other.stretch,
        }
    }
}

/// The sums along a motion, in at most [`MOST_CELLS`] cells of equally many impacts; the last may have fewer.
struct Cells {
    sums: Vec<Sums>,
    size: f64,
}

impl Cells {
    const fn new() -> Self {
        Self {
            sums: Vec::new(),
            size: 1.0,
        }
    }

    fn add(&mut self, impact: &Sums) {
        match self.sums.last_mut() {
            Some(last) if last.impacts < self.size => *last = last.plus(impact),
            _ => {
                if self.sums.len() == MOST_CELLS {
                    self.sums = self.sums.chunks(2).map(|pair| pair[0].plus(&pair[1])).collect();
                    self.size *= 2.0;
                }
                self.sums.push(*impact);
            }
        }
    }
}

impl Averaging<'_> {
    /// Follows the motion on after `event` and takes its means, over [`AveragingLength::impacts`] rounded up to a multiple
    /// of 20. A release forgets what was before, as [`AtRelease`] says.
    ///
    /// A mean is a ratio of two sums, and its error that of the sum of the residuals. The variance of this sum is the
    /// spectral density of the residuals at frequency 0: the mean of their periodogram at its lowest frequencies
    /// (E. Lazarus, D. J. Lewis, J. H. Stock and M. W. Watson, 2018, "HAR Inference: Recommendations for Practice", Journal
    /// of Business & Economic Statistics 36, 541-559). Batch means see too much there where fluctuations take each other
    /// back, as those of a voltage per unit of time do: their steps have a part of every frequency. A motion with a long
    /// memory shows in the lowest half and the lowest fifth of the frequencies: the largest error of the three is given.
    /// None is given of a motion that passes fewer than 20 releases, nor where r_B r_T = 1: nothing is lost there, and a mean may drift for ever; nor of a motion that ends
    /// before its length.
    pub fn after(&self, event: &Event<f64>) -> LongRun {
        let mut events = self.events_after(event);
        let mut means = self.begin(event);
        while let Some(event) = events.next() {
            if !means.take(&event, || events.growth().stretch_since_release()) {
                break;
            }
        }
        means.long_run()
    }

    /// What follows after `event`, from which no digits are claimed.
    pub fn events_after(&self, event: &Event<f64>) -> Widening {
        let events = Widening::after(self.motion, event);
        if self.with_growth {
            events
        } else {
            events.without_growth()
        }
    }

    /// The means from `event` on, to be given what [follows](Averaging::events_after), event by event.
    pub fn begin(&self, event: &Event<f64>) -> RunningMeans<'_> {
        let mut lengths = Lengths::new(self.length.impacts);
        RunningMeans {
            averaging: self,
            cells: Cells::new(),
            before: event.clone(),
            stretch: 0.0,
            impacts: 0,
            taken: 0,
            rests: 0,
            releases: Releases::default(),
            length: lengths.next(),
            lengths,
            measured: None,
            released: None,
        }
    }

    /// The statistics of impacts between which a motion that passes releases has rested so often.
    fn statistics(&self, cells: &[Sums], rests: u64) -> Statistics {
        let impacts: f64 = cells.iter().map(|cell| cell.impacts).sum();
        let is_lossless = [Side::Bottom, Side::Top]
            .iter()
            .all(|side| *self.motion.restitution(*side) == 1.0);
        // between rests nothing is remembered: of fewer than two to a wave the frequencies say nothing
        let is_short = matches!(self.at_release, AtRelease::Passes { .. }) && rests < LEAST;
        let of_cycle = match self.at_release {
            AtRelease::Ends { .. } => 1.0,
            AtRelease::Passes { longer_than } => (1.0 + impacts / longer_than.max(1) as f64).sqrt(),
        };
        let estimate = |is_wanted: bool, of: fn(&Sums) -> f64, over: fn(&Sums) -> f64| {
            let ratio = is_wanted.then(|| ratio(cells, of, over)).flatten()?;
            let error = ratio
                .error
                .filter(|_| !is_lossless && !is_short)
                .map(|error| of_cycle * error);
            Some(Estimate { error, ..ratio })
        };
        let has_voltage = self.voltage.is_some();
        let voltage = estimate(has_voltage, |cell| cell.voltage, |cell| cell.impacts);
        let rate = estimate(has_voltage, |cell| cell.voltage, |cell| cell.time / 2.0);
        let part = self.length.error.filter(|_| has_voltage);
        Statistics {
            impacts: impacts as u64,
            voltage,
            rate,
            lyapunov: estimate(self.with_growth, |cell| cell.stretch, |cell| cell.time),
            is_met: part.map(|part| [voltage, rate].iter().flatten().all(|mean| mean.is_within(part))),
        }
    }
}

/// Means along a motion, event by event.
pub struct RunningMeans<'a> {
    averaging: &'a Averaging<'a>,
    cells: Cells,
    before: Event<f64>,
    stretch: f64,
    /// All impacts, and those the means are of.
    impacts: u64,
    taken: u64,
    /// The releases that were passed.
    rests: u64,
    releases: Releases,
    lengths: Lengths,
    length: Option<u64>,
    /// The means, and the motion after them.
    measured: Option<(Statistics, Option<Settling>)>,
    /// The release that closed a cycle.
    released: Option<Event<f64>>,
}

impl RunningMeans<'_> {
    /// Takes in the next event, `grown` being the logarithm of the stretch since the last release where growth is
    /// followed; `false` where no more are wanted.
    #[inline]
    pub fn take(&mut self, event: &Event<f64>, grown: impl FnOnce() -> f64) -> bool {
        if event.kind != Kind::Impact {
            return self.pass(event);
        }
        self.impacts += 1;
        if self.impacts.is_multiple_of(BETWEEN_STOPS) && !stop::goes_on() {
            return false;
        }
        if let Some((_, followed)) = &mut self.measured {
            return followed.as_mut().is_some_and(|followed| followed.take(event));
        }
        self.taken += 1;
        let averaging = self.averaging;
        let grown = if averaging.with_growth { grown() } else { 0.0 };
        self.cells.add(&Sums {
            impacts: 1.0,
            voltage: averaging.voltage.map_or(0.0, |voltage| voltage(event)),
            time: self.before.time_to(event),
            stretch: grown - self.stretch,
        });
        self.before.clone_from(event);
        self.stretch = grown;
        Some(self.taken) != self.length || self.goes_on()
    }

    /// Looks at the means so far.
    fn goes_on(&mut self) -> bool {
        let found = self.averaging.statistics(&self.cells.sums, self.rests);
        let most = u64::from(self.averaging.length.most);
        self.length = self.lengths.next().filter(|next| *next <= most);
        if found.is_met == Some(false) && self.length.is_some() {
            return true;
        }
        let followed = match self.averaging.at_release {
            AtRelease::Ends { followed } => {
                followed.map(|options| Settling::new(options.settling_impacts, 1, &options))
            }
            AtRelease::Passes { .. } => None,
        };
        let goes_on = followed.is_some();
        self.measured = Some((found, followed));
        goes_on
    }

    /// Takes in an event that is no impact.
    #[cold]
    fn pass(&mut self, event: &Event<f64>) -> bool {
        match (event.kind, self.averaging.at_release) {
            (Kind::Undecided, _) => false,
            (Kind::Release, AtRelease::Passes { .. }) => {
                // what wipes out every distance has no exponent to measure
                self.stretch = f64::NAN;
                self.rests += 1;
                true
            }
            (Kind::Release, AtRelease::Ends { .. }) if self.releases.is_second(event) => {
                self.released = Some(event.clone());
                false
            }
            (Kind::Release, AtRelease::Ends { .. }) => {
                (self.cells, self.taken, self.measured) = (Cells::new(), 0, None);
                self.lengths = Lengths::new(self.averaging.length.impacts);
                self.length = self.lengths.next();
                (self.before, self.stretch) = (event.clone(), 0.0);
                true
            }
            (Kind::Rest | Kind::Impact, _) => match &mut self.measured {
                Some((_, Some(followed))) => followed.take(event),
                _ => true,
            },
        }
    }

    /// The result; where the motion ended before its length, of what there is, as one cell.
    pub fn long_run(self) -> LongRun {
        if let Some(release) = self.released {
            return LongRun::Released(release, self.impacts);
        }
        let Some((found, followed)) = self.measured else {
            let all = self.cells.sums.iter().fold(Sums::default(), Sums::plus);
            return LongRun::Measured(self.averaging.statistics(&[all], self.rests));
        };
        let cycle = followed.and_then(|followed| followed.steady_state().attractor);
        cycle.map_or(LongRun::Measured(found), LongRun::Repeats)
    }
}

/// The lengths at which an error that is asked for is looked at: each no more than 1.43 times the one before, and few, since
/// each is one more chance to stop by luck.
struct Lengths {
    first: u64,
    number: u32,
}

impl Lengths {
    fn new(first: u32) -> Self {
        Self {
            first: u64::from(first.max(1)).div_ceil(LEAST),
            number: 0,
        }
    }

    fn next(&mut self) -> Option<u64> {
        let times = if self.number.is_multiple_of(2) { 20 } else { 28 };
        let length = self.first.checked_mul(times << (self.number / 2).min(40));
        self.number += 1;
        length
    }
}

/// The ratio of two sums with its standard error; `None` where it is no number.
fn ratio(cells: &[Sums], of: fn(&Sums) -> f64, over: fn(&Sums) -> f64) -> Option<Estimate> {
    let sum = |of: fn(&Sums) -> f64| cells.iter().map(of).sum::<f64>();
    let value = sum(of) / sum(over);
    let residuals = cells.iter().map(|cell| of(cell) - value * over(cell));
    let error = (cells.len() as u64 >= LEAST).then(|| variance_of_sum(residuals).sqrt() / sum(over));
    value.is_finite().then_some(Estimate { value, error })
}

/// The variance of the sum of a stationary series of mean 0: its periodogram at its lowest frequencies, by the recurrence
/// of G. Goertzel, 1958, American Mathematical Monthly 65, 34-35.
fn variance_of_sum(series: impl ExactSizeIterator<Item = f64>) -> f64 {
    let angle = std::f64::consts::TAU / series.len() as f64;
    let twice_cosine: [f64; FREQUENCIES] = std::array::from_fn(|index| 2.0 * ((index + 1) as f64 * angle).cos());
    let [mut last, mut before] = [[0.0; FREQUENCIES]; 2];
    for value in series {
        let next = std::array::from_fn(|index| value + twice_cosine[index] * last[index] - before[index]);
        (before, last) = (last, next);
    }
    let powers: [f64; FREQUENCIES] = std::array::from_fn(|index| {
        let (last, before) = (last[index], before[index]);
        last * last + before * before - twice_cosine[index] * last * before
    });
    let of_lowest = |count: usize| powers[..count].iter().sum::<f64>() / count as f64;
    [FREQUENCIES, FREQUENCIES / 2, FREQUENCIES / 5]
        .into_iter()
        .map(of_lowest)
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Start;
    use crate::orbit::{SteadyState, lyapunov};
    use numbers::Sequence;

    fn measured(motion: &Motion<f64>, length: AveragingLength) -> Option<Statistics> {
        let (side, phase, velocity) = (Side::Bottom, 6.18, 0.5293);
        let start = Start::impact(side, phase, velocity);
        let settled = SteadyState::after(Widening::new(motion, &start), 500, 60);
        let voltage = |impact: &Event<f64>| impact.velocity.abs();
        let measure = Averaging {
            motion,
            length,
            voltage: Some(&voltage),
            with_growth: true,
            at_release: AtRelease::Ends { followed: None },
        };
        match measure.after(&settled.end?) {
            LongRun::Measured(found) => Some(found),
            LongRun::Released(..) | LongRun::Repeats(_) => None,
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
            let settled = SteadyState::after(Widening::new(&motion, &Start::impact(side, phase, velocity)), 500, 60);
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

    /// The mean error over many series of this length, relative to the deviation of their means; and that of batch means.
    fn relative_error(of: &dyn Fn(&mut dyn FnMut() -> f64) -> Vec<f64>) -> [f64; 2] {
        let mut sequence = Sequence::new(7);
        let mut draw = || sequence.between(-1.0, 1.0);
        let [mut spread, mut estimated, mut by_batches] = [0.0; 3];
        for _ in 0..400 {
            let series = of(&mut draw);
            let mut cells = Cells::new();
            for value in &series {
                let (impacts, voltage) = (1.0, *value);
                cells.add(&Sums {
                    impacts,
                    voltage,
                    ..Sums::default()
                });
            }
            let found = ratio(&cells.sums, |cell| cell.voltage, |cell| cell.impacts).unwrap();
            spread += found.value.powi(2);
            estimated += found.error.unwrap().powi(2);
            let batch = |batch: &[f64]| batch.iter().sum::<f64>().powi(2);
            by_batches += series.chunks(series.len() / 20).map(batch).sum::<f64>() / (series.len() as f64).powi(2);
        }
        [estimated, by_batches].map(|squares| (squares / spread).sqrt())
    }

    #[test]
    fn the_error_is_the_deviation_of_the_mean_whether_what_follows_adds_to_it_or_takes_it_back() {
        for length in [500, 3000] {
            // independent
            let [error, _] = relative_error(&|draw| (0..length).map(|_| draw()).collect());
            assert!((0.95..1.3).contains(&error), "{length}: {error}");
            // with a memory of 10
            let [error, _] = relative_error(&|draw| {
                let mut last = 0.0;
                let mut next = || {
                    last = 0.9 * last + draw();
                    last
                };
                (0..length + 100).map(|_| next()).skip(100).collect()
            });
            assert!((0.95..1.3).contains(&error), "{length}: {error}");
            // differences: all that is left is the last less the first
            let [error, by_batches] = relative_error(&|draw| {
                let ends: Vec<f64> = (0..=length).map(|_| draw()).collect();
                ends.windows(2).map(|pair| pair[1] - pair[0]).collect()
            });
            assert!(
                (1.0..1.9).contains(&error) && by_batches > 4.0,
                "{length}: {error} {by_batches}"
            );
        }
    }
}
