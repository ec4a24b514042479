//! Runs that can be stopped and gone on with: `--resume` writes rows beside the file that they become.

use super::rows::Rows;
use super::shard::{Label, Shard};
use super::{Failure, Options};
use crate::input::{lines, read_line};
use crate::orbit::{SearchBatch, SearchOutcomes, SearchRecord};
use crate::report::{
    Cell, Checksum, Column, Format, Output, OutputError, OutputProblem, Stream, Summed, SummedLines, Table, open_locked,
};
use crate::stop::Token;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Rows are written at least so often: what a kill may lose.
const PAUSE: Duration = Duration::from_millis(300);

/// A run whose rows stand in a file of their own until all of them are there, each with a sum over all up to it.
#[derive(Debug)]
pub struct Unfinished {
    /// The file of the rows, which nobody else writes meanwhile.
    path: PathBuf,
    file: File,
    label: Label,
    /// Whether it is a part of a run, and stays one.
    is_part: bool,
    columns: Vec<Column>,
    /// The rows that are whole, and the bytes up to their end.
    kept: Place,
    /// What stands in the first column of the last of them, and the rows before the first one with that.
    last: Option<(String, Place)>,
}

/// So many rows, which end at this byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Place {
    rows: u64,
    bytes: u64,
    /// Over the rows.
    sum: Checksum,
}

fn system(path: &Path, doing: &'static str) -> impl Fn(io::Error) -> Failure {
    let place = path.display().to_string();
    move |source| {
        let (place, problem) = (place.clone(), OutputProblem::System { doing, source });
        OutputError { place, problem }.into()
    }
}

impl Unfinished {
    /// What there is of the run that `label` describes, in the file beside `--out`; where there is no such file, nothing.
    ///
    /// # Errors
    /// No `--out`, another format than CSV, a file of another run, and what the system says.
    pub fn open(options: &Options, shard: Option<Shard>, label: Label, columns: &[&str]) -> Result<Self, Failure> {
        let usage = |problem: &str| Failure::Usage(problem.to_owned());
        let out = options
            .out
            .as_ref()
            .ok_or_else(|| usage("--resume writes to a file: add --out FILE"))?;
        if options.format != Format::Csv {
            return Err(usage("--resume writes CSV: add --format csv"));
        }
        Output::File(out.clone()).check()?;
        let mut name = out.file_name().unwrap_or_default().to_owned();
        name.push(".part");
        let path = out.with_file_name(name);
        let mut unfinished = Self {
            file: open_locked(&path)?,
            label,
            is_part: shard.is_some(),
            columns: columns.iter().map(|name| Column::from(*name)).collect(),
            kept: Place::default(),
            last: None,
            path,
        };
        let [head, columns] = unfinished.head();
        let mut place = Place {
            rows: 0,
            bytes: (head.len() + columns.len() + 2) as u64,
            sum: Checksum::default(),
        };
        let sums = if unfinished.is_record() {
            0
        } else {
            1 + Checksum::LETTERS
        };
        let mut last: Option<(String, Place)> = None;
        unfinished.each(|line| {
            let first = line.split(',').next().unwrap_or_default();
            if last.as_ref().is_none_or(|(known, _)| known != first) {
                last = Some((first.to_owned(), place));
            }
            place.rows += 1;
            place.bytes += (line.len() + sums) as u64 + 1;
            place.sum.add_line(line);
        })?;
        (unfinished.kept, unfinished.last) = (place, last);
        Ok(unfinished)
    }

    /// Whether its rows are those of a search, which have sums of their own.
    fn is_record(&self) -> bool {
        self.columns.iter().map(|column| column.name.as_str()).eq(RECORD)
    }

    fn head(&self) -> [String; 2] {
        let columns: Vec<&str> = self.columns.iter().map(|column| column.name.as_str()).collect();
        [self.label.head(), columns.join(",")]
    }

