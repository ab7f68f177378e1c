//! Figure 7 (fig:vstd_exp): standard deviation of the speeds, exponential force.

use figures::panels::{points, std_panel};
use figures::{Failure, Job, figure};
use plot::Picture;
use plot::style::COLUMN_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    job.take("stable", "std", "stable")?;
    job.take("unstable", "std", "unstable")
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let stable = points(&job.read("stable")?, "t", "std")?;
    let unstable = points(&job.read("unstable")?, "t", "std")?;
    Ok(Picture::new(COLUMN_WIDTH, 100.0)
        .columns(1)
        .titled("$a = 1.5,\\; b = 1.5$", std_panel(&stable, 2000.0, 5.0, -6, (1e-8, 1e-5), [0.3, 0.26, 0.97, 0.96]))
        .titled("$a = 3,\\; b = 1.5$", std_panel(&unstable, 500.0, 0.4, 0, (1e-6, 1e0), [0.03, 0.26, 0.7, 0.96])))
}
