//! Figure 9 (fig:newd_av): growth rates of the logarithmic law over widening, and over desired speed.

use figures::panels::map_of;
use figures::{Failure, Job, figure};
use plot::{ColorScale, Picture};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let left = map_of(job, "left", "left")?.region("unstable", (0.5, 1.0)).region("stable", (1.5, 2.7));
    let right = map_of(job, "right", "right")?.region("unstable", (4.5, 1.4)).region("stable", (0.3, 2.0));
    Ok(Picture::new(140.0, 62.0)
        .scale(ColorScale::diverging("$\\mathrm{Re}\\,\\hat z^+$", 0.2))
        .titled("$v_0' = 3$", left)
        .titled("$\\tilde a_v = 0$", right))
}
