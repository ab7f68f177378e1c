//! `bundle` on a small checkout: what it refuses, what it holds, the same bytes in another place.

use crate::shop::{Shop, blessed};
use std::collections::BTreeMap;
use std::fs;
use std::io::Read as _;
use std::path::Path;
use std::process::Command;

/// A checkout under git whose figures are all made and committed; `None` without git.
fn committed(name: &str) -> Option<Shop> {
    let shop = blessed(name);
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.xtask(&["bless", "s01"]).expect(0);
    shop.xtask(&["figures", "--all"]).expect(0);
    shop.write(".gitignore", "/target\n/cargo\n/calls.log\n/data/fig*/\n/data/s01/\n!/data/golden\n");
    shop.write("tool.sh", "#!/bin/sh\n");
    if !shop.git(&["init", "--quiet"]) {
        eprintln!("skipped: no git");
        return None;
    }
    assert!(shop.git(&["add", "--all"]) && shop.git(&["update-index", "--chmod=+x", "tool.sh"]));
    assert!(shop.git(&["commit", "--quiet", "-m", "all"]) && shop.git(&["checkout", "--quiet", "--", "."]));
    Some(shop)
}

/// Members by name: mode, owner, date, bytes.
fn members(archive: &Path) -> BTreeMap<String, (u32, u64, u64, Vec<u8>)> {
    let mut archive = tar::Archive::new(fs::File::open(archive).expect("an archive"));
    let mut members = BTreeMap::new();
    let mut last = String::new();
    for entry in archive.entries().expect("entries") {
        let mut entry = entry.expect("an entry");
        let name = entry.path().expect("a name").to_string_lossy().into_owned();
        assert!(last < name, "{last} before {name}");
        let header = entry.header();
        let facts = (header.mode().expect("a mode"), header.uid().expect("a number"), header.mtime().expect("a date"));
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes).expect("bytes");
        members.insert(name.clone(), (facts.0, facts.1, facts.2, bytes));
        last = name;
    }
    members
}

#[test]
fn it_holds_everything_with_its_sums() {
    let Some(shop) = committed("bundle-members") else { return };
    shop.xtask(&["bundle", "--out", "b.tar"]).expect(0);
    let members = members(&shop.root.join("b.tar"));
    let top = checkout::paths::BUNDLE_TOP;
    let text = |name: &str| String::from_utf8_lossy(&members[&format!("{top}/{name}")].3).into_owned();
    for name in ["data/fig04/stable.csv", "data/s01/main.csv", "figures/fig05-exponential-map/fig05.png", "Cargo.lock"]
    {
        assert!(members.contains_key(&format!("{top}/{name}")), "{name}: {:?}", members.keys());
    }
    assert!(text("vendor/one-1.0.0/src/lib.rs").contains("vendored"));
    assert!(text(".cargo/vendored.toml").contains("directory = \"vendor\""));
    let sums = text("SHA256SUMS");
    assert_eq!(sums.lines().count(), members.len() - 1);
    for line in sums.lines() {
        let (hash, name) = line.split_once("  ").expect("a sum");
        assert_eq!(files::write::sha256(&members[&format!("{top}/{name}")].3), hash, "{name}");
    }
    let dates: Vec<u64> = members.values().map(|member| member.2).collect();
    assert!(dates.iter().all(|date| *date == dates[0]) && dates[0] > 0);
    for (name, (mode, owner, ..)) in &members {
        assert_eq!((*mode, *owner), (if name.ends_with("tool.sh") { 0o755 } else { 0o644 }, 0), "{name}");
    }
    codecheck(&text("codecheck.yml"), &sums);
    run_crate(&text("ro-crate-metadata.json"), &sums);
    let zenodo: serde_json::Value = serde_json::from_str(&text(".zenodo.json")).expect("JSON");
    assert_eq!(zenodo["related_identifiers"][0]["identifier"], "10.1103/PhysRevE.92.042809");
    assert!(
        zenodo["notes"].as_str().is_some_and(|notes| notes.contains(text("COMMIT").lines().next().expect("a hash")))
    );
}

/// The rules of CODECHECK that hold before a check: an explicit document, a version, the paper, a manifest of files
/// that exist, each with a comment, and no placeholders.
fn codecheck(text: &str, sums: &str) {
    assert!(text.starts_with("---\n") && text.contains("version: https://codecheck.org.uk/spec/config/1.0/\n"));
    assert!(text.contains("  reference: https://doi.org/10.1103/PhysRevE.92.042809\n"));
    assert_eq!(text.matches("    - name: ").count(), 6);
    let files: Vec<&str> =
        text.lines().filter_map(|line| line.strip_prefix("  - file: \"")?.strip_suffix('"')).collect();
    assert_eq!(files.len(), text.matches("    comment: \"").count());
    assert!(files.len() > 10 && files.iter().all(|name| sums.contains(&format!("  {name}\n"))), "{files:?}");
    assert!(!["FIXME", "TODO", "XXX"].iter().any(|word| text.contains(word)));
}

