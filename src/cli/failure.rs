//! Why a command has no answer: always the input's fault, or a place's that cannot be written; exit 2.

use super::source::SourceError;
use crate::report::{OutputError, RowError};
use crate::scene::Origin;

/// Why a command has no answer. The message says what, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The command line cannot be read.
    #[error("{0}")]
    Usage(String),
    /// More is asked for than a program should hold at once.
    #[error(
        "more than {most} cells are more than memory should hold; ask for fewer rows, or let the command write a file"
    )]
    TooManyCells { most: usize },
    /// A page that cannot be drawn.
    #[error("{0}")]
    Page(std::io::Error),
    /// The input cannot be read.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The answer cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A command built a row that its own table refuses.
    #[error("{0}: this is a fault of vibro-audit, please report it")]
    Row(#[from] RowError),
    /// A sheet makes no sense.
    #[error("{name}: {fault}")]
    Sheet {
        name: String,
        fault: Box<crate::claim::Fault>,
    },
    /// A draft was asked for of what is no document.
    #[error(
        "{0}: --draft is of a document, a file whose name ends in .tex, .md, .qmd or .ipynb; a sheet is one already"
    )]
    NoDocument(String),
    /// A notebook that cannot be read.
    #[error("{0}: {1}")]
    Notebook(String, String),
    /// A golden file cannot be used.
    #[error(transparent)]
    Golden(#[from] crate::reference::Fault),
    /// A scene cannot be used.
    #[error(transparent)]
    Scene(#[from] crate::scene::SceneError),
    /// Something of one file, where several are named.
    #[error("{flag} is of one file, and {count} are named: run the command for each of them")]
    OfOneFile { flag: &'static str, count: usize },
    /// A formula beside which no comment can stand.
    #[error(
        "{name}: no line before the formula ({label}) takes a comment with its repair; give the formula an [[equation]] of its own, or ask for --repair alone"
    )]
    NoPlace { name: String, label: String },
    /// A file that is no baseline.
    #[error("{0}: {1}")]
    Baseline(String, crate::report::BaselineError),
    /// The built-in golden values cannot be rewritten.
    #[error("--bless rewrites the reference files of a directory: name it, as in `check golden/paper --bless`")]
    BlessNothing,
    /// A directory without reference files.
    #[error("{0} has no folder reference/ with .csv files; nothing can be blessed, and none is created; to begin, write {0}/reference/mine.csv: the header {header}, then rows whose last three fields are empty, which --bless fills", header = crate::reference::CERTIFIED_COLUMNS.join(","))]
    NoReference(String),
    /// A scene would be copied onto another one.
    #[error("{there} is another scene than {given}: give one of them another name")]
    OtherScene { there: String, given: String },
    /// A row that names no scene.
    #[error("no scene is named: a built-in one, such as fig02, or a path in the directory, such as scenes/mine.toml")]
    NoSceneNamed,
    /// A name that is no built-in scene.
    #[error("there is no built-in scene `{0}`; a file is named by its path in the directory, such as scenes/{0}.toml")]
    NoScene(String),
    /// A quantity that no command answers.
    #[error("there is no command `{found}` whose columns golden values may name: {} are", known.join(", "))]
    NoAnswer { found: String, known: Vec<&'static str> },
    /// A certified value that one of its means does not give.
    #[error("{0}")]
    NotMade(String),
    /// A measurement failed.
    #[error(transparent)]
    Trade(#[from] crate::accuracy::TradeError),
    /// Means were asked for that none are.
    #[error(transparent)]
    Advice(#[from] crate::accuracy::AdviceError),
    /// Two outputs for one file.
    #[error("{0} cannot hold both the table and what stands beside it: name two files")]
    SameFile(String),
    /// A problem has no certified answer.
    #[error("{0}: this is a fault of vibro-audit, please report it")]
    Problem(#[from] crate::accuracy::problems::ProblemError),
    /// Answers cannot be scored.
    #[error(transparent)]
    Answers(#[from] crate::accuracy::score::AnswerError),
    /// A program does not answer.
    #[error(transparent)]
    Program(#[from] crate::accuracy::score::ProgramError),
    /// Digits at the extremes cannot be judged.
    #[error(transparent)]
    Stress(#[from] crate::accuracy::stress::StressError),
    /// More digits than there are.
    #[error("{figures} digits of a motion are more than can be computed; ask for at most {most}")]
    Digits { figures: usize, most: usize },
    /// A parameter cannot be.
    #[error(transparent)]
    Motion(#[from] crate::model::MotionError),
    /// A sweep cannot be followed.
    #[error(transparent)]
    Cover(#[from] crate::orbit::CoverError),
    /// No built-in scene has this name, and no file either.
    #[error("there is no built-in scene {name}, nor a file of this name; {meant}there are: {known}")]
    UnknownScene { name: String, meant: String, known: String },
    /// `plot all` was not told where to write.
    #[error("`plot all` writes a file for each figure: name a directory by --out DIR")]
    NoFigures,
    /// There is nothing to draw.
    #[error(
        "nothing of what {0} wants can be drawn; want branch, sweep, voltage, trajectory, map, basins, or the optimum of a box with a range"
    )]
    NothingDrawn(String),
    /// More than a drawing shows, and memory should hold.
    #[error("{count} {what} are more than a figure shows: {most} at most; lower sweep.points or {other}")]
    TooMuchDrawn {
        count: u64,
        what: &'static str,
        most: u64,
        other: &'static str,
    },
    /// A figure cannot be laid out.
    #[error(transparent)]
    Plot(#[from] crate::report::plot::PlotError),
    /// `run` was not told where to write.
    #[error("`run` writes a file for each command: name a directory by --out DIR, or ask with --explain")]
    NoDirectory,
    /// Some wants have no command yet.
    #[error("no command serves {} yet{}", list(.wants), match .written.as_slice() {
        [] => String::new(),
        written => format!("; written: {}", written.join(", ")),
    })]
    Unserved {
        wants: Vec<crate::scene::Want>,
        written: Vec<String>,
    },
}

impl Failure {
    /// The file or text at fault, and line and column in it, from 1, as far as they are known.
    pub fn place(&self) -> (Option<&str>, Option<usize>, Option<usize>) {
        match self {
            Self::Source(error) => (Some(&error.place), None, None),
            Self::Output(error) => (Some(&error.place), None, None),
            Self::Sheet { name, fault } => {
                let file = fault.file.as_deref().unwrap_or(name);
                let (line, column) = fault.place.unzip();
                (Some(file), line, column)
            }
            Self::Scene(error) => {
                let place = match &error.origin {
                    Some(Origin::File(place)) => Some((place.line, place.column)),
                    _ => None,
                };
                let (line, column) = place.unzip();
                (Some(&error.name), line, column)
            }
            Self::Golden(fault) => {
                let line = fault.line().and_then(|line| usize::try_from(line).ok());
                (Some(fault.file()), line, None)
            }
            Self::NoPlace { name, .. }
            | Self::NoDocument(name)
            | Self::Notebook(name, _)
            | Self::Baseline(name, _)
            | Self::NoReference(name)
            | Self::NothingDrawn(name) => (Some(name), None, None),
            _ => (None, None, None),
        }
    }
}

fn list(wants: &[crate::scene::Want]) -> String {
    wants.iter().map(|want| want.name()).collect::<Vec<_>>().join(", ")
}
