//! Supplement 25: outcomes of the algebraic law with widening over strength and gap (the third class of figure 3), and
//! over relative speed and strength (between its first and second class). The tables are committed, as in supplement
//! 18.

use figures::{Failure, Job, figure};
use planes::outcomes::{self, Titled};
use plot::Picture;
use plot::style::FULL_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

const PLANES: [Titled<'_>; 3] = [
    ("widened", "$\\langle\\mu, 0, 2, 0.2\\rangle$"),
    ("delta_near", "$\\langle\\mu, \\delta, 2, 0\\rangle$, $d' = 0.5$"),
    ("delta_far", "$\\langle\\mu, \\delta, 2, 0\\rangle$, $d' = 1$"),
];

fn tables(job: &mut Job) -> Result<(), Failure> {
    outcomes::tables(job, &PLANES)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    outcomes::picture(job, &PLANES, 3, [FULL_WIDTH, 72.0])
}
