//! Values that override those of a scene: from the command line those of `[run]`, from a program any.

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

    /// The tables of a scene with these values in `[run]`. Their line is 0, since they come from no file.
    pub fn apply(&self, tables: &Section) -> Section {
        let text = |value: &Option<String>| value.clone().map(Value::Text);
        let number = |value: Option<f64>| value.map(Value::Number);
        let values = [
            ("run.method", text(&self.method)),
            ("run.state", text(&self.state)),
            ("run.tolerance", number(self.tolerance)),
            ("run.dt", number(self.dt)),
            ("run.t_end", number(self.t_end)),
            ("run.sample", number(self.sample)),
        ];
        set(tables, values.into_iter().filter_map(|(key, value)| Some((key, value?))))
    }
}

/// The tables of a scene with other values at these dotted keys (`law.a_v`): what stood there is replaced, a table too.
/// Of `run.dt` and `run.tolerance` the one that is set removes the other.
pub fn set<'a>(tables: &Section, values: impl IntoIterator<Item = (&'a str, Value)>) -> Section {
    let values: Vec<_> = values.into_iter().collect();
    let mut tables = tables.clone();
    if let Some(Value::Section(run)) = tables.entries.get_mut("run").map(|entry| &mut entry.value) {
        for (key, other) in [("run.dt", "tolerance"), ("run.tolerance", "dt")] {
            if values.iter().any(|(name, _)| *name == key) {
                run.entries.remove(other);
            }
        }
    }
    for (index, (key, value)) in values.into_iter().enumerate() {
        put(&mut tables, key, Entry::given(index, value));
    }
    tables
}

fn put(tables: &mut Section, key: &str, entry: Entry) {
    let Some((table, rest)) = key.split_once('.') else {
        tables.entries.insert(key.to_owned(), entry);
        return;
    };
    let below = tables
        .entries
        .entry(table.to_owned())
        .or_insert_with(|| Entry { value: Value::Section(Section::default()), ..entry.clone() });
    if !matches!(below.value, Value::Section(_)) {
        below.value = Value::Section(Section::default());
    }
    if let Value::Section(section) = &mut below.value {
        put(section, rest, entry);
    }
}
