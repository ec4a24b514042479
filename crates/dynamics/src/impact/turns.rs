//! The phases at which f + g changes its sign: between them the velocity of a ball is monotone.

use crate::model::{Bracket, Sample, root};
use numbers::{Analytic, Endpoint, Interval};
use std::f64::consts::TAU;

/// A harmonic of a forcing: `cosine cos(order x) + sine sin(order x)`.
#[derive(Clone, Debug)]
pub(super) struct Harmonic<T> {
    pub order: i64,
    pub cosine: T,
    pub sine: T,
}

/// A change of sign of f + g.
#[derive(Clone, Debug)]
pub(super) struct Turn<T, W> {
    /// In [0, 2 pi).
    pub phase: T,
    /// From + to -: the bottom presses before and releases here; the top the other way round.
    pub falling: bool,
    /// The forcing there, as seen from the bottom.
    pub waves: W,
    /// The angle to the next one.
    pub to_next: T,
}

/// Cells of the phase are halved down to this; what is left there are two zeros, or none, so close that f + g between them
/// is below 1e-12, and moves a ball by less than 1e-24.
const FINEST: f64 = 1e-6;

/// The cells of a period to begin with, for each order of the highest harmonic. They start where no zero of use is.
const CELLS: f64 = 4.0;
const FIRST: f64 = 0.123_456_7;

/// Where f + g, of coefficients in these intervals, changes its sign.
pub(super) struct SignChanges {
    /// Ends of each bracket, with whether f + g is positive before it.
    pub brackets: Vec<([f64; 2], bool)>,
    /// Whether it is proved that there is one in each and none elsewhere.
    pub proved: bool,
    /// The last phase at which the sign is known, and whether it is positive.
    last: (f64, bool),
}

impl SignChanges {
    /// Finds those of numbers of another type, each within the interval that `around` gives.
    pub fn around<T: Analytic>(drive: &[Harmonic<T>], g: &T, around: impl Fn(&T) -> Interval<f64>) -> Self {
        let harmonics = drive.iter().map(|harmonic| Harmonic {
            order: harmonic.order,
            cosine: around(&harmonic.cosine),
            sine: around(&harmonic.sine),
        });
        Self::new(&harmonics.collect::<Vec<_>>(), &around(g))
    }

    /// By halving cells of a period until f + g, or its derivative, has one sign on each.
    pub fn new(harmonics: &[Harmonic<Interval<f64>>], g: &Interval<f64>) -> Self {
        let highest = harmonics.iter().map(|harmonic| harmonic.order).max().unwrap_or(1) as f64;
        let count = (CELLS * highest).max(CELLS) as usize;
        let end = |index: usize| FIRST + TAU * index as f64 / count as f64;
        let [first, _] = sum(harmonics, g, &Interval::point(FIRST));
        let is_above = first.midpoint() > 0.0;
        let mut changes = Self {
            brackets: Vec::new(),
            proved: sign(&first).is_some(),
            last: (FIRST, is_above),
        };
        for index in 0..count {
            changes.look(harmonics, g, [end(index), end(index + 1)]);
        }
        changes.meet(FIRST + TAU, is_above);
        changes
    }

    /// Takes in the sign at a phase.
    fn meet(&mut self, phase: f64, is_above: bool) {
        let (before, was_above) = self.last;
        if was_above != is_above {
            self.brackets.push(([before, phase], was_above));
        }
        self.last = (phase, is_above);
    }

    fn look(&mut self, harmonics: &[Harmonic<Interval<f64>>], g: &Interval<f64>, [low, high]: [f64; 2]) {
        let [value, slope] = sum(harmonics, g, &Interval::new(low, high));
        if let Some(is_above) = sign(&value) {
            self.meet(high, is_above);
            return;
        }
        let is_monotone = sign(&slope).is_some();
        if !is_monotone && high - low > FINEST {
            let middle = low + 0.487 * (high - low);
            self.look(harmonics, g, [low, middle]);
            self.look(harmonics, g, [middle, high]);
            return;
        }
        self.proved &= is_monotone;
        for end in [low, high] {
            match sign(&sum(harmonics, g, &Interval::point(end))[0]) {
                Some(is_above) => self.meet(end, is_above),
                None => self.proved = false,
            }
        }
    }
}

/// Returns true if all of an interval is positive, false if negative; `None` where it has numbers of either sign.
fn sign(value: &Interval<f64>) -> Option<bool> {
    (value.is_positive() || value.is_negative()).then(|| value.is_positive())
}

