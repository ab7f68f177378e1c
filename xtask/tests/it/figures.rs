//! `figures`, `status`, `verify`, `bless` and `clean` on a whole checkout.

use crate::shop::{Shop, blessed};

#[test]
fn a_shared_run_is_integrated_once() {
    let shop = Shop::new("figures-shared");
    shop.xtask(&["figures"]).expect(1);
    let expected = [
        "cargo",
        "fig04-growth",
        "fig05-exponential-map",
        "fig06-exponential-sway",
        "fig11-trajectories",
        "fig12-speeds",
        "simulate main",
        "simulate main check",
        "simulate stable",
        "simulate stable check",
        "simulate unstable",
        "simulate unstable check",
    ];
    assert_eq!(shop.calls(), expected);
}

#[test]
fn a_second_run_starts_nothing() {
    let shop = blessed("figures-second");
    let manifest = shop.read("data/manifest.json");
    let ended = shop.xtask(&["figures"]).expect(0);
    assert!(
        ended.out.contains("cached") && ended.out.contains("open README.md for the table of figures"),
        "{}",
        ended.out
    );
    assert!(shop.calls().is_empty());
    assert_eq!(shop.read("data/manifest.json"), manifest);
    shop.xtask(&["status", "--exit-code"]).expect(0);
}

#[test]
fn the_manifest_holds_counts_and_errors() {
    let shop = blessed("figures-manifest");
    let manifest: serde_json::Value = serde_json::from_str(&shop.read("data/manifest.json")).expect("JSON");
    let curve = &manifest["outputs"]["data/fig04/stable.csv"];
    assert_eq!((curve["method"].as_str(), curve["steps"].as_i64()), (Some("dop853"), Some(10)));
    assert_eq!((curve["tolerance"].as_f64(), curve["seconds"].as_f64()), (Some(1e-11), None));
    // std goes from 0 to 2 and the check is 1e-9 away, up to the rounding of 2 + 1e-9
    let error = curve["error"]["std"].as_f64().expect("an error");
    assert!((error - 0.5e-9).abs() < f64::EPSILON, "{error}");
    assert_eq!(manifest["outputs"]["data/fig05/left.csv"]["error"]["phi"].as_f64(), Some(1e-16));
    assert!(manifest["outputs"]["figures/fig11-trajectories/fig11.png"]["sha256"].is_string());
}

#[test]
fn events_stand_once_for_each_run_under_the_first_figure() {
    let shop = blessed("figures-events");
    let text = shop.read("data/events.csv");
    let scenes: Vec<&str> = text.lines().skip(1).filter_map(|line| line.split(',').next()).collect();
    assert_eq!(scenes, ["fig04-stable", "fig04-unstable", "fig11-main"]);
    shop.xtask(&["figures", "12", "--force"]).expect(0);
    assert_eq!(shop.read("data/events.csv"), text);
}

#[test]
fn a_changed_scene_makes_one_figure_stale() {
    let shop = blessed("figures-scene");
    shop.edit("figures/fig04-growth/scene.toml", "mu = 0.5", "mu = 0.6");
    let ended = shop.xtask(&["status", "--exit-code"]).expect(3);
    assert!(
        ended.out.contains("scene figures/fig04-growth/scene.toml changed; scene key panel.unstable.law.mu changed: 0.5 -> 0.6; key of run"),
        "{}",
        ended.out
    );
    assert_eq!(ended.out.matches("stale").count(), 1);
    let ended = shop.xtask(&["explain", "growth"]).expect(0);
    assert!(ended.out.contains("rebuild: cargo xtask figures fig04"), "{}", ended.out);
    shop.xtask(&["figures"]).expect(0);
    assert_eq!(shop.calls(), ["cargo", "fig04-growth", "simulate unstable", "simulate unstable check"]);
}

#[test]
fn a_changed_style_simulates_nothing() {
    let shop = blessed("figures-style");
    shop.edit("crates/plot/src/lib.rs", "Pictures", "Better pictures");
    shop.xtask(&["figures", "fig04"]).expect(0);
    assert_eq!(shop.calls(), ["cargo", "fig04-growth"]);
}

