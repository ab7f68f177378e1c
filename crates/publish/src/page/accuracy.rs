//! The cost of an error, and the size of the errors: accuracy tables and event tables as HTML.

use super::html::{code, escape, measured, number, table};
use super::source::Source;
use checkout::failure::Failure;
use verify::precision::{SCENES, Scene, TARGETS};

/// The cheapest method for each error, by evaluations of the right-hand side.
///
/// # Errors
/// A table is missing.
pub fn cheapest(source: &Source<'_>) -> Result<String, Failure> {
    let mut rows = Vec::new();
    for name in SCENES {
        let scene = Scene::committed(source.paths, name)?;
        let mut row = vec![escape(&name.replace('_', " "))];
        for target in TARGETS {
            let found = scene.cheapest(target, |row| row.right_hand_sides, &[]);
            row.push(found.map_or("none reaches it".to_owned(), |found| {
                let work = found.right_hand_sides.map_or(String::new(), |work| number(work, 15));
                format!("{} ({}): {work}", escape(&found.method), escape(&found.control))
            }));
        }
        rows.push(row);
    }
    let heads = TARGETS.map(|target| format!("error {}", number(target, 2)));
    let head: Vec<&str> = std::iter::once("run").chain(heads.iter().map(String::as_str)).collect();
    Ok(table("The cheapest method for an error", &head, &rows))
}

/// The events of all runs, each with the difference of the two methods.
///
/// # Errors
/// The table is missing.
pub fn events(source: &Source<'_>) -> Result<String, Failure> {
    let text = source.text(checkout::paths::EVENTS)?;
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let [scene, event, t, n, error] = cells[..] else { return Err(Failure::failed(format!("events: {line}"))) };
        let bad = |_| Failure::failed(format!("events: {line}"));
        let (t, error): (f64, f64) = (t.parse().map_err(bad)?, error.parse().map_err(bad)?);
        Ok(vec![code(scene), escape(&event.replace('_', " ")), measured(t, Some(error)), number(error, 2), escape(n)])
    };
    let rows = text.lines().skip(1).map(row).collect::<Result<Vec<_>, Failure>>()?;
    Ok(table("Events of the runs", &["run", "event", "time", "uncertainty", "pedestrian"], &rows))
}