    /// Looks at each row that is whole.
    ///
    /// # Errors
    /// A file of another run, and what the system says.
    pub fn each(&self, mut look: impl FnMut(&str)) -> Result<(), Failure> {
        let failed = system(&self.path, "reading what there is of the run");
        (&self.file).rewind().map_err(&failed)?;
        let mut reader = BufReader::new(&self.file);
        let mut next = || -> Result<Option<String>, Failure> {
            let line = read_line(&mut reader).map_err(&failed)?;
            // a line without its end was cut
            Ok(line.and_then(|line| line.strip_suffix('\n').map(str::to_owned)))
        };
        for wanted in self.head() {
            match next()? {
                Some(line) if line == wanted => {}
                // nothing was written yet
                None => return Ok(()),
                Some(line) => {
                    return Err(Failure::Usage(format!(
                        "{}: it is of another run, `{line}`: remove it, or give another --out",
                        self.path.display()
                    )));
                }
            }
        }
        let (mut sum, mut number) = (Checksum::default(), 2);
        while let Some(line) = next()? {
            number += 1;
            let row = match self.is_record() {
                true => Some(line.as_str()),
                false => SummedLines::read(&line, &mut sum),
            };
            look(row.ok_or_else(|| self.changed(number))?);
        }
        Ok(())
    }

    fn changed(&self, line: u64) -> Failure {
        let problem = "it is not what this run has written there: remove the file, or give another --out";
        Failure::Usage(format!("{}:{line}: {problem}", self.path.display()))
    }

    /// How many rows are there.
    pub fn rows(&self) -> u64 {
        self.kept.rows
    }

    /// Leaves out the last rows that are alike in the first column, of which more may follow; what stands there.
    pub fn without_last(&mut self) -> Option<String> {
        let (first, before) = self.last.take()?;
        self.kept = before;
        Some(first)
    }

    /// Writes the rows that are not there yet as they come and, when all are, the file; how many rows there are, and whether
    /// they are as is required.
    pub fn write(self, rows: Rows, output: &Output) -> Result<(usize, bool), Failure> {
        let failed = system(&self.path, "writing");
        let mut writer = self.behind()?;
        let token = Token::current();
        let mut count = self.kept.rows as usize;
        let mut lines = SummedLines::behind(&mut writer, self.kept.sum);
        let mut stream = Stream::continued(self.columns.clone(), &mut lines);
        let mut written = Instant::now();
        let (is_met, following) = rows.each(|row: Vec<Cell>| {
            // a row that was stopped on its way is none
            if token.is_stopped() {
                return Ok(false);
            }
            count += 1;
            stream.push(row).map_err(&failed)?;
            if written.elapsed() > PAUSE {
                stream.flush().map_err(&failed)?;
                written = Instant::now();
            }
            Ok(true)
        })?;
        stream.end().map_err(&failed)?;
        writer.flush().map_err(&failed)?;
        if token.is_stopped() {
            let path = self.path.display();
            super::say(
                "note",
                &format!("{count} rows are in {path}: the same command goes on behind them"),
            );
            return Ok((count, is_met));
        }
        output.write(|to| self.finish(to, count, following.as_ref()))?;
        fs::remove_file(&self.path).map_err(&failed)?;
        Ok((count, is_met))
    }

    /// Writes behind the rows that are there.
    fn behind(&self) -> Result<BufWriter<&File>, Failure> {
        let failed = system(&self.path, "writing");
        let mut file = &self.file;
        file.rewind().map_err(&failed)?;
        if self.kept.rows == 0 {
            file.write_all((self.head().join("\n") + "\n").as_bytes())
                .map_err(&failed)?;
        }
        file.set_len(self.kept.bytes).map_err(&failed)?;
        file.seek(SeekFrom::End(0)).map_err(&failed)?;
        Ok(BufWriter::new(file))
    }