/// Every file that the description names is there, and everything it points to is described.
fn run_crate(text: &str, sums: &str) {
    let json: serde_json::Value = serde_json::from_str(text).expect("JSON");
    let graph = json["@graph"].as_array().expect("a graph");
    let ids: Vec<&str> = graph.iter().filter_map(|one| one["@id"].as_str()).collect();
    for entity in graph.iter().filter(|one| one["@type"].to_string().contains("\"File\"")) {
        let name = entity["@id"].as_str().expect("a name");
        let is_there = sums.contains(&format!("  {name}\n"))
            || [publish::bundle::descriptions::MAIN_WORKFLOW, "README.md"].contains(&name);
        assert!(is_there, "{name}");
    }
    for entity in graph {
        for (key, value) in entity.as_object().expect("an entity").iter().filter(|(key, _)| *key != "@id") {
            let one = [value.clone()];
            for target in value.as_array().map_or(&one[..], Vec::as_slice).iter().filter_map(|one| one["@id"].as_str())
            {
                let is_known = ids.contains(&target) || target.starts_with("https://");
                assert!(is_known, "{}.{key} points to {target}", entity["@id"]);
            }
        }
    }
}

#[test]
fn the_bytes_depend_on_the_commit_alone() {
    let Some(shop) = committed("bundle-here") else { return };
    let first = shop.xtask(&["bundle"]).expect(0);
    let other = shop.root.with_file_name("bundle elsewhere – ü");
    let _ = fs::remove_dir_all(&other);
    let copied = Command::new("cp").arg("-R").arg(&shop.root).arg(&other).status();
    assert!(copied.is_ok_and(|status| status.success()));
    let runner = env!("CARGO_BIN_EXE_xtask");
    let script = format!("umask 077 && exec '{runner}' --root . bundle --out elsewhere.tar");
    let mut command = Command::new("sh");
    command.args(["-c", &script]).current_dir(&other).env("TZ", "Asia/Kathmandu").env("LC_ALL", "tr_TR.UTF-8");
    command
        .env("CARGO_TARGET_DIR", other.join("target"))
        .env("CARGO", other.join("cargo"))
        .env("GIT_DIR", other.join(".git"));
    // the same sources with other dates, owners' permissions and order of making
    let touched = Command::new("touch").arg("-d").arg("2001-01-01").arg(other.join("Cargo.lock")).status();
    assert!(touched.is_ok());
    let second = command.output().expect("the runner");
    assert!(second.status.success(), "{}", String::from_utf8_lossy(&second.stderr));
    let hash = |text: &str| text.lines().last().and_then(|line| line.split("  ").next()).unwrap_or("").to_owned();
    assert_eq!(hash(&first.out), hash(&String::from_utf8_lossy(&second.stdout)));
    assert_eq!(hash(&first.out).len(), 64);
}

#[test]
fn it_refuses_what_is_modified_or_stale() {
    let Some(shop) = committed("bundle-refuses") else { return };
    shop.edit("figures/fig05-exponential-map/main.rs", "A figure", "Another figure");
    let ended = shop.xtask(&["bundle"]).expect(1);
    assert!(ended.err.contains("modified, commit first: figures/fig05-exponential-map/main.rs"), "{}", ended.err);
    assert!(shop.git(&["commit", "--quiet", "--all", "-m", "another"]));
    let ended = shop.xtask(&["bundle"]).expect(3);
    assert!(ended.err.contains("stale: fig05;"), "{}", ended.err);
    assert!(!shop.has("target/bundle/jamming-transitions-reproduction.tar"));
}

#[test]
fn the_descriptions_say_what_the_citation_says() {
    let read = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    let citation = read("CITATION.cff");
    let zenodo: serde_json::Value = serde_json::from_str(&read("crates/publish/src/bundle/zenodo.json")).expect("JSON");
    let words = zenodo["keywords"].as_array().expect("keywords").iter();
    let said = words.chain([
        &zenodo["title"],
        &zenodo["creators"][0]["name"],
        &zenodo["related_identifiers"][0]["identifier"],
    ]);
    for text in said.map(|text| text.as_str().expect("a text")) {
        assert!(citation.contains(text), "{text}");
    }
    assert!(citation.contains(&format!("version: {}", env!("CARGO_PKG_VERSION"))));
    let authors = read("crates/publish/src/bundle/codecheck.yml");
    let authors: Vec<&str> = authors.lines().filter_map(|line| line.trim().strip_prefix("- name: ")).collect();
    assert_eq!(authors.len(), 6);
    for (given, family) in authors.iter().map(|name| name.trim_matches('"').split_once(' ').expect("two names")) {
        let name = format!("family-names: {family}\n      given-names: {given}\n");
        assert!(citation.contains(&name), "{given} {family}");
    }
}
