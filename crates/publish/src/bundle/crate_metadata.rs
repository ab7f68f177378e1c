//! `ro-crate-metadata.json`: the run of all figures as a Workflow Run RO-Crate, with one action for each figure.
//!
//! Dates are the commit's: the runs themselves know no clock.

use super::git::Commit;
use super::{Members, paper};
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs;
use checkout::paths::{Paths, VENDOR};
use serde_json::{Value, json};

/// The source that stands for the whole run in the description of the archive.
pub const MAIN_WORKFLOW: &str = "xtask/src/verbs/figures.rs";

/// The form of the file and the profiles it follows.
const CRATE: &str = "https://w3id.org/ro/crate/1.1";
const PROFILES: [(&str, &str, &str); 3] = [
    ("https://w3id.org/ro/wfrun/process/0.5", "Process Run Crate", "0.5"),
    ("https://w3id.org/ro/wfrun/workflow/0.5", "Workflow Run Crate", "0.5"),
    ("https://w3id.org/workflowhub/workflow-ro-crate/1.0", "Workflow RO-Crate", "1.0"),
];
/// Folders that are described whole.
const FOLDERS: [(&str, &str); 3] = [
    ("crates/", "Laws, integration, drawing: the libraries"),
    ("data/", "Tables of all figures, their sums and descriptions"),
    (VENDOR, "Sources of all crates that the lock file names"),
];
const MAKERS: &str = "#makers";
const README: &str = "README.md";
const RUST: &str = "#rust";

/// The file. `members` are those of the archive, of which only existing ones are described.
///
/// # Errors
/// A folder of tables cannot be read.
pub fn text(paths: &Paths, figures: &[Figure], commit: &Commit, members: &Members) -> Result<String, Failure> {
    let paper: Vec<&Figure> = figures.iter().filter(|figure| !figure.is_supplement()).collect();
    let mut graph = frame(commit);
    let (mut parts, mut scenes, mut results) =
        (vec![MAIN_WORKFLOW.to_owned(), README.to_owned()], Vec::new(), Vec::new());
    for figure in &paper {
        let described = describe(paths, figure, commit, members)?;
        scenes.push(Paths::scene(&figure.slug));
        results.extend(described.results.clone());
        parts.extend(described.files);
        graph.extend(described.entities);
    }
    for (name, words) in FOLDERS.map(|(name, words)| (folder(name), words)) {
        graph.push(json!({ "@id": name, "@type": "Dataset", "name": name, "description": words }));
        parts.push(name);
    }
    let actions: Vec<String> = paper.iter().map(|figure| action(figure)).collect();
    graph.push(root(commit, &parts, &actions));
    graph.push(whole_run(commit, &scenes, &results));
    let value = json!({ "@context": format!("{CRATE}/context"), "@graph": graph });
    let text = serde_json::to_string_pretty(&value).map_err(Failure::failed)?;
    Ok(format!("{text}\n"))
}

fn folder(name: &str) -> String {
    format!("{}/", name.trim_end_matches('/'))
}

fn ids(names: &[String]) -> Vec<Value> {
    names.iter().map(|name| json!({ "@id": name })).collect()
}

/// The descriptor, the profiles, the workflow, who and what with.
fn frame(commit: &Commit) -> Vec<Value> {
    let mut graph = vec![
        json!({
            "@id": "ro-crate-metadata.json", "@type": "CreativeWork", "about": { "@id": "./" },
            "conformsTo": [{ "@id": CRATE }, { "@id": PROFILES[2].0 }],
        }),
        json!({ "@id": MAKERS, "@type": "Organization", "name": paper::MAKERS }),
        json!({ "@id": paper::address(), "@type": "ScholarlyArticle", "name": paper::TITLE, "identifier": paper::address() }),
        json!({
            "@id": RUST, "@type": "ComputerLanguage", "name": "Rust", "identifier": { "@id": "https://www.rust-lang.org/" },
            "url": { "@id": "https://www.rust-lang.org/" },
        }),
        json!({
            "@id": MAIN_WORKFLOW, "@type": ["File", "SoftwareSourceCode", "ComputationalWorkflow"],
            "name": "cargo xtask figures", "description": "Plans the runs, starts the figures' programs, judges what they wrote",
            "programmingLanguage": { "@id": RUST }, "version": paper::VERSION, "creator": { "@id": MAKERS },
            "license": { "@id": "https://spdx.org/licenses/MIT" }, "encodingFormat": "text/x-rust",
            "dateModified": commit.date, "input": { "@id": "#scenes" }, "output": { "@id": "#outputs" },
            "conformsTo": { "@id": "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE" },
        }),
        json!({
            "@id": README, "@type": "File", "name": "How to make everything again", "about": { "@id": "./" },
            "encodingFormat": "text/markdown",
        }),
        parameter("#scenes", "scenes", "Scene files: every parameter and where it comes from"),
        parameter("#outputs", "outputs", "Tables and pictures"),
        license("MIT", "MIT License"),
        license("CC0-1.0", "Creative Commons Zero 1.0"),
    ];
    graph
        .extend(PROFILES.map(
            |(id, name, version)| json!({ "@id": id, "@type": "CreativeWork", "name": name, "version": version }),
        ));
    graph
}

