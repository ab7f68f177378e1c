//! The runner on a copy of this checkout with the real programs: what a wrong scene does to the verdict, and, with
//! programs built from changed sources, what another colour map, a wrong bit and a wrong length of a step do.

use crate::shop::CommandOutput;
use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What is copied: everything but the target folder and what is generated and not committed.
const COPIED: [&str; 11] = [
    "Cargo.toml",
    "Cargo.lock",
    "rust-toolchain.toml",
    ".cargo",
    "crates",
    "figures",
    "data/golden",
    "data/reference",
    "data/accuracy",
    "data/timing",
    "data/states",
];
/// Single files of the folder of data.
const DATA: [&str; 5] =
    ["data/SHA256SUMS", "data/SHA256SUMS-supplements", "data/events.csv", "data/manifest.json", "data/tolerances.toml"];

/// A copy of the checkout.
struct Copy {
    root: PathBuf,
    target: PathBuf,
    cargo: OsString,
    /// Held by the one copy that builds.
    _building: Option<MutexGuard<'static, ()>>,
}

/// Copies that build share a target folder, which is kept: the second time only the crates of the checkout are
/// compiled.
static BUILDING: Mutex<()> = Mutex::new(());

impl Copy {
    /// A copy whose programs are those built already; its cargo does nothing.
    fn new(name: &str) -> Copy {
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fill(&root, &[]);
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let built = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| here.join("target"), PathBuf::from);
        let target = root.join("target");
        let release = target.join("release");
        fs::create_dir_all(&release).expect("a folder");
        for entry in fs::read_dir(built.join("release")).expect("cargo xtask figures builds the programs").flatten() {
            if entry.path().is_file() {
                fs::hard_link(entry.path(), release.join(entry.file_name())).expect("a link");
            }
        }
        Copy { root, target, cargo: "true".into(), _building: None }
    }

    /// A copy that builds its programs from its own sources.
    fn building() -> Copy {
        // a test that failed has left nothing that the next does not replace
        let guard = BUILDING.lock().unwrap_or_else(PoisonError::into_inner);
        let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join("real-build");
        let root = scratch.join("checkout");
        fill(&root, &["xtask/Cargo.toml", "xtask/src", "xtask/examples"]);
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        Copy { root, target: scratch.join("target"), cargo, _building: Some(guard) }
    }

    fn edit(&self, name: &str, from: &str, to: &str) {
        let path = self.root.join(name);
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(text.contains(from), "{name} has no {from}");
        fs::write(path, text.replace(from, to)).expect("a file");
    }

    fn xtask(&self, arguments: &[&str]) -> CommandOutput {
        let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
        command.arg("--root").arg(&self.root).args(arguments).current_dir(&self.root);
        command.env("CARGO_TARGET_DIR", &self.target).env("CARGO", &self.cargo);
        command.env("GIT_DIR", self.root.join(".git"));
        CommandOutput::of(&command.output().expect("the runner starts"))
    }

    /// What `verify` says of one figure, and its exit code.
    fn verify(&self, figure: &str) -> (Value, i32) {
        let ended = self.xtask(&["verify", figure, "--json"]);
        (ended.json()["figures"][0].clone(), ended.code)
    }
}

/// Copies what every copy has, and more.
fn fill(root: &Path, more: &[&str]) {
    let _ = fs::remove_dir_all(root);
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for name in COPIED.iter().chain(&DATA).chain(more) {
        copy(&here.join(name), &root.join(name));
    }
}

fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).expect("a folder");
        for entry in fs::read_dir(from).expect("a folder").flatten() {
            copy(&entry.path(), &to.join(entry.file_name()));
        }
    } else {
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
        fs::copy(from, to).unwrap_or_else(|error| panic!("{}: {error}", from.display()));
    }
}

