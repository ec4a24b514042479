//! The box of devices to choose the best one from.

use super::document::Value;
use super::error::SceneError;
use super::harmonics::driven;
use super::key::{self, Allowed, Key};
use super::{Over, Quantity, Scene};
use dynamics::model::{DeviceError, Motion};
use dynamics::orbit::{Choice, Devices, Gap, Pull, Range, Unit, Word};
use numbers::{Analytic, Interval};
use std::cmp::Ordering;

/// The choice of a scene, and which parameters its four are.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxChoice {
    /// d or the forcing amplitude, g or the incline, r_B, r_T.
    pub parameters: [Over; 4],
    /// What is asked.
    pub choice: Choice,
    /// The motions, where these are not BT under the forcing of the paper, of which better devices can be excluded by proof.
    pub local: Option<LocalChoice>,
    /// True if there are words beside BT, which are left out.
    pub has_other_words: bool,
}

/// Motions of which good devices are looked for from many starts.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalChoice {
    /// Their words.
    pub words: Vec<Word>,
    /// A motion under the forcing; its numbers are those of the choice.
    pub base: Motion<Interval<f64>>,
}

/// The search for the best device divides by restitutions.
const ABOVE_0: &str = "above 0 and at most 1, where the best device is looked for";

fn is_restitution(over: Over) -> bool {
    matches!(over, Over::RB | Over::RT)
}

impl Scene {
    /// The parameters that have a range in the box.
    pub(super) fn chosen(&self) -> Vec<Over> {
        let is_given = |over: &Over| over.box_key().is_some_and(|key| self.document.get(key).is_some());
        Over::ALL.into_iter().filter(is_given).collect()
    }

    /// The ends of the range of a key of `[box]`; `None` where it is not given.
    pub(super) fn range_of(&self, key: &'static Key) -> Result<Option<[Quantity; 2]>, SceneError> {
        let Some(entry) = self.document.get(key) else {
            return Ok(None);
        };
        let Value::List(ends) = &entry.value else {
            return Err(self.wrong(key, entry, Allowed::Range.in_words()));
        };
        let [low, high] = ends.as_slice() else {
            return Err(self.wrong(key, entry, Allowed::Range.in_words()));
        };
        let over = Over::ALL.into_iter().find(|over| over.box_key() == Some(key));
        let end = |end| {
            let value = self.number_in(key, end)?;
            if over.is_some_and(is_restitution) && value.sign() == Ordering::Equal {
                return Err(self.wrong(key, end, ABOVE_0.to_owned()));
            }
            match over.and_then(|over| Some((over, over.key().allowed.instead_of(&value)?))) {
                Some((over, allowed)) => Err(self.wrong(key, end, format!("{allowed}, as {over} is"))),
                None => Ok(value),
            }
        };
        let ends = [end(low)?, end(high)?];
        if ends[0].compared_with(&ends[1]) == Ordering::Greater {
            return Err(self.wrong(key, entry, "from the lower number to the higher one".to_owned()));
        }
        Ok(Some(ends))
    }

    /// The range of a parameter in the box; where it has none, the value that it has.
    fn chosen_range(&self, over: Over) -> Result<Range, SceneError> {
        let enclosed = |value: &Quantity| value.value::<Interval>();
        let typed = over.box_key().map(|key| self.range_of(key)).transpose()?;
        Ok(match typed.flatten() {
            Some([low, high]) => Range {
                low: enclosed(&low),
                high: enclosed(&high),
            },
            None => {
                let value = self.number(over.key())?;
                if is_restitution(over) && value.sign() == Ordering::Equal {
                    return Err(self.wrong(over.key(), self.require(over.key(), None)?, ABOVE_0.to_owned()));
                }
                Range::held(enclosed(&value))
            }
        })
    }

