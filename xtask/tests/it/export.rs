//! `export` and the other verbs whose arguments another program reads.

use crate::shop::Shop;

#[test]
fn arguments_are_passed_on_with_the_checkout() {
    let shop = Shop::new("export");
    shop.xtask(&["export", "fig:jams", "--out", "mine", "--fps", "29.97"]).expect(0);
    let words = shop.read("exported.txt");
    let words: Vec<&str> = words.lines().collect();
    assert!(
        words[0].starts_with("--root=") && words[1..] == ["fig:jams", "--out", "mine", "--fps", "29.97"],
        "{words:?}"
    );
    let calls = shop.calls();
    assert!(["cargo", "export"].iter().all(|name| calls.iter().any(|call| call == name)), "{calls:?}");
}

#[test]
fn what_writes_the_files_is_no_source_of_figures() {
    let shop = crate::shop::blessed("export-source");
    for name in ["interchange", "verify", "claims", "publish", "measure", "checkout"] {
        shop.write(&format!("crates/{name}/src/lib.rs"), "//! About the result.\n");
    }
    shop.xtask(&["status", "--exit-code"]).expect(0);
}
