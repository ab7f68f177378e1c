//! Draws the contact sheet of the gallery of laws: `cargo run --release -p figures --bin gallery`.

use clap::Parser;
use figures::failure::exit;
use std::process::ExitCode;
use studies::gallery::{Arguments, main as gallery};

fn main() -> ExitCode {
    exit(gallery(&Arguments::parse()))
}
