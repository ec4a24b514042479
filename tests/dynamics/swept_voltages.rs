//! The sweeps of Table 2 against certified values: what the simulation settles on from the paper's starts is the
//! certified orbit of that word, to the digits of f64. The two share no equation but (3) and (4).

use std::fs;
use vibro_audit::orbit::OrbitOptions;
use vibro_audit::reference::{Certified, Figures};
use vibro_audit::scene::{Scene, find};

/// How far a simulated mean may be from the certified one, relative to it: as far as a motion that counts as settled may
/// still be from where it tends to.
const ALLOWED: f64 = OrbitOptions::DEFAULT.settled;

const FILE: &str = "golden/paper/reference/sweeps.csv";

fn rows() -> Vec<Certified> {
    let text = fs::read_to_string(FILE).unwrap();
    Certified::read(FILE, &text).unwrap()
}

#[test]
fn the_simulated_mean_voltage_is_that_of_the_certified_orbit() {
    let rows = rows();
    assert!(rows.len() >= 50, "{} values", rows.len());
    for row in rows {
        let (id, name) = (row.record.field("id"), row.record.field("scene"));
        let name = name.trim_start_matches("scenes/").trim_end_matches(".toml");
        let mut scene = Scene::read(find(name).unwrap(), name).unwrap();
        for (key, value) in &row.setting.overrides {
            scene.set(&format!("{key}={value}")).unwrap();
        }
        let points: Vec<_> = scene.points().unwrap().collect();
        let [Ok(point)] = points.as_slice() else {
            panic!("{id}: one value is swept")
        };
        let attractor = point
            .settled
            .attractor
            .as_ref()
            .unwrap_or_else(|| panic!("{id}: settles"));
        assert!(row.setting.names_word(&attractor.word), "{id}: {}", attractor.word);
        let certified: f64 = row.record.field("value").parse().unwrap();
        assert!(Figures::read(row.record.field("value")).is_some_and(|figures| figures.count >= 30));
        let mean = point
            .means
            .as_ref()
            .and_then(|means| means.voltage)
            .map_or(f64::NAN, |mean| mean.value);
        assert!(
            (mean / certified - 1.0).abs() < ALLOWED,
            "{id}: {mean} V, certified {certified} V"
        );
    }
}

#[test]
fn every_figure_of_table_2_has_certified_values() {
    let rows = rows();
    for figure in 2..=10 {
        let scene = format!("scenes/fig{figure:02}.toml");
        let count = rows.iter().filter(|row| row.record.field("scene") == scene).count();
        assert!(count >= 3, "{scene}: {count}");
    }
}
