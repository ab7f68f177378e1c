//! The distance of the paper's scheme from the accurate runs and from the published curves, from tables alone.

use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::paths::{Paths, Scheme};
use checkout::print;
use files::pairs::{KEYS, pairs};
use files::table::Table;
use std::path::{Path, PathBuf};

/// The table of distances, by name.
const DISTANCES: &str = "data/paper-scheme/distance.csv";
/// The header of the table of distances.
pub const HEADER: &str = "figure,table,column,rows,largest_difference,at_t,at_n,verbatim,accurate,largest_relative,\
relative_at_t,relative_at_n,published_points,verbatim_from_published,accurate_from_published";

/// The tables with published points: figure, table, column, and the name of the points, whose first column is a key.
const PUBLISHED: [(&str, &str, &str, &str); 2] =
    [("fig12", "t300", "v", "published_speed_t300"), ("fig13", "std", "std", "published_std_log")];

/// Where two columns differ most.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// The difference, absolute or as a part of the accurate value.
    pub difference: f64,
    /// The time, in tables that have one.
    pub t: Option<f64>,
    /// The pedestrian, in tables that have one.
    pub n: Option<f64>,
    /// The value by the paper's scheme.
    pub verbatim: f64,
    /// The accurate value.
    pub accurate: f64,
}

/// How far the published points are, at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Published {
    /// Points compared.
    pub points: usize,
    /// From the values by the paper's scheme.
    pub from_verbatim: f64,
    /// From the accurate values.
    pub from_accurate: f64,
}

/// One column of one table.
#[derive(Clone, Debug, PartialEq)]
pub struct Distance {
    /// `fig04`.
    pub figure: String,
    /// Table of the figure.
    pub table: String,
    /// Column of the table.
    pub column: String,
    /// Rows that both tables have.
    pub rows: usize,
    /// Where the absolute difference is largest.
    pub absolute: Place,
    /// Where the difference is the largest part of the accurate value, which is not 0 there.
    pub relative: Place,
    /// The published points, where there are any.
    pub published: Option<Published>,
}

/// Compares every table that both schemes have, in the order of the figures.
///
/// # Errors
/// A table cannot be read.
pub fn of(paths: &Paths, all: &[Figure]) -> Result<Vec<Distance>, Failure> {
    let mut distances = Vec::new();
    for figure in all {
        let [accurate, verbatim] = [Scheme::Adaptive, Scheme::Paper].map(|scheme| folder(paths, scheme, figure));
        for name in disk::names(&verbatim)? {
            let Some(stem) = name.strip_suffix(".csv").filter(|_| accurate.join(&name).exists()) else { continue };
            let tables = [table(&verbatim.join(&name))?, table(&accurate.join(&name))?];
            for column in tables[0].columns.iter().filter(|name| !KEYS.contains(&name.as_str())) {
                let (Ok(a), Ok(b)) = (tables[0].place(column), tables[1].place(column)) else { continue };
                let columns = (a, b);
                let published = published(paths, (&figure.id, stem, column), &tables)?;
                let (rows, absolute, relative) = compare(&tables, columns);
                let (figure, table, column) = (figure.id.clone(), stem.to_owned(), column.clone());
                distances.push(Distance { figure, table, column, rows, absolute, relative, published });
            }
        }
    }
    Ok(distances)
}

/// Reads a table that a program of ours has written.
fn table(path: &Path) -> Result<Table, Failure> {
    Table::read(path).map_err(Failure::failed)
}

/// Writes the table of distances wherever the tables of both schemes are there, and tells it.
///
/// # Errors
/// A table cannot be read, or the distances not be written.
pub fn tell(paths: &Paths, as_json: bool) -> Result<(), Failure> {
    let distances = of(paths, &figure::discover(paths)?)?;
    if distances.is_empty() {
        eprintln!("cargo xtask figures makes the tables that tell how far these are from the accurate ones");
        return Ok(());
    }
    disk::write_if_changed(&paths.root.join(DISTANCES), to_csv(&distances).as_bytes())?;
    if as_json { Ok(()) } else { print::out(&to_text(&distances)) }
}

fn folder(paths: &Paths, scheme: Scheme, figure: &Figure) -> PathBuf {
    let paths = paths.with_scheme(scheme);
    paths.output(&paths.tables(&figure.id))
}

