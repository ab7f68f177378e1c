//! The caller's input: a scene as a file, text or dictionary, and values that override some of its own.

use files::reader::{Entry, SceneError, Section, Value};
use files::scene_file::{self, Kind, Panel, SceneFile};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use scene::overrides;
use std::path::PathBuf;

/// A scene in one of its three forms.
#[derive(FromPyObject)]
pub enum Given<'py> {
    /// The tables as dictionaries.
    #[pyo3(transparent)]
    Tables(Bound<'py, PyDict>),
    /// The text of a scene file.
    #[pyo3(transparent)]
    Text(String),
    /// A scene file.
    #[pyo3(transparent)]
    File(PathBuf),
}

/// What messages call a scene that is no file.
const TEXT: &str = "<text>";
const TABLES: &str = "<dict>";

/// The panel of a scene, with values replaced.
pub struct Chosen {
    /// The file, for messages.
    pub file: String,
    /// What the scene shows, in words.
    pub title: String,
    /// The panel.
    pub panel: Panel,
}

/// What a scene has and which function takes it.
const CALLS: [(Kind, &str, &str); 3] =
    [(Kind::Run, "run", "simulate"), (Kind::Map, "map", "map"), (Kind::Sweep, "sweep", "sweep")];

/// Reads a scene, chooses the panel `name` (or the one of this kind, if there is no other) and replaces values in it.
pub fn choose(given: &Given<'_>, name: Option<&str>, kind: Kind, values: &Bound<'_, PyDict>) -> PyResult<Chosen> {
    let parsed = read(given).map_err(|error| scene_error(values.py(), &error))?;
    let mut panel = panel(&parsed, name, kind).map_err(|error| scene_error(values.py(), &error))?.clone();
    panel.tables = replaced(&panel.tables, values)?;
    let SceneFile { file, title, .. } = parsed;
    Ok(Chosen { file, title, panel })
}

fn read(given: &Given<'_>) -> Result<SceneFile, SceneError> {
    match given {
        Given::Tables(tables) => scene_file::read_section(TABLES, &section(tables)?),
        Given::Text(text) => scene_file::parse(TEXT, text),
        Given::File(path) => scene_file::read(path),
    }
}

fn panel<'a>(parsed: &'a SceneFile, name: Option<&str>, kind: Kind) -> Result<&'a Panel, SceneError> {
    let complaint = |problem: String| SceneError::new(&parsed.file, 0, problem);
    let found: Vec<&Panel> = parsed.panels.iter().filter(|panel| panel.kind == kind).collect();
    match (name, &found[..]) {
        (Some(name), _) => parsed.panel(name),
        (None, [only]) => Ok(only),
        (None, []) => {
            let table = CALLS.iter().find(|call| call.0 == kind).map_or("", |call| call.1);
            let calls: Vec<String> =
                CALLS.iter().map(|(_, table, call)| format!("`{call}` is for scenes with [{table}]")).collect();
            Err(complaint(format!("has no [{table}]; {}", calls.join(", "))))
        }
        (None, several) => {
            let names: Vec<&str> = several.iter().map(|panel| panel.name.as_str()).collect();
            Err(complaint(format!("several panels: choose one with panel=: {}", names.join(", "))))
        }
    }
}

/// The tables with these values, whose keys are dotted.
pub fn replaced(tables: &Section, values: &Bound<'_, PyDict>) -> PyResult<Section> {
    let mut given = Vec::new();
    for (key, entry) in values {
        given.push((key.extract::<String>()?, value(&entry).map_err(|error| scene_error(values.py(), &error))?));
    }
    Ok(overrides::set(tables, given.iter().map(|(key, value)| (key.as_str(), value.clone()))))
}

/// A dictionary as a table of a scene.
pub fn section(tables: &Bound<'_, PyDict>) -> Result<Section, SceneError> {
    let mut section = Section::default();
    for (index, (key, entry)) in tables.iter().enumerate() {
        let Ok(key) = key.extract::<String>() else {
            return Err(SceneError::new(TABLES, 0, format!("{key}: a key must be a text")));
        };
        section.entries.insert(key, Entry::given(index, value(&entry)?));
    }
    Ok(section)
}

fn value(entry: &Bound<'_, PyAny>) -> Result<Value, SceneError> {
    let other = || entry.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    if let Ok(tables) = entry.cast::<PyDict>() {
        return section(tables).map(Value::Section);
    }
    if let Ok(text) = entry.cast::<PyString>() {
        return Ok(Value::Text(text.to_string()));
    }
    if let Ok(flag) = entry.cast::<PyBool>() {
        return Ok(Value::Flag(flag.is_true()));
    }
    match entry.extract::<f64>() {
        // a whole number of Python may have more digits than a double
        Ok(number) if entry.is_instance_of::<PyInt>() && !entry.eq(number).unwrap_or(false) => {
            let problem =
                format!("{entry} is a whole number that a double cannot represent; the nearest is {number:?}");
            Err(SceneError::new(TABLES, 0, problem))
        }
        Ok(number) => Ok(Value::Number(number)),
        Err(_) => Ok(Value::Other(other())),
    }
}

/// The exception `jamming.SceneError`, with file, line, key, value and allowed range.
pub fn scene_error(py: Python<'_>, error: &SceneError) -> PyErr {
    let line = (error.line > 0).then_some(error.line);
    let about = error.about.as_deref();
    let key = about.map(|about| about.key.as_str());
    let allowed = about.and_then(|about| about.allowed.as_deref());
    let found = about.and_then(|about| about.value.as_ref()).and_then(|value| match value {
        Value::Number(number) => Some(PyFloat::new(py, *number).into_any()),
        Value::Text(text) => Some(PyString::new(py, text).into_any()),
        Value::Flag(flag) => Some(PyBool::new(py, *flag).to_owned().into_any()),
        Value::Section(_) | Value::Other(_) => None,
    });
    let words = match (key, line) {
        // of a formula the sentence names the column alone
        (Some(key), None) if !error.problem.contains(key) => format!("{}: {key}: {}", error.file, error.problem),
        _ => error.to_string(),
    };
    let file = (error.file != TEXT && error.file != TABLES).then_some(error.file.as_str());
    raise(py, "SceneError", (words, file, line, key, found, allowed))
}

/// An exception of the package.
fn raise<'py>(py: Python<'py>, name: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let class = py.import("jamming._errors").and_then(|module| module.getattr(name));
    match class.and_then(|class| class.call1(arguments)) {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}
