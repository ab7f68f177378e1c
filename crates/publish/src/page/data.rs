//! The numbers in the page (maps, curves, trajectories, published values), packed ([`super::pack`]) and listed in a
//! JSON index.

use super::html::symbol;
use super::pack::Numbers;
use super::source::Source;
use super::{laws, rejudged, scenes, sums};
use checkout::failure::Failure;
use checkout::figure::Figure;
use files::scene_file::{Kind, Panel, SceneFile};
use files::table::Table;
use plot::ColorScale;
use serde_json::{Value, json};

/// Positions and speeds of the trajectories are rounded to this.
pub const STEP: f64 = 1e-3;
/// Its inverse, which is exact.
const PER_UNIT: f64 = 1000.0;

/// What the page carries.
#[derive(Debug, Default)]
pub struct Data {
    /// What there is.
    pub index: Value,
    /// Elements with the numbers.
    pub elements: String,
}

/// Whether a figure is made of maps that the page carries.
pub fn has_maps(figure: &Figure) -> bool {
    !figure.is_supplement() && panels(figure).any(|panel| panel.kind == Kind::Map)
}

/// Whether a figure is made of curves that the page carries.
pub fn has_curves(figure: &Figure) -> bool {
    !figure.is_supplement()
        && figure.id != "fig11"
        && panels(figure).any(|panel| panel.kind != Kind::Map && panel.kind != Kind::Drawing)
}

fn panels(figure: &Figure) -> impl Iterator<Item = &Panel> {
    figure.recipe.as_ref().map_or(&[][..], |recipe| &recipe.panels).iter()
}

/// Collects all numbers.
///
/// # Errors
/// A table is missing, or not what its scene says.
pub fn collect(source: &Source<'_>) -> Result<Data, Failure> {
    let mut numbers = Numbers::default();
    let (mut maps, mut curves) = (Vec::new(), Vec::new());
    for figure in &source.figures {
        let Ok(recipe) = &figure.recipe else { continue };
        if has_maps(figure) {
            let limit = colors(source, figure, recipe)?.limit();
            for panel in &recipe.panels {
                maps.push(map(source, figure, (recipe, panel), limit, &mut numbers)?);
            }
        } else if has_curves(figure) {
            curves.extend(figure_curves(source, figure, recipe, &mut numbers)?);
        }
    }
    let ring = ring(source, &mut numbers)?;
    let index = json!({
        "maps": maps, "curves": curves, "ring": ring, "numbers": numbers.index(), "published": published_json(source)?,
        "recomputed": sums::recomputed(source)?, "presets": laws::presets(source)?,
        "rejudged": rejudged::text(source)?,
        "diverging": ColorScale::diverging("", []).stops(), "sequential": ColorScale::sequential("", []).stops(),
    });
    Ok(Data { index, elements: numbers.element()? })
}

/// The colours that a figure's maps share.
fn colors(source: &Source<'_>, figure: &Figure, recipe: &SceneFile) -> Result<ColorScale, Failure> {
    let mut values = Vec::new();
    for panel in &recipe.panels {
        let table = source.table(&format!("{}/{}", figure.id, panel.name))?;
        values.extend(table.rows().filter_map(|row| row.get(2).copied()));
    }
    Ok(ColorScale::diverging("", values))
}

fn map(
    source: &Source<'_>,
    figure: &Figure,
    (recipe, panel): (&SceneFile, &Panel),
    limit: f64,
    numbers: &mut Numbers,
) -> Result<Value, Failure> {
    let name = format!("{}/{}", figure.id, panel.name);
    let table = source.table(&name)?;
    let (x, y) = (axis(source, &name, panel, "x")?, axis(source, &name, panel, "y")?);
    let cells = x["cells"].as_u64().unwrap_or(0) * y["cells"].as_u64().unwrap_or(0);
    if table.columns.len() != 3 || table.len() as u64 != cells {
        return Err(Failure::failed(format!("data/{name}.csv: {} rows for a map of {cells} cells", table.len())));
    }
    let id = format!("values-{}-{}", figure.id, panel.name);
    numbers.singles(&id, y["cells"].as_u64().unwrap_or(1) as usize, table.rows().map(|row| row[2]));
    let column = &table.columns[2];
    Ok(json!({
        "figure": figure.id, "panel": panel.name.replace('_', " "), "id": id, "table": format!("data/{name}.csv"),
        "difference": scenes::difference(recipe, panel), "x": x, "y": y, "clip": limit,
        "value": { "symbol": source.symbol(&name, column), "words": source.words(&name, column) },
    }))
}

