//! `vibro-audit merge FILES`.

use super::answer::Copied;
use super::shard::Label;
use super::source::ANSWERS_AT_MOST;
use super::{Answer, Content, Exit, Failure, Options, basins, optimise};
use crate::input::{lines, open_regular};
use crate::orbit::Estimate;
use crate::report::{Checksum, Format, note_input};
use crate::scene::{ReachedAttractor, ReachedAttractors};
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

/// Join the parts of a run that --shard computed
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit merge part1.csv part2.csv --out whole.csv")]
pub struct Arguments {
    /// The files of all parts, in any order
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
}

/// A part that is whole.
struct Part {
    path: PathBuf,
    label: Label,
    /// The names of the columns.
    columns: String,
    rows: u64,
    /// The last line.
    tail: String,
    /// Where the parts are of basins, what its starts come to.
    attractors: ReachedAttractors,
}

/// Runs the command: nothing is written before every part has been read to its end.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    if !matches!(options.format, Format::Text | Format::Csv) {
        return Err(Failure::Usage(
            "parts are CSV, and so is what they are joined to".to_owned(),
        ));
    }
    let mut parts: Vec<Part> = arguments
        .files
        .iter()
        .map(|path| Part::read(path))
        .collect::<Result<_, _>>()?;
    parts.sort_by_key(|part| part.label.number);
    check(&parts)?;
    Ok(Answer {
        content: Content::Copied(Copied(Box::new(move |to| join(&parts, to)))),
        exit: Exit::AsExpected,
    })
}

impl Part {
    fn read(path: &Path) -> Result<Self, Failure> {
        let shown = path.display();
        let wrong = |problem: String| Failure::Usage(format!("{shown}: {problem}"));
        let unread = |error: io::Error| wrong(format!("cannot be read: {error}"));
        let file = open_regular(path).map_err(unread)?;
        note_input(path);
        let mut lines = lines(BufReader::new(file));
        let mut next = || lines.next().transpose().map_err(unread);
        let label = next()?.as_deref().and_then(Label::read);
        let label = label.ok_or_else(|| wrong("it is no part of a run: --shard writes them".to_owned()))?;
        let columns = next()?.unwrap_or_default();
        let (mut rows, mut following, mut last) = (0, None, None::<String>);
        let mut sum = Checksum::default();
        sum.add_line(&columns);
        // how often each attractor is named; nothing where one is that cannot be
        let mut named: Option<Vec<u64>> = Some(Vec::new());
        // what is held until all parts are read: the table behind the rows, and the rows of a search
        let mut held = 0;
        while let Some(line) = next()? {
            if following.is_some() || label.is_of(optimise::COMMAND) {
                held += line.len() as u64 + 1;
            }
            if held > ANSWERS_AT_MOST << 20 {
                return Err(wrong(format!(
                    "it has a table of more than {ANSWERS_AT_MOST} MB; no part of a run has such a table"
                )));
            }
            last.iter().for_each(|line| sum.add_line(line));
            match (last.replace(line), &mut following) {
                (None, _) => {}
                (Some(line), None) if line.is_empty() => following = Some(String::new()),
                (Some(line), None) => {
                    rows += 1;
                    if label.is_of("basins") {
                        named = named.and_then(|named| counted(&line, named));
                    }
                }
                (Some(line), Some(table)) => {
                    table.push_str(&line);
                    table.push('\n');
                }
            }
        }
        let tail = label.tail(rows, sum);
        if last.as_ref() != Some(&tail) {
            let problem =
                "it is cut short, or was changed: its last line does not say that it is whole, with these rows";
            return Err(wrong(problem.to_owned()));
        }
        let attractors = read_attractors(&following.unwrap_or_default());
        let starts = |found: &ReachedAttractors| found.list.iter().map(|found| found.starts).collect();
        let attractors = attractors.filter(|found| named == Some(starts(found)));
        Ok(Self {
            path: path.to_owned(),
            label,
            columns,
            rows: rows as u64,
            tail,
            attractors: attractors.ok_or_else(|| wrong("its attractors are not those of its rows".to_owned()))?,
        })
    }
}

/// Refuses parts that are not those of one run, each once; they are in order.
fn check(parts: &[Part]) -> Result<(), Failure> {
    let Some(first) = parts.first() else {
        return Ok(());
    };
    let usage = |problem: String| Err(Failure::Usage(problem));
    for part in parts {
        if (&part.label.run, part.label.of, &part.columns) != (&first.label.run, first.label.of, &first.columns) {
            return usage(format!(
                "{} and {} are of two runs, `{}` and `{}`: parts have the same scene, overrides, command, version and number",
                first.path.display(),
                part.path.display(),
                first.label.head(),
                part.label.head()
            ));
        }
    }
    if let Some([one, other]) = parts.windows(2).find_map(|pair| match pair {
        [one, other] if one.label.number == other.label.number => Some([one, other]),
        _ => None,
    }) {
        let number = one.label.number;
        return usage(format!(
            "part {number} is there twice: {} and {}",
            one.path.display(),
            other.path.display()
        ));
    }
    let is_there = |number: &u32| parts.iter().any(|part| part.label.number == *number);
    let missing: Vec<String> = (1..=first.label.of)
        .filter(|number| !is_there(number))
        .map(|number| number.to_string())
        .collect();
    if missing.is_empty() {
        Ok(())
    } else {
        usage(format!(
            "of {} parts these are missing: {}",
            first.label.of,
            missing.join(", ")
        ))
    }
}

