//! What the runs of the figures say: events, errors, and single values of their curves.

use super::sheet::Sheet;
use super::{Quantities, Source};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::EVENTS;
use serde_json::Value;

/// Adds all of it.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let figures = source.figures.iter().filter(|figure| !figure.is_supplement()).count();
    all.exact("figures.count", figures as f64, "figures/");
    errors(source, all);
    events(source, all)?;
    for figure in ["fig04", "fig07"] {
        decay(source, all, figure)?;
        growth(source, all, figure)?;
    }
    jams(source, all)?;
    collisions(source, all)?;
    plateau(source, all)
}

/// Of each figure: the largest error of a column, and method, tolerance and counts of its tables.
fn errors(source: &Source<'_>, all: &mut Quantities) {
    for figure in source.figures {
        let mut largest: Option<f64> = None;
        let start = format!("data/{}/", figure.id);
        for (name, entry) in source.manifest.iter().filter(|(name, _)| name.starts_with(&start)) {
            let from = format!("data/manifest.json: {name}");
            let table = name[start.len()..].trim_end_matches(".csv");
            for (column, error) in &entry.error {
                let Some(error) = error else { continue };
                all.rounded(&format!("{}.{table}.{column}.error", figure.id), *error, 2, &from);
                largest = Some(largest.map_or(*error, |old| if *error > old { *error } else { old }));
            }
            for (key, value) in &entry.counts {
                let name = format!("{}.{table}.{key}", figure.id);
                match value {
                    Value::Number(number) => all.exact(&name, number.as_f64().unwrap_or(f64::NAN), &from),
                    Value::String(word) => all.word(&name, word, &from),
                    _ => {}
                }
            }
        }
        if let Some(largest) = largest {
            all.rounded(
                &format!("{}.error", figure.id),
                largest,
                2,
                &format!("data/manifest.json: largest of {start}"),
            );
        }
    }
}

/// Events of the reference solutions, by name.
const REFERENCE_EVENTS: &str = "data/reference/solutions/events.csv";
/// The scenes of figures whose events a reference solution has, with their names there.
const REFERENCES: [(&str, &str); 2] =
    [("fig04-unstable", "algebraic_unstable"), ("fig07-unstable", "exponential_unstable")];

