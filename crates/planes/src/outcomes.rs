//! Tables and pictures of the supplements on planes of outcomes, made from the committed planes.

use crate::picture::{cells_of, grid};
use figures::{Failure, Job};
use files::table::{CellValue, MixedTable};
use files::write::with_path;
use jam::outcome::Class;
use plot::Picture;
use sweep::Sweep;

/// A panel with its title.
pub type Titled<'a> = (&'a str, &'a str);

/// The sweep of a panel, and its cells as committed: a plane takes minutes. The table is taken over under the panel's
/// name.
///
/// # Errors
/// It is missing, or not one of this sweep.
fn take(job: &Job, panel: &str) -> Result<(Sweep, Vec<sweep::CellOutcome>), Failure> {
    job.take_committed("outcomes", panel)?;
    plane(job, panel)
}

/// The sweep of a panel, and its cells from the table of the figure.
fn plane(job: &Job, panel: &str) -> Result<(Sweep, Vec<sweep::CellOutcome>), Failure> {
    let sweep = sweep::read(&job.scene_file.file, &job.panel(panel)?.tables)?;
    let file = job.table_file(panel);
    let text = std::fs::read_to_string(&file).map_err(|error| with_path(error, &file))?;
    let cells = cells_of(&file.display().to_string(), &text, &sweep)?;
    Ok((sweep, cells))
}

/// Takes the planes over, and writes which part of their unstable and of their stable cells has which outcome:
/// `shares`.
///
/// # Errors
/// A committed plane is missing, or not that of its panel.
pub fn tables(job: &Job, planes: &[Titled<'_>]) -> Result<(), Failure> {
    let mut shares = MixedTable::new(&["plane", "flow", "outcome", "cells", "share", "error"]);
    for (panel, _) in planes {
        let (sweep, cells) = take(job, panel)?;
        let is_unstable = unstable(&sweep)?;
        for flow in ["unstable", "stable"] {
            let of_flow = cells.iter().zip(&is_unstable).filter(|(_, unstable)| **unstable == (flow == "unstable"));
            let classes: Vec<Class> = of_flow.map(|(cell, _)| cell.class).collect();
            let count = |class: Class| classes.iter().filter(|found| **found == class).count() as f64;
            let all = classes.len() as f64;
            // what is undecided may be anything
            let error = count(Class::Undecided) / all;
            for class in Class::ALL.into_iter().filter(|class| all > 0.0 && count(*class) > 0.0) {
                let words = [*panel, flow, class.name()].map(CellValue::from);
                let numbers = [count(class), count(class) / all, error].map(CellValue::Number);
                shares.push(words.into_iter().chain(numbers).collect::<Vec<CellValue>>());
            }
        }
    }
    job.write_rows("shares", &shares)
}

/// Whether the uniform flow of each cell is unstable against waves of any length, column by column; false where there
/// is none.
fn unstable(sweep: &Sweep) -> Result<Vec<bool>, Failure> {
    let at = |index: usize| [(index / sweep.y.cells) as f64 + 0.5, (index % sweep.y.cells) as f64 + 0.5];
    let exact = (0..sweep.cells()).map(|index| sweep.exact(at(index)).map(|exact| exact.margin > 0.0));
    Ok(exact.collect::<Result<Vec<bool>, String>>()?)
}

/// Writes where waves lie in planes with the desired speed as vertical axis, column by column: `bands`.
///
/// # Errors
/// As [`tables`].
pub fn bands(job: &Job, panels: &[&str]) -> Result<(), Failure> {
    let mut bands = MixedTable::new(&[
        "plane",
        "parameter",
        "value",
        "threshold",
        "first",
        "last",
        "contact",
        "width",
        "below",
        "error",
    ]);
    for panel in panels {
        let (sweep, cells) = plane(job, panel)?;
        for (column, cells) in cells.chunks(sweep.y.cells).enumerate() {
            let words = [*panel, &sweep.x.parameter].map(CellValue::from);
            let numbers = band(&sweep, column, cells)?.map(|number| number.map_or(CellValue::Empty, CellValue::Number));
            bands.push(words.into_iter().chain(numbers).collect::<Vec<CellValue>>());
        }
    }
    job.write_rows("bands", &bands)
}

/// The band of waves in a column of cells: the numbers of a row of `bands`.
fn band(sweep: &Sweep, column: usize, cells: &[sweep::CellOutcome]) -> Result<[Option<f64>; 8], Failure> {
    let height = (sweep.y.to - sweep.y.from) / sweep.y.cells as f64;
    let place = column as f64 + 0.5;
    let threshold = threshold(sweep, place)?;
    let has = |class: Class| move |cell: &sweep::CellOutcome| cell.class == class;
    let rows = |class: Class| cells.iter().enumerate().filter(move |(_, cell)| cell.class == class).map(|(row, _)| row);
    let first = cells.iter().position(has(Class::Waves));
    let last = cells.iter().rposition(has(Class::Waves));
    let contact = cells.iter().position(has(Class::Contact));
    let is_below = |row: &usize| threshold.is_none_or(|threshold| sweep.y.centre(*row) < threshold);
    // what is undecided between the line, or the first waves, and contact may belong to the band
    let is_near = |row: &usize| {
        (!is_below(row) || first.is_some_and(|first| *row > first)) && contact.is_none_or(|end| *row < end)
    };
    let size = |count: usize| count as f64 * height;
    let error = height + size(rows(Class::Undecided).filter(is_near).count());
    let speed = |row: Option<usize>| row.map(|row| sweep.y.centre(row));
    Ok([
        Some(sweep.x.centre(column)),
        threshold,
        speed(first),
        speed(last),
        speed(contact),
        Some(size(rows(Class::Waves).count())),
        Some(size(rows(Class::Waves).filter(is_below).count())),
        Some(error),
    ])
}

/// The lowest desired speed of a column from which on the uniform flow is unstable, if it becomes so in the plane:
/// bisection.
fn threshold(sweep: &Sweep, place: f64) -> Result<Option<f64>, Failure> {
    let is_unstable = |row: f64| sweep.exact([place, row]).map(|exact| exact.margin > 0.0);
    let rows = (0..sweep.y.cells).map(|row| is_unstable(row as f64 + 0.5)).collect::<Result<Vec<bool>, String>>()?;
    let Some(row) = rows.iter().position(|unstable| *unstable).filter(|row| *row > 0) else { return Ok(None) };
    let (mut low, mut high) = (row as f64 - 0.5, row as f64 + 0.5);
    // 50 halves of a cell: to the last bits
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if is_unstable(middle)? { high = middle } else { low = middle }
    }
    Ok(Some(sweep.y.at(high)))
}

