//! Figure 10 (fig:new_av_v0): the criterion of the logarithmic law over widening and desired speed.

use figures::panels::{MapPanel, map_grid};
use figures::{Failure, Job, figure};
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    map_grid(
        job,
        ColorScale::diverging("$\\hat\\Phi$", 0.12),
        1,
        70.0,
        &[MapPanel { name: "map", title: "", regions: &[("unstable", (0.75, 5.6)), ("stable", (4.4, 1.6))] }],
    )
}
