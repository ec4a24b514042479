//! `vibro-audit audit [SHEET] [--explain LABEL]`.

use super::{Answer, Content, Exit, Failure, Options, Source};
use crate::claim::{self, Decision, Role, Sheet};
use crate::report::{Cell, Table};

/// Decide for each formula of a sheet whether it follows from its premises
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The sheet, a TOML file or `-` for stdin; without it, the paper's own appendix
    #[arg(value_name = "SHEET")]
    sheet: Option<Source>,
    /// Print the proof or the counterexample of this equation alone
    #[arg(long, value_name = "LABEL")]
    explain: Option<String>,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 6] = ["label", "verdict", "expected", "digits", "counterexample", "reason"];

/// Runs the command.
pub fn run(arguments: &Arguments, _options: &Options) -> Result<Answer, Failure> {
    let name = arguments
        .sheet
        .as_ref()
        .map_or("the paper's equations".to_string(), |source| source.name().to_string());
    let in_sheet = |fault: claim::Fault| Failure::Sheet {
        name: name.clone(),
        fault,
    };
    let vocabulary = claim::vocabulary().map_err(in_sheet)?;
    let text = match &arguments.sheet {
        Some(source) => source.read()?,
        None => claim::EQUATIONS.to_string(),
    };
    let sheet = Sheet::read(&text, &vocabulary).map_err(in_sheet)?;
    match &arguments.explain {
        Some(label) => explain(&sheet, label).map_err(in_sheet),
        None => {
            let decisions = sheet.audit().map_err(in_sheet)?;
            let mut table = Table::new(COLUMNS);
            for decision in &decisions {
                table.push(row(decision))?;
            }
            let exit = Exit::from_verdict(decisions.iter().all(Decision::is_expected));
            Ok(Answer {
                content: Content::Table(table),
                exit,
            })
        }
    }
}

fn row(decision: &Decision) -> Vec<Cell> {
    vec![
        Cell::from(decision.label.clone()),
        Cell::from(decision.verdict.to_string()),
        Cell::from(decision.expected.to_string()),
        Cell::Empty,
        Cell::from(decision.counterexample.as_ref().map(ToString::to_string)),
        Cell::from(decision.reason.clone()),
    ]
}

fn explain(sheet: &Sheet, label: &str) -> Result<Answer, claim::Fault> {
    let wanted = sheet
        .find(label)
        .filter(|&n| sheet.entries.get(n).is_some_and(|e| e.role == Role::Claim));
    let Some(position) = wanted else {
        let claims = sheet.entries.iter().filter(|entry| entry.role == Role::Claim);
        let known: Vec<&str> = claims.map(|entry| entry.label.as_str()).collect();
        return Err(claim::Fault::new(format!(
            "no claim `{label}` (there are: {})",
            known.join(", ")
        )));
    };
    let decision = sheet.decide(position)?;
    let text = sheet.explain(position, &decision)?;
    Ok(Answer {
        content: Content::Text(text),
        exit: Exit::from_verdict(decision.is_expected()),
    })
}
