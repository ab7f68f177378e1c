//! Compares tables of error against work with the committed ones, and names the cheapest method for an error.

use crate::precision::{COARSE_TARGETS, COSTS, FIXED, Row, SCENES, Scene, TARGETS, timing};
use crate::rows::{Relation, first_stranger};
use checkout::disk;
use checkout::failure::Failure;
use checkout::hashing;
use checkout::paths::{ACCURACY, Paths};
use checkout::print;
use checkout::sums::Sums;
use clap::Args;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The sums of those tables, by name.
const ACCURACY_SUMS: &str = "data/accuracy/SHA256SUMS";

/// What is asked for.
#[derive(Clone, Debug, Args)]
pub struct Options {
    /// Folder of the tables that were made
    #[arg(long)]
    pub made: PathBuf,
    /// Fewer rows were made
    #[arg(long)]
    pub quick: bool,
    /// More rows were made
    #[arg(long)]
    pub full: bool,
    /// Accept the tables and write their sums
    #[arg(long)]
    pub bless: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Compares, reports, and accepts the tables if requested.
///
/// # Errors
/// Differs: a table is not as committed.
pub fn run(paths: &Paths, options: &Options) -> Result<(), Failure> {
    let committed = Sums::read(&paths.root.join(ACCURACY_SUMS), ACCURACY_SUMS)?.unwrap_or_default();
    let states = compare(paths, options, &options.made, &committed)?;
    let shown = if options.quick { paths.root.join(ACCURACY) } else { options.made.clone() };
    let scenes = read_scenes(paths, &shown)?;
    let differing: Vec<String> = states
        .iter()
        .filter_map(|(name, state)| Some(format!("differs: {ACCURACY}/{name}: {}", state.as_ref()?)))
        .collect();
    show(options, &scenes, &states, differing.is_empty() || options.bless)?;
    if options.bless {
        return bless(paths, &options.made, options.full);
    }
    match differing.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("{}\ncargo xtask accuracy --bless accepts them", differing.join("\n")))),
    }
}

/// Tables of which `--quick` makes other rows, from shorter runs, not fewer ones: these are not compared then.
const SHORTENED: [&str; 4] = ["cfm.csv", "long_run.csv", "ramp_range.csv", "widening.csv"];

/// Tables of which the committed rows are those of `--full`, some minutes of steps of 1e-5; others make some of them.
const LONGEST: [&str; 3] = ["rounding.csv", "rounding_optimum.csv", "verbatim_fig04_stable.csv"];

/// What is wrong with each table that was made or that is listed; nothing where all is well.
fn compare(
    paths: &Paths,
    options: &Options,
    made: &Path,
    sums: &Sums,
) -> Result<BTreeMap<String, Option<String>>, Failure> {
    let mut states = BTreeMap::new();
    let names = disk::names(made)?;
    for name in &names {
        let is_longest = LONGEST.contains(&name.as_str());
        let relation = match options.full {
            _ if options.quick => Relation::Fewer,
            false if is_longest => Relation::Fewer,
            true if name.starts_with("precision_") => Relation::More,
            _ => Relation::Same,
        };
        if options.quick && SHORTENED.contains(&name.as_str()) {
            continue;
        }
        let new = disk::read_text(&made.join(name))?.unwrap_or_default();
        let state = match disk::read_text(&paths.root.join(ACCURACY).join(name))? {
            None => Some("not committed".to_owned()),
            Some(old) => first_stranger(&new, &old, relation),
        };
        states.insert(name.clone(), state);
    }
    let committed = tables(paths)?;
    let files: Vec<PathBuf> = committed.iter().map(|name| paths.root.join(ACCURACY).join(name)).collect();
    for (name, hash) in committed.iter().zip(hashing::hash_all(&files)?) {
        if sums.by_name.get(&format!("{ACCURACY}/{name}")) != hash.as_ref() {
            states.insert(name.clone(), Some(format!("its sum is not the one in {ACCURACY_SUMS}")));
        }
    }
    for name in sums.by_name.keys().filter_map(|name| name.strip_prefix(&format!("{ACCURACY}/"))) {
        if !committed.iter().any(|one| one == name) {
            states.insert(name.to_owned(), Some(format!("missing, but listed in {ACCURACY_SUMS}")));
        }
    }
    Ok(states)
}

/// The committed tables, by name.
fn tables(paths: &Paths) -> Result<Vec<String>, Failure> {
    let names = disk::names(&paths.root.join(ACCURACY))?;
    Ok(names.into_iter().filter(|name| name.ends_with(".csv")).collect())
}

