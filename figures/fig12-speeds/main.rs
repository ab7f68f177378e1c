//! Figure 12 (fig:jams_vel): speeds of all pedestrians at two times.

use figures::panels::points;
use figures::titles::number;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The two times, with the names of their tables.
const TIMES: [(&str, f64); 2] = [("t300", 300.0), ("t2000", 2000.0)];
/// As many of the last pedestrians are enlarged at the first time: the first waves are there.
const ENLARGED: f64 = 38.0;

fn tables(job: &mut Job) -> Result<(), Failure> {
    let run = job.run_table("main", "trajectories")?;
    for (name, time) in TIMES {
        job.write(name, &at(&run, time)?)?;
    }
    Ok(())
}

/// The rows `n, x, v` of one time. A sample is the multiple of an interval that need not be exact in binary, so it is
/// found to within a billionth.
fn at(trajectories: &Table, time: f64) -> Result<Table, Failure> {
    let mut table = Table::new(&["n", "x", "v"]);
    trajectories.rows().filter(|row| (row[0] - time).abs() <= 1e-9 * time).for_each(|row| table.push(&row[1..]));
    if table.is_empty() {
        let last =
            trajectories.rows().last().map_or("it has no rows".to_owned(), |row| format!("its last is {:?}", row[0]));
        return Err(Failure::input(format!(
            "trajectories: no sample at t = {time:?} ({last}); run.sample must divide it, run.t_end reach it"
        )));
    }
    Ok(table)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let published = points(&job.reference("published_speed_t300")?, "n", "v")?;
    let [early, late] = TIMES.map(|(name, _)| points(&job.read(name)?, "n", "v"));
    let (early, late) = (early?, late?);
    let last = late.last().map_or(0.0, |point| point.0);
    let both = |panel: Lines| {
        panel
            .series(Series::points("published", Marker::Circle, published.clone()).look(2))
            .series(Series::line("regenerated", early.clone()).look(0))
    };
    let seen = early.iter().filter(|point| point.0 >= last - ENLARGED);
    let waves = (Axis::around("", [last - ENLARGED, last]), Axis::roomy("", seen.map(|point| point.1)));
    let waves = both(Lines::new(waves.0.steps(4), waves.1.steps(3))).unnamed();
    let whole = || {
        let speeds = Axis::from_zero("speed $v_n$", late.iter().map(|point| point.1));
        Lines::new(Axis::around("pedestrian $n$", [0.0, last]).steps(4), speeds.steps(4))
    };
    let above = both(whole()).legend(Corner::TopRight);
    let below = whole().series(Series::line("", late.clone()));
    let [first, second] = TIMES.map(|(_, time)| format!("$t = {}$", number(time)));
    Ok(Picture::new(COLUMN_WIDTH, 100.0)
        .columns(1)
        .titled(&first, above.inset([0.02, 0.03, 0.66, 0.5], waves))
        .titled(&second, below))
}
