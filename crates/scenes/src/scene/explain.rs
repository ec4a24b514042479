//! What a scene will have modelled, and why, in words.

use super::document::Entry;
use super::key::{self, Allowed, Key, RangeKeys};
use super::plane::Plane;
use super::{Extent, Map, Over, Scene, SceneError, Want};
use dynamics::orbit::{OrbitOptions, Word};
use std::fmt::Write;

/// A key, and the wants that read it.
type Reader = (&'static Key, Vec<Want>);

impl Scene {
    /// For `wants`: the command that serves each, what will be modelled, each key that is read with its reason, and
    /// the keys that are left alone. `is_served` tells whether the program has the command.
    ///
    /// # Errors
    /// As [`Scene::check`].
    pub fn explain(&self, wants: &[Want], is_served: impl Fn(Want) -> bool) -> Result<String, SceneError> {
        self.check(wants)?;
        let mut text = match self.title()? {
            Some(title) => format!("{title} ({})\n", self.name()),
            None => format!("{}\n", self.name()),
        };
        let mut part = |title: &str, lines: Vec<String>| {
            if !lines.is_empty() {
                // Writing to a string cannot fail.
                let _ = write!(text, "\n{title}\n  {}\n", lines.join("\n  "));
            }
        };
        let wanted = wants.iter().map(|&want| {
            let lacking = if is_served(want) {
                ""
            } else {
                ", which this release lacks"
            };
            format!("{want}: {} (`vibro-audit {}`{lacking})", want.meaning(), want.command())
        });
        part("wanted", wanted.collect());
        part("modelled", self.modelled(wants)?);
        let readers = self.readers(wants)?;
        let (given, defaults): (Vec<&Reader>, Vec<&Reader>) =
            readers.iter().partition(|(key, _)| self.document.get(key).is_some());
        part("read", given.iter().filter_map(|reader| self.told(reader)).collect());
        let defaults: Vec<String> = defaults
            .iter()
            .map(|(key, wants)| {
                Ok(format!(
                    "{} = {}: {}, for {}",
                    key.path(),
                    self.default_of(key)?,
                    key.described(),
                    list(wants)
                ))
            })
            .collect::<Result<_, SceneError>>()?;
        part("not given, so taken as", defaults);
        let notes = self.notes(wants)?;
        part(
            "left alone, neither checked nor modelled, because nothing wanted requires it",
            notes.iter().map(ToString::to_string).collect(),
        );
        Ok(text)
    }

    /// Each key that the wants read, in the order of DESIGN.
    fn readers(&self, wants: &[Want]) -> Result<Vec<Reader>, SceneError> {
        let mut readers: Vec<Reader> = Vec::new();
        for &known in key::KEYS {
            let mut by = Vec::new();
            for &want in wants {
                if self.needs(want)?.keys().any(|key| key == known) {
                    by.push(want);
                }
            }
            if !by.is_empty() {
                readers.push((known, by));
            }
        }
        Ok(readers)
    }

    fn told(&self, (key, wants): &Reader) -> Option<String> {
        let Entry { shown, origin, .. } = self.document.get(key)?;
        Some(format!(
            "{} = {shown} ({origin}): {}, for {}",
            key.path(),
            key.described(),
            list(wants)
        ))
    }

    pub(super) fn default_of(&self, key: &'static Key) -> Result<String, SceneError> {
        Ok(match key {
            key if *key == key::WORDS => self.words()?.iter().map(Word::to_string).collect::<Vec<_>>().join(", "),
            key if *key == key::MAX_PERIODS => self.max_periods()?.to_string(),
            key if key.section == "map" => self.default_of_map(key)?,
            key if *key == key::LINES => self.plane()?.lines.to_string(),
            key if *key == key::DIGITS => self.digits()?.to_string(),
            key if *key == key::WALLS => "both".to_owned(),
            key if *key == key::SIDE => "bottom".to_owned(),
            key if *key == key::SWITCHES => "0".to_owned(),
            key if *key == key::Z => "at the wall".to_owned(),
            key if *key == key::COSINES && !self.document.has_section("forcing") => "[1]".to_owned(),
            key if key.section == "forcing" => "[]".to_owned(),
            key if *key == key::ERROR => "as many impacts as are given".to_owned(),
            key if *key == key::MOST_IMPACTS => self.diagram()?.most_impacts.to_string(),
            key if *key == key::BASINS_KEEP => self.start_grid()?.diagram.keep.to_string(),
            key if key.section == "box" && key.allowed == Allowed::Range => "one value".to_owned(),
            key if key.section == "box" => "0".to_owned(),
            key => self.default_option(key)?,
        })
    }

    /// The value that a key of `[options]` has where it is not given.
    fn default_option(&self, key: &'static Key) -> Result<String, SceneError> {
        let OrbitOptions {
            finest_cell,
            most_cells,
            most_cover_cells,
            most_covers,
            word_starts,
            branch_values,
            branch_starts,
            longest_step,
            shortest_step,
            most_steps,
            longest_word,
            settled,
            settling_impacts,
            resting_digits,
        } = self.options()?;
        let reals = [
            (&key::FINEST_CELL, finest_cell),
            (&key::LONGEST_STEP, longest_step),
            (&key::SHORTEST_STEP, shortest_step),
            (&key::SETTLED, settled),
        ];
        let counts = [
            (&key::MOST_CELLS, most_cells),
            (&key::MOST_COVER_CELLS, most_cover_cells),
            (&key::MOST_COVERS, most_covers),
            (&key::WORD_STARTS, word_starts),
            (&key::BRANCH_VALUES, branch_values),
            (&key::BRANCH_STARTS, branch_starts),
            (&key::MOST_STEPS, most_steps),
            (&key::LONGEST_WORD, longest_word),
            (&key::SETTLING_IMPACTS, settling_impacts),
            (&key::RESTING_DIGITS, resting_digits),
        ];
        let real = reals
            .iter()
            .find(|(own, _)| *own == key)
            .map(|(_, value)| format!("{value}"));
        let count = counts
            .iter()
            .find(|(own, _)| *own == key)
            .map(|(_, value)| value.to_string());
        Ok(real.or(count).unwrap_or_else(|| "nothing".to_owned()))
    }

    fn default_of_map(&self, key: &'static Key) -> Result<String, SceneError> {
        let Map { diagram, wants, .. } = self.map()?;
        Ok(match key {
            key if *key == key::MAP_KEEP => diagram.keep.to_string(),
            key if *key == key::MAP_BEGIN => diagram.start.name().to_owned(),
            key if *key == key::MAP_MOST_IMPACTS => diagram.most_impacts.to_string(),
            key if *key == key::MAP_STARTS => "[start]".to_owned(),
            key if *key == key::MAP_WANT => wants.iter().map(|want| want.name()).collect::<Vec<_>>().join(", "),
            _ => "as many impacts as are given".to_owned(),
        })
    }

    /// What the keys together make: the forcing, g, the scales, the sweep; and what is left out.
    fn modelled(&self, wants: &[Want]) -> Result<Vec<String>, SceneError> {
        let mut lines = Vec::new();
        if wants.iter().any(|&want| want != Want::Voltage) {
            lines.push(match self.motion_forcing()? {
                None => "forcing: cos(pi t + phase), of period 2".to_string(),
                Some(count) => format!("forcing: {count} harmonics of period 2"),
            });
            if !self.has_top()? {
                lines.push("walls: the bottom alone, at Z = 0".to_string());
            }
        }
        let (swept, at_rest): (Vec<Want>, Vec<Want>) = wants
            .iter()
            .filter(|want| !matches!(want, Want::Voltage | Want::Map | Want::Optimum))
            .filter(|want| **want != Want::Branch || !self.branches_over_two())
            .partition(|&&want| matches!(want, Want::Branch | Want::Sweep));
        let over = if swept.is_empty() {
            None
        } else {
            Some(self.over(RangeKeys::SWEEP.over, None)?)
        };
        let moves_g = matches!(over, Some(Over::Incline | Over::G | Over::ForcingAmplitude));
        if !at_rest.is_empty() || (over.is_some() && !moves_g) {
            let made = if self.has_device() {
                ", capsule_mass gravity sin(incline) / forcing_amplitude"
            } else {
                ""
            };
            lines.push(format!("gravity: g = {:.9}{made}", self.gravity::<f64>(&[])?));
        }
        if let (Some(over), true) = (over, moves_g) {
            lines.push(format!("gravity along the sweep: g at each {over}"));
        }
        if over.is_some() {
            lines.push(format!("sweep: {}", told_range(&self.sweep()?)));
        }
        if wants.contains(&Want::Branch) && self.branches_over_two() {
            let Plane { x, y, .. } = self.plane()?;
            let told = |Extent { over, from, to }: Extent| format!("{over} from {from} to {to}");
            lines.push(format!("curves of bifurcations over {} and {}", told(x), told(y)));
        }
        if wants.contains(&Want::Map) {
            let map = self.map()?;
            lines.push(format!("map along x: {}", told_range(&map.x)));
            lines.push(format!("map along y: {}", told_range(&map.y)));
            let wanted: Vec<&str> = map.wants.iter().map(|want| want.name()).collect();
            lines.push(format!(
                "at each point of the map, for each start: {}",
                wanted.join(", ")
            ));
        }
        if wants.contains(&Want::Basins) {
            let grid = self.start_grid()?;
            for (name, values) in [("phases", &grid.phase), ("velocities", &grid.velocity)] {
                let super::Spaced { from, to, points } = values;
                lines.push(format!("{name} of the starts: {points} from {from} to {to}"));
            }
        }
        if wants.contains(&Want::Optimum) {
            let names: Vec<&str> = self.chosen().into_iter().map(Over::name).collect();
            lines.push(format!("devices to choose from: every {} of the box", names.join(", ")));
        }
        let units = self.units(over, wants);
        if wants.contains(&Want::Voltage) {
            lines.push("membrane: its deformation and the voltage at each impact".to_string());
        } else if units.is_some() {
            lines.push("no membrane: no voltage is wanted".to_string());
        } else {
            lines.push("no membrane and no units: no voltage is wanted".to_string());
        }
        lines.extend(units);
        Ok(lines)
    }

    /// The harmonics of `[forcing]` that are not 0; `None` of the forcing of the paper.
    fn motion_forcing(&self) -> Result<Option<usize>, SceneError> {
        Ok(self.harmonics()?.map(|harmonics| harmonics.count()))
    }

    /// The units in which a voltage or a trajectory is given.
    fn units(&self, over: Option<Over>, wants: &[Want]) -> Option<String> {
        let of_voltage = wants.contains(&Want::Voltage);
        if of_voltage && over == Some(Over::ForcingAmplitude) {
            return Some("units: of length and velocity, at each forcing_amplitude".to_string());
        }
        if !(of_voltage || wants.contains(&Want::Trajectory)) {
            return None;
        }
        let scales = self.scales::<f64>().ok()?;
        let (length, velocity, time) = (scales.length, scales.velocity, scales.time);
        Some(format!(
            "units: length 1 is {length:.9} m, velocity 1 is {velocity:.9} m/s, time 1 is {time:.9} s"
        ))
    }
}

/// The distance between two values of a sweep.
fn step(sweep: &super::Sweep) -> f64 {
    let span = sweep.to.value::<f64>() - sweep.from.value::<f64>();
    let step = span / f64::from(sweep.points.saturating_sub(1));
    // Rounded for the eye: .4/400 is .001, whatever f64 says.
    format!("{step:.9e}").parse().unwrap_or(step)
}

fn told_range(range: &super::Sweep) -> String {
    let by = match range.points {
        1 => String::new(),
        _ => format!(", every {}", step(range)),
    };
    let super::Sweep { over, from, to, points } = range;
    format!("{over} from {from} to {to}, {points} values{by}")
}

fn list(wants: &[Want]) -> String {
    wants.iter().map(|want| want.name()).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::find;
    use super::*;

    fn explained(name: &str, sets: &[&str], wants: &[Want]) -> String {
        let mut scene = Scene::read(find(name).unwrap(), name).unwrap();
        for set in sets {
            scene.set(set).unwrap();
        }
        scene.explain(wants, |_| true).unwrap()
    }

    #[test]
    fn only_what_is_wanted_is_modelled() {
        let orbits = explained("fig03", &[], &[Want::Orbits]);
        for words in [
            "no membrane",
            "g = 0.122010000",
            "motion.d = 0.26 (line 15, column 5)",
            "digits = 12",
        ] {
            assert!(orbits.contains(words), "{words}\n{orbits}");
        }
        let (_, left_alone) = orbits.split_once("left alone").unwrap();
        for key in [
            "membrane.stiffness",
            "sweep.over",
            "start.phase",
            "device.angular_frequency",
        ] {
            assert!(left_alone.contains(key), "{key}\n{orbits}");
        }
        let map = r#"map={impacts = 80, x = {over = "d", from = 0.1, to = 0.5, points = 9}, y = {over = "r_b", from = 0.3, to = 0.9, points = 2}}"#;
        let basins = "basins={impacts = 80, phase = {from = 0, to = '2 pi', points = 9}, velocity = {from = 0, to = 1, points = 2}}";
        let all = explained("fig03", &[map, basins, "box={d = [0.1, 0.5]}"], &Want::ALL);
        assert!(all.contains("phases of the starts: 9 from 0 to 2 pi"), "{all}");
        assert!(all.contains("map along y: r_b from 0.3 to 0.9, 2 values"), "{all}");
        assert!(
            all.contains("8.032128514 m/s") && all.contains("every 0.001") && !all.contains("left alone"),
            "{all}"
        );
    }

    #[test]
    fn what_is_swept_is_not_read_from_its_own_key() {
        let text = explained(
            "fig03",
            &["sweep.over=incline", "sweep.from=0", "sweep.to=pi/3"],
            &[Want::Sweep],
        );
        assert!(text.contains("g at each incline"), "{text}");
        let (read, left_alone) = text.split_once("left alone").unwrap();
        assert!(
            read.contains("motion.d = 0.26") && left_alone.contains("device.incline"),
            "{text}"
        );
    }
}
