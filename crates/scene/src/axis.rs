//! An axis of a plane of cells: of a stability map or of a sweep.

use crate::law;
use files::reader::{FINITE, Reader, SceneError, Section};
use jam::laws::Model;

/// Cells of equal width, or of equal ratio, with the values at their centres.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The parameter it runs over.
    pub parameter: String,
    /// Its lower end.
    pub from: f64,
    /// Its upper end.
    pub to: f64,
    /// The number of cells.
    pub cells: usize,
    /// Whether the cells have equal ratios.
    pub is_log: bool,
    /// Whether the values are whole: each is rounded to the nearest.
    pub is_whole: bool,
}

impl Axis {
    /// Reads a linear axis of at most `most` cells; `parameters` says what it can run over.
    ///
    /// # Errors
    /// What is missing or out of range.
    pub fn read(reader: &mut Reader<'_>, parameters: &str, most: usize) -> Result<Axis, SceneError> {
        let axis = Axis {
            parameter: reader.text("parameter", parameters)?.to_owned(),
            from: reader.number("from", FINITE)?,
            to: reader.number("to", FINITE)?,
            cells: reader.count("cells", 1, most)?,
            is_log: false,
            is_whole: false,
        };
        if axis.to <= axis.from {
            return Err(reader.complaint("to", &format!("must be above from = {:?}", axis.from)));
        }
        Ok(axis)
    }

    /// What keeps a law of the paper, which has no negative parameter, from this axis.
    pub fn negative(&self) -> Option<String> {
        (self.from < 0.0).then(|| format!("{} cannot be negative; must be a number >= 0.0", self.parameter))
    }

    /// The value at the centre of cell `i`.
    pub fn centre(&self, i: usize) -> f64 {
        self.at(i as f64 + 0.5)
    }

    /// The value at a place counted in cells from the lower end: cell `i` reaches from `i` to `i + 1`.
    pub fn at(&self, place: f64) -> f64 {
        let share = place / self.cells as f64;
        let value = if self.is_log {
            let (low, high) = (math::ln(self.from), math::ln(self.to));
            math::exp(low + (high - low) * share)
        } else {
            self.from + (self.to - self.from) * share
        };
        if self.is_whole { value.round() } else { value }
    }
}

/// The law of `[law]`, read with the axes at the first cell. `read` sets them. A formula may have a value in a part of
/// the plane only: while it has none, other cells are tried that are spread over it. A law of the paper must be valid
/// in every cell, and is so if in the first: its ranges have no upper end, and axes rise.
///
/// # Errors
/// That of the first cell: of a formula, if it fails everywhere.
pub fn law_of_plane(
    law: &Section,
    axes: [&Axis; 2],
    mut read: impl FnMut([f64; 2]) -> Result<Model, SceneError>,
) -> Result<Model, SceneError> {
    let places = spread(axes);
    let first = read(places[0]);
    if first.is_ok() || law::built_in(law).is_some() {
        return first;
    }
    places[1..].iter().find_map(|at| read(*at).ok()).map_or(first, Ok)
}

/// As many cells along each axis are tried.
const TRIED: usize = 16;

/// The centres of cells that are spread over the plane, that of the first cell first; of a small plane all.
pub(crate) fn spread(axes: [&Axis; 2]) -> Vec<[f64; 2]> {
    let [across, up] = axes.map(|axis| {
        let (cells, count) = (axis.cells, axis.cells.min(TRIED));
        (0..count).map(|place| axis.centre(place * cells / count)).collect::<Vec<f64>>()
    });
    across.iter().flat_map(|x| up.iter().map(|y| [*x, *y])).collect()
}
