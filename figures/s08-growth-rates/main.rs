//! Supplement 8: growth rates of every wave on the paper's rings, measured in runs, on the curves of the linear theory;
//! below them the residuals.

use figures::panels::points;
use figures::{Failure, Job, figure};
use plot::style::FULL_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::f64::consts::PI;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// A law, its two flows with their names in the legend, and the ends of the axis of rates.
struct Law {
    name: &'static str,
    title: &'static str,
    flows: [(&'static str, &'static str); 2],
    rates: (f64, f64),
}

const LAWS: [Law; 3] = [
    Law {
        name: "algebraic",
        title: "algebraic, $N = 67$",
        flows: [("stable", "$\\mu = 0.45$"), ("unstable", "$\\mu = 0.55$")],
        rates: (-0.5, 0.1),
    },
    Law {
        name: "exponential",
        title: "exponential, $N = 57$",
        flows: [("stable", "$a = 1.5$"), ("unstable", "$a = 3$")],
        rates: (-0.5, 0.1),
    },
    Law {
        name: "logarithmic",
        title: "logarithmic, $N = 133$",
        flows: [("stable", "$v_0' = 0.5$"), ("unstable", "$v_0' = 1$")],
        rates: (-0.5, 0.1),
    },
];

/// Ticks of an axis of wave numbers.
const WAVE_NUMBERS: [(f64, &str); 3] = [(0.0, "0"), (0.5 * PI, "$\\pi/2$"), (PI, "$\\pi$")];
/// The unit of the axis of residuals, and its ends in that unit.
const RESIDUAL: f64 = 1e-15;
const RESIDUALS: f64 = 2.0;

fn tables(job: &mut Job) -> Result<(), Failure> {
    for law in &LAWS {
        let measured = job.accuracy(&format!("mode_growth_{}", law.name))?;
        for (flow, _) in law.flows {
            let rates = measured.select(&[("flow", flow)], &["l", "k", "measured", "exact", "residual"])?;
            job.write(&format!("{}_{flow}", law.name), &rates)?;
        }
    }
    Ok(())
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let mut picture = Picture::new(FULL_WIDTH, 100.0).columns(3).row_shares(&[2.0, 1.0]);
    for (index, law) in LAWS.iter().enumerate() {
        picture = picture.titled(law.title, rates(job, law, index == 0)?);
    }
    for (index, law) in LAWS.iter().enumerate() {
        picture = picture.panel(residuals(job, law, index == 0)?);
    }
    Ok(picture)
}

fn rates(job: &Job, law: &Law, is_labelled: bool) -> Result<Lines, Failure> {
    let label = if is_labelled { "growth rate $\\mathrm{Re}\\,z^+$" } else { "" };
    let (low, high) = law.rates;
    let mut panel = Lines::new(
        Axis::linear("", 0.0, PI).ticks(&WAVE_NUMBERS.map(|(k, _)| (k, ""))),
        Axis::linear(label, low, high),
    )
    .legend(Corner::BottomLeft)
    .horizontal(0.0);
    for (index, (flow, name)) in law.flows.into_iter().enumerate() {
        let table = job.read(&format!("{}_{flow}", law.name))?;
        panel = panel
            .series(Series::line("", points(&table, "k", "exact")?).look(index).solid())
            .series(Series::points(name, MARKERS[index], points(&table, "k", "measured")?).every(2).look(index));
    }
    Ok(panel)
}

const MARKERS: [Marker; 2] = [Marker::Circle, Marker::Square];

fn residuals(job: &Job, law: &Law, is_labelled: bool) -> Result<Lines, Failure> {
    let label = if is_labelled { "residual / $10^{-15}$" } else { "" };
    let mut panel = Lines::new(
        Axis::linear("wave number $k$", 0.0, PI).ticks(&WAVE_NUMBERS),
        Axis::linear(label, -RESIDUALS, RESIDUALS).steps(4),
    )
    .horizontal(0.0);
    for (index, (flow, _)) in law.flows.into_iter().enumerate() {
        let left = points(&job.read(&format!("{}_{flow}", law.name))?, "k", "residual")?;
        let left = left.into_iter().map(|(k, residual)| (k, residual / RESIDUAL)).collect();
        panel = panel.series(Series::points("", MARKERS[index], left).look(index));
    }
    Ok(panel)
}
