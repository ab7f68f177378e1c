//! The verb `accuracy`, from its first run to a damaged table.

use crate::shop::Shop;

#[test]
fn tables_are_accepted_once_and_compared_from_then_on() {
    let shop = Shop::new("accuracy");
    let first = shop.xtask(&["accuracy"]).expect(1);
    assert!(first.err.contains("differs: data/accuracy/hard.csv: not committed"), "{}", first.err);
    assert!(!shop.has("data/accuracy/hard.csv"));
    shop.xtask(&["accuracy", "--bless"]).expect(0);
    let again = shop.xtask(&["accuracy"]).expect(0);
    assert!(again.out.contains("8 of 8 tables as committed"), "{}", again.out);
    let json = shop.xtask(&["accuracy", "--json"]).expect(0).json();
    assert_eq!(json["scenes"][0]["cheapest"][0]["right_hand_sides"]["method"], "dop853");
    shop.xtask(&["accuracy", "--quick"]).expect(0);
    shop.xtask(&["accuracy", "--full"]).expect(0);
    shop.xtask(&["accuracy", "--quick", "--bless"]).expect(2);
}

#[test]
fn a_changed_table_is_told_with_its_first_line() {
    let shop = Shop::new("accuracy-changed");
    shop.xtask(&["accuracy", "--bless"]).expect(0);
    shop.edit("data/accuracy/hard.csv", "30,", "31,");
    let ended = shop.xtask(&["accuracy", "--quick"]).expect(1);
    assert!(ended.err.contains("data/accuracy/hard.csv"), "{}", ended.err);
    shop.xtask(&["accuracy", "--bless"]).expect(0);
    shop.xtask(&["accuracy"]).expect(0);
}
