//! Figure 3 (fig:rec-models): the criterion of the algebraic models over strength and gap.

use figures::panels::map_grid;
use figures::titles;
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    map_grid(job, "$\\Phi$", (3, 36.0), &["left", "middle", "right"], titles::law)
}
