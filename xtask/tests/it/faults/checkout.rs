//! A copy of the checkout with the programs that are built already, and what must be true of it after every run.

use files::write::sha256_file;
use std::env;
use std::ffi::OsString;
use std::fs;
use std::iter;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// What the runner reads of a checkout.
const READ: [&str; 12] = [
    "Cargo.toml",
    "Cargo.lock",
    "rust-toolchain.toml",
    ".cargo",
    "crates",
    "figures",
    "data/accuracy",
    "data/events.csv",
    "data/golden",
    "data/manifest.json",
    "data/reference",
    "data/timing",
];
/// The sums that every run is judged by.
const SUMS: &str = "data/SHA256SUMS";

/// The copy.
#[derive(Clone)]
pub struct Checkout {
    pub root: PathBuf,
    pub target: PathBuf,
    /// The runner, a link of its own: what is built meanwhile does not replace it.
    runner: PathBuf,
    /// The sums of the real checkout: name and hash.
    sums: Vec<(String, String)>,
    /// Manifest and events after a run that nothing disturbed.
    settled: Vec<(&'static str, Vec<u8>)>,
}

/// How a run ended.
pub struct CommandOutput {
    /// `None`: a signal ended it.
    pub code: Option<i32>,
    pub words: String,
}

impl Checkout {
    /// Copies what the runner reads to `root`, with links to the built programs, and runs it once, undisturbed.
    pub fn new(root: &Path) -> Checkout {
        let real = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        Checkout::copied(&real, &built_programs(), Path::new(env!("CARGO_BIN_EXE_xtask")), root)
    }

    /// Another copy, of this one.
    pub fn twin(&self, root: &Path) -> Checkout {
        Checkout::copied(&self.root, &self.target.join("release"), &self.runner, root)
    }

    fn copied(real: &Path, built: &Path, runner: &Path, root: &Path) -> Checkout {
        fs::create_dir_all(root.join("data")).expect("a folder");
        for name in READ {
            copy(&real.join(name), &root.join(name));
        }
        copy(&real.join(SUMS), &root.join(SUMS));
        let text = fs::read_to_string(root.join(SUMS)).expect("sums");
        let sums = text.lines().filter_map(|line| line.split_once("  "));
        let sums: Vec<(String, String)> = sums.map(|(hash, name)| (name.to_owned(), hash.to_owned())).collect();
        assert!(sums.len() > 60, "{} sums in {SUMS}", sums.len());
        let (target, own) = (root.join("target"), root.join("runner"));
        link(runner, &own);
        let mut checkout = Checkout { root: root.to_owned(), target, runner: own, sums, settled: Vec::new() };
        checkout.link_programs(built);
        let ended = checkout.run(&[]);
        assert_eq!(ended.code, Some(0), "the undisturbed run: {}", ended.words);
        checkout.settled = ["data/manifest.json", "data/events.csv"]
            .map(|name| (name, fs::read(root.join(name)).expect("a file")))
            .to_vec();
        checkout.must_be_right(&[], "the undisturbed run");
        checkout
    }

    /// The same copy under another path (after a move, or through a link).
    pub fn at(&self, root: &Path) -> Checkout {
        Checkout { root: root.to_owned(), target: root.join("target"), ..self.clone() }
    }

    /// Programs are linked, not copied: nothing here writes into one. `cargo` is a stand-in that builds nothing and
    /// notes that it was asked to.
    fn link_programs(&self, built: &Path) {
        let release = self.target.join("release");
        fs::create_dir_all(&release).expect("a folder");
        let names = fs::read_dir(self.root.join("figures")).expect("figures").flatten();
        let slugs = names.filter_map(|entry| entry.file_name().into_string().ok()).filter(|name| name.contains('-'));
        for name in slugs.chain(["simulate", "map", "sweep"].map(str::to_owned)) {
            link(&built.join(&name), &release.join(&name));
        }
        let cargo = self.root.join("cargo");
        fs::write(&cargo, "#!/bin/sh\necho asked >>\"$(dirname \"$0\")/cargo-calls\"\n").expect("a script");
        make_executable(&cargo);
    }

