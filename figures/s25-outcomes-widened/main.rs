//! Supplement 25: what a flow of the algebraic law with widening becomes, over strength and gap: the third class of figure 3.
//! The table is committed, as those of supplement 18.

use figures::outcomes::{self, Titled};
use figures::{Failure, Job, figure};
use plot::Picture;
use plot::style::COLUMN_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

const PLANES: [Titled<'_>; 1] = [("widened", "")];

fn tables(job: &mut Job) -> Result<(), Failure> {
    outcomes::tables(job, &PLANES)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    outcomes::picture(job, &PLANES, 1, [COLUMN_WIDTH, 84.0])
}