/// The time and the pedestrian of each event. The uncertainty is the larger of the difference between two methods and the
/// distance from the reference solution, so that the bracket holds the latter.
fn events(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let text = disk::read_text(&source.paths.root.join(REFERENCE_EVENTS))?.unwrap_or_default();
    let references = checkout::events::parse_all(REFERENCE_EVENTS, &text)?;
    let sheet = Sheet::read(source.paths, EVENTS)?;
    for (scene, event) in sheet.words("scene")?.into_iter().zip(sheet.words("event")?) {
        let row = sheet.only(&[("scene", &*scene), ("event", &*event)])?;
        let (start, from) = (format!("{scene}.{event}"), format!("{EVENTS}: {scene}, {event}"));
        let (time, mut error) = (row.first("t")?, row.first("uncertainty")?);
        all.rounded(&format!("{start}.spread"), error, 1, &from);
        let named = REFERENCES.iter().find(|(figure, _)| *figure == scene).and_then(|(_, name)| references.get(*name));
        if let Some(reference) = named.and_then(|events| events.iter().find(|one| one.event == event)) {
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
        all.exact(&format!("{start}.n"), row.first("n")?, &from);
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

/// A stable run: its largest deviation, and what is left at the end.
fn decay(source: &Source<'_>, all: &mut Quantities, figure: &str) -> Result<(), Failure> {
    let name = format!("data/{figure}/stable.csv");
    let sheet = Sheet::read(source.paths, &name)?;
    let (times, std) = (sheet.numbers("t")?, sheet.numbers("std")?);
    all.rounded(&format!("{figure}.stable.peak"), sheet.largest("std")?, 2, &name);
    all.rounded(&format!("{figure}.stable.end"), *std.last().unwrap_or(&f64::NAN), 2, &name);
    if let Some(at) = times.iter().position(|&t| t == 1000.0) {
        all.rounded(&format!("{figure}.stable.at-1000"), std[at], 2, &name);
    }
    Ok(())
}

/// An unstable run: its last deviation, before the event that ends it.
fn growth(source: &Source<'_>, all: &mut Quantities, figure: &str) -> Result<(), Failure> {
    let name = format!("data/{figure}/unstable.csv");
    let sheet = Sheet::read(source.paths, &name)?;
    all.rounded(&format!("{figure}.unstable.largest"), sheet.largest("std")?, 3, &name);
    Ok(())
}

/// The jams at the end of figure 12's right panel, by the rule of `jam::jams`: pedestrians slower than half way between the
/// least and the largest speed; and the least speed of the whole run once all have started.
fn jams(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let name = "data/fig12/t2000.csv";
    let sheet = Sheet::read(source.paths, name)?;
    let speeds = sheet.numbers("v")?;
    let threshold = 0.5 * (sheet.least("v")? + sheet.largest("v")?);
    let is_slow: Vec<bool> = speeds.iter().map(|&speed| speed < threshold).collect();
    let begins = (0..speeds.len()).filter(|&n| is_slow[n] && !is_slow[(n + speeds.len() - 1) % speeds.len()]);
    all.exact(
        "fig12.jams",
        begins.count() as f64,
        &format!("{name}: runs of pedestrians below the middle of the speeds"),
    );
    let slow = is_slow.iter().filter(|slow| **slow).count();
    all.exact("fig12.slow", slow as f64, &format!("{name}: pedestrians below the middle of the speeds"));
    all.rounded("fig12.least", sheet.least("v")?, 3, name);
    all.rounded("fig12.largest", sheet.largest("v")?, 3, name);
    let name = "data/fig11/trajectories.csv";
    let sheet = Sheet::read(source.paths, name)?;
    let (times, speeds) = (sheet.numbers("t")?, sheet.numbers("v")?);
    let moving = times.iter().zip(&speeds).filter(|(t, _)| **t >= 1.0).map(|(_, v)| *v);
    let least = moving.fold(f64::INFINITY, |a, b| if b < a { b } else { a });
    all.rounded("fig11.least", least, 3, &format!("{name}: v at t >= 1"));
    Ok(())
}

/// From which desired speed on pedestrians collide under the logarithmic force, in runs to several times and at several
/// headways; and how the least headway in jams vanishes.
fn collisions(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let name = "data/s14/collision.csv";
    let sheet = Sheet::read(source.paths, name)?.only(&[("pedestrians", "133"), ("shift", "0.1")])?;
    for end in ["300", "1000", "3000"] {
        let row = sheet.only(&[("t_end", end)])?;
        // known to a thousandth
        all.rounded(&format!("collision.{end}"), row.first("value")?, 4, name);
    }
    all.rounded("collision.a_0", sheet.only(&[("t_end", "3000")])?.first("a_0_in_m")?, 2, name);
    let name = "data/s14/collision_by_headway.csv";
    let sheet = Sheet::read(source.paths, name)?;
    // limits: rounded away from each other
    let down = |value: f64| (value * 1e4).floor() / 1e4;
    all.rounded("collision.headways.none", down(sheet.least("none_at")?), 5, &format!("{name}: least of none_at"));
    let highest = -down(-sheet.largest("contact_at")?);
    all.rounded("collision.headways.contact", highest, 5, &format!("{name}: largest of contact_at"));
    all.exact("collision.headways.from", sheet.least("headway")?, name);
    all.exact("collision.headways.to", sheet.largest("headway")?, name);
    let name = "data/s14/jam_headway.csv";
    let last = Sheet::read(source.paths, name)?.only(&[("v0", "1.25")])?;
    all.rounded("jam-headway.zero.least", last.least("zero_at")?, 4, &format!("{name}: v0 = 1.25"));
    all.rounded("jam-headway.zero.largest", last.largest("zero_at")?, 4, &format!("{name}: v0 = 1.25"));
    let same = Sheet::read(source.paths, name)?.only(&[("v0", "1.2")])?;
    all.rounded("jam-headway.1.2.least", same.least("least_headway")?, 3, &format!("{name}: v0 = 1.2"));
    all.rounded("jam-headway.1.2.largest", same.largest("least_headway")?, 3, &format!("{name}: v0 = 1.2"));
    let figure = Sheet::read(source.paths, name)?.only(&[("headway", "1.5")])?;
    for v0 in ["1.15", "1.2", "1.23", "1.24", "1.25"] {
        let row = figure.only(&[("v0", v0)])?;
        all.exact(&format!("jam-headway.{v0}.v0"), row.first("v0")?, name);
        all.rounded(&format!("jam-headway.{v0}"), row.first("least_headway")?, 2, name);
    }
    Ok(())
}

/// The plateau of figure 13, and when each of its two runs gets to a third of it.
fn plateau(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    const LATE: f64 = 2000.0;
    const HIGH: f64 = 0.1;
    let early = 300.0;
    all.exact("fig13.early", early, "data/fig12/t300.csv: its time");
    all.exact("fig12.late", LATE, "data/fig12/t2000.csv: its time");
    let mut reached = Vec::new();
    for (table, short) in [("std", "large"), ("std_small_shift", "small")] {
        let name = format!("data/fig13/{table}.csv");
        let sheet = Sheet::read(source.paths, &name)?;
        let (times, std) = (sheet.numbers("t")?, sheet.numbers("std")?);
        let late: Vec<f64> = times.iter().zip(&std).filter(|(t, _)| **t >= LATE).map(|(_, std)| *std).collect();
        let mean = late.iter().sum::<f64>() / late.len() as f64;
        all.rounded(&format!("fig13.{short}.plateau"), mean, 2, &format!("{name}: mean of std at t >= {LATE}"));
        let first = times.iter().zip(&std).find(|(_, std)| **std > HIGH).map_or(f64::NAN, |(t, _)| *t);
        all.exact(&format!("fig13.{short}.reaches"), first, &format!("{name}: first t with std > {HIGH}"));
        if let Some(at) = times.iter().position(|&t| t == early) {
            all.rounded(&format!("fig13.{short}.at-300"), std[at], 2, &name);
        }
        reached.push(first);
    }
    all.exact("fig13.high", HIGH, "chosen: a third of the plateau");
    all.exact("fig13.delay", reached[1] - reached[0], "data/fig13: difference of the two times");
    Ok(())
}
