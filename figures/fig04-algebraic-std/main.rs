//! Figure 4 (fig:stdv_rec): standard deviation of the speeds, algebraic force.

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
        .titled("$\\mu = 0.45$", std_panel(&stable, 2000.0, 5.0, -6, (1e-8, 1e-5), [0.42, 0.36, 0.98, 0.97]))
        .titled("$\\mu = 0.55$", std_panel(&unstable, 1000.0, 1.0, 0, (1e-7, 1e1), [0.1, 0.36, 0.66, 0.97])))
}
