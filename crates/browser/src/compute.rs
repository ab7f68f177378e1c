//! Tables of the figures, as the bytes of their CSV files.

use crate::figures::{Content, Entry, Figure};
use files::scene_file::{self, Panel};
use files::table::Table;
use files::write::sha256;
use jam::run::Outcome;
use scene::tables;
use std::collections::BTreeMap;

/// Computes tables; a run that several of them read is integrated once.
#[derive(Debug, Default)]
pub struct Tables {
    /// By what determines them.
    runs: BTreeMap<String, Outcome>,
}

impl Tables {
    /// Nothing computed yet.
    pub const fn new() -> Tables {
        Tables { runs: BTreeMap::new() }
    }

    /// The bytes of `data/<figure>/<entry>.csv`.
    ///
    /// # Errors
    /// In words: what is wrong with the scene, or how far the integration came.
    pub fn csv(&mut self, figure: &Figure, entry: &Entry) -> Result<Vec<u8>, String> {
        let file = format!("{}/scene.toml", figure.id);
        let parsed = scene_file::parse(&file, figure.scene).map_err(|error| error.to_string())?;
        let panel = parsed.panel(entry.panel).map_err(|error| error.to_string())?;
        match entry.content {
            Content::Map => {
                let map = scene::map::read(&file, &panel.tables).map_err(|error| error.to_string())?;
                Ok(map.compute()?.to_csv(&map))
            }
            Content::Curve => {
                let table = scene::curve::table(&file, &panel.tables).map_err(|error| error.to_string())?;
                Ok(table.to_csv())
            }
            Content::Std => Ok(tables::std(&self.run(&file, panel)?.samples).to_csv()),
            Content::Trajectories => Ok(tables::trajectories(&self.run(&file, panel)?.samples).to_csv()),
            Content::At(time) => Ok(at(&tables::trajectories(&self.run(&file, panel)?.samples), time).to_csv()),
        }
    }

    /// The lines of `data/SHA256SUMS` for the tables of a figure.
    ///
    /// # Errors
    /// As [`Tables::csv`].
    pub fn sums(&mut self, figure: &Figure) -> Result<String, String> {
        let mut lines = String::new();
        for entry in figure.tables {
            let sum = sha256(&self.csv(figure, entry)?);
            lines += &format!("{sum}  data/{}/{}.csv\n", figure.id, entry.name);
        }
        Ok(lines)
    }

    fn run(&mut self, file: &str, panel: &Panel) -> Result<&Outcome, String> {
        let key = panel.determinants();
        if !self.runs.contains_key(&key) {
            let scene = scene::run::read(file, &panel.tables).map_err(|error| error.to_string())?;
            let outcome = jam::run::run(&scene).map_err(|error| error.to_string())?;
            self.runs.insert(key.clone(), outcome);
        }
        Ok(&self.runs[&key])
    }
}

/// The rows `n, x, v` of one time from trajectories `t, n, x, v`.
pub(crate) fn at(trajectories: &Table, time: f64) -> Table {
    let mut table = Table::new(&["n", "x", "v"]);
    trajectories.rows().filter(|row| row[0] == time).for_each(|row| table.push(&row[1..]));
    table
}
