//! Figure 7 (fig:vstd_exp): standard deviation of the speeds, exponential force.

use figures::panels::{points, std_panel};
use figures::{Failure, Job, figure};
use plot::Picture;
use plot::style::FULL_WIDTH;
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
    Ok(Picture::new(FULL_WIDTH, 66.0)
        .titled("$a = 1.5,\\; b = 1.5$", std_panel(&stable, 2000.0, 5.0, -6, (1e-8, 1e-5), [0.42, 0.36, 0.98, 0.97]))
        .titled("$a = 3,\\; b = 1.5$", std_panel(&unstable, 500.0, 0.4, 0, (1e-7, 1e0), [0.1, 0.36, 0.66, 0.97])))
}
