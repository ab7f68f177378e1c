//! Classifies the runs of a plane by outcome: `sweep SCENE.toml --out DIR`.

use clap::Parser;
use figures::failure::exit;
use planes::command::{Arguments, main as sweep};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(sweep(&Arguments::parse()))
}
