//! The numbers in the page (maps, curves, trajectories, published values), packed ([`super::pack`]) and listed in a
//! JSON index.

use super::html::symbol;
use super::pack::Numbers;
use super::source::Source;
use super::{laws, rejudged, scenes, sums};
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;
use files::scene_file::{Kind, Panel, SceneFile};
use files::table::Table;
use plot::ColorScale;
use serde_json::{Value, json};
use verify::published::{CURVES, Curve, Points};

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
    figure.scene_file.as_ref().map_or(&[][..], |scene_file| &scene_file.panels).iter()
}

/// Collects all numbers.
///
/// # Errors
/// A table is missing, or not what its scene says.
pub fn collect(source: &Source<'_>) -> Result<Data, Failure> {
    let mut numbers = Numbers::default();
    let (mut maps, mut curves) = (Vec::new(), Vec::new());
    for figure in &source.figures {
        let Ok(scene_file) = &figure.scene_file else { continue };
        if has_maps(figure) {
            let limit = colors(source, figure, scene_file)?.limit();
            for panel in &scene_file.panels {
                maps.push(map(source, figure, (scene_file, panel), limit, &mut numbers)?);
            }
        } else if has_curves(figure) {
            curves.extend(figure_curves(source, figure, scene_file, &mut numbers)?);
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
fn colors(source: &Source<'_>, figure: &Figure, scene_file: &SceneFile) -> Result<ColorScale, Failure> {
    let mut values = Vec::new();
    for panel in &scene_file.panels {
        let table = source.table(&format!("{}/{}", figure.id, panel.name))?;
        values.extend(table.rows().filter_map(|row| row.get(2).copied()));
    }
    Ok(ColorScale::diverging("", values))
}

fn map(
    source: &Source<'_>,
    figure: &Figure,
    (scene_file, panel): (&SceneFile, &Panel),
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
        "difference": scenes::difference(scene_file, panel), "x": x, "y": y, "clip": limit,
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
    scene_file: &SceneFile,
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
        let panel = scene_file.panels.iter().find(|panel| panel.name == short);
        curves.push(json!({
            "figure": figure.id, "panel": short.replace('_', " "), "id": id, "table": file, "rows": table.len(),
            "difference": panel.map_or(String::new(), |panel| scenes::difference(scene_file, panel)),
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
    let scene_file =
        source.figures.iter().find(|figure| figure.id == "fig11").and_then(|figure| figure.scene_file.as_ref().ok());
    let length = scene_file.and_then(|scene_file| scenes::shared(scene_file).get("ring.length")?.parse::<f64>().ok());
    let length = length.ok_or_else(|| Failure::failed("figure 11: no length of the ring"))?;
    Ok(json!({
        "pedestrians": count, "samples": times.len() / count, "start": positions[..count], "unit": STEP,
        "length": length, "last": times.last(),
    }))
}

fn whole(values: &[f64]) -> Vec<i64> {
    values.iter().map(|value| (value * PER_UNIT).round() as i64).collect()
}

/// The published curves, each with its numbers beside those of its table, and the largest error of reading.
///
/// # Errors
/// A table is missing, or has no value at the place of a published number.
pub fn published(source: &Source<'_>) -> Result<Vec<(Curve, Points, f64)>, Failure> {
    let read = |curve: Curve| {
        let points = curve.beside(source.paths, &source.table(curve.table)?)?;
        match points.x.len() == points.all {
            true => Ok((curve, points, curve.reading_errors(source.paths)?[1])),
            false => Err(Failure::failed(format!("{}: has no value where {} has one", curve.table, curve.file))),
        }
    };
    CURVES.into_iter().map(read).collect()
}

fn published_json(source: &Source<'_>) -> Result<Value, Failure> {
    let one = |(curve, points, reading): (Curve, Points, f64)| {
        json!({
            "id": curve.name, "title": curve.title, "table": Paths::table(curve.table), "reference": curve.source(),
            "curve": format!("values-{}", curve.table.replace('/', "-")), "x": points.x, "published": points.published,
            "regenerated": points.regenerated, "difference": points.differences(), "reading": reading,
            "symbols": curve.columns.map(symbol), "words": source.words(curve.table, curve.columns[1]),
        })
    };
    Ok(published(source)?.into_iter().map(one).collect())
}
