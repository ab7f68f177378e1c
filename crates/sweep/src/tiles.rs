//! Chooses the cells of a plane that are computed. The plane is divided into tiles that do not depend on each other.
//!
//! Tiles share their borders. Each computes its whole border, then cuts itself in two as long as the border of a piece
//! shows several outcomes, or a cell within lies beside the line of stability (or beside another line that is known
//! without a run). What lies within a border of one outcome gets it from there.

use super::{CellOutcome, DecidedBy, Precheck, Sweep};
use jam::outcome::Class;

/// Distance of the borders of tiles, in cells.
pub const SIDE: usize = 25;

/// A rectangle of cells, both corners included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Least indices.
    pub low: [usize; 2],
    /// Largest indices.
    pub high: [usize; 2],
}

/// A cell with its outcome.
pub type Found = ([usize; 2], CellOutcome);

/// The tiles of a plane of the given size, column by column.
pub fn tiles(sweep: &Sweep) -> Vec<Tile> {
    let cuts = |cells: usize| -> Vec<(usize, usize)> {
        let count = cells.div_ceil(SIDE);
        (0..count).map(|i| (i * SIDE, ((i + 1) * SIDE).min(cells - 1))).collect()
    };
    let rows = cuts(sweep.y.cells);
    let pair =
        |(left, right): (usize, usize), (bottom, top): (usize, usize)| Tile { low: [left, bottom], high: [right, top] };
    cuts(sweep.x.cells).into_iter().flat_map(|column| rows.iter().map(move |row| pair(column, *row))).collect()
}

/// The tiles of shard `index` of `count`, from 0.
pub fn of_shard(tiles: &[Tile], index: usize, count: usize) -> Vec<Tile> {
    tiles.iter().copied().skip(index).step_by(count).collect()
}

impl Tile {
    /// The number of its cells.
    pub fn cells(&self) -> usize {
        (self.high[0] - self.low[0] + 1) * (self.high[1] - self.low[1] + 1)
    }

    /// All of them, in order.
    pub fn all(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        self.indices()
    }

    fn indices(self) -> impl Iterator<Item = [usize; 2]> {
        (self.low[0]..=self.high[0]).flat_map(move |i| (self.low[1]..=self.high[1]).map(move |j| [i, j]))
    }

    fn border(self) -> impl Iterator<Item = [usize; 2]> {
        let Tile { low, high } = self;
        self.indices().filter(move |cell| (0..2).any(|axis| cell[axis] == low[axis] || cell[axis] == high[axis]))
    }

    fn has_inside(self) -> bool {
        (0..2).all(|axis| self.high[axis] - self.low[axis] >= 2)
    }

    fn inside(self) -> impl Iterator<Item = [usize; 2]> {
        let [low, high] = [self.low.map(|i| i + 1), self.high.map(|i| i.saturating_sub(1))];
        Tile { low, high }.indices()
    }

    /// Both halves, across the longer side; they share the line between them.
    fn halves(self) -> [Tile; 2] {
        let axis = usize::from(self.high[1] - self.low[1] > self.high[0] - self.low[0]);
        let middle = usize::midpoint(self.low[axis], self.high[axis]);
        let (mut first, mut second) = (self, self);
        (first.high[axis], second.low[axis]) = (middle, middle);
        [first, second]
    }
}

/// A tile at work.
struct Work<'a, F> {
    tile: Tile,
    compute: &'a mut F,
    /// Cells beside a line that is known without a run.
    beside: Vec<bool>,
    found: Vec<Option<CellOutcome>>,
}

/// Computes a tile with what computes a cell, and fills in the rest; all its cells, in order.
///
/// # Errors
/// The first error of a cell.
pub fn compute<E: From<String>>(
    sweep: &Sweep,
    tile: Tile,
    compute: &mut impl FnMut([usize; 2]) -> Result<CellOutcome, E>,
) -> Result<Vec<Found>, E> {
    let places = Places::new(sweep, tile)?;
    let beside = tile.indices().map(|cell| places.is_beside(cell)).collect();
    let mut work = Work { tile, compute, beside, found: vec![None; tile.cells()] };
    if sweep.refine {
        for cell in tile.border() {
            work.class(cell)?;
        }
        work.refine(tile)?;
    } else {
        for cell in tile.indices() {
            work.class(cell)?;
        }
    }
    Ok(work.filled(&places))
}