#[test]
#[ignore = "needs the release binaries: cargo xtask ci --full"]
fn a_parameter_off_by_a_millionth_is_other_physics() {
    for (figure, scene, value, off) in [
        ("fig04", "figures/fig04-algebraic-std/scene.toml", "mu = 0.45", "mu = 0.450001"),
        ("fig05", "figures/fig05-exponential-criterion/scene.toml", "d_gap = 2.5", "d_gap = 2.500001"),
        ("fig10", "figures/fig10-logarithmic-criterion/scene.toml", "headway = 1.5", "headway = 1.500001"),
        ("fig14", "figures/fig14-algebraic-growth/scene.toml", "mu      = 0.5", "mu      = 0.500001"),
        (
            "s14",
            "figures/s14-thresholds/scene.toml",
            "mu = 0.5, v0 = 3.0, epsilon = 0.1, q = 1.0, a_v",
            "mu = 0.500001, v0 = 3.0, epsilon = 0.1, q = 1.0, a_v",
        ),
    ] {
        let copy = Copy::new("real-off");
        assert_eq!(copy.verify(figure).1, 0, "{figure} as it is");
        copy.edit(scene, value, off);
        let (said, code) = copy.verify(figure);
        assert_eq!((said["verdict"].as_str(), code), (Some("other_physics"), 1), "{figure} with {off}: {said:#}");
    }
}

#[test]
#[ignore = "needs the release binaries: cargo xtask ci --full"]
fn a_step_twice_as_large_is_other_physics() {
    let copy = Copy::new("real-step");
    let scene = "figures/fig04-algebraic-std/scene.toml";
    let adaptive = "method    = \"taylor\"\ntolerance = 1e-12";
    copy.edit(scene, adaptive, "method    = \"heun\"\ndt        = 0.01");
    copy.xtask(&["figures", "4"]);
    copy.xtask(&["bless", "4", "--numbers"]).expect(0);
    assert_eq!(copy.verify("4").1, 0);
    copy.edit(scene, "0.01", "0.02");
    let (said, code) = copy.verify("4");
    assert_eq!((said["verdict"].as_str(), code), (Some("other_physics"), 1), "{said:#}");
    let course = &said["numbers"]["tables"]["unstable.csv"]["course"];
    assert_eq!(course["course"], "growing", "{course:#}");
}

#[test]
#[ignore = "builds all programs from changed sources: cargo xtask ci --full"]
fn another_colour_map_is_another_rendering_of_the_same_data() {
    let copy = Copy::building();
    let map = "ColorScale::diverging(\"$\\\\tilde\\\\Phi$\", 0.5)";
    let other = "ColorScale::sequential(\"$\\\\tilde\\\\Phi$\", -0.5, 0.5)";
    copy.edit("figures/fig05-exponential-criterion/main.rs", map, other);
    let (said, code) = copy.verify("5");
    assert_eq!((said["verdict"].as_str(), code), (Some("other_rendering"), 1), "{said:#}");
    let levels = ["bytes", "numbers", "pixels"].map(|level| said[level]["verdict"].as_str().unwrap_or(""));
    assert_eq!(levels, ["differs", "same", "differs"]);
    let files = said["bytes"]["files"].as_object().expect("files");
    let differing: Vec<&String> = files.iter().filter(|(_, state)| *state != "same").map(|(name, _)| name).collect();
    let folder = "figures/fig05-exponential-criterion";
    assert_eq!(differing, [&format!("{folder}/fig05.png"), &format!("{folder}/fig05.svg")]);
    let tables = said["numbers"]["tables"].as_object().expect("tables");
    assert!(tables.len() == 3 && tables.values().all(|table| table["cells"] == 0), "{tables:#?}");
    assert_eq!(
        (&said["numbers"]["events"], &said["numbers"]["parted"]),
        (&serde_json::json!([]), &serde_json::json!([]))
    );
    let picture = &said["pixels"]["pictures"][format!("{folder}/fig05.png")];
    assert!(picture["changed"].as_i64().is_some_and(|changed| changed > 100_000), "{picture:#}");
}
