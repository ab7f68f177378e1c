//! Numbers from the runs of the figures: events, errors, and single values of their curves.

use super::{Quantities, Source, largest, least, numbers, table};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::EVENTS;
use files::table::CellValue;

/// Adds all of it.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let figures = source.figures.iter().filter(|figure| !figure.is_supplement()).count();
    all.exact("figures.count", figures as f64, "figures/");
    errors(source, all);
    events(source, all)?;
    jams(source, all)?;
    collisions(source, all)
}

/// Of each figure the largest error of a column, and the method and the counts of its tables.
fn errors(source: &Source<'_>, all: &mut Quantities) {
    for figure in source.figures {
        let start = format!("data/{}/", figure.id);
        let mine = source.manifest.iter().filter(|(name, _)| name.starts_with(&start));
        for (file, entry) in mine.clone() {
            let (name, from) = (file[start.len()..].trim_end_matches(".csv"), format!("data/manifest.json: {file}"));
            for (key, value) in &entry.counts {
                let name = format!("{}.{name}.{key}", figure.id);
                match (value.as_f64(), value.as_str()) {
                    (Some(number), _) => all.exact(&name, number, &from),
                    (_, word) => all.word(&name, word.unwrap_or(""), &from),
                }
            }
        }
        let errors = mine.flat_map(|(_, entry)| entry.error.values().flatten().copied());
        if let Some(largest) = errors.max_by(f64::total_cmp) {
            let from = format!("data/manifest.json: largest of {start}");
            all.rounded(&format!("{}.error", figure.id), largest, 2, &from);
        }
    }
}

/// Events of the reference solutions, by name.
const REFERENCE_EVENTS: &str = "data/reference/solutions/events.csv";
/// The scenes of figures whose events a reference solution has, with their names there.
const REFERENCES: [(&str, &str); 2] =
    [("fig04-unstable", "algebraic_unstable"), ("fig07-unstable", "exponential_unstable")];

/// The time and the pedestrian of each event. The uncertainty is the larger of the difference between two methods and
/// the distance from the reference solution, so that the bracket holds the latter.
fn events(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let text = disk::read_text(&source.paths.root.join(REFERENCE_EVENTS))?.unwrap_or_default();
    let references = checkout::events::parse_all(REFERENCE_EVENTS, &text)?;
    for row in table::<CellValue>(source.paths, EVENTS)?.rows() {
        let [
            CellValue::Word(scene),
            CellValue::Word(event),
            CellValue::Number(time),
            CellValue::Number(n),
            CellValue::Number(spread),
        ] = row
        else {
            return Err(Failure::Usage(format!(
                "{EVENTS}: expected scene,event,t,n,uncertainty, found a row of {} other cells",
                row.len()
            )));
        };
        let (start, from) = (format!("{scene}.{event}"), format!("{EVENTS}: {scene}, {event}"));
        if all.by_name.contains_key(&format!("{start}.t")) {
            // the first of its kind is the one that is said
            continue;
        }
        let (time, mut error) = (*time, *spread);
        all.rounded(&format!("{start}.spread"), error, 1, &from);
        let named = REFERENCES.iter().find(|(figure, _)| figure == scene).and_then(|(_, name)| references.get(*name));
        if let Some(reference) = named.and_then(|events| events.iter().find(|one| one.event == *event)) {
            let digits = written_out(&reference.t_text)
                .ok_or_else(|| Failure::Usage(format!("{REFERENCE_EVENTS}: t of {event} is not of the form 1.2e3")))?;
            // more digits than a double has: the table's own text
            all.word(&format!("{start}.reference"), &digits, REFERENCE_EVENTS);
            let off = (time - reference.t).abs();
            all.rounded(&format!("{start}.off"), off, 1, &format!("{from} and {REFERENCE_EVENTS}"));
            error = if off > error { off } else { error };
        }
        all.uncertain(&format!("{start}.t"), time, error, &from);
        all.rounded(&format!("{start}.short"), time, 5, &from);
        all.exact(&format!("{start}.n"), *n, &from);
    }
    Ok(())
}

/// `1.2345e2` as `123.45`, digit by digit; `None` when the text has another form or too few digits.
fn written_out(text: &str) -> Option<String> {
    let (mantissa, exponent) = text.split_once('e')?;
    let (whole, rest) = mantissa.split_once('.')?;
    let (moved, left) = rest.split_at_checked(exponent.parse().ok()?)?;
    Some(format!("{whole}{moved}.{left}"))
}

/// The jams at the end of figure 12's right panel, by the rule of `jam::jams`: pedestrians slower than half way between
/// the least and the largest speed; and the least speed of the whole run once all have started.
fn jams(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let name = "data/fig12/t2000.csv";
    let speeds = numbers(&table(source.paths, name)?, "v")?;
    let threshold = 0.5 * (least(&speeds) + largest(&speeds));
    let is_slow: Vec<bool> = speeds.iter().map(|&speed| speed < threshold).collect();
    let begins = (0..speeds.len()).filter(|&n| is_slow[n] && !is_slow[(n + speeds.len() - 1) % speeds.len()]);
    all.exact(
        "fig12.jams",
        begins.count() as f64,
        &format!("{name}: runs of pedestrians below the middle of the speeds"),
    );
    let slow = is_slow.iter().filter(|slow| **slow).count();
    all.exact("fig12.slow", slow as f64, &format!("{name}: pedestrians below the middle of the speeds"));
    Ok(())
}

/// From which desired speed on pedestrians collide under the logarithmic force at several headways: rounded outwards.
fn collisions(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let name = "data/s14/collision_by_headway.csv";
    let sheet = table(source.paths, name)?;
    let down = |value: f64| (value * 1e4).floor() / 1e4;
    all.rounded(
        "collision.headways.none",
        down(least(&numbers(&sheet, "none_at")?)),
        5,
        &format!("{name}: least of none_at"),
    );
    let highest = -down(-largest(&numbers(&sheet, "contact_at")?));
    all.rounded("collision.headways.contact", highest, 5, &format!("{name}: largest of contact_at"));
    Ok(())
}
