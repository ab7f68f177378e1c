//! Computes the stability maps of a scene: `map SCENE.toml --out DIR`.

use clap::Parser;
use figures::failure::exit;
use figures::map::{Arguments, main as map};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(map(&Arguments::parse()))
}
