//! Describes differences in words.

use crate::judgement::Judgement;
use crate::moved::Moved;
use crate::numbers::{Course, Distance, Worst};
use crate::pictures::Picture;
use crate::pixels::{Pixels, THRESHOLDS};
use crate::states::Parted;
use crate::tables::{Against, Compared};
use checkout::paths::EVENTS;
use checkout::sums::State;

/// Everything of a figure that is not as committed, a line each, indented.
pub fn details(judgement: &Judgement) -> Vec<String> {
    let files = judgement.files.iter().filter(|(_, state)| **state != State::Same);
    let mut lines: Vec<String> = files.map(|(name, state)| format!("{}: {name}", state.word())).collect();
    for (name, table) in &judgement.tables {
        match table {
            Ok(compared) if compared.is_same() => {}
            Ok(compared) => lines.push(format!("{name}: {}", table_words(compared))),
            Err(problem) => lines.push(format!("{name}: {problem}")),
        }
    }
    lines.extend(judgement.events.iter().map(|moved| format!("{EVENTS}: {}", event(moved))));
    lines.extend(judgement.parted.iter().map(Parted::words));
    lines.extend(judgement.pictures.iter().map(|(name, one)| format!("{name}: {}", picture(one))));
    lines.into_iter().map(|line| format!("  {line}")).collect()
}

fn table_words(compared: &Compared) -> String {
    let sample = if compared.against == Against::Sample { ", among the committed samples" } else { "" };
    format!("{}{sample}", distance(&compared.distance))
}

/// A distance in words.
pub fn distance(distance: &Distance) -> String {
    let at = |worst: &Worst| format!("{:.2e} ({})", worst.value, place(worst));
    let mut words = format!(
        "{} cells differ; largest absolute {}, relative {}, ulp {}",
        distance.cells,
        at(&distance.absolute),
        at(&distance.relative),
        at(&distance.ulp)
    );
    if let Some(course) = &distance.course {
        words.push_str(&format!("; {}", course_words(course)));
    }
    match &distance.furthest {
        Some(worst) => {
            words.push_str(&format!("; {} beyond tolerance, furthest: {}", distance.beyond, at(worst)));
        }
        None => words.push_str("; all within tolerance"),
    }
    if distance.unmatched > 0 {
        words.push_str(&format!("; {} rows that only one of the two has", distance.unmatched));
    }
    words
}

fn place(worst: &Worst) -> String {
    let at = if worst.at.is_empty() { String::new() } else { format!(", {}", worst.at) };
    format!("row {}{at}, {}", worst.row, worst.column)
}

fn course_words(course: &Course) -> String {
    let [first, second, third, last] = course.quarters;
    let Course { column, since, course, .. } = course;
    format!(
        "{column} since t = {since}, {course} along t ({first:.1e} {second:.1e} {third:.1e} {last:.1e} by quarters)"
    )
}

/// An event that moved, in words.
pub fn event(moved: &Moved) -> String {
    let Moved { scene, event, n, committed, found, absolute, ulp, within } = moved;
    let place = format!("{scene}, {event} at pedestrian {n}");
    match (committed, found, absolute, ulp) {
        (Some(committed), Some(found), Some(absolute), Some(ulp)) => {
            let tolerance = if *within { "within" } else { "beyond" };
            format!(
                "{place}: expected t = {committed}, found {found}; absolute {absolute:.2e}, ulp {ulp}, {tolerance} tolerance"
            )
        }
        (Some(committed), ..) => format!("{place}: did not occur at t = {committed}"),
        (None, found, ..) => format!("{place}: new, at t = {}", found.as_deref().unwrap_or("?")),
    }
}

/// A picture that differs, in words.
pub fn picture(picture: &Picture) -> String {
    match picture {
        Picture::Pixels(pixels, _) if pixels.changed == 0 => "every pixel is as committed".to_owned(),
        Picture::Pixels(pixels, shown) => {
            let last = shown.files.last().map_or(String::new(), |file| format!("; see {}", file.display()));
            format!("{}{last}", pixel_words(pixels))
        }
        Picture::Text { first, committed, made } => {
            format!("text differs from byte {first} on; expected {committed} bytes, found {made}")
        }
        Picture::Problem(problem) => problem.clone(),
    }
}

fn pixel_words(pixels: &Pixels) -> String {
    let percent = |share: f64| format!("{:.3}", 100.0 * share);
    let sweep: Vec<String> = THRESHOLDS
        .iter()
        .zip(pixels.shares)
        .map(|(above, share)| format!("{} above {above}", percent(share)))
        .collect();
    let within = pixels.within.map_or(String::new(), |[left, top, right, bottom]| {
        format!(" within x {left} to {right}, y {top} to {bottom}")
    });
    let Pixels { changed, largest, .. } = pixels;
    format!("{changed} pixels changed{within}, by at most {largest} of 255; per cent: {}", sweep.join(", "))
}
