//! Computes the tables of the hard cases: `hard --out DIR`.

use clap::Parser;
use figures::failure::exit;
use std::process::ExitCode;
use studies::hard::{Arguments, main as hard};

fn main() -> ExitCode {
    exit(hard(&Arguments::parse()))
}
