//! Figure 14 (fig:d-k): growth rates of the algebraic models over distance and wave number.

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
            "$\\langle 0.5, 0, 2, 0\\rangle$",
            map_of(job, "top_left", "top_left")?.region("unstable", (0.55, 1.2)).region("stable", (1.5, 2.2)),
        )
        .titled(
            "$\\langle 0.5, 0, 1, 0\\rangle$",
            map_of(job, "top_right", "top_right")?.region("unstable", (0.45, 0.9)).region("stable", (1.5, 2.2)),
        )
        .titled(
            "$\\langle 0.5, 0, 2, 0.1\\rangle$",
            map_of(job, "bottom_left", "bottom_left")?.region("unstable", (0.5, 1.2)).region("stable", (1.5, 2.2)),
        )
        .titled(
            "$\\langle 0.5, 1, 1, 0.1\\rangle$",
            map_of(job, "bottom_right", "bottom_right")?.region("stable", (1.1, 1.6)),
        ))
}
