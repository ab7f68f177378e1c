//! Figure 13 (fig:std_vel_log): standard deviation of the speeds, logarithmic force.

use figures::panels::points;
use figures::titles::title;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::take_deviations, picture)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let published = points(&job.reference("published_std_log")?, "t", "std")?;
    let curve = |name| points(&job.read(name)?, "t", "std");
    let (run, small) = (curve("std")?, curve("std_small_shift")?);
    let shift = |name| Ok::<_, Failure>(title(job.panel(name)?, &["start.shift"]));
    let times = Axis::around("$t$", run.iter().map(|point| point.0));
    let heights = Axis::from_zero("std of speeds", run.iter().chain(&published).map(|point| point.1));
    let panel = Lines::new(times.steps(3), heights)
        .legend(Corner::TopLeft)
        .series(Series::points("published", Marker::Circle, published).every(4).look(2))
        .series(Series::line(&shift("std")?, run).look(0))
        .series(Series::line(&format!("{} (text)", shift("std_small_shift")?), small).look(1));
    Ok(Picture::new(COLUMN_WIDTH, 62.0).panel(panel))
}
