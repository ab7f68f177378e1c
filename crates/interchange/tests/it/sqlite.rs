//! The database: it has the tables that JuPedSim and PedPy query, and its bytes are reproducible.

use crate::{TABLE, header};
use files::write::{Draft, publish};
use interchange::frames::Frames;
use interchange::sqlite;
use rusqlite::Connection;
use std::fs;
use std::path::{Path, PathBuf};

fn written(folder: &Path, name: &str, a_0: f64) -> PathBuf {
    let file = folder.join(name);
    let draft = Draft::new(&file).expect("a draft");
    let frames = Frames::read("run.csv", TABLE.as_bytes(), 2, 0.25).expect("a table");
    assert_eq!(sqlite::write(&draft, &header(Some(a_0)), frames), Ok(4));
    publish(vec![draft]).expect("a file");
    file
}

#[test]
fn the_tables_are_those_of_version_2() {
    let folder = tempfile::tempdir().expect("a folder");
    let database = Connection::open(written(folder.path(), "a.sqlite", 0.6)).expect("a database");
    let mut query = database.prepare("SELECT * FROM trajectory_data").expect("a table");
    let columns: Vec<String> = query.column_names().iter().map(|&name| name.to_owned()).collect();
    assert_eq!(columns, ["frame", "id", "pos_x", "pos_y", "ori_x", "ori_y"]);
    let rows = query.query_map([], |row| <(u32, u32, f64, f64, f64, f64)>::try_from(row)).expect("rows");
    let rows: Vec<_> = rows.map(|row| row.expect("a row")).collect();
    let row = |frame, id, x: f64| (frame, id, 0.6 * x, 0.0, 1.0, 0.0);
    assert_eq!(rows, [row(0, 0, -0.125), row(0, 1, 5.0), row(1, 0, 0.3), row(1, 1, 5.1)]);
    let text = |query: &str| database.query_row(query, [], |row| row.get::<_, String>(0)).expect("a text");
    let value = |key: &str| text(&format!("SELECT value FROM metadata WHERE key = '{key}'"));
    assert_eq!(["version", "fps", "a_0", "tau"].map(value), ["2", "8.0", "0.6 m", "0.5 s"]);
    // a ring of 6 m behind -0.075 m and before 3.06 m
    assert_eq!(["xmin", "xmax", "ymin", "ymax"].map(value), ["-7.0", "10.0", "-0.5", "0.5"]);
    assert_eq!(text("SELECT wkt FROM geometry"), "POLYGON ((-7 -0.5, 10 -0.5, 10 0.5, -7 0.5, -7 -0.5))");
    let joined = "SELECT count(*) FROM frame_data JOIN geometry ON geometry_hash = hash WHERE frame IN (0, 1)";
    let count = |query: &str| database.query_row(query, [], |row| row.get::<_, u32>(0)).expect("a count");
    assert_eq!((count(joined), count("SELECT count(*) FROM frame_data")), (2, 2));
    assert_eq!(text("PRAGMA integrity_check"), "ok");
}

#[test]
fn the_bytes_are_the_same_each_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let [first, second, other] = [("a", 0.6), ("b", 0.6), ("c", 0.7)]
        .map(|(name, a_0)| fs::read(written(folder.path(), name, a_0)).expect("bytes"));
    assert!(first == second && first != other);
}

/// An existing file is replaced, not added to.
#[test]
fn an_old_file_is_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let first = fs::read(written(folder.path(), "a", 0.6)).expect("bytes");
    let second = fs::read(written(folder.path(), "a", 0.6)).expect("bytes");
    assert!(first == second);
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}
