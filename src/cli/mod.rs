//! The commands, thin: each reads its arguments, asks the library, and hands back an [`Answer`].

mod accuse;
mod added;
mod answer;
mod audit;
mod audit_table;
mod basins;
mod branch;
mod caller;
mod check;
mod columns;
mod complete;
mod completions;
mod curves;
mod decide;
mod document;
mod edits;
mod exit;
mod failure;
mod files;
mod golden;
mod guide;
mod jsonrpc;
mod lsp;
mod man;
mod map;
mod mcp;
mod mended;
mod merge;
#[cfg(test)]
mod modelled;
mod motions;
mod notebook;
mod optimise;
mod options;
mod orbits;
mod outcomes;
mod part;
mod plot;
mod problems;
mod progress;
mod proofs;
mod resume;
mod rows;
mod run;
mod scene;
mod scenes;
mod score;
mod shard;
mod signals;
mod simulate;
mod source;
mod stress;
mod sweep;
mod trade;
mod trajectory;
mod voltage;

pub use answer::{Answer, Content};
pub use caller::{Input, Reply, ask};
pub use columns::{COLUMNS_VERSION, Description, described, described_commands, schema};
pub use exit::Exit;
pub use failure::Failure;
pub use options::{Asked, Options};
pub use rows::Rows;
pub use scene::SceneArguments;
pub use source::{Source, SourceError, SourceProblem};

use crate::report::{Output, acts_on_a_terminal};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::parser::ValueSource;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use document::Form;
use std::ffi::OsString;
use std::io::Write;
use std::path::Path;

/// The stack of the threads that decide formulas: what the deepest that are read need, in a build without optimisation too.
pub const STACK: usize = 16 << 20;

const STATUS_HELP: &str = "Exit status: 0 all as expected; 1 a verdict or value is not as expected; 2 the input \
                           cannot be used; 130 a signal has stopped it.";

/// Checks the formulas and numbers that a paper prints, and computes the motions of a vibro-impact device.
#[derive(Debug, Parser)]
#[command(name = "vibro-audit", version, after_help = STATUS_HELP, arg_required_else_help = true)]
struct Line {
    #[command(flatten)]
    options: Options,
    #[command(flatten)]
    columns: columns::Arguments,
    #[command(subcommand)]
    command: Option<Command>,
}

impl Line {
    /// The commands, each with the options and formats that it has.
    fn grammar() -> clap::Command {
        let line = Self::command();
        let shared: Vec<clap::Arg> = line
            .get_arguments()
            .filter(|option| option.is_global_set())
            .cloned()
            .collect();
        line.mut_subcommands(|command| {
            let own = shared
                .iter()
                .map(|option| options::of_command(option.clone(), command.get_name()));
            let own: Vec<clap::Arg> = own.collect();
            command.args(own)
        })
    }

    /// Reads a command line; it names a command, or asks for columns.
    fn read(arguments: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let matches = Self::grammar().try_get_matches_from(arguments)?;
        let mut line = Self::from_arg_matches(&matches)?;
        if let Some((name, own)) = matches.subcommand() {
            let formats = options::formats(name);
            let is_said = [&matches, own]
                .iter()
                .any(|matches| matches.value_source("format") == Some(ValueSource::CommandLine));
            if let Some(format) = line
                .options
                .format_of_file()
                .filter(|format| !is_said && formats.contains(format))
            {
                line.options.format = format;
            }
            if !formats.contains(&line.options.format) {
                let names: Vec<&str> = formats.iter().map(|format| format.name()).collect();
                let problem = format!(
                    "`{name}` has no --format {}; choose {}",
                    line.options.format,
                    names.join(", ")
                );
                return Err(Self::command().error(clap::error::ErrorKind::InvalidValue, problem));
            }
        }
        let problem = match (&line.columns.columns, &line.command) {
            (None, None) => "a command is required",
            (Some(_), Some(_)) => "--columns stands without a command",
            _ => return Ok(line),
        };
        Err(Self::command().error(clap::error::ErrorKind::MissingSubcommand, problem))
    }

    /// What is found, before anything of it is printed.
    fn answer(&self) -> Result<Answer, Failure> {
        match &self.command {
            Some(command) => command.run(&self.options),
            None => self.columns.answer(),
        }
    }
}

