//! Measures error against work for every method: `precision --out DIR`.

use clap::Parser;
use figures::failure::exit;
use figures::precision::{Arguments, main as precision};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(precision(&Arguments::parse()))
}
