//! Figure 14 (fig:d-k): growth rates of the algebraic models over distance and wave number.

use figures::panels::{Labels, map_of};
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(COLUMN_WIDTH, 84.0)
        .columns(2)
        .scale(ColorScale::diverging("$\\mathrm{Re}\\,z^+$", 0.2))
        .titled(
            "$\\langle 0.5, 0, 2, 0\\rangle$",
            map_of(job, "top_left", Labels::Vertical)?.region("grows", (0.55, 1.2)).region("decays", (1.5, 2.2)),
        )
        .titled(
            "$\\langle 0.5, 0, 1, 0\\rangle$",
            map_of(job, "top_right", Labels::None)?.region("grows", (0.45, 0.9)).region("decays", (1.5, 2.2)),
        )
        .titled(
            "$\\langle 0.5, 0, 2, 0.1\\rangle$",
            map_of(job, "bottom_left", Labels::Both)?.region("grows", (0.5, 1.2)).region("decays", (1.5, 2.2)),
        )
        .titled(
            "$\\langle 0.5, 1, 1, 0.1\\rangle$",
            map_of(job, "bottom_right", Labels::Horizontal)?.region("decays", (1.1, 1.6)),
        ))
}
