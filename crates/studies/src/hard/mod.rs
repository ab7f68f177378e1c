//! Tables of the hard cases: what happens in each, and what each scheme does (discussed in the numerical supplement).
//! Every number is computed in two independent ways, and the table states their difference.

mod blow_up;
mod cfm;
mod fixed_steps;
mod kink;
mod long_run;
mod marginal;
mod near_contact;
mod ramp_range;
pub mod rows;
pub mod run;
mod sizes;
mod stiffness;
mod tiny;
pub mod waves;
mod widening;

use figures::failure::{Failure, print};
use figures::job::finite_csv;
use files::write::{atomic, make_folder};
use rows::Rows;
use std::path::PathBuf;

/// What the command line asks for.
#[derive(Debug, clap::Parser)]
#[command(name = "hard", about = "Computes the tables of the hard cases")]
pub struct Arguments {
    /// Folder for the tables; made if missing
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only the cases whose name starts so
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Fewer and shorter runs
    #[arg(long)]
    quick: bool,
}

/// Tables with the names of their files.
pub type Tables = Vec<(&'static str, Rows)>;

/// Computes the tables of a case; `quick` for fewer rows.
type Compute = fn(quick: bool) -> Result<Tables, Failure>;

/// The cases by name.
const CASES: [(&str, Compute); 12] = [
    ("blow_up", blow_up::tables),
    ("fixed_steps", fixed_steps::tables),
    ("near_contact", near_contact::tables),
    ("kink", kink::tables),
    ("ramp_range", ramp_range::tables),
    ("stiffness", stiffness::tables),
    ("marginal", marginal::tables),
    ("long_run", long_run::tables),
    ("sizes", sizes::tables),
    ("widening", widening::tables),
    ("cfm", cfm::tables),
    ("tiny", tiny::tables),
];

/// Computes the cases asked for and writes each table as soon as its case is done.
///
/// # Errors
/// A reference run failed, a table holds a number that is not finite, or a file cannot be written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|only| name.starts_with(only.as_str()));
    make_folder(&arguments.out)?;
    for (_, compute) in CASES.into_iter().filter(|(name, _)| wanted(name)) {
        for (name, rows) in compute(arguments.quick)? {
            atomic(&arguments.out.join(format!("{name}.csv")), &finite_csv(name, &rows)?)?;
            print(&format!("{name}.csv: {} rows", rows.len()))?;
        }
    }
    Ok(())
}