    /// The command that makes figures; without a name all of the paper.
    pub fn command(&self, arguments: &[&str]) -> Command {
        self.under(&[], &[&["figures"], arguments].concat())
    }

    /// The runner with these arguments, started by another program (`faketime`, `sh -c '.. exec "$@"'`).
    pub fn under(&self, starter: &[&str], arguments: &[&str]) -> Command {
        let mut command = match starter.split_first() {
            None => Command::new(&self.runner),
            Some((program, rest)) => {
                let mut command = Command::new(program);
                command.args(rest).arg(&self.runner);
                command
            }
        };
        command.arg("--root").arg(&self.root).args(arguments).current_dir(&self.root);
        command.env("CARGO_TARGET_DIR", &self.target).env("CARGO", self.root.join("cargo"));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// A search path on which `rustc`, which the runner asks for its version, is free of a library loaded before it:
    /// with `faketime`'s the compiler stands still.
    pub fn path_with_true_clock_for_the_compiler(&self) -> OsString {
        let folder = self.target.join("true-clock");
        fs::create_dir_all(&folder).expect("a folder");
        let script = folder.join("rustc");
        fs::write(&script, "#!/bin/sh\nPATH=${PATH#*:}\nunset LD_PRELOAD\nexec rustc \"$@\"\n").expect("a script");
        make_executable(&script);
        let rest = env::var_os("PATH").unwrap_or_default();
        env::join_paths(iter::once(folder).chain(env::split_paths(&rest))).expect("a path without colons")
    }

    pub fn run(&self, figures: &[&str]) -> CommandOutput {
        CommandOutput::of(&mut self.command(figures))
    }

    /// A plain run: it must end well, with the right sums and nothing left over.
    pub fn must_recover(&self, figures: &[&str], after: &str) {
        let ended = self.run(figures);
        assert_eq!(ended.code, Some(0), "a plain run after {after}:\n{}", ended.words);
        self.must_be_right(figures, after);
        let left = self.temporary();
        assert!(left.is_empty(), "after {after} and a plain run: {left:?}");
    }

    /// What a run that ended with 0 must have left.
    pub fn must_be_right(&self, figures: &[&str], after: &str) {
        let wrong: Vec<&str> =
            self.expected(figures).filter(|(name, hash)| !self.has(name, hash)).map(|one| one.0).collect();
        assert!(wrong.is_empty(), "after {after}: accepted, but wrong: {wrong:?}");
        for (name, bytes) in &self.settled {
            assert_eq!(fs::read(self.root.join(name)).ok().as_ref(), Some(bytes), "after {after}: {name} has changed");
        }
    }

    /// Judges a disturbed run: it may have failed, but if it says that all is well, all must be.
    pub fn must_not_lie(&self, ended: &CommandOutput, figures: &[&str], after: &str) {
        if ended.code == Some(0) {
            self.must_be_right(figures, after);
        }
    }

    /// What `status` calls fresh must have its sums; the number of fresh figures.
    pub fn fresh_must_be_right(&self, after: &str) -> usize {
        let output = self.under(&[], &["status", "--json"]).output().expect("the runner starts");
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
            panic!("status after {after}: {error}\n{}", String::from_utf8_lossy(&output.stderr))
        });
        let fresh = json["figures"].as_array().expect("figures").iter().filter(|one| one["state"] == "fresh");
        let ids: Vec<&str> = fresh.filter_map(|one| one["figure"].as_str()).collect();
        for id in &ids {
            let number = id.trim_start_matches("fig").trim_start_matches('0');
            let only = [number];
            let wrong: Vec<&str> =
                self.expected(&only).filter(|(name, hash)| !self.has(name, hash)).map(|one| one.0).collect();
            assert!(wrong.is_empty(), "after {after}: {id} is called fresh, but wrong: {wrong:?}");
        }
        ids.len()
    }

