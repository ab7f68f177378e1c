//! The distance of the paper's scheme from the accurate runs and from the published curves, from tables alone.

use crate::published::{CURVES, Curve};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::paths::{Paths, Scheme};
use checkout::print;
use files::pairs::{KEYS, pairs};
use files::table::{CellValue, MixedTable, Table};
use std::path::Path;

/// The table of distances, by name.
const DISTANCES: &str = "data/paper-scheme/distance.csv";

/// Its columns: where the two schemes differ most, and by how much, absolute and as a part of the accurate value; how
/// many published points there are, and how far they are at most from either scheme.
pub const COLUMNS: [&str; 15] = [
    "figure",
    "table",
    "column",
    "rows",
    "largest_difference",
    "at_t",
    "at_n",
    "verbatim",
    "accurate",
    "largest_relative",
    "relative_at_t",
    "relative_at_n",
    "published_points",
    "verbatim_from_published",
    "accurate_from_published",
];

/// Writes and prints the table of distances, for figures whose tables by both schemes exist.
///
/// # Errors
/// A table cannot be read, or the distances not be written.
pub fn tell(paths: &Paths, as_json: bool) -> Result<(), Failure> {
    let distances = of(paths, &figure::discover(paths)?)?;
    if distances.is_empty() {
        eprintln!("cargo xtask figures makes the tables that tell how far these are from the accurate ones");
        return Ok(());
    }
    disk::write_if_changed(&paths.root.join(DISTANCES), &distances.to_csv())?;
    if as_json { Ok(()) } else { print::out(&to_text(&distances)) }
}

/// Compares every table that both schemes have, in the order of the figures.
fn of(paths: &Paths, all: &[Figure]) -> Result<MixedTable, Failure> {
    let mut distances = MixedTable::new(&COLUMNS);
    for figure in all {
        let [accurate, verbatim] = [Scheme::Adaptive, Scheme::Paper].map(|scheme| {
            let paths = paths.with_scheme(scheme);
            paths.output(&paths.tables(&figure.id))
        });
        for name in disk::names(&verbatim)? {
            let Some(stem) = name.strip_suffix(".csv").filter(|_| accurate.join(&name).exists()) else { continue };
            let tables = [read(&verbatim.join(&name))?, read(&accurate.join(&name))?];
            for column in tables[0].columns.iter().filter(|name| !KEYS.contains(&name.as_str())) {
                let (Ok(a), Ok(b)) = (tables[0].place(column), tables[1].place(column)) else { continue };
                let names = [&*figure.id, stem, column];
                let mut row = names.map(CellValue::from).to_vec();
                row.extend(compare(&tables, (a, b)));
                row.extend(published(paths, names, &tables)?);
                distances.push(row);
            }
        }
    }
    Ok(distances)
}

fn read(path: &Path) -> Result<Table, Failure> {
    Table::read(path).map_err(Failure::failed)
}

/// The number of rows that both have; the largest difference, where it is, and the two values there; the largest
/// difference as a part of an accurate value other than 0, and where that is. Of equal ones the first.
fn compare([verbatim, accurate]: &[Table; 2], (a, b): (usize, usize)) -> [CellValue; 9] {
    let (rows, _) = pairs(verbatim, accurate);
    let (mut absolute, mut relative) = ((0.0, None), (0.0, None));
    for (_, mine, theirs) in &rows {
        let difference = (mine[a] - theirs[b]).abs();
        if difference > absolute.0 {
            absolute = (difference, Some((*mine, *theirs)));
        }
        if theirs[b] != 0.0 && difference / theirs[b].abs() > relative.0 {
            relative = (difference / theirs[b].abs(), Some((*mine, *theirs)));
        }
    }
    let key = |name: &str, at: Option<(&[f64], &[f64])>| {
        CellValue::from(at.zip(verbatim.place(name).ok()).map(|((mine, _), place)| mine[place]))
    };
    let (mine, theirs) = absolute.1.map_or((0.0, 0.0), |(mine, theirs)| (mine[a], theirs[b]));
    [
        rows.len().into(),
        absolute.0.into(),
        key("t", absolute.1),
        key("n", absolute.1),
        mine.into(),
        theirs.into(),
        relative.0.into(),
        key("t", relative.1),
        key("n", relative.1),
    ]
}

/// The number of published points that both schemes have a value at, and how far they are at most; nothing without
/// points.
fn published(
    paths: &Paths,
    [figure, table, column]: [&str; 3],
    tables: &[Table; 2],
) -> Result<[CellValue; 3], Failure> {
    let is_meant = |curve: &&Curve| curve.table == format!("{figure}/{table}") && curve.columns[1] == column;
    let Some(curve) = CURVES.iter().find(is_meant).filter(|curve| curve.is_there(paths)) else {
        return Ok([CellValue::Empty, CellValue::Empty, CellValue::Empty]);
    };
    let (verbatim, accurate) = (curve.beside(paths, &tables[0])?, curve.beside(paths, &tables[1])?);
    Ok([verbatim.x.len().into(), verbatim.largest().into(), accurate.largest().into()])
}

/// The distances for a reader.
fn to_text(distances: &MixedTable) -> String {
    let head = ["the paper's scheme", "column", "differs by", "at", "relative", "at", "from published", "accurate run"];
    let mut rows = vec![print::row(&head)];
    for row in distances.rows() {
        let number = |at: usize| row[at].number().map_or(String::new(), |number| format!("{number:.1e}"));
        let place = |at: usize| {
            let keys = ["t", "n"].iter().zip(&row[at..]).filter(|(_, cell)| **cell != CellValue::Empty);
            keys.map(|(name, cell)| format!("{name} = {cell}")).collect::<Vec<_>>().join(", ")
        };
        let (table, column) = (format!("{}/{}", row[0], row[1]), row[2].to_string());
        let cells = [&table, &column, &number(4), &place(5), &number(9), &place(10), &number(13), &number(14)];
        rows.push(cells.map(String::clone).to_vec());
    }
    print::table(&rows)
}
