//! The two published curves whose numbers are known, beside regenerated ones.

use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use files::table::Table;

/// Where the reading errors of published numbers are stated.
const READING: &str = "data/reference/README.md";

/// A published curve and the table that regenerates it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Curve {
    /// A short name.
    pub name: &'static str,
    /// What it shows, in words.
    pub title: &'static str,
    /// The published table, below `data/reference`.
    pub file: &'static str,
    /// The regenerated table, `fig12/t300`.
    pub table: &'static str,
    /// The column that both share, and the one that is compared.
    pub columns: [&'static str; 2],
}

/// The curves.
pub const CURVES: [Curve; 2] = [
    Curve {
        name: "speeds",
        title: "Figure 12, left: speeds",
        file: "published_speed_t300",
        table: "fig12/t300",
        columns: ["n", "v"],
    },
    Curve {
        name: "deviations",
        title: "Figure 13: standard deviation of the speeds",
        file: "published_std_log",
        table: "fig13/std",
        columns: ["t", "std"],
    },
];

/// Numbers of a curve at the places where a table has a value, too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// The places. They were read off an axis and are whole up to their reading error, so they are rounded.
    pub x: Vec<f64>,
    /// The published numbers.
    pub published: Vec<f64>,
    /// Those of the table.
    pub regenerated: Vec<f64>,
    /// How many published numbers there are, with those at whose place the table has none.
    pub all: usize,
}

impl Curve {
    /// Whether its published table is there.
    pub fn is_there(&self, paths: &Paths) -> bool {
        paths.root.join(self.source()).exists()
    }

    /// The published table, by name.
    pub fn source(&self) -> String {
        format!("data/reference/{}.csv", self.file)
    }

    /// Its numbers beside those of a table.
    ///
    /// # Errors
    /// Failed: a table cannot be read or lacks a column.
    pub fn beside(&self, paths: &Paths, made: &Table) -> Result<Points, Failure> {
        let path = paths.root.join(self.source());
        let theirs = Table::read(&path).map_err(Failure::at(&path))?;
        let column = |table: &Table, at: usize| table.column(self.columns[at]).map_err(Failure::at(&path));
        let (keys, values) = (column(made, 0)?, column(made, 1)?);
        let mut points = Points { all: theirs.len(), ..Points::default() };
        for (key, published) in column(&theirs, 0)?.into_iter().map(f64::round).zip(column(&theirs, 1)?) {
            if let Some(place) = keys.iter().position(|own| *own == key) {
                points.x.push(key);
                points.published.push(published);
                points.regenerated.push(values[place]);
            }
        }
        Ok(points)
    }

    /// The usual and the largest reading error: `3e-5`, or `median 4e-4, largest 2e-3 (...)` in the last column of a
    /// table.
    ///
    /// # Errors
    /// Usage: none is stated.
    pub fn reading_errors(&self, paths: &Paths) -> Result<[f64; 2], Failure> {
        let text = disk::read_text(&paths.root.join(READING))?.unwrap_or_default();
        let row = text.lines().find(|line| line.starts_with(&format!("| {}.csv ", self.file)));
        let cell = row.and_then(|row| row.trim_end_matches([' ', '|']).rsplit('|').next()).unwrap_or("");
        let numbers: Vec<f64> = cell.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
        let missing = || Failure::Usage(format!("{READING}: no reading error of {}", self.file));
        numbers.first().zip(numbers.last()).map(|(first, last)| [*first, *last]).ok_or_else(missing)
    }
}

impl Points {
    /// Published minus regenerated numbers.
    pub fn differences(&self) -> Vec<f64> {
        self.published.iter().zip(&self.regenerated).map(|(published, regenerated)| published - regenerated).collect()
    }

    /// Their largest magnitude; 0 without any.
    pub fn largest(&self) -> f64 {
        self.differences().into_iter().map(f64::abs).max_by(f64::total_cmp).unwrap_or(0.0)
    }

    /// The root of the mean of their squares.
    pub fn root_mean_square(&self) -> f64 {
        let sum: f64 = self.differences().iter().map(|difference| difference * difference).sum();
        (sum / self.x.len() as f64).sqrt()
    }
}
