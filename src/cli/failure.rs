//! Why a command has no answer: always the input's fault, or a place's that cannot be written; exit 2.

use super::source::SourceError;
use crate::report::{OutputError, RowError};

/// Why a command has no answer. The message says what, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
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
    Sheet { name: String, fault: crate::claim::Fault },
    /// A measurement failed.
    #[error(transparent)]
    Trade(#[from] crate::accuracy::TradeError),
}
