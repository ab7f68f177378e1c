//! Staleness: the effect of a change in each kind of file, and whether what is hashed is what is read.

use crate::shop::{Shop, blessed};
use checkout::figure;
use checkout::paths::Paths;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use xtask::compile;
use xtask::pins;
use xtask::sources::SourceHashes;

/// The programs that a plan would start, sorted.
fn planned(shop: &Shop) -> Vec<String> {
    let json = shop.xtask(&["figures", "--all", "--dry-run", "--json"]).expect(0).json();
    let mut nodes: Vec<String> =
        json["nodes"].as_array().expect("nodes").iter().filter_map(|node| node.as_str().map(str::to_owned)).collect();
    nodes.sort();
    nodes
}

const FIGURES: [&str; 6] = [
    "fig04-growth",
    "fig05-exponential-map",
    "fig06-exponential-sway",
    "fig11-trajectories",
    "fig12-speeds",
    "s01-variant",
];
const RUNS: [&str; 8] = [
    "fig04 check stable",
    "fig04 check unstable",
    "fig04 run stable",
    "fig04 run unstable",
    "fig11 check main",
    "fig11 run main",
    "s01 check main",
    "s01 run main",
];

/// A changed file, what it is changed to (nothing: it is deleted), and the programs that this leads to.
type Case<'a> = (&'a str, Option<&'a str>, &'a [&'a [&'a str]]);

#[test]
fn every_kind_of_change_leads_to_exactly_the_needed_work() {
    let shop = blessed("stale-kinds");
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.xtask(&["bless", "--all"]).expect(0);
    assert!(planned(&shop).is_empty());
    let scene = shop.read("figures/fig04-growth/scene.toml").replace("mu = 0.5", "mu = 0.6");
    let lock = shop.read("Cargo.lock").replace("0.18.1", "0.18.2");
    let cases: [Case; 21] = [
        // sources
        ("figures/fig05-exponential-map/main.rs", Some("//! Another."), &[&["fig05-exponential-map"]]),
        ("figures/fig05-exponential-map/scene.toml", Some("title = \"x\""), &[&["fig05-exponential-map"]]),
        (
            "figures/fig04-growth/scene.toml",
            Some(&scene),
            &[&["fig04 check unstable", "fig04 run unstable", "fig04-growth"]],
        ),
        ("crates/math/src/lib.rs", Some("//! Other numbers."), &[&RUNS, &FIGURES]),
        ("crates/plot/src/lib.rs", Some("//! Other pictures."), &[&FIGURES]),
        ("crates/plot/src/lib.rs", None, &[&FIGURES]),
        ("figures/src/lib.rs", None, &[&RUNS, &FIGURES]),
        ("Cargo.lock", Some(&lock), &[&RUNS, &FIGURES]),
        ("rust-toolchain.toml", None, &[&RUNS, &FIGURES]),
        ("data/accuracy/named.csv", Some("t\n"), &[&["s01-variant"]]),
        // outputs
        ("data/fig05/left.csv", Some("a,phi\n0,1\n"), &[&["fig05-exponential-map"]]),
        ("data/fig05/left.csv", None, &[&["fig05-exponential-map"]]),
        ("figures/fig12-speeds/fig12.svg", Some("<svg/>"), &[&["fig12-speeds"]]),
        ("figures/fig12-speeds/fig12.png", None, &[&["fig12-speeds"]]),
        // what reaches no figure
        ("data/accuracy/unnamed.csv", Some("t\n"), &[]),
        ("README.md", Some("words"), &[]),
        ("crates/math/LICENSE-MIT", Some("words"), &[]),
        ("crates/math/tests/a.rs", Some("//! A test."), &[]),
        ("data/golden/fig05/left.csv", None, &[]),
        ("data/SHA256SUMS", None, &[]),
        ("data/manifest.json", None, &[]),
    ];
    for (name, text, expected) in cases {
        let path = shop.root.join(name);
        let old = fs::read(&path).ok();
        match text {
            Some(text) => shop.write(name, text),
            None => fs::remove_file(&path).expect("a file"),
        }
        let mut expected = expected.concat();
        expected.sort_unstable();
        assert_eq!(planned(&shop), expected, "{name} as {text:?}");
        match old {
            Some(old) => fs::write(&path, old).expect("a file"),
            None => fs::remove_file(&path).expect("a file"),
        }
        assert!(planned(&shop).is_empty(), "{name} put back");
    }
}

#[test]
fn a_crate_that_changed_is_told_with_both_versions() {
    let shop = blessed("stale-crate");
    shop.edit("Cargo.lock", "0.18.1", "0.18.2");
    let ended = shop.xtask(&["status", "5"]).expect(0);
    assert!(ended.out.contains("crate png changed: 0.18.1 -> 0.18.2"), "{}", ended.out);
}

#[test]
fn crates_of_the_runner_alone_are_no_inputs() {
    let package = |name: &str, needs: &str| {
        format!(
            "[[package]]\nname = \"{name}\"\nversion = \"1.0.0\"\nchecksum = \"0123456789ab\"\ndependencies = [{needs}]\n"
        )
    };
    let lock = [
        package("figures", "\"png\""),
        package("png", "\"deep 1.0.0\""),
        package("deep", ""),
        package("xtask", "\"base64\""),
    ];
    let lock = format!("{}{}", lock.concat(), package("base64", ""));
    let found = pins::crates(&lock).expect("a lock file");
    let names: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(names, ["crate deep", "crate png"]);
    assert_eq!(found["crate png"], "1.0.0 01234567");
}

fn root() -> std::path::PathBuf {
    fs::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).expect("the checkout")
}

