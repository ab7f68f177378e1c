//! Figure 10 (fig:new_av_v0): the criterion of the logarithmic law over widening and desired speed.

use figures::panels::{Labels, map_of};
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let map = map_of(job, "map", Labels::Both)?.region("unstable", (0.75, 5.6)).region("stable", (4.4, 1.6));
    Ok(Picture::new(COLUMN_WIDTH, 70.0).scale(ColorScale::diverging("$\\hat\\Phi$", 0.12)).panel(map))
}
