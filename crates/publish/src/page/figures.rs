//! The figures as HTML: picture, caption, and facts about each.

use super::data;
use super::formula::prose;
use super::html::{self, code, escape, number, table};
use super::scenes;
use super::source::Source;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::manifest::Entry;
use checkout::outputs;
use checkout::paths::Paths;
use claims::report::JudgedClaim;
use std::fmt::Write as _;

/// Digits of a hash that are shown.
const DIGITS: usize = 16;

/// An article for each figure that `chosen` names.
///
/// # Errors
/// A picture, or the words for it, are missing.
pub fn articles(source: &Source<'_>, chosen: impl Fn(&Figure) -> bool) -> Result<String, Failure> {
    source.figures.iter().filter(|figure| chosen(figure)).map(|figure| article(source, figure)).collect()
}

fn article(source: &Source<'_>, figure: &Figure) -> Result<String, Failure> {
    let id = escape(&figure.id);
    Ok(format!(
        "<article class=\"figure\" id=\"{id}\" aria-labelledby=\"{id}-title\">\n\
         <h3 id=\"{id}-title\"><span class=\"count\">{name}</span> {title}</h3>\n\
         <figure>{picture}<figcaption>{caption}</figcaption></figure>\n{explorer}{known}</article>\n",
        name = name(figure),
        title = escape(figure.title()),
        picture = picture(source, figure)?,
        caption = caption(source, figure),
        explorer = explorer(figure),
        known = known(source, figure),
    ))
}

/// `Figure 3`, `Supplement 1`.
pub fn name(figure: &Figure) -> String {
    let digits = figure.id.trim_start_matches(|letter: char| letter.is_ascii_alphabetic()).trim_start_matches('0');
    format!("{} {digits}", if figure.is_supplement() { "Supplement" } else { "Figure" })
}

/// The picture inline: as SVG, whose lines stay sharp; a supplement with thousands of marks as pixels where these take less.
fn picture(source: &Source<'_>, figure: &Figure) -> Result<String, Failure> {
    let [png, svg] = outputs::pictures(source.paths, figure);
    let pixels = source.bytes(&png)?;
    let (width, height) = size(&pixels).ok_or_else(|| Failure::failed(format!("{png}: not a PNG")))?;
    let vectors = source.bytes(&svg)?;
    let address = match figure.is_supplement() && pixels.len() < vectors.len() {
        true => html::data_uri("image/png", &pixels),
        false => html::data_uri("image/svg+xml", &vectors),
    };
    let alternative = escape(source.alternative(&figure.id)?);
    Ok(format!(
        "<img src=\"{address}\" alt=\"{alternative}\" width=\"{width}\" height=\"{height}\" decoding=\"async\">"
    ))
}

/// Width and height that a PNG states in its first chunk.
fn size(png: &[u8]) -> Option<(u32, u32)> {
    let field = |start: usize| Some(u32::from_be_bytes(png.get(start..start + 4)?.try_into().ok()?));
    png.starts_with(b"\x89PNG").then_some(())?;
    Some((field(16)?, field(20)?))
}

