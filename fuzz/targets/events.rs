//! Tables of events, of one run and of all.

use checkout::events::{self, HEADER, RUN_HEADER};
use verify::moved;

/// Tries one file, as either table.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match events::parse(RUN_HEADER, &text) {
        Ok(run) => {
            assert!(run.iter().all(|event| event.t.is_finite()));
            assert!(moved::compare("a", &run, &run, 0.0).is_empty(), "{run:?}");
            let table = events::merge(HEADER, &events::lines("a", &run, &run), &|_| false);
            let all =
                events::parse_all("events.csv", &table).unwrap_or_else(|failure| panic!("{failure:?}: {table:?}"));
            assert_eq!(all.values().map(Vec::len).sum::<usize>(), run.len());
        }
        Err(failure) => assert!(failure.text().starts_with(RUN_HEADER), "{failure:?}"),
    }
    match events::parse_all("events.csv", &text) {
        Ok(scenes) => {
            assert!(scenes.values().flatten().all(|event| event.t.is_finite()));
            let merged = events::merge(&text, &[], &|_| false);
            assert_eq!(events::parse_all("events.csv", &merged), Ok(scenes));
        }
        Err(failure) => assert!(failure.text().starts_with("events.csv:") && failure.code() == 2, "{failure:?}"),
    }
}
