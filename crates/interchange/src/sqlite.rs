//! JuPedSim's trajectory file, version 2: an SQLite database with the tables of its `SqliteTrajectoryWriter`, and with
//! [`Header::facts`] among its metadata.

use crate::frames::Row;
use crate::header::Header;
use checkout::failure::Failure;
use files::write::Draft;
use rusqlite::{Connection, params};

/// The version of the form.
const VERSION: u32 = 2;

/// The tables. Rows come in the order of the index, which so is filled from one end to the other.
const TABLES: &str = "
CREATE TABLE trajectory_data (
   frame INTEGER NOT NULL,
   id INTEGER NOT NULL,
   pos_x REAL NOT NULL,
   pos_y REAL NOT NULL,
   ori_x REAL NOT NULL,
   ori_y REAL NOT NULL);
CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE geometry(
   hash INTEGER NOT NULL,
   wkt TEXT NOT NULL);
CREATE UNIQUE INDEX geometry_hash on geometry( hash);
CREATE TABLE frame_data(
   frame INTEGER NOT NULL,
   geometry_hash INTEGER NOT NULL);
CREATE INDEX frame_id_idx ON trajectory_data(frame, id);
";

/// The draft is thrown away when writing fails: no journal. What does not fit into two megabytes goes to the file.
const SETTINGS: &str = "
PRAGMA journal_mode = OFF;
PRAGMA synchronous = OFF;
PRAGMA locking_mode = EXCLUSIVE;
PRAGMA cache_size = -2000;
PRAGMA encoding = 'UTF-8';
PRAGMA page_size = 4096;
";

/// Writes the draft; the number of rows.
///
/// # Errors
/// A row cannot be read, or the file not be written.
pub fn write(draft: &Draft, header: &Header, rows: impl Iterator<Item = Result<Row, Failure>>) -> Result<u64, Failure> {
    let at = |error: rusqlite::Error| Failure::Failed(format!("{}: {error}", draft.place().display()));
    let database = Connection::open(draft.path()).map_err(at)?;
    database.execute_batch(SETTINGS).map_err(at)?;
    // one transaction: the same bytes whenever it is made
    database.execute_batch("BEGIN").and_then(|()| database.execute_batch(TABLES)).map_err(at)?;
    let mut extent = Extent::default();
    fill(&database, header, rows, &mut extent, &at)?;
    describe(&database, header, &extent).map_err(at)?;
    database.execute_batch("COMMIT").map_err(at)?;
    database.close().map_err(|(_, error)| at(error))?;
    draft.flush()?;
    Ok(extent.rows)
}

/// How far the rows reach.
#[derive(Debug, Default)]
struct Extent {
    rows: u64,
    frames: u32,
    /// The least and the largest position in metres.
    least: f64,
    most: f64,
}

fn fill(
    database: &Connection,
    header: &Header,
    rows: impl Iterator<Item = Result<Row, Failure>>,
    extent: &mut Extent,
    at: &dyn Fn(rusqlite::Error) -> Failure,
) -> Result<(), Failure> {
    // everybody walks on the line y = 0 and looks along it
    let mut insert = database.prepare("INSERT INTO trajectory_data VALUES(?, ?, ?, 0, 1, 0)").map_err(at)?;
    for row in rows {
        let Row { frame, n, x } = row?;
        let x = header.metres(x);
        insert.execute(params![frame, n, x]).map_err(at)?;
        // every x is finite
        extent.least = if x < extent.least { x } else { extent.least };
        extent.most = if x > extent.most { x } else { extent.most };
        extent.frames = frame + 1;
        extent.rows += 1;
    }
    Ok(())
}

fn describe(database: &Connection, header: &Header, extent: &Extent) -> rusqlite::Result<()> {
    let corridor = Corridor::around(header.circumference(), extent.least, extent.most);
    let wkt = corridor.wkt();
    let hash = stable_hash(&wkt);
    database.execute("INSERT INTO geometry VALUES(?, ?)", params![hash, wkt])?;
    let mut frame = database.prepare("INSERT INTO frame_data VALUES(?, ?)")?;
    for number in 0..extent.frames {
        frame.execute(params![number, hash])?;
    }
    let mut entry = database.prepare("INSERT INTO metadata VALUES(?, ?)")?;
    let mut say = |key: &str, value: &str| entry.execute(params![key, value]).map(|_| ());
    say("version", &VERSION.to_string())?;
    say("fps", &format!("{:?}", header.rate))?;
    let bounds = [("xmin", corridor.from), ("xmax", corridor.to), ("ymin", -Corridor::HALF), ("ymax", Corridor::HALF)];
    bounds.iter().try_for_each(|(key, value)| say(key, &format!("{value:?}")))?;
    header.facts().iter().try_for_each(|(key, value)| say(key, value))
}

/// The walkable area: a straight corridor, since `x` is not wrapped.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corridor {
    from: f64,
    to: f64,
}

impl Corridor {
    /// Half its width in metres. One metre wide, a density in 1/m^2 is one in 1/m.
    const HALF: f64 = 0.5;

    /// A ring longer at either end than the positions reach, in whole metres.
    fn around(ring: f64, least: f64, most: f64) -> Corridor {
        Corridor { from: (least - ring).floor(), to: (most + ring).ceil() }
    }

    fn wkt(&self) -> String {
        let (from, to, half) = (self.from, self.to, Corridor::HALF);
        format!("POLYGON (({from} -{half}, {to} -{half}, {to} {half}, {from} {half}, {from} -{half}))")
    }
}

/// JuPedSim takes Python's hash of the text, which changes from one process to the next; this one does not.
fn stable_hash(text: &str) -> i64 {
    let digits = files::write::sha256(text.as_bytes());
    i64::from_str_radix(&digits[..15], 16).unwrap_or(0)
}
