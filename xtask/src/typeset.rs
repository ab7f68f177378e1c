//! The typesetter: a `typst` on PATH of the pinned version, or the pinned wheel in a folder below target.

use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::paths::{Paths, TYPST_PIN, TYPST_STAND_IN};
use crate::python::{self, Python};
use std::path::Path;
use std::process::{Command, Stdio};

/// The one version whose bytes are known; `paper/requirements.txt` pins the same.
pub const VERSION: &str = "0.15.0";
/// What the document claims to be, as the typesetter names it: the typesetter refuses to set anything else.
const STANDARDS: &str = "a-2a,ua-1";
/// The creation date in every file, seconds since 1970: 1 January 2026. A date of the clock would change the bytes.
const CREATED: &str = "1767225600";
/// Variables of the environment that the typesetter would listen to.
const DEAF_TO: [&str; 5] =
    ["SOURCE_DATE_EPOCH", "TYPST_FONT_PATHS", "TYPST_ROOT", "TYPST_PACKAGE_PATH", "TYPST_PACKAGE_CACHE_PATH"];

/// A typesetter that was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Typesetter {
    /// The program on PATH.
    Program,
    /// The wheel, behind a script that takes the program's arguments.
    Wheel(Python),
}

/// The version of the `typst` on PATH, if it is the pinned one.
pub fn on_path() -> Option<String> {
    child::first_line("typst", &["--version"]).filter(|line| line.split_whitespace().nth(1) == Some(VERSION))
}

/// What there is without installing anything: the program, or the wheel installed before; for `doctor`.
pub fn at_hand(paths: &Paths) -> Option<String> {
    let installed = || python::installed(paths, "typst", TYPST_PIN).ok().flatten();
    on_path().or_else(|| installed().map(|_| format!("wheel {VERSION} below target")))
}

/// Finds the program, or the wheel, which is installed below target on the first call.
///
/// # Errors
/// Unsupported: neither can be had, with what was tried and what to do.
pub fn find(paths: &Paths) -> Result<Typesetter, Failure> {
    if on_path().is_some() {
        return Ok(Typesetter::Program);
    }
    // whatever keeps the wheel away, a missing Python or a missing network, the machine cannot do it
    python::install(paths, "typst", TYPST_PIN).map(Typesetter::Wheel).map_err(|failure| {
        let why = failure.text();
        Failure::Unsupported(format!(
            "no typesetter: no typst {VERSION} on PATH, and its wheel cannot be installed\n{why}\n\
             install typst {VERSION}, or run this once with Python 3.11 or later and a network"
        ))
    })
}

impl Typesetter {
    /// Sets `source` (a file of the checkout, by name) as PDF at `output`, with these inputs.
    ///
    /// # Errors
    /// Differs: the document has an error; its words. Failed: the typesetter cannot be started.
    pub fn set(&self, paths: &Paths, source: &str, output: &Path, inputs: &[(&str, &str)]) -> Result<(), Failure> {
        let mut command = match self {
            Typesetter::Program => Command::new("typst"),
            Typesetter::Wheel(python) => {
                let mut command = python.command();
                command.arg(paths.root.join(TYPST_STAND_IN));
                command
            }
        };
        command.arg("compile").arg("--root").arg(&paths.root).arg("--ignore-system-fonts");
        command.arg("--font-path").arg(paths.fonts()).args(["--creation-timestamp", CREATED]);
        command.args(["--pdf-standard", STANDARDS]);
        for (name, value) in inputs {
            command.args(["--input", &format!("{name}={value}")]);
        }
        command.arg(paths.root.join(source)).arg(output).current_dir(&paths.root).stdin(Stdio::null());
        DEAF_TO.iter().for_each(|name| {
            command.env_remove(name);
        });
        if let Some(folder) = output.parent() {
            disk::create_folder(folder)?;
        }
        let ended = command.output().map_err(|error| Failure::Failed(format!("typesetter: {error}")))?;
        let words = String::from_utf8_lossy(&ended.stderr);
        match ended.status.success() {
            // a warning is a fault of the document: a missing font, text that does not fit
            true if words.contains("warning:") => Err(Failure::Differs(format!("{source}: {}", words.trim()))),
            true => Ok(()),
            false => Err(Failure::Differs(format!("{source} cannot be set:\n{}", words.trim()))),
        }
    }
}
