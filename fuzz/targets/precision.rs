//! Tables of error against work, with archived seconds behind an empty line.

use verify::precision::{COSTS, Scene};

/// Tries one pair of tables.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let (table, seconds) = text.split_once("\n\n").unwrap_or((&text, ""));
    match Scene::parse("any", table, seconds) {
        Ok(scene) => {
            let json = scene.to_json();
            assert_eq!(json["scene"], "any");
            for (_, cost) in COSTS {
                let cheapest = scene.cheapest(1e-6, cost, &[]);
                assert!(cheapest.is_none_or(|row| row.error.is_some_and(|error| error <= 1e-6)));
            }
        }
        Err(problem) => {
            assert!(problem.starts_with("line ") || problem.starts_with("no column "), "{problem}")
        }
    }
}
