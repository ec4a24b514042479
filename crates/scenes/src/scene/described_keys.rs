//! Every key of a scene for a reader: what it is, its unit, range, default and an example.

use super::key::{self, Key};
use super::{Scene, SceneError, Want};

/// The description of a key for a reader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyDescription {
    /// Its section; empty above the sections.
    pub section: &'static str,
    pub name: &'static str,
    pub meaning: &'static str,
    /// Empty for what has none.
    pub unit: &'static str,
    /// The allowed values in words.
    pub range: String,
    /// The default; none where the key is required, by every want that reads it or by one of them.
    pub default: Option<String>,
    /// A value, as TOML has it.
    pub example: &'static str,
}

/// A scene that wants everything, of the keys without a default alone.
const EVERYTHING: &str = r#"
device = { capsule_mass = 0.1245, forcing_amplitude = 5.0, angular_frequency = "5 pi", incline = "pi/6", gravity = 9.8 }
motion = { d = 0.26, r_b = 0.6, r_t = 0.3 }
start = { phase = 6.18, velocity = 0.5293 }
sweep = { over = "d", from = 0.1, to = 0.5, points = 401, impacts = 500, keep = 60, start = "each" }
box = { d = [0.1, 0.5] }
[membrane]
ball_mass = 0.0035
stiffness = 4.0847e5
exponent = 2.6
ball_radius = 0.005
membrane_radius = 0.0063
input_voltage = 2000.0
[map]
x = { over = "d", from = 0.1, to = 0.5, points = 201 }
y = { over = "r_b", from = 0.3, to = 0.9, points = 121 }
impacts = 500
[branch]
x = { over = "d", from = 0.1, to = 0.6 }
y = { over = "r_b", from = 0.2, to = 0.8 }
[basins]
phase = { from = 0, to = "2 pi", points = 41 }
velocity = { from = 0, to = 1.5, points = 21 }
impacts = 1000
"#;

/// Returns every key, in order.
///
/// # Errors
/// None: a test reads them.
pub fn described_keys() -> Result<Vec<KeyDescription>, SceneError> {
    let scene = Scene::read(EVERYTHING, "everything")?;
    let (mut required, mut optional): (Vec<&Key>, Vec<&Key>) = (Vec::new(), vec![&key::G]);
    for want in Want::ALL {
        let need = scene.needs(want)?;
        required.extend(need.required);
        optional.extend(need.optional);
    }
    let described = |key: &&'static Key| {
        let default = match optional.contains(key) && !required.contains(key) {
            true if **key == key::G => Some("from `[device]`".to_owned()),
            true => Some(scene.default_of(key)?),
            false => None,
        };
        Ok(KeyDescription {
            section: key.section,
            name: key.name,
            meaning: key.meaning,
            unit: key.unit,
            range: key.range(),
            default,
            example: key.example,
        })
    };
    key::KEYS.iter().map(described).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_is_a_value_that_its_key_may_have() {
        for key in key::KEYS {
            let mut scene = Scene::read("", "examples").unwrap();
            let set = format!("{}={}", key.path(), key.example);
            scene.set(&set).unwrap_or_else(|error| panic!("{set}: {error}"));
            scene.check_key(key).unwrap_or_else(|error| panic!("{set}: {error}"));
        }
    }

    #[test]
    fn a_scene_of_everything_gives_no_key_that_has_a_default() {
        let scene = Scene::read(EVERYTHING, "everything").unwrap();
        scene.check(&Want::ALL).unwrap();
        let given = described_keys().unwrap().into_iter().filter(|key| {
            let known = Key::find(key.section, key.name).unwrap();
            scene.entries().any(|(own, _)| own == known) && key.default.is_some()
        });
        // of a box one range must be given
        let given: Vec<&str> = given.map(|key| key.section).collect();
        assert_eq!(given, ["box"]);
    }
}
