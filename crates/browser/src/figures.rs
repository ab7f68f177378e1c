//! Which run, map or curve each table comes from. No other module of this crate repeats it.

/// A figure: its id, its scene file, its tables.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// `fig04`.
    pub id: &'static str,
    /// The text of its scene file.
    pub scene: &'static str,
    /// Its tables, in alphabetical order.
    pub tables: &'static [Entry],
}

/// A table of a figure.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name: `data/<figure>/<name>.csv`.
    pub name: &'static str,
    /// The panel of the scene that it comes from.
    pub panel: &'static str,
    /// What of this panel it holds.
    pub content: Content,
}

/// What a table holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Content {
    /// The values of a map.
    Map,
    /// The values of a curve.
    Curve,
    /// `t, std` of a run.
    Std,
    /// `t, n, x, v` of a run.
    Trajectories,
    /// `n, x, v` of a run at this time, which is one of its samples.
    At(f64),
}

use Content::{At, Curve, Map, Std, Trajectories};

/// A table with the name of its panel.
const fn of(panel: &'static str, content: Content) -> Entry {
    Entry { name: panel, panel, content }
}

/// A table of a scene without panels.
const fn main(name: &'static str, content: Content) -> Entry {
    Entry { name, panel: "main", content }
}

macro_rules! figure {
    ($id:literal, $slug:literal, $tables:expr) => {
        Figure {
            id: $id,
            scene: include_str!(concat!("../../../figures/", $id, "-", $slug, "/scene.toml")),
            tables: $tables,
        }
    };
}

const THREE_MAPS: &[Entry] = &[of("left", Map), of("middle", Map), of("right", Map)];
const FOUR_MAPS: &[Entry] =
    &[of("bottom_left", Map), of("bottom_right", Map), of("top_left", Map), of("top_right", Map)];

/// The figures of the paper.
pub const FIGURES: [Figure; 15] = [
    figure!("fig01", "definitions", &[]),
    figure!("fig02", "ramp", &[of("eps_01", Curve), of("eps_03", Curve), of("eps_05", Curve)]),
    figure!("fig03", "algebraic-criterion", THREE_MAPS),
    figure!("fig04", "algebraic-std", &[of("stable", Std), of("unstable", Std)]),
    figure!("fig05", "exponential-criterion", THREE_MAPS),
    figure!("fig06", "exponential-criterion-widening", THREE_MAPS),
    figure!("fig07", "exponential-std", &[of("stable", Std), of("unstable", Std)]),
    figure!("fig08", "logarithmic-force", &[of("force", Curve)]),
    figure!("fig09", "logarithmic-growth", &[of("left", Map), of("right", Map)]),
    figure!("fig10", "logarithmic-criterion", &[of("map", Map)]),
    figure!("fig11", "trajectories", &[main("trajectories", Trajectories)]),
    figure!("fig12", "speeds", &[main("t2000", At(2000.0)), main("t300", At(300.0))]),
    figure!("fig13", "logarithmic-std", &[of("std", Std), of("std_small_shift", Std)]),
    figure!("fig14", "algebraic-growth", FOUR_MAPS),
    figure!("fig15", "exponential-growth", FOUR_MAPS),
];
