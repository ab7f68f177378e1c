//! The command line.

use checkout::paths::Scheme;
use clap::{Args, Parser, Subcommand};
use std::ffi::OsString;
use std::path::PathBuf;

/// Computes, draws and verifies the figures.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
pub struct Cli {
    /// The checkout, when it is not the one around the current folder.
    #[arg(long, global = true, hide = true)]
    pub root: Option<PathBuf>,
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Write tables and pictures, hash them, compare with the committed sums
    Figures(FiguresArgs),
    /// Recompute into a scratch folder and judge against the committed reference: bytes, numbers, pixels, claims
    Verify(VerifyArgs),
    /// Show what is stale and why; run nothing
    Status(StatusArgs),
    /// Show every input of a figure, which one changed, and the command to rebuild; or a claim with its tests
    Explain(ExplainArgs),
    /// Show figure, label, title, binary, scene, outputs, last run time
    List(ListArgs),
    /// Accept new sums after showing what changes
    Bless(BlessArgs),
    /// Compute the tables of error against work again and compare them with the committed ones
    Accuracy(AccuracyArgs),
    /// Measure time and instructions of laws, steps and whole runs; with --against COMMIT, ratios
    #[command(disable_help_flag = true)]
    Bench(ForwardArgs),
    /// Write the page: one HTML file that needs no network
    Report(ReportArgs),
    /// Set the article as PDF, with its pictures and numbers
    Paper(PaperArgs),
    /// Write one deterministic archive: sources, crates, tables, pictures, descriptions
    Bundle(BundleArgs),
    /// Run a scene: cargo xtask simulate SCENE.toml; --help shows the options
    #[command(disable_help_flag = true)]
    Simulate(ForwardArgs),
    /// Compute a stability map: cargo xtask map SCENE.toml; --help shows the options
    #[command(disable_help_flag = true)]
    Map(ForwardArgs),
    /// Classify the runs of a plane by outcome: cargo xtask sweep SCENE.toml --out DIR; --help shows the options
    #[command(disable_help_flag = true)]
    Sweep(ForwardArgs),
    /// Run a scene or a figure and write its trajectories in metres, as PedPy and JuPedSim read them
    #[command(disable_help_flag = true)]
    Export(ForwardArgs),
    /// Describe machine and toolchain
    Describe(JsonArgs),
    /// List what is missing and how to get it
    Doctor(JsonArgs),
    /// Run the tests; list those whose tools are missing
    Test,
    /// Run all checks of continuous integration
    Ci(CiArgs),
    /// Remove everything that can be made again
    Clean,
}

/// Which figures are meant.
#[derive(Clone, Debug, Default, Args)]
pub struct Selection {
    /// fig04, 4, a label (fig:stdv_rec) or a prefix of the slug [default: all figures of the paper]
    pub ids: Vec<String>,
    /// Include the supplements
    #[arg(long, conflicts_with = "ids")]
    pub all: bool,
}

/// How work is spread.
#[derive(Clone, Debug, Default, Args)]
pub struct Effort {
    /// Number of programs run in parallel [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Continue with independent figures after a failure
    #[arg(long)]
    pub keep_going: bool,
}

impl Effort {
    /// The number of programs run in parallel.
    pub fn threads(&self) -> usize {
        let machine = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        self.jobs.map_or_else(machine, usize::from)
    }
}

