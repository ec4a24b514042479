//! Parts of a long run: `--shard I/N` computes one of them, `--resume` what is not there yet.

use super::resume::Unfinished;
use super::rows::Rows;
use super::shard::{Label, Shard};
use super::{Content, Failure, Options};

/// `--shard`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct PartArguments {
    /// Compute only part I of N, as CSV; `merge` joins the parts
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Continue an interrupted run from FILE.part, where --out FILE keeps its rows meanwhile
    #[arg(long)]
    pub resume: bool,
}

impl PartArguments {
    /// What there is of a run that may be gone on with, where that is asked for; `follows`: whether each value follows the
    /// one before.
    pub fn unfinished(
        &self,
        options: &Options,
        follows: bool,
        label: impl FnOnce(Shard) -> Result<Label, Failure>,
        columns: &[&str],
    ) -> Result<Option<Unfinished>, Failure> {
        if !self.resume {
            return Ok(None);
        }
        if follows {
            let problem = "each value follows the one before it (start = \"follow\"): such a run is not gone on with";
            return Err(Failure::Usage(problem.to_owned()));
        }
        let label = label(self.shard.unwrap_or(Shard::WHOLE))?;
        Unfinished::open(options, self.shard, label, columns).map(Some)
    }

    /// The rows as they are to be written.
    pub fn content(rows: Rows, label: Option<Label>, unfinished: Option<Unfinished>) -> Content {
        match unfinished {
            Some(unfinished) => Content::Unfinished(unfinished, rows),
            None => Content::Rows(rows.part(label)),
        }
    }
}
