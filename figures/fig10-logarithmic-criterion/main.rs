//! Figure 10 (fig:new_av_v0): the criterion of the logarithmic law over widening and desired speed.

use figures::panels::map_grid;
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    map_grid(job, "$\\hat\\Phi$", (1, 70.0), &["map"], |_| String::new())
}
