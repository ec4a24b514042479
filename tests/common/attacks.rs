//! The sheets of `tests/attacks`, and the truth that stands in the first lines of each.

use std::path::Path;
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use vibro_audit::claim::{Fault, Sheet, vocabulary};
use vibro_audit::prove::{Decision, Options, decide};

/// A sheet as it stands in the file of its class, behind a line `=== NAME`.
pub struct Attack {
    pub class: String,
    pub name: String,
    pub text: String,
}

impl Attack {
    /// Returns its name in messages: `domains/below-a-root`.
    pub fn path(&self) -> String {
        format!("{}/{}", self.class, self.name)
    }

    pub fn read(&self) -> Result<Sheet, Fault> {
        Sheet::read(&self.text, &vocabulary().unwrap())
    }

    /// The truth that its first lines say of one claim by its label, or of the last.
    pub fn truth(&self, label: &str, is_last: bool) -> Option<String> {
        self.said("truth", label, is_last)
    }

    /// Returns true if it says that one claim has no value at any point.
    pub fn has_no_points(&self, label: &str, is_last: bool) -> bool {
        self.said("points", label, is_last).as_deref() == Some("none")
    }

    fn said(&self, of_what: &str, label: &str, is_last: bool) -> Option<String> {
        let of = |prefix: &str| {
            let mut lines = self.text.lines();
            lines
                .find_map(|line| line.strip_prefix(prefix))
                .map(|word| word.trim().to_string())
        };
        of(&format!("# {of_what} {label}:")).or_else(|| if is_last { of(&format!("# {of_what}:")) } else { None })
    }
}

/// All sheets, in order.
pub fn all() -> Vec<Attack> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/attacks");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|end| end == "sheets"))
        .collect();
    files.sort();
    let mut found = Vec::new();
    for path in files {
        let class = path.file_stem().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        for part in format!("\n{text}").split("\n=== ").skip(1) {
            let (name, text) = part.split_once('\n').unwrap();
            found.push(Attack {
                class: class.clone(),
                name: name.to_owned(),
                text: text.to_owned(),
            });
        }
    }
    found
}

/// The sheets that this run takes: some, chosen by name; all of them where corpora are run whole.
pub fn sampled() -> Vec<Attack> {
    all()
        .into_iter()
        .filter(|attack| super::sample::takes(&attack.path(), 5))
        .collect()
}

/// A sheet with what is decided of each of its claims, by position, and the time that it took.
pub struct Decided {
    pub attack: Attack,
    pub sheet: Result<Sheet, Fault>,
    pub decisions: Vec<(usize, Decision, Duration)>,
}

/// The sheets of this run, decided once for all tests.
pub fn decided() -> &'static [Decided] {
    static DECIDED: OnceLock<Vec<Decided>> = OnceLock::new();
    DECIDED.get_or_init(|| {
        let of = |attack: Attack| {
            let sheet = attack.read();
            let decision = |position: usize, sheet: &Sheet| {
                let start = Instant::now();
                let decision = decide(sheet, position, &Options::default());
                (position, decision, start.elapsed())
            };
            let decisions = sheet.iter().flat_map(|sheet| {
                let claims = (0..sheet.entries.len()).filter(|&position| sheet.is_claim(position));
                claims.map(|position| decision(position, sheet))
            });
            Decided {
                decisions: decisions.collect(),
                attack,
                sheet,
            }
        };
        use rayon::prelude::*;
        sampled().into_par_iter().map(of).collect()
    })
}