/// An axis of a map, as its scene has it.
fn axis(source: &Source<'_>, table: &str, panel: &Panel, which: &str) -> Result<Value, Failure> {
    let values = scenes::values(panel);
    let text = |key: &str| values.get(&format!("map.{which}.{key}")).cloned().unwrap_or_default();
    let number = |key: &str| {
        let bad = |_| Failure::failed(format!("{table}: map.{which}.{key} is not a number"));
        text(key).parse::<f64>().map_err(bad)
    };
    let parameter = text("parameter");
    Ok(json!({
        "symbol": symbol(&parameter), "words": source.words(table, &parameter), "from": number("from")?,
        "to": number("to")?, "cells": number("cells")? as u64,
    }))
}

/// The curves of a figure: every table of it, the first column against the one that is drawn.
fn figure_curves(
    source: &Source<'_>,
    figure: &Figure,
    recipe: &SceneFile,
    numbers: &mut Numbers,
) -> Result<Vec<Value>, Failure> {
    let mut curves = Vec::new();
    for file in checkout::outputs::tables(source.paths, figure)? {
        let name = file.trim_start_matches("data/").trim_end_matches(".csv").to_owned();
        let table = source.table(&name)?;
        let short = name.rsplit('/').next().unwrap_or(&name);
        let (x, y) = (table.columns[0].clone(), table.columns[table.columns.len() - 1].clone());
        let (abscissae, ordinates) = (column(&table, &x)?, column(&table, &y)?);
        let id = format!("values-{}-{short}", figure.id);
        numbers.singles(&id, table.len().max(1), abscissae.into_iter().chain(ordinates));
        let panel = recipe.panels.iter().find(|panel| panel.name == short);
        curves.push(json!({
            "figure": figure.id, "panel": short.replace('_', " "), "id": id, "table": file, "rows": table.len(),
            "difference": panel.map_or(String::new(), |panel| scenes::difference(recipe, panel)),
            "x": { "symbol": symbol(&x), "words": source.words(&name, &x) },
            "y": { "symbol": symbol(&y), "words": source.words(&name, &y) },
        }));
    }
    Ok(curves)
}

fn column(table: &Table, name: &str) -> Result<Vec<f64>, Failure> {
    table.column(name).map_err(Failure::failed)
}

/// The trajectories of figure 11: positions as steps from one sample to the next, and speeds, in whole multiples of
/// [`STEP`].
fn ring(source: &Source<'_>, numbers: &mut Numbers) -> Result<Value, Failure> {
    let table = source.table("fig11/trajectories")?;
    let times = column(&table, "t")?;
    let count = times.iter().take_while(|&&time| time == times[0]).count();
    let positions = whole(&column(&table, "x")?);
    let speeds = whole(&column(&table, "v")?);
    let steps = (count..positions.len()).map(|row| positions[row] - positions[row - count]);
    numbers.shorts("ring-steps", count, steps)?;
    numbers.shorts("ring-speeds", count, speeds.iter().copied())?;
    let recipe =
        source.figures.iter().find(|figure| figure.id == "fig11").and_then(|figure| figure.recipe.as_ref().ok());
    let length = recipe.and_then(|recipe| scenes::shared(recipe).get("ring.length")?.parse::<f64>().ok());
    let length = length.ok_or_else(|| Failure::failed("figure 11: no length of the ring"))?;
    Ok(json!({
        "pedestrians": count, "samples": times.len() / count, "start": positions[..count], "unit": STEP,
        "length": length, "last": times.last(),
    }))
}

fn whole(values: &[f64]) -> Vec<i64> {
    values.iter().map(|value| (value * PER_UNIT).round() as i64).collect()
}

