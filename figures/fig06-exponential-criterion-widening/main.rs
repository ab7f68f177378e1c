//! Figure 6 (fig:avsfm): as figure 5, with a space requirement that grows with speed (a_v = 0.15).

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
        .scale(ColorScale::diverging("$\\tilde\\Phi$", 0.5))
        .titled(
            "$d' = 2.5$",
            map_of(job, "left", Labels::Both)?.region("unstable", (6.0, 3.0)).region("stable", (1.5, 5.5)),
        )
        .titled(
            "$d' = 1.5$",
            map_of(job, "middle", Labels::Horizontal)?.region("unstable", (6.0, 3.0)).region("stable", (1.5, 5.5)),
        )
        .titled(
            "$d' = 0.5$",
            map_of(job, "right", Labels::Horizontal)?.region("unstable", (6.0, 3.0)).region("stable", (1.5, 5.5)),
        ))
}
