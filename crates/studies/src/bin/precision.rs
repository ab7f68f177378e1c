//! Measures error against work for every method: `precision --out DIR`.

use clap::Parser;
use figures::failure::exit;
use std::process::ExitCode;
use studies::precision::{Arguments, main as precision};

fn main() -> ExitCode {
    exit(precision(&Arguments::parse()))
}
