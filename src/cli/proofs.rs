//! `vibro-audit audit --proof DIR`: the forms in which proofs and counterexamples are written.

use super::Failure;
use super::audit_table::Row;
use crate::claim::Sheet;
use crate::prove::{self, rocq};
use crate::report::{Format, NewDirectory, OutputError};
use crate::stop::Token;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The form of proofs that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProofForm {
    /// Data with a checker and a schema.
    Json,
    /// Short scripts for people.
    Sympy,
    /// Theorems for Rocq, with the library that they rest on.
    Rocq,
}

/// The files that are written of a claim, and why others are not.
struct Written {
    files: Vec<String>,
    missing: Vec<String>,
}

impl ProofForm {
    /// The form that a format asks for.
    ///
    /// # Errors
    /// A format that is one of proofs alone, where none are written.
    pub fn of(format: Format, has_proofs: bool) -> Result<Self, Failure> {
        match format {
            Format::Sympy | Format::Rocq if !has_proofs => Err(Failure::Usage(format!(
                "--format {format} is the form of the files that --proof DIR writes: name a DIR"
            ))),
            Format::Sympy => Ok(Self::Sympy),
            Format::Rocq => Ok(Self::Rocq),
            _ => Ok(Self::Json),
        }
    }

    /// The ending of the files, what they are, and how they are used.
    fn described(self) -> [&'static str; 3] {
        match self {
            Self::Json => [
                "json",
                "files of proof data",
                "python3 check.py *.json there checks them, with python-flint",
            ],
            Self::Sympy => ["py", "short scripts", "read each, and run it with Python and SymPy"],
            Self::Rocq => [
                "v",
                "files for Rocq",
                "sh check.sh there checks them, with Rocq, Coquelicot and Interval",
            ],
        }
    }

    /// The files about a claim.
    fn files(self, sheet: &Sheet, position: usize, options: &prove::Options) -> Written {
        let whole = |files| Written {
            files,
            missing: Vec::new(),
        };
        match self {
            Self::Json => whole(prove::proof_data(sheet, position, options)),
            Self::Sympy => match prove::short_scripts(sheet, position, options) {
                Ok(files) => whole(files),
                Err(none) => Written {
                    files: Vec::new(),
                    missing: vec![none.to_string()],
                },
            },
            Self::Rocq => {
                let (mut files, mut missing) = (Vec::new(), BTreeSet::new());
                for file in rocq::files(sheet, position, &prove::decided(sheet, position, options)) {
                    match file {
                        Ok(text) => files.push(text),
                        Err(unwritten) => {
                            missing.insert(unwritten.to_string());
                        }
                    }
                }
                let missing = missing.into_iter().collect();
                Written { files, missing }
            }
        }
    }

    /// The names of files without their endings; those of Rocq are names of modules.
    fn names(self, sheet: &Sheet, rows: &[usize]) -> Vec<String> {
        let names = prove::file_names(sheet, rows);
        if self != Self::Rocq {
            return names;
        }
        let mut taken = BTreeSet::new();
        let module = |name: String| {
            // two underscores stand before the number of a further file
            let plain = name.replace(['.', '-'], "_");
            let parts: Vec<&str> = plain.split('_').filter(|part| !part.is_empty()).collect();
            let mut module = format!("eq_{}", parts.join("_"));
            while !taken.insert(module.clone()) {
                module.push('_');
            }
            module
        };
        names.into_iter().map(module).collect()
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
            .filter(|row| row.is_decided())
            .map(|row| row.position)
            .collect();
        let names = self.names(sheet, &rows);
        let token = Token::current();
        let between = if self == Self::Rocq { "__" } else { "-" };
        let write = |(position, name): (&usize, &String)| -> Result<Written, OutputError> {
            let written = token.during(|| self.files(sheet, *position, options));
            for (number, file) in (1..).zip(&written.files) {
                let name = match number {
                    1 => format!("{name}.{ending}"),
                    _ => format!("{name}{between}{number}.{ending}"),
                };
                new.write(&name, file.as_bytes())?;
            }
            Ok(written)
        };
        let written: Result<Vec<_>, OutputError> = rows.par_iter().zip(&names).map(write).collect();
        let written = written?;
        if self == Self::Json {
            new.write("schema.json", prove::SCHEMA.as_bytes())?;
            new.write("check.py", prove::CHECKER.as_bytes())?;
        }
        if self == Self::Rocq {
            for (name, text) in rocq::LIBRARY {
                new.write(name, text.as_bytes())?;
            }
            new.write("check.sh", rocq::CHECK.as_bytes())?;
        }
        new.finish()?;
        let count: usize = written.iter().map(|written| written.files.len()).sum();
        super::note(&format!("{count} {what} in {}: {how}", directory.display()));
        tell_without(sheet, &rows, &written, what);
        Ok(())
    }
}

/// Says which decided claims have no file, or not one for all of them, and why.
fn tell_without(sheet: &Sheet, rows: &[usize], written: &[Written], what: &str) {
    let mut without: BTreeMap<&String, Vec<String>> = BTreeMap::new();
    for (position, written) in rows.iter().zip(written) {
        for missing in &written.missing {
            let label = sheet.entries.get(*position).map_or("", |entry| entry.label.as_str());
            without.entry(missing).or_default().push(format!("({label})"));
        }
    }
    let count = written.iter().filter(|written| !written.missing.is_empty()).count();
    if count > 0 {
        let reasons = without
            .iter()
            .map(|(why, labels)| format!("{why}: {}", labels.join(", ")));
        let reasons: Vec<String> = reasons.collect();
        super::note(&format!(
            "{count} of {} decided claims are not written as {what}, or not all of them, as this takes\n  {}",
            rows.len(),
            reasons.join("\n  ")
        ));
    }
}
