//! Figure 9 (fig:newd_av): growth rates of the logarithmic law over widening, and over desired speed.

use figures::panels::map_grid;
use figures::titles::title;
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    map_grid(job, "$\\mathrm{Re}\\,\\hat z^+$", (2, 48.0), &["left", "right"], |panel| {
        title(panel, &[if panel.name == "left" { "law.v0" } else { "law.a_v" }])
    })
}