/// Published beside regenerated numbers.
#[derive(Debug)]
pub struct Published {
    /// Name of the set.
    pub id: &'static str,
    /// What it shows, in words.
    pub title: &'static str,
    /// The published table, below `data/reference`.
    pub file: &'static str,
    /// The regenerated table, `fig12/t300`.
    pub curve: &'static str,
    /// Names of the two columns.
    pub columns: [&'static str; 2],
    /// Where a number is known.
    pub x: Vec<f64>,
    /// The published number there.
    pub published: Vec<f64>,
    /// The regenerated one.
    pub regenerated: Vec<f64>,
    /// The largest error of reading.
    pub reading: f64,
}

impl Published {
    /// Published minus regenerated numbers.
    pub fn differences(&self) -> Vec<f64> {
        self.published.iter().zip(&self.regenerated).map(|(published, regenerated)| published - regenerated).collect()
    }
}

/// The two sets that are known: name, title, published table, regenerated table, columns.
const PUBLISHED: [(&str, &str, &str, &str, [&str; 2]); 2] = [
    ("speeds", "Figure 12, left: speeds", "published_speed_t300", "fig12/t300", ["n", "v"]),
    ("deviations", "Figure 13: standard deviation of the speeds", "published_std_log", "fig13/std", ["t", "std"]),
];

/// Reads published and regenerated numbers.
///
/// # Errors
/// A table is missing, or a published number has no partner.
pub fn published(source: &Source<'_>) -> Result<Vec<Published>, Failure> {
    let read = |(id, title, file, curve, columns): (&'static str, &'static str, &'static str, &'static str, _)| {
        let [x, y]: [&'static str; 2] = columns;
        let path = source.paths.root.join("data/reference").join(format!("{file}.csv"));
        let theirs = Table::read(&path).map_err(Failure::at(&path))?;
        let ours = source.table(curve)?;
        let (places, values) = (column(&ours, x)?, column(&ours, y)?);
        // numbers of pedestrians were read off an axis: whole up to their reading error
        let wanted: Vec<f64> = column(&theirs, x)?.into_iter().map(f64::round).collect();
        let partner = |x: &f64| {
            let row = places.iter().position(|place| place == x);
            row.map(|row| values[row]).ok_or_else(|| Failure::failed(format!("{curve}: nothing at {x}")))
        };
        let regenerated = wanted.iter().map(partner).collect::<Result<Vec<f64>, Failure>>()?;
        let reading = reading_error(source, &format!("{file}.csv"))?;
        let published = column(&theirs, y)?;
        Ok(Published { id, title, file, curve, columns, x: wanted, published, regenerated, reading })
    };
    PUBLISHED.into_iter().map(read).collect()
}

fn published_json(source: &Source<'_>) -> Result<Value, Failure> {
    let one = |set: &Published| {
        json!({
            "id": set.id, "title": set.title, "table": format!("data/{}.csv", set.curve),
            "reference": format!("data/reference/{}.csv", set.file),
            "curve": format!("values-{}", set.curve.replace('/', "-")), "x": set.x, "published": set.published,
            "regenerated": set.regenerated, "difference": set.differences(), "reading": set.reading,
            "symbols": set.columns.map(symbol), "words": source.words(set.curve, set.columns[1]),
        })
    };
    Ok(published(source)?.iter().map(one).collect())
}

/// The largest number in the column of reading errors of `data/reference/README.md`.
fn reading_error(source: &Source<'_>, file: &str) -> Result<f64, Failure> {
    let text = source.text("data/reference/README.md")?;
    let line = text.lines().find(|line| line.starts_with(&format!("| {file} ")));
    let cell = line.and_then(|line| line.trim_end_matches(['|', ' ']).rsplit('|').next()).unwrap_or("");
    let words = cell.split(|letter: char| !(letter.is_ascii_alphanumeric() || ".-+".contains(letter)));
    let numbers = words.filter_map(|word| word.parse::<f64>().ok());
    numbers
        .max_by(f64::total_cmp)
        .ok_or_else(|| Failure::failed(format!("data/reference/README.md: no error of {file}")))
}
