//! What each want requires of a scene, and what nothing requires.

use super::document::Entry;
use super::error::{Origin, SceneError, SceneProblem};
use super::key::{self, DiagramKeys, ExtentKeys, Key, RangeKeys, SpacedKeys};
use super::{Over, Scene, Want};
use std::fmt;

/// Keys that a want reads.
pub(super) struct Need {
    /// Those that must be there.
    pub required: Vec<&'static Key>,
    /// Those that have a default.
    pub optional: Vec<&'static Key>,
}

impl Need {
    /// Every key of it.
    pub fn keys(&self) -> impl Iterator<Item = &'static Key> {
        self.required.iter().chain(&self.optional).copied()
    }
}

/// A known key that nothing requires.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The key with its section.
    pub key: String,
    /// Where it was given.
    pub origin: Origin,
    /// What is wrong with its value, which does no harm here.
    pub problem: Option<String>,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.key, self.origin)?;
        match &self.problem {
            Some(problem) => write!(f, ": {problem}"),
            None => Ok(()),
        }
    }
}

/// The keys that give g from the device, in the order of DESIGN.
const DEVICE_G: [&Key; 4] = [
    &key::CAPSULE_MASS,
    &key::FORCING_AMPLITUDE,
    &key::INCLINE,
    &key::GRAVITY,
];
/// The keys that give the units of length, velocity and time.
const SCALES: [&Key; 3] = [&key::CAPSULE_MASS, &key::FORCING_AMPLITUDE, &key::ANGULAR_FREQUENCY];
const START: [&Key; 2] = [&key::PHASE, &key::VELOCITY];
/// What says more of a start, and of the motion, where it is given.
const START_OPTIONS: [&Key; 2] = [&key::SIDE, &key::Z];
const MOTION_OPTIONS: [&Key; 3] = [&key::WALLS, &key::COSINES, &key::SINES];
const MEMBRANE: [&Key; 6] = [
    &key::BALL_MASS,
    &key::STIFFNESS,
    &key::EXPONENT,
    &key::BALL_RADIUS,
    &key::MEMBRANE_RADIUS,
    &key::INPUT_VOLTAGE,
];

/// What sets how motions at one value are looked for, how they are followed over a range, and what runs come to.
const ORBIT_OPTIONS: [&Key; 3] = [&key::FINEST_CELL, &key::MOST_CELLS, &key::WORD_STARTS];
const BRANCH_OPTIONS: [&Key; 8] = [
    &key::SWITCHES,
    &key::MOST_COVER_CELLS,
    &key::MOST_COVERS,
    &key::BRANCH_VALUES,
    &key::BRANCH_STARTS,
    &key::LONGEST_STEP,
    &key::SHORTEST_STEP,
    &key::MOST_STEPS,
];
const LONG_RUN_OPTIONS: [&Key; 4] = [
    &key::LONGEST_WORD,
    &key::SETTLED,
    &key::SETTLING_IMPACTS,
    &key::RESTING_DIGITS,
];

impl Key {
    /// Whether g comes from this key.
    pub(super) fn gives_g(&self) -> bool {
        [&key::INCLINE, &key::GRAVITY, &key::G].contains(&self)
    }
}

impl Over {
    /// The key whose place the sweep takes; of both restitutions, the first.
    pub(super) fn key(self) -> &'static Key {
        match self {
            Self::D => &key::D,
            Self::RB | Self::R => &key::R_B,
            Self::RT => &key::R_T,
            Self::Incline => &key::INCLINE,
            Self::G => &key::G,
            Self::ForcingAmplitude => &key::FORCING_AMPLITUDE,
        }
    }

    /// Whether the sweep takes the place of a key.
    pub(super) fn takes(self, key: &Key) -> bool {
        self.key() == key || (self == Self::R && *key == key::R_T)
    }

    /// The key of its range in a box; none of both restitutions, which have a range each there.
    pub(super) fn box_key(self) -> Option<&'static Key> {
        match self {
            Self::D => Some(&key::BOX_D),
            Self::RB => Some(&key::BOX_R_B),
            Self::RT => Some(&key::BOX_R_T),
            Self::R => None,
            Self::Incline => Some(&key::BOX_INCLINE),
            Self::G => Some(&key::BOX_G),
            Self::ForcingAmplitude => Some(&key::BOX_FORCING_AMPLITUDE),
        }
    }
}

