//! Runs a scene: `simulate SCENE.toml --out DIR`.

use clap::Parser;
use figures::failure::exit;
use figures::simulate::{Arguments, main as simulate};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(simulate(&Arguments::parse()))
}
