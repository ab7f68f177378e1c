//! Cells as lines of text: in shards, and in the table of a whole plane.

use super::cell::NUMBERS;
use super::{CellOutcome, DecidedBy, Sweep};
use files::table::push_number;
use files::write::sha256;
use jam::outcome::Class;

/// The header of a shard: a cell's indices replace the values of the axes, and each line ends with its own sum.
pub fn shard_header() -> String {
    header(["i", "j"]) + ",sum"
}

fn header(axes: [&str; 2]) -> String {
    [&axes[..], &["outcome", "backward_flow", "decided_by"], &NUMBERS].concat().join(",")
}

/// The line of a cell in a shard, without its end.
pub fn shard_line([i, j]: [usize; 2], cell: &CellOutcome) -> String {
    let mut line = format!("{i},{j}");
    push_cell(&mut line, cell);
    let sum = sum(&line);
    line + "," + &sum
}

/// The first 16 digits of the SHA-256 of a line without its sum: a digit changed on the way is noticed, and where.
fn sum(line: &str) -> String {
    let mut sum = sha256(line.as_bytes());
    sum.truncate(16);
    sum
}

/// A line of a shard; `None` for anything else, or if its sum is that of another line.
pub fn parse(line: &str) -> Option<([usize; 2], CellOutcome)> {
    let (line, found) = line.rsplit_once(',')?;
    if sum(line) != found {
        return None;
    }
    let mut words = line.split(',');
    let index = |word: Option<&str>| word?.parse::<usize>().ok();
    let indices = [index(words.next())?, index(words.next())?];
    Some((indices, parse_cell(words)?))
}

/// The content of a line after its first two words.
fn parse_cell<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<CellOutcome> {
    let class = Class::of_name(words.next()?)?;
    let backward_flow = match words.next()? {
        "0" => false,
        "1" => true,
        _ => return None,
    };
    let name = words.next()?;
    let decided_by = DecidedBy::ALL.into_iter().find(|by| by.name() == name)?;
    let mut numbers = [f64::NAN; NUMBERS.len()];
    for number in &mut numbers {
        match words.next()? {
            "" => (),
            word => *number = word.parse().ok().filter(|number: &f64| number.is_finite())?,
        }
    }
    words.next().is_none().then_some(CellOutcome { class, backward_flow, decided_by, numbers })
}

/// The table of a whole plane: a row for each cell, column by column of the plane.
pub fn table(sweep: &Sweep, cells: &[CellOutcome]) -> String {
    let mut text = header([&sweep.x.parameter, &sweep.y.parameter]) + "\n";
    for (index, cell) in cells.iter().enumerate() {
        let [x, y] = sweep.at([index / sweep.y.cells, index % sweep.y.cells]);
        push_number(&mut text, x);
        text.push(',');
        push_number(&mut text, y);
        push_cell(&mut text, cell);
        text.push('\n');
    }
    text
}

/// The cells of a plane from its table, as [`table`] writes it.
///
/// # Errors
/// The line that is not one of this plane, and what it must be.
pub fn cells(sweep: &Sweep, text: &str) -> Result<Vec<CellOutcome>, String> {
    let mut lines = text.lines();
    let expected = header([&sweep.x.parameter, &sweep.y.parameter]);
    let first = lines.next().unwrap_or("");
    if first != expected {
        return Err(format!("1: {first:?}: must be {expected:?}"));
    }
    let cells = lines.enumerate().map(|(index, line)| {
        let at = sweep.at([index / sweep.y.cells, index % sweep.y.cells]);
        let mut words = line.split(',');
        let mut number = || words.next()?.parse::<f64>().ok();
        let found = [number(), number()];
        if found != at.map(Some) {
            let [x, y] = at;
            return Err(format!(
                "{}: {line:?}: not the next cell of the plane; must begin with {x:?},{y:?}",
                index + 2
            ));
        }
        parse_cell(words).ok_or_else(|| format!("{}: {line:?}: not a cell; must have {expected}", index + 2))
    });
    let cells = cells.collect::<Result<Vec<CellOutcome>, String>>()?;
    if cells.len() == sweep.cells() {
        Ok(cells)
    } else {
        Err(format!("{} cells; this plane has {}", cells.len(), sweep.cells()))
    }
}

fn push_cell(line: &mut String, cell: &CellOutcome) {
    let backward = if cell.backward_flow { "1" } else { "0" };
    for word in [cell.class.name(), backward, cell.decided_by.name()] {
        line.push(',');
        line.push_str(word);
    }
    for number in cell.numbers {
        line.push(',');
        if !number.is_nan() {
            push_number(line, number);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CellOutcome, Class, DecidedBy, parse, shard_line};

    #[test]
    fn a_line_is_read_as_it_was_written_and_no_part_of_it_is() {
        let numbers = [12.5, 0.1, -1e-300, f64::NAN, f64::NAN, 3e-9];
        let cell =
            CellOutcome { class: Class::WavesBackwards, backward_flow: true, decided_by: DecidedBy::Run, numbers };
        let line = shard_line([3, 14], &cell);
        let (indices, read) = parse(&line).expect("a cell");
        assert_eq!((indices, shard_line(indices, &read)), ([3, 14], line.clone()));
        assert!(
            (0..line.len() - 1).all(|end| parse(&line[..end]).is_none_or(|read| shard_line(read.0, &read.1) != line))
        );
        assert_eq!(line.matches("12.5").count(), 1, "{line}");
        let digit = line.replace("12.5", "12.6");
        for damaged in [digit, line.replace("waves_b", "waves_c"), line.replace(",1,", ",2,"), line + ","] {
            assert!(parse(&damaged).is_none(), "{damaged}");
        }
    }
}
