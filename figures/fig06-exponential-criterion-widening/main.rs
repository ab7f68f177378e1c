//! Figure 6 (fig:avsfm): as figure 5, with a space requirement that grows with speed (a_v = 0.15).

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
        ColorScale::diverging("$\\tilde\\Phi$", 0.5),
        3,
        36.0,
        &[
            MapPanel {
                name: "left",
                title: "$d' = 2.5$",
                regions: &[("unstable", (6.2, 2.6)), ("stable", (1.5, 5.5))],
            },
            MapPanel {
                name: "middle",
                title: "$d' = 1.5$",
                regions: &[("unstable", (6.0, 3.0)), ("stable", (1.5, 5.5))],
            },
            MapPanel {
                name: "right",
                title: "$d' = 0.5$",
                regions: &[("unstable", (6.0, 3.0)), ("stable", (1.5, 5.5))],
            },
        ],
    )
}
