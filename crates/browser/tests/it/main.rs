//! Tests of the browser crate.

use browser::{FIGURES, Tables, exports};
use files::recipe;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_panel_has_a_table() -> Result<(), Box<dyn std::error::Error>> {
    for figure in FIGURES.iter().filter(|figure| figure.id != "fig01") {
        let recipe = recipe::parse(figure.id, figure.scene)?;
        let panels: BTreeSet<&str> = recipe.panels.iter().map(|panel| panel.name.as_str()).collect();
        let used: BTreeSet<&str> = figure.tables.iter().map(|entry| entry.panel).collect();
        assert_eq!(panels, used, "{}", figure.id);
    }
    Ok(())
}

/// Figures whose tables take little time without optimisation; the others are computed under Node by
/// `checks/other-machines.sh`.
const CHEAP: [&str; 6] = ["fig02", "fig04", "fig05", "fig07", "fig08", "fig10"];

#[test]
fn sums_are_those_of_the_figures() -> Result<(), Box<dyn std::error::Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/SHA256SUMS");
    if !file.exists() {
        eprintln!("skipped: there is no data/SHA256SUMS");
        return Ok(());
    }
    let known = std::fs::read_to_string(file)?;
    let mut tables = Tables::new();
    for figure in FIGURES.iter().filter(|figure| CHEAP.contains(&figure.id)) {
        for line in tables.sums(figure)?.lines() {
            assert!(known.lines().any(|other| other == line), "not in data/SHA256SUMS: {line}");
        }
    }
    Ok(())
}

#[test]
fn exports_say_what_is_missing() {
    assert_eq!(exports::table_count(1), 3);
    assert_eq!(exports::table_count(15), 0);
    assert!(exports::sums(15) < 0);
    assert!(exports::table(0, 0) < 0);
    assert!(exports::table(1, 0) > 0);
}
