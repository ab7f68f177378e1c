//! The cost of an error, and the size of the errors: accuracy tables and event tables as HTML.

use super::html::{code, escape, measured, number, row};
use super::source::Source;
use checkout::failure::Failure;
use minijinja::Value;
use verify::precision::{SCENES, Scene, TARGETS};

/// The cheapest method for each error, by evaluations of the right-hand side: rows of HTML, the head first.
///
/// # Errors
/// A table is missing.
pub fn cheapest(source: &Source<'_>) -> Result<Vec<Vec<Value>>, Failure> {
    let heads = TARGETS.map(|target| format!("error {}", number(target, 2)));
    let mut rows = vec![row(std::iter::once("run".to_owned()).chain(heads))];
    for name in SCENES {
        let scene = Scene::committed(source.paths, name)?;
        let best = TARGETS.map(|target| match scene.cheapest(target, |row| row.right_hand_sides, &[]) {
            None => "none reaches it".to_owned(),
            Some(found) => {
                let work = found.right_hand_sides.map_or(String::new(), |work| number(work, 15));
                format!("{} ({}): {work}", escape(&found.method), escape(&found.control))
            }
        });
        rows.push(row(std::iter::once(escape(&name.replace('_', " "))).chain(best)));
    }
    Ok(rows)
}

/// The events of all runs, each with the difference of the two methods: rows of HTML.
///
/// # Errors
/// The table is missing or malformed.
pub fn events(source: &Source<'_>) -> Result<Vec<Vec<Value>>, Failure> {
    let text = source.text(checkout::paths::EVENTS)?;
    let one = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let [scene, event, t, n, error] = cells[..] else { return Err(Failure::failed(format!("events: {line}"))) };
        let bad = |_| Failure::failed(format!("events: {line}"));
        let (t, error): (f64, f64) = (t.parse().map_err(bad)?, error.parse().map_err(bad)?);
        let event = escape(&event.replace('_', " "));
        Ok(row([code(scene), event, measured(t, Some(error)), number(error, 2), escape(n)]))
    };
    text.lines().skip(1).map(one).collect()
}
