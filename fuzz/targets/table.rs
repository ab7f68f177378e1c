//! Tables: what is accepted is written as CSV that reads back as the same table.

use files::table::{Table, TableError};

/// Tries one file.
pub fn read(bytes: &[u8]) {
    match Table::parse(bytes) {
        Ok(table) => {
            assert!(table.rows().flatten().all(|number| number.is_finite()));
            let csv = table.to_csv();
            let again =
                Table::parse(&csv).unwrap_or_else(|error| panic!("{error}: {:?}", String::from_utf8_lossy(&csv)));
            assert_eq!(again.columns, table.columns);
            let bits = |table: &Table| table.rows().flatten().map(|number| number.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&again), bits(&table));
            for name in &table.columns {
                assert_eq!(table.column(name).expect("a column that is there").len(), table.len());
            }
        }
        Err(TableError::Malformed { line, problem, .. }) => {
            let lines = 1 + bytes.iter().filter(|&&byte| byte == b'\n' || byte == b'\r').count() as u64;
            assert!(line <= lines && !problem.is_empty(), "line {line} of {lines}: {problem}");
        }
        Err(error) => panic!("no file was read: {error}"),
    }
}
