//! `export`: which scene is run, how it is sampled, what is passed on, what is left.

use crate::shop::{Shop, temporary};

/// What the stand-in for `export` was called with, a word a line.
fn words(shop: &Shop) -> Vec<String> {
    shop.read("exported.txt").lines().map(str::to_owned).collect()
}

/// The word after an option.
fn value<'a>(words: &'a [String], option: &str) -> Option<&'a str> {
    let at = words.iter().position(|word| word == option)?;
    words.get(at + 1).map(String::as_str)
}

#[test]
fn a_figure_is_sampled_at_every_frame() {
    let shop = Shop::new("export-figure");
    shop.xtask(&["export", "fig:jams", "--out", "mine"]).expect(0);
    let words = words(&shop);
    assert!(value(&words, "--scene").is_some_and(|scene| scene.ends_with("figures/fig11-trajectories/scene.toml")));
    assert_eq!(["--tau", "--fps", "--out"].map(|name| value(&words, name)), [Some("0.5"), Some("8.0"), Some("mine")]);
    assert_eq!(["--a0", "--panel", "--format"].map(|name| value(&words, name)), [None; 3]);
    // the run lay in a folder of its own, which is gone
    let table = value(&words, "--table").expect("a table");
    assert!(table.ends_with("trajectories.csv") && !std::path::Path::new(table).exists(), "{table}");
    assert!(temporary(&shop.root).is_empty(), "{:?}", temporary(&shop.root));
    let calls = shop.calls();
    assert!(["cargo", "export", "simulate"].iter().all(|name| calls.iter().any(|call| call == name)), "{calls:?}");
}

#[test]
fn a_scene_of_ones_own_with_every_option() {
    let shop = Shop::new("export-scene");
    shop.write("ring.toml", "title = \"ring\"\n[run]\n");
    let options = ["--a0", "0.3", "--tau", "0.8", "--fps", "29.97", "--panel", "left", "--format", "pedpy"];
    shop.xtask(&[&["export", "ring.toml", "--out", "mine"][..], &options].concat()).expect(0);
    let words = words(&shop);
    assert_eq!(value(&words, "--scene"), Some("ring.toml"));
    for pair in options.chunks(2) {
        assert_eq!(value(&words, pair[0]), Some(pair[1]));
    }
}

/// Figures of deviations keep no trajectories; the stand-in for `simulate` leaves no table for a scene that says so.
#[test]
fn a_scene_that_keeps_only_deviations_is_run_with_trajectories() {
    let shop = Shop::new("export-std");
    let panels = "[panel.left.law]\nmu = 0.4\n[panel.right.law]\nmu = 0.5\n";
    shop.write("std.toml", &format!("title = \"std\"\n[run]\nrecord = \"std\"\nt_end = 2\n{panels}"));
    shop.xtask(&["export", "std.toml", "--panel", "right", "--out", "mine"]).expect(0);
    let words = words(&shop);
    assert_eq!([value(&words, "--scene"), value(&words, "--panel")], [Some("std.toml"), Some("right")]);
    assert_eq!(shop.read("scene-run.txt"), "law.mu = 0.5\nrun.record = \"trajectories\"\nrun.t_end = 2.0");
}

#[test]
fn what_cannot_be_exported_is_bad_input() {
    let shop = Shop::new("export-refused");
    shop.write("broken.toml", "[run\n");
    for (arguments, told) in [
        (&["nothing.toml"][..], "nothing.toml"),
        (&["broken.toml"], "broken.toml:1"),
        (&["fig77"], "no figure fig77"),
        (&["fig11", "--fps", "0.9"], "0.9: must be a number from 1 to 1000"),
        (&["fig11", "--tau", "0"], "0: must be a number above 0"),
        (&["fig11", "--a0", "-1"], "-1: must be a number above 0"),
        (&["fig11", "--format", "csv"], "possible values: pedpy, jupedsim"),
    ] {
        let ended = shop.xtask(&[&["export", "--out", "mine"][..], arguments].concat()).expect(2);
        assert!(ended.err.contains(told), "{}", ended.err);
        assert!(!shop.has("exported.txt") && temporary(&shop.root).is_empty());
    }
}

#[test]
fn what_writes_the_files_is_no_source_of_figures() {
    let shop = crate::shop::blessed("export-source");
    shop.write("crates/interchange/src/lib.rs", "//! Files.\n");
    shop.xtask(&["status", "--exit-code"]).expect(0);
}

#[test]
fn too_many_frames_are_told_in_the_words_of_the_command() {
    let shop = Shop::new("export-frames");
    shop.write("ring.toml", "title = \"ring\"\n[ring]\npedestrians = 133\n[run]\nt_end = 3000\n");
    let ended = shop.xtask(&["export", "ring.toml", "--out", "mine", "--fps", "120"]).expect(2);
    for word in ["--fps 120", "133", "2e7", "100.25", "--t-end"] {
        assert!(ended.err.contains(word), "{word}: {}", ended.err);
    }
    assert!(!ended.err.contains("sample"), "{}", ended.err);
    shop.xtask(&["export", "ring.toml", "--out", "mine", "--fps", "120", "--t-end", "2000"]).expect(0);
}
