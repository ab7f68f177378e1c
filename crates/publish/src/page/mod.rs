//! The page: one HTML file that carries text, pictures, numbers and script, and asks nothing of any network.
//!
//! `source` reads what it is made from, `figures`, `claims` and `accuracy` write HTML, `data` the numbers for the
//! script; `parts` holds the template, the style sheet and the script as they are. Every measured number comes from a
//! table, the manifest or the ledger.
//!
//! The page computes: `crates/browser`, built with the profile `page` for `wasm32-unknown-unknown` by the runner, lies in it
//! packed. Where no compiler has that target the page is written without, and says how to get it. Its committed sum is that of
//! the page without the module, whose bytes belong to a compiler; `checks/browser` compares the sum of every table that the
//! module computes.
//!
//! ```text
//! module -> worker (engine.js, worker.js) -> sums of a figure's tables -> verify.js, receipt.js -> cargo xtask verify --receipt FILE
//! fields (own.js, dial.js) -> text of a scene file (scene-text.js) -> module: stability, at once -> worker: run -> run-view.js
//! claims (rejudged) and the panel that the scene began from -> worker: judge, after the run -> rejudged.js
//! ```
//!
//! The text of the scene file is all that goes into the module, so the file that a reader saves is what was run.

pub mod accuracy;
pub mod claims;
pub mod data;
pub mod figures;
pub mod formula;
pub mod html;
pub mod laws;
pub mod machines;
pub mod module;
pub mod pack;
pub mod rejudged;
pub mod scenes;
pub mod source;
pub mod sums;

use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;
use source::Source;
use std::collections::BTreeMap;

/// The page with a slot for each text.
pub const TEMPLATE: &str = include_str!("parts/template.html");
/// How it looks.
pub const STYLE: &str = include_str!("parts/style.css");
/// What it does, in the order in which it is read.
pub const SCRIPTS: [(&str, &str); 21] = [
    ("base.js", include_str!("parts/base.js")),
    ("numbers.js", include_str!("parts/numbers.js")),
    ("map.js", include_str!("parts/map.js")),
    ("chart.js", include_str!("parts/chart.js")),
    ("ring.js", include_str!("parts/ring.js")),
    ("published.js", include_str!("parts/published.js")),
    ("claims.js", include_str!("parts/claims.js")),
    ENGINE,
    ("module.js", include_str!("parts/module.js")),
    ("difference.js", include_str!("parts/difference.js")),
    ("receipt.js", include_str!("parts/receipt.js")),
    ("verify.js", include_str!("parts/verify.js")),
    ("scene-text.js", include_str!("parts/scene-text.js")),
    ("dial.js", include_str!("parts/dial.js")),
    ("motion.js", include_str!("parts/motion.js")),
    ("rejudged.js", include_str!("parts/rejudged.js")),
    ("run-view.js", include_str!("parts/run-view.js")),
    ("fields.js", include_str!("parts/fields.js")),
    ("flow-view.js", include_str!("parts/flow-view.js")),
    ("own.js", include_str!("parts/own.js")),
    ("start.js", include_str!("parts/start.js")),
];
/// What its workers do.
pub const WORKER: [(&str, &str); 2] = [ENGINE, ("worker.js", include_str!("parts/worker.js"))];
/// How the module is called, by the page and by its workers.
const ENGINE: (&str, &str) = ("engine.js", include_str!("parts/engine.js"));
/// How the slugs of supplements about error against work begin, after the number.
const PRECISION: &str = "-precision-";

/// Writes the page.
///
/// # Errors
/// Something that it is made from is missing or malformed.
pub fn render(paths: &Paths) -> Result<String, Failure> {
    let source = Source::read(paths)?;
    let data = data::collect(&source)?;
    let mut slots = sections(&source)?;
    // inside a script, `<` could end it
    let index = data.index.to_string().replace('<', "\\u003c");
    let joined = |files: &[(&str, &str)]| files.iter().map(|(_, text)| *text).collect::<String>();
    slots.extend([("style", STYLE.to_owned()), ("script", joined(&SCRIPTS)), ("worker", joined(&WORKER))]);
    slots.extend([("index", index), ("elements", data.elements)]);
    html::fill(TEMPLATE, &slots)
}

