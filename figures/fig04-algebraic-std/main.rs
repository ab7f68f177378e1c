//! Figure 4 (fig:stdv_rec): standard deviation of the speeds, algebraic force.

use figures::panels::{StdPanel, std_column};
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::take_deviations, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    std_column(
        job,
        &[
            StdPanel {
                name: "stable",
                title: "$\\mu = 0.45$",
                t_end: 2000.0,
                top: 5.0,
                power: -6,
                decades: (1e-8, 1e-5),
                inset: [0.3, 0.26, 0.97, 0.96],
            },
            StdPanel {
                name: "unstable",
                title: "$\\mu = 0.55$",
                t_end: 1000.0,
                top: 0.4,
                power: 0,
                decades: (1e-6, 1e0),
                inset: [0.03, 0.26, 0.7, 0.96],
            },
        ],
    )
}
