//! The commands, their input, output and exit statuses.

#[path = "../common/mod.rs"]
mod common;

mod asked_digits;
mod audits;
mod check;
mod cli;
mod columns;
mod fuzz;
mod hostile;
mod lsp;
mod mcp;
mod merge;
mod page;
mod peers;
mod plot;
mod readme;
mod report;
mod scene_cost;
mod scenes;
mod score;
mod stress;
