//! Tolerances: each is derived again by its rule, and all are tried on other methods and other parameters.

use checkout::paths::Paths;
use files::table::{MixedTable, Table};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use verify::golden;
use verify::numbers::{self, Distance};
use verify::tolerances::{Entry, Rule, Tolerances};

/// The tolerance of the runs of the figures (`run.tolerance` in their scenes).
const OF_RUNS: f64 = 1e-12;
/// The factor of every rule.
const FACTOR: f64 = 10.0;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn tolerances() -> Tolerances {
    Tolerances::read(&Paths::find(Some(root())).expect("the checkout")).expect("data/tolerances.toml")
}

fn sample(table: &str) -> MixedTable {
    MixedTable::read(&root().join(format!("data/golden/{table}.csv"))).expect("a committed sample")
}

/// The columns of a table, and the numbers in one of them; cells without a number are left out.
fn columns(table: &str) -> Vec<(String, Vec<f64>)> {
    let text = fs::read_to_string(root().join(format!("data/golden/{table}.csv"))).expect("a committed sample");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let rows: Vec<Vec<&str>> = lines.collect();
    let numbers = |index: usize| rows.iter().filter_map(|row| row[index].parse().ok()).collect();
    header.iter().enumerate().map(|(index, name)| (name.to_string(), numbers(index))).collect()
}

/// Every committed table, `fig04/stable`.
fn tables() -> Vec<String> {
    let mut tables = Vec::new();
    for folder in fs::read_dir(root().join("data/golden")).expect("samples").flatten() {
        for file in fs::read_dir(folder.path()).expect("samples").flatten() {
            let file = file.file_name().to_string_lossy().trim_end_matches(".csv").to_owned();
            tables.push(format!("{}/{file}", folder.file_name().to_string_lossy()));
        }
    }
    tables.sort();
    tables
}

/// Rounded up to one digit.
fn up(value: f64) -> f64 {
    let (digits, exponent) = format!("{value:.6e}").split_once('e').map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    format!("{}e{exponent}", digits.parse::<f64>().unwrap().ceil()).parse().unwrap()
}

/// Growth of a small error at each time of a scene, the larger of the two kinds.
fn growth(scene: &str) -> Vec<(f64, f64)> {
    let text = fs::read_to_string(root().join("data/accuracy/error_growth.csv")).expect("growth of errors");
    let rows = text.lines().filter_map(|line| line.strip_prefix(&format!("{scene},")));
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let row = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(number).collect();
        (cells[0], if cells[1] > cells[2] { cells[1] } else { cells[2] })
    };
    rows.map(row).collect()
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.max_by(f64::total_cmp).expect("at least one")
}

fn two_ways(entry: &Entry) -> f64 {
    let text = fs::read_to_string(root().join("data/manifest.json")).expect("the manifest");
    let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let mut all = Vec::new();
    for (table, column, values) in of_entry(entry) {
        let scale = largest(values.iter().map(|value| value.abs()));
        let range = largest(values.iter().copied()) + largest(values.iter().map(|value| -value));
        let error = manifest["outputs"][format!("data/{table}.csv")]["error"][&column].as_f64().unwrap_or(0.0);
        all.push(largest([FACTOR * error * range / scale, FACTOR * f64::EPSILON].into_iter()));
    }
    largest(all.into_iter())
}

/// The columns for which an entry counts: table, column, numbers.
fn of_entry(entry: &Entry) -> Vec<(String, String, Vec<f64>)> {
    let tolerances = tolerances();
    let mut found = Vec::new();
    for table in tables() {
        let (id, file) = table.split_once('/').expect("figure and table");
        for (column, numbers) in columns(&table) {
            if tolerances.entry(id, file, &column).is_some_and(|other| other.because == entry.because) {
                found.push((table.clone(), column, numbers));
            }
        }
    }
    found
}

/// The errors that the tables of an entry state: in its own columns, or in those that it names.
fn stated(entry: &Entry) -> f64 {
    let is_error = |column: &str| column == "error" || column.ends_with("_error");
    let errors: Vec<f64> = if entry.errors.is_empty() {
        of_entry(entry)
            .into_iter()
            .filter(|(_, column, _)| is_error(column))
            .flat_map(|(_, _, errors)| errors)
            .collect()
    } else {
        let all = entry.tables.iter().flat_map(|table| columns(table));
        all.filter(|(column, _)| entry.errors.contains(column)).flat_map(|(_, errors)| errors).collect()
    };
    FACTOR * largest(errors.into_iter()) * entry.factor.unwrap_or(1.0)
}

/// The width of the last interval of a bisection.
fn bisection(entry: &Entry) -> f64 {
    let found = of_entry(entry);
    let column = |name: &str| &found.iter().find(|(_, column, _)| column == name).expect("an end of the interval").2;
    largest(column("contact_at").iter().zip(column("none_at")).map(|(high, low)| high - low))
}

fn condition(entry: &Entry) -> f64 {
    let scene = entry.growth.as_deref().expect("a scene");
    let file = root().join(format!("data/reference/solutions/{scene}_std.csv"));
    let curve = Table::read(&file).expect("a reference solution");
    let std: BTreeMap<u64, f64> = curve.rows().map(|row| (row[0] as u64, row[1])).collect();
    let ratios = growth(scene).into_iter().map(|(t, growth)| growth / (std[&(t as u64)] / std[&1]));
    FACTOR * OF_RUNS * largest(ratios.chain([1.0]))
}

