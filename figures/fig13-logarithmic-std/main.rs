//! Figure 13 (fig:std_vel_log): standard deviation of the speeds, logarithmic force.

use figures::panels::points;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Legend, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::take_deviations, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let published = points(&job.reference("published_std_log")?, "t", "std")?;
    let panel = Lines::new(Axis::linear("$t$", 0.0, 3000.0).steps(3), Axis::linear("std of speeds", 0.0, 0.5).steps(5))
        .legend(Legend::Corner(Corner::TopLeft))
        .series(Series::points("published", Marker::Circle, published).every(4).look(2))
        .series(Series::line("$\\epsilon_1 = 0.1$", points(&job.read("std")?, "t", "std")?).look(0))
        .series(
            Series::line("$\\epsilon_1 = 10^{-4}$ (text)", points(&job.read("std_small_shift")?, "t", "std")?).look(1),
        );
    Ok(Picture::new(COLUMN_WIDTH, 62.0).panel(panel))
}
