//! `test` and `ci`: scripts that fail, and scripts that cannot be tried.

use crate::shop::{Shop, blessed};

/// A checkout whose scripts all end well, but for the first.
fn shop(name: &str, first: &str) -> Shop {
    let shop = blessed(name);
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.xtask(&["bless", "--all"]).expect(0);
    shop.write("checks/spot.sh", first);
    for script in ["pedpy/run.sh", "python-door.sh", "article.sh", "browser/run.sh"] {
        shop.write(&format!("checks/{script}"), "echo \"install: ${CHECKS_INSTALL:-no}\"\n");
    }
    shop
}

#[test]
fn what_was_not_tried_is_listed_with_its_reason() {
    let shop = shop("checks-untried", "echo 'numpy is missing' >&2; exit 5\n");
    let ended = shop.xtask(&["test"]).expect(0);
    assert!(ended.out.contains("values by NumPy: numpy is missing"), "{}", ended.out);
    assert!(ended.out.contains("10 not tried here:") && ended.out.contains("install: no"), "{}", ended.out);
    // at home it is said; where nobody reads it, it fails
    let ended = shop.xtask(&["ci"]).expect(0);
    assert!(ended.out.contains("numpy is missing") && ended.out.contains("install: 1"), "{}", ended.out);
    let ended = shop.xtask_as(&["ci"], true).expect(1);
    assert!(ended.err.contains("not tried: values by NumPy: numpy is missing"), "{}", ended.err);
}

#[test]
fn a_script_that_fails_ends_the_verb() {
    let shop = shop("checks-failed", "exit 3\n");
    let ended = shop.xtask(&["test"]).expect(1);
    assert!(ended.err.contains("checks/spot.sh failed"), "{}", ended.err);
    assert!(!ended.out.contains("install:"), "{}", ended.out);
    shop.write("checks/spot.sh", "exit 0\n");
    shop.xtask(&["test"]).expect(0);
}
