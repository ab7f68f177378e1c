//! Computes the tables of the hard cases: `hard --out DIR`.

use clap::Parser;
use figures::failure::exit;
use figures::hard::{Arguments, main as hard};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(hard(&Arguments::parse()))
}