    /// The devices of `[box]`, and what is asked of their motions.
    ///
    /// # Errors
    /// A key that is lacking or out of its range, two ranges of which one leaves the other unread.
    pub fn choice(&self) -> Result<BoxChoice, SceneError> {
        let chosen = self.chosen();
        let has = |over: Over| chosen.contains(&over);
        for (one, other, why) in [
            (Over::D, Over::ForcingAmplitude, "the capsule keeps its length"),
            (Over::G, Over::Incline, "g is given outright"),
        ] {
            if let (true, true, Some(key), Some(other)) = (has(one), has(other), one.box_key(), other.box_key()) {
                let allowed = format!("left out where {} is given, or that: {why}", other.path());
                return Err(self.wrong(key, self.require(key, None)?, allowed));
            }
        }
        let first = if has(Over::ForcingAmplitude) {
            Over::ForcingAmplitude
        } else {
            Over::D
        };
        let second = if has(Over::G) { Over::G } else { Over::Incline };
        let parameters = [first, second, Over::RB, Over::RT];
        let number = |key: &'static Key| Ok::<Interval, SceneError>(self.number(key)?.value());
        let (mass, frequency, pi) = (
            number(&key::CAPSULE_MASS)?,
            number(&key::ANGULAR_FREQUENCY)?,
            Interval::pi(),
        );
        let is_inclined = second == Over::Incline;
        let weight = is_inclined
            .then(|| Ok::<_, SceneError>(mass * number(&key::GRAVITY)?))
            .transpose()?;
        let per_force = pi / (mass * frequency);
        let (gap, unit, pull) = if first == Over::ForcingAmplitude {
            let length = number(&key::CAPSULE_LENGTH)?;
            let turns = frequency / pi;
            (
                Gap::HeldLength(length * mass * turns * turns),
                Unit::OfAmplitude(per_force),
                weight.map_or(Pull::Itself, Pull::InclinedOverAmplitude),
            )
        } else {
            let amplitude = number(&key::FORCING_AMPLITUDE)?;
            (
                Gap::Itself,
                Unit::Same(amplitude * per_force),
                weight.map_or(Pull::Itself, |weight| Pull::Inclined(weight / amplitude)),
            )
        };
        if is_inclined {
            self.one_gravity()?;
        }
        let (Unit::Same(scale) | Unit::OfAmplitude(scale)) = unit;
        if !(scale.is_positive() && scale.is_finite()) {
            let (name, found) = ("velocity unit", scale.midpoint());
            return Err(self.error(None, DeviceError::Scale { name, found }));
        }
        let [first, second, bottom, top] = parameters.map(|over| self.chosen_range(over));
        let or_nothing = |key: &'static Key| match self.document.get(key) {
            Some(_) => number(key),
            None => Ok(Interval::point(0.0)),
        };
        let words = self.words()?;
        let base = self.local_base()?;
        let is_local = !words.contains(&Word::pair()) || base.other_forcing().is_some();
        Ok(BoxChoice {
            has_other_words: !is_local && words.len() > 1,
            local: is_local.then_some(LocalChoice { words, base }),
            parameters,
            choice: Choice {
                devices: Devices {
                    gap,
                    pull,
                    unit,
                    membrane: self.membrane()?,
                },
                ranges: [first?, second?, bottom?, top?],
                max_periods: self.max_periods()?,
                margin: or_nothing(&key::BOX_MARGIN)?,
                clearance: or_nothing(&key::BOX_CLEARANCE)?,
            },
        })
    }
}

impl Scene {
    /// A motion under the forcing of the scene; its numbers are those of the choice.
    fn local_base(&self) -> Result<Motion<Interval<f64>>, SceneError> {
        let half = Interval::point(0.5);
        let harmonics = self.harmonics()?.map(|harmonics| harmonics.over_number());
        let motion = Motion::new(Interval::point(0.0), half, half, half).and_then(|motion| driven(motion, harmonics));
        motion.map_err(|error| self.error(None, error))
    }
}