    /// Sums of the figures with these numbers; without one all.
    fn expected<'a>(&'a self, figures: &'a [&str]) -> impl Iterator<Item = (&'a str, &'a str)> {
        let belongs = move |name: &str| {
            let id = |number: &&str| format!("fig{number:0>2}");
            let is =
                |id: String| name.starts_with(&format!("data/{id}/")) || name.starts_with(&format!("figures/{id}-"));
            let numbers = figures.iter().filter(|one| !one.starts_with('-'));
            numbers.clone().next().is_none() || numbers.map(id).any(is)
        };
        self.sums.iter().map(|(name, hash)| (name.as_str(), hash.as_str())).filter(move |(name, _)| belongs(name))
    }

    fn has(&self, name: &str, hash: &str) -> bool {
        sha256_file(&self.root.join(name)).is_ok_and(|found| found == hash)
    }

    /// Forgets what was made: tables and records, with `store` the runs too.
    pub fn forget(&self, store: bool) {
        for entry in fs::read_dir(self.root.join("data")).expect("data").flatten() {
            if entry.file_name().to_string_lossy().starts_with("fig") {
                remove(&entry.path());
            }
        }
        remove(&self.target.join("xtask/state.json"));
        if store {
            remove(&self.target.join("store"));
        }
    }

    /// Temporary files and folders of the runner and its programs.
    pub fn temporary(&self) -> Vec<PathBuf> {
        let mut folders = vec![self.root.join("data"), self.target.join("store"), self.target.join("xtask")];
        folders.push(self.target.join("xtask/report"));
        folders.extend(entries(&self.root.join("figures")));
        let mut found = Vec::new();
        for path in folders.iter().flat_map(|folder| entries(folder)) {
            if path.to_string_lossy().contains(".tmp-") {
                found.extend(
                    entries(&path).into_iter().filter(|inner| inner.to_string_lossy().matches(".tmp-").count() > 1),
                );
                found.push(path);
            }
        }
        found
    }

    /// How often cargo was asked to build since the last question.
    pub fn builds(&self) -> usize {
        let file = self.root.join("cargo-calls");
        let count = fs::read_to_string(&file).unwrap_or_default().lines().count();
        let _ = fs::remove_file(file);
        count
    }
}

impl CommandOutput {
    pub fn of(command: &mut Command) -> CommandOutput {
        CommandOutput::from(&command.output().expect("the runner starts"))
    }

    pub fn from(output: &Output) -> CommandOutput {
        let words = [&output.stdout[..], &output.stderr].concat();
        CommandOutput { code: output.status.code(), words: String::from_utf8_lossy(&words).into_owned() }
    }
}

/// Where cargo has put the programs of the real checkout.
fn built_programs() -> PathBuf {
    let profile = Path::new(env!("CARGO_BIN_EXE_xtask")).parent().expect("a folder");
    profile.with_file_name("release")
}

/// A second name for a program, or a copy where that is not possible.
fn link(from: &Path, to: &Path) {
    fs::hard_link(from, to)
        .or_else(|_| fs::copy(from, to).map(drop))
        .unwrap_or_else(|error| panic!("{}: {error}; cargo xtask figures builds it", from.display()));
}

pub fn entries(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

/// Removes whatever is there.
pub fn remove(path: &Path) {
    if fs::symlink_metadata(path).is_ok_and(|data| data.is_dir()) {
        fs::remove_dir_all(path).expect("a folder that can be removed");
    } else {
        let _ = fs::remove_file(path);
    }
}

/// Copies a file or a folder.
pub fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).expect("a folder");
        for path in entries(from) {
            copy(&path, &to.join(path.file_name().unwrap_or_default()));
        }
    } else if from.is_file() {
        fs::copy(from, to).unwrap_or_else(|error| panic!("{} to {}: {error}", from.display(), to.display()));
    }
}

pub fn make_executable(path: &Path) {
    use std::os::unix::fs::PermissionsExt as _;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).expect("permissions");
}
