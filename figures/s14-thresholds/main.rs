//! Supplement 14: where stability ends, and where contacts begin.

use figures::{Failure, Job, figure};
use plot::style::FULL_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;
use studies::thresholds::{self, monotone};

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    let panels = &job.scene_file.panels;
    let read = |panel: &files::scene_file::Panel| scene::map::read(&job.scene_file.file, &panel.tables);
    let maps =
        panels.iter().map(|panel| Ok((panel.name.as_str(), read(panel)?))).collect::<Result<Vec<_>, Failure>>()?;
    // the effect of delta alone: <0.5, 0, 1, 0.1> beside the last panel of figure 14
    let (delta, maps): (Vec<_>, Vec<_>) = maps.into_iter().partition(|(name, _)| *name == "delta_k");
    for (name, map) in delta {
        let computed = map.compute().map_err(Failure::input)?;
        job.write(name, &computed.whole().map_err(|why| Failure::work(format!("{name}: {why}")))?)?;
    }
    job.write_rows("monotone", &monotone::table(&maps)?)?;
    thresholds::tables()?.iter().try_for_each(|(name, rows)| job.write_rows(name, rows))
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(FULL_WIDTH, 130.0)
        .columns(2)
        .titled("critical values of a ring", ring(job)?)
        .titled("influence of the relative speed", relative_speed(job)?)
        .titled("space that grows with speed", widening(job)?)
        .titled("logarithmic law: first contact", contact(job)?))
}

/// Points (x, y) of the rows with these words that have both.
fn pairs(job: &Job, table: &str, words: &[(&str, &str)], x: &str, y: &str) -> Result<Vec<(f64, f64)>, Failure> {
    let selected = job.read_rows(table)?.select(words, &[x, y])?;
    Ok(selected.rows().map(|row| (row[0], row[1])).collect())
}

/// How far above the value for all waves; `N^-2` times `pi^2` for values that enter as a factor of `phi`.
fn ring(job: &Job) -> Result<Lines, Failure> {
    let pi_squared = std::f64::consts::PI * std::f64::consts::PI;
    let slope = |n: f64| (n, pi_squared / (n * n));
    let axes = (Axis::log10("pedestrians $N$", 3.0, 2000.0), Axis::log10("above that for all waves", 1e-6, 2.0));
    let mut panel = Lines::new(axes.0, axes.1).guide(&[slope(4.0), slope(2000.0)]).note("$\\pi^2 / N^2$", (60.0, 8e-3));
    let quantities = [
        ("critical_mu", "$\\mu$", Marker::Circle, 1.0),
        // these two lie on each other
        ("critical_a", "$a$", Marker::Square, 1.6),
        ("critical_v0", "$v_0'$", Marker::Triangle, 0.8),
    ];
    for (word, name, marker, size) in quantities {
        let points = pairs(job, "ring", &[("quantity", word)], "pedestrians", "above")?;
        panel = panel.series(Series::points(name, marker, points).marker_size(size));
    }
    Ok(panel.legend(Corner::BottomLeft))
}

fn relative_speed(job: &Job) -> Result<Lines, Failure> {
    let axes =
        (Axis::linear("$\\delta$", -1.5, 1.5).steps(6), Axis::linear("critical $\\mu$ at $d' = 1$", 0.0, 1.0).steps(5));
    let points = pairs(job, "minus_delta", &[], "delta", "critical_mu")?;
    Ok(Lines::new(axes.0, axes.1)
        .note("unstable", (-1.2, 0.75))
        .note("stable", (0.9, 0.2))
        .series(Series::line("", points).marker(Marker::Circle)))
}

/// A margin on an axis that is linear near 0 and logarithmic far from it: the inverse hyperbolic sine of five times it.
fn shrunk(margin: f64) -> f64 {
    let five = 5.0 * margin.abs();
    math::ln(five + (five * five + 1.0).sqrt()).copysign(margin)
}

fn widening(job: &Job) -> Result<Lines, Failure> {
    let ticks = [-1.0, -0.3, 0.0, 0.3, 1.0, 3.0, 10.0]
        .map(|margin| (shrunk(margin), margin.to_string().replace('-', "\u{2212}")));
    let ticks: Vec<(f64, &str)> = ticks.iter().map(|(place, text)| (*place, text.as_str())).collect();
    let axes = (
        Axis::linear("$\\tilde a_v$", 0.0, 1.0).steps(5),
        Axis::linear("margin of long waves", shrunk(-110.0), shrunk(25.0)).ticks(&ticks),
    );
    let lines = [
        ("algebraic", "density", "algebraic, given density"),
        ("algebraic", "gap", "algebraic, given $d'$"),
        ("exponential", "density", "exponential, given density"),
        ("exponential", "gap", "exponential, given $d'$"),
    ];
    let mut panel =
        Lines::new(axes.0, axes.1).horizontal(0.0).note("unstable", (0.62, 0.35)).note("stable", (0.62, -0.9));
    for (law, fixed, name) in lines {
        let points = pairs(job, "widening", &[("law", law), ("fixed", fixed)], "a_v", "margin")?;
        let points = points.into_iter().map(|(a_v, margin)| (a_v, shrunk(margin))).collect();
        panel = panel.series(Series::line(name, points));
    }
    Ok(panel.legend(Corner::BottomLeft))
}

fn contact(job: &Job) -> Result<Lines, Failure> {
    let begin = pairs(job, "collision", &[], "none_at", "t_end")?
        .into_iter()
        .fold(f64::INFINITY, |least, p| math::smaller(least, p.0));
    let axes = (Axis::linear("$v_0'$", 0.0, 10.0).steps(5), Axis::log10("time", 1.0, 1e4));
    Ok(Lines::new(axes.0, axes.1)
        .legend(Corner::TopRight)
        .vertical(begin)
        .series(Series::line("first contact", pairs(job, "contact", &[], "v0", "contact_t")?).marker(Marker::Circle))
        .series(Series::points(
            "first negative speed",
            Marker::Square,
            pairs(job, "contact", &[], "v0", "negative_t")?,
        )))
}
