//! Builds the WebAssembly module of the page where the compiler, or Debian's, can.

use checkout::failure::Failure;
use checkout::paths::Paths;
use checkout::process;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What it is built for.
const TARGET: &str = "wasm32-unknown-unknown";
/// The profile with which it is built.
const PROFILE: &str = "page";
/// Two doubles at a time, which every browser of the last years can; the bits stay.
const FEATURES: &str = "-Ctarget-feature=+simd128";
/// How to get the target.
const REMEDY: &str =
    "rustup target add wasm32-unknown-unknown, or on Debian as root: apt-get install rustc-web rust-web-src lld-19";

/// Debian's compiler, which brings the library's sources, and its linker.
const DEBIAN_COMPILER: &str = "/usr/bin/rustc";
const DEBIAN_LINKER: &str = "wasm-ld-19";

/// Who can build it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compiler {
    /// The one of the toolchain file.
    Own,
    /// Debian's, which builds the standard library first.
    Debian,
}

impl Compiler {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Compiler::Own => "the pinned compiler has the target",
            Compiler::Debian => "Debian's compiler has the library's sources",
        }
    }
}

/// Who can build the module here.
pub fn compiler(paths: &Paths) -> Option<Compiler> {
    let own = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let library = process::first_line_in(&paths.root, &own, &["--print", "target-libdir", "--target", TARGET]);
    if library.is_some_and(|folder| has_library(Path::new(&folder))) {
        return Some(Compiler::Own);
    }
    let root = process::first_line(DEBIAN_COMPILER, &["--print", "sysroot"])?;
    let has_sources = Path::new(&root).join("lib/rustlib/src/rust/library").is_dir();
    (has_sources && process::first_line(DEBIAN_LINKER, &["--version"]).is_some()).then_some(Compiler::Debian)
}

/// Whether a folder holds the standard library: the compiler names it whether it exists or not.
fn has_library(folder: &Path) -> bool {
    let is_std = |name: &str| name.starts_with("libstd-") && name.ends_with(".rlib");
    let mut files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    files.any(|file| file.file_name().to_str().is_some_and(is_std))
}

/// Builds the module; `None`, with a message on stderr, if no compiler can.
///
/// # Errors
/// Failed: it does not compile.
pub fn build(paths: &Paths) -> Result<Option<PathBuf>, Failure> {
    let Some(compiler) = compiler(paths) else {
        eprintln!("without its WebAssembly module, with which the page computes: {REMEDY}");
        return Ok(None);
    };
    let mut cargo = process::cargo();
    cargo.args(["build", "--quiet", "--locked", "-p", "browser", "--profile", PROFILE, "--target", TARGET]);
    cargo.current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    cargo.env("CARGO_ENCODED_RUSTFLAGS", flags(paths).join("\u{1f}"));
    if compiler == Compiler::Debian {
        debian(&mut cargo);
    }
    process::run_shown(&mut cargo).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Failed(format!("the WebAssembly module does not build: exit code {code}")),
        other => other,
    })?;
    Ok(Some(paths.target.join(TARGET).join(PROFILE).join("browser.wasm")))
}

/// Flags of the compiler; messages name files from the checkout and from cargo's folder, wherever these lie.
fn flags(paths: &Paths) -> Vec<String> {
    let home = |name: &str| std::env::var_os(name).map(PathBuf::from);
    let cargo_home = home("CARGO_HOME").or_else(|| home("HOME").map(|home| home.join(".cargo")));
    let folders = [(Some(paths.root.clone()), "."), (cargo_home, "cargo")];
    let short = |(folder, name): (Option<PathBuf>, &str)| {
        folder.map(|folder| format!("--remap-path-prefix={}={name}", folder.display()))
    };
    std::iter::once(FEATURES.to_owned()).chain(folders.into_iter().filter_map(short)).collect()
}

/// A released compiler needs this permission to build the library from source.
fn debian(cargo: &mut Command) {
    cargo.arg("-Zbuild-std=std,panic_abort");
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", DEBIAN_COMPILER);
    cargo.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", DEBIAN_LINKER);
}