#[derive(Debug, Subcommand)]
enum Command {
    Audit(audit::Arguments),
    Orbits(orbits::Arguments),
    Branch(branch::Arguments),
    Simulate(simulate::Arguments),
    Sweep(sweep::Arguments),
    Map(map::Arguments),
    Basins(basins::Arguments),
    Merge(merge::Arguments),
    Optimise(optimise::Arguments),
    Trajectory(trajectory::Arguments),
    Plot(plot::Arguments),
    Scenes(scenes::Arguments),
    Run(run::Arguments),
    Check(check::Arguments),
    Trade(trade::Arguments),
    Problems(problems::Arguments),
    Score(score::Arguments),
    Stress(stress::Arguments),
    Lsp(lsp::Arguments),
    Mcp(mcp::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

impl Command {
    fn run(&self, options: &Options) -> Result<Answer, Failure> {
        match self {
            Self::Audit(arguments) => audit::run(arguments, options),
            Self::Orbits(arguments) => orbits::run(arguments, options),
            Self::Branch(arguments) => branch::run(arguments, options),
            Self::Simulate(arguments) => simulate::run(arguments, options),
            Self::Sweep(arguments) => sweep::run(arguments, options),
            Self::Map(arguments) => map::run(arguments, options),
            Self::Basins(arguments) => basins::run(arguments, options),
            Self::Merge(arguments) => merge::run(arguments, options),
            Self::Optimise(arguments) => optimise::run(arguments, options),
            Self::Trajectory(arguments) => trajectory::run(arguments, options),
            Self::Plot(arguments) => plot::run(arguments, options),
            Self::Scenes(arguments) => scenes::run(arguments),
            Self::Run(arguments) => run::run(arguments, options),
            Self::Check(arguments) => check::run(arguments, options),
            Self::Trade(arguments) => trade::run(arguments, options),
            Self::Problems(arguments) => problems::run(arguments, options),
            Self::Score(arguments) => score::run(arguments, options),
            Self::Stress(arguments) => stress::run(arguments, options),
            Self::Lsp(arguments) => lsp::run(arguments),
            Self::Mcp(arguments) => mcp::run(arguments),
            Self::Completions(arguments) => completions::run(arguments, Line::grammar()),
            Self::Man(arguments) => man::run(arguments, Line::grammar()),
        }
    }

    /// The name by which [`described`] knows the columns of its answer; none where it has no table.
    fn table(&self) -> Option<&'static str> {
        Some(match self {
            Self::Audit(_) => "audit",
            Self::Orbits(_) => "orbits",
            Self::Branch(_) => "branch",
            Self::Simulate(_) => "simulate",
            Self::Sweep(arguments) if arguments.summary => "sweep --summary",
            Self::Sweep(_) => "sweep",
            Self::Map(_) => "map",
            Self::Basins(arguments) if arguments.attractors => "basins --attractors",
            Self::Basins(_) => "basins",
            Self::Optimise(_) => "optimise",
            Self::Trajectory(_) => "trajectory",
            Self::Plot(_) => "plot all",
            Self::Scenes(_) => "scenes",
            Self::Run(_) => "run",
            Self::Check(arguments) if arguments.bless => "check --bless",
            Self::Check(_) => "check",
            Self::Trade(arguments) if arguments.problems => "trade --problems",
            Self::Trade(arguments) if arguments.advise.is_some() => "trade --advise",
            Self::Trade(_) => "trade",
            Self::Problems(arguments) if arguments.solve.is_some() => "problems --solve",
            Self::Problems(_) => "problems",
            Self::Score(arguments) if arguments.summary => "score --summary",
            Self::Score(_) => "score",
            Self::Stress(arguments) if arguments.curve => "stress --curve",
            Self::Stress(_) => "stress",
            Self::Man(_) => "man",
            // the columns are those of the parts
            Self::Completions(_) | Self::Lsp(_) | Self::Mcp(_) | Self::Merge(_) => return None,
        })
    }

    /// Where the answer goes: to `--out`, but for `run` and `plot all`, whose files go there.
    fn output(&self, options: &Options) -> Output {
        match self {
            Self::Run(_) => Output::Stdout,
            Self::Plot(arguments) if arguments.is_all() => Output::Stdout,
            _ => options.output(),
        }
    }
}

/// Runs the command line `arguments`, the program's name first, and answers with the exit status.
///
/// Tables go to stdout or `--out`; errors to stderr as one line `error: what, where, what to do`.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Exit {
    let line = match Line::read(arguments) {
        Ok(line) => line,
        Err(error) => {
            if error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
                let _ = error.print();
                return Exit::Unusable;
            }
            if error.use_stderr() {
                let text = advised(&error);
                say("error", text.strip_prefix("error: ").unwrap_or(&text).trim_end());
                return Exit::Unusable;
            }
            // `--help | head` may close the pipe early: that is the reader's choice, not an error.
            let _ = error.print();
            return Exit::AsExpected;
        }
    };
    let token = signals::token();
    let answered = token.during(|| run_line(&line));
    if token.is_stopped() {
        let steps = match token.steps() {
            0 => String::new(),
            steps => format!(" after {steps} steps"),
        };
        note(&format!(
            "stopped by a signal{steps}: rows and files are whole, or not there"
        ));
        return Exit::Stopped;
    }
    answered.unwrap_or_else(|failure| {
        say("error", &failure.to_string());
        Exit::Unusable
    })
}

