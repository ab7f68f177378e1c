//! The committed ledger on its tables, and tables in memory.

use checkout::paths::{Paths, Scheme};
use claims::again;
use claims::entry::{Claim, Verdict};
use claims::report::Ledger;
use claims::sheet::{LedgerTable, Stated};
use claims::source::LedgerFiles;
use claims::tables::{Tables, figure_of};
use std::fs;
use std::path::Path;

#[test]
fn tables_of_figures_are_told_from_committed_ones() {
    assert_eq!(figure_of("fig11/trajectories"), Some("fig11"));
    assert_eq!(figure_of("s13/eps"), Some("s13"));
    for table in ["events", "accuracy/rounding", "paper-scheme/distance", "solutions/x", "reference/published_std_log"]
    {
        assert_eq!(figure_of(table), None, "{table}");
    }
}

/// The checkout that holds this test.
fn checkout() -> Paths {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    Paths { base: root.clone(), target: root.join("target"), root, scheme: Scheme::Adaptive }
}

#[test]
fn the_committed_ledger_is_written_as_it_is_read() {
    let paths = checkout();
    let text = fs::read_to_string(paths.ledger()).expect("data/ledger.json");
    let ledger = Ledger::read(&paths).expect("a ledger");
    assert!(ledger.to_text().expect("JSON") == text && ledger.claims.len() > 20);
}

#[test]
fn the_committed_ledger_belongs_to_the_files_written_by_hand() {
    let paths = checkout();
    let sources = LedgerFiles::read(&paths).expect("the ledger's files");
    let text = fs::read_to_string(paths.ledger()).expect("data/ledger.json");
    let ledger: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let claims = ledger["claims"].as_array().expect("claims");
    assert!(claims.len() >= 40, "{} claims", claims.len());
    assert_eq!(claims.len(), sources.claims.len());
    for (found, claim) in claims.iter().zip(&sources.claims) {
        let words = Some(claim.verdict.words());
        assert_eq!((found["id"].as_str(), found["says"].as_str()), (Some(&*claim.id), Some(&*claim.says)));
        assert_eq!((found["verdict"].as_str(), found["verdict_found"].as_str()), (words, words), "{}", claim.id);
        assert_eq!(found["tests"].as_array().map(Vec::len), Some(claim.tests.len() + claim.under.len()));
        let finding = found["finding"].as_str().unwrap_or("{");
        assert!(!finding.contains(['{', '}']), "{finding}");
    }
    assert_eq!(ledger["errata"].as_array().map(Vec::len), Some(sources.errata.len()));
    assert_eq!(ledger["parameters"].as_array().map(Vec::len), Some(sources.parameters.len()));
}

#[test]
fn claims_over_committed_tables_are_found_as_committed() {
    let paths = checkout();
    let mut sources = LedgerFiles::read(&paths).expect("the ledger's files");
    let is_committed = |claim: &Claim| {
        let tests = claim.all_tests();
        let tables = tests.iter().flat_map(|(place, _, measure)| measure.tables(place).expect("tables"));
        tables.into_iter().all(|table| figure_of(&table).is_none())
    };
    sources.claims.retain(is_committed);
    (sources.errata, sources.parameters) = (Vec::new(), Vec::new());
    assert!(sources.claims.len() >= 10, "{} claims", sources.claims.len());
    let ledger = Ledger::new(&sources, &Tables::new(&paths, &paths).expect("tables")).expect("a ledger");
    let text = fs::read_to_string(paths.ledger()).expect("data/ledger.json");
    let committed: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for claim in &ledger.claims {
        let wanted = committed["claims"].as_array().into_iter().flatten().find(|one| one["id"] == *claim.id);
        assert_eq!(serde_json::to_value(claim).ok().as_ref(), wanted, "{}", claim.id);
    }
}

/// Tables in memory, with the errors that the manifest states.
fn of_memory(paths: &Paths, names: &[&str]) -> Tables<'static> {
    let manifest = checkout::manifest::read(paths).expect("a manifest");
    Tables::of_memory(names.iter().map(|&name| {
        let cells = files::table::MixedTable::read(&paths.output(&Paths::table(name))).expect("a table");
        let entry = manifest.get(&Paths::table(name));
        let error = |column: &str| Some(Stated::OfRange(entry?.error.get(column)?.unwrap_or(f64::INFINITY)));
        (name.to_owned(), LedgerTable::new(cells, &error))
    }))
}

#[test]
fn tables_in_memory_give_the_findings_of_files() {
    let paths = checkout();
    let sources = LedgerFiles::read(&paths).expect("the ledger's files");
    let files = Tables::new(&paths, &paths).expect("tables");
    let runs: [(&[&str], usize); 3] = [
        (&["fig04/stable", "fig04/unstable", "events"], 3),
        (&["fig07/stable", "fig07/unstable", "events"], 2),
        (&["fig11/trajectories"], 1),
    ];
    for (names, count) in runs {
        if let Some(missing) = names.iter().find(|name| !files.has(name)) {
            eprintln!("skipped: there is no table {missing}");
            continue;
        }
        let memory = of_memory(&paths, names);
        let claims = again::about(&sources, &|table| memory.has(table)).expect("claims");
        assert!(claims.len() >= count, "{names:?}: {} claims", claims.len());
        for claim in claims {
            let (verdict, tests) = again::judge(claim, &memory).expect("a verdict");
            assert_eq!(verdict, claim.verdict, "{}", claim.id);
            assert_eq!((verdict, tests), again::judge(claim, &files).expect("a verdict"), "{}", claim.id);
        }
    }
}

#[test]
fn a_test_without_a_value_leaves_its_claim_open() {
    let claim = |is: &str| {
        let text = format!(
            "[[claim]]\nid = \"a\"\nlabel = \"l\"\nsays = \"s\"\nverdict = \"holds\"\nfinding = \"f\"\n\
             [[claim.test]]\ntake = \"only\"\nof = \"v\"\ntable = \"fig11/a\"\nwhere = [\"v > 5\"]\nis = \"> 0\"\n\
             [[claim.test]]\ntake = \"count\"\ntable = \"fig11/a\"\nis = \"{is}\"\n"
        );
        LedgerFiles::parse([&text, "", ""]).expect("a claim")
    };
    let cells = files::table::MixedTable::parse(b"v\n1\n2\n").expect("a table");
    let tables = Tables::of_memory([("fig11/a".to_owned(), LedgerTable::new(cells, &|_| None))]);
    for (is, expected) in [("= 2", Verdict::Open), ("= 3", Verdict::Fails)] {
        let sources = claim(is);
        let (verdict, tests) = again::judge(&sources.claims[0], &tables).expect("a verdict");
        assert_eq!(verdict, expected, "{tests:?}");
        let problem = tests[0].value.as_ref().expect_err("no row");
        assert!(problem.contains("no row") && problem.contains("fig11/a"), "{problem}");
    }
    assert!(again::about(&claim("= 2"), &|table| table == "fig12/a").expect("claims").is_empty());
}
