//! Figure 12 (fig:jams_vel): speeds of all pedestrians at two times.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::COLUMN_WIDTH;
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
    let published = || {
        Ok::<_, Failure>(Series::points(
            "published",
            Marker::Circle,
            points(&job.reference("published_speed_t300")?, "n", "v")?,
        ))
    };
    let regenerated = |table: &str| Ok::<_, Failure>(Series::line("regenerated", points(&job.read(table)?, "n", "v")?));
    // where the first waves are, enlarged
    let waves = Lines::new(Axis::linear("", 95.0, 135.0).steps(4), Axis::linear("", 0.62, 0.68).steps(3))
        .legend(Legend::Hidden)
        .series(published()?.look(2))
        .series(regenerated("t300")?.look(0));
    let early = panel(Legend::Corner(Corner::TopRight))
        .series(published()?.look(2))
        .series(regenerated("t300")?.look(0))
        .inset([0.02, 0.03, 0.66, 0.5], waves);
    let late = panel(Legend::Hidden).series(regenerated("t2000")?);
    Ok(Picture::new(COLUMN_WIDTH, 100.0).columns(1).titled("$t = 300$", early).titled("$t = 2000$", late))
}

fn panel(legend: Legend) -> Lines {
    Lines::new(Axis::linear("pedestrian $n$", 0.0, 140.0).steps(4), Axis::linear("speed $v_n$", 0.0, 1.2).steps(4))
        .legend(legend)
}
