//! Figure 8 (fig:log_f): absolute value of the repulsive force of the logarithmic law.

use figures::panels::points;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Legend, Lines, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    // the critical distance a = a_n + a_{n+1} of pedestrians at rest is 2
    let force = points(&job.read("force")?, "gap", "force")?.into_iter().map(|(gap, force)| (gap / 2.0, force));
    let panel = Lines::new(
        Axis::linear("$\\Delta x_n / a$", 0.0, 2.0).steps(4),
        Axis::linear("$|f| \\, \\tau / v_0$", 0.0, 1.2).steps(4),
    )
    .legend(Legend::Hidden)
    .vertical(1.0)
    .horizontal(1.0)
    .series(Series::line("", force.collect()));
    Ok(Picture::new(COLUMN_WIDTH, 58.0).panel(panel))
}
