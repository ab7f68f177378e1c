//! Figure 10 (fig:new_av_v0): the criterion of the logarithmic law over widening and desired speed.

use figures::panels::map_of;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    let panel = job.panel("main")?.clone();
    job.compute(&panel, "map")
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let map = map_of(job, "main", "map")?.region("unstable", (1.2, 5.0)).region("stable", (4.4, 1.6));
    Ok(Picture::new(COLUMN_WIDTH, 70.0).scale(ColorScale::diverging("$\\hat\\Phi$", 0.12)).panel(map))
}
