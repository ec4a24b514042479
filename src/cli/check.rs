//! `vibro-audit check [DIR] [--add ID ... | --bless]`.

use super::audit_table::Unusable;
use super::caller::quietly;
use super::outcomes::table;
use super::progress::Progress;
use super::{Answer, Content, Exit, Failure, Options, added, golden, note};
use crate::reference::{Certified, Directory, Outcome, bless, check};
use crate::report::{Cell, Format, Output, Page, Part, Table, note_input};
use std::path::PathBuf;

/// Compare printed numbers with computed ones: the paper's, or those of your directory
#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Arguments {
    /// A directory with printed.csv, and scenes/ and reference/ where its rows name them; without it, the paper's
    #[arg(value_name = "DIR")]
    directory: Option<PathBuf>,
    /// Recompute the files in DIR/reference and overwrite them; printed.csv is never changed
    #[arg(long)]
    pub(super) bless: bool,
    #[command(flatten)]
    row: added::RowToAdd,
}

/// How to begin a directory.
const EXAMPLE: &str = "\
A directory of your own begins with its first row, which says what is printed where, and what it is a value of:
  vibro-audit check golden/mine --add table2-bottom --place 'Table 2' --scene fig02 --set motion.d=0.4 \\
      --quantity 'orbits.velocities[0]' --printed 0.83272
`vibro-audit check golden/mine` then checks it. A quantity is a column of orbits, branch, simulate, sweep, summary (that
of `sweep --summary`), trajectory, voltage or audit (its verdicts), as COMMAND.COLUMN, with [n] for an entry of a list,
counted from 0; over several rows .min, .max, .spread, .trend or .count may follow.

Exit status: 0 all verdicts are the expected ones; 1 one is not; 2 the input cannot be used.";

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    if let Some(outcome) = arguments.row.add(arguments.directory.as_deref(), options)? {
        return answer(arguments, &[outcome], &[], options);
    }
    let directory = arguments.directory.clone().map_or(Directory::BuiltIn, Directory::At);
    let printed = directory.printed()?;
    if arguments.bless {
        return rewrite(&directory);
    }
    if let Some(path) = directory.path() {
        note_input(path);
        for file in directory.reference_files()? {
            note_input(&path.join(file));
        }
    }
    let certified = directory.certified()?;
    for scene in directory.unused_scenes(&printed, &certified)? {
        note(&format!("{}: no row names this scene", directory.name(&scene)));
    }
    let progress = Progress::bar(printed.len() + certified.len(), "rows");
    let mut compute = |request: &_| golden::answer(&directory, request, options).map_err(|failure| failure.to_string());
    let mut outcomes = || check(&printed, &certified, &mut compute, &mut || progress.step());
    let (outcomes, faults) = match &directory {
        // what is to be said of the paper's own scenes is known
        Directory::BuiltIn => quietly(outcomes),
        _ => outcomes(),
    };
    let unusable = faults.into_iter().map(|fault| {
        let failure = Failure::from(fault);
        super::say("error", &failure.to_string());
        Unusable::from(&failure)
    });
    answer(arguments, &outcomes, &unusable.collect::<Vec<_>>(), options)
}

fn answer(
    arguments: &Arguments,
    outcomes: &[Outcome],
    unusable: &[Unusable],
    options: &Options,
) -> Result<Answer, Failure> {
    // of a row that is added, all is told
    let mut table = table(outcomes, options.format == Format::Text && !arguments.row.is_added())?;
    if options.format == Format::Junit && !unusable.is_empty() {
        table = Table::joined(&[&table, &Unusable::rows(unusable, "id")?]);
    }
    let content = match options.format {
        Format::Html => Content::Page(page(arguments, table)),
        _ => Content::Table(table),
    };
    Ok(Answer {
        content,
        exit: match unusable.is_empty() {
            true => Exit::from_verdict(outcomes.iter().all(Outcome::is_expected)),
            false => Exit::Unusable,
        },
    })
}

fn page(arguments: &Arguments, table: Table) -> Page {
    let directory = arguments.directory.as_ref().map(|path| path.display().to_string());
    let said = "What is printed or certified, against what is computed. `digits` is how many agree.";
    Page {
        title: format!(
            "Golden values of {}",
            directory.unwrap_or_else(|| "the paper".to_owned())
        ),
        notes: Vec::new(),
        parts: vec![Part::Table("Values".to_owned(), said.to_owned(), table)],
    }
}

/// Computes every reference file anew before any is written.
fn rewrite(directory: &Directory) -> Result<Answer, Failure> {
    let Some(path) = directory.path() else {
        return Err(Failure::BlessNothing);
    };
    let files = directory.reference_files()?;
    if files.is_empty() {
        return Err(Failure::NoReference(path.display().to_string()));
    }
    let _lock = added::lock(path)?;
    let mut maker = golden::Maker::new(directory);
    let mut blessed = Vec::new();
    for file in files {
        let text = directory.read(&file)?;
        let rows = Certified::read(&directory.name(&file), &text)?;
        let mut make = |request: &_, quantity: &_, setting: &_| {
            maker
                .make(request, quantity, setting)
                .map_err(|failure| failure.to_string())
        };
        blessed.push((bless(&text, &rows, &mut make)?, file));
    }
    let mut table = Table::new(["id", "place", "before", "after"]);
    for (blessed, file) in blessed {
        if blessed.changes.is_empty() {
            continue;
        }
        Output::Member(path.join(&file)).write(|to| to.write_all(blessed.text.as_bytes()))?;
        for change in blessed.changes {
            let cells = [change.id, file.clone(), change.before, change.after];
            table.push(cells.map(Cell::from))?;
        }
    }
    Ok(Answer {
        content: Content::Table(table),
        exit: Exit::AsExpected,
    })
}
