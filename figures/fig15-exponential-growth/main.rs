//! Figure 15 (fig:d-k-exp): growth rates of the exponential model over distance and wave number.

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
            "$\\langle 12, 1, 0, 0\\rangle$",
            map_of(job, "top_left", Labels::Vertical)?.region("grows", (1.2, 1.2)).region("decays", (4.5, 2.0)),
        )
        .titled(
            "$\\langle 12, 1, 0, 0.2\\rangle$",
            map_of(job, "top_right", Labels::None)?.region("grows", (1.2, 1.2)).region("decays", (4.5, 2.0)),
        )
        .titled(
            "$\\langle 12, 2, 0, 0\\rangle$",
            map_of(job, "bottom_left", Labels::Both)?.region("grows", (1.2, 1.2)).region("decays", (4.5, 2.6)),
        )
        .titled(
            "$\\langle 12, 2, 0, 0.2\\rangle$",
            map_of(job, "bottom_right", Labels::Horizontal)?.region("grows", (1.2, 1.2)).region("decays", (4.5, 2.6)),
        ))
}
