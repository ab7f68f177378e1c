//! What the tables of accuracy say: error against work, growth rates, rounding, the blow-up, the paper's scheme.

use super::sheet::Sheet;
use super::{Quantities, Source};
use checkout::failure::Failure;
use checkout::paths::ACCURACY;
use verify::precision::{COARSE_TARGETS, COSTS, FIXED, SCENES, Scene, TARGETS};

/// How far the paper's scheme is from the accurate and the published curves, by name.
const PAPER_DISTANCES: &str = "data/paper-scheme/distance.csv";

/// Adds all of it.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for scene in SCENES {
        work(source, all, scene)?;
        error_growth(source, all, scene)?;
    }
    advantage(all);
    savings(all);
    growth_rates(source, all)?;
    rounding(source, all)?;
    wrapping(all);
    verbatim(source, all)?;
    blow_up(source, all)?;
    cascade(source, all)?;
    threshold(source, all)
}

fn table(source: &Source<'_>, name: &str) -> Result<Sheet, Failure> {
    Sheet::read(source.paths, &format!("{ACCURACY}/{name}.csv"))
}

/// The cheapest run for an error, of all methods and of DOP853 and the fixed steps alone; the least error of each method.
fn work(source: &Source<'_>, all: &mut Quantities, name: &str) -> Result<(), Failure> {
    let from = format!("{ACCURACY}/precision_{name}.csv");
    let scene = Scene::committed(source.paths, name)?;
    let start = format!("precision.{name}");
    for target in TARGETS {
        let best = scene.cheapest(target, COSTS[0].1, &[]);
        let other = scene.cheapest(target, COSTS[0].1, &["dop853"]);
        for (who, row) in [("best", best), ("dop853", other)] {
            let Some(row) = row else { continue };
            let start = format!("{start}.{target:e}.{who}");
            all.word(&format!("{start}.method"), &row.method, &from);
            all.exact(&format!("{start}.control"), row.control.parse().unwrap_or(f64::NAN), &from);
            all.exact(&format!("{start}.work"), row.right_hand_sides.unwrap_or(f64::NAN), &from);
        }
        if let Some((best, other)) = best.zip(other) {
            let ratio = other.right_hand_sides.zip(best.right_hand_sides).map_or(f64::NAN, |(a, b)| a / b);
            all.rounded(&format!("{start}.{target:e}.ratio"), ratio, 2, &from);
        }
    }
    for target in COARSE_TARGETS {
        for method in FIXED {
            let found = scene.cheapest(target, COSTS[0].1, &[method]).and_then(|row| row.right_hand_sides);
            let Some(found) = found else { continue };
            all.exact(&format!("{start}.{target:e}.{method}.work"), found, &from);
        }
    }
    all.exact("precision.methods", scene.floors().len() as f64, &from);
    for row in scene.floors() {
        all.rounded(&format!("{start}.{}.floor", row.method), row.error.unwrap_or(f64::NAN), 2, &from);
    }
    Ok(())
}

/// How much cheaper the classical Runge-Kutta method is than Heun's, over the runs with waves that grow and the errors that
/// both reach; and in how many further cases Heun's scheme, and not the other, misses an error of 1e-2 or 1e-4. In the
/// stable runs the largest error is that of the speed of the uniform flow as it starts.
fn advantage(all: &mut Quantities) {
    let (mut ratios, mut missed) = (Vec::new(), 0);
    let growing = SCENES.iter().filter(|scene| !scene.ends_with("_stable"));
    for (scene, target) in growing.flat_map(|scene| COARSE_TARGETS[..2].iter().map(move |target| (scene, target))) {
        let work = |method: &str| all.by_name.get(&format!("precision.{scene}.{target:e}.{method}.work"))?.value;
        match (work("heun"), work("rk4")) {
            (Some(heun), Some(rk4)) => ratios.push(heun / rk4),
            (None, Some(_)) => missed += 1,
            (_, None) => {}
        }
    }
    ratios.sort_by(f64::total_cmp);
    if let (Some(least), Some(largest)) = (ratios.first(), ratios.last()) {
        let from = format!("{ACCURACY}/precision_*.csv: right-hand sides of heun by those of rk4");
        // steps are halved: the ratios are powers of two
        all.exact("fixed.heun-by-rk4.least", least.round(), &from);
        all.exact("fixed.heun-by-rk4.largest", largest.round(), &from);
        all.exact("fixed.heun-misses", f64::from(missed), &from);
    }
}

