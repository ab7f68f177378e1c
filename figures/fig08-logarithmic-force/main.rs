//! Figure 8 (fig:log_f): absolute value of the repulsive force of the logarithmic law.

use figures::panels::points;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Lines, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    // the critical distance a = a_n + a_{n+1} of pedestrians at rest is 2
    let force: Vec<_> =
        points(&job.read("force")?, "gap", "force")?.into_iter().map(|(gap, force)| (gap / 2.0, force)).collect();
    let distances = Axis::around("$\\Delta x_n / a$", force.iter().map(|point| point.0));
    let forces = Axis::from_zero("$|f| \\, \\tau / v_0$", force.iter().map(|point| point.1));
    let panel = Lines::new(distances.steps(4), forces).vertical(1.0).horizontal(1.0).series(Series::line("", force));
    Ok(Picture::new(COLUMN_WIDTH, 58.0).panel(panel))
}
