//! `bless`: what it shows before it writes, and what it refuses.

use crate::shop::{Shop, blessed};

/// A checkout under git, everything committed.
fn committed(name: &str) -> Option<Shop> {
    let shop = blessed(name);
    shop.write(".gitignore", "/target\n/cargo\n/calls.log\n/spoil\n/data/fig*/\n");
    let done =
        shop.git(&["init", "--quiet"]) && shop.git(&["add", "--all"]) && shop.git(&["commit", "--quiet", "-m", "all"]);
    if !done {
        eprintln!("skipped: no git");
    }
    done.then_some(shop)
}

#[test]
fn what_changes_is_shown_on_each_level_before_anything_is_written() {
    let Some(shop) = committed("bless-levels") else { return };
    let sums = shop.read("data/SHA256SUMS");
    shop.write("spoil", "fig04 ulp 3999\nfig05 colours\nfig06 svg\nsimulate event\nsimulate state 15\n");
    shop.xtask(&["figures", "--force"]).expect(1);
    let ended = shop.xtask(&["bless"]).expect(1);
    for words in [
        "fig04: other physics: beyond tolerance\n  differs: data/fig04/stable.csv",
        "  stable.csv: 1 cells differ",
        "(row 3999, t = 3999, std), relative",
        "  data/events.csv: fig04-stable, overlap at pedestrian 7: expected t = 12.5, found 12.500000000000002",
        "  run fig04-stable parts after t = 10; at t = 20 1 of 3 pedestrians differ: 1",
        "fig05: same data, other rendering\n",
        "fig05.png: 16 pixels changed within x 0 to 15, y 3 to 3, by at most 180 of 255",
        "fig06.svg: text differs from byte 5 on",
    ] {
        assert!(ended.out.contains(words), "{words}: {}", ended.out);
    }
    assert!(ended.err.contains("numbers moved: fig04 fig11 fig12"), "{}", ended.err);
    assert_eq!(shop.read("data/SHA256SUMS"), sums);
    shop.xtask(&["bless", "--numbers"]).expect(0);
    shop.xtask(&["verify"]).expect(0);
}

#[test]
fn another_rendering_needs_no_leave() {
    let Some(shop) = committed("bless-rendering") else { return };
    shop.write("spoil", "fig05 colours\n");
    shop.xtask(&["figures", "5", "--force"]).expect(1);
    shop.xtask(&["bless"]).expect(0);
    shop.xtask(&["verify"]).expect(0);
}

#[test]
fn a_modified_file_that_is_no_output_is_refused() {
    let Some(shop) = committed("bless-dirty") else { return };
    // what the runner writes may differ
    for name in ["data/events.csv", "data/golden/fig04/stable.csv", "figures/fig05-exponential-map/fig05.svg"] {
        let text = shop.read(name);
        shop.write(name, &format!("{text} "));
        assert!(!shop.xtask(&["bless"]).err.contains("modified, commit first"), "{name}");
        shop.write(name, &text);
    }
    for name in ["crates/math/src/lib.rs", "figures/fig04-growth/scene.toml", ".gitignore"] {
        let text = shop.read(name);
        shop.write(name, &format!("{text}\n"));
        let ended = shop.xtask(&["bless"]).expect(1);
        assert!(ended.err.contains(&format!("modified, commit first: {name}")), "{}", ended.err);
        shop.write(name, &text);
    }
    shop.xtask(&["bless"]).expect(0);
}
