//! Supplement 5: error against work of every method, the unstable exponential run of figure 7.

use figures::{Failure, Job, figure};
use std::process::ExitCode;
use studies::precision_panel;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, precision_panel::picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    precision_panel::tables(job, "exponential_unstable")
}
