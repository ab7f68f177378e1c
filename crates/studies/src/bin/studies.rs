//! Computes the tables of rounding, growth rates and growth of errors: `studies --out DIR`.

use clap::Parser;
use figures::failure::exit;
use std::process::ExitCode;
use studies::studies::{Arguments, main as studies};

fn main() -> ExitCode {
    exit(studies(&Arguments::parse()))
}
