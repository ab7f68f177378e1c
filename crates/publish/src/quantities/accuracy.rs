//! Numbers from the accuracy tables: error against work, and the fastest-growing waves.

use super::{Quantities, Source, table};
use checkout::failure::Failure;
use checkout::paths::ACCURACY;
use files::table::CellValue;
use verify::precision::{COARSE_TARGETS, COSTS, FIXED, SCENES, Scene, TARGETS};

/// Adds all of it.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for scene in SCENES {
        work(source, all, scene)?;
    }
    advantage(all);
    savings(all);
    fastest(source, all)
}

/// The cheapest run for an error, of all methods and of DOP853 and the fixed steps alone; the least error of each
/// method.
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

/// How much cheaper the classical Runge-Kutta method is than Heun's, over the runs with waves that grow and the errors
/// that both reach; and in how many further cases Heun's scheme, and not the other, misses an error of 1e-2 or 1e-4. In
/// the stable runs the largest error is that of the speed of the uniform flow as it starts.
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

/// The fastest wave of each law by the linear theory.
fn fastest(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for law in ["algebraic", "exponential", "logarithmic"] {
        let name = format!("{ACCURACY}/mode_growth_{law}.csv");
        let unstable = table::<CellValue>(source.paths, &name)?.select(&[("flow", "unstable")], &["exact", "l"]);
        let unstable = unstable.map_err(Failure::failed)?;
        // of equal ones the first
        let Some(fastest) = unstable.rows().reduce(|best, row| if row[0] > best[0] { row } else { best }) else {
            continue;
        };
        all.rounded(&format!("growth.{law}.fastest"), fastest[0], 3, &name);
        all.exact(&format!("growth.{law}.fastest-l"), fastest[1], &name);
    }
    Ok(())
}