fn caption(source: &Source<'_>, figure: &Figure) -> String {
    let mut caption = String::new();
    if let Ok(recipe) = &figure.recipe {
        let shared = scenes::shared(recipe);
        let law = shared.get("law.kind").map(|kind| format!("{} law", capital(&escape(kind))));
        let values = shared.iter().filter(|(key, _)| {
            ["law.", "ring.", "start.", "uniform."].iter().any(|start| key.starts_with(start)) && *key != "law.kind"
        });
        let values = values.map(|(key, value)| escape(&scenes::equation(key, value)));
        let all: Vec<String> = law.into_iter().chain(values).collect();
        if !all.is_empty() {
            let _ = write!(caption, "{}. ", all.join(", "));
        }
        for panel in recipe.panels.iter().filter(|_| recipe.panels.len() > 1 && !figure.is_supplement()) {
            let difference = scenes::difference(recipe, panel);
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

/// Where the script builds maps and curves; empty for figures that have none.
fn explorer(figure: &Figure) -> String {
    let id = escape(&figure.id);
    match () {
        () if data::has_maps(figure) => format!("<div class=\"explorer\" data-maps=\"{id}\" hidden></div>\n"),
        () if data::has_curves(figure) => format!("<div class=\"explorer\" data-curves=\"{id}\" hidden></div>\n"),
        () => String::new(),
    }
}

/// Parameters, errors and files, folded.
fn known(source: &Source<'_>, figure: &Figure) -> String {
    let name = name(figure);
    let mut html = String::from("<details class=\"known\"><summary>Parameters, errors, files</summary>\n");
    html.push_str(&parameters(figure, &name));
    html.push_str(&outputs_table(source, figure, &name));
    let folder = Paths::figure_folder(&figure.slug);
    let _ = write!(
        html,
        "<p>Script {}, scene {}, made by {}. Label in the paper: {}.</p>\n{}</details>\n",
        code(&format!("{folder}main.rs")),
        code(&Paths::scene(&figure.slug)),
        code(&format!("cargo xtask figures {}", figure.id)),
        code(figure.recipe.as_ref().map_or("", |recipe| recipe.source.as_str())),
        claims(source, figure),
    );
    html
}

fn parameters(figure: &Figure, name: &str) -> String {
    let Ok(recipe) = &figure.recipe else { return String::new() };
    let cells = |[symbol, value, panel, key, origin]: [String; 5]| {
        vec![escape(&symbol), escape(&value), escape(&panel), code(&key), prose(&origin)]
    };
    let rows: Vec<Vec<String>> = scenes::rows(recipe).into_iter().map(cells).collect();
    match rows.is_empty() {
        true => String::new(),
        false => table(
            &format!("Parameters of {name}"),
            &["parameter", "value", "panel", "key", "where it comes from"],
            &rows,
        ),
    }
}

fn outputs_table(source: &Source<'_>, figure: &Figure, name: &str) -> String {
    let pictures = outputs::pictures(source.paths, figure);
    let pictures = pictures.iter().filter_map(|name| source.manifest.get_key_value(name));
    let row = |(name, entry): (&String, &Entry)| {
        let text = |key: &str| entry.counts.get(key).map_or(String::new(), json_text);
        let errors = entry.error.iter().map(|(column, error)| {
            format!("{column}: {}", error.map_or("unknown".to_owned(), |error| number(error, 2)))
        });
        let hash = entry.sha256.get(..DIGITS).unwrap_or(&entry.sha256);
        vec![
            code(name),
            escape(&text("method")),
            text("tolerance"),
            text("steps"),
            errors.collect::<Vec<_>>().join("<br>"),
            format!("<code title=\"{}\">{hash}…</code>", entry.sha256),
        ]
    };
    let rows: Vec<Vec<String>> = tables(source, figure).chain(pictures).map(row).collect();
    let head = ["output", "method", "tolerance", "steps", "difference, of the range", "SHA-256"];
    table(&format!("Outputs of {name}"), &head, &rows)
}

fn json_text(value: &serde_json::Value) -> String {
    match value {
        serde_json::Value::String(text) => text.clone(),
        serde_json::Value::Number(value) => value.as_f64().map_or(String::new(), |value| number(value, 15)),
        _ => String::new(),
    }
}

/// Links to the claims that stand at the figure's label.
fn claims(source: &Source<'_>, figure: &Figure) -> String {
    let label = figure.label();
    let mine = source.ledger.claims.iter().filter(|claim| !label.is_empty() && claim.label == label);
    let link = |claim: &JudgedClaim| {
        let (id, verdict) = (escape(&claim.id), claim.verdict.words());
        format!("<li><a href=\"#claim-{id}\">{}</a> ({verdict})</li>", prose(&claim.says))
    };
    let items: String = mine.map(link).collect();
    if items.is_empty() {
        String::new()
    } else {
        format!("<p>What the paper says at this label:</p><ul>{items}</ul>\n")
    }
}
