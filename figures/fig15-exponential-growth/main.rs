//! Figure 15 (fig:d-k-exp): growth rates of the exponential model over distance and wave number.

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
        ColorScale::diverging("$\\mathrm{Re}\\,z^+$", 0.5),
        2,
        84.0,
        &[
            MapPanel {
                name: "top_left",
                title: "$\\langle 12, 1, 0, 0\\rangle$",
                regions: &[("grows", (1.2, 1.2)), ("decays", (4.5, 2.0))],
            },
            MapPanel {
                name: "top_right",
                title: "$\\langle 12, 1, 0, 0.2\\rangle$",
                regions: &[("grows", (1.2, 1.2)), ("decays", (4.5, 2.0))],
            },
            MapPanel {
                name: "bottom_left",
                title: "$\\langle 12, 2, 0, 0\\rangle$",
                regions: &[("grows", (1.2, 1.2)), ("decays", (4.5, 2.6))],
            },
            MapPanel {
                name: "bottom_right",
                title: "$\\langle 12, 2, 0, 0.2\\rangle$",
                regions: &[("grows", (1.2, 1.2)), ("decays", (4.5, 2.6))],
            },
        ],
    )
}
