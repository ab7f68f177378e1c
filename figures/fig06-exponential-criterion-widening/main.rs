//! Figure 6 (fig:avsfm): as figure 5, with velocity-dependent size (a_v = 0.15).

use figures::panels::map_grid;
use figures::titles;
use figures::{Failure, Job, figure};
use plot::Picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    map_grid(job, "$\\tilde\\Phi$", (3, 36.0), &["left", "middle", "right"], |panel| {
        titles::title(panel, &["uniform.d_gap"])
    })
}
