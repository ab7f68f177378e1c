//! Events of runs: their times, and how far the check agrees.

use crate::failure::Failure;

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
        let cells: Vec<&str> = line.split(',').collect();
        let [event, t_text, n] = cells[..] else { return Err(fail(index + 2, line)) };
        let t = t_text.parse().map_err(|_| fail(index + 2, line))?;
        Ok(Event { event: event.to_owned(), t_text: t_text.to_owned(), t, n: n.to_owned() })
    };
    lines.enumerate().map(event).collect()
}

/// The lines of a run for the table of all events, sorted by time. The k-th event of a kind at a pedestrian is compared
/// with the k-th of the check; one that the check does not have gets the uncertainty `inf`.
pub fn lines(scene: &str, run: &[Event], check: &[Event]) -> Vec<String> {
    let alike = |a: &Event, b: &Event| a.event == b.event && a.n == b.n;
    let mut sorted: Vec<(f64, String)> = Vec::new();
    for (index, event) in run.iter().enumerate() {
        let rank = run[..index].iter().filter(|other| alike(other, event)).count();
        let partner = check.iter().filter(|other| alike(other, event)).nth(rank);
        let uncertainty = uncertainty(event.t, partner.map(|partner| partner.t));
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
