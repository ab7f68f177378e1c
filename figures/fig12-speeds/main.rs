//! Figure 12 (fig:jams_vel): speeds of all pedestrians at two times.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::FULL_WIDTH;
use plot::{Axis, Corner, Legend, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    let run = job.run_table("main", "trajectories")?;
    for (name, time) in [("t300", 300.0), ("t2000", 2000.0)] {
        let mut table = Table::new(&["n", "x", "v"]);
        run.rows().filter(|row| row[0] == time).for_each(|row| table.push(&row[1..]));
        job.write(name, &table)?;
    }
    Ok(())
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let published = points(&job.reference("published_speed_t300")?, "n", "v")?;
    Ok(Picture::new(FULL_WIDTH, 62.0)
        .titled("$t = 300$", speeds(job, "t300")?.series(Series::points("published", Marker::Circle, published)))
        .titled("$t = 2000$", speeds(job, "t2000")?))
}

fn speeds(job: &Job, table: &str) -> Result<Lines, Failure> {
    let name = if table == "t300" { "regenerated" } else { "" };
    Ok(Lines::new(Axis::linear("pedestrian $n$", 0.0, 140.0).steps(4), Axis::linear("speed $v_n$", 0.0, 1.2).steps(4))
        .legend(Legend::Corner(Corner::TopRight))
        .series(Series::line(name, points(&job.read(table)?, "n", "v")?)))
}
