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

/// Programs that print their version and that only some verbs need: name, program, arguments, how to get it.
const PROGRAMS: [(&str, &str, &[&str], &str); 7] = [
    ("git", "git", &["--version"], "needed by bless; install git"),
    ("clippy", "cargo", &["clippy", "--version"], "needed by ci; rustup component add clippy"),
    ("rustfmt", "cargo", &["fmt", "--version"], "needed by ci; rustup component add rustfmt"),
    ("python", "python3", &["-c", NEW_PYTHON], "needed by a check of ci; Python 3.11 or later with venv or pip"),
    ("node", "node", &["--version"], "needed by the tests of the page; apt-get install nodejs npm"),
    ("typst", "typst", &["--version"], "needed by paper, which installs it where there is Python 3.11 and a network"),
    (
        "numpy",
        "python3",
        &["-c", "import numpy; print(numpy.__version__)"],
        "needed by spot checks of test; pip install numpy",
    ),
];

/// Prints the version of a Python that is new enough for the packages that are pinned.
const NEW_PYTHON: &str =
    "import sys; sys.version_info < (3, 11) and sys.exit(1); print('Python', sys.version.split()[0])";

fn findings(paths: &Paths) -> Result<Vec<Finding>, Failure> {
    let cargo = process::cargo().get_program().to_string_lossy().into_owned();
    let fonts = compile::check_fonts(paths).ok().map(|()| "both faces".to_owned());
    let finding = |name, needed, found, remedy| Finding { name, found, needed, remedy };
    let mut findings = vec![
        finding("cargo", true, process::first_line(&cargo, &["--version"]), "install Rust with rustup (rustup.rs)"),
        finding("rustc", true, pinned_rustc(paths)?, "rustup toolchain install, in this folder"),
        finding("fonts", true, fonts, FONTS_REMEDY),
        finding("target folder", true, writable(paths), "free space, or CARGO_TARGET_DIR on another disk"),
    ];
    for (name, program, arguments, remedy) in PROGRAMS {
        let program = if program == "cargo" { &cargo } else { program };
        findings.push(finding(name, false, process::first_line(program, arguments), remedy));
    }
    let chromium = ["chromium", "chromium-browser"].iter().find_map(|name| process::first_line(name, &["--version"]));
    findings.push(finding("chromium", false, chromium, "needed by the tests of the page; apt-get install chromium"));
    let module = module::compiler(paths).map(|compiler| compiler.name().to_owned());
    let remedy = "needed for the module of the page; rustup target add wasm32-unknown-unknown";
    findings.push(finding("WebAssembly", false, module, remedy));
    Ok(findings)
}

/// The version of rustc, when it is the one that the checkout pins.
fn pinned_rustc(paths: &Paths) -> Result<Option<String>, Failure> {
    let pin = disk::read_text(&paths.root.join(TOOLCHAIN))?.unwrap_or_default();
    let channel = pin.lines().find_map(|line| line.trim().strip_prefix("channel")?.trim().strip_prefix('='));
    let channel = channel.map_or("", |channel| channel.trim().trim_matches('"'));
    Ok(process::first_line("rustc", &["--version"]).filter(|version| version.contains(channel)))
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
