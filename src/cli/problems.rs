//! `vibro-audit problems`.

use super::{Answer, Content, Exit, Failure, Options, note};
use crate::accuracy::problems::{self, Certified, Kind, Level, Means, Problem, solve};
use crate::report::{Cell, Format, Table};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::time::Instant;

/// Print test problems with certified answers of 30 digits, as CSV
///
/// The ball moves by Z'' = cos(pi t + phase) + g between the bottom at Z = +d/2 and the top at Z = -d/2, where Z' turns into
/// -r_b Z' and -r_t Z'. Time 0 is the impact (side, phase, velocity): phase in rad, velocity just before it, positive
/// at the bottom and negative at the top, as all velocities are. Every input is exactly the decimal that is printed.
///
/// orbit: the periodic motion that makes the impacts of `word` (B bottom, T top) in `periods` forcing periods, each 2 long,
/// and starts nearest to the phase and velocity given. phase_k, velocity_k, and the time_k until the next impact, k from 1;
/// trace of the derivative of (t, Z') over the cycle.
/// impact, run: the impact that follows, or the one numbered `impacts` after the start: time since the start, phase in
/// [0, 2 pi), velocity. Where `impacts` is empty the motion chatters to rest: rest_time where its impacts accumulate,
/// release_time when cos(pi t + phase) + g next changes sign, landing_time and landing_velocity of the impact after that.
/// jacobian: derivatives of time (dt) and velocity (dv) of the next impact, or after one cycle, by those of the start:
/// dt_dv is that of the time by the velocity; trace and determinant.
/// voltage: of an impact of `velocity` times `velocity_unit` m/s, or mean_voltage over the impacts of a cycle, in V, by (5)
/// to (7) of the paper: the membrane gives way by delta, m v²/2 = K delta^(n+1)/(n+1) with m ball_mass, K stiffness and n
/// exponent; it then is a cap of ball_radius R up to the angle a, and a cone from there to membrane_radius C, with
/// (R - delta) cos a + C sin a = R; from the area A of both the voltage is ((A/(pi C²))² - 1) input_voltage.
///
/// The column `certified` names the two methods by which the answer was found.
#[derive(Debug, clap::Args)]
#[command(verbatim_doc_comment)]
#[command(after_help = "Example: vibro-audit problems --kind orbit --without-answers")]
pub struct Arguments {
    #[command(flatten)]
    selection: Selection,
    /// Leave the answers out
    #[arg(long)]
    without_answers: bool,
    /// Print our own answers for `score`: `default` as the commands compute, `f64` in double precision alone
    #[arg(long, value_name = "MEANS", value_parser = means_parser(), num_args = 0..=1, default_missing_value = "default", conflicts_with = "without_answers")]
    pub(super) solve: Option<Means>,
}

/// Some of the problems.
#[derive(Clone, Debug, clap::Args)]
pub struct Selection {
    /// Only problems of this kind; may be given several times
    #[arg(long = "kind", value_name = "KIND", value_parser = kind_parser())]
    kinds: Vec<Kind>,
    /// Only problems of this level; may be given several times
    #[arg(long = "level", value_name = "LEVEL", value_parser = level_parser())]
    levels: Vec<Level>,
}

/// Each name stands in help and in errors.
fn among<T: Clone + Send + Sync + 'static>(named: Vec<(&'static str, T)>) -> impl TypedValueParser<Value = T> {
    let names: Vec<&'static str> = named.iter().map(|(name, _)| *name).collect();
    PossibleValuesParser::new(names).try_map(move |text| {
        let found = named.iter().find(|(name, _)| *name == text);
        found.map(|(_, value)| value.clone()).ok_or("it is none of those")
    })
}

fn kind_parser() -> impl TypedValueParser<Value = Kind> {
    among(Kind::ALL.map(|kind| (kind.name(), kind)).to_vec())
}

fn level_parser() -> impl TypedValueParser<Value = Level> {
    among(Level::ALL.map(|level| (level.name(), level)).to_vec())
}

fn means_parser() -> impl TypedValueParser<Value = Means> {
    among(vec![("default", Means::Default), ("f64", Means::Double)])
}

impl Selection {
    /// Whether a problem is one of them.
    pub fn has(&self, problem: &Problem) -> bool {
        let is_of_kind = self.kinds.is_empty() || self.kinds.contains(&problem.kind);
        is_of_kind && (self.levels.is_empty() || self.levels.contains(&problem.level))
    }
}

/// A row for each quantity of each problem.
///
/// # Errors
/// None but a fault of ours.
pub fn table(certified: &[Certified], with_answers: bool) -> Result<Table, Failure> {
    let more: &[&str] = if with_answers {
        &["quantity", "answer", "certified"]
    } else {
        &["quantity"]
    };
    let mut table = Table::new(Problem::COLUMNS.iter().chain(more).copied());
    for Certified {
        problem,
        answers,
        means,
    } in certified
    {
        for answer in answers {
            let mut row: Vec<Cell> = problem.fields().into_iter().map(Cell::from).collect();
            row.push(Cell::from(answer.quantity.as_str()));
            if with_answers {
                row.extend([Cell::from(answer.text.as_str()), Cell::from(means.join("; "))]);
            }
            table.push(row)?;
        }
    }
    Ok(table)
}

/// Our own answers.
fn solved(selection: &Selection, means: Means) -> Result<Table, Failure> {
    let mut table = Table::new(["problem", "quantity", "answer", "seconds"]);
    for problem in problems::list().iter().filter(|problem| selection.has(problem)) {
        let start = Instant::now();
        let found = solve(problem, means);
        let seconds = start.elapsed().as_secs_f64();
        match found {
            Ok(values) => {
                for (quantity, value) in values {
                    let seconds = Cell::from(seconds);
                    table.push([
                        Cell::from(problem.name),
                        Cell::from(quantity),
                        Cell::from(value),
                        seconds,
                    ])?;
                }
            }
            Err(why) => note(&format!("{}: {why}", problem.name)),
        }
    }
    Ok(table)
}

/// A table as CSV.
///
/// # Errors
/// None but a fault of ours.
pub fn csv(table: &Table, figures: usize) -> Result<String, Failure> {
    let mut text = Vec::new();
    // into memory, which takes what it is given
    let written = table.write(&mut text, Format::Csv, figures);
    written.map_err(|error| Failure::NotMade(error.to_string()))?;
    String::from_utf8(text).map_err(|error| Failure::NotMade(error.to_string()))
}

/// Runs the command. It is for programs: what is text elsewhere is CSV here.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let table = match arguments.solve {
        Some(means) => solved(&arguments.selection, means)?,
        None => {
            let all = problems::all(|problem| arguments.selection.has(problem))?;
            table(&all, !arguments.without_answers)?
        }
    };
    let content = match options.format {
        Format::Text => Content::Text(csv(&table, options.figures())?),
        _ => Content::Table(table),
    };
    let exit = Exit::AsExpected;
    Ok(Answer { content, exit })
}