#[test]
fn an_edited_or_lost_output_is_made_again() {
    let shop = blessed("figures-output");
    shop.write("data/fig05/left.csv", "a,phi\n0,0\n");
    shop.write("data/fig06/old.csv", "a,phi\n0,0\n");
    std::fs::remove_file(shop.root.join("figures/fig12-speeds/fig12.svg")).expect("a picture");
    let ended = shop.xtask(&["status"]).expect(0);
    for why in ["output data/fig05/left.csv was edited", "data/fig06/old.csv was not made by", "fig12.svg is missing"] {
        assert!(ended.out.contains(why), "{why}: {}", ended.out);
    }
    shop.xtask(&["figures"]).expect(0);
    assert_eq!(shop.calls(), ["fig05-exponential-map", "fig06-exponential-sway", "fig12-speeds"]);
    assert!(!shop.has("data/fig06/old.csv"));
}

#[test]
fn a_damaged_stored_run_is_integrated_again() {
    let shop = blessed("figures-store");
    let store = shop.root.join("target/store");
    for entry in std::fs::read_dir(&store).expect("a store") {
        let folder = entry.expect("a run").path();
        std::fs::write(folder.join("std.csv"), "t,std\n0,1\n").expect("a table");
    }
    shop.edit("crates/plot/src/lib.rs", "Pictures", "Better pictures");
    shop.xtask(&["figures", "12"]).expect(0);
    assert_eq!(shop.calls(), ["cargo", "fig12-speeds", "simulate main", "simulate main check"]);
}

#[test]
fn other_numbers_differ_until_they_are_accepted() {
    let shop = blessed("figures-differ");
    let before = shop.read("data/SHA256SUMS");
    shop.edit("figures/fig05-exponential-map/scene.toml", "fig05-exponential-map", "another title");
    let ended = shop.xtask(&["figures"]).expect(1);
    assert!(ended.err.contains("differs: data/fig05/left.csv"), "{}", ended.err);
    let ended = shop.xtask(&["bless"]).expect(1);
    assert!(ended.out.contains("left.csv: 1 cells differ; largest absolute 8.00e0 (row 0, phi)"), "{}", ended.out);
    assert_eq!(shop.read("data/SHA256SUMS"), before);
    shop.xtask(&["bless", "--numbers"]).expect(0);
    shop.xtask(&["figures"]).expect(0);
}

#[test]
fn stale_figures_are_not_accepted() {
    let shop = blessed("figures-stale");
    shop.edit("figures/fig04-growth/main.rs", "A figure", "Another figure");
    let ended = shop.xtask(&["bless"]).expect(3);
    assert!(ended.err.contains("stale: fig04;"), "{}", ended.err);
}

#[test]
fn verify_judges_bytes_and_numbers_and_leaves_no_scratch() {
    let shop = blessed("figures-verify");
    shop.xtask(&["verify"]).expect(0);
    let leftover = || {
        std::fs::read_dir(shop.root.join("target"))
            .expect("target")
            .flatten()
            .any(|entry| entry.file_name().to_string_lossy().starts_with("verify-"))
    };
    assert!(!leftover());
    shop.edit("data/golden/fig04/stable.csv", "\n3,0.0\n", "\n3,0.5\n");
    let json = shop.xtask(&["verify", "fig04", "--json"]).expect(1).json();
    let figure = &json["figures"][0];
    assert_eq!((&figure["bytes"]["verdict"], &figure["numbers"]["verdict"]), (&"same".into(), &"differs".into()));
    let worst = &figure["numbers"]["tables"]["stable.csv"]["absolute"];
    assert_eq!((worst["row"].as_i64(), worst["column"].as_str()), (Some(3), Some("std")));
    assert!(leftover());
    shop.xtask(&["clean"]).expect(0);
    assert!(!leftover());
}

