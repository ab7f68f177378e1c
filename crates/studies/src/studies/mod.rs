//! Studies of errors: what rounding does to Heun's scheme, growth rates of waves against the linear theory, and how far
//! an error grows (`paper/rounding.md` tells what the tables say).

mod error_growth;
mod heun;
mod mode_growth;
pub mod optimum;
mod rounding;
mod solution;
mod verbatim;

use crate::hard::Tables;
use crate::hard::run::figure_4;
use figures::failure::{Failure, print};
use figures::job::finite_csv;
use files::write::{atomic, with_path};
use jam::laws::Model;
use jam::ring::Ring;
use jam::states::FormKind;
use std::path::PathBuf;

/// What the command line asks for.
#[derive(Debug, clap::Parser)]
#[command(name = "studies", about = "Computes the tables of rounding, growth rates and growth of errors")]
pub struct Arguments {
    /// Folder for the tables; made if missing
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only the studies whose name starts so
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Long steps, short runs, few waves: some seconds
    #[arg(long)]
    quick: bool,
    /// Steps down to 1e-5 and runs to t = 2000: some minutes
    #[arg(long, conflicts_with = "quick")]
    full: bool,
    /// Folder of the reference solutions
    #[arg(long, value_name = "DIR", default_value = "data/reference/solutions")]
    solutions: PathBuf,
}

/// How much of a study is wanted. The rows of a smaller extent are rows of the larger ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Extent {
    Quick,
    Usual,
    Full,
}

/// Computes the tables of a study from the reference solutions in a folder.
type Compute = fn(Extent, &std::path::Path) -> Result<Tables, Failure>;

/// The studies by name.
const STUDIES: [(&str, Compute); 4] = [
    ("rounding", rounding::tables),
    ("verbatim", verbatim::tables),
    ("mode_growth", mode_growth::tables),
    ("error_growth", error_growth::tables),
];

/// Computes the studies asked for and writes each table as soon as its study is done.
///
/// # Errors
/// A reference solution cannot be read, a run failed, a table holds a number that is not finite, or a file cannot be
/// written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let extent = match (arguments.quick, arguments.full) {
        (true, _) => Extent::Quick,
        (_, true) => Extent::Full,
        _ => Extent::Usual,
    };
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|only| name.starts_with(only.as_str()));
    std::fs::create_dir_all(&arguments.out).map_err(|error| with_path(error, &arguments.out))?;
    for (_, compute) in STUDIES.into_iter().filter(|(name, _)| wanted(name)) {
        for (name, rows) in compute(extent, &arguments.solutions)? {
            atomic(&arguments.out.join(format!("{name}.csv")), &finite_csv(name, &rows)?)?;
            print(&format!("{name}.csv: {} rows", rows.len()))?;
        }
    }
    Ok(())
}

/// The law and the ring of figure 4, stable panel.
fn figure_4_stable() -> (Model, Ring) {
    (figure_4(0.45), Ring { pedestrians: 67, length: 200.0 })
}

/// Its shift of the first pedestrian.
const SHIFT: f64 = 1e-4;

/// The forms in which rounding is studied, with their names.
const FORMS: [(FormKind, &str); 3] =
    [(FormKind::Positions, "positions"), (FormKind::Gaps, "gaps"), (FormKind::Deviations, "deviations")];
