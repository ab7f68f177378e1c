//! Draws the contact sheet of the gallery of laws: `cargo run --release -p figures --bin gallery`.

use clap::Parser;
use figures::failure::exit;
use figures::gallery::{Arguments, main as gallery};
use std::process::ExitCode;

fn main() -> ExitCode {
    exit(gallery(&Arguments::parse()))
}
