//! Figure 14 (fig:d-k): growth rates of the algebraic models over distance and wave number.

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
        ColorScale::diverging("$\\mathrm{Re}\\,z^+$", 0.2),
        2,
        84.0,
        &[
            MapPanel {
                name: "top_left",
                title: "$\\langle 0.5, 0, 2, 0\\rangle$",
                regions: &[("grows", (0.55, 1.2)), ("decays", (1.5, 2.2))],
            },
            MapPanel {
                name: "top_right",
                title: "$\\langle 0.5, 0, 1, 0\\rangle$",
                regions: &[("grows", (0.45, 0.35)), ("decays", (1.5, 2.2))],
            },
            MapPanel {
                name: "bottom_left",
                title: "$\\langle 0.5, 0, 2, 0.1\\rangle$",
                regions: &[("grows", (0.5, 1.2)), ("decays", (1.5, 2.2))],
            },
            MapPanel {
                name: "bottom_right",
                title: "$\\langle 0.5, 1, 1, 0.1\\rangle$",
                regions: &[("decays", (1.1, 1.6))],
            },
        ],
    )
}
