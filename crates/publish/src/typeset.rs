//! The typesetter: a `typst` of the pinned version on PATH, or the pinned wheel installed below `target`.

use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use checkout::process;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The typesetter's pinned wheel, by name.
const TYPST_PIN: &str = "paper/requirements.txt";
/// What makes an environment of Python below the target folder, by name.
const PYTHON: &str = "checks/python.sh";
/// What makes the wheel behave as the program, by name.
const TYPST_STAND_IN: &str = "paper/typeset.py";

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
    Wheel(PathBuf),
}

/// The version of the `typst` on PATH, if it is the pinned one.
pub fn on_path() -> Option<String> {
    process::first_line("typst", &["--version"]).filter(|line| line.split_whitespace().nth(1) == Some(VERSION))
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
    wheel(paths, &[]).map_err(|why| {
        Failure::Unsupported(format!(
            "no typesetter: no typst {VERSION} on PATH, and its wheel cannot be installed\n{why}\n\
             install typst {VERSION}, or run this once with Python 3.11 or later and a network"
        ))
    })
}

/// The typesetter that is available without an installation.
pub fn at_hand(paths: &Paths) -> Option<Typesetter> {
    on_path().map(|_| Typesetter::Program).or_else(|| wheel(paths, &["--installed"]).ok())
}

fn wheel(paths: &Paths, options: &[&str]) -> Result<Typesetter, String> {
    let mut script = Command::new("bash");
    script.arg(PYTHON).args(options).args(["typst", TYPST_PIN]).current_dir(&paths.root);
    script.env("CARGO_TARGET_DIR", &paths.target).stdin(Stdio::null());
    let ended = script.output().map_err(|error| format!("bash: {error}"))?;
    match ended.status.success() {
        true => Ok(Typesetter::Wheel(paths.root.join(String::from_utf8_lossy(&ended.stdout).trim()))),
        false => Err(String::from_utf8_lossy(&ended.stderr).trim().to_owned()),
    }
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
                let mut command = Command::new(python);
                command.env("PYTHONNOUSERSITE", "1").env_remove("PYTHONPATH").env_remove("PYTHONHOME");
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
