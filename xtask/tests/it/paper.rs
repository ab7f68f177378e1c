//! Conditions under which the article is refused.

use crate::shop::blessed;
use std::fs;

#[test]
fn the_document_is_refused_unless_the_figures_verify() {
    let shop = blessed("paper-gate");
    // it goes on to the typesetter, whose pins this checkout lacks
    let ended = shop.xtask(&["paper"]).expect(5);
    assert!(ended.err.contains("no typesetter") && ended.err.contains("install typst"), "{}", ended.err);
    let table = shop.read("data/fig05/left.csv");
    shop.write("data/fig05/left.csv", "a,phi\n0,7\n");
    let ended = shop.xtask(&["paper"]).expect(1);
    assert!(ended.err.contains("do not verify") && ended.err.contains("data/fig05/left.csv differs"), "{}", ended.err);
    shop.write("data/fig05/left.csv", &table);
    fs::remove_file(shop.root.join("figures/fig06-exponential-sway/fig06.svg")).expect("a picture");
    let ended = shop.xtask(&["paper"]).expect(1);
    assert!(ended.err.contains("fig06.svg missing"), "{}", ended.err);
    shop.xtask(&["figures", "6"]).expect(0);
    shop.edit("figures/fig04-growth/scene.toml", "mu = 0.5", "mu = 0.6");
    let ended = shop.xtask(&["paper"]).expect(3);
    assert!(ended.err.contains("do not verify, stale") && ended.err.contains("fig04"), "{}", ended.err);
}

#[test]
fn an_edited_picture_of_a_supplement_is_refused_too() {
    let shop = blessed("paper-gate-supplement");
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.xtask(&["bless", "--all"]).expect(0);
    assert!(!shop.xtask(&["paper"]).expect(5).err.contains("do not verify"));
    shop.write("figures/s01-variant/s01.svg", "<svg>another</svg>");
    let ended = shop.xtask(&["paper"]).expect(1);
    assert!(ended.err.contains("s01.svg differs"), "{}", ended.err);
}