/// f + g and its derivative.
fn sum<T: Analytic>(harmonics: &[Harmonic<T>], g: &T, phase: &T) -> [T; 2] {
    let mut sum = [g.clone(), T::zero()];
    for Harmonic { order, cosine, sine } in harmonics {
        let order = T::from_integer(*order);
        let (sin, cos) = (order.clone() * phase.clone()).sincos();
        sum[0] += cosine.clone() * cos.clone() + sine.clone() * sin.clone();
        sum[1] += order * (sine.clone() * cos - cosine.clone() * sin);
    }
    sum
}

/// The changes of sign of f + g, each phase enclosed in [0, 2 pi] or a little beyond, in order, with whether it is from
/// + to -; `None` where intervals over f64 do not prove that these are all.
pub(super) fn enclosed<E: Endpoint>(
    drive: &[Harmonic<Interval<E>>],
    g: &Interval<E>,
) -> Option<Vec<(Interval<E>, bool)>> {
    let changes = SignChanges::around(drive, g, around);
    if !changes.proved {
        return None;
    }
    let circle = Interval::<E>::pi() + Interval::pi();
    let mut phases: Vec<(Interval<E>, bool)> = Vec::new();
    for ([low, high], falling) in changes.brackets {
        let phase = narrowed(drive, g, Interval::new(E::from_f64(low), E::from_f64(high)));
        let is_later = phase.midpoint() > circle.midpoint();
        phases.push((if is_later { phase - circle.clone() } else { phase }, falling));
    }
    phases.sort_by(|(one, _), (other, _)| one.to_f64().total_cmp(&other.to_f64()));
    Some(phases)
}

/// An interval over f64 around one over another number.
pub(super) fn around<E: Endpoint>(value: &Interval<E>) -> Interval<f64> {
    let [low, high] = [value.low(), value.high()];
    if low.is_zero() && high.is_zero() {
        return Interval::point(0.0);
    }
    Interval::new(low.to_f64().next_down(), high.to_f64().next_up())
}

/// The zero in an interval on which f + g is monotone, by Newton's method over intervals.
fn narrowed<E: Endpoint>(drive: &[Harmonic<Interval<E>>], g: &Interval<E>, mut phase: Interval<E>) -> Interval<E> {
    for _ in 0..MOST_STEPS {
        let middle = Interval::point(phase.midpoint());
        let [value, _] = sum(drive, g, &middle);
        let [_, slope] = sum(drive, g, &phase);
        let Some(narrower) = (middle - value / slope).intersection(&phase) else {
            break;
        };
        let is_done = narrower.width() >= phase.width();
        phase = narrower;
        if is_done {
            break;
        }
    }
    phase
}

/// Newton's method doubles the digits: 200 of them take fewer steps.
const MOST_STEPS: usize = 40;

/// The turns at these phases, reduced and in order.
pub(super) fn in_order<T: Analytic, W>(mut phases: Vec<(T, bool)>, at: impl Fn(&T) -> W) -> Vec<Turn<T, W>> {
    let circle = T::pi() + T::pi();
    for (phase, _) in &mut phases {
        if (phase.clone() - circle.clone()).to_f64() >= 0.0 {
            *phase -= circle.clone();
        }
    }
    phases.sort_by(|(one, _), (other, _)| one.to_f64().total_cmp(&other.to_f64()));
    let next = |index: usize| match phases.get(index + 1) {
        Some((phase, _)) => phase.clone(),
        None => phases[0].0.clone() + circle.clone(),
    };
    let turns = phases.iter().enumerate().map(|(index, (phase, falling))| Turn {
        waves: at(phase),
        falling: *falling,
        to_next: next(index) - phase.clone(),
        phase: phase.clone(),
    });
    turns.collect()
}

/// The phases at which f + g changes its sign, with whether it is from + to -: by Newton's method from brackets that
/// intervals over f64 find.
pub(super) fn zeros<T: Analytic>(drive: &[Harmonic<T>], g: &T) -> Vec<(T, bool)> {
    let around = |value: &T| {
        let value = value.to_f64();
        Interval::new(value.next_down(), value.next_up())
    };
    let changes = SignChanges::around(drive, g, around);
    let size = drive
        .iter()
        .map(|harmonic| harmonic.cosine.to_f64().abs() + harmonic.sine.to_f64().abs());
    let size = size.sum::<f64>() + g.to_f64().abs();
    let phases = changes.brackets.iter().map(|([low, high], falling)| {
        let [low, high] = [low, high].map(|end| T::from_f64(*end));
        let values = [&low, &high].map(|end| sum(drive, g, end)[0].to_f64());
        let bracket = Bracket {
            low: &low,
            high: &high,
            values,
        };
        let phase = root(&bracket, |phase| {
            let [value, slope] = sum(drive, g, phase);
            Sample { value, slope, size }
        });
        (phase, *falling)
    });
    phases.collect()
}
