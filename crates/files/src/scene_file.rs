//! A scene file: title, source, and one or several panels. Top-level tables (`[law]`, `[ring]`, ...) apply to every
//! panel; tables such as `[panel.NAME.law]` override them.

use crate::reader::{Entry, SceneError, Section, Value};
use crate::text;
use std::collections::BTreeMap;
use std::path::Path;

/// Tables that determine numbers.
const DETERMINING: [&str; 8] = ["law", "ring", "start", "run", "uniform", "map", "curve", "sweep"];
/// All other keys that are allowed at the top level.
const DESCRIBING: [&str; 5] = ["title", "source", "origin", "reads", "panel"];

/// What a panel asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A simulation in time (`[run]`).
    Run,
    /// A value over two parameters (`[map]`).
    Map,
    /// A function of one variable (`[curve]`).
    Curve,
    /// Outcomes of runs over two parameters (`[sweep]`).
    Sweep,
    /// No numbers: a drawing.
    Drawing,
}

/// One set of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// `"main"` where the file names no panels.
    pub name: String,
    /// What it asks for.
    pub kind: Kind,
    /// The determining tables, merged.
    pub tables: Section,
}

impl Panel {
    /// Everything that determines the numbers, a line a value, sorted; no titles, no comments, no sources.
    pub fn determinants(&self) -> String {
        let mut lines = Vec::new();
        self.tables.canonical("", &mut lines);
        lines.join("\n")
    }
}

/// A scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// The file, as it was named.
    pub file: String,
    /// What it shows, in words.
    pub title: String,
    /// The label of the paper.
    pub source: String,
    /// The committed tables that a figure's program reads beside it: names below `data`, without `.csv`.
    pub reads: Vec<String>,
    /// The panels in alphabetical order.
    pub panels: Vec<Panel>,
    /// Where each number comes from: dotted key, then a label of the paper or `chosen: why`.
    pub origin: Vec<(String, String)>,
}

impl SceneFile {
    /// The panel of this name.
    ///
    /// # Errors
    /// There is no such panel; the message lists the names.
    pub fn panel(&self, name: &str) -> Result<&Panel, SceneError> {
        self.panels.iter().find(|panel| panel.name == name).ok_or_else(|| {
            let names: Vec<&str> = self.panels.iter().map(|panel| panel.name.as_str()).collect();
            self.error(0, format!("no panel {name}; the scene has {}", names.join(", ")))
        })
    }

    fn error(&self, line: usize, problem: String) -> SceneError {
        SceneError::new(&self.file, line, problem)
    }
}

/// Reads a scene file.
///
/// # Errors
/// The file cannot be read, is not TOML, or has an unknown table.
pub fn read(path: &Path) -> Result<SceneFile, SceneError> {
    let file = path.display().to_string();
    let text = text::read(path).map_err(|(line, problem)| SceneError::new(&file, line, problem))?;
    parse(&file, &text)
}

/// Parses the text of a scene file; `file` is only for messages.
///
/// # Errors
/// The text is not TOML, or has an unknown table.
pub fn parse(file: &str, text: &str) -> Result<SceneFile, SceneError> {
    read_section(file, &Section::parse(file, text)?)
}

/// Reads a scene from the tables of its file; `file` is only for messages.
///
/// # Errors
/// There is an unknown table.
pub fn read_section(file: &str, document: &Section) -> Result<SceneFile, SceneError> {
    let complain = |line, problem| SceneError::new(file, line, problem);
    for (key, entry) in &document.entries {
        if !DETERMINING.contains(&key.as_str()) && !DESCRIBING.contains(&key.as_str()) {
            let known = [&DESCRIBING[..], &DETERMINING[..]].concat().join(", ");
            return Err(complain(entry.line, format!("{key}: unknown key; known here: {known}")));
        }
    }
    let base = determining(document);
    let panels = match document.section("panel") {
        None => vec![Panel { name: "main".to_owned(), kind: kind(&base), tables: base }],
        Some(named) => panels(&base, named).map_err(|(line, problem)| complain(line, problem))?,
    };
    Ok(SceneFile {
        file: file.to_owned(),
        title: words(document, "title").map_err(|(line, problem)| complain(line, problem))?,
        source: words(document, "source").map_err(|(line, problem)| complain(line, problem))?,
        reads: reads(document).map_err(|(line, problem)| complain(line, problem))?,
        panels,
        origin: origin(document).map_err(|(line, problem)| complain(line, problem))?,
    })
}

