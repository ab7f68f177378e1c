//! Figure 5 (fig:sfm): the criterion of the exponential model over strength and range, for three distances.

use figures::panels::map_of;
use figures::{Failure, Job, figure};
use plot::style::FULL_WIDTH;
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(FULL_WIDTH, 60.0)
        .scale(ColorScale::diverging("$\\tilde\\Phi$", 0.5))
        .titled("$d' = 2.5$", map_of(job, "left", "left")?.region("unstable", (6.5, 2.0)).region("stable", (1.5, 4.5)))
        .titled(
            "$d' = 1.5$",
            map_of(job, "middle", "middle")?.region("unstable", (6.5, 2.0)).region("stable", (1.5, 4.5)),
        )
        .titled(
            "$d' = 0.5$",
            map_of(job, "right", "right")?.region("unstable", (6.5, 2.0)).region("stable", (1.5, 4.5)),
        ))
}