/// Writes the rows of all parts under one line of columns, and the attractors of all; how many rows they are.
fn join(parts: &[Part], to: &mut dyn Write) -> io::Result<usize> {
    if parts.iter().any(|part| part.label.is_of(optimise::COMMAND)) {
        let tables = parts.iter().map(rows_of).collect::<io::Result<Vec<_>>>()?;
        let unlike = || io::Error::other("the parts do not have the rows of one search");
        let table = optimise::joined(&tables).ok_or_else(unlike)?;
        table.write(to, Format::Csv, 0)?;
        return Ok(table.rows().len());
    }
    let mut all = ReachedAttractors::default();
    // of each part, under which number its attractors are known to all
    let numbers: Vec<Vec<i64>> = parts
        .iter()
        .map(|part| {
            let own = part.attractors.list.iter();
            own.map(|attractor| basins::shown(all.add(attractor.clone()))).collect()
        })
        .collect();
    let mut rows = 0;
    for (part, numbers) in parts.iter().zip(&numbers) {
        rows += copy(part, numbers, to)?;
    }
    if parts.iter().any(|part| part.label.is_of("basins")) {
        writeln!(to)?;
        let starts = parts.iter().map(|part| part.rows).sum();
        let table = basins::table(&all, starts).map_err(io::Error::other)?;
        table.write(to, Format::Csv, 0)?;
    }
    Ok(rows)
}

/// The rows of a part, cell by cell.
fn rows_of(part: &Part) -> io::Result<Vec<Vec<String>>> {
    let mut lines = Vec::new();
    copy(part, &[], &mut lines)?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(part.label.number == 1)
        .from_reader(&lines[..]);
    let cells = |row: Result<csv::StringRecord, csv::Error>| Ok(row?.iter().map(str::to_owned).collect());
    reader.records().map(cells).collect()
}

/// Writes the rows of a part, the first under the line of columns.
fn copy(part: &Part, numbers: &[i64], to: &mut dyn Write) -> io::Result<usize> {
    let mut lines = lines(BufReader::new(open_regular(&part.path)?));
    let changed = || io::Error::other(format!("{} was changed meanwhile", part.path.display()));
    let (head, columns) = (lines.next().transpose()?, lines.next().transpose()?);
    if head != Some(part.label.head()) || columns.as_ref() != Some(&part.columns) {
        return Err(changed());
    }
    if part.label.number == 1 {
        writeln!(to, "{}", part.columns)?;
    }
    let (mut rows, mut last) = (0, None);
    for line in lines {
        let line = line?;
        if rows as u64 == part.rows {
            last = Some(line);
            continue;
        }
        if part.label.is_of("basins") {
            let renumbered = renumbered(&line, numbers).ok_or_else(changed)?;
            writeln!(to, "{renumbered}")?;
        } else {
            writeln!(to, "{line}")?;
        }
        rows += 1;
    }
    match last.as_ref() == Some(&part.tail) {
        true => Ok(rows),
        false => Err(changed()),
    }
}

/// The counts with the attractor of one more row; a new one has the next number.
fn counted(line: &str, mut named: Vec<u64>) -> Option<Vec<u64>> {
    if let (_, Some(place)) = basins::told(line)? {
        if place == named.len() {
            named.push(0);
        }
        *named.get_mut(place)? += 1;
    }
    Some(named)
}

/// A row with the number, in the last column, under which all parts know its attractor.
fn renumbered(line: &str, numbers: &[i64]) -> Option<String> {
    match basins::told(line)? {
        (start, Some(own)) => Some(format!("{start},{}", numbers.get(own)?)),
        (_, None) => Some(line.to_owned()),
    }
}

/// Reads a table of attractors; of no text there are none.
fn read_attractors(text: &str) -> Option<ReachedAttractors> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    if !text.is_empty() && !reader.headers().ok()?.iter().eq(basins::ATTRACTORS) {
        return None;
    }
    let rows = reader.records().map(|row| read_attractor(&row.ok()?));
    let list = rows.collect::<Option<Vec<_>>>()?;
    Some(ReachedAttractors { list })
}

fn read_attractor(row: &csv::StringRecord) -> Option<ReachedAttractor> {
    let field = |name: &str| {
        let place = basins::ATTRACTORS.iter().position(|column| *column == name)?;
        row.get(place).filter(|text| !text.is_empty())
    };
    let number = |name: &str| field(name).map(str::parse::<f64>).transpose().ok();
    let numbers = |name: &str| {
        let parts = field(name).into_iter().flat_map(|text| text.split(';'));
        parts.map(str::parse::<f64>).collect::<Result<Vec<_>, _>>().ok()
    };
    let error = number("voltage_rate_error")?;
    Some(ReachedAttractor {
        word: field("word").map(str::to_owned),
        periods: field("periods").map(str::parse).transpose().ok()?,
        phases: numbers("phases")?,
        velocities: numbers("velocities")?,
        error_bound: number("error_bound")?,
        voltage_rate: number("voltage_rate")?.map(|value| Estimate { value, error }),
        starts: field("starts")?.parse().ok()?,
        releases: Vec::new(),
    })
}
