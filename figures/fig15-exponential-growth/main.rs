//! Figure 15 (fig:d-k-exp): growth rates of the exponential model over gap and wave number.

use figures::panels::map_grid;
use figures::titles;
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    map_grid(
        job,
        "$\\mathrm{Re}\\,z^+$",
        (2, 84.0),
        &["top_left", "top_right", "bottom_left", "bottom_right"],
        titles::law,
    )
}
