//! The main function of a figure: tables first, from runs and laws; then the picture, from the tables alone.

use crate::failure::{Failure, exit};
use clap::Parser;
use files::scene_file::{self, Kind, Panel, SceneFile};
use files::table::{CellValue, MixedTable, Table};
use files::write::{atomic, make_folder, with_path};
use plot::Picture;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The command line of every figure.
#[derive(Debug, Parser)]
#[command(about = "Makes the tables and the picture of one figure")]
struct Arguments {
    /// The scene file
    #[arg(long)]
    scene: PathBuf,
    /// PANEL=DIR: folder of a panel's run
    #[arg(long = "run", value_parser = run_folder)]
    runs: Vec<(String, PathBuf)>,
    /// Folder of the tables
    #[arg(long)]
    tables: PathBuf,
    /// Folder of the pictures
    #[arg(long)]
    pictures: PathBuf,
    /// Folder of values from outside
    #[arg(long, default_value = "data/reference")]
    reference: PathBuf,
    /// File for what is known of the tables' accuracy
    #[arg(long)]
    report: Option<PathBuf>,
    /// Draw from the existing tables
    #[arg(long)]
    draw_only: bool,
}

fn run_folder(text: &str) -> Result<(String, PathBuf), String> {
    let (panel, folder) = text.split_once('=').ok_or_else(|| format!("{text}: must be PANEL=DIR"))?;
    Ok((panel.to_owned(), PathBuf::from(folder)))
}

/// The figure at work.
#[derive(Debug)]
pub struct Job {
    /// Its scene file.
    pub scene_file: SceneFile,
    arguments: Arguments,
    report: Map<String, Value>,
}

/// Runs a figure's binary: `tables` writes its tables, `picture` draws from them. `name` is that of the binary.
pub fn figure(
    name: &str,
    tables: fn(&mut Job) -> Result<(), Failure>,
    picture: fn(&Job) -> Result<Picture, Failure>,
) -> ExitCode {
    exit(run(name, tables, picture))
}

fn run(
    name: &str,
    tables: fn(&mut Job) -> Result<(), Failure>,
    picture: fn(&Job) -> Result<Picture, Failure>,
) -> Result<(), Failure> {
    let arguments = Arguments::parse();
    let scene_file = scene_file::read(&arguments.scene)?;
    let mut job = Job { scene_file, arguments, report: Map::new() };
    for folder in [&job.arguments.tables, &job.arguments.pictures] {
        make_folder(folder)?;
    }
    if !job.arguments.draw_only {
        tables(&mut job)?;
    }
    let rendered = picture(&job)?.render().map_err(Failure::work)?;
    let id = name.split('-').next().unwrap_or(name);
    atomic(&job.arguments.pictures.join(format!("{id}.svg")), &rendered.svg)?;
    atomic(&job.arguments.pictures.join(format!("{id}.png")), &rendered.png)?;
    if let Some(file) = &job.arguments.report {
        let report = json!({ "schema_version": 1, "tables": job.report });
        atomic(file, format!("{report:#}\n").as_bytes())?;
    }
    Ok(())
}

/// A table of words and numbers as CSV.
///
/// # Errors
/// A number is not finite, which no reader takes: its row and its column.
pub fn finite_csv(name: &str, rows: &MixedTable) -> Result<Vec<u8>, Failure> {
    for (line, row) in rows.rows().enumerate() {
        for (cell, column) in row.iter().zip(&rows.columns) {
            if let CellValue::Number(number) = cell
                && !number.is_finite()
            {
                return Err(Failure::work(format!("{name}.csv: row {}: {column} = {number}", line + 1)));
            }
        }
    }
    Ok(rows.to_csv())
}

impl Job {
    /// Where the table of this name lies.
    pub fn table_file(&self, name: &str) -> PathBuf {
        self.arguments.tables.join(format!("{name}.csv"))
    }