/// The texts of the slots.
fn sections(source: &Source<'_>) -> Result<BTreeMap<&'static str, String>, Failure> {
    let ledger = &source.ledger;
    let is_paper = |figure: &Figure| !figure.is_supplement();
    let is_precision = |figure: &Figure| figure.is_supplement() && figure.slug.contains(PRECISION);
    let is_other = |figure: &Figure| figure.is_supplement() && !figure.slug.contains(PRECISION);
    let mut slots = BTreeMap::from([
        ("glance", claims::glance(ledger)),
        ("figures", figures::articles(source, is_paper)?),
        ("precision", figures::articles(source, is_precision)?),
        ("supplements", figures::articles(source, is_other)?),
        ("cheapest", accuracy::cheapest(source)?),
        ("events", accuracy::events(source)?),
        ("verdict_boxes", claims::verdict_boxes(ledger)),
        ("label_options", claims::label_options(ledger)),
        ("claims", claims::claims(ledger)),
        ("errata", claims::errata(ledger)),
        ("parameters", claims::parameters(ledger)),
        ("contents", contents(source)),
        ("machines", machines::rows(source)?),
    ]);
    slots.extend(counts(source));
    slots.extend(distances(source)?);
    Ok(slots)
}

/// Links to the figures.
fn contents(source: &Source<'_>) -> String {
    let link = |figure: &Figure| {
        let (id, name, title) = (&figure.id, figures::name(figure), html::escape(figure.title()));
        format!("<li><a href=\"#{id}\">{name}</a> <span>{title}</span></li>\n")
    };
    source.figures.iter().filter(|figure| !figure.is_supplement()).map(link).collect()
}

/// How many there are of what.
fn counts(source: &Source<'_>) -> BTreeMap<&'static str, String> {
    let is_figure = |name: &str| name.starts_with("data/fig");
    let tables = source.manifest.keys().filter(|name| is_figure(name)).count();
    let errors = source.manifest.iter().filter(|(name, _)| is_figure(name));
    let errors = errors.flat_map(|(name, entry)| entry.error.values().map(move |error| (name, *error)));
    let largest = errors.max_by(|a, b| a.1.unwrap_or(f64::INFINITY).total_cmp(&b.1.unwrap_or(f64::INFINITY)));
    let (table, error) = largest.map_or((String::new(), None), |(name, error)| (name.clone(), error));
    let of_paper = source.figures.iter().filter(|figure| !figure.is_supplement()).count();
    BTreeMap::from([
        ("figure_count", of_paper.to_string()),
        ("supplement_count", (source.figures.len() - of_paper).to_string()),
        ("table_count", tables.to_string()),
        ("claim_count", source.ledger.claims.len().to_string()),
        ("erratum_count", source.ledger.errata.len().to_string()),
        ("parameter_count", source.ledger.parameters.len().to_string()),
        ("largest_error", error.map_or("unknown".to_owned(), |error| html::number(error, 2))),
        ("largest_error_table", html::code(&table)),
    ])
}

/// How far published and regenerated numbers are apart.
fn distances(source: &Source<'_>) -> Result<BTreeMap<&'static str, String>, Failure> {
    let mut rows = Vec::new();
    for set in data::published(source)? {
        let (differences, reading) = (set.differences(), set.reading);
        let sum: f64 = differences.iter().map(|difference| difference * difference).sum();
        let mean = (sum / differences.len() as f64).sqrt();
        let largest =
            differences.iter().fold(0.0, |most: f64, value| if value.abs() > most { value.abs() } else { most });
        let verdict = if largest <= reading { "within the reading error" } else { "beyond the reading error" };
        rows.push(vec![
            html::escape(set.title),
            html::code(&format!("data/reference/{}.csv", set.file)),
            differences.len().to_string(),
            html::number(largest, 2),
            html::number(mean, 2),
            html::number(reading, 2),
            verdict.to_owned(),
        ]);
    }
    let head = [
        "numbers",
        "published table",
        "points",
        "largest difference",
        "root of the mean square",
        "reading error",
        "verdict",
    ];
    Ok(BTreeMap::from([("distances", html::table("Published minus regenerated numbers", &head, &rows))]))
}
