//! Supplement 19: lasting waves of the algebraic law with relative speed, which the paper simulates nowhere: the speeds of
//! all (a), the standard deviation (b), and how everybody walks in the end (c).

use figures::panels::{points, trajectories};
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Lines, Picture, Series, SpaceTime};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The trajectories are kept from here to the next of these times, where the waves have their final form, and shown.
const WINDOW: [f64; 2] = [900.0, 930.0];

fn tables(job: &mut Job) -> Result<(), Failure> {
    job.take("main", "std", "std")?;
    let run = job.run_table("main", "trajectories")?;
    let columns: Vec<&str> = run.columns.iter().map(String::as_str).collect();
    let mut window = Table::new(&columns);
    run.rows().filter(|row| (WINDOW[0]..=WINDOW[1]).contains(&row[0])).for_each(|row| window.push(row));
    job.write("window", &window)?;
    let mut last = Table::new(&["n", "x", "v"]);
    let end = run.rows().map(|row| row[0]).fold(0.0, |end, t| if t > end { t } else { end });
    run.rows().filter(|row| row[0] == end).for_each(|row| last.push(&row[1..]));
    job.write("last", &last)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let scene = scene::run::read(&job.recipe.file, &job.panel("main")?.tables)?;
    let length = scene.ring.length;
    let paths = trajectories(&job.read("window")?)?;
    let speeds = paths.iter().flatten().map(|sample| sample[2]);
    let time = Axis::linear("$t$", WINDOW[0], WINDOW[1]).steps(3);
    let whole = SpaceTime::new(time, Axis::linear("$x'$", 0.0, length).steps(4), length, &paths).line_width(0.2);
    let std = points(&job.read("std")?, "t", "std")?;
    let heights = Axis::from_zero("std of speeds", std.iter().map(|&(_, std)| std)).steps(2);
    let growth = Lines::new(Axis::linear("$t$", 0.0, scene.t_end).steps(4), heights).series(Series::line("", std));
    let last = points(&job.read("last")?, "n", "v")?;
    let range = Axis::from_zero("$v_n$", last.iter().map(|&(_, v)| v)).steps(2);
    let count = scene.ring.pedestrians as f64;
    let form = Lines::new(Axis::linear("$n$", 0.0, count - 1.0).steps(4), range).series(Series::line("", last));
    Ok(Picture::new(COLUMN_WIDTH, 150.0)
        .columns(1)
        .row_shares(&[2.0, 1.0, 1.0])
        .scale(ColorScale::sequential("speed $v_n$", speeds))
        .titled("paths of all", whole)
        .titled("std of speeds", growth)
        .titled("speeds at the end", form))
}
