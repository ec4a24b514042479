//! The scenes that the program carries with it: golden/paper/scenes/, one for each figure with computed results.

use super::{Scene, SceneError};

/// Name and TOML of every built-in scene, in the order of the paper.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("fig02", include_str!("../../golden/paper/scenes/fig02.toml")),
    ("fig03", include_str!("../../golden/paper/scenes/fig03.toml")),
    ("fig04", include_str!("../../golden/paper/scenes/fig04.toml")),
    ("fig05", include_str!("../../golden/paper/scenes/fig05.toml")),
    ("fig06", include_str!("../../golden/paper/scenes/fig06.toml")),
    ("fig07", include_str!("../../golden/paper/scenes/fig07.toml")),
    ("fig08", include_str!("../../golden/paper/scenes/fig08.toml")),
    ("fig09", include_str!("../../golden/paper/scenes/fig09.toml")),
    ("fig10", include_str!("../../golden/paper/scenes/fig10.toml")),
    ("fig11", include_str!("../../golden/paper/scenes/fig11.toml")),
    ("fig12", include_str!("../../golden/paper/scenes/fig12.toml")),
    ("fig13", include_str!("../../golden/paper/scenes/fig13.toml")),
    ("fig14", include_str!("../../golden/paper/scenes/fig14.toml")),
];

/// The TOML of the built-in scene of this name.
pub fn find(name: &str) -> Option<&'static str> {
    BUILT_IN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Every built-in scene, read.
///
/// # Errors
/// None: a test reads the embedded text.
pub fn built_in() -> Result<Vec<Scene>, SceneError> {
    BUILT_IN.iter().map(|(name, text)| Scene::read(text, name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::model::Side;
    use numbers::{Analytic, Wide};

    #[test]
    fn every_scene_is_complete_for_what_it_wants_and_has_nothing_else() {
        let scenes = built_in().unwrap();
        assert_eq!(scenes.len(), 13);
        for scene in &scenes {
            let wants = scene.want().unwrap();
            assert!(
                !wants.is_empty() && scene.title().unwrap().is_some(),
                "{}",
                scene.name()
            );
            scene.check(&wants).unwrap();
            scene.refuse_unneeded(&wants).unwrap();
        }
    }

    #[test]
    fn the_paper_s_g_is_the_one_its_printed_velocities_imply() {
        // (9) and (11) added on a 1-1 orbit: 2 g = (1 + r_B) v_k + (1 + r_T) v_k+1; FACTS of Figs. 3 and 8 at d = .5
        for (name, bottom, top) in [
            ("fig03", 0.886_872_082_6, -0.903_827_178_6),
            ("fig08", 0.947_189_536_0, -0.840_652_476_6),
        ] {
            let scene = Scene::read(find(name).unwrap(), name).unwrap();
            let motion = scene.motion::<f64>().unwrap();
            let implied =
                (1.0 + motion.restitution(Side::Bottom)) * bottom + (1.0 + motion.restitution(Side::Top)) * top;
            assert!((motion.g() - implied / 2.0).abs() < 1e-9, "{name}");
        }
    }

    #[test]
    fn forty_digits_start_from_what_is_printed_not_from_its_f64() {
        let scene = Scene::read(find("fig12").unwrap(), "fig12").unwrap();
        let motion = scene.motion::<Wide<40>>().unwrap();
        let wide = |n: f64, d: f64| Wide::<40>::from_f64(n) / Wide::from_f64(d);
        let g = wide(1245.0, 10_000.0) * wide(98.0, 10.0) / wide(10.0, 1.0); // sin(pi/6) = 1/2, A = 5
        assert!((motion.g().clone() - g).to_f64().abs() < 1e-39);
        assert!((motion.d().clone() - wide(33.0, 100.0)).to_f64().abs() < 1e-39);
    }
}
