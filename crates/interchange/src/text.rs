//! The text format of PedPy and of the pedestrian dynamics data archive: comments with frame rate and columns, then one
//! line for each pedestrian in each frame.

use crate::frames::Row;
use crate::header::Header;
use checkout::failure::Failure;
use files::write::{Draft, with_path};
use std::fs::File;
use std::io::{BufWriter, Write};

/// Digits behind the point of a position in metres: to half a nanometre, and more where `a_0`, in metres, is below a
/// centimetre, so that the last one is 1e-7 `a_0` or less.
pub fn digits(length: f64) -> usize {
    let finer = std::iter::successors(Some(length), |length| Some(10.0 * length)).take_while(|&length| length < 0.0099);
    9 + finer.count()
}

/// Writes the draft; the number of rows.
///
/// # Errors
/// A row cannot be read, or the file not be written.
pub fn write(draft: &Draft, header: &Header, rows: impl Iterator<Item = Result<Row, Failure>>) -> Result<u64, Failure> {
    let at = |error| Failure::from(with_path(error, draft.place()));
    let mut file = BufWriter::new(File::create(draft.path()).map_err(at)?);
    file.write_all(comments(header).as_bytes()).map_err(at)?;
    let (mut count, digits) = (0, digits(header.units.length));
    for row in rows {
        let Row { frame, n, x } = row?;
        writeln!(file, "{n} {frame} {:.digits$} 0 0", header.metres(x)).map_err(at)?;
        count += 1;
    }
    file.flush().map_err(at)?;
    draft.flush()?;
    Ok(count)
}

/// The comments. PedPy takes the first number in a line that has `framerate` in it, and looks for `x/m` and for `x/cm`
/// everywhere: words from the scene stand behind the line that says it.
fn comments(header: &Header) -> String {
    let facts: String = header.facts().iter().map(|(name, value)| format!("# {name}: {value}\n")).collect();
    format!("# framerate: {}\n{facts}# ID FR x/m y/m z/m\n", header.rate)
}
