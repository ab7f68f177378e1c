//! Supplement 18: the outcome of unstable uniform flows over planes of parameters, of which the paper simulates three
//! points. A plane takes minutes, so its table is committed (`data/outcomes`); `checks/outcomes.sh` recomputes it.

use figures::{Failure, Job, figure};
use planes::outcomes::{self, Titled};
use plot::Picture;
use plot::style::FULL_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

const PLANES: [Titled<'_>; 4] = [
    ("logarithmic", "logarithmic"),
    ("exponential", "exponential"),
    ("relative", "algebraic, $\\langle\\mu, 1, 2, 0\\rangle$"),
    ("plain", "algebraic, $\\langle\\mu, 0, 2, 0\\rangle$"),
];

fn tables(job: &mut Job) -> Result<(), Failure> {
    outcomes::tables(job, &PLANES)?;
    outcomes::bands(job, &["logarithmic"])?;
    outcomes::how_sure(job, &PLANES)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    outcomes::picture(job, &PLANES, 2, [FULL_WIDTH, 150.0])
}
