//! `vibro-audit check DIR --add ID ...`: a row of golden values from the command line.

use super::options::create_directory;
use super::source::TOML_AT_MOST;
use super::{Failure, Options, Source, golden, note};
use crate::reference::{Directory, Fault, Outcome, PRINTED, PRINTED_COLUMNS, Printed, Verdict, check_row};
use crate::report::DirectoryLock;
use crate::scene;
use std::collections::BTreeMap;
use std::path::Path;

/// A row of `printed.csv`, an argument for each of its columns.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "A row to add")]
pub struct RowToAdd {
    /// Compute this row and, if its verdict is the expected one, add it to DIR/printed.csv; DIR and its files are created where missing
    #[arg(long = "add", value_name = "ID", requires_all = ["directory", "place", "printed"], conflicts_with = "bless")]
    id: Option<String>,
    /// Where it is printed, such as 'Table 2'
    #[arg(long, value_name = "TEXT", requires = "id")]
    place: Option<String>,
    /// A built-in scene, or a file: one outside DIR is copied to DIR/scenes/
    #[arg(long, value_name = "SCENE", requires = "id")]
    scene: Option<String>,
    /// Change a key of the scene, as motion.d=0.4, or choose a row of the answer, as row.word=BT or row.d='near 0.25'
    #[arg(long, value_name = "KEY=VALUE", requires = "id")]
    set: Vec<String>,
    /// What it is a value of: COMMAND.COLUMN or COMMAND.COLUMN[n], such as orbits.velocities[0]
    #[arg(long, value_name = "QUANTITY", requires = "id")]
    quantity: Option<String>,
    /// The number as printed, with every figure; a range '(a, b)', '< b' or '> a'; a word
    #[arg(long, value_name = "VALUE", requires = "id", allow_hyphen_values = true)]
    printed: Option<String>,
    /// Its unit, for readers
    #[arg(long, value_name = "UNIT", requires = "id")]
    unit: Option<String>,
    /// The expected verdict: reproduced, truncated, off-by-one, rounded, wrong or undetermined (doc/reference/golden.md explains them)
    #[arg(long, value_name = "VERDICT", requires = "id", default_value = Verdict::Reproduced.name())]
    expected: String,
    /// An assumption that the paper does not state, as 'A = 5 N'
    #[arg(long, value_name = "TEXT", requires = "id")]
    rests_on: Option<String>,
    /// A remark for readers
    #[arg(long, value_name = "TEXT", requires = "id")]
    note: Option<String>,
}

impl RowToAdd {
    /// Whether one is to be added.
    pub fn is_added(&self) -> bool {
        self.id.is_some()
    }

    /// Computes the row and adds it where its verdict is the expected one; nothing where none is to be added.
    ///
    /// # Errors
    /// What is there cannot be read, what is given makes no row, or a file cannot be written. Then nothing is.
    pub fn add(&self, directory: Option<&Path>, options: &Options) -> Result<Option<Outcome>, Failure> {
        let (Some(id), Some(path)) = (&self.id, directory) else {
            return Ok(None);
        };
        // from what is read to what is written nobody else writes there
        let _lock = lock(path)?;
        let there = Directory::At(path.to_owned());
        let file = path.join(PRINTED);
        options.member(file.clone())?;
        let before = match file.exists() {
            true => there.read(PRINTED)?,
            false => String::new(),
        };
        let (scene, copied) = self.scene(&there, path)?;
        let fields: Vec<String> = PRINTED_COLUMNS
            .iter()
            .map(|column| self.field(column, &scene))
            .collect();
        let text = Printed::with_row(&before, &fields)?;
        let of_row = |fault: Fault| match (before.is_empty(), there.printed()) {
            // that what is there makes no sense is no fault of the row
            (false, Err(fault)) => fault,
            _ => fault.without_line(),
        };
        let rows = Printed::read("--add", &text).map_err(of_row)?;
        let row = rows.last().ok_or_else(|| Fault::of_file("--add", "it is no row"))?;
        let line = row.record.line;
        let mut files = BTreeMap::from_iter(copied);
        let draft = Directory::Draft(path.to_owned(), files.clone());
        let mut compute = |request: &_| golden::answer(&draft, request, options).map_err(|failure| failure.to_string());
        let outcome = check_row(row, &rows, &mut compute).map_err(Fault::without_line)?;
        if !outcome.is_expected() {
            note(&not_added(id, outcome.verdict));
            return Ok(Some(outcome));
        }
        files.insert(PRINTED.to_owned(), text);
        let mut outputs = Vec::new();
        // the row last: no row stands without its scene
        for (name, text) in files.iter().rev() {
            let place = path.join(name);
            create_directory(place.parent().unwrap_or(path))?;
            outputs.push((options.member(place)?, text));
        }
        for (output, text) in outputs {
            output.write(|to| to.write_all(text.as_bytes()))?;
        }
        for name in files.keys().filter(|name| *name != PRINTED) {
            note(&format!("the scene is copied to {}", path.join(name).display()));
        }
        note(&format!("`{id}` is line {line} of {}", file.display()));
        Ok(Some(outcome))
    }

    fn field(&self, column: &str, scene: &str) -> String {
        let text = match column {
            "id" => self.id.as_deref(),
            "place" => self.place.as_deref(),
            "scene" => Some(scene),
            "set" => return self.set.join(";"),
            "quantity" => self.quantity.as_deref(),
            "printed" => self.printed.as_deref(),
            "unit" => self.unit.as_deref(),
            "expected" => Some(&*self.expected),
            "rests_on" => self.rests_on.as_deref(),
            "note" => self.note.as_deref(),
            _ => None,
        };
        text.unwrap_or_default().to_owned()
    }

    /// How the row names its scene, and the file that is to be copied for it: the directory stands alone.
    fn scene(&self, there: &Directory, directory: &Path) -> Result<(String, Option<(String, String)>), Failure> {
        let given = self.scene.as_deref().unwrap_or_default();
        let path = Path::new(given);
        let as_it_is = (given.to_owned(), None);
        if given.is_empty() || scene::find(given).is_some() || there.has(given) || !path.is_file() {
            return Ok(as_it_is);
        }
        if let (Ok(place), Ok(directory)) = (path.canonicalize(), directory.canonicalize())
            && let Ok(within) = place.strip_prefix(directory)
        {
            return Ok((within.display().to_string(), None));
        }
        let Some(name) = path.file_name() else {
            return Ok(as_it_is);
        };
        let name = format!("scenes/{}", name.to_string_lossy());
        let text = Source::File(path.to_owned()).read(TOML_AT_MOST)?;
        let there = directory.join(&name);
        if !there.exists() {
            return Ok((name.clone(), Some((name, text))));
        }
        match Source::File(there.clone()).read(TOML_AT_MOST)? == text {
            true => Ok((name, None)),
            false => Err(Failure::OtherScene {
                there: there.display().to_string(),
                given: given.to_owned(),
            }),
        }
    }
}

/// Locks a directory of golden values; waits while another command writes it.
pub(super) fn lock(directory: &Path) -> Result<DirectoryLock, Failure> {
    let tell = || note(&format!("waiting for another run that writes {}", directory.display()));
    Ok(DirectoryLock::acquire(directory, tell)?)
}

fn not_added(id: &str, verdict: Verdict) -> String {
    match Verdict::EXPECTED.contains(&verdict) {
        true => format!("`{id}` is not added: it is {verdict}; to add it as that, --expected {verdict}"),
        false => format!("`{id}` is not added: it is {verdict}, which no row may expect"),
    }
}
