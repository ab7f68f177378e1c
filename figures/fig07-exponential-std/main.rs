//! Figure 7 (fig:vstd_exp): standard deviation of the speeds, exponential force.

use figures::panels::std_column;
use figures::titles::title;
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::take_deviations, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let insets = [("stable", [0.3, 0.26, 0.97, 0.96]), ("unstable", [0.03, 0.26, 0.7, 0.96])];
    std_column(job, &insets, |panel| title(panel, &["law.a", "law.b"]))
}
