//! Supplement 21: outcomes over further planes: of the logarithmic law over shift, headway and the axes of figure 10,
//! of the algebraic law with relative speed over widening. The tables are committed, as in supplement 18.

use figures::{Failure, Job, figure};
use planes::outcomes::{self, Titled};
use plot::Picture;
use plot::style::FULL_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

const PLANES: [Titled<'_>; 4] = [
    ("logarithmic_shift", "logarithmic, $\\Delta y = 1.5$"),
    ("logarithmic_headway", "logarithmic, $\\epsilon_1 = 0.1$"),
    ("logarithmic_wide", "logarithmic, axes of figure 10"),
    ("relative_widened", "$\\langle\\mu, 1, 2, \\tilde a_v\\rangle$, $d' = 0.5$"),
];

fn tables(job: &mut Job) -> Result<(), Failure> {
    outcomes::tables(job, &PLANES)?;
    outcomes::bands(job, &["logarithmic_shift", "logarithmic_headway"])
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    outcomes::picture(job, &PLANES, 2, [FULL_WIDTH, 150.0])
}