/// How much the cheapest method saves over DOP853 for the two finer errors, at most.
fn savings(all: &mut Quantities) {
    let ratios = SCENES.iter().flat_map(|scene| TARGETS[1..].iter().map(move |target| (scene, target)));
    let ratios =
        ratios.filter_map(|(scene, target)| all.by_name.get(&format!("precision.{scene}.{target:e}.ratio"))?.value);
    let largest = ratios.fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a });
    let from = format!("{ACCURACY}/precision_*.csv: right-hand sides of dop853 by those of the cheapest");
    all.rounded("precision.largest-ratio", largest, 2, &from);
}

/// The most that an error has grown by in a scene, of the two directions tried.
fn error_growth(source: &Source<'_>, all: &mut Quantities, name: &str) -> Result<(), Failure> {
    let sheet = table(source, "error_growth")?.only(&[("scene", name)])?;
    let (one, other) = (sheet.largest("shift")?, sheet.largest("random")?);
    let from = format!("{}: {name}", sheet.name);
    all.rounded(&format!("error-growth.{name}"), if one > other { one } else { other }, 2, &from);
    Ok(())
}

/// The largest distance of a measured growth rate from the linear theory, and the fastest wave.
fn growth_rates(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for law in ["algebraic", "exponential", "logarithmic"] {
        let sheet = table(source, &format!("mode_growth_{law}"))?;
        let residuals = sheet.numbers("residual")?;
        let largest = residuals.iter().map(|r| r.abs()).fold(0.0, |a: f64, b| if b > a { b } else { a });
        all.rounded(&format!("growth.{law}.residual"), largest, 2, &sheet.name);
        all.exact(&format!("growth.{law}.waves"), residuals.len() as f64, &sheet.name);
        let unstable = sheet.only(&[("flow", "unstable")])?;
        let rates = unstable.numbers("exact")?;
        let fastest = (0..rates.len()).fold(0, |best, at| if rates[at] > rates[best] { at } else { best });
        all.rounded(&format!("growth.{law}.fastest"), rates[fastest], 3, &sheet.name);
        all.exact(&format!("growth.{law}.fastest-l"), unstable.numbers("l")?[fastest], &sheet.name);
        if law == "algebraic" {
            // T* moves as the logarithm of the perturbation over the growth rate
            all.rounded("blow-up.per-cent", 0.01 / rates[fastest], 1, &sheet.name);
        }
    }
    Ok(())
}

/// Largest error of a gap at t = 1000 for steps of Heun's scheme, by form of the state and kind of sum.
fn rounding(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let (errors, optimum) = (table(source, "rounding")?, table(source, "rounding_optimum")?);
    for state in ["positions", "wrapped", "gaps", "deviations"] {
        for sum in ["plain", "compensated"] {
            let rows = errors.only(&[("state", state), ("sum", sum), ("t", "1000")])?;
            all.exact("rounding.t", rows.first("t")?, &rows.name);
            for dt in ["0.01", "0.001", "0.0001", "1e-5"] {
                let row = rows.only(&[("dt", dt)])?;
                let name = format!("rounding.{state}.{sum}.{dt}");
                all.rounded(&name, row.first("error_gap")?, 2, &row.name);
                all.rounded(&format!("rounding.truncation.{dt}"), row.first("truncation_gap")?, 2, &row.name);
            }
            let best = optimum.only(&[("state", state), ("sum", sum), ("t", "1000")])?;
            all.exact(&format!("rounding.{state}.{sum}.best-step"), best.first("dt_best")?, &best.name);
            all.rounded(&format!("rounding.{state}.{sum}.best-error"), best.first("error_gap")?, 2, &best.name);
        }
    }
    Ok(())
}

/// How many times larger the error of unwrapped positions is than that of wrapped ones, at a step.
fn wrapping(all: &mut Quantities) {
    for dt in ["0.001", "0.0001", "1e-5"] {
        let error = |state: &str| all.by_name.get(&format!("rounding.{state}.plain.{dt}"))?.value;
        let Some((unwrapped, wrapped)) = error("positions").zip(error("wrapped")) else { continue };
        all.rounded(&format!("rounding.wrapping.{dt}"), unwrapped / wrapped, 2, "data/accuracy/rounding.csv");
    }
}

