//! Exported trajectories read by PedPy: positions, speeds and the fundamental diagram against our own tables.

use crate::cli::{ExportArgs, FiguresArgs, Selection};
use crate::disk;
use crate::failure::Failure;
use crate::paths::{PEDPY_CHECK, PEDPY_REQUIREMENTS, Paths};
use crate::print;
use crate::python::{self, Python};
use crate::verbs::test::step;
use crate::verbs::{export, figures};

/// The name of the environment.
const ENVIRONMENT: &str = "pedpy";
/// The figure whose run is exported.
const FIGURE: &str = "fig11";
/// The figure whose tables are the fundamental diagram.
const DIAGRAM: &str = "s17";
/// Its tables.
const TABLES: [&str; 2] = ["states.csv", "steady.csv"];
/// Exports: name, frames a second, end in units of tau; the beginning at several rates, and the whole run.
const EXPORTS: [(&str, f64, Option<f64>); 5] = [
    ("fps8", 8.0, Some(60.0)),
    ("fps16", 16.0, Some(60.0)),
    ("fps32", 32.0, Some(60.0)),
    ("fps64", 64.0, Some(60.0)),
    ("whole", 8.0, None),
];

/// Runs the check if PedPy has been installed and the tables are there; else says what is skipped.
///
/// # Errors
/// Differs: a comparison fails.
pub fn check(paths: &Paths) -> Result<(), Failure> {
    let skip = |why: &str| print::out(&format!("skipped: trajectories read by PedPy: {why}\n"));
    if !paths.root.join(PEDPY_CHECK).is_file() {
        return skip(&format!("there is no {PEDPY_CHECK}"));
    }
    let tables = paths.output(&paths.tables(DIAGRAM));
    if TABLES.iter().any(|table| !tables.join(table).is_file()) {
        return skip(&format!("tables are missing; cargo xtask figures {DIAGRAM} makes them"));
    }
    match python(paths)? {
        Some(python) => compare(paths, &python),
        None => skip("it is not installed below the target folder; cargo xtask ci installs it"),
    }
}

/// The Python that has PedPy, and NumPy with it; `None` where it is not installed.
///
/// # Errors
/// As [`python::installed`].
pub fn python(paths: &Paths) -> Result<Option<Python>, Failure> {
    python::installed(paths, ENVIRONMENT, PEDPY_REQUIREMENTS)
}

/// Installs PedPy below the target folder and makes the tables, so that [`check`] finds both.
///
/// # Errors
/// As [`python::install`], or as `figures`.
pub fn prepare(paths: &Paths) -> Result<(), Failure> {
    python::install(paths, ENVIRONMENT, PEDPY_REQUIREMENTS)?;
    let selection = Selection { ids: vec![DIAGRAM.to_owned()], all: false };
    figures::run(paths, &FiguresArgs { selection, ..FiguresArgs::default() })
}

fn compare(paths: &Paths, python: &Python) -> Result<(), Failure> {
    export::build(paths)?;
    let folder = paths.exported();
    let result = exports(paths, &folder).and_then(|()| {
        let mut check = python.command();
        check.arg(paths.root.join(PEDPY_CHECK)).arg(&folder).arg(paths.output(&paths.tables(DIAGRAM)));
        // matplotlib, which PedPy loads, keeps its font cache here and not with the user
        step(PEDPY_CHECK, check.env("MPLCONFIGDIR", paths.python(ENVIRONMENT).join("matplotlib")))
    });
    disk::remove(&folder)?;
    result
}

/// The runs with their tables and both files each, below `folder`.
fn exports(paths: &Paths, folder: &std::path::Path) -> Result<(), Failure> {
    let scene = export::scene(paths, FIGURE)?;
    for (name, fps, t_end) in EXPORTS {
        let out = folder.join(name);
        let arguments = ExportArgs {
            scene: FIGURE.to_owned(),
            panel: None,
            out: out.clone(),
            a0: None,
            tau: 0.5,
            fps,
            t_end,
            format: None,
        };
        let table = export::simulate(paths, &scene, &arguments, &out)?;
        export::write(paths, &scene, &arguments, &table)?;
    }
    Ok(())
}
