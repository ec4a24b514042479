//! `vibro-audit audit --proof DIR`: the forms in which proofs and counterexamples are written.

use super::Failure;
use super::audit_table::Row;
use crate::claim::{Sheet, Verdict};
use crate::prove::{self, NoScript};
use crate::report::{Format, NewDirectory, OutputError};
use crate::stop::Token;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// The form of proofs that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProofForm {
    /// Python scripts that check themselves.
    Python,
    /// Data with a checker and a schema.
    Json,
    /// Short scripts for people.
    Sympy,
}

/// What is written of a claim.
type Written = Result<Vec<String>, NoScript>;

impl ProofForm {
    /// The form that a format asks for.
    ///
    /// # Errors
    /// A format that is one of proofs alone, where none are written.
    pub fn of(format: Format, has_proofs: bool) -> Result<Self, Failure> {
        match format {
            Format::Sympy if !has_proofs => Err(Failure::Usage(format!(
                "--format {format} is the form of the files that --proof DIR writes: name a DIR"
            ))),
            Format::Sympy => Ok(Self::Sympy),
            Format::Json => Ok(Self::Json),
            _ => Ok(Self::Python),
        }
    }

    /// The ending of the files, what they are, and how they are used.
    fn described(self) -> [&'static str; 3] {
        match self {
            Self::Python => ["py", "scripts", "run each with Python, with SymPy and mpmath"],
            Self::Json => [
                "json",
                "files of proof data",
                "python3 check.py *.json there checks them, with SymPy and mpmath",
            ],
            Self::Sympy => ["py", "short scripts", "read each, and run it with Python and SymPy"],
        }
    }

    /// The files about a claim.
    fn files(self, sheet: &Sheet, position: usize, options: &prove::Options) -> Written {
        match self {
            Self::Python => Ok(prove::scripts(sheet, position, options)),
            Self::Json => Ok(prove::proof_data(sheet, position, options)),
            Self::Sympy => prove::short_scripts(sheet, position, options),
        }
    }

    /// Writes a file for each question that decides a row, or one for all of a row, into a new directory.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(
        self,
        sheet: &Sheet,
        rows: &[Row],
        new: NewDirectory,
        directory: &Path,
        options: &prove::Options,
    ) -> Result<(), Failure> {
        let [ending, what, how] = self.described();
        let rows: Vec<usize> = rows
            .iter()
            .filter(|row| is_decided(row))
            .map(|row| row.position)
            .collect();
        let names = prove::file_names(sheet, &rows);
        let token = Token::current();
        let write = |(position, name): (&usize, &String)| -> Result<Result<usize, NoScript>, OutputError> {
            let files = match token.during(|| self.files(sheet, *position, options)) {
                Ok(files) => files,
                Err(none) => return Ok(Err(none)),
            };
            for (number, file) in (1..).zip(&files) {
                let name = match number {
                    1 => format!("{name}.{ending}"),
                    _ => format!("{name}-{number}.{ending}"),
                };
                new.write(&name, file.as_bytes())?;
            }
            Ok(Ok(files.len()))
        };
        let written: Result<Vec<_>, OutputError> = rows.par_iter().zip(&names).map(write).collect();
        let written = written?;
        if self == Self::Json {
            new.write("schema.json", prove::SCHEMA.as_bytes())?;
            new.write("check.py", prove::CHECKER.as_bytes())?;
        }
        new.finish()?;
        let count: usize = written.iter().flatten().sum();
        super::note(&format!("{count} {what} in {}: {how}", directory.display()));
        tell_without(sheet, &rows, &written, what);
        Ok(())
    }
}

fn is_decided(row: &Row) -> bool {
    match row.decision.verdict {
        Verdict::Proved | Verdict::Refuted | Verdict::Conditional => true,
        Verdict::Undecided | Verdict::Unread | Verdict::Given | Verdict::Suspect => false,
    }
}

/// Says which decided claims have no file, and why.
fn tell_without(sheet: &Sheet, rows: &[usize], written: &[Result<usize, NoScript>], what: &str) {
    let mut without: BTreeMap<&NoScript, Vec<String>> = BTreeMap::new();
    for (position, written) in rows.iter().zip(written) {
        if let (Err(none), Some(entry)) = (written, sheet.entries.get(*position)) {
            without.entry(none).or_default().push(format!("({})", entry.label));
        }
    }
    let count: usize = without.values().map(Vec::len).sum();
    if count > 0 {
        let reasons = without
            .iter()
            .map(|(none, labels)| format!("{none}: {}", labels.join(", ")));
        let reasons: Vec<String> = reasons.collect();
        super::note(&format!(
            "{count} of {} decided claims have no {what} of their own, as this takes\n  {}",
            rows.len(),
            reasons.join("\n  ")
        ));
    }
}
