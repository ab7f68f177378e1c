//! A folder with a test's own tables, on which entries are judged.

use checkout::failure::Failure;
use checkout::paths::{Paths, Scheme};
use claims::report::{Ledger, Tested};
use claims::source::LedgerFiles;
use claims::tables::Tables;
use std::fs;
use std::path::Path;

/// A folder with tables and a manifest, in which measures are evaluated.
pub struct Desk {
    pub paths: Paths,
}

impl Desk {
    pub fn new(name: &str, tables: &[(&str, &str)]) -> Desk {
        // tests run beside each other, and several have a desk of the same name
        static DESKS: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
        let own = DESKS.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("ledger-{name}-{own}"));
        let _ = fs::remove_dir_all(&root);
        for (table, text) in tables {
            let path = root.join(format!("data/{table}.csv"));
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, text).expect("a table");
        }
        let paths = Paths { base: root.clone(), target: root.join("target"), root, scheme: Scheme::Adaptive };
        Desk { paths }
    }

    /// States an error for a column of a table.
    pub fn error(&self, table: &str, column: &str, method: &str, error: f64) {
        let entry = serde_json::json!({ "error": { column: error }, "method": method });
        let manifest = serde_json::json!({ "schema_version": 1, "outputs": { format!("data/{table}.csv"): entry } });
        fs::write(self.paths.root.join("data/manifest.json"), manifest.to_string()).expect("a manifest");
    }

    pub fn ledger(&self, claims: &str) -> Result<Ledger, Failure> {
        let sources = LedgerFiles::parse([claims, "", ""])?;
        Ledger::new(&sources, &Tables::new(&self.paths, &self.paths)?)
    }

    /// The one test of a claim that only reports.
    #[track_caller]
    pub fn measure(&self, test: &str) -> Tested {
        self.ledger(&open_claim(test)).unwrap_or_else(|failure| panic!("{test}: {}", failure.text())).claims[0].tests[0]
            .clone()
    }

    #[track_caller]
    pub fn value(&self, test: &str, value: f64, error: f64) {
        let tested = self.measure(test);
        let close = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-12 * b.abs();
        assert!(
            close(tested.value, value) && close(tested.error, error),
            "{test}: {} +- {}",
            tested.value,
            tested.error
        );
    }

    /// The message about a test that cannot be evaluated.
    #[track_caller]
    pub fn problem(&self, test: &str, wanted: &[&str]) {
        let failure = self.ledger(&open_claim(test)).expect_err(test);
        assert_eq!(failure.code(), 2, "{test}");
        for part in [&["paper/claims.toml, one, test 1"], wanted].concat() {
            assert!(failure.text().contains(part), "{test}: {:?} lacks {part:?}", failure.text());
        }
    }
}

pub fn open_claim(test: &str) -> String {
    let head = "[[claim]]\nid = \"one\"\nlabel = \"eq:one\"\nsays = \"one\"\nverdict = \"cannot be decided\"\nwhy = \"a test\"\n";
    format!("{head}finding = \"\"\n[[claim.test]]\n{test}\n")
}

/// A claim with tests that compare the only cell of table `one` with numbers.
pub fn claim(verdict: &str, tests: &[&str], under: &[&str]) -> String {
    let block = |key: &str, is: &&str| {
        format!("[[claim.{key}]]\ntake = \"only\"\nof = \"x\"\ntable = \"one\"\nis = \"{is}\"\n")
    };
    let condition = if under.is_empty() { "" } else { "condition = \"if\"\n" };
    let why = if verdict == "cannot be decided" { "why = \"so\"\n" } else { "" };
    let tests: String = tests.iter().map(|is| block("test", is)).collect();
    let under: String = under.iter().map(|is| block("under", is)).collect();
    let head =
        format!("[[claim]]\nid = \"one\"\nlabel = \"l\"\nsays = \"s\"\nverdict = \"{verdict}\"\nfinding = \"\"\n");
    format!("{head}{condition}{why}{tests}{under}")
}

pub fn numbers() -> Desk {
    Desk::new("numbers", &[("fig90/one", "t,v,w\n0,3,1\n1,-1,2\n2,5,4\n3,2,8\n")])
}