/// Matching rows, and the first places of the largest difference and of the largest relative one.
fn compare([verbatim, accurate]: &[Table; 2], (a, b): (usize, usize)) -> (usize, Place, Place) {
    let key = |name: &str| verbatim.columns.iter().position(|column| column == name);
    let (t, n) = (key("t"), key("n"));
    let (rows, _) = pairs(verbatim, accurate);
    let (mut absolute, mut relative) = (Place::default(), Place::default());
    for (_, mine, theirs) in &rows {
        let (verbatim, accurate) = (mine[a], theirs[b]);
        let place = |difference| Place { difference, t: t.map(|t| mine[t]), n: n.map(|n| mine[n]), verbatim, accurate };
        let difference = (verbatim - accurate).abs();
        if difference > absolute.difference {
            absolute = place(difference);
        }
        if accurate != 0.0 && difference / accurate.abs() > relative.difference {
            relative = place(difference / accurate.abs());
        }
    }
    (rows.len(), absolute, relative)
}

fn published(paths: &Paths, wanted: (&str, &str, &str), tables: &[Table; 2]) -> Result<Option<Published>, Failure> {
    let Some((_, _, column, name)) =
        PUBLISHED.iter().find(|(figure, table, column, _)| (*figure, *table, *column) == wanted)
    else {
        return Ok(None);
    };
    let path = paths.root.join("data/reference").join(format!("{name}.csv"));
    if !path.exists() {
        return Ok(None);
    }
    let points = table(&path)?;
    let fail = Failure::at(&path);
    let (keys, values) = (points.column(&points.columns[0]).map_err(&fail)?, points.column(column).map_err(&fail)?);
    let farthest = |table: &Table| -> Result<(usize, f64), Failure> {
        let (mine, found) = (table.column(&points.columns[0]).map_err(&fail)?, table.column(column).map_err(&fail)?);
        // keys were read off an axis: whole up to their reading error
        let at = |key: f64| mine.iter().position(|own| *own == key.round()).map(|index| found[index]);
        let pairs = keys.iter().zip(&values).filter_map(|(&key, value)| Some((at(key)? - value).abs()));
        Ok(pairs.fold((0, 0.0), |(count, largest), next| (count + 1, if next > largest { next } else { largest })))
    };
    let ((points, from_verbatim), (_, from_accurate)) = (farthest(&tables[0])?, farthest(&tables[1])?);
    Ok(Some(Published { points, from_verbatim, from_accurate }))
}

/// The distances as CSV, numbers in shortest form that reads back to the same bits; a cell without a value is empty.
pub fn to_csv(distances: &[Distance]) -> String {
    let mut text = format!("{HEADER}\n");
    for one in distances {
        let Distance { figure, table, column, rows, absolute, relative, published } = one;
        let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
        let whole = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value}"));
        let Place { difference, t, n, verbatim, accurate } = absolute;
        text.push_str(&format!("{figure},{table},{column},{rows},{difference:?},{},{},", whole(*t), whole(*n)));
        text.push_str(&format!("{verbatim:?},{accurate:?},{:?},", relative.difference));
        text.push_str(&format!("{},{},", whole(relative.t), whole(relative.n)));
        let points = published.map_or(String::new(), |published| published.points.to_string());
        let (from, accurate) = (published.map(|one| one.from_verbatim), published.map(|one| one.from_accurate));
        text.push_str(&format!("{points},{},{}\n", cell(from), cell(accurate)));
    }
    text
}

/// The distances for a reader.
pub fn to_text(distances: &[Distance]) -> String {
    let head = ["the paper's scheme", "column", "differs by", "at", "relative", "at", "from published", "accurate run"];
    let mut rows = vec![print::row(&head)];
    for one in distances {
        let place = |place: &Place| {
            let t = place.t.map(|t| format!("t = {t}"));
            let n = place.n.map(|n| format!("n = {n}"));
            t.into_iter().chain(n).collect::<Vec<_>>().join(", ")
        };
        let published =
            |value: fn(Published) -> f64| one.published.map_or(String::new(), |all| format!("{:.1e}", value(all)));
        rows.push(print::row(&[
            &format!("{}/{}", one.figure, one.table),
            &one.column,
            &format!("{:.1e}", one.absolute.difference),
            &place(&one.absolute),
            &format!("{:.1e}", one.relative.difference),
            &place(&one.relative),
            &published(|all| all.from_verbatim),
            &published(|all| all.from_accurate),
        ]));
    }
    print::table(&rows)
}
