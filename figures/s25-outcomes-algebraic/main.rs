//! Supplement 25: what a flow of the algebraic law becomes over relative speed and strength at two gaps, over strength and gap
//! with widening (the third class of figure 3), and over widening. The tables are committed, as those of supplement 18.

use figures::outcomes::{self, Titled};
use figures::{Failure, Job, figure};
use plot::Picture;
use plot::style::FULL_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

const PLANES: [Titled<'_>; 4] = [
    ("delta_near", "$\\langle\\mu, \\delta, 2, 0\\rangle$, $d' = 0.5$"),
    ("delta_far", "$\\langle\\mu, \\delta, 2, 0\\rangle$, $d' = 1$"),
    ("widened", "$\\langle\\mu, 0, 2, 0.2\\rangle$"),
    ("widening", "$\\langle\\mu, 0, 2, \\tilde a_v\\rangle$, $L' = 200$"),
];

fn tables(job: &mut Job) -> Result<(), Failure> {
    outcomes::tables(job, &PLANES)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    outcomes::picture(job, &PLANES, 2, [FULL_WIDTH, 150.0])
}