#[test]
fn every_tolerance_is_what_its_rule_gives() {
    for entry in tolerances().columns {
        let sizes = (entry.absolute, entry.relative, entry.of_scale);
        let derived = match entry.rule {
            Rule::Exact => (0.0, 0.0, 0.0),
            Rule::TwoWays => (0.0, 0.0, up(two_ways(&entry))),
            Rule::Stated => (up(stated(&entry)), 0.0, 0.0),
            Rule::Bisection => (up(bisection(&entry)), 0.0, 0.0),
            Rule::Condition => (0.0, up(condition(&entry)), 0.0),
            Rule::Growth => {
                let grown = largest(growth(entry.growth.as_deref().expect("a scene")).iter().map(|row| row.1));
                (up(FACTOR * OF_RUNS * grown * entry.perturbation.expect("a perturbation")), 0.0, 0.0)
            }
        };
        assert_eq!(sizes, derived, "{:?} {:?}", entry.tables, entry.columns);
    }
}

#[test]
fn tolerances_of_events_are_carried_on_from_the_growth_before_them() {
    let events = fs::read_to_string(root().join("data/events.csv")).expect("events");
    let scenes: Vec<&str> = events.lines().skip(1).filter_map(|line| line.split(',').next()).collect();
    let tolerances = tolerances();
    for entry in &tolerances.events {
        let rows = growth(&entry.growth);
        let [.., (before, small), (last, large)] = rows[..] else { panic!("two rows of {}", entry.growth) };
        let times = events.lines().filter(|line| line.starts_with(&entry.scene));
        let t = largest(times.map(|line| line.split(',').nth(2).and_then(|t| t.parse().ok()).expect("a time")));
        let mut grown = large;
        let mut reached = last;
        while reached < t {
            grown *= large / small;
            reached += last - before;
        }
        assert_eq!(entry.absolute, up(FACTOR * OF_RUNS * grown * entry.perturbation), "{}", entry.scene);
    }
    assert!(scenes.iter().all(|scene| tolerances.event(scene) > 0.0), "{scenes:?}");
}

#[test]
fn every_column_has_a_tolerance() {
    let tolerances = tolerances();
    for table in tables() {
        let (id, file) = table.split_once('/').expect("figure and table");
        for (column, _) in columns(&table) {
            assert!(tolerances.entry(id, file, &column).is_some(), "{table}: {column}");
        }
    }
}

/// Runs a panel of a figure by the release binary and compares one of its tables with the committed sample.
fn run(scene: &str, table: &str, made: &str, options: &[&str]) -> Distance {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tolerances");
    let _ = fs::remove_dir_all(&out);
    let paths = Paths::find(Some(root())).expect("the checkout");
    let binary = paths.binary("simulate");
    assert!(binary.is_file(), "{}: cargo xtask figures builds it", binary.display());
    let mut command = Command::new(binary);
    command.arg(scene).args(options).args(["--tables-only", "--out"]).arg(&out).current_dir(root());
    assert!(command.output().expect("the binary starts").status.success(), "{command:?}");
    let text = fs::read_to_string(out.join(made)).expect("a table");
    let (id, file) = table.split_once('/').expect("figure and table");
    let fresh = MixedTable::parse(golden::sample(&text).as_bytes()).expect("a table");
    let tolerances = tolerances();
    numbers::compare(&sample(table), &fresh, 1, &|column| tolerances.column(id, file, column)).expect("one shape")
}

/// Scene, panel, table, file of the run, a number of the scene and one that is 1e-6 off.
const RUNS: [[&str; 6]; 7] = [
    ["fig04-algebraic-std", "stable", "fig04/stable", "std.csv", "mu = 0.45", "mu = 0.450001"],
    ["fig04-algebraic-std", "unstable", "fig04/unstable", "std.csv", "mu = 0.55", "mu = 0.550001"],
    ["fig07-exponential-std", "stable", "fig07/stable", "std.csv", "a = 1.5", "a = 1.500001"],
    ["fig07-exponential-std", "unstable", "fig07/unstable", "std.csv", "a = 3.0", "a = 3.000001"],
    ["fig13-logarithmic-std", "std", "fig13/std", "std.csv", "v0      = 1.0", "v0 = 1.000001"],
    ["fig13-logarithmic-std", "std_small_shift", "fig13/std_small_shift", "std.csv", "v0      = 1.0", "v0 = 1.000001"],
    ["fig11-trajectories", "main", "fig11/trajectories", "trajectories.csv", "v0      = 1.0", "v0 = 1.000001"],
];

#[test]
#[ignore = "needs the release binaries: cargo xtask ci --full"]
fn another_method_is_within_and_a_parameter_off_by_a_millionth_is_beyond() {
    for [slug, panel, table, made, value, off] in RUNS {
        let scene = format!("figures/{slug}/scene.toml");
        let panel = ["--panel", panel];
        let same = run(&scene, table, made, &panel);
        assert_eq!(same.cells, 0, "{table}");
        let other = run(&scene, table, made, &[&panel[..], &["--method", "dop853", "--tol", "1e-12"]].concat());
        assert!(other.cells > 0 && other.beyond == 0 && other.unmatched == 0, "{table} by DOP853: {other:?}");
        let text = fs::read_to_string(root().join(&scene)).expect("a scene");
        assert!(text.contains(value), "{scene} has no {value}");
        let edited = Path::new(env!("CARGO_TARGET_TMPDIR")).join("off.toml");
        fs::write(&edited, text.replace(value, off)).expect("a scene");
        let physics = run(&edited.to_string_lossy(), table, made, &panel);
        assert!(physics.beyond > 0, "{table} with {off}: {physics:?}");
    }
}
