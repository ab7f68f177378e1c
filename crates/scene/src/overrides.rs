//! Values from the command line that replace those of `[run]`.

use files::reader::{Entry, Section, Value};

/// Values that replace those of the scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// `run.method`.
    pub method: Option<String>,
    /// `run.tolerance`; removes `run.dt`.
    pub tolerance: Option<f64>,
    /// `run.dt`; removes `run.tolerance`.
    pub dt: Option<f64>,
    /// `run.t_end`.
    pub t_end: Option<f64>,
    /// `run.sample`.
    pub sample: Option<f64>,
    /// `run.state`.
    pub state: Option<String>,
}

impl Overrides {
    /// The scheme of the paper: Heun with 1e-5 in positions and speeds.
    pub fn paper() -> Overrides {
        Overrides {
            method: Some("heun".to_owned()),
            dt: Some(1e-5),
            state: Some("positions".to_owned()),
            ..Overrides::default()
        }
    }

    /// The independent run that estimates errors: another method, a tolerance ten times tighter but not below what
    /// rounding allows.
    pub fn check(tolerance: f64) -> Overrides {
        let tighter = 0.1 * tolerance;
        Overrides {
            method: Some("extrapolation".to_owned()),
            tolerance: Some(if tighter < 1e-15 { 1e-15 } else { tighter }),
            ..Overrides::default()
        }
    }

    /// The tables of a scene with these values in `[run]`. Their line is 0: they stand in no file.
    pub fn apply(&self, tables: &Section) -> Section {
        let mut run = Section::default();
        let mut set = |key: &str, value: Option<Value>| {
            if let Some(value) = value {
                run.entries.insert(key.to_owned(), Entry::new(0, value));
            }
        };
        set("method", self.method.clone().map(Value::Text));
        set("state", self.state.clone().map(Value::Text));
        set("tolerance", self.tolerance.map(Value::Number));
        set("dt", self.dt.map(Value::Number));
        set("t_end", self.t_end.map(Value::Number));
        set("sample", self.sample.map(Value::Number));
        let mut tables = tables.clone();
        if let Some(Value::Section(old)) = tables.entries.get_mut("run").map(|entry| &mut entry.value) {
            if self.dt.is_some() {
                old.entries.remove("tolerance");
            }
            if self.tolerance.is_some() {
                old.entries.remove("dt");
            }
        }
        let mut over = Section::default();
        over.entries.insert("run".to_owned(), Entry::new(0, Value::Section(run)));
        tables.overlay(&over);
        tables
    }
}