/// Takes over how many cells of a plane change with the numerics, the time and the start (`how_sure`), and says so
/// beside each plane in the manifest.
///
/// # Errors
/// The committed table is missing or lacks a column.
pub fn how_sure(job: &mut Job, planes: &[Titled<'_>]) -> Result<(), Failure> {
    job.take_committed("outcomes", "how_sure")?;
    let table = job.read_rows("how_sure")?;
    let columns = ["plane", "change", "cells", "differ", "decided_differ"].map(|name| table.place(name));
    let [plane, change, cells, differ, decided] = columns.into_iter().collect::<Result<Vec<_>, _>>()?[..] else {
        return Err(Failure::work("how_sure.csv: five columns"));
    };
    for (panel, _) in planes {
        let rows = table.rows().filter(|row| row[plane] == CellValue::from(*panel));
        let words = |row: &[CellValue]| {
            let [change, cells, differ, decided] =
                [change, cells, differ, decided].map(|column| row[column].to_string());
            format!("{change}: {differ} of {cells} differ, {decided} of them decided both times")
        };
        let said = rows.map(words).collect::<Vec<String>>();
        job.state_method(panel, &format!("two runs a cell; cells that change with {}", said.join("; ")));
    }
    Ok(())
}

/// The picture of the planes of a figure, `columns` in a row.
///
/// # Errors
/// A table is missing, or not that of its panel.
pub fn picture(job: &Job, planes: &[Titled<'_>], columns: usize, size: [f64; 2]) -> Result<Picture, Failure> {
    let found = planes.iter().map(|(panel, _)| plane(job, panel)).collect::<Result<Vec<_>, Failure>>()?;
    let named = planes.iter().zip(&found).map(|((_, title), (sweep, cells))| (*title, sweep, &cells[..]));
    grid(&named.collect::<Vec<_>>(), columns, size)
}
