//! `doctor`: what is missing and how to get it.

use crate::cli::JsonArgs;
use crate::compile::{self, FONTS_REMEDY};
use crate::module;
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{Paths, TOOLCHAIN};
use checkout::print;
use checkout::process;
use serde_json::{Value, json};

/// One thing that a verb may need.
struct Finding {
    name: &'static str,
    /// What was found; `None` when it is missing.
    found: Option<String>,
    /// Whether figures cannot be made without it.
    needed: bool,
    /// How to get it.
    remedy: &'static str,
}

/// Runs the verb.
///
/// # Errors
/// Unsupported: something is missing that figures cannot be made without.
pub fn run(paths: &Paths, arguments: &JsonArgs) -> Result<(), Failure> {
    let findings = findings(paths)?;
    if arguments.json {
        let checks: Vec<Value> = findings.iter().map(to_json).collect();
        print::json(json!({ "checks": checks }))?;
    } else {
        let rows: Vec<Vec<String>> = findings.iter().map(to_row).collect();
        print::out(&print::table(&rows))?;
    }
    let missing: Vec<&str> =
        findings.iter().filter(|one| one.needed && one.found.is_none()).map(|one| one.name).collect();
    match missing.is_empty() {
        true => Ok(()),
        false => Err(Failure::Unsupported(format!("missing: {}", missing.join(", ")))),
    }
}

fn findings(paths: &Paths) -> Result<Vec<Finding>, Failure> {
    let cargo = process::cargo().get_program().to_string_lossy().into_owned();
    let fonts = compile::check_fonts(paths).ok().map(|()| "both faces".to_owned());
    let finding = |name, needed, found, remedy| Finding { name, found, needed, remedy };
    Ok(vec![
        finding("cargo", true, process::first_line(&cargo, &["--version"]), "install Rust with rustup (rustup.rs)"),
        finding("rustc", true, pinned_rustc(paths)?, "rustup toolchain install, in this folder"),
        finding("fonts", true, fonts, FONTS_REMEDY),
        finding("target folder", true, writable(paths), "free space, or CARGO_TARGET_DIR on another disk"),
        finding("git", false, process::first_line("git", &["--version"]), "needed by bless; install git"),
        finding(
            "clippy",
            false,
            process::first_line(&cargo, &["clippy", "--version"]),
            "needed by ci; rustup component add clippy",
        ),
        finding(
            "rustfmt",
            false,
            process::first_line(&cargo, &["fmt", "--version"]),
            "needed by ci; rustup component add rustfmt",
        ),
        finding("python", false, python(), "needed by a check of ci; Python 3.11 or later with venv or pip"),
        finding(
            "chromium",
            false,
            ["chromium", "chromium-browser"].iter().find_map(|name| process::first_line(name, &["--version"])),
            "needed by the tests of the page; apt-get install chromium",
        ),
        finding(
            "node",
            false,
            process::first_line("node", &["--version"]),
            "needed by the tests of the page; apt-get install nodejs npm",
        ),
        finding(
            "typst",
            false,
            process::first_line("typst", &["--version"]),
            "needed by paper, which installs it where there is Python 3.11 and a network",
        ),
        finding(
            "WebAssembly",
            false,
            module::compiler(paths).map(|compiler| compiler.name().to_owned()),
            "needed for the module of the page; rustup target add wasm32-unknown-unknown",
        ),
        finding("numpy", false, numpy(), "needed by spot checks of test; pip install numpy"),
    ])
}

/// The version of rustc, when it is the one that the checkout pins.
fn pinned_rustc(paths: &Paths) -> Result<Option<String>, Failure> {
    let pin = disk::read_text(&paths.root.join(TOOLCHAIN))?.unwrap_or_default();
    let channel = pin.lines().find_map(|line| line.trim().strip_prefix("channel")?.trim().strip_prefix('='));
    let channel = channel.map_or("", |channel| channel.trim().trim_matches('"'));
    Ok(process::first_line("rustc", &["--version"]).filter(|version| version.contains(channel)))
}

/// The version of Python, when it is new enough for the packages that are pinned.
fn python() -> Option<String> {
    let new_enough = "import sys; sys.exit(sys.version_info < (3, 11))";
    process::first_line("python3", &["-c", new_enough]).and_then(|_| process::first_line("python3", &["--version"]))
}

/// The version of NumPy, when Python has it.
fn numpy() -> Option<String> {
    process::first_line("python3", &["-c", "import numpy; print(numpy.__version__)"])
}

fn writable(paths: &Paths) -> Option<String> {
    let probe = paths.xtask().join("probe");
    disk::write(&probe, b"probe").and_then(|()| disk::remove(&probe)).ok().map(|()| "writable".to_owned())
}

fn to_row(finding: &Finding) -> Vec<String> {
    let (state, text) = match (&finding.found, finding.needed) {
        (Some(found), _) => ("found", found.as_str()),
        (None, true) => ("MISSING", finding.remedy),
        (None, false) => ("missing", finding.remedy),
    };
    print::row(&[finding.name, state, text])
}

fn to_json(finding: &Finding) -> Value {
    json!({ "name": finding.name, "found": finding.found, "needed": finding.needed, "remedy": finding.remedy })
}