/// The cells of a tile that are computed in any case.
///
/// # Errors
/// As [`Sweep::place`].
pub fn least(sweep: &Sweep, tile: Tile) -> Result<Vec<[usize; 2]>, String> {
    let places = Places::new(sweep, tile)?;
    let mut cells: Vec<[usize; 2]> =
        tile.border().chain(tile.indices().filter(|cell| places.is_beside(*cell))).collect();
    cells.sort_unstable();
    cells.dedup();
    Ok(cells)
}

impl<E, F: FnMut([usize; 2]) -> Result<CellOutcome, E>> Work<'_, F> {
    fn index(&self, cell: [usize; 2]) -> usize {
        let height = self.tile.high[1] - self.tile.low[1] + 1;
        (cell[0] - self.tile.low[0]) * height + (cell[1] - self.tile.low[1])
    }

    /// The outcome of a cell, computed if it is not known.
    fn class(&mut self, cell: [usize; 2]) -> Result<Class, E> {
        let index = self.index(cell);
        let known = match self.found[index] {
            Some(known) => known,
            None => *self.found[index].insert((self.compute)(cell)?),
        };
        Ok(known.class)
    }

    /// Computes what is needed within a rectangle whose border is known.
    fn refine(&mut self, tile: Tile) -> Result<(), E> {
        if !tile.has_inside() {
            return Ok(());
        }
        let classes = tile.border().map(|cell| self.class(cell)).collect::<Result<Vec<Class>, E>>()?;
        let is_one = classes.iter().all(|class| *class == classes[0]) && classes[0] != Class::Undecided;
        let is_crossed = tile.inside().any(|cell| self.beside[self.index(cell)]);
        if is_one && !is_crossed {
            return Ok(());
        }
        for half in tile.halves() {
            for cell in half.border() {
                self.class(cell)?;
            }
            self.refine(half)?;
        }
        Ok(())
    }

    /// All cells. Those that were not computed lie within a border of one outcome, which is that of the cell before.
    fn filled(self, places: &Places) -> Vec<Found> {
        let mut last = Class::Undecided;
        let cells = self.tile.indices().zip(self.found);
        cells
            .map(|(cell, found)| {
                let found = found.unwrap_or_else(|| CellOutcome {
                    class: last,
                    backward_flow: places.of(cell).backward_flow,
                    decided_by: DecidedBy::Neighbours,
                    numbers: [f64::NAN; 6],
                });
                last = found.class;
                (cell, found)
            })
            .collect()
    }
}

/// What is known without a run, of the cells of a tile and of those around it.
struct Places {
    low: [usize; 2],
    high: [usize; 2],
    all: Vec<Precheck>,
}

impl Places {
    fn new(sweep: &Sweep, tile: Tile) -> Result<Places, String> {
        let low = tile.low.map(|i| i.saturating_sub(1));
        let high = [(tile.high[0] + 1).min(sweep.x.cells - 1), (tile.high[1] + 1).min(sweep.y.cells - 1)];
        let all =
            Tile { low, high }.indices().map(|cell| sweep.place(cell)).collect::<Result<Vec<Precheck>, String>>()?;
        Ok(Places { low, high, all })
    }

    fn of(&self, cell: [usize; 2]) -> Precheck {
        let height = self.high[1] - self.low[1] + 1;
        self.all[(cell[0] - self.low[0]) * height + (cell[1] - self.low[1])]
    }

    /// Whether a neighbour is on the other side of a line: of stability, or of the initial state's validity.
    fn is_beside(&self, cell: [usize; 2]) -> bool {
        let [i, j] = cell;
        let around = [[i.wrapping_sub(1), j], [i + 1, j], [i, j.wrapping_sub(1)], [i, j + 1]];
        let is_in = |cell: &[usize; 2]| (0..2).all(|axis| (self.low[axis]..=self.high[axis]).contains(&cell[axis]));
        let own = self.of(cell);
        let differs = |other: Precheck| (other.class, other.unstable) != (own.class, own.unstable);
        around.iter().filter(|cell| is_in(cell)).any(|cell| differs(self.of(*cell)))
    }
}
