//! The ledger's files: claims, errata and parameters, of any contents, are read or refused with file and place.

use claims::source::LedgerFiles;
use claims::uncertain::Uncertain;
use claims::words;
use std::collections::BTreeMap;

/// Tries one file, as each of the three.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let files: [[&str; 3]; 3] = [[&text, "", ""], ["", &text, ""], ["", "", &text]];
    for (file, name) in files.into_iter().zip(["paper/claims.toml", "paper/errata.toml", "paper/parameters.toml"]) {
        match LedgerFiles::parse(file) {
            Ok(sources) => accepted(&sources),
            Err(failure) => assert!(failure.code() == 2 && failure.text().starts_with(name), "{failure:?}"),
        }
    }
}

fn accepted(sources: &LedgerFiles) {
    let tests: Vec<_> = sources.entries().into_iter().flatten().collect();
    let mut named = BTreeMap::new();
    for (place, _, measure) in &tests {
        if let Ok(words) = words::describe(measure, place) {
            assert!(words.contains("data/"), "{words}");
        }
        if let Some(name) = &measure.name {
            named.insert(name.as_str(), Uncertain::between(1.0, 2.0, 1.5));
        }
    }
    for claim in &sources.claims {
        if let Ok(text) = words::fill(&claim.finding, &named, &claim.place(), "finding") {
            assert!(!text.contains('{'), "{text}");
        }
    }
    if let Ok(tables) = sources.tables() {
        assert!(tables.len() <= 200 * (1 + tests.len()));
    }
}
