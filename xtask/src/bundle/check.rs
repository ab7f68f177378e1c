//! Checks of an archive: its sums, the descriptions by the validators of their own projects, and the commands of the
//! README in a copy that has no network and nothing of cargo's but the programs.

use super::SUMS;
use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::hashing;
use crate::paths::{BUNDLE_REQUIREMENTS, Paths, RUN_CRATE_CHECK};
use crate::print;
use crate::python::{self, Python};
use crate::sums::Sums;
use std::env;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The crates whose tests are run in the copy; those of all would take as long as `cargo xtask test`.
const TESTED: [&str; 5] = ["math", "ode", "jam", "files", "scene"];

/// Unpacks the archive into an empty folder and checks what is there.
///
/// # Errors
/// Differs: a sum, a description or a command. Otherwise what kept it from being checked.
pub fn run(paths: &Paths, archive: &Path, top: &str) -> Result<(), Failure> {
    let place = paths.unpacked();
    disk::remove(&place)?;
    disk::create_folder(&place)?;
    let file = File::open(archive).map_err(Failure::at(archive))?;
    tar::Archive::new(file).unpack(&place).map_err(Failure::at(&place))?;
    let root = place.join(top);
    print::out(&format!("{} files with the sums in {SUMS}\n", sums(&root)?))?;
    descriptions(&python::install(paths, "bundle", BUNDLE_REQUIREMENTS)?, &root)?;
    commands(&place, &root)?;
    disk::remove(&place)
}

/// Compares every file with the list; how many there are.
fn sums(root: &Path) -> Result<usize, Failure> {
    let list = Sums::read(&root.join(SUMS), SUMS)?;
    let list = list.ok_or_else(|| Failure::Differs(format!("the archive has no {SUMS}")))?;
    let files = disk::walk(root, &|_| true)?;
    let names = files.iter().map(|path| relative(root, path));
    let made = names.zip(hashing::hash_all(&files)?).filter(|(name, _)| name != SUMS);
    let made = made.filter_map(|(name, hash)| Some((name, hash?))).collect();
    let wrong: Vec<String> = list
        .judge(&made)
        .into_iter()
        .filter(|(_, state)| *state != crate::sums::State::Same)
        .map(|(name, state)| format!("{}: {name}", state.word()))
        .collect();
    if wrong.is_empty() { Ok(made.len()) } else { Err(Failure::Differs(wrong.join("\n"))) }
}

fn relative(root: &Path, path: &Path) -> String {
    let parts = path.strip_prefix(root).unwrap_or(path).iter();
    parts.map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// Each description by the validator of its own project.
fn descriptions(python: &Python, root: &Path) -> Result<(), Failure> {
    let program = |call: &str| {
        let mut command = python.command();
        command.args(["-c", call]).current_dir(root);
        command
    };
    let mut crates = python.command();
    crates.arg(RUN_CRATE_CHECK).current_dir(root);
    let mut citation = program("from cffconvert.cli.cli import cli; cli()");
    citation.arg("--validate");
    let mut package = python.command();
    package.args(["-m", "frictionless", "validate", "data/datapackage.json"]).current_dir(root);
    for (name, command) in [
        ("ro-crate-metadata.json", &mut crates),
        ("CITATION.cff", &mut citation),
        ("data/datapackage.json", &mut package),
    ] {
        let output =
            command.stdin(Stdio::null()).output().map_err(|error| Failure::Failed(format!("{name}: {error}")))?;
        if !output.status.success() {
            let words = [&output.stdout[..], &output.stderr].concat();
            return Err(Failure::Differs(format!("{name} is not valid:\n{}", String::from_utf8_lossy(&words))));
        }
        print::out(&format!("{name}: valid\n"))?;
    }
    Ok(())
}

/// The README's commands in the copy.
fn commands(place: &Path, root: &Path) -> Result<(), Failure> {
    let home = place.join("empty home");
    disk::create_folder(&home)?;
    let has_walls = Command::new("unshare").args(["-n", "true"]).status().is_ok_and(|status| status.success());
    if !has_walls {
        print::out("skipped: a copy without a network (unshare -n is not possible here); cargo is told to use none\n")?;
    }
    let cargo = |arguments: &[&str]| {
        // cargo as who follows the README starts it: the one behind it would not tell the compiler which toolchain is pinned,
        // and crates that pin another one would ask for that
        let mut command = if has_walls { Command::new("unshare") } else { Command::new("cargo") };
        if has_walls {
            command.args(["-n", "cargo"]);
        }
        command.args(arguments).current_dir(root).env_clear().envs(kept());
        command.env("CARGO_HOME", &home).env("CARGO_NET_OFFLINE", "true");
        command
    };
    let tests: Vec<&str> = TESTED.iter().flat_map(|name| ["-p", name]).collect();
    let tests = [&["test", "--release", "--locked", "--quiet"], &tests[..]].concat();
    for arguments in [&["xtask", "figures"][..], &tests] {
        let name = format!("cargo {}", arguments.join(" "));
        print::out(&format!("without a network: {name}\n"))?;
        child::run_shown(&mut cargo(arguments)).map_err(|failure| match failure {
            Failure::Child(code) => Failure::Differs(format!("{name} in the unpacked archive ended with {code}")),
            other => other,
        })?;
    }
    Ok(())
}

/// What programs and the toolchain are found by.
fn kept() -> Vec<(&'static str, std::ffi::OsString)> {
    let home = ["RUSTUP_HOME", "HOME"].into_iter();
    let rustup =
        home.zip(["", ".rustup"]).find_map(|(name, below)| env::var_os(name).map(|at| PathBuf::from(at).join(below)));
    let path = env::var_os("PATH").map(|path| ("PATH", path));
    path.into_iter().chain(rustup.map(|folder| ("RUSTUP_HOME", folder.into_os_string()))).collect()
}
