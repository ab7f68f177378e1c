//! The list of public items, `crates/jam/PUBLIC.txt`, so that no change to it goes unnoticed.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The crates that a researcher's program uses.
const CRATES: [&str; 4] = ["formula", "jam", "math", "ode"];

/// Set to write the list anew.
const RENEW: &str = "RENEW_PUBLIC";

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The sources below a folder, in order of their paths.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of sources").map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> = entries.collect();
    paths.sort();
    let below = |path: PathBuf| if path.is_dir() { sources(&path) } else { vec![path] };
    paths.into_iter().flat_map(below).filter(|path| path.extension().is_some_and(|end| end == "rs")).collect()
}

/// The declarations of a source that begin with `pub`, and the functions of traits that are public, each in a line
/// without its body. Tests at the end of a file are left out.
fn declarations(text: &str) -> Vec<String> {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or(text);
    let (mut found, mut under_way, mut in_trait) = (Vec::new(), String::new(), false);
    for line in text.lines() {
        let words = line.trim();
        in_trait = match line {
            "}" => false,
            line => in_trait || line.starts_with("pub trait"),
        };
        let is_member = in_trait && ["fn ", "const "].iter().any(|start| line.starts_with(&format!("    {start}")));
        if under_way.is_empty() && !words.starts_with("pub ") && !is_member {
            continue;
        }
        under_way.push_str(if under_way.is_empty() { "" } else { " " });
        under_way.push_str(words);
        let is_whole = words.ends_with(['{', ';', ',', '}']) && balanced(&under_way);
        if is_whole {
            let end = body(&under_way);
            found.push(std::mem::take(&mut under_way)[..end].trim_end_matches([' ', ';', ',']).to_owned());
        }
    }
    found
}

/// Whether every parenthesis is closed.
fn balanced(words: &str) -> bool {
    words.matches('(').count() == words.matches(')').count()
}

/// Where the body begins, but for `pub use`, whose braces hold names.
fn body(words: &str) -> usize {
    let begin = if words.starts_with("pub use") { None } else { words.find(" {") };
    begin.unwrap_or(words.len())
}

fn list() -> String {
    let mut text = String::new();
    for name in CRATES {
        let folder = crates().join(name).join("src");
        for path in sources(&folder) {
            let within = path.strip_prefix(&folder).expect("below it").components();
            let place: Vec<String> = within.map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
            let source = std::fs::read_to_string(&path).expect("a source");
            for declaration in declarations(&source.replace("\r\n", "\n")) {
                writeln!(text, "{name}/{}: {declaration}", place.join("/")).expect("room");
            }
        }
    }
    text
}

#[test]
fn what_is_public_is_listed() {
    let file = crates().join("jam/PUBLIC.txt");
    let now = list();
    if std::env::var_os(RENEW).is_some() {
        std::fs::write(&file, &now).expect("written");
    }
    let listed = std::fs::read_to_string(&file).expect("the list").replace("\r\n", "\n");
    let missing = |lines: &str, from: &str| -> Vec<String> {
        lines.lines().filter(|line| !from.lines().any(|other| other == *line)).map(str::to_owned).collect()
    };
    let (new, gone) = (missing(&now, &listed), missing(&listed, &now));
    assert!(
        new.is_empty() && gone.is_empty(),
        "crates/jam/PUBLIC.txt: new {new:#?}, gone {gone:#?}; if that is meant: {RENEW}=1 cargo test -p jamming --test it public"
    );
}

#[test]
fn a_declaration_is_read_without_its_body() {
    let text = "pub struct A {\n    /// x\n    pub x: f64,\n    y: f64,\n}\npub fn long(\n    a: f64,\n    b: f64,\n) -> f64 {\n    a\n}\n\
        pub trait T {\n    fn f(&self) -> f64;\n}\npub(crate) fn hidden() {}\npub use a::{B, C};\n";
    let wanted = [
        "pub struct A",
        "pub x: f64",
        "pub fn long( a: f64, b: f64, ) -> f64",
        "pub trait T",
        "fn f(&self) -> f64",
        "pub use a::{B, C}",
    ];
    assert_eq!(declarations(text), wanted);
}

/// Both licences ask to be handed on with the source. An archive of a package holds no file from outside its folder.
#[test]
fn a_package_brings_its_licences_and_says_what_it_is() {
    let read =
        |path: &std::path::Path| std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    for (package, name) in
        [("math", "jamming-math"), ("formula", "jamming-formula"), ("ode", "jamming-ode"), ("jam", "jamming")]
    {
        let folder = crates().join(package);
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let own = read(&folder.join(licence));
            assert_eq!(own, read(&crates().join("..").join(licence)), "{package}/{licence}");
        }
        assert_eq!(read(&folder.join("README.md")).lines().next(), Some(format!("# {name}").as_str()));
        let manifest = read(&folder.join("Cargo.toml"));
        let packed = manifest.lines().find(|line| line.starts_with("include = ")).expect("what is packed");
        assert!(packed.contains("\"README.md\"") && packed.contains("\"LICENSE-*\""), "{package}: {packed}");
    }
}
