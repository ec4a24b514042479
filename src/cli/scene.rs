//! The scene of a command: SCENE, `--set`, `--strict`.

use super::source::{SourceProblem, TOML_AT_MOST};
use super::{Failure, Source, note};
use crate::scene::{self, BUILT_IN, Origin, Scene, Want};

/// The scene of a command, and how it is changed.
#[derive(Clone, Debug, clap::Args)]
pub struct SceneArguments {
    /// The scene: a TOML file, `-` for stdin, or a built-in name such as fig02
    #[arg(value_name = "SCENE")]
    scene: Source,
    /// Change a key of the scene, as in motion.d=0.3; once for each key. Lists need quotes: 'words=["BT", "BTT"]'
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Refuse a scene with keys that nothing asked for needs
    #[arg(long)]
    strict: bool,
}

impl SceneArguments {
    /// The scene with its overrides; nothing of it is checked yet but its syntax and its keys.
    pub fn load(&self) -> Result<Scene, Failure> {
        let mut scene = self.read()?;
        self.apply(&mut scene)?;
        Ok(scene)
    }

    /// The scene as the user named it.
    pub fn name(&self) -> String {
        self.scene.name()
    }

    /// Makes the overrides in a scene.
    pub fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        for argument in &self.set {
            scene.set(argument)?;
        }
        Ok(())
    }

    /// The scene, complete for `wants`. Under `--strict`, keys that neither these nor the scene's own wants require
    /// are an error.
    pub fn load_for(&self, wants: &[Want]) -> Result<Scene, Failure> {
        let scene = self.load()?;
        self.check(&scene, wants)?;
        Ok(scene)
    }

    /// Checks a scene that was loaded, as [`SceneArguments::load_for`] does.
    pub fn check(&self, scene: &Scene, wants: &[Want]) -> Result<(), Failure> {
        scene.check(wants)?;
        if self.strict {
            let mut all = wants.to_vec();
            all.extend(scene.want()?);
            scene.refuse_unneeded(&all)?;
        }
        let notes = scene.notes(wants)?.into_iter();
        for idle in notes.filter(|note| note.problem.is_some() || matches!(note.origin, Origin::Set(_))) {
            note(&format!("{}: nothing that is asked for requires {idle}", scene.name()));
        }
        if let Some(angle) = scene.phase_in_degrees(wants)? {
            note(&angle);
        }
        Ok(())
    }

    fn read(&self) -> Result<Scene, Failure> {
        let name = self.scene.name();
        if let (Source::File(_), Some(text)) = (&self.scene, scene::find(&name)) {
            return Ok(Scene::read(text, &name)?);
        }
        let text = self.scene.read(TOML_AT_MOST).map_err(|error| match error.problem {
            SourceProblem::Missing if is_name(&name) => unknown(&name),
            _ => error.into(),
        })?;
        Ok(Scene::read(&text, &name)?)
    }
}

/// Whether this looks like the name of a scene rather than a path.
fn is_name(text: &str) -> bool {
    !text.contains(['/', '\\', '.'])
}

/// There is no built-in scene of this name.
pub(super) fn unknown(name: &str) -> Failure {
    let known: Vec<&str> = BUILT_IN.iter().map(|(name, _)| *name).collect();
    Failure::UnknownScene {
        name: name.to_string(),
        meant: crate::tex::nearest(name, known.iter().copied())
            .map(|near| format!("did you mean {near}? "))
            .unwrap_or_default(),
        known: known.join(", "),
    }
}
