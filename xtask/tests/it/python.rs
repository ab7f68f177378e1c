//! Environments of Python: only what is asked for, only with the right hash. The package is a wheel made here: nothing
//! is fetched.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::failure::Failure;
use xtask::paths::{Paths, Scheme};
use xtask::python::{self, Python};

/// Writes a wheel, a module with one value, and prints its address.
const WHEEL: &str = "
import pathlib, sys, zipfile
print(pathlib.Path(sys.argv[1]).as_uri())
with zipfile.ZipFile(sys.argv[1], 'w') as wheel:
    wheel.writestr('tiny.py', 'value = 42\\n')
    wheel.writestr('tiny-1.0.dist-info/METADATA', 'Metadata-Version: 2.1\\nName: tiny\\nVersion: 1.0\\n')
    wheel.writestr('tiny-1.0.dist-info/WHEEL', 'Wheel-Version: 1.0\\nRoot-Is-Purelib: true\\nTag: py3-none-any\\n')
    wheel.writestr('tiny-1.0.dist-info/RECORD', 'tiny.py,,\\n')
";

/// A checkout with a wheel.
struct Folder {
    paths: Paths,
    /// The Python that made the wheel.
    program: PathBuf,
    /// Where the wheel lies, as a URL.
    address: String,
}

/// A folder with the wheel and a requirements file that names it by its hash; `None` on a machine without Python.
fn folder(name: &str) -> Option<Folder> {
    let Some(program) = python::find() else {
        eprintln!("skipped: no Python 3.11 or later");
        return None;
    };
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&root);
    fs::create_dir_all(&root).expect("a folder");
    let wheel = root.join("tiny-1.0-py3-none-any.whl");
    let made = Command::new(&program).args(["-c", WHEEL]).arg(&wheel).output().expect("Python starts");
    let address = String::from_utf8_lossy(&made.stdout).trim().to_owned();
    let paths = Paths { base: root.clone(), target: root.join("target"), root, scheme: Scheme::Adaptive };
    let folder = Folder { paths, program, address };
    folder.require(&files::write::sha256_file(&wheel).expect("a wheel"));
    Some(folder)
}

impl Folder {
    /// Writes the requirements file.
    fn require(&self, hash: &str) {
        let line = format!("tiny @ {} --hash=sha256:{hash}\n", self.address);
        fs::write(self.paths.root.join("requirements.txt"), line).expect("a file");
    }
}

/// What the module of the wheel says.
fn value(python: &Python) -> String {
    let output = python.command().args(["-c", "import tiny; print(tiny.value)"]).output().expect("Python starts");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

#[test]
fn an_environment_is_made_once_and_again_when_its_requirements_change() {
    let Some(folder) = folder("python environment") else { return };
    let paths = &folder.paths;
    let installed = || python::installed(paths, "tiny", "requirements.txt").expect("readable");
    assert_eq!(installed(), None);
    let python = python::install(paths, "tiny", "requirements.txt").expect("an environment");
    assert_eq!((installed().as_ref(), value(&python).as_str()), (Some(&python), "42"));
    // one that is whole is left alone
    let mark = paths.python("tiny").join("mark");
    fs::write(&mark, "").expect("a file");
    python::install(paths, "tiny", "requirements.txt").expect("the same environment");
    assert!(mark.is_file());
    // one that was broken off is not believed
    fs::remove_file(paths.python("tiny").join("contents.txt")).expect("a record");
    assert_eq!(installed(), None);
    python::install(paths, "tiny", "requirements.txt").expect("a new environment");
    assert!(!mark.exists() && installed().is_some());
    folder.require(&"0".repeat(64));
    assert_eq!(installed(), None);
}

#[test]
fn a_package_with_another_hash_is_refused() {
    let Some(folder) = folder("python hash") else { return };
    let paths = &folder.paths;
    folder.require(&"0".repeat(64));
    let failure = python::install(paths, "tiny", "requirements.txt").expect_err("a wrong hash");
    assert!(matches!(&failure, Failure::Failed(text) if text.contains("HASH")), "{failure:?}");
    assert_eq!(python::installed(paths, "tiny", "requirements.txt"), Ok(None));
}

/// Debian's Python without python3-venv: `-m venv` fails, pip is there.
#[cfg(unix)]
#[test]
fn without_venv_the_packages_lie_in_a_folder() {
    use std::os::unix::fs::PermissionsExt;
    let Some(Folder { paths, program, .. }) = folder("python folder") else { return };
    let paths = &paths;
    let poor = paths.root.join("poor-python");
    let script = format!("#!/bin/sh\n[ \"$2\" = venv ] && exit 1\nexec {} \"$@\"\n", program.display());
    fs::write(&poor, script).expect("a file");
    fs::set_permissions(&poor, fs::Permissions::from_mode(0o755)).expect("an executable");
    let python = python::install_with(paths, "tiny", "requirements.txt", &poor).expect("a folder of packages");
    assert_eq!(value(&python), "42");
    assert!(paths.python("tiny").join("packages/tiny.py").is_file());
    let again = python::install_with(paths, "tiny", "requirements.txt", &poor).expect("the same folder");
    assert_eq!(again, python);
}