/// Moves the tables into place, and writes the sums of all tables there.
fn bless(paths: &Paths, made: &Path, is_full: bool) -> Result<(), Failure> {
    let folder = paths.root.join(ACCURACY);
    for name in disk::names(made)?.into_iter().filter(|name| is_full || !LONGEST.contains(&name.as_str())) {
        let text = disk::read_text(&made.join(&name))?.unwrap_or_default();
        disk::write_if_changed(&folder.join(&name), text.as_bytes())?;
    }
    let names = tables(paths)?;
    let files: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    let hashes = names.iter().zip(hashing::hash_all(&files)?);
    let by_name = hashes.filter_map(|(name, hash)| Some((format!("{ACCURACY}/{name}"), hash?))).collect();
    disk::write(&paths.root.join(ACCURACY_SUMS), Sums { by_name }.to_text().as_bytes())
}

fn read_scenes(paths: &Paths, folder: &Path) -> Result<Vec<Scene>, Failure> {
    let read = |scene: &str| {
        let table = format!("precision_{scene}");
        Scene::read(scene, &folder.join(format!("{table}.csv")), &timing(paths, &table))
    };
    SCENES.iter().map(|scene| read(scene)).collect()
}

fn show(
    options: &Options,
    scenes: &[Scene],
    states: &BTreeMap<String, Option<String>>,
    is_good: bool,
) -> Result<(), Failure> {
    if options.json {
        let scenes: Vec<Value> = scenes.iter().map(Scene::to_json).collect();
        let tables: BTreeMap<&str, &str> =
            states.iter().map(|(name, state)| (name.as_str(), state.as_deref().unwrap_or("same"))).collect();
        return print::json(json!({ "scenes": scenes, "tables": tables, "ok": is_good }));
    }
    let same = states.values().filter(|state| state.is_none()).count();
    let skipped = if options.quick { format!("; not compared: {}", SHORTENED.join(", ")) } else { String::new() };
    print::out(&format!(
        "The cheapest method for an error: its tolerance or step, its cost\n{}\n\
         The least error of each method\n{}\n\
         Among {}: the cheapest, and the error of gaps of ballistic steps by that of Euler's\n{}\n\
         {same} of {} tables as committed{skipped}\n",
        print::table(&cheapest(scenes, &TARGETS, &[])),
        print::table(&floors(scenes)),
        FIXED.join(", "),
        print::table(&fixed(scenes)),
        states.len()
    ))
}

/// A line for each scene and error, a column for each way to count.
fn cheapest(scenes: &[Scene], targets: &[f64], methods: &[&str]) -> Vec<Vec<String>> {
    let mut rows = vec![print::row(&["scene", "error", "right-hand sides", "", "seconds", ""])];
    for scene in scenes {
        for &target in targets {
            let mut row = print::row(&[&scene.name, &format!("{target:e}")]);
            for (_, cost) in COSTS {
                let found = scene.cheapest(target, cost, methods);
                row.push(found.map_or("-".to_owned(), |row| format!("{} {}", row.method, row.control)));
                row.push(found.and_then(cost).map_or(String::new(), |cost| format!("{cost}")));
            }
            rows.push(row);
        }
    }
    rows
}

/// A line for each method, a column for each scene.
fn floors(scenes: &[Scene]) -> Vec<Vec<String>> {
    let floors: Vec<Vec<&Row>> = scenes.iter().map(Scene::floors).collect();
    let mut methods: Vec<&str> = Vec::new();
    for row in floors.iter().flatten() {
        if !methods.contains(&row.method.as_str()) {
            methods.push(&row.method);
        }
    }
    let names = scenes.iter().map(|scene| scene.name.clone());
    let mut rows = vec![std::iter::once("method".to_owned()).chain(names).collect::<Vec<_>>()];
    for method in methods {
        let cells = floors.iter().map(|floors| {
            let error = floors.iter().find(|row| row.method == method).and_then(|row| row.error);
            error.map_or("-".to_owned(), |error| format!("{error:.1e}"))
        });
        rows.push(std::iter::once(method.to_owned()).chain(cells).collect());
    }
    rows
}

fn fixed(scenes: &[Scene]) -> Vec<Vec<String>> {
    let mut rows = cheapest(scenes, &COARSE_TARGETS, &FIXED);
    rows[0].push("ballistic / Euler".to_owned());
    for (scene, first) in scenes.iter().zip((1..).step_by(COARSE_TARGETS.len())) {
        let ratio = scene.ratios("ballistic", "euler");
        rows[first].push(ratio.map_or("-".to_owned(), |(low, high)| format!("{low:.2} to {high:.2}")));
    }
    rows
}