/// Returns what is wrong with a command line, and what was probably meant.
fn advised(error: &clap::Error) -> String {
    let found = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(found)) => found.as_str(),
        _ => "",
    };
    let subcommand = match error.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(subcommand)) => subcommand.as_str(),
        _ => "",
    };
    let is_formulas = |name: &str| name.ends_with(".toml") || Form::of_path(Path::new(name)).is_some();
    let name = found.trim_start_matches('-');
    let name = name.split_once('=').map_or(name, |(name, _)| name);
    match error.kind() {
        ErrorKind::UnknownArgument if !found.starts_with('-') && found.contains('=') => {
            format!("`{found}` has no --set: write --set before each, as in --set motion.d=0.3 --set {found}")
        }
        ErrorKind::InvalidSubcommand if is_formulas(subcommand) => {
            format!("`{subcommand}` is no command; to check a file of formulas write: vibro-audit audit {subcommand}")
        }
        ErrorKind::UnknownArgument if crate::scene::has_key(name) => {
            format!(
                "there is no option {found}; it is a key of the scene: --set {}=...",
                crate::scene::path_of_key(name)
            )
        }
        _ => error
            .to_string()
            .replace("invalid digit found in string", "write a whole number, as 10000")
            .replace("invalid float literal", "write a number, as 100 or 0.5"),
    }
}

/// A message beside the answer, on stderr.
fn note(text: &str) {
    // what is computed after a signal is cut short: nothing is to be said of it
    if !crate::stop::Token::current().is_stopped() {
        say("note", text);
    }
}

/// The characters of a word that a message repeats, at most; of a longer one its beginning.
const LONGEST_WORD: usize = 400;

/// Writes a message: what it repeats of an input does nothing to a terminal.
fn say(kind: &str, text: &str) {
    if caller::hears(text) {
        return;
    }
    let mut shown = String::with_capacity(text.len());
    let mut length = 0;
    for c in text.chars() {
        length = if c.is_whitespace() { 0 } else { length + 1 };
        match c {
            _ if length == LONGEST_WORD => shown.push('\u{2026}'),
            _ if length > LONGEST_WORD => {}
            '\n' => shown.push(c),
            _ if c.is_control() => shown.extend(c.escape_debug()),
            _ if acts_on_a_terminal(c) => shown.extend(c.escape_unicode()),
            _ => shown.push(c),
        }
    }
    // Where stderr is closed the status alone has to say it.
    let _ = writeln!(std::io::stderr(), "{kind}: {shown}");
}

fn run_line(line: &Line) -> Result<Exit, Failure> {
    let output = match &line.command {
        Some(command) => command.output(&line.options),
        None => line.options.output(),
    };
    output.check()?;
    line.answer()?.write(&output, &line.options)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Line::grammar().debug_assert();
    }

    #[test]
    fn options_may_stand_before_or_after_the_command() {
        for arguments in [["--digits", "30", "audit"], ["audit", "--digits", "30"]] {
            let line = Line::try_parse_from(["vibro-audit"].into_iter().chain(arguments)).unwrap();
            assert_eq!(line.options.digits, Some(30));
        }
    }
}
