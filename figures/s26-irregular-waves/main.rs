//! Supplement 26: irregular waves of the algebraic law with widening: paths of all (a), the standard deviation of the
//! speeds over windows by two methods from three starts (b), and how runs part (c).

use figures::panels::trajectories;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Corner, Lines, Marker, Picture, Series, SpaceTime};
use std::process::ExitCode;
use studies::irregular::{self, LENGTH, SHOWN};

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    irregular::tables()?.iter().try_for_each(|(name, rows)| job.write_rows(name, rows))
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let paths = trajectories(&job.read("paths")?)?;
    let speeds = paths.iter().flatten().map(|sample| sample[2]);
    let time = Axis::linear("$t$", SHOWN[0], SHOWN[1]).steps(5);
    let whole = SpaceTime::new(time, Axis::linear("$x'$", 0.0, LENGTH).steps(4), LENGTH, &paths).line_width(0.2);
    Ok(Picture::new(COLUMN_WIDTH, 150.0)
        .columns(1)
        .row_shares(&[1.8, 1.0, 1.2])
        .scale(ColorScale::sequential("speed $v_n$", speeds))
        .titled("paths of all", whole)
        .titled("std of speeds, means over windows", windows(job)?)
        .titled("largest difference of speeds", parting(job)?))
}

fn windows(job: &Job) -> Result<Lines, Failure> {
    let rows = job.read_rows("windows")?;
    let of = |method: &str| {
        let chosen = rows.select(&[("method", method)], &["t", "std"])?;
        Ok::<Vec<(f64, f64)>, Failure>(chosen.rows().map(|row| (row[0], row[1])).collect())
    };
    let (one, other) = (of("dop853")?, of("extrapolation")?);
    let heights = || one.iter().chain(&other).map(|&(_, std)| std);
    let times = one.iter().map(|&(t, _)| t);
    Ok(Lines::new(Axis::around("beginning of the window $t$", times).steps(5), Axis::around("std", heights()).steps(3))
        .series(Series::points("dop853", Marker::Circle, one.clone()).look(0))
        .series(Series::points("extrapolation", Marker::Triangle, other.clone()).look(3))
        .legend(Corner::TopRight))
}

fn parting(job: &Job) -> Result<Lines, Failure> {
    let rows = job.read_rows("parting")?;
    let of = |column: &str| {
        let chosen = rows.select(&[], &["t", column])?;
        // runs that agree to the last bit have no place on a logarithmic axis
        Ok::<Vec<(f64, f64)>, Failure>(chosen.rows().map(|row| (row[0], row[1])).filter(|&(_, d)| d > 0.0).collect())
    };
    let (methods, starts) = (of("methods")?, of("starts")?);
    let end = methods.last().map_or(0.0, |&(t, _)| t);
    Ok(Lines::new(Axis::linear("$t$", 0.0, end).steps(5), Axis::log10("", 1e-14, 10.0))
        .series(Series::line("two methods", methods).look(0))
        .series(Series::line("two starts", starts).look(3))
        .legend(Corner::BottomRight))
}
