//! Programs in Python: an environment below the target folder with exactly the packages of a requirements file, each by
//! its hash. Nothing is installed outside of it, and nothing is fetched before somebody asks with [`install`].

use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::lock::Lock;
use crate::paths::Paths;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::AtomicBool;

/// A Python that finds the packages of one environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Python {
    program: PathBuf,
    /// The folder that holds the packages, where they are not in an environment of their own.
    packages: Option<PathBuf>,
}

/// How to get what [`install`] needs.
pub const REMEDY: &str = "install Python 3.11 or later with venv or pip (Debian: apt-get install python3 python3-venv)";

/// Names under which Python is looked for.
const PROGRAMS: [&str; 2] = ["python3", "python"];
/// The oldest Python that the requirements are resolved for.
const OLDEST: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

impl Python {
    /// Starts a command: this Python, with the packages of its environment and none of the user's.
    pub fn command(&self) -> Command {
        let mut command = plain(&self.program);
        if let Some(packages) = &self.packages {
            command.env("PYTHONPATH", packages);
        }
        command
    }
}

/// The Python of this machine, 3.11 or later; `None` when there is none.
pub fn find() -> Option<PathBuf> {
    PROGRAMS.into_iter().find(|program| child::first_line(program, &["-c", OLDEST]).is_some()).map(PathBuf::from)
}

/// The environment `name`, if it has been installed from this requirements file and for this Python.
///
/// # Errors
/// The requirements file cannot be read.
pub fn installed(paths: &Paths, name: &str, requirements: &str) -> Result<Option<Python>, Failure> {
    let Some(program) = find() else { return Ok(None) };
    let place = Place::new(paths, name, requirements, &program)?;
    place.installed()
}

/// The environment `name` with the packages of `requirements` (a name relative to the root); made if it is not there.
///
/// # Errors
/// Unsupported: no Python, or one that can neither make environments nor has pip. Failed: a package cannot be fetched,
/// or has another hash.
pub fn install(paths: &Paths, name: &str, requirements: &str) -> Result<Python, Failure> {
    let program = find().ok_or_else(|| Failure::Unsupported(format!("Python is missing: {REMEDY}")))?;
    install_with(paths, name, requirements, &program)
}

/// As [`install`], with this Python.
///
/// # Errors
/// As [`install`].
pub fn install_with(paths: &Paths, name: &str, requirements: &str, program: &Path) -> Result<Python, Failure> {
    let _lock = Lock::take(paths)?;
    let place = Place::new(paths, name, requirements, program)?;
    if let Some(python) = place.installed()? {
        return Ok(python);
    }
    eprintln!("installing {requirements} below {}", place.folder.display());
    disk::remove(&place.folder)?;
    let python = place.environment()?;
    place.fill(&python)?;
    disk::write(&place.record(), place.contents.as_bytes())?;
    Ok(python)
}

/// Where an environment lies and what it is to hold.
struct Place<'a> {
    paths: &'a Paths,
    name: &'a str,
    requirements: PathBuf,
    folder: PathBuf,
    program: &'a Path,
    /// What determines the environment: the version of Python and the hash of the requirements.
    contents: String,
}

impl<'a> Place<'a> {
    fn new(paths: &'a Paths, name: &'a str, requirements: &str, program: &'a Path) -> Result<Place<'a>, Failure> {
        let file = paths.root.join(requirements);
        let hash = files::write::sha256_file(&file).map_err(Failure::failed)?;
        let version = child::first_line(&program.to_string_lossy(), &["--version"]).unwrap_or_default();
        let contents = format!("{version}\n{hash}\n");
        Ok(Place { paths, name, requirements: file, folder: paths.python(name), program, contents })
    }

    /// Written last: an environment without it was broken off.
    fn record(&self) -> PathBuf {
        self.folder.join("contents.txt")
    }

    fn installed(&self) -> Result<Option<Python>, Failure> {
        let is_whole = disk::read_text(&self.record())?.is_some_and(|contents| contents == self.contents);
        Ok(is_whole.then(|| if self.own().is_file() { self.in_environment() } else { self.beside() }))
    }

    /// The Python of the environment.
    fn own(&self) -> PathBuf {
        let folder = if cfg!(windows) { "Scripts" } else { "bin" };
        self.folder.join(folder).join(format!("python{}", env::consts::EXE_SUFFIX))
    }

    fn in_environment(&self) -> Python {
        Python { program: self.own(), packages: None }
    }

    /// Packages in a folder, for a Python that cannot make environments.
    fn beside(&self) -> Python {
        Python { program: self.program.to_path_buf(), packages: Some(self.folder.join("packages")) }
    }

    /// An empty environment; where Python comes without `ensurepip`, as Debian's does, a folder for packages.
    fn environment(&self) -> Result<Python, Failure> {
        let mut venv = plain(self.program);
        venv.args(["-m", "venv"]).arg(&self.folder);
        if self.run("venv", venv).is_ok() {
            return Ok(self.in_environment());
        }
        disk::remove(&self.folder)?;
        let pip = child::first_line(&self.program.to_string_lossy(), &["-m", "pip", "--version"]);
        pip.map(|_| self.beside()).ok_or_else(|| {
            let program = self.program.display();
            Failure::Unsupported(format!("{program} can neither make environments (venv) nor has pip: {REMEDY}"))
        })
    }

    /// Fetches the packages: built ones only, no code runs while they are installed.
    fn fill(&self, python: &Python) -> Result<(), Failure> {
        let mut pip = plain(&python.program);
        pip.args(["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check"]);
        pip.args(["--require-hashes", "--only-binary", ":all:", "--requirement"]).arg(&self.requirements);
        if let Some(packages) = &python.packages {
            pip.arg("--target").arg(packages);
        }
        self.run("pip", pip)
    }

    fn run(&self, step: &str, command: Command) -> Result<(), Failure> {
        let log = self.paths.log(&format!("python {} {step}", self.name));
        child::run_logged(command, &log, &AtomicBool::new(false), &|_| {})
    }
}

/// A Python that neither the user's environment variables nor the user's packages reach.
fn plain(program: &Path) -> Command {
    let mut command = Command::new(program);
    command.env("PYTHONNOUSERSITE", "1").env_remove("PYTHONPATH").env_remove("PYTHONHOME");
    command
}
