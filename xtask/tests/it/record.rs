//! Why a figure is stale.

use std::collections::BTreeMap;
use xtask::record::{Record, reasons};

fn named(pairs: &[(&str, &str)]) -> BTreeMap<String, String> {
    pairs.iter().map(|(name, hash)| ((*name).to_owned(), (*hash).to_owned())).collect()
}

#[test]
fn a_figure_never_made_is_stale() {
    assert_eq!(reasons(None, &named(&[]), &named(&[])), ["has not been made here yet"]);
}

#[test]
fn an_unchanged_figure_is_fresh() {
    let (inputs, outputs) = (named(&[("crates/a.rs", "1")]), named(&[("data/fig04/a.csv", "2")]));
    assert!(reasons(Some(&Record::new(inputs.clone(), outputs.clone(), String::new())), &inputs, &outputs).is_empty());
}

#[test]
fn every_change_is_named() {
    let inputs = named(&[
        ("crate gone", "1.0.0"),
        ("crate png", "0.18.0"),
        ("key panel.stable.law.mu", "0.45"),
        ("rustc", "rustc 1.95.0"),
        ("crates/a.rs", "1"),
        ("data/reference/x.csv", "1"),
        ("figures/fig04-a/scene.toml", "1"),
        ("run main", "1"),
    ]);
    let outputs = named(&[("data/fig04/a.csv", "1"), ("data/fig04/b.csv", "1")]);
    let now = named(&[
        ("crate png", "0.18.1"),
        ("key panel.stable.law.mu", "0.46"),
        ("rustc", "rustc 1.96.0"),
        ("crates/b.rs", "1"),
        ("data/reference/x.csv", "2"),
        ("figures/fig04-a/scene.toml", "2"),
        ("run main", "2"),
    ]);
    let made = named(&[("data/fig04/b.csv", "2"), ("data/fig04/c.csv", "1")]);
    let found = reasons(Some(&Record::new(inputs, outputs, String::new())), &now, &made);
    assert_eq!(
        found,
        [
            "crate gone is gone: 1.0.0",
            "crate png changed: 0.18.0 -> 0.18.1",
            "source crates/a.rs is gone",
            "source crates/b.rs is new",
            "reference data/reference/x.csv changed",
            "scene figures/fig04-a/scene.toml changed",
            "scene key panel.stable.law.mu changed: 0.45 -> 0.46",
            "key of run main changed",
            "toolchain rustc changed: rustc 1.95.0 -> rustc 1.96.0",
            "output data/fig04/a.csv is missing",
            "output data/fig04/b.csv was edited",
            "output data/fig04/c.csv was not made by the figure",
        ]
    );
}
