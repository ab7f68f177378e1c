//! Figure 9 (fig:newd_av): growth rates of the logarithmic law over widening, and over desired speed.

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
        ColorScale::diverging("$\\mathrm{Re}\\,\\hat z^+$", 0.2),
        2,
        48.0,
        &[
            MapPanel { name: "left", title: "$v_0' = 3$", regions: &[("grows", (0.34, 0.5)), ("decays", (1.5, 2.7))] },
            MapPanel {
                name: "right",
                title: "$\\tilde a_v = 0$",
                regions: &[("grows", (4.5, 1.4)), ("decays", (1.1, 2.55))],
            },
        ],
    )
}
