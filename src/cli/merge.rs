//! `vibro-audit merge FILES`.

use super::answer::Copied;
use super::shard::Label;
use super::{Answer, Content, Exit, Failure, Options};
use crate::report::{Format, note_input};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;

/// The parts of a run that `--shard` computed, joined as one run would have written them
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The parts, in any order, all of them
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
}

/// A part that is whole.
struct Part {
    path: PathBuf,
    label: Label,
    /// The names of the columns.
    columns: String,
}

/// Runs the command: nothing is written before every part has been read to its end.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    if !matches!(options.format, Format::Text | Format::Csv) {
        return Err(Failure::Usage(
            "parts are CSV, and so is what they are joined to".to_owned(),
        ));
    }
    let mut parts: Vec<Part> = arguments.files.iter().map(Part::read).collect::<Result<_, _>>()?;
    parts.sort_by_key(|part| part.label.number);
    check(&parts)?;
    Ok(Answer {
        content: Content::Copied(Copied(Box::new(move |to| copy(&parts, to)))),
        exit: Exit::AsExpected,
    })
}

impl Part {
    fn read(path: &PathBuf) -> Result<Self, Failure> {
        let shown = path.display();
        let wrong = |problem: String| Failure::Usage(format!("{shown}: {problem}"));
        let unread = |error: io::Error| wrong(format!("cannot be read: {error}"));
        let file = File::open(path).map_err(unread)?;
        note_input(path);
        let mut lines = BufReader::new(file).lines();
        let mut next = || lines.next().transpose().map_err(unread);
        let label = next()?.as_deref().and_then(Label::read);
        let label = label.ok_or_else(|| wrong("it is no part of a run: --shard writes them".to_owned()))?;
        let columns = next()?.unwrap_or_default();
        let (mut rows, mut last) = (0, None);
        while let Some(line) = next()? {
            rows += usize::from(last.is_some());
            last = Some(line);
        }
        if last != Some(label.tail(rows)) {
            let problem = "it is cut short: its last line does not say that it is whole, with as many rows as it has";
            return Err(wrong(problem.to_owned()));
        }
        Ok(Self {
            path: path.clone(),
            label,
            columns,
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

/// Writes the rows of all parts under one line of columns; how many they are.
fn copy(parts: &[Part], to: &mut dyn Write) -> io::Result<usize> {
    let mut rows = 0;
    for part in parts {
        let mut lines = BufReader::new(File::open(&part.path)?).lines();
        let changed = || io::Error::other(format!("{} was changed meanwhile", part.path.display()));
        let (head, columns) = (lines.next().transpose()?, lines.next().transpose()?);
        if head != Some(part.label.head()) || columns.as_ref() != Some(&part.columns) {
            return Err(changed());
        }
        if rows == 0 && part.label.number == 1 {
            writeln!(to, "{}", part.columns)?;
        }
        let (mut own, mut held) = (0, lines.next().transpose()?);
        for line in lines {
            let line = line?;
            writeln!(to, "{}", held.replace(line).unwrap_or_default())?;
            own += 1;
        }
        if held != Some(part.label.tail(own)) {
            return Err(changed());
        }
        rows += own;
    }
    Ok(rows)
}
