//! The page: one HTML file that carries text, pictures, numbers and script, and asks nothing of any network.
//!
//! `source` reads what it is made from, `figures` and `accuracy` say what is shown of it, `data` the numbers for the
//! script; `parts` holds the templates, the style sheet and the script. Every measured number comes from a table, the
//! manifest or the ledger.
//!
//! The page computes: `crates/browser`, built with the profile `page` for `wasm32-unknown-unknown` by the runner, lies
//! in it packed. Where no compiler has that target the page is written without, and says how to get it. Its committed
//! sum is that of the page without the module, whose bytes belong to a compiler; `checks/browser` compares the sum of
//! every table that the module computes.
//!
//! ```text
//! module -> worker (engine.js, worker.js) -> sums of a figure's tables -> verify.js, receipt.js
//!   -> cargo xtask verify --receipt FILE
//! fields (own.js, dial.js) -> text of a scene file (scene-text.js) -> module: stability, at once -> worker: run
//!   -> run-view.js
//! claims (rejudged) and the panel that the scene began from -> worker: judge, after the run -> rejudged.js
//! ```
//!
//! The text of the scene file is all that goes into the module, so the file that a reader saves is what was run.

pub mod accuracy;
pub mod data;
pub mod figures;
pub mod formula;
pub mod html;
pub mod laws;
pub mod module;
pub mod pack;
pub mod rejudged;
pub mod scenes;
pub mod source;
pub mod sums;

use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;
use claims::entry::Verdict;
use minijinja::value::Serde;
use minijinja::{Value, context};
use source::Source;
use verify::attest::{self, Attestation};
use verify::published::{Curve, Points};

/// The page with a slot for each text.
pub const TEMPLATE: &str = include_str!("parts/template.html");
/// What the ledger and the figures are shown by.
const ENTRIES: &str = include_str!("parts/entries.html");
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
    let joined = |files: &[(&str, &str)]| Value::from_safe_string(files.iter().map(|(_, text)| *text).collect());
    let of = |chosen: fn(&Figure) -> bool| {
        let figures = source.figures.iter().filter(|figure| chosen(figure));
        figures.map(|figure| figures::shown(&source, figure)).collect::<Result<Vec<Value>, Failure>>()
    };
    let verdict = |verdict: Verdict| {
        let words = verdict.words();
        context! { words, class => words.replace(' ', "-"), count => source.ledger.count(verdict) }
    };
    let (table_count, largest_error_table, largest_error) = errors(&source);
    let context = context! {
        style => Value::from_safe_string(STYLE.to_owned()), script => joined(&SCRIPTS), worker => joined(&WORKER),
        // inside a script, `<` could end it
        index => Value::from_safe_string(data.index.to_string().replace('<', "\\u003c")),
        elements => Value::from_safe_string(data.elements),
        figures => of(|figure| !figure.is_supplement())?,
        precision => of(|figure| figure.is_supplement() && figure.slug.contains(PRECISION))?,
        supplements => of(|figure| figure.is_supplement() && !figure.slug.contains(PRECISION))?,
        ledger => Value::from(Serde(&source.ledger)), verdicts => Verdict::ALL.map(verdict),
        table_count, largest_error_table, largest_error,
        distances => distances(&source)?, cheapest => accuracy::cheapest(&source)?, events => accuracy::events(&source)?,
        machines => machines(paths)?,
    };
    html::render([("page.html", TEMPLATE), ("entries.html", ENTRIES)], context)
}

/// The number of tables of figures; the table and the size of the largest error among them.
fn errors(source: &Source<'_>) -> (usize, String, Option<f64>) {
    let of_figures = || source.manifest.iter().filter(|(name, _)| name.starts_with("data/fig"));
    let errors = of_figures().flat_map(|(name, entry)| entry.error.values().map(move |error| (name, *error)));
    let largest = errors.max_by(|a, b| a.1.unwrap_or(f64::INFINITY).total_cmp(&b.1.unwrap_or(f64::INFINITY)));
    let (table, error) = largest.map_or((String::new(), None), |(name, error)| (name.clone(), error));
    (of_figures().count(), table, error)
}

/// Who got the same bits: the lines that `verify --attest` has added, against the committed sums.
fn machines(paths: &Paths) -> Result<Vec<[String; 6]>, Failure> {
    let row = |(one, is_same): (Attestation, bool)| {
        let got = if is_same { "the committed bits" } else { "other bits" };
        [one.processor, one.architecture, one.features.join(", "), one.system, one.rustc, got.to_owned()]
    };
    Ok(attest::compared(paths)?.into_iter().map(row).collect())
}

/// How far published and regenerated numbers are apart: rows of HTML.
fn distances(source: &Source<'_>) -> Result<Vec<Vec<Value>>, Failure> {
    let row = |(curve, points, reading): (Curve, Points, f64)| {
        let verdict = if points.largest() <= reading { "within the reading error" } else { "beyond the reading error" };
        html::row([
            html::escape(curve.title),
            html::code(&curve.source()),
            points.all.to_string(),
            html::number(points.largest(), 2),
            html::number(points.root_mean_square(), 2),
            html::number(reading, 2),
            verdict.to_owned(),
        ])
    };
    Ok(data::published(source)?.into_iter().map(row).collect())
}
