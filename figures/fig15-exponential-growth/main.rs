//! Figure 15 (fig:d-k-exp): growth rates of the exponential model over distance and wave number.

use figures::panels::map_of;
use figures::{Failure, Job, figure};
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(140.0, 112.0)
        .columns(2)
        .scale(ColorScale::diverging("$\\mathrm{Re}\\,z^+$", 0.2))
        .titled(
            "$\\langle 12, 1, 0, 0\\rangle$",
            map_of(job, "top_left", "top_left")?.region("unstable", (1.2, 1.2)).region("stable", (4.5, 2.0)),
        )
        .titled(
            "$\\langle 12, 1, 0, 0.2\\rangle$",
            map_of(job, "top_right", "top_right")?.region("unstable", (1.2, 1.2)).region("stable", (4.5, 2.0)),
        )
        .titled(
            "$\\langle 12, 2, 0, 0\\rangle$",
            map_of(job, "bottom_left", "bottom_left")?.region("unstable", (1.2, 1.2)).region("stable", (4.5, 2.6)),
        )
        .titled(
            "$\\langle 12, 2, 0, 0.2\\rangle$",
            map_of(job, "bottom_right", "bottom_right")?.region("unstable", (1.2, 1.2)).region("stable", (4.5, 2.6)),
        ))
}
