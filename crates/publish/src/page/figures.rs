//! The figures as HTML: picture, caption, and facts about each.

use super::data;
use super::formula::prose;
use super::html::{self, code, escape, number};
use super::scenes;
use super::source::Source;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::manifest::Entry;
use checkout::outputs;
use checkout::paths::Paths;
use minijinja::{Value, context};
use std::fmt::Write as _;

/// Digits of a hash that are shown.
const DIGITS: usize = 16;

/// What the page shows of a figure.
///
/// # Errors
/// A picture, or the words for it, are missing.
pub fn shown(source: &Source<'_>, figure: &Figure) -> Result<Value, Failure> {
    let scene_file = figure.scene_file.as_ref().ok();
    let cells = |[symbol, value, panel, key, origin]: [String; 5]| {
        html::row([escape(&symbol), escape(&value), escape(&panel), code(&key), prose(&origin)])
    };
    let parameters =
        scene_file.map_or(Vec::new(), |scene_file| scenes::rows(scene_file).into_iter().map(cells).collect());
    Ok(context! {
        id => &figure.id, name => name(figure), title => figure.title(), label => figure.label(),
        picture => picture(source, figure)?, caption => Value::from_safe_string(caption(source, figure)),
        explorer => explorer(figure), parameters => parameters, outputs => outputs_rows(source, figure),
        program => Paths::figure_folder(&figure.slug) + "main.rs", scene => Paths::scene(&figure.slug),
        command => format!("cargo xtask figures {}", figure.id),
        source => scene_file.map_or("", |scene_file| scene_file.source.as_str()),
    })
}

/// `Figure 3`, `Supplement 1`.
pub fn name(figure: &Figure) -> String {
    let digits = figure.id.trim_start_matches(|letter: char| letter.is_ascii_alphabetic()).trim_start_matches('0');
    format!("{} {digits}", if figure.is_supplement() { "Supplement" } else { "Figure" })
}

/// The picture inline: as SVG, whose lines stay sharp; a supplement with thousands of marks as pixels where these take
/// less.
fn picture(source: &Source<'_>, figure: &Figure) -> Result<Value, Failure> {
    let [png, svg] = outputs::pictures(source.paths, figure);
    let pixels = source.bytes(&png)?;
    let (width, height) = size(&pixels).ok_or_else(|| Failure::failed(format!("{png}: not a PNG")))?;
    let vectors = source.bytes(&svg)?;
    let address = match figure.is_supplement() && pixels.len() < vectors.len() {
        true => html::data_uri("image/png", &pixels),
        false => html::data_uri("image/svg+xml", &vectors),
    };
    Ok(context! { address, width, height, alternative => source.alternative(&figure.id)? })
}

/// Width and height that a PNG states in its first chunk.
fn size(png: &[u8]) -> Option<(u32, u32)> {
    let field = |start: usize| Some(u32::from_be_bytes(png.get(start..start + 4)?.try_into().ok()?));
    png.starts_with(b"\x89PNG").then_some(())?;
    Some((field(16)?, field(20)?))
}

fn caption(source: &Source<'_>, figure: &Figure) -> String {
    let mut caption = String::new();
    if let Ok(scene_file) = &figure.scene_file {
        let shared = scenes::shared(scene_file);
        let law = shared.get("law.kind").map(|kind| format!("{} law", capital(&escape(kind))));
        let values = shared.iter().filter(|(key, _)| {
            ["law.", "ring.", "start.", "uniform."].iter().any(|start| key.starts_with(start)) && *key != "law.kind"
        });
        let values = values.map(|(key, value)| escape(&scenes::equation(key, value)));
        let all: Vec<String> = law.into_iter().chain(values).collect();
        if !all.is_empty() {
            let _ = write!(caption, "{}. ", all.join(", "));
        }
        for panel in scene_file.panels.iter().filter(|_| scene_file.panels.len() > 1 && !figure.is_supplement()) {
            let difference = scenes::difference(scene_file, panel);
            if !difference.is_empty() {
                let _ = write!(caption, "{}: {}. ", capital(&panel.name.replace('_', " ")), escape(&difference));
            }
        }
    }
    caption.push_str(&error_words(source, figure));
    match (caption.is_empty(), tables(source, figure).count()) {
        (false, _) => caption,
        (true, 0) => "A drawing, without numbers.".to_owned(),
        (true, 1) => "Drawn from one table.".to_owned(),
        (true, count) => format!("Drawn from {count} tables."),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The largest error of the figure's tables, in words.
fn error_words(source: &Source<'_>, figure: &Figure) -> String {
    let errors = tables(source, figure).flat_map(|(_, entry)| entry.error.values().copied().collect::<Vec<_>>());
    let errors: Vec<Option<f64>> = errors.collect();
    if errors.is_empty() {
        return String::new();
    }
    match errors.into_iter().collect::<Option<Vec<f64>>>() {
        None => "A column has no second computation.".to_owned(),
        Some(errors) => {
            let largest = errors.into_iter().max_by(f64::total_cmp).unwrap_or(0.0);
            format!("Two computations differ by at most {} of the range of the data.", number(largest, 2))
        }
    }
}

/// The manifest's entries of a figure's tables, by the name of the table.
fn tables<'a>(source: &'a Source<'_>, figure: &Figure) -> impl Iterator<Item = (&'a String, &'a Entry)> {
    let start = format!("{}/", source.paths.tables(&figure.id));
    source.manifest.iter().filter(move |(name, _)| name.starts_with(&start))
}

/// What the script builds beside a figure; empty for those of which the page carries no numbers.
fn explorer(figure: &Figure) -> &'static str {
    match () {
        () if data::has_maps(figure) => "maps",
        () if data::has_curves(figure) => "curves",
        () => "",
    }
}

/// Rows of HTML: name, method, tolerance, steps, errors and hash of each output.
fn outputs_rows(source: &Source<'_>, figure: &Figure) -> Vec<Vec<Value>> {
    let pictures = outputs::pictures(source.paths, figure);
    let pictures = pictures.iter().filter_map(|name| source.manifest.get_key_value(name));
    let row = |(name, entry): (&String, &Entry)| {
        let text = |key: &str| match entry.counts.get(key) {
            Some(serde_json::Value::String(text)) => escape(text),
            Some(serde_json::Value::Number(value)) => value.as_f64().map_or(String::new(), |value| number(value, 15)),
            _ => String::new(),
        };
        let errors = entry.error.iter().map(|(column, error)| {
            format!("{column}: {}", error.map_or("unknown".to_owned(), |error| number(error, 2)))
        });
        let hash = entry.sha256.get(..DIGITS).unwrap_or(&entry.sha256);
        html::row([
            code(name),
            text("method"),
            text("tolerance"),
            text("steps"),
            errors.collect::<Vec<_>>().join("<br>"),
            format!("<code title=\"{}\">{hash}…</code>", entry.sha256),
        ])
    };
    tables(source, figure).chain(pictures).map(row).collect()
}