/// Options of `figures`.
#[derive(Debug, Default, Args)]
pub struct FiguresArgs {
    /// Which figures.
    #[command(flatten)]
    pub selection: Selection,
    /// How work is spread.
    #[command(flatten)]
    pub effort: Effort,
    /// The method of the scene, or that of the paper, operation by operation (its tables and pictures have a folder of
    /// their own)
    #[arg(long, value_enum, default_value_t)]
    pub scheme: Scheme,
    /// Compute everything again from the start; ignore stored results and checkpoints
    #[arg(long)]
    pub force: bool,
    /// Show the plan and the time it takes; run nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `verify`.
#[derive(Clone, Debug, Default, Args)]
pub struct VerifyArgs {
    /// Which figures.
    #[command(flatten)]
    pub selection: Selection,
    /// How work is spread.
    #[command(flatten)]
    pub effort: Effort,
    /// Exit with code 0 if all differences are within data/tolerances.toml
    #[arg(long)]
    pub tolerant: bool,
    /// Verify only the figures that fit into this time, judged by earlier runs, without compilation: 60s, 2m
    #[arg(long, value_name = "TIME", value_parser = seconds)]
    pub budget: Option<f64>,
    /// Write an HTML page of the differences
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Append machine, toolchain and sums to data/attestations.jsonl unless already listed
    #[arg(long, conflicts_with_all = ["ids", "budget"])]
    pub attest: bool,
    /// Compute nothing: compare a receipt, copied from the page in a browser, with the committed sums
    #[arg(long, value_name = "FILE", conflicts_with_all = ["ids", "tolerant", "budget", "report", "attest", "costs"])]
    pub receipt: Option<PathBuf>,
    /// Measure seconds, memory and disk of each program, one at a time, and write data/costs.csv
    #[arg(long, conflicts_with_all = ["jobs", "budget"])]
    pub costs: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `status`.
#[derive(Debug, Args)]
pub struct StatusArgs {
    /// Which figures.
    #[command(flatten)]
    pub selection: Selection,
    /// Exit with code 3 if something is stale
    #[arg(long)]
    pub exit_code: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// A figure; or a claim, an erratum or a parameter, shown with its tests
    pub id: String,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `list`.
#[derive(Debug, Args)]
pub struct ListArgs {
    /// Which figures.
    #[command(flatten)]
    pub selection: Selection,
    /// What each figure and each claim costs, as measured by verify --costs; written to data/COSTS.md too
    #[arg(long)]
    pub costs: bool,
    /// List claims and their verdicts instead of figures
    #[arg(long, conflicts_with_all = ["ids", "all"])]
    pub claims: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `bless`.
#[derive(Debug, Args)]
pub struct BlessArgs {
    /// Which figures.
    #[command(flatten)]
    pub selection: Selection,
    /// The scheme whose sums are accepted
    #[arg(long, value_enum, default_value_t)]
    pub scheme: Scheme,
    /// Accept numbers that moved
    #[arg(long)]
    pub numbers: bool,
}

/// Options of `accuracy`.
#[derive(Debug, Args)]
pub struct AccuracyArgs {
    /// Only the cheap rows, in half a minute; they must be among the committed ones
    #[arg(long, conflicts_with_all = ["full", "seconds", "bless"])]
    pub quick: bool,
    /// Include expensive rows
    #[arg(long, conflicts_with_all = ["seconds", "bless"])]
    pub full: bool,
    /// Measure the archived times again, one program at a time
    #[arg(long)]
    pub seconds: bool,
    /// Accept the tables and write their sums
    #[arg(long)]
    pub bless: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `bundle`.
#[derive(Debug, Args)]
pub struct BundleArgs {
    /// Where to write it [default: below target]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Unpack it, validate its descriptions, and run the README's commands in it offline
    #[arg(long)]
    pub check: bool,
}

/// `90`, `90s`, `2m` or `1h` as seconds.
fn seconds(text: &str) -> Result<f64, String> {
    let unit = |end: char, seconds: f64| Some((text.strip_suffix(end)?, seconds));
    let (number, unit) =
        unit('s', 1.0).or_else(|| unit('m', 60.0)).or_else(|| unit('h', 3600.0)).unwrap_or((text, 1.0));
    let number: Option<f64> = number.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.map(|number| number * unit).ok_or_else(|| format!("{text}: must be a time such as 60s or 2m"))
}

/// Options of `report`.
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// Where to write the page [default: paper/report.html]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Exit with code 1 if its sum is not the committed one
    #[arg(long)]
    pub check: bool,
}

/// Arguments that another program reads.
#[derive(Debug, Args)]
pub struct ForwardArgs {
    /// Passed on as they are.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    pub arguments: Vec<OsString>,
}

/// Options of verbs that only print.
#[derive(Debug, Args)]
pub struct JsonArgs {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `paper`.
#[derive(Debug, Default, Args)]
pub struct PaperArgs {
    /// Accept the numbers and the sums of the article and of its pictures
    #[arg(long)]
    pub bless: bool,
}

/// Options of `ci`.
#[derive(Debug, Args)]
pub struct CiArgs {
    /// Include the slow checks
    #[arg(long)]
    pub full: bool,
}