fn license(id: &str, name: &str) -> Value {
    let address = format!("https://spdx.org/licenses/{id}");
    json!({ "@id": address, "@type": "CreativeWork", "name": name, "url": address, "description": name })
}

fn parameter(id: &str, name: &str, words: &str) -> Value {
    json!({
        "@id": id, "@type": "FormalParameter", "additionalType": "File", "name": name, "description": words,
        "valueRequired": true, "conformsTo": { "@id": "https://bioschemas.org/profiles/FormalParameter/1.0-RELEASE" },
    })
}

fn root(commit: &Commit, parts: &[String], actions: &[String]) -> Value {
    let mut mentions = vec![json!({ "@id": "#figures" })];
    mentions.extend(ids(actions));
    json!({
        "@id": "./", "@type": "Dataset", "name": paper::SOFTWARE, "description": paper::DESCRIPTION,
        "identifier": commit.hash, "version": paper::VERSION, "datePublished": commit.date,
        "license": { "@id": "https://spdx.org/licenses/MIT" }, "author": { "@id": MAKERS }, "publisher": { "@id": MAKERS }, "keywords": paper::KEYWORDS.join(", "),
        "citation": { "@id": paper::address() }, "mainEntity": { "@id": MAIN_WORKFLOW },
        "conformsTo": PROFILES.map(|(id, ..)| json!({ "@id": id })), "hasPart": ids(parts), "mentions": mentions,
    })
}

fn whole_run(commit: &Commit, scenes: &[String], results: &[String]) -> Value {
    json!({
        "@id": "#figures", "@type": "CreateAction", "name": "All figures of the paper",
        "description": "cargo xtask figures; the date is that of the commit", "instrument": { "@id": MAIN_WORKFLOW }, "agent": { "@id": MAKERS },
        "endTime": commit.time, "actionStatus": "http://schema.org/CompletedActionStatus",
        "object": ids(scenes), "result": ids(results),
    })
}

/// What is said of one figure.
struct Described {
    files: Vec<String>,
    results: Vec<String>,
    entities: Vec<Value>,
}

fn action(figure: &Figure) -> String {
    format!("#{}", figure.id)
}

fn describe(paths: &Paths, figure: &Figure, commit: &Commit, members: &Members) -> Result<Described, Failure> {
    let (scene, program) = (Paths::scene(&figure.slug), Paths::program(&figure.slug));
    let mut results = outputs::tables(paths, figure)?;
    results.extend(outputs::pictures(paths, figure));
    results.retain(|name| members.contains_key(name));
    let mut entities = vec![
        json!({
            "@id": scene, "@type": "File", "name": format!("Scene of {}", figure.id), "encodingFormat": "application/toml",
            "exampleOfWork": { "@id": "#scenes" },
        }),
        json!({
            "@id": program, "@type": ["File", "SoftwareApplication"], "name": figure.slug, "encodingFormat": "text/x-rust",
            "description": figure.title(), "url": paper::address(), "softwareVersion": paper::VERSION,
        }),
        json!({
            "@id": action(figure), "@type": "CreateAction", "name": figure.title(),
            "description": format!("cargo xtask figures {}", figure.id), "instrument": { "@id": program },
            "agent": { "@id": MAKERS }, "object": { "@id": scene }, "result": ids(&results),
            "endTime": commit.time, "actionStatus": "http://schema.org/CompletedActionStatus",
        }),
    ];
    for name in &results {
        entities.push(json!({
            "@id": name, "@type": "File", "name": name, "encodingFormat": media_type(name),
            "description": format!("{} ({})", figure.title(), figure.label()), "exampleOfWork": { "@id": "#outputs" },
            "license": { "@id": "https://spdx.org/licenses/CC0-1.0" },
        }));
    }
    let files = [scene, program].into_iter().chain(results.clone()).collect();
    Ok(Described { files, results, entities })
}

fn media_type(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("csv") => "text/csv",
        Some("png") => "image/png",
        _ => "image/svg+xml",
    }
}