fn panels(base: &Section, named: &Section) -> Result<Vec<Panel>, (usize, String)> {
    let mut lower: BTreeMap<String, (&str, usize)> = BTreeMap::new();
    for (name, entry) in &named.entries {
        // on some file systems the files of both would be one
        if let Some((other, line)) = lower.insert(name.to_ascii_lowercase(), (name, entry.line)) {
            let problem = format!("panel.{name}: differs from panel.{other} (line {line}) in case only");
            return Err((entry.line, format!("{problem}; both name files: must differ in more")));
        }
    }
    named
        .entries
        .iter()
        .map(|(name, entry)| {
            // the name becomes that of a file
            let is_good = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
            if name.is_empty() || !name.bytes().all(is_good) {
                let problem = "must be a name of the letters a to z and A to Z, digits, _ and -";
                return Err((entry.line, format!("panel.{name:?}: {problem}")));
            }
            if is_device(name) {
                let problem = "is the name of a device on Windows, with any ending; must be another";
                return Err((entry.line, format!("panel.{name}: {problem}")));
            }
            let Value::Section(over) = &entry.value else {
                return Err((entry.line, format!("panel.{name}: must be a table")));
            };
            if let Some((key, entry)) = over.entries.iter().find(|(key, _)| !DETERMINING.contains(&key.as_str())) {
                return Err((
                    entry.line,
                    format!("panel.{name}.{key}: unknown key; known here: {}", DETERMINING.join(", ")),
                ));
            }
            let mut tables = base.clone();
            tables.overlay(over);
            Ok(Panel { name: name.clone(), kind: kind(&tables), tables })
        })
        .collect()
}

/// Whether files of this name, whatever follows a dot, are devices on Windows: what is written there is lost.
fn is_device(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let port = ["com", "lpt"].iter().find_map(|kind| name.strip_prefix(kind));
    ["con", "prn", "aux", "nul"].contains(&name.as_str())
        || port.is_some_and(|port| port.len() == 1 && port.bytes().all(|byte| byte.is_ascii_digit()))
}

fn determining(document: &Section) -> Section {
    let mut base = document.clone();
    base.entries.retain(|key, _| DETERMINING.contains(&key.as_str()));
    base
}

fn kind(tables: &Section) -> Kind {
    let has = |key: &str| tables.entries.contains_key(key);
    match () {
        () if has("sweep") => Kind::Sweep,
        () if has("run") => Kind::Run,
        () if has("map") => Kind::Map,
        () if has("curve") => Kind::Curve,
        () => Kind::Drawing,
    }
}

/// A text at the top of the file; empty when it is missing.
fn words(document: &Section, key: &str) -> Result<String, (usize, String)> {
    match document.entries.get(key) {
        None => Ok(String::new()),
        Some(Entry { value: Value::Text(text), .. }) => Ok(text.clone()),
        Some(entry) => Err((entry.line, format!("{key}: must be a text"))),
    }
}

/// Names between blanks, as in a path: `reads = "outcomes/plain outcomes/how_sure"`.
fn reads(document: &Section) -> Result<Vec<String>, (usize, String)> {
    let names: Vec<String> = words(document, "reads")?.split_whitespace().map(str::to_owned).collect();
    let is_good = |name: &String| name.split('/').all(|part| !part.is_empty() && !part.starts_with('.'));
    match names.iter().find(|name| !is_good(name)) {
        Some(name) => Err((
            document.entries.get("reads").map_or(0, |entry| entry.line),
            format!("reads: {name:?}: must be the name of a table below data, such as outcomes/plain"),
        )),
        None => Ok(names),
    }
}

fn origin(document: &Section) -> Result<Vec<(String, String)>, (usize, String)> {
    let Some(section) = document.section("origin") else {
        return Ok(Vec::new());
    };
    section
        .entries
        .iter()
        .map(|(key, entry)| match &entry.value {
            Value::Text(text) => Ok((key.clone(), text.clone())),
            _ => Err((entry.line, format!("origin.{key}: must be a text"))),
        })
        .collect()
}
