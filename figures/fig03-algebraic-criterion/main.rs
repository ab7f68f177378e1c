//! Figure 3 (fig:rec-models): the criterion of the algebraic models over strength and distance.

use figures::panels::{Labels, map_of};
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(COLUMN_WIDTH, 36.0)
        .scale(ColorScale::diverging("$\\Phi$", 0.5))
        .titled(
            "$\\langle \\mu, 0, 2, 0\\rangle$",
            map_of(job, "left", Labels::Both)?.region("unstable", (1.3, 0.45)).region("stable", (0.45, 1.75)),
        )
        .titled(
            "$\\langle \\mu, 1, 2, 0\\rangle$",
            map_of(job, "middle", Labels::Horizontal)?.region("unstable", (1.3, 0.35)).region("stable", (0.45, 1.75)),
        )
        .titled(
            "$\\langle \\mu, 0, 2, 0.2\\rangle$",
            map_of(job, "right", Labels::Horizontal)?.region("unstable", (1.3, 0.4)).region("stable", (0.45, 1.75)),
        ))
}
