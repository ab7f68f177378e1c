//! Computes the tables of rounding, growth rates and growth of errors: `studies --out DIR`.

use clap::Parser;
use figures::failure::exit;
use figures::studies::{Arguments, main as studies};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(studies(&Arguments::parse()))
}
