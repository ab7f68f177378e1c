//! Events of runs, read from and written to their tables.

use crate::disk;
use crate::failure::Failure;
use std::collections::BTreeMap;
use std::path::Path;

/// The events of a stored run.
const RUN_EVENTS: &str = "events.csv";

/// The header of a run's events.
pub const RUN_HEADER: &str = "event,t,n";

/// The header of the events of all runs.
pub const HEADER: &str = "scene,event,t,n,uncertainty";

/// One event as a run's `events.csv` has it; the texts of numbers are kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// `overlap`, `negative_speed`, `exchange` or `blow_up`.
    pub event: String,
    /// The time as written.
    pub t_text: String,
    /// The time, dimensionless.
    pub t: f64,
    /// The pedestrian, from 0, as written.
    pub n: String,
}

/// The committed events of all runs, by scene.
pub type ByScene = BTreeMap<String, Vec<Event>>;

/// Parses the table of all events; `file` is only for messages.
///
/// # Errors
/// Usage: another header, or a line of another form, with its number.
pub fn parse_all(file: &str, text: &str) -> Result<ByScene, Failure> {
    let fail = |line: usize, found: &str| Failure::Usage(format!("{file}:{line}: expected {HEADER}, found {found:?}"));
    let mut lines = text.lines();
    match lines.next() {
        Some(HEADER) => {}
        other => return Err(fail(1, other.unwrap_or(""))),
    }
    let mut scenes = ByScene::new();
    for (index, line) in lines.enumerate() {
        let cells = cells(line);
        let [scene, event, t_text, n, _] = cells[..] else { return Err(fail(index + 2, line)) };
        let t = time(t_text).ok_or_else(|| fail(index + 2, line))?;
        let event = Event { event: event.to_owned(), t_text: t_text.to_owned(), t, n: n.to_owned() };
        scenes.entry(scene.to_owned()).or_default().push(event);
    }
    Ok(scenes)
}

/// The event of `others` that has the rank among its like that `events[index]` has among its own.
pub fn partner<'a>(events: &[Event], index: usize, others: &'a [Event]) -> Option<&'a Event> {
    let event = &events[index];
    let alike = |other: &&Event| other.event == event.event && other.n == event.n;
    others.iter().filter(alike).nth(events[..index].iter().filter(alike).count())
}

/// Parses a run's `events.csv`; `file` is only for messages.
///
/// # Errors
/// Failed, since a run has written it: another header, or a line of another form, with its number.
pub fn parse(file: &str, text: &str) -> Result<Vec<Event>, Failure> {
    let fail =
        |line: usize, found: &str| Failure::Failed(format!("{file}:{line}: expected {RUN_HEADER}, found {found:?}"));
    let mut lines = text.lines();
    match lines.next() {
        Some(RUN_HEADER) => {}
        other => return Err(fail(1, other.unwrap_or(""))),
    }
    let event = |(index, line): (usize, &str)| {
        let cells = cells(line);
        let [event, t_text, n] = cells[..] else { return Err(fail(index + 2, line)) };
        let t = time(t_text).ok_or_else(|| fail(index + 2, line))?;
        Ok(Event { event: event.to_owned(), t_text: t_text.to_owned(), t, n: n.to_owned() })
    };
    lines.enumerate().map(event).collect()
}

/// The cells of a line; none of one with control characters, as a carriage return at the end of all.
fn cells(line: &str) -> Vec<&str> {
    if line.contains(char::is_control) { Vec::new() } else { line.split(',').collect() }
}

/// A time as written, if it is finite.
fn time(text: &str) -> Option<f64> {
    text.parse().ok().filter(|t: &f64| t.is_finite())
}

/// The events of a stored run; none when it has no such file.
///
/// # Errors
/// The file cannot be read, or is not what a run writes.
pub fn of_run(folder: &Path) -> Result<Vec<Event>, Failure> {
    let path = folder.join(RUN_EVENTS);
    match disk::read_text(&path)? {
        Some(text) => parse(&path.display().to_string(), &text),
        None => Ok(Vec::new()),
    }
}

/// The lines of a run for the table of all events, sorted by time. The k-th event of a kind at a pedestrian is compared
/// with the k-th of the check; one that the check does not have gets the uncertainty `inf`.
pub fn lines(scene: &str, run: &[Event], check: &[Event]) -> Vec<String> {
    let mut sorted: Vec<(f64, String)> = Vec::new();
    for (index, event) in run.iter().enumerate() {
        let uncertainty = uncertainty(event.t, partner(run, index, check).map(|partner| partner.t));
        sorted.push((event.t, format!("{scene},{},{},{},{uncertainty:?}", event.event, event.t_text, event.n)));
    }
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    sorted.into_iter().map(|(_, line)| line).collect()
}

/// How far the check's time is from `t`, but not below two units in the last place of `t`, which is what the
/// arithmetic of finding an event can lose; infinite without a check.
pub fn uncertainty(t: f64, check: Option<f64>) -> f64 {
    let floor = 2.0 * (t.abs().next_up() - t.abs());
    check.map_or(f64::INFINITY, |check| if (t - check).abs() > floor { (t - check).abs() } else { floor })
}

/// The table of all events: `fresh` in place of every line whose scene `dropped` names, sorted by scene. Lines of a
/// scene stay in their order.
pub fn merge(old: &str, fresh: &[String], dropped: &dyn Fn(&str) -> bool) -> String {
    let scene = |line: &str| line.split(',').next().unwrap_or("").to_owned();
    let kept = old.lines().skip(1).filter(|line| !dropped(&scene(line))).map(str::to_owned);
    let mut lines: Vec<String> = kept.chain(fresh.iter().cloned()).collect();
    lines.sort_by_key(|line| scene(line));
    let mut text = format!("{HEADER}\n");
    lines.iter().for_each(|line| {
        text.push_str(line);
        text.push('\n');
    });
    text
}
