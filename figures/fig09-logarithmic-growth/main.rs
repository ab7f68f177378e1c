//! Figure 9 (fig:newd_av): growth rates of the logarithmic law over widening, and over desired speed.

use figures::panels::{Labels, map_of};
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let left = map_of(job, "left", Labels::Both)?.region("grows", (0.34, 0.5)).region("decays", (1.5, 2.7));
    let right = map_of(job, "right", Labels::Horizontal)?.region("grows", (4.5, 1.4)).region("decays", (1.1, 2.55));
    Ok(Picture::new(COLUMN_WIDTH, 48.0)
        .scale(ColorScale::diverging("$\\mathrm{Re}\\,\\hat z^+$", 0.2))
        .titled("$v_0' = 3$", left)
        .titled("$\\tilde a_v = 0$", right))
}