#[test]
fn the_papers_scheme_has_a_place_of_its_own() {
    let shop = blessed("figures-scheme");
    let picture = shop.bytes("figures/fig04-growth/fig04.png");
    shop.write("figures/fig04-growth/fig04.png", "edited");
    shop.xtask(&["figures", "--scheme", "paper"]).expect(1);
    let expected = [
        "fig04-growth",
        "fig11-trajectories",
        "fig12-speeds",
        "simulate main scheme",
        "simulate stable scheme",
        "simulate unstable scheme",
    ];
    assert_eq!(shop.calls(), expected);
    assert_eq!(shop.read("figures/fig04-growth/fig04.png"), "edited");
    assert_eq!(shop.bytes("data/paper-scheme/fig04/fig04.png"), picture);
    shop.xtask(&["bless", "--scheme", "paper"]).expect(0);
    shop.xtask(&["figures", "--scheme", "paper"]).expect(0);
    assert!(shop.read("data/paper-scheme/SHA256SUMS").contains("  data/paper-scheme/fig04/stable.csv\n"));
    let ended = shop.xtask(&["figures", "--scheme", "paper", "5"]).expect(2);
    assert!(ended.err.contains("valid: fig04 fig11 fig12"), "{}", ended.err);
}

#[test]
fn a_failing_figure_gives_its_words_and_code() {
    let shop = blessed("figures-fail");
    for (title, code) in [("exit 101", 4), ("exit 2", 2), ("exit 5", 5)] {
        let scene = format!("title = \"{title}\"\n[map]\nvalue = \"criterion\"\n");
        shop.write("figures/fig05-exponential-map/scene.toml", &scene);
        let ended = shop.xtask(&["figures", "--keep-going"]).expect(code);
        assert!(ended.err.contains("no space left on device"), "{}", ended.err);
        assert!(ended.out.contains("failed"), "{}", ended.out);
        assert!(shop.has("data/fig06/left.csv"));
    }
}

#[test]
fn supplements_have_sums_of_their_own() {
    let shop = blessed("figures-supplements");
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.xtask(&["bless", "s01"]).expect(0);
    shop.xtask(&["figures", "--all"]).expect(0);
    assert!(!shop.read("data/SHA256SUMS").contains("s01"));
    assert!(shop.read("data/SHA256SUMS-supplements").contains("  data/s01/main.csv\n"));
    let manifest = shop.read("data/manifest.json");
    shop.xtask(&["figures"]).expect(0);
    assert_eq!(shop.read("data/manifest.json"), manifest);
}

#[test]
fn a_dry_run_starts_nothing() {
    let shop = blessed("figures-dry");
    shop.edit("figures/fig04-growth/scene.toml", "mu = 0.5", "mu = 0.6");
    let ended = shop.xtask(&["figures", "--dry-run"]).expect(0);
    assert!(ended.out.contains("fig04 run unstable"), "{}", ended.out);
    assert!(shop.calls().is_empty());
}

#[test]
fn clean_leaves_what_is_committed() {
    let shop = blessed("figures-clean");
    shop.xtask(&["clean"]).expect(0);
    assert!(!shop.has("data/fig04") && !shop.has("target/store"));
    for kept in
        ["data/SHA256SUMS", "data/golden/fig04/stable.csv", "data/manifest.json", "figures/fig04-growth/fig04.png"]
    {
        assert!(shop.has(kept), "{kept}");
    }
    shop.xtask(&["figures"]).expect(0);
}

#[test]
fn a_list_entry_without_a_figure_is_told() {
    let shop = blessed("figures-stray");
    let stray = format!("{}{}  data/fig99/left.csv\n", shop.read("data/SHA256SUMS"), "0".repeat(64));
    shop.write("data/SHA256SUMS", &stray);
    let ended = shop.xtask(&["figures"]).expect(1);
    assert!(ended.err.contains("belongs to no figure: data/fig99/left.csv"), "{}", ended.err);
}

#[test]
fn modified_sources_are_not_accepted() {
    let shop = blessed("figures-dirty");
    if !shop.git(&["init", "--quiet"]) {
        eprintln!("skipped: no git");
        return;
    }
    shop.write(".gitignore", "/target\n/cargo\n/calls.log\n/data/fig*/\n");
    assert!(shop.git(&["add", "--all"]) && shop.git(&["commit", "--quiet", "-m", "all"]));
    shop.write("figures/fig04-growth/fig04.svg", "an output may differ");
    shop.xtask(&["figures", "4"]).expect(0);
    shop.xtask(&["bless"]).expect(0);
    shop.edit("figures/fig04-growth/main.rs", "A figure", "Another figure");
    let ended = shop.xtask(&["bless"]).expect(1);
    assert!(ended.err.contains("modified, commit first: figures/fig04-growth/main.rs"), "{}", ended.err);
}
