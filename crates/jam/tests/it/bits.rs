//! The bits of every law, compiled and as a formula: the same for both, and those of every other machine.

use crate::fingerprints::table;
use std::collections::BTreeMap;
use std::path::Path;

/// Set to write the list anew.
const RENEW: &str = "RENEW_BITS";

#[test]
fn laws_have_the_bits_that_are_listed() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bits.csv");
    let now = table();
    if std::env::var_os(RENEW).is_some() {
        std::fs::write(&file, &now).expect("written");
    }
    let listed = std::fs::read_to_string(&file).expect("the list").replace("\r\n", "\n");
    let differences: Vec<&str> = now.lines().filter(|line| !listed.lines().any(|other| other == *line)).collect();
    assert!(
        differences.is_empty() && now.lines().count() == listed.lines().count(),
        "other bits than in tests/bits.csv: {differences:#?}; if that is meant: {RENEW}=1 cargo test -p jamming --test it bits"
    );
}

#[test]
fn a_law_and_its_formula_have_the_same_bits_whatever_is_asked_of_them() {
    let text = table();
    let lines: BTreeMap<&str, &str> = text.lines().filter_map(|line| line.split_once(',')).collect();
    let mut pairs = 0;
    for (name, bits) in &lines {
        if let Some(formula) = lines.get(format!("{name}-formula").as_str()) {
            assert_eq!(bits, formula, "{name}");
            pairs += 1;
        }
    }
    let formulas = lines.keys().filter(|name| name.ends_with("-formula")).count();
    assert!(pairs == formulas && pairs >= 22, "{pairs} pairs of {formulas} formulas");
}
