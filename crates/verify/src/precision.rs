//! Results from the tables of error against work: the cheapest method for an error, and the least error of each method.

use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{ACCURACY, Paths};
use files::table::MixedTable;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Errors for which the cheapest method is looked up.
pub const TARGETS: [f64; 3] = [1e-6, 1e-9, 1e-12];
/// Coarser ones, for steps of fixed length.
pub const COARSE_TARGETS: [f64; 3] = [1e-2, 1e-4, 1e-6];
/// The schemes that Treiber and Kanagaraj (2015) compare.
pub const FIXED: [&str; 4] = ["euler", "ballistic", "heun", "rk4"];

/// The scenes of those tables.
pub const SCENES: [&str; 6] = [
    "algebraic_stable",
    "algebraic_unstable",
    "exponential_stable",
    "exponential_unstable",
    "logarithmic",
    "logarithmic_small_shift",
];

/// A run.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The method.
    pub method: String,
    /// Its tolerance or step, as written in the table.
    pub control: String,
    /// Evaluations of the right-hand side.
    pub right_hand_sides: Option<f64>,
    /// The largest error of a gap; nothing for a run that stopped early.
    pub gap_error: Option<f64>,
    /// The largest error of a gap or a speed.
    pub error: Option<f64>,
    /// Archived seconds.
    pub seconds: Option<f64>,
}

/// All runs of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// As its table is named.
    pub name: String,
    /// Its runs, coarse to fine within a method.
    pub rows: Vec<Row>,
}

/// What a run costs.
pub type Cost = fn(&Row) -> Option<f64>;
/// The ways to count.
pub const COSTS: [(&str, Cost); 2] = [("right_hand_sides", |row| row.right_hand_sides), ("seconds", |row| row.seconds)];

impl Scene {
    /// The committed table of a scene with the archived seconds.
    ///
    /// # Errors
    /// As [`Scene::read`].
    pub fn committed(paths: &Paths, name: &str) -> Result<Scene, Failure> {
        let table = format!("precision_{name}");
        Scene::read(name, &paths.root.join(ACCURACY).join(format!("{table}.csv")), &timing(paths, &table))
    }

    /// Reads the table of a scene, and its seconds where they are archived.
    ///
    /// # Errors
    /// A table is missing or lacks a column.
    pub fn read(name: &str, table: &Path, seconds: &Path) -> Result<Scene, Failure> {
        let text = disk::read_text(table)?;
        let text = text.ok_or_else(|| Failure::Failed(format!("{}: no such table", table.display())))?;
        let timed = disk::read_text(seconds)?.unwrap_or_default();
        Scene::parse(name, &text, &timed).map_err(Failure::at(table))
    }

    /// Reads both tables; the second may be empty.
    ///
    /// # Errors
    /// A column is not there, or a line of the first is malformed.
    pub fn parse(name: &str, text: &str, timed: &str) -> Result<Scene, String> {
        let table = MixedTable::parse(text.as_bytes()).map_err(|error| error.to_string())?;
        let place = |column: &str| table.place(column).map_err(|error| error.to_string());
        let (method, control) = (place("method")?, place("control")?);
        let (work, gap, speed) = (place("right_hand_sides")?, place("error_gap")?, place("error_speed")?);
        // none are archived of a scene without the second table
        let timed =
            MixedTable::parse(timed.as_bytes()).unwrap_or_else(|_| MixedTable::new(&["method", "control", "seconds"]));
        let times: Vec<(String, String, Option<f64>)> = timed
            .rows()
            .filter_map(|row| match row {
                [method, control, time] => Some((method.to_string(), control.to_string(), time.number())),
                _ => None,
            })
            .collect();
        let rows = table.rows().map(|row| {
            let (method, control) = (row[method].to_string(), row[control].to_string());
            let time = times.iter().rev().find(|time| time.0 == method && time.1 == control);
            let error = row[gap].number().zip(row[speed].number());
            Row {
                right_hand_sides: row[work].number(),
                gap_error: row[gap].number(),
                error: error.map(|(gap, speed)| if speed > gap { speed } else { gap }),
                seconds: time.and_then(|time| time.2),
                method,
                control,
            }
        });
        Ok(Scene { name: name.to_owned(), rows: rows.collect() })
    }

    /// The cheapest run, by one of the [`COSTS`], with an error of at most `target`; of these methods, or of all when
    /// none is named.
    pub fn cheapest(&self, target: f64, cost: Cost, methods: &[&str]) -> Option<&Row> {
        let good = |row: &&Row| row.error.is_some_and(|error| error <= target);
        let meant = |row: &&Row| methods.is_empty() || methods.contains(&row.method.as_str());
        let priced = self.rows.iter().filter(meant).filter(good).filter_map(|row| Some((cost(row)?, row)));
        priced.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, row)| row)
    }

    /// The least error of each method, in the order of the table, and the run that has it.
    pub fn floors(&self) -> Vec<&Row> {
        let mut floors: Vec<&Row> = Vec::new();
        for row in self.rows.iter().filter(|row| row.error.is_some()) {
            match floors.last_mut().filter(|last| last.method == row.method) {
                Some(last) if row.error < last.error => *last = row,
                Some(_) => {}
                None => floors.push(row),
            }
        }
        floors
    }

    /// The least and the largest ratio of the errors of gaps of two methods over the steps at which both have one;
    /// nothing when there is none. (Where all is calm the largest error of a speed is that of the uniform flow at its
    /// start.)
    pub fn ratios(&self, one: &str, other: &str) -> Option<(f64, f64)> {
        let error = |method: &str, control: &str| {
            self.rows.iter().find(|row| row.method == method && row.control == control).and_then(|row| row.gap_error)
        };
        let of_one = self.rows.iter().filter(|row| row.method == one);
        let ratios = of_one.filter_map(|row| Some(row.gap_error? / error(other, &row.control)?));
        ratios.fold(None, |range: Option<(f64, f64)>, ratio| {
            let (low, high) = range.unwrap_or((ratio, ratio));
            Some((if ratio < low { ratio } else { low }, if ratio > high { ratio } else { high }))
        })
    }

    /// The results as JSON.
    pub fn to_json(&self) -> Value {
        let best = |targets: [f64; 3], methods: &[&str]| -> Vec<Value> {
            let entry = |target: f64| {
                let found = COSTS.map(|(name, cost)| (name, self.cheapest(target, cost, methods)));
                let mut value = json!({ "error": target });
                for (name, row) in found {
                    value[name] = row.map_or(Value::Null, row_json);
                }
                value
            };
            targets.into_iter().map(entry).collect()
        };
        let floors: Vec<Value> = self.floors().into_iter().map(row_json).collect();
        json!({
            "scene": self.name, "cheapest": best(TARGETS, &[]), "cheapest_fixed_step": best(COARSE_TARGETS, &FIXED),
            "least_errors": floors, "ballistic_gap_error_by_euler_gap_error": self.ratios("ballistic", "euler"),
        })
    }
}

/// A table of archived seconds.
pub fn timing(paths: &Paths, table: &str) -> PathBuf {
    paths.root.join("data/timing").join(format!("{table}.csv"))
}

fn row_json(row: &Row) -> Value {
    json!({
        "method": row.method, "control": row.control, "right_hand_sides": row.right_hand_sides, "error": row.error,
        "seconds": row.seconds,
    })
}
