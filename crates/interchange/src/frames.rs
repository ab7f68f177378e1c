//! Reads the table of a run (`t, n, x, v`) as frames, one for each multiple of the sampling interval, with every
//! pedestrian.

use checkout::failure::Failure;
use csv::ByteRecord;
use std::io::Read;
use std::path::Path;

/// The columns of the table.
const COLUMNS: [&str; 4] = ["t", "n", "x", "v"];
/// How far the time of a row may be from that of its frame, in units of the time between frames.
const SAME_TIME: f64 = 1e-6;

/// A pedestrian in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The number of the frame, from 0.
    pub frame: u32,
    /// The number of the pedestrian, from 0.
    pub n: u32,
    /// The position in units of `a_0`, not wrapped around the ring.
    pub x: f64,
}

/// Reads rows one by one and checks that none is missing: frames in order, in each all pedestrians in order.
#[derive(Debug)]
pub struct Frames<R> {
    reader: csv::Reader<R>,
    record: ByteRecord,
    file: String,
    pedestrians: u32,
    interval: f64,
    /// What the next row must be.
    frame: u32,
    n: u32,
}

impl Frames<std::fs::File> {
    /// Opens the table of a run of this many pedestrians, sampled every `interval` (in units of `tau`).
    ///
    /// # Errors
    /// The file cannot be read, or has other columns.
    pub fn open(path: &Path, pedestrians: u32, interval: f64) -> Result<Frames<std::fs::File>, Failure> {
        let file = std::fs::File::open(path).map_err(|error| files::write::with_path(error, path))?;
        Frames::read(&path.display().to_string(), file, pedestrians, interval)
    }
}

impl<R: Read> Frames<R> {
    /// Reads a table; `file` is only for messages.
    ///
    /// # Errors
    /// It cannot be read, or has other columns.
    pub fn read(file: &str, table: R, pedestrians: u32, interval: f64) -> Result<Frames<R>, Failure> {
        let mut reader = csv::Reader::from_reader(table);
        let columns = reader.headers().map_err(|error| Failure::Usage(format!("{file}: {error}")))?;
        if columns != COLUMNS[..] {
            let found: Vec<&str> = columns.iter().collect();
            let problem = format!("expected the columns {}, found {}", COLUMNS.join(","), found.join(","));
            return Err(Failure::Usage(format!("{file}:1: {problem}")));
        }
        let (record, file) = (ByteRecord::new(), file.to_owned());
        Ok(Frames { reader, record, file, pedestrians, interval, frame: 0, n: 0 })
    }

    fn row(&mut self) -> Result<Row, String> {
        let [t, n, x, v] = [0, 1, 2, 3].map(|column| number(self.record.get(column)));
        let (t, n, x, _) = (t?, n?, x?, v?);
        let expected = f64::from(self.frame) * self.interval;
        if n != f64::from(self.n) || (t - expected).abs() > SAME_TIME * self.interval {
            return Err(format!("expected pedestrian {} at t = {expected:?}, found {n:?} at {t:?}", self.n));
        }
        let row = Row { frame: self.frame, n: self.n, x };
        self.n += 1;
        if self.n == self.pedestrians {
            (self.frame, self.n) = (self.frame + 1, 0);
        }
        Ok(row)
    }

    fn complain(&self, problem: impl std::fmt::Display) -> Failure {
        let line = self.record.position().map_or(0, csv::Position::line);
        Failure::Usage(format!("{}:{line}: {problem}", self.file))
    }
}

impl<R: Read> Iterator for Frames<R> {
    type Item = Result<Row, Failure>;

    fn next(&mut self) -> Option<Result<Row, Failure>> {
        match self.reader.read_byte_record(&mut self.record) {
            Ok(true) => Some(self.row().map_err(|problem| self.complain(problem))),
            Ok(false) if self.n > 0 => {
                let problem = format!("the last frame has {} of {} pedestrians", self.n, self.pedestrians);
                // told once
                self.n = 0;
                Some(Err(self.complain(problem)))
            }
            Ok(false) => None,
            Err(error) => Some(Err(self.complain(error))),
        }
    }
}

fn number(cell: Option<&[u8]>) -> Result<f64, String> {
    let text = String::from_utf8_lossy(cell.unwrap_or_default());
    text.parse()
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| format!("{text:?} is not a finite number"))
}
