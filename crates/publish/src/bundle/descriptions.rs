//! What describes the archive for repositories: `ro-crate-metadata.json` (the run of all figures as a Workflow Run
//! RO-Crate, an action for each figure), `codecheck.yml` (which files a CODECHECK should make again) and
//! `.zenodo.json`. Each is a template beside this file, whose slots `{name}` are filled in. Dates are the commit's: the
//! runs know no clock.

use super::Members;
use super::git::Commit;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs;
use checkout::paths::Paths;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// The source that stands for the whole run in the description of the archive.
pub const MAIN_WORKFLOW: &str = "xtask/src/verbs/figures.rs";

const RO_CRATE: &str = include_str!("ro-crate.json");
const ZENODO: &str = include_str!("zenodo.json");
const CODECHECK: &str = include_str!("codecheck.yml");

/// The files by name. `members` are those of the archive; outputs that are not among them are left out.
///
/// # Errors
/// A folder of tables cannot be read.
pub fn texts(
    paths: &Paths,
    figures: &[Figure],
    commit: &Commit,
    members: &Members,
) -> Result<[(&'static str, String); 3], Failure> {
    let Commit { hash, date, time, .. } = commit;
    let slots = [("hash", &**hash), ("date", date), ("time", time), ("version", env!("CARGO_PKG_VERSION"))];
    let mut all = fill(&template(RO_CRATE)?, &slots);
    let part = |all: &mut Value, name: &str| match all[name].take() {
        Value::Array(entities) => entities,
        one => vec![one],
    };
    let mut graph = part(&mut all, "frame");
    let (figure_form, output_form) = (all["figure"].take(), all["output"].take());
    let (mut parts, mut scenes, mut results, mut actions) =
        (vec![id(MAIN_WORKFLOW), id("README.md")], Vec::new(), Vec::new(), Vec::new());
    let mut codecheck = CODECHECK.to_owned();
    for figure in figures.iter().filter(|figure| !figure.is_supplement()) {
        let (scene, program) = (Paths::scene(&figure.slug), Paths::figure_folder(&figure.slug) + "main.rs");
        let mut made = outputs::tables(paths, figure)?;
        made.extend(outputs::pictures(paths, figure));
        made.retain(|name| members.contains_key(name));
        let slots = [
            ("id", figure.id.as_str()),
            ("slug", &figure.slug),
            ("title", figure.title()),
            ("label", figure.label()),
            ("scene", &scene),
            ("program", &program),
        ];
        let mut entities = fill(&figure_form, &slots);
        let outputs: Vec<Value> = made.iter().map(|name| id(name)).collect();
        entities[2]["result"] = json!(outputs);
        actions.push(id(&format!("#{}", figure.id)));
        scenes.push(id(&scene));
        parts.extend([id(&scene), id(&program)].into_iter().chain(outputs.clone()));
        results.extend(outputs);
        graph.extend(entities.as_array_mut().map(std::mem::take).unwrap_or_default());
        for name in &made {
            let (kind, media) = kind(name);
            graph.push(fill(&fill(&output_form, &slots), &[("file", name), ("type", media)]));
            let comment = format!("{kind} of {} ({}): cargo xtask figures {}", figure.id, figure.label(), figure.id);
            // a text of JSON is one of YAML
            let _ = write!(codecheck, "  - file: {}\n    comment: {}\n", json!(name), json!(comment));
        }
    }
    for folder in part(&mut all, "folders") {
        parts.push(json!({ "@id": folder["@id"] }));
        graph.push(folder);
    }
    all["root"]["hasPart"] = json!(parts);
    all["root"]["mentions"] = std::iter::once(id("#figures")).chain(actions).collect();
    (all["run"]["object"], all["run"]["result"]) = (json!(scenes), json!(results));
    graph.extend([all["root"].take(), all["run"].take()]);
    let ro_crate = json!({ "@context": all["context"], "@graph": graph });
    Ok([
        ("codecheck.yml", codecheck),
        (".zenodo.json", pretty(&fill(&template(ZENODO)?, &slots))?),
        ("ro-crate-metadata.json", pretty(&ro_crate)?),
    ])
}

fn id(name: &str) -> Value {
    json!({ "@id": name })
}

fn template(text: &str) -> Result<Value, Failure> {
    serde_json::from_str(text).map_err(Failure::failed)
}

fn pretty(value: &Value) -> Result<String, Failure> {
    serde_json::to_string_pretty(value).map(|text| text + "\n").map_err(Failure::failed)
}

/// A value with texts in place of the slots `{name}` of its texts.
fn fill(value: &Value, slots: &[(&str, &str)]) -> Value {
    match value {
        Value::String(text) => {
            slots.iter().fold(text.clone(), |text, (name, with)| text.replace(&format!("{{{name}}}"), with)).into()
        }
        Value::Array(list) => list.iter().map(|one| fill(one, slots)).collect(),
        Value::Object(map) => map.iter().map(|(key, one)| (key.clone(), fill(one, slots))).collect(),
        other => other.clone(),
    }
}

/// What a file is, and its media type.
fn kind(name: &str) -> (&'static str, &'static str) {
    match name.rsplit('.').next() {
        Some("csv") => ("table", "text/csv"),
        Some("png") => ("picture", "image/png"),
        _ => ("picture", "image/svg+xml"),
    }
}