impl Scene {
    /// What `want` reads of this scene.
    ///
    /// # Errors
    /// A sweep over something that cannot be swept.
    pub(super) fn needs(&self, want: Want) -> Result<Need, SceneError> {
        let swept = match want {
            Want::Branch if self.branches_over_two() => {
                let over = |keys: ExtentKeys| self.over(keys.over, Some(want));
                vec![over(ExtentKeys::X)?, over(ExtentKeys::Y)?]
            }
            Want::Branch | Want::Sweep => vec![self.over(RangeKeys::SWEEP.over, Some(want))?],
            Want::Map => {
                let over = |keys: RangeKeys| self.over(keys.over, Some(want));
                vec![over(RangeKeys::X)?, over(RangeKeys::Y)?]
            }
            Want::Optimum => self.chosen(),
            _ => Vec::new(),
        };
        let (mut required, mut optional) = (Vec::new(), vec![&key::DIGITS]);
        match want {
            Want::Orbits => {
                optional.extend([&key::WORDS, &key::MAX_PERIODS]);
                optional.extend(ORBIT_OPTIONS);
            }
            Want::Branch => {
                optional.extend([&key::WORDS, &key::MAX_PERIODS]);
                optional.extend(ORBIT_OPTIONS);
                optional.extend(BRANCH_OPTIONS);
                if self.branches_over_two() {
                    required.extend(ExtentKeys::X.all().into_iter().chain(ExtentKeys::Y.all()));
                    optional.push(&key::LINES);
                } else {
                    required.extend(RangeKeys::SWEEP.all());
                }
            }
            Want::Impacts => {
                required.extend(START);
                optional.extend(START_OPTIONS);
            }
            Want::Trajectory => {
                required.extend(START);
                optional.extend(START_OPTIONS);
                // with a frequency the device gives its motion in SI too
                if self.has_device() {
                    optional.push(&key::ANGULAR_FREQUENCY);
                }
            }
            Want::Sweep => {
                required.extend(RangeKeys::SWEEP.all());
                let DiagramKeys {
                    impacts,
                    keep,
                    begin,
                    error,
                    most_impacts,
                } = DiagramKeys::SWEEP;
                required.extend([impacts, keep, begin]);
                optional.extend([error, most_impacts]);
                optional.extend(LONG_RUN_OPTIONS);
                required.extend(START);
                optional.extend(START_OPTIONS);
            }
            Want::Map => {
                required.extend(RangeKeys::X.all());
                required.extend(RangeKeys::Y.all());
                let DiagramKeys {
                    impacts,
                    keep,
                    begin,
                    error,
                    most_impacts,
                } = DiagramKeys::MAP;
                required.push(impacts);
                optional.extend([keep, begin, error, most_impacts, &key::MAP_WANT, &key::MAP_STARTS]);
                optional.extend(LONG_RUN_OPTIONS);
                if !self.has_starts() {
                    required.extend(START);
                    optional.extend(START_OPTIONS);
                }
                if self.wants_of_map()?.iter().any(|want| want.is_voltage()) {
                    required.extend(MEMBRANE);
                    let replaced = |key: &&Key| swept.iter().any(|over| over.takes(key));
                    required.extend(SCALES.into_iter().filter(|key| !replaced(key)));
                }
            }
            Want::Basins => {
                required.extend(SpacedKeys::PHASE.all());
                required.extend(SpacedKeys::VELOCITY.all());
                required.push(&key::BASINS_IMPACTS);
                optional.push(&key::BASINS_KEEP);
                optional.extend(LONG_RUN_OPTIONS);
                if self.serves_voltage()? {
                    required.extend(MEMBRANE);
                    required.extend(SCALES);
                }
            }
            Want::Optimum => {
                if swept.is_empty() {
                    required.push(&key::BOX_D);
                }
                optional.extend(Over::ALL.into_iter().filter_map(Over::box_key));
                optional.extend([&key::WORDS, &key::MAX_PERIODS, &key::BOX_MARGIN, &key::BOX_CLEARANCE]);
                required.extend(MEMBRANE);
                let is_free = |over: Over| swept.contains(&over);
                required.extend(
                    SCALES
                        .into_iter()
                        .filter(|key| !(is_free(Over::ForcingAmplitude) && **key == key::FORCING_AMPLITUDE)),
                );
                if is_free(Over::ForcingAmplitude) {
                    required.push(&key::CAPSULE_LENGTH);
                }
            }
            Want::Voltage => {
                optional.clear();
                required.extend(MEMBRANE);
                // Along a sweep the scales are those of its values.
                let is_swept = matches!(self.over(RangeKeys::SWEEP.over, None), Ok(Over::ForcingAmplitude));
                let given = |key: &&Key| !(is_swept && **key == key::FORCING_AMPLITUDE);
                required.extend(SCALES.into_iter().filter(given));
            }
        }
        if want != Want::Voltage {
            let holds_length = want == Want::Optimum && swept.contains(&Over::ForcingAmplitude);
            optional.extend(MOTION_OPTIONS);
            let keys = self.motion_keys(&swept).into_iter();
            required.extend(keys.filter(|key| !(holds_length && **key == key::D)));
        }
        Ok(Need { required, optional })
    }

