//! Supplement 9: the effect of rounding on Heun's scheme in the stable run of figure 4, against the step size; and the
//! curve of the paper's scheme (steps of 1e-5 in positions, wrapped and unwrapped) beside the solution.

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

/// Forms of the state with their markers.
const STATES: [(&str, Marker); 4] = [
    ("positions", Marker::Circle),
    ("wrapped", Marker::Triangle),
    ("gaps", Marker::Square),
    ("deviations", Marker::Diamond),
];
/// How steps are added up.
const SUMS: [&str; 2] = ["plain", "compensated"];
/// The time of the errors that are drawn.
const TIME: f64 = 1000.0;

fn tables(job: &mut Job) -> Result<(), Failure> {
    let rounding = job.accuracy("rounding")?;
    for (state, _) in STATES {
        for sum in SUMS {
            let columns = ["dt", "t", "error_gap", "truncation_gap", "rounding_gap"];
            let all = rounding.select(&[("state", state), ("sum", sum)], &columns)?;
            let mut table = Table::new(&columns);
            all.rows().filter(|row| (row[1] - TIME).abs() < 0.5).for_each(|row| table.push(row));
            job.write(&format!("{state}_{sum}"), &table)?;
        }
    }
    job.write("verbatim", &job.accuracy("verbatim_fig04_stable")?.select(&[], &["t", "std", "wrapped", "exact"])?)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(COLUMN_WIDTH, 165.0)
        .columns(1)
        .titled(&format!("error of the gaps at $t = {}$", number(TIME)), against_step(job, "error_gap")?)
        .titled("part of rounding; hollow: compensated sums", against_step(job, "rounding_gap")?)
        .titled("figure 4 (a) by Heun, $\\Delta t = 10^{-5}$", verbatim(job)?))
}

/// A column against the step for every form and sum. The error of deviations is that of truncation.
fn against_step(job: &Job, column: &str) -> Result<Lines, Failure> {
    let is_total = column == "error_gap";
    let (label, low) = if is_total { ("largest error", 1e-19) } else { ("largest rounding", 1e-21) };
    let mut panel = Lines::new(Axis::log10("step $\\Delta t$", 1e-5, 1e-1), Axis::log10(label, low, 1e-6));
    panel = if is_total { panel.legend(Corner::BottomRight).note("slope 2", (2e-2, 1e-12)) } else { panel };
    for (index, (state, marker)) in STATES.into_iter().enumerate() {
        for sum in SUMS {
            let along = points(&job.read(&format!("{state}_{sum}"))?, "dt", column)?;
            let is_plain = sum == "plain";
            let name = if is_plain { state } else { "" };
            let curve = Series::line(name, along).marker(marker).look(index).solid();
            panel = panel.series(if is_plain { curve.filled() } else { curve });
        }
    }
    Ok(if is_total { panel } else { panel.unnamed() })
}

fn verbatim(job: &Job) -> Result<Lines, Failure> {
    let table = job.read("verbatim")?;
    Ok(Lines::new(Axis::linear("$t$", 0.0, 2000.0).steps(4), Axis::log10("std of speeds", 1e-9, 1e-5))
        .legend(Corner::TopRight)
        .series(Series::line("solution", points(&table, "t", "exact")?).look(0).thick(2.0))
        .series(Series::line("positions, unwrapped", points(&table, "t", "std")?).look(1))
        .series(Series::line("positions, wrapped", points(&table, "t", "wrapped")?).look(2)))
}