    /// The rows as the record of a search.
    ///
    /// # Errors
    /// What the system says.
    pub fn record(&self) -> Result<Record<'_>, Failure> {
        let failed = system(&self.path, "reading what there is of the run");
        (&self.file).rewind().map_err(&failed)?;
        let mut reader = BufReader::new(&self.file);
        if self.kept.rows > 0 {
            for _ in self.head() {
                read_line(&mut reader).map_err(&failed)?;
            }
        }
        Ok(Record {
            of: self,
            reader,
            line: 0,
            sum: Checksum::default(),
            writer: None,
            written: Instant::now(),
        })
    }

    /// Writes what a search that is over has found, which its record is not needed for any more; as [`Unfinished::write`].
    pub fn end(self, found: Rows, output: &Output, figures: usize) -> Result<(usize, bool), Failure> {
        if Token::current().is_stopped() {
            let path = self.path.display();
            super::say(
                "note",
                &format!("what the search has found is in {path}: the same command goes on from there"),
            );
            return Ok((0, true));
        }
        let told = found.write(output, Format::Csv, figures)?;
        fs::remove_file(&self.path).map_err(system(&self.path, "removing"))?;
        Ok(told)
    }

    /// Copies the rows to where they belong.
    fn finish(&self, to: &mut dyn Write, rows: usize, following: Option<&Table>) -> io::Result<()> {
        (&self.file).rewind()?;
        let mut lines = lines(BufReader::new(&self.file));
        if let Some(head) = lines.next().transpose()?.filter(|_| self.is_part) {
            writeln!(to, "{head}")?;
        }
        let mut to = Summed::new(to);
        let mut sum = Checksum::default();
        if let Some(columns) = lines.next().transpose()? {
            writeln!(to, "{columns}")?;
        }
        for line in lines {
            let changed = || io::Error::other(format!("{} was changed meanwhile", self.path.display()));
            let line = line?;
            writeln!(to, "{}", SummedLines::read(&line, &mut sum).ok_or_else(changed)?)?;
        }
        if let Some(table) = following {
            writeln!(to)?;
            table.write(&mut to, Format::Csv, 0)?;
        }
        match self.is_part {
            true => writeln!(to.to, "{}", self.label.tail(rows, to.sum)),
            false => Ok(()),
        }
    }
}

/// The record of a search: a row for each batch of boxes, which has what became of them and a sum over that, the boxes, and
/// all rows before. A row that was changed, or is of other boxes, is not believed.
pub struct Record<'a> {
    of: &'a Unfinished,
    reader: BufReader<&'a File>,
    /// The rows that are read or written.
    line: u64,
    /// Over them and their boxes.
    sum: Checksum,
    /// Where more are written, once all were read.
    writer: Option<BufWriter<&'a File>>,
    written: Instant,
}

/// The column of a record.
pub const RECORD: [&str; 1] = ["outcomes"];

impl Record<'_> {
    /// Writes what is not written yet.
    ///
    /// # Errors
    /// What the system says.
    pub fn end(mut self) -> Result<(), Failure> {
        self.flush()
    }

    fn flush(&mut self) -> Result<(), Failure> {
        self.written = Instant::now();
        let flushed = self.writer.as_mut().map_or(Ok(()), Write::flush);
        flushed.map_err(system(&self.of.path, "writing"))
    }
}

impl SearchRecord for Record<'_> {
    type Error = Failure;

    fn known(&mut self, batch: &SearchBatch<'_>) -> Result<Option<SearchOutcomes>, Failure> {
        if self.line == self.of.kept.rows || self.writer.is_some() {
            return Ok(None);
        }
        let failed = system(&self.of.path, "reading what there is of the run");
        let line = read_line(&mut self.reader).map_err(failed)?.unwrap_or_default();
        self.line += 1;
        self.sum.add_line(&batch.to_string());
        let outcomes = SummedLines::read(line.trim_end(), &mut self.sum);
        let read = outcomes.and_then(|outcomes| batch.read(outcomes));
        read.map(Some).ok_or_else(|| self.of.changed(self.line + 2))
    }

    fn keep(&mut self, batch: &SearchBatch<'_>, outcomes: &SearchOutcomes) -> Result<(), Failure> {
        let outcomes = outcomes.to_string();
        self.sum.add_line(&batch.to_string());
        self.sum.add_line(&outcomes);
        let writer = match &mut self.writer {
            Some(writer) => writer,
            none => none.insert(self.of.behind()?),
        };
        writeln!(writer, "{outcomes} {}", self.sum).map_err(system(&self.of.path, "writing"))?;
        match self.written.elapsed() > PAUSE {
            true => self.flush(),
            false => Ok(()),
        }
    }
}
