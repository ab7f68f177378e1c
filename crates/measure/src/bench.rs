//! `bench`: CPU seconds and instructions of the parts of a run; against another commit, ratios.

use crate::benchmarks::{self, Measured, Tree};
use checkout::disk;
use checkout::failure::Failure;
use checkout::machine;
use checkout::paths::Paths;
use checkout::print;
use checkout::process;
use clap::Parser;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Measures seconds and instructions of the laws, of steps and of whole runs; against another commit, their ratios.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask bench")]
pub struct BenchArgs {
    /// The checkout
    #[arg(long, hide = true)]
    pub root: Option<PathBuf>,
    /// Only benchmarks whose names contain one of these: heun, run/fig11
    pub names: Vec<String>,
    /// Another commit, measured in turn with this tree; ends with code 1 when this tree is slower
    #[arg(long, value_name = "COMMIT")]
    pub against: Option<String>,
    /// How much slower counts: the whole interval of the ratio of seconds above it, or the ratio of instructions
    #[arg(long, value_name = "PERCENT", default_value = "5%", value_parser = percent)]
    pub fail_above: f64,
    /// Samples of each benchmark; intervals need 6
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u16).range(1..))]
    pub rounds: u16,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `5%` or `5` as 0.05.
fn percent(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.strip_suffix('%').unwrap_or(text).parse().ok();
    let fraction = number.filter(|number| number.is_finite() && *number >= 0.0).map(|number| number / 100.0);
    fraction.ok_or_else(|| format!("{text}: must be a percentage such as 5%"))
}

/// Runs the command line; the exit code.
pub fn main() -> i32 {
    let arguments = BenchArgs::parse();
    let done = Paths::find(arguments.root.clone()).and_then(|paths| run(&paths, &arguments));
    done.map_or_else(|failure| failure.tell(), |()| 0)
}

/// Runs the verb.
///
/// # Errors
/// Differs: something is slower than the other commit by more than is allowed. Usage: no such commit, or no benchmark
/// of this name. Otherwise what kept the programs from being built or run.
pub fn run(paths: &Paths, arguments: &BenchArgs) -> Result<(), Failure> {
    let other = arguments.against.as_deref().map(|name| commit(paths, name)).transpose()?;
    let tree = benchmarks::build(paths, &paths.root, "here")?;
    let against = match &other {
        Some(commit) => Some(benchmarks::build(paths, &benchmarks::unpack(paths, commit)?, commit)?),
        None => None,
    };
    let names = choose(&tree, &arguments.names)?;
    let mut all = Vec::new();
    for name in &names {
        eprintln!("{name}");
        all.push(benchmarks::measure(&tree, against.as_ref(), name, arguments.rounds)?);
    }
    let summary = summary(paths, arguments, other.as_deref(), &all);
    let against = other.as_ref().map_or(String::new(), |other| format!("-against-{other}"));
    let file = paths.root.join("data/timing/bench").join(format!("{}{against}.json", here(paths)));
    disk::write(&file, format!("{summary:#}\n").as_bytes())?;
    if arguments.json {
        print::json(summary)?;
    } else {
        print::out(&format!("{}kept in {}\n", table(&all, arguments.fail_above), file.display()))?;
    }
    let slower: Vec<&str> =
        all.iter().filter(|one| one.is_slower(arguments.fail_above)).map(|one| one.name.as_str()).collect();
    let percent = 100.0 * arguments.fail_above;
    match slower.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("slower by more than {percent} %: {}", slower.join(", ")))),
    }
}

/// The short hash of a commit.
fn commit(paths: &Paths, name: &str) -> Result<String, Failure> {
    let root = paths.root.to_string_lossy();
    let wanted = format!("{name}^{{commit}}");
    let hash = process::first_line("git", &["-C", &root, "rev-parse", "--short", "--verify", "--quiet", &wanted]);
    hash.ok_or_else(|| Failure::Usage(format!("{name}: no such commit")))
}

/// The short hash of the commit that the tree is at, or `worktree` when something tracked is modified.
fn here(paths: &Paths) -> String {
    let root = paths.root.to_string_lossy();
    let status = process::first_line("git", &["-C", &root, "status", "--porcelain", "--untracked-files=no"]);
    let is_clean = status.is_some_and(|line| line.is_empty());
    commit(paths, "HEAD").ok().filter(|_| is_clean).unwrap_or_else(|| "worktree".to_owned())
}

/// The benchmarks whose names contain one of the words; all without words.
fn choose(tree: &Tree, words: &[String]) -> Result<Vec<String>, Failure> {
    let all = tree.names()?;
    if let Some(word) = words.iter().find(|word| !all.iter().any(|name| name.contains(*word))) {
        return Err(Failure::Usage(format!("no benchmark {word}; there are {}", all.join(", "))));
    }
    let chosen = |name: &String| words.is_empty() || words.iter().any(|word| name.contains(word));
    Ok(all.into_iter().filter(chosen).collect())
}

fn summary(paths: &Paths, arguments: &BenchArgs, other: Option<&str>, all: &[Measured]) -> Value {
    let facts: BTreeMap<&str, String> = machine::facts().into_iter().collect();
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--root")).collect();
    let results: Vec<Value> = all
        .iter()
        .map(|one| {
            let mut value = json!(one);
            if let Some(ratio) = one.ratio() {
                value["ratio"] = json!({ "median": ratio.median, "low": ratio.low, "high": ratio.high });
            }
            value["slower"] = one.is_slower(arguments.fail_above).into();
            value
        })
        .collect();
    json!({
        "schema_version": 1, "command": format!("cargo xtask bench {}", words.join(" ")), "commit": here(paths),
        "against": other, "machine": facts, "rounds": arguments.rounds, "benchmarks": results,
    })
}

/// A row for each benchmark. Ratios are this tree by the other one.
fn table(all: &[Measured], allowed: f64) -> String {
    let mut rows =
        vec![print::row(&["benchmark", "microseconds", "instructions", "time ratio", "instruction ratio", ""])];
    for one in all {
        let ratio = one
            .ratio()
            .map_or(String::new(), |ratio| format!("{:.3} [{:.3}, {:.3}]", ratio.median, ratio.low, ratio.high));
        let instructions = one.instructions.map_or("-".to_owned(), |count| format!("{count:.0}"));
        let counted = one.instruction_ratio().map_or(String::new(), |ratio| format!("{ratio:.4}"));
        let slower = if one.is_slower(allowed) { "SLOWER" } else { "" };
        rows.push(print::row(&[
            &one.name,
            &format!("{:.3}", 1e6 * one.once()),
            &instructions,
            &ratio,
            &counted,
            slower,
        ]));
    }
    print::table(&rows)
}