    /// What the motion is made of, where `swept` come from elsewhere.
    pub(super) fn motion_keys(&self, swept: &[Over]) -> Vec<&'static Key> {
        let is_swept = |over| swept.contains(&over);
        let gravity: &[&'static Key] = if is_swept(Over::G) {
            &[]
        } else if is_swept(Over::Incline) || is_swept(Over::ForcingAmplitude) || self.has_device() {
            &DEVICE_G
        } else {
            &[&key::G]
        };
        // what is no choice of walls is told where that is read
        let walls: &[&'static Key] = match self.has_top() {
            Ok(false) => &[&key::R_B],
            _ => &[&key::D, &key::R_B, &key::R_T],
        };
        walls
            .iter()
            .copied()
            .chain(gravity.iter().copied())
            .filter(|&key| !swept.iter().any(|over| over.takes(key)))
            .collect()
    }

    /// Checks all that `wants` require and nothing else.
    ///
    /// # Errors
    /// The first key that is lacking or holds what it may not.
    pub fn check(&self, wants: &[Want]) -> Result<(), SceneError> {
        for &want in wants {
            let need = self.needs(want)?;
            self.require_all(&need.required, want)?;
            for key in need.keys() {
                self.check_key(key)?;
            }
            self.refuse_other_motions(want)?;
            match want {
                Want::Impacts | Want::Trajectory => self.check_place()?,
                Want::Branch if self.branches_over_two() => drop(self.plane()?),
                Want::Branch => drop(self.sweep()?),
                Want::Sweep => {
                    self.sweep()?;
                    self.diagram()?;
                }
                Want::Voltage => {
                    self.membrane::<f64>()?;
                }
                Want::Map => drop(self.map()?),
                Want::Basins => drop(self.start_grid()?),
                Want::Optimum => {
                    self.choice()?;
                }
                _ => {}
            }
            if need
                .required
                .iter()
                .any(|key| DEVICE_G.contains(key) || **key == key::G)
                && want != Want::Voltage
            {
                self.one_gravity()?;
            }
        }
        Ok(())
    }

    /// Refuses what is known of two walls alone, and a parameter that one wall does not have.
    fn refuse_other_motions(&self, want: Want) -> Result<(), SceneError> {
        if want == Want::Voltage {
            return Ok(());
        }
        let swept = match want {
            Want::Sweep => vec![&key::OVER],
            Want::Branch if self.branches_over_two() => vec![ExtentKeys::X.over, ExtentKeys::Y.over],
            Want::Branch => vec![&key::OVER],
            Want::Map => vec![&key::X_OVER, &key::Y_OVER],
            _ => Vec::new(),
        };
        for key in swept {
            let over = self.over(key, Some(want))?;
            if !self.has_top()? && matches!(over, Over::D | Over::RT | Over::R) {
                let allowed = "a parameter of one wall: motion.walls leaves r_b, g, incline and forcing_amplitude";
                return Err(self.wrong(key, self.require(key, None)?, allowed.to_owned()));
            }
        }
        if want != Want::Optimum {
            return Ok(());
        }
        match self.document.get(&key::WALLS) {
            Some(entry) if !self.has_top()? => {
                let allowed = format!("both: {want} is of two walls");
                Err(self.wrong(&key::WALLS, entry, allowed))
            }
            _ => Ok(()),
        }
    }

    /// Refuses a scene that lacks keys of a want, by all of these.
    fn require_all(&self, keys: &[&'static Key], want: Want) -> Result<(), SceneError> {
        let missing: Vec<&Key> = keys
            .iter()
            .copied()
            .filter(|key| self.document.get(key).is_none())
            .collect();
        let Some(first) = keys.iter().find(|key| self.document.get(key).is_none()) else {
            return Ok(());
        };
        let mut error = match self.require(first, Some(want)) {
            Ok(_) => return Ok(()),
            Err(error) => error,
        };
        if let (SceneProblem::Missing { where_to, .. }, [_, others @ ..]) = (&mut *error.problem, missing.as_slice())
            && !others.is_empty()
        {
            let others: Vec<String> = others
                .iter()
                .map(|key| format!("{} ({})", key.path(), key.described()))
                .collect();
            where_to.push_str(&format!("; and {}", others.join(", ")));
        }
        Err(error)
    }

    /// The known keys that none of `wants` requires. They are left alone.
    ///
    /// # Errors
    /// As [`Scene::check`].
    pub fn notes(&self, wants: &[Want]) -> Result<Vec<Note>, SceneError> {
        let unneeded = self.unneeded(wants)?;
        Ok(unneeded
            .into_iter()
            .map(|(key, entry)| Note {
                key: key.path(),
                origin: entry.origin.clone(),
                problem: self.check_key(key).err().map(|error| error.problem.to_string()),
            })
            .collect())
    }

    /// What to say of a phase that was probably meant in degrees: a number without pi that is more than a turn.
    ///
    /// # Errors
    /// As [`Scene::check`].
    pub fn phase_in_degrees(&self, wants: &[Want]) -> Result<Option<String>, SceneError> {
        let mut is_read = false;
        for &want in wants {
            is_read |= self.needs(want)?.keys().any(|key| *key == key::PHASE);
        }
        if !is_read || self.document.get(&key::PHASE).is_none() {
            return Ok(None);
        }
        let phase = self.number(&key::PHASE)?;
        let is_large = phase.rational().is_some() && phase.value::<f64>().abs() > std::f64::consts::TAU;
        Ok(is_large.then(|| {
            format!(
                "{} is {phase} rad, {:.6} within a turn; {phase} degrees are \"{phase} pi/180\"",
                key::PHASE.path(),
                phase.angle::<f64>()
            )
        }))
    }

    fn unneeded(&self, wants: &[Want]) -> Result<Vec<(&'static Key, &Entry)>, SceneError> {
        let mut needed = vec![&key::TITLE, &key::WANT];
        for &want in wants {
            needed.extend(self.needs(want)?.keys());
        }
        Ok(self.entries().filter(|(key, _)| !needed.contains(key)).collect())
    }

    /// What `--strict` asks: that there is no key that none of `wants` requires.
    ///
    /// # Errors
    /// The first such key.
    pub fn refuse_unneeded(&self, wants: &[Want]) -> Result<(), SceneError> {
        match self.unneeded(wants)?.first() {
            None => Ok(()),
            Some((key, entry)) => {
                let problem = SceneProblem::Unneeded(key.path());
                Err(self.error(Some(entry.origin.clone()), problem))
            }
        }
    }
}