/// What is hashed for a figure and stands in no list of the compiler: read by cargo, by the program itself, or shared.
fn is_read_otherwise(name: &str, slug: &str) -> bool {
    let by_cargo = name.ends_with("Cargo.toml") || ["rust-toolchain.toml", ".cargo/config.toml"].contains(&name);
    let by_the_program = name == Paths::scene(slug) || name.starts_with("data/");
    // other programs, the licence of the fonts, and what only tests compile
    let by_nobody = name.starts_with("figures/src/bin/")
        || name == "crates/reference/src/main.rs"
        || name.ends_with("OFL.txt")
        || name == "crates/plot/src/vision.rs";
    by_cargo || by_the_program || by_nobody
}

/// The files of the checkout that the compiler read for a program: its list beside it, in the form of make.
fn compiled_from(paths: &Paths, program: &str) -> BTreeSet<String> {
    let list = paths.binary(program).with_extension("d");
    let text =
        fs::read_to_string(&list).unwrap_or_else(|error| panic!("{}: {error}; cargo xtask figures", list.display()));
    let files = text.lines().filter_map(|line| line.split_once(": ")).flat_map(|(_, files)| files.split(' '));
    let start = format!("{}/", paths.root.display());
    files.filter_map(|file| file.strip_prefix(&start)).map(str::to_owned).collect()
}

#[test]
#[ignore = "needs the release binaries: cargo xtask ci --full"]
fn what_the_compiler_read_is_what_is_hashed() {
    let paths = Paths::find(Some(root())).expect("the checkout");
    let sources = SourceHashes::read(&paths).expect("sources");
    for figure in figure::discover(&paths).expect("figures") {
        let hashed: BTreeSet<String> = sources.figure(&figure, &[]).into_keys().filter(|name| is_file(name)).collect();
        let read = compiled_from(&paths, &figure.slug);
        assert!(read.contains(&format!("figures/{}/main.rs", figure.slug)), "{read:?}");
        let missing: Vec<&String> = read.difference(&hashed).collect();
        assert!(missing.is_empty(), "{}: read and not hashed: {missing:?}", figure.slug);
        let unread = hashed.difference(&read).filter(|name| !is_read_otherwise(name, &figure.slug));
        let unread: Vec<&String> = unread.collect();
        assert!(unread.is_empty(), "{}: hashed and not read: {unread:?}", figure.slug);
    }
    for tool in compile::FIGURES.tools.iter().chain(compile::PLANES.tools).chain(compile::STUDIES.tools) {
        let missing: Vec<String> =
            compiled_from(&paths, tool).into_iter().filter(|name| !sources.files.contains_key(name)).collect();
        assert!(missing.is_empty(), "{tool}: read and not hashed: {missing:?}");
    }
}

/// Whether an input is a file: the others have a blank in their names, or are the compiler.
fn is_file(name: &str) -> bool {
    !name.contains(' ') && name != pins::RUSTC
}

/// Files below the checkout that a program opens to read.
fn opened(root: &Path, program: &Path, arguments: &[&str]) -> BTreeSet<String> {
    let log = Path::new(env!("CARGO_TARGET_TMPDIR")).join("strace.txt");
    let mut strace = Command::new("strace");
    strace.args(["-f", "-qq", "-e", "trace=open,openat", "-o"]).arg(&log).arg(program).args(arguments);
    let output = strace.current_dir(root).output().expect("strace starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = fs::read_to_string(&log).expect("a log");
    let succeeded = text
        .lines()
        .filter(|line| line.contains("O_RDONLY") && !line.contains("O_DIRECTORY") && !line.contains(") = -1"));
    let names = succeeded.filter_map(|line| line.split('"').nth(1)).map(|name| root.join(name));
    let inside = names.filter_map(|path| Some(path.strip_prefix(root).ok()?.to_string_lossy().into_owned()));
    inside.filter(|name| !name.starts_with("target/")).collect()
}

#[test]
#[ignore = "needs the release binaries: cargo xtask ci --full"]
fn programs_open_only_what_is_hashed() {
    if Command::new("strace").arg("-V").output().is_err() {
        eprintln!("skipped: no strace");
        return;
    }
    let paths = Paths::find(Some(root())).expect("the checkout");
    let sources = SourceHashes::read(&paths).expect("sources");
    let costs = checkout::costs::read(&paths).expect("costs");
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("opened");
    for figure in figure::discover(&paths).expect("figures") {
        // supplements that integrate for long by themselves are left out
        if costs.get(&figure.slug).is_some_and(|cost| cost.cpu > 2.0) {
            eprintln!("skipped: {}", figure.id);
            continue;
        }
        let scene = Paths::scene(&figure.slug);
        let keys = xtask::record::keys(&paths, &figure, &sources.numeric());
        let mut arguments = vec!["--scene".to_owned(), scene];
        for (option, folder) in [("--tables", "tables"), ("--pictures", "pictures")] {
            fs::create_dir_all(out.join(folder)).expect("a folder");
            arguments.extend([option.to_owned(), out.join(folder).to_string_lossy().into_owned()]);
        }
        for (panel, key) in &keys {
            let folder = xtask::store::folder(&paths, key);
            assert!(folder.is_dir(), "{}: cargo xtask figures --all makes it", folder.display());
            arguments.extend(["--run".to_owned(), format!("{panel}={}", folder.display())]);
        }
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let hashed = sources.figure(&figure, &[]);
        let strange = opened(&paths.root, &paths.binary(&figure.slug), &arguments);
        let strange: Vec<String> = strange.into_iter().filter(|name| !hashed.contains_key(name)).collect();
        assert!(strange.is_empty(), "{} opens {strange:?}", figure.slug);
    }
}
