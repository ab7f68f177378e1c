//! Supplement 22: outcomes of the exponential law over the planes of figures 5 and 6. The tables are committed, as in
//! supplement 18.

use figures::{Failure, Job, figure};
use planes::outcomes::{self, Titled};
use plot::Picture;
use plot::style::FULL_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

const PLANES: [Titled<'_>; 6] = [
    ("exponential_far", "$\\tilde a_v = 0$, $d' = 2.5$"),
    ("exponential_middle", "$\\tilde a_v = 0$, $d' = 1.5$"),
    ("exponential_near", "$\\tilde a_v = 0$, $d' = 0.5$"),
    ("exponential_widened_far", "$\\tilde a_v = 0.15$, $d' = 2.5$"),
    ("exponential_widened_middle", "$\\tilde a_v = 0.15$, $d' = 1.5$"),
    ("exponential_widened_near", "$\\tilde a_v = 0.15$, $d' = 0.5$"),
];

fn tables(job: &mut Job) -> Result<(), Failure> {
    outcomes::tables(job, &PLANES)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    outcomes::picture(job, &PLANES, 3, [FULL_WIDTH, 125.0])
}
