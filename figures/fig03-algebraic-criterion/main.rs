//! Figure 3 (fig:rec-models): the criterion of the algebraic models over strength and distance.

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
        ColorScale::diverging("$\\Phi$", 0.5),
        3,
        36.0,
        &[
            MapPanel {
                name: "left",
                title: "$\\langle \\mu, 0, 2, 0\\rangle$",
                regions: &[("unstable", (1.3, 0.45)), ("stable", (0.45, 1.75))],
            },
            MapPanel {
                name: "middle",
                title: "$\\langle \\mu, 1, 2, 0\\rangle$",
                regions: &[("unstable", (1.3, 0.35)), ("stable", (0.45, 1.75))],
            },
            MapPanel {
                name: "right",
                title: "$\\langle \\mu, 0, 2, 0.2\\rangle$",
                regions: &[("unstable", (1.3, 0.4)), ("stable", (0.45, 1.75))],
            },
        ],
    )
}