    /// Writes a table under this name.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, name: &str, table: &Table) -> Result<(), Failure> {
        Ok(atomic(&self.table_file(name), &table.to_csv())?)
    }

    /// Writes a table that has words, or empty cells, under this name.
    ///
    /// # Errors
    /// It holds a number that is not finite, or the file cannot be written.
    pub fn write_rows(&self, name: &str, rows: &MixedTable) -> Result<(), Failure> {
        Ok(atomic(&self.table_file(name), &finite_csv(name, rows)?)?)
    }

    /// The same, of a figure with one run, for a table that is not made from it.
    ///
    /// # Errors
    /// As [`Job::write_rows`].
    pub fn write_own_rows(&mut self, name: &str, rows: &MixedTable) -> Result<(), Failure> {
        self.report.insert(name.to_owned(), json!({ "run": "", "error": {} }));
        self.write_rows(name, rows)
    }

    /// Reads a table of this figure that has words.
    ///
    /// # Errors
    /// It is missing.
    pub fn read_rows(&self, name: &str) -> Result<MixedTable, Failure> {
        Ok(MixedTable::read(&self.table_file(name))?)
    }

    /// Reads a table of this figure.
    ///
    /// # Errors
    /// It is missing or damaged.
    pub fn read(&self, name: &str) -> Result<Table, Failure> {
        Ok(Table::read(&self.table_file(name))?)
    }

    /// Reads a table of the run of a panel: `std` or `trajectories`.
    ///
    /// # Errors
    /// No `--run` for this panel, or the table is missing or damaged.
    pub fn run_table(&self, panel: &str, name: &str) -> Result<Table, Failure> {
        Ok(Table::read(&self.run_file(panel, name)?)?)
    }

    /// Copies a table of a panel's run unchanged, under the name `target`.
    ///
    /// # Errors
    /// As [`Job::run_table`], or the copy cannot be written.
    pub fn take(&self, panel: &str, name: &str, target: &str) -> Result<(), Failure> {
        self.copy(&self.run_file(panel, name)?, target)
    }

    /// Takes the standard deviations of all runs, each under the name of its panel.
    ///
    /// # Errors
    /// As [`Job::take`].
    pub fn take_deviations(&mut self) -> Result<(), Failure> {
        let mut runs = self.scene_file.panels.iter().filter(|panel| panel.kind == Kind::Run);
        runs.try_for_each(|panel| self.take(&panel.name, "std", &panel.name))
    }

    fn run_file(&self, panel: &str, name: &str) -> Result<PathBuf, Failure> {
        let known = self.arguments.runs.iter().find(|(given, _)| given == panel);
        let (_, folder) = known.ok_or_else(|| Failure::input(format!("no --run {panel}=DIR was given")))?;
        Ok(folder.join(format!("{name}.csv")))
    }

    /// Reads a table of values from outside.
    ///
    /// # Errors
    /// It is missing or damaged.
    pub fn reference(&self, name: &str) -> Result<Table, Failure> {
        Ok(Table::read(&self.committed("reference", name)?)?)
    }

    /// Reads an accuracy table, which is committed.
    ///
    /// # Errors
    /// It is missing.
    pub fn accuracy(&self, name: &str) -> Result<MixedTable, Failure> {
        Ok(MixedTable::read(&self.committed("accuracy", name)?)?)
    }

    /// Takes a table that is committed below `data`, in this folder, as it is.
    ///
    /// # Errors
    /// It is missing, or the copy cannot be written.
    pub fn take_committed(&self, folder: &str, name: &str) -> Result<(), Failure> {
        self.copy(&self.committed(folder, name)?, name)
    }

    /// A committed table, which the scene must name: a figure is stale when one of those has changed.
    fn committed(&self, folder: &str, name: &str) -> Result<PathBuf, Failure> {
        let table = format!("{folder}/{name}");
        match self.scene_file.reads.contains(&table) {
            true => Ok(self.arguments.reference.with_file_name(table + ".csv")),
            false => Err(Failure::input(format!("{}: reads: must name {table}", self.scene_file.file))),
        }
    }

    fn copy(&self, file: &Path, target: &str) -> Result<(), Failure> {
        let bytes = std::fs::read(file).map_err(|error| with_path(error, file))?;
        Ok(atomic(&self.table_file(target), &bytes)?)
    }

    /// States how a table was computed, for the manifest.
    pub fn state_method(&mut self, name: &str, method: &str) {
        self.report.insert(name.to_owned(), json!({ "method": method }));
    }

    /// Reads a table of archived timings: seconds are measured once, on one machine, and kept.
    ///
    /// # Errors
    /// It is missing or damaged.
    pub fn timing(&self, name: &str) -> Result<Table, Failure> {
        Ok(Table::read(&self.committed("timing", name)?)?)
    }

    /// Reads a table of archived timings that has words.
    ///
    /// # Errors
    /// It is missing.
    pub fn timing_rows(&self, name: &str) -> Result<MixedTable, Failure> {
        Ok(MixedTable::read(&self.committed("timing", name)?)?)
    }

    /// The panel of this name.
    ///
    /// # Errors
    /// The scene has none.
    pub fn panel(&self, name: &str) -> Result<&Panel, Failure> {
        Ok(self.scene_file.panel(name)?)
    }

    /// Computes the tables of all maps and curves of the scene, each under the name of its panel.
    ///
    /// # Errors
    /// The scene is invalid, or a table cannot be written.
    pub fn compute_panels(&mut self) -> Result<(), Failure> {
        for panel in self.scene_file.panels.clone() {
            self.compute(&panel)?;
        }
        Ok(())
    }

    fn compute(&mut self, panel: &Panel) -> Result<(), Failure> {
        let table = match panel.kind {
            Kind::Map => {
                let map = scene::map::read(&self.scene_file.file, &panel.tables)?;
                let computed = map.compute().map_err(Failure::input)?;
                let error = json!({ map.columns()[2]: computed.error });
                let table = computed.whole().map_err(|why| Failure::work(format!("{}: {why}", panel.name)))?;
                self.report.insert(panel.name.clone(), json!({ "method": "closed form", "error": error }));
                table
            }
            Kind::Curve => scene::curve::table(&self.scene_file.file, &panel.tables)?,
            Kind::Run | Kind::Sweep | Kind::Drawing => return Ok(()),
        };
        self.write(&panel.name, &table)
    }
}
