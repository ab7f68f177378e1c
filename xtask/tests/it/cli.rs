//! The command line: bad input, exit codes, JSON.

use crate::shop::Shop;
use checkout::paths::Paths;
use std::time::Duration;
use xtask::lock::Lock;

#[test]
fn an_unknown_verb_is_a_usage_error() {
    Shop::new("cli-verb").xtask(&["figurines"]).expect(2);
}

#[test]
fn an_unknown_figure_is_a_usage_error_everywhere() {
    let shop = Shop::new("cli-id");
    for verb in ["figures", "verify", "status", "list", "bless"] {
        let ended = shop.xtask(&[verb, "fig99"]).expect(2);
        assert!(ended.err.contains("no figure fig99") && ended.err.contains("valid: fig04 fig05"), "{}", ended.err);
        assert!(ended.out.is_empty(), "{verb}: {}", ended.out);
    }
    assert!(shop.calls().is_empty());
}

#[test]
fn a_malformed_list_of_sums_is_told_before_any_work() {
    let shop = Shop::new("cli-sums");
    shop.write("data/SHA256SUMS", "no sums\n");
    for verb in ["figures", "verify"] {
        let ended = shop.xtask(&[verb]).expect(2);
        assert!(ended.err.contains("data/SHA256SUMS:1:"), "{}", ended.err);
    }
    assert!(shop.calls().is_empty());
}

#[test]
fn a_manifest_that_cannot_be_read_is_told_before_any_work_and_kept() {
    let shop = Shop::new("cli-manifest");
    for text in ["{\"schema_version\": 1, \"outp", "{\"schema_version\": 2, \"outputs\": {}}"] {
        shop.write("data/manifest.json", text);
        let ended = shop.xtask(&["figures"]).expect(2);
        assert!(ended.err.contains("data/manifest.json: ") && ended.err.contains("delete it"), "{}", ended.err);
        assert_eq!(shop.read("data/manifest.json"), text);
    }
    assert!(shop.calls().is_empty());
}

#[test]
fn a_scene_that_cannot_be_read_is_named_with_its_line() {
    let shop = Shop::new("cli-scene");
    shop.write("figures/fig05-exponential-map/scene.toml", "title = \"x\"\ncolour = 3\n");
    let ended = shop.xtask(&["figures", "5"]).expect(2);
    assert!(ended.err.contains("figures/fig05-exponential-map/scene.toml:2: colour"), "{}", ended.err);
    shop.xtask(&["figures", "6"]).expect(1);
}

#[test]
fn no_jobs_at_a_time_are_refused() {
    Shop::new("cli-jobs").xtask(&["figures", "--jobs", "0"]).expect(2);
}

#[test]
fn missing_fonts_are_an_unsupported_environment() {
    let shop = Shop::new("cli-fonts");
    std::fs::remove_file(shop.root.join("crates/plot/fonts/LibertinusSerif-Italic.otf")).expect("a font");
    let ended = shop.xtask(&["figures"]).expect(5);
    assert!(ended.err.contains("LibertinusSerif-Italic.otf: no such font"), "{}", ended.err);
    shop.xtask(&["doctor"]).expect(5);
}

#[test]
fn a_damaged_font_is_named_before_anything_is_built() {
    let shop = Shop::new("cli-font-damaged");
    shop.write("crates/plot/fonts/LibertinusSerif-Regular.otf", "half a font");
    let ended = shop.xtask(&["figures"]).expect(5);
    assert!(ended.err.contains("LibertinusSerif-Regular.otf: damaged font"), "{}", ended.err);
    assert!(shop.calls().is_empty());
    shop.xtask(&["doctor"]).expect(5);
}

#[test]
fn a_missing_cargo_is_an_unsupported_environment() {
    let shop = Shop::new("cli-cargo");
    std::fs::remove_file(shop.root.join("cargo")).expect("a stand-in");
    shop.xtask(&["figures"]).expect(5);
}

#[test]
fn arguments_of_simulate_and_its_exit_code_are_passed_on() {
    let shop = Shop::new("cli-forward");
    shop.xtask(&["simulate", "--help"]).expect(0);
    shop.xtask(&["map", "scene.toml", "--json"]).expect(3);
    assert_eq!(shop.calls(), ["cargo", "map", "simulate"]);
}

#[test]
fn json_goes_alone_to_stdout_and_has_a_version() {
    let shop = Shop::new("cli-json");
    for arguments in [
        &["list", "--json"][..],
        &["status", "--json"],
        &["explain", "4", "--json"],
        &["describe", "--json"],
        &["figures", "--dry-run", "--json"],
    ] {
        assert_eq!(shop.xtask(arguments).expect(0).json()["schema_version"], 1, "{arguments:?}");
    }
    let ended = shop.xtask(&["figures", "--json"]).expect(1);
    assert_eq!(ended.json()["schema_version"], 1);
    assert_eq!(ended.json()["figures"][0]["state"], "new");
    assert!(ended.err.contains("data/SHA256SUMS does not exist yet"), "{}", ended.err);
}

#[test]
fn a_build_that_fails_is_a_failure() {
    let shop = Shop::new("cli-build");
    shop.edit("crates/math/src/lib.rs", "Numbers", "broken");
    let ended = shop.xtask(&["figures"]).expect(4);
    assert!(ended.err.contains("cargo build --release --locked -p figures: exit code 101"), "{}", ended.err);
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let shop = Shop::new("cli-unwritable");
    shop.write("target", "a file where a folder is needed");
    let ended = shop.xtask(&["figures"]).expect(4);
    assert!(ended.err.contains("target/xtask: "), "{}", ended.err);
}

#[test]
fn a_second_run_waits_for_the_first_and_says_so() {
    let shop = Shop::new("cli-lock");
    let mut paths = Paths::find(Some(shop.root.clone())).expect("a root");
    paths.target = shop.root.join("target");
    let lock = Lock::take(&paths).expect("a lock");
    std::thread::scope(|scope| {
        let second = scope.spawn(|| shop.xtask(&["clean"]));
        std::thread::sleep(Duration::from_millis(500));
        assert!(!second.is_finished());
        drop(lock);
        let ended = second.join().expect("the second run ends").expect(0);
        assert!(ended.err.contains("waiting for another cargo xtask"), "{}", ended.err);
    });
}