/// The paper's scheme taken literally: the stable run of figure 4 beside the solution, and distances of every curve.
fn verbatim(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let sheet = table(source, "verbatim_fig04_stable")?;
    for t in ["500", "1000", "2000"] {
        let row = sheet.only(&[("t", t)])?;
        let (std, wrapped, exact) = (row.first("std")?, row.first("wrapped")?, row.first("exact")?);
        all.exact(&format!("verbatim.{t}.t"), row.first("t")?, &sheet.name);
        all.rounded(&format!("verbatim.{t}.std"), std, 2, &sheet.name);
        all.rounded(&format!("verbatim.{t}.wrapped"), wrapped, 2, &sheet.name);
        let missing = 100.0 * (1.0 - wrapped / exact);
        all.rounded(&format!("verbatim.{t}.wrapped-missing-percent"), missing, 1, &sheet.name);
        all.rounded(&format!("verbatim.{t}.exact"), exact, 2, &sheet.name);
        all.rounded(&format!("verbatim.{t}.missing-percent"), 100.0 * (1.0 - std / exact), 2, &sheet.name);
    }
    let distances = Sheet::read(source.paths, PAPER_DISTANCES)?;
    let keys = distances.words("figure")?.into_iter().zip(distances.words("table")?).zip(distances.words("column")?);
    for ((figure, table), column) in keys {
        let row = distances.only(&[("figure", &*figure), ("table", &*table), ("column", &*column)])?;
        let start = format!("verbatim.{figure}.{table}.{column}");
        all.rounded(&format!("{start}.difference"), row.first("largest_difference")?, 2, PAPER_DISTANCES);
        all.rounded(&format!("{start}.relative"), row.first("largest_relative")?, 2, PAPER_DISTANCES);
    }
    Ok(())
}

/// When fixed steps report an overlap, before the blow-up; and how well its time is known.
fn blow_up(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let steps = table(source, "blow_up_fixed_steps")?.only(&[("state", "gaps"), ("from", "960")])?;
    for method in ["euler", "ballistic", "heun", "rk4"] {
        for dt in ["0.1", "0.01", "0.001", "0.0001", "1e-5"] {
            let row = steps.only(&[("method", method), ("dt", dt)])?;
            all.rounded(&format!("blow-up.{method}.{dt}.early"), row.first("early")?, 2, &steps.name);
        }
    }
    let times = table(source, "blow_up_time")?.only(&[("tolerance", "1e-14")])?;
    let mut ends = Vec::new();
    for method in ["dop853", "extrapolation", "taylor"] {
        ends.push(times.only(&[("method", method)])?.first("t_star")?);
    }
    ends.sort_by(f64::total_cmp);
    all.rounded("blow-up.spread", ends[2] - ends[0], 1, &times.name);
    Ok(())
}

/// The throws before the blow-up.
fn cascade(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let sheet = table(source, "blow_up_cascade")?;
    all.exact("cascade.throws", sheet.largest("k")?, &sheet.name);
    all.rounded("cascade.speed", sheet.largest("speed")?, 1, &sheet.name);
    let (ratios, energies) = (sheet.numbers("speed_ratio")?, sheet.numbers("room_speed_squared")?);
    all.rounded("cascade.ratio-first", ratios[0], 3, &sheet.name);
    all.rounded("cascade.ratio-last", ratios[ratios.len() - 1], 3, &sheet.name);
    all.rounded("cascade.room-speed-squared", energies[energies.len() - 1], 3, &sheet.name);
    all.rounded("cascade.room", sheet.least("room")?, 1, &sheet.name);
    Ok(())
}

/// The critical strength on rings of N pedestrians.
fn threshold(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let sheet = table(source, "marginal_threshold")?;
    for n in ["4", "64", "4096"] {
        let row = sheet.only(&[("n", n)])?;
        all.rounded(&format!("threshold.{n}"), row.first("mu_cr")?, 7, &sheet.name);
        all.rounded(&format!("threshold.{n}.shift"), row.first("shift_times_n_squared")?, 5, &sheet.name);
    }
    let differences = sheet.numbers("difference")?;
    let largest = differences.iter().map(|d| d.abs()).fold(0.0, |a: f64, b| if b > a { b } else { a });
    all.rounded("threshold.difference", largest, 1, &sheet.name);
    Ok(())
}
