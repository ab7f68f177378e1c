//! Supplement 19: lasting waves of the algebraic law with relative speed, which the paper does not simulate: the speeds
//! of all pedestrians (a), the standard deviation (b), and the final paths (c).

use figures::panels::{points, trajectories};
use figures::{Failure, Job, figure};
use files::table::{CellValue, MixedTable, Table};
use jam::ring::{Ring, Start};
use jam::run::{Judging, run_from};
use jam::states::StateVariables;
use ode::{Control, Method};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Lines, Picture, Series, SpaceTime};
use scene::run::Scene;
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
    job.write("last", &last)?;
    let scene = scene::run::read(&job.scene_file.file, &job.panel("main")?.tables)?;
    job.write_own_rows("varied", &varied(&scene)?)
}

/// The width of the ramp of two more runs: a narrower ramp needs a stronger force.
const NARROW: f64 = 0.02;

/// The outcome of the run, with one thing changed at a time: method, start, number of pedestrians at the same headway,
/// width of the ramp, strength; and the strength with a narrow ramp.
fn varied(scene: &Scene) -> Result<MixedTable, Failure> {
    let mut sheet = MixedTable::new(&[
        "varied",
        "value",
        "method",
        "outcome",
        "t_decided",
        "least_gap",
        "least_speed",
        "std",
        "wave_speed",
    ]);
    let control = Control::Adaptive { tolerance: 1e-10 };
    let base = Scene { t_end: 20_000.0, sample: 20_000.0, keeps_trajectories: false, control, ..scene.clone() };
    let mut add = |varied: &str, value: CellValue, scene: Scene| {
        let outcome = run_from(&scene, None, &mut Judging::UntilCertain).map_err(Failure::work)?;
        let verdict = outcome.verdict.ok_or_else(|| Failure::work("a run without an outcome"))?;
        let speed = verdict.wave_speed.map_or(CellValue::Empty, CellValue::Number);
        // what happened while the waves grew is no part of them
        let slowest = verdict.lasting_least_speed.unwrap_or(verdict.least_speed);
        let [time, gap, slowest, std] = [verdict.time, verdict.least_gap, slowest, verdict.std].map(CellValue::Number);
        let method = CellValue::from(scene.method.name());
        let row = [
            CellValue::from(varied),
            value,
            method,
            CellValue::from(verdict.class.name()),
            time,
            gap,
            slowest,
            std,
            speed,
        ];
        sheet.push(&row[..]);
        Ok::<(), Failure>(())
    };
    for (method, form) in
        [(Method::Dop853, base.form), (Method::Verner87, base.form), (Method::Taylor, StateVariables::Spacings)]
    {
        add("method", CellValue::Empty, Scene { method, form, ..base.clone() })?;
    }
    for shift in [1e-3, 0.1, 0.3] {
        add("shift", CellValue::Number(shift), Scene { start: Start { shift }, ..base.clone() })?;
    }
    for pedestrians in [67, 134, 268] {
        let ring = Ring { pedestrians, length: scene.ring.headway() * pedestrians as f64 };
        add("pedestrians", CellValue::Number(pedestrians as f64), Scene { ring, ..base.clone() })?;
    }
    let mut add_with = |varied: &str, changes: &[(&str, f64)], value: f64| {
        let change = |model: jam::laws::Model, (name, value): &(&str, f64)| model.with(name, *value);
        let model = changes.iter().try_fold(base.model.clone(), change).map_err(Failure::input)?;
        let speed = jam::uniform::steady_speed(&model, base.ring.headway()).map_err(Failure::work)?;
        add(varied, CellValue::Number(value), Scene { model, steady_speed: Some(speed), ..base.clone() })
    };
    for epsilon in [0.2, 0.1, 0.05, 0.02, 0.01] {
        add_with("epsilon", &[("epsilon", epsilon)], epsilon)?;
    }
    for mu in [0.28, 0.285, 0.29, 0.3, 0.32, 0.34, 0.36] {
        add_with("mu", &[("mu", mu)], mu)?;
    }
    for mu in [0.36, 0.4] {
        add_with("mu_narrow", &[("mu", mu), ("epsilon", NARROW)], mu)?;
    }
    Ok(sheet)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let scene = scene::run::read(&job.scene_file.file, &job.panel("main")?.tables)?;
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
