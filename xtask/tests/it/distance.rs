//! The paper's scheme against the accurate tables and the published points.

use crate::shop::Shop;
use verify::distance::COLUMNS;

/// A checkout with hand-made tables of both schemes for figures 11 and 12, made by both.
fn shop(name: &str) -> Shop {
    let shop = Shop::new(name);
    shop.xtask(&["figures", "12"]).expect(1);
    shop.xtask(&["figures", "--scheme", "paper", "12"]).expect(1);
    shop
}

#[test]
fn the_largest_differences_and_their_places_are_told() {
    let shop = shop("distance");
    // where the absolute difference is largest the relative one is not
    shop.write("data/fig12/t300.csv", "n,v\n0,8\n1,2\n2,1\n3,0\n");
    shop.write("data/paper-scheme/fig12/t300.csv", "n,v\n0,8\n1,3\n2,1.75\n4,9\n");
    shop.write("data/reference/published_speed_t300.csv", "n,v\n0.9994,2.5\n2.0012,1.25\n7,1\n");
    let ended = shop.xtask(&["figures", "--scheme", "paper", "11"]).expect(1);
    let text = shop.read("data/paper-scheme/distance.csv");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], COLUMNS.join(","));
    assert!(lines.contains(&"fig12,t300,v,3,1,,1,3,2,0.75,,2,2,0.5,0.5"), "{text}");
    assert!(ended.out.contains("fig12/t300"), "{}", ended.out);
}

#[test]
fn equal_tables_are_at_no_distance() {
    let shop = shop("distance-none");
    let text = shop.read("data/paper-scheme/distance.csv");
    assert!(text.contains("\nfig12,main,std,5000,0,,,0,0,0,,,,,\n"), "{text}");
}

#[test]
fn without_accurate_tables_nothing_is_compared() {
    let shop = Shop::new("distance-alone");
    let ended = shop.xtask(&["figures", "--scheme", "paper", "12"]).expect(1);
    assert!(ended.err.contains("cargo xtask figures makes the tables"), "{}", ended.err);
    assert!(!shop.has("data/paper-scheme/distance.csv"));
}
